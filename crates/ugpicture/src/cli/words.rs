//! Errors and notes, with the options that correct what is wrong.

use ugpipe::{CommonArgs, Words, remedies};
use ugscene::CameraError;

use crate::{Error, Note, WithoutFaces};
use ugtrace::textures::TextureError;

impl Words for Error {
    fn words(&self) -> String {
        let words = match self {
            Self::Size(_) | Self::Memory(..) => "{}; give a smaller -sz",
            Self::Samples(_) => "{}: give another -aa",
            Self::NotPng => "{}: leave out -pz, or write -dt png or png16",
            Self::NotExr => "{}: with -ch write -dt exr",
            Self::NotDeveloped => "{}: leave out -ex and -tc, or write -dt png16",
            Self::NotAnnotated => {
                "{}: leave out -title, -cap, -lg, -dl, -gr, -map and -iso, or write -dt png16; -ch adds channels to EXR"
            }
            Self::MapVectors => "{}: leave out -vec, or -map",
            Self::NoSurfaces => "{}: leave out -map and -iso, or -cube",
            Self::NotTransparent => "{}: leave out -tb, or write -dt exr",
            Self::NoVectors => "{}: with -vec write -dt eps, ps, pdf or svg",
            Self::NoSamples => "{}: leave out -fl or -vec",
            Self::VectorSize => "{}: give a smaller -sz, or leave out -vec",
            Self::TooNarrow => {
                "{}: give a wider -sz, a smaller -ts, or leave out -title, -cap, -lg and -map"
            }
            Self::NoRoom => "{}: give a larger -sz, a smaller -ts, or a shorter -title and -cap",
            Self::Pixel { .. } => "{}; give -sz for a larger one",
            Self::Texture(TextureError { needed_memory: needed @ Some(_), .. }) => {
                return format!("{self}{}", CommonArgs::memory_remedy(*needed));
            }
            Self::Texture(_) => {
                "{}; save it again as PNG or JPEG, or remove its `c_tex`, and its faces have their plain colour"
            }
            Self::Empty(WithoutFaces { n_points: 0, .. }) => {
                "{}; check that the program before in the pipe wrote one"
            }
            Self::Empty(WithoutFaces { has_wires: true, .. }) => {
                "{}; the programs of the pipe draw them"
            }
            Self::Empty(_) => "{}; make a surface of a cloud of points first",
            Self::Text(_) | Self::Stopped(_) => "{}",
            Self::Camera(error) => return error.words(),
        };
        words.replacen("{}", &self.to_string(), 1)
    }

    fn is_usage(&self) -> bool {
        !matches!(
            self,
            Self::Empty(_)
                | Self::Memory(..)
                | Self::Texture(_)
                | Self::Camera(_)
                | Self::Stopped(_)
        ) || *self == Self::Camera(CameraError::NoUp)
    }
}

/// What to do about a film or picture that is nearly black at its exposure.
pub const DARK_REMEDY: &str = "give -ex more stops, or try -look shape";

/// What to do about a film or picture that is overexposed.
pub const BRIGHT_REMEDY: &str = "give -ex fewer stops";

impl Words for Note {
    fn words(&self) -> String {
        let words = match self {
            Self::Scene(note) => return note.words(),
            Self::MovingLights { is_exact } => {
                let remedy = if *is_exact { "leave out -xc: " } else { "" };
                return format!("{self}; {remedy}{}", remedies::MOVING_LIGHTS);
            }
            Self::PlainTextures { .. } => "{}; -xc draws them",
            Self::NotRepeated => remedies::REPEAT_EARLIER,
            Self::UpReplaced => "{}; choose one with -ud",
            Self::NothingInFront => remedies::NOTHING_IN_FRONT,
            Self::NothingInPicture => remedies::NOTHING_IN_PICTURE,
            Self::AllTransparent => "{}; give their colours a translucency below 1",
            Self::NoPanorama => "{}: try another -vc, or a wider -va",
            Self::BackFacing => "{}; leave out -cb, or turn the faces round",
            Self::EdgeOn => "{}; try another -ep",
            Self::TooSmall => "{}; try a nearer -ep, a narrower -va or a larger -sz",
            Self::BlackLines => "{}: choose another colour with -lc or -bg",
            Self::OutOfRange { .. } => remedies::OUT_OF_RANGE,
            Self::BlackFaces | Self::BlackPanorama => {
                "{}; try -look light, or -look shape to see the shape"
            }
            Self::NegativeLight { .. } => "{}; --basis mixture has none",
            Self::EnclosedLamp(_) => "{}: move it out, or give --no-shadows",
            Self::TooDeep { .. } => "{}: a larger -rd shows it",
            Self::CutShort => "{}: give a smaller -rd or a larger -rc",
            Self::Adaptive(_) => "{} (-ad)",
            Self::Exposure(stops) => return format!("{self}; -ex {stops} gives the same picture"),
            Self::NearlyBlack { is_exposed: false } => {
                "{}: try -ex auto, or -look light, which every program of a pipe needs"
            }
            Self::NearlyBlack { is_exposed: true } => return format!("{self}: {DARK_REMEDY}"),
            Self::Overexposed => return format!("{self}: {BRIGHT_REMEDY}"),
            Self::ClippedIntensity { has_light: true, .. } => "{}; -ex auto brings it into range",
            Self::DepthCue { near, far, least } => {
                return format!("{self}; -dc {near} {far} {least} gives the same picture");
            }
            Self::Grid { .. } => return self.to_string().replacen("the grid", "the grid (-gr)", 1),
            Self::NoOutline => return self.to_string().replacen("outline", "outline (-dl)", 1),
            Self::Source(_)
            | Self::NoLights { .. }
            | Self::NoWires
            | Self::LabelsOutside(_)
            | Self::LabelsHidden(_)
            | Self::UnknownNumber
            | Self::NoLabels
            | Self::CutRounds
            | Self::NoLight { .. }
            | Self::OpenSolid(_)
            | Self::ReversedSolid(_)
            | Self::StraightThroughGlass
            | Self::NoStars
            | Self::ClippedIntensity { has_light: false, .. } => "{}",
        };
        words.replacen("{}", &self.to_string(), 1)
    }
}
