//! Laws of worlds in which bodies and lamps accelerate, spin and run on orbits and paths.

use glam::DVec3;
use ugtesting::Random;

use super::Outcome;
use super::compare::check_same;
use super::frames;
use super::generate::{self, Lamps, Recipe, Surfaces, on_light_cone, rotation, world};
use super::picture::{Picture, SPECTRA, UNSHIFTED, by_law};
use super::renderers::check_pipe;
use super::spacetime::{Change, Event, boost};
use super::world::{Body, Camera, Lamp, LampPlace, World};
use crate::world_lines::{
    self, Four, Path, Statement, Stretch, boosted, four_velocity, plus, product,
};

/// Own times that are integrated.
const RANGE: [f64; 2] = [-40.0, 25.0];

/// Which motions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kinds {
    All,
    /// Those that a boost of the world changes into others of their kind.
    Free,
}

/// Rays and the whole pipe, as [`super::renderers::pipe`].
pub fn pipe(random: &mut Random) -> Outcome {
    let world = random_world(random, Lamps::All, Surfaces::Matt, Kinds::All);
    let white = |lamp: &mut Lamp| lamp.paint = None;
    let mut world = world;
    world.lamps.iter_mut().for_each(white);
    check_pipe(random, &world)
}

/// A random world without mirrors.
pub(super) fn matt_world(random: &mut Random) -> World {
    random_world(random, Lamps::Stated, Surfaces::Matt, Kinds::All)
}

/// A boost and a turn of the world.
pub fn boosts(random: &mut Random) -> Outcome {
    let world = random_world(random, Lamps::Stated, Surfaces::Mirrors, Kinds::Free);
    let change = Change { shift: Event::ZERO, ..generate::change(random, 0.8) };
    let moved = world.changed(&change);
    frames::check_both(random, &world, &moved)
}

/// A turn of the world, and another unit of length and time.
pub fn turns(random: &mut Random) -> Outcome {
    let world = random_world(random, Lamps::All, Surfaces::Mirrors, Kinds::All);
    let unit = *random.pick(&[1.0, 1e-6, 1e6]);
    let moved = world.placed(rotation(random), unit, DVec3::ZERO);
    frames::check_both(random, &world, &moved)
}

/// A stretch of acceleration or spin in two parts; motions without any as velocities.
pub fn stretches(random: &mut Random) -> Outcome {
    let world = random_world(random, Lamps::All, Surfaces::Mirrors, Kinds::All);
    let mut other = world.clone();
    for body in &mut other.bodies {
        body.motion = match (body.motion.take(), body.velocity) {
            (Some(motion), _) => Some(in_parts(motion)),
            (None, Some(velocity)) if random.one_in(2) => {
                let mut motion = Statement::inertial(velocity);
                motion.at = random.in_ball(2.0);
                motion.spins.push(Stretch { of: DVec3::ZERO, from: -2.0, to: 3.0 });
                Some(motion)
            }
            (None, _) => None,
        };
    }
    for lamp in &mut other.lamps {
        lamp.motion = lamp.motion.take().map(in_parts);
    }
    let shift = *random.pick(&[SPECTRA, UNSHIFTED, by_law(ugphysics::Brightness::Report)]);
    check_same(&Picture::new(&world, shift).draw()?, &Picture::new(&other, shift).draw()?)
}

fn in_parts(mut motion: Statement) -> Statement {
    let halves = |pieces: &[Stretch]| -> Vec<Stretch> {
        let split = |piece: &Stretch| {
            let middle = 0.3 * piece.from + 0.7 * piece.to;
            let (before, behind) =
                (Stretch { to: middle, ..*piece }, Stretch { from: middle, ..*piece });
            if piece.to.is_finite() { vec![behind, before] } else { vec![*piece] }
        };
        pieces.iter().flat_map(split).collect()
    };
    motion.spins = halves(&motion.spins);
    if let Path::Free { accelerations, .. } = &mut motion.path {
        *accelerations = halves(accelerations);
    }
    motion
}

