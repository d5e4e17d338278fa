//! Why there is no diagram.

use thiserror::Error;
use ugparse::Diagnostics;
use ugphysics::WorldLineError;
use ugscene::{MotionError, TooManyPolygons};

/// Why there is no diagram.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Error {
    /// The text of the scene.
    #[error("the scene has errors")]
    Text(Diagnostics),
    /// The motions of the scene, or its camera.
    #[error(transparent)]
    Motion(#[from] MotionError),
    /// The options of the picture, or its texts.
    #[error(transparent)]
    Picture(#[from] ugpicture::Error),
    /// The round faces of the scene.
    #[error(transparent)]
    Rounds(#[from] TooManyPolygons),
    /// A point cannot move with its body.
    #[error("`{name}`: {error}")]
    WorldLine {
        /// The name of the body or of the vertex.
        name: String,
        /// Why.
        error: WorldLineError,
    },
    /// No body, lamp or camera has this name.
    #[error("nothing is called `{name}`; there are {}", .known.join(", "))]
    UnknownLine {
        /// The name.
        name: String,
        /// The names of all lines.
        known: Vec<String>,
    },
    /// Neither an event nor a vertex has this name.
    #[error("no event and no vertex is called `{0}`")]
    UnknownEvent(String),
    /// Two events have the same name.
    #[error("two events are called `{0}`")]
    SameName(String),
    /// An own time of the frame of the scene or of the camera.
    #[error("`{0}` is one frame at all times of the picture, without an own time to choose")]
    NoOwnTime(String),
    /// The axis is the zero vector.
    #[error("the axis 0 0 0 has no direction")]
    Axis,
    /// The first end of a range is not below the second.
    #[error("the range from {from} to {to} is empty")]
    Range {
        /// The first end.
        from: f64,
        /// The second end.
        to: f64,
    },
    /// The step between ticks is not above 0.
    #[error("ticks are a time above 0 apart, or off")]
    Ticks,
    /// Coordinates overflow.
    #[error("the events of the diagram are too far apart for numbers")]
    OutOfRange,
    /// Text is so large that nothing is left of the picture.
    #[error("a picture of {0} x {1} pixels has no room for a diagram")]
    NoRoom(u32, u32),
}

impl Error {
    /// An error of a body or a vertex.
    pub(crate) fn of_line(name: &str) -> impl Fn(WorldLineError) -> Self {
        move |error| Self::WorldLine { name: name.to_owned(), error }
    }
}
