//! Splits recorded command lines into words.

/// The first words of the comment behind a recorded pipe.
pub const HASH: &str = "SHA-256 ";

/// A part of a line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Token {
    /// A word, without its quotes.
    Word(String),
    /// The operator `|`.
    Pipe,
    /// The text after `# `, to the end of the line.
    Comment(String),
}

/// The tokens of a line as a POSIX shell splits it. Supports what recorded command lines contain:
/// plain words, single quotes, `"$(printf '\033')"`, backslashes, pipes, and a comment at the end;
/// and `$'…'`, which earlier versions recorded. Line ends at the end of `$(…)` are kept, since they
/// were in the word that was recorded.
pub fn tokens(line: &str) -> Vec<Token> {
    let mut rest = line;
    // As bytes: escapes may be parts of a character, or of none.
    let (mut tokens, mut word) = (Vec::new(), None::<Vec<u8>>);
    let text = |word: Vec<u8>| Token::Word(String::from_utf8_lossy(&word).into_owned());
    while let Some(c) = rest.chars().next() {
        let after = &rest[c.len_utf8()..];
        rest = after;
        match c {
            '\'' => {
                let (quoted, behind) = after.split_once('\'').unwrap_or((after, ""));
                word.get_or_insert_default().extend_from_slice(quoted.as_bytes());
                rest = behind;
            }
            '"' if let Some((bytes, behind)) = printed(after) => {
                word.get_or_insert_default().extend(bytes);
                rest = behind;
            }
            '$' if after.starts_with('\'') => {
                rest = unescape(&after[1..], word.get_or_insert_default());
            }
            '\\' => {
                let escaped = after.chars().next();
                rest = escaped.map_or("", |c| &after[c.len_utf8()..]);
                push(word.get_or_insert_default(), escaped.unwrap_or(c));
            }
            ' ' => tokens.extend(word.take().map(text)),
            '|' => {
                tokens.extend(word.take().map(text));
                tokens.push(Token::Pipe);
            }
            '#' if word.is_none() => {
                tokens.push(Token::Comment(after.trim().to_owned()));
                return tokens;
            }
            c => push(word.get_or_insert_default(), c),
        }
    }
    tokens.extend(word.map(text));
    tokens
}

fn push(word: &mut Vec<u8>, c: char) {
    word.extend_from_slice(c.encode_utf8(&mut [0; 4]).as_bytes());
}

/// The bytes of `$(printf '\033')"` at the beginning of a text, and what follows.
fn printed(text: &str) -> Option<(Vec<u8>, &str)> {
    let (numbers, behind) = text.strip_prefix(r"$(printf '\")?.split_once(r#"')""#)?;
    let byte = |number: &str| {
        let is_octal = number.len() == 3 && number.bytes().all(|byte| matches!(byte, b'0'..=b'7'));
        u8::from_str_radix(number, 8).ok().filter(|_| is_octal)
    };
    Some((numbers.split('\\').map(byte).collect::<Option<_>>()?, behind))
}

/// Appends the text of `$'…'` to a word; returns what follows the closing quote. `text`: what
/// follows the opening quote.
fn unescape<'t>(text: &'t str, word: &mut Vec<u8>) -> &'t str {
    let mut rest = text;
    while let Some(c) = rest.chars().next() {
        rest = &rest[c.len_utf8()..];
        match c {
            '\'' => return rest,
            '\\' => {
                let n_digits =
                    rest.bytes().take(3).take_while(|byte| matches!(byte, b'0'..=b'7')).count();
                let Some(escaped) = rest.chars().next() else { break };
                match (n_digits, escaped) {
                    (0, 't') => word.push(b'\t'),
                    (0, 'n') => word.push(b'\n'),
                    (0, c) => push(word, c),
                    // Of numbers above 255 a shell keeps the last 8 bits.
                    _ => word.push(u32::from_str_radix(&rest[..n_digits], 8).unwrap_or(0) as u8),
                }
                rest = &rest[n_digits.max(escaped.len_utf8())..];
            }
            c => push(word, c),
        }
    }
    rest
}

/// The words of a line.
pub fn split(line: &str) -> Vec<String> {
    let word = |token| if let Token::Word(word) = token { Some(word) } else { None };
    tokens(line).into_iter().filter_map(word).collect()
}

/// True for the line of a history that has the whole pipe; the others have one command each.
pub fn is_recipe(line: &str) -> bool {
    matches!(tokens(line).pop(), Some(Token::Comment(text)) if text.starts_with(HASH))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quoted_words_are_not_split() {
        assert_eq!(split("a -cap 'b  -vel' '' c"), ["a", "-cap", "b  -vel", "", "c"]);
        assert_eq!(split(r"'it'\''s' x"), ["it's", "x"]);
        assert_eq!(
            split(r"$'a\tb\n\175\'' $'\342\200\2561'2 $a"),
            ["a\tb\n}'", "\u{202e}12", "$a"]
        );
        assert_eq!(
            split(r#"'a'"$(printf '\012\142\175')"c "$(printf '\342\200\256')"'2' x"#),
            ["a\nb}c", "\u{202e}2", "x"]
        );
        for other in [r#""$(printf '\9')""#, r#""$(printf"#, r#""$(touch"#, r#""$(printf '\012'"#] {
            assert!(split(other)[0].starts_with("\"$("), "{other}");
        }
        assert_eq!(split(r"$'a\"), ["a"]);
        assert_eq!(split(r"a\"), ["a\\"]);
    }

    #[test]
    fn pipes_and_comments_are_found_outside_quotes() {
        let word = |word: &str| Token::Word(word.into());
        let expected =
            [word("a"), word("|#"), Token::Pipe, word("b#c"), Token::Comment("d 'e' | f".into())];
        assert_eq!(tokens("a '|#' | b#c # d 'e' | f"), expected);
        assert_eq!(tokens(r"a\|b|"), [word("a|b"), Token::Pipe]);
    }
}
