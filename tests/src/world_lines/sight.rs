//! What is seen of integrated bodies.

use glam::DVec3;

use super::integrated::{Body, Moment};
use super::{Four, boosted, four_velocity, plus, product};

/// Steps along the stretch of a ray in which a body can be.
const N_STEPS: usize = 80;

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

/// What a ray meets first.
#[derive(Clone, Copy, Debug)]
pub struct Hit {
    /// The row of the triangle.
    pub triangle: usize,
    /// The distance in the frame of the eye.
    pub distance: f64,
    /// The point in the coordinates of the body.
    pub point: DVec3,
    /// As it is seen.
    pub sighting: Sighting,
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

/// Triangles of bodies before an eye.
#[derive(Clone, Debug)]
pub struct View<'a> {
    observer: Observer,
    bodies: &'a [Body],
    triangles: &'a [Triangle],
    reaches: Vec<Reach>,
}

/// Where the triangles of a body are seen.
#[derive(Clone, Debug)]
struct Reach {
    triangles: Vec<usize>,
    distances: [f64; 2],
    axis: DVec3,
    angle: f64,
    /// Of the nearest corner.
    own_time: f64,
}

impl<'a> View<'a> {
    /// Triangles of bodies with the rows of `bodies`.
    pub fn new(observer: Observer, bodies: &'a [Body], triangles: &'a [Triangle]) -> Self {
        let reach = |(row, body): (usize, &Body)| {
            let own: Vec<usize> = (0..triangles.len()).filter(|&k| triangles[k].body == row).collect();
            let corners = own.iter().flat_map(|&k| triangles[k].corners);
            let seen: Vec<Sighting> = corners.map(|corner| observer.sight(body, corner)).collect();
            let axis = seen.iter().map(|sighting| sighting.seen.normalize()).sum::<DVec3>();
            let distances = || seen.iter().map(|sighting| sighting.seen.length());
            let (low, high) = distances().fold((f64::INFINITY, 0.0_f64), |(l, h), d| (l.min(d), h.max(d)));
            let margin = 0.5 * (high - low) + 0.3;
            let latest = seen.iter().map(|sighting| sighting.own_time).fold(f64::NEG_INFINITY, f64::max);
            let angle = seen.iter().map(|sighting| sighting.seen.angle_between(axis)).fold(0.0, f64::max);
            let distances = [(low - margin).max(1e-6), high + margin];
            Reach { triangles: own, distances, axis, angle: 1.5 * angle + 0.05, own_time: latest }
        };
        let reaches = bodies.iter().enumerate().map(reach).collect();
        Self { observer, bodies, triangles, reaches }
    }

    /// The first of the triangles in a direction, a unit vector in the axes of the eye.
    pub fn look(&self, direction: DVec3) -> Option<Hit> {
        let hits =
            self.bodies.iter().zip(&self.reaches).flat_map(|(body, reach)| self.hits(body, reach, direction));
        hits.min_by(|a, b| a.distance.total_cmp(&b.distance))
    }

    fn hits(&self, body: &Body, reach: &Reach, direction: DVec3) -> Vec<Hit> {
        let mut hits = Vec::new();
        if reach.triangles.is_empty() || direction.angle_between(reach.axis) > reach.angle {
            return hits;
        }
        let [low, high] = reach.distances;
        let step = (high - low) / N_STEPS as f64;
        let (mut guess, mut before) = (reach.own_time, None);
        for k in 0..=N_STEPS {
            let distance = low + step * k as f64;
            let now = body.at_event(self.observer.past(distance * direction), guess);
            if let (Some((own_time, old)), Some((_, new))) = (before, now) {
                for &k in &reach.triangles {
                    let range = [distance - step, distance];
                    hits.extend(self.hit(body, k, direction, range, [old, new], own_time));
                }
            }
            guess = now.map_or(guess, |(own_time, _)| own_time);
            before = now;
        }
        hits
    }

    /// `points`: of the body, at the ends of a step along the ray.
    fn hit(
        &self,
        body: &Body,
        row: usize,
        direction: DVec3,
        [mut near, mut far]: [f64; 2],
        [old, new]: [DVec3; 2],
        guess: f64,
    ) -> Option<Hit> {
        let [a, b, c] = self.triangles[row].corners;
        let normal = (b - a).cross(c - a);
        let side = |p: DVec3| normal.dot(p - a) > 0.0;
        if side(old) == side(new) {
            return None;
        }
        let (mut own_time, mut point) = (guess, old);
        for _ in 0..48 {
            let middle = near.midpoint(far);
            (own_time, point) = body.at_event(self.observer.past(middle * direction), own_time)?;
            if side(point) == side(old) { near = middle } else { far = middle }
        }
        let is_inside = [(a, b), (b, c), (c, a)]
            .iter()
            .all(|&(from, to)| (to - from).cross(point - from).dot(normal) > 0.0);
        let sighting = self.observer.sighting(body, point, own_time);
        is_inside.then_some(Hit { triangle: row, distance: near, point, sighting })
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
