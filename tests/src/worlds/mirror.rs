//! A mirror at rest is an eye behind it, whose picture is reversed; a mirror in motion is an eye in
//! motion.

use glam::{DMat3, DVec3};
use ugphoton::Channel;
use ugtesting::Random;

use super::Outcome;
use super::accelerated::{accelerate_any, accelerate_any_lamp};
use super::compare::{check, n_lit, reversed};
use super::generate::{self, Recipe, Surfaces, afar, camera, change};
use super::picture::{Picture, SPECTRA, UNSHIFTED, by_law};
use super::spacetime::{aberrated, boost};
use super::world::{Beam, Body, Camera, Lamp, LampPlace, Surface, World};
use crate::world_lines::{self, Statement};

/// The plane of the mirror, in the frame in which it rests: x·normal = −height.
struct Plane {
    normal: DVec3,
    height: f64,
}

impl Plane {
    fn reflection(&self) -> DMat3 {
        let n = self.normal;
        DMat3::from_cols(
            DVec3::X - 2.0 * n.x * n,
            DVec3::Y - 2.0 * n.y * n,
            DVec3::Z - 2.0 * n.z * n,
        )
    }

    /// A camera behind the mirror, whose picture is reversed.
    fn behind(&self, camera: &Camera) -> Camera {
        let turn = self.reflection();
        let place = camera.event.truncate();
        let place = place - 2.0 * (place.dot(self.normal) + self.height) * self.normal;
        Camera {
            event: place.extend(camera.event.w),
            velocity: turn * camera.velocity,
            forward: turn * camera.forward,
            up: turn * camera.up,
            angle: camera.angle,
        }
    }

    /// How far in front of the mirror a place is.
    fn distance(&self, place: DVec3) -> f64 {
        place.dot(self.normal) + self.height
    }

    /// A velocity that does not lead away from the mirror, so that what is in front of it always
    /// was.
    fn toward(&self, velocity: DVec3) -> DVec3 {
        velocity - (2.0 * velocity.dot(self.normal).max(0.0)) * self.normal
    }

    /// The mirror: an ideal one, without highlights.
    fn body(&self) -> Body {
        let across = self.normal.any_orthonormal_vector();
        let turn = DMat3::from_cols(across, self.normal.cross(across), self.normal);
        let mut body = generate::square();
        body.vertices
            .iter_mut()
            .for_each(|place| *place = turn * (200.0 * *place) - self.height * self.normal);
        body.surface = Surface::Reflecting([0.0, 1.0, 0.0, 1.0, 1e15, 0.0]);
        body
    }
}

/// Bodies and lamps of all motions. A lamp with a velocity may belong to another frame than what it
/// lights.
pub fn mirror(random: &mut Random) -> Outcome {
    check_mirror(random, inertial(generate::Lamps::All), false)
}

/// As [`mirror`], with lamps that have a velocity.
pub fn mirror_with_moving_lamps(random: &mut Random) -> Outcome {
    check_mirror(random, inertial(generate::Lamps::Stated), false)
}

fn inertial(lamps: generate::Lamps) -> Recipe {
    Recipe { fastest: 0.9, lamps, surfaces: Surfaces::Mirrors }
}

/// As [`mirror_with_moving_lamps`], with bodies and lamps that accelerate, spin and run on orbits.
pub fn accelerated_mirror(random: &mut Random) -> Outcome {
    let recipe =
        Recipe { fastest: 0.7, lamps: generate::Lamps::Stated, surfaces: Surfaces::Mirrors };
    check_mirror(random, recipe, true)
}

fn check_mirror(random: &mut Random, recipe: Recipe, accelerates: bool) -> Outcome {
    let camera = camera(random);
    let plane =
        Plane { normal: (random.direction() - 1.5 * camera.forward).normalize(), height: 0.0 };
    let height = random.between(1.0, 3.0) - camera.event.truncate().dot(plane.normal);
    let plane = Plane { height, ..plane };
    let behind = plane.behind(&camera);
    let (bodies, lamps) = world_before(random, &plane, &behind, recipe, accelerates);
    if bodies.is_empty() {
        return Ok(0);
    }
    let mut world = World { bodies, lamps, camera: behind, anchor: DVec3::ZERO, sky: None };
    let id = world.bodies.iter().map(Body::n_faces).sum::<u32>() + 1;
    let mut mirrored = World { camera, ..world.clone() };
    mirrored.bodies.push(plane.body());
    // Lamps that rest with what they light are the same in one frame only.
    if recipe.lamps == generate::Lamps::Stated && !accelerates && random.one_in(2) {
        let change = change(random, 0.7);
        (world, mirrored) = (world.changed(&change), mirrored.changed(&change));
    }
    let shift = *random.pick(&[SPECTRA, UNSHIFTED, by_law(ugphysics::Brightness::Report)]);
    // What the bodies mirror is not followed: the mirror itself would be seen in them.
    let mut seen = Picture { channels: vec![Channel::Id], ..Picture::new(&mirrored, shift) };
    seen.rays.depth = 1;
    let mut direct = Picture::new(&world, shift);
    direct.rays.depth = 0;
    let (seen, direct) = (seen.draw()?, direct.draw()?);
    let pairs = seen.light().into_iter().zip(reversed(&direct)).zip(seen.ids());
    let pairs: Vec<_> = pairs.filter(|(_, seen)| **seen == id).map(|(pair, _)| pair).collect();
    if pairs.is_empty() {
        return Ok(0);
    }
    check(&pairs, [&seen, &direct])?;
    Ok(n_lit(&pairs))
}

