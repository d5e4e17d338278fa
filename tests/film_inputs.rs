//! Films are those of their inputs: a frame is drawn anew after a change of any file that it was
//! made of, and has the bytes of its pipe.

use std::any::TypeId;
use std::collections::BTreeSet;
use std::fmt::Write;
use std::path::PathBuf;

use clap::CommandFactory;
use ugimage::{Compression, Format, Frame, LinearFrame, Metadata};
use ugparse::RequestKind;
use ugtests::shell::Shell;

/// A kind of file that a scene or an option names.
struct Kind {
    what: &'static str,
    /// Writes all files: those of version 0, or of version 1 with other light.
    write: fn(&Shell, usize),
    /// Films that read it.
    films: &'static [&'static str],
}

const MOVING: &str = "-vel 0..0.5 0 0 -in";
const CAMERA: &str = "cam -ep 0 -6 1 -vc 0 0 0;";
const CORNERS: &str = "v a -1 0 -1 (0 1); v b 1 0 -1 (1 1); v c 0 0 1 (.5 0);";

/// The level of a colour: red, then blue.
fn color(version: usize) -> [f32; 4] {
    [[1.0, 0.0, 0.0, 1.0], [0.0, 0.0, 1.0, 1.0]][version]
}

fn picture(format: Format, version: usize) -> Vec<u8> {
    let light = LinearFrame::new([64, 32], true, vec![color(version); 64 * 32]);
    if format.is_linear() {
        return format.encode_linear(&light, &Metadata::default(), Compression::Fast);
    }
    let [red, _, blue, _] = color(version).map(|part| (255.0 * part) as u8);
    let frame = Frame::new([64, 32], true, vec![[red, 0, blue, 255]; 64 * 32]);
    format.encode(&frame, &Metadata::default())
}

fn textured(shell: &Shell, file: &str) {
    let text = format!("{CORNERS} c t .5; c_tex t {file}; f (a b c) t; {CAMERA}");
    shell.write("tex.ug", text);
}

fn plain(shell: &Shell, statement: &str) {
    shell.write("plain.ug", format!("{CORNERS} f (a b c); {statement} {CAMERA}"));
}

fn stars(version: usize) -> String {
    // Bright enough for any exposure, and hardly to be seen.
    let magnitude = if version == 0 { -9 } else { 6 };
    let rows: String = (0..90).fold(String::new(), |mut rows, row| {
        let _ = writeln!(rows, "{},{},{magnitude},5000", 4 * row, row - 45);
        rows
    });
    format!("ra,dec,mag,kelvin\n{rows}")
}

const OBJ: &str = "mtllib m.mtl\nv -1 0 -1\nv 1 0 -1\nv 0 0 1\nvt 0 0\nvt 1 0\nvt .5 1\nusemtl m\n\
                   f 1/1 2/2 3/3\n";

fn material(version: usize, texture: &str) -> String {
    format!("newmtl m\nKd {}\n{texture}", ["1 0 0", "0 0.5 1"][version])
}

/// A triangle whose coordinates are in a file, and its texture in another.
const GLTF: &str = r#"{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"material":0}]}],
"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0},"metallicFactor":0}}],
"textures":[{"source":0}],"images":[{"uri":"wall.png"}],"buffers":[{"uri":"b.bin","byteLength":60}],
"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":24}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},
{"bufferView":1,"componentType":5126,"count":3,"type":"VEC2"}]}"#;

fn gltf(shell: &Shell, of_buffer: usize, of_texture: usize) {
    let wide = [1.0, 0.4][of_buffer];
    let numbers: [f32; 15] =
        [-1.0, -1.0, 0.0, wide, -1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 1.0, 0.5, 0.0];
    shell.write("mesh.gltf", GLTF);
    shell.write("b.bin", numbers.map(f32::to_le_bytes).concat());
    shell.write("wall.png", picture(Format::Png, of_texture));
}

