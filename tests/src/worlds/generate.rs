//! Random worlds: what they consist of follows from a seed and a recipe.

use glam::{DMat3, DVec2, DVec3};
use ugtesting::Random;

use super::spacetime::{Change, Event, aberrated, boost, rest_place};
use super::world::{Beam, Body, Camera, Lamp, LampPlace, Surface, World};

/// Surfaces with measured spectra.
pub const MEASURED: [&str; 3] = ["foliage", "metal", "red_paint"];

/// Limits of a random world.
#[derive(Clone, Copy, Debug)]
pub struct Recipe {
    /// The greatest speed of bodies and lamps.
    pub fastest: f64,
    /// Which lamps.
    pub lamps: Lamps,
    /// Which surfaces.
    pub surfaces: Surfaces,
}

/// Which lamps a world has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lamps {
    /// All kinds.
    All,
    /// Lamps with a velocity, and ambient ones.
    Stated,
    /// Lamps that rest with what they light.
    Unstated,
}

/// Which surfaces bodies have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Surfaces {
    /// Matt, glowing and translucent ones.
    Matt,
    /// These, and partly mirroring ones.
    Mirrors,
    /// These, and glass.
    Glass,
}

/// A random world, with two to four bodies that are seen and a wall behind them.
pub fn world(random: &mut Random, recipe: Recipe) -> World {
    let camera = camera(random);
    let mut bodies: Vec<Body> =
        (0..2 + random.below(3)).map(|_| body(random, &camera, recipe)).collect();
    bodies.push(wall(random, &camera, recipe.fastest));
    if random.one_in(3) {
        // All at one velocity, or none.
        let common = bodies[0].velocity;
        bodies.iter_mut().for_each(|body| set_velocity(body, &camera, common));
    }
    let lamps = (0..1 + random.below(3)).map(|_| lamp(random, &camera, &bodies, recipe)).collect();
    World { bodies, lamps, camera, anchor: DVec3::ZERO, sky: None }
}

/// The same world, in one of four cases under a sky, which rests in the scene, and with textures.
pub fn under_sky(random: &mut Random, world: World) -> World {
    let sky = random.one_in(4).then(|| rotation(random));
    textured(random, World { sky, ..world })
}

/// A camera at a random event, in half of all cases in motion.
pub fn camera(random: &mut Random) -> Camera {
    let velocity = if random.one_in(2) { DVec3::ZERO } else { random.in_ball(0.8) };
    let camera = Camera {
        event: random.in_cube(3.0).extend(if random.one_in(3) {
            0.0
        } else {
            random.between(-3.0, 3.0)
        }),
        velocity,
        forward: DVec3::Y,
        up: DVec3::Z,
        angle: random.between(40.0, 90.0),
    };
    let turn = rotation(random);
    Camera { forward: turn * camera.forward, up: turn * camera.up, ..camera }
}

/// A random rotation.
pub fn rotation(random: &mut Random) -> DMat3 {
    DMat3::from_axis_angle(random.direction(), random.between(0.0, core::f64::consts::TAU))
}

/// A random boost and turn, with a shift in space and time.
pub fn change(random: &mut Random, fastest: f64) -> Change {
    let turn = if random.one_in(3) { DMat3::IDENTITY } else { rotation(random) };
    let linear = boost(random.in_ball(fastest)) * glam::DMat4::from_mat3(turn);
    Change { linear, shift: random.in_cube(4.0).extend(random.between(-4.0, 4.0)) }
}

/// None, zero, or a random one.
pub fn velocity(random: &mut Random, fastest: f64) -> Option<DVec3> {
    match random.below(6) {
        0 => None,
        1 => Some(DVec3::ZERO),
        _ => Some(random.direction() * random.between(0.0, fastest)),
    }
}

/// The event that a camera sees at a place relative to it, in the frame of the camera.
pub fn seen_event(camera: &Camera, place: DVec3) -> Event {
    camera.event + boost(camera.velocity) * place.extend(-place.length())
}

/// The event at which a camera sees a point of a body.
pub fn on_light_cone(camera: &Camera, place: DVec3, velocity: DVec3) -> Event {
    let from_eye = place - rest_place(camera.event, velocity);
    camera.event + boost(velocity) * from_eye.extend(-from_eye.length())
}

/// Gives a body another velocity; its middle stays where it is seen.
pub fn set_velocity(body: &mut Body, camera: &Camera, velocity: Option<DVec3>) {
    let middle = body.vertices.iter().sum::<DVec3>() / body.vertices.len() as f64;
    let seen = on_light_cone(camera, middle, body.velocity.unwrap_or_default());
    let shift = rest_place(seen, velocity.unwrap_or_default()) - middle;
    body.vertices.iter_mut().for_each(|place| *place += shift);
    body.velocity = velocity;
}

