//! From the scene to polygons in the picture plane.

use glam::DVec3;
use rayon::prelude::*;
use ugparse::{Face, Scene, VertexId, Wire};

use crate::camera::View;
use crate::clip::{Place, Vertex};
use crate::light::Lighting;
use crate::palette::{Palette, Swatch};
use crate::raster::{Corner, Grid, PolygonList};
use crate::surface::Surface;

/// Faces or wires that one task turns into a list.
const CHUNK: usize = 1024;

/// Half the width of a wire in pixels.
const WIRE_HALF_WIDTH: f64 = 0.6;

/// How much nearer to the eye a wire is drawn than it is, relative to its distance: enough to
/// win against the faces whose edge it follows.
const WIRE_LIFT: f64 = 5e-4;

/// All that faces and wires are drawn from.
pub struct Painter<'a> {
    /// The scene, with vertices of one velocity each.
    pub scene: &'a Scene,
    /// The camera.
    pub view: &'a View,
    /// The sample grid.
    pub grid: &'a Grid,
    /// Its colours.
    pub palette: &'a Palette,
    /// Its lights.
    pub lighting: &'a Lighting,
    /// Its surfaces: colours and rest geometry of vertices.
    pub surface: &'a Surface,
}

/// Polygons in drawing order, and how many faces and wires came how far.
pub struct DrawList<const N: usize> {
    /// Sorted into bands.
    pub lists: Vec<PolygonList<N>>,
    /// How many faces and wires came how far.
    pub reach: Reach,
}

/// How many faces and pieces of wires came how far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Reach {
    /// Between the clipping planes, at least in part.
    pub in_front: usize,
    /// In the picture as well.
    pub in_picture: usize,
}

impl Reach {
    fn merge(self, other: Self) -> Self {
        Self { in_front: self.in_front + other.in_front, in_picture: self.in_picture + other.in_picture }
    }
}

impl<const N: usize> DrawList<N> {
    /// Faces first, then wires, each in the order of the scene. `pack` turns a colour and
    /// the level of red, green and blue light into the numbers to interpolate.
    pub fn new(painter: &Painter<'_>, pack: impl Fn(&Swatch, DVec3) -> [f64; N] + Sync) -> Self {
        let scene = painter.scene;
        let places: Vec<Place> = scene
            .vertices
            .par_iter()
            .map(|vertex| painter.view.place(vertex.position - painter.view.eye))
            .collect();
        let chunk = || Chunk {
            painter,
            places: &places,
            pack: &pack,
            list: PolygonList::default(),
            reach: Reach::default(),
            contour: Vec::new(),
            scratch: Vec::new(),
        };
        let faces = scene.faces.par_chunks(CHUNK).map(|faces| chunk().all(faces, Chunk::push_face));
        let wires = scene.wires.par_chunks(CHUNK).map(|wires| chunk().all(wires, Chunk::push_wire));
        let (lists, reaches): (Vec<_>, Vec<_>) = faces.chain(wires).unzip();
        Self { lists, reach: reaches.into_iter().fold(Reach::default(), Reach::merge) }
    }
}

/// A run of faces or wires becoming polygons.
struct Chunk<'a, const N: usize, P> {
    painter: &'a Painter<'a>,
    /// Of every vertex.
    places: &'a [Place],
    pack: &'a P,
    list: PolygonList<N>,
    reach: Reach,
    /// The contour in work, kept for its buffer.
    contour: Vec<Vertex<N>>,
    scratch: Vec<Vertex<N>>,
}

