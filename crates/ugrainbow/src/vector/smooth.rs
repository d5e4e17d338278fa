//! Areas as elements of a figure: plain areas, triangles between whose corners colour is
//! linear, and areas whose colour is linear along a line.

use ugimage::figure::{Element, GouraudTriangle, Gradient, Point, Rgb};

use super::color::{FigureColors, Levels, distance, mean, rounded};
use super::patch::Patch;
use super::transparency::PaintedArea;
use crate::planar::{Convex, sides};

/// Bound on the colour error of a figure, in levels of 255, at the points tested: corners, middles
/// of edges and middles of pieces.
const BOUND: f64 = 2.0;

/// Greatest difference of colours, in levels of 255, of an area of one colour.
const PLAIN: f64 = 2.0;

/// Size in pixels of parts that are not subdivided for their colour.
const LEAST: f64 = 0.25;

/// Most subdivisions of a piece.
const MOST_CUTS: u32 = 14;

/// Smooth colour as a format supports it.
pub trait Smooth: Sized {
    /// Adds smooth elements for the parts of an area whose outline is `contours`.
    fn push(
        job: &Job<'_>,
        contours: Vec<Vec<Point>>,
        parts: &[Convex],
        elements: &mut Vec<Element<Self>>,
    );
}

/// An area being painted.
pub struct Job<'a> {
    colors: &'a FigureColors<'a>,
    patches: &'a [Patch],
    /// As [`PaintedArea::layers`].
    layers: &'a [usize],
}

/// The colour of an area, if it is nearly the same everywhere.
pub fn plain_color(
    colors: &FigureColors<'_>,
    patches: &[Patch],
    area: &PaintedArea,
) -> Option<Rgb> {
    let job = Job { colors, patches, layers: &area.layers };
    colors.everywhere(job.layers()).or_else(|| plain(&job.tried(&area.parts))).map(rounded)
}

/// Adds an area of smooth colour to the figure.
pub fn push_smooth<S: Smooth>(
    colors: &FigureColors<'_>,
    patches: &[Patch],
    PaintedArea { layers, contours, parts }: PaintedArea,
    elements: &mut Vec<Element<S>>,
) {
    S::push(&Job { colors, patches, layers: &layers }, contours, &parts, elements);
}

/// The middle of the range of colours, if it is small.
fn plain(tried: &[(Point, Levels)]) -> Option<Levels> {
    let bound = |i: usize, start: f64, pick: fn(f64, f64) -> f64| {
        tried.iter().map(|(_, levels)| levels[i]).fold(start, pick)
    };
    let low = [0, 1, 2].map(|i| bound(i, f64::INFINITY, f64::min));
    let high = [0, 1, 2].map(|i| bound(i, f64::NEG_INFINITY, f64::max));
    (distance(low, high) <= PLAIN).then(|| mean(low, high))
}

impl Job<'_> {
    fn color(&self, place: Point) -> Levels {
        self.colors.at(self.layers(), place)
    }

    fn layers(&self) -> impl Iterator<Item = &Patch> {
        self.layers.iter().map(|&idx| &self.patches[idx])
    }

    /// The colours at the test points: corners, middles of edges and middles of parts.
    fn tried(&self, parts: &[Convex]) -> Vec<(Point, Levels)> {
        let mut places = Vec::new();
        for part in parts {
            places.push(part.middle());
            for (a, b) in sides(&part.corners) {
                places.extend([[a[0], a[1]], [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])]]);
            }
        }
        places.into_iter().map(|place| (place, self.color(place))).collect()
    }
}

impl Smooth for GouraudTriangle {
    fn push(
        job: &Job<'_>,
        _: Vec<Vec<Point>>,
        parts: &[Convex],
        elements: &mut Vec<Element<Self>>,
    ) {
        for part in parts {
            let corners = part.outline();
            for pair in corners[1..].windows(2) {
                let corners = [corners[0], pair[0], pair[1]];
                push_triangles(job, corners, elements);
            }
        }
    }
}

/// Adds a triangle, halved until colour is linear in its parts.
fn push_triangles(
    job: &Job<'_>,
    corners: [Point; 3],
    elements: &mut Vec<Element<GouraudTriangle>>,
) {
    let mut stack = vec![(corners, corners.map(|corner| job.color(corner)), 0)];
    while let Some((corners, colors, cuts)) = stack.pop() {
        let middles = [0, 1, 2].map(|i| middle(corners[i], corners[(i + 1) % 3]));
        let colors_there = middles.map(|place| job.color(place));
        let errors =
            [0, 1, 2].map(|i| distance(colors_there[i], mean(colors[i], colors[(i + 1) % 3])));
        let center =
            [0, 1].map(|axis| (corners[0][axis] + corners[1][axis] + corners[2][axis]) / 3.0);
        let mean_color = [0, 1, 2].map(|i| (colors[0][i] + colors[1][i] + colors[2][i]) / 3.0);
        let error = errors.into_iter().fold(distance(job.color(center), mean_color), f64::max);
        let length = |i: usize| {
            let (a, b) = (corners[i], corners[(i + 1) % 3]);
            libm::hypot(b[0] - a[0], b[1] - a[1])
        };
        let longest = greatest([0, 1, 2].map(length));
        if error <= BOUND || cuts == MOST_CUTS || length(longest) < LEAST {
            elements
                .push(Element::Smooth(GouraudTriangle { corners, colors: colors.map(rounded) }));
            continue;
        }
        // The edge along which colour is least linear; the longest if only the centre is off.
        let worst = greatest(errors);
        let i = if errors[worst] > BOUND { worst } else { longest };
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        let (place, color) = (middles[i], colors_there[i]);
        stack.push(([place, corners[j], corners[k]], [color, colors[j], colors[k]], cuts + 1));
        stack.push(([corners[i], place, corners[k]], [colors[i], color, colors[k]], cuts + 1));
    }
}

