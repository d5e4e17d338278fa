//! The parts of lines that are not occluded by the surfaces of the picture.

use glam::DVec3;
use ugimage::figure::Point;
use ugscene::View;

use crate::depth_buffer::DepthBuffer;
use crate::line::{clip_line, visible_runs};

/// A line behind a face by less than this part of its distance counts as lying on it: lines follow
/// edges and the ground.
const SLACK: f64 = 2e-3;

/// Length in pixels of the steps for which visibility is decided.
const STEP: f64 = 0.5;

/// Greatest length in pixels of visible parts that are left out if most of the line is hidden.
const SPECK: f64 = 3.0;

/// A picture coordinate with depth: column, row and depth key, which is linear in the picture.
pub type DepthPoint = [f64; 3];

/// Decides which parts of lines are hidden by the surfaces of a depth buffer.
pub struct VisibleLines<'a> {
    /// Camera of the depth buffer, at one sample a pixel.
    pub view: &'a View,
    /// The occluders.
    pub depths: &'a DepthBuffer,
}

impl VisibleLines<'_> {
    /// The visible parts of a line; its ends are relative to the eye.
    pub fn visible(&self, ends: [DVec3; 2]) -> Vec<[Point; 2]> {
        self.visible_where(ends, |_, _| true)
    }

    /// As [`VisibleLines::visible`], restricted to where `is_asked` holds for the point and the
    /// unit vector across the line.
    pub fn visible_where(
        &self,
        ends: [DVec3; 2],
        is_asked: impl Fn(DepthPoint, Point) -> bool,
    ) -> Vec<[Point; 2]> {
        let Some(ends) = in_picture(self.view, ends) else { return Vec::new() };
        let [a, b] = ends.map(|end| self.depth_point(end));
        let at = |part: f64| [0, 1, 2].map(|i| a[i] + (b[i] - a[i]) * part);
        let length = libm::hypot(b[0] - a[0], b[1] - a[1]);
        // A line in the picture is at most as long as its diagonal.
        let across = if length > 0.0 { [(a[1] - b[1]) / length, (b[0] - a[0]) / length] } else { [0.0; 2] };
        let n_steps = (length / STEP).ceil().clamp(1.0, 1e6) as u32;
        let part = |step: u32| f64::from(step) / f64::from(n_steps);
        let is_visible = |step: u32| {
            let middle = at(0.5 * (part(step) + part(step + 1)));
            self.is_seen(middle) && is_asked(middle, across)
        };
        let mut lines = Vec::new();
        for run in visible_runs(n_steps, is_visible) {
            let [from, to] = [run.start, run.end].map(|step| at(part(step)));
            // Shorter runs on a longer line are rounding noise of the depth test.
            let n_run = run.end - run.start;
            if 2 * n_run >= n_steps || f64::from(n_run) * STEP > SPECK {
                lines.push([[from[0], from[1]], [to[0], to[1]]]);
            }
        }
        lines
    }

    /// The position in the picture of a point, relative to the eye, if it is visible.
    pub fn shows(&self, point: DVec3) -> Option<Point> {
        let place = self.depth_point(point);
        self.is_seen(place).then_some([place[0], place[1]])
    }

    /// Projects a point, relative to the eye.
    pub fn depth_point(&self, point: DVec3) -> DepthPoint {
        let place = self.view.place(point);
        if self.view.is_perspective {
            [place.x / place.z, place.y / place.z, 1.0 / place.z]
        } else {
            [place.x, place.y, -place.z]
        }
    }

    /// Inverse of the projection: a point relative to the eye.
    pub fn point(&self, [x, y, key]: DepthPoint) -> DVec3 {
        self.view.point([x, y], if self.view.is_perspective { 1.0 / key } else { -key })
    }

    /// The face visible at a point of the picture.
    pub fn face_at(&self, [x, y]: Point) -> Option<usize> {
        self.depths.get(x.floor() as i64, y.floor() as i64).map(|seen| seen.item as usize)
    }

    /// The faces visible in the nine pixels around a point of the picture, some more than once.
    pub fn faces_around(&self, [x, y]: Point) -> impl Iterator<Item = usize> {
        let [column, row] = [x, y].map(|coordinate| coordinate.floor() as i64);
        let pixels = (-1..=1).flat_map(move |down| {
            (-1..=1).map(move |right| (column.saturating_add(right), row.saturating_add(down)))
        });
        pixels.filter_map(|(column, row)| self.depths.get(column, row)).map(|seen| seen.item as usize)
    }

    /// True unless all nine pixels around the point show something nearer.
    fn is_seen(&self, [x, y, key]: DepthPoint) -> bool {
        let slack = if self.view.is_perspective { SLACK * key } else { SLACK * self.view.distance };
        self.depths.any_around([x, y], |seen| seen.is_none_or(|seen| f64::from(seen.key) <= key + slack))
    }
}

/// Clips a line to the picture and the clipping planes; its ends are relative to the eye.
pub fn in_picture(view: &View, [a, b]: [DVec3; 2]) -> Option<[DVec3; 2]> {
    let sides = view.half_spaces().into_iter().flatten();
    let [start, end] = clip_line(sides.map(|side| [a, b].map(|end| side.normal.dot(end) + side.offset)))?;
    Some([a + (b - a) * start, a + (b - a) * end])
}
