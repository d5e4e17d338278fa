//! Tests of the suite and of the program, in one program.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, its helpers too")]

mod cases;
mod export;
mod precision;
mod program;
