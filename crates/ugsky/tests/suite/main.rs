//! Skies: the light of footprints against integrals over the sphere, colours, spectra and stars.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod colours;
mod skies;
mod spectra;
mod stars;

use core::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::DVec3;
use ugsky::{Extent, Panorama, SkyRay, Texels};

fn panorama(size: [u32; 2], extent: Extent, light: impl Fn(DVec3) -> f64) -> Panorama {
    let [west, _] = extent.longitudes;
    let [_, north] = extent.latitudes;
    let texel = |idx: u32| {
        let [column, row] = [idx % size[0], idx / size[0]].map(|at| f64::from(at) + 0.5);
        let (sin_long, cos_long) =
            libm::sincos(west + extent.width() * column / f64::from(size[0]));
        let (sin_lat, cos_lat) = libm::sincos(north - extent.height() * row / f64::from(size[1]));
        let light = light(DVec3::new(cos_lat * sin_long, cos_lat * cos_long, sin_lat)) as f32;
        [light, 0.5, 1.0 - light, 1.0]
    };
    Panorama::new(size, Texels::Light((0..size[0] * size[1]).map(texel).collect()), extent).unwrap()
}

/// Directions everywhere, the poles and the date line among them.
fn directions() -> Vec<DVec3> {
    let mut all = vec![DVec3::Z, DVec3::NEG_Z, DVec3::NEG_Y, DVec3::Y, DVec3::X];
    for tilt in [1e-9, 1e-4, 3e-3, 0.02] {
        for turn in [0.1, 2.0, PI, -2.3] {
            let (sin, cos) = libm::sincos(turn);
            all.push(DVec3::new(tilt * sin, tilt * cos, 1.0).normalize());
            all.push(DVec3::new(tilt * sin, tilt * cos, -1.0).normalize());
            all.push(DVec3::new(tilt * sin, -1.0, tilt * cos).normalize());
        }
    }
    for step in 0..2000 {
        let part = |by: f64| (f64::from(step) * by).fract();
        let (z, turn) = (2.0 * part(0.618_034) - 1.0, TAU * part(0.754_878));
        let (sin, cos) = libm::sincos(turn);
        let level = (1.0 - z * z).sqrt();
        all.push(DVec3::new(level * sin, level * cos, z));
    }
    all
}

fn ray(direction: DVec3, [long, short]: [f64; 2], turn: f64) -> SkyRay {
    let one = direction.any_orthonormal_vector();
    let other = direction.cross(one);
    let (sin, cos) = libm::sincos(turn);
    let slopes = [long * (cos * one + sin * other), short * (cos * other - sin * one)];
    SkyRay { direction, slopes, doppler: 1.0 }
}

/// The mean of `light` over a pixel on the sphere.
fn mean(light: impl Fn(DVec3) -> f64, ray: &SkyRay) -> f64 {
    const N: i32 = 12;
    let mut sum = 0.0;
    for i in 0..N * N {
        let part = |at: i32| (f64::from(at) + 0.5) / f64::from(N) - 0.5;
        let place = ray.direction + part(i % N) * ray.slopes[0] + part(i / N) * ray.slopes[1];
        sum += light(place.normalize());
    }
    sum / f64::from(N * N)
}

/// Waves of 6 periods around the sphere, in all directions.
fn waves(d: DVec3) -> f64 {
    0.5 + 0.15 * (libm::sin(6.0 * d.x) + libm::cos(6.0 * d.y + 1.0) + libm::sin(6.0 * d.z + 2.0))
}

#[test]
fn footprints_are_means_at_every_size_and_place() {
    for size in [[512, 256], [360, 181], [300, 301]] {
        let sky = panorama(size, Extent::FULL, waves);
        for axes in
            [[1e-4, 1e-4], [0.012, 0.012], [0.03, 0.01], [0.05, 0.04], [0.09, 0.09], [0.09, 0.002]]
        {
            let mut worst: (f64, DVec3) = (0.0, DVec3::ZERO);
            for (idx, direction) in directions().into_iter().enumerate() {
                let ray = ray(direction, axes, idx as f64);
                let [light, half, rest, alpha] = sky.sampler().light(&ray, 1.0).unwrap();
                assert!((half - 0.5).abs() < 1e-5 && (alpha - 1.0).abs() < 1e-5, "{direction}");
                assert!((light + rest - 1.0).abs() < 1e-5);
                let error = (f64::from(light) - mean(waves, &ray)).abs();
                worst = if error > worst.0 { (error, direction) } else { worst };
            }
            // A square of a tenth of a wave, or thinner than the most eccentric ellipse, has
            // another shape than the kernel.
            let limit = if axes[0] > 0.05 { 6e-3 } else { 2e-3 };
            assert!(worst.0 < limit, "{size:?} {axes:?}: {worst:?}");
        }
    }
}

