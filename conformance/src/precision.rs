//! Classes of precision: the errors that a correct program cannot avoid.
//!
//! A program in single precision rounds every number by up to 2⁻²⁴ of it. Two things follow, which
//! [`Precision::tolerance`] computes for each question:
//!
//! - A rounded number of the question changes the answer by the condition number of the question.
//!   It is measured: each number is changed by 2⁻²⁴ of it in both directions.
//! - Rounded intermediate numbers reach the answer. They count with the size of these: that of the
//!   answer itself, or of the numbers of which the answer is the difference.

use crate::answer::answer;
use crate::suite::{Case, distance};

/// A class of precision.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Precision {
    /// IEEE 754 binary64, with the tolerances of the cases.
    #[default]
    Double,
    /// IEEE 754 binary32: input, output, and everything between.
    Single,
}

/// Half a unit in the last place of a single-precision number, relative to it.
const ROUNDING: f64 = 1.0 / (1 << 24) as f64;

/// Roundings of each kind that a program may add up. The textbook formulas in
/// `tests/precision.rs` need up to 2.4; others take more steps.
const ROUNDINGS: f64 = 8.0;

impl Precision {
    /// All classes.
    pub const ALL: [Self; 2] = [Self::Double, Self::Single];

    /// The name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Double => "double",
            Self::Single => "single",
        }
    }

    /// The class of this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|class| class.name() == name)
    }

    /// The largest allowed [`Case::error`].
    pub fn tolerance(self, case: &Case) -> f64 {
        match self {
            Self::Double => case.tolerance,
            Self::Single => case.tolerance.max(single_tolerance(case)),
        }
    }

    /// The known mistakes that give this answer, from a program of this class.
    pub fn recognized<'a>(self, case: &'a Case, answer: &[f64]) -> Vec<&'a str> {
        /// Relative tolerance: a program with a mistake may also print rounded numbers.
        const TOLERANCE: f64 = 1e-5;
        let tolerance = TOLERANCE.max(self.tolerance(case));
        let is_it = |wrong: &[f64]| distance(answer, wrong) <= tolerance.min(0.1 * case.error(wrong));
        let found = case.mistakes.iter().filter(|(_, wrong)| is_it(wrong));
        let mut names: Vec<&str> = found.map(|(name, _)| name.as_str()).collect();
        names.dedup();
        // In single precision, rounded digits are no mistake.
        let is_rounded = self == Self::Double
            && case.error(answer) < 1e-4
            && answer.iter().all(|&value| is_single_precision(value));
        if names.is_empty() && is_rounded {
            names.push("M16");
        }
        names
    }
}

/// Is this a number that a program in single precision would print: the digits of an f32?
fn is_single_precision(value: f64) -> bool {
    (value as f32).to_string().parse() == Ok(value) || f64::from(value as f32) == value
}

fn single_tolerance(case: &Case) -> f64 {
    let given = case.inputs().unwrap_or_default();
    let Some(exact) = answer(&case.kind, &given) else { return case.tolerance };
    let scale = case.scale();
    let intermediate = ROUNDING * intermediate(&case.kind, &given, &case.expected) / scale;
    let inputs = (0..given.len()).filter(|&idx| !is_count(&case.kind, idx));
    let from_inputs: f64 = inputs.map(|idx| change(&case.kind, &given, idx, &exact)).sum::<f64>() / scale;
    ROUNDINGS * (intermediate + from_inputs)
}

/// The largest change of the answer when one number of the question is rounded.
fn change(kind: &str, given: &[f64], idx: usize, exact: &[f64]) -> f64 {
    let rounded = [-ROUNDING, ROUNDING].into_iter().filter_map(|rounding| {
        let mut given = given.to_vec();
        given[idx] *= 1.0 + rounding;
        answer(kind, &given)
    });
    let differences = rounded.flat_map(|answer| {
        answer.into_iter().zip(exact).map(|(rounded, exact)| (rounded - exact).abs()).collect::<Vec<_>>()
    });
    differences.fold(0.0, f64::max)
}

/// True for whole numbers, which a program does not round: a number of chords, a power.
fn is_count(kind: &str, idx: usize) -> bool {
    matches!((kind, idx), ("edge_chord_error", 3) | ("sky_mean", 1))
}

