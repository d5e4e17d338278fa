//! Round faces of bodies that accelerate or turn, as polygons as fine as the picture shows them.

use std::f64::consts::PI;

use ugscene::{Face, PlacedBodies, RoundShape, Scene, View};

use crate::config::Config;
use crate::error::Error;
use crate::lens::Lens;

/// The greatest distance of a polygon from the surface, in pixels: the covered part of a pixel
/// changes by this much at most, and so only single samples at outlines do.
const SAGITTA: f64 = 0.02;

/// Cuts the round faces of bodies on world lines, within [`SAGITTA`] where they are seen directly,
/// or 1/4000 of their radius if that is more.
///
/// # Errors
/// The camera is invalid, or there would be too many polygons.
pub fn cut_on_world_lines(scene: &mut Scene, config: &Config) -> Result<(), Error> {
    if !scene.has_rounds_on_world_lines() {
        return Ok(());
    }
    let (camera, size) = (&config.picture.camera, config.frame_size());
    let mut trial = scene.clone();
    ugscene::repeat_vertices(&mut trial, false);
    let placed = PlacedBodies::move_to_camera_frame(&mut trial, &config.motion, camera, size)?;
    let rest = placed.rest_positions(&trial);
    let pixel = pixel_angle(&trial, config)?;
    let sagitta = |row: usize, _: &Face, _: &RoundShape| {
        let face = &trial.faces[row];
        let motion = &placed.motions[face.body.index()];
        motion.world_line()?;
        let round = trial.round_shape(face, |vertex| rest[vertex.index()])?;
        Some(ugscene::seen_sagitta_on_world_line(&round, motion, SAGITTA * pixel, 1.0))
    };
    Ok(ugscene::cut_rounds(scene, sagitta)?)
}

/// A lower bound of the angle of a pixel, in radians.
fn pixel_angle(scene: &Scene, config: &Config) -> Result<f64, Error> {
    let size = config.frame_size();
    if config.lens != Lens::Pinhole {
        // Of these lenses the one with the most pixels has a quarter of a circle across at least.
        return Ok(0.5 * PI / f64::from(size[0].max(size[1])));
    }
    let view = View::new(scene, &config.picture.camera, size)?;
    let [corner, across, down] = view.rays();
    // Pixels at the corners, the farthest from the axis, are the smallest.
    let least = across.length().min(down.length()) / corner.length_squared();
    Ok(if least.is_finite() { least } else { 0.0 })
}

#[cfg(test)]
mod tests {
    use ugpicture::PictureOptions;

    use super::*;

    fn n_polygons(text: &str, size: [u32; 2]) -> usize {
        let source = ugparse::Source::new("s.ug", text);
        let options = ugparse::Options::default();
        let mut scene = ugparse::parse(&source, &options).unwrap().scene;
        let picture = PictureOptions { size, ..PictureOptions::default() };
        cut_on_world_lines(&mut scene, &Config { picture, ..Config::default() }).unwrap();
        scene.faces.len()
    }

    /// Small spheres have few polygons; a large one has as many as within 1/4000 of its radius.
    #[test]
    fn polygons_follow_pixels() {
        let small: String =
            (0..200).map(|at| format!("sphere {} 0 0 .02 <m>;", 0.01 * f64::from(at))).collect();
        let camera = "cam -ep 0 -12 3 -vc 0 0 0;";
        let small = format!("motion m -spin 0 0 .1; {small} {camera}");
        let counts =
            [[8, 6], [80, 60], [800, 600], [8000, 6000]].map(|size| n_polygons(&small, size));
        assert!(counts[0] < 200 * 40, "{counts:?}");
        assert!(counts.windows(2).all(|pair| pair[0] <= pair[1]), "{counts:?}");
        assert!(counts[2] < 200 * 700 && counts[3] > 10 * counts[0], "{counts:?}");
        let near = format!("motion m -spin 0 0 .1; sphere 0 0 0 2 <m>; {camera}");
        assert_eq!(n_polygons(&near, [4000, 3000]), 20_000);
    }
}
