//! Names of a scene, in one buffer.

/// A name in a [`Names`] table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct NameId(u32);

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
        NameId(u32::try_from(self.ends.len() - 1).expect("fewer than 2^32 names"))
    }

    /// The text of a name.
    pub fn get(&self, id: NameId) -> &str {
        let row = id.0 as usize;
        let start = if row == 0 { 0 } else { self.ends[row - 1] as usize };
        &self.text[start..self.ends[row] as usize]
    }
}
