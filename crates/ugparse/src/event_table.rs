//! Tables of events, which `-path` of a motion names: CSV with the columns t, x, y and z.

use ugphysics::{Event, SampledPath, WorldLineError};

use crate::diagnostic::{Diagnostic, MAX_ERRORS};
use crate::diagnostics::Diagnostics;
use crate::source::{Source, Span};
use crate::token::number;
use crate::wording::{shorten, word_help};

/// The names of the columns.
const COLUMNS: [&[u8]; 4] = [b"t", b"x", b"y", b"z"];

/// The events of a table as the text `(t x y z …)`. `None` if the first line that is neither empty
/// nor a comment does not name the columns: then no line of it may be quoted.
///
/// # Errors
/// Rows that are not numbers, or between which no body can move.
pub(crate) fn events(table: &Source) -> Result<Option<Vec<u8>>, Diagnostics> {
    let text = &table.text[..];
    let mut lines = lines(text);
    let Some(names) = lines.next() else { return Ok(None) };
    let separator = if names.of(text).contains(&b',') { Some(b',') } else { None };
    let names = fields(text, names, separator);
    let column = |name: &[u8]| {
        let mut rows =
            names.iter().enumerate().filter(|(_, field)| unquoted(field.of(text)) == name);
        rows.next().map(|(row, _)| row).filter(|_| rows.next().is_none())
    };
    let [Some(t), Some(x), Some(y), Some(z)] = COLUMNS.map(column) else { return Ok(None) };
    let mut reading = Reading { text, out: vec![b'('], rows: Vec::new(), events: Vec::new() };
    let mut findings = Vec::new();
    for line in lines {
        let fields = fields(text, line, separator);
        let result = if fields.len() == names.len() {
            reading.row(line, [t, x, y, z].map(|column| fields[column]))
        } else {
            let message =
                format!("{} fields where {} columns have names", fields.len(), names.len());
            Err(Diagnostic::error(line, message)
                .label("this line")
                .help("write a number in each column"))
        };
        findings.extend(result.err());
        if findings.len() == MAX_ERRORS || reading.rows.len() > SampledPath::MOST_EVENTS {
            break;
        }
    }
    let Reading { mut out, rows, events, .. } = reading;
    if findings.is_empty()
        && let Err(error) = SampledPath::new(&events)
    {
        findings.push(impossible(&error, |row| rows.get(row).copied().unwrap_or(Span::WHOLE_FILE)));
    }
    if !findings.is_empty() {
        return Err(Diagnostics::new(table, findings));
    }
    out.push(b')');
    Ok(Some(out))
}

/// The error of a path. `row`: where an event is.
pub(crate) fn impossible(error: &WorldLineError, row: impl Fn(usize) -> Span) -> Diagnostic {
    let between = |first: usize, message: &str| {
        Diagnostic::error(row(first + 1), message)
            .label("to this event")
            .other(row(first), "from this one")
    };
    match *error {
        WorldLineError::TooFast { row } => between(
            row,
            "between two events of a path the speed reaches that of light",
        )
        .help("rows that are nearer in space or farther in time, or more of them, keep it below 1"),
        WorldLineError::TimeOrder { row } => between(row, "the time of a path does not increase")
            .help("sort the events by their times"),
        WorldLineError::FewEvents => {
            Diagnostic::error(row(0), "a path has fewer than two events").help("give two or more")
        }
        _ => Diagnostic::error(row(0), format!("no body can move along a path: {error}"))
            .help("use smaller numbers"),
    }
}

/// What is read of a table.
struct Reading<'t> {
    text: &'t [u8],
    /// The numbers as the table has them.
    out: Vec<u8>,
    rows: Vec<Span>,
    events: Vec<Event>,
}

impl Reading<'_> {
    fn row(&mut self, line: Span, fields: [Span; 4]) -> Result<(), Diagnostic> {
        if self.events.len() == SampledPath::MOST_EVENTS {
            self.rows.push(line);
            let message = format!("a table of more than {} events", SampledPath::MOST_EVENTS);
            return Err(Diagnostic::error(line, message)
                .label("the first too many")
                .help("leave some out"));
        }
        let mut numbers = [0.0; 4];
        for (value, field) in numbers.iter_mut().zip(fields) {
            let word = field.of(self.text);
            *value = match number(word) {
                Ok(([], value)) => value,
                _ => return Err(not_a_number(field, word)),
            };
        }
        for field in fields {
            if self.out.len() > 1 {
                self.out.push(b' ');
            }
            self.out.extend_from_slice(field.of(self.text));
        }
        let [t, x, y, z] = numbers;
        self.events.push(Event { t, x: [x, y, z].into() });
        self.rows.push(line);
        Ok(())
    }
}

fn not_a_number(field: Span, word: &[u8]) -> Diagnostic {
    let message = match word {
        [] => "a number is missing".to_string(),
        _ => format!("`{}` is not a finite number", shorten(word)),
    };
    let help = word_help("a number", word);
    let error = Diagnostic::error(field, message).label("here");
    error.help(
        help.unwrap_or_else(|| {
            "write a number in each of the columns `t`, `x`, `y` and `z`".into()
        }),
    )
}

fn unquoted(name: &[u8]) -> &[u8] {
    name.strip_prefix(b"\"").and_then(|name| name.strip_suffix(b"\"")).unwrap_or(name)
}

/// The fields of a line, between separators or, without one, between blanks.
fn fields(text: &[u8], line: Span, separator: Option<u8>) -> Vec<Span> {
    let words = line.of(text);
    let is_end =
        |byte: &u8| separator.map_or(byte.is_ascii_whitespace(), |separator| *byte == separator);
    let mut next = line.start;
    let fields = words.split(is_end).map(|field| {
        let start = next + (field.len() - field.trim_ascii_start().len()) as u32;
        next += field.len() as u32 + 1;
        Span { start, end: start + field.trim_ascii().len() as u32 }
    });
    fields.filter(|field| separator.is_some() || field.start < field.end).collect()
}

/// The lines of a text, without blanks around them, but those that are empty or comments.
fn lines(text: &[u8]) -> impl Iterator<Item = Span> {
    let mut next = if text.starts_with(b"\xef\xbb\xbf") { 3 } else { 0 };
    let lines = text[next..].split(|byte| matches!(byte, b'\n' | b'\r')).map(move |line| {
        let start = next + (line.len() - line.trim_ascii_start().len());
        next += line.len() + 1;
        Span { start: start as u32, end: (start + line.trim_ascii().len()) as u32 }
    });
    lines.filter(|line| !matches!(line.of(text), [] | [b'#', ..]))
}
