//! Spectra of the colours of a scene, tabulated over the Doppler factor.

use std::sync::OnceLock;

use glam::DVec3;
use rayon::prelude::*;
use ugphysics::spectrum::{DopplerGrid, DopplerTable, Spectrum};
use ugphysics::xyz_to_linear_srgb;
use ugscene::{ColorId, ColorMix, Scene};

use crate::color_lattice::{N_CORNERS, corner, mixture};
use crate::{Irradiance, Lamp, SpectralColor, SpectralFilter, SpectralShift};

/// Rows of spectra with their weights: of the corners of a face, or of the mixture of a texel.
pub type SpectralRows = [(u32, f64); 4];

/// The apparent light of mixtures of spectra as a function of the Doppler factor.
pub struct Spectra {
    shift: SpectralShift,
    grid: DopplerGrid,
    /// For each row, the colours that are mixed, with their shares.
    rows: Vec<ColorMix>,
    /// White, followed by the colours of the scene.
    colors: Vec<SpectralColor>,
    /// |ln D| up to which the spectra are tabulated.
    reach: f64,
    /// The corners of the lattice, behind the colours; made at first use, since a texture has few
    /// of all colours. Empty without textures.
    lattice: Vec<OnceLock<SpectralColor>>,
    /// For each colour, what it is under each lamp, tabulated; made at first use, since few colours
    /// are seen under each lamp.
    lit: Vec<OnceLock<Box<[OnceLock<DopplerTable>]>>>,
    /// Lamps with such tables.
    n_lamps: usize,
}

impl Spectra {
    /// `rows`: mixtures of colours. `reach`: the |ln D| that are fast to compute; for light
    /// straight from a body, its rapidity.
    pub fn new(scene: &Scene, shift: SpectralShift, rows: Vec<ColorMix>, reach: f64) -> Self {
        let ln_doppler = shift.ln_shift(reach);
        let grid = DopplerGrid::new(-ln_doppler..=ln_doppler);
        let colors = (0..=scene.colors.len())
            .into_par_iter()
            .map(|row: usize| row.checked_sub(1).map(ColorId::from_index))
            .map(|color| SpectralColor::new(scene, color).tabulated(&grid))
            .collect();
        let n_corners = if scene.textures.is_empty() { 0 } else { N_CORNERS };
        let lattice = std::iter::repeat_with(OnceLock::new).take(n_corners).collect();
        Self { shift, grid, rows, colors, reach, lattice, lit: Vec::new(), n_lamps: 0 }
    }

    /// The same with tables for the light of that many lamps: without them [`Spectra::lit`]
    /// integrates each time.
    pub fn with_tables(self, n_lamps: usize) -> Self {
        let n_colors = self.colors.len() + self.lattice.len();
        let lit = std::iter::repeat_with(OnceLock::new).take(n_colors).collect();
        Self { lit, n_lamps, ..self }
    }

    /// Linear red, green and blue of a row at a given ln D.  Eq. (P12), (P19)
    pub fn light(&self, row: u32, ln_doppler: f64) -> DVec3 {
        // Rounding may exceed the rapidity slightly.
        let is_near = ln_doppler.abs() <= self.reach + 1e-9;
        let (ln_shift, gain) = (self.shift.ln_shift(ln_doppler), self.shift.ln_gain(ln_doppler));
        self.mean(row, |row| {
            let color = self.color(row);
            if let Some(sampled_nm) = self.shift.sampled_nm {
                let own = libm::exp(ln_shift);
                return libm::exp(gain)
                    * DVec3::from(sampled_nm.map(|nm| color.radiance(f64::from(nm) * own)));
            }
            if is_near {
                return DVec3::from_array(color.seen(&self.grid, ln_doppler, self.shift));
            }
            libm::exp(gain) * DVec3::from_array(color.spectrum().shifted(libm::exp(ln_shift)))
        })
    }

