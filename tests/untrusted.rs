//! Text from outside cannot command the terminal: control characters and directional marks, in
//! every field of every format, in option values and in file names, do not reach standard error,
//! nor reports on standard output, nor figures.

use std::fs::{self, Permissions};
use std::io::{Cursor, Write};
use std::os::unix::fs::PermissionsExt;
use std::path::PathBuf;
use std::process::{Command, Output, Stdio};
use std::sync::LazyLock;

use ugtests::hostile::is_dangerous;
use ugtests::programs;

static PROGRAMS: LazyLock<PathBuf> = LazyLock::new(|| programs::folder().to_owned());

/// The replacements of `@` in a template: characters that a terminal obeys, those that separate
/// words as well, and a line end before what looks like a message.
const PAYLOADS: [&str; 3] = [
    "a\u{1b}[2J\u{1b}]0;t\u{7}\u{8}\u{7f}\u{80}\u{9b}31m\u{61c}\u{200b}\u{200e}\u{200f}\u{202a}\u{202e}\u{2066}\u{2069}\u{feff}b",
    "a\r\u{85}\t\u{b}\u{2028}\u{2029}b",
    "a\nugparse: error: forged",
];

struct Case<'a> {
    /// The program and its arguments, with `@`.
    words: &'a [&'a str],
    /// Name and content of its files, with `@`.
    files: &'a [(&'a str, &'a str)],
}

impl Case<'_> {
    fn run(&self, payload: &str, is_colored: bool) -> Output {
        let folder = tempfile::tempdir().unwrap();
        for (name, content) in self.files {
            let path = folder.path().join(name);
            let payload = if name.contains(".gl") { &json_escaped(payload) } else { payload };
            let bytes = content.replace('@', payload).into_bytes();
            let bytes = match name.split_once('.').unwrap().1 {
                "glb" => glb(bytes),
                "png" => png(&bytes),
                _ => bytes,
            };
            fs::write(&path, bytes).unwrap();
            fs::set_permissions(&path, Permissions::from_mode(0o755)).unwrap();
        }
        let mut command = Command::new(PROGRAMS.join(self.words[0]));
        if is_colored {
            command.env("CLICOLOR_FORCE", "1");
        } else {
            command.env_remove("CLICOLOR_FORCE");
        }
        command
            .args(self.words[1..].iter().map(|word| word.replace('@', payload)))
            .current_dir(folder.path())
            .stdin(Stdio::null())
            .output()
            .unwrap()
    }

    /// Returns whether the payload occurs in what the program prints, made harmless.
    #[track_caller]
    fn check(&self) -> bool {
        let mut is_quoted = false;
        for payload in PAYLOADS {
            let output = self.run(payload, false);
            assert!(
                matches!(output.status.code(), Some(0..=2)),
                "{:?}: {}",
                self.words,
                output.status
            );
            is_quoted |= self.check_text(&output.stderr);
            if self.prints_text() {
                is_quoted |= self.check_text(&output.stdout);
            }
            let colored = String::from_utf8_lossy(&self.run(payload, true).stderr).into_owned();
            self.check_text(without_styles(&colored).as_bytes());
        }
        is_quoted
    }

    /// True if standard output is for people, or a scene made from foreign files.
    fn prints_text(&self) -> bool {
        let is_report = self
            .words
            .iter()
            .any(|word| ["--explain", "count", "check", "svg", "ps"].contains(word));
        is_report || self.words[0] == "ugmesh"
    }

    #[track_caller]
    fn check_text(&self, bytes: &[u8]) -> bool {
        let text = String::from_utf8_lossy(bytes);
        let Self { words, files } = self;
        let obeyed = text.chars().find(|&c| is_dangerous(c));
        assert_eq!(obeyed, None, "{words:?} {files:?}: {}", text.escape_debug());
        let is_forged = text.lines().any(|line| line.starts_with("ugparse: error: forged"));
        assert!(!is_forged, "{words:?} {files:?}: {text}");
        text.contains('\u{fffd}') || text.contains("\\u009b")
    }
}

