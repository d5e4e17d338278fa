//! Light on faces, at rest and in motion, against the cosine law.

use crate::common::{SQUARE, draw};
use crate::render::{assert_near, map};

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
