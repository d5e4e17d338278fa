//! A ground for a scene that has none.

use core::f64::consts::TAU;

use glam::DVec3;
use ugphysics::WorldLine;

use crate::{BodyId, Color, ColorId, ColorValue, Face, Scene, StatedMotion, Vertex};

/// Corners of the ground.
const CORNERS: usize = 128;

/// Its radius, as a multiple of the size of the scene: the horizon is then a third of a degree
/// below eye level.
const RADIUS: f64 = 400.0;

/// Display-encoded grey of the ground.
const GREY: f64 = 0.6;

/// Adds a level disc of grey below everything: at the lowest z of the vertices. It rests in the
/// frame of the scene, whatever moves. A scene without vertices stays as it is.
pub fn add_ground(scene: &mut Scene) {
    let Some((low, high)) = scene.bounds() else { return };
    let name = scene.names.add("ground");
    scene.colors.push(Color { name, value: ColorValue::Rgb([GREY; 3]), translucency: 0.0 });
    let color = Some(ColorId::from_index(scene.colors.len() - 1));
    let body: BodyId = scene.bodies.push(Some(name), WorldLine::REST);
    let motion = StatedMotion::inertial(ugphysics::Velocity::ZERO);
    scene.bodies.set_statement(body, name, motion, WorldLine::REST);
    let radius = RADIUS * (high - low).length();
    let middle = low.midpoint(high).with_z(low.z);
    let corner = |idx: usize| {
        let (sin, cos) = libm::sincos(TAU * idx as f64 / CORNERS as f64);
        middle + radius * DVec3::new(cos, sin, 0.0)
    };
    let corners: Vec<_> = (0..CORNERS)
        .map(|idx| {
            let name = scene.names.add_parts(&["ground:", &idx.to_string()]);
            scene.add_vertex(Vertex { name, ..Vertex::at(corner(idx), None) })
        })
        .collect();
    let contours = scene.contours.push_all([corners.into_iter()]);
    scene.faces.push(Face { name: Some(name), color, ..Face::polygon(contours, body) });
}
