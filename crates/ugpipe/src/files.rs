//! Files and programs that an input names: read and run with bounds.

use std::fs::File;
use std::io::{self, BufRead, BufReader, Read};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::thread;

use crate::failure::reason;

/// Bytes of a complaint that are looked at.
const MAX_COMPLAINT: u64 = 1 << 16;

/// What a program has printed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Printed {
    /// Its standard output.
    pub text: Vec<u8>,
    /// The first line of its standard error; may be empty.
    pub complaint: String,
    /// How it ended (`exit status: 3`), unless all went well.
    pub failure: Option<String>,
}

/// Reads a file, but not much beyond `room` bytes: one more shows that there is no room for it.
///
/// # Errors
/// The file cannot be read; the error has the system's words alone.
pub fn read_file(path: &Path, room: u64) -> io::Result<Vec<u8>> {
    File::open(path).and_then(|file| read_up_to(file, room)).map_err(in_words)
}

/// Runs a program, without a shell, arguments or input, and reads what it prints: not much
/// beyond `room` bytes. A program that prints more is stopped.
///
/// `path` is the program itself; it is not searched for.
///
/// # Errors
/// The program cannot be run; the error has the system's words alone.
pub fn run_program(path: &Path, room: u64) -> io::Result<Printed> {
    let mut child = Command::new(not_searched(path))
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .map_err(in_words)?;
    let stdout = child.stdout.take().expect("standard output is a pipe");
    let stderr = child.stderr.take().expect("standard error is a pipe");
    thread::scope(|scope| {
        // Both are read at once, so that the program never waits for us.
        let complaint = scope.spawn(|| first_line(stderr));
        let text = read_up_to(stdout, room);
        let is_whole = text.as_ref().is_ok_and(|text| text.len() as u64 <= room);
        if !is_whole {
            // It may have ended by itself.
            let _ = child.kill();
        }
        let status = child.wait().map_err(in_words)?;
        let complaint = complaint.join().unwrap_or_default();
        let failure = (is_whole && !status.success()).then(|| status.to_string());
        Ok(Printed { text: text.map_err(in_words)?, complaint, failure })
    })
}

/// A name alone would be looked for in the folders of `PATH`.
fn not_searched(path: &Path) -> PathBuf {
    if path.components().count() == 1 { Path::new(".").join(path) } else { path.to_owned() }
}

fn read_up_to(from: impl Read, room: u64) -> io::Result<Vec<u8>> {
    let mut text = Vec::new();
    from.take(room.saturating_add(1)).read_to_end(&mut text)?;
    Ok(text)
}

/// The first line, with all behind it read and dropped.
fn first_line(from: impl Read) -> String {
    let mut from = BufReader::new(from);
    let mut line = Vec::new();
    let read = from.by_ref().take(MAX_COMPLAINT).read_until(b'\n', &mut line);
    let drained = io::copy(&mut from, &mut io::sink());
    // What cannot be read is not told.
    let is_read = read.is_ok() && drained.is_ok();
    if is_read { String::from_utf8_lossy(&line).trim().to_owned() } else { String::new() }
}

/// The system's words without the number Rust adds to them.
fn in_words(error: io::Error) -> io::Error {
    io::Error::new(error.kind(), reason(&error))
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::os::unix::fs::PermissionsExt;
    use std::sync::{Mutex, PoisonError};

    use super::*;

    /// A program that is being written cannot be run, and what one test writes is open in the children of others.
    static ALONE: Mutex<()> = Mutex::new(());

    /// What a shell script prints, with that much room.
    fn printed(script: &str, room: u64) -> io::Result<Printed> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("program");
        fs::write(&path, format!("#!/bin/sh\n{script}\n")).unwrap();
        fs::set_permissions(&path, fs::Permissions::from_mode(0o755)).unwrap();
        run_program(&path, room)
    }

    #[test]
    fn programs_are_read_and_bounded() {
        let _alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
        let ran = printed("echo scene; echo why >&2", 100).unwrap();
        assert_eq!(ran, Printed { text: b"scene\n".to_vec(), complaint: "why".into(), failure: None });
        let ran = printed("echo no >&2; echo more >&2; exit 3", 100).unwrap();
        assert_eq!((ran.failure.as_deref(), ran.complaint.as_str()), (Some("exit status: 3"), "no"));
        let ran = printed("kill -9 $$", 100).unwrap();
        assert!(ran.failure.unwrap().starts_with("signal: 9"));
        // Without end, on both streams.
        let ran = printed("while :; do echo text; echo words >&2; done", 1000).unwrap();
        assert_eq!((ran.text.len(), ran.failure, ran.complaint.as_str()), (1001, None, "words"));
        // There is no input.
        assert_eq!(printed("cat", 100).unwrap().text, b"");
        assert_eq!(printed("echo $#", 100).unwrap().text, b"0\n");
    }

    #[test]
    fn what_cannot_be_run_or_read_is_told_in_words() {
        let _alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
        let words = |error: io::Error| error.to_string();
        assert_eq!(
            run_program(Path::new("no-such"), 9).map_err(words),
            Err("No such file or directory".into())
        );
        // Not one of `PATH` either.
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
        assert_eq!(read_file(Path::new("/dev/zero"), 1000).unwrap().len(), 1001);
    }
}
