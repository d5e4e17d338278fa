//! Quantities of what is seen, to be shown in false colours or by lines.

use ugphysics::length;

use crate::emission::Emission;
use crate::units::{Unit, Units};

/// A quantity of the light that is seen, in the frame of the camera.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// The Doppler factor.  Eq. (P10)
    Doppler,
    /// When the light was emitted; the picture is taken at 0.
    Time,
    /// From the eye to where the light was emitted.
    Distance,
    /// The speed of the body, in units of c.
    Speed,
    /// Depth along the view of where the light was emitted.
    Depth,
}

impl Quantity {
    /// All quantities with their names.
    pub const NAMES: [(&'static str, Self); 5] = [
        ("D", Self::Doppler),
        ("time", Self::Time),
        ("distance", Self::Distance),
        ("speed", Self::Speed),
        ("z", Self::Depth),
    ];

    /// The words beside its scale.
    pub(crate) fn label(self) -> &'static str {
        match self {
            Self::Doppler => "Doppler factor D",
            Self::Time => "time of emission",
            Self::Distance => "distance at emission",
            Self::Speed => "speed",
            Self::Depth => "depth at emission",
        }
    }

    /// The unit of its values up to `most`; those of Doppler factors have none.
    pub(crate) fn unit(self, units: &Units, most: f64) -> Option<Unit> {
        match self {
            Self::Doppler => None,
            Self::Time => units.time(most),
            Self::Distance | Self::Depth => units.length(),
            Self::Speed => units.speed(),
        }
    }

    pub(crate) fn of(self, emission: &Emission) -> f64 {
        match self {
            Self::Doppler => emission.doppler(),
            Self::Time => emission.time,
            Self::Distance => length(emission.place),
            Self::Speed => emission.velocity.speed(),
            Self::Depth => emission.depth,
        }
    }
}

/// A quantity to show, and the values at the ends of its scale; without them the least and the
/// greatest that are seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MapOptions {
    /// The quantity.
    pub quantity: Quantity,
    /// The least and the greatest value of the scale.
    pub range: Option<[f64; 2]>,
}

/// A quantity and its values on lines; round values that are seen, if there are none.
#[derive(Clone, Debug, PartialEq)]
pub struct IsoOptions {
    /// The quantity.
    pub quantity: Quantity,
    /// The values.
    pub values: Vec<f64>,
}
