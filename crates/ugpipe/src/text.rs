//! Makes text that came from outside safe to show.
//!
//! Names, words of files and arguments may contain terminal escapes, and characters that reverse or
//! hide what surrounds them. Messages and reports are built with such text as it is; the exits of
//! the program replace these characters: [`crate::Context`] in messages and reports, and the
//! renderer of diagnostics (ugparse) in its parts, because it adds line ends and styles of its own.

/// False for characters that a terminal obeys or does not show: control characters (C0, DEL and
/// C1), line and paragraph separators, directional marks, embeddings, overrides and isolates, and
/// characters of no width.
pub fn is_printable(c: char) -> bool {
    !c.is_control()
        && !matches!(c, '\u{ad}' | '\u{61c}' | '\u{180e}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}')
        && !matches!(c, '\u{2060}'..='\u{206f}' | '\u{feff}' | '\u{fff9}'..='\u{fffb}')
        && !matches!(c, '\u{1d173}'..='\u{1d17a}' | '\u{e0000}'..='\u{e007f}')
}

/// `text` on one line, with U+FFFD in place of every character that is not
/// [printable](is_printable).
pub fn printable(text: &str) -> String {
    text.chars().map(|c| if is_printable(c) { c } else { char::REPLACEMENT_CHARACTER }).collect()
}

/// A message on one line: [`printable`], with its long words and its end cut off, since names and
/// fields that it quotes may be millions of characters long.
pub fn message(text: &str) -> String {
    const MAX: usize = 4096;
    let words: Vec<String> = text.split(' ').map(cut_word).collect();
    let whole = printable(&words.join(" "));
    match whole.char_indices().nth(MAX) {
        Some((end, _)) => format!("{}…", &whole[..end]),
        None => whole,
    }
}

/// The beginning and the end of a long word.
fn cut_word(word: &str) -> String {
    const MAX: usize = 256;
    const PART: usize = 100;
    if word.chars().nth(MAX).is_none() {
        return word.to_owned();
    }
    let start = word.char_indices().nth(PART).map_or(word, |(at, _)| &word[..at]);
    let end = word.char_indices().nth_back(PART).map_or(word, |(at, _)| &word[at..]);
    format!("{start}…{end}")
}

/// Like [`printable`], and keeps line ends: a text of several lines.
#[cfg(feature = "cli")]
pub(crate) fn printable_lines(text: &str) -> String {
    text.split('\n').map(printable).collect::<Vec<_>>().join("\n")
}

/// Like [`printable_lines`], and keeps styles: sequences `ESC [ … m`.
#[cfg(feature = "cli")]
pub(crate) fn printable_styled(text: &str) -> String {
    let mut parts = text.split("\u{1b}[");
    let mut shown = printable_lines(parts.next().unwrap_or_default());
    for part in parts {
        let end = part.find(|c: char| !c.is_ascii_digit() && c != ';');
        match end.and_then(|end| part[end..].strip_prefix('m')) {
            Some(rest) => {
                shown.push_str("\u{1b}[");
                shown.push_str(&part[..part.len() - rest.len()]);
                shown.push_str(&printable_lines(rest));
            }
            None => shown.push_str(&printable_lines(&format!("\u{1b}[{part}"))),
        }
    }
    shown
}

/// JSON with escapes in place of the characters that are not [printable](is_printable). Its value
/// is the same: apart from line ends between tokens, they occur only in strings.
#[cfg(feature = "cli")]
pub(crate) fn printable_json(json: &str) -> String {
    let mut shown = String::with_capacity(json.len());
    for c in json.chars() {
        if c == '\n' || is_printable(c) {
            shown.push(c);
        } else {
            c.encode_utf16(&mut [0; 2])
                .iter()
                .for_each(|unit| shown.push_str(&format!("\\u{unit:04x}")));
        }
    }
    shown
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_are_short() {
        let long = "é".repeat(1_000_000);
        let found = message(&format!("vertex `{long}` is not defined"));
        assert!(found.starts_with("vertex `éé") && found.ends_with("é` is not defined"), "{found}");
        assert!(found.chars().count() < 300);
        assert!(message(&"a ".repeat(1_000_000)).len() < 5000);
        assert_eq!(message(&"b".repeat(200)), "b".repeat(200));
    }

    #[test]
    fn text_from_outside_cannot_move_the_cursor() {
        fn check(text: &str, expected: &str) {
            assert_eq!(printable(text), expected);
        }
        check("ship.ug", "ship.ug");
        check("γ 船 é e\u{301} 🚀.ug", "γ 船 é e\u{301} 🚀.ug");
        check("a\x1b[2J\n.ug", "a\u{fffd}[2J\u{fffd}.ug");
        check("\r\t\x08\x07\x7f\u{80}\u{9b}\u{9f}", &"\u{fffd}".repeat(8));
        check("\u{202a}\u{202e}\u{2066}\u{2069}\u{200e}\u{200f}\u{61c}", &"\u{fffd}".repeat(7));
        check("\u{200b}\u{200d}\u{2028}\u{2029}\u{2060}\u{feff}\u{e0041}", &"\u{fffd}".repeat(7));
    }

    #[test]
    fn lines_and_styles_are_kept_where_they_are_ours() {
        fn check(text: &str, expected: &str) {
            assert_eq!(printable_styled(text), expected);
        }
        check("a\nb\n", "a\nb\n");
        check("\x1b[1m\x1b[38;5;9merror\x1b[0m: a\n", "\x1b[1m\x1b[38;5;9merror\x1b[0m: a\n");
        check("\x1b[2J\x1b[", "\u{fffd}[2J\u{fffd}[");
        check("\x1b]0;title\x07\x1b[1\nm", "\u{fffd}]0;title\u{fffd}\u{fffd}[1\nm");
        check("\u{9b}1m\r", "\u{fffd}1m\u{fffd}");
    }

    #[test]
    fn json_keeps_its_value() {
        assert_eq!(
            printable_json("{\n  \"é\u{9b}\u{e0041}\": 1\n}"),
            "{\n  \"é\\u009b\\udb40\\udc41\": 1\n}"
        );
    }
}
