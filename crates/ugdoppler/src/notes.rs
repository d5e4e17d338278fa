//! Notes on a coloured scene.

use std::fmt;

/// A note on a coloured scene.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Note {
    /// About the scene itself.
    Scene(ugscene::Note),
    /// Values up to this were scaled to 1.
    Scaled(f64),
    /// Values up to this were clipped to 1.
    Clipped(f64),
    /// Values up to this were kept.
    Kept(f64),
    /// A colour has no smooth spectrum.
    TooSaturated {
        /// Its name.
        color: String,
    },
    /// The configuration has a velocity for bodies that have none, and positions are at rest.
    TakenAsSeen,
    /// The configuration has a velocity for bodies that have none, and all have one.
    AllMove,
    /// Colours at vertices are needed, so faces with textures have plain colours.
    PlainTextures {
        /// The name of one.
        color: String,
    },
    /// The renderer shifts the colours, since a face has a texture.
    DeferredTextures {
        /// The name of its colour.
        color: String,
    },
    /// The light of the scene is to be put into its colours, and there is none.
    NoLights,
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Scene(note) => note.fmt(f),
            Self::Scaled(largest) => {
                write!(f, "max intensity is {}, scaled to 1.0", shown(*largest))
            }
            Self::Clipped(largest) => {
                write!(f, "max intensity is {}, clip to 1.0", shown(*largest))
            }
            Self::Kept(largest) => {
                write!(f, "max intensity is {}, kept for the renderer", shown(*largest))
            }
            Self::TooSaturated { color } => write!(
                f,
                "colour `{color}` is more saturated than a smooth spectrum can be, and is brought toward grey; \
                 give it by `c_spd`"
            ),
            Self::TakenAsSeen => f.write_str("positions in this scene are taken as seen already"),
            Self::AllMove => f.write_str("every face of this scene has a velocity of its own"),
            Self::PlainTextures { color } => {
                write!(f, "textures are left out: faces of colour `{color}` have its plain colour")
            }
            Self::DeferredTextures { color } => {
                write!(
                    f,
                    "`{color}` is a texture: the renderer shifts colours, with a ray for each sample"
                )
            }
            Self::NoLights => f.write_str("no lights in the scene, so its colours contain none"),
        }
    }
}

/// A value with about three significant digits.
fn shown(value: f64) -> String {
    if value < 10.0 {
        format!("{value:.2}")
    } else if value < 1e6 {
        format!("{value:.0}")
    } else {
        format!("{value:.2e}")
    }
}
