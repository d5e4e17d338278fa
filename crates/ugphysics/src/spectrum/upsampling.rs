//! Spectral upsampling: finds the reflectance curve of a colour (Jakob and Hanika 2019).

use std::sync::OnceLock;

use crate::xyz_to_linear_srgb;

use crate::spectrum::curve::Coefficients;
use crate::spectrum::infrared::{InfraredRule, N_LEVELS};
use crate::spectrum::quadrature::{N_NODES, Quadrature, dot};
use crate::spectrum::weighted_daylight::WeightedDaylight;

/// The iteration stops at this error, in linear light.
const TOLERANCE: f64 = 1e-10;

/// The largest error of an accepted solution, in linear light.
const ACCEPTED_ERROR: f64 = 1e-9;

/// Below this error one more step is enough: the derivatives on the middle grid are right to about
/// 10⁻³ for the steepest curves.
const ONE_STEP_ERROR: f64 = 1e-7;

/// Largest number of damped steps.
const MAX_DAMPED_STEPS: usize = 200;

/// Largest number of final Newton steps; each divides the error by about a thousand.
const MAX_NEWTON_STEPS: usize = 4;

/// The curve whose colour under daylight, together with the infrared levels, is this linear sRGB,
/// by the Levenberg–Marquardt method: first on nodes every 20 nm, then every 4 nm, then on every
/// nanometre. `None` if no curve is found.
pub(crate) fn solve(
    color: [f64; 3],
    rule: InfraredRule,
    levels: [f64; N_LEVELS],
) -> Option<Coefficients> {
    let (coarse, middle, fine) = grids(rule);
    let infrared = fine.infrared(&levels);
    let target = std::array::from_fn(|i| color[i] - infrared[i]);
    let start = levenberg_marquardt(coarse, target, initial_guess(target), 1e-4, 1e-3);
    // The grids give nearly the same colours, so almost no damping is needed after the first.
    let near = levenberg_marquardt(middle, target, start.curve, ONE_STEP_ERROR, 1e-9);
    refine(fine, target, &near).or_else(|| {
        let found = levenberg_marquardt(fine, target, constant_curve(target), TOLERANCE, 1e-3);
        (max_norm(found.error) < ACCEPTED_ERROR).then_some(found.curve)
    })
}

/// The inverse of S, with the reflectance clamped away from black and white.
fn argument(reflected: f64) -> f64 {
    let reflected = reflected.clamp(0.02, 0.98);
    (reflected - 0.5) / (reflected * (1.0 - reflected)).sqrt()
}

/// The constant curve at the mean of the channels.
fn constant_curve(target: [f64; 3]) -> Coefficients {
    Coefficients([argument((target[0] + target[1] + target[2]) / 3.0), 0.0, 0.0])
}

/// The initial guess: the curve that equals the blue channel at 455 nm, the green one at 545 nm and
/// the red one at 600 nm, where each has most effect.
fn initial_guess([red, green, blue]: [f64; 3]) -> Coefficients {
    const AT: [f64; 3] = [-0.625, -0.175, 0.1];
    let [low, middle, high] = [blue, green, red].map(argument);
    // Newton's divided differences, converted from powers of t to Legendre polynomials.
    let first = (middle - low) / (AT[1] - AT[0]);
    let second = ((high - middle) / (AT[2] - AT[1]) - first) / (AT[2] - AT[0]);
    let quadratic = second / 1.5;
    let slope = first - second * (AT[0] + AT[1]);
    let level = low - first * AT[0] + second * AT[0] * AT[1];
    Coefficients([level + 0.5 * quadratic, slope, quadratic])
}

/// Newton's method on every nanometre, with the derivatives of the nearby solution on the middle
/// grid. `None` if it does not converge.
fn refine(fine: &Fine, target: [f64; 3], near: &Evaluation) -> Option<Coefficients> {
    let mut curve = near.curve;
    for _ in 0..MAX_NEWTON_STEPS {
        let sums = fine.sums(&fine.curve(curve));
        let error: [f64; 3] = std::array::from_fn(|i| sums[i] - target[i]);
        if max_norm(error) < TOLERANCE {
            return Some(curve);
        }
        let step = step(error, near.slopes, 0.0)?;
        curve = Coefficients(std::array::from_fn(|i| curve.0[i] + step[i]));
        if max_norm(error) < ONE_STEP_ERROR {
            return Some(curve);
        }
    }
    None
}

/// Nodes every 20 nm, every 4 nm, and at every nanometre.
type Grids = (Quadrature<21>, Quadrature<N_NODES>, Fine);
type Fine = Quadrature<401>;

/// The grids with weights for linear red, green and blue at rest.
fn grids(rule: InfraredRule) -> &'static Grids {
    static GRIDS: [OnceLock<Grids>; 2] = [const { OnceLock::new() }; 2];
    GRIDS[rule as usize].get_or_init(|| {
        let light = WeightedDaylight::new(1.0);
        let mix = xyz_to_linear_srgb;
        (
            Quadrature::new(&light, rule).mixed(mix),
            Quadrature::new(&light, rule).mixed(mix),
            Quadrature::new(&light, rule).mixed(mix),
        )
    })
}

/// A curve, the error of its colour, and the derivatives of that error: row channel, column
/// coefficient.
struct Evaluation {
    curve: Coefficients,
    error: [f64; 3],
    slopes: [[f64; 3]; 3],
}

/// Levenberg–Marquardt steps until the largest error is below `tolerance`; returns the best curve.
fn levenberg_marquardt<const N: usize>(
    grid: &Quadrature<N>,
    target: [f64; 3],
    start: Coefficients,
    tolerance: f64,
    mut damping: f64,
) -> Evaluation {
    let mut best = evaluate(grid, target, start);
    for _ in 0..MAX_DAMPED_STEPS {
        if max_norm(best.error) < tolerance {
            break;
        }
        let Some(step) = step(best.error, best.slopes, damping) else { break };
        let next = Coefficients(std::array::from_fn(|i| best.curve.0[i] + step[i]));
        let next = evaluate(grid, target, next);
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

fn evaluate<const N: usize>(
    grid: &Quadrature<N>,
    target: [f64; 3],
    curve: Coefficients,
) -> Evaluation {
    let (values, basis) = grid.curve_and_slopes(curve);
    let sums = grid.sums(&values);
    let slopes = std::array::from_fn(|i| std::array::from_fn(|j| dot(&basis[j], &grid.weights[i])));
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
