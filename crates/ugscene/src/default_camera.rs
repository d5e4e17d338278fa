//! The camera of a scene that has none: far enough away that everything is in the picture.

use std::fmt;

use glam::{DQuat, DVec3};
use ugparse::Scene;

use crate::camera_options::{CameraError, CameraOptions, DEFAULT_VIEW_ANGLE, half_film};
use crate::words;

/// From the view centre to the eye, where z is up: from the front (−y), the right and above. No
/// axis is within [`CLEAR`] of it.
const TOWARD_EYE: DVec3 = DVec3::new(3.0, -4.0, 2.0);

/// The part of the picture's shorter side that the sphere around everything fills at rest. A moving
/// body whose centre is seen at the same place fills up to 0.9 at 0.999c, measured for 1200
/// velocities; a picture of 16:9 from the distance for 4:3, as much at rest.
const FILLED: f64 = 2.0 / 3.0;

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

/// As a note, with the options that have the same effect.
impl fmt::Display for DefaultCamera {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { eye, center, view_angle_deg } = self;
        let [eye, center] = [*eye, *center].map(words::point);
        write!(f, "no camera in the scene: seen as with -ep {eye} -vc {center} -va {view_angle_deg}")
    }
}

impl DefaultCamera {
    /// The default camera: it looks at the middle of the bounding box (or `options.center`) from
    /// the front, the right and above, at the distance from which the sphere around everything
    /// fills two thirds of the shorter side of the picture. `None` if the eye point is known, the
    /// scene has a camera, or is empty.
    ///
    /// `size`: of the picture, of which only the aspect ratio matters. `velocities`: of bodies, in
    /// the frame of the camera. If one of them moves toward the eye, the eye is on another side.
    ///
    /// # Errors
    /// [`CameraError::ViewAngle`].
    pub fn new(
        scene: &Scene,
        options: &CameraOptions,
        size: [u32; 2],
        velocities: impl IntoIterator<Item = DVec3>,
    ) -> Result<Option<Self>, CameraError> {
        let is_known = options.eye.is_some() || scene.stage.seen_geometry().is_some();
        if is_known || !scene.cameras.is_empty() || scene.vertices.is_empty() {
            return Ok(None);
        }
        let half = half_film(options, size)?;
        let (low, high) = bounds(scene);
        let middle = options.center.unwrap_or(low * 0.5 + high * 0.5);
        let radius = radius(scene, middle);
        // The sphere is seen with the radius `tangent` at distance 1.
        let tangent = FILLED * half[0].min(half[1]);
        // Coordinates near the largest number would put the eye at infinity.
        let distance = (radius * libm::hypot(1.0, tangent) / tangent).min(0.5 * f64::MAX);
        let toward_eye = toward_eye(options.up, velocities);
        let unit = unit_of_rounding(distance);
        let center = options.center.unwrap_or_else(|| rounded(middle, unit));
        let eye = (middle + distance * toward_eye).clamp(DVec3::MIN, DVec3::MAX);
        let eye = rounded(eye, unit);
        let view_angle_deg = options.view_angle.map_or(DEFAULT_VIEW_ANGLE, |(across, _)| across);
        let is_valid = eye.is_finite() && center.is_finite() && eye != center;
        Ok(is_valid.then_some(Self { eye, center, view_angle_deg }))
    }
}

/// The positions of everything that is drawn; of all vertices if nothing is.
fn positions(scene: &Scene) -> impl Iterator<Item = DVec3> {
    let faces = scene.faces.iter().map(|face| face.contours.clone());
    let drawn = faces.chain(scene.wires.iter().map(|wire| wire.contours.clone()));
    let drawn = drawn.flat_map(|rows| scene.contours.corners(rows)).map(|corner| corner.index());
    let is_empty = scene.faces.is_empty() && scene.wires.is_empty();
    let all = 0..if is_empty { scene.vertices.len() } else { 0 };
    drawn.chain(all).map(|row| scene.vertices[row].position)
}

