//! Explanations as text: a title of up to 13 characters at the left, then what it is.

use std::fmt::{self, Write};

use glam::DVec3;
use ugimage::Filter;
use ugscene::{ColorScale, SeenColors};

use super::{ExplainedItem, ExplainedPixel, PixelSteps, SampleColor};

/// An explanation. `write_sample`: writes what the renderer tells of a sample.
pub fn explanation(pixel: &ExplainedPixel, write_sample: impl FnOnce(&mut String) -> fmt::Result) -> String {
    let mut out = String::new();
    // Writing into a string does not fail.
    let _ = write_explanation(&mut out, pixel, write_sample);
    out
}

fn write_explanation(
    out: &mut String,
    pixel: &ExplainedPixel,
    write_sample: impl FnOnce(&mut String) -> fmt::Result,
) -> fmt::Result {
    let ExplainedPixel { place: [x, y], size: [width, height], samples: n, .. } = pixel;
    writeln!(out, "pixel {x} {y} of {width} x {height}, {n} x {n} samples")?;
    let n_samples = (n * n) as usize;
    for (item, count) in &pixel.covers {
        writeln!(out, "    {count} of {n_samples}: {}", described(item))?;
    }
    if pixel.n_free > 0 {
        writeln!(out, "    {} of {n_samples}: background", pixel.n_free)?;
    }
    write_sample(out)?;
    write_pixel(out, &pixel.steps, pixel.samples)
}

/// A line: a title, and a text.
///
/// # Errors
/// Errors that `out` returns.
pub fn row(out: &mut String, title: &str, text: impl fmt::Display) -> fmt::Result {
    writeln!(out, "{title:<14}{text}")
}

/// An event; without a time if an effect was left out.
pub fn event(time: Option<f64>, place: [f64; 3], frame: &str) -> String {
    let time = time.map_or("none, as an effect was left out".to_owned(), number);
    format!("t {time}, x {} ({frame})", numbers(&place))
}

/// The motion of a body. `is_all_at_rest`: as that of everything else.
pub fn body(beta: DVec3, gamma: f64, is_all_at_rest: bool) -> String {
    if is_all_at_rest {
        return "everything is at rest".to_owned();
    }
    if beta.length() == 0.0 {
        return "at rest".to_owned();
    }
    format!("velocity {}, beta {}, gamma {}", numbers(&beta.to_array()), number(beta.length()), number(gamma))
}

/// The angles between the line of sight and the motion, in the frames of the camera and of the
/// body.
pub fn angles([camera, rest]: [f64; 2]) -> String {
    format!(
        "{}° from the motion in the camera frame, {}° in the rest frame (P6)",
        number(camera),
        number(rest)
    )
}

/// The line about the law of colours. `seen`: as they are seen; `None` for colours at rest.
///
/// # Errors
/// Errors that `out` returns.
pub fn write_colors(out: &mut String, seen: Option<&SeenColors>, doppler: f64) -> fmt::Result {
    let Some(seen) = seen else {
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
pub fn law_name(seen: &SeenColors) -> &'static str {
    match seen.scale {
        ColorScale::Hues { law, .. } => law.name(),
        ColorScale::Spectra { flux: true } => "D^5",
        ColorScale::Spectra { flux: false } => "none",
    }
}

/// A light level: one number if the light is white.
pub fn level(level: &[f64; 3]) -> String {
    if level[0] == level[1] && level[1] == level[2] {
        number(level[0])
    } else {
        format!("({})", numbers(level))
    }
}

/// The lines about the colour of a sample: its numbers, and the wavelength at rest and as seen.
///
/// # Errors
/// Errors that `out` returns.
pub fn write_color(out: &mut String, color: &SampleColor) -> fmt::Result {
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

/// From the samples of a pixel to its bytes. `samples`: along a side of a pixel.
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

/// A face or wire, with its name and where it is in the text of the scene.
pub fn described(item: &ExplainedItem) -> String {
    let name = item.name.as_ref().map_or(String::new(), |name| format!(" `{name}`"));
    let place = item.place.as_ref().map_or(String::new(), |(file, line)| format!(", {file}:{line}"));
    format!("{}{name}, id {}{place}", item.kind, item.id)
}

/// Numbers with blanks between them.
pub fn numbers(all: &[f64]) -> String {
    all.iter().map(|&x| number(x)).collect::<Vec<_>>().join(" ")
}

/// Six significant digits.
pub fn number(x: f64) -> String {
    let rounded: f64 = format!("{x:.5e}").parse().unwrap_or(x);
    let size = rounded.abs();
    if size != 0.0 && !(1e-4..1e9).contains(&size) { format!("{rounded:e}") } else { format!("{rounded}") }
}
