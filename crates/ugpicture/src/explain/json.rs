//! Explanations as JSON.

use glam::DVec3;
use serde_json::{Map, Value, json};

use super::{ExplainedItem, ExplainedPixel, PixelSteps, SampleColor};

/// An explanation as JSON, ending with a line break. `of_renderer`: names and values of the fields
/// that only this renderer has.
pub fn explanation<const N: usize>(pixel: &ExplainedPixel, of_renderer: [(&str, Value); N]) -> String {
    let ExplainedPixel { place, size, samples, covers, n_free, is_at_rest, steps } = pixel;
    let n_samples = (samples * samples) as usize;
    let part = |count: usize| count as f64 / n_samples as f64;
    let covers: Vec<Value> =
        covers.iter().map(|(shown, count)| json!({ "item": item(shown), "part": part(*count) })).collect();
    let mut all = Map::new();
    let mut add = |name: &str, value: Value| drop(all.insert(name.to_owned(), value));
    add("pixel", json!(place));
    add("size", json!(size));
    add("samples", json!(n_samples));
    add("covers", json!(covers));
    add("background_part", json!(part(*n_free)));
    add("is_at_rest", json!(is_at_rest));
    of_renderer.into_iter().for_each(|(name, value)| add(name, value));
    add("filter", json!(steps.filter.name()));
    add("mean_linear", json!(steps.mean[..3]));
    add("development", development(steps));
    add("bytes", json!(steps.bytes));
    format!("{:#}\n", Value::Object(all))
}

/// A face or wire.
pub fn item(item: &ExplainedItem) -> Value {
    let (file, line) = item.place.clone().unzip();
    json!({ "kind": item.kind, "id": item.id, "name": item.name, "file": file, "line": line })
}

/// A vector.
pub fn point(point: DVec3) -> Value {
    json!(point.to_array())
}

/// A colour.
pub fn color(color: &SampleColor) -> Value {
    match color {
        SampleColor::Hue { hue, saturation, value, level, wavelength } => json!({
            "hue": hue,
            "saturation": saturation,
            "value": value,
            "light_level": level,
            "rest_wavelength_nm": wavelength.map(|wavelength| wavelength.rest_nm),
            "seen_wavelength_nm": wavelength.map(|wavelength| wavelength.seen_nm),
            "is_at_end_of_range": wavelength.map(|wavelength| wavelength.is_at_end),
            "attenuation": wavelength.map(|wavelength| wavelength.attenuation),
        }),
        SampleColor::Light { xyz, chromaticity } => json!({ "xyz": xyz, "chromaticity": chromaticity }),
    }
}

/// How the light of a pixel was developed; null if it was not.
fn development(steps: &PixelSteps) -> Value {
    let developed = steps.development.map(|(development, steps)| {
        json!({
            "stops": development.stops,
            "tone_curve": development.tone.name(),
            "exposed": steps.exposed,
            "toned": steps.toned,
            "in_gamut": steps.shown,
        })
    });
    json!(developed)
}
