//! A scene prepared for rays.

use std::borrow::Cow;
use std::ops::Range;

use glam::DVec3;
use uglight::{
    Appearance, ColorShift, DEFAULT_AMBIENT, DEFAULT_FROM_EYE, HueShift, Interpolation, Lamp, LampPlace,
    Palette, Spectra, SpectralLamp, SurfaceAttributes, lamps, spectral_lamps,
};
use ugphysics::{Event, Medium};
use ugpicture::PictureOptions;
use ugscene::{
    ColorId, ColorValue, Face, Geometry, HueScale, LightKind, Scene, SurfaceProperties, VertexId, View,
};

use crate::config::{Config, RayOptions, Shutter};
use crate::error::{Error, MOST_LIGHTINGS};
use crate::frame::RestFrame;
use crate::immersion::Immersion;
use crate::lens::{Film, Sight};
use crate::path::{Media, Ray, Solid};
use crate::world::{Faces, Intersection, PacketMemory, World};

/// Changes of D by mirrors that are fast to compute, as a multiple of the greatest rapidity: two
/// reflections by mirrors that approach each other.
const REACH: f64 = 5.0;

/// The event at which the light of a picture arrives at a single eye.
const ORIGIN: Event = Event { t: 0.0, x: DVec3::ZERO };

/// A scene prepared for rays, for one camera.
pub struct Scenery<'a> {
    /// The scene as seen, whose vertices are part of one body each.
    pub scene: Cow<'a, Scene>,
    /// The camera of a frame; its picture coordinates are samples.
    pub view: View,
    /// Its lens and film.
    film: Film,
    /// The faces, by rest frame.
    pub world: World,
    /// The transparent solids, one of which the eye may be in.
    immersion: Immersion,
    /// The media at the origin, where the eye is at the moment of the picture.
    eye_media: Media,
    /// The colours of the scene.
    pub palette: Palette,
    /// Colours and rest positions of the vertices.
    pub surface: SurfaceAttributes,
    /// Which secondary rays are traced.
    pub rays: RayOptions,
    /// The lights.
    pub lights: Lights,
    /// How motion changes colours.
    pub shift: ColorShift,
    /// If colours are spectra.
    pub spectra: Option<Spectra>,
    /// True if a transparent solid absorbs light.
    pub has_absorption: bool,
    /// Light brighter than white is kept until it is developed; otherwise it is clipped per sample,
    /// as in 1988.
    pub is_uncut: bool,
}

/// The lights of a scene.
pub struct Lights {
    /// In the order of the scene, or the default lights.
    pub lamps: Vec<Lamp>,
    /// Their spectra, if colours are spectra.
    pub spectral: Vec<SpectralLamp>,
    /// Radii; 0 for points and for lights without a place.
    pub radii: Vec<f64>,
    /// The rest frame of each, if its motion is stated.
    pub frames: Vec<Option<RestFrame>>,
    /// True if a light is neither white nor grey.
    pub is_colored: bool,
    /// True if the light of white surfaces under them is daylight.
    pub is_daylight: bool,
    /// True for lights of the scene. Default lights cast no shadows.
    pub are_of_scene: bool,
}

