//! Exposures that follow the light of a film.

/// The exposure that is metered in a frame, in stops; `None` if nothing in it is lit.
pub type Metered = (u32, Option<f64>);

/// Most frames on either side of a frame that its exposure depends on, about half a second.
const REACH: f64 = 12.0;

/// Frames of a film for one of that reach, so that short films follow as well.
const PER_REACH: f64 = 8.0;

/// Smooths exposures that were metered in single frames, so that a film does not flicker, and none
/// is above the metered one, which would clip light: the lowest of those within an eighth of the
/// film, 12 frames at most, and of these lowest ones the mean with weights that fall off linearly
/// over as many. All of them contain the frame itself. They depend on the metered exposures alone,
/// and are hundredths of a stop. `is_loop`: the first frame follows the last one. Frames in which
/// nothing is lit have none.
pub fn smoothed(metered: &[Metered], n_frames: u32, is_loop: bool) -> Vec<(u32, f64)> {
    let n_rows = metered.len() as i64;
    let per_row = f64::from(n_frames) / metered.len().max(1) as f64;
    let reach = (REACH.min(f64::from(n_frames) / PER_REACH) / per_row).round().max(1.0) as i64;
    let around = |row: i64, values: &dyn Fn(usize) -> Option<f64>| -> Vec<(i64, f64)> {
        let other = |step: i64| {
            let other = if is_loop { (row + step).rem_euclid(n_rows) } else { row + step };
            let other = usize::try_from(other).ok().filter(|&other| other < metered.len())?;
            Some((step, values(other)?))
        };
        (-reach..=reach).filter_map(other).collect()
    };
    let lowest: Vec<f64> = (0..n_rows)
        .map(|row| around(row, &|other| metered[other].1))
        .map(|near| near.into_iter().map(|(_, stops)| stops).fold(f64::INFINITY, f64::min))
        .collect();
    let smooth = |(row, &(frame, stops)): (i64, &Metered)| {
        stops?;
        let own = lowest[row as usize];
        // Differences from its own exposure: the mean of equal numbers is exact.
        let (mut sum, mut weights) = (0.0, 0.0);
        for (step, other) in around(row, &|other| metered[other].1.map(|_| lowest[other])) {
            let weight = (1 + reach - step.abs()) as f64;
            (sum, weights) = (sum + weight * (other - own), weights + weight);
        }
        // Rounded down, but for errors of rounding.
        Some((frame, (100.0 * (own + sum / weights) + 1e-6).floor() / 100.0))
    };
    (0..).zip(metered).filter_map(smooth).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn metered(stops: impl Fn(u32) -> Option<f64>, n_frames: u32) -> Vec<Metered> {
        (1..=n_frames).map(|frame| (frame, stops(frame))).collect()
    }

    #[test]
    fn what_does_not_change_stays_and_slopes_do_too() {
        for is_loop in [false, true] {
            let still = smoothed(&metered(|_| Some(-0.37), 40), 40, is_loop);
            assert!(still.iter().all(|&(_, stops)| stops == -0.37));
        }
        let slope = smoothed(&metered(|frame| Some(0.1 * f64::from(frame)), 100), 100, false);
        let middle = slope.iter().filter(|(frame, _)| (25..=76).contains(frame));
        assert!(
            middle
                .clone()
                .all(|&(frame, stops)| (stops - 0.1 * f64::from(frame) + 1.2).abs() < 0.011)
        );
        assert_eq!(middle.count(), 52);
    }

    /// The exposure falls slowly to that of a flash of one frame or a step, before it comes, as
    /// much in a film that is played backwards.
    #[test]
    fn exposures_do_not_flicker() {
        let flash =
            smoothed(&metered(|frame| Some(if frame == 50 { -5.0 } else { 0.0 }), 100), 100, false);
        let step =
            smoothed(&metered(|frame| Some(if frame > 50 { -5.0 } else { 0.0 }), 100), 100, false);
        for exposures in [&flash, &step] {
            assert!(exposures.windows(2).all(|pair| (pair[0].1 - pair[1].1).abs() < 0.45));
        }
        assert_eq!([flash[20].1, flash[49].1, flash[80].1], [0.0, -5.0, 0.0]);
        assert_eq!([step[20].1, step[50].1, step[80].1], [0.0, -5.0, -5.0]);
        assert!((0..49).all(|row| flash[49 - row].1 == flash[49 + row].1));
    }

    #[test]
    fn dark_frames_have_none_and_loops_close() {
        let lit = |frame: u32| frame.is_multiple_of(2).then_some(f64::from(frame));
        assert_eq!(smoothed(&metered(lit, 6), 6, false).len(), 3);
        assert_eq!(smoothed(&metered(|_| None, 6), 6, true), []);
        let ends = smoothed(&metered(|frame| Some(if frame == 1 { 4.0 } else { 0.0 }), 8), 8, true);
        assert_eq!([ends[7].1, ends[0].1, ends[1].1, ends[2].1], [0.0; 4]);
        let ends =
            smoothed(&metered(|frame| Some(if frame == 1 { -4.0 } else { 0.0 }), 8), 8, true);
        assert_eq!(
            [6, 7, 0, 1, 2, 3].map(|row: usize| ends[row].1),
            [-1.0, -3.0, -4.0, -3.0, -1.0, 0.0]
        );
    }

    /// No frame has more than its own exposure, so none clips more than was metered.
    #[test]
    fn no_frame_is_brighter_than_metered() {
        // No period of the film.
        let noise = |frame: u32| frame * frame * 7919 % 97;
        let one = |frame| {
            let noise = noise(frame);
            (noise > 9).then_some(0.09 * f64::from(noise) - 5.0)
        };
        for n_frames in [1, 2, 7, 30, 100, 400] {
            for is_loop in [false, true] {
                let metered = metered(one, n_frames);
                let lit = metered.iter().filter_map(|&(frame, stops)| Some((frame, stops?)));
                let exposures = smoothed(&metered, n_frames, is_loop);
                assert_eq!(exposures.len(), lit.clone().count());
                for ((frame, own), (other, stops)) in lit.zip(exposures) {
                    assert!(frame == other && stops <= own + 1e-9, "{frame} {own} {stops}");
                }
            }
        }
    }
}
