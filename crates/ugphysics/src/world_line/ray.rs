//! Rays in the coordinates of a body that is not inertial.
//!
//! A ray is straight in the frame of the scene: X(s) = O + s K. At the own time τ of the reference
//! point it crosses the plane of simultaneity of that point where (X(s) − z(τ))·u(τ) = 0, which is
//! linear in s. So the ray is a curve with the parameter τ in the coordinates of the body, in
//! closed form.  Eq. (P46)
//!
//! In the carried axes let K = (k⁰; k), N = 1 + a·ξ and k̂ = k/k⁰. Then ds/dτ = N/k⁰ and dξ/dτ =
//! N k̂. Since |k̂| ≤ 1, the curve is never faster than N. Differentiated once more, with dk̂/dτ =
//! (a·k̂)k̂ − a, this is d²ξ/dτ² = N (2(a·k̂)k̂ − a) + (a'·ξ)k̂, of length N|a| + |a'||ξ| or less.
//! The turn of the spin adds the terms of Coriolis and of the centrifugal force.

use core::borrow::Borrow;
use core::ops::{ControlFlow, Range};

use glam::{DMat3, DVec3};

use super::moving::{Moving, Path, Turn};
use super::{Kind, WorldLine, WorldLineError};
use crate::{Event, Lorentz};

/// A body is not met if the rounding errors of own times and of places relative to A, with a margin
/// of 4500, exceed the size of the body by this factor. Its place is a rounding error then, and the
/// search of a ray would not end.
const MOST_ROUNDING: f64 = 1e3;

/// A tube around all points of a body in motion, for [`WorldLine::visit_ray`].
#[derive(Clone, Debug)]
pub struct WorldTube {
    /// The motion without spin, in which the centre is a point of the body.
    carried: Moving,
    /// The centre relative to A, in the carried axes.
    offset: DVec3,
    /// The greatest distance of a point from the centre.
    radius: f64,
    /// A positive lower bound of 1 + a·ξ for all points at all own times.
    pub(super) least_lapse: f64,
}

/// A stretch of own time in which a body may be seen from an event, and in which its acceleration
/// and its spin do not jump: what all rays from the event share.
#[derive(Clone, Debug)]
pub struct SmoothStretch {
    pub(super) own_times: Range<f64>,
    /// The middle of the own times.
    pub(super) known_at: f64,
    path: StretchPath,
    /// To the axes in which ξ is computed: turned as the spin has turned at `known_at`.
    back: DMat3,
    /// The point of the body about which it spins, or A.
    pivot: DVec3,
    /// This point relative to A, in the axes of ξ.
    offset: DVec3,
    /// Angular velocity: unit axis and rate.
    axis: DVec3,
    rate: f64,
    /// |a| and |da/dτ| in the carried axes, or upper bounds of them.
    pub(super) acceleration: f64,
    pub(super) jerk: f64,
}

#[derive(Clone, Debug)]
enum StretchPath {
    /// The origin of the rays relative to the event of A at `known_at`, in the axes there and in
    /// those of ξ; the axes there from the frame of the scene; and the proper acceleration.
    Accelerated { origin: Event, axes: Lorentz, acceleration: DVec3 },
    /// The origin of the rays in the frame of the scene.
    Any { origin: Event },
}

/// A stretch of a ray in the coordinates of a body, during which the acceleration and the spin of
/// the body do not jump.
#[derive(Clone, Copy, Debug)]
pub struct RayStretch<'a> {
    passage: &'a SmoothStretch,
    moving: &'a Moving,
    /// Several spins, applied in place of a single one.
    turns: &'a [Turn],
    /// A step of the ray, in the frame of the origin of `passage`.
    step: Event,
}

/// A ray at an own time, in the carried axes.
#[derive(Clone, Copy, Debug)]
struct Carried {
    s: f64,
    /// ds/dτ
    rate: f64,
    xi: DVec3,
    /// dξ/dτ
    velocity: DVec3,
}

