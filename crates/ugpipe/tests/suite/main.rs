//! The behaviour of a program on the command line, tested on `examples/ugcat.rs`.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, its helpers too")]

use std::env;
use std::ffi::OsStr;
use std::fs::{self, File};
use std::io::{Read, Write};
use std::os::unix::ffi::OsStrExt;
use std::os::unix::fs::{MetadataExt, PermissionsExt, symlink};
use std::os::unix::process::ExitStatusExt;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::thread;
use std::time::Duration;

use tempfile::TempDir;

const SHIP: &str = "v A 0 0 0;\n";
const SIGPIPE: i32 = 13;

/// The example program, which cargo builds together with the tests.
fn ugcat() -> PathBuf {
    let test = env::current_exe().unwrap();
    let example = test.parent().and_then(Path::parent).unwrap().join("examples/ugcat");
    assert!(example.exists(), "{example:?} is not built; run `cargo test -p ugpipe`");
    example
}

/// A folder with one scene, `ship.ug`.
fn folder() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("ship.ug"), SHIP).unwrap();
    folder
}

/// `ugcat` in `folder`, without a terminal, so without colours.
fn command(folder: &TempDir, args: &[&str]) -> Command {
    let mut command = Command::new(ugcat());
    command.current_dir(folder).args(args).stdin(Stdio::null());
    command
}

fn run(folder: &TempDir, args: &[&str]) -> Output {
    command(folder, args).output().unwrap()
}

/// Runs `ugcat` with `input` on standard input.
fn feed(mut command: Command, input: &str) -> Output {
    command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().unwrap();
    child.stdin.take().unwrap().write_all(input.as_bytes()).unwrap();
    child.wait_with_output().unwrap()
}

/// Runs a line of shell, in which `$ugcat` is the program.
fn shell(folder: &TempDir, line: &str) -> Output {
    let mut command = Command::new("sh");
    command.current_dir(folder).args(["-c", line]).env("ugcat", ugcat()).stdin(Stdio::null());
    command.output().unwrap()
}

/// Asserts the exact status, standard output and standard error.
#[track_caller]
fn assert_run(output: &Output, status: i32, stdout: &str, stderr: &str) {
    assert_eq!(String::from_utf8_lossy(&output.stderr), stderr);
    assert_eq!(String::from_utf8_lossy(&output.stdout), stdout);
    assert_eq!(output.status.code(), Some(status));
}

/// The names of all files in `folder`, sorted, to check that no temporary files are left.
fn files(folder: &TempDir) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names =
        Vec::from_iter(entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()));
    names.sort();
    names
}

fn read(folder: &TempDir, name: &str) -> String {
    fs::read_to_string(folder.path().join(name)).unwrap()
}

/// The text of a file that another program is about to write.
#[track_caller]
fn await_text(folder: &TempDir, name: &str) -> String {
    let path = folder.path().join(name);
    for _ in 0..2000 {
        match fs::read_to_string(&path) {
            Ok(text) if text.ends_with('\n') => return text,
            _ => thread::sleep(Duration::from_millis(10)),
        }
    }
    panic!("{name} does not appear");
}

#[test]
fn input_is_a_file_or_standard_input() {
    let folder = folder();
    for args in [&["ship.ug"][..], &["-fi", "ship.ug"], &["--input", "ship.ug"], &["-fi=ship.ug"]] {
        assert_run(&run(&folder, args), 0, SHIP, "");
    }
    for args in [&[][..], &["-"], &["-fi", "-"], &["--", "-"], &["-fo", "-"]] {
        assert_run(&feed(command(&folder, args), "c red 0;\n"), 0, "c red 0;\n", "");
    }
}

#[test]
fn an_empty_pipe_is_an_error() {
    let empty = "ugcat: error: nothing came through the pipe: the program upstream failed, or wrote nothing\n";
    assert_run(&feed(command(&folder(), &[]), ""), 1, "", empty);
}

