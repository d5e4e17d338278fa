//! Reading files and running programs that an input names, with limits on their size and place.

use std::ffi::OsString;
use std::fs::{self, File};
use std::io::{self, BufRead, BufReader, Read};
use std::path::{Component, Path, PathBuf};
use std::process::{Command, Stdio};
use std::thread;

use crate::cli::cleanup::Running;
use crate::cli::failure::reason;
use crate::other_case::OtherCase;

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

/// Why a file that exists is not read.
const OUTSIDE: &str =
    "It is outside the folder of the input; if you trust the input, allow it with --allow-outside";

/// The same for standard input.
const OUTSIDE_HERE: &str = "It is outside the current folder; run the whole pipe in the folder of \
     the scene, or if you trust the scene, allow it with --allow-outside";

/// The place where files and programs that an input names must be.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Place {
    /// Anywhere.
    Anywhere,
    /// In this folder or below, links followed.
    Below(PathBuf),
    /// The same for the current folder, in which standard input is.
    Here,
}

impl Place {
    /// The path without links, if it is at this place.
    fn admit(&self, path: &Path) -> io::Result<PathBuf> {
        let real = fs::canonicalize(path).map_err(without_number)?;
        let (folder, refusal) = match self {
            Self::Anywhere => return Ok(real),
            Self::Below(folder) => (&**folder, OUTSIDE),
            Self::Here => (Path::new("."), OUTSIDE_HERE),
        };
        if real.starts_with(fs::canonicalize(folder).map_err(without_number)?) {
            return Ok(real);
        }
        Err(io::Error::new(io::ErrorKind::PermissionDenied, refusal))
    }
}

/// Reads at most `limit` bytes of a regular file.
///
/// Devices, pipes and sockets are refused: reading one may never end, and may take data away from
/// another program.
///
/// # Errors
/// The file is not at this place, not a regular file, or cannot be read; the error has the system's
/// message.
pub(crate) fn read_file(path: &Path, place: &Place, limit: u64) -> io::Result<Vec<u8>> {
    let path = place.admit(path).map_err(|error| match in_other_case(path, place) {
        Some(other) if error.kind() == io::ErrorKind::NotFound => OtherCase::error(other),
        _ => error,
    })?;
    // Checked before it is opened: opening a named pipe waits for a writer.
    let kind = fs::metadata(&path).map_err(without_number)?.file_type();
    if !kind.is_file() && !kind.is_dir() {
        return Err(io::Error::new(io::ErrorKind::InvalidInput, "It is not a regular file"));
    }
    File::open(path).and_then(|file| read_file_up_to(file, limit)).map_err(without_number)
}

/// The file at this place whose path differs in the case of letters alone, if there is one.
fn in_other_case(path: &Path, place: &Place) -> Option<PathBuf> {
    let mut found = PathBuf::new();
    for component in path.components() {
        let next = found.join(component);
        if !matches!(component, Component::Normal(_)) || fs::symlink_metadata(&next).is_ok() {
            found = next;
            continue;
        }
        let folder = if found.as_os_str().is_empty() { Path::new(".") } else { &found };
        place.admit(folder).ok()?;
        let name = component.as_os_str().to_str()?.to_lowercase();
        let names = fs::read_dir(folder).ok()?.filter_map(|entry| Some(entry.ok()?.file_name()));
        let is_same = |other: &OsString| other.to_str().is_some_and(|it| it.to_lowercase() == name);
        // The first in the order of bytes, since folders have none.
        found.push(names.filter(is_same).min()?);
    }
    place.admit(&found).ok().map(|_| found)
}