    /// X, Y, Z of a surface under a lamp with level 1, from its table.
    fn xyz_under_lamp(&self, row: usize, ln_shift: f64, at: usize, lamp: &Lamp) -> DVec3 {
        let under_lamps = || std::iter::repeat_with(OnceLock::new).take(self.n_lamps).collect();
        let table = self.lit[row].get_or_init(under_lamps)[at].get_or_init(|| self.grid.table());
        let surface = self.color(row).spectrum();
        let lit = |idx: usize| {
            let lit = surface.under(lamp.spectrum(), self.grid.doppler(idx), 1.0);
            lit.unwrap_or_default().map(libm::log)
        };
        DVec3::from_array(table.xyz(ln_shift, lit))
    }

    /// Linear red, green and blue of a row under several lamps, behind filters.  Eq. (P14), (P19)
    pub fn lit(
        &self,
        row: u32,
        doppler: f64,
        light: &[Irradiance],
        lamps: &[Lamp],
        filters: &[SpectralFilter<'_>],
    ) -> DVec3 {
        let ln_doppler = libm::log(doppler);
        let is_tabulated = self.n_lamps > 0
            && filters.is_empty()
            && ln_doppler.abs() <= self.reach + 1e-9
            && light.iter().all(|part| part.doppler == 1.0);
        let (ln_shift, gain) = (self.shift.ln_shift(ln_doppler), self.shift.ln_gain(ln_doppler));
        self.mean(row, |row| {
            let surface = self.color(row).spectrum();
            if !is_tabulated || !surface.is_surface() {
                return self.shift.seen_lit(surface, doppler, light, lamps, filters);
            }
            let part = |part: &Irradiance| {
                let lamp = &lamps[part.lamp as usize];
                part.level
                    * lamp.intensity
                    * self.xyz_under_lamp(row, ln_shift, part.lamp as usize, lamp)
            };
            libm::exp(gain) * light.iter().map(part).sum::<DVec3>()
        })
    }

    /// The rows of a mixture that is seen as a colour of a texture.  Eq. (P51)
    pub fn texel_rows(&self, light: DVec3) -> SpectralRows {
        // Colours of vertices are not more than 2^32 with the lattice.
        let first = self.rows.len() as u32;
        mixture(light).map(|(corner, share)| (first + corner, share))
    }

    /// The colour of this row of the colours, or of the lattice behind them.
    fn color(&self, row: usize) -> &SpectralColor {
        match row.checked_sub(self.colors.len()) {
            None => &self.colors[row],
            Some(at) => self.lattice[at].get_or_init(|| {
                SpectralColor::of(corner(at), self.shift.infrared).tabulated(&self.grid)
            }),
        }
    }

    /// The rows of colours in a row of colours of vertices, or of the lattice, with their shares.
    fn parts(&self, row: u32) -> impl Iterator<Item = (usize, f64)> {
        let mix = self.rows.get(row as usize);
        let corner =
            mix.is_none().then(|| (self.colors.len() + row as usize - self.rows.len(), 1.0));
        let parts = mix.into_iter().flat_map(|mix| mix.parts());
        parts.map(|(color, share)| (color_row(color), share)).chain(corner)
    }

    /// The strongest colour of a row.
    pub fn spectrum(&self, row: u32) -> &Spectrum {
        let strongest =
            self.parts(row).reduce(|best, part| if part.1 > best.1 { part } else { best });
        self.color(strongest.map_or(0, |(color, _)| color)).spectrum()
    }

    /// The mean of X, Y, Z of the colours of a row, as linear red, green and blue, or of sampled
    /// radiances. `seen`: of the row of a colour.
    fn mean(&self, row: u32, seen: impl Fn(usize) -> DVec3) -> DVec3 {
        let xyz: DVec3 = self.parts(row).map(|(color, share)| share * seen(color)).sum();
        if self.shift.sampled_nm.is_some() {
            return xyz;
        }
        let limited = ugphysics::limited(xyz.to_array(), ugphysics::MOST_LIGHT);
        DVec3::from_array(xyz_to_linear_srgb(limited))
    }
}

/// The row of a colour behind white, which comes first.
fn color_row(color: Option<ColorId>) -> usize {
    color.map_or(0, |color| color.index() + 1)
}