/// A file of glTF that has nothing but a picture.
fn glb(version: usize) -> Vec<u8> {
    let mut image = picture(Format::Png, version);
    let len = image.len();
    image.resize(len.next_multiple_of(4), 0);
    let mut json = format!(
        r#"{{"asset":{{"version":"2.0"}},"images":[{{"bufferView":0,"mimeType":"image/png"}}],
        "bufferViews":[{{"buffer":0,"byteLength":{len}}}],"buffers":[{{"byteLength":{}}}]}}"#,
        image.len()
    );
    json += &" ".repeat(json.len().next_multiple_of(4) - json.len());
    let word = |number: usize| (number as u32).to_le_bytes();
    let whole = 28 + json.len() + image.len();
    let head = [*b"glTF", word(2), word(whole), word(json.len()), *b"JSON"].concat();
    let between = [word(image.len()), *b"BIN\0"].concat();
    [&head, json.as_bytes(), &between, &image].concat()
}

const TEXTURED: &[&str] = &["tex.ug", "-rays tex.ug", "-xc -sd 1 tex.ug"];
const MESH: &[&str] = &["s.obj", "-rays s.obj", "-xc -sd 1 s.obj"];
const PLAIN: &[&str] = &["plain.ug", "-rays plain.ug", "-xc -sd 1 plain.ug", "-li plain.ug"];

