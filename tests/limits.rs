//! The programs with little memory, endless and huge files, and files outside the folder of the
//! input.
//!
//! Every program runs with a limit on its address space, which is the measure of these tests. Huge
//! files are sparse.

use std::fs::{self, File};
use std::os::unix::fs::symlink;
use std::process::{Command, Output};

use ugimage::{Compression, Format, Frame, LinearFrame, Metadata};
use ugtests::scenes;
use ugtests::shell::Shell;

/// Address space for rows whose need is small, in KiB.
const LITTLE: u64 = 400_000;

/// Address space that large pictures exceed, in KiB.
const LEAST: u64 = 120_000;

/// Runs a shell line.
fn run(shell: &Shell, limit_kib: u64, line: &str) -> Output {
    shell.output(&format!("ulimit -v {limit_kib}; {line}"))
}

/// Checks status, emptiness of the output unless the status is 0, and a part of the messages.
#[track_caller]
fn check(shell: &Shell, limit_kib: u64, line: &str, status: i32, message: &str) -> String {
    let out = run(shell, limit_kib, line);
    let messages = String::from_utf8_lossy(&out.stderr);
    assert_eq!(out.status.code(), Some(status), "{line}: {messages}");
    assert_eq!(out.stdout.is_empty(), status != 0, "{line}");
    assert!(messages.contains(message), "{line}: {messages}");
    String::from_utf8_lossy(&out.stdout).into_owned()
}

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

/// `in/` is the folder of the inputs, `out/` a folder beside it.
fn folder() -> Shell {
    let shell = Shell::new(&[]);
    let path = |name: &str| shell.path(name);
    fs::create_dir(path("in")).expect("a folder");
    fs::create_dir(path("out")).expect("a folder");
    for name in ["in/huge", "out/huge"] {
        File::create(path(name)).and_then(|file| file.set_len(5 << 30)).expect("a sparse file");
    }
    symlink("/dev/zero", path("in/endless")).expect("a link");
    symlink("../out", path("in/link")).expect("a link");
    let made = Command::new("mkfifo").arg(path("in/pipe")).status().expect("mkfifo runs");
    assert!(made.success());
    shell.write("out/secret", "root:x:0:0:secret\n");
    shell.write("out/part.ug", "v outside 1 2 3;");
    shell.write("part.ug", "v beside 1 2 3;");
    shell.write("in/part.ug", "v inside 1 2 3;");
    shell
}

/// A triangle whose buffer of 36 bytes is in a file.
fn gltf(uri: &str) -> String {
    format!(
        r#"{{"asset":{{"version":"2.0"}},"nodes":[{{"mesh":0}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}}}}]}}],
        "accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}}],
        "bufferViews":[{{"buffer":0,"byteLength":36}}],"buffers":[{{"byteLength":36,"uri":"{uri}"}}]}}"#
    )
}

#[test]
fn files_that_a_mesh_names_are_limited() {
    let shell = folder();
    for (library, options, status, message) in [
        ("endless", "", 0, "colours are missing: cannot read `endless`: It is outside the folder"),
        ("endless", "--allow-outside", 0, "cannot read `endless`: It is not a regular file"),
        ("pipe", "", 0, "cannot read `pipe`: It is not a regular file"),
        ("huge", "", 1, "the files of materials have more than 268435456 bytes together"),
        ("link/secret", "", 0, "cannot read `link/secret`: It is outside the folder"),
        ("link/secret", "--allow-outside", 0, ""),
    ] {
        shell.write("in/a.obj", format!("mtllib {library}\n{TRIANGLE}"));
        // Materials of the largest size, and the stacks of the threads.
        check(&shell, 1_000_000, &format!("ugmesh in/a.obj {options}"), status, message);
    }
    let absolute = shell.path("out/huge").display().to_string();
    for (uri, options, status, message) in [
        // Only 36 bytes are read.
        ("huge", "", 1, "the mesh has no faces with an area"),
        ("link/huge", "--allow-outside", 1, "the mesh has no faces with an area"),
        ("endless", "--allow-outside", 1, "cannot read `endless`: It is not a regular file"),
        ("pipe", "", 1, "cannot read `pipe`: It is not a regular file"),
        // A file elsewhere is replaced by the file of the same name beside the mesh.
        ("../out/huge", "", 1, "the mesh has no faces with an area"),
        ("%2e%2e/out/huge", "", 1, "the mesh has no faces with an area"),
        (&absolute, "", 1, "the mesh has no faces with an area"),
        ("../out/secret", "", 1, "It is outside the folder of the input"),
        (&absolute, "--allow-outside", 1, "the mesh has no faces with an area"),
    ] {
        shell.write("in/a.gltf", gltf(uri));
        check(&shell, LITTLE, &format!("ugmesh in/a.gltf {options}"), status, message);
    }
}

