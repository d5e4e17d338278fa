//! Random scenes and what can be measured on a scene without looking inside the program.

use std::collections::BTreeMap;
use std::fmt::Write;

use glam::DVec3;
use uglorentz::{Config, PROVENANCE, Provenance, Report, Table};
use ugparse::{Options, Parsed, PassedOn, Source};
use ugpipe::Words;
use ugscene::{Face, Scene, VertexId};
use ugtesting::Random;

/// A mesh as text: vertices `v0`, `v1`, … and faces by vertex row.
pub fn text(vertices: &[DVec3], faces: &[Vec<usize>]) -> String {
    let mut text = String::new();
    for (idx, p) in vertices.iter().enumerate() {
        writeln!(text, "v v{idx} {:?} {:?} {:?};", p.x, p.y, p.z).unwrap();
    }
    for (idx, face) in faces.iter().enumerate() {
        let corners: Vec<String> = face.iter().map(|corner| format!("v{corner}")).collect();
        writeln!(text, "f f{idx} ({});", corners.join(" ")).unwrap();
    }
    text
}

/// The scene as seen, written and read again.
pub fn seen(text: &str, config: &Config) -> Scene {
    let text = run(text, config).text();
    let Parsed { scene, passed_on, .. } = parsed(str::from_utf8(&text).unwrap());
    let again = ugparse::write_with(&scene, &passed_on);
    let lines =
        |text: &[u8]| String::from_utf8_lossy(text).lines().map(str::to_owned).collect::<Vec<_>>();
    let differs = lines(&text).into_iter().zip(lines(&again)).find(|(a, b)| a != b);
    assert_eq!(differs, None, "what is written is read back");
    scene
}

/// What the program makes of a scene.
#[derive(Debug)]
pub struct Outcome {
    pub scene: Scene,
    pub passed_on: PassedOn,
    pub report: Report,
}

impl Outcome {
    pub fn text(&self) -> Vec<u8> {
        ugparse::write_with(&self.scene, &self.passed_on)
    }
}

pub fn run(text: &str, config: &Config) -> Outcome {
    try_run(text, config).unwrap_or_else(|message| panic!("{message}"))
}

/// Errors have their place in the text if they have one. In a scene without a camera the eye is at
/// the origin, unless the options say otherwise.
pub fn try_run(text: &str, config: &Config) -> Result<Outcome, String> {
    let source = Source::new("t.ug", text);
    let parsed = ugparse::read(&source, &Options::default(), config.camera.name.as_deref());
    let parsed = parsed.map_err(|error| error.to_string())?;
    let origin = parsed.scene.cameras.is_empty().then_some(DVec3::ZERO);
    let config = &Config { eye: config.eye.or(origin), ..config.clone() };
    let (mut scene, report) = uglorentz::apply(parsed.scene, config).map_err(|error| {
        let diagnostics = error.diagnostics(&source, &parsed.origins);
        diagnostics.map_or_else(|| error.words(), |diagnostics| diagnostics.to_string())
    })?;
    scene.head.record(Provenance { command: Some("uglorentz"), ..PROVENANCE });
    Ok(Outcome { scene, passed_on: parsed.passed_on, report })
}

/// The measurements of a scene as seen, as a file.
pub fn table(text: &str, config: &Config, table: Table) -> String {
    let Outcome { scene, .. } = run(text, config);
    let rows = uglorentz::measure(&scene, ugscene::eye(&scene, None), config.time);
    String::from_utf8(table.write(&scene, &rows)).unwrap()
}

pub fn parse(text: &str) -> Scene {
    parsed(text).scene
}

fn parsed(text: &str) -> Parsed {
    let parsed = ugparse::parse(&Source::new("test.ug", text), &Options::default());
    parsed.unwrap_or_else(|error| panic!("{error}"))
}

pub fn moving(beta: DVec3) -> Config {
    Config { velocity: Some(beta), ..Config::default() }
}

pub fn place(scene: &Scene, vertex: VertexId) -> DVec3 {
    scene.vertices[vertex.index()].position
}

