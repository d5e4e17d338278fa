//! The options of a picture of a panorama.

use std::ops::Range;

use ugimage::PanoramaArea;
use uglight::ColorShift;
use ugphysics::Velocity;
use ugpicture::{Channel, PictureOptions, refuse};
use ugscene::{Camera, MotionOptions, Projection, Scene};
use ugsky::{ALL_NM, Basis, StarOptions};
use ugtrace::lens::Lens;

use crate::error::Error;

/// Everything besides the panorama that affects the bytes of a picture.
///
/// A later version may have more fields, so complete it with `..Config::default()`.
#[derive(Clone, Debug, PartialEq)]
pub struct Config {
    /// Velocity of the camera in the frame of the panorama.
    pub velocity: Velocity,
    /// The camera of a scene, in its own frame; options of [`picture`](Self::picture) override it.
    pub camera: Box<Camera>,
    /// Time of the picture on the clock of the camera of a scene, see
    /// [`with_camera_of`](Self::with_camera_of).
    pub time: f64,
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

impl Default for Config {
    /// At rest, with the defaults of the command line.
    fn default() -> Self {
        Self {
            velocity: Velocity::ZERO,
            camera: Box::default(),
            time: 0.0,
            shift: ColorShift::default(),
            basis: Basis::Mixture,
            picture: PictureOptions { samples: 1, ..PictureOptions::default() },
            lens: Lens::Pinhole,
            stars: StarOptions::default(),
            range_nm: ALL_NM,
        }
    }
}

impl Config {
    /// The panorama that the picture is, for viewers of 360° pictures.
    #[must_use]
    pub fn panorama(&self) -> Option<PanoramaArea> {
        self.picture.panorama_area(self.lens, false, None)
    }

    /// The same with the camera of a scene at [`time`](Self::time) instead of the velocity: where
    /// it looks, how it moves then, and how its motion has turned it. The scene is in the frame and
    /// the axes of the panorama. A panorama is infinitely far away, so the place of the camera has
    /// no effect.
    ///
    /// # Errors
    /// The scene has no camera, or an invalid one.
    pub fn with_camera_of(&self, scene: &Scene) -> Result<Self, Error> {
        let mut config = self.clone();
        let options = &self.picture.camera;
        let motion = MotionOptions { time: self.time, ..MotionOptions::default() };
        let (camera, velocity) =
            ugscene::moving_camera(scene, &motion, options)?.ok_or(Error::NoCamera)?;
        // They are in the camera now, turned with it.
        let own = &mut config.picture.camera;
        (own.name, own.eye, own.center, own.up) = (None, None, None, None);
        Ok(Self { camera: camera.into(), velocity, ..config })
    }

    /// Refuses options that exclude each other, and pictures that do not fit in memory.
    ///
    /// # Errors
    /// See [`Error`].
    pub(crate) fn check(&self) -> Result<(), Error> {
        let picture = &self.picture;
        let is_orthographic = self.camera.projection == Some(Projection::Orthographic);
        let is_of_sky = |channel: &Channel| {
            matches!(channel, Channel::Doppler | Channel::Direction | Channel::Velocity)
        };
        let are_stars =
            (0.5..=50.0).contains(&self.stars.width) && (-60.0..=60.0).contains(&self.stars.white);
        let ([width, height], annotations) = (picture.size, &picture.annotations);
        let is_cube = self.lens == Lens::Cube;
        refuse([
            (picture.camera.is_orthographic || is_orthographic, Error::Orthographic),
            (picture.camera.name.is_some(), Error::NamedCamera),
            (annotations.outline || annotations.grid, Error::OutlineOrGrid),
            (!picture.channels.iter().all(is_of_sky), Error::Channels),
            (!are_stars, Error::Stars),
            (is_cube && u64::from(width) != 6 * u64::from(height), Error::CubeSize),
            (is_cube && annotations.is_any(), Error::AnnotatedCube),
        ])?;
        Ok(picture.check()?)
    }
}
