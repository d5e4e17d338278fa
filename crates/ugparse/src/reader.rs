//! Text to [`Document`]: statement after statement, with recovery at the next `;`.

use nom::Err;

use crate::diagnostic::{Diagnostic, MAX_ERRORS};
use crate::document::{CommentSpan, Document, Group, Node, Statement};
use crate::grammar::{Grammar, NAME};
use crate::source::Span;
use crate::token::{Input, Reason, Trouble, blank, comment, escape, found, identifier, mark, wanted, word};
use crate::wording::{no_statement, shorten, with_usage, word_help};

/// How deep definitions may nest.
const MAX_NESTING: usize = 64;

/// Reads the whole text. Errors go to `findings`; reading goes on behind them
/// until there are too many.
pub(crate) fn read(text: &[u8], lax: bool, findings: &mut Vec<Diagnostic>) -> Document {
    let mut reader = Reader {
        grammar: Grammar { text },
        document: Document { groups: vec![Group::default()], ..Document::default() },
        open: vec![0],
        lax,
        line_has_statement: false,
        findings,
        error_count: 0,
    };
    reader.run();
    reader.document
}

struct Reader<'t, 'f> {
    grammar: Grammar<'t>,
    document: Document,
    /// The groups being read, from the file inwards.
    open: Vec<usize>,
    lax: bool,
    /// A statement has ended on the line we are on.
    line_has_statement: bool,
    findings: &'f mut Vec<Diagnostic>,
    error_count: usize,
}

