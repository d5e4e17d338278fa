//! Every statement with and without each of its optional parts.

use crate::language::{TRIANGLE, check, check_error, check_rest, errors, flat, warnings};

#[test]
fn vertices() {
    check("v a 1 2 3;", &["v a 1 2 3;"]);
    check("c red 1 0 1; v a 1 2 3 red;", &["c red 1 0 1;", "v a 1 2 3 red;"]);
    check("v a 1 2 3 0 0 2;", &["v a 1 2 3 0 0 2;"]);
    check("c red 1 0 1; v a 1 2 3 red 0 -1 0;", &["c red 1 0 1;", "v a 1 2 3 red 0 -1 0;"]);
    check_error(
        "v 1 2 3;",
        "expected a name that begins with a letter, `:`, `_` or `#`, found `1`",
    );
    check_error("v a 1 2;", "expected a number, found `;`");
    check_error("v a 1 2 3 4;", "expected a number, found `;`");
    check_error("v a 1 2 3 4 5 6 7;", "expected `;`, found `7`");
    check_error("v a 1 2 3 0 0 0;", "the vector is zero");
    check_error("v a 1 2 3 0 0 -0;", "the vector is zero");
    check_error("v a 1 2 3 (b);", "expected a number, found `b`");
}

#[test]
fn faces() {
    let row = |face: &str, expected: &str| {
        check_rest(&format!("c red 1 0 1; {TRIANGLE}{face}"), &["c red 1 0 1;", expected]);
    };
    row("f (a b c);", "f (a b c);");
    row("f roof(a b c);", "f roof (a b c);");
    row("f (a b c) red;", "f (a b c) red;");
    row("f (a b c) .5;", "f (a b c) 0.5;");
    row("f (a b c) red 1.5;", "f (a b c) red 1.5;");
    row("f (a b c) <.1 -.2 .3>;", "f (a b c) <0.1 -0.2 0.3>;");
    row("f (a b c) red < 0 0 0 > ;", "f (a b c) red <0 0 0>;");
    row("f (a b c) 0 <0 0 .9>;", "f (a b c) 0 <0 0 0.9>;");
    row("f roof (a b c) red 0 <0 0 .9>;", "f roof (a b c) red 0 <0 0 0.9>;");
    row("f f (a b c) red;", "f f (a b c) red;");
    // Levels of consecutive faces that differ only in the sign of zero.
    check_rest(
        &format!("{TRIANGLE}f (a b c) 0; f (a b c) -0; f (a b c) -0; f (a b c) 0;"),
        &["f (a b c) 0;", "f (a b c) -0;", "f (a b c) -0;", "f (a b c) 0;"],
    );
    let refused = |face: &str, expected: &str| check_error(&format!("{TRIANGLE}{face}"), expected);
    refused("f;", "expected `(` and vertex names, found `;`");
    refused("f roof;", "expected `(` and vertex names, found `;`");
    refused("f ();", "expected a vertex name, found `)`");
    refused("f (a b c) ();", "expected a vertex name, found `)`");
    refused("f (a b 3);", "expected a vertex name or `)`, found `3`");
    refused("f (a b c;", "expected a vertex name or `)`, found `;`");
    refused("f (a (b) c);", "expected a vertex name or `)`, found `(`");
    refused("f (a b c) 1 2;", "expected `;`, found `2`");
    refused("f (a b c) <0 0>;", "expected a number, found `>`");
    refused("f (a b c) <0 0 0 0>;", "expected `>`, found `0`");
    refused("f (a b c) <0 0 1>;", "the speed is not below 1");
    refused("f (a b c) <.6 .6 .6>;", "the speed is not below 1");
    refused("f (a b c) <1e300 0 0>;", "the speed is not below 1");
    refused("f (a b c) <0 0 0> .5;", "expected `;`, found `.5`");
}

#[test]
fn wires() {
    let row = |wire: &str, expected: &str| {
        check_rest(&format!("c red 1 0 1; {TRIANGLE}{wire}"), &["c red 1 0 1;", expected]);
    };
    row("w (a b);", "w (a b);");
    row("w edge (a b c a);", "w edge (a b c a);");
    row("w (a b) (c b a) red;", "w (a b) (c b a) red;");
    row("w edge (a b) red <0 .5 0>;", "w edge (a b) red <0 0.5 0>;");
    row("w (a a);", "w (a a);");
    check_error(&format!("{TRIANGLE}w ();"), "expected a vertex name, found `)`");
    check_error(&format!("{TRIANGLE}w (a b) .5;"), "expected `;`, found `.5`");
}

