//! Formats the text of a scene without flattening, omitting or reordering anything.
//!
//! The formatter works on the text itself, token by token, and so keeps what the parser does not:
//! the order of statements and the comments within them.

use crate::diagnostics::Diagnostics;
use crate::number_text::push_number;
use crate::reader;
use crate::source::Source;
use crate::statements::statement;
use crate::token::{
    Input, comment, escape, found, integer, is_blank, line_end, number, skip_statement, word,
};
use crate::{Options, check_length, refuse_errors, stage_statement};

/// Indentation per enclosing scope.
const INDENT: &str = "  ";

/// Formats a scene: one statement per line, definitions indented, one blank between words, numbers
/// as short as possible.
///
/// - Statements keep their order, comments their places: on their own line, after a statement, or
///   within it. The text of comments, escapes, unknown statements and file names does not change.
/// - Several empty lines between statements become one.
/// - Empty statements (a second `;`) are removed.
/// - Included files are not read and names not resolved, so a part of a scene can be formatted by
///   itself.
///
/// `tidy` is idempotent and does not change the scene. A comment after several statements on one
/// line moves with the last of them.
///
/// ```
/// let source = ugparse::Source::new("tile.ug", "def tile; v a 0 0.50 +1; {corner} end ;i(tile -tx 1e0);");
/// let text = ugparse::tidy(&source, &ugparse::Options::default())?;
/// assert_eq!(
///     String::from_utf8_lossy(&text),
///     "def tile;\n  v a 0 0.5 1; {corner}\nend;\ni (tile -tx 1);\n"
/// );
/// # Ok::<(), ugparse::Diagnostics>(())
/// ```
///
/// # Errors
/// Syntax errors.
pub fn tidy(source: &Source, options: &Options) -> Result<Vec<u8>, Diagnostics> {
    check_length(source, options)?;
    let mut findings = Vec::new();
    let mut document = reader::read(&source.text, options, &mut findings);
    stage_statement::take(&source.text, &mut document, &mut findings);
    refuse_errors(source, &mut findings)?;
    let mut layout = Layout { out: Vec::with_capacity(source.text.len()), ..Layout::default() };
    layout.text(&source.text);
    Ok(layout.out)
}

#[derive(Default)]
struct Layout {
    out: Vec<u8>,
    /// Number of open definitions.
    depth: usize,
    /// Line ends since the last statement or comment.
    n_line_ends: usize,
    numbers: zmij::Buffer,
}

impl Layout {
    /// Formats a text without syntax errors.
    fn text(&mut self, text: &[u8]) {
        let mut input = text;
        while let Some(&byte) = input.first() {
            input = match byte {
                b'\n' | b'\r' => {
                    self.n_line_ends += 1;
                    input.strip_prefix(b"\r\n").unwrap_or(&input[1..])
                }
                byte if is_blank(byte) || byte == b';' => &input[1..],
                b'{' => {
                    let rest = comment(input).map_or(&input[..0], |(rest, _)| rest);
                    self.comment(taken(input, rest));
                    rest
                }
                _ => self.statement(input),
            };
        }
        if !self.out.is_empty() {
            self.out.push(b'\n');
        }
    }

    /// Writes a comment between statements; it stays on its line.
    fn comment(&mut self, text: &[u8]) {
        if self.n_line_ends == 0 && !self.out.is_empty() {
            self.out.push(b' ');
        } else {
            self.begin_line();
        }
        self.verbatim(text);
    }

