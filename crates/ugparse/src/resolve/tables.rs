//! Colours that change with own time: the colours of their rows, and where they may stand.

use ugscene::{ColorId, ColorTable, LightKind, LightMotion, Scene};

use crate::diagnostic::{Diagnostic, MAX_ERRORS};
use crate::reader::names_in;
use crate::scope::Scope;
use crate::source::Span;
use crate::statement::NameKind;

/// Reports colours that change where none may change; gives the others their colour at own time 0.
pub(super) fn check(
    text: &[u8],
    scopes: &[Scope<'_>],
    scene: &mut Scene,
    findings: &mut Vec<Diagnostic>,
) {
    if scene.color_tables.is_empty() {
        return;
    }
    scene.color_tables.sort_by_key(|table| table.color);
    let mut is_timed = vec![false; scene.colors.len()];
    scene.color_tables.iter().for_each(|table| is_timed[table.color.index()] = true);
    let mut check = Check { text, scene, is_timed, findings };
    scopes.iter().for_each(|scope| check.scope(scope));
    for row in 0..scene.color_tables.len() {
        let table = &scene.color_tables[row];
        let [(now, _), _] = table.at(0.0).parts;
        let (color, value) = (table.color, scene.colors[now.index()].value);
        let translucency = scene.colors[now.index()].translucency;
        let timed = &mut scene.colors[color.index()];
        (timed.value, timed.translucency) = (value, translucency);
    }
}

struct Check<'a> {
    text: &'a [u8],
    scene: &'a Scene,
    /// By the row of the colour.
    is_timed: Vec<bool>,
    findings: &'a mut Vec<Diagnostic>,
}

impl Check<'_> {
    fn is_timed(&self, color: ColorId) -> bool {
        self.is_timed.get(color.index()).copied().unwrap_or_default()
    }

    fn scope(&mut self, scope: &Scope<'_>) {
        for (table, &span) in scope.color_tables.rows.iter().zip(&scope.color_tables.spans) {
            self.table(table, span);
        }
        for (mix, &span) in scope.mixes.rows.iter().zip(&scope.mixes.spans) {
            let mut names = std::iter::once(mix.color).chain(mix.parts.iter().map(|part| part.0));
            if let Some(at) = names.position(|color| self.is_timed(color)) {
                self.refuse(
                    names_in(self.text, span)[at].1,
                    "is in a mixture",
                    "mix the colours of its rows",
                );
            }
        }
        for (row, vertex) in scope.vertices.rows.iter().enumerate() {
            if vertex.color.is_some_and(|color| self.is_timed(color)) {
                let span = Scope::vertex_statement(self.text, scope.vertices.spans[row]);
                let help = "give it to the face or wire instead";
                self.refuse_in(span, "is the colour of a vertex", help);
            }
        }
        for (light, &span) in scope.lights.rows.iter().zip(&scope.lights.spans) {
            if !light.color.is_some_and(|color| self.is_timed(color)) {
                continue;
            }
            if !matches!(light.kind, LightKind::Local { .. }) {
                let help =
                    "give the light a place, by four numbers after the intensity: x y z radius";
                self.refuse_in(span, "is the colour of a light without a place", help);
            } else if light.motion == LightMotion::WithWhatItLights {
                let help = "give the light a motion, `<0 0 0>` if it rests in the scene; its own time is \
                            otherwise that of whatever it lights";
                self.refuse_in(span, "is the colour of a light without a motion", help);
            }
        }
    }

    fn table(&mut self, table: &ColorTable, span: Span) {
        let Some(table) = self.scene.table_of(table.color) else { return };
        let translucency = |color: ColorId| self.scene.colors[color.index()].translucency;
        let first = table.rows.first().map_or(0.0, |row| translucency(row.1));
        let wrong =
            |&(_, color): &(f64, ColorId)| self.is_timed(color) || translucency(color) != first;
        let Some(row) = table.rows.iter().position(wrong) else { return };
        let nested = self.is_timed(table.rows[row].1);
        // Its own name is the first.
        let name = names_in(self.text, span)[row + 1].1;
        if nested {
            self.refuse(name, "is in a table of times", "write its rows there");
        } else if self.findings.len() < MAX_ERRORS {
            let message = format!(
                "colour `{}` has another translucency than the first row",
                name.lossy(self.text)
            );
            let help = "give all colours of a table the same translucency";
            self.findings.push(Diagnostic::here(name, message, help));
        }
    }

    /// Reports the colour of the vertex or light in a statement.
    fn refuse_in(&mut self, span: Span, what: &str, help: &str) {
        let color =
            names_in(self.text, span).into_iter().find(|(kind, _)| *kind == NameKind::Color);
        self.refuse(color.map_or(span, |(_, name)| name), what, help);
    }

    fn refuse(&mut self, name: Span, what: &str, help: &str) {
        if self.findings.len() < MAX_ERRORS {
            let message =
                format!("colour `{}` changes with time and {what}", name.lossy(self.text));
            self.findings.push(Diagnostic::here(name, message, help));
        }
    }
}
