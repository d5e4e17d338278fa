//! World lines of bodies: where their points are at every time, and when light of theirs is seen.
//!
//! A body follows the world line z(τ) of its reference point A, whose own time is τ. It has axes
//! e₁, e₂, e₃ perpendicular to the four-velocity u = dz/dτ that are carried without turning
//! (Fermi-Walker transport), in which it may spin.

mod curve;
mod horizon;
mod inertial;
mod moving;
mod pieces;
mod range_maximum;
mod ray;
mod seen;
mod spline;
mod table;

use std::borrow::Cow;

use glam::{DQuat, DVec3};

pub use inertial::InertialFrame;
pub use moving::ElementFrame;
pub use pieces::Piece;
pub use ray::{RayPoint, RayStretch, SmoothStretch, WorldTube};
pub use seen::{SeenPoint, SeenTriangle};
pub use table::SampledPath;

use crate::{Event, Lorentz, Velocity, VelocityError};
use curve::{Curve, Framed};
use moving::{Moving, Path, PointEvent, Turn};
use pieces::{Acceleration, Spin};

/// The motion of a body in the frame of the scene.
///
/// Coordinates of a body are rest coordinates: those of the scene at the body's own time 0. A body
/// of constant velocity is inertial; all others are rigid in the sense of Born, apart from their
/// spin.
///
/// ```
/// use glam::DVec3;
/// use ugphysics::{Event, Piece, Velocity, WorldLine};
///
/// // A ship that leaves with half a unit of proper acceleration, for 4 units of its own time.
/// let push = Piece { of: DVec3::new(0.5, 0.0, 0.0), from: 0.0, to: 4.0 };
/// let ship = WorldLine::accelerated(DVec3::ZERO, Velocity::ZERO, &[push], &[])?;
/// let seen = ship.emission(DVec3::Y, Event { t: 3.0, x: DVec3::ZERO })?;
/// assert!((seen.own_time - 1.60943791243).abs() < 1e-11);
/// assert!((seen.velocity.speed() - 2.0 / 3.0).abs() < 1e-12);
/// # Ok::<(), ugphysics::WorldLineError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct WorldLine(Kind);

#[derive(Clone, Debug, PartialEq)]
enum Kind {
    Inertial(InertialFrame),
    Moving(Box<Moving>),
}

/// The event of A at some own time, and the body's axes there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// z(τ), in the frame of the scene.
    pub event: Event,
    /// The frame of the scene from the axes (u; e₁, e₂, e₃).
    pub scene_from_axes: Lorentz,
    /// The turn R(τ) of the body in these axes, of all its spins together.
    pub turn: DQuat,
}

/// The event at which light left a point of a body, and how the body moves there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EmissionEvent {
    /// The own time τ of A at which the light left, simultaneous in the frame of A.
    pub own_time: f64,
    /// The event, in the frame of the scene.
    pub event: Event,
    /// The velocity of the point in the frame of the scene.
    pub velocity: Velocity,
}

/// The light that an observer receives from a point of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeenLight {
    /// The own time τ of A at which it left, simultaneous in the frame of A.
    pub own_time: f64,
    /// The event at which it left.
    pub event: Event,
    /// 1/D for an observer at rest.  Eq. (P10)
    pub inverse_doppler: f64,
}

/// Why a motion is impossible, or no event is found.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum WorldLineError {
    /// A number is NaN or infinite, or becomes so at some own time.
    NotFinite,
    /// A piece ends before it begins.
    EmptyPiece {
        /// Its begin and end.
        piece: [f64; 2],
    },
    /// Two pieces overlap.
    Overlap {
        /// The begin of the second.
        from: f64,
    },
    /// A velocity is invalid, or its rapidity too large.
    Velocity(VelocityError),
    /// A piece of acceleration adds more rapidity than [`WorldLine::MOST_RAPIDITY`].
    TooLong {
        /// |a| times the own time of the piece.
        rapidity: f64,
    },
    /// The axis of an orbit is the zero vector.
    NoAxis,
    /// A path has fewer than two events.
    FewEvents,
    /// The time of an event is not later than that of the one before.
    TimeOrder {
        /// The earlier of the two, counted from 0.
        row: usize,
    },
    /// Between two events of a path the speed is not below that of light.
    TooFast {
        /// The earlier of the two, counted from 0.
        row: usize,
    },
    /// A point would move at the speed of light or faster: it is too far from the axis of the spin,
    /// or beyond the horizon of the acceleration, 1 + a·ξ ≤ |ω×ξ|.  Eq. (P41)
    Horizon {
        /// The own time at which this happens first.
        own_time: f64,
    },
    /// The body has turned by more than [`WorldLine::MOST_TURN`].
    ManyTurns {
        /// The own time at which it is asked for.
        own_time: f64,
    },
}

