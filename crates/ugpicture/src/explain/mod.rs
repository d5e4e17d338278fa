//! Explanations of pixels: what they have in common in every renderer.
//!
//! One set of structs holds what is explained: [`Explanation::json`] serialises it for scripts,
//! [`Explanation::text`] words it for people.

pub mod text;

use serde::Serialize;
use ugimage::{Filter, LinearFrame, Quantizer, display_pixel};
use uglight::Interpolation;
use ugparse::{Diagnostic, Diagnostics, Parsed, Source};
use ugphysics::spectrum::ColorClass;
use ugphysics::{Hsv, attenuation, linear_srgb_to_xyz};
use ugscene::{
    ColorId, ColorScale, Scene, SeenColors, VertexId, has_moving_bodies, has_moving_lights,
};

use crate::{Backdrop, Background, PictureOptions};

pub use text::WriteSample;

/// The explanation of a pixel. `S`: what a renderer tells of a sample.
#[derive(Clone, Debug, Serialize)]
pub struct Explanation<S> {
    /// Column and row from the upper left.
    pub pixel: [u32; 2],
    /// Size of the picture.
    pub size: [u32; 2],
    /// Columns and rows of samples in a pixel.
    pub samples: [u32; 2],
    /// The surfaces that its samples show, in order of first occurrence. A sample of a translucent
    /// surface also counts for the surfaces behind it.
    pub covers: Vec<Cover>,
    /// Number of samples in which the background is visible, also through translucent surfaces and
    /// in mirrors.
    pub background_samples: usize,
    /// True if nothing in the scene moves.
    pub is_at_rest: bool,
    /// The command lines that produced the scene, oldest first.
    pub history: Vec<String>,
    /// How motion changes colours; `None` if it does not.
    #[serde(rename = "brightness_law", serialize_with = "text::law_name")]
    pub colors: Option<SeenColors>,
    /// The covered sample nearest to the centre of the pixel.
    pub sample: Option<ExplainedSample<S>>,
    /// From the samples to the bytes.
    #[serde(flatten)]
    pub steps: PixelSteps,
}

/// The explanation of a sample.
#[derive(Clone, Debug, Serialize)]
pub struct ExplainedSample<S> {
    /// Column and row of the sample in pixels.
    pub place: [f64; 2],
    /// What the renderer tells of it.
    #[serde(flatten)]
    pub own: S,
}

/// A surface that samples of a pixel show.
#[derive(Clone, Debug, Serialize)]
pub struct Cover {
    /// The surface.
    pub item: ExplainedItem,
    /// Number of samples.
    pub samples: usize,
}

/// A face or wire.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ExplainedItem {
    /// `face` or `wire`.
    pub kind: &'static str,
    /// As in the channel `id`: faces from 1, then wires.
    pub id: u32,
    /// Its name, if it has one.
    pub name: Option<String>,
    /// File of its statement, where known.
    pub file: Option<String>,
    /// Line of its statement, where known.
    pub line: Option<usize>,
}

/// A surface as it is seen.
#[derive(Clone, Debug, Serialize)]
pub struct ExplainedSurface {
    /// Its face or wire.
    pub item: ExplainedItem,
    /// Velocity of its body.
    pub velocity: [f64; 3],
    /// Speed of the body.
    pub beta: f64,
    /// Lorentz factor γ of the body.
    pub gamma: f64,
    /// The own time of a body that is not inertial.
    pub own_time: Option<f64>,
    /// Time and position of emission, relative to the eye, in the frame of the camera and the axes
    /// of the scene, which boosts do not turn.
    pub emission: ExplainedEvent,
    /// The emission event in the rest frame of the body and the axes of the scene.
    pub emission_at_rest: ExplainedEvent,
    /// Angle in degrees between the line of sight and the motion, in the frame of the camera;
    /// `None` at rest and for light that is mirrored or refracted.
    pub angle_deg: Option<f64>,
    /// That angle in the rest frame of the body.
    pub angle_at_rest_deg: Option<f64>,
    /// Doppler factor, from the surface to the eye.
    #[serde(rename = "D")]
    pub doppler: f64,
    /// What is assumed of its reflectance; `None` if nothing is, or if nothing depends on it.
    pub assumed: Option<AssumedReflectance>,
    /// Its lit colour; `None` for a translucent surface of which only the light is known.
    pub color: Option<SampleColor>,
    /// Its own light: linear red, green and blue.
    pub linear: [f64; 3],
}

