//! Colours that change with own time: the readings of clocks, against the Lorentz transformation
//! and published numbers.
//!
//! A clock is a face whose Y is a hundredth of its own time.

use glam::DVec3;
use uglight::ColorShift;
use uglorentz::Pieces;
use ugphysics::{Brightness, Event, Lorentz, Velocity};
use ugrainbow::Output;
use ugscene::{Anchor, ColorValue, MotionOptions, Scene};
use ugtests::picture::svg_text;
use ugtests::pipe;
use ugtests::scenes::parse;
use ugtests::worlds::picture::{Picture, Renderer};

/// The largest time that a clock shows, and the number of times in a unit of Y.
const RANGE: f64 = 1000.0;
const UNIT: f64 = 100.0;

/// A clock at each place, all with this motion.
fn clocks(places: &[DVec3], motion: &str) -> String {
    let mut text = format!(
        "c_xyz low 0 {} 0; c_xyz high 0 {} 0; c_time clock {} low {RANGE} high;\n",
        -RANGE / UNIT,
        RANGE / UNIT,
        -RANGE
    );
    for (row, place) in places.iter().enumerate() {
        let [x, y, z] = place.to_array();
        text += &format!(
            "v p{row} {x} {y} {z}; v q{row} {} {y} {z}; v r{row} {x} {y} {};\nf (p{row} q{row} r{row}) clock {motion};\n",
            x + 1e-3,
            z + 1e-3
        );
    }
    text
}

fn options(eye: DVec3, time: f64) -> uglorentz::Config {
    uglorentz::Config {
        eye: Some(eye),
        time,
        anchor: Some(Anchor::Origin),
        pieces: Pieces::PerEdge(1),
        ..uglorentz::Config::default()
    }
}

/// What the first corners of the clocks show.
fn readings(text: &str, config: &uglorentz::Config) -> Vec<f64> {
    let scene = parse(&pipe::lorentz(text.as_bytes(), config));
    let first =
        scene.vertices.iter().filter(|vertex| scene.names.get(vertex.name).starts_with('p'));
    first.map(|vertex| shown(&scene, vertex.color.unwrap())).collect()
}

fn shown(scene: &Scene, color: ugscene::ColorId) -> f64 {
    match scene.colors[color.index()].value {
        ColorValue::Xyz([_, y, _]) => UNIT * y,
        other => panic!("{other:?}"),
    }
}

fn speed(beta: f64) -> Velocity {
    Velocity::from_beta(DVec3::X * beta).unwrap()
}

/// The own time that a clock at rest at `place` in a frame with the velocity v is seen to show at
/// `event`: by Newton's method in that frame, where it stands still.
fn expected(place: DVec3, velocity: Velocity, event: Event) -> f64 {
    let Event { t, x } = Lorentz::boost(velocity).inverse().apply(event);
    t - (place - x).length()
}

const PLACES: [DVec3; 4] = [
    DVec3::new(-3.0, 4.0, 0.5),
    DVec3::new(0.0, 3.0, -1.0),
    DVec3::new(2.0, 5.0, 0.0),
    DVec3::new(7.0, 4.0, 2.0),
];

#[test]
fn a_row_of_clocks_is_seen_as_the_lorentz_transformation_says() {
    for (beta, camera, time) in
        [(0.8, 0.0, 0.0), (0.8, 0.0, 7.5), (0.0, -0.8, 4.0), (0.6, 0.9, -3.0)]
    {
        let eye = DVec3::new(0.5, -2.0, 0.25);
        let config =
            uglorentz::Config { camera_velocity: Some(DVec3::X * camera), ..options(eye, time) };
        let event = Lorentz::boost(speed(camera)).apply(Event { t: time, x: DVec3::ZERO });
        let event = event + Event { t: 0.0, x: eye };
        let found = readings(&clocks(&PLACES, &format!("<{beta} 0 0>")), &config);
        assert_eq!(found.len(), PLACES.len());
        for (found, place) in found.into_iter().zip(PLACES) {
            let expected = expected(place, speed(beta), event);
            assert!(
                (found - expected).abs() < 1e-9,
                "{beta} {camera} {time}: {found}, not {expected}"
            );
        }
    }
}