#[test]
fn a_uniform_sky_is_uniform_at_every_level() {
    let sky = panorama([256, 128], Extent::FULL, |_| 0.3);
    for axes in [[1e-6, 1e-6], [0.02, 0.02], [0.09, 0.04]] {
        for direction in directions() {
            let [light, ..] = sky.sampler().light(&ray(direction, axes, 0.4), 1.0).unwrap();
            assert!((light - 0.3).abs() < 1e-6, "{light} {direction}");
        }
    }
    // Larger ones have to be divided.
    assert_eq!(sky.sampler().light(&ray(DVec3::Z, [0.11, 0.01], 0.0), 1.0), None);
}

/// A part much smaller than a footprint adds its light to each that it is in: over a grid of
/// footprints its solid angle. The time does not depend on its size.
#[test]
fn a_tiny_part_keeps_its_light() {
    const SPACING: f64 = 0.005;
    const SIDE: f64 = 0.02;
    for half in [1e-2, 1e-3, 1e-5, 1e-9] {
        let extent =
            Extent { longitudes: [0.7 - half, 0.7 + half], latitudes: [0.3 - half, 0.3 + half] };
        let sky = panorama([16, 16], extent, |_| 0.25);
        let (sin, cos) = libm::sincos(0.3);
        let solid_angle = 4.0 * half * half * cos;
        let center = DVec3::new(cos * libm::sin(0.7), cos * libm::cos(0.7), sin);
        let one = center.any_orthonormal_vector();
        let axes = [one, center.cross(one)];
        let mut sums = [0.0; 2];
        for idx in 0..41 * 41 {
            // Off the middle of the grid.
            let [across, down] =
                [idx % 41 - 20, idx / 41 - 20].map(|at| SPACING * (f64::from(at) + 0.3));
            let ray = SkyRay {
                direction: (center + across * axes[0] + down * axes[1]).normalize(),
                slopes: axes.map(|axis| SIDE * axis),
                doppler: 1.0,
            };
            let [light, _, _, alpha] = sky.sampler().light(&ray, 1.0).unwrap();
            sums[0] += f64::from(light);
            sums[1] += f64::from(alpha);
        }
        let [light, alpha] = sums.map(|sum| sum * SPACING * SPACING / solid_angle);
        assert!((alpha - 1.0).abs() < 0.05, "{half}: {alpha}");
        assert!((light - 0.25).abs() < 0.0125, "{half}: {light}");
    }
}

/// A part of the sphere shows the same as the whole, and nothing outside of it.
#[test]
fn a_part_ends_at_its_angles() {
    let extent = Extent { longitudes: [-1.0, 2.4], latitudes: [-0.5, 0.7] };
    let part = panorama([340, 120], extent, waves);
    let west_of_date_line = Extent { longitudes: [2.0, 5.0], latitudes: [-FRAC_PI_2, 0.0] };
    let other = panorama([300, 157], west_of_date_line, waves);
    for (sky, extent) in [(&part, extent), (&other, west_of_date_line)] {
        let (mut n_inside, mut n_outside) = (0, 0);
        for direction in directions() {
            let ray = ray(direction, [0.01, 0.01], 1.0);
            let [light, _, _, alpha] = sky.sampler().light(&ray, 1.0).unwrap();
            let latitude = libm::asin(direction.z.clamp(-1.0, 1.0));
            let [west, east] = extent.longitudes;
            let longitude = west + (libm::atan2(direction.x, direction.y) - west).rem_euclid(TAU);
            let margin = |angle: f64, [low, high]: [f64; 2]| {
                if low <= -FRAC_PI_2 { high - angle } else { (angle - low).min(high - angle) }
            };
            let level = direction.truncate().length();
            let aside = level * (longitude - west).min(east - longitude);
            let inside = margin(latitude, extent.latitudes).min(aside);
            let turn = level * (west + TAU - longitude).min(longitude - east);
            if inside > 0.05 {
                n_inside += 1;
                assert!((alpha - 1.0).abs() < 1e-5, "{alpha} {direction}");
                assert!((f64::from(light) - mean(waves, &ray)).abs() < 2e-3, "{light} {direction}");
            } else if margin(latitude, extent.latitudes) < -0.05
                || (turn > 0.05 && longitude > east)
            {
                n_outside += 1;
                assert!(alpha.abs() < 1e-5 && light.abs() < 1e-5, "{alpha} {direction}");
            }
        }
        assert!(n_inside > 200 && n_outside > 200, "{n_inside} {n_outside}");
    }
}

