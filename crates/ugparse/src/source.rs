//! The text of a scene with its name, and positions in it.

use std::collections::BTreeMap;
use std::sync::Arc;

use memchr::memchr_iter;

use crate::Parsed;
use crate::origin::Origin;

/// The text of a scene, and its name in messages.
#[derive(Clone, Debug)]
pub struct Source {
    /// File name, or `<stdin>`.
    pub name: String,
    /// The bytes of the file. Comments and escapes may contain any bytes.
    pub text: Vec<u8>,
    /// The record of the text in the history of the scene.
    pub origin: Option<Origin>,
    /// Of a mesh, its scene, which [`crate::include`] reads with the files that it names; `None` in
    /// it before and in messages. A mesh has no line marks.
    pub(crate) mesh: Option<Box<Option<Parsed>>>,
    /// The pictures that it names, which [`crate::include`] reads.
    pub(crate) images: Images,
}

/// The bytes of pictures by the paths of their files, and by their rows in a mesh.
pub(crate) type Images = BTreeMap<(String, Option<u32>), Arc<[u8]>>;

impl Source {
    /// A source from a name and text.
    pub fn new(name: impl Into<String>, text: impl Into<Vec<u8>>) -> Self {
        Self {
            name: name.into(),
            text: text.into(),
            origin: None,
            mesh: None,
            images: Images::new(),
        }
    }

    /// The same source with an origin.
    #[must_use]
    pub fn with_origin(self, origin: Option<Origin>) -> Self {
        Self { origin, ..self }
    }

    /// Line and column (both from 1, the column in bytes) of a byte position.
    pub fn line_column(&self, position: u32) -> (usize, usize) {
        let before = &self.text[..(position as usize).min(self.text.len())];
        let line_start = memchr::memrchr(b'\n', before).map_or(0, |idx| idx + 1);
        (memchr_iter(b'\n', before).count() + 1, before.len() - line_start + 1)
    }

    /// The text of a span; text that is not UTF-8 is shown with replacement characters.
    pub fn slice(&self, span: Span) -> std::borrow::Cow<'_, str> {
        String::from_utf8_lossy(span.of(&self.text))
    }
}

/// A line mark `# LINE "FILE"`: the text after it comes from another place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct LineMark {
    /// The first byte after the line of the mark.
    pub start: u32,
    /// The number of the line that begins there.
    pub line: usize,
    /// The file; `None` if it does not change.
    pub name: Option<String>,
}

impl Source {
    /// File and line of a position, according to the line marks.
    pub(crate) fn reported<'s>(&'s self, marks: &'s [LineMark], position: u32) -> (&'s str, usize) {
        let before = &marks[..marks.partition_point(|mark| mark.start <= position)];
        let name = before.iter().rev().find_map(|mark| mark.name.as_deref()).unwrap_or(&self.name);
        let Some(last) = before.last() else { return (name, self.line_column(position).0) };
        let end = (position as usize).min(self.text.len());
        (
            name,
            last.line
                .saturating_add(memchr_iter(b'\n', &self.text[last.start as usize..end]).count()),
        )
    }
}

/// A range of bytes in a [`Source`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Span {
    /// First byte.
    pub start: u32,
    /// Byte after the last.
    pub end: u32,
}

impl Span {
    /// No place in a file but the file itself.
    pub(crate) const WHOLE_FILE: Self = Self { start: u32::MAX, end: u32::MAX };

    /// The bytes of this span in its text.
    pub(crate) fn of(self, text: &[u8]) -> &[u8] {
        &text[self.start as usize..self.end as usize]
    }

    /// The same; what is not UTF-8 is replaced.
    pub(crate) fn lossy(self, text: &[u8]) -> String {
        String::from_utf8_lossy(self.of(text)).into_owned()
    }
}
