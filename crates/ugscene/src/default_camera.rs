//! The camera of a scene that has none: as near as everything is in the picture.

use glam::{DQuat, DVec3};

use crate::RelativeMotion;
use crate::camera_fit::{Frame, Place, Subject};
use crate::camera_options::{CameraError, CameraOptions, DEFAULT_VIEW_ANGLE, half_film, right_of};
use crate::{BodyId, FaceOrWire, Scene};

/// From the view centre to the eye, where z is up: from the front (−y), the right and above. No
/// axis is within [`CLEAR`] of it.
const TOWARD_EYE: DVec3 = DVec3::new(3.0, -4.0, 2.0);

/// The part of the picture's width, from a tenth to nine tenths, and of its height that is filled
/// at most. A picture of 16:9 from the distance for 4:3 has nine tenths of its height filled.
const FILLED: [f64; 2] = [0.8, 2.0 / 3.0];

/// The part of the picture's shorter side that the sphere around everything fills from the least
/// distance, which matters for what extends along the view.
const NEAREST_FILLED: f64 = 2.0;

/// Cosine of 40°: a body moving more directly toward the eye may be seen stretched over the eye at
/// high speed, since its rest-frame distance is the apparent one divided by D ≤ 1 / sin 40°, (P10).
const CLEAR: f64 = 0.766;

/// The camera for a scene without a camera and without an eye point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DefaultCamera {
    /// Eye point, scene coordinates.
    pub eye: DVec3,
    /// View centre, scene coordinates.
    pub center: DVec3,
    /// Full horizontal view angle, degrees.
    pub view_angle_deg: f64,
}

impl DefaultCamera {
    /// The default camera: from the front, the right and above, as near as everything is seen from
    /// a tenth to nine tenths of the width, and in two thirds of the height of the picture. It
    /// looks at the middle of what is seen, or at `options.center`. `None` if the eye point is
    /// known, the scene has a camera, or is empty.
    ///
    /// `size`: of the picture, of which only the aspect ratio matters. `motions`: of a body, each
    /// as in one of the pictures; none at rest. A moving body is fitted as it is seen when its
    /// middle is seen where it is at rest (`-in`). If one moves toward the eye, the eye is on
    /// another side; with `options.is_ahead` the eye is where they move to, and sees them as at
    /// rest.
    ///
    /// # Errors
    /// [`CameraError::ViewAngle`].
    pub fn new(
        scene: &Scene,
        options: &CameraOptions,
        size: [u32; 2],
        motions: impl Fn(BodyId) -> Vec<RelativeMotion>,
    ) -> Result<Option<Self>, CameraError> {
        let is_known = options.eye.is_some() || scene.stage.seen_geometry().is_some();
        if is_known || !scene.cameras.is_empty() || scene.vertices.is_empty() {
            return Ok(None);
        }
        let half = half_film(options, size)?;
        let mut points = points(scene);
        let (low, high) = bounds(&points);
        let origin = options.center.unwrap_or(low * 0.5 + high * 0.5);
        // Divided by the longest coordinate, against overflow and underflow of squares.
        let scale = longest(&points, origin);
        points.iter_mut().for_each(|(point, _)| *point = (*point - origin) / scale);
        let radius = points.iter().fold(0.0, |most: f64, (point, _)| most.max(point.length()));
        let radius = if radius > 0.0 { radius } else { 1.0 };
        let bodies = bodies(scene, &points, motions);
        let velocities =
            bodies.iter().flat_map(|(_, motions)| motions).map(|one| one.velocity().beta());
        let behind = if options.is_ahead { velocities.clone().sum::<DVec3>() } else { DVec3::ZERO };
        let (toward_eye, bodies) = if behind == DVec3::ZERO {
            (toward_eye(options.up, velocities), bodies)
        } else {
            // What comes toward the camera, as seen by one at rest in its place.
            let at_rest = bodies.iter().map(|(middle, _)| (*middle, Vec::new())).collect();
            (behind.normalize(), at_rest)
        };
        // At the least distance the sphere around everything is seen with the radius `tangent`.
        let tangent = NEAREST_FILLED * half[0].min(half[1]);
        let across = right_of(-toward_eye, up(options.up)).0;
        let frame = Frame {
            axes: [across, toward_eye.cross(across), toward_eye],
            filled: [FILLED[0] * half[0], FILLED[1] * half[1]],
            is_orthographic: options.is_orthographic,
            is_fixed: options.center.is_some(),
            nearest: radius * libm::hypot(1.0, tangent) / tangent,
        };
        let place = frame.fit(&Subject { points: &points, bodies: &bodies });
        // Coordinates near the largest number would put the eye at infinity.
        let far = (scale * place.distance).min(0.5 * f64::MAX);
        let unit = unit_of_rounding(far);
        let aim = origin + scale * frame.point(Place { distance: 0.0, ..place });
        let center = options.center.unwrap_or_else(|| rounded(aim, unit));
        let eye = rounded((aim + far * toward_eye).clamp(DVec3::MIN, DVec3::MAX), unit);
        let view_angle_deg = options.view_angle.map_or(DEFAULT_VIEW_ANGLE, |(across, _)| across);
        let is_valid = eye.is_finite() && center.is_finite() && eye != center;
        Ok(is_valid.then_some(Self { eye, center, view_angle_deg }))
    }
}

