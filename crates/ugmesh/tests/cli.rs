//! Tests of the program: usage, streams, files, exit status.

use std::fs;
use std::io::Write;
use std::path::Path;
use std::process::{Command, Output, Stdio};

fn ugmesh(folder: &Path, args: &[&str], input: &[u8]) -> Output {
    ugtesting::run::fed(Command::new(env!("CARGO_BIN_EXE_ugmesh")).args(args).current_dir(folder), input)
}

const OBJ: &str = "mtllib cube.mtl\nv 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 1 1 3\nusemtl red\nf 4 3 2 1\nf 1 2 5\n\
                   usemtl green\nf 2 3 5\nf 3 4 5\nf 4 1 5\n";
const MTL: &str = "newmtl red\nKd 1 0 0\nnewmtl green\nKd 0 1 0\n";

#[test]
fn a_mesh_goes_through_a_pipe_and_back() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("cube.obj"), OBJ).unwrap();
    fs::write(folder.path().join("cube.mtl"), MTL).unwrap();

    let scene = ugmesh(folder.path(), &["-center", "-fit", "1", "-name", "cube", "cube.obj"], b"");
    assert_eq!(String::from_utf8_lossy(&scene.stderr), "");
    assert!(scene.status.success());
    let text = String::from_utf8(scene.stdout).unwrap();
    let version = env!("CARGO_PKG_VERSION");
    let head = format!("{{ ugmesh {version}: ugmesh --center -fit 1 --name cube }}\n");
    let (origin, rest) = text.split_once('\n').unwrap();
    assert!(origin.starts_with("{ SHA-256 ") && origin.ends_with(" cube.obj }"), "{origin}");
    assert!(rest.starts_with(&head), "{text}");
    assert!(
        text.contains("c_rgb cube_red 1 0 0;\n") && text.contains("f (cube_v1 cube_v2 cube_v5) cube_red;\n"),
        "{text}"
    );

    let ply = ugmesh(folder.path(), &["-dt", "ply"], text.as_bytes());
    assert!(ply.status.success() && ply.stderr.is_empty());
    assert!(ply.stdout.starts_with(b"ply\nformat binary_little_endian 1.0\n"));

    let files = [("out.obj", &[][..]), ("out.ply", &["-ascii"]), ("out.gltf", &[]), ("out.glb", &[])];
    for (name, options) in files {
        let out = ugmesh(folder.path(), &[options, &["-fo", name]].concat(), text.as_bytes());
        assert!(
            out.status.success() && out.stdout.is_empty(),
            "{name}: {}",
            String::from_utf8_lossy(&out.stderr)
        );
        let back = ugmesh(folder.path(), &["-fi", name], b"");
        assert!(back.status.success(), "{name}: {}", String::from_utf8_lossy(&back.stderr));
        let n_faces =
            String::from_utf8(back.stdout).unwrap().lines().filter(|line| line.starts_with("f ")).count();
        let expected = if name.ends_with("obj") || name.ends_with("ply") { 5 } else { 6 };
        assert_eq!(n_faces, expected, "{name}");
    }
}

#[test]
fn a_stage_is_written_to_scenes_only() {
    let folder = tempfile::tempdir().unwrap();
    let out = ugmesh(folder.path(), &["-if", "obj", "--stage"], &OBJ.as_bytes()[16..]);
    let text = String::from_utf8(out.stdout).unwrap();
    let count = |word: &str| text.lines().filter(|line| line.starts_with(word)).count();
    assert_eq!((count("cam -ep "), count("l "), out.status.code()), (1, 2, Some(0)), "{text}");
    // Other formats have no such statements.
    let again = ugmesh(folder.path(), &["-dt", "obj", "--stage"], text.as_bytes());
    assert_eq!(again.status.code(), Some(2));
    let message =
        "ugmesh: error: -stage writes statements of UniGrafix; leave out -dt and the ending of -fo\n";
    assert!(String::from_utf8(again.stderr).unwrap().starts_with(message));
}

