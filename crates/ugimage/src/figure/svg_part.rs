//! SVG files as parts of a sheet.

use std::collections::HashMap;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};

use super::part_error::PartError;
use super::{Point, number};

/// An SVG file as an element of another one.
///
/// It becomes a nested `svg` element. Its ids get a prefix, so that they differ from those of other
/// parts. A file with scripts, animations or style sheets, which would affect the whole sheet,
/// becomes an `image` element with the file as its data.
#[derive(Clone, Debug)]
pub struct SvgPart {
    size: [f64; 2],
    content: SvgContent,
}

#[derive(Clone, Debug)]
enum SvgContent {
    /// The name of the root element, its attributes except place and size, and the rest of the
    /// file to the end tag.
    Nested { name: String, attributes: String, rest: String },
    /// The whole file.
    Isolated(Vec<u8>),
}

impl SvgPart {
    /// Reads a file. `prefix`: of its ids.
    ///
    /// # Errors
    /// The file is invalid, has entities of its own, or has no size.
    pub fn read(file: &[u8], prefix: &str) -> Result<Self, PartError> {
        let text = std::str::from_utf8(file).map_err(|_| PartError::NotText)?;
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        if text.contains(|c: char| c.is_control() && !is_blank(c) || !is_character(c)) {
            return Err(xml("a control character"));
        }
        let mut reader = Reader::from_str(text);
        let root = root(&mut reader)?;
        let (start, is_empty) = match &root {
            Event::Empty(start) => (start, true),
            Event::Start(start) => (start, false),
            _ => return Err(PartError::NoSvg),
        };
        if start.local_name().as_ref() != "svg" {
            return Err(PartError::NoSvg);
        }
        let size = size(start)?;
        let mut rewriter =
            Rewriter { prefix, out: String::new(), needs_isolation: false, spaces: HashMap::new() };
        rewriter.declare(start)?;
        rewriter.check_name(start.name().as_ref())?;
        rewriter.attributes(start, |key| matches!(key, "x" | "y" | "width" | "height"))?;
        let attributes = std::mem::take(&mut rewriter.out);
        let name = start.name().as_ref().to_owned();
        if is_empty {
            rewriter.out = format!("</{name}>");
        } else {
            rewriter.content(&mut reader)?;
        }
        end(&mut reader)?;
        let content = if rewriter.needs_isolation {
            SvgContent::Isolated(text.as_bytes().to_vec())
        } else {
            SvgContent::Nested { name, attributes, rest: rewriter.out }
        };
        Ok(Self { size, content })
    }

    /// Its width and height, in user units.
    pub fn size(&self) -> [f64; 2] {
        self.size
    }

    /// The element with its upper left corner at a place.
    pub(super) fn element(&self, place: Point) -> String {
        let ([x, y], [width, height]) = (place.map(number), self.size.map(number));
        let place = format!("x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\"");
        match &self.content {
            SvgContent::Nested { name, attributes, rest } => {
                format!("<{name} {place}{attributes}>{rest}\n")
            }
            SvgContent::Isolated(file) => {
                let data = STANDARD.encode(file);
                format!("<image {place} href=\"data:image/svg+xml;base64,{data}\"/>\n")
            }
        }
    }
}

fn xml(error: impl ToString) -> PartError {
    PartError::Xml(error.to_string())
}

/// The first tag.
fn root<'t>(reader: &mut Reader<&'t [u8]>) -> Result<Event<'t>, PartError> {
    loop {
        match reader.read_event().map_err(xml)? {
            Event::DocType(text) if text.contains('[') => return Err(PartError::Entities),
            Event::Decl(_) | Event::PI(_) | Event::Comment(_) | Event::DocType(_) => {}
            Event::Text(text) if text.trim().is_empty() => {}
            tag @ (Event::Start(_) | Event::Empty(_)) => return Ok(tag),
            _ => return Err(PartError::NoSvg),
        }
    }
}

