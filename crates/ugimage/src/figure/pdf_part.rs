//! PDF files as parts of a sheet.
//!
//! A page becomes a form: its content is copied as it is, without decompression, so memory and time
//! are proportional to the file.

use std::cell::Cell;
use std::collections::HashMap;

use pdf_writer::{Chunk, Name, Rect, Ref};

use super::part_error::PartError;
use super::pdf_object::{Entries, Object, Objects, entry, single, write_entries};

/// Most sections of the table of objects, one for each time that the file was changed.
const MAX_SECTIONS: usize = 256;

/// Greatest depth of the tree of pages, and most references from one object to the next.
const MAX_LEVELS: usize = 32;

/// Bytes of objects and tables that are read, in units of the file: those of a valid file are read
/// about twice. Objects within each other, and tables and pages in a circle, would be read often.
const MAX_READS: usize = 4;

/// The entries of pages that are used.
const OF_PAGES: [&str; 7] = ["CropBox", "MediaBox", "Rotate", "UserUnit", "Contents", "Resources", "Group"];

/// A PDF file as a form of another one.
#[derive(Clone, Debug)]
pub struct PdfPart<'f> {
    file: File<'f>,
    /// Left, bottom, right, top of the page, in its units.
    bounds: [f64; 4],
    /// Points per unit.
    unit: f64,
    /// The object with the content of the page.
    content: u32,
    resources: Object,
    /// The transparency group of the page.
    group: Object,
}

impl<'f> PdfPart<'f> {
    /// Reads a file.
    ///
    /// # Errors
    /// The file is invalid, encrypted or compressed, or has several pages or parts of a page.
    pub fn read(bytes: &'f [u8]) -> Result<Self, PartError> {
        let file = File::read(bytes)?;
        let page = file.page()?;
        let bounds = [page.inherited("CropBox"), page.inherited("MediaBox")];
        let bounds = bounds.into_iter().find_map(|object| file.numbers(object)).ok_or(PartError::NoSize)?;
        let [x0, y0, x1, y1] = bounds;
        let bounds = [x0.min(x1), y0.min(y1), x0.max(x1), y0.max(y1)];
        let rotation = match file.resolved(page.inherited("Rotate").clone())? {
            Object::Number(degrees) => degrees % 360.0,
            _ => 0.0,
        };
        let unit = match file.resolved(entry(page.own(), "UserUnit").clone())? {
            Object::Number(unit) => unit,
            _ => 1.0,
        };
        let content = match entry(page.own(), "Contents") {
            Object::Ref(number) => match file.object(*number)? {
                Indirect::Object(Object::Array(parts)) => parts,
                _ => vec![Object::Ref(*number)],
            },
            Object::Array(parts) => parts.clone(),
            _ => Vec::new(),
        };
        let &[Object::Ref(content)] = content.as_slice() else { return Err(PartError::UnusualPage) };
        if rotation != 0.0 {
            return Err(PartError::UnusualPage);
        }
        let resources = page.inherited("Resources").clone();
        let group = entry(page.own(), "Group").clone();
        let part = Self { file, bounds, unit, content, resources, group };
        let fits = part.size().iter().all(|&side| 0.0 < side && side <= 1e9);
        if fits { Ok(part) } else { Err(PartError::NoSize) }
    }

    /// Its width and height in points.
    pub fn size(&self) -> [f64; 2] {
        let [left, bottom, right, top] = self.bounds;
        [(right - left) * self.unit, (top - bottom) * self.unit]
    }

    /// Left and bottom of the page, in its units, and points per unit.
    pub(super) fn frame(&self) -> ([f64; 2], f64) {
        ([self.bounds[0], self.bounds[1]], self.unit)
    }

