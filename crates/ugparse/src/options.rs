//! Options and limits of parsing.

/// Options of parsing. Write `Options { lax: true, ..Options::default() }`, since fields may be
/// added.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// Pass on unknown statements with a warning, instead of refusing them (`-lax`).
    pub lax: bool,
    /// Run the programs of `execute` statements, instead of refusing them (`--allow-execute`): see
    /// [`crate::include`].
    pub execute: bool,
    /// Limits on the size of a scene (`--limit`).
    pub limits: Limits,
}

/// A limited quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Limit {
    /// Bytes of text, included files, too.
    Text,
    /// Depth of nested `include`.
    Includes,
    /// Files included and programs run, in total.
    Files,
    /// Depth of nested definitions.
    Nesting,
    /// Depth of instances within instances.
    Chain,
    /// Statements of the expanded scene.
    Statements,
    /// Corners of its faces and wires; each needs 4 bytes.
    Corners,
    /// Bytes of its names.
    Names,
    /// Bytes of its tables: vertices, faces, contours, corners, names and all others.
    Memory,
}

impl Limit {
    /// Each limit, its name on the command line, what it counts, its default, and the largest value
    /// it can have.
    const TABLE: [(Self, &'static str, &'static str, u64, u64); 9] = [
        // Positions are 32-bit.
        (Self::Text, "text", "bytes", u32::MAX as u64, u32::MAX as u64),
        (Self::Includes, "includes", "levels", 64, 10_000),
        (Self::Files, "files", "files", 10_000, 1_000_000_000),
        (Self::Nesting, "nesting", "levels", 64, 10_000),
        (Self::Chain, "chain", "levels", 200, 10_000),
        // Rows are 32-bit, and every one may need a second name.
        (Self::Statements, "statements", "statements", 50_000_000, 2_000_000_000),
        (Self::Corners, "corners", "corners", 500_000_000, 4_000_000_000),
        // Positions of names are 32-bit, and every name may have to be made unique.
        (Self::Names, "names", "bytes", 2 << 30, 2 << 30),
        // Growing tables and the output may need as much again as the default.
        (Self::Memory, "memory", "bytes", 2 << 30, 1 << 40),
    ];

    /// All limits.
    pub fn all() -> impl Iterator<Item = Self> {
        Self::TABLE.into_iter().map(|row| row.0)
    }

    /// Finds a limit by its name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::all().find(|limit| limit.name() == name)
    }

    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        Self::TABLE[self as usize].1
    }

    /// The default value.
    pub fn default_value(self) -> u64 {
        Self::TABLE[self as usize].3
    }

    /// The largest value it can have.
    pub fn most(self) -> u64 {
        Self::TABLE[self as usize].4
    }
}

/// A value for each [`Limit`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits([u64; Limit::TABLE.len()]);

impl Default for Limits {
    fn default() -> Self {
        Self(Limit::TABLE.map(|row| row.3))
    }
}

impl Limits {
    /// The value of a limit.
    pub fn get(&self, limit: Limit) -> u64 {
        self.0[limit as usize]
    }

    /// These limits with another value for one; values above [`Limit::most`] are reduced to it.
    pub fn with(mut self, limit: Limit, value: u64) -> Self {
        self.0[limit as usize] = value.min(limit.most());
        self
    }

    /// The remedy if a limit is reached, and whether it can be raised; `else_do`: the alternative
    /// to that.
    pub(crate) fn remedy(&self, limit: Limit, else_do: &str) -> (String, bool) {
        let value = self.get(limit);
        let unit = Limit::TABLE[limit as usize].2;
        let unit = if value == 1 { unit.trim_end_matches('s') } else { unit };
        if value < limit.most() {
            (format!("the limit is {value} {unit}; {else_do}, or raise it"), true)
        } else {
            (format!("the limit is {value} {unit}, and cannot be raised; {else_do}"), false)
        }
    }
}
