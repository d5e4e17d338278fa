//! Formats by their content, axes, and the mean colours of textures.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, its helpers too")]

mod parts;

use glam::DVec3;
use ugimage::{Compression, Format, Frame, LinearFrame, Metadata};
use ugmeshfile::{Axis, MeshFormat, from_z_up, read, to_z_up};
use ugscene::ColorValue;

#[test]
fn meshes_are_told_from_scenes() {
    fn check(name: &str, bytes: &[u8], expected: Option<MeshFormat>) {
        let shown = String::from_utf8_lossy(bytes);
        assert_eq!(MeshFormat::detect_mesh(name, bytes), expected, "{name}: {shown}");
    }
    check("ship.ug", b"v a 0 0 0;", None);
    check("ship.obj", b"v a 0 0 0;", None);
    check("ship.obj", b"{ a comment }\nv a 0 0 0;", None);
    check("<stdin>", b"# 7 \"ship.ug\"\nx a;", None);
    check("<stdin>", b"", None);
    check("photo.jpg", b"\xff\xd8\xff", None);
    check("ship.obj", b"# by a tool; 1999\nv 0 0 0\n", Some(MeshFormat::Obj));
    check("<stdin>", b"v 0 0 0\nv 1 0 0\n", Some(MeshFormat::Obj));
    check("ship.ug", b"ply\nformat ascii 1.0\ncomment a; b\n", Some(MeshFormat::Ply));
    check("a.gltf", b"{\"asset\": {}, \"uri\": \"data:a;base64,\"}", Some(MeshFormat::Gltf));
    check("a.gltf", b"v a 0 0 0;", Some(MeshFormat::Gltf));
    check("a.glb", b"", Some(MeshFormat::Gltf));
    // JSON is no comment, wherever its keys are, and whether it is glTF or not.
    let late = format!("{{\"accessors\": [{}1], \"asset\": {{}}}}", "1, ".repeat(30_000));
    for name in ["a.gltf", "a.json", "a.ug", "<stdin>"] {
        check(name, late.as_bytes(), Some(MeshFormat::Gltf));
        check(name, &late.as_bytes()[..80_000], Some(MeshFormat::Gltf));
        check(name, b"\xef\xbb\xbf { \"a\": 1 }\n", Some(MeshFormat::Gltf));
        check(name, b"{\"min\": NaN, \"asset\": {}}", Some(MeshFormat::Gltf));
    }
    check("a.ug", b"{\"title\": \"JSON in a comment\"} v a 0 0 0;", None);
    check("a.ug", b"{\"quoted\" comment} v a 0 0 0;", None);
    // A name of a group may have a semicolon.
    check("a.obj", b"v 0 0 0\ng a;b\n", Some(MeshFormat::Obj));
    let stl = [&[b';'; 80][..], &[0; 4]].concat();
    check("a", &stl, Some(MeshFormat::Stl));
}

#[test]
fn formats_are_detected() {
    fn check(name: &str, bytes: &[u8], expected: Option<MeshFormat>) {
        assert_eq!(
            MeshFormat::detect(name, bytes),
            expected,
            "{name}: {}",
            String::from_utf8_lossy(bytes)
        );
    }
    let stdin = "<stdin>";
    check(stdin, b"ply\nformat ascii 1.0\n", Some(MeshFormat::Ply));
    check("liar.obj", b"ply\r\nformat ascii 1.0\r\n", Some(MeshFormat::Ply));
    check(stdin, b"glTF\x02\0\0\0", Some(MeshFormat::Gltf));
    check(stdin, b" {\n \"asset\": {\"version\": \"2.0\"}}", Some(MeshFormat::Gltf));
    check(stdin, b"{ a licence }\nv a 0 0 0;", Some(MeshFormat::Ug));
    check(stdin, b"{\"quoted\"} v a 0 0 0;", Some(MeshFormat::Ug));
    check(stdin, b"v a 0 0 0;", Some(MeshFormat::Ug));
    check(stdin, b"v 7 0 0 0;", Some(MeshFormat::Ug));
    check(stdin, b"v 7\n0 0 0;", Some(MeshFormat::Ug));
    check(stdin, b"(escape)", Some(MeshFormat::Ug));
    check(stdin, b"# a cube\n\nv 0 0 0\n", Some(MeshFormat::Obj));
    check(stdin, b"\xef\xbb\xbf# byte order mark\nmtllib a.mtl\n", Some(MeshFormat::Obj));
    check(stdin, b"g cube\nv 0 0 0\n", Some(MeshFormat::Obj));
    check(stdin, b"solid\nfacet normal 0 0 1\n", Some(MeshFormat::Stl));
    check(stdin, &[&b"solid binary"[..], &[0; 72]].concat(), Some(MeshFormat::Stl));
    check(stdin, b"# cube\nOFF\n8 6 12\n", Some(MeshFormat::Off));
    check(stdin, b"STCNOFF\n", Some(MeshFormat::Off));
    check(stdin, b"BOFF\n", None);
    check(stdin, b"", None);
    check(stdin, b"# nothing\n", None);
    check(stdin, b"\x7fELF", None);
    check("cube.STL", b"", Some(MeshFormat::Stl));
    check("cube.ug", b"f (a b c);", Some(MeshFormat::Ug));
    check("a.b/cube", b"", None);
}

#[test]
fn up_is_a_rotation() {
    let p = DVec3::new(0.1, -0.2, 0.3);
    for (up, axis) in [(Axis::X, DVec3::X), (Axis::Y, DVec3::Y), (Axis::Z, DVec3::Z)] {
        assert_eq!(to_z_up(up, axis), DVec3::Z);
        assert_eq!(from_z_up(up, to_z_up(up, p)), p);
        let [x, y, z] = DVec3::AXES.map(|axis| to_z_up(up, axis));
        assert_eq!(x.cross(y), z, "{up:?} is no mirror");
    }
    assert!(to_z_up(Axis::Y, DVec3::ZERO).y.is_sign_positive());
}

#[test]
fn faces_have_the_mean_linear_light_of_their_textures() {
    let check = |texture: Vec<u8>, expected: [f64; 3]| {
        let beside = |name: &str, _: u64| {
            let materials = b"newmtl paper\nKd 1 1 1\nmap_Kd texture\n".to_vec();
            Ok(if name == "texture" { texture.clone() } else { materials })
        };
        let mesh = b"mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl paper\nf 1 2 3\n";
        let mesh =
            read(MeshFormat::Obj, mesh, &beside, "").map_err(|problem| problem.what).unwrap();
        let ColorValue::Rgb(rgb) = mesh.scene.colors[0].value else {
            panic!("not red, green and blue")
        };
        let light = rgb.map(ugphysics::srgb_decode);
        assert!(
            light.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-3),
            "{light:?} {expected:?}"
        );
    };
    let png = |pixels: Vec<[u8; 4]>, is_opaque: bool| {
        Format::Png.encode(&Frame::new([2, 1], is_opaque, pixels), &Metadata::default())
    };
    // Half black and half white is half the light, which is not byte 128.
    check(png(vec![[0, 0, 0, 255], [255; 4]], true), [0.5; 3]);
    check(png(vec![[255, 0, 0, 0], [0, 0, 255, 255]], false), [0.0, 0.0, 1.0]);
    let light = LinearFrame::new([2, 1], true, vec![[0.75, 0.0, 0.0, 1.0], [0.25, 0.0, 0.5, 1.0]]);
    let exr = Format::Exr.encode_linear(&light, &Metadata::default(), Compression::Fast);
    check(exr, [0.5, 0.0, 0.25]);
}
