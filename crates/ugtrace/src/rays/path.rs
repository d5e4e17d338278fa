//! Rays into the past.

use std::ops::Range;

use glam::DVec3;
use ugphysics::{Event, Medium, RestFrame, WaveVector};

/// A ray, followed from the eye into the past.
#[derive(Clone, Copy, Debug)]
pub struct PastRay {
    /// Where it starts, in the frame of the camera relative to the eye.
    pub origin: Event,
    /// A step of it into the past, in the frame of the camera.
    pub step: Event,
    /// The light that follows it towards the eye, in the frame of the camera. Its frequency at the
    /// eye is 1.
    pub wave: WaveVector,
    /// The surface it starts at: row of the part, and place in its rest frame, which has fewer
    /// rounding errors than the event.
    pub start: Start,
}

/// Where a ray starts.
#[derive(Clone, Copy, Debug)]
pub enum Start {
    /// At the eye, at the moment of the picture: the origin of every frame.
    Eye,
    /// At another event.
    Event,
    /// At a surface.
    Surface {
        /// Row of the part.
        part: usize,
        /// The place in its rest frame.
        place: DVec3,
    },
}

impl PastRay {
    /// Light seen in a direction, of any length but 0, at the moment of the picture.
    pub fn from_eye(direction: DVec3) -> Self {
        let length = direction.length();
        Self {
            origin: Event::ORIGIN,
            step: Event { t: -length, x: direction },
            wave: WaveVector::in_vacuum(1.0, direction / -length),
            start: Start::Eye,
        }
    }

    /// Light seen in a direction, of any length but 0, at an event in a vacuum.
    pub fn in_vacuum(origin: Event, direction: DVec3) -> Self {
        Self { origin, start: Start::Event, ..Self::from_eye(direction) }
    }

    /// Light seen in a direction, of any length but 0, at an event in a medium. `None` if no light
    /// in the medium comes from there.
    pub fn in_medium(origin: Event, direction: DVec3, medium: Medium) -> Option<Self> {
        let length = direction.length();
        let wave = medium.wave_along(direction / -length)?;
        let forward = medium.step(wave);
        let time = length / forward.x.length() * forward.t;
        Some(Self { origin, step: Event { t: -time, x: direction }, wave, start: Start::Event })
    }

    /// The times before the origin, in the frame of the camera, of a range of parameters.
    #[inline]
    pub fn times(&self, range: &Range<f64>) -> Range<f64> {
        -self.step.t * range.start..-self.step.t * range.end
    }

    /// Origin and step in the rest frame of a part.
    #[inline]
    pub fn in_part(&self, row: usize, frame: &RestFrame) -> (DVec3, DVec3) {
        match self.start {
            Start::Eye => (DVec3::ZERO, frame.light_to_rest(self.step.x)),
            Start::Surface { part, place } if part == row => {
                (place, frame.rest_from_camera(self.step).x)
            }
            _ => (frame.rest_from_camera(self.origin).x, frame.rest_from_camera(self.step).x),
        }
    }
}

/// The event at parameter `s` of a ray.
#[inline]
pub fn along(origin: Event, step: Event, s: f64) -> Event {
    Event { t: origin.t + s * step.t, x: origin.x + s * step.x }
}
