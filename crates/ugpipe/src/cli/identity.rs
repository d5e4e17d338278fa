//! Whether two paths lead to one file.

use std::ffi::OsString;
use std::fs::{self, File, Metadata};
use std::os::fd::AsFd;
use std::os::unix::fs::MetadataExt;
use std::path::{Path, PathBuf};

use crate::cli::folder::folder_of;

/// A regular file, existing or to be created. Devices and pipes have no identity: several streams
/// may share them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Identity {
    /// Device and inode.
    Existing(u64, u64),
    /// Device and inode of the folder, and the name in it.
    New(u64, u64, OsString),
}

impl Identity {
    /// The file that a path leads to, links followed. `None` if it is not a regular file, or cannot
    /// be examined.
    pub(crate) fn of_path(path: &Path) -> Option<Self> {
        match fs::metadata(path) {
            Ok(metadata) => Self::of_metadata(&metadata),
            Err(_) => {
                let target = resolve_links(path);
                let folder = fs::metadata(folder_of(&target)).ok()?;
                Some(Self::New(folder.dev(), folder.ino(), target.file_name()?.to_owned()))
            }
        }
    }

    /// The file that a standard stream is redirected to.
    pub(crate) fn of_stream(stream: &impl AsFd) -> Option<Self> {
        let file = File::from(stream.as_fd().try_clone_to_owned().ok()?);
        Self::of_metadata(&file.metadata().ok()?)
    }

    fn of_metadata(metadata: &Metadata) -> Option<Self> {
        metadata.is_file().then(|| Self::Existing(metadata.dev(), metadata.ino()))
    }
}

/// Resolves a chain of symbolic links. The final target need not exist.
pub(crate) fn resolve_links(path: &Path) -> PathBuf {
    /// The limit of Linux. Opening a longer chain fails.
    const MAX_LINKS: usize = 40;
    let mut place = path.to_owned();
    for _ in 0..MAX_LINKS {
        let Ok(next) = fs::read_link(&place) else { break };
        // `join` with an absolute path gives that path.
        place = place.parent().unwrap_or(Path::new("")).join(next);
    }
    place
}

#[cfg(test)]
mod tests {
    use std::os::unix::fs::symlink;

    use super::*;

    #[test]
    fn spellings_of_one_file_are_one() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        fs::create_dir(path("sub")).unwrap();
        fs::write(path("file"), "").unwrap();
        fs::hard_link(path("file"), path("hard")).unwrap();
        symlink("file", path("soft")).unwrap();
        symlink("new", path("dangling")).unwrap();
        let same = |a: &str, b: &str| {
            let [a, b] = [a, b].map(|name| Identity::of_path(&path(name)));
            a.is_some() && a == b
        };
        assert!(same("file", "./sub/../file"));
        assert!(same("file", "hard"));
        assert!(same("file", "soft"));
        assert!(same("new", "sub/../new"));
        assert!(same("new", "dangling"));
        assert!(!same("file", "new"));
        assert!(!same("new", "sub/new"));
        assert_eq!(Identity::of_path(Path::new("/dev/null")), None);
        assert_eq!(Identity::of_path(&path("no/folder")), None);
    }
}
