//! Notes for the user about a picture, above all why it is empty.

use uglight::{DEFAULT_AMBIENT, DEFAULT_FROM_EYE, LampPlace, light_names};
use ugphysics::Event;
use ugpicture::{Note, is_all_transparent, why_nothing_is_seen};
use ugscene::{Face, SurfaceProperties};
use ugtrace::lens::Lens;

use crate::config::Config;
use crate::immersion::is_enclosed;
use crate::open_solids::open_face;
use crate::pixels::Statistics;
use crate::scenery::Scenery;
use crate::shade::transmittance;

/// One in so many samples is not visible.
const FEW: u64 = 1000;

/// The notes on a picture.
pub fn notes(scenery: &Scenery<'_>, config: &Config, statistics: &Statistics) -> Vec<Note> {
    let (scene, view) = (&scenery.scene, &scenery.view);
    let default_camera = view.default_camera.map(ugscene::Note::DefaultCamera);
    let mut notes: Vec<Note> = default_camera.into_iter().map(Note::Scene).collect();
    if !scenery.has_lights() && scene.faces.iter().any(|face| scene.light_level(face).is_none()) {
        let (ambient, from_eye) = (DEFAULT_AMBIENT, DEFAULT_FROM_EYE);
        notes.push(Note::NoLights { ambient, from_eye, has_shadows: true });
    }
    if scene.has_lines() {
        notes.push(Note::NoWires);
    }
    if view.is_up_replaced {
        notes.push(Note::UpReplaced);
    }
    // Between the parts of a solid that share no vertices rounding leaves gaps, which are not seen.
    let has_gap = statistics.n_open > statistics.n_covered / FEW;
    let name = |face: u32| {
        let name = scene.faces[face as usize].name.map_or("", |name| scene.names.get(name));
        if name.is_empty() {
            format!("face {}", face + 1)
        } else {
            format!("face {} (`{name}`)", face + 1)
        }
    };
    if config.rays.depth > 0
        && let Some(face) = open_face(&scenery.world, scenery.faces())
    {
        notes.push(Note::OpenSolid(name(face)));
    } else if let Some(face) = statistics.open_face.filter(|_| has_gap) {
        notes.push(Note::ReversedSolid(name(face)));
    }
    if lamps_shine_through_glass(scenery) {
        notes.push(Note::StraightThroughGlass);
    }
    notes.extend(enclosed_lamp(scenery).map(Note::EnclosedLamp));
    let depth = config.rays.depth;
    if depth > 0 && statistics.n_too_deep > statistics.n_covered / FEW {
        let percent = 100.0 * statistics.n_too_deep as f64 / statistics.n_covered as f64;
        notes.push(Note::TooDeep { percent, depth });
    }
    if statistics.is_cut_short {
        notes.push(Note::CutShort);
    }
    if config.adaptive.is_some() {
        let [width, height] =
            config.crop.map_or(config.picture.size, |[_, _, width, height]| [width, height]);
        let n_all = u64::from(width) * u64::from(height) * u64::from(config.picture.samples.pow(2));
        notes.push(Note::Adaptive(100.0 * statistics.n_samples as f64 / n_all as f64));
    }
    notes.extend(match statistics {
        Statistics { n_covered: 0, .. } if scenery.sky.is_some() => None,
        Statistics { n_covered: 0, .. } => {
            let is_flat = config.lens == Lens::Pinhole && config.stereo.is_none();
            Some(why_nothing_is_seen(scene, is_flat.then_some(view), false))
        }
        // Fully transparent faces cover samples, since they may mirror.
        Statistics { n_visible: 0, .. } if is_all_transparent(scene) => Some(Note::AllTransparent),
        Statistics { n_visible: 0, .. } => Some(Note::BlackFaces),
        _ => None,
    });
    notes
}

/// The name of a lamp in a closed opaque body that the eye is not in. Its light does not leave
/// that.
fn enclosed_lamp(scenery: &Scenery<'_>) -> Option<String> {
    if !scenery.has_lights() || !scenery.rays.shadows {
        return None;
    }
    let is_opaque = |face| transmittance(scenery, face) == 0.0;
    let is_enclosed = |event| is_enclosed(&scenery.world, scenery.faces(), event, is_opaque);
    let is_dark = |row: usize| {
        let LampPlace::At(place) = scenery.lamps[row].place else { return false };
        let frames = scenery.appearance.surface.frames();
        let frame = match (scenery.lamps[row].motion.body(), &scenery.world.parts[..]) {
            (Some(body), _) if frames.world_line(body).is_none() => frames.of(body),
            (None, [only]) if only.motion.is_none() => &only.frame,
            // It rests with each of several bodies, or is enclosed for a time.
            _ => return false,
        };
        is_enclosed(frame.camera_from_rest(Event { t: -place.length(), x: place }))
    };
    let n_lights = scenery.scene.lights.len();
    let row = (0..n_lights).find(|&row| is_dark(row))?;
    let is_around_the_eye = is_enclosed(Event::ORIGIN);
    (!is_around_the_eye).then(|| light_names(&scenery.scene).swap_remove(row))
}

/// True if the light of lamps, which is followed backwards in straight lines (P24), may cross a
/// refracting solid.
fn lamps_shine_through_glass(scenery: &Scenery<'_>) -> bool {
    let refracts =
        |surface: &SurfaceProperties| surface.transmitted > 0.0 && surface.refraction != 1.0;
    let is_refracting = |face: &Face| scenery.scene.surface(face).is_some_and(refracts);
    let is_directed = scenery.lamps.iter().any(|lamp| lamp.place != LampPlace::Everywhere);
    scenery.has_lights()
        && is_directed
        && scenery.rays.shadows
        && scenery.scene.faces.iter().any(is_refracting)
}
