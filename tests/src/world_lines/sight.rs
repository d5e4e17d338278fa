//! What is seen of integrated bodies.

use glam::DVec3;

use super::integrated::{Body, Moment};
use super::{Four, boosted, four_velocity, plus, product};

/// An eye at an event.
#[derive(Clone, Copy, Debug)]
pub struct Observer {
    /// Where and when it is.
    pub event: Four,
    velocity: Four,
    /// Those of a single boost.
    axes: [Four; 3],
}

/// A point as it is seen.
#[derive(Clone, Copy, Debug)]
pub struct Sighting {
    /// Own time of the body when the light left.
    pub own_time: f64,
    /// Position relative to the eye, in its axes.
    pub seen: DVec3,
    /// D
    pub doppler: f64,
    /// The point at emission.
    pub moment: Moment,
}

/// A triangle of a body, in its coordinates.
#[derive(Clone, Copy, Debug)]
pub struct Triangle {
    /// The row of the body.
    pub body: usize,
    /// Its corners.
    pub corners: [DVec3; 3],
}

impl Observer {
    /// With a velocity in the frame of the scene.
    pub fn new(event: Four, velocity: DVec3) -> Self {
        let axes = [[0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];
        let axes = axes.map(|axis| boosted(velocity, axis));
        Self { event, velocity: four_velocity(velocity), axes }
    }

    /// A point of a body at an own time.
    pub fn on(body: &Body, point: DVec3, own_time: f64) -> Self {
        let Moment { event, velocity: [gamma, x, y, z] } = body.moment(point, own_time);
        Self::new(event, DVec3::new(x, y, z) / gamma)
    }

    /// Components of a vector of the scene in the axes of the eye.
    pub fn components(&self, v: Four) -> DVec3 {
        let [x, y, z] = self.axes.map(|axis| product(axis, v));
        DVec3::new(x, y, z)
    }

    /// The event in the past, at a position relative to the eye.
    pub fn past(&self, seen: DVec3) -> Four {
        let event = plus(self.event, -seen.length(), self.velocity);
        self.axes.iter().zip(seen.to_array()).fold(event, |event, (axis, x)| plus(event, x, *axis))
    }

    /// A point of a body, by bisection of the emission time.
    pub fn sight(&self, body: &Body, point: DVec3) -> Sighting {
        let own_time = emission_time(body, point, self.event);
        self.sighting(body, point, own_time)
    }

    fn sighting(&self, body: &Body, point: DVec3, own_time: f64) -> Sighting {
        let moment = body.moment(point, own_time);
        let light = plus(self.event, -1.0, moment.event);
        let doppler = product(light, self.velocity) / product(light, moment.velocity);
        Sighting { own_time, seen: -self.components(light), doppler, moment }
    }
}

/// The own time at which light leaves a point of a body that arrives at an event.
pub fn emission_time(body: &Body, point: DVec3, observer: Four) -> f64 {
    let [mut early, mut late] = body.range();
    let is_early = |own_time: f64| {
        let way = plus(observer, -1.0, body.moment(point, own_time).event);
        way[0] > (way[1] * way[1] + way[2] * way[2] + way[3] * way[3]).sqrt()
    };
    assert!(is_early(early) && !is_early(late), "the light left within the integrated time");
    for _ in 0..60 {
        let middle = early.midpoint(late);
        if is_early(middle) { early = middle } else { late = middle }
    }
    early.midpoint(late)
}
