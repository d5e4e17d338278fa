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

/// A word for a message: its first 40 characters, and `…` if there are more.
pub fn shorten(word: &str) -> String {
    const MAX: usize = 40;
    match word.char_indices().nth(MAX) {
        Some((end, _)) => format!("{}…", &word[..end]),
        None => word.to_owned(),
    }
}
