//! Rays in the coordinates of bodies on world lines: laws, with random motions.

use std::ops::ControlFlow;

use glam::DVec3;
use ugphysics::{Event, Lorentz, Piece, SampledPath, Velocity, WorldLine};
use ugtesting::Random;

/// Random motions of all kinds, of bodies within 1 of their point A at `at`.
fn motion(random: &mut Random, kind: usize) -> (WorldLine, DVec3) {
    let velocity = Velocity::from_beta(random.in_ball(0.9)).unwrap();
    let at = random.in_ball(3.0);
    let begins = [random.between(-6.0, -2.0), random.between(-2.0, 0.0), random.between(0.0, 3.0)];
    let pieces = |random: &mut Random, most: f64| {
        let [a, b, c] = begins;
        [[a, b], [b, c]].map(|[from, to]| Piece { of: random.in_ball(most), from, to })
    };
    let always = |random: &mut Random| {
        [Piece { of: random.in_ball(0.6), from: f64::NEG_INFINITY, to: f64::INFINITY }]
    };
    let world_line = match kind % 7 {
        0 => WorldLine::accelerated(at, velocity, &pieces(random, 0.5), &[]),
        1 => WorldLine::accelerated(at, velocity, &[], &always(random)),
        2 => {
            let (push, spin) = (pieces(random, 0.2), pieces(random, 0.5));
            WorldLine::accelerated(at, velocity, &push, &spin)
        }
        3 => {
            let (center, axis) = (at + random.in_ball(1.0), random.in_ball(1.0));
            WorldLine::orbiting(at, center, axis, 0.3, &pieces(random, 0.3))
        }
        4 => {
            let car = WorldLine::accelerated(at, velocity, &pieces(random, 0.15), &[]).unwrap();
            car.with_part(
                at + random.in_ball(1.0),
                &always(random).map(|spin| Piece { of: 0.5 * spin.of, ..spin }),
            )
        }
        5 => {
            let rows = [0.0, 1.5, 2.7, 4.5, 5.0, 6.2, 8.0, 9.0].map(|passed: f64| {
                let x = at + passed * velocity.beta() * 0.5;
                let bend =
                    DVec3::new(libm::sin(0.6 * passed), libm::cos(0.5 * passed), 0.1 * passed);
                Event { t: begins[0] + passed, x: x + 0.5 * bend }
            });
            let spin = if kind.is_multiple_of(2) { &[][..] } else { &pieces(random, 0.2) };
            WorldLine::along(at, SampledPath::new(&rows).unwrap(), spin)
        }
        _ => {
            let disc = WorldLine::accelerated(at, velocity, &pieces(random, 0.1), &always(random))
                .unwrap();
            disc.with_part(at + random.in_ball(0.3), &pieces(random, 0.3))
        }
    };
    let frame = Lorentz::boost(Velocity::from_beta(random.in_ball(0.7)).unwrap());
    let shift = Event { t: random.between(-3.0, 3.0), x: random.in_ball(5.0) };
    (world_line.unwrap().in_frame(frame, shift), at)
}

#[test]
fn a_ray_meets_what_is_seen_along_it() {
    let mut random = Random(33);
    for kind in 0..600 {
        let (world_line, at) = motion(&mut random, kind);
        let points: Vec<DVec3> = (0..20).map(|_| at + random.in_ball(0.8)).collect();
        let tube = world_line.tube(points.iter().copied()).unwrap();
        for &point in &points {
            let observer = Event { t: random.between(-9.0, 9.0), x: random.in_ball(9.0) };
            let seen = world_line.emission(point, observer).unwrap();
            let way = seen.event.x - observer.x;
            // Light, and a ray through a medium.
            let slow = Event { t: -1.3 * way.length(), x: way };
            let rays = [
                (observer, Event { t: -way.length(), x: way }, None),
                (seen.event - slow, slow, Some(seen.event + slow)),
            ];
            for (origin, step, end) in rays {
                let mut found = None;
                world_line
                    .visit_ray(&tube, origin, step, end, |stretch, range| {
                        assert!(range.start < range.end);
                        if range.contains(&seen.own_time) {
                            let met = stretch.at(seen.own_time);
                            found = Some(met);
                            // Rounding of events, carried to the frame of the body.
                            let gamma = seen.velocity.gamma();
                            let tolerance =
                                1e-13 * gamma * gamma * (9.0 + way.length() + observer.t.abs());
                            assert!(
                                (met.point - point).length() < tolerance,
                                "{kind}: {met:?} {point}"
                            );
                            assert!(
                                (met.s - 1.0).abs() * way.length() < tolerance,
                                "{kind}: {met:?}"
                            );
                        }
                        check_curve(stretch, range);
                        ControlFlow::Continue(())
                    })
                    .unwrap();
                assert!(found.is_some(), "{kind} {point} {observer:?}: {seen:?}");
            }
        }
    }
}

