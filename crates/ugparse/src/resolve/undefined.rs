//! Errors for undefined names.

use super::enclosing;
use crate::diagnostic::{Diagnostic, MAX_ERRORS};
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
                self.check(kind, name);
            }
        }
    }

    /// Reports a name that is not visible in the scope.
    fn check(&mut self, kind: NameKind, name: Span) {
        let (text, own, scope) = (self.text, name.of(self.text), &self.scopes[self.row]);
        let around = || enclosing(self.scopes, self.row).map(|scope| &self.scopes[scope]);
        let is_color = || around().any(|scope| scope.colors.row(own).is_some());
        let is_surface = || around().any(|scope| scope.surfaces.row(own).is_some());
        let names: Box<dyn Iterator<Item = &Span>>;
        let (kind, remedy) = match kind {
            NameKind::Color if !is_color() => {
                names = Box::new(around().flat_map(|scope| scope.colors.spans.iter().flatten()));
                let remedy =
                    "there is a surface of that name; on a face it follows the colour, so add one";
                (
                    "colour",
                    if is_surface() { remedy } else { "define it with a `c` or `c_rgb` statement" },
                )
            }
            NameKind::Surface if !is_surface() => {
                names = Box::new(around().flat_map(|scope| scope.surfaces.spans.iter().flatten()));
                let remedy =
                    "there is a colour of that name; a face has one colour, followed by a surface";
                ("surface", if is_color() { remedy } else { "define it with a `surf` statement" })
            }
            NameKind::Vertex if !scope.has_vertex(own) && !scope.may_be_path(own) => {
                names = Box::new(scope.vertices.spans.iter());
                let remedy = if own.contains(&b':') {
                    "define it with a `v` statement: this scope has no instance or array with such a vertex"
                } else if self.row == 0 {
                    "define it with a `v` statement"
                } else {
                    "define it with a `v` statement in the same `def`: vertices of enclosing scopes are not visible here"
                };
                ("vertex", remedy)
            }
            _ => return,
        };
        let names = names.map(|span| span.of(text));
        let found = undefined_like(text, kind, name, remedy, names, self.findings.len());
        self.findings.push(found);
    }
}

pub(crate) fn undefined(text: &[u8], kind: &str, name: Span, remedy: &str) -> Diagnostic {
    Diagnostic::error(name, format!("{kind} `{}` is not defined", name.lossy(text)))
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
        Some(guess) => {
            undefined(text, kind, name, &format!("did you mean `{guess}`? if not, {remedy}"))
        }
        None => undefined(text, kind, name, remedy),
    }
}
