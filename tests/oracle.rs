//! Compares the whole pipe with an independent renderer that intersects a ray from each pixel in
//! the rest frames, see [`ugtests::oracle`] and [`ugtests::agreement`].

use glam::DVec3;
use ugtests::agreement::{MOST_FACES, color_of, compare, face_of, painted, recolored};
use ugtests::oracle::{Oracle, Pinhole};
use ugtests::outline;
use ugtests::picture::save;
use ugtests::pipe::Pipe;
use ugtests::scenes;

const SIZE: [u32; 2] = [240, 180];

/// The allowed displacement of a face, pixels.
const REACH: f64 = 0.5;

/// A scene and its motion.
#[derive(Clone, Copy)]
struct Case {
    scene: &'static str,
    /// Velocity of all bodies; `None` keeps those of the scene.
    beta: Option<DVec3>,
    in_place: bool,
    eye: Option<DVec3>,
    /// Velocity of the camera in the scene.
    camera: Option<DVec3>,
    /// Text that replaces the file of the scene.
    text: Option<&'static str>,
}

impl Case {
    /// A scene with its own velocities and the default bounds.
    const fn new(scene: &'static str) -> Self {
        Self { scene, beta: None, in_place: false, eye: None, camera: None, text: None }
    }
}

/// Draws a case with the pipe and with the oracle. The error describes the difference and names the
/// saved pictures.
fn check(case: Case) -> Result<(), String> {
    let text = case.text.map_or_else(|| scenes::text(case.scene), |text| text.as_bytes().to_vec());
    let scene = recolored(scenes::parse(&text));
    let mut pipe = Pipe::default().shape();
    pipe.lorentz.velocity = case.beta;
    pipe.lorentz.camera_velocity = case.camera;
    pipe.lorentz.in_place = case.in_place;
    // The oracle's bodies are those of one velocity.
    pipe.lorentz.anchor = (!case.in_place).then_some(uglorentz::Anchor::Eye);
    pipe.lorentz.eye = case.eye;
    // A twentieth of a pixel.
    pipe.lorentz.pieces = uglorentz::Pieces::UpTo(2e-4);
    // Colours are not shifted.
    pipe.lorentz.color_error = f64::INFINITY;
    pipe.doppler.repeat = true;
    pipe.rainbow.picture.size = SIZE;
    pipe.rainbow.picture.samples = 1;
    let actual = pipe.draw(&ugparse::write(&scene));

    let camera = scene.camera().unwrap();
    let eye = case.eye.or(camera.eye).unwrap();
    let oracle = Oracle::new(&scene, eye, case.beta, case.in_place);
    let oracle = case.camera.into_iter().fold(oracle, Oracle::seen_by);
    let camera = Pinhole::new(camera, eye, SIZE);
    let agreement = compare(&actual, &oracle, &camera, REACH);

    let name = match case.beta.or(case.camera) {
        Some(beta) => format!("{}-{:.2}c", case.scene, beta.length()),
        None => case.scene.to_string(),
    };
    let summary = format!("{name}: {agreement}");
    println!("{summary}");
    if agreement.is_good() {
        return Ok(());
    }
    let ours = save(&format!("oracle-{name}-pipe"), &actual);
    let theirs = save(&format!("oracle-{name}-expected"), &painted(&oracle, &camera));
    Err(format!("{summary}; see {} and {}", ours.display(), theirs.display()))
}

/// Checks all cases, and then fails with all errors.
#[track_caller]
fn check_all(cases: impl IntoIterator<Item = Case>) {
    let failures: Vec<String> = cases.into_iter().filter_map(|case| check(case).err()).collect();
    assert!(failures.is_empty(), "\n{}", failures.join("\n"));
}

const SPEEDS: [f64; 4] = [0.3, 0.6, 0.9, 0.99];

#[test]
fn colours_name_faces() {
    for face in 0..MOST_FACES {
        let [r, g, b] = color_of(face);
        assert_eq!(face_of([r, g, b, 255]), Ok(Some(face)));
    }
}

#[test]
fn ship_flies_by() {
    let ship = Case { in_place: true, ..Case::new("ship") };
    check_all(SPEEDS.map(|speed| Case { beta: Some(speed * DVec3::X), ..ship }));
}

