//! An explanation as JSON, for scripts.

use serde_json::{Value, json};
use ugpicture::explain::json::{color, development, item, point};
use ugpicture::explain::text::law_name;

use super::{Corner, ExplainedSample, Explanation, LayerShown};

/// The explanation as JSON, ending with a line break.
pub fn json(explanation: &Explanation) -> String {
    let Explanation { pixel, size, samples, covers, n_free, history, stage, is_at_rest, sample, pixel_steps } =
        explanation;
    let n_samples = (samples * samples) as usize;
    let part = |count: usize| count as f64 / n_samples as f64;
    let covers: Vec<Value> =
        covers.iter().map(|(shown, count)| json!({ "item": item(shown), "part": part(*count) })).collect();
    let value = json!({
        "pixel": pixel,
        "size": size,
        "samples": n_samples,
        "covers": covers,
        "background_part": part(*n_free),
        "history": history,
        "is_at_rest": is_at_rest,
        "brightness_law": stage.seen_colors().map(law_name),
        "sample": sample.as_ref().map(shown),
        "filter": pixel_steps.filter.name(),
        "mean_linear": pixel_steps.mean[..3],
        "development": development(pixel_steps),
        "bytes": pixel_steps.bytes,
    });
    format!("{value:#}\n")
}

fn shown(shown: &ExplainedSample) -> Value {
    json!({
        "place": shown.place,
        "item": item(&shown.item),
        "velocity": point(shown.beta),
        "beta": shown.beta.length(),
        "gamma": shown.gamma,
        "emission": { "t": shown.emission.0, "x": point(shown.emission.1) },
        "emission_at_rest": { "t": shown.rest.0, "x": point(shown.rest.1) },
        "angle_deg": shown.angles_deg.map(|[camera, _]| camera),
        "angle_at_rest_deg": shown.angles_deg.map(|[_, rest]| rest),
        "D": shown.doppler,
        "color": shown.color.as_ref().map(color),
        "corners": shown.corners.iter().map(corner).collect::<Vec<_>>(),
        "linear": shown.light,
        "depth_cue": shown.cue,
        "layers": shown.layers.iter().map(layer).collect::<Vec<_>>(),
    })
}

fn layer(layer: &LayerShown) -> Value {
    json!({ "item": item(&layer.item), "translucency": layer.translucency, "linear": layer.light })
}

fn corner(corner: &Corner) -> Value {
    let lights: Vec<Value> =
        corner.lights.iter().map(|(light, level)| json!({ "light": light, "level": level })).collect();
    let names = if corner.is_light { "linear" } else { "hue_saturation_value" };
    json!({ "vertex": corner.name, names: corner.color, "light_level": corner.level, "lights": lights })
}
