//! Faces in one plane: where they overlap, depth cannot decide which of them is visible.

use glam::DVec3;
use rayon::prelude::*;
use rustc_hash::FxHashMap;

use crate::{BodyId, ColorId, Face, FaceShape, RestFrames, Scene, ShadingId, unit_normal};

/// Distance from a plane up to which a corner counts as being in it, relative to the largest
/// coordinate of its face. Rest positions that (P4) recovers from text have errors of 10⁻¹⁵.
const SAME_PLACE: f64 = 1e-9;

/// Weights of the three components of a normal and of the distance in the number by which planes
/// are sorted. No plane of round numbers has the number 0, where the sign would be noise.
const WEIGHTS: [f64; 4] =
    [0.436_812_907_331, 0.617_203_411_907, 0.654_371_083_561, 0.324_717_957_245];

/// Difference of these numbers up to which planes are compared, and the width of the cells of a
/// first selection: so narrow that of a million faces few share a cell by chance, so wide that few
/// numbers lie within `CLOSE` of the border of a cell.
const CLOSE: f64 = 1e-8;
const CELL: f64 = 1.0 / (1 << 23) as f64;

/// The least number of faces per thread.
const MANY_FACES: usize = 1 << 12;

/// The planes of each face of a scene: 0 for a face whose plane has no face of another look, else
/// the row of the first face in its plane plus 1. Empty if all are 0.
///
/// Of faces with the same plane that overlap the first in the scene is visible, however they move:
/// faces of bodies that move alike are in one plane at rest, so the light of all of them is of the
/// same events. Rounding, and the subdivision of curved shapes, would leave the choice to chance.
///
/// `rest`: the rest position of each vertex relative to the eye.
pub fn shared_planes(scene: &Scene, rest: &[DVec3], frames: &RestFrames) -> Vec<u32> {
    let reach = rest.iter().fold(0.0_f64, |reach, place| reach.max(place.abs().max_element()));
    let number = |face: &Face| PlacedFace { scene, rest, face }.number(reach);
    let numbers: Vec<f64> = scene.faces.par_iter().with_min_len(MANY_FACES).map(number).collect();
    let mut close = close_numbers(&numbers);
    if close.is_empty() {
        return Vec::new();
    }
    close.sort_unstable_by(|&a, &b| {
        numbers[a as usize].total_cmp(&numbers[b as usize]).then(a.cmp(&b))
    });
    let motions = motions(scene, frames);
    let mut planes = Vec::new();
    let motion = |row: u32| motions[scene.faces[row as usize].body.index()];
    for close in close.chunk_by_mut(|&a, &b| numbers[b as usize] - numbers[a as usize] <= CLOSE) {
        close.sort_by_key(|&row| motion(row));
    }
    let are_close = |&a: &u32, &b: &u32| {
        (numbers[b as usize] - numbers[a as usize]).abs() <= CLOSE && motion(a) == motion(b)
    };
    for close in close.chunk_by(are_close).filter(|close| close.len() > 1) {
        // Each plane with its faces, the first of which represents it.
        let mut groups: Vec<(Plane, Vec<u32>)> = Vec::new();
        for &row in close {
            let placed = PlacedFace { scene, rest, face: &scene.faces[row as usize] };
            let Some(plane) = placed.plane() else { continue };
            let is_same = |(other, rows): &&mut (Plane, Vec<u32>)| {
                let first = PlacedFace { face: &scene.faces[rows[0] as usize], ..placed };
                placed.is_in(other) || first.is_in(&plane)
            };
            match groups.iter_mut().find(is_same) {
                Some((_, rows)) => rows.push(row),
                None => groups.push((plane, vec![row])),
            }
        }
        for (plane, rows) in groups.into_iter().filter(|(_, rows)| rows.len() > 1) {
            let look = |row: u32| {
                PlacedFace { scene, rest, face: &scene.faces[row as usize] }.look(&plane)
            };
            let first = look(rows[0]);
            if first.is_none() || rows[1..].iter().any(|&row| look(row) != first) {
                planes.resize(scene.faces.len(), 0);
                let first = rows.iter().min().map_or(0, |row| row + 1);
                rows.iter().for_each(|&row| planes[row as usize] = first);
            }
        }
    }
    planes
}

