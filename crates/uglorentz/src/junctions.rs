//! T-junctions: vertices of other faces on the edge of a face.
//!
//! At rest the edge and those of its neighbours are one line. As seen in motion each is an arc, and
//! light would pass between the arc of the whole edge and those of its parts. So the edge is
//! subdivided at these vertices first.

use glam::DVec3;
use rustc_hash::FxHashMap;
use ugscene::{BodyId, Face, Scene, VertexId};

use crate::relative_motion::{Point, RelativeMotion};

/// Distance from a line up to which a vertex counts as being on it, relative to its coordinates, and
/// from the end of an edge, relative to its length.
const SAME_PLACE: f64 = 1e-9;

/// Weights of the components of a direction and of the point of a line nearest to the eye in the
/// number by which lines are sorted.
const WEIGHTS: [DVec3; 2] = [
    DVec3::new(0.436_812_907_331, 0.617_203_411_907, 0.654_371_083_561),
    DVec3::new(0.754_877_666_247, 0.324_717_957_245, 0.569_840_290_998),
];

/// Difference of these numbers up to which lines are compared.
const CLOSE: f64 = 1e-8;

/// For edges of moving faces, by their ordered ends, the vertices on them, from the first end to the
/// second. `points`: those of the scene.
pub(crate) fn find(
    scene: &Scene,
    points: &[Point],
    motions: &[RelativeMotion],
) -> FxHashMap<(u32, u32), Vec<u32>> {
    let mut found = FxHashMap::default();
    let open = open_edges(scene, points, motions);
    let reach = open.iter().map(|&(a, _)| points[a as usize].rest.length()).fold(0.0, f64::max);
    let line = |ends: (u32, u32)| Line::new(points, ends, reach);
    let mut lines: Vec<Line> = open.into_iter().filter_map(line).collect();
    lines.sort_by(|a, b| a.number.total_cmp(&b.number).then(a.ends.cmp(&b.ends)));
    for close in lines.chunk_by(|a, b| b.number - a.number <= CLOSE).filter(|close| close.len() > 1)
    {
        let along = close[0].direction;
        let place = |row: u32| points[row as usize].rest.dot(along);
        let mut ends: Vec<(f64, u32)> = close
            .iter()
            .flat_map(|line| [line.ends.0, line.ends.1])
            .map(|row| (place(row), row))
            .collect();
        ends.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        for line in close {
            let (a, b) = line.ends;
            let (from, to) = (place(a), place(b));
            let margin = SAME_PLACE * (to - from).abs();
            let first = ends.partition_point(|end| end.0 <= from.min(to) + margin);
            let inside = ends[first..].iter().take_while(|end| end.0 < from.max(to) - margin);
            let mut inside: Vec<(f64, u32)> =
                inside.copied().filter(|&(_, row)| line.has(points, motions, row)).collect();
            inside.dedup_by(|next, last| next.0 - last.0 <= margin);
            if from > to {
                inside.reverse();
            }
            if !inside.is_empty() {
                found.insert((a, b), inside.into_iter().map(|(_, row)| row).collect());
            }
        }
    }
    found
}

/// The edge of a face and the line it is part of.
struct Line {
    ends: (u32, u32),
    /// The same for both directions of an edge.
    direction: DVec3,
    number: f64,
}

impl Line {
    /// `None` if both ends are at the same place.
    fn new(points: &[Point], ends: (u32, u32), reach: f64) -> Option<Line> {
        let [a, b] = [ends.0, ends.1].map(|row| points[row as usize].rest);
        let direction = (b - a).try_normalize()?;
        let direction = if direction.dot(WEIGHTS[0]) < 0.0 { -direction } else { direction };
        let nearest = a - direction * a.dot(direction);
        let number = direction.dot(WEIGHTS[0]) + nearest.dot(WEIGHTS[1]) / reach;
        (!number.is_nan()).then_some(Line { ends, direction, number })
    }

    /// True if a vertex is on the line and moves with it.
    fn has(&self, points: &[Point], motions: &[RelativeMotion], row: u32) -> bool {
        let [start, point] = [self.ends.0, row].map(|row| &points[row as usize]);
        let way = point.rest - start.rest;
        let distance = (way - self.direction * way.dot(self.direction)).length();
        let motion = |body: BodyId| {
            let motion = &motions[body.index()];
            (motion.velocity(), motion.world_line())
        };
        distance <= SAME_PLACE * point.rest.length() && motion(start.body) == motion(point.body)
    }
}

/// The edges of moving faces, each once, by their ordered ends, that have a face on one side only.
fn open_edges(scene: &Scene, points: &[Point], motions: &[RelativeMotion]) -> Vec<(u32, u32)> {
    if motions.iter().all(RelativeMotion::is_at_rest) {
        return Vec::new();
    }
    let is_moving: Vec<bool> = motions.iter().map(|motion| !motion.is_at_rest()).collect();
    let contours = || {
        let moves = |face: &&Face| is_moving[face.body.index()];
        let rows = scene.faces.iter().filter(moves).flat_map(|face| face.contours.clone());
        rows.map(|row| scene.contours.get(row))
    };
    // For each vertex a sum over its edges in which both directions of an edge cancel. It takes less
    // time than a table of all edges.
    let mut sums = vec![0_u64; points.len()];
    let hash = |row: u32| {
        let hash = (u64::from(row) + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        (hash ^ hash >> 29).wrapping_mul(0xbf58_476d_1ce4_e5b9)
    };
    for contour in contours() {
        let &[.., a, b] = contour else { continue };
        let (mut last, mut before, mut own) = (b.0, hash(a.0), hash(b.0));
        for corner in contour {
            let next = hash(corner.0);
            let sum = &mut sums[last as usize];
            *sum = sum.wrapping_add(next).wrapping_sub(before);
            (last, before, own) = (corner.0, own, next);
        }
    }
    let mut n_faces: FxHashMap<(u32, u32), u32> = FxHashMap::default();
    for contour in contours() {
        let Some(&VertexId(mut last)) = contour.last() else { continue };
        for &VertexId(corner) in contour {
            if sums[last as usize] != 0 && sums[corner as usize] != 0 {
                *n_faces.entry((last.min(corner), last.max(corner))).or_default() += 1;
            }
            last = corner;
        }
    }
    // The order of the table does not matter, since lines are sorted.
    n_faces.into_iter().filter(|(_, n_faces)| *n_faces == 1).map(|(ends, _)| ends).collect()
}
