//! Running a case and checking what must hold.

use std::ffi::OsString;
use std::fs::{self, File};
use std::io::{Read, Write};
use std::os::unix::process::ExitStatusExt;
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use super::Case;
use super::edge::{CLOSED, Edge, INTERRUPTED};
use super::film::FRAMES;
use super::line::MEASURED;

/// Processor time of each program, in seconds, on however busy a machine. Usual cases take
/// milliseconds; the largest number of pieces of `uglorentz` takes half a minute in a development
/// build.
pub const PROCESSOR_LIMIT: u64 = 120;

/// A program that waits for something that never comes is found after this long.
const WAITING_LIMIT: Duration = Duration::from_secs(1800);

/// Address space of each program, in KiB: 8 GB.
pub const MEMORY_LIMIT: u64 = 8 << 20;

/// Memory that each program may allocate, in KiB, and times the bytes of its input and output. A
/// film may allocate the former once more for each frame that is drawn at once: a frame has up to
/// 262144 pieces of faces, of about 240 bytes each, and no program writes them.
const ALLOCATED: u64 = 64 << 10;
const TIMES: u64 = 16;

/// The same for each pixel of a sheet, in bytes: its color, its color without alpha, and its file.
const PER_PIXEL: u64 = 12;

/// Memory for each thread, in KiB: its stack, and what the allocator keeps for it.
const PER_THREAD: u64 = 4 << 10;

/// SIGPIPE.
const PIPE: i32 = 13;

/// SIGXCPU.
const PROCESSOR: i32 = 24;

/// How a stage ended.
struct Ended {
    status: ExitStatus,
    output: Vec<u8>,
    messages: Vec<u8>,
}

pub fn run(case: &Case, programs: &Path) -> Result<bool, String> {
    let folder = tempfile::tempdir().map_err(words)?;
    case.write_to(folder.path()).map_err(words)?;
    let output = pipe(case, programs, folder.path(), None)?;
    // With a number of threads that a program refuses there is nothing to compare.
    let is_refused = output.is_none() && case.stages.iter().flatten().any(|word| word == "-nt");
    if case.is_repeated
        && !is_refused
        && case.edge == Edge::Plain
        && pipe(case, programs, folder.path(), Some("1"))? != output
    {
        return Err("one thread writes other bytes".to_owned());
    }
    let mut left = left_in(folder.path(), case)?;
    // A program without memory aborts at once. What it leaves then, its next run deletes.
    if !left.is_empty() && case.edge.limits_memory() {
        let again = Case { edge: Edge::Limit(""), ..case.clone() };
        pipe(&again, programs, folder.path(), None)?;
        left = left_in(folder.path(), case)?;
    }
    if left.is_empty() { Ok(output.is_some()) } else { Err(format!("files are left: {left:?}")) }
}

