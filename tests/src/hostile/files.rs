//! Meshes, pictures, panoramas and lists of stars.

use ugimage::{Compression, Format, Frame, LinearFrame, Metadata};
use ugmesh::{MeshFile, MeshFormat, Target};
use ugtesting::Random;

use super::scene;
use super::template::{Kind, fill, name, number};
use crate::scenes;

/// A JPEG file of 64 x 32 pixels.
const JPEG: &[u8] = include_bytes!("../../../crates/ugimage/tests/bars.jpg");

/// A mesh file of a format.
pub fn mesh(random: &mut Random, kind: Kind, format: MeshFormat) -> Vec<u8> {
    let target = match format {
        MeshFormat::Obj if random.one_in(2) => Target::Obj,
        MeshFormat::Obj => {
            let text =
                "mtllib material.mtl\nv %\nv %\nv %\nv %\nvn %\nusemtl @\nf 1 2 3\nf -1//1 2 3 4\n";
            return fill(random, kind, text).into_bytes();
        }
        MeshFormat::Off => {
            let text = "OFF\n4 3 0\n%\n%\n%\n%\n3 0 1 2\n3 0 2 3 1 # #\n4 3 2 1 0\n";
            return fill(random, kind, text).into_bytes();
        }
        MeshFormat::Stl if random.one_in(2) => {
            let facet =
                "facet normal %\nouter loop\nvertex %\nvertex %\nvertex %\nendloop\nendfacet\n";
            let text = format!("solid @\n{}endsolid\n", facet.repeat(3));
            return fill(random, kind, &text).into_bytes();
        }
        MeshFormat::Stl => {
            let mut bytes = [&[b' '; 80][..], &3_u32.to_le_bytes()].concat();
            (0..3 * 50).for_each(|_| bytes.push(random.below(127) as u8));
            return bytes;
        }
        MeshFormat::Ply => Target::Ply { is_ascii: random.one_in(2) },
        MeshFormat::Gltf if random.one_in(2) => Target::Glb,
        MeshFormat::Gltf => Target::Gltf,
        MeshFormat::Ug => return scene::statements(random, kind).into_bytes(),
    };
    let name: &&str = random.pick(&["ship", "cubes", "halves"]);
    let config =
        ugmesh::Config { format: Some(MeshFormat::Ug), target, ..ugmesh::Config::default() };
    let mesh = ugmesh::run(&config, &MeshFile::new("scene.ug", scenes::text(name)));
    mesh.unwrap_or_else(|error| panic!("{error:?}")).bytes
}

/// A picture of a format, with a history.
pub fn picture(random: &mut Random, kind: Kind, format: Format) -> Vec<u8> {
    let side = *random.pick(&[1, 2, 7, 40]);
    let pixels = (0..side * side).map(|_| [random.below(256) as u8, 0, 99, 255]).collect();
    let comment = fill(random, kind, "uglorentz -vel &\nugrainbow -cap @");
    let history = Metadata { software: "ugrainbow".to_owned(), comment, ..Metadata::default() };
    format.encode(&Frame::new([side, side], false, pixels), &history)
}

/// A panorama; a wild one has a shape that is none, or light that is not finite.
pub fn panorama(random: &mut Random, kind: Kind) -> Vec<u8> {
    let size = match kind {
        Kind::Mild => *random.pick(&[[64, 32], [66, 33]]),
        Kind::Wild => *random.pick(&[[64, 32], [2, 1], [48, 8], [32, 24], [1, 1], [40, 1]]),
    };
    let n_pixels = size[0] * size[1];
    match random.below(4) {
        0 => JPEG.to_vec(),
        1 => {
            let pixels = (0..n_pixels).map(|_| [(); 4].map(|()| random.below(256) as u8)).collect();
            let format = *random.pick(&[Format::Png, Format::Png16]);
            format.encode(&Frame::new(size, false, pixels), &Metadata::default())
        }
        _ => {
            let part = |random: &mut Random| number(random, kind).parse().unwrap_or(f32::MAX);
            let pixel = |random: &mut Random| [part(random), part(random), part(random), 1.0];
            let pixels = (0..n_pixels).map(|_| pixel(random)).collect();
            let frame = LinearFrame::new(size, true, pixels);
            let format = *random.pick(&[Format::Hdr, Format::Exr]);
            format.encode_linear(&frame, &Metadata::default(), Compression::Fast)
        }
    }
}

/// A list of stars.
pub fn stars(random: &mut Random, kind: Kind) -> Vec<u8> {
    const HEADS: [&str; 4] =
        ["ra,dec,mag,kelvin", "ra_hours,dec,mag,b-v", "x,y,z,mag,kelvin", "ra,dec,mag,b-v,name"];
    let head = *random.pick(&HEADS);
    let mut text = format!("{head}\n");
    for _ in 0..random.below(12) {
        let field = |column: &str| match column {
            "kelvin" => "6000".to_owned(),
            "name" => name(random, kind),
            _ => number(random, kind),
        };
        text += &head.split(',').map(field).collect::<Vec<_>>().join(",");
        text.push('\n');
    }
    text.into_bytes()
}
