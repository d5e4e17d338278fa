//! Explanations as JSON.

use glam::DVec3;
use serde_json::{Value, json};

use super::{Item, PixelSteps, SampleColor};

/// A face or wire.
pub fn item(item: &Item) -> Value {
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
pub fn development(steps: &PixelSteps) -> Value {
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
