//! The statement `sky`, which holds for the whole scene.

use ugscene::StatedSky;

use crate::Options;
use crate::diagnostic::Diagnostic;
use crate::number_text::push_number;
use crate::reader::{Document, read};
use crate::source::{Source, Span};

/// The sky of a document. One in a definition, and a second one, are errors.
pub(crate) fn take(
    text: &[u8],
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
    let statement = file.skies.rows.first()?;
    let file = statement.file.name.lossy(text);
    Some(StatedSky { file, turn: statement.turn })
}

/// The sky that a scene states, without the rest of it, and where; `None` if that has syntax
/// errors.
pub fn stated_sky(source: &Source, options: &Options) -> Option<(StatedSky, Span)> {
    memchr::memmem::find(&source.text, b"sky")?;
    crate::check_length(source, options).ok()?;
    let mut findings = Vec::new();
    let mut document = read(&source.text, options, &mut findings);
    let sky = take(&source.text, &mut document, &mut findings)?;
    Some((sky, document.scopes.first()?.skies.rows.first()?.file.name))
}

/// Writes the statement.
pub(crate) fn write(sky: &StatedSky, out: &mut Vec<u8>, numbers: &mut zmij::Buffer) {
    let StatedSky { file, turn } = sky;
    let is_plain = |byte: u8| byte.is_ascii_alphanumeric() || matches!(byte, b'.' | b'/' | b'_');
    let quote = if file.bytes().all(is_plain) { "" } else { "\"" };
    out.extend_from_slice(format!("sky {quote}{file}{quote}").as_bytes());
    if *turn != [0.0; 3] {
        out.extend_from_slice(b" -ra");
        for degrees in turn {
            out.push(b' ');
            push_number(out, numbers, *degrees);
        }
    }
    out.push(b';');
}