impl Carried {
    /// From the ray relative to A and the acceleration, in the axes of A: it crosses the plane of
    /// simultaneity where its time is 0.
    fn new(origin: Event, step: Event, acceleration: DVec3) -> Self {
        let s = -origin.t / step.t;
        let xi = origin.x + s * step.x;
        let rate = (1.0 + acceleration.dot(xi)) / step.t;
        Self { s, rate, xi, velocity: rate * step.x }
    }
}

/// A point of a ray in the coordinates of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RayPoint {
    /// The parameter of the ray.
    pub s: f64,
    /// Its derivative by the own time.
    pub rate: f64,
    /// The point of the body.
    pub point: DVec3,
    /// The derivative of the point by the own time.
    pub derivative: DVec3,
}

impl WorldLine {
    /// The tube around a body with these points; `None` for a motion that is inertial.
    pub fn tube(&self, points: impl Iterator<Item = DVec3> + Clone) -> Option<WorldTube> {
        let Kind::Moving(moving) = &self.0 else { return None };
        Some(moving.tube(points))
    }

    /// Calls `visit` with the stretches of a ray in which it may meet the body, and ranges of own
    /// times, from the latest to the earliest, until it breaks.
    ///
    /// `origin`, `step`: the ray, where `step` is one into the past. `end`: an event of the ray
    /// beyond which nothing is looked for; required if the ray is slower than light.
    ///
    /// # Why no hit is lost
    ///
    /// A signal from the centre of the tube to a point of it takes an own time of less than radius
    /// / least (1 + a·ξ), since it is no longer than the radius and its speed is 1 + a·ξ; so does a
    /// signal back. Let τ_o be the own time at which the centre is seen at the origin of the ray,
    /// τ_e that at which it is seen at the end, and τ that of a point X of the tube on the ray. The
    /// signal that reaches X left the centre when this could be seen at the origin, so τ − radius/N
    /// ≤ τ_o. The signal from X reaches the centre when this cannot be seen at the end yet, or at
    /// the origin if the ray is as fast as light. So τ + radius/N ≥ τ_e.
    ///
    /// # Errors
    /// [`WorldLineError::Horizon`] if the centre of the body cannot move so.
    pub fn visit_ray(
        &self,
        tube: &WorldTube,
        origin: Event,
        step: Event,
        end: Option<Event>,
        visit: impl FnMut(&RayStretch<'_>, Range<f64>) -> ControlFlow<()>,
    ) -> Result<(), WorldLineError> {
        let Kind::Moving(moving) = &self.0 else { return Ok(()) };
        let passages = moving.smooth_stretches(tube, origin, end)?;
        moving.visit_passages(tube, passages, step, visit);
        Ok(())
    }

    /// What rays of light that arrive at an event share, for [`WorldLine::visit_light`].
    ///
    /// # Errors
    /// See [`WorldLine::visit_ray`].
    pub fn smooth_stretches(
        &self,
        tube: &WorldTube,
        origin: Event,
    ) -> Result<Vec<SmoothStretch>, WorldLineError> {
        let Kind::Moving(moving) = &self.0 else { return Ok(Vec::new()) };
        Ok(moving.smooth_stretches(tube, origin, None)?.collect())
    }

    /// An upper bound of the length of the second derivative of all rays in the tube.
    pub fn bend(&self, tube: &WorldTube, passages: &[SmoothStretch]) -> f64 {
        let Kind::Moving(moving) = &self.0 else { return 0.0 };
        let of_passage = |passage: &SmoothStretch| {
            let SmoothStretch { acceleration: a, jerk, known_at, .. } = passage;
            let lapse = 1.0 + a * tube.reach();
            let rates = moving.turns.iter().map(|turn| turn.spin.rate(*known_at).length());
            rates
                .fold((lapse, lapse * a + jerk * tube.reach()), |bounds, rate| {
                    turn_bounds(bounds, rate, tube.radius)
                })
                .1
        };
        passages.iter().map(of_passage).fold(0.0, f64::max)
    }

    /// The stretch of a ray of light that arrives at the event of a passage, and the own times of
    /// the passage.
    ///
    /// `None` for an inertial motion.
    pub fn stretch<'a>(
        &'a self,
        passage: &'a SmoothStretch,
        step: Event,
    ) -> Option<(RayStretch<'a>, Range<f64>)> {
        let Kind::Moving(moving) = &self.0 else { return None };
        Some((moving.stretch(passage, step), passage.own_times.clone()))
    }