/// Without the styles that programs add themselves: `ESC [ … m`.
fn without_styles(text: &str) -> String {
    let mut plain = String::new();
    let mut parts = text.split("\u{1b}[");
    plain.push_str(parts.next().unwrap());
    for part in parts {
        match part.split_once('m') {
            Some((style, rest)) if style.bytes().all(|b| b.is_ascii_digit() || b == b';') => {
                plain.push_str(rest)
            }
            _ => plain.push_str(&format!("\u{1b}[{part}")),
        }
    }
    plain
}

fn json_escaped(text: &str) -> String {
    text.chars().map(|c| if c < ' ' { format!("\\u{:04x}", c as u32) } else { c.into() }).collect()
}

/// A GLB file of one chunk.
fn glb(mut json: Vec<u8>) -> Vec<u8> {
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut bytes = b"glTF\x02\0\0\0".to_vec();
    bytes.extend((20 + json.len() as u32).to_le_bytes());
    bytes.extend((json.len() as u32).to_le_bytes());
    bytes.extend(b"JSON");
    bytes.extend(json);
    bytes
}

/// A picture with a history.
fn png(history: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::new();
    image::RgbImage::new(40, 30)
        .write_to(&mut Cursor::new(&mut bytes), image::ImageFormat::Png)
        .unwrap();
    let body = [b"iTXtComment\0\0\0\0\0", history].concat();
    let step = |crc: u32| if crc & 1 == 1 { 0xedb8_8320 ^ (crc >> 1) } else { crc >> 1 };
    let crc = !body
        .iter()
        .fold(!0u32, |crc, &byte| (0..8).fold(crc ^ u32::from(byte), |crc, _| step(crc)));
    let mut chunk = (body.len() as u32 - 4).to_be_bytes().to_vec();
    chunk.write_all(&body).unwrap();
    chunk.write_all(&crc.to_be_bytes()).unwrap();
    // Behind the signature and the header.
    drop(bytes.splice(33..33, chunk));
    bytes
}

/// Checks every template; those of `quoted` must be quoted in what is printed.
#[track_caller]
fn check_files(words: &[&str], name: &str, quoted: &[&str], others: &[&str]) {
    for (idx, content) in quoted.iter().chain(others).enumerate() {
        let is_quoted = Case { words, files: &[(name, content)] }.check();
        assert!(is_quoted || idx >= quoted.len(), "{words:?} does not quote {content:?}");
    }
}

const TRIANGLE: &str = "v a 0 0 5; v b 1 0 5; v c 0 1 5; f (a b c);";

#[test]
fn fields_of_scenes() {
    check_files(
        &["ugparse", "scene.ug", "--allow-execute"],
        "scene.ug",
        &[
            "v @ 0 0 1;",
            "v a 0 0 @;",
            "@ 1 2;",
            "# 1 \"@\"\nf (a b c);",
            "# 1 \"@\"\n                                                                                      \
             \u{20}                                                                                    f (a b c);",
            "include \"@\";",
            "include @;",
            "execute \"@\";",
            "{@} f (a b c);",
            "v a 0 0 0; f (a a @);",
            "def @; end;",
            "i (@);",
            "cam -@ 1;",
        ],
        &["(@) x;", "( ug @ )", "(@"],
    );
    check_files(&["ugparse", "scene.ug", "-lax"], "scene.ug", &["@ 1 2;"], &["# @\n", "(@)"]);
    check_files(
        &["ugparse", "check", "-format", "json", "scene.ug"],
        "scene.ug",
        &["# 1 \"@\"\nf (a b c);", "v @ 0 0 1;"],
        &[],
    );
    let scene = format!("# 1 \"@\"\n{TRIANGLE}");
    check_files(&["ugparse", "count", "scene.ug"], "scene.ug", &[], &[&scene]);
    for format in ["text", "json"] {
        let explain = ["ugrainbow", "scene.ug", "-sz", "9", "9", "--explain", "4,4", "-dt", format];
        let camera = "cam -ep 0 0 0 -vc .3 .3 5 -va 9 9;";
        check_files(&explain, "scene.ug", &[&format!("# 1 \"@\"\n{camera} {TRIANGLE}")], &[]);
    }
    for program in ["uglorentz", "ugdoppler", "ugrainbow"] {
        check_files(
            &[program, "scene.ug"],
            "scene.ug",
            &["# 1 \"@\"\nf (a b c);", "v @ 0 0 0;"],
            &[],
        );
    }
    for script in ["#!/bin/sh\nprintf '%s' '@' >&2\nexit 3\n", "#!/bin/sh\nprintf '%s' '@' >&2\n"] {
        let files = [("scene.ug", "execute \"./say.sh\";"), ("say.sh", script)];
        assert!(Case { words: &["ugparse", "scene.ug", "--allow-execute"], files: &files }.check());
    }
}

