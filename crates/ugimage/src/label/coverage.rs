//! Pixel coverage of shapes (antialiasing).

use crate::figure::Point;
use tiny_skia::{FillRule, Mask, Path, PathBuilder, Transform};

use crate::label::drawing::Shape;
use crate::label::text::contours;

/// Mask cells per pixel, along each axis; tiny-skia takes 4 × 4 samples per cell.
const CELLS_PER_PIXEL: u32 = 4;

/// Largest side of a tile, in pixels. Coverage is computed tile by tile.
pub const TILE: u32 = 256;

/// Coordinates are clamped to this distance from a tile, in pixels, because tiny-skia uses single
/// precision.
const MAX_DISTANCE: f64 = 1e4;

/// A rectangle of pixels whose coverage is computed at once.
#[derive(Clone, Copy, Debug)]
pub struct Tile {
    /// Column and row of its upper left pixel.
    pub first: [u32; 2],
    /// Columns and rows.
    pub size: [u32; 2],
}

impl Tile {
    /// The coverage, 0…1, of each pixel of the tile, row after row; `None` if the shape does not
    /// reach into the tile.
    pub fn coverage(self, shape: &Shape) -> Option<Vec<f32>> {
        let (path, rule) = match shape {
            Shape::Area { contours, .. } => {
                (self.path(contours.iter().map(Vec::as_slice)), FillRule::EvenOdd)
            }
            Shape::Lines { lines, width, .. } => {
                let strips: Vec<Vec<Point>> =
                    lines.iter().map(|&line| strip(line, 0.5 * width)).collect();
                // All strips have the same orientation, so the nonzero winding rule fills their
                // union.
                (self.path(strips.iter().map(Vec::as_slice)), FillRule::Winding)
            }
            Shape::Text(text) => {
                (self.path(contours(text).iter().map(Vec::as_slice)), FillRule::EvenOdd)
            }
        };
        let path = path?;
        let [width, height] = self.size;
        let mut mask = Mask::new(width * CELLS_PER_PIXEL, height * CELLS_PER_PIXEL)?;
        mask.fill_path(&path, rule, true, Transform::identity());
        Some(self.averaged(&mask))
    }

    fn averaged(self, mask: &Mask) -> Vec<f32> {
        let [width, height] = self.size.map(|side| side as usize);
        let fine = CELLS_PER_PIXEL as usize;
        let full = 255.0 * (CELLS_PER_PIXEL * CELLS_PER_PIXEL) as f32;
        let mut parts = Vec::with_capacity(width * height);
        for row in 0..height {
            for column in 0..width {
                let cells = (0..fine).flat_map(|y| {
                    let start = (row * fine + y) * width * fine + column * fine;
                    &mask.data()[start..start + fine]
                });
                let sum: u32 = cells.map(|&cell| u32::from(cell)).sum();
                parts.push(sum as f32 / full);
            }
        }
        parts
    }

    /// The outlines that may reach into the tile, in mask cells. Outlines with NaN coordinates are
    /// skipped.
    fn path<'a>(self, contours: impl Iterator<Item = &'a [Point]>) -> Option<Path> {
        let [left, top] = self.first.map(f64::from);
        let [right, bottom] = [left + f64::from(self.size[0]), top + f64::from(self.size[1])];
        let mut path = PathBuilder::new();
        for contour in contours {
            let is_beside = contour.iter().all(|place| place[0] < left)
                || contour.iter().all(|place| place[0] > right)
                || contour.iter().all(|place| place[1] < top)
                || contour.iter().all(|place| place[1] > bottom);
            if is_beside || contour.iter().flatten().any(|coordinate| coordinate.is_nan()) {
                continue;
            }
            let cell = |coordinate: f64, start: f64| {
                ((coordinate - start).clamp(-MAX_DISTANCE, MAX_DISTANCE)
                    * f64::from(CELLS_PER_PIXEL)) as f32
            };
            for (idx, &[x, y]) in contour.iter().enumerate() {
                let (x, y) = (cell(x, left), cell(y, top));
                if idx == 0 { path.move_to(x, y) } else { path.line_to(x, y) }
            }
            path.close();
        }
        path.finish()
    }
}

/// A line as a rectangle of half width `half`; empty if its ends coincide.
fn strip([a, b]: [Point; 2], half: f64) -> Vec<Point> {
    let (x, y) = (b[0] - a[0], b[1] - a[1]);
    let length = libm::hypot(x, y);
    if length <= 0.0 {
        return Vec::new();
    }
    let (x, y) = (-y / length * half, x / length * half);
    vec![[a[0] + x, a[1] + y], [b[0] + x, b[1] + y], [b[0] - x, b[1] - y], [a[0] - x, a[1] - y]]
}
