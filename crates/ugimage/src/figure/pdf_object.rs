//! Objects of PDF files (ISO 32000-1, 7.3): read from bytes, and written with other numbers.

use pdf_writer::{Dict, Name, Null, Obj, Ref, Str};

use super::part_error::PartError;

/// Greatest depth of arrays and dictionaries in each other.
const MAX_DEPTH: u32 = 64;

/// Greatest number of objects within an object.
const MAX_PARTS: u32 = 1 << 18;

/// An object. Streams are found by their dictionary.
#[derive(Clone, Debug, PartialEq)]
pub enum Object {
    Null,
    Bool(bool),
    Number(f64),
    Name(Vec<u8>),
    Text(Vec<u8>),
    Array(Vec<Object>),
    Dict(Entries),
    /// A reference by number.
    Ref(u32),
}

/// The entries of a dictionary, in the order of the file.
pub type Entries = Vec<(Vec<u8>, Object)>;

/// The value of a key; null if there is none.
pub fn entry<'o>(entries: &'o Entries, key: &str) -> &'o Object {
    entries.iter().find(|(name, _)| name == key.as_bytes()).map_or(&Object::Null, |(_, value)| value)
}

impl Object {
    /// Writes the object; `map` maps the numbers of objects.
    pub fn write(&self, out: Obj<'_>, map: &mut impl FnMut(u32) -> Ref) {
        match self {
            Self::Null => out.primitive(Null),
            Self::Bool(value) => out.primitive(*value),
            Self::Number(value) if value.fract() == 0.0 && value.abs() < 2e9 => out.primitive(*value as i32),
            Self::Number(value) => out.primitive(single(*value)),
            Self::Name(name) => out.primitive(Name(name)),
            Self::Text(text) => out.primitive(Str(text)),
            Self::Ref(number) => out.primitive(map(*number)),
            Self::Array(items) => {
                let mut array = out.array();
                items.iter().for_each(|item| item.write(array.push(), map));
            }
            Self::Dict(entries) => write_entries(entries, &mut out.dict(), map),
        }
    }
}

/// The number in single precision, which PDF files have. pdf-writer would write −2³¹ as an integer
/// and overflow when it negates it, so its neighbour is returned.
pub fn single(value: f64) -> f32 {
    const LEAST: f32 = i32::MIN as f32;
    let value = value as f32;
    if value == LEAST { LEAST.next_up() } else { value }
}

/// Writes the entries of a dictionary; `map` maps the numbers of objects.
pub fn write_entries(entries: &Entries, dict: &mut Dict<'_>, map: &mut impl FnMut(u32) -> Ref) {
    for (key, value) in entries {
        value.write(dict.insert(Name(key)), map);
    }
}

/// Reads objects from a file.
pub struct Objects<'f> {
    file: &'f [u8],
    /// The next byte.
    pub at: usize,
    /// Objects that have been read.
    n_read: u32,
}

impl<'f> Objects<'f> {
    /// Begins at a place of a file.
    pub fn new(file: &'f [u8], at: usize) -> Self {
        Self { file, at, n_read: 0 }
    }

