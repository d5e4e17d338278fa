//! Curves against dense sampling of every triangle, and against straight rays; watertightness.

use std::ops::Range;

use glam::{DMat3, DQuat, DVec3, dvec3};
use ugtesting::Random;

use super::{Mesh, soup, sphere};
use crate::{Bvh, Curve, Hit, Ray};

/// A straight ray in the coordinates of a body that turns and accelerates:
/// R(−ωt)(origin + t direction + t²/2 push).
#[derive(Clone, Copy, Debug)]
struct Turning {
    origin: DVec3,
    direction: DVec3,
    push: DVec3,
    axis: DVec3,
    rate: f64,
}

impl Turning {
    fn turn(&self, t: f64) -> DQuat {
        let (sin, cos) = libm::sincos(-0.5 * self.rate * t);
        DQuat::from_xyzw(self.axis.x * sin, self.axis.y * sin, self.axis.z * sin, cos)
    }
}

impl Curve for Turning {
    fn at(&self, t: f64) -> (DVec3, DVec3) {
        let turn = DMat3::from_quat(self.turn(t));
        let place = self.origin + t * self.direction + 0.5 * t * t * self.push;
        let velocity = self.direction + t * self.push;
        (turn * place, turn * (velocity - self.rate * self.axis.cross(place)))
    }

    fn bend(&self, [(from, _), (to, _)]: [(f64, DVec3); 2]) -> f64 {
        let t = from.abs().max(to.abs());
        let speed = self.direction.length() + t * self.push.length();
        let reach = self.origin.length() + t * speed;
        self.push.length() + 2.0 * self.rate.abs() * speed + self.rate * self.rate * reach
    }
}

fn curve(random: &mut Random, size: f64, rate: f64) -> Turning {
    let direction = random.direction();
    let push = *random.pick(&[0.0, 0.5, 2.0]) * size;
    Turning {
        origin: random.in_ball(0.8 * size) - direction * size,
        direction: direction * size,
        push: random.in_ball(push),
        axis: random.direction(),
        rate: random.between(-rate, rate),
    }
}

/// A crossing of a triangle: parameter, index, and how far it is inside, the least height
/// above an edge.
type Oracle = (f64, u32, f64);

/// Crossings of planes by sampling, bisected where the sign changes.
fn sampled(mesh: &Mesh, curve: &Turning, range: &Range<f64>) -> Vec<Oracle> {
    const N: u32 = 600;
    let at = |idx: u32| range.start + (range.end - range.start) * f64::from(idx) / f64::from(N);
    let points: Vec<DVec3> = (0..=N).map(|idx| curve.at(at(idx)).0).collect();
    let mut all = Vec::new();
    for (row, triangle) in mesh.triangles.iter().enumerate() {
        let [a, b, c] = triangle.map(|row| mesh.positions[row as usize]);
        let normal = (b - a).cross(c - a);
        // Of slivers the side of a point is uncertain.
        let longest = (b - a).length().max((c - b).length()).max((a - c).length());
        if normal.length() <= 1e-3 * longest * longest {
            continue;
        }
        let height = |point: DVec3| normal.dot(point - a);
        for idx in 0..N {
            let low = height(points[idx as usize]);
            if (low < 0.0) == (height(points[idx as usize + 1]) < 0.0) {
                continue;
            }
            let (mut from, mut to) = (at(idx), at(idx + 1));
            for _ in 0..60 {
                let middle = 0.5 * (from + to);
                if (height(curve.at(middle).0) < 0.0) == (low < 0.0) {
                    from = middle
                } else {
                    to = middle
                }
            }
            let point = curve.at(from).0;
            let area = |p: DVec3, q: DVec3| {
                normal.dot((p - point).cross(q - point)) / normal.length_squared()
            };
            let least = area(b, c).min(area(c, a)).min(area(a, b));
            all.push((from, row as u32, least));
        }
    }
    all
}

fn visited(bvh: &Bvh, curve: &Turning, range: Range<f64>) -> Vec<Hit> {
    let mut hits = Vec::new();
    bvh.visit_on_curve(curve, range.clone(), |hit| {
        hits.push(hit);
        range.end
    });
    hits.sort_by(|a, b| a.t.total_cmp(&b.t));
    hits
}

/// Of crossings of equal parameters the one of the lowest triangle.
fn closest(bvh: &Bvh, curve: &Turning, range: Range<f64>) -> Option<Hit> {
    let mut best: Option<Hit> = None;
    bvh.visit_on_curve(curve, range, |hit| {
        assert!(best.is_none_or(|best| hit.t < best.t));
        best = Some(hit);
        hit.t
    });
    best
}

