//! Visibility of faces at samples.

use std::sync::atomic::{AtomicBool, Ordering};

use ugraster::{Corner, Keep, PixelSamples, SampleStats, TRANSPARENT_VALUES};

use crate::planar::doubled_area;
use crate::render_layers::{RenderLayers, with_rasterizer};
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

/// About the number of samples of translucent faces in a picture of this size, hidden ones
/// included.
pub fn n_fragments(layers: &RenderLayers<'_>, size: [u32; 2]) -> f64 {
    let mut sum = 0.0;
    if !layers.has_transparent_faces() {
        return sum;
    }
    layers.for_each_polygon(|_, is_transparent, contours| {
        sum += if is_transparent { n_samples(&contours, size) } else { 0.0 };
    });
    sum
}

/// About how many samples of a picture of this size a polygon covers.
fn n_samples(contours: &[Vec<Corner<TRANSPARENT_VALUES>>], size: [u32; 2]) -> f64 {
    let place = |corner: &Corner<TRANSPARENT_VALUES>| [corner.x, corner.y, corner.key];
    let area =
        |contour: &Vec<_>| 0.5 * doubled_area(&contour.iter().map(place).collect::<Vec<_>>()).abs();
    let extent = |axis: usize| {
        let places = || contours.iter().flatten().map(|corner| place(corner)[axis]);
        let end = f64::from(size[axis]);
        let low = places().fold(f64::INFINITY, f64::min).clamp(0.0, end);
        places().fold(f64::NEG_INFINITY, f64::max).clamp(0.0, end) - low
    };
    // The area includes parts outside the picture; the box around the polygon is cut to the picture.
    contours.first().map_or(0.0, area).min(extent(0) * extent(1))
}

/// Decides visibility from the samples of a picture.
pub fn faces(setup: &Setup<'_>, layers: &RenderLayers<'_>) -> Faces {
    let scene = setup.scene();
    let is_seen: Vec<AtomicBool> = scene.faces.iter().map(|_| AtomicBool::new(false)).collect();
    // The pixels are `()`, which take no memory. The order in which tasks visit faces does not
    // matter.
    let mark = |all: &PixelSamples<'_>| {
        let center = &all.center;
        let transparent = center.fragments.iter().filter(|fragment| !fragment.is_line);
        let transparent = transparent.map(|fragment| fragment.item);
        for item in center.opaque.iter().map(|hit| hit.item).chain(transparent) {
            if let Some(face) = is_seen.get(item as usize) {
                face.store(true, Ordering::Relaxed);
            }
        }
    };
    let (_, stats) = with_rasterizer!(layers, |rasterizer| {
        rasterizer.paint(layers.shader, Keep::Centers, &mark, &layers.progress())
    });
    let is_seen: Vec<bool> = is_seen.into_iter().map(AtomicBool::into_inner).collect();
    let mut is_corner = vec![false; scene.vertices.len()];
    for (face, is_seen) in scene.faces.iter().zip(&is_seen) {
        if *is_seen {
            scene.face_corners(face).iter().for_each(|vertex| is_corner[vertex.index()] = true);
        }
    }
    let has_seen_corner = |face: &ugscene::Face| {
        scene.face_corners(face).iter().any(|vertex| is_corner[vertex.index()])
    };
    let is_near = scene.faces.iter().map(has_seen_corner).collect();
    Faces { is_seen, is_near, stats }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_outside_the_picture_are_not_counted() {
        let square = |low: f64, high: f64| {
            let corner =
                |[x, y]: [f64; 2]| Corner { x, y, key: 1.0, values: [0.0; TRANSPARENT_VALUES] };
            vec![[[low, low], [high, low], [high, high], [low, high]].map(corner).to_vec()]
        };
        assert_eq!(n_samples(&square(10.0, 14.0), [64, 32]), 16.0);
        assert_eq!(n_samples(&square(-900.0, 900.0), [64, 32]), 64.0 * 32.0);
        assert_eq!(n_samples(&square(-900.0, -800.0), [64, 32]), 0.0);
    }
}
