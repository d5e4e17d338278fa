//! From the faces of a scene to shapes in the picture plane.

use fearless_simd::Level;
use glam::DVec3;
use rayon::prelude::*;
use uglight::{FaceColors, Mixing, Swatch};
use ugraster::{
    BLOCK, Bounds, Corner, CornerTable, PolygonLayer, PolygonList, ScreenPoint, ShapeRef,
    TriangleBlock,
};
use ugscene::{Face, VertexId};

use crate::clip::{Vertex, clip_polygon};
use crate::packing::Pack;
use crate::painter::Painter;

/// Faces and triangles classified together: several blocks of triangles, so that one block is
/// filled while another is classified.
const TOGETHER: usize = 4 * BLOCK;

/// Least and greatest number of faces per task. Small tasks balance the load of threads; large ones
/// make fewer lists, and every band reads every list.
const CHUNKS: [usize; 2] = [1 << 10, 1 << 13];

/// Polygons and triangles in drawing order.
pub struct DrawList<'a, const N: usize> {
    /// Sorted into bands.
    lists: Vec<PolygonList<N>>,
    corners: Corners<'a, N>,
    /// How many faces are in the picture.
    pub n_in_picture: usize,
}

/// Projected vertices, and the values of faces at them.
struct Corners<'a, const N: usize> {
    painter: Painter<'a>,
    pack: Pack<N>,
    /// The projection of every vertex; NaN outside the clipping planes.
    points: Vec<ScreenPoint>,
    /// The light level of all faces without one of their own, if it is the same for all; see
    /// [`Painter::even_level`].
    even_level: Option<DVec3>,
}

impl<const N: usize> CornerTable<N> for Corners<'_, N> {
    #[inline]
    fn point(&self, corner: u32) -> ScreenPoint {
        self.points[corner as usize]
    }

    fn values(&self, item: u32, corners: [u32; 3]) -> [[f64; N]; 3] {
        let face = &self.painter.scene.faces[item as usize];
        if let (Some(level), None) = (self.even_level, face.shading) {
            let [a, b, c] =
                corners.map(|corner| self.painter.appearance.surface.swatch(VertexId(corner)));
            if !(a.is_grey() | b.is_grey() | c.is_grey()) {
                return [(self.pack)(a, level), (self.pack)(b, level), (self.pack)(c, level)];
            }
        }
        let look = FaceLook::new(&self.painter, face);
        let vertices = corners.map(VertexId);
        if self.painter.is_flat(&vertices) {
            let level = look.level(vertices[0]);
            return vertices.map(|vertex| (self.pack)(&look.swatch(vertex), level));
        }
        vertices.map(|vertex| look.numbers(vertex, self.pack))
    }
}

/// A face, and what its corners have in common.
pub struct FaceLook<'a> {
    painter: &'a Painter<'a>,
    face: &'a Face,
    /// The rest normal on its visible side.
    pub normal: DVec3,
    colors: FaceColors,
}

impl<'a> FaceLook<'a> {
    /// The look of a face.
    pub fn new(painter: &'a Painter<'a>, face: &'a Face) -> Self {
        let colors = painter.appearance.face_colors(painter.scene, face);
        Self { painter, face, normal: painter.seen_normal(face), colors }
    }

    fn numbers<const N: usize>(&self, vertex: VertexId, pack: Pack<N>) -> [f64; N] {
        pack(&self.swatch(vertex), self.level(vertex))
    }

    /// The colour of a corner.
    pub fn swatch(&self, vertex: VertexId) -> Swatch {
        self.painter.swatch(vertex, &self.colors)
    }

    /// The light level at a corner.
    pub fn level(&self, vertex: VertexId) -> DVec3 {
        self.painter.level(self.face, vertex, self.normal, self.is_light())
    }

    /// True if its colours are given as light.
    pub fn is_light(&self) -> bool {
        self.colors.mixing == Mixing::Light
    }
}

impl<'a, const N: usize> DrawList<'a, N> {
    /// The faces for which `is_drawn` holds, in the order of the scene; their items are their rows.
    /// `pack` makes the values to interpolate from a colour and a light level.
    pub fn new(
        painter: Painter<'a>,
        is_drawn: impl Fn(&Face) -> bool + Sync,
        pack: Pack<N>,
    ) -> Self {
        let scene = painter.scene;
        let even_level = painter.even_level();
        let corners = Corners { painter, pack, points: points(&painter), even_level };
        let [least, most] = CHUNKS;
        let chunk = (scene.faces.len() / 64).clamp(least, most);
        let level = Level::new();
        let mut parts: Vec<_> = scene.faces.chunks(chunk).map(|faces| (faces, None)).collect();
        parts.par_iter_mut().with_max_len(1).enumerate().for_each(|(idx, (faces, part))| {
            *part =
                Some(Chunk::new(&corners, faces.len(), level).all(idx * chunk, faces, &is_drawn));
        });
        let parts = parts.into_iter().filter_map(|(_, part)| part);
        let (lists, counts): (Vec<PolygonList<N>>, Vec<_>) = parts.unzip();
        let lists = lists.into_iter().filter(|list| !list.is_empty()).collect();
        Self { lists, corners, n_in_picture: counts.into_iter().sum() }
    }

