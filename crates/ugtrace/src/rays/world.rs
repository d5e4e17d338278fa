//! The bodies of a scene, ready for rays: a hierarchy of triangles in each rest frame.

use std::ops::{ControlFlow, Range};

use glam::DVec3;
use rayon::prelude::*;
use ugscene::{BodyId, Face, RestFrames, View};

use crate::outlines::{Outlines, RestFaces, Tiles};

use super::corridor::Corridor;
use super::moving_boxes::{MovingBoxes, Rays};
use super::part::{FaceTriangle, Faces, Intersection, Part};
use super::path::PastRay;
use super::world_line_part::Next;

/// Faces whose distances differ by no more than this part are at the same place: rounding decides
/// which of coplanar faces is nearer.
pub const SAME_PLACE: f64 = 1e-9;

/// The faces of a scene, by rest frame.
pub struct World {
    /// Bodies of the same velocity share a frame. Those on world lines come last, each by itself.
    pub parts: Vec<Part>,
    /// The number of parts that have a rest frame.
    n_inertial: usize,
    /// The plane of each face, see [`ugscene::shared_planes`].
    planes: Vec<u32>,
    /// The unit normal of each face on its outside, see [`Faces::outside`].
    pub outside: Vec<DVec3>,
    /// For each face, its part and the row of its first triangle there.
    triangles_of: Vec<[u32; 2]>,
    /// These parts by their moving boxes; `None` if they are few. Hits do not depend on it.
    pub boxes: Option<MovingBoxes>,
}

/// The greatest number of parts that are tested one by one.
const FEW_PARTS: usize = 4;

/// Memory of [`World::first`].
#[derive(Default)]
pub struct PacketMemory {
    directions: Vec<DVec3>,
    hits: Vec<Option<ugbvh::Hit>>,
    /// The rays that a part is tested with.
    rows: Vec<usize>,
}

impl World {
    /// Builds the hierarchies of the faces for which `is_traced` returns true. `planes`: the plane
    /// of each face, see [`ugscene::shared_planes`].
    pub fn new(
        faces: Faces<'_>,
        frames: &RestFrames,
        planes: Vec<u32>,
        is_traced: impl Fn(&Face) -> bool,
    ) -> Self {
        let scene = faces.scene;
        // Many scenes have thousands of bodies, few have that many velocities.
        let mut first_bodies: Vec<BodyId> = Vec::new();
        let part_of_body: Vec<usize> = scene
            .bodies
            .ids()
            .map(|body| {
                let is_inertial = |body: BodyId| frames.world_line(body).is_none();
                let same = |&first: &BodyId| {
                    let is_alike = frames.velocity(first) == frames.velocity(body);
                    is_alike && is_inertial(first) && is_inertial(body)
                };
                first_bodies.iter().position(same).unwrap_or_else(|| {
                    first_bodies.push(body);
                    first_bodies.len() - 1
                })
            })
            .collect();
        let mut rows: Vec<Vec<u32>> = vec![Vec::new(); first_bodies.len()];
        for (row, face) in scene.faces.iter().enumerate().filter(|(_, face)| is_traced(face)) {
            // Scenes have fewer than 2^32 faces.
            rows[part_of_body[face.body.index()]].push(row as u32);
        }
        let parts = first_bodies.into_iter().zip(rows).filter(|(_, rows)| !rows.is_empty());
        // A vertex is part of one body, and so of one part.
        let mut vertices = vec![u32::MAX; faces.rest.len()];
        let part = |(body, rows): (BodyId, Vec<u32>)| {
            Part::new(faces, *frames.of(body), frames.world_line(body), &rows, &mut vertices)
        };
        let (mut parts, on_world_lines): (Vec<Part>, Vec<Part>) =
            parts.map(part).partition(|part| part.motion.is_none());
        let n_inertial = parts.len();
        let boxes = || MovingBoxes::new(&parts.iter().map(Part::moving_box).collect::<Vec<_>>());
        let boxes = (n_inertial > FEW_PARTS).then(boxes);
        parts.extend(on_world_lines);
        let mut triangles_of = vec![[0; 2]; scene.faces.len()];
        for (part, Part { triangles, .. }) in parts.iter().enumerate() {
            for (row, triangle) in triangles.iter().enumerate().rev() {
                triangles_of[triangle.face as usize] = [part as u32, row as u32];
            }
        }
        let outside =
            (0..scene.faces.len() as u32).into_par_iter().map(|face| faces.outside(face)).collect();
        Self { parts, n_inertial, planes, outside, triangles_of, boxes }
    }

    /// All triangles, with the rows of their parts; of a round face one of its corners.
    pub fn triangles(&self) -> impl Iterator<Item = (usize, &FaceTriangle)> {
        let parts = self.parts.iter().enumerate();
        parts.flat_map(|(row, part)| part.triangles.iter().map(move |triangle| (row, triangle)))
    }

