//! `surf`, and faces with a surface instead of a light level.

use crate::language::{TRIANGLE, check, check_error, check_rest, errors, parse, parse_with};

#[test]
fn surfaces_and_their_defaults() {
    check("surf s .5 .25 0.25;", &["surf s 0.5 0.25 0.25;"]);
    check("surf s 1 0 0 1;surf t 1 0 0 1 20;", &["surf s 1 0 0;", "surf t 1 0 0;"]);
    check("surf glass 0 .1 .9 1.5;", &["surf glass 0 0.1 0.9 1.5;"]);
    check("surf m 0 3 0 1 0; surf n 0 1 0 1.5 20;", &["surf m 0 3 0 1 0;", "surf n 0 1 0 1.5;"]);
    check(
        "surf s 0 0 1 1.5 60 0.7; surf t 0 0 1 1 20 2; surf u 0 0 1 1.5 20 0;",
        &["surf s 0 0 1 1.5 60 0.7;", "surf t 0 0 1 1 20 2;", "surf u 0 0 1 1.5;"],
    );
    assert_eq!(parse("surf s 0 0 1 1.5 60 0.7;").surfaces[0].absorption, 0.7);
    let scene = parse("surf s .5 .25 .125;");
    let surface = &scene.surfaces[0];
    assert_eq!((surface.diffuse, surface.specular, surface.transmitted), (0.5, 0.25, 0.125));
    assert_eq!((surface.refraction, surface.exponent, surface.absorption), (1.0, 20.0, 0.0));
}

#[test]
fn invalid_surfaces_are_refused() {
    for (text, message) in [
        ("surf;", "expected a name that begins with a letter, `:`, `_` or `#`, found `;`"),
        ("surf 1 0 0;", "expected a name that begins with a letter, `:`, `_` or `#`, found `1`"),
        ("surf s;", "expected a number, found `;`"),
        ("surf s 1 0;", "expected a number, found `;`"),
        ("surf s 0 0 1 1.5 20 -1;", "the number `-1` is out of range"),
        ("surf s -1 0 0;", "the number `-1` is out of range"),
        ("surf s 0 -1e-9 0;", "the number `-1e-9` is out of range"),
        ("surf s 0 0 1.01;", "the number `1.01` is out of range"),
        ("surf s 0 0 -1;", "the number `-1` is out of range"),
        ("surf s 0 0 0 0;", "the number `0` is out of range"),
        ("surf s 0 0 0 -1;", "the number `-1` is out of range"),
        ("surf s 0 0 0 1 -1;", "the number `-1` is out of range"),
        ("surf s 0 1e999 0;", "the number `1e999` is too large"),
        ("surf s 0 0 0 1 1 1 1;", "expected `;`, found `1`"),
        ("surf s 1 0 0; surf s 0 1 0;", "surface `s` is defined twice"),
    ] {
        check_error(text, message);
    }
}

#[test]
fn the_first_name_after_contours_is_the_color_and_the_second_the_surface() {
    let row = |face: &str, expected: &str| {
        let text = format!("c red 1 0; surf s 1 0 0; {TRIANGLE} {face}");
        check_rest(&text, &["c red 1 0 1;", "surf s 1 0 0;", expected]);
    };
    row("f (a b c) red s;", "f (a b c) red s;");
    row("f x(a b c)red\ts<0 .5 0>;", "f x (a b c) red s <0 0.5 0>;");
    row("f (a b c) red .5;", "f (a b c) red 0.5;");
    // Colours and surfaces have separate name spaces.
    check_rest(
        &format!("c s 1; surf s 1 0 0; {TRIANGLE} f s (a b c) s s;"),
        &["c s 1;", "surf s 1 0 0;", "f s (a b c) s s;"],
    );
    check_error(
        &format!("c red 1; surf s 1 0 0; {TRIANGLE} f (a b c) red s 1;"),
        "expected `;`, found `1`",
    );
    check_error(
        &format!("c red 1; surf s 1 0 0; {TRIANGLE} f (a b c) red .5 s;"),
        "expected `;`, found `s`",
    );
    check_error(
        &format!("c red 1; surf s 1 0 0; {TRIANGLE} w (a b c) red s;"),
        "expected `;`, found `s`",
    );
}

