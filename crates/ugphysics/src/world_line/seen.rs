//! Flat triangles of a body that is not inertial, as they are seen from an event.
//!
//! Let X(r, τ) be the event of the point r of the body at the own time τ of A, and k = (1; n) with
//! the direction n from the observer to it, both in the frame in which A rests at the own time of a
//! corner. Light arrives from r at the τ(r) where t + |x| = 0 relative to the observer. Along a
//! line in the triangle, with q = ∂X/∂τ·k, its derivatives are, Eq. (P49),
//!
//! ```text
//! τ' = −(∂X/∂r·k)/q,   τ'' = −(2 τ' ∂²X/∂r∂τ·k + τ'² ∂²X/∂τ²·k + |x'⊥|²/|x|)/q,
//! X' = ∂X/∂r + τ' ∂X/∂τ,   X'' = 2 τ' ∂²X/∂r∂τ + τ'² ∂²X/∂τ² + τ'' ∂X/∂τ,
//! ```
//!
//! since X is linear in r. A function on a triangle whose second derivatives are no longer than M
//! differs from the linear one with its values at the corners by M h²/6 at most, where h is the
//! longest edge (S. Waldron, *The error in linear interpolation at the vertices of a simplex*,
//! 1998: M R²/2 for the radius R of the least circle around it).
//!
//! # Bounds
//!
//! Axes of A at own times that differ by T have a relative rapidity of a T or less, so components
//! of vectors in one of them are no longer than g = exp(a T) times the vector in the other. With
//! the bounds P of 1 + a·ξ, v of |dξ/dτ|, b of |d²ξ/dτ²|, and ω of the sum of all spins:
//!
//! ```text
//! |∂X/∂r| ≤ g,   |∂X/∂τ| ≤ g (P + v), in space ≤ g v + (g − 1) P,
//! |∂²X/∂r∂τ| ≤ g (a + ω),   |∂²X/∂τ²| ≤ g (|a'||ξ| + 2 a v + a P + b),   |∂X/∂r·k| ≤ g.
//! ```
//!
//! q is known at the corner, and how fast it changes follows from these: first with half of it as
//! its least value, then with what is left of it. Where acceleration or spin jumps, or q changes by
//! more than half, only the first derivatives are used.

use core::f64::consts::SQRT_2;
use core::ops::Range;

use glam::DVec3;

use super::moving::{Moving, Turn};
use super::ray::{SmoothStretch, WorldTube, turn_bounds};
use super::{Kind, SeenLight, WorldLine};
use crate::{Event, unit_or_zero};

/// Rounding errors of events, relative to their distances from the observer and from the event of A
/// at own time 0, are below it.
const ROUNDING: f64 = 1e-12;

/// Greatest g.
const MOST_GROWTH: f64 = 1.5;

/// A flat triangle of a body as seen from an event.
#[derive(Clone, Debug, PartialEq)]
pub struct SeenTriangle {
    /// Bounds of the own times of A at which the light leaves the points of the triangle.
    pub own_times: Range<f64>,
    /// The greatest distance at which a point is seen from the point with the same barycentric
    /// weights of the seen corners.
    pub deviation: f64,
}

/// A point of a body, and its light at the observer.
pub type SeenPoint = (DVec3, SeenLight);

/// What bounds a motion around an own time.
struct Bounds {
    /// |a| and |a'|
    acceleration: f64,
    jerk: f64,
    /// |ξ|
    offset: f64,
    /// P
    lapse: f64,
    /// v, b and ω
    speed: f64,
    bend: f64,
    spin: f64,
}

/// First derivatives along a line in a triangle: bounds of |τ'| and |x'|.
#[derive(Clone, Copy)]
struct Slopes {
    /// g
    growth: f64,
    time: f64,
    place: f64,
    /// |∂x/∂τ|
    swing: f64,
}

