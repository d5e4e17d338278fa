//! Arrays, names of expanded vertices, velocities, lights and cameras in definitions.

use crate::language::{TRIANGLE, check, check_rest, flat, parse};

#[test]
fn copies_step_on() {
    check(
        "def d; v a 1 0 0; end; a row (d -ty 5) 3 -tx 2;",
        &["v row#0:a 1 5 0;", "v row#1:a 3 5 0;", "v row#2:a 5 5 0;"],
    );
    // The step is applied after the first transformations: the second copy is rotated about the
    // origin.
    check(
        "def d; v a 1 0 0; end; a ring (d -tx 1) 4 -rz 90;",
        &["v ring#0:a 2 0 0;", "v ring#1:a 0 2 0;", "v ring#2:a -2 0 0;", "v ring#3:a 0 -2 0;"],
    );
    check(
        "def d; v a 1 0 0; end; a (d) 3 -sa 2 -tx 1;",
        &["v #0:a 1 0 0;", "v #1:a 3 0 0;", "v #2:a 7 0 0;"],
    );
    check(
        "def d; v a 1 0 0; end; def r; a (d) 2 -tx 1; end; a g (r) 2 -ty 1;",
        &["v g#0#0:a 1 0 0;", "v g#0#1:a 2 0 0;", "v g#1#0:a 1 1 0;", "v g#1#1:a 2 1 0;"],
    );
}

#[test]
fn placed_vertices_are_named_by_their_path() {
    let def = "def d; v p 0 0 0; end; ";
    let row = |calls: &str, expected: &[&str]| {
        let lines: Vec<String> = expected.iter().map(|name| format!("v {name} 0 0 0;")).collect();
        check(&format!("{def}{calls}"), &lines.iter().map(String::as_str).collect::<Vec<_>>());
    };
    row("i car (d);", &["car:p"]);
    row("i (d);", &["d:p"]);
    row("i (d); i (d); i (d);", &["d:p", "d_2:p", "d_3:p"]);
    row("i x (d); i x (d);", &["x:p", "x_2:p"]);
    row("a floor (d) 2;", &["floor#0:p", "floor#1:p"]);
    row("a (d) 2;", &["#0:p", "#1:p"]);
    row("a (d) 1; a (d) 1;", &["d#0:p", "d_2#0:p"]);
    row(
        "def r; a (d) 2; end; a floor (r) 2;",
        &["floor#0#0:p", "floor#0#1:p", "floor#1#0:p", "floor#1#1:p"],
    );
    row("def r; i in (d); end; i out (r);", &["out:in:p"]);
    // Names in the text are kept; generated ones get a suffix.
    row("v car:p 0 0 0; i car (d);", &["car:p", "car:p_2"]);
    row("v car:p 0 0 0; v car:p_2 0 0 0; i car (d);", &["car:p", "car:p_2", "car:p_3"]);
    row("i x (d); i x (d); i x_2 (d);", &["x:p", "x_3:p", "x_2:p"]);
    // Faces, wires, lights and cameras are named in the same way.
    check_rest(
        &format!(
            "def t; {TRIANGLE} f roof (a b c); f (a b c); w edge (a b); l sun 1; cam eye -og; end; i car (t);"
        ),
        &[
            "f car:roof (car:a car:b car:c);",
            "f (car:a car:b car:c);",
            "w car:edge (car:a car:b);",
            "l car:sun 1;",
            "cam car:eye -og;",
        ],
    );
}

/// `<…>` of the faces and wires of a scene.
fn motions(text: &str) -> Vec<String> {
    let lines = flat(text);
    let lines = lines.lines().filter(|line| line.starts_with(['f', 'w']));
    lines
        .map(|line| {
            line.split_once('<').map_or("", |(_, behind)| behind.trim_end_matches(">;")).to_string()
        })
        .collect()
}

#[test]
fn velocities_in_instances_that_move_are_composed() {
    let def = format!("def d; {TRIANGLE} f (a b c); f (a b c) <0 0 .1>; end; ");
    let of = |calls: &str| motions(&format!("{def}{calls}"));
    assert_eq!(of("i (d);"), ["", "0 0 0.1"]);
    assert_eq!(of("i (d) <0 0 .2>;"), ["0 0 0.2", "0 0 0.29411764705882354"], "(.1 + .2)/1.02");
    assert_eq!(of("i (d) <0 0 0>;"), ["0 0 0", "0 0 0.1"]);
    assert_eq!(of("def e; i (d); end; i (e) <.3 0 0>;")[0], "0.3 0 0");
    assert_eq!(of("def e; i (d) <0 0 0>; end; i (e) <.3 0 0>;")[0], "0.3 0 0");
    // Across, the own one is slower by γ, and the axes turn by (P25).
    let across = of("i (d) <.6 0 0>;")[1].clone();
    let number = |idx: usize| across.split(' ').nth(idx).unwrap().parse::<f64>().unwrap();
    assert!((number(0) - 0.6).abs() + (number(2) - 0.08).abs() < 1e-15, "{across}");
    let angle = number(5);
    let wigner = ugphysics::wigner_rotation(velocity([0.0, 0.0, 0.1]), velocity([0.6, 0.0, 0.0]));
    assert!((angle - 2.0 * libm::atan2(wigner.y, wigner.w)).abs() < 1e-15);
    // Transformations turn what is stated inside, and do not make it faster.
    assert_eq!(of("i (d -rx 90 -sa 3);")[1], "0 -0.1 0");
    assert_eq!(of("i (d -mz);")[1], "0 0 -0.1");
    assert_eq!(of("def e; i (d) <0 .2 0>; end; i (e -rz 90);")[0], "-0.2 0 0");
}

