//! A cursor over the text of one statement, and what statements have in common: names, colours,
//! corners and files.

use std::ops::Range;

use glam::DVec3;
use ugscene::{BodyId, ColorId, NameId, VertexId};

use crate::numbered::Name;
use crate::rows::Rows;
use crate::scope::Scope;
use crate::source::Span;
use crate::statement::{FileStatement, MotionReference, NameKind, RequestStatement};
use crate::token::{
    Input, Parsed, Reason, SyntaxError, blank, file_name, identifier, mark, number, wanted,
};

/// A parser of the statements of one scope.
pub(crate) struct Grammar<'t, 's> {
    pub text: &'t [u8],
    /// Where the statement begins.
    pub start: u32,
    /// What is not read yet. Its length gives the position.
    pub rest: Input<'t>,
    /// Receives the rows.
    pub scope: &'s mut Scope<'t>,
    /// The names in the statement, in the order of the text.
    pub names: &'s mut Vec<(NameKind, Span)>,
    /// Files and programs that statements name.
    pub requests: &'s mut Vec<RequestStatement>,
}

/// What was read, or an error: a recoverable one where nothing was read that is expected here.
pub(crate) type Outcome<'t, T = ()> = Result<T, nom::Err<SyntaxError<'t>>>;

/// A final error.
pub(super) fn refuse<'t, T>(at: Input<'t>, reason: Reason) -> Outcome<'t, T> {
    Err(nom::Err::Failure(SyntaxError { at, reason }))
}

/// The token that messages name where a statement lacks its end.
pub(crate) const END: &str = "`;`";

/// The first characters of a name, for messages.
pub(crate) const NAME: &str = "a name that begins with a letter, `:`, `_` or `#`";

/// The numbers that are valid.
#[derive(Clone, Copy)]
pub(crate) enum Valid {
    Any,
    /// From the first to the second; the rule in words.
    Range(f64, f64, &'static str),
    /// Those of a vector that is not zero.
    Direction,
}

impl Valid {
    pub const SHARE: Self = Self::Range(0.0, 1.0, "use a number from 0 to 1");

    pub const fn positive(rule: &'static str) -> Self {
        Self::Range(f64::MIN_POSITIVE, f64::INFINITY, rule)
    }

    pub const fn not_negative(rule: &'static str) -> Self {
        Self::Range(0.0, f64::INFINITY, rule)
    }

    pub fn read(self, input: Input<'_>) -> Parsed<'_, f64> {
        let read = number(input)?;
        match self {
            Self::Range(least, most, rule) if read.1 < least || read.1 > most => {
                refuse(input, Reason::OutOfRange(rule))
            }
            _ => Ok(read),
        }
    }
}

impl<'t> Grammar<'t, '_> {
    /// Reads a token.
    pub fn take<T>(&mut self, token: impl FnOnce(Input<'t>) -> Parsed<'t, T>) -> Outcome<'t, T> {
        let value;
        (self.rest, value) = token(self.rest)?;
        Ok(value)
    }

    /// Reads a token, if it is there.
    pub fn optional<T>(
        &mut self,
        token: impl FnOnce(Input<'t>) -> Parsed<'t, T>,
    ) -> Outcome<'t, Option<T>> {
        match self.take(token) {
            Err(nom::Err::Error(_)) => Ok(None),
            read => read.map(Some),
        }
    }

    /// Where the next token begins.
    pub fn at(&mut self) -> Outcome<'t, Input<'t>> {
        self.take(blank)?;
        Ok(self.rest)
    }

    pub fn number(&mut self, valid: Valid) -> Outcome<'t, f64> {
        self.take(|input| valid.read(input))
    }

