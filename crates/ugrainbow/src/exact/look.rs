//! Colour and light of a face at its points at rest.

use glam::DVec3;
use uglight::{Appearance, Swatch};
use ugpicture::outlines::{PictureRays, RestRay};
use ugscene::{Face, VertexId};

use crate::painter::Painter;

/// The appearance of a face, point by point.
#[derive(Clone, Debug)]
pub struct Look {
    /// Normal of the face on its visible side, in the axes of the scene.
    normal: DVec3,
    /// The light level, if it is the same everywhere.
    level: Option<DVec3>,
    /// The light level depends on the position.
    needs_place: bool,
    /// Spectra of lamps multiply those of the face.
    is_lit_by_spectra: bool,
    /// Coloured lamps, whose light changes the hue.
    is_lit_by_hues: bool,
    is_light: bool,
    /// Its colour at rest, or that of its first corner, with the wavelength of the colour.
    color: Swatch,
    wavelength_nm: f64,
    /// Index of its spectrum.
    row: u32,
    /// If colours or normals differ between corners.
    mesh: Option<Box<Mesh>>,
}

/// Triangles between the corners of a face. Values at a point are interpolated linearly in the rest
/// frame.
#[derive(Clone, Debug)]
struct Mesh {
    corners: Vec<Corner>,
    triangles: Vec<Triangle>,
    has_colors: bool,
    has_tints: bool,
    has_normals: bool,
    has_translucency: bool,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Corner {
    color: Swatch,
    /// Index of its spectrum.
    row: u32,
    normal: DVec3,
}

#[derive(Clone, Debug)]
struct Triangle {
    corners: [u32; 3],
    /// Normals of the planes through the eye and each side. Dot products with a ray are
    /// proportional to the weights of the opposite corners.
    sides: [DVec3; 3],
    /// Tint, saturation and value: each at the first corner, and the differences to the other two.
    numbers: [[f64; 3]; 3],
}

/// A point of a triangle in barycentric coordinates: the weights are not negative and add up to 1.
#[derive(Clone, Copy)]
struct Spot<'a> {
    mesh: &'a Mesh,
    triangle: &'a Triangle,
    weights: [f64; 3],
}

impl Look {
    /// The appearance of `face`.
    pub fn new(painter: &Painter<'_>, frame: &PictureRays, face: &Face) -> Self {
        let appearance = painter.appearance;
        let common = appearance.common_in_motion(painter.scene, face, !frame.velocity.is_zero());
        let normal = painter.seen_normal(face);
        let corner = |&vertex: &VertexId| {
            let color = appearance.swatch(vertex, &common);
            Corner {
                color,
                row: painter.appearance.surface.row(vertex),
                normal: painter.normal_at(vertex, normal),
            }
        };
        let vertices = painter.scene.contours.corners(face.contours.clone());
        let corners: Vec<Corner> = vertices.iter().map(corner).collect();
        let first = corners[0];
        let differ = |of: &dyn Fn(&Corner, &Corner) -> bool| corners.iter().any(|corner| of(corner, &first));
        let is_spectral = appearance.is_spectral();
        let has_colors = differ(&|a, b| a.color != b.color || (is_spectral && a.row != b.row));
        let has_tints = differ(&|a, b| a.color.tint != b.color.tint);
        let has_normals = differ(&|a, b| a.normal != b.normal);
        let has_level = painter.scene.light_level(face).is_some();
        let is_lit_by_spectra = !has_level && appearance.has_lit_spectra();
        let keeps_light = common.is_light || common.is_display;
        let is_lit_by_hues = !has_level && !is_spectral && !keeps_light && painter.lighting.is_colored();
        let is_even = has_level
            || !(painter.lighting.needs_places() || has_normals && painter.lighting.needs_geometry());
        let level = (is_even && !is_lit_by_spectra && !is_lit_by_hues)
            .then(|| painter.level(face, vertices[0], normal, common.is_light));
        let has_normals = has_normals && level.is_none();
        let has_translucency = corners.iter().any(|corner| corner.color.translucency > 0.0);
        let mesh = || {
            let triangles = painter.triangles(face);
            let place = |&corner: &VertexId| frame.aligned_from_scene(appearance.surface.rest(corner));
            let mesh = Mesh::new(&corners, vertices.iter().map(place).collect(), triangles);
            Box::new(Mesh { has_colors, has_tints, has_normals, has_translucency, ..mesh })
        };
        let mesh = (has_colors || has_normals).then(mesh);
        Self {
            normal: first.normal,
            level,
            needs_place: painter.lighting.needs_places(),
            is_lit_by_spectra,
            is_lit_by_hues,
            is_light: common.is_light,
            color: first.color,
            wavelength_nm: appearance.wavelength_nm(first.color.tint),
            row: first.row,
            mesh,
        }
    }

