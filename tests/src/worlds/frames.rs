//! Nothing depends on the frame of reference, on where and when a world is, or on the unit of
//! length; a world in a mirror has the reversed picture.

use glam::{DMat3, DVec3};
use ugtesting::Random;

use super::Outcome;
use super::compare::{check_reversed, check_same, is_same};
use super::generate::{Lamps, Recipe, Surfaces, change, rotation, textured, under_sky, world};
use super::picture::{Drawn, LIGHT_ERROR, Picture, Renderer, SPECTRA, UNSHIFTED, by_law};
use super::spacetime::aberrated;
use super::world::{LampPlace, World};
use ugphoton::{Channel, ColorShift};

const SHIFTS: [ColorShift; 4] = [
    SPECTRA,
    UNSHIFTED,
    by_law(ugphysics::Brightness::Report),
    by_law(ugphysics::Brightness::Bolometric),
];

const RENDERERS: [Renderer; 4] = [Renderer::Rays, Renderer::Rays, Renderer::Exact, Renderer::Pipe];

/// Draws both worlds in the same way.
fn both(
    random: &mut Random,
    one: &World,
    other: &World,
    renderers: &[Renderer],
    light_error: f64,
) -> Result<[Drawn; 2], String> {
    let shift = *random.pick(&SHIFTS);
    let renderer = *random.pick(renderers);
    let fresnel = random.one_in(3);
    let draw = |world: &World| {
        let mut picture = Picture { light_error, ..Picture::new(world, shift).by(renderer) };
        picture.rays.fresnel = fresnel;
        picture.draw()
    };
    Ok([draw(one)?, draw(other)?])
}

/// Both worlds have the same picture, by rays or by the whole pipe, which measures the error of
/// light at single points: where a lamp accelerates its bound can be exceeded between them.
pub(super) fn check_both(random: &mut Random, one: &World, other: &World) -> Outcome {
    let [one, other] = both(
        random,
        one,
        other,
        &[Renderer::Rays, Renderer::Rays, Renderer::Pipe],
        LIGHT_ERROR / 5.0,
    )?;
    check_same(&one, &other)
}

/// A boost, a turn, and a shift in space and time.
pub fn boosts(random: &mut Random) -> Outcome {
    let recipe = Recipe { fastest: 0.9, lamps: Lamps::Stated, surfaces: Surfaces::Glass };
    let world = world(random, recipe);
    let mut world = textured(random, world);
    let mut renderers = RENDERERS.to_vec();
    if random.one_in(4) {
        // In exact mode all lamps rest with what they light, so only ambient light is the same.
        renderers = vec![Renderer::Exact];
        for lamp in &mut world.lamps {
            (lamp.place, lamp.beam, lamp.velocity) = (LampPlace::Ambient, None, None);
        }
    } else {
        renderers.retain(|renderer| *renderer != Renderer::Exact);
    }
    let moved = world.changed(&change(random, 0.8));
    let [one, other] = both(random, &world, &moved, &renderers, LIGHT_ERROR)?;
    check_same(&one, &other)
}

/// A turn, a shift in space, and another unit of length.
pub fn turns(random: &mut Random) -> Outcome {
    let recipe = Recipe { fastest: 0.9, lamps: Lamps::All, surfaces: Surfaces::Glass };
    let world = world(random, recipe);
    let world = under_sky(random, world);
    let unit = *random.pick(&[1.0, 1.0, 1e-6, 1e6]);
    let moved = world.placed(rotation(random), unit, unit * random.in_cube(9.0));
    let [one, other] = both(random, &world, &moved, &RENDERERS, LIGHT_ERROR)?;
    check_same(&one, &other)
}

/// A reflection of the whole world.
pub fn parity(random: &mut Random) -> Outcome {
    let recipe = Recipe { fastest: 0.9, lamps: Lamps::All, surfaces: Surfaces::Glass };
    let world = world(random, recipe);
    let turn = rotation(random) * DMat3::from_diagonal(DVec3::new(-1.0, 1.0, 1.0));
    let [one, other] =
        both(random, &world, &world.placed(turn, 1.0, DVec3::ZERO), &RENDERERS, LIGHT_ERROR)?;
    check_reversed(&one, &other)
}

/// Two eyes that pass each other see the same things of the same colours in the directions of
/// aberration, and every one of them says in which direction of the body's frame: the channel
/// `direction` is in the axes of the scene.
pub fn passing_eyes(random: &mut Random) -> Outcome {
    let recipe = Recipe { fastest: 0.9, lamps: Lamps::All, surfaces: Surfaces::Matt };
    let world = world(random, recipe);
    let drawn = |world: &World| {
        let channels = vec![Channel::Id, Channel::Direction];
        Picture { channels, ..Picture::new(world, UNSHIFTED) }
    };
    let one = drawn(&world).draw()?;
    let mut n_lit = 0;
    for _ in 0..4 {
        let [width, height] = one.picture.size;
        let pixel = [random.below(width as usize) as u32, random.below(height as usize) as u32];
        let toward = world.camera.direction(pixel, one.picture.size);
        // From the camera through the scene to the other one.
        let (beta, other_beta) = (world.camera.velocity, random.in_ball(0.8));
        let in_scene = aberrated(toward, -beta);
        let mut passing = world.clone();
        passing.camera.velocity = other_beta;
        passing.camera = passing.camera.looking(aberrated(in_scene, other_beta));
        // The picture is taken at the same event; `event` is in the frame of the scene.
        let other = drawn(&passing).of_pixel().draw()?;
        let at = (pixel[1] * width + pixel[0]) as usize;
        let direction = |drawn: &Drawn, at: usize| {
            ["X", "Y", "Z"].map(|axis| drawn.channel(&format!("direction.{axis}"))[at])
        };
        let is_direction =
            direction(&one, at).iter().zip(direction(&other, 0)).all(|(a, b)| (a - b).abs() < 1e-5);
        if one.ids()[at] != other.ids()[0]
            || !is_same(one.light()[at], other.light()[0])
            || !is_direction
        {
            let light = (one.light()[at], other.light()[0]);
            let directions = (direction(&one, at), direction(&other, 0));
            return Err(format!(
                "pixel {pixel:?}: light {light:?}, directions {directions:?}\n{}\n{}",
                one.picture.described(),
                other.picture.described()
            ));
        }
        n_lit += usize::from(one.ids()[at] > 0);
    }
    Ok(n_lit)
}