    /// Writes the form and all objects that it needs. `id`: of the form. `new_ref` returns the id
    /// of another object.
    pub(super) fn write(
        &self,
        chunk: &mut Chunk,
        id: Ref,
        mut new_ref: impl FnMut() -> Ref,
    ) -> Result<(), PartError> {
        let mut ids = HashMap::new();
        // Objects with an id that are not written yet.
        let mut waiting = Vec::new();
        let mut map = |number: u32, waiting: &mut Vec<u32>| {
            *ids.entry(number).or_insert_with(|| {
                waiting.push(number);
                new_ref()
            })
        };
        let Indirect::Stream(entries, data) = self.file.object(self.content)? else {
            return Err(PartError::Pdf("the content of the page"));
        };
        let mut form = chunk.stream(id, data);
        write_entries(&encoding(entries), &mut form, &mut |number| map(number, &mut waiting));
        form.pair(Name(b"Type"), Name(b"XObject")).pair(Name(b"Subtype"), Name(b"Form"));
        let [left, bottom, right, top] = self.bounds.map(single);
        form.pair(Name(b"BBox"), Rect::new(left, bottom, right, top));
        for (key, object) in [("Resources", &self.resources), ("Group", &self.group)] {
            if *object != Object::Null {
                object.write(form.insert(Name(key.as_bytes())), &mut |number| map(number, &mut waiting));
            }
        }
        drop(form);
        while let Some(number) = waiting.pop() {
            let id = map(number, &mut waiting);
            match self.file.object(number)? {
                Indirect::Stream(entries, data) => {
                    let mut stream = chunk.stream(id, data);
                    let entries = entries.into_iter().filter(|(key, _)| key != b"Length").collect();
                    write_entries(&entries, &mut stream, &mut |number| map(number, &mut waiting));
                }
                // A page refers to all others, which a form must not contain.
                Indirect::Object(object) if is_page(&object) => {
                    Object::Null.write(chunk.indirect(id), &mut |_| id)
                }
                Indirect::Object(object) => {
                    object.write(chunk.indirect(id), &mut |number| map(number, &mut waiting));
                }
            }
        }
        Ok(())
    }
}

fn is_page(object: &Object) -> bool {
    let Object::Dict(entries) = object else { return false };
    matches!(entry(entries, "Type"), Object::Name(name) if name == b"Page" || name == b"Pages" || name == b"Catalog")
}

/// The entries of a stream that say how its data are encoded.
fn encoding(entries: Entries) -> Entries {
    entries.into_iter().filter(|(key, _)| key == b"Filter" || key == b"DecodeParms").collect()
}

/// A file whose objects can be found.
#[derive(Clone, Debug)]
struct File<'f> {
    bytes: &'f [u8],
    /// Where each object begins.
    places: HashMap<u32, usize>,
    root: Object,
    /// Bytes that may still be read.
    left: Cell<usize>,
}

/// An object with a number.
enum Indirect<'f> {
    Object(Object),
    /// A dictionary and data, encoded.
    Stream(Entries, &'f [u8]),
}

/// The dictionaries from the root of the tree of pages to a page.
struct Page(Vec<Entries>);

impl Page {
    /// The dictionary of the page.
    fn own(&self) -> &Entries {
        static NONE: Entries = Vec::new();
        self.0.last().unwrap_or(&NONE)
    }

    /// An entry of the page or of the nearest node above it.
    fn inherited(&self, key: &str) -> &Object {
        let values = self.0.iter().rev().map(|entries| entry(entries, key));
        values.into_iter().find(|value| **value != Object::Null).unwrap_or(&Object::Null)
    }
}

impl<'f> File<'f> {
    fn read(bytes: &'f [u8]) -> Result<Self, PartError> {
        const MARK: &[u8] = b"startxref";
        let tail = bytes.len().saturating_sub(2048);
        let at = bytes[tail..].windows(MARK.len()).rposition(|window| window == MARK);
        let at = at.ok_or(PartError::Pdf("no `startxref` at its end"))?;
        let place = Objects::new(bytes, tail + at + MARK.len()).count();
        let mut next = Some(place.ok_or(PartError::Pdf("the place of its table"))? as usize);
        let left = Cell::new(bytes.len().saturating_mul(MAX_READS));
        let mut file = Self { bytes, places: HashMap::new(), root: Object::Null, left };
        let mut n_sections = 0;
        while let Some(place) = next {
            n_sections += 1;
            if n_sections > MAX_SECTIONS {
                return Err(PartError::Pdf("its table, which has too many sections"));
            }
            let trailer = file.read_section(place)?;
            if *entry(&trailer, "Encrypt") != Object::Null {
                return Err(PartError::Encrypted);
            }
            if *entry(&trailer, "XRefStm") != Object::Null {
                return Err(PartError::Compressed);
            }
            if file.root == Object::Null {
                file.root = entry(&trailer, "Root").clone();
            }
            next = match entry(&trailer, "Prev") {
                Object::Number(place) if *place >= 0.0 => Some(*place as usize),
                _ => None,
            };
        }
        Ok(file)
    }

    /// Reads a section of the table of objects, and its trailer. Earlier sections are newer.
    fn read_section(&mut self, place: usize) -> Result<Entries, PartError> {
        const INVALID: PartError = PartError::Pdf("its table of objects");
        let mut objects = Objects::new(self.bytes, place);
        if !objects.has("xref") {
            let is_object = objects.count().is_some() && objects.count().is_some() && objects.has("obj");
            return Err(if is_object { PartError::Compressed } else { INVALID });
        }
        while !objects.has("trailer") {
            let (first, count) = objects.count().zip(objects.count()).ok_or(INVALID)?;
            for step in 0..count {
                let (place, _) = objects.count().zip(objects.count()).ok_or(INVALID)?;
                if objects.has("n") {
                    let number = first.checked_add(step).ok_or(INVALID)?;
                    self.places.entry(number).or_insert(place as usize);
                } else if !objects.has("f") {
                    return Err(INVALID);
                }
            }
        }
        let trailer = objects.object()?;
        self.count(objects.at - place)?;
        match trailer {
            Object::Dict(trailer) => Ok(trailer),
            _ => Err(INVALID),
        }
    }

