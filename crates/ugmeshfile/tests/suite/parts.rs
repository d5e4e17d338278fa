//! What becomes of each part of a mesh that is not geometry: it is read, or told by name.

use std::fmt::Write;
use std::io;

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use ugimage::{Format, Frame, Metadata};
use ugmeshfile::{MeshFormat, MeshScene, picture_within, read};
use ugpipe::OtherCase;
use ugscene::{AlphaMode, Beam, ColorValue, LightKind, Scene};

/// Names and bytes of files.
type Files<'a> = [(&'a str, &'a [u8])];

/// Reads a file of a list. Its name may differ in case, as in folders.
fn find(files: &Files<'_>, name: &str) -> io::Result<Vec<u8>> {
    let find = |is: &dyn Fn(&str) -> bool| files.iter().find(|(known, _)| is(known));
    match (find(&|known| known == name), find(&|known| known.eq_ignore_ascii_case(name))) {
        (Some((_, bytes)), _) => Ok(bytes.to_vec()),
        (None, Some((other, _))) => Err(OtherCase::error(format!("box/{other}").into())),
        (None, None) => Err(io::ErrorKind::NotFound.into()),
    }
}

fn mesh(files: &Files<'_>) -> Result<MeshScene, String> {
    let (name, bytes) = files[0];
    let format = MeshFormat::detect_mesh(name, bytes).unwrap();
    read(format, bytes, &|name, _| find(files, name), "").map_err(|problem| problem.what)
}

/// Everything but positions, a line each.
fn shown(mesh: &MeshScene) -> String {
    let (scene, mut text) = (&mesh.scene, String::new());
    let name = |id| scene.names.get(id);
    let color_name = |id: ugscene::ColorId| name(scene.colors[id.index()].name);
    for color in &scene.colors {
        let ColorValue::Rgb(rgb) = color.value else { panic!("not red, green and blue") };
        let [red, green, blue] = rgb.map(|part| (1e3 * part).round() / 1e3);
        writeln!(text, "c {} {red} {green} {blue} {}", name(color.name), color.translucency)
            .unwrap();
    }
    for texture in &scene.textures {
        let file = texture.image.file.as_deref().unwrap_or("within");
        let alpha = match texture.alpha {
            AlphaMode::Opaque => "opaque".to_owned(),
            AlphaMode::Mask(cutoff) => format!("mask {cutoff}"),
            AlphaMode::Blend => "blend".to_owned(),
        };
        let nearest = if texture.is_nearest { " nearest" } else { "" };
        writeln!(text, "tex {} {file} {alpha}{nearest}", color_name(texture.color)).unwrap();
    }
    for vertex in &scene.vertices {
        let color = vertex.color.map_or("-", color_name);
        writeln!(text, "v {color} {:?}", vertex.uv).unwrap();
    }
    for face in &scene.faces {
        let color = face.color.map_or("-", color_name);
        let level = scene.light_level(face).map_or(String::new(), |level| format!(" {level}"));
        writeln!(text, "f {color}{level}").unwrap();
    }
    text += &eyes_and_lamps(scene);
    mesh.warnings.iter().for_each(|warning| writeln!(text, "warning: {warning}").unwrap());
    mesh.notes.iter().for_each(|note| writeln!(text, "note: {note}").unwrap());
    text
}

fn eyes_and_lamps(scene: &Scene) -> String {
    let mut text = String::new();
    let round = |numbers: &[f64]| {
        let rounded = numbers.iter().map(|it| format!("{}", (1e3 * it).round() / 1e3 + 0.0));
        rounded.collect::<Vec<_>>().join(" ")
    };
    for camera in &scene.cameras {
        let name = scene.names.get(camera.name.unwrap());
        let [eye, center, up] =
            [camera.eye, camera.center, camera.up].map(|it| round(&it.unwrap().to_array()));
        let (angles, kind) = (round(&camera.view_angle.unwrap()), camera.projection.unwrap());
        writeln!(text, "cam {name} {kind:?} {eye} to {center} up {up} angles {angles}").unwrap();
    }
    for light in &scene.lights {
        let name = light.name.map_or("-", |name| scene.names.get(name));
        let kind = match light.kind {
            LightKind::Ambient => "ambient".to_owned(),
            LightKind::Directional(toward) => format!("from {}", round(&toward.to_array())),
            LightKind::Local { position, reference, beam, .. } => {
                let beam = match beam {
                    Beam::Spot { axis, degrees } => {
                        format!(" spot {} {}", round(&axis.to_array()), round(&degrees))
                    }
                    _ => String::new(),
                };
                format!("at {} {}{beam}", round(&position.to_array()), reference.unwrap())
            }
        };
        // In units of π, of which one lights a white face fully.
        let level = round(&[light.intensity * std::f64::consts::PI]);
        let color =
            light.color.map_or("white", |it| scene.names.get(scene.colors[it.index()].name));
        writeln!(text, "l {name} {level} {kind} {color}").unwrap();
    }
    text
}

