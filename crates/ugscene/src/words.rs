//! Numbers and words in messages.

use glam::DVec3;

/// A point as three numbers; very small and very large ones with an exponent.
pub(crate) fn point(p: DVec3) -> String {
    let number = |x: f64| format!("{x:?}").trim_end_matches(".0").to_owned();
    p.to_array().map(number).join(" ")
}

/// Gives an error its messages, by variant.
macro_rules! messages {
    ($error:ty { $($variant:pat => $message:literal $(, $argument:expr)*;)+ }) => {
        impl std::fmt::Display for $error {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                match self {
                    $($variant => write!(f, $message $(, $argument)*),)+
                }
            }
        }

        impl std::error::Error for $error {}
    };
}
pub(crate) use messages;

/// What to do about a character that looks like one of numbers, as word processors write it.
pub fn look_alike(word: &str) -> Option<String> {
    let (c, name) = word.chars().find_map(|c| match c {
        '\u{2212}' => Some((c, "a minus sign of Unicode")),
        '\u{2010}'..='\u{2015}' => Some((c, "a dash")),
        '\u{a0}' | '\u{2007}' | '\u{202f}' => Some((c, "a blank without break")),
        '\u{ff10}'..='\u{ff19}' => Some((c, "a wide digit")),
        _ => None,
    })?;
    Some(format!("`{c}` (U+{:04X}) is {name}: write it as ASCII", u32::from(c)))
}

/// A word for a message: its first 40 characters, and `…` if there are more.
pub fn shorten(word: &str) -> String {
    const MAX: usize = 40;
    match word.char_indices().nth(MAX) {
        Some((end, _)) => format!("{}…", &word[..end]),
        None => word.to_owned(),
    }
}
