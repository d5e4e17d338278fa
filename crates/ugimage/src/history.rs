//! Reads the history from files of every format that has one, without decoding the picture.

use crate::read::{MAX_TEXT, latin, metadata, until_zero};

/// The history in a file that this library has written ([`crate::Metadata::comment`]): PNG, EXR,
/// HDR, PPM, PDF, SVG, PostScript and EPS. `None` for other files, files without a history, and
/// histories of more than 1 MiB.
///
/// PostScript and EPS contain ASCII only, EXR Latin-1: other characters were replaced by `?`.
pub fn read_history(file: &[u8]) -> Option<String> {
    let history = match file {
        [0x89, b'P', b'N', b'G', ..] => metadata(file).comment,
        [b'P', b'6', b'\n', rest @ ..] => {
            lines_after(rest, "# ").skip(1).collect::<Vec<_>>().join("\n")
        }
        [b'#', b'?', ..] => lines_after(after_line(file), "# ").collect::<Vec<_>>().join("\n"),
        [b'%', b'!', ..] => postscript(file),
        [b'%', b'P', b'D', b'F', ..] => pdf(file)?,
        [b'<', b's', b'v', b'g', ..] => svg(file)?,
        [0x76, 0x2f, 0x31, 0x01, _, _, _, _, header @ ..] => exr(header)?,
        _ => return None,
    };
    (!history.is_empty() && history.len() <= MAX_TEXT).then_some(history)
}

/// The lines of a text header that begin with `mark`, without it. The header ends with the first
/// line that is neither one of them nor begins with a key, `KEY=…`.
fn lines_after<'f>(header: &'f [u8], mark: &'static str) -> impl Iterator<Item = String> + 'f {
    let lines = header.split(|&byte| byte == b'\n').map(String::from_utf8_lossy);
    let is_header =
        move |line: &std::borrow::Cow<'_, str>| line.starts_with(mark) || line.contains('=');
    lines.take_while(is_header).filter_map(move |line| line.strip_prefix(mark).map(str::to_owned))
}

fn after_line(file: &[u8]) -> &[u8] {
    let end = file.iter().position(|&byte| byte == b'\n').map_or(file.len(), |at| at + 1);
    &file[end..]
}

/// The comments `% …` before the drawing, continued by `%+`.
fn postscript(file: &[u8]) -> String {
    let lines = file.split(|&byte| byte == b'\n').take_while(|line| line.first() == Some(&b'%'));
    let mut history = String::new();
    for line in lines.map(String::from_utf8_lossy) {
        if let Some(text) = line.strip_prefix("% ") {
            history.push_str(if history.is_empty() { "" } else { "\n" });
            history.push_str(text);
        } else if let Some(text) = line.strip_prefix("%+") {
            history.push_str(text);
        }
    }
    history
}

/// The subject in the document information, which is the last object.
fn pdf(file: &[u8]) -> Option<String> {
    const KEY: &[u8] = b"/Subject";
    let at = file.windows(KEY.len()).rposition(|window| window == KEY)?;
    let value = file[at + KEY.len()..].trim_ascii_start();
    let bytes = match value.split_first()? {
        (b'(', text) => literal(text)?,
        (b'<', text) => hexadecimal(text)?,
        _ => return None,
    };
    match bytes.strip_prefix(b"\xfe\xff") {
        Some(text) => {
            let units = text.chunks_exact(2).map(|pair| u16::from_be_bytes([pair[0], pair[1]]));
            char::decode_utf16(units).collect::<Result<_, _>>().ok()
        }
        None => latin(&bytes),
    }
}

/// A string of PDF after its opening parenthesis (ISO 32000-1, 7.3.4.2).
fn literal(text: &[u8]) -> Option<Vec<u8>> {
    let (mut bytes, mut depth, mut at) = (Vec::new(), 1, 0);
    loop {
        let byte = *text.get(at)?;
        at += 1;
        match byte {
            b'(' => depth += 1,
            b')' => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return Some(bytes);
        }
        if byte != b'\\' {
            bytes.push(byte);
            continue;
        }
        let escaped = *text.get(at)?;
        let digits = text[at..].iter().take(3).take_while(|digit| (b'0'..b'8').contains(digit));
        let n_digits = digits.clone().count();
        at += n_digits.max(1);
        bytes.push(match escaped {
            _ if n_digits > 0 => {
                digits.fold(0, |code: u8, digit| code.wrapping_mul(8) | (digit - b'0'))
            }
            b'n' => b'\n',
            b'r' => b'\r',
            b't' => b'\t',
            b'b' => 8,
            b'f' => 12,
            other => other,
        });
    }
}

/// A string of PDF in hexadecimal digits, after its `<`.
fn hexadecimal(text: &[u8]) -> Option<Vec<u8>> {
    let end = text.iter().position(|&byte| byte == b'>')?;
    let digits: Option<Vec<u32>> = text[..end]
        .iter()
        .filter(|byte| !byte.is_ascii_whitespace())
        .map(|&byte| char::from(byte).to_digit(16))
        .collect();
    Some(digits?.chunks(2).map(|pair| (pair[0] << 4 | pair.get(1).unwrap_or(&0)) as u8).collect())
}

/// The text of the first `desc`, without its first line, which names the program.
fn svg(file: &[u8]) -> Option<String> {
    let find = |from: usize, text: &[u8]| {
        let at = file[from..].windows(text.len()).position(|window| window == text);
        at.map(|at| from + at)
    };
    let start = find(0, b"<desc>")? + b"<desc>".len();
    let text = str::from_utf8(&file[start..find(start, b"</desc>")?]).ok()?;
    let (_software, history) = text.split_once('\n')?;
    Some(history.replace("&lt;", "<").replace("&gt;", ">").replace("&amp;", "&"))
}

/// The attribute `comments` of a header: name, type, size in bytes and value of each attribute.
fn exr(mut header: &[u8]) -> Option<String> {
    loop {
        let (name, rest) = until_zero(header)?;
        if name.is_empty() {
            return None;
        }
        let (_type, rest) = until_zero(rest)?;
        let (length, rest) = rest.split_first_chunk()?;
        let (value, rest) = rest.split_at_checked(u32::from_le_bytes(*length) as usize)?;
        if name == b"comments" {
            return latin(value);
        }
        header = rest;
    }
}