/// The positions and bodies of all vertices that are drawn; of all vertices if nothing is.
fn points(scene: &Scene) -> Vec<(DVec3, BodyId)> {
    /// The sagitta of polygons in place of round faces.
    const COARSE: f64 = 1e-2;
    if scene.has_rounds() {
        let mut scene = scene.clone();
        if crate::cut_rounds(&mut scene, |_, _, _| Some(COARSE)).is_ok() {
            return points(&scene);
        }
    }
    let mut bodies = vec![None; scene.vertices.len()];
    for FaceOrWire { contours, body, .. } in scene.drawn() {
        for corner in scene.contours.corners(contours) {
            bodies[corner.index()].get_or_insert(body);
        }
    }
    if scene.faces.is_empty() && scene.wires.is_empty() {
        bodies.fill(Some(scene.bodies.unstated()));
    }
    let vertices = scene.vertices.iter().zip(bodies);
    vertices.filter_map(|(vertex, body)| Some((vertex.position, body?))).collect()
}

const EMPTY: (DVec3, DVec3) = (DVec3::INFINITY, DVec3::NEG_INFINITY);

/// Corners of the bounding box.
fn bounds(points: &[(DVec3, BodyId)]) -> (DVec3, DVec3) {
    points.iter().fold(EMPTY, |(low, high), &(p, _)| (low.min(p), high.max(p)))
}

/// The middle of the bounding box of each body, and its motions, if it is drawn.
fn bodies(
    scene: &Scene,
    points: &[(DVec3, BodyId)],
    motions: impl Fn(BodyId) -> Vec<RelativeMotion>,
) -> Vec<(DVec3, Vec<RelativeMotion>)> {
    let mut boxes = vec![EMPTY; scene.bodies.len()];
    for &(point, body) in points {
        let (low, high) = &mut boxes[body.index()];
        (*low, *high) = (low.min(point), high.max(point));
    }
    let one = |(body, (low, high)): (BodyId, (DVec3, DVec3))| {
        if low.x <= high.x {
            (low.midpoint(high), motions(body))
        } else {
            (DVec3::ZERO, Vec::new())
        }
    };
    scene.bodies.ids().zip(boxes).map(one).collect()
}

/// The longest coordinate of a point relative to `center`; 1 for a single point.
fn longest(points: &[(DVec3, BodyId)], center: DVec3) -> f64 {
    let longest =
        points.iter().fold(0.0, |most: f64, (p, _)| most.max((*p - center).abs().max_element()));
    if longest > 0.0 { longest } else { 1.0 }
}

fn up(up: Option<DVec3>) -> DVec3 {
    up.map_or(DVec3::Z, |up| up.normalize_or(DVec3::Z))
}

/// The unit vector from the view centre to the eye: the first of four sides that no body moves
/// toward, or the one that they move toward least directly.
fn toward_eye(up_option: Option<DVec3>, velocities: impl IntoIterator<Item = DVec3>) -> DVec3 {
    let scene_from_side = DQuat::from_rotation_arc(DVec3::Z, up(up_option));
    let DVec3 { x, y, z } = TOWARD_EYE.normalize();
    let mut sides = [[x, y], [-x, -y], [-y, x], [y, -x]]
        .map(|[x, y]| (scene_from_side * DVec3::new(x, y, z), -1.0));
    for velocity in velocities {
        let direction = velocity.normalize_or_zero();
        for (toward_eye, nearest) in &mut sides {
            *nearest = direction.dot(*toward_eye).max(*nearest);
        }
    }
    let clear = sides.iter().find(|(_, nearest)| *nearest < CLEAR);
    let best = || sides.iter().min_by(|a, b| a.1.total_cmp(&b.1));
    clear.or_else(best).map_or(TOWARD_EYE.normalize(), |(toward_eye, _)| *toward_eye)
}

/// The power of ten that coordinates are rounded to, as exponent: a thousandth of the distance or
/// less, so that they are short and the picture is the same.
pub(crate) fn unit_of_rounding(distance: f64) -> i32 {
    let text = format!("{distance:e}");
    let exponent = text.split_once('e').and_then(|(_, exponent)| exponent.parse::<i32>().ok());
    exponent.unwrap_or(0) - 3
}

/// Each coordinate rounded to a multiple of 10 to the power `exponent`, where that is possible.
pub(crate) fn rounded(p: DVec3, exponent: i32) -> DVec3 {
    let power: f64 = format!("1e{}", exponent.abs()).parse().unwrap_or(1.0);
    let one = |x: f64| {
        let near =
            if exponent < 0 { (x * power).round() / power } else { (x / power).round() * power };
        // Not −0.
        if near.is_finite() { near + 0.0 } else { x }
    };
    DVec3::new(one(p.x), one(p.y), one(p.z))
}
