//! T11: a sphere of radius 1, at distance 3 in its own frame, 0.9 c.

use glam::{DMat3, DVec3};

use super::{MeasuredQuantity, Picture};

/// The circle that is seen.
struct Circle {
    radius_deg: f64,
    /// Angle of its axis from the motion.
    axis_deg: f64,
    /// How much smaller the radius of a polyhedron may be, and how far its axis may be from this.
    /// The sagitta of a face is 1 − cos 1.5° = 3.5e-4 of the radius.
    polyhedron_deg: [f64; 2],
}

/// Seen perpendicular to the motion in the frame of the sphere: T11.01.
const ABEAM: Circle = Circle {
    radius_deg: 8.760_949_008,
    axis_deg: 152.810_381_4,
    polyhedron_deg: [3.5e-4 * 8.76, 0.0],
};

/// Seen at 30° from the motion in the frame of the sphere: T11.04. There the sagitta is 0.007°.
/// Aberration enlarges it 3.8 times on the side of the motion, and 1.05 times on the other. Half
/// the sum is missing in the radius, and half the difference is the error of the axis.
const LARGE: Circle = Circle {
    radius_deg: 41.646_166_84,
    axis_deg: 85.409_969_56,
    polyhedron_deg: [0.007 * 2.4, 0.007 * 1.4],
};

pub fn measure(picture: &Picture) -> Result<Vec<MeasuredQuantity>, String> {
    measure_circle(picture, &ABEAM)
}

pub fn measure_panorama(picture: &Picture) -> Result<Vec<MeasuredQuantity>, String> {
    measure_circle(picture, &LARGE)
}

fn measure_circle(picture: &Picture, expected: &Circle) -> Result<Vec<MeasuredQuantity>, String> {
    let outline = outline(picture);
    if outline.len() < 400 {
        return Err("no outline of a sphere is visible".to_string());
    }
    let (axis, radius_deg, gap_deg) = circle(&outline);
    let pixel_deg = picture.camera.pixel().to_degrees();
    let axis_deg = axis.angle_between(DVec3::X).to_degrees();
    // An edge is uncertain by half a pixel, and the mean of a thousand by a twentieth.
    let mean = 0.1 * pixel_deg;
    let [smaller_deg, turned_deg] = expected.polyhedron_deg;
    Ok(vec![
        MeasuredQuantity::new(
            "angular radius, degrees",
            radius_deg,
            expected.radius_deg,
            mean + smaller_deg,
        ),
        MeasuredQuantity::new(
            "axis of the circle from the motion, degrees",
            axis_deg,
            expected.axis_deg,
            mean + turned_deg,
        ),
        // In a panorama the other side would have the same angle.
        MeasuredQuantity::new(
            "azimuth of the axis, degrees",
            libm::atan2(axis.y, axis.x).to_degrees(),
            expected.axis_deg,
            mean + turned_deg,
        ),
        MeasuredQuantity::new(
            "axis of the circle, height, degrees",
            libm::asin(axis.z).to_degrees(),
            0.0,
            mean,
        ),
        MeasuredQuantity::new("largest distance from the circle, degrees", gap_deg, 0.0, pixel_deg),
    ])
}

/// Directions to the ends of the lit rows and columns.
fn outline(picture: &Picture) -> Vec<DVec3> {
    let [width, height] = picture.size();
    let rows = (0..height).filter_map(|y| Some((f64::from(y) + 0.5, picture.ends_of_row(y)?)));
    let columns = (0..width).filter_map(|x| Some((f64::from(x) + 0.5, picture.ends_of_column(x)?)));
    let in_rows = rows.flat_map(|(y, ends)| ends.map(|x| picture.camera.direction(x, y)));
    let in_columns = columns.flat_map(|(x, ends)| ends.map(|y| picture.camera.direction(x, y)));
    in_rows.chain(in_columns).collect()
}

/// Fits a circle by least squares, as the plane n·d = 1. Returns its axis, its angular radius, and
/// the largest distance from it, both in degrees.
fn circle(directions: &[DVec3]) -> (DVec3, f64, f64) {
    let outer = |d: &DVec3| DMat3::from_cols(d.x * *d, d.y * *d, d.z * *d);
    let matrix = directions.iter().map(outer).fold(DMat3::ZERO, |sum, matrix| sum + matrix);
    let normal = matrix.inverse() * directions.iter().sum::<DVec3>();
    let (axis, radius) = (normal.normalize(), libm::acos(1.0 / normal.length()));
    let gaps = directions.iter().map(|d| (d.angle_between(axis) - radius).abs());
    (axis, radius.to_degrees(), gaps.fold(0.0, f64::max).to_degrees())
}