    /// The layer for the rasterizer.
    pub fn shapes(&self) -> PolygonLayer<'_, N, impl CornerTable<N> + use<'a, N>> {
        PolygonLayer { lists: &self.lists, corners: &self.corners }
    }

    /// The contours of every polygon and triangle: column, row and depth key.
    pub fn outlines(&self) -> impl Iterator<Item = Vec<Vec<[f64; 3]>>> {
        let place = |corner: &Corner<N>| [corner.x, corner.y, corner.key];
        let point = |corner: u32| {
            let ScreenPoint { x, y, key } = self.corners.point(corner);
            [x, y, key]
        };
        self.lists.iter().flat_map(|list| list.shapes()).map(move |(_, shape)| match shape {
            ShapeRef::Polygon(contours) => {
                contours.map(|contour| contour.iter().map(place).collect()).collect()
            }
            ShapeRef::Triangle(corners) => vec![corners.map(point).to_vec()],
        })
    }

    /// Passes every polygon to `take`: its item and its contours.
    pub fn for_each_polygon(&self, mut take: impl FnMut(u32, Vec<Vec<Corner<N>>>)) {
        for (item, shape) in self.lists.iter().flat_map(|list| list.shapes()) {
            match shape {
                ShapeRef::Polygon(contours) => {
                    take(item, contours.map(<[Corner<N>]>::to_vec).collect())
                }
                ShapeRef::Triangle(corners) => {
                    let numbers = self.corners.values(item, corners);
                    let corner = |i: usize| {
                        let ScreenPoint { x, y, key } = self.corners.point(corners[i]);
                        let scale =
                            if self.corners.painter.view.is_perspective { key } else { 1.0 };
                        Corner { x, y, key, values: numbers[i].map(|number| number * scale) }
                    };
                    take(item, vec![[0, 1, 2].map(corner).to_vec()]);
                }
            }
        }
    }
}

/// The positions of all vertices in the picture, compiled once for all layouts.
fn points(painter: &Painter<'_>) -> Vec<ScreenPoint> {
    let scene = painter.scene;
    let point = |vertex: &ugscene::Vertex| painter.point(painter.place(vertex.position));
    scene.vertices.par_iter().map(point).collect()
}

/// A run of faces being converted to polygons and triangles.
struct Chunk<'a, const N: usize> {
    corners: &'a Corners<'a, N>,
    painter: &'a Painter<'a>,
    /// Row of the current face.
    item: u32,
    list: PolygonList<N>,
    n_in_picture: usize,
    parts: Parts,
    /// SIMD instructions of the processor. The result does not depend on them.
    level: Level,
    /// The current contour; its buffer is reused.
    contour: Vec<Vertex<N>>,
    scratch: Vec<Vertex<N>>,
}

/// Faces and triangles of faces in drawing order, to be classified together.
struct Parts {
    n: usize,
    /// The rows of their faces.
    items: [u32; TOGETHER],
    /// The parts that are triangles: part i is bit i.
    triangles: u64,
    /// The corners of the triangles.
    corners: [[u32; 3]; TOGETHER],
    blocks: [TriangleBlock; TOGETHER / BLOCK],
}

impl<'a, const N: usize> Chunk<'a, N> {
    /// For `n_faces` faces.
    fn new(corners: &'a Corners<'a, N>, n_faces: usize, level: Level) -> Self {
        Self {
            corners,
            painter: &corners.painter,
            item: 0,
            // Allocated once, because allocations of several threads wait for each other.
            list: PolygonList::with_capacity(n_faces),
            n_in_picture: 0,
            parts: Parts {
                n: 0,
                items: [0; TOGETHER],
                triangles: 0,
                corners: [[0; 3]; TOGETHER],
                blocks: Default::default(),
            },
            level,
            contour: Vec::new(),
            scratch: Vec::new(),
        }
    }

    /// The list of faces, the first of which is item `first`.
    fn all(
        mut self,
        first: usize,
        faces: &[Face],
        is_drawn: impl Fn(&Face) -> bool,
    ) -> (PolygonList<N>, usize) {
        for (idx, face) in faces.iter().enumerate().filter(|(_, face)| is_drawn(face)) {
            // The text of a scene is below 4 GiB, so row numbers fit.
            self.add_face((first + idx) as u32, face);
        }
        self.push_parts();
        self.list.sort_into_bands(self.painter.grid);
        (self.list, self.n_in_picture)
    }

