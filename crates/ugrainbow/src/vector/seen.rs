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
    sheet.paint(&setup.grid, &setup.shader, &mut vec![(); n_pixels], &|all: &Gathered<'_, u32>| {
        let panes = all.layers.iter().filter(|layer| !layer.is_line).map(|layer| layer.item);
        for item in all.center.iter().map(|seen| seen.tag).chain(panes) {
            if let Some(face) = is_seen.get(item as usize) {
                face.store(true, Ordering::Relaxed);
            }
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
