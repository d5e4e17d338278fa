//! Spectral upsampling: finds the reflectance curve of a colour.

use std::sync::OnceLock;

use crate::xyz_to_linear_srgb;

use crate::spectrum::curve::{Curve, Functions, N_FIXED};
use crate::spectrum::dot::dot;
use crate::spectrum::quadrature::Quadrature;
use crate::spectrum::ranges::{N_LEVELS, N_NM};
use crate::spectrum::weighted_daylight::WeightedDaylight;

/// The iteration stops at this error, in linear light.
const TOLERANCE: f64 = 1e-10;

/// The largest error of an accepted solution, in linear light.
const ACCEPTED_ERROR: f64 = 1e-9;

/// The error on the coarse grid, in linear light, from which on every nanometre is summed.
const COARSE_ERROR: f64 = 3e-5;

/// Largest number of damped steps.
const MAX_DAMPED_STEPS: usize = 200;

/// Largest number of final Newton steps; each divides the error by ten to a thousand.
const MAX_NEWTON_STEPS: usize = 8;

/// The curve whose colour under daylight, together with the infrared levels, is this linear sRGB,
/// by the Levenberg–Marquardt method: first on nodes every 4 nm, then on every nanometre. `start`:
/// a curve with its ends and its bound. `None` if no curve is found.
pub(crate) fn solve(color: [f64; 3], start: Curve, levels: [f64; N_LEVELS]) -> Option<Curve> {
    let (coarse, fine) = grids();
    let infrared = fine.quadrature.infrared(&levels);
    let target = std::array::from_fn(|i| color[i] - infrared[i]);
    let near = levenberg_marquardt(coarse, target, start, COARSE_ERROR, 1e-9);
    refine(fine, target, &near).or_else(|| {
        [near.curve, start].into_iter().find_map(|start| {
            let found = levenberg_marquardt(fine, target, start, TOLERANCE, 1e-3);
            (max_norm(found.error) < ACCEPTED_ERROR).then_some(found.curve)
        })
    })
}

/// A curve with other amounts of the channels.
fn moved(mut curve: Curve, step: [f64; 3]) -> Curve {
    curve.amounts[N_FIXED..].iter_mut().zip(step).for_each(|(amount, step)| *amount += step);
    curve
}

/// Newton's method on every nanometre, with the derivatives of the nearby solution on the coarse
/// grid. `None` if it does not converge.
fn refine(fine: &Fine, target: [f64; 3], near: &Evaluation) -> Option<Curve> {
    let mut curve = near.curve;
    for _ in 0..MAX_NEWTON_STEPS {
        let sums = fine.quadrature.sums(&fine.functions.curve(&curve));
        let error: [f64; 3] = std::array::from_fn(|i| sums[i] - target[i]);
        if max_norm(error) < TOLERANCE {
            return Some(curve);
        }
        curve = moved(curve, step(error, near.slopes, 0.0)?);
    }
    None
}

/// Nodes every 4 nm, and at every nanometre.
type Grids = (Grid<101>, Fine);
type Fine = Grid<N_NM>;

/// Weights for linear red, green and blue at rest, and the functions of curves.
struct Grid<const N: usize> {
    quadrature: Quadrature<N>,
    functions: Functions<N>,
}

impl<const N: usize> Grid<N> {
    fn new(light: &WeightedDaylight) -> Self {
        let quadrature = Quadrature::new(light).mixed(xyz_to_linear_srgb);
        Self { quadrature, functions: Functions::new() }
    }
}

/// Both grids, made at first use.
fn grids() -> &'static Grids {
    static GRIDS: OnceLock<Grids> = OnceLock::new();
    GRIDS.get_or_init(|| {
        let light = WeightedDaylight::new(1.0);
        (Grid::new(&light), Grid::new(&light))
    })
}

/// A curve, the error of its colour, and the derivatives of that error: row channel, column
/// coefficient.
struct Evaluation {
    curve: Curve,
    error: [f64; 3],
    slopes: [[f64; 3]; 3],
}

/// Levenberg–Marquardt steps until the largest error is below `tolerance`; returns the best curve.
fn levenberg_marquardt<const N: usize>(
    grid: &Grid<N>,
    target: [f64; 3],
    start: Curve,
    tolerance: f64,
    mut damping: f64,
) -> Evaluation {
    let mut best = evaluate(grid, target, start);
    for _ in 0..MAX_DAMPED_STEPS {
        if max_norm(best.error) < tolerance {
            break;
        }
        let Some(step) = step(best.error, best.slopes, damping) else { break };
        let next = evaluate(grid, target, moved(best.curve, step));
        if squared_norm(next.error) < squared_norm(best.error) {
            best = next;
            damping *= 0.1;
        } else {
            damping = (damping * 10.0).max(1e-12);
            if damping > 1e12 {
                break;
            }
        }
    }
    best
}

fn evaluate<const N: usize>(grid: &Grid<N>, target: [f64; 3], curve: Curve) -> Evaluation {
    let (values, slopes) = grid.functions.curve_and_slopes(&curve);
    let sums = grid.quadrature.sums(&values);
    let weights = &grid.quadrature.weights;
    let slopes = std::array::from_fn(|i| std::array::from_fn(|j| dot(&slopes[j], &weights[i])));
    Evaluation { curve, error: std::array::from_fn(|i| sums[i] - target[i]), slopes }
}

fn squared_norm(error: [f64; 3]) -> f64 {
    error.iter().map(|part| part * part).sum()
}

fn max_norm(error: [f64; 3]) -> f64 {
    error.iter().fold(0.0, |largest: f64, part| largest.max(part.abs()))
}

/// The damped step: solves (JᵀJ + damping diag JᵀJ) step = −Jᵀ error by Cramer's rule.
fn step(error: [f64; 3], slopes: [[f64; 3]; 3], damping: f64) -> Option<[f64; 3]> {
    let entry = |i: usize, j: usize| {
        (0..3).map(|channel| slopes[channel][i] * slopes[channel][j]).sum::<f64>()
    };
    let mut matrix: [[f64; 3]; 3] = std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)));
    for (i, row) in matrix.iter_mut().enumerate() {
        row[i] *= 1.0 + damping;
    }
    let right: [f64; 3] =
        std::array::from_fn(|i| -(0..3).map(|ch| slopes[ch][i] * error[ch]).sum::<f64>());
    let det = determinant(matrix);
    let part = |column: usize| {
        let mut replaced = matrix;
        (0..3).for_each(|row| replaced[row][column] = right[row]);
        determinant(replaced) / det
    };
    let step = [part(0), part(1), part(2)];
    step.iter().all(|part| part.is_finite()).then_some(step)
}

fn determinant([[a, b, c], [d, e, f], [g, h, i]]: [[f64; 3]; 3]) -> f64 {
    a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)
}
