//! The light of lamps on a surface, as seen along a ray.

use std::ops::ControlFlow;

use glam::DVec3;
use uglight::{ColorFilter, Illumination, IncidentLamp, Irradiance, Lamp, LampPlace, SurfaceColor};
use ugphysics::{Event, WaveVector, srgb_encode};

use crate::immersion::Crossing;
use crate::media::{Media, Solid};
use crate::sampling::{disk_point, square_point};
use crate::scenery::Scenery;
use ugtrace::SurfacePoint;
use ugtrace::rays::{Corridor, Intersection, PastRay, Start};

/// Shades points of surfaces; it owns the memory it needs for that.
pub struct Shader<'a> {
    scenery: &'a Scenery<'a>,
    diffuse: Vec<Irradiance>,
    highlights: Vec<Irradiance>,
    /// Corridors of shadow rays, by lamp and part.
    corridors: Vec<Corridor>,
    /// The light of lamps at the last point, for explanations; `None` if it is not wanted.
    pub received: Option<Vec<LampLight>>,
}

/// Corridors that are kept; others are dropped.
const N_CORRIDORS: usize = 256;

/// The light of a lamp at a point of a surface.
#[derive(Clone, Copy, Debug)]
pub struct LampLight {
    /// Without shadow, in the rest frame of the surface.
    pub irradiance: Irradiance,
    /// Its distance at emission, infinite for a directional light; `None` for ambient light.
    pub distance: Option<f64>,
    /// The part of it that is not in shadow.
    pub part: f64,
}

impl<'a> Shader<'a> {
    /// For the points of a scene.
    pub fn new(scenery: &'a Scenery<'a>) -> Self {
        let n_corridors = if scenery.world.boxes.is_some() { N_CORRIDORS } else { 1 };
        let corridors = std::iter::repeat_with(Corridor::default).take(n_corridors).collect();
        Self { scenery, diffuse: Vec::new(), highlights: Vec::new(), corridors, received: None }
    }

    /// Linear red, green and blue of the light of lamps that a point scatters and mirrors towards
    /// the eye, and of the light that it emits. `medium`: the solid that light is in before it;
    /// `sample`: a number for each sample of the picture.
    pub fn light(
        &mut self,
        point: &SurfacePoint,
        medium: Option<Solid>,
        filters: &[ColorFilter],
        sample: u64,
    ) -> DVec3 {
        let reflected = self.reflected(point, medium, filters, sample);
        let Some(color) = &point.emitted else { return reflected };
        let level = Illumination::Level(1.0);
        reflected + self.scenery.appearance.light(color, point.doppler(), level, filters)
    }

    fn reflected(
        &mut self,
        point: &SurfacePoint,
        medium: Option<Solid>,
        filters: &[ColorFilter],
        sample: u64,
    ) -> DVec3 {
        let scenery = self.scenery;
        if let Some(received) = &mut self.received {
            received.clear();
        }
        let face = &scenery.scene.faces[point.face as usize];
        if let Some(level) = scenery.scene.light_level(face) {
            return scenery.appearance.light(
                &point.color,
                point.doppler(),
                Illumination::Level(level),
                filters,
            );
        }
        let surface = point.surface(&scenery.scene).map(|surface| scenery.properties(surface));
        let (diffuse, specular) =
            surface.map_or((1.0, 0.0), |surface| (surface.diffuse, surface.specular));
        let exponent = (specular > 0.0).then(|| surface.map_or(0.0, |surface| surface.exponent));
        self.receive(point, medium, exponent, sample);
        let lit = |color: &SurfaceColor, light: &[Irradiance]| {
            let light = Illumination::Lamps(light, &scenery.lamps);
            scenery.appearance.light(color, point.doppler(), light, filters)
        };
        let mut sum = DVec3::ZERO;
        if diffuse > 0.0 {
            sum += diffuse * lit(&point.color, &self.diffuse);
        }
        if !self.highlights.is_empty() {
            // Mirrored without a change of colour.
            let white = SurfaceColor::even(
                scenery.appearance.palette.white(),
                scenery.appearance.surface.row_of(None),
            );
            sum += specular * lit(&white, &self.highlights);
        }
        sum
    }

