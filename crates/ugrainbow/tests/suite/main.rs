//! Pictures of scenes, their explanations, and the program.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, its helpers too")]

mod cli;
mod common;
mod explain;
mod figures;
mod filter;
mod light;
mod line_drawings;
mod lines;
mod render;
mod translucency;
mod vector;
