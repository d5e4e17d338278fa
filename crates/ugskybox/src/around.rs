//! The sky that rays see which leave a scene.

use std::sync::Arc;

use glam::{DQuat, DVec3};
use ugphysics::Velocity;
use ugsky::{
    ALL_NM, BasisError, Observer, Sampler, Seen, Shade, Sky, SkyColors, StarLight, StarOptions,
};

use crate::open::Opened;
use crate::star_index::StarIndex;

/// Rapidity, as a multiple of that of the observer and beyond it, up to which Doppler factors of
/// paths are tabulated: mirrors that approach each other multiply them.
const REACH: (f64, f64) = (5.0, 1.0);

/// A sky for rays that leave a scene, in the frame of the camera.
pub struct SkyAround {
    opened: Arc<Opened>,
    /// From the axes of the scene to those of the sky.
    sky_from_scene: DQuat,
    observer: Observer,
    /// Of the panorama, if there is one.
    shade: Option<Shade>,
    star_light: StarLight,
    star_index: StarIndex,
    stars: StarOptions,
}

/// Turns a velocity.
pub(crate) fn turned(turn: DQuat, velocity: Velocity) -> Velocity {
    if turn == DQuat::IDENTITY {
        return velocity;
    }
    Velocity::from_rapidity(turn * velocity.direction(), velocity.rapidity()).unwrap_or(velocity)
}

impl SkyAround {
    /// `turn`: from the axes of the sky to those of the scene. `velocity`: of the camera in the
    /// frame of the scene. `keeps_light`: see [`Shade::new`].
    ///
    /// # Errors
    /// [`BasisError`].
    pub fn new(
        opened: Arc<Opened>,
        turn: DQuat,
        velocity: Velocity,
        colors: SkyColors,
        keeps_light: bool,
    ) -> Result<Self, BasisError> {
        let sky_from_scene = turn.inverse();
        let velocity = turned(sky_from_scene, velocity);
        let reach = (REACH.0 * velocity.rapidity() + REACH.1).min(Velocity::MAX_RAPIDITY);
        let tabulated = Velocity::from_rapidity(DVec3::X, reach).unwrap_or(velocity);
        let layers = Sky::from(&*opened).layers(colors, tabulated, &ALL_NM, keeps_light)?;
        let shade = layers.into_iter().next().map(|layer| layer.shade);
        let star_light = StarLight::new(&opened.stars, colors.parts(), reach);
        let star_index = StarIndex::new(&opened.stars);
        let stars = StarOptions::default();
        let observer = Observer::new(velocity);
        Ok(Self { opened, sky_from_scene, observer, shade, star_light, star_index, stars })
    }

    /// The same with stars drawn so.
    #[must_use]
    pub fn with_stars(self, stars: StarOptions) -> Self {
        Self { stars, ..self }
    }

    /// A sampler of the sky, one for each thread.
    pub fn rays(&self) -> SkyRays<'_> {
        let panorama = self.opened.panorama.as_ref();
        SkyRays { around: self, sampler: panorama.map(|panorama| panorama.sampler()) }
    }
}

/// The light at rest in a square around a direction, `side` radians wide for the observer: times
/// alpha, and alpha. The middle of a square that is too wide for one footprint stands for it.
pub(crate) fn light_around(
    sampler: &mut Sampler<'_>,
    observer: &Observer,
    toward: DVec3,
    mut side: f64,
) -> [f32; 4] {
    /// Halvings of a side of 4π.
    const MOST: u32 = 64;
    let across = toward.any_orthonormal_vector();
    for _ in 0..MOST {
        let ray = observer.ray(toward, [side * across, side * toward.cross(across)]);
        if let Some(light) = sampler.light(&ray, 1.0) {
            return light;
        }
        side *= 0.5;
    }
    [0.0; 4]
}

/// Samples the sky along rays that leave a scene.
pub struct SkyRays<'a> {
    around: &'a SkyAround,
    sampler: Option<Sampler<'a>>,
}

impl SkyRays<'_> {
    /// Linear red, green and blue, and the covered part, of the light that arrives from a
    /// direction, a unit vector in the frame of the camera and the axes of the scene.
    ///
    /// `width`: angle of the sample at the eye, radians. `frequency`: of the light on this ray in
    /// the frame of the camera, where it is 1 at the eye: mirrors in motion change it, and with it
    /// the angle of a sample, which is divided by it.
    pub fn light(&mut self, toward: DVec3, width: f64, frequency: f64) -> [f32; 4] {
        let around = self.around;
        let toward = around.sky_from_scene * toward;
        let mut sum = [0.0; 4];
        let (direction, doppler) = around.observer.direction_in_sky(toward);
        let doppler = doppler / frequency;
        if let (Some(sampler), Some(shade)) = (&mut self.sampler, &around.shade) {
            let found = light_around(sampler, &around.observer, toward, width / frequency);
            let mut seen = found.map(|part| [part; Seen::N]);
            shade.see(&mut seen, &[doppler as f32; Seen::N]);
            sum = seen.map(|part| part[0]);
        }
        let stars = self.starlight(direction, width, doppler);
        (0..3).for_each(|channel| sum[channel] += stars[channel]);
        sum
    }

    /// The light of stars around a direction in the sky: each is a Gaussian profile at the eye, D
    /// times as wide in the sky.
    fn starlight(&self, direction: DVec3, width: f64, doppler: f64) -> [f32; 3] {
        let around = self.around;
        let deviation = around.stars.deviation() * width;
        let in_sky = (deviation * doppler).min(StarOptions::MOST_DEVIATION);
        let scale = around.stars.scale() / (core::f64::consts::TAU * deviation * deviation);
        let mut sum = [0.0; 3];
        around.star_index.visit(direction, StarOptions::REACH * in_sky, |idx| {
            let star = &around.opened.stars[idx];
            let square = (star.direction - direction).length_squared();
            let weight = scale * StarOptions::profile(square, in_sky);
            if weight > 0.0 {
                let light = around.star_light.irradiance(star, doppler);
                (0..3).for_each(|channel| sum[channel] += (weight * light[channel]) as f32);
            }
        });
        sum
    }
}
