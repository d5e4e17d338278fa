//! How brightly corners are lit.

use glam::DVec3;
use ugparse::Scene;
use ugscene::{HueScale, Lamp, LampPlace, lamps};

use crate::camera::View;

/// The lights of a scene, as they fall on a face at rest.
///
/// Every light rests in the frame of the face it lights, and light levels are computed in
/// that frame, with rest positions (P4) and rest normals: a face is lit as it would be
/// standing still. A local light does not grow weaker with distance and counts as a point.
#[derive(Clone, Debug)]
pub struct Lighting {
    ambient: DVec3,
    /// All others.
    lamps: Vec<Lamp>,
    is_colored: bool,
}

impl Lighting {
    /// The lights of the scene; if it has none, ambient 0.3 and 0.7 from the eye.
    pub fn new(scene: &Scene, scale: HueScale, view: &View) -> Self {
        if scene.lights.is_empty() {
            let from_eye = Lamp {
                place: LampPlace::Afar(-view.forward),
                color: DVec3::splat(0.7),
                is_colored: false,
                velocity: None,
            };
            return Self { ambient: DVec3::splat(0.3), lamps: vec![from_eye], is_colored: false };
        }
        let all = lamps(scene, view.eye, scale);
        let is_colored = all.iter().any(|lamp| lamp.is_colored);
        let (ambient, lamps): (Vec<Lamp>, Vec<Lamp>) =
            all.into_iter().partition(|lamp| lamp.place == LampPlace::Everywhere);
        Self { ambient: ambient.iter().map(|lamp| lamp.color).sum(), lamps, is_colored }
    }

    /// True if a light is not white or grey, so that levels differ between red, green and blue.
    pub fn is_colored(&self) -> bool {
        self.is_colored
    }

    /// True if the level depends on where a face is and how it lies.
    pub fn needs_geometry(&self) -> bool {
        !self.lamps.is_empty()
    }

    /// Light level of a surface at a point, for red, green and blue.
    ///
    /// `point`: relative to the eye, in the rest frame of the surface. `normal`: unit vector
    /// on the side that is seen, or zero for a surface without one.
    /// Level = Σ ambient + Σ intensity · max(0, n·l).
    pub fn level(&self, point: DVec3, normal: DVec3) -> DVec3 {
        let lit = |sum: DVec3, lamp: &Lamp| sum + lamp.color * lamp.level_at_rest(point, normal);
        self.lamps.iter().fold(self.ambient, lit)
    }
}
