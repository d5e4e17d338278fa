//! Compares transformations with coordinates computed by hand.

use glam::{DVec3, dvec3};

use crate::language::{TRIANGLE, check_error, check_rest, parse};

fn placed(tforms: &str) -> DVec3 {
    let scene = parse(format!("def d; v p 1 2 3; end; i (d {tforms});"));
    scene.vertices[0].position
}

#[track_caller]
fn check(tforms: &str, expected: [f64; 3]) {
    let found = placed(tforms);
    let expected = DVec3::from(expected);
    // A few rounding errors of coordinates below 100.
    assert!((found - expected).abs().max_element() < 1e-13, "{tforms}: {found} is not {expected}");
}

const HALF_ROOT_2: f64 = std::f64::consts::FRAC_1_SQRT_2;

#[test]
fn every_option() {
    check("", [1.0, 2.0, 3.0]);
    check("-sx 2", [2.0, 2.0, 3.0]);
    check("-sy 2", [1.0, 4.0, 3.0]);
    check("-sz -2", [1.0, 2.0, -6.0]);
    check("-sa .5", [0.5, 1.0, 1.5]);
    check("-sv 0 0 7 2", [1.0, 2.0, 6.0]);
    // Along (1 1 0): the component (1.5 1.5 0) is tripled.
    check("-sv 1 1 0 3", [4.0, 5.0, 3.0]);
    check("-sv 1e-200 1e-200 0 3", [4.0, 5.0, 3.0]);
    check("-sv 1e200 1e200 0 3", [4.0, 5.0, 3.0]);
    check("-tx 5", [6.0, 2.0, 3.0]);
    check("-ty -5", [1.0, -3.0, 3.0]);
    check("-tz .5", [1.0, 2.0, 3.5]);
    check("-ta 10 20 30", [11.0, 22.0, 33.0]);
    check("-tv 0 3 4 10", [1.0, 8.0, 11.0]);
    // Counterclockwise, seen from the tip of the axis.
    check("-rx 90", [1.0, -3.0, 2.0]);
    check("-ry 90", [3.0, 2.0, -1.0]);
    check("-rz 90", [-2.0, 1.0, 3.0]);
    check("-rz -90", [2.0, -1.0, 3.0]);
    check("-rz 180", [-1.0, -2.0, 3.0]);
    check("-rz 450", [-2.0, 1.0, 3.0]);
    check("-rz 45", [-HALF_ROOT_2, 3.0 * HALF_ROOT_2, 3.0]);
    // About x, then y, then z: (1 2 3) -> (1 -3 2) -> (2 -3 -1) -> (3 2 -1).
    check("-ra 90 90 90", [3.0, 2.0, -1.0]);
    check("-ra 0 0 90", [-2.0, 1.0, 3.0]);
    check("-rv 0 0 -2 90", [2.0, -1.0, 3.0]);
    // A third of a turn about the diagonal: x -> y -> z -> x.
    check("-rv 1 1 1 120", [3.0, 1.0, 2.0]);
    check("-mx", [-1.0, 2.0, 3.0]);
    check("-my", [1.0, -2.0, 3.0]);
    check("-mz", [1.0, 2.0, -3.0]);
    check("-ma", [-1.0, -2.0, -3.0]);
    check("-mv 0 0 9", [1.0, 2.0, -3.0]);
    check("-mv 1 -1 0", [2.0, 1.0, 3.0]);
    // Row vectors: x' = 1*1 + 2*4 + 3*7, and so on.
    check("-M3 1 2 3 4 5 6 7 8 9", [30.0, 36.0, 42.0]);
    check("-M4 1 2 3 0 4 5 6 0 7 8 9 0 10 20 30 1", [40.0, 56.0, 72.0]);
}

