//! Inputs that are not scenes at all: one error says so, in place of one for each of their words.

use ugmeshfile::{Foreign, MeshFormat, foreign_data};
use ugpipe::remedies;

use crate::diagnostic::Diagnostic;
use crate::source::{Source, Span};

/// The error for a text that is not UniGrafix, by its first bytes or the extension of its name.
/// Call it only for texts with errors: a scene may have any name.
pub(crate) fn error(source: &Source) -> Option<Diagnostic> {
    let file = Some(&*source.name).filter(|name| !name.starts_with('<'));
    let (what, help) = match foreign_data(&source.name, &source.text) {
        Some(foreign) => (
            foreign.to_string(),
            match foreign {
                Foreign::Picture => remedies::picture_is_complete(file),
                Foreign::Table => remedies::draw_stars(file),
                other => other.remedy().to_owned(),
            },
        ),
        None => {
            MeshFormat::detect_mesh(&source.name, &source.text)?;
            ("a mesh".to_owned(), remedies::convert_mesh(file))
        }
    };
    Some(
        Diagnostic::error(Span::default(), format!("this is not a UniGrafix scene but {what}"))
            .help(help),
    )
}
