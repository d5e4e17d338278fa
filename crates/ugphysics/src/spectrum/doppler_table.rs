//! X, Y, Z of a spectrum tabulated over a range of Doppler factors.

use std::ops::RangeInclusive;
use std::sync::OnceLock;

use crate::spectrum::quadrature::{N_NODES, Quadrature};
use crate::spectrum::radiance::{Kind, MAX_LN_DOPPLER, Spectrum};
use crate::spectrum::reflectance::Reflectance;
use crate::spectrum::weighted_daylight::WeightedDaylight;

/// Step of a table in ln D. A step shifts wavelengths by one percent, about 5 nm.
///
/// Interpolation errors, measured on 125 surfaces from greys to the primaries and on black bodies,
/// are below 3·10⁻⁴ of the largest of X, Y and Z: a colour difference ΔE*ab below 0.1. Half of that
/// comes from summing over whole nanometres, across the corners of the piecewise linear daylight
/// table.
pub const LN_STEP: f64 = 0.01;

/// Number of extra points at each end of the table, for the cubic interpolation.
const MARGIN: i32 = 2;

/// The Doppler factors of tables: e^(0.01 k) over a range with margins, always including D = 1.
#[derive(Debug)]
pub struct DopplerGrid {
    first: i32,
    last: i32,
    /// Weighted daylight at each factor, computed once for all surfaces.
    light: OnceLock<Vec<WeightedDaylight>>,
    /// Quadrature weights at each factor by each rule for infrared, for [`DopplerGrid::xyz`].
    nodes: [OnceLock<Vec<Quadrature<N_NODES>>>; 2],
}

impl DopplerGrid {
    /// A grid that covers a range of ln D.
    pub fn new(ln_doppler: RangeInclusive<f64>) -> Self {
        let row = |ln: f64| (ln.clamp(-MAX_LN_DOPPLER, MAX_LN_DOPPLER) / LN_STEP).floor() as i32;
        Self {
            first: row(*ln_doppler.start()).min(0) - MARGIN,
            last: row(*ln_doppler.end()).max(0) + 1 + MARGIN,
            light: OnceLock::new(),
            nodes: [const { OnceLock::new() }; 2],
        }
    }

    /// The number of Doppler factors.
    pub fn n_points(&self) -> usize {
        (self.last - self.first + 1) as usize
    }

    /// The ln D of each, in increasing order.
    pub fn ln_doppler(&self) -> impl Iterator<Item = f64> {
        (self.first..=self.last).map(|row| f64::from(row) * LN_STEP)
    }

    /// Tabulates a spectrum at every Doppler factor of the grid.
    pub fn table(&self, spectrum: &Spectrum) -> DopplerTable {
        let points = match &spectrum.0 {
            Kind::Reflected(surface) => {
                self.light().iter().map(|light| surface.xyz_under(light).map(libm::log)).collect()
            }
            _ => self.factors().map(|doppler| spectrum.ln_shifted(doppler)).collect(),
        };
        DopplerTable { first: self.first, points }
    }

    /// A table whose points are computed when they are first read.
    pub fn lazy_table(&self) -> LazyTable {
        let chunks = std::iter::repeat_with(OnceLock::new).take(self.n_points().div_ceil(CHUNK)).collect();
        LazyTable { first: self.first, n_points: self.n_points(), chunks }
    }

    /// X, Y, Z as from [`Spectrum::shifted`], at one ln D and without a table. For surfaces the
    /// integrals use the reflectance every 4 nm, with weights that the grid caches. Exact at the
    /// grid's own Doppler factors, and so at rest.
    pub fn xyz(&self, spectrum: &Spectrum, ln_doppler: f64) -> [f64; 3] {
        let Kind::Reflected(surface) = &spectrum.0 else { return spectrum.shifted(libm::exp(ln_doppler)) };
        let cell = Cell::new(self.first, self.n_points(), ln_doppler);
        if cell.fraction == 0.0 {
            return surface.xyz_under(&self.light()[cell.idx]);
        }
        let rule = surface.rule();
        let nodes = || self.light().iter().map(|light| Quadrature::new(light, rule)).collect();
        let nodes = self.nodes[rule as usize].get_or_init(nodes);
        cell.interpolate(ln_xyz_at_nodes(surface, &nodes[cell.idx - 1..cell.idx + 3]))
    }

