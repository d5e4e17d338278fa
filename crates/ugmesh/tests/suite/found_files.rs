//! Files as programs write them: most of what other readers accept, too.

use ugmesh::{Axis, Config, Converted, MeshFile};

use crate::common::{glb, glb_with_nodes, parse, statements, stl_binary};

fn run(name: &str, bytes: &[u8], beside: &[(&str, &[u8])]) -> Converted {
    let read = |name: &str, _: u64| -> std::io::Result<Vec<u8>> {
        let file = beside.iter().find(|(known, _)| *known == name);
        file.map(|(_, bytes)| bytes.to_vec()).ok_or_else(|| std::io::ErrorKind::NotFound.into())
    };
    let config = Config { up: Some(Axis::Z), ..Config::default() };
    ugmesh::run(&config, &MeshFile::new(name, bytes).with_files(&read))
        .unwrap_or_else(|error| panic!("{error}"))
}

/// The statements of a converted mesh in one line, and its warnings.
fn shown(converted: &Converted) -> (String, String) {
    (
        statements(&parse(&converted.bytes)).replace('\n', " ").trim_end().to_owned(),
        converted.warnings.join("; "),
    )
}

const TRIANGLE: &str = "v v1 0 0 0; v v2 1 0 0; v v3 0 1 0; f (v1 v2 v3);";

#[test]
fn text_of_other_programs_is_read() {
    #[track_caller]
    fn check(name: &str, text: &str, expected: &str, warning: &str) {
        assert_eq!(
            shown(&run(name, text.as_bytes(), &[])),
            (expected.to_owned(), warning.to_owned()),
            "{text}"
        );
    }
    let points = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    let obj =
        |rest: &str, warning: &str| check("a.obj", &format!("{points}{rest}"), TRIANGLE, warning);
    obj("f 1 2 3 # a comment", "");
    obj("fo 1 2 3", "");
    obj("usemtl none\t# a comment\nf 1 2 3", "materials without colour: `none`");
    obj("f 1//0 2//0 3//0", "3 corners refer to normals that do not exist, and have none");
    obj("f 1//7 2 3", "1 corner refers to a normal that does not exist, and has none");
    obj("mtllib a/b.mtl\nf 1 2 3", "colours are missing: cannot read `a/b.mtl`: entity not found");

    let stl = |text: &str| check("a.stl", text, TRIANGLE, "");
    let facet =
        "facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop endfacet";
    stl(&format!("solid a part {facet} endsolid a part"));
    stl(&format!("\u{feff}SOLID a\n{}\nEndSolid a\n", facet.replace("vertex", "VERTEX")));
    stl(&format!("solid vertex of 3\n{facet}\nendsolid"));

    let off = |text: &str| check("a.off", text, TRIANGLE, "");
    off("OFF3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2");
    off("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0\n1\n2\n");
    off("OFF 3 1 0 0 0 0 1 0 0 0 1 0 3 0 1 2");
    off("OFF\n3 1\n0 0 0 9 9 9\n1 0 0 9\n0 1 0\n3 0 1 2");
    check(
        "a.off",
        "COFF 3 1 0 0 0 0 255 0 0 255 1 0 0 255 0 0 255 0 1 0 255 0 0 255 3 0 1 2",
        "c_rgb c1 1 0 0; v v1 0 0 0 c1; v v2 1 0 0 c1; v v3 0 1 0 c1; f (v1 v2 v3);",
        "",
    );

    let more = "the file goes on after what its header declares: the rest is not read";
    check("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 2 1\n", TRIANGLE, more);

    let head = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty float quality\n";
    let faces = "element face 1\nproperty list uchar int vertex_indices\n";
    let ply = |rest: &str| check("a.ply", rest, TRIANGLE, "");
    ply(&format!(
        "ply\nformat ascii 1.0\n{head}{faces}end_header\n0 .0 -.0 nan\n1. 0 0 inf\n0 1 0 -nan(ind)\n3 0 1 2"
    ));
    ply(&format!(
        "\u{feff}ply\r\nformat ascii 1.0\r\n{head}{faces}end_header\r\n0 0 0 1 1 0 0 1 0 1 0 1 3 0 1 2"
    ));
    let longer = format!(
        "ply\nformat ascii 1.0\n{head}{faces}end_header\n0 0 0 1 1 0 0 1 0 1 0 1 3 0 1 2 3 0 1 2"
    );
    check("a.ply", &longer, TRIANGLE, more);
    // Faces before vertices.
    ply(&format!(
        "ply\nformat ascii 1.0\n{faces}{head}end_header\n3 0 1 2\n0 0 0 0\n1 0 0 0\n0 1 0 0\n"
    ));
}

