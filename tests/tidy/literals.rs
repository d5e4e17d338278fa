//! The string literals of a Rust source, found without a parser.

/// String literals outside comments and unit tests, with the index of their first line.
pub fn of(source: &str) -> Vec<(usize, String)> {
    let end = source.find("#[cfg(test)]\nmod ").unwrap_or(source.len());
    let mut literals = Vec::new();
    let mut rest = &source[..end];
    while let Some(at) = rest.find(['"', '\'', '/']) {
        let (before, here) = rest.split_at(at);
        let line = source[..end].len() - here.len();
        let line = source[..line].matches('\n').count();
        rest = if here.starts_with("//") {
            here.find('\n').map_or("", |end| &here[end..])
        } else if here.starts_with("'\"'")
            || here.starts_with("'\\\"'")
            || here.starts_with("'\\''")
        {
            &here[here[1..].find('\'').map_or(1, |end| end + 2)..]
        } else if here.starts_with('"') {
            let hashes = before.len() - before.trim_end_matches('#').len();
            let is_raw = before[..before.len() - hashes].ends_with('r');
            let length = if is_raw { raw_length(here, hashes) } else { length(here) };
            literals.push((line, here[1..length].to_string()));
            here.get(length + 1..).unwrap_or_default()
        } else {
            &here[1..]
        };
    }
    literals
}

/// Where the closing quote is.
fn length(here: &str) -> usize {
    let mut is_escaped = false;
    let closes = |(at, byte): (usize, u8)| {
        let is_end = byte == b'"' && !is_escaped && at > 0;
        is_escaped = byte == b'\\' && !is_escaped;
        is_end.then_some(at)
    };
    here.bytes().enumerate().find_map(closes).unwrap_or(here.len())
}

fn raw_length(here: &str, hashes: usize) -> usize {
    let end = format!("\"{}", "#".repeat(hashes));
    here[1..].find(&end).map_or(here.len(), |at| at + 1)
}
