//! Skies behind scenes and in their mirrors: the same sky by three programs, and laws.

use glam::{DQuat, DVec3};
use ugimage::LinearFrame;
use ugphoton::{CameraOptions, ColorShift, Lens, MotionOptions, PictureOptions};
use ugphysics::{Velocity, srgb_encode};
use ugscene::Scene;
use ugskybox::{BuiltIn, Opened, SceneSky, SkySource};
use ugtests::programs;
use ugwarp::{Extent, Panorama, Star, Texels};

/// A smooth sky of all hues, white where two waves meet.
fn panorama() -> Opened {
    let texel = |idx: u32| {
        let [x, y] = [idx % 256, idx / 256].map(f64::from);
        let wave = |at: f64, phase: f64| {
            0.5 + 0.4 * libm::cos(at * core::f64::consts::TAU / 256.0 + phase)
        };
        let down = libm::sin(y * core::f64::consts::PI / 128.0);
        [
            wave(2.0 * x, 0.0) * down,
            wave(4.0 * y + x, 2.0) * down,
            wave(2.0 * (x - y), 4.0) * down,
            1.0,
        ]
        .map(|part| part as f32)
    };
    let texels = Texels::Light((0..256 * 128).map(texel).collect());
    let panorama = Some(Panorama::new([256, 128], texels, Extent::FULL).unwrap());
    Opened { panorama, ..Opened::default() }
}

/// Stars all over the sky.
fn stars() -> Opened {
    let star = |idx: u32| {
        let part = |by: f64| (f64::from(idx) * by).fract();
        let (z, turn) = (2.0 * part(0.618_034) - 1.0, core::f64::consts::TAU * part(0.754_878));
        let level = libm::sqrt(1.0 - z * z);
        let direction = DVec3::new(level * libm::sin(turn), level * libm::cos(turn), z);
        Star {
            direction,
            magnitude: -2.0 + 4.0 * part(0.569_84),
            kelvin: 3000.0 + 9000.0 * part(0.324_7),
        }
    };
    Opened { stars: (0..3000).map(star).collect(), ..Opened::default() }
}

fn parsed(text: &str) -> Scene {
    ugparse::parse(&ugparse::Source::new("t.ug", text), &ugparse::Options::default()).unwrap().scene
}

/// A triangle too far behind the eye to be met, which looks along +y.
const BEHIND: &str = "v a 0 -9e9 0; v b 1 -9e9 0; v c 0 -9e9 1; f (a b c); cam -ep 0 0 0 -vc 0 1 0 -ud 0 0 1 -va 100;";

fn picture(lens: Lens) -> PictureOptions {
    let size = match lens {
        Lens::Panorama => [128, 64],
        Lens::Cube => [144, 24],
        _ => [96, 72],
    };
    PictureOptions { size, samples: 1, ..PictureOptions::default() }
}

fn by_rays(text: &str, sky: &SceneSky, beta: DVec3, shift: ColorShift, lens: Lens) -> LinearFrame {
    let motion = MotionOptions { camera_velocity: Some(beta), ..MotionOptions::default() };
    let config =
        ugphoton::Config { motion, shift, lens, picture: picture(lens), ..Default::default() };
    ugphoton::light(parsed(text), &ugphoton::Config { sky: sky.clone(), ..config }).unwrap()
}

fn by_pipe(text: &str, sky: &SceneSky, beta: DVec3, shift: ColorShift) -> LinearFrame {
    let lorentz = uglorentz::Config { camera_velocity: Some(beta), ..Default::default() };
    let seen = uglorentz::apply(parsed(text), &lorentz).unwrap().0;
    let colored =
        ugdoppler::apply(seen, &ugdoppler::Config { shift, ..Default::default() }).unwrap().0;
    let config = ugrainbow::Config {
        picture: picture(Lens::Pinhole),
        sky: sky.clone(),
        ..Default::default()
    };
    ugrainbow::light(&colored, &config).unwrap()
}

/// The sky alone. `center`: where the camera looks.
fn warped(
    sky: &SceneSky,
    beta: DVec3,
    shift: ColorShift,
    lens: Lens,
    center: DVec3,
) -> LinearFrame {
    let SkySource::Opened(opened) = &sky.source else { panic!("a sky") };
    let camera = CameraOptions {
        center: Some(center),
        eye: Some(DVec3::ZERO),
        up: Some(DVec3::Z),
        view_angle: (lens == Lens::Pinhole).then_some((100.0, None)),
        ..CameraOptions::default()
    };
    let picture = PictureOptions { camera, ..picture(lens) };
    let velocity = Velocity::from_beta(beta).unwrap();
    let config = ugwarp::Config { velocity, shift, lens, picture, ..Default::default() };
    ugwarp::light(&**opened, &config).unwrap()
}

