//! Motions that are not inertial: where their points are, and when light of theirs is seen.

use glam::{DQuat, DVec3};

use super::curve::Framed;
use super::pieces::{Acceleration, Offset, Spin};
use super::table::ALL_TIMES;
use super::{EmissionEvent, Pose, SeenLight, WorldLineError};
use crate::{Event, Lorentz, Velocity, unit_or_zero};

/// A motion that is not inertial.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Moving {
    /// A, in the coordinates of the body.
    pub at: DVec3,
    /// The velocity at own time 0.
    pub initial: Velocity,
    pub path: Path,
    /// Spins about points of the body, the innermost first: each turns what those before it have
    /// turned.
    pub turns: Vec<Turn>,
}

/// Spin about a point.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Turn {
    /// The point, in the coordinates of the body.
    pub pivot: DVec3,
    pub spin: Spin,
}

/// The world line of A.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Path {
    Accelerated(Acceleration),
    Curved(Box<Framed>),
}

impl Path {
    /// The greatest |a| of all times.
    pub(super) fn greatest_acceleration(&self) -> f64 {
        match self {
            Self::Accelerated(acceleration) => acceleration.greatest(),
            Self::Curved(framed) => framed.curve.bounds(ALL_TIMES)[0],
        }
    }

    /// |a| and |da/dτ|, or upper bounds of them, between own times at which the acceleration does
    /// not jump. `inside`: one of these.
    pub(super) fn bounds(&self, own_times: [f64; 2], inside: f64) -> [f64; 2] {
        match self {
            Self::Accelerated(acceleration) => [acceleration.at(inside).length(), 0.0],
            Self::Curved(framed) => framed.curve.bounds(own_times),
        }
    }

    /// Radians per unit of own time by which the acceleration turns in the carried axes at all
    /// times.
    pub(super) fn turn_rate(&self) -> f64 {
        match self {
            Self::Accelerated(_) => 0.0,
            Self::Curved(framed) => framed.curve.turn_rate(),
        }
    }
}

/// A point of a body at an own time: its event and ∂X/∂τ.
#[derive(Clone, Copy, Debug)]
pub(super) struct PointEvent {
    pub event: Event,
    pub rate: Event,
    /// |∂X/∂τ|: the lapse of the point's own clock.
    pub clock: f64,
}

/// The lapse of the clock of a point, ((1 + a·ξ)² − |dξ/dτ|²)^½.
fn clock(lapse: f64, swing: DVec3) -> f64 {
    let swing = swing.length();
    ((lapse - swing) * (lapse + swing)).sqrt()
}

/// 1 + a·ξ, if it is above |dξ/dτ|.
fn check_lapse(lapse: f64, swing: DVec3, own_time: f64) -> Result<f64, WorldLineError> {
    match lapse.partial_cmp(&swing.length()) {
        Some(core::cmp::Ordering::Greater) => Ok(lapse),
        Some(_) if own_time.is_finite() => Err(WorldLineError::Horizon { own_time }),
        _ => Err(WorldLineError::NotFinite),
    }
}

/// The own time at which the first value of `value` is 0, by Newton's method within a bracket. The
/// second is the rate by which it decreases; where this is not above 0, the bracket alone is used.
fn decreasing_root(value: impl Fn(f64) -> (f64, f64)) -> f64 {
    const MOST_STEPS: usize = 200;
    let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
    let mut own_time = 0.0;
    for _ in 0..MOST_STEPS {
        let (left, lapse) = value(own_time);
        if left > 0.0 {
            low = own_time;
        } else {
            high = own_time;
        }
        let newton = own_time + left / lapse;
        if newton == own_time {
            return own_time;
        }
        let next = if lapse > 0.0 && newton > low && newton < high {
            newton
        } else if low.is_finite() && high.is_finite() {
            low.midpoint(high)
        } else {
            own_time + left
        };
        if (next - own_time).abs() <= 1e-15 * next.abs().max(1.0) {
            return next;
        }
        if !next.is_finite() {
            break;
        }
        own_time = next;
    }
    own_time
}

