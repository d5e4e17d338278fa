//! Views of panoramas and stars in motion, and the program.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, its helpers too")]

mod cli;
mod laws;
mod motion;
mod needs;
mod open;
mod stars;
