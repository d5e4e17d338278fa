//! Pictures drawn by rays (`ugrainbow -xc`): every sample against the oracle, which finds it with 4×4 matrices
//! in the scene as it was written, and against the formulas of `ugphysics`.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test fails by panicking")]

use std::collections::BTreeMap;

use exr::prelude::{ReadChannels, ReadLayers};
use glam::DVec3;
use ugimage::Format;
use ugparse::{Face, Scene, VertexId};
use ugphysics::{
    Brightness, Hsv, Velocity, attenuation, doppler_at, hue_to_wavelength, rest_position, srgb_decode,
    wavelength_to_hue,
};
use ugrainbow::{Channel, Exact, Output};
use ugtests::oracle::{Oracle, Pinhole};
use ugtests::picture::decode;
use ugtests::pipe::{Pipe, lorentz, rainbow};
use ugtests::scenes;
use ugtests::shading::Shading;

const SIZE: [u32; 2] = [96, 72];

const SPEEDS: [f64; 4] = [0.3, 0.9, 0.99, 0.999];

/// Depth keys are single precision numbers.
const SINGLE: f64 = 2e-7;

/// Hues are single precision numbers, and their attenuation comes from a table.
const LIGHT: f64 = 1e-5;

/// The pipe of an exact picture: nothing is cut.
fn exact(beta: Option<DVec3>) -> Pipe {
    let mut pipe = Pipe::default();
    pipe.lorentz.velocity = beta;
    pipe.lorentz.pieces = uglorentz::Pieces::PerEdge(1);
    pipe.rainbow.exact = Some(Exact::default());
    pipe.rainbow.size = SIZE;
    pipe.rainbow.samples = 1;
    pipe
}

/// The channels of the picture, pixel by pixel.
fn channels(pipe: &Pipe, text: &[u8]) -> BTreeMap<String, Vec<f64>> {
    let mut pipe = pipe.clone();
    pipe.rainbow.output = Output::Color(Format::Exr);
    pipe.rainbow.channels = vec![Channel::Id, Channel::Distance, Channel::Doppler];
    let file = rainbow(&lorentz(text, &pipe.lorentz), &pipe.rainbow);
    let image = exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .first_valid_layer()
        .all_attributes()
        .from_buffered(std::io::Cursor::new(file))
        .unwrap();
    let list = image.layer_data.channel_data.list.iter();
    list.map(|channel| {
        let numbers = channel.sample_data.values_as_f32().map(f64::from).collect();
        (channel.name.to_string(), numbers)
    })
    .collect()
}

/// A sample may show another face than the oracle's only where another is as near, or next to it to rounding.
fn is_on_boundary(oracle: &Oracle, camera: &Pinhole, [x, y]: [f64; 2], face: Option<usize>) -> bool {
    const NEXT: f64 = 1e-7;
    let steps = [-NEXT, 0.0, NEXT];
    let around = steps.iter().flat_map(|dx| steps.map(|dy| camera.direction(x + dx, y + dy)));
    let around: Vec<DVec3> = around.collect();
    let shown = oracle.faces(&around);
    around.iter().zip(shown).any(|(&direction, nearest)| {
        let distance = |face: Option<usize>| face.and_then(|face| oracle.distance(face, direction));
        let is_as_near = |(own, nearest): (f64, f64)| (own / nearest - 1.0).abs() < SINGLE;
        nearest == face || distance(face).zip(distance(nearest)).is_some_and(is_as_near)
    })
}

/// The scene with its faces in triangles: on a face that is not quite flat an outline seen from the eye and
/// one in a mean plane differ by as much.
fn triangles(mut scene: Scene) -> Scene {
    for face in std::mem::take(&mut scene.faces) {
        let rings: Vec<Vec<VertexId>> = scene.face_contours(&face).map(<[VertexId]>::to_vec).collect();
        let places =
            |ring: &Vec<VertexId>| ring.iter().map(|id| scene.vertices[id.index()].position).collect();
        let places: Vec<Vec<DVec3>> = rings.iter().map(places).collect();
        let corners = rings.concat();
        let is_flat =
            ugparse::newell_normal(places[0].iter().copied()).try_normalize().is_some_and(|normal| {
                places.concat().iter().all(|p| normal.dot(*p - places[0][0]).abs() < 1e-12)
            });
        if is_flat {
            scene.faces.push(face);
            continue;
        }
        let cut = ugscene::triangulate(&places).unwrap();
        let cut = cut.iter().map(|triangle| triangle.map(|corner| corners[corner as usize]));
        for row in scene.contours.push_all(cut) {
            scene.faces.push(Face { contours: row..row + 1, ..face.clone() });
        }
    }
    scene
}

