//! Colours as spectra, as seen in motion.

use std::sync::OnceLock;

use glam::DVec3;
use ugphysics::linear_srgb_to_xyz;
use ugphysics::spectrum::{
    DopplerGrid, DopplerTable, InfraredRule, LightSpectrum, SmoothCurve, Spectrum,
};
use ugscene::{ColorId, Scene};

use crate::{Irradiance, Lamp, spectrum};

/// The changes by motion in a spectrum, L(λ) = D⁵ L'(λD): wavelengths, and the radiance at
/// each.  Eq. (P12)
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SpectralShift {
    /// L'(λD) instead of L'(λ).
    pub doppler: bool,
    /// The factor D⁵.
    pub flux: bool,
    /// What surfaces reflect in infrared.  Eq. (P20)
    pub infrared: InfraredRule,
    /// Radiances at three wavelengths, nm, in place of red, green and blue.
    pub sampled_nm: Option<[u16; 3]>,
}

/// Wavelengths, nm, at which a spectrum determines how it is seen at up to 0.9c: linearly
/// interpolated between them, it keeps the corners of daylight. Their number is a multiple of 3.
pub fn sampled_wavelengths() -> Vec<u16> {
    let rising = |from: f64, to: f64, factor: f64| {
        let all = std::iter::successors(Some(from), move |nm| Some(nm * factor));
        all.take_while(move |nm| *nm < to).map(|nm| nm as u16)
    };
    // In ultraviolet, the light of black bodies falls steeply.
    let ultraviolet = rising(80.0, 297.0, 1.015);
    let mut all: Vec<u16> =
        ultraviolet.chain((300..=830).step_by(5)).chain(rising(850.0, 4000.0, 1.03)).collect();
    all.truncate(all.len() / 3 * 3);
    all
}

impl SpectralShift {
    /// Spectra stay as they are at rest.
    pub const NONE: Self =
        Self { doppler: false, flux: false, infrared: InfraredRule::Measured, sampled_nm: None };

    /// ln of the factor that wavelengths are divided by.
    pub fn ln_shift(self, ln_doppler: f64) -> f64 {
        if self.doppler { ln_doppler } else { 0.0 }
    }

    /// ln of the factor on the radiance.
    pub fn ln_gain(self, ln_doppler: f64) -> f64 {
        if self.flux { 5.0 * ln_doppler } else { 0.0 }
    }

    /// X, Y, Z of a surface under several lamps behind filters, seen with the Doppler factor
    /// `doppler`: those of L(λ) = D⁵ Σ D_l³ · level · intensity · R(λD) S(λ D D_l) Π T(λ D_f), the
    /// sum over the lamps, the product over the filters. R is the reflectance, S the spectrum of a
    /// lamp, T the transmittance of a filter. Black bodies and samples emit what they emit without
    /// lamps.  Eq. (P14)
    pub fn seen_lit(
        self,
        surface: &Spectrum,
        doppler: f64,
        light: &[Irradiance],
        lamps: &[Lamp],
        filters: &[SpectralFilter<'_>],
    ) -> DVec3 {
        let shift = |doppler: f64| if self.doppler { doppler } else { 1.0 };
        let flux = |factor: f64| if self.flux { factor } else { 1.0 };
        let square = doppler * doppler;
        let (own, gain) = (shift(doppler), flux(square * square * doppler));
        if let Some(sampled_nm) = self.sampled_nm {
            let emitted = (!surface.is_surface()).then(|| LightSpectrum::new(surface));
            return DVec3::from(sampled_nm.map(|nm| {
                let nm = f64::from(nm);
                let received = |part: &Irradiance| {
                    let lamp = &lamps[part.lamp as usize];
                    let cube = part.doppler * part.doppler * part.doppler;
                    part.level
                        * lamp.intensity
                        * flux(cube)
                        * lamp.spectrum().at(nm * own * shift(part.doppler))
                };
                let lit =
                    || surface.transmittance(nm * own) * light.iter().map(received).sum::<f64>();
                let part = |it: &SpectralFilter<'_>| it.color.transmittance(nm * shift(it.doppler));
                let light = emitted.as_ref().map_or_else(lit, |emitted| emitted.at(nm * own));
                gain * filters.iter().map(part).product::<f64>() * light
            }));
        }
        if !surface.is_surface() && filters.is_empty() {
            return gain * DVec3::from(surface.shifted(own));
        }
        // Surfaces reflect, and all else emits.
        let curve = filters.iter().fold(SmoothCurve::of(surface, own), |curve, filter| {
            curve.through(filter.color, shift(filter.doppler))
        });
        if !surface.is_surface() {
            return gain * DVec3::from(LightSpectrum::new(surface).seen_through(&curve, own));
        }
        let mut sum = DVec3::ZERO;
        for part in light {
            let lamp = &lamps[part.lamp as usize];
            let xyz = lamp.spectrum().seen_through(&curve, own * shift(part.doppler));
            let received =
                part.level * lamp.intensity * flux(part.doppler * part.doppler * part.doppler);
            sum += received * gain * DVec3::from(xyz);
        }
        sum
    }
}

/// A filter between a surface and the eye.
#[derive(Clone, Copy, Debug)]
pub struct SpectralFilter<'a> {
    /// The colour of the light that it transmits of white light.
    pub color: &'a Spectrum,
    /// The Doppler factor with which it is seen.
    pub doppler: f64,
}

