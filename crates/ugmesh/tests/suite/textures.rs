//! Textures: from meshes to scenes and back.

use std::io;
use std::sync::Arc;

use ugmesh::{Config, MeshFile, MeshFormat, PictureFiles, Target};
use ugparse::{Options, Source};
use ugscene::{AlphaMode, Scene, Wrap};
use ugtesting::Random;

/// Names and bytes of pictures.
type Pictures = Vec<(String, Arc<[u8]>)>;

/// A cube with a picture of 32 x 32 pixels on its sides.
const CRATE: &[u8] = include_bytes!("../../../../scenes/crate.gltf");

/// A red pixel.
fn pixel() -> Vec<u8> {
    let red = ugimage::Frame::new([1, 1], true, vec![[255, 0, 0, 255]]);
    ugimage::Format::Png.encode(&red, &ugimage::Metadata::default())
}

fn read(bytes: &[u8]) -> Scene {
    let no_files = |_: &str, _| Err(io::ErrorKind::NotFound.into());
    ugmeshfile::read(MeshFormat::Gltf, bytes, &no_files, "")
        .map_err(|problem| problem.what)
        .unwrap()
        .scene
}

/// The text of a scene with its pictures, which are written beside it.
fn to_text(name: &str, mesh: &[u8]) -> (String, Pictures) {
    let pictures = Some(PictureFiles { stem: "it".into(), is_beside_mesh: false });
    let config = Config { pictures, ..Config::default() };
    let converted = ugmesh::run(&config, &MeshFile::new(name, mesh)).unwrap();
    (String::from_utf8(converted.bytes).unwrap(), converted.pictures)
}

/// A scene with pictures as another mesh.
fn to_mesh(target: Target, text: &str, pictures: &[(String, Arc<[u8]>)]) -> Vec<u8> {
    let resolve = |source: Source| {
        ugparse::include(source, &Options::default(), |request| {
            let picture =
                pictures.iter().find(|(name, _)| *name == request.path.display().to_string());
            picture
                .map(|(_, bytes)| bytes.to_vec())
                .ok_or_else(|| io::Error::other("no such file").into())
        })
    };
    let config = Config { target, ..Config::default() };
    let input = MeshFile::new("it.ug", text).with_includes(&resolve);
    ugmesh::run(&config, &input).unwrap().bytes
}

fn uvs(scene: &Scene) -> Vec<Option<[u32; 2]>> {
    scene.vertices.iter().map(|vertex| vertex.uv.map(|uv| uv.map(f32::to_bits))).collect()
}

/// Pictures keep their bytes, coordinates their bits, and textures what glTF says of them.
#[test]
fn textures_survive_a_round_trip() {
    let (text, pictures) = to_text("crate.gltf", CRATE);
    assert!(text.contains("c_tex wood \"it_texture1.png\" -wrap clamp;"), "{text}");
    let before = read(CRATE);
    for target in [Target::Glb, Target::Gltf] {
        let after = read(&to_mesh(target, &text, &pictures));
        assert_eq!(uvs(&after), uvs(&before));
        assert_eq!(after.textures[0].image.bytes, before.textures[0].image.bytes);
        assert_eq!(*after.textures[0].image.bytes, *pictures[0].1);
        assert_eq!(after.textures[0].wrap, [Wrap::Clamp; 2]);
    }
    // Any coordinates, factors and alpha.
    let mut random = Random(3);
    let files = [("a.png".to_string(), Arc::from(pixel()))];
    for alpha in ["", "-mask 0.25", "-blend"] {
        let mut number = || f32::from_bits((random.bits() as u32 & 0x8fff_ffff) | 0x3000_0000);
        let [mut corners, mut names] = [String::new(), String::new()];
        for at in 0..40 {
            // On a parabola.
            let x = f64::from(at) / 7.0;
            corners += &format!("v a{at} {x} {} 0 ({} {});\n", x * x, number(), number());
            names += &format!("a{at} ");
        }
        let text = format!(
            "c_rgb w 1 0 0; c_tex w a.png -wrap mirror repeat -factor .1 .7 .3 .9 {alpha};\n{corners}f ({names}) w;"
        );
        let source = Source::new("a.ug", text.as_str());
        let expected = ugparse::parse(&source, &Options::default()).unwrap().scene;
        let found = read(&to_mesh(Target::Glb, &text, &files));
        assert_eq!(uvs(&found), uvs(&expected));
        let (found, expected) = (&found.textures[0], &expected.textures[0]);
        assert_eq!((found.wrap, found.factor), (expected.wrap, expected.factor));
        assert_eq!(found.alpha, expected.alpha, "{alpha}");
    }
}

