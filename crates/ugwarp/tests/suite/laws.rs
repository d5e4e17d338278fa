//! Pictures of panoramas against laws and published numbers.

use core::f64::consts::{PI, TAU};

use glam::DVec3;
use ugimage::{LinearFrame, Metadata, Samples};
use ugphysics::spectrum::Spectrum;
use ugphysics::{Brightness, Velocity, linear_srgb_to_xyz, srgb_encode, xyz_to_linear_srgb};
use ugwarp::{
    Background, Band, Basis, CameraOptions, Channel, ColorShift, Config, Extent, Filter, HueShift,
    Lens, Opened, Panorama, PictureOptions, Sky, Texels, light, render, run,
};

fn panorama(width: u32, color: impl Fn(DVec3) -> [f64; 3]) -> Panorama {
    let size = [width, width / 2];
    let texel = |idx: u32| {
        let [column, row] = [idx % size[0], idx / size[0]].map(|at| f64::from(at) + 0.5);
        let (sin_long, cos_long) = libm::sincos(TAU * (column / f64::from(size[0]) - 0.5));
        let (sin_lat, cos_lat) = libm::sincos(PI * (0.5 - row / f64::from(size[1])));
        let [red, green, blue] = color(DVec3::new(cos_lat * sin_long, cos_lat * cos_long, sin_lat));
        [red as f32, green as f32, blue as f32, 1.0]
    };
    Panorama::new(size, Texels::Light((0..size[0] * size[1]).map(texel).collect()), Extent::FULL)
        .unwrap()
}

fn ahead(beta: f64) -> Velocity {
    Velocity::from_beta(DVec3::new(0.0, beta, 0.0)).unwrap()
}

fn geometry(velocity: Velocity, size: [u32; 2], lens: Lens) -> Config {
    let picture = PictureOptions { size, samples: 1, ..PictureOptions::default() };
    Config { velocity, shift: ColorShift::NONE, picture, lens, ..Config::default() }
}

/// The mean of a function over the sphere, by the pixels of a panorama.
fn mean(frame: &LinearFrame, value: impl Fn([f32; 4]) -> f64) -> f64 {
    let (mut sum, mut total) = (0.0, 0.0);
    let height = frame.height();
    for (idx, &pixel) in frame.pixels().iter().enumerate() {
        let row = idx as u32 / frame.width();
        let weight = libm::sin(PI * (f64::from(row) + 0.5) / f64::from(height));
        sum += weight * value(pixel);
        total += weight;
    }
    sum / total
}

/// Everything ahead in the frame of the sky is within f/(βγ) of the middle (Howard 1995, eq. 16).
#[test]
fn the_forward_hemisphere_is_a_disc() {
    let sky = panorama(1024, |d| [if d.y > 0.0 { 1.0 } else { 0.0 }; 3]);
    for (beta, angle) in [(0.5, 140.0), (0.9, 90.0), (0.99, 40.0)] {
        let mut config = geometry(ahead(beta), [401, 401], Lens::Pinhole);
        config.picture.camera =
            CameraOptions { view_angle: Some((angle, None)), ..CameraOptions::default() };
        let frame = light(&sky, &config).unwrap();
        let area: f64 = frame.pixels().iter().map(|pixel| f64::from(pixel[0])).sum();
        let focal = 200.5 / libm::tan(0.5 * angle.to_radians());
        let expected = focal / (beta * ahead(beta).gamma());
        let found = (area / PI).sqrt();
        assert!((found - expected).abs() < 0.2, "{beta}: {found}, not {expected} pixels");
        // In each direction, too.
        let row = &frame.pixels()[200 * 401..201 * 401];
        let width: f64 = row.iter().map(|pixel| f64::from(pixel[0])).sum();
        assert!((0.5 * width - expected).abs() < 0.5, "{beta}: {width}, not {}", 2.0 * expected);
    }
}

