//! Draws a frame by calling the functions of the programs, in the order of its pipe.

use std::ffi::OsString;

use ugimage::{Compression, Format, Frame, LinearFrame, Metadata};
use ugparse::{Provenance, Scene};
use ugpicture::cli::with_format;
use ugpicture::{Image, Output};
use ugpipe::{Failure, ToolArgs, Words, parse_words};
use ugscene::MotionOptions;

use crate::program::Program;
use crate::script::Commands;

/// A frame that was drawn.
#[derive(Clone, Debug)]
pub struct Drawn {
    /// The picture, in memory.
    pub picture: Picture,
    /// Notes and warnings, one sentence each, with the name of the program.
    pub notes: Vec<String>,
}

/// A picture in memory, by the program that drew it.
#[derive(Clone, Debug)]
pub enum Picture {
    Rainbow(ugrainbow::Rendering),
    Photon(ugphoton::Rendering),
    Warp(ugwarp::Rendering),
    /// The mean of several moments.
    Mean(Image, Output, Compression),
}

impl Picture {
    /// The whole file: the bytes that the pipe writes.
    pub fn into_file(self, metadata: &Metadata) -> Vec<u8> {
        match self {
            Self::Rainbow(rendering) => rendering.into_file(metadata),
            Self::Photon(rendering) => rendering.into_file(metadata),
            Self::Warp(rendering) => rendering.into_file(metadata),
            Self::Mean(image, output, compression) => image.into_file(output, metadata, compression),
        }
    }

    /// The pixels that a PNG file of the picture would have.
    ///
    /// # Errors
    /// Vector graphics have no pixels.
    pub fn into_frame(self) -> Result<Frame, Failure> {
        match self {
            Self::Rainbow(rendering) => {
                rendering.into_frame().ok_or_else(|| Failure::usage("vector graphics have no pixels"))
            }
            Self::Photon(rendering) => Ok(rendering.into_frame()),
            Self::Warp(rendering) => Ok(rendering.into_frame()),
            Self::Mean(image, ..) => Ok(image.into_frame()),
        }
    }
}

/// What a film shows.
#[derive(Clone, Copy)]
pub enum Subject<'s> {
    /// A scene at rest.
    Scene(&'s Scene),
    /// A panorama, with the words for its origin.
    Panorama(&'s ugwarp::Opened, &'s str),
}

/// The commands of a frame, parsed by the programs.
pub struct Stages {
    filters: Vec<Filter>,
    last: Last,
}

/// A program from scene to scene.
enum Filter {
    Lorentz(uglorentz::Config, String),
    Doppler(ugdoppler::Config, String),
}

/// The program that draws.
enum Last {
    Rainbow(ugrainbow::Config, String),
    Photon(ugphoton::Config, String),
    Warp(ugwarp::Config, String),
}

impl Stages {
    /// Parses the commands of a frame. `format`: of its file.
    ///
    /// # Errors
    /// [`Failure::Usage`] with the message of the program.
    pub fn new(commands: &Commands, format: Format) -> Result<Self, Failure> {
        let mut filters = Vec::new();
        let mut last = None;
        for (program, words) in &commands.stages {
            match program {
                Program::Lorentz => {
                    let (args, line) = parsed::<uglorentz::Args>(words)?;
                    filters.push(Filter::Lorentz(args.config()?, line));
                }
                Program::Doppler => {
                    let (args, line) = parsed::<ugdoppler::Args>(words)?;
                    filters.push(Filter::Doppler(args.config()?, line));
                }
                Program::Rainbow => {
                    let (args, line) = parsed::<ugrainbow::Args>(words)?;
                    let mut config = args.config(None)?;
                    config.picture.output = match config.picture.output {
                        Output::Vector(_) => Output::Vector(format),
                        _ => Output::Color(format),
                    };
                    let line = with_format(&line, config.picture.output, false);
                    last = Some(Last::Rainbow(config, line));
                }
                Program::Photon => {
                    let (args, line) = parsed::<ugphoton::Args>(words)?;
                    let mut config = args.config(None)?;
                    config.picture.output = Output::Color(format);
                    let line = with_format(&line, config.picture.output, false);
                    last = Some(Last::Photon(config, line));
                }
                Program::Warp => {
                    let (args, line) = parsed::<ugwarp::Args>(words)?;
                    let mut config = args.config(None)?;
                    config.picture.output = Output::Color(format);
                    let line = with_format(&line, config.picture.output, false);
                    last = Some(Last::Warp(config, line));
                }
            }
        }
        let last = last.ok_or_else(|| Failure::failed("no program draws the frame"))?;
        Ok(Self { filters, last })
    }

    /// What the file of the frame says about its making. Of a scene only the comments are used.
    pub fn metadata(&self, subject: Subject<'_>) -> Metadata {
        let mut head = match subject {
            Subject::Scene(scene) => {
                Scene { head: scene.head.clone(), origin: scene.origin.clone(), ..Scene::default() }
            }
            Subject::Panorama(_, origin) => Scene { origin: Some(origin.to_owned()), ..Scene::default() },
        };
        self.filters.iter().for_each(|filter| filter.record(&mut head));
        let (program, line) = match &self.last {
            Last::Rainbow(_, line) => (ugrainbow::PROVENANCE, line),
            Last::Photon(_, line) => (ugphoton::PROVENANCE, line),
            Last::Warp(_, line) => (ugwarp::PROVENANCE, line),
        };
        ugpicture::metadata(&head, Provenance { command: Some(line), ..program })
    }

