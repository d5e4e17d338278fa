//! Compares every sample with the oracle and the formulas.

use glam::DVec3;
use ugrainbow::ColorShift;
use ugscene::{Face, Scene, VertexId};
use ugtests::oracle::{Oracle, Pinhole};
use ugtests::scenes;
use ugtests::shading::Shading;

use super::{SIZE, channels, exact};

const SPEEDS: [f64; 4] = [0.3, 0.9, 0.99, 0.999];

/// Depth is compared in single precision.
const SINGLE: f64 = 2e-7;

/// Hues are in single precision, and their attenuation comes from a table.
const LIGHT: f64 = 1e-5;

/// X, Y and Z of spectra come from tables over D; red, green and blue are differences of them.
const SPECTRAL_LIGHT: f64 = 2e-3;

/// A sample may show another face than the oracle's only if that face is equally near, or adjacent
/// up to rounding.
fn is_on_boundary(
    oracle: &Oracle,
    camera: &Pinhole,
    [x, y]: [f64; 2],
    face: Option<usize>,
) -> bool {
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

/// The scene with its faces triangulated, because the outline of a face that is not quite flat
/// differs from the outline in its mean plane.
fn triangles(mut scene: Scene) -> Scene {
    for face in std::mem::take(&mut scene.faces) {
        let rings: Vec<Vec<VertexId>> =
            scene.face_contours(&face).map(<[VertexId]>::to_vec).collect();
        let positions = |ring: &Vec<VertexId>| {
            ring.iter().map(|id| scene.vertices[id.index()].position).collect()
        };
        let positions: Vec<Vec<DVec3>> = rings.iter().map(positions).collect();
        let corners = rings.concat();
        let is_flat = ugscene::newell_normal(positions[0].iter().copied())
            .try_normalize()
            .is_some_and(|normal| {
                positions.concat().iter().all(|p| normal.dot(*p - positions[0][0]).abs() < 1e-12)
            });
        if is_flat {
            scene.faces.push(face);
            continue;
        }
        let cut = ugpolygon::triangulate(&positions).unwrap();
        let cut = cut.iter().map(|triangle| triangle.map(|corner| corners[corner as usize]));
        for row in scene.contours.push_all(cut) {
            scene.faces.push(Face { contours: row..row + 1, ..face.clone() });
        }
    }
    scene
}

/// A scene, and the motions of its bodies and the camera.
#[derive(Clone, Copy)]
struct Case {
    scene: &'static str,
    beta: Option<DVec3>,
    camera: Option<DVec3>,
    in_place: bool,
    eye: Option<DVec3>,
    exact: ColorShift,
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
            exact: ColorShift::default(),
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

/// Checks that every sample not on a boundary shows the face, distance, D, hue and light that the
/// oracle computes.
#[track_caller]
fn check(case: Case) {
    let name = case.name();
    let mut scene = triangles(scenes::parse(&scenes::text(case.scene)));
    // The oracle does not support wires, and places bodies by their faces.
    scene.wires.clear();
    let mut pipe = exact(case.beta);
    pipe.lorentz.in_place = case.in_place;
    // The oracle's bodies are those of one velocity.
    pipe.lorentz.anchor = (!case.in_place).then_some(uglorentz::Anchor::Eye);
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
                "{name} at {x}, {y}: face {face:?} instead of {expected:?}"
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
        let brightest = light.iter().flatten().fold(1.0_f64, |all, &channel| all.max(channel));
        for (channel, expected) in ["R", "G", "B"].into_iter().zip(light.iter().flatten()) {
            let ours = channels[channel][pixel];
            let off = (ours - expected).abs() / brightest;
            let bound =
                if matches!(case.exact, ColorShift::Spectra(_)) { SPECTRAL_LIGHT } else { LIGHT };
            assert!(off < bound, "{name} at {x}, {y}: {channel} {ours}, not {expected}");
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
    SPEEDS
        .into_iter()
        .for_each(|speed| check(Case::in_place("cubes", speed * DVec3::new(0.8, -0.6, 0.0))));
}

#[test]
fn street_is_exact() {
    let eye = Some(DVec3::new(0.0, 20.0, 3.0));
    SPEEDS
        .into_iter()
        .for_each(|speed| check(Case { eye, ..Case::moving("street", speed * DVec3::NEG_Y) }));
}

#[test]
fn lattice_is_exact() {
    // From the exact centre, many samples would hit edges.
    let eye = Some(DVec3::new(0.013, 0.0, 0.007));
    SPEEDS
        .into_iter()
        .for_each(|speed| check(Case { eye, ..Case::moving("lattice", speed * DVec3::NEG_Y) }));
}

#[test]
fn spheres_are_exact() {
    SPEEDS.into_iter().for_each(|speed| check(Case::in_place("sphere", speed * DVec3::X)));
    SPEEDS
        .into_iter()
        .for_each(|speed| check(Case::in_place("halves", speed * DVec3::new(0.0, 0.6, 0.8))));
}

#[test]
fn teapot_is_exact() {
    SPEEDS.into_iter().for_each(|speed| check(Case::in_place("teapot", speed * DVec3::X)));
    check(Case { is_smooth: true, ..Case::in_place("teapot", 0.9 * DVec3::X) });
}

#[test]
fn grid_is_exact() {
    SPEEDS
        .into_iter()
        .for_each(|speed| check(Case::in_place("grid", speed * DVec3::new(0.6, 0.0, 0.8))));
}

/// Colours are spectra: of surfaces, and in the tunnel of black bodies.
#[test]
fn spectra_are_exact() {
    let exact = ColorShift::SPECTRA;
    let eye = Some(DVec3::new(0.012, 0.0, 0.007));
    for speed in [0.1, 0.3, 0.6] {
        check(Case { eye, exact, ..Case::moving("tunnel", speed * DVec3::NEG_Y) });
        check(Case { exact, ..Case::in_place("cubes", speed * DVec3::new(0.8, -0.6, 0.0)) });
    }
    check(Case { exact, camera: Some(0.3 * DVec3::Y), ..Case::new("traffic") });
}

/// The tunnel's black bodies have no hues, so only the shape is checked.
#[test]
fn tunnel_is_exact() {
    let exact = ColorShift::NONE;
    let eye = Some(DVec3::new(0.012, 0.0, 0.007));
    SPEEDS.into_iter().for_each(|speed| {
        check(Case { eye, exact, ..Case::moving("tunnel", speed * DVec3::NEG_Y) })
    });
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

/// Houses, cars and the camera have four rest frames.
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
