//! Errors and warnings as data with positions.

use crate::options::{Limit, Limits};
use crate::source::Span;

/// The largest number of errors reported together.
pub const MAX_ERRORS: usize = 20;

/// Severity of a diagnostic.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Severity {
    /// The scene is invalid.
    #[default]
    Error,
    /// The scene is valid, or was changed as the message states.
    Warning,
    /// All is well; the message states what was chosen.
    Note,
}

/// An error, a warning or a note about a scene.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Diagnostic {
    /// Error, warning or note.
    pub severity: Severity,
    /// The problem: lower case, no full stop.
    pub message: String,
    /// Its location.
    pub span: Span,
    /// A few words at the location.
    pub label: String,
    /// A second location, such as the first definition of a name.
    pub other: Option<(Span, String)>,
    /// The remedy.
    pub help: Option<String>,
    /// The setting of the reader that the remedy is about.
    pub setting: Option<Setting>,
}

/// A setting of the reader that is part of a remedy. A command line adds the option that it stands
/// for, see [`Diagnostics::report`](crate::Diagnostics::report).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Setting {
    /// [`Options::lax`](crate::Options::lax).
    Lax,
    /// [`Options::execute`](crate::Options::execute).
    Execute,
    /// [`Options::limits`](crate::Options::limits).
    Limit(Limit),
    /// The name of the camera.
    Camera,
    /// The name of a camera, although none has one.
    NoCamera,
}

impl Diagnostic {
    /// An error at a location.
    pub fn error(span: Span, message: impl Into<String>) -> Self {
        Self { message: message.into(), span, ..Self::default() }
    }

    /// A warning at a location.
    pub fn warning(span: Span, message: impl Into<String>) -> Self {
        Self { severity: Severity::Warning, ..Self::error(span, message) }
    }

    /// A note at a location.
    pub fn note(span: Span, message: impl Into<String>) -> Self {
        Self { severity: Severity::Note, ..Self::error(span, message) }
    }

    /// An error at a location, with its remedy.
    pub(crate) fn here(span: Span, message: impl Into<String>, help: impl Into<String>) -> Self {
        Self::error(span, message).label("here").help(help)
    }

    /// An error where something is stated again, with its remedy.
    pub(crate) fn again([again, first]: [Span; 2], message: impl Into<String>, help: &str) -> Self {
        Self::error(again, message).label("again here").other(first, "first here").help(help)
    }

    /// Adds the words at the location.
    pub fn label(mut self, label: impl Into<String>) -> Self {
        self.label = label.into();
        self
    }

    /// Adds a second location.
    pub fn other(mut self, span: Span, label: impl Into<String>) -> Self {
        self.other = Some((span, label.into()));
        self
    }

    /// Adds the remedy.
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// Adds the setting that the remedy is about.
    pub fn setting(mut self, setting: Setting) -> Self {
        self.setting = Some(setting);
        self
    }

    /// Adds the remedy against a limit that is reached; `else_do`: the alternative to raising it.
    pub(crate) fn limited(mut self, limits: &Limits, limit: Limit, else_do: &str) -> Self {
        let (help, can_be_raised) = limits.remedy(limit, else_do);
        self.setting = can_be_raised.then_some(Setting::Limit(limit));
        self.help(help)
    }
}
