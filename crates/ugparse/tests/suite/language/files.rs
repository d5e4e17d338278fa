//! Texts from several files: `include`, `execute`, and line marks of the C preprocessor.

use std::io;
use std::path::Path;

use ugparse::{Limit, Limits, Options, Request, RequestError, RequestKind, Source};

use crate::language::{check, check_error, parse, written};

/// Parses the first of some files; returns the written scene, or the messages.
fn read(files: &[(&str, &str)]) -> String {
    read_with(files, &Options::default())
}

/// Like [`read`], with options. Programs are files whose text begins with `#!`, and print the rest;
/// with `#!3` they fail with that status.
fn read_with(files: &[(&str, &str)], options: &Options) -> String {
    let load = |request: &Request<'_>| {
        let found = files.iter().find(|(name, _)| Path::new(name) == request.path);
        let Some((_, text)) = found else { return Err(io::Error::other("no such file").into()) };
        match (request.kind, text.strip_prefix("#!")) {
            (RequestKind::Include | RequestKind::Path, None) => Ok(text.as_bytes().to_vec()),
            (RequestKind::Execute, Some(rest)) => match rest.strip_prefix('3') {
                Some(complaint) => Err(RequestError::Failed {
                    status: "exit status: 3".into(),
                    complaint: complaint.into(),
                }),
                None => Ok(rest.as_bytes().to_vec()),
            },
            _ => Err(io::Error::other("of another kind").into()),
        }
    };
    let scene = Source::new(files[0].0, files[0].1);
    match ugparse::include(scene, options, load).and_then(|whole| ugparse::parse(&whole, options)) {
        Ok(parsed) => written(&parsed),
        Err(found) => found.render(false),
    }
}

/// The first line of the first message, and its location.
fn message(files: &[(&str, &str)]) -> String {
    message_with(files, &Options::default())
}

fn message_with(files: &[(&str, &str)], options: &Options) -> String {
    let text = read_with(files, options);
    let mut lines = text.lines();
    let title = lines.next().unwrap_or_default();
    let place = lines.next().unwrap_or_default().trim().trim_start_matches("--> ");
    format!("{title} at {place}")
}

/// Columns in any order, others, blanks in place of commas, comments; the writer states the events.
#[test]
fn tables_are_read() {
    let scene = "include \"sub/ship.ug\";\nv a 0 0 0; v b 1 0 0; v c 0 1 0; f (a b c) <ship>;";
    let motion = "motion ship -spin 0 0 .1 -path { of the ship } \"my table.csv\" ;";
    let expected =
        "{ of the ship }\nmotion ship -path (-1 0 0 0 1 0.5 0 0 2 1 0.25 0) -spin 0 0 0.1;\n";
    for table in [
        "t,x,y,z\n-1,0,0,0\n1,0.5,0,0\n2,1,0.25,0\n",
        "\u{feff}# 7 \"other\"\r\n\r\n\"x\", \"y\", \"name\", \"z\", \"t\"\r\n0,0,here,0,-1\r\n5e-1,+0, ,0,1\r\n1,.25,there,0,2",
        "  t x y z\n -1 0 0 0\n# then\n 1\t.5 0 0\n 2 1 .25  0 \n\n",
    ] {
        let written =
            read(&[("scene.ug", scene), ("sub/ship.ug", motion), ("sub/my table.csv", table)]);
        assert!(written.starts_with(expected), "{table}: {written}");
        assert_eq!(read(&[("written.ug", &written)]), written);
    }
    // Errors further on have the lines of the scene.
    let table = ("a.csv", "t,x,y,z\n0,0,0,0\n1,0,0,0\n");
    let text = "motion ship -path a.csv ;\nv a 0 0 0; f (a b a) <ship>;";
    assert_eq!(message(&[("s.ug", text), table]), "error: vertex `b` is not defined at s.ug:2:17");
    let missing = message(&[("s.ug", "motion ship -path b.csv ;"), table]);
    assert_eq!(missing, "error: cannot read `b.csv`: no such file at s.ug:1:19");
    // A file of another kind is not quoted.
    let secret = read(&[("s.ug", "motion ship -path b.csv ;"), ("b.csv", "root:x:0\nt,x,y,z\n")]);
    assert!(secret.contains("is not a table of events") && !secret.contains("root"), "{secret}");
    // Without files a name is refused.
    let alone = ugparse::parse(&Source::new("s.ug", "motion a -path b.csv ;"), &Options::default());
    assert!(alone.unwrap_err().render(false).starts_with("error: tables are not read here"));
}

#[test]
fn file_names_of_tables_stay_as_they_are() {
    let tidy = |text: &str| {
        let tidied = ugparse::tidy(&Source::new("s.ug", text), &Options::default()).unwrap();
        String::from_utf8(tidied).unwrap()
    };
    let text = "motion a -path 007.50 -at 1.0 0 0 ;motion b -path {of} \"1.0 2\";motion c -path (0 0 0. 0 1.0 0 0 0);";
    let expected = "motion a -path 007.50 -at 1 0 0;\nmotion b -path {of} \"1.0 2\";\nmotion c -path (0 0 0 0 1 0 0 0);\n";
    assert_eq!(tidy(text), expected);
    assert_eq!(tidy(expected), expected);
}

