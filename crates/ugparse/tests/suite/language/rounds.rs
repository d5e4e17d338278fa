//! Round faces: their vertices, names and places.

use glam::DVec3;
use ugscene::{RoundShape, Scene};

use crate::language::{check, check_rest, flat, parse, warnings};

fn rounds(scene: &Scene) -> Vec<RoundShape> {
    scene.rounds().map(|(_, round)| round).collect()
}

#[test]
fn vertices_are_named_after_their_face() {
    check(
        "c red 0.9 0 0.8;\n{ above } sphere ball 0 0 1 0.5 red; { behind }",
        &[
            "c red 0.9 0 0.8;",
            "{ above }",
            "v ball#1 0.5 0 1;",
            "v ball#2 0 0.5 1;",
            "v ball#3 0 0 1.5;",
            "v ball#4 -0.5 0 1;",
            "v ball#5 0 -0.5 1;",
            "v ball#6 0 0 0.5;",
            "sphere ball (ball#1 ball#2 ball#3) (ball#4 ball#5 ball#6) red; { behind }",
        ],
    );
    // Two faces may have the same name, so names of vertices made from it get the next free number.
    check_rest(
        "disc d 0 0 0 0 0 1 1; v d#3 5 5 5; disc d 0 0 2 0 0 1 1; disc 0 0 3 0 0 1 1;",
        &[
            "disc d (d#1 d#2 d#3 d#4);",
            "disc d (d#1_2 d#2_2 d#3_3 d#4_2);",
            "disc (disc#1 disc#2 disc#3 disc#4);",
        ],
    );
    check_rest(
        "c red 0 0 0; surf s 0 1 0; tube 0 0 0 0 0 1 1 red s <0.5 0 0>; cylinder a 0 0 0 0 0 1 1 red 0.5;",
        &[
            "c red 0;",
            "surf s 0 1 0;",
            "tube (tube#1 tube#2 tube#3 tube#4) (tube#5 tube#6 tube#7 tube#8) red s <0.5 0 0>;",
            "cylinder a (a#1 a#2 a#3 a#4) (a#5 a#6 a#7 a#8) red 0.5;",
        ],
    );
    check(
        "c red 0.9; disc d 0 0 0 0 0 1 4 -inner 2 red 0.5;",
        &[
            "c red 0.9;",
            "v d#1 4 0 0;",
            "v d#2 0 4 0;",
            "v d#3 -4 0 0;",
            "v d#4 0 -4 0;",
            "v d#5 2 0 0;",
            "v d#6 0 2 0;",
            "v d#7 -2 0 0;",
            "v d#8 0 -2 0;",
            "disc d (d#1 d#2 d#3 d#4) (d#5 d#6 d#7 d#8) red 0.5;",
        ],
    );
}

#[test]
fn shapes_are_where_the_numbers_and_instances_put_them() {
    let scene =
        parse("sphere 1 2 3 4; cylinder 1 2 3 1 2 7 .5; tube 0 0 0 0 3 4 2; disc 1 1 1 0 -3 0 2;");
    let shapes = rounds(&scene);
    let distance = |row: usize, unit: DVec3, from: DVec3| shapes[row].place(unit).distance(from);
    assert!(
        (distance(0, DVec3::new(0.6, 0.0, 0.8), DVec3::new(1.0, 2.0, 3.0)) - 4.0).abs() < 1e-12
    );
    assert!(distance(1, DVec3::Z, DVec3::new(1.0, 2.0, 7.0)) < 1e-12);
    assert!(
        (distance(2, DVec3::new(0.6, 0.8, 0.5), DVec3::new(0.0, 1.5, 2.0)) - 2.0).abs() < 1e-12
    );
    assert!(shapes[3].normal(DVec3::Z).distance(DVec3::NEG_Y) < 1e-12);
    // A mirrored disc shows its outside where the image of its normal points.
    let scene = parse("def d; disc 0 0 0 0 0 1 1; sphere 1 0 0 1; end; i (d -sx 2 -mz -tx 1);");
    let shapes = rounds(&scene);
    assert!(shapes[0].normal(DVec3::Z).distance(DVec3::NEG_Z) < 1e-12);
    assert_eq!(shapes[1].bounds(), [DVec3::new(1.0, -1.0, -1.0), DVec3::new(5.0, 1.0, 1.0)]);
    assert_eq!(flat("def d; sphere 0 0 0 1; end; a (d) 3 -tx 3;").matches("\nsphere (").count(), 3);
    // Its inner radius is a part of the outer one however it is stretched.
    for text in [
        "disc 0 0 0 0 0 1 4 -inner 1;",
        "def d; disc 9 9 9 1 2 1 4 -inner 1; end; i (d -sx 3 -mz -ty 100);",
    ] {
        let ring = rounds(&parse(text))[0];
        assert!((ring.inner - 0.25).abs() < 1e-15, "{text}: {}", ring.inner);
        let read = parse(flat(text));
        assert!((rounds(&read)[0].inner - 0.25).abs() < 1e-15, "{text}");
    }
    let text = "def d; disc plate 0 0 0 1 0 0 1; end; i (d -sy 0);";
    assert_eq!(warnings(text, false), ["disc has no area where it is placed"]);
}