/// Bodies and lamps before the mirror, now and in the past.
fn world_before(
    random: &mut Random,
    plane: &Plane,
    behind: &Camera,
    recipe: Recipe,
    accelerates: bool,
) -> (Vec<Body>, Vec<Lamp>) {
    let (mut bodies, mut lamps) = (Vec::new(), Vec::new());
    let n_bodies = 2 + random.below(3);
    for _ in 0..100 {
        if bodies.len() < n_bodies {
            let body = body_before(random, plane, behind, recipe);
            bodies.extend(if accelerates && random.one_in(2) {
                body.and_then(|body| accelerated_before(random, plane, behind, body))
            } else {
                body
            });
        }
    }
    let n_lamps = 1 + random.below(2);
    for _ in 0..100 {
        if !bodies.is_empty() && lamps.len() < n_lamps {
            let lamp = lamp_before(random, plane, behind, &bodies, recipe);
            lamps.extend(if accelerates && random.one_in(2) {
                lamp.and_then(|lamp| accelerated_lamp_before(random, plane, behind, lamp))
            } else {
                lamp
            });
        }
    }
    (bodies, lamps)
}

fn body_before(
    random: &mut Random,
    plane: &Plane,
    behind: &Camera,
    recipe: Recipe,
) -> Option<Body> {
    let mut body = generate::body(random, behind, recipe);
    let velocity = plane.toward(body.velocity.unwrap_or_default());
    if body.velocity.is_some() {
        generate::set_velocity(&mut body, behind, Some(velocity));
    }
    // The first face that hides more than half of what is behind it has to be the mirror.
    body.paint[3] = body.paint[3].min(0.4);
    // Edges that are straight at rest are seen bent, so that they can reach through the mirror
    // where their ends do not.
    let is_before = |place: DVec3| {
        let event = generate::on_light_cone(behind, place, velocity);
        plane.distance(event.truncate()) > 0.1
    };
    let between =
        |from: DVec3, to: DVec3| (0..=8).map(move |step| from.lerp(to, f64::from(step) / 8.0));
    let mut pairs =
        body.vertices.iter().flat_map(|&from| body.vertices.iter().map(move |&to| (from, to)));
    pairs.all(|(from, to)| between(from, to).all(is_before)).then_some(body)
}

fn lamp_before(
    random: &mut Random,
    plane: &Plane,
    behind: &Camera,
    bodies: &[Body],
    recipe: Recipe,
) -> Option<Lamp> {
    let mut lamp = generate::lamp(random, behind, bodies, recipe);
    let velocity = lamp.velocity.map(|velocity| plane.toward(velocity));
    lamp.velocity = velocity;
    let velocities: Vec<DVec3> = match velocity {
        Some(velocity) => vec![velocity],
        None => bodies.iter().map(|body| body.velocity.unwrap_or_default()).collect(),
    };
    let is_before = match &mut lamp.place {
        LampPlace::Ambient => true,
        LampPlace::Afar(toward) => {
            if let Some(velocity) = velocity {
                *toward = afar(*toward, velocity);
            }
            velocities
                .iter()
                .all(|velocity| aberrated(*toward, -*velocity).normalize().dot(plane.normal) > 0.1)
        }
        // Where it is last: at the time of the picture.
        LampPlace::At(place) => velocities.iter().all(|&velocity| {
            let event = boost(velocity) * place.extend(0.0);
            let last = event.truncate() + velocity * (behind.event.w - event.w);
            plane.distance(last) > 0.1 + lamp.beam.map_or(0.0, Beam::reach)
        }),
    };
    is_before.then_some(lamp)
}

/// A body with a motion that never leads behind the mirror before the picture is taken.
fn accelerated_before(
    random: &mut Random,
    plane: &Plane,
    behind: &Camera,
    mut body: Body,
) -> Option<Body> {
    accelerate_any(random, &mut body, behind);
    let points: Vec<DVec3> = body.vertices.clone();
    is_always_before(plane, behind, body.motion.as_ref()?, &points).then_some(body)
}

fn accelerated_lamp_before(
    random: &mut Random,
    plane: &Plane,
    behind: &Camera,
    mut lamp: Lamp,
) -> Option<Lamp> {
    // Lamps that rest with what they light, and those without a place, have no motion.
    let (LampPlace::At(_), Some(_)) = (lamp.place, lamp.velocity) else { return Some(lamp) };
    accelerate_any_lamp(random, &mut lamp);
    let LampPlace::At(place) = lamp.place else { return None };
    is_always_before(plane, behind, lamp.motion.as_ref()?, &[place]).then_some(lamp)
}

/// True if points of a body are before the mirror at all times up to that of the picture.
fn is_always_before(plane: &Plane, behind: &Camera, motion: &Statement, points: &[DVec3]) -> bool {
    const RANGE: [f64; 2] = [-40.0, 25.0];
    let body = world_lines::Body::new(std::slice::from_ref(motion), 0, RANGE);
    let own_times = (0..600).map(|step| 0.98 * RANGE[0] + 0.1 * f64::from(step));
    own_times.take_while(|own_time| *own_time < 0.98 * RANGE[1]).all(|own_time| {
        points.iter().all(|&point| {
            let [t, x, y, z] = body.moment(point, own_time).event;
            t > behind.event.w || plane.distance(DVec3::new(x, y, z)) > 0.1
        })
    })
}
