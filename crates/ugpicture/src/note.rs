//! Notes on a picture, above all why it is empty.

/// A note on a picture. It is no error: `thiserror` writes its text beside each variant.
#[derive(Clone, Debug, thiserror::Error, PartialEq)]
#[non_exhaustive]
pub enum Note {
    /// About its scene.
    #[error("{0}")]
    Scene(ugscene::Note),
    /// About the file of its panorama, or of its stars.
    #[error("{0}")]
    Source(String),
    /// The scene has no lights.
    #[error(
        "no lights in the scene: drawn with ambient light {ambient} and a light of {from_eye} from the eye{}",
        if *.has_shadows { ", without shadows" } else { "" }
    )]
    NoLights {
        /// The ambient light in place of them.
        ambient: f64,
        /// The light from the eye in place of them.
        from_eye: f64,
        /// Lights of a scene would cast shadows, and these do not.
        has_shadows: bool,
    },
    /// Lights of the scene move.
    #[error("velocities of lights are left out: each light rests with the faces it lights")]
    MovingLights {
        /// The picture is drawn by rays.
        is_exact: bool,
    },
    /// A colour is a picture, and only its plain colour is drawn.
    #[error("textures are not drawn: faces of colour `{color}` have its plain colour")]
    PlainTextures {
        /// Its name.
        color: String,
    },
    /// Vertices are to be repeated, but have colours as seen.
    #[error("vertices with colours as seen are not repeated")]
    NotRepeated,
    /// So many labels are at vertices outside the picture.
    #[error("{}", labels_outside(*.0))]
    LabelsOutside(usize),
    /// So many labels are at vertices in the picture that faces hide.
    #[error("{}", labels_hidden(*.0))]
    LabelsHidden(usize),
    /// Only a pinhole camera shows labels.
    #[error("labels are left out: only pictures of a single pinhole camera have them")]
    NoLabels,
    /// A caption or title has a number by its name, which is known in films.
    #[error("only captions and titles of films have numbers in place of {{beta}}, {{t}} ...")]
    UnknownNumber,
    /// Rays do not meet wires.
    #[error("wires are left out: rays do not meet lines")]
    NoWires,
    /// Round faces of bodies on world lines are drawn as polygons.
    #[error(
        "round faces of bodies that accelerate or turn are drawn as polygons, to 1/50 of a pixel or 1/4000 of \
         their radius"
    )]
    CutRounds,
    /// The up direction is zero or parallel to the view.
    #[error("the up direction is zero or parallel to the view, so another axis is up")]
    UpReplaced,
    /// Everything is behind the eye or outside the clipping distances.
    #[error("nothing is drawn: everything is behind the eye or outside the clipping distances")]
    NothingInFront,
    /// Everything is outside the picture.
    #[error("nothing is drawn: everything is outside the picture, where fast bodies often are")]
    NothingInPicture,
    /// All faces have colours that let all light through.
    #[error("nothing is drawn: all faces are fully transparent")]
    AllTransparent,
    /// The panorama is outside the picture.
    #[error("the picture shows no part of the panorama")]
    NoPanorama,
    /// The list has no stars.
    #[error("the list has no stars")]
    NoStars,
    /// Everything is culled.
    #[error("nothing is drawn: everything is seen from behind")]
    BackFacing,
    /// Everything is seen edge-on.
    #[error("nothing is drawn: everything is seen edge-on, thinner than a sample")]
    EdgeOn,
    /// Everything is smaller than a sample.
    #[error("nothing is drawn: everything is smaller than a sample")]
    TooSmall,
    /// Black lines on a black background.
    #[error("the lines are black on black")]
    BlackLines,
    /// No light falls on the scene, or its colours are black.
    #[error(
        "all that is in the picture is black: its colours are, or {}",
        if *.has_lights {
            "the light of its lamps does not reach it at this time, or falls between the vertices"
        } else {
            "no light falls on it; try `l 1;` in the scene"
        }
    )]
    NoLight {
        /// True if the scene has lights.
        has_lights: bool,
    },
    /// Wavelengths are shifted out of the visible range.
    #[error("{} {}: its wavelengths are outside 380-780 nm", part(*.percent), if *.is_black && *.percent == 100 { "black" } else { "black or grey" })]
    OutOfRange {
        /// How much of what is in the picture, rounded down.
        percent: u64,
        /// All of it is black; otherwise a part, or some is grey.
        is_black: bool,
    },
    /// No light falls on what rays meet, or its wavelengths are shifted out of the visible range.
    #[error(
        "all that is in the picture is black: no light falls on it, or its wavelengths are outside 380-780 nm"
    )]
    BlackFaces,
    /// The wavelengths of a panorama are shifted out of the visible range.
    #[error("all that is in the picture is black: its wavelengths are outside 380-780 nm")]
    BlackPanorama,
    /// The light of a panorama is a sum of black bodies, some of a negative amount, and is negative
    /// in this part of what is in the picture.
    #[error(
        "the three temperatures of the basis add up to negative light, drawn as black, in {percent:.1} percent \
         of what is in the picture"
    )]
    NegativeLight {
        /// In percent.
        percent: f64,
    },
    /// Light passes into a transparent solid around an edge of this face.
    #[error(
        "the transparent solid of {0} is open, so everything behind the face is drawn as if it were inside: \
         close it with faces on all sides, or take a translucent colour for a thin pane"
    )]
    OpenSolid(String),
    /// Light leaves a transparent solid that it did not enter, at this face.
    #[error(
        "light leaves a transparent solid that it did not enter, at {0}: its outlines run clockwise seen from \
         outside, or the solid has gaps; it is drawn as if it were not refracted there"
    )]
    ReversedSolid(String),
    /// Light of lamps may cross a refracting solid.
    #[error(
        "light of lamps goes straight through transparent solids: it is absorbed there, but not refracted, \
         and slowed only if lamp and surface rest in the same solid"
    )]
    StraightThroughGlass,
    /// The lamp of this name is in a closed opaque body.
    #[error("the light of lamp `{0}` does not leave the closed body that it is in")]
    EnclosedLamp(String),
    /// Samples end at the greatest depth.
    #[error(
        "{percent:.1} percent of the samples end after {depth} reflections and refractions, and what is behind \
         is black"
    )]
    TooDeep {
        /// How many of them.
        percent: f64,
        /// Reflections and refractions.
        depth: u32,
    },
    /// Paths with too many branches.
    #[error("some paths branch at too many mirrors and solids, and are cut short")]
    CutShort,
    /// The percentage of samples that were traced.
    #[error("traced {0:.0} percent of the samples")]
    Adaptive(f64),
    /// Automatic exposure, in stops.
    #[error("exposure is {0} stops")]
    Exposure(f64),
    /// Hardly any pixel is bright enough to be visible.
    #[error("hardly anything is bright enough to be seen")]
    NearlyBlack {
        /// An exposure was given.
        is_exposed: bool,
    },
    /// Many pixels are white, where details may be lost.
    #[error("more than a tenth of what is in the picture is white")]
    Overexposed,
    /// Brightness up to this was clipped.
    #[error("max intensity is {}, clip to 1.0", decimal(*.most))]
    ClippedIntensity {
        /// The largest one.
        most: f32,
        /// They could have been exposed.
        has_light: bool,
    },
    /// The depths between which light fades.
    #[error("depth cueing is from {near} to {far}")]
    DepthCue {
        /// Where it begins.
        near: f64,
        /// Where it ends.
        far: f64,
        /// The part of the light that remains.
        least: f64,
    },
    /// The grid of the ground.
    #[error("{}the plane z = {level}", grid(.step.as_deref()))]
    Grid {
        /// The distance between its lines; `None` if none is in the picture.
        step: Option<String>,
        /// The height of its plane.
        level: String,
    },
    /// Nothing moves that could have an undistorted outline.
    #[error("nothing moves, so there is no undistorted outline beside the picture")]
    NoOutline,
}

