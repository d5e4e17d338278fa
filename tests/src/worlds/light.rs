//! Light is linear.

use ugphysics::Brightness;
use ugtesting::Random;

use super::Outcome;
use super::compare::{check_light, check_within};
use super::generate::{Lamps, Recipe, Surfaces, lamp, world};
use super::picture::{Drawn, Picture, Renderer, SPECTRA, by_law};
use super::world::{Beam, Lamp, Surface, World};
use ugphoton::ColorShift;

fn dark_world(random: &mut Random, lamps: Lamps) -> (World, Recipe) {
    let recipe = Recipe { fastest: 0.9, lamps, surfaces: Surfaces::Glass };
    let mut world = world(random, recipe);
    for body in &mut world.bodies {
        if let Surface::Level(_) = body.surface {
            body.surface = Surface::Matt;
        }
    }
    (world, recipe)
}

/// Two groups of lamps are the sum of both; twice the intensity is twice the light.
fn check_sum(random: &mut Random, shift: ColorShift) -> Outcome {
    // The pipe interpolates hues between the corners of pieces, which is not linear.
    let with_hues = &[Renderer::Rays, Renderer::Exact];
    let with_spectra = &[Renderer::Rays, Renderer::Rays, Renderer::Exact, Renderer::Pipe];
    let renderer =
        if shift == SPECTRA { *random.pick(with_spectra) } else { *random.pick(with_hues) };
    let lamps = if renderer == Renderer::Exact { Lamps::Unstated } else { Lamps::All };
    let (world, recipe) = dark_world(random, lamps);
    let others: Vec<Lamp> = (0..1 + random.below(2))
        .map(|_| lamp(random, &world.camera, &world.bodies, recipe))
        .collect();
    let factor = random.between(0.1, 20.0);
    let scaled: Vec<Lamp> = others
        .iter()
        .map(|lamp| Lamp { intensity: factor * lamp.intensity, ..lamp.clone() })
        .collect();
    // With shadows, another point of an area lights each sample.
    let areas =
        world.lamps.iter().chain(&others).any(|lamp| matches!(lamp.beam, Some(Beam::Area { .. })));
    let drawn = |lamps: Vec<Lamp>| {
        let mut picture = Picture::new(&World { lamps, ..world.clone() }, shift).by(renderer);
        picture.rays.shadows = !areas;
        picture.draw()
    };
    let (one, other) = (drawn(world.lamps.clone())?, drawn(others)?);
    let both = drawn(world.lamps.iter().cloned().chain(scaled).collect())?;
    let sum = one.light().into_iter().zip(other.light());
    let sum = sum.map(|(a, b)| [0, 1, 2].map(|channel| a[channel] + factor as f32 * b[channel]));
    check_light(&both, &other, sum.collect())
}

/// With spectra.
pub fn sums_of_spectra(random: &mut Random) -> Outcome {
    check_sum(random, SPECTRA)
}

/// With laws that name quantities: photons, power.
pub fn sums_of_quantities(random: &mut Random) -> Outcome {
    let law = *random.pick(&[Brightness::Photon, Brightness::Bolometric]);
    check_sum(random, by_law(law))
}

/// The brightness of a body with its own light is multiplied by the power of D that the law names.
pub fn powers_of_doppler(random: &mut Random) -> Outcome {
    let (mut world, _) = dark_world(random, Lamps::Unstated);
    for body in &mut world.bodies {
        let grey = random.between(0.1, 0.9);
        (body.paint, body.measured) = ([grey, grey, grey, 0.0], None);
        body.surface = Surface::Level(1.0);
    }
    let (law, power) = *random.pick(&[(Brightness::Photon, 3.0), (Brightness::Bolometric, 4.0)]);
    let renderer = *random.pick(&[Renderer::Rays, Renderer::Exact]);
    let drawn = |shift: ColorShift| -> Result<Drawn, String> {
        let channels = vec![ugphoton::Channel::Doppler];
        Picture { channels, ..Picture::new(&world, shift).by(renderer) }.draw()
    };
    let (at_rest, seen) = (drawn(super::picture::UNSHIFTED)?, drawn(by_law(law))?);
    let expected = at_rest.light().into_iter().zip(at_rest.channel("D"));
    let expected = expected.map(|(light, d)| light.map(|channel| channel * libm::powf(*d, power)));
    let pairs: Vec<_> = seen.light().into_iter().zip(expected).collect();
    check_within(&pairs, [&seen, &at_rest], 1e-3, 2)
}
