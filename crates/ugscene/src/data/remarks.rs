//! The head of a scene: its licence, and its history.

/// Comments at the head of a scene: its licence, and the history that pictures of it have as well.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Remarks {
    /// Comments before the first statement (licence, history), without their outer braces. They
    /// come first in the output.
    pub head: Vec<String>,
    /// The hash and the name of the input of a scene without a history, see
    /// [`Remarks::record`].
    pub origin: Option<String>,
}
