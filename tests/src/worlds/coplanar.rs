//! Laws of faces in one plane: the first in the scene is visible, however they move.

use glam::DVec3;
use ugtesting::Random;

use super::Outcome;
use super::accelerated;
use super::compare::{check_pipe_light, check_same};
use super::generate::{Lamps, Recipe, Surfaces, world};
use super::picture::{Picture, Renderer, SPECTRA, UNSHIFTED};
use super::spacetime::rest_place;
use super::world::{Body, Surface, World};

/// A face behind another one in its plane is not seen.
pub fn last(random: &mut Random) -> Outcome {
    let (world, renderer) = random_world(random);
    let row = random.below(world.bodies.len());
    let host = &world.bodies[row];
    if host.round.is_some()
        || host.paint[3] > 0.0
        || host.vertex_paints.iter().any(|paint| paint[3] > 0.0)
    {
        // It is seen through its host, or its host is not flat.
        return Ok(0);
    }
    let decal = decal(random, host);
    let mut other = world.clone();
    let place = row + 1 + random.below(world.bodies.len() - row);
    other.bodies.insert(place, decal);
    let picture = Picture::new(&world, *random.pick(&[SPECTRA, UNSHIFTED])).by(renderer);
    check_same(&picture.draw()?, &Picture { text: other.text(), ..picture }.draw()?)
}

/// A face before another one in its plane is seen, as if it were a little nearer to the eye.
pub fn first(random: &mut Random) -> Outcome {
    let (mut world, renderer) = random_world(random);
    let row = random.below(world.bodies.len());
    if world.bodies[row].round.is_some() {
        return Ok(0);
    }
    let mut decal = decal(random, &world.bodies[row]);
    // Where another body is within the distance, a pixel may differ.
    let middle = decal.vertices.iter().sum::<DVec3>() / decal.vertices.len() as f64;
    let size = (decal.vertices[0] - decal.vertices[1]).length();
    let normal =
        (decal.vertices[1] - decal.vertices[0]).cross(decal.vertices[2] - decal.vertices[0]);
    let velocity = decal.velocity.unwrap_or_default();
    let toward_eye = rest_place(world.camera.event, velocity) - middle;
    if decal.motion.is_some() || normal.length() == 0.0 {
        return Ok(0);
    }
    let up = normal.normalize() * normal.dot(toward_eye).signum();
    world.bodies.insert(random.below(row + 1), decal.clone());
    let on_plane = world.text();
    decal.vertices.iter_mut().for_each(|place| *place += 0.001 * size * up);
    let place = world.bodies.iter().position(|body| body.paint == decal.paint).unwrap_or(0);
    world.bodies[place] = decal;
    let mut picture = Picture::new(&world, UNSHIFTED).by(renderer);
    picture.rays.shadows = false;
    let lifted = picture.draw()?;
    let flat = Picture { text: on_plane, ..picture }.draw()?;
    check_pipe_light(flat.light().into_iter().zip(lifted.light()).collect(), [&flat, &lifted])
}

fn random_world(random: &mut Random) -> (World, Renderer) {
    if random.one_in(4) {
        return (accelerated::matt_world(random), *random.pick(&[Renderer::Rays, Renderer::Pipe]));
    }
    let recipe = Recipe { fastest: 0.95, lamps: Lamps::Stated, surfaces: Surfaces::Matt };
    (world(random, recipe), *random.pick(&[Renderer::Rays, Renderer::Exact, Renderer::Pipe]))
}

/// A part of a face of a body, as a body that moves alike, in a colour that no other body has.
fn decal(random: &mut Random, of: &Body) -> Body {
    let face = &of.faces[random.below(of.faces.len())];
    let middle = face.iter().map(|&row| of.vertices[row]).sum::<DVec3>() / face.len() as f64;
    let corner = |&row: &usize| middle + random.between(0.3, 0.9) * (of.vertices[row] - middle);
    let vertices: Vec<DVec3> = face.iter().map(corner).collect();
    let faces = vec![(0..vertices.len()).collect()];
    let paint = [0.987, 0.123, 0.456, 0.0];
    let surface = Surface::Level(1.0);
    let coordinates = Vec::new();
    Body {
        vertices,
        faces,
        paint,
        coordinates,
        measured: None,
        vertex_paints: Vec::new(),
        surface,
        ..of.clone()
    }
}
