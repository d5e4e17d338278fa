//! Motions in pieces of own time: constant proper acceleration, and constant spin.

use glam::{DQuat, DVec3};

use super::{Pose, WorldLine, WorldLineError};
use crate::{Event, HyperbolicMotion, Lorentz};

/// A point of a body relative to A, in the carried axes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Offset {
    /// ξ
    pub xi: DVec3,
    /// dξ/dτ
    pub swing: DVec3,
}

impl Offset {
    /// w = (dξ/dτ)/(1 + a·ξ): the velocity of the point in the rest frame of A.
    pub fn velocity_in_axes(self, acceleration: DVec3) -> DVec3 {
        self.swing / (1.0 + acceleration.dot(self.xi))
    }
}

/// A vector that is constant for a stretch of own time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece {
    /// Proper acceleration, or angular velocity.
    pub of: DVec3,
    /// Own time at which it begins; may be −∞.
    pub from: f64,
    /// Own time at which it ends; may be ∞.
    pub to: f64,
}

impl Piece {
    /// Sorted pieces, without those that are 0.
    fn sorted(pieces: &[Piece]) -> Result<Vec<Piece>, WorldLineError> {
        let mut sorted = pieces.to_vec();
        for piece in pieces {
            if !piece.of.is_finite() || piece.from.is_nan() || piece.to.is_nan() {
                return Err(WorldLineError::NotFinite);
            }
            if piece.from >= piece.to {
                return Err(WorldLineError::EmptyPiece { piece: [piece.from, piece.to] });
            }
        }
        sorted.sort_by(|a, b| a.from.total_cmp(&b.from));
        if let Some(pair) = sorted.windows(2).find(|pair| pair[0].to > pair[1].from) {
            return Err(WorldLineError::Overlap { from: pair[1].from });
        }
        sorted.retain(|piece| piece.of != DVec3::ZERO);
        Ok(sorted)
    }
}

/// Pieces of the whole of own time around 0, those without acceleration or spin included: (begin,
/// value), each up to the next.
fn without_gaps(pieces: &[Piece]) -> Vec<(f64, DVec3)> {
    let mut all = vec![(f64::NEG_INFINITY, DVec3::ZERO)];
    let mut push = |from: f64, of: DVec3| {
        match all.last_mut() {
            Some(last) if last.0 == from => last.1 = of,
            _ => all.push((from, of)),
        };
    };
    for piece in pieces {
        push(piece.from, piece.of);
        push(piece.to, DVec3::ZERO);
    }
    all.retain(|&(from, _)| from < f64::INFINITY);
    all
}

/// All of own time in stretches, in each of which a vector is constant, with a state that follows
/// from it by `advance(vector, state, passed own time)`.
#[derive(Clone, Debug, PartialEq)]
struct Timeline<T> {
    stretches: Vec<Stretch<T>>,
    /// The greatest length of a vector.
    greatest: f64,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Stretch<T> {
    from: f64,
    of: DVec3,
    /// Own time at which the state is known.
    known_at: f64,
    state: T,
}

impl<T: Copy> Timeline<T> {
    /// `start`: the state at own time 0.
    fn new(pieces: &[Piece], start: T, advance: impl Fn(DVec3, T, f64) -> T) -> Self {
        let pieces = without_gaps(pieces);
        let current = pieces.partition_point(|&(from, _)| from <= 0.0) - 1;
        let (before, behind) = pieces.split_at(current);
        let mut known_at = 0.0;
        let mut last = Stretch { from: behind[0].0, of: behind[0].1, known_at, state: start };
        let mut later = vec![last];
        for &(from, of) in &behind[1..] {
            last = Stretch {
                from,
                of,
                known_at: from,
                state: advance(last.of, last.state, from - last.known_at),
            };
            later.push(last);
        }
        // Backwards, each is known at its end.
        let mut all = Vec::with_capacity(pieces.len());
        let (mut state, mut end) = (start, behind[0].0);
        let mut of_later = behind[0].1;
        for &(from, of) in before.iter().rev() {
            state = advance(of_later, state, end - known_at);
            known_at = end;
            all.push(Stretch { from, of, known_at, state });
            (of_later, end) = (of, from);
        }
        all.reverse();
        all.append(&mut later);
        let greatest = pieces.iter().map(|(_, of)| of.length()).fold(0.0, f64::max);
        Self { stretches: all, greatest }
    }

