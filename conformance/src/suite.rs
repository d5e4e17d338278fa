//! The cases: questions and their expected answers.

use std::collections::BTreeMap;

macro_rules! files {
    ($($topic:literal)*) => { [$(include_str!(concat!("../cases/T", $topic, ".tsv"))),*] };
}

/// Id and question of a case, and its tolerance in single precision, where that is larger.
const SINGLE: &str = include_str!("../single.tsv");

/// One file for each topic.
const FILES: [&str; 38] = files! {
    "01" "02" "03" "04" "05" "06" "07" "08" "09" "10" "11" "12" "13" "14" "15" "16" "17" "18" "19"
    "20" "21" "22" "23" "24" "25" "26" "27" "28" "29" "30" "31" "32" "33" "34" "35" "36" "37" "38"
};

/// A topic of the suite and its cases.
#[derive(Clone, Debug, PartialEq)]
pub struct Topic {
    /// `T01` and so on.
    pub name: String,
    /// Its title.
    pub title: String,
    /// At least one.
    pub cases: Vec<Case>,
}

/// A question with its expected answer.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    /// `T01.01` and so on; unique.
    pub id: String,
    /// The kind of question, one word.
    pub kind: String,
    /// The numbers given, as written in the file.
    pub given: Vec<String>,
    /// The expected numbers.
    pub expected: Vec<f64>,
    /// The largest allowed [`Case::error`] of a program in double precision.
    pub tolerance: f64,
    /// The largest allowed [`Case::error`] of a program in single precision.
    pub single_tolerance: f64,
    /// Wrong answers that known mistakes give, `M1` and so on.
    pub mistakes: Vec<(String, Vec<f64>)>,
    /// Source of the law: author, year, section.
    pub source: String,
}

/// All topics, in order.
///
/// # Errors
/// A file of cases has an invalid line. The files are part of the program, so a test excludes this.
pub fn topics() -> Result<Vec<Topic>, String> {
    let mut topics = FILES.into_iter().map(topic).collect::<Result<Vec<_>, _>>()?;
    let mut single = single_tolerances(SINGLE)?;
    for case in topics.iter_mut().flat_map(|topic| &mut topic.cases) {
        case.single_tolerance = single.remove(case.question().as_str()).unwrap_or(case.tolerance);
    }
    match single.into_keys().next() {
        Some(line) => Err(error("no such question", line)),
        None => Ok(topics),
    }
}

/// The message for an invalid line of a file of cases.
fn error(what: &str, line: &str) -> String {
    format!("{what} in `{line}`")
}

/// The tolerances in single precision, by question.
fn single_tolerances(text: &str) -> Result<BTreeMap<&str, f64>, String> {
    let mut tolerances = BTreeMap::new();
    for line in text.lines().filter(|line| !line.starts_with('#')) {
        let bad = || error("not a question and a tolerance", line);
        let (question, tolerance) = line.split_once('\t').ok_or_else(bad)?;
        tolerances.insert(question, tolerance.parse().map_err(|_| bad())?);
    }
    Ok(tolerances)
}

