//! A test suite for any relativistic renderer: questions with known answers, pictures with known
//! measures, and a scorecard.
//!
//! ```text
//! ugconformance questions | my-program | ugconformance score
//! ugconformance score-image sphere sphere.png
//! ```
//!
//! The expected numbers are in `conformance/cases/`, one file for each topic. They were computed by
//! `conformance/derive.py`, which shares no code with the crates of this project.
//! `conformance/README.md` defines every question.
//!
//! ```
//! use ugconformance::precision::Precision;
//! use ugconformance::suite;
//!
//! let topics = suite::topics()?;
//! let case = &topics[0].cases[3];
//! assert_eq!(case.question(), "T01.04 gamma 0.5");
//! assert!(case.error(&[1.1547005383792515]) < case.tolerance);
//! assert_eq!(Precision::Double.recognized(case, &[1.3333333333333333]), ["M2"]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod cli;
pub mod compare;
pub mod mistakes;
pub mod picture;
pub mod precision;
pub mod scorecard;
pub mod suite;

pub use cli::{Args, main, questions, score_image};
