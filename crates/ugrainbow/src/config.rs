//! What is asked of the renderer, apart from the scene.

use ugimage::{Format, Tone};
use uglight::HueScale;
use ugphysics::{Brightness, Hsv};
use ugraster::{DepthFade, Filter};
use ugscene::CameraOptions;

use crate::figures::Figures;
use crate::planes::Channel;

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
    /// How samples weigh in pixels.
    pub filter: Filter,
    /// What stands behind everything.
    pub background: Background,
    /// Kind of file.
    pub output: Output,
    /// How the scene is read.
    pub reading: ugparse::Options,
    /// What light is multiplied by before it is shown. If given, light brighter than white is kept until then.
    pub exposure: Option<Exposure>,
    /// How light is brought into the range of a display.
    pub tone: Tone,
    /// What an EXR picture holds besides colour.
    pub channels: Vec<Channel>,
    /// Edges of faces are drawn as lines.
    pub wireframe: Option<Wireframe>,
    /// Width of lines in pixels, above 0.
    pub line_width: f64,
    /// What is far fades towards the background.
    pub depth_cue: Option<DepthCue>,
    /// Faces are drawn by a ray for each sample (`-xc`), from a scene whose colours have not been shifted.
    pub exact: Option<Exact>,
    /// Faces that are seen from behind, running clockwise, are left out.
    pub cull: bool,
    /// PNG files are made as small as can be, which takes long.
    pub small: bool,
    /// What the figure has besides the picture.
    pub figures: Figures,
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
            filter: Filter::Box,
            background: Background::Color(Hsv { hue: 0.0, saturation: 0.0, value: 0.0 }),
            output: Output::Color(Format::Png),
            reading: ugparse::Options::default(),
            exposure: None,
            tone: Tone::Clip,
            channels: Vec::new(),
            wireframe: None,
            line_width: LINE_WIDTH,
            depth_cue: None,
            exact: None,
            cull: false,
            small: false,
            figures: Figures::default(),
            command_line: String::new(),
        }
    }
}

impl Config {
    /// What is interpolated between hues of this scale.
    pub(crate) fn interpolated(&self, scale: HueScale) -> Interpolation {
        match scale {
            HueScale::Degrees => self.interpolation,
            HueScale::Wavelengths => Interpolation::Wavelength,
        }
    }

    /// How the scene is drawn.
    pub(crate) fn draw_mode(&self) -> DrawMode {
        DrawMode { exact: self.exact, wireframe: self.wireframe, line_width: self.line_width }
    }

    /// True if the file is to hold light, uncut.
    pub(crate) fn is_linear(&self) -> bool {
        self.output.format().is_some_and(Format::is_linear)
    }

    /// True if light brighter than white is asked for, or asked to be brought into range.
    pub(crate) fn keeps_light(&self) -> bool {
        self.is_linear() || self.exposure.is_some() || self.tone != Tone::Clip
    }
}

/// Width of lines in pixels unless given.
pub const LINE_WIDTH: f64 = 1.2;

/// Greatest width of lines.
pub const MAX_LINE_WIDTH: f64 = 100.0;

/// Edges of faces as lines. They are not lit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wireframe {
    /// The faces are drawn, too; else they only hide lines.
    pub has_faces: bool,
    /// Of the edges, neither shifted nor attenuated; else they have the colours of the corners of their faces.
    pub color: Option<Hsv>,
}

/// Depth cueing: linear in depth along the view, light of surfaces is replaced by that of the background.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DepthCue {
    /// Depths between which light falls; else those of the nearest and the farthest that is seen.
    pub range: Option<[f64; 2]>,
    /// The part that is left at the far end, 0…1.
    pub least: f64,
}

impl DepthCue {
    /// What is left at the far end unless given.
    pub const LEAST: f64 = 0.2;

    /// The same between two depths.
    pub(crate) fn between(self, [near, far]: [f64; 2]) -> DepthFade {
        DepthFade { near, far, least: self.least }
    }
}

/// How motion changes the colours of a picture that is drawn by rays.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Exact {
    /// How D changes brightness, (P12).
    pub law: Brightness,
    /// Wavelengths are divided by D, (P11).
    pub doppler: bool,
}

impl Exact {
    /// Colours of bodies that move stay as they are.
    pub const NONE: Self = Self { law: Brightness::None, doppler: false };
}

impl Default for Exact {
    /// As `ugdoppler` by default.
    fn default() -> Self {
        Self { law: Brightness::Report, doppler: true }
    }
}

/// What light is multiplied by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Exposure {
    /// By 2 to this power.
    Stops(f64),
    /// By what shows 99 of 100 pixels at or below white, see [`ugimage::auto_exposure`].
    Auto,
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
    Transparent,
}

/// Kind of file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Output {
    /// A colour format.
    Color(Format),
    /// Areas and lines in place of pixels: a format that [has them](Format::has_vectors).
    Vector(Format),
    /// Black-and-white PostScript, as in 1988.
    Grey,
}

impl Output {
    /// The colour format, if it is one.
    pub fn format(self) -> Option<Format> {
        match self {
            Self::Color(format) | Self::Vector(format) => Some(format),
            Self::Grey => None,
        }
    }
}

/// What of a scene is drawn, and how; apart from its camera and colours.
#[derive(Clone, Copy, Debug)]
pub struct DrawMode {
    /// Faces are intersected by rays; else they are rasterized.
    pub exact: Option<Exact>,
    /// Edges of faces are drawn.
    pub wireframe: Option<Wireframe>,
    /// Width of lines in pixels.
    pub line_width: f64,
}

impl DrawMode {
    /// False if faces only occlude lines.
    pub fn has_faces(&self) -> bool {
        self.wireframe.is_none_or(|wireframe| wireframe.has_faces)
    }
}