    pub fn optional_number(&mut self, valid: Valid) -> Outcome<'t, Option<f64>> {
        self.optional(|input| valid.read(input))
    }

    /// Reads numbers, of which those from `n_required` on may be missing.
    pub fn numbers(
        &mut self,
        valid: impl IntoIterator<Item = Valid>,
        n_required: usize,
    ) -> Outcome<'t, Vec<f64>> {
        let mut numbers = Vec::new();
        for valid in valid {
            match self.number(valid) {
                Err(nom::Err::Error(_)) if numbers.len() >= n_required => break,
                read => numbers.push(read?),
            }
        }
        Ok(numbers)
    }

    /// Reads pairs, one or more, up to where `first` does not match.
    pub fn pairs<A, B>(
        &mut self,
        mut first: impl FnMut(&mut Self) -> Outcome<'t, A>,
        second: impl Fn(&mut Self) -> Outcome<'t, B>,
    ) -> Outcome<'t, Vec<(A, B)>> {
        let mut pairs = Vec::new();
        loop {
            match first(self) {
                Err(nom::Err::Error(_)) if !pairs.is_empty() => return Ok(pairs),
                read => pairs.push((read?, second(self)?)),
            }
        }
    }

    /// Reads the end of the statement.
    pub fn end(&mut self) -> Outcome<'t, Span> {
        self.take(mark(b';', END))?;
        self.scope.n_statements += 1;
        Ok(Span { start: self.start, end: self.position() })
    }

    /// Reads the end of the statement, and adds its row to a table.
    pub fn end_row<T>(
        &mut self,
        table: for<'a> fn(&'a mut Scope<'t>) -> &'a mut Rows<T>,
        row: T,
    ) -> Outcome<'t> {
        let span = self.end()?;
        table(self.scope).push(row, span);
        Ok(())
    }

    /// The byte position up to which the text is read.
    pub fn position(&self) -> u32 {
        // `parse` refuses texts of 4 GiB and more.
        (self.text.len() - self.rest.len()) as u32
    }

    /// The span of the word that was read last.
    fn span(&self, word: Input<'_>) -> Span {
        let end = self.position();
        Span { start: end - word.len() as u32, end }
    }

    /// Reads a name, for messages `what`.
    pub fn name(&mut self, what: &'static str) -> Outcome<'t, Span> {
        let name = self.take(|input| wanted(identifier(input), what))?;
        Ok(self.span(name))
    }

    pub fn optional_name(&mut self) -> Outcome<'t, Option<Span>> {
        Ok(self.optional(identifier)?.map(|name| self.span(name)))
    }

    /// Adds the name of the statement itself.
    pub fn own_name(&mut self, name: Option<Span>) -> Option<NameId> {
        name.map(|name| {
            self.names.push((NameKind::Own, name));
            self.scope.add_name(name.of(self.text))
        })
    }

    /// The number of the name of a colour.
    pub fn color_id(&mut self, name: Span) -> ColorId {
        self.names.push((NameKind::Color, name));
        ColorId::from_index(self.scope.colors.names.enter(name.of(self.text)))
    }

    pub fn color_name(&mut self) -> Outcome<'t, ColorId> {
        let name = self.name(NAME)?;
        Ok(self.color_id(name))
    }

    pub fn optional_color(&mut self) -> Outcome<'t, Option<ColorId>> {
        Ok(self.optional_name()?.map(|name| self.color_id(name)))
    }

    /// Reads one or more `( vertex … )`; returns the rows of the contours.
    pub fn contours(&mut self) -> Outcome<'t, Range<u32>> {
        let first = self.scope.contours.row_count();
        self.take(mark(b'(', "`(` and vertex names"))?;
        loop {
            self.corner()?;
            while let Some(name) = self.optional_name()? {
                self.push_corner(name);
            }
            self.take(mark(b')', "a vertex name or `)`"))?;
            self.scope.contours.end_contour();
            if self.optional(mark(b'(', "`(`"))?.is_none() {
                return Ok(first..self.scope.contours.row_count());
            }
        }
    }

    pub fn corner(&mut self) -> Outcome<'t> {
        let name = self.name("a vertex name")?;
        self.push_corner(name);
        Ok(())
    }

    fn push_corner(&mut self, name: Span) {
        self.names.push((NameKind::Vertex, name));
        let number = self.scope.vertex_names.enter(Name::new(name.of(self.text)));
        self.scope.contours.push_corner(VertexId(number));
    }

    /// Reads `[< motion >]`; returns the body that what is stated is part of.
    pub fn body(&mut self) -> Outcome<'t, BodyId> {
        let motion = self.optional_motion()?;
        let unstated = self.scope.bodies.bodies.unstated();
        Ok(motion.map_or(unstated, |motion| self.body_with(motion, DVec3::ZERO)))
    }

    /// The body with a motion. `at`: its reference point, if none is stated.
    pub fn body_with(&mut self, motion: MotionReference, at: DVec3) -> BodyId {
        self.scope.bodies.of_reference(self.text, motion, at)
    }

    /// Reads the name of a file, for messages `what`.
    pub fn file(&mut self, what: &'static str) -> Outcome<'t, FileStatement> {
        let at = self.at()?;
        let start = self.position();
        let name = self.take(|input| wanted(file_name(input), what))?;
        let span = Span { start, end: self.position() };
        let start = start + u32::from(at.starts_with(b"\""));
        Ok(FileStatement { span, name: Span { start, end: start + name.len() as u32 } })
    }
}
