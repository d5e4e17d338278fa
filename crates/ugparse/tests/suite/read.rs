//! Meshes as scenes, bent faces, and histories.

use std::path::Path;

use glam::DVec3;
use ugparse::{Diagnostics, Options, Parsed, Source, read};
use ugphysics::Velocity;
use ugscene::{GeometryStage, Provenance, Scene, SeenGeometry, Stage};

fn read_mesh(name: &str, text: &str) -> Result<Parsed, Diagnostics> {
    let options = Options::default();
    let source = ugparse::include(Source::new(name, text), &options, |request| {
        assert_eq!(request.path, Path::new("folder/a.mtl"));
        Ok(b"newmtl red\nKd 1 0 0\n".to_vec())
    })?;
    ugparse::parse(&source, &options)
}

/// Three corners of a square.
const CORNERS: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\n";

#[test]
fn a_mesh_is_a_scene() {
    let text = format!("mtllib a.mtl\n{CORNERS}v 0 1 0\nusemtl red\nf 1 2 3 4\n");
    let parsed = read_mesh("folder/square.obj", &text).unwrap();
    assert!(parsed.warnings.is_empty(), "{}", parsed.warnings);
    let out = String::from_utf8(ugparse::write(&parsed.scene)).unwrap();
    assert!(out.contains("c_rgb red 1 0 0;") && out.contains("v v3 1 0 1;"), "{out}");
    assert!(out.ends_with("f (v1 v2 v3 v4) red;\n"), "{out}");
}

/// An included mesh is the scene that it is by itself, with its textures, also in a definition.
#[test]
fn meshes_are_included() {
    let options = Options::default();
    let crate_folder = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenes"));
    let parsed = |name: &str, text: &str| {
        let source = ugparse::include(Source::new(name, text), &options, |request| {
            let name = request.path.file_name().unwrap_or_default();
            assert_eq!(request.path, Path::new("meshes").join(name));
            std::fs::read(crate_folder.join(name)).map_err(ugparse::RequestError::System)
        })?;
        ugparse::parse(&source, &options)
    };
    let mesh = std::fs::read_to_string(crate_folder.join("crate.gltf")).unwrap();
    let alone = ugparse::write(&parsed("meshes/crate.gltf", &mesh).unwrap().scene);
    let included = parsed("scene.ug", "include \"meshes/crate.gltf\" ;").unwrap().scene;
    assert_eq!(String::from_utf8(ugparse::write(&included)), String::from_utf8(alone));
    let twice = "def crate ; include \"meshes/crate.gltf\" ; end ; i (crate) ; i (crate -tx 3) ;";
    let twice = parsed("scene.ug", twice).unwrap().scene;
    assert_eq!(
        [twice.faces.len(), twice.vertices.len()],
        [included.faces.len(), included.vertices.len()].map(|n| 2 * n)
    );
    assert!(included.faces.len() >= 6 && included.drawn_texture_name().is_some());
    // Lines of an included mesh are not quoted.
    let source = Source::new("scene.ug", "include a.obj ;");
    let error = ugparse::include(source, &options, |_| Ok(b"v 0 0 0\nf 1 2 secret\n".to_vec()))
        .unwrap_err()
        .to_string();
    assert!(
        error.contains("file `a.obj` is not UniGrafix") && !error.contains("secret"),
        "{error}"
    );
}

#[test]
fn messages_have_the_lines_of_the_mesh() {
    let check = |text: &str, expected: &str| {
        let shown = match read_mesh("square.obj", text) {
            Ok(parsed) => parsed.warnings.to_string(),
            Err(findings) => findings.to_string(),
        };
        // The carriage return is shown as a blank.
        assert_eq!(shown.replace(" \n", "\n"), expected);
    };
    for end in ["\n", "\r\n"] {
        let bent = format!("{CORNERS}v 0 1 .5\nf 1 2 3\nf 1 2 3 4\n").replace('\n', end);
        check(
            &bent,
            "warning: face is not flat\n --> square.obj:6:1\n  |\n6 | f 1 2 3 4\n  | ^ a corner is off by 7.9e-2 of its size\n  |\n\
             help: cut it into triangles: it is drawn as triangles, perhaps not as those that are meant",
        );
    }
    check(
        &format!("{CORNERS}f 1 2 7\n"),
        "error: cannot read this as OBJ: a face refers to vertex `7`, but there are 3 before it\n \
         --> square.obj:4:1\n  |\n4 | f 1 2 7\n  | ^^^^^^^",
    );
    check(
        "# 7 \"other\"\nv 0 0 0\n",
        "error: cannot read this as OBJ: the mesh has no faces, only 1 point; make a surface of the \
         cloud first\n--> square.obj",
    );
}

