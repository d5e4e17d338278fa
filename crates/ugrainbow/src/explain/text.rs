//! An explanation as text.

use std::fmt::{self, Write};

use ugpicture::explain::text::{
    angles, body, described, event, level, number, numbers, row, write_color, write_colors,
};

use super::{ExplainedCorner, ExplainedSample, Explanation};

/// Corners listed; a face may have thousands.
const MAX_CORNERS: usize = 8;

/// The explanation as text.
pub fn text(explanation: &Explanation) -> String {
    ugpicture::explain::text::explanation(&explanation.pixel, |out| match &explanation.sample {
        Some(sample) => write_sample(out, sample, explanation),
        None => Ok(()),
    })
}

fn write_sample(out: &mut String, shown: &ExplainedSample, explanation: &Explanation) -> fmt::Result {
    let [x, y] = shown.place;
    writeln!(out, "\nthe covered sample nearest to the centre, at {} {}", number(x), number(y))?;
    row(out, shown.item.kind, described(&shown.item))?;
    row(out, "body", body(shown.beta, shown.gamma, explanation.pixel.is_at_rest))?;
    if let Some(own_time) = shown.own_time {
        row(out, "own time", number(own_time))?;
    }
    row(
        out,
        "emission",
        event(Some(shown.emission.0), shown.emission.1.to_array(), "camera frame, from the eye"),
    )?;
    row(out, "", event(shown.rest.0, shown.rest.1.to_array(), "rest frame"))?;
    if let Some(angles_deg) = shown.angles_deg {
        row(out, "seen at", angles(angles_deg))?;
    }
    row(out, "D", format!("{} (P10)", number(shown.doppler)))?;
    write_colors(out, explanation.stage.seen_colors(), shown.doppler)?;
    for corner in shown.corners.iter().take(MAX_CORNERS) {
        row(out, "corner", corner_text(corner))?;
    }
    if shown.corners.len() > MAX_CORNERS {
        row(out, "", format!("and {} more", shown.corners.len() - MAX_CORNERS))?;
    }
    if let Some(color) = &shown.color {
        write_color(out, color)?;
    }
    row(out, "light", format!("{} linear", numbers(&shown.light.map(f64::from))))?;
    if let Some(cue) = shown.cue {
        row(out, "depth cueing", format!("leaves {} of it", number(f64::from(cue))))?;
    }
    for (idx, layer) in shown.layers.iter().enumerate() {
        let (pass, light) = (number(f64::from(layer.translucency)), numbers(&layer.light.map(f64::from)));
        let title = if idx == 0 { "layers" } else { "behind it" };
        row(out, title, format!("{}: translucency {pass}, light {light}", described(&layer.item)))?;
    }
    Ok(())
}

fn corner_text(corner: &ExplainedCorner) -> String {
    let color = if corner.is_light {
        format!("linear {}", numbers(&corner.color))
    } else {
        let [hue, saturation, value] = corner.color.map(number);
        format!("hue {hue}, saturation {saturation}, value {value}")
    };
    let mut text = format!("`{}` {color}; lit {}", corner.name, level(&corner.level));
    if corner.lights.len() > 1 {
        let parts: Vec<String> =
            corner.lights.iter().map(|(light, part)| format!("{} {light}", level(part))).collect();
        text += &format!(" = {}", parts.join(" + "));
    }
    text
}