/// Peak signal-to-noise ratio, dB, of pictures exposed so that white is the brightest channel.
fn psnr(one: &LinearFrame, other: &LinearFrame) -> f64 {
    let channels = |frame: &LinearFrame| -> Vec<f64> {
        frame.pixels().iter().flat_map(|pixel| pixel[..3].to_vec()).map(f64::from).collect()
    };
    let (one, other) = (channels(one), channels(other));
    let peak = one.iter().copied().fold(0.0, f64::max);
    let shown = |light: f64| srgb_encode((light / peak).clamp(0.0, 1.0));
    let square =
        |(one, other): (&f64, &f64)| (shown(*one) - shown(*other)) * (shown(*one) - shown(*other));
    let sum: f64 = one.iter().zip(&other).map(square).sum();
    -10.0 * libm::log10(sum / one.len() as f64)
}

const SHIFTS: [ColorShift; 3] =
    [ColorShift::NONE, ColorShift::SPECTRA, ColorShift::hues(true, ugphysics::Brightness::Report)];

/// A sky without a scene before it is the same picture in all programs, by every lens.
#[test]
fn a_sky_alone_is_the_same_in_all_programs() {
    for opened in [panorama, stars] {
        let sky = SceneSky::from(opened());
        for beta in [DVec3::ZERO, DVec3::Y * 0.9, DVec3::new(0.5, -0.4, 0.3)] {
            for shift in SHIFTS {
                for lens in
                    [Lens::Pinhole, Lens::Panorama, Lens::Cube, Lens::Fisheye { angle: 3.0 }]
                {
                    let expected = warped(&sky, beta, shift, lens, DVec3::Y);
                    let found = psnr(&expected, &by_rays(BEHIND, &sky, beta, shift, lens));
                    assert!(found > 60.0, "{beta} {shift:?} {lens:?}: {found} dB");
                    if lens == Lens::Pinhole {
                        let found = psnr(&expected, &by_pipe(BEHIND, &sky, beta, shift));
                        assert!(found > 60.0, "{beta} {shift:?}: {found} dB");
                    }
                }
            }
        }
    }
}

/// A sky that is turned is that of a camera that is turned the other way.
#[test]
fn a_turned_sky_is_that_of_a_turned_camera() {
    let turn = DQuat::from_axis_angle(DVec3::Z, 0.5);
    for opened in [panorama, stars] {
        let sky = SceneSky { turn, ..SceneSky::from(opened()) };
        let beta = DVec3::new(0.3, 0.6, 0.0);
        let found = by_rays(BEHIND, &sky, beta, ColorShift::SPECTRA, Lens::Pinhole);
        let back = turn.inverse();
        let expected =
            warped(&sky, back * beta, ColorShift::SPECTRA, Lens::Pinhole, back * DVec3::Y);
        assert!(psnr(&expected, &found) > 60.0, "{}", psnr(&expected, &found));
    }
}

/// The picture with left and right exchanged.
fn flipped(frame: &LinearFrame) -> LinearFrame {
    let width = frame.width() as usize;
    let rows = frame.pixels().chunks(width);
    let pixels = rows.flat_map(|row| row.iter().rev().copied()).collect();
    LinearFrame::new([frame.width(), frame.height()], true, pixels)
}

/// The luminance of a picture by a pinhole times the solid angles of its pixels, up to a factor.
fn sum_of_light(frame: &LinearFrame) -> f64 {
    let [width, height] = [frame.width(), frame.height()].map(f64::from);
    let tan = libm::tan(50.0_f64.to_radians());
    let pixels = frame.pixels().iter().enumerate();
    let light = pixels.map(|(idx, pixel)| {
        let [x, y] = [idx as f64 % width + 0.5, (idx as f64 / width).floor() + 0.5];
        let [x, y] = [2.0 * x - width, 2.0 * y - height].map(|part| part / width * tan);
        let square = 1.0 + x * x + y * y;
        let [red, green, blue, _] = pixel.map(f64::from);
        ugphysics::luminance([red, green, blue]) / (square * libm::sqrt(square))
    });
    light.sum()
}