impl Note {
    /// True if it says that nothing is in the picture.
    pub fn is_of_empty(&self) -> bool {
        matches!(
            self,
            Self::NothingInFront
                | Self::NothingInPicture
                | Self::AllTransparent
                | Self::NoPanorama
                | Self::NoStars
                | Self::BackFacing
                | Self::EdgeOn
                | Self::TooSmall
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

fn labels_outside(n: usize) -> String {
    match n {
        1 => "a label is at a vertex outside the picture".to_owned(),
        n => format!("{n} labels are at vertices outside the picture"),
    }
}

fn labels_hidden(n: usize) -> String {
    match n {
        1 => "a label is left out, because faces hide its vertex".to_owned(),
        n => format!("{n} labels are left out, because faces hide their vertices"),
    }
}

fn part(percent: u64) -> String {
    match percent {
        100 => "all that is in the picture is".to_owned(),
        _ => format!("{percent} percent of what is in the picture is"),
    }
}

fn grid(step: Option<&str>) -> String {
    match step {
        Some(step) => format!("the lines of the grid are {step} apart, in "),
        None => "no line of the grid is in the picture; it lies in ".to_owned(),
    }
}

/// A number with one to three decimals, as short as possible.
fn decimal(number: f32) -> String {
    let text = format!("{number:.3}");
    let short = text.trim_end_matches('0');
    if short.ends_with('.') { format!("{short}0") } else { short.to_owned() }
}
