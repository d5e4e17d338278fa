//! Errors, with the options that correct them.

use ugparse::{Diagnostic, Diagnostics, Origins, Source};
use ugpipe::Words;

use crate::Error;
use crate::adaptive::MAX_PIECES;

const AT_EYE: &str = "move the eye (-ep) or the vertex";
const OUT_OF_RANGE: &str = "use smaller coordinates, a smaller time (-ti) or a lower speed";

impl Words for Error {
    fn words(&self) -> String {
        match self {
            Self::Motion(error) => error.words(),
            Self::Camera(error) => error.words(),
            Self::NoViewCenter => {
                "-cull needs the view centre of the camera: give it with -vc, or in the `cam` \
                                   statement of the scene"
                    .to_owned()
            }
            Self::NoBound { error } => {
                format!("the bound of -se is {} milliradians: give a number above 0", error * 1e3)
            }
            Self::NoColorBound { error } => {
                format!("the bound of -sc is {} percent: give a number above 0, or off", error * 1e2)
            }
            Self::NoLightBound { error } => {
                format!("the bound of -sl is {} percent: give a number above 0, or off", error * 1e2)
            }
            Self::NoPieces => "-sd 0 would make no pieces: give 1 or more".to_owned(),
            Self::TooManyPieces { n_pieces } => format!(
                "-sd would make {n_pieces} pieces, more than the limit of {MAX_PIECES}: give fewer, or use -se, \
                 which subdivides only where it is visible"
            ),
            Self::VertexAtEye { .. } => format!("{self}: {AT_EYE}"),
            Self::OutOfRange { .. } => format!("{self}: {OUT_OF_RANGE}"),
        }
    }
}

impl Error {
    /// The error with its place in the text of the scene; `None` if it is not about a vertex.
    pub fn diagnostics(&self, source: &Source, origins: &Origins) -> Option<Diagnostics> {
        let (row, remedy) = match self {
            Self::VertexAtEye { row, .. } => (row, AT_EYE),
            Self::OutOfRange { row, .. } => (row, OUT_OF_RANGE),
            _ => return None,
        };
        let finding = Diagnostic::error(*origins.vertices.get(*row)?, self.to_string()).label("this vertex");
        Some(Diagnostics::one(source, finding.help(remedy)))
    }
}