    /// Adds a face, as its triangles if there is something to interpolate between its corners.
    fn add_face(&mut self, item: u32, face: &Face) {
        let corners = self.painter.scene.face_corners(face);
        if let &[VertexId(a), VertexId(b), VertexId(c)] = corners {
            self.add_triangle(item, [a, b, c]);
            return;
        }
        let triangles =
            if self.painter.is_even(face, corners) { None } else { self.painter.triangles(face) };
        let Some(triangles) = triangles else {
            self.parts.items[self.parts.n] = item;
            self.count_part();
            return;
        };
        for triangle in triangles {
            self.add_triangle(item, triangle.map(|corner| corners[corner as usize].0));
        }
    }

    #[inline]
    fn add_triangle(&mut self, item: u32, corners: [u32; 3]) {
        let [a, b, c] = corners;
        let points = [self.corners.point(a), self.corners.point(b), self.corners.point(c)];
        let idx = self.parts.n;
        self.parts.items[idx] = item;
        self.parts.corners[idx] = corners;
        self.parts.blocks[idx / BLOCK].set(idx % BLOCK, points);
        self.parts.triangles |= 1 << idx;
        self.count_part();
    }

    #[inline]
    fn count_part(&mut self) {
        self.parts.n += 1;
        if self.parts.n == TOGETHER {
            self.push_parts();
        }
    }

    /// Moves the parts to the list.
    fn push_parts(&mut self) {
        let Parts { n, triangles, blocks, .. } = &self.parts;
        let (n, triangles) = (*n, *triangles);
        let others =
            !triangles & u64::MAX.checked_shr((u64::BITS as usize - n) as u32).unwrap_or(0);
        let (mut regular, mut in_picture, mut drawn) = (0, 0, 0);
        let mut classes = [const { None }; TOGETHER / BLOCK];
        for (idx, (block, classes)) in blocks.iter().zip(&mut classes).enumerate() {
            let first = idx * BLOCK;
            if triangles >> first & ((1 << BLOCK) - 1) == 0 {
                continue;
            }
            let found = block.classify(self.level, self.painter.grid, self.painter.is_culled);
            regular |= found.regular << first;
            in_picture |= found.in_picture << first;
            drawn |= found.drawn << first;
            *classes = Some(found);
        }
        // The other entries of a block are stale.
        let regular = regular & triangles;
        self.n_in_picture += (regular & in_picture).count_ones() as usize;
        let mut left = (drawn & triangles) | (triangles & !regular) | others;
        while left != 0 {
            let idx = left.trailing_zeros() as usize;
            self.item = self.parts.items[idx];
            let corners = self.parts.corners[idx];
            match &classes[idx / BLOCK] {
                Some(classes) if regular >> idx & 1 == 1 => {
                    self.list.push_triangle(self.item, corners, classes.place(idx % BLOCK));
                }
                _ if triangles >> idx & 1 == 1 => {
                    let corners = corners.map(VertexId);
                    self.push_contours(std::iter::once(&corners[..]));
                }
                _ => {
                    let scene = self.painter.scene;
                    self.push_contours(scene.face_contours(&scene.faces[self.item as usize]));
                }
            }
            left &= left - 1;
        }
        (self.parts.n, self.parts.triangles) = (0, 0);
    }

    /// Adds the contours of the current face, or of a triangle of it that is not regular.
    fn push_contours<'c>(&mut self, contours: impl Iterator<Item = &'c [VertexId]> + Clone) {
        let face = &self.painter.scene.faces[self.item as usize];
        let points = contours.clone().flatten().map(|vertex| self.corners.points[vertex.index()]);
        // The rows of a face that is not clipped are known at once: outside the picture, or between
        // samples, it needs no more work.
        if points.clone().all(|point| point.is_finite()) {
            let rows = Bounds::new(points.map(|point| [point.x, point.y])).rows(self.painter.grid);
            self.n_in_picture += usize::from(rows.is_some());
            if rows.is_some_and(|rows| !rows.is_empty()) && !self.is_left_out(face) {
                self.clip_contours(face, contours);
                self.list.end_polygon(self.painter.grid, self.item);
            }
        } else if self.is_left_out(face) {
            // Culled, so it is not clipped.
            self.n_in_picture += 1;
        } else if self.clip_contours(face, contours) {
            self.end_polygon();
        }
    }

    fn is_left_out(&self, face: &Face) -> bool {
        self.painter.is_culled && self.painter.is_seen_from_behind(face)
    }

    /// Clips and projects the contours. Returns false if nothing is left.
    fn clip_contours<'c>(
        &mut self,
        face: &Face,
        contours: impl Iterator<Item = &'c [VertexId]>,
    ) -> bool {
        let look = FaceLook::new(self.painter, face);
        let mut is_in_front = false;
        for corners in contours {
            self.contour.clear();
            self.contour.extend(corners.iter().map(|&vertex| Vertex {
                place: self.painter.place(self.painter.scene.vertices[vertex.index()].position),
                values: look.numbers(vertex, self.corners.pack),
            }));
            is_in_front |= self.push_contour();
        }
        is_in_front
    }

    /// Clips and projects the contour. Returns false if nothing is left.
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
        self.n_in_picture += usize::from(self.list.end_polygon(self.painter.grid, self.item));
    }
}
