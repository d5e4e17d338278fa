//! Bodies that accelerate, spin and orbit: a slow oracle, laws.

use std::ops::ControlFlow;

use glam::DVec3;
use ugphysics::{Event, WorldLine};
use ugtesting::Random;
use ugtrace::rays::{Intersection, PastRay, Start};
use ugtrace::{SurfacePoint, Surfaces, textures::Textures};

use super::{Scenery, ray};

/// A triangle.
fn face(name: &str, corners: [DVec3; 3], motion: &str) -> String {
    let [a, b, c] = corners.map(|DVec3 { x, y, z }| format!("{x} {y} {z}"));
    format!("v {name}a {a}; v {name}b {b}; v {name}c {c}; f ({name}a {name}b {name}c) {motion};\n")
}

/// A random motion for bodies within 2 of the origin.
fn motion(random: &mut Random, kind: usize) -> String {
    let vector = |random: &mut Random, most: f64| {
        let DVec3 { x, y, z } = random.in_ball(most);
        format!("{x} {y} {z}")
    };
    let velocity = vector(random, 0.8);
    let times = [-9.0, -4.0, -1.0].map(|time| time + random.between(-1.0, 1.0));
    let push = |random: &mut Random, most: f64| {
        let [a, b] = [0, 1].map(|_| vector(random, most));
        format!("-acc {a} {} {} -acc {b} {} {}", times[0], times[1], times[1], times[2])
    };
    match kind % 5 {
        0 => format!("-vel {velocity} {}", push(random, 0.4)),
        1 => format!("-vel {velocity} -spin {}", vector(random, 0.45)),
        2 => format!("-vel {velocity} {} -spin {}", push(random, 0.1), vector(random, 0.35)),
        3 => {
            let (center, axis) = (vector(random, 1.0), vector(random, 1.0));
            format!("-at 0.3 0 0 -orbit {center} {axis} 0.2 -spin {}", vector(random, 0.2))
        }
        _ => {
            let velocity = random.in_ball(0.6);
            let row = |time: f64| {
                let DVec3 { x, y, z } = time * velocity + random.in_ball(0.03);
                format!("{time} {x} {y} {z}")
            };
            // Own time 0 is at its first event, before which the motion is another.
            let rows = times.map(row).join(" ");
            let spin = if random.one_in(2) {
                format!("-spin {}", vector(random, 0.2))
            } else {
                String::new()
            };
            format!("-path ({rows}) {spin}")
        }
    }
}

/// A scene of a body of `n` triangles, and their corners in its coordinates, relative to the eye.
fn world(random: &mut Random, kind: usize, n: usize) -> (String, Vec<[DVec3; 3]>) {
    let mut text = format!("l 1; motion m {};\n", motion(random, kind));
    let eye = 7.0 * random.direction();
    let mut triangles = Vec::new();
    for row in 0..n {
        let center = random.in_ball(1.2);
        let corners = [0, 1, 2].map(|_| center + random.in_ball(0.6));
        text += &face(&format!("t{row}"), corners, "<m>");
        triangles.push(corners.map(|corner| corner - eye));
    }
    let DVec3 { x, y, z } = eye;
    text += &format!("cam -ep {x} {y} {z} -vc 0 0 0 -ud 0.123 0.4 1;");
    (text, triangles)
}

/// Hits of a ray of light on a triangle, from the emission events of its points alone: where the
/// direction in which a point is seen is that of the ray, by Newton's method from many points. Each
/// is its parameter and least barycentric weight.
fn oracle(
    line: &WorldLine,
    [a, b, c]: [DVec3; 3],
    origin: Event,
    direction: DVec3,
) -> Vec<(f64, f64)> {
    const N: i32 = 3;
    let (e, f) = direction.normalize().any_orthonormal_pair();
    let seen = |u: f64, v: f64| {
        let point = a + u * (b - a) + v * (c - a);
        let way = line.emission(point, origin).ok()?.event.x - origin.x;
        let along = way.dot(direction) / direction.length();
        (along > 0.0).then(|| ([way.dot(e), way.dot(f)], along / direction.length()))
    };
    let mut found: Vec<(f64, f64)> = Vec::new();
    for start in 0..N * N {
        let (mut u, mut v) = (f64::from(start / N) / 2.0, f64::from(start % N) / 2.0);
        for _ in 0..30 {
            const STEP: f64 = 1e-5;
            let Some(([x, y], s)) = seen(u, v) else { break };
            let (Some(([ux, uy], _)), Some(([vx, vy], _))) = (seen(u + STEP, v), seen(u, v + STEP))
            else {
                break;
            };
            let [ux, uy, vx, vy] = [ux - x, uy - y, vx - x, vy - y].map(|change| change / STEP);
            let determinant = ux * vy - uy * vx;
            let (du, dv) = ((x * vy - y * vx) / determinant, (y * ux - x * uy) / determinant);
            (u, v) = (u - du, v - dv);
            let is_outside = !(u.abs() < 5.0 && v.abs() < 5.0);
            if is_outside {
                break;
            }
            if du.abs() + dv.abs() < 1e-8 {
                let least = u.min(v).min(1.0 - u - v);
                if found.iter().all(|&(other, _)| (other - s).abs() > 1e-7) {
                    found.push((s, least));
                }
                break;
            }
        }
    }
    found
}

