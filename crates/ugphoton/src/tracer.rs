//! Rays from the eye into the past: surfaces, mirrors and glass along them.

use glam::DVec3;
use serde::Serialize;
use uglight::{ColorFilter, ColorForm};
use ugphysics::{Event, Medium, WaveVector, compose, reflectance};

use crate::media::{Media, Solid};
use crate::neighbours::{Neighbours, PictureSample};
use crate::scenery::Scenery;
use crate::shade::{LampLight, Shader, absorption};
use ugskybox::{SkyAround, SkyRays};
use ugtrace::rays::{Intersection, PastRay, Start};
use ugtrace::{SurfacePoint, Surfaces};

/// Light that arrives along a ray.
#[derive(Clone, Copy, Debug)]
pub struct Arriving {
    /// Linear red, green and blue.
    pub light: DVec3,
    /// The part of the background that is seen, in red, green and blue.
    pub background: DVec3,
}

impl Arriving {
    const NOTHING: Self = Self { light: DVec3::ZERO, background: DVec3::ZERO };

    fn add(&mut self, weight: f64, other: Self) {
        self.light += weight * other.light;
        self.background += weight * other.background;
    }
}

/// Follows rays through a scene.
pub struct Tracer<'a> {
    scenery: &'a Scenery<'a>,
    surfaces: Surfaces<'a>,
    shader: Shader<'a>,
    sky: Option<SkyRays<'a>>,
    /// Filters on the path so far.
    filters: Vec<ColorFilter>,
    /// Memory for faces at the same place.
    layers: Vec<Intersection>,
    /// Reflections and refractions of the current sample.
    n_branches: u32,
    /// A sample had more than [`MOST_BRANCHES`] of them.
    pub is_cut_short: bool,
    /// A face at which a path of the current sample exited a transparent solid without having
    /// entered it.
    pub leaves_open_solid: Option<u32>,
    /// A path of the current sample ended after [`RayOptions::depth`] reflections and refractions.
    ///
    /// [`RayOptions::depth`]: crate::RayOptions::depth
    pub is_too_deep: bool,
    /// The surfaces that contribute to a sample, for explanations; `None` if they are not wanted.
    visits: Option<Vec<Visit>>,
}

/// A surface that contributes to a sample.
#[derive(Clone, Debug)]
pub struct Visit {
    /// Where the light left it.
    pub point: SurfacePoint,
    /// How the light went on.
    pub way: Way,
    /// Number of reflections and refractions between the surface and the eye.
    pub depth: u32,
    /// The part of its light that reaches the eye.
    pub weight: f64,
    /// The transparent solid that the light went through to the next surface or the eye, and the
    /// part that it did not absorb.
    pub medium: Option<(Solid, f64)>,
    /// Linear red, green and blue of its own light, of which `weight` is seen.
    pub light: DVec3,
    /// The light of lamps on it.
    pub lamps: Vec<LampLight>,
    /// The parts of its light that it mirrors and transmits, if they are followed.
    pub followed: [Option<f64>; 2],
    /// True if light that would be transmitted is reflected totally.
    pub is_total: bool,
}

/// How light of a surface goes on towards the eye.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(tag = "way", content = "by", rename_all = "lowercase")]
pub enum Way {
    /// Straight to the eye.
    Straight,
    /// Mirrored by the visit of this row, and on as from there.
    Mirrored(usize),
    /// Refracted by the visit of this row, and on as from there.
    Refracted(usize),
}

/// The most reflections and refractions of a sample. Between mirrors that are transparent, too,
/// each path divides into two at every surface.
const MOST_BRANCHES: u32 = 4096;

/// Light behind translucent faces that transmit less than this is not looked for: a thousandth of
/// the least step of a display.
const FAINT: f64 = 4e-6;

/// A ray and the state of its path.
#[derive(Clone, Copy)]
struct Path<'p> {
    ray: &'p PastRay,
    media: &'p Media,
    /// Reflections and refractions so far.
    depth: u32,
    /// The part of its light that reaches the eye.
    weight: f64,
    /// Absorption along the ray per unit of its parameter, in its medium.  Eq. (P38)
    absorption: f64,
    /// A number for each sample of the picture.
    sample: u64,
    /// For the footprints of textures, if there are any.
    neighbours: Option<&'p Neighbours>,
    /// Angle of the sample at the eye, radians.
    width: f64,
    /// Where it comes from.
    way: Way,
}