#[test]
fn fields_of_meshes() {
    let points = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    let obj = [
        "v 0 0 @\n",
        "v 0 0 0 1 1 @\n",
        &format!("{points}f 1 2 @\n"),
        &format!("{points}usemtl @\nf 1 2 3\n"),
        &format!("mtllib @\n{points}f 1 2 3\n"),
        &format!("# @\n{points}f 1 2 3\n"),
    ];
    check_files(
        &["ugmesh", "mesh.obj"],
        "mesh.obj",
        &obj,
        &["vn @ 0 0\n", "@ 1\n", "v 0 0 0\nf 1//@ 1 1\n"],
    );
    let mesh = format!("mtllib a.mtl\n{points}usemtl @\nf 1 2 3\n");
    let files = [("mesh.obj", mesh.as_str()), ("a.mtl", "newmtl x@\nKd @ 1 1\n@ 2\n")];
    assert!(Case { words: &["ugmesh", "mesh.obj"], files: &files }.check());

    let off = [
        "OFF\n1 1 0\n0 0 @\n",
        "OFF\n1 1 0\n0 0 0\n3 0 @ 0\n",
        "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 @ 1 1\n",
    ];
    check_files(
        &["ugmesh", "mesh.off"],
        "mesh.off",
        &off,
        &["@OFF\n3 1 0\n", "OFF\n@ 1 0\n", "4OFF @\n3 1 0\n"],
    );

    let stl = ["solid x\n@ 1\n", "solid\nfacet\nouter loop\nvertex 0 0 @\n"];
    check_files(&["ugmesh", "mesh.stl"], "mesh.stl", &stl, &["solid @\nendsolid @\n"]);

    let ply = "ply\nformat ascii 1.0\ncomment x\nelement vertex 3\nproperty float x\nproperty float y\n\
               property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n\
               0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    let fields = [
        "ascii",
        "comment",
        "vertex 3",
        "float x",
        " z",
        "face",
        "uchar",
        "vertex_indices",
        "0 1 0",
    ];
    let damaged = fields.map(|field| ply.replace(field, "@"));
    check_files(
        &["ugmesh", "mesh.ply"],
        "mesh.ply",
        &[&ply.replace("comment x", "comment @")],
        &damaged.each_ref().map(String::as_str),
    );

    let gltf = r#"{"asset":{"version":"2.0","copyright":"me"},"extensionsRequired":["E"],
        "buffers":[{"uri":"d.bin","byteLength":36}],"bufferViews":[{"buffer":0,"byteLength":36}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],
        "meshes":[{"name":"m","primitives":[{"attributes":{"POSITION":0}}]}],
        "nodes":[{"mesh":0,"name":"n"}],"scenes":[{"nodes":[0]}],"scene":0}"#;
    let plain = gltf.replace(r#""extensionsRequired":["E"],"#, "");
    for name in ["mesh.gltf", "mesh.glb"] {
        let quoted = [
            gltf.replace("\"E\"", "\"@\""),
            plain.replace("d.bin", "@"),
            plain.replace("d.bin", "http://@"),
            plain.replace("d.bin", "%1b%9b%0a@"),
        ];
        let fields = ["2.0", "me", "VEC3", "\"m\"", "POSITION", "\"n\"", "\"mesh\""];
        let damaged = fields.map(|field| plain.replace(field, "@"));
        check_files(
            &["ugmesh", name],
            name,
            &quoted.each_ref().map(String::as_str),
            &damaged.each_ref().map(String::as_str),
        );
    }
}

