//! An explanation as text.

use std::fmt::{self, Write};

use ugparse::{ColorScale, SeenColors, Stage};
use ugpicture::Filter;

use super::{Corner, ExplainedSample, Explanation, Item, PixelSteps, SampleColor};

/// Corners listed; a face may have thousands.
const MAX_CORNERS: usize = 8;

/// The explanation as text.
pub fn text(explanation: &Explanation) -> String {
    let mut out = String::new();
    // Writing into a string does not fail.
    let _ = write_all(&mut out, explanation);
    out
}

fn write_all(out: &mut String, explanation: &Explanation) -> fmt::Result {
    let Explanation { pixel: [x, y], size: [width, height], samples: n, .. } = explanation;
    writeln!(out, "pixel {x} {y} of {width} x {height}, {n} x {n} samples")?;
    let n_samples = (n * n) as usize;
    for (item, count) in &explanation.covers {
        writeln!(out, "    {count} of {n_samples}: {}", described(item))?;
    }
    if explanation.n_free > 0 {
        let n_free = explanation.n_free;
        writeln!(out, "    {n_free} of {n_samples}: background")?;
    }
    if let Some(shown) = &explanation.sample {
        write_sample(out, shown, explanation)?;
    }
    write_pixel(out, &explanation.pixel_steps, explanation.samples)
}

fn row(out: &mut String, title: &str, text: impl fmt::Display) -> fmt::Result {
    writeln!(out, "{title:<14}{text}")
}

fn write_sample(out: &mut String, shown: &ExplainedSample, explanation: &Explanation) -> fmt::Result {
    let [x, y] = shown.place;
    writeln!(out, "\nthe covered sample nearest to the centre, at {} {}", number(x), number(y))?;
    row(out, shown.item.kind, described(&shown.item))?;
    row(out, "body", body(shown, explanation))?;
    row(
        out,
        "emission",
        event(Some(shown.emission.0), shown.emission.1.to_array(), "camera frame, from the eye"),
    )?;
    row(out, "", event(shown.rest.0, shown.rest.1.to_array(), "rest frame"))?;
    if let Some([camera, rest]) = shown.angles_deg {
        let text = format!(
            "{}° from the motion in the camera frame, {}° in the rest frame (P6)",
            number(camera),
            number(rest)
        );
        row(out, "seen at", text)?;
    }
    row(out, "D", format!("{} (P10)", number(shown.doppler)))?;
    write_colors(out, &explanation.stage, shown.doppler)?;
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

fn body(shown: &ExplainedSample, explanation: &Explanation) -> String {
    if explanation.is_at_rest {
        return "everything is at rest".to_owned();
    }
    if shown.beta.length() == 0.0 {
        return "at rest".to_owned();
    }
    let beta = numbers(&shown.beta.to_array());
    format!("velocity {beta}, beta {}, gamma {}", number(shown.beta.length()), number(shown.gamma))
}

fn event(time: Option<f64>, place: [f64; 3], frame: &str) -> String {
    let time = time.map_or("none, as an effect was left out".to_owned(), number);
    format!("t {time}, x {} ({frame})", numbers(&place))
}

/// The line about the colours.
fn write_colors(out: &mut String, stage: &Stage, doppler: f64) -> fmt::Result {
    let Some(seen) = stage.seen_colors() else {
        return row(out, "colours", "at rest: neither shifted nor changed in brightness");
    };
    let shift = match (seen.doppler, seen.scale) {
        (false, _) => "wavelengths not shifted",
        (true, ColorScale::Hues { .. }) => "wavelengths divided by D (P11)",
        (true, ColorScale::Spectra { .. }) => "spectra shifted by D (P11)",
    };
    let (law, power) = match seen.scale {
        ColorScale::Hues { law, .. } => (format!("by the law `{}`", law.name()), law.factor(doppler)),
        ColorScale::Spectra { flux: true } => ("D^5 per wavelength".to_owned(), libm::pow(doppler, 5.0)),
        ColorScale::Spectra { flux: false } => ("by the law `none`".to_owned(), 1.0),
    };
    let lights = if seen.lights { "; the light of lamps is in them (P14)" } else { "" };
    row(out, "colours", format!("as seen: {shift}, brightness {law}: times {} (P12){lights}", number(power)))
}

/// Name of the brightness law of colours as seen, for scripts.
pub(super) fn law_name(seen: &SeenColors) -> &'static str {
    match seen.scale {
        ColorScale::Hues { law, .. } => law.name(),
        ColorScale::Spectra { flux: true } => "D^5",
        ColorScale::Spectra { flux: false } => "none",
    }
}