#[test]
fn labels() {
    let row = |label: &str, expected: &str| {
        let out = flat(format!("{TRIANGLE}{label}"));
        assert_eq!(out.lines().find(|line| line.starts_with("label")), Some(expected), "{label}");
    };
    row("label \"the head\" a;", "label \"the head\" a;");
    row("label head\"γ = 2; ( a )\"a { why } ;", "label head \"γ = 2; ( a )\" a;");
    row("label label \"x\" a <0 .5 0>;", "label label \"x\" a <0 0.5 0>;");
    // A label is part of the body of the first face, else wire, that uses its vertex.
    row(
        "label \"x\" a; w (a b) <0 .1 0>; f (c b a) <0 .2 0>; f (a b c);",
        "label \"x\" a <0 0.2 0>;",
    );
    let refused =
        |label: &str, expected: &str| check_error(&format!("{TRIANGLE}{label}"), expected);
    let text = "expected text of 1 to 200 letters in quotes, without braces and line breaks";
    let long = format!("label \"{}\" a;", "γ".repeat(201));
    for label in [
        "label a;",
        "label \"\" a;",
        "label \" \" a;",
        "label \"{\" a;",
        "label \"\u{7}\" a;",
        "label \"x\ny\" a;",
        "label \"x;",
        &long,
    ] {
        let found = errors(format!("{TRIANGLE}{label}"));
        assert!(found[0].starts_with(text), "{label}: {found:?}");
    }
    row(&long.replacen('γ', "", 1), &long.replacen('γ', "", 1));
    refused("label \"x\";", "expected a vertex name, found `;`");
    refused("label \"x\" d;", "vertex `d` is not defined");
    refused("label \"x\" a b;", "expected `;`, found `b`");
}

/// Each instance has its labels, with their text unchanged; a path leads to a vertex of one.
#[test]
fn labels_of_instances() {
    let text = "def d; v p 1 0 0; v q 0 1 0; v r 0 0 1; f (p q r) <.5 0 0>; label n \"end\" p; end;
                i one (d -tx 2); a (d) 2 -tx 3; label \"path\" one:q;";
    let labels =
        ["label one:n \"end\" one:p <0.5 0 0 -at 2 0 0>;", "label d#0:n \"end\" d#0:p <0.5 0 0>;"];
    let more = [
        "label d#1:n \"end\" d#1:p <0.5 0 0 -at 3 0 0>;",
        "label \"path\" one:q <0.5 0 0 -at 2 0 0>;",
    ];
    let out = flat(text);
    let found: Vec<&str> = out.lines().filter(|line| line.starts_with("label")).collect();
    assert_eq!(found, [&labels[..], &more[..]].concat());
    check_error("def d; v p 0 0 0; end; i x (d); label \"t\" x:q;", "vertex `x:q` is not defined");
}

#[test]
fn color_statements() {
    check("c red 0.5;", &["c red 0.5;"]);
    check("c red 0.5 0;", &["c red 0.5 0 1;"]);
    check("c red 0.5 0 0;", &["c red 0.5;"]);
    check("c red 0.5 -30 0.25;", &["c red 0.5 -30 0.25;"]);
    check("c red 0.5 720;", &["c red 0.5 720 1;"]);
    check("c red 2.5 589.3 1 0.5;", &["c red 2.5 589.3 1 0.5;"]);
    check("c red 0.5 0 0 0.5;", &["c red 0.5 0 0 0.5;"]);
    check("c red 0.5 0 0 0;", &["c red 0.5;"]);
    check("c red 0.5 0 0 0 1;", &["c red 0.5;"]);
    check("c red 0.5 0 0 0 2.5;", &["c red 0.5 0 0 0 2.5;"]);
    check("c red 0.5 90 1 0.25 0;", &["c red 0.5 90 1 0.25 0;"]);
    check("c_rgb red 1 0 0.5;", &["c_rgb red 1 0 0.5;"]);
    check("c_rgb red 1 0 0.5 0.25;", &["c_rgb red 1 0 0.5 0.25;"]);
    check("c_rgb red 1 0 0.5 0;", &["c_rgb red 1 0 0.5;"]);
    check("c 0.5;", &["c unnamed#0 0.5;"]);
    check("c_rgb .5 .5 .5;", &["c_rgb unnamed#0 0.5 0.5 0.5;"]);
    check_error("c red;", "expected a number, found `;`");
    check_error("c red -1;", "the number `-1` is out of range");
    check_error("c red 1 0 1.5;", "the number `1.5` is out of range");
    check_error("c red 1 0 -.1;", "the number `-.1` is out of range");
    check_error("c red 1 0 1 2;", "the number `2` is out of range");
    check_error("c red 1 0 1 0 -1;", "the number `-1` is out of range");
    check_error("c red 1 0 1 0 1 0;", "expected `;`, found `0`");
    check_error("c_rgb red 1 0;", "expected a number, found `;`");
    check_error("c_rgb red 255 0 0;", "the number `255` is out of range");
    check_error("c_rgb red 0 0 -1;", "the number `-1` is out of range");
}

