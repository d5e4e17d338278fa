//! Man pages, in the macros of man(7).

use std::fmt::Write;

use super::markdown;
use ugpipe::{DASHES, DOCUMENTATION, EXIT_STATUS, Entry, Manual};

/// Date of the last change to the words in this file; pages have to have one.
const DATE: &str = "2026-11-24";

/// The page of a program.
pub fn page(manual: &Manual) -> String {
    let mut page = Page::new(&manual.name, 1, &manual.version);
    page.section("NAME").paragraph(&format!("{} - {}", manual.name, lower(&manual.about)));
    page.section("SYNOPSIS").paragraph(&manual.usage);
    page.section("DESCRIPTION").paragraph(&format!("{}.", manual.about));
    manual.description.iter().for_each(|text| page.paragraph(text));
    if !manual.commands.is_empty() {
        page.section("COMMANDS");
        for command in &manual.commands {
            page.tagged(&bold(&command.usage), &format!("{}.", command.about));
            let own =
                command.options().filter(|option| manual.options().all(|other| other.names != option.names));
            let own: Vec<String> =
                own.map(|option| format!("{}: {}.", option.names.join(", "), option.about)).collect();
            own.iter().for_each(|text| page.continued(text));
        }
    }
    page.section("OPTIONS").paragraph(DASHES);
    for group in &manual.groups {
        page.subsection(&group.heading);
        group.options.iter().for_each(|option| page.option(option));
    }
    page.section("EXAMPLES").examples(&manual.examples);
    page.exit_status();
    page.section("SEE ALSO").paragraph("ugtools(7), unigrafix(5)");
    page.paragraph(DOCUMENTATION);
    page.text
}

/// The page `ugtools(7)`: what the programs are, and how they work together.
pub fn overview(manuals: &[Manual]) -> String {
    let version = manuals.first().map_or("", |manual| &manual.version);
    let mut page = Page::new("ugtools", 7, version);
    page.section("NAME").paragraph("ugtools - draw what things look like near the speed of light");
    page.section("DESCRIPTION").paragraph(
        "These programs are filters that pass scenes on as text, in the UniGrafix language. uglorentz \
         computes shapes as seen in relativistic motion, ugdoppler colours and brightness, and ugrainbow draws \
         the picture. So a velocity is given once, to the first program. ugphoton traces rays: it reads a scene \
         at rest and draws it with mirrors, glass and shadows, without the others. ugwarp shows a 360-degree panorama \
         as a fast traveller sees it.",
    );
    page.paragraph(
        "Without ugdoppler bodies keep the colours that they have at rest. ugdoppler -sp shifts whole spectra, \
         and ugrainbow -ex auto sets the exposure.",
    );
    page.section("PROGRAMS");
    for manual in manuals {
        page.tagged(&format!("{}(1)", bold(&manual.name)), &format!("{}.", manual.about));
    }
    page.section("EXAMPLES").paragraph("Scenes to begin with:");
    page.examples(&["ugparse example --all".to_owned()]);
    page.paragraph("At rest; at 0.9c, shape only; approaching at 0.5c, with colours:");
    page.examples(&[
        "ugrainbow ship.ug > rest.png".to_owned(),
        "uglorentz -vel .9 0 0 --keep-in-view ship.ug | ugrainbow > shape.png".to_owned(),
        "uglorentz -vel 0 -.5 0 --keep-in-view ship.ug | ugdoppler -sp | ugrainbow -ex auto > blue.png"
            .to_owned(),
    ]);
    page.paragraph("A mesh of your own (OBJ, PLY, STL, OFF or glTF):");
    page.examples(&[
        "ugmesh globe.obj | uglorentz -vel .9 0 0 --keep-in-view | ugrainbow > globe.png".to_owned()
    ]);
    page.exit_status();
    page.section("SEE ALSO");
    let names: Vec<String> = manuals.iter().map(|manual| format!("{}(1)", manual.name)).collect();
    page.paragraph(&format!("{}, unigrafix(5)", names.join(", ")));
    page.paragraph(DOCUMENTATION);
    page.text
}

/// The page `unigrafix(5)`: the scene language, from its page in the documentation.
pub fn language(version: &str) -> String {
    let mut page = Page::new("unigrafix", 5, version);
    page.section("NAME").paragraph("unigrafix - the language of scenes that the ugtools read and write");
    page.section("DESCRIPTION");
    markdown::add(&mut page, include_str!("../../../docs/unigrafix.md"));
    page.section("SEE ALSO").paragraph("ugparse(1), ugtools(7)");
    page.paragraph(DOCUMENTATION);
    page.text
}

/// A page that is being written.
pub(super) struct Page {
    pub text: String,
}

