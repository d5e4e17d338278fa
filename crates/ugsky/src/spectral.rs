//! Spectra for light of which only red, green and blue are known, and how it is seen in motion.

use std::ops::Range;
use std::sync::OnceLock;

use rayon::prelude::*;
use thiserror::Error;
use ugphysics::spectrum::{DopplerGrid, LightSpectrum, Spectrum, integrate};
use ugphysics::{linear_srgb_to_xyz, luminance, xyz_to_linear_srgb};

/// The spectra that red, green and blue stand for. A picture determines three numbers of a
/// spectrum, and nothing of its infrared and ultraviolet parts, which motion brings into view; each
/// basis is an assumption about both.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Basis {
    /// Daylight on a mixture of white, a pair of primaries and a primary, each with the reflectance
    /// of (P20) (Smits 1999). Colours that differ little have spectra that differ little, in the
    /// infrared as well.
    Mixture,
    /// Daylight on a surface with a smooth reflectance (P20), as scenes have it. A hardly visible
    /// tint decides how much infrared light there is.
    Smooth,
    /// Sums of black bodies at three temperatures, in kelvins (Weiskopf 2000). Saturated colours
    /// need negative amounts of some.
    Planck([f64; 3]),
    /// Each colour is the black body with the same ratio of X to Z, and the same luminance. Other
    /// colours than those of black bodies change, at rest as well.
    BlackBody,
    /// Daylight, as much as the luminance of a colour: for pictures of infrared or ultraviolet
    /// light, which have no colours.
    Grey,
}

/// All wavelengths at rest, nm.
pub const ALL_NM: Range<f64> = 0.0..f64::INFINITY;

/// Why there is no table of a [`Basis`].
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum BasisError {
    /// The temperatures of [`Basis::Planck`].
    #[error(
        "black bodies at {}, {} and {} K are no basis of colours: give three different temperatures from 500 to \
         100000 K, such as 3500 5900 10000",
        .0[0], .0[1], .0[2]
    )]
    Temperatures([f64; 3]),
    /// Panoramas of infrared or ultraviolet light, or a range of wavelengths, with
    /// [`Basis::BlackBody`].
    #[error("the colours of black bodies have infrared and ultraviolet light of their own")]
    BlackBodyRange,
}

/// Step of tables of linear maps and of black bodies in ln D or ln T.
const STEP: f64 = 0.0025;

/// Distance in ln D between two entries of the tables of [`Basis::Smooth`].
const SMOOTH_STEP: f64 = 0.02;

/// |ln D| up to which light is tabulated: beyond it nothing visible is left.
const MOST_LN_DOPPLER: f64 = 12.0;

/// Number of ratios of channels at which smooth spectra are tabulated, for Doppler factors up to
/// |ln D| = `reach`: tables of more Doppler factors have fewer colours. The grid is fine because
/// reflectances that are steep at the red end go on into the infrared, where similar colours differ
/// much.
fn n_ratios(reach: f64) -> usize {
    if reach <= 3.0 { 65 } else { 33 }
}

/// The brightest channel of the surfaces of smooth spectra.
const REFLECTANCE: f64 = 0.5;

/// Temperatures that colours may have, kelvins.
const KELVIN: [f64; 2] = [500.0, 100_000.0];

/// Light as seen by an observer: a table for each basis over the Doppler factor.  Eq. (P12), (P19)
pub struct SpectralTable {
    doppler: bool,
    flux: bool,
    kind: Kind,
}

enum Kind {
    /// Matrices from linear red, green and blue at rest to those seen, by ln D.
    Linear {
        first: f64,
        maps: Vec<[[f32; 3]; 3]>,
    },
    /// ln X, ln Y, ln Z of a black body by ln T, and ln T by ln (Z/X).
    BlackBody {
        first: f64,
        points: Vec<[f32; 3]>,
        ratio: Vec<f64>,
    },
    Smooth(SmoothTable),
    /// The light seen of [`PURE`], by ln D.
    Mixture {
        first: f64,
        lights: Vec<[[f32; 3]; PURE.len()]>,
    },
}

/// White, the primaries, and the pairs that lack one of them.
const PURE: [[f64; 3]; 7] = [
    [1.0, 1.0, 1.0],
    [1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, 1.0],
    [0.0, 1.0, 1.0],
    [1.0, 0.0, 1.0],
    [1.0, 1.0, 0.0],
];

