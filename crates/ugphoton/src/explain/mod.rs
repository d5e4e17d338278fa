//! Explains the colour of a pixel: the surfaces on the way of its light, and every step to the
//! bytes.

mod json;
mod text;

use std::borrow::Cow;

use glam::DVec3;
use uglight::{ColorShift, Interpolation, light_names};
use ugparse::{Diagnostics, Parsed, Source};
use ugphysics::{Velocity, attenuation, linear_srgb_to_xyz};
use ugpicture::explain::{ExplainedItem, ExplainedPixel, PixelSteps, SampleColor, Wavelength, nearest};
use ugscene::{HueScale, SeenColors};

use crate::config::Config;
use crate::error::Error;
use crate::path::Solid;
use crate::pixels::{self, ExplainedRay};
use crate::render::as_seen;
use crate::scenery::Scenery;
use crate::shade::LampLight;
use crate::tracer::{Visit, Way};

pub use json::json;
pub use text::text;

/// The explanation of a pixel.
#[derive(Clone, Debug)]
pub struct RayExplanation {
    /// The facts common to all renderers. Mirrors and refraction are left out of its surfaces.
    pub pixel: ExplainedPixel,
    /// How motion changes colours; `None` if it does not.
    pub colors: Option<SeenColors>,
    /// The covered sample nearest to the centre of the pixel.
    pub sample: Option<TracedSample>,
}

/// The explanation of a sample.
#[derive(Clone, Debug)]
pub struct TracedSample {
    /// Column and row of the sample in pixels.
    pub place: [f64; 2],
    /// The surfaces that contribute to it, from the eye on. Its light is the sum of theirs.
    pub surfaces: Vec<ExplainedSurface>,
    /// Linear red, green and blue.
    pub light: [f64; 3],
    /// The part of the background that is seen, in red, green and blue.
    pub background: [f64; 3],
}

/// A surface on the way of the light.
#[derive(Clone, Debug)]
pub struct ExplainedSurface {
    /// Its face.
    pub item: ExplainedItem,
    /// How its light goes on; rows of [`TracedSample::surfaces`].
    pub way: Way,
    /// Number of reflections and refractions between the surface and the eye.
    pub depth: u32,
    /// The part of its light that reaches the eye.
    pub weight: f64,
    /// The transparent solid its light goes through at first.
    pub medium: Option<ExplainedMedium>,
    /// Velocity of its body.
    pub beta: DVec3,
    /// Lorentz factor γ of the body.
    pub gamma: f64,
    /// The own time of a body that is not inertial.
    pub own_time: Option<f64>,
    /// Time and position of emission, relative to the eye, in the frame of the camera.
    pub emission: (f64, DVec3),
    /// The emission event in the rest frame of the body and the axes of the scene.
    pub rest: (f64, DVec3),
    /// Angle in degrees between the line of sight and the motion, in the frames of the camera and
    /// of the body; `None` at rest and for light that is mirrored or refracted.
    pub angles_deg: Option<[f64; 2]>,
    /// Doppler factor, from the surface to the eye.
    pub doppler: f64,
    /// Translucency of the face there.
    pub translucency: f64,
    /// Colour at rest, lit, and the wavelength it is seen with.
    pub color: SampleColor,
    /// The lights that shine on it. Empty for faces with a light level of their own.
    pub lamps: Vec<ExplainedLamp>,
    /// Linear red, green and blue of its own light, of which `weight` is seen.
    pub light: [f64; 3],
    /// The parts of the light it mirrors and transmits; `None` if that is not followed.
    pub followed: [Option<f64>; 2],
    /// True at total reflection.
    pub is_total: bool,
}

/// A transparent solid.
#[derive(Clone, Debug)]
pub struct ExplainedMedium {
    /// Name of its surface.
    pub name: String,
    /// Index of refraction, at rest.
    pub index: f64,
    /// Velocity.
    pub beta: DVec3,
    /// The part of the light that is not absorbed (P38).
    pub left: f64,
}

/// A light that shines on a surface.
#[derive(Clone, Debug)]
pub struct ExplainedLamp {
    /// Its name, see [`uglight::light_names`].
    pub name: String,
    /// The level of its red, green and blue light without shadow, in the rest frame of the surface.
    pub level: [f64; 3],
    /// The Doppler factor from the light to the surface.
    pub doppler: f64,
    /// Its distance at emission in that frame, infinite for directional lights; `None` for ambient
    /// light.
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
) -> Result<(RayExplanation, Diagnostics), Error> {
    let parsed = ugparse::read(source, &config.reading, config.picture.camera.name.as_deref())?;
    let canvas = config.canvas()?;
    canvas.check_pixel(pixel)?;
    let config = &config.on(&canvas);
    let scenery = Scenery::new(Cow::Owned(as_seen(parsed.scene.clone(), config)?), config)?;
    let light_names = light_names(&scenery.scene);
    let teller = Teller { scenery: &scenery, config, source, parsed: &parsed, light_names };
    let samples = pixels::explained(&scenery, config, pixel);
    let n = config.picture.samples;
    let n_missing = (n * n) as usize - samples.len();
    let is_free = |sample: &&ExplainedRay| sample.arriving.background.max_element() > 0.0;
    let covered: Vec<&ExplainedRay> = samples.iter().filter(|sample| !sample.visits.is_empty()).collect();
    let explanation = RayExplanation {
        pixel: ExplainedPixel {
            place: pixel,
            size: config.picture.size,
            samples: n,
            covers: teller.covers(&samples),
            n_free: n_missing + samples.iter().filter(is_free).count(),
            is_at_rest: !ugscene::has_moving_bodies(&scenery.scene)
                && !ugscene::has_moving_lights(&scenery.scene),
            steps: pixel_steps(&scenery, config, pixel),
        },
        colors: seen_colors(&scenery),
        sample: nearest(&covered, |sample| sample.place, pixel, n).map(|sample| teller.shown(sample)),
    };
    Ok((explanation, parsed.warnings))
}