/// One rule for the names of files in all statements: from the file that has the statement, with
/// no `/` at the end.
#[test]
fn names_of_files_are_found_alike_in_all_statements() {
    const BODY: &str = "v a -1 0 -1 (0 1); v b 1 0 -1 (1 1); v c 0 0 1 (.5 0); f (a b c) t;";
    const EYE: &str = "cam -ep 0 -6 1 -vc 0 0 0;";
    let shell = Shell::new(&[]);
    shell.run("mkdir -p in/deep elsewhere");
    let mut picture = b"PF\n32 16\n-1.0\n".to_vec();
    picture.extend([0.25_f32; 3 * 32 * 16].iter().flat_map(|level| level.to_le_bytes()));
    shell.write("in/deep/wall.pfm", &picture);
    shell.write("in/deep/path.csv", "t,x,y,z\n-9,0,0,0\n9,1,0,0\n");
    shell.write("in/deep/more.ug", "l .5;");
    for (statement, file) in [
        ("c t .5; include NAME;", "more.ug"),
        ("c t .5; motion m -path NAME;", "path.csv"),
        ("c t .5; c_tex t NAME;", "wall.pfm"),
        ("c t .5; sky NAME;", "wall.pfm"),
    ] {
        let written = |name: &str| statement.replace("NAME", &format!("\"{name}\""));
        shell.write("in/deep/scene.ug", format!("{} {BODY} {EYE}", written(file)));
        shell.write("in/whole.ug", "include deep/scene.ug;");
        let draw = "ugphoton -qt -aa 1 -sz 8 6 -dt ppm";
        shell.run(&format!("cd in/deep; {draw} scene.ug > ../../here.ppm"));
        let pixels = |name: &str| {
            let file = shell.read(name);
            file[file.len() - 3 * 48..].to_vec()
        };
        let here = pixels("here.ppm");
        for (folder, scene) in [
            (".", "in/deep/scene.ug"),
            (".", "in/whole.ug"),
            ("in", "whole.ug"),
            ("in", "./deep/../whole.ug"),
            ("elsewhere", "../in/whole.ug"),
        ] {
            shell.run(&format!("cd {folder}; {draw} {scene} > \"$OLDPWD\"/there.ppm"));
            assert!(here == pixels("there.ppm"), "{statement}: {folder}, {scene}");
        }
        for end in ["/", "/.", "//"] {
            let name = format!("{file}{end}");
            shell.write("in/deep/scene.ug", format!("{} {BODY} {EYE}", written(&name)));
            for program in ["ugphoton -sz 8 6", "ugfilm -rays -frames 1 -sz 8 6 -fo f_%d.png"] {
                let (status, messages) = shell.fail(&format!("{program} in/whole.ug"));
                let is_told = messages.contains("Not a directory") && messages.contains(file);
                assert!(status == Some(1) && is_told, "{statement} {name}: {messages}");
            }
        }
    }
}

