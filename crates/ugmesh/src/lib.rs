//! Converts meshes of other programs to UniGrafix and back.
//!
//! ```text
//! uglorentz -vel .9 0 0 teapot.obj | ugmesh -dt ply > distorted.ply
//! ```
//!
//! Reads OBJ with its materials, PLY, STL, OFF, glTF and UniGrafix; writes UniGrafix, OBJ, PLY and
//! glTF. Every conversion goes through a [`ugscene::Scene`]:
//!
//! ```text
//! bytes ─ugmeshfile→ Scene (z up) ─place→ Scene ─write→ PolygonMesh → bytes
//!       ugparse ──────────↗                     └──────ugparse──────→ bytes
//! ```
//!
//! Parts of a scene that a mesh format cannot represent are left out with a note. Meshes that a
//! scene cannot represent are errors, whose messages name a remedy. Counts and offsets in files are
//! checked before they are used, since files may be damaged or malicious.
//!
//! ```
//! let input = ugmesh::MeshFile::new("tile.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
//! let scene = String::from_utf8(ugmesh::run(&ugmesh::Config::default(), &input)?.bytes)?;
//! // The up axis is y in OBJ and z in UniGrafix.
//! assert!(scene.ends_with("v v3 1 0 1;\nv v4 0 0 1;\nf (v1 v2 v3 v4);\n"), "{scene}");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod as_seen;
#[cfg(feature = "cli")]
mod cli;
mod error;
mod format;
mod placement;
mod polygon_mesh;
mod staging;
mod write;

use std::io;
use std::sync::Arc;

use ugparse::{Diagnostics, Options, Origin, Source};
use ugscene::{Provenance, Scene};

#[cfg(feature = "cli")]
pub use cli::{Args, main};
pub use error::Error;
pub use format::Target;
pub use placement::Size;
pub use ugmeshfile::{Axis, MeshFormat, Problem};

use ugmeshfile::{MeshScene, ReadFile};

/// This program, without a command line, for the history of what it makes.
pub const PROVENANCE: Provenance<'static> = Provenance {
    program: env!("CARGO_PKG_NAME"),
    version: env!("CARGO_PKG_VERSION"),
    command: None,
    files: &[],
};

/// The options of a conversion.
///
/// A later version may have more fields, so complete it with `..Config::default()`.
#[derive(Clone, Debug, Default)]
pub struct Config {
    /// The input format; by default it is detected from the content and the file extension.
    pub format: Option<MeshFormat>,
    /// The output format.
    pub target: Target,
    /// The up axis of meshes that are read or written; by default that of the format. In UniGrafix
    /// it is always z.
    pub up: Option<Axis>,
    /// How the mesh is scaled.
    pub size: Size,
    /// Whether the centre of the mesh's bounding box is moved to the origin.
    pub is_centered: bool,
    /// Whether a camera and lights are added to a scene that is written without them.
    pub stage: bool,
    /// Whether normals of moving bodies are written as in the scene: those of the shapes at rest.
    pub rest_normals: bool,
    /// Prefix of the names of vertices and colours that are generated.
    pub name: String,
    /// Where a scene finds the pictures of textures; by default where the mesh has them.
    pub pictures: Option<PictureFiles>,
    /// The options for reading UniGrafix.
    pub reading: Options,
}

/// Where a scene that is written finds the pictures of textures.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct PictureFiles {
    /// The beginning of the names of files beside the scene, for pictures that are within the mesh.
    pub stem: String,
    /// The scene is in the folder of the mesh: files that the mesh names are found as they are. If
    /// not, they are written beside the scene as well.
    pub is_beside_mesh: bool,
}

/// Replaces the `include` statements of a scene by the files that they name.
type ResolveIncludes<'a> = &'a dyn Fn(Source) -> Result<Source, Diagnostics>;

