//! The curve that reflectances are made of: steps from wavelength to wavelength as small as the
//! colour allows.
//!
//! With x the reflectance before it is bounded, the curve minimises ∫ρ (dx/dλ)² dλ for a given red,
//! green and blue and a given value at 780 nm. ρ is large where measured reflectances change
//! little. The solution is a sum of fixed functions, one for each condition.

use std::sync::LazyLock;

use crate::spectrum::ranges::{CURVE_NM, N_NM, smooth_step};
use crate::spectrum::weighted_daylight::WeightedDaylight;
use crate::xyz_to_linear_srgb;

/// Functions that a curve is a sum of: 1, two that go over to infrared, and one for each channel.
pub(crate) const N_BASIS: usize = 6;

/// The amounts that are those of the channels.
pub(crate) const N_FIXED: usize = N_BASIS - 3;

/// ln ρ every 50 nm from 380 to 780 nm, found as docs/physics/reflectance.py says.
const LN_ROUGHNESS: [f64; 9] = [-0.86, 5.36, -1.62, -1.02, -3.48, -0.84, -2.93, 6.0, 0.0];

/// The power of the way from 380 to 780 nm by which greys go over to their infrared level.
const RISE: f64 = 8.3;

/// Where foliage goes over to its infrared level, nm: the red edge of chlorophyll.
const RED_EDGE_NM: [f64; 2] = [690.0, 750.0];

/// The half-widths of the bounds at 0 and at the largest reflectance, in units of the largest
/// channel.
const SOFT: f64 = 0.02;

/// A curve in units of the largest channel of its colour: a sum of fixed functions of the
/// wavelength, bounded.  Eq. (P20)
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Curve {
    /// The amounts of the [`Functions`].
    pub amounts: [f64; N_BASIS],
    /// The bound.
    pub most: f64,
}

impl Curve {
    /// The curve from `visible` to `infrared` without regard to the colour, as far as it is
    /// foliage by its red edge.
    pub fn between(visible: f64, infrared: f64, foliage: f64, most: f64) -> Self {
        let [from, to] = [visible, infrared].map(|value| unbounded(value, most));
        let rise = to - from;
        Self { amounts: [from, rise * (1.0 - foliage), rise * foliage, 0.0, 0.0, 0.0], most }
    }

    /// The curve at a nanometre from 380 nm on.
    pub fn at_node(&self, row: usize) -> f64 {
        let x: f64 =
            self.amounts.iter().zip(&functions().0).map(|(amount, f)| amount * f[row]).sum();
        bounded(x, self.most).0
    }

    /// The curve at every nanometre.
    pub fn values(&self) -> [f64; N_NM] {
        functions().curve(self)
    }
}

/// The functions that curves are sums of, at evenly spaced nodes from 380 to 780 nm: 1, the rise of
/// greys, that of foliage, and one for each channel, which adds 1 to it and nothing to the others.
#[derive(Clone, Debug)]
pub(crate) struct Functions<const N: usize>([[f64; N]; N_BASIS]);

impl<const N: usize> Functions<N> {
    /// At every nanometre, or at fewer nodes.
    pub fn new() -> Self {
        let step = (N_NM - 1) / (N - 1);
        let all = &functions().0;
        Self(std::array::from_fn(|i| std::array::from_fn(|row| all[i][row * step])))
    }

    /// The curve at every node.
    pub fn curve(&self, curve: &Curve) -> [f64; N] {
        // A loop over one array is vectorized.
        let mut values = self.arguments(curve);
        values.iter_mut().for_each(|x| *x = bounded(*x, curve.most).0);
        values
    }

    /// The curve at every node, and its derivatives with respect to the amounts of the channels.
    pub fn curve_and_slopes(&self, curve: &Curve) -> ([f64; N], [[f64; N]; 3]) {
        let mut values = self.arguments(curve);
        let mut slope = values;
        slope.iter_mut().for_each(|x| *x = bounded(*x, curve.most).1);
        values.iter_mut().for_each(|x| *x = bounded(*x, curve.most).0);
        let mut slopes = [slope; 3];
        for (slope, function) in slopes.iter_mut().zip(&self.0[N_FIXED..]) {
            slope.iter_mut().zip(function).for_each(|(slope, value)| *slope *= value);
        }
        (values, slopes)
    }