/// How far the colour of a surface in motion depends on the reflectance that is assumed for its
/// colour at rest, (P20).
#[derive(Clone, Copy, Debug, Serialize)]
pub struct AssumedReflectance {
    /// Its class of colours; `None` if textures or vertices have colours of their own.
    pub class: Option<&'static str>,
    /// The ΔE*ab below which 10 % and 90 % of measured surfaces of this class are; `None` if none
    /// were measured for this Doppler factor.
    pub delta_e: Option<[f64; 2]>,
}

/// An event.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct ExplainedEvent {
    /// Time; `None` if contraction or time of flight was left out.
    pub t: Option<f64>,
    /// Position.
    pub x: [f64; 3],
}

/// The colour of a sample, interpolated and lit.
#[derive(Clone, Debug, Serialize)]
#[serde(untagged)]
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
        light_level: Option<[f64; 3]>,
        /// `None` for greys.
        #[serde(flatten)]
        wavelength: Option<HueWavelength>,
    },
    /// CIE X, Y, Z, and chromaticity x, y.
    Light {
        /// X, Y, Z.
        xyz: [f64; 3],
        /// x, y; `None` for black.
        chromaticity: Option<[f64; 2]>,
        /// False if no light of lamps is in it: of black bodies, sampled spectra and faces with a
        /// light level of their own.
        is_lit: bool,
    },
}

/// The wavelength a hue stands for.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct HueWavelength {
    /// Wavelength at rest.
    pub rest_wavelength_nm: f64,
    /// Wavelength as seen.
    pub seen_wavelength_nm: f64,
    /// True at the end of the range of hues, which stands for all wavelengths beyond.
    pub is_at_end_of_range: bool,
    /// Attenuation of the hue, (P17).
    pub attenuation: f64,
}

/// From the samples of the pixel to its bytes.
#[derive(Clone, Debug, Serialize)]
pub struct PixelSteps {
    /// Name of the filter that weights samples, including those of neighbouring pixels.
    pub filter: &'static str,
    /// Columns and rows of samples that have a weight.
    pub filter_samples: [usize; 2],
    /// Mean linear red, green and blue.
    pub mean_linear: [f32; 3],
    /// The covered part.
    pub covered: f32,
    /// How light was developed, if it was not clipped per sample.
    pub development: Option<DevelopedPixel>,
    /// Red, green, blue, alpha.
    pub bytes: [u8; 4],
}

/// The steps of the development of a pixel.
#[derive(Clone, Debug, Serialize)]
pub struct DevelopedPixel {
    /// Exposure in stops.
    pub stops: f64,
    /// An automatic exposure is estimated from so many pixels; `None` if it is exact.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub estimated_from: Option<usize>,
    /// Name of the tone curve.
    pub tone_curve: &'static str,
    /// Linear red, green and blue after the exposure.
    pub exposed: [f64; 3],
    /// After the tone curve.
    pub toned: [f64; 3],
    /// After gamut mapping: each channel 0…1.
    pub in_gamut: [f64; 3],
}

/// Explains the pixels of a picture.
pub struct Explainer<'a> {
    /// The scene as it is drawn; its faces and wires are those of `parsed`.
    pub scene: &'a Scene,
    /// What was parsed from `source`.
    pub parsed: &'a Parsed,
    /// The text of the scene.
    pub source: &'a Source,
    /// How it is drawn.
    pub picture: &'a PictureOptions,
    /// How motion changes colours; `None` if it does not.
    pub colors: Option<SeenColors>,
}

/// What a sample shows.
pub struct SampleContent {
    /// Its column and row among the samples of the whole picture.
    pub place: [u32; 2],
    /// The rows of its surfaces, wires counted after the faces.
    pub rows: Vec<u32>,
    /// True if the background is visible.
    pub is_free: bool,
}

