//! The faces of bodies with one rest frame, or of one body on a world line, as a hierarchy of
//! triangles.

use std::ops::{ControlFlow, Range};
use std::sync::Arc;

use glam::DVec3;
use rayon::prelude::*;
use ugbvh::Bvh;
use ugphysics::{RestFrame, WorldLine};
use ugscene::{Face, Scene, VertexId, face_edges, unit_normal};

use super::moving_boxes::MovingBox;
use super::path::{PastRay, Start};
use super::rounds::Rounds;
use super::sphere::Outline;
use super::world_line_part::{CurveHit, Next, WorldLineMotion};

/// How far a ray leaves a surface before it can meet another one, relative to the largest
/// coordinate. Rounding errors are below a hundredth of it.
const CLEARANCE: f64 = 1e-10;

/// The faces of all bodies with one velocity, or of one body on a world line.
pub struct Part {
    /// Their rest frame; of a body on a world line, that at its own time 0.
    pub frame: RestFrame,
    /// The motion of a body on a world line.
    pub motion: Option<WorldLineMotion>,
    pub(super) bvh: Bvh,
    pub(super) triangles: Vec<FaceTriangle>,
    /// Round faces. Triangles of their corners are the last ones.
    pub(super) rounds: Rounds,
    bounds: Option<(DVec3, DVec3)>,
    pub(super) clearance: f64,
    /// `None` if there are no faces.
    pub(super) outline: Option<Outline>,
}

/// A triangle of a face.
#[derive(Clone, Copy, Debug)]
pub struct FaceTriangle {
    /// Row of the face.
    pub face: u32,
    /// Its corners are corners of the face.
    pub corners: [VertexId; 3],
    /// The face intersects itself, so a triangle may extend beyond it.
    pub(super) is_loose: bool,
}

/// The faces of a scene at rest.
#[derive(Clone, Copy)]
pub struct Faces<'a> {
    /// The scene, each of whose vertices is part of one body.
    pub scene: &'a Scene,
    /// The rest position of each vertex relative to the eye, in the axes of the scene.
    pub rest: &'a [DVec3],
}

impl Faces<'_> {
    /// The unit normal of a face on its outside, from which its outline runs counterclockwise.
    pub fn outside(&self, face: u32) -> DVec3 {
        let contour = self.scene.face_contours(&self.scene.faces[face as usize]).next();
        unit_normal(contour.unwrap_or_default().iter().map(|corner| self.rest[corner.index()]))
    }
}

/// Where a ray meets a face.
#[derive(Clone, Copy, Debug)]
pub struct Intersection {
    /// Row of the part.
    pub part: usize,
    /// The parameter of the ray: the hit is at its origin plus this times its step, in every frame.
    pub s: f64,
    /// The own time of a body on a world line; 0 for others.
    pub own_time: f64,
    /// The triangle of the face; of a round face, one of three of its corners.
    pub triangle: FaceTriangle,
    /// Its row in the part.
    pub(super) row: u32,
    /// Barycentric weights of its second and third corner.
    pub(super) weights: [f64; 2],
}

impl Intersection {
    /// Barycentric weights of the corners of the triangle; of a round face, those of its first
    /// corner.
    #[inline]
    pub fn weights(&self) -> [f64; 3] {
        let [second, third] = self.weights;
        [1.0 - second - third, second, third]
    }
}

impl Part {
    pub(super) fn new(
        Faces { scene, rest }: Faces<'_>,
        frame: RestFrame,
        line: Option<&Arc<WorldLine>>,
        rows: &[u32],
        known: &mut [u32],
    ) -> Self {
        let is_round = |row: &u32| scene.faces[*row as usize].shape.is_round();
        let (round_rows, rows): (Vec<u32>, Vec<u32>) = rows.iter().partition(|row| is_round(row));
        let triangle = |&row: &u32| whole_triangle(scene, row);
        let cut = |&row: &u32| face_triangles(scene, rest, row);
        let triangles: Option<Vec<FaceTriangle>> = rows.par_iter().map(triangle).collect();
        let mut triangles =
            triangles.unwrap_or_else(|| rows.par_iter().flat_map_iter(cut).collect());
        let (places, corners) = vertices(&triangles, rest, known);
        let bvh = Bvh::new(&places, &corners);
        let round = |row: u32| {
            let face = &scene.faces[row as usize];
            let shape = scene.round_shape(face, |vertex| rest[vertex.index()])?;
            let corners = *scene.face_corners(face).first_chunk()?;
            Some((FaceTriangle { face: row, corners, is_loose: false }, shape))
        };
        let (corners_of_rounds, shapes): (Vec<_>, _) =
            round_rows.into_iter().filter_map(round).unzip();
        triangles.extend(corners_of_rounds);
        let rounds = Rounds::new(shapes);
        let join = |(a, b): (DVec3, DVec3), (c, d): (DVec3, DVec3)| (a.min(c), b.max(d));
        let bounds = bvh.bounds().into_iter().chain(rounds.bounds()).reduce(join);
        let reach = bounds.map_or(0.0, |(low, high)| low.abs().max(high.abs()).max_element());
        let outline = bounds.map(|bounds| Outline::new(bounds, &frame));
        let motion = line.and_then(|line| WorldLineMotion::new(line, &bvh, &places, &corners));
        Self {
            frame,
            motion,
            bvh,
            triangles,
            rounds,
            bounds,
            clearance: CLEARANCE * reach,
            outline,
        }
    }

