//! Parts of straight lines: clipped by linear functions, and walked in short steps.

use std::ops::Range;

use glam::DVec3;
use ugscene::View;

/// The part of a line, as parameters in 0…1, on which all of several linear functions are not
/// negative. `ends`: the values of each function at the two ends. The part may be a point.
pub fn clip_line(ends: impl IntoIterator<Item = [f64; 2]>) -> Option<[f64; 2]> {
    let (mut start, mut end) = (0.0f64, 1.0f64);
    for [first, last] in ends {
        match (first >= 0.0, last >= 0.0) {
            (true, true) => {}
            (false, false) => return None,
            (true, false) => end = end.min(first / (first - last)),
            (false, true) => start = start.max(first / (first - last)),
        }
    }
    (start <= end).then_some([start, end])
}

/// The part of a line between two points, relative to the eye, that is in the picture and between
/// the clipping planes.
pub fn in_picture(view: &View, [a, b]: [DVec3; 2]) -> Option<[DVec3; 2]> {
    let sides = view.half_spaces().into_iter().flatten();
    let [start, end] =
        clip_line(sides.map(|side| [a, b].map(|end| side.normal.dot(end) + side.offset)))?;
    Some([start, end].map(|part| a + (b - a) * part))
}

/// True if a point, relative to the eye, is in the picture and between the clipping planes.
pub fn is_in_picture(view: &View, point: DVec3) -> bool {
    view.half_spaces().into_iter().flatten().all(|side| side.normal.dot(point) + side.offset >= 0.0)
}

/// A place in the picture with depth: column, row and depth key, which is linear in the picture.
pub type DepthPoint = [f64; 3];

/// Distance in the picture between the points at which visibility is tested.
const STEP: f64 = 0.5;

/// Most points along a line; no picture is longer.
const MOST_STEPS: f64 = 1e6;

/// The parts of a line, as parameters within a range of it, at which the middles of short steps are
/// not hidden.
pub fn visible_parts(
    [a, b]: [DepthPoint; 2],
    [start, end]: [f64; 2],
    is_hidden: impl Fn(DepthPoint) -> bool,
) -> Vec<[f64; 2]> {
    let length = libm::hypot(b[0] - a[0], b[1] - a[1]) * (end - start);
    // At least one, and in range.
    let n_steps = (length / STEP).ceil().clamp(1.0, MOST_STEPS) as u32;
    let at = |step: u32| {
        if step == n_steps {
            end
        } else {
            start + (end - start) * f64::from(step) / f64::from(n_steps)
        }
    };
    let is_visible = |step: &u32| {
        let part = 0.5 * (at(*step) + at(step + 1));
        !is_hidden([0, 1, 2].map(|i| a[i] + (b[i] - a[i]) * part))
    };
    let mut runs: Vec<Range<u32>> = Vec::new();
    for step in (0..n_steps).filter(is_visible) {
        match runs.last_mut() {
            Some(run) if run.end == step => run.end = step + 1,
            _ => runs.push(step..step + 1),
        }
    }
    runs.into_iter().map(|run| [at(run.start), at(run.end)]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_clipped() {
        #[track_caller]
        fn check(ends: &[[f64; 2]], expected: Option<[f64; 2]>) {
            assert_eq!(clip_line(ends.iter().copied()), expected);
        }
        check(&[], Some([0.0, 1.0]));
        check(&[[1.0, 3.0]], Some([0.0, 1.0]));
        check(&[[-1.0, 3.0]], Some([0.25, 1.0]));
        check(&[[-1.0, 3.0], [1.0, -1.0]], Some([0.25, 0.5]));
        check(&[[-3.0, 1.0], [1.0, -3.0]], None);
        check(&[[-1.0, -2.0]], None);
    }

    #[test]
    fn visible_steps_are_joined() {
        let line = [[0.0; 3], [3.0, 0.0, 0.0]];
        let is_hidden = |[x, ..]: DepthPoint| (1.0..1.5).contains(&x);
        assert_eq!(visible_parts(line, [0.0, 1.0], is_hidden), [[0.0, 1.0 / 3.0], [0.5, 1.0]]);
        assert_eq!(visible_parts(line, [0.5, 1.0], is_hidden), [[0.5, 1.0]]);
        assert!(visible_parts(line, [0.0, 1.0], |_| true).is_empty());
    }
}
