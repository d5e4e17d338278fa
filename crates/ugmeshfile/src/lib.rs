//! Meshes of other programs as scenes: OBJ with its materials, PLY, STL, OFF and glTF; and
//! [`VtkPolygons`], which several programs write.
//!
//! ```text
//! bytes ─read→ Builder → MeshScene ─z_up→ Scene
//! ```
//!
//! Meshes that a scene cannot represent are errors, whose messages name a remedy. Counts and
//! offsets in files are checked before they are used, since files may be damaged or malicious.
//!
//! ```
//! use ugmeshfile::{MeshFormat, read};
//!
//! let file = b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
//! assert_eq!(MeshFormat::detect_mesh("tile.obj", file), Some(MeshFormat::Obj));
//! let no_files = |_: &str, _| Err(std::io::ErrorKind::NotFound.into());
//! let mesh = read(MeshFormat::Obj, file, &no_files, "").map_err(|problem| problem.what)?;
//! assert_eq!((mesh.scene.faces.len(), mesh.lines.faces[0]), (1, 5));
//! // The up axis is y in OBJ and z in scenes.
//! let corner = mesh.z_up(MeshFormat::Obj.up()).vertices[2].position;
//! assert_eq!(corner.to_array(), [1.0, 0.0, 1.0]);
//! # Ok::<(), String>(())
//! ```

mod axes;
mod builder;
mod decode;
mod error;
mod foreign;
mod format;
mod read;
mod textures;
mod vtk_polygons;

use std::io;

use ugscene::Scene;

pub use axes::{Axis, from_z_up, rotate, to_z_up};
pub use error::Problem;
pub use foreign::{Foreign, foreign_data};
pub use format::MeshFormat;
pub use read::{picture_within, read, read_within};
pub use textures::check_picture;
pub use vtk_polygons::VtkPolygons;

/// Reads a file that a mesh refers to, such as its materials: at most as many bytes as the second
/// argument says.
pub type ReadFile<'a> = &'a dyn Fn(&str, u64) -> io::Result<Vec<u8>>;

/// A mesh that was read.
#[derive(Clone, Debug)]
pub struct MeshScene {
    /// Its vertices, faces and colours, with the axes of the file.
    pub scene: Scene,
    /// The lines of the file that they come from.
    pub lines: Lines,
    /// Warnings about possible errors in it, and about parts that are left out.
    pub warnings: Vec<String>,
    /// What was chosen where it does not say what is meant.
    pub notes: Vec<String>,
}

/// Line numbers in a mesh file, from 1; 0 where there are no lines.
#[derive(Clone, Debug, Default)]
pub struct Lines {
    /// For each vertex of the scene, its line.
    pub vertices: Vec<u32>,
    /// For each face, its line.
    pub faces: Vec<u32>,
}

impl MeshScene {
    /// The scene with z as the up axis. `up`: the up axis of the file.
    pub fn z_up(mut self, up: Axis) -> Scene {
        rotate(&mut self.scene, |p| to_z_up(up, p));
        self.scene
    }
}
