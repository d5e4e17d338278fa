//! Man pages.

use ugpipe::{DASHES, DOCUMENTATION, EXIT_STATUS, Entry, Manual};

use super::markdown;
use super::roff::{Page, bold, escaped};

/// Date of the last change to the words in this file; pages have to have one.
const DATE: &str = "2026-11-24";

/// The page of a program.
pub fn page(manual: &Manual) -> String {
    let mut page = Page::new(&manual.name, 1, DATE, &manual.version);
    page.section("NAME").paragraph(&format!("{} - {}", manual.name, lower(&manual.about)));
    page.section("SYNOPSIS").paragraph(&manual.usage);
    page.section("DESCRIPTION").paragraph(&format!("{}.", manual.about));
    manual.description.iter().for_each(|text| page.paragraph(text));
    if !manual.commands.is_empty() {
        page.section("COMMANDS");
        for command in &manual.commands {
            page.tagged(&bold(&command.usage), &format!("{}.", command.about));
            let own = command
                .options()
                .filter(|option| manual.options().all(|other| other.names != option.names));
            let own: Vec<String> = own
                .map(|option| format!("{}: {}.", option.names.join(", "), option.about))
                .collect();
            own.iter().for_each(|text| page.continued(text));
        }
    }
    page.section("OPTIONS").paragraph(DASHES);
    for group in &manual.groups {
        page.subsection(&group.heading);
        group.options.iter().for_each(|option| add_option(&mut page, option));
    }
    page.section("EXAMPLES").examples(&manual.examples);
    add_exit_status(&mut page);
    page.section("SEE ALSO").paragraph("ugtools(7), unigrafix(5)");
    page.paragraph(DOCUMENTATION);
    page.text
}

/// The page `ugtools(7)`: what the programs are, and how they work together.
pub fn overview(manuals: &[Manual]) -> String {
    let version = manuals.first().map_or("", |manual| &manual.version);
    let mut page = Page::new("ugtools", 7, DATE, version);
    let row = |manual: &Manual| format!("| **{}**(1) | {}. |", manual.name, manual.about);
    let programs: Vec<String> = manuals.iter().map(row).collect();
    markdown::add(
        &mut page,
        &include_str!("ugtools.md").replace("@PROGRAMS@", &programs.join("\n")),
    );
    add_exit_status(&mut page);
    page.section("SEE ALSO");
    let names: Vec<String> = manuals.iter().map(|manual| format!("{}(1)", manual.name)).collect();
    page.paragraph(&format!("{}, unigrafix(5)", names.join(", ")));
    page.paragraph(DOCUMENTATION);
    page.text
}

/// The page `unigrafix(5)`: the scene language, from its page in the documentation.
pub fn language(version: &str) -> String {
    let mut page = Page::new("unigrafix", 5, DATE, version);
    page.section("NAME")
        .paragraph("unigrafix - the language of scenes that the ugtools read and write");
    page.section("DESCRIPTION");
    markdown::add(&mut page, include_str!("../../../docs/unigrafix.md"));
    page.section("SEE ALSO").paragraph("ugparse(1), ugtools(7)");
    page.paragraph(DOCUMENTATION);
    page.text
}

/// Adds an option with its explanation.
fn add_option(page: &mut Page, option: &Entry) {
    let names: Vec<String> = option.names.iter().map(|name| bold(name)).collect();
    let values = option.syntax();
    let values = if values.is_empty() { values } else { format!(" \\fI{}\\fR", escaped(&values)) };
    let default = match option.default.as_str() {
        "" => String::new(),
        default => format!(" Default: {default}."),
    };
    page.tagged(
        &format!("{}{values}", names.join(", ")),
        &format!("{}.{default}", option.effect()),
    );
    option.details.iter().for_each(|text| page.continued(text));
    for (word, meaning) in option.words.iter().filter(|(_, meaning)| !meaning.is_empty()) {
        page.continued(&format!("{word}: {meaning}."));
    }
}

/// Adds the section on the exit status.
fn add_exit_status(page: &mut Page) {
    page.section("EXIT STATUS");
    EXIT_STATUS
        .iter()
        .for_each(|(status, meaning)| page.tagged(&bold(status), &format!("{}.", upper(meaning))));
}

fn upper(text: &str) -> String {
    with_first(text, |c| c.to_ascii_uppercase())
}

fn lower(text: &str) -> String {
    with_first(text, |c| c.to_ascii_lowercase())
}

fn with_first(text: &str, change: impl Fn(char) -> char) -> String {
    let mut chars = text.chars();
    chars.next().map(change).into_iter().chain(chars).collect()
}