fn all_hits(scenery: &Scenery, ray: &PastRay) -> Vec<Intersection> {
    let mut all = Vec::new();
    let flow = scenery.world.visit(scenery.faces(), ray, 0.0..f64::INFINITY, |found| {
        all.push(found);
        ControlFlow::Continue(())
    });
    assert!(flow.is_continue());
    all.sort_by(|a, b| a.s.total_cmp(&b.s));
    all
}

fn closest(scenery: &Scenery, ray: &PastRay) -> Option<Intersection> {
    scenery.world.closest(scenery.faces(), ray, 0.0..f64::INFINITY)
}

#[test]
fn hits_are_those_of_emission_events() {
    let mut random = Random(41);
    let (mut n_hits, mut n_rays) = (0, 0);
    for kind in 0..40 {
        let (text, triangles) = world(&mut random, kind, 4);
        let scenery = Scenery::new(&text, random.between(-3.0, 3.0), 1.0);
        let body = scenery.scene.faces[0].body;
        let line = scenery.appearance.surface.frames().world_line(body).unwrap().clone();
        for idx in 0..60 {
            // Towards a point of the body, from the eye or another event.
            let origin = match idx % 2 {
                0 => Event { t: 0.0, x: DVec3::ZERO },
                _ => Event { t: random.between(-5.0, 5.0), x: random.in_ball(5.0) },
            };
            let [a, b, c] = *random.pick(&triangles);
            let target =
                a + random.between(-0.2, 0.8) * (b - a) + random.between(-0.2, 0.8) * (c - a);
            let Ok(seen) = line.emission(target, origin) else { continue };
            let direction = seen.event.x - origin.x;
            let step = Event { t: -direction.length(), x: direction };
            let ray = ray(origin, step, if idx % 2 == 0 { Start::Eye } else { Start::Event });
            let found = all_hits(&scenery, &ray);
            for (row, &corners) in triangles.iter().enumerate() {
                let expected = oracle(&line, corners, origin, direction);
                let own: Vec<&Intersection> =
                    found.iter().filter(|found| found.triangle.face as usize == row).collect();
                for &(s, _) in expected.iter().filter(|(_, least)| *least > 1e-6) {
                    assert!(
                        own.iter().any(|found| (found.s - s).abs() < 1e-8),
                        "{text}\n{ray:?} {s} {own:?}"
                    );
                    n_hits += 1;
                }
                for found in own {
                    let is_known = expected
                        .iter()
                        .any(|&(s, least)| (found.s - s).abs() < 1e-7 && least > -1e-6);
                    assert!(is_known, "{text}\n{ray:?} {found:?} {expected:?}");
                }
            }
            let first = closest(&scenery, &ray);
            assert_eq!(
                first.map(|first| first.s.to_bits()),
                found.first().map(|first| first.s.to_bits())
            );
            if let (Some(first), 0) = (first, idx % 2) {
                let Scenery { scene, appearance, world, .. } = &scenery;
                let (face_colors, textures) =
                    (&appearance.all_face_colors(scene), &Textures::default());
                let surfaces = Surfaces { scene, world, appearance, face_colors, textures };
                let seen =
                    SurfacePoint::new(&surfaces, &PastRay::from_eye(direction), &first, || None);
                let light = line.emission(seen.place, origin).unwrap();
                let beta = seen.frame(&scenery.world).velocity().beta();
                assert!(
                    (first.own_time - light.own_time).abs() < 1e-8,
                    "{text}\n{first:?} {light:?}"
                );
                assert!(
                    (light.event.x - first.s * direction).length() < 1e-8,
                    "{text}\n{first:?} {light:?}"
                );
                assert!((beta - light.velocity.beta()).length() < 1e-8, "{text}\n{beta} {light:?}");
                let ratio = seen.doppler() / ugphysics::doppler_at(light.event.x, light.velocity);
                assert!((ratio - 1.0).abs() < 1e-8, "{text}\n{ratio}");
            }
            n_rays += 1;
        }
    }
    assert!(n_hits > 1000 && n_rays > 2000, "{n_hits} {n_rays}");
}

