//! X, Y, Z of a spectrum tabulated over a range of Doppler factors.

use std::ops::RangeInclusive;
use std::sync::{LazyLock, OnceLock};

use crate::spectrum::curve::Functions;
use crate::spectrum::quadrature::{N_NODES, Quadrature};
use crate::spectrum::radiance::{Kind, MAX_LN_DOPPLER, Spectrum};
use crate::spectrum::reflectance::Reflectance;
use crate::spectrum::weighted_daylight::WeightedDaylight;

/// Step of a table in ln D. A step shifts wavelengths by one percent, about 5 nm.
///
/// Interpolation errors, measured on 125 surfaces from greys to the primaries and on black bodies,
/// are below 4·10⁻⁴ of the largest of X, Y and Z: a colour difference ΔE*ab below 0.04. Part of
/// that comes from summing over whole nanometres, across the corners of the piecewise linear
/// daylight table.
pub const LN_STEP: f64 = 0.01;

/// Number of extra points at each end of the table, for the cubic interpolation.
const MARGIN: i32 = 2;

/// The Doppler factors of tables: e^(0.01 k) over a range with margins, always including D = 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DopplerGrid {
    first: i32,
    last: i32,
}

/// Rows of the widest grid on each side of D = 1.
const MOST_ROWS: usize = (MAX_LN_DOPPLER / LN_STEP) as usize + 1 + MARGIN as usize;

/// Values at the Doppler factors of the widest grid, computed when they are first read.
type Rows<T> = LazyLock<Box<[OnceLock<Box<T>>]>>;

/// Weighted daylight, for all surfaces of all scenes.
static LIGHT: Rows<WeightedDaylight> = LazyLock::new(|| empty(2 * MOST_ROWS + 1));

/// Quadrature weights for [`DopplerGrid::xyz`].
static NODES: Rows<Quadrature<N_NODES>> = LazyLock::new(|| empty(2 * MOST_ROWS + 1));

impl DopplerGrid {
    /// A grid that covers a range of ln D.
    pub fn new(ln_doppler: RangeInclusive<f64>) -> Self {
        let row = |ln: f64| (ln.clamp(-MAX_LN_DOPPLER, MAX_LN_DOPPLER) / LN_STEP).floor() as i32;
        let first = row(*ln_doppler.start()).min(0) - MARGIN;
        let last = row(*ln_doppler.end()).max(0) + 1 + MARGIN;
        Self { first, last }
    }

    /// The number of Doppler factors.
    pub fn n_points(&self) -> usize {
        (self.last - self.first + 1) as usize
    }

    /// The ln D of each, in increasing order.
    pub fn ln_doppler(&self) -> impl Iterator<Item = f64> {
        (self.first..=self.last).map(|row| f64::from(row) * LN_STEP)
    }

    /// The Doppler factor of a point.
    pub fn doppler(&self, idx: usize) -> f64 {
        libm::exp(f64::from(self.first + idx as i32) * LN_STEP)
    }

    /// ln X, ln Y, ln Z of a spectrum at a point; −∞ where there is no light.
    pub fn ln_xyz(&self, spectrum: &Spectrum, idx: usize) -> [f64; 3] {
        match &spectrum.0 {
            Kind::Reflected(surface) => surface.xyz_under(self.light(idx)).map(libm::log),
            _ => spectrum.ln_shifted(self.doppler(idx)),
        }
    }

    /// X, Y, Z of a spectrum at a point.
    pub fn xyz_at(&self, spectrum: &Spectrum, idx: usize) -> [f64; 3] {
        match &spectrum.0 {
            Kind::Reflected(surface) => surface.xyz_under(self.light(idx)),
            _ => spectrum.shifted(self.doppler(idx)),
        }
    }

    /// Where a ln D is between the points, for [`DopplerTable::mean`].
    pub fn place(&self, ln_doppler: f64) -> GridPlace {
        let Cell { idx, fraction } = Cell::new(self.first, self.n_points(), ln_doppler);
        GridPlace { idx, fraction, weights: weights(fraction) }
    }

