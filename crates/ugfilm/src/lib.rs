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
//! # Modules
//!
//! Each line imports only from the lines above it:
//!
//! ```text
//! timeline  program  work  frame_files      numbers over time; programs; threads; numbered files
//! options                                   the options of the programs, as our own
//! script                                    the command lines of every frame
//! animation                                 animated PNG and GIF
//! keys  draw  encode                        key frames; functions of the programs; film formats
//! blur                                      frames while a shutter is open
//! film                                      frames, in files or in a film
//! output  print                             where frames go; commands for a shell
//! cli                                       the command line
//! ```

#[cfg(feature = "cli")]
mod animation;
#[cfg(feature = "cli")]
mod blur;
#[cfg(feature = "cli")]
mod cli;
#[cfg(feature = "cli")]
mod draw;
#[cfg(feature = "cli")]
mod encode;
#[cfg(feature = "cli")]
mod film;
#[cfg(feature = "cli")]
mod frame_files;
#[cfg(feature = "cli")]
mod keys;
#[cfg(feature = "cli")]
mod options;
#[cfg(feature = "cli")]
mod output;
#[cfg(feature = "cli")]
mod print;
#[cfg(feature = "cli")]
mod program;
#[cfg(feature = "cli")]
mod script;
#[cfg(feature = "cli")]
mod timeline;
#[cfg(feature = "cli")]
mod work;

#[cfg(feature = "cli")]
pub use cli::{Args, manual, run};
