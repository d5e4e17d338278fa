//! Finding the curve that has a colour.

use std::sync::OnceLock;

use crate::reflectance::Illumination;

/// A sigmoid of a quadratic: S(x) = 1/2 + x/(2√(1 + x²)) with x = a + b t + c (3t² − 1)/2 and t from −1 at 380 nm to 1 at
/// 780.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Coefficients([f64; 3]);

impl Coefficients {
    pub fn at(&self, wavelength_nm: f64) -> f64 {
        let [_, t, quadratic] = basis(wavelength_nm);
        let [a, b, c] = self.0;
        let x = a + b * t + c * quadratic;
        0.5 + 0.5 * x / (1.0 + x * x).sqrt()
    }
}

/// Legendre's polynomials, which keep the three unknowns apart better than powers of t.
fn basis(wavelength_nm: f64) -> [f64; 3] {
    let t = (wavelength_nm - 580.0) / 200.0;
    [1.0, t, 1.5 * t * t - 0.5]
}

/// How near the colour must come, in linear light.
const NEAR: f64 = 1e-10;

/// What a solution has to reach to count.
const NEAR_ENOUGH: f64 = 1e-9;

/// Rounds of the coarse and of the fine iteration.
const ROUNDS: usize = 200;

/// The curve whose colour under daylight is this linear sRGB, by the Gauss–Newton method with damping (Levenberg
/// and Marquardt): first on every eighth wavelength, then on all.
pub(crate) fn solve(wanted: [f64; 3]) -> Option<Coefficients> {
    let grids = grids();
    let mean = ((wanted[0] + wanted[1] + wanted[2]) / 3.0).clamp(0.05, 0.95);
    // The grey of that level: the inverse of S.
    let grey = Coefficients([(mean - 0.5) / (mean * (1.0 - mean)).sqrt(), 0.0, 0.0]);
    // The grids are nearly alike, so behind the first the second needs no damping.
    let (near, _) = descend(&grids[0], wanted, grey, 1e-5, 1e-3);
    let (found, error) = descend(&grids[1], wanted, near, NEAR, 1e-9);
    (error < NEAR_ENOUGH).then_some(found)
}

/// One wavelength: the basis there, and what a reflectance of 1 adds to linear red, green and blue.
type Weight = ([f64; 3], [f64; 3]);

fn grids() -> &'static [Vec<Weight>; 2] {
    static GRIDS: OnceLock<[Vec<Weight>; 2]> = OnceLock::new();
    GRIDS.get_or_init(|| {
        let fine: Vec<_> = Illumination::new(1.0).rgb_weights().collect();
        // The first two are what lies outside of the curve.
        let (ends, inside) = fine.split_at(2);
        let coarse = ends.chunks(1).chain(inside.chunks(8)).map(|run| {
            let sum = |i: usize| run.iter().map(|(_, rgb)| rgb[i]).sum();
            (basis(run[run.len() / 2].0), [sum(0), sum(1), sum(2)])
        });
        let coarse = coarse.collect();
        [coarse, fine.into_iter().map(|(nm, rgb)| (basis(nm), rgb)).collect()]
    })
}

/// Levenberg–Marquardt until the largest error is below `near`; the best curve and its error.
fn descend(
    grid: &[Weight],
    wanted: [f64; 3],
    start: Coefficients,
    near: f64,
    mut damping: f64,
) -> (Coefficients, f64) {
    let mut best = start;
    let (mut error, mut slopes) = colour(grid, wanted, best);
    for _ in 0..ROUNDS {
        if size(error) < near {
            break;
        }
        let Some(step) = step(error, slopes, damping) else { break };
        let next = Coefficients(std::array::from_fn(|i| best.0[i] + step[i]));
        let (next_error, next_slopes) = colour(grid, wanted, next);
        if square(next_error) < square(error) {
            (best, error, slopes) = (next, next_error, next_slopes);
            damping *= 0.1;
        } else {
            damping = (damping * 10.0).max(1e-12);
            if damping > 1e12 {
                break;
            }
        }
    }
    (best, size(error))
}

/// How far the colour of a curve is off, and its derivatives: row channel, column coefficient.
fn colour(
    grid: &[Weight],
    wanted: [f64; 3],
    Coefficients([a, b, c]): Coefficients,
) -> ([f64; 3], [[f64; 3]; 3]) {
    let mut error = wanted.map(|channel| -channel);
    let mut slopes = [[0.0; 3]; 3];
    for ([one, t, quadratic], rgb) in grid {
        let x = a * one + b * t + c * quadratic;
        let root = 1.0 / (1.0 + x * x).sqrt();
        let reflected = 0.5 + 0.5 * x * root;
        let slope = 0.5 * root * root * root;
        for channel in 0..3 {
            error[channel] += rgb[channel] * reflected;
            let weight = rgb[channel] * slope;
            slopes[channel][0] += weight;
            slopes[channel][1] += weight * t;
            slopes[channel][2] += weight * quadratic;
        }
    }
    (error, slopes)
}

fn square(error: [f64; 3]) -> f64 {
    error.iter().map(|part| part * part).sum()
}

fn size(error: [f64; 3]) -> f64 {
    error.iter().fold(0.0, |largest: f64, part| largest.max(part.abs()))
}

/// The damped step: (JᵀJ + damping diag JᵀJ) step = −Jᵀ error, by Cramer's rule.
fn step(error: [f64; 3], slopes: [[f64; 3]; 3], damping: f64) -> Option<[f64; 3]> {
    let entry =
        |i: usize, j: usize| (0..3).map(|channel| slopes[channel][i] * slopes[channel][j]).sum::<f64>();
    let mut matrix: [[f64; 3]; 3] = std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)));
    for (i, row) in matrix.iter_mut().enumerate() {
        row[i] *= 1.0 + damping;
    }
    let right: [f64; 3] = std::array::from_fn(|i| -(0..3).map(|ch| slopes[ch][i] * error[ch]).sum::<f64>());
    let whole = determinant(matrix);
    let part = |column: usize| {
        let mut replaced = matrix;
        (0..3).for_each(|row| replaced[row][column] = right[row]);
        determinant(replaced) / whole
    };
    let step = [part(0), part(1), part(2)];
    step.iter().all(|part| part.is_finite()).then_some(step)
}

fn determinant([[a, b, c], [d, e, f], [g, h, i]]: [[f64; 3]; 3]) -> f64 {
    a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)
}