#[test]
fn file_names_need_not_be_utf_8() {
    let folder = folder();
    let name = OsStr::from_bytes(b"\xff.ug");
    fs::write(folder.path().join(name), SHIP).unwrap();
    for option in ["--", "-fi", "--input"] {
        let output = command(&folder, &[option]).arg(name).output().unwrap();
        assert_run(&output, 0, SHIP, "");
    }
    let output =
        command(&folder, &["ship.ug", "-fo"]).arg(OsStr::from_bytes(b"\xfe.ug")).output().unwrap();
    assert_run(&output, 0, "", "");
    assert!(folder.path().join(OsStr::from_bytes(b"\xfe.ug")).exists());

    let output = command(&folder, &[]).arg(OsStr::from_bytes(b"no\xff.ug")).output().unwrap();
    assert_run(
        &output,
        1,
        "",
        "ugcat: error: cannot read `no\u{fffd}.ug`: No such file or directory\n",
    );
}

#[test]
fn failures_have_a_status_and_a_message() {
    let folder = folder();
    #[track_caller]
    fn check(folder: &TempDir, args: &[&str], status: i32, stderr: &str) {
        let output = run(folder, args);
        assert_eq!(String::from_utf8_lossy(&output.stderr), stderr);
        assert_eq!(output.status.code(), Some(status));
    }
    check(&folder, &["x.ug"], 1, "ugcat: error: cannot read `x.ug`: No such file or directory\n");
    check(&folder, &["."], 1, "ugcat: error: `.` is a directory; name a file in it\n");
    check(&folder, &["-fo", "."], 1, "ugcat: error: cannot write `.`: Is a directory\n");
    check(
        &folder,
        &["-fo", "no/x.ug"],
        1,
        "ugcat: error: cannot write `no/x.ug`: there is no folder `no`\n",
    );
    check(
        &folder,
        &["-fm", "a/b/x"],
        1,
        "ugcat: error: cannot write `a/b/x`: there is no folder `a/b`\n",
    );
    check(&folder, &["-fail", "work"], 1, "ugcat: error: invalid digit found in string\n");
    check(&folder, &["-fail", "report"], 1, "ugcat: error: no face\n --> x.ug:1:2\n");
    let usage = "ugcat: error: `-vel` is too fast; stay below 1\ntry `ugcat -h`\n";
    check(&folder, &["-fail", "usage"], 2, usage);
    check(&folder, &["-qt", "-fail", "usage"], 2, usage);
}

#[test]
#[rustfmt::skip] // rows of a table
fn errors_in_the_command_line() {
    #[track_caller]
    fn check(args: &[&str], first_line: &str) {
        let output = run(&folder(), args);
        assert_eq!(String::from_utf8_lossy(&output.stderr).lines().next(), Some(first_line));
        assert_eq!(output.stdout, b"");
        assert_eq!(output.status.code(), Some(2));
    }
    check(&["-fi", "ship.ug", "ship.ug"], "ugcat: error: `-fi` and `[FILE]` cannot be given together");
    let dash = "ugcat: error: `\u{2013}` (U+2013) is a dash: write it as ASCII";
    check(&["\u{2013}vel", ".9", "0", "0", "ship.ug"], dash);
    check(&["ship.ug", "ship.ug"], "ugcat: error: `ship.ug` is one argument too many: options come with a dash, and there is one file");
    check(&["-fi"], "ugcat: error: `-fi` needs a value: `-fi FILE`");
    check(&["-vel", ".9", "0"], "ugcat: error: `-vel` takes three values, not two: write `-vel X Y Z`");
    check(&["-vel", ".9", "0", "-lax"], "ugcat: error: `-vel` takes three values, not two: write `-vel X Y Z`");
    for number in ["0", "-1", "1025", "1.5", "x"] {
        let range = "must be a whole number from 1 to 1024";
        check(&["-nt", number], &format!("ugcat: error: `{number}` is not valid for `-nt`: {range}"));
    }
    check(&["-qt", "-vb"], "ugcat: error: `-qt` and `-vb` cannot be given together");
    check(&["-qt", "-qt"], "ugcat: error: `-qt` is given twice");
    check(&["-zz"], "ugcat: error: there is no option `-zz`");
    check(&["-vell", ".9", "0", "0"], "ugcat: error: there is no option `-vell`; did you mean `-vel`?");
    check(&["-veloctiy", "1"], "ugcat: error: there is no option `-veloctiy`; did you mean `--velocity`?");
    check(&["-speed", ".9"], "ugcat: error: there is no option `-speed`; the velocity along x, y and z is `-vel`");
    check(&["-sz", "80", "60"], "ugcat: error: `-sz` is an option of ugrainbow, not of ugcat");
    check(&["-7", "ship.ug"], "ugcat: error: there is no option `-7`");
}

