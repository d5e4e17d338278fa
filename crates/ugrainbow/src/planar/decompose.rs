//! Polygons in the picture plane cut to the picture, and into convex flat parts.

use ugpicture::DepthPoint;

use super::convex::{Convex, clip, doubled_area, sides};

/// Clips a contour to the picture and a `margin` around it.
pub fn clipped_to_picture(mut contour: Vec<DepthPoint>, size: [u32; 2], margin: f64) -> Vec<DepthPoint> {
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

/// Decomposes a polygon into convex parts, each of them planar in depth.
pub fn convex_parts(outline: &[Vec<DepthPoint>]) -> Vec<Convex> {
    if let [contour] = outline
        && is_convex(contour)
    {
        return flat_parts(contour.clone());
    }
    trapezoids(outline).into_iter().flat_map(flat_parts).collect()
}

/// A convex polygon itself if it is planar in depth, otherwise a fan of triangles.
fn flat_parts(corners: Vec<DepthPoint>) -> Vec<Convex> {
    let Some(whole) = Convex::new(corners) else { return Vec::new() };
    if whole.is_flat() {
        return vec![whole];
    }
    let first = whole.corners[0];
    whole.corners[1..].windows(2).filter_map(|pair| Convex::new(vec![first, pair[0], pair[1]])).collect()
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

/// Cuts a polygon along the rows of its corners into trapezoids, by the even-odd rule.
fn trapezoids(outline: &[Vec<DepthPoint>]) -> Vec<Vec<DepthPoint>> {
    let mut rows: Vec<f64> = outline.iter().flatten().map(|place| place[1]).collect();
    rows.sort_by(f64::total_cmp);
    rows.dedup();
    let edges: Vec<(DepthPoint, DepthPoint)> = outline.iter().flat_map(|contour| sides(contour)).collect();
    let mut trapezoids = Vec::new();
    for pair in rows.windows(2) {
        let [top, bottom] = [pair[0], pair[1]];
        let at = |(a, b): (DepthPoint, DepthPoint), y: f64| {
            // From the upper end, so that the trapezoids on both sides of an edge share the point
            // exactly.
            let (a, b) = if a[1] < b[1] { (a, b) } else { (b, a) };
            let part = (y - a[1]) / (b[1] - a[1]);
            [a[0] + (b[0] - a[0]) * part, y, a[2] + (b[2] - a[2]) * part]
        };
        let spans = |(a, b): &(DepthPoint, DepthPoint)| a[1].min(b[1]) <= top && a[1].max(b[1]) >= bottom;
        let mut crossings: Vec<[DepthPoint; 2]> = edges
            .iter()
            .filter(|edge| spans(edge))
            .map(|&edge| [top, bottom].map(|row| at(edge, row)))
            .collect();
        crossings.sort_by(|a, b| (a[0][0] + a[1][0]).total_cmp(&(b[0][0] + b[1][0])));
        for pair in crossings.chunks_exact(2) {
            let ([a, d], [b, c]) = (pair[0], pair[1]);
            trapezoids.push(vec![a, b, c, d]);
        }
    }
    trapezoids
}
