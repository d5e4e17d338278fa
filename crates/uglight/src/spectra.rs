//! Spectra of the colours of a scene, tabulated over the Doppler factor.

use glam::DVec3;
use rayon::prelude::*;
use ugparse::{ColorId, Scene};
use ugphysics::xyz_to_linear_srgb;
use ugscene::Shares;
use ugspectrum::DopplerGrid;

use crate::{SpectralColor, SpectralShift};

/// The apparent light of mixtures of spectra as a function of the Doppler factor.
pub struct Spectra {
    shift: SpectralShift,
    grid: DopplerGrid,
    /// For each row, the colours that are mixed, with their shares.
    rows: Vec<Shares>,
    /// White, followed by the colours of the scene.
    colors: Vec<SpectralColor>,
}

impl Spectra {
    /// `rows`: mixtures of colours. `rapidity`: the greatest rapidity of a body.
    pub fn new(scene: &Scene, shift: SpectralShift, rows: Vec<Shares>, rapidity: f64) -> Self {
        // D is between e^−η and e^η.
        let ln_doppler = shift.ln_shift(rapidity);
        let grid = DopplerGrid::new(-ln_doppler..=ln_doppler);
        let colors = (0..=scene.colors.len())
            .into_par_iter()
            .map(|row: usize| row.checked_sub(1).map(ColorId::from_index))
            .map(|color| SpectralColor::new(scene, color).tabulated(&grid))
            .collect();
        Self { shift, grid, rows, colors }
    }

    /// Linear red, green and blue of a row at a given ln D.  Eq. (P12), (P19)
    pub fn light(&self, row: u32, ln_doppler: f64) -> DVec3 {
        let seen = |(color, share): (Option<ColorId>, f64)| {
            let row = color.map_or(0, |color| color.index() + 1);
            share * DVec3::from_array(self.colors[row].seen(&self.grid, ln_doppler, self.shift))
        };
        let xyz: DVec3 = self.rows[row as usize].parts().map(seen).sum();
        DVec3::from_array(xyz_to_linear_srgb(xyz.to_array()))
    }
}
