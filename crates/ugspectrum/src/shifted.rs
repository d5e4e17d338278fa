//! What a spectrum looks like over a range of Doppler factors, tabulated.

use std::ops::RangeInclusive;
use std::sync::OnceLock;

use crate::nodes::{N_NODES, Nodes};
use crate::reflectance::{Illumination, Reflectance};
use crate::spectrum::{Kind, Spectrum};

/// Distance of the points of a table in ln D: a hundredth part of a wavelength, some 5 nm.
///
/// Measured on 125 surfaces from pale to the primaries and on black bodies, what is in between is off by less than
/// 3·10⁻⁴ of X, Y and Z: a difference ΔE*ab below 0.1. Half of it is the sum over whole nanometres, which sees the corners of
/// daylight's table.
pub const LN_STEP: f64 = 0.01;

/// Points at either side of a cell that the curve through it needs.
const MARGIN: i32 = 2;

/// Doppler factors farther from 1 than e^±100 are taken as that: there is nothing left to see.
pub(crate) const MOST: f64 = 100.0;

/// The Doppler factors of tables: every e^(0.01 k) of a range and a little more, D = 1 always among them.
#[derive(Debug)]
pub struct Grid {
    first: i32,
    last: i32,
    /// The light on surfaces at each, worked out once for all of them.
    light: OnceLock<Vec<Illumination>>,
    /// The same for single surfaces.
    nodes: OnceLock<Vec<Nodes<N_NODES>>>,
}

impl Grid {
    /// Covers a range of ln D.
    #[must_use]
    pub fn new(ln_doppler: RangeInclusive<f64>) -> Self {
        let row = |ln: f64| (ln.clamp(-MOST, MOST) / LN_STEP).floor() as i32;
        Self {
            first: row(*ln_doppler.start()).min(0) - MARGIN,
            last: row(*ln_doppler.end()).max(0) + 1 + MARGIN,
            light: OnceLock::new(),
            nodes: OnceLock::new(),
        }
    }

    /// How many factors there are.
    #[must_use]
    pub fn n_points(&self) -> usize {
        (self.last - self.first + 1) as usize
    }

    /// Their logarithms, rising.
    pub fn ln_doppler(&self) -> impl Iterator<Item = f64> {
        (self.first..=self.last).map(|row| f64::from(row) * LN_STEP)
    }

    /// The table of a spectrum.
    #[must_use]
    pub fn table(&self, spectrum: &Spectrum) -> Shifted {
        let points = match &spectrum.0 {
            Kind::Reflected(surface) => {
                self.light().iter().map(|light| surface.lit(light).map(libm::log)).collect()
            }
            _ => self.factors().map(|doppler| spectrum.ln_shifted(doppler)).collect(),
        };
        Shifted { first: self.first, points }
    }

    /// X, Y, Z as [`Spectrum::shifted`] has them, at one ln D and without a table: for surfaces from their reflectance
    /// every 4 nm, since the light is worked out already. Exact at the points of a table, so at rest.
    #[must_use]
    pub fn xyz(&self, spectrum: &Spectrum, ln_doppler: f64) -> [f64; 3] {
        let Kind::Reflected(surface) = &spectrum.0 else { return spectrum.shifted(libm::exp(ln_doppler)) };
        let place = Place::new(self.first, self.n_points(), ln_doppler);
        if place.part == 0.0 {
            return surface.lit(&self.light()[place.cell]);
        }
        let nodes = self.nodes.get_or_init(|| self.light().iter().map(Nodes::new).collect());
        place.between(points(surface, &nodes[place.cell - 1..place.cell + 3]))
    }

    fn light(&self) -> &[Illumination] {
        self.light.get_or_init(|| self.factors().map(Illumination::new).collect())
    }

    fn factors(&self) -> impl Iterator<Item = f64> {
        self.ln_doppler().map(libm::exp)
    }
}

/// ln X, ln Y, ln Z of a surface at four points.
fn points(surface: &Reflectance, around: &[Nodes<N_NODES>]) -> [[f64; 3]; 4] {
    let (factor, curve) = surface.parts();
    let values = curve.map_or([1.0; N_NODES], |curve| around[0].curve(curve));
    // Polynomials between nodes may swing a little below 0.
    std::array::from_fn(|k| around[k].sums(&values).map(|sum| libm::log(factor * sum.max(0.0))))
}

/// ln X, ln Y, ln Z of L(λ) = L'(λD), without D⁵, over ln D.
///
/// Logarithms, because far from D = 1 little is left but the exponential tails of Planck's law, which a cubic through
/// four points does not follow, while their logarithms are nearly straight. Where there is no light at some point, the
/// line between two points is taken.
#[derive(Clone, Debug)]
pub struct Shifted {
    /// The first point is at ln D = `first` steps.
    first: i32,
    points: Vec<[f64; 3]>,
}

impl Shifted {
    /// X, Y, Z as [`Spectrum::shifted`] has them, at a ln D; outside of the range of the table, those at its end.
    ///
    /// ```
    /// use ugspectrum::{Grid, Spectrum};
    ///
    /// let green = Spectrum::from_linear_srgb([0.1, 0.5, 0.1]);
    /// let table = Grid::new(-1.0..=1.0).table(&green);
    /// let [_, near, _] = table.xyz(0.123_f64);
    /// let [_, exact, _] = green.shifted(1.130_884_420_947_05);
    /// assert!((near / exact - 1.0).abs() < 3e-4);
    /// ```
    #[must_use]
    pub fn xyz(&self, ln_doppler: f64) -> [f64; 3] {
        let place = Place::new(self.first, self.points.len(), ln_doppler);
        place.between(std::array::from_fn(|i| self.points[place.cell + i - 1]))
    }

    /// ln X, ln Y, ln Z at the points of the grid; −∞ without light.
    #[must_use]
    pub fn points(&self) -> &[[f64; 3]] {
        &self.points
    }
}

/// Where a ln D lies between points.
struct Place {
    /// The point before it.
    cell: usize,
    /// The part of the way to the next.
    part: f64,
}

impl Place {
    fn new(first: i32, n_points: usize, ln_doppler: f64) -> Self {
        let last_cell = n_points - 1 - MARGIN as usize;
        let at = (ln_doppler / LN_STEP - f64::from(first)).clamp(1.0, last_cell as f64 + 1.0);
        let cell = (at as usize).min(last_cell);
        Self { cell, part: at - cell as f64 }
    }

    /// X, Y, Z between the logarithms at the point before the cell, its two ends, and the point behind.
    fn between(&self, [before, from, to, behind]: [[f64; 3]; 4]) -> [f64; 3] {
        std::array::from_fn(|i| {
            let ends = [before[i], from[i], to[i], behind[i]];
            if ends.iter().all(|ln| ln.is_finite()) {
                libm::exp(cubic(ends, self.part))
            } else {
                let (from, to) = (libm::exp(from[i]), libm::exp(to[i]));
                from + self.part * (to - from)
            }
        })
    }
}

/// The cubic through values at −1, 0, 1, 2, at `s` in 0…1.
fn cubic([before, from, to, behind]: [f64; 4], s: f64) -> f64 {
    let (ahead, back, far) = (s + 1.0, 1.0 - s, 2.0 - s);
    from * (ahead * back * far / 2.0) + to * (ahead * s * far / 2.0)
        - before * (s * back * far / 6.0)
        - behind * (ahead * s * back / 6.0)
}