/// The root of a function that decreases strictly, by Newton's method within a bracket, which is
/// halved where a step leaves it. `value`: the function and its slope.
fn root_from(
    guess: f64,
    value: impl Fn(f64) -> Result<(f64, f64), WorldLineError>,
) -> Result<f64, WorldLineError> {
    /// Doublings to reach any finite time, and halvings of a bracket down to rounding.
    const MOST_STEPS: usize = 2200;
    let mut guess = guess;
    let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
    let mut reach = 1.0_f64.max(0.125 * guess.abs());
    for _ in 0..MOST_STEPS {
        let (f, slope) = value(guess)?;
        let newton = guess - f / slope;
        // The bracket does not contain its ends.
        if f == 0.0 || newton == guess {
            return Ok(guess);
        }
        if f > 0.0 {
            low = guess
        } else {
            high = guess
        }
        let next = if newton > low && newton < high {
            // Far from the root a step may pass over pieces of the motion.
            newton.clamp(guess - reach, guess + reach)
        } else if low.is_finite() && high.is_finite() {
            0.5 * low + 0.5 * high
        } else {
            if f > 0.0 { guess + reach } else { guess - reach }
        };
        reach *= 2.0;
        if is_last_step(next == newton, guess, next) || next == low || next == high {
            return Ok(next);
        }
        guess = next;
    }
    Ok(guess)
}

/// True if a root is known to rounding after the step from `from` to `to`: the error after a step
/// of Newton's method is about its square.
fn is_last_step(is_newton: bool, from: f64, to: f64) -> bool {
    let rounding = 1e-15 * to.abs().max(1.0);
    (to - from).abs() <= if is_newton { rounding.max(1e-9) } else { rounding }
}

impl Turn {
    /// `None` without a spin.
    pub(super) fn new(pivot: DVec3, spin: Spin) -> Option<Self> {
        (!spin.is_none()).then_some(Self { pivot, spin })
    }
}

impl Moving {
    pub(super) fn pose(&self, own_time: f64) -> Pose {
        let turn = |turn: DQuat, next: &Turn| next.spin.turn(own_time) * turn;
        Pose { turn: self.turns.iter().fold(DQuat::IDENTITY, turn), ..self.carried(own_time) }
    }

    /// The pose without spin.
    pub(super) fn carried(&self, own_time: f64) -> Pose {
        match &self.path {
            Path::Accelerated(acceleration) => acceleration.pose(own_time),
            Path::Curved(framed) => framed.pose(own_time).0,
        }
    }

    /// The pose without spin, and the proper acceleration in the carried axes.
    pub(super) fn carried_with_acceleration(&self, own_time: f64) -> (Pose, DVec3) {
        match &self.path {
            Path::Accelerated(acceleration) => {
                (acceleration.pose(own_time), acceleration.at(own_time))
            }
            Path::Curved(framed) => framed.pose(own_time),
        }
    }

    /// ξ of a point and its derivative by τ, in the carried axes.
    pub(super) fn offset(&self, point: DVec3, own_time: f64) -> Offset {
        self.offset_and_turn(point, own_time).0
    }

    /// ξ of a point and its derivative by τ, and the rotation of the body, at an own time.
    pub(super) fn offset_and_turn(&self, point: DVec3, own_time: f64) -> (Offset, DQuat) {
        let mut offset = Offset { xi: point, swing: DVec3::ZERO };
        let mut all = DQuat::IDENTITY;
        for Turn { pivot, spin } in &self.turns {
            let (turn, rate) = (spin.turn(own_time), spin.rate(own_time));
            let arm = turn * (offset.xi - *pivot);
            offset = Offset { xi: *pivot + arm, swing: rate.cross(arm) + turn * offset.swing };
            all = turn * all;
        }
        (Offset { xi: offset.xi - self.at, ..offset }, all)
    }

