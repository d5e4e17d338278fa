//! The scene and camera of annotations.

use ugphysics::Velocity;
use ugscene::{BodyId, CameraOptions, RestFrames, Scene, View};

use crate::error::Error;

/// A scene and its camera at one sample a pixel.
pub struct SeenScene<'a> {
    /// The scene, whose vertices are part of one body each.
    pub scene: &'a Scene,
    /// The camera; its picture coordinates are pixels.
    pub view: View,
    /// The rest frames of its bodies.
    pub frames: RestFrames,
    size: [u32; 2],
}

impl<'a> SeenScene<'a> {
    /// The scene in a picture of `size` pixels.
    pub fn new(scene: &'a Scene, camera: &CameraOptions, size: [u32; 2]) -> Result<Self, Error> {
        let view = View::new(scene, camera, size)?;
        Ok(Self { scene, view, frames: RestFrames::new(scene), size })
    }

    /// The velocities of the bodies of its faces.
    pub fn velocities(&self) -> Vec<Velocity> {
        velocities(self.scene, &self.frames)
    }

    /// True if a body moves relative to the camera.
    pub fn is_moving(&self, body: BodyId) -> bool {
        self.frames.world_line(body).is_some() || !self.frames.velocity(body).is_zero()
    }

    /// Columns and rows of the picture.
    pub fn size(&self) -> [f64; 2] {
        self.size.map(f64::from)
    }
}

/// The velocities of the bodies of faces, each once where faces of one velocity follow each other.
pub fn velocities(scene: &Scene, frames: &RestFrames) -> Vec<Velocity> {
    let mut velocities: Vec<Velocity> = scene.faces.iter().map(|face| frames.velocity(face.body)).collect();
    velocities.dedup();
    velocities
}
