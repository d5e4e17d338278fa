//! The subject of a scene's annotations.

use ugpicture::{Annotated, DepthBuffer, DepthsOf, SceneState, Subject};
use ugraster::Center;
use ugscene::{CameraOptions, Scene};

use crate::config::Config;
use crate::error::Error;
use crate::front::of_surface;
use crate::render_layers::RenderLayers;
use crate::setup::Setup;

/// The subject of a prepared scene's annotations.
pub fn annotated<'a>(
    setup: &'a Setup<'_>,
    config: &'a Config,
    depths: &'a DepthsOf<'a, Error>,
) -> Annotated<'a, Error> {
    let scene = setup.scene();
    let is_shifted = match config.exact {
        Some(shift) => shift.shifts_wavelengths(),
        None => scene.stage.seen_colors().is_some_and(|seen| seen.doppler),
    };
    Annotated { is_shifted, subject: Subject::Scene { scene, camera: &config.picture.camera, depths } }
}

/// The depth buffer of a scene with a camera, in a picture of these options.
///
/// # Errors
/// Errors of rendering the scene with its moving bodies at rest.
pub fn depths(
    scene: &Scene,
    camera: &CameraOptions,
    state: SceneState,
    config: &Config,
) -> Result<DepthBuffer, Error> {
    let mut coarse = Config { wireframe: None, depth_cue: None, ..config.clone() };
    coarse.picture.samples = 1;
    coarse.picture.camera = camera.clone();
    coarse.exact = config.exact.filter(|_| state == SceneState::AsSeen);
    let setup = Setup::new(scene, &coarse)?;
    let layers = RenderLayers::new(setup.painter(), &coarse.draw_mode());
    let surface = |center: &Center<'_>| center.opaque.map(of_surface);
    let seen = layers.paint_centers(&setup.grid, &setup.shader, surface);
    Ok(DepthBuffer { size: coarse.picture.size, seen })
}
