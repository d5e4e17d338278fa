//! The visible parts of the wires of a scene, for annotations. Pictures show no wires.

use std::borrow::Cow;

use glam::DVec3;
use rayon::prelude::*;
use ugpicture::{DepthPoint, in_picture, visible_parts};
use ugscene::{CameraOptions, Scene};

use crate::config::Config;
use crate::error::Error;
use crate::scenery::Scenery;

/// Faces in front of a wire by less than this part of its distance do not hide it: it may be an
/// edge of theirs.
const SLACK: f64 = 1e-6;

/// The parts of wires at rest that faces do not hide in a picture of these options from another
/// camera, in pixels.
///
/// # Errors
/// As [`Scenery::new`].
pub fn visible(
    scene: &Scene,
    camera: &CameraOptions,
    config: &Config,
) -> Result<Vec<[[f64; 2]; 2]>, Error> {
    let mut config = config.clone();
    config.picture.samples = 1;
    config.picture.camera = camera.clone();
    let scenery = Scenery::new(Cow::Borrowed(scene), &config)?;
    let view = &scenery.view;
    let is_hidden = |[x, y, key]: DepthPoint| {
        let depths = view.slab.near..(1.0 - SLACK) / key;
        scenery.ray_through([x, y]).is_some_and(|ray| scenery.first_opaque(&ray, depths).is_some())
    };
    let parts = |ends: [DVec3; 2]| {
        let ends = in_picture(view, ends)?.map(|end| {
            let place = view.place(end);
            [place.x / place.z, place.y / place.z, 1.0 / place.z]
        });
        let [a, b] = ends;
        let at = move |part: f64| [0, 1].map(|i| a[i] + (b[i] - a[i]) * part);
        Some(visible_parts(ends, [0.0, 1.0], is_hidden).into_iter().map(move |ends| ends.map(at)))
    };
    let contours = scene.wires.par_iter().flat_map_iter(|wire| scene.wire_contours(wire));
    let place = |vertex: &ugscene::VertexId| scene.vertices[vertex.index()].position - view.eye;
    let lines = contours
        .flat_map_iter(|line| line.windows(2).map(|ends| [place(&ends[0]), place(&ends[1])]));
    Ok(lines.flat_map_iter(|ends| parts(ends).into_iter().flatten()).collect())
}