/// What comes from standard input may name files of the current folder alone, so the first program
/// of a pipe says in which folder it runs.
#[test]
fn a_pipe_of_a_scene_elsewhere_says_what_to_do() {
    const NOTE: &str = "the scene names pictures outside the current folder, which programs \
                        downstream refuse: run the pipe in the folder of the scene";
    const REFUSAL: &str = "It is outside the current folder; run the whole pipe in the folder of \
                           the scene, or if you trust the scene";
    let shell = Shell::new(&[]);
    shell.run("mkdir elsewhere");
    shell.write("wall.pfm", [&b"PF\n32 16\n-1.0\n"[..], &[0; 12 * 32 * 16]].concat());
    let body = "v a -1 0 -1 (0 1); v b 1 0 -1 (1 1); v c 0 0 1 (.5 0); c t .5; \
                cam -ep 0 -6 1 -vc 0 0 0;";
    for (scene, pipe) in [
        ("c_tex t wall.pfm; f (a b c) t;", "uglorentz scene.ug | ugrainbow -xc -sz 8 6"),
        ("f (a b c); sky wall.pfm;", "uglorentz scene.ug | ugdoppler | ugrainbow -sz 8 6"),
    ] {
        shell.write("scene.ug", format!("{body} {scene}"));
        let [_, messages] = shell.run(&format!("{pipe} > here.png"));
        assert!(!messages.contains("outside"), "{messages}");
        let outside = pipe.replace("scene.ug", "../scene.ug");
        let (_, messages) = shell.fail(&format!("cd elsewhere; {outside} > there.png"));
        assert!(messages.contains(NOTE) && messages.contains(REFUSAL), "{messages}");
        let allowed = outside.replace("-sz", "--allow-outside -sz");
        shell.run(&format!("cd elsewhere; {allowed} > ../there.png"));
        assert!(shell.pixels("here.png") == shell.pixels("there.png"));
        let film = "ugfilm -frames 1 -sz 8 6 -fo f_%d.png";
        let [_, messages] = shell.run(&format!("cd elsewhere; {film} --print ../scene.ug"));
        assert!(messages.contains(NOTE), "{messages}");
        let films = format!("{film} ../scene.ug; {film} --print -rays ../scene.ug");
        let [_, messages] = shell.run(&format!("cd elsewhere; {films}"));
        assert!(!messages.contains("outside"), "{messages}");
    }
}

#[test]
fn files_that_a_scene_names_are_in_its_folder() {
    let shell = folder();
    for (file, options, status, expected) in [
        ("part.ug", "", 0, "v inside 1 2 3;\n"),
        ("link/../in/part.ug", "", 0, "v inside 1 2 3;\n"),
        // The system follows the link first.
        ("link/../part.ug", "--allow-outside", 0, "v beside 1 2 3;\n"),
        ("link/../part.ug", "", 1, "It is outside the folder of the input"),
        ("../part.ug", "", 1, "It is outside the folder of the input"),
        ("link/part.ug", "", 1, "It is outside the folder of the input"),
        ("link/part.ug", "--allow-outside", 0, "v outside 1 2 3;\n"),
        ("endless", "--allow-outside", 1, "It is not a regular file"),
        ("pipe", "", 1, "It is not a regular file"),
        ("huge", "--limit text=1000", 1, "with the text of `huge` the scene is too large"),
        ("link/secret", "--allow-outside", 1, "file `link/secret` is not UniGrafix"),
        ("link/secret", "--allow-outside -lax", 1, "file `link/secret` is not UniGrafix"),
    ] {
        shell.write("in/scene.ug", format!("include {file} ;"));
        let named = format!("ugparse flatten in/scene.ug {options}");
        // On standard input, the current folder is that of the input.
        let piped = format!("cd in; ugparse flatten {options} < scene.ug");
        let of_pipe = expected.replace("the folder of the input", "the current folder");
        for (line, expected) in [(named, expected), (piped, &*of_pipe)] {
            let output =
                check(&shell, LITTLE, &line, status, if status == 0 { "" } else { expected });
            assert!(status != 0 || output == expected, "{file}: {output}");
            let messages = String::from_utf8_lossy(&run(&shell, LITTLE, &line).stderr).into_owned();
            assert!(!messages.contains("root:"), "{messages}");
        }
    }
    // What the user names may be anything.
    let piped = check(&shell, LITTLE, "cat in/part.ug | ugparse flatten /dev/stdin", 0, "");
    assert_eq!(piped, "v inside 1 2 3;\n");
}

