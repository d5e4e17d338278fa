//! The scene and camera of annotations, and lines added to them.

use glam::DVec3;
use ugimage::figure::Point;
use ugphysics::Velocity;
use ugscene::{CameraOptions, RestFrames, Scene, Vertex, View, Wire};

use super::VisibleWires;
use crate::error::Error;
use crate::options::PictureOptions;

/// A scene and its camera at one sample a pixel.
pub struct SeenScene<'a, E> {
    /// The scene, whose vertices are part of one body each.
    pub scene: &'a Scene,
    /// The camera; its picture coordinates are pixels.
    pub view: View,
    /// The rest frames of its bodies.
    pub frames: RestFrames,
    /// Columns and rows of the picture.
    pub size: [f64; 2],
    camera: CameraOptions,
    wires: &'a VisibleWires<'a, E>,
}

impl<'a, E: From<Error>> SeenScene<'a, E> {
    /// `view`: from the eye of the picture, in any units; `options`: of the picture.
    pub fn new(
        scene: &'a Scene,
        view: &View,
        options: &PictureOptions,
        wires: &'a VisibleWires<'a, E>,
    ) -> Result<Self, E> {
        // The camera must stay, although lines change what is in the scene.
        let center = view.eye + view.distance * view.forward;
        let camera =
            CameraOptions { eye: Some(view.eye), center: Some(center), ..options.camera.clone() };
        let view = View::new(scene, &camera, options.size).map_err(Error::from)?;
        let size = options.size.map(f64::from);
        Ok(Self { scene, view, frames: RestFrames::new(scene), size, camera, wires })
    }

    /// The parts in the picture of lines at rest that the faces of a scene, seen by this camera, do
    /// not hide. `lines`: their ends relative to the eye.
    pub fn visible(&self, scene: Scene, lines: &[[DVec3; 2]]) -> Result<Vec<[Point; 2]>, E> {
        (self.wires)(&with_wires(scene, self.view.eye, lines), &self.camera)
    }

    /// The place in the picture of a point before the eye, relative to it.
    pub fn place(&self, point: DVec3) -> Point {
        let place = self.view.place(point);
        let scale = if self.view.is_perspective { place.z } else { 1.0 };
        [place.x / scale, place.y / scale]
    }
}

/// A scene with these lines as its only wires.
fn with_wires(mut scene: Scene, eye: DVec3, lines: &[[DVec3; 2]]) -> Scene {
    let name = scene.names.add("line");
    let body = scene.bodies.unstated();
    scene.wires.clear();
    for ends in lines {
        let ends = ends.map(|end| {
            if !scene.rest.is_empty() {
                scene.rest.push(end);
            }
            scene.add_vertex(Vertex {
                name,
                position: eye + end,
                color: None,
                normal: None,
                uv: None,
            })
        });
        let contours = scene.contours.push_all([ends]);
        scene.wires.push(Wire { name: None, contours, color: None, body, text: None });
    }
    scene
}

/// The velocities of the bodies of faces, each once where faces of one velocity follow each other.
pub fn velocities(scene: &Scene) -> Vec<Velocity> {
    let frames = RestFrames::new(scene);
    let mut velocities: Vec<Velocity> =
        scene.faces.iter().map(|face| frames.velocity(face.body)).collect();
    velocities.dedup();
    velocities
}
