//! The camera of a scene that has none: as near as everything is in the picture.

use glam::{DQuat, DVec3};
use ugparse::{BodyId, Scene};

use crate::camera_fit::{Frame, Place, Subject};
use crate::camera_options::{CameraError, CameraOptions, DEFAULT_VIEW_ANGLE, half_film};
use crate::relative_motion::RelativeMotion;

/// From the view centre to the eye, where z is up: from the front (−y), the right and above. No
/// axis is within [`CLEAR`] of it.
const TOWARD_EYE: DVec3 = DVec3::new(3.0, -4.0, 2.0);

/// The part of the picture's width, from a tenth to nine tenths, and of its height that is filled at
/// most. A picture of 16:9 from the distance for 4:3 has nine tenths of its height filled.
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
    /// a tenth to nine tenths of the width, and in two thirds of the height of the picture. It looks at the middle of
    /// what is seen, or at `options.center`. `None` if the eye point is known, the scene has a
    /// camera, or is empty.
    ///
    /// `size`: of the picture, of which only the aspect ratio matters. `motions`: of a body, each as
    /// in one of the pictures; none at rest. A moving body is fitted as it is seen when its middle
    /// is seen where it is at rest (`-in`). If one moves toward the eye, the eye is on another side.
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
        let velocities = bodies.iter().flat_map(|(_, motions)| motions).map(|one| one.velocity().beta());
        let toward_eye = toward_eye(options.up, velocities);
        // At the least distance the sphere around everything is seen with the radius `tangent`.
        let tangent = NEAREST_FILLED * half[0].min(half[1]);
        let across = (-toward_eye).cross(up(options.up)).normalize();
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
    let faces = scene.faces.iter().map(|face| (face.contours.clone(), face.body));
    let drawn = faces.chain(scene.wires.iter().map(|wire| (wire.contours.clone(), wire.body)));
    let mut bodies = vec![None; scene.vertices.len()];
    for (contours, body) in drawn {
        for corner in scene.contours.corners(contours) {
            bodies[corner.index()].get_or_insert(body);
        }
    }
    if scene.faces.is_empty() && scene.wires.is_empty() {
        bodies.fill(Some(BodyId::UNSTATED));
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
        if low.x <= high.x { (low.midpoint(high), motions(body)) } else { (DVec3::ZERO, Vec::new()) }
    };
    scene.bodies.ids().zip(boxes).map(one).collect()
}

