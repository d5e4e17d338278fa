//! Compares the ray tracer with the pipe in exact mode: two renderers that share scenes and
//! colours, and neither geometry nor samples.

use glam::DVec3;
use ugimage::{LinearFrame, Samples};
use uglight::ColorShift;
use uglorentz::Pieces;
use ugphoton::RayOptions;
use ugphysics::Brightness;
use ugrainbow::{Channel, Output, PictureOptions};
use ugscene::{MotionOptions, Scene};
use ugtests::scenes;

const SIZE: [u32; 2] = [200, 150];

/// Motions of a scene.
#[derive(Clone, Copy, Debug, Default)]
struct Motion {
    velocity: Option<DVec3>,
    camera: Option<DVec3>,
    in_place: bool,
}

fn picture() -> PictureOptions {
    let channels = vec![Channel::Id, Channel::Depth];
    let output = Output::Color(ugimage::Format::Exr);
    PictureOptions { size: SIZE, samples: 1, channels, output, ..PictureOptions::default() }
}

/// The light of a scene in exact mode.
fn by_pipe(scene: &Scene, motion: Motion, shift: ColorShift) -> LinearFrame {
    let config = uglorentz::Config {
        velocity: motion.velocity,
        camera_velocity: motion.camera,
        in_place: motion.in_place,
        pieces: Pieces::PerEdge(1),
        size: SIZE,
        ..uglorentz::Config::default()
    };
    let (mut seen, _) = uglorentz::apply(scene.clone(), &config).unwrap();
    // Lights keep their place in the frames of what they light.
    seen.remarks.comments.clear();
    let config = ugrainbow::Config { picture: picture(), exact: Some(shift), ..ugrainbow::Config::default() };
    ugrainbow::light(&seen, &config).unwrap()
}

/// The light of a scene by rays, without shadows and reflections.
fn by_rays(scene: &Scene, motion: Motion, shift: ColorShift) -> LinearFrame {
    let config = ugphoton::Config {
        motion: MotionOptions {
            velocity: motion.velocity,
            camera_velocity: motion.camera,
            in_place: motion.in_place,
            ..MotionOptions::default()
        },
        shift,
        picture: picture(),
        rays: RayOptions { depth: 0, shadows: false, ..RayOptions::default() },
        ..ugphoton::Config::default()
    };
    ugphoton::light(scene.clone(), &config).unwrap()
}

fn depths(frame: &LinearFrame) -> &[f32] {
    let plane = frame.planes().iter().find(|plane| plane.name == "Z").unwrap();
    match &plane.samples {
        Samples::Float(depths) => depths,
        Samples::Whole(_) => panic!("depths are not whole numbers"),
    }
}

fn ids(frame: &LinearFrame) -> &[u32] {
    let plane = frame.planes().iter().find(|plane| plane.name == "id").unwrap();
    match &plane.samples {
        Samples::Whole(ids) => ids,
        Samples::Float(_) => panic!("ids are whole numbers"),
    }
}

/// The pixels at and around one.
fn around(at: usize) -> impl Iterator<Item = usize> {
    let [width, height] = SIZE.map(i64::from);
    let (column, row) = (at as i64 % width, at as i64 / width);
    (-1..=1)
        .flat_map(move |down| (-1..=1).map(move |across| (column + across, row + down)))
        .filter(move |(x, y)| (0..width).contains(x) && (0..height).contains(y))
        .map(move |(x, y)| (y * width + x) as usize)
}

/// True if light is between the least and the greatest of pixels, within a tolerance.
fn is_between(light: [f32; 4], pixels: &[[f32; 4]], around: impl Iterator<Item = usize>) -> bool {
    let all: Vec<[f32; 4]> = around.map(|at| pixels[at]).collect();
    (0..3).all(|channel| {
        let least = all.iter().map(|pixel| pixel[channel]).fold(f32::INFINITY, f32::min);
        let greatest = all.iter().map(|pixel| pixel[channel]).fold(f32::NEG_INFINITY, f32::max);
        let tolerance = 1e-3 + 0.02 * greatest.abs();
        (least - tolerance..=greatest + tolerance).contains(&light[channel])
    })
}

