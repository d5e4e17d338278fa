//! Splits a recorded command line into words.

/// The words of a command line as a POSIX shell splits them. Supports what recorded command lines
/// contain: plain words, single quotes and backslashes.
pub fn split(line: &str) -> Vec<String> {
    let (mut words, mut word) = (Vec::new(), None::<String>);
    let (mut is_quoted, mut is_escaped) = (false, false);
    for character in line.chars() {
        match character {
            '\'' if !is_escaped => {
                is_quoted = !is_quoted;
                word.get_or_insert_default();
            }
            '\\' if !is_quoted && !is_escaped => {
                is_escaped = true;
                continue;
            }
            ' ' if !is_quoted && !is_escaped => words.extend(word.take()),
            other => word.get_or_insert_default().push(other),
        }
        is_escaped = false;
    }
    words.extend(word);
    words
}

#[cfg(test)]
mod tests {
    #[test]
    fn quoted_words_are_not_split() {
        assert_eq!(super::split("a -cap 'b  -vel' '' c"), ["a", "-cap", "b  -vel", "", "c"]);
        assert_eq!(super::split(r"'it'\''s' x"), ["it's", "x"]);
    }
}
