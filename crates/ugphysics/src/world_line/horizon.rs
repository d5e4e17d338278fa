//! Which points of a body can move as it does at all times.

use std::collections::VecDeque;

use glam::DVec3;

use super::WorldLineError;
use super::curve::Curve;
use super::moving::{Moving, Path, Turn};

/// Samples of a stretch of time in which acceleration and spin, or several spins, act together.
const N_SAMPLES: u32 = 512;

/// Turns of the slowest spin that are sampled in a stretch without an end.
const MOST_TURNS: f64 = 4.0;

impl Moving {
    /// See [`super::WorldLine::check`].
    pub(super) fn check(&self, point: DVec3) -> Result<(), WorldLineError> {
        // Most points of a motion of many pieces are far from any horizon.
        if self.is_safe(point, self.path.greatest_acceleration(), |turn| turn.spin.greatest()) {
            return Ok(());
        }
        let mut changes = self.changes();
        changes.sort_by(f64::total_cmp);
        let begins = std::iter::once(f64::NEG_INFINITY).chain(changes.iter().copied());
        let ends = changes.iter().copied().chain(std::iter::once(f64::INFINITY));
        begins.zip(ends).filter(|(begin, end)| begin < end).try_for_each(|stretch| {
            // A time inside, for the values that are constant in it.
            let inside = match stretch {
                (f64::NEG_INFINITY, f64::INFINITY) => 0.0,
                (f64::NEG_INFINITY, end) => end - 1.0,
                (begin, f64::INFINITY) => begin + 1.0,
                (begin, end) => begin.midpoint(end),
            };
            let [acceleration, _] = self.path.bounds([stretch.0, stretch.1], inside);
            let is_safe = self.is_safe(point, acceleration, |turn| turn.spin.rate(inside).length());
            if is_safe { Ok(()) } else { self.check_stretch(point, stretch, inside) }
        })
    }

    /// See [`super::WorldLine::check_turn`].
    pub(super) fn check_turn(&self, own_time: f64) -> Result<(), WorldLineError> {
        let spins = self.turns.iter().map(|turn| turn.spin.rate(own_time).length());
        let turned = (self.path.turn_rate() + spins.sum::<f64>()) * own_time.abs();
        if turned <= super::WorldLine::MOST_TURN {
            return Ok(());
        }
        let is_finite = own_time.is_finite();
        Err(if is_finite {
            WorldLineError::ManyTurns { own_time }
        } else {
            WorldLineError::NotFinite
        })
    }

    /// Own times at which acceleration or a spin changes.
    fn changes(&self) -> Vec<f64> {
        let of_path: Vec<f64> = match &self.path {
            Path::Accelerated(acceleration) => acceleration.changes().collect(),
            Path::Curved(framed) => framed.curve.changes().collect(),
        };
        of_path.into_iter().chain(self.turns.iter().flat_map(|turn| turn.spin.changes())).collect()
    }

    /// True only if |a||ξ| + |dξ/dτ| stays below 1 whatever the directions, while acceleration and
    /// spins are no greater than these.
    fn is_safe(&self, point: DVec3, acceleration: f64, spin: impl Fn(&Turn) -> f64) -> bool {
        let (mut reach, mut from, mut swing) = (0.0, point, 0.0);
        for turn in &self.turns {
            reach += (from - turn.pivot).length();
            swing += spin(turn) * reach;
            from = turn.pivot;
        }
        reach += (from - self.at).length();
        acceleration * reach + swing < 1.0
    }

    fn check_stretch(
        &self,
        point: DVec3,
        (begin, end): (f64, f64),
        inside: f64,
    ) -> Result<(), WorldLineError> {
        let is_at = |own_time: f64| self.point_event(point, own_time).map(drop);
        if let Path::Curved(framed) = &self.path
            && framed.curve.changes().next().is_some_and(|first| begin >= first)
            && framed.curve.changes().last().is_some_and(|last| end <= last)
        {
            return self.check_halves(point, (begin, end), &framed.curve);
        }
        let spins = self.turns.iter().map(|turn| turn.spin.rate(inside).length());
        let rates = spins.chain([self.path.turn_rate()]).filter(|&rate| rate > 0.0);
        let (n_turns, slowest) =
            rates.fold((0, f64::INFINITY), |(n, least), rate| (n + 1, rate.min(least)));
        if n_turns == 0 || n_turns == 1 && self.acceleration(inside) == DVec3::ZERO {
            return is_at(inside);
        }
        let span = MOST_TURNS * std::f64::consts::TAU / slowest;
        let begin = if begin.is_finite() { begin } else { end.min(0.0) - span };
        let end = if end.is_finite() { end } else { begin.max(0.0) + span };
        let step = (end - begin) / f64::from(N_SAMPLES);
        (0..N_SAMPLES).try_for_each(|k| is_at(begin + (f64::from(k) + 0.5) * step))
    }

    /// Halves a stretch between two changes of a curve where no bound shows that it is safe.
    fn check_halves(
        &self,
        point: DVec3,
        (begin, end): (f64, f64),
        curve: &Curve,
    ) -> Result<(), WorldLineError> {
        let mut parts = VecDeque::from([(begin, end)]);
        let mut n_samples = 0;
        while let Some((begin, end)) = parts.pop_front() {
            let middle = begin.midpoint(end);
            let [acceleration, _] = curve.bounds([begin, end]);
            if n_samples == N_SAMPLES
                || self.is_safe(point, acceleration, |turn| turn.spin.rate(middle).length())
            {
                continue;
            }
            self.point_event(point, middle)?;
            n_samples += 1;
            parts.extend([(begin, middle), (middle, end)]);
        }
        Ok(())
    }
}
