//! A depth buffer of the surfaces visible at the middle of each pixel.

use std::ops::Range;

/// A surface at a sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceSample {
    /// Depth key: 1/depth in perspective, −depth in orthographic projection. Larger is nearer.
    pub key: f32,
    /// Row of the face in the scene; wires are counted after the faces.
    pub item: u32,
}

/// The nearest opaque surface at the middle of each pixel.
#[derive(Clone, Debug)]
pub struct DepthBuffer {
    /// Pixels across and down.
    pub size: [u32; 2],
    /// Row after row; `None` where nothing is visible.
    pub seen: Vec<Option<SurfaceSample>>,
}

impl DepthBuffer {
    /// The surface at a pixel; `None` outside the picture as well.
    pub fn get(&self, column: i64, row: i64) -> Option<SurfaceSample> {
        let [width, height] = self.size.map(i64::from);
        let is_inside = (0..width).contains(&column) && (0..height).contains(&row);
        self.seen[is_inside.then_some((row * width + column) as usize)?]
    }

    /// True if the pixel of a point, or one of the eight around it, is in the picture and fulfils a
    /// condition.
    pub fn any_around(&self, [x, y]: [f64; 2], holds: impl Fn(Option<SurfaceSample>) -> bool) -> bool {
        let [width, height] = self.size;
        let columns = around(x, width);
        around(y, height)
            .any(|row| columns.clone().any(|column| holds(self.seen[row * width as usize + column])))
    }
}

/// The pixel of a coordinate and its two neighbours, as far as they are among `size`; none of NaN.
fn around(place: f64, size: u32) -> Range<usize> {
    let [start, end] = [-1.0, 2.0].map(|step| (place.floor() + step).clamp(0.0, size.into()) as usize);
    start..end
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_are_found_at_every_point() {
        let mut buffer = DepthBuffer { size: [3, 2], seen: vec![None; 6] };
        buffer.seen[5] = Some(SurfaceSample { key: 1.0, item: 7 });
        let is_near = |place| buffer.any_around(place, |seen| seen.is_some());
        for place in [[1.0, 0.0], [2.9, 1.9], [3.5, 2.5], [1.0, 2.0]] {
            assert!(is_near(place), "{place:?}");
        }
        let huge = [f64::MAX, f64::MIN, f64::INFINITY, f64::NEG_INFINITY, f64::NAN, 9.3e18, -9.3e18];
        let far = huge.into_iter().flat_map(|huge| [[huge, 1.0], [2.0, huge], [huge, huge]]);
        for place in far.chain([[0.9, 1.5], [4.0, 1.5], [2.5, 3.0], [2.5, -1.0]]) {
            assert!(!is_near(place), "{place:?}");
        }
    }
}
