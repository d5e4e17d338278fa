//! The annotations of a picture.

use ugimage::Development;
use ugpicture::{Annotated, Annotations, DepthBuffer, Layout, SceneState};
use ugraster::Center;

use crate::config::Config;
use crate::error::Error;
use crate::front::of_surface;
use crate::render_layers::RenderLayers;
use crate::setup::Setup;

/// Annotates the picture of a scene. `development`: how the light of the picture was developed.
///
/// # Errors
/// Errors of rendering the scene with its moving bodies at rest.
pub fn annotate(
    layout: &Layout,
    setup: &Setup<'_>,
    config: &Config,
    development: Option<Development>,
) -> Result<Annotations, Error> {
    let scene = setup.scene();
    let is_shifted = match config.exact {
        Some(shift) => shift.shifts_wavelengths(),
        None => scene.stage.seen_colors().is_some_and(|seen| seen.doppler),
    };
    let annotated = Annotated { scene, camera: &config.picture.camera, is_shifted, seen: None };
    layout.annotate(annotated, &config.picture, development, |scene, camera, state| {
        let mut coarse = Config { wireframe: None, depth_cue: None, ..config.clone() };
        coarse.picture.samples = 1;
        coarse.picture.camera = camera.clone();
        coarse.exact = config.exact.filter(|_| state == SceneState::AsSeen);
        let setup = Setup::new(scene, &coarse)?;
        let layers = RenderLayers::new(setup.painter(), &coarse.draw_mode());
        let surface = |center: &Center<'_>| center.opaque.map(of_surface);
        let seen = layers.paint_centers(&setup.grid, &setup.shader, surface);
        Ok(DepthBuffer { size: coarse.picture.size, seen })
    })
}
