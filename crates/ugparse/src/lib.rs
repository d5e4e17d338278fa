//! UniGrafix scenes: text to [`Scene`] and back.
mod names;
mod scene;

pub use names::{NameId, Names};
pub use scene::*;