/// A camera of 60° and a dome of 180° at 0.9 c: circles around the direction of motion, up to the
/// edge of the field of view, are seen where aberration has them (T15: the dome shows 308.3°).
#[test]
fn fields_of_view_are_those_of_a_moving_camera() {
    let seen = |in_sky: f64| 2.0 * libm::atan(libm::tan(0.5 * in_sky) / libm::sqrt(19.0));
    assert!((seen(0.5 * 308.316_134_5_f64.to_radians()) - 0.5 * PI).abs() < 1e-9);
    for degrees in [30.0, 60.0, 90.0, 98.0, 120.0, 150.0] {
        let in_sky = f64::to_radians(degrees);
        let sky = panorama(2048, |d| [if d.y > libm::cos(in_sky) { 1.0 } else { 0.0 }; 3]);
        for lens in [Lens::Pinhole, Lens::Fisheye { angle: PI }] {
            let mut config = geometry(ahead(0.9), [301, 301], lens);
            config.picture.camera =
                CameraOptions { view_angle: Some((60.0, None)), ..CameraOptions::default() };
            let expected = match lens {
                Lens::Pinhole => 150.5 * libm::tan(seen(in_sky)) / libm::tan(PI / 6.0),
                _ => 150.5 * seen(in_sky) / (0.5 * PI),
            };
            if seen(in_sky) >= PI / 6.0 && lens == Lens::Pinhole {
                continue;
            }
            let frame = light(&sky, &config).unwrap();
            for step in [1, 301] {
                // The row or the column through the middle.
                let middle = 150 * (302 - step);
                let pixels = (0..301).map(|k| f64::from(frame.pixels()[middle + k * step][0]));
                let found = 0.5 * pixels.sum::<f64>();
                assert!(
                    (found - expected).abs() < 0.5,
                    "{lens:?} {degrees}: {found}, not {expected} pixels"
                );
            }
        }
    }
}

/// A uniform sky has the means of D², D³ and D⁴ over the sphere of the observer.
#[test]
fn energies_of_a_uniform_sky() {
    const VALUE: f64 = 0.05;
    let grey = ugphysics::srgb_decode(VALUE);
    let sky = panorama(256, |_| [grey; 3]);
    for beta in [0.5, 0.9] {
        let gamma = ahead(beta).gamma();
        let seen = |law: Brightness| {
            let mut config = geometry(ahead(beta), [512, 256], Lens::Panorama);
            config.shift = ColorShift::Hues(HueShift { doppler: true, law });
            light(&sky, &config).unwrap()
        };
        let value = |pixel: [f32; 4]| srgb_encode(f64::from(pixel[1])) / VALUE;
        let square = mean(&seen(Brightness::Report), |pixel| value(pixel) * value(pixel));
        let light = |pixel: [f32; 4]| f64::from(pixel[1]) / grey;
        let cube = mean(&seen(Brightness::Photon), light);
        let fourth = mean(&seen(Brightness::Bolometric), light);
        let expected = [1.0, gamma, gamma * gamma * (1.0 + beta * beta / 3.0)];
        for (found, expected) in [square, cube, fourth].into_iter().zip(expected) {
            assert!((found / expected - 1.0).abs() < 1e-3, "{beta}: {found}, not {expected}");
        }
    }
}

/// Resampling neither adds nor loses light: the mean over D² dΩ of the observer is that over the
/// sky.
#[test]
fn light_is_kept_by_resampling() {
    let color = |d: DVec3| [0.5 + 0.5 * d.x, 0.5 + 0.5 * libm::sin(9.0 * d.z + d.x), d.y * d.y];
    let sky = panorama(512, color);
    let rest = light(&sky, &geometry(Velocity::ZERO, [512, 256], Lens::Panorama)).unwrap();
    for beta in [0.5, 0.9] {
        let mut config = geometry(ahead(beta), [1024, 512], Lens::Panorama);
        config.picture.channels = vec![Channel::Doppler];
        let seen = light(&sky, &config).unwrap();
        let Samples::Float(factors) = &seen.planes()[0].samples else { panic!("numbers") };
        let pixels = seen.pixels().iter().zip(factors).map(|(pixel, factor)| {
            let square = factor * factor;
            [square * pixel[0], square * pixel[1], square * pixel[2], 1.0]
        });
        let weighted = LinearFrame::new([1024, 512], true, pixels.collect());
        for channel in 0..3 {
            let [found, expected] =
                [&weighted, &rest].map(|frame| mean(frame, |pixel| f64::from(pixel[channel])));
            assert!(
                (found / expected - 1.0).abs() < 1e-3,
                "{beta} {channel}: {found}, not {expected}"
            );
        }
    }
}

