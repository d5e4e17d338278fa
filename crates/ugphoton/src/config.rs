//! The options of the ray tracer.

use ugimage::PanoramaArea;
use uglight::{ColorShift, Interpolation};
use ugpicture::{Canvas, Exposure, PictureOptions, refuse};
use ugscene::{HueScale, MotionOptions};
use ugskybox::SceneSky;

use crate::error::Error;
use crate::lens::Lens;

/// Everything besides the scene that affects the bytes of a picture.
///
/// A later version may have more fields, so complete it with `..Config::default()`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Config {
    /// How bodies and camera move.
    pub motion: MotionOptions,
    /// How motion changes colours.
    pub shift: ColorShift,
    /// Camera, size, samples, format, and other options that renderers share.
    pub picture: PictureOptions,
    /// Reflection, refraction and shadows.
    pub rays: RayOptions,
    /// The quantity that is interpolated between corners of different colour.
    pub interpolation: Interpolation,
    /// Meaning of the hue fields of `c` statements.
    pub hue_scale: HueScale,
    /// Give vertices without a normal the mean normal of their faces (`-sm`).
    pub smooth: bool,
    /// Give each vertex a copy per colour of its faces, instead of mixing them (`-vr`).
    pub repeat: bool,
    /// Which direction is seen where.
    pub lens: Lens,
    /// The distance between two eyes, each with a picture of its own (`-stereo`): side by side, the
    /// left eye's on the left; panoramas one above the other, the left eye's above. Both eyes are
    /// at rest in the frame of the camera, and see at the same moment of it.
    pub stereo: Option<f64>,
    /// Adaptive samples (`-ad`): the contrast, 0…1, above which a pixel gets all its samples. About
    /// a quarter of them are traced first. If these and the nearest samples around the pixel differ
    /// by no more, their mean stands for the others. The contrast of light is the greatest
    /// difference of a channel divided by the greatest sum of the least and the most of one.
    pub adaptive: Option<f64>,
    /// What is behind the scene and in its mirrors (`-sky`). A picture with a transparent
    /// background shows it in mirrors only.
    pub sky: SceneSky,
    /// Put a ground below the scene (`--stage`), see [`ugscene::add_ground`].
    pub ground: bool,
    /// Draw only a part of the picture (`-crop`): its left column, upper row, width and height. The
    /// pixels are those of the whole picture.
    pub crop: Option<[u32; 4]>,
    /// Add channels of radiances at wavelengths (`--radiances`), named as `S0.450nm`.
    pub radiances: bool,
    /// How the scene is read.
    pub reading: ugparse::Options,
}

impl Config {
    /// The picture to be drawn. Refuses options that exclude each other, and pictures that do not
    /// fit in memory.
    ///
    /// # Errors
    /// See [`Error`].
    pub(crate) fn canvas(&self) -> Result<Canvas, Error> {
        self.check_lens()?;
        let is_exr = self.picture.output.format() == ugimage::Format::Exr;
        if self.radiances && !(is_exr && matches!(self.shift, ColorShift::Spectra(_))) {
            return Err(Error::NoWavelengths);
        }
        let Some([left, top, width, height]) = self.crop else {
            return Ok(Canvas::new(&self.picture)?);
        };
        self.picture.check_size()?;
        let fits = |start: u32, length: u32, side: u32| {
            length > 0 && start.checked_add(length).is_some_and(|end| end <= side)
        };
        let PictureOptions { size, ref annotations, exposure, .. } = self.picture;
        let is_part = fits(left, width, size[0]) && fits(top, height, size[1]);
        refuse([
            (!is_part, Error::Crop { crop: [left, top, width, height], size }),
            (annotations.is_any(), Error::AnnotatedPart),
            (exposure == Some(Exposure::Auto), Error::ExposedPart),
        ])?;
        Ok(Canvas::new(&PictureOptions { size: [width, height], ..self.picture.clone() })?)
    }

    /// The panorama that the picture is or belongs to, for viewers of 360° pictures.
    pub fn panorama(&self) -> Option<PanoramaArea> {
        self.picture.panorama_area(self.lens, self.stereo.is_some(), self.crop)
    }

    /// The same with the options of the part of the picture that shows the scene.
    pub(crate) fn on(&self, canvas: &Canvas) -> Self {
        let mut config = self.clone();
        if self.crop.is_none() {
            config.picture = canvas.options().clone();
        }
        config
    }

    fn check_lens(&self) -> Result<(), Error> {
        let annotations = &self.picture.annotations;
        let ([width, height], [across, down]) = (self.picture.size, self.frames());
        let (is_cube, is_pinhole) = (self.lens == Lens::Cube, self.lens == Lens::Pinhole);
        refuse([
            (is_cube && self.stereo.is_some(), Error::StereoCube),
            (is_cube && u64::from(width) != 6 * u64::from(height), Error::CubeSize),
            (width % across != 0 || height % down != 0, Error::StereoSize),
            ([across, down] != [1, 1] && annotations.is_any(), Error::AnnotatedViews),
            (!is_pinhole && (annotations.outline || annotations.grid), Error::BentLines),
            (!is_pinhole && self.rays.shutter != Shutter::Pinhole, Error::FilmShutter),
        ])
    }

    /// The frames of which the picture consists, across and down.
    pub(crate) fn frames(&self) -> [u32; 2] {
        self.lens.frames(self.stereo.is_some())
    }

    /// The size of a frame, in pixels.
    pub(crate) fn frame_size(&self) -> [u32; 2] {
        let ([width, height], [across, down]) = (self.picture.size, self.frames());
        [width / across, height / down]
    }
}

/// Which secondary rays are traced.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RayOptions {
    /// Reflections and refractions along a path, 0 for none (`-rd`).
    pub depth: u32,
    /// Paths that contribute less than this part of a pixel's light end (`-rc`).
    pub cutoff: f64,
    /// Lights cast shadows.
    pub shadows: bool,
    /// The sky lights the scene, beside the lamps of the scene.
    pub sky_light: bool,
    /// The reflected and transmitted parts of the light on a transparent surface depend on the
    /// angle by Fresnel's equations; otherwise they are those of the `surf` statement.
    pub fresnel: bool,
    /// Where the shutter is (`--film-shutter`).
    pub shutter: Shutter,
}

/// Where the shutter of the pinhole camera is: all light passes it at one moment, the time of the
/// picture (Howard, Dance and Kitchen 1995).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Shutter {
    /// At the pinhole, as in all other programs.
    #[default]
    Pinhole,
    /// At the film. Light for the edges of the film passes the pinhole earlier than light for its
    /// middle, for which nothing changes. A camera that accelerates or turns counts as inertial
    /// meanwhile, with its velocity at the time of the picture.
    Film {
        /// From the pinhole to the film, in units of the scene, 0 or more.
        distance: f64,
    },
}

impl Default for RayOptions {
    fn default() -> Self {
        Self {
            depth: 16,
            cutoff: 1e-2,
            shadows: true,
            sky_light: true,
            fresnel: false,
            shutter: Shutter::Pinhole,
        }
    }
}