impl core::fmt::Display for WorldLineError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::NotFinite => write!(f, "a number of the motion is too large"),
            Self::EmptyPiece { piece: [from, to] } => {
                write!(f, "a piece from {from} to {to} is empty")
            }
            Self::Overlap { from: f64::NEG_INFINITY } => {
                write!(f, "two pieces of a kind act at all times")
            }
            Self::Overlap { from } => {
                write!(f, "the piece that begins at {from} overlaps the one before")
            }
            Self::Velocity(error) => error.fmt(f),
            Self::TooLong { rapidity } => write!(
                f,
                "an acceleration adds the rapidity {rapidity}: it may be {} at most",
                WorldLine::MOST_RAPIDITY
            ),
            Self::NoAxis => write!(f, "the axis is the zero vector"),
            Self::FewEvents => write!(f, "the path has fewer than two events"),
            Self::TimeOrder { row } => {
                write!(f, "the time does not increase from event {} on", row + 1)
            }
            Self::TooFast { row } => {
                write!(
                    f,
                    "the speed reaches that of light between events {} and {}",
                    row + 1,
                    row + 2
                )
            }
            Self::Horizon { own_time } => {
                write!(
                    f,
                    "at own time {own_time} the point would move at the speed of light or faster"
                )
            }
            Self::ManyTurns { own_time } => write!(
                f,
                "at own time {own_time:e} it has turned by more than {:e} radians, after which its place is not known to 1e-4 radians",
                WorldLine::MOST_TURN
            ),
        }
    }
}

impl core::error::Error for WorldLineError {}

impl From<VelocityError> for WorldLineError {
    fn from(error: VelocityError) -> Self {
        // The numbers that a velocity is computed from are finite.
        if error == VelocityError::NotFinite { Self::NotFinite } else { Self::Velocity(error) }
    }
}

impl WorldLine {
    /// The greatest rapidity that one piece of acceleration adds; a piece without an end ends
    /// there. At 1 g it is reached after 48 years, at a distance of 10²¹ light years.
    pub const MOST_RAPIDITY: f64 = 50.0;

    /// The greatest angle in radians, of an orbit and all spins together, after which a body can be
    /// seen. A time of that size is rounded so that the angle has an error of 1e-4 radians.
    pub const MOST_TURN: f64 = 1e12;

    /// At rest in the scene.
    pub const REST: Self = Self(Kind::Inertial(InertialFrame::REST));

    /// Constant velocity.
    pub fn inertial(frame: InertialFrame) -> Self {
        Self(Kind::Inertial(frame))
    }

    /// A motion whose reference point, `at` in the coordinates of the body, passes given events, at
    /// whose first its own time is 0.  Eq. (P48)
    ///
    /// # Errors
    /// See [`WorldLineError`].
    pub fn along(at: DVec3, path: SampledPath, spins: &[Piece]) -> Result<Self, WorldLineError> {
        Self::on_curve(at, path.velocity(), Curve::Along(path), spins)
    }

    /// A motion whose reference point, `at` in the coordinates of the body, follows a curve.
    /// `initial`: its velocity at own time 0.
    fn on_curve(
        at: DVec3,
        initial: Velocity,
        curve: Curve,
        spins: &[Piece],
    ) -> Result<Self, WorldLineError> {
        if !at.is_finite() {
            return Err(WorldLineError::NotFinite);
        }
        let turns = Turn::new(at, Spin::new(spins)?).into_iter().collect();
        let path = Path::Curved(Box::new(Framed::new(curve)));
        Ok(Self(Kind::Moving(Box::new(Moving { at, initial, path, turns }))))
    }

    /// A motion with the velocity `velocity` at own time 0, with proper acceleration and spin.
    ///
    /// `at`: A, in the coordinates of the body, and its place at own time 0, which is time 0.
    /// `accelerations`: proper acceleration along the carried axes. `spins`: angular velocity about
    /// A in the carried axes, radians per unit of own
    /// time. Outside all pieces the motion is inertial.
    ///
    /// # Errors
    /// See [`WorldLineError`]; pieces may not overlap.
    pub fn accelerated(
        at: DVec3,
        velocity: Velocity,
        accelerations: &[Piece],
        spins: &[Piece],
    ) -> Result<Self, WorldLineError> {
        if !at.is_finite() {
            return Err(WorldLineError::NotFinite);
        }
        let frame = InertialFrame { at, ..InertialFrame::new(velocity) };
        let acceleration = Acceleration::new(frame.pose(0.0), accelerations)?;
        let spin = Spin::new(spins)?;
        if acceleration.is_none() && spin.is_none() {
            return Ok(Self::inertial(frame));
        }
        let turns = Turn::new(at, spin).into_iter().collect();
        let path = Path::Accelerated(acceleration);
        Ok(Self(Kind::Moving(Box::new(Moving { at, initial: velocity, path, turns }))))
    }