impl Page {
    pub fn new(name: &str, section: u8, version: &str) -> Self {
        let title = format!(".TH {} {section} {DATE} \"ugtools {version}\"\n", name.to_uppercase());
        Self { text: title }
    }

    pub fn section(&mut self, heading: &str) -> &mut Self {
        self.request(".SH", heading)
    }

    pub fn subsection(&mut self, heading: &str) -> &mut Self {
        self.request(".SS", heading)
    }

    fn request(&mut self, request: &str, words: &str) -> &mut Self {
        let _ = writeln!(self.text, "{request} {}", escaped(words));
        self
    }

    /// A paragraph; the first of a section begins by itself.
    pub fn paragraph(&mut self, text: &str) {
        self.escaped_paragraph(&escaped(text));
    }

    /// A paragraph of escaped text.
    pub fn escaped_paragraph(&mut self, text: &str) {
        let is_first = self.text.lines().next_back().is_some_and(|line| line.starts_with(".S"));
        if !is_first {
            self.text += ".PP\n";
        }
        self.fill_escaped(text);
    }

    /// An item of a list, of escaped text.
    pub fn item(&mut self, mark: &str, text: &str) {
        let _ = writeln!(self.text, ".IP {mark} 4");
        self.fill_escaped(text);
    }

    /// A line with its explanation. `tag` is escaped.
    pub fn tagged(&mut self, tag: &str, text: &str) {
        self.escaped_tagged(tag, &escaped(text));
    }

    /// A line with its explanation, both escaped.
    pub fn escaped_tagged(&mut self, tag: &str, text: &str) {
        let _ = writeln!(self.text, ".TP\n{tag}");
        self.fill_escaped(text);
    }

    /// Another paragraph of an explanation.
    pub fn continued(&mut self, text: &str) {
        self.text += ".IP\n";
        self.fill(text);
    }

    fn option(&mut self, option: &Entry) {
        let names: Vec<String> = option.names.iter().map(|name| bold(name)).collect();
        let values = option.syntax();
        let values = if values.is_empty() { values } else { format!(" \\fI{}\\fR", escaped(&values)) };
        let default = match option.default.as_str() {
            "" => String::new(),
            default => format!(" Default: {default}."),
        };
        let is_told = option.words.iter().all(|(word, _)| option.about.contains(word.as_str()));
        let words: Vec<&str> = option.words.iter().map(|(word, _)| word.as_str()).collect();
        let words = if is_told { String::new() } else { format!(": {}", words.join(", ")) };
        self.tagged(&format!("{}{values}", names.join(", ")), &format!("{}{words}.{default}", option.about));
        option.details.iter().for_each(|text| self.continued(text));
        for (word, meaning) in option.words.iter().filter(|(_, meaning)| !meaning.is_empty()) {
            self.continued(&format!("{word}: {meaning}."));
        }
    }

    /// Command lines as they are.
    pub fn examples(&mut self, lines: &[String]) {
        self.text += ".RS 2\n.EX\n";
        lines.iter().for_each(|line| self.line(&escaped(line)));
        self.text += ".EE\n.RE\n";
    }

    fn exit_status(&mut self) {
        self.section("EXIT STATUS");
        EXIT_STATUS
            .iter()
            .for_each(|(status, meaning)| self.tagged(&bold(status), &format!("{}.", upper(meaning))));
    }

    /// Text that is filled, in lines of less than 80 columns.
    fn fill(&mut self, text: &str) {
        self.fill_escaped(&escaped(text));
    }

    /// The same of escaped text.
    fn fill_escaped(&mut self, text: &str) {
        const WIDTH: usize = 72;
        let mut line = String::new();
        for word in text.split_whitespace() {
            if !line.is_empty() && line.len() + word.len() >= WIDTH {
                self.line(&line);
                line.clear();
            }
            line += if line.is_empty() { "" } else { " " };
            line += word;
        }
        self.line(&line);
    }

    /// An escaped line, which is text even if it begins like a request.
    fn line(&mut self, line: &str) {
        let guard = if line.starts_with(['.', '\'']) { "\\&" } else { "" };
        let _ = writeln!(self.text, "{guard}{line}");
    }
}

pub(super) fn bold(text: &str) -> String {
    format!("\\fB{}\\fR", escaped(text))
}

/// Text without anything that the formatter would obey or change.
pub(super) fn escaped(text: &str) -> String {
    let mut escaped = String::new();
    for c in text.chars() {
        match c {
            '\\' => escaped += "\\e",
            '-' => escaped += "\\-",
            '\'' => escaped += "\\(aq",
            '`' => escaped += "\\(ga",
            '^' => escaped += "\\(ha",
            '~' => escaped += "\\(ti",
            c if c.is_ascii() => escaped.push(c),
            c => escaped += &format!("\\[u{:04X}]", u32::from(c)),
        }
    }
    escaped
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