/// The longest coordinate of a point relative to `center`; 1 for a single point.
fn longest(points: &[(DVec3, BodyId)], center: DVec3) -> f64 {
    let longest = points.iter().fold(0.0, |most: f64, (p, _)| most.max((*p - center).abs().max_element()));
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
    let mut sides =
        [[x, y], [-x, -y], [-y, x], [y, -x]].map(|[x, y]| (scene_from_side * DVec3::new(x, y, z), -1.0));
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
fn unit_of_rounding(distance: f64) -> i32 {
    let text = format!("{distance:e}");
    let exponent = text.split_once('e').and_then(|(_, exponent)| exponent.parse::<i32>().ok());
    exponent.unwrap_or(0) - 3
}

/// Each coordinate rounded to a multiple of 10 to the power `exponent`, where that is possible.
fn rounded(p: DVec3, exponent: i32) -> DVec3 {
    let power: f64 = format!("1e{}", exponent.abs()).parse().unwrap_or(1.0);
    let one = |x: f64| {
        let near = if exponent < 0 { (x * power).round() / power } else { (x / power).round() * power };
        // Not −0.
        if near.is_finite() { near + 0.0 } else { x }
    };
    DVec3::new(one(p.x), one(p.y), one(p.z))
}

#[cfg(test)]
mod tests {
    use ugpipe::Words;

    use super::*;
    use crate::{CameraPoint, Geometry, MotionOptions, PlacedBodies, RestPosition, View};

    fn camera(text: &str, options: &CameraOptions, velocities: &[DVec3]) -> Option<DefaultCamera> {
        let source = ugparse::Source::new("t.ug", text);
        let scene = ugparse::parse(&source, &ugparse::Options::default()).unwrap().scene;
        let motion = |beta: &DVec3| {
            RelativeMotion::new(ugphysics::Velocity::from_beta(*beta).unwrap(), Geometry::default())
        };
        DefaultCamera::new(&scene, options, [4, 3], |_| velocities.iter().map(motion).collect()).unwrap()
    }

    fn square(center: DVec3, half: f64) -> String {
        let corner = |x: f64, y: f64| center + half * DVec3::new(x, y, 0.0);
        let corners = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
        let statements = corners.iter().enumerate().map(|(i, p)| format!("v v{i} {} {} {};", p.x, p.y, p.z));
        statements.collect::<String>() + "f (v0 v1 v2 v3);"
    }

    /// However large the coordinates are, the eye is not the view centre, and no distance
    /// overflows.
    #[test]
    fn the_largest_scenes_have_a_camera() {
        let scene = "v a 0 -1.7e308 1.7e308; v b -1.7e308 1e308 0; v c 1.7e308 1.7e308 1.7e308; f (a b c);";
        for velocities in [&[][..], &[0.9 * DVec3::Y]] {
            let DefaultCamera { eye, center, .. } =
                camera(scene, &CameraOptions::default(), velocities).unwrap();
            assert!(crate::view_distance(eye, center).is_ok(), "{eye} {center}");
        }
    }

    /// The least and greatest place of what is seen in the picture, as parts of its width and height.
    fn seen_parts(scene: &Scene, view: &View, seen: &[DVec3]) -> [[f64; 2]; 2] {
        assert_eq!(scene.vertices.len(), seen.len());
        let part = |p: &DVec3| {
            let CameraPoint { x, y, z } = view.place(*p);
            assert!(z > 0.0);
            [x / z / 400.0, y / z / 300.0]
        };
        let grow = |[low, high]: [f64; 2], x: f64| [low.min(x), high.max(x)];
        seen.iter().map(part).fold([[f64::INFINITY, f64::NEG_INFINITY]; 2], |[across, down], [x, y]| {
            [grow(across, x), grow(down, y)]
        })
    }

    /// Least and greatest place across and down.
    const ENDS: [[f64; 2]; 2] = [[0.1, 0.9], [1.0 / 6.0, 5.0 / 6.0]];

    /// Everything is within a tenth and nine tenths of the width, and in two thirds of the height.
    fn is_within(parts: [[f64; 2]; 2], tolerance: f64) -> bool {
        let is_inside =
            |([low, high], end): ([f64; 2], [f64; 2])| low > end[0] - tolerance && high < end[1] + tolerance;
        parts.into_iter().zip(ENDS).all(is_inside)
    }

    /// It reaches from one of these ends to the other in one direction.
    fn fills(parts: [[f64; 2]; 2], tolerance: f64) -> bool {
        let reaches =
            |([low, high], end): ([f64; 2], [f64; 2])| low < end[0] + tolerance && high > end[1] - tolerance;
        parts.into_iter().zip(ENDS).any(reaches)
    }

    /// The corners of a box and of its sides, so that motion bends its edges.
    fn long_box(half: DVec3, center: DVec3) -> String {
        let mut text = String::new();
        for at in 0..27 {
            let p = center + half * DVec3::new(f64::from(at % 3), f64::from(at / 3 % 3), f64::from(at / 9))
                - half;
            text += &format!("v v{at} {:?} {:?} {:?};", p.x, p.y, p.z);
        }
        let names: Vec<String> = (0..27).map(|at| format!("v{at}")).collect();
        text + &format!("w ({});", names.join(" "))
    }

    const BOXES: [(DVec3, DVec3); 6] = [
        (DVec3::new(1.0, 1.0, 1.0), DVec3::ZERO),
        (DVec3::new(8.0, 1.0, 0.5), DVec3::new(7.0, -8.0, 9.0)),
        (DVec3::new(1e-3, 9e-3, 1e-3), DVec3::new(0.7, 0.0, 0.0)),
        (DVec3::new(1e6, 1e6, 1e7), DVec3::splat(3e7)),
        (DVec3::new(3e-200, 1e-200, 1e-200), DVec3::ZERO),
        (DVec3::new(1e290, 3e290, 1e290), DVec3::ZERO),
    ];

    #[test]
    fn what_is_seen_fills_the_picture() {
        let mut n_cases = 0;
        for (half, center) in BOXES {
            for angle in [20.0, 60.0, 110.0] {
                for up in [None, Some(DVec3::Y)] {
                    let options =
                        CameraOptions { view_angle: Some((angle, None)), up, ..CameraOptions::default() };
                    let source = ugparse::Source::new("t.ug", long_box(half, center));
                    let scene = ugparse::parse(&source, &ugparse::Options::default()).unwrap().scene;
                    let view = View::new(&scene, &options, [400, 300]).unwrap();
                    let seen: Vec<DVec3> = scene.vertices.iter().map(|v| v.position - view.eye).collect();
                    // The camera is rounded to a thousandth of the distance.
                    let tolerance = 4e-3 / libm::tan(angle.to_radians() / 2.0);
                    let parts = seen_parts(&scene, &view, &seen);
                    assert!(is_within(parts, tolerance), "{half} {angle}: {parts:?}");
                    // With a wide angle, what extends along the view is seen from the least distance.
                    let is_long = half != DVec3::splat(half.x);
                    assert!(angle > 20.0 && is_long || fills(parts, tolerance), "{half} {angle}: {parts:?}");
                    n_cases += 1;
                }
            }
        }
        assert_eq!(n_cases, 36);
    }

    #[test]
    fn a_body_in_motion_is_fitted_as_it_is_seen() {
        let (mut n_filled, mut n_cases) = (0, 0);
        for (half, center) in &BOXES[..4] {
            for beta in [DVec3::X, DVec3::Y, -DVec3::Y, DVec3::Z, DVec3::new(-0.6, 0.0, 0.8)] {
                for speed in [0.3, 0.9, 0.999] {
                    let source = ugparse::Source::new("t.ug", long_box(*half, *center));
                    let mut scene = ugparse::parse(&source, &ugparse::Options::default()).unwrap().scene;
                    let options = MotionOptions {
                        velocity: Some(speed * beta),
                        in_place: true,
                        ..MotionOptions::default()
                    };
                    let camera = CameraOptions::default();
                    let placed = PlacedBodies::new(&mut scene, &options, &camera, [400, 300]).unwrap();
                    let view = View::new(&scene, &camera, [400, 300]).unwrap();
                    let bodies = placed.bodies.iter().map(|body| &placed.motions[body.index()]);
                    let rest = placed.rest_positions(&scene);
                    let seen: Vec<DVec3> =
                        rest.into_iter().zip(bodies).map(|(p, m)| m.seen(RestPosition(p)).0).collect();
                    let parts = seen_parts(&scene, &view, &seen);
                    assert!(is_within(parts, 1e-2), "{half} {beta} {speed}: {parts:?}");
                    (n_filled, n_cases) = (n_filled + usize::from(fills(parts, 1e-2)), n_cases + 1);
                }
            }
        }
        // What is seen nearly from its end is seen from the least distance.
        assert!(n_cases == 60 && n_filled * 10 > n_cases * 8, "{n_filled} of {n_cases}");
    }

    /// A needle that points at the eye is not seen from its tip.
    #[test]
    fn the_eye_keeps_its_distance() {
        let found = camera("v a 0 0 0; v b 3 -4 2; w (a b);", &CameraOptions::default(), &[]).unwrap();
        let (distance, length) = ((found.eye - found.center).length(), 29f64.sqrt());
        assert!((0.9..2.0).contains(&(distance / length)), "{found:?}");
    }

    #[test]
    fn what_is_given_holds() {
        let options = CameraOptions::default;
        let text = square(DVec3::ZERO, 1.0);
        assert!(camera(&format!("{text} cam -va 40 40;"), &options(), &[]).is_none());
        assert!(camera(&text, &CameraOptions { eye: Some(DVec3::X), ..options() }, &[]).is_none());
        assert!(camera("c red 1 0;", &options(), &[]).is_none());
        let aside = CameraOptions { center: Some(DVec3::new(0.1, 2.0, 0.3)), ..options() };
        assert_eq!(camera(&text, &aside, &[]).unwrap().center, DVec3::new(0.1, 2.0, 0.3));
        // With y up, the front is +z, as in most mesh formats.
        let found = camera(&text, &CameraOptions { up: Some(DVec3::Y), ..options() }, &[]).unwrap();
        assert!(found.eye.z > found.eye.x && found.eye.x > found.eye.y && found.eye.y > 0.0, "{found:?}");
        // A vertex that nothing uses is not part of the picture.
        assert_eq!(
            camera(&format!("{text} v far 1e9 0 0;"), &options(), &[]),
            camera(&text, &options(), &[])
        );
    }

    #[test]
    fn nothing_moves_straight_at_the_eye() {
        let text = square(DVec3::ZERO, 1.0);
        let at_rest = camera(&text, &CameraOptions::default(), &[]).unwrap();
        for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
            for velocity in [0.9 * axis, -0.9 * axis] {
                let moving = camera(&text, &CameraOptions::default(), &[velocity]).unwrap();
                let [one, other] = [at_rest, moving].map(|found| (found.eye - found.center).normalize());
                assert!(one.dot(other) > 0.999_99, "{moving:?}");
            }
        }
        let toward = at_rest.eye.normalize();
        let other = camera(&text, &CameraOptions::default(), &[0.5 * toward]).unwrap();
        assert!(other.eye.dot(toward) < 0.0 && other.eye.z > 0.0, "{other:?}");
        let other =
            camera(&text, &CameraOptions::default(), &[0.5 * toward, 0.5 * other.eye.normalize()]).unwrap();
        assert!(other.eye.normalize().dot(toward).abs() < CLEAR, "{other:?}");
    }

    #[test]
    fn the_note_has_options() {
        let found = camera(&square(DVec3::new(1.0, 2.0, 3.0), 1.0), &CameraOptions::default(), &[]).unwrap();
        assert_eq!(
            crate::Note::DefaultCamera(found).words(),
            "no camera in the scene: seen as with -ep 3.688 -1.674 4.566 -vc 1.009 1.897 2.78 -va 40"
        );
    }
}