/// A clock that comes or goes straight is seen to tick D times as fast.
#[test]
fn ticking_is_doppler_shifted() {
    for (beta, doppler) in [(-0.6, 2.0), (0.6, 0.5), (0.8, 1.0 / 3.0), (-0.8, 3.0)] {
        let text = clocks(&[DVec3::ZERO], &format!("<0 {beta} 0>"));
        let at = |time: f64| readings(&text, &options(DVec3::new(0.0, -50.0, 0.0), time))[0];
        let rate = (at(10.0) - at(4.0)) / 6.0;
        assert!((rate - doppler).abs() < 1e-9, "{beta}: {rate}");
    }
}

/// The trip of own time 8 takes 8.4887144286432 for those who stay.
#[test]
fn twins_come_back_with_their_own_times() {
    let motion = "motion trip -acc 0 .3 0 0 2 -acc 0 -.3 0 2 6 -acc 0 .3 0 6 8;\n";
    let places = [DVec3::ZERO];
    let eye = DVec3::new(0.0, -3.0, 0.0);
    let trip = format!("{motion}{}", clocks(&places, "<trip>"));
    for (since, own) in [(0.0, 0.0), (8.488_714_428_643_2, 8.0), (9.488_714_428_643_2, 9.0)] {
        let config = options(eye, 3.0 + since);
        let found = readings(&trip, &config)[0];
        assert!((found - own).abs() < 1e-9, "{found}, not {own}");
        let stayed = readings(&clocks(&places, ""), &config)[0];
        assert!((stayed - since).abs() < 1e-9, "{stayed}, not {since}");
    }
}

/// Bodies with a velocity and bodies on world lines that hardly accelerate show the same time,
/// however they are placed.
#[test]
fn inertial_clocks_are_those_of_motions() {
    let inertial = clocks(&PLACES, "<.5 .3 -.2>");
    let moved = clocks(&PLACES, "<m>") + "motion m -vel .5 .3 -.2 -acc 1e-14 0 0;";
    let eye = DVec3::new(0.5, -2.0, 0.25);
    let point = Anchor::Point(DVec3::new(1.0, 2.0, 3.0));
    for anchor in [None, Some(Anchor::Eye), Some(Anchor::Origin), Some(Anchor::Center), Some(point)]
    {
        for in_place in [false, true] {
            for camera in [DVec3::ZERO, DVec3::new(0.2, -0.7, 0.1)] {
                let config = uglorentz::Config {
                    anchor,
                    in_place,
                    camera_velocity: Some(camera),
                    ..options(eye, 2.5)
                };
                for (a, b) in
                    readings(&inertial, &config).into_iter().zip(readings(&moved, &config))
                {
                    assert!((a - b).abs() < 1e-9, "{anchor:?} {in_place} {camera}: {a} {b}");
                }
            }
        }
    }
}

/// The light of a lamp that changes, on a surface, is that which left it when the light that is
/// scattered toward the eye left it.
#[test]
fn lamps_light_with_the_colour_they_had() {
    let (surface, lamp, eye) =
        (DVec3::new(0.5, 4.0, 0.0), DVec3::new(1.0, -1.0, 2.0), DVec3::new(0.0, -2.0, 0.0));
    let shift = ColorShift::hues(true, Brightness::None);
    let lit =
        ugdoppler::Config { light: true, tolerance: 0.0, keep: true, shift, ..Default::default() };
    for (of_surface, of_lamp) in [(0.0, 0.0), (0.5, 0.0), (0.5, 0.5), (-0.3, 0.6)] {
        for acceleration in ["", "-acc 1e-14 0 0"] {
            let [x, y, z] = surface.to_array();
            let [a, b, c] = lamp.to_array();
            let text = format!(
                "motion m -vel {of_lamp} 0 0 {acceleration}; motion s -vel {of_surface} 0 0;
                 c off 0; c on 1; c_time ramp -100 off 100 on; l 1 {a} {b} {c} 0 ramp <m>;
                 v p {x} {y} {z}; v q {} {y} {z}; v r {x} {y} {}; f (p q r) <s>;",
                x + 1e-3,
                z + 1e-3
            );
            let plain = text.replace("ramp <m>", "on <m>");
            let value = |text: &str| {
                let seen = pipe::lorentz(text.as_bytes(), &options(eye, 9.0));
                let scene = parse(&pipe::doppler(&seen, &lit));
                match scene.colors[scene.vertices[0].color.unwrap().index()].value {
                    ColorValue::Hsv { value, .. } => value,
                    other => panic!("{other:?}"),
                }
            };
            // When the surface scatters the light, and when the lamp sent it, in the scene.
            let own = expected(surface, speed(of_surface), Event { t: 9.0, x: eye });
            let here = Lorentz::boost(speed(of_surface)).apply(Event { t: own, x: surface });
            let sent = expected(lamp, speed(of_lamp), here);
            let part = value(&text) / value(&plain);
            let wanted = (sent + 100.0) / 200.0;
            assert!((part - wanted).abs() < 1e-7, "{of_surface} {of_lamp}: {part}, not {wanted}");
        }
    }
}

