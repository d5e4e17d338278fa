//! Assigns numbers to vertex names.
//!
//! Most names consist of a stem and a number: `v1`, `v2`, … So each stem has a table indexed by the
//! number: no hashing is necessary, and consecutive names are adjacent in memory. All other names
//! are in a hash map.

use rustc_hash::FxHashMap;

/// The largest number of digits after a stem; with more, the name is not split.
const MAX_DIGITS: usize = 9;

/// The least number of table entries that any text may have.
const MIN_ROOM: usize = 1024;

/// A name, split into stem and number.
#[derive(Clone, Copy)]
pub(crate) struct Name<'t> {
    pub text: &'t [u8],
    /// Bytes of the stem, if the rest is a number without leading zeros.
    stem: Option<usize>,
    number: u32,
}

impl<'t> Name<'t> {
    pub fn new(text: &'t [u8]) -> Self {
        let digits = text.iter().rev().take_while(|byte| byte.is_ascii_digit()).count();
        let stem = text.len() - digits;
        // If this is not a valid number, `with_number` ignores it.
        let number = text[stem..]
            .iter()
            .take(MAX_DIGITS)
            .fold(0, |sum, digit| sum * 10 + u32::from(digit - b'0'));
        Self::with_number(text, stem, number)
    }

    /// The name whose first `stem` bytes are followed by digits that come to `number`.
    #[inline(always)]
    pub fn with_number(text: &'t [u8], stem: usize, number: u32) -> Self {
        let digits = text.len() - stem;
        let is_number = digits > 0 && digits <= MAX_DIGITS && (text[stem] != b'0' || digits == 1);
        Self { text, stem: is_number.then_some(stem), number }
    }
}

/// Numbers of names, from 0 in the order of their first use.
#[derive(Default)]
pub(crate) struct NumberedNames<'t> {
    stems: Vec<Stem<'t>>,
    stem_rows: FxHashMap<&'t [u8], usize>,
    /// The last two stems used: the corners of a face are often in two rows of a grid.
    recent: [usize; 2],
    others: FxHashMap<&'t [u8], u32>,
    len: u32,
    /// Number of entries by which the tables may still grow.
    room: usize,
}

struct Stem<'t> {
    text: &'t [u8],
    /// For each number after the stem, the number of the name plus 1, or 0 if the name is unknown.
    entries: Vec<u32>,
}

impl<'t> NumberedNames<'t> {
    /// For a text of this size in bytes; the size of the tables is limited in proportion.
    pub fn for_text(bytes: usize) -> Self {
        Self { room: (bytes / 4).max(MIN_ROOM), ..Self::default() }
    }

    /// The number of different names.
    pub fn len(&self) -> usize {
        self.len as usize
    }

    /// The number of a name; adds it if it is new.
    #[inline]
    pub fn enter(&mut self, name: Name<'t>) -> u32 {
        if let Some(len) = name.stem {
            let stem = &name.text[..len];
            if let Some(row) = self.recent(stem)
                && let Some(&entry @ 1..) = self.stems[row].entries.get(name.number as usize)
            {
                return entry - 1;
            }
        }
        self.enter_slowly(name)
    }

    /// The number of a name, if it is known.
    pub fn get(&self, name: Name<'_>) -> Option<u32> {
        let table = name.stem.and_then(|len| self.stem_rows.get(&name.text[..len]));
        let entry = table.and_then(|&row| self.stems[row].entries.get(name.number as usize));
        match entry {
            Some(&entry @ 1..) => Some(entry - 1),
            _ => self.others.get(name.text).copied(),
        }
    }

    /// A number for something that no name refers to.
    pub fn enter_unnamed(&mut self) -> u32 {
        self.len += 1;
        self.len - 1
    }

    fn enter_slowly(&mut self, name: Name<'t>) -> u32 {
        let Some(len) = name.stem else { return self.enter_other(name.text) };
        let row = self.stem(&name.text[..len]);
        let entries = &mut self.stems[row].entries;
        let idx = name.number as usize;
        if idx >= entries.len() {
            let wanted = (idx + 1).max(2 * entries.len()).min(entries.len() + self.room);
            if wanted <= idx {
                return self.enter_other(name.text);
            }
            self.room -= wanted - entries.len();
            entries.resize(wanted, 0);
        }
        if entries[idx] == 0 {
            // It may have been added to the hash map before its table was large enough.
            if let Some(&known) = self.others.get(name.text) {
                return known;
            }
            self.len += 1;
            entries[idx] = self.len;
        }
        entries[idx] - 1
    }

    fn enter_other(&mut self, name: &'t [u8]) -> u32 {
        *self.others.entry(name).or_insert_with(|| {
            self.len += 1;
            self.len - 1
        })
    }

    /// The row of a stem, if it was used lately.
    #[inline]
    fn recent(&self, text: &[u8]) -> Option<usize> {
        let is_it = |row: &usize| self.stems.get(*row).is_some_and(|stem| stem.text == text);
        self.recent.into_iter().find(is_it)
    }

    fn stem(&mut self, text: &'t [u8]) -> usize {
        self.recent(text).unwrap_or_else(|| {
            let row = *self.stem_rows.entry(text).or_insert_with(|| {
                self.stems.push(Stem { text, entries: Vec::new() });
                self.stems.len() - 1
            });
            self.recent = [row, self.recent[0]];
            row
        })
    }
}
