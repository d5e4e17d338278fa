//! Options whose numbers change over the film.

use ugpipe::finite;

/// How a number goes from one value to the next.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Ease {
    /// At a constant rate.
    #[default]
    Linear,
    /// Without jumps in its rate, at rest at the first and the last value, and never beyond the
    /// values: a monotone cubic curve (Fritsch and Carlson 1980).
    Smooth,
}

/// The kind of an option's numbers, which decides what lies between two of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// Numbers of any kind.
    Plain,
    /// A velocity, fraction of c. Its rapidity changes in place of its speed, so it stays below 1,
    /// and equal steps look alike.
    Velocity,
}

/// The values of an option over the film.
#[derive(Clone, Debug, PartialEq)]
pub enum Timeline {
    /// The same words in all frames.
    Fixed(Vec<String>),
    /// Numbers at some times.
    Moving {
        /// Times from 0 (first frame) to 1 (last), increasing, and the numbers as given.
        keys: Vec<(f64, Vec<f64>)>,
        quantity: Quantity,
    },
}

impl Timeline {
    /// The values of an option: words, of which numbers may have several values, at equal distances
    /// of time: `-10..10`.
    ///
    /// # Errors
    /// The error in the values.
    pub fn new(words: Vec<String>, quantity: Quantity) -> Result<Self, String> {
        let values = |word: &String| {
            word.split("..").map(|part| finite(part.trim())).collect::<Result<Vec<f64>, _>>()
        };
        // `0...1` is from 0 to 1 for some, and from 0 to .1 for others.
        if let Some(word) = words.iter().find(|word| word.contains("...") && values(word).is_ok()) {
            let (before, after) = word.split_once("...").unwrap_or((word, ""));
            return Err(format!(
                "`{word}` has three dots: write `{before}..{after}` or `{before}..0.{after}`"
            ));
        }
        if !words.iter().any(|word| word.contains("..") && values(word).is_ok()) {
            return Ok(Self::Fixed(words));
        }
        let lists = words.iter().map(values).collect::<Result<Vec<_>, _>>()?;
        let count = lists.iter().map(Vec::len).max().unwrap_or(1);
        if lists.iter().any(|list| list.len() != 1 && list.len() != count) {
            return Err("its numbers have different counts of values".to_owned());
        }
        let at = |key: usize| lists.iter().map(|list| list[key.min(list.len() - 1)]).collect();
        let time = |key: usize| key as f64 / (count - 1) as f64;
        Self::through((0..count).map(|key| (time(key), at(key))).collect(), quantity)
    }

    /// Numbers at some times, which must increase.
    ///
    /// # Errors
    /// The keys have different counts of numbers, or a velocity is not below 1.
    pub fn through(keys: Vec<(f64, Vec<f64>)>, quantity: Quantity) -> Result<Self, String> {
        let n_numbers = keys.first().map_or(0, |(_, numbers)| numbers.len());
        if keys.iter().any(|(_, numbers)| numbers.len() != n_numbers) {
            return Err("its values have different counts of numbers".to_owned());
        }
        if quantity == Quantity::Velocity {
            let fastest = keys.iter().map(|(_, beta)| norm(beta)).find(|&speed| speed >= 1.0);
            if let Some(speed) = fastest {
                return Err(format!("speed is {speed} c: it must be below 1"));
            }
        }
        Ok(Self::Moving { keys, quantity })
    }

    /// True if the numbers change.
    pub fn is_moving(&self) -> bool {
        matches!(self, Self::Moving { .. })
    }

    /// The words of the option at a time from 0 to 1.
    pub fn at(&self, time: f64, ease: Ease) -> Vec<String> {
        match self {
            Self::Fixed(words) => words.clone(),
            Self::Moving { .. } => {
                self.numbers(time, ease).into_iter().map(|n| format!("{n}")).collect()
            }
        }
    }

