//! Films: their formats, the names of their frames, and films that are read to be joined.

mod animation;
mod encode;
mod footage;
mod frame_names;
mod joined;
mod kind;
mod lesson;
mod palette;
mod surround;

pub use animation::{FilmShape, MOST_GIF_RATE};
pub use encode::{FilmFile, write};
pub(crate) use footage::{Footage, is_film, names_frames};
pub use frame_names::FrameNames;
pub(crate) use joined::Joined;
pub use kind::FilmKind;
pub use lesson::Caption;
pub use surround::{Eyes, FilmProjection, Surround, SurroundMesh};

/// Frames a second of a film that states no other.
pub const DEFAULT_RATE: f64 = 25.0;

/// Value parser: frames a second.
///
/// # Errors
/// Too few or too many.
pub fn rate(word: &str) -> Result<f64, String> {
    let rate = ugpipe::finite(word)?;
    if (0.01..=1000.0).contains(&rate) {
        Ok(rate)
    } else {
        Err("from 0.01 to 1000 frames a second".to_owned())
    }
}
