//! Runs the pipe in one process: calls the function of each program's library and passes text
//! between them.

use glam::DVec3;
use ugparse::{Options, Parsed, Source};
use ugscene::{Provenance, Scene};

use crate::picture::{Picture, decode};

/// `uglorentz | ugdoppler | ugrainbow`, with the options of each.
#[derive(Clone, Debug, Default)]
pub struct Pipe {
    /// Options of `uglorentz`.
    pub lorentz: uglorentz::Config,
    /// The command line of `uglorentz` in the history; without options if `None`.
    pub lorentz_command: Option<String>,
    /// Options of `ugdoppler`.
    pub doppler: ugdoppler::Config,
    /// The command line of `ugdoppler` in the history; without options if `None`.
    pub doppler_command: Option<String>,
    /// Options of `ugrainbow`.
    pub rainbow: ugrainbow::Config,
    /// How `ugrainbow` was called, for the history in the file.
    pub rainbow_command_line: String,
}

/// The output of every program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Stages {
    /// From `uglorentz`: the scene as seen.
    pub seen: Vec<u8>,
    /// From `ugdoppler`: the same with observed colours.
    pub colored: Vec<u8>,
    /// From `ugrainbow`: the picture file.
    pub file: Vec<u8>,
}

impl Pipe {
    /// Everything moves with `beta`; the picture has `size` pixels.
    pub fn new(beta: DVec3, size: [u32; 2]) -> Self {
        let mut pipe = Self::default();
        pipe.lorentz.velocity = Some(beta);
        pipe.rainbow.picture.size = size;
        pipe
    }

    /// Bodies appear at their coordinates in the scene (`-in`).
    #[must_use]
    pub fn in_place(mut self) -> Self {
        self.lorentz.in_place = true;
        self
    }

    /// Rest-frame colours (`--no-doppler --no-flux`).
    #[must_use]
    pub fn shape(mut self) -> Self {
        self.doppler.shift = uglight::ColorShift::NONE;
        self
    }

    /// The full horizontal view angle, degrees.
    #[must_use]
    pub fn view_angle(mut self, across_deg: f64) -> Self {
        self.rainbow.picture.camera.view_angle = Some((across_deg, None));
        self
    }

    /// Runs the pipe and returns the output of every program.
    #[track_caller]
    pub fn run(&self, text: &[u8]) -> Stages {
        let command = self.lorentz_command.as_deref().unwrap_or("uglorentz");
        let seen = lorentz_as(text, &self.lorentz, command);
        let command = self.doppler_command.as_deref().unwrap_or("ugdoppler");
        let colored = doppler_as(&seen, &self.doppler, command);
        let file = rainbow_as(&colored, &self.rainbow, &self.rainbow_command_line);
        Stages { seen, colored, file }
    }

    /// Runs the pipe and decodes the picture.
    #[track_caller]
    pub fn draw(&self, text: &[u8]) -> Picture {
        decode(&self.run(text).file)
    }
}

/// `uglorentz`
#[track_caller]
pub fn lorentz(text: &[u8], config: &uglorentz::Config) -> Vec<u8> {
    lorentz_as(text, config, "uglorentz")
}

/// `uglorentz`, called by that command line.
#[track_caller]
fn lorentz_as(text: &[u8], config: &uglorentz::Config, command_line: &str) -> Vec<u8> {
    let (mut scene, _) =
        lorentz_scene(text, config).unwrap_or_else(|error| panic!("uglorentz: {error}"));
    scene.head.record(Provenance { command: Some(command_line), ..uglorentz::PROVENANCE });
    ugparse::write_with(&scene, &read(text, None).passed_on)
}

/// The scene that `uglorentz` writes, and its report. In a scene without a camera the eye is at the
/// origin, unless the options say otherwise.
///
/// # Errors
/// See [`uglorentz::Error`].
///
/// # Panics
/// If the text is invalid.
#[track_caller]
pub fn lorentz_scene(
    text: &[u8],
    config: &uglorentz::Config,
) -> Result<(Scene, uglorentz::Report), uglorentz::Error> {
    let scene = read(text, config.camera.name.as_deref()).scene;
    let origin = scene.cameras.is_empty().then_some(DVec3::ZERO);
    uglorentz::apply(scene, &uglorentz::Config { eye: config.eye.or(origin), ..config.clone() })
}

/// `ugdoppler`
#[track_caller]
pub fn doppler(text: &[u8], config: &ugdoppler::Config) -> Vec<u8> {
    doppler_as(text, config, "ugdoppler")
}

/// `ugdoppler`, called by that command line.
#[track_caller]
fn doppler_as(text: &[u8], config: &ugdoppler::Config, command_line: &str) -> Vec<u8> {
    let Parsed { scene, passed_on, .. } = read(text, None);
    let (mut scene, _) =
        ugdoppler::apply(scene, config).unwrap_or_else(|error| panic!("ugdoppler: {error}"));
    scene.head.record(Provenance { command: Some(command_line), ..ugdoppler::PROVENANCE });
    ugparse::write_with(&scene, &passed_on)
}

/// A scene as programs read it. `camera`: the option `-cam`.
#[track_caller]
fn read(text: &[u8], camera: Option<&str>) -> Parsed {
    let parsed = ugparse::read(&Source::new("<stdin>", text), &Options::default(), camera);
    parsed.unwrap_or_else(|findings| panic!("{findings}"))
}

/// `ugrainbow`
#[track_caller]
pub fn rainbow(text: &[u8], config: &ugrainbow::Config) -> Vec<u8> {
    rainbow_as(text, config, "")
}

/// `ugrainbow`, with its command line in the history of the file.
#[track_caller]
pub fn rainbow_as(text: &[u8], config: &ugrainbow::Config, command_line: &str) -> Vec<u8> {
    let command = Some(command_line).filter(|line| !line.is_empty());
    let provenance = Provenance { command, ..ugrainbow::PROVENANCE };
    let picture = ugrainbow::run_with(config, &Source::new("<stdin>", text), provenance, &());
    picture.unwrap_or_else(|error| panic!("ugrainbow: {error}")).bytes
}
