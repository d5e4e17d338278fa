//! The whole pipe against a picture computed the other way round: a ray from each pixel into the rest
//! frames, see [`ugtests::oracle`].
//!
//! Every face gets a colour of its own, light comes from everywhere and colours stay as they are, so each
//! pixel names the face it shows.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test fails by panicking")]

use std::fmt::{self, Display, Formatter};

use glam::{DVec2, DVec3};
use ugparse::{Color, ColorId, ColorValue, Face, Light, LightKind, Scene};
use ugtests::oracle::{Oracle, Pinhole};
use ugtests::picture::{Picture, save};
use ugtests::pipe::Pipe;
use ugtests::scenes;

const SIZE: [u32; 2] = [640, 480];

/// Least part of the pixels that show the very face.
const LEAST_AGREEMENT: f64 = 0.995;

/// Pixels; a face may be seen this far from where it should be.
const REACH: f64 = 1.5;

/// Pixels that show a wrong face before the search for more is given up.
const MOST_WRONG: usize = 20;

/// Levels between colours of faces. They are exact to one level.
const STEP: usize = 4;
/// Darkest level of a colour, well above the black background.
const DARKEST: usize = 28;
/// Colours of one plane: two channels, the third is 0.
const SIDE: usize = 57;

/// The colour of a face: without blue, then without red. Its hue lies in 0…240 degrees, where
/// wavelengths are not attenuated (P17).
fn color_of(face: usize) -> [u8; 3] {
    let plane = face % (SIDE * SIDE);
    let [a, b] = [plane % SIDE, plane / SIDE].map(|step| u8::try_from(DARKEST + STEP * step).unwrap());
    match face / (SIDE * SIDE) {
        0 => [a, b, 0],
        1 => [0, a, b],
        _ => panic!("there are colours for {} faces only", 2 * SIDE * SIDE),
    }
}

/// What a pixel shows: a face, or nothing. `Err` for a colour that no face has.
type Shown = Result<Option<usize>, [u8; 4]>;

fn face_of(pixel: [u8; 4]) -> Shown {
    let step = |level: u8| {
        let above = usize::from(level).checked_sub(DARKEST - 1)?;
        (above % STEP <= 2).then_some(above / STEP).filter(|&step| step < SIDE)
    };
    match pixel {
        [0, 0, 0, 255] => Ok(None),
        [r, g, 0, 255] => step(r).zip(step(g)).map(|(a, b)| Some(a + SIDE * b)).ok_or(pixel),
        [0, g, b, 255] => step(g).zip(step(b)).map(|(a, b)| Some(SIDE * SIDE + a + SIDE * b)).ok_or(pixel),
        _ => Err(pixel),
    }
}

/// The scene with a colour for each face, lit from everywhere.
fn recolored(mut scene: Scene) -> Scene {
    scene.colors.clear();
    scene.wires.clear();
    scene.comments.clear();
    scene.lights =
        vec![Light { name: None, intensity: 1.0, kind: LightKind::Ambient, color: None, velocity: None }];
    for vertex in &mut scene.vertices {
        vertex.color = None;
    }
    for (row, face) in scene.faces.iter_mut().enumerate() {
        let rgb = color_of(row).map(|level| f64::from(level) / 255.0);
        let name = scene.names.add(&format!("k{row}"));
        scene.colors.push(Color { name, value: ColorValue::Rgb(rgb), translucency: 0.0 });
        *face = Face { color: Some(ColorId::from_index(row)), illum: None, ..face.clone() };
    }
    scene
}

/// A scene and how it moves.
#[derive(Clone, Copy)]
struct Case {
    scene: &'static str,
    /// Of everything; `None` leaves the velocities of the scene.
    beta: Option<DVec3>,
    in_place: bool,
    eye: Option<DVec3>,
    /// Of the camera in the scene.
    camera: Option<DVec3>,
    /// In place of the file of the scene.
    text: Option<&'static str>,
}

