//! Attaches comments to statements of the flat scene.

use ugscene::{Comment, Item};

use super::Expander;
use crate::reader::CommentSpan;
use crate::scope::Scope;
use crate::source::Span;

impl Expander<'_, '_> {
    /// Records the spans of colours and surfaces.
    pub(super) fn note_definitions(&mut self, file: &Scope<'_>) {
        let Some(emitted) = &mut self.emitted else { return };
        let defined = self.scopes;
        let scopes = || std::iter::once(file).chain(defined);
        let colors = scopes().flat_map(|scope| &scope.colors.table.spans);
        emitted.extend(colors.enumerate().map(|(row, &span)| (span, Item::Color(row as u32))));
        let surfaces = scopes().flat_map(|scope| &scope.surfaces.table.spans);
        emitted.extend(surfaces.enumerate().map(|(row, &span)| (span, Item::Surface(row as u32))));
    }

    /// Records the spans of statements whose rows begin at `first`.
    pub(super) fn note(&mut self, spans: &[Span], first: usize, item: fn(u32) -> Item) {
        if let Some(emitted) = &mut self.emitted {
            emitted.extend(spans.iter().zip(first as u32..).map(|(&span, row)| (span, item(row))));
        }
    }

    /// Comments before the first statement become head comments; others are attached to the row of
    /// their statement.
    pub(super) fn place_comments(&mut self, comments: &[CommentSpan], first_statement: u32) {
        let mut emitted = self.emitted.take().unwrap_or_default();
        emitted.sort_by_key(|&(span, item)| (span.start, item));
        for comment in comments {
            let text = String::from_utf8_lossy(comment.text.of(self.text)).into_owned();
            if comment.text.start < first_statement {
                self.scene.remarks.head.push(text);
                continue;
            }
            let (at, trailing) = item_at(self.text, &emitted, comment);
            self.scene.remarks.comments.push(Comment { text, at, trailing });
        }
        // The writer traverses rows and comments in parallel.
        self.scene.remarks.comments.sort_by_key(|comment| comment.at);
    }
}

/// The statement to which a comment belongs.
fn item_at(text: &[u8], emitted: &[(Span, Item)], comment: &CommentSpan) -> (Item, bool) {
    let position = comment.text.start;
    let behind = emitted.partition_point(|(span, _)| span.start < position);
    if let Some(&(span, item)) = behind.checked_sub(1).and_then(|idx| emitted.get(idx)) {
        let inside = position < span.end;
        let on_its_line = comment.trailing && !text[span.end as usize..position as usize].contains(&b'\n');
        if inside || on_its_line {
            return (item, on_its_line);
        }
    }
    let next = emitted.get(behind).map_or(Item::End, |&(_, item)| item);
    (next, false)
}
