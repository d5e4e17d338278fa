//! Text in the macros of man(7).

use std::fmt::Write;

/// A page that is being written.
pub struct Page {
    pub text: String,
}

impl Page {
    /// A page with its title line, of a section of the manual, changed last on `date`.
    pub fn new(name: &str, section: u8, date: &str, version: &str) -> Self {
        let title = format!(".TH {} {section} {date} \"ugtools {version}\"\n", name.to_uppercase());
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

    /// Command lines as they are.
    pub fn examples(&mut self, lines: &[String]) {
        self.text += ".RS 2\n.EX\n";
        lines.iter().for_each(|line| self.line(&escaped(line)));
        self.text += ".EE\n.RE\n";
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

pub fn bold(text: &str) -> String {
    format!("\\fB{}\\fR", escaped(text))
}

/// Text without anything that the formatter would obey or change.
pub fn escaped(text: &str) -> String {
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
