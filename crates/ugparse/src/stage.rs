//! How far a scene is on its way from rest to what a camera sees.

use glam::DVec3;
use ugphysics::{Brightness, Velocity};

/// What filters have done to a scene. A scene as its author writes it is at rest in both parts.
///
/// In the text it is one statement, see [`crate::Scene::stage`]. Nothing else tells programs
/// downstream what was done: comments are for people.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Stage {
    /// What positions are.
    pub geometry: GeometryStage,
    /// What colours are.
    pub colors: ColorStage,
}

/// What the positions of a scene are.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum GeometryStage {
    /// Bodies have their rest shapes.
    #[default]
    AtRest,
    /// Every point stands where its light came from.
    AsSeen(SeenGeometry),
}

/// How positions as seen were computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeenGeometry {
    /// The eye point, in scene coordinates. Seen from another one, positions are wrong.
    pub eye: DVec3,
    /// When the picture is taken, on the observer's clock.  Eq. (P5)
    pub time: f64,
    /// Velocity of the camera in the frame the scene was written in. All velocities in the scene
    /// are in the camera's frame now.
    pub camera_velocity: Velocity,
    /// Positions show Lorentz contraction.  Eq. (P1)
    pub contraction: bool,
    /// Positions show the time of flight.  Eq. (P2)
    pub flight_time: bool,
}

/// What the colours of a scene are.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum ColorStage {
    /// Colours of bodies at rest, without light.
    #[default]
    AtRest,
    /// Every vertex has its colour as the eye sees it.
    AsSeen(SeenColors),
}

/// How colours as seen were computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeenColors {
    /// What colours are, and how their brightness was changed.
    pub scale: ColorScale,
    /// Wavelengths were shifted.  Eq. (P11)
    pub doppler: bool,
    /// The light of the scene's lights is in the colours.  Eq. (P14)
    pub lights: bool,
}

/// What colours as seen consist of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ColorScale {
    /// A hue each, which stands for one wavelength.
    Hues {
        /// How hues are written.
        unit: HueScale,
        /// Power of the Doppler factor that the value was multiplied by.  Eq. (P12)
        law: Brightness,
    },
    /// Spectra, written as X, Y, Z.  Eq. (P19)
    Spectra {
        /// The radiance per wavelength was multiplied by D⁵.  Eq. (P12)
        flux: bool,
    },
}

/// What the hue field of `c` statements holds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum HueScale {
    /// Degrees.
    #[default]
    Degrees,
    /// Wavelengths in nm.
    Wavelengths,
}

impl Stage {
    /// True for a scene as its author writes it.
    pub fn is_at_rest(&self) -> bool {
        *self == Self::default()
    }

    /// How positions were computed; `None` at rest.
    pub fn seen_geometry(&self) -> Option<&SeenGeometry> {
        match &self.geometry {
            GeometryStage::AtRest => None,
            GeometryStage::AsSeen(seen) => Some(seen),
        }
    }

    /// How colours were computed; `None` at rest.
    pub fn seen_colors(&self) -> Option<&SeenColors> {
        match &self.colors {
            ColorStage::AtRest => None,
            ColorStage::AsSeen(seen) => Some(seen),
        }
    }

    /// What the hue field of `c` statements holds.
    pub fn hue_scale(&self) -> HueScale {
        match self.seen_colors() {
            Some(SeenColors { scale: ColorScale::Hues { unit, .. }, .. }) => *unit,
            _ => HueScale::Degrees,
        }
    }
}