    /// The numbers of the option at a time from 0 to 1; none unless all its words are numbers.
    pub fn numbers(&self, time: f64, ease: Ease) -> Vec<f64> {
        let (keys, quantity) = match self {
            Self::Fixed(words) => {
                return words
                    .iter()
                    .map(|word| finite(word))
                    .collect::<Result<_, _>>()
                    .unwrap_or_default();
            }
            Self::Moving { keys, quantity } => (keys, *quantity),
        };
        let mut numbers = match given(keys, time) {
            Some(numbers) => numbers.to_vec(),
            None if quantity == Quantity::Velocity => {
                let rapidities: Vec<_> =
                    keys.iter().map(|(at, beta)| (*at, rapidity(beta))).collect();
                let numbers = between(&rapidities, time, ease);
                let rapidity = norm(&numbers);
                scaled(&numbers, if rapidity > 0.0 { libm::tanh(rapidity) / rapidity } else { 1.0 })
            }
            None => between(keys, time, ease),
        };
        // −0 would be printed with its sign.
        numbers.iter_mut().for_each(|number| *number += 0.0);
        numbers
    }
}

fn norm(numbers: &[f64]) -> f64 {
    numbers.iter().fold(0.0, |sum, number| libm::hypot(sum, *number))
}

fn scaled(numbers: &[f64], factor: f64) -> Vec<f64> {
    numbers.iter().map(|number| number * factor).collect()
}

/// A velocity with its rapidity in place of its speed.
fn rapidity(beta: &[f64]) -> Vec<f64> {
    let speed = norm(beta);
    scaled(beta, if speed > 0.0 { libm::atanh(speed) / speed } else { 1.0 })
}

/// The numbers of a key where they hold exactly: at its time, before the first, after the last, and
/// between two equal ones. Interpolation of rapidities would round them.
fn given(keys: &[(f64, Vec<f64>)], time: f64) -> Option<&[f64]> {
    let right = keys.iter().position(|(at, _)| *at >= time).unwrap_or(keys.len().saturating_sub(1));
    let (at, numbers) = keys.get(right)?;
    let is_held = right == 0 || *at <= time || keys[right - 1].1 == *numbers;
    is_held.then_some(numbers)
}

/// All numbers at a time, each on its own curve.
fn between(keys: &[(f64, Vec<f64>)], time: f64, ease: Ease) -> Vec<f64> {
    let n_numbers = keys.first().map_or(0, |(_, numbers)| numbers.len());
    let curve_of = |idx: usize| {
        let points: Vec<[f64; 2]> = keys.iter().map(|(time, row)| [*time, row[idx]]).collect();
        curve(&points, time, ease)
    };
    (0..n_numbers).map(curve_of).collect()
}

/// The value of a curve through points at a time; before the first and after the last point it is
/// constant.
fn curve(points: &[[f64; 2]], time: f64, ease: Ease) -> f64 {
    let after = points.iter().position(|[at, _]| *at >= time);
    let (left, right) = match after {
        Some(0) => return points[0][1],
        Some(right) => (right - 1, right),
        None => return points.last().map_or(0.0, |[_, value]| *value),
    };
    let [[t0, y0], [t1, y1]] = [points[left], points[right]];
    let (step, u) = (t1 - t0, (time - t0) / (t1 - t0));
    if u == 1.0 {
        return y1;
    }
    match ease {
        Ease::Linear => y0 + u * (y1 - y0),
        Ease::Smooth => {
            let [m0, m1] = [left, right].map(|at| step * slope(points, at));
            let (u2, u3) = (u * u, u * u * u);
            (2.0 * u3 - 3.0 * u2 + 1.0) * y0
                + (u3 - 2.0 * u2 + u) * m0
                + (3.0 * u2 - 2.0 * u3) * y1
                + (u3 - u2) * m1
        }
    }
}

