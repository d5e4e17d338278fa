//! Errors, with the options that correct them.

use ugpipe::Words;
use ugsky::{Arrangement, PanoramaError};
use ugskybox::OpenError;

use crate::Error;

impl Words for Error {
    fn words(&self) -> String {
        let words = match self {
            Self::Picture(error) => return error.words(),
            Self::Motion(error) => return error.words(),
            Self::NoCamera => "{}: add a `cam` statement to it, or leave out --scene",
            Self::Open(OpenError::Panorama(PanoramaError::Shape {
                arrangement: Arrangement::Equirectangular,
                ..
            })) => {
                "{}: give the angles that it shows with -part WEST EAST SOUTH NORTH, or -part -180 180 -90 90 if it \
                 shows all; a cube map needs -from strip or -from cross"
            }
            Self::Open(OpenError::Panorama(PanoramaError::Shape { .. })) => {
                "{}: a strip is 6 squares across, a cross 4 across and 3 down, or 3 across and 4 down"
            }
            Self::Open(OpenError::Panorama(PanoramaError::Sides { n_files })) => {
                return format!(
                    "{n_files} files were given: -from sides needs six, right, left, up, down, front and back, and \
                     others one; a list of stars is added with --stars FILE"
                );
            }
            Self::Orthographic => "{}: leave out -og",
            Self::NamedCamera => {
                "{}: leave out -cam and give -vc and -va, or name the scene of the camera with --scene"
            }
            Self::OutlineOrGrid => "{}: leave out -dl and -gr",
            Self::Channels => "{} (-ch)",
            Self::Stars => "{} (--star-width, --white)",
            Self::Open(_) | Self::Basis(_) => "{}",
            Self::CubeSize => "{}: give -sz W H with W = 6 H, such as -sz 3072 512",
            Self::AnnotatedCube => "{}: leave out -cap and -lg, or -cube",
        };
        words.replacen("{}", &self.to_string(), 1)
    }

    fn is_usage(&self) -> bool {
        match self {
            Self::Picture(error) => error.is_usage(),
            Self::Motion(error) => error.is_usage(),
            Self::Open(OpenError::Panorama(error)) => {
                matches!(error, PanoramaError::Extent | PanoramaError::Sides { .. })
            }
            Self::Open(_) | Self::NoCamera => false,
            _ => true,
        }
    }
}
