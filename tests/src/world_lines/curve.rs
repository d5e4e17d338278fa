//! The spline through events, without a formula for second derivatives: its slopes at the rows
//! follow from their equations by elimination with all rows, and cubics from Hermite's polynomials.

use glam::DVec3;

use super::{Four, four_velocity, plus, product};

/// Steps of integration between two rows.
const N_STEPS: usize = 4000;

/// A place as a function of the time of the scene.
#[derive(Clone, Debug)]
pub struct Curve {
    rows: Vec<Four>,
    slopes: Vec<DVec3>,
}

fn place(row: Four) -> DVec3 {
    DVec3::new(row[1], row[2], row[3])
}

impl Curve {
    /// The spline through these events.
    pub fn new(rows: &[Four]) -> Self {
        let n = rows.len();
        let inverse = |k: usize| 1.0 / (rows[k + 1][0] - rows[k][0]);
        let rise = |k: usize| 3.0 * inverse(k) * inverse(k) * (place(rows[k + 1]) - place(rows[k]));
        // The second derivative is that of both sides inside.
        let mut matrix = vec![vec![0.0; n]; n];
        let mut right = vec![DVec3::ZERO; n];
        for k in 0..n - 1 {
            for (row, other) in [(k, k + 1), (k + 1, k)] {
                matrix[row][row] += 2.0 * inverse(k);
                matrix[row][other] += inverse(k);
                right[row] += rise(k);
            }
        }
        // At the ends it changes as between the next two rows, (1 + r) m₁ − r m₂ = m₀.
        let ends = [[0, 1, 2], [n - 1, n - 2, n.saturating_sub(3)]];
        for [end, next, far] in ends.into_iter().filter(|_| n > 2) {
            let (outer, inner) = (end.min(next), next.min(far));
            let r = if n == 3 { 0.0 } else { (inverse(inner) / inverse(outer)).min(1.0) };
            matrix[end] = vec![0.0; n];
            matrix[end][end] = (6.0 + 2.0 * r) * inverse(outer);
            matrix[end][next] = (6.0 + 4.0 * r) * inverse(outer) - 2.0 * r * inverse(inner);
            matrix[end][far] -= 4.0 * r * inverse(inner);
            right[end] = (4.0 + 2.0 * r) * rise(outer) - 2.0 * r * rise(inner);
        }
        for pivot in 0..n {
            for row in (0..n).filter(|&row| row != pivot) {
                let factor = matrix[row][pivot] / matrix[pivot][pivot];
                let subtracted = matrix[pivot].clone();
                matrix[row]
                    .iter_mut()
                    .zip(subtracted)
                    .for_each(|(entry, other)| *entry -= factor * other);
                right[row] = right[row] - factor * right[pivot];
            }
        }
        let slopes = (0..n).map(|k| right[k] / matrix[k][k]).collect();
        Self { rows: rows.to_vec(), slopes }
    }

    /// The first event.
    pub fn start(&self) -> Four {
        self.rows[0]
    }

    /// Velocity and acceleration at a time of the scene; those of constant velocity outside.
    pub fn at(&self, t: f64) -> (DVec3, DVec3) {
        let last = self.rows.len() - 1;
        if t < self.rows[0][0] {
            return (self.slopes[0], DVec3::ZERO);
        }
        if t > self.rows[last][0] {
            return (self.slopes[last], DVec3::ZERO);
        }
        self.inside(t)
    }

    /// The same at a time between the rows, or so near to them that only rounding is between.
    fn inside(&self, t: f64) -> (DVec3, DVec3) {
        let last = self.rows.len() - 1;
        let k = self.rows[..last].partition_point(|row| row[0] <= t).max(1) - 1;
        let h = self.rows[k + 1][0] - self.rows[k][0];
        let (s, rise) = ((t - self.rows[k][0]) / h, place(self.rows[k + 1]) - place(self.rows[k]));
        let (a, b) = (self.slopes[k], self.slopes[k + 1]);
        let velocity = 6.0 * s * (1.0 - s) / h * rise
            + (1.0 - s) * (1.0 - 3.0 * s) * a
            + s * (3.0 * s - 2.0) * b;
        let acceleration = (6.0 - 12.0 * s) / h * rise + (6.0 * s - 4.0) * a + (6.0 * s - 2.0) * b;
        (velocity, acceleration / h)
    }

    /// du/dτ where the 4-velocity is that of the curve, between the rows.
    pub fn acceleration(&self, t: f64) -> Four {
        let (v, a) = self.inside(t);
        let squared = 1.0 / (1.0 - v.length_squared());
        let along = squared * squared * v.dot(a);
        let x = squared * a + along * v;
        [along, x.x, x.y, x.z]
    }

    /// The own times of the rows, by Simpson's rule.
    pub fn own_times(&self) -> Vec<f64> {
        let pace = |t: f64| (1.0 - self.at(t).0.length_squared()).sqrt();
        let mut times = vec![0.0];
        for pair in self.rows.windows(2) {
            let h = (pair[1][0] - pair[0][0]) / N_STEPS as f64;
            let step = |k: usize| {
                let t = pair[0][0] + k as f64 * h;
                h / 6.0 * (pace(t) + 4.0 * pace(t + 0.5 * h) + pace(t + h))
            };
            times.push(times[times.len() - 1] + (0..N_STEPS).map(step).sum::<f64>());
        }
        times
    }

    /// The axes at each row, from those of a single boost at the first: de/dt = (A·e) u/γ by the
    /// method of Runge and Kutta in small steps.
    pub fn axes(&self, start: [Four; 3]) -> Vec<[Four; 3]> {
        let rate = |t: f64, e: Four| {
            let u = four_velocity(self.at(t).0);
            u.map(|x| x * product(self.acceleration(t), e) / u[0])
        };
        let step = |t: f64, h: f64, e: Four| {
            let k1 = rate(t, e);
            let k2 = rate(t + 0.5 * h, plus(e, 0.5 * h, k1));
            let k3 = rate(t + 0.5 * h, plus(e, 0.5 * h, k2));
            let k4 = rate(t + h, plus(e, h, k3));
            [(k1, 1.0), (k2, 2.0), (k3, 2.0), (k4, 1.0)]
                .into_iter()
                .fold(e, |e, (k, weight)| plus(e, weight * h / 6.0, k))
        };
        let mut all = vec![start];
        for pair in self.rows.windows(2) {
            let h = (pair[1][0] - pair[0][0]) / N_STEPS as f64;
            let carried =
                |e: Four| (0..N_STEPS).fold(e, |e, k| step(pair[0][0] + k as f64 * h, h, e));
            all.push(all[all.len() - 1].map(carried));
        }
        all
    }
}
