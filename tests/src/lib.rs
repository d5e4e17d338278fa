//! Helpers shared by the cross-crate tests.
//!
//! - [`pipe`]: the three programs in one process, from text to a decoded picture;
//! - [`programs`]: the programs as files;
//! - [`scenes`]: the scenes of the repository;
//! - [`picture`]: comparing pictures, golden ones included;
//! - [`oracle`]: what every pixel must show, found by a slow method of its own;
//! - [`agreement`]: how far a picture agrees with the oracle;
//! - [`explanation`]: what explains that they differ in a pixel;
//! - [`outline`]: how far drawn edges are from where they are seen;
//! - [`shading`]: colour and light of a point, by the formulas;
//! - [`random`]: reproducible random numbers;
//! - [`slow_reader`]: a second reader of the scene language, to check the first;
//! - [`tools`]: whether programs of others are there.

#![allow(clippy::missing_panics_doc, reason = "a test helper fails by panicking")]

pub mod agreement;
pub mod explanation;
pub mod oracle;
pub mod outline;
pub mod picture;
pub mod pipe;
pub mod programs;
pub mod random;
pub mod scenes;
pub mod shading;
pub mod slow_reader;
pub mod tools;
