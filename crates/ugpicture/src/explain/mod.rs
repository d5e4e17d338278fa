//! Explanations of pixels: what they have in common in every renderer.
//!
//! The types hold what is explained; [`text`] and [`json`] write it, for people and for scripts.

pub mod json;
pub mod text;

use ugimage::{Development, DevelopmentSteps, Filter, LinearFrame, Quantizer, display_pixel};
use ugparse::{Diagnostic, Diagnostics, Parsed, Source};
use ugscene::Scene;

use crate::{Background, PictureOptions};

/// The part of a pixel's explanation that all renderers share.
#[derive(Clone, Debug)]
pub struct ExplainedPixel {
    /// Column and row from the upper left.
    pub place: [u32; 2],
    /// Size of the picture.
    pub size: [u32; 2],
    /// Samples along a side of a pixel.
    pub samples: u32,
    /// The surfaces that its samples show, each with its number of samples, in order of first
    /// occurrence. A sample of a translucent surface also counts for the surfaces behind it.
    pub covers: Vec<(ExplainedItem, usize)>,
    /// Number of samples in which the background is visible, also through translucent surfaces and
    /// in mirrors.
    pub n_free: usize,
    /// True if nothing in the scene moves.
    pub is_at_rest: bool,
    /// From the samples to the bytes.
    pub steps: PixelSteps,
}

/// A face or wire.
#[derive(Clone, Debug, PartialEq)]
pub struct ExplainedItem {
    /// `face` or `wire`.
    pub kind: &'static str,
    /// As in the channel `id`: faces from 1, then wires.
    pub id: u32,
    /// Its name, if it has one.
    pub name: Option<String>,
    /// File and line of its statement, where known.
    pub place: Option<(String, usize)>,
}

/// The colour of a sample, interpolated and lit.
#[derive(Clone, Debug)]
pub enum SampleColor {
    /// A hue, saturation and value; coloured light is separate.
    Hue {
        /// Hue in degrees, −60…300.
        hue: f64,
        /// Saturation, 0…1.
        saturation: f64,
        /// Value, 0 and more.
        value: f64,
        /// Level of red, green and blue light, if lights are coloured; otherwise it is in the
        /// value.
        level: Option<[f64; 3]>,
        /// `None` for greys.
        wavelength: Option<Wavelength>,
    },
    /// CIE X, Y, Z, and chromaticity x, y.
    Light {
        /// X, Y, Z.
        xyz: [f64; 3],
        /// x, y; `None` for black.
        chromaticity: Option<[f64; 2]>,
    },
}

/// The wavelength a hue stands for.
#[derive(Clone, Copy, Debug)]
pub struct Wavelength {
    /// Wavelength at rest.
    pub rest_nm: f64,
    /// Wavelength as seen.
    pub seen_nm: f64,
    /// Attenuation of the hue, (P17).
    pub attenuation: f64,
    /// True at the end of the range of hues, which stands for all wavelengths beyond.
    pub is_at_end: bool,
}

/// From the samples of the pixel to its bytes.
#[derive(Clone, Debug)]
pub struct PixelSteps {
    /// The filter that weights samples, including those of neighbouring pixels.
    pub filter: Filter,
    /// Mean linear red, green and blue, and the covered part.
    pub mean: [f32; 4],
    /// How light was developed, if it was not clipped per sample.
    pub development: Option<(Development, DevelopmentSteps)>,
    /// Red, green, blue, alpha.
    pub bytes: [u8; 4],
}

impl PixelSteps {
    /// The steps of a pixel whose samples have this mean. `is_clipped`: they were clipped one by
    /// one, and are not developed; `whole`: the light of the picture, for automatic exposure.
    pub fn new(
        picture: &PictureOptions,
        mean: [f32; 4],
        is_clipped: bool,
        whole: impl FnOnce() -> LinearFrame,
    ) -> Self {
        let [red, green, blue, part] = mean;
        let light = [red, green, blue];
        let development = (!is_clipped).then(|| picture.development(whole));
        let [red, green, blue] = development.map_or(light, |development| development.apply(light));
        let is_opaque = picture.background != Background::Transparent;
        let bytes = display_pixel(&Quantizer::new(), [red, green, blue, part], is_opaque);
        let development = development.map(|development| (development, development.steps(light)));
        Self { filter: picture.filter, mean, development, bytes }
    }
}

/// The sample nearest to the centre of a pixel; of several the last, as for channels. `place`:
/// column and row of a sample, `n_samples` to a pixel.
pub fn nearest<S>(
    samples: &[S],
    place: impl Fn(&S) -> [u32; 2],
    pixel: [u32; 2],
    n_samples: u32,
) -> Option<&S> {
    let away = |sample: &&S| {
        let place = place(sample);
        // Twice the distance, which is an integer.
        let axis = |i: usize| 2 * i64::from(place[i] - pixel[i] * n_samples) + 1 - i64::from(n_samples);
        axis(0) * axis(0) + axis(1) * axis(1)
    };
    samples.iter().rev().min_by_key(away)
}

impl ExplainedItem {
    /// A face, or a wire counted after the faces. `scene`: with the faces and wires that were
    /// parsed from `source`.
    pub fn new(row: u32, scene: &Scene, parsed: &Parsed, source: &Source) -> Self {
        let id = row.saturating_add(1);
        let row = row as usize;
        let name = |name: Option<ugscene::NameId>| name.map(|name| scene.names.get(name).to_owned());
        let Some(face) = scene.faces.get(row) else {
            let wire = scene.wires.get(row - scene.faces.len());
            return Self { kind: "wire", id, name: name(wire.and_then(|wire| wire.name)), place: None };
        };
        let place = parsed.origins.faces.get(row).and_then(|span| {
            let place =
                Diagnostics::one(source, Diagnostic::error(*span, "")).locations().into_iter().next()?;
            Some((place.file, place.line))
        });
        Self { kind: "face", id, name: name(face.name), place }
    }
}
