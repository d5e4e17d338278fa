//! Contributions of lamps, at rest and in motion, to the light on a point of a surface.  Eq. (P14)

use glam::DVec3;
use ugphysics::{SkyRing, ambient_illumination, compose, illumination, illumination_from_afar};
use ugscene::{BodyId, RestFrames};

use crate::{Lamp, LampPlace};

/// A point of a surface in its rest frame, in the axes of the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceElement {
    /// Relative to the eye, (P4).
    pub point: DVec3,
    /// The time, in the rest frame, by which the point scatters the light later than where the eye
    /// sees it directly: 0 unless light reaches the eye by a mirror, through glass, or at another
    /// event than the origin.
    pub delay: f64,
    /// Unit vector on the side that is seen, or zero for a surface without one.
    pub normal: DVec3,
    /// The body it is part of.
    pub body: BodyId,
}

/// The irradiance that one lamp, or a ring of a moving ambient lamp, causes in the rest frame of a
/// surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Irradiance {
    /// Row of the lamps, which have intensity and colour.
    pub lamp: u32,
    /// The part of the lamp's intensity that falls on the surface, without powers of D_l: max(0,
    /// n·l), times the fall-off of the lamp.
    pub level: f64,
    /// D_l, from the lamp to the surface. The irradiance has a factor of a power of it that depends
    /// on what is counted: [`ugphysics::Brightness::irradiance_factor`]; per wavelength it is D_l³.
    pub doppler: f64,
}

/// Light of a lamp on a surface, and where it comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IncidentLamp {
    /// The irradiance. The level is above 0.
    pub irradiance: Irradiance,
    /// The place of the lamp at emission: a unit vector towards it, in the rest frame of the
    /// surface and the axes of the scene, and the distance, infinite for a directional light.
    /// `None` for ambient light, which comes from everywhere.
    pub toward: Option<(DVec3, f64)>,
    /// The part of the lamp's intensity that arrives here, whatever the normal: 1 unless its light
    /// falls off.
    pub part: f64,
}

impl SurfaceElement {
    /// The contribution of each lamp, in their order; none of those behind the surface.
    #[must_use]
    pub fn irradiances(&self, lamps: &[Lamp], frames: &RestFrames) -> Vec<Irradiance> {
        let mut all = Vec::with_capacity(lamps.len());
        self.for_each_incident(lamps, frames, |_, lamp| lamp.place, |incident| all.push(incident.irradiance));
        all
    }

    /// Calls `visit` with the light of each lamp, in their order; not with those behind the
    /// surface. Moving ambient light is visited several times, once for each ring of the sky.
    /// `place`: returns that of a lamp and its row; a lamp that is not a point has many.
    pub fn for_each_incident(
        &self,
        lamps: &[Lamp],
        frames: &RestFrames,
        place: impl Fn(usize, &Lamp) -> LampPlace,
        mut visit: impl FnMut(IncidentLamp),
    ) {
        let shift = frames.lamp_shift(self.body);
        for (row, lamp) in lamps.iter().enumerate() {
            let place = lamp.shifted(place(row, lamp), shift);
            let mut add = |level: f64, doppler: f64, toward: Option<(DVec3, f64)>, part: f64| {
                if level > 0.0 {
                    visit(IncidentLamp {
                        irradiance: Irradiance { lamp: row as u32, level, doppler },
                        toward,
                        part,
                    });
                }
            };
            match self.moving_body(lamp, frames) {
                None => {
                    let level = lamp.level_from(place, self.point, self.normal);
                    let toward = self.direction_at_rest(place);
                    let part = toward.map_or(1.0, |(_, distance)| lamp.part_at(distance));
                    add(level, 1.0, toward, part);
                }
                Some(body) => self.of_moving(lamp, (place, body), frames, &mut add),
            }
        }
    }

    /// Direction and distance of a lamp that rests with the surface.
    fn direction_at_rest(&self, place: LampPlace) -> Option<(DVec3, f64)> {
        match place {
            LampPlace::Everywhere => None,
            LampPlace::Afar(toward) => Some((toward, f64::INFINITY)),
            LampPlace::At(place) => {
                Some((ugphysics::unit_or_zero(place - self.point), ugphysics::length(place - self.point)))
            }
        }
    }

    /// The body of a lamp that moves relative to the surface.
    fn moving_body(&self, lamp: &Lamp, frames: &RestFrames) -> Option<BodyId> {
        let body = lamp.motion.body()?;
        (frames.velocity(body) != frames.velocity(self.body)).then_some(body)
    }

    fn of_moving(
        &self,
        lamp: &Lamp,
        (place, body): (LampPlace, BodyId),
        frames: &RestFrames,
        add: &mut impl FnMut(f64, f64, Option<(DVec3, f64)>, f64),
    ) {
        // Velocities of two frames can be composed only in common axes: those of the camera, which
        // boosts do not turn.  Eq. (P25)
        let axes_of = |body: BodyId| frames.of(body).scene_from_boosted().inverse();
        let (of_surface, of_lamp) = (axes_of(self.body), axes_of(body));
        let (point, normal) = (of_surface * self.point, of_surface * self.normal);
        let (velocity, motion) = (frames.velocity(self.body), frames.velocity(body));
        let light = match place {
            LampPlace::Everywhere => {
                for SkyRing { level, doppler } in ambient_illumination(normal, compose(motion, -velocity)) {
                    add(level, doppler, None, 1.0);
                }
                return;
            }
            LampPlace::Afar(toward) => illumination_from_afar(velocity, of_lamp * toward, motion),
            LampPlace::At(place) => illumination(point, self.delay, velocity, of_lamp * place, motion),
        };
        if let Some(light) = light {
            let toward = of_surface.inverse() * light.toward;
            let part = lamp.part_at(light.rest_distance);
            let level = part * normal.dot(light.toward);
            add(level, light.doppler, Some((toward, light.distance)), part);
        }
    }
}