    fn arguments(&self, curve: &Curve) -> [f64; N] {
        let mut sums = [curve.amounts[0]; N];
        let parts = curve.amounts.iter().zip(&self.0).skip(1);
        for (amount, function) in parts.filter(|(amount, _)| **amount != 0.0) {
            sums.iter_mut().zip(function).for_each(|(sum, value)| *sum += amount * value);
        }
        sums
    }
}

/// x where it is far from 0 and from the bound `most`, and smoothly held between them; with its
/// derivative.
pub(crate) fn bounded(x: f64, most: f64) -> (f64, f64) {
    let behind = x - most;
    let (low, high) = ((x * x + SOFT * SOFT).sqrt(), (behind * behind + SOFT * SOFT).sqrt());
    (0.5 * (most + low - high), 0.5 * (x / low - behind / high))
}

/// The inverse of [`bounded`] between the bounds.
fn unbounded(value: f64, most: f64) -> f64 {
    // x − most/2 is on a hyperbola of which (0, SOFT) and (most, SOFT) are the foci.
    let half = 0.5 * most;
    half + (value - half) * (1.0 + SOFT * SOFT / (value * (most - value))).sqrt()
}

/// The functions at every nanometre.
fn functions() -> &'static Functions<N_NM> {
    static FUNCTIONS: LazyLock<Box<Functions<N_NM>>> = LazyLock::new(|| Box::new(new_functions()));
    &FUNCTIONS
}

fn new_functions() -> Functions<N_NM> {
    let light = WeightedDaylight::new(1.0);
    // Red, green and blue of each nanometre; below 380 nm the curve is constant.
    let weights: [[f64; 3]; N_NM] = std::array::from_fn(|row| {
        let first = if row == 0 { light.ultraviolet } else { [0.0; 3] };
        xyz_to_linear_srgb(std::array::from_fn(|i| light.inside[i][row] + first[i]))
    });
    // The minimum is where ρ dx/dλ falls by the weight of a channel at each nanometre.
    let mut functions = [[0.0; 3]; N_NM];
    let mut steps = [[0.0; 3]; N_NM];
    let mut sum = [0.0; 3];
    for row in 0..N_NM - 1 {
        let knot = (row as f64 + 0.5) / 50.0;
        let from = knot as usize;
        let part = knot - from as f64;
        let ln = LN_ROUGHNESS[from] + part * (LN_ROUGHNESS[from + 1] - LN_ROUGHNESS[from]);
        for i in 0..3 {
            sum[i] += weights[row][i];
            steps[row][i] = sum[i] * libm::exp(-ln);
        }
    }
    for row in (0..N_NM - 1).rev() {
        functions[row] = std::array::from_fn(|i| functions[row + 1][i] + steps[row][i]);
    }
    // The mixture of them that is 1 in one channel.
    let gram: [[f64; 3]; 3] = std::array::from_fn(|of| {
        std::array::from_fn(|channel| {
            (0..N_NM).map(|row| functions[row][of] * weights[row][channel]).sum()
        })
    });
    let inverse = inverse(gram);
    let channel = |channel: usize, row: usize| -> f64 {
        (0..3).map(|k| inverse[channel][k] * functions[row][k]).sum()
    };
    let way = |row: usize| row as f64 / (N_NM - 1) as f64;
    Functions([
        [1.0; N_NM],
        std::array::from_fn(|row| libm::pow(way(row), RISE)),
        std::array::from_fn(|row| smooth_step(CURVE_NM[0] + row as f64, RED_EDGE_NM)),
        std::array::from_fn(|row| channel(0, row)),
        std::array::from_fn(|row| channel(1, row)),
        std::array::from_fn(|row| channel(2, row)),
    ])
}

/// The inverse of a regular matrix.
fn inverse(m: [[f64; 3]; 3]) -> [[f64; 3]; 3] {
    let cofactor = |i: usize, j: usize| {
        let [a, b, c, d] = [(i + 1) % 3, (i + 2) % 3, (j + 1) % 3, (j + 2) % 3];
        m[a][c] * m[b][d] - m[a][d] * m[b][c]
    };
    let determinant: f64 = (0..3).map(|j| m[0][j] * cofactor(0, j)).sum();
    std::array::from_fn(|i| std::array::from_fn(|j| cofactor(j, i) / determinant))
}
