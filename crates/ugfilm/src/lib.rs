//! Films and figure sequences: `ugfilm` draws a frame for every moment of a change.
//!
//! ```text
//! ugfilm street.ug -frames 240 -cv '0 0 0 .. 0 .99 0' -sp -ex auto -fo drive.mp4
//! ```
//!
//! A film is a pipe whose numbers change. The scene is read once, and every frame is drawn by the
//! functions of the programs, in one process; its file is byte for byte that of the pipe of its
//! own, which `--print` shows.
//!
//! As a library, a frame is a [`Pipe`] of programs with typed options:
//!
//! ```
//! use ugfilm::{FilmSubject, Pipe, Program};
//! use ugparse::{Options, Source};
//!
//! let text = "c red 1 0 1; v a 0 0 0; v b 1 0 0; v c 0 1 0; f (a b c) red; cam -ep 0 0 5;";
//! let scene = ugparse::parse(&Source::new("triangle.ug", text), &Options::default())?.scene;
//! for frame in 0..3 {
//!     let motion = uglorentz::Config { time: f64::from(frame), ..Default::default() };
//!     let mut pipe = Pipe::new(vec![
//!         Program::Lorentz(motion),
//!         Program::Doppler(Default::default()),
//!         Program::Rainbow(Default::default()),
//!     ]);
//!     pipe.picture.size = [40, 30];
//!     let (picture, _notes) = pipe.draw(FilmSubject::Scene(&scene))?;
//!     let file = picture.into_file();
//!     assert!(file.starts_with(b"\x89PNG"));
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Modules
//!
//! Each line imports only from the lines above it:
//!
//! ```text
//! program                                   the programs with typed options
//! error                                     why there is no frame
//! pipe                                      one after the other, for one frame
//! timeline  work  frame_files               numbers over time; threads; numbered files
//! options                                   the options of the programs, as our own
//! script                                    the command lines and programs of every frame
//! series                                    panoramas that are opened frame by frame
//! blur                                      frames while a shutter is open
//! sight  levels                             what will be in view; frames that are nearly black
//! keys  exposure                            key frames; exposures that follow the light
//! film                                      frames, in files or in a film
//! output  print                             where frames go; commands for a shell
//! cli                                       the command line
//! ```

#[cfg(feature = "cli")]
mod blur;
#[cfg(feature = "cli")]
mod cli;
mod error;
#[cfg(feature = "cli")]
mod exposure;
#[cfg(feature = "cli")]
mod film;
#[cfg(feature = "cli")]
mod frame_files;
#[cfg(feature = "cli")]
mod keys;
#[cfg(feature = "cli")]
mod levels;
mod note;
#[cfg(feature = "cli")]
mod options;
#[cfg(feature = "cli")]
mod output;
mod pipe;
#[cfg(feature = "cli")]
mod print;
mod program;
#[cfg(feature = "cli")]
mod script;
#[cfg(feature = "cli")]
mod series;
#[cfg(feature = "cli")]
mod sight;
#[cfg(feature = "cli")]
mod surround;
#[cfg(feature = "cli")]
mod timeline;
#[cfg(feature = "cli")]
mod work;

#[cfg(feature = "cli")]
pub use cli::{Args, run};
pub use error::Error;
pub use note::Note;
#[cfg(feature = "cli")]
pub use options::{ParsedCommand, TOOLS, Tool};
pub use pipe::{FilmSubject, Pipe};
pub use program::{FilmItem, Program, ProgramError};
pub use ugskybox::{SceneSky, SkySource};