/// A uniform sky of a black body at T is one at D T in every direction.
#[test]
fn a_black_body_sky_stays_one() {
    let spectrum = Spectrum::blackbody(5800.0, 0.4);
    let rgb = xyz_to_linear_srgb(spectrum.seen(1.0));
    let sky = panorama(64, |_| rgb);
    for beta in [0.1, 0.3] {
        let mut config = geometry(ahead(beta), [512, 256], Lens::Panorama);
        config.shift = ColorShift::spectra(true, true);
        config.basis = Basis::Planck([3500.0, 5800.0, 10_000.0]);
        config.picture.channels = vec![Channel::Doppler];
        let frame = light(&sky, &config).unwrap();
        let Samples::Float(factors) = &frame.planes()[0].samples else { panic!("numbers") };
        for (pixel, &factor) in frame.pixels().iter().zip(factors) {
            let xyz = linear_srgb_to_xyz([pixel[0], pixel[1], pixel[2]].map(f64::from));
            let exact = spectrum.seen(f64::from(factor));
            for axis in 0..2 {
                let [found, expected] =
                    [xyz, exact].map(|xyz| xyz[axis] / (xyz[0] + xyz[1] + xyz[2]));
                assert!(
                    (found - expected).abs() < 1e-4,
                    "{beta} {factor}: {found}, not {expected}"
                );
            }
            assert!((xyz[1] / exact[1] - 1.0).abs() < 2e-3, "{beta} {factor}: {xyz:?} {exact:?}");
        }
    }
}

/// The dipole of the microwave background: half the difference of the temperatures D T₀ ahead and
/// behind, 3362.12 µK at 369.82 km/s (Planck 2018).
#[test]
fn the_dipole_of_the_microwave_background() {
    const KELVIN: f64 = 2.725_48;
    let sky = panorama(64, |_| [0.1; 3]);
    let temperature = |center: DVec3| {
        let mut config = geometry(ahead(369.82 / 299_792.458), [1, 1], Lens::Pinhole);
        config.picture.camera = CameraOptions { center: Some(center), ..CameraOptions::default() };
        config.picture.channels = vec![Channel::Doppler];
        let frame = light(&sky, &config).unwrap();
        let Samples::Float(factors) = &frame.planes()[0].samples else { panic!("numbers") };
        KELVIN * f64::from(factors[0])
    };
    let dipole = 0.5e6 * (temperature(DVec3::Y) - temperature(DVec3::NEG_Y));
    assert!((dipole - 3_362.118_538).abs() < 0.3, "{dipole} µK");
}

/// Peak signal-to-noise ratio of two frames, in dB; white is the peak.
fn psnr(one: &LinearFrame, other: &LinearFrame) -> f64 {
    let (mut sum, mut n) = (0.0, 0.0);
    for (one, other) in one.pixels().iter().zip(other.pixels()) {
        for channel in 0..3 {
            let [one, other] =
                [one, other].map(|pixel| srgb_encode(f64::from(pixel[channel].clamp(0.0, 1.0))));
            sum += (one - other) * (one - other);
            n += 1.0;
        }
    }
    -10.0 * libm::log10(sum / n)
}

/// Hills of all sizes down to a few texels, and a soft edge.
fn landscape(d: DVec3) -> [f64; 3] {
    let wave = |k: f64, shift: f64| {
        libm::sin(k * d.x + shift) * libm::cos(k * d.z - shift) * libm::sin(k * d.y)
    };
    let sum: f64 = [(3.0, 0.2), (9.0, 1.0), (27.0, 2.0), (60.0, 0.5)]
        .iter()
        .map(|&(k, s)| wave(k, s) / libm::sqrt(k))
        .sum();
    let edge = 1.0 / (1.0 + libm::exp(-40.0 * (d.z + 0.2 * d.x)));
    [0.4 + 0.3 * sum, 0.15 + 0.5 * edge + 0.2 * sum, 0.5 - 0.3 * edge]
}

