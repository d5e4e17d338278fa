//! Tables of statements with their places in the text; those of colours and surfaces have names
//! that are visible in nested scopes.

use rustc_hash::FxHashMap;

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

/// The colours or surfaces of a scope.
pub(crate) struct Named<'t, T> {
    /// In the order of the text. The names in the rows are not set yet.
    pub table: Rows<T>,
    /// The span of each row's name, if it has one.
    pub spans: Vec<Option<Span>>,
    /// Names used or defined in this scope.
    pub names: NameTable<'t>,
    /// For each of these names its row, if it is defined in this scope.
    rows: Vec<Option<u32>>,
}

impl<T> Default for Named<'_, T> {
    fn default() -> Self {
        Self {
            table: Rows::default(),
            spans: Vec::new(),
            names: NameTable::default(),
            rows: Vec::new(),
        }
    }
}

impl<'t, T> Named<'t, T> {
    /// Adds the statement at `span`. If its name is already defined, returns it with the first one.
    pub fn push(
        &mut self,
        text: &'t [u8],
        name: Option<Span>,
        row: T,
        span: Span,
    ) -> Option<[Span; 2]> {
        let before = name.and_then(|name| {
            let number = self.names.enter(name.of(text));
            if number >= self.rows.len() {
                self.rows.resize(number + 1, None);
            }
            self.rows[number].replace(self.spans.len() as u32)
        });
        self.table.push(row, span);
        self.spans.push(name);
        Some([name?, self.spans[before? as usize]?])
    }

    /// The row with this name, if it is defined in this scope.
    pub fn row(&self, name: &[u8]) -> Option<usize> {
        self.rows.get(self.names.get(name)?).copied().flatten().map(|row| row as usize)
    }
}

/// Names, numbered in the order in which they are used or defined.
#[derive(Default)]
pub(crate) struct NameTable<'t> {
    pub list: Vec<&'t [u8]>,
    numbers: FxHashMap<&'t [u8], usize>,
    /// The number that was looked up last: consecutive statements often share a colour.
    last: usize,
}

impl<'t> NameTable<'t> {
    /// The number of a name; adds it if it is new.
    #[inline]
    pub fn enter(&mut self, name: &'t [u8]) -> usize {
        match self.list.get(self.last) {
            Some(&last) if last == name => self.last,
            _ => self.enter_other(name),
        }
    }

    fn enter_other(&mut self, name: &'t [u8]) -> usize {
        self.last = *self.numbers.entry(name).or_insert_with(|| {
            self.list.push(name);
            self.list.len() - 1
        });
        self.last
    }

    /// The number of a name, if it is known.
    pub fn get(&self, name: &[u8]) -> Option<usize> {
        self.numbers.get(name).copied()
    }
}