#[test]
fn letters_of_other_programs() {
    let folder = folder();
    let output = run(&folder, &["-q", "-o", "copy.ug", "-i", "ship.ug", "-j", "1"]);
    assert_run(&output, 0, "", "");
    assert!(folder.path().join("copy.ug").exists());
}

#[test]
fn messages_are_those_of_the_program_alone() {
    #[track_caller]
    fn check(name: &str, status: i32, expected: &str) {
        let output = run(&folder(), &[name]);
        let shown = String::from_utf8(output.stderr).unwrap();
        assert_eq!(shown.lines().next(), Some(expected));
        assert!(!shown.contains("\nugcat"), "{shown}");
        assert_eq!(output.status.code(), Some(status));
    }
    check(
        "no\nugcat: error: \u{1b}[2J\u{202e}",
        1,
        "ugcat: error: cannot read `no\u{fffd}ugcat: error: \u{fffd}[2J\u{fffd}`: No such file or directory",
    );
    check(
        "--\nugcat: error: \u{9b}2J",
        2,
        "ugcat: error: there is no option `--\u{fffd}ugcat: error: \u{fffd}2J`",
    );
}

#[test]
fn help_and_version() {
    let folder = folder();
    for option in ["-version", "--version"] {
        assert_run(
            &run(&folder, &[option]),
            0,
            &format!("ugcat {}\n", env!("CARGO_PKG_VERSION")),
            "",
        );
    }
    for option in ["-help", "--help", "-h"] {
        let output = run(&folder, &[option]);
        assert_eq!(String::from_utf8_lossy(&output.stderr), "");
        assert_eq!(output.status.code(), Some(0));
        let help = String::from_utf8_lossy(&output.stdout);
        assert!(
            help.starts_with("Copies its input to its output\n\nUsage: ugcat [OPTIONS] [FILE]\n"),
            "{help}"
        );
        assert!(help.contains("\nExamples:\n  ugcat -head ship.ug > copy.ug\n"), "{help}");
        let names = if option == "-h" {
            "-vel X Y Z; -va A [B]; --title TITLE; -head ; -fo FILE"
        } else {
            "-fi, --input FILE; -fo, --output FILE; -fm, --messages FILE; -lax; -qt, --quiet; -vb, --verbose; \
             -nt, --threads N; -h, --help; -va A [B]"
        };
        for name in names.split("; ") {
            assert!(help.contains(&format!("\n  {name}")), "{name} is not in {help}");
        }
    }
}

#[test]
fn a_number_after_an_option_without_values() {
    let folder = folder();
    let message = "ugcat: error: `-head` takes no value: leave out `0`\ntry `ugcat -h`\n";
    assert_run(&run(&folder, &["-head", "0", "ship.ug"]), 2, "", message);
    fs::write(folder.path().join("0"), SHIP).unwrap();
    let output = run(&folder, &["-say", "-qt", "0"]);
    assert_eq!(
        (output.status.code(), String::from_utf8_lossy(&output.stdout).as_ref()),
        (Some(0), SHIP)
    );
}

#[test]
fn the_command_line_is_recorded_without_streams_and_threads() {
    let folder = folder();
    let args = "--velocity -.9 0 -1e-3 -va 40 -fo out.ug -nt 2 -head -title {a} ship.ug";
    assert_run(&run(&folder, &Vec::from_iter(args.split(' '))), 0, "", "");
    assert_eq!(
        read(&folder, "out.ug"),
        format!(
            "{{ ugcat -vel -.9 0 -1e-3 -va 40 --head --title \"$(printf '\\173')\"'a'\"$(printf '\\175')\" }}\n{SHIP}"
        )
    );
}

