//! The statement `sky`, which holds for the whole scene.

use ugscene::StatedSky;

use crate::Options;
use crate::diagnostic::Diagnostic;
use crate::reader::{Document, read};
use crate::request::RequestKind;
use crate::source::{Source, Span};

/// The sky of a document. One in a definition, and a second one, are errors.
pub(crate) fn take(
    document: &mut Document<'_>,
    findings: &mut Vec<Diagnostic>,
) -> Option<StatedSky> {
    let keyword = |span: &Span| Span { end: span.start + 3, ..*span };
    let (file, definitions) = document.scopes.split_first_mut()?;
    for span in definitions.iter().flat_map(|scope| &scope.skies.spans) {
        let help = "it is around the whole scene: move it out of the definition";
        findings.push(Diagnostic::here(keyword(span), "a sky cannot stand in a definition", help));
    }
    if let [first, again, ..] = &file.skies.spans[..] {
        let places = [again, first].map(keyword);
        findings.push(Diagnostic::again(places, "the scene has two skies", "remove one of them"));
    }
    file.skies.rows.first().cloned()
}

/// The sky that a scene states, without the rest of it, and where; `None` if that has syntax
/// errors.
pub fn stated_sky(source: &Source, options: &Options) -> Option<(StatedSky, Span)> {
    memchr::memmem::find(&source.text, b"sky")?;
    crate::check_length(source, options).ok()?;
    let mut findings = Vec::new();
    let mut document = read(&source.text, options, &mut findings);
    let sky = take(&mut document, &mut findings)?;
    let file = document.requests.iter().find(|request| request.kind == RequestKind::Sky)?.file;
    Some((sky, file))
}
