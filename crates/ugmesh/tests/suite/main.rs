//! Meshes of other programs as scenes, scenes as meshes, and the program.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, its helpers too")]

mod cli;
mod common;
mod found_files;
mod lights;
mod reading;
mod round_trip;
mod textures;
