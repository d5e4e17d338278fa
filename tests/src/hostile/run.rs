//! Running a case and checking what must hold.

use std::ffi::OsString;
use std::fs::{self, File};
use std::io::{Read, Seek, Write};
use std::os::unix::process::ExitStatusExt;
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use ugtesting::Random;

use super::Case;
use super::options::{FRAMES, MEASURED};

/// Processor time of each program, in seconds, on however busy a machine. Usual cases take
/// milliseconds.
pub const PROCESSOR_LIMIT: u64 = 120;

/// A program that waits for something that never comes is found after this long.
const WAITING_LIMIT: Duration = Duration::from_secs(1800);

/// Address space of each program, in KiB: 8 GB.
const ADDRESS_SPACE: u64 = 8 << 20;

/// Memory that each program may allocate, in KiB: with up to three frames of a film at once, the
/// stacks of a few threads, and times the bytes of its input and output.
const ALLOCATED: u64 = 256 << 10;
const TIMES: u64 = 16;

/// SIGPIPE.
const PIPE: i32 = 13;

/// The output file of a stage that a signal or a limit interrupts.
const INTERRUPTED: &str = "interrupted.out";

/// How the streams of the last stage are connected, and what interrupts it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Edge {
    /// As usual.
    Plain,
    /// Standard output loses what is written, as this redirection says.
    Output(&'static str),
    /// Nobody reads standard output.
    Unread,
    /// Messages are lost.
    Messages(&'static str),
    /// A limit of the shell, while a file is written.
    Limit(&'static str),
    /// A signal comes after this many milliseconds, while a file is written.
    Signal {
        /// Its number.
        number: i32,
        /// When it comes.
        after_ms: u64,
    },
}

impl Edge {
    /// Mostly as usual.
    pub fn new(random: &mut Random) -> Self {
        const LIMITS: [&str; 5] =
            ["ulimit -v 120000;", "ulimit -v 300000;", "ulimit -f 0;", "ulimit -f 1;", "ulimit -f 3;"];
        let limit: &&str = random.pick(&LIMITS);
        match random.below(20) {
            0 => Self::Output("1>/dev/full"),
            1 => Self::Output("1</dev/null"),
            2 => Self::Unread,
            3 => Self::Messages("2>/dev/full"),
            4 => Self::Signal { number: *random.pick(&[1, 2, 3, 15]), after_ms: random.below(12) as u64 },
            5 | 6 => Self::Limit(limit),
            _ => Self::Plain,
        }
    }

    fn limit(self) -> &'static str {
        if let Self::Limit(words) = self { words } else { "" }
    }

    fn redirection(self) -> &'static str {
        if let Self::Output(words) | Self::Messages(words) = self { words } else { "" }
    }

    /// The output is a file.
    fn interrupts(self) -> bool {
        matches!(self, Self::Limit(_) | Self::Signal { .. })
    }

    /// The address space is so small that a program may abort, and leave a file to its next run.
    fn lacks_memory(self) -> bool {
        self.limit().contains("-v")
    }
}

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
    if case.edge == Edge::Plain
        && case.seed.is_multiple_of(4)
        && pipe(case, programs, folder.path(), Some("1"))? != output
    {
        return Err("one thread writes other bytes".to_owned());
    }
    let left = left_in(folder.path(), case)?;
    if !left.is_empty() && !case.edge.lacks_memory() {
        return Err(format!("files are left: {left:?}"));
    }
    Ok(output.is_some())
}

/// The files in the folder that are neither inputs nor outputs.
fn left_in(folder: &Path, case: &Case) -> Result<Vec<OsString>, String> {
    let is_known = |name: &OsString| {
        let text = name.to_string_lossy();
        name == MEASURED
            || text.starts_with(FRAMES)
            || [".exposure", ".scene"].iter().any(|kept| text.ends_with(kept))
            || case.files.iter().any(|(given, _)| name == given.as_str())
    };
    let names = fs::read_dir(folder).map_err(words)?.flatten().map(|entry| entry.file_name());
    Ok(names.filter(|name| !is_known(name)).collect())
}