/// The rows of numbers that may be close to another one: those that share a cell.
fn close_numbers(numbers: &[f64]) -> Vec<u32> {
    let bits = (16 * numbers.len()).next_power_of_two().max(64);
    let slots = |number: f64| {
        [number - CLOSE, number + CLOSE].map(|number| {
            // Numbers are below 3; the cast saturates.
            let cell = (number / CELL) as u32;
            (cell.wrapping_mul(0x9e37_79b9) >> 6) as usize & (bits - 1)
        })
    };
    let (mut once, mut twice) = (vec![0_u64; bits / 64], vec![0_u64; bits / 64]);
    for &number in numbers.iter().filter(|number| !number.is_nan()) {
        let [low, high] = slots(number);
        for slot in [low].into_iter().chain((high != low).then_some(high)) {
            let bit = 1 << (slot % 64);
            twice[slot / 64] |= once[slot / 64] & bit;
            once[slot / 64] |= bit;
        }
    }
    let is_twice = |slot: &usize| twice[slot / 64] >> (slot % 64) & 1 == 1;
    let is_close = |number: f64| !number.is_nan() && slots(number).iter().any(is_twice);
    // Scenes have fewer than 2^32 faces.
    (0..numbers.len() as u32).filter(|&row| is_close(numbers[row as usize])).collect()
}

/// For each body the first one that moves alike.
fn motions(scene: &Scene, frames: &RestFrames) -> Vec<BodyId> {
    let mut firsts: FxHashMap<[u64; 3], Vec<BodyId>> = FxHashMap::default();
    let first = |body: BodyId| {
        // Without the sign of 0.
        let key = (frames.velocity(body).proper() + 0.0).to_array().map(f64::to_bits);
        let alike = firsts.entry(key).or_default();
        let known = alike.iter().copied().find(|&other| frames.move_alike(other, body));
        known.unwrap_or_else(|| {
            alike.push(body);
            body
        })
    };
    scene.bodies.ids().map(first).collect()
}

/// A plane at rest: its points p fulfil p·normal = distance.
#[derive(Clone, Copy)]
struct Plane {
    normal: DVec3,
    distance: f64,
}

/// A face and the rest positions of its corners.
#[derive(Clone, Copy)]
struct PlacedFace<'a> {
    scene: &'a Scene,
    rest: &'a [DVec3],
    face: &'a Face,
}

impl PlacedFace<'_> {
    /// The number of its plane: the same for both directions of the normal, and nearly the same for
    /// nearly the same planes; NaN if it has no area, or is not flat.
    #[inline(always)] // Runs for every face of a scene.
    fn number(&self, reach: f64) -> f64 {
        if !matches!(self.face.shape, FaceShape::Polygon | FaceShape::Disc | FaceShape::Ring) {
            return f64::NAN;
        }
        let outline = self.scene.contours.get(self.face.contours.start);
        let (normal, point) = if let [a, b, c] = outline {
            let [a, b, c] = [a, b, c].map(|corner| self.rest[corner.index()]);
            ((b - a).cross(c - a), a)
        } else {
            self.plane()
                .map(|plane| (plane.normal, plane.distance * plane.normal))
                .unwrap_or_default()
        };
        let [x, y, z, w] = WEIGHTS;
        let sum = normal.dot(DVec3::new(x, y, z) + w / reach * point);
        (sum * sum / normal.length_squared()).sqrt()
    }

    /// `None` if it has no area.
    fn plane(&self) -> Option<Plane> {
        let outline = self.scene.contours.get(self.face.contours.start);
        let normal = unit_normal(outline.iter().map(|corner| self.rest[corner.index()]));
        let distance = normal.dot(self.rest[outline.first()?.index()]);
        (normal != DVec3::ZERO).then_some(Plane { normal, distance })
    }

    fn is_in(&self, plane: &Plane) -> bool {
        self.scene.face_corners(self.face).iter().all(|corner| {
            let place = self.rest[corner.index()];
            (place.dot(plane.normal) - plane.distance).abs()
                <= SAME_PLACE * place.abs().max_element()
        })
    }

    /// What pieces of one face have in common; where they overlap it does not matter which of two
    /// faces of one look is visible. `None` if corners have colours of their own.
    fn look(&self, plane: &Plane) -> Option<(Option<ColorId>, Option<ShadingId>, BodyId, bool)> {
        let Face { color, shading, body, .. } = *self.face;
        let corners = self.scene.face_corners(self.face);
        let is_own =
            corners.iter().any(|corner| self.scene.vertices[corner.index()].color.is_some());
        let is_front = self.plane()?.normal.dot(plane.normal) > 0.0;
        (!is_own).then_some((color, shading, body, is_front))
    }
}