/// The size of the intermediate numbers whose rounding reaches the answer, in units of the answer.
fn intermediate(kind: &str, given: &[f64], expected: &[f64]) -> f64 {
    const ARCSECONDS: f64 = 3600.0;
    let largest = expected.iter().fold(0.0, |largest: f64, value| largest.max(value.abs()));
    match (kind, given) {
        // Answers that are the difference of larger numbers. The quadratic equation of the emission
        // time subtracts a root from p·v, and divides by 1 − v².
        ("retarded" | "source_distances", &[px, py, pz, x, y, z]) => {
            2.0 * (px * x + py * y + pz * z).abs() / (1.0 - x * x - y * y - z * z)
        }
        ("aberration_shift", &[_, theta]) => theta.abs(),
        ("aberration_constant", _) => 90.0 * ARCSECONDS,
        ("terrell", &[_, theta]) => largest + theta.abs(),
        ("doppler_shift", _) => 1.0,
        ("dipole", &[kelvin, _]) => kelvin,
        // The angle between two unit vectors.
        ("aberration_arcsec", _) => 1.0_f64.to_degrees() * ARCSECONDS,
        ("edge_chord_error", &[speed, z, half, _]) => {
            answer("edge_x", &[speed, z, half]).map_or(largest, |x| x[0].abs())
        }
        // Of the mean of Dᵏ, the part near the motion, where 1 − b is a difference.
        ("sky_mean", &[speed, power]) => largest * power / (1.0 - speed.abs()),
        // Into the frame of the plate and back: a factor D² at most, and its inverse.
        ("slab_out", &[_, _, _, x, y, z, ..]) => {
            let speed = (x * x + y * y + z * z).sqrt();
            (1.0 + speed) / (1.0 - speed)
        }
        // Times and places of which the position relative to the eye is the difference.
        ("accelerated" | "spinning" | "orbiting" | "riding", &[.., t, x, y, z]) => {
            2.0 * (largest + [t, x, y, z].map(f64::abs).into_iter().sum::<f64>())
        }
        _ => {
            let angles = angles(kind).iter().filter_map(|&idx| expected.get(idx));
            largest + angles.map(|&degrees| arc_cosine(degrees)).fold(0.0, f64::max)
        }
    }
    .max(largest)
}

/// The places of angles in the answer that a program may compute as the arc cosine of a product of
/// two directions.
fn angles(kind: &str) -> &'static [usize] {
    match kind {
        "aberration" | "headlight" | "mirror_angle" | "wigner" | "no_shift_angle" => &[0],
        "circle_image" => &[0, 1],
        "sphere_outline" => &[0, 1, 2],
        _ => &[],
    }
}

/// Degrees of an arc cosine for each unit of its argument: the slope 1/sin, and near 0° and 180°
/// the angle whose cosine is a rounding away from 1.
fn arc_cosine(degrees: f64) -> f64 {
    let slope = 1.0 / libm::sin(degrees.to_radians()).abs();
    slope.min((2.0 / ROUNDING).sqrt()).to_degrees()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::suite::topics;

    fn tolerance(question: &str) -> f64 {
        let topics = topics().unwrap();
        let cases = || topics.iter().flat_map(|topic| &topic.cases);
        let case = cases().find(|case| case.question().ends_with(question)).expect(question);
        Precision::Single.tolerance(case)
    }

    /// Condition numbers by hand: dγ/γ = γ² b² db/b, and D = exp(η) on the line of motion.
    #[test]
    fn tolerances_follow_from_condition_numbers() {
        for (question, condition) in [
            ("gamma 0", 1.0),
            ("gamma 0.6", 1.0 + 0.5625),
            ("gamma 0.99", 1.0 + 49.251_256),
            ("doppler_rapidity 5 0", 1.0 + 5.0),
            ("doppler_rapidity 20 180", 1.0 + 20.0),
            ("blackbody_temperature 5800 1", 1.0 + 2.0),
        ] {
            let expected = ROUNDINGS * ROUNDING * condition;
            let tolerance = tolerance(question);
            assert!((tolerance / expected - 1.0).abs() < 1e-3, "{question}: {tolerance:e}, {expected:e}");
        }
    }

    #[test]
    fn mistakes_are_recognized() {
        let topics = topics().unwrap();
        let case = &topics[0].cases[3];
        assert_eq!(case.question(), "T01.04 gamma 0.5");
        for (answer, double, single) in [
            (1.333_333_3, &["M2"][..], &["M2"][..]),
            (1.5, &[], &[]),
            // Digits of a number in single precision, nearly correct.
            (1.154_701_5, &["M16"], &[]),
            (1.154_701_512_345, &[], &[]),
        ] {
            assert_eq!(Precision::Double.recognized(case, &[answer]), double, "{answer}");
            assert_eq!(Precision::Single.recognized(case, &[answer]), single, "{answer}");
        }
    }

    #[test]
    fn classes_have_names() {
        for class in Precision::ALL {
            assert_eq!(Precision::named(class.name()), Some(class));
        }
        assert_eq!(Precision::named("half"), None);
    }
}