    /// Visits the faces of a body on a world line that a ray crosses, in any order. `visit` returns
    /// which hits are wanted after one.
    pub(super) fn visit_on_line(
        &self,
        faces: Faces<'_>,
        row: usize,
        ray: &PastRay,
        range: Range<f64>,
        mut visit: impl FnMut(Intersection) -> Next,
    ) {
        let Some(motion) = &self.motion else { return };
        // The own time in which the ray leaves the surface at its origin.
        let mut clearance = self.clearance;
        if let Start::Surface { .. } = ray.start {
            let reach = ray.origin.x.length() - ray.origin.t;
            clearance += CLEARANCE * self.frame.velocity().gamma() * reach;
        }
        motion.visit(&self.bvh, ray, range, clearance, |CurveHit { s, own_time, hit }| {
            let found = Intersection { s, own_time, ..self.intersection(row, hit) };
            let is_hit = !found.triangle.is_loose || self.is_inside(faces, &found);
            if is_hit { visit(found) } else { Next::Everything }
        });
    }

    /// True if a straight way at rest crosses a face for which `blocks` holds.
    pub fn crosses(&self, from: DVec3, to: DVec3, blocks: impl Fn(u32) -> bool) -> bool {
        let ray = ugbvh::Ray { origin: from, direction: to - from };
        let visit = |row: usize| match blocks(self.triangles[row].face) {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        };
        let on_round = |_, row: u32| visit(self.first_round() + row as usize);
        self.bvh.visit(&ray, 0.0..1.0, |hit| visit(hit.triangle as usize)).is_break()
            || self.rounds.visit(&ray, 0.0..1.0, on_round).is_break()
    }

    /// The row of the triangle of the first round face.
    fn first_round(&self) -> usize {
        self.triangles.len() - self.rounds.len()
    }

    /// The place where a ray meets a round face, and the unit normal on the outside there, in the
    /// rest frame; `None` for polygons. `ray`: origin and step.
    #[inline]
    pub fn round_surface(
        &self,
        found: &Intersection,
        (origin, step): (DVec3, DVec3),
    ) -> Option<(DVec3, DVec3)> {
        let row = (found.row as usize).checked_sub(self.first_round())?;
        Some(self.rounds.surface(row, origin + found.s * step))
    }

    /// The least and greatest coordinates of each triangle or round face, in the rest frame, with
    /// the row of the face. `place`: of a corner.
    pub fn boxes(
        &self,
        place: impl Fn(VertexId) -> DVec3,
    ) -> impl Iterator<Item = (u32, [DVec3; 2])> {
        let first_round = self.first_round();
        self.triangles.iter().enumerate().map(move |(row, triangle)| {
            let [a, b, c] = triangle.corners.map(&place);
            let of_triangle = || [a.min(b).min(c), a.max(b).max(c)];
            let round = row.checked_sub(first_round).map(|row| self.rounds.bounds_of(row));
            (triangle.face, round.unwrap_or_else(of_triangle))
        })
    }

    /// The box around the part, in the frame of the camera.
    pub(super) fn moving_box(&self) -> MovingBox {
        let Some((low, high)) = self.bounds else { return MovingBox::EMPTY };
        let corner = |idx: usize| {
            let at = |axis: usize| if idx >> axis & 1 == 0 { low[axis] } else { high[axis] };
            self.frame.contracted(DVec3::new(at(0), at(1), at(2)))
        };
        let reach = low.abs().max(high.abs()).max_element();
        let size = (high - low).max_element();
        let corners = std::array::from_fn(corner);
        MovingBox::new(
            corners,
            self.frame.velocity().beta(),
            self.frame.velocity().gamma(),
            size,
            reach,
        )
    }

    /// The range of parameters that begins outside the surface at the ray's origin.
    pub(super) fn range(&self, step: DVec3, range: Range<f64>) -> Range<f64> {
        range.start.max(self.clearance / ugphysics::length(step))..range.end
    }

    pub(super) fn closest(
        &self,
        faces: Faces<'_>,
        row: usize,
        origin: DVec3,
        step: DVec3,
        range: Range<f64>,
    ) -> Option<Intersection> {
        let ray = ugbvh::Ray { origin, direction: step };
        let range = self.range(step, range);
        let flat = self.closest_flat(faces, row, &ray, range.clone());
        self.closest_round(row, &ray, range.start..flat.map_or(range.end, |flat| flat.s)).or(flat)
    }

