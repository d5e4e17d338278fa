//! The bound of `-se`, for motions that the criterion was not made with.

use glam::DVec3;
use ugscene::Scene;
use ugtesting::Random;
use ugtests::world_lines::{Body, Observer, Path, Statement, Stretch, Triangle};

use super::{World, observer, options};

/// Largest errors of drawn edges and triangles, as multiples of their bounds.
#[derive(Clone, Copy, Debug, Default)]
struct Errors {
    /// Angle between the image of an edge and the line that is drawn.
    angle: f64,
    /// Distance of an edge from the line that is drawn.
    depth: f64,
    /// Distance of the inside of a triangle from the plane that is drawn.
    inside: f64,
    n_edges: usize,
}

impl Errors {
    fn with(self, other: Self) -> Self {
        Self {
            angle: self.angle.max(other.angle),
            depth: self.depth.max(other.depth),
            inside: self.inside.max(other.inside),
            n_edges: self.n_edges + other.n_edges,
        }
    }
}

/// Bodies that spin near the speed of light, with changes of acceleration and spin within the
/// picture, and fast orbits.
fn fast(random: &mut Random, middle: DVec3) -> Statement {
    let mut motion = Statement::random(random, middle, 0.95);
    let always = |of: DVec3| Stretch { of, from: f64::NEG_INFINITY, to: f64::INFINITY };
    // Short pieces of any direction, one after the other.
    let pieces = |random: &mut Random, most: f64| {
        let mut from = -9.0;
        let pieces = std::iter::from_fn(|| {
            let to = from + random.between(0.2, 1.2);
            let piece = Stretch { of: random.direction() * random.between(0.3, most), from, to };
            from = to;
            (from < 3.0).then_some(piece)
        });
        pieces.collect::<Vec<_>>()
    };
    let free = |velocity| Path::Free { velocity, accelerations: Vec::new() };
    match random.below(4) {
        // The rim of radius 1.
        0 => {
            motion.at = middle;
            motion.path = free(random.in_ball(0.9));
            motion.spins = vec![always(random.direction() * random.between(0.8, 0.97))];
        }
        // A jerk when the light leaves.
        1 => {
            motion.at = middle;
            motion.path = Path::Free { velocity: DVec3::ZERO, accelerations: pieces(random, 0.8) };
            motion.spins.clear();
        }
        // Spin that reverses.
        2 => {
            motion.at = middle;
            motion.spins = pieces(random, 0.9);
            motion.path = free(random.in_ball(0.8));
        }
        _ => {}
    }
    motion
}

/// Where a vertex of the scene as seen is on its body.
fn rest(observer: &Observer, body: &Body, seen: DVec3) -> Option<DVec3> {
    let event = observer.past(seen);
    // Newton's method may lead beyond a horizon.
    [-3.0, -6.0, -10.0, 0.0, -15.0, -22.0]
        .into_iter()
        .find_map(|guess| body.at_event(event, guess))
        .map(|(_, point)| point)
}

/// The corners of each piece, seen and on its body.
fn pieces(
    scene: &Scene,
    triangles: &[Triangle],
    bodies: &[Body],
    eye: DVec3,
    observer: &Observer,
) -> Vec<(usize, [[DVec3; 2]; 3])> {
    let mut pieces = Vec::new();
    for face in &scene.faces {
        let name = scene.names.get(face.name.unwrap());
        let triangle: usize = name.trim_start_matches('t').parse().unwrap();
        let body = triangles[triangle].body;
        let corners: Vec<DVec3> = scene
            .face_contours(face)
            .flatten()
            .map(|corner| scene.vertices[corner.index()].position - eye)
            .collect();
        let [a, b, c] = corners[..] else { panic!("{name} has {} corners", corners.len()) };
        let points = [a, b, c].map(|p| rest(observer, &bodies[body], p).map(|rest| [p, rest]));
        if let [Some(a), Some(b), Some(c)] = points {
            pieces.push((body, [a, b, c]));
        }
    }
    pieces
}

/// Samples of an edge, and of the inside of a triangle.
const N: u32 = 16;

