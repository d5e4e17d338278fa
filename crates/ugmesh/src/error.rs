//! Why a mesh was not converted.

use std::fmt;

use ugparse::Diagnostics;

use crate::Format;

/// Why no mesh came out.
#[derive(Debug)]
pub enum Error {
    /// The input looks like none of the formats.
    UnknownFormat {
        /// The input as shown to the user.
        name: String,
    },
    /// Input and output are UniGrafix.
    NothingToConvert,
    /// The input is not what its format says.
    Malformed {
        /// The input as shown to the user.
        name: String,
        /// What it was read as.
        format: Format,
        /// What is wrong, and where.
        problem: Problem,
    },
    /// The UniGrafix text is no scene that can be used.
    Scene(Diagnostics),
    /// Scaling made a coordinate too large for a number, or all of them nothing.
    Overflow,
    /// A coordinate does not fit the 32-bit numbers of glTF.
    OutOfRange,
    /// The mesh has more bytes than the format can count.
    TooLarge,
}

/// What is wrong with a mesh.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem {
    /// Line of a text, from 1.
    pub line: Option<usize>,
    /// What is wrong, and what to do.
    pub what: String,
}

impl Problem {
    pub(crate) fn new(what: impl Into<String>) -> Self {
        Self { line: None, what: what.into() }
    }

    pub(crate) fn at(line: usize, what: impl Into<String>) -> Self {
        Self { line: Some(line), what: what.into() }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::UnknownFormat { name } => {
                write!(
                    f,
                    "cannot tell the format of `{name}`; name it with -if ug, obj, ply, stl, off or gltf"
                )
            }
            Self::NothingToConvert => f.write_str(
                "the input is a UniGrafix scene already; choose a mesh with -dt obj, ply, gltf or glb",
            ),
            Self::Malformed { name, format, problem: Problem { line, what } } => {
                write!(f, "cannot read `{name}` as {format}: ")?;
                line.iter().try_for_each(|line| write!(f, "line {line}: "))?;
                f.write_str(what)
            }
            Self::Scene(findings) => findings.fmt(f),
            Self::Overflow => {
                f.write_str("scaled coordinates are no numbers any more; choose another -scale or -fit")
            }
            Self::OutOfRange => f.write_str(
                "coordinates do not fit glTF; make the mesh smaller (-fit 1) or write PLY (-dt ply)",
            ),
            Self::TooLarge => f.write_str("the mesh is too large for one glTF file; write PLY (-dt ply)"),
        }
    }
}

impl std::error::Error for Error {}

impl From<Diagnostics> for Error {
    fn from(findings: Diagnostics) -> Self {
        Self::Scene(findings)
    }
}