    /// The proper acceleration in the carried axes.
    pub(super) fn acceleration(&self, own_time: f64) -> DVec3 {
        match &self.path {
            Path::Accelerated(acceleration) => acceleration.at(own_time),
            Path::Curved(framed) => framed.pose(own_time).1,
        }
    }

    /// X(τ) = z(τ) + Σ ξⁱ e_i and ∂X/∂τ = (1 + a·ξ) u + (dξ/dτ)ⁱ e_i.  Eq. (P41)
    pub(super) fn point_event(
        &self,
        point: DVec3,
        own_time: f64,
    ) -> Result<PointEvent, WorldLineError> {
        let offset = self.offset(point, own_time);
        let Offset { xi, swing } = offset;
        let (lapse, (event, rate)) = match &self.path {
            Path::Accelerated(acceleration) => {
                let lapse = check_lapse(1.0 + acceleration.at(own_time).dot(xi), swing, own_time)?;
                (lapse, acceleration.moment(offset, own_time))
            }
            Path::Curved(_) => {
                let (pose, acceleration) = self.carried_with_acceleration(own_time);
                let Pose { event, scene_from_axes: axes, .. } = pose;
                let lapse = check_lapse(1.0 + acceleration.dot(xi), swing, own_time)?;
                let at = event + axes.apply(Event { t: 0.0, x: xi });
                (lapse, (at, axes.apply(Event { t: lapse, x: swing })))
            }
        };
        Ok(PointEvent { event, rate, clock: clock(lapse, swing) })
    }

    /// See [`super::WorldLine::at_event`].
    pub(super) fn at_event(&self, event: Event) -> Result<(DVec3, f64), WorldLineError> {
        let (own_time, xi, lapse) = match &self.path {
            Path::Accelerated(acceleration) => {
                let (own_time, xi) = acceleration.own_time_at(event)?;
                (own_time, xi, 1.0 + acceleration.at(own_time).dot(xi))
            }
            Path::Curved(_) => {
                let own_time = self.own_time_at(event);
                let (pose, acceleration) = self.carried_with_acceleration(own_time);
                let Event { t, x: xi } = pose.scene_from_axes.inverse().apply(event - pose.event);
                // What rounding left.
                (own_time + t, xi, 1.0 + acceleration.dot(xi))
            }
        };
        let (mut point, mut swing, mut outer) = (xi + self.at, DVec3::ZERO, DQuat::IDENTITY);
        for Turn { pivot, spin } in self.turns.iter().rev() {
            let (turn, arm) = (spin.turn(own_time), point - *pivot);
            swing += outer * spin.rate(own_time).cross(arm);
            (point, outer) = (*pivot + turn.inverse() * arm, outer * turn);
        }
        check_lapse(lapse, swing, own_time).map(|_| (point, own_time))
    }

    /// The root of (X − z(τ))·u(τ), which decreases by 1 + a·ξ.
    fn own_time_at(&self, event: Event) -> f64 {
        decreasing_root(|own_time| {
            let (pose, acceleration) = self.carried_with_acceleration(own_time);
            let Event { t, x } = pose.scene_from_axes.inverse().apply(event - pose.event);
            (t, 1.0 + acceleration.dot(x))
        })
    }

    /// See [`super::WorldLine::own_time_when`].
    pub(super) fn own_time_when(&self, event: Event, frame: Lorentz) -> f64 {
        decreasing_root(|own_time| {
            let Pose { event: at, scene_from_axes, .. } = self.carried(own_time);
            let lapse = frame.apply(scene_from_axes.apply(Event { t: 1.0, x: DVec3::ZERO })).t;
            (frame.apply(event - at).t, lapse)
        })
    }

    pub(super) fn emission(
        &self,
        point: DVec3,
        observer: Event,
    ) -> Result<EmissionEvent, WorldLineError> {
        let (own_time, PointEvent { event, rate, clock }) = self.root(point, observer, None)?;
        Ok(EmissionEvent { own_time, event, velocity: Velocity::from_proper(rate.x / clock)? })
    }