    /// Apparent colour and light level where a ray meets the plane of the face. `key`: the inverse
    /// of the ray parameter there. `SPECTRAL`: colours are spectra; a constant, so that the loop
    /// over hues has no call in it.
    #[inline(always)] // Called for every sample: otherwise the ray is passed in memory.
    pub fn at<const SPECTRAL: bool>(
        &self,
        painter: &Painter<'_>,
        frame: &PictureRays,
        ray: &RestRay,
        key: f64,
    ) -> (Swatch, DVec3) {
        let appearance = painter.appearance;
        let spot = self.mesh.as_ref().map(|mesh| mesh.spot(ray.rest));
        let place = || frame.scene_from_aligned * (ray.rest * (1.0 / key));
        if SPECTRAL && self.is_lit_by_spectra {
            let place = [place(), self.normal_at(spot), frame.lamp_shift];
            return (self.seen_spectrum(appearance, spot, ray.stretch, Some(place)), DVec3::ONE);
        }
        if !SPECTRAL && self.is_lit_by_hues {
            let light = painter.lighting.irradiances(place(), self.normal_at(spot), frame.lamp_shift);
            let color = spot.filter(|spot| spot.mesh.has_colors).map_or(self.color, |spot| spot.color());
            let lamps = painter.lighting.colored_lamps();
            return (appearance.seen_lit(&color, ray.stretch, &light, lamps), DVec3::ONE);
        }
        let color = match &spot {
            &spot if SPECTRAL => self.seen_spectrum(appearance, spot, ray.stretch, None),
            Some(spot) if spot.mesh.has_colors => {
                let color = spot.color();
                let has_own = spot.mesh.has_tints && ray.stretch != 1.0;
                let rest_nm = if has_own { appearance.wavelength_nm(color.tint) } else { self.wavelength_nm };
                appearance.seen(&color, rest_nm, ray.stretch)
            }
            _ => appearance.seen(&self.color, self.wavelength_nm, ray.stretch),
        };
        let color = painter.lit_as_written(color);
        if let Some(level) = self.level {
            return (color, level);
        }
        // Here rather than in a closure, so that the weights stay in registers.
        let normal = match &spot {
            Some(spot) if spot.mesh.has_normals => spot.normal(),
            _ => self.normal,
        };
        let point = if self.needs_place { place() } else { DVec3::ZERO };
        (color, painter.lighting.level(point, normal, frame.lamp_shift, self.is_light))
    }

    /// The normal where a ray meets the face.
    fn normal_at(&self, spot: Option<Spot<'_>>) -> DVec3 {
        spot.filter(|spot| spot.mesh.has_normals).map_or(self.normal, |spot| spot.normal())
    }

    /// The apparent colour in spectral mode. Between corners, the apparent colours of spectra are
    /// mixed. `place`: under lamps with spectra of their own.
    fn seen_spectrum(
        &self,
        appearance: &Appearance,
        spot: Option<Spot<'_>>,
        stretch: f64,
        place: Option<[DVec3; 3]>,
    ) -> Swatch {
        match spot.filter(|spot| spot.mesh.has_colors) {
            None => {
                let light = Some(appearance.seen_light([(self.row, 1.0)], stretch, place));
                Swatch { light, ..self.color }
            }
            Some(spot) => {
                let light = Some(appearance.seen_light(spot.rows(), stretch, place));
                Swatch { light, ..spot.color() }
            }
        }
    }
}

