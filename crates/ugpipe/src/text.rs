//! Text that may come from anywhere, made fit to show.

use std::path::Path;

/// Name of a file for messages. What is not text, or would move the cursor, shows as
/// a replacement character.
pub(crate) fn path(path: &Path) -> String {
    printable(&path.to_string_lossy())
}

/// `text` without control characters.
pub(crate) fn printable(text: &str) -> String {
    text.chars().map(|c| if c.is_control() { char::REPLACEMENT_CHARACTER } else { c }).collect()
}

#[cfg(test)]
mod tests {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;

    use super::*;

    #[test]
    fn names_cannot_move_the_cursor() {
        fn check(name: &[u8], expected: &str) {
            assert_eq!(path(Path::new(OsStr::from_bytes(name))), expected);
        }
        check(b"ship.ug", "ship.ug");
        check("γ.ug".as_bytes(), "γ.ug");
        check(b"a\x1b[2J\n.ug", "a\u{fffd}[2J\u{fffd}.ug");
        check(b"\xff.ug", "\u{fffd}.ug");
    }
}
