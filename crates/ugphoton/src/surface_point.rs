//! What a ray sees of a face at a point: place, normals, colour, Doppler factor.

use glam::DVec3;
use uglight::Swatch;
use ugphysics::{Event, WaveVector};
use ugscene::{Face, SurfaceId, VertexId};

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
    pub color: Swatch,
    /// The corners whose colours are mixed, as rows of the colours with their weights.
    pub rows: [(u32, f64); 3],
    /// Translucency of the face here.
    pub translucency: f64,
}

impl SurfacePoint {
    /// Where a ray meets a face.
    pub fn new(scenery: &Scenery<'_>, ray: &Ray, found: &Intersection) -> Self {
        let part = &scenery.world.parts[found.part];
        let face = &scenery.scene.faces[found.triangle.face as usize];
        let places = found.triangle.corners.map(|corner| scenery.surface.rest(corner));
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
            _ => part.frame.to_rest(event).t + ugphysics::length(place),
        };
        let (color, rows) = color(scenery, face, found, !part.frame.velocity.is_zero());
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
            translucency: color.translucency,
            color,
            rows,
        }
    }

    /// D, from here to the eye: the product over all changes of frame along the path.
    pub fn doppler(&self) -> f64 {
        1.0 / self.wave.frequency
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

/// The colour at rest, interpolated between the corners as by every renderer.
fn color(
    scenery: &Scenery<'_>,
    face: &Face,
    found: &Intersection,
    is_moving: bool,
) -> (Swatch, [(u32, f64); 3]) {
    let corners = found.triangle.corners;
    let rows = corners.map(|corner| scenery.surface.row(corner));
    let weighted = std::array::from_fn(|at| (rows[at], found.weights[at]));
    let common = scenery.palette.common(&scenery.scene, &scenery.surface, face);
    // Colours given as light have no hue to shift. Except in spectral mode they are replaced by the
    // nearest hue.
    let common = if is_moving && !scenery.keeps_light() { common.without_light() } else { common };
    let swatch = |corner: VertexId| {
        let swatch = scenery.palette.swatch_of(*scenery.surface.swatch(corner), &common);
        Swatch { light: swatch.light.filter(|_| common.is_light), ..swatch }
    };
    let constant = [(rows[0], 1.0), (rows[0], 0.0), (rows[0], 0.0)];
    if rows == [rows[0]; 3] {
        return (swatch(corners[0]), constant);
    }
    let [a, b, c] = corners.map(swatch);
    if a == b && b == c {
        return (a, constant);
    }
    let [_, second, third] = found.weights;
    let number = |of: fn(&Swatch) -> f64| of(&a) + second * (of(&b) - of(&a)) + third * (of(&c) - of(&a));
    let light = match [a.light, b.light, c.light] {
        [Some(a), Some(b), Some(c)] => Some(mean([a, b, c], found.weights)),
        _ => None,
    };
    let mixed = Swatch {
        tint: number(|swatch| swatch.tint),
        saturation: number(|swatch| swatch.saturation),
        value: number(|swatch| swatch.value),
        factor: number(|swatch| swatch.factor),
        light,
        translucency: number(|swatch| swatch.translucency),
    };
    (mixed, weighted)
}
