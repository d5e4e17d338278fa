//! Colours of lit surfaces as seen, by their spectra.  Eq. (P14)

use glam::DVec3;
use rayon::prelude::*;
use uglight::Irradiance;
use ugparse::{ColorId, Scene};
use ugscene::Shares;
use ugspectrum::{LightSpectrum, Spectrum};

use crate::Config;
use crate::illumination::Illumination;
use crate::spectral::parts;

/// X, Y, Z of every vertex with the light on it; `None` where it is not lit.
///
/// L(λ) = D⁵ Σ D_l³ · level · intensity · R(λD) S(λ D D_l), over the lights, R the reflectance and
/// S the light's spectrum: daylight through its colour, or the black body or samples that its
/// colour is. What is no surface shines as it does without lights.
pub(crate) fn seen(
    scene: &Scene,
    config: &Config,
    shares: &[Shares],
    factors: &[f64],
    light: &Illumination,
) -> Vec<Option<[f64; 3]>> {
    let spectrum = |color: Option<ColorId>| match color {
        Some(color) => uglight::spectrum(scene, &scene.colors[color.index()]).0,
        None => Spectrum::from_linear_srgb([1.0; 3]),
    };
    let lamps: Vec<(LightSpectrum, f64)> = (scene.lights.iter())
        .map(|light| (LightSpectrum::new(&spectrum(light.color)), light.intensity))
        .collect();
    let colors: Vec<Spectrum> =
        (0..scene.colors.len()).map(|row| spectrum(Some(ColorId::from_index(row)))).collect();
    let white = spectrum(None);
    let all = shares.par_iter().zip(factors).zip(&light.of_vertex);
    all.map(|((shares, &doppler), light)| {
        let (view, light) = (View { config, lamps: &lamps, doppler }, light.as_ref()?);
        let sum = parts(shares).fold(DVec3::ZERO, |sum, (color, share)| {
            let surface = color.map_or(&white, |color| &colors[color.index()]);
            sum + share * view.of(surface, light)
        });
        Some(sum.to_array().map(|part| if part.is_nan() { 0.0 } else { part.clamp(0.0, f64::MAX) }))
    })
    .collect()
}

/// How one vertex is looked at.
struct View<'a> {
    config: &'a Config,
    /// Spectra and intensities.
    lamps: &'a [(LightSpectrum, f64)],
    doppler: f64,
}

impl View<'_> {
    fn of(&self, surface: &Spectrum, light: &[Irradiance]) -> DVec3 {
        let shift = |doppler: f64| if self.config.doppler { doppler } else { 1.0 };
        let flux = |factor: f64| if self.config.flux { factor } else { 1.0 };
        let square = self.doppler * self.doppler;
        let gain = flux(square * square * self.doppler);
        let mut sum = DVec3::ZERO;
        for part in light {
            let (lamp, intensity) = &self.lamps[part.lamp as usize];
            let Some(xyz) = surface.under(lamp, shift(self.doppler), shift(part.doppler)) else {
                return gain * DVec3::from(surface.shifted(shift(self.doppler)));
            };
            let received = part.level * intensity * flux(part.doppler * part.doppler * part.doppler);
            sum += received * gain * DVec3::from(xyz);
        }
        sum
    }
}
