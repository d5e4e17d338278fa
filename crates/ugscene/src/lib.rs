//! Scenes: the data model that all programs share, and functions on it.
//!
//! A [`Scene`] is flat and complete: definitions are expanded, names are resolved, numbers are
//! finite. Its text form is in `ugparse`. The functions:
//!
//! - Bodies: which one a vertex is part of, and their rest frames ([`RestFrames`],
//!   [`separate_bodies`]).
//! - Vertices of a scene as seen: rest positions and own times ([`SeenVertices`],
//!   [`rest_positions`], equations (P4) and (P45)).
//! - Normals: [`smooth_normals`], and [`shading_normal`] for lighting.
//! - The colours that meet at a vertex ([`vertex_mixes`]).
//! - The faces that are not flat ([`bent_faces`]), and round ones as polygons ([`cut_rounds`]).
//! - The faces that lie in one plane ([`shared_planes`]).
//! - Motions: where bodies and lights are relative to the camera ([`PlacedBodies`]).
//! - The camera ([`View`]), its options, the eye, and the camera of a scene without one
//!   ([`DefaultCamera`]).
//! - The stage that a program requires.
//!
//! All programs must agree on these. Lamps and the appearance of colours are in `uglight`.
//!
//! ```
//! use glam::DVec3;
//! let text = "v a 3 4 0; v b 3 5 0; v c 4 4 0; f (a b c) <0.5 0 0>;";
//! let source = ugparse::Source::new("scene.ug", text);
//! let scene = ugparse::parse(&source, &ugparse::Options::default())?.scene;
//! let frames = ugscene::RestFrames::new(&scene);
//! let rest = ugscene::rest_positions(&scene, DVec3::ZERO, &frames);
//! let seen = ugphysics::seen_position(rest[0], frames.velocity(scene.faces[0].body));
//! assert!((seen - DVec3::new(3.0, 4.0, 0.0)).length() < 1e-14);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod area;
mod body_boxes;
mod builder;
mod camera;
mod camera_fit;
mod camera_options;
#[cfg(feature = "cli")]
pub mod cli;
mod color_mix;
mod data;
mod default_camera;
mod flatness;
mod ground;
mod measurement;
mod mixing;
mod normals;
mod note;
mod observe;
mod requirements;
mod rounds;
mod shared_planes;
mod split;
mod times_in_view;
mod words;

pub use area::{closed, face_edges, newell_normal, unit_normal};
pub use body_boxes::{BodyBoxes, SeenBoxes};
pub use builder::{AddedMesh, BuildError, Mesh, SceneBuilder};
pub use camera::{CameraPoint, HalfSpace, Slab, View, view_distance};
pub use camera_options::{CameraError, CameraOptions};
pub use color_mix::{ColorMix, face_vertices, vertex_mixes};
pub use data::*;
pub use default_camera::DefaultCamera;
pub use flatness::{BENT, BentFace, bent_faces, thickness};
pub use ground::add_ground;
pub use measurement::{Measurement, measure};
pub use mixing::{mixing_vertices, n_mixing_vertices, repeat_vertices, separate_wires};
pub use normals::{corner_angle, seen_normal, shading_normal, smooth_normals};
pub use note::{Note, may_miss_motion};
pub use observe::*;
pub use requirements::{
    StageError, has_moving_bodies, has_moving_lights, hue_scale, read_tints_in,
    refuse_deferred_colors, refuse_whole_faces, require_colors_at_rest, require_eye,
    require_geometry_at_rest, require_seen_geometry, write_display_as_hues,
};
pub use rounds::{
    COARSEST_SAGITTA, FINE_SAGITTA, TooManyPolygons, cut_rounds, cut_rounds_at_rest, seen_sagitta,
    seen_sagitta_on_world_line,
};
pub use shared_planes::shared_planes;
pub use split::{split_corners, split_vertices};
pub use times_in_view::TimesInView;
pub use words::shorten;