    /// The bytes that have not been read.
    pub fn rest(&self) -> &'f [u8] {
        self.file.get(self.at..).unwrap_or_default()
    }

    /// Reads white space and comments.
    pub fn skip_space(&mut self) {
        while let Some(&byte) = self.rest().first() {
            if byte == b'%' {
                self.at += self.rest().iter().take_while(|byte| !matches!(byte, b'\n' | b'\r')).count();
            } else if is_space(byte) {
                self.at += 1;
            } else {
                return;
            }
        }
    }

    /// Reads a word if it is next.
    pub fn has(&mut self, word: &str) -> bool {
        self.skip_space();
        let is_next = self.rest().starts_with(word.as_bytes());
        self.at += if is_next { word.len() } else { 0 };
        is_next
    }

    /// Reads a number that is not negative and has no fraction.
    pub fn count(&mut self) -> Option<u32> {
        self.skip_space();
        let digits = self.rest().iter().take_while(|byte| byte.is_ascii_digit()).count();
        let number = std::str::from_utf8(&self.rest()[..digits]).ok()?.parse().ok()?;
        self.at += digits;
        Some(number)
    }

    /// Reads an object.
    ///
    /// # Errors
    /// There is none, or its nesting is too deep.
    pub fn object(&mut self) -> Result<Object, PartError> {
        self.nested(0)
    }

    fn nested(&mut self, depth: u32) -> Result<Object, PartError> {
        const INVALID: PartError = PartError::Pdf("an object");
        self.n_read += 1;
        if depth > MAX_DEPTH || self.n_read > MAX_PARTS {
            return Err(PartError::Pdf("an object that is too large"));
        }
        self.skip_space();
        match self.rest() {
            [b'<', b'<', ..] => {
                self.at += 2;
                self.dict(depth)
            }
            [b'<', ..] => self.hexadecimal().ok_or(INVALID),
            [b'(', ..] => self.literal().ok_or(INVALID),
            [b'/', ..] => Ok(Object::Name(self.name())),
            [b'[', ..] => {
                self.at += 1;
                let mut items = Vec::new();
                while !self.has("]") {
                    items.push(self.nested(depth + 1)?);
                }
                Ok(Object::Array(items))
            }
            [b'0'..=b'9' | b'+' | b'-' | b'.', ..] => match self.number_or_ref().ok_or(INVALID)? {
                // Numbers are written in single precision, and PDF has no infinity.
                Object::Number(number) if number.abs() > f64::from(f32::MAX) => {
                    Err(PartError::Pdf("a number that is too large"))
                }
                other => Ok(other),
            },
            _ if self.has("true") => Ok(Object::Bool(true)),
            _ if self.has("false") => Ok(Object::Bool(false)),
            _ if self.has("null") => Ok(Object::Null),
            _ => Err(INVALID),
        }
    }

    fn dict(&mut self, depth: u32) -> Result<Object, PartError> {
        let mut entries = Vec::new();
        while !self.has(">>") {
            if self.rest().first() != Some(&b'/') {
                return Err(PartError::Pdf("a dictionary"));
            }
            let key = self.name();
            entries.push((key, self.nested(depth + 1)?));
        }
        Ok(Object::Dict(entries))
    }

    /// Reads a name after its slash, which is next.
    fn name(&mut self) -> Vec<u8> {
        self.at += 1;
        let length = self.rest().iter().take_while(|&&byte| !is_space(byte) && !is_delimiter(byte)).count();
        let word = &self.rest()[..length];
        self.at += length;
        let mut name = Vec::with_capacity(length);
        let mut idx = 0;
        while let Some(&byte) = word.get(idx) {
            let digit = |at: usize| char::from(*word.get(at)?).to_digit(16);
            match (byte, digit(idx + 1), digit(idx + 2)) {
                (b'#', Some(high), Some(low)) => {
                    name.push((high << 4 | low) as u8);
                    idx += 3;
                }
                _ => {
                    name.push(byte);
                    idx += 1;
                }
            }
        }
        name
    }

    fn number_or_ref(&mut self) -> Option<Object> {
        let start = self.at;
        // A reference is `12 0 R`.
        if let (Some(number), Some(_)) = (self.count(), self.count())
            && self.has("R")
        {
            return Some(Object::Ref(number));
        }
        self.at = start;
        let length = self
            .rest()
            .iter()
            .take_while(|byte| byte.is_ascii_digit() || matches!(byte, b'+' | b'-' | b'.'))
            .count();
        let number: f64 = std::str::from_utf8(&self.rest()[..length]).ok()?.parse().ok()?;
        self.at += length;
        Some(Object::Number(number))
    }

    fn hexadecimal(&mut self) -> Option<Object> {
        let length = self.rest().iter().position(|&byte| byte == b'>')?;
        let digits = self.rest()[1..length].iter().filter(|byte| !is_space(**byte));
        let mut digits = digits
            .map(|&byte| char::from(byte).to_digit(16).map(|digit| digit as u8))
            .collect::<Option<Vec<u8>>>()?;
        if digits.len() % 2 == 1 {
            digits.push(0);
        }
        self.at += length + 1;
        Some(Object::Text(digits.chunks_exact(2).map(|pair| pair[0] << 4 | pair[1]).collect()))
    }

    /// Reads a string in parentheses.
    fn literal(&mut self) -> Option<Object> {
        self.at += 1;
        let (mut text, mut depth) = (Vec::new(), 1);
        loop {
            let byte = self.byte()?;
            match byte {
                b'(' => depth += 1,
                b')' if depth == 1 => return Some(Object::Text(text)),
                b')' => depth -= 1,
                b'\\' => {
                    text.extend(self.escape()?);
                    continue;
                }
                _ => {}
            }
            text.push(byte);
        }
    }

    /// The character of an escape after its backslash; none for the end of a line.
    fn escape(&mut self) -> Option<Option<u8>> {
        Some(Some(match self.byte()? {
            b'n' => b'\n',
            b'r' => b'\r',
            b't' => b'\t',
            b'b' => 8,
            b'f' => 12,
            b'\n' => return Some(None),
            b'\r' => {
                self.at += usize::from(self.rest().first() == Some(&b'\n'));
                return Some(None);
            }
            digit @ b'0'..=b'7' => {
                let mut code = u32::from(digit - b'0');
                for _ in 0..2 {
                    let Some(next @ b'0'..=b'7') = self.rest().first() else { break };
                    code = 8 * code + u32::from(next - b'0');
                    self.at += 1;
                }
                // The high bit is ignored.
                code as u8
            }
            other => other,
        }))
    }

    fn byte(&mut self) -> Option<u8> {
        let byte = self.rest().first().copied();
        self.at += 1;
        byte
    }
}

fn is_space(byte: u8) -> bool {
    matches!(byte, 0 | b'\t' | b'\n' | 12 | b'\r' | b' ')
}

fn is_delimiter(byte: u8) -> bool {
    b"()<>[]{}/%".contains(&byte)
}
