//! Three renderers draw one picture.

use glam::DVec3;
use ugphoton::Channel;
use ugphysics::Brightness;
use ugtesting::Random;

use super::Outcome;
use super::compare::{are_around, check_pipe_light, check_within, is_within};
use super::generate::{Lamps, Recipe, Surfaces, paint, textured, world};
use super::picture::{Picture, Renderer, SPECTRA, UNSHIFTED, by_law};
use super::world::World;

/// Rays and the exact mode of the pipe: the same light at every sample. Bodies have one colour, and
/// lamps are white.
pub fn exact(random: &mut Random) -> Outcome {
    check_exact(random, white_lamps)
}

/// As [`exact`], with colours at vertices and faces that are not flat.
pub fn painted_exact(random: &mut Random) -> Outcome {
    check_exact(random, painted)
}

/// Rays and the whole pipe, off edges, and off pieces of faces in which a lamp sets. Bodies have
/// one colour, and lamps are white.
pub fn pipe(random: &mut Random) -> Outcome {
    let world = random_world(random, white_lamps);
    check_pipe(random, &world)
}

/// As [`pipe`], with colours at vertices and faces that are not flat.
pub fn painted_pipe(random: &mut Random) -> Outcome {
    let world = random_world(random, painted);
    check_pipe(random, &world)
}

/// As [`exact`], under coloured lamps.
pub fn colored_exact(random: &mut Random) -> Outcome {
    check_exact(random, |_, world| world)
}

/// As [`pipe`], under coloured lamps, and off pieces whose corners have hues far apart.
pub fn colored_pipe(random: &mut Random) -> Outcome {
    let world = random_world(random, |_, world| world);
    check_pipe(random, &world)
}

fn check_exact(random: &mut Random, change: fn(&mut Random, World) -> World) -> Outcome {
    let recipe = Recipe { fastest: 0.9, lamps: Lamps::Unstated, surfaces: Surfaces::Matt };
    let world = world(random, recipe);
    let world = textured(random, world);
    let world = change(random, world);
    let shift = *random.pick(&[SPECTRA, UNSHIFTED, by_law(Brightness::Report)]);
    let rays = Picture::new(&world, shift).like_pipe();
    let (one, other) = (rays.clone().by(Renderer::Exact).draw()?, rays.draw()?);
    let pairs: Vec<_> = one.light().into_iter().zip(other.light()).collect();
    check_within(&pairs, [&one, &other], 3e-3, 3)
}

fn random_world(random: &mut Random, change: fn(&mut Random, World) -> World) -> World {
    let recipe = Recipe { fastest: 0.8, lamps: Lamps::All, surfaces: Surfaces::Matt };
    let mut world = world(random, recipe);
    // The pipe leaves out textures where lamps move.
    if world.lamps.iter().all(|lamp| lamp.velocity.is_none()) {
        world = textured(random, world);
    }
    change(random, world)
}

/// Rays and the whole pipe draw a world alike.
pub(super) fn check_pipe(random: &mut Random, world: &World) -> Outcome {
    let shift = *random.pick(&[SPECTRA, UNSHIFTED]);
    let channels = vec![Channel::Id];
    let rays = Picture { channels, ..Picture::new(world, shift).like_pipe() };
    let pipe = rays.clone().by(Renderer::Pipe);
    let (one, other, is_uneven) = (pipe.draw()?, rays.draw()?, pipe.uneven_pieces()?);
    let (width, light, ids) = (rays.size[0] as usize, other.light(), other.ids());
    // Between different faces, and where a light sets, light changes from sample to sample. Light at
    // a point of a flat face is 0 behind the line where a moving lamp sets; the pipe, which has the
    // light of corners alone, interpolates between those in light and those in the dark. Hue turns
    // by 180° where the sum of coloured lamps is grey, and leaps from one end of the spectrum to
    // the other at magenta; the pipe interpolates between such corners, too.
    let pieces = one.ids();
    let is_smooth = |at: usize| {
        let piece = (pieces[at] as usize).checked_sub(1);
        !piece.is_some_and(|piece| is_uneven[piece])
            && are_around(at, width, light.len(), |near| {
                ids[near] == ids[at] && is_within(light[near], light[at], 0.5)
            })
    };
    let pairs: Vec<_> = one.light().into_iter().zip(light.clone()).enumerate().collect();
    let pairs: Vec<_> =
        pairs.into_iter().filter(|(at, _)| is_smooth(*at)).map(|(_, pair)| pair).collect();
    if pairs.is_empty() {
        return Ok(0);
    }
    check_pipe_light(pairs, [&one, &other])
}

fn white_lamps(_: &mut Random, mut world: World) -> World {
    world.lamps.iter_mut().for_each(|lamp| lamp.paint = None);
    world
}

/// Some bodies get colours at their vertices, and some vertices leave the planes of their faces.
fn painted(random: &mut Random, mut world: World) -> World {
    for body in world.bodies.iter_mut().filter(|body| body.round.is_none()) {
        let own = body.paint;
        body.measured = None;
        match random.below(4) {
            0 => {
                body.vertex_paints =
                    body.vertices.iter().map(|_| without_translucency(paint(random))).collect()
            }
            1 => {
                body.vertex_paints = vec![without_translucency(own); body.vertices.len()];
                body.vertex_paints[0] = without_translucency(paint(random));
            }
            _ => {}
        }
        if random.one_in(3) {
            let size = (body.vertices[0] - body.vertices[2]).length();
            let bent: DVec3 = random.direction() * size * random.between(0.0, 0.05);
            body.vertices[0] += bent;
        }
    }
    white_lamps(random, world)
}

fn without_translucency([red, green, blue, _]: [f64; 4]) -> [f64; 4] {
    [red, green, blue, 0.0]
}