/// The camera of an included mesh is used if the scene has none, and its lights always; as a mesh
/// by itself it says so.
#[test]
fn cameras_of_meshes_are_used_if_the_scene_has_none() {
    const MESH: &str = r#"{"scenes":[{"nodes":[0,1]}],"nodes":[
        {"camera":0,"name":"own"},{"extensions":{"KHR_lights_punctual":{"light":0}}}],
        "cameras":[{"type":"perspective","perspective":{"yfov":0.5,"znear":0.1}}],
        "extensions":{"KHR_lights_punctual":{"lights":[{"type":"directional"}]}},
        "asset":{"version":"2.0"}}"#;
    let parsed = |name: &str, text: &str| {
        let options = Options::default();
        let load = |_: &ugparse::Request<'_>| Ok(MESH.as_bytes().to_vec());
        ugparse::parse(
            &ugparse::include(Source::new(name, text), &options, load).unwrap(),
            &options,
        )
        .unwrap()
    };
    for (text, expected) in [
        ("include car.gltf;", &["own"][..]),
        ("include car.gltf; cam main;", &["main"]),
        ("def car; include car.gltf; end; i (car); cam main;", &["main"]),
        ("def car; include car.gltf; end; i (car);", &["car:own"]),
    ] {
        let scene = parsed("a.ug", text).scene;
        let names = scene.cameras.iter().map(|it| scene.names.get(it.name.unwrap()));
        assert_eq!(names.collect::<Vec<_>>(), expected, "{text}");
        assert_eq!(scene.lights.len(), 1, "{text}");
    }
    let shown = parsed("car.gltf", MESH).warnings.to_string();
    assert!(shown.contains("note: the view is that of the camera `own` of the file"), "{shown}");
}

fn read_text(text: &str) -> Parsed {
    read(&Source::new("t.ug", text), &Options::default(), None).unwrap()
}

/// A square of side 1 whose corners are alternately above and below its plane by `d`.
fn square(d: f64, rest: &str) -> String {
    format!("v a 0 0 {d}; v b 1 0 -{d}; v c 1 1 {d}; v e 0 1 -{d}; {rest}")
}

#[test]
fn bent_faces_become_triangles() {
    let check = |d: f64, n_faces: usize, n_warnings: usize| {
        let parsed = read_text(&square(d, "f (a b c e);"));
        assert_eq!(
            (parsed.scene.faces.len(), parsed.warnings.list.len()),
            (n_faces, n_warnings),
            "{d}"
        );
        assert!(parsed.scene.faces.iter().all(|face| parsed.origins.face(face).is_some()));
    };
    // Its size is the root of 2, almost.
    check(0.0, 1, 0);
    check(0.99e-6 * 2f64.sqrt(), 1, 0);
    check(1.01e-6 * 2f64.sqrt(), 2, 0);
    check(0.99e-3 * 2f64.sqrt(), 2, 0);
    check(1.01e-3 * 2f64.sqrt(), 2, 1);
}

#[test]
fn triangles_keep_what_the_face_has() {
    let rest = "c red 1 0; surf s 1 0 0;\n{ first } f (a b c);\n{ bent }\nf x (a b c e) red s <.5 0 0>; { behind }\n\
                { last }\nf (a c e);";
    let parsed = read_text(&square(0.25, rest));
    let out = String::from_utf8(ugparse::write_with(&parsed.scene, &parsed.passed_on)).unwrap();
    let lines: Vec<&str> = out.lines().skip_while(|line| !line.starts_with("{ first")).collect();
    let [first, f, bent, one, two, last, g] = lines[..] else { panic!("{out}") };
    assert_eq!(
        [first, f, bent, last, g],
        ["{ first }", "f (a b c);", "{ bent }", "{ last }", "f (a c e);"]
    );
    assert!(one.starts_with("f x (") && one.ends_with(") red s <0.5 0 0>;"), "{out}");
    assert!(two.starts_with("f x (") && two.ends_with(") red s <0.5 0 0>; { behind }"), "{out}");
    assert_eq!(one.len() + 11, two.len());
    let lines = parsed.scene.faces.iter().map(|face| parsed.origins.face(face).unwrap());
    assert!(lines.eq([0, 1, 1, 2].map(|row| parsed.origins.faces[row])));
}

#[test]
fn faces_with_holes_are_cut_and_what_was_seen_stays() {
    let hole = "v h .4 .4 0; v i .6 .4 0; v j .5 .6 0; f (a b c e) (h i j);";
    assert_eq!(read_text(&square(0.25, hole)).scene.faces.len(), 7);
    let seen = format!("(ugstage 1 geometry as-seen eye 0 0 0) {}", square(0.25, "f (a b c e);"));
    let parsed = read_text(&seen);
    assert_eq!((parsed.scene.faces.len(), parsed.warnings.list.len()), (1, 0));
}

#[test]
fn the_output_of_a_pipe_is_known_by_its_history_and_its_stage() {
    let is_of_pipe = |scene: &Scene| ugparse::comes_through_a_pipe(&ugparse::write(scene));

    let mut scene = Scene::default();
    scene.head.comments.push(" A licence: free for all ".to_string());
    assert!(!is_of_pipe(&scene) && !ugparse::comes_through_a_pipe(b"{"));
    scene.stage.geometry = GeometryStage::AsSeen(SeenGeometry {
        eye: DVec3::ZERO,
        time: 0.0,
        camera_velocity: Velocity::ZERO,
        contraction: true,
        flight_time: true,
        is_whole: false,
    });
    assert!(!is_of_pipe(&scene));
    scene.head.record(Provenance {
        program: "ugdoppler",
        version: "0.1.0",
        command: Some("ugdoppler"),
        ..Provenance::default()
    });
    assert!(is_of_pipe(&scene));
    // A mesh that was converted, which somebody may have changed.
    scene.stage = Stage { mixtures: scene.stage.mixtures, ..Stage::default() };
    assert!(!is_of_pipe(&scene));
}
