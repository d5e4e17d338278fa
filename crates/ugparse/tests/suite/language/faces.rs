//! Holes and degenerate faces.

use crate::language::{TRIANGLE, check_rest, parse_with, warnings};

const SQUARE: &str =
    "v a 0 0 0; v b 4 0 0; v c 4 4 0; v d 0 4 0; v e 1 1 0; v f 2 1 0; v g 2 2 0; v h 1 2 0; ";

#[test]
fn holes_are_kept_in_order() {
    check_rest(&format!("{SQUARE} f (a b c d) (e h g f);"), &["f (a b c d) (e h g f);"]);
    check_rest(
        &format!("{SQUARE} f roof (a b c d)(e f g)(g h e);"),
        &["f roof (a b c d) (e f g) (g h e);"],
    );
    // In a mirrored face every contour is reversed and keeps its first vertex.
    check_rest(
        &format!("def t; {SQUARE} f (a b c d) (e h g f); end; i m (t -mx);"),
        &["f (m:a m:d m:c m:b) (m:e m:f m:g m:h);"],
    );
}

#[test]
fn degenerate_faces_are_omitted_with_a_warning() {
    let row = |face: &str, expected: &str| {
        let text = format!("{SQUARE} v i 8 0 0; v j 1e-300 0 0; v k 0 1e-300 0; {face}");
        check_rest(&text, &[]);
        assert_eq!(warnings(&text, false), [expected], "{face}");
    };
    row("f (a b);", "face has a contour of fewer than 3 different vertices");
    row("f roof (a);", "face `roof` has a contour of fewer than 3 different vertices");
    row("f (a b a b a);", "face has a contour of fewer than 3 different vertices");
    row("f (a b c d) (e f);", "face has a contour of fewer than 3 different vertices");
    row("f line (a b i);", "face `line` has no area");
    row("f (a b c b);", "face has no area");
    row("f (a j k);", "face has no area");
    row("w (a);", "wire has a contour of fewer than 2 vertices");
    row("w edge (a b) (c);", "wire `edge` has a contour of fewer than 2 vertices");
    assert_eq!(warnings(&format!("{SQUARE} f (a b c); f (a a b c); w (a a);"), false), [""; 0]);
}

#[test]
fn faces_that_are_not_flat_cause_one_warning() {
    let row = |faces: &str, expected: &[&str]| {
        let text = format!("{SQUARE} v up 4 4 .1; v far 4 4 1e-3; {faces}");
        assert_eq!(warnings(&text, false), expected, "{faces}");
    };
    // A corner at height h has distance h / 4 from the plane, and the bounding box has the diagonal
    // 4 sqrt 2.
    row("f (a b far d);", &[]);
    row("f (a b up d);", &["face is not flat"]);
    row("f roof (a b up d);", &["face `roof` is not flat"]);
    row(
        "f (a b c d); f roof (a b up d); f (a b up d);",
        &["face `roof` and one other are not flat"],
    );
    row(
        "f r (a b up d) (e f g h); f (a b up d); f (a b up d);",
        &["face `r` and 2 others are not flat"],
    );
    // Triangles are flat, and so are transformed flat faces.
    row("f (a b up); f (a b c d);", &[]);
    row(&format!("def t; {SQUARE} f (a b c d); end; i (t -rv 1 2 3 40 -sv 1 2 3 7);"), &[]);
    row(
        "def t; v a 0 0 0; v b 4 0 0; v c 4 4 .1; v d 0 4 0; f q (a b c d); end; a (t) 3 -tx 5;",
        &["face `q` and 2 others are not flat"],
    );
    row(
        "def t; v a 0 0 0; v b 4 0 0; v c 4 4 .1; v d 0 4 0; f q (a b c d); end; i (t -sz .01);",
        &[],
    );
    // In a scene as seen, bent faces are correct.
    let seen =
        format!("(ugstage 1 geometry as-seen eye 0 0 0) {SQUARE} v up 4 4 .1; f (a b up d);");
    assert_eq!(warnings(&seen, false), [""; 0]);
}

#[test]
fn a_warning_of_a_bent_face_reads_well() {
    let text = format!("{SQUARE}v up 4 4 .1;\nf roof (a b up d);\n");
    assert_eq!(
        parse_with(text, false).warnings.render(false),
        "\
warning: face `roof` is not flat
 --> test.ug:2:3
  |
2 | f roof (a b up d);
  |   ^^^^ a corner is off by 4.4e-3 of its size
  |
help: cut it into triangles: it is drawn as triangles, perhaps not as those that are meant"
    );
}

#[test]
fn a_warning_reads_well() {
    let text = format!("{TRIANGLE}\nf roof (a b a);\n");
    let parsed = parse_with(text, false);
    assert_eq!(
        parsed.warnings.render(false),
        "\
warning: face `roof` has a contour of fewer than 3 different vertices
 --> test.ug:2:3
  |
2 | f roof (a b a);
  |   ^^^^ omitted
  |
help: remove it, or correct its vertices"
    );
}

#[test]
fn faces_collapsed_by_their_instance_are_omitted() {
    let text =
        format!("def t; {TRIANGLE} f roof (a b c); end; a row (t -sx 0) 3 -tz 1; i good (t);");
    check_rest(&text, &["f good:roof (good:a good:b good:c);"]);
    assert_eq!(
        warnings(&text, false),
        ["face has no area where it is placed"],
        "once, not for every copy"
    );
    // So far away that their size is lost to rounding.
    let text = format!("def t; {TRIANGLE} f (a b c); end; i (t -tx 1e200);");
    check_rest(&text, &[]);
}

#[test]
fn comments_of_omitted_faces_are_kept() {
    check_rest(
        &format!("{TRIANGLE}\n{{ bad }}\nf (a b);\n{{ good }}\nf (a b c);"),
        &["{ bad }", "{ good }", "f (a b c);"],
    );
}