fn velocity(beta: [f64; 3]) -> ugphysics::Velocity {
    ugphysics::Velocity::from_beta(beta.into()).unwrap()
}

#[test]
fn reference_points_are_origins_of_instances() {
    let def = format!("def d; {TRIANGLE} f (a b c); f (a b c) <0 0 .1>; end; ");
    let of = |calls: &str| motions(&format!("{def}{calls}"));
    assert_eq!(of("i (d -tx 1);"), ["", "0 0 0.1 -at 1 0 0"]);
    assert_eq!(of("i (d -tx 1) <0 .2 0>;")[0], "0 0.2 0 -at 1 0 0");
    assert_eq!(of("i (d -tx 1) <0 .2 0 -at 5 0 0>;")[0], "0 0.2 0 -at 5 0 0");
    assert_eq!(
        of("def e; i (d -tx 1) <0 .2 0>; end; i (e -ty 2 -rz 90);")[0],
        "-0.2 0 0 -at -2 1 0"
    );
    // An array is one body.
    let array = of("a (d -tz 2) 2 -tx 1 <0 .2 0>;");
    assert_eq!([&array[0], &array[2]], ["0 0.2 0 -at 0 0 2"; 2]);
    // What rests in a ship is part of it; at its time 0 what moves in it is where the ship has it.
    let inner = of("def e; i (d -tx 1) <0 0 0>; end; i (e) <.6 0 0>;");
    assert_eq!(inner[0], "0.6 0 0");
    assert_eq!(inner[1].split_once(" -shift ").unwrap().1, "0.75 0.25 0 0", "γ(v, 1) − (0, 1)");
}

/// A flat scene is the same scene.
#[test]
fn frames_on_frames_read_back() {
    let text = format!(
        "motion m -at 1 2 3 -vel .4 .3 0; motion n -on m -at 0 1 0 -vel 0 .5 .1; motion o -on n -orbit 1 1 1 0 0 1 .3;
        def d; {TRIANGLE} f (a b c) <.3 .1 0>; l 1 2 3 4 0 <.1 0 0>; end; def e; i (d -ry 20 -tz 5) <0 .5 0>; end;
        i (e -rx 10) <m>; i (e -tx 3) <.1 .2 .3>; i (d) <n>; f (i#1:a i#2:a i#1:b) <o>; l 1 1 1 1 0 <0 .1 0>;"
    )
    .replace("f (i#1:a i#2:a i#1:b) <o>;", "v a 1 1 0; v b 1 2 0; v c 2 2 0; f (a b c) <o>;");
    let once = flat(&text);
    assert_eq!(flat(&once), once);
    let motions = |text: &str| {
        let scene = parse(text);
        let lights = scene.lights.iter().filter_map(|light| light.motion.body());
        let bodies: Vec<_> = scene.faces.iter().map(|face| face.body).chain(lights).collect();
        bodies.into_iter().map(|body| scene.bodies.motion(body).clone()).collect::<Vec<_>>()
    };
    assert_eq!(motions(&once), motions(&text));
}

#[test]
fn equal_velocities_are_one_body() {
    let scene = parse(format!(
        "{TRIANGLE} f (a b c) <0 0 .1>; f (b c a) <0 .1 0>; f (c a b) <0 0 .1>; f (a b c) <-0 0 .1>;"
    ));
    assert_eq!(scene.bodies.len(), 3);
    assert_eq!(scene.faces.iter().map(|face| face.body.index()).collect::<Vec<_>>(), [1, 2, 1, 1]);
}

#[test]
fn lights_and_cameras_are_placed() {
    check(
        "def d; l 1 1 0 0; l 1 1 0 0 2; l 1; cam -ep 1 0 0 -vc 0 0 0 -ud 1 0 0; end; i (d -rz 90 -tz 5) <.5 0 0>;",
        &["l 1 0 1 0;", "l 1 0 1 5 2;", "l 1;", "cam -ep 0 1 5 -vc 0 0 5 -ud 0 1 0;"],
    );
}