#[test]
fn headers_of_stl_may_lie() {
    let (whole, _) = shown(&run("a.stl", &stl_binary(), &[]));
    for declared in [0, 2_u32] {
        let mut file = stl_binary();
        file[80..84].copy_from_slice(&declared.to_le_bytes());
        let warning = format!("{declared} triangles are declared, and all 4 of the file are read");
        assert_eq!(shown(&run("a.stl", &file, &[])), (whole.clone(), warning));
    }
}

/// A character that only looks like one of numbers is named.
#[test]
fn look_alikes_are_named() {
    for (name, text) in [
        ("a.obj", "v 0 0 \u{2212}1\n"),
        ("a.off", "OFF 1 0 0 0 0 \u{2212}1"),
        ("a.stl", "solid\nfacet outer loop vertex 0 0 \u{2212}1"),
        (
            "a.ply",
            "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 \u{2212}1\n",
        ),
    ] {
        let config = Config { up: Some(Axis::Z), ..Config::default() };
        let found = ugmesh::run(&config, &MeshFile::new(name, text.as_bytes()));
        let message = found.err().map(|error| error.to_string()).unwrap_or_default();
        assert!(
            message.contains("; `\u{2212}` (U+2212) is a minus sign of Unicode: write it as ASCII"),
            "{message}"
        );
    }
}

#[test]
fn materials_of_other_programs_are_read() {
    #[track_caller]
    fn check(mtl: &str, color: &str, warning: &str) {
        let obj = "mtllib C:\\work\\a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3";
        // Red, of two pixels.
        let png = ugimage::Format::Png;
        let red = ugimage::Frame::new([2, 1], true, vec![[255, 0, 0, 255]; 2]);
        let png = png.encode(&red, &ugimage::Metadata::default());
        let files = [("a.mtl", mtl.as_bytes()), ("my tex.png", &png), ("deep/tex.png", &png)];
        let (text, warnings) = shown(&run("a.obj", obj.as_bytes(), &files));
        assert!(text.starts_with(color), "{text}");
        assert!(
            warnings.contains(warning) && warnings.is_empty() == warning.is_empty(),
            "{warnings}"
        );
    }
    check(
        "newmtl m\nKd spectral a.rfl 1",
        "c_rgb m 0.8 0.8 0.8;",
        "the colour of material `m` is not read",
    );
    check(
        "newmtl m\nKd 0 0 0\nmap_Kd my tex.png",
        "c_rgb m 1 0 0;",
        "material `m` is black and has a texture",
    );
    for options in ["", "-s 1 1 1 ", "-o .5 -clamp on ", "-mm 0 1 -t 1 2 -bm 2 "] {
        let mtl = format!("newmtl m\nKd 1 1 1\nmap_Kd {options}my tex.png");
        check(&mtl, "c_rgb m 1 0 0;", "");
    }
    let textured = "c_rgb m 1 0 0; c_tex m \"my tex.png\"";
    check("newmtl m # c\nkd 1 1 1 # c\nMAP_Kd my tex.png # c", textured, "");
    check(
        "newmtl m\nKd 1 1 1\nmap_Kd -clamp on \"my tex.png\"",
        &format!("{textured} -wrap clamp;"),
        "",
    );
    check("newmtl m\nKd 1 0 0\nmap_Kd", "c_rgb m 1 0 0; v v1", "");
    let lfs = "colours are missing: `C:\\work\\a.mtl` is a Git LFS pointer";
    check("version https://git-lfs.github.com/spec/v1\n", "v v1 ", lfs);
    check(
        "newmtl m\nKd 1 1 1\nmap_Kd deep\\tex.png",
        "c_rgb m 1 0 0; c_tex m \"deep/tex.png\";",
        "",
    );
    check(
        "newmtl m\nKd 1 1 1\nmap_Kd D:\\x\\my tex.png",
        "c_rgb m 1 0 0; c_tex m \"my tex.png\";",
        "",
    );
}