/// A mirror that fills the picture and recedes or approaches with β shows the sky as the mirrored
/// eye sees it, which moves with 2β/(1 + β²) and looks the other way, with left and right
/// exchanged. Stars in it keep the sum of their light.
#[test]
fn a_mirror_shows_the_sky_of_the_mirrored_eye() {
    for (beta, shift) in [0.3, -0.5, 0.3].into_iter().zip(SHIFTS) {
        let scene = format!(
            "surf plane 0 1 0; l 0; c white 1; v a -900 20 -900; v b 900 20 -900; v c 900 20 900; v d -900 20 900;
             f (a b c d) white plane <0 {beta} 0>; cam -ep 0 0 0 -vc 0 1 0 -ud 0 0 1 -va 100;"
        );
        let eye = DVec3::Y * (2.0 * beta / (1.0 + beta * beta));
        let both = |opened: Opened| {
            let sky = SceneSky::from(opened);
            let found = by_rays(&scene, &sky, DVec3::ZERO, shift, Lens::Pinhole);
            (found, flipped(&warped(&sky, eye, shift, Lens::Pinhole, -DVec3::Y)))
        };
        let (found, expected) = both(panorama());
        let alike = psnr(&expected, &found);
        // Footprints in mirrors are round.
        assert!(alike > 38.0, "{beta} {shift:?}: {alike} dB");
        let (found, expected) = both(stars());
        let ratio = sum_of_light(&found) / sum_of_light(&expected);
        assert!((ratio - 1.0).abs() < 0.02, "{beta} {shift:?}: {ratio}");
    }
}

/// Light of a sky behind a translucent face and beside an edge is the covered mean.
#[test]
fn a_scene_covers_its_sky_by_parts() {
    let sky = SceneSky::from(panorama());
    let scene = "l 1; c half 0.8 0 0 0.5; v a -9 2 -9; v b 0 2 -9; v c 0 2 9; v d -9 2 9; f (a b c d) half 1;
                 cam -ep 0 0 0 -vc 0 1 0 -ud 0 0 1 -va 100;";
    let shift = ColorShift::NONE;
    let alone = warped(&sky, DVec3::ZERO, shift, Lens::Pinhole, DVec3::Y);
    let dark = by_rays(scene, &SceneSky::default(), DVec3::ZERO, shift, Lens::Pinhole);
    let found = [
        by_rays(scene, &sky, DVec3::ZERO, shift, Lens::Pinhole),
        by_pipe(scene, &sky, DVec3::ZERO, shift),
    ];
    for frame in found {
        for ((sky, dark), pixel) in alone.pixels().iter().zip(dark.pixels()).zip(frame.pixels()) {
            for channel in 0..3 {
                let expected = dark[channel] + (1.0 - dark[3]) * sky[channel];
                assert!((pixel[channel] - expected).abs() < 2e-3, "{pixel:?}, not {expected}");
            }
        }
    }
}

/// Parts of a picture, both eyes and the sides of a cube have their part of the sky.
#[test]
fn parts_of_a_picture_have_their_part_of_the_sky() {
    for opened in [panorama, stars] {
        let config = ugphoton::Config { sky: opened().into(), ..Default::default() };
        let light = |config: &ugphoton::Config| ugphoton::light(parsed(BEHIND), config).unwrap();
        let whole = light(&ugphoton::Config { picture: picture(Lens::Pinhole), ..config.clone() });
        let [left, top, width, height] = [40, 30, 20, 11];
        let crop = Some([left, top, width, height]);
        let part =
            light(&ugphoton::Config { picture: picture(Lens::Pinhole), crop, ..config.clone() });
        for (idx, pixel) in part.pixels().iter().enumerate() {
            let [x, y] = [left + idx as u32 % width, top + idx as u32 / width];
            let expected = whole.pixels()[(y * whole.width() + x) as usize];
            assert!(
                (0..3).all(|i| (pixel[i] - expected[i]).abs() < 1e-5),
                "{pixel:?} {expected:?}"
            );
        }
        let size = [2 * whole.width(), whole.height()];
        let two = PictureOptions { size, ..picture(Lens::Pinhole) };
        let two = light(&ugphoton::Config { picture: two, stereo: Some(0.1), ..config.clone() });
        for (idx, pixel) in two.pixels().iter().enumerate() {
            let [x, y] = [idx as u32 % size[0] % whole.width(), idx as u32 / size[0]];
            assert_eq!(pixel[..3], whole.pixels()[(y * whole.width() + x) as usize][..3]);
        }
    }
}