/// A scene, and how it and the camera move.
#[derive(Clone, Copy)]
struct Case {
    scene: &'static str,
    beta: Option<DVec3>,
    camera: Option<DVec3>,
    in_place: bool,
    eye: Option<DVec3>,
    exact: Exact,
    /// `-sm`
    is_smooth: bool,
}

impl Case {
    fn new(scene: &'static str) -> Self {
        Self {
            scene,
            beta: None,
            camera: None,
            in_place: false,
            eye: None,
            exact: Exact::default(),
            is_smooth: false,
        }
    }

    fn moving(scene: &'static str, beta: DVec3) -> Self {
        Self { beta: Some(beta), ..Self::new(scene) }
    }

    fn in_place(scene: &'static str, beta: DVec3) -> Self {
        Self { in_place: true, ..Self::moving(scene, beta) }
    }

    fn name(&self) -> String {
        format!("{}, {:?}, camera {:?}", self.scene, self.beta, self.camera)
    }
}

/// Every sample that is not on a boundary shows the face, distance, D, hue and light that the oracle finds.
#[track_caller]
fn check(case: Case) {
    let name = case.name();
    let mut scene = triangles(scenes::parse(&scenes::text(case.scene)));
    // The oracle knows no wires, and places bodies by their faces.
    scene.wires.clear();
    let mut pipe = exact(case.beta);
    pipe.lorentz.in_place = case.in_place;
    pipe.lorentz.eye = case.eye;
    pipe.lorentz.camera_velocity = case.camera;
    pipe.lorentz.smooth = case.is_smooth;
    pipe.rainbow.exact = Some(case.exact);
    let channels = channels(&pipe, &ugparse::write(&scene));
    let camera = scene.camera().unwrap();
    let eye = case.eye.or(camera.eye).unwrap();
    let oracle = Oracle::new(&scene, eye, case.beta, case.in_place);
    let oracle = case.camera.into_iter().fold(oracle, Oracle::seen_by);
    let camera = Pinhole::new(camera, eye, SIZE);
    let shading = Shading::new(&scene, eye);
    let (mut n_covered, mut n_boundary, mut n_lit) = (0, 0, 0);
    for (pixel, expected) in oracle.picture(&camera).into_iter().enumerate() {
        let [x, y] = [pixel as u32 % SIZE[0], pixel as u32 / SIZE[0]].map(|i| f64::from(i) + 0.5);
        let face = (channels["id"][pixel] as usize).checked_sub(1);
        if face != expected {
            assert!(
                is_on_boundary(&oracle, &camera, [x, y], face),
                "{name} at {x}, {y}: face {face:?} in place of {expected:?}"
            );
            n_boundary += 1;
            continue;
        }
        let Some(face) = face else { continue };
        n_covered += 1;
        let direction = camera.direction(x, y);
        let hit = oracle.hit(face, direction).unwrap();
        let distance = oracle.distance(face, direction).unwrap();
        for (channel, expected) in [("distance", distance), ("D", hit.doppler)] {
            let ours = channels[channel][pixel];
            let off = (ours / expected - 1.0).abs();
            assert!(off < SINGLE, "{name} at {x}, {y}: {channel} {ours}, not {expected}");
        }
        let light = shading.seen(face, &hit, hit.doppler, case.exact).filter(|_| !case.is_smooth);
        for (channel, expected) in ["R", "G", "B"].into_iter().zip(light.iter().flatten()) {
            let ours = channels[channel][pixel];
            let off = (ours - expected).abs() / expected.max(1.0);
            assert!(off < LIGHT, "{name} at {x}, {y}: {channel} {ours}, not {expected}");
        }
        n_lit += usize::from(light.is_some());
    }
    println!("{name}: {n_covered} samples, {n_lit} with light, {n_boundary} on boundaries");
    assert!(n_covered > 100, "{name}: {n_covered}");
    assert!(n_boundary < 20, "{name}: {n_boundary}");
}

