//! What annotations show of a scene: surfaces at the middles of pixels, and lines.

use ugpicture::{Emissions, FoundItems};
use ugraster::Center;
use ugscene::{CameraOptions, Scene};

use crate::center_surface::of_surface;
use crate::config::Config;
use crate::error::Error;
use crate::render_layers::{RenderLayers, with_rasterizer};
use crate::setup::Setup;

/// Calls a function with the nearest opaque surfaces at the middles of pixels, or of samples.
///
/// # Errors
/// As [`Setup::new`].
pub fn find_items(
    scene: &Scene,
    config: &Config,
    each_sample: bool,
    found: &mut dyn FnMut(&FoundItems<'_>),
) -> Result<(), Error> {
    let config = plain(config, each_sample);
    let setup = Setup::new(scene, &config)?;
    let layers = RenderLayers::new(&setup, &config)?;
    let surface = |center: &Center<'_>| center.opaque.map(of_surface);
    let seen = with_rasterizer!(layers, |rasterizer| rasterizer
        .paint_centers(surface, &layers.progress()));
    let emissions = Emissions::new(setup.scene(), &setup.view, setup.appearance.surface.frames());
    found(&|idx| emissions.at_pixel([setup.grid.width, 1], &seen, idx));
    Ok(())
}

/// The visible parts of the wires of a scene in a picture of these options from another camera, in
/// pixels.
///
/// # Errors
/// As [`Setup::new`].
pub fn visible_wires(
    scene: &Scene,
    camera: &CameraOptions,
    config: &Config,
) -> Result<Vec<[[f64; 2]; 2]>, Error> {
    let mut config = plain(config, false);
    config.picture.camera = camera.clone();
    let setup = Setup::new(scene, &config)?;
    let layers = RenderLayers::new(&setup, &config)?;
    Ok(layers.strokes().iter().map(|stroke| stroke.ends.map(|end| [end.x, end.y])).collect())
}

/// Options for one sample a pixel, without edges of faces and depth cueing. `is_refined`: a pixel
/// for each sample.
fn plain(config: &Config, is_refined: bool) -> Config {
    let mut plain = Config { wireframe: None, depth_cue: None, ..config.clone() };
    if is_refined {
        plain.picture.size = plain.picture.size.map(|side| side * plain.picture.samples);
    }
    plain.picture.samples = 1;
    plain
}