impl<'a> Tracer<'a> {
    /// In a scene.
    pub fn new(scenery: &'a Scenery<'a>) -> Self {
        Self {
            scenery,
            surfaces: scenery.surfaces(),
            shader: Shader::new(scenery),
            sky: scenery.sky.as_ref().map(SkyAround::rays),
            filters: Vec::new(),
            layers: Vec::new(),
            n_branches: 0,
            is_cut_short: false,
            leaves_open_solid: None,
            is_too_deep: false,
            visits: None,
        }
    }

    /// As [`Tracer::arriving`], with the surfaces that contribute.
    pub fn explained(
        &mut self,
        ray: &PastRay,
        first: Option<Intersection>,
        far: f64,
        (sample, place): (u64, PictureSample),
    ) -> (Arriving, Vec<Visit>) {
        (self.visits, self.shader.received) = (Some(Vec::new()), Some(Vec::new()));
        let arriving = self.arriving(ray, first, far, (sample, place));
        self.shader.received = None;
        (arriving, self.visits.take().unwrap_or_default())
    }

    /// The light that arrives along a ray, and how much of the background is seen. `first`: the
    /// nearest face on the ray within the clipping distances. `far`: the end of the range of
    /// parameters. `sample`: its number in the picture.
    pub fn arriving(
        &mut self,
        ray: &PastRay,
        first: Option<Intersection>,
        far: f64,
        (sample, place): (u64, PictureSample),
    ) -> Arriving {
        let media = self.scenery.media_at(ray.origin);
        let neighbours = (!self.scenery.textures.is_empty()).then_some(Neighbours::OfSample(place));
        let path = Path {
            ray,
            media: &media,
            depth: 0,
            weight: 1.0,
            absorption: absorption(self.scenery, media.innermost(), ray.step),
            sample,
            neighbours: neighbours.as_ref(),
            width: if self.sky.is_some() { self.scenery.sample_width(ray.step.x) } else { 0.0 },
            way: Way::Straight,
        };
        (self.n_branches, self.is_too_deep, self.leaves_open_solid) = (0, false, None);
        self.seen(&path, first, far)
    }

    /// Adds up what is seen along a path: translucent faces, up to the first opaque one.
    fn seen(&mut self, path: &Path<'_>, first: Option<Intersection>, far: f64) -> Arriving {
        let mut sum = Arriving::NOTHING;
        let mut passing = 1.0;
        let mut next = first;
        while let Some(found) = next {
            let left =
                if path.absorption > 0.0 { libm::exp(-path.absorption * found.s) } else { 1.0 };
            if !self.scenery.is_translucent(found.triangle.face) {
                let point = self.point(path, &found);
                let part = passing * left;
                let on = Path { weight: path.weight * part, ..*path };
                let own = self.light_of(&on, (&point, &found), left);
                sum.add(part, own);
                return sum;
            }
            // Faces at the same place are blended in the order of the scene.
            let mut layers = std::mem::take(&mut self.layers);
            self.scenery.world.coincident(self.scenery.faces(), path.ray, &found, &mut layers);
            let mut end = found.s;
            for layer in &layers {
                let point = self.point(path, layer);
                let weight = passing * left * (1.0 - point.color.swatch.translucency);
                if weight > 0.0 {
                    let on = Path { weight: path.weight * weight, ..*path };
                    let own = self.light_of(&on, (&point, layer), left);
                    sum.add(weight, own);
                }
                passing *= point.color.swatch.translucency;
                end = end.max(layer.s);
            }
            self.layers = layers;
            if path.weight * passing * left < FAINT {
                return sum;
            }
            next = self.scenery.closest(path.ray, end..far);
        }
        // The background is infinitely far away.
        if path.absorption == 0.0 {
            let passing = passing * self.scenery.appearance.transmitted(&self.filters);
            match &mut self.sky {
                // Behind the picture the sky is drawn pixel by pixel.
                Some(sky) if path.depth > 0 => {
                    let toward = path.ray.step.x.normalize_or_zero();
                    let [red, green, blue, _] =
                        sky.light(toward, path.width, path.ray.wave.frequency);
                    sum.light += passing * DVec3::from([red, green, blue].map(f64::from));
                }
                _ => sum.background += passing,
            }
        }
        sum
    }