#[test]
fn ship_is_exact() {
    SPEEDS.into_iter().for_each(|speed| check(Case::in_place("ship", speed * DVec3::X)));
}

#[test]
fn cubes_are_exact() {
    SPEEDS.into_iter().for_each(|speed| check(Case::in_place("cubes", speed * DVec3::new(0.8, -0.6, 0.0))));
}

#[test]
fn street_is_exact() {
    let eye = Some(DVec3::new(0.0, 20.0, 3.0));
    SPEEDS.into_iter().for_each(|speed| check(Case { eye, ..Case::moving("street", speed * DVec3::NEG_Y) }));
}

#[test]
fn lattice_is_exact() {
    // From its middle many samples would look exactly at edges.
    let eye = Some(DVec3::new(0.013, 0.0, 0.007));
    SPEEDS.into_iter().for_each(|speed| check(Case { eye, ..Case::moving("lattice", speed * DVec3::NEG_Y) }));
}

#[test]
fn spheres_are_exact() {
    SPEEDS.into_iter().for_each(|speed| check(Case::in_place("sphere", speed * DVec3::X)));
    SPEEDS.into_iter().for_each(|speed| check(Case::in_place("halves", speed * DVec3::new(0.0, 0.6, 0.8))));
}

#[test]
fn teapot_is_exact() {
    SPEEDS.into_iter().for_each(|speed| check(Case::in_place("teapot", speed * DVec3::X)));
    check(Case { is_smooth: true, ..Case::in_place("teapot", 0.9 * DVec3::X) });
}

#[test]
fn grid_is_exact() {
    SPEEDS.into_iter().for_each(|speed| check(Case::in_place("grid", speed * DVec3::new(0.6, 0.0, 0.8))));
}

/// Black bodies in it are not for hues.
#[test]
fn tunnel_is_exact() {
    let exact = Exact::NONE;
    let eye = Some(DVec3::new(0.012, 0.0, 0.007));
    SPEEDS
        .into_iter()
        .for_each(|speed| check(Case { eye, exact, ..Case::moving("tunnel", speed * DVec3::NEG_Y) }));
}

#[test]
fn places_under_a_lamp_are_exact() {
    let eye = Some(DVec3::new(0.1, -2.0, 2.0));
    for speed in [0.3, 0.9, 0.99] {
        check(Case { eye, ..Case::moving("lamp", speed * DVec3::NEG_Y) });
    }
    for speed in [0.3, 0.9] {
        check(Case { camera: Some(speed * DVec3::Y), ..Case::new("lamp") });
    }
}

#[test]
fn bodies_of_several_velocities_are_exact() {
    check(Case { in_place: true, ..Case::new("dice") });
    check(Case::new("lamp"));
}

/// Houses, cars and the camera are in four frames.
#[test]
fn traffic_is_exact_for_a_camera_that_moves() {
    SPEEDS
        .into_iter()
        .for_each(|speed| check(Case { camera: Some(speed * DVec3::Y), ..Case::new("traffic") }));
    check(Case { camera: Some(DVec3::new(0.4, 0.6, -0.1)), ..Case::new("traffic") });
}

#[test]
fn scenes_are_exact_for_a_camera_that_moves() {
    let eye = Some(DVec3::new(0.0, 20.0, 3.0));
    let aside = DVec3::new(0.36, 0.8, 0.48);
    SPEEDS
        .into_iter()
        .for_each(|speed| check(Case { eye, camera: Some(speed * aside), ..Case::new("street") }));
    check(Case { camera: Some(0.3 * DVec3::NEG_Y), ..Case::new("dice") });
}

/// A square that fills the picture and comes with a velocity across and toward the eye.
const SQUARE: &str = "c green .9 130 .8; l .2; l .7 1 -2 .5; cam -ep 0 0 0 -vc 0 9 0 -va 60 50;
    v a -40 9 -40; v b 40 9 -40; v c 40 9 40; v d -40 9 40; f (a b c d) green <.2 -.1 0>;";

