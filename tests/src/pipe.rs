//! Runs the pipe in one process: calls the function of each program's library and passes text between them.

use glam::DVec3;
use ugparse::Source;

use crate::picture::{Picture, decode};

/// `uglorentz | ugdoppler | ugrainbow`, with the options of each.
#[derive(Clone, Debug, Default)]
pub struct Pipe {
    /// Options of `uglorentz`.
    pub lorentz: uglorentz::Config,
    /// Options of `ugdoppler`.
    pub doppler: ugdoppler::Config,
    /// The command line of `ugdoppler` in the history; without options if `None`.
    pub doppler_command: Option<String>,
    /// Options of `ugrainbow`.
    pub rainbow: ugrainbow::Config,
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
        pipe.rainbow.size = size;
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
        self.doppler.doppler = false;
        self.doppler.flux = false;
        self
    }

    /// The full horizontal view angle, degrees.
    #[must_use]
    pub fn view_angle(mut self, across_deg: f64) -> Self {
        self.rainbow.camera.view_angle = Some((across_deg, None));
        self
    }

    /// Runs the pipe and returns the output of every program.
    #[track_caller]
    pub fn run(&self, text: &[u8]) -> Stages {
        let seen = lorentz(text, &self.lorentz);
        let command = self.doppler_command.as_deref().unwrap_or("ugdoppler");
        let colored = doppler_as(&seen, &self.doppler, command);
        let file = rainbow(&colored, &self.rainbow);
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
    let report = uglorentz::run(config, &Source::new("test.ug", text));
    report.unwrap_or_else(|error| panic!("uglorentz: {error}")).text()
}

/// `ugdoppler`
#[track_caller]
pub fn doppler(text: &[u8], config: &ugdoppler::Config) -> Vec<u8> {
    doppler_as(text, config, "ugdoppler")
}

/// `ugdoppler`, called by that command line.
#[track_caller]
fn doppler_as(text: &[u8], config: &ugdoppler::Config, command_line: &str) -> Vec<u8> {
    let applied = ugdoppler::apply(read(text), config);
    let (mut scene, _) = applied.unwrap_or_else(|error| panic!("ugdoppler: {error}"));
    ugscene::record(&mut scene, "ugdoppler", env!("CARGO_PKG_VERSION"), command_line);
    ugparse::write(&scene)
}

/// A scene as programs read it.
#[track_caller]
fn read(text: &[u8]) -> ugparse::Scene {
    let parsed = ugscene::read(&Source::new("<stdin>", text), &ugparse::Options::default(), None);
    parsed.unwrap_or_else(|findings| panic!("{findings}")).scene
}

/// `ugrainbow`
#[track_caller]
pub fn rainbow(text: &[u8], config: &ugrainbow::Config) -> Vec<u8> {
    let picture = ugrainbow::run(config, &Source::new("<stdin>", text));
    picture.unwrap_or_else(|error| panic!("ugrainbow: {error}")).bytes
}