#[test]
fn surfaces_may_come_later_and_from_enclosing_scopes() {
    check_rest(
        &format!("c r 1; {TRIANGLE} f (a b c) r s; surf s 1 0 0;"),
        &["c r 1;", "surf s 1 0 0;", "f (a b c) r s;"],
    );
    // An inner scope shadows the outer one, and its surfaces get its name as a prefix; with several
    // scopes.
    check_rest(
        &format!(
            "c r 1; surf s 1 0 0; surf o 0 1 0; def d; surf s 0 0 1; {TRIANGLE} f (a b c) r s; f (a b c) r o;\
             f (a b c) r .5; end; {TRIANGLE} f (a b c) r s; i (d); i n (d);"
        ),
        &[
            "c r 1;",
            "surf s 1 0 0;",
            "surf o 0 1 0;",
            "surf d:s 0 0 1;",
            "f (a b c) r s;",
            "f (d:a d:b d:c) r d:s;",
            "f (d:a d:b d:c) r o;",
            "f (d:a d:b d:c) r 0.5;",
            "f (n:a n:b n:c) r d:s;",
            "f (n:a n:b n:c) r o;",
            "f (n:a n:b n:c) r 0.5;",
        ],
    );
    // Generated names never replace names in the text.
    check_rest(
        "surf d:s 1 0 0; def d; surf s 0 1 0; end;",
        &["surf d:s 1 0 0;", "surf d:s_2 0 1 0;"],
    );
    check_error(
        &format!("c r 1; def d; surf s 1 0 0; end; {TRIANGLE} f (a b c) r s;"),
        "surface `s` is not defined",
    );
}

#[test]
fn undefined_surfaces_are_distinguished_from_colours() {
    let help = |text: &str| {
        let source = ugparse::Source::new("test.ug", format!("{TRIANGLE} {text}"));
        let found = ugparse::parse(&source, &ugparse::Options::default()).unwrap_err();
        assert_eq!(found.list.len(), 1, "{found}");
        (found.list[0].message.clone(), found.list[0].help.clone().unwrap())
    };
    let (message, guess) = help("c r 1; surf shiny 1 0 0; f (a b c) r shinny;");
    assert_eq!(message, "surface `shinny` is not defined");
    assert!(guess.starts_with("did you mean `shiny`?"), "{guess}");
    let (message, guess) = help("surf shiny 1 0 0; f (a b c) shiny;");
    assert_eq!(message, "colour `shiny` is not defined");
    assert!(guess.contains("there is a surface of that name"), "{guess}");
    let (message, guess) = help("c r 1; f (a b c) r r;");
    assert_eq!(message, "surface `r` is not defined");
    assert!(guess.contains("there is a colour of that name"), "{guess}");
    assert_eq!(errors(format!("{TRIANGLE} f (a b c) r s;")).len(), 2);
    // The effect of a missing `;` on the next statement.
    check_error(
        &format!("c r 1; {TRIANGLE} f (a b c) r\nc g 1;"),
        "expected `;` before the next statement",
    );
    check_error(
        &format!("c r 1; def d; {TRIANGLE} f (a b c) r\nend;\ni (d);"),
        "expected `;` before the next statement",
    );
}

#[test]
fn comments_of_surfaces_stay_with_them() {
    check(
        "{ head }\nv a 0 0 0;\n{ above }\nsurf s 1 0 0; { behind }\nsurf t {inside} 1 0 0;",
        &[
            "{ head }",
            "{ above }",
            "surf s 1 0 0; { behind }",
            "{inside}",
            "surf t 1 0 0;",
            "v a 0 0 0;",
        ],
    );
}

#[test]
fn a_face_has_a_level_or_a_surface() {
    let text =
        format!("c r 1; surf s 1 .5 0; {TRIANGLE} f (a b c) r s; f (a b c) r .5; f (a b c);");
    let scene = parse_with(text, false).scene;
    let of_faces: Vec<_> = scene
        .faces
        .iter()
        .map(|face| (scene.light_level(face), scene.surface(face).map(|surface| surface.specular)))
        .collect();
    assert_eq!(of_faces, [(None, Some(0.5)), (Some(0.5), None), (None, None)]);
}