/// A mesh file.
pub struct MeshFile<'a> {
    /// File name, or `<stdin>`.
    pub name: String,
    /// The content of the file.
    pub bytes: Vec<u8>,
    /// Reads a file by the name that the mesh refers to, up to a number of bytes.
    pub read_file: ReadFile<'a>,
    /// Resolves the `include` statements of UniGrafix.
    pub resolve_includes: ResolveIncludes<'a>,
    /// The record of its bytes in the history of the scene.
    pub origin: Option<Origin>,
    /// The record of the files that were read with it, once they are.
    pub files_read: &'a dyn Fn() -> Vec<String>,
    /// For the history of the scene.
    pub provenance: Provenance<'a>,
}

impl<'a> MeshFile<'a> {
    /// A mesh that refers to no other files.
    pub fn new(name: impl Into<String>, bytes: impl Into<Vec<u8>>) -> Self {
        let (name, bytes) = (name.into(), bytes.into());
        Self {
            name,
            bytes,
            read_file: &|_, _| Err(io::ErrorKind::NotFound.into()),
            resolve_includes: &Ok,
            origin: None,
            files_read: &Vec::new,
            provenance: PROVENANCE,
        }
    }

    /// The same mesh with a history, which begins with its origin.
    pub fn with_history(self, origin: Origin, provenance: Provenance<'a>) -> Self {
        Self { origin: Some(origin), provenance, ..self }
    }

    /// The same mesh with other files that it refers to, which `read_file` reads.
    pub fn with_files(self, read_file: ReadFile<'a>) -> Self {
        Self { read_file, ..self }
    }

    /// The same mesh with `include` statements, which `resolve_includes` resolves.
    pub fn with_includes(self, resolve_includes: ResolveIncludes<'a>) -> Self {
        Self { resolve_includes, ..self }
    }
}

/// The result of a conversion.
#[derive(Clone, Debug)]
pub struct Converted {
    /// The converted mesh or scene.
    pub bytes: Vec<u8>,
    /// Pictures of textures to be written beside the scene: names and bytes.
    pub pictures: Vec<(String, Arc<[u8]>)>,
    /// Notes for the user, such as parts that are left out.
    pub notes: Vec<String>,
    /// Warnings about possible errors in a mesh.
    pub warnings: Vec<String>,
    /// Warnings about a scene.
    pub diagnostics: Option<Diagnostics>,
    /// A scene has no textures that are within a mesh from standard input, which no file names.
    pub lacks_pictures: bool,
}

/// Reads a mesh or scene, scales and moves it, and writes it.
///
/// # Errors
/// [`Error`] if the input is invalid, or if it cannot be converted with these options.
pub fn run(config: &Config, input: &MeshFile) -> Result<Converted, Error> {
    let format = config
        .format
        .or_else(|| MeshFormat::detect(&input.name, &input.bytes))
        .ok_or_else(|| Error::UnknownFormat {
            name: input.name.clone(),
            foreign: ugmeshfile::foreign_data(&input.name, &input.bytes),
        })?;
    if format == MeshFormat::Ug && config.target == Target::Ug {
        return Err(Error::NothingToConvert);
    }
    if format == MeshFormat::Ug && !config.name.is_empty() {
        return Err(Error::NotMesh);
    }
    let Loaded { mut scene, warnings, mut notes, diagnostics } = load(config, format, input)?;
    if config.target != Target::Ug {
        ugscene::refuse_deferred_colors(&scene)?;
        ugscene::refuse_whole_faces(&scene)?;
    }
    // Meshes show no times.
    uglight::freeze_colors_at_zero(&mut scene);
    if config.target != Target::Ug && !config.rest_normals {
        as_seen::see_normals(&mut scene);
    }
    if config.target.has_camera() {
        as_seen::complete_camera(&mut scene);
    }
    let is_placed = place_mesh(config, format, &mut scene)?;
    if config.stage && config.target == Target::Ug {
        staging::add(&mut scene);
    }
    if input.name.starts_with('<') && !scene.head.history().is_empty() {
        // The program upstream recorded what it read.
        scene.head.files.clear();
    }
    scene.head.record(Provenance { files: &(input.files_read)(), ..input.provenance });
    let mut pictures = Vec::new();
    let mut lacks_pictures = false;
    if config.target == Target::Ug {
        pictures = pictures_of(&mut scene, config.pictures.as_ref(), &input.name);
        lacks_pictures = scene.textures.iter().any(|texture| texture.image.file.is_none());
    }
    let (bytes, more) = write::write(scene, config.target, is_placed)?;
    notes.extend(more);
    Ok(Converted { bytes, pictures, notes, warnings, diagnostics, lacks_pictures })
}

