//! Pictures by rays, their laws and explanations, and the program.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, its helpers too")]

mod cli;
mod explain;
mod laws;
mod pictures;
mod preview;
mod rays;