    /// The unit normal on the outside of an inertial face where a ray meets it, in the rest
    /// frame.
    #[inline]
    pub fn outside_at(&self, ray: &PastRay, found: &Intersection) -> DVec3 {
        let part = &self.parts[found.part];
        match part.round_surface(found, ray.in_part(found.part, &part.frame)) {
            Some((_, outside)) => outside,
            None => self.outside[found.triangle.face as usize],
        }
    }

    /// The latest event of the past at which light that follows the ray left a face, (P22), for
    /// parameters in a range.
    #[inline]
    pub fn closest(
        &self,
        faces: Faces<'_>,
        ray: &PastRay,
        range: Range<f64>,
    ) -> Option<Intersection> {
        let mut best: Option<Intersection> = None;
        let visit = |row: usize, best: &mut Option<Intersection>| {
            let part = &self.parts[row];
            let (origin, step) = ray.in_part(row, &part.frame);
            if !self.may_be_hit(part, origin, step) {
                return;
            }
            let end = end_before(*best, row, range.end);
            let found = part.closest(faces, row, origin, step, range.start..end.min(range.end));
            *best = found.or(*best);
        };
        match self.boxes_for(ray, &range) {
            None => (0..self.n_inertial).for_each(|row| visit(row, &mut best)),
            Some((boxes, rays)) => boxes.visit_nearest(&rays, ray.times(&range), |row| {
                visit(row, &mut best);
                -ray.step.t * best.map_or(range.end, |best| best.s)
            }),
        }
        best = self.before(faces, ray, range, best);
        best.map(|best| self.first_in_plane(faces, ray, best))
    }

    /// Of the faces that share the plane of `nearest` and that the ray meets there, the first in
    /// the scene.
    #[inline]
    fn first_in_plane(
        &self,
        faces: Faces<'_>,
        ray: &PastRay,
        nearest: Intersection,
    ) -> Intersection {
        let plane = |found: &Intersection| self.planes.get(found.triangle.face as usize).copied();
        if plane(&nearest).is_none_or(|plane| plane == 0) {
            return nearest;
        }
        let mut first = nearest;
        let width = SAME_PLACE * nearest.s.abs();
        let _ = self.visit(faces, ray, nearest.s - width..nearest.s + width, |found| {
            if found.triangle.face < first.triangle.face && plane(&found) == plane(&nearest) {
                first = found;
            }
            ControlFlow::Continue(())
        });
        first
    }

    /// The hierarchy of moving boxes, and a ray for it; `None` if all parts have to be tested.
    #[inline]
    fn boxes_for(&self, ray: &PastRay, range: &Range<f64>) -> Option<(&MovingBoxes, Rays)> {
        let boxes = self.boxes.as_ref().filter(|_| range.start >= 0.0)?;
        Some((boxes, Rays::from_step(ray.origin, ray.step)?))
    }

    /// The faces at the place of `first`, such as coplanar ones, in the order of the scene.
    pub fn coincident(
        &self,
        faces: Faces<'_>,
        ray: &PastRay,
        first: &Intersection,
        found: &mut Vec<Intersection>,
    ) {
        found.clear();
        let range = first.s * (1.0 - SAME_PLACE)..first.s * (1.0 + SAME_PLACE);
        let _ = self.visit(faces, ray, range, |other| {
            found.push(other);
            ControlFlow::Continue(())
        });
        found.sort_unstable_by_key(|other| (other.triangle.face, other.row));
        // Two triangles of a face meet at a diagonal.
        found.dedup_by_key(|other| other.triangle.face);
        if found.is_empty() {
            found.push(*first);
        }
    }

    /// The inertial faces as they are seen through a pinhole. `view`: has samples as its picture
    /// coordinates.
    pub fn outlines(
        &self,
        faces: Faces<'_>,
        frames: &RestFrames,
        view: &View,
        tiles: Tiles,
    ) -> Outlines {
        let Faces { scene, rest } = faces;
        let of = RestFaces { scene, rest, frames, planes: &self.planes };
        Outlines::new(of, view, tiles, |face| frames.world_line(face.body).is_none())
    }

    /// True if no body is on a world line.
    pub fn is_inertial(&self) -> bool {
        self.n_inertial == self.parts.len()
    }

    /// What each of several rays from the eye meets first, for parameters in a range. `seen`: the
    /// inertial face that a ray with a row meets first.
    pub fn first_behind(
        &self,
        faces: Faces<'_>,
        rays: &[PastRay],
        range: Range<f64>,
        seen: impl Fn(usize) -> Option<u32>,
        first: &mut Vec<Option<Intersection>>,
    ) {
        let mut last = None;
        for (row, ray) in rays.iter().enumerate() {
            let on_face = seen(row).and_then(|face| self.on_face(faces, ray, face, last));
            last = on_face.or(last);
            // Of inertial faces in one plane, outlines find the first.
            let found = self.before(faces, ray, range.clone(), on_face);
            first.push(match found {
                Some(found) if found.part >= self.n_inertial => {
                    Some(self.first_in_plane(faces, ray, found))
                }
                _ => found,
            });
        }
    }

