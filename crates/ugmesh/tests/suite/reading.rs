//! Tests of reading each format.

use ugmesh::{Axis, Config, MeshFile, Size};
use ugpipe::Words;

use crate::common::{
    Encoding, convert, floats, glb, glb_with_nodes, ply, seen, statements, stl_binary, stl_text,
    to_scene,
};

fn z_up() -> Config {
    Config { up: Some(Axis::Z), ..Config::default() }
}

#[test]
#[rustfmt::skip] // rows of a table
fn text_formats_become_scenes() {
    #[track_caller]
    fn check(name: &str, text: &str, expected: &str) {
        let lines: Vec<&str> = expected.lines().map(str::trim).collect();
        assert_eq!(statements(&to_scene(&z_up(), name, text)).trim_end(), lines.join("\n"), "{text}");
    }
    let square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
    let points = "v v1 0 0 0;\nv v2 1 0 0;\nv v3 1 1 0;\nv v4 0 1 0;\n";
    check("polygons stay.obj", &format!("{square}f 1 2 3 4"), &format!("{points}f (v1 v2 v3 v4);"));
    check("from the end.obj", &format!("{square}f -4 -3 -1"), &format!("{points}f (v1 v2 v4);"));
    check("joined lines.obj", &format!("{square}f 1 2\\\n3"), &format!("{points}f (v1 v2 v3);"));
    check(
        "texture seams and groups part nothing.obj",
        &format!("{square}vt 0 0\nvt 1 1\ng a\nf 1/1 2/1 3/1\ng b\nf 1/2 3/2 4/2"),
        &format!("{points}f a (v1 v2 v3);\nf b (v1 v3 v4);"),
    );
    check(
        "a second normal makes a second vertex, behind all others.obj",
        "vn 0 0 1\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1//1 2//1 3//1\nvn 1 0 0\nvn 0 0 1\nv 0 0 1\nf 1//2 3//3 4",
        "v v1 0 0 0 0 0 1;\nv v2 1 0 0 0 0 1;\nv v3 0 1 0 0 0 1;\nv v4 0 0 1;\nv v5 0 0 0 1 0 0;
         f (v1 v2 v3);\nf (v5 v3 v4);",
    );
    check(
        "colours of vertices, each once.obj",
        "v 0 0 0 1 0.5 0\nv 1 0 0 1 .5 0.0\nv 0 1 0 0 0 1\nv 0 0 1 1\nf 1 2 3",
        "c_rgb c1 1 0.5 0;\nc_rgb c2 0 0 1;
         v v1 0 0 0 c1;\nv v2 1 0 0 c1;\nv v3 0 1 0 c2;\nv v4 0 0 1;\nf (v1 v2 v3);",
    );
    check(
        "corners that repeat, and faces without area.obj",
        &format!("{square}f 1 1 2 3 1\nf 1 2 1\nf 1 2 2\nf 1 2"),
        &format!("{points}f (v1 v2 v3);"),
    );
    check("minus nought.obj", "v -0 -0.0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3", "v v1 0 0 0;\nv v2 1 0 0;\nv v3 0 1 0;\nf (v1 v2 v3);");
    check(
        "numbers to the bit.obj",
        "v 0.1 1e-7 123456789.123456789\nv 1 0 0\nv 0 1 0\nf 1 2 3",
        "v v1 0.1 1e-7 123456789.12345679;\nv v2 1 0 0;\nv v3 0 1 0;\nf (v1 v2 v3);",
    );

    let off = "3 1 0\n0 0 0\n1 0 0 # a corner\n\n0 1 0\n3 0 1 2";
    let triangle = "v v1 0 0 0;\nv v2 1 0 0;\nv v3 0 1 0;\n";
    check("plain.off", &format!("OFF\n{off}"), &format!("{triangle}f (v1 v2 v3);"));
    check("counts behind the keyword.off", &format!("OFF {off}"), &format!("{triangle}f (v1 v2 v3);"));
    check("no keyword.off", off, &format!("{triangle}f (v1 v2 v3);"));
    check("a face with a colour in bytes.off", &format!("OFF\n{off} 255 0 51"), &format!("c_rgb c1 1 0 0.2;\n{triangle}f (v1 v2 v3) c1;"));
    check("a face with a clear colour.off", &format!("OFF\n{off} 1.0 0.0 0.2 0.75"), &format!("c_rgb c1 1 0 0.2 0.25;\n{triangle}f (v1 v2 v3) c1;"));
    check(
        "one real number makes a colour real.off",
        &format!("OFF\n{off} 0.286 0.226 0.159 1"),
        &format!("c_rgb c1 0.286 0.226 0.159;\n{triangle}f (v1 v2 v3) c1;"),
    );
    check(
        "one real number in the file makes zeros and ones real.off",
        "COFF\n3 1 0\n0 0 0 1 1 1 1\n1 0 0 1 0 0 1\n0 1 0 1 1 1 1\n3 0 1 2 0 1 0 .5",
        "c_rgb c1 1 1 1;\nc_rgb c2 1 0 0;\nc_rgb c3 0 1 0 0.5;\n\
         v v1 0 0 0 c1;\nv v2 1 0 0 c2;\nv v3 0 1 0 c1;\nf (v1 v2 v3) c3;",
    );
    check("integers alone are bytes.off", &format!("OFF\n{off} 0 1 0 255"), &format!("c_rgb c1 0 {} 0;\n{triangle}f (v1 v2 v3) c1;", 1.0 / 255.0));
    check("a row of a colour map.off", &format!("OFF\n{off} 7"), &format!("{triangle}f (v1 v2 v3);"));
    check(
        "colours and normals of vertices.off",
        "CNOFF\n3 1 0\n0 0 0  0 0 1  0 255 0 255\n1 0 0  0 0 1  0.0 1.0 0.0\n0 1 0  0 0 0  0 0 255\n3 0 1 2",
        "c_rgb c1 0 1 0;\nc_rgb c2 0 0 1;
         v v1 0 0 0 c1 0 0 1;\nv v2 1 0 0 c1 0 0 1;\nv v3 0 1 0 c2;\nf (v1 v2 v3);",
    );
    check(
        "strips of triangles.ply",
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
         element tristrips 1\nproperty list int int vertex_indices\nend_header\n\
         0 0 0\n1 0 0\n0 1 0\n1 1 0\n8 0 1 2 3 -1 0 1 3",
        "v v1 0 0 0;\nv v2 1 0 0;\nv v3 0 1 0;\nv v4 1 1 0;\nf (v1 v2 v3);\nf (v3 v2 v4);\nf (v1 v2 v4);",
    );
    check(
        "a face with a colour.ply",
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n\
         property list uchar uint vertex_index\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n\
         end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 255 0 51\n",
        &format!("c_rgb c1 1 0 0.2;\n{triangle}f (v1 v2 v3) c1;"),
    );
}