    /// Draws the frame.
    ///
    /// # Errors
    /// The scene or panorama cannot be drawn with these options.
    pub fn draw(&self, subject: Subject<'_>) -> Result<Drawn, Failure> {
        let mut notes = Vec::new();
        let picture = match (&self.last, subject) {
            (Last::Rainbow(config, _), Subject::Scene(scene)) => {
                let scene = self.filtered(scene, &mut notes)?;
                let rendering = ugrainbow::render(&scene, config).map_err(failed)?;
                notes.extend(named(Program::Rainbow, &words(&rendering.notes)));
                Picture::Rainbow(rendering)
            }
            (Last::Photon(config, _), Subject::Scene(scene)) => {
                let rendering = ugphoton::render(scene.clone(), config).map_err(failed)?;
                notes.extend(named(Program::Photon, &words(&rendering.notes)));
                Picture::Photon(rendering)
            }
            (Last::Warp(config, _), Subject::Panorama(panorama, _)) => {
                let rendering = ugwarp::render(panorama, config).map_err(failed)?;
                notes.extend(named(Program::Warp, &words(&rendering.notes)));
                Picture::Warp(rendering)
            }
            _ => return Err(other_subject()),
        };
        Ok(Drawn { picture, notes })
    }

    /// The same frame in a picture of at most `side` pixels a side, without annotations.
    pub fn small(mut self, side: u32) -> Self {
        shrink(self.picture_mut(), side);
        self
    }

    /// The light of the frame, without exposure.
    ///
    /// # Errors
    /// As of [`Stages::draw`].
    pub fn light(&self, subject: Subject<'_>) -> Result<LinearFrame, Failure> {
        match (&self.last, subject) {
            (Last::Rainbow(config, _), Subject::Scene(scene)) => {
                let scene = self.filtered(scene, &mut Vec::new())?;
                ugrainbow::light(&scene, config).map_err(failed)
            }
            (Last::Photon(config, _), Subject::Scene(scene)) => {
                ugphoton::light(scene.clone(), config).map_err(failed)
            }
            (Last::Warp(config, _), Subject::Panorama(panorama, _)) => {
                ugwarp::light(panorama, config).map_err(failed)
            }
            _ => Err(other_subject()),
        }
    }

    /// How bodies and camera move.
    pub fn motion(&self) -> MotionOptions {
        let of_filter = |filter: &Filter| match filter {
            Filter::Lorentz(config, _) => Some(config.motion()),
            Filter::Doppler(..) => None,
        };
        match &self.last {
            Last::Photon(config, _) => config.motion.clone(),
            Last::Rainbow(..) | Last::Warp(..) => self.filters.iter().find_map(of_filter).unwrap_or_default(),
        }
    }

    /// The picture options of the renderer.
    pub fn picture(&self) -> &ugpicture::PictureOptions {
        match &self.last {
            Last::Rainbow(config, _) => &config.picture,
            Last::Photon(config, _) => &config.picture,
            Last::Warp(config, _) => &config.picture,
        }
    }

    /// The picture options of the renderer, to be changed.
    pub fn picture_mut(&mut self) -> &mut ugpicture::PictureOptions {
        match &mut self.last {
            Last::Rainbow(config, _) => &mut config.picture,
            Last::Photon(config, _) => &mut config.picture,
            Last::Warp(config, _) => &mut config.picture,
        }
    }

    /// How hard its file is compressed.
    pub fn compression(&self) -> Compression {
        if self.picture().small { Compression::Small } else { Compression::Fast }
    }

    /// The scene as the renderer gets it.
    fn filtered(&self, scene: &Scene, notes: &mut Vec<String>) -> Result<Scene, Failure> {
        let mut scene = scene.clone();
        for filter in &self.filters {
            scene = filter.apply(scene, notes)?;
            filter.record(&mut scene);
        }
        Ok(scene)
    }
}

impl Filter {
    fn apply(&self, scene: Scene, notes: &mut Vec<String>) -> Result<Scene, Failure> {
        match self {
            Self::Lorentz(config, _) => {
                let (scene, report) = uglorentz::apply(scene, config).map_err(failed)?;
                notes.extend(named(Program::Lorentz, &report.warnings()));
                notes.extend(named(Program::Lorentz, &report.notes()));
                Ok(scene)
            }
            Self::Doppler(config, _) => {
                let (scene, report) = ugdoppler::apply(scene, config).map_err(failed)?;
                notes.extend(named(Program::Doppler, &words(&report.notes)));
                Ok(scene)
            }
        }
    }

    fn record(&self, scene: &mut Scene) {
        let (program, line) = match self {
            Self::Lorentz(_, line) => (uglorentz::PROVENANCE, line),
            Self::Doppler(_, line) => (ugdoppler::PROVENANCE, line),
        };
        ugscene::record(scene, Provenance { command: Some(line), ..program });
    }
}

fn words(notes: &[impl Words]) -> Vec<String> {
    notes.iter().map(Words::words).collect()
}

fn failed(error: impl Words) -> Failure {
    Failure::failed(error.words())
}

fn other_subject() -> Failure {
    Failure::failed("a scene and a panorama are drawn by different programs")
}

fn parsed<A: ToolArgs>(words: &[String]) -> Result<(A, String), Failure> {
    parse_words(words.iter().map(OsString::from))
}

/// Makes a picture small, without annotations, which would leave no room for the scene.
fn shrink(picture: &mut ugpicture::PictureOptions, side: u32) {
    let [width, height] = picture.size;
    let longest = width.max(height).max(1);
    if longest > side {
        let scaled = |length: u32| ((u64::from(length) * u64::from(side)) / u64::from(longest)).max(1) as u32;
        picture.size = [scaled(width), scaled(height)];
    }
    picture.channels.clear();
    picture.annotations = ugpicture::AnnotationOptions::default();
}

fn named(program: Program, texts: &[String]) -> Vec<String> {
    let name = program.command().get_name().to_owned();
    texts.iter().map(|text| format!("{name}: {text}")).collect()
}
