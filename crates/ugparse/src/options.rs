//! How to read: what is allowed, and how much of it.

/// How to read. Write `Options { lax: true, ..Options::default() }`: more may come.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// Unknown statements are warned about and passed on, not refused (`-lax`).
    pub lax: bool,
    /// `execute` statements are followed (`--allow-execute`), not refused: see [`crate::include`].
    pub execute: bool,
    /// What is refused because it is too much (`--limit`).
    pub limits: Limits,
}

/// Something there may be too much of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Limit {
    /// Bytes of text, with all that it includes.
    Text,
    /// Files that include files, in one chain.
    Includes,
    /// Files included and programs run in all.
    Files,
    /// Definitions inside definitions.
    Nesting,
    /// Definitions that place each other, in one chain.
    Chain,
    /// Statements of the placed scene; each takes some 200 bytes of memory.
    Statements,
    /// Corners of its faces and wires; each takes 4 bytes.
    Corners,
    /// Bytes of its names.
    Names,
}

impl Limit {
    /// All of them.
    pub const ALL: [Self; 8] = [
        Self::Text,
        Self::Includes,
        Self::Files,
        Self::Nesting,
        Self::Chain,
        Self::Statements,
        Self::Corners,
        Self::Names,
    ];

    /// The limit of that name.
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
        }
    }

    /// What holds unless something else is asked for.
    pub fn default_value(self) -> u64 {
        match self {
            Self::Text => self.most(),
            Self::Includes | Self::Nesting => 64,
            Self::Files => 10_000,
            Self::Chain => 200,
            // Where memory of common machines ends.
            Self::Statements => 50_000_000,
            Self::Corners => 500_000_000,
            Self::Names => self.most(),
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
        }
    }

    fn unit(self) -> &'static str {
        match self {
            Self::Text | Self::Names => "bytes",
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

    /// The same with another value for one, or [`Limit::most`] if that is less.
    pub fn with(mut self, limit: Limit, value: u64) -> Self {
        self.0[limit as usize] = value.min(limit.most());
        self
    }

    /// What to do if a limit is reached; `else_do`: in place of raising it.
    pub(crate) fn remedy(&self, limit: Limit, else_do: &str) -> String {
        let value = self.get(limit);
        let unit = if value == 1 { limit.unit().trim_end_matches('s') } else { limit.unit() };
        if value < limit.most() {
            format!("the limit is {value} {unit}; {else_do}, or raise it with --limit {}=N", limit.name())
        } else {
            format!("the limit is {value} {unit}, and cannot be raised; {else_do}")
        }
    }
}
