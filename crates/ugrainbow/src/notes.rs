//! Notes for the user about a picture, above all why it is empty.

use uglight::{DEFAULT_AMBIENT, DEFAULT_FROM_EYE};
use ugpicture::{Background, Note, is_all_transparent};
use ugraster::{DepthFade, SampleStats};
use ugscene::Scene;

use crate::config::{Config, DepthCue};
use crate::drawn_scene::DrawnScene;

/// The notes on a picture.
pub fn notes(drawn: &DrawnScene<'_>, config: &Config) -> Vec<Note> {
    let setup = &drawn.setup;
    let default_camera = setup.view.default_camera.map(ugscene::Note::DefaultCamera);
    let mut notes: Vec<Note> = default_camera.into_iter().map(Note::Scene).collect();
    scene_notes(setup.scene(), config.exact.is_some(), &mut notes);
    if config.repeat && setup.scene().stage.seen_colors().is_some() {
        notes.push(Note::NotRepeated);
    }
    if setup.view.is_up_replaced {
        notes.push(Note::UpReplaced);
    }
    let why = why_nothing_is_seen(config, drawn, !setup.scene().lights.is_empty());
    notes.extend(why.filter(|_| !config.sky.is_some()).or_else(|| why_it_is_dark(&drawn.stats)));
    if let (Some(DepthCue { range: None, least }), Some(DepthFade { near, far, .. })) =
        (config.depth_cue, setup.grid.fade)
    {
        notes.push(Note::DepthCue { near, far, least });
    }
    notes
}

fn scene_notes(scene: &Scene, is_exact: bool, notes: &mut Vec<Note>) {
    if scene.lights.is_empty() && scene.faces.iter().any(|face| scene.light_level(face).is_none()) {
        let (ambient, from_eye) = (DEFAULT_AMBIENT, DEFAULT_FROM_EYE);
        notes.push(Note::NoLights { ambient, from_eye, has_shadows: false });
    }
    if scene.lights.iter().any(|light| light.motion.body().is_some()) {
        notes.push(Note::MovingLights { is_exact });
    }
    if !is_exact
        && scene.stage.seen_colors().is_none()
        && let Some(color) = scene.drawn_texture_name()
    {
        notes.push(Note::PlainTextures { color: color.to_owned() });
    }
    notes.extend(ugscene::Note::mixed_colors(scene).map(Note::Scene));
    // Exact pictures have spectra at rest only, which are not shifted.
    notes.extend(uglight::spectra_note(scene).filter(|_| !is_exact).map(Note::Scene));
}

fn why_nothing_is_seen(
    config: &Config,
    DrawnScene { setup, stats, .. }: &DrawnScene<'_>,
    has_lights: bool,
) -> Option<Note> {
    // Fully transparent faces cover samples.
    let is_clear = config.wireframe.is_none() && is_all_transparent(setup.scene());
    if stats.covered == 0 || is_clear {
        return Some(ugpicture::why_nothing_is_seen(setup.scene(), Some(&setup.view), config.cull));
    }
    if stats.visible > 0 || stats.out_of_range > 0 {
        return None;
    }
    if has_black_lines(config) {
        return is_black(config.picture.background).then_some(Note::BlackLines);
    }
    Some(Note::NoLight { has_lights })
}

/// True if there are only lines, and they are black.
fn has_black_lines(config: &Config) -> bool {
    let color = config
        .wireframe
        .filter(|wireframe| !wireframe.has_faces)
        .and_then(|wireframe| wireframe.color);
    color.is_some_and(|color| color.value == 0.0)
}

fn is_black(background: Background) -> bool {
    matches!(background, Background::Color(color) if color.value == 0.0)
}

/// The note on a picture of which more than half is black or grey because its wavelengths are
/// invisible.
fn why_it_is_dark(stats: &SampleStats) -> Option<Note> {
    let &SampleStats { covered, visible, out_of_range, .. } = stats;
    if visible == 0 && out_of_range > 0 {
        return Some(Note::OutOfRange { percent: 100, is_black: true });
    }
    // Rounded down: 100 percent is all.
    let percent = || out_of_range.saturating_mul(100) / covered;
    (out_of_range > covered / 2).then(|| Note::OutOfRange { percent: percent(), is_black: false })
}