#[test]
fn messages_go_to_standard_error_or_a_file() {
    const WARNINGS: &str = "ugcat: warning: nearly all\nugcat: warning: this face\n --> x.ug:1:2\n";
    let folder = folder();
    let notes = |n_threads: &str, name: &str| {
        let rest = format!("ugcat: note: terminal false, name {name}, threads {n_threads}\n");
        format!("ugcat: note: all is well\n{WARNINGS}{rest}")
    };
    assert_run(&run(&folder, &["-say", "-nt", "3"]), 0, "", &notes("3", "None"));
    assert_run(&run(&folder, &["-say", "-nt", "1", "-fm", "-"]), 0, "", &notes("1", "None"));
    assert_run(&run(&folder, &["-say", "-nt", "1", "-fo", "x"]), 0, "", &notes("1", "Some(\"x\")"));
    assert_run(&run(&folder, &["-say", "-qt"]), 0, "", "");

    fs::write(folder.path().join("log"), "an older and longer log\n".repeat(99)).unwrap();
    assert_run(&run(&folder, &["-say", "-nt", "1", "-fm", "log"]), 0, "", "");
    assert_eq!(read(&folder, "log"), notes("1", "None"));
    assert_run(&run(&folder, &["-fm", "log", "-fail", "report"]), 1, "", "");
    assert_eq!(read(&folder, "log"), "ugcat: error: no face\n --> x.ug:1:2\n");
    // If the message file is full, the error goes to standard error.
    let full = run(&folder, &["-fm", "/dev/full", "-fail", "work"]);
    assert_run(&full, 1, "", "ugcat: error: invalid digit found in string\n");
}

#[test]
fn details_come_with_times() {
    let output = run(&folder(), &["-say", "-vb"]);
    let stderr = String::from_utf8(output.stderr).unwrap();
    let detail = stderr.lines().find(|line| line.ends_with(" s: 24 faces")).expect(&stderr);
    let seconds: f64 = detail.split(' ').nth(1).unwrap().parse().unwrap();
    assert!((0.0..60.0).contains(&seconds), "{detail}");
}

#[test]
fn output_files_are_replaced_atomically() {
    let folder = folder();
    assert_run(&run(&folder, &["ship.ug", "-fo", "out.ug"]), 0, "", "");
    assert_eq!(read(&folder, "out.ug"), SHIP);
    assert_eq!(files(&folder), ["out.ug", "ship.ug"]);
    // In place: the whole file has been read before it is replaced.
    assert_run(&run(&folder, &["ship.ug", "-fo", "ship.ug", "-head"]), 0, "", "");
    assert_eq!(read(&folder, "ship.ug"), format!("{{ ugcat --head }}\n{SHIP}"));
}

#[test]
fn output_files_of_failed_runs_do_not_appear() {
    let folder = folder();
    assert_eq!(run(&folder, &["ship.ug", "-fo", "new.ug", "-fail", "work"]).status.code(), Some(1));
    assert_eq!(run(&folder, &["no.ug", "-fo", "new.ug"]).status.code(), Some(1));
    assert_eq!(files(&folder), ["ship.ug"]);
    fs::write(folder.path().join("old.ug"), "old").unwrap();
    assert_eq!(
        run(&folder, &["ship.ug", "-fo", "old.ug", "-fail", "usage"]).status.code(),
        Some(2)
    );
    assert_eq!(read(&folder, "old.ug"), "old");
    assert_eq!(files(&folder), ["old.ug", "ship.ug"]);
}

#[test]
fn a_full_disk_leaves_no_file() {
    let folder = folder();
    let stdout = shell(&folder, "\"$ugcat\" ship.ug > /dev/full");
    assert_run(&stdout, 1, "", "ugcat: error: cannot write `<stdout>`: No space left on device\n");
    let unwritable = shell(&folder, "\"$ugcat\" ship.ug 1< /dev/null");
    assert_run(&unwritable, 1, "", "ugcat: error: cannot write `<stdout>`: Bad file descriptor\n");
    for option in ["--help", "-h", "--version", "--complete --t"] {
        let help = shell(&folder, &format!("\"$ugcat\" {option} > /dev/full"));
        let message = "ugcat: error: cannot write `<stdout>`: No space left on device\n";
        assert_run(&help, 1, "", message);
    }

    // A limit on the file size simulates a full disk: half of the output fits.
    fs::write(folder.path().join("old.ug"), "old").unwrap();
    let line = "trap '' XFSZ; ulimit -f 64; head -c 99999 /dev/zero | \"$ugcat\" -fo ";
    for name in ["new.ug", "old.ug"] {
        let output = shell(&folder, &format!("{line}{name}"));
        assert_run(
            &output,
            1,
            "",
            &format!("ugcat: error: cannot write `{name}`: File too large\n"),
        );
    }
    assert_eq!(read(&folder, "old.ug"), "old");
    assert_eq!(files(&folder), ["old.ug", "ship.ug"]);
}

