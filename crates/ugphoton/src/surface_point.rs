//! The point of a face that a ray meets: place, normals, colour, Doppler factor.

use glam::DVec3;
use uglight::{ScatteringTime, SurfaceColor, SurfaceElement};
use ugphysics::{Event, RestFrame, WaveVector, WorldLine, unit_or_zero};
use ugscene::{SurfaceId, VertexId};

use crate::scenery::Scenery;
use ugpicture::rays::Intersection;
use ugpicture::rays::{PastRay, Start, along};
use ugpicture::textures::SurfaceElementPlane;

/// A point of a face that a ray sees, in the rest frame of the face and the axes of the scene; on a
/// world line, in the rest frame of the surface element and the axes of a single boost.
#[derive(Clone, Debug)]
pub struct SurfacePoint {
    /// Row of the part of the world.
    pub part: usize,
    /// Row of the face.
    pub face: u32,
    /// The event in the frame of the camera.
    pub event: Event,
    /// Place, relative to the eye; on a world line, in the coordinates of the body.
    pub place: DVec3,
    /// The surface element of a body on a world line. Boxed, since points are moved often.
    pub element: Option<Box<Element>>,
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
    /// The colour that it emits besides, if it emits any. Boxed as `element` is.
    pub emitted: Option<Box<SurfaceColor>>,
}

/// A surface element of a body on a world line.
#[derive(Clone, Copy, Debug)]
pub struct Element {
    /// The rest frame of the element, with the axes of a single boost.
    pub frame: RestFrame,
    /// The own time of the body.
    pub own_time: f64,
    /// [`SurfacePoint::normal`], of the shape that the body has in its own coordinates.
    pub body_normal: DVec3,
}

impl SurfacePoint {
    /// Where a ray meets a face. `neighbours`: of the ray, for the footprints of textures.
    pub fn new(
        scenery: &Scenery<'_>,
        ray: &PastRay,
        found: &Intersection,
        neighbours: Option<&Neighbours>,
    ) -> Self {
        let part = &scenery.world.parts[found.part];
        if let Some(motion) = &part.motion {
            return Self::on_line(scenery, (ray, neighbours), found, &motion.line);
        }
        let places = found.triangle.corners.map(|corner| scenery.appearance.surface.rest(corner));
        let wave = part.frame.wave_to_rest(ray.wave);
        let (origin, step) = ray.in_part(found.part, &part.frame);
        let round = part.round_surface(found, (origin, step));
        let (place, outside) = round.unwrap_or_else(|| {
            (mean(places, found.weights()), scenery.world.outside[found.triangle.face as usize])
        });
        let is_outside = outside.dot(step) <= 0.0;
        let plane_normal = if is_outside { outside } else { -outside };
        let (normal, lift) = match round {
            Some(_) => (plane_normal, DVec3::ZERO),
            None => smooth(scenery, (found.triangle.corners, found.weights()), (places, place), plane_normal),
        };
        let event = along(ray.origin, ray.step, found.s);
        let delay = match ray.start {
            Start::Eye => 0.0,
            _ => part.frame.rest_from_camera(event).t + ugphysics::length(place),
        };
        let is_moving = !part.frame.velocity().is_zero();
        let own_time = || delay - ugphysics::length(place);
        let plane = SurfaceElementPlane { frame: &part.frame, normal: plane_normal, event, places };
        let steps = |neighbours| plane.steps(neighbours, |step| step);
        let emitted = emitted(scenery, found, (is_moving, own_time), neighbours, steps);
        let color = if scenery.textures.is_empty() {
            color(scenery, found, is_moving, own_time)
        } else {
            textured(scenery, found, is_moving, neighbours, steps)
                .unwrap_or_else(|| color(scenery, found, is_moving, own_time))
        };
        Self {
            part: found.part,
            face: found.triangle.face,
            event,
            place,
            element: None,
            delay,
            lift,
            plane_normal,
            normal,
            is_outside,
            wave,
            color,
            emitted,
        }
    }

