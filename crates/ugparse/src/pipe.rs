//! How the programs read scenes: with the options all of them have, and with the files
//! and programs that a scene names.

use std::path::{Component, Path};

use ugpipe::{CommonArgs, Context, Failure};

use crate::origin::has_history;
use crate::stage_statement::comes_through_a_pipe;
use crate::{
    Diagnostics, Limit, Limits, Options, Origin, Request, RequestError, RequestKind, Source,
};

/// The parsing options among the common options of a program.
///
/// # Errors
/// [`Failure::Usage`] for an unknown limit or a value that is too large.
pub fn options(common: &CommonArgs) -> Result<Options, Failure> {
    let mut limits = Limits::default();
    for (name, value) in &common.limit {
        let Some(limit) = Limit::from_name(name) else {
            let names = Limit::all().map(Limit::name).collect::<Vec<_>>().join(", ");
            return Err(Failure::Usage(format!("`{name}` is not a limit; limits are {names}")));
        };
        if *value > limit.most() {
            return Err(Failure::Usage(format!("the limit {name} is {} at most", limit.most())));
        }
        limits = limits.with(limit, *value);
    }
    Ok(Options { lax: common.lax, execute: common.allow_execute, limits })
}

/// Reads the input scene of a program, with all included files.
///
/// # Errors
/// [`Failure::Read`] for the input itself, [`Failure::Report`] for included files.
pub fn read(context: &mut Context, options: &Options) -> Result<Source, Failure> {
    follow(input(context, options)?, options, context).map_err(refused)
}

/// The input of a program that may be in the middle of a pipe: a scene with a history on standard
/// input was recorded by the program upstream, even if nothing moves in it.
pub fn downstream(source: Source, context: &Context) -> Source {
    let is_recorded = context.recorded_name() == "-" && has_history(&source.text);
    let origin = source.origin.clone().filter(|_| !is_recorded);
    source.with_origin(origin)
}

/// Reads the input scene of a program, without included files.
///
/// # Errors
/// [`Failure::Read`].
pub fn input(context: &mut Context, options: &Options) -> Result<Source, Failure> {
    // The byte beyond the limit makes the parser refuse the text, with a remedy.
    let input = context.input_up_to(options.limits.get(Limit::Text) + 1)?;
    let origin = (!comes_through_a_pipe(&input.text)).then(|| origin(context));
    Ok(Source::new(input.name, input.text).with_origin(origin))
}

/// The origin of a scene that this program reads as it is at rest.
pub fn origin(context: &Context) -> Origin {
    Origin::Pending { name: context.recorded_name(), sha256: ugpipe::sha256 }
}

/// Replaces the `include` and `execute` statements and the tables of events of a scene, or reads a
/// mesh, see [`crate::include`]. Error output of successful programs is reported as a note.
///
/// # Errors
/// See [`crate::include`].
pub fn follow(source: Source, options: &Options, context: &Context) -> Result<Source, Diagnostics> {
    crate::include(source, options, |request| load(request, context))
}

/// The answer to a request of a scene: a file, or the output of a program.
///
/// # Errors
/// The file cannot be read; the program cannot be run, or fails.
pub fn load(request: &Request<'_>, context: &Context) -> Result<Vec<u8>, RequestError> {
    match request.kind {
        RequestKind::Include | RequestKind::Path | RequestKind::Image | RequestKind::Sky => {
            Ok(context.read_named(request.path, request.room + 1)?)
        }
        RequestKind::Execute => {
            let printed = context.run_named(request.path, request.room + 1)?;
            if let Some(status) = printed.failure {
                return Err(RequestError::Failed { status, complaint: printed.error_line });
            }
            if !printed.error_line.is_empty() {
                context.note(&format!("{} says: {}", request.path.display(), printed.error_line));
            }
            Ok(printed.text)
        }
    }
}

/// The failure of a run because of errors in the scene.
pub fn refused(findings: Diagnostics) -> Failure {
    Failure::Report(findings.report())
}

/// The note on files in other folders that the text of a scene names, which programs downstream
/// refuse to read: for them it comes from standard input, so it may name files of the current
/// folder and below.
pub fn outside_files(scene: &ugscene::Scene, context: &Context) -> Option<&'static str> {
    let is_outside = |file: &str| {
        let is_below = |part| matches!(part, Component::Normal(_) | Component::CurDir);
        !Path::new(file).components().all(is_below)
    };
    let textures = scene.textures.iter().filter_map(|texture| texture.image.file.as_deref());
    let mut files = textures.chain(scene.sky.as_ref().map(|sky| &*sky.file));
    let note = "the scene names pictures outside the current folder, which programs downstream refuse: run the \
                pipe in the folder of the scene, or give --allow-outside to each of them, if you trust the scene";
    (!context.allows_outside() && files.any(is_outside)).then_some(note)
}

/// The note on textures that the text of a scene leaves out, because they are within a mesh from
/// standard input, which no file name refers to.
pub const PICTURES_LEFT_OUT: &str =
    "textures within a mesh on standard input are left out; name its file on the command line";

/// [`PICTURES_LEFT_OUT`], if that is so of a scene.
pub fn unnamed_textures(scene: &ugscene::Scene) -> Option<&'static str> {
    let is_unnamed = |texture: &ugscene::Texture| texture.image.file.is_none();
    scene.textures.iter().any(is_unnamed).then_some(PICTURES_LEFT_OUT)
}
