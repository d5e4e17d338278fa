//! Answers every kind of question with the functions of this project's crates.

mod colour;
mod frames;
mod glass;
mod light;
mod numbers;
mod outlines;
mod positions;
mod world_lines;

use numbers::Answer;

/// A kind of question.
struct Kind {
    name: &'static str,
    answer: Answer,
}

fn kinds() -> impl Iterator<Item = Kind> {
    let geometry = [positions::KINDS, outlines::KINDS, frames::KINDS, world_lines::KINDS];
    geometry
        .into_iter()
        .chain([light::KINDS, glass::KINDS, colour::KINDS])
        .flatten()
        .map(|&(name, answer)| Kind { name, answer })
}

/// The answer of this project's crates. `None` if the kind is unknown, or the count or values of
/// the numbers are invalid.
pub fn answer(kind: &str, given: &[f64]) -> Option<Vec<f64>> {
    let kind = kinds().find(|known| known.name == kind)?;
    (kind.answer)(given).filter(|answer| answer.iter().all(|number| number.is_finite()))
}
