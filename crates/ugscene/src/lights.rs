//! The lights of a scene, as all programs understand them.

use glam::DVec3;
use ugparse::{Light, LightKind, Scene, VelocityId};

use crate::{HueScale, hsv};

/// A light of a scene, ready to compute with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lamp {
    /// What kind of light, and where.
    pub place: LampPlace,
    /// Red, green and blue, display-encoded, times the intensity. Levels of several lights add up so, and
    /// multiply the colour of a surface.
    pub color: DVec3,
    /// True if the light is neither white nor grey.
    pub is_colored: bool,
    /// Its own velocity; without one it rests with whatever it lights.
    pub velocity: Option<VelocityId>,
}

/// Where a light is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LampPlace {
    /// All round.
    Everywhere,
    /// Infinitely far along a unit vector, in the frame of the light.
    Afar(DVec3),
    /// At a point, relative to the eye, in the frame of the light. Its light grows no weaker with distance.
    At(DVec3),
}

/// The lights of a scene, in its order.
///
/// `eye`: in scene coordinates. `scale`: of the hues of their colours.
pub fn lamps(scene: &Scene, eye: DVec3, scale: HueScale) -> Vec<Lamp> {
    scene.lights.iter().map(|light| lamp(scene, light, eye, scale)).collect()
}

fn lamp(scene: &Scene, light: &Light, eye: DVec3, scale: HueScale) -> Lamp {
    let color = light.color.map(|color| hsv(scene, &scene.colors[color.index()], scale));
    Lamp {
        place: match light.kind {
            LightKind::Ambient => LampPlace::Everywhere,
            // Divided first: the square of a large component may be too large.
            LightKind::Directional(toward) => {
                LampPlace::Afar((toward / toward.abs().max_element()).normalize_or_zero())
            }
            LightKind::Local { position, .. } => LampPlace::At(position - eye),
        },
        color: color.map_or(DVec3::ONE, |color| DVec3::from_array(color.to_rgb())) * light.intensity,
        is_colored: color.is_some_and(|color| color.saturation > 0.0),
        velocity: light.velocity,
    }
}

impl Lamp {
    /// What part of its intensity falls on a surface if both are at rest: max(0, n·l), 1 for ambient light.
    ///
    /// `point`: of the surface, relative to the eye. `normal`: unit vector on the side that is seen, or zero
    /// for a surface without one.
    pub fn level_at_rest(&self, point: DVec3, normal: DVec3) -> f64 {
        let toward = match self.place {
            LampPlace::Everywhere => return 1.0,
            LampPlace::Afar(toward) => toward,
            LampPlace::At(place) => (place - point).normalize_or_zero(),
        };
        normal.dot(toward).max(0.0)
    }
}