/// Reads what follows the root element.
fn end(reader: &mut Reader<&[u8]>) -> Result<(), PartError> {
    loop {
        match reader.read_event().map_err(xml)? {
            Event::Eof => return Ok(()),
            Event::PI(_) | Event::Comment(_) => {}
            Event::Text(text) if text.trim().is_empty() => {}
            _ => return Err(xml("something follows the root element")),
        }
    }
}

/// Copies elements with other ids.
struct Rewriter<'p> {
    prefix: &'p str,
    out: String,
    needs_isolation: bool,
    /// Namespace prefixes, each with the number of open elements that declare it.
    spaces: HashMap<String, usize>,
}

impl Rewriter<'_> {
    /// Copies everything up to the end tag of the root element.
    fn content(&mut self, reader: &mut Reader<&[u8]>) -> Result<(), PartError> {
        let mut depth = 1;
        // The text of the style sheet that is being read.
        let mut style: Option<String> = None;
        // The prefixes that each open element declares.
        let mut declared = Vec::new();
        while depth > 0 {
            let event = reader.read_event().map_err(xml)?;
            match event {
                Event::Start(tag) => {
                    depth += 1;
                    declared.push(self.declare(&tag)?);
                    self.tag(&tag, ">")?;
                    style = is_style(&tag).then(String::new);
                }
                Event::Empty(tag) => {
                    let declared = self.declare(&tag)?;
                    self.tag(&tag, "/>")?;
                    self.forget(&declared);
                }
                Event::End(tag) => {
                    depth -= 1;
                    self.out += &format!("</{}>", tag.name().as_ref());
                    self.forget(&declared.pop().unwrap_or_default());
                    self.needs_isolation |= style.take().is_some_and(|text| !has_only_fonts(&text));
                }
                Event::Text(text) if text.contains("]]>") => return Err(xml("`]]>` in text")),
                Event::Text(text) => self.text(&text, "", "", &mut style),
                Event::CData(text) => self.text(&text, "<![CDATA[", "]]>", &mut style),
                Event::GeneralRef(name) => {
                    check_reference(&name)?;
                    self.text(&name, "&", ";", &mut style);
                }
                // Viewers may be told to load style sheets by them.
                Event::PI(_) => self.needs_isolation = true,
                Event::Comment(_) => {}
                Event::Decl(_) | Event::DocType(_) => return Err(xml("a declaration inside an element")),
                Event::Eof => return Err(xml("the file ends before its root element does")),
            }
        }
        Ok(())
    }

    /// Adds the prefixes that an element declares, and returns them.
    fn declare(&mut self, tag: &BytesStart<'_>) -> Result<Vec<String>, PartError> {
        let mut declared = Vec::new();
        for attribute in tag.attributes().with_checks(false) {
            if let Some(prefix) = attribute.map_err(xml)?.key.as_ref().strip_prefix("xmlns:") {
                *self.spaces.entry(prefix.to_owned()).or_default() += 1;
                declared.push(prefix.to_owned());
            }
        }
        Ok(declared)
    }

    /// Removes the prefixes of an element that ends.
    fn forget(&mut self, declared: &[String]) {
        for prefix in declared {
            if let Some(count) = self.spaces.get_mut(prefix) {
                *count -= 1;
            }
        }
    }

    /// Fails if this is no name, or its prefix is not declared: then nothing of the sheet would be
    /// shown.
    fn check_name(&self, name: &str) -> Result<(), PartError> {
        let (prefix, local) = name.split_once(':').unwrap_or(("xml", name));
        if !is_name(prefix) || !is_name(local) {
            return Err(xml("an invalid name"));
        }
        let is_declared =
            ["xml", "xmlns"].contains(&prefix) || self.spaces.get(prefix).is_some_and(|&n| n > 0);
        if is_declared { Ok(()) } else { Err(xml("a prefix of a name is not declared")) }
    }

    fn text(&mut self, text: &str, before: &str, after: &str, style: &mut Option<String>) {
        for part in [before, text, after] {
            self.out += part;
        }
        if let Some(style) = style {
            *style += text;
        }
    }

    fn tag(&mut self, tag: &BytesStart<'_>, end: &str) -> Result<(), PartError> {
        /// Elements that run, or that refer to others by events.
        const ACTIVE: [&str; 6] =
            ["script", "animate", "set", "animateMotion", "animateTransform", "foreignObject"];
        self.needs_isolation |= ACTIVE.contains(&tag.local_name().as_ref());
        self.check_name(tag.name().as_ref())?;
        self.out += &format!("<{}", tag.name().as_ref());
        self.attributes(tag, |_| false)?;
        self.out += end;
        Ok(())
    }

    /// Copies attributes, except those of some names.
    fn attributes(
        &mut self,
        tag: &BytesStart<'_>,
        is_left_out: impl Fn(&str) -> bool,
    ) -> Result<(), PartError> {
        for attribute in tag.attributes() {
            let attribute = attribute.map_err(xml)?;
            let (key, value) = (attribute.key.as_ref(), &*attribute.value);
            self.check_name(key)?;
            check_value(value)?;
            if is_left_out(key) {
                continue;
            }
            self.needs_isolation |= key.starts_with("on");
            let value = match key {
                "id" | "xml:id" => format!("{}{value}", self.prefix),
                _ if key == "href" || key.ends_with(":href") => match value.strip_prefix('#') {
                    Some(id) => format!("#{}{id}", self.prefix),
                    None => value.to_owned(),
                },
                _ => with_prefix(value, self.prefix),
            };
            let quote = if value.contains('"') { '\'' } else { '"' };
            self.out += &format!(" {key}={quote}{value}{quote}");
        }
        Ok(())
    }
}

