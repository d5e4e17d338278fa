//! Spectral upsampling: finds the reflectance curve of a colour (Jakob and Hanika 2019).

use std::sync::OnceLock;

use ugphysics::xyz_to_linear_srgb;

use crate::nodes::{N_NODES, Nodes, dot};
use crate::reflectance::Illumination;

/// The coefficients a, b, c of a curve, a sigmoid of a quadratic: S(x) = 1/2 + x/(2√(1 + x²)) with
/// x = a + b t + c (3t² − 1)/2, and t from −1 at 380 nm to 1 at 780 nm.  Eq. (P20)
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Coefficients(pub [f64; 3]);

impl Coefficients {
    pub fn at(&self, wavelength_nm: f64) -> f64 {
        let [_, t, quadratic] = Self::basis(wavelength_nm);
        let [a, b, c] = self.0;
        let x = a + b * t + c * quadratic;
        0.5 + 0.5 * x / (1.0 + x * x).sqrt()
    }

    /// The Legendre polynomials P₀, P₁, P₂ at t. They are orthogonal, so the equations for the
    /// coefficients are better conditioned than with powers of t.
    pub fn basis(wavelength_nm: f64) -> [f64; 3] {
        let t = (wavelength_nm - 580.0) / 200.0;
        [1.0, t, 1.5 * t * t - 0.5]
    }
}

/// The iteration stops at this error, in linear light.
const NEAR: f64 = 1e-10;

/// The largest error of an accepted solution, in linear light.
const NEAR_ENOUGH: f64 = 1e-9;

/// Below this error one more step is enough: the derivatives on the middle grid are right to about
/// 10⁻³ for the steepest curves.
const ONE_STEP: f64 = 1e-7;

/// Largest number of damped steps.
const ROUNDS: usize = 200;

/// Largest number of final Newton steps; each divides the error by about a thousand.
const LAST_ROUNDS: usize = 4;

/// The curve whose colour under daylight is this linear sRGB, by the Levenberg–Marquardt method:
/// first on nodes every 20 nm, then every 4 nm, then on every nanometre. `None` if no curve is
/// found.
pub(crate) fn solve(wanted: [f64; 3]) -> Option<Coefficients> {
    let (coarse, middle, fine) = grids();
    let start = descend(coarse, wanted, through(wanted), 1e-4, 1e-3);
    // The grids give nearly the same colours, so almost no damping is needed after the first.
    let near = descend(middle, wanted, start.curve, ONE_STEP, 1e-9);
    refine(fine, wanted, &near).or_else(|| {
        let found = descend(fine, wanted, grey(wanted), NEAR, 1e-3);
        (size(found.error) < NEAR_ENOUGH).then_some(found.curve)
    })
}

/// The inverse of S, with the reflectance clamped away from black and white.
fn argument(reflected: f64) -> f64 {
    let reflected = reflected.clamp(0.02, 0.98);
    (reflected - 0.5) / (reflected * (1.0 - reflected)).sqrt()
}

/// The constant curve at the mean of the channels.
fn grey(wanted: [f64; 3]) -> Coefficients {
    Coefficients([argument((wanted[0] + wanted[1] + wanted[2]) / 3.0), 0.0, 0.0])
}

/// The initial guess: the curve that equals the blue channel at 455 nm, the green one at 545 nm and
/// the red one at 600 nm, where each has most effect.
fn through([red, green, blue]: [f64; 3]) -> Coefficients {
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
fn refine(fine: &Fine, wanted: [f64; 3], near: &Found) -> Option<Coefficients> {
    let mut curve = near.curve;
    for _ in 0..LAST_ROUNDS {
        let sums = fine.sums(&fine.curve(curve));
        let error: [f64; 3] = std::array::from_fn(|i| sums[i] - wanted[i]);
        if size(error) < NEAR {
            return Some(curve);
        }
        let step = step(error, near.slopes, 0.0)?;
        curve = Coefficients(std::array::from_fn(|i| curve.0[i] + step[i]));
        if size(error) < ONE_STEP {
            return Some(curve);
        }
    }
    None
}

/// Nodes every 20 nm, every 4 nm, and at every nanometre.
type Grids = (Nodes<21>, Nodes<N_NODES>, Fine);
type Fine = Nodes<401>;

/// The grids with weights for linear red, green and blue at rest.
fn grids() -> &'static Grids {
    static GRIDS: OnceLock<Grids> = OnceLock::new();
    GRIDS.get_or_init(|| {
        let light = Illumination::new(1.0);
        let mix = xyz_to_linear_srgb;
        (Nodes::new(&light).mixed(mix), Nodes::new(&light).mixed(mix), Nodes::new(&light).mixed(mix))
    })
}

/// A curve, the error of its colour, and the derivatives of that error: row channel, column
/// coefficient.
struct Found {
    curve: Coefficients,
    error: [f64; 3],
    slopes: [[f64; 3]; 3],
}

/// Levenberg–Marquardt steps until the largest error is below `near`; returns the best curve.
fn descend<const N: usize>(
    grid: &Nodes<N>,
    wanted: [f64; 3],
    start: Coefficients,
    near: f64,
    mut damping: f64,
) -> Found {
    let mut best = colour(grid, wanted, start);
    for _ in 0..ROUNDS {
        if size(best.error) < near {
            break;
        }
        let Some(step) = step(best.error, best.slopes, damping) else { break };
        let next = Coefficients(std::array::from_fn(|i| best.curve.0[i] + step[i]));
        let next = colour(grid, wanted, next);
        if square(next.error) < square(best.error) {
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

fn colour<const N: usize>(grid: &Nodes<N>, wanted: [f64; 3], curve: Coefficients) -> Found {
    let (values, basis) = grid.curve_and_slopes(curve);
    let sums = grid.sums(&values);
    let slopes = std::array::from_fn(|i| std::array::from_fn(|j| dot(&basis[j], &grid.weights[i])));
    Found { curve, error: std::array::from_fn(|i| sums[i] - wanted[i]), slopes }
}

fn square(error: [f64; 3]) -> f64 {
    error.iter().map(|part| part * part).sum()
}

fn size(error: [f64; 3]) -> f64 {
    error.iter().fold(0.0, |largest: f64, part| largest.max(part.abs()))
}

/// The damped step: solves (JᵀJ + damping diag JᵀJ) step = −Jᵀ error by Cramer's rule.
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