pub fn find(scene: &Scene, name: &str) -> VertexId {
    VertexId::from_index(
        scene.vertices.iter().position(|v| scene.names.get(v.name) == name).unwrap(),
    )
}

/// Every edge of every face, how often it is walked each way: (low to high, high to low).
pub fn edges(scene: &Scene) -> BTreeMap<(VertexId, VertexId), (u32, u32)> {
    let mut edges: BTreeMap<_, (u32, u32)> = BTreeMap::new();
    for face in &scene.faces {
        for contour in scene.face_contours(face) {
            for (idx, &a) in contour.iter().enumerate() {
                let b = contour[(idx + 1) % contour.len()];
                let count = edges.entry((a.min(b), a.max(b))).or_default();
                if a < b { count.0 += 1 } else { count.1 += 1 }
            }
        }
    }
    edges
}

/// Twice the area of a face times its normal.
pub fn normal(scene: &Scene, face: &Face, positions: &[DVec3]) -> DVec3 {
    let area =
        |contour: &[VertexId]| ugscene::newell_normal(contour.iter().map(|c| positions[c.index()]));
    scene.face_contours(face).map(area).sum()
}

/// A sphere of `8 * 4^n` triangles with uneven radius.
pub fn rock(
    random: &mut Random,
    center: DVec3,
    radius: f64,
    n: u32,
) -> (Vec<DVec3>, Vec<Vec<usize>>) {
    let mut vertices = vec![DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z];
    let mut faces = Vec::new();
    for (x, y, z) in
        [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)]
    {
        faces.push(vec![x, y, z]);
    }
    for _ in 0..n {
        let mut middles = BTreeMap::new();
        let mut finer = Vec::new();
        for face in &faces {
            let mut middle = |a: usize, b: usize| {
                *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                    vertices.push((vertices[a] + vertices[b]).normalize());
                    vertices.len() - 1
                })
            };
            let (a, b, c) = (face[0], face[1], face[2]);
            let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
            finer.extend([vec![a, ab, ca], vec![ab, b, bc], vec![ca, bc, c], vec![ab, bc, ca]]);
        }
        faces = finer;
    }
    let vertices =
        vertices.into_iter().map(|p| center + p * radius * random.between(0.7, 1.0)).collect();
    (vertices, faces)
}

/// A prism with `n` sides: quadrilaterals and two polygons of `n` corners.
pub fn prism(
    random: &mut Random,
    center: DVec3,
    size: f64,
    n: usize,
) -> (Vec<DVec3>, Vec<Vec<usize>>) {
    let axis = random.direction();
    let (across, up) = axis.any_orthonormal_pair();
    let corner = |k: usize, height: f64| {
        let angle = std::f64::consts::TAU * k as f64 / n as f64;
        center + (across * libm::cos(angle) + up * libm::sin(angle) + axis * height) * size
    };
    let mut vertices: Vec<DVec3> = (0..n).map(|k| corner(k, -1.0)).collect();
    vertices.extend((0..n).map(|k| corner(k, 1.0)));
    let mut faces: Vec<Vec<usize>> =
        (0..n).map(|k| vec![k, (k + 1) % n, n + (k + 1) % n, n + k]).collect();
    faces.push((0..n).rev().collect());
    faces.push((n..2 * n).collect());
    (vertices, faces)
}

/// A tetrahedron.
pub fn tetrahedron(random: &mut Random, center: DVec3, size: f64) -> (Vec<DVec3>, Vec<Vec<usize>>) {
    let turn = glam::DQuat::from_axis_angle(random.direction(), random.between(0.0, 6.0));
    let corners = [
        DVec3::ONE,
        DVec3::new(1.0, -1.0, -1.0),
        DVec3::new(-1.0, 1.0, -1.0),
        DVec3::new(-1.0, -1.0, 1.0),
    ];
    let vertices = corners.iter().map(|&p| center + turn * p * size).collect();
    (vertices, vec![vec![0, 1, 2], vec![0, 3, 1], vec![0, 2, 3], vec![1, 3, 2]])
}
