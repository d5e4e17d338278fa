//! Conversion between CIE XYZ and linear sRGB.

/// X, Y, Z of the sRGB white point: CIE illuminant D65 weighted by the CIE 1931 observer,
/// normalized to Y = 1.  Eq. (P19)
///
/// Computed from the tables at 1 nm. The sRGB standard rounds the chromaticity to four digits,
/// which gives Z = 1.089.
pub const WHITE_XYZ: [f64; 3] = [0.9504693596190847, 1.0, 1.0888220674507918];

/// The brightest light of a picture, relative to white, whose samples are single-precision numbers:
/// the sums of some hundred are finite. Brighter light is limited with its hue, see [`limited`].
pub const MOST_LIGHT: f64 = 1e36;

/// X, Y, Z or linear red, green and blue with the same chromaticity, none of which is above `most`.
/// Of infinite channels nothing is known but that they are equal; NaN becomes 0.
///
/// ```
/// assert_eq!(ugphysics::limited([1e300, 2e300, 0.0], 1e36), [0.5e36, 1e36, 0.0]);
/// ```
#[inline]
pub fn limited(light: [f64; 3], most: f64) -> [f64; 3] {
    let [a, b, c] = light.map(f64::abs);
    if a <= most && b <= most && c <= most {
        return light;
    }
    let largest = a.max(b).max(c);
    light.map(|part| {
        let share = if part.is_infinite() { part.signum() } else { part / largest };
        if share.is_nan() { 0.0 } else { share * most.min(largest) }
    })
}

/// Chromaticities x, y of the sRGB primaries (IEC 61966-2-1).
const PRIMARIES: [[f64; 2]; 3] = [[0.64, 0.33], [0.30, 0.60], [0.15, 0.06]];

const XYZ_FROM_RGB: [[f64; 3]; 3] = xyz_from_rgb();
const RGB_FROM_XYZ: [[f64; 3]; 3] = inverse(XYZ_FROM_RGB);

/// Linear sRGB from X, Y, Z; [`WHITE_XYZ`] gives 1, 1, 1. A colour outside the sRGB gamut has a
/// negative channel.  Eq. (P19)
///
/// ```
/// let [red, green, blue] = ugphysics::xyz_to_linear_srgb(ugphysics::WHITE_XYZ);
/// assert!((red - 1.0).abs() < 1e-14 && (green - 1.0).abs() < 1e-14 && (blue - 1.0).abs() < 1e-14);
/// ```
pub fn xyz_to_linear_srgb(xyz: [f64; 3]) -> [f64; 3] {
    times(RGB_FROM_XYZ, xyz)
}

/// X, Y, Z from linear sRGB: the inverse of [`xyz_to_linear_srgb`].  Eq. (P19)
///
/// ```
/// let [_, luminance, _] = ugphysics::linear_srgb_to_xyz([0.0, 1.0, 0.0]);
/// assert!((luminance - 0.7152).abs() < 1e-4);
/// ```
pub fn linear_srgb_to_xyz(rgb: [f64; 3]) -> [f64; 3] {
    times(XYZ_FROM_RGB, rgb)
}

const fn times(m: [[f64; 3]; 3], v: [f64; 3]) -> [f64; 3] {
    [
        m[0][0] * v[0] + m[0][1] * v[1] + m[0][2] * v[2],
        m[1][0] * v[0] + m[1][1] * v[1] + m[1][2] * v[2],
        m[2][0] * v[0] + m[2][1] * v[1] + m[2][2] * v[2],
    ]
}

/// The columns are the X, Y, Z of the primaries, scaled so that their sum is the white point.
const fn xyz_from_rgb() -> [[f64; 3]; 3] {
    let [[xr, yr], [xg, yg], [xb, yb]] = PRIMARIES;
    let columns = [
        [xr / yr, xg / yg, xb / yb],
        [1.0, 1.0, 1.0],
        [(1.0 - xr - yr) / yr, (1.0 - xg - yg) / yg, (1.0 - xb - yb) / yb],
    ];
    let bright = times(inverse(columns), WHITE_XYZ);
    let mut scaled = columns;
    let mut row = 0;
    while row < 3 {
        let mut column = 0;
        while column < 3 {
            scaled[row][column] *= bright[column];
            column += 1;
        }
        row += 1;
    }
    scaled
}

const fn inverse([[a, b, c], [d, e, f], [g, h, i]]: [[f64; 3]; 3]) -> [[f64; 3]; 3] {
    let whole = a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g);
    [
        [(e * i - f * h) / whole, (c * h - b * i) / whole, (b * f - c * e) / whole],
        [(f * g - d * i) / whole, (a * i - c * g) / whole, (c * d - a * f) / whole],
        [(d * h - e * g) / whole, (b * g - a * h) / whole, (a * e - b * d) / whole],
    ]
}
