//! Light of lamps on world lines, on bodies on world lines.

use glam::DVec3;
use ugdoppler::Config;
use uglight::ColorShift;
use ugphysics::{Brightness, hue_to_wavelength};
use ugscene::{ColorValue, Scene, Tint};
use ugtesting::Random;
use ugtests::pipe;
use ugtests::scenes::parse;
use ugtests::world_lines::sight::emission_time;
use ugtests::world_lines::statement::words;
use ugtests::world_lines::{Body, Four, Observer, Statement, plus, product};
use ugtests::worlds::picture::{Picture, Renderer, SPECTRA};

use super::{World, observer, options};

/// Value and hue of the surface, and the level of the lamp.
const VALUE: f64 = 0.8;
const HUE: f64 = 120.0;
const LEVEL: f64 = 0.5;

fn lit() -> Config {
    let shift = ColorShift::hues(true, Brightness::None);
    Config {
        light: true,
        tolerance: 0.0,
        wavelengths: true,
        keep: true,
        shift,
        ..Config::default()
    }
}

/// The part of the lamp's level that falls on a point of a triangle, on the side of its normal, D
/// D_l, and the side that is seen there.
fn expected(
    eye: &Observer,
    (body, corners, point): (&Body, [DVec3; 3], DVec3),
    (lamp_body, lamp): (&Body, DVec3),
) -> (f64, f64, f64) {
    let sighting = eye.sight(body, point);
    let (own_time, here) = (sighting.own_time, sighting.moment);
    let tangents =
        [corners[1] - corners[0], corners[2] - corners[0]].map(|t| body.vector(t, own_time));
    let normal = across(here.velocity, tangents[0], tangents[1]);
    let source = lamp_body.moment(lamp, emission_time(lamp_body, lamp, here.event));
    let way = plus(source.event, -1.0, here.event);
    let to_eye = plus(eye.event, -1.0, here.event);
    // way = r (−u + l), so way·u = r.
    let cosine = product(normal, way) / product(way, here.velocity);
    let doppler = product(way, here.velocity) / product(way, source.velocity);
    (cosine, doppler * sighting.doppler, product(normal, to_eye).signum())
}

/// The unit vector perpendicular to three.
fn across(a: Four, b: Four, c: Four) -> Four {
    let minor = |rows: [usize; 3]| {
        let [x, y, z] = [a, b, c].map(|v| DVec3::from_array(rows.map(|row| v[row])));
        x.dot(y.cross(z))
    };
    // The index of time is raised with its sign.
    let v = [-minor([1, 2, 3]), -minor([0, 2, 3]), minor([0, 1, 3]), -minor([0, 1, 2])];
    let norm = product(v, v).sqrt();
    v.map(|x| x / norm)
}

/// Wavelength and value of a vertex.
fn color(scene: &Scene, name: &str) -> (f64, f64) {
    let vertex = scene.vertices.iter().find(|vertex| scene.names.get(vertex.name) == name).unwrap();
    match scene.colors[vertex.color.unwrap().index()].value {
        ColorValue::Hsv { tint: Tint::Wavelength(nm), value, .. } => (nm, value),
        // Where no light falls, there is no hue.
        other => panic!("{other:?}"),
    }
}

#[test]
fn lamplight_arrives_when_integration_says() {
    let mut random = Random(10);
    let mut n_lit = 0;
    for case in 0..60 {
        let mut world = World::default();
        for n in [1, 0] {
            let middle = random.in_ball(3.0);
            let motion = match (case + n) % 4 {
                0 => Statement::inertial(random.in_ball(0.7)),
                _ => Statement::random(&mut random, middle, 0.7),
            };
            world.add(&mut random, motion, middle, n);
            let carrier = world.motions.len() - 1;
            if case % 3 == 0 {
                let part = Statement::random_part(&mut random, carrier, middle);
                world.add(&mut random, part, middle, 0);
            }
        }
        // The lamp is on the last body, the triangle on the first or on its part.
        let lamp_row = world.motions.len() - 1;
        world.triangles[0].body = usize::from(case % 6 == 0);
        let lamp = world.motions[lamp_row].at + random.in_ball(0.5);
        let text = world.text().replace(") <", ") green <");
        let text =
            format!("c green {VALUE} {HUE} 1; l {LEVEL} {} 0 <m{lamp_row}>;\n{text}", words(lamp));
        let velocity = random.in_ball(0.6);
        let eye = 6.0 * random.direction();
        let config = uglorentz::Config {
            camera_velocity: Some(velocity),
            ..options(eye, random.between(-2.0, 3.0))
        };
        let scene = parse(&pipe::doppler(&pipe::lorentz(text.as_bytes(), &config), &lit()));
        let observer = observer(eye, velocity, config.time);
        let bodies = world.bodies();
        let triangle = world.triangles[0];
        let mut side = None;
        for (corner, point) in triangle.corners.into_iter().enumerate() {
            let surface = (&bodies[triangle.body], triangle.corners, point);
            let (cosine, doppler, own_side) =
                expected(&observer, surface, (&bodies[lamp_row], lamp));
            let (nm, value) = color(&scene, &format!("p0_{corner}"));
            // A piece is lit on the side on which its first corner is seen.
            let level = VALUE * LEVEL * (cosine * *side.get_or_insert(own_side)).max(0.0);
            assert!((value - level).abs() < 1e-9, "case {case}: {value}, not {level}\n{text}");
            if level > 0.0 {
                let expected = hue_to_wavelength(HUE) / doppler;
                assert!(
                    (nm / expected - 1.0).abs() < 1e-9,
                    "case {case}: {nm}, not {expected}\n{text}"
                );
                n_lit += 1;
            }
        }
    }
    assert!(n_lit > 30, "{n_lit}");
}

