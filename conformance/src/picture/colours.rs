//! Measures displayed colours.

use ugphysics::{srgb_decode, srgb_encode};

use super::{MeasuredQuantity, Picture};

/// CIE 1931 x, y of black bodies, as in the questions of T22, in the order of the patches.
const BLACK_BODIES: [(&str, [f64; 2]); 6] = [
    ("2000 K", [0.526_677_5, 0.413_297_0]),
    ("3000 K", [0.436_931_0, 0.404_074_0]),
    ("5800 K", [0.325_982_6, 0.335_319_1]),
    ("6504 K", [0.313_463_5, 0.323_567_6]),
    ("10045.89 K", [0.280_381_3, 0.287_989_8]),
    ("25281.6 K", [0.252_352_6, 0.251_986_8]),
];

/// Y of the patches in the picture `colours`: the brightest that a screen can show of each body.
const LUMINANCES: [f64; 6] =
    [0.384_922_92, 0.547_800_36, 0.874_232_02, 0.930_107_69, 0.676_230_30, 0.502_353_65];

const GREYS: [f64; 6] = [0.0, 0.05, 0.18, 0.4, 0.7, 1.0];

/// Size of a patch in pixels.
const PATCH: u32 = 100;

/// Measures both rows of patches.
pub fn measure_patches(picture: &Picture) -> Result<Vec<MeasuredQuantity>, String> {
    let center = |patch: usize, row: u32| {
        picture.color(PATCH * patch as u32 + PATCH / 2, PATCH * row + PATCH / 2)
    };
    let mut measurements = Vec::new();
    for (patch, (body, luminance)) in BLACK_BODIES.into_iter().zip(LUMINANCES).enumerate() {
        let color = center(patch, 0);
        measurements.extend(measure_body(color, body));
        measurements.push(measure_luminance(color, body.0, luminance));
    }
    for (patch, grey) in GREYS.into_iter().enumerate() {
        let right = 255.0 * srgb_encode(grey);
        for (name, level) in ["red", "green", "blue"].into_iter().zip(center(patch, 1)) {
            // Half a level for rounding, and half for a colour matrix of four decimals.
            measurements.push(MeasuredQuantity::new(
                format!("{name} of a grey of {grey}, level"),
                level.into(),
                right,
                1.0,
            ));
        }
    }
    Ok(measurements)
}

/// Measures a row of four bodies of 3000 K, which appear as 2000, 3000, 5800 and 10045.89 K; T22
/// has their chromaticities.
pub fn measure_moving(picture: &Picture) -> Result<Vec<MeasuredQuantity>, String> {
    let [cold, rest, white, blue] = [0, 1, 2, 4].map(|idx| BLACK_BODIES[idx]);
    let center = |patch: usize| picture.color(PATCH * patch as u32 + PATCH / 2, PATCH / 2);
    let mut measurements = Vec::new();
    for (patch, body) in [cold, rest, white, blue].into_iter().enumerate() {
        let color = center(patch);
        let lit = f64::from(color.into_iter().max().unwrap_or(0));
        measurements.push(MeasuredQuantity::at_least(
            format!("brightest channel of {}, level", body.0),
            lit,
            100.0,
        ));
        measurements.extend(measure_body(color, body));
    }
    Ok(measurements)
}

/// Measures both chromaticity coordinates of a black body.
fn measure_body(color: [u8; 3], (name, right): (&str, [f64; 2])) -> [MeasuredQuantity; 2] {
    let levels = color.map(f64::from);
    let (xy, tolerance) = (chromaticity(levels), rounding(levels));
    [("x", 0), ("y", 1)].map(|(axis, i)| {
        MeasuredQuantity::new(format!("{axis} of {name}"), xy[i], right[i], tolerance[i])
    })
}

/// Measures the luminance of a patch, relative to white.
fn measure_luminance(color: [u8; 3], name: &str, right: f64) -> MeasuredQuantity {
    let levels = color.map(f64::from);
    let [_, y, _] = xyz(levels);
    // The same tolerance as in `rounding`; Y increases with every channel.
    let [_, above, _] = xyz(levels.map(|level| level + 0.75));
    MeasuredQuantity::new(format!("Y of {name}"), y, right, above - y)
}

