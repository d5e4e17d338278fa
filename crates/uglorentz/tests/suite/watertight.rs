//! Closed meshes stay closed: whatever is cut, every edge has one face on each side.

use std::fmt::Write;

use glam::DVec3;
use proptest::prelude::*;
use uglorentz::{Config, Pieces};
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
fn ring(random: &mut Random, n: usize, reach: [f64; 2], first: usize) -> (Vec<DVec3>, Vec<Vec<usize>>) {
    let turn = random.between(0.0, 1.0);
    let corner = |k: usize, height: f64| {
        let (sin, cos) = libm::sincos(std::f64::consts::TAU * (k as f64 + turn) / n as f64);
        DVec3::new(cos * reach[k % 2], sin * reach[k % 2], height)
    };
    let corners = [-0.7, 0.7].iter().flat_map(|&height| (0..n).map(move |k| corner(k, height))).collect();
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
        let contour =
            |corners: &Vec<usize>| format!("({})", corners.iter().map(name).collect::<Vec<_>>().join(" "));
        let contours: Vec<String> = contours.iter().map(contour).collect();
        writeln!(text, "f {} <{:?} {:?} {:?}>;", contours.join(" "), beta.x, beta.y, beta.z).unwrap();
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