impl SpectralTable {
    /// A table for Doppler factors up to e^±`reach`. `doppler`: wavelengths are shifted; `flux`:
    /// the radiance at each wavelength is multiplied by D⁵. `range`: wavelengths at rest, nm, at
    /// which there is light, [`ALL_NM`] for [`Basis::BlackBody`], of which no part is left out.
    ///
    /// # Errors
    /// [`BasisError`].
    pub fn new(
        basis: Basis,
        doppler: bool,
        flux: bool,
        reach: f64,
        range: Range<f64>,
    ) -> Result<Self, BasisError> {
        let reach = if doppler { reach.abs().min(MOST_LN_DOPPLER) } else { 0.0 };
        let kind = match basis {
            Basis::Planck(kelvin) => planck(kelvin, reach, &range)?,
            Basis::BlackBody if range != ALL_NM => return Err(BasisError::BlackBodyRange),
            Basis::BlackBody => black_bodies(reach),
            Basis::Smooth => Kind::Smooth(SmoothTable::new(reach, range)),
            Basis::Mixture => mixture(reach, &range),
            Basis::Grey => grey(reach, &range),
        };
        Ok(Self { doppler, flux, kind })
    }

    /// Linear red, green and blue as seen with a Doppler factor. Neither is clipped.
    #[must_use]
    #[inline]
    pub fn seen(&self, rgb: [f32; 3], doppler: f64) -> [f32; 3] {
        let shift = if self.doppler { libm::log(doppler) } else { 0.0 };
        let seen = match &self.kind {
            Kind::Linear { first, maps } => {
                let (idx, part) = place(shift, *first, STEP, maps.len());
                let [low, high] = [&maps[idx], &maps[idx + 1]];
                std::array::from_fn(|i| {
                    let row: [f32; 3] = std::array::from_fn(|j| low[i][j] + part * (high[i][j] - low[i][j]));
                    row[0] * rgb[0] + row[1] * rgb[1] + row[2] * rgb[2]
                })
            }
            Kind::BlackBody { first, points, ratio } => black_body_seen(rgb, shift, *first, points, ratio),
            Kind::Smooth(table) => table.seen(rgb, shift),
            Kind::Mixture { first, lights } => {
                let (idx, part) = place(shift, *first, STEP, lights.len());
                mixture_seen(rgb, [&lights[idx], &lights[idx + 1]], part)
            }
        };
        if !self.flux {
            return seen;
        }
        let square = doppler * doppler;
        let gain = (square * square * doppler) as f32;
        seen.map(|part| part * gain)
    }
}

/// The cell of a table, and the place in it from 0 to 1; the nearer end outside of the table.
#[inline]
fn place(at: f64, first: f64, step: f64, n: usize) -> (usize, f32) {
    let at = ((at - first) / step).clamp(0.0, (n - 1) as f64);
    let idx = (at as usize).min(n - 2);
    (idx, (at - idx as f64) as f32)
}

/// ln D of the first entry of a table with 0 among its entries, and the number of its entries.
fn range_of(reach: f64, step: f64) -> (f64, usize) {
    let half = (reach / step).ceil().max(1.0);
    (-half * step, 2 * half as usize + 1)
}

/// X, Y, Z of the light of a spectrum in a range of wavelengths at rest, seen with a Doppler
/// factor, without D⁵.
fn shifted(spectrum: &LightSpectrum, range: &Range<f64>, ln_doppler: f64) -> [f64; 3] {
    let doppler = libm::exp(ln_doppler);
    let radiance = |rest_nm: f64| if range.contains(&rest_nm) { spectrum.at(rest_nm) } else { 0.0 };
    integrate(|nm| radiance(nm * doppler))
}

fn grey(reach: f64, range: &Range<f64>) -> Kind {
    let daylight = LightSpectrum::new(&Spectrum::from_linear_srgb([1.0; 3]));
    let weights = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(luminance);
    let (first, n) = range_of(reach, STEP);
    let map = |idx: usize| {
        let seen = xyz_to_linear_srgb(shifted(&daylight, range, first + STEP * idx as f64));
        seen.map(|part| weights.map(|weight| (part * weight) as f32))
    };
    Kind::Linear { first, maps: (0..n).into_par_iter().map(map).collect() }
}