/// Colours of vertices and a texture: what multiplies texels stays, though colours that are read
/// contain the mean of the picture, for programs that draw no texels.
#[test]
fn tints_survive_a_round_trip() {
    let (text, pictures) = to_text("crate.gltf", CRATE);
    let tinted =
        format!("c_rgb tint .9 .5 .7;\n{text}").replace(" (", " tint (").replace("f tint (", "f (");
    let tinted = tinted.replace("f crate tint (", "f crate (");
    let tint = |scene: &Scene| {
        let vertex = scene.vertices[0].color.unwrap();
        let ugscene::ColorValue::Rgb(rgb) = scene.colors[vertex.index()].value else {
            panic!("no c_rgb")
        };
        let [red, green, blue, _] = scene.textures[0].factor.map(f64::from);
        let light = rgb.map(ugphysics::srgb_decode);
        [light[0] * red, light[1] * green, light[2] * blue]
    };
    let first = to_mesh(Target::Glb, &tinted, &pictures);
    let (again, pictures) = to_text("a.glb", &first);
    let second = to_mesh(Target::Glb, &again, &pictures);
    for mesh in [first, second] {
        let scene = read(&mesh);
        let off = tint(&scene)
            .into_iter()
            .zip([0.9, 0.5, 0.7])
            .map(|(a, b)| (a - ugphysics::srgb_decode(b)).abs());
        assert!(off.fold(0.0, f64::max) < 1e-6, "{:?}", tint(&scene));
        // The plain colour is darker, as the picture is.
        assert!(
            scene.textures[0].factor.iter().take(3).all(|&part| part > 1.2),
            "{:?}",
            scene.textures[0].factor
        );
    }
}

/// Emitted light, its factor above 1 and its picture, in glTF and back, and from OBJ.
#[test]
fn emitted_light_survives_a_round_trip() {
    let crate_text = String::from_utf8(CRATE.to_vec()).unwrap();
    let with = |material: &str| crate_text.replacen("\"doubleSided\": true,", material, 1);
    let strong = "\"extensions\":{\"KHR_materials_emissive_strength\":{\"emissiveStrength\":4}},";
    let light = |scene: &Scene| {
        let emitted = scene.emitted_by(scene.faces[0].color.unwrap())?;
        let texture = scene.texture_of(emitted).map(|it| (it.factor, it.image.bytes.len()));
        Some((texture, uglight::RestColor::new(scene, Some(emitted)).linear()))
    };
    for (emissive, n_bytes, factor) in [
        (
            format!("{strong}\"emissiveFactor\":[1,0.5,0.25],\"emissiveTexture\":{{\"index\":0}},"),
            180,
            [4.0, 2.0, 1.0],
        ),
        (format!("{strong}\"emissiveFactor\":[1,0.5,0.25],"), 0, [4.0, 2.0, 1.0]),
        (
            "\"emissiveFactor\":[0.5,0.5,0.25],\"emissiveTexture\":{\"index\":0},".into(),
            180,
            [0.5, 0.5, 0.25],
        ),
        ("\"emissiveFactor\":[0.5,0.5,0.25],".into(), 0, [0.5, 0.5, 0.25]),
    ] {
        let mesh = with(&emissive);
        assert_ne!(mesh, crate_text);
        let (text, pictures) = to_text("crate.gltf", mesh.as_bytes());
        assert!(text.contains("c_emit wood wood_light"), "{text}");
        for scene in [read(mesh.as_bytes()), read(&to_mesh(Target::Glb, &text, &pictures))] {
            let (texture, plain) = light(&scene).unwrap();
            if n_bytes > 0 {
                let [red, green, blue] = factor;
                assert_eq!(texture, Some(([red, green, blue, 1.0], n_bytes)));
            } else {
                assert!(plain.distance(factor.map(f64::from).into()) < 1e-6, "{plain}");
                assert_eq!(texture, None);
            }
        }
    }
    // Without a factor, a texture emits nothing; with other coordinates it lends its mean.
    assert!(light(&read(with("\"emissiveTexture\":{\"index\":0},").as_bytes())).is_none());
    let other =
        with("\"emissiveFactor\":[1,1,1],\"emissiveTexture\":{\"index\":0,\"texCoord\":1},");
    let converted =
        ugmesh::run(&Config::default(), &MeshFile::new("a.gltf", other.as_str())).unwrap();
    let warnings = converted.warnings.join("\n");
    assert!(warnings.contains("emissive (with coordinates of their own)"), "{warnings}");
    let (texture, plain) = light(&read(other.as_bytes())).unwrap();
    assert!(texture.is_none() && plain.min_element() > 0.01, "{plain}");
    // OBJ, with and without a colour beside the picture.
    let obj = b"mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nusemtl m\nf 1/1 2/2 3/3\n";
    for (material, expected) in [
        ("map_Ke a.png", Some([1.0, 1.0, 1.0, 1.0])),
        ("Ke 0 0 0\nmap_Ke a.png", Some([1.0, 1.0, 1.0, 1.0])),
        ("Ke 3 3 0\nmap_Ke a.png", Some([3.0, 3.0, 0.0, 1.0])),
        ("Ke 3 3 0", None),
    ] {
        let files = |name: &str, _: u64| match name {
            "a.mtl" => Ok(format!("newmtl m\nKd .5 1 1\n{material}\n").into_bytes()),
            "a.png" => Ok(pixel()),
            _ => Err(io::ErrorKind::NotFound.into()),
        };
        let scene = ugmeshfile::read(MeshFormat::Obj, obj, &files, "")
            .map_err(|problem| problem.what)
            .unwrap();
        let (texture, plain) = light(&scene.scene).unwrap();
        assert_eq!(texture.map(|it| it.0), expected, "{material}");
        assert_eq!(scene.scene.vertices[1].uv.is_some(), expected.is_some());
        assert!(expected.is_some() || plain.distance([3.0, 3.0, 0.0].into()) < 1e-6, "{plain}");
    }
    let plain =
        ugmeshfile::read(MeshFormat::Obj, obj, &|_, _| Ok(b"newmtl m\nKe 0 0 0".to_vec()), "");
    assert!(plain.map_err(|problem| problem.what).unwrap().scene.emissions.is_empty());
}