    /// Where a ray from the eye meets the plane of a face that it runs through. `last`: a hit
    /// nearby.
    fn on_face(
        &self,
        faces: Faces<'_>,
        ray: &PastRay,
        face: u32,
        last: Option<Intersection>,
    ) -> Option<Intersection> {
        let [part, first] = self.triangles_of[face as usize];
        let Part { frame, triangles, .. } = &self.parts[part as usize];
        let step = frame.light_to_rest(ray.step.x);
        let (mut best, mut most) = (None, f64::NEG_INFINITY);
        let last = last.filter(|last| last.triangle.face == face).map(|last| last.row);
        let all = (first..)
            .take_while(|&row| triangles.get(row as usize).is_some_and(|it| it.face == face));
        for row in last.into_iter().chain(all) {
            let triangle = triangles[row as usize];
            let [a, b, c] = triangle.corners.map(|corner| faces.rest[corner.index()]);
            // The weights of corners are proportional to the products of the ray with the planes
            // through the eye and the opposite sides.
            let products =
                [(b, c), (c, a), (a, b)].map(|(from, to)| from.cross(to - from).dot(step));
            let part_of = 1.0 / (products[0] + products[1] + products[2]);
            let weights = products.map(|product| product * part_of);
            let least = weights[0].min(weights[1]).min(weights[2]);
            if least > most {
                let normal = (b - a).cross(c - a);
                (best, most) =
                    (Some((row, triangle, weights, a.dot(normal) / step.dot(normal))), least);
            }
            if least >= 0.0 {
                break;
            }
        }
        let (row, triangle, weights, s) = best?;
        // Rounding may place the ray outside all triangles.
        let weights = weights.map(|weight| weight.max(0.0));
        let [_, second, third] = weights.map(|weight| weight / weights.iter().sum::<f64>());
        let part = part as usize;
        s.is_finite().then_some(Intersection {
            part,
            s,
            own_time: 0.0,
            triangle,
            row,
            weights: [second, third],
        })
    }

    /// The nearer of a hit and those on bodies on world lines.
    fn before(
        &self,
        faces: Faces<'_>,
        ray: &PastRay,
        range: Range<f64>,
        mut best: Option<Intersection>,
    ) -> Option<Intersection> {
        for row in self.n_inertial..self.parts.len() {
            let range = range.start..best.map_or(range.end, |best| best.s);
            let mut nearest: Option<Intersection> = None;
            self.parts[row].visit_on_line(faces, row, ray, range, |found| {
                if nearest.is_none_or(|nearest| (found.s, found.row) < (nearest.s, nearest.row)) {
                    nearest = Some(found);
                }
                Next::Nearer
            });
            best = nearest.or(best);
        }
        best
    }

    /// [`World::closest`] for neighbouring rays from the eye, all at once. `first`: nothing at the
    /// beginning.
    pub fn first(
        &self,
        faces: Faces<'_>,
        rays: &[PastRay],
        range: Range<f64>,
        memory: &mut PacketMemory,
        first: &mut [Option<Intersection>],
    ) {
        let steps = rays.iter().map(|ray| ray.step.x);
        match self.boxes.as_ref().and_then(|boxes| Some((boxes, Rays::from_eye(steps)?))) {
            Some((boxes, bounds)) => boxes.visit_nearest(&bounds, 0.0..f64::INFINITY, |row| {
                self.first_of_part(faces, row, rays, range.clone(), memory, first);
                // The latest time at which light left what is seen so far.
                let time = |(ray, found): (&PastRay, &Option<Intersection>)| {
                    found.map_or(f64::INFINITY, |found| -ray.step.t * found.s)
                };
                rays.iter().zip(&*first).map(time).fold(0.0, f64::max)
            }),
            None => {
                for row in 0..self.n_inertial {
                    self.first_of_part(faces, row, rays, range.clone(), memory, first);
                }
            }
        }
        if self.n_inertial < self.parts.len() {
            for (ray, best) in rays.iter().zip(&mut *first) {
                *best = self.before(faces, ray, range.clone(), *best);
            }
        }
        if !self.planes.is_empty() {
            for (ray, best) in rays.iter().zip(first) {
                *best = best.map(|best| self.first_in_plane(faces, ray, best));
            }
        }
    }