const KINDS: [Kind; 31] = [
    Kind {
        what: "the input",
        write: |shell, version| {
            plain(shell, ["", "l .4;"][version]);
        },
        films: &["plain.ug", "-fi plain.ug", "-rays plain.ug", "< plain.ug"],
    },
    // Converted by a program, and changed by hand: the history stays the same.
    Kind {
        what: "the input, with a history",
        write: |shell, version| {
            shell.write("m.mtl", material(0, ""));
            shell.write("s.obj", OBJ);
            shell.run("ugmesh s.obj > s.ug");
            shell.run(["true", "sed -i 's/^c_rgb m .*/c_rgb m 0 .5 1;/' s.ug"][version]);
        },
        films: &["s.ug", "-rays s.ug", "< s.ug", "-rays < s.ug"],
    },
    Kind {
        what: "include",
        write: |shell, version| {
            shell.write("whole.ug", "include 'part.ug' ;".replace('\'', "\""));
            shell.write("part.ug", "include deep.ug ;");
            let light = ["", "l .4;"][version];
            shell.write("deep.ug", format!("{CORNERS} f (a b c); {light} {CAMERA}"));
        },
        films: &["whole.ug", "-rays whole.ug"],
    },
    Kind {
        what: "include of a mesh, its materials",
        write: |shell, version| {
            shell.write("whole.ug", format!("include s.obj; {CAMERA}"));
            shell.write("s.obj", OBJ);
            shell.write("m.mtl", material(version, ""));
        },
        films: &["whole.ug", "-rays whole.ug"],
    },
    Kind {
        what: "execute",
        write: |shell, version| {
            shell.write("run.ug", format!("execute prog; {CAMERA}"));
            let light = ["", "l .4;"][version];
            shell.write("data", format!("{CORNERS} f (a b c); {light}"));
            shell.run("printf '#!/bin/sh\\ncat data' > prog; chmod +x prog");
        },
        films: &["--allow-execute run.ug", "--allow-execute -rays run.ug"],
    },
    Kind {
        what: "-path",
        write: |shell, version| {
            shell.write("path.csv", format!("t,x,y,z\n-9,0,0,0\n9,{},0,0\n", [0.5, 3.5][version]));
            let text = format!("motion m -path path.csv; {CORNERS} f (a b c) <m>; {CAMERA}");
            shell.write("ride.ug", text);
        },
        films: &["-ti 0..1 ride.ug", "-rays -ti 0..1 ride.ug"],
    },
    Kind {
        what: "c_tex, PNG",
        write: |shell, version| {
            textured(shell, "wall.png");
            shell.write("wall.png", picture(Format::Png, version));
        },
        films: TEXTURED,
    },
    Kind {
        what: "c_tex, JPEG",
        write: |shell, version| {
            textured(shell, "wall.jpg");
            let files: [&[u8]; 2] = [
                include_bytes!("../crates/ugimage/tests/rgb.jpg"),
                include_bytes!("../crates/ugimage/tests/bars.jpg"),
            ];
            shell.write("wall.jpg", files[version]);
        },
        films: TEXTURED,
    },
    Kind {
        what: "c_tex, HDR",
        write: |shell, version| {
            textured(shell, "wall.hdr");
            shell.write("wall.hdr", picture(Format::Hdr, version));
        },
        films: TEXTURED,
    },
    Kind {
        what: "c_tex, EXR",
        write: |shell, version| {
            textured(shell, "wall.exr");
            shell.write("wall.exr", picture(Format::Exr, version));
        },
        films: TEXTURED,
    },
    Kind {
        what: "c_tex, PFM",
        write: |shell, version| {
            textured(shell, "wall.pfm");
            shell.write("wall.pfm", picture(Format::Pfm, version));
        },
        films: TEXTURED,
    },
    Kind {
        what: "c_tex, a picture within a mesh",
        write: |shell, version| {
            textured(shell, "wall.glb -image 0");
            shell.write("wall.glb", glb(version));
        },
        films: TEXTURED,
    },
    Kind {
        what: "c_emit",
        write: |shell, version| {
            let text = "c t .5; c_tex t wall.png; c k 0; c_emit k t; f (a b c) k;";
            shell.write("tex.ug", format!("{CORNERS} {text} {CAMERA}"));
            shell.write("wall.png", picture(Format::Png, version));
        },
        films: &["tex.ug", "-rays tex.ug", "-xc -sd 1 tex.ug"],
    },
    Kind {
        what: "OBJ, its materials",
        write: |shell, version| {
            shell.write("s.obj", OBJ);
            shell.write("m.mtl", material(version, ""));
        },
        films: MESH,
    },
    Kind {
        what: "OBJ, its textures",
        write: |shell, version| {
            shell.write("s.obj", OBJ);
            shell.write("m.mtl", material(0, "map_Kd wall.png\n"));
            shell.write("wall.png", picture(Format::Png, version));
        },
        films: MESH,
    },
    // It is told that it is missing; later somebody puts it there.
    Kind {
        what: "OBJ, a texture that was missing",
        write: |shell, version| {
            shell.write("s.obj", OBJ);
            shell.write("m.mtl", material(0, "map_Kd wall.png\n"));
            if version > 0 {
                shell.write("wall.png", picture(Format::Png, 1));
            }
        },
        films: MESH,
    },
    Kind {
        what: "glTF, its coordinates",
        write: |shell, version| gltf(shell, version, 0),
        films: &["mesh.gltf", "-rays mesh.gltf", "-xc -sd 1 mesh.gltf"],
    },
    Kind {
        what: "glTF, its textures",
        write: |shell, version| gltf(shell, 0, version),
        films: &["mesh.gltf", "-rays mesh.gltf", "-xc -sd 1 mesh.gltf"],
    },
    Kind {
        what: "PLY",
        write: |shell, version| {
            let wide = [1.0, 0.4][version];
            let head = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
                        property float z\nelement face 1\nproperty list uchar int vertex_indices\n\
                        end_header\n";
            shell.write("s.ply", format!("{head}-1 0 -1\n{wide} 0 -1\n0 0 1\n3 0 1 2\n"));
        },
        films: &["s.ply", "-rays s.ply"],
    },
    Kind {
        what: "sky, a picture",
        write: |shell, version| {
            plain(shell, "sky wall.exr;");
            shell.write("wall.exr", picture(Format::Exr, version));
        },
        films: PLAIN,
    },
    Kind {
        what: "sky, a list of stars",
        write: |shell, version| {
            plain(shell, "sky some.csv;");
            shell.write("some.csv", stars(3 * version));
        },
        films: PLAIN,
    },
    Kind {
        what: "--sky, a picture",
        write: |shell, version| {
            plain(shell, "");
            shell.write("wall.png", picture(Format::Png, version));
        },
        films: &[
            "-sky wall.png plain.ug",
            "-sky wall.png -rays plain.ug",
            "-sky wall.png -xc -sd 1 plain.ug",
            "-sky wall.png -li plain.ug",
            "-sky wall.png -rays -blur .5 -moments 2 plain.ug",
        ],
    },
    Kind {
        what: "--sky, a list of stars",
        write: |shell, version| {
            plain(shell, "");
            shell.write("some.csv", stars(3 * version));
        },
        films: &["-sky some.csv plain.ug", "-sky some.csv -rays plain.ug"],
    },
    Kind {
        what: "the input, a panorama",
        write: |shell, version| shell.write("wall.png", picture(Format::Png, version)),
        films: &["-warp -va 90 wall.png", "-warp -va 90 < wall.png"],
    },
    Kind {
        what: "the input, numbered panoramas",
        write: |shell, version| {
            (3..=4).for_each(|n| shell.write(&format!("p{n}.png"), picture(Format::Png, version)));
        },
        films: &["-warp -va 90 p%d.png", "-warp -va 90 -blur .5 -moments 2 p%d.png"],
    },
    Kind {
        what: "the input, read in another way by each frame",
        write: |shell, version| shell.write("wall.png", picture(Format::Png, version)),
        films: &[
            "-warp -va 90 -sp --highlights 0..1 wall.png",
            "-warp -va 90 -sp --highlights 0..1 < wall.png",
        ],
    },
    Kind {
        what: "--stars",
        write: |shell, version| {
            shell.write("wall.png", picture(Format::Png, 0));
            shell.write("some.csv", stars(3 * version));
        },
        films: &["-warp -va 90 --stars some.csv wall.png"],
    },
    Kind {
        what: "--scene",
        write: |shell, version| {
            shell.write("some.csv", stars(0));
            shell.write("eye.ug", "include way.ug ; cam -ep 0 0 0 -vc 0 1 0 -va 80 <ship> ;");
            shell.write("way.ug", format!("motion ship -acc 0 {} 0 ;", version + 1));
        },
        films: &["-warp -ti 0..1 --scene eye.ug some.csv"],
    },
    Kind {
        what: "--infrared",
        write: |shell, version| {
            shell.write("wall.png", picture(Format::Png, 0));
            shell.write("more.png", picture(Format::Png, version));
        },
        films: &["-warp -va 90 -sp --infrared more.png wall.png"],
    },
    Kind {
        what: "--ultraviolet",
        write: |shell, version| {
            shell.write("wall.png", picture(Format::Png, 0));
            shell.write("more.png", picture(Format::Png, version));
        },
        films: &["-warp -va 90 -vc 0 -1 0 -sp --ultraviolet more.png wall.png"],
    },
    // Numbers that are the commands of the frames.
    Kind {
        what: "--keys",
        write: |shell, version| {
            plain(shell, "");
            let eye = version + 4;
            shell.write("keys", format!("1 -ep 0 -{eye} 1\n2 -ep 1 -{eye} 1\n"));
        },
        films: &["-keys keys plain.ug", "-keys keys -rays plain.ug"],
    },
];

