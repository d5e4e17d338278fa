//! The stage of a scene: which transformations its positions and colours have undergone.

use glam::DVec3;
use ugphysics::spectrum::InfraredRule;
use ugphysics::{Brightness, Velocity};

/// The changes that filters have made to a scene. An original scene is at rest in both parts.
///
/// In the text it is one statement, see [`crate::Scene::stage`]. Programs downstream depend on it
/// alone; comments are for people.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Stage {
    /// The stage of positions.
    pub geometry: GeometryStage,
    /// The stage of colours.
    pub colors: ColorStage,
    /// The colours that were given to vertices between corners with mixed colours; `None` if there
    /// are none.
    pub mixtures: Option<MixtureNames>,
}

/// The names of mixed colours: the prefix `mix` with this many `#`, and a number.
///
/// Vertices with such a colour are those that subdivision added between corners where faces of
/// different colours meet. Programs that keep colours apart remove it from them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MixtureNames {
    n_marks: u32,
}

impl MixtureNames {
    const WORD: &str = "mix";

    /// The shortest prefix that none of `names` begins with.
    pub fn unused<'a>(names: impl Iterator<Item = &'a str>) -> Self {
        let marks = |name: &str| {
            let rest = name.strip_prefix(Self::WORD)?;
            Some(rest.bytes().take_while(|&byte| byte == b'#').count() as u32)
        };
        Self { n_marks: names.filter_map(marks).max().unwrap_or_default() + 1 }
    }

    /// Reads a prefix.
    pub fn from_prefix(prefix: &str) -> Option<Self> {
        let marks = prefix.strip_prefix(Self::WORD)?;
        let are_marks = !marks.is_empty() && marks.bytes().all(|byte| byte == b'#');
        Some(Self { n_marks: u32::try_from(marks.len()).ok().filter(|_| are_marks)? })
    }

    /// The prefix.
    pub fn prefix(self) -> String {
        Self::WORD.to_string() + &"#".repeat(self.n_marks as usize)
    }

    /// Is this the name of a mixture?
    pub fn contains(self, name: &str) -> bool {
        let rest = name.strip_prefix(Self::WORD).map(str::as_bytes);
        rest.is_some_and(|rest| {
            let marks = rest.get(..self.n_marks as usize);
            marks.is_some_and(|marks| marks.iter().all(|&byte| byte == b'#'))
        })
    }
}

/// The stage of the positions in a scene.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum GeometryStage {
    /// Bodies have their rest shapes.
    #[default]
    AtRest,
    /// Every point is at its apparent (retarded) position.
    AsSeen(SeenGeometry),
}

/// Parameters of apparent positions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeenGeometry {
    /// The eye point in scene coordinates. The positions are wrong for any other.
    pub eye: DVec3,
    /// Time of the picture on the observer's clock.  Eq. (P5)
    pub time: f64,
    /// Velocity of the camera in the frame of the original scene. All velocities in the scene are
    /// relative to the camera.
    pub camera_velocity: Velocity,
    /// Positions include Lorentz contraction.  Eq. (P1)
    pub contraction: bool,
    /// Positions include the light travel time.  Eq. (P2)
    pub flight_time: bool,
    /// Faces that are seen as curved have the corners at rest alone, for renderers that follow
    /// rays.
    pub is_whole: bool,
}

/// The stage of the colours in a scene.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum ColorStage {
    /// Colours of bodies at rest, without lighting.
    #[default]
    AtRest,
    /// Every vertex has its observed colour.
    AsSeen(SeenColors),
    /// Colours are at rest: the renderer shifts them so at every sample, since textures have no
    /// colours at vertices.
    Deferred(SeenColors),
}

/// Parameters of observed colours.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeenColors {
    /// Representation of colours, and the brightness law.
    pub scale: ColorScale,
    /// Wavelengths were shifted.  Eq. (P11)
    pub doppler: bool,
    /// Colours include the lighting by the scene's lights.  Eq. (P14)
    pub lights: bool,
}

/// Representation of observed colours.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ColorScale {
    /// Hues, each of which stands for one wavelength.
    Hues {
        /// Unit of hues in the text.
        unit: HueScale,
        /// Power of the Doppler factor that the value was multiplied by.  Eq. (P12)
        law: Brightness,
    },
    /// Spectra, written as X, Y, Z.  Eq. (P19)
    Spectra {
        /// The radiance per wavelength was multiplied by D⁵.  Eq. (P12)
        flux: bool,
        /// What surfaces were assumed to reflect in infrared.  Eq. (P20)
        infrared: InfraredRule,
    },
}

/// Unit of the hue in `c` statements.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum HueScale {
    /// Degrees.
    #[default]
    Degrees,
    /// Wavelengths in nm.
    Wavelengths,
}

impl Stage {
    /// True for an original scene.
    pub fn is_at_rest(&self) -> bool {
        *self == Self::default()
    }

    /// Parameters of apparent positions; `None` at rest.
    pub fn seen_geometry(&self) -> Option<&SeenGeometry> {
        match &self.geometry {
            GeometryStage::AtRest => None,
            GeometryStage::AsSeen(seen) => Some(seen),
        }
    }

    /// Parameters of observed colours; `None` at rest.
    pub fn seen_colors(&self) -> Option<&SeenColors> {
        match &self.colors {
            ColorStage::AsSeen(seen) => Some(seen),
            ColorStage::AtRest | ColorStage::Deferred(_) => None,
        }
    }

    /// How the renderer shifts colours, if it does.
    pub fn deferred_colors(&self) -> Option<&SeenColors> {
        match &self.colors {
            ColorStage::Deferred(seen) => Some(seen),
            ColorStage::AtRest | ColorStage::AsSeen(_) => None,
        }
    }

    /// The brightness law of hues as seen; `None` at rest and for spectra.
    pub fn law(&self) -> Option<Brightness> {
        match self.seen_colors()?.scale {
            ColorScale::Hues { law, .. } => Some(law),
            ColorScale::Spectra { .. } => None,
        }
    }

    /// Unit of the hue in `c` statements.
    pub fn hue_scale(&self) -> HueScale {
        match self.seen_colors() {
            Some(SeenColors { scale: ColorScale::Hues { unit, .. }, .. }) => *unit,
            _ => HueScale::Degrees,
        }
    }
}
