//! Round faces, and faces of bodies that accelerate, spin or orbit: their hits are found along each
//! ray.

use std::collections::BTreeMap;
use std::ops::{ControlFlow, Range};

use glam::DVec3;
use uglight::Swatch;
use ugphysics::RestFrame;
use ugpicture::rays::{Faces, Intersection, PastRay, World, along};
use ugpicture::textures::SurfaceElementPlane;
use ugraster::Bounds;
use ugscene::{Face, VertexId, shading_normal};

use super::look::{Look, mean};
use crate::painter::Painter;

/// The faces of a scene that are round or on world lines.
pub struct MovingFaces<'a> {
    painter: Painter<'a>,
    world: World,
    /// By row of the face.
    looks: BTreeMap<u32, Look>,
}

impl<'a> MovingFaces<'a> {
    /// Those for which `is_drawn` returns true; `None` if there are none.
    pub fn new(painter: Painter<'a>, planes: &[u32], is_drawn: impl Fn(&Face) -> bool) -> Option<Self> {
        let (scene, surface) = (painter.scene, &painter.appearance.surface);
        let is_found_by_rays =
            |face: &Face| face.shape.is_round() || surface.frames().world_line(face.body).is_some();
        let is_traced = |face: &Face| is_found_by_rays(face) && is_drawn(face);
        // The text of a scene is below 4 GiB, so row numbers fit.
        let faces = (0..).zip(&scene.faces).filter(|(_, face)| is_traced(face));
        let looks: BTreeMap<u32, Look> =
            faces.map(|(row, face)| (row, Look::new(&painter, None, face))).collect();
        if looks.is_empty() {
            return None;
        }
        let world = World::new(
            Faces { scene, rest: surface.all_rest() },
            surface.frames(),
            planes.to_vec(),
            is_traced,
        );
        Some(Self { painter, world, looks })
    }

    /// The number of faces in the picture.
    pub fn n_in_picture(&self) -> usize {
        let Painter { scene, grid, .. } = self.painter;
        let is_in_picture = |face: &u32| {
            let corners = scene.contours.corners(scene.faces[*face as usize].contours.clone()).iter();
            let place = |id: &VertexId| self.painter.place(scene.vertices[id.index()].position);
            let points = corners.map(|id| self.painter.point(place(id)));
            Bounds::new(points.map(|point| [point.x, point.y])).is_in_picture(grid)
        };
        self.looks.keys().filter(|face| is_in_picture(face)).count()
    }

    fn faces(&self) -> Faces<'_> {
        Faces { scene: self.painter.scene, rest: self.painter.appearance.surface.all_rest() }
    }

    /// The ray through a place of the picture, in samples. Its parameter is the depth.
    pub fn ray(&self, [x, y]: [f64; 2]) -> PastRay {
        let [corner, across, down] = self.painter.view.rays();
        PastRay::from_eye(corner + x * across + y * down)
    }

    fn depths(&self) -> Range<f64> {
        self.painter.view.slab.near..self.painter.view.slab.far
    }

    /// The nearest hit.
    pub fn nearest(&self, ray: &PastRay) -> Option<Intersection> {
        self.world.closest(self.faces(), ray, self.depths())
    }

    /// All hits, in the order of the scene.
    pub fn all(&self, ray: &PastRay) -> Vec<Intersection> {
        let mut all = Vec::new();
        let _ = self.world.visit(self.faces(), ray, self.depths(), |found| {
            all.push(found);
            ControlFlow::Continue(())
        });
        all.sort_by(|a, b| a.triangle.face.cmp(&b.triangle.face).then(a.s.total_cmp(&b.s)));
        all
    }

    /// Apparent colour and light level at a hit.
    /// `x`, `y`: the place of the sample in the picture.
    pub fn shaded<const SPECTRAL: bool>(
        &self,
        ray: &PastRay,
        found: &Intersection,
        [x, y]: [f64; 2],
    ) -> (Swatch, DVec3) {
        let Painter { scene, appearance, .. } = self.painter;
        let face = found.triangle.face;
        let Some(line) = appearance.surface.frames().world_line(scene.faces[face as usize].body) else {
            return self.round_shaded::<SPECTRAL>(ray, found);
        };
        let (corners, weights, own_time) = (found.triangle.corners, found.weights(), found.own_time);
        let place = mean(weights, corners.map(|corner| appearance.surface.rest(corner)));
        let element = line.element(place, own_time);
        let frame = RestFrame::new(element.velocity);
        let stretch = frame.wave_to_rest(ray.wave).frequency;
        let look = &self.looks[&face];
        let outside = self.world.outside[face as usize];
        let steps = || {
            let plane = SurfaceElementPlane {
                frame: &frame,
                normal: element.normal(outside),
                event: along(ray.origin, ray.step, found.s),
                places: corners.map(|corner| appearance.surface.rest(corner)),
            };
            // Exact unless the body spins.
            let to_body =
                |step: DVec3| DVec3::from_array(DVec3::AXES.map(|axis| element.normal(axis).dot(step)));
            plane.steps([self.ray([x + 1.0, y]), self.ray([x, y + 1.0])], to_body)
        };
        let color = scene.faces[face as usize].color;
        let texel = self.painter.textures.texel(scene, color, (corners, weights), steps);
        let color = match texel {
            Some(texel) => appearance.texel(texel.light, texel.translucency, true),
            None => appearance.color_at(&look.colors, corners, weights),
        };
        let color = (Some(color.swatch), || Some(color.rows));
        let seen = look.shaded::<SPECTRAL>(&self.painter, color, stretch, || {
            let step = frame.rest_from_camera(ray.step).x;
            let seen = if element.normal(outside).dot(step) <= 0.0 { outside } else { -outside };
            let own = corners.map(|corner| shading_normal(scene.vertices[corner.index()].normal, seen));
            let normal = if own == [seen; 3] { seen } else { mean(weights, own).normalize_or_zero() };
            // It is lit as it stands in the scene if it only turned.
            let (place, turn) = line.standing(place, own_time);
            [place, turn * normal, DVec3::ZERO]
        });
        look.with_emitted(&self.painter, seen, (stretch, true), Some((corners, weights)), steps)
    }

    /// The same on a round face of an inertial body.
    fn round_shaded<const SPECTRAL: bool>(&self, ray: &PastRay, found: &Intersection) -> (Swatch, DVec3) {
        let face = found.triangle.face;
        let frame = &self.world.parts[found.part].frame;
        let at = ray.in_part(found.part, frame);
        let Some((place, outside)) = self.world.parts[found.part].round_surface(found, at) else {
            return (Swatch::WHITE, DVec3::ZERO);
        };
        let stretch = frame.wave_to_rest(ray.wave).frequency;
        let look = &self.looks[&face];
        let seen = look.shaded::<SPECTRAL>(&self.painter, (None, || None), stretch, || {
            let seen = if outside.dot(at.1) <= 0.0 { outside } else { -outside };
            let body = self.painter.scene.faces[face as usize].body;
            [place, seen, self.painter.appearance.surface.frames().lamp_shift(body)]
        });
        look.with_emitted(&self.painter, seen, (stretch, stretch != 1.0), None, || [[0.0; 2]; 2])
    }
}
