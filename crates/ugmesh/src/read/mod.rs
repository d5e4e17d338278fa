//! Readers: one per format, all of which fill a [`Builder`].

mod accessor;
mod gltf;
mod mtl;
mod obj;
mod off;
mod ply;
mod stl;
mod text;

use crate::builder::Builder;
use crate::error::Problem;
use crate::{MeshFile, MeshFormat};

type Reader = fn(&MeshFile, &mut Builder) -> Result<(), Problem>;

/// The reader of a mesh format; UniGrafix is read by `ugparse`.
pub(crate) fn reader(format: MeshFormat) -> Option<Reader> {
    match format {
        MeshFormat::Ug => None,
        MeshFormat::Obj => Some(obj::read),
        MeshFormat::Ply => Some(|input, builder| ply::read(&input.bytes, builder)),
        MeshFormat::Stl => Some(|input, builder| stl::read(&input.bytes, builder)),
        MeshFormat::Off => Some(|input, builder| off::read(&input.bytes, builder)),
        MeshFormat::Gltf => Some(gltf::read),
    }
}

/// The triangles of a strip of `len` corners, as indices of corners. Every second triangle is
/// reversed, so that all have the same orientation.
fn strip(len: usize) -> impl Iterator<Item = [usize; 3]> {
    (2..len).map(|last| if last % 2 == 0 { [last - 2, last - 1, last] } else { [last - 1, last - 2, last] })
}
