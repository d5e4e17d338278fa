//! Where faces and wires are in the picture, against geometry and rays.

use glam::DVec3;
use ugrainbow::CameraOptions;

use crate::common::{draw, with};
use crate::render::{assert_near, map, plain};

#[test]
fn orthographic_squares_are_where_they_should() {
    // 8 units over 16 pixels: x in −1…2 is columns 6…12, y in 0…3 is rows 2…8.
    let (camera, config) = map(16, 16);
    let frame = draw(
        &format!("l 1; v a -1 0 3; v b 2 0 3; v c 2 3 3; v d -1 3 3; f (a b c d); {camera}"),
        &config,
    );
    for y in 0..16 {
        for x in 0..16 {
            let expected = if (6..12).contains(&x) && (2..8).contains(&y) { 255 } else { 0 };
            assert_eq!(frame.pixel(x, y), [expected, expected, expected, 255], "pixel {x} {y}");
        }
    }
}

#[test]
fn film_angles_and_size_agree() {
    #[track_caller]
    fn check(
        camera: &str,
        options: CameraOptions,
        size: [u32; 2],
        expected: [std::ops::Range<u32>; 2],
    ) {
        let config = with(&plain(size[0], size[1]), |picture| picture.camera = options);
        // A square of side 2, four units ahead.
        let text = format!(
            "l 1; v a -1 4 -1; v b 1 4 -1; v c 1 4 1; v d -1 4 1; f (a b c d); cam -ep 0 0 0 -vc 0 4 0 {camera};"
        );
        let frame = draw(&text, &config);
        let [columns, rows] = expected;
        for y in 0..size[1] {
            for x in 0..size[0] {
                let level = if columns.contains(&x) && rows.contains(&y) { 255 } else { 0 };
                assert_eq!(frame.pixel(x, y)[0], level, "pixel {x} {y} of {camera}");
            }
        }
    }
    let none = CameraOptions::default;
    // At 90 degrees the picture is 8 units wide there: a quarter of it is the square.
    check("-va 90 90", none(), [32, 32], [12..20, 12..20]);
    check("-va 90 20", none(), [32, 16], [12..20, 4..12]);
    check("-fs 2 9 -fl 1", none(), [32, 32], [12..20, 12..20]);
    check("-fs 6 9 -fl 3", none(), [32, 32], [12..20, 12..20]);
    check("-va 90 90 -fl 7", none(), [32, 32], [12..20, 12..20]);
    check(
        "-va 1 1",
        CameraOptions { view_angle: Some((90.0, None)), ..none() },
        [32, 16],
        [12..20, 4..12],
    );
    // Both angles: pixels need not be square.
    check(
        "",
        CameraOptions { view_angle: Some((90.0, Some(90.0))), ..none() },
        [32, 16],
        [12..20, 6..10],
    );
    // The upper-right quarter of the film.
    check("-va 90 90 -ph .5 .5 1 1", none(), [32, 32], [0..8, 24..32]);
    check("-va 90 90 -ph 0 .5 1 1", none(), [32, 16], [12..20, 12..16]);
    // Options override the scene.
    check(
        "",
        CameraOptions { eye: Some(DVec3::ZERO), view_angle: Some((90.0, None)), ..none() },
        [32, 32],
        [12..20, 12..20],
    );
    check(
        "-va 90 90",
        CameraOptions { is_orthographic: true, ..none() },
        [32, 32],
        [12..20, 12..20],
    );
}

