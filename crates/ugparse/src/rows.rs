//! Statements of one kind, with their places in the text.

use crate::source::Span;

/// A table, and the span of each row in the text.
#[derive(Debug)]
pub(crate) struct Rows<T> {
    pub rows: Vec<T>,
    pub spans: Vec<Span>,
}

impl<T> Default for Rows<T> {
    fn default() -> Self {
        Self { rows: Vec::new(), spans: Vec::new() }
    }
}

impl<T> Rows<T> {
    pub fn push(&mut self, row: T, span: Span) {
        self.rows.push(row);
        self.spans.push(span);
    }

    pub fn with_capacity(rows: usize) -> Self {
        Self { rows: Vec::with_capacity(rows), spans: Vec::with_capacity(rows) }
    }

    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// Removes the given rows, which must be sorted.
    pub fn remove(&mut self, rows: &[usize]) {
        if rows.is_empty() {
            return;
        }
        let is_kept = |row: usize| rows.binary_search(&row).is_err();
        let mut row = 0..;
        self.rows.retain(|_| row.next().is_some_and(is_kept));
        let mut row = 0..;
        self.spans.retain(|_| row.next().is_some_and(is_kept));
    }
}