fn middle(a: Point, b: Point) -> Point {
    [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])]
}

/// The index of the greatest number; ties go to the first.
fn greatest(numbers: [f64; 3]) -> usize {
    (1..3).fold(0, |best, i| if numbers[i] > numbers[best] { i } else { best })
}

impl Smooth for Gradient {
    fn push(
        job: &Job<'_>,
        contours: Vec<Vec<Point>>,
        parts: &[Convex],
        elements: &mut Vec<Element<Self>>,
    ) {
        let tried = job.tried(parts);
        let nearest = fitted(&tried, f64::INFINITY);
        if let Some((ends, colors)) = nearest {
            // Also where the piece is subdivided: it fills the gaps that anti-aliasing leaves
            // between the parts.
            elements.push(Element::Smooth(Self {
                contours,
                ends,
                colors: colors.map(rounded),
                is_inside: false,
            }));
        }
        if fitted(&tried, BOUND).is_some() {
            return;
        }
        let mut stack: Vec<(Convex, u32)> =
            parts.iter().rev().map(|part| (part.clone(), 0)).collect();
        while let Some((part, cuts)) = stack.pop() {
            let tried = job.tried(std::slice::from_ref(&part));
            let contours = vec![part.outline()];
            let is_last = cuts == MOST_CUTS || part.extent() < LEAST;
            if let Some(color) = plain(&tried) {
                elements.push(Element::Area { contours, color: rounded(color), is_inside: true });
            } else if let Some((ends, colors)) =
                fitted(&tried, if is_last { f64::INFINITY } else { BOUND })
            {
                elements.push(Element::Smooth(Self {
                    contours,
                    ends,
                    colors: colors.map(rounded),
                    is_inside: true,
                }));
            } else {
                stack.extend(part.halves().into_iter().flatten().map(|half| (half, cuts + 1)));
            }
        }
    }
}

/// The linear gradient along a line that fits these colours best; `None` if it differs from one by
/// more than `bound`.
///
/// Least squares give a linear function of position for each channel. The gradient follows the
/// direction in which all channels together change most: the greater principal axis of their
/// slopes.
fn fitted(tried: &[(Point, Levels)], bound: f64) -> Option<([Point; 2], [Levels; 2])> {
    let n = tried.len() as f64;
    let [x0, y0] = [0, 1].map(|axis| tried.iter().map(|(place, _)| place[axis]).sum::<f64>() / n);
    let center = [0, 1, 2].map(|i| tried.iter().map(|(_, color)| color[i]).sum::<f64>() / n);
    let mut moments = [0.0; 3];
    let mut products = [[0.0; 2]; 3];
    for ([x, y], color) in tried {
        let (x, y) = (x - x0, y - y0);
        moments = [moments[0] + x * x, moments[1] + x * y, moments[2] + y * y];
        for i in 0..3 {
            products[i][0] += x * (color[i] - center[i]);
            products[i][1] += y * (color[i] - center[i]);
        }
    }
    let [xx, xy, yy] = moments;
    let determinant = xx * yy - xy * xy;
    // For points on one line the slope across it is set to zero.
    let ridge = 1e-9 * (xx + yy) * (xx + yy);
    let determinant = determinant.max(ridge);
    let slopes = products
        .map(|[px, py]| [(px * yy - py * xy) / determinant, (py * xx - px * xy) / determinant]);
    let sum = |a: usize, b: usize| slopes.iter().map(|slope| slope[a] * slope[b]).sum::<f64>();
    let angle = 0.5 * libm::atan2(2.0 * sum(0, 1), sum(0, 0) - sum(1, 1));
    let (dy, dx) = libm::sincos(angle);
    let along = |[x, y]: Point| (x - x0) * dx + (y - y0) * dy;
    let start = tried.iter().map(|(place, _)| along(*place)).fold(f64::INFINITY, f64::min);
    let end = tried.iter().map(|(place, _)| along(*place)).fold(f64::NEG_INFINITY, f64::max);
    let square: f64 = tried.iter().map(|(place, _)| along(*place) * along(*place)).sum();
    let slope = [0, 1, 2].map(|i| {
        let product: f64 =
            tried.iter().map(|(place, color)| along(*place) * (color[i] - center[i])).sum();
        if square > 0.0 { product / square } else { 0.0 }
    });
    let color = |t: f64| [0, 1, 2].map(|i| center[i] + slope[i] * t);
    let is_near =
        tried.iter().all(|(place, levels)| distance(color(along(*place)), *levels) <= bound);
    let place = |t: f64| [x0 + t * dx, y0 + t * dy];
    let shown = |t: f64| color(t).map(|level| level.clamp(0.0, 255.0));
    is_near.then(|| ([place(start), place(end)], [shown(start), shown(end)]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_linear_change_is_fitted_exactly() {
        let color = |[x, y]: Point| [10.0 + 3.0 * x + 4.0 * y, 200.0 - 6.0 * x - 8.0 * y, 50.0];
        let places = [[0.0, 0.0], [4.0, 0.0], [4.0, 3.0], [0.0, 3.0], [1.0, 2.0]];
        let tried = places.map(|place| (place, color(place)));
        let (ends, colors) = fitted(&tried, 1e-9).unwrap();
        for (end, shown) in ends.into_iter().zip(colors) {
            assert!(distance(shown, color(end)) < 1e-9, "{end:?} {shown:?}");
        }
        // Red and green change in perpendicular directions, so no single gradient fits.
        let crossed = places.map(|[x, y]| ([x, y], [50.0 * x, 50.0 * y, 0.0]));
        assert!(fitted(&crossed, 2.0).is_none());
    }
}
