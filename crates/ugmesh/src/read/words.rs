//! Lines of text formats, as words and numbers.

use std::borrow::Cow;

use crate::error::Problem;

/// The text of a file; bytes that are not UTF-8 stand in comments and names only.
pub(super) fn text(bytes: &[u8]) -> Cow<'_, str> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    String::from_utf8_lossy(bytes)
}

/// A number; `what` says what it belongs to.
pub(super) fn number(word: &str, line: usize, what: &str) -> Result<f64, Problem> {
    fast_float2::parse(word)
        .ok()
        .filter(|number: &f64| number.is_finite())
        .ok_or_else(|| Problem::at(line, format!("`{word}` in a {what} is not a finite number")))
}

/// The first `N` words as numbers.
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
