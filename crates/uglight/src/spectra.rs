//! Spectra of the colours of a scene, tabulated over the Doppler factor.

use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use glam::DVec3;
use rayon::prelude::*;
use ugphysics::spectrum::{DopplerGrid, DopplerTable, GridPlace, InfraredRule, Spectrum};
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
    colors: Vec<TabulatedColor>,
    /// |ln D| up to which the spectra are tabulated.
    reach: f64,
    /// The corners of the lattice, behind the colours. `None` without textures.
    lattice: Option<Arc<Lattice>>,
    /// For each colour, what it is under each lamp, tabulated; made at first use, since few colours
    /// are seen under each lamp.
    lit: Vec<OnceLock<Box<[OnceLock<DopplerTable>]>>>,
    /// Lamps with such tables.
    n_lamps: usize,
}

/// A colour with the light of its spectrum over D.
struct TabulatedColor {
    color: SpectralColor,
    /// X, Y, Z of a surface; the logarithms of those of light.
    table: DopplerTable,
}

impl TabulatedColor {
    fn new(color: SpectralColor, grid: &DopplerGrid) -> Self {
        Self { color: color.with_values(), table: grid.table() }
    }

    /// X, Y, Z at a ln D and its place in the grid.
    #[inline]
    fn xyz(&self, grid: &DopplerGrid, (ln_shift, place): (f64, &GridPlace)) -> DVec3 {
        let spectrum = self.color.spectrum();
        DVec3::from_array(if spectrum.is_surface() {
            self.table.mean(place, |idx| grid.xyz_at(spectrum, idx))
        } else {
            self.table.xyz(ln_shift, |idx| grid.ln_xyz(spectrum, idx))
        })
    }
}

/// The corners of the lattice of colours; made at first use, since a texture has few of all
/// colours.
struct Lattice {
    infrared: InfraredRule,
    grid: DopplerGrid,
    corners: Box<[OnceLock<Box<TabulatedColor>>]>,
}

impl Lattice {
    /// That of the picture before, which has most of the light that the next frame of a film needs,
    /// if it is for the same grid.
    fn shared(infrared: InfraredRule, grid: DopplerGrid) -> Arc<Self> {
        static LAST: Mutex<Option<Arc<Lattice>>> = Mutex::new(None);
        let mut last = LAST.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(lattice) = &*last
            && lattice.infrared == infrared
            && lattice.grid == grid
        {
            return Arc::clone(lattice);
        }
        let corners = std::iter::repeat_with(OnceLock::new).take(N_CORNERS).collect();
        Arc::clone(last.insert(Arc::new(Self { infrared, grid, corners })))
    }

    fn corner(&self, at: usize) -> &TabulatedColor {
        self.corners[at].get_or_init(|| {
            let color = SpectralColor::of(corner(at), self.infrared);
            TabulatedColor::new(color, &self.grid).into()
        })
    }
}

/// A range of ln D, ± this, that contains ±`reach` and is the same for most speeds, so that frames
/// of a film share tables.
fn shared_reach(reach: f64) -> f64 {
    const LEAST: f64 = 0.5;
    let wider = std::iter::successors(Some(LEAST), |wide| Some(2.0 * wide));
    wider.take(8).find(|wide| *wide >= reach).unwrap_or(reach)
}

impl Spectra {
    /// `rows`: mixtures of colours. `reach`: the |ln D| that are fast to compute; for light
    /// straight from a body, its rapidity.
    pub fn new(scene: &Scene, shift: SpectralShift, rows: Vec<ColorMix>, reach: f64) -> Self {
        let ln_doppler = shift.ln_shift(reach);
        let has_textures = !scene.textures.is_empty();
        let ln_doppler = if has_textures { shared_reach(ln_doppler) } else { ln_doppler };
        let grid = DopplerGrid::new(-ln_doppler..=ln_doppler);
        let colors = (0..=scene.colors.len())
            .into_par_iter()
            .map(|row: usize| row.checked_sub(1).map(ColorId::from_index))
            .map(|color| TabulatedColor::new(SpectralColor::new(scene, color), &grid))
            .collect();
        let lattice = has_textures.then(|| Lattice::shared(shift.infrared, grid));
        Self { shift, grid, rows, colors, reach, lattice, lit: Vec::new(), n_lamps: 0 }
    }

    /// The same with tables for the light of that many lamps: without them [`Spectra::lit`]
    /// integrates each time.
    pub fn with_tables(self, n_lamps: usize) -> Self {
        let n_corners = if self.lattice.is_some() { N_CORNERS } else { 0 };
        let n_colors = if n_lamps == 0 { 0 } else { self.colors.len() + n_corners };
        let lit = std::iter::repeat_with(OnceLock::new).take(n_colors).collect();
        Self { lit, n_lamps, ..self }
    }

