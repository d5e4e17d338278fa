//! Contributions of lamps, at rest and in motion, to the light on a point of a surface.  Eq. (P14)

use std::cell::LazyCell;

use glam::{DQuat, DVec3};
use ugphysics::{
    Event, SkyRing, Velocity, ambient_illumination, compose, illumination, illumination_along,
    illumination_at, illumination_from_afar,
};
use ugscene::{BodyId, RestFrames};

use crate::{Lamp, LampPlace};

/// A point of a surface in its rest frame, in the axes of the scene; of a body on a world line, in
/// the coordinates of the body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceElement {
    /// Relative to the eye, (P4), (P45).
    pub point: DVec3,
    /// When it scatters the light.
    pub time: ScatteringTime,
    /// Unit vector on the side that is seen, or zero for a surface without one.
    pub normal: DVec3,
    /// The body it is part of.
    pub body: BodyId,
}

/// When a point of a surface scatters light toward the eye.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ScatteringTime {
    /// The time, in the rest frame of an inertial body, by which the point scatters the light later
    /// than where the eye sees it directly: 0 unless light reaches the eye by a mirror, through
    /// glass, or at another event than the origin.
    Delay(f64),
    /// The own time of a body on a world line.
    Own(f64),
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

impl Irradiance {
    /// Adds it to the light on a surface. With D_l = 1 light of a mixture is light of its parts, so
    /// that of many lamps becomes that of few spectra.
    pub fn add_to(self, light: &mut Vec<Irradiance>, lamps: &[Lamp]) {
        let mixture = &lamps[self.lamp as usize].mixture;
        if mixture.is_empty() || self.doppler != 1.0 {
            return light.push(self);
        }
        for &(lamp, share) in mixture {
            let level = share * self.level;
            match light.iter_mut().find(|part| part.lamp == lamp) {
                Some(part) => part.level += level,
                None => light.push(Irradiance { lamp, level, ..self }),
            }
        }
    }
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

impl IncidentLamp {
    /// Calls `visit` with the light of each colour, when a lamp has a mixture of two. `colors`:
    /// their rows, with their shares.
    fn of_colors(self, colors: &[(u32, f64); 2], mut visit: impl FnMut(IncidentLamp)) {
        for &(lamp, share) in colors.iter().filter(|(_, share)| *share > 0.0) {
            let irradiance =
                Irradiance { lamp, level: share * self.irradiance.level, ..self.irradiance };
            visit(Self { irradiance, part: share * self.part, ..self });
        }
    }
}

impl SurfaceElement {
    /// The contribution of each lamp, in their order; none of those behind the surface.
    pub fn irradiances(&self, lamps: &[Lamp], frames: &RestFrames) -> Vec<Irradiance> {
        let mut all = Vec::with_capacity(lamps.len());
        self.for_each_incident(
            lamps,
            frames,
            |_, _| (None, 1.0),
            |incident| all.push(incident.irradiance),
        );
        all
    }

    /// Calls `visit` with the light of each lamp, in their order; not with those behind the
    /// surface. Moving ambient light is visited several times, once for each ring of the sky.
    /// `place`: returns a place of a lamp, from its row and itself, which stands for all of it;
    /// with `None` it is several ([`Lamp::places`]); and the refractive index of the medium
    /// between, in which both rest, or 1.
    pub fn for_each_incident(
        &self,
        lamps: &[Lamp],
        frames: &RestFrames,
        place: impl Fn(usize, &Lamp) -> (Option<LampPlace>, f64),
        mut visit: impl FnMut(IncidentLamp),
    ) {
        let (shift, standing) = (frames.lamp_shift(self.body), self.standing(frames));
        let any_moves = lamps.iter().any(|lamp| self.moving_body(lamp, frames).is_some());
        let moving = if any_moves { MovingElement::new(self, frames) } else { None };
        // Those that follow are colours of lamps that change.
        for (row, lamp) in lamps.iter().enumerate().take_while(|(_, lamp)| lamp.color_of.is_none())
        {
            let (sampled, index) = place(row, lamp);
            let mut from = |place: LampPlace, share: f64| {
                let place = lamp.shifted(place, shift);
                let colors = match &lamp.table {
                    Some(table) => {
                        match self.time_of(lamp, place, frames, moving.as_ref(), index) {
                            Some(own_time) => Some(table.at(own_time)),
                            None => return,
                        }
                    }
                    None => None,
                };
                let mut add =
                    |level: f64, doppler: f64, toward: Option<(DVec3, f64)>, part: f64| {
                        if level <= 0.0 {
                            return;
                        }
                        let lamp = row as u32;
                        let irradiance = Irradiance { lamp, level: share * level, doppler };
                        let whole = IncidentLamp { irradiance, toward, part: share * part };
                        match &colors {
                            None => visit(whole),
                            Some(colors) => whole.of_colors(colors, &mut visit),
                        }
                    };
                match self.moving_body(lamp, frames) {
                    None => {
                        let level = lamp.level_from(place, standing.point, standing.normal);
                        let toward = standing.direction_at_rest(place);
                        let part = toward.map_or(1.0, |(toward, distance)| {
                            lamp.part_at(distance, -toward, lamp.beam)
                        });
                        add(level, 1.0, toward, part);
                    }
                    Some(body) => {
                        moving
                            .as_ref()
                            .and_then(|moving| moving.light_of(lamp, (place, body), &mut add));
                    }
                }
            };
            match sampled {
                None if lamp.is_area() => {
                    lamp.places().for_each(|(place, share)| from(place, share))
                }
                place => from(place.unwrap_or(lamp.place), 1.0),
            }
        }
    }

