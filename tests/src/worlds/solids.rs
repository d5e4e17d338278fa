//! A solid that does not change light is not seen; glass delays and bends.

use glam::{DMat3, DVec3};
use ugphysics::Brightness;
use ugtesting::Random;

use super::Outcome;
use super::compare::{check, check_same, is_same};
use super::generate::{self, Lamps, Recipe, Surfaces, rotation, velocity, world};
use super::picture::{Picture, SPECTRA, UNSHIFTED, by_law};
use super::spacetime::{Event, rest_place};
use super::world::{Body, Camera, Surface, World};

/// Distances that do not matter, between bodies of size 1.
const SMALL: f64 = 1e-5;

/// Surfaces that a path may meet in nested solids.
const DEPTH: u32 = 200;

/// The part of a pixel from which they are followed.
const CUTOFF: f64 = 0.01;

/// From the eye to a plate before it.
const NEAR: f64 = 0.01;

const WHITE: [f64; 4] = [1.0, 1.0, 1.0, 0.0];

/// A solid that transmits everything.
fn clear(index: f64, absorption: f64) -> Surface {
    Surface::Reflecting([0.0, 0.0, 1.0, index, 1.0, absorption])
}

/// A convex body around an event.
fn solid(random: &mut Random, event: Event, size: f64, velocity: Option<DVec3>) -> Body {
    let mut body = loop {
        let body = generate::shape(random);
        if body.faces.len() > 1 {
            break body;
        }
    };
    let (at, turn) = (rest_place(event, velocity.unwrap_or_default()), rotation(random));
    body.vertices.iter_mut().for_each(|place| *place = at + size * (turn * *place));
    Body { paint: WHITE, velocity, ..body }
}

fn picture(random: &mut Random, world: &World) -> Picture {
    let mut picture =
        Picture::new(world, *random.pick(&[SPECTRA, UNSHIFTED, by_law(Brightness::Report)]));
    picture.rays.fresnel = random.one_in(3);
    picture
}

/// An event that the camera sees, or the event of the picture itself.
fn some_event(random: &mut Random, camera: &Camera, inside: bool) -> Event {
    if inside {
        camera.event
    } else {
        generate::seen_event(
            camera,
            random.between(2.0, 8.0) * camera.forward + random.in_cube(1.5),
        )
    }
}

/// A solid of index 1, at rest and in motion, also around the eye.
pub fn vacuum(random: &mut Random) -> Outcome {
    let world =
        world(random, Recipe { fastest: 0.9, lamps: Lamps::All, surfaces: Surfaces::Mirrors });
    let picture = picture(random, &world);
    let mut more = world.clone();
    for _ in 0..1 + random.below(2) {
        let inside = random.one_in(3);
        let event = some_event(random, &world.camera, inside);
        let (size, velocity) = (random.between(0.5, 3.0), velocity(random, 0.9));
        more.bodies.push(Body { surface: clear(1.0, 0.0), ..solid(random, event, size, velocity) });
    }
    check_same(&picture.draw()?, &Picture { text: more.text(), ..picture }.draw()?)
}

/// Solids of the same index inside a solid, up to ten, with another index innermost.
pub fn nested(random: &mut Random) -> Outcome {
    let recipe = Recipe { fastest: 0.9, lamps: Lamps::All, surfaces: Surfaces::Matt };
    let mut world = world(random, recipe);
    let inside = random.one_in(3);
    let event = some_event(random, &world.camera, inside);
    let (velocity, size) = (velocity(random, 0.9), random.between(1.0, 2.0));
    let (index, absorption) = (random.between(1.1, 1.8), if random.one_in(2) { 0.0 } else { 0.2 });
    let outer = solid(random, event, size, velocity);
    let scaled = |part: f64, surface: Surface| {
        let middle = rest_place(event, velocity.unwrap_or_default());
        let mut body = Body { surface, ..outer.clone() };
        body.vertices.iter_mut().for_each(|place| *place = middle + part * (*place - middle));
        body
    };
    // Without highlights: light that is caught by total reflection would have one at every face, up
    // to the most reflections of a path.
    world.bodies.push(scaled(1.0, clear(index, absorption)));
    if random.one_in(2) {
        world.bodies.push(scaled(0.2, clear(random.between(1.0, 2.0), 0.0)));
    }
    let mut picture = picture(random, &world);
    // Most light that is mirrored within is too faint to follow.
    (picture.rays.depth, picture.rays.cutoff) = (DEPTH, CUTOFF);
    let mut more = world.clone();
    let n_more = 1 + if random.one_in(2) { 0 } else { random.below(10) };
    for row in 0..n_more {
        more.bodies.push(scaled(0.3 + 0.6 * row as f64 / n_more as f64, clear(index, absorption)));
    }
    // Light that total reflection catches, or that grows faint, ends elsewhere where it meets more
    // surfaces: only pixels are compared whose light all comes by few surfaces, each way between
    // two of which crosses each added solid at most twice, and not nearly as faint as the cutoff.
    let (one, other) = (picture.draw()?, Picture { text: more.text(), ..picture.clone() }.draw()?);
    (picture.rays.depth, picture.rays.cutoff) = (DEPTH / (2 * n_more as u32 + 1), 5.0 * CUTOFF);
    let short = picture.draw()?;
    let lights = one.light().into_iter().zip(other.light()).zip(short.light());
    let pairs: Vec<_> =
        lights.filter(|(pair, short)| pair.0 == *short).map(|(pair, _)| pair).collect();
    check(&pairs, [&one, &other])
}

