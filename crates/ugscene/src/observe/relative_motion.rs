//! The motion of a body relative to the camera.

use std::sync::Arc;

use glam::DVec3;
use ugphysics::{Event, RestFrame, Velocity, WorldLine, WorldLineError, contracted, elongated};

use crate::{HalfSpace, RestPosition, SeenPosition, ShownEffects};

/// Relative rounding error of the bound of (P27), which is computed with about ten operations.
const ROUNDING: f64 = 1e-12;

/// How one body moves relative to the camera, and which effects are shown.
#[derive(Clone, Debug)]
pub struct RelativeMotion {
    frame: RestFrame,
    in_scene: Velocity,
    geometry: ShownEffects,
    line: Option<Arc<WorldLine>>,
}

impl RelativeMotion {
    /// The motion of a body with `velocity` in the frame of the camera, which is the frame of the
    /// scene.
    pub fn new(velocity: Velocity, geometry: ShownEffects) -> RelativeMotion {
        RelativeMotion { frame: RestFrame::new(velocity), in_scene: velocity, geometry, line: None }
    }

    /// The motion of a body with `velocity` in the frame of the camera; `in_scene`, `camera`:
    /// velocities of the body and the camera in the frame of the scene.
    pub(crate) fn composed(
        velocity: Velocity,
        in_scene: Velocity,
        camera: Velocity,
        geometry: ShownEffects,
    ) -> RelativeMotion {
        RelativeMotion {
            frame: super::rest_frames::frame(velocity, camera),
            in_scene,
            geometry,
            line: None,
        }
    }

    /// The motion of a body on a world line, in the frame of the camera with the event of the eye
    /// as its origin.
    pub(crate) fn on_world_line(line: WorldLine, geometry: ShownEffects) -> RelativeMotion {
        Self::new(line.initial_velocity(), geometry).with_line(Some(line))
    }

    /// The same on a world line.
    pub(crate) fn with_line(self, line: Option<WorldLine>) -> RelativeMotion {
        RelativeMotion { line: line.map(Arc::new), ..self }
    }

    /// The rest frame of the body.
    #[inline]
    pub fn rest_frame(&self) -> &RestFrame {
        &self.frame
    }

    /// The world line of a body that is not inertial, in the frame of the camera with the event of
    /// the eye as its origin. Coordinates of the body are relative to the eye. The velocity and the
    /// rest frame below are those at its own time 0.
    #[inline]
    pub fn world_line(&self) -> Option<&Arc<WorldLine>> {
        self.line.as_ref()
    }

    /// In the frame of the camera.
    #[inline]
    pub fn velocity(&self) -> Velocity {
        self.frame.velocity()
    }

    /// In the frame of the scene.
    pub fn in_scene(&self) -> Velocity {
        self.in_scene
    }

    /// Rest coordinates, or a direction, in the axes of the rest positions of (P3); `p` is in the
    /// axes of the scene.  Eq. (P25)
    pub fn turned(&self, p: DVec3) -> DVec3 {
        if self.frame.is_turned() { self.frame.boosted_from_scene() * p } else { p }
    }

    /// The inverse of [`RelativeMotion::turned`].
    pub fn turned_back(&self, p: DVec3) -> DVec3 {
        if self.frame.is_turned() { self.frame.scene_from_boosted() * p } else { p }
    }

    /// True if the body rests in the frame of the camera.
    #[inline]
    pub fn is_at_rest(&self) -> bool {
        self.line.is_none() && self.frame.is_at_rest()
    }

    /// True if the time of flight of light is included, so that straight edges are seen as curves.
    #[inline]
    pub fn has_flight_time(&self) -> bool {
        self.geometry.flight_time
    }

    /// The effects that are shown.
    pub fn effects(&self) -> ShownEffects {
        self.geometry
    }

    /// True if contraction is included.
    pub fn has_contraction(&self) -> bool {
        self.geometry.contraction
    }