/// A flash of 10⁻¹⁰, seen a day later: the rows of the table stay apart in the text, and the next
/// program reads the times that were stated. Rays draw the same.
#[test]
fn a_short_flash_seen_a_day_later_keeps_its_rows() {
    const DAY: f64 = 86400.0;
    let text = "c_rgb on 1 .9 .7; c_rgb off 0 0 0; c_time flash -step -period 60 0 on 1e-10 off;
         v a 0 0 0; v b 1 0 0; v c 0 0 1; f (a b c); l 1 0 -1 0 0 flash <0 0 0>; l 1 .5 -1 0 0 on <.1 0 0>;
         cam -ep 0 -12 3 -vc 0 0 0;";
    let seen =
        pipe::lorentz(text.as_bytes(), &uglorentz::Config { time: DAY, ..Default::default() });
    let scene = parse(&seen);
    let table = scene.table_of(scene.lights[0].color.unwrap()).unwrap();
    assert_eq!(
        (table.rows.iter().map(|row| row.0).collect::<Vec<_>>(), table.shift),
        (vec![0.0, 1e-10], -DAY)
    );
    assert_eq!(ugparse::write(&scene), seen);
    pipe::doppler(&seen, &ugdoppler::Config { light: true, ..Default::default() });
    for (time, expected) in [(0.0, 0), (5e-11, 0), (2e-10, 1), (-1.0, 1), (59.0, 1), (60.0, 0)] {
        assert_eq!(table.at(table.shift + time).row, expected, "{time}");
    }
    let [pipe, rays] = [Renderer::Pipe, Renderer::Rays].map(|by| {
        let motion = MotionOptions { time: DAY, ..MotionOptions::default() };
        let picture =
            Picture { motion, ..Picture::of_scene(text.to_owned(), ColorShift::NONE).like_pipe() };
        picture.by(by).draw().unwrap().light()
    });
    let n_off = pipe.iter().zip(&rays).filter(|(a, b)| (a[0] - b[0]).abs() > 4e-3).count();
    assert!(n_off < 20, "{n_off}");
}

/// Faces with colours of their own are cut as each of them alone, even where thousands meet at one
/// edge, and vertices of two faces at one place are cut alike.
#[test]
fn many_colours_over_time_are_cut_as_each_alone() {
    let face = |k: usize| {
        let z = k as f64 * 1e-3;
        format!(
            "c_time t{k} -step -period 2 0 r {} z; v a{k} 0 {z} 2; v b{k} 4 0 0; v c{k} -4 0 0; f (a{k} b{k} c{k}) t{k};\n",
            0.5 + z
        )
    };
    let config = uglorentz::Config { time: 6.0, size: [64, 48], ..Default::default() };
    let n_faces = |rows: std::ops::Range<usize>| {
        let faces: String = rows.map(face).collect();
        let text = format!("c_rgb r 1 0 0; c_rgb z 0 0 0; cam -ep 0 -6 0 -vc 0 0 0;\n{faces}");
        parse(&pipe::lorentz(text.as_bytes(), &config)).faces.len()
    };
    let (one, both) = (n_faces(0..1), n_faces(0..2));
    assert!(one > 30 && both >= 2 * one, "{one} {both}");
    let still = |n: usize| {
        let face = |k: usize| face(k).replace("-step -period 2 0 r", "0 r");
        let faces: String = (0..n).map(face).collect();
        let text = format!("c_rgb r 1 0 0; c_rgb z 0 0 0; cam -ep 0 -6 0 -vc 0 0 0;\n{faces}");
        let scene = parse(&pipe::lorentz(
            text.as_bytes(),
            &uglorentz::Config { time: -9.0, ..config.clone() },
        ));
        scene.faces.len()
    };
    // Before the first row nothing changes. It took minutes when every edge tested every table.
    assert_eq!(still(3000), 3000);
}

