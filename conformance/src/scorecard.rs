//! Compares answers with the suite.

use std::collections::BTreeMap;
use std::fmt;

use serde_json::{Value, json};

use crate::mistakes;
use crate::precision::Precision;
use crate::suite::{Case, Topic};

/// The answers of a program, by the id of the question.
pub type Answers = BTreeMap<String, Vec<f64>>;

/// Parses answers: an id and numbers on each line. `-` instead of numbers means that there is no
/// answer. Empty lines and those that begin with `#` are ignored. Infinities and NaN are parsed,
/// but are always wrong.
///
/// # Errors
/// A word is not a number, or an id is unknown or repeated: line and column, the word, and why.
pub fn read_answers(text: &str, topics: &[Topic]) -> Result<Answers, String> {
    let is_known =
        |id: &str| topics.iter().flat_map(|topic| &topic.cases).any(|case| case.id == id);
    let mut answers = Answers::new();
    for (row, line) in text.lines().enumerate() {
        let bad = |word: &str, what: &str| {
            let column = word.as_ptr() as usize - line.as_ptr() as usize + 1;
            format!("{}:{column}: `{}` {what}", row + 1, word.chars().take(40).collect::<String>())
        };
        let mut words = line.split_ascii_whitespace();
        let Some(id) = words.next().filter(|word| !word.starts_with('#')) else { continue };
        if !is_known(id) {
            return Err(bad(
                id,
                "is not the id of a question; `ugconformance questions` lists them",
            ));
        }
        let mut values = Vec::new();
        for word in words.filter(|&word| word != "-") {
            values.push(word.parse().map_err(|_| bad(word, "is not a number"))?);
        }
        if values.is_empty() {
            continue;
        }
        if answers.insert(id.to_string(), values).is_some() {
            return Err(bad(id, "is answered twice"));
        }
    }
    Ok(answers)
}

/// The result of a program.
#[derive(Clone, Debug)]
pub struct Scorecard<'a> {
    precision: Precision,
    rows: Vec<Row<'a>>,
    failures: Vec<Failure<'a>>,
}

#[derive(Clone, Debug)]
struct Row<'a> {
    topic: &'a Topic,
    passed: usize,
    failed: usize,
    /// The largest error of an answer, in units of the tolerance.
    worst: f64,
}

impl Row<'_> {
    fn unanswered(&self) -> usize {
        self.topic.cases.len() - self.passed - self.failed
    }
}

#[derive(Clone, Debug)]
struct Failure<'a> {
    case: &'a Case,
    answer: &'a [f64],
    tolerance: f64,
}

impl<'a> Scorecard<'a> {
    /// Compares answers of a program of this class with the expected ones.
    pub fn new(topics: &'a [Topic], answers: &'a Answers, precision: Precision) -> Self {
        let mut failures = Vec::new();
        let rows = topics
            .iter()
            .map(|topic| {
                let mut row = Row { topic, passed: 0, failed: 0, worst: 0.0 };
                for case in &topic.cases {
                    let Some(answer) = answers.get(&case.id) else { continue };
                    let tolerance = precision.tolerance(case);
                    let error = case.error(answer) / tolerance;
                    row.worst = if error <= row.worst { row.worst } else { error };
                    // NaN fails the comparison.
                    if error <= 1.0 {
                        row.passed += 1;
                    } else {
                        row.failed += 1;
                        failures.push(Failure { case, answer, tolerance });
                    }
                }
                row
            })
            .collect();
        Self { precision, rows, failures }
    }

    /// Cases passed, failed, and without an answer.
    pub fn counts(&self) -> [usize; 3] {
        self.rows.iter().fold([0; 3], |[passed, failed, unanswered], row| {
            [passed + row.passed, failed + row.failed, unanswered + row.unanswered()]
        })
    }
}

impl Scorecard<'_> {
    /// The result for programs. Errors are in units of the tolerance: up to 1 is correct.
    pub fn json(&self) -> Value {
        let topics = self.rows.iter().map(|row| {
            let Row { topic, passed, failed, worst } = row;
            json!({ "topic": topic.name, "about": topic.title, "passed": passed, "failed": failed,
                "unanswered": row.unanswered(), "worst_error": worst })
        });
        let failures = self.failures.iter().map(|&Failure { case, answer, tolerance }| {
            let looks_like = mistakes::json(self.precision.recognized(case, answer).into_iter());
            json!({ "question": case.question(), "answered": answer, "expected": case.expected,
                "source": case.source, "error": case.error(answer) / tolerance,
                "looks_like": looks_like })
        });
        json!({ "topics": topics.collect::<Vec<_>>(), "failures": failures.collect::<Vec<_>>() })
    }
}

impl fmt::Display for Scorecard<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "topic  passed  failed  unanswered  worst error  about")?;
        for row in &self.rows {
            // In units of the tolerance: up to 1 is correct.
            let worst =
                if row.passed + row.failed == 0 { "-".to_string() } else { short(row.worst) };
            writeln!(
                f,
                "{:5}  {:6}  {:6}  {:10}  {worst:>11}  {}",
                row.topic.name,
                row.passed,
                row.failed,
                row.unanswered(),
                row.topic.title
            )?;
        }
        let [passed, failed, unanswered] = self.counts();
        writeln!(f, "all    {passed:6}  {failed:6}  {unanswered:10}\n")?;
        let class = match self.precision {
            Precision::Double => "",
            Precision::Single => " for single precision",
        };
        writeln!(f, "The worst error is in units of the tolerance{class}: up to 1 is correct.")?;
        for &Failure { case, answer, tolerance } in &self.failures {
            writeln!(f, "\n{}", case.question())?;
            writeln!(f, "  answered {}", list(answer))?;
            writeln!(f, "  expected {}  ({})", list(&case.expected), case.source)?;
            let shown = match self.precision {
                Precision::Double => format!("{tolerance:e}"),
                Precision::Single => short(tolerance),
            };
            writeln!(f, "  error {}, tolerance {shown}", short(case.error(answer)))?;
            for name in self.precision.recognized(case, answer) {
                writeln!(f, "  looks like {name}: {}", mistakes::describe(name))?;
            }
        }
        Ok(())
    }
}

/// Formats an error with two digits.
fn short(value: f64) -> String {
    if value == 0.0 { "0".to_string() } else { format!("{value:.1e}") }
}

fn list(values: &[f64]) -> String {
    values.iter().map(|value| format!("{value:?}")).collect::<Vec<_>>().join(" ")
}