#[test]
fn no_output_destroys_an_input_or_another_output() {
    #[track_caller]
    fn check(line: &str, message: &str) {
        let folder = folder();
        symlink("ship.ug", folder.path().join("link.ug")).unwrap();
        let output = shell(&folder, line);
        assert_run(&output, 2, "", &format!("ugcat: error: {message}\ntry `ugcat -h`\n"));
        assert_eq!(read(&folder, "ship.ug"), SHIP);
        assert_eq!(files(&folder), ["link.ug", "ship.ug"]);
    }
    check("$ugcat ship.ug -fm ship.ug", "-fm `ship.ug` would overwrite the input, file `ship.ug`");
    check(
        "$ugcat ship.ug -fm ./link.ug",
        "-fm `./link.ug` would overwrite the input, file `ship.ug`",
    );
    check(
        "$ugcat < ship.ug -fm ship.ug",
        "-fm `ship.ug` would overwrite the input, standard input",
    );
    check(
        "$ugcat -fi link.ug -at ship.ug",
        "-at `ship.ug` would overwrite the input, file `link.ug`",
    );
    check(
        "$ugcat ship.ug -fm f -fo ./f",
        "two outputs cannot go to one file: -fo `./f` and -fm `f`",
    );
    check(
        "$ugcat ship.ug -at f -fm ./f",
        "two outputs cannot go to one file: -fm `./f` and -at `f`",
    );
    check(
        "$ugcat ship.ug -at ship.ug -fo link.ug",
        "two outputs cannot go to one file: -fo `link.ug` and -at `ship.ug`",
    );
}

#[test]
fn the_output_may_replace_its_input_and_devices_are_shared() {
    let folder = folder();
    assert_run(&run(&folder, &["ship.ug", "-head", "-fo", "./ship.ug"]), 0, "", "");
    assert_eq!(read(&folder, "ship.ug"), format!("{{ ugcat --head }}\n{SHIP}"));
    let line = "$ugcat ship.ug -fm /dev/null -at /dev/null -fo /dev/null";
    assert_run(&shell(&folder, line), 0, "", "");
    assert_run(&shell(&folder, "$ugcat ship.ug > f && cat f"), 0, &read(&folder, "ship.ug"), "");
}

/// Waits until a program has ended, on Linux; a killed program may remain as a zombie.
#[track_caller]
fn await_end(pid: &str, signal: &str) {
    let is_running = || {
        let stat = fs::read_to_string(format!("/proc/{pid}/stat")).unwrap_or_default();
        stat.rsplit_once(") ").is_some_and(|(_, state)| !state.starts_with(['Z', 'X']))
    };
    for _ in 0..500 {
        if !is_running() {
            return;
        }
        thread::sleep(Duration::from_millis(10));
    }
    panic!("the program still runs after {signal}");
}

/// True if this process ignores a signal. Always false on systems other than Linux.
fn is_ignored(signal: i32) -> bool {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:")).unwrap_or("0");
    u64::from_str_radix(mask.trim(), 16).unwrap() >> (signal - 1) & 1 == 1
}

#[test]
fn signals_leave_no_files_and_no_programs() {
    let names = ["INT", "TERM", "HUP", "QUIT", "ALRM", "XCPU", "USR1", "VTALRM"];
    for (signal, number) in names.into_iter().zip([2, 15, 1, 3, 14, 24, 10, 26]) {
        // What ignores a signal, as a job in the background does, passes that on to its children.
        if is_ignored(number) {
            assert_ne!(signal, "TERM");
            continue;
        }
        let folder = folder();
        let program = folder.path().join("program");
        fs::write(&program, "#!/bin/sh\necho $$ > pid; sleep 100\n").unwrap();
        fs::set_permissions(&program, PermissionsExt::from_mode(0o755)).unwrap();
        let args = ["ship.ug", "-fo", "out.ug", "-execute", "./program"];
        let mut child = command(&folder, &args).spawn().unwrap();
        let pid = await_text(&folder, "pid");
        assert!(files(&folder).iter().any(|name| name.starts_with(".ug-")), "{signal}");
        shell(&folder, &format!("kill -{signal} {}", child.id()));
        assert_eq!(child.wait().unwrap().signal(), Some(number));
        assert_eq!(files(&folder), ["pid", "program", "ship.ug"], "{signal}");
        await_end(pid.trim(), signal);
    }
}

