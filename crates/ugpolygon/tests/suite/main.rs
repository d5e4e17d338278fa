//! Triangles of polygons.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, its helpers too")]

use glam::DVec3;
use ugpolygon::{Triangle, is_convex, triangulate};
use ugscene::newell_normal;
use ugtesting::Random;

fn ring(points: &[(f64, f64)]) -> Vec<DVec3> {
    // A slanted plane, so that no coordinate is special.
    points.iter().map(|&(x, y)| DVec3::new(x, y, 0.3 * x - 0.2 * y + 7.0)).collect()
}

/// Area of a polygon in that plane per area below it.
fn tilt() -> f64 {
    DVec3::new(-0.3, 0.2, 1.0).length()
}

#[test]
fn triangles_cover_the_polygon() {
    fn check(
        what: &str,
        outline: &[(f64, f64)],
        holes: &[&[(f64, f64)]],
        expected: Option<(usize, f64)>,
    ) {
        for mirrored in [false, true] {
            let turn = |points: &[(f64, f64)]| -> Vec<(f64, f64)> {
                points.iter().map(|&(x, y)| (if mirrored { -x } else { x }, y)).collect()
            };
            let mut rings = vec![ring(&turn(outline))];
            rings.extend(holes.iter().map(|hole| ring(&turn(hole))));
            let corners: Vec<DVec3> = rings.concat();
            let normal = newell_normal(rings[0].iter().copied());
            let found = triangulate(&rings);
            assert_eq!(found.as_ref().map(Vec::len), expected.map(|e| e.0), "{what}");
            let Some((_, area)) = expected else { continue };
            let sum: f64 = found
                .unwrap()
                .iter()
                .map(|t| {
                    newell_normal(t.iter().map(|&c| corners[c as usize])).dot(normal.normalize())
                        / 2.0
                })
                .inspect(|&part| assert!(part > -1e-12, "{what}: turned"))
                .sum();
            assert!((sum - area * tilt()).abs() < 1e-12 * area, "{what}: {sum}");
        }
    }
    let square = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)];
    let inner = [(1.0, 1.0), (3.0, 1.0), (3.0, 3.0), (1.0, 3.0)];
    let mut turned_inner = inner;
    turned_inner.reverse();
    check("a square", &square, &[], Some((2, 16.0)));
    check("an arrow", &[(0.0, 0.0), (4.0, 0.0), (1.0, 1.0), (0.0, 4.0)], &[], Some((2, 4.0)));
    check("a hole", &square, &[&turned_inner], Some((8, 12.0)));
    check("a hole the wrong way round", &square, &[&inner], Some((8, 12.0)));
    check(
        "an island in the hole",
        &square,
        &[&inner, &[(1.5, 1.5), (2.5, 1.5), (2.0, 2.5)]],
        Some((9, 12.5)),
    );
    check("a second outline", &square, &[&[(5.0, 0.0), (6.0, 0.0), (6.0, 1.0)]], Some((3, 16.5)));
    check(
        "corners on straight sides, and a hole, for which ear cutting drops them",
        &[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (4.0, 0.0), (4.0, 4.0), (2.0, 4.0), (0.0, 4.0)],
        &[&turned_inner],
        Some((11, 12.0)),
    );
    check(
        "all corners of a triangle on its sides doubled",
        &[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (1.0, 1.0), (0.0, 2.0), (0.0, 1.0)],
        &[],
        Some((4, 2.0)),
    );
    check("no area", &[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0)], &[], None);
    check("a bow tie", &[(0.0, 0.0), (2.0, 2.0), (2.0, 0.0), (0.0, 3.0)], &[], None);
}