#[test]
fn encodings_of_ply_give_the_same_scene() {
    let [ascii, little, big] = [Encoding::Ascii, Encoding::Little, Encoding::Big].map(|encoding| {
        let scene = to_scene(&Config::default(), "<stdin>", ply(encoding));
        assert!(scene.head.comments[0].contains("free for all"), "{:?}", scene.head.comments);
        statements(&scene)
    });
    let unit = [0.6f32, 0.8].map(f64::from);
    let expected = format!(
        "c_rgb c1 1 0 0;\nc_rgb c2 1 0.2 0;\nc_rgb c3 1 0.4 0;\nc_rgb c4 1 0.6 0;\nc_rgb c5 1 0.8 0;\n\
         v v1 0 0 0 c1 0 {0} {1};\nv v2 1 0 {2} c2 0 {0} {1};\nv v3 1 1 {3} c3 0 {0} {1};\n\
         v v4 0 1 {4:e} c4 0 {0} {1};\nv v5 0.5 2 0 c5 0 {0} {1};\nf (v1 v2 v3 v4);\nf (v4 v3 v5);\n",
        unit[0],
        unit[1],
        f64::from(0.1f32) / 3.0,
        f64::from(-0.3f32) / 3.0,
        f64::from(1e-7f32) / 3.0
    );
    assert_eq!(little, expected);
    assert_eq!(big, expected);
    // Normals in ASCII are rounded to 32 bits, too.
    assert_eq!(ascii, expected);
}

