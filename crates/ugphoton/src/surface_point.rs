//! The point of a face that a ray meets: place, normals, colour, Doppler factor.

use glam::DVec3;
use uglight::SurfaceColor;
use ugphysics::{Event, WaveVector};
use ugscene::SurfaceId;

use crate::path::{Ray, Start};
use crate::scenery::Scenery;
use crate::world::{Intersection, along};

/// A point of a face that a ray sees, in the rest frame of the face and the axes of the scene.
#[derive(Clone, Copy, Debug)]
pub struct SurfacePoint {
    /// Row of the part of the world.
    pub part: usize,
    /// Row of the face.
    pub face: u32,
    /// The event in the frame of the camera.
    pub event: Event,
    /// Place, relative to the eye.
    pub place: DVec3,
    /// How much later the light leaves than where the eye sees the place directly; see
    /// [`SurfaceElement::delay`](uglight::SurfaceElement::delay).
    pub delay: f64,
    /// From the place to the smooth surface that the normals of the corners describe, above it.
    pub lift: DVec3,
    /// Unit normal of the plane of the face, on the side from which the ray comes.
    pub plane_normal: DVec3,
    /// Interpolated unit normal, on the same side.
    pub normal: DVec3,
    /// True if the ray comes from outside, where the outline of the face runs counterclockwise.
    pub is_outside: bool,
    /// The light that leaves towards the eye along the ray.
    pub wave: WaveVector,
    /// Colour at rest.
    pub color: SurfaceColor,
}

impl SurfacePoint {
    /// Where a ray meets a face.
    pub fn new(scenery: &Scenery<'_>, ray: &Ray, found: &Intersection) -> Self {
        let part = &scenery.world.parts[found.part];
        let face = &scenery.scene.faces[found.triangle.face as usize];
        let places = found.triangle.corners.map(|corner| scenery.appearance.surface.rest(corner));
        let place = mean(places, found.weights);
        let wave = part.frame.wave_to_rest(ray.wave);
        let outside = scenery.faces().outside(found.triangle.face);
        let step = ray.in_part(found.part, &part.frame).1;
        let is_outside = outside.dot(step) <= 0.0;
        let plane_normal = if is_outside { outside } else { -outside };
        let (normal, lift) = smooth(scenery, found, (places, place), plane_normal);
        let event = along(ray.origin, ray.step, found.s);
        let delay = match ray.start {
            Start::Eye => 0.0,
            _ => part.frame.rest_from_camera(event).t + ugphysics::length(place),
        };
        let is_moving = !part.frame.velocity().is_zero();
        let common = scenery.appearance.common_in_motion(&scenery.scene, face, is_moving);
        let color = scenery.appearance.color_at(&common, found.triangle.corners, found.weights);
        Self {
            part: found.part,
            face: found.triangle.face,
            event,
            place,
            delay,
            lift,
            plane_normal,
            normal,
            is_outside,
            wave,
            color,
        }
    }

    /// D, from here to the eye: the product over all changes of frame along the path. Light of a
    /// body that is faster than light in the medium around it has the frequency −|f| in the frame
    /// of the body: what was sent last arrives first, shifted by 1/|f|.  Eq. (P37)
    pub fn doppler(&self) -> f64 {
        1.0 / self.wave.frequency.abs()
    }

    /// The direction towards the eye along the ray, a unit vector.
    pub fn toward_eye(&self) -> DVec3 {
        self.wave.k.normalize_or_zero()
    }

    /// The surface of the face, if it has one.
    pub fn surface(&self, scenery: &Scenery<'_>) -> Option<SurfaceId> {
        match scenery.scene.illums[scenery.scene.faces[self.face as usize].illum?.index()] {
            ugscene::Illum::Surface(surface) => Some(surface),
            ugscene::Illum::Level(_) => None,
        }
    }
}

fn mean(values: [DVec3; 3], weights: [f64; 3]) -> DVec3 {
    weights[0] * values[0] + weights[1] * values[1] + weights[2] * values[2]
}

/// The interpolated normal, where corners have normals of their own, and the way from a place on
/// the face to the surface with these normals: the mean of the places projected to the tangent
/// planes of the corners, where these are above the face (Hanika 2021).
fn smooth(
    scenery: &Scenery<'_>,
    found: &Intersection,
    (corners, place): ([DVec3; 3], DVec3),
    plane: DVec3,
) -> (DVec3, DVec3) {
    let own = found.triangle.corners.map(|corner| scenery.scene.vertices[corner.index()].normal);
    if own == [None; 3] {
        return (plane, DVec3::ZERO);
    }
    let normals = own.map(|own| ugscene::shading_normal(own, plane));
    let lifts = [0, 1, 2].map(|at| (corners[at] - place).dot(normals[at]).max(0.0) * normals[at]);
    (mean(normals, found.weights).normalize_or_zero(), mean(lifts, found.weights))
}