/// The light of a white square that fills the picture, with a unit normal, at rest with the camera
/// under a uniform sky of light `level`, in which both move with `beta` along y.
fn lit_square(normal: DVec3, beta: f64, level: f32, shift: ColorShift, samples: u32) -> f64 {
    let texels = Texels::Light(vec![[level, level, level, 1.0]; 64 * 32]);
    let panorama = Some(Panorama::new([64, 32], texels, Extent::FULL).unwrap());
    let sky = SceneSky::from(Opened { panorama, ..Opened::default() });
    let across = normal.any_orthonormal_vector();
    let up = normal.cross(across);
    let corner = |x: f64, y: f64| 9.0 * (x * across + y * up) - normal;
    let vertex = |name: &str, at: DVec3| format!("v {name} {} {} {};", at.x, at.y, at.z);
    let text = format!(
        "c white 1; {} {} {} {} f (a b c d) white <0 {beta} 0>;
         cam -ep 0 0 0 -vc {} {} {} -ud {} {} {} -va 20;",
        vertex("a", corner(-1.0, -1.0)),
        vertex("b", corner(1.0, -1.0)),
        vertex("c", corner(1.0, 1.0)),
        vertex("d", corner(-1.0, 1.0)),
        -normal.x,
        -normal.y,
        -normal.z,
        up.x,
        up.y,
        up.z
    );
    let motion =
        MotionOptions { camera_velocity: Some(DVec3::Y * beta), ..MotionOptions::default() };
    let picture = PictureOptions { size: [1, 1], samples, ..PictureOptions::default() };
    let config = ugphoton::Config { motion, shift, picture, sky, ..Default::default() };
    f64::from(ugphoton::light(parsed(&text), &config).unwrap().pixels()[0][1])
}

/// The mean over a hemisphere around `normal`, weighted by the cosine, of D⁴, where D is the
/// Doppler factor of what is seen by an observer who moves with β along y.
fn mean_of_beamed_light(normal: DVec3, beta: f64) -> f64 {
    const N: usize = 400;
    let across = normal.any_orthonormal_vector();
    let gamma = 1.0 / libm::sqrt(1.0 - beta * beta);
    let mut sum = 0.0;
    for row in 0..N {
        // Equal parts of the square of the sine: equal weights.
        let square = (row as f64 + 0.5) / N as f64;
        for column in 0..N {
            let (sin, cos) =
                libm::sincos(core::f64::consts::TAU * (column as f64 + 0.5) / N as f64);
            let aside = cos * across + sin * normal.cross(across);
            let toward = libm::sqrt(1.0 - square) * normal + libm::sqrt(square) * aside;
            sum += libm::pow(gamma * (1.0 - beta * toward.y), -4.0);
        }
    }
    sum / (N * N) as f64
}

/// A white matt surface under a uniform sky has the radiance of the sky, and in motion the mean of
/// the beamed radiance, weighted by the cosine.
#[test]
fn a_uniform_sky_lights_as_theory_says() {
    let law = ColorShift::hues(true, ugphysics::Brightness::Bolometric);
    for normal in [DVec3::Y, -DVec3::Y, DVec3::Z, DVec3::new(0.48, 0.6, 0.64)] {
        for shift in [law, ColorShift::SPECTRA] {
            let found = lit_square(normal, 0.0, 0.5, shift, 16);
            assert!((found / 0.5 - 1.0).abs() < 1e-3, "{normal}: {found}");
        }
        for (beta, most) in [(0.5, 1e-3), (-0.9, 5e-3)] {
            let expected = 0.01 * mean_of_beamed_light(normal, beta);
            let found = lit_square(normal, beta, 0.01, law, 16);
            assert!((found / expected - 1.0).abs() < most, "{normal} {beta}: {found} {expected}");
            // With fewer samples it is nearly the same.
            let few = lit_square(normal, beta, 0.01, law, 4);
            assert!(
                (few / expected - 1.0).abs() < most.sqrt() + 0.05,
                "{normal} {beta}: {few} {expected}"
            );
        }
    }
}

