//! The origin of a scene, with which its history begins: the hash and the name of what the first
//! program of a pipe read.

use std::thread;

use ugscene::recorded;

use crate::token;

/// The input of a program that records it.
#[derive(Clone, Debug)]
pub enum Origin {
    /// The recorded words: `SHA-256 3b1c… ship.ug`.
    Recorded(String),
    /// An input whose hash has not been computed yet.
    Pending {
        /// Its name, quoted for a shell; `-` for standard input.
        name: String,
        /// Computes the SHA-256 of the input, in hexadecimal digits.
        sha256: fn(&[u8]) -> String,
    },
}

impl Origin {
    /// The recorded words for an input of these bytes.
    pub fn words(&self, bytes: &[u8]) -> String {
        match self {
            Self::Recorded(words) => words.clone(),
            Self::Pending { name, sha256 } => format!("SHA-256 {} {name}", sha256(bytes)),
        }
    }
}

/// Does some work with an input, on this thread, and computes the words for its origin meanwhile.
pub fn with_origin<T>(
    origin: Option<&Origin>,
    bytes: &[u8],
    work: impl FnOnce() -> T,
) -> (T, Option<String>) {
    /// Below this number of bytes, starting a thread takes as long as computing the hash.
    const FEW: usize = 1 << 16;
    let Some(origin) = origin else { return (work(), None) };
    if bytes.len() < FEW {
        return (work(), Some(origin.words(bytes)));
    }
    thread::scope(|scope| {
        let hashing = thread::Builder::new().spawn_scoped(scope, || origin.words(bytes));
        let done = work();
        let words = hashing.ok().and_then(|thread| thread.join().ok());
        (done, Some(words.unwrap_or_else(|| origin.words(bytes))))
    })
}

/// True if a text begins with comments of which one was recorded by a program.
pub fn has_history(text: &[u8]) -> bool {
    head(text).0
}

/// Whether the comments at the head of a text have a history, and what follows them.
pub(crate) fn head(text: &[u8]) -> (bool, &[u8]) {
    let mut rest = text.trim_ascii_start();
    let mut has_history = false;
    while let Ok((after, comment)) = token::comment(rest) {
        has_history |= str::from_utf8(comment).is_ok_and(|comment| recorded(comment).is_some());
        rest = after.trim_ascii_start();
    }
    (has_history, rest)
}
