//! An explanation as text.

use ugpicture::explain::text::{ExplanationText, level, number, numbers};
use ugpicture::explain::{Explanation, WriteSample};

use super::{ExplainedLamp, ExplainedMedium, TracedSample, TracedSurface};
use crate::tracer::Way;

/// Surfaces listed; between mirrors there may be thousands.
const MAX_SURFACES: usize = 24;

/// Lights listed for a surface.
const MAX_LAMPS: usize = 8;

impl WriteSample for TracedSample {
    fn write(&self, out: &mut ExplanationText, explanation: &Explanation<Self>) {
        out.row("light", format!("{} linear, the sum of these surfaces", numbers(&self.linear)));
        if self.background != [0.0; 3] {
            out.row("background", format!("{} of it is seen", numbers(&self.background)));
        }
        for (at, surface) in self.surfaces.iter().take(MAX_SURFACES).enumerate() {
            write_surface(out, at, surface, explanation);
        }
        if self.surfaces.len() > MAX_SURFACES {
            out.line(format!("\nand {} more surfaces", self.surfaces.len() - MAX_SURFACES));
        }
    }
}

fn write_surface(
    out: &mut ExplanationText,
    at: usize,
    traced: &TracedSurface,
    explanation: &Explanation<TracedSample>,
) {
    let surface = &traced.surface;
    let way = match traced.way {
        Way::Straight => "seen directly".to_owned(),
        Way::Mirrored(by) => format!("mirrored by surface {}", by + 1),
        Way::Refracted(by) => format!("refracted by surface {}", by + 1),
    };
    out.line(format!("\nsurface {}, {way}", at + 1));
    out.surface(surface, explanation.is_at_rest);
    if let Some(medium) = &traced.medium {
        out.row("light goes", medium_text(medium, explanation.is_at_rest));
    }
    let equation = if traced.depth == 0 { "P10" } else { "along the whole path, P23" };
    out.doppler(surface.doppler, equation, explanation.colors.as_ref());
    out.assumed(surface.assumed.as_ref());
    if let Some(color) = &surface.color {
        out.color(color);
    }
    out.rows("lit by", &traced.lamps, MAX_LAMPS, lamp_text);
    if let Some(part) = traced.mirrored {
        let total = if traced.is_total_reflection { ", by total reflection" } else { "" };
        out.row("mirrors", format!("{} of the light{total}", number(part)));
    }
    if let Some(part) = traced.transmitted {
        out.row("transmits", format!("{} of the light", number(part)));
    }
    if traced.translucency > 0.0 {
        out.row("translucency", number(traced.translucency));
    }
    let light = numbers(&surface.linear);
    out.row("own light", format!("{light} linear, of which {} is seen", number(traced.weight)));
}

fn medium_text(medium: &ExplainedMedium, is_all_at_rest: bool) -> String {
    let mut text = format!("in `{}`, index {}", medium.surface, number(medium.index));
    if !is_all_at_rest {
        text += &format!(", velocity {}", numbers(&medium.velocity));
    }
    text += " (P35)";
    if medium.left != 1.0 {
        text += &format!(", which leaves {} of it (P38)", number(medium.left));
    }
    text
}

fn lamp_text(lamp: &ExplainedLamp) -> String {
    let mut text = format!("{}: level {}", lamp.light, level(&lamp.level));
    if lamp.doppler != 1.0 {
        text += &format!(", D {} from it (P14)", number(lamp.doppler));
    }
    if let Some(distance) = lamp.distance {
        text += &format!(", {} away in the rest frame", number(distance));
    }
    match lamp.part {
        part if part > 1.0 - 1e-9 => text,
        0.0 => text + ", in shadow (P24)",
        part => text + &format!(", {} of it not in shadow (P24)", number(part)),
    }
}