/// The files in the folder that are neither inputs nor outputs.
fn left_in(folder: &Path, case: &Case) -> Result<Vec<OsString>, String> {
    let is_known = |name: &OsString| {
        name == MEASURED
            || name.to_string_lossy().starts_with(FRAMES)
            || [".exposure", ".scene"].iter().any(|kept| name.to_string_lossy().ends_with(kept))
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
    let mut input = case.files[0].1.clone();
    let mut passes_all_on = false;
    for (idx, words) in case.stages.iter().enumerate() {
        let is_last = idx + 1 == case.stages.len();
        let edge = if is_last { case.edge } else { Edge::Plain };
        let mut words = words.clone();
        // Frames are files already.
        if !words.iter().any(|word| word.starts_with(FRAMES)) {
            words.extend(edge.arguments());
        }
        if let Some(threads) = threads {
            // In place of a number that the case gives.
            if let Some(at) = words.iter().position(|word| word == "-nt") {
                words.drain(at..(at + 2).min(words.len()));
            }
            words.extend(["-nt".to_owned(), threads.to_owned()]);
        }
        let about = |finding: String| format!("{} ({edge:?}): {finding}", words.join(" "));
        let n_read = input.len() + case.files.iter().map(|(_, bytes)| bytes.len()).sum::<usize>();
        let ended = within_memory(programs, &words, &input, folder, edge, n_read as u64).map_err(about)?;
        // Nothing is to be said of a scene that is right, and an empty one stays empty.
        // The frames of a film may be files, and its commands are printed, not written to -fo.
        let is_silent = words.iter().any(|word| word == "check" || word.starts_with(FRAMES))
            || words.iter().any(|word| word == "--print") && matches!(edge, Edge::File(_))
            || edge == Edge::Input(CLOSED);
        check(&words[0], &ended, is_silent, edge, folder).map_err(about)?;
        if ended.status.code() != Some(0) {
            // Another camera may be asked for than there is, and an earlier program may have been
            // told to pass unknown statements on.
            let is_excused = words.iter().any(|word| word == "-cam") || passes_all_on && !is_lax(&words);
            let is_refused = is_diagnostic(&ended.messages) && !is_excused;
            if idx > 0 && is_refused {
                let messages = String::from_utf8_lossy(&ended.messages).into_owned();
                return Err(about(format!("refuses the scene that a program has written:\n{messages}")));
            }
            return Ok(None);
        }
        passes_all_on |= is_lax(&words);
        input = ended.output;
        if edge == Edge::Plain {
            for reader in readers(&words) {
                let read = stage(programs, &reader, &input, folder, Edge::Plain, MEMORY_LIMIT)?;
                let messages = String::from_utf8_lossy(&read.messages).into_owned();
                // A valid scene may be empty, or have an eye that its camera's motion cannot carry; a
                // sheet on a sheet has more pixels.
                let excuses = [
                    "there is nothing to draw",
                    "the eye cannot move with the motion",
                    "the sheet has more than",
                ];
                let is_excused = excuses.iter().any(|excuse| messages.contains(excuse));
                if read.status.code() != Some(0) && !is_excused {
                    let reader = reader.join(" ");
                    return Err(about(format!("status 0, and `{reader}` refuses its output:\n{messages}")));
                }
            }
        }
    }
    Ok(Some(input))
}

/// Runs a stage within the memory for its input, and if that does not suffice within that for its
/// output as well. `n_read`: bytes of its input.
fn within_memory(
    programs: &Path,
    words: &[String],
    input: &[u8],
    folder: &Path,
    edge: Edge,
    n_read: u64,
) -> Result<Ended, String> {
    let fixed = ALLOCATED * (1 + n_frames_at_once(words)) + (n_threads(words) + 2) * PER_THREAD;
    let allowed = |n_bytes: u64| fixed + TIMES * n_bytes / 1024;
    let run = |memory: u64| stage(programs, words, input, folder, edge, memory);
    let ended = run(allowed(n_read))?;
    // Where a limit or a signal ends a program its output is not known.
    if !lacks_memory(&ended.messages) || matches!(edge, Edge::Limit(_) | Edge::Signal { .. }) {
        return Ok(ended);
    }
    let whole = run(MEMORY_LIMIT)?;
    // A sheet has a limit of its own, and its place is taken before its pictures are decoded.
    if words[0] == "ugsheet" && whole.output.is_empty() {
        return Ok(whole);
    }
    let n_frames = fs::read_dir(folder).map_err(self::words)?.flatten();
    let n_frames = n_frames.filter(|entry| entry.file_name().to_string_lossy().starts_with(FRAMES));
    let n_frames: u64 = n_frames.filter_map(|entry| Some(entry.metadata().ok()?.len())).sum();
    let n_pixels = if words[0] == "ugsheet" { n_pixels(&whole.output) } else { 0 };
    let memory = allowed(n_read + whole.output.len() as u64 + n_frames) + PER_PIXEL * n_pixels / 1024;
    let ended = run(memory)?;
    if lacks_memory(&ended.messages) && !lacks_memory(&whole.messages) {
        let messages = String::from_utf8_lossy(&ended.messages).into_owned();
        return Err(format!("needs more than {memory} KiB\n{messages}"));
    }
    Ok(whole)
}

/// The pixels of a PNG, SVG or PDF file: sheets have a limit of their own, and a large one that is
/// nearly empty is packed into few bytes.
fn n_pixels(file: &[u8]) -> u64 {
    if let Some(&[a, b, c, d, e, f, g, h]) =
        file.strip_prefix(b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR").and_then(<[u8]>::first_chunk)
    {
        return u64::from(u32::from_be_bytes([a, b, c, d])) * u64::from(u32::from_be_bytes([e, f, g, h]));
    }
    let text = String::from_utf8_lossy(file);
    let number = |rest: &str| -> u64 {
        let digits = rest.split(|c: char| !c.is_ascii_digit()).next();
        digits.and_then(|digits| digits.parse().ok()).unwrap_or(0)
    };
    let pixels = |before_width: &str, before_height: &str| -> u64 {
        let sides = |rest: &str| {
            let height = rest.split(before_height).nth(1).map_or(0, number);
            number(rest) * height
        };
        text.split(before_width).skip(1).map(sides).sum()
    };
    pixels("<image width=\"", "height=\"") + pixels("/Width ", "/Height ")
}

/// The threads of a program: those that it is told to start, and those of the machine.
fn n_threads(words: &[String]) -> u64 {
    let given = number(words, "-nt").unwrap_or(0);
    given.min(1024) + thread::available_parallelism().map_or(1, |n| n.get() as u64)
}

/// Frames of a film that are in memory at once: one for each thread. None of other programs.
fn n_frames_at_once(words: &[String]) -> u64 {
    if words[0] != "ugfilm" {
        return 0;
    }
    number(words, "-frames").unwrap_or(1).clamp(1, n_threads(words))
}

/// The whole number of an option.
fn number(words: &[String], option: &str) -> Option<u64> {
    let at = words.iter().position(|word| word == option)?;
    words.get(at + 1)?.parse().ok()
}

/// True if messages say that there is not enough memory.
fn lacks_memory(messages: &[u8]) -> bool {
    const WORDS: [&str; 5] = [
        "memory allocation of ",
        "not enough memory",
        "out of memory",
        "Cannot allocate memory",
        "Resource temporarily unavailable",
    ];
    let messages = String::from_utf8_lossy(messages);
    WORDS.iter().any(|words| messages.contains(words))
}

fn is_lax(words: &[String]) -> bool {
    words.iter().any(|word| word.trim_start_matches('-') == "lax")
}

/// The command lines that must accept what this one has written with status 0.
fn readers(words: &[String]) -> Vec<Vec<String>> {
    let format = words.iter().position(|word| word == "-dt").map(|at| words[at + 1].as_str());
    let has = |word: &str| words.iter().any(|other| other == word);
    const CHECK: &[&str] = &["ugparse", "check", "-lax"];
    const LORENTZ: &[&str] = &["uglorentz", "-lax", "-se", "100", "-sc", "off"];
    const DOPPLER: &[&str] = &["ugdoppler", "-lax"];
    const RAINBOW: &[&str] = &["ugrainbow", "-lax", "-sz", "9", "9"];
    const MESH: &[&str] = &["ugmesh", "-lax", "-dt", "ply"];
    let lines: &[&[&str]] = match (words[0].as_str(), format) {
        ("ugparse", _) if has("flatten") => &[CHECK, LORENTZ, RAINBOW],
        ("uglorentz", _) => &[CHECK, DOPPLER, RAINBOW, MESH],
        ("ugdoppler", _) => &[CHECK, RAINBOW, MESH],
        ("ugmesh", None) => &[CHECK, LORENTZ, DOPPLER, RAINBOW, MESH],
        ("ugmesh", Some("obj")) => &[&["ugmesh", "-if", "obj"]],
        ("ugmesh", Some("ply")) => &[&["ugmesh", "-if", "ply"]],
        ("ugmesh", Some("gltf" | "glb")) => &[&["ugmesh", "-if", "gltf"]],
        ("ugfilm", Some("apng")) if !has("--print") => &[&["ugsheet", "/dev/stdin"]],
        ("ugwarp", None) => &[&["ugsheet", "/dev/stdin"]],
        ("ugphoton", None) if !has("--explain") => &[&["ugsheet", "/dev/stdin"]],
        ("ugrainbow", None) if !["--explain", "-vec"].iter().any(|option| has(option)) => {
            &[&["ugsheet", "/dev/stdin"]]
        }
        _ => &[],
    };
    lines.iter().map(|line| line.iter().copied().map(str::to_owned).collect()).collect()
}

/// An error with a place in the text of the scene. Where an eye or a motion meets a vertex, the
/// options of the program are to blame.
fn is_diagnostic(messages: &[u8]) -> bool {
    const OF_OPTIONS: [&str; 2] = ["is too far away for a number", "lies at the eye"];
    let text = String::from_utf8_lossy(messages);
    let lines: Vec<&str> = text.lines().collect();
    let is_one = |pair: &[&str]| {
        pair[0].contains(": error: ")
            && pair[1].trim_start().starts_with("--> ")
            && !OF_OPTIONS.iter().any(|words| pair[0].contains(words))
    };
    lines.windows(2).any(is_one)
}

/// `is_silent`: success may come without output.
fn check(program: &str, ended: &Ended, is_silent: bool, edge: Edge, folder: &Path) -> Result<(), String> {
    let messages = String::from_utf8_lossy(&ended.messages);
    if matches!(edge, Edge::Limit(_) | Edge::Signal { .. }) {
        check_file(ended, folder)?;
    }
    let status = match (ended.status.code(), ended.status.signal(), edge) {
        (Some(status), ..) => status,
        (None, Some(PIPE), Edge::Unread) => return Ok(()),
        (None, Some(died_of), Edge::Signal { number, .. }) if died_of == number => return Ok(()),
        (None, Some(PROCESSOR), _) => {
            return Err(format!("takes more than {PROCESSOR_LIMIT} s of processor time\n{messages}"));
        }
        (None, signal, _) => return Err(format!("died of signal {signal:?}\n{messages}")),
    };
    // A program that aborts ends with status 1. With enough memory, no case may.
    if !edge.limits_memory()
        && ["memory allocation of ", "overflowed its stack"].iter().any(|abort| messages.contains(abort))
    {
        return Err(format!("aborted\n{messages}"));
    }
    match (status, ended.output.is_empty(), edge) {
        (0, _, Edge::Output(_) | Edge::Unread | Edge::File(_)) if !is_silent => {
            return Err("status 0, though its output is lost".to_owned());
        }
        (0, true, _) if !is_silent && edge.keeps_output() => {
            return Err("status 0 and no output".to_owned());
        }
        (0, ..) => {}
        (1 | 2, true, _) => {}
        // A film is written frame by frame.
        (1, false, _) if program == "ugfilm" => {}
        (1 | 2, false, _) => {
            return Err(format!("status {status} and {} bytes of output", ended.output.len()));
        }
        _ => return Err(format!("status {status}\n{messages}")),
    }
    if status > 0 && messages.trim().is_empty() && edge.keeps_messages() {
        return Err(format!("status {status} without a message"));
    }
    if has_invalid_number(&messages) {
        return Err(format!("prints an invalid number\n{messages}"));
    }
    match messages.chars().find(|&c| is_dangerous(c)) {
        Some(c) => Err(format!("prints {c:?}\n{}", messages.escape_debug())),
        None => Ok(()),
    }
}

/// An interrupted program leaves its output file whole, or none.
fn check_file(ended: &Ended, folder: &Path) -> Result<(), String> {
    let path = folder.join(INTERRUPTED);
    let is_there = path.exists();
    if is_there {
        fs::remove_file(path).map_err(words)?;
    }
    // A signal may come after the file is complete.
    match ended.status.code() {
        Some(0) | None => Ok(()),
        Some(_) if !is_there => Ok(()),
        Some(status) => Err(format!("status {status} and an output file")),
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
        "ulimit -v {MEMORY_LIMIT}; ulimit -d {memory}; ulimit -S -t {PROCESSOR_LIMIT}; {} exec \"$@\" {}",
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
        wait(&mut child, edge).map_err(|finding| format!("{}: {finding}", words.join(" ")))
    })?;
    Ok(Ended { status, output: content(output)?, messages: content(messages)? })
}

/// Waits for the end of the program, and interrupts it when the edge says so.
fn wait(child: &mut Child, edge: Edge) -> Result<ExitStatus, String> {
    let begun = Instant::now();
    let mut signal = match edge {
        Edge::Signal { name, after_ms, .. } => Some((name, after_ms)),
        _ => None,
    };
    loop {
        if let Some(status) = child.try_wait().map_err(words)? {
            return Ok(status);
        }
        if let Some((name, _)) =
            signal.take_if(|(_, after)| begun.elapsed().as_millis() >= u128::from(*after))
        {
            let kill = format!("kill -s {name} {}", child.id());
            let status = Command::new("sh").args(["-c", &kill]).stderr(Stdio::null()).status();
            status.map_err(words)?;
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
    use std::io::Seek;
    let mut bytes = Vec::new();
    file.rewind().and_then(|()| file.read_to_end(&mut bytes)).map_err(words)?;
    Ok(bytes)
}
