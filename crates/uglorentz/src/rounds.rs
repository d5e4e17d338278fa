//! Round faces cut into polygons, before subdivision.

use glam::DVec3;
use ugscene::{
    COARSEST_SAGITTA, CameraOptions, Face, PlacedBodies, RelativeMotion, RoundShape, Scene,
    cut_rounds, seen_sagitta, seen_sagitta_on_world_line,
};

use crate::{Config, Error, Pieces, viewpoint};

/// Radius, in pixels, below which uneven shading of a shape on a world line is not visible.
const SMALL_PIXELS: f64 = 8.0;

/// The greatest sagitta of such a shape, relative to its radius.
const COARSEST_OF_SMALL: f64 = 0.1;

/// Cuts round faces so that no polygon is seen farther from the surface than the bound on errors of
/// shape; those of bodies on world lines not finer than a fixed part of their radius. Without
/// subdivision only the latter are cut, since rays meet the others as they are.
pub(crate) fn cut(scene: &mut Scene, config: &Config) -> Result<(), Error> {
    let is_whole = config.pieces == Pieces::PerEdge(1);
    if !(if is_whole { scene.has_rounds_on_world_lines() } else { scene.has_rounds() }) {
        return Ok(());
    }
    let camera = CameraOptions { eye: config.eye, ..config.camera.clone() };
    let mut trial = scene.clone();
    let placed =
        PlacedBodies::move_to_camera_frame(&mut trial, &config.motion(), &camera, config.size)?;
    let rest = placed.rest_positions(&trial);
    let error = viewpoint::error(&trial, config)?;
    // Of an invalid view no shape is small; renderers refuse it.
    let pixel = viewpoint::pixel(&trial, config).unwrap_or(0.0);
    let sagitta = |row: usize, _: &Face, _: &RoundShape| {
        let face = &trial.faces[row];
        let round = trial.round_shape(face, |vertex| rest[vertex.index()])?;
        let motion = &placed.motions[face.body.index()];
        Some(match motion.world_line() {
            Some(_) => {
                let sagitta = seen_sagitta_on_world_line(&round, motion, error, COARSEST_OF_SMALL);
                let is_small = error <= SMALL_PIXELS * pixel * sagitta;
                if is_small { sagitta } else { sagitta.min(COARSEST_SAGITTA) }
            }
            None if is_whole => return None,
            None => {
                seen_sagitta(&round, DVec3::ZERO, error * least_doppler(&round, motion).min(1.0))
            }
        })
    };
    Ok(cut_rounds(scene, sagitta)?)
}

/// A lower bound of D on a shape relative to the eye: angles at the eye are 1/D times those in the
/// rest frame.  Eq. (P11)
fn least_doppler(round: &RoundShape, motion: &RelativeMotion) -> f64 {
    let [low, high] = round.bounds();
    let (center, radius) = (low.midpoint(high), 0.5 * ugphysics::length(high - low));
    let around = libm::asin((radius / ugphysics::length(center)).min(1.0));
    let angle = (ugphysics::angle(center, motion.direction()) - around).max(0.0);
    // NaN at the centre becomes the least D of all directions.
    let toward = libm::cos(angle).clamp(-1.0, 1.0);
    let least = motion.gamma() - motion.proper_speed() * if toward.is_nan() { 1.0 } else { toward };
    least.max(0.5 / motion.gamma())
}
