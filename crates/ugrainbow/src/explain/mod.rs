//! Explains the colour of a pixel: from the face and its motion to the bytes.

mod json;
mod text;

use glam::DVec3;
use uglight::{Interpolation, Swatch};
use ugparse::{Diagnostics, Parsed, Source};
use ugphysics::{attenuation, doppler_at, linear_srgb_to_xyz, srgb_decode, srgb_encode, wavelength_to_hue};
use ugpicture::explain::nearest;
use ugpicture::{Canvas, Emissions, Filter, SurfaceSample};
use ugraster::{Fragment, PixelSamples, ProbedSample};
use ugscene::{Geometry, RestPosition, SeenPosition, Stage, VertexId};

use crate::config::Config;
use crate::depth_cue::prepare;
use crate::error::Error;
use crate::front::{of_fragment, of_surface};
use crate::packing::{Interpolated, PackedLayout, Plain};
use crate::pixels::{self, backdrop, mean};
use crate::render::warnings;
use crate::render_layers::RenderLayers;
use crate::setup::Setup;

pub use json::json;
pub use text::text;
pub use ugpicture::explain::{ExplainedItem, ExplainedPixel, PixelSteps, SampleColor, Wavelength};

/// The explanation of a pixel.
#[derive(Clone, Debug)]
pub struct Explanation {
    /// The facts common to all renderers.
    pub pixel: ExplainedPixel,
    /// The command lines that produced the scene, oldest first.
    pub history: Vec<String>,
    /// The stage of its positions and colours.
    pub stage: Stage,
    /// The covered sample nearest to the centre of the pixel.
    pub sample: Option<ExplainedSample>,
}

/// The explanation of a sample.
#[derive(Clone, Debug)]
pub struct ExplainedSample {
    /// Column and row of the sample in pixels.
    pub place: [f64; 2],
    /// The surface it shows.
    pub item: ExplainedItem,
    /// Velocity of its body.
    pub beta: DVec3,
    /// Lorentz factor γ of the body.
    pub gamma: f64,
    /// Time and position of emission, relative to the eye, in the frame of the camera.
    pub emission: (f64, DVec3),
    /// The own time of a body that is not inertial.
    pub own_time: Option<f64>,
    /// The emission event in the rest frame of the body and the axes of the scene; without a time
    /// if contraction or time of flight was left out.
    pub rest: (Option<f64>, DVec3),
    /// Angle in degrees between the line of sight and the motion, in the frames of the camera and
    /// of the body; `None` at rest.
    pub angles_deg: Option<[f64; 2]>,
    /// Doppler factor.
    pub doppler: f64,
    /// Its colour; `None` for a translucent surface, of which only the light is known.
    pub color: Option<SampleColor>,
    /// Corners of the face, or ends of the wire.
    pub corners: Vec<ExplainedCorner>,
    /// Its linear red, green and blue.
    pub light: [f32; 3],
    /// The part of its light that depth cueing leaves.
    pub cue: Option<f32>,
    /// All surfaces that the sample shows, from front to back; empty if it is a single opaque one.
    pub layers: Vec<LayerShown>,
}

/// One of the surfaces that a sample shows.
#[derive(Clone, Debug)]
pub struct LayerShown {
    /// The face or wire.
    pub item: ExplainedItem,
    /// The part of the light from behind that is transmitted.
    pub translucency: f32,
    /// Its own light, before weighting by 1 − translucency.
    pub light: [f32; 3],
}

/// A corner, between which colour and light are interpolated.
#[derive(Clone, Debug)]
pub struct ExplainedCorner {
    /// Name of the vertex.
    pub name: String,
    /// Hue in degrees, saturation, value; or linear red, green, blue if given as light.
    pub color: [f64; 3],
    /// True if the colour is given as light.
    pub is_light: bool,
    /// Level of red, green and blue light.
    pub level: [f64; 3],
    /// The contribution of each light; empty for wires and for faces with a light level of their
    /// own.
    pub lights: Vec<(String, [f64; 3])>,
}

