//! How brightly corners are lit.

use glam::DVec3;
use ugparse::{Light, LightKind, Scene};
use ugphysics::srgb_decode;
use ugscene::View;

use crate::palette::{Palette, Swatch};

/// The lights of a scene, as they fall on a face at rest.
///
/// Every light rests in the frame of the face it lights, and light levels are computed in
/// that frame, with rest positions (P4) and rest normals: a face is lit as it would be
/// standing still. A local light does not grow weaker with distance and counts as a point.
///
/// The level multiplies the value of a hue, which is display-encoded, as in 1988; and the light of a colour
/// given as light, which is linear. So each light has its colour on both scales.
#[derive(Clone, Debug)]
pub struct Lighting {
    ambient: Lamp,
    /// Unit vector toward the light.
    directional: Vec<(DVec3, Lamp)>,
    /// Place relative to the eye.
    local: Vec<(DVec3, Lamp)>,
    is_colored: bool,
}

/// Red, green and blue of a light times its intensity.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Lamp {
    /// Of its display-encoded colour.
    pub encoded: DVec3,
    /// Of its linear colour.
    pub linear: DVec3,
}

impl Lamp {
    const fn white(intensity: f64) -> Self {
        Self { encoded: DVec3::splat(intensity), linear: DVec3::splat(intensity) }
    }
}

impl Lighting {
    /// The lights of the scene; if it has none, ambient 0.3 and 0.7 from the eye.
    pub fn new(scene: &Scene, palette: &Palette, view: &View) -> Self {
        let mut lighting =
            Self { ambient: Lamp::default(), directional: Vec::new(), local: Vec::new(), is_colored: false };
        for light in &scene.lights {
            lighting.add(light, palette, view);
        }
        if scene.lights.is_empty() {
            lighting.ambient = Lamp::white(0.3);
            lighting.directional.push((-view.forward, Lamp::white(0.7)));
        }
        lighting
    }

    fn add(&mut self, light: &Light, palette: &Palette, view: &View) {
        let swatch = light.color.map_or(Swatch::WHITE, |color| palette.get(color));
        let encoded = palette.hsv(&swatch).to_rgb();
        let linear = swatch.light.unwrap_or_else(|| DVec3::from_array(encoded.map(srgb_decode)));
        let lamp =
            Lamp { encoded: DVec3::from_array(encoded) * light.intensity, linear: linear * light.intensity };
        self.is_colored |= !swatch.is_grey();
        match light.kind {
            LightKind::Ambient => {
                self.ambient.encoded += lamp.encoded;
                self.ambient.linear += lamp.linear;
            }
            LightKind::Directional(toward) => self.directional.push((toward.normalize_or_zero(), lamp)),
            LightKind::Local { position, .. } => self.local.push((position - view.eye, lamp)),
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
    /// `is_linear`: of the lights' linear colours, else of the display-encoded ones.
    /// Level = Σ ambient + Σ intensity · max(0, n·l).
    pub fn level(&self, point: DVec3, normal: DVec3, is_linear: bool) -> DVec3 {
        // Two loops, each with its colour inlined: this runs for every corner of the scene.
        if is_linear {
            self.sum(point, normal, |lamp| lamp.linear)
        } else {
            self.sum(point, normal, |lamp| lamp.encoded)
        }
    }

    #[inline]
    fn sum(&self, point: DVec3, normal: DVec3, scale: impl Fn(&Lamp) -> DVec3) -> DVec3 {
        let toward = |place: DVec3| (place - point).normalize_or_zero();
        let local = self.local.iter().map(|(place, lamp)| (toward(*place), lamp));
        self.directional
            .iter()
            .map(|(toward, lamp)| (*toward, lamp))
            .chain(local)
            .fold(scale(&self.ambient), |sum, (toward, lamp)| sum + scale(lamp) * normal.dot(toward).max(0.0))
    }

    /// The same light by light: what each adds to the level, and what to call it.
    pub fn parts(&self, point: DVec3, normal: DVec3, is_linear: bool) -> Vec<(String, DVec3)> {
        let scale = |lamp: &Lamp| if is_linear { lamp.linear } else { lamp.encoded };
        let falling = |lamp: &Lamp, toward: DVec3| scale(lamp) * normal.dot(toward).max(0.0);
        let ambient = [("ambient".to_owned(), scale(&self.ambient))];
        let directional = (1..)
            .zip(&self.directional)
            .map(|(k, (toward, lamp))| (format!("directional {k}"), falling(lamp, *toward)));
        let local = (1..).zip(&self.local).map(|(k, (place, lamp))| {
            (format!("local {k}"), falling(lamp, (*place - point).normalize_or_zero()))
        });
        ambient.into_iter().chain(directional).chain(local).collect()
    }
}
