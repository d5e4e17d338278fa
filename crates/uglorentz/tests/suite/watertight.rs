//! Closed meshes stay closed: whatever is cut, every edge has one face on each side.

use std::collections::BTreeSet;
use std::fmt::Write;

use glam::DVec3;
use proptest::prelude::*;
use uglorentz::{Config, Pieces};
use ugscene::{RestFrames, ShownEffects};
use ugtesting::Random;

use crate::common::{edges, parse, rock, run};

/// Corners, and faces by their contours.
type Solid = (Vec<DVec3>, Vec<Vec<Vec<usize>>>);

/// A prism on a star: quadrilaterals, and two polygons that are not convex.
fn star(random: &mut Random, n: usize) -> Solid {
    let (corners, sides) = ring(random, 2 * n, [0.5, 1.0], 0);
    let ends = [(0..2 * n).rev().collect(), (2 * n..4 * n).collect()];
    (corners, sides.into_iter().chain(ends).map(|contour| vec![contour]).collect())
}

/// A star with a star-shaped hole through it: two faces with holes, and quadrilaterals.
fn tube(random: &mut Random, n: usize) -> Solid {
    let (mut corners, sides) = ring(random, 2 * n, [0.6, 1.0], 0);
    let (inner, inner_sides) = ring(random, n, [0.2, 0.4], 4 * n);
    corners.extend(inner);
    // What is outside the tube is inside the hole.
    let turned = inner_sides.into_iter().map(|side| side.into_iter().rev().collect());
    let mut faces: Vec<Vec<Vec<usize>>> =
        sides.into_iter().chain(turned).map(|contour| vec![contour]).collect();
    let hole = |from: usize| from..from + n;
    faces.push(vec![(0..2 * n).rev().collect(), hole(4 * n).collect()]);
    faces.push(vec![(2 * n..4 * n).collect(), hole(5 * n).rev().collect()]);
    (corners, faces)
}

/// `n` corners below and `n` above, at two distances from the axis in turn, and the sides between
/// them, seen from outside; numbers count from `first`.
fn ring(
    random: &mut Random,
    n: usize,
    reach: [f64; 2],
    first: usize,
) -> (Vec<DVec3>, Vec<Vec<usize>>) {
    let turn = random.between(0.0, 1.0);
    let corner = |k: usize, height: f64| {
        let (sin, cos) = libm::sincos(std::f64::consts::TAU * (k as f64 + turn) / n as f64);
        DVec3::new(cos * reach[k % 2], sin * reach[k % 2], height)
    };
    let corners =
        [-0.7, 0.7].iter().flat_map(|&height| (0..n).map(move |k| corner(k, height))).collect();
    let side = |k: usize| {
        let next = (k + 1) % n;
        [k, next, n + next, n + k].map(|corner| first + corner).to_vec()
    };
    (corners, (0..n).map(side).collect())
}

fn solid(random: &mut Random, kind: usize) -> Solid {
    let (corners, faces) = match kind {
        0 => star(random, 3),
        1 => star(random, 5),
        2 => tube(random, 4),
        _ => {
            let (corners, faces) = rock(random, DVec3::ZERO, 1.0, 1);
            (corners, faces.into_iter().map(|face| vec![face]).collect())
        }
    };
    let turn = glam::DQuat::from_axis_angle(random.direction(), random.between(0.0, 6.0));
    // Some are round the eye.
    let center = random.in_ball(4.0);
    (corners.into_iter().map(|corner| turn * corner + center).collect(), faces)
}

/// Appends a solid whose vertices are called after `body`.
fn append(text: &mut String, body: usize, (corners, faces): &Solid, beta: DVec3) {
    for (idx, p) in corners.iter().enumerate() {
        writeln!(text, "v b{body}v{idx} {:?} {:?} {:?};", p.x, p.y, p.z).unwrap();
    }
    for contours in faces {
        let name = |corner: &usize| format!("b{body}v{corner}");
        let contour = |corners: &Vec<usize>| {
            format!("({})", corners.iter().map(name).collect::<Vec<_>>().join(" "))
        };
        let contours: Vec<String> = contours.iter().map(contour).collect();
        writeln!(text, "f {} <{:?} {:?} {:?}>;", contours.join(" "), beta.x, beta.y, beta.z)
            .unwrap();
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, ..ProptestConfig::default() })]

    #[test]
    fn closed_solids_stay_closed(
        seed in any::<u64>(),
        kinds in prop::collection::vec(0..4usize, 1..4),
        speed in prop_oneof![Just(0.0), Just(0.3), Just(0.9), Just(0.99), Just(0.999)],
        bound in prop_oneof![Just(10e-3), Just(2e-3), Just(0.5e-3)],
        color_error in prop_oneof![Just(f64::INFINITY), Just(5e-3)],
        light_error in prop_oneof![Just(f64::INFINITY), Just(0.1)],
        pieces in prop_oneof![3 => Just(None), 1 => (1..4_u32).prop_map(Some)],
    ) {
        let mut random = Random(seed);
        let mut text = "l near 0.5 1 -2 0.5 0 <0.3 0.2 0>; l 0.5 -1 1 3 0;".to_string();
        for (body, &kind) in kinds.iter().enumerate() {
            let solid = solid(&mut random, kind);
            append(&mut text, body, &solid, random.direction() * speed);
        }
        let pieces = pieces.map_or(Pieces::UpTo(bound), Pieces::PerEdge);
        let scene = run(&text, &Config { pieces, color_error, light_error, ..Config::default() }).scene;
        let odd = edges(&scene).into_iter().find(|(_, count)| *count != (1, 1));
        prop_assert_eq!(odd, None);
    }
}

