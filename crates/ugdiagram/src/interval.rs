//! The interval of two events.

use ugphysics::Event;

/// Part of the squares of time and distance below which their difference is rounding.
const ROUNDING: f64 = 1e-13;

/// The kind of an interval, the same in every frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum IntervalKind {
    /// A clock can be at both events.
    Timelike,
    /// Light can.
    Lightlike,
    /// A rod can have its ends at both.
    Spacelike,
}

impl IntervalKind {
    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Timelike => "timelike",
            Self::Lightlike => "lightlike",
            Self::Spacelike => "spacelike",
        }
    }
}

/// The interval from one event to another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// Its kind.
    pub kind: IntervalKind,
    /// c²Δt² − Δx² − Δy² − Δz²: above 0 if timelike, 0 if lightlike.
    pub square: f64,
}

impl Interval {
    /// The interval of two events whose coordinates differ by this. Eq. (P7)
    ///
    /// ```
    /// use glam::DVec3;
    /// use ugdiagram::{Interval, IntervalKind};
    /// use ugphysics::Event;
    ///
    /// let interval = Interval::of(Event { t: 5.0, x: DVec3::new(4.0, 0.0, 0.0) });
    /// assert_eq!((interval.kind, interval.length()), (IntervalKind::Timelike, 3.0));
    /// ```
    pub fn of(difference: Event) -> Self {
        let Event { t, x } = difference;
        let distance = ugphysics::length(x);
        let square = (t - distance) * (t + distance);
        let kind = if square.abs() <= ROUNDING * (t * t + distance * distance) {
            IntervalKind::Lightlike
        } else if square > 0.0 {
            IntervalKind::Timelike
        } else {
            IntervalKind::Spacelike
        };
        Self { kind, square: if kind == IntervalKind::Lightlike { 0.0 } else { square } }
    }

    /// The own time of a clock that moves uniformly from one event to the other, or the length of a
    /// rod whose ends are at both at once.
    pub fn length(&self) -> f64 {
        self.square.abs().sqrt()
    }
}
