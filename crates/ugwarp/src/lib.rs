//! Panoramas as a fast traveller sees them.
//!
//! A 360° photograph holds all light that arrives at one event. Aberration, the Doppler effect and
//! the searchlight effect turn it into what any other observer sees who is there at the same
//! moment, exactly and whatever the scene was (Weiskopf 2000). What the picture does not hold is
//! the spectrum of its colours, infrared and ultraviolet light above all: [`Basis`] and
//! [`ColorShift`] are assumptions about it.
//!
//! - [`open`] makes a panorama of the bytes of PNG, JPEG, HDR, EXR or PFM files, cube maps among
//!   them; [`read_stars`] reads a list of stars.
//! - [`render`] draws a panorama, stars or both as a picture; [`light`] returns linear light
//!   instead.
//! - [`needs`] says which part of a panorama a picture needs, and how large it should be.
//! - [`Warp`] is a picture's map to a sky, and the light of its velocity.
//!
//! # Modules
//!
//! Skies are opened and drawn by [`ugskybox`]. Each line imports only from the lines above it:
//!
//! ```text
//! error  config                             errors; options
//! render                                    from a panorama to a picture, with messages
//! needs                                     which part of a panorama a picture needs
//! cli                                       the command line
//! ```
//!
//! # Example
//!
//! The law of 1988 at D = 2, straight ahead of a traveller at 0.6 c: the value of a grey sky
//! doubles.
//!
//! ```
//! use ugphysics::Velocity;
//! use ugsky::{Extent, Panorama, Texels};
//! use ugwarp::{Config, PictureOptions, light};
//!
//! let sky = Panorama::new([64, 32], Texels::Srgb(vec![[64, 64, 64, 255]; 64 * 32]), Extent::FULL)?;
//! let velocity = Velocity::from_beta(glam::DVec3::new(0.0, 0.6, 0.0))?;
//! let picture = PictureOptions { size: [3, 3], samples: 1, ..PictureOptions::default() };
//! let frame = light(&sky, &Config { velocity, picture, ..Config::default() })?;
//! let expected = ugphysics::srgb_decode(2.0 * 64.0 / 255.0) as f32;
//! // The mean over a large pixel, in which D falls from 2 to 1.9.
//! assert!((frame.pixels()[4][0] - expected).abs() < 5e-3, "{:?}", frame.pixels()[4]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#[cfg(feature = "cli")]
mod cli;
mod config;
mod error;
mod needs;
mod render;

#[cfg(feature = "cli")]
pub use cli::{Args, draw};
pub use config::Config;
pub use error::Error;
pub use needs::{Needs, needs};
pub use render::{PROVENANCE, light, metadata, render, render_opened, render_with, run};
pub use uglight::{ColorShift, HueShift, SpectralShift};
pub use ugpicture::{
    Background, Channel, Exposure, Filter, Note, Output, PictureFile, PictureOptions, Rendering,
    Tone,
};
pub use ugscene::CameraOptions;
pub use ugscene::Provenance;
pub use ugsky::{
    ALL_NM, Arrangement, Band, Basis, Extent, Panorama, PanoramaPart, Sky, Star, StarOptions,
    Texels,
};
pub use ugskybox::{OpenError, Opened, StarList, Warp, is_star_list, open, read_stars};
pub use ugtrace::lens::Lens;