    /// A table whose points are computed when they are first read.
    pub fn table(&self) -> DopplerTable {
        DopplerTable {
            first: self.first,
            n_points: self.n_points(),
            chunks: empty(self.n_points().div_ceil(CHUNK)),
        }
    }

    /// X, Y, Z as from [`Spectrum::shifted`], at one ln D and without a table. For surfaces the
    /// integrals use the reflectance every 2 nm, with weights that the grid caches. Exact at the
    /// grid's own Doppler factors, and so at rest.
    pub fn xyz(&self, spectrum: &Spectrum, ln_doppler: f64) -> [f64; 3] {
        let Kind::Reflected(surface) = &spectrum.0 else {
            return spectrum.shifted(libm::exp(ln_doppler));
        };
        let cell = Cell::new(self.first, self.n_points(), ln_doppler);
        if cell.fraction == 0.0 {
            return surface.xyz_under(self.light(cell.idx));
        }
        let nodes = |idx: usize| {
            let new = || Box::new(Quadrature::new(self.light(idx)));
            &**NODES[self.row(idx)].get_or_init(new)
        };
        cell.interpolate(ln_xyz_at_nodes(surface, std::array::from_fn(|i| nodes(cell.idx + i - 1))))
    }

    fn light(&self, idx: usize) -> &'static WeightedDaylight {
        LIGHT[self.row(idx)].get_or_init(|| Box::new(WeightedDaylight::new(self.doppler(idx))))
    }

    /// The row of a point in the widest grid.
    fn row(&self, idx: usize) -> usize {
        (self.first + idx as i32 + MOST_ROWS as i32) as usize
    }
}

fn empty<T>(n: usize) -> Box<[OnceLock<T>]> {
    std::iter::repeat_with(OnceLock::new).take(n).collect()
}

/// ln X, ln Y, ln Z of a surface at four points.
fn ln_xyz_at_nodes(surface: &Reflectance, around: [&Quadrature<N_NODES>; 4]) -> [[f64; 3]; 4] {
    static FUNCTIONS: LazyLock<Functions<N_NODES>> = LazyLock::new(Functions::new);
    let values = surface.curve().map_or([1.0; N_NODES], |curve| FUNCTIONS.curve(&curve));
    // Interpolation polynomials can fall slightly below 0.
    around.map(|nodes| surface.xyz_at_nodes(&values, nodes).map(|sum| libm::log(sum.max(0.0))))
}

/// Points of a [`DopplerTable`] that are allocated together.
const CHUNK: usize = 16;

type Chunk = Box<[OnceLock<[f64; 3]>; CHUNK]>;

/// A table over ln D of ln X, ln Y, ln Z of L(λ) = L'(λD), without the factor D⁵, whose points are
/// computed when they are first read.  Eq. (P12), (P19)
///
/// Logarithms, because far from D = 1 mainly the exponential tail of Planck's law is left. A cubic
/// through four points does not follow it well, but its logarithm is nearly linear. Where a point
/// has no light (logarithm −∞), X, Y, Z themselves are interpolated linearly instead.
#[derive(Clone, Debug)]
pub struct DopplerTable {
    /// ln D of the first point, in steps of [`LN_STEP`].
    first: i32,
    n_points: usize,
    chunks: Box<[OnceLock<Chunk>]>,
}

impl DopplerTable {
    /// X, Y, Z interpolated at a ln D. Outside the table's range, the values at its nearer end.
    /// `ln_xyz`: computes the logarithms at a grid point; pass the same function in every call.
    ///
    /// ```
    /// use ugphysics::spectrum::{DopplerGrid, Spectrum};
    ///
    /// let green = Spectrum::from_linear_srgb([0.1, 0.5, 0.1]);
    /// let grid = DopplerGrid::new(-1.0..=1.0);
    /// let [_, near, _] = grid.table().xyz(0.123_f64, |idx| grid.ln_xyz(&green, idx));
    /// let [_, exact, _] = green.shifted(1.130_884_420_947_05);
    /// assert!((near / exact - 1.0).abs() < 3e-4);
    /// ```
    pub fn xyz(&self, ln_doppler: f64, ln_xyz: impl Fn(usize) -> [f64; 3]) -> [f64; 3] {
        let cell = Cell::new(self.first, self.n_points, ln_doppler);
        if cell.fraction == 0.0 {
            return self.point(cell.idx, ln_xyz).map(libm::exp);
        }
        cell.interpolate(std::array::from_fn(|i| self.point(cell.idx + i - 1, &ln_xyz)))
    }

