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
//! Each module is a crate of its own; those of programs have the function of the program, and none
//! has a command line here:
//!
//! - [`parse`] reads scenes from text, [`mesh`] and [`meshfile`] from OBJ, PLY, STL, OFF and glTF;
//!   [`scene`] builds them from arrays;
//! - [`lorentz`], [`doppler`] and [`rainbow`] draw them, [`photon`] traces rays, [`warp`] draws
//!   panoramas, [`film`] the frames of a film, [`sheet`] several pictures on one, [`diagram`]
//!   spacetime diagrams;
//! - [`physics`] has the formulas, [`sky`] and [`skybox`] skies, [`light`] lamps and colours,
//!   [`trace`] what rays meet, [`picture`] and [`image`] what pictures have in common and their
//!   files, [`pipe`] progress.
//!
//! The types of every public field of a `Config` are in one of them. A `Config` may have more
//! fields in a later version, so complete it: `Config { time: 2.0, ..Config::default() }`; and
//! match errors and notes with a wildcard.

pub use glam;
pub use ugdiagram as diagram;
pub use ugdoppler as doppler;
pub use ugfilm as film;
pub use ugimage as image;
pub use uglight as light;
pub use uglorentz as lorentz;
pub use ugmesh as mesh;
pub use ugmeshfile as meshfile;
pub use ugparse as parse;
pub use ugphoton as photon;
pub use ugphysics as physics;
pub use ugpicture as picture;
pub use ugpipe as pipe;
pub use ugrainbow as rainbow;
pub use ugscene as scene;
pub use ugsheet as sheet;
pub use ugsky as sky;
pub use ugskybox as skybox;
pub use ugtrace as trace;
pub use ugwarp as warp;