/// The pipe lights a scene by the sky as rays do without shadows: by an option, and by the sky that
/// the scene states.
#[test]
fn the_pipe_lights_a_scene_as_rays_do() {
    let text =
        "c_rgb wall .5 .3 .25; v a -9 3 -9; v b 9 3 -9; v c 9 3 9; v d -9 3 9; f (a b c d) wall;
        v e -9 2 -3; v f 9 2 -3; v g 9 5 -2; v h -9 5 -2; f (e f g h);
        cam -ep 0 0 0 -vc 0 3 -1 -ud 0 0 1 -va 60;";
    let sky = SceneSky::from(BuiltIn::Day.open());
    for shift in [ColorShift::default(), ColorShift::spectra(true, true)] {
        for beta in [DVec3::ZERO, DVec3::new(0.1, 0.3, 0.0)] {
            let motion = MotionOptions { camera_velocity: Some(beta), ..MotionOptions::default() };
            let rays = ugphoton::RayOptions { shadows: false, ..Default::default() };
            let config = ugphoton::Config {
                rays,
                shift,
                sky: sky.clone(),
                picture: PictureOptions { samples: 8, ..picture(Lens::Pinhole) },
                motion: motion.clone(),
                ..Default::default()
            };
            let expected = ugphoton::light(parsed(text), &config).unwrap();
            let stated = format!("{text} sky day;");
            for (text, sky) in [(text, sky.clone()), (stated.as_str(), SceneSky::default())] {
                let scene = parsed(text);
                let mut sky = sky;
                sky.or_stated(scene.sky.as_ref());
                let lorentz =
                    uglorentz::Config { camera_velocity: Some(beta), ..Default::default() };
                let (scene, _) = uglorentz::apply(scene, &lorentz).unwrap();
                let doppler =
                    ugdoppler::Config { light: true, shift, sky, keep: true, ..Default::default() };
                let (scene, notes) = ugdoppler::apply(scene, &doppler).unwrap();
                assert!(!notes.contains(&ugdoppler::Note::NoLights), "{notes:?}");
                let config =
                    ugrainbow::Config { picture: config.picture.clone(), ..Default::default() };
                let found = ugrainbow::light(&scene, &config).unwrap();
                let mean = |frame: &LinearFrame| {
                    frame
                        .pixels()
                        .iter()
                        .map(|pixel| DVec3::new(pixel[0].into(), pixel[1].into(), pixel[2].into()))
                        .sum::<DVec3>()
                };
                let (found, expected) = (mean(&found), mean(&expected));
                // Display-encoded light adds up otherwise in sets of points.
                let bound = if shift.is_spectral() { 0.03 } else { 0.06 };
                assert!(
                    (found / expected - 1.0).abs().max_element() < bound,
                    "{beta}: {found} {expected}"
                );
            }
        }
    }
}

/// White is the light of a white level surface by day and at dusk, and the sun makes the most of it
/// by day.
#[test]
fn skies_without_a_file_light_a_level_surface_white() {
    let level = |sky: Opened| {
        let text = "c white 1; v a -9 -9 0; v b 9 -9 0; v c 9 9 0; v d -9 9 0; f (a b c d) white;
                    cam -ep 0 0 5 -vc 0 0 0 -ud 0 1 0 -va 20;";
        let picture = PictureOptions { size: [1, 1], samples: 8, ..PictureOptions::default() };
        let shift = ColorShift::hues(false, ugphysics::Brightness::Bolometric);
        let config = ugphoton::Config { picture, shift, sky: sky.into(), ..Default::default() };
        let [red, green, blue, _] =
            ugphoton::light(parsed(text), &config).unwrap().pixels()[0].map(f64::from);
        ugphysics::luminance([red, green, blue])
    };
    for sky in [BuiltIn::Day, BuiltIn::Dusk] {
        let found = level(sky.open());
        assert!((found - 1.0).abs() < 0.05, "{sky:?}: {found}");
    }
    let found = level(Opened { stars: Vec::new(), ..BuiltIn::Day.open() });
    assert!((0.2..0.4).contains(&found), "{found}");
    let Opened { stars, panorama, .. } = BuiltIn::Stars.open();
    assert!(stars.len() == 5042 && panorama.is_none());
    // Sirius, in the axes of a panorama.
    let brightest = stars.iter().min_by(|a, b| a.magnitude.total_cmp(&b.magnitude)).unwrap();
    assert!(
        (brightest.magnitude + 1.44).abs() < 0.05 && (brightest.direction.z + 0.287).abs() < 0.01
    );
}