/// Runs a program, without a shell, arguments or input, and reads at most `limit` bytes of its
/// standard output. A program that prints as much is killed.
///
/// `path` is the path of the program; `PATH` is not searched.
///
/// # Errors
/// The program is not at this place, or cannot be run; the error has the system's message.
pub(crate) fn run_program(path: &Path, place: &Place, limit: u64) -> io::Result<ProgramOutput> {
    place.admit(path)?;
    let mut command = Command::new(without_search(path));
    command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut running = Running::spawn(&mut command).map_err(without_number)?;
    let child = running.child_mut();
    let stdout = child.stdout.take().expect("standard output is a pipe");
    let stderr = child.stderr.take().expect("standard error is a pipe");
    thread::scope(|scope| {
        // Both streams are read concurrently, so that the program never blocks on a full pipe.
        let thread = thread::Builder::new().spawn_scoped(scope, || first_line(stderr));
        let Ok(error_line) = thread else {
            running.stop();
            running.child_mut().wait().map_err(without_number)?;
            return Err(io::Error::new(io::ErrorKind::OutOfMemory, "No thread can be started"));
        };
        let text = read_up_to(stdout, limit);
        let is_whole = text.as_ref().is_ok_and(|text| (text.len() as u64) < limit);
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

/// Like [`read_up_to`], with no more memory than the size of the file, where the system states it.
pub(crate) fn read_file_up_to(file: File, limit: u64) -> io::Result<Vec<u8>> {
    let mut text = Vec::new();
    let len = file.metadata()?.len().min(limit);
    text.try_reserve_exact(usize::try_from(len).unwrap_or(usize::MAX))?;
    file.take(limit).read_to_end(&mut text)?;
    Ok(text)
}

/// Reads at most `limit` bytes.
pub(crate) fn read_up_to(from: impl Read, limit: u64) -> io::Result<Vec<u8>> {
    let mut text = Vec::new();
    from.take(limit).read_to_end(&mut text)?;
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
    use std::os::unix::fs::{PermissionsExt, symlink};
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
        run_program(&path, &Place::Anywhere, limit)
    }

    #[test]
    fn program_output_is_read_up_to_the_limit() {
        let _alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
        let ran = run_script("echo scene; echo why >&2", 100).unwrap();
        assert_eq!(
            ran,
            ProgramOutput { text: b"scene\n".to_vec(), error_line: "why".into(), failure: None }
        );
        let ran = run_script("echo no >&2; echo more >&2; exit 3", 100).unwrap();
        assert_eq!(
            (ran.failure.as_deref(), ran.error_line.as_str()),
            (Some("exit status: 3"), "no")
        );
        let ran = run_script("kill -9 $$", 100).unwrap();
        assert!(ran.failure.unwrap().starts_with("signal: 9"));
        // Endless output on both streams.
        let ran = run_script("while :; do echo text; echo words >&2; done", 1000).unwrap();
        assert_eq!((ran.text.len(), ran.failure, ran.error_line.as_str()), (1000, None, "words"));
        // Standard input is empty.
        assert_eq!(run_script("cat", 100).unwrap().text, b"");
        assert_eq!(run_script("echo $#", 100).unwrap().text, b"0\n");
    }

    #[test]
    fn errors_have_no_system_number() {
        let _alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
        let words = |error: io::Error| error.to_string();
        // Programs in `PATH` are not found either.
        for name in ["no-such", "sh"] {
            let found = run_program(Path::new(name), &Place::Anywhere, 9).map_err(words);
            assert_eq!(found, Err("No such file or directory".into()));
        }
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("text");
        fs::write(&path, "0123456789").unwrap();
        assert_eq!(
            run_program(&path, &Place::Anywhere, 9).map_err(words),
            Err("Permission denied".into())
        );
        let read = |path: &Path, limit| read_file(path, &Place::Anywhere, limit);
        assert_eq!(read(&path, 4).unwrap(), b"0123");
        assert_eq!(read(&path, 10).unwrap(), b"0123456789");
        assert_eq!(read(&path, u64::MAX).unwrap(), b"0123456789");
        for (path, why) in [
            (folder.path().join("no"), "No such file or directory"),
            ("/dev/zero".into(), "It is not a regular file"),
            (folder.path().into(), "Is a directory"),
        ] {
            assert_eq!(read(&path, 9).map_err(words), Err(why.into()));
        }
    }

    #[test]
    fn files_outside_the_folder_are_refused() {
        let _alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        fs::create_dir_all(path("in/deep")).unwrap();
        fs::create_dir(path("inner")).unwrap();
        fs::write(path("out"), "secret").unwrap();
        fs::write(path("inner/out"), "secret").unwrap();
        fs::write(path("in/file"), "public").unwrap();
        symlink("../out", path("in/link")).unwrap();
        symlink("file", path("in/alias")).unwrap();
        symlink("../inner", path("in/folder")).unwrap();
        symlink("in", path("entry")).unwrap();
        let place = Place::Below(path("entry"));
        let read = |name: &str| {
            let text = read_file(&path(name), &place, 100).map_err(|error| error.to_string())?;
            Ok(String::from_utf8(text).unwrap())
        };
        for name in ["in/file", "entry/file", "in/alias", "in/deep/../file", "in/folder/../in/file"]
        {
            assert_eq!(read(name), Ok("public".to_owned()), "{name}");
        }
        let outside =
            ["out", "in/../out", "in/link", "in/folder/out", "inner/out", "in/folder/../out"];
        for name in outside.into_iter().chain(["/etc/passwd", "/dev/zero", "/proc/self/environ"]) {
            assert_eq!(read(name), Err(OUTSIDE.to_owned()), "{name}");
        }
        assert_eq!(read_file(&path("in/link"), &Place::Anywhere, 3).unwrap(), b"sec");
        fs::write(path("program"), "#!/bin/sh\necho ran\n").unwrap();
        fs::set_permissions(path("program"), fs::Permissions::from_mode(0o755)).unwrap();
        symlink("../program", path("in/program")).unwrap();
        let refused =
            run_program(&path("in/program"), &place, 9).map_err(|error| error.to_string());
        assert_eq!(refused, Err(OUTSIDE.to_owned()));
        assert_eq!(run_program(&path("in/program"), &Place::Anywhere, 9).unwrap().text, b"ran\n");
    }
}
