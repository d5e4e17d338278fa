//! Attaches comments to statements of the flat scene.

use rustc_hash::FxHashSet;

use super::{Expander, Origins};
use crate::passed_on::{Comment, Item};
use crate::reader::CommentSpan;
use crate::scope::Scope;
use crate::source::Span;

impl Expander<'_, '_> {
    /// Records the spans of colours and surfaces.
    pub(super) fn note_definitions(&mut self, file: &Scope<'_>) {
        let scopes = || std::iter::once(file).chain(self.scopes);
        let colors: Vec<Span> =
            scopes().flat_map(|scope| &scope.colors.table.spans).copied().collect();
        let surfaces: Vec<Span> =
            scopes().flat_map(|scope| &scope.surfaces.table.spans).copied().collect();
        self.note(&colors, 0, Item::Color);
        self.note(&surfaces, 0, Item::Surface);
    }

    /// Records the spans of statements whose rows begin at `first`.
    pub(super) fn note(&mut self, spans: &[Span], first: usize, item: fn(u32) -> Item) {
        if let Some(emitted) = &mut self.emitted {
            emitted.extend(spans.iter().zip(first as u32..).map(|(&span, row)| (span, item(row))));
        }
    }

    /// All statements in the order of the text, if there are comments to attach, with the first rows
    /// made from them.
    fn statements(&mut self) -> Vec<(Span, Item)> {
        let Some(mut all) = self.emitted.take() else { return Vec::new() };
        let is_flat = self.scopes.len() == 1;
        let Origins { vertices, faces, lights, cameras, wires, passed_on } = &self.origins;
        let name = |row: u32| Item::Vertex(self.scene.vertices[row as usize].name.index() as u32);
        let vertices = firsts(is_flat, vertices, name);
        all.extend(vertices.map(|(name, item)| (Scope::vertex_statement(self.text, name), item)));
        all.extend(firsts(is_flat, faces, Item::Face));
        all.extend(firsts(is_flat, wires, Item::Wire));
        all.extend(firsts(is_flat, lights, Item::Light));
        all.extend(firsts(is_flat, cameras, Item::Camera));
        all.extend(firsts(is_flat, passed_on, Item::PassedOn));
        all.sort_by_key(|&(span, item)| (span.start, item));
        all
    }

    /// Comments before the first statement become head comments; others are attached to the row of
    /// their statement.
    pub(super) fn place_comments(&mut self, comments: &[CommentSpan], first_statement: u32) {
        let emitted = self.statements();
        for comment in comments {
            let text = comment.text.lossy(self.text);
            if comment.text.start < first_statement {
                self.scene.head.comments.push(text);
                continue;
            }
            let (at, trailing) = item_at(self.text, &emitted, comment);
            self.passed_on.comments.push(Comment { text, at, trailing });
        }
    }
}

/// Statements with the first row of each. `is_flat`: none has several.
fn firsts<I: Fn(u32) -> Item>(
    is_flat: bool,
    spans: &[Span],
    item: I,
) -> impl Iterator<Item = (Span, Item)> {
    let mut known = FxHashSet::default();
    let rows = spans.iter().zip(0..);
    rows.filter(move |(span, _)| is_flat || known.insert(span.start))
        .map(move |(&span, row)| (span, item(row)))
}

/// The statement to which a comment belongs.
fn item_at(text: &[u8], emitted: &[(Span, Item)], comment: &CommentSpan) -> (Item, bool) {
    let position = comment.text.start;
    let behind = emitted.partition_point(|(span, _)| span.start < position);
    if let Some(&(span, item)) = behind.checked_sub(1).and_then(|idx| emitted.get(idx)) {
        let inside = position < span.end;
        let on_its_line =
            comment.trailing && !text[span.end as usize..position as usize].contains(&b'\n');
        if inside || on_its_line {
            return (item, on_its_line);
        }
    }
    let next = emitted.get(behind).map_or(Item::End, |&(_, item)| item);
    (next, false)
}