/// Draws a film; true if both frames were there already.
fn is_kept(shell: &Shell, film: &str) -> bool {
    let [_, messages] = shell.run(film);
    assert!(!messages.contains("error"), "{film}: {messages}");
    let note = messages.lines().find(|line| line.contains("frames drawn"));
    note.is_some_and(|note| {
        assert!(note.ends_with("note: 0 frames drawn, 2 were there already"), "{film}: {note}");
        true
    })
}

fn check(kind: &Kind, film: &str) {
    let (shell, what) = (Shell::new(&[]), format!("{}: {film}", kind.what));
    let moving = match film {
        _ if film.contains("--scene") => "",
        _ if film.contains("-warp") => "-cv 0 0..0.5 0",
        _ if film.contains("-ti") || film.contains("-keys") => "",
        _ => MOVING,
    };
    let film = format!("ugfilm -nt 1 -frames 2 {moving} -ex 0 -sz 24 18 -fo f_%d.png {film}");
    let frames = || ["f_1.png", "f_2.png"].map(|name| shell.read(name));
    (kind.write)(&shell, 0);
    assert!(!is_kept(&shell, &film), "{what}");
    let first = frames();
    assert!(is_kept(&shell, &film) && first == frames(), "{what}");
    (kind.write)(&shell, 1);
    // Files may be older than the frames.
    shell.run("touch -d 2001-01-01 *");
    assert!(!is_kept(&shell, &film), "{what}: old frames are kept");
    let second = frames();
    let looks = |version: &[Vec<u8>; 2]| {
        let limits = ugimage::PictureLimits::default();
        version.clone().map(|file| ugimage::read_png(&file, &limits).unwrap().0.into_pixels())
    };
    // Stars may fall between the few samples.
    let may_look_alike = what.contains("list of stars");
    assert!(may_look_alike || looks(&first) != looks(&second), "{what}: the file has no effect");
    assert!(is_kept(&shell, &film), "{what}");
    shell.run("rm f_*");
    assert!(!is_kept(&shell, &film) && second == frames(), "{what}: not as in an empty folder");
    if what.contains("-blur") {
        return;
    }
    let input = film.split_once('<').map_or("/dev/null", |(_, name)| name);
    shell.run(&format!("{film} --print 1 > frame.sh; rm f_*; sh -e frame.sh < {input}"));
    assert!(shell.read("f_1.png") == second[0], "{what}: not the picture of the pipe");
}

