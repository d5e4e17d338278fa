//! Explanations as text: a title of up to 13 characters at the left, then what it is.

use std::fmt::Display;

use serde::{Serialize, Serializer};
use ugscene::{ColorScale, SeenColors};

use super::{
    AssumedReflectance, ExplainedEvent, ExplainedItem, ExplainedSurface, Explanation,
    HueWavelength, SampleColor,
};

/// A sample, explained by one of the renderers.
pub trait WriteSample: Serialize + Sized {
    /// Writes what follows the heading about the sample.
    fn write(&self, out: &mut ExplanationText, explanation: &Explanation<Self>);
}

/// The text of an explanation.
#[derive(Clone, Debug, Default)]
pub struct ExplanationText(String);

impl<S: WriteSample> Explanation<S> {
    /// The explanation as text.
    pub fn text(&self) -> String {
        let Self { pixel: [x, y], size: [width, height], samples: [columns, rows], .. } = self;
        let mut out = ExplanationText::default();
        out.line(format!("pixel {x} {y} of {width} x {height}, {columns} x {rows} samples"));
        for cover in &self.covers {
            out.line(format!(
                "    {} of {}: {}",
                cover.samples,
                columns * rows,
                described(&cover.item)
            ));
        }
        if self.background_samples > 0 {
            out.line(format!("    {} of {}: background", self.background_samples, columns * rows));
        }
        if let Some(sample) = &self.sample {
            out.line(format!(
                "\nthe covered sample nearest to the centre, at {}",
                numbers(&sample.place)
            ));
            sample.own.write(&mut out, self);
        }
        self.write_steps(&mut out);
        out.0
    }

    /// From the samples of a pixel to its bytes.
    fn write_steps(&self, out: &mut ExplanationText) {
        let steps = &self.steps;
        let [columns, rows] = steps.filter_samples;
        let by = match steps.filter {
            "box" => String::new(),
            filter => format!(", of {columns} x {rows} samples by the filter {filter}"),
        };
        let [light, covered] = [numbers(&steps.mean_linear), number(steps.covered)];
        out.line("\nthe pixel");
        out.row("mean", format!("{light} linear, {covered} of it covered{by}"));
        if let Some(development) = &steps.development {
            let (stops, tone_curve) = (number(development.stops), development.tone_curve);
            let estimate = development
                .estimated_from
                .map_or_else(String::new, |count| format!(", estimated from {count} pixels"));
            let exposed = numbers(&development.exposed);
            out.row("exposure", format!("{stops} stops{estimate}: {exposed}"));
            out.row("tone curve", format!("{tone_curve}: {}", numbers(&development.toned)));
            out.row("gamut", numbers(&development.in_gamut));
        }
        let [red, green, blue, alpha] = steps.bytes;
        out.row("bytes", format!("{red} {green} {blue}, alpha {alpha}"));
    }
}

impl ExplanationText {
    /// A line without a title.
    pub fn line(&mut self, text: impl Display) {
        self.0 += &format!("{text}\n");
    }

    /// A line: a title, and a text.
    pub fn row(&mut self, title: &str, text: impl Display) {
        self.line(format!("{title:<14}{text}"));
    }

    /// A list: a row for each of the first `most` items, then how many more there are.
    pub fn rows<T>(&mut self, title: &str, items: &[T], most: usize, text: impl Fn(&T) -> String) {
        items.iter().take(most).for_each(|item| self.row(title, text(item)));
        if items.len() > most {
            self.row("", format!("and {} more", items.len() - most));
        }
    }

    /// A surface, the motion of its body, and the event of emission. `is_all_at_rest`: nothing in
    /// the scene moves.
    pub fn surface(&mut self, surface: &ExplainedSurface, is_all_at_rest: bool) {
        self.row(surface.item.kind, described(&surface.item));
        let body = match surface.beta {
            _ if is_all_at_rest => "everything is at rest".to_owned(),
            0.0 => "at rest".to_owned(),
            beta => format!(
                "velocity {}, beta {}, gamma {}",
                numbers(&surface.velocity),
                number(beta),
                number(surface.gamma)
            ),
        };
        self.row("body", body);
        if let Some(own_time) = surface.own_time {
            self.row("own time", number(own_time));
        }
        let event = |event: ExplainedEvent, frame: &str| {
            let t = event.t.map_or("none, as an effect was left out".to_owned(), number);
            format!("t {t}, x {} ({frame})", numbers(&event.x))
        };
        self.row(
            "emission",
            event(surface.emission, "camera frame, axes of the scene, from the eye"),
        );
        self.row("", event(surface.emission_at_rest, "rest frame"));
        if let Some((camera, rest)) = surface.angle_deg.zip(surface.angle_at_rest_deg) {
            let (camera, rest) = (number(camera), number(rest));
            let text = format!(
                "{camera}° from the motion in the camera frame, {rest}° in the rest frame (P6)"
            );
            self.row("seen at", text);
        }
    }