#[test]
fn ascii_and_binary_stl_give_the_same_scene() {
    let [text, binary] =
        [stl_text(), stl_binary()].map(|bytes| to_scene(&Config::default(), "<stdin>", bytes));
    assert_eq!(statements(&text), statements(&binary));
    let (x, y, z) = (f64::from(0.1f32), f64::from(0.2f32), f64::from(0.3f32));
    assert_eq!(
        statements(&text),
        format!(
            "v v1 0 0 0;\nv v2 0 1 0;\nv v3 1 0 0;\nv v4 {x} {y} {z};\n\
             f (v1 v2 v3);\nf (v1 v3 v4);\nf (v1 v4 v2);\nf (v3 v2 v4);\n"
        )
    );
}

#[test]
fn gltf_node_transforms_are_applied() {
    /// `expected` is the transformed point (1 1 1), and `normal` the transformed normal (1 1 0),
    /// with y up.
    #[track_caller]
    fn check(nodes: &str, expected: [f64; 3], normal: [f64; 3]) {
        let config = Config { up: Some(Axis::Z), ..Config::default() };
        let scene = to_scene(&config, "<stdin>", glb_with_nodes(nodes));
        let corner = seen(&scene)[0]
            .iter()
            .find(|corner| distance(corner.position, expected) < 1e-14)
            .cloned();
        let corner =
            corner.unwrap_or_else(|| panic!("nothing at {expected:?}: {:?}", seen(&scene)));
        let length = normal.iter().map(|x| x * x).sum::<f64>().sqrt();
        let found = corner.normal.unwrap();
        assert!(distance(found, normal.map(|x| x / length)) < 1e-14, "{found:?}");
    }
    fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
        a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    }
    let quarter_about_z = "[0,0,0.7071067811865476,0.7071067811865476]";
    check(r#"[{"mesh":0}]"#, [1.0, 1.0, 1.0], [1.0, 1.0, 0.0]);
    // Computed with 64 bits: 0.1 differs from its 32-bit value.
    check(r#"[{"mesh":0,"translation":[0.1,0.2,0.3]}]"#, [1.1, 1.2, 1.3], [1.0, 1.0, 0.0]);
    // (1 1 1) is scaled to (2 3 4), translated to (3 5 7), rotated to (-5 3 7), translated to (5 23
    // 37). The normal is divided by the scale to (1/2 1/3 0) and rotated to (-1/3 1/2 0).
    check(
        &format!(
            r#"[{{"children":[1],"translation":[10,20,30],"rotation":{quarter_about_z}}},
                {{"mesh":0,"scale":[2,3,4],"translation":[1,2,3]}}]"#
        ),
        [5.0, 23.0, 37.0],
        [-1.0 / 3.0, 0.5, 0.0],
    );
    // Rotated to (-1 1 1), then scaled by a grandparent to (-2 1 1), which no single scale and
    // rotation can express.
    check(
        &format!(
            r#"[{{"children":[2],"scale":[2,1,1]}},{{"mesh":0,"rotation":{quarter_about_z}}},{{"children":[1]}}]"#
        ),
        [-2.0, 1.0, 1.0],
        [-0.5, 1.0, 0.0],
    );
    // A column-major matrix: x goes to y, y to z, z to x, with a translation.
    check(
        r#"[{"mesh":0,"matrix":[0,1,0,0, 0,0,1,0, 1,0,0,0, 5,6,7,1]}]"#,
        [6.0, 7.0, 8.0],
        [0.0, 1.0, 1.0],
    );
}