fn planck(kelvin: [f64; 3], reach: f64, range: &Range<f64>) -> Result<Kind, BasisError> {
    let error = BasisError::Temperatures(kelvin);
    if kelvin.iter().any(|kelvin| !(KELVIN[0]..=KELVIN[1]).contains(kelvin)) {
        return Err(error);
    }
    let spectra = kelvin.map(|kelvin| Spectrum::blackbody(kelvin, 1.0));
    let colors = colors_of(&spectra, range);
    // The amounts of the three bodies in a colour are those of the whole light at rest.
    let rest = spectra.each_ref().map(|spectrum| xyz_to_linear_srgb(spectrum.shifted(1.0)));
    let inverse = inverse(rest).ok_or(error)?;
    let (first, n) = range_of(reach, STEP);
    let map = |idx: usize| {
        let seen = colors(first + STEP * idx as f64);
        std::array::from_fn(|i| {
            std::array::from_fn(|j| (0..3).map(|k| seen[k][i] * inverse[k][j]).sum::<f64>() as f32)
        })
    };
    Ok(Kind::Linear { first, maps: (0..n).into_par_iter().map(map).collect() })
}

/// The linear red, green and blue of spectra by ln D, without D⁵.
fn colors_of<const N: usize>(
    spectra: &[Spectrum; N],
    range: &Range<f64>,
) -> impl Fn(f64) -> [[f64; 3]; N] + Sync {
    let lights = spectra.each_ref().map(LightSpectrum::new);
    move |ln_doppler| {
        let xyz = match *range == ALL_NM {
            true => Spectrum::all_shifted(spectra.each_ref(), libm::exp(ln_doppler)),
            false => lights.each_ref().map(|light| shifted(light, range, ln_doppler)),
        };
        xyz.map(xyz_to_linear_srgb)
    }
}

fn mixture(reach: f64, range: &Range<f64>) -> Kind {
    let spectra = PURE.map(Spectrum::from_linear_srgb);
    let colors = colors_of(&spectra, range);
    let (first, n) = range_of(reach, STEP);
    let light = |idx: usize| colors(first + STEP * idx as f64).map(|rgb| rgb.map(|part| part as f32));
    Kind::Mixture { first, lights: (0..n).into_par_iter().map(light).collect() }
}

/// The light of a mixture between two entries of the table: as much white as all channels have, as
/// much of a pair as the two brighter ones have more, and the rest of the brightest.
fn mixture_seen(rgb: [f32; 3], [low, high]: [&[[f32; 3]; PURE.len()]; 2], part: f32) -> [f32; 3] {
    let rgb = rgb.map(|part| part.max(0.0));
    let mut order = [0, 1, 2];
    order.sort_by(|a, b| rgb[*a].total_cmp(&rgb[*b]));
    let [darkest, middle, brightest] = order;
    let amounts = [
        (0, rgb[darkest]),
        (4 + darkest, rgb[middle] - rgb[darkest]),
        (1 + brightest, rgb[brightest] - rgb[middle]),
    ];
    std::array::from_fn(|c| {
        amounts
            .iter()
            .map(|&(pure, amount)| amount * (low[pure][c] + part * (high[pure][c] - low[pure][c])))
            .sum()
    })
}

/// The matrix that gives the amounts of three colours in a colour; `None` if they are not
/// independent.
fn inverse(colors: [[f64; 3]; 3]) -> Option<[[f64; 3]; 3]> {
    let cross = |a: [f64; 3], b: [f64; 3]| {
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    };
    let rows = [cross(colors[1], colors[2]), cross(colors[2], colors[0]), cross(colors[0], colors[1])];
    let determinant: f64 = (0..3).map(|i| colors[0][i] * rows[0][i]).sum();
    (determinant.abs() > 1e-6).then(|| rows.map(|row| row.map(|part| part / determinant)))
}

fn black_bodies(reach: f64) -> Kind {
    let [low, high] = KELVIN.map(libm::log);
    let reference = Spectrum::blackbody(KELVIN[0], 1.0);
    let ln_xyz = |ln_kelvin: f64| reference.seen(libm::exp(ln_kelvin - low)).map(libm::log);
    let first = low - reach - STEP;
    let n = ((high + reach + STEP - first) / STEP).ceil() as usize + 1;
    // Coldest bodies have no visible light: a number that becomes 0.
    let point = |idx: usize| {
        let dark = |ln: f64| if ln.is_finite() { ln as f32 } else { -1e3 };
        ln_xyz(first + STEP * idx as f64).map(dark)
    };
    let points = (0..n).into_par_iter().map(point).collect();
    // ln (Z/X) increases with T.
    let n_ratios = ((high - low) / STEP).ceil() as usize + 1;
    let ratio = |idx: usize| {
        let [x, _, z] = ln_xyz((low + STEP * idx as f64).min(high));
        z - x
    };
    Kind::BlackBody { first, points, ratio: (0..n_ratios).into_par_iter().map(ratio).collect() }
}

