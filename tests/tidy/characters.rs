//! Characters of code without blanks and comments, which no format changes, counted apart for
//! programs and for tests.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use proc_macro2::{Delimiter, TokenStream, TokenTree};

/// Characters of tokens.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Characters {
    /// What is compiled into libraries and programs.
    pub production: usize,
    /// Items under `#[cfg(test)]`, and all files of tests.
    pub test: usize,
}

impl std::ops::AddAssign for Characters {
    fn add_assign(&mut self, other: Self) {
        self.production += other.production;
        self.test += other.test;
    }
}

/// The characters of a folder with a manifest. `files`: its sources, and their text; all of
/// `tests/` and
/// `benches/` are tests, and examples are neither.
pub fn of_crate(files: &BTreeMap<PathBuf, String>, folder: &Path) -> Characters {
    let counted: Vec<(&PathBuf, Counted)> = (files.iter())
        .map(|(path, text)| {
            (path, count(text).unwrap_or_else(|error| panic!("{}: {error}", path.display())))
        })
        .collect();
    let modules_of_tests: Vec<PathBuf> = (counted.iter())
        .flat_map(|(path, file)| file.test_modules.iter().map(|name| below(path).join(name)))
        .collect();
    let mut sum = Characters::default();
    for (path, file) in counted {
        let place = path.strip_prefix(folder).unwrap_or(path);
        let is_test = |module: &PathBuf| path.with_extension("").starts_with(module);
        if place.starts_with("examples") {
            continue;
        }
        if place.starts_with("tests")
            || place.starts_with("benches")
            || modules_of_tests.iter().any(is_test)
        {
            sum.test += file.characters.production + file.characters.test;
        } else {
            sum += file.characters;
        }
    }
    sum
}

/// The folder of the modules that a file declares.
fn below(path: &Path) -> PathBuf {
    match path.file_name().and_then(|name| name.to_str()) {
        Some("lib.rs" | "main.rs" | "mod.rs") => path.parent().unwrap_or(path).to_path_buf(),
        _ => path.with_extension(""),
    }
}

#[derive(Default)]
struct Counted {
    characters: Characters,
    /// Names of modules under `#[cfg(test)]` whose text is in a file of its own.
    test_modules: Vec<String>,
}

fn count(text: &str) -> Result<Counted, proc_macro2::LexError> {
    let mut counted = Counted::default();
    counted.read(text.parse()?, false);
    Ok(counted)
}

impl Counted {
    fn read(&mut self, tokens: TokenStream, is_test: bool) {
        let tokens: Vec<TokenTree> = tokens.into_iter().collect();
        let mut at = 0;
        // Whether this item is under `#[cfg(test)]`.
        let mut is_test_item = false;
        while at < tokens.len() {
            if let Some((n_tokens, attribute)) = attribute(&tokens[at..]) {
                let words: Vec<String> = words(attribute.stream());
                if words.first().is_some_and(|word| word == "doc") {
                    at += n_tokens;
                    continue;
                }
                let is_condition = words.first().is_some_and(|word| word == "cfg");
                is_test_item |= is_condition
                    && words.contains(&"test".into())
                    && !words.contains(&"not".into());
            }
            let is_test_here = is_test || is_test_item;
            if let (
                true,
                [TokenTree::Ident(word), TokenTree::Ident(name), TokenTree::Punct(end), ..],
            ) = (is_test_here, &tokens[at..])
                && *word == "mod"
                && end.as_char() == ';'
            {
                self.test_modules.push(name.to_string());
            }
            match &tokens[at] {
                TokenTree::Group(group) => {
                    let n_delimiters = if group.delimiter() == Delimiter::None { 0 } else { 2 };
                    self.add(n_delimiters, is_test_here);
                    self.read(group.stream(), is_test_here);
                    is_test_item &= group.delimiter() != Delimiter::Brace;
                }
                token => {
                    let text = token.to_string();
                    self.add(text.chars().filter(|c| !c.is_whitespace()).count(), is_test_here);
                    is_test_item &= !matches!(token, TokenTree::Punct(end) if end.as_char() == ';');
                }
            }
            at += 1;
        }
    }

    fn add(&mut self, n: usize, is_test: bool) {
        let sum = &mut self.characters;
        *(if is_test { &mut sum.test } else { &mut sum.production }) += n;
    }
}

/// The attribute at the beginning of these tokens, `#[…]` or `#![…]`: how many tokens it has, and
/// its brackets.
fn attribute(tokens: &[TokenTree]) -> Option<(usize, &proc_macro2::Group)> {
    let is = |token: &TokenTree, sign| matches!(token, TokenTree::Punct(found) if found.as_char() == sign);
    let n_signs = if tokens.get(1).is_some_and(|token| is(token, '!')) { 2 } else { 1 };
    match tokens.get(n_signs) {
        Some(TokenTree::Group(group))
            if is(&tokens[0], '#') && group.delimiter() == Delimiter::Bracket =>
        {
            Some((n_signs + 1, group))
        }
        _ => None,
    }
}

/// All words of an attribute, in order.
fn words(tokens: TokenStream) -> Vec<String> {
    let words = tokens.into_iter().flat_map(|token| match token {
        TokenTree::Group(group) => words(group.stream()),
        TokenTree::Ident(word) => vec![word.to_string()],
        _ => Vec::new(),
    });
    words.collect()
}
