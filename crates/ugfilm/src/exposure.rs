//! Exposures that follow the light of a film.

/// The exposure that is metered in a frame, in stops; `None` if nothing in it is lit.
pub type Metered = (u32, Option<f64>);

/// Most frames on either side of a frame that its exposure depends on, about half a second.
const REACH: f64 = 12.0;

/// Frames of a film for one of that reach, so that short films follow as well.
const PER_REACH: f64 = 8.0;

/// Smooths exposures that were metered in single frames, so that a film does not flicker: each is
/// the mean of those around it, with weights that fall off linearly over an eighth of the film, 12
/// frames at most. They depend on the metered exposures alone, and are rounded to hundredths of a
/// stop. `is_loop`: the first frame follows the last one. Frames in which nothing is lit have none.
pub fn smoothed(metered: &[Metered], n_frames: u32, is_loop: bool) -> Vec<(u32, f64)> {
    let n_rows = metered.len() as i64;
    let per_row = f64::from(n_frames) / metered.len().max(1) as f64;
    let reach = (REACH.min(f64::from(n_frames) / PER_REACH) / per_row).round().max(1.0) as i64;
    let smooth = |(row, &(frame, stops)): (i64, &Metered)| {
        let stops = stops?;
        // Differences from its own exposure: the mean of equal numbers is exact.
        let (mut sum, mut weights) = (0.0, 0.0);
        for step in -reach..=reach {
            let other = if is_loop { (row + step).rem_euclid(n_rows) } else { row + step };
            let other = usize::try_from(other).ok().and_then(|other| metered.get(other)?.1);
            if let Some(other) = other {
                let weight = (1 + reach - step.abs()) as f64;
                (sum, weights) = (sum + weight * (other - stops), weights + weight);
            }
        }
        Some((frame, (100.0 * (stops + sum / weights)).round() / 100.0))
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
        let middle = slope.iter().filter(|(frame, _)| (13..=88).contains(frame));
        assert!(
            middle.clone().all(|&(frame, stops)| (stops - 0.1 * f64::from(frame)).abs() < 0.006)
        );
        assert_eq!(middle.count(), 76);
    }

    /// A flash of one frame changes the exposure little, a step changes it slowly, and both as much
    /// in a film that is played backwards.
    #[test]
    fn exposures_do_not_flicker() {
        let flash =
            smoothed(&metered(|frame| Some(if frame == 50 { -5.0 } else { 0.0 }), 100), 100, false);
        let step =
            smoothed(&metered(|frame| Some(if frame > 50 { -5.0 } else { 0.0 }), 100), 100, false);
        for exposures in [&flash, &step] {
            assert!(exposures.windows(2).all(|pair| (pair[0].1 - pair[1].1).abs() < 0.45));
        }
        assert!(flash.iter().all(|(_, stops)| *stops > -0.45));
        assert_eq!([step[20].1, step[80].1], [0.0, -5.0]);
        assert!((0..49).all(|row| flash[49 - row].1 == flash[49 + row].1));
    }

    #[test]
    fn dark_frames_have_none_and_loops_close() {
        let lit = |frame: u32| frame.is_multiple_of(2).then_some(f64::from(frame));
        assert_eq!(smoothed(&metered(lit, 6), 6, false).len(), 3);
        assert_eq!(smoothed(&metered(|_| None, 6), 6, true), []);
        let ends = smoothed(&metered(|frame| Some(if frame == 1 { 4.0 } else { 0.0 }), 8), 8, true);
        assert_eq!([ends[7].1, ends[0].1, ends[1].1, ends[2].1], [1.0, 2.0, 1.0, 0.0]);
    }
}
