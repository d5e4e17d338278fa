//! Measurements in pictures: the Terrell rotation, and the circular outline of a sphere.

use glam::{DMat3, DVec3};
use ugtests::oracle::Pinhole;
use ugtests::picture::{Picture, save};
use ugtests::pipe::Pipe;
use ugtests::scenes::parse;

/// A cube of side 1 about (0, 1000, 0): front red, trailing side green, the others blue.
const CUBE: &str = "
    c red 1 0; c green 1 120; c blue 1 240; l 1;
    v a -.5 999.5 -.5; v b .5 999.5 -.5; v c .5 999.5 .5; v d -.5 999.5 .5;
    v e -.5 1000.5 -.5; v f .5 1000.5 -.5; v g .5 1000.5 .5; v h -.5 1000.5 .5;
    f (a b c d) red; f (e a d h) green; f (b f g c) blue; f (f e h g) blue; f (d c g h) blue; f (e f b a) blue;
    cam -ep 0 0 0 -vc 0 1000 0 -ud 0 0 1;";

/// Width of the picture in pixels, and pixels per unit at the cube's centre.
const WIDTH: u32 = 800;
const PER_UNIT: f64 = 400.0;

const RED: [u8; 4] = [255, 0, 0, 255];
const GREEN: [u8; 4] = [0, 255, 0, 255];

/// Draws the cube seen at right angles to its motion; returns the picture and its middle row.
fn cube_abeam(speed: f64) -> (Picture, Vec<[u8; 4]>) {
    let half_angle = libm::atan(f64::from(WIDTH) / 2.0 / PER_UNIT / 1000.0);
    let view_angle_deg = 2.0 * half_angle.to_degrees();
    let mut pipe = Pipe::new(speed * DVec3::X, [WIDTH, WIDTH]).in_place().shape().view_angle(view_angle_deg);
    pipe.doppler.repeat = true;
    pipe.rainbow.picture.samples = 1;
    let picture = pipe.draw(CUBE.as_bytes());
    let row = (0..WIDTH).map(|x| picture.get_pixel(x, WIDTH / 2).0).collect();
    (picture, row)
}

/// T08, T09: seen at right angles, a distant cube shows a front of 1/γ and a trailing side of β, as
/// if it were rotated by asin β.
#[test]
fn a_cube_seen_at_right_angles_looks_rotated_by_asin_beta() {
    for speed in [0.0, 0.3, 0.6, 0.8, 0.9, 0.99] {
        let (picture, row) = cube_abeam(speed);
        let count = |color| row.iter().filter(|&&pixel| pixel == color).count() as f64;
        let (front, side) = (count(RED), count(GREEN));
        let expected = ((1.0 - speed * speed).sqrt() * PER_UNIT, speed * PER_UNIT);
        println!("{speed} c: front {front} of {:.1}, trailing side {side} of {:.1}", expected.0, expected.1);
        // Half a pixel at both ends, and the effect of perspective over the cube's depth: 1
        // in 2000.
        let is_right = (front - expected.0).abs() <= 1.2 && (side - expected.1).abs() <= 1.2;
        if !is_right {
            panic!("{speed} c: see {}", save("terrell", &picture).display());
        }
        // Two ends of a pixel in 400.
        let turned_deg = libm::atan2(side, front).to_degrees();
        assert!((turned_deg - libm::asin(speed).to_degrees()).abs() < 0.25, "{speed} c: {turned_deg}");
        // The cube moves to the right, so its trailing side is on the left.
        let last_green = row.iter().rposition(|&pixel| pixel == GREEN);
        let first_red = row.iter().position(|&pixel| pixel == RED);
        assert!(last_green < first_red);
    }
}

/// The text of a sphere of radius 1 about `center`, with `n` sectors of longitude.
fn sphere(center: DVec3, n: usize) -> String {
    let mut text = String::from("l 1;\n");
    let angle = |step: usize| std::f64::consts::TAU * step as f64 / n as f64;
    let bands = n / 2;
    for band in 0..=bands {
        for strip in 0..n {
            let (sin_band, cos_band) = libm::sincos(angle(band));
            let (sin, cos) = libm::sincos(angle(strip));
            let p = center + DVec3::new(sin_band * cos, sin_band * sin, cos_band);
            text += &format!("v v{band}_{strip} {:?} {:?} {:?};\n", p.x, p.y, p.z);
        }
    }
    for band in 0..bands {
        for strip in 0..n {
            let (next, below) = ((strip + 1) % n, band + 1);
            text += &format!("f (v{band}_{strip} v{below}_{strip} v{below}_{next} v{band}_{next});\n");
        }
    }
    text
}