/// Coordinates of pictures are scaled and moved as `map_Kd` says, whose v is upwards.
#[test]
fn pictures_are_where_materials_place_them() {
    let png =
        ugimage::Format::Png.encode(&ugimage::Frame::opaque(1, 1), &ugimage::Metadata::default());
    let obj = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt .5 .25\nusemtl m\nf 1/1 2/2 3/2";
    for (options, expected) in [
        ("", ["(0 1)", "(0.5 0.75)"]),
        ("-s 2 4 1 -o .5 1 0 ", ["(0.5 0)", "(1.5 -1)"]),
        ("-o .5 ", ["(0.5 1)", "(1 0.75)"]),
    ] {
        let mtl = format!("newmtl m\nmap_Kd {options}a.png");
        let (text, _) =
            shown(&run("a.obj", obj.as_bytes(), &[("a.mtl", mtl.as_bytes()), ("a.png", &png)]));
        let [first, second] = expected;
        let vertices = format!("v v1 0 0 0 {first}; v v2 1 0 0 {second}; v v3 0 1 0 {second};");
        assert!(text.contains(&vertices), "{options}: {text}");
    }
}

/// A triangle in a document with more keys: of its root, of its node and of its primitive.
fn gltf(root: &str, node: &str, primitive: &str) -> Vec<u8> {
    let positions = crate::common::floats(&[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]);
    let json = format!(
        r#"{{"asset":{{"version":"2.0"}},"nodes":[{{"mesh":0{node}}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"_WEIGHT":9}}{primitive}}}]}}],
        "accessors":[{{"bufferView":0.0,"componentType":5126,"count":3.0,"type":"VEC3"}},
          {{"bufferView":1,"componentType":5126,"count":2,"type":"VEC3"}}],
        "bufferViews":[{{"buffer":0,"byteLength":36}},{{"buffer":0,"byteLength":24,"byteOffset":12}}]{root},
        "extras":["any",1]}}"#
    );
    glb(&json, &positions)
}