    /// A unit vector towards a lamp in the rest frame of the surface, D_l, and the part of the
    /// intensity that arrives, whatever the normal. `None` for ambient light, and at the lamp.
    pub fn light_from(&self, lamp: &Lamp, frames: &RestFrames) -> Option<(DVec3, f64, f64)> {
        let place = lamp.shifted(lamp.place, frames.lamp_shift(self.body));
        let Some(body) = self.moving_body(lamp, frames) else {
            let (toward, distance) = self.standing(frames).direction_at_rest(place)?;
            return Some((toward, 1.0, lamp.part_at(distance, -toward, lamp.beam)));
        };
        let mut light = None;
        MovingElement::new(self, frames)?.light_of(
            lamp,
            (place, body),
            &mut |_, doppler, toward, part| {
                light = toward.map(|(toward, _)| (toward, doppler, part));
            },
        );
        light
    }

    /// The own time at which a lamp sent the light that the surface scatters: a lamp with a place
    /// and a motion. `place`: that of the lamp.
    pub fn lamp_time(&self, lamp: &Lamp, place: LampPlace, frames: &RestFrames) -> Option<f64> {
        let moving = MovingElement::new(self, frames);
        self.time_of(lamp, place, frames, moving.as_ref(), 1.0)
    }

    fn time_of(
        &self,
        lamp: &Lamp,
        place: LampPlace,
        frames: &RestFrames,
        moving: Option<&MovingElement<'_>>,
        index: f64,
    ) -> Option<f64> {
        let (LampPlace::At(at), Some(own)) = (place, lamp.motion.body()) else { return None };
        if let (None, ScatteringTime::Delay(delay)) = (self.moving_body(lamp, frames), self.time) {
            let (_, distance) = self.direction_at_rest(place)?;
            return Some(delay - ugphysics::length(self.point) - index * distance);
        }
        let event = moving?.event();
        match frames.world_line(own) {
            Some(line) => Some(line.emission(at, event).ok()?.own_time),
            None => {
                let Event { t, x } = frames.of(own).rest_from_camera(event);
                Some(t - ugphysics::length(at - x))
            }
        }
    }

    /// For lamps that rest with whatever they light: a body on a world line is lit as it stands in
    /// the scene if it only turned.
    #[must_use]
    pub fn standing(&self, frames: &RestFrames) -> Self {
        match (frames.world_line(self.body), self.time) {
            (Some(line), ScatteringTime::Own(own_time)) => {
                let (point, turn) = line.standing(self.point, own_time);
                Self { point, normal: turn * self.normal, ..*self }
            }
            _ => *self,
        }
    }

    /// Direction and distance of a lamp that rests with the surface.
    fn direction_at_rest(&self, place: LampPlace) -> Option<(DVec3, f64)> {
        match place {
            LampPlace::Everywhere => None,
            LampPlace::Afar(toward) => Some((toward, f64::INFINITY)),
            LampPlace::At(place) => Some((
                ugphysics::unit_or_zero(place - self.point),
                ugphysics::length(place - self.point),
            )),
        }
    }

    /// The body of a lamp that moves relative to the surface.
    fn moving_body(&self, lamp: &Lamp, frames: &RestFrames) -> Option<BodyId> {
        let body = lamp.motion.body()?;
        let is_inertial = |body: BodyId| frames.world_line(body).is_none();
        let rests = is_inertial(body)
            && is_inertial(self.body)
            && frames.velocity(body) == frames.velocity(self.body);
        (!rests).then_some(body)
    }
}

/// A surface element that moves, in common axes with lamps: velocities of two frames can be
/// composed only in those of the camera, which boosts do not turn.  Eq. (P25)
struct MovingElement<'a> {
    element: &'a SurfaceElement,
    frames: &'a RestFrames,
    velocity: Velocity,
    /// These axes from those of the element.
    axes: DQuat,
    /// In these axes.
    normal: DVec3,
    /// For a body on a world line, where and when it scatters the light, in the frame of the
    /// camera.
    on_line: Option<Event>,
}