#[test]
fn the_solids_are_closed_and_some_are_cut() {
    let mut random = Random(3);
    for kind in 0..4 {
        let solid = solid(&mut random, kind);
        let mut text = String::new();
        append(&mut text, 0, &solid, DVec3::X * 0.9);
        let whole = parse(&text);
        assert!(edges(&whole).values().all(|count| *count == (1, 1)), "{kind}");
        let cut = run(&text, &Config { pieces: Pieces::UpTo(1e-3), ..Config::default() }).scene;
        assert!(cut.faces.len() > 2 * whole.faces.len(), "{kind}");
    }
}

/// A face beside several, whose corners are on its edge: what is seen of the edge has the same
/// vertices on both sides, to the bit, whoever owns them.
#[test]
fn edges_are_cut_at_vertices_of_other_faces() {
    let mut random = Random(7);
    for case in 0..60 {
        let turn = glam::DQuat::from_axis_angle(random.direction(), random.between(0.0, 6.0));
        let middle = random.direction() * random.between(2.0, 9.0);
        let place = |x: f64, z: f64| turn * DVec3::new(x, 0.0, z) + middle;
        let n = 2 + case % 7;
        let heights: Vec<f64> = (0..=n).map(|k| -3.0 + 6.0 * f64::from(k) / f64::from(n)).collect();
        // The slope of the common edge.
        let border = |z: f64| 0.1 * z;
        let mut text = String::new();
        let mut vertex =
            |name: &str, p: DVec3| writeln!(text, "v {name} {:?} {:?} {:?};", p.x, p.y, p.z);
        for (name, x, z) in [
            ("a", -4.0, -3.0),
            ("b", border(-3.0), -3.0),
            ("c", border(3.0), 3.0),
            ("d", -4.0, 3.0),
        ] {
            vertex(name, place(x, z)).unwrap();
        }
        for (k, &z) in heights.iter().enumerate() {
            vertex(&format!("p{k}"), place(border(z), z)).unwrap();
            vertex(&format!("q{k}"), place(4.0, z)).unwrap();
        }
        let beta = random.direction() * [0.3, 0.9, 0.99][case as usize % 3];
        // The motions of two bodies with names are alike.
        let motion = format!("-vel {:?} {:?} {:?}", beta.x, beta.y, beta.z);
        writeln!(text, "motion one {motion}; motion two {motion}; c red 1 0 1; c blue 1 240 1;")
            .unwrap();
        writeln!(text, "f (a b c d) red <one>;").unwrap();
        for k in 0..n {
            let body = if case % 2 == 0 { "one" } else { "two" };
            writeln!(text, "f (p{k} q{k} q{} p{}) blue <{body}>;", k + 1, k + 1).unwrap();
        }
        let found =
            run(&text, &Config { geometry: ShownEffects::default(), ..Config::default() }).scene;
        let frames = RestFrames::new(&found);
        let rest = ugscene::rest_positions(&found, DVec3::ZERO, &frames);
        let is_on_border = |row: usize| {
            let p = turn.inverse() * (rest[row] - middle);
            (p.x - border(p.z)).abs() < 1e-9
        };
        let of_color = |name: &str| -> BTreeSet<[u64; 3]> {
            let is_one = |face: &&ugscene::Face| {
                face.color
                    .is_some_and(|color| found.names.get(found.colors[color.index()].name) == name)
            };
            let corners = found
                .faces
                .iter()
                .filter(is_one)
                .flat_map(|face| found.face_contours(face).flatten());
            let rows = corners.map(|corner| corner.index()).filter(|&row| is_on_border(row));
            rows.map(|row| found.vertices[row].position.to_array().map(f64::to_bits)).collect()
        };
        let (red, blue) = (of_color("red"), of_color("blue"));
        assert_eq!(red, blue, "case {case}: {} and {}", red.len(), blue.len());
        assert!(red.len() > n as usize, "case {case}");
    }
}