impl Case {
    /// A scene as it stands, cut as finely as by default.
    const fn new(scene: &'static str) -> Self {
        Self { scene, beta: None, in_place: false, eye: None, camera: None, text: None }
    }
}

/// How far the pipe and the oracle agree.
#[derive(Debug, Default)]
struct Agreement {
    n_pixels: usize,
    /// Pixels where both show the same face, or two that coincide there.
    n_same: usize,
    /// Pixels where both see nothing.
    n_empty: usize,
    /// Pixels with a face that is not seen within reach.
    wrong: Vec<Wrong>,
}

impl Agreement {
    fn part(&self) -> f64 {
        self.n_same as f64 / self.n_pixels as f64
    }

    fn n_far(&self) -> usize {
        self.wrong.iter().filter(|wrong| !wrong.is_at_boundary).count()
    }

    fn is_good(&self) -> bool {
        let shows_something = self.n_empty < self.n_pixels * 98 / 100;
        self.part() >= LEAST_AGREEMENT && self.n_far() == 0 && self.wrong.is_empty() && shows_something
    }
}

impl Display for Agreement {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{:.3} % agree, {} differ", 100.0 * self.part(), self.n_pixels - self.n_same)?;
        write!(f, ", {:.0} % empty", 100.0 * self.n_empty as f64 / self.n_pixels as f64)?;
        write!(f, ", {} seen through seams", self.wrong.len() - self.n_far())?;
        write!(f, ", {} far off", self.n_far())?;
        for Wrong { pixel, shown, expected, .. } in self.wrong.iter().take(8) {
            write!(f, ", {pixel:?} shows {shown:?} for {expected:?}")?;
        }
        Ok(())
    }
}

/// A pixel that shows what it should not.
#[derive(Debug)]
struct Wrong {
    pixel: [u32; 2],
    /// Within reach something else than expected is seen, too.
    is_at_boundary: bool,
    shown: Shown,
    expected: Option<usize>,
}

/// What is seen near a pixel.
struct Neighbourhood<'a> {
    oracle: &'a Oracle,
    camera: &'a Pinhole,
    /// What the oracle sees in the middle of each pixel.
    picture: &'a [Option<usize>],
}

impl Neighbourhood<'_> {
    /// Is the face, or nothing, seen within `REACH` of the middle of a pixel?
    fn shows(&self, face: Option<usize>, center: DVec2) -> bool {
        self.neighbours(center).any(|neighbour| neighbour == face)
            || self.rings(center).contains(&face)
            || face.is_some_and(|face| self.has_edge(face, center))
    }

    /// What the pixels within reach show: the eight round it.
    fn neighbours(&self, center: DVec2) -> impl Iterator<Item = Option<usize>> {
        let [width, height] = self.camera.size().map(|side| side as usize);
        let (x, y) = (center.x as usize, center.y as usize);
        let rows = y.saturating_sub(1)..height.min(y + 2);
        let columns = move || x.saturating_sub(1)..width.min(x + 2);
        rows.flat_map(move |y| columns().map(move |x| self.picture[y * width + x]))
    }

    /// What is seen at 48 points on each of five rings.
    fn rings(&self, center: DVec2) -> Vec<Option<usize>> {
        let radii = (1..=5).map(|ring| REACH * f64::from(ring) / 5.0);
        let angles = || (0..48).map(|step| f64::from(step) / 48.0 * std::f64::consts::TAU);
        let points = radii.flat_map(|radius| {
            angles().map(move |angle| {
                let (sin, cos) = libm::sincos(angle);
                center + radius * DVec2::new(cos, sin)
            })
        });
        let directions: Vec<DVec3> = points.map(|p| self.camera.direction(p.x, p.y)).collect();
        self.oracle.faces(&directions)
    }

    /// For faces so thin that no point of a ring hits them.
    fn has_edge(&self, face: usize, center: DVec2) -> bool {
        let edges = self.oracle.edges_near(face, self.camera.direction(center.x, center.y));
        let mut pixels = edges.into_iter().filter_map(|direction| self.camera.pixel(direction));
        pixels.any(|pixel| pixel.distance(center) <= REACH)
    }
}

