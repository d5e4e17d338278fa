//! What is asked of the renderer, apart from the scene.

use ugimage::Format;
use ugphysics::Hsv;
use ugscene::{CameraOptions, HueScale};

/// Everything that decides the bytes of a picture besides the scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Config {
    /// What is interpolated between the corners of a face.
    pub interpolation: Interpolation,
    /// What hue fields of `c` statements are. If wavelengths, these are interpolated
    /// whatever [`Config::interpolation`] says.
    pub hue_scale: HueScale,
    /// Camera options, which beat the camera of the scene.
    pub camera: CameraOptions,
    /// Pixels across and down.
    pub size: [u32; 2],
    /// Samples along a side of a pixel, 1…16.
    pub samples: u32,
    /// What stands behind everything.
    pub background: Background,
    /// Kind of file.
    pub output: Output,
    /// How the scene is read.
    pub reading: ugparse::Options,
    /// How the program was called, to be written into the picture.
    pub command_line: String,
}

impl Default for Config {
    /// The defaults of the command line: 1024 × 768 pixels, 4 × 4 samples each, black
    /// background, PNG.
    fn default() -> Self {
        Self {
            interpolation: Interpolation::Hue,
            hue_scale: HueScale::Degrees,
            camera: CameraOptions::default(),
            size: [1024, 768],
            samples: 4,
            background: Background::Color(Hsv { hue: 0.0, saturation: 0.0, value: 0.0 }),
            output: Output::Color(Format::Png),
            reading: ugparse::Options::default(),
            command_line: String::new(),
        }
    }
}

impl Config {
    /// What is interpolated, after all options.
    pub fn interpolated(&self) -> Interpolation {
        match self.hue_scale {
            HueScale::Degrees => self.interpolation,
            HueScale::Wavelengths => Interpolation::Wavelength,
        }
    }
}

/// What is interpolated, besides saturation and value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interpolation {
    /// The hue, along the straight line from −60° to 300° and never round the circle: a hue
    /// stands for a wavelength.
    Hue,
    /// The wavelength.
    Wavelength,
}

/// What stands behind everything.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Background {
    /// A colour; it is not attenuated.
    Color(Hsv),
    /// Nothing: the picture is transparent there.
    Clear,
}

/// Kind of file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Output {
    /// A colour format.
    Color(Format),
    /// Black-and-white PostScript, as in 1988.
    Grey,
}