fn black_body_seen(rgb: [f32; 3], shift: f64, first: f64, points: &[[f32; 3]], ratio: &[f64]) -> [f32; 3] {
    let [x, y, z] = linear_srgb_to_xyz(rgb.map(|part| f64::from(part.max(0.0))));
    if y <= 0.0 {
        return [0.0; 3];
    }
    let wanted = libm::log(z / x);
    let above = ratio.partition_point(|ratio| *ratio < wanted).clamp(1, ratio.len() - 1);
    let [from, to] = [ratio[above - 1], ratio[above]];
    let part = ((wanted - from) / (to - from)).clamp(0.0, 1.0);
    let ln_kelvin = libm::log(KELVIN[0]) + STEP * (above as f64 - 1.0 + part);
    let at = |ln_kelvin: f64| -> [f64; 3] {
        let (idx, part) = place(ln_kelvin, first, STEP, points.len());
        let [low, high] = [points[idx], points[idx + 1]];
        std::array::from_fn(|i| f64::from(low[i]) + f64::from(part) * f64::from(high[i] - low[i]))
    };
    // The table is that of the light seen, with D⁵.
    let offset = libm::log(y) - at(ln_kelvin)[1] - 5.0 * shift;
    xyz_to_linear_srgb(at(ln_kelvin + shift).map(|ln| libm::exp(ln + offset))).map(|part| part as f32)
}

/// The light of surfaces by brightest channel, ratios of the two others to it, and ln D.
struct SmoothTable {
    grid: DopplerGrid,
    /// Wavelengths at rest at which there is light, nm.
    range: Range<f64>,
    n_ratios: usize,
    /// ln D of the first column, and the number of columns.
    first: f64,
    n: usize,
    /// The light of white by ln D: in each column, and in [`WHITE_STEPS`] steps between columns.
    white: Vec<f64>,
    white_steps: Vec<f32>,
    /// Reflectances whose brightest channel is [`REFLECTANCE`]. Each is computed when it is first
    /// needed, because a picture uses few of all tabulated colours.
    surfaces: Vec<OnceLock<Spectrum>>,
    /// Their light relative to that of white, by block, brightest channel and first ratio; each has
    /// all second ratios. Computed when first needed, because a view uses few of all Doppler
    /// factors.
    strips: Vec<OnceLock<Box<[LightBlock]>>>,
}

/// Steps of the light of white from one column to the next, between which it is linear.
const WHITE_STEPS: usize = 16;

/// Columns of a block: so many that a [`LightBlock`] fills a line of the processor's cache.
const BLOCK: usize = 4;

/// Light at the columns of a block, and at the first one of the next.
#[repr(align(64))]
struct LightBlock(OnceLock<[[f32; 3]; BLOCK + 1]>);

impl SmoothTable {
    fn new(reach: f64, range: Range<f64>) -> Self {
        let (first, n) = range_of(reach, SMOOTH_STEP);
        let grid = DopplerGrid::new(first..=-first);
        let spectrum = Spectrum::from_linear_srgb([REFLECTANCE; 3]);
        let at = |idx: usize| luminance(xyz_to_linear_srgb(grid.xyz(&spectrum, ln_doppler(first, idx))));
        let white: Vec<f64> = (0..n).into_par_iter().map(|idx| at(idx) / REFLECTANCE).collect();
        let ln_white: Vec<f64> = white.iter().map(|part| libm::log(part.max(1e-300))).collect();
        let step = |idx: usize| {
            let at = idx as f64 / WHITE_STEPS as f64;
            let column = (at as usize).min(n - 2);
            let part = at - column as f64;
            libm::exp(ln_white[column] + part * (ln_white[column + 1] - ln_white[column])) as f32
        };
        let white_steps = (0..=(n - 1) * WHITE_STEPS).map(step).collect();
        let n_ratios = n_ratios(reach);
        let surfaces = (0..3 * n_ratios * n_ratios).map(|_| OnceLock::new()).collect();
        let strips = (0..n.div_ceil(BLOCK) * 3 * n_ratios).map(|_| OnceLock::new()).collect();
        Self { grid, range, n_ratios, first, n, white, white_steps, surfaces, strips }
    }

