//! The options of the filter.

use glam::DVec3;
use uglight::ColorShift;
use ugphysics::Velocity;
use ugscene::HueScale;
use ugskybox::SceneSky;

/// The options of the filter. [`Config::default`] is what the program does without options.
///
/// A later version may have more fields, so complete it with `..Config::default()`.
#[derive(Clone, Debug, PartialEq)]
pub struct Config {
    /// Velocity of faces and wires that carry none (`-vel`).
    pub velocity: Velocity,
    /// The eye; if `None`, that of the scene's camera, else of the default camera (`-ep`).
    pub eye: Option<DVec3>,
    /// Write wavelengths in nm instead of hues (`-gw`).
    pub wavelengths: bool,
    /// How motion changes colours (`-sp`, `-br`, `--no-doppler`, `--no-flux`). With spectra, X, Y,
    /// Z are written, and nothing is clipped.
    pub shift: ColorShift,
    /// Give each vertex a copy per colour of its faces, instead of mixing them (`-vr`).
    pub repeat: bool,
    /// Vertices share a colour statement if their wavelengths differ by at most this many nm and
    /// their values by as many percent; with spectra, if their X, Y and Z do. With 0 every vertex
    /// has its own (`-ct`). From 0 to 100; numbers outside count as the nearest in this range.
    pub tolerance: f64,
    /// Scale all values so that the largest is 1, instead of clipping those above (`-ir`).
    pub iris: bool,
    /// Put the light of the scene's lamps, moving ones included, into the colours (`-li`).
    pub light: bool,
    /// The sky whose light is put into the colours with [`Config::light`] (`-sky`); opened.
    pub sky: SceneSky,
    /// Keep values above 1, instead of clipping them (`-hd`).
    pub keep: bool,
    /// Shift the mean colour of textures, which are left to the renderer otherwise
    /// (`--no-textures`).
    pub no_textures: bool,
}

/// The default of [`Config::tolerance`]. A tenth of a nanometre moves the hue by less than one
/// 8-bit step, a tenth of a percent the value by a quarter of one.
pub const DEFAULT_TOLERANCE: f64 = 0.1;

impl Config {
    /// The tolerance within its range.
    pub(crate) fn bounded_tolerance(&self) -> f64 {
        // NaN counts as 0.
        if self.tolerance > 0.0 { self.tolerance.min(100.0) } else { 0.0 }
    }
}

impl Default for Config {
    fn default() -> Self {
        Self {
            velocity: Velocity::ZERO,
            eye: None,
            wavelengths: false,
            shift: ColorShift::default(),
            repeat: false,
            tolerance: DEFAULT_TOLERANCE,
            iris: false,
            light: false,
            sky: SceneSky::default(),
            keep: false,
            no_textures: false,
        }
    }
}

impl Config {
    /// The unit of hues in the output.
    pub(crate) fn hue_scale(&self) -> HueScale {
        if self.wavelengths { HueScale::Wavelengths } else { HueScale::Degrees }
    }
}
