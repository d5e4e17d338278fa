//! The lights of a scene, with their colours and places ready to compute with.

use glam::DVec3;
use ugparse::{Light, LightKind, LightMotion, Scene};

use ugphysics::{srgb_decode, unit_or_zero};

use crate::{hsv, light};

/// A light of a scene, ready to compute with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lamp {
    /// What kind of light, and where.
    pub place: LampPlace,
    /// Display-encoded red, green and blue, times the intensity. In this form light of several
    /// lamps is added, and multiplies the display-encoded colour of a surface, as in 1988.
    pub color: DVec3,
    /// Linear red, green and blue, times the intensity: it multiplies colours given as [`light`].
    pub linear: DVec3,
    /// True if the light is neither white nor grey.
    pub is_colored: bool,
    /// How it moves.
    pub motion: LightMotion,
}

/// Where a light is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LampPlace {
    /// In all directions: ambient light.
    Everywhere,
    /// At infinity along a unit vector, in the rest frame of the light.
    Afar(DVec3),
    /// At a point, relative to the eye, in the rest frame of the light. There is no fall-off with
    /// distance.
    At(DVec3),
}

/// The lights of a scene, in its order.
///
/// `eye`: in scene coordinates.
pub fn lamps(scene: &Scene, eye: DVec3) -> Vec<Lamp> {
    scene.lights.iter().map(|light| lamp(scene, light, eye)).collect()
}

fn lamp(scene: &Scene, statement: &Light, eye: DVec3) -> Lamp {
    let place = match statement.kind {
        LightKind::Ambient => LampPlace::Everywhere,
        // Divided first: the square of a large component may be too large.
        LightKind::Directional(toward) => {
            LampPlace::Afar((toward / toward.abs().max_element()).normalize_or_zero())
        }
        LightKind::Local { position, .. } => LampPlace::At(position - eye),
    };
    let white = Lamp { motion: statement.motion, ..Lamp::white(place, statement.intensity) };
    let Some(id) = statement.color else { return white };
    let color = &scene.colors[id.index()];
    let shown = hsv(scene, color);
    let encoded = shown.to_rgb();
    let linear = light(scene, color).unwrap_or_else(|| encoded.map(srgb_decode));
    Lamp {
        color: DVec3::from_array(encoded) * statement.intensity,
        linear: DVec3::from_array(linear) * statement.intensity,
        is_colored: shown.saturation > 0.0,
        ..white
    }
}

impl Lamp {
    /// A white light that rests with whatever it lights.
    pub fn white(place: LampPlace, intensity: f64) -> Lamp {
        let color = DVec3::splat(intensity);
        Lamp { place, color, linear: color, is_colored: false, motion: LightMotion::WithWhatItLights }
    }

    /// The irradiance of a surface that rests with the lamp, as a part of the lamp's intensity:
    /// max(0, n·l), or 1 for ambient light.
    ///
    /// `point`: of the surface, relative to the eye. `normal`: unit vector on the side that is
    /// seen, or zero for a surface without one.
    #[inline]
    pub fn level_at_rest(&self, point: DVec3, normal: DVec3) -> f64 {
        let toward = match self.place {
            LampPlace::Everywhere => return 1.0,
            LampPlace::Afar(toward) => toward,
            LampPlace::At(place) => unit_or_zero(place - point),
        };
        normal.dot(toward).max(0.0)
    }
}
