//! How brightly corners are lit.

use glam::DVec3;
use ugparse::{Light, LightKind, Scene};
use ugscene::View;

use crate::palette::{Palette, Swatch};

/// The lights of a scene, as they fall on a face at rest.
///
/// Every light rests in the frame of the face it lights, and light levels are computed in
/// that frame, with rest positions (P4) and rest normals: a face is lit as it would be
/// standing still. A local light does not grow weaker with distance and counts as a point.
#[derive(Clone, Debug)]
pub struct Lighting {
    ambient: DVec3,
    /// Unit vector toward the light, and its colour times its intensity.
    directional: Vec<(DVec3, DVec3)>,
    /// Place relative to the eye, and colour times intensity.
    local: Vec<(DVec3, DVec3)>,
    is_colored: bool,
}

impl Lighting {
    /// The lights of the scene; if it has none, ambient 0.3 and 0.7 from the eye.
    pub fn new(scene: &Scene, palette: &Palette, view: &View) -> Self {
        let mut lighting =
            Self { ambient: DVec3::ZERO, directional: Vec::new(), local: Vec::new(), is_colored: false };
        for light in &scene.lights {
            lighting.add(light, palette, view);
        }
        if scene.lights.is_empty() {
            lighting.ambient = DVec3::splat(0.3);
            lighting.directional.push((-view.forward, DVec3::splat(0.7)));
        }
        lighting
    }

    fn add(&mut self, light: &Light, palette: &Palette, view: &View) {
        let swatch = light.color.map_or(Swatch::WHITE, |color| palette.get(color));
        let color = DVec3::from_array(palette.hsv(&swatch).to_rgb()) * light.intensity;
        self.is_colored |= !swatch.is_grey();
        match light.kind {
            LightKind::Ambient => self.ambient += color,
            LightKind::Directional(toward) => self.directional.push((toward.normalize_or_zero(), color)),
            LightKind::Local { position, .. } => self.local.push((position - view.eye, color)),
        }
    }

    /// True if a light is not white or grey, so that levels differ between red, green and blue.
    pub fn is_colored(&self) -> bool {
        self.is_colored
    }

    /// True if the level depends on where a face is and how it lies.
    pub fn needs_geometry(&self) -> bool {
        !self.directional.is_empty() || !self.local.is_empty()
    }

    /// Light level of a surface at a point, for red, green and blue.
    ///
    /// `point`: relative to the eye, in the rest frame of the surface. `normal`: unit vector
    /// on the side that is seen, or zero for a surface without one.
    /// Level = Σ ambient + Σ intensity · max(0, n·l).
    pub fn level(&self, point: DVec3, normal: DVec3) -> DVec3 {
        let toward = |place: DVec3| (place - point).normalize_or_zero();
        let local = self.local.iter().map(|&(place, color)| (toward(place), color));
        self.directional
            .iter()
            .copied()
            .chain(local)
            .fold(self.ambient, |sum, (toward, color)| sum + color * normal.dot(toward).max(0.0))
    }
}
