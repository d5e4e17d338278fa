//! The language, its messages, and the program.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, its helpers too")]

mod bad_scenes;
mod editors;
mod language;
mod program;
mod read;
