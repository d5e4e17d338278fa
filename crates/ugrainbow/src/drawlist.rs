//! From the scene to polygons in the picture plane.

use glam::DVec3;
use rayon::prelude::*;
use ugparse::{Face, VertexId, Wire};

use crate::clip::{Vertex, clip_polygon, clip_segment};
use crate::exact::{Bend, Joint};
use crate::painter::Painter;
use crate::palette::Swatch;
use crate::raster::{Corner, PolygonList};
use ugscene::Place;

/// Faces or wires that one task turns into a list.
const CHUNK: usize = 1024;

/// Half the width of a wire in pixels.
const WIRE_HALF_WIDTH: f64 = 0.6;

/// How much nearer to the eye a wire is drawn than it is, relative to its distance: enough to
/// win against the faces whose edge it follows.
pub const WIRE_LIFT: f64 = 5e-4;

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
    /// Those of two parts of a scene together.
    pub fn merge(self, other: Self) -> Self {
        Self { in_front: self.in_front + other.in_front, in_picture: self.in_picture + other.in_picture }
    }
}

impl<const N: usize> DrawList<N> {
    /// Faces first, then wires, each in the order of the scene; their items are counted in this order from 0. `pack` turns a colour and
    /// the level of red, green and blue light into the numbers to interpolate.
    pub fn new(painter: &Painter<'_>, pack: impl Fn(&Swatch, DVec3) -> [f64; N] + Sync) -> Self {
        let scene = painter.scene;
        let places: Vec<Place> = scene
            .vertices
            .par_iter()
            .map(|vertex| painter.view.place(vertex.position - painter.view.eye))
            .collect();
        let faces = scene.faces.par_chunks(CHUNK).enumerate();
        let faces = faces
            .map(|(idx, faces)| Chunk::new(painter, idx, 0, &places, &pack).all(faces, Chunk::push_face));
        let wires = scene.wires.par_chunks(CHUNK).enumerate();
        let n_faces = scene.faces.len();
        let wires = wires.map(|(idx, wires)| {
            Chunk::new(painter, idx, n_faces, &places, &pack).all(wires, Chunk::push_wire)
        });
        Self::of(faces.chain(wires).collect())
    }

    /// The wires alone, bent as they are seen; numbered as if faces were there.
    pub fn wires(
        painter: &Painter<'_>,
        bend: &Bend<'_>,
        pack: impl Fn(&Swatch, DVec3) -> [f64; N] + Sync,
    ) -> Self {
        let wires = painter.scene.wires.par_chunks(CHUNK).enumerate();
        let n_faces = painter.scene.faces.len();
        let wires = wires.map(|(idx, wires)| {
            Chunk::new(painter, idx, n_faces, &[], &pack)
                .all(wires, |chunk, wire| chunk.push_bent(wire, bend))
        });
        Self::of(wires.collect())
    }

    fn of(parts: Vec<(PolygonList<N>, Reach)>) -> Self {
        let (lists, reaches): (Vec<PolygonList<N>>, Vec<_>) = parts.into_iter().unzip();
        let lists = lists.into_iter().filter(|list| !list.is_empty()).collect();
        Self { lists, reach: reaches.into_iter().fold(Reach::default(), Reach::merge) }
    }
}

/// A run of faces or wires becoming polygons.
struct Chunk<'a, const N: usize, P> {
    painter: &'a Painter<'a>,
    /// Of every vertex.
    places: &'a [Place],
    pack: &'a P,
    /// Of the face or wire in work.
    item: u32,
    list: PolygonList<N>,
    reach: Reach,
    /// The contour in work, kept for its buffer.
    contour: Vec<Vertex<N>>,
    scratch: Vec<Vertex<N>>,
}

impl<'a, const N: usize, P: Fn(&Swatch, DVec3) -> [f64; N]> Chunk<'a, N, P> {
    /// The chunk of this number among faces or wires; `first`: number of the first of them.
    fn new(painter: &'a Painter<'a>, chunk: usize, first: usize, places: &'a [Place], pack: &'a P) -> Self {
        Self {
            painter,
            // The text of a scene is below 4 GiB, and so are these numbers.
            item: (first + chunk * CHUNK) as u32,
            places,
            pack,
            list: PolygonList::default(),
            reach: Reach::default(),
            contour: Vec::new(),
            scratch: Vec::new(),
        }
    }

    fn all<T>(mut self, items: &[T], push: impl Fn(&mut Self, &T)) -> (PolygonList<N>, Reach) {
        for item in items {
            push(&mut self, item);
            self.item += 1;
        }
        self.list.sort_into_bands(self.painter.grid);
        (self.list, self.reach)
    }

    fn push_face(&mut self, face: &Face) {
        let normal = self.painter.seen_normal(face);
        let common = self.painter.common(face);
        let mut is_in_front = false;
        for corners in self.painter.scene.face_contours(face) {
            self.contour.clear();
            for &vertex in corners {
                let swatch = self.painter.swatch(vertex, &common);
                let level = self.painter.level(face, vertex, normal, common.is_light);
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
        clip_polygon(view.slab, &mut self.contour, &mut self.scratch);
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
        self.reach.in_picture += usize::from(self.list.end_polygon(self.painter.grid, self.item));
    }

    fn push_wire(&mut self, wire: &Wire) {
        let color = self.painter.wire_swatch(wire);
        // One end given as light makes all of the wire light, as with faces.
        let is_light = self.painter.is_light_wire(wire, &color);
        for line in self.painter.scene.wire_contours(wire) {
            for ends in line.windows(2) {
                let ends = [ends[0], ends[1]].map(|vertex| self.wire_end(vertex, &color, is_light));
                self.push_line(ends);
            }
        }
    }

    fn push_bent(&mut self, wire: &Wire, bend: &Bend<'_>) {
        for line in self.painter.scene.wire_contours(wire) {
            for ends in line.windows(2) {
                let joints: Vec<Vertex<N>> =
                    bend.joints(wire, [ends[0], ends[1]]).iter().map(|joint| self.joint(joint)).collect();
                joints.windows(2).for_each(|ends| self.push_line([ends[0], ends[1]]));
            }
        }
    }

    fn joint(&self, joint: &Joint) -> Vertex<N> {
        Vertex { place: self.painter.view.place(joint.seen), values: (self.pack)(&joint.color, DVec3::ONE) }
    }

    fn push_line(&mut self, ends: [Vertex<N>; 2]) {
        if let Some(ends) = clip_segment(self.painter.view.slab, ends) {
            self.push_strip(ends);
        }
    }

    /// Wires are not lit.
    fn wire_end(&self, vertex: VertexId, color: &Swatch, is_light: bool) -> Vertex<N> {
        let swatch = self.painter.wire_end(vertex, color);
        let swatch = if is_light { self.painter.as_light(swatch) } else { swatch };
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
