//! Errors for undefined names.

use super::enclosing;
use crate::diagnostic::{Diagnostic, MAX_ERRORS};
use crate::named::Named;
use crate::reader::names_in;
use crate::scope::Scope;
use crate::source::Span;
use crate::statement::NameKind;
use crate::suggest::nearest;

/// Parses the statements of a scope again, and reports every undefined name.
pub(super) struct UndefinedNames<'g, 't, 'f> {
    pub text: &'t [u8],
    pub scopes: &'g [Scope<'t>],
    pub row: usize,
    pub findings: &'f mut Vec<Diagnostic>,
}

impl UndefinedNames<'_, '_, '_> {
    pub(super) fn report_all(&mut self) {
        for span in self.scopes[self.row].statements(self.text) {
            for (kind, name) in names_in(self.text, span) {
                match kind {
                    NameKind::Own => {}
                    NameKind::Color => self.check_color(name),
                    NameKind::Surface => self.check_surface(name),
                    NameKind::Vertex => self.check_vertex(name),
                }
            }
        }
    }

    fn check_color(&mut self, name: Span) {
        let remedies = [
            "define it with a `c` or `c_rgb` statement",
            "there is a surface of that name; on a face it follows the colour, so add one",
        ];
        self.check("colour", name, remedies, |scope| &scope.colors, |scope| &scope.surfaces);
    }

    fn check_surface(&mut self, name: Span) {
        let remedies = [
            "define it with a `surf` statement",
            "there is a colour of that name; a face has one colour, followed by a surface",
        ];
        self.check("surface", name, remedies, |scope| &scope.surfaces, |scope| &scope.colors);
    }

    /// Reports a name that is not visible in the scope. `remedies`: if nothing has this name, and
    /// if something of the other kind has it.
    fn check<T, O>(
        &mut self,
        kind: &str,
        name: Span,
        remedies: [&str; 2],
        of_kind: for<'g> fn(&'g Scope<'_>) -> &'g Named<'g, T>,
        of_other: for<'g> fn(&'g Scope<'_>) -> &'g Named<'g, O>,
    ) {
        let (scopes, own) = (self.scopes, name.of(self.text));
        let mut around = enclosing(scopes, self.row);
        if around.any(|scope| of_kind(&scopes[scope]).row(own).is_some()) {
            return;
        }
        let mut around = enclosing(scopes, self.row);
        let is_other = around.any(|scope| of_other(&scopes[scope]).row(own).is_some());
        let spans = enclosing(scopes, self.row).flat_map(|scope| &of_kind(&scopes[scope]).spans);
        let names = spans.flatten().map(|span| span.of(self.text));
        let remedy = remedies[usize::from(is_other)];
        let found = undefined_like(self.text, kind, name, remedy, names, self.findings.len());
        self.findings.push(found);
    }

    fn check_vertex(&mut self, name: Span) {
        let own = name.of(self.text);
        if self.scopes[self.row].has_vertex(own) || self.scopes[self.row].may_be_path(own) {
            return;
        }
        let remedy = if own.contains(&b':') {
            "define it with a `v` statement: this scope has no instance or array with such a vertex"
        } else if self.row == 0 {
            "define it with a `v` statement"
        } else {
            "define it with a `v` statement in the same `def`: vertices of enclosing scopes are not visible here"
        };
        let names = self.scopes[self.row].vertices.spans.iter().map(|span| span.of(self.text));
        let found = undefined_like(self.text, "vertex", name, remedy, names, self.findings.len());
        self.findings.push(found);
    }
}

pub(crate) fn undefined(text: &[u8], kind: &str, name: Span, remedy: &str) -> Diagnostic {
    Diagnostic::error(name, format!("{kind} `{}` is not defined", show(text, name)))
        .label("used here")
        .help(remedy)
}

/// Like [`undefined`], with the most similar name as a suggestion. With `n_before` findings
/// already, the error may not be shown, and no suggestion is computed.
pub(crate) fn undefined_like<'n>(
    text: &[u8],
    kind: &str,
    name: Span,
    remedy: &str,
    names: impl IntoIterator<Item = &'n [u8]>,
    n_before: usize,
) -> Diagnostic {
    let guess = if n_before < MAX_ERRORS { nearest(name.of(text), names) } else { None };
    match guess {
        Some(guess) => undefined(text, kind, name, &format!("did you mean `{guess}`? if not, {remedy}")),
        None => undefined(text, kind, name, remedy),
    }
}

pub(super) fn show(text: &[u8], name: Span) -> String {
    String::from_utf8_lossy(name.of(text)).into_owned()
}
