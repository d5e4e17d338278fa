//! The options of a picture of a panorama.

use std::ops::Range;

use uglight::ColorShift;
use ugphysics::Velocity;
use ugpicture::lens::Lens;
use ugpicture::{Channel, PictureOptions};
use ugsky::{ALL_NM, Basis};

use crate::error::Error;

/// Everything besides the panorama that affects the bytes of a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Config {
    /// Velocity of the camera in the frame of the panorama.
    pub velocity: Velocity,
    /// How motion changes colours.
    pub shift: ColorShift,
    /// The spectra of colours, if spectra are shifted.
    pub basis: Basis,
    /// Camera, size, samples, format, and other options that renderers share. The camera looks in
    /// the direction from its eye point to its view centre, by default along +y.
    pub picture: PictureOptions,
    /// Which direction is seen where.
    pub lens: Lens,
    /// How stars are drawn.
    pub stars: StarOptions,
    /// Wavelengths at rest at which a panorama has light, nm, with spectra.
    pub range_nm: Range<f64>,
}

/// How stars are drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StarOptions {
    /// Full width at half maximum of the disc of a star, pixels, 0.5 to 50.
    pub width: f64,
    /// Magnitude that is drawn as white: one such star per square degree has the mean light 1.
    pub white: f64,
}

impl Default for StarOptions {
    fn default() -> Self {
        Self { width: 1.7, white: -2.0 }
    }
}

impl Default for Config {
    /// At rest, with the defaults of the command line.
    fn default() -> Self {
        Self {
            velocity: Velocity::ZERO,
            shift: ColorShift::default(),
            basis: Basis::Smooth,
            picture: PictureOptions { samples: 1, ..PictureOptions::default() },
            lens: Lens::Pinhole,
            stars: StarOptions::default(),
            range_nm: ALL_NM,
        }
    }
}

impl Config {
    /// Refuses options that exclude each other, and pictures that do not fit in memory.
    ///
    /// # Errors
    /// [`Error::Options`], [`Error::Picture`].
    pub(crate) fn check(&self) -> Result<(), Error> {
        let picture = &self.picture;
        let refused = |text| Err(Error::Options(text));
        if picture.camera.is_orthographic {
            return refused("light from all directions meets at one point, so there is no -og: leave it out");
        }
        if picture.camera.name.is_some() {
            return refused("a panorama has no cameras with names: leave out -cam, and give -vc and -va");
        }
        if picture.annotations.outline || picture.annotations.grid {
            return refused("outline and grid (-dl, -gr) are for scenes: leave them out");
        }
        let is_of_sky =
            |channel: &Channel| matches!(channel, Channel::Doppler | Channel::Direction | Channel::Velocity);
        if !picture.channels.iter().all(is_of_sky) {
            return refused(
                "a sky has no time, distance, Z or id (-ch): the channels of a panorama are D, direction and velocity",
            );
        }
        if !(0.5..=50.0).contains(&self.stars.width) || !(-60.0..=60.0).contains(&self.stars.white) {
            return refused(
                "stars (--star-width, --white) are 0.5 to 50 pixels wide, and white has a magnitude from -60 to 60",
            );
        }
        if self.basis == Basis::BlackBody && self.range_nm != ALL_NM {
            return refused(
                "the colours of --basis blackbody have infrared and ultraviolet light of their own: leave out --infrared \
                 and --ultraviolet, or give --basis smooth",
            );
        }
        let [width, height] = picture.size;
        if self.lens == Lens::Cube {
            if u64::from(width) != 6 * u64::from(height) {
                return refused(
                    "a cube map (-cube) is six squares side by side: give -sz W H with W = 6 H, such as -sz 3072 512",
                );
            }
            if picture.annotations.is_any() {
                return refused("annotations (-cap, -lg) are for pictures of a single view: leave out -cube");
            }
        }
        Ok(picture.check()?)
    }
}
