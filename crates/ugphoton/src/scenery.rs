//! A scene prepared for rays.

use std::borrow::Cow;
use std::ops::Range;

use glam::DVec3;
use uglight::{Appearance, ColorShift, FaceColors, Lamp, LampPlace, Lamps};
use ugphysics::{Event, Medium};
use ugpicture::PictureOptions;
use ugscene::{
    BodyId, Face, LightMotion, RestFrames, Scene, ShownEffects, SurfaceProperties, View,
};
use ugskybox::{SkyAround, SkyLamps};
use ugtrace::Surfaces;
use ugtrace::outlines::{NearestFaces, Outlines, Tiles};

use crate::config::{Config, RayOptions, Shutter};
use crate::error::{Error, MOST_LIGHTINGS};
use crate::immersion::Immersion;
use crate::lens::{Film, Sight};
use crate::media::{Media, Solid};
use ugpicture::WithoutFaces;
use ugtrace::rays::{Faces, Intersection, PacketMemory, PastRay, World};
use ugtrace::textures::Textures;

/// Changes of D by mirrors that are fast to compute, as a multiple of the greatest rapidity: two
/// reflections by mirrors that approach each other.
const REACH: f64 = 5.0;

/// A scene prepared for rays, for one camera.
pub struct Scenery<'a> {
    /// The scene as seen, whose vertices are part of one body each.
    pub scene: Cow<'a, Scene>,
    /// The camera of a frame; its picture coordinates are samples.
    pub view: View,
    /// Its lens and film.
    pub film: Film,
    /// The faces, by rest frame.
    pub world: World,
    /// The transparent solids, one of which the eye may be in.
    immersion: Immersion,
    /// The media at the origin, where the eye is at the moment of the picture.
    eye_media: Media,
    /// The colours of the scene, and how motion changes them.
    pub appearance: Appearance,
    /// What the colours of the corners of each face have in common.
    pub face_colors: Vec<FaceColors>,
    /// The pictures that colours of faces are.
    pub textures: Textures,
    /// Which secondary rays are traced.
    pub rays: RayOptions,
    /// The lights, or the default ones.
    pub lamps: Lamps,
    /// How motion changes colours.
    pub shift: ColorShift,
    /// What rays see that leave the scene.
    pub sky: Option<SkyAround>,
    /// The lights of the sky, if it lights the scene: its stars, then its points, behind the lamps
    /// of the scene in [`Scenery::lamps`].
    sky_lamps: Option<SkyLamps>,
    /// The number of the others, those of a scene, with their colours over time.
    pub n_own_lamps: usize,
    /// For each lamp of the scene, the solid that it is in and rests with. Empty if no lamp is.
    lamp_media: Vec<Option<Solid>>,
    /// Samples in a row of the picture, and along a side of a pixel.
    grid: [u32; 2],
    /// True if a transparent solid absorbs light.
    pub has_absorption: bool,
    /// Light brighter than white is kept until it is developed; otherwise it is clipped per sample,
    /// as in 1988.
    pub keeps_highlights: bool,
}

/// The sets of points of a sky that lights a scene, and how many are in each: a set for each sample
/// of a pixel, of 64 points in all or more.
fn sky_sets(samples: u32) -> [usize; 2] {
    const POINTS: usize = 64;
    let n_sets = (samples * samples) as usize;
    [n_sets, (POINTS / n_sets).max(4)]
}

/// The number of colours up to which those under the spectra of a sky are tabulated.
const MOST_TABULATED: usize = 4096;

/// A body on a world line with a surface that transmits light. A medium in which light has one
/// speed has to rest in some frame.
fn moving_medium(scene: &Scene, frames: &RestFrames) -> Option<BodyId> {
    let is_medium = |face: &&Face| {
        let transmits = scene.surface(face).is_some_and(|surface| surface.transmitted > 0.0);
        transmits && frames.world_line(face.body).is_some()
    };
    let faces = if frames.have_world_lines() { &scene.faces[..] } else { &[] };
    faces.iter().find(is_medium).map(|face| face.body)
}

/// Refuses more lights than can be computed.
fn check_lightings(n_lights: usize, config: &Config) -> Result<(), Error> {
    let [width, height] =
        config.crop.map_or(config.picture.size, |[_, _, width, height]| [width, height]);
    let n_samples = u64::from(width) * u64::from(height) * u64::from(config.picture.samples.pow(2));
    if (n_lights as u64).saturating_mul(n_samples) > MOST_LIGHTINGS {
        return Err(Error::TooManyLights { n_lights, n_samples });
    }
    Ok(())
}