    /// Replaces hits by nearer ones on a part.
    fn first_of_part(
        &self,
        faces: Faces<'_>,
        row: usize,
        rays: &[PastRay],
        range: Range<f64>,
        memory: &mut PacketMemory,
        first: &mut [Option<Intersection>],
    ) {
        let PacketMemory { directions, hits, rows } = memory;
        let part = &self.parts[row];
        let is_seen = |ray: &PastRay| {
            self.boxes.is_none() || part.outline.is_some_and(|outline| outline.is_seen(ray.step.x))
        };
        rows.clear();
        rows.extend((0..rays.len()).filter(|&idx| is_seen(&rays[idx])));
        if rows.is_empty() {
            return;
        }
        directions.clear();
        directions.extend(rows.iter().map(|&idx| part.frame.light_to_rest(rays[idx].step.x)));
        hits.clear();
        hits.resize(rows.len(), None);
        part.bvh.closest_packet(DVec3::ZERO, directions, range.clone(), hits);
        for ((&idx, hit), &step) in rows.iter().zip(&*hits).zip(&*directions) {
            let (Some(hit), best) = (*hit, &mut first[idx]) else { continue };
            let end = end_before(*best, row, range.end);
            if best.is_some() && hit.t >= end {
                continue;
            }
            let found = part.intersection(row, hit);
            *best = if !found.triangle.is_loose || part.is_inside(faces, &found) {
                Some(found)
            } else {
                part.closest(faces, row, DVec3::ZERO, step, found.s..end).or(*best)
            };
        }
        if part.rounds.len() == 0 {
            return;
        }
        for (&idx, &direction) in rows.iter().zip(&*directions) {
            let best = &mut first[idx];
            let end = end_before(*best, row, range.end);
            let ray = ugbvh::Ray { origin: DVec3::ZERO, direction };
            let found = part.closest_round(row, &ray, range.start..end);
            *best = found.or(*best);
        }
    }

    /// False if a ray in the rest frame of a part misses it.
    #[inline]
    fn may_be_hit(&self, part: &Part, origin: DVec3, step: DVec3) -> bool {
        self.boxes.is_none() || part.outline.is_some_and(|outline| outline.may_be_hit(origin, step))
    }

    /// Visits the faces that a ray crosses within a range, in any order, until `visit` breaks.
    pub fn visit(
        &self,
        faces: Faces<'_>,
        ray: &PastRay,
        range: Range<f64>,
        visit: impl FnMut(Intersection) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        self.visit_along(faces, ray, range, None, visit)
    }

    /// [`World::visit`] for one of several rays in a corridor, from its origin.
    pub fn visit_along(
        &self,
        faces: Faces<'_>,
        ray: &PastRay,
        range: Range<f64>,
        corridor: Option<&mut Corridor>,
        mut visit: impl FnMut(Intersection) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let visit_any = &mut visit;
        let mut visit = |row: usize| {
            let part = &self.parts[row];
            let (origin, step) = ray.in_part(row, &part.frame);
            if !self.may_be_hit(part, origin, step) {
                return ControlFlow::Continue(());
            }
            let ray = ugbvh::Ray { origin, direction: step };
            let range = part.range(step, range.clone());
            part.bvh.visit(&ray, range.clone(), |hit| {
                let found = part.intersection(row, hit);
                if found.triangle.is_loose && !part.is_inside(faces, &found) {
                    return ControlFlow::Continue(());
                }
                visit_any(found)
            })?;
            part.rounds
                .visit(&ray, range, |s, round| visit_any(part.round_intersection(row, s, round)))
        };
        let inertial = match self.boxes_for(ray, &range) {
            None => (0..self.n_inertial).try_for_each(&mut visit),
            Some((boxes, rays)) => {
                // In the order of rows, so that products of transmittances are the same.
                let times = ray.times(&range);
                if let Some(parts) =
                    corridor.and_then(|corridor| corridor.parts(boxes, &rays, times.end))
                {
                    parts.iter().copied().try_for_each(&mut visit)
                } else {
                    let mut parts = Vec::new();
                    boxes.find(&rays, times, &mut parts);
                    parts.into_iter().try_for_each(&mut visit)
                }
            }
        };
        inertial?;
        (self.n_inertial..self.parts.len()).try_for_each(|row| {
            let mut flow = ControlFlow::Continue(());
            self.parts[row].visit_on_line(faces, row, ray, range.clone(), |found| {
                if flow.is_continue() {
                    flow = visit_any(found);
                }
                if flow.is_continue() { Next::Everything } else { Next::Nothing }
            });
            flow
        })
    }
}

/// The end of the parameters of hits on the part in row `row` that replace `best`; `end` if there
/// is none. Ties go to the part with the lowest row, in whatever order they come.
#[inline]
fn end_before(best: Option<Intersection>, row: usize, end: f64) -> f64 {
    best.map_or(end, |best| if row < best.part { best.s.next_up() } else { best.s })
}