/// `expected`: lines that what is read has; after `!`, no line has this text.
#[track_caller]
fn check(files: &Files<'_>, expected: &[&str]) {
    let text = shown(&mesh(files).unwrap());
    for row in expected {
        match row.strip_prefix('!') {
            Some(absent) => assert!(!text.contains(absent), "`{absent}` is in\n{text}"),
            None => assert!(text.lines().any(|line| line == *row), "`{row}` is not in\n{text}"),
        }
    }
}

#[track_caller]
fn refused(files: &Files<'_>, expected: &str) {
    assert_eq!(mesh(files).map(|mesh| shown(&mesh)), Err(expected.to_owned()));
}

fn png(size: [u32; 2], pixels: &[[u8; 4]]) -> Vec<u8> {
    let is_opaque = pixels.iter().all(|pixel| pixel[3] == 255);
    Format::Png.encode(&Frame::new(size, is_opaque, pixels.to_vec()), &Metadata::default())
}

/// Left red, right blue.
fn red_blue() -> Vec<u8> {
    png([2, 1], &[[255, 0, 0, 255], [0, 0, 255, 255]])
}

const OBJ: &str = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n\
                   usemtl m\nf 1/1 2/2 3/3\n";

/// An OBJ file with this material `m`, and pictures.
#[track_caller]
fn check_mtl(mtl: &str, expected: &[&str]) {
    let mtl = format!("newmtl m\n{mtl}");
    let mask = png([2, 2], &[[255; 4], [0, 0, 0, 255], [255; 4], [255; 4]]);
    let (red, alpha) = (red_blue(), png([2, 1], &[[255, 0, 0, 255], [0, 0, 255, 0]]));
    check(
        &[
            ("a.obj", OBJ.as_bytes()),
            ("a.mtl", mtl.as_bytes()),
            ("tex.png", &red),
            ("mask.png", &mask),
            ("alpha.png", &alpha),
        ],
        expected,
    );
}

const ALL_CLEAR: &str = "warning: all faces are wholly transparent, as `m` is \
                         (`Tr 1`, `d 0` or alpha 0): they are drawn opaque";

#[test]
fn materials_of_obj() {
    // Scanners write `Tr 1` for opaque.
    check_mtl("Kd 1 0 0\nTr 1.000000", &["c m 1 0 0 0", "f m", ALL_CLEAR]);
    check_mtl("Kd 1 0 0\nd 0", &["c m 1 0 0 0", ALL_CLEAR]);
    check_mtl("Kd 1 1 1\nTr 1\nmap_Kd tex.png", &["tex m tex.png opaque", ALL_CLEAR]);
    check_mtl("Kd 1 0 0\nTr 0.25", &["c m 1 0 0 0.25", "!warning"]);
    check_mtl("Kd 1 0 0\nd 1\nTr 1", &["c m 1 0 0 0", "!warning"]);
    check_mtl("Kd 1 0 0\nTr 1\nd 0.5", &["c m 1 0 0 0.5", "!warning"]);
    // Another material is visible, so this one is meant to be transparent.
    let two = format!("{OBJ}usemtl n\nf 3 2 1\n");
    let mtl = b"newmtl m\nKd 1 0 0\nTr 1\nnewmtl n\nKd 0 1 0\n";
    check(&[("a.obj", two.as_bytes()), ("a.mtl", mtl)], &["c m 1 0 0 1", "!warning"]);
    // NaN loses what has it, and no more.
    check_mtl(
        "Kd nan 0 0\nd nan\nKe nan 1 1",
        &["c m 0.8 0.8 0.8 0", "warning: the colour of material `m` is not read: `Kd nan 0 0`"],
    );
    check_mtl("Kd 1 0 0\nd nan", &["c m 1 0 0 0", "!warning"]);
    // Opacity from a picture.
    let masked = &["tex m within blend", "c m 0.836 0 0.613 0", "!warning"];
    check_mtl("Kd 1 1 1\nmap_Kd tex.png\nmap_d mask.png", masked);
    check_mtl("Kd 0 1 0\nmap_d mask.png", &["tex m within blend", "c m 0 1 0 0", "!warning"]);
    check_mtl("Kd 1 1 1\nmap_Kd alpha.png\nmap_d alpha.png", &["tex m alpha.png blend"]);
    check_mtl(
        "Kd 1 1 1\nmap_Kd tex.png\nmap_d -s 2 2 mask.png",
        &[
            "tex m tex.png opaque",
            "warning: `map_d` of material `m` is not read, since it is placed otherwise than `map_Kd`",
        ],
    );
    check_mtl(
        "Kd 1 1 1\nmap_Kd tex.png\nmap_d none.png",
        &[
            "tex m tex.png opaque",
            "warning: texture `tex.png none.png`: entity not found; its faces have the colour of \
             their material",
        ],
    );
    check_mtl(
        "Kd 1 1 1\nmap_Kd tex.png\nmap_Bump -bm 1 b.png\nnorm n.png\nmap_Ks s.png\nbump b.png",
        &["warning: textures of these kinds are not read: bump, normal, specular"],
    );
}