    fn light(&self) -> &[WeightedDaylight] {
        self.light.get_or_init(|| self.factors().map(WeightedDaylight::new).collect())
    }

    fn factors(&self) -> impl Iterator<Item = f64> {
        self.ln_doppler().map(libm::exp)
    }
}

/// ln X, ln Y, ln Z of a surface at four points.
fn ln_xyz_at_nodes(surface: &Reflectance, around: &[Quadrature<N_NODES>]) -> [[f64; 3]; 4] {
    let values = surface.curve().map_or([1.0; N_NODES], |curve| around[0].curve(curve));
    // Interpolation polynomials can fall slightly below 0.
    std::array::from_fn(|k| surface.xyz_at_nodes(&values, &around[k]).map(|sum| libm::log(sum.max(0.0))))
}

/// A table over ln D of ln X, ln Y, ln Z of L(λ) = L'(λD), without the factor D⁵.  Eq. (P12), (P19)
///
/// Logarithms, because far from D = 1 mainly the exponential tail of Planck's law is left. A cubic
/// through four points does not follow it well, but its logarithm is nearly linear. Where a point
/// has no light (logarithm −∞), X, Y, Z themselves are interpolated linearly instead.
#[derive(Clone, Debug)]
pub struct DopplerTable {
    /// ln D of the first point, in steps of [`LN_STEP`].
    first: i32,
    points: Vec<[f64; 3]>,
}

impl DopplerTable {
    /// X, Y, Z as from [`Spectrum::shifted`], interpolated at a ln D. Outside the table's range,
    /// the values at its nearer end.
    ///
    /// ```
    /// use ugphysics::spectrum::{DopplerGrid, Spectrum};
    ///
    /// let green = Spectrum::from_linear_srgb([0.1, 0.5, 0.1]);
    /// let table = DopplerGrid::new(-1.0..=1.0).table(&green);
    /// let [_, near, _] = table.xyz(0.123_f64);
    /// let [_, exact, _] = green.shifted(1.130_884_420_947_05);
    /// assert!((near / exact - 1.0).abs() < 3e-4);
    /// ```
    pub fn xyz(&self, ln_doppler: f64) -> [f64; 3] {
        let cell = Cell::new(self.first, self.points.len(), ln_doppler);
        cell.interpolate(std::array::from_fn(|i| self.points[cell.idx + i - 1]))
    }

    /// ln X, ln Y, ln Z at the points of the grid; −∞ where there is no light.
    pub fn points(&self) -> &[[f64; 3]] {
        &self.points
    }
}

/// Points of a [`LazyTable`] that are allocated together.
const CHUNK: usize = 16;

type Chunk = Box<[OnceLock<[f64; 3]>; CHUNK]>;

/// As a [`DopplerTable`], of any X, Y, Z; points are computed when they are first read.
#[derive(Debug)]
pub struct LazyTable {
    first: i32,
    n_points: usize,
    chunks: Box<[OnceLock<Chunk>]>,
}

impl LazyTable {
    /// X, Y, Z interpolated at a ln D. `xyz`: returns those at a D, always by the same function.
    pub fn xyz(&self, ln_doppler: f64, xyz: impl Fn(f64) -> [f64; 3]) -> [f64; 3] {
        let cell = Cell::new(self.first, self.n_points, ln_doppler);
        let point = |idx: usize| {
            let chunk = self.chunks[idx / CHUNK].get_or_init(|| Box::new([const { OnceLock::new() }; CHUNK]));
            *chunk[idx % CHUNK].get_or_init(|| {
                let ln_doppler = f64::from(self.first + idx as i32) * LN_STEP;
                xyz(libm::exp(ln_doppler)).map(libm::log)
            })
        };
        if cell.fraction == 0.0 {
            return point(cell.idx).map(libm::exp);
        }
        cell.interpolate(std::array::from_fn(|i| point(cell.idx + i - 1)))
    }
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
    let (ahead, back, far) = (s + 1.0, 1.0 - s, 2.0 - s);
    from * (ahead * back * far / 2.0) + to * (ahead * s * far / 2.0)
        - before * (s * back * far / 6.0)
        - behind * (ahead * s * back / 6.0)
}
