//! The output: standard output, or a file that is replaced atomically.

use std::ffi::OsString;
use std::fs::{File, OpenOptions, Permissions};
use std::io::{self, BufWriter, IsTerminal, Write};
use std::os::fd::AsFd;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};

use crate::cli::at_start::require_stdout;
use crate::cli::cleanup::{PREFIX, Temporary};
use crate::cli::failure::Failure;
use crate::cli::folder::folder_of;
use crate::cli::identity::resolve_links;

/// An output. If it is dropped without [`Output::finish`], no file is left behind.
pub(crate) struct Output {
    /// `None` is standard output.
    path: Option<PathBuf>,
    /// Opened by the first write.
    sink: Option<Sink>,
}

enum Sink {
    Stdout,
    /// A device or named pipe, which is written to directly.
    Device(File),
    /// A temporary file in the target's folder, to be renamed to the target.
    Temporary {
        temporary: Temporary,
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

    pub(crate) fn is_terminal(&self) -> bool {
        self.path.is_none() && io::stdout().is_terminal()
    }

    /// Writes the data that `fill` produces.
    pub(crate) fn write_with(
        &mut self,
        fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), Failure> {
        self.try_write(fill).map_err(|error| self.failure(error))
    }

    /// Creates the temporary file, or opens the device, and gives its name; `None` for standard
    /// output.
    pub(crate) fn temporary_name(&mut self) -> Result<Option<PathBuf>, Failure> {
        self.write_with(|_| Ok(()))?;
        Ok(match &mut self.sink {
            Some(Sink::Temporary { temporary, .. }) => Some(temporary.path().to_owned()),
            Some(Sink::Device(_)) => self.path.clone(),
            Some(Sink::Stdout) | None => None,
        })
    }

    /// Renames the temporary file to its target.
    pub(crate) fn finish(&mut self) -> Result<(), Failure> {
        match self.sink.take() {
            Some(Sink::Temporary { temporary, target }) => {
                temporary.persist(&target).map_err(|error| self.failure(error))
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
        let name = self
            .path
            .as_ref()
            .map_or_else(|| "<stdout>".to_owned(), |path| path.display().to_string());
        Failure::Write { name, error }
    }
}

impl Sink {
    fn open(path: Option<&Path>) -> io::Result<Self> {
        let Some(path) = path else { return require_stdout().map(|()| Self::Stdout) };
        // Opening an existing file for writing checks the permissions and distinguishes files from
        // devices without a race. It neither creates nor truncates anything.
        match OpenOptions::new().write(true).open(path) {
            Ok(existing) => {
                let metadata = existing.metadata()?;
                if metadata.is_file() {
                    Self::temporary(path, Some(metadata.permissions()))
                } else {
                    Ok(Self::Device(existing))
                }
            }
            Err(error) if error.kind() == io::ErrorKind::NotFound => Self::temporary(path, None),
            Err(error) => Err(error),
        }
    }

    /// Creates the temporary file, in the target's folder because renaming is atomic only within a
    /// file system. It has the permissions of the file that it replaces, or for a new file those of
    /// the user's umask.
    fn temporary(path: &Path, permissions: Option<Permissions>) -> io::Result<Self> {
        let target = resolve_links(path);
        let all_may = Permissions::from_mode(0o666);
        let temporary = Temporary::new(&target, || {
            let mut builder = tempfile::Builder::new();
            let ending = target.extension().map_or_else(OsString::new, |ending| {
                let mut with_point = OsString::from(".");
                with_point.push(ending);
                with_point
            });
            builder.prefix(PREFIX).suffix(&ending).permissions(all_may.clone());
            let file = builder.tempfile_in(folder_of(&target))?;
            if let Some(permissions) = &permissions {
                file.as_file().set_permissions(permissions.clone())?;
            }
            Ok(file)
        })?;
        Ok(Self::Temporary { temporary, target })
    }

    fn write_with(
        &mut self,
        fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> io::Result<()> {
        match self {
            Self::Stdout => {
                // `io::Stdout` hides the error of a descriptor that is not open for writing; a
                // file returns it.
                let stdout = File::from(io::stdout().as_fd().try_clone_to_owned()?);
                let mut stdout = BufWriter::new(stdout);
                fill(&mut stdout)?;
                stdout.flush()
            }
            Self::Device(file) => fill(file),
            Self::Temporary { temporary, .. } => fill(temporary.file_mut()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Never calls [`Output::finish`]: if this code had a bug, tests run as root would replace the
    /// device.
    #[test]
    fn devices_are_written_to_and_not_replaced() {
        assert!(matches!(Sink::open(Some(Path::new("/dev/null"))), Ok(Sink::Device(_))));
        let failure = Output::new(Some(Path::new("/dev/full")))
            .write_with(|out| out.write_all(b"scene"))
            .unwrap_err();
        assert_eq!(failure.to_string(), "cannot write `/dev/full`: No space left on device");
    }
}
