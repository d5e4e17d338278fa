//! How one colour of a scene looks in motion.

use ugparse::{ColorId, Scene};
use ugspectrum::{DopplerGrid, DopplerTable, Spectrum};

/// Which parts of (P12) are done: L(λ) = D⁵ L'(λD) has a shift, and a factor.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Motion {
    /// L'(λD) instead of L'(λ).
    pub doppler: bool,
    /// D⁵.
    pub flux: bool,
}

impl Motion {
    /// ln of the D that shifts.
    pub fn shift(self, ln_doppler: f64) -> f64 {
        if self.doppler { ln_doppler } else { 0.0 }
    }

    /// ln of the factor.
    pub fn gain(self, ln_doppler: f64) -> f64 {
        if self.flux { 5.0 * ln_doppler } else { 0.0 }
    }
}

/// The spectrum of a colour.
pub(crate) struct Look {
    spectrum: Spectrum,
    is_exact: bool,
    table: Option<DopplerTable>,
}

impl Look {
    /// Of a colour of the scene, or white; tabulated if there is a grid.
    pub fn new(scene: &Scene, color: Option<ColorId>, grid: Option<&DopplerGrid>) -> Self {
        let (spectrum, is_exact) = match color {
            Some(color) => uglight::spectrum(scene, &scene.colors[color.index()]),
            None => (Spectrum::from_linear_srgb([1.0; 3]), true),
        };
        Self { table: grid.map(|grid| grid.table(&spectrum)), spectrum, is_exact }
    }

    /// False if the colour at rest is another than the one that was written.
    pub fn is_exact(&self) -> bool {
        self.is_exact
    }

    pub fn table(&self) -> Option<&DopplerTable> {
        self.table.as_ref()
    }

    /// X, Y, Z under a ln D.
    pub fn seen(&self, grid: &DopplerGrid, ln_doppler: f64, motion: Motion) -> [f64; 3] {
        let shift = motion.shift(ln_doppler);
        let xyz = match &self.table {
            Some(table) => table.xyz(shift),
            None => grid.xyz(&self.spectrum, shift),
        };
        let gain = libm::exp(motion.gain(ln_doppler));
        xyz.map(|part| part * gain)
    }
}
