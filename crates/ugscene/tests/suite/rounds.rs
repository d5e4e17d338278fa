//! Round faces as polygons: closed, within the bound, and converging.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use glam::DVec3;
use ugscene::{FaceShape, Scene, cut_rounds};

fn cut(text: &str, sagitta: f64) -> Scene {
    let source = ugparse::Source::new("t.ug", text);
    let mut scene = ugparse::parse(&source, &ugparse::Options::default()).unwrap().scene;
    let n_faces = scene.faces.len();
    cut_rounds(&mut scene, |_, _, _| Some(sagitta)).unwrap();
    let mut rows: Vec<u32> = scene.faces.iter().map(|face| face.row_as_read).collect();
    rows.dedup();
    assert!(rows.into_iter().eq(0..n_faces as u32));
    assert!(scene.faces.iter().all(|face| face.shape == FaceShape::Polygon));
    scene
}

fn corners(scene: &Scene, face: usize) -> Vec<DVec3> {
    let corners = scene.contours.corners(scene.faces[face].contours.clone());
    corners.iter().map(|corner| scene.vertices[corner.index()].position).collect()
}

/// Volume, as seen from outside, and area.
fn volume_and_area(scene: &Scene) -> (f64, f64) {
    let mut sums = (0.0, 0.0);
    for face in 0..scene.faces.len() {
        let corners = corners(scene, face);
        for pair in corners[1..].windows(2) {
            let area = (pair[0] - corners[0]).cross(pair[1] - corners[0]) / 2.0;
            sums.0 += corners[0].dot(area) / 3.0;
            sums.1 += area.length();
        }
    }
    sums
}

/// Every edge has one face on each side.
fn is_closed(scene: &Scene) -> bool {
    let mut edges: BTreeMap<[[u64; 3]; 2], i32> = BTreeMap::new();
    for face in 0..scene.faces.len() {
        let corners = corners(scene, face);
        for (at, &from) in corners.iter().enumerate() {
            let to = corners[(at + 1) % corners.len()];
            let [from, to] = [from, to].map(|place| (place + 0.0).to_array().map(f64::to_bits));
            *edges.entry([from.min(to), from.max(to)]).or_default() +=
                if from < to { 1 } else { -1 };
        }
    }
    edges.values().all(|&sum| sum == 0)
}

#[test]
fn solids_are_closed_and_converge_within_the_bound() {
    // Volume and area of the exact shapes; the area of an ellipsoid is not compared.
    let cylinder = PI * 0.49 * 3.0;
    let cases = [
        ("sphere 1 2 3 2;", 32.0 / 3.0 * PI, Some(16.0 * PI)),
        ("cylinder 1 0 0 1 3 0 .7;", cylinder, Some(PI * (2.0 * 0.49 + 2.0 * 0.7 * 3.0))),
        ("def d; sphere 1 0 0 1; end; i (d -sx 3 -mz -ry 30 -ty 2);", 4.0 * PI, None),
        ("def d; cylinder 1 0 0 1 3 0 .7; end; i (d -mx -rz 20);", cylinder, None),
    ];
    for (text, volume, area) in cases {
        for sagitta in [3e-2, 1e-2, 1e-3, 1e-4] {
            let scene = cut(text, sagitta);
            assert!(is_closed(&scene), "{text}");
            // Polygons are between the shape and the one that is smaller by the sagitta.
            let (of_polygons, area_of_polygons) = volume_and_area(&scene);
            let squared = (1.0 - sagitta) * (1.0 - sagitta);
            let least = (1.0 - sagitta) * squared;
            let part = of_polygons / volume;
            assert!(part < 1.0 && part > least, "{text}, {sagitta}: volume {part}");
            if let Some(area) = area {
                let part = area_of_polygons / area;
                assert!(part < 1.0 && part > squared, "{text}, {sagitta}: area {part}");
            }
        }
    }
}

#[test]
fn polygons_of_a_sphere_are_flat_and_no_farther_than_the_sagitta() {
    for sagitta in [5e-2, 1e-3] {
        let scene = cut("sphere 1 2 3 2;", sagitta);
        let mut farthest = 0.0_f64;
        for face in 0..scene.faces.len() {
            let corners = corners(&scene, face);
            let center = corners.iter().sum::<DVec3>() / corners.len() as f64;
            let normal = ugscene::unit_normal(corners.iter().copied());
            let distance = normal.dot(center - DVec3::new(1.0, 2.0, 3.0)) / 2.0;
            assert!(corners.iter().all(|corner| normal.dot(*corner - center).abs() < 1e-12));
            farthest = farthest.max(1.0 - distance);
        }
        assert!(farthest <= sagitta && farthest > 0.5 * sagitta, "{farthest} of {sagitta}");
        for vertex in &scene.vertices {
            let normal = vertex.normal.unwrap();
            assert!((vertex.position - DVec3::new(1.0, 2.0, 3.0) - 2.0 * normal).length() < 1e-12);
        }
    }
}

#[test]
fn too_many_polygons_are_refused() {
    let source = ugparse::Source::new("t.ug", "def d; sphere 0 0 0 1; end; a (d) 200000 -tx 3;");
    let mut scene = ugparse::parse(&source, &ugparse::Options::default()).unwrap().scene;
    let before = scene.clone();
    let error = cut_rounds(&mut scene, |_, _, _| Some(1e-2)).unwrap_err();
    assert!(error.to_string().contains("polygons"), "{error}");
    assert_eq!(scene.faces, before.faces);
}
