//! The errors of converting a mesh.

use thiserror::Error;
use ugmeshfile::Foreign;
use ugparse::Diagnostics;
use ugscene::StageError;

use ugmeshfile::{MeshFormat, Problem};

/// Why a mesh cannot be converted.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Error {
    /// The format of the input cannot be detected.
    #[error("{}", unknown_format(name, *foreign))]
    UnknownFormat {
        /// The name of the input for messages.
        name: String,
        /// The kind of file it is instead of a mesh, if that is known.
        foreign: Option<Foreign>,
    },
    /// Input and output are both UniGrafix.
    #[error("the input is already a UniGrafix scene")]
    NothingToConvert,
    /// A name of mesh vertices is given for a scene.
    #[error("the input is a UniGrafix scene, not a mesh")]
    NotMesh,
    /// The input is malformed.
    #[error("cannot read `{name}` as {format}: {}{}", place(problem), problem.what)]
    Malformed {
        /// The name of the input for messages.
        name: String,
        /// The format it was read as.
        format: MeshFormat,
        /// The error, and its place.
        problem: Problem,
    },
    /// The UniGrafix text has errors.
    #[error(transparent)]
    Scene(#[from] Diagnostics),
    /// The colours of the scene are left to a renderer.
    #[error(transparent)]
    Stage(#[from] StageError),
    /// Scaling made a coordinate infinite, or the scale factor underflows to 0.
    #[error("scaled coordinates are out of range")]
    Overflow,
    /// A coordinate exceeds the range of 32-bit floats, which glTF uses.
    #[error("coordinates do not fit glTF")]
    OutOfRange,
    /// The file would be larger than the format allows.
    #[error("the mesh is too large for one glTF file")]
    TooLarge,
}

fn unknown_format(name: &str, foreign: Option<Foreign>) -> String {
    match foreign {
        Some(foreign) => format!("`{name}` is not a mesh but {foreign}; {}", foreign.remedy()),
        None => format!("cannot detect the format of `{name}`"),
    }
}

fn place(problem: &Problem) -> String {
    problem.line.map_or_else(String::new, |line| format!("line {line}: "))
}
