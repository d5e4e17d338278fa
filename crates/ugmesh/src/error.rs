//! The errors of converting a mesh.

use std::fmt;

use thiserror::Error;
use ugmeshfile::Foreign;
use ugparse::Diagnostics;
use ugscene::StageError;

use ugmeshfile::{MeshFormat, Problem};

/// Why a mesh cannot be converted.
#[derive(Debug, Error)]
pub enum Error {
    /// The format of the input cannot be detected.
    UnknownFormat {
        /// The name of the input for messages.
        name: String,
        /// The kind of file it is instead of a mesh, if that is known.
        foreign: Option<Foreign>,
    },
    /// Input and output are both UniGrafix.
    NothingToConvert,
    /// A name of mesh vertices is given for a scene.
    NotMesh,
    /// The input is malformed.
    Malformed {
        /// The name of the input for messages.
        name: String,
        /// The format it was read as.
        format: MeshFormat,
        /// The error, and its place.
        problem: Problem,
    },
    /// The UniGrafix text has errors.
    Scene(#[from] Diagnostics),
    /// The colours of the scene are left to a renderer.
    Stage(#[from] StageError),
    /// Scaling made a coordinate infinite, or the scale factor underflows to 0.
    Overflow,
    /// A coordinate exceeds the range of 32-bit floats, which glTF uses.
    OutOfRange,
    /// The file would be larger than the format allows.
    TooLarge,
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::UnknownFormat { name, foreign: Some(foreign) } => {
                write!(f, "`{name}` is not a mesh but {foreign}; {}", foreign.remedy())
            }
            Self::UnknownFormat { name, foreign: None } => {
                write!(f, "cannot detect the format of `{name}`")
            }
            Self::NothingToConvert => f.write_str("the input is already a UniGrafix scene"),
            Self::NotMesh => f.write_str("the input is a UniGrafix scene, not a mesh"),
            Self::Malformed { name, format, problem: Problem { line, what } } => {
                write!(f, "cannot read `{name}` as {format}: ")?;
                line.iter().try_for_each(|line| write!(f, "line {line}: "))?;
                f.write_str(what)
            }
            Self::Scene(findings) => findings.fmt(f),
            Self::Stage(error) => error.fmt(f),
            Self::Overflow => f.write_str("scaled coordinates are out of range"),
            Self::OutOfRange => f.write_str("coordinates do not fit glTF"),
            Self::TooLarge => f.write_str("the mesh is too large for one glTF file"),
        }
    }
}