    /// [`WorldLine::visit_ray`] for light that arrives at the event of these passages.
    pub fn visit_light(
        &self,
        tube: &WorldTube,
        passages: &[SmoothStretch],
        step: Event,
        visit: impl FnMut(&RayStretch<'_>, Range<f64>) -> ControlFlow<()>,
    ) {
        if let Kind::Moving(moving) = &self.0 {
            moving.visit_passages(tube, passages.iter(), step, visit);
        }
    }
}

impl WorldTube {
    /// A bound of |ξ|.
    pub(super) fn reach(&self) -> f64 {
        self.offset.length() + self.radius
    }

    /// The own time at which the centre is seen from an event.
    fn seen_at(&self, observer: Event) -> Result<f64, WorldLineError> {
        if let Path::Accelerated(acceleration) = &self.carried.path
            && acceleration.is_none()
        {
            let pose = acceleration.start();
            let Event { t, x } = pose.scene_from_axes.inverse().apply(observer - pose.event);
            return Ok(t - (x - self.offset).length());
        }
        let center = self.carried.at + self.offset;
        self.carried.emission_time(center, observer, self.carried.guess(observer, center))
    }
}

impl Moving {
    fn tube(&self, points: impl Iterator<Item = DVec3> + Clone) -> WorldTube {
        /// In place of the lapse of points beyond the horizon, which have no motion.
        const LEAST: f64 = 1e-3;
        let (center, reaches) = match self.turns.last() {
            Some(turn) => (turn.pivot, self.turns.as_slice()),
            None => {
                let ends = (DVec3::INFINITY, DVec3::NEG_INFINITY);
                let (low, high) = points
                    .clone()
                    .fold(ends, |(low, high), point| (low.min(point), high.max(point)));
                let middle = low.midpoint(high);
                (if middle.is_finite() { middle } else { self.at }, [].as_slice())
            }
        };
        let radius = |point: DVec3| match reaches {
            [] => (point - center).length(),
            turns => reach(turns, point),
        };
        let radius =
            points.clone().map(radius).fold(0.0, f64::max) * (1.0 + 1e-9) + f64::MIN_POSITIVE;
        let offset = center - self.at;
        let lapse = |acceleration: DVec3| match &self.path {
            Path::Accelerated(_) if self.turns.is_empty() => points
                .clone()
                .chain([center])
                .map(|point| 1.0 + acceleration.dot(point - self.at))
                .fold(1.0, f64::min),
            // Whatever the directions.
            Path::Accelerated(_) => 1.0 + acceleration.dot(offset) - acceleration.length() * radius,
            _ => 1.0 - acceleration.length() * (offset.length() + radius),
        };
        let least_lapse = match &self.path {
            Path::Accelerated(path) => path.values().map(lapse).fold(1.0, f64::min),
            path => lapse(path.greatest_acceleration() * DVec3::X),
        };
        let carried = Moving { turns: Vec::new(), ..self.clone() };
        WorldTube { carried, offset, radius, least_lapse: least_lapse.max(LEAST) }
    }

    /// The last own time before this one at which acceleration or spin jumps.
    fn smooth_before(&self, own_time: f64) -> f64 {
        let of_path = match &self.path {
            Path::Accelerated(acceleration) => acceleration.change_before(own_time),
            // Inside, the acceleration is continuous and the bound of its derivative holds.
            Path::Curved(framed) => {
                let before = framed.curve.changes().filter(|&change| change < own_time);
                before.fold(f64::NEG_INFINITY, f64::max)
            }
        };
        self.turns.iter().map(|turn| turn.spin.change_before(own_time)).fold(of_path, f64::max)
    }

