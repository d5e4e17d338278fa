//! Parses a text into scopes, statement by statement. After an error it continues behind the next
//! `;`.

use ugscene::Stage;

use crate::diagnostic::{Diagnostic, MAX_ERRORS};
use crate::fast_path;
use crate::options::{Limit, Options};
use crate::scope::Scope;
use crate::source::{LineMark, Span};
use crate::statement::{NameKind, RequestStatement};
use crate::statements::{END, Grammar, NAME, Outcome, Read, Statement, statement};
use crate::token::{
    Input, Reason, SyntaxError, blank, comment, escape, file_name, found, identifier, integer,
    line_end, mark, skip_statement, wanted, without_mark, word,
};
use crate::wording::{no_statement, shorten, with_usage, word_help};

/// A parsed text.
#[derive(Default)]
pub(crate) struct Document<'t> {
    /// The first is the file itself, the others are its definitions in the order of their `def`s.
    pub scopes: Vec<Scope<'t>>,
    /// Comments in the order of the text.
    pub comments: Vec<CommentSpan>,
    /// The position of the first statement.
    pub first_statement: Option<u32>,
    /// Line marks of the C preprocessor.
    pub line_marks: Vec<LineMark>,
    /// `include` and `execute` statements, and the files of `-path` and `c_tex`.
    pub requests: Vec<RequestStatement>,
    /// The stage of the scene and where it is stated, taken out of the escapes.
    pub stage: Option<(Stage, Span)>,
}

/// A comment: the text between its braces.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CommentSpan {
    pub text: Span,
    /// True if it begins on the line on which a statement ends.
    pub trailing: bool,
}

/// Parses the whole text. Errors are added to `findings`; parsing continues after them until there
/// are too many.
pub(crate) fn read<'t>(
    text: &'t [u8],
    options: &Options,
    findings: &mut Vec<Diagnostic>,
) -> Document<'t> {
    let mut reader = Reader {
        text,
        document: Document { scopes: vec![Scope::for_text(text.len())], ..Document::default() },
        open: vec![0],
        options: *options,
        line_has_statement: false,
        names: Vec::new(),
        findings,
        error_count: 0,
    };
    reader.run();
    reader.check_all_closed();
    reader.document
}

/// The line marks of the C preprocessor in a text.
pub(crate) fn line_marks(text: &[u8]) -> Vec<LineMark> {
    let may_be_one = |idx: usize| matches!(text[idx + 1..], [b' ' | b'\t', ..] | [b'l', b'i', ..]);
    if !memchr::memchr_iter(b'#', text).any(may_be_one) {
        return Vec::new();
    }
    // Marks after the last reported error do not matter.
    let options = Options { lax: true, ..Options::default() };
    read(text, &options, &mut Vec::new()).line_marks
}

/// The text behind a statement.
type Rest<'t> = Result<Input<'t>, SyntaxError<'t>>;

struct Reader<'t, 'f> {
    text: &'t [u8],
    document: Document<'t>,
    /// The open scopes, from the file inwards.
    open: Vec<usize>,
    options: Options,
    /// A statement has ended on the current line.
    line_has_statement: bool,
    /// The names in the statement that is being read.
    names: Vec<(NameKind, Span)>,
    findings: &'f mut Vec<Diagnostic>,
    error_count: usize,
}