impl Explainer<'_> {
    /// The explanation of a pixel. `samples`: those that show anything, with what a renderer needs
    /// to explain them; `own`: explains one.
    pub fn explain<T, S: WriteSample>(
        &self,
        pixel: [u32; 2],
        samples: &[(SampleContent, T)],
        own: impl FnOnce(&T) -> S,
        steps: PixelSteps,
    ) -> Explanation<S> {
        let n = self.picture.samples;
        let mut covers: Vec<(u32, Cover)> = Vec::new();
        for &row in samples.iter().flat_map(|(content, _)| &content.rows) {
            match covers.iter_mut().find(|(shown, _)| *shown == row) {
                Some((_, cover)) => cover.samples += 1,
                None => covers.push((row, Cover { item: self.item(row), samples: 1 })),
            }
        }
        let away = |(content, _): &&(SampleContent, T)| {
            // Twice the distance, which is an integer.
            let axis = |i: usize| 2 * i64::from(content.place[i] - pixel[i] * n) + 1 - i64::from(n);
            axis(0) * axis(0) + axis(1) * axis(1)
        };
        // Of several equally near the last, as for channels.
        let covered = samples.iter().rev().filter(|(content, _)| !content.rows.is_empty());
        Explanation {
            pixel,
            size: self.picture.size,
            samples: [n; 2],
            covers: covers.into_iter().map(|(_, cover)| cover).collect(),
            background_samples: (n * n) as usize
                - samples.iter().filter(|(content, _)| !content.is_free).count(),
            is_at_rest: !has_moving_bodies(self.scene) && !has_moving_lights(self.scene),
            history: self.parsed.scene.head.history().into_iter().map(str::to_owned).collect(),
            colors: self.colors,
            sample: covered.min_by_key(away).map(|(content, sample)| ExplainedSample {
                place: content.place.map(|at| (f64::from(at) + 0.5) / f64::from(n)),
                own: own(sample),
            }),
            steps,
        }
    }

    /// What is assumed of the reflectance of a face or wire, seen with a Doppler factor. `row`: as
    /// for [`Explainer::item`].
    pub fn assumed(&self, row: u32, doppler: f64) -> Option<AssumedReflectance> {
        let Self { scene, .. } = self;
        let is_shifted = self
            .colors
            .is_some_and(|seen| seen.doppler && matches!(seen.scale, ColorScale::Spectra { .. }));
        let item = scene.drawn().nth(row as usize)?;
        if !is_shifted || doppler == 1.0 {
            return None;
        }
        // Colours of vertices as seen do not tell those at rest.
        let has_own = |vertex: &VertexId| scene.vertices[vertex.index()].color.is_some();
        let is_mixed = scene.stage.seen_colors().is_none()
            && scene.contours.corners(item.contours).iter().any(has_own);
        let is_plain = |color: &ColorId| scene.texture_of(*color).is_none() && !is_mixed;
        let Some(color) = item.color.filter(is_plain) else {
            let ranges = ColorClass::ALL.map(|class| class.difference(doppler));
            let widest = |a: Option<[f64; 2]>, b: Option<[f64; 2]>| {
                a.zip(b).map(|(a, b)| [a[0].min(b[0]), a[1].max(b[1])])
            };
            let delta_e = ranges.into_iter().reduce(widest).flatten();
            return Some(AssumedReflectance { class: None, delta_e });
        };
        let (spectrum, _) = uglight::spectrum(scene, &scene.colors[color.index()]);
        let class = ColorClass::of(&spectrum)?;
        Some(AssumedReflectance { class: Some(class.name()), delta_e: class.difference(doppler) })
    }

    /// The name of a face or wire, and its place in the text. `row`: of a face, or of a wire plus
    /// the number of faces.
    pub fn item(&self, row: u32) -> ExplainedItem {
        let Self { scene, parsed, source, .. } = self;
        let id = row.saturating_add(1);
        let row = row as usize;
        let name =
            |name: Option<ugscene::NameId>| name.map(|name| scene.names.get(name).to_owned());
        let Some(face) = scene.faces.get(row) else {
            let wire = scene.wires.get(row - scene.faces.len());
            let name = name(wire.and_then(|wire| wire.name));
            return ExplainedItem { kind: "wire", id, name, file: None, line: None };
        };
        let place = parsed.origins.face(face).and_then(|span| {
            Diagnostics::one(source, Diagnostic::error(span, "")).locations().into_iter().next()
        });
        let (file, line) = place.map(|place| (place.file, place.line)).unzip();
        ExplainedItem { kind: "face", id, name: name(face.name), file, line }
    }
}

