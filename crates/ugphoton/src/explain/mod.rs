//! Explains the colour of a pixel: the surfaces on the way of its light, and every step to the
//! bytes.

mod text;

use std::borrow::Cow;

use glam::DVec3;
use serde::Serialize;
use uglight::{ColorForm, ColorShift, light_names};
use ugparse::{Diagnostics, Source};
use ugphysics::Velocity;
use ugpicture::explain::{
    ExplainedEvent, ExplainedSurface, Explainer, Explanation, PixelSteps, SampleColor,
    SampleContent, sparse_step,
};
use ugscene::HueScale;
use ugskybox::SkyError;
use ugtrace::SurfacePoint;

use crate::config::Config;
use crate::error::Error;
use crate::media::Solid;
use crate::pixels::{self, ExplainedRay};
use crate::render::as_seen;
use crate::scenery::Scenery;
use crate::shade::LampLight;
use crate::tracer::{Visit, Way};

/// What is told of a sample.
#[derive(Clone, Debug, Serialize)]
pub struct TracedSample {
    /// Linear red, green and blue: the sum over the surfaces.
    pub linear: [f64; 3],
    /// The part of the background that is seen, in red, green and blue.
    pub background: [f64; 3],
    /// The surfaces that contribute to it, from the eye on.
    pub surfaces: Vec<TracedSurface>,
}

/// A surface on the way of the light.
#[derive(Clone, Debug, Serialize)]
pub struct TracedSurface {
    /// How its light goes on; rows of [`TracedSample::surfaces`].
    #[serde(flatten)]
    pub way: Way,
    /// Number of reflections and refractions between the surface and the eye.
    pub depth: u32,
    /// The part of its light that reaches the eye.
    pub weight: f64,
    /// The transparent solid its light goes through at first.
    pub medium: Option<ExplainedMedium>,
    /// The surface as it is seen.
    #[serde(flatten)]
    pub surface: ExplainedSurface,
    /// Translucency of the face there.
    pub translucency: f64,
    /// The lights that shine on it. Empty for faces with a light level of their own.
    pub lamps: Vec<ExplainedLamp>,
    /// The part of the light that it mirrors; `None` if that is not followed.
    pub mirrored: Option<f64>,
    /// The part of the light that it transmits; `None` if that is not followed.
    pub transmitted: Option<f64>,
    /// True at total reflection.
    pub is_total_reflection: bool,
}

/// A transparent solid.
#[derive(Clone, Debug, Serialize)]
pub struct ExplainedMedium {
    /// Name of its surface.
    pub surface: String,
    /// Index of refraction, at rest.
    pub index: f64,
    /// Velocity.
    pub velocity: [f64; 3],
    /// The part of the light that is not absorbed (P38).
    pub left: f64,
}

/// A light that shines on a surface.
#[derive(Clone, Debug, Serialize)]
pub struct ExplainedLamp {
    /// Its name, see [`uglight::light_names`].
    pub light: String,
    /// The level of its red, green and blue light without shadow, in the rest frame of the surface.
    pub level: [f64; 3],
    /// The Doppler factor from the light to the surface.
    #[serde(rename = "D")]
    pub doppler: f64,
    /// Its distance at emission in that frame; `None` for ambient and directional light.
    pub distance: Option<f64>,
    /// The part of it that is not in shadow.
    pub part: f64,
}

/// Explains a pixel of the picture that `config` describes.
///
/// # Errors
/// As for drawing, and if the pixel is not in the picture.
pub fn explain(
    config: &Config,
    source: &Source,
    pixel: [u32; 2],
) -> Result<(Explanation<TracedSample>, Diagnostics), Error> {
    let parsed = crate::render::read(config, source)?;
    if config.sky.is_some() || parsed.scene.sky.is_some() {
        return Err(SkyError::Explained.into());
    }
    let canvas = config.canvas()?;
    let pixel = canvas.pixel_of_scene(pixel)?;
    let config = &config.on(&canvas);
    let scenery = Scenery::new(Cow::Owned(as_seen(parsed.scene.clone(), config)?), config)?;
    let scene = &scenery.scene;
    let is_changed = scenery.shift != ColorShift::NONE;
    let colors =
        is_changed.then(|| scenery.shift.seen_colors(HueScale::Degrees, scenery.has_lights()));
    let explainer = Explainer { scene, parsed: &parsed, source, picture: &config.picture, colors };
    let teller =
        Teller { scenery: &scenery, explainer: &explainer, light_names: light_names(scene) };
    let samples: Vec<_> =
        pixels::explained(&scenery, config, pixel).into_iter().map(content).collect();
    let steps = pixel_steps(&scenery, config, pixel);
    Ok((explainer.explain(pixel, &samples, |sample| teller.shown(sample), steps), parsed.warnings))
}

/// What a sample shows: the faces that its ray from the eye meets.
fn content(sample: ExplainedRay) -> (SampleContent, ExplainedRay) {
    let direct = sample.visits.iter().filter(|visit| visit.depth == 0);
    let rows = direct.map(|visit| visit.point.face).collect();
    let is_free = sample.arriving.background.max_element() > 0.0;
    (SampleContent { place: sample.place, rows, is_free }, sample)
}

fn pixel_steps(scenery: &Scenery<'_>, config: &Config, [column, row]: [u32; 2]) -> PixelSteps {
    let one = Config { crop: Some([column, row, 1, 1]), ..config.clone() };
    let light = pixels::light(scenery, &one, &()).0;
    let mean = light.pixels().first().copied().unwrap_or_default();
    let sparse = || pixels::sparse(scenery, config, sparse_step(config.picture.size));
    PixelSteps::new(&config.picture, mean, !scenery.keeps_highlights, sparse)
}