#[test]
fn gltf_needs_only_what_is_read() {
    #[track_caller]
    fn check(root: &str, node: &str, primitive: &str, expected: &str, warning: &str) {
        let root = if root.contains("\"buffers\"") {
            root.to_owned()
        } else {
            format!(r#","buffers":[{{"byteLength":36}}]{root}"#)
        };
        let found = shown(&run("a.glb", &gltf(&root, node, primitive), &[]));
        assert_eq!(found, (expected.to_owned(), warning.to_owned()));
    }
    let plain = |root: &str, node: &str, primitive: &str, warning: &str| {
        check(root, node, primitive, TRIANGLE, warning)
    };
    plain("", r#","extras":"text""#, r#","extras":[1]"#, "");
    plain(r#","scene":1,"scenes":[{"name":"empty"},{"nodes":[0]}]"#, "", "", "");
    plain(
        r#","animations":[{"channels":[{"sampler":0,"target":{"path":"weights"}}],"samplers":[{}]}]"#,
        "",
        "",
        "animations are not read: everything is at rest where its node is",
    );
    plain(r#","buffers":[{"byteLength":36},{"byteLength":400,"extensions":{"x":{}}}]"#, "", "", "");
    let morphed = "morph targets are not read: meshes have their base shape";
    plain("", "", r#","targets":[{"POSITION":5}]"#, morphed);
    plain(
        r#","skins":[{"joints":[0]}]"#,
        r#","skin":0,"translation":[10,0,0],"scale":[100,100,100]"#,
        "",
        "skins are ignored: skinned meshes are read in their bind pose",
    );
    let instances = r#","extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":1}}}"#;
    // At (1, 0, 0) and (0, 1, 0).
    check(
        "",
        instances,
        "",
        "v v1 1 0 0; v v2 2 0 0; v v3 1 1 0; v v4 0 1 0; v v5 1 1 0; v v6 0 2 0; f (v1 v2 v3); f (v4 v5 v6);",
        "",
    );
    let red = "c_rgb c1 1 0 0; v v1 0 0 0; v v2 1 0 0; v v3 0 1 0; f (v1 v2 v3) c1;";
    let glossy = r#","materials":[{"extensions":{"KHR_materials_pbrSpecularGlossiness":{"diffuseFactor":[1,0,0,1]}}}]"#;
    check(glossy, "", r#","material":0"#, red, "");
    let hidden = r#","extensions":{"KHR_node_visibility":{"visible":false}}"#;
    let problem = ugmesh::run(&Config::default(), &MeshFile::new("a.glb", gltf("", hidden, "")));
    let problem = problem.err().map(|error| error.to_string()).unwrap_or_default();
    assert!(problem.ends_with("the mesh has no faces: it is empty"), "{problem}");
    let webp = r#","extensionsRequired":["EXT_texture_webp"],"textures":[{"extensions":{"EXT_texture_webp":{"source":0}}}],
        "materials":[{"pbrMetallicRoughness":{"baseColorFactor":[1,0,0,1],"baseColorTexture":{"index":0}}}]"#;
    let missing = "texture `texture 0`: it has no PNG or JPEG picture; its faces have the colour of their material";
    check(webp, "", r#","material":0"#, red, missing);
}

#[test]
fn containers_of_gltf_may_have_more() {
    let plain = glb_with_nodes(r#"[{"mesh":0}]"#);
    let (expected, _) = shown(&run("a.glb", &plain, &[]));
    // A chunk of an unknown kind at the end, and text padded by zeros.
    let mut longer = [&plain[..], &4_u32.to_le_bytes(), b"LATE", &[0; 4]].concat();
    let length = longer.len() as u32;
    longer[8..12].copy_from_slice(&length.to_le_bytes());
    let text_end = 20 + u32::from_le_bytes(plain[12..16].try_into().unwrap()) as usize;
    let mut padded = plain.clone();
    padded[..text_end]
        .iter_mut()
        .rev()
        .take_while(|byte| **byte == b' ')
        .for_each(|byte| *byte = 0);
    for file in [longer, padded] {
        assert_eq!(shown(&run("a.glb", &file, &[])).0, expected);
    }
    let three = glb(r#"{"asset":{"version":"2.0","minVersion":"3.0"}}"#, b"");
    let config = Config { up: Some(Axis::Z), ..Config::default() };
    let message =
        ugmesh::run(&config, &MeshFile::new("a.glb", three)).err().map(|error| error.to_string());
    assert!(
        message.unwrap_or_default().contains("glTF 3.0 is not read; convert the mesh to glTF 2.0")
    );
    // A buffer by a path with backslashes.
    let far = r#"{"asset":{"version":"2.0"},"buffers":[{"byteLength":3,"uri":"x\\a%20b.bin"}]}"#;
    let read = |name: &str, _: u64| -> std::io::Result<Vec<u8>> {
        if name == "x/a b.bin" {
            Ok(b"abc".to_vec())
        } else {
            Err(std::io::ErrorKind::NotFound.into())
        }
    };
    let message = ugmesh::run(&config, &MeshFile::new("a.gltf", far).with_files(&read)).err();
    let message = message.map(|error| error.to_string()).unwrap_or_default();
    assert!(message.ends_with("the mesh has no faces: it is empty"), "{message}");
}