/// A square with `n` × `n` square holes.
fn sieve(n: usize) -> Vec<Vec<DVec3>> {
    let size = n as f64;
    let mut rings = vec![ring(&[(0.0, 0.0), (size, 0.0), (size, size), (0.0, size)])];
    for cell in 0..n * n {
        let (x, y) = ((cell % n) as f64, (cell / n) as f64);
        let corner = |dx: f64, dy: f64| (x + dx, y + dy);
        let hole = [corner(0.25, 0.25), corner(0.25, 0.75), corner(0.75, 0.75), corner(0.75, 0.25)];
        rings.push(ring(&hole));
    }
    rings
}

#[test]
fn polygons_of_many_corners_take_time_near_linear() {
    // A polygon with h holes and n corners has n + 2h - 2 triangles.
    assert_eq!(triangulate(&sieve(71)).unwrap().len(), 4 + 6 * 71 * 71 - 2);
    let n_teeth = 20_000;
    let there = (0..n_teeth).map(|idx| (f64::from(idx), f64::from(idx % 2)));
    let back = (0..n_teeth).rev().map(|idx| (f64::from(idx), 2.0 + f64::from(idx % 2)));
    let comb: Vec<(f64, f64)> = there.chain(back).collect();
    assert_eq!(triangulate(&[ring(&comb)]).unwrap().len(), 2 * n_teeth as usize - 2);
    let spiral: Vec<(f64, f64)> = (0..4000)
        .chain((0..4000).rev())
        .enumerate()
        .map(|(at, step)| {
            let (sine, cosine) = libm::sincos(f64::from(step) * 0.1);
            let radius = 10.0 + f64::from(step) * 0.1 + if at < 4000 { 0.0 } else { 2.0 };
            (radius * cosine, radius * sine)
        })
        .collect();
    assert_eq!(triangulate(&[ring(&spiral)]).unwrap().len(), 8000 - 2);
}

#[test]
fn repeated_corners_are_refused_soon() {
    let corners = ring(&[(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)]);
    let repeated: Vec<DVec3> = corners.iter().copied().cycle().take(6000).collect();
    assert_eq!(triangulate(&[repeated]), None);
    let shared: Vec<DVec3> = corners.iter().copied().cycle().take(255).collect();
    assert_eq!(triangulate(&[shared]), None);
}

#[test]
fn nesting_beyond_the_limit_is_refused() {
    let square = |size: f64| ring(&[(-size, -size), (size, -size), (size, size), (-size, size)]);
    let nested =
        |n: u32| -> Vec<Vec<DVec3>> { (1..=n).rev().map(|size| square(f64::from(size))).collect() };
    assert_eq!(triangulate(&nested(101)).unwrap().len(), 50 * 8 + 2);
    assert_eq!(triangulate(&nested(20_000)), None);
}

#[test]
fn any_size_is_triangulated_alike() {
    let star: Vec<(f64, f64)> = (0..8)
        .map(|idx| {
            let (sine, cosine) = libm::sincos(f64::from(idx));
            (f64::from(1 + idx % 3) * cosine, f64::from(1 + idx % 3) * sine)
        })
        .collect();
    let unit = triangulate(&[ring(&star)]).unwrap();
    for exponent in [-900, -300, 300, 900] {
        let scale = libm::ldexp(1.0, exponent);
        let scaled: Vec<DVec3> = ring(&star).iter().map(|&corner| corner * scale).collect();
        assert_eq!(triangulate(&[scaled]).as_ref(), Some(&unit), "2^{exponent}");
    }
}