/// Corners of the bounding box.
fn bounds(scene: &Scene) -> (DVec3, DVec3) {
    const EMPTY: (DVec3, DVec3) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    positions(scene).fold(EMPTY, |(low, high), p| (low.min(p), high.max(p)))
}

/// Radius of the sphere about `center` around everything; 1 for a single point.
fn radius(scene: &Scene, center: DVec3) -> f64 {
    let longest = positions(scene).fold(0.0, |most: f64, p| most.max((p - center).abs().max_element()));
    if longest == 0.0 {
        return 1.0;
    }
    // Divided first, against overflow and underflow of squares.
    longest * positions(scene).fold(0.0, |most: f64, p| most.max(((p - center) / longest).length()))
}

/// The unit vector from the view centre to the eye: the first of four sides that no body moves
/// toward, or the one that they move toward least directly.
fn toward_eye(up: Option<DVec3>, velocities: impl IntoIterator<Item = DVec3>) -> DVec3 {
    let up = up.map_or(DVec3::Z, |up| up.normalize_or(DVec3::Z));
    let scene_from_side = DQuat::from_rotation_arc(DVec3::Z, up);
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
    use super::*;

    fn camera(text: &str, options: &CameraOptions, velocities: &[DVec3]) -> Option<DefaultCamera> {
        let source = ugparse::Source::new("t.ug", text);
        let scene = ugparse::parse(&source, &ugparse::Options::default()).unwrap().scene;
        DefaultCamera::new(&scene, options, [4, 3], velocities.iter().copied()).unwrap()
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
        for velocities in [&[][..], &[DVec3::Y]] {
            let DefaultCamera { eye, center, .. } =
                camera(scene, &CameraOptions::default(), velocities).unwrap();
            assert!(crate::view_distance(eye, center).is_ok(), "{eye} {center}");
        }
    }

    #[test]
    fn the_sphere_around_everything_fills_two_thirds_of_the_height() {
        for (half, center) in [
            (1.0, DVec3::ZERO),
            (1e-3, DVec3::new(7.0, -8.0, 9.0)),
            (1e6, DVec3::splat(3e7)),
            (1e-200, DVec3::ZERO),
            (1e307, DVec3::ZERO),
        ] {
            let options = CameraOptions { view_angle: Some((60.0, None)), ..CameraOptions::default() };
            let found = camera(&square(center, half), &options, &[]).unwrap();
            let distance = ((found.eye - found.center) / half).length();
            let angle = libm::asin(std::f64::consts::SQRT_2 / distance);
            let height = 0.75 * libm::tan(30f64.to_radians());
            assert!((libm::tan(angle) / height - 2.0 / 3.0).abs() < 2e-3, "{half}: {found}");
            assert!(((found.center - center) / half).length() < 6e-3, "{half}: {found}");
            assert!((found.eye.z - found.center.z) / half > 0.3 * distance, "not above: {found}");
        }
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
        assert!(found.eye.z > found.eye.x && found.eye.x > found.eye.y && found.eye.y > 0.0, "{found}");
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
                assert_eq!(camera(&text, &CameraOptions::default(), &[velocity]), Some(at_rest));
            }
        }
        let toward = at_rest.eye.normalize();
        let other = camera(&text, &CameraOptions::default(), &[0.5 * toward]).unwrap();
        assert!(other.eye.dot(toward) < 0.0 && other.eye.z > 0.0, "{other}");
        let other =
            camera(&text, &CameraOptions::default(), &[0.5 * toward, 0.5 * other.eye.normalize()]).unwrap();
        assert!(other.eye.normalize().dot(toward).abs() < CLEAR, "{other}");
    }

    #[test]
    fn the_note_has_options() {
        let found = camera(&square(DVec3::new(1.0, 2.0, 3.0), 1.0), &CameraOptions::default(), &[]).unwrap();
        assert_eq!(
            found.to_string(),
            "no camera in the scene: seen as with -ep 5.4 -3.867 5.933 -vc 1 2 3 -va 40"
        );
    }
}