/// Directions to the edges between black and white pixels.
fn outline(picture: &Picture, camera: &Pinhole) -> Vec<DVec3> {
    let (width, height) = picture.dimensions();
    let is_lit = |x: u32, y: u32| picture.get_pixel(x, y).0[0] > 0;
    let mut directions = Vec::new();
    for y in 1..height {
        for x in 1..width {
            if is_lit(x, y) != is_lit(x - 1, y) {
                directions.push(camera.direction(f64::from(x), f64::from(y) + 0.5));
            }
            if is_lit(x, y) != is_lit(x, y - 1) {
                directions.push(camera.direction(f64::from(x) + 0.5, f64::from(y)));
            }
        }
    }
    directions
}

/// Fits a circle on the sphere of directions by least squares, as the plane n·d = 1. Returns its
/// axis, its angular radius, and the largest distance from it, both in degrees.
fn circle(directions: &[DVec3]) -> (DVec3, f64, f64) {
    let outer = |d: &DVec3| DMat3::from_cols(d.x * *d, d.y * *d, d.z * *d);
    let matrix = directions.iter().map(outer).fold(DMat3::ZERO, |sum, matrix| sum + matrix);
    let normal = matrix.inverse() * directions.iter().sum::<DVec3>();
    let (axis, radius) = (normal.normalize(), libm::acos(1.0 / normal.length()));
    let gaps = directions.iter().map(|d| (d.angle_between(axis) - radius).abs());
    (axis, radius.to_degrees(), gaps.fold(0.0, f64::max).to_degrees())
}

/// T11: a sphere of radius 1, at distance 3 perpendicular to the motion in its own frame, has a
/// circular outline, which is not centred on the image of its centre.
#[test]
fn the_outline_of_a_sphere_is_a_circle() {
    const SIDE: u32 = 600;
    /// β, angular radius, angles from the motion of the circle's axis and of the centre's image,
    /// degrees.
    const ROWS: [[f64; 4]; 3] = [
        [0.0, 19.47122063, 90.0, 90.0],
        [0.5, 17.02386618, 118.5608252, 120.0],
        [0.9, 8.760949008, 152.8103814, 154.1580672],
    ];
    let text = sphere(3.0 * DVec3::Y, 120);
    for [speed, radius_deg, axis_deg, center_deg] in ROWS {
        let (sin, cos) = libm::sincos(axis_deg.to_radians());
        let view_angle_deg = 2.6 * radius_deg;
        let camera = format!("cam -ep 0 0 0 -vc {cos:?} {sin:?} 0 -ud 0 0 1 -ps -va {view_angle_deg} 1;");
        let mut pipe = Pipe::new(speed * DVec3::X, [SIDE, SIDE]).shape();
        pipe.rainbow.picture.samples = 1;
        let picture = pipe.draw(format!("{text}{camera}").as_bytes());

        let pinhole = Pinhole::new(parse(camera.as_bytes()).camera().unwrap(), DVec3::ZERO, [SIDE, SIDE]);
        let (axis, found_deg, gap_deg) = circle(&outline(&picture, &pinhole));
        let found_axis_deg = axis.angle_between(DVec3::X).to_degrees();
        println!(
            "{speed} c: radius {found_deg:.4} of {radius_deg:.4}, axis {found_axis_deg:.4} of {axis_deg:.4}, gap {gap_deg:.4}"
        );
        // An edge is uncertain by half a pixel, and the mean of 1500 edges by a twentieth; the
        // polyhedron's outline is smaller than the sphere's by up to 1 − cos 1.5° of the radius.
        let pixel_deg = view_angle_deg / f64::from(SIDE);
        assert!(gap_deg < pixel_deg, "{speed} c: {gap_deg} of {pixel_deg}");
        assert!(
            (found_deg - radius_deg).abs() < 0.1 * pixel_deg + 3e-4 * radius_deg,
            "{speed} c: {found_deg}"
        );
        assert!((found_axis_deg - axis_deg).abs() < 0.1 * pixel_deg, "{speed} c: {found_axis_deg}");
        assert!(speed == 0.0 || (found_axis_deg - center_deg).abs() > 1.0);
    }
}