impl<'t> Reader<'t, '_> {
    fn run(&mut self) {
        let mut input: Input<'t> = self.text;
        while self.error_count < MAX_ERRORS {
            match self.between(input) {
                Ok([]) => break,
                Ok(rest) => input = self.statement(rest),
                Err(syntax_error) => {
                    self.report_syntax_error(&syntax_error, None);
                    break;
                }
            }
        }
    }

    /// Skips white space and records comments up to the next statement.
    fn between(&mut self, mut input: Input<'t>) -> Rest<'t> {
        loop {
            match input.first() {
                Some(b'\n' | b'\r') => {
                    self.line_has_statement = false;
                    input = &input[1..];
                }
                Some(b'{') => {
                    let (rest, text) = comment(input)?;
                    self.push_comment(text, rest, self.line_has_statement);
                    input = rest;
                }
                Some(b) if b.is_ascii_whitespace() || *b == 0x0B => input = &input[1..],
                Some(0xef | 0x1a) if let Some(rest) = without_mark(input) => input = rest,
                _ => return Ok(input),
            }
        }
    }

    fn push_comment(&mut self, text: Input<'t>, rest: Input<'t>, trailing: bool) {
        let end = self.position(rest) - 1;
        let text = Span { start: end - text.len() as u32, end };
        self.document.comments.push(CommentSpan { text, trailing });
    }

    /// Parses one statement; returns the rest of the text, or where to continue after an error.
    fn statement(&mut self, input: Input<'t>) -> Input<'t> {
        let start = self.position(input);
        let scope = &mut self.document.scopes[self.open[self.open.len() - 1]];
        if let Some(end) = fast_path::statement(self.text, start as usize, scope) {
            self.document.first_statement.get_or_insert(start);
            self.line_has_statement = true;
            return &self.text[end..];
        }
        match self.try_statement(input) {
            Ok(rest) => {
                self.line_has_statement = true;
                rest
            }
            Err(syntax_error) => match self.next_statement(input, &syntax_error) {
                Some(next) => {
                    self.report_missing_end(input, &next);
                    next.at
                }
                None => {
                    self.report_syntax_error(&syntax_error, Some(input));
                    skip_statement(syntax_error.at).unwrap_or(&[])
                }
            },
        }
    }

    fn try_statement(&mut self, input: Input<'t>) -> Rest<'t> {
        if let Some(rest) = input.strip_prefix(b";") {
            return Ok(rest);
        }
        if input.first() == Some(&b'(') {
            let rest = escape(input)?.0;
            self.pass_on(input, rest);
            return Ok(rest);
        }
        let (body, keyword) = word(input)
            .map_err(|_| SyntaxError { at: input, reason: Reason::Expected("a statement") })?;
        match (statement(keyword), keyword) {
            (Some(Statement { read: Some(read), .. }), _) => self.row(*read, input, body),
            (Some(_), b"def") => self.begin_definition(input, body),
            (Some(_), _) => self.end_definition(input, body),
            (None, b"#" | b"#line") if let Some((rest, mark)) = self.line_mark(body) => {
                self.document.line_marks.push(mark);
                Ok(rest)
            }
            _ => self.unknown_statement(input, keyword, body),
        }
    }

    /// Parses one statement and adds it to its scope.
    fn row(&mut self, read: Read, input: Input<'t>, body: Input<'t>) -> Rest<'t> {
        let start = self.position(input);
        self.names.clear();
        let mut grammar = Grammar {
            text: self.text,
            start,
            rest: body,
            scope: &mut self.document.scopes[self.open[self.open.len() - 1]],
            names: &mut self.names,
            requests: &mut self.document.requests,
        };
        read(&mut grammar)?;
        let rest = grammar.rest;
        self.document.first_statement.get_or_insert(start);
        self.note_inner_comments(input, rest);
        Ok(rest)
    }

    /// Passes on an unknown statement unchanged, or refuses it.
    fn unknown_statement(
        &mut self,
        input: Input<'t>,
        keyword: Input<'t>,
        body: Input<'t>,
    ) -> Rest<'t> {
        if !self.options.lax {
            return Err(SyntaxError { at: input, reason: Reason::Expected("a statement") });
        }
        let rest = match keyword {
            // A preprocessor directive ends with its line.
            b"#" | b"#line" => &body[line_end(body)..],
            _ => skip_statement(body)?,
        };
        let start = self.position(input);
        let span = Span { start, end: start + keyword.len() as u32 };
        let name = shorten(keyword);
        self.findings.push(
            Diagnostic::warning(span, format!("statement `{name}` is passed on unread"))
                .label("not known here")
                .help("remove it if no program downstream reads it"),
        );
        self.pass_on(input, rest);
        Ok(rest)
    }

    /// Parses the rest of `# LINE "FILE" …`, which ends with its line. Flags after the file name
    /// are ignored.
    fn line_mark(&self, body: Input<'t>) -> Option<(Input<'t>, LineMark)> {
        let (body, behind) = body.split_at(line_end(body));
        let (rest, line) = integer(body).ok()?;
        let rest = rest.trim_ascii();
        let name = if rest.is_empty() {
            None
        } else {
            Some(file_name(rest).ok().filter(|_| rest[0] == b'"')?.1)
        };
        let behind = behind.strip_prefix(b"\r\n").unwrap_or(behind.get(1..).unwrap_or_default());
        let name = name.map(|name| String::from_utf8_lossy(name).into_owned());
        Some((behind, LineMark { start: self.position(behind), line: line as usize, name }))
    }

    /// `def ID ;`
    ///
    /// Opens a scope even if the line has an error, so that the `end` of the definition matches.
    fn begin_definition(&mut self, input: Input<'t>, body: Input<'t>) -> Rest<'t> {
        let row = self.document.scopes.len();
        let outer = self.open[self.open.len() - 1];
        let around = &self.document.scopes[outer];
        let last_default = around.defaults.last().map(|default| (outer, default.color));
        let outer_default = last_default.or(around.outer_default);
        self.document.scopes.push(Scope { parent: Some(outer), outer_default, ..Scope::default() });
        self.open.push(row);
        // The file is open, too. Only the first definition that is nested too deeply is reported.
        if self.open.len() as u64 == self.options.limits.get(Limit::Nesting) + 2 {
            let start = self.position(input);
            let span = Span { start, end: start + found(input).len() as u32 };
            let error = Diagnostic::error(span, "definitions nest too deeply").label("here");
            self.report(error.limited(&self.options.limits, Limit::Nesting, "use fewer"));
        }
        let (rest, name) = wanted(identifier(body), NAME)?;
        let end = self.position(rest);
        let name = Span { start: end - name.len() as u32, end };
        let (rest, ()) = mark(b';', "`;`")(rest)?;
        self.document.scopes[row].name = name;
        self.document.first_statement.get_or_insert(self.position(input));
        self.document.scopes[outer].add_definition(self.text, name, row);
        self.note_inner_comments(input, rest);
        Ok(rest)
    }

    /// `end ;`
    fn end_definition(&mut self, input: Input<'t>, body: Input<'t>) -> Rest<'t> {
        let (rest, ()) = mark(b';', "`;`")(body)?;
        if self.open.len() == 1 {
            let reason = Reason::Impossible(
                1,
                "there is no open `def` for this `end`",
                "remove it, or add `def NAME ;` above",
            );
            return Err(SyntaxError { at: input, reason });
        }
        self.open.pop();
        self.note_inner_comments(input, rest);
        Ok(rest)
    }

    /// Passes on an escape or an unknown statement.
    fn pass_on(&mut self, input: Input<'t>, rest: Input<'t>) {
        let span = self.span(input, rest);
        self.document.first_statement.get_or_insert(span.start);
        self.document.scopes[self.open[self.open.len() - 1]].pass_on(self.text, span);
    }

    /// Byte position at which `rest` begins.
    fn position(&self, rest: Input<'_>) -> u32 {
        (self.text.len() - rest.len()) as u32
    }

    fn span(&self, input: Input<'t>, rest: Input<'t>) -> Span {
        Span { start: self.position(input), end: self.position(rest) }
    }

    /// Records the comments between the words of a statement.
    fn note_inner_comments(&mut self, input: Input<'t>, rest: Input<'t>) {
        let text = &input[..input.len() - rest.len()];
        let mut idx = 0;
        while let Some(step) = text.get(idx..).and_then(|text| memchr::memchr2(b'{', b'"', text)) {
            let at = &input[idx + step..];
            if let Some(quoted) = at.strip_prefix(b"\"") {
                // Braces within quotes begin no comment.
                let end = memchr::memchr2(b'"', b'\n', quoted).filter(|&end| quoted[end] == b'"');
                idx += step + 1 + end.map_or(0, |end| end + 1);
                continue;
            }
            let Ok((behind, inner)) = comment(at) else { return };
            self.push_comment(inner, behind, false);
            idx = input.len() - behind.len();
        }
    }

    /// Finds a statement that begins on its own line between `input` and the error: then the error
    /// is that the statement at `input` has no end.
    fn next_statement(&self, input: Input<'t>, syntax_error: &SyntaxError<'t>) -> Option<Next<'t>> {
        let Reason::Expected(wanted) = syntax_error.reason else { return None };
        let limit = skip_blank(syntax_error.at);
        let next = self.statement_within(input, |word| word.len() >= limit.len())?;
        Some(if next.at.len() == limit.len() { Next { wanted, ..next } } else { next })
    }

    /// Finds a statement that begins on its own line behind the first word of `input`, while words
    /// are `within`.
    fn statement_within(
        &self,
        input: Input<'t>,
        within: impl Fn(Input<'t>) -> bool,
    ) -> Option<Next<'t>> {
        let mut words = Words { rest: input };
        let mut end = words.next()?.behind;
        for word in words.take_while(|word| within(word.at)) {
            if word.begins_line && self.reads_as_statement(word.at) {
                return Some(Next { at: word.at, end, wanted: "`;`" });
            }
            end = word.behind;
        }
        None
    }

    fn reads_as_statement(&self, input: Input<'t>) -> bool {
        let Ok((body, keyword)) = word(input) else { return false };
        let semicolon = |rest| mark(b';', "`;`")(rest).is_ok();
        match keyword {
            b"def" => identifier(body).is_ok_and(|(rest, _)| semicolon(rest)),
            b"end" => semicolon(body),
            _ => match read_alone(self.text, body, keyword, &mut Vec::new()) {
                Some(Ok(())) => true,
                Some(Err(error)) => {
                    // It may lack its own `;`. Before a parenthesis, however, it is part of a
                    // contour.
                    let SyntaxError { at, reason } = error.into();
                    let in_contour = matches!(skip_blank(at), [b'(' | b')', ..]);
                    reason == Reason::Expected(END)
                        && !matches!(keyword, b"cam" | b"motion")
                        && !in_contour
                }
                None => false,
            },
        }
    }

    fn report_missing_end(&mut self, statement: Input<'t>, next: &Next<'t>) {
        let place = self.position(next.end);
        let message = format!("expected {} before the next statement", next.wanted);
        let finding = Diagnostic::error(Span { start: place, end: place }, message)
            .label("it is missing here");
        self.report(with_usage(finding, statement));
    }

    fn report_syntax_error(
        &mut self,
        syntax_error: &SyntaxError<'t>,
        statement: Option<Input<'t>>,
    ) {
        let at = skip_blank(syntax_error.at);
        let start = self.position(at);
        let what = found(at);
        let span = Span { start, end: start + what.len() as u32 };
        let shown = format!("`{}`", shorten(what));
        let finding = match syntax_error.reason {
            Reason::Expected("a statement") => no_statement(what, span),
            Reason::Expected(wanted) => {
                let finding = if what.is_empty() {
                    let end = statement
                        .map_or(at, |input| Words { rest: input }.last().map_or(at, |w| w.behind));
                    let start = self.position(end);
                    let message = format!("expected {wanted}, found the end of the file");
                    Diagnostic::error(Span { start, end: start }, message)
                        .label("the text ends here")
                } else {
                    Diagnostic::error(span, format!("expected {wanted}, found {shown}"))
                        .label("here")
                };
                match (word_help(wanted, what), statement) {
                    (Some(help), _) => finding.help(help),
                    (None, Some(input)) => with_usage(finding, input),
                    (None, None) => finding,
                }
            }
            Reason::NotFinite => {
                Diagnostic::error(span, format!("the number {shown} is too large"))
                    .label("not finite")
                    .help("numbers reach up to about 1.8e308")
            }
            Reason::Unclosed(kind) => {
                let close = if kind == "comment" { '}' } else { ')' };
                Diagnostic::error(
                    Span { start, end: start + 1 },
                    format!("this {kind} is not closed"),
                )
                .label("opened here")
                .help(format!(
                    "add `{close}`; {kind}s nest, so every one opened inside needs its own"
                ))
            }
            Reason::OutOfRange(remedy) => {
                Diagnostic::here(span, format!("the number {shown} is out of range"), remedy)
            }
            Reason::Impossible(words, problem, remedy) => {
                let behind = Words { rest: at }.take(words).last().map_or(at, |word| word.behind);
                let span = Span { start, end: self.position(behind) };
                Diagnostic::here(span, problem, remedy)
            }
        };
        self.report(finding);
    }

    fn report(&mut self, error: Diagnostic) {
        self.findings.push(error);
        self.error_count += 1;
    }

    fn check_all_closed(&mut self) {
        let Some(&row) = self.open.last() else { return };
        // After an error, an `end` may have been skipped.
        if self.open.len() == 1 || self.error_count > 0 {
            return;
        }
        if let Some((statement, next)) = self.swallowed_end(row) {
            return self.report_missing_end(statement, &next);
        }
        let name = self.document.scopes[row].name;
        let shown = shorten(name.of(self.text));
        self.report(
            Diagnostic::error(name, format!("definition `{shown}` is not closed"))
                .label("begins here")
                .help("add `end ;` behind its last statement"),
        );
    }

    /// A statement without `;` may have parsed the `end` on the next line as the name of a colour.
    fn swallowed_end(&self, row: usize) -> Option<(Input<'t>, Next<'t>)> {
        self.document.scopes[row].statements(self.text).into_iter().find_map(|span| {
            let statement = &self.text[span.start as usize..];
            let is_within = |word: Input<'t>| self.position(word) < span.end;
            let next = self.statement_within(statement, is_within)?;
            next.at.starts_with(b"end").then_some((statement, next))
        })
    }
}

