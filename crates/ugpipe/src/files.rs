//! Reading files and running programs that an input names, with limits on their size.

use std::fs::{self, File};
use std::io::{self, BufRead, BufReader, Read};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::thread;

use crate::cleanup::Running;
use crate::failure::reason;

/// Largest number of bytes of standard error that are examined.
const MAX_STDERR: u64 = 1 << 16;

/// The output of a program that was run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ProgramOutput {
    /// Its standard output.
    pub text: Vec<u8>,
    /// The first line of its standard error; empty if there is none.
    pub error_line: String,
    /// Its exit status (`exit status: 3`), unless it succeeded.
    pub failure: Option<String>,
}

/// Reads a regular file, up to `limit` + 1 bytes. The caller recognizes a file that is too large by
/// the extra byte.
///
/// Devices, pipes and sockets are refused: reading one may never end, and may take data away from
/// another program.
///
/// # Errors
/// The file is not a regular file, or cannot be read; the error is the system's message.
pub fn read_file(path: &Path, limit: u64) -> io::Result<Vec<u8>> {
    // Checked before it is opened: opening a named pipe waits for a writer.
    let kind = fs::metadata(path).map_err(without_number)?.file_type();
    if !kind.is_file() && !kind.is_dir() {
        return Err(io::Error::new(io::ErrorKind::InvalidInput, "It is not a regular file"));
    }
    File::open(path).and_then(|file| read_up_to(file, limit)).map_err(without_number)
}

/// Runs a program, without a shell, arguments or input, and reads its standard output, up to
/// `limit` + 1 bytes. A program that prints more is killed.
///
/// `path` is the path of the program; `PATH` is not searched.
///
/// # Errors
/// The program cannot be run; the error is the system's message.
pub fn run_program(path: &Path, limit: u64) -> io::Result<ProgramOutput> {
    let mut command = Command::new(without_search(path));
    command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut running = Running::spawn(&mut command).map_err(without_number)?;
    let child = running.child_mut();
    let stdout = child.stdout.take().expect("standard output is a pipe");
    let stderr = child.stderr.take().expect("standard error is a pipe");
    thread::scope(|scope| {
        // Both streams are read concurrently, so that the program never blocks on a full pipe.
        let error_line = scope.spawn(|| first_line(stderr));
        let text = read_up_to(stdout, limit);
        let is_whole = text.as_ref().is_ok_and(|text| text.len() as u64 <= limit);
        if !is_whole {
            running.stop();
        }
        let status = running.child_mut().wait().map_err(without_number)?;
        let error_line = error_line.join().unwrap_or_default();
        let failure = (is_whole && !status.success()).then(|| status.to_string());
        Ok(ProgramOutput { text: text.map_err(without_number)?, error_line, failure })
    })
}

/// Prefixes a bare file name with `./`: otherwise it would be searched for in `PATH`.
fn without_search(path: &Path) -> PathBuf {
    if path.components().count() == 1 { Path::new(".").join(path) } else { path.to_owned() }
}

/// Reads up to `limit` + 1 bytes.
pub(crate) fn read_up_to(from: impl Read, limit: u64) -> io::Result<Vec<u8>> {
    let mut text = Vec::new();
    from.take(limit.saturating_add(1)).read_to_end(&mut text)?;
    Ok(text)
}

/// The first line. The rest is read and discarded.
fn first_line(from: impl Read) -> String {
    let mut from = BufReader::new(from);
    let mut line = Vec::new();
    let read = from.by_ref().take(MAX_STDERR).read_until(b'\n', &mut line);
    let drained = io::copy(&mut from, &mut io::sink());
    // If it cannot be read, the message is empty.
    let is_read = read.is_ok() && drained.is_ok();
    if is_read { String::from_utf8_lossy(&line).trim().to_owned() } else { String::new() }
}

/// The error with the system's message alone, without the error number that Rust appends.
fn without_number(error: io::Error) -> io::Error {
    io::Error::new(error.kind(), reason(&error))
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::os::unix::fs::PermissionsExt;
    use std::sync::{Mutex, PoisonError};

    use super::*;

    /// Serializes these tests. A program that is open for writing cannot be run, and a child of a
    /// concurrent test would inherit the open file.
    static ALONE: Mutex<()> = Mutex::new(());

    /// Runs a shell script with a limit of `limit` bytes.
    fn run_script(script: &str, limit: u64) -> io::Result<ProgramOutput> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("program");
        fs::write(&path, format!("#!/bin/sh\n{script}\n")).unwrap();
        fs::set_permissions(&path, fs::Permissions::from_mode(0o755)).unwrap();
        run_program(&path, limit)
    }

    #[test]
    fn program_output_is_read_up_to_the_limit() {
        let _alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
        let ran = run_script("echo scene; echo why >&2", 100).unwrap();
        assert_eq!(ran, ProgramOutput { text: b"scene\n".to_vec(), error_line: "why".into(), failure: None });
        let ran = run_script("echo no >&2; echo more >&2; exit 3", 100).unwrap();
        assert_eq!((ran.failure.as_deref(), ran.error_line.as_str()), (Some("exit status: 3"), "no"));
        let ran = run_script("kill -9 $$", 100).unwrap();
        assert!(ran.failure.unwrap().starts_with("signal: 9"));
        // Endless output on both streams.
        let ran = run_script("while :; do echo text; echo words >&2; done", 1000).unwrap();
        assert_eq!((ran.text.len(), ran.failure, ran.error_line.as_str()), (1001, None, "words"));
        // Standard input is empty.
        assert_eq!(run_script("cat", 100).unwrap().text, b"");
        assert_eq!(run_script("echo $#", 100).unwrap().text, b"0\n");
    }

    #[test]
    fn errors_have_no_system_number() {
        let _alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
        let words = |error: io::Error| error.to_string();
        assert_eq!(
            run_program(Path::new("no-such"), 9).map_err(words),
            Err("No such file or directory".into())
        );
        // Programs in `PATH` are not found either.
        assert_eq!(run_program(Path::new("sh"), 9).map_err(words), Err("No such file or directory".into()));
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("text");
        fs::write(&path, "0123456789").unwrap();
        assert_eq!(run_program(&path, 9).map_err(words), Err("Permission denied".into()));
        assert_eq!(read_file(&path, 4).unwrap(), b"01234");
        assert_eq!(read_file(&path, 10).unwrap(), b"0123456789");
        assert_eq!(read_file(&path, u64::MAX).unwrap(), b"0123456789");
        assert_eq!(
            read_file(&folder.path().join("no"), 9).map_err(words),
            Err("No such file or directory".into())
        );
        let refused = read_file(Path::new("/dev/zero"), 9).map_err(|error| error.to_string());
        assert_eq!(refused, Err("It is not a regular file".to_owned()));
        let refused = read_file(folder.path(), 9).map_err(|error| error.to_string());
        assert_eq!(refused, Err("Is a directory".to_owned()));
    }
}
