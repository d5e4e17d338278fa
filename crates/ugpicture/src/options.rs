//! The options of a picture, the same for every renderer.

use std::borrow::Borrow;
use std::sync::Arc;

use ugimage::label::TextForm;
use ugimage::{
    Compression, Development, Filter, Format, LinearFrame, PanoramaArea, Tone, auto_exposure,
};
use ugphysics::Hsv;
use ugscene::CameraOptions;
use ugtrace::lens::Lens;

use crate::background::Background;
use crate::channel::Channel;
use crate::error::{Error, refuse};
use crate::exposure::Exposure;
use crate::limits::{MAX_PIXELS, MAX_SAMPLES, MAX_SIDE, MAX_VECTOR_SIDE};
use crate::output::Output;
use crate::quantity::{IsoOptions, MapOptions};
use crate::units::Units;

/// The options of a picture, the same for every renderer.
///
/// A later version may have more fields, so complete it with `..PictureOptions::default()`.
#[derive(Clone, Debug, PartialEq)]
pub struct PictureOptions {
    /// Camera options, which override the camera of the scene.
    pub camera: CameraOptions,
    /// Pixels across and down.
    pub size: [u32; 2],
    /// Pixels in an inch, if a file says so.
    pub per_inch: Option<f64>,
    /// Samples along a side of a pixel, 1…[`MAX_SAMPLES`].
    pub samples: u32,
    /// The reconstruction filter.
    pub filter: Filter,
    /// The background.
    pub background: Background,
    /// Kind of file.
    pub output: Output,
    /// If given, light brighter than white is kept until it is exposed.
    pub exposure: Option<Exposure>,
    /// The tone curve.
    pub tone: Tone,
    /// Channels of an EXR picture besides colour.
    pub channels: Vec<Channel>,
    /// Write PNG files as small as possible, which takes longer.
    pub small: bool,
    /// Caption, legend, grid, outlines.
    pub annotations: AnnotationOptions,
    /// The form of the text of annotations in vector figures.
    pub text: TextForm,
    /// Light to be developed in place of that of the scene, such as its mean over a while;
    /// annotations are those of the scene.
    pub light: Option<Arc<LinearFrame>>,
}

impl Default for PictureOptions {
    /// The defaults of the command line: 1024 × 768 pixels, 4 × 4 samples each, black
    /// background, PNG.
    fn default() -> Self {
        Self {
            camera: CameraOptions::default(),
            size: [1024, 768],
            per_inch: None,
            samples: 4,
            filter: Filter::Box,
            background: Background::Color(Hsv { hue: 0.0, saturation: 0.0, value: 0.0 }),
            output: Output::Color(Format::Png),
            exposure: None,
            tone: Tone::Clip,
            channels: Vec::new(),
            small: false,
            annotations: AnnotationOptions::default(),
            text: TextForm::default(),
            light: None,
        }
    }
}

impl PictureOptions {
    /// True if light brighter than white is kept: for a file, an exposure, or a tone curve.
    pub fn keeps_light(&self) -> bool {
        self.output.format().is_linear() || self.exposure.is_some() || self.tone != Tone::Clip
    }

    /// Exposure and tone curve together. `frame`: the light of the picture, which is computed for
    /// [`Exposure::Auto`] alone.
    pub fn development<F: Borrow<LinearFrame>>(&self, frame: impl FnOnce() -> F) -> Development {
        let tone = self.tone;
        let stops = match self.exposure {
            None => 0.0,
            Some(Exposure::Stops(stops)) => stops,
            Some(Exposure::Auto) => auto_exposure(frame().borrow(), tone),
        };
        Development { stops, tone }
    }

    /// What viewers of 360° pictures are told about a picture by this lens: `None` unless it is an
    /// equirectangular panorama, twice as wide as high, for one eye and without annotations.
    ///
    /// `crop`: left column, upper row, width and height of the part that is drawn.
    #[must_use]
    pub fn panorama_area(
        &self,
        lens: Lens,
        is_stereo: bool,
        crop: Option<[u32; 4]>,
    ) -> Option<PanoramaArea> {
        let [width, height] = self.size;
        let is_whole = lens == Lens::Panorama && !is_stereo && !self.annotations.is_any();
        let [left, top, ..] = crop.unwrap_or_default();
        (is_whole && u64::from(width) == 2 * u64::from(height))
            .then_some(PanoramaArea { whole: self.size, corner: [left, top] })
    }

    /// How hard a PNG file is compressed.
    pub fn compression(&self) -> Compression {
        if self.small { Compression::Small } else { Compression::Fast }
    }

    /// Refuses a picture that does not fit in memory, before anything is allocated, and options
    /// that exclude each other.
    ///
    /// # Errors
    /// See [`Error`].
    pub fn check(&self) -> Result<(), Error> {
        self.check_size()?;
        self.check_output()?;
        self.check_memory()
    }

    /// Refuses a picture for which the system has not enough memory: reserves what pixels and file
    /// need at the same time, and releases it.
    fn check_memory(&self) -> Result<(), Error> {
        let bytes = self.bytes_per_pixel() * u64::from(self.size[0]) * u64::from(self.size[1]);
        // Small ones fit anywhere.
        if bytes < 1 << 24 {
            return Ok(());
        }
        let refused = |_| Error::Memory(self.size, bytes);
        Vec::<u8>::new()
            .try_reserve_exact(usize::try_from(bytes).unwrap_or(usize::MAX))
            .map_err(refused)
    }

