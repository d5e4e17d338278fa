//! Errors, with the options that correct them.

use ugpipe::Words;

use crate::Error;

impl Words for Error {
    fn words(&self) -> String {
        let words = match self {
            Self::Text(_)
            | Self::Empty
            | Self::TooManyPolygons(_)
            | Self::MovingMedium { .. }
            | Self::WorldLine { .. } => "{}",
            Self::Motion(error) => return error.words(),
            Self::Picture(error) => return error.words(),
            Self::Stage(error) => return error.words(),
            Self::Sky(error) => return error.words(),
            Self::OutOfRange { .. } => "{}: use smaller coordinates, a smaller time (-ti) or a lower speed",
            Self::NoWavelengths => "{}: give -sp, and -dt exr or a file that ends in .exr",
            Self::SkyWavelengths => "{}: leave out -sky and --stage, and `sky` in the scene",
            Self::AnnotatedPart => {
                "annotations (-cap, -lg, -dl, -gr) are for whole pictures: leave them out, or -crop"
            }
            Self::ExposedPart => {
                "-ex auto would differ between the parts of a picture: with -crop give the exposure of the \
                 whole one"
            }
            Self::StereoCube => "{}: leave out -stereo, or give -pan instead of -cube",
            Self::CubeSize => {
                "a cube map (-cube) is six squares side by side: give -sz W H with W = 6 H, such as -sz 3072 512"
            }
            Self::StereoSize => {
                "the pictures of both eyes (-stereo) are side by side, with -pan one above the other: give an \
                 even width in -sz, with -pan an even height"
            }
            Self::AnnotatedViews => {
                "annotations (-cap, -lg, -dl, -gr) are for pictures of a single view: leave them out, or -cube \
                 and -stereo"
            }
            Self::BentLines => {
                "outline and grid (-dl, -gr) are straight lines of pinhole cameras: leave them out, or -pan and \
                 -fish"
            }
            Self::FilmShutter => {
                "--film-shutter is for pinhole cameras, whose film is flat: leave it out, or -pan, -fish and \
                 -cube"
            }
            Self::Crop { crop: [left, top, width, height], size } => {
                return format!(
                    "-crop {left} {top} {width} {height} is not in the picture of {} x {} pixels: \
                     columns and rows count from 0 at the upper left",
                    size[0], size[1]
                );
            }
            Self::TooManyLights { .. } => "{}: give fewer lights, a smaller -sz, or a smaller -aa",
            Self::Orthographic => "{}: leave out -og (in the scene, too)",
            // No option leaves a part of the geometry out.
            Self::PartialGeometry => "{}",
            Self::MovingSpectrum => {
                "{}: give -sp to shift all colours as spectra, or --no-doppler --no-flux to see the shape"
            }
        };
        words.replacen("{}", &self.to_string(), 1)
    }

    fn is_usage(&self) -> bool {
        match self {
            Self::Picture(error) => error.is_usage(),
            Self::Motion(error) => error.is_usage(),
            Self::Sky(error) => error.is_usage(),
            Self::Text(_)
            | Self::Empty
            | Self::OutOfRange { .. }
            | Self::TooManyLights { .. }
            | Self::Orthographic
            | Self::PartialGeometry
            | Self::MovingSpectrum
            | Self::Stage(_) => false,
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