#[test]
fn endless_inputs_end() {
    let shell = folder();
    for line in [
        "ugparse --limit text=1000000",
        "uglorentz --limit text=1000000",
        "ugdoppler --limit text=1000000",
        "ugrainbow --limit text=1000000",
    ] {
        check(&shell, LITTLE, &format!("{line} /dev/zero"), 1, "the scene is too large");
    }
    for program in ["ugparse", "uglorentz", "ugdoppler", "ugrainbow", "ugmesh -if ply", "ugsheet"] {
        let line = format!("{program} /dev/zero");
        check(&shell, LITTLE, &line, 1, "cannot read `/dev/zero`: out of memory");
    }
}

/// Arrays of arrays: none needs more than the limits allow, and all are refused before expansion.
#[test]
fn arrays_are_limited_by_what_they_write() {
    let shell = folder();
    let points: String = (0..100).map(|idx| format!("v p{idx} 0 {idx} {};", idx * idx)).collect();
    let faces = "f (p0 p1 p2) (p3 p4 p5);".repeat(100);
    let wires = format!("w {};", "(p0 p1)".repeat(500));
    let cameras = "cam -ep 1 2 3;".repeat(100);
    for content in [points.clone(), format!("{points}{faces}"), format!("{points}{wires}"), cameras]
    {
        let text = format!("def d; {content} end; def e; a (d) 490; end; a (e) 490;");
        shell.write("in/array.ug", text);
        check(&shell, LITTLE, "ugparse count in/array.ug", 1, "the expanded scene would have ");
    }
}

#[test]
fn lack_of_memory_is_an_error() {
    let shell = folder();
    shell.write("ship.ug", scenes::text("ship"));
    for options in ["", "-dt png16", "-dt exr -ch D", "-dt hdr", "-ex 1", "-tb", "-xc"] {
        let line = format!("ugrainbow ship.ug -sz 16000 16000 {options}");
        check(
            &shell,
            LITTLE,
            &line,
            1,
            "there is not enough memory for a picture of 16000 x 16000 pixels",
        );
    }
    // Whatever cannot be allocated.
    shell.write("in/array.ug", "def d; v a 0 0 0; end; a (d) 9000000;");
    let line = "ugparse flatten in/array.ug";
    check(&shell, LITTLE, line, 1, "memory allocation of ");
    assert!(fs::read_dir(shell.folder()).expect("a folder").count() < 6);
    // A sheet is as large as its text.
    let title = "word ".repeat(8);
    let line =
        format!("ugrainbow ship.ug -sz 40 30 -qt > a.png; ugsheet a.png -ts 1000 -title '{title}'");
    for format in ["png", "svg", "pdf"] {
        check(&shell, LEAST, &format!("{line} -dt {format}"), 1, "there is not enough memory for ");
    }
    // Threads for which there is no address space are not started.
    check(&shell, LITTLE, "ugparse flatten ship.ug -nt 1024", 0, "");
    check(&shell, LITTLE, "ulimit -s 200000; ugparse flatten ship.ug", 0, "");
}

/// A header of 8 million pixels, and bytes that could be runs of so many, but are one pixel each;
/// another with so many, but a wrong number of blocks.
#[test]
fn pixels_take_memory_as_they_are_read() {
    let shell = folder();
    let frame = LinearFrame::from(&Frame::opaque(4000, 2000));
    let mut file = Format::Exr.encode_linear(&frame, &Metadata::default(), Compression::Fast);
    let name = b"chunkCount\0int\0\x04\0\0\0";
    let at = file.windows(name.len()).position(|bytes| bytes == name).expect("the attribute")
        + name.len();
    file[at] ^= 1;
    shell.write("in/lie.exr", file);
    check(&shell, LEAST, "ugwarp in/lie.exr -sz 8 8", 1, "chunk count");
    let header = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2000 +X 4000\n".as_slice();
    let file = [header, &[99; 600_000]].concat();
    shell.write("in/lie.hdr", file);
    check(&shell, LEAST, "ugwarp in/lie.hdr -sz 8 8", 1, "the file is truncated");
}

