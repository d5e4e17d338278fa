//! Names of a scene, in one buffer, and new ones beside them.

use std::fmt;
use std::num::NonZeroU32;

use rustc_hash::FxHashSet;

use crate::scene::optional_index;

optional_index! {
    /// A name in a [`Names`] table.
    NameId
}

/// Text of names. Adding never looks up: rows may repeat a text.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Names {
    text: String,
    ends: Vec<u32>,
}

impl Names {
    /// Adds a name.
    ///
    /// # Panics
    /// If all names together pass 4 GiB; the reader refuses such scenes.
    pub fn add(&mut self, name: &str) -> NameId {
        self.add_parts(&[name])
    }

    /// Adds a name put together from parts, without building it elsewhere.
    pub fn add_parts(&mut self, parts: &[&str]) -> NameId {
        parts.iter().for_each(|part| self.text.push_str(part));
        let end = u32::try_from(self.text.len()).expect("names together are below 4 GiB");
        self.ends.push(end);
        NameId::from_index(self.ends.len() - 1)
    }

    /// Number of names.
    pub(crate) fn len(&self) -> usize {
        self.ends.len()
    }

    /// Appends another table; its names are numbered on behind those here.
    pub(crate) fn append(&mut self, other: Self) {
        if self.ends.is_empty() {
            *self = other;
            return;
        }
        let offset = u32::try_from(self.text.len()).expect("names together are below 4 GiB");
        self.text.push_str(&other.text);
        self.ends.extend(other.ends.iter().map(|end| end + offset));
    }

    /// Bytes of all names together.
    pub(crate) fn len_bytes(&self) -> usize {
        self.text.len()
    }

    /// The text of a name.
    pub fn get(&self, id: NameId) -> &str {
        let row = id.index();
        let start = if row == 0 { 0 } else { self.ends[row - 1] as usize };
        &self.text[start..self.ends[row] as usize]
    }
}

/// Names that are taken, for making new ones.
#[derive(Clone, Debug, Default)]
pub struct UniqueNames {
    taken: FxHashSet<String>,
}

impl UniqueNames {
    /// Takes `name` if it is free; false if it was taken before.
    pub fn take(&mut self, name: &str) -> bool {
        self.taken.insert(name.to_string())
    }

    /// Takes `name`, or the first free one of `name_2`, `name_3`, …
    pub fn fresh(&mut self, name: &str) -> String {
        let mut candidate = name.to_string();
        let mut count = 1u64;
        while !self.taken.insert(candidate.clone()) {
            count += 1;
            candidate = format!("{name}_{count}");
        }
        candidate
    }
}

impl<'a> FromIterator<&'a str> for UniqueNames {
    fn from_iter<I: IntoIterator<Item = &'a str>>(names: I) -> Self {
        Self { taken: names.into_iter().map(str::to_string).collect() }
    }
}
