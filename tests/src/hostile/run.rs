//! Running a case and checking what must hold.

use std::fs::{self, File};
use std::io::{self, Read, Seek, Write};
use std::path::Path;
use std::process::{Command, ExitStatus, Stdio};
use std::thread;

use super::Case;
use super::options::{FRAMES, MEASURED};

/// Processor time of each program, in seconds, on however busy a machine. Usual cases take
/// milliseconds.
pub const PROCESSOR_LIMIT: u64 = 120;

/// Time after which a program that waits for something is ended.
const WAITING_LIMIT: &str = "1800";

/// Address space of each program, in KiB: 8 GB.
const ADDRESS_SPACE: u64 = 8 << 20;

/// Memory that each program may allocate, in KiB: with up to three frames of a film at once, each
/// with a sphere of 51,200 polygons, the stacks of a few threads, and times the bytes of its input
/// and output.
const ALLOCATED: u64 = 384 << 10;
const TIMES: u64 = 16;

/// How a stage ended.
struct Ended {
    status: ExitStatus,
    output: Vec<u8>,
    messages: String,
}

pub fn run(case: &Case, programs: &Path) -> Result<bool, String> {
    let folder = tempfile::tempdir().map_err(words)?;
    case.write_to(folder.path()).map_err(words)?;
    let output = pipe(case, programs, folder.path(), None)?;
    if case.seed.is_multiple_of(4) && pipe(case, programs, folder.path(), Some("1"))? != output {
        return Err("one thread writes other bytes".to_owned());
    }
    let is_known = |name: &str| {
        name == MEASURED
            || name.starts_with(FRAMES)
            || [".exposure", ".scene"].iter().any(|kept| name.ends_with(kept))
            || case.files.iter().any(|(given, _)| name == given)
    };
    let names =
        fs::read_dir(folder.path()).map_err(words)?.flatten().map(|entry| entry.file_name());
    let left: Vec<_> = names.filter(|name| !is_known(&name.to_string_lossy())).collect();
    if left.is_empty() { Ok(output.is_some()) } else { Err(format!("files are left: {left:?}")) }
}

fn words(error: io::Error) -> String {
    error.to_string()
}

/// Runs the stages one after the other. Returns the output of the last, `None` if one refuses its
/// input.
fn pipe(
    case: &Case,
    programs: &Path,
    folder: &Path,
    threads: Option<&str>,
) -> Result<Option<Vec<u8>>, String> {
    let n_files: usize = case.files.iter().map(|(_, bytes)| bytes.len()).sum();
    let mut input = case.files[0].1.clone();
    for (idx, words) in case.stages.iter().enumerate() {
        let mut words = words.clone();
        words.extend(threads.iter().flat_map(|n| ["-nt", n]).map(str::to_owned));
        let about = |finding: String| format!("{}: {finding}", words.join(" "));
        let stage = |memory: u64| {
            stage(programs, &words, &input, folder, memory)
                .map_err(|error| about(self::words(error)))
        };
        let allowed = |n_bytes: usize| ALLOCATED + TIMES * n_bytes as u64 / 1024;
        let mut ended = stage(allowed(n_files + input.len()))?;
        if ended.messages.contains("not enough memory")
            || ended.messages.contains("memory allocation of ")
        {
            // Within that for its output as well, which has to be known.
            let whole = stage(ADDRESS_SPACE)?;
            let memory = allowed(n_files + input.len() + whole.output.len());
            ended = stage(memory)?;
            // A sheet has a limit of its own, on its pixels.
            if ended.status != whole.status && words[0] != "ugsheet" {
                return Err(about(format!("needs more than {memory} KiB\n{}", ended.messages)));
            }
        }
        // Frames are files.
        let has_frames = words.iter().any(|word| word.starts_with(FRAMES));
        let may_be_silent =
            has_frames || words.iter().any(|word| ["check", "--print"].contains(&word.as_str()));
        check(&words[0], &ended, may_be_silent).map_err(about)?;
        if ended.status.code() != Some(0) {
            if idx > 0 && is_diagnostic(&ended.messages) {
                let messages = ended.messages;
                return Err(about(format!(
                    "refuses the scene that a program has written:\n{messages}"
                )));
            }
            return Ok(None);
        }
        input = ended.output;
    }
    Ok(Some(input))
}

