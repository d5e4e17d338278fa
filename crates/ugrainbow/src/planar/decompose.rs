//! Polygons in the picture plane cut to the picture, and into convex flat parts.

use std::collections::BTreeMap;

use ugpicture::DepthPoint;

use super::convex::{Convex, clip, doubled_area, sides};

/// Most parts, beyond those for each corner, of all faces whose edges cross each other: about 40
/// MB.
pub const MOST_CROSSED_PARTS: usize = 1 << 17;

/// Clips a contour to the picture and a `margin` around it.
pub fn clipped_to_picture(
    mut contour: Vec<DepthPoint>,
    size: [u32; 2],
    margin: f64,
) -> Vec<DepthPoint> {
    for axis in 0..2 {
        let end = f64::from(size[axis]) + margin;
        if contour.iter().any(|place| place[axis] < -margin) {
            contour = clip(&contour, |place| place[axis] + margin);
        }
        if contour.iter().any(|place| place[axis] > end) {
            contour = clip(&contour, |place| end - place[axis]);
        }
    }
    contour
}

/// Decomposes a polygon into convex parts, each of them planar in depth. Of a polygon whose edges
/// cross each other there may be as many as the square of the number of its corners: `room` is how
/// many more than three for each corner there may be, from which these are taken. `None` if there
/// is not enough.
pub fn convex_parts(outline: &[Vec<DepthPoint>], room: &mut usize) -> Option<Vec<Convex>> {
    if let [contour] = outline
        && is_convex(contour)
    {
        return Some(flat_parts(contour.clone()));
    }
    let n_corners: usize = outline.iter().map(Vec::len).sum();
    let trapezoids = trapezoids(outline, *room + 3 * n_corners)?;
    *room -= trapezoids.len().saturating_sub(3 * n_corners);
    Some(trapezoids.into_iter().flat_map(flat_parts).collect())
}

/// A convex polygon itself if it is planar in depth, otherwise a fan of triangles.
fn flat_parts(corners: Vec<DepthPoint>) -> Vec<Convex> {
    let Some(whole) = Convex::new(corners) else { return Vec::new() };
    if whole.is_flat() {
        return vec![whole];
    }
    let first = whole.corners[0];
    whole.corners[1..]
        .windows(2)
        .filter_map(|pair| Convex::new(vec![first, pair[0], pair[1]]))
        .collect()
}

/// True if the outline turns in one direction only, and winds once.
fn is_convex(contour: &[DepthPoint]) -> bool {
    let n = contour.len();
    let direction = doubled_area(contour).signum();
    let turns_back = (0..n).any(|idx| {
        let [a, b, c] = [0, 1, 2].map(|step| contour[(idx + step) % n]);
        ((b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0])) * direction < 0.0
    });
    // A star turns in one direction as well, but has more than one topmost corner.
    let n_tops = sides(contour)
        .zip(sides(contour).skip(1).chain(sides(contour).take(1)))
        .filter(|((a, b), (_, c))| a[1] < b[1] && c[1] <= b[1])
        .count();
    !turns_back && n_tops <= 1
}

/// Cuts a polygon along the rows of its corners into trapezoids, by the even-odd rule. One between
/// the same two edges in several rows is not cut, so there are about as many as corners, unless
/// edges cross each other. `None` if there would be more than `most`.
fn trapezoids(outline: &[Vec<DepthPoint>], most: usize) -> Option<Vec<Vec<DepthPoint>>> {
    let mut rows: Vec<f64> = outline.iter().flatten().map(|place| place[1]).collect();
    rows.sort_by(f64::total_cmp);
    rows.dedup();
    // From the upper end, so that the trapezoids on both sides of an edge share its points exactly.
    let down = |(a, b): (DepthPoint, DepthPoint)| if a[1] < b[1] { (a, b) } else { (b, a) };
    let mut edges: Vec<_> = outline.iter().flat_map(|contour| sides(contour)).map(down).collect();
    edges.sort_by(|a, b| a.0[1].total_cmp(&b.0[1]));
    let at = |edge: usize, y: f64| {
        let (a, b) = edges[edge];
        let part = (y - a[1]) / (b[1] - a[1]);
        [a[0] + (b[0] - a[0]) * part, y, a[2] + (b[2] - a[2]) * part]
    };
    let mut trapezoids = Vec::new();
    let closed = |[left, right]: [usize; 2], top: f64, bottom: f64| {
        vec![at(left, top), at(right, top), at(right, bottom), at(left, bottom)]
    };
    let (mut crossed, mut n_begun) = (Vec::new(), 0);
    // The row at which the trapezoid between two edges begins.
    let mut open: BTreeMap<[usize; 2], f64> = BTreeMap::new();
    for pair in rows.windows(2) {
        let [top, bottom] = [pair[0], pair[1]];
        let begun = edges[n_begun..].partition_point(|edge| edge.0[1] <= top);
        crossed.extend(n_begun..n_begun + begun);
        n_begun += begun;
        crossed.retain(|&edge: &usize| edges[edge].1[1] >= bottom);
        let doubled_middle = |edge: usize| at(edge, top)[0] + at(edge, bottom)[0];
        let mut crossings: Vec<_> =
            crossed.iter().map(|&edge| (doubled_middle(edge), edge)).collect();
        crossings.sort_by(|a, b| a.0.total_cmp(&b.0));
        let between: BTreeMap<_, _> =
            crossings.chunks_exact(2).map(|pair| ([pair[0].1, pair[1].1], top)).collect();
        open.retain(|&edges, &mut begin| {
            let stays = between.contains_key(&edges);
            if !stays {
                trapezoids.push(closed(edges, begin, top));
            }
            stays
        });
        if trapezoids.len() > most {
            return None;
        }
        for (edges, top) in between {
            open.entry(edges).or_insert(top);
        }
    }
    let end = rows.last().copied().unwrap_or(0.0);
    trapezoids.extend(open.into_iter().map(|(edges, begin)| closed(edges, begin, end)));
    (trapezoids.len() <= most).then_some(trapezoids)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The parts of a face whose edges cross each other grow with the square of its corners, and
    /// are bounded by the room; other faces need none.
    #[test]
    fn crossing_edges_have_a_limit() {
        let corner = |at: usize| {
            let at = (at * at) as f64;
            [100.0 * libm::cos(1.7 * at), 100.0 * libm::sin(2.3 * at), 1.0]
        };
        let crossed = [(0..400).map(corner).collect::<Vec<_>>()];
        let mut room = 1 << 17;
        let n_parts = convex_parts(&crossed, &mut room).unwrap().len();
        assert!(n_parts > 4000, "{n_parts}");
        let taken = (1 << 17) - room;
        assert!(taken > 0);
        assert!(convex_parts(&crossed, &mut (taken - 1)).is_none());
        assert!(convex_parts(&crossed, &mut { taken }).is_some());
        // A comb does not cross itself.
        let tooth =
            |at: usize| [at as f64, if at.is_multiple_of(2) { 0.0 } else { 50.0 + at as f64 }, 1.0];
        let comb = [(0..400).map(tooth).chain([[399.0, -9.0, 1.0], [0.0, -9.0, 1.0]]).collect()];
        assert!(convex_parts(&comb, &mut 0).is_some());
    }
}
