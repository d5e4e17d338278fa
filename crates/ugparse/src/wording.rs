//! The text of messages about single words and statements.

use crate::diagnostic::{Diagnostic, Setting};
use crate::source::Span;
use crate::statements::{NAME, STATEMENTS, statement};
use crate::suggest::nearest;
use crate::token::{Input, NAME_LETTERS, word};

/// The error for an unknown keyword.
pub(crate) fn no_statement(word: &[u8], span: Span) -> Diagnostic {
    let finding = Diagnostic::error(span, format!("`{}` is not a statement", shorten(word)));
    let lower = word.to_ascii_lowercase();
    let keywords: Vec<&str> = STATEMENTS.iter().map(|statement| statement.keyword).collect();
    match word {
        b"}" => finding.label("closes nothing").help("remove it, or open its comment with `{`"),
        [b'#', ..] => finding
            .label("neither a statement nor a comment")
            .help("comments are in braces, `{ like this }`; a line mark is `# LINE \"FILE\"`")
            .setting(Setting::Lax),
        [b'/', b'/' | b'*', ..] => finding
            .label("neither a statement nor a comment")
            .help("comments are in braces: `{ like this }`"),
        _ if statement(&lower).is_some() => finding
            .label("unknown statement")
            .help(format!("keywords are lower case: `{}`", String::from_utf8_lossy(&lower))),
        _ if let Some(keyword) =
            nearest(word, keywords.iter().map(|keyword| keyword.as_bytes())) =>
        {
            finding.label("unknown statement").help(format!("did you mean `{keyword}`?"))
        }
        _ => finding
            .label("unknown statement")
            .help(format!(
                "a statement begins with one of {}, or `(` for an escape",
                keywords.join(" ")
            ))
            .setting(Setting::Lax),
    }
}

/// A remedy for an invalid number or name.
pub(crate) fn word_help(wanted: &str, word: &[u8]) -> Option<String> {
    let shown = shorten(word);
    let looks_like_number = matches!(word, [b'0'..=b'9' | b'+' | b'-' | b'.', ..]);
    let unsigned = shown.trim_start_matches(['+', '-']).to_ascii_lowercase();
    match wanted {
        #[cfg(feature = "report")]
        "a number" if let Some(remedy) = ugpipe::remedies::look_alike(&shown) => Some(remedy),
        "a number" if looks_like_number && shown.contains(',') => {
            Some("write a decimal point".to_string())
        }
        "a number" if ["nan", "inf", "infinity"].contains(&unsigned.as_str()) => {
            Some("every number must be finite".to_string())
        }
        "a number" if looks_like_number => {
            Some("numbers are written like `1`, `-.5` or `2e-3`".to_string())
        }
        NAME | NAME_LETTERS if word.len() < 40 && word.iter().any(u8::is_ascii_alphanumeric) => {
            let allowed = |c: char| c.is_ascii_alphanumeric() || matches!(c, ':' | '_' | '#');
            let name: String = shown.chars().map(|c| if allowed(c) { c } else { '_' }).collect();
            let begin = if name.starts_with(|c: char| c.is_ascii_digit()) { "_" } else { "" };
            Some(format!("write for example `{begin}{name}`"))
        }
        _ => None,
    }
}

/// Adds the syntax of the statement that begins at `input`.
pub(crate) fn with_usage(finding: Diagnostic, input: Input<'_>) -> Diagnostic {
    match word(input).ok().and_then(|(_, keyword)| statement(keyword)) {
        Some(statement) => finding.help(format!("the form is `{}`", statement.form())),
        None => finding,
    }
}

/// A word for a message, without its end if it is long.
pub(crate) fn shorten(word: &[u8]) -> String {
    ugscene::shorten(&String::from_utf8_lossy(word))
}