/// An error with a place in the text of the scene. Where an eye or a motion meets a vertex, the
/// options of the program are to blame.
fn is_diagnostic(messages: &str) -> bool {
    const OF_OPTIONS: [&str; 2] = ["is too far away for a number", "lies at the eye"];
    let lines: Vec<&str> = messages.lines().collect();
    let is_one = |pair: &[&str]| {
        pair[0].contains(": error: ")
            && pair[1].trim_start().starts_with("--> ")
            && !OF_OPTIONS.iter().any(|words| pair[0].contains(words))
    };
    lines.windows(2).any(is_one)
}

/// Checks status, output and messages. `may_be_silent`: success may come without output.
fn check(program: &str, ended: &Ended, may_be_silent: bool) -> Result<(), String> {
    let messages = &ended.messages;
    let status = ended.status.code().ok_or_else(|| format!("{}\n{messages}", ended.status))?;
    // A program that aborts ends with status 1.
    if messages.contains("overflowed its stack") {
        return Err(format!("aborted\n{messages}"));
    }
    match (status, ended.output.is_empty()) {
        (0, true) if !may_be_silent => return Err("status 0 and no output".to_owned()),
        (0, _) | (1 | 2, true) => {}
        // A film is written frame by frame.
        (1, false) if program == "ugfilm" => {}
        (1 | 2, false) => {
            return Err(format!("status {status} and {} bytes of output", ended.output.len()));
        }
        _ => return Err(format!("status {status}\n{messages}")),
    }
    if status > 0 && messages.trim().is_empty() {
        return Err(format!("status {status} without a message"));
    }
    if has_invalid_number(messages) {
        return Err(format!("prints an invalid number\n{messages}"));
    }
    match messages.chars().find(|&c| is_dangerous(c)) {
        Some(c) => Err(format!("prints {c:?}\n{}", messages.escape_debug())),
        None => Ok(()),
    }
}

/// Control characters, those that change the direction of text, and those of no width.
pub fn is_dangerous(c: char) -> bool {
    c.is_control() && c != '\n'
        || matches!(c, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}' | '\u{61c}' | '\u{feff}')
        || matches!(c, '\u{200b}'..='\u{200f}' | '\u{2028}' | '\u{2029}')
}

/// True if a message has an infinity or NaN as a number. Words of the input are in quotes, or in
/// lines of the input, behind `|`.
fn has_invalid_number(messages: &str) -> bool {
    let words =
        messages.lines().filter(|line| !line.contains(" | ")).flat_map(str::split_whitespace);
    words
        .map(|word| word.trim_matches(|c: char| "(),;:%".contains(c)))
        .any(|word| ["inf", "-inf", "NaN"].contains(&word))
}

/// Runs a program. `memory`: what it may allocate, in KiB.
fn stage(
    programs: &Path,
    words: &[String],
    input: &[u8],
    folder: &Path,
    memory: u64,
) -> io::Result<Ended> {
    let (messages, output) = (tempfile::tempfile()?, tempfile::tempfile()?);
    let script = format!(
        "ulimit -v {ADDRESS_SPACE}; ulimit -d {memory}; ulimit -t {PROCESSOR_LIMIT}; \
         exec timeout {WAITING_LIMIT} \"$@\""
    );
    let mut child = Command::new("sh")
        .args(["-c", &script, "sh"])
        .arg(programs.join(&words[0]))
        .args(&words[1..])
        .current_dir(folder)
        .stdin(Stdio::piped())
        .stdout(output.try_clone()?)
        .stderr(messages.try_clone()?)
        .spawn()?;
    let stdin = child.stdin.take();
    let status = thread::scope(|scope| {
        // A program that refuses its command line does not read its input.
        scope.spawn(move || drop(stdin.map(|mut stdin| stdin.write_all(input))));
        child.wait()
    })?;
    let messages = String::from_utf8_lossy(&content(messages)?).into_owned();
    Ok(Ended { status, output: content(output)?, messages })
}

fn content(mut file: File) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    file.rewind()?;
    file.read_to_end(&mut bytes)?;
    Ok(bytes)
}
