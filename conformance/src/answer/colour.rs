//! Questions about wavelengths and displayed colours.

use ugparse::{Options, Source};
use ugphysics::spectrum::{Spectrum, planck};
use ugphysics::{RED_END_NM, VIOLET_END_NM, srgb_encode, wavelength_to_hue};
use ugscene::{ColorValue, Tint};

use super::numbers::{Answer, exactly};

pub const KINDS: &[(&str, Answer)] = &[
    ("blackbody_temperature", |given| {
        let [kelvin, doppler] = exactly(given)?;
        // Every wavelength is divided by D, including that of the maximum.
        Some(vec![kelvin * doppler])
    }),
    ("blackbody_radiance_ratio", |given| {
        let [kelvin, doppler, wavelength_nm] = exactly(given)?;
        // Light observed at λ was emitted at λD, and a unit of wavelength at the eye is D units at
        // the source (P12).
        let square = doppler * doppler;
        let seen = square * square * doppler * planck(wavelength_nm * doppler, kelvin);
        Some(vec![seen / planck(wavelength_nm, kelvin)])
    }),
    ("blackbody_xy", |given| {
        let [kelvin] = exactly(given)?;
        let [x, y, z] = Spectrum::blackbody(kelvin, 1.0).seen(1.0);
        Some(vec![x / (x + y + z), y / (x + y + z)])
    }),
    ("blackbody_luminance_ratio", |given| {
        let [kelvin, reference_kelvin] = exactly(given)?;
        Some(vec![Spectrum::blackbody(reference_kelvin, 1.0).seen(kelvin / reference_kelvin)[1]])
    }),
    ("wavelength_seen", |given| {
        let [wavelength_nm, doppler] = exactly(given)?;
        wavelength_seen(wavelength_nm, doppler).map(|seen| vec![seen])
    }),
    ("srgb_encode", |given| {
        let [linear] = exactly(given)?;
        Some(vec![srgb_encode(linear)])
    }),
];

/// Runs `ugdoppler` on a triangle of one wavelength that moves straight towards the eye or away
/// from it.
fn wavelength_seen(wavelength_nm: f64, doppler: f64) -> Option<f64> {
    // Only visible wavelengths have a hue at rest.
    if !(VIOLET_END_NM..=RED_END_NM).contains(&wavelength_nm) {
        return None;
    }
    let square = doppler * doppler;
    // On the line of motion D = √((1 + β)/(1 − β)).
    let toward = (square - 1.0) / (square + 1.0);
    let hue = wavelength_to_hue(wavelength_nm);
    let scene = format!(
        "(ugstage 1 geometry as-seen eye 0 0 0) c color 1 {hue:?} 1; v a 10 0 0; v b 11 0 0; v d 10 1 0; f (a b d) color <{:?} 0 0>;",
        -toward
    );
    let config = ugdoppler::Config { tolerance: 0.0, wavelengths: true, ..Default::default() };
    let scene = ugparse::parse(&Source::new("wavelength.ug", scene), &Options::default()).ok()?.scene;
    let (scene, _) = ugdoppler::apply(scene, &config).ok()?;
    let color = scene.vertices.first()?.color?;
    match scene.colors[color.index()].value {
        ColorValue::Hsv { tint: Tint::Wavelength(seen_nm), .. } => Some(seen_nm),
        _ => None,
    }
}