impl<'a> Scenery<'a> {
    /// `scene`: as seen, with the stage that says so; its vertices are part of one body each.
    ///
    /// # Errors
    /// There are no faces, or the camera is invalid.
    pub fn new(scene: Cow<'a, Scene>, config: &Config) -> Result<Self, Error> {
        if scene.faces.is_empty() {
            return Err(Error::Empty);
        }
        if Geometry::of(&scene) != Geometry::default() {
            return Err(Error::PartialGeometry);
        }
        let PictureOptions { size: [width, height], samples, camera, .. } = &config.picture;
        let [frame_width, frame_height] = config.frame_size().map(|side| side * samples);
        let view = View::new(&scene, camera, [frame_width, frame_height])?;
        if !view.is_perspective {
            return Err(Error::Orthographic);
        }
        let film = Film::new(config.lens, config.stereo, &view, [frame_width, frame_height]);
        let n_samples =
            config.crop.map_or(u64::from(*width) * u64::from(*height), |[_, _, width, height]| {
                u64::from(width) * u64::from(height)
            }) * u64::from(samples * samples);
        let n_lights = scene.lights.len();
        if (n_lights as u64).saturating_mul(n_samples) > MOST_LIGHTINGS {
            return Err(Error::TooManyLights { n_lights, n_samples });
        }
        let hue_scale = ugscene::hue_scale(&scene, config.hue_scale)?;
        let mut scene = scene;
        if hue_scale != scene.stage.hue_scale() {
            ugscene::read_tints_in(scene.to_mut(), hue_scale);
        }
        let interpolation = match hue_scale {
            HueScale::Degrees => config.interpolation,
            HueScale::Wavelengths => Interpolation::Wavelength,
        };
        let is_spectral = matches!(config.shift, ColorShift::Spectra(_));
        let palette = Palette::new(&scene, interpolation, is_spectral);
        let surface = SurfaceAttributes::new(&scene, view.eye, &palette);
        let spectra = match config.shift {
            ColorShift::Spectra(shift) => {
                let reach = REACH * surface.greatest_rapidity(&scene);
                Some(Spectra::new(&scene, shift, surface.mixtures(&scene), reach))
            }
            ColorShift::Hues(_) => None,
        };
        check_spectra(&scene, &surface, config.shift)?;
        let faces = Faces { scene: &scene, rest: surface.all_rest() };
        let world = World::new(faces, surface.frames());
        let immersion = Immersion::new(&world, faces);
        let eye_media = immersion.media(&world, faces, ORIGIN);
        let lights = Lights::new(&scene, &view, &surface, is_spectral);
        let is_uncut = palette.has_light() || config.picture.keeps_light();
        let (rays, shift) = (config.rays, config.shift);
        let has_absorption = scene.surfaces.iter().any(|surface| surface.absorption > 0.0);
        Ok(Self {
            scene,
            view,
            film,
            world,
            immersion,
            eye_media,
            has_absorption,
            palette,
            surface,
            rays,
            lights,
            shift,
            spectra,
            is_uncut,
        })
    }

    /// True if a face transmits light straight on.
    pub fn is_translucent(&self, face: u32) -> bool {
        self.palette.is_translucent(&self.scene, &self.surface, &self.scene.faces[face as usize])
    }

    /// True if colours given as light can be drawn on moving bodies: they are spectra, or nothing
    /// is shifted.
    pub fn keeps_light(&self) -> bool {
        self.spectra.is_some() || self.hue_shift() == HueShift::NONE
    }

    /// The shift of hues; none if colours are spectra.
    pub fn hue_shift(&self) -> HueShift {
        match self.shift {
            ColorShift::Hues(shift) => shift,
            ColorShift::Spectra(_) => HueShift::NONE,
        }
    }