    /// The light of the surfaces with a brightest channel and a first ratio in a block.
    #[inline]
    fn strip(&self, block: usize, brightest: usize, ratio: usize) -> &[LightBlock] {
        let blank = || (0..self.n_ratios).map(|_| LightBlock(OnceLock::new())).collect();
        self.strips[(block * 3 + brightest) * self.n_ratios + ratio].get_or_init(blank)
    }

    /// The light of a surface at the Doppler factors of a block, from a column on. `brightest`: its
    /// brightest channel; `ratios`: those of the next two channels to it, in steps of the table.
    #[inline(never)]
    fn computed(&self, brightest: usize, ratios: [usize; 2], from: usize) -> [[f32; 3]; BLOCK + 1] {
        let idx = (brightest * self.n_ratios + ratios[0]) * self.n_ratios + ratios[1];
        let spectrum = self.surfaces[idx].get_or_init(|| {
            let mut rgb = [REFLECTANCE; 3];
            for (idx, ratio) in ratios.into_iter().enumerate() {
                rgb[(brightest + 1 + idx) % 3] *= ratio as f64 / (self.n_ratios - 1) as f64;
            }
            Spectrum::from_linear_srgb(rgb)
        });
        let light = (self.range != ALL_NM).then(|| LightSpectrum::new(spectrum));
        std::array::from_fn(|idx| {
            let Some(white) = self.white.get(from + idx) else { return [0.0; 3] };
            let ln_doppler = ln_doppler(self.first, from + idx);
            let seen = xyz_to_linear_srgb(match &light {
                None => self.grid.xyz(spectrum, ln_doppler),
                Some(light) => shifted(light, &self.range, ln_doppler),
            });
            seen.map(|part| (part / (REFLECTANCE * white).max(f64::MIN_POSITIVE)) as f32)
        })
    }

    fn seen(&self, rgb: [f32; 3], shift: f64) -> [f32; 3] {
        let rgb = rgb.map(|part| part.max(0.0));
        let brightest = (1..3).fold(0, |best, idx| if rgb[idx] > rgb[best] { idx } else { best });
        let most = rgb[brightest];
        if most <= 0.0 {
            return [0.0; 3];
        }
        let (at, part) = place(shift, self.first, SMOOTH_STEP, self.n);
        let ratio = |idx: usize| {
            let at = rgb[(brightest + idx) % 3] / most * (self.n_ratios - 1) as f32;
            let cell = (at as usize).min(self.n_ratios - 2);
            (cell, at - cell as f32)
        };
        let ((i, u), (j, v)) = (ratio(1), ratio(2));
        let (from, column) = (at - at % BLOCK, at % BLOCK);
        let mut sum = [0.0_f32; 3];
        for (ratios, weight) in [
            ([i, j], (1.0 - u) * (1.0 - v)),
            ([i, j + 1], (1.0 - u) * v),
            ([i + 1, j], u * (1.0 - v)),
            ([i + 1, j + 1], u * v),
        ] {
            // Surfaces without weight need not be computed: greys and primaries have one.
            if weight > 0.0 {
                let LightBlock(light) = &self.strip(at / BLOCK, brightest, ratios[0])[ratios[1]];
                let light = light.get_or_init(|| self.computed(brightest, ratios, from));
                let (low, high) = (light[column], light[column + 1]);
                (0..3).for_each(|c| sum[c] += weight * (low[c] + part * (high[c] - low[c])));
            }
        }
        let (step, rest) = place(shift, self.first, SMOOTH_STEP / WHITE_STEPS as f64, self.white_steps.len());
        let (low, high) = (self.white_steps[step], self.white_steps[step + 1]);
        let light = (low + rest * (high - low)) * most;
        sum.map(|part| light * part)
    }
}