/// Explains a pixel of the picture that `config` describes.
///
/// # Errors
/// As for drawing, and if the pixel is not in the picture.
pub fn explain(
    config: &Config,
    source: &Source,
    pixel: [u32; 2],
) -> Result<(Explanation, Diagnostics), Error> {
    let parsed = ugparse::read(source, &config.reading, config.picture.camera.name.as_deref())?;
    if config.exact.is_some() {
        return Err(Error::ExplainExact);
    }
    let canvas = Canvas::new(&config.picture)?;
    canvas.check_pixel(pixel)?;
    let config = &Config { picture: canvas.options().clone(), ..config.clone() };
    let picture = &config.picture;
    let setup = prepare(&parsed.scene, config)?;
    let layers = RenderLayers::new(setup.painter(), &config.draw_mode());
    let backdrop = backdrop(picture);
    let light = |all: &PixelSamples<'_>| mean(&backdrop, all);
    let (samples, _, own) = layers.probe(&setup.grid, &setup.shader, &light, pixel);
    let mean = match picture.filter {
        Filter::Box => own,
        filter => layers.probe_filtered(&setup.grid, filter, &setup.shader, &light, pixel),
    };
    let whole = || pixels::light(&setup, &layers, config).0;
    let teller = Teller { setup: &setup, config, source, parsed: &parsed };
    let explanation = Explanation {
        pixel: ExplainedPixel {
            place: pixel,
            size: picture.size,
            samples: picture.samples,
            covers: teller.covers(&samples),
            n_free: (picture.samples * picture.samples) as usize
                - samples.iter().filter(|sample| !is_free(sample)).count(),
            is_at_rest: !ugscene::has_moving_bodies(setup.scene())
                && !ugscene::has_moving_lights(setup.scene()),
            steps: PixelSteps::new(picture, mean, !setup.is_uncut, whole),
        },
        sample: nearest(&samples, |sample| sample.place, pixel, picture.samples)
            .map(|sample| teller.shown(sample)),
        history: parsed.scene.remarks.history().into_iter().map(str::to_owned).collect(),
        stage: parsed.scene.stage,
    };
    Ok((explanation, warnings(source, parsed)))
}

/// One of the surfaces that a sample shows.
struct Layer {
    tag: u32,
    pass: f32,
    light: [f32; 3],
}

/// All surfaces that a sample shows, from front to back.
fn stack(sample: &ProbedSample) -> Vec<Layer> {
    let layers = sample.fragments.iter().rev();
    let mut stack: Vec<Layer> = layers
        .map(|layer| Layer { tag: layer.item, pass: layer.transmittance, light: layer.light })
        .chain(sample.opaque.iter().map(|surface| Layer {
            tag: surface.hit.item,
            pass: 0.0,
            light: surface.shaded.light,
        }))
        .collect();
    if let Some(last) = stack.iter().position(|layer| layer.pass == 0.0) {
        stack.truncate(last + 1);
    }
    stack
}

/// True if the background is visible at a sample.
fn is_free(sample: &ProbedSample) -> bool {
    stack(sample).iter().all(|layer| layer.pass > 0.0)
}

/// Computes the explanations of samples.
struct Teller<'a> {
    setup: &'a Setup<'a>,
    config: &'a Config,
    source: &'a Source,
    parsed: &'a Parsed,
}

