//! Colour and light at the points of a face at rest.

use glam::DVec3;
use ugparse::{Face, VertexId};

use super::frame::{Frame, Ray};
use super::motion::Motion;
use crate::painter::Painter;
use crate::palette::Swatch;

/// What a face looks like, point by point.
#[derive(Clone, Debug)]
pub struct Look {
    /// Of the face, on the side that is seen, in the axes of the scene.
    normal: DVec3,
    /// The light on it, if it is the same everywhere.
    level: Option<DVec3>,
    is_light: bool,
    /// Its colour at rest, or that of its first corner, and the wavelength of that.
    color: Swatch,
    wavelength_nm: f64,
    /// If colour or normal differ between corners.
    mesh: Option<Box<Mesh>>,
}

/// Triangles between corners. A point of one is that mean of its corners which is there in the rest frame.
#[derive(Clone, Debug)]
struct Mesh {
    corners: Vec<Corner>,
    triangles: Vec<Triangle>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Corner {
    color: Swatch,
    normal: DVec3,
}

#[derive(Clone, Debug)]
struct Triangle {
    corners: [u32; 3],
    /// Across the planes of the eye and each side: products with a ray are as the weights of the opposite corners.
    sides: [DVec3; 3],
}

impl Look {
    /// That of a face. `contours`: its corners at rest, in the axes of `frame`.
    pub fn new(
        painter: &Painter<'_>,
        motion: Motion<'_>,
        frame: &Frame,
        face: &Face,
        contours: &[Vec<DVec3>],
    ) -> Self {
        let common = painter.common(face);
        // What is light has no hue to be shifted; as in `ugdoppler` the nearest hue stands for it.
        let is_changed = !frame.velocity.is_zero() && !motion.keeps_colors();
        let common = if is_changed { common.without_light() } else { common };
        let normal = painter.seen_normal(face);
        let corner = |&vertex: &VertexId| {
            let color = painter.swatch(vertex, &common);
            let light = color.light.filter(|_| common.is_light);
            Corner { color: Swatch { light, ..color }, normal: painter.normal_at(vertex, normal) }
        };
        let vertices = painter.scene.contours.corners(face.contours.clone());
        let corners: Vec<Corner> = vertices.iter().map(corner).collect();
        let level = (painter.scene.light_level(face).is_some() || !painter.lighting.needs_geometry())
            .then(|| painter.level(face, vertices[0], normal, common.is_light));
        let first = corners[0];
        let is_even =
            |other: &Corner| other.color == first.color && (level.is_some() || other.normal == first.normal);
        let mesh = (!corners.iter().all(is_even)).then(|| Box::new(Mesh::new(&corners, contours)));
        Self {
            normal: first.normal,
            level,
            is_light: common.is_light,
            color: first.color,
            wavelength_nm: motion.wavelength_nm(&first.color),
            mesh,
        }
    }

    /// Colour as seen, and light level, where a ray meets the plane of the face; `key` is that of the ray.
    pub fn at(
        &self,
        painter: &Painter<'_>,
        motion: Motion<'_>,
        frame: &Frame,
        ray: &Ray,
        key: f64,
    ) -> (Swatch, DVec3) {
        let doppler = if frame.velocity.is_zero() { 1.0 } else { ray.doppler() };
        let (color, normal) = match &self.mesh {
            None => (motion.seen(&self.color, self.wavelength_nm, doppler), self.normal),
            Some(mesh) => {
                let Corner { color, normal } = mesh.at(ray.rest);
                (motion.seen(&color, motion.wavelength_nm(&color), doppler), normal)
            }
        };
        let level = self.level.unwrap_or_else(|| {
            let point = frame.scene_from_axes * (ray.rest / key);
            painter.lighting.level(point, normal, self.is_light)
        });
        (color, level)
    }
}

impl Mesh {
    fn new(corners: &[Corner], contours: &[Vec<DVec3>]) -> Self {
        let places = contours.concat();
        // A face that crosses itself has no triangles of its own.
        let fan = || (2..places.len() as u32).map(|corner| [0, corner - 1, corner]).collect();
        let triangles = ugscene::triangulate(contours).unwrap_or_else(fan);
        let triangle = |corners: [u32; 3]| {
            let [a, b, c] = corners.map(|corner| places[corner as usize]);
            Triangle { corners, sides: [(b, c), (c, a), (a, b)].map(|(from, to)| from.cross(to - from)) }
        };
        Self { corners: corners.to_vec(), triangles: triangles.into_iter().map(triangle).collect() }
    }

    /// At a ray through the face. At the rim, where by rounding the ray is in no triangle, the nearest counts.
    fn at(&self, ray: DVec3) -> Corner {
        let mut best = ([1.0, 0.0, 0.0], f64::NEG_INFINITY, [0; 3]);
        for triangle in &self.triangles {
            let products = triangle.sides.map(|side| side.dot(ray));
            let sum: f64 = products.iter().sum();
            let weights = products.map(|product| product / sum);
            let least = weights.into_iter().fold(f64::INFINITY, f64::min);
            if least > best.1 {
                best = (weights, least, triangle.corners);
            }
            if least >= 0.0 {
                break;
            }
        }
        let weights = best.0.map(|weight: f64| weight.max(0.0));
        let sum: f64 = weights.iter().sum();
        mean(weights.map(|weight| weight / sum), best.2.map(|corner| self.corners[corner as usize]))
    }
}

/// The weighted mean; the numbers of a colour are interpolated as in the scanline mode.
fn mean(weights: [f64; 3], corners: [Corner; 3]) -> Corner {
    let number = |of: fn(&Corner) -> f64| {
        // Where a number does not change it stays the same bits.
        let [a, b, c] = [of(&corners[0]), of(&corners[1]), of(&corners[2])];
        a + weights[1] * (b - a) + weights[2] * (c - a)
    };
    let vector = |of: &dyn Fn(&Corner) -> DVec3| {
        corners.iter().zip(weights).map(|(corner, weight)| of(corner) * weight).sum::<DVec3>()
    };
    let is_light = corners.iter().all(|corner| corner.color.light.is_some());
    Corner {
        color: Swatch {
            tint: number(|corner| corner.color.tint),
            saturation: number(|corner| corner.color.saturation),
            value: number(|corner| corner.color.value),
            translucency: number(|corner| corner.color.translucency),
            light: is_light.then(|| vector(&|corner| corner.color.light.unwrap_or_default())),
        },
        normal: vector(&|corner| corner.normal).normalize_or_zero(),
    }
}
