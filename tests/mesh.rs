//! Meshes are drawn without any option for the camera: in every format, of any size, at any place
//! and any speed they fill between a tenth and nine tenths of the picture and touch no edge.
use std::fmt::Write;

use glam::DVec3;
use ugmesh::{MeshFile, MeshFormat, Target};
use ugparse::{Options, Source};
use ugpipe::Words;
use ugscene::Scene;
use ugtests::picture::{Picture, decode};

/// A body with a knob, so that no side looks like another: vertices on rings around y, which is up
/// in OBJ and glTF, and triangles.
fn blob(size: f64, place: DVec3) -> (Vec<DVec3>, Vec<[usize; 3]>) {
    const RINGS: usize = 8;
    const SECTORS: usize = 12;
    let mut vertices = Vec::new();
    for ring in 0..=RINGS {
        for sector in 0..SECTORS {
            let (polar, azimuth) =
                (180.0 * ring as f64 / RINGS as f64, 360.0 * sector as f64 / SECTORS as f64);
            let (sin, cos) = (libm::sin(polar.to_radians()), libm::cos(polar.to_radians()));
            let x = sin * libm::cos(azimuth.to_radians());
            let z = sin * libm::sin(azimuth.to_radians());
            let knob = if ring == 2 && sector == 1 { 1.6 } else { 1.0 };
            vertices.push(place + size * knob * DVec3::new(x, 0.8 * cos, 1.2 * z));
        }
    }
    let mut triangles = Vec::new();
    for ring in 0..RINGS {
        for sector in 0..SECTORS {
            let at = |ring: usize, sector: usize| ring * SECTORS + sector % SECTORS;
            let (a, b) = (at(ring, sector), at(ring, sector + 1));
            let (c, d) = (at(ring + 1, sector + 1), at(ring + 1, sector));
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    (vertices, triangles)
}

fn obj(size: f64, place: DVec3) -> Vec<u8> {
    let (vertices, triangles) = blob(size, place);
    let mut text = String::new();
    vertices.iter().for_each(|p| writeln!(text, "v {} {} {}", p.x, p.y, p.z).unwrap());
    triangles
        .iter()
        .for_each(|[a, b, c]| writeln!(text, "f {} {} {}", a + 1, b + 1, c + 1).unwrap());
    text.into_bytes()
}

fn off(size: f64, place: DVec3) -> Vec<u8> {
    let (vertices, triangles) = blob(size, place);
    let mut text = format!("OFF\n{} {} 0\n", vertices.len(), triangles.len());
    vertices.iter().for_each(|p| writeln!(text, "{} {} {}", p.x, p.y, p.z).unwrap());
    triangles.iter().for_each(|[a, b, c]| writeln!(text, "3 {a} {b} {c}").unwrap());
    text.into_bytes()
}

fn stl(size: f64, place: DVec3) -> Vec<u8> {
    let (vertices, triangles) = blob(size, place);
    let mut text = "solid blob\n".to_owned();
    for corners in triangles {
        text.push_str("facet normal 0 0 0\nouter loop\n");
        corners.map(|row| vertices[row]).iter().for_each(|p| {
            writeln!(text, "vertex {} {} {}", p.x, p.y, p.z).unwrap();
        });
        text.push_str("endloop\nendfacet\n");
    }
    text += "endsolid blob\n";
    text.into_bytes()
}

/// The scene that `ugmesh` makes of a mesh.
fn converted(mesh: &[u8], format: MeshFormat, target: Target, stage: bool) -> Vec<u8> {
    let config =
        ugmesh::Config { format: Some(format), target, stage, ..ugmesh::Config::default() };
    ugmesh::run(&config, &MeshFile::new("blob", mesh)).unwrap().bytes
}

fn scene(text: &[u8]) -> Scene {
    let parsed = ugparse::read(&Source::new("blob.ug", text), &Options::default(), None);
    parsed.unwrap_or_else(|findings| panic!("{findings}")).scene
}

/// `uglorentz -vel … --keep-in-view`, without the camera of a test.
fn as_seen(text: &[u8], velocity: DVec3) -> Vec<u8> {
    let config = uglorentz::Config {
        velocity: Some(velocity),
        in_place: true,
        ..uglorentz::Config::default()
    };
    let (seen, report) = uglorentz::apply(scene(text), &config).unwrap();
    assert_eq!(report.notes().len(), 1, "{:?}", report.notes());
    ugparse::write(&seen)
}

/// The picture, and notes about a camera.
fn drawn(text: &[u8], size: [u32; 2]) -> (Picture, Vec<String>) {
    let mut config = ugrainbow::Config::default();
    (config.picture.size, config.picture.samples) = (size, 1);
    let picture = ugrainbow::run(&config, &Source::new("blob.ug", text)).unwrap();
    (
        decode(&picture.bytes),
        picture.notes.iter().map(Words::words).filter(|note| note.contains("camera")).collect(),
    )
}

/// Checks the part of the picture's sides between the outermost pixels that are not background.
#[track_caller]
fn check_fill(name: &str, picture: &Picture) {
    let (width, height) = picture.dimensions();
    let lit = picture.enumerate_pixels().filter(|(_, _, pixel)| pixel.0[..3] != [0; 3]);
    let (mut low, mut high) = ([width, height], [0, 0]);
    for (x, y, _) in lit {
        (low, high) = ([low[0].min(x), low[1].min(y)], [high[0].max(x), high[1].max(y)]);
    }
    let is_inside = low[0] > 0 && low[1] > 0 && high[0] + 1 < width && high[1] + 1 < height;
    assert!(is_inside && low[0] <= high[0], "{name}: from {low:?} to {high:?} touches an edge");
    let part = |axis: usize, side: u32| f64::from(high[axis] + 1 - low[axis]) / f64::from(side);
    let filled = part(0, width).max(part(1, height));
    assert!((0.1..=0.9).contains(&filled), "{name}: fills {filled:.3}");
}

const SIZE: [u32; 2] = [160, 120];

#[test]
fn every_format_is_drawn_at_once() {
    let place = DVec3::new(3.0, -7.0, 40.0);
    let original = obj(0.1, place);
    let meshes = [
        ("OBJ", MeshFormat::Obj, original.clone()),
        (
            "PLY",
            MeshFormat::Ply,
            converted(&original, MeshFormat::Obj, Target::Ply { is_ascii: false }, false),
        ),
        ("STL", MeshFormat::Stl, stl(0.1, place)),
        ("OFF", MeshFormat::Off, off(0.1, place)),
        ("glTF", MeshFormat::Gltf, converted(&original, MeshFormat::Obj, Target::Gltf, false)),
    ];
    for (name, format, mesh) in meshes {
        let text = converted(&mesh, format, Target::Ug, false);
        let (at_rest, notes) = drawn(&text, SIZE);
        assert!(
            notes.len() == 1 && notes[0].starts_with("no camera in the scene: seen as with -ep "),
            "{notes:?}"
        );
        check_fill(&format!("{name} at rest"), &at_rest);
        for velocity in [DVec3::X, DVec3::NEG_Y, DVec3::Z].map(|axis| 0.9 * axis) {
            // The camera is in the scene now, so the note comes once in a pipe.
            let (moving, notes) = drawn(&as_seen(&text, velocity), SIZE);
            assert_eq!(notes, [""; 0]);
            check_fill(&format!("{name} at {velocity}"), &moving);
        }
    }
}

/// A small triangle of a body at 0.8c and 0.9c, with the normal of its plane at the corners.
#[test]
fn exported_normals_are_those_of_the_seen_shape() {
    let text = "v a 3 5 1 .6 -.64 .48; v b 3.00064 5.0006 1 .6 -.64 .48; v c 3 5.00048 1.00064 .6 -.64 .48; f (a b c);
                cam -ep 0 0 0 -vc 0 9 0;";
    for velocity in [DVec3::new(0.8, 0.0, 0.0), DVec3::new(-0.3, 0.6, 0.6)] {
        let config = uglorentz::Config {
            velocity: Some(velocity),
            in_place: true,
            pieces: uglorentz::Pieces::PerEdge(1),
            ..uglorentz::Config::default()
        };
        let (seen, _) = uglorentz::apply(scene(text.as_bytes()), &config).unwrap();
        let seen = ugparse::write(&seen);
        let obj = String::from_utf8(converted(&seen, MeshFormat::Ug, Target::Obj, false)).unwrap();
        let rows = |word: &str| -> Vec<DVec3> {
            let numbers =
                |line: &str| line.split(' ').map(|x| x.parse().unwrap()).collect::<Vec<f64>>();
            obj.lines()
                .filter_map(|line| line.strip_prefix(word))
                .map(|line| DVec3::from_slice(&numbers(line)))
                .collect()
        };
        let (corners, normals) = (rows("v "), rows("vn "));
        let plane = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize();
        assert_eq!((corners.len(), normals.len()), (3, 3));
        for normal in normals {
            // The triangle is 1e-4 of its distance, so that is how far it is bent.
            assert!(normal.normalize().dot(plane) > 1.0 - 1e-6, "{velocity}: {normal} {plane}");
        }
    }
}

#[test]
fn gltf_has_the_camera_of_the_scene() {
    let scene = "v a 0 9 0; v b 1 9 0; v c 0 9 1; f (a b c); cam -ep 1 2 3 -vc 1 7 3 -va 60 40;";
    let file: serde_json::Value =
        serde_json::from_slice(&converted(scene.as_bytes(), MeshFormat::Ug, Target::Gltf, false))
            .unwrap();
    let lens = &file["cameras"][0]["perspective"];
    let near = |value: &serde_json::Value, expected: f64| {
        (value.as_f64().unwrap() - expected).abs() < 1e-6
    };
    // A picture of 4 to 3 that shows at least the angles of the scene.
    let down = 2.0 * libm::atan(libm::tan(30f64.to_radians()) * 3.0 / 4.0);
    assert!(near(&lens["yfov"], down) && near(&lens["aspectRatio"], 4.0 / 3.0), "{lens}");
    assert_eq!(file["scenes"][0]["nodes"], serde_json::json!([0, 1]));
    // y of the scene is -z: the camera looks along it, as cameras of glTF do, from 1 3 -2.
    let matrix = file["nodes"][1]["matrix"].as_array().unwrap();
    let expected = [1., 0., 0., 0., 0., 1., 0., 0., 0., 0., 1., 0., 1., 3., -2., 1.];
    assert!(
        matrix.iter().zip(expected).all(|(value, expected)| near(value, expected)),
        "{matrix:?}"
    );
    assert_eq!(file["nodes"][1]["camera"], 0);
}

#[test]
fn vtk_files_have_what_is_known_of_the_light() {
    let text = converted(&obj(1.0, DVec3::new(1.0, 5.0, 2.0)), MeshFormat::Obj, Target::Ug, false);
    let seen = as_seen(&text, DVec3::new(0.6, 0.2, 0.0));
    let file = |scene: &[u8]| {
        String::from_utf8(converted(scene, MeshFormat::Ug, Target::Vtp, false)).unwrap()
    };
    let arrays = |file: &str| -> Vec<String> {
        file.lines()
            .filter(|line| line.starts_with("<DataArray") && !line.contains("normals"))
            .map(str::to_owned)
            .collect()
    };
    // The numbers of `uglorentz -at`, of the same vertices and faces.
    let parsed = scene(&seen);
    let rows = uglorentz::measure(&parsed, ugscene::eye(&parsed, None), 0.0);
    let expected = String::from_utf8(uglorentz::Table::Vtp.write(&parsed, &rows)).unwrap();
    let (found, expected) = (arrays(&file(&seen)), arrays(&expected));
    assert!(found == expected && found.len() >= 9, "{} {}", found.len(), expected.len());
    // A scene at rest has velocities only.
    let at_rest = file(&text);
    assert!(at_rest.contains("\"velocity\"") && !at_rest.contains("doppler"));
}

#[test]
fn a_stage_in_the_scene_is_the_one_of_a_scene_without() {
    let mesh = obj(0.2, DVec3::ONE);
    let [bare, staged] =
        [false, true].map(|stage| converted(&mesh, MeshFormat::Obj, Target::Ug, stage));
    let lines = String::from_utf8(staged.clone()).unwrap();
    let count = |word: &str| lines.lines().filter(|line| line.starts_with(word)).count();
    assert_eq!((count("l "), count("cam ")), (2, 1), "{lines}");
    let ((expected, _), (actual, notes)) = (drawn(&bare, SIZE), drawn(&staged, SIZE));
    assert_eq!(notes, [""; 0]);
    ugtests::picture::assert_same("mesh-with-a-stage", &expected, &actual, 1);
}