/// Light that is linear in space has the mean of the pixel almost exactly, and waves of ten texels
/// tell that its second moments are those of the pixel, too.
#[test]
fn moments_of_footprints_are_those_of_pixels() {
    let linear = |d: DVec3| 0.5 + d.dot(DVec3::new(0.2, -0.3, 0.1));
    let waves = |d: DVec3| 0.5 + 0.4 * libm::sin(100.0 * d.x);
    let (one_texel, two_texels) = ([6e-3, 6e-3], [0.012, 0.012]);
    let check = |light: &dyn Fn(DVec3) -> f64, all_axes: &[[f64; 2]], limit: f64| {
        let sky = panorama([1024, 512], Extent::FULL, light);
        for (idx, direction) in directions().into_iter().enumerate() {
            for axes in all_axes {
                let ray = ray(direction, *axes, idx as f64);
                let [found, ..] = sky.sampler().light(&ray, 1.0).unwrap();
                let expected = mean(light, &ray);
                assert!(
                    (f64::from(found) - expected).abs() < limit,
                    "{axes:?} {direction}: {found} {expected}"
                );
            }
        }
    };
    check(&linear, &[[1e-4, 1e-4], one_texel, two_texels, [0.03, 0.01]], 1e-4);
    check(&waves, &[one_texel, two_texels], 9e-3);
}

/// A panorama of noise, half of it opaque, with its date line at a longitude of a whole column.
fn noise(date_line: u32) -> Panorama {
    const SIZE: [u32; 2] = [1600, 800];
    let texel = |idx: u32| {
        let [row, column] = [idx / SIZE[0], (idx % SIZE[0] + date_line) % SIZE[0]];
        let bytes = (row * SIZE[0] + column).wrapping_mul(2_654_435_761).to_le_bytes();
        [bytes[0], bytes[1], bytes[2], if column < SIZE[0] / 2 { 255 } else { bytes[3] }]
    };
    let texels = (0..SIZE[0] * SIZE[1]).map(texel);
    let west = TAU * f64::from(date_line) / f64::from(SIZE[0]) - PI;
    let extent = Extent { longitudes: [west, west + TAU], ..Extent::FULL };
    Panorama::new(SIZE, Texels::Srgb(texels.collect()), extent).unwrap()
}

/// Light depends neither on what was sampled before nor on where the date line is, beside which
/// texels are found and weighed in another way.
#[test]
fn caches_and_date_lines_do_not_show() {
    let (sky, turned) = (noise(0), noise(800));
    let (mut sampler, mut other) = (sky.sampler(), turned.sampler());
    let (mut latitude, mut longitude) = (0.3_f64, 0.0);
    for step in 0..6000 {
        let part = |by: f64| (f64::from(step) * by).fract();
        let [turn, climb, scale] = [0.618_034, 0.754_878, 0.569_84].map(part);
        match step % 100 {
            0 => (latitude, longitude) = (3.0 * turn - 1.5, 0.2 * climb - 0.1),
            // Far up and down, so that rows at the same place of the cache replace each other.
            1..50 => latitude += 0.15 * (climb - 0.5),
            _ => {
                (latitude, longitude) =
                    (latitude + 0.02 * (climb - 0.5), longitude + 0.04 * (turn - 0.5))
            }
        }
        let ((sin, cos), (up, level)) = (libm::sincos(longitude), libm::sincos(latitude));
        let direction = DVec3::new(level * sin, level * cos, up);
        let size = 1e-4 * libm::exp(5.0 * scale);
        let ray = ray(direction, [size, 0.6 * size], turn);
        let found = sampler.light(&ray, 1.0).unwrap();
        assert_eq!(sky.sampler().light(&ray, 1.0).unwrap(), found, "{direction} {size}");
        // Rows near the poles have fewer columns, which begin at the date line.
        if up.abs() > 0.7 {
            continue;
        }
        let beside = other.light(&ray, 1.0).unwrap();
        let error = (0..4).map(|i| (found[i] - beside[i]).abs()).fold(0.0, f32::max);
        assert!(error < 5e-5, "{direction} {size}: {found:?}, not {beside:?}");
    }
}
