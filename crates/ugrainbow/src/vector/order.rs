//! The order of painting, from back to front.
//!
//! For each two polygons that overlap in the picture, it is decided which is in front. If these
//! relations have no cycle they define an order. Polygons in a cycle, such as two that intersect,
//! are cut along each other's planes until there is none (binary space partition, Fuchs, Kedem and
//! Naylor 1980). In picture coordinates with the depth key everything flat is a plane, and the eye
//! is above all of them, so what lies below is painted first.

use super::patch::Patch;
use super::work::Work;
use crate::error::Error;
use crate::planar::{BoxIndex, Convex, DepthOrder};

/// Most work for the order, which took about five seconds.
pub const MOST_WORK: u64 = 1 << 27;

/// A patch or a part of one.
#[derive(Clone, Debug)]
pub enum Piece {
    /// A whole patch.
    Whole(usize),
    /// A convex part of one.
    Part(usize, Convex),
}

/// Splitting planes tried at each step; the one that cuts least is taken.
const CANDIDATES: usize = 8;

/// All patches, or their parts, from the farthest to the nearest.
///
/// # Errors
/// They overlap so often that the work exceeds its limit.
pub fn painting_order(
    patches: &[Patch],
    index: &BoxIndex,
    work: &Work,
) -> Result<Vec<Piece>, Error> {
    let behind = relations(patches, index, work);
    let mut pieces = Vec::new();
    for group in strong_components(&behind) {
        match group[..] {
            [patch] => pieces.push(Piece::Whole(patch)),
            _ => partition(patches, &group, &mut pieces, work),
        }
        if work.is_exceeded() {
            return Err(Error::FigureFaces);
        }
    }
    Ok(pieces)
}

/// For each patch, those that it occludes in part. Incomplete if the work exceeds its limit.
fn relations(patches: &[Patch], index: &BoxIndex, work: &Work) -> Vec<Vec<usize>> {
    let mut behind = vec![Vec::new(); patches.len()];
    for (first, patch) in patches.iter().enumerate() {
        let near = index.in_box(patch.bounds());
        work.count(near.len());
        for second in near.into_iter().filter(|&second| second > first) {
            if work.is_exceeded() {
                return behind;
            }
            let relation = relation(patch, &patches[second], work);
            // At equal depth the first is visible, as in the rasterizer; opaque patches precede
            // transparent ones.
            let is_tie = relation.is_level && !relation.is_behind;
            if relation.is_before || is_tie {
                behind[first].push(second);
            }
            if relation.is_behind {
                behind[second].push(first);
            }
        }
    }
    behind
}

fn relation(first: &Patch, second: &Patch, work: &Work) -> DepthOrder {
    let pairs = first.parts.iter().flat_map(|a| second.parts.iter().map(move |b| (a, b)));
    let relations = pairs.map(|(a, b)| {
        work.count_pair(a, b);
        a.relation(b)
    });
    let relation = relations.fold(DepthOrder::default(), |all, one| DepthOrder {
        is_before: all.is_before || one.is_before,
        is_behind: all.is_behind || one.is_behind,
        is_level: all.is_level || one.is_level,
    });
    if relation == DepthOrder::default() || !first.is_in_plane_of(second) {
        return relation;
    }
    let is_before = first.item < second.item;
    DepthOrder { is_before, is_behind: !is_before, is_level: false }
}

/// Tarjan's strongly connected components (1972); a component follows all components that its edges
/// lead to.
fn strong_components(leads_to: &[Vec<usize>]) -> Vec<Vec<usize>> {
    const NEW: usize = usize::MAX;
    let n = leads_to.len();
    let (mut number, mut lowest, mut is_open) = (vec![NEW; n], vec![0; n], vec![false; n]);
    let (mut open, mut components, mut n_numbered) = (Vec::new(), Vec::new(), 0);
    for root in 0..n {
        if number[root] != NEW {
            continue;
        }
        // The path from the root, each node with the number of edges already followed.
        let mut way = vec![(root, 0)];
        while let Some((node, edge)) = way.last_mut() {
            let node = *node;
            if *edge == 0 {
                (number[node], lowest[node], is_open[node]) = (n_numbered, n_numbered, true);
                n_numbered += 1;
                open.push(node);
            }
            if let Some(&next) = leads_to[node].get(*edge) {
                *edge += 1;
                if number[next] == NEW {
                    way.push((next, 0));
                } else if is_open[next] {
                    lowest[node] = lowest[node].min(number[next]);
                }
                continue;
            }
            way.pop();
            if let Some(&(before, _)) = way.last() {
                lowest[before] = lowest[before].min(lowest[node]);
            }
            if lowest[node] == number[node] {
                let start = open.iter().rposition(|&other| other == node).unwrap_or(0);
                let component = open.split_off(start);
                component.iter().for_each(|&member| is_open[member] = false);
                components.push(component);
            }
        }
    }
    components
}