/// Formats without textures, and a scene whose pictures have no place.
#[test]
fn what_is_lost_is_said() {
    let (text, pictures) = to_text("crate.gltf", CRATE);
    let obj = String::from_utf8(to_mesh(Target::Obj, &text, &pictures)).unwrap();
    assert!(obj.contains("usemtl wood") && !obj.contains("vt "), "{obj}");
    let notes = |name: &str| ugmesh::run(&Config::default(), &MeshFile::new(name, CRATE)).unwrap();
    let named = notes("box/crate.gltf");
    assert!(named.notes.is_empty() && named.pictures.is_empty());
    assert!(
        String::from_utf8(named.bytes)
            .unwrap()
            .contains("c_tex wood \"box/crate.gltf\" -image 0 -wrap clamp;")
    );
    let piped = notes("<stdin>");
    assert!(piped.lacks_pictures && !named.lacks_pictures);
    assert!(!String::from_utf8(piped.bytes).unwrap().contains("c_tex"));
    let no_files = |_: &str, _| Err(io::ErrorKind::NotFound.into());
    let picture = |row| ugmeshfile::picture_within(CRATE, row, &no_files);
    assert_eq!(picture(0).unwrap(), *read(CRATE).textures[0].image.bytes);
    assert!(picture(1).unwrap_err().contains("`images[1]` does not exist"));
}

