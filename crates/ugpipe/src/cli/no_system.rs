//! The system where there is none, as in a browser. Programs run in memory
//! ([`crate::Context::in_memory`]); everything else is an error.

use std::io;

fn unsupported<T>() -> io::Result<T> {
    Err(io::Error::new(io::ErrorKind::Unsupported, "There is no system here"))
}

pub(crate) mod cleanup {
    use std::io;
    use std::path::Path;
    use std::process::{Child, Command};

    /// A file that marks what one process works on: there is only one.
    pub struct Claim(());

    /// False: there are no files.
    pub fn is_occupied(_path: &Path) -> bool {
        false
    }

    impl Claim {
        /// The claim.
        pub fn new(_path: &Path) -> Option<Self> {
            Some(Self(()))
        }
    }

    /// A running program, of which there are none.
    pub struct Running(Child);

    impl Running {
        /// Fails.
        ///
        /// # Errors
        /// There are no programs.
        pub fn spawn(_command: &mut Command) -> io::Result<Self> {
            super::unsupported()
        }

        /// The program.
        pub fn child_mut(&mut self) -> &mut Child {
            &mut self.0
        }

        /// Ends the program.
        pub fn stop(&self) {}
    }
}

pub(crate) mod output {
    use std::io::{self, Write};
    use std::path::{Path, PathBuf};

    use crate::cli::failure::Failure;

    /// An output, which cannot be written.
    pub(crate) struct Output(Option<PathBuf>);

    impl Output {
        pub(crate) fn new(path: Option<&Path>) -> Self {
            Self(path.map(Path::to_owned))
        }

        pub(crate) fn path(&self) -> Option<&Path> {
            self.0.as_deref()
        }

        pub(crate) fn is_terminal(&self) -> bool {
            false
        }

        pub(crate) fn write_with(
            &mut self,
            _fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
        ) -> Result<(), Failure> {
            let name =
                self.path().map_or_else(|| "-".to_owned(), |path| path.display().to_string());
            super::unsupported().map_err(|error| Failure::Write { name, error })
        }

        pub(crate) fn temporary_name(&mut self) -> Result<Option<PathBuf>, Failure> {
            Ok(None)
        }

        pub(crate) fn finish(&mut self) -> Result<(), Failure> {
            Ok(())
        }
    }
}

pub(crate) mod run {
    use std::process::ExitCode;

    use crate::cli::args::ToolArgs;
    use crate::cli::context::Context;
    use crate::cli::failure::Failure;

    /// Fails: no program is started here.
    pub fn main<A: ToolArgs>(
        _run: impl FnOnce(&A, &mut Context) -> Result<(), Failure>,
    ) -> ExitCode {
        ExitCode::FAILURE
    }
}

pub(crate) mod steps {
    use std::marker::PhantomData;

    use crate::cli::messages::Messages;
    use crate::progress::Progress;

    /// Shows no progress.
    pub struct Steps<'m>(PhantomData<&'m Messages>);

    impl<'m> Steps<'m> {
        pub(crate) fn new(_messages: &'m Messages) -> Self {
            Self(PhantomData)
        }

        /// Begins a step whose parts count for the user.
        pub fn count(&self, _name: &'static str, _parts: u64) {}
    }

    impl Progress for Steps<'_> {
        fn step(&self, _name: &'static str, _parts: u64) {}

        fn done(&self, _parts: u64) {}
    }
}
