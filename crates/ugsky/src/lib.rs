//! Skies: light from afar by direction, as an observer in motion sees it.
//!
//! All light that arrives at one event is a panorama. Aberration, the Doppler effect and the
//! searchlight effect turn it into what any observer at that event sees, exactly, at a cost that
//! does not depend on the scene (Weiskopf 2000).
//!
//! - A [`Panorama`] is light on an equirectangular grid, for the whole sphere or a part of it.
//! - An [`Observer`] carries directions of a picture, and how they change from pixel to pixel, to
//!   the frame of the sky: a [`SkyRay`].
//! - [`Sampler::light`] is the mean light of the pixel: an elliptical footprint on the sphere, with
//!   weights by true directions and solid angles. There is no aliasing where the sky is seen
//!   smaller, by (1 − β)/(1 + β) straight ahead, and no blocks where it is seen larger.
//! - A [`Reach`] is the part of a panorama that a picture reads, and how finely.
//! - A [`SpectralTable`] is light as seen, on an assumption about its spectrum: a [`Basis`].
//! - [`SkyColors`] say how colours change; a [`Sky`] is a panorama, stars or both; [`SkyLight`]
//!   is the light of one in rows of pixels.
//! - A [`Star`] is a black body too small to be resolved, and [`StarLight`] what it gives an
//!   observer in motion.
//!
//! ```
//! use glam::DVec3;
//! use ugphysics::Velocity;
//! use ugsky::{Extent, Observer, Panorama, Texels};
//!
//! // A grey sky, and a pixel of 1/100 radian.
//! let sky = Panorama::new([64, 32], Texels::Srgb(vec![[128, 128, 128, 255]; 64 * 32]), Extent::FULL)?;
//! let observer = Observer::new(Velocity::from_beta(DVec3::new(0.0, 0.6, 0.0))?);
//! let ray = observer.ray(DVec3::Y, [0.01 * DVec3::X, 0.01 * DVec3::Z]);
//! assert!((ray.doppler - 2.0).abs() < 1e-15 && (ray.slopes[0].length() - 0.02).abs() < 1e-15);
//! let [red, _, _, alpha] = sky.sampler().light(&ray, 1.0).unwrap_or_default();
//! assert!((f64::from(red) - ugphysics::srgb_decode(128.0 / 255.0)).abs() < 1e-6);
//! assert!((alpha - 1.0).abs() < 1e-6);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod arrangement;
mod blocks;
mod cube;
mod footprint;
mod grid;
mod hues;
mod observer;
mod panorama;
mod pictures;
mod pyramid;
mod reach;
mod sample;
mod shade;
mod sky;
mod spectral;
mod stars;
mod texels;
mod transfer;
mod view;
mod window;

pub use arrangement::Arrangement;
pub use cube::CubeMap;
pub use grid::Extent;
pub use observer::{Observer, SkyRay};
pub use panorama::{Panorama, PanoramaError};
pub use pictures::DecodedPicture;
pub use reach::{PanoramaPart, Reach, ReachFinder};
pub use sample::{Sampler, Seen};
pub use shade::{Shade, SkyColors};
pub use sky::{Band, Layer, Sky, VISIBLE_NM};
pub use spectral::{ALL_NM, Basis, BasisError, N_PURE, SpectralTable, amounts, pure_lights};
pub use stars::{Star, StarLight, StarOptions};
pub use texels::Texels;
pub use view::{FlatFilm, SkyLight, SkyView};