    /// The stretches of own time in which a ray may meet the body, the latest first.
    fn smooth_stretches(
        &self,
        tube: &WorldTube,
        origin: Event,
        end: Option<Event>,
    ) -> Result<impl Iterator<Item = SmoothStretch>, WorldLineError> {
        let margin = tube.radius / tube.least_lapse;
        let latest = tube.seen_at(origin)?;
        let earliest = match end {
            Some(end) => tube.seen_at(end)?,
            None => latest,
        };
        let rounding = 1e-12 * latest.abs().max(earliest.abs()).max(tube.offset.length());
        let is_found = rounding <= MOST_ROUNDING * margin;
        // Rounding errors are far below it.
        let margin = margin * (1.0 + 1e-9) + rounding;
        let (mut to, first) = (latest + margin, earliest - margin);
        Ok(core::iter::from_fn(move || {
            (is_found && to > first).then(|| {
                let from = self.smooth_before(to).max(first);
                let passage = self.passage(from..to, origin);
                to = from;
                passage
            })
        }))
    }

    fn visit_passages(
        &self,
        tube: &WorldTube,
        passages: impl Iterator<Item = impl Borrow<SmoothStretch>>,
        step: Event,
        mut visit: impl FnMut(&RayStretch<'_>, Range<f64>) -> ControlFlow<()>,
    ) {
        for passage in passages {
            let passage = passage.borrow();
            let stretch = self.stretch(passage, step);
            let range = stretch.within(tube, passage.own_times.clone());
            if range.start < range.end && visit(&stretch, range).is_break() {
                return;
            }
        }
    }

    /// Between own times, both finite.
    fn passage(&self, own_times: Range<f64>, origin: Event) -> SmoothStretch {
        let known_at = own_times.start.midpoint(own_times.end);
        let (pivot, spin, back) = match self.turns.as_slice() {
            [Turn { pivot, spin }] => {
                (*pivot, spin.rate(known_at), DMat3::from_quat(spin.turn(known_at).conjugate()))
            }
            _ => (self.at, DVec3::ZERO, DMat3::IDENTITY),
        };
        let [acceleration, jerk] = self.path.bounds([own_times.start, own_times.end], known_at);
        let path = match &self.path {
            Path::Accelerated(path) => {
                let pose = path.pose(known_at);
                let axes = pose.scene_from_axes.inverse();
                let acceleration = path.at(known_at);
                let Event { t, x } = axes.apply(origin - pose.event);
                let origin = Event { t, x: back * x };
                StretchPath::Accelerated { origin, axes, acceleration: back * acceleration }
            }
            _ => StretchPath::Any { origin },
        };
        let spin = back * spin;
        let rate = spin.length();
        SmoothStretch {
            own_times,
            known_at,
            path,
            back,
            pivot,
            offset: back * (pivot - self.at),
            axis: if rate > 0.0 { spin / rate } else { DVec3::ZERO },
            rate,
            acceleration,
            jerk,
        }
    }

    /// A ray during a passage.
    fn stretch<'a>(&'a self, passage: &'a SmoothStretch, step: Event) -> RayStretch<'a> {
        let step = match &passage.path {
            StretchPath::Accelerated { axes, .. } => {
                let Event { t, x } = axes.apply(step);
                Event { t, x: passage.back * x }
            }
            StretchPath::Any { .. } => step,
        };
        let turns = if self.turns.len() > 1 { self.turns.as_slice() } else { &[] };
        RayStretch { passage, moving: self, turns, step }
    }

    /// A ray at an own time.
    fn crossing(&self, origin: Event, step: Event, own_time: f64) -> Carried {
        let (pose, acceleration) = self.carried_with_acceleration(own_time);
        let axes = pose.scene_from_axes.inverse();
        Carried::new(axes.apply(origin - pose.event), axes.apply(step), acceleration)
    }
}

/// Bounds of the first and second derivative after a turn, whose terms of Coriolis and of the
/// centrifugal force add to them: with the arm r, v + ωr and b + 2ωv + ω²r.
pub(super) fn turn_bounds((speed, bend): (f64, f64), rate: f64, arm: f64) -> (f64, f64) {
    (speed + rate * arm, bend + rate * (2.0 * speed + rate * arm))
}

/// How far a point of a body can be from the last pivot, however the body has turned.
fn reach(turns: &[Turn], point: DVec3) -> f64 {
    let step = |(reach, from): (f64, DVec3), turn: &Turn| {
        (reach + (turn.pivot - from).length(), turn.pivot)
    };
    turns.iter().fold((0.0, point), step).0
}

impl RayStretch<'_> {
    /// The point of the ray on the plane of simultaneity of an own time.  Eq. (P46)
    ///
    /// Beyond its passage, where the body moves otherwise, the curve goes on straight: tangents
    /// may touch there.
    pub fn at(&self, own_time: f64) -> RayPoint {
        let Range { start, end } = self.passage.own_times;
        // At the end the next passage has begun.
        let nearest = own_time.max(start).min(end.next_down());
        let at = self.inside(nearest);
        let beyond = own_time - nearest;
        if beyond == 0.0 {
            return at;
        }
        RayPoint { s: at.s + beyond * at.rate, point: at.point + beyond * at.derivative, ..at }
    }