/// Corners of one place and several coordinates are several vertices; `v` points up in OBJ.
#[test]
fn seams_of_obj_divide_vertices() {
    let obj = b"mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\nvt 0 0\nvt 1 0\nvt 1 .75\nvt 0 1\n\
                usemtl m\nf 1/1 2/2 3/3 4/4\nf 2/1 5/2 6/3 3/4\nusemtl plain\nf 4/2 3/2 1/2\n";
    let png = pixel();
    let files = |name: &str, _: u64| match name {
        "a.mtl" => Ok(b"newmtl m\nKd .5 1 1\nmap_Kd a.png\nnewmtl plain\nKd 1 1 1\n".to_vec()),
        "a.png" => Ok(png.clone()),
        _ => Err(io::ErrorKind::NotFound.into()),
    };
    let scene = ugmeshfile::read(MeshFormat::Obj, obj, &files, "")
        .map_err(|problem| problem.what)
        .unwrap()
        .scene;
    let of_face = |row: usize| {
        let corners = scene.contours.corners(scene.faces[row].contours.clone());
        corners
            .iter()
            .map(|corner| (corner.index(), scene.vertices[corner.index()].uv))
            .collect::<Vec<_>>()
    };
    let square = [[0.0, 1.0], [1.0, 1.0], [1.0, 0.25], [0.0, 0.0]].map(Some);
    assert_eq!(of_face(0).iter().map(|corner| corner.1).collect::<Vec<_>>(), square);
    assert_eq!(of_face(1).iter().map(|corner| corner.1).collect::<Vec<_>>(), square);
    // The new ones follow all others; a face without a texture has no coordinates.
    assert_eq!(of_face(1).iter().map(|corner| corner.0).collect::<Vec<_>>(), [6, 4, 5, 7]);
    assert!(of_face(2).iter().all(|corner| corner.1.is_none()));
    let texture = &scene.textures[0];
    let half = ugphysics::srgb_decode(0.5) as f32;
    assert_eq!((texture.factor, texture.alpha), ([half, 1.0, 1.0, 1.0], AlphaMode::Opaque));
    assert_eq!(texture.image.file.as_deref(), Some("a.png"));
}

/// A quarter turn counterclockwise, as `KHR_texture_transform` defines it for coordinates with v
/// downwards, after a scale and before an offset.
#[test]
fn coordinates_are_transformed() {
    let text = String::from_utf8(CRATE.to_vec()).unwrap();
    let turned = text.replacen(
        "\"baseColorTexture\": {",
        "\"baseColorTexture\": {\"extensions\":{\"KHR_texture_transform\":{\"offset\":[0.25,0.5],\
         \"rotation\":1.5707963267948966,\"scale\":[2,3]}},",
        1,
    );
    assert_ne!(turned, text);
    let (before, after) = (read(CRATE), read(turned.as_bytes()));
    for (before, after) in before.vertices.iter().zip(&after.vertices) {
        let ([u, v], [x, y]) = (before.uv.unwrap(), after.uv.unwrap());
        assert!(
            (x - (0.25 + 3.0 * v)).abs() < 1e-6 && (y - (0.5 - 2.0 * u)).abs() < 1e-6,
            "{u} {v}: {x} {y}"
        );
    }
}

/// Damaged pictures and references leave the mesh as it is without them, with a warning.
#[test]
fn damaged_textures_leave_a_plain_colour() {
    let text = String::from_utf8(CRATE.to_vec()).unwrap();
    let cases = [
        ("\"index\": 0", "\"index\": 9", "texture 9"),
        ("\"source\": 0", "\"source\": 7", "texture 0"),
        ("\"mimeType\": \"image/png\"", "\"uri\": \"data:image/png;base64,AAAA\"", "image 0"),
        (
            "\"mimeType\": \"image/png\"",
            "\"uri\": \"https://example.org/a.png\"",
            "https://example.org/a.png",
        ),
        ("\"mimeType\": \"image/png\"", "\"uri\": \"missing.png\"", "missing.png"),
    ];
    for (from, to, name) in cases {
        let damaged = text.replacen(from, to, 1);
        assert_ne!(damaged, text, "{from}");
        let converted = ugmesh::run(&Config::default(), &MeshFile::new("a.gltf", damaged)).unwrap();
        let warning = format!("texture `{name}`");
        assert!(
            converted.warnings.iter().any(|found| found.starts_with(&warning)),
            "{:?}",
            converted.warnings
        );
        assert!(!String::from_utf8(converted.bytes).unwrap().contains("c_tex"));
    }
    for (cut, step) in [(0, 37), (1, 61)] {
        // Bytes that are missing or changed anywhere.
        for at in (0..CRATE.len()).step_by(step) {
            let mut bytes = CRATE.to_vec();
            if cut == 0 {
                bytes.truncate(at)
            } else {
                bytes[at] ^= 0x15
            }
            let _ = ugmesh::run(&Config::default(), &MeshFile::new("a.gltf", bytes));
        }
    }
}
