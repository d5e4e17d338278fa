//! Irradiance by lamps that rest with what they light.

use glam::DVec3;
use ugparse::Scene;

use crate::{Lamp, LampPlace, lamps};

/// The intensity of the ambient light in a scene without lights.
pub const DEFAULT_AMBIENT: f64 = 0.3;

/// The intensity of the directional light from the eye in a scene without lights.
pub const DEFAULT_FROM_EYE: f64 = 0.7;

/// The lights of a scene, each at rest with the face it lights: the rule of 1988.
///
/// A light level is the irradiance relative to the one that shows white as white. It is computed in
/// the rest frame of a face, with rest positions (P4) and rest normals, so a moving face is lit as
/// if it stood still. Local lights are points, without a fall-off with distance.
///
/// The level multiplies the value of a hue, which is display-encoded, as in 1988; or a colour given
/// as light, which is linear. So every light has its colour in both forms.
#[derive(Clone, Debug)]
pub struct Lighting {
    /// All ambient lights together.
    ambient: Lamp,
    /// All others.
    lamps: Vec<Lamp>,
    is_colored: bool,
}

impl Lighting {
    /// The lights of the scene; if it has none, an ambient light ([`DEFAULT_AMBIENT`]) and one
    /// from the eye ([`DEFAULT_FROM_EYE`]).
    ///
    /// `eye`: in scene coordinates. `forward`: unit vector along the view.
    pub fn new(scene: &Scene, eye: DVec3, forward: DVec3) -> Self {
        if scene.lights.is_empty() {
            let from_eye = Lamp::white(LampPlace::Afar(-forward), DEFAULT_FROM_EYE);
            let ambient = Lamp::white(LampPlace::Everywhere, DEFAULT_AMBIENT);
            return Self { ambient, lamps: vec![from_eye], is_colored: false };
        }
        let all = lamps(scene, eye);
        let is_colored = all.iter().any(|lamp| lamp.is_colored);
        let (ambient, lamps): (Vec<Lamp>, Vec<Lamp>) =
            all.into_iter().partition(|lamp| lamp.place == LampPlace::Everywhere);
        let ambient = Lamp {
            color: ambient.iter().map(|lamp| lamp.color).sum(),
            linear: ambient.iter().map(|lamp| lamp.linear).sum(),
            ..Lamp::white(LampPlace::Everywhere, 0.0)
        };
        Self { ambient, lamps, is_colored }
    }

    /// True if a light is neither white nor grey, so that levels differ between red, green and
    /// blue.
    #[inline]
    pub fn is_colored(&self) -> bool {
        self.is_colored
    }

    /// True if the level depends on the position and normal of a face.
    #[inline]
    pub fn needs_geometry(&self) -> bool {
        !self.lamps.is_empty()
    }

    /// True if the level depends on the position of a point of a face.
    #[inline]
    pub fn needs_places(&self) -> bool {
        self.lamps.iter().any(|lamp| matches!(lamp.place, LampPlace::At(_)))
    }

    /// Light level of a surface at a point, for red, green and blue.
    ///
    /// `point`: relative to the eye, in the rest frame of the surface. `normal`: unit vector
    /// on the side that is seen, or zero for a surface without one.
    /// `is_linear`: with the lights' linear colours, else with the display-encoded ones.
    /// Level = Σ ambient + Σ intensity · max(0, n·l).
    #[inline]
    pub fn level(&self, point: DVec3, normal: DVec3, is_linear: bool) -> DVec3 {
        // Two loops, each with its colour inlined, because this runs for every corner of the scene.
        if is_linear {
            self.sum(point, normal, |lamp| lamp.linear)
        } else {
            self.sum(point, normal, |lamp| lamp.color)
        }
    }

    #[inline]
    fn sum(&self, point: DVec3, normal: DVec3, scale: impl Fn(&Lamp) -> DVec3) -> DVec3 {
        let lit = |sum: DVec3, lamp: &Lamp| sum + scale(lamp) * lamp.level_at_rest(point, normal);
        self.lamps.iter().fold(scale(&self.ambient), lit)
    }

    /// The contribution of every light to the level, with a name for it.
    pub fn parts(&self, point: DVec3, normal: DVec3, is_linear: bool) -> Vec<(String, DVec3)> {
        let scale = |lamp: &Lamp| if is_linear { lamp.linear } else { lamp.color };
        let mut parts = vec![("ambient".to_owned(), scale(&self.ambient))];
        let (mut n_directional, mut n_local) = (0, 0);
        for lamp in &self.lamps {
            let (kind, count) = match lamp.place {
                LampPlace::At(_) => ("local", &mut n_local),
                _ => ("directional", &mut n_directional),
            };
            *count += 1;
            parts.push((format!("{kind} {count}"), scale(lamp) * lamp.level_at_rest(point, normal)));
        }
        parts
    }
}
