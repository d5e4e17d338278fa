//! Parses words and numbers of text formats.

use std::borrow::Cow;

use crate::error::Problem;

/// The text of a file. Bytes that are not UTF-8 are replaced; they should occur only in comments
/// and names.
pub(super) fn decode(bytes: &[u8]) -> Cow<'_, str> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    String::from_utf8_lossy(bytes)
}

/// Parses a finite number; `what` names its owner for the error message.
pub(super) fn number(word: &str, line: usize, what: &str) -> Result<f64, Problem> {
    fast_float2::parse(word)
        .ok()
        .filter(|number: &f64| number.is_finite())
        .ok_or_else(|| Problem::at(line, format!("`{word}` in a {what} is not a finite number")))
}

/// Parses the first `N` words as numbers.
pub(super) fn numbers<'a, const N: usize>(
    words: &mut impl Iterator<Item = &'a str>,
    line: usize,
    what: &str,
) -> Result<[f64; N], Problem> {
    let mut values = [0.0; N];
    for value in &mut values {
        let word =
            words.next().ok_or_else(|| Problem::at(line, format!("a {what} needs {N} numbers or more")))?;
        *value = number(word, line, what)?;
    }
    Ok(values)
}
