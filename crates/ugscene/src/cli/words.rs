//! Errors and notes, with the options that correct what is wrong.

use ugpipe::{Words, remedies};

use crate::words::point;
use crate::{CameraError, DefaultCamera, MotionError, Note, StageError};

impl Words for CameraError {
    fn words(&self) -> String {
        let words = match self {
            Self::NoDirection { .. } => "{}; move the eye with -ep or the centre with -vc",
            Self::NoUp => "-ud 0 0 0 has no direction; give one, such as -ud 0 0 1",
            Self::ViewAngle(_) => "{}; give -va more than 0 and less than 180",
            Self::Film => "{}; correct -fs and -fl of the `cam` statement, or give -va",
            Self::FilmRectangle => {
                "{}; give -ph of the `cam` statement as min x, min y, max x, max y"
            }
            Self::Clip(_) => "{}; give -cl of the `cam` statement as hither and a greater yon",
        };
        words.replacen("{}", &self.to_string(), 1)
    }
}

impl Words for StageError {
    fn words(&self) -> String {
        match self {
            Self::GeometryAsSeen => format!("{self}: {}", remedies::SEEN_GEOMETRY),
            Self::ColorsAsSeen => format!("{self}: {}", remedies::SEEN_COLORS),
            Self::ColorsDeferred => format!("{self}: {}", remedies::DEFERRED_COLORS),
            Self::WholeFaces => format!("{self}: {}", remedies::WHOLE_FACES),
            Self::GeometryAtRest => format!("{self}: {}", remedies::GEOMETRY_AT_REST),
            Self::NotWavelengths => {
                format!("{self}: leave out -wi, or {}", remedies::WRITE_WAVELENGTHS)
            }
            Self::OtherEye { asked, .. } => format!(
                "{self}: leave out -ep or -cam here, or {} (-ep {}) with the scene at rest",
                remedies::EYE_POINT,
                point(*asked)
            ),
        }
    }
}

impl Words for Note {
    fn words(&self) -> String {
        match self {
            Self::DefaultCamera(DefaultCamera { eye, center, view_angle_deg }) => format!(
                "no camera in the scene: seen as with -ep {} -vc {} -va {view_angle_deg}",
                point(*eye),
                point(*center)
            ),
            Self::MixedColors(_) => format!("{self}; -vr keeps them apart"),
            Self::SpectraAtRest { .. } => format!("{self}: {}", remedies::SHIFT_SPECTRA),
            Self::OutOfView { time, when: Some(when) } => {
                format!("nothing that moves is in the picture at -ti {time}; it is with -ti {when}")
            }
            Self::OutOfView { when: None, .. } => {
                format!(
                    "{self}: move the eye (-ep) or the view centre (-vc), widen -va, or try -in"
                )
            }
        }
    }
}

impl Words for MotionError {
    fn words(&self) -> String {
        match self {
            Self::Stage(error) => error.words(),
            Self::Velocity(error) => format!("-vel: {error}"),
            Self::CameraVelocity(error) => format!("-cv: {error}"),
            Self::TooFast { .. } => format!("{self} (-cv): make one of them slower"),
            Self::Camera(error) => error.words(),
            Self::Eye { .. } => format!("{self}: move it nearer to the point -at of that motion"),
            Self::WorldLine { .. } => self.to_string(),
            Self::Rounded { .. } => format!("{self}: leave it out, or choose an earlier -ti"),
            Self::PartialGeometry | Self::PartialTimes => {
                format!("{self}: leave out -nc and --no-flight-time, or give --measured FRAME")
            }
        }
    }

    fn is_usage(&self) -> bool {
        matches!(
            self,
            Self::Velocity(_) | Self::CameraVelocity(_) | Self::Camera(CameraError::NoUp)
        )
    }
}