/// A body that is seen within the picture.
pub fn body(random: &mut Random, camera: &Camera, recipe: Recipe) -> Body {
    let half = 0.9 * libm::tan(0.5 * camera.angle.to_radians());
    let aside = random.between(-half, half) * camera.right()
        + 0.75 * random.between(-half, half) * camera.up;
    let place = (camera.forward + aside).normalize() * random.between(3.0, 9.0);
    let velocity = velocity(random, recipe.fastest);
    let at = rest_place(seen_event(camera, place), velocity.unwrap_or_default());
    let mut body = shape(random);
    let (turn, size) = (rotation(random), random.between(0.6, 2.0));
    body.vertices.iter_mut().for_each(|place| *place = at + size * (turn * *place));
    let (paint, surface) = (paint(random), surface(random, recipe.surfaces));
    let is_matt = matches!(surface, Surface::Matt) && paint[3] == 0.0;
    let measured = (is_matt && random.one_in(4)).then(|| *random.pick(&MEASURED));
    Body { paint, measured, surface, velocity, ..body }
}

/// The same world, in which some bodies are covered with a picture.
pub fn textured(random: &mut Random, mut world: World) -> World {
    for body in
        world.bodies.iter_mut().filter(|body| body.round.is_none() && body.measured.is_none())
    {
        if random.one_in(3) && body.paint[3] == 0.0 {
            let across = [random.direction(), random.direction()];
            let coordinates = |place: &DVec3| DVec2::from(across.map(|axis| axis.dot(*place)));
            body.coordinates = body.vertices.iter().map(coordinates).collect();
        }
    }
    world
}

/// A large square behind everything.
fn wall(random: &mut Random, camera: &Camera, fastest: f64) -> Body {
    let velocity = velocity(random, 0.6 * fastest);
    let at = rest_place(seen_event(camera, 12.0 * camera.forward), velocity.unwrap_or_default());
    let turn = DMat3::from_axis_angle(random.direction(), 0.4)
        * DMat3::from_cols(camera.right(), camera.up, -camera.forward);
    let mut wall = square();
    wall.vertices.iter_mut().for_each(|place| *place = at + 14.0 * (turn * *place));
    Body { paint: opaque(random), velocity, ..wall }
}

fn surface(random: &mut Random, surfaces: Surfaces) -> Surface {
    let exponent = random.between(1.0, 40.0);
    match (random.below(6), surfaces) {
        (0, _) => Surface::Level(random.between(0.2, 1.5)),
        (1 | 2, Surfaces::Mirrors | Surfaces::Glass) => Surface::Reflecting([
            random.between(0.2, 0.8),
            random.between(0.1, 0.8),
            0.0,
            1.0,
            exponent,
            0.0,
        ]),
        (3, Surfaces::Glass) => {
            let absorption = if random.one_in(2) { 0.0 } else { random.between(0.0, 0.4) };
            Surface::Reflecting([0.0, 0.1, 0.8, random.between(1.1, 1.8), exponent, absorption])
        }
        _ => Surface::Matt,
    }
}

fn opaque(random: &mut Random) -> [f64; 4] {
    [random.between(0.1, 1.0), random.between(0.1, 1.0), random.between(0.1, 1.0), 0.0]
}

/// A colour, sometimes translucent.
pub fn paint(random: &mut Random) -> [f64; 4] {
    let [red, green, blue, _] = opaque(random);
    [red, green, blue, if random.one_in(6) { random.between(0.2, 0.8) } else { 0.0 }]
}

/// A random lamp that lights what the camera sees.
pub fn lamp(random: &mut Random, camera: &Camera, bodies: &[Body], recipe: Recipe) -> Lamp {
    let velocity = match recipe.lamps {
        Lamps::Unstated => None,
        Lamps::Stated => Some(velocity(random, recipe.fastest).unwrap_or_default()),
        Lamps::All => velocity(random, recipe.fastest),
    };
    let paint = random.one_in(3).then(|| [random.unit(), random.unit(), random.unit()]);
    let place = match random.below(4) {
        0 => LampPlace::Ambient,
        1 => LampPlace::Afar(random.direction() - 0.7 * camera.forward),
        _ => {
            let place = random.between(0.0, 8.0) * camera.forward + random.in_cube(4.0);
            let event = camera.event + boost(camera.velocity) * place.extend(-8.0);
            let of_body = bodies[random.below(bodies.len())].velocity.unwrap_or_default();
            LampPlace::At(rest_place(event, velocity.unwrap_or(of_body)))
        }
    };
    // No lamp without a velocity is the same in all frames but an ambient one.
    let velocity = match place {
        LampPlace::Ambient if random.one_in(2) && recipe.lamps == Lamps::Stated => None,
        _ => velocity,
    };
    let beam = match (random.below(6), place) {
        (0, LampPlace::At(_)) => Some(Beam::Spot {
            axis: random.direction() + camera.forward,
            angle: random.between(30.0, 120.0),
            edge: random.between(5.0, 30.0),
        }),
        (1, LampPlace::At(_)) => Some(Beam::Area {
            edges: [random.in_ball(0.5), random.in_ball(0.5)],
            reference: random.between(3.0, 9.0),
        }),
        _ => None,
    };
    Lamp { intensity: random.between(0.3, 1.5), place, beam, paint, velocity, motion: None }
}

