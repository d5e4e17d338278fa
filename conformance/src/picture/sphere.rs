//! T11: radius 1, distance 3 abeam in its own frame, 0.9 c.

use glam::{DMat3, DVec3};

use super::{Measured, Sight};

const RADIUS_DEG: f64 = 8.760_949_008;
const AXIS_DEG: f64 = 152.810_381_4;

/// What the middles of the faces of a polyhedron may be inside the sphere, relative to its radius: 1 − cos 1.5°.
const POLYHEDRON: f64 = 3.5e-4;

pub fn measure(sight: &Sight) -> Result<Vec<Measured>, String> {
    let outline = outline(sight);
    if outline.len() < 400 {
        return Err("no outline of a sphere is found".to_string());
    }
    let (axis, radius_deg, gap_deg) = circle(&outline);
    let pixel_deg = sight.camera.pixel().to_degrees();
    let axis_deg = axis.angle_between(DVec3::X).to_degrees();
    // An edge is known to half a pixel, and the mean of a thousand to a twentieth.
    let mean = 0.1 * pixel_deg;
    Ok(vec![
        Measured::new("angular radius, degrees", radius_deg, RADIUS_DEG, mean + POLYHEDRON * RADIUS_DEG),
        Measured::new("axis of the circle from the motion, degrees", axis_deg, AXIS_DEG, mean),
        Measured::new("axis of the circle, height, degrees", libm::asin(axis.z).to_degrees(), 0.0, mean),
        Measured::new("largest distance from the circle, degrees", gap_deg, 0.0, pixel_deg),
    ])
}

/// Directions to the ends of rows and columns.
fn outline(sight: &Sight) -> Vec<DVec3> {
    let [width, height] = sight.size();
    let rows = (0..height).filter_map(|y| Some((f64::from(y) + 0.5, sight.ends_of_row(y)?)));
    let columns = (0..width).filter_map(|x| Some((f64::from(x) + 0.5, sight.ends_of_column(x)?)));
    let in_rows = rows.flat_map(|(y, ends)| ends.map(|x| sight.camera.direction(x, y)));
    let in_columns = columns.flat_map(|(x, ends)| ends.map(|y| sight.camera.direction(x, y)));
    in_rows.chain(in_columns).collect()
}

/// The circle that lies best, the plane n·d = 1 by least squares: its axis, its angular radius, and the largest distance
/// from it, in degrees.
fn circle(directions: &[DVec3]) -> (DVec3, f64, f64) {
    let outer = |d: &DVec3| DMat3::from_cols(d.x * *d, d.y * *d, d.z * *d);
    let matrix = directions.iter().map(outer).fold(DMat3::ZERO, |sum, matrix| sum + matrix);
    let normal = matrix.inverse() * directions.iter().sum::<DVec3>();
    let (axis, radius) = (normal.normalize(), libm::acos(1.0 / normal.length()));
    let gaps = directions.iter().map(|d| (d.angle_between(axis) - radius).abs());
    (axis, radius.to_degrees(), gaps.fold(0.0, f64::max).to_degrees())
}
