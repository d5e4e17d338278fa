//! Velocities and Doppler factors of the bodies in a picture.

use glam::DVec3;
use ugphysics::Velocity;
use ugscene::View;

use crate::emission::SeenItem;

/// Of more velocities only the range is shown.
const MOST_DISTINCT: usize = 64;

/// Velocities and Doppler factors of the bodies in a picture.
pub struct MotionSummary {
    /// Velocities of the visible bodies, or of all if none is visible; slowest first.
    pub velocities: Vec<Velocity>,
    /// Their directions in the camera's axes: right, up, and towards the viewer. Zero at rest.
    pub directions: Vec<DVec3>,
    /// Least and greatest Doppler factor at the middles of pixels; `None` if nothing is visible.
    /// Eq. (P10)
    pub doppler: Option<[f64; 2]>,
    /// Least and greatest own time at emission of visible bodies on world lines, likewise.
    pub own_time: Option<[f64; 2]>,
    /// True if wavelengths in the picture are Doppler shifted.
    pub is_shifted: bool,
}

impl MotionSummary {
    /// Summarizes what is seen at the middles of pixels. `all`: the velocities of all bodies;
    /// `is_shifted`: wavelengths have been Doppler shifted.
    pub fn new(
        view: &View,
        items: impl Iterator<Item = Option<SeenItem>>,
        all: impl FnOnce() -> Vec<Velocity>,
        is_shifted: bool,
    ) -> Self {
        let mut velocities: Vec<Velocity> = Vec::new();
        // The slowest and the fastest of a body whose points all differ.
        let mut ends: Option<[Velocity; 2]> = None;
        let [mut doppler, mut own_time]: [Option<[f64; 2]>; 2] = [None; 2];
        let extend = |ends: &mut Option<[f64; 2]>, value: f64| {
            *ends = Some(ends.map_or([value; 2], |[low, high]| [low.min(value), high.max(value)]));
        };
        for (_, emission) in items.flatten() {
            let velocity = emission.velocity;
            if velocities.len() < MOST_DISTINCT && !velocities.contains(&velocity) {
                velocities.push(velocity);
            }
            let [slowest, fastest] = ends.unwrap_or([velocity; 2]);
            ends = Some([
                if velocity.rapidity() < slowest.rapidity() { velocity } else { slowest },
                if velocity.rapidity() > fastest.rapidity() { velocity } else { fastest },
            ]);
            extend(&mut doppler, emission.doppler());
            emission.own_time.into_iter().for_each(|time| extend(&mut own_time, time));
        }
        if velocities.len() == MOST_DISTINCT {
            velocities.extend(ends.into_iter().flatten());
        }
        if velocities.is_empty() {
            velocities = all();
        }
        velocities.sort_by(|a, b| a.rapidity().total_cmp(&b.rapidity()));
        let axes = axes(view);
        let direction = |v: &Velocity| {
            if v.is_zero() {
                DVec3::ZERO
            } else {
                DVec3::from_array(axes.map(|axis| axis.dot(v.direction())))
            }
        };
        let directions = velocities.iter().map(direction).collect();
        Self { velocities, directions, doppler, own_time, is_shifted }
    }

    /// True if everything visible is at rest.
    pub fn is_rest(&self) -> bool {
        self.velocities.iter().all(|v| v.is_zero())
    }
}

/// Unit vectors to the right, up, and towards the viewer.
fn axes(view: &View) -> [DVec3; 3] {
    let [middle, right, below] =
        [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]].map(|place| view.point(place, view.distance));
    [(right - middle).normalize_or_zero(), (middle - below).normalize_or_zero(), -view.forward]
}
