//! Texts put together from files: `include`, and what the C preprocessor leaves behind.

use std::io;
use std::path::Path;

use ugparse::{Options, Source};

use crate::{check, check_error, parse, write};

/// Reads `scene.ug` of some files; gives what is written, or the messages.
fn read(files: &[(&str, &str)]) -> String {
    let load = |path: &Path| {
        let found = files.iter().find(|(name, _)| Path::new(name) == path);
        found.map(|(_, text)| text.as_bytes().to_vec()).ok_or_else(|| io::Error::other("no such file"))
    };
    let options = Options::default();
    let scene = Source::new(files[0].0, files[0].1);
    match ugparse::include(scene, &options, load).and_then(|whole| ugparse::parse(&whole, &options)) {
        Ok(parsed) => write(&parsed.scene),
        Err(found) => found.render(false),
    }
}

/// The first line of the first message, and the place.
fn message(files: &[(&str, &str)]) -> String {
    let text = read(files);
    let mut lines = text.lines();
    let title = lines.next().unwrap_or_default();
    let place = lines.next().unwrap_or_default().trim().trim_start_matches("--> ");
    format!("{title} at {place}")
}

#[test]
fn files_are_included() {
    let triangle = ("sub/triangle.ug", "v a 0 0 0;\nv b 1 0 0;\nv c 0 1 0;\nf (a b c) red");
    let colors = ("colors.ug", "{ of colours }\nc red 1 0;\n");
    let expected = "{ head }\nc red 1 0 1;\nv t:a 0 0 0;\nv t:b 1 0 0;\nv t:c 0 1 0;\nf (t:a t:b t:c) red;\n";
    let scene = "{ head }\ndef t; include sub/triangle.ug; end; i (t);\ninclude \"sub/../colors.ug\" ;";
    let whole = format!("{};", triangle.1);
    let written = read(&[("scene.ug", scene), (triangle.0, &whole), ("colors.ug", "c red 1 0;")]);
    assert_eq!(written, expected);
    // Names are relative to the file they stand in.
    let inner = [
        ("a/scene.ug", "include b/one.ug;"),
        ("a/b/one.ug", "include ../two.ug;"),
        ("a/two.ug", "v p 1 2 3;"),
    ];
    assert_eq!(read(&inner), "v p 1 2 3;\n");
    // The same file twice is no circle.
    assert_eq!(
        read(&[("s.ug", "include c.ug; include c.ug;"), ("c.ug", "{ again }")]).matches("again").count(),
        2
    );
    assert!(read(&[("s.ug", "include colors.ug;"), colors]).contains("c red 1 0 1;"));
    // `include` is a good name.
    assert_eq!(read(&[("s.ug", "v include 0 0 0;")]), "v include 0 0 0;\n");
}

#[test]
fn messages_name_the_file_that_is_wrong() {
    let check = |files: &[(&str, &str)], expected: &str| assert_eq!(message(files), expected, "{files:?}");
    check(&[("s.ug", "\ninclude no.ug;")], "error: cannot read `no.ug`: no such file at s.ug:2:9");
    check(&[("s.ug", "include s.ug;")], "error: file `s.ug` includes itself at s.ug:1:9");
    check(
        &[("s.ug", "include t.ug;"), ("t.ug", "{}\n include \"./s.ug\";")],
        "error: file `./s.ug` includes itself at t.ug:2:11",
    );
    check(
        &[("s.ug", "include t.ug;"), ("t.ug", "\n\nv a 0 0 red;")],
        "error: expected a number, found `red` at t.ug:3:9",
    );
    check(
        &[("s.ug", "include t.ug;"), ("t.ug", "v a 0 0 0\n")],
        "error: expected `;`, found the end of the file at t.ug:1:10",
    );
    check(
        &[("s.ug", "include t.ug;"), ("t.ug", "def d;\n")],
        "error: definition `d` is not closed at t.ug:1:5",
    );
    // In the file itself, behind what it includes.
    check(
        &[("s.ug", "{\n}\ninclude t.ug;\nv b 1 2 3;\nf (a b c);"), ("t.ug", "v a 0 0 0;\n\n\n")],
        "error: vertex `c` is not defined at s.ug:5:8",
    );
    check(
        &[("s.ug", "include t.ug;\nv b 1 2 3;"), ("t.ug", "\n\nf (b b c);\n\n\n")],
        "error: vertex `c` is not defined at t.ug:3:8",
    );
    check(
        &[("s.ug", "include;")],
        "error: expected a file name, in quotes if there are blanks in it, found `;` at s.ug:1:8",
    );
    let deep: Vec<(String, String)> =
        (0..70).map(|idx| (format!("{idx}"), format!("include {};", idx + 1))).collect();
    let deep: Vec<(&str, &str)> = deep.iter().map(|(name, text)| (&name[..], &text[..])).collect();
    check(&deep, "error: files include each other too deeply at 64:1:9");
    let double: Vec<(String, String)> =
        (0..60).map(|idx| (format!("{idx}"), format!("include {0}; include {0};", idx + 1))).collect();
    let mut double: Vec<(&str, &str)> = double.iter().map(|(name, text)| (&name[..], &text[..])).collect();
    double.push(("60", ""));
    assert!(message(&double).starts_with("error: too many files are included"));
}

#[test]
fn texts_in_memory_include_nothing() {
    check_error("include a.ug;", "files are not included here");
}

#[test]
fn line_marks_set_file_and_line() {
    let place = |text: &str| message(&[("s.ug", text)]).split(" at ").last().unwrap().to_string();
    assert_eq!(place("# 7 \"old.ug\"\n\nf (a);"), "old.ug:8:4");
    assert_eq!(place("#line 7\nf (a);"), "s.ug:7:4");
    assert_eq!(place("# 7 \"old.ug\" 2 3\nv a 0 0 0;\n# 9\nf (b);"), "old.ug:9:4");
    assert_eq!(place("f (a);\n# 7 \"old.ug\""), "s.ug:1:4");
    assert_eq!(place("v # 0 0 0;\n  # 30 \"a b.ug\"\r\nf (#0);"), "a b.ug:30:4");
    assert_eq!(place("# 18446744073709551615 \"x\"\nf (a);"), "x:18446744073709551615:4");
    // They are no statements, and are not written.
    check("# 1 \"s.ug\"\n{ head }\n# 2\nv a 0 0 0;\n# 3", &["{ head }", "v a 0 0 0;"]);
    assert_eq!(parse("def d; # 1 \"x\"\nv p 0 0 0; end; i (d);").vertices.len(), 1);
    check_error("# pragma once\nv a 0 0 0;", "`#` is no statement");
    check_error("# 1 file\nv a 0 0 0;", "`#` is no statement");
}