#[test]
fn options_apply_from_left_to_right() {
    check("-tx 1 -sx 2", [4.0, 2.0, 3.0]);
    check("-sx 2 -tx 1", [3.0, 2.0, 3.0]);
    check("-tx 1 -rz 90", [-2.0, 2.0, 3.0]);
    check("-rz 90 -tx 1", [-1.0, 1.0, 3.0]);
    check("-rx 90 -ry 90 -rz 90", [3.0, 2.0, -1.0]);
    check("-tx 1 -tx 1 -tx 1 -tx 1 -sa 2 -ty 1", [10.0, 5.0, 6.0]);
    // An inner instance first, then the outer one.
    let scene = parse("def d; v p 1 2 3; end; def e; i (d -tx 1); end; i (e -sx 2);");
    assert_eq!(scene.vertices[0].position, dvec3(4.0, 2.0, 3.0));
}

#[test]
fn quarter_turns_are_exact() {
    for (tforms, expected) in [
        ("-rx 90", dvec3(1.0, -3.0, 2.0)),
        ("-ry -270", dvec3(3.0, 2.0, -1.0)),
        ("-rz 180", dvec3(-1.0, -2.0, 3.0)),
        ("-rz 36000000000090", dvec3(-2.0, 1.0, 3.0)),
        ("-rz 90 -rz 90 -rz 90 -rz 90", dvec3(1.0, 2.0, 3.0)),
    ] {
        assert_eq!(placed(tforms), expected, "{tforms}");
    }
}

#[test]
fn mirrors_reverse_faces_and_scales_do_not() {
    let same = "f (d:a d:b d:c);";
    let turned = "f (d:a d:c d:b);";
    for (tforms, expected) in [
        ("", same),
        ("-mx", turned),
        ("-my", turned),
        ("-mz", turned),
        ("-ma", turned),
        ("-mv 1 2 3", turned),
        ("-mx -my", same),
        ("-mx -my -mz", turned),
        ("-mx -sx -1", turned),
        ("-sx -1", same),
        ("-sa -1", same),
        ("-sv 1 0 0 -1", same),
        ("-M3 -1 0 0 0 1 0 0 0 1", same),
        ("-rz 180", same),
    ] {
        check_rest(&format!("def d; {TRIANGLE} f (a b c); end; i (d {tforms});"), &[expected]);
    }
    check_rest(&format!("def d; {TRIANGLE} w (a b c); end; i (d -mx);"), &["w (d:a d:b d:c);"]);
    // Two mirrors in two instances cancel; with a mirroring step every other copy is reversed.
    check_rest(
        &format!("def d; {TRIANGLE} f (a b c); end; def e; i (d -mx); end; i (e -mz);"),
        &["f (e:d:a e:d:b e:d:c);"],
    );
    check_rest(
        &format!("def d; {TRIANGLE} f (a b c); end; a n (d) 3 -mx;"),
        &["f (n#0:a n#0:b n#0:c);", "f (n#1:a n#1:c n#1:b);", "f (n#2:a n#2:b n#2:c);"],
    );
}

/// Normals stay perpendicular to their surface, on the same side, and keep their length.
#[test]
fn normals_follow_their_surface() {
    let rows = [
        ("", [0.0, 0.0, 2.0], [0.0, 0.0, 2.0]),
        ("-ta 5 6 7", [0.0, 0.3, 0.4], [0.0, 0.3, 0.4]),
        ("-rx 90", [0.0, 0.0, 2.0], [0.0, -2.0, 0.0]),
        ("-sa 7", [0.0, 3.0, 4.0], [0.0, 3.0, 4.0]),
        ("-sa 1e200", [0.0, 3.0, 4.0], [0.0, 3.0, 4.0]),
        ("-sa 1e-200", [0.0, 3.0, 4.0], [0.0, 3.0, 4.0]),
        // The plane y = z, scaled to y = 2z: normal (0 1 -2) / sqrt 5, of length sqrt 2.
        ("-sy 2", [0.0, 1.0, -1.0], [0.0, 1.0 / 2.5f64.sqrt(), -2.0 / 2.5f64.sqrt()]),
        ("-mz", [0.0, 3.0, 4.0], [0.0, 3.0, -4.0]),
        ("-sz -1", [0.0, 3.0, 4.0], [0.0, 3.0, -4.0]),
        // Collapsed in z: the normal is along the collapsed direction.
        ("-sz 0", [0.0, 3.0, 4.0], [0.0, 0.0, 5.0]),
    ];
    for (tforms, normal, expected) in rows {
        let [x, y, z] = normal;
        let scene = parse(format!("def d; v p 0 0 0 {x} {y} {z}; end; i (d {tforms});"));
        let found = scene.vertices[0].normal.unwrap();
        assert!((found - DVec3::from(expected)).length() < 1e-14, "{tforms}: {found}");
    }
}