#[test]
fn reflected_nodes_keep_their_orientation() {
    let order = |nodes: &str| -> Vec<[f64; 3]> {
        let scene = to_scene(&z_up(), "<stdin>", glb_with_nodes(nodes));
        seen(&scene)[0].iter().map(|corner| corner.position).collect()
    };
    assert_eq!(order(r#"[{"mesh":0}]"#), [[0.0, 0.0, 0.0], [1.0, 1.0, 1.0], [0.0, 1.0, 0.0]]);
    assert_eq!(
        order(r#"[{"mesh":0,"scale":[-1,1,1]}]"#),
        [[0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-1.0, 1.0, 1.0]]
    );
}

/// One primitive of five vertices, a flat strip. `extra` is added to its attributes and `more` to
/// the document.
fn gltf_strip(mode: u32, extra: &str, more: &str, colors: &[u8]) -> Vec<u8> {
    let positions = floats(&[0., 0., 0., 1., 0., 0., 0., 1., 0., 1., 1., 0., 0., 2., 0.]);
    let bytes = [positions, colors.to_vec()].concat();
    let json = format!(
        r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0}}],
        "meshes":[{{"primitives":[{{"mode":{mode},"attributes":{{"POSITION":0{extra}}}}}]}}],
        "accessors":[
          {{"bufferView":0,"componentType":5126,"count":5,"type":"VEC3","min":[0,0,0],"max":[1,2,0]}},
          {{"bufferView":1,"componentType":5121,"normalized":true,"count":5,"type":"VEC4"}}],
        "bufferViews":[{{"buffer":0,"byteLength":60}},{{"buffer":0,"byteOffset":60,"byteLength":20}}],
        "buffers":[{{"byteLength":80}}]{more}}}"#
    );
    glb(&json, &bytes)
}

