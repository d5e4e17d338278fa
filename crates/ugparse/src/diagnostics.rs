//! All errors and warnings about a scene.

use std::fmt;

use crate::diagnostic::{Diagnostic, MAX_ERRORS, Severity};
use crate::reader::line_marks;
use crate::source::{LineMark, Source, Span};

/// The line marks of a scene.
pub(crate) fn marks_of(source: &Source) -> Vec<LineMark> {
    if source.mesh.is_some() { Vec::new() } else { line_marks(&source.text) }
}

/// A location in a file, for programs that process messages.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Location {
    /// The name of the file in messages.
    pub file: String,
    /// Line number, from 1.
    pub line: usize,
    /// Column in bytes, from 1.
    pub column: usize,
}

impl Location {
    /// The location of a position in a text.
    pub(crate) fn new(source: &Source, marks: &[LineMark], position: u32) -> Self {
        let position = if position == Span::WHOLE_FILE.start { 0 } else { position };
        let (file, line) = source.reported(marks, position);
        Self { file: file.to_string(), line, column: source.line_column(position).1 }
    }
}

/// All errors and warnings about a scene, with its text.
#[derive(Clone, Debug)]
pub struct Diagnostics {
    /// Errors, then warnings, each in the order of the text.
    pub list: Vec<Diagnostic>,
    /// Number of further ones that are not in the list.
    pub omitted: usize,
    pub(crate) source: Box<Source>,
}

impl Diagnostics {
    /// Sorts findings and keeps the first [`MAX_ERRORS`].
    pub fn new(source: &Source, mut list: Vec<Diagnostic>) -> Self {
        list.sort_by_key(|finding| (finding.severity != Severity::Error, finding.span));
        let omitted = list.len().saturating_sub(MAX_ERRORS);
        list.truncate(MAX_ERRORS);
        // The text is necessary only to render messages.
        let text = if list.is_empty() { Vec::new() } else { source.text.clone() };
        let source = Source {
            mesh: source.mesh.as_ref().map(|_| Box::new(None)),
            ..Source::new(source.name.clone(), text)
        };
        Self { list, omitted, source: Box::new(source) }
    }

    /// Adds an error about the whole source.
    pub fn with_error(self, source: &Source, message: String) -> Self {
        self.with(source, Diagnostic::error(Span::WHOLE_FILE, message))
    }

    /// With another finding.
    pub fn with(self, source: &Source, finding: Diagnostic) -> Self {
        let mut list = self.list;
        list.push(finding);
        let all = Self::new(source, list);
        Self { omitted: all.omitted + self.omitted, ..all }
    }

    /// A single finding.
    pub fn one(source: &Source, finding: Diagnostic) -> Self {
        Self::new(source, vec![finding])
    }

    /// True if there are no findings.
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// The location of each finding in the list.
    pub fn locations(&self) -> Vec<Location> {
        let marks = marks_of(&self.source);
        let place = |finding: &Diagnostic| Location::new(&self.source, &marks, finding.span.start);
        self.list.iter().map(place).collect()
    }

    /// The second location of each finding in the list, if it has one, and the words at it.
    pub fn other_locations(&self) -> Vec<Option<(Location, &str)>> {
        let marks = marks_of(&self.source);
        let others = self.list.iter().map(|finding| finding.other.as_ref());
        let place = |span: &Span| Location::new(&self.source, &marks, span.start);
        others.map(|other| other.map(|(span, label)| (place(span), label.as_str()))).collect()
    }
}

impl fmt::Display for Diagnostics {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        #[cfg(feature = "report")]
        f.write_str(&self.render(false))?;
        #[cfg(not(feature = "report"))]
        for (Location { file, line, column }, finding) in self.locations().iter().zip(&self.list) {
            writeln!(f, "{file}:{line}:{column}: {}", finding.message)?;
        }
        Ok(())
    }
}

impl std::error::Error for Diagnostics {}
