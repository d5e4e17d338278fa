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
    /// [`crate::read`] keeps round faces instead of cutting them into polygons.
    pub keeps_rounds: bool,
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
    /// All limits.
    pub const ALL: [Self; 9] = [
        Self::Text,
        Self::Includes,
        Self::Files,
        Self::Nesting,
        Self::Chain,
        Self::Statements,
        Self::Corners,
        Self::Names,
        Self::Memory,
    ];

    /// Finds a limit by its name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|limit| limit.name() == name)
    }

    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Text => "text",
            Self::Includes => "includes",
            Self::Files => "files",
            Self::Nesting => "nesting",
            Self::Chain => "chain",
            Self::Statements => "statements",
            Self::Corners => "corners",
            Self::Names => "names",
            Self::Memory => "memory",
        }
    }

    /// The default value.
    pub fn default_value(self) -> u64 {
        match self {
            Self::Text => self.most(),
            Self::Includes | Self::Nesting => 64,
            Self::Files => 10_000,
            Self::Chain => 200,
            Self::Statements => 50_000_000,
            Self::Corners => 500_000_000,
            Self::Names => self.most(),
            // Growing tables and the output may need as much again.
            Self::Memory => 2 << 30,
        }
    }

    /// The largest value it can have.
    pub fn most(self) -> u64 {
        match self {
            // Positions are 32-bit.
            Self::Text => u32::MAX as u64,
            Self::Includes | Self::Nesting | Self::Chain => 10_000,
            Self::Files => 1_000_000_000,
            // Rows are 32-bit, and every one may need a second name.
            Self::Statements => 2_000_000_000,
            Self::Corners => 4_000_000_000,
            // Positions of names are 32-bit, and every name may have to be made unique.
            Self::Names => 2 << 30,
            Self::Memory => 1 << 40,
        }
    }

    fn unit(self) -> &'static str {
        match self {
            Self::Text | Self::Names | Self::Memory => "bytes",
            Self::Includes | Self::Nesting | Self::Chain => "levels",
            Self::Files => "files",
            Self::Statements => "statements",
            Self::Corners => "corners",
        }
    }
}

/// A value for each [`Limit`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits([u64; Limit::ALL.len()]);

impl Default for Limits {
    fn default() -> Self {
        Self(Limit::ALL.map(Limit::default_value))
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
        let unit = if value == 1 { limit.unit().trim_end_matches('s') } else { limit.unit() };
        if value < limit.most() {
            (format!("the limit is {value} {unit}; {else_do}, or raise it"), true)
        } else {
            (format!("the limit is {value} {unit}, and cannot be raised; {else_do}"), false)
        }
    }
}
