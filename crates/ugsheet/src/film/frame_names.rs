//! Names of numbered files.

use std::path::PathBuf;

/// Names of numbered files: `frame_%04d.png`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FrameNames {
    before: String,
    n_digits: usize,
    after: String,
}

impl Default for FrameNames {
    /// `frame_%04d.png`.
    fn default() -> Self {
        Self { before: "frame_".to_owned(), n_digits: 4, after: ".png".to_owned() }
    }
}

impl FrameNames {
    /// Names with a number in place of `%d`, or of `%04d` with at least as many digits. `None` if
    /// there is no such place.
    pub fn new(pattern: &str) -> Option<Self> {
        let (before, rest) = pattern.split_once('%')?;
        let (digits, after) = rest.split_once('d')?;
        let is_width = digits.bytes().all(|byte| byte.is_ascii_digit()) && digits.len() <= 2;
        let n_digits = if digits.is_empty() { 1 } else { digits.parse().ok()? };
        is_width.then(|| Self { before: before.to_owned(), n_digits, after: after.to_owned() })
    }

    /// The file of a frame, counted from 1.
    pub fn path(&self, frame: u32) -> PathBuf {
        let Self { before, n_digits, after } = self;
        PathBuf::from(format!("{before}{frame:0n_digits$}{after}"))
    }

    /// The number in the file name of a frame, without its folder; `None` for other files.
    pub fn number(&self, file_name: &str) -> Option<u32> {
        let before = self.before.rsplit_once('/').map_or(self.before.as_str(), |(_, name)| name);
        let number = file_name.strip_prefix(before)?.strip_suffix(self.after.as_str())?;
        number.bytes().all(|byte| byte.is_ascii_digit()).then(|| number.parse().ok())?
    }

    /// The name of the film: that of its frames without their number.
    pub(crate) fn name(&self) -> String {
        let before = self.before.trim_end_matches(['_', '-', '.', '/']);
        before.rsplit('/').next().unwrap_or_default().to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_have_the_number_in_their_place() {
        let name = |pattern: &str| Some(FrameNames::new(pattern)?.path(7).display().to_string());
        assert_eq!(name("f_%04d.png").as_deref(), Some("f_0007.png"));
        assert_eq!(name("a/%d.exr").as_deref(), Some("a/7.exr"));
        assert_eq!(FrameNames::new("%02d").unwrap().path(12345), PathBuf::from("12345"));
        for pattern in ["film.png", "f_%4x.png", "f%.png", "%123d", "%-4d"] {
            assert_eq!(name(pattern), None, "{pattern}");
        }
    }
}
