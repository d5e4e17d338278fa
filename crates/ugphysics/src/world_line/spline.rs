//! The cubic spline through events whose acceleration at the ends is that of the rows there.

use glam::DVec3;

use super::WorldLineError;
use crate::Event;

/// An event, and the derivatives by the time of the scene after it, up to the next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Row {
    pub event: Event,
    velocity: DVec3,
    second: DVec3,
    /// The third derivative.
    pub third: DVec3,
}

/// The derivatives of the place by the time of the scene.
#[derive(Clone, Copy, Debug)]
pub(super) struct Instant {
    pub velocity: DVec3,
    /// The second derivative.
    pub second: DVec3,
}

impl Row {
    /// `passed`: the time since the row.
    pub(super) fn at(&self, passed: f64) -> Instant {
        Instant {
            velocity: self.velocity + passed * (self.second + 0.5 * passed * self.third),
            second: self.second + passed * self.third,
        }
    }

    pub(super) fn event_at(&self, passed: f64) -> Event {
        let second = 0.5 * self.second + passed / 6.0 * self.third;
        let x = self.event.x + passed * (self.velocity + passed * second);
        Event { t: self.event.t + passed, x }
    }
}

impl Instant {
    /// 1 − v²
    pub(super) fn slowness(&self) -> f64 {
        let speed = self.velocity.length();
        (1.0 - speed) * (1.0 + speed)
    }

    /// A lower bound of 1 − v² between two instants of a row that are `time` apart: v is a
    /// parabola, so v² is within the control points of its Bézier curve of the fourth degree.
    pub(super) fn least_slowness_between(start: &Self, end: &Self, time: f64) -> f64 {
        let (a, c) = (start.velocity, end.velocity);
        let b = a + 0.5 * time * start.second;
        let middle = (a.dot(c) + 2.0 * b.length_squared()) / 3.0;
        let inner = a.dot(b).max(middle).max(b.dot(c));
        (1.0 - inner).min(start.slowness()).min(end.slowness())
    }

    /// dτ/dt = 1/γ
    pub(super) fn lapse(&self) -> f64 {
        self.slowness().sqrt()
    }

    /// γ²/(γ + 1) dv/dt × v: the angular velocity of carried axes against those of a single boost.
    pub(super) fn thomas(&self) -> DVec3 {
        let gamma = 1.0 / self.lapse();
        gamma * gamma / (gamma + 1.0) * self.second.cross(self.velocity)
    }

    /// γ²(dv/dt + γ²/(γ + 1) (v·dv/dt) v), in the axes of a single boost.
    pub(super) fn proper_acceleration(&self) -> DVec3 {
        let gamma = 1.0 / self.lapse();
        let squared = gamma * gamma;
        let along = squared / (gamma + 1.0) * self.velocity.dot(self.second);
        squared * (self.second + along * self.velocity)
    }
}

/// Solves for the second derivatives m of a spline: at every inner row, with the times h between
/// rows and the mean velocities s,
///
/// h₋ m₋ + 2 (h₋ + h₊) m + h₊ m₊ = 6 (s₊ − s₋).
///
/// At the ends m changes as between the next two rows, m₀ = (1 + r) m₁ − r m₂ with r = h₀/h₁, so
/// that the error is of the fourth order there as well. A time h₀ longer than h₁ has r = 1: what
/// happens between the next rows says little about it.
///
/// # Errors
/// [`WorldLineError::NotFinite`]
pub(super) fn spline(events: &[Event]) -> Result<Vec<Row>, WorldLineError> {
    let n = events.len();
    let time = |row: usize| events[row + 1].t - events[row].t;
    let mean = |row: usize| (events[row + 1].x - events[row].x) / time(row);
    let ratio = |outer: usize, inner: usize| (time(outer) / time(inner)).min(1.0);
    // Elimination from the first row on, as m = value − factor m₊.
    let mut second = vec![(0.0, DVec3::ZERO); n];
    for row in 1..n - 1 {
        let (mut before, mut after) = (time(row - 1), time(row));
        let mut diagonal = 2.0 * (before + after);
        // With three rows the acceleration is constant.
        let is_parabola = n == 3;
        if row == 1 {
            let r = if is_parabola { 0.0 } else { ratio(0, 1) };
            diagonal += before * (1.0 + r);
            after -= before * r;
        }
        if row == n - 2 {
            let r = if is_parabola { 0.0 } else { ratio(row, row - 1) };
            diagonal += after * (1.0 + r);
            (before, after) = (before - after * r, 0.0);
        }
        let (factor, value) = second[row - 1];
        let right = 6.0 * (mean(row) - mean(row - 1));
        let before = if row == 1 { 0.0 } else { before };
        diagonal -= before * factor;
        second[row] = (after / diagonal, (right - before * value) / diagonal);
    }
    let mut accelerations = vec![DVec3::ZERO; n];
    for row in (1..n - 1).rev() {
        let (factor, value) = second[row];
        accelerations[row] = value - factor * accelerations[row + 1];
    }
    if n > 2 {
        let end = |outer: usize, inner: usize, [near, next]: [DVec3; 2]| {
            let r = if n == 3 { 0.0 } else { ratio(outer, inner) };
            near + r * (near - next)
        };
        accelerations[0] = end(0, 1, [accelerations[1], accelerations[2]]);
        accelerations[n - 1] = end(n - 2, n - 3, [accelerations[n - 2], accelerations[n - 3]]);
    }
    let mut later = accelerations[n - 1];
    let last = Row {
        event: events[n - 1],
        velocity: DVec3::ZERO,
        second: DVec3::ZERO,
        third: DVec3::ZERO,
    };
    let mut rows = vec![last; n];
    for row in (0..n - 1).rev() {
        let here = accelerations[row];
        let time = time(row);
        rows[row] = Row {
            event: events[row],
            velocity: mean(row) - time / 6.0 * (2.0 * here + later),
            second: here,
            third: (later - here) / time,
        };
        later = here;
    }
    rows[n - 1].velocity = rows[n - 2].at(time(n - 2)).velocity;
    let is_finite = |row: &Row| {
        row.event.t.is_finite()
            && row.event.x.is_finite()
            && row.velocity.is_finite()
            && row.third.is_finite()
    };
    if rows.iter().all(is_finite) { Ok(rows) } else { Err(WorldLineError::NotFinite) }
}