#[test]
fn hits_are_those_of_sampling() {
    let mut random = Random(7);
    let (mut n_hits, mut n_several) = (0, 0);
    for round in 0..60 {
        let mesh = if round % 3 == 0 { sphere(6, 8) } else { soup(&mut random, 60) };
        let mesh = mesh.mapped(*random.pick(&[1.0, 1e-3, 300.0]), DVec3::ZERO);
        let size =
            mesh.positions.iter().fold(0.0_f64, |size, position| size.max(position.length()));
        let bvh = mesh.build();
        for _ in 0..10 {
            let curve = curve(&mut random, size, 3.0);
            let range = 0.0..2.5;
            let found = visited(&bvh, &curve, range.clone());
            let expected = sampled(&mesh, &curve, &range);
            // Slivers and crossings at edges are uncertain.
            let is_clear = |least: f64| least.abs() > 1e-10 * size;
            for &(t, row, _) in
                expected.iter().filter(|&&(_, _, least)| least > 0.0 && is_clear(least))
            {
                let [a, b, c] =
                    mesh.triangles[row as usize].map(|row| mesh.positions[row as usize]);
                let hit = found.iter().find(|hit| hit.triangle == row && (hit.t - t).abs() < 1e-7);
                let hit = hit.unwrap_or_else(|| panic!("{curve:?} {t} {row}: {found:?}"));
                let place = a + (b - a) * hit.u + (c - a) * hit.v;
                assert!((place - curve.at(hit.t).0).length() < 1e-9 * size, "{curve:?} {hit:?}");
                n_hits += 1;
            }
            for hit in &found {
                let is_known = |&&(t, row, least): &&Oracle| {
                    row == hit.triangle
                        && (hit.t - t).abs() < 1e-6
                        && (least > 0.0 || !is_clear(least))
                };
                // Sampling misses crossings that are close to each other.
                let place = curve.at(hit.t).0;
                let [a, b, c] =
                    mesh.triangles[hit.triangle as usize].map(|row| mesh.positions[row as usize]);
                let is_there =
                    (a + (b - a) * hit.u + (c - a) * hit.v - place).length() < 1e-9 * size;
                assert!(is_there || expected.iter().any(|row| is_known(&row)), "{curve:?} {hit:?}");
                n_several += usize::from(
                    found.iter().any(|other| other.triangle == hit.triangle && other.t != hit.t),
                );
            }
            let first = closest(&bvh, &curve, range.clone());
            assert_eq!(
                first.map(|hit| hit.t.to_bits()),
                found.first().map(|hit| hit.t.to_bits()),
                "{curve:?}"
            );
        }
    }
    assert!(n_hits > 1000 && n_several > 10, "{n_hits} {n_several}");
}

#[test]
fn a_curve_without_bend_is_a_ray() {
    let mut random = Random(8);
    let mesh = sphere(20, 30);
    let bvh = mesh.build();
    let mut n_hits = 0;
    for _ in 0..2000 {
        let straight = Turning { rate: 0.0, push: DVec3::ZERO, ..curve(&mut random, 1.0, 0.0) };
        let ray = Ray { origin: straight.origin, direction: straight.direction };
        let [found, expected] = [closest(&bvh, &straight, 0.0..5.0), bvh.closest(&ray, 0.0..5.0)];
        assert_eq!(found.map(|hit| hit.triangle), expected.map(|hit| hit.triangle));
        if let (Some(found), Some(expected)) = (found, expected) {
            assert!((found.t - expected.t).abs() < 1e-12, "{found:?} {expected:?}");
            n_hits += 1;
        }
    }
    assert!(n_hits > 1000, "{n_hits}");
}

