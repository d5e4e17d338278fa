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

    /// The names of the PNG files in a folder, which are frames of one film.
    ///
    /// # Errors
    /// The folder cannot be read, or has no numbered PNG files, or those of several films.
    pub(crate) fn in_folder(folder: &Path) -> io::Result<Self> {
        let mut found: Option<Self> = None;
        for name in file_names(folder)? {
            let Some(stem) = name.strip_suffix(".png").filter(|_| !name.starts_with('.')) else { continue };
            let before = stem.trim_end_matches(|digit: char| digit.is_ascii_digit());
            let n_digits = stem.len() - before.len();
            let path = folder.join(before).to_string_lossy().into_owned();
            let names = Self { before: path, n_digits, after: ".png".to_owned() };
            let is_other = found.as_ref().is_some_and(|found| found.before != names.before);
            if n_digits == 0 || is_other {
                return Err(io::Error::other(format!(
                    "it has PNG files beside the frames of one film: name these, as {}/frame_%04d.png",
                    folder.display()
                )));
            }
            // Ascending numbers of different lengths have at least the digits of the shortest.
            found = Some(Self {
                n_digits: found.map_or(n_digits, |found| found.n_digits.min(n_digits)),
                ..names
            });
        }
        found.ok_or_else(|| io::Error::other("it has no numbered PNG files, such as frame_0001.png"))
    }

    /// The numbers of the frames that are there, in ascending order.
    ///
    /// # Errors
    /// The folder cannot be read.
    pub(crate) fn numbers(&self) -> io::Result<Vec<u32>> {
        let first = self.path(1);
        let folder = first.parent().filter(|folder| !folder.as_os_str().is_empty());
        let names = file_names(folder.unwrap_or(Path::new(".")))?;
        let mut numbers: Vec<u32> = names.iter().filter_map(|name| self.number(name)?.parse().ok()).collect();
        numbers.retain(|&number| self.path(number).is_file());
        numbers.sort_unstable();
        numbers.dedup();
        Ok(numbers)
    }

    /// The file of a frame, counted from 1.
    pub fn path(&self, frame: u32) -> PathBuf {
        let Self { before, n_digits, after } = self;
        PathBuf::from(format!("{before}{frame:0n_digits$}{after}"))
    }

    /// The digits in the file name of a frame, without its folder; `None` for other files.
    fn number<'n>(&self, file_name: &'n str) -> Option<&'n str> {
        let before = self.before.rsplit_once('/').map_or(self.before.as_str(), |(_, name)| name);
        let number = file_name.strip_prefix(before)?.strip_suffix(self.after.as_str())?;
        (!number.is_empty() && number.bytes().all(|byte| byte.is_ascii_digit())).then_some(number)
    }

    /// True for the file name of a frame, without its folder.
    pub fn is_one(&self, file_name: &str) -> bool {
        self.number(file_name).is_some()
    }

    /// The name of the film: that of its frames without their number.
    pub(crate) fn name(&self) -> String {
        let before = self.before.trim_end_matches(['_', '-', '.', '/']);
        before.rsplit('/').next().unwrap_or_default().to_owned()
    }
}

fn file_names(folder: &Path) -> io::Result<Vec<String>> {
    let names = fs::read_dir(folder)?.map(|entry| Ok(entry?.file_name().to_string_lossy().into_owned()));
    names.collect()
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
