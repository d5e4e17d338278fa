//! Errors, with the options that correct them.

use ugpipe::Words;

use crate::Error;

impl Words for Error {
    fn words(&self) -> String {
        let words = match self {
            Self::Text(_)
            | Self::TooManyPolygons(_)
            | Self::MovingMedium { .. }
            | Self::WorldLine { .. } => "{}",
            Self::Motion(error) => return error.words(),
            Self::Picture(error) => return error.words(),
            Self::Stage(error) => return error.words(),
            Self::Sky(error) => return error.words(),
            Self::OutOfRange { .. } => {
                "{}: use smaller coordinates, a smaller time (-ti) or a lower speed"
            }
            Self::NoWavelengths => "{}: give -sp, and -dt exr or a file that ends in .exr",
            Self::SkyWavelengths => "{}: leave out -sky and --stage, and `sky` in the scene",
            Self::AnnotatedPart => "{}: leave out -cap, -lg, -dl and -gr, or -crop",
            Self::ExposedPart => "{}: with -crop give the exposure of the whole one in -ex",
            Self::StereoCube => "{}: leave out -stereo, or give -pan instead of -cube",
            Self::CubeSize => "{}: give -sz W H with W = 6 H, such as -sz 3072 512",
            Self::StereoSize => "{}: give an even width in -sz, with -pan an even height",
            Self::AnnotatedViews => "{}: leave out -cap, -lg, -dl and -gr, or -cube and -stereo",
            Self::BentLines => "{}: leave out -dl and -gr, or -pan and -fish",
            Self::FilmShutter => "{}: leave out --film-shutter, or -pan, -fish and -cube",
            Self::Crop { .. } => return self.to_string().replacen("the part", "-crop", 1),
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
