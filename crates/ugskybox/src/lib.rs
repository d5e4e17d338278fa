//! Skies around a scene, infinitely far away and at rest in its frame.
//!
//! - [`open`] makes a panorama of the bytes of PNG, JPEG, HDR, EXR or PFM files, cube maps among
//!   them; [`read_stars`] reads a list of stars.
//! - [`Warp`] and [`StarField`] are a [`SkyPicture`]'s map to a sky, and its light in every pixel.
//! - [`BuiltIn`] are skies without a file.
//! - A [`SceneSky`] is put behind the picture of a scene; [`SkyAround`] is what rays see of it
//!   that leave the scene.
//!
//! ```
//! use glam::{DQuat, DVec3};
//! use ugphysics::Velocity;
//! use ugsky::{Basis, Extent, Panorama, Texels};
//! use ugskybox::{Opened, SkyAround, sky_colors};
//!
//! // A grey sky by the law of 1988, which doubles its value straight ahead at 0.6 c.
//! let grey = Panorama::new([64, 32], Texels::Srgb(vec![[64, 64, 64, 255]; 64 * 32]), Extent::FULL)?;
//! let opened = Opened { panorama: Some(grey), ..Opened::default() };
//! let colors = sky_colors(uglight::ColorShift::default(), Basis::Mixture);
//! let velocity = Velocity::from_beta(DVec3::new(0.0, 0.6, 0.0))?;
//! let sky = SkyAround::new(opened.into(), DQuat::IDENTITY, velocity, colors, true);
//! let [red, ..] = sky?.rays().light(DVec3::Y, 1e-3, 1.0);
//! assert!((f64::from(red) - ugphysics::srgb_decode(128.0 / 255.0)).abs() < 1e-3, "{red}");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod around;
mod built_in;
#[cfg(feature = "cli")]
pub mod cli;
mod error;
mod open;
mod picture;
mod scene_sky;
mod sky_light;
mod star_index;
mod star_list;
mod stars;
mod warp;

pub use around::{SkyAround, SkyRays};
pub use built_in::BuiltIn;
pub use error::{OpenError, SkyError};
pub use open::{Opened, open, open_spectrum};
pub use picture::{SkyPicture, sky_colors};
pub use scene_sky::{SceneSky, SkyCamera, SkySource, drawn_on};
pub use sky_light::{SkyLamp, SkyLamps};
pub use star_list::{StarList, is_star_list, read_stars};
pub use stars::StarField;
pub use warp::{Statistics, Warp};
