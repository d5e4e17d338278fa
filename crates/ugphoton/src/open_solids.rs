//! Transparent solids that are open: light passes between inside and outside without crossing a
//! face.

use std::collections::BTreeSet;

use glam::DVec3;

use crate::immersion::transparent_solid;
use ugtrace::rays::{Faces, World};

/// How far from the middle of an edge the way around it leads, relative to the length of the edge.
const BESIDE: f64 = 1e-3;

/// The first face with an edge around which light passes into a solid and out of it. A solid whose
/// edges end at opaque faces, such as water in a basin, is closed by them.
pub fn open_face(world: &World, faces: Faces<'_>) -> Option<u32> {
    let matters = |face: u32| {
        let surface = faces.scene.surface(&faces.scene.faces[face as usize]);
        let is_flat = !faces.scene.faces[face as usize].shape.is_round();
        is_flat
            && surface.is_some_and(|it| {
                it.transmitted > 0.0 && (it.refraction != 1.0 || it.absorption > 0.0)
            })
    };
    let mut of_solids: Vec<(u32, usize)> = world
        .triangles()
        .map(|(part, triangle)| (triangle.face, part))
        .filter(|it| matters(it.0))
        .collect();
    of_solids.sort_unstable();
    of_solids.dedup();
    let sides = |face: u32| {
        let edges = ugscene::face_edges(faces.scene, &faces.scene.faces[face as usize]);
        edges.map(|edge| edge.map(|end| faces.rest[end.index()]))
    };
    let bits = |place: DVec3| (place + 0.0).to_array().map(f64::to_bits);
    let all: BTreeSet<_> =
        of_solids.iter().flat_map(|it| sides(it.0)).map(|side| side.map(bits)).collect();
    let is_open = |&(face, part): &(u32, usize)| {
        let solid = transparent_solid(faces.scene, part, face);
        let normal = faces.outside(face);
        let is_free = |[a, b]: [DVec3; 2]| {
            let distance = BESIDE * (b - a).length();
            let (up, across) =
                (distance * normal, distance * normal.cross((b - a).normalize_or_zero()));
            let middle = a.midpoint(b);
            let way =
                [across - up, -across - up, up - across, across + up].map(|step| middle + step);
            let blocks = |other: u32| {
                let other = transparent_solid(faces.scene, part, other);
                other.is_none() || other == solid
            };
            distance > 0.0
                && way.windows(2).all(|way| !world.parts[part].crosses(way[0], way[1], blocks))
        };
        sides(face).filter(|[a, b]| !all.contains(&[bits(*b), bits(*a)])).any(is_free)
    };
    of_solids.iter().find(|it| is_open(it)).map(|it| it.0)
}