#[test]
fn colour_and_light_are_those_of_the_point() {
    let laws = [(Brightness::Report, true), (Brightness::Photon, true), (Brightness::None, false)];
    for (law, doppler) in laws {
        for point_light in [false, true] {
            let text = if point_light {
                SQUARE.replace("l .7 1 -2 .5;", "l .7 1 4 .5 1;")
            } else {
                SQUARE.to_owned()
            };
            let mut pipe = exact(None);
            pipe.rainbow.exact = Some(Exact { law, doppler });
            let channels = channels(&pipe, text.as_bytes());
            let scene = scenes::parse(text.as_bytes());
            let camera = Pinhole::new(scene.camera().unwrap(), DVec3::ZERO, SIZE);
            let velocity = Velocity::from_beta(DVec3::new(0.2, -0.1, 0.0)).unwrap();
            for pixel in (0..(SIZE[0] * SIZE[1]) as usize).step_by(37) {
                let [x, y] = [pixel as u32 % SIZE[0], pixel as u32 / SIZE[0]].map(|i| f64::from(i) + 0.5);
                let direction = camera.direction(x, y);
                let rest = rest_position(direction, velocity);
                let point = rest * (9.0 / rest.y);
                let toward = if point_light {
                    (DVec3::new(1.0, 4.0, 0.5) - point).normalize()
                } else {
                    DVec3::new(1.0, -2.0, 0.5).normalize()
                };
                let level = 0.2 + 0.7 * toward.dot(DVec3::NEG_Y).max(0.0);
                let factor = doppler_at(direction, velocity);
                let wavelength_nm = hue_to_wavelength(130.0) / if doppler { factor } else { 1.0 };
                let value = 0.9 * level * law.factor(factor) * attenuation(wavelength_nm);
                let color = Hsv { hue: wavelength_to_hue(wavelength_nm), saturation: 0.8, value };
                for (name, channel) in ["R", "G", "B"].iter().zip(color.to_rgb()) {
                    let (ours, expected) = (channels[*name][pixel], srgb_decode(channel));
                    assert!(
                        (ours - expected).abs() < 1e-5,
                        "{law:?}, {point_light}, {x}, {y}: {name} {ours}, not {expected}"
                    );
                }
            }
        }
    }
}

/// Colours and normals of corners, and a hole, in triangles at rest. At rest a triangle is the same in both modes.
#[test]
fn at_rest_triangles_are_those_of_the_scanline_mode() {
    const TRIANGLES: &str = "c red 1 0; c blue .8 220 .9; c grey .7; l .3; l .8 1 -2 .5;
        cam -ep 0 0 0 -vc 0 9 0 -va 60 50;
        v a -3 9 -2 red 0 -1 .3; v b 3 8 -2 blue; v c 0 10 3 grey .5 -1 0; f (a b c); v d 3 12 3; f (b d c);";
    let mut pipe = exact(None);
    let exact = decode(&rainbow(TRIANGLES.as_bytes(), &pipe.rainbow));
    pipe.rainbow.exact = None;
    let scanned = decode(&rainbow(TRIANGLES.as_bytes(), &pipe.rainbow));
    // Normals are interpolated before the light is computed, not behind.
    ugtests::picture::assert_same("exact-triangles", &scanned, &exact, 12);
}

/// The scanline mode on a scene that was cut finely shows the same, but for samples at the rims of faces.
#[test]
fn both_modes_agree() {
    let cases = [("cubes", 0.9 * DVec3::X), ("ship", 0.3 * DVec3::NEG_Y), ("box", 0.9 * DVec3::X)];
    for (name, beta) in cases {
        let text = if name == "box" { BOX.as_bytes().to_vec() } else { scenes::text(name) };
        let mut pipe = exact(Some(beta)).in_place();
        let drawn = decode(&rainbow(&lorentz(&text, &pipe.lorentz), &pipe.rainbow));
        pipe.lorentz.pieces = uglorentz::Config::default().pieces;
        pipe.rainbow.exact = None;
        pipe.doppler.keep = true;
        let scanned = pipe.draw(&text);
        let far = |(a, b): (&image::Rgba<u8>, &image::Rgba<u8>)| {
            a.0.iter().zip(b.0).any(|(&a, b)| a.abs_diff(b) > 12)
        };
        let n_far = drawn.pixels().zip(scanned.pixels()).filter(|&pair| far(pair)).count();
        let n_pixels = (SIZE[0] * SIZE[1]) as usize;
        assert!(n_far * 200 < n_pixels, "{name}: {n_far} of {n_pixels}");
    }
}