/// Line ends and tabs: control characters that XML has.
fn is_blank(c: char) -> bool {
    matches!(c, '\n' | '\r' | '\t')
}

/// True for the characters that XML 1.0 has.
fn is_character(c: char) -> bool {
    is_blank(c) || c >= ' ' && !matches!(c, '\u{fffe}' | '\u{ffff}')
}

/// True for a name without prefix (XML 1.0, productions 4 and 5).
fn is_name(name: &str) -> bool {
    let is_start = |c: char| {
        matches!(c,
            'A'..='Z' | '_' | 'a'..='z' | '\u{c0}'..='\u{d6}' | '\u{d8}'..='\u{f6}' | '\u{f8}'..='\u{2ff}'
            | '\u{370}'..='\u{37d}' | '\u{37f}'..='\u{1fff}' | '\u{200c}' | '\u{200d}'
            | '\u{2070}'..='\u{218f}' | '\u{2c00}'..='\u{2fef}' | '\u{3001}'..='\u{d7ff}'
            | '\u{f900}'..='\u{fdcf}' | '\u{fdf0}'..='\u{fffd}' | '\u{10000}'..='\u{effff}')
    };
    let is_inner = |c: char| {
        is_start(c)
            || matches!(c, '-' | '.' | '0'..='9' | '\u{b7}' | '\u{300}'..='\u{36f}' | '\u{203f}' | '\u{2040}')
    };
    name.starts_with(is_start) && name.chars().all(is_inner)
}

/// Fails if a reference `&name;` is not one that every XML file has.
fn check_reference(name: &str) -> Result<(), PartError> {
    let code = |digits: &str| match digits.strip_prefix('x') {
        Some(digits) => u32::from_str_radix(digits, 16),
        None => digits.parse(),
    };
    match name.strip_prefix('#') {
        Some(digits) if digits.contains('+') => Err(xml("an invalid character reference")),
        Some(digits) => match code(digits).ok().and_then(char::from_u32) {
            Some(c) if is_character(c) => Ok(()),
            _ => Err(xml("an invalid character reference")),
        },
        None if ["lt", "gt", "amp", "quot", "apos"].contains(&name) => Ok(()),
        None => Err(PartError::Entities),
    }
}

