//! Culling of patches that are completely occluded.

use super::patch::Patch;
use super::work::Work;
use crate::planar::{BoxIndex, Convex, is_covered};

/// Most work to find them, which took about two seconds. Beyond it patches are kept, which are
/// painted over.
const MOST_WORK: u64 = 1 << 26;

/// The patches without those that are completely occluded. Items that `is_seen` are known to be
/// visible.
pub fn without_hidden(patches: Vec<Patch>, index: &BoxIndex, is_seen: &[bool]) -> Vec<Patch> {
    let work = Work::new(MOST_WORK);
    let is_known = |patch: &Patch| is_seen[patch.item as usize] || work.is_exceeded();
    let is_kept = |patch: &Patch| is_known(patch) || !is_hidden(patch, &patches, index, &work);
    let is_kept: Vec<bool> = patches.iter().map(is_kept).collect();
    patches
        .into_iter()
        .zip(is_kept)
        .filter_map(|(patch, is_kept)| is_kept.then_some(patch))
        .collect()
}

fn is_hidden(patch: &Patch, patches: &[Patch], index: &BoxIndex, work: &Work) -> bool {
    let near = index.in_box(patch.bounds());
    work.count(near.len());
    let others = near.into_iter().map(|idx| &patches[idx]);
    let may_hide = |other: &&Patch| other.item < patch.item || !patch.is_in_plane_of(other);
    let others = others.filter(may_hide);
    let opaque = others.filter(|other| other.item != patch.item && !other.is_transparent);
    is_covered(patch.parts.clone(), opaque.map(|other| &other.parts[..]), |own, other| {
        work.count_pair(&own, other);
        shown(own, other)
    })
}

/// The part of `own` that is not occluded by `other`; all of it if that is not nearer everywhere.
fn shown(own: Convex, other: &Convex) -> Vec<Convex> {
    let relation = other.relation(&own);
    if relation.is_before && !relation.is_behind { own.difference(other) } else { vec![own] }
}