/// Rays cross the surface of a closed body an even number of times, from inside an odd number, and
/// none gets through without a hit.
#[test]
fn closed_bodies_do_not_leak() {
    let mut random = Random(42);
    let (mut n_met, mut n_inside) = (0, 0);
    for kind in 0..12 {
        let motion = motion(&mut random, kind);
        let text =
            format!("l 1; motion m {motion}; sphere 0 0 0 1 <m>; cam -ep 0 0 0.01 -vc 1 0 0;");
        let scenery = Scenery::new(&text, 0.0, 0.038);
        let line =
            scenery.appearance.surface.frames().world_line(scenery.scene.faces[0].body).unwrap();
        let is_inside = |event: Event| {
            // Where no point of a turning body can be, there is none of the ball.
            let Ok((at, _)) = line.at_event(event) else { return Some(false) };
            let point = at + scenery.eye;
            // The faces of the ball are inside the sphere.
            if point.length() < 0.95 { Some(true) } else { (point.length() > 1.0).then_some(false) }
        };
        for idx in 0..2500 {
            let origin = Event { t: random.between(-9.0, 9.0), x: random.in_ball(6.0) };
            let Some(starts_inside) = is_inside(origin) else { continue };
            let direction = match idx % 3 {
                0 => random.direction(),
                // Through a corner or the middle of an edge.
                at => {
                    let face = random.pick(&scenery.scene.faces);
                    let corners = scenery.scene.contours.corners(face.contours.clone());
                    let [a, b] = [0, 1].map(|at| scenery.scene.rest[corners[at].index()]);
                    let target = if at == 1 { a } else { 0.5 * (a + b) };
                    line.emission(target, origin).unwrap().event.x - origin.x
                }
            };
            let step = Event { t: -direction.length(), x: direction };
            let hits = all_hits(&scenery, &ray(origin, step, Start::Event));
            assert_eq!(
                hits.len() % 2 == 1,
                starts_inside,
                "{kind} {origin:?} {direction} {hits:?}"
            );
            n_inside += usize::from(starts_inside);
            n_met += usize::from(!hits.is_empty());
        }
    }
    assert!(n_met > 8000 && n_inside > 20, "{n_met} {n_inside}");
}

/// Rays to the eye, for which triangles are searched where they are seen, hit what a search along
/// the curve hits that the ray is in the coordinates of the body, and do not leak.
#[test]
fn rays_to_the_eye_hit_what_curves_hit() {
    let mut random = Random(43);
    let (mut n_met, mut n_seen) = (0, 0);
    for kind in 0..24 {
        let DVec3 { x, y, z } = random.between(1.5, 6.0) * random.direction();
        let motion = motion(&mut random, kind);
        let camera = format!("cam -ep {x} {y} {z} -vc 0 0 0 -ud 0.123 0.4 1;");
        let text = format!("l 1; motion m {motion}; sphere 0 0 0 1 <m>; {camera}");
        let scenery =
            Scenery::new(&text, random.between(-3.0, 3.0), *random.pick(&[0.067, 6e-3, 7e-4]));
        let line =
            scenery.appearance.surface.frames().world_line(scenery.scene.faces[0].body).unwrap();
        n_seen += u32::from(
            scenery.world.parts[0].motion.as_ref().is_some_and(|motion| motion.seen.is_some()),
        );
        let eye = Event { t: 0.0, x: DVec3::ZERO };
        for idx in 0..400 {
            let face = random.pick(&scenery.scene.faces);
            let corners = scenery.scene.contours.corners(face.contours.clone());
            let [a, b, c] = [0, 1, 2].map(|at| scenery.scene.rest[corners[at].index()]);
            let target = match idx % 4 {
                0 => a,
                1 => 0.5 * (a + b),
                2 => a + random.unit() * (b - a),
                _ => (a + b + c) / 3.0 + random.in_ball(0.1),
            };
            let direction = line.emission(target, eye).unwrap().event.x;
            let step = Event { t: -direction.length(), x: direction };
            let [seen, curved] =
                [Start::Eye, Start::Event].map(|start| all_hits(&scenery, &ray(eye, step, start)));
            assert!(seen.len().is_multiple_of(2), "{kind}: {direction} {seen:?}");
            n_met += usize::from(!seen.is_empty());
            // Through an edge, either of its triangles may be hit, or none of the silhouette.
            if idx % 4 < 3 {
                continue;
            }
            let faces = |hits: &[Intersection]| {
                hits.iter().map(|hit| hit.triangle.face).collect::<Vec<_>>()
            };
            assert_eq!(faces(&seen), faces(&curved), "{kind}: {direction} {seen:?} {curved:?}");
            assert!(seen.iter().zip(&curved).all(|(a, b)| (a.s - b.s).abs() < 1e-9));
            let first = closest(&scenery, &ray(eye, step, Start::Eye));
            assert_eq!(
                first.map(|first| first.s.to_bits()),
                seen.first().map(|first| first.s.to_bits())
            );
        }
    }
    assert!(n_met > 5000 && n_seen > 8, "{n_met} {n_seen}");
}