    /// Finds the light of each lamp that arrives: for diffuse reflection, and if there is an
    /// exponent, for highlights.
    fn receive(
        &mut self,
        point: &SurfacePoint,
        medium: Option<Solid>,
        exponent: Option<f64>,
        sample: u64,
    ) {
        self.diffuse.clear();
        self.highlights.clear();
        let scenery = self.scenery;
        let element = point.lit(&scenery.scene);
        let (diffuse, highlights, received) =
            (&mut self.diffuse, &mut self.highlights, &mut self.received);
        let corridors = &mut self.corridors;
        let toward_eye = point.toward_eye();
        let has_shadows = scenery.has_lights() && scenery.rays.shadows;
        let index = |lamp: usize| scenery.index_before(lamp, medium, point.part);
        let mut add = |incident: IncidentLamp| {
            let Irradiance { level, lamp, .. } = incident.irradiance;
            // Mirrors show a sky itself.
            let exponent = exponent.filter(|_| (lamp as usize) < scenery.n_own_lamps);
            let is_wanted = has_shadows || exponent.is_some();
            let toward = incident.toward.filter(|_| is_wanted);
            let way = toward
                .map(|toward| LampWay::new(scenery, point, lamp, toward, index(lamp as usize)));
            let part = if has_shadows {
                let corridor = (17 * lamp as usize + point.part) % corridors.len();
                way.as_ref()
                    .map_or(1.0, |way| unshadowed(scenery, point, way, &mut corridors[corridor]))
            } else {
                1.0
            };
            if let Some(received) = received {
                let distance = incident.toward.map(|(_, distance)| distance);
                received.push(LampLight { irradiance: incident.irradiance, distance, part });
            }
            if part <= 0.0 {
                return;
            }
            Irradiance { level: level * part, ..incident.irradiance }
                .add_to(diffuse, &scenery.lamps);
            if let (Some(exponent), Some(LampWay { toward, .. })) = (exponent, way) {
                let mirrored = 2.0 * point.normal.dot(toward) * point.normal - toward;
                let cos = mirrored.dot(toward_eye).max(0.0);
                let shine = part * incident.part * libm::pow(cos, exponent);
                if shine > 0.0 {
                    highlights.push(Irradiance { level: shine, ..incident.irradiance });
                }
            }
        };
        let lamp_shift = scenery.appearance.surface.frames().lamp_shift(element.body);
        let place =
            |row: usize, lamp: &Lamp| match (lamp.place, lamp.shifted(lamp.place, lamp_shift)) {
                _ if has_shadows && lamp.is_area() => {
                    Some(lamp.place_on(square_point(sample, row as u64)))
                }
                (LampPlace::At(place), LampPlace::At(shifted)) if lamp.radius > 0.0 => {
                    let toward = ugphysics::unit_or_zero(shifted - seen_from(scenery, point, row));
                    Some(LampPlace::At(
                        place + lamp.radius * disk_point(toward, sample, row as u64),
                    ))
                }
                _ => None,
            };
        let frames = scenery.appearance.surface.frames();
        for rows in scenery.lamps_of(sample) {
            let first = rows.start as u32;
            let place = |row: usize, lamp: &Lamp| {
                let row = rows.start + row;
                (place(row, lamp), index(row))
            };
            element.for_each_incident(&scenery.lamps[rows.clone()], frames, place, |incident| {
                let Irradiance { lamp, .. } = incident.irradiance;
                let irradiance = Irradiance { lamp: first + lamp, ..incident.irradiance };
                add(IncidentLamp { irradiance, ..incident });
            });
        }
    }
}

/// The place of a point in the frame of a lamp, or as it stands before a lamp that rests with what
/// it lights.
fn seen_from(scenery: &Scenery<'_>, point: &SurfacePoint, lamp: usize) -> DVec3 {
    let frames = scenery.appearance.surface.frames();
    match scenery.lamps[lamp].motion.body() {
        // Where its light came from on a world line decides only how its disk is turned.
        Some(body) => frames.point_at(body, point.event).unwrap_or(point.place),
        None => point.lit(&scenery.scene).standing(frames).point,
    }
}

/// The way back from a point to a lamp.
struct LampWay {
    /// Towards the lamp, a unit vector in the rest frame of the surface.
    toward: DVec3,
    /// A step into the past, in the frame of the camera.
    step: Event,
    /// Number of these steps.
    distance: f64,
}

impl LampWay {
    /// `toward`: see [`IncidentLamp::toward`]; `index`: see [`Scenery::index_before`].
    fn new(
        scenery: &Scenery<'_>,
        point: &SurfacePoint,
        lamp: u32,
        (toward, distance): (DVec3, f64),
        index: f64,
    ) -> Self {
        let frame = point.frame(&scenery.world);
        let rests_with_surface = scenery.lamps[lamp as usize].motion.body().is_none();
        match point.world_line(&scenery.world).filter(|_| rests_with_surface) {
            // Such a lamp is in the frame of the body's reference point.
            Some((line, own_time)) => {
                let step = line.pose(own_time).scene_from_axes.apply(Event { t: -1.0, x: toward });
                Self {
                    toward: ugphysics::unit_or_zero(frame.rest_from_camera(step).x),
                    step,
                    distance,
                }
            }
            None => Self {
                toward,
                step: frame.camera_from_rest(Event { t: -index, x: toward }),
                distance,
            },
        }
    }
}

