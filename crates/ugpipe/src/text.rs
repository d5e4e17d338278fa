//! Makes untrusted text safe to print.

use std::path::Path;

/// The name of a file for messages. Bytes that are not UTF-8, and control characters, become
/// replacement characters.
pub(crate) fn path(path: &Path) -> String {
    printable(&path.to_string_lossy())
}

/// `text` with control characters replaced.
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