    /// The motion of a part of a body with this motion, which spins about its point `at` of it: a
    /// wheel on a car. Own times of the part are those of the body.
    ///
    /// `spins`: angular velocity about `at`, along the axes that the body has at own time 0 and
    /// that turn with it.
    ///
    /// # Errors
    /// See [`WorldLineError`].
    pub fn with_part(&self, at: DVec3, spins: &[Piece]) -> Result<Self, WorldLineError> {
        if !at.is_finite() {
            return Err(WorldLineError::NotFinite);
        }
        let Some(turn) = Turn::new(at, Spin::new(spins)?) else { return Ok(self.clone()) };
        let mut moving = self.moving().into_owned();
        moving.turns.insert(0, turn);
        Ok(Self(Kind::Moving(Box::new(moving))))
    }

    /// The same motion in other coordinates of space-time: `target_from_source` after `origin` is
    /// subtracted.
    pub fn in_frame(&self, target_from_source: Lorentz, origin: Event) -> Self {
        let mut moving = match &self.0 {
            Kind::Inertial(frame) => {
                return Self(Kind::Inertial(frame.in_frame(target_from_source, origin)));
            }
            Kind::Moving(moving) => (**moving).clone(),
        };
        match &mut moving.path {
            Path::Accelerated(acceleration) => {
                acceleration.change_frame(target_from_source, origin)
            }
            Path::Curved(framed) => framed.change_frame(target_from_source, origin),
        }
        let frame = moving.pose(0.0).scene_from_axes;
        moving.initial = frame.velocity_of_frame().unwrap_or(moving.initial);
        Self(Kind::Moving(Box::new(moving)))
    }

    /// The motion, in the frame that `carrier` moves in, of what has this motion in the coordinates
    /// of the carrier.
    ///
    /// # Errors
    /// A velocity that rounds to that of light.
    pub fn carried_by(&self, carrier: &InertialFrame) -> Result<Self, WorldLineError> {
        if let Kind::Inertial(frame) = &self.0 {
            return Ok(Self(Kind::Inertial(carrier.carrying(frame)?)));
        }
        let axes = carrier.axes();
        let origin = Event { t: 0.0, x: carrier.at } - axes.inverse().apply(carrier.start());
        let line = self.in_frame(axes, origin);
        line.pose(0.0).scene_from_axes.velocity_of_frame()?;
        Ok(line)
    }

    /// The same motion with `anchor` as the fixed point of the contraction at own time 0, instead
    /// of A.
    pub fn anchored(&self, anchor: DVec3) -> Self {
        self.displaced(self.anchor_shift(anchor))
    }

    /// The same motion, displaced in space and time.
    pub fn displaced(&self, shift: Event) -> Self {
        self.in_frame(Lorentz::IDENTITY, Event { t: -shift.t, x: -shift.x })
    }

    /// True if it passes given events, or is part of a motion that does: its place in space and
    /// time is stated, and no body is placed otherwise by what is seen of it.
    pub fn passes_events(&self) -> bool {
        let is_table = |path: &Path| matches!(path, Path::Curved(framed) if matches!(framed.curve, Curve::Along(_)));
        matches!(&self.0, Kind::Moving(moving) if is_table(&moving.path))
    }

    /// The displacement in space and time of [`WorldLine::anchored`]; none if it runs on a circle
    /// or passes given events, whose place is stated.
    pub fn anchor_shift(&self, anchor: DVec3) -> Event {
        let moving = self.moving();
        if !matches!(moving.path, Path::Accelerated(_)) {
            return Event::ORIGIN;
        }
        let at = moving.at;
        let Pose { event, scene_from_axes, .. } = self.pose(0.0);
        let there = Event { t: 0.0, x: anchor };
        there - (event + scene_from_axes.apply(there - Event { t: 0.0, x: at }))
    }

