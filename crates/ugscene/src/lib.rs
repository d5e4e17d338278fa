//! What the ug programs ask of a flat [`ugparse::Scene`].
//!
//! A scene is geometry and colour as text gives it; the filters need more:
//! which body a vertex belongs to and how that body moves ([`Bodies`],
//! [`separate_bodies`]), where it rests when it is seen here ([`Geometry`],
//! [`rest_positions`], equation (P4)), its normal ([`smooth_normals`]), the
//! colour it gets from the faces round it ([`vertex_colors`]), the spectrum a
//! colour stands for ([`spectrum`]), and what triangles
//! make up a polygon ([`triangulate`]). All programs
//! must agree on these, so they are written once, here.
//!
//! ```
//! use glam::DVec3;
//! let text = "v a 3 4 0; v b 3 5 0; v c 4 4 0; f (a b c) <0.5 0 0>;";
//! let source = ugparse::Source::new("scene.ug", text);
//! let scene = ugparse::parse(&source, &ugparse::Options::default())?.scene;
//! let bodies = ugscene::Bodies::new(&scene, ugphysics::Velocity::ZERO)?;
//! let rest = ugscene::rest_positions(&scene, DVec3::ZERO, &bodies);
//! let seen = ugphysics::seen_position(rest[0], bodies.all()[0]);
//! assert!((seen - DVec3::new(3.0, 4.0, 0.0)).length() < 1e-14);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod bodies;
mod colors;
mod eye;
mod geometry;
mod history;
mod normals;
mod polygon;
mod shares;
mod split;

pub use bodies::{Bodies, separate_bodies, vertex_velocities};
pub use colors::{HueScale, VertexColor, hsv, spectra_note, spectrum, vertex_colors};
pub use eye::{at_eye_error, eye, vertex_at_eye};
pub use geometry::{Geometry, rest_positions};
pub use history::{history, record};
pub use normals::{corner_angle, smooth_normals};
pub use polygon::{Triangle, is_convex, triangulate};
pub use shares::{Shares, vertex_shares};
pub use split::split_vertices;
