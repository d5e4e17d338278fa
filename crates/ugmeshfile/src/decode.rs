//! Decodes the bytes of text formats.

use std::borrow::Cow;

/// The text of a file. Bytes that are not UTF-8 are replaced; they should occur only in comments
/// and names. A carriage return alone ends a line, as on old Macintoshes.
pub(crate) fn decode(bytes: &[u8]) -> Cow<'_, str> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let text = String::from_utf8_lossy(bytes);
    if has_lone_return(&text) {
        text.replace("\r\n", "\n").replace('\r', "\n").into()
    } else {
        text
    }
}

/// True if a carriage return is not the first byte of CRLF.
fn has_lone_return(text: &str) -> bool {
    text.match_indices('\r').any(|(idx, _)| text.as_bytes().get(idx + 1) != Some(&b'\n'))
}
