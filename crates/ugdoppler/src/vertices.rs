//! Vertices of a scene: which are used, and their Doppler factors.

use glam::DVec3;
use rayon::prelude::*;
use ugphysics::doppler_at;
use ugscene::{RestFrames, Scene, SeenVertices, Vertex};

/// True for vertices that a face or wire uses.
pub(crate) fn used(scene: &Scene) -> Vec<bool> {
    let mut used = vec![false; scene.vertices.len()];
    for drawn in scene.drawn() {
        scene
            .contours
            .corners(drawn.contours)
            .iter()
            .for_each(|corner| used[corner.index()] = true);
    }
    used
}

/// The Doppler factor of every vertex, by its velocity at emission.  Eq. (P10)
pub(crate) fn doppler_factors(
    scene: &Scene,
    eye: DVec3,
    frames: &RestFrames,
    seen: &SeenVertices,
) -> Vec<f64> {
    let factor = |(row, vertex): (usize, &Vertex)| {
        // Half the distance has the same direction, and does not overflow.
        let half = 0.5 * vertex.position - 0.5 * eye;
        doppler_at(half, seen.velocity(row, frames))
    };
    scene.vertices.par_iter().enumerate().map(factor).collect()
}
