//! What a relativistic renderer must get right: questions with known answers, pictures with known measures, and a
//! scorecard for any program.
//!
//! ```text
//! ugconformance questions | my-program | ugconformance score
//! ugconformance score-image sphere sphere.png
//! ```
//!
//! The right numbers lie in `conformance/cases/`, one file for each topic. They were computed by `conformance/derive.py`,
//! which shares nothing with the crates of this project. `conformance/README.md` says what every question means.
//!
//! ```
//! use ugconformance::suite;
//!
//! let topics = suite::topics()?;
//! let case = &topics[0].cases[3];
//! assert_eq!(case.question(), "T01.04 gamma 0.5");
//! assert!(case.error(&[1.1547005383792515]) < case.tolerance);
//! assert_eq!(case.recognized(&[1.3333333333333333]), ["M2"]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod answer;
mod cli;
pub mod mistakes;
pub mod picture;
pub mod scorecard;
pub mod suite;

pub use cli::{answers, main, questions, score_image};