fn corner_text(corner: &Corner) -> String {
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

/// A light level: one number if the light is white.
fn level(level: &[f64; 3]) -> String {
    if level[0] == level[1] && level[1] == level[2] {
        number(level[0])
    } else {
        format!("({})", numbers(level))
    }
}

fn write_color(out: &mut String, color: &SampleColor) -> fmt::Result {
    match color {
        SampleColor::Light { xyz, chromaticity } => {
            row(out, "colour", format!("X Y Z {}, lit", numbers(xyz)))?;
            if let Some(chromaticity) = chromaticity {
                row(out, "", format!("chromaticity x y {}", numbers(chromaticity)))?;
            }
            Ok(())
        }
        SampleColor::Hue { hue, saturation, value, level, wavelength } => {
            let Some(wavelength) = wavelength else {
                return row(out, "colour", format!("grey, value {}{}", number(*value), lit(level)));
            };
            let text = format!(
                "hue {}, saturation {}, value {}{}",
                number(*hue),
                number(*saturation),
                number(*value),
                lit(level)
            );
            row(out, "colour", text)?;
            let end = if wavelength.is_at_end { ", the end of the range, or anything beyond" } else { "" };
            let (rest_nm, seen_nm) = (number(wavelength.rest_nm), number(wavelength.seen_nm));
            row(out, "wavelength", format!("{rest_nm} nm at rest, {seen_nm} nm seen{end} (P16)"))?;
            row(out, "attenuation", format!("hue times {} (P17)", number(wavelength.attenuation)))
        }
    }
}

fn lit(level: &Option<[f64; 3]>) -> String {
    level.map_or(", lit".to_owned(), |level| format!(", times red, green, blue light {}", numbers(&level)))
}

fn write_pixel(out: &mut String, steps: &PixelSteps, samples: u32) -> fmt::Result {
    let [red, green, blue, part] = steps.mean.map(f64::from);
    writeln!(out, "\nthe pixel")?;
    let by = match steps.filter {
        Filter::Box => String::new(),
        filter => {
            format!(", of {n} x {n} samples by the filter {}", filter.name(), n = filter.n_samples(samples))
        }
    };
    row(out, "mean", format!("{} linear, {} of it covered{by}", numbers(&[red, green, blue]), number(part)))?;
    if let Some((development, steps)) = &steps.development {
        row(out, "exposure", format!("{} stops: {}", number(development.stops), numbers(&steps.exposed)))?;
        row(out, "tone curve", format!("{}: {}", development.tone.name(), numbers(&steps.toned)))?;
        row(out, "gamut", numbers(&steps.shown))?;
    }
    let [red, green, blue, alpha] = steps.bytes;
    row(out, "bytes", format!("{red} {green} {blue}, alpha {alpha}"))
}

fn described(item: &Item) -> String {
    let name = item.name.as_ref().map_or(String::new(), |name| format!(" `{name}`"));
    let place = item.place.as_ref().map_or(String::new(), |(file, line)| format!(", {file}:{line}"));
    format!("{}{name}, id {}{place}", item.kind, item.id)
}

fn numbers(all: &[f64]) -> String {
    all.iter().map(|&x| number(x)).collect::<Vec<_>>().join(" ")
}

/// Six significant digits.
fn number(x: f64) -> String {
    let rounded: f64 = format!("{x:.5e}").parse().unwrap_or(x);
    let size = rounded.abs();
    if size != 0.0 && !(1e-4..1e9).contains(&size) { format!("{rounded:e}") } else { format!("{rounded}") }
}
