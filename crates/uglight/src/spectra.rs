//! Spectra of the colours of a scene, tabulated over the Doppler factor.

use glam::DVec3;
use rayon::prelude::*;
use ugphysics::xyz_to_linear_srgb;
use ugscene::{ColorId, Scene, Shares};
use ugspectrum::{DopplerGrid, Spectrum};

use crate::lit_tables::LitTables;
use crate::{Irradiance, SpectralColor, SpectralFilter, SpectralLamp, SpectralShift};

/// The apparent light of mixtures of spectra as a function of the Doppler factor.
pub struct Spectra {
    shift: SpectralShift,
    grid: DopplerGrid,
    /// For each row, the colours that are mixed, with their shares.
    rows: Vec<Shares>,
    /// White, followed by the colours of the scene.
    colors: Vec<SpectralColor>,
    /// |ln D| up to which the spectra are tabulated.
    reach: f64,
    /// Colours under the lamps of the scene; `None` if all of these are daylight.
    lit: Option<LitTables>,
}

impl Spectra {
    /// `rows`: mixtures of colours. `reach`: the |ln D| that are fast to compute; for light
    /// straight from a body, its rapidity.
    pub fn new(scene: &Scene, shift: SpectralShift, rows: Vec<Shares>, reach: f64) -> Self {
        let ln_doppler = shift.ln_shift(reach);
        let grid = DopplerGrid::new(-ln_doppler..=ln_doppler);
        let colors = (0..=scene.colors.len())
            .into_par_iter()
            .map(|row: usize| row.checked_sub(1).map(ColorId::from_index))
            .map(|color| SpectralColor::new(scene, color).tabulated(&grid))
            .collect();
        Self { shift, grid, rows, colors, reach, lit: None }
    }

    /// The same, with the lamps of the scene for [`Spectra::light_of_lamps`]. `eye`: in scene
    /// coordinates.
    pub fn with_lamps(self, scene: &Scene, eye: DVec3) -> Self {
        let lit = crate::has_colored_lamps(scene).then(|| LitTables::new(scene, eye, self.colors.len()));
        Self { lit, ..self }
    }

    /// True if the scene has coloured lamps.
    pub fn has_colored_lamps(&self) -> bool {
        self.lit.is_some()
    }

    /// Linear red, green and blue of a row under the lamps of the scene, at rest with it, at a ln D
    /// within the reach; 0 without coloured lamps. Black bodies and samples are not lit.  Eq. (P14)
    ///
    /// `place`: point, normal and shift of lamps as for [`crate::Lighting::level`].
    pub fn light_of_lamps(&self, row: u32, ln_doppler: f64, place: [DVec3; 3]) -> DVec3 {
        let Some(lit) = &self.lit else { return DVec3::ZERO };
        let ln_shift = self.shift.ln_shift(ln_doppler);
        let gain = libm::exp(self.shift.ln_gain(ln_doppler));
        let seen = |color: Option<ColorId>| {
            let row = color.map_or(0, |color| color.index() + 1);
            let color = &self.colors[row];
            if color.spectrum().is_surface() {
                gain * lit.xyz((row, color), &self.grid, ln_shift, place)
            } else {
                DVec3::from_array(color.seen(&self.grid, ln_doppler, self.shift))
            }
        };
        let parts = self.rows[row as usize].parts();
        let xyz: DVec3 = parts.map(|(color, share)| share * seen(color)).sum();
        DVec3::from_array(xyz_to_linear_srgb(xyz.to_array()))
    }

    /// Linear red, green and blue of a row at a given ln D.  Eq. (P12), (P19)
    pub fn light(&self, row: u32, ln_doppler: f64) -> DVec3 {
        // Rounding may exceed the rapidity slightly.
        let is_near = ln_doppler.abs() <= self.reach + 1e-9;
        self.mean(row, |color| {
            if is_near {
                return DVec3::from_array(color.seen(&self.grid, ln_doppler, self.shift));
            }
            let gain = libm::exp(self.shift.ln_gain(ln_doppler));
            let shifted = color.spectrum().shifted(libm::exp(self.shift.ln_shift(ln_doppler)));
            gain * DVec3::from_array(shifted)
        })
    }

    /// Linear red, green and blue of a row under several lamps, behind filters.  Eq. (P14), (P19)
    pub fn lit(
        &self,
        row: u32,
        doppler: f64,
        light: &[Irradiance],
        lamps: &[SpectralLamp],
        filters: &[SpectralFilter<'_>],
    ) -> DVec3 {
        self.mean(row, |color| match filters {
            [] => self.shift.seen_lit(color.spectrum(), doppler, light, lamps),
            _ => self.shift.seen_filtered(color.spectrum(), doppler, light, lamps, filters),
        })
    }

    /// The strongest colour of a row.
    pub fn spectrum(&self, row: u32) -> &Spectrum {
        let parts = self.rows[row as usize].parts();
        let strongest = parts.reduce(|best, part| if part.1 > best.1 { part } else { best });
        self.color(strongest.and_then(|(color, _)| color)).spectrum()
    }

    /// The mean of X, Y, Z of the colours of a row, as linear red, green and blue.
    fn mean(&self, row: u32, seen: impl Fn(&SpectralColor) -> DVec3) -> DVec3 {
        let parts = self.rows[row as usize].parts();
        let xyz: DVec3 = parts.map(|(color, share)| share * seen(self.color(color))).sum();
        DVec3::from_array(xyz_to_linear_srgb(xyz.to_array()))
    }

    fn color(&self, color: Option<ColorId>) -> &SpectralColor {
        &self.colors[color.map_or(0, |color| color.index() + 1)]
    }
}
