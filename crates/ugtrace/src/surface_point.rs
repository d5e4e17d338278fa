//! The point of a face that a ray meets: place, normals, colour, Doppler factor.

use glam::DVec3;
use uglight::{Appearance, FaceColors, ScatteringTime, SurfaceColor, SurfaceElement};
use ugphysics::{ElementFrame, Event, RestFrame, WaveVector, WorldLine, unit_or_zero};
use ugscene::{ColorId, Scene, SurfaceId, VertexId};

use crate::rays::{Intersection, PastRay, Start, World, along};
use crate::textures::{SurfaceElementPlane, Textures};

/// The faces of a scene with all that decides how they look at rest.
#[derive(Clone, Copy)]
pub struct Surfaces<'a> {
    /// The scene, each of whose vertices is part of one body.
    pub scene: &'a Scene,
    /// Its faces, by rest frame.
    pub world: &'a World,
    /// Its colours.
    pub appearance: &'a Appearance,
    /// How the colours of the corners of each face are interpolated.
    pub face_colors: &'a [FaceColors],
    /// The pictures that colours of faces are.
    pub textures: &'a Textures,
}

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
    pub element: Option<Box<WorldLineElement>>,
    /// How much later the light leaves than where the eye sees the place directly; see
    /// [`uglight::ScatteringTime::Delay`].
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
pub struct WorldLineElement {
    /// The rest frame of the element, with the axes of a single boost.
    pub frame: RestFrame,
    /// The own time of the body.
    pub own_time: f64,
    /// [`SurfacePoint::normal`], of the shape that the body has in its own coordinates.
    pub body_normal: DVec3,
}

impl SurfacePoint {
    /// Where a ray meets a face. `neighbours`: the rays of the next samples in the row and in the
    /// column, for the footprints of textures.
    pub fn new(
        surfaces: &Surfaces<'_>,
        ray: &PastRay,
        found: &Intersection,
        neighbours: impl Fn() -> Option<[PastRay; 2]>,
    ) -> Self {
        let part = &surfaces.world.parts[found.part];
        if let Some(motion) = &part.motion {
            return Self::on_line(surfaces, ray, found, &motion.line, neighbours);
        }
        let places = surfaces.places(found);
        let wave = part.frame.wave_to_rest(ray.wave);
        let (origin, step) = ray.in_part(found.part, &part.frame);
        let round = part.round_surface(found, (origin, step));
        let (place, outside) =
            round.unwrap_or_else(|| (mean(places, found.weights()), surfaces.outside(found)));
        let is_outside = outside.dot(step) <= 0.0;
        let plane_normal = if is_outside { outside } else { -outside };
        let (normal, lift) = match round {
            Some(_) => (plane_normal, DVec3::ZERO),
            None => smooth(
                surfaces.scene,
                (found.triangle.corners, found.weights()),
                (places, place),
                plane_normal,
            ),
        };
        let event = along(ray.origin, ray.step, found.s);
        let delay = match ray.start {
            Start::Eye => 0.0,
            _ => part.frame.rest_from_camera(event).t + ugphysics::length(place),
        };
        let is_moving = !part.frame.velocity().is_zero();
        let own_time = || delay - ugphysics::length(place);
        let plane = SurfaceElementPlane { frame: &part.frame, normal: plane_normal, event, places };
        let steps = || neighbours().map_or([[0.0; 2]; 2], |rays| plane.steps(rays, |step| step));
        let (color, emitted) = surfaces.colors(found, is_moving, own_time, steps);
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
        surfaces: &Surfaces<'_>,
        ray: &PastRay,
        found: &Intersection,
        line: &WorldLine,
        neighbours: impl Fn() -> Option<[PastRay; 2]>,
    ) -> Self {
        let places = surfaces.places(found);
        let place = mean(places, found.weights());
        let own_time = found.own_time;
        let element = line.element(place, own_time);
        let frame = RestFrame::new(element.velocity);
        let outside = surfaces.outside(found);
        let step = frame.rest_from_camera(ray.step).x;
        let outside_in_frame = element.normal(outside);
        let is_outside = outside_in_frame.dot(step) <= 0.0;
        let side = if is_outside { 1.0 } else { -1.0 };
        let (plane, plane_normal) = (side * outside, side * outside_in_frame);
        let (body_normal, body_lift) = smooth(
            surfaces.scene,
            (found.triangle.corners, found.weights()),
            (places, place),
            plane,
        );
        let lift = if body_lift == DVec3::ZERO {
            DVec3::ZERO
        } else {
            ugphysics::length(body_lift) * element.normal(unit_or_zero(body_lift))
        };
        let event = along(ray.origin, ray.step, found.s);
        let triangle = SurfaceElementPlane { frame: &frame, normal: plane_normal, event, places };
        let steps = || {
            neighbours()
                .map_or([[0.0; 2]; 2], |rays| triangle.steps(rays, |step| to_body(&element, step)))
        };
        let (color, emitted) = surfaces.colors(found, true, || own_time, steps);
        Self {
            part: found.part,
            face: found.triangle.face,
            event,
            place,
            element: Some(Box::new(WorldLineElement { frame, own_time, body_normal })),
            delay: 0.0,
            lift: if lift.is_finite() { lift } else { DVec3::ZERO },
            plane_normal,
            normal: if body_normal == plane { plane_normal } else { element.normal(body_normal) },
            is_outside,
            wave: frame.wave_to_rest(ray.wave),
            color,
            emitted,
        }
    }

