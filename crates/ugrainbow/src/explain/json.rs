//! An explanation as JSON, for scripts.

use serde_json::{Value, json};
use ugpicture::explain::json::{color, item, point};
use ugpicture::explain::text::law_name;

use super::{ExplainedCorner, ExplainedSample, Explanation, LayerShown};

/// The explanation as JSON, ending with a line break.
pub fn json(explanation: &Explanation) -> String {
    let of_renderer = [
        ("history", json!(explanation.history)),
        ("brightness_law", json!(explanation.stage.seen_colors().map(law_name))),
        ("sample", json!(explanation.sample.as_ref().map(shown))),
    ];
    ugpicture::explain::json::explanation(&explanation.pixel, of_renderer)
}

fn shown(shown: &ExplainedSample) -> Value {
    json!({
        "place": shown.place,
        "item": item(&shown.item),
        "velocity": point(shown.beta),
        "beta": shown.beta.length(),
        "gamma": shown.gamma,
        "own_time": shown.own_time,
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

fn corner(corner: &ExplainedCorner) -> Value {
    let lights: Vec<Value> =
        corner.lights.iter().map(|(light, level)| json!({ "light": light, "level": level })).collect();
    let names = if corner.is_light { "linear" } else { "hue_saturation_value" };
    json!({ "vertex": corner.name, names: corner.color, "light_level": corner.level, "lights": lights })
}