impl<S: WriteSample> Explanation<S> {
    /// The explanation as JSON, ending with a line break.
    pub fn json(&self) -> String {
        serde_json::to_string_pretty(self).expect("all keys are strings") + "\n"
    }
}

/// Most pixels from which an explanation estimates an automatic exposure; of a picture that has no
/// more it is exact.
const MOST_PIXELS: u32 = 1 << 12;

/// Columns and rows from one pixel to the next from which the automatic exposure of a picture of
/// this size is estimated.
pub fn sparse_step([width, height]: [u32; 2]) -> u32 {
    let n_pixels =
        |step: &u32| u64::from(width.div_ceil(*step)) * u64::from(height.div_ceil(*step));
    (1..).find(|step| n_pixels(step) <= u64::from(MOST_PIXELS)).unwrap_or(u32::MAX)
}

impl PixelSteps {
    /// The steps of a pixel whose samples have this mean. `is_clipped`: they were clipped one by
    /// one, and are not developed; `sparse`: light of the picture, for automatic exposure; of all
    /// pixels or, as [`sparse_step`] says, of some.
    pub fn new(
        picture: &PictureOptions,
        mean: [f32; 4],
        is_clipped: bool,
        sparse: impl FnOnce() -> LinearFrame,
    ) -> Self {
        let [red, green, blue, covered] = mean;
        let mean_linear = [red, green, blue];
        let mut estimated_from = None;
        let sparse = || {
            let frame = sparse();
            let [width, height] = picture.size.map(|side| side as usize);
            let n_pixels = frame.pixels().len();
            estimated_from = (n_pixels < width * height).then_some(n_pixels);
            frame
        };
        let development = (!is_clipped).then(|| picture.development(sparse));
        let backdrop = Backdrop::new(picture.background, 1);
        let [red, green, blue] =
            development.map_or(mean_linear, |development| backdrop.converter(development)(mean));
        let is_opaque = picture.background != Background::Transparent;
        let bytes = display_pixel(&Quantizer::new(), [red, green, blue, covered], is_opaque);
        let development = development.map(|development| {
            let steps = development.steps(mean_linear);
            DevelopedPixel {
                stops: development.stops,
                estimated_from,
                tone_curve: development.tone.name(),
                exposed: steps.exposed,
                toned: steps.toned,
                in_gamut: steps.shown,
            }
        });
        let n = match picture.filter {
            Filter::Box => picture.samples as usize,
            filter => filter.n_samples(picture.samples),
        };
        Self {
            filter: picture.filter.name(),
            filter_samples: [n; 2],
            mean_linear,
            covered,
            development,
            bytes,
        }
    }
}

impl SampleColor {
    /// The colour of linear red, green and blue light.
    pub fn of_light(light: [f64; 3], is_lit: bool) -> Self {
        let xyz = linear_srgb_to_xyz(light);
        let sum: f64 = xyz.iter().sum();
        let chromaticity = (sum > 0.0).then(|| [xyz[0] / sum, xyz[1] / sum]);
        Self::Light { xyz, chromaticity, is_lit }
    }

    /// A hue, and its wavelengths at rest and as seen in nm, which were given unless hues are
    /// interpolated.
    pub fn of_hue(
        color: Hsv,
        interpolation: Interpolation,
        [rest_nm, seen_nm]: [f64; 2],
        light_level: Option<[f64; 3]>,
    ) -> Self {
        let Hsv { hue, saturation, value } = color;
        let is_end = interpolation == Interpolation::Hue && !(-60.0 < hue && hue < 300.0);
        let wavelength = (saturation != 0.0).then(|| HueWavelength {
            rest_wavelength_nm: rest_nm,
            seen_wavelength_nm: seen_nm,
            is_at_end_of_range: is_end,
            attenuation: attenuation(seen_nm),
        });
        Self::Hue { hue, saturation, value, light_level, wavelength }
    }
}
