//! Explains the colour of a pixel: from the face and its motion to the bytes.

mod text;

use glam::DVec3;
use serde::Serialize;
use uglight::Swatch;
use ugparse::{Diagnostics, Source};
use ugphysics::{doppler_at, srgb_decode, srgb_encode};
use ugpicture::explain::{
    ExplainedEvent, ExplainedItem, ExplainedSurface, Explainer, Explanation, PixelSteps,
    SampleColor, SampleContent,
};
use ugpicture::{Canvas, Emissions, Filter, SurfaceSample};
use ugraster::{Fragment, PixelSamples, ProbedSample};
use ugscene::{ColorScale, RestPosition, SeenPosition, ShownEffects, VertexId};
use ugskybox::SkyError;

use crate::center_surface::{of_fragment, of_surface};
use crate::config::Config;
use crate::depth_cue::prepare;
use crate::drawlist::FaceLook;
use crate::error::Error;
use crate::packing::Layout;
use crate::pixels::{self, backdrop, mean};
use crate::render::warnings;
use crate::render_layers::{RenderLayers, with_rasterizer};
use crate::setup::Setup;

/// What is told of a sample.
#[derive(Clone, Debug, Serialize)]
pub struct RasterSample {
    /// The surface it shows.
    #[serde(flatten)]
    pub surface: ExplainedSurface,
    /// Corners of the face, or ends of the wire.
    pub corners: Vec<ExplainedCorner>,
    /// The part of its light that depth cueing leaves.
    pub depth_cue: Option<f32>,
    /// All surfaces that the sample shows, from front to back; empty if it is a single opaque one.
    pub layers: Vec<LayerShown>,
}

/// One of the surfaces that a sample shows.
#[derive(Clone, Debug, Serialize)]
pub struct LayerShown {
    /// The face or wire.
    pub item: ExplainedItem,
    /// The part of the light from behind that is transmitted.
    pub translucency: f32,
    /// Its own light, before weighting by 1 − translucency: linear red, green and blue.
    pub linear: [f32; 3],
}

/// A corner, between which colour and light are interpolated.
#[derive(Clone, Debug, Serialize)]
pub struct ExplainedCorner {
    /// Name of the vertex.
    pub vertex: String,
    /// Hue in degrees, saturation, value; `None` for a colour given as light.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hue_saturation_value: Option<[f64; 3]>,
    /// Linear red, green and blue of a colour given as light.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub linear: Option<[f64; 3]>,
    /// Level of red, green and blue light.
    pub light_level: [f64; 3],
    /// The contribution of each light; empty for wires and for faces with a light level of their
    /// own.
    pub lights: Vec<LightPart>,
}

/// The contribution of a light to a corner.
#[derive(Clone, Debug, Serialize)]
pub struct LightPart {
    /// Name of the light, see [`uglight::light_names`].
    pub light: String,
    /// Level of its red, green and blue light.
    pub level: [f64; 3],
}

/// Explains a pixel of the picture that `config` describes.
///
/// # Errors
/// As for drawing, and if the pixel is not in the picture.
pub fn explain(
    config: &Config,
    source: &Source,
    pixel: [u32; 2],
) -> Result<(Explanation<RasterSample>, Diagnostics), Error> {
    let parsed = ugparse::read(source, &config.reading, config.picture.camera.name.as_deref())?;
    if config.with_textures(&parsed.scene).exact.is_some() {
        return Err(Error::ExplainExact);
    }
    if config.sky.is_some() || parsed.scene.sky.is_some() {
        return Err(SkyError::Explained.into());
    }
    let canvas = Canvas::new(&config.picture)?;
    let pixel = canvas.pixel_of_scene(pixel)?;
    let config = &Config { picture: canvas.options().clone(), ..config.clone() };
    let picture = &config.picture;
    let setup = prepare(&parsed.scene, config).map_err(|error| error.at_rounds(source, &parsed))?;
    let layers = RenderLayers::new(&setup, config)?;
    let backdrop = backdrop(picture);
    let light = |all: &PixelSamples<'_>| mean(&backdrop, all);
    let (samples, mean) = with_rasterizer!(layers, |rasterizer| {
        let (samples, _, own) = rasterizer.probe(layers.shader, &light, pixel);
        match picture.filter {
            Filter::Box => (samples, own),
            filter => (samples, rasterizer.probe_filtered(filter, layers.shader, &light, pixel)),
        }
    });
    let whole = || pixels::light(&setup, &layers, config).0;
    let colors = parsed.scene.stage.seen_colors().copied();
    let explainer = Explainer { scene: setup.scene(), parsed: &parsed, source, picture, colors };
    let teller = Teller { setup: &setup, explainer: &explainer };
    let samples: Vec<_> = samples.into_iter().map(content).collect();
    let steps = PixelSteps::new(picture, mean, !setup.keeps_highlights, whole);
    let explanation = explainer.explain(pixel, &samples, |sample| teller.shown(sample), steps);
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

/// What a sample shows: its faces and wires, each once, even if its edges are in the sample as
/// well.
fn content(sample: ProbedSample) -> (SampleContent, ProbedSample) {
    let stack = stack(&sample);
    let mut rows: Vec<u32> = stack.iter().map(|layer| layer.tag).collect();
    rows.sort_unstable();
    rows.dedup();
    let is_free = stack.iter().all(|layer| layer.pass > 0.0);
    (SampleContent { place: sample.place, rows, is_free }, sample)
}

/// Computes the explanations of samples.
struct Teller<'a> {
    setup: &'a Setup<'a>,
    explainer: &'a Explainer<'a>,
}