#[test]
fn frames_are_drawn_anew_after_a_change_of_any_file() {
    for kind in &KINDS {
        kind.films.iter().for_each(|film| check(kind, film));
    }
}

/// A statement or an option that names a file and that no row has fails here.
#[test]
fn all_kinds_of_files_are_tried() {
    let all: Vec<&str> = KINDS.iter().map(|kind| kind.what).collect();
    for kind in [
        RequestKind::Include,
        RequestKind::Path,
        RequestKind::Image,
        RequestKind::Sky,
        RequestKind::Execute,
    ] {
        // A new kind does not compile.
        let statement = match kind {
            RequestKind::Include => "include",
            RequestKind::Path => "-path",
            RequestKind::Image => "c_tex, PNG",
            RequestKind::Sky => "sky, a picture",
            RequestKind::Execute => "execute",
        };
        assert!(all.contains(&statement), "{statement}");
    }
    let tools = [
        ugfilm::Args::command(),
        uglorentz::Args::command(),
        ugdoppler::Args::command(),
        ugrainbow::Args::command(),
        ugphoton::Args::command(),
        ugwarp::Args::command(),
    ];
    let is_path = |arg: &&clap::Arg| arg.get_value_parser().type_id() == TypeId::of::<PathBuf>();
    let arguments = tools.iter().flat_map(clap::Command::get_arguments).filter(is_path);
    let options: BTreeSet<&str> = arguments.filter_map(clap::Arg::get_long).collect();
    // Those that are written, and the input.
    let others = ["fo", "fm", "at", "fi"];
    for option in options.iter().filter(|option| !others.contains(option)) {
        let begin = format!("--{option}");
        assert!(all.iter().any(|what| what.starts_with(&begin)), "{begin} names a file");
    }
    assert!(options.len() >= 9, "{options:?}");
}

