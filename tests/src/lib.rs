//! Helpers shared by the cross-crate tests.
//!
//! - [`pipe`]: the three programs in one process, from text to a decoded picture;
//! - [`programs`]: the programs, for tests and shells;
//! - [`scenes`]: the scenes of the repository;
//! - [`documents`]: the commands in the pages of the documentation;
//! - [`picture`]: comparison of pictures, golden ones included;
//! - [`hostile`]: malformed and extreme inputs for the programs, and what must hold of them;
//! - [`oracle`]: a slow, independent reference renderer that determines which face each pixel must
//!   show;
//! - [`agreement`]: comparison of a picture with the oracle;
//! - [`outline`]: errors of drawn edges;
//! - [`shading`]: the expected colour of a point, from the formulas;
//! - [`shell`]: shell commands in a folder of their own;
//! - [`tools`]: whether programs of others are there, and what is skipped without them;
//! - [`tracked`]: the files of the repository;
//! - [`world_lines`]: bodies that accelerate, spin and orbit, by integration in small steps;
//! - [`worlds`]: random worlds, and laws that hold in them.

#![allow(clippy::missing_panics_doc, reason = "a test helper fails by panicking")]

pub mod agreement;
pub mod documents;
pub mod hostile;
pub mod oracle;
pub mod outline;
pub mod picture;
pub mod pipe;
pub mod programs;
pub mod scenes;
pub mod shading;
pub mod shell;
pub mod tools;
pub mod tracked;
pub mod world_lines;
pub mod worlds;
