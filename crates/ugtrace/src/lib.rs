//! Rays into the past: what a camera at rest or in motion sees of a scene, face by face.
//!
//! - [`lens`]: the direction that is seen at a place of the picture, and back;
//! - [`outlines`]: the nearest face at every sample of a flat picture, from the outlines of faces as
//!   they are seen;
//! - [`rays`]: the nearest face that any ray meets, by a hierarchy of the triangles of each body;
//!   round faces exactly, and bodies that accelerate, spin or orbit;
//! - [`SurfacePoint`]: place, normals, colour and Doppler factor where a ray meets a face;
//! - [`textures`]: texels with mip levels, and the footprints of samples.
//!
//! `ugphoton` and `ugrainbow -xc` draw with it. Rays run into the past from the event of the
//! picture; in the rest frame of each body they are straight (P6), and on world lines they are
//! curves in its coordinates.
//!
//! The edge of a fisheye picture of half the sphere is at a right angle to the view direction:
//!
//! ```
//! use glam::DVec3;
//! use ugscene::{Camera, CameraOptions, View};
//! use ugtrace::lens::{Film, Lens};
//!
//! let options = CameraOptions { center: Some(DVec3::Y), ..CameraOptions::default() };
//! let view = View::without_scene(&Camera::default(), &options, [60, 60])?;
//! let lens = Lens::Fisheye { angle: core::f64::consts::PI };
//! let film = Film::new(lens, None, &view, [60, 60]);
//! let sight = film.sight([60.0, 30.0]).ok_or("beyond the edge")?;
//! assert!(sight.direction.dot(DVec3::Y).abs() < 1e-12);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod lens;
pub mod outlines;
pub mod rays;
mod surface_point;
pub mod textures;

pub use surface_point::{SurfacePoint, Surfaces, WorldLineElement};