/// Fails if the value of an attribute has what would end it for another reader.
fn check_value(value: &str) -> Result<(), PartError> {
    if value.contains('<') {
        return Err(xml("`<` in an attribute"));
    }
    for part in value.split('&').skip(1) {
        let (name, _) = part.split_once(';').ok_or_else(|| xml("`&` without `;` in an attribute"))?;
        check_reference(name)?;
    }
    Ok(())
}

/// A value in which each id of `url(#id)` has a prefix.
fn with_prefix(value: &str, prefix: &str) -> String {
    let mut out = String::with_capacity(value.len());
    for (idx, part) in value.split("url(").enumerate() {
        if idx == 0 {
            out += part;
            continue;
        }
        out += "url(";
        let mut id = part.trim_start();
        for quote in ["\"", "'", "&quot;", "&apos;", "&#34;", "&#39;"] {
            id = id.strip_prefix(quote).unwrap_or(id);
        }
        let before = &part[..part.len() - id.len()];
        match id.strip_prefix('#') {
            Some(id) => out += &format!("{before}#{prefix}{id}"),
            None => out += part,
        }
    }
    out
}

fn is_style(tag: &BytesStart<'_>) -> bool {
    tag.local_name().as_ref() == "style"
}

/// True if a style sheet has nothing but embedded fonts, which affect other parts only if they
/// have the same name.
fn has_only_fonts(style: &str) -> bool {
    style.split('}').all(|rule| {
        let rule = rule.trim();
        rule.is_empty()
            || rule.strip_prefix("@font-face").is_some_and(|rest| rest.trim_start().starts_with('{'))
    })
}

/// Width and height in user units: the attributes, otherwise the sides of the `viewBox`.
fn size(root: &BytesStart<'_>) -> Result<[f64; 2], PartError> {
    let value = |key: &str| {
        let found = root
            .attributes()
            .with_checks(false)
            .filter_map(Result::ok)
            .find(|attribute| attribute.key.as_ref() == key);
        found.map(|attribute| attribute.value.into_owned())
    };
    let view = value("viewBox").and_then(|text| {
        let parts = text.split([' ', ',', '\t', '\n']).filter(|part| !part.is_empty());
        let numbers: Vec<f64> = parts.map(|part| part.parse().ok()).collect::<Option<_>>()?;
        <[f64; 4]>::try_from(numbers).ok()
    });
    let side = |key: &str, idx: usize| value(key).and_then(|text| length(&text)).or_else(|| Some(view?[idx]));
    let size = side("width", 2).zip(side("height", 3)).ok_or(PartError::NoSize)?;
    let size = [size.0, size.1];
    // Larger ones cannot be on a sheet.
    if size.iter().all(|&side| 0.0 < side && side <= 1e9) { Ok(size) } else { Err(PartError::NoSize) }
}