    /// The displacement, simultaneous in the rest frame of A at own time 0, after which `point` is
    /// at `event`.
    ///
    /// # Errors
    /// [`WorldLineError::Horizon`] if the point cannot move so.
    pub fn displacement_to(&self, point: DVec3, event: Event) -> Result<Event, WorldLineError> {
        let from_scene = Lorentz::boost(self.initial_velocity()).inverse();
        let wanted = from_scene.apply(event).t;
        let time = |own_time: f64| -> Result<f64, WorldLineError> {
            Ok(from_scene.apply(self.event(point, own_time)?).t - wanted)
        };
        // Time passes everywhere, so there is one root: bracketed, then halved.
        let mut reach = 1.0;
        while time(-reach)? > 0.0 || time(reach)? < 0.0 {
            reach *= 2.0;
            if reach > 1e300 {
                return Err(WorldLineError::NotFinite);
            }
        }
        let (mut low, mut high) = (-reach, reach);
        loop {
            let middle = 0.5 * low + 0.5 * high;
            if middle <= low || middle >= high {
                return Ok(event - self.event(point, middle)?);
            }
            if time(middle)? < 0.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
    }

    /// The frame of a point of the body at an own time: the frame of the scene from it, with axes
    /// that turn with the body.
    pub fn frame(&self, point: DVec3, own_time: f64) -> Lorentz {
        let pose = self.pose(own_time);
        let in_axes = self.moving().velocity_in_axes(point, own_time);
        let in_axes = Velocity::from_beta(in_axes).unwrap_or_default();
        pose.scene_from_axes * Lorentz::boost(in_axes) * Lorentz::rotation(pose.turn)
    }

    /// The same motion with coordinates of the body that are relative to `origin`.
    pub fn with_body_origin(&self, origin: DVec3) -> Self {
        let mut moving = match &self.0 {
            Kind::Inertial(frame) => {
                let shift = frame.shift + Event { t: 0.0, x: origin };
                return Self(Kind::Inertial(InertialFrame {
                    at: frame.at - origin,
                    shift,
                    ..*frame
                }));
            }
            Kind::Moving(moving) => (**moving).clone(),
        };
        moving.at -= origin;
        moving.turns.iter_mut().for_each(|turn| turn.pivot -= origin);
        Self(Kind::Moving(Box::new(moving)))
    }

    /// The rest frame of a body that neither accelerates nor turns; `None` for others.
    pub fn inertial_frame(&self) -> Option<&InertialFrame> {
        match &self.0 {
            Kind::Inertial(frame) => Some(frame),
            Kind::Moving(_) => None,
        }
    }

    /// The motion as one that may accelerate or turn.
    fn moving(&self) -> Cow<'_, Moving> {
        match &self.0 {
            Kind::Inertial(frame) => Cow::Owned(frame.as_moving()),
            Kind::Moving(moving) => Cow::Borrowed(moving),
        }
    }

    /// The velocity at own time 0.
    pub fn initial_velocity(&self) -> Velocity {
        match &self.0 {
            Kind::Inertial(frame) => frame.velocity,
            Kind::Moving(moving) => moving.initial,
        }
    }

    /// Event and axes of the reference point at an own time.
    pub fn pose(&self, own_time: f64) -> Pose {
        self.moving().pose(own_time)
    }

    /// The event of a point of the body at an own time of its reference point.  Eq. (P41)
    ///
    /// # Errors
    /// [`WorldLineError::Horizon`] if the point cannot move so.
    pub fn event(&self, point: DVec3, own_time: f64) -> Result<Event, WorldLineError> {
        Ok(self.moving().point_event(point, own_time)?.event)
    }

    /// The event at which a point of the body sends the light that reaches `observer`, and its
    /// velocity there: the root of (t_o − t_X) − |x_o − x_X|, of which there is one.  Eq. (P42)
    ///
    /// `point`: in the coordinates of the body. `observer`: an event in the frame of the scene.
    ///
    /// # Errors
    /// [`WorldLineError::Horizon`] if the point cannot move so.
    pub fn emission(&self, point: DVec3, observer: Event) -> Result<EmissionEvent, WorldLineError> {
        self.moving().emission(point, observer)
    }

    /// The light that a point of the body sends to `observer`, who is at rest in the scene.  Eq.
    /// (P42), (P10)
    ///
    /// # Errors
    /// As [`WorldLine::emission`].
    pub fn light(&self, point: DVec3, observer: Event) -> Result<SeenLight, WorldLineError> {
        self.moving().light(point, observer, None)
    }

    /// The same, for light that left near the own time `guess`. The closer the guess, the sooner it
    /// is found.
    ///
    /// # Errors
    /// As [`WorldLine::emission`].
    pub fn light_near(
        &self,
        point: DVec3,
        observer: Event,
        guess: f64,
    ) -> Result<SeenLight, WorldLineError> {
        self.moving().light(point, observer, Some(guess))
    }

