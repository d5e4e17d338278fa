//! Depth cueing with a range found from the visible depths.

use ugraster::Center;
use ugscene::Scene;

use crate::config::Config;
use crate::error::Error;
use crate::render_layers::{RenderLayers, with_rasterizer};
use crate::setup::Setup;

/// Prepares a scene. Without a range, depth cueing runs from the nearest to the farthest depth
/// visible at the middle of a pixel; it is left out if nothing is visible, or a depth is beyond
/// single precision.
///
/// # Errors
/// As [`Setup::new`].
pub fn prepare<'a>(scene: &'a Scene, config: &Config) -> Result<Setup<'a>, Error> {
    let mut setup = Setup::new(scene, config)?;
    if let Some(cue) = config.depth_cue.filter(|cue| cue.range.is_none()) {
        setup.grid.fade = visible_depths(&setup, config)?.map(|range| cue.between(range));
    }
    Ok(setup)
}

/// The least and greatest visible depth, rounded to four digits so that a note can state them
/// exactly.
fn visible_depths(setup: &Setup<'_>, config: &Config) -> Result<Option<[f64; 2]>, Error> {
    let layers = RenderLayers::new(setup, config)?;
    let ends = |center: &Center<'_>| {
        let opaque = center.opaque.iter().map(|hit| hit.key);
        let keys = opaque.chain(center.fragments.iter().map(|fragment| fragment.key));
        keys.fold([f32::INFINITY, f32::NEG_INFINITY], |[low, high], key| {
            [low.min(key), high.max(key)]
        })
    };
    let keys =
        with_rasterizer!(layers, |rasterizer| rasterizer.paint_centers(ends, &layers.progress()));
    let join = |[a, b]: [f32; 2], [c, d]: [f32; 2]| [a.min(c), b.max(d)];
    let Some([farthest, nearest]) = keys.into_iter().reduce(join) else { return Ok(None) };
    let depth = |key: f32| {
        let depth = setup.grid.depth(f64::from(key));
        format!("{depth:.3e}").parse().unwrap_or(depth)
    };
    let range = [depth(nearest), depth(farthest)];
    // Infinite depths are those beyond single precision.
    Ok((farthest <= nearest && range.iter().all(|depth| depth.is_finite())).then_some(range))
}