fn as_panorama(frame: &LinearFrame) -> Panorama {
    Panorama::new(
        [frame.width(), frame.height()],
        Texels::Light(frame.pixels().to_vec()),
        Extent::FULL,
    )
    .unwrap()
}

/// A panorama warped by v and then by −v is the same again, light included.
#[test]
fn warping_back_is_the_inverse() {
    let sky = panorama(1024, landscape);
    let size = [1024, 512];
    let rest = light(&sky, &geometry(Velocity::ZERO, size, Lens::Panorama)).unwrap();
    assert!(
        psnr(
            &rest,
            &LinearFrame::new(size, true, {
                let exact = |idx: u32| {
                    let [column, row] = [idx % 1024, idx / 1024].map(|at| f64::from(at) + 0.5);
                    let (sin_long, cos_long) = libm::sincos(TAU * (column / 1024.0 - 0.5));
                    let (sin_lat, cos_lat) = libm::sincos(PI * (0.5 - row / 512.0));
                    let [red, green, blue] =
                        landscape(DVec3::new(cos_lat * sin_long, cos_lat * cos_long, sin_lat));
                    [red as f32, green as f32, blue as f32, 1.0]
                };
                (0..1024 * 512).map(exact).collect()
            })
        ) > 50.0
    );
    let velocity = Velocity::from_beta(DVec3::new(0.3, 0.35, 0.2)).unwrap();
    assert!((velocity.speed() - 0.5).abs() < 0.01);
    for shift in [
        ColorShift::NONE,
        ColorShift::Hues(HueShift { doppler: false, law: Brightness::Bolometric }),
    ] {
        let warped = |sky: &Panorama, velocity: Velocity| {
            let config = Config { shift, ..geometry(velocity, size, Lens::Panorama) };
            light(sky, &config).unwrap()
        };
        let back = warped(&as_panorama(&warped(&sky, velocity)), -velocity);
        let found = psnr(&rest, &back);
        assert!(found > 40.0, "{shift:?}: {found} dB");
    }
}

/// Filters widen the pixel as they are documented, and more samples change little.
#[test]
fn samples_and_filters_agree() {
    let sky = panorama(1024, landscape);
    let picture = |samples: u32, filter: Filter| {
        let mut config = geometry(ahead(0.7), [160, 120], Lens::Pinhole);
        config.picture.camera.view_angle = Some((100.0, None));
        (config.picture.samples, config.picture.filter) = (samples, filter);
        light(&sky, &config).unwrap()
    };
    for filter in Filter::ALL {
        let found = psnr(&picture(1, filter), &picture(4, filter));
        assert!(found > 45.0, "{filter:?}: {found} dB");
    }
}

/// Near the speed of light a pixel shows most of the sky, and the picture is still a mean of it.
#[test]
fn pixels_that_show_half_the_sky() {
    let sky = panorama(256, |d| [0.5 + 0.5 * d.x, 0.25, if d.y > 0.0 { 1.0 } else { 0.0 }]);
    for rapidity in [3.0, 8.0, 30.0, 100.0] {
        let velocity = Velocity::from_rapidity(DVec3::Y, rapidity).unwrap();
        let frame = light(&sky, &geometry(velocity, [9, 9], Lens::Pinhole)).unwrap();
        for pixel in frame.pixels() {
            assert!(
                (pixel[1] - 0.25).abs() < 1e-4 && (0.0..=1.001).contains(&pixel[0]),
                "{rapidity}: {pixel:?}"
            );
        }
        assert!(frame.pixels()[0][2] < 0.01 || rapidity < 4.0);
    }
}

/// The largest numbers beside 0 add up to more than single precision holds. They stay numbers.
#[test]
fn the_brightest_light_is_a_number() {
    let texel = |idx: usize| {
        if idx.is_multiple_of(3) { [f32::MAX, f32::MAX, f32::MAX, 1.0] } else { [0.0; 4] }
    };
    let texels = Texels::Light((0..64 * 32).map(texel).collect());
    let sky = Panorama::new([64, 32], texels, Extent::FULL).unwrap();
    let shift = ColorShift::spectra(true, true);
    let mut config = Config { shift, velocity: ahead(0.5), ..Config::default() };
    config.picture.size = [8, 6];
    let notes = render(&sky, &config).unwrap().notes;
    assert!(notes[0].to_string().starts_with("max intensity is 3402823466"), "{notes:?}");
    assert!(light(&sky, &config).unwrap().pixels().iter().flatten().all(|part| part.is_finite()));
}

