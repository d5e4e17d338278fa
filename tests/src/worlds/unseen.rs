//! Laws of the unseen, which changes nothing: bodies out of sight, unused colours, comments,
//! another order of statements, definitions instead of bodies.

use glam::{DMat3, DVec3};
use ugscene::Anchor;
use ugtesting::Random;

use super::Outcome;
use super::compare::check_same;
use super::generate::{self, Lamps, Recipe, Surfaces, shape, velocity, world};
use super::picture::{Picture, Renderer, SPECTRA, UNSHIFTED, by_law};
use super::world::{Body, Surface, World};
use crate::world_lines::Statement;

/// A picture of a world by a random renderer, with random anchors.
fn picture(random: &mut Random, world: &World) -> Picture {
    let shift = *random.pick(&[SPECTRA, UNSHIFTED, by_law(ugphysics::Brightness::Report)]);
    let mut picture = Picture::new(world, shift).by(*random.pick(&[
        Renderer::Rays,
        Renderer::Rays,
        Renderer::Exact,
        Renderer::Pipe,
    ]));
    let motion = &mut picture.motion;
    match random.below(6) {
        0 => motion.anchor = Some(Anchor::Center),
        1 => motion.anchor = Some(Anchor::Eye),
        2 => (motion.anchor, motion.in_place) = (None, true),
        3 => motion.anchor = None,
        _ => {}
    }
    if random.one_in(2) {
        motion.time = random.between(-3.0, 3.0);
    }
    picture
}

/// Gives some of the bodies motions with names instead of velocities.
fn name_bodies(random: &mut Random, world: &mut World) {
    for body in &mut world.bodies {
        if random.one_in(2) {
            body.motion = Some(Statement::inertial(body.velocity.take().unwrap_or_default()));
        }
    }
}

/// Bodies that are too small to be seen, or wholly transparent, of other velocities or with motions
/// of their own.
pub fn unseen_bodies(random: &mut Random) -> Outcome {
    let mut world = under_sky(random);
    name_bodies(random, &mut world);
    let picture = picture(random, &world);
    let mut more = world.clone();
    for _ in 0..1 + random.below(2) {
        let of = &world.bodies[random.below(world.bodies.len())];
        let at = of.vertices[0] + random.in_cube(3.0);
        let is_tiny = random.one_in(2);
        let size = if is_tiny { 1e-9 } else { random.between(0.5, 2.0) };
        let mut body = shape(random);
        body.vertices.iter_mut().for_each(|place| *place = at + size * *place);
        body.velocity =
            velocity(random, 0.9).map(|velocity| velocity + DVec3::new(1e-3, 2e-3, 0.0));
        if body.velocity.is_none() {
            body.velocity = Some(DVec3::new(0.3, 0.2, -0.1));
        }
        body.paint = [1.0, 1.0, 1.0, if is_tiny { 0.0 } else { 1.0 }];
        body.surface = Surface::Matt;
        if random.one_in(2) {
            let same = of.motion.clone();
            let same = same.unwrap_or_else(|| Statement::inertial(of.velocity.unwrap_or_default()));
            (body.motion, body.velocity) = (Some(same), None);
        }
        let row = random.below(more.bodies.len() + 1);
        more.bodies.insert(row, body);
    }
    check_same(&picture.draw()?, &Picture { text: more.text(), ..picture }.draw()?)
}

fn under_sky(random: &mut Random) -> World {
    let recipe = Recipe { fastest: 0.9, lamps: Lamps::All, surfaces: Surfaces::Glass };
    let world = world(random, recipe);
    generate::under_sky(random, world)
}

/// Unused colours, surfaces, vertices and definitions, comments, and another order of statements.
pub fn unused_statements(random: &mut Random) -> Outcome {
    let mut world = under_sky(random);
    name_bodies(random, &mut world);
    let picture = picture(random, &world);
    let mut statements = world.statements();
    // Vertices that no face uses are part of the box that bodies are placed by.
    for words in [
        "c unused 0.5 120 1;\n",
        "c_bb unused2 4000 2;\n",
        "surf unused 1 0.5 0.5 2;\n",
        "def unused; v a 0 0 0; v b 1 0 0; v c 0 1 0; f (a b c) <0.5 0 0>; l 9 1 2 3; end;\n",
        "{ a comment }\n",
        "{ another { within } }\n",
        ";\n",
    ] {
        statements.push(words.to_owned());
    }
    for last in (1..statements.len()).rev() {
        statements.swap(last, random.below(last + 1));
    }
    check_same(&picture.draw()?, &Picture { text: statements.concat(), ..picture }.draw()?)
}

/// Bodies as instances of mirrored, turned and scaled definitions.
pub fn instances(random: &mut Random) -> Outcome {
    let world = under_sky(random);
    let picture = picture(random, &world);
    let mut text: String = World { bodies: Vec::new(), ..world.clone() }.text();
    for (row, body) in world.bodies.iter().enumerate() {
        let (words, of) = definition(random, body);
        text += &body.as_instance(row, &words, &of);
    }
    check_same(&picture.draw()?, &Picture { text, ..picture }.draw()?)
}

/// A transformation, and the body of which it makes this one.
fn definition(random: &mut Random, body: &Body) -> (String, Body) {
    let mut of = body.clone();
    let words = match random.below(4) {
        0 => {
            of.vertices.iter_mut().for_each(|place| place.x = -place.x);
            of.faces.iter_mut().for_each(|face| face.reverse());
            "-mx".to_owned()
        }
        1 => {
            of.vertices.iter_mut().for_each(|place| *place = -*place);
            of.faces.iter_mut().for_each(|face| face.reverse());
            "-ma".to_owned()
        }
        2 => {
            let shift = random.in_cube(9.0);
            of.vertices.iter_mut().for_each(|place| *place = (*place - shift) / 1e3);
            format!("-sa 1000 -ta {} {} {}", shift.x, shift.y, shift.z)
        }
        _ => {
            let turn = generate::rotation(random);
            let DMat3 { x_axis: x, y_axis: y, z_axis: z } = turn;
            of.vertices.iter_mut().for_each(|place| *place = turn.transpose() * *place);
            // Rows of the matrix for row vectors are the images of the axes.
            let numbers: Vec<String> = [x, y, z]
                .iter()
                .flat_map(|row| row.to_array())
                .map(|number| number.to_string())
                .collect();
            format!("-M3 {}", numbers.join(" "))
        }
    };
    (words, of)
}
