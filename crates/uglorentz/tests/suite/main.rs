//! Shapes of scenes in motion, measurements, and the program.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, its helpers too")]

mod camera;
mod cli;
mod common;
mod cutting;
mod geometry;
mod measured;
mod measurements;
mod watertight;
