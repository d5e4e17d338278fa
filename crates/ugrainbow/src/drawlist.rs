//! From the faces of a scene to polygons in the picture plane.

use glam::DVec3;
use rayon::prelude::*;
use ugparse::Face;

use crate::clip::{Vertex, clip_polygon};
use crate::painter::Painter;
use crate::palette::Swatch;
use crate::raster::PolygonList;
use ugscene::Place;

/// Faces that one task turns into a list.
const CHUNK: usize = 1024;

/// Polygons in drawing order, and how many faces came how far.
pub struct DrawList<const N: usize> {
    /// Sorted into bands.
    pub lists: Vec<PolygonList<N>>,
    /// How many faces came how far.
    pub reach: Reach,
}

/// How many faces and lines came how far.
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
    /// The faces that `is_drawn` says, in the order of the scene; their items are their rows. `pack` turns a colour and
    /// the level of red, green and blue light into the numbers to interpolate.
    pub fn new(
        painter: &Painter<'_>,
        is_drawn: impl Fn(&Face) -> bool + Sync,
        pack: impl Fn(&Swatch, DVec3) -> [f64; N] + Sync,
    ) -> Self {
        let scene = painter.scene;
        let places: Vec<Place> = scene
            .vertices
            .par_iter()
            .map(|vertex| painter.view.place(vertex.position - painter.view.eye))
            .collect();
        let faces = scene.faces.par_chunks(CHUNK).enumerate();
        let parts = faces.map(|(idx, faces)| Chunk::new(painter, idx, &places, &pack).all(faces, &is_drawn));
        Self::of(parts.collect())
    }

    /// None.
    pub fn empty() -> Self {
        Self::of(Vec::new())
    }

    fn of(parts: Vec<(PolygonList<N>, Reach)>) -> Self {
        let (lists, reaches): (Vec<PolygonList<N>>, Vec<_>) = parts.into_iter().unzip();
        let lists = lists.into_iter().filter(|list| !list.is_empty()).collect();
        Self { lists, reach: reaches.into_iter().fold(Reach::default(), Reach::merge) }
    }
}

/// A run of faces becoming polygons.
struct Chunk<'a, const N: usize, P> {
    painter: &'a Painter<'a>,
    /// Of every vertex.
    places: &'a [Place],
    pack: &'a P,
    /// Of the face in work.
    item: u32,
    list: PolygonList<N>,
    reach: Reach,
    /// The contour in work, kept for its buffer.
    contour: Vec<Vertex<N>>,
    scratch: Vec<Vertex<N>>,
}

impl<'a, const N: usize, P: Fn(&Swatch, DVec3) -> [f64; N]> Chunk<'a, N, P> {
    /// The chunk of this number.
    fn new(painter: &'a Painter<'a>, chunk: usize, places: &'a [Place], pack: &'a P) -> Self {
        Self {
            painter,
            // The text of a scene is below 4 GiB, and so are these numbers.
            item: (chunk * CHUNK) as u32,
            places,
            pack,
            list: PolygonList::default(),
            reach: Reach::default(),
            contour: Vec::new(),
            scratch: Vec::new(),
        }
    }

    fn all(mut self, faces: &[Face], is_drawn: impl Fn(&Face) -> bool) -> (PolygonList<N>, Reach) {
        for face in faces {
            if is_drawn(face) {
                self.push_face(face);
            }
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
}