/// Checks that both show the same face with the same light at every sample, but for samples beside
/// a boundary between faces.
fn check(name: &str, motion: Motion, shift: ColorShift) {
    let mut scene = scenes::parse(&scenes::text(name));
    scene.wires.clear();
    // Moving lights and surfaces are for rays alone.
    scene.lights.retain(|light| light.motion.body().is_none());
    scene.illums.iter().for_each(|illum| assert!(matches!(illum, ugscene::Illum::Level(_)), "{name}"));
    let (pipe, rays) = (by_pipe(&scene, motion, shift), by_rays(&scene, motion, shift));
    let (of_pipe, of_rays) = (ids(&pipe), ids(&rays));
    assert!(of_pipe.iter().filter(|&&id| id > 0).count() > 100, "{name} {motion:?}: an empty picture");
    let mut n_other = 0;
    for (at, (a, b)) in pipe.pixels().iter().zip(rays.pixels()).enumerate() {
        let size = a.iter().fold(1e-3_f32, |size, channel| size.max(channel.abs()));
        let difference = (0..3).map(|channel| (a[channel] - b[channel]).abs()).fold(0.0, f32::max);
        if of_pipe[at] == of_rays[at] && difference <= 2e-3 * size {
            continue;
        }
        // Rounding decides which of two coplanar faces is seen.
        let (of_pipe_depth, of_rays_depth) = (depths(&pipe)[at], depths(&rays)[at]);
        let is_coplanar = (of_pipe_depth - of_rays_depth).abs() <= 1e-6 * of_pipe_depth;
        if is_coplanar && of_pipe[at] != of_rays[at] {
            continue;
        }
        // Boundaries between translucent faces are not among the ids.
        n_other += 1;
        let is_boundary = around(at).any(|near| of_pipe[near] == of_rays[at])
            && around(at).any(|near| of_rays[near] == of_pipe[at])
            && is_between(*b, pipe.pixels(), around(at))
            && is_between(*a, rays.pixels(), around(at));
        assert!(
            is_boundary,
            "{name} {motion:?} {shift:?}: pixel {at}: faces {} {}, {a:?} {b:?}",
            of_pipe[at], of_rays[at]
        );
    }
    // A boundary through the middle of a pixel is rare.
    assert!(n_other <= of_pipe.len() / 1000, "{name} {motion:?}: {n_other} other faces");
}

const HUES: ColorShift = ColorShift::hues(true, Brightness::Report);
const SPECTRA: ColorShift = ColorShift::SPECTRA;

fn check_speeds(names: &[&str], shift: ColorShift) {
    for name in names {
        for speed in [0.3, 0.9, 0.999] {
            let direction = DVec3::new(0.6, 0.64, -0.48);
            let velocity = Some(speed * direction);
            check(name, Motion { velocity, in_place: true, ..Motion::default() }, shift);
        }
        for camera in [DVec3::new(0.0, 0.5, 0.0), DVec3::new(-0.2, -0.6, 0.1)] {
            let motion =
                Motion { velocity: Some(DVec3::new(0.3, 0.1, 0.2)), camera: Some(camera), in_place: true };
            check(name, motion, shift);
        }
    }
}

#[test]
fn hues_are_those_of_exact_mode() {
    check_speeds(
        &["cubes", "dice", "glass", "grid", "house", "lattice", "rainbow", "sphere", "traffic"],
        HUES,
    );
}

#[test]
fn spectra_are_those_of_exact_mode() {
    check_speeds(&["cubes", "halves", "ship", "street", "teapot"], SPECTRA);
}

#[test]
fn velocities_of_the_scene_are_those_of_exact_mode() {
    for camera in [None, Some(DVec3::new(0.1, 0.7, 0.0))] {
        check("traffic", Motion { camera, ..Motion::default() }, HUES);
        check("street", Motion { camera, ..Motion::default() }, SPECTRA);
    }
}