#[test]
fn missing_materials_are_a_warning() {
    let folder = tempfile::tempdir().unwrap();
    let out = ugmesh(folder.path(), &["-if", "obj"], OBJ.as_bytes());
    assert!(out.status.success());
    assert_eq!(
        String::from_utf8_lossy(&out.stderr),
        "ugmesh: warning: colours are missing: cannot read `cube.mtl`: standard input has no folder; name the mesh on \
         the command line\nugmesh: warning: materials without colour: `green`, `red`\n"
    );
}

#[test]
fn scenes_may_include_files() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("corners.ug"), "v a 0 0 0; v b 1 0 0; v c 0 1 0;").unwrap();
    fs::write(folder.path().join("scene.ug"), "include corners.ug; f (a b c);").unwrap();
    let out = ugmesh(folder.path(), &["-dt", "obj", "scene.ug"], b"");
    assert!(out.status.success(), "{}", String::from_utf8_lossy(&out.stderr));
    assert_eq!(String::from_utf8_lossy(&out.stdout).lines().filter(|line| line.starts_with("v ")).count(), 3);
    fs::write(folder.path().join("scene.ug"), "execute corners.ug; f (a b c);").unwrap();
    let out = ugmesh(folder.path(), &["-dt", "obj", "scene.ug"], b"");
    assert_eq!((out.status.code(), out.stdout.len()), (Some(1), 0));
}

#[test]
fn bad_usage_is_status_2() {
    let folder = tempfile::tempdir().unwrap();
    for (args, message) in [
        (&["-scale", "0"][..], "sizes (-scale, -fit) must be above 0"),
        (&["-fit", "-1"][..], "sizes (-scale, -fit) must be above 0"),
        (&["-scale", "2", "-fit", "1"][..], "cannot be given together"),
        (&["-scale", "nan"][..], "not a finite number"),
        (&["-dt", "stl"][..], "`-dt` takes "),
        (&["-ascii"][..], "-ascii applies only to PLY; add -dt ply"),
        (
            &["-fo", "x.stl"][..],
            "the extension of `x.stl` is none of the formats ug, obj, ply, gltf, glb and vtp; name one with -dt",
        ),
        (&["-name", "a b"][..], "a name consists of letters, digits and _, and begins with a letter"),
        (&["-up", "w"][..], "`-up` takes "),
        (&["-if", "ug"][..], "the input is already a UniGrafix scene; choose an output format with -dt"),
    ] {
        let out = ugmesh(folder.path(), args, b"v a 0 0 0;");
        let error = String::from_utf8_lossy(&out.stderr).into_owned();
        assert_eq!(out.status.code(), Some(2), "{args:?}: {error}");
        assert!(error.contains(message), "{args:?}: {error}");
        assert!(out.stdout.is_empty(), "{args:?}");
    }
}

#[test]
fn bad_meshes_are_status_1_and_write_nothing() {
    let folder = tempfile::tempdir().unwrap();
    for (args, input, message) in [
        (
            &["-fo", "out.ug"][..],
            "v 0 0 0\nf 1 2 3\n",
            "`<stdin>` as OBJ: line 2: a face refers to vertex `2`",
        ),
        (&["-fo", "out.glb"][..], "v a 0 0 0;\nf (a b c);\n", "vertex `b` is not defined"),
        (&["-fo", "out.ug"][..], "hello", "cannot detect the format of `<stdin>`; give it with -if"),
    ] {
        let out = ugmesh(folder.path(), args, input.as_bytes());
        let error = String::from_utf8_lossy(&out.stderr).into_owned();
        assert_eq!(out.status.code(), Some(1), "{input}: {error}");
        assert!(error.contains(message), "{error}");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0, "{input}");
    }
}

#[test]
fn a_closed_pipe_ends_the_program_by_sigpipe() {
    use std::os::unix::process::ExitStatusExt;

    let mut child = Command::new(env!("CARGO_BIN_EXE_ugmesh"))
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    drop(child.stdout.take());
    child.stdin.take().expect("a pipe").write_all(b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
    let out = child.wait_with_output().unwrap();
    assert_eq!(out.status.signal(), Some(13));
    assert!(out.stderr.is_empty());
}
