//! Bodies and their vertices.

use ugscene::{separate_bodies, vertex_bodies};

use super::parse;

#[test]
fn shared_vertices_are_copied_once_for_each_body() {
    let mut scene = parse(
        "v a 0 0 0; v b 1 0 0; v c 0 1 0; v a_2 9 9 9;
         f x (a b c) <0.5 0 0>; f y (c b a) <0 0.5 0>; f z (a b c) <0 0.5 0>; w (a b);",
    );
    separate_bodies(&mut scene);
    assert_eq!(scene.vertices.len(), 4 + 3 + 2);
    let names: Vec<&str> = scene.vertices[4..].iter().map(|v| scene.names.get(v.name)).collect();
    assert_eq!(names, ["c_2", "b_2", "a_3", "a_4", "b_3"]);
    let bodies = vertex_bodies(&scene);
    for face in &scene.faces {
        for corner in scene.contours.corners(face.contours.clone()) {
            assert_eq!(bodies[corner.index()], face.body);
        }
    }
}

#[test]
fn one_body_is_left_alone() {
    let before =
        parse("v a 0 0 0; v b 1 0 0; v c 0 1 0; f (a b c) <0.5 0 0>; f (c b a) <0.5 0 0>;");
    let mut after = before.clone();
    separate_bodies(&mut after);
    assert_eq!(ugparse::write(&before), ugparse::write(&after));
}
