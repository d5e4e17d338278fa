//! Words and command lines for POSIX shells.

use std::ffi::OsStr;

use crate::text::is_printable;

/// `word` quoted for a shell, on one line, and safe inside a `{ … }` comment and on a terminal.
///
/// Text is in single quotes. Braces and characters that are not [printable](is_printable) are
/// octal numbers in `"$(printf '\033')"`, which every POSIX shell reads: `$'…'` is new in POSIX,
/// and dash does not have it.
///
/// A shell drops line ends at the end of `$(…)`, so a line end is followed by the number of the
/// next character. At the end of a word it is lost; [`shell_pipe`] keeps it there as well.
pub fn shell_word(word: &str) -> String {
    quoted(word.as_bytes())
}

/// Like [`shell_word`]; bytes that are not UTF-8 are kept as well.
pub fn shell_os_word(word: &OsStr) -> String {
    quoted(word.as_encoded_bytes())
}

/// The line by which a shell runs a pipe of commands, each a list of words, with its output in a
/// file if one is given. It is as safe as a [`shell_word`], and keeps every byte: a line with a
/// word that ends in a line end is the argument of `eval`.
pub fn shell_pipe<W: AsRef<OsStr>>(commands: &[Vec<W>], output: Option<&OsStr>) -> String {
    let mut words = commands.iter().flatten().map(AsRef::as_ref).chain(output);
    if words.any(|word| word.as_encoded_bytes().ends_with(b"\n")) {
        let line = pipe(commands, output, |word| match is_plain(word) {
            true => word.to_vec(),
            false => single_quoted(word),
        });
        return format!("eval {}", quoted(&line));
    }
    // What is quoted is UTF-8.
    let line = pipe(commands, output, |word| quoted(word).into_bytes());
    String::from_utf8_lossy(&line).into_owned()
}

fn pipe<W: AsRef<OsStr>>(
    commands: &[Vec<W>],
    output: Option<&OsStr>,
    quote: impl Fn(&[u8]) -> Vec<u8>,
) -> Vec<u8> {
    let quote = |word: &OsStr| quote(word.as_encoded_bytes());
    let command = |words: &Vec<W>| {
        words.iter().map(|word| quote(word.as_ref())).collect::<Vec<_>>().join(&b' ')
    };
    let mut line = commands.iter().map(command).collect::<Vec<_>>().join(b" | ".as_slice());
    if let Some(output) = output {
        line.extend(b" > ");
        line.extend(quote(output));
    }
    line
}

/// True for words that mean themselves in every shell: in zsh `=ls` is a path.
fn is_plain(word: &[u8]) -> bool {
    let is_plain = |byte: &u8| byte.is_ascii_alphanumeric() || b"-_+.,:/@%=".contains(byte);
    !word.is_empty() && word[0] != b'=' && word.iter().all(is_plain)
}

/// False for characters that a terminal obeys or that end a comment of a scene.
fn is_shown(c: char) -> bool {
    is_printable(c) && !matches!(c, '{' | '}')
}

fn quoted(word: &[u8]) -> String {
    if is_plain(word) {
        return String::from_utf8_lossy(word).into_owned();
    }
    let (mut line, mut shown, mut octal) = (String::new(), Vec::new(), String::new());
    let end_shown = |line: &mut String, shown: &mut Vec<u8>| {
        if !shown.is_empty() {
            *line += &String::from_utf8_lossy(&single_quoted(&std::mem::take(shown)));
        }
    };
    let end_octal = |line: &mut String, octal: &mut String| {
        if !octal.is_empty() {
            *line += &format!(r#""$(printf '{}')""#, std::mem::take(octal));
        }
    };
    for chunk in word.utf8_chunks() {
        for c in chunk.valid().chars() {
            let mut bytes = [0; 4];
            let bytes = c.encode_utf8(&mut bytes).as_bytes();
            if is_shown(c) && !octal.ends_with(LINE_END) {
                end_octal(&mut line, &mut octal);
                shown.extend(bytes);
            } else {
                end_shown(&mut line, &mut shown);
                bytes.iter().for_each(|&byte| octal += &number(byte));
            }
        }
        if !chunk.invalid().is_empty() {
            end_shown(&mut line, &mut shown);
            chunk.invalid().iter().for_each(|&byte| octal += &number(byte));
        }
    }
    end_octal(&mut line, &mut octal);
    end_shown(&mut line, &mut shown);
    if line.is_empty() { "''".to_owned() } else { line }
}

/// The [`number`] of `\n`.
const LINE_END: &str = r"\012";

/// A byte in the format of `printf`. It has three digits, so that a digit may follow.
fn number(byte: u8) -> String {
    format!(r"\{byte:03o}")
}

fn single_quoted(word: &[u8]) -> Vec<u8> {
    let parts: Vec<&[u8]> = word.split(|&byte| byte == b'\'').collect();
    let mut quoted = vec![b'\''];
    quoted.extend(parts.join(br"'\''".as_slice()));
    quoted.push(b'\'');
    quoted
}