struct Loaded {
    scene: Scene,
    warnings: Vec<String>,
    notes: Vec<String>,
    diagnostics: Option<Diagnostics>,
}

fn load(config: &Config, format: MeshFormat, input: &MeshFile) -> Result<Loaded, Error> {
    if format == MeshFormat::Ug {
        return load_scene(config, input);
    }
    let memory = config.reading.limits.get(ugparse::Limit::Memory);
    let read =
        || ugmeshfile::read_within(format, &input.bytes, input.read_file, &config.name, memory);
    let (read, origin) = ugparse::with_origin(input.origin.as_ref(), &input.bytes, read);
    let MeshScene { mut scene, warnings, notes, .. } =
        read.map_err(|problem| Error::Malformed { name: input.name.clone(), format, problem })?;
    scene.head.files = origin.into_iter().collect();
    Ok(Loaded { scene, warnings, notes, diagnostics: None })
}

fn load_scene(config: &Config, input: &MeshFile) -> Result<Loaded, Error> {
    let origin = input.origin.clone().filter(|_| !ugparse::comes_through_a_pipe(&input.bytes));
    let source = Source::new(input.name.clone(), input.bytes.clone()).with_origin(origin);
    let source = (input.resolve_includes)(source)?;
    let mut parsed = ugparse::parse(&source, &config.reading)?;
    if config.target != Target::Ug {
        parsed.cut_rounds(&source, None)?;
    }
    let (scene, diagnostics) = (parsed.scene, Some(parsed.warnings));
    Ok(Loaded { scene, warnings: Vec::new(), notes: Vec::new(), diagnostics })
}

/// Names and bytes of files.
type Files = Vec<(String, Arc<[u8]>)>;

/// Names the pictures of a scene by files beside it; returns those to be written. Without such
/// files they are where the mesh has them, from the current folder.
fn pictures_of(scene: &mut Scene, files: Option<&PictureFiles>, mesh: &str) -> Files {
    let mut pictures: Files = Vec::new();
    let Some(PictureFiles { stem, is_beside_mesh }) = files else {
        ugparse::name_pictures(scene, mesh);
        return pictures;
    };
    for image in scene.textures.iter_mut().map(|texture| &mut texture.image) {
        let is_file = image.row.is_none()
            && image.file.as_ref().is_some_and(|file| !file.contains(['"', '\n']));
        if *is_beside_mesh && is_file {
            continue;
        }
        let row =
            pictures.iter().position(|(_, bytes)| *bytes == image.bytes).unwrap_or_else(|| {
                let ending = match image.bytes[..] {
                    [0x89, ..] => "png",
                    [0xff, ..] => "jpg",
                    [b'#', ..] => "hdr",
                    [0x76, ..] => "exr",
                    _ => "pfm",
                };
                pictures.push((
                    format!("{stem}_texture{}.{ending}", pictures.len() + 1),
                    Arc::clone(&image.bytes),
                ));
                pictures.len() - 1
            });
        (image.file, image.row) = (Some(pictures[row].0.clone()), None);
    }
    pictures
}

/// Turns, scales and moves the mesh. Returns false if it did nothing.
fn place_mesh(config: &Config, format: MeshFormat, scene: &mut Scene) -> Result<bool, Error> {
    let up = |is_mesh: bool, habit: Axis| config.up.filter(|_| is_mesh).unwrap_or(habit);
    let read_up = up(format != MeshFormat::Ug, format.up());
    let write_up = up(config.target != Target::Ug, config.target.up());
    let is_placed = read_up != write_up || config.size != Size::Same || config.is_centered;
    if is_placed {
        ugmeshfile::rotate(scene, |p| ugmeshfile::to_z_up(read_up, p));
        placement::scale_and_center(
            scene,
            config.size,
            config.is_centered,
            config.target == Target::Ug,
        )?;
        ugmeshfile::rotate(scene, |p| ugmeshfile::from_z_up(write_up, p));
    }
    Ok(is_placed)
}