impl<const N: usize, P: Fn(&Swatch, DVec3) -> [f64; N]> Chunk<'_, N, P> {
    fn all<T>(mut self, items: &[T], push: impl Fn(&mut Self, &T)) -> (PolygonList<N>, Reach) {
        items.iter().for_each(|item| push(&mut self, item));
        self.list.sort_into_bands(self.painter.grid);
        (self.list, self.reach)
    }

    fn push_face(&mut self, face: &Face) {
        let normal = self.seen_normal(face);
        let grey_tint = self.grey_tint(face);
        let mut is_in_front = false;
        for corners in self.painter.scene.face_contours(face) {
            self.contour.clear();
            for &vertex in corners {
                let swatch = self.swatch(vertex, grey_tint);
                let level = self.level(face, vertex, normal);
                let values = (self.pack)(&swatch, level);
                self.contour.push(Vertex { place: self.places[vertex.index()], values });
            }
            is_in_front |= self.push_contour();
        }
        if is_in_front {
            self.end_polygon();
        }
    }

    /// Clips and projects the contour; false if nothing is left of it.
    fn push_contour(&mut self) -> bool {
        let view = self.painter.view;
        view.slab.clip_polygon(&mut self.contour, &mut self.scratch);
        for vertex in &self.contour {
            self.list.push_corner(vertex.project(view.is_perspective));
        }
        if !self.contour.is_empty() {
            self.list.end_contour();
        }
        !self.contour.is_empty()
    }

    fn end_polygon(&mut self) {
        self.reach.in_front += 1;
        self.reach.in_picture += usize::from(self.list.end_polygon(self.painter.grid));
    }

    /// The rest normal of a face on the side that is seen; zero if lighting needs none or the
    /// face has none.
    fn seen_normal(&self, face: &Face) -> DVec3 {
        if face.illum.is_some() || !self.painter.lighting.needs_geometry() {
            return DVec3::ZERO;
        }
        let Some(outline) = self.painter.scene.face_contours(face).next() else { return DVec3::ZERO };
        let surface = self.painter.surface;
        let corners = outline.iter().map(|&vertex| surface.rest(vertex));
        ugscene::seen_normal(corners, self.toward_eye(face, outline[0]))
    }

    /// Where the eye is, seen from a corner in the rest frame of the face.
    fn toward_eye(&self, face: &Face, corner: VertexId) -> DVec3 {
        if self.painter.view.is_perspective {
            -self.painter.surface.rest(corner)
        } else {
            -self.painter.surface.rest_direction(self.painter.view.forward, face.velocity)
        }
    }

    fn level(&self, face: &Face, vertex: VertexId, seen_normal: DVec3) -> DVec3 {
        if let Some(level) = self.painter.scene.light_level(face) {
            return DVec3::splat(level);
        }
        let lighting = self.painter.lighting;
        if !lighting.needs_geometry() {
            return lighting.level(DVec3::ZERO, DVec3::ZERO);
        }
        let own = self.painter.scene.vertices[vertex.index()].normal;
        let normal = ugscene::shading_normal(own, seen_normal);
        lighting.level(self.painter.surface.rest(vertex), normal)
    }

    fn swatch(&self, vertex: VertexId, grey_tint: f64) -> Swatch {
        let swatch = self.painter.surface.swatch(vertex);
        if swatch.is_grey() { Swatch { tint: grey_tint, ..swatch } } else { swatch }
    }

    /// The tint a grey corner takes for interpolation: the mean of the coloured corners, so that
    /// a face from grey to blue does not run through the rainbow.
    fn grey_tint(&self, face: &Face) -> f64 {
        let corners = self.painter.scene.contours.corners(face.contours.clone());
        let swatches = corners.iter().map(|&vertex| self.painter.surface.swatch(vertex));
        let (sum, count) = swatches
            .filter(|swatch| !swatch.is_grey())
            .fold((0.0, 0), |(sum, count), swatch| (sum + swatch.tint, count + 1));
        if count == 0 { 0.0 } else { sum / f64::from(count) }
    }

    fn push_wire(&mut self, wire: &Wire) {
        let color = wire.color.map_or(Swatch::WHITE, |color| self.painter.palette.get(color));
        for line in self.painter.scene.wire_contours(wire) {
            for ends in line.windows(2) {
                let ends = [ends[0], ends[1]].map(|vertex| self.wire_end(vertex, &color));
                if let Some(ends) = self.painter.view.slab.clip_segment(ends) {
                    self.push_strip(ends);
                }
            }
        }
    }

    /// Wires are not lit.
    fn wire_end(&self, vertex: VertexId, color: &Swatch) -> Vertex<N> {
        let own = self.painter.scene.vertices[vertex.index()].color;
        let swatch = own.map_or(*color, |own| self.painter.palette.get(own));
        Vertex { place: self.places[vertex.index()], values: (self.pack)(&swatch, DVec3::ONE) }
    }

    /// Adds a line as a strip in the picture plane, with square ends so that the pieces of a
    /// polyline join.
    fn push_strip(&mut self, ends: [Vertex<N>; 2]) {
        let view = self.painter.view;
        let [a, b] = ends.map(|end| {
            let z = end.place.z;
            let lifted =
                if view.is_perspective { z * (1.0 - WIRE_LIFT) } else { z - WIRE_LIFT * view.distance };
            let Place { x, y, .. } = end.place;
            // Moved along its own ray: x/z and y/z stay.
            let ratio = if view.is_perspective { lifted / z } else { 1.0 };
            let place = Place { x: x * ratio, y: y * ratio, z: lifted };
            Vertex { place, ..end }.project(view.is_perspective)
        });
        let half = WIRE_HALF_WIDTH * f64::from(self.painter.grid.samples);
        let length = libm::hypot(b.x - a.x, b.y - a.y);
        let (along_x, along_y) = if length > 0.0 {
            ((b.x - a.x) / length * half, (b.y - a.y) / length * half)
        } else {
            (half, 0.0)
        };
        let corner = |end: &Corner<N>, forth: f64, aside: f64| Corner {
            x: end.x + forth * along_x - aside * along_y,
            y: end.y + forth * along_y + aside * along_x,
            ..*end
        };
        for corner in
            [corner(&a, -1.0, -1.0), corner(&b, 1.0, -1.0), corner(&b, 1.0, 1.0), corner(&a, -1.0, 1.0)]
        {
            self.list.push_corner(corner);
        }
        self.list.end_contour();
        self.end_polygon();
    }
}