    /// Counts bytes that were read.
    fn count(&self, n_bytes: usize) -> Result<(), PartError> {
        const CIRCLE: PartError = PartError::Pdf("objects or tables within each other or in a circle");
        self.left.set(self.left.get().checked_sub(n_bytes).ok_or(CIRCLE)?);
        Ok(())
    }

    /// An object by its number; null if there is none.
    fn object(&self, number: u32) -> Result<Indirect<'f>, PartError> {
        self.object_at_level(number, 0)
    }

    fn object_at_level(&self, number: u32, level: usize) -> Result<Indirect<'f>, PartError> {
        const INVALID: PartError = PartError::Pdf("an object with a number");
        let Some(&place) = self.places.get(&number) else { return Ok(Indirect::Object(Object::Null)) };
        let mut objects = Objects::new(self.bytes, place);
        if objects.count() != Some(number) || objects.count().is_none() || !objects.has("obj") {
            return Err(INVALID);
        }
        let object = objects.object()?;
        self.count(objects.at - place)?;
        if !objects.has("stream") {
            return Ok(Indirect::Object(object));
        }
        let Object::Dict(entries) = object else { return Err(INVALID) };
        let data = objects.rest();
        let data = data.strip_prefix(b"\r\n").or_else(|| data.strip_prefix(b"\n")).unwrap_or(data);
        let length = match entry(&entries, "Length") {
            // The length is an object of its own, and no stream.
            Object::Ref(number) if level == 0 => match self.object_at_level(*number, 1)? {
                Indirect::Object(object) => object,
                Indirect::Stream(..) => return Err(INVALID),
            },
            other => other.clone(),
        };
        let Object::Number(length) = length else { return Err(PartError::Pdf("the length of a stream")) };
        // The cast saturates.
        let length = length as usize;
        let is_whole =
            data.get(length..).is_some_and(|after| after.trim_ascii_start().starts_with(b"endstream"));
        if !is_whole {
            return Err(PartError::Pdf("the length of a stream"));
        }
        self.count(length)?;
        Ok(Indirect::Stream(entries, &data[..length]))
    }

    /// An object in place of references to it.
    fn resolved(&self, mut object: Object) -> Result<Object, PartError> {
        for _ in 0..MAX_LEVELS {
            let Object::Ref(number) = object else { return Ok(object) };
            object = match self.object(number)? {
                Indirect::Object(object) => object,
                Indirect::Stream(..) => return Err(PartError::Pdf("a stream in place of a value")),
            };
        }
        Err(PartError::Pdf("references in a circle"))
    }

    fn dict(&self, object: Object) -> Result<Entries, PartError> {
        match self.resolved(object)? {
            Object::Dict(entries) => Ok(entries),
            _ => Err(PartError::Pdf("its tree of pages")),
        }
    }

    /// The only page.
    fn page(&self) -> Result<Page, PartError> {
        let catalog = self.dict(self.root.clone())?;
        let mut next = entry(&catalog, "Pages").clone();
        let mut nodes = Vec::new();
        while nodes.len() < MAX_LEVELS {
            let mut node = self.dict(next)?;
            let kids = node.iter().position(|(key, _)| key == b"Kids");
            let kids = kids.map_or(Object::Null, |idx| node.swap_remove(idx).1);
            // Other entries may be as large as the file, at each level.
            node.retain(|(key, _)| OF_PAGES.iter().any(|used| key == used.as_bytes()));
            nodes.push(node);
            let Object::Array(kids) = self.resolved(kids)? else { return Ok(Page(nodes)) };
            let [kid] = <[Object; 1]>::try_from(kids).map_err(|kids| PartError::Pages(kids.len()))?;
            next = kid;
        }
        Err(PartError::Pdf("its tree of pages"))
    }

    fn numbers(&self, object: &Object) -> Option<[f64; 4]> {
        let Object::Array(items) = self.resolved(object.clone()).ok()? else { return None };
        let number = |item: &Object| match self.resolved(item.clone()) {
            Ok(Object::Number(number)) => Some(number),
            _ => None,
        };
        <[f64; 4]>::try_from(items.iter().map(number).collect::<Option<Vec<f64>>>()?).ok()
    }
}
