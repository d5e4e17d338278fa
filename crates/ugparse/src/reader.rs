//! Text to [`Document`]: statement after statement, with recovery at the next `;`.

use nom::Err;

use crate::diagnostic::{Diagnostic, MAX_ERRORS};
use crate::document::{CommentSpan, Document, Group, Node, Statement};
use crate::grammar::{Grammar, KEYWORDS};
use crate::source::Span;
use crate::token::{Input, Reason, Trouble, blank, comment, escape, found, identifier, mark, word};

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
}

impl<'t> Reader<'t, '_> {
    fn run(&mut self) {
        let mut input: Input<'t> = self.grammar.text;
        while self.findings.len() < MAX_ERRORS {
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

    /// Reads one statement; gives what is behind it, or behind the next `;` after an error.
    fn statement(&mut self, input: Input<'t>) -> Input<'t> {
        match self.try_statement(input) {
            Ok(rest) => {
                self.note_inner_comments(input, rest);
                self.line_has_statement = true;
                rest
            }
            Err(trouble) => {
                self.complain(&trouble, Some(input));
                skip_statement(trouble.at)
            }
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
            if !self.lax {
                return Err(Trouble { at: input, reason: Reason::Expected("a statement") });
            }
            let rest = skip_statement(body);
            let start = self.grammar.position(input);
            let span = Span { start, end: start + keyword.len() as u32 };
            let name = String::from_utf8_lossy(keyword);
            self.findings.push(Diagnostic::warning(span, format!("statement `{name}` is passed on unread")));
            self.push(input, rest, Statement::Unknown);
            return Ok(rest);
        };
        let (rest, statement) = parsed.map_err(trouble)?;
        let (rest, ()) = mark(b';', "`;`")(rest).map_err(trouble)?;
        self.push(input, rest, statement);
        Ok(rest)
    }

    /// `def ID ;`
    fn begin_definition(&mut self, input: Input<'t>, body: Input<'t>) -> Result<Input<'t>, Trouble<'t>> {
        if self.open.len() > MAX_NESTING {
            let reason = Reason::Range("definitions nest too deeply", "the limit is 64 levels");
            return Err(Trouble { at: input, reason });
        }
        let (rest, name) = identifier(body).map_err(trouble)?;
        let end = self.grammar.position(rest);
        let name = Span { start: end - name.len() as u32, end };
        let (rest, ()) = mark(b';', "`;`")(rest).map_err(trouble)?;
        let row = self.document.groups.len();
        self.push(input, rest, Statement::Definition(row));
        self.document.groups.push(Group { name, parent: self.open.last().copied(), statements: Vec::new() });
        self.open.push(row);
        Ok(rest)
    }

    /// `end ;`
    fn end_definition(&mut self, input: Input<'t>, body: Input<'t>) -> Result<Input<'t>, Trouble<'t>> {
        let (rest, ()) = mark(b';', "`;`")(body).map_err(trouble)?;
        if self.open.len() == 1 {
            let reason = Reason::Range(
                "there is no open `def` for this `end`",
                "remove it, or add `def NAME ;` above",
            );
            return Err(Trouble { at: input, reason });
        }
        self.open.pop();
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
        // An escape is no place for comments: its braces are plain text.
        if text.first() == Some(&b'(') {
            return;
        }
        let mut idx = 0;
        while let Some(step) = memchr::memchr(b'{', &text[idx..]) {
            let at = &input[idx + step..];
            let Ok((behind, inner)) = comment(at) else { return };
            self.push_comment(inner, behind, false);
            idx = input.len() - behind.len();
        }
    }

    fn complain(&mut self, trouble: &Trouble<'t>, statement: Option<Input<'t>>) {
        let at = blank(trouble.at).map_or(trouble.at, |(rest, ())| rest);
        let start = self.grammar.position(at);
        let what = found(at);
        let span = Span { start, end: start + what.len() as u32 };
        let shown = match what {
            [] => "the end of the file".to_string(),
            word => format!("`{}`", shorten(word)),
        };
        let finding = match trouble.reason {
            Reason::Expected("a statement") => Diagnostic::error(span, format!("{shown} is no statement"))
                .label("unknown statement")
                .help(format!(
                    "a statement begins with one of {KEYWORDS}, or `(` for an escape; -lax passes unknown ones on"
                )),
            Reason::Expected(wanted) => {
                let finding =
                    Diagnostic::error(span, format!("expected {wanted}, found {shown}")).label("here");
                let keyword = statement.and_then(|input| word(input).ok()).map(|(_, keyword)| keyword);
                match keyword.and_then(usage) {
                    Some(usage) => finding.help(format!("the form is `{usage}`")),
                    None => finding,
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
            Reason::Range(problem, remedy) => Diagnostic::error(span, problem).label("here").help(remedy),
        };
        self.findings.push(finding);
    }

    fn check_all_closed(&mut self) {
        let has_errors =
            self.findings.iter().any(|finding| finding.severity == crate::diagnostic::Severity::Error);
        let Some(&row) = self.open.last() else { return };
        if self.open.len() > 1 && !has_errors {
            let group = &self.document.groups[row];
            let name = String::from_utf8_lossy(group.name.of(self.grammar.text));
            self.findings.push(
                Diagnostic::error(group.name, format!("definition `{name}` is not closed"))
                    .label("begins here")
                    .help("add `end ;` behind its last statement"),
            );
        }
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
fn skip_statement(mut input: Input<'_>) -> Input<'_> {
    loop {
        match memchr::memchr2(b';', b'{', input) {
            None => return &[],
            Some(idx) if input[idx] == b';' => return &input[idx + 1..],
            Some(idx) => match comment(&input[idx..]) {
                Ok((rest, _)) => input = rest,
                Err(_) => return &[],
            },
        }
    }
}

/// A word for a message: at most 40 characters, control characters blanked.
fn shorten(word: &[u8]) -> String {
    let text = String::from_utf8_lossy(word);
    let clean = |c: char| if c.is_control() { '?' } else { c };
    let mut short: String = text.chars().take(40).map(clean).collect();
    if short.len() < text.len() {
        short.push('…');
    }
    short
}

/// The form of a statement, for messages.
fn usage(keyword: &[u8]) -> Option<&'static str> {
    Some(match keyword {
        b"v" => "v ID x y z [color] [nx ny nz] ;",
        b"w" => "w [ID] (vertices) … [color] [< vx vy vz >] ;",
        b"f" => "f [ID] (vertices) … [color] [illum] [< vx vy vz >] ;",
        b"c" => "c [ID] lightness [hue [saturation [translucency]]] ;",
        b"c_rgb" => "c_rgb [ID] red green blue [translucency] ;",
        b"l" => "l [ID] intensity [x y z [radius]] [color] [< vx vy vz >] ;",
        b"cam" => "cam [ID] [-ep x y z] [-vc x y z] [-ud x y z] [-va a b] … ;",
        b"def" => "def ID ; … end ;",
        b"end" => "end ;",
        b"i" => "i [ID] (def [color] [-tx …]) [< vx vy vz >] ;",
        b"a" => "a [ID] (def [color] [-tx …]) size [-tx …] [< vx vy vz >] ;",
        _ => return None,
    })
}