impl WorldLine {
    /// How a flat triangle of the body is seen from an event.  Eq. (P49)
    ///
    /// `passages`: those of the event.
    ///
    /// `levels`: how often a triangle is divided into four for closer bounds, at most, where it
    /// deviates by more than a quarter of its edges.
    ///
    /// `None` for an inertial motion, and without a useful bound: if a triangle is so large that
    /// its parts are seen at very different velocities, or close to the observer.
    pub fn seen_triangle(
        &self,
        tube: &WorldTube,
        passages: &[SmoothStretch],
        corners: &[SeenPoint; 3],
        observer: Event,
        levels: u32,
    ) -> Option<SeenTriangle> {
        let Kind::Moving(moving) = &self.0 else { return None };
        Sight { moving, tube, passages, observer }.triangle(corners, levels)
    }
}

impl SeenTriangle {
    /// True if the seen triangle is nearly flat, for its size.
    pub fn is_flat(&self, corners: &[SeenPoint; 3]) -> bool {
        /// Of the sum of the edges.
        const DEVIATION: f64 = 1.0 / 12.0;
        let [a, b, c] = corners.map(|(_, seen)| seen.event.x);
        self.deviation <= DEVIATION * ((b - a).length() + (c - b).length() + (a - c).length())
    }
}

/// A body as it is seen from an event.
struct Sight<'a> {
    moving: &'a Moving,
    tube: &'a WorldTube,
    /// Those of the observer.
    passages: &'a [SmoothStretch],
    observer: Event,
}

impl Sight<'_> {
    /// See [`WorldLine::seen_triangle`]. The deviation of a divided triangle is at most the
    /// greatest of its parts, from their corners, plus the distance of these corners from the
    /// middles of the edges as seen.
    fn triangle(&self, corners: &[SeenPoint; 3], levels: u32) -> Option<SeenTriangle> {
        let whole = self.whole(corners);
        if levels == 0 || whole.as_ref().is_some_and(|whole| whole.is_flat(corners)) {
            return whole;
        }
        let [a, b, c] = *corners;
        let middle = |(p, seen): SeenPoint, (q, other): SeenPoint| {
            let point = p.midpoint(q);
            let light = self.moving.light(point, self.observer, None).ok()?;
            let deviation = (light.event.x - seen.event.x.midpoint(other.event.x)).length();
            Some(((point, light), deviation))
        };
        let [(ab, of_ab), (bc, of_bc), (ca, of_ca)] = [middle(a, b)?, middle(b, c)?, middle(c, a)?];
        let part = |corners: [SeenPoint; 3]| self.triangle(&corners, levels - 1);
        let [first, second, third, last] =
            [part([a, ab, ca])?, part([b, bc, ab])?, part([c, ca, bc])?, part([ab, bc, ca])?];
        let parts = [&first, &second, &third, &last];
        let low = parts.iter().map(|part| part.own_times.start).fold(f64::INFINITY, f64::min);
        let high = parts.iter().map(|part| part.own_times.end).fold(f64::NEG_INFINITY, f64::max);
        let deviation = parts.iter().map(|part| part.deviation).fold(0.0, f64::max);
        Some(SeenTriangle {
            own_times: low..high,
            deviation: deviation + of_ab.max(of_bc).max(of_ca),
        })
    }

    /// The triangle as a whole.
    fn whole(&self, corners: &[SeenPoint; 3]) -> Option<SeenTriangle> {
        let &Self { moving, tube, passages, observer } = self;
        let [(a, first), (b, _), (c, _)] = corners;
        let edge = (*b - *a).length().max((*c - *b).length()).max((*a - *c).length());
        let own_time = first.own_time;
        let (pose, acceleration) = moving.carried_with_acceleration(own_time);
        let Event { x: way, .. } = pose.scene_from_axes.inverse().apply(first.event - observer);
        let distance = way.length();
        let Event { t: gamma, x: proper } =
            pose.scene_from_axes.apply(Event { t: 1.0, x: DVec3::ZERO });
        let rounding = ROUNDING * (distance + own_time.abs() + tube.reach());
        let around = |time: f64| own_time - time..own_time + time;

        let smooth = || {
            let passage = passages.iter().find(|passage| passage.own_times.contains(&own_time))?;
            let bounds = moving.bounds(*a, edge, core::slice::from_ref(passage));
            let offset = moving.offset(*a, own_time);
            let q = 1.0 + acceleration.dot(offset.xi) + unit_or_zero(way).dot(offset.swing);
            let least = |slopes: Slopes| {
                let nearest = distance - slopes.place * edge;
                let change = bounds.mixed(slopes)
                    + SQRT_2 * bounds.second(slopes) * slopes.time
                    + slopes.swing * slopes.place / nearest;
                (nearest > 0.0).then_some(q - edge * change)
            };
            let half = least(bounds.slopes(0.5 * q, edge)?).filter(|least| *least > 0.5 * q)?;
            let slopes = bounds.slopes(half, edge)?;
            let reach = around(slopes.time * edge);
            let is_smooth =
                passage.own_times.start <= reach.start && reach.end <= passage.own_times.end;
            let nearest = distance - slopes.place * edge;
            if !is_smooth || nearest <= 0.0 {
                return None;
            }
            let turn = slopes.place * slopes.place / nearest;
            let along = 2.0 * bounds.mixed(slopes) / SQRT_2 * slopes.time
                + bounds.second(slopes) * slopes.time * slopes.time;
            let time = (SQRT_2 * along + turn) / half;
            let place = along + slopes.swing * time;
            let share = edge * edge / 6.0;
            let own_times = corners.iter().map(|(_, seen)| seen.own_time);
            let (low, high) = own_times
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), time| {
                    (low.min(time), high.max(time))
                });
            let margin = time * share + rounding;
            let deviation = (gamma * place + proper.length() * (place + turn)) * share;
            Some(SeenTriangle { own_times: low - margin..high + margin, deviation })
        };
        let rough = || {
            let bounds = moving.bounds(*a, edge, passages);
            let least = (tube.least_lapse - bounds.speed) / MOST_GROWTH;
            let slopes = (least > 0.0).then(|| bounds.slopes(least, edge)).flatten()?;
            let Range { start, end } = around(slopes.time * edge + rounding);
            let deviation = 2.0 * slopes.place * edge * (gamma + proper.length());
            Some(SeenTriangle { own_times: start..end, deviation })
        };
        let SeenTriangle { own_times, deviation } = smooth().or_else(rough)?;
        let deviation = deviation + rounding * (gamma + proper.length());
        deviation.is_finite().then_some(SeenTriangle { own_times, deviation })
    }
}