/// Films in one file, and exposures that were measured: of textures as they are now.
#[test]
fn exposures_and_kept_frames_are_those_of_their_inputs() {
    let shell = Shell::new(&[]);
    textured(&shell, "wall.exr");
    let dark = |part: f32| {
        let light = LinearFrame::new([4, 4], true, vec![[part, part, part, 1.0]; 16]);
        let file = Format::Exr.encode_linear(&light, &Metadata::default(), Compression::Fast);
        shell.write("wall.exr", file);
    };
    let exposure = |film: &str| {
        let [_, messages] = shell.run(film);
        let note =
            messages.lines().find_map(|line| line.split_once("one exposure for all frames: "));
        note.map(|(_, words)| words.to_owned()).unwrap_or_else(|| panic!("{film}: {messages}"))
    };
    // The exposure is kept because a frame is missing.
    let film = format!(
        "ugfilm -rays -frames 3 -only 1..2 {MOVING} -ex hold -sz 24 18 tex.ug -fo f_%d.png"
    );
    dark(0.5);
    let bright = exposure(&film);
    assert!(shell.path(".f_1.png.exposure").exists());
    assert_eq!(exposure(&film), bright);
    dark(0.01);
    let darker = exposure(&film);
    assert_ne!(darker, bright);
    let keep = format!("ugfilm -rays -frames 2 {MOVING} -ex 0 -sz 24 18 tex.ug");
    shell.run(&format!("{keep} -keep k_%d.png -fo old.gif; {keep} -keep k_%d.png -fo again.gif"));
    assert!(shell.read("old.gif") == shell.read("again.gif"));
    dark(0.5);
    shell.run(&format!("{keep} -keep k_%d.png -fo kept.gif; {keep} -fo new.gif"));
    assert!(shell.read("kept.gif") == shell.read("new.gif"));
    assert!(shell.read("kept.gif") != shell.read("old.gif"));
}

/// A picture says what it was made of, in the words of `sha256sum`, and `--history` what has
/// changed.
#[test]
fn pictures_record_every_file() {
    let shell = Shell::new(&[]);
    let deep = "deep/er";
    shell.run("mkdir -p deep/er");
    for folder in [".", deep] {
        shell.write(&format!("{folder}/wall.png"), picture(Format::Png, 0));
        shell.write(&format!("{folder}/s.obj"), OBJ);
        shell.write(&format!("{folder}/m.mtl"), material(1, "map_Kd wall.png\nmap_Ke none.png\n"));
    }
    shell.write("sky.exr", picture(Format::Exr, 1));
    shell.write("scene.ug", format!("include deep/er/s.obj; sky sky.exr; {CAMERA}"));
    let recorded = |file: &str| -> BTreeSet<String> {
        let history = ugimage::read_history(&shell.read(file)).unwrap();
        let lines = history.lines().filter(|line| line.starts_with("SHA-256 "));
        lines.map(|line| line.trim_start_matches("SHA-256 ").to_owned()).collect()
    };
    let expected = |names: &str| -> BTreeSet<String> {
        let [sums, _] = shell.run(&format!("sha256sum {names}"));
        sums.lines().map(|line| line.replace("  ", " ")).collect()
    };
    let mut all = expected("deep/er/s.obj deep/er/m.mtl deep/er/wall.png sky.exr");
    for pipe in [
        "ugphoton -sz 8 6 scene.ug",
        "uglorentz scene.ug | ugdoppler | ugrainbow -sz 8 6",
        "uglorentz scene.ug | ugdoppler -li | ugrainbow -sz 8 6",
        "uglorentz -sd 1 scene.ug | ugrainbow -xc -sz 8 6",
    ] {
        shell.run(&format!("{pipe} > picture.png"));
        let found = recorded("picture.png");
        assert_eq!(&found & &all, all, "{pipe}: {found:?}");
        let others: Vec<&String> = found.difference(&all).collect();
        assert!(others.iter().all(|words| words.starts_with("none ")), "{pipe}: {others:?}");
        let [_, messages] = shell.run("ugsheet --history picture.png");
        assert!(!messages.contains("changed") && !messages.contains("not in this"), "{messages}");
    }
    shell.write("sky.exr", picture(Format::Exr, 0));
    let [_, messages] = shell.run("ugsheet --history picture.png");
    assert!(messages.contains("`sky.exr` has changed since the picture was drawn"), "{messages}");
    // Outside the current folder names do not tell where it is.
    shell.run("cd deep; ugphoton -sz 8 6 --allow-outside ../scene.ug -fo ../picture.png");
    all = expected("sky.exr");
    all.extend(expected("deep/er/m.mtl").iter().map(|words| words.replace("deep/er/", "")));
    let found = recorded("picture.png");
    assert_eq!(&found & &all, all, "{found:?}");
    assert!(!found.iter().any(|words| words.contains('/')), "{found:?}");
}
