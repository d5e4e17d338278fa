//! Vertices of a scene: which are used, which carry one colour, and their Doppler factors.

use glam::DVec3;
use rayon::prelude::*;
use ugparse::{Face, Scene};
use ugphysics::doppler_at;
use ugscene::RestFrames;

/// True for vertices that a face or wire uses.
pub(crate) fn used(scene: &Scene) -> Vec<bool> {
    let mut used = vec![false; scene.vertices.len()];
    let faces = scene.faces.iter().map(|face| face.contours.clone());
    let wires = scene.wires.iter().map(|wire| wire.contours.clone());
    for rows in faces.chain(wires) {
        scene.contours.corners(rows).iter().for_each(|corner| used[corner.index()] = true);
    }
    used
}

/// Gives wires vertices of their own, since a vertex carries one colour only; and with
/// `each_face_color` (`-vr`) a copy of a vertex to each colour of its faces. All copies keep the
/// normal, so shading stays smooth across them.
pub(crate) fn repeat(scene: &mut Scene, each_face_color: bool) {
    if scene.wires.is_empty() && !each_face_color {
        return;
    }
    let of_face = |face: &Face| (false, face.color.filter(|_| each_face_color));
    let faces = scene.faces.iter().map(|face| (face.contours.clone(), of_face(face)));
    let wires = scene.wires.iter().map(|wire| (wire.contours.clone(), (true, wire.color)));
    let users: Vec<_> = faces.chain(wires).collect();
    ugscene::split_vertices(scene, &users, |vertex| vertex.color.is_none());
}

/// The Doppler factor of every vertex, by the velocity of its body.  Eq. (P10)
pub(crate) fn doppler_factors(scene: &Scene, eye: DVec3, frames: &RestFrames) -> Vec<f64> {
    let bodies = ugscene::vertex_bodies(scene);
    (scene.vertices.par_iter().zip(bodies.par_iter()))
        .map(|(vertex, &body)| doppler_at(vertex.position - eye, frames.velocity(body)))
        .collect()
}