#[test]
fn strips_fans_and_colours_of_gltf() {
    #[track_caller]
    fn check(bytes: Vec<u8>, expected: &str) {
        let text = statements(&to_scene(&z_up(), "<stdin>", bytes));
        let lines: Vec<&str> = text.lines().filter(|line| !line.starts_with("v ")).collect();
        assert_eq!(lines.join(" "), expected);
    }
    let white = [255; 20];
    check(gltf_strip(4, "", "", &white), "f (v1 v2 v3);");
    check(gltf_strip(5, "", "", &white), "f (v1 v2 v3); f (v3 v2 v4); f (v3 v4 v5);");
    check(gltf_strip(6, "", "", &white), "f (v1 v2 v3); f (v1 v3 v4); f (v1 v4 v5);");
    // Linear 0.5 display-encoded, level 188 of 255.
    let half = 0.7353569830524495;
    let linear = r#","materials":[{"pbrMetallicRoughness":{"baseColorFactor":[1,0.5,0,0.25]}}]"#;
    let red = [255, 0, 0, 128].repeat(5);
    let with = |attributes: &str, material: &str| gltf_strip(4, attributes, material, &red);
    let given = |text: Vec<u8>| {
        // Adds a material to the primitive, after its mode.
        let json_len = u32::from_le_bytes(text[12..16].try_into().unwrap()) as usize;
        let json = String::from_utf8_lossy(&text[20..20 + json_len]).into_owned();
        assert!(json.contains("\"mode\":4"));
        let json = json.replacen("\"mode\":4", "\"mode\":4,\"material\":0", 1);
        glb(json.trim_end(), &text[28 + json_len..])
    };
    check(given(with("", linear)), &format!("c_rgb c1 1 {half} 0; f (v1 v2 v3) c1;"));
    // Only a material with alpha mode BLEND is transparent.
    let blend = linear.replace("[{", r#"[{"alphaMode":"BLEND","#);
    check(given(with("", &blend)), &format!("c_rgb c1 1 {half} 0 0.75; f (v1 v2 v3) c1;"));
    // The colours of vertex and material are multiplied.
    check(given(with(r#","COLOR_0":1"#, linear)), "c_rgb c1 1 0 0; f (v1 v2 v3);");
    check(with(r#","COLOR_0":1"#, ""), "c_rgb c1 1 0 0; f (v1 v2 v3);");
}

#[test]
fn lines_end_with_line_feeds_or_carriage_returns() {
    let materials = "# by hand\nnewmtl red\nKd 1 0 0\n";
    let scene = |name: &str, text: &[u8], ends: &str| {
        let beside = |_: &str, _: u64| Ok(materials.replace('\n', ends).into_bytes());
        let converted = ugmesh::run(&z_up(), &MeshFile::new(name, text).with_files(&beside));
        String::from_utf8(converted.unwrap_or_else(|error| panic!("{name}: {error}")).bytes)
            .unwrap()
    };
    let triangle = "0 0 0\n1 0 0\n0 1 0\n";
    let facet = triangle
        .replace("0 0 0", "vertex 0 0 0")
        .replace("\n1", "\nvertex 1")
        .replace("\n0", "\nvertex 0");
    for (name, text) in [
        (
            "a.obj",
            "# a tile\nmtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 \\\n3\n"
                .to_owned(),
        ),
        ("content", "# a tile\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n".to_owned()),
        ("a.off", format!("OFF # a tile\n3 1 0\n{triangle}3 0 1 2\n")),
        ("a.stl", format!("solid\nfacet\nouter loop\n{facet}endloop\nendfacet\nendsolid\n")),
    ] {
        let expected = scene(name, text.as_bytes(), "\n");
        assert!(expected.contains("f (v1 v2 v3)"), "{expected}");
        for ends in ["\r\n", "\r"] {
            assert_eq!(
                scene(name, text.replace('\n', ends).as_bytes(), ends),
                expected,
                "{ends:?}"
            );
        }
    }
    for encoding in [Encoding::Ascii, Encoding::Little, Encoding::Big] {
        let file = ply(encoding);
        let head = file.windows(11).position(|word| word == b"end_header\n").unwrap() + 11;
        let n_text = if encoding == Encoding::Ascii { file.len() } else { head };
        let mut returns = file.clone();
        returns[..n_text].iter_mut().filter(|byte| **byte == b'\n').for_each(|byte| *byte = b'\r');
        assert_eq!(scene("a.ply", &returns, "\r"), scene("a.ply", &file, "\n"), "{encoding:?}");
    }
}

#[test]
fn files_beside_the_mesh() {
    let beside = |name: &str, _limit: u64| -> std::io::Result<Vec<u8>> {
        let materials = "# made by hand\nnewmtl deep red\n Kd 0.5 0 0\nd 0.75\nnewmtl bare\nnewmtl white\nKd 1\n";
        match name {
            "my colours.mtl" => Ok(materials.into()),
            "a b.bin" => Ok(floats(&[0., 0., 0., 1., 0., 0., 0., 1., 0.])),
            _ => Err(std::io::ErrorKind::NotFound.into()),
        }
    };
    let run = |name: &str, text: &str| {
        ugmesh::run(&z_up(), &MeshFile::new(name, text).with_files(&beside))
            .unwrap_or_else(|error| panic!("{error}"))
    };
    let points = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    let faces = "usemtl deep red\nf 1 2 3\nusemtl bare\nf 1 3 2\nusemtl white\nf 1 3 2";
    let obj = run("a.obj", &format!("mtllib my colours.mtl\n{points}{faces}"));
    let text = String::from_utf8(obj.bytes).unwrap();
    let colours = "c_rgb deep_red 0.5 0 0 0.25;\nc_rgb bare 0.8 0.8 0.8;\nc_rgb white 1 1 1;\n";
    assert!(text.contains(colours), "{text}");
    assert!(
        text.ends_with("f (v1 v2 v3) deep_red;\nf (v1 v3 v2) bare;\nf (v1 v3 v2) white;\n"),
        "{text}"
    );
    assert!(obj.warnings.is_empty(), "{:?}", obj.warnings);

    let missing = run("a.obj", &format!("mtllib none.mtl\n{points}usemtl red\nf 1 2 3"));
    assert_eq!(
        missing.warnings,
        [
            "colours are missing: cannot read `none.mtl`: entity not found",
            "materials without colour: `red`"
        ]
    );

    let gltf = |uri: &str| {
        format!(
            r#"{{"asset":{{"version":"2.0"}},"nodes":[{{"mesh":0}}],
            "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}}}}]}}],
            "accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}}],
            "bufferViews":[{{"buffer":0,"byteLength":36}}],"buffers":[{{"byteLength":36,"uri":"{uri}"}}]}}"#
        )
    };
    let triangle = "v v1 0 0 0;\nv v2 1 0 0;\nv v3 0 1 0;\nf (v1 v2 v3);\n";
    // The bytes of 1.0 are 00 00 80 3f.
    let data =
        "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";
    for uri in ["a%20b.bin", data] {
        let text = String::from_utf8(run("a.gltf", &gltf(uri)).bytes).unwrap();
        assert!(text.ends_with(triangle), "{uri}: {text}");
    }
    let error =
        ugmesh::run(&z_up(), &MeshFile::new("a.gltf", gltf("none.bin")).with_files(&beside))
            .unwrap_err();
    assert_eq!(
        error.to_string(),
        "cannot read `a.gltf` as glTF: cannot read `none.bin`: entity not found; put it in the folder of the mesh"
    );
}

#[test]
fn objects_groups_and_materials_keep_their_names() {
    fn check(obj: &str, expected: &str) {
        let beside = |_: &str, _: u64| -> std::io::Result<Vec<u8>> {
            Ok(b"newmtl 1 red\nKd 1 0 0\nnewmtl 1-red\nKd 1 0 0\nnewmtl c1\nKd 0 1 0\nnewmtl \xc3\xa9\nKd 0 0 1\n".to_vec())
        };
        let text = format!("mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n{obj}");
        let converted =
            ugmesh::run(&z_up(), &MeshFile::new("a.obj", text).with_files(&beside)).unwrap();
        assert_eq!(converted.warnings, [""; 0]);
        let text = String::from_utf8(converted.bytes).unwrap();
        let found: Vec<&str> = text.lines().filter(|line| line.starts_with(['c', 'f'])).collect();
        assert_eq!(found.join("\n"), expected, "{obj}");
    }
    let face = "f 1 2 3";
    check(&format!("{face}\no hull\n{face}"), "f (v1 v2 v3);\nf hull (v1 v2 v3);");
    // A group belongs to its object; the standard calls faces outside of groups `default`.
    check(
        &format!("o hull\ng left wing\n{face}\ng\n{face}\no fin\n{face}\ng x\ng default\n{face}"),
        "f left_wing (v1 v2 v3);\nf hull (v1 v2 v3);\nf fin (v1 v2 v3);\nf fin (v1 v2 v3);",
    );
    check(&format!("g \u{e9}\u{e9}\n{face}\ng 2:a#\n{face}"), "f (v1 v2 v3);\nf _2_a_ (v1 v2 v3);");
    check(&format!("g {}\n{face}", "x".repeat(1000)), &format!("f {} (v1 v2 v3);", "x".repeat(64)));
    // Names are unique, and materials of one colour are two colours.
    check(
        &format!(
            "usemtl 1 red\n{face}\nusemtl 1-red\n{face}\nusemtl \u{e9}\n{face}\nusemtl c1\n{face}"
        ),
        "c_rgb _1_red 1 0 0;\nc_rgb c2 0 0 1;\nc_rgb c1 0 1 0;\n\
         f (v1 v2 v3) _1_red;\nf (v1 v2 v3) _1_red;\nf (v1 v2 v3) c2;\nf (v1 v2 v3) c1;",
    );
}

#[test]
fn placing() {
    #[track_caller]
    fn check(config: Config, expected: &str) {
        let text = statements(&to_scene(&config, "a.obj", "v 1 2 3\nv 5 2 3\nv 1 4 3\nf 1 2 3"));
        let points: Vec<&str> = text.lines().filter_map(|line| line.strip_prefix("v v")).collect();
        assert_eq!(points.join(" "), expected);
    }
    let with = |up, size, is_centered| Config { up, size, is_centered, ..Config::default() };
    check(with(None, Size::Same, false), "1 1 -3 2; 2 5 -3 2; 3 1 -3 4;");
    check(with(Some(Axis::Z), Size::Same, false), "1 1 2 3; 2 5 2 3; 3 1 4 3;");
    check(with(Some(Axis::X), Size::Same, false), "1 2 3 1; 2 2 3 5; 3 4 3 1;");
    check(with(Some(Axis::Z), Size::Times(0.5), false), "1 0.5 1 1.5; 2 2.5 1 1.5; 3 0.5 2 1.5;");
    check(
        with(Some(Axis::Z), Size::Fit(1.0), false),
        "1 0.25 0.5 0.75; 2 1.25 0.5 0.75; 3 0.25 1 0.75;",
    );
    check(with(Some(Axis::Z), Size::Fit(8.0), true), "1 -4 -2 0; 2 4 -2 0; 3 -4 2 0;");
}

#[test]
fn scaling_out_of_range_is_an_error() {
    #[track_caller]
    fn check(size: Size, x: &str) {
        let config = Config { size, ..Config::default() };
        let error = convert(&config, "a.obj", format!("v {x} 2 3\nv -{x} 2 3\nv 1 4 3\nf 1 2 3"))
            .unwrap_err();
        assert_eq!(
            error.words(),
            "scaled coordinates are out of range; choose another -scale or -fit"
        );
    }
    check(Size::Times(1e300), "1e10");
    check(Size::Fit(1.0), "1.7e308");
}

#[test]
fn errors_name_the_problem_and_line() {
    #[track_caller]
    fn check(name: &str, bytes: impl Into<Vec<u8>>, expected: &str) {
        assert_eq!(convert(&Config::default(), name, bytes).unwrap_err().words(), expected);
    }
    check(
        "a",
        "",
        "cannot detect the format of `a`; give it with -if ug, obj, ply, stl, off or gltf",
    );
    let scene = "the input is already a UniGrafix scene; choose an output format with -dt obj, ply, gltf, glb or vtp";
    check("a.ug", "", scene);
    let of = |name: &str, format: &str, bytes: &[u8], problem: &str| {
        check(name, bytes, &format!("cannot read `{name}` as {format}: {problem}"));
    };
    let stl = |bytes: &[u8], problem: &str| of("a.stl", "STL", bytes, problem);
    let obj = |text: &str, problem: &str| of("a.obj", "OBJ", text.as_bytes(), problem);
    obj("v 1 2", "line 1: a vertex needs 3 numbers or more");
    obj("v 0 0 0\nv 1 2 nan", "line 2: `nan` in a vertex is not a finite number");
    obj("v 0 0 0\nf 1 2 3", "line 2: a face refers to vertex `2`, but there are 1 before it");
    obj("v 0 0 0\nf 0 1 1", "line 2: a face refers to vertex `0`, but there are 1 before it");
    obj("one\ntwo", "line 1: this is not an OBJ file: no line of it is a statement of OBJ");
    let page = "<!DOCTYPE html>\n<html></html>";
    obj(page, "it is a web page; download the file itself");
    let pointer = "version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 5\n";
    obj(pointer, "it is a Git LFS pointer; fetch the file itself with `git lfs pull`");
    stl(pointer.as_bytes(), "it is a Git LFS pointer; fetch the file itself with `git lfs pull`");
    stl(b"\xff\xfes\0o\0", "it is UTF-16 text; save it as UTF-8 or ASCII");
    of("a.obj", "OBJ", b"\x1f\x8b\x08", "it is compressed data; decompress it first");
    let shown = format!("line 1: `{}…` in a vertex is not a finite number", "x".repeat(40));
    obj(&format!("v 1 2 {}", "x".repeat(1000)), &shown);
    obj("vn 1", "line 1: a normal needs 3 numbers");
    stl(b"solid\nvertex 0 0 0\nendloop", "line 3: a facet has 1 corners, not 3");
    stl(b"solid\nvertx 0 0 0", "line 2: `vertx` is not a keyword of STL");
    stl(b"solid\nvertex 0 0 0", "the file ends inside a facet; copy it again");
    stl(b"", "the file is too short for STL");
    stl(b"facet normal 0 0 1", "it is text, and STL as text begins with `solid`");
    let cut = [b"x", &stl_binary()[1..200]].concat();
    stl(&cut, "4 triangles are declared, but the file ends after 2; copy it again");
    let off = |text: &str, problem: &str| of("a.off", "OFF", text.as_bytes(), problem);
    off("OFF\n2 1 0\n0 0 0", "2 vertices are declared, but the file ends after 1; copy it again");
    let range = "line 4: a face refers to vertex `1`, but vertices are numbered from 0 to 0";
    off("OFF\n1 1\n0 0 0\n3 0 0 1", range);
    let binary =
        "line 1: `OFF BINARY` is not supported; export three-dimensional ASCII OFF, or PLY";
    off("OFF BINARY\n", binary);
    off("OFF\nv 1 2", "line 2: the numbers of vertices and faces are expected here");
    let ply = |rest: &str, problem: &str| {
        of(
            "a.ply",
            "PLY",
            format!("ply\nformat ascii 1.0\nelement vertex {rest}").as_bytes(),
            problem,
        );
    };
    let fewer = |n: &str| {
        format!("{n} rows of `vertex` are declared, but the file has fewer; copy it again")
    };
    ply("1000000000000\nproperty float x\nend_header\n", &fewer("1000000000000"));
    ply("9\nend_header\n", &fewer("9"));
    ply("1\nproperty float x\nend_header\n1\n", "vertices have no property `y`");
    let gltf = |bytes: &[u8], problem: &str| of("a.glb", "glTF", bytes, problem);
    gltf(b"glTF\x02\0\0\0\0\0\0\0", "the file is truncated; copy it again");
    for (extension, name) in
        [("KHR_draco_mesh_compression", "draco"), ("EXT_meshopt_compression", "meshopt")]
    {
        let required =
            format!(r#"{{"asset":{{"version":"2.0"}},"extensionsRequired":["{extension}"]}}"#);
        let problem = format!("the mesh has {name} compression ({extension}); export without it");
        gltf(&glb(&required, b""), &problem);
    }
    let old = br#"{"asset":{"version":"1.0"},"meshes":{"a":{}}}"#;
    of("a.gltf", "glTF", old, "glTF 1.0 is not read; convert the mesh to glTF 2.0");
    let json = "this is JSON, but not a glTF document: it has no `asset` with a version";
    of("a.gltf", "glTF", b"{}", json);
    of("a", "glTF", b"{\"nodes\": []}", json);
    obj(
        "v 0 0 0\nv 1 0 0",
        "the mesh has no faces, only 2 points; make a surface of the cloud first",
    );
    gltf(&glb_with_nodes(r#"[{"mesh":7}]"#), "`meshes[7]` does not exist; export the mesh again");
    let ascii = |row: &str| {
        format!("1\nproperty float x\nproperty float y\nproperty float z\nend_header\n{row}")
    };
    ply(&ascii("0 a 0\n"), "line 8: vertex 0, y: `a` is not a number");
    ply(&ascii("0\n0"), "line 9: vertex 0, z: the file ends here; copy it again");
    let two_parents = glb_with_nodes(r#"[{"children":[1,2]},{"children":[2]},{"mesh":0}]"#);
    gltf(&two_parents, "node 2 has two parents; export the mesh again");
    let mut long = glb_with_nodes(r#"[{"mesh":0}]"#);
    let count = long.windows(9).position(|window| window == br#""count":3"#).unwrap() + 8;
    long[count] = b'4';
    gltf(&long, "an accessor reaches beyond its buffer; export the mesh again");
}

#[test]
fn omitted_parts_are_counted() {
    let points = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (text, expected) in [
        (
            &*format!("{points}f 1 2 3\nf 1 2 1\nl 1 2"),
            &["1 line, point or curve is left out", "1 face without area is left out"][..],
        ),
        (&format!("{points}f 1 2 3\nf 1 1 1\nf 1 2 2"), &["2 faces without area are left out"]),
        (
            "v 0 0 0 255 0 0\nv 1 0 0 255 0 0\nv 0 1 0 0 0 0\nf 1 2 3",
            &["1 colour is outside 0…1 and clipped"],
        ),
    ] {
        assert_eq!(convert(&Config::default(), "a.obj", text).unwrap().warnings, expected);
    }
}
