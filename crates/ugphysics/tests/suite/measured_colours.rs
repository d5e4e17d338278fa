//! The reflectance of a colour in motion, against measured surfaces and against neighbours.  (P20)

use std::collections::BTreeMap;

use ugphysics::spectrum::{Reflectance, Spectrum};
use ugphysics::{linear_srgb_to_xyz, srgb_decode, xyz_to_linear_srgb};

/// Kinds, linear red, green and blue, and X, Y, Z over those of white at D = 1.05, 1.2, 1.3 and 1.5
/// of spectra that no number of (P20) was fitted to, by docs/physics/reflectance.py from earthlib
/// 1.1.0 (MIT licence, notice beside it). The form of the curve was chosen among about 25 by its
/// errors for these spectra, so they flatter it somewhat.
const MEASURED: &str = include_str!("../data/measured_colours.csv");
const DOPPLER: [f64; 4] = [1.05, 1.2, 1.3, 1.5];

/// L*, a*, b* of X, Y, Z over those of white.
pub fn lab(parts: [f64; 3]) -> [f64; 3] {
    let root = |part: f64| {
        if part > 216.0 / 24389.0 { libm::cbrt(part) } else { part * 841.0 / 108.0 + 4.0 / 29.0 }
    };
    let [x, y, z] = parts.map(root);
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

fn xyz_of(lab: [f64; 3]) -> [f64; 3] {
    let y = (lab[0] + 16.0) / 116.0;
    let cube = |root: f64| {
        if root > 6.0 / 29.0 { root * root * root } else { 108.0 / 841.0 * (root - 4.0 / 29.0) }
    };
    [y + lab[1] / 500.0, y, y - lab[2] / 200.0].map(cube)
}

/// ΔE*ab.
pub fn difference(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.into_iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}

/// L*, a*, b* of a surface, with white seen with the same D as white.
fn seen(rgb: [f64; 3], doppler: f64, white: [f64; 3]) -> [f64; 3] {
    let xyz = Spectrum::from_linear_srgb(rgb).shifted(doppler);
    lab(std::array::from_fn(|i| xyz[i] / white[i]))
}

fn white(doppler: f64) -> [f64; 3] {
    Spectrum::from_linear_srgb([1.0; 3]).shifted(doppler)
}

#[test]
fn surfaces_look_about_as_measured_ones() {
    let whites = DOPPLER.map(white);
    let mut errors: BTreeMap<&str, (usize, [f64; 4])> = BTreeMap::new();
    for line in MEASURED.lines().skip(1) {
        let (kind, numbers) = line.split_once(',').unwrap();
        let numbers: Vec<f64> = numbers.split(',').map(|number| number.parse().unwrap()).collect();
        let rgb = [numbers[0], numbers[1], numbers[2]];
        let (count, sums) = errors.entry(kind).or_default();
        *count += 1;
        for (row, sum) in sums.iter_mut().enumerate() {
            let measured = lab(std::array::from_fn(|i| numbers[3 + 3 * row + i]));
            *sum += difference(seen(rgb, DOPPLER[row], whites[row]), measured);
        }
    }
    let means: BTreeMap<&str, [f64; 4]> = errors
        .into_iter()
        .map(|(kind, (count, sums))| (kind, sums.map(|sum| sum / count as f64)))
        .collect();
    assert_eq!(means.len(), 23);
    let at_1_3 = means.values().map(|row| row[2]).sum::<f64>() / means.len() as f64;
    assert!(at_1_3 < 5.3, "{at_1_3} {means:?}");
    assert!(means["paint"][2] < 9.5 && means["metal"][2] < 9.0, "{means:?}");
    // With a sigmoid of a parabola canopies were off by 11, 33, 36 and 22.
    let canopy = means["canopy"];
    assert!(canopy.into_iter().zip([11.0, 16.0, 16.0, 20.0]).all(|(found, most)| found < most));
}

/// Two greys that are almost alike, and a metal roof: 38 and 50 apart by the notch of a sigmoid of
/// a parabola.
#[test]
fn a_greenish_grey_is_almost_grey_in_motion() {
    let grey = [srgb_decode(0.7354); 3];
    let greenish = [0.7188, 0.7354, 0.7188].map(srgb_decode);
    for doppler in [0.6, 0.8, 1.1, 1.3, 1.5, 2.0, 5.0] {
        let white = white(doppler);
        let apart = difference(seen(grey, doppler, white), seen(greenish, doppler, white));
        assert!(apart < 6.0, "D = {doppler}: {apart}");
    }
    let roof = Reflectance::from_linear_srgb([0.451, 0.508, 0.428].map(srgb_decode)).unwrap();
    let found = roof.at(700.0);
    assert!((0.17..0.25).contains(&found), "measured .21, found {found}");
}

/// Pairs of colours of a screen that differ by at most 3 at rest, in motion.
#[test]
fn neighbours_stay_neighbours() {
    let mut state = 1_u64;
    let mut random = || {
        // xorshift64.
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let rest = white(1.0);
    let dopplers = [0.6, 0.7, 0.8, 0.9, 1.05, 1.1, 1.2, 1.3, 1.4, 1.5, 2.0, 3.0, 5.0];
    let whites = dopplers.map(white);
    let (mut count, mut far, mut worst) = (0, 0, [0.0_f64; 13]);
    while count < 2000 {
        let first = [random(), random(), random()].map(srgb_decode);
        let xyz = linear_srgb_to_xyz(first);
        let at = lab(std::array::from_fn(|i| xyz[i] / rest[i]));
        let way = [random(), random(), random()].map(|part| 6.0 * part - 3.0);
        let near = xyz_of(std::array::from_fn(|i| at[i] + way[i]));
        let second = xyz_to_linear_srgb(std::array::from_fn(|i| near[i] * rest[i]));
        let is_inside = second.iter().all(|part| (0.0..=1.0).contains(part));
        if difference(way, [0.0; 3]) > 3.0 || !is_inside {
            continue;
        }
        count += 1;
        let spectra = [first, second].map(Spectrum::from_linear_srgb);
        let mut most = 0.0_f64;
        for ((doppler, white), worst) in dopplers.iter().zip(whites).zip(&mut worst) {
            let [a, b] = Spectrum::all_shifted(spectra.each_ref(), *doppler)
                .map(|xyz| lab(std::array::from_fn(|i| xyz[i] / white[i])));
            most = most.max(difference(a, b));
            *worst = worst.max(difference(a, b));
        }
        far += usize::from(most > 6.0);
    }
    // Most of these few are saturated blues, or at the edge of foliage.
    assert!(far < count / 100, "{far} of {count}: {worst:?}");
    let most = worst.into_iter().fold(0.0, f64::max);
    assert!(most < 12.5, "{worst:?}");
}