#[test]
fn cubes_fly_by() {
    let cubes = Case { in_place: true, ..Case::new("cubes") };
    check_all(SPEEDS.map(|speed| Case { beta: Some(speed * DVec3::new(0.8, -0.6, 0.0)), ..cubes }));
}

#[test]
fn street_is_left_behind() {
    let street = Case { eye: Some(DVec3::new(0.0, 20.0, 3.0)), ..Case::new("street") };
    check_all(SPEEDS.map(|speed| Case { beta: Some(speed * DVec3::NEG_Y), ..street }));
}

#[test]
fn lattice_is_flown_through() {
    let lattice = Case::new("lattice");
    check_all([0.6, 0.99].map(|speed| Case { beta: Some(speed * DVec3::NEG_Y), ..lattice }));
}

#[test]
fn dice_have_five_velocities() {
    check_all([Case { in_place: true, ..Case::new("dice") }]);
}

/// Houses, cars and the camera are in four frames.
#[test]
fn traffic_is_seen_from_a_car() {
    check_all(SPEEDS.map(|speed| Case { camera: Some(speed * DVec3::Y), ..Case::new("traffic") }));
    let aside = DVec3::new(0.4, 0.6, -0.1);
    check_all([Case { camera: Some(aside), ..Case::new("traffic") }]);
}

/// Where plates of different velocity intersect, the later emission is visible, (P22).
#[test]
fn moving_bodies_intersect() {
    const PLATES: &str = "cam -ep 0 -1 0 -vc 0 6 0 -ud 0 0 1 -va 60 45;
        v a -3 4 -2; v b 3 8 -2; v c 3 8 2; v d -3 4 2; f (a b c d) <0.7 0 0>;
        v e -3 8 -2; v f 3 4 -2; v g 3 4 2; v h -3 8 2; f (e f g h) <-0.5 0.3 0>;
        v i -2 5 -2; v j 2 5 -2; v k 2 7 2; v l -2 7 2; f (i j k l) <0 -0.6 0.6>;
        v m -2 7 -1; v n 2 7 -1; v o 2 5 1; v p -2 5 1; f (m n o p);";
    check_all([Case { in_place: true, text: Some(PLATES), ..Case::new("plates") }]);
    check_all([DVec3::new(0.18, 0.0, 0.24), DVec3::new(0.2, 0.8, 0.0)].map(|camera| Case {
        camera: Some(camera),
        text: Some(PLATES),
        ..Case::new("plates")
    }));
}

/// The outlines of docs/geometry.md, at one speed each.
#[test]
fn outline_errors_are_within_the_bound() {
    for (name, in_place, beta) in [
        ("cubes", true, DVec3::new(0.9, 0.0, 0.0)),
        ("sphere", true, DVec3::new(0.0, -0.9, 0.0)),
        ("ship", true, DVec3::new(0.7, 0.6, 0.3)),
    ] {
        let mut scene = scenes::parse(&scenes::text(name));
        scene.wires.clear();
        for row in 0..scene.faces.len() {
            scene.faces[row].name = Some(scene.names.add(&format!("f{row}")));
        }
        let eye = scene.camera().unwrap().eye.unwrap();
        let oracle = Oracle::new(&scene, eye, Some(beta), in_place);
        for bound in [3e-3, 0.3e-3] {
            let config = uglorentz::Config {
                velocity: Some(beta),
                in_place,
                pieces: uglorentz::Pieces::UpTo(bound),
                ..uglorentz::Config::default()
            };
            let seen = uglorentz::apply(scene.clone(), &config).unwrap().0;
            let row =
                |face: &ugscene::Face| seen.names.get(face.name.unwrap())[1..].parse().unwrap();
            let origins: Vec<usize> = seen.faces.iter().map(row).collect();
            let errors = outline::errors(&seen, &origins, eye, &oracle);
            println!("{name} {bound}: {errors:?}");
            assert!(errors.n_edges >= scene.faces.len(), "{name}: {errors:?}");
            assert!(
                errors.angle <= bound && errors.angle > bound / 10.0,
                "{name} {bound}: {errors:?}"
            );
        }
    }
}
