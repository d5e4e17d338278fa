//! The sphere around a part, whose outline is a circle for every observer.
//!
//! Tests against it are fast, and skip parts that a ray misses. They do not change hits.

use glam::DVec3;
use ugphysics::{Event, RestFrame};

/// The sphere is larger than the box of the part by this part of its radius and of its distance
/// from the eye: more than rounding errors of hits.
const MARGIN: [f64; 2] = [1e-6, 1e-9];

/// Rounding errors relative to γ² are far below it: 2⁻⁴⁰.
const SLACK: f64 = 1.0 / (1_u64 << 40) as f64;

/// The part of the squared distance from the centre by which rounding may change the test.
const ROUNDING: f64 = 1e-9;

/// A sphere at rest.
#[derive(Clone, Copy, Debug)]
pub struct Outline {
    center: DVec3,
    /// The square of its radius.
    square: f64,
    /// In the frame of the camera, see [`Outline::is_seen`]; `None` if the eye is in the sphere.
    cone: Option<Event>,
    slack: f64,
}

impl Outline {
    /// The outline of a part with these least and greatest coordinates in its rest frame.
    pub fn new((low, high): (DVec3, DVec3), frame: &RestFrame) -> Self {
        let center = low / 2.0 + high / 2.0;
        let [of_radius, of_distance] = MARGIN;
        let distance = ugphysics::length(center);
        let radius = ugphysics::length(high - center) * (1.0 + of_radius) + distance * of_distance;
        let sin = radius / distance;
        // NaN fails the comparison.
        let cone = (sin < 1.0).then(|| {
            let cos = libm::sqrt(1.0 - sin * sin);
            frame.camera_from_rest(Event { t: -cos, x: center / distance })
        });
        Self {
            center,
            square: radius * radius,
            cone,
            slack: SLACK * frame.velocity().gamma() * frame.velocity().gamma(),
        }
    }

    /// False if light that arrives at the eye in a direction of the frame of the camera cannot come
    /// from the part.
    ///
    /// In the rest frame the sphere is seen within an angle α around the unit vector c. A step
    /// (−|d|, d) of a ray is in this cone if d · c ≥ |d| cos α: if its product with (−cos α, c) is
    /// not negative, which is the same in every frame.
    #[inline]
    pub fn is_seen(&self, direction: DVec3) -> bool {
        let Some(cone) = self.cone else { return true };
        let length = direction.length();
        let is_missed = direction.dot(cone.x) + length * cone.t < -self.slack * length;
        !is_missed
    }

    /// False if a ray of the rest frame misses the part.
    #[inline]
    pub fn may_be_hit(&self, origin: DVec3, step: DVec3) -> bool {
        let to_center = self.center - origin;
        let (distance, along, length) =
            (to_center.length_squared(), to_center.dot(step), step.length_squared());
        let outside = distance - self.square;
        let is_behind = along < 0.0 && outside > ROUNDING * distance;
        let is_beside = along * along < length * (outside - ROUNDING * distance);
        !(is_behind || is_beside)
    }
}