impl Teller<'_> {
    fn covers(&self, samples: &[ProbedSample]) -> Vec<(ExplainedItem, usize)> {
        let mut counts: Vec<(u32, usize)> = Vec::new();
        for sample in samples {
            // Each face is counted once, even if its edges are in the sample as well.
            let mut tags: Vec<u32> = stack(sample).iter().map(|layer| layer.tag).collect();
            tags.sort_unstable();
            tags.dedup();
            for tag in tags {
                match counts.iter_mut().find(|(item, _)| *item == tag) {
                    Some((_, count)) => *count += 1,
                    None => counts.push((tag, 1)),
                }
            }
        }
        counts.into_iter().map(|(item, count)| (self.item(item), count)).collect()
    }

    fn item(&self, item: u32) -> ExplainedItem {
        ExplainedItem::new(item, self.setup.scene(), self.parsed, self.source)
    }

    fn shown(&self, sample: &ProbedSample) -> ExplainedSample {
        let painter = self.setup.painter();
        let (seen, values, light) = self.subject(sample);
        let emissions = Emissions::new(painter.scene, painter.view, painter.appearance.surface.frames());
        let emission = emissions.at(sample.place, seen);
        let (place, velocity) = (emission.place, emission.velocity);
        let geometry = Geometry::of(self.setup.scene());
        let RestPosition(rest) = geometry.rest(SeenPosition(place), velocity);
        let rest_time = (geometry == Geometry::default()).then(|| -rest.length());
        let angle = |line: DVec3| line.angle_between(velocity.direction()).to_degrees();
        let doppler = doppler_at(place, velocity);
        let n = f64::from(self.config.picture.samples);
        ExplainedSample {
            place: sample.place.map(|sample| (f64::from(sample) + 0.5) / n),
            item: self.item(seen.item),
            beta: velocity.beta(),
            gamma: velocity.gamma(),
            own_time: emission.own_time,
            emission: (emission.time, place),
            rest: (rest_time, emission.scene_from_axes * rest),
            angles_deg: (!velocity.is_zero()).then(|| [angle(place), angle(rest)]),
            doppler,
            color: values.map(|values| self.color(values, doppler)),
            corners: self.corners(seen.item),
            light,
            cue: self.setup.grid.fade.map(|_| self.setup.grid.light_left(seen.key)),
            layers: self.layers(sample),
        }
    }

    /// The surface to explain: the nearest that transmits less than half of the light, as for
    /// channels, else the nearest. With its interpolated values, if they are known, and its light.
    fn subject<'s>(&self, sample: &'s ProbedSample) -> (SurfaceSample, Option<&'s [f32]>, [f32; 3]) {
        let layer = |layer: &Fragment| (of_fragment(&self.setup.view, layer), None, layer.light);
        let mut layers = sample.fragments.iter().rev();
        let surface = sample
            .opaque
            .as_ref()
            .map(|surface| (of_surface(surface.hit), Some(&surface.values[..]), surface.shaded.light));
        layers
            .clone()
            .find(|layer| layer.transmittance < 0.5)
            .map(layer)
            .or(surface)
            .unwrap_or_else(|| layers.next().map(layer).expect("a sample shows something"))
    }

    fn layers(&self, sample: &ProbedSample) -> Vec<LayerShown> {
        let stack = stack(sample);
        if stack.len() < 2 && stack.iter().all(|layer| layer.pass == 0.0) {
            return Vec::new();
        }
        let shown = |layer: Layer| LayerShown {
            item: self.item(layer.tag),
            translucency: layer.pass,
            light: layer.light,
        };
        stack.into_iter().map(shown).collect()
    }

    /// The colour that interpolated values stand for.
    fn color(&self, values: &[f32], doppler: f64) -> SampleColor {
        let layout = PackedLayout::new(&self.setup.appearance, &self.setup.lighting);
        let (Plain { tint, saturation, value }, level) = match layout.color(values) {
            Interpolated::Light(light) => {
                let xyz = linear_srgb_to_xyz(light);
                let sum: f64 = xyz.iter().sum();
                let chromaticity = (sum > 0.0).then(|| [xyz[0] / sum, xyz[1] / sum]);
                return SampleColor::Light { xyz, chromaticity };
            }
            Interpolated::Hue { color, level } => (color, level),
        };
        let swatch = Swatch { tint, saturation, value, ..Swatch::WHITE };
        let interpolation = self.setup.appearance.palette.interpolation();
        let hue = match interpolation {
            Interpolation::Hue => tint,
            Interpolation::Wavelength => wavelength_to_hue(tint),
        };
        let is_shifted = self.setup.scene().stage.seen_colors().is_some_and(|seen| seen.doppler);
        let wavelength = (!swatch.is_grey()).then(|| {
            let seen_nm = self.setup.appearance.palette.wavelength_nm(&swatch);
            Wavelength {
                rest_nm: if is_shifted { seen_nm * doppler } else { seen_nm },
                seen_nm,
                attenuation: attenuation(seen_nm),
                is_at_end: interpolation == Interpolation::Hue && !(-60.0 < hue && hue < 300.0),
            }
        });
        SampleColor::Hue { hue, saturation, value, level, wavelength }
    }

    fn corners(&self, item: u32) -> Vec<ExplainedCorner> {
        let painter = self.setup.painter();
        let scene = painter.scene;
        let vertices = |rows: &std::ops::Range<u32>| scene.contours.corners(rows.clone()).to_vec();
        if let Some(face) = scene.faces.get(item as usize) {
            let normal = painter.seen_normal(face);
            let common = painter.common(face);
            let corner = |vertex: VertexId| {
                let swatch = painter.swatch(vertex, &common);
                let level = painter.level(face, vertex, normal, common.is_light);
                let lights = if scene.light_level(face).is_some() {
                    Vec::new()
                } else {
                    let [point, normal, shift] = painter.lit_point(face, vertex, normal);
                    painter.lighting.parts(scene, point, normal, shift, common.is_light)
                };
                self.corner(vertex, &swatch, level, lights)
            };
            return vertices(&face.contours).into_iter().map(corner).collect();
        }
        let Some(wire) = scene.wires.get(item as usize - scene.faces.len()) else { return Vec::new() };
        let color = painter.wire_swatch(wire);
        let is_display = painter.is_display_wire(wire, &color);
        let end = |vertex| {
            let end = painter.wire_end(vertex, &color);
            // A single colour of a display is drawn as a hue.
            let light = end.light.filter(|_| !end.is_display || is_display);
            self.corner(vertex, &Swatch { light, ..end }, DVec3::ONE, Vec::new())
        };
        vertices(&wire.contours).into_iter().map(end).collect()
    }

    fn corner(
        &self,
        vertex: VertexId,
        swatch: &Swatch,
        level: DVec3,
        lights: Vec<(String, DVec3)>,
    ) -> ExplainedCorner {
        let scene = self.setup.scene();
        let hsv = self.setup.appearance.palette.hsv(swatch);
        // As a display shows its linear light.
        let value = match swatch.factor {
            1.0 => hsv.value,
            factor => srgb_encode(factor * srgb_decode(hsv.value)),
        };
        ExplainedCorner {
            name: scene.names.get(scene.vertices[vertex.index()].name).to_owned(),
            color: swatch.light.map_or([hsv.hue, hsv.saturation, value], |light| light.to_array()),
            is_light: swatch.light.is_some(),
            level: level.to_array(),
            lights: lights.into_iter().map(|(name, level)| (name, level.to_array())).collect(),
        }
    }
}
