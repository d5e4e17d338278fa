//! Normals and angles of polygons.

use glam::DVec3;
use ugscene::{VertexId, corner_angle, seen_normal, shading_normal, smooth_normals};

use super::parse;

/// Angles and unit normals do not depend on the size of a triangle.
#[test]
fn triangles_of_any_size_have_angles_and_normals() {
    for size in [1e-300, 1e-150, 1.0, 1e150, 1e300] {
        let positions = [DVec3::ZERO, DVec3::X * size, DVec3::Y * size];
        let contour = [0, 1, 2].map(VertexId);
        let angle = corner_angle(&contour, 0, &positions);
        assert!((angle - std::f64::consts::FRAC_PI_2).abs() < 1e-15, "{size}: {angle}");
        let normal = seen_normal(positions.into_iter(), DVec3::Z);
        assert!(normal.distance(DVec3::Z) < 1e-15, "{size}: {normal}");
        let normal = shading_normal(Some(DVec3::Z * size), DVec3::Z);
        assert!(normal.distance(DVec3::Z) < 1e-15, "{size}: {normal}");
    }
    for size in [5e-324, 1e200, f64::MAX] {
        let positions = [DVec3::ZERO, DVec3::X * size, DVec3::Y * -size];
        assert!(corner_angle(&[0, 1, 2].map(VertexId), 1, &positions).is_finite(), "{size}");
    }
}

#[test]
fn a_cube_corner_points_along_the_diagonal_however_its_faces_are_cut() {
    // One side is split into two triangles at the corner, which changes the mean if weighted by
    // count, but not if weighted by angle.
    let text = "v o 0 0 0; v x 1 0 0; v y 0 1 0; v z 0 0 1; v xy 1 1 0; v yz 0 1 1; v zx 1 0 1;
        f (o y xy); f (o xy x); f (o z yz y); f (o x zx z);";
    let scene = parse(text);
    let positions: Vec<DVec3> = scene.vertices.iter().map(|v| v.position).collect();
    let corner = smooth_normals(&scene, &positions)[0];
    let diagonal = DVec3::NEG_ONE / 3f64.sqrt();
    assert!((corner - diagonal).length() < 1e-15, "{corner}");
}
