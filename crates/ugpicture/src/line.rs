//! Parts of straight lines: clipped by linear functions, and walked in short steps.

use std::ops::Range;

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

/// The longest runs of visible steps, out of `n_steps` along a line.
pub fn visible_runs(n_steps: u32, is_visible: impl Fn(u32) -> bool) -> Vec<Range<u32>> {
    let mut runs: Vec<Range<u32>> = Vec::new();
    for step in (0..n_steps).filter(|&step| is_visible(step)) {
        match runs.last_mut() {
            Some(run) if run.end == step => run.end = step + 1,
            _ => runs.push(step..step + 1),
        }
    }
    runs
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
        assert_eq!(visible_runs(6, |step| step != 2), [0..2, 3..6]);
        assert_eq!(visible_runs(3, |_| false), []);
    }
}
