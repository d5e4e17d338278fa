//! The programs that make a frame.

use clap::{Command, CommandFactory};

/// A program of the family, whose functions are called in this process.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Program {
    /// Positions as seen.
    Lorentz,
    /// Colours as seen.
    Doppler,
    /// The picture, of a scene as seen.
    Rainbow,
    /// The picture, by tracing rays.
    Photon,
    /// The view of a panorama.
    Warp,
}

impl Program {
    /// All of them, in the order in which their options are listed.
    pub const ALL: [Self; 5] = [Self::Lorentz, Self::Doppler, Self::Rainbow, Self::Photon, Self::Warp];

    /// The heading of its options in `--help`.
    pub fn heading(self) -> &'static str {
        match self {
            Self::Lorentz => "Options of uglorentz",
            Self::Doppler => "Options of ugdoppler",
            Self::Rainbow => "Options of ugrainbow",
            Self::Photon => "Options of ugphoton",
            Self::Warp => "Options of ugwarp",
        }
    }

    /// Its command line.
    pub fn command(self) -> Command {
        match self {
            Self::Lorentz => uglorentz::Args::command(),
            Self::Doppler => ugdoppler::Args::command(),
            Self::Rainbow => ugrainbow::Args::command(),
            Self::Photon => ugphoton::Args::command(),
            Self::Warp => ugwarp::Args::command(),
        }
    }
}

/// How a frame is drawn: the programs of its pipe, the last of which draws.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// The pipe of three programs.
    Pipe,
    /// The pipe without the program that colours vertices: the renderer computes the light of every
    /// sample (`-xc`).
    Exact,
    /// The ray tracer alone.
    Rays,
    /// Views of a panorama.
    Warp,
}

impl Method {
    /// The programs in the order of the pipe.
    pub fn programs(self) -> &'static [Program] {
        match self {
            Self::Pipe => &[Program::Lorentz, Program::Doppler, Program::Rainbow],
            Self::Exact => &[Program::Lorentz, Program::Rainbow],
            Self::Rays => &[Program::Photon],
            Self::Warp => &[Program::Warp],
        }
    }
}