/// The direction, in the frame of a lamp that moves with `beta`, in which a lamp is afar that is
/// seen along `toward` in the frame of the scene.
pub fn afar(toward: DVec3, beta: DVec3) -> DVec3 {
    aberrated(toward, beta).normalize()
}

/// A body of radius 1 around the origin, without colour.
pub fn shape(random: &mut Random) -> Body {
    match random.below(8) {
        0 => square(),
        1 => pyramid(),
        2 => sphere(6 + random.below(5)),
        3 => round(random),
        _ => cube(),
    }
}

/// A sphere, a cylinder, or a disc with a hole or without, exactly round: ends of radii and points
/// of rims.
fn round(random: &mut Random) -> Body {
    let rim =
        |z: f64| [DVec3::X, DVec3::Y, DVec3::NEG_X, DVec3::NEG_Y].map(|side| side + z * DVec3::Z);
    let (word, vertices, faces) = match random.below(3) {
        0 => {
            let ends = DMat3::IDENTITY.to_cols_array_2d().map(DVec3::from);
            ("sphere", [ends, ends.map(|end| -end)].concat(), vec![vec![0, 1, 2], vec![3, 4, 5]])
        }
        1 => ("cylinder", [rim(-1.0), rim(1.0)].concat(), vec![vec![0, 1, 2, 3], vec![4, 5, 6, 7]]),
        _ if random.below(2) == 0 => ("disc", rim(0.0).to_vec(), vec![vec![0, 1, 2, 3]]),
        _ => {
            let rims = [rim(0.0), rim(0.0).map(|corner| 0.4 * corner)].concat();
            ("disc", rims, vec![vec![0, 1, 2, 3], vec![4, 5, 6, 7]])
        }
    };
    Body { round: Some(word), ..plain(vertices, faces) }
}

fn plain(vertices: Vec<DVec3>, faces: Vec<Vec<usize>>) -> Body {
    Body {
        vertices,
        faces,
        round: None,
        paint: [1.0, 1.0, 1.0, 0.0],
        coordinates: Vec::new(),
        measured: None,
        vertex_paints: Vec::new(),
        surface: Surface::Matt,
        velocity: None,
        motion: None,
    }
}

/// A square in x and y; z is outside.
pub fn square() -> Body {
    let corner = |x: f64, y: f64| DVec3::new(x, y, 0.0);
    plain(
        vec![corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)],
        vec![vec![0, 1, 2, 3]],
    )
}

/// A cube.
pub fn cube() -> Body {
    let side = |bit: usize, row: usize| if row >> bit & 1 == 1 { 0.6 } else { -0.6 };
    let vertices = (0..8).map(|row| DVec3::new(side(0, row), side(1, row), side(2, row))).collect();
    let faces =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    plain(vertices, faces.map(Vec::from).to_vec())
}

fn pyramid() -> Body {
    let base = square().vertices;
    let vertices =
        base.into_iter().map(|place| 0.7 * (place - DVec3::Z)).chain([DVec3::Z]).collect();
    plain(
        vertices,
        vec![vec![3, 2, 1, 0], vec![0, 1, 4], vec![1, 2, 4], vec![2, 3, 4], vec![3, 0, 4]],
    )
}

/// A sphere of flat faces, with `sectors` around and half as many bands.
fn sphere(sectors: usize) -> Body {
    let bands = sectors / 2;
    let mut vertices = vec![DVec3::Z, DVec3::NEG_Z];
    for band in 1..bands {
        let (sin, cos) = libm::sincos(core::f64::consts::PI * band as f64 / bands as f64);
        vertices.extend((0..sectors).map(|sector| {
            let (y, x) = libm::sincos(core::f64::consts::TAU * sector as f64 / sectors as f64);
            DVec3::new(sin * x, sin * y, cos)
        }));
    }
    let at = |band: usize, sector: usize| 2 + (band - 1) * sectors + sector % sectors;
    let mut faces = Vec::new();
    for sector in 0..sectors {
        faces.push(vec![0, at(1, sector), at(1, sector + 1)]);
        faces.push(vec![1, at(bands - 1, sector + 1), at(bands - 1, sector)]);
        for band in 1..bands - 1 {
            let below = [at(band + 1, sector), at(band + 1, sector + 1)];
            faces.push(vec![at(band, sector), below[0], below[1], at(band, sector + 1)]);
        }
    }
    plain(vertices, faces)
}
