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
            Self::Orthographic => {
                "light from all directions meets at one point, so there is no -og: leave it out"
            }
            Self::NamedCamera => {
                "{}: leave out -cam and give -vc and -va, or name the scene of the camera with --scene"
            }
            Self::OutlineOrGrid => "outline and grid (-dl, -gr) are for scenes: leave them out",
            Self::Channels => {
                "a sky has no time, distance, Z or id (-ch): the channels of a panorama are D, direction and velocity"
            }
            Self::Stars => {
                "stars (--star-width, --white) are 0.5 to 50 pixels wide, and white has a magnitude from -60 to 60"
            }
            Self::Open(_) | Self::Basis(_) => "{}",
            Self::CubeSize => {
                "a cube map (-cube) is six squares side by side: give -sz W H with W = 6 H, such as -sz 3072 512"
            }
            Self::AnnotatedCube => {
                "annotations (-cap, -lg) are for pictures of a single view: leave out -cube"
            }
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
