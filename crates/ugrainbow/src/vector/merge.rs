//! Merging of neighbouring areas of one colour.
//!
//! Bodies come in many faces, and most of a flat side has one colour. Two areas that share an edge
//! become one if they can be painted at once: if nothing of what is painted between them lies over
//! or under the one that is moved.

use std::collections::{HashMap, HashSet};

use ugimage::figure::{Point, Rgb, SnappedEdge, edges, snapped};

use super::transparency::PaintedArea;
use crate::planar::{BoxIndex, Convex, doubled_area};

/// Overlap in square pixels up to which areas count as disjoint.
const LEAST_OVERLAP: f64 = 0.005;

/// An area to paint.
#[derive(Clone, Debug)]
pub enum Paint {
    /// Outlines of an area of one colour; even-odd rule.
    Plain(Vec<Vec<Point>>, Rgb),
    Smooth(PaintedArea),
}

/// Areas in the order of painting, each with its colour if that is the same everywhere.
/// `size`: of the picture.
pub fn merged(areas: Vec<(PaintedArea, Option<Rgb>)>, size: [u32; 2]) -> Vec<Paint> {
    let mut groups = Groups::new(&areas, size);
    // For look-up only: its order has no influence.
    let mut with_edge: HashMap<(SnappedEdge, Rgb), Vec<usize>> = HashMap::new();
    for (number, (area, color)) in areas.iter().enumerate() {
        let Some(color) = *color else { continue };
        for edge in edges(&area.contours) {
            let [a, b] = snapped(edge);
            let others = with_edge.get(&([b, a], color));
            others.into_iter().flatten().for_each(|&other| groups.join(other, number));
            with_edge.entry(([a, b], color)).or_default().push(number);
        }
    }
    let Groups { members, place, .. } = groups;
    let mut painted: Vec<(usize, &Vec<usize>)> = members
        .iter()
        .zip(place)
        .filter(|(members, _)| !members.is_empty())
        .map(|(m, place)| (place, m))
        .collect();
    painted.sort_unstable_by_key(|(place, _)| *place);
    painted.into_iter().map(|(_, members)| paint(&areas, members)).collect()
}

fn paint(areas: &[(PaintedArea, Option<Rgb>)], members: &[usize]) -> Paint {
    match (&areas[members[0]], members) {
        ((area, None), _) => Paint::Smooth(area.clone()),
        ((area, Some(color)), [_]) => Paint::Plain(area.contours.clone(), *color),
        ((_, Some(color)), _) => {
            let all = members.iter().flat_map(|&member| edges(&areas[member].0.contours));
            Paint::Plain(outlines(all.map(snapped).collect()), *color)
        }
    }
}

/// Areas that are merged.
struct Groups<'a> {
    areas: &'a [(PaintedArea, Option<Rgb>)],
    index: BoxIndex,
    /// For each area, its group.
    group: Vec<usize>,
    /// For each group, its areas; empty after it was merged into another.
    members: Vec<Vec<usize>>,
    /// For each group, its position in the paint order.
    place: Vec<usize>,
    /// Pairs of groups that cannot be merged; only looked up.
    apart: HashSet<[usize; 2]>,
}

impl<'a> Groups<'a> {
    fn new(areas: &'a [(PaintedArea, Option<Rgb>)], size: [u32; 2]) -> Self {
        let index = BoxIndex::new(areas.iter().map(|(area, _)| Convex::bounds(&area.parts)), size);
        let numbers = 0..areas.len();
        Self {
            areas,
            index,
            group: numbers.clone().collect(),
            members: numbers.clone().map(|number| vec![number]).collect(),
            place: numbers.collect(),
            apart: HashSet::new(),
        }
    }

    /// Merges the groups of two areas, if possible.
    fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.group[a], self.group[b]);
        if a == b || !self.apart.insert([a.min(b), a.max(b)]) {
            return;
        }
        // The smaller group moves, if it can.
        let (small, large) =
            if self.members[a].len() < self.members[b].len() { (a, b) } else { (b, a) };
        let place = if self.can_move(small, self.place[large]) {
            self.place[large]
        } else if self.can_move(large, self.place[small]) {
            self.place[small]
        } else {
            return;
        };
        let moved = std::mem::take(&mut self.members[small]);
        moved.iter().for_each(|&member| self.group[member] = large);
        self.members[large].extend(moved);
        self.place[large] = place;
    }

    /// True if nothing painted between the place of a group and place `to` overlaps the group.
    fn can_move(&self, group: usize, to: usize) -> bool {
        let from = self.place[group];
        let way = from.min(to)..=from.max(to);
        self.members[group].iter().all(|&member| {
            let parts = &self.areas[member].0.parts;
            self.index.in_box(Convex::bounds(parts)).into_iter().all(|other| {
                let its = self.group[other];
                its == group
                    || !way.contains(&self.place[its])
                    || !overlap(parts, &self.areas[other].0.parts)
            })
        })
    }
}