    /// Memory for a pixel while the file is written: as light, and in the file before packing.
    fn bytes_per_pixel(&self) -> u64 {
        const LIGHT: u64 = 16;
        // A face and a distance, at most.
        const SURFACE: u64 = size_of::<Option<(f64, u32)>>() as u64;
        const COLOR: u64 = 4;
        let channels = if self.background == Background::Transparent { 4 } else { 3 };
        match self.output {
            Output::Vector(_) => 0,
            _ if self.output.format().is_linear() => {
                // Channels are made of the surface at each pixel.
                let surface = if self.channels.is_empty() { 0 } else { SURFACE };
                LIGHT + surface + 4 * (channels + self.channels.len() as u64)
            }
            Output::Color(Format::Png16) => LIGHT + 2 * channels,
            // A surface and a value at each sample.
            _ if self.annotations.map.is_some() => {
                LIGHT + COLOR + 20 * u64::from(self.samples * self.samples)
            }
            _ if self.keeps_light() => LIGHT + COLOR,
            _ => COLOR,
        }
    }

    /// Changes them to those of the linear light of the picture: exposure, tone curve, compression
    /// and annotations are left out.
    pub fn keep_light(&mut self) {
        self.output = Output::Color(Format::Exr);
        self.annotations = AnnotationOptions::default();
        (self.exposure, self.tone, self.small) = (None, Tone::Clip, false);
    }

    /// Refuses a picture with more pixels or samples than the limits.
    ///
    /// # Errors
    /// [`Error::Size`], [`Error::Samples`].
    pub fn check_size(&self) -> Result<(), Error> {
        let [width, height] = self.size;
        let fits = (1..=MAX_SIDE).contains(&width) && (1..=MAX_SIDE).contains(&height);
        refuse([
            (!fits || u64::from(width) * u64::from(height) > MAX_PIXELS, Error::Size(self.size)),
            (!(1..=MAX_SAMPLES).contains(&self.samples), Error::Samples(self.samples)),
        ])
    }

    /// Refuses options that the format does not support.
    fn check_output(&self) -> Result<(), Error> {
        let format = self.output.format();
        let is_vector = matches!(self.output, Output::Vector(_));
        let is_png = matches!(self.output, Output::Color(Format::Png | Format::Png16));
        let is_developed = self.exposure.is_some() || self.tone != Tone::Clip;
        let is_transparent = self.background == Background::Transparent;
        refuse([
            (is_vector && self.annotations.map.is_some(), Error::MapVectors),
            (is_vector && !format.has_vectors(), Error::NoVectors),
            (is_vector && self.filter != Filter::Box, Error::NoSamples),
            (is_vector && self.size.iter().any(|&side| side > MAX_VECTOR_SIDE), Error::VectorSize),
            (self.small && !is_png, Error::NotPng),
            (!self.channels.is_empty() && format != Format::Exr, Error::NotExr),
            (format.is_linear() && is_developed, Error::NotDeveloped),
            (is_transparent && !format.has_alpha(), Error::NotTransparent),
        ])
    }
}

/// Where caption, legend and scale are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Place {
    /// On strips below the scene.
    #[default]
    Below,
    /// In a column to the right of the scene.
    Beside,
    /// Over the upper left corner of the scene.
    TopLeft,
    /// Over the upper right corner.
    TopRight,
    /// Over the lower left corner.
    BottomLeft,
    /// Over the lower right corner.
    BottomRight,
}

impl Place {
    /// All places, with their names.
    pub const NAMES: [(&'static str, Self); 6] = [
        ("below", Self::Below),
        ("beside", Self::Beside),
        ("top-left", Self::TopLeft),
        ("top-right", Self::TopRight),
        ("bottom-left", Self::BottomLeft),
        ("bottom-right", Self::BottomRight),
    ];
}

/// Which annotations a picture has.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct AnnotationOptions {
    /// Text above the picture; none if it is blank.
    pub title: String,
    /// Text below the picture; none if it is blank.
    pub caption: String,
    /// Where caption, legend and scale are, if not below the picture.
    pub place: Place,
    /// Below the picture: the visible spectrum with its wavelengths, velocities, γ, and the Doppler
    /// factors that are seen.
    pub legend: bool,
    /// Over the picture: the edges of moving bodies as they would look at rest.
    pub outline: bool,
    /// Over the picture: a coordinate grid on the ground.
    pub grid: bool,
    /// Instead of light, a quantity in false colours, with its scale below the picture.
    pub map: Option<MapOptions>,
    /// Over the picture: lines of equal values of a quantity.
    pub iso: Option<IsoOptions>,
    /// Em size of text in pixels; without it a fortieth of the geometric mean of the sides.
    pub text_size: Option<f64>,
    /// The units of numbers in legend, grid, scale and lines.
    pub units: Units,
}

impl AnnotationOptions {
    /// True if there are some.
    pub fn is_any(&self) -> bool {
        let Self { place, text_size, ref units, .. } = *self;
        *self != Self { place, text_size, units: units.clone(), ..Self::default() }
    }
}