    /// Where a neighbour of the ray meets the surface: the event, the place, and the normal there.
    pub fn beside(
        &self,
        surfaces: &Surfaces<'_>,
        found: &Intersection,
        ray: &PastRay,
    ) -> (Event, DVec3, DVec3) {
        let Surfaces { scene, world, .. } = surfaces;
        let places = surfaces.places(found);
        let (frame, normal) = (self.frame(world), self.plane_normal);
        let plane = SurfaceElementPlane { frame, normal, event: self.event, places };
        let (s, step) = plane.met(ray);
        let smooth = |step: DVec3, normal: DVec3| {
            let [_, second, third] = found.weights();
            let [across, down] = plane.weights(step);
            let (second, third) = (second + across, third + down);
            let weights = [1.0 - second - third, second, third];
            smooth(scene, (found.triangle.corners, weights), (places, self.place + step), normal).0
        };
        let side = if self.is_outside { 1.0 } else { -1.0 };
        let (place, normal) = if let Some((line, own_time)) = self.world_line(world) {
            let element = line.element(self.place, own_time);
            let step = to_body(&element, step);
            (self.place + step, element.normal(smooth(step, side * surfaces.outside(found))))
        } else {
            let place = self.place + step;
            let round = world.parts[self.part].round_surface(found, (place, DVec3::ZERO));
            (place, round.map_or_else(|| smooth(step, normal), |(_, outside)| side * outside))
        };
        (along(ray.origin, ray.step, s), place, normal)
    }

    /// The rest frame of the surface.
    pub fn frame<'s>(&'s self, world: &'s World) -> &'s RestFrame {
        match &self.element {
            Some(element) => &element.frame,
            None => &world.parts[self.part].frame,
        }
    }

    /// The world line of the body, and its own time here; `None` for an inertial body.
    pub fn world_line<'s>(&self, world: &'s World) -> Option<(&'s WorldLine, f64)> {
        let own_time = self.element.as_ref()?.own_time;
        Some((&world.parts[self.part].motion.as_ref()?.line, own_time))
    }

    /// The surface as lamps light it.
    pub fn lit(&self, scene: &Scene) -> SurfaceElement {
        let (time, normal) = match &self.element {
            Some(element) => (ScatteringTime::Own(element.own_time), element.body_normal),
            None => (ScatteringTime::Delay(self.delay), self.normal),
        };
        SurfaceElement {
            point: self.place,
            time,
            normal,
            body: scene.faces[self.face as usize].body,
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
    pub fn surface(&self, scene: &Scene) -> Option<SurfaceId> {
        scene.surface_id(&scene.faces[self.face as usize])
    }
}

impl Surfaces<'_> {
    /// The corners of a triangle at rest.
    fn places(&self, found: &Intersection) -> [DVec3; 3] {
        found.triangle.corners.map(|corner| self.appearance.surface.rest(corner))
    }

    /// The unit normal of a face on its outside.
    fn outside(&self, found: &Intersection) -> DVec3 {
        self.world.outside[found.triangle.face as usize]
    }

    /// The colour at rest of a face where a ray meets it, and the colour of the light that the face
    /// emits there. `own_time`: of the body; `steps`: from sample to sample, of the weights of the
    /// corners, for textures.
    #[inline]
    fn colors(
        &self,
        found: &Intersection,
        is_moving: bool,
        own_time: impl Fn() -> f64,
        steps: impl Fn() -> [[f64; 2]; 2],
    ) -> (SurfaceColor, Option<Box<SurfaceColor>>) {
        let Self { scene, appearance, textures, .. } = self;
        let (corners, weights) = (found.triangle.corners, found.weights());
        let color = scene.faces[found.triangle.face as usize].color;
        let of_corners = || {
            let colors = &self.face_colors[found.triangle.face as usize];
            appearance.color_at(colors, corners, weights)
        };
        // Most scenes have neither.
        if textures.is_empty() && scene.emissions.is_empty() && scene.color_tables.is_empty() {
            return (of_corners(), None);
        }
        let now =
            |color: Option<ColorId>| appearance.color_at_time(scene, color?, own_time(), is_moving);
        let at = Some((corners, weights));
        let [texel, emitted] = textures.colors((scene, appearance), color, at, is_moving, steps);
        let emitted =
            emitted.map(|it| now(color.and_then(|color| scene.emitted_by(color))).unwrap_or(it));
        (texel.or_else(|| now(color)).unwrap_or_else(of_corners), emitted.map(Box::new))
    }
}

/// A step in the coordinates of the body: its axes in the frame of the element, as normals turn,
/// exact unless the body spins.
fn to_body(element: &ElementFrame, step: DVec3) -> DVec3 {
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
    scene: &Scene,
    (vertices, weights): ([VertexId; 3], [f64; 3]),
    (corners, place): ([DVec3; 3], DVec3),
    plane: DVec3,
) -> (DVec3, DVec3) {
    let own = vertices.map(|corner| scene.vertices[corner.index()].normal);
    if own == [None; 3] {
        return (plane, DVec3::ZERO);
    }
    let normals = own.map(|own| ugscene::shading_normal(own, plane));
    let lifts = [0, 1, 2].map(|at| (corners[at] - place).dot(normals[at]).max(0.0) * normals[at]);
    (mean(normals, weights).normalize_or_zero(), mean(lifts, weights))
}