    fn is_constant(&self) -> bool {
        self.stretches.iter().all(|stretch| stretch.of == DVec3::ZERO)
    }

    fn at(&self, own_time: f64) -> &Stretch<T> {
        let row = self.stretches.partition_point(|stretch| stretch.from <= own_time);
        // The first begins at −∞.
        &self.stretches[row.max(1) - 1]
    }

    /// The last own time before this one at which a stretch begins.
    fn begin_before(&self, own_time: f64) -> f64 {
        let row = self.stretches.partition_point(|stretch| stretch.from < own_time);
        self.stretches[row.max(1) - 1].from
    }

    fn state(&self, own_time: f64, advance: impl Fn(DVec3, T, f64) -> T) -> T {
        let Stretch { of, known_at, state, .. } = *self.at(own_time);
        advance(of, state, own_time - known_at)
    }
}

/// The world line of A with constant proper acceleration in pieces.
///
/// A piece of acceleration a and own time d along the unit vector â is the shift (sinh(ad)/a,
/// (cosh(ad) − 1)/a â) with the boost of rapidity ad along â, in the axes at its begin.  Eq. (P40)
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Acceleration(Timeline<Pose>);

impl Acceleration {
    /// `start`: at own time 0.
    pub(super) fn new(start: Pose, accelerations: &[Piece]) -> Result<Self, WorldLineError> {
        let mut pieces = Piece::sorted(accelerations)?;
        pieces.iter_mut().try_for_each(limit_rapidity)?;
        let timeline = Timeline::new(&pieces, start, accelerated);
        let is_finite = |stretch: &Stretch<Pose>| {
            stretch.state.event.x.is_finite() && stretch.state.scene_from_axes.matrix().is_finite()
        };
        if !timeline.stretches.iter().all(is_finite) {
            return Err(WorldLineError::NotFinite);
        }
        // Several pieces together may exceed the limit of velocities.
        for stretch in &timeline.stretches {
            stretch.state.scene_from_axes.velocity_of_frame()?;
        }
        Ok(Self(timeline))
    }

    /// Without acceleration. `start`: at own time 0.
    pub(super) fn none(start: Pose) -> Self {
        Self(Timeline::new(&[], start, accelerated))
    }

    pub(super) fn is_none(&self) -> bool {
        self.0.is_constant()
    }

    pub(super) fn change_frame(&mut self, target_from_source: Lorentz, origin: Event) {
        for Stretch { state, .. } in &mut self.0.stretches {
            state.event = target_from_source.apply(state.event - origin);
            state.scene_from_axes = target_from_source * state.scene_from_axes;
        }
    }

    /// Own times at which the acceleration changes.
    pub(super) fn changes(&self) -> impl Iterator<Item = f64> + '_ {
        self.0.stretches.iter().skip(1).map(|stretch| stretch.from)
    }

    pub(super) fn pose(&self, own_time: f64) -> Pose {
        self.0.state(own_time, accelerated)
    }

    pub(super) fn at(&self, own_time: f64) -> DVec3 {
        self.0.at(own_time).of
    }

    /// Its greatest length.
    pub(super) fn greatest(&self) -> f64 {
        self.0.greatest
    }

    /// At own time 0.
    pub(super) fn start(&self) -> Pose {
        self.pose(0.0)
    }

