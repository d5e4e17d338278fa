//! Which patches are wholly hidden.

use super::patch::Patch;
use crate::planar::BoxIndex;
use crate::planar::Convex;

/// Most parts a patch is cut into to find out; with more it counts as seen.
const MOST_PARTS: usize = 64;

/// The patches without those that others hide wholly. What `is_seen` says is kept without more ado.
pub fn without_hidden(patches: Vec<Patch>, index: &BoxIndex, is_seen: &[bool]) -> Vec<Patch> {
    let is_kept = |patch: &Patch| is_seen[patch.item as usize] || !is_hidden(patch, &patches, index);
    let is_kept: Vec<bool> = patches.iter().map(is_kept).collect();
    patches.into_iter().zip(is_kept).filter_map(|(patch, is_kept)| is_kept.then_some(patch)).collect()
}

fn is_hidden(patch: &Patch, patches: &[Patch], index: &BoxIndex) -> bool {
    let mut rest = patch.parts.clone();
    for idx in index.in_box(patch.bounds()) {
        let other = &patches[idx];
        if other.item == patch.item || other.is_clear {
            continue;
        }
        for part in &other.parts {
            rest = rest.into_iter().flat_map(|own| shown(own, part)).collect();
        }
        if rest.is_empty() {
            return true;
        }
        if rest.len() > MOST_PARTS {
            return false;
        }
    }
    false
}

/// What of a part another does not hide; all of it if that is not nearer everywhere.
fn shown(own: Convex, other: &Convex) -> Vec<Convex> {
    let relation = other.relation(&own);
    if relation.is_before && !relation.is_behind { own.beside(other) } else { vec![own] }
}
