//! Pictures in false colours and lines of equal values, of every renderer.

use glam::DVec3;
use ugfilm::{FilmSubject, Pipe, Program};
use ugimage::{Format, Samples};
use ugphysics::{Hsv, Velocity};
use ugpicture::{
    AnnotationOptions, Background, Canvas, Channel, IsoOptions, MapOptions, Output, PictureOptions,
    Quantity, Scale,
};
use ugscene::CameraOptions;
use ugtests::scenes;
use ugwarp::{Extent, Panorama, Texels};

const SIZE: [u32; 2] = [120, 110];

/// The programs that draw a drive at 0.6c: the pipe, its exact mode, and rays.
fn drives() -> [Vec<Program>; 3] {
    let velocity = Some(DVec3::new(0.0, 0.6, 0.0));
    let lorentz = uglorentz::Config { camera_velocity: velocity, size: SIZE, ..Default::default() };
    let rainbow = |exact| Program::Rainbow(ugrainbow::Config { exact, ..Default::default() });
    let mut photon = ugphoton::Config::default();
    photon.motion.camera_velocity = velocity;
    [
        vec![Program::Lorentz(lorentz.clone()), rainbow(None)],
        vec![Program::Lorentz(lorentz), rainbow(Some(ugphoton::ColorShift::NONE))],
        vec![Program::Photon(photon)],
    ]
}

/// The position is the eye plus the distance along the ray, which goes through the pixel.
#[test]
fn positions_and_rays_meet() {
    let scene = scenes::parse(&scenes::text("street"));
    let view = ugscene::View::new(&scene, &CameraOptions::default(), SIZE).unwrap();
    for (drive, programs) in drives().into_iter().enumerate() {
        let mut pipe = Pipe::new(programs);
        let channels = vec![Channel::Position, Channel::Ray, Channel::Distance];
        let output = Output::Color(Format::Exr);
        pipe.picture = PictureOptions {
            size: SIZE,
            samples: 1,
            output,
            channels,
            ..PictureOptions::default()
        };
        let frame = pipe.draw(FilmSubject::Scene(&scene)).unwrap().0.into_light().unwrap();
        let plane = |name: &str| {
            let plane = frame.planes().iter().find(|plane| plane.name == name).unwrap();
            let Samples::Float(values) = &plane.samples else { panic!("numbers") };
            values
        };
        let vector = |name: &str, idx: usize| {
            DVec3::from_array(
                ["X", "Y", "Z"].map(|axis| f64::from(plane(&format!("{name}.{axis}"))[idx])),
            )
        };
        let mut n_seen = 0;
        for (idx, &distance) in
            plane("distance").iter().enumerate().filter(|(_, far)| far.is_finite())
        {
            let (position, ray) = (vector("position", idx), vector("ray", idx));
            let error = (view.eye + f64::from(distance) * ray - position).length();
            assert!(error < 1e-5 * f64::from(distance), "{drive} {idx}: {error}");
            let place = view.place(position - view.eye);
            let pixel = [idx as u32 % SIZE[0], idx as u32 / SIZE[0]].map(|at| f64::from(at) + 0.5);
            let off = [place.x / place.z - pixel[0], place.y / place.z - pixel[1]];
            assert!(off.iter().all(|off| off.abs() < 1e-3), "{drive} {idx}: {off:?}");
            n_seen += 1;
        }
        assert!(n_seen > 3000, "{drive}: {n_seen}");
    }
}