/// CIE x, y of a colour on an sRGB screen.
fn chromaticity(levels: [f64; 3]) -> [f64; 2] {
    let [x, y, z] = xyz(levels);
    [x / (x + y + z), y / (x + y + z)]
}

/// CIE X, Y, Z of a colour on an sRGB screen (IEC 61966-2-1).
fn xyz(levels: [f64; 3]) -> [f64; 3] {
    let [r, g, b] = levels.map(|level| srgb_decode(level / 255.0));
    [
        0.4124 * r + 0.3576 * g + 0.1805 * b,
        0.2126 * r + 0.7152 * g + 0.0722 * b,
        0.0193 * r + 0.1192 * g + 0.9505 * b,
    ]
}

/// The largest change of x and y if every channel changes by three quarters of a level, half a
/// level of it from rounding.
fn rounding(levels: [f64; 3]) -> [f64; 2] {
    let center = chromaticity(levels);
    let mut worst = [0.0_f64; 2];
    for corner in 0..8 {
        let moved: [f64; 3] =
            std::array::from_fn(|i| levels[i] + if corner >> i & 1 == 0 { -0.75 } else { 0.75 });
        let at = chromaticity(moved);
        worst = [0, 1].map(|i| worst[i].max((at[i] - center[i]).abs()));
    }
    worst
}

/// Distances from the centre of the wide picture, pixels.
const RADII: [u32; 4] = [60, 100, 140, 170];

/// Checks that equal angles from the motion have equal colours in all directions of the picture.
pub fn measure_wide(picture: &Picture) -> Result<Vec<MeasuredQuantity>, String> {
    let [width, height] = picture.size();
    let (x, y) = (width / 2, height / 2);
    let mut measurements = Vec::new();
    for r in RADII {
        // Pixels next to the centre lines, at equal distances on both sides.
        let around = [
            picture.color(x + r, y),
            picture.color(x - 1 - r, y - 1),
            picture.color(x, y + r),
            picture.color(x - 1, y - 1 - r),
        ];
        let spread = (0..3).map(|i| {
            let channel = || around.iter().map(|color| f64::from(color[i]));
            channel().fold(0.0, f64::max) - channel().fold(255.0, f64::min)
        });
        let spread = spread.fold(0.0, f64::max);
        // A program may interpolate D linearly. Its error may be half a percent, which is 3 nm, or
        // 16 levels of a saturated colour.
        measurements.push(MeasuredQuantity::new(
            format!("difference of colours {r} pixels from the centre, levels"),
            spread,
            0.0,
            20.0,
        ));
    }
    let (inner, outer) = (picture.color(x + RADII[0], y), picture.color(x + RADII[3], y));
    let change = difference(inner, outer);
    // Without any change of colour, equal colours would prove nothing.
    measurements.push(MeasuredQuantity::at_least(
        "change of colour from the centre outwards, levels",
        change,
        40.0,
    ));
    Ok(measurements)
}

/// Checks that the moving square has the colour of the one at rest.
pub fn measure_shift(picture: &Picture) -> Result<Vec<MeasuredQuantity>, String> {
    let [width, height] = picture.size();
    let [rest, coming] = [width / 4, 3 * width / 4].map(|x| picture.color(x, height / 2));
    let lit = f64::from(rest.into_iter().max().unwrap_or(0));
    Ok(vec![
        MeasuredQuantity::new(
            "difference of both squares, levels",
            difference(rest, coming),
            0.0,
            3.0,
        ),
        // Two black squares would be equal, too.
        MeasuredQuantity::at_least("brightest channel of the square at rest, level", lit, 64.0),
    ])
}

/// The largest difference of a channel.
fn difference(a: [u8; 3], b: [u8; 3]) -> f64 {
    a.into_iter().zip(b).map(|(a, b)| f64::from(a.abs_diff(b))).fold(0.0, f64::max)
}
