//! Panoramas, cube maps and stars, and observers of them.

use glam::DVec3;
use ugphysics::Velocity;
use ugsky::{CubeMap, Extent, Observer, Panorama, PanoramaError, SkyRay, Star, StarLight, Texels};

use crate::directions;

/// The middle of each side of a cube map, and the directions of its columns and rows. The library has
/// the same table, but a test that took it from there would not find an error in it.
const SIDES: [[DVec3; 3]; 6] = [
    [DVec3::X, DVec3::NEG_Y, DVec3::NEG_Z],
    [DVec3::NEG_X, DVec3::Y, DVec3::NEG_Z],
    [DVec3::Z, DVec3::X, DVec3::Y],
    [DVec3::NEG_Z, DVec3::X, DVec3::NEG_Y],
    [DVec3::Y, DVec3::X, DVec3::NEG_Z],
    [DVec3::NEG_Y, DVec3::NEG_X, DVec3::NEG_Z],
];

fn colored_waves(d: DVec3) -> [f32; 4] {
    [0.5 + 0.4 * libm::sin(4.0 * d.x), 0.5 + 0.4 * libm::cos(5.0 * d.y), 0.5 + 0.5 * d.z, 1.0]
        .map(|x| x as f32)
}

/// The sides meet without seams, and directions are those of panoramas.
#[test]
fn cube_maps_become_panoramas() {
    const SIDE: u32 = 64;
    let face = |[middle, across, down]: [DVec3; 3]| {
        let texel = |idx: u32| {
            let [u, v] = [idx % SIDE, idx / SIDE]
                .map(|at| (2.0 * f64::from(at) + 1.0) / f64::from(SIDE) - 1.0);
            colored_waves((middle + u * across + v * down).normalize())
        };
        Texels::Light((0..SIDE * SIDE).map(texel).collect())
    };
    let panorama = CubeMap::new(SIDE, SIDES.map(face)).unwrap().panorama().unwrap();
    let mut sampler = panorama.sampler();
    let mut directions = directions();
    directions.extend([DVec3::ONE.normalize(), DVec3::new(1.0, 1.0, 0.0).normalize()]);
    for direction in directions {
        let ray = SkyRay {
            direction,
            slopes: [1e-4 * direction.any_orthonormal_vector(); 2],
            doppler: 1.0,
        };
        let (found, expected) = (sampler.light(&ray, 1.0).unwrap(), colored_waves(direction));
        let error = (0..4).map(|i| (found[i] - expected[i]).abs()).fold(0.0, f32::max);
        assert!(error < 4e-3, "{direction}: {found:?}, not {expected:?}");
    }
}

#[test]
fn sides_of_another_size_are_refused() {
    let faces = |n: usize| {
        std::array::from_fn(|idx| Texels::Srgb(vec![[0; 4]; if idx == 3 { n } else { 256 }]))
    };
    assert!(CubeMap::new(16, faces(256)).is_ok());
    assert!(matches!(CubeMap::new(16, faces(255)), Err(PanoramaError::Size)));
}

#[test]
fn what_is_no_panorama_is_refused() {
    let new = |size: [u32; 2], n: usize, extent: Extent| {
        Panorama::new(size, Texels::Srgb(vec![[0; 4]; n]), extent).err()
    };
    assert_eq!(new([32, 16], 32 * 16, Extent::FULL), None);
    assert_eq!(new([32, 16], 12, Extent::FULL), Some(PanoramaError::Size));
    assert_eq!(new([0, 16], 0, Extent::FULL), Some(PanoramaError::Size));
    assert_eq!(new([8, 4], 32, Extent::FULL), Some(PanoramaError::Coarse));
    let bad = Extent { longitudes: [1.0, f64::NAN], ..Extent::FULL };
    assert_eq!(new([32, 16], 32 * 16, bad), Some(PanoramaError::Extent));
}

fn observers() -> Vec<Observer> {
    let axis = DVec3::new(0.3, -0.5, 0.7);
    [0.0, 1e-6, 0.5, 2.0, 6.0]
        .map(|rapidity| Observer::new(Velocity::from_rapidity(axis, rapidity).unwrap()))
        .into()
}

/// Slopes are the differences of neighbouring directions, and lengths are multiplied by D.
#[test]
fn slopes_are_differences() {
    const STEP: f64 = 1e-6;
    for observer in observers() {
        for seen in directions().into_iter().step_by(4) {
            let slopes = [seen.any_orthonormal_vector(), seen.cross(seen.any_orthonormal_vector())];
            let ray = observer.ray(seen, slopes);
            for (slope, in_sky) in slopes.iter().zip(ray.slopes) {
                assert!((in_sky.length() / ray.doppler - 1.0).abs() < 1e-9, "{in_sky}");
                let at = |by: f64| observer.direction_in_sky((seen + by * slope).normalize()).0;
                let difference = (at(STEP / ray.doppler) - at(-STEP / ray.doppler)) / (2.0 * STEP);
                let error = (difference - in_sky / ray.doppler).length();
                assert!(error < 1e-6, "{observer:?} {seen} {error:e}");
            }
        }
    }
}

/// The parts of the effect: the shift alone, and brightness alone.
#[test]
fn parts_multiply() {
    let star = Star { direction: DVec3::Y, magnitude: -1.0, kelvin: 4000.0 };
    let light = |shift| StarLight::new(&[star], shift, 1.0).irradiance(&star, 2.0);
    let [all, shift, flux, none] =
        [[true, true], [true, false], [false, true], [false, false]].map(light);
    for channel in 0..3 {
        assert!((shift[channel] * 32.0 / all[channel] - 1.0).abs() < 1e-12);
        assert!((none[channel] * 32.0 / flux[channel] - 1.0).abs() < 1e-12);
    }
    let luminance = ugphysics::luminance(none) * 4.0;
    assert!((luminance / libm::exp10(0.4) - 1.0).abs() < 1e-4, "{luminance}");
}