    /// Linear red, green and blue of a weighted mean of rows at a given ln D.  Eq. (P12), (P19)
    ///
    /// `rows`: with their weights.
    pub fn light(&self, rows: impl IntoIterator<Item = (u32, f64)>, ln_doppler: f64) -> DVec3 {
        // Rounding may exceed the rapidity slightly.
        let is_near = ln_doppler.abs() <= self.reach + 1e-9;
        let (ln_shift, gain) = (self.shift.ln_shift(ln_doppler), self.shift.ln_gain(ln_doppler));
        let place = self.grid.place(ln_shift);
        let light = |row: usize| {
            let color = self.color(row);
            if let Some(sampled_nm) = self.shift.sampled_nm {
                let own = libm::exp(ln_shift);
                DVec3::from(sampled_nm.map(|nm| color.color.radiance(f64::from(nm) * own)))
            } else if is_near {
                color.xyz(&self.grid, (ln_shift, &place))
            } else {
                DVec3::from_array(color.color.spectrum().shifted(libm::exp(ln_shift)))
            }
        };
        let mut sum = DVec3::ZERO;
        for (row, weight) in rows {
            if weight != 0.0 {
                self.for_each_part(row, |color, share| sum += weight * share * light(color));
            }
        }
        self.linear(libm::exp(gain) * sum)
    }

    /// X, Y, Z of a surface under a lamp with level 1, from its table.
    fn xyz_under_lamp(&self, row: usize, ln_shift: f64, at: usize, lamp: &Lamp) -> DVec3 {
        let under_lamps = || std::iter::repeat_with(OnceLock::new).take(self.n_lamps).collect();
        let table = self.lit[row].get_or_init(under_lamps)[at].get_or_init(|| self.grid.table());
        let surface = self.color(row).color.spectrum();
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
            let surface = self.color(row).color.spectrum();
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
    #[inline]
    fn color(&self, row: usize) -> &TabulatedColor {
        match (row.checked_sub(self.colors.len()), &self.lattice) {
            (Some(at), Some(lattice)) => lattice.corner(at),
            _ => &self.colors[row],
        }
    }

    /// Calls `take` with the rows of colours in a row of colours of vertices, or of the lattice, and
    /// their shares.
    #[inline]
    fn for_each_part(&self, row: u32, mut take: impl FnMut(usize, f64)) {
        match self.rows.get(row as usize) {
            None => take(self.colors.len() + row as usize - self.rows.len(), 1.0),
            Some(ColorMix::One(color)) => take(color_row(*color), 1.0),
            Some(mix) => mix.parts().for_each(|(color, share)| take(color_row(color), share)),
        }
    }

    /// The strongest colour of a row.
    pub fn spectrum(&self, row: u32) -> &Spectrum {
        let mut best = (0, f64::NEG_INFINITY);
        self.for_each_part(row, |color, share| {
            if share > best.1 {
                best = (color, share);
            }
        });
        self.color(best.0).color.spectrum()
    }

    /// The mean of X, Y, Z of the colours of a row, as linear red, green and blue, or of sampled
    /// radiances. `seen`: of the row of a colour.
    fn mean(&self, row: u32, seen: impl Fn(usize) -> DVec3) -> DVec3 {
        let mut xyz = DVec3::ZERO;
        self.for_each_part(row, |color, share| xyz += share * seen(color));
        self.linear(xyz)
    }

    /// Linear red, green and blue of X, Y, Z; sampled radiances as they are.
    fn linear(&self, xyz: DVec3) -> DVec3 {
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Frames of a film whose speeds differ a little share the lattice, and its light does not
    /// depend on the range of its tables.
    #[test]
    fn frames_share_the_light_of_texels() {
        let grid = |reach: f64| {
            let wide = shared_reach(reach);
            assert!(wide >= reach);
            DopplerGrid::new(-wide..=wide)
        };
        let shared = |reach: f64| Lattice::shared(InfraredRule::Measured, grid(reach));
        let slow = shared(1.1);
        assert!(Arc::ptr_eq(&slow, &shared(1.9)));
        let fast = shared(3.0);
        assert!(!Arc::ptr_eq(&slow, &fast));
        assert!([0.0, 0.3, 70.0, 500.0].map(grid).into_iter().all(|grid| grid.n_points() > 0));
        for at in [7, 4000, N_CORNERS - 1] {
            for ln in [-0.987, 0.0, 0.123, 1.045] {
                let light = |lattice: &Lattice| {
                    let place = lattice.grid.place(ln);
                    lattice.corner(at).xyz(&lattice.grid, (ln, &place))
                };
                let [a, b] = [light(&slow), light(&fast)];
                assert!((a - b).length() <= 1e-12 * a.length() && a.y > 0.0, "{at} {ln}: {a} {b}");
            }
        }
    }
}