/// Programs compute the triangles of a face in axes and units of their own, from positions that
/// were rounded in text.
#[test]
fn triangles_do_not_depend_on_axes_units_or_rounding() {
    let square = |x: f64, y: f64, size: f64| {
        [(x, y), (x + size, y), (x + size, y + size), (x, y + size)]
            .map(|(x, y)| DVec3::new(x, y, 0.0))
            .to_vec()
    };
    let flat = |points: &[(f64, f64)]| -> Vec<DVec3> {
        points.iter().map(|&(x, y)| DVec3::new(x, y, 0.0)).collect()
    };
    let mut bent = square(0.0, 0.0, 1.0);
    bent[2].z = 0.01;
    let shapes: [Vec<Vec<DVec3>>; 8] = [
        vec![square(0.0, 0.0, 1.0)],
        vec![bent],
        vec![flat(&[(0.0, 0.0), (4.0, 0.0), (1.0, 1.0), (0.0, 4.0)])],
        vec![flat(&[(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (1.0, 1.0), (1.0, 2.0), (0.0, 2.0)])],
        vec![flat(&[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (2.0, 2.0), (1.0, 2.0), (0.0, 2.0)])],
        vec![square(0.0, 0.0, 3.0), square(1.0, 1.0, 1.0)],
        vec![
            square(0.0, 0.0, 5.0),
            square(1.0, 1.0, 1.0),
            square(3.0, 1.0, 1.0),
            square(3.0, 3.0, 1.0),
        ],
        vec![flat(&[
            (0.0, 0.0),
            (1.0, 0.0),
            (2.0, 0.0),
            (3.0, 0.0),
            (3.0, 3.0),
            (1.0, 1.0),
            (0.0, 3.0),
        ])],
    ];
    let mut random = Random(1);
    for (row, rings) in shapes.iter().enumerate() {
        let expected = triangulate(rings).unwrap();
        for _ in 0..200 {
            let axis = random.direction();
            let turn = glam::DQuat::from_axis_angle(axis, random.between(-3.0, 3.0));
            let unit = libm::pow(10.0, random.between(-6.0, 6.0));
            let offset = random.in_cube(1.0);
            let mut place = |p: &DVec3| {
                let rounding = random.in_cube(1e-13);
                turn * ((*p + offset + rounding) * unit)
            };
            let placed: Vec<Vec<DVec3>> =
                rings.iter().map(|ring| ring.iter().map(&mut place).collect()).collect();
            assert_eq!(triangulate(&placed).as_ref(), Some(&expected), "shape {row}");
        }
    }
}

/// Mirroring an instance reverses its faces, but keeps the first corner.
#[test]
fn a_mirrored_convex_face_has_mirrored_triangles() {
    let ring = ring(&[(0.0, 0.0), (2.0, 0.0), (3.0, 1.0), (2.0, 3.0), (0.0, 2.0)]);
    let n = ring.len();
    let mirrored: Vec<DVec3> =
        (0..n).map(|idx| ring[(n - idx) % n] * DVec3::new(-1.0, 1.0, 1.0)).collect();
    let sorted = |triangles: Vec<Triangle>, number: &dyn Fn(u32) -> u32| {
        let mut all: Vec<Triangle> = triangles.into_iter().map(|t| t.map(number)).collect();
        all.iter_mut().for_each(|t| t.sort_unstable());
        all.sort_unstable();
        all
    };
    let found = sorted(triangulate(&[mirrored]).unwrap(), &|corner| (n as u32 - corner) % n as u32);
    assert_eq!(found, sorted(triangulate(&[ring]).unwrap(), &|corner| corner));
}

#[test]
fn convexity() {
    fn check(points: [(f64, f64); 4], expected: bool) {
        assert_eq!(is_convex(&ring(&points)), expected, "{points:?}");
    }
    check([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)], true);
    check([(0.0, 1.0), (1.0, 1.0), (1.0, 0.0), (0.0, 0.0)], true);
    check([(0.0, 0.0), (4.0, 0.0), (1.0, 1.0), (0.0, 4.0)], false);
    check([(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (0.0, 1.0)], false);
    check([(0.0, 0.0), (1.0, 1.0), (1.0, 0.0), (0.0, 1.0)], false);
    check([(1.0, 1.0); 4], false);
    let around = |step: f64| {
        let corner = |at: i32| libm::sincos(f64::from(at) * step);
        is_convex(&ring(&(0..5).map(|at| (corner(at).1, corner(at).0)).collect::<Vec<_>>()))
    };
    assert!(
        around(std::f64::consts::TAU / 5.0) && !around(2.0 * std::f64::consts::TAU / 5.0),
        "a star"
    );
}