impl Moving {
    /// Bounds for points no farther than `margin` from one, during passages.
    fn bounds(&self, point: DVec3, margin: f64, passages: &[SmoothStretch]) -> Bounds {
        let most =
            |value: &dyn Fn(&SmoothStretch) -> f64| passages.iter().map(value).fold(0.0, f64::max);
        let rate = |turn: &Turn| most(&|passage| turn.spin.rate(passage.known_at).length());
        let (acceleration, jerk) =
            (most(&|passage| passage.acceleration), most(&|passage| passage.jerk));
        let (mut speed, mut bend, mut spin) = (0.0, 0.0, 0.0);
        let (mut arm, mut from) = (margin, point);
        for turn in &self.turns {
            let rate = rate(turn);
            arm += (turn.pivot - from).length();
            (speed, bend) = turn_bounds((speed, bend), rate, arm);
            (spin, from) = (spin + rate, turn.pivot);
        }
        let offset = arm + (from - self.at).length();
        Bounds { acceleration, jerk, offset, lapse: 1.0 + acceleration * offset, speed, bend, spin }
    }
}

impl Bounds {
    /// In a triangle with this longest edge, for a least q. `None` if g is too large.
    fn slopes(&self, q: f64, edge: f64) -> Option<Slopes> {
        let growth = libm::exp(self.acceleration * edge * MOST_GROWTH / q);
        // NaN fails the comparison.
        if !(q > 0.0 && growth <= MOST_GROWTH) {
            return None;
        }
        let time = growth / q;
        let swing = growth * self.speed + (growth - 1.0) * self.lapse;
        Some(Slopes { growth, time, place: growth + swing * time, swing })
    }

    /// |∂²X/∂r∂τ·k|
    fn mixed(&self, slopes: Slopes) -> f64 {
        SQRT_2 * slopes.growth * (self.acceleration + self.spin)
    }

    /// |∂²X/∂τ²|
    fn second(&self, slopes: Slopes) -> f64 {
        let Self { acceleration, jerk, offset, lapse, speed, bend, .. } = self;
        slopes.growth * (jerk * offset + acceleration * (2.0 * speed + lapse) + bend)
    }
}
