//! Tests of the program: usage, streams, files, exit status.

use std::fs;

use ugtesting::run::BuiltProgram;

const UGMESH: BuiltProgram = BuiltProgram::new(env!("CARGO_BIN_EXE_ugmesh"));
const OBJ: &str = "mtllib cube.mtl\nv 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 1 1 3\nusemtl red\nf 4 3 2 1\nf 1 2 5\n\
                   usemtl green\nf 2 3 5\nf 3 4 5\nf 4 1 5\n";
const MTL: &str = "newmtl red\nKd 1 0 0\nnewmtl green\nKd 0 1 0\n";

#[test]
fn a_mesh_goes_through_a_pipe_and_back() {
    let folder = tempfile::tempdir().unwrap();
    let ugmesh = UGMESH.in_folder(&folder);
    fs::write(folder.path().join("cube.obj"), OBJ).unwrap();
    fs::write(folder.path().join("cube.mtl"), MTL).unwrap();

    assert_eq!(ugmesh.notes("-center -fit 1 -name cube cube.obj", ""), "");
    let text = ugmesh.text("-center -fit 1 -name cube cube.obj", "");
    let version = env!("CARGO_PKG_VERSION");
    let head = format!("{{ ugmesh {version}: ugmesh --center -fit 1 --name cube }}\n");
    let mut lines = text.split_inclusive('\n');
    for name in ["cube.obj", "cube.mtl"] {
        let read = lines.next().unwrap();
        assert!(
            read.starts_with("{ SHA-256 ") && read.ends_with(&format!(" {name} }}\n")),
            "{read}"
        );
    }
    assert_eq!(lines.next(), Some(&*head), "{text}");
    assert!(
        text.contains("c_rgb cube_red 1 0 0;\n")
            && text.contains("f (cube_v1 cube_v2 cube_v5) cube_red;\n"),
        "{text}"
    );

    let ply = ugmesh.output("-dt ply", &text);
    assert!(ply.starts_with(b"ply\nformat binary_little_endian 1.0\n"));

    let files =
        [("out.obj", "", 5), ("out.ply", "-ascii", 5), ("out.gltf", "", 6), ("out.glb", "", 6)];
    for (name, options, expected) in files {
        assert!(ugmesh.output(&format!("{options} -fo {name}"), &text).is_empty());
        let back = ugmesh.text(&format!("-fi {name}"), "");
        assert_eq!(back.lines().filter(|line| line.starts_with("f ")).count(), expected, "{name}");
    }
    UGMESH.ends_at_a_closed_pipe("", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
}

#[test]
fn a_stage_is_written_to_scenes_only() {
    let text = UGMESH.text("-if obj --stage", &OBJ[16..]);
    let count = |word: &str| text.lines().filter(|line| line.starts_with(word)).count();
    assert_eq!((count("cam -ep "), count("l ")), (1, 2), "{text}");
    // Other formats have no such statements.
    let message = "ugmesh: error: -stage writes statements of UniGrafix; leave out -dt and the ending of -fo\n";
    UGMESH.refuses("-dt obj --stage", &text, 2, message);
}

#[test]
fn missing_materials_are_a_warning() {
    assert_eq!(
        UGMESH.notes("-if obj", OBJ),
        "ugmesh: warning: colours are missing: cannot read `cube.mtl`: standard input has no folder; name the mesh on \
         the command line\nugmesh: warning: materials without colour: `green`, `red`\n"
    );
}

/// Names of files that differ in case alone are found, also those of folders, but none outside the
/// folder of the mesh.
#[test]
fn files_of_other_case_are_found() {
    let folder = tempfile::tempdir().unwrap();
    let ugmesh = UGMESH.in_folder(&folder);
    let path = |name: &str| folder.path().join(name);
    fs::create_dir_all(path("mesh/Parts")).unwrap();
    fs::write(path("mesh/cube.obj"), OBJ.replace("cube.mtl", "parts/CUBE.mtl")).unwrap();
    fs::write(path("mesh/Parts/cube.MTL"), MTL).unwrap();
    let note = "ugmesh: note: `Parts/cube.MTL` is read in place of `parts/CUBE.mtl`\n";
    assert_eq!(ugmesh.notes("mesh/cube.obj", ""), note);
    assert!(ugmesh.text("-qt mesh/cube.obj", "").contains("c_rgb red 1 0 0;"));
    fs::write(path("secret.mtl"), MTL).unwrap();
    fs::write(path("mesh/cube.obj"), OBJ.replace("cube.mtl", "../SECRET.mtl")).unwrap();
    let notes = ugmesh.notes("mesh/cube.obj", "");
    assert!(notes.contains("colours are missing") && !notes.contains("secret.mtl"), "{notes}");
}

/// JSON is a glTF document wherever its keys are, and never a scene.
#[test]
fn json_is_not_a_scene() {
    let late = format!("{{\"extras\": \"{}\", \"asset\": {{}}}}", "x".repeat(70_000));
    let message = "cannot read `<stdin>` as glTF: this is JSON, but not a glTF document";
    for json in [late.as_str(), "{\"a\": {}}"] {
        UGMESH.refuses("", json, 1, message);
        UGMESH.refuses("-dt obj", json, 1, message);
    }
}

#[test]
fn scenes_may_include_files() {
    let folder = tempfile::tempdir().unwrap();
    let ugmesh = UGMESH.in_folder(&folder);
    fs::write(folder.path().join("corners.ug"), "v a 0 0 0; v b 1 0 0; v c 0 1 0;").unwrap();
    fs::write(folder.path().join("scene.ug"), "include corners.ug; f (a b c);").unwrap();
    assert_eq!(
        ugmesh.text("-dt obj scene.ug", "").lines().filter(|line| line.starts_with("v ")).count(),
        3
    );
    fs::write(folder.path().join("scene.ug"), "execute corners.ug; f (a b c);").unwrap();
    ugmesh.refuses("-dt obj scene.ug", "", 1, "program `corners.ug` is not run");
}

#[test]
fn bad_usage_is_status_2() {
    let ending = "the extension of `x.stl` is none of the formats ug, obj, ply, gltf, glb and vtp; name one with -dt";
    for (args, message) in [
        ("-scale 0", "sizes (-scale, -fit) must be above 0"),
        ("-fit -1", "sizes (-scale, -fit) must be above 0"),
        ("-scale 2 -fit 1", "cannot be given together"),
        ("-scale nan", "not a finite number"),
        ("-dt stl", "`stl` is not valid for `-dt`: none of the formats ug, obj, "),
        ("-ascii", "-ascii applies only to PLY; add -dt ply"),
        ("-fo x.stl", ending),
        ("-name 'a b'", "a name consists of letters, digits and _, and begins with a letter"),
        ("-up w", "`w` is not valid for `-up`: none of the axes x, y, z"),
        ("-if ug", "the input is already a UniGrafix scene; choose an output format with -dt"),
    ] {
        UGMESH.refuses(args, "v a 0 0 0;", 2, message);
    }
}

#[test]
fn bad_meshes_are_status_1_and_write_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let refused = "`<stdin>` as OBJ: line 2: a face refers to vertex `2`";
    for (args, input, message) in [
        ("-fo out.ug", "v 0 0 0\nf 1 2 3\n", refused),
        ("-fo out.glb", "v a 0 0 0;\nf (a b c);\n", "vertex `b` is not defined"),
        ("-fo out.ug", "hello", "cannot detect the format of `<stdin>`; give it with -if"),
    ] {
        UGMESH.in_folder(&folder).refuses(args, input, 1, message);
        assert_eq!(fs::read_dir(&folder).unwrap().count(), 0, "{input}");
    }
}
