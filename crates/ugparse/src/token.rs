//! Tokens of the language, as nom parsers over bytes.
//!
//! No position is counted: it follows from the length of the remaining input.

use glam::DVec3;
use memchr::memchr2;
use nom::Err;

/// The remaining input.
pub(crate) type Input<'a> = &'a [u8];

/// Result of a parser of this crate.
pub(crate) type Parsed<'a, T> = nom::IResult<Input<'a>, T, SyntaxError<'a>>;

/// A syntax error and its position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SyntaxError<'a> {
    pub at: Input<'a>,
    pub reason: Reason,
}

/// The kind of a syntax error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Reason {
    /// The named token was expected.
    Expected(&'static str),
    /// The number has no finite value.
    NotFinite,
    /// A comment or escape is not closed; `at` is its first byte.
    Unclosed(&'static str),
    /// The number is outside the allowed range, which the text states.
    OutOfRange(&'static str),
    /// A given number of words are syntactically valid but impossible: message and remedy.
    Impossible(usize, &'static str, &'static str),
}

impl<'a> From<Err<Self>> for SyntaxError<'a> {
    /// The parsers have the whole text, so input is never incomplete.
    fn from(error: Err<Self>) -> Self {
        match error {
            Err::Error(syntax_error) | Err::Failure(syntax_error) => syntax_error,
            Err::Incomplete(_) => Self { at: &[], reason: Reason::Expected("more text") },
        }
    }
}

/// Recoverable failure: another parser may match.
pub(crate) fn backtrack<T>(at: Input<'_>, reason: Reason) -> Parsed<'_, T> {
    Err(Err::Error(SyntaxError { at, reason }))
}

/// Final failure.
pub(crate) fn fail<T>(at: Input<'_>, reason: Reason) -> Parsed<'_, T> {
    Err(Err::Failure(SyntaxError { at, reason }))
}

/// Makes a recoverable failure final.
pub(crate) fn require<'a, T>(result: Parsed<'a, T>) -> Parsed<'a, T> {
    result.map_err(|err| match err {
        Err::Error(syntax_error) => Err::Failure(syntax_error),
        other => other,
    })
}

/// Replaces what the error message says was expected.
pub(crate) fn wanted<'a, T>(result: Parsed<'a, T>, what: &'static str) -> Parsed<'a, T> {
    result.map_err(|err| match err {
        Err::Error(SyntaxError { at, .. }) => {
            Err::Error(SyntaxError { at, reason: Reason::Expected(what) })
        }
        other => other,
    })
}

/// Character classes, as bits.
const BLANK: u8 = 1;
const ENDS_WORD: u8 = 2;
const ID_START: u8 = 4;
const ID: u8 = 8;

/// The classes of every byte: one look-up instead of several comparisons.
static CLASS: [u8; 256] = {
    let mut class = [0; 256];
    let mut idx = 0;
    while idx < 256 {
        let byte = idx as u8;
        let blank = byte.is_ascii_whitespace() || byte == 0x0B;
        let punctuation = matches!(byte, b'(' | b')' | b';' | b'<' | b'>' | b'{' | b'}' | b'"');
        let id_start = byte.is_ascii_alphabetic() || matches!(byte, b':' | b'_' | b'#');
        if blank {
            class[idx] |= BLANK;
        }
        if blank || punctuation {
            class[idx] |= ENDS_WORD;
        }
        if id_start {
            class[idx] |= ID_START;
        }
        if id_start || byte.is_ascii_digit() {
            class[idx] |= ID;
        }
        idx += 1;
    }
    class
};

fn is(byte: u8, bits: u8) -> bool {
    CLASS[byte as usize] & bits != 0
}

/// True for bytes that end a word.
pub(crate) fn ends_word(byte: u8) -> bool {
    is(byte, ENDS_WORD)
}

/// True for bytes that a name may contain.
pub(crate) fn is_identifier(byte: u8) -> bool {
    is(byte, ID)
}

pub(crate) fn begins_identifier(byte: u8) -> bool {
    is(byte, ID_START)
}

pub(crate) fn is_blank(byte: u8) -> bool {
    is(byte, BLANK)
}

/// The text after the mark that editors put before UTF-8, or after Control-Z, which ends texts of
/// DOS.
#[cold]
pub(crate) fn without_mark(input: Input<'_>) -> Option<Input<'_>> {
    let ends = |rest: &Input<'_>| rest.trim_ascii_start().is_empty();
    input.strip_prefix(b"\xef\xbb\xbf").or_else(|| input.strip_prefix(b"\x1a").filter(ends))
}

/// Skips white space and comments. Inlined, because every token begins with it: as a function
/// call it takes one percent of the instructions of reading.
#[inline(always)]
pub(crate) fn blank(mut input: Input<'_>) -> Parsed<'_, ()> {
    loop {
        match input.first() {
            Some(&byte) if is_blank(byte) => input = &input[1..],
            Some(b'{') => input = comment(input)?.0,
            Some(0xef | 0x1a) if let Some(rest) = without_mark(input) => input = rest,
            _ => return Ok((input, ())),
        }
    }
}

/// The length of a line that LF, CRLF or CR ends, without these.
pub(crate) fn line_end(input: Input<'_>) -> usize {
    memchr2(b'\n', b'\r', input).unwrap_or(input.len())
}

/// A comment, possibly nested; returns the text between its outer braces.
pub(crate) fn comment(input: Input<'_>) -> Parsed<'_, Input<'_>> {
    nested(input, b'{', b'}', "comment")
}

/// An escape, possibly nested; returns the text between its outer parentheses.
pub(crate) fn escape(input: Input<'_>) -> Parsed<'_, Input<'_>> {
    nested(input, b'(', b')', "escape")
}

fn nested<'a>(input: Input<'a>, open: u8, close: u8, what: &'static str) -> Parsed<'a, Input<'a>> {
    if input.first() != Some(&open) {
        return backtrack(input, Reason::Expected(what));
    }
    let mut depth = 0usize;
    let mut idx = 0;
    while let Some(step) = memchr2(open, close, &input[idx..]) {
        idx += step + 1;
        if input[idx - 1] == open {
            depth += 1;
        } else {
            depth -= 1;
        }
        if depth == 0 {
            return Ok((&input[idx..], &input[1..idx - 1]));
        }
    }
    fail(input, Reason::Unclosed(what))
}

/// A word: a run of bytes that are neither blank nor punctuation.
pub(crate) fn word(input: Input<'_>) -> Parsed<'_, Input<'_>> {
    let (input, ()) = blank(input)?;
    let len = word_len(input);
    if len == 0 {
        return backtrack(input, Reason::Expected("a word"));
    }
    Ok((&input[len..], &input[..len]))
}

fn word_len(input: Input<'_>) -> usize {
    input.iter().position(|&byte| ends_word(byte)).unwrap_or(input.len())
}

/// The next token for messages: a word, a punctuation mark, or nothing at the end.
pub(crate) fn found(input: Input<'_>) -> Input<'_> {
    &input[..word_len(input).max(1).min(input.len())]
}

/// Description of names, for messages.
pub(crate) const NAME_LETTERS: &str = "a name of letters, digits, `:`, `_` and `#`";

/// An identifier: letters, digits, `:`, `_`, `#`, not starting with a digit.
pub(crate) fn identifier(input: Input<'_>) -> Parsed<'_, Input<'_>> {
    let (input, ()) = blank(input)?;
    if !input.first().is_some_and(|&byte| is(byte, ID_START)) {
        return backtrack(input, Reason::Expected("a name"));
    }
    let len = input.iter().position(|&byte| !is(byte, ID)).unwrap_or(input.len());
    if input.get(len).is_some_and(|&byte| !ends_word(byte)) {
        return fail(input, Reason::Expected(NAME_LETTERS));
    }
    Ok((&input[len..], &input[..len]))
}

/// A finite real number; overflow is an error.
pub(crate) fn number(input: Input<'_>) -> Parsed<'_, f64> {
    let (input, ()) = blank(input)?;
    let unsigned = input.strip_prefix(b"+").unwrap_or(input);
    let digits = input.strip_prefix(b"-").unwrap_or(unsigned);
    // Only digits may follow the sign: this keeps out `inf` and `nan`.
    if !matches!(digits, [b'0'..=b'9', ..] | [b'.', b'0'..=b'9', ..]) {
        return backtrack(input, Reason::Expected("a number"));
    }
    let (value, len) = match short_decimal(unsigned) {
        Some(read) => read,
        None => match fast_float2::parse_partial::<f64, _>(unsigned) {
            Ok(read) => read,
            Err(_) => return fail(input, Reason::Expected("a number")),
        },
    };
    let rest = &unsigned[len..];
    if rest.first().is_some_and(|&byte| !ends_word(byte)) {
        return fail(input, Reason::Expected("a number"));
    }
    if !value.is_finite() {
        return fail(input, Reason::NotFinite);
    }
    Ok((rest, value))
}

/// A number that is finite as a 32-bit float, to which it is rounded once.
pub(crate) fn number32(input: Input<'_>) -> Parsed<'_, f32> {
    let (rest, _) = number(input)?;
    let (at, ()) = blank(input)?;
    let text =
        at[..at.len() - rest.len()].strip_prefix(b"+").unwrap_or(&at[..at.len() - rest.len()]);
    match fast_float2::parse::<f32, _>(text) {
        Ok(value) if value.is_finite() => Ok((rest, value)),
        _ => fail(at, Reason::OutOfRange("here numbers have 32 bits and reach up to about 3.4e38")),
    }
}

/// Powers of ten that are exact as f64.
const POWERS_OF_TEN: [f64; 20] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16,
    1e17, 1e18, 1e19,
];

/// Integers up to this are exact as f64.
const MOST_EXACT: u64 = 1 << f64::MANTISSA_DIGITS;

/// A decimal number without exponent whose digits are an integer up to [`MOST_EXACT`], and its
/// length.
///
/// Its digits and the power of ten are exact as f64, so their quotient is the nearest f64 (Clinger
/// 1990): the same as the general algorithm, but faster.
#[inline(always)]
pub(crate) fn short_decimal(input: Input<'_>) -> Option<(f64, usize)> {
    let is_negative = input.first() == Some(&b'-');
    let mut idx = usize::from(is_negative);
    let start = idx;
    let mut digits = 0u64;
    while let Some(digit) = digit(input, idx) {
        digits = digits.wrapping_mul(10).wrapping_add(digit);
        idx += 1;
    }
    let mut n_digits = idx - start;
    let mut n_decimals = 0;
    if input.get(idx) == Some(&b'.') {
        let first = idx + 1;
        idx = first;
        while let Some(digit) = digit(input, idx) {
            digits = digits.wrapping_mul(10).wrapping_add(digit);
            idx += 1;
        }
        n_decimals = idx - first;
        n_digits += n_decimals;
    }
    // Up to 19 digits do not overflow.
    let is_exact = (1..=19).contains(&n_digits) && digits <= MOST_EXACT;
    if !is_exact || input.get(idx).is_some_and(|&byte| !ends_word(byte)) {
        return None;
    }
    let value = digits as f64 / POWERS_OF_TEN[n_decimals];
    Some((if is_negative { -value } else { value }, idx))
}

#[inline(always)]
fn digit(input: Input<'_>, idx: usize) -> Option<u64> {
    let value = input.get(idx)?.wrapping_sub(b'0');
    (value < 10).then_some(u64::from(value))
}

/// An array size: digits only.
pub(crate) fn integer(input: Input<'_>) -> Parsed<'_, u64> {
    let (input, ()) = blank(input)?;
    let len = word_len(input);
    let digits = &input[..len];
    if digits.is_empty() || !digits.iter().all(u8::is_ascii_digit) {
        return backtrack(input, Reason::Expected("a whole number"));
    }
    let value = digits
        .iter()
        .fold(0u64, |sum, &digit| sum.saturating_mul(10).saturating_add(u64::from(digit - b'0')));
    Ok((&input[len..], value))
}

/// Three numbers.
pub(crate) fn point(input: Input<'_>) -> Parsed<'_, DVec3> {
    let (input, x) = number(input)?;
    let (input, y) = require(number(input))?;
    let (input, z) = require(number(input))?;
    Ok((input, DVec3::new(x, y, z)))
}

/// A punctuation mark.
pub(crate) fn mark<'a>(byte: u8, what: &'static str) -> impl Fn(Input<'a>) -> Parsed<'a, ()> {
    move |input| {
        let (input, ()) = blank(input)?;
        match input.split_first() {
            Some((&first, rest)) if first == byte => Ok((rest, ())),
            _ => backtrack(input, Reason::Expected(what)),
        }
    }
}

/// A file name: a string in quotes, or a word.
pub(crate) fn file_name(input: Input<'_>) -> Parsed<'_, Input<'_>> {
    let (input, ()) = blank(input)?;
    let Some(quoted) = input.strip_prefix(b"\"") else { return wanted(word(input), FILE_NAME) };
    match memchr2(b'"', b'\n', quoted) {
        Some(len @ 1..) if quoted[len] == b'"' => Ok((&quoted[len + 1..], &quoted[..len])),
        _ => backtrack(input, Reason::Expected(FILE_NAME)),
    }
}

/// Most characters of a label.
const LABEL: usize = 200;

/// The text of a label, in quotes.
pub(crate) fn label_text(at: Input<'_>) -> Parsed<'_, Input<'_>> {
    let wrong = "text of 1 to 200 letters in quotes, without braces and line breaks";
    let Some(quoted) = at.strip_prefix(b"\"") else { return fail(at, Reason::Expected(wrong)) };
    let end = memchr2(b'"', b'\n', quoted).filter(|&end| quoted[end] == b'"');
    let text = end.map(|end| &quoted[..end]);
    let is_allowed = |text: &&[u8]| {
        let text = std::str::from_utf8(text).unwrap_or_default();
        let is_free = |c: char| !c.is_control() && !matches!(c, '{' | '}');
        !text.trim().is_empty() && text.chars().count() <= LABEL && text.chars().all(is_free)
    };
    match text.filter(is_allowed) {
        Some(text) => Ok((&quoted[text.len() + 1..], text)),
        None => fail(at, Reason::Expected(wrong)),
    }
}

pub(crate) const FILE_NAME: &str = "a file name, in quotes if there are blanks in it";

/// The input after the next `;` outside comments.
pub(crate) fn skip_statement(mut input: Input<'_>) -> Result<Input<'_>, SyntaxError<'_>> {
    loop {
        match memchr2(b';', b'{', input) {
            None => return Err(SyntaxError { at: &[], reason: Reason::Expected("`;`") }),
            Some(idx) if input[idx] == b';' => return Ok(&input[idx + 1..]),
            Some(idx) => input = comment(&input[idx..])?.0,
        }
    }
}

/// Position of the last keyword in `before`, ignoring white space and comments after it.
pub(crate) fn statement_start(before: Input<'_>) -> usize {
    let mut idx = before.len();
    let mut depth = 0usize;
    while idx > 0 {
        match before[idx - 1] {
            // Comments nest, so they can be skipped backwards as well.
            b'}' => depth += 1,
            b'{' => depth = depth.saturating_sub(1),
            byte if depth == 0 && !is_blank(byte) => break,
            _ => {}
        }
        idx -= 1;
    }
    before[..idx].iter().rposition(|&byte| ends_word(byte)).map_or(0, |end| end + 1)
}