    fn point(&self, path: &Path<'_>, found: &Intersection) -> SurfacePoint {
        let neighbours = || path.neighbours.and_then(|neighbours| neighbours.rays(self.scenery));
        SurfacePoint::new(&self.surfaces, path.ray, found, neighbours)
    }

    /// The light from a surface: of lamps, mirrored, and transmitted. `left`: the part of it that
    /// the medium before the surface does not absorb.
    fn light_of(
        &mut self,
        path: &Path<'_>,
        (point, found): (&SurfacePoint, &Intersection),
        left: f64,
    ) -> Arriving {
        let light = self.shader.light(point, path.media.innermost(), &self.filters, path.sample);
        let visit = self.visit(path, point, light, left);
        let mut sum = Arriving { light, background: DVec3::ZERO };
        let Some(id) = point.surface(&self.scenery.scene) else { return sum };
        let surface = self.scenery.properties(id);
        if path.depth >= self.scenery.rays.depth {
            let followed = path.weight * (surface.specular + surface.transmitted);
            self.is_too_deep |= followed > 0.0 && followed >= self.scenery.rays.cutoff;
            return sum;
        }
        let (mut mirrored, mut transmitted) = (surface.specular, surface.transmitted);
        let refracted = (transmitted > 0.0).then(|| self.refracted(path, point, id)).flatten();
        match &refracted {
            // Total reflection.
            None => mirrored += std::mem::take(&mut transmitted),
            Some(refracted) if self.scenery.rays.fresnel => {
                let both = mirrored + transmitted;
                mirrored = both * refracted.reflectance;
                transmitted = both - mirrored;
            }
            Some(_) => {}
        }
        let cutoff = self.scenery.rays.cutoff;
        let is_followed = |part: f64| part > 0.0 && part * path.weight >= cutoff;
        if is_followed(mirrored)
            && let Some(wave) = self.reflected(path, point)
        {
            if let Some(visit) = self.visited(visit) {
                visit.followed[0] = Some(mirrored);
                visit.is_total = surface.transmitted > 0.0 && refracted.is_none();
            }
            let on = Path { way: Way::Mirrored(visit), ..*path };
            sum.add(
                mirrored,
                self.follow(&on, (point, found), (wave, MIRRORED), path.media, mirrored),
            );
        }
        if let Some(Refracted { wave, media, .. }) = refracted
            && is_followed(transmitted)
        {
            let swatch = &point.color.swatch;
            let is_white = swatch.is_grey() && swatch.value == 1.0 && swatch.form == ColorForm::Hue;
            if !is_white {
                self.filters.push(ColorFilter { color: point.color, doppler: point.doppler() });
            }
            if let Some(visit) = self.visited(visit) {
                visit.followed[1] = Some(transmitted);
            }
            let on = Path { way: Way::Refracted(visit), ..*path };
            sum.add(
                transmitted,
                self.follow(&on, (point, found), (wave, REFRACTED), &media, transmitted),
            );
            if !is_white {
                self.filters.pop();
            }
        }
        sum
    }

    /// Notes a surface, if surfaces are wanted, and returns its row.
    fn visit(&mut self, path: &Path<'_>, point: &SurfacePoint, light: DVec3, left: f64) -> usize {
        let Some(visits) = &mut self.visits else { return 0 };
        visits.push(Visit {
            point: point.clone(),
            way: path.way,
            depth: path.depth,
            weight: path.weight,
            medium: path.media.innermost().map(|solid| (solid, left)),
            light,
            lamps: self.shader.received.clone().unwrap_or_default(),
            followed: [None; 2],
            is_total: false,
        });
        visits.len() - 1
    }

    fn visited(&mut self, row: usize) -> Option<&mut Visit> {
        self.visits.as_mut()?.get_mut(row)
    }

