//! The names of a scene, in one buffer, and generation of unique names.

use std::collections::hash_map::Entry;
use std::ops::Range;

use rustc_hash::FxHashMap;

use super::ids::NameId;

/// A table of names. Adding does not search: rows may have equal text.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Names {
    text: String,
    ends: Vec<u32>,
}

impl Names {
    /// Adds a name.
    ///
    /// # Panics
    /// If all names together exceed 4 GiB; the reader refuses such scenes.
    pub fn add(&mut self, name: &str) -> NameId {
        self.add_parts(&[name])
    }

    /// Adds the concatenation of several parts.
    pub fn add_parts(&mut self, parts: &[&str]) -> NameId {
        parts.iter().for_each(|part| self.text.push_str(part));
        let end = u32::try_from(self.text.len()).expect("names together are below 4 GiB");
        self.ends.push(end);
        NameId::from_index(self.ends.len() - 1)
    }

    /// Adds a name followed by `_` and a number.
    fn add_numbered(&mut self, name: NameId, number: u64) -> NameId {
        self.text.extend_from_within(self.range(name));
        self.text.push('_');
        self.text.push_str(&number.to_string());
        self.add("")
    }

    fn remove_last(&mut self) {
        self.ends.pop();
        self.text.truncate(self.ends.last().map_or(0, |&end| end as usize));
    }

    /// Number of names.
    #[expect(clippy::len_without_is_empty, reason = "a table of rows, not a container")]
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// Bytes of all names together.
    pub fn len_bytes(&self) -> usize {
        self.text.len()
    }

    /// The text of a name.
    #[inline]
    pub fn get(&self, id: NameId) -> &str {
        &self.text[self.range(id)]
    }

    /// A name as UTF-8, faster than [`Names::get`], which makes sure of character boundaries.
    #[inline]
    pub fn bytes(&self, id: NameId) -> &[u8] {
        &self.text.as_bytes()[self.range(id)]
    }

    #[inline]
    fn range(&self, id: NameId) -> Range<usize> {
        let row = id.index();
        let start = if row == 0 { 0 } else { self.ends[row - 1] as usize };
        start..self.ends[row] as usize
    }
}

/// Used names, to generate unique ones.
#[derive(Clone, Debug, Default)]
pub struct UniqueNames {
    /// For each name the largest number that was appended to it, or 1. `a` with 3 stands for `a`,
    /// `a_2` and `a_3`; the last two are not in the map unless something was appended to them.
    taken: FxHashMap<String, u64>,
    /// True if a number was appended to any.
    are_numbered: bool,
}

impl UniqueNames {
    /// Marks `name` as used. If it was, marks and returns the first unused of `name_2`, `name_3`
    /// and so on.
    pub fn fresh(&mut self, name: &str) -> Option<String> {
        if self.taken.contains_key(name) || self.is_numbered(name) {
            return Some(self.numbered(name));
        }
        self.taken.insert(name.to_owned(), 1);
        None
    }

    /// The first unused copy of a used name.
    fn numbered(&mut self, name: &str) -> String {
        loop {
            let number = self.next_number(name);
            let fresh = format!("{name}_{number}");
            if !self.taken.contains_key(fresh.as_str()) {
                return fresh;
            }
        }
    }

    /// Makes room for more names.
    pub fn reserve(&mut self, n: usize) {
        self.taken.reserve(n);
    }

    /// Adds a [fresh](Self::fresh) name to a table.
    pub fn add(&mut self, name: String, table: &mut Names) -> NameId {
        let is_numbered = self.is_numbered(&name);
        let taken = match self.taken.entry(name) {
            Entry::Vacant(place) if !is_numbered => {
                let id = table.add(place.key());
                place.insert(1);
                return id;
            }
            place => place.key().clone(),
        };
        table.add(&self.numbered(&taken))
    }

    /// Adds a [fresh](Self::fresh) name to the table that has the original, which is used.
    pub fn add_copy(&mut self, original: NameId, table: &mut Names) -> NameId {
        loop {
            let number = self.next_number(table.get(original));
            let id = table.add_numbered(original, number);
            if !self.taken.contains_key(table.get(id)) {
                return id;
            }
            table.remove_last();
        }
    }

    /// True if the name was made from another by appending a number.
    fn is_numbered(&self, name: &str) -> bool {
        if !self.are_numbered {
            return false;
        }
        let Some((original, number)) = name.rsplit_once('_') else { return false };
        let is_canonical = matches!(number.as_bytes().first(), Some(b'1'..=b'9'));
        let number = if is_canonical { number.parse().unwrap_or(0) } else { 0 };
        number > 1 && self.taken.get(original).is_some_and(|&last| number <= last)
    }

    /// The next number to append to a used name. No two names become equal by appending: the
    /// number is what follows the last `_`.
    fn next_number(&mut self, name: &str) -> u64 {
        self.are_numbered = true;
        if let Some(last) = self.taken.get_mut(name) {
            *last += 1;
            return *last;
        }
        self.taken.insert(name.to_owned(), 2);
        2
    }
}

impl<'a> FromIterator<&'a str> for UniqueNames {
    fn from_iter<I: IntoIterator<Item = &'a str>>(names: I) -> Self {
        let taken = names.into_iter().map(|name| (name.to_owned(), 1)).collect();
        Self { taken, are_numbered: false }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_numbered_once() {
        let mut table = Names::default();
        let [a, b] = ["a", "a_3"].map(|name| table.add(name));
        let used = table.clone();
        let mut names: UniqueNames = [a, b].into_iter().map(|id| used.get(id)).collect();
        let check = |id: NameId, table: &Names, expected: &str| assert_eq!(table.get(id), expected);
        let first = names.add_copy(a, &mut table);
        check(first, &table, "a_2");
        check(names.add_copy(a, &mut table), &table, "a_4");
        check(names.add_copy(b, &mut table), &table, "a_3_2");
        // A copy is used, and so is a copy of it.
        check(names.add_copy(first, &mut table), &table, "a_2_2");
        check(names.add("a_2".to_owned(), &mut table), &table, "a_2_3");
        check(names.add("a_2_3".to_owned(), &mut table), &table, "a_2_3_2");
        check(names.add("a_4".to_owned(), &mut table), &table, "a_4_2");
        assert_eq!(
            ["a_5", "a_5", "a_04", "a_1", "a"]
                .map(|name| names.fresh(name).unwrap_or(name.to_owned())),
            ["a_5", "a_5_2", "a_04", "a_1", "a_6"]
        );
    }
}
