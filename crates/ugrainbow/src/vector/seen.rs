//! Which faces are seen.

use std::sync::atomic::{AtomicBool, Ordering};

use crate::raster::Gathered;
use crate::setup::Setup;
use crate::sheet::Sheet;

/// For each face, whether it or a face beside it is seen at a sample.
///
/// A face that is seen only between samples nearly always has a neighbour that is seen at one, so it is kept.
pub fn faces(setup: &Setup<'_>, sheet: &Sheet<'_>) -> Vec<bool> {
    let scene = setup.scene();
    let is_seen: Vec<AtomicBool> = scene.faces.iter().map(|_| AtomicBool::new(false)).collect();
    let n_pixels = setup.grid.width as usize * setup.grid.height as usize;
    // Pixels of nothing take no memory. In which order faces are found makes no difference.
    sheet.paint(&setup.grid, &setup.shader, &mut vec![(); n_pixels], &|all: &Gathered<u32>| {
        let face = all.center.and_then(|seen| is_seen.get(seen.tag as usize));
        if let Some(face) = face {
            face.store(true, Ordering::Relaxed);
        }
    });
    let mut is_corner = vec![false; scene.vertices.len()];
    for (face, is_seen) in scene.faces.iter().zip(&is_seen) {
        if is_seen.load(Ordering::Relaxed) {
            let corners = scene.contours.corners(face.contours.clone());
            corners.iter().for_each(|vertex| is_corner[vertex.index()] = true);
        }
    }
    let has_seen_corner = |face: &ugparse::Face| {
        scene.contours.corners(face.contours.clone()).iter().any(|vertex| is_corner[vertex.index()])
    };
    scene.faces.iter().map(has_seen_corner).collect()
}