/// The wall, bodies and lamps of a world with a camera that has some room around it.
fn spacious(random: &mut Random) -> World {
    let recipe = Recipe { fastest: 0.9, lamps: Lamps::Stated, surfaces: Surfaces::Matt };
    world(random, recipe)
}

/// A box at rest with the camera, between two distances along the view, outside faces outward.
fn slab(camera: &Camera, [near, far]: [f64; 2], half: f64, inward: bool) -> Body {
    let mut body = generate::cube();
    let axes = DMat3::from_cols(camera.right(), camera.up, -camera.forward);
    let at = rest_place(camera.event, camera.velocity);
    for place in &mut body.vertices {
        let unit = *place / 0.6;
        let along = 0.5 * (near + far) - unit.z * 0.5 * (far - near);
        *place = at + axes * DVec3::new(half * unit.x, half * unit.y, 0.0) + along * camera.forward;
    }
    if inward {
        body.faces.iter_mut().for_each(|face| face.reverse());
    }
    let velocity = (camera.velocity != DVec3::ZERO).then_some(camera.velocity);
    Body { paint: WHITE, velocity, ..body }
}

/// A single pixel of two worlds.
fn check_pixel(picture: &Picture, one: &World, other: &World) -> Outcome {
    let drawn = |world: &World| {
        Picture { text: world.text(), motion: world.motion(), ..picture.clone() }.of_pixel().draw()
    };
    let (one, other) = (drawn(one)?, drawn(other)?);
    if is_same(one.light()[0], other.light()[0]) {
        return Ok(usize::from(one.light()[0] != [0.0; 3]));
    }
    let [a, b] = [&one, &other].map(|drawn| drawn.picture.described());
    Err(format!("{:?}, {:?}\n{a}\n{b}", one.light()[0], other.light()[0]))
}

/// Seen straight through, a plate of index n and thickness s shows what was there (n − 1) s
/// earlier, in its rest frame, if nothing is in the plate.
pub fn delay(random: &mut Random) -> Outcome {
    let mut world = spacious(random);
    let camera = world.camera.looking(direction(random, &world.camera));
    world.camera = camera;
    let (index, thickness) = (random.between(1.05, 2.0), random.between(0.3, 1.0));
    let entered = camera.displaced(NEAR * camera.forward, -NEAR).event;
    let left =
        camera.displaced((NEAR + thickness) * camera.forward, -(NEAR + index * thickness)).event;
    if world.bodies.iter().any(|body| body.is_crossed([entered, left])) {
        return Ok(0);
    }
    let mut behind = world.clone();
    // Small, so that hardly any light of lamps goes through it.
    let plate = slab(&camera, [NEAR, NEAR + thickness], 0.01, false);
    behind.bodies.push(Body { surface: clear(index, 0.0), ..plate });
    let mut earlier = world.clone();
    earlier.camera = camera.displaced(DVec3::ZERO, -(index - 1.0) * thickness);
    let mut picture = picture(random, &world);
    picture.rays.fresnel = false;
    check_pixel(&picture, &behind, &earlier)
}

/// An eye in glass sees what an eye in a small hollow sees, perpendicular to its side.
pub fn hollow(random: &mut Random) -> Outcome {
    let mut world = spacious(random);
    let camera = world.camera.looking(direction(random, &world.camera));
    world.camera = camera;
    let surface = clear(random.between(1.05, 1.6), 0.0);
    let velocity = (camera.velocity != DVec3::ZERO).then_some(camera.velocity);
    let glass =
        Body { surface, ..solid(random, camera.event, random.clone().between(0.3, 1.0), velocity) };
    if glass.round.is_some() {
        return Ok(0);
    }
    world.bodies.push(glass);
    let mut hollowed = world.clone();
    let row = hollowed.bodies.len() - 1;
    let hollow = slab(&camera, [-SMALL, SMALL], SMALL, true);
    let solid = &mut hollowed.bodies[row];
    // One surface inside and outside.
    let first = solid.vertices.len();
    solid.vertices.extend(hollow.vertices);
    solid
        .faces
        .extend(hollow.faces.iter().map(|face| face.iter().map(|corner| first + corner).collect()));
    let mut picture = picture(random, &world);
    picture.rays.fresnel = false;
    check_pixel(&picture, &world, &hollowed)
}

/// An eye just under the surface of glass sees what an eye just above it sees, where Snell's law
/// says.
pub fn under_water(random: &mut Random) -> Outcome {
    let mut world = spacious(random);
    let camera = world.camera;
    let index = random.between(1.05, 1.8);
    let outside = direction(random, &camera).normalize();
    // The surface is perpendicular to the view, and the eye just behind it.
    let across = outside - outside.dot(camera.forward) * camera.forward;
    let inside = across / index
        + (1.0 - across.length_squared() / (index * index)).max(0.0).sqrt() * camera.forward;
    let mut under = world.clone();
    under
        .bodies
        .push(Body { surface: clear(index, 0.0), ..slab(&camera, [-1.0, SMALL], 1.0, false) });
    under.camera = camera.looking(inside);
    world.camera = camera.looking(outside);
    let mut picture = picture(random, &world);
    picture.rays.fresnel = false;
    check_pixel(&picture, &under, &world)
}

/// A direction within the view.
fn direction(random: &mut Random, camera: &Camera) -> DVec3 {
    let half = libm::tan(0.5 * camera.angle.to_radians());
    camera.forward
        + random.between(-half, half) * camera.right()
        + 0.75 * random.between(-half, half) * camera.up
}