/// Each pixel has the colour of the number that a channel of EXR has there.
#[test]
fn false_colours_are_those_of_the_channels() {
    let scene = scenes::parse(&scenes::text("street"));
    let rows = [
        (Quantity::Doppler, Channel::Doppler, [0.5, 4.0]),
        (Quantity::Time, Channel::Time, [-90.0, -3.0]),
        (Quantity::Distance, Channel::Distance, [0.0, 50.0]),
        (Quantity::Depth, Channel::Depth, [0.0, 50.0]),
    ];
    for (drive, programs) in drives().into_iter().enumerate() {
        for (quantity, channel, range) in rows {
            let mut pipe = Pipe::new(programs.clone());
            let map = Some(MapOptions { quantity, range: Some(range) });
            let annotations = AnnotationOptions { map, ..AnnotationOptions::default() };
            pipe.picture =
                PictureOptions { size: SIZE, samples: 1, annotations, ..PictureOptions::default() };
            let scene_options = Canvas::new(&pipe.picture).unwrap().options().clone();
            let drawn = pipe.draw(FilmSubject::Scene(&scene)).unwrap().0.into_frame().unwrap();
            pipe.picture = scene_options;
            pipe.picture.annotations = AnnotationOptions::default();
            pipe.picture.output = Output::Color(Format::Exr);
            pipe.picture.channels = vec![channel];
            let frame = pipe.draw(FilmSubject::Scene(&scene)).unwrap().0.into_light().unwrap();
            let Samples::Float(values) = &frame.planes()[0].samples else { panic!("numbers") };
            let scale = Scale { quantity, range, unit: None };
            let (mut n_seen, mut n_unlike) = (0, 0);
            for (idx, &value) in values.iter().enumerate() {
                let seen = value.is_finite() && value != 0.0;
                let expected =
                    if seen { scale.color(scale.place(f64::from(value))) } else { [0; 3] };
                let [red, green, blue, _] = drawn.pixels()[idx];
                n_seen += usize::from(seen);
                let is_same =
                    [red, green, blue].iter().zip(expected).all(|(a, b)| a.abs_diff(b) <= 1);
                n_unlike += usize::from(!is_same);
            }
            assert!(
                n_seen > values.len() / 3 && n_unlike == 0,
                "{drive} {quantity:?}: {n_unlike} of {n_seen}"
            );
        }
    }
}

/// On a panorama in motion D is 1 where cos θ = (1 − 1/γ)/β, a circle about the middle.
#[test]
fn lines_are_where_the_formula_has_them() {
    let velocity = Velocity::from_beta(DVec3::new(0.0, 0.6, 0.0)).unwrap();
    let sky = Panorama::new([64, 32], Texels::Srgb(vec![[255; 4]; 64 * 32]), Extent::FULL).unwrap();
    let iso = Some(IsoOptions { quantity: Quantity::Doppler, values: vec![1.0] });
    let picture = PictureOptions {
        size: [401, 401],
        samples: 2,
        background: Background::Color(Hsv { hue: 0.0, saturation: 0.0, value: 1.0 }),
        annotations: AnnotationOptions { iso, ..AnnotationOptions::default() },
        camera: CameraOptions {
            view_angle: Some((150.0, Some(150.0))),
            ..CameraOptions::default()
        },
        ..PictureOptions::default()
    };
    let config = ugwarp::Config {
        velocity,
        shift: ugwarp::ColorShift::NONE,
        picture,
        ..ugwarp::Config::default()
    };
    let frame = ugwarp::render(&sky, &config).unwrap().into_frame().unwrap();
    let cosine = (1.0 - 1.0 / velocity.gamma()) / 0.6;
    let radius = 200.5 * libm::tan(libm::acos(cosine)) / libm::tan(75.0_f64.to_radians());
    // The line is black; all else is white.
    let is_line = |radius: f64, angle: f64| {
        let [x, y] = [libm::cos(angle), libm::sin(angle)].map(|part| 200.5 + radius * part);
        frame.pixel(x as u32, y as u32)[0] < 160
    };
    let angles = (0..200).map(|idx| std::f64::consts::TAU * f64::from(idx) / 200.0);
    let n_on = |offsets: [f64; 3]| {
        let is_on = |angle: &f64| offsets.iter().any(|offset| is_line(radius + offset, *angle));
        angles.clone().filter(is_on).count()
    };
    // The number hides a part of the line.
    assert!(n_on([-0.7, 0.0, 0.7]) > 180, "{}", n_on([-0.7, 0.0, 0.7]));
    let n_beside = n_on([-5.0, 5.0, 6.0]);
    assert!(n_beside < 10, "{n_beside}");
}
