//! Vertices of a scene: which are used, and their Doppler factors.

use glam::DVec3;
use rayon::prelude::*;
use ugphysics::doppler_at;
use ugscene::{RestFrames, Scene};

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

/// The Doppler factor of every vertex, by its velocity at emission.  Eq. (P10)
pub(crate) fn doppler_factors(scene: &Scene, eye: DVec3, frames: &RestFrames) -> Vec<f64> {
    let bodies = ugscene::vertex_bodies(scene);
    (scene.vertices.par_iter().zip(bodies.par_iter()))
        .map(|(vertex, &body)| {
            // Half the distance has the same direction, and does not overflow.
            let half = 0.5 * vertex.position - 0.5 * eye;
            doppler_at(half, frames.velocity_at(body, vertex.position - eye))
        })
        .collect()
}
