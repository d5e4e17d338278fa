//! A page of the documentation as a man page.

use pulldown_cmark::{Event, HeadingLevel, Options, Parser, Tag, TagEnd};

use super::roff::{Page, bold, escaped};

/// Adds a page of Markdown to a man page: parts are sections, headings below them subsections, and
/// the rows of a table paragraphs with their first cell as tag. The title, links and HTML are left
/// out.
pub fn add(page: &mut Page, markdown: &str) {
    let (text, plain) = Default::default();
    let mut writer = Writer { page, text, plain, mark: None, table: None, is_titled: false };
    Parser::new_ext(markdown, Options::ENABLE_TABLES).for_each(|event| writer.event(event));
}

/// What is written, and the state of the text before it is complete.
struct Writer<'p> {
    page: &'p mut Page,
    /// Text of the paragraph or cell so far, escaped.
    text: String,
    /// The same without escapes and fonts, for headings and code.
    plain: String,
    /// The mark of the item of a list that has not been written yet.
    mark: Option<String>,
    table: Option<Table>,
    /// True after the title.
    is_titled: bool,
}

/// A table whose rows are read.
#[derive(Default)]
struct Table {
    head: Vec<String>,
    row: Vec<String>,
}

impl Writer<'_> {
    fn event(&mut self, event: Event<'_>) {
        match event {
            Event::Text(text) => self.push(&escaped(&text), &text),
            Event::Code(code) => self.push(&bold(&code), &code),
            Event::SoftBreak | Event::HardBreak => self.push(" ", " "),
            Event::Start(tag) => self.start(tag),
            Event::End(tag) => self.end(tag),
            _ => {}
        }
    }

    fn push(&mut self, text: &str, plain: &str) {
        self.text += text;
        self.plain += plain;
    }

    fn start(&mut self, tag: Tag<'_>) {
        match tag {
            Tag::Strong => self.text += "\\fB",
            Tag::Emphasis => self.text += "\\fI",
            // What comes before a block in an item.
            Tag::CodeBlock(_) | Tag::List(_) => self.paragraph(),
            Tag::Item => self.mark = Some("\\(bu".to_owned()),
            Tag::Table(_) => self.table = Some(Table::default()),
            _ => {}
        }
    }

    fn end(&mut self, tag: TagEnd) {
        match tag {
            TagEnd::Strong | TagEnd::Emphasis => self.text += "\\fR",
            TagEnd::Paragraph | TagEnd::Item => self.paragraph(),
            TagEnd::Heading(level) => self.heading(level),
            TagEnd::CodeBlock => {
                let code = std::mem::take(&mut self.plain);
                self.page.examples(&code.lines().map(str::to_owned).collect::<Vec<_>>());
                self.text.clear();
            }
            TagEnd::TableCell => {
                let cell = std::mem::take(&mut self.text);
                self.plain.clear();
                self.table.iter_mut().for_each(|table| table.row.push(cell.clone()));
            }
            TagEnd::TableHead => {
                self.table.iter_mut().for_each(|table| table.head = std::mem::take(&mut table.row));
            }
            TagEnd::TableRow => self.row(),
            TagEnd::Table => self.table = None,
            _ => {}
        }
    }

    /// Writes the text as a heading, unless it is the title, which comes first.
    fn heading(&mut self, level: HeadingLevel) {
        let heading = std::mem::take(&mut self.plain);
        self.text.clear();
        if !std::mem::replace(&mut self.is_titled, true) {
            return;
        }
        if level == HeadingLevel::H1 {
            self.page.section(&heading.to_uppercase());
        } else {
            self.page.subsection(&heading);
        }
    }

    /// Writes the text as a paragraph, of a list if it is in one.
    fn paragraph(&mut self) {
        let text = std::mem::take(&mut self.text);
        self.plain.clear();
        if text.trim().is_empty() {
            return;
        }
        match self.mark.take() {
            Some(mark) => self.page.item(&mark, &text),
            None => self.page.escaped_paragraph(&text),
        }
    }

    /// Writes a row of a table.
    fn row(&mut self) {
        let Some(table) = &mut self.table else { return };
        let row = std::mem::take(&mut table.row);
        let Some((tag, cells)) = row.split_first() else { return };
        // The first cell after the tag explains it; others are named by the heads of their columns.
        let cells = table.head.iter().skip(1).zip(cells).enumerate();
        let told: Vec<String> = cells
            .filter(|(_, (_, cell))| !cell.is_empty())
            .map(
                |(idx, (head, cell))| {
                    if idx == 0 { cell.clone() } else { format!("{head}: {cell}") }
                },
            )
            .collect();
        self.page.escaped_tagged(tag, &told.join("; "));
    }
}
