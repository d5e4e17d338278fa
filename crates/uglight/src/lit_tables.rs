//! Surfaces under coloured lamps at rest with them, tabulated over the Doppler factor.

use std::sync::OnceLock;

use glam::DVec3;
use ugscene::Scene;
use ugspectrum::{DopplerGrid, DopplerTable};

use crate::{Lamp, SpectralColor, SpectralLamp, lamps, spectral_lamps};

/// The lamps of a scene, and the colours of surfaces under each.
pub(crate) struct LitTables {
    lamps: Vec<Lamp>,
    spectral: Vec<SpectralLamp>,
    /// For each colour and lamp; made at first use, since few colours are seen under each lamp.
    tables: Vec<OnceLock<DopplerTable>>,
}

impl LitTables {
    /// `eye`: in scene coordinates.
    pub(crate) fn new(scene: &Scene, eye: DVec3, n_colors: usize) -> Self {
        let (lamps, spectral) = (lamps(scene, eye), spectral_lamps(scene));
        let tables = std::iter::repeat_with(OnceLock::new).take(n_colors * lamps.len()).collect();
        Self { lamps, spectral, tables }
    }

    /// X, Y, Z of a surface at a ln D, without the factor D⁵: the sum over all lamps. `row`: of its
    /// colour. `place`: point, normal and shift as for [`crate::Lighting::level`].
    pub(crate) fn xyz(
        &self,
        (row, color): (usize, &SpectralColor),
        grid: &DopplerGrid,
        ln_doppler: f64,
        place: [DVec3; 3],
    ) -> DVec3 {
        let [point, normal, shift] = place;
        let mut sum = DVec3::ZERO;
        for (at, (lamp, spectral)) in self.lamps.iter().zip(&self.spectral).enumerate() {
            let level = spectral.intensity * lamp.shifted(shift).level_at_rest(point, normal);
            if level > 0.0 {
                let table = self.tables[row * self.lamps.len() + at].get_or_init(|| {
                    let lit = |doppler: f64| color.spectrum().under(&spectral.light, doppler, 1.0);
                    grid.table_of(|doppler| lit(doppler).unwrap_or_default())
                });
                sum += level * DVec3::from_array(table.xyz(ln_doppler));
            }
        }
        sum
    }
}
