//! The transparent solids that the eye is in.

use std::ops::ControlFlow;

use glam::DVec3;
use ugphysics::Event;
use ugscene::Scene;

use crate::media::{Media, Solid};
use ugtrace::rays::{Faces, Intersection, PastRay, World};

/// Rays from a point inside a closed surface leave it once more than they enter it, in every
/// direction. Surfaces that are not closed, such as a single pane, are told apart by the
/// directions: they cover some of them only. One is near each half of an axis; none is along an
/// axis or a diagonal.
const DIRECTIONS: [DVec3; 7] = [
    DVec3::new(0.307, 0.531, 0.790),
    DVec3::new(-0.913, 0.227, 0.339),
    DVec3::new(0.419, -0.877, 0.235),
    DVec3::new(0.283, 0.349, -0.893),
    DVec3::new(-0.547, -0.613, -0.571),
    DVec3::new(0.887, -0.211, -0.411),
    DVec3::new(-0.323, 0.904, -0.281),
];

/// The transparent solids of a scene.
#[derive(Debug)]
pub struct Immersion {
    /// Each with its bounds in the rest frame of its part.
    solids: Vec<(Solid, [DVec3; 2])>,
}

impl Immersion {
    /// The solids of a world.
    pub fn new(world: &World, faces: Faces<'_>) -> Self {
        let mut solids: Vec<(Solid, [DVec3; 2])> = Vec::new();
        let is_any = faces.scene.surfaces.iter().any(|surface| surface.transmitted > 0.0);
        let parts = world.parts.iter().enumerate().filter(|_| is_any);
        let boxes = parts.flat_map(|(row, part)| {
            part.boxes(|corner| faces.rest[corner.index()])
                .map(move |(face, bounds)| (row, face, bounds))
        });
        for (part, face, of_face) in boxes {
            let Some(solid) = transparent_solid(faces.scene, part, face) else { continue };
            let at = solids.iter().position(|(known, _)| *known == solid).unwrap_or_else(|| {
                solids.push((solid, [DVec3::INFINITY, DVec3::NEG_INFINITY]));
                solids.len() - 1
            });
            let [low, high] = &mut solids[at].1;
            (*low, *high) = (low.min(of_face[0]), high.max(of_face[1]));
        }
        Self { solids }
    }

    /// The solids around an event in the frame of the camera, the innermost last. Of solids that
    /// intersect, the one whose surface is nearer in the first direction is taken as inner.
    pub fn media(&self, world: &World, faces: Faces<'_>, event: Event) -> Media {
        let mut inside = self.solids.iter().filter(|(solid, [low, high])| {
            let place = world.parts[solid.part].frame.rest_from_camera(event).x;
            place.cmpge(*low).all() && place.cmple(*high).all()
        });
        if inside.next().is_none() {
            return Media::default();
        }
        let crossings = DIRECTIONS.map(|direction| crossings(world, faces, event, direction));
        let exits = |crossings: &[Crossing], solid: Solid| -> i32 {
            let own = crossings.iter().filter(|crossing| crossing.solid == solid);
            own.map(|crossing| if crossing.is_exit { 1 } else { -1 }).sum()
        };
        // Where paths leave solids in the first direction, the outermost first.
        let mut media = Media::default();
        let mut left: Vec<Solid> = Vec::new();
        for crossing in crossings[0].iter().rev().filter(|crossing| crossing.is_exit) {
            let solid = crossing.solid;
            let n_inside = exits(&crossings[0], solid);
            let n_left = left.iter().filter(|other| **other == solid).count();
            let is_closed = crossings.iter().all(|crossings| exits(crossings, solid) == n_inside);
            if is_closed && i32::try_from(n_left).is_ok_and(|n_left| n_left < n_inside) {
                media = media.with(solid);
                left.push(solid);
            }
        }
        media
    }
}

/// True if a closed body is around an event: paths into the past meet a face that `is_opaque`
/// first, in every direction.
pub fn is_enclosed(
    world: &World,
    faces: Faces<'_>,
    event: Event,
    is_opaque: impl Fn(u32) -> bool,
) -> bool {
    let meets_opaque = |direction: &DVec3| {
        let ray = PastRay::in_vacuum(event, *direction);
        let first = world.closest(faces, &ray, 0.0..f64::INFINITY);
        first.is_some_and(|found| is_opaque(found.triangle.face))
    };
    DIRECTIONS.iter().all(meets_opaque)
}

/// Where a ray crosses the surface of a transparent solid.
pub struct Crossing {
    /// The solid.
    pub solid: Solid,
    /// True if the ray leaves the solid there.
    is_exit: bool,
    /// The parameter of the ray.
    pub s: f64,
}

impl Crossing {
    /// Where a ray meets a face; `None` if that is not of a transparent solid.
    pub fn new(
        world: &World,
        faces: Faces<'_>,
        ray: &PastRay,
        found: &Intersection,
    ) -> Option<Self> {
        let solid = transparent_solid(faces.scene, found.part, found.triangle.face)?;
        let step = ray.in_part(found.part, &world.parts[found.part].frame).1;
        Some(Self { solid, is_exit: world.outside_at(ray, found).dot(step) > 0.0, s: found.s })
    }

    /// The media of the ray behind it; `None` if it leaves a solid that it is not in.
    pub fn behind(&self, media: &Media) -> Option<Media> {
        if self.is_exit { media.without(self.solid) } else { Some(media.with(self.solid)) }
    }
}

/// The crossings of a ray into the past, in their order along it.
fn crossings(world: &World, faces: Faces<'_>, event: Event, direction: DVec3) -> Vec<Crossing> {
    let ray = PastRay::in_vacuum(event, direction);
    let mut all = Vec::new();
    let _ = world.visit(faces, &ray, 0.0..f64::INFINITY, |found| {
        all.extend(Crossing::new(world, faces, &ray, &found));
        ControlFlow::Continue(())
    });
    all.sort_by(|a, b| a.s.total_cmp(&b.s));
    all
}

/// The transparent solid that a face of a part belongs to.
pub fn transparent_solid(scene: &Scene, part: usize, face: u32) -> Option<Solid> {
    let surface = scene.surface_id(&scene.faces[face as usize])?;
    (scene.surfaces[surface.index()].transmitted > 0.0).then_some(Solid { part, surface })
}