    /// Formats one statement and returns the input after it.
    fn statement<'t>(&mut self, input: Input<'t>) -> Input<'t> {
        if input.first() == Some(&b'(') {
            let rest = escape(input).map_or(&input[..0], |(rest, _)| rest);
            self.begin_line();
            match taken(input, rest) {
                text if stage_statement::is_stage(text) => self.stage(text),
                text => self.verbatim(text),
            }
            return rest;
        }
        let (body, keyword) = word(input).unwrap_or((&input[..0], input));
        if keyword == b"end" {
            self.depth = self.depth.saturating_sub(1);
        }
        self.begin_line();
        if statement(keyword).is_some() {
            let rest = self.words(input, keyword);
            self.depth += usize::from(keyword == b"def");
            return rest;
        }
        let rest = match keyword {
            // A preprocessor directive ends with its line.
            b"#" | b"#line" => &body[line_end(body)..],
            _ => skip_statement(body).unwrap_or_default(),
        };
        self.verbatim(taken(input, rest));
        rest
    }

    fn begin_line(&mut self) {
        if !self.out.is_empty() {
            self.out.push(b'\n');
            if self.n_line_ends > 1 {
                self.out.push(b'\n');
            }
        }
        self.out.extend_from_slice(INDENT.repeat(self.depth).as_bytes());
    }

    fn verbatim(&mut self, text: &[u8]) {
        self.out.extend_from_slice(text);
        self.n_line_ends = 0;
    }

    /// A stage statement, parentheses included, which holds words and numbers only.
    fn stage(&mut self, text: &[u8]) {
        let words =
            text[1..text.len() - 1].split(|&byte| is_blank(byte)).filter(|word| !word.is_empty());
        let mut mark = b'(';
        for text in words {
            self.out.push(mark);
            mark = b' ';
            self.word(text, b"");
        }
        self.verbatim(b")");
    }

    /// Writes the words of a statement up to its `;`, with one blank between them but none after an
    /// opening or before a closing bracket; returns the input after it.
    fn words<'t>(&mut self, mut input: Input<'t>, keyword: &[u8]) -> Input<'t> {
        let mut is_open = true;
        let mut names_file = matches!(keyword, b"include" | b"execute");
        let mut n_words = 0;
        loop {
            let n_blanks = input.iter().take_while(|&&byte| is_blank(byte)).count();
            input = &input[n_blanks..];
            let Some(&byte) = input.first() else { return input };
            if !is_open && !matches!(byte, b')' | b'>' | b';') {
                self.out.push(b' ');
            }
            is_open = matches!(byte, b'(' | b'<');
            let rest = behind_word(input);
            let text = taken(input, rest);
            if names_file && byte != b'(' {
                self.verbatim(text);
            } else {
                self.word(text, keyword);
            }
            names_file = match keyword {
                b"include" | b"execute" => true,
                // The file follows the keyword and a name.
                b"c_tex" if byte != b'{' => {
                    n_words += 1;
                    n_words == 2
                }
                b"c_tex" => names_file,
                b"sky" => text == b"sky" || names_file && byte == b'{',
                _ => keyword == b"motion" && (text == b"-path" || names_file && byte == b'{'),
            };
            input = rest;
            if byte == b';' {
                return input;
            }
        }
    }

    /// Writes one word, comment or punctuation mark of a statement.
    fn word(&mut self, text: &[u8], keyword: &[u8]) {
        if keyword == b"a" && matches!(integer(text), Ok(([], _))) {
            // The size of an array is an integer with any number of digits.
            let zeros = text.iter().take_while(|&&digit| digit == b'0').count();
            self.verbatim(&text[zeros.min(text.len() - 1)..]);
        } else if let Ok(([], value)) = number(text) {
            push_number(&mut self.out, &mut self.numbers, value);
        } else {
            self.verbatim(text);
        }
    }
}

/// The input after its first comment, quoted file name, word or punctuation mark.
fn behind_word(input: Input<'_>) -> Input<'_> {
    match input {
        [b'{', ..] => comment(input).map_or(&input[..0], |(rest, _)| rest),
        [b'"', quoted @ ..] => {
            &quoted[memchr::memchr(b'"', quoted).map_or(quoted.len(), |end| end + 1)..]
        }
        _ => &input[found(input).len()..],
    }
}

/// The part of `input` before `rest`.
fn taken<'t>(input: Input<'t>, rest: Input<'_>) -> Input<'t> {
    &input[..input.len() - rest.len()]
}