/// The part of a lamp's light that arrives at a point, in the unit in which levels add up: linear
/// for spectra and for laws that act on linear light, else display-encoded. The shadow ray runs
/// back in time to the lamp.  Eq. (P24)
fn unshadowed(
    scenery: &Scenery<'_>,
    point: &SurfacePoint,
    &LampWay { step, distance, .. }: &LampWay,
    corridor: &mut Corridor,
) -> f64 {
    let frame = point.frame(&scenery.world);
    // Beneath a smooth surface, faces in its light may be turned away from the lamp. The shadow
    // ray starts above them, so the limit of the light is as smooth as the normals.
    let lift = frame.camera_from_rest(Event { t: 0.0, x: point.lift });
    let origin = Event { t: point.event.t + lift.t, x: point.event.x + lift.x };
    let ray = PastRay {
        origin,
        step,
        // Nothing depends on the frequency of a shadow ray.
        wave: WaveVector { frequency: 1.0, k: DVec3::ZERO },
        start: Start::Surface { part: point.part, place: point.place + point.lift },
    };
    let mut part = 1.0;
    let mut crossings = Vec::new();
    let _ =
        scenery.world.visit_along(scenery.faces(), &ray, 0.0..distance, Some(corridor), |found| {
            part *= transmittance_at(scenery, &found);
            if scenery.has_absorption {
                crossings.extend(Crossing::new(&scenery.world, scenery.faces(), &ray, &found));
            }
            if part > 0.0 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
        });
    part *= left_by_solids(scenery, step, crossings, distance);
    let is_linear =
        scenery.appearance.is_spectral() || scenery.appearance.hue_shift.law.acts_on_light();
    if is_linear { part } else { srgb_encode(part) }
}

/// The part of the light that solids do not absorb along a straight shadow ray from 0 to `end` in
/// these steps. Where solids are nested, the innermost absorbs, as along the paths of the light
/// that is seen.  Eq. (P38)
fn left_by_solids(
    scenery: &Scenery<'_>,
    step: Event,
    mut crossings: Vec<Crossing>,
    end: f64,
) -> f64 {
    crossings.sort_by(|a, b| a.s.total_cmp(&b.s));
    // Solids that the ray leaves without having entered them are those it starts in.
    let mut inside = Media::default();
    let mut around = Vec::new();
    for crossing in &crossings {
        match crossing.behind(&inside) {
            Some(media) => inside = media,
            None => around.push(crossing.solid),
        }
    }
    let mut inside =
        around.into_iter().rev().fold(Media::default(), |media, solid| media.with(solid));
    let (mut depth, mut from) = (0.0, 0.0);
    for crossing in &crossings {
        depth += (crossing.s - from) * absorption(scenery, inside.innermost(), step);
        from = crossing.s;
        inside = crossing.behind(&inside).unwrap_or(inside);
    }
    // A lamp in a solid: the ray does not leave it.
    let last = absorption(scenery, inside.innermost(), step);
    if last > 0.0 {
        depth += (end - from) * last;
    }
    libm::exp(-depth)
}

/// Absorption in a medium for a step of a ray.  Eq. (P38)
pub fn absorption(scenery: &Scenery<'_>, solid: Option<Solid>, step: Event) -> f64 {
    let Some(solid) = solid else { return 0.0 };
    let coefficient = scenery.properties(solid.surface).absorption;
    if coefficient == 0.0 {
        return 0.0;
    }
    coefficient * scenery.world.parts[solid.part].frame.rest_from_camera(step).x.length()
}

/// [`transmittance`] of a face where a ray meets it.
fn transmittance_at(scenery: &Scenery<'_>, found: &Intersection) -> f64 {
    let face = &scenery.scene.faces[found.triangle.face as usize];
    if scenery.textures.is_translucent(face.color) && scenery.scene.surface(face).is_none() {
        let at = (found.triangle.corners, found.weights());
        if let Some(texel) =
            scenery.textures.texel(&scenery.scene, face.color, at, || [[0.0; 2]; 2])
        {
            return texel.translucency;
        }
    }
    transmittance(scenery, found.triangle.face)
}

/// Transmittance of a face for a ray that is not bent, 0…1.
pub fn transmittance(scenery: &Scenery<'_>, face: u32) -> f64 {
    let face = &scenery.scene.faces[face as usize];
    if let Some(surface) = scenery.scene.surface(face) {
        return surface.transmitted;
    }
    match face.color {
        Some(color) => scenery.scene.colors[color.index()].translucency,
        None => 0.0,
    }
}