/// A PNG file of one bit per pixel, whose rows are alike.
fn bits([width, height]: [u32; 2]) -> Vec<u8> {
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, width, height);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.set_depth(png::BitDepth::One);
    let row = width.div_ceil(8) as usize;
    let data: Vec<u8> = (0..row * height as usize).map(|idx| (idx % row) as u8).collect();
    encoder.write_header().and_then(|mut writer| writer.write_image_data(&data)).expect("a file");
    file
}

/// A panorama of 100 megapixels needs 4 bytes a pixel and what is seen of its mip levels; the
/// whole sky seen small needs more, and one that is too large is refused before it is decoded.
#[test]
fn large_panoramas_are_bounded() {
    let shell = Shell::new(&[]);
    let write = |name: &str, size: [u32; 2]| shell.write(name, bits(size));
    write("sky.png", [14_144, 7072]);
    check(&shell, 1_000_000, "ugwarp -qt -nt 2 -cv 0 .5 0 -sz 160 90 -dt ppm sky.png", 0, "");
    check(&shell, 2_000_000, "ugwarp -qt -nt 2 -cv 0 .9 0 -pan -sz 400 200 -dt ppm sky.png", 0, "");
    write("huge.png", [32_768, 16_384]);
    check(
        &shell,
        LITTLE,
        "ugwarp huge.png",
        1,
        "32768 x 16384 pixels exceed the limit of 268435456",
    );
}

/// Motions along one table keep it once, in text as well; what is kept counts as memory. One face
/// of many corners is a figure with memory in proportion to them.
#[test]
fn tables_of_motions_and_corners_of_figures_take_memory_in_proportion() {
    let shell = folder();
    let rows: String = (0..20_000).map(|t| format!("{t},0,0,0\n")).collect();
    shell.write("in/p.csv", format!("t,x,y,z\n{rows}"));
    let motions: String = (0..1000).map(|k| format!("motion m{k} -path p.csv;\n")).collect();
    let face = "v a 0 0 0; v b 1 0 0; v c 0 0 1; f (a b c) <m7>; cam -ep 0 -9 0 -vc 0 0 0;";
    shell.write("in/m.ug", format!("{motions}{face}"));
    let flat = check(&shell, LITTLE, "ugparse flatten in/m.ug", 0, "");
    assert!(flat.contains("motion m999 -path <m0>;") && flat.len() < 500_000, "{}", flat.len());
    shell.write("in/flat.ug", &flat);
    let again = check(&shell, LITTLE, "ugparse flatten in/flat.ug", 0, "");
    assert_eq!(again, flat);
    check(&shell, LITTLE, "ugparse --limit memory=1000000 in/m.ug", 1, "--limit memory=N");
    shell.write(
        "in/none.ug",
        format!("motion m0 -path <m1>; motion m1 -vel .1 0 0; {face}").replace("m7", "m0"),
    );
    check(&shell, LITTLE, "ugparse in/none.ug", 1, "motion `m1` states no table of a path");

    let fan: String = (0..1500)
        .map(|k| format!("c k{k} .5 {k}; v c{k} 1 .5 {k}; f (a b c{k}) k{k};\n"))
        .collect();
    shell.write("in/fan.ug", format!("v a 0 0 0; v b 1 0 0; cam -ep 0 -12 3 -vc 0 0 0;\n{fan}"));
    let refused =
        "mix more than 4194304 colours of faces that meet: give faces vertices of their own";
    check(&shell, 4 * LITTLE, "uglorentz -nt 1 -vel .5 0 0 in/fan.ug", 1, refused);

    let corner = |k: usize| {
        let (angle, radius) = (k as f64 * std::f64::consts::TAU / 8000.0, (1 + k % 2) as f64);
        format!("v a{k} {} 0 {};\n", radius * libm::cos(angle), radius * libm::sin(angle))
    };
    let corners: String = (0..8000).map(corner).collect();
    let names: String = (0..8000).map(|k| format!("a{k} ")).collect();
    shell.write("in/star.ug", format!("{corners}f ({names}); cam -ep 0 -12 0 -vc 0 0 0;"));
    let figure = check(&shell, LITTLE, "ugrainbow -nt 1 -vec -dt svg -sz 64 48 in/star.ug", 0, "");
    assert!(figure.contains("<svg"));
}
