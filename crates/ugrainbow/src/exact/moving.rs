//! Round faces, and faces of bodies that accelerate, spin or orbit: their hits are found along each
//! ray.

use std::collections::BTreeMap;
use std::ops::{ControlFlow, Range};

use glam::DVec3;
use uglight::{FaceColors, Swatch};
use ugraster::Bounds;
use ugscene::{Face, VertexId};
use ugtrace::rays::{Faces, Intersection, PastRay, World};
use ugtrace::{SurfacePoint, Surfaces};

use super::look::{Look, with_emitted};
use crate::painter::Painter;

/// The faces of a scene that are round or on world lines.
pub struct MovingFaces<'a> {
    painter: Painter<'a>,
    world: World,
    face_colors: Vec<FaceColors>,
    /// By row of the face.
    looks: BTreeMap<u32, Look>,
}

impl<'a> MovingFaces<'a> {
    /// Those for which `is_drawn` returns true; `None` if there are none.
    pub fn new(
        painter: Painter<'a>,
        planes: &[u32],
        is_drawn: impl Fn(&Face) -> bool,
    ) -> Option<Self> {
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
        Some(Self { painter, world, face_colors: painter.appearance.all_face_colors(scene), looks })
    }

    /// The number of faces in the picture.
    pub fn n_in_picture(&self) -> usize {
        let Painter { scene, grid, .. } = self.painter;
        let is_in_picture = |face: &u32| {
            let corners =
                scene.contours.corners(scene.faces[*face as usize].contours.clone()).iter();
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
        let Painter { scene, appearance, textures, .. } = self.painter;
        let Self { world, face_colors, .. } = self;
        let surfaces = Surfaces { scene, world, appearance, face_colors, textures };
        let neighbours = || Some([self.ray([x + 1.0, y]), self.ray([x, y + 1.0])]);
        let point = SurfacePoint::new(&surfaces, ray, found, neighbours);
        let (look, stretch) = (&self.looks[&point.face], point.wave.frequency);
        let color = (Some(point.color.swatch), || Some(point.color.rows));
        let mut seen = look.shaded::<SPECTRAL>(&self.painter, color, stretch, || {
            let frames = appearance.surface.frames();
            let lit = point.lit(scene).standing(frames);
            [lit.point, lit.normal, frames.lamp_shift(lit.body)]
        });
        if let Some(emitted) = &point.emitted {
            seen = with_emitted(&self.painter, seen, stretch, emitted);
        }
        seen
    }
}