/// A lamp on a body with constant velocity is a lamp with that velocity.
#[test]
fn a_lamp_on_an_inertial_body_has_its_velocity() {
    let room = "c green .8 120 1; v a 0 3 0; v b 1 3 0; v c 0 3 1; f (a b c) green BODY;
        cam -ep 0 -5 1 -vc 0 0 0 <.1 .2 .3>; l .5 1 -3 2 0 LAMP; l .2 2 1 3 LAMP; l .1 LAMP;";
    for body in ["", "<.3 .5 -.2>", "<0 .1 0>", "<turning>"] {
        // In place, the lamp has a place of its own, since a name is a body.
        for in_place in [false, body == "<turning>"] {
            let config = uglorentz::Config { in_place, time: 0.5, ..uglorentz::Config::default() };
            let draw = |lamp: &str| {
                let text = room.replace("BODY", body).replace("LAMP", lamp);
                let text = format!("motion m -vel .3 .5 -.2; motion turning -spin 0 .2 .1; {text}");
                let scene = parse(&pipe::doppler(&pipe::lorentz(text.as_bytes(), &config), &lit()));
                ["a", "b", "c"].map(|name| color(&scene, name))
            };
            assert_eq!(draw("<m>"), draw("<.3 .5 -.2 -at 0 0 0>"), "{body} {in_place}");
        }
    }
}

/// What lights a body depends neither on another body of its velocity nor on the order of their
/// motions.
#[test]
fn lamps_belong_to_the_body_they_light() {
    let body = |name: &str, x: f64| {
        format!(
            "v {name}1 {x} 0 -1; v {name}2 {} 0 -1; v {name}3 {x} 0 1; f ({name}1 {name}2 {name}3) green <{name}>;",
            x + 2.0
        )
    };
    let light = |motions: &str, bodies: &[String]| {
        let text = format!(
            "c green .8 120; l 1.5 0 -3 4 0; cam -ep 0 -12 0 -vc 0 0 0; {motions} {}",
            bodies.concat()
        );
        let config = uglorentz::Config { in_place: true, ..uglorentz::Config::default() };
        let scene = parse(&pipe::doppler(&pipe::lorentz(text.as_bytes(), &config), &lit()));
        ["b1", "b2", "b3"].map(|name| color(&scene, name))
    };
    let [a, b] = [body("a", -5.0), body("b", 1.0)];
    let alone = light("motion b -vel .6 0 0;", std::slice::from_ref(&b));
    assert!(alone[0].1 > 0.1, "{alone:?}");
    for motions in [
        "motion a -vel .6 0 0; motion b -vel .6 0 0;",
        "motion b -vel .6 0 0; motion a -vel .6 0 0;",
    ] {
        let both = light(motions, &[a.clone(), b.clone()]);
        for ((nm, value), (nm_alone, value_alone)) in both.into_iter().zip(alone) {
            assert!(
                (nm - nm_alone).abs() < 1e-9 && (value - value_alone).abs() < 1e-12,
                "{motions} {both:?}"
            );
        }
    }
}

/// `-sl` cuts faces by the light of lamps that run in circles, and of those that change: the pipe
/// and rays draw the same light.
#[test]
fn faces_are_cut_by_the_light_of_lamps_that_move_and_change() {
    let circle =
        "motion m -spin 0 0 .25; v a -4 3 -4; v b 4 3 -4; v c 4 3 4; v d -4 3 4; f (a b c d);
        l lamp 1 2 1.5 0 0 1 <m>; cam -ep 0 -5 0 -vc 0 3 0 -va 60;";
    let flash =
        "c_rgb w .9 .9 .9; c_rgb on 1 1 1; c_rgb off 0 0 0; c_time fl -step 0 off .001 on .2 off;
        v a -30 10 -30; v b 30 10 -30; v c 30 10 30; v d -30 10 30; f (a b c d) w;
        l 1 0 4 0 0 fl <0 0 0>; cam -ep 0 0 0 -vc 0 1 0 -va 100;";
    for (text, time, mean_error) in [(circle, 0.0, 0.004), (flash, 17.0, 0.004)] {
        let source = ugparse::Source::new("lamp.ug", text);
        let scene = ugparse::read(&source, &ugparse::Options::default(), None).unwrap().scene;
        let config =
            uglorentz::Config { time, light_error: 0.01, measure: true, ..Default::default() };
        let left =
            uglorentz::apply(scene, &config).unwrap().1.remaining_errors.unwrap().light.unwrap();
        assert!(left.error < 0.01, "{time} {left:?}");
        let rays = Picture::of_scene(text.to_owned(), SPECTRA).like_pipe();
        let motion = ugscene::MotionOptions { time, ..rays.motion.clone() };
        let rays = Picture { size: [72, 54], motion, ..rays };
        let [by_rays, by_pipe] =
            [rays.clone(), rays.by(Renderer::Pipe)].map(|picture| picture.draw().unwrap().light());
        let brightest = by_rays.iter().map(|light| light[1]).fold(0.0, f32::max);
        let errors = by_rays.iter().zip(&by_pipe).map(|(a, b)| (a[1] - b[1]).abs() / brightest);
        let mean = errors.sum::<f32>() / by_rays.len() as f32;
        let n_lit = by_pipe.iter().filter(|light| light[1] > 0.1 * brightest).count();
        assert!(mean < mean_error && n_lit > 20, "{mean} {n_lit} {time}");
    }
}