/// A floor that passes under the eye and behind it, against a ray through each pixel.
#[test]
fn a_floor_under_the_eye_is_cut_and_stays_in_perspective() {
    let (width, height) = (64, 48);
    // Linear in the plane, from 0.19 to 0.86.
    let value = |x: f64, y: f64| 0.5 + 0.004 * x + 0.003 * y;
    let corner = |name: &str, x: f64, y: f64| {
        format!("c k{name} {}; v {name} {x} {y} 0 k{name};", value(x, y))
    };
    let text = format!(
        "l 1; {} {} {} {} f (a b c d); cam -ep 1 2 3 -vc 1 6 2 -va 90 90;",
        corner("a", -40.0, -50.0),
        corner("b", 45.0, -50.0),
        corner("c", 45.0, 60.0),
        corner("d", -40.0, 60.0),
    );
    let frame = draw(&text, &plain(width, height));
    let (eye, forward) = (DVec3::new(1.0, 2.0, 3.0), DVec3::new(0.0, 4.0, -1.0).normalize());
    let right = forward.cross(DVec3::Z).normalize();
    let up = right.cross(forward);
    let mut n_floor = 0;
    for y in 0..height {
        for x in 0..width {
            let across = (f64::from(x) + 0.5) / f64::from(width) * 2.0 - 1.0;
            let down = ((f64::from(y) + 0.5) * 2.0 - f64::from(height)) / f64::from(width);
            let ray = forward + across * right - down * up;
            let hit = eye - ray * (eye.z / ray.z);
            let is_floor =
                ray.z < 0.0 && (-40.0..45.0).contains(&hit.x) && (-50.0..60.0).contains(&hit.y);
            let expected = if is_floor { value(hit.x, hit.y) } else { 0.0 };
            n_floor += u32::from(is_floor);
            assert_near(frame.pixel(x, y), [expected; 3]);
        }
    }
    assert!(n_floor > width * height / 2);
}

#[test]
fn clipping_distances_are_kept() {
    // A wall along the view: near x = 0 at the left, far at the right; hither 4, yon 6.
    let text = "l 1; v a 0 0 -9; v b 0 9 -9; v c 0 9 9; v d 0 0 9; f (a b c d);
                cam -ep -1 0 0 -vc -1 5 0 -cl 4 6 -va 60 60;";
    let frame = draw(text, &plain(200, 3));
    let half = libm::tan(30.0_f64.to_radians());
    for x in 0..200 {
        // The wall is 1 to the right of the eye, so its part at depth z is at 1/z on the film.
        let depth = 1.0 / (((f64::from(x) + 0.5) / 100.0 - 1.0) * half);
        let expected = if (4.0..6.0).contains(&depth) { 255 } else { 0 };
        assert_eq!(frame.pixel(x, 1)[0], expected, "column {x}");
    }
}

#[test]
fn wires_are_seen_in_front_and_hidden_behind() {
    let (camera, config) = map(16, 16);
    let text = |z: f64| {
        format!(
            "c red 1 0; c grey .5; l 1; v a -2 -2 0; v b 2 -2 0; v c 2 2 0; v d -2 2 0; f (a b c d) grey;
             v p -4 .25 {z}; v q 4 .25 {z}; w (p q) red; {camera}"
        )
    };
    let (red, grey) = ([255, 0, 0, 255], [128, 128, 128, 255]);
    // y = 0.25 is the middle of row 7; half a unit is a pixel.
    for (z, inside) in [(1.0, red), (0.0, red), (-1.0, grey)] {
        let frame = draw(&text(z), &config);
        assert_eq!(frame.pixel(1, 7), red, "outside the face, z = {z}");
        assert_eq!(frame.pixel(8, 7), inside, "z = {z}");
        assert_eq!(frame.pixel(8, 5), grey);
        assert_eq!(frame.pixel(1, 9), [0, 0, 0, 255]);
    }
    // In perspective, and past the eye.
    let text = "c red 1 0; l 1; v p 0 -5 -1; v q 0 50 -1; w (p q) red; cam -ep 0 0 0 -vc 0 5 -1 -va 60 60;";
    let frame = draw(text, &plain(21, 21));
    for y in 11..21 {
        assert_eq!(frame.pixel(10, y), red, "row {y}");
        assert_eq!(frame.pixel(8, y)[0], 0, "row {y}");
    }
}