    /// X, Y, Z at a place, of a table that has X, Y and Z themselves: those of surfaces in daylight
    /// fall so slowly that a cubic through them is as near as through their logarithms, and takes
    /// no exponential functions. Where a point has no light they are interpolated linearly.
    ///
    /// `xyz`: computes X, Y and Z at a grid point; pass the same function in every call.
    #[inline]
    pub fn mean(&self, place: &GridPlace, xyz: impl Fn(usize) -> [f64; 3]) -> [f64; 3] {
        if place.fraction == 0.0 {
            return self.point(place.idx, xyz);
        }
        let points: [_; 4] = std::array::from_fn(|i| self.point(place.idx + i - 1, &xyz));
        let [before, from, to, behind] = points;
        std::array::from_fn(|i| {
            if before[i] > 0.0 && from[i] > 0.0 && to[i] > 0.0 && behind[i] > 0.0 {
                let [a, b, c, d] = place.weights;
                // Between points of very different light a cubic may fall below 0.
                (b * from[i] + c * to[i] + a * before[i] + d * behind[i]).max(0.0)
            } else {
                from[i] + place.fraction * (to[i] - from[i])
            }
        })
    }

    /// The numbers at a point of the grid.
    #[inline]
    pub fn point(&self, idx: usize, ln_xyz: impl Fn(usize) -> [f64; 3]) -> [f64; 3] {
        let chunk =
            self.chunks[idx / CHUNK].get_or_init(|| Box::new([const { OnceLock::new() }; CHUNK]));
        *chunk[idx % CHUNK].get_or_init(|| ln_xyz(idx))
    }
}

/// A place between the points of a grid.
#[derive(Clone, Copy, Debug)]
pub struct GridPlace {
    idx: usize,
    fraction: f64,
    /// Of the point before the cell, its two ends, and the point after it.
    weights: [f64; 4],
}

/// The cell of a table in which a ln D lies.
pub(crate) struct Cell {
    /// Index of the point at the cell's start.
    pub idx: usize,
    /// Position within the cell, 0 to 1.
    pub fraction: f64,
}

impl Cell {
    pub fn new(first: i32, n_points: usize, ln_doppler: f64) -> Self {
        let last_cell = n_points - 1 - MARGIN as usize;
        let at = (ln_doppler / LN_STEP - f64::from(first)).clamp(1.0, last_cell as f64 + 1.0);
        // ln D of a point is rounded.
        let nearest = at.round();
        let at = if (at - nearest).abs() < 1e-9 { nearest } else { at };
        let idx = (at as usize).min(last_cell);
        Self { idx, fraction: at - idx as f64 }
    }

    /// X, Y, Z interpolated from the logarithms at the point before the cell, its two ends, and the
    /// point after it.
    pub fn interpolate(&self, [before, from, to, behind]: [[f64; 3]; 4]) -> [f64; 3] {
        std::array::from_fn(|i| {
            let ends = [before[i], from[i], to[i], behind[i]];
            if ends.iter().all(|ln| ln.is_finite()) {
                libm::exp(cubic(ends, self.fraction))
            } else {
                let (from, to) = (libm::exp(from[i]), libm::exp(to[i]));
                from + self.fraction * (to - from)
            }
        })
    }
}

/// The cubic through values at −1, 0, 1, 2, evaluated at `s` in 0…1.
fn cubic([before, from, to, behind]: [f64; 4], s: f64) -> f64 {
    let [a, b, c, d] = weights(s);
    from * b + to * c + before * a + behind * d
}

/// The weights of values at −1, 0, 1, 2 in the cubic through them, at `s` in 0…1.
fn weights(s: f64) -> [f64; 4] {
    let (ahead, back, far) = (s + 1.0, 1.0 - s, 2.0 - s);
    [
        -(s * back * far / 6.0),
        ahead * back * far / 2.0,
        ahead * s * far / 2.0,
        -(ahead * s * back / 6.0),
    ]
}