fn words(error: std::io::Error) -> String {
    error.to_string()
}

/// Runs the stages one after the other. Returns the output of the last, `None` if one refuses its
/// input or is interrupted.
fn pipe(
    case: &Case,
    programs: &Path,
    folder: &Path,
    threads: Option<&str>,
) -> Result<Option<Vec<u8>>, String> {
    let n_files: usize = case.files.iter().map(|(_, bytes)| bytes.len()).sum();
    let mut input = case.files[0].1.clone();
    for (idx, words) in case.stages.iter().enumerate() {
        let edge = if idx + 1 == case.stages.len() { case.edge } else { Edge::Plain };
        let mut words = words.clone();
        // Frames are files already.
        let has_frames = words.iter().any(|word| word.starts_with(FRAMES));
        if edge.interrupts() && !has_frames {
            words.extend(["-fo", INTERRUPTED].map(str::to_owned));
        }
        words.extend(threads.iter().flat_map(|n| ["-nt", n]).map(str::to_owned));
        let about = |finding: String| format!("{} ({edge:?}): {finding}", words.join(" "));
        let mut ended =
            stage(programs, &words, &input, folder, edge, ALLOCATED + allowed(n_files + input.len()))
                .map_err(about)?;
        if ended.messages.contains("not enough memory") || ended.messages.contains("memory allocation of ") {
            // Within that for its output as well, which has to be known.
            let whole = stage(programs, &words, &input, folder, edge, ADDRESS_SPACE).map_err(about)?;
            let memory = ALLOCATED + allowed(n_files + input.len() + whole.output.len());
            ended = stage(programs, &words, &input, folder, edge, memory).map_err(about)?;
            // A sheet has a limit of its own, on its pixels.
            if ended.status != whole.status && words[0] != "ugsheet" && !edge.interrupts() {
                return Err(about(format!("needs more than {memory} KiB\n{}", ended.messages)));
            }
        }
        let may_be_silent =
            has_frames || words.iter().any(|word| ["check", "--print"].contains(&word.as_str()));
        check(&words[0], &ended, may_be_silent, edge).map_err(about)?;
        check_file(&ended, edge, folder).map_err(about)?;
        if ended.status.code() != Some(0) {
            if idx > 0 && is_diagnostic(&ended.messages) {
                return Err(about(format!(
                    "refuses the scene that a program has written:\n{}",
                    ended.messages
                )));
            }
            return Ok(None);
        }
        input = ended.output;
    }
    Ok(Some(input))
}

