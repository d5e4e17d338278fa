//! Points of bodies, at rest and as seen.

use glam::DVec3;
use ugphysics::{EmissionEvent, Event, SeenLight, WorldLine, doppler_at};
pub(crate) use ugscene::RelativeMotion;
use ugscene::{BodyId, RestPosition, ShownPoint};

/// A point of a body. Both positions are relative to the eye.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Point {
    /// Rest coordinates, in the axes of [`RelativeMotion::turned`].
    pub rest: DVec3,
    /// Seen position.
    pub seen: DVec3,
    /// |p'| of the rest coordinates that (P3) applies to.
    pub rest_distance: f64,
    /// |p|.
    pub seen_distance: f64,
    /// 1/D, (P10).
    pub inverse_doppler: f64,
    /// The own time of the body at emission, on which tables of colours are based: on a world line
    /// that of its reference point, else the time of its rest frame after the event of the eye.
    pub own_time: f64,
    /// The body it is part of.
    pub body: BodyId,
    /// Number of halvings that led to it: 0 for a vertex of the scene.
    pub generation: u32,
}

impl Point {
    /// The point at `rest`, relative to the eye.
    pub(crate) fn new(motion: &RelativeMotion, body: BodyId, rest: DVec3) -> Point {
        if let Some(line) = motion.world_line() {
            return Self::on_world_line((motion, line), body, rest, None);
        }
        let seen = match motion.is_at_rest() {
            true => rest,
            false => motion.seen(RestPosition(rest)).0,
        };
        let (rest_distance, seen_distance) = (motion.boosted_rest(rest).length(), seen.length());
        let inverse_doppler = if motion.is_at_rest() {
            1.0
        } else if motion.has_flight_time() {
            // D = |p|/|p'|.
            rest_distance / seen_distance
        } else {
            1.0 / doppler_at(seen, motion.velocity())
        };
        let own_time =
            if motion.has_flight_time() { -rest_distance } else { motion.own_time_now(seen) };
        let generation = 0;
        Point {
            rest,
            seen,
            rest_distance,
            seen_distance,
            inverse_doppler,
            own_time,
            body,
            generation,
        }
    }

    /// The point of a body on a world line; NaN where it cannot move so. `guess`: about the own
    /// time at emission.
    fn on_world_line(
        (motion, line): (&RelativeMotion, &WorldLine),
        body: BodyId,
        rest: DVec3,
        guess: Option<f64>,
    ) -> Point {
        let light = match guess {
            _ if !motion.has_flight_time() => line.at_time(rest, 0.0).map(shown_now),
            Some(guess) => line.light_near(rest, Event::ORIGIN, guess),
            None => line.light(rest, Event::ORIGIN),
        };
        let (seen, inverse_doppler, own_time) = match light {
            Ok(SeenLight { event, inverse_doppler, own_time }) => {
                (event.x, inverse_doppler, own_time)
            }
            Err(_) => (DVec3::NAN, f64::NAN, f64::NAN),
        };
        let seen_distance = seen.length();
        let rest_distance = seen_distance * inverse_doppler;
        Point {
            rest,
            seen,
            rest_distance,
            seen_distance,
            inverse_doppler,
            own_time,
            body,
            generation: 0,
        }
    }

    /// The point for the scene as seen.
    pub(crate) fn shown(&self) -> ShownPoint {
        let &Point { body, rest, seen, own_time, .. } = self;
        ShownPoint { body, rest, seen, own_time }
    }

    /// The point of an edge at the parameter `s`.
    pub(crate) fn between(motion: &RelativeMotion, a: &Point, b: &Point, s: f64) -> Point {
        let guess = (1.0 - s) * a.own_time + s * b.own_time;
        Self::near(motion, a.body, a.rest.lerp(b.rest, s), guess)
    }

    /// The point in the middle of a triangle.
    pub(crate) fn middle(motion: &RelativeMotion, [a, b, c]: [&Point; 3]) -> Point {
        let guess = (a.own_time + b.own_time + c.own_time) / 3.0;
        Self::near(motion, a.body, (a.rest + b.rest + c.rest) / 3.0, guess)
    }

    /// The point at `rest`, whose light left near the own time `guess`.
    fn near(motion: &RelativeMotion, body: BodyId, rest: DVec3, guess: f64) -> Point {
        match motion.world_line() {
            Some(line) => Self::on_world_line((motion, line), body, rest, Some(guess)),
            None => Self::new(motion, body, rest),
        }
    }

    /// True for a point at the eye, whose direction is undefined if it moves.
    pub(crate) fn is_at_eye(&self, motion: &RelativeMotion) -> bool {
        match motion.world_line() {
            Some(_) => self.seen == DVec3::ZERO,
            None => self.rest == DVec3::ZERO && !motion.is_at_rest(),
        }
    }
}

/// A point where it is at the time of the picture, as if its light were there at once.
fn shown_now(EmissionEvent { own_time, event, velocity }: EmissionEvent) -> SeenLight {
    SeenLight { own_time, event, inverse_doppler: 1.0 / doppler_at(event.x, velocity) }
}
