//! The cases: what is asked, and what is right.

use std::fmt;

/// One file for each topic, T01 to T36.
const FILES: [&str; 36] = [
    include_str!("../cases/T01.tsv"),
    include_str!("../cases/T02.tsv"),
    include_str!("../cases/T03.tsv"),
    include_str!("../cases/T04.tsv"),
    include_str!("../cases/T05.tsv"),
    include_str!("../cases/T06.tsv"),
    include_str!("../cases/T07.tsv"),
    include_str!("../cases/T08.tsv"),
    include_str!("../cases/T09.tsv"),
    include_str!("../cases/T10.tsv"),
    include_str!("../cases/T11.tsv"),
    include_str!("../cases/T12.tsv"),
    include_str!("../cases/T13.tsv"),
    include_str!("../cases/T14.tsv"),
    include_str!("../cases/T15.tsv"),
    include_str!("../cases/T16.tsv"),
    include_str!("../cases/T17.tsv"),
    include_str!("../cases/T18.tsv"),
    include_str!("../cases/T19.tsv"),
    include_str!("../cases/T20.tsv"),
    include_str!("../cases/T21.tsv"),
    include_str!("../cases/T22.tsv"),
    include_str!("../cases/T23.tsv"),
    include_str!("../cases/T24.tsv"),
    include_str!("../cases/T25.tsv"),
    include_str!("../cases/T26.tsv"),
    include_str!("../cases/T27.tsv"),
    include_str!("../cases/T28.tsv"),
    include_str!("../cases/T29.tsv"),
    include_str!("../cases/T30.tsv"),
    include_str!("../cases/T31.tsv"),
    include_str!("../cases/T32.tsv"),
    include_str!("../cases/T33.tsv"),
    include_str!("../cases/T34.tsv"),
    include_str!("../cases/T35.tsv"),
    include_str!("../cases/T36.tsv"),
];

/// A topic of the suite and its cases.
#[derive(Clone, Debug, PartialEq)]
pub struct Topic {
    /// `T01` and so on.
    pub name: String,
    /// What it is about.
    pub title: String,
    /// At least one.
    pub cases: Vec<Case>,
}

/// A question with its right answer.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    /// `T01.01` and so on; none occurs twice.
    pub id: String,
    /// What is asked for, one word.
    pub kind: String,
    /// The numbers given, as they stand in the file.
    pub given: Vec<String>,
    /// The right numbers.
    pub expected: Vec<f64>,
    /// How far an answer may be off: see [`Case::error`].
    pub tolerance: f64,
    /// Wrong answers that tell a known mistake, `M1` and so on.
    pub mistakes: Vec<(String, Vec<f64>)>,
    /// Author, year, place.
    pub source: String,
}

/// What is wrong with a file of cases.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BadCase {
    /// The line, as it stands.
    pub line: String,
    /// What is wrong with it.
    pub what: &'static str,
}

impl fmt::Display for BadCase {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} in `{}`", self.what, self.line)
    }
}

impl std::error::Error for BadCase {}

/// All topics, in order.
///
/// # Errors
/// The files belong to the program, so there are none unless they were edited badly.
pub fn topics() -> Result<Vec<Topic>, BadCase> {
    FILES.into_iter().map(topic).collect()
}

/// A file: its first line is `# T01 title`; other lines that begin with `#` are not cases.
fn topic(text: &str) -> Result<Topic, BadCase> {
    let head = text.lines().next().unwrap_or_default();
    let bad = |what| BadCase { line: head.to_string(), what };
    let (name, title) = head
        .strip_prefix("# ")
        .and_then(|head| head.split_once(' '))
        .ok_or_else(|| bad("the first line is not `# T01 title`"))?;
    let rows = text.lines().filter(|line| !line.starts_with('#'));
    let cases = rows.map(case).collect::<Result<Vec<_>, _>>()?;
    if cases.is_empty() || !cases.iter().all(|case| case.id.split('.').next() == Some(name)) {
        return Err(bad("no cases, or cases of another topic"));
    }
    Ok(Topic { name: name.to_string(), title: title.to_string(), cases })
}

