//! Errors and notes, with the options that correct them.

use ugpipe::Words;

use crate::{Error, Note};

impl Words for Error {
    fn words(&self) -> String {
        let words = match self {
            Self::Text(_) | Self::Rounds(_) => "{}",
            Self::Motion(error) => return error.words(),
            Self::Picture(error) => return error.words(),
            Self::WorldLine { .. } => "{}: choose another own time, or leave it out with -show",
            Self::UnknownLine { .. } => "{}",
            Self::UnknownEvent(_) => "{}: name one with --event NAME=T,X",
            Self::SameName(_) => "{}: give each --event a name of its own",
            Self::NoOwnTime(_) => "{}: give the name of a body before `@`",
            Self::Axis => "-axis: {}",
            Self::Range { .. } => "{}: give the smaller number first in -times and -places",
            Self::Ticks => "-ticks: {}, with 400 at most in the diagram",
            Self::OutOfRange => "{}: choose a range with -times and -places",
            Self::NoRoom(..) => "{}: give a larger -sz, or a smaller -ts",
        };
        words.replacen("{}", &self.to_string(), 1)
    }

    fn is_usage(&self) -> bool {
        match self {
            Self::Motion(error) => error.is_usage(),
            Self::Picture(error) => error.is_usage(),
            Self::Text(_) | Self::Rounds(_) | Self::WorldLine { .. } | Self::OutOfRange => false,
            _ => true,
        }
    }

    fn report(&self) -> Option<String> {
        match self {
            Self::Text(diagnostics) => Some(diagnostics.report()),
            _ => None,
        }
    }
}

impl Words for Note {
    fn words(&self) -> String {
        match self {
            Self::Axis { .. } => format!("{self}; -axis X Y Z gives another"),
            Self::Coincident(_) => format!("{self}; -show draws them"),
            Self::Outside(_) => format!("{self}: widen -times and -places"),
            Self::Omitted(_) => format!("{self}: give a larger -sz, or a smaller -ts"),
            Self::OutOfPlane(_) | Self::Interval { .. } => self.to_string(),
        }
    }
}