/// For each lamp, the transparent solid that it is in and rests with. Empty if no lamp is in one.
fn lamp_media(
    lamps: &Lamps,
    (world, faces, immersion): (&World, Faces<'_>, &Immersion),
    frames: &RestFrames,
) -> Vec<Option<Solid>> {
    let solid = |lamp: &Lamp| {
        let LampPlace::At(place) = lamp.place else { return None };
        let velocity = lamp.motion.body().map(|body| frames.velocity(body));
        (0..world.parts.len()).find_map(|part| {
            let frame = &world.parts[part].frame;
            let rests = world.parts[part].motion.is_none()
                && velocity.is_none_or(|velocity| velocity == frame.velocity());
            let event = || frame.camera_from_rest(Event { t: -place.length(), x: place });
            let inside = rests.then(|| immersion.media(world, faces, event()).innermost());
            inside.flatten().filter(|solid| solid.part == part)
        })
    };
    let media: Vec<Option<Solid>> = lamps.iter().map(solid).collect();
    if media.iter().all(Option::is_none) { Vec::new() } else { media }
}

impl<'a> Scenery<'a> {
    /// `scene`: as seen, with the stage that says so; its vertices are part of one body each.
    ///
    /// # Errors
    /// There are no faces, or the camera is invalid.
    pub fn new(scene: Cow<'a, Scene>, config: &Config) -> Result<Self, Error> {
        if scene.faces.is_empty() && !config.sky.is_some() {
            return Err(ugpicture::Error::Empty(WithoutFaces::new(&scene)).into());
        }
        if ShownEffects::of(&scene) != ShownEffects::default() {
            return Err(Error::PartialGeometry);
        }
        let PictureOptions { size: [width, _], samples, camera, .. } = &config.picture;
        let [frame_width, frame_height] = config.frame_size().map(|side| side * samples);
        let view = View::new(&scene, camera, [frame_width, frame_height])?;
        if !view.is_perspective {
            return Err(Error::Orthographic);
        }
        let film = Film::new(config.lens, config.stereo, &view, [frame_width, frame_height]);
        check_lightings(scene.lights.len(), config)?;
        let mut scene = scene;
        let interpolation = config.interpolation.of_scene(&mut scene, config.hue_scale)?;
        let shift = config.shift;
        let sky_lamps =
            if config.rays.sky_light { config.sky.lamps(sky_sets(*samples))? } else { None };
        let sky_motion = sky_lamps.as_ref().map(|_| {
            let velocity = -ugscene::camera_velocity(&scene);
            LightMotion::Body(scene.to_mut().bodies.moving_with(velocity))
        });
        let appearance = Appearance::new(&scene, view.eye, interpolation, shift, REACH);
        let surface = &appearance.surface;
        if surface.has_moving_spectra(&scene, &[], shift) {
            return Err(Error::MovingSpectrum);
        }
        let faces = Faces { scene: &scene, rest: surface.all_rest() };
        let planes = ugscene::shared_planes(&scene, faces.rest, surface.frames());
        let world = World::new(faces, surface.frames(), planes, |_| true);
        if let Some(body) = moving_medium(&scene, surface.frames()) {
            let name = scene.bodies[body].name.map_or("", |name| scene.names.get(name));
            return Err(Error::MovingMedium { name: name.to_string() });
        }
        let face_colors = appearance.all_face_colors(&scene);
        let memory = config.reading.limits.get(ugparse::Limit::Memory);
        let light = |color| uglight::RestColor::new(&scene, Some(color)).linear();
        let textures =
            Textures::new(&scene, memory, light).map_err(|error| Error::Picture(error.into()))?;
        let immersion = Immersion::new(&world, faces);
        let eye_media = immersion.media(&world, faces, Event::ORIGIN);
        let is_spectral = shift.is_spectral();
        let lamps = match sky_lamps {
            Some(_) => Lamps::new(&scene, view.eye, is_spectral),
            None => Lamps::or_default(&scene, view.eye, view.forward, is_spectral),
        };
        let lamps = lamps.over_time(&scene, view.eye, is_spectral);
        let n_own_lamps = lamps.len();
        let lamp_media = lamp_media(&lamps, (&world, faces, &immersion), surface.frames());
        let (lamps, appearance) = match (&sky_lamps, sky_motion) {
            (Some(sky), Some(motion)) => {
                let lamps = lamps.and(sky.lights(n_own_lamps, motion, is_spectral));
                let n_lamps = if appearance.palette.swatches.len() <= MOST_TABULATED {
                    lamps.len()
                } else {
                    0
                };
                (lamps, appearance.with_tables(n_lamps))
            }
            _ => (lamps, appearance),
        };
        let keeps_highlights = appearance.palette.has_light || config.picture.keeps_light();
        let appearance = if keeps_highlights { appearance } else { appearance.clipped() };
        let rays = config.rays;
        let velocity = ugscene::camera_velocity(&scene);
        let sky = config.sky.around(velocity, shift, keeps_highlights)?;
        let has_absorption = scene.surfaces.iter().any(|surface| surface.absorption > 0.0);
        Ok(Self {
            scene,
            view,
            film,
            world,
            immersion,
            eye_media,
            sky,
            sky_lamps,
            n_own_lamps,
            lamp_media,
            grid: [width * samples, *samples],
            has_absorption,
            appearance,
            face_colors,
            textures,
            rays,
            lamps,
            shift,
            keeps_highlights,
        })
    }

    /// True if a face transmits light straight on.
    pub fn is_translucent(&self, face: u32) -> bool {
        let face = &self.scene.faces[face as usize];
        self.appearance.is_translucent(&self.scene, face)
            || self.textures.is_translucent(face.color)
    }

    /// True if the scene has lights, or its sky lights it. Default lights cast no shadows.
    pub fn has_lights(&self) -> bool {
        !self.scene.lights.is_empty() || self.sky_lamps.is_some()
    }

    /// The rows of the lamps whose light a sample receives: all, but of the points of a sky one
    /// set, another for each sample of a pixel.
    pub fn lamps_of(&self, sample: u64) -> [Range<usize>; 3] {
        let own = 0..self.n_own_lamps;
        let Some(sky) = &self.sky_lamps else { return [own, 0..0, 0..0] };
        let [across, n] = self.grid.map(u64::from);
        let set = sky.set((sample / across % n * n + sample % across % n) as usize);
        let n_before = own.end + sky.stars.len();
        [own.clone(), own.end..n_before, n_before + set.start..n_before + set.end]
    }

    /// The refractive index of the solid between a lamp and a surface of `part`, if they rest in
    /// one and the same; otherwise 1. `before`: the solid before the surface.  Eq. (P24)
    pub fn index_before(&self, lamp: usize, before: Option<Solid>, part: usize) -> f64 {
        let Some(solid) =
            before.filter(|_| self.lamp_media.get(lamp).is_some_and(|of_lamp| *of_lamp == before))
        else {
            return 1.0;
        };
        let [one, other] = [&self.world.parts[part], &self.world.parts[solid.part]];
        let rests = one.motion.is_none() && one.frame.velocity() == other.frame.velocity();
        if rests { self.properties(solid.surface).refraction } else { 1.0 }
    }

    /// The faces.
    pub fn faces(&self) -> Faces<'_> {
        Faces { scene: &self.scene, rest: self.appearance.surface.all_rest() }
    }

    /// The faces with all that decides how they look at rest.
    pub fn surfaces(&self) -> Surfaces<'_> {
        let Self { scene, world, appearance, face_colors, textures, .. } = self;
        Surfaces { scene, world, appearance, face_colors, textures }
    }

    /// The ray through the middle of a sample; `None` where the lens shows nothing. Its parameter
    /// is the depth along the view, or the distance with another lens than a pinhole.
    pub fn primary_ray(&self, [column, row]: [u32; 2]) -> Option<PastRay> {
        self.ray_through([f64::from(column) + 0.5, f64::from(row) + 0.5])
    }

    /// The same through any place, in samples.
    #[inline]
    pub fn ray_through(&self, place: [f64; 2]) -> Option<PastRay> {
        let sight = self.film.sight(place)?;
        if self.is_seen_from_origin() {
            return Some(PastRay::from_eye(sight.direction));
        }
        self.ray_at_event(&sight)
    }

    /// Angle of a sample at a direction of any length, radians.
    pub fn sample_width(&self, direction: DVec3) -> f64 {
        self.film.pixel_width(direction.normalize_or_zero())
    }

    /// True if all light of the picture arrives at the origin, in a vacuum.
    pub fn is_seen_from_origin(&self) -> bool {
        let is_single_event = self.rays.shutter == Shutter::Pinhole && self.film.has_one_eye();
        is_single_event && self.eye_media.innermost().is_none()
    }

    /// The ray of a line of sight, whose light may arrive at another event than the origin, or in a
    /// medium.
    #[inline(never)] // Or the sight of every sample is passed in memory.
    fn ray_at_event(&self, &Sight { eye, direction }: &Sight) -> Option<PastRay> {
        let ahead = match self.rays.shutter {
            Shutter::Pinhole => 0.0,
            Shutter::Film { distance } => distance * (direction.length() - 1.0),
        };
        let origin = Event { t: -ahead, x: eye };
        match self.media_at(origin).innermost() {
            None => Some(PastRay::in_vacuum(origin, direction)),
            Some(solid) => PastRay::in_medium(origin, direction, self.medium(solid)),
        }
    }

    /// The transparent solids around an event at which rays start.
    pub fn media_at(&self, event: Event) -> Cow<'_, Media> {
        if event == Event::ORIGIN {
            return Cow::Borrowed(&self.eye_media);
        }
        Cow::Owned(self.immersion.media(&self.world, self.faces(), event))
    }

    /// The medium of a transparent solid, in the frame of the camera.
    fn medium(&self, solid: Solid) -> Medium {
        let velocity = self.world.parts[solid.part].frame.velocity();
        Medium { index: self.properties(solid.surface).refraction, velocity }
    }

    /// The outlines of faces as they are seen, if rays from the eye find faces faster by them than
    /// by the hierarchy. `tiles`: the parts in which the picture is drawn.
    pub fn outlines(&self, tiles: Tiles) -> Option<Outlines> {
        /// Samples for each face from which outlines are faster. With the teapot and the street
        /// they execute 22 % more instructions at 14, and 10 % less at 57.
        const LEAST: u64 = 32;
        let n_samples = u64::from(tiles.size[0]) * u64::from(tiles.size[1]);
        let are_faster = n_samples >= LEAST * self.scene.faces.len() as u64;
        if !(are_faster
            && !self.scene.has_rounds()
            && self.is_seen_from_origin()
            && self.film.is_pinhole())
        {
            return None;
        }
        Some(self.world.outlines(self.faces(), self.appearance.surface.frames(), &self.view, tiles))
    }

    /// The face that each of neighbouring rays from the eye meets first, for parameters in a range.
    /// `seen`: what outlines find at samples, if they are used; `places`: the samples of the rays.
    pub fn first(
        &self,
        (rays, places): (&[PastRay], &[[u32; 2]]),
        range: Range<f64>,
        seen: Option<&NearestFaces<'_>>,
        memory: &mut PacketMemory,
        first: &mut Vec<Option<Intersection>>,
    ) {
        first.clear();
        if let Some(seen) = seen {
            return self.world.first_behind(
                self.faces(),
                rays,
                range,
                |row| seen.at(places[row]),
                first,
            );
        }
        if !self.is_seen_from_origin() {
            first.extend(rays.iter().map(|ray| self.closest(ray, range.clone())));
            return;
        }
        first.resize(rays.len(), None);
        self.world.first(self.faces(), rays, range, memory, first);
    }

    /// The face that a ray meets first, for parameters in a range.
    #[inline]
    pub fn closest(&self, ray: &PastRay, range: Range<f64>) -> Option<Intersection> {
        self.world.closest(self.faces(), ray, range)
    }

    /// The parameter and the row of the first face on a ray that transmits less than half of the
    /// light behind it.
    pub fn first_opaque(&self, ray: &PastRay, mut range: Range<f64>) -> Option<(f64, u32)> {
        loop {
            let found = self.closest(ray, range.clone())?;
            let color = self.scene.faces[found.triangle.face as usize].color;
            if color.is_none_or(|color| self.scene.colors[color.index()].translucency < 0.5) {
                return Some((found.s, found.triangle.face));
            }
            range.start = found.s;
        }
    }

    /// Reflection properties.
    pub fn properties(&self, surface: ugscene::SurfaceId) -> &SurfaceProperties {
        &self.scene.surfaces[surface.index()]
    }
}