impl Mesh {
    fn new(corners: &[Corner], places: Vec<DVec3>, triangles: Option<Vec<[u32; 3]>>) -> Self {
        // A self-intersecting face has no triangulation, so it gets a fan.
        let fan = || (2..places.len() as u32).map(|corner| [0, corner - 1, corner]).collect();
        let triangle = |at: [u32; 3]| {
            let [a, b, c] = at.map(|corner| places[corner as usize]);
            let sides = [(b, c), (c, a), (a, b)].map(|(from, to)| from.cross(to - from));
            let [a, b, c] = at.map(|corner| &corners[corner as usize].color);
            let number = |of: fn(&Swatch) -> f64| [of(a), of(b) - of(a), of(c) - of(a)];
            let numbers =
                [number(|color| color.tint), number(|color| color.saturation), number(|color| color.value)];
            Triangle { corners: at, sides, numbers }
        };
        let triangles = triangles.unwrap_or_else(fan).into_iter().map(triangle).collect();
        Self {
            corners: corners.to_vec(),
            triangles,
            has_colors: true,
            has_tints: true,
            has_normals: true,
            has_translucency: true,
        }
    }

    /// The point of the mesh on a ray. Where rounding places the ray outside all triangles, the
    /// nearest triangle is used.
    #[inline]
    fn spot(&self, ray: DVec3) -> Spot<'_> {
        let mut best = Spot { mesh: self, triangle: &self.triangles[0], weights: [1.0, 0.0, 0.0] };
        let mut most = f64::NEG_INFINITY;
        for triangle in &self.triangles {
            let products = triangle.sides.map(|side| side.dot(ray));
            let part = 1.0 / (products[0] + products[1] + products[2]);
            let weights = products.map(|product| product * part);
            let least = weights[0].min(weights[1]).min(weights[2]);
            if least > most {
                most = least;
                best = Spot { triangle, weights, ..best };
            }
            if least >= 0.0 {
                return best;
            }
        }
        let weights = best.weights.map(|weight| weight.max(0.0));
        let sum: f64 = weights.iter().sum();
        Spot { weights: weights.map(|weight| weight / sum), ..best }
    }
}

impl Spot<'_> {
    /// The rows of the spectra of the corners, with their weights.
    fn rows(&self) -> impl Iterator<Item = (u32, f64)> + use<> {
        let rows = self.triangle.corners.map(|corner| self.mesh.corners[corner as usize].row);
        rows.into_iter().zip(self.weights)
    }

    /// The weighted mean. Colours are interpolated as in scanline mode.
    #[inline]
    fn color(&self) -> Swatch {
        let [_, second, third] = self.weights;
        // A number that is the same at all corners keeps its bits.
        let [tint, saturation, value] = self.triangle.numbers.map(|[a, b, c]| a + second * b + third * c);
        let first = &self.mesh.corners[self.triangle.corners[0] as usize];
        let light = first.color.light.and_then(|_| self.light());
        let translucency = if self.mesh.has_translucency { self.translucency() } else { 0.0 };
        let is_display = first.color.is_display;
        Swatch { tint, saturation, value, factor: first.color.factor, light, is_display, translucency }
    }

    fn translucency(&self) -> f64 {
        let of = |corner: u32| self.mesh.corners[corner as usize].color.translucency;
        let [a, b, c] = self.triangle.corners.map(of);
        a + self.weights[1] * (b - a) + self.weights[2] * (c - a)
    }

    fn light(&self) -> Option<DVec3> {
        let [a, b, c] = self.triangle.corners.map(|corner| self.mesh.corners[corner as usize].color.light);
        Some(self.mean([a?, b?, c?]))
    }

    #[inline]
    fn normal(&self) -> DVec3 {
        let corners = self.triangle.corners;
        self.mean(corners.map(|corner| self.mesh.corners[corner as usize].normal)).normalize_or_zero()
    }

    fn mean(&self, [a, b, c]: [DVec3; 3]) -> DVec3 {
        self.weights[0] * a + self.weights[1] * b + self.weights[2] * c
    }
}