#[test]
fn labels_and_histories_of_pictures() {
    for format in ["svg", "ps"] {
        let files = [("@.png", "x"), ("b.png", "uglorentz -vel .5 0 0 --title '@'\n@")];
        for label in [
            ["-lb", "names"].as_slice(),
            &["-label", "@", "-label", "b@"],
            &["-title", "@"],
            &["-cap", "@"],
        ] {
            let words = [&["ugsheet", "@.png", "b.png", "-dt", format], label].concat();
            for payload in PAYLOADS {
                let files = files.map(|(name, content)| (name.replace('@', payload), content));
                let files = files.each_ref().map(|(name, content)| (name.as_str(), *content));
                let case = Case { words: &words, files: &files };
                let output = case.run(payload, false);
                case.check_text(&output.stderr);
                assert!(
                    !String::from_utf8_lossy(&output.stdout).contains(is_dangerous),
                    "{words:?}"
                );
                if format == "ps" {
                    let is_plain =
                        |byte: &u8| byte.is_ascii_graphic() || matches!(byte, b' ' | b'\n');
                    assert!(output.stdout.iter().all(is_plain), "{words:?}");
                } else if output.status.success() {
                    assert_well_formed(&String::from_utf8(output.stdout).unwrap());
                }
            }
        }
    }
}

/// Tags are closed in order, and `<` and `&` occur only in markup.
#[track_caller]
fn assert_well_formed(xml: &str) {
    let mut open = Vec::new();
    for part in xml.split('<').skip(1) {
        let (tag, text) = part.split_once('>').unwrap_or_else(|| panic!("not closed: {part}"));
        assert!(!text.contains('>'), "{text}");
        for reference in text.split('&').skip(1) {
            assert!(
                ["lt;", "gt;", "amp;", "quot;"].iter().any(|name| reference.starts_with(name)),
                "{text}"
            );
        }
        match tag.strip_prefix('/') {
            Some(name) => assert_eq!(open.pop(), Some(name)),
            None if tag.ends_with(['/', '?']) => {}
            None => open.push(tag.split_whitespace().next().unwrap()),
        }
    }
    assert!(open.is_empty(), "{open:?}");
}

/// The long options of a program, with the number of their values.
fn options(program: &[&str]) -> Vec<(String, usize)> {
    let help =
        Command::new(PROGRAMS.join(program[0])).args(&program[1..]).arg("--help").output().unwrap();
    let help = String::from_utf8(help.stdout).unwrap();
    // `  -vel, --velocity X Y Z`
    let option = |line: &str| {
        let option = line.strip_prefix("  ").filter(|option| option.starts_with('-'))?;
        let words: Vec<&str> = option.split(' ').collect();
        let (names, values): (Vec<&str>, Vec<&str>) =
            words.iter().partition(|word| word.starts_with('-'));
        let long =
            names.iter().map(|name| name.trim_end_matches(',')).find(|name| name.len() > 2)?;
        let n_needed = values.iter().filter(|value| !value.starts_with('[')).count();
        Some((format!("--{}", long.trim_start_matches('-')), n_needed))
    };
    let options: Vec<_> = help.lines().filter_map(option).collect();
    assert!(options.len() > 8, "{help}");
    options
}

#[test]
fn options_and_file_names() {
    let mesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    let files = [("scene.ug", TRIANGLE), ("mesh.obj", mesh), ("picture.png", "x")];
    let programs: [(&[&str], &str); 10] = [
        (&["uglorentz"], "scene.ug"),
        (&["ugdoppler"], "scene.ug"),
        (&["ugrainbow"], "scene.ug"),
        (&["ugmesh"], "mesh.obj"),
        (&["ugsheet"], "picture.png"),
        (&["ugparse"], "scene.ug"),
        (&["ugparse", "check"], "scene.ug"),
        (&["ugparse", "tidy"], "scene.ug"),
        (&["ugparse", "flatten"], "scene.ug"),
        (&["ugparse", "count"], "scene.ug"),
    ];
    let mut n_quoted = 0;
    for (program, input) in programs {
        for (option, n_values) in options(program) {
            let words =
                [program, &[option.as_str()], &vec!["@"; n_values.max(1)], &[input]].concat();
            n_quoted += usize::from(Case { words: &words, files: &files }.check());
        }
        for words in [["--@", input].as_slice(), &["-@", input], &["@"], &[input, "@"], &["--fi=@"]]
        {
            let words = [program, words].concat();
            assert!(Case { words: &words, files: &files }.check(), "{words:?}");
        }
    }
    assert!(n_quoted > 60, "{n_quoted}");
}