    /// The event of a point and ∂X/∂τ.  Eq. (P41)
    ///
    /// In the axes at the begin of a piece with acceleration a, at own time d after it, A is at
    /// (sinh(ad)/a, (cosh(ad) − 1)/a â), and u and the axis along â are (cosh, sinh â) and (sinh,
    /// cosh â).
    pub(super) fn moment(&self, Offset { xi, swing }: Offset, own_time: f64) -> (Event, Event) {
        let Stretch { of, known_at, state, .. } = *self.0.at(own_time);
        let passed = own_time - known_at;
        let a = of.length();
        let (event, rate) = if a == 0.0 {
            (Event { t: passed, x: xi }, Event { t: 1.0, x: swing })
        } else {
            let axis = of / a;
            let half = libm::sinh(0.5 * a * passed);
            let (sinh, cosh_minus_one) = (libm::sinh(a * passed), 2.0 * half * half);
            let (along, swing_along) = (xi.dot(axis), swing.dot(axis));
            let (radius, lapse) = (1.0 / a + along, 1.0 + a * along);
            let event = Event { t: sinh * radius, x: xi + axis * (cosh_minus_one * radius) };
            let rate = Event {
                t: (1.0 + cosh_minus_one) * lapse + sinh * swing_along,
                x: swing + axis * (sinh * lapse + cosh_minus_one * swing_along),
            };
            (event, rate)
        };
        let axes = state.scene_from_axes;
        (state.event + axes.apply(event), axes.apply(rate))
    }

    /// The own time at which A is simultaneous with an event in its own frame, and ξ of the event
    /// there.  Eq. (P45)
    ///
    /// Stretches are looked through from own time 0 on: in the axes of one that is far away the
    /// event is lost to rounding.
    pub(super) fn own_time_at(&self, event: Event) -> Result<(f64, DVec3), WorldLineError> {
        let stretches = &self.0.stretches;
        let (mut low, mut high) = (0, stretches.len() - 1);
        let mut row = stretches.partition_point(|stretch| stretch.from <= 0.0).max(1) - 1;
        let mut n_visited = 0;
        loop {
            let stretch = &stretches[row];
            let (own_time, xi) = stretch.own_time_at(event);
            let end = stretches.get(row + 1).map_or(f64::INFINITY, |next| next.from);
            // In long motions the steps grow.
            n_visited += 1;
            let step = 1 + n_visited / 64;
            let next = if own_time > end && row < high {
                low = row + 1;
                if high == stretches.len() - 1 {
                    (row + step).min(high)
                } else {
                    low.midpoint(high)
                }
            } else if own_time < stretch.from && row > low {
                high = row - 1;
                if low == 0 { row.saturating_sub(step) } else { low.midpoint(high) }
            } else if own_time.is_finite() {
                return Ok((own_time, xi));
            } else {
                let own_time = if own_time > 0.0 { end } else { stretch.from };
                let is_finite = own_time.is_finite();
                return Err(if is_finite {
                    WorldLineError::Horizon { own_time }
                } else {
                    WorldLineError::NotFinite
                });
            };
            row = next;
        }
    }

    /// Its values in all stretches.
    pub(super) fn values(&self) -> impl Iterator<Item = DVec3> + '_ {
        self.0.stretches.iter().map(|stretch| stretch.of)
    }

    /// The last own time before this one at which it changes, or −∞.
    pub(super) fn change_before(&self, own_time: f64) -> f64 {
        self.0.begin_before(own_time)
    }
}

impl Stretch<Pose> {
    /// As [`Acceleration::own_time_at`], if the stretch had no ends; infinite if A is never
    /// simultaneous with the event.
    ///
    /// With the horizon as origin the event is at (t, x) = ρ (sinh ad, cosh ad) along the
    /// acceleration, so tanh ad = t/x and aρ = 1 + a·ξ.
    fn own_time_at(&self, event: Event) -> (f64, DVec3) {
        let Event { t, x } = self.state.scene_from_axes.inverse().apply(event - self.state.event);
        let a = self.of.length();
        if a == 0.0 {
            return (self.known_at + t, x);
        }
        let axis = self.of / a;
        let along = x.dot(axis);
        // The first cancels near the horizon, and is not known better than to rounding there.
        let (behind, ahead) = (1.0 + a * (along - t.abs()), 1.0 + a * (along + t.abs()));
        let rounding = 4.0 * f64::EPSILON * (1.0 + a * (along.abs() + t.abs()));
        if !(behind > -rounding && ahead > 0.0) {
            return (f64::INFINITY.copysign(t), x);
        }
        let behind = behind.max(rounding);
        let passed = 0.5 * libm::log1p(2.0 * a * t.abs() / behind) / a;
        let lapse = (behind * ahead).sqrt();
        // (lapse − 1)/a without cancellation.
        let xi = (2.0 * along + a * (along - t) * (along + t)) / (lapse + 1.0);
        (self.known_at + passed.copysign(t), x + axis * (xi - along))
    }
}