/// A sky and the lamps of a scene add up, with and without spectra; the option leaves the lamps.
#[test]
fn a_sky_and_lamps_light_a_scene_together() {
    let square = "c red .9 10 .9; v a -9 -9 0; v b 9 -9 0; v c 9 9 0; v d -9 9 0; f (a b c d) red;
                  cam -ep 0 -3 5 -vc 0 0 0 -va 20;";
    let lamp = "c warm .9 40 .5; l .7 1 -2 3 warm; l .2;";
    for shift in [ColorShift::hues(true, ugphysics::Brightness::Bolometric), ColorShift::SPECTRA] {
        let light = |lamp: &str, sky: Option<BuiltIn>, sky_light: bool| {
            let picture = PictureOptions { size: [1, 1], samples: 4, ..PictureOptions::default() };
            let sky = sky.map_or_else(SceneSky::default, |sky| sky.open().into());
            let mut config = ugphoton::Config { picture, shift, sky, ..Default::default() };
            config.rays.sky_light = sky_light;
            let pixel =
                ugphoton::light(parsed(&format!("{square}{lamp}")), &config).unwrap().pixels()[0];
            [pixel[0], pixel[1], pixel[2]].map(f64::from)
        };
        let dusk = Some(BuiltIn::Dusk);
        let [of_lamp, of_sky, both] =
            [light(lamp, None, true), light("", dusk, true), light(lamp, dusk, true)];
        assert!(
            (0..3).all(|c| (of_lamp[c] + of_sky[c] - both[c]).abs() < 1e-3 * both[c]),
            "{both:?}"
        );
        assert_eq!(light(lamp, dusk, false), of_lamp);
        assert_eq!(light("", dusk, false), light("", None, true));
    }
}

/// The light of a sky is the same from tables, which scenes of many colours go without, and beside
/// it while a surface begins to move, when each point of the sky is integrated on its own.
#[test]
fn spectra_of_a_sky_are_tabulated_and_mixed_without_loss() {
    let square = "c red .9 10 .9; v a -9 -9 0; v b 9 -9 0; v c 9 9 0; v d -9 9 0;
                  cam -ep 0 -3 5 -vc 0 0 0 -va 20;";
    let colors: String = (0..5000).map(|idx| format!("c many{idx} .5;")).collect();
    let light = |colors: &str, of_square: f64, of_camera: f64| {
        let text = format!("{colors}{square} f (a b c d) red <0 {of_square} 0>;");
        let motion = MotionOptions {
            camera_velocity: Some(DVec3::Y * of_camera),
            in_place: true,
            ..MotionOptions::default()
        };
        let picture = PictureOptions { size: [2, 2], samples: 4, ..PictureOptions::default() };
        let sky = BuiltIn::Dusk.open().into();
        let config = ugphoton::Config {
            motion,
            picture,
            shift: ColorShift::SPECTRA,
            sky,
            ..Default::default()
        };
        ugphoton::light(parsed(&text), &config).unwrap()
    };
    for [many, moved, of_camera] in
        [[1.0, 0.0, 0.5], [1.0, 0.0, -0.6], [0.0, 1e-5, 0.0], [0.0, 1e-5, 0.4]]
    {
        let one = light("", 0.0, of_camera);
        let other = light(if many > 0.0 { &colors } else { "" }, moved, of_camera);
        for (one, other) in one.pixels().iter().zip(other.pixels()) {
            let largest = one.iter().fold(0.0, |most: f32, part| most.max(*part));
            let error = (0..3).map(|c| (one[c] - other[c]).abs() / largest).fold(0.0, f32::max);
            assert!(error < 1e-3, "{many} {moved} {of_camera}: {one:?} {other:?}");
        }
    }
}

