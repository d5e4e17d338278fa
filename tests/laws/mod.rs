//! Physical laws, tested on the text and pictures of the whole pipe.
//!
//! Numbers named T08, T11… are facts listed at the end of `docs/physics.md`.

mod beams;
mod colours;
mod culling;
mod directions;
mod edges;
mod exact;
mod fall_off;
mod labels;
mod lights;
mod linear_light;
mod moving_camera;
mod notice;
mod rest;
mod silhouettes;

use std::collections::HashMap;

use glam::DVec3;
use ugscene::{Color, Scene, Vertex};
use ugtesting::Random;

/// Triangles with corners anywhere within 10 of the origin, `n` of them. Vertices are called `a0`,
/// `b0`, `c0`, `a1`, ….
fn triangles(random: &mut Random, n: usize, color: &str) -> (String, HashMap<String, DVec3>) {
    let mut text = String::new();
    let mut points = HashMap::new();
    for row in 0..n {
        for corner in ["a", "b", "c"] {
            let (name, p) = (format!("{corner}{row}"), random.in_cube(10.0));
            text += &format!("v {name} {:?} {:?} {:?};\n", p.x, p.y, p.z);
            points.insert(name, p);
        }
        text += &format!("f (a{row} b{row} c{row}) {color};\n");
    }
    (text, points)
}

/// The vertices with a name in `points`.
fn named<'s>(scene: &'s Scene, points: &HashMap<String, DVec3>) -> HashMap<String, &'s Vertex> {
    let vertices =
        scene.vertices.iter().map(|vertex| (scene.names.get(vertex.name).to_string(), vertex));
    let found: HashMap<String, &Vertex> =
        vertices.filter(|(name, _)| points.contains_key(name)).collect();
    assert_eq!(found.len(), points.len(), "every vertex keeps its name");
    found
}

/// The colour of a vertex.
fn color_of<'s>(scene: &'s Scene, vertex: &Vertex) -> &'s Color {
    &scene.colors[vertex.color.expect("every vertex in use has a colour").index()]
}
