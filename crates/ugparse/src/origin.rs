//! The origin of a scene, with which its history begins: the hash and the name of the first input
//! of a pipe.

use std::thread;

use ugscene::recorded;

use crate::token;

/// The input of the first program of a pipe.
#[derive(Clone, Debug)]
pub enum Origin {
    /// The recorded words: `SHA-256 3b1c… ship.ug`, or with the hash of the whole text of a scene
    /// that includes files, `SHA-256 3b1c… including 88d4… fleet.ug`.
    Recorded(String),
    /// An input whose hash has not been computed yet.
    Pending {
        /// Its name, quoted for a shell; `-` for standard input.
        name: String,
        /// The hash of the text alone, if the input is a text with the files that it includes.
        alone: Option<String>,
        /// Computes the SHA-256 of the input, in hexadecimal digits.
        sha256: fn(&[u8]) -> String,
    },
}

impl Origin {
    /// The recorded words for an input of these bytes.
    pub fn words(&self, bytes: &[u8]) -> String {
        match self {
            Self::Recorded(words) => words.clone(),
            Self::Pending { name, alone: None, sha256 } => {
                format!("SHA-256 {} {name}", sha256(bytes))
            }
            Self::Pending { name, alone: Some(alone), sha256 } => {
                format!("SHA-256 {alone} including {} {name}", sha256(bytes))
            }
        }
    }

    /// The origin of a text with the files that it includes. `bytes`: the text alone.
    #[must_use]
    pub fn including(self, bytes: &[u8]) -> Self {
        match self {
            Self::Pending { name, sha256, .. } => {
                Self::Pending { name, alone: Some(sha256(bytes)), sha256 }
            }
            recorded => recorded,
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
    let mut rest = text.trim_ascii_start();
    while let Ok((after, comment)) = token::comment(rest) {
        if str::from_utf8(comment).is_ok_and(|comment| recorded(comment).is_some()) {
            return true;
        }
        rest = after.trim_ascii_start();
    }
    false
}
