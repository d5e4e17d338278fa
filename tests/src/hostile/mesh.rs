//! Meshes in the formats that `ugmesh` reads.

use std::fmt::Write;

use ugmesh::MeshFormat;
use ugtesting::Random;

use super::{Files, bytes, words};

/// A mesh and the files it names.
pub fn files(random: &mut Random) -> (Files, &'static str) {
    let (name, format) = *random.pick(&[
        ("mesh.obj", MeshFormat::Obj),
        ("mesh.off", MeshFormat::Off),
        ("mesh.ply", MeshFormat::Ply),
        ("mesh.stl", MeshFormat::Stl),
        ("mesh.gltf", MeshFormat::Gltf),
    ]);
    let mut mesh = of(format, random);
    if random.one_in(2) {
        bytes::damage(random, &mut mesh);
    }
    let material = format!("newmtl {}\nKd {} 0 0\n", words::name(random), words::number(random)).into_bytes();
    (vec![(name.to_owned(), mesh), ("material.mtl".to_owned(), material)], "mesh")
}

/// A mesh file of a format.
pub fn of(format: MeshFormat, random: &mut Random) -> Vec<u8> {
    match format {
        MeshFormat::Ug => super::scene::text(random),
        MeshFormat::Obj => obj(random).into_bytes(),
        MeshFormat::Off => off(random).into_bytes(),
        MeshFormat::Ply => ply(random),
        MeshFormat::Stl => stl(random),
        MeshFormat::Gltf => {
            let json = gltf(random).into_bytes();
            if random.one_in(3) { glb(random, json) } else { json }
        }
    }
}

fn rows(random: &mut Random, n: usize, line: impl Fn(&mut Random) -> String) -> String {
    (0..n).map(|_| line(random) + "\n").collect()
}

fn point(random: &mut Random) -> String {
    [(); 3].map(|()| words::number(random)).join(" ")
}

fn obj(random: &mut Random) -> String {
    let n = 3 + random.below(9);
    let library = *random.pick(&["material.mtl", "/dev/zero", "missing.mtl", "."]);
    let mut text = format!("mtllib {library}\n");
    text += &rows(random, n, |random| format!("v {}", point(random)));
    for _ in 0..1 + random.below(8) {
        let n_corners = if random.one_in(20) { random.below(3000) } else { 3 + random.below(4) };
        let corners: Vec<String> = (0..n_corners)
            .map(|_| format!("{}", random.below(n + 2) as i64 - i64::from(random.one_in(9))))
            .collect();
        let _ = writeln!(text, "usemtl {}\nf {}", words::name(random), corners.join(" "));
    }
    text
}

fn off(random: &mut Random) -> String {
    let (n, n_faces) = (3 + random.below(9), 1 + random.below(6));
    let told = if random.one_in(6) { "4000000000".to_owned() } else { n.to_string() };
    let mut text = format!("OFF\n{told} {n_faces} 0\n");
    text += &rows(random, n, point);
    text += &rows(random, n_faces, |random| {
        let corners = [(); 3].map(|()| random.below(n + 1).to_string());
        format!("3 {}", corners.join(" "))
    });
    text
}

fn ply(random: &mut Random) -> Vec<u8> {
    let n = 3 + random.below(5);
    let is_text = random.one_in(2);
    let format = if is_text { "ascii" } else { "binary_little_endian" };
    let told = if random.one_in(6) { "4000000000".to_owned() } else { n.to_string() };
    let mut bytes = ply_header(format, &told, 1).into_bytes();
    if is_text {
        bytes.extend(rows(random, n, point).into_bytes());
        bytes.extend(b"3 0 1 2\n");
    } else {
        (0..3 * n).for_each(|_| bytes.extend(f32::to_le_bytes(random.between(-2.0, 2.0) as f32)));
        bytes.push(3);
        (0..3u32).for_each(|corner| bytes.extend(corner.to_le_bytes()));
    }
    bytes
}

/// The header of a PLY file with so many vertices, as text, and faces.
pub fn ply_header(format: &str, n_vertices: &str, n_faces: usize) -> String {
    format!(
        "ply\nformat {format} 1.0\nelement vertex {n_vertices}\nproperty float x\nproperty float y\nproperty float z\n\
         element face {n_faces}\nproperty list uchar int vertex_indices\nend_header\n"
    )
}

fn stl(random: &mut Random) -> Vec<u8> {
    let n = 1 + random.below(5);
    if random.one_in(2) {
        let facet = |random: &mut Random| {
            let corners = [(); 3].map(|()| format!("vertex {}\n", point(random))).concat();
            format!("facet normal {}\nouter loop\n{corners}endloop\nendfacet", point(random))
        };
        let facets = rows(random, n, facet);
        return format!("solid {}\n{facets}endsolid\n", words::name(random)).into_bytes();
    }
    let mut bytes = vec![b' '; 80];
    let told = if random.one_in(6) { u32::MAX } else { n as u32 };
    bytes.extend(told.to_le_bytes());
    for _ in 0..n {
        (0..12).for_each(|_| bytes.extend(f32::to_le_bytes(random.between(-2.0, 2.0) as f32)));
        bytes.extend([0, 0]);
    }
    bytes
}

fn gltf(random: &mut Random) -> String {
    let uri = *random.pick(&[
        "material.mtl",
        "/dev/zero",
        "missing.bin",
        "data:application/octet-stream;base64,AAAA",
    ]);
    let length = *random.pick(&[36, 36, 4_000_000_000_u32]);
    let name = words::name(random).escape_debug().to_string().replace("\\u{", "\\u00").replace('}', "");
    format!(
        r#"{{"asset":{{"version":"2.0"}},"buffers":[{{"uri":"{uri}","byteLength":{length}}}],
        "bufferViews":[{{"buffer":0,"byteLength":36}}],
        "accessors":[{{"bufferView":0,"componentType":5126,"count":{},"type":"VEC3"}}],
        "meshes":[{{"name":"{name}","primitives":[{{"attributes":{{"POSITION":0}}}}]}}],
        "nodes":[{{"mesh":0}}],"scenes":[{{"nodes":[0]}}],"scene":0}}"#,
        random.pick(&[3, 3, 4_000_000])
    )
}

/// The binary form of glTF, with a buffer of a triangle.
fn glb(random: &mut Random, mut json: Vec<u8>) -> Vec<u8> {
    json.resize(json.len().next_multiple_of(4), b' ');
    let buffer: Vec<u8> = (0..9).flat_map(|_| f32::to_le_bytes(random.between(-2.0, 2.0) as f32)).collect();
    let told = |random: &mut Random, n: usize| if random.one_in(8) { u32::MAX } else { n as u32 };
    let mut bytes = b"glTF".to_vec();
    bytes.extend(2_u32.to_le_bytes());
    bytes.extend(told(random, 28 + json.len() + buffer.len()).to_le_bytes());
    for (kind, content) in [(*b"JSON", json), (*b"BIN\0", buffer)] {
        bytes.extend(told(random, content.len()).to_le_bytes());
        bytes.extend(kind);
        bytes.extend(content);
    }
    bytes
}
