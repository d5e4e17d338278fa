//! Command lines that the programs print, through the shells of today.

use std::ffi::{OsStr, OsString};
use std::os::unix::ffi::{OsStrExt, OsStringExt};
use std::path::Path;
use std::process::{Command, Output};

use ugpipe::{shell_os_word, shell_pipe};
use ugtesting::Random;
use ugtests::shell::Shell;
use ugtests::tools::{self, Tool};

/// The shells, each with the words before its option `-c`.
const SHELLS: [(Tool, &[&str]); 4] =
    [(tools::DASH, &[]), (tools::BASH, &[]), (tools::ZSH, &[]), (tools::BUSYBOX, &["sh"])];

/// Runs a script in every shell that is there.
fn in_every_shell(folder: &Path, script: &str, check: impl Fn(&str, Output)) {
    for (shell, first) in SHELLS {
        if tools::has(&[shell]) {
            let mut command = Command::new(shell.program);
            command.args(first).args(["-c", script]).current_dir(folder);
            check(shell.program, command.output().unwrap());
        }
    }
}

/// Every byte alone, between digits and between line ends, what shells treat specially, and random
/// words.
fn words() -> Vec<OsString> {
    let mut words: Vec<Vec<u8>> = (1..=255).map(|byte| vec![byte]).collect();
    words.push((1..=255).flat_map(|byte| [b'7', byte]).collect());
    words.push((1..=255).flat_map(|byte| [byte, b'\n']).chain([b'7']).collect());
    let texts = [
        "",
        "a b",
        "-vel",
        "--",
        "-",
        "=ls",
        "~",
        "~root",
        "it's",
        "a''b",
        "'''",
        "a'{",
        "{}'",
        "!!",
        "a!b",
        "$HOME",
        "${HOME}",
        "$(ls)",
        "`ls`",
        "\\",
        "a\\",
        "\\n",
        "\\\\012",
        "%s",
        "%%",
        "*",
        "?",
        "[a]",
        "{a,b}",
        "#",
        "a#b",
        "a;b",
        "a&b",
        "a|b",
        "a>b",
        "\n",
        "\n\n",
        "a\n",
        "\na",
        "a\n\n",
        "a\nb",
        "a\n\nb",
        "a\n'b",
        "a\r\n",
        "a\tb",
        "\u{202e}ab\u{202c}",
        "\u{2066}a",
        "a\u{2028}'\\\u{feff}{}",
        "γ",
        "船",
        "\u{a0}",
        "a\u{85}b",
        "e\u{301}",
        "🚀",
        "a{b'; touch INJECTED #",
        "\u{1b}[2J\u{7}",
    ];
    words.extend(texts.map(|text| text.as_bytes().to_vec()));
    let mut random = Random(1);
    words.extend((0..100).map(|_| (0..random.below(9)).map(|_| byte(&mut random)).collect()));
    words.into_iter().map(OsString::from_vec).collect()
}

fn byte(random: &mut Random) -> u8 {
    match random.one_in(2) {
        true => *random.pick(b"'\"\\$`\n{}()#;|&<>!~=% -01aZ\x1b\xe2\x80\xae\xff"),
        false => 1 + random.below(255) as u8,
    }
}

