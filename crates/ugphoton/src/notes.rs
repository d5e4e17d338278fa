//! Notes for the user about a picture, above all why it is empty.

use ugimage::{Development, Tone};
use uglight::{DEFAULT_AMBIENT, DEFAULT_FROM_EYE, LampPlace};
use ugparse::{Face, SurfaceProperties};
use ugpicture::Exposure;

use crate::config::Config;
use crate::pixels::Statistics;
use crate::scenery::{Lights, Scenery};

/// Least brightness at which clipping is reported; less is invisible in 8 bits.
const CLIPPED: f64 = 1.001;

/// One in so many samples is not visible.
const FEW: u64 = 1000;

/// The notes, one sentence each.
pub fn notes(
    scenery: &Scenery<'_>,
    config: &Config,
    statistics: &Statistics,
    development: Option<Development>,
) -> Vec<String> {
    let (scene, view) = (&scenery.scene, &scenery.view);
    let mut notes: Vec<String> = view.default_camera.iter().map(ToString::to_string).collect();
    if !scenery.lights.are_of_scene && scene.faces.iter().any(|face| scene.light_level(face).is_none()) {
        notes.push(format!(
            "no lights in the scene: drawn with ambient light {DEFAULT_AMBIENT} and a light of \
             {DEFAULT_FROM_EYE} from the eye, without shadows"
        ));
    }
    if !scene.wires.is_empty() {
        notes.push("wires are left out: rays do not meet lines".to_owned());
    }
    if view.is_up_replaced {
        notes.push(
            "the up direction is zero or parallel to the view, so another axis is up; choose one with -ud"
                .into(),
        );
    }
    // Between the parts of a solid that share no vertices rounding leaves gaps, which are not seen.
    if statistics.n_open > statistics.n_covered / FEW {
        notes.push(
            "light leaves a transparent solid that it did not enter: the solid is open, or its outlines run \
             clockwise seen from outside; it is drawn as if it were not refracted there"
                .to_owned(),
        );
    }
    if lamps_shine_through_glass(scenery) {
        notes.push(
            "light of lamps goes straight through transparent solids, as fast as in a vacuum: it is absorbed \
             there, but neither refracted nor slowed"
                .to_owned(),
        );
    }
    if config.rays.depth > 0 && statistics.n_too_deep > statistics.n_covered / FEW {
        notes.push(format!(
            "{:.1} percent of the samples end after {depth} reflections and refractions, and what is behind is \
             black: a larger -rd shows it",
            100.0 * statistics.n_too_deep as f64 / statistics.n_covered as f64,
            depth = config.rays.depth
        ));
    }
    if statistics.is_cut_short {
        notes.push(
            "some paths branch at too many mirrors and solids, and are cut short: give a smaller -rd or a \
             larger -rc"
                .to_owned(),
        );
    }
    if config.adaptive.is_some() {
        let [width, height] =
            config.crop.map_or(config.picture.size, |[_, _, width, height]| [width, height]);
        let n_all = u64::from(width) * u64::from(height) * u64::from(config.picture.samples.pow(2));
        let percent = 100.0 * statistics.n_samples as f64 / n_all as f64;
        notes.push(format!("traced {percent:.0} percent of the samples (-ad)"));
    }
    notes.extend(why_nothing_is_seen(statistics).map(str::to_owned));
    notes.extend(light_note(config, statistics, development));
    notes
}

/// True if the light of lamps, which is followed backwards in straight lines (P24), may cross a
/// refracting solid.
fn lamps_shine_through_glass(scenery: &Scenery<'_>) -> bool {
    let Lights { lamps, are_of_scene, .. } = &scenery.lights;
    let refracts = |surface: &SurfaceProperties| surface.transmitted > 0.0 && surface.refraction != 1.0;
    let is_refracting = |face: &Face| scenery.scene.surface(face).is_some_and(refracts);
    let is_directed = lamps.iter().any(|lamp| lamp.place != LampPlace::Everywhere);
    *are_of_scene && is_directed && scenery.rays.shadows && scenery.scene.faces.iter().any(is_refracting)
}

fn why_nothing_is_seen(statistics: &Statistics) -> Option<&'static str> {
    match statistics {
        Statistics { n_covered: 0, .. } => Some(
            "nothing is drawn: everything is outside the picture, where fast bodies often are; \
             try -in, another -vc or a wider -va",
        ),
        Statistics { n_visible: 0, .. } => Some(
            "all that is in the picture is black: no light falls on it, or its wavelengths are outside 380-780 \
             nm; try a lower speed, or --no-doppler --no-flux to see the shape",
        ),
        _ => None,
    }
}

/// How light brighter than white was brought into range, if there was any.
fn light_note(config: &Config, statistics: &Statistics, development: Option<Development>) -> Option<String> {
    let picture = &config.picture;
    if picture.output.is_linear() {
        return None;
    }
    if let (Some(Exposure::Auto), Some(Development { stops, .. })) = (picture.exposure, development) {
        return Some(format!("exposure is {stops} stops; -ex {stops} gives the same picture"));
    }
    let is_chosen = picture.exposure.is_some() || picture.tone != Tone::Clip;
    if statistics.max_light <= CLIPPED || is_chosen {
        return None;
    }
    let most = statistics.max_light.min(f64::from(f32::MAX));
    Some(format!("max light is {most:.3}, clip to 1.0; -ex auto brings it into range"))
}
