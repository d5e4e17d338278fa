//! Why there is no frame.

use thiserror::Error;

use crate::program::ProgramError;

/// Why there is no frame.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Error {
    /// A program fails.
    #[error(transparent)]
    Program(#[from] ProgramError),
    /// The mean of several moments cannot be drawn.
    #[error(transparent)]
    Picture(#[from] ugpicture::Error),
    /// The mean of several moments has no false colours, channels and areas.
    #[error("the mean of several moments has no false colours, channels or areas")]
    Mean,
    /// The programs do not lead from the subject to a picture.
    #[error("a scene and a panorama are drawn by different programs")]
    Subject,
    /// A frame of a film in one file is a vector figure.
    #[error("vector graphics have no pixels")]
    NoPixels,
}

#[cfg(feature = "cli")]
impl ugpipe::Words for Error {
    fn words(&self) -> String {
        match self {
            Self::Program(error) => error.words(),
            Self::Picture(error) => error.words(),
            Self::Mean => {
                "-blur gives the mean of several moments: leave out -map, -ch and vector formats"
                    .to_owned()
            }
            Self::Subject | Self::NoPixels => self.to_string(),
        }
    }

    fn is_usage(&self) -> bool {
        match self {
            Self::Picture(error) => error.is_usage(),
            other => matches!(other, Self::Mean | Self::NoPixels),
        }
    }
}