/// A step of the partition.
enum Step {
    Divide(Vec<(usize, Convex)>),
    Paint(Vec<(usize, Convex)>),
}

/// Paints the parts of these patches from back to front, cut where needed. Incomplete if the work
/// exceeds its limit.
fn partition(patches: &[Patch], group: &[usize], pieces: &mut Vec<Piece>, work: &Work) {
    let mut group = group.to_vec();
    group.sort_unstable();
    let parts = group
        .iter()
        .flat_map(|&idx| patches[idx].parts.iter().map(move |part| (idx, part.clone())));
    let mut steps = vec![Step::Divide(parts.collect())];
    while let Some(step) = steps.pop() {
        if work.is_exceeded() {
            return;
        }
        match step {
            Step::Paint(mut parts) => {
                // At equal depth the first is to be visible, so it is painted last; opaque patches
                // at the very end.
                parts.sort_by_key(|(idx, _)| {
                    std::cmp::Reverse((patches[*idx].is_transparent, patches[*idx].item))
                });
                pieces.extend(parts.into_iter().map(|(idx, part)| Piece::Part(idx, part)));
            }
            Step::Divide(parts) if parts.len() < 2 => steps.push(Step::Paint(parts)),
            Step::Divide(parts) => {
                let n_corners: usize = parts.iter().map(|(_, part)| part.corners.len()).sum();
                work.count((CANDIDATES + 1) * n_corners);
                let [behind, on, before] = divide(patches, parts);
                steps.extend([Step::Divide(before), Step::Paint(on), Step::Divide(behind)]);
            }
        }
    }
}

/// The parts behind, in and in front of the plane of one of them, the splitter, which is in its own
/// plane, as are parts of faces that share it.
fn divide(patches: &[Patch], parts: Vec<(usize, Convex)>) -> [Vec<(usize, Convex)>; 3] {
    let stride = parts.len().div_ceil(CANDIDATES);
    let side_of = |(splitter, plane): &(usize, Convex), (idx, part): &(usize, Convex)| {
        if patches[*splitter].is_in_plane_of(&patches[*idx]) {
            Some(0)
        } else {
            plane.side_of(part)
        }
    };
    let cuts = |plane: &_| parts.iter().filter(|part| side_of(plane, part).is_none()).count();
    let splitter =
        (0..parts.len()).step_by(stride).min_by_key(|&idx| cuts(&parts[idx])).unwrap_or(0);
    let plane = parts[splitter].clone();
    let [mut behind, mut on, mut before] = [const { Vec::new() }; 3];
    for (number, part) in parts.into_iter().enumerate() {
        // The splitter is in its own plane, whatever rounding says, so the recursion ends.
        let side = if number == splitter { Some(0) } else { side_of(&plane, &part) };
        let (idx, part) = part;
        match side {
            Some(0) => on.push((idx, part)),
            Some(1) => before.push((idx, part)),
            Some(_) => behind.push((idx, part)),
            None => {
                let [far, near] = plane.1.split(&part);
                behind.extend(far.map(|part| (idx, part)));
                before.extend(near.map(|part| (idx, part)));
            }
        }
    }
    [behind, on, before]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn components_come_after_what_they_lead_to() {
        // 0 → 1 ⇄ 2 → 3, and 4 alone.
        let edges = vec![vec![1], vec![2], vec![1, 3], vec![], vec![]];
        assert_eq!(strong_components(&edges), [vec![3], vec![1, 2], vec![0], vec![4]]);
        assert_eq!(strong_components(&[vec![0]]), [vec![0]]);
    }

    #[test]
    fn polygons_that_cut_each_other_are_cut() {
        let at = |corners: [[f64; 3]; 4]| Convex::new(corners.to_vec()).unwrap();
        let flat = at([[0.0, 0.0, 1.0], [4.0, 0.0, 1.0], [4.0, 4.0, 1.0], [0.0, 4.0, 1.0]]);
        let steep = at([[0.0, 0.0, 0.5], [4.0, 0.0, 1.5], [4.0, 4.0, 1.5], [0.0, 4.0, 0.5]]);
        let relation = flat.relation(&steep);
        assert!(relation.is_before && relation.is_behind);
        let patch = |item| {
            let corner = |x, y| ugraster::Corner { x, y, key: 1.0, values: [0.0; 8] };
            let contour = vec![corner(0.0, 0.0), corner(4.0, 0.0), corner(4.0, 4.0)];
            Patch::new(item, false, vec![contour], [4, 4], false, &mut 0).unwrap().unwrap()
        };
        let [behind, on, before] = divide(&[patch(0), patch(1)], vec![(0, flat), (1, steep)]);
        assert_eq!((behind[0].0, on[0].0, before[0].0), (1, 0, 1));
        assert_eq!((behind[0].1.low, behind[0].1.high), ([0.0, 0.0], [2.0, 4.0]));
        assert_eq!((before[0].1.low, before[0].1.high), ([2.0, 0.0], [4.0, 4.0]));
    }
}