/// Of a picture with the colours of one file and the opacity of another each texel is known.
#[test]
fn opacity_of_another_picture_becomes_alpha() {
    let (red, mask) =
        (red_blue(), png([2, 2], &[[255; 4], [0, 0, 0, 255], [9, 9, 9, 255], [255; 4]]));
    let alpha = png([1, 1], &[[7, 7, 7, 128]]);
    for (mtl, size, expected) in [
        (
            "map_Kd tex.png\nmap_d mask.png",
            [2, 2],
            vec![[255, 0, 0, 255], [0, 0, 255, 0], [255, 0, 0, 9], [0, 0, 255, 255]],
        ),
        ("map_d mask.png", [2, 2], [255, 0, 9, 255].map(|it| [255, 255, 255, it]).to_vec()),
        ("map_Kd tex.png\nmap_d a.png", [2, 1], vec![[255, 0, 0, 128], [0, 0, 255, 128]]),
    ] {
        let mtl = format!("newmtl other\nKd 1 1 1\nnewmtl m\n{mtl}\n");
        let files: &Files<'_> = &[
            ("a.obj", OBJ.as_bytes()),
            ("a.mtl", mtl.as_bytes()),
            ("tex.png", &red),
            ("mask.png", &mask),
            ("a.png", &alpha),
        ];
        let texture = mesh(files).unwrap().scene.textures.remove(0);
        let row = texture.image.row.unwrap() as usize;
        // A scene names it by the mesh and this row.
        let again = picture_within(files[0].1, row, &|name, _| find(files, name)).unwrap();
        assert_eq!(*texture.image.bytes, *again);
        let picture = ugimage::read_picture(&again, &Default::default()).unwrap();
        assert_eq!(
            (picture.size, picture.pixels),
            (size, ugimage::Pixels::Srgb(expected)),
            "{mtl}"
        );
        let none = picture_within(files[0].1, 0, &|name, _| find(files, name));
        assert_eq!(none, Err("it has no material with such a picture".to_owned()));
    }
}

