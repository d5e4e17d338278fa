//! UniGrafix scenes: text to [`Scene`] and back.
//!
//! UniGrafix is Berkeley's scene language of the 1980s: statements that begin
//! with a keyword and end with `;`, comments in braces, definitions that are
//! placed by instances and arrays. This crate reads it in three steps:
//!
//! ```text
//! bytes ─reader→ scopes ─resolve→ scopes ─expand→ Scene (flat) ─write→ bytes
//!        tables for the  names are rows  instances expanded
//!        file, each def
//! ```
//!
//! What comes out is complete: every name is resolved, every instance has its
//! own vertices, every number is finite. Whatever is wrong is returned as
//! [`Diagnostics`], up to 20 at once, each with its place in the text.
//!
//! ```
//! let source = ugparse::Source::new(
//!     "tile.ug",
//!     "{ four tiles }
//!      def tile; v a 0 0 0; v b 1 0 0; v c 1 1 0; v d 0 1 0; f (a b c d); end;
//!      a floor (tile) 4 -tx 1.1;",
//! );
//! let scene = ugparse::parse(&source, &ugparse::Options::default())?.scene;
//! assert_eq!(scene.faces.len(), 4);
//! assert_eq!(scene.names.get(scene.vertices[4].name), "floor#1:a");
//! # Ok::<(), ugparse::Diagnostics>(())
//! ```
//!
//! Nothing here computes with physics or pixels: motions of bodies, and the [`Stage`] of a scene, are
//! carried for other programs.
//!
//! The feature `cli` adds the program of the same name, and how all programs read scenes,
//! included files among them (`pipe`). Libraries do without.

mod body;
mod cameras;
mod chunked_writer;
#[cfg(feature = "cli")]
mod cli;
mod contours;
mod diagnostic;
mod expand;
mod fast_path;
mod flatness;
mod grammar;
mod history;
mod include;
mod named;
mod names;
mod numbered;
mod options;
mod parallel_reader;
#[cfg(feature = "cli")]
pub mod pipe;
mod reader;
mod resolve;
mod scene;
mod scope;
mod source;
mod stage;
mod stage_statement;
mod statement;
mod suggest;
mod tidy;
mod token;
mod transform;
mod wording;
mod writer;

pub use body::{Bodies, Body, BodyId, Motion};
#[cfg(feature = "cli")]
pub use cli::main;
pub use contours::Contours;
pub use diagnostic::{Diagnostic, Diagnostics, Location, MAX_ERRORS, Severity};
pub use expand::Origins;
pub use flatness::{BentFace, FLAT, TOO_BENT, thickness};
pub use history::{history, record};
pub use include::{Request, RequestError, RequestKind, include};
pub use names::{NameId, Names, UniqueNames};
pub use options::{Limit, Limits, Options};
pub use scene::*;
pub use source::{Source, Span};
pub use stage::{ColorScale, ColorStage, GeometryStage, HueScale, SeenColors, SeenGeometry, Stage};
pub use tidy::tidy;
pub use writer::{write, write_to};

/// A scene that was read.
#[derive(Clone, Debug)]
pub struct Parsed {
    /// The flat scene.
    pub scene: Scene,
    /// Where its rows come from.
    pub origins: Origins,
    /// Faces that are not flat, in order.
    pub bent: Vec<BentFace>,
    /// What was changed to make it usable, or may look wrong.
    pub warnings: Diagnostics,
}

/// Reads a scene and flattens it.
///
/// # Errors
/// All that is wrong with the text, up to [`MAX_ERRORS`] findings.
pub fn parse(source: &Source, options: &Options) -> Result<Parsed, Diagnostics> {
    let text = &source.text[..];
    check_length(source, options)?;
    let mut findings = Vec::new();
    let mut document = parallel_reader::read_document(text, options, &mut findings);
    stage_statement::take(text, &mut document, &mut findings);
    findings.extend(document.requests.iter().map(include::not_followed));
    refuse_errors(source, &mut findings)?;

    let stage = document.stage.map_or_else(Stage::default, |(stage, _)| stage);
    let mut scene = Scene { stage, ..Scene::default() };
    let links = resolve::resolve(text, &mut document.scopes, &mut scene, &options.limits, &mut findings);
    refuse_errors(source, &mut findings)?;

    let (scene, origins) = expand::expand(text, &mut document, &links, scene, &mut findings);
    refuse_errors(source, &mut findings)?;
    let bent = flatness::bent_faces(&scene);
    findings.extend(flatness::warning(source, &origins, &bent));
    Ok(Parsed { scene, origins, bent, warnings: Diagnostics::new(source, findings) })
}

/// Stops if positions in the text do not fit.
fn check_length(source: &Source, options: &Options) -> Result<(), Diagnostics> {
    if source.text.len() as u64 > options.limits.get(Limit::Text) {
        let finding = Diagnostic::error(Span::default(), "the scene is too large")
            .help(options.limits.remedy(Limit::Text, "split it"));
        return Err(Diagnostics::one(source, finding));
    }
    Ok(())
}

/// Stops if there is an error among the findings.
fn refuse_errors(source: &Source, findings: &mut Vec<Diagnostic>) -> Result<(), Diagnostics> {
    if findings.iter().any(|finding| finding.severity == Severity::Error) {
        return Err(Diagnostics::new(source, std::mem::take(findings)));
    }
    Ok(())
}
