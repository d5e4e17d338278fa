//! Whether an area is covered by others.

use super::convex::Convex;

/// An area that is cut into more parts than this counts as not covered.
const MOST_PARTS: usize = 64;

/// True if an area, given in parts, is covered completely by `covers`. `difference`: the part of
/// one area outside another.
pub fn is_covered<'a>(
    mut parts: Vec<Convex>,
    covers: impl Iterator<Item = &'a [Convex]>,
    difference: impl Fn(Convex, &Convex) -> Vec<Convex>,
) -> bool {
    for cover in covers {
        for other in cover {
            parts = parts.into_iter().flat_map(|part| difference(part, other)).collect();
        }
        if parts.is_empty() || parts.len() > MOST_PARTS {
            break;
        }
    }
    parts.is_empty()
}
