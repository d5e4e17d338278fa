//! Visibility of faces at samples.

use std::sync::atomic::{AtomicBool, Ordering};
use ugraster::{PixelSamples, SampleStats};

use crate::render_layers::RenderLayers;
use crate::setup::Setup;

/// Visibility of faces at samples.
pub struct Faces {
    /// For each face, whether it is visible at a sample.
    pub is_seen: Vec<bool>,
    /// For each face, whether it or a neighbour is visible at a sample. A face that is visible only
    /// between samples nearly always has a neighbour that is visible at one.
    pub is_near: Vec<bool>,
    /// Statistics of the samples.
    pub stats: SampleStats,
}

/// Decides visibility from the samples of a picture.
pub fn faces(setup: &Setup<'_>, layers: &RenderLayers<'_>) -> Faces {
    let scene = setup.scene();
    let is_seen: Vec<AtomicBool> = scene.faces.iter().map(|_| AtomicBool::new(false)).collect();
    // The pixels are `()`, which take no memory. The order in which tasks visit faces does not
    // matter.
    let (_, stats) = layers.paint_with_centers(&setup.grid, &setup.shader, &|all: &PixelSamples<'_>| {
        let center = &all.center;
        let transparent = center.fragments.iter().filter(|fragment| !fragment.is_line);
        let transparent = transparent.map(|fragment| fragment.item);
        for item in center.opaque.iter().map(|hit| hit.item).chain(transparent) {
            if let Some(face) = is_seen.get(item as usize) {
                face.store(true, Ordering::Relaxed);
            }
        }
    });
    let is_seen: Vec<bool> = is_seen.into_iter().map(AtomicBool::into_inner).collect();
    let mut is_corner = vec![false; scene.vertices.len()];
    for (face, is_seen) in scene.faces.iter().zip(&is_seen) {
        if *is_seen {
            let corners = scene.contours.corners(face.contours.clone());
            corners.iter().for_each(|vertex| is_corner[vertex.index()] = true);
        }
    }
    let has_seen_corner = |face: &ugparse::Face| {
        scene.contours.corners(face.contours.clone()).iter().any(|vertex| is_corner[vertex.index()])
    };
    let is_near = scene.faces.iter().map(has_seen_corner).collect();
    Faces { is_seen, is_near, stats }
}