#[test]
fn names_of_files_may_differ_in_case() {
    let red = red_blue();
    let mtl = b"newmtl m\nKd 1 1 1\nmap_Kd textures\\Tex.PNG\n";
    let notes = &[
        "tex m Textures/tex.png opaque",
        "note: `A.MTL` is read in place of `a.mtl`",
        "note: `Textures/tex.png` is read in place of `textures/Tex.PNG`",
        "!warning",
    ];
    check(&[("a.obj", OBJ.as_bytes()), ("A.MTL", mtl), ("Textures/tex.png", &red)], notes);
    let ply = ply("", "property list uchar float texcoord\n", "Tex.png", "6 0 0 1 0 0 1");
    let note = "note: `tex.PNG` is read in place of `Tex.png`";
    check(&[("a.ply", ply.as_bytes()), ("tex.PNG", &red)], &["tex c1 tex.PNG opaque", note]);
    let gltf = gltf(TEXTURED, r#","images":[{"uri":"A%20b.png"}],"textures":[{"source":0}]"#, "");
    let note = "note: `a b.png` is read in place of `A b.png`";
    check(&[("a.gltf", gltf.as_bytes()), ("a b.png", &red)], &["tex c1 a b.png opaque", note]);
}

#[test]
fn colours_that_are_not_numbers_are_left_out() {
    const ONE: &str = "warning: 1 colour is not a number (NaN) and left out";
    let obj = b"v 0 0 0 nan nan nan\nv 1 0 0 1 0 0\nv 0 1 0 1 0 0\nf 1 2 3\n";
    check(&[("a.obj", obj)], &["v - None", "v c1 None", "c c1 1 0 0 0", ONE]);
    let off = b"COFF\n3 1 0\n0 0 0 255 nan 0 255\n1 0 0 1 0 0 255\n0 1 0 255 0 0 255\n3 0 1 2\n";
    check(&[("a.off", off)], &["v - None", "c c1 0.004 0 0 0", "c c2 1 0 0 0", ONE]);
    let colors = "property float red\nproperty float green\nproperty float blue\n";
    let ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
               property float z\n"
        .to_owned()
        + colors
        + "element face 1\nproperty list uchar int vertex_indices\n"
        + colors
        + "end_header\n0 0 0 nan 0 0\n1 0 0 1 0 0\n0 1 0 1 0 0\n3 0 1 2 0 nan 0\n";
    let two = "warning: 2 colours are not numbers (NaN) and left out";
    check(&[("a.ply", ply.as_bytes())], &["v - None", "v c1 None", "f -", two]);
    let word = b"v 1 0 0\nv 0 0 0 a 0 0\nv 0 1 0\nf 1 2 3\n";
    refused(&[("a.obj", word)], "`a` in a vertex colour is not a number");
}

/// A triangle in PLY with properties of vertices and faces, and a texture. Vertices end with the
/// numbers 0 0, 1 0 and 0 1 if they have such properties.
fn ply(of_vertices: &str, of_faces: &str, file: &str, face: &str) -> String {
    let comment =
        if file.is_empty() { String::new() } else { format!("comment TextureFile {file}\n") };
    let uvs = if of_vertices.is_empty() { [""; 3] } else { [" 0 0", " 1 0", " 0 1"] };
    let [a, b, c] = uvs;
    format!(
        "ply\nformat ascii 1.0\n{comment}element vertex 3\nproperty float x\nproperty float y\n\
         property float z\n{of_vertices}element face 1\nproperty list uchar int vertex_indices\n\
         {of_faces}end_header\n0 0 0{a}\n1 0 0{b}\n0 1 0{c}\n3 0 1 2 {face}\n"
    )
}

#[test]
fn textures_of_ply() {
    let red = red_blue();
    let uvs = &["v - Some([0.0, 1.0])", "v - Some([1.0, 1.0])", "v - Some([0.0, 0.0])"];
    let drawn = [&["tex c1 my tex.png opaque", "f c1", "!warning"][..], uvs].concat();
    let corners = "property list uchar float texcoord\n";
    let on_faces = ply("", corners, "my tex.png", "6 0 0 1 0 0 1");
    check(&[("a.ply", on_faces.as_bytes()), ("my tex.png", &red)], &drawn);
    for names in [["texture_u", "texture_v"], ["s", "t"], ["u", "v"]] {
        let of_vertices = names.map(|name| format!("property float {name}\n")).concat();
        let on_vertices = ply(&of_vertices, "", "my tex.png", "");
        check(&[("a.ply", on_vertices.as_bytes()), ("my tex.png", &red)], &drawn);
        let bare = ply(&of_vertices, "", "", "");
        let told = "warning: texture coordinates are not read, since no `comment TextureFile` \
                    names a picture";
        check(&[("a.ply", bare.as_bytes())], &["f -", told]);
    }
    let missing = "warning: texture `my tex.png`: entity not found; its faces have the colour of \
                   their material";
    check(&[("a.ply", on_faces.as_bytes())], &["f -", missing]);
    let without = ply("", "", "my tex.png", "");
    let told = "warning: texture `my tex.png` is not read: there are no coordinates";
    check(&[("a.ply", without.as_bytes()), ("my tex.png", &red)], &["f -", told]);
    // Of several textures a face has the one of its number, or none.
    let numbered = format!("{corners}property int texnumber\n");
    for (number, expected) in [(0, "f c1"), (1, "f c2"), (2, "f -"), (-1, "f -")] {
        let face = format!("6 0 0 1 0 0 1 {number}");
        let file = "a.png\ncomment TextureFile b.png";
        let file = ply("", &numbered, file, &face);
        let green = png([1, 1], &[[0, 255, 0, 255]]);
        check(
            &[("a.ply", file.as_bytes()), ("a.png", &red), ("b.png", &green)],
            &[expected, "tex c1 a.png opaque", "tex c2 b.png opaque"],
        );
    }
    let colors = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    let both = ply("", &format!("{corners}{colors}"), "my tex.png", "6 0 0 1 0 0 1 9 9 9");
    let told = "warning: colours of vertices and faces are not read, since there is a texture";
    check(&[("a.ply", both.as_bytes()), ("my tex.png", &red)], &["f c1", told]);
    // Corners of one vertex with other coordinates are vertices of their own.
    let seam = on_faces
        .replace("element face 1", "element face 2")
        .replace("3 0 1 2 6 0 0 1 0 0 1\n", "3 0 1 2 6 0 0 1 0 0 1\n3 0 2 1 6 .5 .5 0 1 1 0\n");
    let seam = mesh(&[("a.ply", seam.as_bytes()), ("my tex.png", &red)]).unwrap().scene;
    assert_eq!((seam.vertices.len(), seam.faces.len()), (4, 2));
    assert_eq!(seam.vertices[3].uv, Some([0.5, 0.5]));
}

/// A material with a picture as base colour.
const TEXTURED: &str = r#""pbrMetallicRoughness":{"baseColorTexture":{"index":0}}"#;

/// A triangle in glTF with this material, more keys of the root, and more nodes.
fn gltf(material: &str, root: &str, nodes: &str) -> String {
    let numbers: [f32; 15] = [0., 0., 0., 1., 0., 0., 0., 1., 0., 0., 0., 1., 0., 0., 1.];
    let bytes: Vec<u8> = numbers.iter().flat_map(|number| number.to_le_bytes()).collect();
    let data = BASE64_STANDARD.encode(bytes);
    format!(
        r#"{{"accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}},
        {{"bufferView":1,"componentType":5126,"count":3,"type":"VEC2"}}],
        "bufferViews":[{{"buffer":0,"byteLength":36}},
        {{"buffer":0,"byteLength":24,"byteOffset":36}}],
        "buffers":[{{"byteLength":60,"uri":"data:application/octet-stream;base64,{data}"}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"TEXCOORD_0":1}},"material":0}}]}}],
        "materials":[{{{material}}}],"nodes":[{{"mesh":0}}{nodes}]{root},
        "asset":{{"version":"2.0"}}}}"#
    )
}

