//! The pages of the documentation as one site, by mdBook.

use std::fs;
use std::io::{self, Write};
use std::path::Path;
use std::process::Command;

use pulldown_cmark::{Event, Parser, Tag};
use ugtests::scenes;

use crate::install;
use crate::programs::run;

/// Version of mdBook that is installed below the target folder if there is none.
const MDBOOK: &str = "mdbook@0.5.4";

/// The page that runs the programs in a browser, which `cargo xtask page` builds.
const LIVE: &str = "uglorentz.html";

/// Settings of mdBook.
const BOOK: &str = "\
[book]
title = \"What things look like near the speed of light\"
src = \"src\"
[output.html]
default-theme = \"light\"
preferred-dark-theme = \"navy\"
no-section-label = true
[output.html.print]
enable = false
";

/// Writes the site into target/site/book, with the page that runs the programs in a browser, if it
/// is built. Prints the page to open.
pub fn write(out: &mut impl Write) -> io::Result<()> {
    let site = scenes::target_dir().join("site");
    let source = site.join("src");
    if source.exists() {
        fs::remove_dir_all(&source)?;
    }
    let pages = install::pages(scenes::root())?;
    for page in &pages {
        let (page, copy) = (scenes::root().join(page), source.join(index(page)));
        fs::create_dir_all(copy.parent().unwrap_or(&source))?;
        if page.extension().is_some_and(|ending| ending == "md") {
            fs::write(copy, index(&fs::read_to_string(page)?))?;
        } else {
            fs::copy(page, copy)?;
        }
    }
    let front = fs::read_to_string(scenes::root().join("README.md"))?;
    let live = scenes::target_dir().join("page").join(LIVE);
    if live.exists() {
        fs::copy(live, source.join(LIVE))?;
        let link = front.replacen(&format!("`{LIVE}`"), &format!("[{LIVE}]({LIVE})"), 1);
        fs::write(source.join("index.md"), index(&link))?;
    }
    fs::write(source.join("SUMMARY.md"), summary(&front))?;
    fs::write(site.join("book.toml"), BOOK)?;

    let tools = site.join("tools");
    let mdbook = tools.join("bin/mdbook");
    if !mdbook.exists() {
        let mut cargo = Command::new(env!("CARGO"));
        let options =
            ["install", "--quiet", "--no-default-features", "--features", "search", "--root"];
        run(cargo.args(options).arg(&tools).arg(MDBOOK))?;
    }
    run(Command::new(mdbook).arg("build").arg(&site))?;
    check_links(&site.join("book"))?;
    writeln!(out, "{}", site.join("book/index.html").display())
}

/// The name, or the text with links, of a page whose folder opens with it.
fn index(text: &str) -> String {
    text.replace("README.md", "index.md")
}

/// The pages in the order in which the front page links to them, each with its heading.
fn summary(front: &str) -> String {
    let mut summary = String::from("[Front page](index.md)\n\n");
    for page in links(front).filter(|link| link.ends_with(".md") && !link.contains(':')) {
        let line = |title: &str| format!("- [{title}]({})\n", index(&page));
        let text = fs::read_to_string(scenes::root().join(&page)).unwrap_or_default();
        let title = text.lines().find_map(|line| line.strip_prefix("# ")).unwrap_or(&page);
        // A page that is linked twice stands where it is linked last: in the table of all pages.
        summary = summary.replace(&line(title), "") + &line(title);
    }
    summary
}

/// The targets of links, without anchors.
fn links(markdown: &str) -> impl Iterator<Item = String> {
    Parser::new(markdown).filter_map(|event| match event {
        Event::Start(Tag::Link { dest_url, .. }) => dest_url.split('#').next().map(str::to_owned),
        _ => None,
    })
}

/// Checks that every link and picture of a folder of HTML pages is a file of it.
fn check_links(book: &Path) -> io::Result<()> {
    let (mut folders, mut n_links, mut broken) = (vec![book.to_owned()], 0, Vec::new());
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder)? {
            let path = entry?.path();
            if path.is_dir() {
                folders.push(path);
                continue;
            }
            // Paths in the page for errors start at the folder of the site.
            if path.extension().is_none_or(|ending| ending != "html") || path.ends_with("404.html")
            {
                continue;
            }
            let text = fs::read_to_string(&path)?;
            let targets = text.split([' ', '\n']).filter_map(|word| {
                let value = word.strip_prefix("href=\"").or_else(|| word.strip_prefix("src=\""))?;
                value
                    .split(['"', '#'])
                    .next()
                    .filter(|target| !target.is_empty() && !target.contains(':'))
            });
            for target in targets {
                n_links += 1;
                if !folder.join(target).exists() {
                    broken.push(format!("{}: {target}", path.display()));
                }
            }
        }
    }
    if broken.is_empty() && n_links > 500 {
        return Ok(());
    }
    Err(io::Error::other(format!("{n_links} links, broken:\n{}", broken.join("\n"))))
}