/// Parses a file: its first line is `# T01 title`; other lines that begin with `#` are comments.
fn topic(text: &str) -> Result<Topic, String> {
    let head = text.lines().next().unwrap_or_default();
    let bad = |what| error(what, head);
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

fn case(line: &str) -> Result<Case, String> {
    let bad = |what| error(what, line);
    let Ok([id, question, expected, tolerance, mistakes, source]) =
        <[&str; 6]>::try_from(line.split('\t').collect::<Vec<_>>())
    else {
        return Err(bad("not six columns"));
    };
    let numbers = |text: &str| numbers(text).ok_or_else(|| bad("not numbers"));
    let mut words = question.split(' ').map(str::to_string);
    let mistakes = match mistakes {
        "-" => Vec::new(),
        list => list
            .split("; ")
            .map(|mistake| {
                let (name, values) =
                    mistake.split_once(": ").ok_or_else(|| bad("a mistake is `M1: numbers`"))?;
                Ok((name.to_string(), numbers(values)?))
            })
            .collect::<Result<_, String>>()?,
    };
    let tolerance = tolerance.parse().map_err(|_| bad("no tolerance"))?;
    let case = Case {
        id: id.to_string(),
        kind: words.next().unwrap_or_default(),
        given: words.collect(),
        expected: numbers(expected)?,
        tolerance,
        single_tolerance: tolerance,
        mistakes,
        source: source.to_string(),
    };
    if case.expected.is_empty() || case.inputs().is_none() || case.source.is_empty() {
        return Err(bad("no answer, no numbers or no source"));
    }
    Ok(case)
}

fn numbers(text: &str) -> Option<Vec<f64>> {
    text.split(' ')
        .map(|word| word.parse().ok().filter(|number: &f64| number.is_finite()))
        .collect()
}

impl Case {
    /// The numbers given, rounded to double precision.
    pub fn inputs(&self) -> Option<Vec<f64>> {
        self.given.iter().map(|word| word.parse().ok()).collect()
    }

    /// The question as a line: id, kind, numbers.
    pub fn question(&self) -> String {
        [&[self.id.clone(), self.kind.clone()][..], &self.given].concat().join(" ")
    }

    /// The error of `answer`: its largest difference from the expected numbers, relative to the
    /// largest of these, or absolute if these are all 0. Infinite if the count of numbers differs.
    pub fn error(&self, answer: &[f64]) -> f64 {
        distance(answer, &self.expected)
    }
}

/// See [`Case::error`].
pub(crate) fn distance(answer: &[f64], expected: &[f64]) -> f64 {
    if answer.len() != expected.len() {
        return f64::INFINITY;
    }
    let errors = answer.iter().zip(expected).map(|(answer, expected)| (answer - expected).abs());
    // Not `f64::max`, which ignores NaN.
    errors.fold(0.0, |worst, error| if error <= worst { worst } else { error }) / scale(expected)
}

/// The largest of the numbers, or 1 if all are 0.
fn scale(expected: &[f64]) -> f64 {
    let largest = expected.iter().fold(0.0, |largest: f64, value| largest.max(value.abs()));
    if largest > 0.0 { largest } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cases_are_parsed() {
        let line = "T01.01\tgamma 0.6\t1.25\t1e-12\tM2: 1.5625; M2: 0.64\tEinstein 1905";
        let case = case(line).unwrap();
        assert_eq!(case.question(), "T01.01 gamma 0.6");
        assert_eq!(case.error(&[1.25]), 0.0);
        assert_eq!(case.error(&[1.26]), 0.008000000000000007);
        assert_eq!(case.error(&[1.25, 0.0]), f64::INFINITY);
        assert!(case.error(&[f64::NAN]).is_nan());
    }

    #[test]
    fn invalid_files_are_refused() {
        let refused =
            |text: &str| topic(text).unwrap_err().split(" in `").next().unwrap().to_owned();
        assert_eq!(refused(""), "the first line is not `# T01 title`");
        assert_eq!(refused("# T01 a title\n"), "no cases, or cases of another topic");
        assert_eq!(refused("# T01 a title\nT01.1\tgamma 0\n"), "not six columns");
        assert!(
            single_tolerances("T01.01 gamma 0\tx").unwrap_err().starts_with("not a question and a")
        );
        assert_eq!(refused("# T01 a title\nT01.1\tgamma 0\tx\t0\t-\tme\n"), "not numbers");
        assert_eq!(
            refused("# T01 a title\nT01.1\tgamma 0\t1\t0\tM1\tme\n"),
            "a mistake is `M1: numbers`"
        );
        assert_eq!(
            refused("# T01 a title\nT01.1\tgamma z\t1\t0\t-\tme\n"),
            "no answer, no numbers or no source"
        );
    }
}
