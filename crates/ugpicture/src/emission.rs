//! Emission events of the light seen in the picture.

use glam::{DQuat, DVec3};
use ugphysics::{Velocity, aberrate, doppler_at, length};
use ugscene::{BodyId, RestFrames, Scene, ShownEffects, View};

/// A surface at a sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceSample {
    /// Depth key: 1/depth in perspective, −depth in orthographic projection. Larger is nearer.
    pub key: f32,
    /// Row of the face in the scene; wires are counted after the faces.
    pub item: u32,
}

/// The event at which the light seen at a sample was emitted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Emission {
    /// Position relative to the eye, in the frame of the camera.
    pub place: DVec3,
    /// Depth along the view; the distance if the camera is no pinhole.
    pub depth: f64,
    /// Time in the frame of the camera; the picture is taken at 0.
    pub time: f64,
    /// Velocity of the body.
    pub velocity: Velocity,
    /// Own time of a body on a world line.
    pub own_time: Option<f64>,
    /// Turns rest coordinates of the body into the axes of the scene, see
    /// [`ugphysics::RestFrame::scene_from_boosted`].  Eq. (P25)
    pub scene_from_axes: DQuat,
    /// How the light is seen if it comes to the eye in a transparent medium; `None` in a vacuum.
    pub in_medium: Option<MediumLight>,
}

/// Light that comes to the eye in a transparent medium, in which neither (P6) nor (P10) holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MediumLight {
    /// Doppler factor: the frequency at the eye divided by that in the rest frame of the body.
    pub doppler: f64,
    /// Unit vector against the light, in the rest frame of the body and the axes of the scene.
    pub rest_direction: DVec3,
}

impl Emission {
    /// Unit vector to what is seen, in the rest frame of the body and the axes of the scene.
    /// Eq. (P6), (P25)
    pub fn rest_direction(&self) -> DVec3 {
        let in_vacuum = || self.scene_from_axes * aberrate(self.place, self.velocity);
        self.in_medium.map_or_else(in_vacuum, |light| light.rest_direction)
    }

    /// Doppler factor.  Eq. (P10)
    pub fn doppler(&self) -> f64 {
        self.in_medium.map_or_else(|| doppler_at(self.place, self.velocity), |light| light.doppler)
    }
}

/// The surface at the middle of a pixel: the row of the face in the scene (wires are counted after
/// the faces), and the emission event.
pub type SeenItem = (u32, Emission);

/// Finds emission events from samples.
pub struct Emissions<'a> {
    scene: &'a Scene,
    view: &'a View,
    frames: &'a RestFrames,
    has_flight_time: bool,
}

impl<'a> Emissions<'a> {
    /// `view`: must have samples as its picture coordinates.
    pub fn new(scene: &'a Scene, view: &'a View, frames: &'a RestFrames) -> Self {
        Self { scene, view, frames, has_flight_time: ShownEffects::of(scene).flight_time }
    }

    /// The emission event seen at the middle of a sample.
    pub fn at(&self, [column, row]: [u32; 2], seen: SurfaceSample) -> Emission {
        let key = f64::from(seen.key);
        let depth = if self.view.is_perspective { 1.0 / key } else { -key };
        let body = self.body(seen.item);
        let place = self.view.point([f64::from(column) + 0.5, f64::from(row) + 0.5], depth);
        let time = if self.has_flight_time { -length(place) } else { 0.0 };
        let (velocity, own_time) = self.frames.at_event(body, ugscene::seen_event(place));
        Emission {
            place,
            depth,
            time,
            velocity,
            own_time,
            scene_from_axes: self.frames.of(body).scene_from_boosted(),
            in_medium: None,
        }
    }

    fn body(&self, item: u32) -> BodyId {
        let (item, n_faces) = (item as usize, self.scene.faces.len());
        let body = match self.scene.faces.get(item) {
            Some(face) => Some(face.body),
            None => self.scene.wires.get(item - n_faces).map(|wire| wire.body),
        };
        // Everything drawn is a face or a wire.
        body.unwrap_or(self.scene.bodies.unstated())
    }

    /// The surface at the middle of a pixel, for channels. `seen`: the surfaces at the
    /// middles of pixels, row after row, in pictures of `width` pixels across with `samples` ×
    /// `samples` samples each.
    pub fn at_pixel(
        &self,
        [width, samples]: [u32; 2],
        seen: &[Option<SurfaceSample>],
        idx: usize,
    ) -> Option<SeenItem> {
        let surface = seen[idx]?;
        // The sample nearest to the centre; ties go to the lower-right one. A picture has fewer
        // than 2^32 pixels.
        let middle = [idx % width as usize, idx / width as usize]
            .map(|pixel| pixel as u32 * samples + samples / 2);
        Some((surface.item, self.at(middle, surface)))
    }
}