/// A glTF root with one picture whose sampler has these keys.
fn with_picture(sampler: &str) -> String {
    let picture = BASE64_STANDARD.encode(red_blue());
    format!(
        r#","images":[{{"uri":"data:image/png;base64,{picture}"}}],
        "samplers":[{{{sampler}}}],"textures":[{{"source":0,"sampler":0}}]"#
    )
}

#[track_caller]
fn check_gltf(material: &str, root: &str, nodes: &str, expected: &[&str]) {
    check(&[("a.gltf", gltf(material, root, nodes).as_bytes())], expected);
}

#[test]
fn materials_of_gltf() {
    let red = r#""pbrMetallicRoughness":{"baseColorFactor":[1,0,0,0.4]}"#;
    let unlit = |rest: &str| format!(r#""extensions":{{"KHR_materials_unlit":{{}}}},{rest}"#);
    check_gltf(&unlit(red), "", "", &["c c1 1 0 0 0", "f c1 1", "!warning"]);
    check_gltf(
        &unlit(&format!(r#"{TEXTURED},"normalTexture":{{"index":0}},"emissiveFactor":[1,1,1]"#)),
        &with_picture(""),
        "",
        &["tex c1 within opaque", "f c1 1", "!warning", "!_light"],
    );
    for (sampler, expected) in [
        (r#""magFilter":9728,"minFilter":9728"#, "tex c1 within opaque nearest"),
        (r#""magFilter":9729"#, "tex c1 within opaque"),
        ("", "tex c1 within opaque"),
    ] {
        check_gltf(TEXTURED, &with_picture(sampler), "", &[expected, "!warning"]);
    }
    // Alpha is cut off after the factor; without a picture everywhere or nowhere.
    let masked = |cutoff: f64| format!(r#"{red},"alphaMode":"MASK","alphaCutoff":{cutoff}"#);
    check_gltf(&masked(0.3), "", "", &["c c1 1 0 0 0", "!warning"]);
    let clear = "warning: all faces are wholly transparent, as `c1` is (`Tr 1`, `d 0` or alpha 0): \
                 they are drawn opaque";
    check_gltf(&masked(0.5), "", "", &["c c1 1 0 0 0", clear]);
    let factor = TEXTURED.replace("{\"base", "{\"baseColorFactor\":[1,1,1,0.6],\"base");
    let texture = format!(r#"{factor},"alphaMode":"MASK","alphaCutoff":0.25"#);
    check_gltf(&texture, &with_picture(""), "", &["tex c1 within mask 0.25", "!warning"]);
    // What is not read is told once, by name.
    check_gltf(
        &format!(r#"{TEXTURED},"normalTexture":{{"index":0}},"occlusionTexture":{{"index":0}}"#),
        &with_picture(""),
        "",
        &["warning: textures of these kinds are not read: normal, occlusion"],
    );
    check_gltf(
        red,
        r#","extensionsUsed":["KHR_materials_clearcoat","KHR_texture_transform","X_y"],
        "animations":[{"channels":[]}]"#,
        "",
        &[
            "warning: extensions that are not read: `KHR_materials_clearcoat`, `X_y`",
            "warning: animations are not read: everything is at rest where its node is",
        ],
    );
}

#[test]
fn cameras_of_gltf() {
    let tan = libm::tan(0.25);
    let [down, across] =
        [tan, tan * 4.0 / 3.0].map(|tan| (2e3 * libm::atan(tan).to_degrees()).round() / 1e3);
    let cameras = r#","cameras":[{"type":"perspective","perspective":{"yfov":0.5,"znear":0.1}},
        {"type":"orthographic","orthographic":{"xmag":2,"ymag":1,"zfar":9,"znear":0}},
        {"type":"perspective","perspective":{"yfov":0.5,"znear":0.1,"aspectRatio":1}},
        {"type":"perspective","perspective":{"yfov":0}}]"#;
    // The second looks along -x, since it is turned about y by a right angle.
    let nodes = r#",{"camera":0,"name":"main view","translation":[0.5,0.5,4]},
        {"camera":1,"rotation":[0,0.7071067811865476,0,0.7071067811865476],"translation":[2.5,0.5,0]},
        {"camera":2,"translation":[0.5,0.5,-4]},{"camera":3}"#;
    check_gltf(
        "",
        cameras,
        nodes,
        &[
            &format!(
                "cam main_view Perspective 0.5 0.5 4 to 0.5 0.5 0 up 0 1 0 angles {across} {down}"
            ),
            "cam camera2 Orthographic 2.5 0.5 0 to 0.5 0.5 0 up 0 1 0 angles 90 53.13",
            // Behind it is the mesh; the view centre is as far ahead.
            &format!(
                "cam camera3 Perspective 0.5 0.5 -4 to 0.5 0.5 -8 up 0 1 0 angles {down} {down}"
            ),
            "note: the view is that of the camera `main_view` of the file; others can be selected \
             by name: `camera2`, `camera3`",
            "warning: 1 camera is left out, since it makes no picture",
            "!camera4",
        ],
    );
    let missing = gltf("", "", r#",{"camera":7}"#);
    refused(
        &[("a.gltf", missing.as_bytes())],
        "`cameras[7]` does not exist; export the mesh again",
    );
}

/// 1 cd/m² is full white, so π lux, or π candela at the distance 1, light a white face fully.
#[test]
fn lights_of_gltf() {
    let lights = r#","extensions":{"KHR_lights_punctual":{"lights":[
        {"type":"point","color":[1,0,0],"intensity":50,"range":9},
        {"type":"directional","intensity":3.5,"name":"sun"},{"type":"directional","color":[0.5,0.5,0.5]},
        {"type":"spot","intensity":2,"spot":{"innerConeAngle":0.1,"outerConeAngle":0.5}},
        {"type":"spot"},{"type":"area"},{"type":"point","intensity":1e400}]}}"#
        .replace("1e400", "1e300");
    let turned = r#""rotation":[0,0.7071067811865476,0,0.7071067811865476]"#;
    let light = |row: usize, rest: &str| {
        format!(r#",{{"extensions":{{"KHR_lights_punctual":{{"light":{row}}}}}{rest}}}"#)
    };
    let nodes = [
        light(0, r#","translation":[0,0,3],"name":"lamp""#),
        light(1, &format!(",{turned}")),
        light(2, r#","scale":[2,2,2]"#),
        light(3, &format!(r#",{turned},"translation":[4,5,6]"#)),
        light(4, ""),
        light(5, ""),
    ]
    .concat();
    check_gltf(
        "",
        &lights,
        &nodes,
        &[
            "l lamp 50 at 0 0 3 1 lamp_light",
            "c lamp_light 1 0 0 0",
            // Light comes from where the node does not point.
            "l sun 3.5 from 1 0 0 white",
            "l - 0.5 from 0 0 1 white",
            "l - 2 at 4 5 6 1 spot -1 0 0 28.648 22.918 white",
            "l - 1 at 0 0 0 1 spot 0 0 -1 45 45 white",
            "warning: a light of the kind `area` is not read",
        ],
    );
    let missing = gltf("", "", &light(0, ""));
    refused(&[("a.gltf", missing.as_bytes())], "light 0 does not exist; export the mesh again");
}

#[test]
fn what_other_formats_have_is_told() {
    let off = b"STOFF\n3 1 0\n0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n";
    let told = "warning: texture coordinates are not read, since OFF names no picture";
    check(&[("a.off", off)], &["f -", told]);
    let mut stl = vec![0; 84];
    stl[..6].copy_from_slice(b"COLOR=");
    stl[80] = 1;
    stl.extend(
        [0f32; 3]
            .into_iter()
            .chain([0., 0., 0., 1., 0., 0., 0., 1., 0.])
            .flat_map(f32::to_le_bytes),
    );
    stl.extend([0, 0]);
    let told = "warning: colours of triangles are not read, since STL has no standard for them";
    check(&[("a.stl", &stl)], &["f -", told]);
    stl[..6].fill(0);
    check(&[("a.stl", &stl)], &["f -", "!warning"]);
    stl[133] = 0x80;
    check(&[("a.stl", &stl)], &["f -", told]);
    let edges = ply("", "", "", "").replace(
        "end_header",
        "element edge 1\nproperty int vertex1\nelement none 0\nproperty int x\nend_header",
    ) + "7\n";
    check(&[("a.ply", edges.as_bytes())], &["warning: elements that are not read: `edge`"]);
}

#[test]
fn a_mesh_without_faces_is_refused_by_what_it_has() {
    let points = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    let obj = |rest: &str, expected: &str| {
        refused(&[("a.obj", format!("{points}{rest}").as_bytes())], expected);
    };
    let cloud = "the mesh has no faces, only 3 points; make a surface of the cloud first";
    obj("", cloud);
    obj("p 1 2 3", cloud);
    obj("l 1 2", "the mesh has no faces, only lines; give them a thickness");
    obj("f 1 2 1", "the mesh has no faces with an area: all 1 are left out");
    let empty = "the mesh has no faces: it is empty";
    refused(&[("a.obj", b"# nothing\n")], empty);
    refused(&[("a.stl", b"solid a\nendsolid a\n")], empty);
    refused(&[("a.gltf", br#"{"asset":{"version":"2.0"}}"#)], empty);
    let header = "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n\
                  property float z\n";
    let one = "the mesh has no faces, only 1 point; make a surface of the cloud first";
    refused(&[("a.ply", format!("{header}end_header\n0 0 0\n").as_bytes())], one);
    let splats =
        format!("{header}property float f_dc_0\nproperty float scale_0\nend_header\n0 0 0 1 1\n");
    let told = "the mesh has no faces, only Gaussian splats; convert them to a mesh";
    refused(&[("a.ply", splats.as_bytes())], told);
    let cloud = gltf("", "", "").replace("\"material\":0", "\"material\":0,\"mode\":0");
    let told = "the mesh has no faces, only points; make a surface of the cloud first";
    refused(&[("a.gltf", cloud.as_bytes())], told);
    // Cameras and lights are enough for a scene that includes them.
    let camera = r#"{"asset":{"version":"2.0"},"nodes":[{"camera":0}],
        "cameras":[{"type":"perspective","perspective":{"yfov":0.5,"znear":0.1}}]}"#;
    check(&[("a.gltf", camera.as_bytes())], &["warning: the mesh has no faces: it is empty"]);
}
