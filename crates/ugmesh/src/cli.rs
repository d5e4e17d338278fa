//! The command line of `ugmesh`.

use std::fs;
use std::io;
use std::path::Path;
use std::process::ExitCode;

use clap::Parser;
use ugparse::pipe;
use ugpipe::{CommonArgs, Context, Failure, ToolArgs, Words, one_of};
use ugscene::Provenance;

use crate::{Axis, Config, Error, MeshFile, MeshFormat, PROVENANCE, PictureFiles, Size, Target};

/// Converts meshes of other programs to UniGrafix and back
///
/// Reads OBJ, PLY, STL, OFF, glTF and UniGrafix. Writes UniGrafix, OBJ, PLY, glTF or VTK, according
/// to -dt or the extension of -fo. Keeps polygons, normals and the colours of faces and vertices.
#[derive(Parser, Debug)]
#[command(name = "ugmesh", version, after_help = EXAMPLES)]
pub struct Args {
    /// Input format [default: by content and file extension]
    #[arg(id = "if", long = "if", visible_alias = "input-format", value_name = "FMT",
          value_parser = one_of("formats", INPUTS))]
    format: Option<MeshFormat>,

    /// Output format [default: by the extension of -fo, else ug]
    #[arg(long, visible_alias = "device-type", value_name = "FMT",
          value_parser = one_of("formats", Target::NAMES))]
    dt: Option<Target>,

    /// Write PLY as ASCII text
    #[arg(long)]
    ascii: bool,

    /// Up axis of the mesh [default: y for OBJ and glTF, z for PLY, STL and OFF]
    #[arg(long, value_name = "AXIS",
          value_parser = one_of("axes", [("x", Axis::X), ("y", Axis::Y), ("z", Axis::Z)]))]
    up: Option<Axis>,

    /// Scale the mesh by the factor S
    #[arg(long, value_name = "S", allow_hyphen_values = true, value_parser = ugpipe::finite, conflicts_with = "fit")]
    scale: Option<f64>,

    /// Scale the mesh so that the longest side of its bounding box is L
    #[arg(long, value_name = "L", allow_hyphen_values = true, value_parser = ugpipe::finite)]
    fit: Option<f64>,

    /// Move the centre of the mesh's bounding box to the origin
    #[arg(long)]
    center: bool,

    /// Also write a camera and lights into the scene, to be edited
    ///
    /// They are those with which a scene without them is drawn.
    #[arg(long)]
    stage: bool,

    /// Write normals of moving bodies as in the scene, which are those of the shapes at rest
    ///
    /// By default they are those of the shapes as seen.
    #[arg(long)]
    rest_normals: bool,

    /// Prefix names of vertices and colours with NAME_, to combine several meshes in one scene
    #[arg(long, value_name = "NAME", value_parser = name)]
    name: Option<String>,

    #[command(flatten)]
    common: CommonArgs,
}

const EXAMPLES: &str = "Examples:
  ugmesh --center -fit 2 teapot.obj | uglorentz -vel .9 0 0 --keep-in-view | ugrainbow > fast.png
  uglorentz -vel .9 0 0 teapot.obj | ugmesh -dt ply > distorted.ply
  ugmesh --center -fit 2 globe.ply > globe.ug
  uglorentz -vel 0 .8 0 ship.ug | ugdoppler | ugmesh -fo ship.glb";

const INPUTS: [(&str, MeshFormat); 7] = [
    ("ug", MeshFormat::Ug),
    ("obj", MeshFormat::Obj),
    ("ply", MeshFormat::Ply),
    ("stl", MeshFormat::Stl),
    ("off", MeshFormat::Off),
    ("gltf", MeshFormat::Gltf),
    ("glb", MeshFormat::Gltf),
];

/// Value parser for names that are valid in UniGrafix and in other programs.
fn name(word: &str) -> Result<String, String> {
    let is_valid = word.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
        && word.starts_with(|c: char| c.is_ascii_alphabetic());
    if is_valid {
        Ok(word.to_string())
    } else {
        Err("a name consists of letters, digits and _, and begins with a letter".to_string())
    }
}

impl ToolArgs for Args {
    const ESSENTIAL: &'static [&'static str] =
        &["-dt", "-if", "-up", "-fit", "--center", "--scale", "--stage", "-name", "-fo"];

    fn common(&self) -> &CommonArgs {
        &self.common
    }
}

impl Args {
    fn config(&self) -> Result<Config, Failure> {
        if [self.scale, self.fit].into_iter().flatten().any(|size| size <= 0.0) {
            return Err(Failure::usage("sizes (-scale, -fit) must be above 0"));
        }
        let size = match (self.scale, self.fit) {
            (Some(scale), _) => Size::Times(scale),
            (None, Some(length)) => Size::Fit(length),
            (None, None) => Size::Same,
        };
        let target = self.target()?;
        if self.ascii && !matches!(target, Target::Ply { .. }) {
            return Err(Failure::usage("-ascii applies only to PLY; add -dt ply"));
        }
        if self.stage && target != Target::Ug {
            return Err(Failure::usage(
                "-stage writes statements of UniGrafix; leave out -dt and the ending of -fo",
            ));
        }
        Ok(Config {
            format: self.format,
            target,
            up: self.up,
            size,
            is_centered: self.center,
            stage: self.stage,
            rest_normals: self.rest_normals,
            name: self.name.clone().unwrap_or_default(),
            pictures: self.picture_files(),
            reading: pipe::options(&self.common)?,
        })
    }