fn errors_of(
    pieces: &[(usize, [[DVec3; 2]; 3])],
    bodies: &[Body],
    observer: &Observer,
    bound: f64,
) -> Errors {
    let offset_bound = bound.max(1e-4);
    let mut errors = Errors::default();
    for &(body, corners) in pieces {
        let see = |rest: DVec3| observer.sight(&bodies[body], rest).seen;
        for k in 0..3 {
            let ([a, rest_a], [b, rest_b]) = (corners[k], corners[(k + 1) % 3]);
            errors.n_edges += 1;
            for s in 1..N {
                let place = see(rest_a.lerp(rest_b, f64::from(s) / f64::from(N)));
                // The nearest direction and the nearest point of the segment.
                let plane = a.cross(b).normalize();
                let flat = place - place.dot(plane) * plane;
                let is_between = a.cross(flat).dot(plane) >= 0.0 && flat.cross(b).dot(plane) >= 0.0;
                let angle = match is_between {
                    true => place.angle_between(flat),
                    false => place.angle_between(a).min(place.angle_between(b)),
                };
                let part = ((place - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
                let depth = (place - a.lerp(b, part)).length() / place.length();
                errors.angle = errors.angle.max(angle / bound);
                errors.depth = errors.depth.max(depth / offset_bound);
            }
        }
        let [[a, rest_a], [b, rest_b], [c, rest_c]] = corners;
        let normal = (b - a).cross(c - a).normalize_or_zero();
        for (s, t) in [(1, 1), (2, 2), (1, 4), (4, 1), (1, 2), (2, 1), (3, 2)] {
            let (s, t) = (f64::from(s) / 6.0, f64::from(t) / 6.0);
            let place = see((1.0 - s - t) * rest_a + s * rest_b + t * rest_c);
            errors.inside =
                errors.inside.max(normal.dot(place - a).abs() / place.length() / offset_bound);
        }
    }
    errors
}

/// The criterion samples edges, so its bound is no proof.
#[test]
fn errors_of_edges_are_within_the_bound() {
    let mut random = Random(13);
    let mut all = Errors::default();
    let mut n_beyond = 0;
    for case in 0..24 {
        let mut world = World::default();
        let middle = random.in_ball(1.0);
        let motion = fast(&mut random, middle);
        world.add(&mut random, motion, middle, 2);
        let eye = random.between(1.5, 4.0) * random.direction();
        let bound = [1e-2, 1e-3, 3e-4][case % 3];
        let config = uglorentz::Config {
            pieces: uglorentz::Pieces::UpTo(bound),
            color_error: f64::INFINITY,
            camera_velocity: Some(random.in_ball(0.5)),
            ..options(eye, random.between(-1.0, 2.0))
        };
        let scene = ugtests::pipe::lorentz_scene(world.text().as_bytes(), &config);
        let Ok((scene, _)) = scene else { continue };
        let observer = observer(eye, config.camera_velocity.unwrap(), config.time);
        let bodies = world.bodies();
        let pieces = pieces(&scene, &world.triangles, &bodies, eye, &observer);
        assert!(pieces.len() >= scene.faces.len() * 9 / 10);
        // Of many pieces, some.
        let some: Vec<_> = pieces.iter().copied().step_by(pieces.len().div_ceil(25)).collect();
        let errors = errors_of(&some, &bodies, &observer, bound);
        if errors.angle > 1.0 || errors.depth > 1.0 || errors.inside > 1.0 {
            let motion = world.motions[0].text("m0");
            println!("{case} {bound}: {errors:?} of {} pieces\n{motion}", pieces.len());
            n_beyond += 1;
        }
        all = all.with(errors);
    }
    println!("{all:?}, {n_beyond} beyond");
    assert!(all.n_edges > 1000 && all.angle > 0.3, "{all:?}");
    assert!(all.angle <= 1.0 && all.depth <= 1.0 && all.inside <= 1.0, "{all:?}");
}

/// Where a spin begins or reverses, D changes abruptly, and linear interpolation between vertices
/// is wrong. It may be so only along edges whose angle at the eye is at most four times the bound.
#[test]
fn doppler_factors_are_wrong_on_short_edges_only() {
    let (bound, color_error) = (2e-3, 0.04);
    let mut random = Random(29);
    let mut longest = 0.0_f64;
    for _ in 0..16 {
        let mut world = World::default();
        let middle = random.in_ball(1.0);
        let motion = fast(&mut random, middle);
        world.add(&mut random, motion, middle, 2);
        let eye = random.between(2.0, 4.0) * random.direction();
        let config = uglorentz::Config {
            pieces: uglorentz::Pieces::UpTo(bound),
            color_error,
            ..options(eye, random.between(-1.0, 2.0))
        };
        let scene = ugtests::pipe::lorentz_scene(world.text().as_bytes(), &config);
        let Ok((scene, _)) = scene else { continue };
        let observer = observer(eye, DVec3::ZERO, config.time);
        let bodies = world.bodies();
        let pieces = pieces(&scene, &world.triangles, &bodies, eye, &observer);
        for &(body, corners) in pieces.iter().step_by(pieces.len().div_ceil(200)) {
            let doppler = |rest: DVec3| observer.sight(&bodies[body], rest).doppler;
            for k in 0..3 {
                let ([a, rest_a], [b, rest_b]) = (corners[k], corners[(k + 1) % 3]);
                let ends = [rest_a, rest_b].map(doppler);
                let is_off = (1..N).any(|s| {
                    let rest = rest_a.lerp(rest_b, f64::from(s) / f64::from(N));
                    let place = observer.sight(&bodies[body], rest);
                    let part = (place.seen - a).dot(b - a) / (b - a).length_squared();
                    let drawn = ends[0] + part.clamp(0.0, 1.0) * (ends[1] - ends[0]);
                    (drawn / place.doppler - 1.0).abs() > color_error
                });
                if is_off {
                    longest = longest.max(a.angle_between(b) / bound);
                }
            }
        }
    }
    println!("{longest} times the bound");
    assert!((1.0..=4.0).contains(&longest), "{longest}");
}
