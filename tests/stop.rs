//! A caller can stop every computation: it gives up at once, and its error says so.

use std::sync::atomic::{AtomicU64, Ordering};

use glam::DVec3;
use ugimage::Format;
use ugpipe::{Progress, Stopped};
use ugrainbow::{ColorShift, Filter, Output};

use ugtests::scenes;
use ugwarp::{Extent, Panorama, Texels};

/// Stops a computation when so many parts of all its steps are done.
struct StopAfter {
    parts: u64,
    n_done: AtomicU64,
}

impl StopAfter {
    fn new(parts: u64) -> Self {
        Self { parts, n_done: AtomicU64::new(0) }
    }
}

impl Progress for StopAfter {
    fn step(&self, _name: &'static str, _parts: u64) {}

    fn done(&self, parts: u64) {
        self.n_done.fetch_add(parts, Ordering::Relaxed);
    }

    fn is_stopped(&self) -> bool {
        self.n_done.load(Ordering::Relaxed) >= self.parts
    }
}

/// The innermost source of an error of a library is [`Stopped`].
#[track_caller]
fn is_stopped<T>(outcome: Result<T, impl std::fmt::Display>) {
    assert_eq!(outcome.err().map(|error| error.to_string()), Some(Stopped.to_string()));
}

/// Stops `run` before its first part, and in the middle of its many parts: then each thread ends
/// only the part that it is at. Without a stop all parts are done.
#[track_caller]
fn check<T, E: std::fmt::Display>(run: impl Fn(&dyn Progress) -> Result<T, E>) {
    is_stopped(run(&StopAfter::new(0)));
    let whole = StopAfter::new(u64::MAX);
    assert!(run(&whole).is_ok());
    let n_parts = whole.n_done.into_inner();
    assert!(n_parts >= 8, "{n_parts} parts");
    let early = StopAfter::new(n_parts / 4);
    is_stopped(run(&early));
    let n_done = early.n_done.into_inner();
    assert!(n_done < n_parts / 4 + rayon::current_num_threads() as u64, "{n_done} of {n_parts}");
}

const SIZE: [u32; 2] = [320, 240];

#[test]
fn rays_are_stopped() {
    let scene = scenes::parse(&scenes::text("ship"));
    let mut config = ugphoton::Config::default();
    config.picture.size = SIZE;
    check(|progress| ugphoton::render_with(scene.clone(), &config, progress));
}

#[test]
fn scanlines_and_exact_samples_are_stopped() {
    let (scene, _) =
        uglorentz::apply(scenes::parse(&scenes::text("ship")), &Default::default()).unwrap();
    let (colored, _) = ugdoppler::apply(scene.clone(), &Default::default()).unwrap();
    let mut config = ugrainbow::Config::default();
    config.picture.size = SIZE;
    check(|progress| ugrainbow::render_with(&colored, &config, progress));
    config.picture.filter = Filter::Spline;
    check(|progress| ugrainbow::render_with(&colored, &config, progress));
    config.picture.filter = Filter::Box;
    config.picture.output = Output::Vector(Format::Svg);
    check(|progress| ugrainbow::render_with(&colored, &config, progress));
    config.picture.output = Output::Color(Format::Png);
    config.exact = Some(ColorShift::default());
    check(|progress| ugrainbow::render_with(&scene, &config, progress));
}

#[test]
fn panoramas_are_stopped() {
    let sky =
        Panorama::new([64, 32], Texels::Srgb(vec![[64, 90, 200, 255]; 64 * 32]), Extent::FULL)
            .unwrap();
    let mut config = ugwarp::Config::default();
    config.picture.size = [128, 1024];
    check(|progress| ugwarp::render_with(&sky, &config, progress));
    let opened = ugwarp::Opened { panorama: Some(sky), ..ugwarp::Opened::default() };
    // A PNG file is compressed while it is drawn.
    let metadata = ugwarp::metadata(&[], ugwarp::PROVENANCE);
    check(|progress| ugwarp::run(&config, &opened, &metadata, progress));
}

#[test]
fn filters_and_frames_of_films_are_stopped() {
    let scene = scenes::parse(&scenes::text("lamp"));
    let velocity = Some(DVec3::new(0.9, 0.0, 0.0));
    let lorentz = uglorentz::Config { velocity, in_place: true, ..Default::default() };
    is_stopped(uglorentz::apply_with(scene.clone(), &lorentz, &StopAfter::new(0)));
    let (seen, _) = uglorentz::apply(scene.clone(), &lorentz).unwrap();
    let doppler = ugdoppler::Config { light: true, ..Default::default() };
    is_stopped(ugdoppler::apply_with(seen, &doppler, &StopAfter::new(0)));

    let rays = ugfilm::Pipe::new(vec![ugfilm::Program::Photon(Default::default())]);
    let of_three = vec![
        ugfilm::Program::Lorentz(lorentz),
        ugfilm::Program::Doppler(doppler),
        ugfilm::Program::Rainbow(Default::default()),
    ];
    for mut pipe in [rays, ugfilm::Pipe::new(of_three)] {
        pipe.picture.size = SIZE;
        check(|progress| pipe.draw_with(ugfilm::FilmSubject::Scene(&scene), progress));
    }
}
