//! A depth buffer of the surfaces visible at the middle of each pixel.

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

    /// True if a pixel is in the picture and fulfils a condition.
    pub fn any_around(&self, [x, y]: [f64; 2], holds: impl Fn(Option<SurfaceSample>) -> bool) -> bool {
        let [width, height] = self.size.map(i64::from);
        let (column, row) = (x.floor() as i64, y.floor() as i64);
        (row - 1..=row + 1).any(|row| {
            (column - 1..=column + 1).any(|column| {
                let is_inside = (0..width).contains(&column) && (0..height).contains(&row);
                is_inside && holds(self.seen[(row * width + column) as usize])
            })
        })
    }
}
