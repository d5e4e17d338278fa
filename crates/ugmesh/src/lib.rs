//! Meshes of other programs to UniGrafix and back.
//!
//! ```text
//! ugmesh teapot.obj | uglorentz -vel .9 0 0 | ugmesh -dt ply > distorted.ply
//! ```
//!
//! Reads OBJ with its materials, PLY, STL, OFF and glTF, and UniGrafix itself; writes UniGrafix, OBJ, PLY and glTF.
//! Everything passes through one [`ugparse::Scene`]:
//!
//! ```text
//! bytes ─read→ Builder → Scene (z up) ─place→ Scene ─write→ Surface → bytes
//!       ugparse ──────────↗                     └──────ugparse──────→ bytes
//! ```
//!
//! What a mesh cannot say is left out with a note; what a scene cannot hold is an error that names the remedy.
//! Numbers of damaged or hostile files are checked before anything is counted on them.
//!
//! ```
//! let input = ugmesh::Input::new("tile.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
//! let config = ugmesh::Config { command_line: "ugmesh".to_string(), ..Default::default() };
//! let scene = String::from_utf8(ugmesh::run(&config, &input)?.bytes)?;
//! // OBJ has y up, UniGrafix z.
//! assert!(scene.ends_with("v v3 1 0 1;\nv v4 0 0 1;\nf (v1 v2 v3 v4);\n"), "{scene}");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod builder;
#[cfg(feature = "cli")]
mod cli;
mod error;
mod format;
mod place;
mod read;
mod surface;
mod write;

use std::io;

use ugparse::{Diagnostics, Options, Scene, Source};

#[cfg(feature = "cli")]
pub use cli::{Args, main};
pub use error::{Error, Problem};
pub use format::{Axis, Format, Target};
pub use place::Size;

use builder::Builder;

const PROGRAM: &str = env!("CARGO_PKG_NAME");

/// What to do.
#[derive(Clone, Debug, Default)]
pub struct Config {
    /// What the input is; else its content or the ending of its name says.
    pub format: Option<Format>,
    /// What to write.
    pub target: Target,
    /// The axis that is up in every mesh read or written; else its format says. In UniGrafix it is z always.
    pub up: Option<Axis>,
    /// How large the mesh comes out.
    pub size: Size,
    /// Move the middle of the mesh's box to the origin.
    pub is_centered: bool,
    /// Before the names of vertices and colours made here.
    pub name: String,
    /// How UniGrafix is read.
    pub reading: Options,
    /// How the program was called, for the scene's history.
    pub command_line: String,
}

/// Reads a file that a mesh names, such as its materials.
type Beside<'a> = &'a dyn Fn(&str) -> io::Result<Vec<u8>>;

/// Puts the files that a scene includes into it.
type Follow<'a> = &'a dyn Fn(Source) -> Result<Source, Diagnostics>;

/// A mesh as it comes.
pub struct Input<'a> {
    /// File name, or `<stdin>`.
    pub name: String,
    /// All of it.
    pub bytes: Vec<u8>,
    /// Reads a file by the name the mesh gives it.
    pub beside: Beside<'a>,
    /// Follows the `include` statements of UniGrafix.
    pub follow: Follow<'a>,
}

impl<'a> Input<'a> {
    /// A mesh with no files beside it.
    pub fn new(name: impl Into<String>, bytes: impl Into<Vec<u8>>) -> Self {
        let (name, bytes) = (name.into(), bytes.into());
        Self { name, bytes, beside: &|_| Err(io::ErrorKind::NotFound.into()), follow: &Ok }
    }

    /// The same with files beside it, which `beside` reads.
    pub fn with_files(self, beside: Beside<'a>) -> Self {
        Self { beside, ..self }
    }

    /// The same, whose `include` statements `follow` follows.
    pub fn with_includes(self, follow: Follow<'a>) -> Self {
        Self { follow, ..self }
    }
}

/// What came out.
#[derive(Clone, Debug)]
pub struct Converted {
    /// The mesh or scene.
    pub bytes: Vec<u8>,
    /// What the user should know.
    pub notes: Vec<String>,
    /// What may be wrong with a mesh.
    pub warnings: Vec<String>,
    /// What was wrong with a scene, and mended.
    pub diagnostics: Option<Diagnostics>,
}

/// Reads a mesh or scene, places it and writes it.
///
/// # Errors
/// What is wrong with the input, or with what was asked for: [`Error`].
pub fn run(config: &Config, input: &Input) -> Result<Converted, Error> {
    let format = config
        .format
        .or_else(|| Format::detect(&input.name, &input.bytes))
        .ok_or_else(|| Error::UnknownFormat { name: input.name.clone() })?;
    if format == Format::Ug && config.target == Target::Ug {
        return Err(Error::NothingToConvert);
    }
    let Loaded { mut scene, warnings, diagnostics } = load(config, format, input)?;
    place(config, format, &mut scene)?;
    ugscene::record(&mut scene, PROGRAM, env!("CARGO_PKG_VERSION"), &config.command_line);
    let (bytes, notes) = write::write(scene, config.target)?;
    Ok(Converted { bytes, notes, warnings, diagnostics })
}

struct Loaded {
    scene: Scene,
    warnings: Vec<String>,
    diagnostics: Option<Diagnostics>,
}

fn load(config: &Config, format: Format, input: &Input) -> Result<Loaded, Error> {
    let Some(reader) = read::reader(format) else { return load_scene(config, input) };
    let mut builder = Builder::new(&config.name);
    reader(input, &mut builder).map_err(|problem| Error::Malformed {
        name: input.name.clone(),
        format,
        problem,
    })?;
    let (scene, warnings) = builder.finish();
    Ok(Loaded { scene, warnings, diagnostics: None })
}

fn load_scene(config: &Config, input: &Input) -> Result<Loaded, Error> {
    let source = (input.follow)(Source::new(input.name.clone(), input.bytes.clone()))?;
    let parsed = ugscene::read(&source, &config.reading, None)?;
    Ok(Loaded { scene: parsed.scene, warnings: Vec::new(), diagnostics: Some(parsed.warnings) })
}

fn place(config: &Config, format: Format, scene: &mut Scene) -> Result<(), Error> {
    let up = |is_mesh: bool, habit: Axis| config.up.filter(|_| is_mesh).unwrap_or(habit);
    let read_up = up(format != Format::Ug, format.up());
    let write_up = up(config.target != Target::Ug, config.target.up());
    if read_up != write_up || config.size != Size::Same || config.is_centered {
        place::turn(scene, |p| place::to_z_up(read_up, p));
        place::resize(scene, config.size, config.is_centered)?;
        place::turn(scene, |p| place::from_z_up(write_up, p));
    }
    Ok(())
}
