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

// Every frame is drawn by the options of programs, so there is no library without command lines.
#![cfg(feature = "cli")]

mod animation;
mod blur;
mod cli;
mod draw;
mod encode;
mod film;
mod frame_files;
mod keys;
mod options;
mod output;
mod print;
mod program;
mod script;
mod timeline;
mod work;

pub use cli::{Args, manual, run};