    /// Where a ray meets a face of a body on a world line.
    #[inline(never)] // Keeps `new` small, which is called for every ray.
    fn on_line(
        scenery: &Scenery<'_>,
        (ray, neighbours): (&PastRay, Option<&Neighbours>),
        found: &Intersection,
        line: &WorldLine,
    ) -> Self {
        let places = found.triangle.corners.map(|corner| scenery.appearance.surface.rest(corner));
        let place = mean(places, found.weights());
        let own_time = found.own_time;
        let element = line.element(place, own_time);
        let frame = RestFrame::new(element.velocity);
        let outside = scenery.world.outside[found.triangle.face as usize];
        let step = frame.rest_from_camera(ray.step).x;
        let outside_in_frame = element.normal(outside);
        let is_outside = outside_in_frame.dot(step) <= 0.0;
        let side = if is_outside { 1.0 } else { -1.0 };
        let (plane, plane_normal) = (side * outside, side * outside_in_frame);
        let (body_normal, body_lift) =
            smooth(scenery, (found.triangle.corners, found.weights()), (places, place), plane);
        let lift = if body_lift == DVec3::ZERO {
            DVec3::ZERO
        } else {
            ugphysics::length(body_lift) * element.normal(unit_or_zero(body_lift))
        };
        let event = along(ray.origin, ray.step, found.s);
        let triangle = SurfaceElementPlane { frame: &frame, normal: plane_normal, event, places };
        let steps = |neighbours| triangle.steps(neighbours, |step| to_body(&element, step));
        let textured = textured(scenery, found, true, neighbours, steps);
        Self {
            part: found.part,
            face: found.triangle.face,
            event,
            place,
            element: Some(Box::new(Element { frame, own_time, body_normal })),
            delay: 0.0,
            lift: if lift.is_finite() { lift } else { DVec3::ZERO },
            plane_normal,
            normal: if body_normal == plane { plane_normal } else { element.normal(body_normal) },
            is_outside,
            wave: frame.wave_to_rest(ray.wave),
            color: textured.unwrap_or_else(|| color(scenery, found, true, || own_time)),
            emitted: emitted(scenery, found, (true, || own_time), neighbours, steps),
        }
    }

    /// Where a neighbour of the ray meets the surface: the event, the place, and the normal there.
    pub fn beside(
        &self,
        scenery: &Scenery<'_>,
        found: &Intersection,
        ray: &PastRay,
    ) -> (Event, DVec3, DVec3) {
        let places = found.triangle.corners.map(|corner| scenery.appearance.surface.rest(corner));
        let (frame, normal) = (self.frame(scenery), self.plane_normal);
        let plane = SurfaceElementPlane { frame, normal, event: self.event, places };
        let (s, step) = plane.met(ray);
        let smooth = |step: DVec3, normal: DVec3| {
            let [_, second, third] = found.weights();
            let [across, down] = plane.weights(step);
            let (second, third) = (second + across, third + down);
            let weights = [1.0 - second - third, second, third];
            smooth(scenery, (found.triangle.corners, weights), (places, self.place + step), normal).0
        };
        let side = if self.is_outside { 1.0 } else { -1.0 };
        let (place, normal) = if let Some((line, own_time)) = self.world_line(scenery) {
            let element = line.element(self.place, own_time);
            let step = to_body(&element, step);
            let outside = scenery.world.outside[self.face as usize];
            (self.place + step, element.normal(smooth(step, side * outside)))
        } else {
            let place = self.place + step;
            let round = scenery.world.parts[self.part].round_surface(found, (place, DVec3::ZERO));
            (place, round.map_or_else(|| smooth(step, normal), |(_, outside)| side * outside))
        };
        (along(ray.origin, ray.step, s), place, normal)
    }

    /// The rest frame of the surface.
    pub fn frame<'s>(&'s self, scenery: &'s Scenery<'_>) -> &'s RestFrame {
        match &self.element {
            Some(element) => &element.frame,
            None => &scenery.world.parts[self.part].frame,
        }
    }

    /// The world line of the body, and its own time here; `None` for an inertial body.
    pub fn world_line<'s>(&self, scenery: &'s Scenery<'_>) -> Option<(&'s WorldLine, f64)> {
        let own_time = self.element.as_ref()?.own_time;
        Some((&scenery.world.parts[self.part].motion.as_ref()?.line, own_time))
    }

    /// The surface as lamps light it.
    pub fn lit(&self, scenery: &Scenery<'_>) -> SurfaceElement {
        let (time, normal) = match &self.element {
            Some(element) => (ScatteringTime::Own(element.own_time), element.body_normal),
            None => (ScatteringTime::Delay(self.delay), self.normal),
        };
        let body = scenery.scene.faces[self.face as usize].body;
        SurfaceElement { point: self.place, time, normal, body }
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
        match scenery.scene.shadings[scenery.scene.faces[self.face as usize].shading?.index()] {
            ugscene::Shading::Surface(surface) => Some(surface),
            ugscene::Shading::Level(_) => None,
        }
    }
}

/// The neighbours across and down of a ray, which show how large a sample is on a surface.
#[derive(Clone, Debug)]
pub enum Neighbours {
    /// Those of a ray from the eye.
    OfSample(PictureSample),
    /// Those of a ray that was mirrored or refracted.
    Bent(Box<[PastRay; 2]>),
}

impl Neighbours {
    /// Their rays. A lens may show nothing at one; then it is on the other side.
    pub fn rays(&self, scenery: &Scenery<'_>) -> Option<[PastRay; 2]> {
        match self {
            Self::OfSample(sample) => sample.neighbours(scenery),
            Self::Bent(rays) => Some(**rays),
        }
    }
}