    /// Follows light that left a surface with the wave vector `wave` in its rest frame.
    fn follow(
        &mut self,
        path: &Path<'_>,
        (point, found): (&SurfacePoint, &Intersection),
        (wave, side): (WaveVector, f64),
        media: &Media,
        part: f64,
    ) -> Arriving {
        self.n_branches += 1;
        if self.n_branches > MOST_BRANCHES {
            self.is_cut_short = true;
            return Arriving::NOTHING;
        }
        let frame = point.frame(&self.scenery.world);
        let medium = medium(self.scenery, media.innermost(), point);
        let ray_from = |origin: Event, place: DVec3, wave: WaveVector| {
            let forward = medium.step(wave);
            let step = frame.camera_from_rest(Event { t: -forward.t, x: -forward.x });
            let start = Start::Surface { part: point.part, place };
            PastRay { origin, step, wave: frame.wave_to_camera(wave), start }
        };
        let ray = ray_from(point.event, point.place, wave);
        let bent = |neighbour: PastRay| {
            let (event, place, normal) = point.beside(&self.surfaces, found, &neighbour);
            let wave = frame.wave_to_rest(neighbour.wave);
            Some(ray_from(event, place, bent(medium, wave, side, [normal, point.plane_normal])?))
        };
        let neighbours = path.neighbours.and_then(|neighbours| {
            let [across, down] = neighbours.rays(self.scenery)?;
            Some(Neighbours::Bent([bent(across)?, bent(down)?].into()))
        });
        let absorption = absorption(self.scenery, media.innermost(), ray.step);
        let next = Path {
            ray: &ray,
            media,
            absorption,
            depth: path.depth + 1,
            weight: path.weight * part,
            neighbours: neighbours.as_ref(),
            ..*path
        };
        let first = self.scenery.closest(&ray, 0.0..f64::INFINITY);
        self.seen(&next, first, f64::INFINITY)
    }

    /// The light that a mirror reflects along the path, before reflection.  Eq. (P23), (P37)
    fn reflected(&self, path: &Path<'_>, point: &SurfacePoint) -> Option<WaveVector> {
        let before = medium(self.scenery, path.media.innermost(), point);
        bent(before, point.wave, MIRRORED, [point.normal, point.plane_normal])
    }

    /// The light that a surface transmits along the path, before it; `None` at total reflection.
    /// Eq. (P23), (P37)
    fn refracted(
        &mut self,
        path: &Path<'_>,
        point: &SurfacePoint,
        surface: ugscene::SurfaceId,
    ) -> Option<Refracted> {
        let solid = Solid { part: point.part, surface };
        let (media, is_inside_unknown) = if point.is_outside {
            (path.media.with(solid), false)
        } else {
            path.media
                .without(solid)
                .map_or_else(|| (path.media.clone(), true), |media| (media, false))
        };
        if is_inside_unknown {
            // The solid is open, so the path did not enter it.
            self.leaves_open_solid = Some(point.face);
            return Some(Refracted { wave: point.wave, media, reflectance: 0.0 });
        }
        let behind = medium(self.scenery, media.innermost(), point);
        let before = medium(self.scenery, path.media.innermost(), point);
        let wave = bent(behind, point.wave, REFRACTED, [point.normal, point.plane_normal])?;
        let reflectance = reflectance(before, behind, point.wave, point.normal);
        Some(Refracted { wave, media, reflectance })
    }
}

/// The side of a normal from which light comes that a surface mirrors.
const MIRRORED: f64 = -1.0;

/// The same for light that it transmits.
const REFRACTED: f64 = 1.0;

/// The light in a medium that a surface mirrors or refracts into `wave`.  Eq. (P23), (P37)
///
/// By an interpolated normal it may come from the wrong side of the face. Then the normal of the
/// face's plane is used.
fn bent(
    medium: Medium,
    wave: WaveVector,
    side: f64,
    [normal, plane_normal]: [DVec3; 2],
) -> Option<WaveVector> {
    let of = |normal: DVec3| medium.wave_across(wave, side * normal);
    of(normal).filter(|wave| side * wave.k.dot(plane_normal) > 0.0).or_else(|| of(plane_normal))
}

/// Light behind a surface.
struct Refracted {
    /// In the rest frame of the surface.
    wave: WaveVector,
    /// The media of the path there.
    media: Media,
    /// The reflected part, by Fresnel's equations.
    reflectance: f64,
}

/// A medium in the rest frame of a surface, in the same axes.
fn medium(scenery: &Scenery<'_>, solid: Option<Solid>, point: &SurfacePoint) -> Medium {
    let Some(solid) = solid else { return Medium::VACUUM };
    let index = scenery.properties(solid.surface).refraction;
    if solid.part == point.part {
        return Medium { index, velocity: ugphysics::Velocity::ZERO };
    }
    let (of_solid, here) = (&scenery.world.parts[solid.part].frame, point.frame(&scenery.world));
    let velocity = here.turned_velocity(compose(of_solid.velocity(), -here.velocity()));
    Medium { index, velocity }
}
