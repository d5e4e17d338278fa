//! Colours as the screen gets them.

use ugphysics::{srgb_decode, srgb_encode};

use super::{Measured, Sight};

/// CIE 1931 x, y of black bodies, as in the questions of T22, in the order of the patches.
const BLACK_BODIES: [(&str, [f64; 2]); 6] = [
    ("2000 K", [0.526_677_5, 0.413_297_0]),
    ("3000 K", [0.436_931_0, 0.404_074_0]),
    ("5800 K", [0.325_982_6, 0.335_319_1]),
    ("6504 K", [0.313_463_5, 0.323_567_6]),
    ("10045.89 K", [0.280_381_3, 0.287_989_8]),
    ("25281.6 K", [0.252_352_6, 0.251_986_8]),
];

/// Y of the patches of the picture `colours`: all of a body's light that the screen can show.
const LUMINANCES: [f64; 6] =
    [0.384_922_92, 0.547_800_36, 0.874_232_02, 0.930_107_69, 0.676_230_30, 0.502_353_65];

const GREYS: [f64; 6] = [0.0, 0.05, 0.18, 0.4, 0.7, 1.0];

/// Pixels to a patch.
const PATCH: u32 = 100;

/// Both rows of patches.
pub fn measure_patches(sight: &Sight) -> Result<Vec<Measured>, String> {
    let center =
        |patch: usize, row: u32| sight.color(PATCH * patch as u32 + PATCH / 2, PATCH * row + PATCH / 2);
    let mut found = Vec::new();
    for (patch, (body, luminance)) in BLACK_BODIES.into_iter().zip(LUMINANCES).enumerate() {
        let color = center(patch, 0);
        found.extend(measure_body(color, body));
        found.push(measure_luminance(color, body.0, luminance));
    }
    for (patch, grey) in GREYS.into_iter().enumerate() {
        let right = 255.0 * srgb_encode(grey);
        for (name, level) in ["red", "green", "blue"].into_iter().zip(center(patch, 1)) {
            // Half a level of rounding, and half for a matrix of four decimals.
            found.push(Measured::new(format!("{name} of a grey of {grey}, level"), level.into(), right, 1.0));
        }
    }
    Ok(found)
}

/// Four bodies of 3000 K in one row; those of 2000, 5800 and 10045.89 K as they are seen are known from T22.
pub fn measure_moving(sight: &Sight) -> Result<Vec<Measured>, String> {
    let [cold, rest, white, blue] = [0, 1, 2, 4].map(|idx| BLACK_BODIES[idx]);
    let center = |patch: usize| sight.color(PATCH * patch as u32 + PATCH / 2, PATCH / 2);
    let mut found = Vec::new();
    for (patch, body) in [cold, rest, white, blue].into_iter().enumerate() {
        let color = center(patch);
        let lit = f64::from(color.into_iter().max().unwrap_or(0));
        found.push(Measured::at_least(format!("brightest channel of {}, level", body.0), lit, 100.0));
        found.extend(measure_body(color, body));
    }
    Ok(found)
}

/// Both coordinates of a black body's colour.
fn measure_body(color: [u8; 3], (name, right): (&str, [f64; 2])) -> [Measured; 2] {
    let levels = color.map(f64::from);
    let (xy, tolerance) = (chromaticity(levels), rounding(levels));
    [("x", 0), ("y", 1)]
        .map(|(axis, i)| Measured::new(format!("{axis} of {name}"), xy[i], right[i], tolerance[i]))
}

/// How bright a patch is: white is 1.
fn measure_luminance(color: [u8; 3], name: &str, right: f64) -> Measured {
    let levels = color.map(f64::from);
    let [_, y, _] = seen(levels);
    // As in `rounding`; it grows with every channel.
    let [_, above, _] = seen(levels.map(|level| level + 0.75));
    Measured::new(format!("Y of {name}"), y, right, above - y)
}

/// CIE x, y of what an sRGB screen shows.
fn chromaticity(levels: [f64; 3]) -> [f64; 2] {
    let [x, y, z] = seen(levels);
    [x / (x + y + z), y / (x + y + z)]
}

/// CIE X, Y, Z of what an sRGB screen shows (IEC 61966-2-1).
fn seen(levels: [f64; 3]) -> [f64; 3] {
    let [r, g, b] = levels.map(|level| srgb_decode(level / 255.0));
    [
        0.4124 * r + 0.3576 * g + 0.1805 * b,
        0.2126 * r + 0.7152 * g + 0.0722 * b,
        0.0193 * r + 0.1192 * g + 0.9505 * b,
    ]
}

/// How far x and y change when every channel changes by three quarters of a level, half of it from rounding.
fn rounding(levels: [f64; 3]) -> [f64; 2] {
    let middle = chromaticity(levels);
    let mut worst = [0.0_f64; 2];
    for corner in 0..8 {
        let moved: [f64; 3] =
            std::array::from_fn(|i| levels[i] + if corner >> i & 1 == 0 { -0.75 } else { 0.75 });
        let at = chromaticity(moved);
        worst = [0, 1].map(|i| worst[i].max((at[i] - middle[i]).abs()));
    }
    worst
}

/// Pixels from the middle of the wide picture.
const RADII: [u32; 4] = [60, 100, 140, 170];

/// Equal angles from the motion have equal colours, whichever way they lie.
pub fn measure_wide(sight: &Sight) -> Result<Vec<Measured>, String> {
    let [width, height] = sight.size();
    let (x, y) = (width / 2, height / 2);
    let mut found = Vec::new();
    for r in RADII {
        // Pixels beside the middle line, at equal distances on both sides.
        let around = [
            sight.color(x + r, y),
            sight.color(x - 1 - r, y - 1),
            sight.color(x, y + r),
            sight.color(x - 1, y - 1 - r),
        ];
        let spread = (0..3).map(|i| {
            let channel = || around.iter().map(|color| f64::from(color[i]));
            channel().fold(0.0, f64::max) - channel().fold(255.0, f64::min)
        });
        let spread = spread.fold(0.0, f64::max);
        // D is taken as linear between points where it is right; that may be half a percent, or 3 nm, or 16 levels of a
        // saturated colour.
        found.push(Measured::new(
            format!("difference of colours {r} pixels from the middle, levels"),
            spread,
            0.0,
            20.0,
        ));
    }
    let (inner, outer) = (sight.color(x + RADII[0], y), sight.color(x + RADII[3], y));
    let change = difference(inner, outer);
    // Otherwise equal colours would mean nothing.
    found.push(Measured::at_least("change of colour from the middle outwards, levels", change, 40.0));
    Ok(found)
}

/// The moving square has the colour of the one at rest.
pub fn measure_shift(sight: &Sight) -> Result<Vec<Measured>, String> {
    let [width, height] = sight.size();
    let [rest, coming] = [width / 4, 3 * width / 4].map(|x| sight.color(x, height / 2));
    let lit = f64::from(rest.into_iter().max().unwrap_or(0));
    Ok(vec![
        Measured::new("difference of both squares, levels", difference(rest, coming), 0.0, 3.0),
        // Two black squares would be equal, too.
        Measured::at_least("brightest channel of the square at rest, level", lit, 64.0),
    ])
}

/// The largest difference of a channel.
fn difference(a: [u8; 3], b: [u8; 3]) -> f64 {
    a.into_iter().zip(b).map(|(a, b)| f64::from(a.abs_diff(b))).fold(0.0, f64::max)
}
