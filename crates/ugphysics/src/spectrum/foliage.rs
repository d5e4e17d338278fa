//! Which colours are those of green leaves, whose reflectance has a step that no smooth curve has.

use crate::linear_srgb_to_xyz;
use crate::spectrum::ranges::N_LEVELS;

/// CIELAB coordinates of the colour that is most likely foliage, and the distances from it, along
/// each axis, beyond which no colour is: simulated canopies; docs/physics/reflectance.py.
const CENTRE: [f64; 3] = [30.0, -14.0, 26.0];
const RADII: [f64; 3] = [30.0, 22.0, 24.0];

/// The mean reflectances of canopies in the infrared bands.
pub(crate) const LEVELS: [f64; N_LEVELS] = [0.43, 0.39, 0.17, 0.06];

/// The weight of the class foliage for a surface with this linear red, green and blue, from 0 to 1:
/// a smooth function of its colour.  Eq. (P20)
pub(crate) fn share(rgb: [f64; 3]) -> f64 {
    let [lightness, a, b] = lab(rgb);
    let outside = |at: f64, axis: usize| {
        let part = (at - CENTRE[axis]) / RADII[axis];
        part * part
    };
    let inside = 1.0 - outside(lightness, 0) - outside(a, 1) - outside(b, 2);
    let inside = inside.max(0.0);
    inside * inside
}

/// L*, a* and b* of linear red, green and blue.
pub(crate) fn lab(rgb: [f64; 3]) -> [f64; 3] {
    /// Up to this value the cube root is replaced by a straight line.
    const LINEAR: f64 = 216.0 / 24389.0;
    let white = linear_srgb_to_xyz([1.0; 3]);
    let xyz = linear_srgb_to_xyz(rgb);
    let [x, y, z] = std::array::from_fn(|i| {
        let part = xyz[i] / white[i];
        if part > LINEAR { libm::cbrt(part) } else { part / (3.0 * 36.0 / 841.0) + 4.0 / 29.0 }
    });
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}