    /// See [`super::WorldLine::light_near`].
    pub(super) fn light(
        &self,
        point: DVec3,
        observer: Event,
        guess: Option<f64>,
    ) -> Result<SeenLight, WorldLineError> {
        let (own_time, PointEvent { event, rate, clock }) = self.root(point, observer, guess)?;
        let away = unit_or_zero(event.x - observer.x);
        Ok(SeenLight { own_time, event, inverse_doppler: (rate.t + away.dot(rate.x)) / clock })
    }

    /// The own time at which light leaves a point for `observer`, and the event there.
    pub(super) fn root(
        &self,
        point: DVec3,
        observer: Event,
        guess: Option<f64>,
    ) -> Result<(f64, PointEvent), WorldLineError> {
        if let Path::Accelerated(acceleration) = &self.path
            && acceleration.is_none()
        {
            return self.root_of_turn(acceleration, point, observer, guess);
        }
        let guess = guess.unwrap_or_else(|| self.guess(observer, point));
        let own_time = self.emission_time(point, observer, guess)?;
        let mut at = self.point_event(point, own_time)?;
        // Rounding of the own time leaves a fast point off the light cone, by γ times as much.
        let way = observer.x - at.event.x;
        let rate = at.rate;
        let left =
            (observer.t - at.event.t - way.length()) / (rate.t - unit_or_zero(way).dot(rate.x));
        if left.is_finite() {
            at.event = at.event + Event { t: rate.t * left, x: rate.x * left };
        }
        Ok((own_time, at))
    }

    /// The root of F(τ) = (t_o − t_X) − |x_o − x_X|.
    pub(super) fn emission_time(
        &self,
        point: DVec3,
        observer: Event,
        guess: f64,
    ) -> Result<f64, WorldLineError> {
        let value = |own_time: f64| -> Result<(f64, f64), WorldLineError> {
            let PointEvent { event, rate, .. } = self.point_event(point, own_time)?;
            let way = observer.x - event.x;
            let toward = unit_or_zero(way);
            Ok((observer.t - event.t - way.length(), toward.dot(rate.x) - rate.t))
        };
        root_from(guess, value)
    }

    /// The own time at which a point is at the time `t`, and the event there.
    pub(super) fn at_time(
        &self,
        point: DVec3,
        t: f64,
        guess: f64,
    ) -> Result<(f64, PointEvent), WorldLineError> {
        let own_time = root_from(guess, |own_time| {
            let PointEvent { event, rate, .. } = self.point_event(point, own_time)?;
            Ok((t - event.t, -rate.t))
        })?;
        let mut at = self.point_event(point, own_time)?;
        // Rounding of the own time leaves a fast point at another time, by γ times as much.
        let left = (t - at.event.t) / at.rate.t;
        if left.is_finite() {
            at.event = Event { t, x: at.event.x + left * at.rate.x };
        }
        Ok((own_time, at))
    }

    /// Without acceleration, in the rest frame of A: the fixed point of τ = t_o − |x_o − ξ(τ)|.
    fn root_of_turn(
        &self,
        path: &Acceleration,
        point: DVec3,
        observer: Event,
        guess: Option<f64>,
    ) -> Result<(f64, PointEvent), WorldLineError> {
        const MOST_STEPS: usize = 200;
        let Pose { event: start, scene_from_axes: axes, .. } = path.start();
        let Event { t, x } = axes.inverse().apply(observer - start);
        let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
        let mut own_time = guess.unwrap_or_else(|| t - (x - self.offset(point, 0.0).xi).length());
        for _ in 0..MOST_STEPS {
            let Offset { xi, swing } = self.offset(point, own_time);
            let way = x - xi;
            let distance = way.length();
            let f = t - own_time - distance;
            if f > 0.0 {
                low = own_time;
            } else {
                high = own_time;
            }
            let slope = if distance > 0.0 { way.dot(swing) / distance - 1.0 } else { -1.0 };
            let newton = own_time - f / slope;
            // The fixed point always gets nearer, since |dξ/dτ| < 1.
            let next = if newton > low && newton < high { newton } else { own_time + f };
            let is_last = is_last_step(next == newton, own_time, next) || !next.is_finite();
            own_time = next;
            if is_last {
                break;
            }
        }
        let Offset { xi, swing } = self.offset(point, own_time);
        check_lapse(1.0, swing, own_time)?;
        let event = start + axes.apply(Event { t: own_time, x: xi });
        let rate = axes.apply(Event { t: 1.0, x: swing });
        Ok((own_time, PointEvent { event, rate, clock: clock(1.0, swing) }))
    }