    /// The Doppler factor and the law of colours. `equation`: of the factor; `colors`: as they are
    /// seen, `None` at rest.
    pub fn doppler(&mut self, doppler: f64, equation: &str, colors: Option<&SeenColors>) {
        self.row("D", format!("{} ({equation})", number(doppler)));
        let Some(seen) = colors else {
            return self.row("colours", "at rest: neither shifted nor changed in brightness");
        };
        let shift = match (seen.doppler, seen.scale) {
            (false, _) => "wavelengths not shifted",
            (true, ColorScale::Hues { .. }) => "wavelengths divided by D (P11)",
            (true, ColorScale::Spectra { .. }) => "spectra shifted by D (P11)",
        };
        let (law, power) = match seen.scale {
            ColorScale::Hues { law, .. } => {
                (format!("by the law `{}`", law.name()), law.factor(doppler))
            }
            ColorScale::Spectra { flux: true, .. } => {
                ("D^5 per wavelength".to_owned(), libm::pow(doppler, 5.0))
            }
            ColorScale::Spectra { flux: false, .. } => ("by the law `none`".to_owned(), 1.0),
        };
        let lights = if seen.lights { "; the light of lamps is in them (P14)" } else { "" };
        let power = number(power);
        self.row(
            "colours",
            format!("as seen: {shift}, brightness {law}: times {power} (P12){lights}"),
        );
    }

    /// What is assumed of a surface of which only the colour is known.
    pub fn assumed(&mut self, assumed: Option<&AssumedReflectance>) {
        let Some(assumed) = assumed else { return };
        let off = match assumed.delta_e {
            Some(range) => {
                let [low, high] = range.map(|part| format!("{part:.1}"));
                format!("8 of 10 measured ones are off by dE*ab {low} to {high} at this D")
            }
            None => "none were measured for this D".to_owned(),
        };
        let class = assumed.class.unwrap_or("any");
        self.row("assumed", format!("reflectance of surfaces of {class} colour (P20): {off}"));
    }

    /// The colour of a sample: its numbers, and the wavelength at rest and as seen.
    pub fn color(&mut self, color: &SampleColor) {
        match color {
            SampleColor::Light { xyz, chromaticity, is_lit } => {
                let of = if *is_lit { "lit" } else { "emitted: no lamp lights it" };
                self.row("colour", format!("X Y Z {}, {of}", numbers(xyz)));
                if let Some(chromaticity) = chromaticity {
                    self.row("", format!("chromaticity x y {}", numbers(chromaticity)));
                }
            }
            SampleColor::Hue { hue, saturation, value, light_level, wavelength } => {
                let lit = light_level.map_or(", lit".to_owned(), |level| {
                    format!(", times red, green, blue light {}", numbers(&level))
                });
                let [hue, saturation, value] = [hue, saturation, value].map(|&x| number(x));
                let Some(wavelength) = wavelength else {
                    return self.row("colour", format!("grey, value {value}{lit}"));
                };
                self.row(
                    "colour",
                    format!("hue {hue}, saturation {saturation}, value {value}{lit}"),
                );
                self.wavelength(wavelength);
            }
        }
    }

    fn wavelength(&mut self, wavelength: &HueWavelength) {
        let end = if wavelength.is_at_end_of_range {
            ", the end of the range, or anything beyond"
        } else {
            ""
        };
        let [rest, seen] =
            [wavelength.rest_wavelength_nm, wavelength.seen_wavelength_nm].map(number);
        self.row("wavelength", format!("{rest} nm at rest, {seen} nm seen{end} (P16)"));
        self.row("attenuation", format!("hue times {} (P17)", number(wavelength.attenuation)));
    }
}

/// Serialises the brightness law of colours as seen by its name.
pub(super) fn law_name<S: Serializer>(
    colors: &Option<SeenColors>,
    out: S,
) -> Result<S::Ok, S::Error> {
    let name = colors.map(|seen| match seen.scale {
        ColorScale::Hues { law, .. } => law.name(),
        ColorScale::Spectra { flux: true, .. } => "D^5",
        ColorScale::Spectra { flux: false, .. } => "none",
    });
    name.serialize(out)
}

/// A light level: one number if the light is white.
pub fn level(level: &[f64; 3]) -> String {
    if level[0] == level[1] && level[1] == level[2] {
        number(level[0])
    } else {
        format!("({})", numbers(level))
    }
}

/// A face or wire, with its name and where it is in the text of the scene.
pub fn described(item: &ExplainedItem) -> String {
    let name = item.name.as_ref().map_or(String::new(), |name| format!(" `{name}`"));
    let place = item.file.as_ref().zip(item.line);
    let place = place.map_or(String::new(), |(file, line)| format!(", {file}:{line}"));
    format!("{}{name}, id {}{place}", item.kind, item.id)
}

/// Numbers with blanks between them.
pub fn numbers<T: Copy + Into<f64>>(all: &[T]) -> String {
    all.iter().map(|&x| number(x)).collect::<Vec<_>>().join(" ")
}

/// Six significant digits.
pub fn number(x: impl Into<f64>) -> String {
    let x: f64 = x.into();
    let rounded: f64 = format!("{x:.5e}").parse().unwrap_or(x);
    let size = rounded.abs();
    if size != 0.0 && !(1e-4..1e9).contains(&size) {
        format!("{rounded:e}")
    } else {
        format!("{rounded}")
    }
}
