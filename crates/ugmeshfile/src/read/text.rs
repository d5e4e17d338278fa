//! Parses words and numbers of text formats.

use ugscene::shorten;

use crate::error::Problem;

/// Parses a finite number; `what` names its owner for the error message.
pub(super) fn number(word: &str, line: usize, what: &str) -> Result<f64, Problem> {
    word.parse()
        .ok()
        .filter(|number: &f64| number.is_finite())
        .ok_or_else(|| Problem::at(line, format!("`{}` in a {what} is not a finite number", shorten(word))))
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
