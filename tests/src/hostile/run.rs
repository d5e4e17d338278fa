//! Running a case and checking what must hold.

use std::fs::{self, File};
use std::io::{Read, Write};
use std::os::unix::process::ExitStatusExt;
use std::path::Path;
use std::process::{Command, ExitStatus, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use super::Case;

/// A program that runs longer than this hangs. Usual cases take milliseconds.
pub const TIME_LIMIT: Duration = Duration::from_secs(60);

/// Address space of each program, in KiB: 8 GB.
pub const MEMORY_LIMIT: u64 = 8 << 20;

/// How a stage ended.
struct Ended {
    status: ExitStatus,
    output: Vec<u8>,
    messages: Vec<u8>,
}

pub fn run(case: &Case, programs: &Path) -> Result<(), String> {
    let folder = tempfile::tempdir().map_err(|error| error.to_string())?;
    case.write_to(folder.path()).map_err(|error| error.to_string())?;
    let output = pipe(case, programs, folder.path(), None)?;
    if case.is_repeated && pipe(case, programs, folder.path(), Some("1"))? != output {
        return Err("one thread writes other bytes".to_owned());
    }
    let left = fs::read_dir(folder.path()).map_err(|error| error.to_string())?;
    let left: Vec<_> = left.flatten().map(|entry| entry.file_name()).collect();
    if left.len() > case.files.len() {
        return Err(format!("files are left: {left:?}"));
    }
    Ok(())
}

/// Runs the stages one after the other. Returns the output of the last that ended with status 0.
fn pipe(case: &Case, programs: &Path, folder: &Path, threads: Option<&str>) -> Result<Vec<u8>, String> {
    let mut input = case.files[0].1.clone();
    for (idx, words) in case.stages.iter().enumerate() {
        let mut words = words.clone();
        if let Some(threads) = threads {
            words.extend(["-nt".to_owned(), threads.to_owned()]);
        }
        let ended = stage(programs, &words, &input, folder)?;
        let about = |finding: String| format!("{}: {finding}", words.join(" "));
        // Nothing is to be said of a scene that is right.
        let is_silent = words.iter().any(|word| word == "check");
        check(&ended, is_silent).map_err(about)?;
        if ended.status.code() != Some(0) {
            if idx > 0 && is_diagnostic(&ended.messages) {
                let messages = String::from_utf8_lossy(&ended.messages).into_owned();
                return Err(about(format!("refuses the scene that a program has written:\n{messages}")));
            }
            return Ok(Vec::new());
        }
        input = ended.output;
        if idx + 1 < case.stages.len() {
            let checked = stage(
                programs,
                &["ugparse".to_owned(), "check".to_owned(), "-lax".to_owned()],
                &input,
                folder,
            )?;
            if checked.status.code() != Some(0) {
                let messages = String::from_utf8_lossy(&checked.messages).into_owned();
                return Err(about(format!("wrote an invalid scene with status 0:\n{messages}")));
            }
        }
    }
    Ok(input)
}

/// An error with a place in the scene.
fn is_diagnostic(messages: &[u8]) -> bool {
    let text = String::from_utf8_lossy(messages);
    text.contains("error") && text.contains("--> ")
}

/// `is_silent`: success may come without output.
fn check(ended: &Ended, is_silent: bool) -> Result<(), String> {
    let messages = String::from_utf8_lossy(&ended.messages);
    let Some(status) = ended.status.code() else {
        return Err(format!("died of signal {:?}\n{messages}", ended.status.signal()));
    };
    if !(0..=2).contains(&status) {
        return Err(format!("status {status}\n{messages}"));
    }
    match (status, ended.output.is_empty()) {
        (0, true) if !is_silent => return Err("status 0 and no output".to_owned()),
        (1 | 2, false) => return Err(format!("status {status} and {} bytes of output", ended.output.len())),
        _ => {}
    }
    if status > 0 && messages.trim().is_empty() {
        return Err(format!("status {status} without a message"));
    }
    match messages.chars().find(|&c| is_dangerous(c)) {
        Some(c) => Err(format!("prints {c:?}\n{}", messages.escape_debug())),
        None => Ok(()),
    }
}

/// Control characters, and those that change the direction of text.
fn is_dangerous(c: char) -> bool {
    c.is_control() && c != '\n' || matches!(c, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

fn stage(programs: &Path, words: &[String], input: &[u8], folder: &Path) -> Result<Ended, String> {
    let program = programs.join(&words[0]);
    let messages = tempfile::tempfile().map_err(|error| error.to_string())?;
    let output = tempfile::tempfile().map_err(|error| error.to_string())?;
    let clone = |file: &File| file.try_clone().map_err(|error| error.to_string());
    let mut child = Command::new("sh")
        .args(["-c", &format!("ulimit -v {MEMORY_LIMIT}; exec \"$@\""), "sh"])
        .arg(program)
        .args(&words[1..])
        .current_dir(folder)
        .stdin(Stdio::piped())
        .stdout(clone(&output)?)
        .stderr(clone(&messages)?)
        .spawn()
        .map_err(|error| error.to_string())?;
    let mut stdin = child.stdin.take().ok_or("no pipe")?;
    let begun = Instant::now();
    let status = thread::scope(|scope| {
        // A program that refuses its command line does not read its input.
        scope.spawn(move || drop(stdin.write_all(input)));
        loop {
            if let Some(status) = child.try_wait().map_err(|error| error.to_string())? {
                return Ok(status);
            }
            if begun.elapsed() > TIME_LIMIT {
                child.kill().and_then(|()| child.wait()).map_err(|error| error.to_string())?;
                return Err(format!("{}: runs for more than {TIME_LIMIT:?}", words.join(" ")));
            }
            thread::sleep(Duration::from_millis(if begun.elapsed().as_millis() < 100 { 1 } else { 20 }));
        }
    })?;
    Ok(Ended { status, output: content(output)?, messages: content(messages)? })
}

fn content(mut file: File) -> Result<Vec<u8>, String> {
    use std::io::Seek;
    let mut bytes = Vec::new();
    file.rewind().and_then(|()| file.read_to_end(&mut bytes)).map_err(|error| error.to_string())?;
    Ok(bytes)
}