    #[inline(always)]
    fn closest_flat(
        &self,
        faces: Faces<'_>,
        row: usize,
        ray: &ugbvh::Ray,
        mut range: Range<f64>,
    ) -> Option<Intersection> {
        loop {
            let found = self.intersection(row, self.bvh.closest(ray, range.clone())?);
            if !found.triangle.is_loose || self.is_inside(faces, &found) {
                return Some(found);
            }
            range.start = found.s;
        }
    }

    #[inline]
    pub(super) fn closest_round(
        &self,
        part: usize,
        ray: &ugbvh::Ray,
        range: Range<f64>,
    ) -> Option<Intersection> {
        let (s, row) = self.rounds.closest(ray, range)?;
        Some(self.round_intersection(part, s, row))
    }

    pub(super) fn round_intersection(&self, part: usize, s: f64, row: u32) -> Intersection {
        // Scenes have fewer than 2^32 faces.
        let row = self.first_round() as u32 + row;
        self.intersection(part, ugbvh::Hit { t: s, triangle: row, u: 0.0, v: 0.0 })
    }

    pub(super) fn intersection(&self, part: usize, hit: ugbvh::Hit) -> Intersection {
        let triangle = self.triangles[hit.triangle as usize];
        Intersection {
            part,
            s: hit.t,
            own_time: 0.0,
            triangle,
            row: hit.triangle,
            weights: [hit.u, hit.v],
        }
    }

    /// The even-odd rule at a point of a face.
    pub(super) fn is_inside(&self, Faces { scene, rest }: Faces<'_>, found: &Intersection) -> bool {
        let face = &scene.faces[found.triangle.face as usize];
        let [a, b, c] = found.triangle.corners.map(|corner| rest[corner.index()]);
        let [wa, wb, wc] = found.weights();
        let point = wa * a + wb * b + wc * c;
        // The coordinates that are kept are those of the plane of projection with the largest area.
        let normal = (b - a).cross(c - a).abs();
        let flat = |p: DVec3| match normal {
            n if n.x >= n.y && n.x >= n.z => [p.y, p.z],
            n if n.y >= n.z => [p.z, p.x],
            _ => [p.x, p.y],
        };
        let [x, y] = flat(point);
        let mut is_inside = false;
        for [from, to] in
            face_edges(scene, face).map(|edge| edge.map(|end| flat(rest[end.index()])))
        {
            if (from[1] > y) != (to[1] > y)
                && x < from[0] + (y - from[1]) / (to[1] - from[1]) * (to[0] - from[0])
            {
                is_inside = !is_inside;
            }
        }
        is_inside
    }
}

/// The places of the vertices of some triangles alone, and the rows of their corners among them.
/// `rows`: for each vertex of the scene, its row in its part, as far as it is known, else
/// `u32::MAX`.
fn vertices(
    triangles: &[FaceTriangle],
    rest: &[DVec3],
    rows: &mut [u32],
) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let mut places = Vec::new();
    let mut row = |corner: VertexId| {
        let row = &mut rows[corner.index()];
        if *row == u32::MAX {
            // Scenes have fewer than 2^32 vertices.
            *row = places.len() as u32;
            places.push(rest[corner.index()]);
        }
        *row
    };
    let corners = triangles.iter().map(|triangle| triangle.corners.map(&mut row)).collect();
    (places, corners)
}

/// A face with three corners, which need not be cut.
fn whole_triangle(scene: &Scene, row: u32) -> Option<FaceTriangle> {
    let &[a, b, c] = scene.contours.corners(scene.faces[row as usize].contours.clone()) else {
        return None;
    };
    Some(FaceTriangle { face: row, corners: [a, b, c], is_loose: false })
}

/// The triangles of a face. One that intersects itself gets a fan from its first corner: it covers
/// each point of the face an odd number of times.
fn face_triangles(scene: &Scene, rest: &[DVec3], row: u32) -> Vec<FaceTriangle> {
    if let Some(whole) = whole_triangle(scene, row) {
        return vec![whole];
    }
    let face: &Face = &scene.faces[row as usize];
    let corners = scene.face_corners(face);
    let triangle = |at: [u32; 3], is_loose| FaceTriangle {
        face: row,
        corners: at.map(|at| corners[at as usize]),
        is_loose,
    };
    match ugpolygon::face_triangles(scene, face, |vertex| rest[vertex.index()]) {
        Some(triangles) => triangles.into_iter().map(|at| triangle(at, false)).collect(),
        // The sides of every contour, each with the first corner.
        None => {
            let mut first = 0;
            let mut all = Vec::with_capacity(corners.len());
            for contour in scene.face_contours(face) {
                let n = contour.len() as u32;
                all.extend(
                    (0..n).map(|side| triangle([0, first + side, first + (side + 1) % n], true)),
                );
                first += n;
            }
            all
        }
    }
}