fn case(line: &str) -> Result<Case, BadCase> {
    let bad = |what| BadCase { line: line.to_string(), what };
    let Ok([id, question, expected, tolerance, mistakes, source]) =
        <[&str; 6]>::try_from(line.split('\t').collect::<Vec<_>>())
    else {
        return Err(bad("not six columns"));
    };
    let numbers = |text: &str| numbers(text).ok_or_else(|| bad("not numbers"));
    let mut words = question.split(' ').map(str::to_string);
    let mistakes = match mistakes {
        "-" => Vec::new(),
        told => told
            .split("; ")
            .map(|told| {
                let (name, values) =
                    told.split_once(": ").ok_or_else(|| bad("a mistake is `M1: numbers`"))?;
                Ok((name.to_string(), numbers(values)?))
            })
            .collect::<Result<_, _>>()?,
    };
    let case = Case {
        id: id.to_string(),
        kind: words.next().unwrap_or_default(),
        given: words.collect(),
        expected: numbers(expected)?,
        tolerance: tolerance.parse().map_err(|_| bad("no tolerance"))?,
        mistakes,
        source: source.to_string(),
    };
    if case.expected.is_empty() || case.inputs().is_none() || case.source.is_empty() {
        return Err(bad("no answer, no numbers or no source"));
    }
    Ok(case)
}

fn numbers(text: &str) -> Option<Vec<f64>> {
    text.split(' ').map(|word| word.parse().ok().filter(|number: &f64| number.is_finite())).collect()
}

impl Case {
    /// The numbers given, rounded to double precision.
    pub fn inputs(&self) -> Option<Vec<f64>> {
        self.given.iter().map(|word| word.parse().ok()).collect()
    }

    /// The line that asks: id, kind, numbers.
    pub fn question(&self) -> String {
        [&[self.id.clone(), self.kind.clone()][..], &self.given].concat().join(" ")
    }

    /// How far `answer` is off: its largest difference, relative to the largest of the right numbers, or as it is where all
    /// of these are 0. Infinite if it has not as many numbers.
    pub fn error(&self, answer: &[f64]) -> f64 {
        distance(answer, &self.expected)
    }

    /// The known mistakes that give this answer.
    pub fn recognized(&self, answer: &[f64]) -> Vec<&str> {
        /// Programs that make a mistake may be rounded as well.
        const ALIKE: f64 = 1e-5;
        let mut found: Vec<&str> = self
            .mistakes
            .iter()
            .filter(|(_, wrong)| distance(answer, wrong) <= ALIKE.min(0.1 * self.error(wrong)))
            .map(|(name, _)| name.as_str())
            .collect();
        found.dedup();
        let is_close = self.error(answer) < 1e-4;
        if found.is_empty() && is_close && answer.iter().all(|&value| is_single_precision(value)) {
            found.push("M16");
        }
        found
    }
}

/// See [`Case::error`].
fn distance(answer: &[f64], right: &[f64]) -> f64 {
    if answer.len() != right.len() {
        return f64::INFINITY;
    }
    let largest = right.iter().fold(0.0, |largest: f64, value| largest.max(value.abs()));
    let scale = if largest > 0.0 { largest } else { 1.0 };
    let gaps = answer.iter().zip(right).map(|(answer, right)| (answer - right).abs());
    // Not `f64::max`, which would lose a NaN.
    gaps.fold(0.0, |worst, gap| if gap <= worst { worst } else { gap }) / scale
}

/// True of what a program prints that computes in single precision: f32 knows it by so many digits.
fn is_single_precision(value: f64) -> bool {
    (value as f32).to_string().parse() == Ok(value) || f64::from(value as f32) == value
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_read_and_mistakes_named() {
        let line = "T01.01\tgamma 0.6\t1.25\t1e-12\tM2: 1.5625; M2: 0.64\tEinstein 1905";
        let case = case(line).unwrap();
        assert_eq!(case.question(), "T01.01 gamma 0.6");
        assert_eq!(case.error(&[1.25]), 0.0);
        assert_eq!(case.error(&[1.26]), 0.008000000000000007);
        assert_eq!(case.error(&[1.25, 0.0]), f64::INFINITY);
        assert!(case.error(&[f64::NAN]).is_nan());
        assert_eq!(case.recognized(&[1.5625]), ["M2"]);
        assert_eq!(case.recognized(&[1.5]), [""; 0]);
        assert_eq!(case.recognized(&[1.2500001]), ["M16"]);
        assert_eq!(case.recognized(&[1.25000012345]), [""; 0]);
    }

    #[test]
    fn bad_files_are_refused() {
        let refused = |text: &str| topic(text).unwrap_err().what;
        assert_eq!(refused(""), "the first line is not `# T01 title`");
        assert_eq!(refused("# T01 a title\n"), "no cases, or cases of another topic");
        assert_eq!(refused("# T01 a title\nT01.1\tgamma 0\n"), "not six columns");
        assert_eq!(refused("# T01 a title\nT01.1\tgamma 0\tx\t0\t-\tme\n"), "not numbers");
        assert_eq!(refused("# T01 a title\nT01.1\tgamma 0\t1\t0\tM1\tme\n"), "a mistake is `M1: numbers`");
        assert_eq!(
            refused("# T01 a title\nT01.1\tgamma z\t1\t0\t-\tme\n"),
            "no answer, no numbers or no source"
        );
    }
}