#[test]
fn lights() {
    check("l .5;", &["l 0.5;"]);
    check("l sun .5;", &["l sun 0.5;"]);
    check("l .5 0 0 2;", &["l 0.5 0 0 2;"]);
    check("l .5 0 0 2 0;", &["l 0.5 0 0 2 0;"]);
    check("l .5 0 0 0 3;", &["l 0.5 0 0 0 3;"]);
    check("c red 1; l .5 0 0 0 3 2 red;", &["c red 1;", "l 0.5 0 0 0 3 2 red;"]);
    check("c red 1; l sun 2 0 0 2 red <0 0 .5>;", &["c red 1;", "l sun 2 0 0 2 red <0 0 0.5>;"]);
    check("c red 1; l .5 red;", &["c red 1;", "l 0.5 red;"]);
    check("l .5 <0 0 .5>;", &["l 0.5 <0 0 0.5>;"]);
    check_error("l sun;", "expected a number, found `;`");
    check_error("l -1;", "the number `-1` is out of range");
    check_error("l 1 0 0;", "expected a number, found `;`");
    check_error("l 1 0 0 0;", "the vector is zero");
    check_error("l 1 0 0 0 -1;", "the number `-1` is out of range");
    check_error("l 1 0 0 0 0 0;", "the number `0` is out of range");
    check_error("l 1 red;", "colour `red` is not defined");
}

#[test]
fn cameras() {
    check("cam;", &["cam;"]);
    check("cam side;", &["cam side;"]);
    check(
        "cam side -ps -fl 2 -fs 3 4 -va 40 30 -ph 0 0 1 .5 -cl 1 100 -ud 0 0 1 -vc 1 2 3 -ep 4 5 6 <0 0 .5>;",
        &[
            "cam side -ep 4 5 6 -vc 1 2 3 -ud 0 0 1 -cl 1 100 -ph 0 0 1 0.5 -va 40 30 -fs 3 4 -fl 2 -ps <0 0 0.5>;",
        ],
    );
    // One angle stands for both, wherever it is.
    check("cam -va 40;", &["cam -va 40 40;"]);
    check("cam -va 40 -ps <0 0 .5>;", &["cam -va 40 40 -ps <0 0 0.5>;"]);
    check("cam -va 40 { one } -fl 2;", &["{ one }", "cam -va 40 40 -fl 2;"]);
    let options = "-ep 0 0 0,-vc 1 2 3,-ud 0 1 0,-cl 0 1,-ph 0 0 1 1,-va 1 2,-fs 1 2,-fl 3,-og";
    for option in options.split(',') {
        check(&format!("cam {option};"), &[&format!("cam {option};")]);
    }
    check("cam -og -ps;", &["cam -ps;"]);
    check("cam -ep 1 1 1 -ep 2 2 2;", &["cam -ep 2 2 2;"]);
    check_error("cam -ep 1 2;", "expected a number, found `;`");
    check_error("cam -va;", "expected a number, found `;`");
    check_error("cam -ud 0 0 0;", "the vector is zero");
    check_error(
        "cam -zoom 2;",
        "expected a camera option (-vc -ep -ud -cl -ph -og -ps -va -fs -fl), found `-zoom`",
    );
    check_error(
        "cam -EP 0 0 0;",
        "expected a camera option (-vc -ep -ud -cl -ph -og -ps -va -fs -fl), found `-EP`",
    );
}

