//! Classes of precision: the errors that a correct program cannot avoid.
//!
//! A program in single precision rounds every number by up to 2⁻²⁴ of it. A rounded number of a
//! question changes the answer by the condition number of the question, and rounded intermediate
//! numbers reach the answer. The README has the formula of the tolerances that follow.

use clap::ValueEnum;

use crate::suite::{Case, distance};

/// A class of precision.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Precision {
    /// IEEE 754 binary64, with the tolerances of the cases.
    #[default]
    Double,
    /// IEEE 754 binary32: input, output, and everything between.
    Single,
}

impl Precision {
    /// The largest allowed [`Case::error`].
    pub fn tolerance(self, case: &Case) -> f64 {
        match self {
            Self::Double => case.tolerance,
            Self::Single => case.single_tolerance,
        }
    }

    /// The known mistakes that give this answer, from a program of this class.
    pub fn recognized<'a>(self, case: &'a Case, answer: &[f64]) -> Vec<&'a str> {
        /// Relative tolerance: a program with a mistake may also print rounded numbers.
        const TOLERANCE: f64 = 1e-5;
        let tolerance = TOLERANCE.max(self.tolerance(case));
        let is_it =
            |wrong: &[f64]| distance(answer, wrong) <= tolerance.min(0.1 * case.error(wrong));
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::suite::topics;

    /// Eight roundings of 2⁻²⁴, times condition numbers by hand: dγ/γ = γ² b² db/b, and D = exp(η)
    /// on the line of motion.
    #[test]
    fn tolerances_follow_from_condition_numbers() {
        let topics = topics().unwrap();
        let cases = || topics.iter().flat_map(|topic| &topic.cases);
        for (question, condition) in [
            ("gamma 0", 1.0),
            ("gamma 0.6", 1.0 + 0.5625),
            ("gamma 0.99", 1.0 + 49.251_256),
            ("doppler_rapidity 5 0", 1.0 + 5.0),
            ("doppler_rapidity 20 180", 1.0 + 20.0),
            ("blackbody_temperature 5800 1", 1.0 + 2.0),
        ] {
            let case = cases().find(|case| case.question().ends_with(question)).expect(question);
            let expected = condition / f64::from(1 << 21);
            let tolerance = Precision::Single.tolerance(case);
            assert!(
                (tolerance / expected - 1.0).abs() < 1e-3,
                "{question}: {tolerance:e}, {expected:e}"
            );
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
}