/// By rays and by polygons: the nearest that lets through less than half of the light.
#[test]
fn channels_tell_of_what_hides_more_than_it_shows() {
    for (translucency, first) in [(0.0, 1.0), (0.4, 1.0), (0.6, 2.0), (1.0, 2.0)] {
        let text = format!(
            "c pane 1 0 1 {translucency}; c wall .8; l 1; cam -ep 0 0 0 -vc 0 1 0 -va 60 50;
             v a -9 4 -9; v b 9 4 -9; v c 9 4 9; v d -9 4 9; f (a b c d) pane;
             v e -9 8 -9; v f 9 8 -9; v g 9 8 9; v h -9 8 9; f (e f g h) wall;"
        );
        let exact = exact(None);
        let mut scanned = exact.clone();
        scanned.rainbow.exact = None;
        for pipe in [exact, scanned] {
            assert!(channels(&pipe, text.as_bytes())["id"].iter().all(|id| *id == first), "{translucency}");
        }
    }
}

/// A box of wires, which bend.
const BOX: &str = "c green 1 120; cam -ep 0 -9 1 -vc 0 0 0 -va 70 50; l 1;
    v a -3 -3 -3; v b 3 -3 -3; v c 3 3 -3; v d -3 3 -3; v e -3 -3 3; v f 3 -3 3; v g 3 3 3; v h -3 3 3;
    w (a b c d a e f g h e) green; w (b f) (c g) (d h);";

#[test]
fn threads_and_tiles_do_not_show() {
    let text = scenes::text("street");
    let mut pipe = exact(Some(0.9 * DVec3::NEG_Y));
    pipe.rainbow.samples = 3;
    let seen = lorentz(&text, &pipe.lorentz);
    let draw = |n_threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(n_threads).build().unwrap();
        pool.install(|| rainbow(&seen, &pipe.rainbow))
    };
    assert_eq!(draw(1), draw(3));
}

#[test]
fn what_rays_cannot_find_is_refused() {
    let refusal = |pipe: &Pipe, text: &[u8]| {
        let source = ugparse::Source::new("test.ug", text);
        ugrainbow::run(&pipe.rainbow, &source).err().map(|error| error.to_string())
    };
    let mut pipe = exact(Some(0.5 * DVec3::X));
    let seen = lorentz(SQUARE.as_bytes(), &pipe.lorentz);
    assert_eq!(refusal(&pipe, &seen), None);
    let colored = ugtests::pipe::doppler(&seen, &pipe.doppler);
    assert!(refusal(&pipe, &colored).unwrap().contains("leave ugdoppler out"));
    let spectral = SQUARE.replace("c green .9 130 .8;", "c_bb green 5000;");
    let glowing = lorentz(spectral.as_bytes(), &pipe.lorentz);
    assert!(refusal(&pipe, &glowing).unwrap().contains("ugdoppler -sp"));
    let mut shape = pipe.clone();
    shape.rainbow.exact = Some(Exact::NONE);
    assert_eq!(refusal(&shape, &glowing), None);
    let at_rest = spectral.replace("<.2 -.1 0>", "");
    assert_eq!(refusal(&pipe, at_rest.as_bytes()), None);
    pipe.lorentz.geometry.contraction = false;
    let bent = lorentz(SQUARE.as_bytes(), &pipe.lorentz);
    assert!(refusal(&pipe, &bent).unwrap().contains("leave out -xc"));
    pipe.rainbow.camera.is_orthographic = true;
    assert!(refusal(&pipe, &seen).unwrap().contains("orthographic"));
}

/// Lights that move are not followed, and the note says what does.
#[test]
fn of_lights_that_move_there_is_a_note() {
    let notes = |text: &str| {
        let (_, notes) = ugrainbow::render(&scenes::parse(text.as_bytes()), &exact(None).rainbow).unwrap();
        notes.join("; ")
    };
    assert_eq!(notes(SQUARE), "");
    let moving = notes(&SQUARE.replace("l .7 1 -2 .5;", "l .7 1 -2 .5 <0 .5 0>;"));
    assert!(moving.contains("leave out -xc") && moving.contains("ugdoppler -li"), "{moving}");
    // At rest a spectrum is as it is: there is nothing to say.
    let glowing = SQUARE.replace("c green .9 130 .8;", "c_bb green 5000;").replace("<.2 -.1 0>", "");
    assert!(!notes(&glowing).contains("ugdoppler"), "{}", notes(&glowing));
}
