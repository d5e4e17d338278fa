//! Points of bodies, at rest and as seen.

use glam::DVec3;
use ugphysics::{Event, WorldLine, doppler_at};
pub(crate) use ugscene::RelativeMotion;
use ugscene::{BodyId, RestPosition};

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
    /// The body it is part of.
    pub body: BodyId,
    /// Number of halvings that led to it: 0 for a vertex of the scene.
    pub generation: u32,
}

impl Point {
    /// The point at `rest`, relative to the eye.
    pub(crate) fn new(motion: &RelativeMotion, body: BodyId, rest: DVec3) -> Point {
        if let Some(line) = motion.world_line() {
            return Self::on_world_line(line, body, rest);
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
        Point { rest, seen, rest_distance, seen_distance, inverse_doppler, body, generation: 0 }
    }

    /// The point of a body on a world line; not a number where it cannot move so.
    pub(crate) fn on_world_line(line: &WorldLine, body: BodyId, rest: DVec3) -> Point {
        const EYE: Event = Event { t: 0.0, x: DVec3::ZERO };
        let (seen, inverse_doppler) = match line.emission(rest, EYE) {
            Ok(emission) => (emission.event.x, 1.0 / doppler_at(emission.event.x, emission.velocity)),
            Err(_) => (DVec3::NAN, f64::NAN),
        };
        let seen_distance = seen.length();
        let rest_distance = seen_distance * inverse_doppler;
        Point { rest, seen, rest_distance, seen_distance, inverse_doppler, body, generation: 0 }
    }

    /// True for a point at the eye, whose direction is undefined if it moves.
    pub(crate) fn is_at_eye(&self, motion: &RelativeMotion) -> bool {
        match motion.world_line() {
            Some(_) => self.seen == DVec3::ZERO,
            None => self.rest == DVec3::ZERO && !motion.is_at_rest(),
        }
    }
}
