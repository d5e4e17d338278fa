//! The options of the renderer.

use std::borrow::Cow;

use uglight::{ColorShift, Interpolation};
use ugphysics::{Brightness, Hsv};
use ugpicture::{Output, PictureOptions};
use ugraster::DepthFade;
use ugscene::{HueScale, Projection, Scene, ShownEffects, TooManyPolygons};
use ugskybox::SceneSky;

/// Everything besides the scene that affects the bytes of a picture.
///
/// A later version may have more fields, so complete it with `..Config::default()`.
#[derive(Clone, Debug, PartialEq)]
pub struct Config {
    /// The values that are interpolated between the corners of a face.
    pub interpolation: Interpolation,
    /// Meaning of the hue fields of `c` statements. If they are wavelengths, wavelengths are
    /// interpolated whatever [`Config::interpolation`] says.
    pub hue_scale: HueScale,
    /// Camera, size, samples, format, and other options that renderers share.
    pub picture: PictureOptions,
    /// How the scene is read.
    pub reading: ugparse::Options,
    /// Draw edges of faces as lines.
    pub wireframe: Option<Wireframe>,
    /// Width of lines in pixels, above 0.
    pub line_width: f64,
    /// Fade distant surfaces into the background.
    pub depth_cue: Option<DepthCue>,
    /// Draw faces by a ray for each sample (`-xc`) with this colour shift. The colours of the scene
    /// must be those at rest.
    pub exact: Option<ColorShift>,
    /// What is behind the scene (`-sky`).
    pub sky: SceneSky,
    /// Cull back-facing faces, which run clockwise in the picture.
    pub cull: bool,
    /// Give each vertex a copy per colour of its faces, instead of mixing them (`-vr`).
    pub repeat: bool,
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
            sky: SceneSky::default(),
            cull: false,
            repeat: false,
        }
    }
}

impl Config {
    /// The brightness law of hues: that of the rays, or the one by which the scene was coloured.
    pub(crate) fn law(&self, scene: &Scene) -> Brightness {
        match self.exact {
            Some(ColorShift::Hues(shift)) => shift.law,
            // Spectra are linear light by themselves.
            Some(ColorShift::Spectra(_)) => Brightness::None,
            None => scene.stage.law().unwrap_or(Brightness::None),
        }
    }

    /// The same for a scene: faces with textures are drawn by rays where rays can draw the scene,
    /// with the shift of colours that `ugdoppler` left to them.
    pub(crate) fn with_textures(&self, scene: &Scene) -> Self {
        let camera = scene.camera().and_then(|camera| camera.projection);
        let is_orthographic =
            self.picture.camera.is_orthographic || camera == Some(Projection::Orthographic);
        let may_be_exact = self.has_faces()
            && !(self.cull || is_orthographic)
            && matches!(self.picture.output, Output::Color(_))
            && scene.stage.seen_colors().is_none()
            && ShownEffects::of(scene) == ShownEffects::default()
            && ugscene::require_seen_geometry(scene).is_ok();
        let shift = scene.stage.deferred_colors().map_or(ColorShift::NONE, ColorShift::of_stage);
        let exact =
            self.exact.or((may_be_exact && scene.drawn_texture_name().is_some()).then_some(shift));
        Self { exact, ..self.clone() }
    }

    /// How the colours of the scene are shifted: by rays, or before in the pipe.
    pub(crate) fn shift(&self, scene: &Scene) -> ColorShift {
        match (self.exact, scene.stage.seen_colors()) {
            (Some(shift), _) => shift,
            (None, None) => ColorShift::NONE,
            (None, Some(seen)) => ColorShift::of_stage(seen),
        }
    }

    /// Cuts round faces into polygons, unless rays meet them as they are. An undistorted outline
    /// needs their edges.
    pub(crate) fn cut_rounds(&self, scene: &mut Cow<'_, Scene>) -> Result<(), TooManyPolygons> {
        let is_by_rays = self.exact.is_some() && self.wireframe.is_none();
        if is_by_rays && !self.picture.annotations.outline || !scene.has_rounds() {
            return Ok(());
        }
        let of_scene = scene.camera().and_then(|camera| camera.eye);
        ugscene::cut_rounds_at_rest(scene.to_mut(), self.picture.camera.eye.or(of_scene))
    }

    /// False if faces only occlude lines.
    pub(crate) fn has_faces(&self) -> bool {
        self.wireframe.is_none_or(|wireframe| wireframe.has_faces)
    }
}

/// Width of lines in pixels unless given.
pub const LINE_WIDTH: f64 = 1.2;

/// Edges of faces as lines. They are not lit.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Wireframe {
    /// Draw the faces as well; otherwise they only occlude lines.
    pub has_faces: bool,
    /// Colour of the edges, neither shifted nor attenuated; `None`: the colours of the corners of
    /// their faces.
    pub color: Option<Hsv>,
    /// Which edges.
    pub edges: EdgeKind,
    /// How hidden lines are drawn in a drawing without faces.
    pub hidden: HiddenLines,
}

/// Which edges of faces are drawn. Those that belong to one face, or to more than two, always are.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum EdgeKind {
    /// All, but those between coplanar faces of one colour.
    #[default]
    All,
    /// Those between faces of different colours or whose planes are at least at this angle, in
    /// radians, and the silhouette.
    Creases {
        /// The angle.
        angle: f64,
    },
    /// Those between a face that is seen from the front and one from behind.
    Silhouette,
}

/// What is drawn of the parts of lines that faces occlude.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum HiddenLines {
    /// Nothing.
    #[default]
    Omitted,
    /// Dashes.
    Dashed,
    /// Thin lines.
    Thin,
}

/// Depth cueing: linearly in depth along the view, the light of surfaces is replaced by that of the
/// background.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DepthCue {
    /// Depths between which surfaces fade; `None`: from the nearest to the farthest visible depth.
    pub range: Option<[f64; 2]>,
    /// The part of the light that remains at the far end, 0…1.
    pub least: f64,
}

impl DepthCue {
    /// Default of [`DepthCue::least`].
    pub const LEAST: f64 = 0.2;

    /// Depth cueing between two depths.
    pub(crate) fn between(self, [near, far]: [f64; 2]) -> DepthFade {
        DepthFade { near, far, least: self.least }
    }
}
