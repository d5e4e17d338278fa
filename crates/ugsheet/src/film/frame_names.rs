//! Names of numbered files.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

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

    /// The names that a path stands for; `None` if it has no number, or is that of a file itself.
    pub fn of_path(path: &Path) -> Option<Self> {
        Self::new(path.to_str()?).filter(|_| !path.exists())
    }

    /// The numbers of the files that there are, in ascending order.
    ///
    /// # Errors
    /// The folder cannot be read.
    pub fn numbers_found(&self) -> io::Result<Vec<u32>> {
        let first = self.path(1);
        let folder = first.parent().filter(|folder| !folder.as_os_str().is_empty());
        let mut numbers = Vec::new();
        for entry in fs::read_dir(folder.unwrap_or(Path::new(".")))? {
            let path = entry?.path();
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            // With more or fewer zeros it is another file.
            let is_own = |number: &u32| self.path(*number).ends_with(&*name);
            numbers.extend(self.number(&name).filter(is_own).filter(|_| path.is_file()));
        }
        numbers.sort_unstable();
        Ok(numbers)
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

    #[test]
    fn files_are_found_by_their_names() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        let names = ["f_10.png", "f_2.png", "f_03.png", "f_x.png", "g_1.png", "f_4294967295.png"];
        names.iter().for_each(|name| fs::write(path(name), "").unwrap());
        fs::create_dir(path("f_7.png")).unwrap();
        let found = |pattern: &str| {
            FrameNames::of_path(&path(pattern)).map(|names| names.numbers_found().unwrap())
        };
        assert_eq!(found("f_%d.png"), Some(vec![2, 10, u32::MAX]));
        assert_eq!(found("f_%02d.png"), Some(vec![3, 10, u32::MAX]));
        assert_eq!(found("h_%d.png"), Some(vec![]));
        fs::write(path("f_%d.png"), "").unwrap();
        assert_eq!(found("f_%d.png"), None);
        assert!(FrameNames::new("no/such/%d").unwrap().numbers_found().is_err());
    }
}
