//! Readers: one per format, all of which fill a [`Builder`].

mod accessor;
mod corners;
mod gltf;
mod gltf_document;
mod gltf_eyes_and_lamps;
mod kind;
mod mtl;
mod named_file;
mod obj;
mod off;
mod ply;
mod stl;
mod text;

use std::cell::RefCell;

use crate::builder::Builder;
use crate::error::Problem;
use crate::foreign;
use crate::format::is_binary_stl;
use crate::{MeshFormat, MeshScene, ReadFile};

/// A mesh file during reading.
pub(crate) struct Input<'a> {
    bytes: &'a [u8],
    read_file: ReadFile<'a>,
    /// The most bytes of the pixels and mip levels of all textures.
    memory: u64,
    /// What was chosen, see [`MeshScene::notes`].
    notes: RefCell<Vec<String>>,
}

/// Reads a mesh as a scene with the axes of its file. `read_file` reads files that it names,
/// `prefix` begins the names of vertices and colours.
///
/// # Errors
/// The file is malformed or too large, or is a scene.
pub fn read(
    format: MeshFormat,
    bytes: &[u8],
    read_file: ReadFile<'_>,
    prefix: &str,
) -> Result<MeshScene, Problem> {
    read_within(format, bytes, read_file, prefix, MOST_MEMORY)
}

/// The most bytes of the pixels and mip levels of all textures that [`read`] decodes.
const MOST_MEMORY: u64 = 1 << 31;

/// Like [`read`]; textures whose pixels and mip levels would together have more than `memory`
/// bytes are left out, with a warning.
///
/// # Errors
/// As [`read`].
pub fn read_within(
    format: MeshFormat,
    bytes: &[u8],
    read_file: ReadFile<'_>,
    prefix: &str,
    memory: u64,
) -> Result<MeshScene, Problem> {
    if let Some(foreign) = foreign::by_content(bytes).filter(|_| !is_binary_stl(bytes)) {
        return Err(Problem::new(format!("it is {foreign}; {}", foreign.remedy())));
    }
    let mut builder = Builder::new(prefix);
    let input = Input { bytes, read_file, memory, notes: RefCell::default() };
    match format {
        MeshFormat::Ug => return Err(Problem::new("a scene is not a mesh")),
        MeshFormat::Obj => obj::read(&input, &mut builder)?,
        MeshFormat::Ply => ply::read(&input, &mut builder)?,
        MeshFormat::Stl => stl::read(bytes, &mut builder)?,
        MeshFormat::Off => off::read(bytes, &mut builder)?,
        MeshFormat::Gltf => gltf::read(&input, &mut builder)?,
    }
    builder.finish(input.notes.into_inner())
}

/// The bytes of a picture that a scene names by a mesh and a row: of one within a glTF file, or of
/// one that an OBJ file's materials state by two files, colours and opacity. `read_file`: as for
/// [`read`].
///
/// # Errors
/// The reason why it cannot be read.
pub fn picture_within(
    bytes: &[u8],
    row: usize,
    read_file: ReadFile<'_>,
) -> Result<Vec<u8>, String> {
    let input = Input { bytes, read_file, memory: 0, notes: RefCell::default() };
    let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes).trim_ascii_start();
    if text.starts_with(b"{") || text.starts_with(b"glTF") {
        gltf::picture(&input, row)
    } else {
        obj::picture(&input, row)
    }
    .map_err(|problem| problem.what)
}

/// The warning about a file with more than its header says.
const GOES_ON: &str = "the file goes on after what its header declares: the rest is not read";

/// The triangles of a strip of `len` corners, as indices of corners. Every second triangle is
/// reversed, so that all have the same orientation.
fn strip(len: usize) -> impl Iterator<Item = [usize; 3]> {
    (2..len).map(|last| {
        if last % 2 == 0 { [last - 2, last - 1, last] } else { [last - 1, last - 2, last] }
    })
}
