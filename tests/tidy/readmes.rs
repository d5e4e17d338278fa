//! The README of a crate: the beginning of its documentation, for people who find its package.

/// Lines of the beginning, besides the example.
const MOST_LINES: usize = 24;

/// The README of a crate. `manifest`: its Cargo.toml, `library`: the text of its `src/lib.rs`.
pub fn of(name: &str, manifest: &str, library: &str, is_program: bool) -> String {
    let sections = sections(library);
    let blocks = blocks(&sections[0].1);
    let mut chosen: Vec<usize> = Vec::new();
    let mut n_lines = 0;
    for (idx, block) in blocks.iter().enumerate() {
        n_lines += block.len() + 1;
        if n_lines > MOST_LINES {
            break;
        }
        chosen.push(idx);
    }
    // A sentence that ends with a colon is nothing without what follows.
    let leads = |idx: usize| blocks[idx].last().is_some_and(|line| line.ends_with(':'));
    while chosen.last().is_some_and(|&idx| leads(idx)) {
        chosen.pop();
    }
    let is_example = |block: &&Vec<String>| block[0] == "```rust";
    if let Some(example) = blocks.iter().position(|block| is_example(&block)) {
        let first = if example > 0 && leads(example - 1) { example - 1 } else { example };
        chosen.extend(first.max(chosen.len())..=example);
    }
    let mut text = format!("# {name}\n\n");
    for idx in chosen {
        text += &(blocks[idx].join("\n") + "\n\n");
    }
    for (_, lines) in sections[1..].iter().filter(|(head, _)| head == "Example") {
        text += &format!("## Example\n\n{}\n\n", lines.join("\n").trim());
    }
    text += "## Where to go on\n\n";
    if is_program {
        text += &format!("- The program: `cargo install {name}`, then `{name} --help`\n");
    }
    let libraries = if name == "unigrafix" {
        String::new()
    } else {
        "- All libraries of the ug programs, which draw what things look like near the speed of\n  \
         light, under one name: [unigrafix](https://docs.rs/unigrafix)\n"
            .to_owned()
    };
    assert!(manifest.contains("license.workspace = true"), "{name}");
    text + &format!(
        "- Documentation: [docs.rs/{name}](https://docs.rs/{name}), or `cargo doc --open -p {name}`\n\
         {libraries}- Licence: MIT or Apache-2.0, at your option; both texts are in the package\n"
    )
}

/// The sections of the documentation of a library, without links: headings and lines. The first has
/// no heading.
fn sections(library: &str) -> Vec<(String, Vec<String>)> {
    let mut sections = vec![(String::new(), Vec::new())];
    let mut code = None;
    let lines = library.lines().take_while(|line| line.starts_with("//!"));
    for line in lines.map(|line| line[3..].strip_prefix(' ').unwrap_or_default()) {
        let is_fence = line.starts_with("```");
        if is_fence {
            // Without a word, it is Rust.
            code = match code {
                None => Some(line == "```"),
                Some(_) => None,
            };
        }
        // Lines that only tests need.
        if code == Some(true) && (line.starts_with("# ") || line == "#") {
            continue;
        }
        match line.strip_prefix("# ").filter(|_| code.is_none()) {
            Some(head) => sections.push((head.to_owned(), Vec::new())),
            // The target of a link.
            None if code.is_none() && line.starts_with('[') && line.contains("]: ") => {}
            None => {
                let line = match code {
                    Some(true) if is_fence => "```rust".to_owned(),
                    Some(_) => line.to_owned(),
                    None => without_links(line),
                };
                sections.last_mut().expect("the first").1.push(line);
            }
        }
    }
    sections
}

/// Paragraphs, lists, tables and pieces of code: what empty lines separate.
fn blocks(lines: &[String]) -> Vec<Vec<String>> {
    let mut blocks: Vec<Vec<String>> = vec![Vec::new()];
    let mut is_code = false;
    for line in lines {
        is_code ^= line.starts_with("```");
        if line.is_empty() && !is_code {
            blocks.push(Vec::new());
        } else {
            blocks.last_mut().expect("one").push(line.clone());
        }
    }
    blocks.retain(|block| !block.is_empty());
    blocks
}

/// Links to items lead nowhere outside of the documentation.
fn without_links(line: &str) -> String {
    let mut text = String::new();
    let mut rest = line;
    while let Some((before, after)) = rest.split_once('[') {
        text += before;
        let Some((words, behind)) = after.split_once(']') else {
            text.push('[');
            rest = after;
            continue;
        };
        text += words;
        let target = behind.strip_prefix('(').and_then(|target| target.split_once(')'));
        rest = target.map_or(behind, |(_, behind)| behind);
    }
    text + rest
}