/// The spectrum of a colour of a scene.
#[derive(Clone, Debug)]
pub struct SpectralColor {
    spectrum: Spectrum,
    is_exact: bool,
    table: Option<DopplerTable>,
    /// Its light in daylight, made at first use.
    light: OnceLock<LightSpectrum>,
}

impl SpectralColor {
    /// The spectrum of a colour statement, or of white.
    pub fn new(scene: &Scene, color: Option<ColorId>) -> Self {
        let (spectrum, is_exact) = match color {
            Some(color) => spectrum(scene, &scene.colors[color.index()]),
            None => return Self::of([1.0; 3], scene.infrared),
        };
        Self { spectrum, is_exact, table: None, light: OnceLock::new() }
    }

    /// The spectrum of a surface of these linear red, green and blue.
    pub fn of(linear: [f64; 3], infrared: InfraredRule) -> Self {
        let (spectrum, is_exact) = Spectrum::with_infrared(linear_srgb_to_xyz(linear), infrared);
        Self { spectrum, is_exact, table: None, light: OnceLock::new() }
    }

    /// The same, tabulated over D: soon found for many factors.
    #[must_use]
    pub fn tabulated(self, grid: &DopplerGrid) -> Self {
        Self { table: Some(grid.table()), ..self.with_values() }
    }

    /// The same with the values of its spectrum at every nanometre.
    #[must_use]
    pub(crate) fn with_values(self) -> Self {
        Self { spectrum: self.spectrum.tabulated(), ..self }
    }

    /// False if the colour at rest is another than the one that was written.
    pub fn is_exact(&self) -> bool {
        self.is_exact
    }

    /// The spectrum at rest.
    pub fn spectrum(&self) -> &Spectrum {
        &self.spectrum
    }

    /// Its radiance at a wavelength, nm, in daylight.
    pub fn radiance(&self, nm: f64) -> f64 {
        self.light.get_or_init(|| LightSpectrum::new(&self.spectrum)).at(nm)
    }

    /// True if it was [tabulated](Self::tabulated).
    pub fn is_tabulated(&self) -> bool {
        self.table.is_some()
    }

    /// ln X, ln Y, ln Z at the points of the grid, if it was [tabulated](Self::tabulated).
    pub fn points(&self, grid: &DopplerGrid) -> Option<impl Iterator<Item = [f64; 3]>> {
        let table = self.table.as_ref()?;
        Some(
            (0..grid.n_points())
                .map(|idx| table.point(idx, |idx| grid.ln_xyz(&self.spectrum, idx))),
        )
    }

    /// X, Y, Z as seen at a ln D.  Eq. (P12), (P19)
    pub fn seen(&self, grid: &DopplerGrid, ln_doppler: f64, shift: SpectralShift) -> [f64; 3] {
        let ln_shift = shift.ln_shift(ln_doppler);
        let xyz = match &self.table {
            Some(table) => table.xyz(ln_shift, |idx| grid.ln_xyz(&self.spectrum, idx)),
            None => grid.xyz(&self.spectrum, ln_shift),
        };
        let gain = libm::exp(shift.ln_gain(ln_doppler));
        xyz.map(|part| part * gain)
    }
}
