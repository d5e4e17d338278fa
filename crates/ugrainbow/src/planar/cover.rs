//! Whether an area is covered by others.

use super::convex::Convex;

/// Most parts that an area is cut into; with more it counts as not covered.
const MOST_PARTS: usize = 64;

/// True if nothing is left of an area, given in parts, when each of `covers` is taken away.
/// `difference`: what is left of a part beside one of another area.
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
