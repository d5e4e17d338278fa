//! Parses words and numbers of text formats.

use std::iter::Enumerate;
use std::str::{Lines, SplitWhitespace};

use ugpipe::remedies::look_alike;
use ugscene::shorten;

use crate::error::Problem;

/// The words of a text, without comments from `#` to the end of the line.
#[derive(Clone)]
pub(super) struct Words<'t> {
    lines: Enumerate<Lines<'t>>,
    rest: SplitWhitespace<'t>,
    /// The line of the last word, from 1.
    pub line: usize,
}

impl<'t> Words<'t> {
    pub fn new(text: &'t str) -> Self {
        Self { lines: text.lines().enumerate(), rest: "".split_whitespace(), line: 0 }
    }

    /// The next word in the line of the last word.
    pub fn next_in_line(&mut self) -> Option<&'t str> {
        self.rest.next()
    }

    /// The words that are left in the line of the last word.
    pub fn rest_of_line(&mut self) -> SplitWhitespace<'t> {
        std::mem::replace(&mut self.rest, "".split_whitespace())
    }
}

impl<'t> Iterator for Words<'t> {
    type Item = &'t str;

    fn next(&mut self) -> Option<&'t str> {
        loop {
            if let Some(word) = self.rest.next() {
                return Some(word);
            }
            let (idx, line) = self.lines.next()?;
            self.rest = line.split('#').next().unwrap_or_default().split_whitespace();
            self.line = idx + 1;
        }
    }
}

/// The number of a word, as all readers of text understand it; NaN in each of its spellings.
pub(super) fn any_number(word: &str) -> Option<f64> {
    let is_nan = || {
        let word = word.to_ascii_lowercase();
        ["nan", "#ind", "#qnan", "#snan"].iter().any(|nan| word.contains(nan)).then_some(f64::NAN)
    };
    word.parse().ok().or_else(is_nan)
}

/// Parses a finite number; `what` names its owner for the error message.
pub(super) fn number(word: &str, line: usize, what: &str) -> Result<f64, Problem> {
    any_number(word)
        .filter(|number| number.is_finite())
        .ok_or_else(|| not_a_number(word, line, &format!("in a {what} is not a finite number")))
}

/// The problem with a word in the place of a number.
pub(super) fn not_a_number(word: &str, line: usize, what: &str) -> Problem {
    let remedy = look_alike(word).map(|remedy| format!("; {remedy}")).unwrap_or_default();
    Problem::at(line, format!("`{}` {what}{remedy}", shorten(word)))
}

/// Parses the next `N` words as numbers.
pub(super) fn numbers<'a, const N: usize>(
    words: &mut impl Iterator<Item = &'a str>,
    line: usize,
    what: &str,
) -> Result<[f64; N], Problem> {
    let mut values = [0.0; N];
    for value in &mut values {
        let word = words
            .next()
            .ok_or_else(|| Problem::at(line, format!("a {what} needs {N} numbers or more")))?;
        *value = number(word, line, what)?;
    }
    Ok(values)
}