impl Teller<'_> {
    fn shown(&self, sample: &ProbedSample) -> RasterSample {
        let painter = self.setup.painter();
        let (seen, values, light) = self.subject(sample);
        let emissions =
            Emissions::new(painter.scene, painter.view, painter.appearance.surface.frames());
        let emission = emissions.at(sample.place, seen);
        let (place, velocity) = (emission.place, emission.velocity);
        let geometry = ShownEffects::of(self.setup.scene());
        let RestPosition(rest) = geometry.rest(SeenPosition(place), velocity);
        let rest_time = (geometry == ShownEffects::default()).then(|| -rest.length());
        let angle = |line: DVec3| {
            (!velocity.is_zero()).then(|| line.angle_between(velocity.direction()).to_degrees())
        };
        let doppler = doppler_at(place, velocity);
        let surface = ExplainedSurface {
            item: self.explainer.item(seen.item),
            velocity: velocity.beta().to_array(),
            beta: velocity.beta().length(),
            gamma: velocity.gamma(),
            own_time: emission.own_time,
            emission: ExplainedEvent { t: Some(emission.time), x: place.to_array() },
            emission_at_rest: ExplainedEvent {
                t: rest_time,
                x: (emission.scene_from_axes * rest).to_array(),
            },
            angle_deg: angle(place),
            angle_at_rest_deg: angle(rest),
            doppler,
            assumed: self.explainer.assumed(seen.item, doppler),
            color: values.map(|values| self.color(values, seen.item, doppler)),
            linear: light.map(f64::from),
        };
        RasterSample {
            surface,
            corners: self.corners(seen.item),
            depth_cue: self.setup.grid.fade.map(|_| self.setup.grid.light_left(seen.key)),
            layers: self.layers(sample),
        }
    }

    /// The surface to explain: the nearest that transmits less than half of the light, as for
    /// channels, else the nearest. With its interpolated values, if they are known, and its light.
    fn subject<'s>(
        &self,
        sample: &'s ProbedSample,
    ) -> (SurfaceSample, Option<&'s [f32]>, [f32; 3]) {
        let layer = |layer: &Fragment| (of_fragment(&self.setup.view, layer), None, layer.light);
        let mut layers = sample.fragments.iter().rev();
        let surface = sample.opaque.as_ref().map(|surface| {
            (of_surface(surface.hit), Some(&surface.values[..]), surface.shaded.light)
        });
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
            item: self.explainer.item(layer.tag),
            translucency: layer.pass,
            linear: layer.light,
        };
        stack.into_iter().map(shown).collect()
    }

    /// The colour that interpolated values stand for.
    fn color(&self, values: &[f32], item: u32, doppler: f64) -> SampleColor {
        let [tint, saturation, value] = [0, 1, 2].map(|i| f64::from(values[i]));
        let is_light = match self.setup.layout {
            Layout::Hues => false,
            Layout::Light => true,
            Layout::Mixed { .. } => values[6] > 0.5,
        };
        if is_light {
            return SampleColor::of_light([tint, saturation, value], self.is_lit(item));
        }
        let has_levels = self.setup.layout == Layout::Mixed { has_levels: true };
        let light_level = has_levels.then(|| [3, 4, 5].map(|i| f64::from(values[i])));
        let swatch = Swatch { tint, saturation, value, ..Swatch::WHITE };
        let palette = &self.setup.appearance.palette;
        let is_shifted = self.setup.scene().stage.seen_colors().is_some_and(|seen| seen.doppler);
        let seen_nm = palette.wavelength_nm(&swatch);
        let rest_nm = if is_shifted { seen_nm * doppler } else { seen_nm };
        SampleColor::of_hue(
            palette.hsv(&swatch),
            palette.interpolation,
            [rest_nm, seen_nm],
            light_level,
        )
    }

    /// False for faces that shine by themselves: with a light level of their own, and in spectra as
    /// seen those of black bodies and sampled spectra.
    fn is_lit(&self, item: u32) -> bool {
        let scene = self.setup.scene();
        let Some(face) = scene.faces.get(item as usize) else { return true };
        let is_spectral = scene
            .stage
            .seen_colors()
            .is_some_and(|seen| matches!(seen.scale, ColorScale::Spectra { .. }));
        let emits = face.color.is_some_and(|color| scene.colors[color.index()].value.emits());
        scene.light_level(face).is_none() && !(is_spectral && emits)
    }

    fn corners(&self, item: u32) -> Vec<ExplainedCorner> {
        let painter = self.setup.painter();
        let scene = painter.scene;
        let vertices = |rows: &std::ops::Range<u32>| scene.contours.corners(rows.clone()).to_vec();
        if let Some(face) = scene.faces.get(item as usize) {
            let look = FaceLook::new(&painter, face);
            let corner = |vertex: VertexId| {
                let lights = if scene.light_level(face).is_some() {
                    Vec::new()
                } else {
                    let [point, normal, shift] = painter.lit_point(face, vertex, look.normal);
                    painter.lighting.parts(scene, point, normal, shift, look.is_light())
                };
                self.corner(vertex, &look.swatch(vertex), look.level(vertex), lights)
            };
            return vertices(&face.contours).into_iter().map(corner).collect();
        }
        let Some(wire) = scene.wires.get(item as usize - scene.faces.len()) else {
            return Vec::new();
        };
        let swatch = painter.wire_swatch(wire, true);
        let end = |vertex| self.corner(vertex, &swatch(vertex), DVec3::ONE, Vec::new());
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
        let light = swatch.form.light().map(|light| light.to_array());
        ExplainedCorner {
            vertex: scene.names.get(scene.vertices[vertex.index()].name).to_owned(),
            hue_saturation_value: light.is_none().then_some([hsv.hue, hsv.saturation, value]),
            linear: light,
            light_level: level.to_array(),
            lights: lights
                .into_iter()
                .map(|(light, level)| LightPart { light, level: level.to_array() })
                .collect(),
        }
    }
}