/// The law by which colours change; `None` if nothing is changed.
fn seen_colors(scenery: &Scenery<'_>) -> Option<SeenColors> {
    let is_changed = scenery.shift != ColorShift::NONE;
    is_changed.then(|| scenery.shift.seen_colors(HueScale::Degrees, scenery.has_lights()))
}

fn pixel_steps(scenery: &Scenery<'_>, config: &Config, [column, row]: [u32; 2]) -> PixelSteps {
    let one = Config { crop: Some([column, row, 1, 1]), ..config.clone() };
    let light = pixels::light(scenery, &one, &()).0;
    let mean = light.pixels().first().copied().unwrap_or_default();
    let whole = || pixels::light(scenery, config, &()).0;
    PixelSteps::new(&config.picture, mean, !scenery.is_uncut, whole)
}

/// Computes the explanations of samples.
struct Teller<'a> {
    scenery: &'a Scenery<'a>,
    config: &'a Config,
    source: &'a Source,
    parsed: &'a Parsed,
    /// In the order of the lamps.
    light_names: Vec<String>,
}

impl Teller<'_> {
    fn item(&self, face: u32) -> ExplainedItem {
        ExplainedItem::new(face, &self.scenery.scene, self.parsed, self.source)
    }

    fn covers(&self, samples: &[ExplainedRay]) -> Vec<(ExplainedItem, usize)> {
        let mut counts: Vec<(u32, usize)> = Vec::new();
        for sample in samples {
            for visit in sample.visits.iter().filter(|visit| visit.depth == 0) {
                match counts.iter_mut().find(|(face, _)| *face == visit.point.face) {
                    Some((_, count)) => *count += 1,
                    None => counts.push((visit.point.face, 1)),
                }
            }
        }
        counts.into_iter().map(|(face, count)| (self.item(face), count)).collect()
    }

    fn shown(&self, sample: &ExplainedRay) -> TracedSample {
        let n = f64::from(self.config.picture.samples);
        TracedSample {
            place: sample.place.map(|at| (f64::from(at) + 0.5) / n),
            surfaces: sample.visits.iter().map(|visit| self.surface(sample, visit)).collect(),
            light: sample.arriving.light.to_array(),
            background: sample.arriving.background.to_array(),
        }
    }

    fn surface(&self, sample: &ExplainedRay, visit: &Visit) -> ExplainedSurface {
        let point = &visit.point;
        let frame = point.frame(self.scenery);
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
            item: self.item(point.face),
            way: visit.way,
            depth: visit.depth,
            weight: visit.weight,
            medium: visit.medium.map(|(solid, left)| self.medium(solid, left)),
            beta: velocity.beta(),
            gamma: velocity.gamma(),
            own_time: point.element.as_ref().map(|element| element.own_time),
            emission: (point.event.t, point.event.x - sample.ray.origin.x),
            rest: (at_rest.t, rest),
            angles_deg,
            doppler: point.doppler(),
            translucency: point.color.swatch.translucency,
            color: self.color(visit),
            lamps: visit.lamps.iter().map(|lamp| self.lamp(lamp)).collect(),
            light: visit.light.to_array(),
            followed: visit.followed,
            is_total: visit.is_total,
        }
    }

    fn medium(&self, solid: Solid, left: f64) -> ExplainedMedium {
        let surface = self.scenery.properties(solid.surface);
        ExplainedMedium {
            name: self.scenery.scene.names.get(surface.name).to_owned(),
            index: surface.refraction,
            left,
            beta: self.scenery.world.parts[solid.part].frame.velocity().beta(),
        }
    }

    fn lamp(&self, light: &LampLight) -> ExplainedLamp {
        let lamps = &self.scenery.lamps;
        let row = light.irradiance.lamp as usize;
        let shift = self.scenery.appearance.hue_shift;
        ExplainedLamp {
            name: self.light_names[lamps[row].color_of.map_or(row, |light| light as usize)].clone(),
            level: (light.irradiance.level * shift.color_of(&lamps[row])).to_array(),
            doppler: light.irradiance.doppler,
            distance: light.distance,
            part: light.part,
        }
    }

    fn color(&self, visit: &Visit) -> SampleColor {
        let (scenery, point) = (self.scenery, &visit.point);
        if scenery.appearance.is_spectral() || point.color.swatch.light.is_some() {
            let xyz = linear_srgb_to_xyz(visit.light.to_array());
            let sum: f64 = xyz.iter().sum();
            let chromaticity = (sum > 0.0).then(|| [xyz[0] / sum, xyz[1] / sum]);
            return SampleColor::Light { xyz, chromaticity };
        }
        let base = scenery.appearance.hue_color(&point.color.swatch);
        let is_end = scenery.appearance.palette.interpolation() == Interpolation::Hue
            && !(-60.0 < base.hue && base.hue < 300.0);
        let wavelength = (!point.color.swatch.is_grey()).then(|| {
            let seen_nm = scenery.appearance.hue_shift.wavelength_nm(base.wavelength_nm, point.doppler());
            Wavelength {
                rest_nm: base.wavelength_nm,
                seen_nm,
                attenuation: attenuation(seen_nm),
                is_at_end: is_end,
            }
        });
        SampleColor::Hue {
            hue: base.hue,
            saturation: base.saturation,
            value: base.value,
            level: Some(self.level(visit)),
            wavelength,
        }
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