/// The ground is at the lowest point, rests while the scene moves, and is in the shadow below it.
#[test]
fn a_stage_rests_below_the_scene() {
    let text = "c red 1 0; v a -1 -1 2; v b 1 -1 2; v c 1 1 2; v d -1 1 2; f (d c b a) red;
                cam -ep 0 -9 4 -vc 0 0 2 -va 60;";
    let light = |ground: bool, velocity: Option<DVec3>| {
        let motion = MotionOptions { velocity, in_place: true, ..MotionOptions::default() };
        let picture = PictureOptions { size: [40, 30], samples: 2, ..PictureOptions::default() };
        let config = ugphoton::Config {
            motion,
            picture,
            ground,
            sky: BuiltIn::Day.open().into(),
            ..Default::default()
        };
        ugphoton::light(parsed(text), &config).unwrap()
    };
    let at = |frame: &LinearFrame, x: u32, y: u32| frame.pixels()[(y * frame.width() + x) as usize];
    for velocity in [None, Some(DVec3::X * 0.5)] {
        let (bare, staged) = (light(false, velocity), light(true, velocity));
        // In the lower corner there is ground of 0.6, encoded, in full light.
        let [red, green, blue, _] = at(&staged, 2, 27).map(f64::from);
        let ground = ugphysics::luminance([red, green, blue]) / ugphysics::srgb_decode(0.6);
        assert!((ground - 1.0).abs() < 0.25, "{ground}");
        assert_ne!(at(&bare, 2, 27), at(&staged, 2, 27));
        assert_eq!(at(&bare, 20, 2), at(&staged, 20, 2));
    }
}

/// The statement of a scene is kept by the writer and by the filters of the pipe, and is the sky of
/// both renderers; an option overrides it.
#[test]
fn a_scene_states_its_sky() {
    let text = format!("sky dusk -ra 0 0 20;\n{BEHIND}");
    let scene = parsed(&text);
    let stated = scene.sky.clone().unwrap();
    assert_eq!((stated.file.as_str(), stated.turn), ("dusk", [0.0, 0.0, 20.0]));
    let written = ugparse::write(&scene);
    let written = String::from_utf8(written).unwrap();
    assert!(written.contains("sky dusk -ra 0 0 20;\n"), "{written}");
    assert_eq!(parsed(&written).sky, scene.sky);
    let named = parsed("sky \"my sky.png\"; v a 0 0 0;");
    assert!(String::from_utf8(ugparse::write(&named)).unwrap().contains("sky \"my sky.png\";"));
    let tidy = ugparse::tidy(
        &ugparse::Source::new("t.ug", "sky  01.50 -ra 1e0 +2 3;"),
        &ugparse::Options::default(),
    );
    assert_eq!(String::from_utf8(tidy.unwrap()).unwrap(), "sky 01.50 -ra 1 2 3;\n");
    let beta = DVec3::Y * 0.5;
    let none = SceneSky::default();
    let mut option = none.clone();
    option.or_stated(Some(&stated));
    let shift = ColorShift::SPECTRA;
    let expected = by_rays(BEHIND, &option, beta, shift, Lens::Pinhole);
    assert_eq!(by_rays(&text, &none, beta, shift, Lens::Pinhole), expected);
    assert!(psnr(&expected, &by_pipe(&text, &none, beta, shift)) > 60.0);
    let day = SceneSky::from(BuiltIn::Day.open());
    let overridden = by_rays(BEHIND, &day, beta, shift, Lens::Pinhole);
    assert_eq!(by_rays(&text, &day, beta, shift, Lens::Pinhole), overridden);
}

#[test]
fn wrong_statements_of_skies_are_refused() {
    for (text, expected) in [
        ("sky day; sky dusk;", "the scene has two skies"),
        ("def a; sky day; end; i (a);", "a sky cannot stand in a definition"),
        ("sky;", "expected a file name"),
        ("sky day -rx 3;", "expected `-ra` or `;`"),
        ("sky day -ra 3;", "a number"),
    ] {
        let found =
            ugparse::parse(&ugparse::Source::new("t.ug", text), &ugparse::Options::default());
        let message = found.err().map(|findings| findings.to_string()).unwrap_or_default();
        assert!(message.contains(expected), "{text}: {message}");
    }
}

/// A file that is not there is named at the statement.
#[test]
fn a_stated_sky_that_cannot_be_read_is_refused_at_its_place() {
    let scene = b"v a -1 3 -1; v b 1 3 -1; v c 0 3 1; f (a b c);\n  sky missing.png;\n";
    for program in ["ugrainbow", "ugphoton"] {
        let output = programs::fed(&format!("{program} -dt png"), scene);
        let message = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(!output.status.success() && message.contains("<stdin>:2:7"), "{message}");
        assert!(message.contains("sky `missing.png`: No such file"), "{message}");
    }
}
