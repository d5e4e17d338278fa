//! Notes on a picture, above all why it is empty.

use std::fmt;

/// A note on a picture.
#[derive(Clone, Debug, PartialEq)]
pub enum Note {
    /// About its scene.
    Scene(ugscene::Note),
    /// About the file of its panorama, or of its stars.
    Source(String),
    /// The scene has no lights.
    NoLights {
        /// The ambient light in place of them.
        ambient: f64,
        /// The light from the eye in place of them.
        from_eye: f64,
        /// Lights of a scene would cast shadows, and these do not.
        has_shadows: bool,
    },
    /// Lights of the scene move.
    MovingLights {
        /// The picture is drawn by rays.
        is_exact: bool,
    },
    /// A colour is a picture, and only its plain colour is drawn.
    PlainTextures {
        /// Its name.
        color: String,
    },
    /// Vertices are to be repeated, but have colours as seen.
    NotRepeated,
    /// So many labels are at vertices outside the picture.
    LabelsOutside(usize),
    /// So many labels are at vertices in the picture that faces hide.
    LabelsHidden(usize),
    /// Only a pinhole camera shows labels.
    NoLabels,
    /// A caption or title has a number by its name, which is known in films.
    UnknownNumber,
    /// A body that a picture of the whole size shows is cut.
    CutByText,
    /// Rays do not meet wires.
    NoWires,
    /// Round faces of bodies on world lines are drawn as polygons.
    CutRounds,
    /// The up direction is zero or parallel to the view.
    UpReplaced,
    /// Everything is behind the eye or outside the clipping distances.
    NothingInFront,
    /// Everything is outside the picture.
    NothingInPicture,
    /// No ray meets a face.
    NothingMet,
    /// The panorama is outside the picture.
    NoPanorama,
    /// The list has no stars.
    NoStars,
    /// Everything is culled, or smaller than a sample.
    BackFacing,
    /// Everything is seen edge-on, or smaller than a sample.
    EdgeOn,
    /// Black lines on a black background.
    BlackLines,
    /// No light falls on the scene, or its colours are black.
    NoLight {
        /// True if the scene has lights.
        has_lights: bool,
    },
    /// Wavelengths are shifted out of the visible range.
    OutOfRange {
        /// How much of what is in the picture, rounded down.
        percent: u64,
        /// All of it is black; otherwise a part, or some is grey.
        is_black: bool,
    },
    /// No light falls on what rays meet, or its wavelengths are shifted out of the visible range.
    BlackFaces,
    /// The wavelengths of a panorama are shifted out of the visible range.
    BlackPanorama,
    /// The light of a panorama is a sum of black bodies, some of a negative amount, and is negative
    /// in this part of what is in the picture.
    NegativeLight {
        /// In percent.
        percent: f64,
    },
    /// Light passes into a transparent solid around an edge of this face.
    OpenSolid(String),
    /// Light leaves a transparent solid that it did not enter, at this face.
    ReversedSolid(String),
    /// Light of lamps may cross a refracting solid.
    StraightThroughGlass,
    /// The lamp of this name is in a closed opaque body.
    EnclosedLamp(String),
    /// Samples end at the greatest depth.
    TooDeep {
        /// How many of them.
        percent: f64,
        /// Reflections and refractions.
        depth: u32,
    },
    /// Paths with too many branches.
    CutShort,
    /// The percentage of samples that were traced.
    Adaptive(f64),
    /// Automatic exposure, in stops.
    Exposure(f64),
    /// Hardly any pixel is bright enough to be visible.
    NearlyBlack {
        /// An exposure was given.
        is_exposed: bool,
    },
    /// Many pixels are white, where details may be lost.
    Overexposed,
    /// Brightness up to this was clipped.
    ClippedIntensity {
        /// The largest one.
        most: f32,
        /// They could have been exposed.
        has_light: bool,
    },
    /// The depths between which light fades.
    DepthCue {
        /// Where it begins.
        near: f64,
        /// Where it ends.
        far: f64,
        /// The part of the light that remains.
        least: f64,
    },
    /// The grid of the ground.
    Grid {
        /// The distance between its lines; `None` if none is in the picture.
        step: Option<String>,
        /// The height of its plane.
        level: String,
    },
    /// Nothing moves that could have an undistorted outline.
    NoOutline,
}

impl Note {
    /// True if it says that nothing is in the picture.
    pub fn is_of_empty(&self) -> bool {
        matches!(
            self,
            Self::NothingInFront
                | Self::NothingInPicture
                | Self::NothingMet
                | Self::NoPanorama
                | Self::NoStars
                | Self::BackFacing
                | Self::EdgeOn
        )
    }

    /// True if it says that all that is in the picture is black.
    pub fn is_of_black(&self) -> bool {
        matches!(
            self,
            Self::BlackLines
                | Self::NoLight { .. }
                | Self::OutOfRange { percent: 100, is_black: true }
                | Self::BlackFaces
                | Self::BlackPanorama
        )
    }

