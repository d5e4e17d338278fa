//! The options of the ray tracer.

use uglight::{ColorShift, Interpolation};
use ugparse::HueScale;
use ugpicture::PictureOptions;
use ugscene::MotionOptions;

/// Everything besides the scene that affects the bytes of a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Config {
    /// How bodies and camera move.
    pub motion: MotionOptions,
    /// How motion changes colours.
    pub shift: ColorShift,
    /// Camera, size, samples, format, and other options that renderers share.
    pub picture: PictureOptions,
    /// Reflection, refraction and shadows.
    pub rays: RayOptions,
    /// What is interpolated between corners of different colour.
    pub interpolation: Interpolation,
    /// Meaning of the hue fields of `c` statements.
    pub hue_scale: HueScale,
    /// Give vertices without a normal the mean normal of their faces (`-sm`).
    pub smooth: bool,
    /// Give each vertex a copy per colour of its faces, instead of mixing them (`-vr`).
    pub repeat: bool,
    /// How the scene is read.
    pub reading: ugparse::Options,
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
    /// middle, for which nothing changes.
    Film {
        /// From the pinhole to the film, in units of the scene, 0 or more.
        distance: f64,
    },
}

impl Default for RayOptions {
    fn default() -> Self {
        Self { depth: 8, cutoff: 1e-3, shadows: true, fresnel: false, shutter: Shutter::Pinhole }
    }
}

impl Default for Config {
    /// The defaults of the command line.
    fn default() -> Self {
        Self {
            motion: MotionOptions::default(),
            shift: ColorShift::default(),
            picture: PictureOptions::default(),
            rays: RayOptions::default(),
            interpolation: Interpolation::Hue,
            hue_scale: HueScale::Degrees,
            smooth: false,
            repeat: false,
            reading: ugparse::Options::default(),
        }
    }
}