/// A closed surface is crossed an even number of times from outside to outside, also by curves
/// through edges and corners.
#[test]
fn closed_surfaces_do_not_leak() {
    let mut random = Random(9);
    let mesh = sphere(12, 16);
    let bvh = mesh.build();
    let (mut n_hits, mut n_at_edges) = (0, 0);
    for round in 0..if cfg!(debug_assertions) { 30_000 } else { 1_000_000 } {
        let mut curve = curve(&mut random, 1.0, 4.0);
        if round % 2 == 0 {
            // Through a point of an edge, at the parameter 1, as far as rounding allows.
            let [a, b, _] = random.pick(&mesh.triangles).map(|row| mesh.positions[row as usize]);
            let target = a + (b - a) * *random.pick(&[0.0, 0.5, 0.3]);
            curve.push = DVec3::ZERO;
            curve.origin = curve.turn(1.0).inverse() * target - curve.direction;
            n_at_edges += 1;
        }
        let hits = visited(&bvh, &curve, -30.0..30.0);
        assert!(hits.len().is_multiple_of(2), "{curve:?} {hits:?}");
        n_hits += hits.len();
    }
    assert!(n_hits > 20_000 && n_at_edges > 10_000, "{n_hits} {n_at_edges}");
}

/// Curves along the axes of a grid, through its edges and corners without any rounding.
#[test]
fn exact_edges_do_not_leak() {
    let corners: Vec<DVec3> =
        (0..25).map(|at| dvec3(f64::from(at % 5) - 2.0, f64::from(at / 5) - 2.0, 0.0)).collect();
    let mut triangles = Vec::new();
    for at in (0..20_u32).filter(|at| at % 5 < 4) {
        triangles.extend([[at, at + 1, at + 5], [at + 1, at + 6, at + 5]]);
    }
    let bvh = Bvh::new(&corners, &triangles);
    for x in -3..=3 {
        for y in -3..=3 {
            for rate in [0.0, 0.25, -2.0] {
                let origin = 0.5 * dvec3(f64::from(x), f64::from(y), 0.0);
                // It meets the plane at parameter 0.
                let curve = Turning {
                    origin,
                    direction: DVec3::Z,
                    push: DVec3::ZERO,
                    axis: DVec3::Z,
                    rate,
                };
                let hits = visited(&bvh, &curve, -1.0..1.5);
                assert_eq!(hits.len(), 1, "{curve:?}: {hits:?}");
                assert!(hits[0].t.abs() < 1e-12, "{hits:?}");
            }
        }
    }
}

#[test]
fn curves_of_any_numbers_end() {
    let mesh = sphere(6, 8);
    let bvh = mesh.build();
    let mut random = Random(10);
    for number in [f64::NAN, f64::INFINITY, 1e300, 1e-300, 0.0] {
        for at in 0..5 {
            let mut curve = curve(&mut random, 1.0, 1.0);
            match at {
                0 => curve.origin.x = number,
                1 => curve.direction = DVec3::splat(number),
                2 => curve.push.y = number,
                3 => curve.rate = number,
                _ => curve.axis.z = number,
            }
            visited(&bvh, &curve, 0.0..2.0);
            visited(&bvh, &curve, 2.0..0.0);
            visited(&bvh, &curve, 0.0..number);
        }
    }
}

/// Counts how often a curve is evaluated.
struct Counted<'c>(&'c Turning, std::cell::Cell<u64>);

impl Curve for Counted<'_> {
    fn at(&self, parameter: f64) -> (DVec3, DVec3) {
        self.1.set(self.1.get() + 1);
        self.0.at(parameter)
    }

    fn bend(&self, ends: [(f64, DVec3); 2]) -> f64 {
        self.0.bend(ends)
    }
}

/// A curve in the plane of triangles, which are seen edge-on, is not halved without an end.
#[test]
fn curves_in_the_plane_of_a_triangle_end() {
    let corners =
        [dvec3(1.0, 0.0, 0.0), dvec3(0.0, 1.0, 0.0), dvec3(-1.0, 0.0, 0.0), dvec3(0.0, -1.0, 0.0)];
    let triangles = [[0, 1, 2], [0, 2, 3]];
    // The same with rounding errors.
    let tilt = DQuat::from_axis_angle(dvec3(0.6, 0.0, 0.8), 0.7);
    for turn in [DQuat::IDENTITY, tilt] {
        let bvh = Bvh::new(&corners.map(|corner| turn * corner), &triangles);
        for rate in [0.0, 0.8, 2.0] {
            let curve = Turning {
                origin: turn * dvec3(0.1, -3.0, 0.0),
                direction: turn * DVec3::Y,
                push: turn * dvec3(0.3, 0.2, 0.0),
                axis: turn * DVec3::Z,
                rate,
            };
            let counted = Counted(&curve, std::cell::Cell::new(0));
            bvh.visit_on_curve(&counted, 0.0..9.0, |_| 9.0);
            assert!(counted.1.get() < 5_000, "{rate}: {}", counted.1.get());
        }
    }
}