#[test]
fn definitions_and_calls() {
    let def = "def d; v p 1 0 0; end; ";
    let row = |call: &str, expected: &[&str]| check(&format!("c red 1; {def}{call}"), expected);
    row("i (d);", &["c red 1;", "v d:p 1 0 0;"]);
    row("i car (d);", &["c red 1;", "v car:p 1 0 0;"]);
    row("i car (d red -tx 1 -ty 2) <0 0 .5>;", &["c red 1;", "v car:p 2 2 0;"]);
    row("a (d) 0;", &["c red 1;"]);
    row("a (d) 2;", &["c red 1;", "v #0:p 1 0 0;", "v #1:p 1 0 0;"]);
    row("a row (d -ty 1) 2 -tx 3 <0 0 .5>;", &["c red 1;", "v row#0:p 1 1 0;", "v row#1:p 4 1 0;"]);
    row("a row (d red -ty 1) 1;", &["c red 1;", "v row#0:p 1 1 0;"]);
    let refused = |call: &str, expected: &str| check_error(&format!("{def}{call}"), expected);
    refused("i;", "expected `(` and the name of a definition, found `;`");
    refused("i car ();", "expected the name of a definition, found `)`");
    refused("i (ship);", "definition `ship` is not defined");
    refused("i (d red);", "colour `red` is not defined");
    refused("i (d 3);", "expected a transformation such as `-tx` or `)`, found `3`");
    refused("a (d);", "expected a whole number, found `;`");
    for size in ["2.5", "-1", "1e3", "two", "+2", "0x2"] {
        refused(&format!("a (d) {size};"), &format!("expected a whole number, found `{size}`"));
    }
    check_error("def d v p 0 0 0; end;", "expected `;`, found `v`");
    check_error(
        "def; end;",
        "expected a name that begins with a letter, `:`, `_` or `#`, found `;`",
    );
    check_error("end;", "there is no open `def` for this `end`");
    check_error("def d; end d;", "expected `;`, found `d`");
    check_error("def d; v p 0 0 0;", "definition `d` is not closed");
}

#[test]
fn escapes_are_kept_as_they_are() {
    check("(text)", &["(text)"]);
    check("(text);", &["(text)"]);
    check("()", &["()"]);
    check("( a (b) { not a comment ) (;<\")", &["( a (b) { not a comment )", "(;<\")"]);
    check("v a 0 0 0; (one)(two) v b 0 0 0;", &["(one)", "(two)", "v a 0 0 0;", "v b 0 0 0;"]);
    check("(two\nlines)", &["(two", "lines)"]);
    check(
        "def d; (once) v a 0 0 0; end; i x (d); i y (d);",
        &["(once)", "v x:a 0 0 0;", "v y:a 0 0 0;"],
    );
    check_error("v a 0 0 0; (open (twice)", "this escape is not closed");
    check_error(")", "`)` is not a statement");
}

#[test]
fn lax_passes_on_unknown_statements() {
    let text =
        "shine .5 .5 0; v a 0 0 0;\nfuture { with; comment } thing (1 2);\n# pragma;\nv b 0 0 0;";
    check(
        text,
        &[
            "shine .5 .5 0;",
            "future { with; comment } thing (1 2);",
            "# pragma;",
            "v a 0 0 0;",
            "v b 0 0 0;",
        ],
    );
    assert_eq!(
        warnings(text, true),
        [
            "statement `shine` is passed on unread",
            "statement `future` is passed on unread",
            "statement `#` is passed on unread"
        ]
    );
    // A carriage return without a line feed ends the line of a directive, so a comment after it is
    // on a line of its own.
    let directive = flat("# pragma\r{ of two\nlines }\nv a 0 0 0;");
    assert!(directive.contains("# pragma\n") && !directive.contains("# pragma {"), "{directive}");
    assert_eq!(flat(&directive), directive);
    // More of them than the limit of errors: later statements are not lost.
    let many: String =
        (0..100).map(|idx| format!("x{idx};\n")).collect::<String>() + "v last 0 0 0;";
    assert!(flat(&many).ends_with("x99;\nv last 0 0 0;\n"));
    let refused = ugparse::parse(
        &ugparse::Source::new("test.ug", "thing 1 2"),
        &ugparse::Options { lax: true, ..Default::default() },
    );
    assert_eq!(refused.unwrap_err().list[0].message, "expected `;`, found the end of the file");
}

#[test]
fn a_missing_semicolon_is_distinguished_from_names_equal_to_keywords() {
    const MISSING: &str = "expected `;` before the next statement";
    check_error("v a 0 0 0\nv b 1 0 0;", MISSING);
    assert_eq!(
        errors("v a 0 0 0\nv b 1 0 0\n\nv c 0 1 0;\nend;"),
        [MISSING, MISSING, "there is no open `def` for this `end`"]
    );
    check_error("def d\nv a 0 0 0;\nend;", MISSING);
    check_error("def d;\nv a 0 0 0\nend;\ni (d);", MISSING);
    check_error("v a 0 0\n{ and }\nv b 1 0 0;", "expected a number before the next statement");
    check_error("c x .5\ncam;", MISSING);
    check_error("v a 0 0 0", "expected `;`, found the end of the file");
    // Vertices with names of keywords, one per line.
    check_error("f (a\nv\nf\nl 1);", "expected a vertex name or `)`, found `1`");
    check_error("f (a\ncam\nend\nw\n2);", "expected a vertex name or `)`, found `2`");
    check_rest(&format!("{TRIANGLE} v l 0 0 0; f\n(a\nb\nc)\n1\n;"), &["f (a b c) 1;"]);
}