impl<'t> Reader<'t, '_> {
    fn run(&mut self) {
        let mut input: Input<'t> = self.grammar.text;
        while self.error_count < MAX_ERRORS {
            match self.between(input) {
                Ok([]) => break,
                Ok(rest) => input = self.statement(rest),
                Err(trouble) => {
                    self.complain(&trouble, None);
                    break;
                }
            }
        }
        self.check_all_closed();
    }

    /// Skips white space and notes comments up to the next statement.
    fn between(&mut self, mut input: Input<'t>) -> Result<Input<'t>, Trouble<'t>> {
        loop {
            match input.first() {
                Some(b'\n') => {
                    self.line_has_statement = false;
                    input = &input[1..];
                }
                Some(b'{') => {
                    let (rest, text) = comment(input).map_err(trouble)?;
                    self.push_comment(text, rest, self.line_has_statement);
                    input = rest;
                }
                Some(b) if b.is_ascii_whitespace() || *b == 0x0B => input = &input[1..],
                _ => return Ok(input),
            }
        }
    }

    fn push_comment(&mut self, text: Input<'t>, rest: Input<'t>, trailing: bool) {
        let end = self.grammar.position(rest) - 1;
        let text = Span { start: end - text.len() as u32, end };
        self.document.comments.push(CommentSpan { text, trailing });
    }

    /// Reads one statement; gives what is behind it, or where to go on after an error.
    fn statement(&mut self, input: Input<'t>) -> Input<'t> {
        match self.try_statement(input) {
            Ok(rest) => {
                self.line_has_statement = true;
                rest
            }
            Err(trouble) => match self.next_statement(input, &trouble) {
                Some(next) => {
                    self.complain_about_end(input, &next);
                    next.at
                }
                None => {
                    self.complain(&trouble, Some(input));
                    skip_statement(trouble.at).unwrap_or(&[])
                }
            },
        }
    }

    fn try_statement(&mut self, input: Input<'t>) -> Result<Input<'t>, Trouble<'t>> {
        if let Some(rest) = input.strip_prefix(b";") {
            return Ok(rest);
        }
        if input.first() == Some(&b'(') {
            let (rest, text) = escape(input).map_err(trouble)?;
            let end = self.grammar.position(rest) - 1;
            let text = Span { start: end - text.len() as u32, end };
            self.push(input, rest, Statement::Escape(text));
            return Ok(rest);
        }
        let (body, keyword) =
            word(input).map_err(|_| Trouble { at: input, reason: Reason::Expected("a statement") })?;
        match keyword {
            b"def" => self.begin_definition(input, body),
            b"end" => self.end_definition(input, body),
            _ => self.plain_statement(input, keyword, body),
        }
    }

    fn plain_statement(
        &mut self,
        input: Input<'t>,
        keyword: Input<'t>,
        body: Input<'t>,
    ) -> Result<Input<'t>, Trouble<'t>> {
        let Some(parsed) = self.grammar.statement(keyword, body, &mut self.document) else {
            return self.unknown_statement(input, keyword, body);
        };
        let (rest, statement) = parsed.map_err(trouble)?;
        let (rest, ()) = mark(b';', "`;`")(rest).map_err(trouble)?;
        self.push(input, rest, statement);
        self.note_inner_comments(input, rest);
        Ok(rest)
    }

    /// A statement that is not ours is passed on with all that is in it, or refused.
    fn unknown_statement(
        &mut self,
        input: Input<'t>,
        keyword: Input<'t>,
        body: Input<'t>,
    ) -> Result<Input<'t>, Trouble<'t>> {
        if !self.lax {
            return Err(Trouble { at: input, reason: Reason::Expected("a statement") });
        }
        let rest = match keyword {
            // A line of the C preprocessor ends with the line.
            b"#" | b"#line" => &body[memchr::memchr(b'\n', body).unwrap_or(body.len())..],
            _ => skip_statement(body)?,
        };
        let start = self.grammar.position(input);
        let span = Span { start, end: start + keyword.len() as u32 };
        let name = shorten(keyword);
        self.findings.push(
            Diagnostic::warning(span, format!("statement `{name}` is passed on unread"))
                .label("not known here")
                .help("remove it if no later program reads it"),
        );
        self.push(input, rest, Statement::Unknown);
        Ok(rest)
    }

    /// `def ID ;`
    ///
    /// Opens a group even if something is wrong with the line, so that the
    /// `end` of the definition has its `def`.
    fn begin_definition(&mut self, input: Input<'t>, body: Input<'t>) -> Result<Input<'t>, Trouble<'t>> {
        let row = self.document.groups.len();
        let group = Group { parent: self.open.last().copied(), ..Group::default() };
        self.document.groups.push(group);
        self.open.push(row);
        if self.open.len() == MAX_NESTING + 2 {
            let reason = Reason::Impossible(1, "definitions nest too deeply", "the limit is 64 levels");
            self.complain(&Trouble { at: input, reason }, None);
        }
        let (rest, name) = wanted(identifier(body), NAME).map_err(trouble)?;
        let end = self.grammar.position(rest);
        let name = Span { start: end - name.len() as u32, end };
        let (rest, ()) = mark(b';', "`;`")(rest).map_err(trouble)?;
        self.document.groups[row].name = name;
        let span = Span { start: self.grammar.position(input), end: self.grammar.position(rest) };
        let outer = self.open[self.open.len() - 2];
        self.document.groups[outer].statements.push(Node { span, statement: Statement::Definition(row) });
        self.note_inner_comments(input, rest);
        Ok(rest)
    }

    /// `end ;`
    fn end_definition(&mut self, input: Input<'t>, body: Input<'t>) -> Result<Input<'t>, Trouble<'t>> {
        let (rest, ()) = mark(b';', "`;`")(body).map_err(trouble)?;
        if self.open.len() == 1 {
            let reason = Reason::Impossible(
                1,
                "there is no open `def` for this `end`",
                "remove it, or add `def NAME ;` above",
            );
            return Err(Trouble { at: input, reason });
        }
        self.open.pop();
        self.note_inner_comments(input, rest);
        Ok(rest)
    }

    fn push(&mut self, input: Input<'t>, rest: Input<'t>, statement: Statement) {
        let span = Span { start: self.grammar.position(input), end: self.grammar.position(rest) };
        let row = self.open.last().copied().unwrap_or(0);
        self.document.groups[row].statements.push(Node { span, statement });
    }

    /// Comments between the words of a statement come behind those above it.
    fn note_inner_comments(&mut self, input: Input<'t>, rest: Input<'t>) {
        let text = &input[..input.len() - rest.len()];
        let mut idx = 0;
        while let Some(step) = memchr::memchr(b'{', &text[idx..]) {
            let at = &input[idx + step..];
            let Ok((behind, inner)) = comment(at) else { return };
            self.push_comment(inner, behind, false);
            idx = input.len() - behind.len();
        }
    }

    /// The statement that begins on a line of its own between `input` and the
    /// trouble: then what is wrong is that the one at `input` has no end.
    fn next_statement(&self, input: Input<'t>, trouble: &Trouble<'t>) -> Option<Next<'t>> {
        let Reason::Expected(wanted) = trouble.reason else { return None };
        let limit = skip_blank(trouble.at);
        let mut words = Words { rest: input };
        let mut end = words.next()?.behind;
        for word in words {
            if word.at.len() < limit.len() {
                return None;
            }
            if word.begins_line && self.reads_as_statement(word.at) {
                let wanted = if word.at.len() == limit.len() { wanted } else { "`;`" };
                return Some(Next { at: word.at, end, wanted });
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
            _ => match self.grammar.statement(keyword, body, &mut Document::default()) {
                // It may lack its own `;`. Before a parenthesis it is rather a part of a contour.
                Some(Ok((rest, _))) => {
                    let in_contour = matches!(skip_blank(rest), [b'(' | b')', ..]);
                    semicolon(rest) || (keyword != b"cam" && !in_contour)
                }
                _ => false,
            },
        }
    }

    fn complain_about_end(&mut self, statement: Input<'t>, next: &Next<'t>) {
        let place = self.grammar.position(next.end);
        let message = format!("expected {} before the next statement", next.wanted);
        let finding =
            Diagnostic::error(Span { start: place, end: place }, message).label("it is missing here");
        self.report(with_usage(finding, statement));
    }

    fn complain(&mut self, trouble: &Trouble<'t>, statement: Option<Input<'t>>) {
        let at = skip_blank(trouble.at);
        let start = self.grammar.position(at);
        let what = found(at);
        let span = Span { start, end: start + what.len() as u32 };
        let shown = format!("`{}`", shorten(what));
        let finding = match trouble.reason {
            Reason::Expected("a statement") => no_statement(what, span),
            Reason::Expected(wanted) => {
                let finding = if what.is_empty() {
                    let end =
                        statement.map_or(at, |input| Words { rest: input }.last().map_or(at, |w| w.behind));
                    let start = self.grammar.position(end);
                    let message = format!("expected {wanted}, found the end of the file");
                    Diagnostic::error(Span { start, end: start }, message).label("the text ends here")
                } else {
                    Diagnostic::error(span, format!("expected {wanted}, found {shown}")).label("here")
                };
                match (word_help(wanted, what), statement) {
                    (Some(help), _) => finding.help(help),
                    (None, Some(input)) => with_usage(finding, input),
                    (None, None) => finding,
                }
            }
            Reason::NotFinite => Diagnostic::error(span, format!("the number {shown} is too large"))
                .label("not finite")
                .help("numbers reach up to about 1.8e308"),
            Reason::Unclosed(kind) => {
                let close = if kind == "comment" { '}' } else { ')' };
                Diagnostic::error(Span { start, end: start + 1 }, format!("this {kind} is not closed"))
                    .label("opened here")
                    .help(format!("add `{close}`; {kind}s nest, so every one opened inside needs its own"))
            }
            Reason::OutOfRange(remedy) => {
                Diagnostic::error(span, format!("the number {shown} is out of range"))
                    .label("here")
                    .help(remedy)
            }
            Reason::Impossible(words, problem, remedy) => {
                let behind = Words { rest: at }.take(words).last().map_or(at, |word| word.behind);
                let span = Span { start, end: self.grammar.position(behind) };
                Diagnostic::error(span, problem).label("here").help(remedy)
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
        // Behind an error, an `end` may have been skipped.
        if self.open.len() == 1 || self.error_count > 0 {
            return;
        }
        if let Some((statement, next)) = self.swallowed_end(row) {
            return self.complain_about_end(statement, &next);
        }
        let name = self.document.groups[row].name;
        let shown = shorten(name.of(self.grammar.text));
        self.report(
            Diagnostic::error(name, format!("definition `{shown}` is not closed"))
                .label("begins here")
                .help("add `end ;` behind its last statement"),
        );
    }

    /// A statement without `;` takes the `end` of the next line for the name of a colour.
    fn swallowed_end(&self, row: usize) -> Option<(Input<'t>, Next<'t>)> {
        self.document.groups[row].statements.iter().find_map(|node| {
            let statement = &self.grammar.text[node.span.start as usize..];
            let mut words = Words { rest: statement };
            let mut end = words.next()?.behind;
            for word in words.take_while(|word| self.grammar.position(word.at) < node.span.end) {
                if word.begins_line && word.at.starts_with(b"end") && self.reads_as_statement(word.at) {
                    return Some((statement, Next { at: word.at, end, wanted: "`;`" }));
                }
                end = word.behind;
            }
            None
        })
    }
}

/// The trouble of a parser; our parsers read whole texts, so nothing is ever incomplete.
fn trouble(err: Err<Trouble<'_>>) -> Trouble<'_> {
    match err {
        Err::Error(trouble) | Err::Failure(trouble) => trouble,
        Err::Incomplete(_) => Trouble { at: &[], reason: Reason::Expected("more text") },
    }
}

/// What is behind the next `;` outside comments.
fn skip_statement(mut input: Input<'_>) -> Result<Input<'_>, Trouble<'_>> {
    loop {
        match memchr::memchr2(b';', b'{', input) {
            None => return Err(Trouble { at: &[], reason: Reason::Expected("`;`") }),
            Some(idx) if input[idx] == b';' => return Ok(&input[idx + 1..]),
            Some(idx) => input = comment(&input[idx..]).map_err(trouble)?.0,
        }
    }
}

/// What is behind white space and comments; an unclosed comment stays.
fn skip_blank(input: Input<'_>) -> Input<'_> {
    blank(input).map_or(input, |(rest, ())| rest)
}

/// Where a statement should have ended: another one begins on the next line.
struct Next<'t> {
    /// The next statement.
    at: Input<'t>,
    /// Behind the last word before it.
    end: Input<'t>,
    /// What should have stood there.
    wanted: &'static str,
}

/// The words and punctuation marks of a text, comments left out.
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
