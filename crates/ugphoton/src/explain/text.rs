//! An explanation as text.

use std::fmt::{self, Write};

use ugpicture::explain::text::{
    angles, body, described, event, level, number, numbers, row, write_color, write_colors,
};

use super::{ExplainedLamp, ExplainedSurface, RayExplanation, TracedSample};
use crate::tracer::Way;

/// Surfaces listed; between mirrors there may be thousands.
const MAX_SURFACES: usize = 24;

/// Lights listed for a surface.
const MAX_LAMPS: usize = 8;

/// The explanation as text.
pub fn text(explanation: &RayExplanation) -> String {
    ugpicture::explain::text::explanation(&explanation.pixel, |out| match &explanation.sample {
        Some(sample) => write_sample(out, sample, explanation),
        None => Ok(()),
    })
}

fn write_sample(out: &mut String, sample: &TracedSample, explanation: &RayExplanation) -> fmt::Result {
    let [x, y] = sample.place;
    writeln!(out, "\nthe covered sample nearest to the centre, at {} {}", number(x), number(y))?;
    row(out, "light", format!("{} linear, the sum of these surfaces", numbers(&sample.light)))?;
    if sample.background != [0.0; 3] {
        row(out, "background", format!("{} of it is seen", numbers(&sample.background)))?;
    }
    for (at, surface) in sample.surfaces.iter().take(MAX_SURFACES).enumerate() {
        write_surface(out, at, surface, explanation)?;
    }
    if sample.surfaces.len() > MAX_SURFACES {
        writeln!(out, "\nand {} more surfaces", sample.surfaces.len() - MAX_SURFACES)?;
    }
    Ok(())
}

fn write_surface(
    out: &mut String,
    at: usize,
    surface: &ExplainedSurface,
    explanation: &RayExplanation,
) -> fmt::Result {
    let way = match surface.way {
        Way::Straight => "seen directly".to_owned(),
        Way::Mirrored(by) => format!("mirrored by surface {}", by + 1),
        Way::Refracted(by) => format!("refracted by surface {}", by + 1),
    };
    writeln!(out, "\nsurface {}, {way}", at + 1)?;
    row(out, surface.item.kind, described(&surface.item))?;
    row(out, "body", body(surface.beta, surface.gamma, explanation.pixel.is_at_rest))?;
    if let Some(own_time) = surface.own_time {
        row(out, "own time", number(own_time))?;
    }
    let (time, place) = surface.emission;
    row(out, "emission", event(Some(time), place.to_array(), "camera frame, from the eye"))?;
    let (time, place) = surface.rest;
    row(out, "", event(Some(time), place.to_array(), "rest frame"))?;
    if let Some(angles_deg) = surface.angles_deg {
        row(out, "seen at", angles(angles_deg))?;
    }
    if let Some(medium) = &surface.medium {
        let velocity = if explanation.pixel.is_at_rest {
            String::new()
        } else {
            format!(", velocity {}", numbers(&medium.beta.to_array()))
        };
        let left = match medium.left {
            1.0 => String::new(),
            left => format!(", which leaves {} of it (P38)", number(left)),
        };
        let text = format!("in `{}`, index {}{velocity} (P35){left}", medium.name, number(medium.index));
        row(out, "light goes", text)?;
    }
    let equation = if surface.depth == 0 { "P10" } else { "along the whole path, P23" };
    row(out, "D", format!("{} ({equation})", number(surface.doppler)))?;
    write_colors(out, explanation.colors.as_ref(), surface.doppler)?;
    write_color(out, &surface.color)?;
    for lamp in surface.lamps.iter().take(MAX_LAMPS) {
        row(out, "lit by", lamp_text(lamp))?;
    }
    if surface.lamps.len() > MAX_LAMPS {
        row(out, "", format!("and {} more", surface.lamps.len() - MAX_LAMPS))?;
    }
    let [mirrored, transmitted] = surface.followed;
    if let Some(part) = mirrored {
        let total = if surface.is_total { ", by total reflection" } else { "" };
        row(out, "mirrors", format!("{} of the light{total}", number(part)))?;
    }
    if let Some(part) = transmitted {
        row(out, "transmits", format!("{} of the light", number(part)))?;
    }
    if surface.translucency > 0.0 {
        row(out, "translucency", number(surface.translucency))?;
    }
    let text = format!("{} linear, of which {} is seen", numbers(&surface.light), number(surface.weight));
    row(out, "own light", text)
}

fn lamp_text(lamp: &ExplainedLamp) -> String {
    let mut text = format!("{}: level {}", lamp.name, level(&lamp.level));
    if lamp.doppler != 1.0 {
        text += &format!(", D {} from it (P14)", number(lamp.doppler));
    }
    if let Some(distance) = lamp.distance.filter(|distance| distance.is_finite()) {
        text += &format!(", {} away in the rest frame", number(distance));
    }
    match lamp.part {
        part if part > 1.0 - 1e-9 => text,
        0.0 => text + ", in shadow (P24)",
        part => text + &format!(", {} of it not in shadow (P24)", number(part)),
    }
}