/// A world with motions for most bodies and lamps.
fn random_world(random: &mut Random, lamps: Lamps, surfaces: Surfaces, kinds: Kinds) -> World {
    let mut world = world(random, Recipe { fastest: 0.7, lamps, surfaces });
    // The last one is the wall: it would reach beyond its horizon.
    let n = world.bodies.len() - 1;
    for body in &mut world.bodies[..n] {
        if !random.one_in(3) {
            accelerate(random, body, &world.camera, kinds);
        }
    }
    for lamp in &mut world.lamps {
        if lamp.velocity.is_some() && !random.one_in(3) {
            accelerate_lamp(random, lamp, kinds);
        }
    }
    world
}

fn motion(random: &mut Random, kinds: Kinds) -> Statement {
    loop {
        let motion = Statement::random(random, DVec3::ZERO, 0.5);
        if kinds == Kinds::All || matches!(motion.path, Path::Free { .. }) {
            return motion;
        }
    }
}

/// Gives a body a motion; it is small enough for it, and its middle stays about where it is seen.
fn accelerate(random: &mut Random, body: &mut Body, camera: &Camera, kinds: Kinds) {
    let middle = body.vertices.iter().sum::<DVec3>() / body.vertices.len() as f64;
    let seen = on_light_cone(camera, middle, body.velocity.unwrap_or_default());
    let size = body.vertices.iter().map(|place| (place - middle).length()).fold(1.0, f64::max);
    let (motion, shift) = through(motion(random, kinds), seen);
    body.vertices.iter_mut().for_each(|place| *place = shift + (*place - middle) / size);
    (body.velocity, body.motion) = (None, Some(motion));
}

/// Gives a lamp with a place a motion; at one time it is where it was.
pub(super) fn accelerate_any_lamp(random: &mut Random, lamp: &mut Lamp) {
    accelerate_lamp(random, lamp, Kinds::All);
}

/// As [`accelerate`], of any kind.
pub(super) fn accelerate_any(random: &mut Random, body: &mut Body, camera: &Camera) {
    accelerate(random, body, camera, Kinds::All);
}

fn accelerate_lamp(random: &mut Random, lamp: &mut Lamp, kinds: Kinds) {
    let LampPlace::At(place) = lamp.place else { return };
    let event = boost(lamp.velocity.unwrap_or_default()) * place.extend(random.between(-12.0, 0.0));
    let (motion, shift) = through(motion(random, kinds), event);
    (lamp.place, lamp.velocity, lamp.motion) = (LampPlace::At(shift), None, Some(motion));
}

/// A motion displaced so that its reference point passes an event, and the displacement of what it
/// moves.
fn through(mut motion: Statement, event: Event) -> (Statement, DVec3) {
    let from = motion.at;
    let event = [event.w, event.x, event.y, event.z];
    if let Path::Free { velocity, .. } = motion.path {
        // X(τ) is the event at own time 0, the boost of (0, `at`), and what does not depend on `at`.
        motion.at = DVec3::ZERO;
        let body = world_lines::Body::new(std::slice::from_ref(&motion), 0, RANGE);
        let way = |own_time: f64| plus(event, -1.0, body.moment(DVec3::ZERO, own_time).event);
        let own_time = root(|own_time| product(way(own_time), four_velocity(velocity)));
        let axes: [Four; 3] = [[0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];
        motion.at =
            DVec3::from_array(axes.map(|axis| product(way(own_time), boosted(velocity, axis))));
        return (motion.clone(), motion.at - from);
    }
    let body = world_lines::Body::new(std::slice::from_ref(&motion), 0, RANGE);
    let own_time = root(|own_time| body.moment(from, own_time).event[0] - event[0]);
    let [_, x, y, z] = plus(event, -1.0, body.moment(from, own_time).event);
    let shift = DVec3::new(x, y, z);
    motion.at += shift;
    match &mut motion.path {
        Path::Orbit { center, .. } => *center += shift,
        Path::Events(rows) => {
            rows.iter_mut().for_each(|[_, x, y, z]| {
                (*x, *y, *z) = (*x + shift.x, *y + shift.y, *z + shift.z);
            });
        }
        Path::Free { .. } | Path::On(_) => unreachable!("handled above, and not generated"),
    }
    (motion, shift)
}

/// The root of an increasing function of own time.
fn root(of: impl Fn(f64) -> f64) -> f64 {
    let [mut from, mut to] = RANGE.map(|end| 0.99 * end);
    for _ in 0..60 {
        let middle = 0.5 * (from + to);
        if of(middle) < 0.0 { from = middle } else { to = middle }
    }
    from
}