    /// The event of a point of the body at the time `t` of the frame of the scene, and its velocity
    /// there: where the body is at this time, not where it is seen.  Eq. (P41)
    ///
    /// # Errors
    /// [`WorldLineError::Horizon`] if the point cannot move so.
    pub fn at_time(&self, point: DVec3, t: f64) -> Result<EmissionEvent, WorldLineError> {
        let (own_time, PointEvent { event, rate, clock }) = self.moving().at_time(point, t, 0.0)?;
        Ok(EmissionEvent { own_time, event, velocity: Velocity::from_proper(rate.x / clock)? })
    }

    /// The point of the body at an event, and the own time τ of A there: the inverse of
    /// [`WorldLine::event`], by the root of (X − z(τ))·u(τ) = 0, of which there is one before the
    /// horizon of the acceleration.  Eq. (P45)
    ///
    /// # Errors
    /// [`WorldLineError::Horizon`] if no point of the body can be there.
    pub fn at_event(&self, event: Event) -> Result<(DVec3, f64), WorldLineError> {
        self.moving().at_event(event)
    }

    /// The velocity of a point of the body at an own time, in the frame of the scene.
    ///
    /// # Errors
    /// [`WorldLineError::Horizon`] if the point cannot move so.
    pub fn velocity(&self, point: DVec3, own_time: f64) -> Result<Velocity, WorldLineError> {
        let PointEvent { rate, clock, .. } = self.moving().point_event(point, own_time)?;
        Ok(Velocity::from_proper(rate.x / clock)?)
    }

    /// The own time of A at an event's time in another frame, whose coordinates `frame` gives from
    /// those of the world line: the light of directional lamps is that of this time.  Eq. (P14)
    pub fn own_time_when(&self, event: Event, frame: Lorentz) -> f64 {
        self.moving().own_time_when(event, frame)
    }

    /// Where a point of the body would be in its coordinates at an own time if it only turned, A +
    /// ξ, and the turn.
    pub fn standing(&self, point: DVec3, own_time: f64) -> (DVec3, DQuat) {
        let moving = self.moving();
        let (offset, turn) = moving.offset_and_turn(point, own_time);
        (moving.at + offset.xi, turn)
    }

    /// A vector d in the coordinates of the body such that n·d is, up to a positive factor, the
    /// component of the light ray `ray` along the outward normal of a surface with the normal n
    /// there, in the rest frame of the surface element.  Eq. (P43)
    ///
    /// `ray`: a null vector in the frame of the scene.
    pub fn facing_covector(&self, point: DVec3, own_time: f64, ray: Event) -> DVec3 {
        let moving = self.moving();
        let (offset, turn) = moving.offset_and_turn(point, own_time);
        let (pose, acceleration) = moving.carried_with_acceleration(own_time);
        let Event { t, x } = pose.scene_from_axes.inverse().apply(ray);
        turn.inverse() * (x - offset.velocity_in_axes(acceleration) * t)
    }

    /// Checks that a point of the body can move so at all times.
    ///
    /// The check is exact where at most one of acceleration and spin acts on the point at a time;
    /// elsewhere it samples the time unless a bound shows that nothing is near the horizon.
    ///
    /// # Errors
    /// [`WorldLineError::Horizon`] with an own time at which the point would reach the speed of
    /// light.
    pub fn check(&self, point: DVec3) -> Result<(), WorldLineError> {
        self.moving().check(point)
    }

    /// Checks that the place of the body is known at an own time, in spite of rounding.
    ///
    /// # Errors
    /// [`WorldLineError::ManyTurns`] if the body has turned by more than [`WorldLine::MOST_TURN`].
    pub fn check_turn(&self, own_time: f64) -> Result<(), WorldLineError> {
        self.moving().check_turn(own_time)
    }

    /// Checks that the place of the body is known when `observer`, an event in the frame of the
    /// scene, sees its reference point.
    ///
    /// # Errors
    /// See [`WorldLine::check_turn`] and [`WorldLine::emission`].
    pub fn check_turn_seen(&self, observer: Event) -> Result<(), WorldLineError> {
        let moving = self.moving();
        moving.check_turn(moving.emission(moving.at, observer)?.own_time)
    }

    /// The rest frame of a surface element at a point of the body.
    ///
    /// `point`: in the coordinates of the body.
    pub fn element(&self, point: DVec3, own_time: f64) -> ElementFrame {
        self.moving().element(point, own_time)
    }
}