/// Computes the explanations of samples.
struct Teller<'a> {
    scenery: &'a Scenery<'a>,
    explainer: &'a Explainer<'a>,
    /// In the order of the lamps.
    light_names: Vec<String>,
}

impl Teller<'_> {
    fn shown(&self, sample: &ExplainedRay) -> TracedSample {
        TracedSample {
            linear: sample.arriving.light.to_array(),
            background: sample.arriving.background.to_array(),
            surfaces: sample.visits.iter().map(|visit| self.traced(sample, visit)).collect(),
        }
    }

    fn traced(&self, sample: &ExplainedRay, visit: &Visit) -> TracedSurface {
        let [mirrored, transmitted] = visit.followed;
        let lamps = visit.lamps.iter().filter(|_| self.is_lit(&visit.point));
        TracedSurface {
            way: visit.way,
            depth: visit.depth,
            weight: visit.weight,
            medium: visit.medium.map(|(solid, left)| self.medium(solid, left)),
            surface: self.surface(sample, visit),
            translucency: visit.point.color.swatch.translucency,
            lamps: lamps.map(|lamp| self.lamp(lamp)).collect(),
            mirrored,
            transmitted,
            is_total_reflection: visit.is_total,
        }
    }

    fn surface(&self, sample: &ExplainedRay, visit: &Visit) -> ExplainedSurface {
        let point = &visit.point;
        let frame = point.frame(&self.scenery.world);
        let velocity: Velocity = frame.velocity();
        let at_rest = frame.rest_from_camera(point.event);
        // A body that is not inertial has coordinates of its own; this is the frame in which its
        // surface rests at emission.
        let rest = if point.element.is_some() { at_rest.x } else { point.place };
        let is_direct = visit.depth == 0 && !velocity.is_zero();
        let angles_deg = is_direct.then(|| {
            let moving = frame.turned_velocity(velocity).direction();
            let camera = sample.ray.step.x.angle_between(velocity.direction());
            [camera, (-point.wave.k).angle_between(moving)].map(f64::to_degrees)
        });
        ExplainedSurface {
            item: self.explainer.item(point.face),
            velocity: velocity.beta().to_array(),
            beta: velocity.beta().length(),
            gamma: velocity.gamma(),
            own_time: point.element.as_ref().map(|element| element.own_time),
            emission: ExplainedEvent {
                t: Some(point.event.t),
                x: (point.event.x - sample.ray.origin.x).to_array(),
            },
            emission_at_rest: ExplainedEvent { t: Some(at_rest.t), x: rest.to_array() },
            angle_deg: angles_deg.map(|[camera, _]| camera),
            angle_at_rest_deg: angles_deg.map(|[_, rest]| rest),
            doppler: point.doppler(),
            assumed: self.explainer.assumed(point.face, point.doppler()),
            color: Some(self.color(visit)),
            linear: visit.light.to_array(),
        }
    }

    fn medium(&self, solid: Solid, left: f64) -> ExplainedMedium {
        let surface = self.scenery.properties(solid.surface);
        ExplainedMedium {
            surface: self.scenery.scene.names.get(surface.name).to_owned(),
            index: surface.refraction,
            velocity: self.scenery.world.parts[solid.part].frame.velocity().beta().to_array(),
            left,
        }
    }

    fn lamp(&self, light: &LampLight) -> ExplainedLamp {
        let lamps = &self.scenery.lamps;
        let row = light.irradiance.lamp as usize;
        let shift = self.scenery.appearance.hue_shift;
        ExplainedLamp {
            light: self.light_names[lamps[row].color_of.map_or(row, |light| light as usize)]
                .clone(),
            level: (light.irradiance.level * shift.color_of(&lamps[row])).to_array(),
            doppler: light.irradiance.doppler,
            distance: light.distance.filter(|distance| distance.is_finite()),
            part: light.part,
        }
    }

    fn color(&self, visit: &Visit) -> SampleColor {
        let (scenery, point) = (self.scenery, &visit.point);
        if scenery.appearance.is_spectral() || point.color.swatch.form != ColorForm::Hue {
            return SampleColor::of_light(visit.light.to_array(), self.is_lit(point));
        }
        let (appearance, swatch) = (&scenery.appearance, &point.color.swatch);
        let rest_nm = appearance.wavelength_nm(swatch.tint);
        let seen_nm = appearance.hue_shift.wavelength_nm(rest_nm, point.doppler());
        let palette = &appearance.palette;
        let level = Some(self.level(visit));
        SampleColor::of_hue(palette.hsv(swatch), palette.interpolation, [rest_nm, seen_nm], level)
    }

    /// False for surfaces that emit their light.
    fn is_lit(&self, point: &SurfacePoint) -> bool {
        let Scenery { scene, appearance, .. } = self.scenery;
        appearance.is_lit(&point.color)
            && scene.light_level(&scene.faces[point.face as usize]).is_none()
    }

    /// The level of light on a surface, red, green and blue.
    fn level(&self, visit: &Visit) -> [f64; 3] {
        let scene = &self.scenery.scene;
        if let Some(level) = scene.light_level(&scene.faces[visit.point.face as usize]) {
            return [level; 3];
        }
        let (lamps, shift) = (&self.scenery.lamps, self.scenery.appearance.hue_shift);
        let level = |light: &LampLight| {
            let color = shift.color_of(&lamps[light.irradiance.lamp as usize]);
            light.irradiance.level * light.part * color
        };
        visit.lamps.iter().map(level).sum::<DVec3>().to_array()
    }
}
