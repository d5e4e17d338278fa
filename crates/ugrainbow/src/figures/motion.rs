//! How the bodies that are seen move, and with what Doppler factors they are seen.

use glam::DVec3;
use ugphysics::{Velocity, doppler_at};
use ugscene::View;

use super::depths::Depths;
use crate::config::Config;
use crate::planes::Finder;
use crate::setup::Setup;

/// The motion in a picture.
pub struct Motion {
    /// Of the bodies that are seen, or if there are none of all; slow ones first. At rest, one of speed 0.
    pub velocities: Vec<Velocity>,
    /// Of each of them, the direction: to the right, up, and toward the viewer. Zero at rest.
    pub directions: Vec<DVec3>,
    /// The least and the greatest Doppler factor that is seen, in the middle of a pixel; none if nothing is.  Eq. (P10)
    pub doppler: Option<[f64; 2]>,
    /// True if colours in the picture are shifted.
    pub is_shifted: bool,
}

impl Motion {
    /// `setup`, `depths`: with one sample for each pixel.
    pub fn new(setup: &Setup<'_>, depths: &Depths, config: &Config) -> Self {
        let painter = setup.painter();
        let finder = Finder::new(&painter);
        let mut velocities: Vec<Velocity> = Vec::new();
        let mut doppler: Option<[f64; 2]> = None;
        for (idx, seen) in depths.seen.iter().enumerate() {
            let Some(seen) = *seen else { continue };
            let width = setup.grid.width as usize;
            let emission = finder.emission([(idx % width) as u32, (idx / width) as u32], seen);
            if !velocities.contains(&emission.velocity) {
                velocities.push(emission.velocity);
            }
            let factor = doppler_at(emission.place, emission.velocity);
            doppler = Some(doppler.map_or([factor; 2], |[low, high]| [low.min(factor), high.max(factor)]));
        }
        if velocities.is_empty() {
            velocities = setup.scene().faces.iter().map(|face| setup.surface.velocity(face.body)).collect();
            velocities.dedup();
        }
        velocities.sort_by(|a, b| a.rapidity().total_cmp(&b.rapidity()));
        let axes = axes(&setup.view);
        let direction = |v: &Velocity| {
            if v.is_zero() {
                DVec3::ZERO
            } else {
                DVec3::from_array(axes.map(|axis| axis.dot(v.direction())))
            }
        };
        let directions = velocities.iter().map(direction).collect();
        let is_shifted = match config.exact {
            Some(exact) => exact.doppler,
            None => setup.scene().stage.seen_colors().is_some_and(|seen| seen.doppler),
        };
        Self { velocities, directions, doppler, is_shifted }
    }

    /// True if nothing that is seen moves.
    pub fn is_rest(&self) -> bool {
        self.velocities.iter().all(|v| v.is_zero())
    }
}

/// Unit vectors to the right, up, and toward the viewer.
fn axes(view: &View) -> [DVec3; 3] {
    let [middle, right, below] =
        [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]].map(|place| view.point(place, view.distance));
    [(right - middle).normalize_or_zero(), (middle - below).normalize_or_zero(), -view.forward]
}
