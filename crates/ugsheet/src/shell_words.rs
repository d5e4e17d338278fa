//! Splits recorded command lines into words.

/// What the comment behind a recorded pipe begins with.
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
/// plain words, single quotes, backslashes, pipes, and a comment at the end.
pub fn tokens(line: &str) -> Vec<Token> {
    let (mut tokens, mut word) = (Vec::new(), None::<String>);
    let (mut is_quoted, mut is_escaped) = (false, false);
    for (at, character) in line.char_indices() {
        let is_plain = !is_quoted && !is_escaped;
        match character {
            '\'' if !is_escaped => {
                is_quoted = !is_quoted;
                word.get_or_insert_default();
            }
            '\\' if is_plain => {
                is_escaped = true;
                continue;
            }
            ' ' if is_plain => tokens.extend(word.take().map(Token::Word)),
            '|' if is_plain => {
                tokens.extend(word.take().map(Token::Word));
                tokens.push(Token::Pipe);
            }
            '#' if is_plain && word.is_none() => {
                tokens.push(Token::Comment(line[at + 1..].trim().to_owned()));
                return tokens;
            }
            other => word.get_or_insert_default().push(other),
        }
        is_escaped = false;
    }
    tokens.extend(word.map(Token::Word));
    tokens
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
    }

    #[test]
    fn pipes_and_comments_are_found_outside_quotes() {
        let word = |word: &str| Token::Word(word.into());
        let expected = [word("a"), word("|#"), Token::Pipe, word("b#c"), Token::Comment("d 'e' | f".into())];
        assert_eq!(tokens("a '|#' | b#c # d 'e' | f"), expected);
        assert_eq!(tokens(r"a\|b|"), [word("a|b"), Token::Pipe]);
    }
}