#[test]
fn a_limit_on_the_size_of_files_leaves_nothing() {
    let folder = folder();
    fs::write(folder.path().join("large.ug"), "# \n".repeat(100_000)).unwrap();
    let output = shell(&folder, "ulimit -f 100; $ugcat large.ug -fo out.ug");
    assert_run(&output, 1, "", "ugcat: error: cannot write `out.ug`: File too large\n");
    assert_eq!(files(&folder), ["large.ug", "ship.ug"]);
}

/// A program that is killed leaves its temporary file; the next one in the folder deletes it, and
/// keeps those of programs that run.
#[test]
fn the_next_run_deletes_what_was_left() {
    let folder = folder();
    let temporary = || {
        let names = files(&folder).into_iter().filter(|name| name.starts_with(".ug-"));
        names.collect::<Vec<_>>()
    };
    let linger = |seconds: &str| {
        let n_before = temporary().len();
        let child =
            command(&folder, &["ship.ug", "-fo", "out.ug", "-linger", seconds]).spawn().unwrap();
        let has_begun = (0..2000).any(|_| {
            thread::sleep(Duration::from_millis(5));
            temporary().len() > n_before
        });
        assert!(has_begun, "no temporary file appears");
        child
    };
    let mut killed = linger("100");
    killed.kill().unwrap();
    killed.wait().unwrap();
    assert_eq!(temporary().len(), 1);
    fs::write(folder.path().join(".ug-notes"), "of a person").unwrap();
    let left = temporary();
    assert_run(&run(&folder, &["ship.ug", "-fo", "other.ug"]), 0, "", "");
    assert_eq!(temporary(), [".ug-notes"], "{left:?}");
    let mut running = linger("100");
    assert_run(&run(&folder, &["ship.ug", "-fo", "other.ug"]), 0, "", "");
    assert_eq!(temporary().len(), 2);
    running.kill().unwrap();
    running.wait().unwrap();
}

#[test]
fn streams_memory_and_variables_that_a_shell_sets() {
    let folder = folder();
    let error = |message: &str| format!("ugcat: error: cannot {message}\n");
    for (line, status, stdout, stderr) in [
        ("$ugcat 0> /dev/null", 1, "", error("read `<stdin>`: Bad file descriptor")),
        // An endless input ends.
        ("ulimit -v 1000000; $ugcat /dev/zero", 1, "", error("read `/dev/zero`: out of memory")),
        // Threads are started as far as the address space suffices.
        ("ulimit -v 30000; $ugcat -nt 64 ship.ug", 0, SHIP, String::new()),
        ("ulimit -v 100000; $ugcat -nt 64 ship.ug", 0, SHIP, String::new()),
        ("ulimit -v 500000; $ugcat -nt 64 ship.ug", 0, SHIP, String::new()),
        // Their number is not chosen by a variable.
        ("RAYON_NUM_THREADS=99999999 $ugcat ship.ug", 0, SHIP, String::new()),
    ] {
        assert_run(&shell(&folder, line), status, stdout, &stderr);
    }
}

#[test]
fn an_ignored_signal_stays_ignored() {
    let folder = folder();
    let line = "trap '' HUP; $ugcat ship.ug -fo out.ug -linger 1 & \
                while ! ls .ug-* >/dev/null 2>&1; do sleep .01; done; kill -HUP $!; wait $!";
    assert_run(&shell(&folder, line), 0, "", "");
    assert_eq!(files(&folder), ["out.ug", "ship.ug"]);
}

#[test]
fn a_link_stays_and_its_target_is_written() {
    let folder = folder();
    fs::create_dir(folder.path().join("deep")).unwrap();
    for (link, target) in [("a", "deep/out.ug"), ("b", "a"), ("deep/c", "../dangling.ug")] {
        symlink(target, folder.path().join(link)).unwrap();
    }
    for (link, target) in [("a", "deep/out.ug"), ("b", "deep/out.ug"), ("deep/c", "dangling.ug")] {
        assert_run(&run(&folder, &["ship.ug", "-fo", link]), 0, "", "");
        assert!(folder.path().join(link).is_symlink(), "{link}");
        assert_eq!(read(&folder, target), SHIP);
        fs::write(folder.path().join(target), "old").unwrap();
    }
    symlink("loop", folder.path().join("loop")).unwrap();
    let output = run(&folder, &["ship.ug", "-fo", "loop"]);
    assert_run(
        &output,
        1,
        "",
        "ugcat: error: cannot write `loop`: Too many levels of symbolic links\n",
    );
}

