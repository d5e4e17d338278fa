//! Panoramas warped for a moving observer against rays traced for a moving camera: two independent
//! methods (Weiskopf 2000).

use glam::DVec3;
use ugimage::{Compression, Format, LinearFrame, Metadata, PictureLimits};
use ugphoton::{
    CameraOptions, ColorShift, HueShift, Lens, MotionOptions, PictureOptions, RayOptions,
};
use ugphysics::{Velocity, srgb_encode};
use ugscene::Scene;
use ugwarp::{Arrangement, Basis, Extent, Panorama, Sky, Texels};

/// A room of 6 x 6 x 6 with the eye off its middle, lit alike everywhere.
fn room(colors: &str) -> Scene {
    let text = format!(
        "{colors} l 1;
         v a -3 -2 -2; v b 3 -2 -2; v c 3 4 -2; v d -3 4 -2; v e -3 -2 3; v f 3 -2 3; v g 3 4 3; v h -3 4 3;
         f (a b c d) one; f (h g f e) two; f (d c g h) three; f (a e f b) one; f (a d h e) two; f (b f g c) three;
         cam -ep 0 0 0 -vc 0 1 0 -ud 0 0 1;"
    );
    let source = ugparse::Source::new("room.ug", text);
    ugparse::parse(&source, &ugparse::Options::default()).unwrap().scene
}

fn camera() -> CameraOptions {
    CameraOptions {
        eye: Some(DVec3::ZERO),
        center: Some(DVec3::Y),
        up: Some(DVec3::Z),
        view_angle: Some((100.0, None)),
        ..CameraOptions::default()
    }
}

fn picture(size: [u32; 2], samples: u32) -> PictureOptions {
    PictureOptions { size, samples, camera: camera(), ..PictureOptions::default() }
}

fn traced(scene: &Scene, config: ugphoton::Config) -> LinearFrame {
    let rays = RayOptions { shadows: false, ..RayOptions::default() };
    ugphoton::light(scene.clone(), &ugphoton::Config { rays, ..config }).unwrap()
}

/// Peak signal-to-noise ratio, in dB, of pictures exposed so that white is at `peak`.
fn psnr(one: &LinearFrame, other: &LinearFrame, peak: f64) -> f64 {
    let (mut sum, mut n) = (0.0, 0.0);
    for (one, other) in one.pixels().iter().zip(other.pixels()) {
        for channel in 0..3 {
            let [one, other] = [one, other]
                .map(|pixel| srgb_encode((f64::from(pixel[channel]) / peak).clamp(0.0, 1.0)));
            sum += (one - other) * (one - other);
            n += 1.0;
        }
    }
    -10.0 * libm::log10(sum / n)
}

#[track_caller]
fn check(colors: &str, shift: ColorShift, basis: Basis) {
    let scene = room(colors);
    let size = [1024, 512];
    let rest_shift = match shift {
        ColorShift::Spectra(_) => ColorShift::SPECTRA,
        ColorShift::Hues(_) => ColorShift::default(),
    };
    let sky = traced(
        &scene,
        ugphoton::Config {
            picture: picture(size, 2),
            lens: Lens::Panorama,
            shift: rest_shift,
            ..ugphoton::Config::default()
        },
    );
    let sky = Panorama::new(size, Texels::Light(sky.pixels().to_vec()), Extent::FULL).unwrap();
    for beta in [DVec3::new(0.0, 0.5, 0.0), DVec3::new(0.4, -0.2, 0.3)] {
        let motion = MotionOptions { camera_velocity: Some(beta), ..MotionOptions::default() };
        let by_rays = traced(
            &scene,
            ugphoton::Config {
                picture: picture([96, 72], 6),
                motion,
                shift,
                ..ugphoton::Config::default()
            },
        );
        let velocity = Velocity::from_beta(beta).unwrap();
        let config = ugwarp::Config {
            velocity,
            shift,
            basis,
            picture: picture([96, 72], 4),
            ..Default::default()
        };
        let warped = ugwarp::light(&sky, &config).unwrap();
        let peak =
            by_rays.pixels().iter().flat_map(|pixel| pixel[..3].to_vec()).fold(0.0, f32::max);
        let found = psnr(&by_rays, &warped, f64::from(peak));
        assert!(found > 40.0, "{shift:?} {beta}: {found} dB");
    }
}

const HUES: &str = "c one 0.5 30 0.7; c two 0.6 150 0.4; c three 0.4 215 0.9;";

#[test]
fn geometry_is_that_of_a_moving_camera() {
    check(HUES, ColorShift::NONE, Basis::Mixture);
}

#[test]
fn hues_are_those_of_a_moving_camera() {
    check(HUES, ColorShift::default(), Basis::Mixture);
    let shift = HueShift { doppler: true, law: ugphysics::Brightness::Bolometric };
    check(HUES, ColorShift::Hues(shift), Basis::Mixture);
}

#[test]
fn spectra_are_those_of_a_moving_camera() {
    let shift = ColorShift::SPECTRA;
    let bodies = "c_bb one 3500 0.3; c_bb two 5900 0.3; c_bb three 10000 0.3;";
    check(bodies, shift, Basis::Planck([3500.0, 5900.0, 10_000.0]));
    // Greys are the same surfaces for both. Of other paints a panorama has only the colour.
    check("c one 0.6; c two 0.5; c three 0.4;", shift, Basis::Mixture);
}