    /// The root for a body that moves on as it does at own time 0.
    pub(super) fn guess(&self, observer: Event, point: DVec3) -> f64 {
        let Pose { event, scene_from_axes, .. } = self.pose(0.0);
        let Event { t, x } = scene_from_axes.inverse().apply(observer - event);
        let guess = t - (x - self.offset(point, 0.0).xi).length();
        if guess.is_finite() { guess } else { 0.0 }
    }

    /// w = (dξ/dτ)/(1 + a·ξ): the velocity of a point in the rest frame of A.
    pub(super) fn velocity_in_axes(&self, point: DVec3, own_time: f64) -> DVec3 {
        self.offset(point, own_time).velocity_in_axes(self.acceleration(own_time))
    }

    pub(super) fn element(&self, point: DVec3, own_time: f64) -> ElementFrame {
        let (Pose { scene_from_axes, .. }, acceleration) = self.carried_with_acceleration(own_time);
        let (offset, turn) = self.offset_and_turn(point, own_time);
        let velocity_in_axes = offset.velocity_in_axes(acceleration);
        let rate = scene_from_axes.apply(Event { t: 1.0, x: velocity_in_axes });
        let velocity = Velocity::from_proper(
            rate.x / ((1.0 - velocity_in_axes.length()) * (1.0 + velocity_in_axes.length())).sqrt(),
        );
        let velocity = velocity.unwrap_or_default();
        ElementFrame {
            velocity,
            turn,
            velocity_in_axes,
            from_axes: Lorentz::boost(velocity).inverse() * scene_from_axes,
        }
    }
}

/// The rest frame of a surface element of a body in motion, with the axes of a single boost from
/// the frame of the scene.
#[derive(Clone, Copy, Debug)]
pub struct ElementFrame {
    /// The velocity of the element.
    pub velocity: Velocity,
    /// From the axes of the body to the carried ones.
    turn: DQuat,
    /// w = (dξ/dτ)/(1 + a·ξ), in the carried axes.
    velocity_in_axes: DVec3,
    /// From the carried axes, with time along u.
    from_axes: Lorentz,
}

impl ElementFrame {
    /// A short line on the body, such as an edge of a lamp at the element, as it is in this frame.
    /// `line`: in the coordinates of the body.  Eq. (P43)
    pub fn line(&self, line: DVec3) -> DVec3 {
        self.from_axes.apply(Event { t: 0.0, x: self.turn * line }).x
    }

    /// The unit normal of the surface in this frame. It differs from that of the body's shape where
    /// the body spins: N = (n·w; n)/√(1 − (n·w)²) in the axes (u; e_i), perpendicular to ∂X/∂τ and
    /// to both tangents of the surface.  Eq. (P43)
    ///
    /// `normal`: a unit vector, in the coordinates of the body.
    pub fn normal(&self, normal: DVec3) -> DVec3 {
        let n = self.turn * normal;
        let along = n.dot(self.velocity_in_axes);
        let scale = 1.0 / ((1.0 - along) * (1.0 + along)).sqrt();
        // Where it rests, the time component is 0.
        unit_or_zero(self.from_axes.apply(Event { t: along * scale, x: n * scale }).x)
    }
}
