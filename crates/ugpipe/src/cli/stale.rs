//! Deletes what killed processes have left.
//!
//! Files that a process works on are locked by it. The system removes the lock with the process,
//! however it ends.

use std::fs::{self, File};
use std::path::Path;

/// Deletes the files in a folder that no process has locked, of those whose names `is_ours` admits.
pub fn remove(folder: &Path, is_ours: impl Fn(&str) -> bool) {
    // What cannot be read or deleted stays: it may be that of another person.
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let is_ours = entry.file_name().to_str().is_some_and(&is_ours);
        if is_ours
            && entry.file_type().is_ok_and(|kind| kind.is_file())
            && File::open(entry.path()).is_ok_and(|file| file.try_lock().is_ok())
        {
            let _ = fs::remove_file(entry.path());
        }
    }
}

/// Locks a file that was just created. False if it is to be created anew, since another process
/// deletes it. Where files cannot be locked they are not deleted either.
#[cfg(unix)]
pub(crate) fn lock(file: &File) -> bool {
    use std::fs::TryLockError;
    use std::os::unix::fs::MetadataExt;
    match file.try_lock() {
        Ok(()) => file.metadata().is_ok_and(|metadata| metadata.nlink() > 0),
        Err(TryLockError::WouldBlock) => false,
        Err(TryLockError::Error(_)) => true,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_in_use_and_those_of_others_stay() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        let used = File::create(path("ours-used")).unwrap();
        assert!(lock(&used));
        fs::write(path("ours-left"), "half").unwrap();
        fs::write(path("yours"), "whole").unwrap();
        fs::create_dir(path("ours-folder")).unwrap();
        remove(folder.path(), |name| name.starts_with("ours"));
        let names = || {
            let names =
                fs::read_dir(folder.path()).unwrap().map(|entry| entry.unwrap().file_name());
            let mut names: Vec<String> = names.map(|name| name.into_string().unwrap()).collect();
            names.sort();
            names
        };
        assert_eq!(names(), ["ours-folder", "ours-used", "yours"]);
        // `drop` may leave it locked: a process that another test starts has the file open, too,
        // until it runs its program.
        used.unlock().unwrap();
        remove(folder.path(), |name| name.starts_with("ours"));
        assert_eq!(names(), ["ours-folder", "yours"]);
    }
}