/// The light of the pipe, and that by rays.
fn pictures(text: &str, shift: ColorShift) -> [Vec<[f32; 3]>; 2] {
    let motion =
        MotionOptions { time: 6.0, anchor: Some(Anchor::Origin), ..MotionOptions::default() };
    let picture =
        Picture { motion, size: [80, 60], ..Picture::of_scene(text.to_owned(), shift).like_pipe() };
    [Renderer::Pipe, Renderer::Rays]
        .map(|renderer| picture.clone().by(renderer).draw().unwrap().light())
}

/// The scene, with the statements of three colours.
fn faces(colors: &str) -> String {
    format!(
        "c_rgb red 1 .1 .1; c_rgb pale .8 .8 .9; {colors}
         motion turning -at 2.5 0 .5 -spin 0 .4 0 -vel -.2 .3 0;
         v a -1 0 -1; v b 1 0 -1; v c 1 0 1; v d -1 0 1; f (a b c d) tick <.4 .2 0>;
         v e 2 0 0; v f 3 0 0; v g 3 0 1; v h 2 0 1; f (e f g h) wave <turning>;
         v i -3 1 -2; v j 4 1 -2; v k 4 1 2; v l -3 1 2; f (i j k l) still;
         l 1; cam -ep 1 -6 .5 -vc 1 0 .5;"
    )
}

/// Faces of three bodies change, in steps and linearly: rays draw what the pipe draws, but for
/// pixels at which a colour jumps or a face ends.
#[test]
fn rays_draw_what_the_pipe_draws() {
    let scene = faces(
        "c_time tick -step -period 1.3 0 red .5 pale; c_time wave -period 2 0 red 1 pale;
         c_time still -period 3 0 red 1 pale;",
    );
    for shift in [ColorShift::NONE, ColorShift::SPECTRA] {
        let [pipe, rays] = pictures(&scene, shift);
        let is_off = |(a, b): (&[f32; 3], &[f32; 3])| (0..3).any(|k| (a[k] - b[k]).abs() > 4e-3);
        let n_off = pipe.iter().zip(&rays).filter(|&pair| is_off(pair)).count();
        let n_lit = rays.iter().filter(|pixel| pixel[0] > 0.0).count();
        assert!(n_lit > 2500 && n_off < 60, "{shift:?}: {n_off} of {n_lit}");
    }
}

/// A colour that does not change is a plain one, to the bit.
#[test]
fn constant_tables_are_plain_colours() {
    let plain = faces("c_rgb tick .3 .6 .2; c_rgb wave .3 .6 .2; c_rgb still .3 .6 .2;");
    let table = faces(
        "c_rgb leaf .3 .6 .2; c_time tick 0 leaf; c_time wave -step -period 2 0 leaf 1 leaf;
         c_time still -3 leaf 5 leaf;",
    );
    for shift in [ColorShift::hues(true, Brightness::Report), ColorShift::SPECTRA] {
        for (expected, found) in pictures(&plain, shift).iter().zip(pictures(&table, shift)) {
            assert_eq!(*expected, found, "{shift:?}");
        }
    }
}

/// A legend states the own times of the light that is seen, (P42): t − r at the axis of a spin.
#[test]
fn legends_state_own_times() {
    let clock = |motion: &str| {
        format!(
            "motion m {motion};\nv a 1e-4 0 0; v b 0 0 1e-4; v c -1e-4 0 -1e-4; f (a b c) <m>;\nl 1;\n\
             cam -ep 0 -6 0 -vc 0 0 0 -ud 0 0 1 -va .004;"
        )
    };
    for (motion, expected) in [
        ("-spin 0 .5 0", Some("τ = 4")),
        // asinh(a t)/a, at the time 4 of the eye minus 6.
        ("-acc 0 1e-9 0", Some("τ = 4")),
        ("-vel 0 0 0", None),
    ] {
        let mut pipe = pipe::Pipe::new(DVec3::ZERO, [400, 300]);

        pipe.lorentz = options(DVec3::new(0.0, -6.0, 0.0), 10.0);
        pipe.rainbow.picture.annotations.legend = true;
        pipe.rainbow.picture.text = ugrainbow::TextForm::Text;
        pipe.rainbow.picture.output = Output::Vector(ugimage::Format::Svg);
        let svg = String::from_utf8(pipe.run(clock(motion).as_bytes()).file).unwrap();
        match expected {
            Some(words) => {
                let text = svg_text(&svg);
                assert!(
                    text.contains(words) && !text.contains(&format!("{words}.")),
                    "{motion}: {text}"
                );
            }
            None => assert!(!svg.contains("τ"), "{motion}: {svg}"),
        }
    }
}
