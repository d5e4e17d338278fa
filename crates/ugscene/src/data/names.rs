//! The names of a scene, in one buffer, and generation of unique names.

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
    pub fn get(&self, id: NameId) -> &str {
        let row = id.index();
        let start = if row == 0 { 0 } else { self.ends[row - 1] as usize };
        &self.text[start..self.ends[row] as usize]
    }
}

/// Used names, to generate unique ones.
#[derive(Clone, Debug, Default)]
pub struct UniqueNames {
    /// For each name the largest number that was appended to it, or 1.
    taken: FxHashMap<String, u64>,
}

impl UniqueNames {
    /// Returns `name`, or the first unused of `name_2`, `name_3`, …, and marks it as used.
    pub fn fresh(&mut self, name: &str) -> String {
        let fresh = self.unused(name);
        self.taken.insert(fresh.clone(), 1);
        fresh
    }

    /// Makes room for more names.
    pub fn reserve(&mut self, n: usize) {
        self.taken.reserve(n);
    }

    /// Adds a [fresh](Self::fresh) name to a table.
    pub fn add(&mut self, name: String, table: &mut Names) -> NameId {
        let fresh = if self.taken.contains_key(&name) { self.unused(&name) } else { name };
        let id = table.add(&fresh);
        self.taken.insert(fresh, 1);
        id
    }

    /// Adds a [fresh](Self::fresh) name to the table that has the original.
    pub fn add_copy(&mut self, original: NameId, table: &mut Names) -> NameId {
        let fresh = self.unused(table.get(original));
        let id = table.add(&fresh);
        self.taken.insert(fresh, 1);
        id
    }

    fn unused(&mut self, name: &str) -> String {
        loop {
            let Some(last) = self.taken.get_mut(name) else { return name.to_owned() };
            *last += 1;
            let fresh = [name, "_", &last.to_string()].concat();
            if !self.taken.contains_key(&fresh) {
                return fresh;
            }
        }
    }
}

impl<'a> FromIterator<&'a str> for UniqueNames {
    fn from_iter<I: IntoIterator<Item = &'a str>>(names: I) -> Self {
        Self { taken: names.into_iter().map(|name| (name.to_owned(), 1)).collect() }
    }
}