    /// How colours appear.
    pub fn appearance(&self) -> Appearance<'_> {
        Appearance::new(self.shift, &self.palette, self.spectra.as_ref())
    }

    /// The faces.
    pub fn faces(&self) -> Faces<'_> {
        Faces { scene: &self.scene, rest: self.surface.all_rest() }
    }

    /// The ray through the middle of a sample; `None` where the lens shows nothing. Its parameter
    /// is the depth along the view, or the distance with another lens than a pinhole.
    pub fn primary_ray(&self, [column, row]: [u32; 2]) -> Option<Ray> {
        let Sight { eye, direction } = self.film.sight([f64::from(column) + 0.5, f64::from(row) + 0.5])?;
        let ahead = match self.rays.shutter {
            Shutter::Pinhole => 0.0,
            Shutter::Film { distance } => distance * (direction.length() - 1.0),
        };
        let origin = Event { t: -ahead, x: eye };
        match self.media_at(origin).innermost() {
            None if ahead == 0.0 && eye == DVec3::ZERO => Some(Ray::from_eye(direction)),
            None => Some(Ray::in_vacuum(origin, direction)),
            Some(solid) => Ray::in_medium(origin, direction, self.medium(solid)),
        }
    }

    /// The transparent solids around an event at which rays start.
    pub fn media_at(&self, event: Event) -> Cow<'_, Media> {
        if event == ORIGIN {
            return Cow::Borrowed(&self.eye_media);
        }
        Cow::Owned(self.immersion.media(&self.world, self.faces(), event))
    }

    /// The medium of a transparent solid, in the frame of the camera.
    fn medium(&self, solid: Solid) -> Medium {
        let velocity = self.world.parts[solid.part].frame.velocity;
        Medium { index: self.properties(solid.surface).refraction, velocity }
    }

    /// The face that each of neighbouring rays from the eye meets first, for parameters in a range.
    pub fn first(
        &self,
        rays: &[Ray],
        range: Range<f64>,
        memory: &mut PacketMemory,
        first: &mut Vec<Option<Intersection>>,
    ) {
        first.clear();
        let is_in_vacuum = self.eye_media.innermost().is_none();
        if self.rays.shutter != Shutter::Pinhole || !self.film.has_one_eye() || !is_in_vacuum {
            first.extend(rays.iter().map(|ray| self.closest(ray, range.clone())));
            return;
        }
        first.resize(rays.len(), None);
        self.world.first(self.faces(), rays, range, memory, first);
    }

    /// The face that a ray meets first, for parameters in a range.
    #[inline]
    pub fn closest(&self, ray: &Ray, range: Range<f64>) -> Option<Intersection> {
        self.world.closest(self.faces(), ray, range)
    }

    /// Reflection properties.
    pub fn properties(&self, surface: ugscene::SurfaceId) -> &SurfaceProperties {
        &self.scene.surfaces[surface.index()]
    }
}

/// Refuses moving bodies with spectra when hues are shifted.
fn check_spectra(scene: &Scene, surface: &SurfaceAttributes, shift: ColorShift) -> Result<(), Error> {
    let is_hue = matches!(shift, ColorShift::Hues(shift) if shift != HueShift::NONE);
    let is_spectrum = |color: ColorId| {
        let value = scene.colors[color.index()].value;
        matches!(value, ColorValue::Blackbody { .. } | ColorValue::Spectrum { .. })
    };
    let moves = |face: &Face| {
        let corners = scene.contours.corners(face.contours.clone());
        let color_of = |corner: &VertexId| scene.vertices[corner.index()].color.or(face.color);
        !surface.velocity(face.body).is_zero() && corners.iter().filter_map(color_of).any(is_spectrum)
    };
    if is_hue && scene.colors.iter().any(uglight::is_light) && scene.faces.iter().any(moves) {
        return Err(Error::MovingSpectrum);
    }
    Ok(())
}

impl Lights {
    fn new(scene: &Scene, view: &View, surface: &SurfaceAttributes, is_spectral: bool) -> Self {
        if scene.lights.is_empty() {
            let lamps = vec![
                Lamp::white(LampPlace::Everywhere, DEFAULT_AMBIENT),
                Lamp::white(LampPlace::Afar(-view.forward), DEFAULT_FROM_EYE),
            ];
            let spectral = [DEFAULT_AMBIENT, DEFAULT_FROM_EYE].map(SpectralLamp::white).to_vec();
            return Self {
                radii: vec![0.0; lamps.len()],
                frames: vec![None; lamps.len()],
                lamps,
                spectral,
                is_colored: false,
                is_daylight: true,
                are_of_scene: false,
            };
        }
        let lamps = lamps(scene, view.eye);
        let radius = |light: &ugscene::Light| match light.kind {
            LightKind::Local { radius, .. } => radius,
            _ => 0.0,
        };
        let frame = |lamp: &Lamp| Some(RestFrame::new(surface.frames(), lamp.motion.body()?));
        Self {
            spectral: if is_spectral { spectral_lamps(scene) } else { Vec::new() },
            radii: scene.lights.iter().map(radius).collect(),
            frames: lamps.iter().map(frame).collect(),
            is_colored: lamps.iter().any(|lamp| lamp.is_colored),
            is_daylight: scene.lights.iter().all(|light| light.color.is_none()),
            are_of_scene: true,
            lamps,
        }
    }
}
