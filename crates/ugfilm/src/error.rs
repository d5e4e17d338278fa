//! Why there is no frame.

use thiserror::Error;

/// Why there is no frame.
#[derive(Debug, Error)]
pub enum Error {
    /// The scene has no apparent positions.
    #[error(transparent)]
    Lorentz(#[from] uglorentz::Error),
    /// The scene has no apparent colours.
    #[error(transparent)]
    Doppler(#[from] ugdoppler::Error),
    /// The scene as seen cannot be drawn.
    #[error(transparent)]
    Rainbow(#[from] ugrainbow::Error),
    /// The scene at rest cannot be drawn.
    #[error(transparent)]
    Photon(#[from] ugphoton::Error),
    /// The panorama cannot be drawn.
    #[error(transparent)]
    Warp(#[from] ugwarp::Error),
    /// The mean of several moments cannot be drawn.
    #[error(transparent)]
    Picture(#[from] ugpicture::Error),
    /// The mean of several moments has no legend, grid, outlines, channels and areas.
    #[error("the mean of several moments has no legend, grid, outlines, channels or areas")]
    Mean,
    /// The programs do not lead from the subject to a picture.
    #[error("a scene and a panorama are drawn by different programs")]
    Subject,
    /// A frame of a film in one file is a vector figure.
    #[error("vector graphics have no pixels")]
    NoPixels,
}

impl Error {
    /// True if the options are wrong, whatever the subject.
    pub fn is_usage(&self) -> bool {
        match self {
            Self::Picture(error) => error.is_usage(),
            other => matches!(other, Self::Mean | Self::NoPixels),
        }
    }
}

#[cfg(feature = "cli")]
impl ugpipe::Words for Error {
    fn words(&self) -> String {
        match self {
            Self::Lorentz(error) => error.words(),
            Self::Doppler(error) => error.words(),
            Self::Rainbow(error) => error.words(),
            Self::Photon(error) => error.words(),
            Self::Warp(error) => error.words(),
            Self::Picture(error) => error.words(),
            Self::Mean => {
                "-blur gives the mean of several moments: leave out -lg, -gr, -dl, -ch and vector formats"
                    .to_owned()
            }
            Self::Subject | Self::NoPixels => self.to_string(),
        }
    }
}
