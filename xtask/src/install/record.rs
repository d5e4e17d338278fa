//! The record of what was installed, by which it is uninstalled.

use std::collections::BTreeSet;
use std::fs;
use std::io::{self, ErrorKind, Write};
use std::path::{Component, Path};

/// The file of the record, below the prefix.
pub const FILE: &str = "share/doc/ugtools/installed.txt";

/// The files that were written and the folders that were made, below the prefix. Folders end with
/// a slash.
#[derive(Debug, Default)]
pub struct Record(BTreeSet<String>);

impl Record {
    /// Reads the record of an earlier installation; empty if there is none.
    pub fn read(prefix: &Path) -> io::Result<Self> {
        let text = match fs::read_to_string(prefix.join(FILE)) {
            Err(error) if error.kind() == ErrorKind::NotFound => return Ok(Self::default()),
            text => text?,
        };
        let is_below = |line: &str| {
            let parts = Path::new(line).components();
            !line.is_empty() && parts.into_iter().all(|part| matches!(part, Component::Normal(_)))
        };
        if let Some(line) = text.lines().find(|line| !is_below(line)) {
            let message =
                format!("{}: `{line}` is not a path below the prefix", prefix.join(FILE).display());
            return Err(io::Error::new(ErrorKind::InvalidData, message));
        }
        Ok(Self(text.lines().map(str::to_owned).collect()))
    }

    /// Adds a file, and the folders above it that are not there yet.
    pub fn add(&mut self, prefix: &Path, file: &str) {
        let folders = file.match_indices('/').map(|(end, _)| &file[..=end]);
        self.0.extend(folders.filter(|folder| !prefix.join(folder).exists()).map(str::to_owned));
        self.0.insert(file.to_owned());
    }

    /// The text of its file.
    pub fn text(&self) -> String {
        self.0.iter().map(|path| format!("{path}\n")).collect()
    }
}

/// Removes the files of an installation, and the folders that it made and that are empty then.
/// Prints their names.
pub fn remove(out: &mut impl Write, prefix: &Path) -> io::Result<()> {
    let Record(paths) = Record::read(prefix)?;
    if paths.is_empty() {
        let message = format!("nothing was installed in {}: it has no {FILE}", prefix.display());
        return Err(io::Error::new(ErrorKind::NotFound, message));
    }
    // The record goes last, so an interrupted removal can be repeated.
    let files =
        paths.iter().filter(|path| !path.ends_with('/') && *path != FILE).map(String::as_str);
    for file in files.chain([FILE]).map(|file| prefix.join(file)) {
        match fs::remove_file(&file) {
            Err(error) if error.kind() == ErrorKind::NotFound => {}
            Err(error) => {
                return Err(io::Error::new(error.kind(), format!("{}: {error}", file.display())));
            }
            Ok(()) => writeln!(out, "{}", file.display())?,
        }
    }
    // Folders sort before what is in them.
    for folder in
        paths.iter().rev().filter(|path| path.ends_with('/')).map(|folder| prefix.join(folder))
    {
        match fs::remove_dir(&folder) {
            Err(error)
                if [ErrorKind::NotFound, ErrorKind::DirectoryNotEmpty].contains(&error.kind()) => {}
            Err(error) => {
                return Err(io::Error::new(error.kind(), format!("{}: {error}", folder.display())));
            }
            Ok(()) => writeln!(out, "{}", folder.display())?,
        }
    }
    Ok(())
}