    fn inside(&self, own_time: f64) -> RayPoint {
        let carried = self.carried(own_time);
        if !self.turns.is_empty() {
            return self.turned_back(carried, own_time);
        }
        let Carried { s, rate, xi, velocity } = carried;
        let arm = xi - self.passage.offset;
        if self.passage.rate == 0.0 {
            return RayPoint { s, rate, point: self.passage.pivot + arm, derivative: velocity };
        }
        let (sin, cos) = libm::sincos(0.5 * self.passage.rate * (own_time - self.passage.known_at));
        // The turn by the opposite angle.
        let (across, behind) = (2.0 * sin * cos, 2.0 * sin * sin);
        let turned = |v: DVec3| {
            let side = self.passage.axis.cross(v);
            v - across * side + behind * self.passage.axis.cross(side)
        };
        let derivative = turned(velocity - self.passage.rate * self.passage.axis.cross(arm));
        RayPoint { s, rate, point: self.passage.pivot + turned(arm), derivative }
    }

    /// In the axes of ξ.
    fn carried(&self, own_time: f64) -> Carried {
        let SmoothStretch { known_at, back, .. } = *self.passage;
        match &self.passage.path {
            StretchPath::Accelerated { origin, acceleration, .. } => {
                let passed = own_time - known_at;
                accelerated(*origin, self.step, *acceleration, self.passage.acceleration, passed)
            }
            StretchPath::Any { origin } => {
                let carried = self.moving.crossing(*origin, self.step, own_time);
                let [xi, velocity] = [carried.xi, carried.velocity].map(|v| back * v);
                Carried { xi, velocity, ..carried }
            }
        }
    }

    /// Undoes several spins, the outermost first.
    fn turned_back(&self, Carried { s, rate, xi, velocity }: Carried, own_time: f64) -> RayPoint {
        let (mut point, mut derivative) = (self.moving.at + xi, velocity);
        for Turn { pivot, spin } in self.turns.iter().rev() {
            let (back, arm) = (spin.turn(own_time).conjugate(), point - *pivot);
            derivative = back * (derivative - spin.rate(own_time).cross(arm));
            point = *pivot + back * arm;
        }
        RayPoint { s, rate, point, derivative }
    }

    /// An upper bound of the length of the second derivative of the point between two own times,
    /// whose points are passed as well; infinite if they are too far apart.
    pub fn bend(&self, [(from, start), (to, end)]: [(f64, DVec3); 2]) -> f64 {
        let a = self.passage.acceleration;
        let arm = (start - self.passage.pivot)
            .length_squared()
            .max((end - self.passage.pivot).length_squared())
            .sqrt();
        let xi = match self.turns.last() {
            None => arm + self.passage.offset.length(),
            Some(last) => {
                let reach = reach(self.turns, start).max(reach(self.turns, end));
                reach + (last.pivot - self.moving.at).length()
            }
        };
        // From the nearer end ξ moves by (1 + a ξ) (exp(a t) − 1)/a at most.
        let time = 0.5 * (to - from).abs();
        let growth = a * time;
        // NaN fails the comparison.
        if !matches!(growth.partial_cmp(&1.0), Some(core::cmp::Ordering::Less)) {
            return f64::INFINITY;
        }
        let moved = (1.0 + a * xi) * time * (1.0 + growth);
        let (arm, xi) = (arm + moved, xi + moved);
        let lapse = 1.0 + a * xi;
        let carried = lapse * a + self.passage.jerk * xi;
        if self.turns.is_empty() {
            return turn_bounds((lapse, carried), self.passage.rate, arm).1;
        }
        let (mut bounds, mut arm, mut from) = ((lapse, carried), xi, self.moving.at);
        for Turn { pivot, spin } in self.turns.iter().rev() {
            let rate = spin.rate(self.passage.known_at).length();
            arm += (from - *pivot).length();
            bounds = turn_bounds(bounds, rate, arm);
            from = *pivot;
        }
        bounds.1
    }