/// A sample of the picture.
#[derive(Clone, Copy, Debug)]
pub struct PictureSample {
    /// Its column and row.
    pub place: [u32; 2],
    /// How far it is from its neighbours, in samples.
    pub distance: u32,
}

impl PictureSample {
    fn neighbours(self, scenery: &Scenery<'_>) -> Option<[PastRay; 2]> {
        let [column, row] = self.place.map(|at| f64::from(at) + 0.5);
        let steps = scenery.film.steps_in_frame(self.place, self.distance);
        let ray = |across: f64, down: f64| {
            let through = |sign: f64| scenery.ray_through([column + sign * across, row + sign * down]);
            through(1.0).or_else(|| through(-1.0))
        };
        Some([ray(steps[0], 0.0)?, ray(0.0, steps[1])?])
    }
}

/// The colour at rest where a ray meets a face with a texture. `steps`: of the weights of a sample.
#[inline]
fn textured(
    scenery: &Scenery<'_>,
    found: &Intersection,
    is_moving: bool,
    neighbours: Option<&Neighbours>,
    steps: impl FnOnce([PastRay; 2]) -> [[f64; 2]; 2],
) -> Option<SurfaceColor> {
    let color = scenery.scene.faces[found.triangle.face as usize].color;
    let neighbours = || neighbours.and_then(|neighbours| neighbours.rays(scenery));
    let steps = || neighbours().map_or([[0.0; 2]; 2], steps);
    let texel =
        scenery.textures.texel(&scenery.scene, color, (found.triangle.corners, found.weights()), steps)?;
    Some(scenery.appearance.texel(texel.light, texel.translucency, is_moving))
}

/// The colour at rest that a face emits where a ray meets it; see [`textured`] and [`color`].
#[inline]
fn emitted(
    scenery: &Scenery<'_>,
    found: &Intersection,
    (is_moving, own_time): (bool, impl Fn() -> f64),
    neighbours: Option<&Neighbours>,
    steps: impl FnOnce([PastRay; 2]) -> [[f64; 2]; 2],
) -> Option<Box<SurfaceColor>> {
    let Scenery { scene, appearance, textures, .. } = scenery;
    if scene.emissions.is_empty() {
        return None;
    }
    let color = scene.faces[found.triangle.face as usize].color;
    let steps = || neighbours.and_then(|near| near.rays(scenery)).map_or([[0.0; 2]; 2], steps);
    let at = Some((found.triangle.corners, found.weights()));
    let (color, texel) = textures.emitted(scene, color, at, steps)?;
    let now = appearance.color_at_time(scene, color, own_time(), is_moving);
    Some(Box::new(now.unwrap_or_else(|| appearance.emitted(color, texel.map(|it| it.light), is_moving))))
}

/// The colour at rest where a ray meets a face. `own_time`: of the body there.
#[inline]
fn color(
    scenery: &Scenery<'_>,
    found: &Intersection,
    is_moving: bool,
    own_time: impl Fn() -> f64,
) -> SurfaceColor {
    let (scene, appearance) = (&scenery.scene, &scenery.appearance);
    let face = &scene.faces[found.triangle.face as usize];
    if !scene.color_tables.is_empty()
        && let Some(color) = face.color
        && let Some(now) = appearance.color_at_time(scene, color, own_time(), is_moving)
    {
        return now;
    }
    let colors = &scenery.face_colors[found.triangle.face as usize];
    appearance.color_at(colors, found.triangle.corners, found.weights())
}

/// A step in the coordinates of the body: its axes in the frame of the element, as normals turn,
/// exact unless the body spins.
fn to_body(element: &ugphysics::ElementFrame, step: DVec3) -> DVec3 {
    DVec3::from_array(DVec3::AXES.map(|axis| element.normal(axis).dot(step)))
}

fn mean(values: [DVec3; 3], weights: [f64; 3]) -> DVec3 {
    weights[0] * values[0] + weights[1] * values[1] + weights[2] * values[2]
}

/// The interpolated normal, where corners have normals of their own, and the way from a place on
/// the face to the surface with these normals: the mean of the places projected to the tangent
/// planes of the corners, where these are above the face (Hanika 2021).
#[inline(always)] // Most faces are plane.
fn smooth(
    scenery: &Scenery<'_>,
    (vertices, weights): ([VertexId; 3], [f64; 3]),
    (corners, place): ([DVec3; 3], DVec3),
    plane: DVec3,
) -> (DVec3, DVec3) {
    let own = vertices.map(|corner| scenery.scene.vertices[corner.index()].normal);
    if own == [None; 3] {
        return (plane, DVec3::ZERO);
    }
    let normals = own.map(|own| ugscene::shading_normal(own, plane));
    let lifts = [0, 1, 2].map(|at| (corners[at] - place).dot(normals[at]).max(0.0) * normals[at]);
    (mean(normals, weights).normalize_or_zero(), mean(lifts, weights))
}
