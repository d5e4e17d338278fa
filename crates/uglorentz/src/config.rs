//! Options of `apply`: velocities, eye, time, subdivision.

use glam::DVec3;
use ugphysics::Event;
use ugscene::{Anchor, CameraOptions, MotionOptions, ShownEffects};

/// Default of [`Pieces::UpTo`]: 0.1 milliradians, in radians. A pixel of a picture 40° wide and
/// 1920 pixels across is 0.36, so every edge is right to a third of a pixel.
pub const DEFAULT_ERROR: f64 = 0.1e-3;

/// Default of [`Config::color_error`]: 0.15 percent, or 0.8 nm at 550 nm. The best an eye can do is
/// to distinguish wavelengths that differ by 1 nm (W. D. Wright and F. H. G. Pitt, 1934).
pub const DEFAULT_COLOR_ERROR: f64 = 1.5e-3;

/// The options of the filter.
///
/// A later version may have more fields, so complete it with `..Config::default()`.
#[derive(Clone, Debug)]
pub struct Config {
    /// Velocity of everything, fraction of c; overrides velocities in the scene (`-vel`).
    pub velocity: Option<DVec3>,
    /// Velocity of the camera in the frame of the scene, fraction of c; overrides that of the
    /// scene's camera (`-cv`). Velocities of the input are in the frame of the scene, those of the
    /// output in the frame of the camera.
    pub camera_velocity: Option<DVec3>,
    /// The eye in scene coordinates; overrides the scene's camera (`-ep`).
    pub eye: Option<DVec3>,
    /// Other properties of the camera to write into the scene (`-vc`, `-ud`, `-va`, `-og`). Its eye
    /// is ignored, see [`Config::eye`].
    pub camera: CameraOptions,
    /// Pixels of the picture across and down: for [`Pieces::UpToPixels`]; otherwise only the aspect
    /// ratio matters, for `cull`, and for the camera of a scene without one (`-sz`).
    pub size: [u32; 2],
    /// Remove faces that are outside the view of the picture (`-cull`).
    pub cull: bool,
    /// Time of the picture on the observer's clock, (P5) (`-ti`).
    pub time: f64,
    /// The fixed point of the contraction (`-an`). Default: the reference point of each body, the
    /// eye for what `velocity` moves; the centre of each body if `in_place` is set.
    pub anchor: Option<Anchor>,
    /// Place each body so that its anchor is seen, at time 0, where the scene has it (`-in`).
    pub in_place: bool,
    /// How edges are subdivided (`-se`, `-sd`).
    pub pieces: Pieces,
    /// Bound of the relative error of the Doppler factor, and of its inverse, interpolated linearly
    /// along an edge; infinite for none (`-sc`). Not used with [`Pieces::PerEdge`].
    pub color_error: f64,
    /// Bound of the relative error of the light of near lamps, interpolated linearly along an edge;
    /// infinite, the default, for none (`-sl`). Not used with [`Pieces::PerEdge`].
    pub light_error: f64,
    /// Leave the faces of a scene with textures or emitted light whole: renderers draw it by a ray
    /// for each sample, which is as exact without subdivision. Its stage says so, and programs that
    /// need colours or positions at vertices refuse it. No effect with a single effect of motion,
    /// orthographic projection, or colours that change with time.
    pub is_for_rays: bool,
    /// Measure the remaining errors, for [`crate::Report::remaining_errors`] (`-vb`).
    pub measure: bool,
    /// Give vertices without a normal the mean normal of their faces (`-sm`).
    pub smooth: bool,
    /// Give each vertex a copy per colour of its faces, so that their colours are not mixed
    /// (`-vr`).
    pub repeat: bool,
    /// Which effects to show (`-nc`, `--no-flight-time`).
    pub geometry: ShownEffects,
    /// The event at which the clocks of the camera's frame show 0, see [`MotionOptions::zero`].
    pub zero: Option<Event>,
    /// Where bodies are at one time of this frame, not where they are seen: a scene at rest
    /// (`--measured`).
    pub measured: Option<MeasuredFrame>,
}

/// A frame in whose time bodies are where they are. The eye rests in it. The time of the picture is
/// that of a clock at the eye; in the frame of a body that of the body's own clock.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum MeasuredFrame {
    /// That of the camera.
    Camera,
    /// That of the scene.
    Scene,
    /// That of the body of this name; of one that accelerates or turns, that in which it is at rest
    /// at this time of its own, when it carries the eye.
    Body(String),
}

impl Default for Config {
    fn default() -> Config {
        Config {
            velocity: None,
            camera_velocity: None,
            eye: None,
            camera: CameraOptions::default(),
            size: [1024, 768],
            cull: false,
            time: 0.0,
            anchor: None,
            in_place: false,
            pieces: Pieces::UpTo(DEFAULT_ERROR),
            color_error: DEFAULT_COLOR_ERROR,
            light_error: f64::INFINITY,
            is_for_rays: true,
            measure: false,
            smooth: false,
            repeat: false,
            geometry: ShownEffects::default(),
            zero: None,
            measured: None,
        }
    }
}

impl Config {
    /// The part of it that other renderers share.
    #[must_use]
    pub fn motion(&self) -> MotionOptions {
        MotionOptions {
            velocity: self.velocity,
            camera_velocity: self.camera_velocity,
            time: self.time,
            anchor: self.anchor,
            in_place: self.in_place,
            geometry: match self.measured {
                Some(_) => ShownEffects { flight_time: false, ..ShownEffects::default() },
                None => self.geometry,
            },
            zero: self.zero,
        }
    }
}

/// How edges are subdivided.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pieces {
    /// Until the error of the picture is at most this angle at the eye, radians.
    UpTo(f64),
    /// Until the error of the picture is at most this many pixels of [`Config::size`] in the middle
    /// of the view. Edges that are shorter than a pixel are not cut.
    UpToPixels(f64),
    /// Into this many equal pieces each, 1 or more.
    PerEdge(u32),
}
