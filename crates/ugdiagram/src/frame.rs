//! Frames of reference.

use glam::DVec3;
use ugphysics::{Event, Lorentz};

/// An inertial frame of reference.
///
/// Events are given in the frame of the camera, with the event of the eye as origin.
#[derive(Clone, Debug, PartialEq)]
pub struct ReferenceFrame {
    /// Its name.
    pub name: String,
    from_camera: Lorentz,
    origin: Event,
    start: Event,
}

impl ReferenceFrame {
    /// The frame with these coordinates: `from_camera` turns differences, and the event `origin`
    /// has the coordinates `start`.
    pub fn new(name: String, from_camera: Lorentz, origin: Event, start: Event) -> Self {
        Self { name, from_camera, origin, start }
    }

    /// The coordinates of an event in this frame. Eq. (P7)
    pub fn coordinates(&self, event: Event) -> Event {
        self.from_camera.apply(event - self.origin) + self.start
    }

    /// The event with these coordinates.
    pub fn event(&self, coordinates: Event) -> Event {
        self.from_camera.inverse().apply(coordinates - self.start) + self.origin
    }

    /// The difference of two events in this frame.
    pub fn components(&self, difference: Event) -> Event {
        self.from_camera.apply(difference)
    }

    /// The four-velocity of this frame, in the frame of the camera.
    pub fn four_velocity(&self) -> Event {
        self.from_camera.inverse().apply(Event { t: 1.0, x: DVec3::ZERO })
    }

    /// Coordinates in this frame from those in the frame of the camera, for differences.
    pub fn from_camera(&self) -> Lorentz {
        self.from_camera
    }
}
