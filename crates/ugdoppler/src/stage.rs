//! The stage of the output.

use glam::DVec3;
use ugphysics::Velocity;
use ugscene::{ColorStage, GeometryStage, Scene, SeenGeometry, Stage};

use crate::Config;

/// The stage of `scene`, which is the input, with its colours as seen.
pub(crate) fn with_seen_colors(scene: &Scene, config: &Config, eye: DVec3) -> Stage {
    let mut stage = scene.stage;
    // Then the colours depend on the eye, and positions were read as seen from it.
    let depends_on_eye =
        !config.velocity.is_zero() || config.light && ugscene::has_moving_lights(scene);
    if stage.geometry == GeometryStage::AtRest && depends_on_eye {
        stage.geometry = GeometryStage::AsSeen(SeenGeometry {
            eye,
            time: 0.0,
            camera_velocity: Velocity::ZERO,
            contraction: true,
            flight_time: true,
            is_whole: false,
        });
    }
    // Every vertex gets a new colour.
    stage.mixtures = None;
    stage.colors = ColorStage::AsSeen(config.shift.seen_colors(config.hue_scale(), config.light));
    stage
}
