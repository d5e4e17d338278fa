//! Geometry of a UniGrafix scene as seen in relativistic motion: the first program of
//!
//! ```text
//! uglorentz -vel .6 0 0 -in < ship.ug | ugdoppler | ugrainbow > ship.png
//! ```
//!
//! # What a moving body looks like
//!
//! A picture shows each point of a body where it was when its light left it, not where it is now.
//! Light from far parts left earlier, so a passing body looks rotated, sheared and curved, and an
//! approaching one elongated, although in its own frame nothing happened to it. Nguyen's report of
//! 1988 computes this in two steps: contract the body along its motion, (P1), then move every point
//! back to where it was when the light left, (P2). Together they are one boost of the emission
//! event, (P3), which `ugphysics` computes without loss of precision near the speed of light.
//!
//! The filter maps every vertex this way, keeps the faces, and adds what programs downstream need:
//! the velocity of each face, and the eye of the camera. With these, (P4) recovers the rest shape
//! exactly. Equation numbers are those of `docs/physics.md`.
//!
//! # Why faces are subdivided
//!
//! Renderers draw straight edges between vertices, but a moving straight edge is seen as an arc of
//! a hyperbola. Long edges are subdivided first. By default closed formulas for the angle between
//! arc and chord, for depth and for colour decide for each edge whether the difference is visible
//! ([`Pieces::UpTo`], derived in `docs/geometry.md`). The decision depends on the edge alone, so
//! faces that share an edge subdivide it alike and the result has no cracks; an edge with vertices
//! of other faces on it is subdivided there. Bodies at rest are not
//! subdivided, except for the light of near lamps if that is requested.
//!
//! Spheres, cylinders, tubes and discs are cut into polygons first, within the same error bound.
//! The vertices have the normals of the exact shape. With [`Pieces::PerEdge`]`(1)` they stay whole,
//! for rays.
//!
//! Pieces keep orientation, colour, light level, body and name of their face, and replace it in
//! place. Vertices of the scene keep their names and rows; new ones are named `s#1`, `s#2`, … and
//! come last.
//!
//! # Steps
//!
//! ```text
//! Scene ─ bodies ─ placement ─ normals ─┬─ adaptive ─┬─ positions ─ attributes → Scene
//!                    (P5)               └─ uniform ──┘     (P3)
//! ```
//!
//! # Example
//!
//! ```
//! use glam::DVec3;
//!
//! let source = ugparse::Source::new("tile.ug", "v a -1 1 0; v b 1 1 0; v c 0 1 1; f (a b c);");
//! let scene = ugparse::parse(&source, &ugparse::Options::default())?.scene;
//! let config = uglorentz::Config {
//!     velocity: Some(DVec3::new(0.9, 0.0, 0.0)),
//!     eye: Some(DVec3::ZERO),
//!     pieces: uglorentz::Pieces::PerEdge(2),
//!     ..uglorentz::Config::default()
//! };
//! let (seen, report) = uglorentz::apply(scene, &config)?;
//! assert_eq!(report.n_new_faces, 3);
//!
//! // The midpoint of the edge from a to b is beside the eye, and is seen γβ behind: (P3).
//! let text = String::from_utf8(ugparse::write(&seen))?;
//! assert!(text.contains("v s#1 -2.06474160483505"));
//! // Two pieces an edge make four of a triangle; the velocity of each is stated.
//! assert_eq!(text.matches("<0.9 0 0>").count(), 4);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod adaptive;
mod apply;
mod attributes;
#[cfg(feature = "cli")]
mod cli;
mod clocks;
mod color;
mod config;
mod criterion;
mod cull;
mod distant_bodies;
mod early_accept;
mod edge;
mod edge_errors;
mod edge_on;
mod error;
mod evenness;
mod interior;
mod junctions;
mod measured;
#[cfg(feature = "cli")]
mod measurement;
mod near_lamps;
mod pieces;
mod refined_mesh;
mod relative_motion;
mod remaining_errors;
mod report;
mod rounds;
mod split;
mod tables;
mod uniform;
mod viewpoint;
mod world_line;

pub use apply::{apply, apply_with};
#[cfg(feature = "cli")]
pub use cli::{Args, main};
pub use config::{Config, DEFAULT_COLOR_ERROR, DEFAULT_ERROR, MeasuredFrame, Pieces};
pub use error::Error;
#[cfg(feature = "cli")]
pub use measurement::Table;
pub use report::{LargestError, RemainingErrors, Report};
pub use ugscene::{Anchor, Measurement, Provenance, measure};

/// This program, without a command line, for the history of what it makes.
pub const PROVENANCE: Provenance<'static> = Provenance {
    program: env!("CARGO_PKG_NAME"),
    version: env!("CARGO_PKG_VERSION"),
    command: None,
    files: &[],
};
