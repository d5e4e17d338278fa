//! Programs in single precision pass with `-precision single`, and known mistakes do not.

use ugconformance::precision::Precision;
use ugconformance::scorecard::{Answers, Scorecard};
use ugconformance::suite::{Case, topics};

/// Answers every question with a function of its kind and numbers; no entry where there is none.
fn answers(respond: impl Fn(&Case, &[f64]) -> Option<Vec<f64>>) -> Answers {
    let topics = topics().expect("the files of cases are in order");
    let cases = topics.iter().flat_map(|topic| &topic.cases);
    cases.filter_map(|case| Some((case.id.clone(), respond(case, &case.inputs()?)?))).collect()
}

fn counts(answers: &Answers, precision: Precision) -> ([usize; 3], String) {
    let topics = topics().expect("the files of cases are in order");
    let card = Scorecard::new(&topics, answers, precision);
    (card.counts(), card.to_string())
}

fn rounded(values: &[f64]) -> Vec<f64> {
    values.iter().map(|&value| f64::from(value as f32)).collect()
}

/// The least a program in single precision rounds: what it prints.
#[test]
fn rounded_numbers_pass_in_single_precision() {
    let printed = answers(|case, _| Some(rounded(&case.expected)));
    let n = printed.len();
    let (single, card) = counts(&printed, Precision::Single);
    assert_eq!(single, [n, 0, 0], "{card}");
    let ([_, failed, _], card) = counts(&printed, Precision::Double);
    assert!(failed >= 200, "{failed}");
    assert!(card.contains("looks like M16"), "{card}");
}

/// Every mistake whose number is farther from the expected one than single precision reaches is
/// wrong there, too, and has its name, also if its own numbers are rounded.
#[test]
fn mistakes_are_found_in_single_precision() {
    let topics = topics().unwrap();
    let (mut n_found, mut n_hidden) = (0, Vec::new());
    for case in topics.iter().flat_map(|topic| &topic.cases) {
        let tolerance = Precision::Single.tolerance(case);
        assert!(tolerance >= case.tolerance, "{}", case.id);
        for (name, wrong) in &case.mistakes {
            let wrong = rounded(wrong);
            if case.error(&wrong) <= tolerance {
                n_hidden.push(format!("{} {name}", case.id));
                continue;
            }
            n_found += 1;
            if 0.1 * case.error(&wrong) > tolerance {
                let names = Precision::Single.recognized(case, &wrong);
                assert!(names.contains(&name.as_str()), "{}: {name}", case.id);
            }
        }
    }
    assert!(n_found >= 300, "{n_found}");
    assert_eq!(n_hidden.join(", "), HIDDEN, "{n_found}");
}

/// Mistakes that single precision hides: correct to first order at the speeds of planets, b from
/// tanh η at η = 0.5, and proper time instead of coordinate time after 0.001.
const HIDDEN: &str = "T17.01 M9, T17.02 M9, T18.03 M9, T18.04 M9, T18.05 M9, T18.06 M9, T19.37 M16, T19.38 M16, \
    T19.39 M16, T24.01 M9, T30.05 M11";

/// Rounding alone is no mistake.
#[test]
fn rounding_does_not_look_like_a_mistake() {
    let topics = topics().unwrap();
    let case = &topics[0].cases[3];
    assert_eq!(case.question(), "T01.04 gamma 0.5");
    // Correct to 4 digits: wrong in both classes, but not as a mistake that has a name.
    let wrong = [f64::from(1.1548_f32)];
    assert!(case.error(&wrong) > Precision::Single.tolerance(case));
    assert_eq!(Precision::Double.recognized(case, &wrong), ["M16"]);
    assert_eq!(Precision::Single.recognized(case, &wrong), [""; 0]);
}