impl<'a> MovingElement<'a> {
    fn new(element: &'a SurfaceElement, frames: &'a RestFrames) -> Option<Self> {
        let SurfaceElement { point, time, normal, body } = *element;
        let (velocity, axes, normal, on_line) = match (frames.world_line(body), time) {
            (Some(line), ScatteringTime::Own(own_time)) => {
                let event = line.event(point, own_time).ok()?;
                let surface = line.element(point, own_time);
                (surface.velocity, DQuat::IDENTITY, surface.normal(normal), Some(event))
            }
            _ => {
                let axes = frames.of(body).boosted_from_scene();
                (frames.velocity(body), axes, axes * normal, None)
            }
        };
        Some(Self { element, frames, velocity, axes, normal, on_line })
    }

    /// Where and when it scatters the light, in the frame of the camera.
    fn event(&self) -> Event {
        let (x, frame) = (self.element.point, self.frames.of(self.element.body));
        let in_rest_frame = || Event { t: self.delay() - ugphysics::length(x), x };
        self.on_line.unwrap_or_else(|| frame.camera_from_rest(in_rest_frame()))
    }

    fn delay(&self) -> f64 {
        if let ScatteringTime::Delay(delay) = self.element.time { delay } else { 0.0 }
    }

    /// Calls `add` with level, D_l, direction with distance and part of the light of a lamp of
    /// `body` at `place`.
    fn light_of(
        &self,
        lamp: &Lamp,
        (place, body): (LampPlace, BodyId),
        add: &mut impl FnMut(f64, f64, Option<(DVec3, f64)>, f64),
    ) -> Option<()> {
        let velocity = self.velocity;
        let turned = |axes: DQuat| lamp.beam.turned(|vector| axes * vector);
        let (light, beam) = match place {
            LampPlace::Everywhere => {
                let (motion, _) = self.motion_of(body)?;
                let relative = compose(motion, -velocity);
                for SkyRing { level, doppler } in ambient_illumination(self.normal, relative) {
                    add(level, doppler, None, 1.0);
                }
                return None;
            }
            LampPlace::Afar(toward) => {
                let (motion, axes) = self.motion_of(body)?;
                (illumination_from_afar(velocity, axes * toward, motion)?, lamp.beam)
            }
            LampPlace::At(place) => match (self.frames.world_line(body), self.on_line) {
                (None, None) => {
                    let (motion, axes) = self.motion_of(body)?;
                    let (point, delay) = (self.axes * self.element.point, self.delay());
                    (illumination(point, delay, velocity, axes * place, motion)?, turned(axes))
                }
                (None, Some(event)) => {
                    let at = self.frames.of(body).rest_from_camera(event).x;
                    let (motion, axes) = self.motion_of(body)?;
                    (illumination_at(axes * at, velocity, axes * place, motion)?, turned(axes))
                }
                (Some(line), _) => {
                    let event = self.event();
                    let emission = line.emission(place, event).ok()?;
                    let way = emission.event.x - event.x;
                    // Where a body spins, each of its places has a rest frame of its own.
                    let element = LazyCell::new(|| line.element(place, emission.own_time));
                    let beam = lamp.beam.turned(|vector| element.line(vector));
                    (illumination_along(way, velocity, emission.velocity)?, beam)
                }
            },
        };
        let toward = self.axes.inverse() * light.toward;
        let part = lamp.part_at(light.rest_distance, light.leaving, beam);
        let level = part * self.normal.dot(light.toward);
        add(level, light.doppler, Some((toward, light.distance)), part);
        Some(())
    }

    /// The velocity of a lamp's body and the turn of its directions: of one on a world line at the
    /// time, in the frame of the scene, at which the light is scattered.
    fn motion_of(&self, body: BodyId) -> Option<(Velocity, DQuat)> {
        let Some(line) = self.frames.world_line(body) else {
            return Some((self.frames.velocity(body), self.frames.of(body).boosted_from_scene()));
        };
        let pose = line.pose(line.own_time_when(self.event(), self.frames.scene_from_camera()));
        let velocity = pose.scene_from_axes.velocity_of_frame().ok()?;
        let carried = ugphysics::Lorentz::boost(velocity).inverse() * pose.scene_from_axes;
        Some((velocity, carried.turn() * pose.turn))
    }
}