/// Grey daylight in an infrared, a visible and an ultraviolet panorama is grey daylight. Infrared
/// light alone is seen where it approaches, as daylight between its wavelengths gives.
#[test]
fn infrared_and_ultraviolet_light_is_seen_in_motion() {
    let sky = |level: f64| panorama(256, move |_| [level; 3]);
    let band = |range_nm, level| Band { range_nm, basis: Basis::Grey, panorama: sky(level) };
    let shift = ColorShift::spectra(true, true);
    let config = Config { shift, ..geometry(ahead(0.6), [64, 32], Lens::Panorama) };
    let seen = |visible: f64, bands: &[Band]| {
        let (panorama, stars) = (sky(visible), &[][..]);
        light(Sky { panorama: Some(&panorama), bands, stars, highlights: None }, &config).unwrap()
    };
    let both = [band(830.0..1e6, 0.4), band(0.0..360.0, 0.4)];
    let (whole, parts) = (seen(0.4, &[]), seen(0.4, &both));
    for (whole, parts) in whole.pixels().iter().zip(parts.pixels()) {
        // The edges of the ranges are between entries of the tables.
        let most = whole[..3].iter().fold(0.0, |most: f32, part| most.max(*part));
        assert!((0..3).all(|i| (parts[i] - whole[i]).abs() < 1e-2 * most), "{whole:?} {parts:?}");
    }
    let infrared = seen(0.0, &both[..1]);
    // A pixel ahead, of D about 2, and one behind, of D about 1/2.
    let [front, back] = [infrared.pixels()[16 * 64 + 32], infrared.pixels()[16 * 64]];
    let white = ugphysics::spectrum::integrate(ugphysics::spectrum::daylight)[1];
    // The middle of the pixel is half a pixel off, in longitude and latitude.
    let cosine = libm::cos(PI / 64.0) * libm::cos(PI / 64.0);
    let doppler = 1.0 / (ahead(0.6).gamma() * (1.0 - 0.6 * cosine));
    let rest =
        |nm: f64| if nm >= 830.0 { 0.4 / white * ugphysics::spectrum::daylight(nm) } else { 0.0 };
    let flux = libm::pow(doppler, 5.0);
    let xyz = ugphysics::spectrum::integrate(|nm| flux * rest(nm * doppler));
    let expected = xyz_to_linear_srgb(xyz);
    for channel in 0..3 {
        assert!(
            (f64::from(front[channel]) / expected[channel] - 1.0).abs() < 0.02,
            "{front:?} {expected:?}"
        );
        assert_eq!(back[channel], 0.0);
    }
}

/// Compressing a PNG file while the picture is drawn gives the same bytes as compressing the
/// finished picture, with and without transparent pixels.
#[test]
fn files_are_those_of_whole_pictures() {
    let colors = |d: DVec3| [0.5 + 0.5 * d.x, 0.5 + 0.5 * d.y, 0.5 + 0.5 * d.z];
    let opened = Opened { panorama: Some(panorama(256, colors)), ..Opened::default() };
    let metadata =
        Metadata { software: "ugwarp".into(), comment: "ugwarp".into(), ..Metadata::default() };
    let fisheye = Lens::Fisheye { angle: PI };
    for (lens, samples, small) in
        [(Lens::Pinhole, 1, false), (fisheye, 2, false), (fisheye, 1, true)]
    {
        let mut config = geometry(ahead(0.6), [75, 101], lens);
        (config.picture.samples, config.picture.small) = (samples, small);
        config.picture.background = Background::Transparent;
        let file = run(&config, &opened, &metadata, &()).unwrap();
        let mut picture = render(&opened, &config).unwrap();
        picture.metadata = metadata.clone();
        assert_eq!(file.notes, picture.notes);
        assert!(file.bytes == picture.into_file(), "{lens:?}");
    }
}
