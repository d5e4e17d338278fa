//! What things look like near the speed of light, in one library.
//!
//! A scene that moves to the right at 0.9c, as a PNG file in memory:
//!
//! ```
//! use unigrafix::glam::DVec3;
//! use unigrafix::{doppler, lorentz, parse, rainbow};
//!
//! let text = "c red 1 0 1; v a 0 0 0; v b 1 0 0; v c 0 1 0; f (a b c) red; cam -ep 0 0 5;";
//! let scene = parse::parse(&parse::Source::new("triangle.ug", text), &Default::default())?.scene;
//! let motion = lorentz::Config { velocity: Some(DVec3::X * 0.9), in_place: true, ..Default::default() };
//! let (seen, _) = lorentz::apply(scene, &motion)?;
//! let (colored, _) = doppler::apply(seen, &Default::default())?;
//! let png = rainbow::render(&colored, &Default::default())?.into_file();
//! assert!(png.starts_with(b"\x89PNG"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Each module is a crate of its own, and the function of a program; none has a command line here.
//! [`physics`] has the formulas, [`scene`] scenes in memory, built from arrays or read by [`parse`]
//! from text.

pub use glam;
pub use ugdoppler as doppler;
pub use ugimage as image;
pub use uglorentz as lorentz;
pub use ugparse as parse;
pub use ugphoton as photon;
pub use ugphysics as physics;
pub use ugrainbow as rainbow;
pub use ugscene as scene;
pub use ugsky as sky;
pub use ugwarp as warp;
