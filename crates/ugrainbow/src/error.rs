//! Why there is no picture.

use std::fmt;

use ugimage::{Format, Tone};
use uglabel::MissingCharacter;
use ugparse::Diagnostics;
use ugraster::Filter;
use ugscene::{CameraError, StageError};

use crate::config::{Background, Config, Output};

/// Most pixels of a picture; in memory they are a gibibyte, as light four.
pub const MAX_PIXELS: u64 = 1 << 28;

/// Most pixels along a side.
pub const MAX_SIDE: u32 = 1 << 24;

/// Most pixels along a side of a vector figure; its places are counted in fine steps.
const MAX_VECTOR_SIDE: u32 = 1 << 15;

/// Most samples along a side of a pixel.
const MAX_SAMPLES: u32 = 16;

/// Why there is no picture.
#[derive(Debug)]
pub enum Error {
    /// The scene has errors.
    Scene(Diagnostics),
    /// The scene has neither faces nor wires.
    Empty,
    /// The picture has no pixels, or more than [`MAX_PIXELS`] or [`MAX_SIDE`].
    Size([u32; 2]),
    /// The samples along a side of a pixel are not 1…16.
    Samples(u32),
    /// Options that do not go together; the text says which, and what to do.
    Options(&'static str),
    /// Text with a character that the font lacks.
    Text(MissingCharacter),
    /// A scene that cannot be drawn by rays; the text says why, and what to do.
    Exact(&'static str),
    /// A scene that cannot be drawn as areas; the text says why, and what to do.
    Figure(&'static str),
    /// A pixel to be explained that is not in the picture.
    Pixel {
        /// Its column and row.
        pixel: [u32; 2],
        /// Of the picture.
        size: [u32; 2],
    },
    /// The camera makes no sense.
    Camera(CameraError),
    /// The scene is not at the stage at which it can be drawn so.
    Stage(StageError),
}

impl Error {
    /// True if the command line asks for it, whatever the scene.
    pub fn is_usage(&self) -> bool {
        matches!(
            self,
            Self::Size(_) | Self::Samples(_) | Self::Options(_) | Self::Text(_) | Self::Pixel { .. }
        )
    }
}

/// Refuses what does not fit in memory, before anything is allocated.
pub fn check_size(size: [u32; 2], samples: u32) -> Result<(), Error> {
    let [width, height] = size;
    let fits = (1..=MAX_SIDE).contains(&width) && (1..=MAX_SIDE).contains(&height);
    if !fits || u64::from(width) * u64::from(height) > MAX_PIXELS {
        return Err(Error::Size(size));
    }
    if !(1..=MAX_SAMPLES).contains(&samples) {
        return Err(Error::Samples(samples));
    }
    Ok(())
}

/// Refuses what a format has no place for.
pub fn check_output(config: &Config) -> Result<(), Error> {
    let format = config.output.format();
    if let Output::Vector(format) = config.output {
        check_vectors(config, format)?;
    }
    if config.small && !matches!(config.output, Output::Color(Format::Png | Format::Png16)) {
        return Err(Error::Options(
            "only PNG files are packed smaller: leave out -pz, or write -dt png or png16",
        ));
    }
    if !config.channels.is_empty() && format != Some(Format::Exr) {
        return Err(Error::Options(
            "only EXR has a place for other channels than colour: with -ch write -dt exr",
        ));
    }
    if config.is_linear() && (config.exposure.is_some() || config.tone != Tone::Clip) {
        return Err(Error::Options(
            "EXR, PFM and HDR pictures hold the light as it is: leave out -ex and -tc, or write -dt png16",
        ));
    }
    if config.background == Background::Transparent && format.is_some_and(|format| !format.has_alpha()) {
        return Err(Error::Options(
            "PFM and HDR pictures have no transparency: leave out -tb, or write -dt exr",
        ));
    }
    Ok(())
}

fn check_vectors(config: &Config, format: Format) -> Result<(), Error> {
    if !format.has_vectors() {
        return Err(Error::Options("this format has only pixels: with -vec write -dt eps, ps, pdf or svg"));
    }
    if config.filter != Filter::Box {
        return Err(Error::Options("areas have no samples to be weighed: leave out -fl, or -vec"));
    }
    if config.size.iter().any(|&side| side > MAX_VECTOR_SIDE) {
        return Err(Error::Options(
            "a figure of areas has at most 32768 pixels, which are points, along a side: give a smaller -sz",
        ));
    }
    Ok(())
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Scene(diagnostics) => diagnostics.fmt(f),
            Self::Empty => f.write_str(
                "the scene has no faces and no wires, so there is nothing to draw; \
                 check that the program before in the pipe wrote one",
            ),
            Self::Size([width, height]) => write!(
                f,
                "a picture of {width} x {height} pixels cannot be made: the limit is {MAX_PIXELS} pixels in \
                 all and {MAX_SIDE} along a side; give a smaller -sz"
            ),
            Self::Samples(samples) => {
                write!(
                    f,
                    "{samples} x {samples} samples a pixel cannot be taken; give -aa 1 to {MAX_SAMPLES}"
                )
            }
            Self::Options(text) | Self::Exact(text) | Self::Figure(text) => f.write_str(text),
            Self::Text(missing) => missing.fmt(f),
            Self::Pixel { pixel: [x, y], size: [width, height] } => write!(
                f,
                "pixel {x},{y} is not in the picture of {width} x {height} pixels; \
                 count columns and rows from 0 at the upper left, or give -sz"
            ),
            Self::Camera(error) => error.fmt(f),
            Self::Stage(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for Error {}

impl From<Diagnostics> for Error {
    fn from(diagnostics: Diagnostics) -> Self {
        Self::Scene(diagnostics)
    }
}

impl From<MissingCharacter> for Error {
    fn from(missing: MissingCharacter) -> Self {
        Self::Text(missing)
    }
}

impl From<CameraError> for Error {
    fn from(error: CameraError) -> Self {
        Self::Camera(error)
    }
}

impl From<StageError> for Error {
    fn from(error: StageError) -> Self {
        Self::Stage(error)
    }
}
