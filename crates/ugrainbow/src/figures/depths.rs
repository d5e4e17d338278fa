//! What is seen in the middle of each pixel, and which parts of a line it hides.

use glam::DVec3;
use uglabel::Point;
use ugraster::{Center, Hit};
use ugscene::View;

use crate::config::{Config, DrawMode};
use crate::render_layers::RenderLayers;
use crate::setup::Setup;

/// A line as far behind a face as this part of its distance is still on it: lines follow edges and grounds.
const SLACK: f64 = 2e-3;

/// Steps of a line in pixels, at each of which it is asked whether it is seen.
const STEP: f64 = 0.5;

/// The longest part of a line, in pixels, that is left out if most of the line is hidden.
const SPECK: f64 = 3.0;

/// What is asked of a picture of faces with one sample for each pixel.
pub fn coarse(config: &Config) -> Config {
    Config { samples: 1, wireframe: None, depth_cue: None, ..config.clone() }
}

/// Column, row and depth key.
pub type Spot = [f64; 3];

/// What is seen in the middle of each pixel.
pub struct Depths {
    size: [u32; 2],
    is_perspective: bool,
    /// Row after row; of face or wire, see [`crate::painter::Painter`].
    pub seen: Vec<Option<Hit>>,
}

impl Depths {
    /// `setup` and `mode`: with one sample for each pixel.
    pub fn new(setup: &Setup<'_>, mode: &DrawMode) -> Self {
        let grid = &setup.grid;
        let layers = RenderLayers::new(setup.painter(), mode);
        let seen = layers.paint_centers(grid, &setup.shader, |center: &Center<'_>| center.opaque);
        Self { size: [grid.width, grid.height], is_perspective: grid.is_perspective, seen }
    }

    /// The parts of a line in the picture that nothing hides; its ends are relative to the eye.
    pub fn visible(&self, view: &View, ends: [DVec3; 2]) -> Vec<[Point; 2]> {
        self.visible_where(view, ends, |_, _| true)
    }

    /// The same, of those parts that are asked for: by place, and by a step of a pixel across the line.
    pub fn visible_where(
        &self,
        view: &View,
        ends: [DVec3; 2],
        is_asked: impl Fn(Spot, Point) -> bool,
    ) -> Vec<[Point; 2]> {
        let Some(ends) = in_picture(view, ends) else { return Vec::new() };
        let [a, b] = ends.map(|end| self.spot(view, end));
        let at = |part: f64| [0, 1, 2].map(|i| a[i] + (b[i] - a[i]) * part);
        let length = libm::hypot(b[0] - a[0], b[1] - a[1]);
        // A line in the picture is not longer than its diagonal.
        let across = if length > 0.0 { [(a[1] - b[1]) / length, (b[0] - a[0]) / length] } else { [0.0; 2] };
        let n_steps = (length / STEP).ceil().clamp(1.0, 1e6) as u32;
        let part = |step: u32| f64::from(step) / f64::from(n_steps);
        let mut lines = Vec::new();
        let mut start = None;
        for step in 0..=n_steps {
            let middle = at(0.5 * (part(step) + part(step + 1)));
            let is_seen = step < n_steps && self.is_seen(view, middle) && is_asked(middle, across);
            match (start, is_seen) {
                (None, true) => start = Some(step),
                (Some(first), false) => {
                    let [from, to] = [first, step].map(|step| at(part(step)));
                    // A speck of a longer line is where hiding was decided by a hair.
                    if 2 * (step - first) >= n_steps || f64::from(step - first) * STEP > SPECK {
                        lines.push([[from[0], from[1]], [to[0], to[1]]]);
                    }
                    start = None;
                }
                _ => {}
            }
        }
        lines
    }

    /// Where a point, relative to the eye and in the picture, is seen, if nothing hides it.
    pub fn shows(&self, view: &View, point: DVec3) -> Option<Point> {
        let spot = self.spot(view, point);
        self.is_seen(view, spot).then_some([spot[0], spot[1]])
    }

    /// Column, row and depth key, which is linear in the picture.
    fn spot(&self, view: &View, point: DVec3) -> Spot {
        let place = view.place(point);
        if self.is_perspective {
            [place.x / place.z, place.y / place.z, 1.0 / place.z]
        } else {
            [place.x, place.y, -place.z]
        }
    }

    /// The point of a spot, relative to the eye.
    pub fn point(&self, view: &View, [x, y, key]: Spot) -> DVec3 {
        view.point([x, y], if self.is_perspective { 1.0 / key } else { -key })
    }

    /// The face that is seen at a place; none where nothing is, and outside the picture.
    pub fn face_at(&self, [x, y]: Point) -> Option<usize> {
        let [width, height] = self.size.map(f64::from);
        let is_inside = (0.0..width).contains(&x) && (0.0..height).contains(&y);
        let idx = is_inside.then(|| y as usize * self.size[0] as usize + x as usize)?;
        self.seen[idx].map(|seen| seen.item as usize)
    }

    /// True unless all nine pixels round the spot show something nearer.
    fn is_seen(&self, view: &View, [x, y, key]: Spot) -> bool {
        let slack = if self.is_perspective { SLACK * key } else { SLACK * view.distance };
        let [width, height] = self.size.map(i64::from);
        let (column, row) = (x.floor() as i64, y.floor() as i64);
        (row - 1..=row + 1).any(|row| {
            (column - 1..=column + 1).any(|column| {
                let is_inside = (0..width).contains(&column) && (0..height).contains(&row);
                let seen = || self.seen[(row * width + column) as usize];
                is_inside && seen().is_none_or(|seen| f64::from(seen.key) <= key + slack)
            })
        })
    }
}

/// The part of a line that is in the picture and between the clipping planes; its ends are relative to the eye.
pub fn in_picture(view: &View, [a, b]: [DVec3; 2]) -> Option<[DVec3; 2]> {
    let (mut start, mut end) = (0.0f64, 1.0f64);
    for side in view.half_spaces().into_iter().flatten() {
        let inside = |point: DVec3| side.normal.dot(point) + side.offset;
        let (first, last) = (inside(a), inside(b));
        let crossing = first / (first - last);
        match (first >= 0.0, last >= 0.0) {
            (false, false) => return None,
            (false, true) => start = start.max(crossing),
            (true, false) => end = end.min(crossing),
            (true, true) => {}
        }
    }
    (start <= end).then(|| [a + (b - a) * start, a + (b - a) * end])
}
