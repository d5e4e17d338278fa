//! What is asked of the renderer, apart from the scene.

use uglight::{ColorShift, HueScale};
use ugphysics::Hsv;
use ugpicture::PictureOptions;
use ugraster::DepthFade;

/// Everything that decides the bytes of a picture besides the scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Config {
    /// What is interpolated between the corners of a face.
    pub interpolation: Interpolation,
    /// What hue fields of `c` statements are. If wavelengths, these are interpolated
    /// whatever [`Config::interpolation`] says.
    pub hue_scale: HueScale,
    /// Camera, size, samples, format, and all else that renderers share.
    pub picture: PictureOptions,
    /// How the scene is read.
    pub reading: ugparse::Options,
    /// Edges of faces are drawn as lines.
    pub wireframe: Option<Wireframe>,
    /// Width of lines in pixels, above 0.
    pub line_width: f64,
    /// What is far fades towards the background.
    pub depth_cue: Option<DepthCue>,
    /// Faces are drawn by a ray for each sample (`-xc`), from a scene whose colours have not been
    /// shifted.
    pub exact: Option<ColorShift>,
    /// Faces that are seen from behind, running clockwise, are left out.
    pub cull: bool,
}

impl Default for Config {
    /// The defaults of the command line.
    fn default() -> Self {
        Self {
            interpolation: Interpolation::Hue,
            hue_scale: HueScale::Degrees,
            picture: PictureOptions::default(),
            reading: ugparse::Options::default(),
            wireframe: None,
            line_width: LINE_WIDTH,
            depth_cue: None,
            exact: None,
            cull: false,
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
    /// Of the edges, neither shifted nor attenuated; else they have the colours of the corners of
    /// their faces.
    pub color: Option<Hsv>,
}

/// Depth cueing: linear in depth along the view, light of surfaces is replaced by that of the
/// background.
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

/// What is interpolated, besides saturation and value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interpolation {
    /// The hue, along the straight line from −60° to 300° and never round the circle: a hue
    /// stands for a wavelength.
    Hue,
    /// The wavelength.
    Wavelength,
}

/// What of a scene is drawn, and how; apart from its camera and colours.
#[derive(Clone, Copy, Debug)]
pub struct DrawMode {
    /// Faces are intersected by rays; else they are rasterized.
    pub exact: Option<ColorShift>,
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