#[test]
fn shells_read_the_words_that_were_quoted() {
    let shell = Shell::new(&[]);
    let words = words();
    let check = |script: &str, words: &[&OsString]| {
        let is_shown = |c: char| ugpipe::is_printable(c) && !"{}".contains(c);
        assert!(script.chars().all(is_shown), "{script}");
        in_every_shell(shell.folder(), script, |name, output| {
            let messages = String::from_utf8_lossy(&output.stderr);
            assert!(output.status.success() && messages.is_empty(), "{name}: {messages}");
            let read: Vec<&[u8]> =
                output.stdout.strip_suffix(b"\0").unwrap().split(|&b| b == 0).collect();
            assert_eq!(read.len(), words.len(), "{name}");
            for (read, word) in read.into_iter().zip(words) {
                assert_eq!(OsStr::from_bytes(read), word.as_os_str(), "{name}");
            }
        });
    };
    // Another program receives them, as those of a pipe do.
    let print = ["env", "printf", r"%s\0"].map(OsString::from);
    let whole = |words: &[&OsString]| print.iter().chain(words.iter().copied()).cloned().collect();
    let lasting: Vec<&OsString> =
        words.iter().filter(|word| !word.as_bytes().ends_with(b"\n")).collect();
    let quoted: Vec<String> = lasting.iter().map(|word| shell_os_word(word)).collect();
    check(&format!(r"env printf '%s\0' {}", quoted.join(" ")), &lasting);
    assert!(shell_pipe::<OsString>(&[whole(&lasting)], None).ends_with(&quoted.join(" ")));
    // Words that end in a line end.
    let all: Vec<&OsString> = words.iter().collect();
    assert!(lasting.len() + 5 < all.len());
    check(&shell_pipe::<OsString>(&[whole(&all)], None), &all);
}

#[test]
fn shells_pass_pipes_to_files_with_any_name() {
    for name in
        ["out", "a b", "-x", "a{b'; touch INJECTED #", "a\n", "\u{202e}", "$(touch INJECTED)"]
    {
        let shell = Shell::new(&[]);
        let line =
            shell_pipe(&[vec!["printf", "%s", "b\na\n"], vec!["sort"]], Some(OsStr::new(name)));
        in_every_shell(shell.folder(), &line, |program, output| {
            assert!(output.status.success(), "{program}: {line}");
            assert_eq!(shell.read(name), b"a\nb\n", "{program}");
            let names = std::fs::read_dir(shell.folder()).unwrap();
            let names: Vec<OsString> = names.map(|entry| entry.unwrap().file_name()).collect();
            assert_eq!(names, [name], "{program}");
            std::fs::remove_file(shell.path(name)).unwrap();
        });
    }
}

/// What a stranger writes into the names and texts of a picture or a film runs in no shell.
#[test]
fn printed_commands_of_strangers_run_nothing_else() {
    let shell = Shell::new(&[]);
    let text = "a{b'; touch INJECTED #";
    shell.write(
        "q.ug",
        "v a -1 0 -1; v b 1 0 -1; v c 0 0 1;\nf (a b c) ;\ncam -ep 0 -6 1 -vc 0 0 0 ;\n",
    );
    shell.write(&format!("{text}.ug"), shell.read("q.ug"));
    shell.write("scene{1}.ug", shell.read("q.ug"));
    let size = "-sz 300 200 -aa 1";
    let film = "ugfilm -qt -frames 2 -vel '0..0.5' 0 0 -ex 0 -sz 16 12 -aa 1";
    shell.run(&format!(
        "ugrainbow -qt {size} -cap \"{text}\" -fo stranger.png q.ug
         ugrainbow -qt {size} -fo braces.png 'scene{{1}}.ug'
         ugsheet --history stranger.png > 1; ugsheet --history braces.png > 2
         {film} --print 1 -fo f_%d.png \"{text}.ug\" > 3
         {film} -fo page.html \"{text}.ug\"; {film} -fo \"{text}%d.png\" q.ug --print 1 > 4"
    ));
    let page = String::from_utf8(shell.read("page.html")).unwrap();
    let line = page.lines().find(|line| line.contains("touch INJECTED")).unwrap();
    assert!(line.contains("printf") && line.contains("\\173"), "{line}");
    for (name, picture) in
        [("1", Some("stranger.png")), ("2", Some("braces.png")), ("3", None), ("4", None)]
    {
        let script = String::from_utf8(shell.read(name)).unwrap();
        let path = format!("PATH={}", shell_os_word(&ugtests::programs::path()));
        in_every_shell(shell.folder(), &format!("{path}\n{script}"), |program, output| {
            let messages = String::from_utf8_lossy(&output.stderr);
            assert!(output.status.success(), "{program}: {script}: {messages}");
            if let Some(picture) = picture {
                assert!(output.stdout == shell.read(picture), "{program}: {script}");
            }
            assert!(!shell.path("INJECTED").exists(), "{program}: {script}");
        });
    }
}
