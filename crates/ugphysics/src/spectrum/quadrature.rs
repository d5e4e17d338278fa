//! Quadrature: integrals over a smooth reflectance from few of its values.

use std::ops::Range;

use crate::spectrum::dot::dot;
use crate::spectrum::ranges::{N_LEVELS, N_NM};
use crate::spectrum::weighted_daylight::WeightedDaylight;

/// Number of nodes for colours in motion: one every 2 nm.
pub(crate) const N_NODES: usize = 201;

/// Number of nodes that each interpolation polynomial passes through.
const N_POINTS: usize = 6;

/// Evenly spaced nodes from 380 to 780 nm, each with a weight for X, Y and Z (or for red, green and
/// blue): the contribution of a reflectance of 1 at that node.
///
/// Between nodes the reflectance is interpolated by the polynomial through the six nearest nodes.
/// Daylight and the observer are still evaluated at every nanometre, so only the reflectance has to
/// be smooth.
#[derive(Clone, Debug)]
pub(crate) struct Quadrature<const N: usize> {
    /// The weights, by channel, of the curve of the colour.
    pub weights: [[f64; N]; 3],
    /// The nodes with a weight.
    used: Range<usize>,
    /// The weights of the infrared levels, by channel.
    infrared: [[f64; N_LEVELS]; 3],
}

impl<const N: usize> Quadrature<N> {
    /// The weights for the given light on a surface.
    pub fn new(light: &WeightedDaylight) -> Self {
        let step = ((N_NM - 1) / (N - 1)) as f64;
        let mut weights = [[0.0; N]; 3];
        for nm in 0..N_NM {
            let (row, parts) = polynomial(nm as f64 / step, N);
            for (weights, light) in weights.iter_mut().zip(&light.inside) {
                for (node, part) in weights[row..].iter_mut().zip(parts) {
                    *node += light[nm] * part;
                }
            }
        }
        // Below 380 nm the curve is constant.
        weights.iter_mut().zip(light.ultraviolet).for_each(|(weights, part)| weights[0] += part);
        let is_used = |row: &usize| weights.iter().any(|weights| weights[*row] != 0.0);
        let first = (0..N).find(is_used).unwrap_or(N);
        let end = (first..N).rfind(is_used).map_or(first, |last| last + 1);
        Self { weights, used: first..end, infrared: light.infrared }
    }

    /// The same with the channels converted by `mix`, a linear map.
    pub fn mixed(mut self, mix: impl Fn([f64; 3]) -> [f64; 3]) -> Self {
        for row in 0..N {
            let mixed = mix(std::array::from_fn(|i| self.weights[i][row]));
            self.weights.iter_mut().zip(mixed).for_each(|(weights, mixed)| weights[row] = mixed);
        }
        for level in 0..N_LEVELS {
            let mixed = mix(std::array::from_fn(|i| self.infrared[i][level]));
            self.infrared.iter_mut().zip(mixed).for_each(|(levels, mixed)| levels[level] = mixed);
        }
        self
    }

    /// The integral for each channel, from the values of a curve at the nodes.
    pub fn sums(&self, values: &[f64; N]) -> [f64; 3] {
        let used = || self.used.clone();
        self.weights.each_ref().map(|weights| dot(&values[used()], &weights[used()]))
    }

    /// What the infrared levels add to each channel.
    pub fn infrared(&self, levels: &[f64; N_LEVELS]) -> [f64; 3] {
        self.infrared.each_ref().map(|weights| dot(levels, weights))
    }
}

/// Lagrange interpolation at `at`, in steps from the first node: the first node used, and the
/// weights of it and the ones after it.
fn polynomial(at: f64, n_nodes: usize) -> (usize, [f64; N_POINTS]) {
    let row = (at as usize).saturating_sub(N_POINTS / 2 - 1).min(n_nodes - N_POINTS);
    let at = at - row as f64;
    let weight = |own: usize| {
        let others = (0..N_POINTS).filter(|&other| other != own);
        others.map(|other| (at - other as f64) / (own as f64 - other as f64)).product()
    };
    (row, std::array::from_fn(weight))
}
