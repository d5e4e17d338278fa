//! An explanation as JSON, for scripts.

use serde_json::{Value, json};
use ugpicture::explain::json::{color, item, point};
use ugpicture::explain::text::law_name;

use super::{ExplainedLamp, ExplainedSurface, RayExplanation, TracedSample};
use crate::tracer::Way;

/// The explanation as JSON, ending with a line break.
pub fn json(explanation: &RayExplanation) -> String {
    let of_renderer = [
        ("brightness_law", json!(explanation.colors.as_ref().map(law_name))),
        ("sample", json!(explanation.sample.as_ref().map(shown))),
    ];
    ugpicture::explain::json::explanation(&explanation.pixel, of_renderer)
}

fn shown(sample: &TracedSample) -> Value {
    json!({
        "place": sample.place,
        "linear": sample.light,
        "background": sample.background,
        "surfaces": sample.surfaces.iter().map(surface).collect::<Vec<_>>(),
    })
}

fn surface(surface: &ExplainedSurface) -> Value {
    let (way, by) = match surface.way {
        Way::Straight => ("straight", None),
        Way::Mirrored(by) => ("mirrored", Some(by)),
        Way::Refracted(by) => ("refracted", Some(by)),
    };
    let medium = surface.medium.as_ref().map(
        |medium| json!({ "surface": medium.name, "index": medium.index, "velocity": point(medium.beta), "left": medium.left }),
    );
    json!({
        "item": item(&surface.item),
        "way": way,
        "by": by,
        "depth": surface.depth,
        "weight": surface.weight,
        "medium": medium,
        "velocity": point(surface.beta),
        "beta": surface.beta.length(),
        "gamma": surface.gamma,
        "own_time": surface.own_time,
        "emission": { "t": surface.emission.0, "x": point(surface.emission.1) },
        "emission_at_rest": { "t": surface.rest.0, "x": point(surface.rest.1) },
        "angle_deg": surface.angles_deg.map(|[camera, _]| camera),
        "angle_at_rest_deg": surface.angles_deg.map(|[_, rest]| rest),
        "D": surface.doppler,
        "translucency": surface.translucency,
        "color": color(&surface.color),
        "lamps": surface.lamps.iter().map(lamp).collect::<Vec<_>>(),
        "linear": surface.light,
        "mirrored": surface.followed[0],
        "transmitted": surface.followed[1],
        "is_total_reflection": surface.is_total,
    })
}

fn lamp(lamp: &ExplainedLamp) -> Value {
    json!({
        "light": lamp.name,
        "level": lamp.level,
        "D": lamp.doppler,
        "distance": lamp.distance.filter(|distance| distance.is_finite()),
        "part": lamp.part,
    })
}
