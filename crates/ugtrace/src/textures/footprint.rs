//! The footprint of a sample on the plane of a triangle.

use glam::DVec3;
use ugphysics::{Event, RestFrame};

use crate::rays::PastRay;

/// A triangle where a ray meets it.
pub struct SurfaceElementPlane<'a> {
    /// The rest frame of the surface element.
    pub frame: &'a RestFrame,
    /// Normal of its plane in that frame.
    pub normal: DVec3,
    /// Where the ray meets it, in the frame of the camera.
    pub event: Event,
    /// The corners of the triangle, in the coordinates of the body.
    pub places: [DVec3; 3],
}

impl SurfaceElementPlane<'_> {
    /// The changes of the weights of the second and third corner from the ray to its neighbours
    /// across and down. `to_body`: from the axes of the frame to those of the body.  Eq. (P50)
    ///
    /// The element rests in its frame, so it does not matter when each ray meets its plane.
    pub fn steps(
        &self,
        neighbours: [PastRay; 2],
        to_body: impl Fn(DVec3) -> DVec3,
    ) -> [[f64; 2]; 2] {
        neighbours.map(|ray| self.weights(to_body(self.met(&ray).1)))
    }

    /// The parameter of a ray where it meets the plane, and the way there from the element, in its
    /// frame.
    pub fn met(&self, ray: &PastRay) -> (f64, DVec3) {
        let before = Event { t: ray.origin.t - self.event.t, x: ray.origin.x - self.event.x };
        let (from, way) =
            (self.frame.rest_from_camera(before).x, self.frame.rest_from_camera(ray.step).x);
        let s = -self.normal.dot(from) / self.normal.dot(way);
        (s, from + s * way)
    }

    /// The changes of the weights of the second and third corner along a step in the coordinates of
    /// the body.
    pub fn weights(&self, step: DVec3) -> [f64; 2] {
        let [a, b, c] = self.places;
        let (along, beside) = (b - a, c - a);
        let across = along.cross(beside);
        let scale = 1.0 / across.length_squared();
        [step.cross(beside).dot(across) * scale, along.cross(step).dot(across) * scale]
    }
}
