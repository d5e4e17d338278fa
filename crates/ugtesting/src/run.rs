//! Runs programs in tests, with text or bytes on their standard input.

use std::io::Write;
use std::process::{Command, Output, Stdio};
use std::thread;

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

/// Runs a program that has to fail with this status and a message that contains `expected`, and
/// nothing on standard output.
///
/// # Panics
/// It does not.
#[track_caller]
pub fn assert_refused(command: &mut Command, input: impl AsRef<[u8]>, status: i32, expected: &str) {
    let output = fed(command, input);
    let messages = messages(&output);
    assert_eq!(output.status.code(), Some(status), "{messages}");
    assert!(output.stdout.is_empty());
    assert!(messages.contains(expected), "{messages}");
}