/// Derivatives and the bound of the second one, against differences.
fn check_curve(stretch: &ugphysics::RayStretch<'_>, range: std::ops::Range<f64>) {
    let at = |part: f64| range.start + part * (range.end - range.start);
    let step = 1e-3;
    if range.end - range.start < 20.0 * step {
        return;
    }
    for part in [0.1, 0.5, 0.8] {
        let [before, here, behind] = [-step, 0.0, step].map(|change| stretch.at(at(part) + change));
        let slope = (behind.point - before.point) / (2.0 * step);
        let bend = (behind.point + before.point - 2.0 * here.point).length() / (step * step);
        assert!(
            (slope - here.derivative).length() < 1e-4 * (1.0 + slope.length()),
            "{slope} {here:?}"
        );
        let bound =
            stretch.bend([(at(part) - step, before.point), (at(part) + step, behind.point)]);
        assert!(bend <= bound * 1.001 + 1e-3, "{bend} {bound}");
    }
    let half = range.start.midpoint(range.end);
    let ends = [range.start, half].map(|own_time| (own_time, stretch.at(own_time).point));
    let bound = stretch.bend(ends) * (half - range.start) * (half - range.start) / 8.0;
    for part in [0.1, 0.3, 0.5, 0.7] {
        let point = stretch.at(range.start + part * (half - range.start)).point;
        let chord = ends[0].1.lerp(ends[1].1, part);
        assert!((point - chord).length() <= bound * 1.001 + 1e-9, "{point} {chord} {bound}");
    }
}

/// Own times and places of light from random points of random triangles, of many sizes, against
/// their bounds, which are to be close for small triangles.
#[test]
fn light_of_triangles_is_within_its_bounds() {
    let mut random = Random(34);
    let (mut n_small, mut n_close, mut n_none, mut closest) = (0, 0, 0, 0.0_f64);
    for kind in 0..600 {
        let (world_line, at) = motion(&mut random, kind);
        let middle = at + random.in_ball(0.7);
        let observer = Event { t: random.between(-9.0, 9.0), x: random.in_ball(9.0) };
        let tube =
            world_line.tube([at - DVec3::splat(0.5), at + DVec3::splat(0.5)].into_iter()).unwrap();
        let passages = world_line.smooth_stretches(&tube, observer).unwrap();
        for size in [1e-4, 1e-3, 1e-2, 0.05, 0.2] {
            let corners = [(); 3].map(|()| middle + random.in_ball(size));
            let seen = corners.map(|point| (point, world_line.light(point, observer).unwrap()));
            let Some(bounds) =
                world_line.seen_triangle(&tube, &passages, &seen, observer, kind as u32 % 3)
            else {
                n_none += 1;
                continue;
            };
            let mut most = 0.0_f64;
            for _ in 0..60 {
                let (u, v) = (random.unit(), random.unit());
                let weights =
                    if u + v < 1.0 { [1.0 - u - v, u, v] } else { [u + v - 1.0, 1.0 - u, 1.0 - v] };
                let mean =
                    |of: [DVec3; 3]| weights[0] * of[0] + weights[1] * of[1] + weights[2] * of[2];
                let light = world_line.emission(mean(corners), observer).unwrap();
                let deviation = (light.event.x - mean(seen.map(|(_, seen)| seen.event.x))).length();
                assert!(
                    bounds.own_times.contains(&light.own_time),
                    "{kind} {size}: {bounds:?} {light:?}"
                );
                assert!(deviation <= bounds.deviation, "{kind} {size}: {bounds:?} {deviation}");
                most = most.max(deviation / bounds.deviation);
            }
            closest = closest.max(most);
            if size == 1e-2 {
                let [a, b, c] = seen.map(|(_, seen)| seen.event.x);
                let edges = (b - a).length() + (c - b).length() + (a - c).length();
                n_small += 1;
                n_close += u32::from(bounds.deviation < 0.1 * edges);
            }
        }
    }
    assert!(
        n_close > n_small / 2 && n_none < n_small,
        "{n_none} {n_close} of {n_small}, {closest}"
    );
}