/// Parses a statement into a scope of its own.
fn read_alone<'t>(
    text: &'t [u8],
    rest: Input<'t>,
    keyword: Input<'t>,
    names: &mut Vec<(NameKind, Span)>,
) -> Option<Outcome<'t>> {
    let (scope, requests) = (&mut Scope::default(), &mut Vec::new());
    let read = statement(keyword)?.read?;
    Some(read(&mut Grammar { text, start: 0, rest, scope, names, requests }))
}

/// The names in the statement at `span`, which has no syntax errors, in the order of the text.
pub(crate) fn names_in(text: &[u8], span: Span) -> Vec<(NameKind, Span)> {
    let mut names = Vec::new();
    if let Ok((body, keyword)) = word(&text[span.start as usize..]) {
        let _ = read_alone(text, body, keyword, &mut names);
    }
    names
}

/// Skips white space and comments, except an unclosed comment.
fn skip_blank(input: Input<'_>) -> Input<'_> {
    blank(input).map_or(input, |(rest, ())| rest)
}

/// A missing end of a statement: another one begins on the next line.
struct Next<'t> {
    /// The next statement.
    at: Input<'t>,
    /// The end of the last word before it.
    end: Input<'t>,
    /// The expected input there.
    wanted: &'static str,
}

/// Iterates over the words and punctuation marks of a text, without comments.
struct Words<'t> {
    rest: Input<'t>,
}

struct Word<'t> {
    begins_line: bool,
    at: Input<'t>,
    behind: Input<'t>,
}

impl<'t> Iterator for Words<'t> {
    type Item = Word<'t>;

    fn next(&mut self) -> Option<Word<'t>> {
        let at = skip_blank(self.rest);
        if at.is_empty() {
            return None;
        }
        let begins_line = self.rest[..self.rest.len() - at.len()].contains(&b'\n');
        let behind = &at[found(at).len()..];
        self.rest = behind;
        Some(Word { begins_line, at, behind })
    }
}