/// Radiances at wavelengths, written to EXR and read, are seen at 0.9c as the scene itself is:
/// light all around of black bodies, measured surfaces and paints, under a lamp with a spectrum.
#[test]
fn radiances_are_those_of_a_moving_camera() {
    let shift = ColorShift::SPECTRA;
    let size = [64, 32];
    let output = ugphoton::Output::Color(Format::Exr);
    for (color, lit) in
        [("c_bb one 3000 0.5;", "1"), ("c_refl one foliage;", ""), ("c_rgb one 0.2 0.6 0.3;", "")]
    {
        let text = format!(
            "{color} c_bb lamp 4000; l 0.8 lamp; sphere 0 0 0 5 one {lit};
             cam -ep 0 0 0 -vc 0 1 0 -ud 0 0 1;"
        );
        let source = ugparse::Source::new("dome.ug", text);
        let scene = ugparse::parse(&source, &ugparse::Options::default()).unwrap().scene;
        let own = |size, samples| PictureOptions { output, ..picture(size, samples) };
        let sky = ugphoton::Config {
            picture: own(size, 1),
            lens: Lens::Panorama,
            shift,
            radiances: true,
            ..Default::default()
        };
        let sky = traced(&scene, sky);
        let file = Format::Exr.encode_linear(&sky, &Metadata::default(), Compression::Fast);
        let limits = PictureLimits::default();
        let bands =
            ugskybox::open_spectrum(&file, Arrangement::Equirectangular, None, &limits).unwrap();
        let all = Sky { bands: &bands, ..Sky::default() };
        let three =
            Panorama::new(size, Texels::Light(sky.pixels().to_vec()), Extent::FULL).unwrap();
        for beta in [DVec3::new(0.0, 0.9, 0.0), DVec3::new(0.0, -0.9, 0.0)] {
            let motion = MotionOptions { camera_velocity: Some(beta), ..MotionOptions::default() };
            let by_rays =
                ugphoton::Config { picture: own([24, 18], 4), motion, shift, ..Default::default() };
            let by_rays = traced(&scene, by_rays);
            let velocity = Velocity::from_beta(beta).unwrap();
            let config =
                ugwarp::Config { velocity, shift, picture: own([24, 18], 4), ..Default::default() };
            let peak =
                by_rays.pixels().iter().flat_map(|pixel| pixel[..3].to_vec()).fold(0.0, f32::max);
            let of = |sky: Sky<'_>| {
                psnr(&by_rays, &ugwarp::light(sky, &config).unwrap(), f64::from(peak))
            };
            let (found, of_three) = (of(all), of(Sky::from(&three)));
            assert!(found > 50.0 && of_three < 25.0, "{color} {beta}: {found} dB, {of_three} dB");
        }
    }
}

/// A camera that runs on a circle through the room and spins, at several of its own times: rays of
/// the room against the panorama at rest of the place where the camera is then.
#[test]
fn cameras_on_world_lines_see_the_same() {
    const CAROUSEL: &str = "motion carousel -orbit 0 1 0 0 0 1 .7 -spin .3 0 0;
                            cam -ep 0 0 0 -vc 0 1 0 -ud 0 0 1 -va 100 <carousel>;";
    let scene = room(&format!("{HUES} {CAROUSEL}"));
    let size = [1024, 512];
    let own = |size, samples| PictureOptions { size, samples, ..PictureOptions::default() };
    let gamma = 1.0 / libm::sqrt(0.51);
    for time in [0.0, 1.5, 5.0] {
        // Around (0, 1, 0) from the origin.
        let (sin, cos) = libm::sincos(0.7 * gamma * time);
        let place = DVec3::new(sin, 1.0 - cos, 0.0);
        let camera = CameraOptions { eye: Some(place), center: Some(place + DVec3::Y), ..camera() };
        let motion =
            MotionOptions { camera_velocity: Some(DVec3::ZERO), ..MotionOptions::default() };
        let picture = PictureOptions { camera, ..picture(size, 2) };
        let sky = ugphoton::Config { picture, motion, lens: Lens::Panorama, ..Default::default() };
        let sky = traced(&scene, sky).pixels().to_vec();
        let sky = Panorama::new(size, Texels::Light(sky), Extent::FULL).unwrap();
        let motion = MotionOptions { time, ..MotionOptions::default() };
        let by_rays = ugphoton::Config { picture: own([96, 72], 6), motion, ..Default::default() };
        let by_rays = traced(&scene, by_rays);
        let config = ugwarp::Config { time, picture: own([96, 72], 4), ..Default::default() };
        let warped = ugwarp::light(&sky, &config.with_camera_of(&scene).unwrap()).unwrap();
        let peak =
            by_rays.pixels().iter().flat_map(|pixel| pixel[..3].to_vec()).fold(0.0, f32::max);
        let found = psnr(&by_rays, &warped, f64::from(peak));
        assert!(found > 40.0, "{time}: {found} dB");
    }
}
