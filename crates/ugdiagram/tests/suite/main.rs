//! Laws of diagrams, diagrams of textbooks with their numbers, labels, and the program.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, its helpers too")]

mod cli;
mod common;
mod emissions;
mod laws;
mod legible;
mod textbooks;