/// In KiB.
fn allowed(n_bytes: usize) -> u64 {
    TIMES * n_bytes as u64 / 1024
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
fn check(program: &str, ended: &Ended, may_be_silent: bool, edge: Edge) -> Result<(), String> {
    let messages = &ended.messages;
    let status = match (ended.status.code(), ended.status.signal(), edge) {
        (Some(status), ..) => status,
        (None, Some(PIPE), Edge::Unread) => return Ok(()),
        (None, Some(died_of), Edge::Signal { number, .. }) if died_of == number => return Ok(()),
        (None, signal, _) => return Err(format!("died of signal {signal:?}\n{messages}")),
    };
    // A program that aborts ends with status 1. With enough memory, no case may.
    if !edge.lacks_memory() && messages.contains("overflowed its stack") {
        return Err(format!("aborted\n{messages}"));
    }
    match (status, ended.output.is_empty()) {
        (0, _) if !may_be_silent && matches!(edge, Edge::Output(_) | Edge::Unread) => {
            return Err("status 0, though its output is lost".to_owned());
        }
        (0, true) if !may_be_silent && !edge.interrupts() => {
            return Err("status 0 and no output".to_owned());
        }
        (0, _) | (1 | 2, true) => {}
        // A film is written frame by frame.
        (1, false) if program == "ugfilm" => {}
        (1 | 2, false) => return Err(format!("status {status} and {} bytes of output", ended.output.len())),
        _ => return Err(format!("status {status}\n{messages}")),
    }
    let keeps_messages = !matches!(edge, Edge::Messages(_)) && !edge.limit().contains("-f");
    if status > 0 && messages.trim().is_empty() && keeps_messages {
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

/// An interrupted program leaves its output file whole, or none.
fn check_file(ended: &Ended, edge: Edge, folder: &Path) -> Result<(), String> {
    let path = folder.join(INTERRUPTED);
    let is_there = edge.interrupts() && path.exists();
    if is_there {
        fs::remove_file(path).map_err(words)?;
    }
    // A signal may come after the file is complete.
    match ended.status.code() {
        Some(status @ 1..) if is_there => Err(format!("status {status} and an output file")),
        _ => Ok(()),
    }
}

/// Control characters, those that change the direction of text, and those of no width.
fn is_dangerous(c: char) -> bool {
    c.is_control() && c != '\n'
        || matches!(c, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}' | '\u{61c}' | '\u{feff}')
        || matches!(c, '\u{200b}'..='\u{200f}' | '\u{2028}' | '\u{2029}')
}

/// True if a message has an infinity or NaN as a number. Words of the input are in quotes, or in
/// lines of the input, behind `|`.
fn has_invalid_number(messages: &str) -> bool {
    let words = messages.lines().filter(|line| !line.contains(" | ")).flat_map(str::split_whitespace);
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
    edge: Edge,
    memory: u64,
) -> Result<Ended, String> {
    let messages = tempfile::tempfile().map_err(self::words)?;
    let output = tempfile::tempfile().map_err(self::words)?;
    let script = format!(
        "ulimit -v {ADDRESS_SPACE}; ulimit -d {memory}; ulimit -t {PROCESSOR_LIMIT}; {} exec \"$@\" {}",
        edge.limit(),
        edge.redirection()
    );
    let mut child = Command::new("sh")
        .args(["-c", &script, "sh"])
        .arg(programs.join(&words[0]))
        .args(&words[1..])
        .current_dir(folder)
        .stdin(Stdio::piped())
        .stdout(if edge == Edge::Unread { unread()? } else { clone(&output)? })
        .stderr(clone(&messages)?)
        .spawn()
        .map_err(self::words)?;
    let mut stdin = child.stdin.take().ok_or("no pipe")?;
    let status = thread::scope(|scope| {
        // A program that refuses its command line does not read its input.
        scope.spawn(move || drop(stdin.write_all(input)));
        wait(&mut child, edge)
    })?;
    let messages = String::from_utf8_lossy(&content(messages)?).into_owned();
    Ok(Ended { status, output: content(output)?, messages })
}

/// Waits for the end of the program, and interrupts it when the edge says so.
fn wait(child: &mut Child, edge: Edge) -> Result<ExitStatus, String> {
    let begun = Instant::now();
    let mut signal = match edge {
        Edge::Signal { number, after_ms } => Some((number, after_ms)),
        _ => None,
    };
    loop {
        if let Some(status) = child.try_wait().map_err(words)? {
            return Ok(status);
        }
        if let Some((number, _)) =
            signal.take_if(|(_, after)| begun.elapsed().as_millis() >= u128::from(*after))
        {
            let kill = format!("kill -{number} {}", child.id());
            Command::new("sh").args(["-c", &kill]).stderr(Stdio::null()).status().map_err(words)?;
        }
        if begun.elapsed() > WAITING_LIMIT {
            child.kill().and_then(|()| child.wait()).map_err(words)?;
            return Err(format!("has not ended after {WAITING_LIMIT:?}"));
        }
        thread::sleep(Duration::from_millis(if begun.elapsed().as_millis() < 100 { 1 } else { 20 }));
    }
}

/// A pipe whose reading end is closed.
fn unread() -> Result<Stdio, String> {
    let (_, writer) = std::io::pipe().map_err(words)?;
    Ok(writer.into())
}

fn clone(file: &File) -> Result<Stdio, String> {
    file.try_clone().map(Stdio::from).map_err(words)
}

fn content(mut file: File) -> Result<Vec<u8>, String> {
    let mut bytes = Vec::new();
    file.rewind().and_then(|()| file.read_to_end(&mut bytes)).map_err(words)?;
    Ok(bytes)
}