/// A length in user units, 1/96 inch; `None` if it is relative.
fn length(text: &str) -> Option<f64> {
    const UNITS: [(&str, f64); 7] = [
        ("px", 1.0),
        ("pt", 96.0 / 72.0),
        ("pc", 16.0),
        ("in", 96.0),
        ("mm", 96.0 / 25.4),
        ("cm", 96.0 / 2.54),
        ("", 1.0),
    ];
    let text = text.trim();
    UNITS.iter().find_map(|(unit, scale)| Some(text.strip_suffix(unit)?.parse::<f64>().ok()? * scale))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn element(file: &str) -> Result<String, PartError> {
        Ok(SvgPart::read(file.as_bytes(), "p-")?.element([3.0, 4.0]))
    }

    #[test]
    fn ids_and_what_refers_to_them_get_a_prefix() {
        let file = "<?xml version='1.0'?><!DOCTYPE svg PUBLIC 'x' 'y'>\n<svg id='r' xmlns:xlink='l' width='10' \
                    height='20'><defs><g id=\"a\"/></defs><use xlink:href='#a' fill='url(#b)'/><a href='x#y'/>\
                    <path style='fill:url( &quot;#c&quot; );stroke:url(#d)'/>a &lt; &#98;</svg>";
        let expected = "<svg x=\"3\" y=\"4\" width=\"10\" height=\"20\" id=\"p-r\" xmlns:xlink=\"l\"><defs>\
                        <g id=\"p-a\"/></defs><use xlink:href=\"#p-a\" fill=\"url(#p-b)\"/><a href=\"x#y\"/>\
                        <path style=\"fill:url( &quot;#p-c&quot; );stroke:url(#p-d)\"/>a &lt; &#98;</svg>\n";
        assert_eq!(element(file).unwrap(), expected);
    }

    #[test]
    fn what_affects_the_whole_sheet_is_isolated() {
        let file = |content: &str| format!("<svg width='10' height='20'>{content}</svg>");
        let is_isolated = |content: &str| element(&file(content)).unwrap().starts_with("<image ");
        for content in
            ["<style>*{fill:red}</style>", "<script/>", "<g onclick='f()'/>", "<style>@import 'x';</style>"]
        {
            assert!(is_isolated(content), "{content}");
        }
        for content in ["<style>@font-face{font-family:\"a\";src:url(b)}</style>", "<g/>", "<style/>"] {
            assert!(!is_isolated(content), "{content}");
        }
    }

    #[test]
    fn sizes_are_in_user_units() {
        let size = |attributes: &str| {
            SvgPart::read(format!("<svg {attributes}/>").as_bytes(), "").map(|part| part.size())
        };
        assert_eq!(size("width='72pt' height='1in'"), Ok([96.0, 96.0]));
        assert_eq!(size("width='25.4mm' height='10px'"), Ok([96.0, 10.0]));
        assert_eq!(size("viewBox='1,2 30 40'"), Ok([30.0, 40.0]));
        assert_eq!(size("width='100%' height='7' viewBox='0 0 30 40'"), Ok([30.0, 7.0]));
        for bad in
            ["", "width='5'", "width='0' height='1'", "width='nan' height='1'", "width='1e300' height='1'"]
        {
            assert_eq!(size(bad), Err(PartError::NoSize), "{bad}");
        }
    }

    #[test]
    fn invalid_files_are_refused() {
        let bomb = "<!DOCTYPE svg [<!ENTITY a 'aaaa'>]><svg width='1' height='1'>&a;</svg>";
        for (file, expected) in [
            (bomb, PartError::Entities),
            ("<svg width='1' height='1'>&a;</svg>", PartError::Entities),
            ("<svg width='1' height='1'><g a='&a;'/></svg>", PartError::Entities),
            ("<html/>", PartError::NoSvg),
            ("", PartError::NoSvg),
            ("text", PartError::NoSvg),
        ] {
            assert_eq!(element(file).err(), Some(expected), "{file}");
        }
        for file in [
            "<svg width='1' height='1'>",
            "<svg width='1' height='1'><g></svg>",
            "<svg width='1' height='1'/>x",
            "<svg width='1' height='1'><g a='<'/></svg>",
            "<svg width='1' height='1'><g a='1 & 2'/></svg>",
            "<svg width='1' height='1'><g a='1' a='2'/></svg>",
            "<svg width='1' height='1'><a\"b/></svg>",
            "<svg width='1' height='1'><g a,b='1'/></svg>",
            "<svg width='1' height='1'>&#0;</svg>",
            "<svg width='1' height='1'>]]></svg>",
            "<svg width='1' height='1'>\u{ffff}</svg>",
            "<svg width='1' height='1'><x:g/></svg>",
            "<svg width='1' height='1'><g xmlns:x='y'/><g x:a='1'/></svg>",
        ] {
            assert!(matches!(element(file), Err(PartError::Xml(_))), "{file}");
        }
        assert_eq!(SvgPart::read(b"<svg \xff/>", "").err(), Some(PartError::NotText));
    }
}
