//! Light on faces, at rest and in motion, against the cosine law.

use glam::DVec3;
use ugphysics::{Velocity, seen_position};

use crate::common::{SQUARE, draw};
use crate::render::{assert_near, map, plain};

#[test]
fn lights_follow_the_cosine_law() {
    let (camera, config) = map(5, 5);
    #[track_caller]
    fn check(lights: &str, expected: [f64; 3]) {
        let (camera, config) = map(5, 5);
        let text = format!("c red 1 0; c half .5; {lights} {SQUARE} f (a b c d); {camera}");
        assert_near(draw(&text, &config).pixel(2, 2), expected);
    }
    let grey = |level: f64| [level; 3];
    check("l .25;", grey(0.25));
    check("l .25; l .5;", grey(0.75));
    check("l 1 0 0 7;", grey(1.0));
    check("l 1 0 3 4;", grey(0.8));
    check("l .3; l .5 0 3 4;", grey(0.7));
    check("l .3; l .5 0 3 -4;", grey(0.3));
    // The light comes from below, and only the visible side, above, is lit.
    check("l 1 0 0 -1; l .1;", grey(0.1));
    check("l 1 0 0 -1 0;", grey(0.0));
    // A coloured light multiplies red, green and blue.
    check("l .2; l .5 0 0 1 red;", [0.7, 0.2, 0.2]);
    check("l 1 half;", grey(0.5));
    // No light at all: 0.3 and 0.7 from the eye.
    check("", grey(1.0));
    // The square is seen from behind and lit from that side.
    let back = format!("l .8 0 0 1; {SQUARE} f (d c b a); {camera}");
    assert_near(draw(&back, &config).pixel(2, 2), grey(0.8));
    // A level stored in the face overrides the lights.
    let stored = format!("l .8 0 0 1; {SQUARE} f (a b c d) .4; {camera}");
    assert_near(draw(&stored, &config).pixel(2, 2), grey(0.4));
}

#[test]
fn local_lights_and_normals_are_interpolated() {
    // Normals lean 45° to the left and to the right, so the light level is cos 45° at every corner.
    // It is so in the middle, too: light levels are interpolated, normals are not.
    let (camera, config) = map(5, 5);
    let text = format!(
        "l 1 0 0 1; v a -4 -4 0 -1 0 1; v b 4 -4 0 1 0 1; v c 4 4 0 1 0 1; v d -4 4 0 -1 0 1; f (a b c d); {camera}"
    );
    let cos = std::f64::consts::FRAC_1_SQRT_2;
    assert_near(draw(&text, &config).pixel(2, 2), [cos; 3]);
    // A lamp 3 above the middle: each corner of the square of half side 4 sees it
    // under n·l = 3/√(9 + 32), and distance does not matter.
    let text = format!("l 1 0 0 3 0; {SQUARE} f (a b c d); {camera}");
    assert_near(draw(&text, &config).pixel(2, 2), [3.0 / f64::sqrt(41.0); 3]);
}

/// A tilted square moves; it is bent by (P3) as `uglorentz` does. It must be lit as at rest.
#[test]
fn moving_faces_are_lit_in_their_rest_frame() {
    let beta = DVec3::new(0.6, 0.3, -0.2);
    let v = Velocity::from_beta(beta).unwrap();
    let rest = [(-0.3, -0.3), (0.3, -0.3), (0.3, 0.3), (-0.3, 0.3)]
        .map(|(x, y)| DVec3::new(x, 7.0 + x, y - 0.5 * x));
    let normal = (rest[1] - rest[0]).cross(rest[3] - rest[0]).normalize();
    let light = DVec3::new(1.0, -3.0, 2.0).normalize();
    let expected = 0.2 + 0.8 * normal.dot(light).abs();
    assert!(normal.dot(light) * normal.dot(-rest[0]) > 0.0, "the light is on the side that is seen");
    let vertices = |points: &[DVec3; 4]| -> String {
        points
            .iter()
            .zip("abcd".chars())
            .map(|(p, name)| format!("v {name} {} {} {};", p.x, p.y, p.z))
            .collect()
    };
    let check = |points: [DVec3; 4], velocity: &str| {
        let center = points.iter().sum::<DVec3>() / 4.0;
        let text = format!(
            "(ugstage 1 geometry as-seen eye 0 0 0) l .2; l .8 1 -3 2; {} f (a b c d) {velocity}; cam -ep 0 0 0 -vc {} {} {} -va 1 1;",
            vertices(&points),
            center.x,
            center.y,
            center.z
        );
        assert_near(draw(&text, &plain(3, 3)).pixel(1, 1), [expected; 3]);
    };
    check(rest, "");
    check(rest.map(|p| seen_position(p, v)), "<0.6 0.3 -0.2>");
}
