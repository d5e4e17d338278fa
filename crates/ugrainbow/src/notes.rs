//! Notes for the user about a picture, above all why it is empty.

use ugimage::{Development, Tone};
use uglight::{DEFAULT_AMBIENT, DEFAULT_FROM_EYE};
use ugparse::Scene;
use ugpicture::{Background, Exposure};
use ugpipe::remedies;
use ugraster::{DepthFade, SampleStats};

use crate::clip::ClipCounts;
use crate::config::{Config, DepthCue};
use crate::setup::Setup;

/// Least brightness at which clipping is reported; less is invisible in 8 bits.
const CLIPPED: f32 = 1.001;

/// Statistics of a drawn picture.
#[derive(Clone, Copy, Debug)]
pub struct DrawStatistics {
    /// How many faces and lines were clipped.
    pub clip_counts: ClipCounts,
    /// Statistics of its samples.
    pub stats: SampleStats,
    /// How light was developed, if light brighter than white was kept.
    pub development: Option<Development>,
}

/// The notes, one sentence each.
pub fn notes(setup: &Setup<'_>, config: &Config, statistics: &DrawStatistics) -> Vec<String> {
    let mut notes: Vec<String> = setup.view.default_camera.iter().map(ToString::to_string).collect();
    notes.extend(scene_notes(setup.scene(), config.exact.is_some()));
    if config.repeat && setup.scene().stage.seen_colors().is_some() {
        notes.push(remedies::REPEAT_EARLIER.into());
    }
    if setup.view.is_up_replaced {
        notes.push(
            "the up direction is zero or parallel to the view, so another axis is up; choose one with -ud"
                .into(),
        );
    }
    let why = why_nothing_is_seen(config, statistics).map(str::to_owned);
    notes.extend(why.or_else(|| why_it_is_dark(&statistics.stats)));
    notes.extend(light_note(config, statistics));
    if let (Some(DepthCue { range: None, least }), Some(DepthFade { near, far, .. })) =
        (config.depth_cue, setup.grid.fade)
    {
        notes.push(format!(
            "depth cueing is from {near} to {far}; -dc {near} {far} {least} gives the same picture"
        ));
    }
    notes
}

/// How light brighter than white was brought into range, if there was any.
fn light_note(config: &Config, statistics: &DrawStatistics) -> Option<String> {
    if config.picture.output.is_linear() {
        return None;
    }
    if let (Some(Exposure::Auto), Some(Development { stops, .. })) =
        (config.picture.exposure, statistics.development)
    {
        return Some(format!("exposure is {stops} stops; -ex {stops} gives the same picture"));
    }
    let is_chosen = config.picture.exposure.is_some() || config.picture.tone != Tone::Clip;
    // Light beyond the largest number is shown as that number.
    let brightest = statistics.stats.max_intensity.min(f32::MAX);
    if brightest <= CLIPPED || is_chosen {
        return None;
    }
    let remedy = if statistics.development.is_some() { "; -ex auto brings it into range" } else { "" };
    Some(format!("max intensity is {}, clip to 1.0{remedy}", decimal(brightest)))
}

/// A number with one to three decimals, as short as possible.
fn decimal(number: f32) -> String {
    let text = format!("{number:.3}");
    let short = text.trim_end_matches('0');
    if short.ends_with('.') { format!("{short}0") } else { short.to_owned() }
}

fn scene_notes(scene: &Scene, is_exact: bool) -> Vec<String> {
    let mut notes = Vec::new();
    if scene.lights.is_empty() && scene.faces.iter().any(|face| scene.light_level(face).is_none()) {
        notes.push(format!(
            "no lights in the scene: drawn with ambient light {DEFAULT_AMBIENT} and a light of \
             {DEFAULT_FROM_EYE} from the eye"
        ));
    }
    if scene.lights.iter().any(|light| light.motion.body().is_some()) {
        let remedy = if is_exact { "leave out -xc: " } else { "" };
        notes.push(format!(
            "velocities of lights are left out: each light rests with the faces it lights; \
             {remedy}{}",
            remedies::MOVING_LIGHTS
        ));
    }
    notes.extend(ugscene::mixing_note(scene));
    // Exact pictures have spectra at rest only, which are not shifted.
    notes.extend(uglight::spectra_note(scene).filter(|_| !is_exact));
    notes
}

fn why_nothing_is_seen(
    config: &Config,
    DrawStatistics { clip_counts, stats, .. }: &DrawStatistics,
) -> Option<&'static str> {
    if clip_counts.in_front == 0 {
        return Some(remedies::NOTHING_IN_FRONT);
    }
    if clip_counts.in_picture == 0 {
        return Some(remedies::NOTHING_IN_PICTURE);
    }
    if stats.covered == 0 && config.cull {
        return Some(
            "nothing is drawn: everything is seen from behind, or smaller than a sample; leave out -cb, \
             or turn the faces round",
        );
    }
    if stats.covered == 0 {
        return Some(
            "nothing is drawn: everything is seen edge-on or smaller than a sample; try another -ep or a narrower -va",
        );
    }
    if stats.visible > 0 || stats.out_of_range > 0 {
        return None;
    }
    if has_black_lines(config) {
        return is_black(config.picture.background)
            .then_some("the lines are black on black: choose another colour with -lc or -bg");
    }
    Some(
        "all that is in the picture is black: its colours are, or no light falls on it; try `l 1;` in the scene",
    )
}

/// True if there are only lines, and they are black.
fn has_black_lines(config: &Config) -> bool {
    let color =
        config.wireframe.filter(|wireframe| !wireframe.has_faces).and_then(|wireframe| wireframe.color);
    color.is_some_and(|color| color.value == 0.0)
}

fn is_black(background: Background) -> bool {
    matches!(background, Background::Color(color) if color.value == 0.0)
}

/// The note on a picture of which more than half is black or grey because its wavelengths are
/// invisible.
fn why_it_is_dark(stats: &SampleStats) -> Option<String> {
    let &SampleStats { covered, visible, out_of_range, .. } = stats;
    let share = match visible {
        0 if out_of_range > 0 => "all that is in the picture is black".to_owned(),
        _ if out_of_range <= covered / 2 => return None,
        _ if out_of_range == covered => "all that is in the picture is black or grey".to_owned(),
        // Rounded down: 100 percent would be all.
        _ => {
            let percent = out_of_range.saturating_mul(100) / covered;
            format!("{percent} percent of what is in the picture is black or grey")
        }
    };
    Some(format!("{share}: {}", remedies::OUT_OF_RANGE))
}
