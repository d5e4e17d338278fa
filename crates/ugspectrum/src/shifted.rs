//! What a spectrum looks like over a range of Doppler factors, tabulated.

use std::ops::RangeInclusive;
use std::sync::OnceLock;

use crate::reflectance::Illumination;
use crate::spectrum::{Kind, Spectrum};

/// Distance of the points of a table in ln D: a hundredth part of a wavelength, some 5 nm.
pub const LN_STEP: f64 = 0.01;

/// Points at either side of a cell that the curve through it needs.
const MARGIN: i32 = 2;

/// Doppler factors farther from 1 than e^±100 are taken as that: nothing is left to see of them.
const MOST: f64 = 100.0;

/// The Doppler factors of tables: every e^(0.01 k) of a range and a little more, D = 1 always among them.
#[derive(Debug)]
pub struct Grid {
    first: i32,
    last: i32,
    /// The light on surfaces at each, worked out once for all of them.
    light: OnceLock<Vec<Illumination>>,
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
                let light = self.light.get_or_init(|| self.factors().map(Illumination::new).collect());
                light.iter().map(|light| surface.lit(light).map(libm::log)).collect()
            }
            _ => self.factors().map(|doppler| spectrum.ln_shifted(doppler)).collect(),
        };
        Shifted { first: self.first, points }
    }

    fn factors(&self) -> impl Iterator<Item = f64> {
        self.ln_doppler().map(libm::exp)
    }
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
    /// assert!((near / exact - 1.0).abs() < 1e-5);
    /// ```
    #[must_use]
    pub fn xyz(&self, ln_doppler: f64) -> [f64; 3] {
        let last_cell = self.points.len() - 1 - MARGIN as usize;
        let at = (ln_doppler / LN_STEP - f64::from(self.first)).clamp(1.0, last_cell as f64 + 1.0);
        let cell = (at as usize).min(last_cell);
        let part = at - cell as f64;
        let [before, from, to, behind] = std::array::from_fn(|i| self.points[cell + i - 1]);
        std::array::from_fn(|i| {
            let ends = [before[i], from[i], to[i], behind[i]];
            if ends.iter().all(|ln| ln.is_finite()) {
                libm::exp(cubic(ends, part))
            } else {
                let (from, to) = (libm::exp(from[i]), libm::exp(to[i]));
                from + part * (to - from)
            }
        })
    }

    /// ln X, ln Y, ln Z at the points of the grid; −∞ without light.
    #[must_use]
    pub fn points(&self) -> &[[f64; 3]] {
        &self.points
    }
}

/// The cubic through values at −1, 0, 1, 2, at `s` in 0…1.
fn cubic([before, from, to, behind]: [f64; 4], s: f64) -> f64 {
    let (ahead, back, far) = (s + 1.0, 1.0 - s, 2.0 - s);
    from * (ahead * back * far / 2.0) + to * (ahead * s * far / 2.0)
        - before * (s * back * far / 6.0)
        - behind * (ahead * s * back / 6.0)
}