fn compare(actual: &Picture, oracle: &Oracle, camera: &Pinhole) -> Agreement {
    let mut agreement = Agreement::default();
    let near = Neighbourhood { oracle, camera, picture: &oracle.picture(camera) };
    for ((x, y, pixel), &expected) in actual.enumerate_pixels().zip(near.picture) {
        agreement.n_pixels += 1;
        agreement.n_empty += usize::from(expected.is_none());
        let shown = face_of(pixel.0);
        let center = DVec2::new(f64::from(x), f64::from(y)) + 0.5;
        let coincide = |a, b| coincide(oracle, a, b, camera.direction(center.x, center.y));
        let is_same = match (shown, expected) {
            (Ok(Some(shown)), Some(expected)) => shown == expected || coincide(shown, expected),
            (shown, expected) => shown == Ok(expected),
        };
        agreement.n_same += usize::from(is_same);
        let is_enough = agreement.wrong.len() > MOST_WRONG;
        if !is_same && !is_enough && !shown.is_ok_and(|face| near.shows(face, center)) {
            let is_at_boundary = near.rings(center).iter().any(|&face| face != expected);
            agreement.wrong.push(Wrong { pixel: [x, y], is_at_boundary, shown, expected });
        }
    }
    agreement
}

/// Two faces in one place: rods that cross have faces in common planes.
fn coincide(oracle: &Oracle, a: usize, b: usize, direction: DVec3) -> bool {
    match (oracle.distance(a, direction), oracle.distance(b, direction)) {
        (Some(a), Some(b)) => (a - b).abs() <= 1e-9 * a,
        _ => false,
    }
}

/// The picture the oracle sees, in the colours of the faces.
fn painted(oracle: &Oracle, camera: &Pinhole) -> Picture {
    let [width, height] = camera.size();
    let pixels = oracle.picture(camera).into_iter().flat_map(|face| {
        let [r, g, b] = face.map_or([0; 3], color_of);
        [r, g, b, 255]
    });
    Picture::from_raw(width, height, pixels.collect()).unwrap()
}

/// Draws a case both ways. The error says what differs, and where to look at it.
fn check(case: Case) -> Result<(), String> {
    let text = case.text.map_or_else(|| scenes::text(case.scene), |text| text.as_bytes().to_vec());
    let scene = recolored(scenes::parse(&text));
    let mut pipe = Pipe::default().shape();
    pipe.lorentz.velocity = case.beta;
    pipe.lorentz.camera_velocity = case.camera;
    pipe.lorentz.in_place = case.in_place;
    pipe.lorentz.eye = case.eye;
    pipe.doppler.repeat = true;
    pipe.rainbow.size = SIZE;
    pipe.rainbow.samples = 1;
    let actual = pipe.draw(&ugparse::write(&scene));

    let camera = scene.camera().unwrap();
    let eye = case.eye.or(camera.eye).unwrap();
    let oracle = Oracle::new(&scene, eye, case.beta, case.in_place);
    let oracle = case.camera.into_iter().fold(oracle, Oracle::seen_by);
    let camera = Pinhole::new(camera, eye, SIZE);
    let agreement = compare(&actual, &oracle, &camera);

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

/// Checks all cases before it fails.
#[track_caller]
fn check_all(cases: impl IntoIterator<Item = Case>) {
    let failures: Vec<String> = cases.into_iter().filter_map(|case| check(case).err()).collect();
    assert!(failures.is_empty(), "\n{}", failures.join("\n"));
}

const SPEEDS: [f64; 4] = [0.3, 0.6, 0.9, 0.99];

#[test]
fn colours_name_faces() {
    for face in 0..2 * SIDE * SIDE {
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
    check_all(SPEEDS.map(|speed| Case { beta: Some(speed * DVec3::NEG_Y), ..lattice }));
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

/// Where plates of different velocity cut through each other, the later emission is seen, (P22).
#[test]
fn moving_bodies_cut_through_each_other() {
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
