//! The output: standard output, or a file that appears whole or not at all.

use std::fs::{self, File, OpenOptions, Permissions};
use std::io::{self, IsTerminal, Write};
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

use crate::failure::Failure;
use crate::text;

/// Where the output goes. Dropped without [`Output::finish`], it leaves no file behind.
pub(crate) struct Output {
    /// None is standard output.
    path: Option<PathBuf>,
    /// Open since the first write.
    sink: Option<Sink>,
}

enum Sink {
    Stdout,
    /// A device or named pipe, which cannot be replaced.
    Device(File),
    /// A file beside the target, to be renamed.
    Beside {
        temporary: NamedTempFile,
        target: PathBuf,
    },
}

impl Output {
    pub(crate) fn new(path: Option<&Path>) -> Self {
        Self { path: path.map(Path::to_owned), sink: None }
    }

    pub(crate) fn path(&self) -> Option<&Path> {
        self.path.as_deref()
    }

    pub(crate) fn set_path(&mut self, path: &Path) {
        *self = Self::new(Some(path));
    }

    pub(crate) fn is_terminal(&self) -> bool {
        self.path.is_none() && io::stdout().is_terminal()
    }

    /// Writes what `fill` sends.
    pub(crate) fn write_with(
        &mut self,
        fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), Failure> {
        self.try_write(fill).map_err(|error| self.failure(error))
    }

    /// Puts the file in its place.
    pub(crate) fn finish(&mut self) -> Result<(), Failure> {
        match self.sink.take() {
            Some(Sink::Beside { temporary, target }) => {
                temporary.persist(target).map(drop).map_err(|error| self.failure(error.error))
            }
            _ => Ok(()),
        }
    }

    fn try_write(&mut self, fill: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
        let sink = match self.sink.take() {
            Some(sink) => sink,
            None => Sink::open(self.path.as_deref())?,
        };
        self.sink.insert(sink).write_with(fill)
    }

    fn failure(&self, error: io::Error) -> Failure {
        let name = self.path.as_deref().map_or_else(|| "<stdout>".to_owned(), text::path);
        Failure::Write { name, error }
    }
}

impl Sink {
    fn open(path: Option<&Path>) -> io::Result<Self> {
        let Some(path) = path else { return Ok(Self::Stdout) };
        // Opening what is there for writing asks the system whether we may, and tells
        // files from devices without a race. Nothing is created or cut off by it.
        match OpenOptions::new().write(true).open(path) {
            Ok(existing) => {
                let metadata = existing.metadata()?;
                if metadata.is_file() {
                    Self::beside(path, Some(metadata.permissions()))
                } else {
                    Ok(Self::Device(existing))
                }
            }
            Err(error) if error.kind() == io::ErrorKind::NotFound => Self::beside(path, None),
            Err(error) => Err(error),
        }
    }

    /// Makes the temporary file, in the target's folder because only there is
    /// renaming atomic. It has the permissions of the file it replaces; a new one
    /// gets what the user's umask leaves.
    fn beside(path: &Path, permissions: Option<Permissions>) -> io::Result<Self> {
        let target = without_links(path);
        let folder = match target.parent() {
            Some(parent) if !parent.as_os_str().is_empty() => parent,
            _ => Path::new("."),
        };
        let all_may = Permissions::from_mode(0o666);
        let temporary = tempfile::Builder::new().prefix(".ug-").permissions(all_may).tempfile_in(folder)?;
        if let Some(permissions) = permissions {
            temporary.as_file().set_permissions(permissions)?;
        }
        Ok(Self::Beside { temporary, target })
    }

    fn write_with(&mut self, fill: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
        match self {
            Self::Stdout => {
                let mut stdout = io::stdout().lock();
                fill(&mut stdout)?;
                stdout.flush()
            }
            Self::Device(file) => fill(file),
            Self::Beside { temporary, .. } => fill(temporary.as_file_mut()),
        }
    }
}

/// The place a chain of symbolic links leads to, whether or not something is there.
fn without_links(path: &Path) -> PathBuf {
    /// As many as Linux follows; opening a longer chain has failed before.
    const MAX_LINKS: usize = 40;
    let mut place = path.to_owned();
    for _ in 0..MAX_LINKS {
        let Ok(next) = fs::read_link(&place) else { break };
        // An absolute link replaces the folder it is joined to.
        place = place.parent().unwrap_or(Path::new("")).join(next);
    }
    place
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Never calls [`Output::finish`]: with a bug here, root would replace the device.
    #[test]
    fn devices_are_written_to_and_stay() {
        assert!(matches!(Sink::open(Some(Path::new("/dev/null"))), Ok(Sink::Device(_))));
        let failure =
            Output::new(Some(Path::new("/dev/full"))).write_with(|out| out.write_all(b"scene")).unwrap_err();
        assert_eq!(failure.to_string(), "cannot write `/dev/full`: No space left on device");
    }
}
