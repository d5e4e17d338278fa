//! The expected colour of a point on a face, directly from the formulas: hue and wavelength or
//! spectrum, and lighting at rest.

use glam::DVec3;
use ugphysics::{
    Hsv, attenuation, hue_to_wavelength, srgb_decode, wavelength_to_hue, xyz_to_linear_srgb,
};
use ugrainbow::{ColorShift, HueShift};
use ugscene::{ColorId, ColorValue, Face, LightKind, Scene, Tint, VertexId};

use crate::oracle::Hit;

/// Computes colours of a scene with white lights.
pub struct Shading<'a> {
    scene: &'a Scene,
    eye: DVec3,
    /// The colour of each vertex; `None` where several colours meet.
    colors: Vec<Option<ColorId>>,
}

/// A point of a face, as barycentric weights of its corners.
type Weights<'a> = &'a [(VertexId, f64)];

impl<'a> Shading<'a> {
    /// `eye`: in scene coordinates.
    pub fn new(scene: &'a Scene, eye: DVec3) -> Self {
        let mut around: Vec<Vec<ColorId>> = vec![Vec::new(); scene.vertices.len()];
        for face in &scene.faces {
            for corner in scene.face_contours(face).flatten() {
                around[corner.index()].extend(face.color);
            }
        }
        let color = |(vertex, around): (&ugscene::Vertex, &Vec<ColorId>)| {
            vertex
                .color
                .or_else(|| around.first().copied().filter(|a| around.iter().all(|b| a == b)))
        };
        Self { scene, eye, colors: scene.vertices.iter().zip(&around).map(color).collect() }
    }

    /// Observed linear red, green and blue of a point; `None` for cases that this module does not
    /// cover.
    pub fn seen(
        &self,
        face: usize,
        hit: &Hit,
        doppler: f64,
        exact: ColorShift,
    ) -> Option<[f64; 3]> {
        let face = &self.scene.faces[face];
        let corners: Vec<VertexId> = self.scene.face_contours(face).flatten().copied().collect();
        let weights = match corners[..] {
            [a, b, c] => self.weights([a, b, c], hit.written).to_vec(),
            _ => {
                let normals =
                    corners.iter().any(|id| self.scene.vertices[id.index()].normal.is_some());
                let first = self.colors[corners[0].index()];
                let is_even = corners.iter().all(|id| self.colors[id.index()] == first);
                (is_even && !normals).then(|| vec![(corners[0], 1.0)])?
            }
        };
        let level = self.level(face, &weights, hit)?;
        match exact {
            ColorShift::Hues(shift) => self.seen_hue(&weights, level, doppler, shift),
            ColorShift::Spectra(_) => self.seen_spectrum(&weights, level, doppler),
        }
    }

    fn seen_hue(
        &self,
        weights: Weights<'_>,
        level: f64,
        doppler: f64,
        exact: HueShift,
    ) -> Option<[f64; 3]> {
        let Hsv { hue, saturation, value } = self.color(weights)?;
        let rest_nm = hue_to_wavelength(hue);
        let seen_nm = if exact.doppler { rest_nm / doppler } else { rest_nm };
        let value = value * level * exact.law.factor(doppler);
        let seen = Hsv { hue: wavelength_to_hue(seen_nm), saturation, value }
            .attenuated(attenuation(seen_nm));
        Some(seen.to_rgb().map(srgb_decode))
    }

    /// L(λ) = D⁵ L'(λD), with the light in it.
    fn seen_spectrum(&self, weights: Weights<'_>, level: f64, doppler: f64) -> Option<[f64; 3]> {
        let mut light = DVec3::ZERO;
        for &(vertex, weight) in weights {
            let color = self.colors[vertex.index()]?;
            let spectrum = uglight::spectrum(self.scene, &self.scene.colors[color.index()]).0;
            light += weight * level * DVec3::from_array(xyz_to_linear_srgb(spectrum.seen(doppler)));
        }
        Some(light.to_array())
    }

    fn hsv(&self, vertex: VertexId) -> Option<Hsv> {
        match self.scene.colors[self.colors[vertex.index()]?.index()].value {
            ColorValue::Hsv { value, tint: Tint::Hue(hue), saturation, .. } => {
                Some(Hsv { hue, saturation, value })
            }
            _ => None,
        }
    }

    /// Areas of the triangles opposite to each corner.
    fn weights(&self, corners: [VertexId; 3], point: DVec3) -> [(VertexId, f64); 3] {
        let [a, b, c] = corners.map(|id| self.scene.vertices[id.index()].position);
        let all = (b - a).cross(c - a);
        let part =
            |p: DVec3, q: DVec3| (p - point).cross(q - point).dot(all) / all.length_squared();
        let [first, second, third] = corners;
        [(first, part(b, c)), (second, part(c, a)), (third, part(a, b))]
    }

    fn color(&self, weights: Weights<'_>) -> Option<Hsv> {
        let colors: Option<Vec<(Hsv, f64)>> =
            weights.iter().map(|&(id, weight)| Some((self.hsv(id)?, weight))).collect();
        let colors = colors?;
        let mean = |of: fn(&Hsv) -> f64| {
            colors.iter().map(|(color, weight)| of(color) * weight).sum::<f64>()
        };
        // A grey corner takes the hue of the others: not covered.
        let has_hue = |color: &Hsv| color.saturation > 0.0;
        let is_mixed = colors.iter().any(|(color, _)| has_hue(color) != has_hue(&colors[0].0));
        (!is_mixed).then(|| Hsv {
            hue: mean(|color| color.hue),
            saturation: mean(|color| color.saturation),
            value: mean(|color| color.value),
        })
    }

    fn level(&self, face: &Face, weights: Weights<'_>, hit: &Hit) -> Option<f64> {
        if let Some(level) = self.scene.light_level(face) {
            return Some(level);
        }
        let toward_seen =
            |normal: DVec3, seen: DVec3| if normal.dot(seen) < 0.0 { -normal } else { normal };
        let flat = toward_seen(hit.normal, -hit.point);
        let own = |&(id, weight): &(VertexId, f64)| {
            let own = self.scene.vertices[id.index()].normal.map_or(flat, DVec3::normalize);
            weight * toward_seen(own, flat)
        };
        let normal = weights.iter().map(own).sum::<DVec3>().normalize();
        let lights = &self.scene.lights;
        if lights.is_empty() || lights.iter().any(|light| light.color.is_some()) {
            return None;
        }
        let level = |light: &ugscene::Light| {
            let toward = match light.kind {
                LightKind::Ambient => return light.intensity,
                LightKind::Directional(toward) => toward,
                LightKind::Local { position, .. } => position - self.eye - hit.point,
            };
            light.intensity * normal.dot(toward.normalize()).max(0.0)
        };
        Some(lights.iter().map(level).sum())
    }
}