#[test]
fn permissions_are_those_of_the_umask_or_the_old_file() {
    let folder = folder();
    let mode = |name: &str| fs::metadata(folder.path().join(name)).unwrap().mode() & 0o7777;
    for (umask, expected) in [("022", 0o644), ("027", 0o640), ("000", 0o666)] {
        let output = shell(&folder, &format!("umask {umask}; \"$ugcat\" ship.ug -fo m{umask}"));
        assert_run(&output, 0, "", "");
        assert_eq!(mode(&format!("m{umask}")), expected);
    }
    fs::set_permissions(folder.path().join("m022"), fs::Permissions::from_mode(0o604)).unwrap();
    assert_run(&run(&folder, &["ship.ug", "-fo", "m022"]), 0, "", "");
    assert_eq!(mode("m022"), 0o604);
}

#[test]
fn named_pipes_are_written_to() {
    let folder = folder();
    // Tests a named pipe. That devices are not replaced is tested in `src/output.rs`, where a bug
    // cannot replace one, even for root.
    assert_run(&run(&folder, &["ship.ug", "-fo", "/dev/stdout"]), 0, SHIP, "");
    let output = shell(&folder, "mkfifo pipe && { \"$ugcat\" ship.ug -fo pipe & cat pipe; wait; }");
    assert_run(&output, 0, SHIP, "");
    assert_eq!(files(&folder), ["pipe", "ship.ug"]);
}

#[test]
fn closed_streams_are_errors_where_they_are_needed() {
    let folder = folder();
    let check = |line: &str, status: i32, message: &str| {
        let message = match message {
            "" => String::new(),
            what => {
                format!("ugcat: error: cannot {what}: it was closed when the program was started\n")
            }
        };
        assert_run(&shell(&folder, &format!("\"$ugcat\" {line}")), status, "", &message);
    };
    for words in ["ship.ug", "ship.ug -fo -", "--help", "-h", "--version", "--complete --t"] {
        check(&format!("{words} >&-"), 1, "write `<stdout>`");
        check(&format!("{words} > /dev/null"), 0, "");
        check(&format!("{words} 1<> /dev/null"), 0, "");
        check(&format!("{words} 2>&- > /dev/null"), 0, "");
    }
    check("ship.ug -fo copy.ug <&- >&-", 0, "");
    assert_eq!(read(&folder, "copy.ug"), SHIP);
    check("<&-", 1, "read `<stdin>`");
    check("<&- >&-", 1, "read `<stdin>`");
}

#[test]
fn a_closed_pipe_ends_the_program_by_sigpipe() {
    let folder = folder();
    for args in [&["ship.ug"][..], &["--help"], &["ship.ug", "-fo", "/dev/stdout"]] {
        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        let output = command(&folder, args).stdout(writer).stderr(Stdio::piped()).output().unwrap();
        assert_eq!(output.status.signal(), Some(SIGPIPE), "{args:?}");
        assert_eq!(String::from_utf8_lossy(&output.stderr), "");
    }
    // The status that a shell sees, with more output than a pipe can buffer.
    fs::write(folder.path().join("big"), vec![b'x'; 1 << 20]).unwrap();
    let line = "{ \"$ugcat\" big; echo $? >&2; } | head -c 1";
    assert_run(&shell(&folder, line), 0, "x", "141\n");
}

#[test]
fn a_megabyte_passes_a_pipe_unchanged() {
    let folder = folder();
    let text = "v A 0.1 0.2 0.3;\n".repeat(1 << 16);
    assert_run(&feed(command(&folder, &[]), &text), 0, &text, "");
}

/// Runs `command` with all streams on a new terminal on which the user types `typed`. Returns the
/// status and everything that appeared on the screen.
fn on_terminal(mut command: Command, typed: &[u8]) -> (Option<i32>, String) {
    use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};

    let master = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY).unwrap();
    grantpt(&master).unwrap();
    unlockpt(&master).unwrap();
    let name = ptsname(&master, Vec::new()).unwrap();
    let open =
        || File::options().read(true).write(true).open(OsStr::from_bytes(name.as_bytes())).unwrap();
    let mut child = command.stdin(open()).stdout(open()).stderr(open()).spawn().unwrap();
    // The command owns copies of the terminal; as long as they are open, reading does not end.
    drop(command);

    let mut master = File::from(master);
    master.write_all(typed).unwrap();
    let mut screen = Vec::new();
    // Linux reports the end of a terminal's data as an error.
    let _ = master.read_to_end(&mut screen);
    (child.wait().unwrap().code(), String::from_utf8(screen).unwrap().replace('\r', ""))
}

