//! UniGrafix scenes: text to [`Scene`] and back.
//!
//! UniGrafix is Berkeley's scene language of the 1980s: statements that begin with a keyword and
//! end with `;`, comments in braces, and definitions that instances and arrays place. This crate
//! reads it in three steps:
//!
//! ```text
//! bytes ─reader→ scopes ─resolve→ scopes ─expand→ Scene (flat) ─write→ bytes
//!        tables of the   names replaced  instances expanded
//!        file and of     by rows
//!        each definition
//! ```
//!
//! The result is complete: every name is resolved, every instance has its own vertices, every
//! number is finite. Errors are returned as [`Diagnostics`], up to 20 at once, each with its
//! location in the text.
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
//! This crate has no physics and no pixels: it stores the motions of bodies and the [`Stage`] of a
//! scene for other programs.
//!
//! The feature `report` adds [`Diagnostics`] as text with the lines they are about, remedies that
//! name programs and suggestions for misspelt names; `triangles` adds `read`, which cuts bent
//! faces; `cli` adds both, the program of the same name, and the module `pipe`, with which all
//! programs read scenes and the files these include. Libraries leave it out.

mod cameras;
mod chunked_writer;
#[cfg(feature = "cli")]
mod cli;
mod diagnostic;
mod diagnostics;
mod event_table;
mod expand;
mod face_warnings;
mod fast_path;
#[cfg(feature = "cli")]
mod foreign;
mod include;
#[cfg(feature = "cli")]
mod mesh;
mod number_text;
mod numbered;
mod options;
mod origin;
mod passed_on;
#[cfg(feature = "cli")]
pub mod pipe;
#[cfg(feature = "triangles")]
mod read;
mod reader;
#[cfg(feature = "report")]
mod report;
mod request;
mod resolve;
mod rgb_as_hsv;
mod row_writer;
mod rows;
mod scope;
mod sky_statement;
mod source;
mod stage_statement;
mod statement;
mod statements;
mod suggest;
mod tidy;
mod token;
mod transform;
mod wording;
mod writer;

#[cfg(feature = "cli")]
pub use cli::{Args, EXAMPLE_FILES, example_subject, main};
pub use diagnostic::{Diagnostic, MAX_ERRORS, Setting, Severity};
pub use diagnostics::{Diagnostics, Location};
pub use expand::Origins;
pub use face_warnings::{FLAT, rest_shapes_warning};
pub use include::include;
pub use options::{Limit, Limits, Options};
pub use origin::{Origin, has_history, with_origin};
pub use passed_on::{Comment, Item, PassedOn};
#[cfg(feature = "triangles")]
pub use read::{read, too_many_polygons};
pub use request::{Request, RequestError, RequestKind, name_pictures};
pub use sky_statement::stated_sky;
pub use source::{Source, Span};
pub use stage_statement::comes_through_a_pipe;
pub use statements::{STATEMENTS, Statement};
pub use tidy::tidy;
pub use writer::{write, write_to, write_with};

use ugscene::{BentFace, Scene, Stage};

/// A parsed scene.
#[derive(Clone, Debug)]
pub struct Parsed {
    /// The flat scene.
    pub scene: Scene,
    /// Comments and statements for other programs.
    pub passed_on: PassedOn,
    /// The locations of its rows in the text.
    pub origins: Origins,
    /// Faces to be drawn as triangles, because they are bent, in order.
    pub bent: Vec<BentFace>,
    /// Changes made to the scene, and possible mistakes in it.
    pub warnings: Diagnostics,
}

/// Parses a scene and flattens it. Of a mesh that went through [`include()`] it returns the scene.
///
/// # Errors
/// All errors in the text, up to [`MAX_ERRORS`].
pub fn parse(source: &Source, options: &Options) -> Result<Parsed, Diagnostics> {
    let (parsed, origin) =
        with_origin(source.origin.as_ref(), &source.text, || parse_text(source, options));
    let mut parsed = parsed?;
    parsed.scene.head.files = origin.into_iter().collect();
    Ok(parsed)
}

fn parse_text(source: &Source, options: &Options) -> Result<Parsed, Diagnostics> {
    if let Some(Some(parsed)) = source.mesh.as_deref() {
        return Ok(parsed.clone());
    }
    let text = &source.text[..];
    check_length(source, options)?;
    let mut findings = Vec::new();
    let mut document = reader::read(text, options, &mut findings);
    stage_statement::take(text, &mut document, &mut findings);
    let sky = sky_statement::take(&mut document, &mut findings);
    // A scene without the files of its pictures and its sky is complete.
    let is_text = |kind: RequestKind| !matches!(kind, RequestKind::Image | RequestKind::Sky);
    let texts = document.requests.iter().filter(|request| is_text(request.kind));
    findings.extend(texts.map(include::not_replaced));
    refuse_errors(source, &mut findings)?;

    let stage = document.stage.map_or_else(Stage::default, |(stage, _)| stage);
    // Colours that programs wrote were read with this warning before.
    if stage.is_at_rest() {
        findings.extend(rgb_as_hsv::warning(text, &document.scopes));
    }
    let mut scene = Scene { stage, sky, ..Scene::default() };
    let links =
        resolve::resolve(source, &mut document.scopes, &mut scene, &options.limits, &mut findings);
    refuse_errors(source, &mut findings)?;

    let (scene, passed_on, origins) =
        expand::expand(text, &mut document, &links, scene, &mut findings);
    refuse_errors(source, &mut findings)?;
    Ok(Parsed { passed_on, ..Parsed::new(source, scene, origins, findings) })
}

impl Parsed {
    /// A scene that was read from `source`.
    fn new(
        source: &Source,
        mut scene: Scene,
        origins: Origins,
        mut findings: Vec<Diagnostic>,
    ) -> Self {
        scene.faces.iter_mut().zip(0..).for_each(|(face, row)| face.row_as_read = row);
        let bent = ugscene::bent_faces(&scene);
        findings.extend(face_warnings::bent_warning(source, &origins, &bent));
        let warnings = Diagnostics::new(source, findings);
        Self { scene, passed_on: PassedOn::default(), origins, bent, warnings }
    }
}

/// Refuses texts whose positions do not fit 32 bits or that exceed the limit.
fn check_length(source: &Source, options: &Options) -> Result<(), Diagnostics> {
    if source.text.len() as u64 > options.limits.get(Limit::Text) {
        let finding = Diagnostic::error(Span::default(), "the scene is too large");
        return Err(Diagnostics::one(
            source,
            finding.limited(&options.limits, Limit::Text, "split it"),
        ));
    }
    Ok(())
}

/// Returns the findings as errors if there is an error among them.
fn refuse_errors(source: &Source, findings: &mut Vec<Diagnostic>) -> Result<(), Diagnostics> {
    if findings.iter().any(|finding| finding.severity == Severity::Error) {
        #[cfg(feature = "cli")]
        if let Some(finding) = foreign::error(source) {
            return Err(Diagnostics::one(source, finding));
        }
        return Err(Diagnostics::new(source, std::mem::take(findings)));
    }
    Ok(())
}