    /// Where a point of the body is seen.
    pub fn seen(&self, rest: RestPosition) -> SeenPosition {
        self.geometry.seen(rest, self.velocity())
    }

    /// Where a point is seen, and the own time at which its light left: on a world line that of the
    /// body, else the time of the rest frame after the event of the eye. Without flight time, where
    /// it is at the time of the picture, and its own time then.
    ///
    /// # Errors
    /// [`WorldLineError::Horizon`] if the point cannot move so.
    pub fn light(&self, rest: DVec3) -> Result<(DVec3, f64), WorldLineError> {
        match &self.line {
            None if !self.has_flight_time() => {
                let place = self.seen(RestPosition(rest)).0;
                Ok((place, self.own_time_now(place)))
            }
            Some(line) if !self.has_flight_time() => {
                line.at_time(rest, 0.0).map(|point| (point.event.x, point.own_time))
            }
            None if self.is_at_rest() => Ok((rest, -rest.length())),
            None => Ok((self.seen(RestPosition(rest)).0, -self.boosted_rest(rest).length())),
            Some(line) => {
                line.light(rest, Event::ORIGIN).map(|light| (light.event.x, light.own_time))
            }
        }
    }

    /// The time of the rest frame of an inertial body, after the event of the eye, at a place at the
    /// time of the picture: t' = −γ β·x.
    pub fn own_time_now(&self, place: DVec3) -> f64 {
        -self.proper_speed() * place.dot(self.direction())
    }

    /// The rest position of what is seen at `seen`.
    pub fn rest(&self, seen: SeenPosition) -> RestPosition {
        self.geometry.rest(seen, self.velocity())
    }

    /// û.
    #[inline]
    pub fn direction(&self) -> DVec3 {
        self.velocity().direction()
    }

    /// γ.
    #[inline]
    pub fn gamma(&self) -> f64 {
        self.velocity().gamma()
    }

    /// γβ.
    #[inline]
    pub fn proper_speed(&self) -> f64 {
        self.velocity().proper_speed()
    }

    /// The vector in rest coordinates that (P3) maps to where `rest` is seen. Without contraction
    /// it is `rest` elongated along the motion by γ, which cancels the contraction in (P3).
    #[inline]
    pub fn boosted_rest(&self, rest: DVec3) -> DVec3 {
        if self.geometry.contraction { rest } else { elongated(rest, self.velocity()) }
    }

    /// The part of seen positions p along `n`, as m and f with n·p = m·q − f |q|, where q is the
    /// [`RelativeMotion::boosted_rest`] of the point.  Eq. (P27)
    pub(crate) fn seen_part(&self, n: DVec3) -> (DVec3, f64) {
        if self.has_flight_time() {
            (elongated(n, self.velocity()), self.proper_speed() * n.dot(self.direction()))
        } else {
            // Contraction is linear: what is seen of a flat face is flat.
            (contracted(n, self.velocity()), 0.0)
        }
    }

    /// True only if no point between these corners is in the half-space as seen. Eq. (P27) It is
    /// never true of bodies on world lines, whose curves have no bound in closed form.
    ///
    /// `corners`: rest positions relative to the eye.
    pub fn is_outside(&self, space: &HalfSpace, corners: &[DVec3]) -> bool {
        if self.line.is_some() {
            return false;
        }
        let (normal, flight) = self.seen_part(space.normal);
        let places: Vec<DVec3> = corners.iter().map(|&corner| self.boosted_rest(corner)).collect();
        let toward =
            places.iter().map(|place| place.normalize_or_zero()).sum::<DVec3>().normalize_or_zero();
        let way = |place: DVec3| if flight > 0.0 { place.dot(toward) } else { place.length() };
        let bounds = places.iter().map(|&place| place.dot(normal) - flight * way(place));
        let bound = bounds.fold(f64::MIN, f64::max);
        let size = places.iter().map(|place| place.length()).fold(0.0, f64::max);
        let rounding = ROUNDING * ((normal.length() + flight.abs()) * size + space.offset.abs());
        bound + space.offset < -rounding
    }
}