/// Like [`command`], on a terminal with colours, and without the colour settings of the tester's
/// environment.
fn command_in_color(folder: &TempDir, args: &[&str]) -> Command {
    let mut command = command(folder, args);
    command.env("TERM", "xterm");
    for name in ["NO_COLOR", "CLICOLOR", "CLICOLOR_FORCE"] {
        command.env_remove(name);
    }
    command
}

#[test]
fn waiting_for_terminal_input_is_announced() {
    const END: &[u8] = b"\x04";
    const WAITING: &str = "reading standard input; -h for help\n";
    let folder = folder();
    let waits = |args: &[&str]| {
        let (status, screen) = on_terminal(command(&folder, args), END);
        assert_eq!(status, Some(0), "{screen}");
        screen.contains(WAITING)
    };
    assert!(waits(&[]));
    assert!(waits(&["-fo", "out.ug"]));
    assert!(!waits(&["-"]));
    assert!(!waits(&["-fi", "-"]));
    assert!(!waits(&["-qt"]));
    assert!(!waits(&["ship.ug"]));
}

#[test]
fn terminal_output_is_detected() {
    let folder = folder();
    for (args, expected) in [
        (&["-say", "ship.ug"][..], "terminal true, name None"),
        (&["-say", "ship.ug", "-fo", "-"], "terminal true, name None"),
        (&["-say", "ship.ug", "-fo", "out.ug"], "terminal false, name Some(\"out.ug\")"),
    ] {
        let (status, screen) = on_terminal(command(&folder, args), b"");
        assert_eq!(status, Some(0));
        assert!(screen.contains(expected), "{screen}");
    }
}

#[test]
fn a_terminal_shows_colors_unless_unwanted() {
    let folder = folder();
    let args = ["-say", "ship.ug"];
    let (_, screen) = on_terminal(command_in_color(&folder, &args), b"");
    assert!(screen.contains("ugcat: \x1b[1m\x1b[33mwarning:\x1b[0m nearly all\n"), "{screen:?}");
    assert!(screen.contains("\x1b[1mwarning\x1b[0m: this face\n"), "{screen:?}");

    let mut without = command_in_color(&folder, &args);
    without.env("NO_COLOR", "1");
    let (_, screen) = on_terminal(without, b"");
    assert!(
        screen.contains("ugcat: warning: nearly all\nugcat: warning: this face\n"),
        "{screen:?}"
    );
    assert!(!screen.contains('\x1b'), "{screen:?}");
}

#[test]
fn a_long_run_shows_a_progress_bar_on_terminals_only() {
    let folder = folder();
    let screen = |args: &[&str]| {
        let (status, screen) = on_terminal(command_in_color(&folder, args), b"");
        assert_eq!(status, Some(0), "{screen}");
        screen
    };
    let long = screen(&["-work", "1.4", "ship.ug", "-fo", "out.ug"]);
    assert!(long.contains("ugcat: working [") && long.contains("75%"), "{long:?}");
    // The bar has been cleared at the end.
    assert!(long.ends_with("\x1b[2K") || long.trim_end().ends_with("\x1b[2K"), "{long:?}");
    assert_eq!(screen(&["-work", "1.4", "ship.ug", "-qt", "-fo", "out.ug"]), "");
    assert_eq!(screen(&["-work", "0", "ship.ug", "-fo", "out.ug"]), "");
    assert_run(&run(&folder, &["-work", "1.4", "ship.ug"]), 0, SHIP, "");
}

#[test]
fn steps_print_their_times_when_verbose() {
    let folder = folder();
    let told = run(&folder, &["-work", "0", "-vb", "ship.ug"]);
    let lines = String::from_utf8(told.stderr).unwrap();
    let steps: Vec<&str> = lines
        .lines()
        .filter_map(|line| line.split(" s: ").nth(1)?.split(" took ").next())
        .collect();
    assert_eq!(steps, ["thinking", "working", "writing"], "{lines}");
}