fn ln_doppler(first: f64, idx: usize) -> f64 {
    first + SMOOTH_STEP * idx as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    const COLORS: [[f32; 3]; 5] =
        [[0.5, 0.5, 0.5], [0.5, 0.2, 0.1], [0.1, 0.5, 0.3], [0.2, 0.3, 0.5], [0.5, 0.45, 0.05]];

    const KEEPING: [Basis; 3] = [Basis::Smooth, Basis::Mixture, Basis::Planck([3500.0, 5900.0, 10_000.0])];

    #[test]
    fn colours_at_rest_are_kept() {
        for basis in KEEPING {
            let table = SpectralTable::new(basis, true, true, 1.0, ALL_NM).unwrap();
            for rgb in COLORS {
                let seen = table.seen(rgb, 1.0);
                let error = (0..3).map(|i| (seen[i] - rgb[i]).abs()).fold(0.0, f32::max);
                assert!(error < 2e-5, "{basis:?} {rgb:?} {seen:?}");
            }
        }
    }

    /// A black body of temperature T is seen as one of D T, in every basis that has it.
    #[test]
    fn black_bodies_stay_black_bodies() {
        for kelvin in [2500.0, 5900.0, 9000.0] {
            let body = Spectrum::blackbody(kelvin, 0.3);
            let rgb = xyz_to_linear_srgb(body.seen(1.0)).map(|part| part as f32);
            for basis in [Basis::BlackBody, Basis::Planck([kelvin, 4500.0, 20_000.0])] {
                let table = SpectralTable::new(basis, true, true, 1.2, ALL_NM).unwrap();
                // Rounding of the colour counts as light of the other temperatures.
                let step = if basis == Basis::BlackBody { 0.0987 } else { 0.0387 };
                for at in -12..=12 {
                    let ln_doppler = step * f64::from(at);
                    let seen = table.seen(rgb, libm::exp(ln_doppler)).map(f64::from);
                    let [x, y, z] = linear_srgb_to_xyz(seen);
                    let [x0, y0, z0] = body.seen(libm::exp(ln_doppler));
                    let (sum, sum0) = (x + y + z, x0 + y0 + z0);
                    let apart = (x / sum - x0 / sum0).abs().max((y / sum - y0 / sum0).abs());
                    assert!(apart < 1e-4, "{basis:?} {kelvin} {ln_doppler}: {apart:e}");
                    assert!((y / y0 - 1.0).abs() < 1e-3, "{basis:?} {kelvin} {ln_doppler}: {y} {y0}");
                }
            }
        }
    }

    /// Smooth spectra are those of surfaces whose brightest channel is one half.
    #[test]
    fn smooth_spectra_are_those_of_surfaces() {
        let table = SpectralTable::new(Basis::Smooth, true, true, 1.0, ALL_NM).unwrap();
        for rgb in COLORS {
            let spectrum = Spectrum::from_linear_srgb(rgb.map(f64::from));
            for step in -9..=9 {
                let ln_doppler = 0.1037 * f64::from(step);
                let seen = table.seen(rgb, libm::exp(ln_doppler)).map(f64::from);
                let exact = xyz_to_linear_srgb(spectrum.seen(libm::exp(ln_doppler)));
                let size = exact.iter().fold(1e-6, |most: f64, part| most.max(part.abs()));
                let error = (0..3).map(|i| (seen[i] - exact[i]).abs() / size).fold(0.0, f64::max);
                assert!(error < 0.1, "{rgb:?} {ln_doppler}: {seen:?} {exact:?}");
            }
        }
    }

    /// The same for many colours, saturated ones among them: the root mean square of the errors,
    /// relative to the largest channel.
    #[test]
    fn smooth_spectra_are_near_those_of_surfaces() {
        let table = SpectralTable::new(Basis::Smooth, true, true, 0.56, ALL_NM).unwrap();
        let (mut sum, mut n) = (0.0, 0.0);
        for step in 1..300_usize {
            let part = |by: f64| (step as f64 * by).fract();
            let mut rgb = [part(0.618_034), part(0.754_878), part(0.569_84)];
            if step.is_multiple_of(4) {
                rgb[step / 4 % 3] = 0.0;
            }
            let spectrum = Spectrum::from_linear_srgb(rgb);
            for ln_doppler in [-0.537, -0.241, 0.241, 0.537] {
                let seen = table.seen(rgb.map(|part| part as f32), libm::exp(ln_doppler)).map(f64::from);
                let exact = xyz_to_linear_srgb(spectrum.seen(libm::exp(ln_doppler)));
                let size = exact.iter().fold(1e-6, |most: f64, part| most.max(part.abs()));
                let error = (0..3).map(|i| (seen[i] - exact[i]).abs() / size).fold(0.0, f64::max);
                assert!(error < 0.3, "{rgb:?} {ln_doppler}: {seen:?} {exact:?}");
                sum += error * error;
                n += 1.0;
            }
        }
        assert!((sum / n).sqrt() < 0.02, "{}", (sum / n).sqrt());
    }

    /// White, primaries and pairs are the surfaces of scenes.
    #[test]
    fn mixtures_are_of_surfaces() {
        let table = SpectralTable::new(Basis::Mixture, true, true, 1.0, ALL_NM).unwrap();
        for pure in PURE {
            let spectrum = Spectrum::from_linear_srgb(pure);
            for step in -9..=9 {
                let doppler = libm::exp(0.1037 * f64::from(step));
                let seen = table.seen(pure.map(|part| part as f32), doppler).map(f64::from);
                let exact = xyz_to_linear_srgb(spectrum.seen(doppler));
                let size = exact.iter().fold(1e-6, |most: f64, part| most.max(part.abs()));
                let error = (0..3).map(|i| (seen[i] - exact[i]).abs() / size).fold(0.0, f64::max);
                assert!(error < 2e-3, "{pure:?} {doppler}: {seen:?} {exact:?}");
            }
        }
    }

    /// Along a line from one colour to another no light is darker than at its ends: the edge of a
    /// yellowish line on a bluish road is between both, as it was at rest.
    #[test]
    fn mixtures_of_similar_colours_are_between_them() {
        let table = SpectralTable::new(Basis::Mixture, true, true, 1.0, ALL_NM).unwrap();
        let [road, line] = [[0.053, 0.054, 0.062], [0.352, 0.352, 0.283]];
        for ln_doppler in [-0.6, -0.3, 0.3, 0.6, 0.9] {
            let brightness = |rgb| luminance(table.seen(rgb, libm::exp(ln_doppler)).map(f64::from));
            let [dark, bright] = [road, line].map(brightness);
            for step in 0..=20 {
                let part = 0.05 * step as f32;
                let seen = brightness(std::array::from_fn(|i| road[i] + part * (line[i] - road[i])));
                assert!(
                    seen > dark * 0.999 && seen < bright * 1.001,
                    "{ln_doppler} {part}: {dark} {seen} {bright}"
                );
            }
        }
    }

    #[test]
    fn dependent_temperatures_are_refused() {
        for kelvin in [[3500.0, 3500.0, 9000.0], [3500.0, 5900.0, f64::NAN], [1.0, 5900.0, 9000.0]] {
            assert!(SpectralTable::new(Basis::Planck(kelvin), true, true, 1.0, ALL_NM).is_err());
        }
    }

    /// The parts of a spectrum add up to the whole, and each is what is seen alone.
    #[test]
    fn parts_of_spectra_add_up() {
        let (grey, ranges) = ([0.4_f32; 3], [0.0..360.0, 360.0..830.0, 830.0..f64::INFINITY]);
        for basis in [Basis::Mixture, Basis::Smooth, Basis::Grey, Basis::Planck([3500.0, 5900.0, 10_000.0])] {
            let table = |range| SpectralTable::new(basis, true, true, 1.0, range).unwrap();
            let (whole, parts) = (table(ALL_NM), ranges.clone().map(table));
            // At rest only visible light is seen.
            assert!([0, 2].iter().all(|&part| parts[part].seen(grey, 1.0).iter().all(|c| c.abs() < 1e-6)));
            for ln_doppler in [-0.93, -0.4, -0.02, 0.0, 0.3, 0.77] {
                let all = whole.seen(grey, libm::exp(ln_doppler));
                let sum: [f32; 3] = std::array::from_fn(|i| {
                    parts.iter().map(|part| part.seen(grey, libm::exp(ln_doppler))[i]).sum()
                });
                let error = (0..3).map(|i| (sum[i] / all[i] - 1.0).abs()).fold(0.0, f32::max);
                assert!(error < 3e-3, "{basis:?} {ln_doppler}: {sum:?} {all:?}");
            }
            // Infrared light is seen when it approaches, ultraviolet light when it recedes.
            let brightness =
                |part: &SpectralTable, ln| luminance(part.seen(grey, libm::exp(ln)).map(f64::from));
            assert!(brightness(&parts[2], 0.77) > 0.1 && brightness(&parts[2], -0.77) == 0.0);
            assert!(brightness(&parts[0], -0.77) > 1e-4 && brightness(&parts[0], 0.77) == 0.0);
        }
    }
}