#[test]
fn files_are_included() {
    let triangle = ("sub/triangle.ug", "v a 0 0 0;\nv b 1 0 0;\nv c 0 1 0;\nf (a b c) red");
    let colors = ("colors.ug", "{ of colours }\nc red 1 0;\n");
    let expected =
        "{ head }\nc red 1 0 1;\nv t:a 0 0 0;\nv t:b 1 0 0;\nv t:c 0 1 0;\nf (t:a t:b t:c) red;\n";
    let scene =
        "{ head }\ndef t; include sub/triangle.ug; end; i (t);\ninclude \"sub/../colors.ug\" ;";
    let whole = format!("{};", triangle.1);
    let written =
        read(&[("scene.ug", scene), (triangle.0, &whole), ("sub/../colors.ug", "c red 1 0;")]);
    assert_eq!(written, expected);
    // Names are relative to the file that contains them.
    let inner = [
        ("a/scene.ug", "include b/one.ug;"),
        ("a/b/one.ug", "include ../two.ug;"),
        // `b` may be a link: only the system knows where `b/..` is.
        ("a/b/../two.ug", "v p 1 2 3;"),
    ];
    assert_eq!(read(&inner), "v p 1 2 3;\n");
    // Including the same file twice is not recursive.
    assert_eq!(
        read(&[("s.ug", "include c.ug; include c.ug;"), ("c.ug", "{ again }")])
            .matches("again")
            .count(),
        2
    );
    assert!(read(&[("s.ug", "include colors.ug;"), colors]).contains("c red 1 0 1;"));
    // `include` is a valid name.
    assert_eq!(read(&[("s.ug", "v include 0 0 0;")]), "v include 0 0 0;\n");
}