    /// The command line to be recorded. A format that follows from the ending of -fo is part of it,
    /// so that the pipe can be run again with another output.
    fn with_format(&self, command_line: &str, target: Target) -> String {
        match self.dt {
            None if target != Target::Ug => format!("{command_line} -dt {}", target.name()),
            _ => command_line.to_owned(),
        }
    }

    /// Where a scene that is written to a file finds its pictures.
    fn picture_files(&self) -> Option<PictureFiles> {
        let output = self.common.output().filter(|path| is_file_or_new(path))?;
        let folder = |path: &Path| fs::canonicalize(Path::new(".").join(path.parent()?)).ok();
        Some(PictureFiles {
            stem: output.file_stem()?.to_str()?.replace('"', "_"),
            is_beside_mesh: self.common.input().is_some_and(|mesh| folder(mesh) == folder(output)),
        })
    }

    /// The output format. An unknown extension is an error, so that no file has an extension that
    /// contradicts its content.
    fn target(&self) -> Result<Target, Failure> {
        let target = match (self.dt, self.common.output()) {
            (Some(target), _) => target,
            (None, Some(path)) if path.extension().is_some() && is_file_or_new(path) => {
                Target::by_ending(path).ok_or_else(|| {
                    Failure::usage(format!(
                        "the extension of `{}` is none of the formats ug, obj, ply, gltf, glb and vtp; name one with -dt",
                        path.display()
                    ))
                })?
            }
            (None, _) => Target::Ug,
        };
        Ok(match target {
            Target::Ply { .. } => Target::Ply { is_ascii: self.ascii },
            other => other,
        })
    }
}

/// False for devices, whose names do not determine a format.
fn is_file_or_new(path: &Path) -> bool {
    fs::metadata(path).map_or(true, |metadata| metadata.is_file())
}

/// Reads a file in the folder of the mesh. A mesh from a pipe has no folder.
fn read_beside(
    context: &Context,
    mesh: Option<&Path>,
    name: &str,
    limit: u64,
) -> io::Result<Vec<u8>> {
    match mesh.map(|mesh| mesh.parent().unwrap_or(Path::new(""))) {
        Some(folder) => context.read_named(&folder.join(name), limit),
        None => {
            Err(io::Error::other("standard input has no folder; name the mesh on the command line"))
        }
    }
}

impl Words for Error {
    fn words(&self) -> String {
        if let Self::Stage(error) = self {
            return error.words();
        }
        let remedy = match self {
            Self::UnknownFormat { foreign: None, .. } => {
                "; give it with -if ug, obj, ply, stl, off or gltf"
            }
            Self::NothingToConvert => {
                "; choose an output format with -dt obj, ply, gltf, glb or vtp"
            }
            Self::NotMesh => ", so -name has no effect; leave it out",
            Self::Overflow => "; choose another -scale or -fit",
            Self::OutOfRange => "; make the mesh smaller (-fit 1) or write PLY (-dt ply)",
            Self::TooLarge => "; write PLY (-dt ply)",
            Self::UnknownFormat { foreign: Some(_), .. }
            | Self::Malformed { .. }
            | Self::Scene(_)
            | Self::Stage(_) => "",
        };
        format!("{self}{remedy}")
    }
}

/// The program.
pub fn main() -> ExitCode {
    ugpipe::main(|args: &Args, context: &mut Context| {
        let config = args.config()?;
        if context.output_is_terminal() && config.target.is_binary() {
            return Err(Failure::usage(
                "binary data is not written to a terminal; send it to a file with `> FILE` or -fo FILE",
            ));
        }
        let read = context.input()?;
        let read_file = |name: &str, limit| read_beside(context, args.common.input(), name, limit);
        let resolve_includes = |source| pipe::follow(source, &config.reading, context);
        let command_line = args.with_format(context.command_line(), config.target);
        let provenance = Provenance { command: Some(&command_line), ..PROVENANCE };
        let input =
            MeshFile::new(read.name, read.text).with_history(pipe::origin(context), provenance);
        let files_read = || context.take_files_read();
        let input = input.with_files(&read_file).with_includes(&resolve_includes);
        let input = MeshFile { files_read: &files_read, ..input };
        let converted = crate::run(&config, &input).map_err(|error| match error {
            Error::Scene(findings) => pipe::refused(findings),
            Error::NothingToConvert | Error::NotMesh => Failure::usage(error.words()),
            other => Failure::failed(other.words()),
        })?;
        if let Some(findings) = converted.diagnostics.filter(|findings| !findings.is_empty()) {
            context.report(&findings.report());
        }
        converted.warnings.iter().for_each(|warning| context.warn(warning));
        let missing = converted.lacks_pictures.then_some(pipe::PICTURES_LEFT_OUT);
        converted
            .notes
            .iter()
            .map(String::as_str)
            .chain(missing)
            .for_each(|note| context.note(note));
        let folder = args.common.output().and_then(Path::parent).unwrap_or(Path::new(""));
        for (name, bytes) in &converted.pictures {
            context.write_file(&folder.join(name), bytes)?;
        }
        context.detail(&format!("{} bytes", converted.bytes.len()));
        context.write(&converted.bytes)
    })
}
