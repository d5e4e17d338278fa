//! Round trips from a scene to a mesh and back.

use glam::DVec3;
use ugmesh::{Axis, Config, MeshFile, PROVENANCE, Size, Target};
use ugpipe::Words;
use ugscene::{ColorValue, Provenance};

use crate::common::{Corner, convert, parse, seen, statements, to_mesh, to_scene};

/// Colours that 8 bits represent exactly, coordinates that 32 bits represent exactly, corners with
/// and without their own colours.
const SCENE: &str = "{ a licence }
c_rgb red 1 0 0.2; c_rgb green 0 0.6 0.4; c_rgb blue 0 0 1;
v a 0 0 0; v b 1 0 0; v c 1 1 0.5; v d 0 1 0.5; v e 0.5 0.5 2; v f 7 7 7 blue;
f (a b e) red; f (b c e) green; f (c d e) red; f (d a e); f (d c b a) green; f (a e f) red;";

/// Every corner with a colour, white if none is given.
fn coloured(mut faces: Vec<Vec<Corner>>) -> Vec<Vec<Corner>> {
    faces
        .iter_mut()
        .flatten()
        .for_each(|corner| corner.rgba = Some(corner.rgba.unwrap_or([1.0; 4])));
    faces
}

fn assert_near(found: &[Vec<Corner>], expected: &[Vec<Corner>], tolerance: f64) {
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().flatten().zip(expected.iter().flatten()) {
        assert_eq!(found.position, expected.position);
        let (found, expected) = (found.rgba.expect("a colour"), expected.rgba.expect("a colour"));
        let worst = found.iter().zip(expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(worst <= tolerance, "{found:?} for {expected:?}");
    }
}

#[test]
fn faces_positions_and_colours_round_trip() {
    let expected = coloured(seen(&parse(SCENE.as_bytes())));
    for target in [Target::Obj, Target::Ply { is_ascii: true }, Target::Ply { is_ascii: false }] {
        let back = to_scene(&Config::default(), "<stdin>", to_mesh(target, SCENE.as_bytes()));
        assert_eq!(coloured(seen(&back)), expected, "{target:?}");
    }
    // glTF has only triangles, and linear colours in 32 bits: the square is triangulated, and
    // colours have an error of about 2^-24. Faces of one colour stand together.
    let triangles = SCENE.replace("f (d c b a) green", "f (d c b) green; f (b a d) green");
    let by_color = |faces: &[usize]| -> Vec<Vec<Corner>> {
        let all = coloured(seen(&parse(triangles.as_bytes())));
        faces.iter().map(|&row| all[row].clone()).collect()
    };
    let expected = by_color(&[0, 2, 6, 1, 4, 5, 3]);
    for target in [Target::Gltf, Target::Glb] {
        let back = to_scene(&Config::default(), "<stdin>", to_mesh(target, triangles.as_bytes()));
        assert_near(&coloured(seen(&back)), &expected, 1e-6);
        let cut = to_scene(&Config::default(), "<stdin>", to_mesh(target, SCENE.as_bytes()));
        assert_eq!(cut.faces.len(), 7, "{target:?}");
    }
}

#[test]
fn obj_round_trips_to_the_bit() {
    // 32-bit numbers, formatted as other programs do, and 64-bit ones.
    let numbers: Vec<f64> = (0..300u32)
        .map(|n| {
            let bits = n.wrapping_mul(2_654_435_761);
            let narrow = f32::from_bits((bits % 0x7f00_0000) | (bits & 0x8000_0000));
            if n % 3 == 0 { f64::from(narrow) * 1e-3 } else { f64::from(narrow) }
        })
        .collect();
    let vertices: String = numbers
        .chunks_exact(3)
        .enumerate()
        .map(|(row, p)| format!("v {} {} {} {} 0 0.25\n", p[0], p[1], p[2], row as f64 / 100.0))
        .collect();
    let faces: String =
        (1..=96).map(|row| format!("f {row} {} {} {}\n", row + 1, row + 2, row + 4)).collect();
    let obj = format!("{vertices}{faces}");
    let scene = convert(&Config::default(), "a.obj", obj.as_str()).unwrap();
    assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
    let back = String::from_utf8(to_mesh(Target::Obj, &scene.bytes)).unwrap();
    let without_head: String =
        back.lines().filter(|line| !line.starts_with('#')).map(|l| format!("{l}\n")).collect();
    assert_eq!(without_head, obj);
}

#[test]
fn normals_round_trip() {
    let text = "v a 0 0 0 0 0.6 0.8;\nv b 1 0 0 0 0.6 0.8;\nv c 0 1 0 1 0 0;\nf (a b c);\n";
    let expected = seen(&parse(text.as_bytes()));
    for target in [Target::Obj, Target::Ply { is_ascii: false }, Target::Gltf, Target::Glb] {
        let back = seen(&to_scene(&Config::default(), "<stdin>", to_mesh(target, text.as_bytes())));
        for (found, expected) in back[0].iter().zip(&expected[0]) {
            let (found, expected) = (found.normal.unwrap(), expected.normal.unwrap());
            let worst = found.iter().zip(expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(worst < 1e-7, "{target:?}: {found:?}");
        }
    }
    // OBJ supports faces with and without normals; the other formats have either normals for all
    // vertices or none.
    let some = text
        .replace("1 0 0;\nf", ";\nf")
        .replace("f (a b c)", "f (a b c); v d 1 1 1 0 0 1; f (a b d)");
    let obj = String::from_utf8(to_mesh(Target::Obj, some.as_bytes())).unwrap();
    assert!(obj.ends_with("f 1 2 3\nf 1//1 2//2 4//3\n"), "{obj}");
    let glb = convert(&Config { target: Target::Glb, ..Config::default() }, "a.ug", some).unwrap();
    assert_eq!(glb.notes, ["normals are left out: not every vertex has one"]);
}

#[test]
fn colours_of_faces_move_to_vertices() {
    let text = "c red 1 0; c pale 0.5 0 0.5; v a 0 0 0; v b 1 0 0; v c 0 1 0; v d 0 0 1; f (a b c) red; f (b a d) pale;";
    let obj = String::from_utf8(to_mesh(Target::Obj, text.as_bytes())).unwrap();
    // The up axis of OBJ is y.
    let expected = "v 0 0 0 1 0 0, v 1 0 0 1 0 0, v 0 0 -1 1 0 0, v 0 1 0 0.5 0.25 0.25, v 1 0 0 0.5 0.25 0.25, \
        v 0 0 0 0.5 0.25 0.25, usemtl red, f 1 2 3, usemtl pale, f 5 6 4, ";
    assert_eq!(obj.replace('\n', ", "), expected);
}

#[test]
fn holes_are_cut() {
    let text =
        "v a 0 0 0; v b 4 0 0; v c 4 4 0; v d 0 4 0; v e 1 1 0; v f 1 3 0; v g 3 3 0; v h 3 1 0;
        f (a b c d) (e f g h); f (a b c d); f (a b g d);";
    let faces =
        |target| seen(&to_scene(&Config::default(), "<stdin>", to_mesh(target, text.as_bytes())));
    for (target, n_faces) in
        [(Target::Obj, 10), (Target::Ply { is_ascii: false }, 10), (Target::Glb, 12)]
    {
        let faces = faces(target);
        assert_eq!(faces.len(), n_faces, "{target:?}");
        let area = |face: &Vec<Corner>| {
            ugscene::newell_normal(face.iter().map(|corner| corner.position.into())).z / 2.0
        };
        let areas: Vec<f64> = faces.iter().map(area).collect();
        assert!(areas.iter().all(|&area| area > 0.0), "{areas:?}");
        assert_eq!(areas.iter().sum::<f64>(), 12.0 + 16.0 + 12.0, "{target:?}");
    }
}

#[test]
fn ply_uses_float_where_it_is_exact() {
    #[track_caller]
    fn check(x: &str, expected: &str) {
        let text = format!("v a {x} 0 0; v b 1 0 0; v c 0 1 0; f (a b c);");
        for is_ascii in [false, true] {
            let ply = to_mesh(Target::Ply { is_ascii }, text.as_bytes());
            assert!(
                String::from_utf8_lossy(&ply).contains(&format!("property {expected} x\n")),
                "{x}"
            );
            assert_eq!(
                seen(&to_scene(&Config::default(), "<stdin>", ply)),
                seen(&parse(text.as_bytes()))
            );
        }
    }
    check("0.5", "float");
    check("0.1", "double");
    check("0.10000000149011612", "float");
    check("1e300", "double");
    let config = Config { target: Target::Glb, ..Config::default() };
    let error =
        convert(&config, "a.ug", "v a 1e300 0 0; v b 1 0 0; v c 0 1 0; f (a b c);").unwrap_err();
    assert_eq!(
        error.words(),
        "coordinates do not fit glTF; make the mesh smaller (-fit 1) or write PLY (-dt ply)"
    );
}

#[test]
fn transparency_round_trips_where_supported() {
    let text = "c glass 1 0 0 0.4; v a 0 0 0; v b 1 0 0; v c 0 1 0; f (a b c) glass;";
    for target in [Target::Ply { is_ascii: false }, Target::Glb] {
        let back = to_scene(&Config::default(), "<stdin>", to_mesh(target, text.as_bytes()));
        assert!(
            back.colors.iter().all(|color| (color.translucency - 0.4).abs() < 1e-6),
            "{target:?}"
        );
    }
    let obj = convert(&Config { target: Target::Obj, ..Config::default() }, "a.ug", text).unwrap();
    assert_eq!(obj.notes, ["OBJ has no transparent vertices: all are written as opaque"]);
}

#[test]
fn unsupported_parts_are_noted() {
    let text = "c bright 1.5 0 1; v a 0 0 0; v b 1 0 0; v c 0 1 0; f (a b c) bright; w (a b); l 0.5; l sun 1 0 0 1; cam;";
    let mesh = convert(&Config { target: Target::Obj, ..Config::default() }, "a.ug", text).unwrap();
    assert_eq!(
        mesh.notes,
        [
            "1 wire is left out",
            "2 lights are left out",
            "1 camera is left out",
            "1 colour brighter than 1 is clipped"
        ]
    );
}

/// The box that `-fit` and `--center` measure is that of the vertices written.
#[test]
fn vertices_of_wires_are_left_out_with_them() {
    let text = "v far 9 9 9; v a 0 0 0; v b 2 0 0; v on 5 5 5; v c 0 1 0; w (far a on); f (c b a);";
    for target in [Target::Obj, Target::Ply { is_ascii: true }, Target::Gltf] {
        let config =
            Config { target, size: Size::Fit(1.0), is_centered: true, ..Config::default() };
        let mesh = convert(&config, "a.ug", text).unwrap().bytes;
        let back = to_scene(&Config::default(), "<stdin>", mesh);
        assert_eq!(back.vertices.len(), 3, "{target:?}");
        let (low, high) = back.bounds().unwrap();
        assert!(
            (high - low).abs_diff_eq(DVec3::new(1.0, 0.5, 0.0), 1e-6),
            "{target:?} {low} {high}"
        );
        assert!((high + low).abs_diff_eq(DVec3::ZERO, 1e-6), "{target:?} {low} {high}");
    }
}

/// Cameras of glTF have single precision. Its JSON has no infinite numbers, and clipping distances
/// of 0 are not allowed.
#[test]
fn cameras_of_any_size_are_read_back() {
    let bodies = "v a 0 0 0; v b 1 0 0; v c 0 1 0; f (a b c);";
    for (distance, angle) in
        [("1e38", "-og"), ("1e38", "-va 40"), ("1e-42", "-og"), ("1e-42", "-va 1e-9")]
    {
        let film =
            if angle == "-og" { format!("-fs {distance} {distance}") } else { String::new() };
        let text = format!("{bodies} cam -ep 0 0 {distance} -vc 0 0 0 -ud 0 1 0 {angle} {film};");
        let config = Config { target: Target::Gltf, ..Config::default() };
        let mesh = convert(&config, "a.ug", text.clone()).unwrap().bytes;
        let document: serde_json::Value = serde_json::from_slice(&mesh).unwrap();
        let lens = &document["cameras"][0];
        let kind = lens["type"].as_str().unwrap_or_default();
        let numbers: Vec<_> =
            lens[kind].as_object().unwrap().values().map(|number| number.as_f64()).collect();
        assert_eq!(numbers.len(), 4, "{text}: {lens}");
        assert!(
            numbers.iter().all(|number| number.is_some_and(|number| number > 0.0)),
            "{text}: {lens}"
        );
        to_scene(&Config::default(), "<stdin>", mesh);
    }
}

#[test]
fn history_and_licence_are_kept() {
    let made = Provenance { command: Some("ugmesh -dt x"), ..PROVENANCE };
    let convert = |target, name, bytes: &[u8]| {
        let input = MeshFile { provenance: made, ..MeshFile::new(name, bytes) };
        ugmesh::run(&Config { target, ..Config::default() }, &input).unwrap().bytes
    };
    for target in [Target::Obj, Target::Ply { is_ascii: false }] {
        let mesh = convert(target, "a.ug", SCENE.as_bytes());
        let scene = parse(&convert(Target::Ug, "<stdin>", &mesh));
        let line = concat!(" ugmesh ", env!("CARGO_PKG_VERSION"), ": ugmesh -dt x ");
        assert_eq!(scene.head.comments, [" a licence ", line, line], "{target:?}");
    }
}

#[test]
fn meshes_convert_to_meshes() {
    let obj = "v 1 2 3\nv 4 5 6\nv 7 8 10\nf 1 2 3\n";
    let ply = |up| {
        let config = Config { target: Target::Ply { is_ascii: true }, up, ..Config::default() };
        let ply = String::from_utf8(convert(&config, "a.obj", obj).unwrap().bytes).unwrap();
        ply.split_once("end_header\n").unwrap().1.to_string()
    };
    assert_eq!(ply(None), "1 -3 2\n4 -6 5\n7 -10 8\n3 0 1 2\n");
    assert_eq!(ply(Some(Axis::X)), "1 2 3\n4 5 6\n7 8 10\n3 0 1 2\n");
}

#[test]
fn a_scene_as_seen_keeps_its_colours() {
    // HSV colours on vertices, as `ugdoppler` writes them.
    let text = "c a#1 1 30 1; v a 0 0 0 a#1; v b 1 0 0 a#1; v c 0 1 0 a#1; f (a b c) <0.5 0 0>;";
    let back = to_scene(&Config::default(), "<stdin>", to_mesh(Target::Obj, text.as_bytes()));
    assert_eq!(back.colors[0].value, ColorValue::Rgb([1.0, 0.5, 0.0]));
    assert_eq!(statements(&back).lines().count(), 5);
}

#[test]
fn a_scene_as_seen_is_exported_as_seen() {
    const SCENE: &str =
        "c green 1 546.1; v a 0 0 0 green 0 0 1; v b 1 0 0 green 0 0 1; v c 0 1 0 green 0 0 1;
        v d 0 0 5 0 0 1; v e 1 0 5 0 0 1; v f 0 1 5 0 0 1; f (a b c) <.5 0 0>; f (d e f);";
    let config = Config { target: Target::Ply { is_ascii: true }, ..Config::default() };
    let seen = "(ugstage 1 geometry as-seen eye 0 0 9 colors as-seen wavelengths law report)";
    let ply = convert(&config, "scene.ug", format!("{seen} {SCENE}")).unwrap();
    let text = String::from_utf8(ply.bytes).unwrap();
    // Hue 120, not 546.1 degrees.
    assert!(text.contains(" 0 255 0"), "{text}");
    assert!(text.contains("nx"), "{text}");
    // Normals of moving bodies are those of the seen shape, unless those of the shape at rest are
    // wanted.
    let tilted = format!("{seen} {}", SCENE.replace("green 0 0 1", "green 1 0 1"));
    let normals = |rest_normals| {
        let config = Config { target: Target::Obj, rest_normals, ..config.clone() };
        let text = String::from_utf8(convert(&config, "scene.ug", tilted.as_str()).unwrap().bytes)
            .unwrap();
        text.lines().filter(|line| line.starts_with("vn ")).map(str::to_owned).collect::<Vec<_>>()
    };
    // z of the scene is y of OBJ.
    assert_eq!(normals(true), [["vn 1 1 0"; 3], ["vn 0 1 0"; 3]].concat());
    let seen = normals(false);
    assert_eq!(seen[3..], ["vn 0 1 0"; 3]);
    assert!(seen[..3].iter().all(|line| line != "vn 1 1 0"), "{seen:?}");
}

#[test]
fn names_of_faces_and_colours_are_kept() {
    let text = "c_rgb red 1 0 0; c_rgb blue 0 0 1 0.5; v a 0 0 0; v b 1 0 0; v c 0 1 0; v d 1 1 0; v e 2 0 0;
        f hull (a b c) red; f (a c d) red; f hull (a d e) blue; f hull (c d e) red;";
    let obj = String::from_utf8(to_mesh(Target::Obj, text.as_bytes())).unwrap();
    let lines: Vec<&str> = obj.lines().filter(|line| line.starts_with(['g', 'u'])).collect();
    assert_eq!(lines, ["g hull", "usemtl red", "g default", "g hull", "usemtl blue", "usemtl red"]);
    let back = convert(&Config::default(), "a.obj", obj).unwrap();
    assert_eq!(back.warnings, [""; 0], "colours are those of the vertices");
    let faces = |bytes: &[u8]| -> Vec<String> {
        let scene = parse(bytes);
        let name =
            |face: &ugscene::Face| face.name.map_or("", |name| scene.names.get(name)).to_string();
        scene.faces.iter().map(name).collect()
    };
    assert_eq!(faces(&back.bytes), ["hull", "", "hull", "hull"]);

    let gltf = to_mesh(Target::Gltf, text.as_bytes());
    let document: serde_json::Value = serde_json::from_slice(&gltf).unwrap();
    assert_eq!([0, 1].map(|row| document["nodes"][row]["name"].as_str()), [Some("hull"), None]);
    let materials = document["materials"].as_array().unwrap();
    let named: Vec<_> =
        materials.iter().map(|one| (one["name"].as_str(), one["alphaMode"].as_str())).collect();
    assert_eq!(named, [(Some("red"), None), (Some("blue"), Some("BLEND"))]);
    let back = convert(&Config::default(), "a.gltf", gltf).unwrap();
    assert_eq!(faces(&back.bytes), ["hull", "hull", "hull", ""]);
}

#[test]
fn a_name_for_every_face_is_left_out() {
    let names = |count: usize| -> Vec<String> {
        let faces: String = (0..count).map(|row| format!("f n{row} (a b c);")).collect();
        let text = format!("v a 0 0 0; v b 1 0 0; v c 0 1 0; {faces}");
        convert(&Config { target: Target::Obj, ..Config::default() }, "a.ug", text).unwrap().notes
    };
    assert_eq!(names(256), [""; 0]);
    assert_eq!(names(257), ["names of faces and colours are left out: 257 are more than 256"]);
}

#[test]
fn the_brightest_light_has_a_colour() {
    let text = "c_xyz sun 1.7976931348623157e308 1.7976931348623157e308 1.7976931348623157e308;
        v a 0 0 0; v b 1 0 0; v c 0 1 0; f (a b c) sun;";
    let obj = String::from_utf8(to_mesh(Target::Obj, text.as_bytes())).unwrap();
    assert!(obj.contains("v 0 0 0 1 1 1\n"), "{obj}");
}

/// A scene with names and comments that readers of other programs trip over.
const HOSTILE: &str = "{ a\u{c}b\u{2028}c\u{2029}d\u{85}e\u{fffe}f\u{ffff}\u{fdd0} \\\n  next \\ }
c_rgb red#2 1 0 0.2; c_rgb green_2 0 0.6 0.4;
v a 0 0 0; v b 1 0 0; v c 1 1 0.5; v d 0 1 0.5;
f #left (a b c) red#2; f right:wing (a c d) green_2;";

/// Lines by the longest list of line ends that readers have (that of Python's `splitlines`).
fn all_lines(text: &str) -> Vec<&str> {
    const ENDS: [char; 10] = [
        '\n', '\r', '\u{b}', '\u{c}', '\u{1c}', '\u{1d}', '\u{1e}', '\u{85}', '\u{2028}',
        '\u{2029}',
    ];
    text.split(ENDS).collect()
}

/// What is written is read by other readers: tobj, ply-rs, and one that ends lines wherever any
/// reader does.
#[test]
fn other_readers_read_what_is_written() {
    let obj = to_mesh(Target::Obj, HOSTILE.as_bytes());
    let text = String::from_utf8(obj.clone()).unwrap();
    let no_materials = |_: &std::path::Path| {
        tobj::MTLLoadResult::Ok((Vec::new(), std::collections::HashMap::default()))
    };
    let (models, _) =
        tobj::load_obj_buf(&mut obj.as_slice(), &tobj::LoadOptions::default(), no_materials)
            .unwrap();
    assert_eq!(models.len(), 2, "{text}");
    assert_eq!(models.iter().map(|model| model.mesh.indices.len()).sum::<usize>(), 6);
    assert!(models[0].mesh.positions.starts_with(&[0.0, 0.0, 0.0, 1.0]));
    for line in all_lines(&text) {
        let keyword = line.split(' ').next().unwrap_or_default();
        assert!(
            ["#", "v", "g", "usemtl", "f", ""].contains(&keyword) && !line.ends_with('\\'),
            "{line:?}"
        );
    }
    for is_ascii in [true, false] {
        let ply = to_mesh(Target::Ply { is_ascii }, HOSTILE.as_bytes());
        let read = ply_rs_bw::parser::Parser::<ply_rs_bw::ply::DefaultElement>::new()
            .read_ply(&mut std::io::Cursor::new(&ply))
            .unwrap();
        assert_eq!([read.payload["vertex"].len(), read.payload["face"].len()], [6, 2]);
        let header = String::from_utf8_lossy(&ply).into_owned();
        let header = header.split("end_header").next().unwrap();
        for line in all_lines(header) {
            let keyword = line.split(' ').next().unwrap_or_default();
            assert!(
                ["ply", "format", "comment", "element", "property", ""].contains(&keyword),
                "{line:?}"
            );
        }
    }
}