#[test]
#[rustfmt::skip] // rows of a table
fn messages_name_the_file_that_is_wrong() {
    let check = |files: &[(&str, &str)], expected: &str| assert_eq!(message(files), expected, "{files:?}");
    check(&[("s.ug", "\ninclude no.ug;")], "error: cannot read `no.ug`: no such file at s.ug:2:9");
    check(&[("s.ug", "include s.ug;")], "error: file `s.ug` includes itself at s.ug:1:9");
    check(&[("s.ug", "include t.ug;"), ("t.ug", "{}\n include \"./s.ug\";")], "error: file `./s.ug` includes itself at t.ug:2:11");
    check(&[("s.ug", "include t.ug;"), ("t.ug", "\n\nv a 0 0 red;")], "error: expected a number, found `red` at t.ug:3:9");
    check(&[("s.ug", "include t.ug;"), ("t.ug", "v a 0 0 0\n")], "error: expected `;`, found the end of the file at t.ug:1:10");
    check(&[("s.ug", "include t.ug;"), ("t.ug", "def d;\n")], "error: definition `d` is not closed at t.ug:1:5");
    // In the file itself, after an included file.
    check(&[("s.ug", "{\n}\ninclude t.ug;\nv b 1 2 3;\nf (a b c);"), ("t.ug", "v a 0 0 0;\n\n\n")], "error: vertex `c` is not defined at s.ug:5:8");
    check(&[("s.ug", "include t.ug;\nv b 1 2 3;"), ("t.ug", "\n\nf (b b c);\n\n\n")], "error: vertex `c` is not defined at t.ug:3:8");
    check(&[("s.ug", "include;")], "error: expected a file name, in quotes if there are blanks in it, found `;` at s.ug:1:8");
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
fn files_that_are_no_scenes_are_not_quoted() {
    let secrets = [
        "root:x:0:0:secret",
        "secret = v;",
        "{ a comment }\nsecret;",
        "(an escape)\n\nsecret",
        "# secret\nv 1",
        "#secret",
        "# 3 \"a\"\nsecret",
        "{ secret",
        "( secret",
        "\"secret\"",
        "vsecret 1 2 3;",
        "\0secret",
        "secret",
    ];
    for secret in secrets {
        let found = read(&[("s.ug", "{}\n include \"a file\";"), ("a file", secret)]);
        let expected = "error: file `a file` is not UniGrafix\n --> s.ug:2:11\n  |\n2 |  include \"a file\";\n";
        assert!(found.starts_with(expected) && !found.contains("secret"), "{secret}: {found}");
        let allowed = Options { execute: true, ..Options::default() };
        let found = read_with(&[("s.ug", "execute p;"), ("p", &format!("#!{secret}"))], &allowed);
        assert!(
            found.starts_with("error: the output of `p` is not UniGrafix\n --> s.ug:1:9\n"),
            "{found}"
        );
        assert!(!found.contains("secret"), "{secret}: {found}");
    }
    // Errors of scenes are shown.
    for scene in ["{ head }\n# 1 \"t\"\n(escape) ; v red;", "#line 9\nf red;", "include;"] {
        let found = read(&[("s.ug", "include t;"), ("t", scene)]);
        assert!(found.starts_with("error: expected") && found.contains(" --> t:"), "{found}");
    }
}

#[test]
fn texts_in_memory_include_nothing() {
    check_error("include a.ug;", "files are not included here");
    check_error("execute a;", "programs are not run here");
}

#[test]
#[rustfmt::skip] // rows of a table
fn programs_are_run_if_allowed() {
    let allowed = Options { execute: true, ..Options::default() };
    let files = [
        ("a/scene.ug", "{ head }\ndef d; execute \"bin/one\"; end; i (d);"),
        ("a/bin/one", "#!v p 1 2 3;\ninclude ../two.ug; execute three;"),
        ("a/bin/../two.ug", "v q 1 2 3;"),
        ("a/bin/three", "#!"),
    ];
    assert_eq!(read_with(&files, &allowed), "{ head }\nv d:p 1 2 3;\nv d:q 1 2 3;\n");
    assert_eq!(message(&files), "error: program `bin/one` is not run at a/scene.ug:2:17");
    assert!(read(&files).contains("if you trust this one, allow it"));

    let check = |files: &[(&str, &str)], expected: &str| {
        assert_eq!(message_with(files, &allowed), expected, "{files:?}");
    };
    check(&[("s.ug", " execute no;")], "error: cannot run `no`: no such file at s.ug:1:10");
    check(&[("s.ug", "execute p;"), ("p", "#!3out of oil")], "error: program `p` failed with exit status: 3: out of oil at s.ug:1:9");
    check(&[("s.ug", "execute p;"), ("p", "#!3")], "error: program `p` failed with exit status: 3 at s.ug:1:9");
    // The output of a program is named after the program.
    check(&[("s.ug", "execute p;"), ("p", "#!v a 0 0 0;\nv b 0 0;")], "error: expected a number, found `;` at p:2:8");
    check(&[("s.ug", "execute p;"), ("p", "#!execute p;")], "error: file `p` includes itself at p:1:9");
    // A program in an `include` statement is read, not run.
    check(&[("s.ug", "include p;"), ("p", "#!v a 0 0 0;")], "error: cannot read `p`: of another kind at s.ug:1:9");
    // `execute` is a valid name.
    assert_eq!(read(&[("s.ug", "v execute 0 0 0;")]), "v execute 0 0 0;\n");
}

#[test]
fn limits_of_files_can_be_set() {
    let with = |limit: Limit, value: u64| Options {
        limits: Limits::default().with(limit, value),
        ..Options::default()
    };
    let chain =
        [("0", "include 1;"), ("1", "include 2;"), ("2", "include 3;"), ("3", "v a 1 2 3;")];
    let scene = "v a 1 2 3;\n";
    assert_eq!(read_with(&chain, &with(Limit::Includes, 3)), scene);
    let found = read_with(&chain, &with(Limit::Includes, 2));
    assert!(found.starts_with("error: files include each other too deeply"), "{found}");
    assert!(found.ends_with("the limit is 2 levels; use fewer, or raise it"), "{found}");
    // Far deeper than recursion on the stack would allow.
    let deep: Vec<(String, String)> =
        (0..5001).map(|idx| (format!("{idx}"), format!("include {};", idx + 1))).collect();
    let mut deep: Vec<(&str, &str)> =
        deep.iter().map(|(name, text)| (&name[..], &text[..])).collect();
    deep.push(("5001", "v a 1 2 3;"));
    assert_eq!(read_with(&deep, &with(Limit::Includes, 6000)), scene);

    assert_eq!(read_with(&chain, &with(Limit::Files, 3)), scene);
    let found = read_with(&chain, &with(Limit::Files, 2));
    assert!(found.starts_with("error: too many files are included"), "{found}");
    assert!(found.ends_with("the limit is 2 files; include fewer, or raise it"), "{found}");

    assert_eq!(read_with(&chain, &with(Limit::Text, 100)), scene);
    let found = read_with(&chain, &with(Limit::Text, 20));
    assert!(found.starts_with("error: with the text of `2` the scene is too large"), "{found}");
    assert!(found.ends_with("the limit is 20 bytes; split it, or raise it"), "{found}");
    // What is read counts, even while nothing of it is copied yet.
    let rest = "{ }".repeat(100);
    let around = [("0", "include 1;"), ("1", &format!("include x/../1;{rest}")), ("x/../1", &rest)];
    let found = read_with(&around, &with(Limit::Text, 500));
    assert!(
        found.starts_with("error: with the text of `x/../1` the scene is too large"),
        "{found}"
    );
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
    // They are not statements, and are not written.
    check("# 1 \"s.ug\"\n{ head }\n# 2\nv a 0 0 0;\n# 3", &["{ head }", "v a 0 0 0;"]);
    assert_eq!(parse("def d; # 1 \"x\"\nv p 0 0 0; end; i (d);").vertices.len(), 1);
    check_error("# pragma once\nv a 0 0 0;", "`#` is not a statement");
    check_error("# 1 file\nv a 0 0 0;", "`#` is not a statement");
}
