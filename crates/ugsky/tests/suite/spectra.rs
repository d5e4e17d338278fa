//! Light by an assumption about its spectrum.

use ugphysics::spectrum::{InfraredRule, Spectrum};
use ugphysics::{linear_srgb_to_xyz, luminance, xyz_to_linear_srgb};
use ugsky::{ALL_NM, Basis, SpectralTable, pure_lights};

const TEMPERATURES: [f64; 3] = [3500.0, 5900.0, 10_000.0];

const COLORS: [[f32; 3]; 5] =
    [[0.5, 0.5, 0.5], [0.5, 0.2, 0.1], [0.1, 0.5, 0.3], [0.2, 0.3, 0.5], [0.5, 0.45, 0.05]];

const KEEPING: [Basis; 2] = [Basis::Mixture, Basis::Planck(TEMPERATURES)];

#[test]
fn colours_at_rest_are_kept() {
    for basis in KEEPING {
        let table = SpectralTable::new(basis, true, true, 1.0, ALL_NM).unwrap();
        for rgb in COLORS {
            let seen = table.seen(rgb, 1.0);
            let error = (0..3).map(|i| (seen[i] - rgb[i]).abs()).fold(0.0, f32::max);
            assert!(error < 2e-5, "{basis:?} {rgb:?} {seen:?}");
        }
    }
}

/// White, primaries and pairs are those of (P20).
#[test]
fn mixtures_are_of_smooth_curves() {
    let table = SpectralTable::new(Basis::Mixture, true, true, 1.0, ALL_NM).unwrap();
    for spectrum in pure_lights(1.0) {
        let pure = xyz_to_linear_srgb(spectrum.seen(1.0)).map(f64::round);
        for step in -9..=9 {
            let doppler = libm::exp(0.1037 * f64::from(step));
            let seen = table.seen(pure.map(|part| part as f32), doppler).map(f64::from);
            let exact = xyz_to_linear_srgb(spectrum.seen(doppler));
            let size = exact.iter().fold(1e-6, |most: f64, part| most.max(part.abs()));
            let error = (0..3).map(|i| (seen[i] - exact[i]).abs() / size).fold(0.0, f64::max);
            assert!(error < 2e-3, "{pure:?} {doppler}: {seen:?} {exact:?}");
        }
    }
}

/// The mixture for a colour is nearly the curve of that colour: a blue sky stays blue ahead, where
/// a mixture of white and primaries alone was green.
#[test]
fn mixtures_are_nearly_the_curve_of_the_colour() {
    let table = SpectralTable::new(Basis::Mixture, true, true, 1.0, ALL_NM).unwrap();
    // A clear sky, its horizon, the sky around a low sun, and pale colours of all hues.
    let skies = [[0.36_f32, 0.5, 1.0], [0.61, 0.69, 1.0], [1.0, 0.76, 0.57], [1.0, 0.6, 0.3]];
    let hues = (0..12).map(|step| {
        let hue = |shift: f32| (0.5 * step as f32 - shift).rem_euclid(6.0);
        [0.0, 2.0, 4.0].map(|shift| 0.5 + 0.5 * ((hue(shift) - 3.0).abs() - 1.0).clamp(0.0, 1.0))
    });
    for rgb in skies.into_iter().chain(hues) {
        let xyz = linear_srgb_to_xyz(rgb.map(f64::from));
        let (spectrum, _) = Spectrum::with_infrared(xyz, InfraredRule::Constant);
        for doppler in [0.7, 0.8, 0.9, 1.1, 1.2, 1.3, 1.5, 2.0] {
            let seen = table.seen(rgb, doppler).map(f64::from);
            let exact = xyz_to_linear_srgb(spectrum.seen(doppler));
            let size = exact.iter().fold(0.0, |most: f64, part| most.max(part.abs()));
            let error = (0..3).map(|i| (seen[i] - exact[i]).abs() / size).fold(0.0, f64::max);
            assert!(error < 0.1, "{rgb:?} {doppler}: {seen:?} {exact:?}");
        }
    }
}

/// Along a line from one colour to another no light is darker than at its ends: the edge of a
/// yellowish line on a bluish road is between both, as it was at rest.
#[test]
fn mixtures_of_similar_colours_are_between_them() {
    let table = SpectralTable::new(Basis::Mixture, true, true, 1.0, ALL_NM).unwrap();
    let [road, line] = [[0.053, 0.054, 0.062], [0.352, 0.352, 0.283]];
    for ln_doppler in [-0.6, -0.3, 0.3, 0.6, 0.9] {
        let brightness = |rgb| luminance(table.seen(rgb, libm::exp(ln_doppler)).map(f64::from));
        let [dark, bright] = [road, line].map(brightness);
        for step in 0..=20 {
            let part = 0.05 * step as f32;
            let seen = brightness(std::array::from_fn(|i| road[i] + part * (line[i] - road[i])));
            assert!(
                seen > dark * 0.999 && seen < bright * 1.001,
                "{ln_doppler} {part}: {dark} {seen} {bright}"
            );
        }
    }
}

#[test]
fn dependent_temperatures_are_refused() {
    for kelvin in [[3500.0, 3500.0, 9000.0], [3500.0, 5900.0, f64::NAN], [1.0, 5900.0, 9000.0]] {
        assert!(SpectralTable::new(Basis::Planck(kelvin), true, true, 1.0, ALL_NM).is_err());
    }
}

/// The parts of a spectrum add up to the whole, and each is what is seen alone.
#[test]
fn parts_of_spectra_add_up() {
    let (grey, ranges) = ([0.4_f32; 3], [0.0..360.0, 360.0..830.0, 830.0..f64::INFINITY]);
    for basis in [Basis::Mixture, Basis::Grey, Basis::Planck(TEMPERATURES)] {
        let table = |range| SpectralTable::new(basis, true, true, 1.0, range).unwrap();
        let (whole, parts) = (table(ALL_NM), ranges.clone().map(table));
        // At rest only visible light is seen.
        assert!(
            [0, 2].iter().all(|&part| parts[part].seen(grey, 1.0).iter().all(|c| c.abs() < 1e-6))
        );
        for ln_doppler in [-0.93, -0.4, -0.02, 0.0, 0.3, 0.77] {
            let all = whole.seen(grey, libm::exp(ln_doppler));
            let sum: [f32; 3] = std::array::from_fn(|i| {
                parts.iter().map(|part| part.seen(grey, libm::exp(ln_doppler))[i]).sum()
            });
            let error = (0..3).map(|i| (sum[i] / all[i] - 1.0).abs()).fold(0.0, f32::max);
            assert!(error < 3e-3, "{basis:?} {ln_doppler}: {sum:?} {all:?}");
        }
        // Infrared light is seen when it approaches, ultraviolet light when it recedes.
        let brightness =
            |part: &SpectralTable, ln| luminance(part.seen(grey, libm::exp(ln)).map(f64::from));
        assert!(brightness(&parts[2], 0.77) > 0.1 && brightness(&parts[2], -0.77) == 0.0);
        assert!(brightness(&parts[0], -0.77) > 1e-4 && brightness(&parts[0], 0.77) == 0.0);
    }
}