    /// The part of a range of own times in which the ray may be in a tube.
    fn within(&self, tube: &WorldTube, range: Range<f64>) -> Range<f64> {
        let center = self.passage.back * tube.offset;
        match &self.passage.path {
            StretchPath::Accelerated { origin, .. } if self.passage.acceleration == 0.0 => {
                let radius = tube.radius * (1.0 + 1e-6) + 1e-12 * origin.x.length();
                let Some([first, last]) = straight_within(origin.x - center, self.step, radius)
                else {
                    return range.end..range.end;
                };
                let [first, last] =
                    [first, last].map(|passed| self.passage.known_at + origin.t + passed);
                range.start.max(first)..range.end.min(last)
            }
            _ => self.shrunk(center, tube.radius, range),
        }
    }

    /// Moves the ends of a range of own times towards a ball, as fast as the ray can at most: with
    /// v = 1 + a |centre| + a r at the ball, the distance d from it changes by v + a d.
    fn shrunk(&self, center: DVec3, radius: f64, mut range: Range<f64>) -> Range<f64> {
        /// Further steps take longer than they save.
        const STEPS: usize = 3;
        let a = self.passage.acceleration;
        let speed = 1.0 + a * (center.length() + radius);
        let time = |own_time: f64| {
            let distance = (self.carried(own_time).xi - center).length() - radius;
            // No longer than ln(1 + a d/v)/a.
            let time = distance / (speed + a * distance);
            if distance > 0.0 && time.is_finite() { time } else { 0.0 }
        };
        for _ in 0..STEPS {
            range.end -= time(range.end);
            if range.start >= range.end {
                break;
            }
            range.start += time(range.start);
        }
        range
    }
}

/// The own times, after that of the origin, at which a straight ray enters a ball around 0 and
/// leaves it.
fn straight_within(origin: DVec3, step: Event, radius: f64) -> Option<[f64; 2]> {
    let square = step.x.length_squared();
    let nearest = -origin.dot(step.x) / square;
    let left = radius * radius - (origin + nearest * step.x).length_squared();
    let half = (left / square).sqrt();
    // NaN is not negative: nothing is known then.
    match left < 0.0 {
        true => None,
        false if half.is_finite() => Some([nearest + half, nearest - half].map(|s| s * step.t)),
        false => Some([f64::NEG_INFINITY, f64::INFINITY]),
    }
}

/// A ray after an own time in a stretch of constant proper acceleration, whose length is `size`.
/// The ray is relative to the event of A at its begin, in the axes there.
///
/// With c = cosh aτ and h = sinh aτ the axes (u; e) are (c, h; h, c) along â, and z is (h, c −
/// 1)/a.
fn accelerated(origin: Event, step: Event, acceleration: DVec3, size: f64, passed: f64) -> Carried {
    if size == 0.0 {
        return Carried::new(Event { t: origin.t - passed, ..origin }, step, acceleration);
    }
    let axis = acceleration / size;
    let grown = libm::expm1(size * passed);
    let less = grown / (1.0 + grown);
    // cosh − 1 and sinh.
    let (rise, sinh) = (0.5 * grown * less, 0.5 * (grown + less));
    let boosted = |t: f64, x: DVec3, along: f64| Event {
        t: t + rise * t - sinh * along,
        x: x + (rise * along - sinh * t) * axis,
    };
    // Relative to the horizon, 1/a behind A, the origin is boosted alone.
    let origin = boosted(origin.t, origin.x, origin.x.dot(axis) + 1.0 / size);
    Carried::new(origin, boosted(step.t, step.x, step.x.dot(axis)), acceleration)
}