    /// True if it says that the picture is nearly black or overexposed.
    pub fn is_of_levels(&self) -> bool {
        matches!(self, Self::NearlyBlack { .. } | Self::Overexposed)
    }
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let text = match self {
            Self::Scene(note) => return note.fmt(f),
            Self::Source(text) => text,
            Self::NoLights { ambient, from_eye, has_shadows } => {
                write!(
                    f,
                    "no lights in the scene: drawn with ambient light {ambient} and a light of {from_eye} from the eye"
                )?;
                if *has_shadows { ", without shadows" } else { "" }
            }
            Self::MovingLights { .. } => {
                "velocities of lights are left out: each light rests with the faces it lights"
            }
            Self::PlainTextures { color } => {
                return write!(f, "textures are not drawn: faces of colour `{color}` have its plain colour");
            }
            Self::NotRepeated => "vertices with colours as seen are not repeated",
            Self::CutRounds => {
                "round faces of bodies that accelerate or turn are drawn as polygons, to 1/4000 of their radius"
            }
            Self::LabelsOutside(1) => "a label is at a vertex outside the picture",
            Self::LabelsOutside(n) => return write!(f, "{n} labels are at vertices outside the picture"),
            Self::LabelsHidden(1) => "a label is left out, because faces hide its vertex",
            Self::LabelsHidden(n) => {
                return write!(f, "{n} labels are left out, because faces hide their vertices");
            }
            Self::NoLabels => "labels are left out: only pictures of a single pinhole camera have them",
            Self::UnknownNumber => {
                "only captions and titles of films have numbers in place of {beta}, {t} ..."
            }
            Self::CutByText => {
                "title, caption or legend take rows from the picture, which cut off a part of a body"
            }
            Self::NoWires => "wires are left out: rays do not meet lines",
            Self::UpReplaced => "the up direction is zero or parallel to the view, so another axis is up",
            Self::NothingInFront => {
                "nothing is drawn: everything is behind the eye or outside the clipping distances"
            }
            Self::NothingInPicture | Self::NothingMet => {
                "nothing is drawn: everything is outside the picture, where fast bodies often are"
            }
            Self::NoPanorama => "the picture shows no part of the panorama",
            Self::NoStars => "the list has no stars",
            Self::BackFacing => "nothing is drawn: everything is seen from behind, or smaller than a sample",
            Self::EdgeOn => "nothing is drawn: everything is seen edge-on or smaller than a sample",
            Self::BlackLines => "the lines are black on black",
            Self::NoLight { has_lights: false } => {
                "all that is in the picture is black: its colours are, or no light falls on it; try `l 1;` in the scene"
            }
            Self::NoLight { has_lights: true } => {
                "all that is in the picture is black: its colours are, or the light of its lamps does not reach it at this time, or falls between the vertices"
            }
            Self::OutOfRange { percent, is_black } => {
                match percent {
                    100 if *is_black => write!(f, "all that is in the picture is black"),
                    100 => write!(f, "all that is in the picture is black or grey"),
                    _ => write!(f, "{percent} percent of what is in the picture is black or grey"),
                }?;
                ": its wavelengths are outside 380-780 nm"
            }
            Self::BlackFaces => {
                "all that is in the picture is black: no light falls on it, or its wavelengths are outside \
                 380-780 nm"
            }
            Self::BlackPanorama => {
                "all that is in the picture is black: its wavelengths are outside 380-780 nm"
            }
            Self::NegativeLight { percent } => {
                return write!(
                    f,
                    "the three temperatures of the basis add up to negative light, drawn as black, in {percent:.1} \
                     percent of what is in the picture"
                );
            }
            Self::OpenSolid(face) => {
                return write!(
                    f,
                    "the transparent solid of {face} is open, so everything behind the face is drawn as if it \
                     were inside: close it with faces on all sides, or take a translucent colour for a thin pane"
                );
            }
            Self::ReversedSolid(face) => {
                return write!(
                    f,
                    "light leaves a transparent solid that it did not enter, at {face}: its outlines run \
                     clockwise seen from outside, or the solid has gaps; it is drawn as if it were not \
                     refracted there"
                );
            }
            Self::StraightThroughGlass => {
                "light of lamps goes straight through transparent solids: it is absorbed there, but not \
                 refracted, and slowed only if lamp and surface rest in the same solid"
            }
            Self::EnclosedLamp(name) => {
                return write!(f, "the light of lamp `{name}` does not leave the closed body that it is in");
            }
            Self::TooDeep { percent, depth } => {
                return write!(
                    f,
                    "{percent:.1} percent of the samples end after {depth} reflections and refractions, and what is \
                     behind is black"
                );
            }
            Self::CutShort => "some paths branch at too many mirrors and solids, and are cut short",
            Self::Adaptive(percent) => return write!(f, "traced {percent:.0} percent of the samples"),
            Self::Exposure(stops) => return write!(f, "exposure is {stops} stops"),
            Self::NearlyBlack { .. } => "hardly anything is bright enough to be seen",
            Self::Overexposed => "more than a tenth of what is in the picture is white",
            Self::ClippedIntensity { most, .. } => {
                return write!(f, "max intensity is {}, clip to 1.0", decimal(*most));
            }
            Self::DepthCue { near, far, .. } => return write!(f, "depth cueing is from {near} to {far}"),
            Self::Grid { step: Some(step), level } => {
                return write!(f, "the lines of the grid are {step} apart, in the plane z = {level}");
            }
            Self::Grid { step: None, level } => {
                return write!(f, "no line of the grid is in the picture; it lies in the plane z = {level}");
            }
            Self::NoOutline => "nothing moves, so there is no undistorted outline beside the picture",
        };
        f.write_str(text)
    }
}

/// A number with one to three decimals, as short as possible.
fn decimal(number: f32) -> String {
    let text = format!("{number:.3}");
    let short = text.trim_end_matches('0');
    if short.ends_with('.') { format!("{short}0") } else { short.to_owned() }
}