fn overlap(some: &[Convex], others: &[Convex]) -> bool {
    let common = some.iter().flat_map(|one| others.iter().filter_map(|other| one.common(other)));
    common.map(|part| 0.5 * doubled_area(&part.corners)).sum::<f64>() > LEAST_OVERLAP
}

/// Outlines that consist of the edges that occur an odd number of times. By the even-odd rule it
/// makes no difference how edges are joined where more than two meet.
fn outlines(mut all: Vec<SnappedEdge>) -> Vec<Vec<Point>> {
    let ends = |[a, b]: &SnappedEdge| [*a.min(b), *a.max(b)];
    all.retain(|[a, b]| a != b);
    all.sort_unstable_by_key(ends);
    let of_one_place = all.chunk_by(|one, other| ends(one) == ends(other));
    let odd: Vec<SnappedEdge> =
        of_one_place.filter(|same| same.len() % 2 == 1).map(|same| same[0]).collect();
    let mut at_place: HashMap<[i64; 2], [Vec<usize>; 2]> = HashMap::new();
    for (idx, edge) in odd.iter().enumerate() {
        for end in [0, 1] {
            at_place.entry(edge[end]).or_default()[end].push(idx);
        }
    }
    let mut is_used = vec![false; odd.len()];
    let mut outlines = Vec::new();
    for first in 0..odd.len() {
        let mut outline = Vec::new();
        let mut place = odd[first][0];
        // Edges are followed forwards, and backwards only where outlines overlap.
        while !is_used[first] || place != odd[first][0] {
            let Some(edges) = at_place.get_mut(&place) else { break };
            let Some(next) = edges.iter_mut().find_map(|edges| unused(edges, &is_used)) else {
                break;
            };
            is_used[next] = true;
            outline.push(place.map(|hundredths| hundredths as f64 / 100.0));
            let [a, b] = odd[next];
            place = if a == place { b } else { a };
        }
        if !outline.is_empty() {
            outlines.push(outline);
        }
    }
    outlines
}

/// Takes edges from a list up to one that is not used.
fn unused(edges: &mut Vec<usize>, is_used: &[bool]) -> Option<usize> {
    std::iter::from_fn(|| edges.pop()).find(|&edge| !is_used[edge])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(left: f64, top: f64, color: u8) -> (PaintedArea, Option<Rgb>) {
        let [right, bottom] = [left + 1.0, top + 1.0];
        let corners =
            vec![[left, top, 1.0], [right, top, 1.0], [right, bottom, 1.0], [left, bottom, 1.0]];
        let part = Convex::new(corners).unwrap();
        (
            PaintedArea { layers: vec![0], contours: vec![part.outline()], parts: vec![part] },
            Some([color; 3]),
        )
    }

    /// Number of outlines and doubled area of each paint.
    fn shapes(areas: Vec<(PaintedArea, Option<Rgb>)>) -> Vec<(usize, f64)> {
        let area = |contours: &[Vec<Point>]| {
            let of = |contour: &Vec<Point>| {
                doubled_area(&contour.iter().map(|&[x, y]| [x, y, 0.0]).collect::<Vec<_>>())
            };
            contours.iter().map(of).map(f64::abs).sum()
        };
        let shape = |paint| match paint {
            Paint::Plain(contours, _) => (contours.len(), area(&contours)),
            Paint::Smooth(_) => (0, 0.0),
        };
        merged(areas, [10, 10]).into_iter().map(shape).collect()
    }

    #[test]
    fn neighbours_of_one_colour_become_one() {
        let row = || {
            vec![square(0.0, 0.0, 1), square(1.0, 0.0, 1), square(3.0, 0.0, 1), square(2.0, 0.0, 1)]
        };
        assert_eq!(shapes(row()), [(1, 8.0)]);
        // Neighbours of another colour, and some that touch only at a corner.
        let mut more = row();
        more.extend([square(0.0, 1.0, 2), square(4.0, 1.0, 1)]);
        assert_eq!(shapes(more), [(1, 8.0), (1, 2.0), (1, 2.0)]);
        // A ring has two outlines.
        let ring = (0..9)
            .filter(|idx| *idx != 4)
            .map(|idx| square(f64::from(idx % 3), f64::from(idx / 3), 1));
        let [(2, area)] = shapes(ring.collect())[..] else { panic!("one area with a hole") };
        assert_eq!(area, 18.0 + 2.0);
    }

    #[test]
    fn what_lies_between_keeps_areas_apart() {
        // The third square covers parts of both others, so nothing can move past it.
        let cover = || square(0.5, 0.0, 2);
        assert_eq!(shapes(vec![square(0.0, 0.0, 1), cover(), square(1.0, 0.0, 1)]).len(), 3);
        // Covers the first alone: the last is painted early, or the first stays below.
        let beside = square(0.0, 0.5, 2);
        assert_eq!(
            shapes(vec![square(0.0, 0.0, 1), beside, square(1.0, 0.0, 1)]),
            [(1, 4.0), (1, 2.0)]
        );
        // Overlapping areas cannot be merged under the even-odd rule.
        let over = square(0.0, 0.5, 1);
        assert_eq!(shapes(vec![square(0.0, 0.0, 1), over]).len(), 2);
    }
}