/// The slope at a point: 0 at ends and extremes, otherwise the weighted harmonic mean of the slopes
/// on both sides, with which the curve stays monotone between points (Fritsch and Butland 1984).
fn slope(points: &[[f64; 2]], at: usize) -> f64 {
    let between = |left: usize| {
        let ([t0, y0], [t1, y1]) = (points[left], points[left + 1]);
        (t1 - t0, (y1 - y0) / (t1 - t0))
    };
    if at == 0 || at + 1 == points.len() {
        return 0.0;
    }
    let ((h0, d0), (h1, d1)) = (between(at - 1), between(at));
    if d0 * d1 <= 0.0 {
        return 0.0;
    }
    let [w0, w1] = [2.0 * h1 + h0, h1 + 2.0 * h0];
    (w0 + w1) / (w0 / d0 + w1 / d1)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn timeline(words: &[&str], quantity: Quantity) -> Timeline {
        Timeline::new(words.iter().map(|word| (*word).to_owned()).collect(), quantity).unwrap()
    }

    #[test]
    fn numbers_go_through_their_values() {
        let check = |words: &[&str], time: f64, expected: &str| {
            assert_eq!(timeline(words, Quantity::Plain).at(time, Ease::Linear).join(" "), expected);
        };
        check(&["-10..10"], 0.0, "-10");
        check(&["-10..10"], 0.25, "-5");
        check(&["-10..10"], 1.0, "10");
        check(&["0", "0..8", "1"], 0.5, "0 4 1");
        check(&["0..4", "0..8", "1..1"], 0.25, "1 2 1");
        check(&["0..0.5", "-1..-.5"], 0.5, "0.25 -0.75");
        check(&["0..1..0"], 0.75, "0.5");
        check(&["center"], 0.5, "center");
        check(&["../a..b"], 0.5, "../a..b");
        check(&["1"], 0.5, "1");
        check(&["0 .. 8", "1"], 0.5, "4 1");
    }

    #[test]
    fn velocities_change_by_rapidity() {
        let speeds = timeline(&["0", "0..0.99", "0"], Quantity::Velocity);
        assert_eq!(speeds.at(1.0, Ease::Linear)[1], "0.99");
        for (time, expected) in [(0.0, "0 0 0.3"), (0.5, "0.9 0.1 0.3"), (1.0, "0.7 0.7 -0.1")] {
            let words = ["0..0.9..0.7", "0..0.1..0.7", ".3..0.3..-.1"];
            assert_eq!(
                timeline(&words, Quantity::Velocity).at(time, Ease::Smooth).join(" "),
                expected
            );
        }
        assert_eq!(
            timeline(&["0..0", ".9", "0"], Quantity::Velocity).at(0.3, Ease::Linear)[1],
            "0.9"
        );
        // Half the rapidity of 0.99: Bondi's k = √199 becomes its root.
        let half = speeds.numbers(0.5, Ease::Linear)[1];
        let k = 199f64.sqrt();
        assert!((half - (k - 1.0) / (k + 1.0)).abs() < 1e-15, "{half}");
        let turned = timeline(&[".9..0", "0..0.9", "0"], Quantity::Velocity);
        for step in 0..=10 {
            assert!(norm(&turned.numbers(f64::from(step) / 10.0, Ease::Smooth)) < 1.0);
        }
        let fast = Timeline::new(
            vec!["0".to_owned(), "0".to_owned(), "0..1".to_owned()],
            Quantity::Velocity,
        );
        assert_eq!(fast, Err("speed is 1 c: it must be below 1".to_owned()));
    }

    #[test]
    fn smooth_curves_stay_between_their_points() {
        let points = [[0.0, 0.0], [0.2, 5.0], [0.5, 5.5], [0.6, 1.0], [1.0, 1.0]];
        let mut before = 0.0;
        for step in 0..=1000 {
            let time = f64::from(step) / 1000.0;
            let value = curve(&points, time, Ease::Smooth);
            let segment = points.windows(2).find(|pair| time <= pair[1][0]).unwrap();
            let (low, high) = (segment[0][1].min(segment[1][1]), segment[0][1].max(segment[1][1]));
            assert!((low - 1e-12..=high + 1e-12).contains(&value), "{time}: {value}");
            // The steepest secant is 45; a cubic may be three times as steep.
            assert!((value - before).abs() < 0.14, "{time}");
            before = value;
        }
        for [time, value] in points {
            assert_eq!(curve(&points, time, Ease::Smooth), value);
        }
    }

    #[test]
    fn what_is_wrong() {
        let error = |words: &[&str]| {
            let words = words.iter().map(|word| (*word).to_owned()).collect();
            Timeline::new(words, Quantity::Plain).unwrap_err()
        };
        assert_eq!(error(&["0..1", "0..1..2"]), "its numbers have different counts of values");
        assert_eq!(error(&["0..1", "center"]), "not a finite number");
        assert_eq!(error(&["0", "0...9"]), "`0...9` has three dots: write `0..9` or `0..0.9`");
    }
}