/// Ends a piece without an end where it has added [`WorldLine::MOST_RAPIDITY`], and refuses others
/// that add more.
fn limit_rapidity(piece: &mut Piece) -> Result<(), WorldLineError> {
    let most = WorldLine::MOST_RAPIDITY / piece.of.length();
    let Piece { from, to, .. } = *piece;
    if to - from <= most {
        return Ok(());
    }
    if from.is_finite() && to.is_finite() {
        let rapidity = (to - from) * piece.of.length();
        let is_finite = rapidity.is_finite();
        return Err(if is_finite {
            WorldLineError::TooLong { rapidity }
        } else {
            WorldLineError::NotFinite
        });
    }
    piece.to = to.min(from.max(0.0) + most);
    piece.from = from.max(to.min(0.0) - most);
    Ok(())
}

fn accelerated(acceleration: DVec3, pose: Pose, passed: f64) -> Pose {
    if acceleration == DVec3::ZERO {
        let shift = pose.scene_from_axes.apply(Event { t: passed, x: DVec3::ZERO });
        return Pose { event: pose.event + shift, ..pose };
    }
    let motion = HyperbolicMotion { acceleration };
    let shift = pose.scene_from_axes.apply(motion.event(passed));
    let event = pose.event + shift;
    // `limit_rapidity` keeps the rapidity below the limit of `Velocity`.
    let boost = motion.velocity(passed).map_or(Lorentz::IDENTITY, Lorentz::boost);
    Pose { event, scene_from_axes: pose.scene_from_axes * boost, turn: pose.turn }
}

/// Spin in pieces: R(τ), with dR/dτ = [ω]× R and R(0) = 1.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Spin(Timeline<DQuat>);

impl Spin {
    pub(super) fn new(spins: &[Piece]) -> Result<Self, WorldLineError> {
        Ok(Self(Timeline::new(&Piece::sorted(spins)?, DQuat::IDENTITY, turned)))
    }

    pub(super) fn is_none(&self) -> bool {
        self.0.is_constant()
    }

    pub(super) fn turn(&self, own_time: f64) -> DQuat {
        self.0.state(own_time, turned)
    }

    /// Own times at which the rate changes.
    pub(super) fn changes(&self) -> impl Iterator<Item = f64> + '_ {
        self.0.stretches.iter().skip(1).map(|stretch| stretch.from)
    }

    /// The last own time before this one at which the rate changes, or −∞.
    pub(super) fn change_before(&self, own_time: f64) -> f64 {
        self.0.begin_before(own_time)
    }

    /// The greatest rate.
    pub(super) fn greatest(&self) -> f64 {
        self.0.greatest
    }

    pub(super) fn rate(&self, own_time: f64) -> DVec3 {
        self.0.at(own_time).of
    }
}

fn turned(rate: DVec3, turn: DQuat, passed: f64) -> DQuat {
    if rate == DVec3::ZERO { turn } else { rotation(rate, passed) * turn }
}

/// The rotation about `axis` by |axis| times `factor`.
pub(super) fn rotation(axis: DVec3, factor: f64) -> DQuat {
    let length = axis.length();
    let (sin, cos) = libm::sincos(0.5 * length * factor);
    let v = if length > 0.0 { axis * (sin / length) } else { DVec3::ZERO };
    DQuat::from_xyzw(v.x, v.y, v.z, cos)
}
