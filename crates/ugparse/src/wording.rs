//! The text of messages about single words and statements.

use ugscene::SurfaceProperties;

use crate::diagnostic::{Diagnostic, Setting};
use crate::grammar::{KEYWORDS, NAME, is_keyword};
use crate::source::Span;
use crate::suggest::nearest;
use crate::token::{Input, NAME_LETTERS, word};

/// The error for an unknown keyword.
pub(crate) fn no_statement(word: &[u8], span: Span) -> Diagnostic {
    let finding = Diagnostic::error(span, format!("`{}` is not a statement", shorten(word)));
    let lower = word.to_ascii_lowercase();
    match word {
        b"}" => finding.label("closes nothing").help("remove it, or open its comment with `{`"),
        [b'#', ..] => finding
            .label("neither a statement nor a comment")
            .help("comments are in braces, `{ like this }`; a line mark is `# LINE \"FILE\"`")
            .setting(Setting::Lax),
        [b'/', b'/' | b'*', ..] => {
            finding.label("neither a statement nor a comment").help("comments are in braces: `{ like this }`")
        }
        _ if is_keyword(&lower) => finding
            .label("unknown statement")
            .help(format!("keywords are lower case: `{}`", String::from_utf8_lossy(&lower))),
        _ if let Some(keyword) = nearest(word, KEYWORDS.split(' ').map(str::as_bytes)) => {
            finding.label("unknown statement").help(format!("did you mean `{keyword}`?"))
        }
        _ => finding
            .label("unknown statement")
            .help(format!("a statement begins with one of {KEYWORDS}, or `(` for an escape"))
            .setting(Setting::Lax),
    }
}

/// A character that looks like one of numbers, as word processors write it, and its name.
fn look_alike(word: &str) -> Option<(char, &'static str)> {
    word.chars().find_map(|c| match c {
        '\u{2212}' => Some((c, "a minus sign of Unicode")),
        '\u{2010}'..='\u{2015}' => Some((c, "a dash")),
        '\u{a0}' | '\u{2007}' | '\u{202f}' => Some((c, "a blank without break")),
        '\u{ff10}'..='\u{ff19}' => Some((c, "a wide digit")),
        _ => None,
    })
}

/// A remedy for an invalid number or name.
pub(crate) fn word_help(wanted: &str, word: &[u8]) -> Option<String> {
    let shown = shorten(word);
    let looks_like_number = matches!(word, [b'0'..=b'9' | b'+' | b'-' | b'.', ..]);
    let unsigned = shown.trim_start_matches(['+', '-']).to_ascii_lowercase();
    match wanted {
        "a number" if let Some((c, name)) = look_alike(&shown) => {
            Some(format!("`{c}` (U+{:04X}) is {name}: write it as ASCII", u32::from(c)))
        }
        "a number" if looks_like_number && shown.contains(',') => Some("write a decimal point".to_string()),
        "a number" if ["nan", "inf", "infinity"].contains(&unsigned.as_str()) => {
            Some("every number must be finite".to_string())
        }
        "a number" if looks_like_number => Some("numbers are written like `1`, `-.5` or `2e-3`".to_string()),
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
    match word(input).ok().and_then(|(_, keyword)| usage(keyword)) {
        Some(usage) => finding.help(format!("the form is `{usage}`")),
        None => finding,
    }
}

/// A word for a message, without its end if it is long.
pub(crate) fn shorten(word: &[u8]) -> String {
    ugscene::shorten(&String::from_utf8_lossy(word))
}

/// The syntax of a statement, for messages.
fn usage(keyword: &[u8]) -> Option<&'static str> {
    Some(match keyword {
        b"v" => "v ID x y z [color] [nx ny nz] [(u v)] ;",
        b"w" => "w [ID] (vertices) … [color] [< vx vy vz >] ;",
        b"label" => "label [ID] \"text\" vertex [< vx vy vz >] ;",
        b"f" => "f [ID] (vertices) … [color] [level or surface] [< vx vy vz >] ;",
        b"sphere" => "sphere [ID] x y z radius [color] [level or surface] [< vx vy vz >] ;",
        b"cylinder" => "cylinder [ID] x y z x y z radius [color] [level or surface] [< vx vy vz >] ;",
        b"tube" => "tube [ID] x y z x y z radius [color] [level or surface] [< vx vy vz >] ;",
        b"disc" => "disc [ID] x y z nx ny nz radius [color] [level or surface] [< vx vy vz >] ;",
        b"c" => "c [ID] lightness [hue [saturation [translucency [factor]]]] ;",
        b"c_rgb" => "c_rgb [ID] red green blue [translucency] ;",
        b"c_xyz" => "c_xyz [ID] X Y Z [translucency] ;",
        b"c_bb" => "c_bb [ID] kelvin [scale] ;",
        b"c_spd" => "c_spd [ID] nm value [nm value] … ;  c_spd [ID] sun ;",
        b"c_refl" => "c_refl [ID] nm reflectance [nm reflectance] … ;  c_refl [ID] SURFACE ;",
        b"c_mix" => "c_mix ID color share [color share] … ;",
        b"c_time" => "c_time ID [-step] [-period T] [-shift T] time color [time color] … ;",
        b"c_tex" => {
            "c_tex ID FILE [-image N] [-wrap MODE [MODE]] [-factor r g b [a]] [-mask [cutoff] | -blend] ;"
        }
        b"c_emit" => "c_emit ID color ;",
        b"surf" => SurfaceProperties::FORM,
        b"l" => "l [ID] intensity [x y z [radius [reference]]] [color] [< vx vy vz >] ;",
        b"cam" => "cam [ID] [-ep x y z] [-vc x y z] [-ud x y z] [-va a [b]] … ;",
        b"motion" => {
            "motion ID [-at x y z] [-vel x y z] [-acc x y z [begin end]] [-spin x y z [begin end]] … ;"
        }
        b"sky" => "sky FILE [-ra x y z] ;",
        b"def" => "def ID ; … end ;",
        b"end" => "end ;",
        b"include" => "include FILE ;",
        b"execute" => "execute FILE ;",
        b"i" => "i [ID] (def [color] [-tx …]) [< vx vy vz >] ;",
        b"a" => "a [ID] (def [color] [-tx …]) size [-tx …] [< vx vy vz >] ;",
        _ => return None,
    })
}
