//! Numbers and words in messages.

use glam::DVec3;

/// A point as three numbers; very small and very large ones with an exponent.
pub(crate) fn point(p: DVec3) -> String {
    let number = |x: f64| format!("{x:?}").trim_end_matches(".0").to_owned();
    p.to_array().map(number).join(" ")
}

/// A word for a message: its first 40 characters, and `…` if there are more.
pub fn shorten(word: &str) -> String {
    const MAX: usize = 40;
    match word.char_indices().nth(MAX) {
        Some((end, _)) => format!("{}…", &word[..end]),
        None => word.to_owned(),
    }
}
