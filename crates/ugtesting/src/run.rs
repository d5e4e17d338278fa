//! Runs programs in tests, with text or bytes on their standard input.

use std::io::Write;
use std::os::unix::process::ExitStatusExt;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::thread;

/// A program that a test runs.
#[derive(Clone, Debug)]
pub struct BuiltProgram {
    path: &'static str,
    folder: Option<PathBuf>,
}

impl BuiltProgram {
    /// The program at `path`, which cargo passes to tests: `env!("CARGO_BIN_EXE_ugrainbow")`.
    pub const fn new(path: &'static str) -> Self {
        Self { path, folder: None }
    }

    /// The same, run in a folder.
    #[must_use]
    pub fn in_folder(&self, folder: impl AsRef<Path>) -> Self {
        Self { folder: Some(folder.as_ref().to_owned()), ..*self }
    }

    /// The program with arguments as a line, without streams. Blanks separate arguments, except
    /// between single quotes.
    pub fn command(&self, args: &str) -> Command {
        let mut command = Command::new(self.path);
        for (idx, part) in args.split('\'').enumerate() {
            match idx % 2 {
                0 => command.args(part.split_whitespace()),
                _ => command.arg(part),
            };
        }
        command.current_dir(self.folder.as_deref().unwrap_or(Path::new(".")));
        command
    }

    /// Runs it with `input` on its standard input.
    ///
    /// # Panics
    /// It cannot be started.
    #[track_caller]
    pub fn run(&self, args: &str, input: impl AsRef<[u8]>) -> Output {
        fed(&mut self.command(args), input)
    }

    /// The standard output of a run that has to succeed.
    ///
    /// # Panics
    /// It fails.
    #[track_caller]
    pub fn output(&self, args: &str, input: impl AsRef<[u8]>) -> Vec<u8> {
        let output = self.run(args, input);
        assert_eq!(output.status.code(), Some(0), "{args}: {}", messages(&output));
        output.stdout
    }

    /// [`output`](Self::output) as text.
    ///
    /// # Panics
    /// It fails, or its output is not UTF-8.
    #[track_caller]
    pub fn text(&self, args: &str, input: impl AsRef<[u8]>) -> String {
        String::from_utf8(self.output(args, input))
            .unwrap_or_else(|error| panic!("{args}: {error}"))
    }

    /// The messages of a run that has to succeed.
    ///
    /// # Panics
    /// It fails.
    #[track_caller]
    pub fn notes(&self, args: &str, input: impl AsRef<[u8]>) -> String {
        let output = self.run(args, input);
        assert_eq!(output.status.code(), Some(0), "{args}: {}", messages(&output));
        messages(&output)
    }

    /// Asserts that a run fails with this status and a message that contains `expected`, and
    /// nothing on standard output.
    ///
    /// # Panics
    /// It does not.
    #[track_caller]
    pub fn refuses(&self, args: &str, input: impl AsRef<[u8]>, status: i32, expected: &str) {
        let output = self.run(args, input);
        let messages = messages(&output);
        assert_eq!(output.status.code(), Some(status), "{args}: {messages}");
        assert!(output.stdout.is_empty(), "{args}");
        assert!(messages.contains(expected), "{args}: {messages}");
    }

    /// Asserts that two spellings of the same options give the same output.
    ///
    /// # Panics
    /// One of them fails, or they do not.
    #[track_caller]
    pub fn same(&self, args: &str, others: &str, input: impl AsRef<[u8]>) {
        let [one, other] = [args, others].map(|args| self.output(args, &input));
        assert!(!one.is_empty() && one == other, "{args}");
    }

    /// Asserts that SIGPIPE ends the program, without a message, when nobody reads its output.
    ///
    /// # Panics
    /// It ends otherwise.
    #[track_caller]
    pub fn ends_at_a_closed_pipe(&self, args: &str, input: impl AsRef<[u8]>) {
        const SIGPIPE: i32 = 13;
        let (reader, writer) = std::io::pipe().unwrap_or_else(|error| panic!("{error}"));
        drop(reader);
        let output = fed_as_it_is(self.command(args).stdout(writer).stderr(Stdio::piped()), input);
        assert_eq!((output.status.signal(), messages(&output).as_str()), (Some(SIGPIPE), ""));
    }
}

/// Runs a program with `input` on its standard input, and returns what it writes.
///
/// # Panics
/// The program cannot be started.
#[track_caller]
pub fn fed(command: &mut Command, input: impl AsRef<[u8]>) -> Output {
    fed_as_it_is(command.stdout(Stdio::piped()).stderr(Stdio::piped()), input)
}

/// Runs a program as [`fed`] does, but leaves its standard output and standard error as the command
/// sets them.
///
/// # Panics
/// See [`fed`].
#[track_caller]
pub fn fed_as_it_is(command: &mut Command, input: impl AsRef<[u8]>) -> Output {
    command.stdin(Stdio::piped());
    let mut child = command.spawn().unwrap_or_else(|error| panic!("{command:?}: {error}"));
    let mut stdin = child.stdin.take();
    let input = input.as_ref();
    // On another thread, so that no pipe fills up.
    thread::scope(|scope| {
        // A program that refuses its command line ends without reading.
        scope.spawn(move || stdin.as_mut().map(|stdin| stdin.write_all(input)));
        child.wait_with_output().unwrap_or_else(|error| panic!("{command:?}: {error}"))
    })
}

/// The messages of a program.
///
/// # Panics
/// They are not UTF-8.
#[track_caller]
pub fn messages(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap_or_else(|error| panic!("{error}"))
}