/// A normal so long or so short that its square overflows or underflows keeps its direction.
#[test]
fn normals_of_any_length_are_turned() {
    for (length, tforms) in [1e300, 1e160, 1e-160, 1e-300]
        .into_iter()
        .flat_map(|length| ["-rx 90", "-rx 90 -sa 1e200"].map(|t| (length, t)))
    {
        let normal = format!("0 {} {}", 3.0 * length, 4.0 * length);
        let scene = parse(format!("def d; v p 0 0 0 {normal}; end; i (d {tforms});"));
        let found = scene.vertices[0].normal.unwrap();
        let unit = found / found.abs().max_element();
        assert!(
            (unit - DVec3::new(0.0, -1.0, 0.75)).length() < 1e-14,
            "{length} {tforms}: {found}"
        );
    }
}

#[test]
fn invalid_transformations_are_refused() {
    let refused = |tforms: &str, expected: &str| {
        check_error(&format!("def d; v p 1 2 3; end; i (d {tforms});"), expected)
    };
    for tforms in ["-sv 0 0 0 2", "-tv 0 0 0 2", "-rv 0 0 0 2", "-mv 0 0 0"] {
        refused(tforms, "the vector is zero");
    }
    let short =
        "-tx,-sa,-ta 1 2,-rv 0 0 1,-mv 1 2,-M3 1 2 3 4 5 6 7 8,-M4 1 0 0 0 0 1 0 0 0 0 1 0 1 1 1";
    for tforms in short.split(',') {
        refused(tforms, "expected a number, found `)`");
    }
    for name in ["-t", "-q", "-txx", "-TX", "-m3", "-M5", "-x"] {
        refused(
            &format!("{name} 1"),
            &format!(
                "expected a transformation (`-s`, `-t`, `-r` or `-m` with `x`, `y`, `z`, `a` or `v`, or `-M3`, `-M4`), \
                 found `{name}`"
            ),
        );
    }
    refused("-mx 1", "expected a transformation such as `-tx` or `)`, found `1`");
    refused("-M4 1 0 0 1 0 1 0 0 0 0 1 0 0 0 0 1", "this matrix is not affine");
    refused("-M4 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 2", "this matrix is not affine");
    refused("-sa 1e200 -sa 1e200", "the transformation overflows");
    refused("-sa 1e308", "coordinates overflow when this is placed");
    check_error(
        "def d; l 1 0 0 1; end; i (d -sz 0);",
        "this direction becomes zero when it is placed",
    );
    check_error(
        "def d; l 1 0 0 9 9; end; i (d -sz 1e308);",
        "coordinates overflow when this is placed",
    );
    check_error(
        "def d; cam -ep 0 0 9; end; i (d -sz 1e308);",
        "coordinates overflow when this is placed",
    );
    check_error(
        "def d; cam -ud 0 0 9; end; i (d -sz 0);",
        "this direction becomes zero when it is placed",
    );
    check_error(
        "def d; v p 1 0 0; end; a (d) 400 -sa 10;",
        "coordinates overflow when this is placed",
    );
}
