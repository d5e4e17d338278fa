//! Diagnostics as text, each with the line it is about; only programs print it.

use annotate_snippets::{Annotation, AnnotationKind, Group, Level, Origin, Renderer, Snippet};
use ugpipe::{is_printable, message, printable};

#[cfg(feature = "cli")]
use crate::diagnostic::Setting;
use crate::diagnostic::{Diagnostic, Severity};
use crate::diagnostics::{Diagnostics, marks_of};
use crate::source::{LineMark, Source, Span};

/// The largest number of bytes of a line shown with an error; longer lines are truncated.
const MAX_SHOWN: usize = 160;

impl Diagnostic {
    /// Renders the message as text, with the line and a caret. What a terminal would obey in names
    /// and words of the scene is replaced.
    pub fn render(&self, source: &Source, styled: bool) -> String {
        self.render_with(source, &marks_of(source), styled)
    }

    fn render_with(&self, source: &Source, marks: &[LineMark], styled: bool) -> String {
        let level = match self.severity {
            Severity::Error => Level::ERROR,
            Severity::Warning => Level::WARNING,
            Severity::Note => Level::NOTE,
        };
        let title = level.primary_title(message(&self.message));
        let mut report = vec![match self.span {
            Span::WHOLE_FILE => title.element(Origin::path(printable(&source.name))),
            _ => title.elements(self.snippets(source, marks)),
        }];
        if let Some(help) = &self.help {
            report.push(Group::with_title(Level::HELP.secondary_title(message(help))));
        }
        let renderer = if styled { Renderer::styled() } else { Renderer::plain() };
        let drawn = renderer.render(&report);
        let places = [Some(self.span), self.other.as_ref().map(|(span, _)| *span)];
        places
            .into_iter()
            .flatten()
            .fold(drawn, |drawn, span| with_whole_column(drawn, source, marks, span))
    }

    /// The lines to show: one snippet for each location.
    fn snippets(&self, source: &Source, marks: &[LineMark]) -> Vec<Snippet<'_, Annotation<'_>>> {
        let mut places = vec![(self.span, self.label.as_str(), AnnotationKind::Primary)];
        if let Some((span, label)) = &self.other {
            places.push((*span, label.as_str(), AnnotationKind::Context));
        }
        places
            .into_iter()
            .map(|(span, label, kind)| {
                let excerpt = Excerpt::new(source, span);
                let (name, line) = source.reported(marks, span.start);
                let label = (!label.is_empty()).then(|| message(label));
                let annotation = kind.span(excerpt.mark).label(label);
                Snippet::source(excerpt.text)
                    .path(printable(name))
                    .line_start(line)
                    .annotation(annotation)
            })
            .collect()
    }
}

/// Corrects the column in a rendered message if the beginning of the line was cut off.
fn with_whole_column(drawn: String, source: &Source, marks: &[LineMark], span: Span) -> String {
    let excerpt = Excerpt::new(source, span);
    if excerpt.n_cut == 0 {
        return drawn;
    }
    let (name, line) = source.reported(marks, span.start);
    let column = excerpt.text[..excerpt.mark.start].chars().count() + 1;
    let place = |column: usize| format!("{}:{line}:{column}", printable(name));
    drawn.replacen(&place(column), &place(column + excerpt.n_cut), 1)
}

/// The part of a source line that is shown with a diagnostic, and the span to underline in it.
struct Excerpt {
    text: String,
    mark: std::ops::Range<usize>,
    /// Number of characters cut off at the beginning of the line.
    n_cut: usize,
}

impl Excerpt {
    /// Extracts the line around `span`: control characters become blanks, invalid UTF-8 and other
    /// characters that are not printable are replaced, long lines are truncated.
    fn new(source: &Source, span: Span) -> Self {
        let text = &source.text;
        let start = (span.start as usize).min(text.len());
        let line_start = memchr::memrchr(b'\n', &text[..start]).map_or(0, |idx| idx + 1);
        let line_end = memchr::memchr(b'\n', &text[start..]).map_or(text.len(), |idx| start + idx);
        let end = (span.end as usize).clamp(start, line_end);

        let cut_start = line_start.max(start.saturating_sub(MAX_SHOWN / 2));
        let cut_end = line_end.min(start + MAX_SHOWN);
        let shown = |from: usize, to: usize| {
            String::from_utf8_lossy(&text[from..to.max(from)])
                .replace(|c: char| c.is_control() && c != '\t', " ")
                .replace(|c: char| !is_printable(c) && c != '\t', "\u{fffd}")
        };
        let before = shown(cut_start, start);
        let marked = shown(start, end.min(cut_end));
        let after = shown(end.min(cut_end), cut_end);
        let mark = before.len()..before.len() + marked.len();
        let n_cut = String::from_utf8_lossy(&text[line_start..cut_start]).chars().count();
        Self { n_cut, text: format!("{before}{marked}{after}"), mark }
    }
}

impl Diagnostics {
    /// Renders all findings as text.
    pub fn render(&self, styled: bool) -> String {
        let marks = marks_of(&self.source);
        let mut parts: Vec<String> = self
            .list
            .iter()
            .map(|finding| finding.render_with(&self.source, &marks, styled))
            .collect();
        if self.omitted > 0 {
            parts.push(format!("… and {} more", self.omitted));
        }
        parts.join("\n\n")
    }
}

/// For a command line.
#[cfg(feature = "cli")]
impl Diagnostics {
    /// All findings as text with styles, as a program prints it.
    pub fn report(&self) -> String {
        self.clone().worded().render(true)
    }

    /// The findings with the options that their remedies are about.
    #[must_use]
    pub fn worded(mut self) -> Self {
        for finding in &mut self.list {
            if let (Some(help), Some(setting)) = (&mut finding.help, finding.setting.take()) {
                *help += &setting.words();
            }
        }
        self
    }
}

#[cfg(feature = "cli")]
impl Setting {
    /// The end of a help text that names the command-line option.
    fn words(&self) -> String {
        match self {
            Self::Lax => "; with -lax others are passed on".to_owned(),
            Self::Execute => " with --allow-execute".to_owned(),
            Self::Limit(limit) => format!(" with --limit {}=N", limit.name()),
            Self::Camera => " (-cam)".to_owned(),
            Self::NoCamera => ", or leave out -cam".to_owned(),
        }
    }
}
