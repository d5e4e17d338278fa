//! Frames that are nearly black or overexposed.

use ugpicture::Note;

/// Frames whose brightness is wrong.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct WrongBrightness {
    /// Those that are nearly black.
    pub nearly_black: Vec<u32>,
    /// Those that are overexposed.
    pub overexposed: Vec<u32>,
}

impl WrongBrightness {
    /// Adds a frame, if a note on it says that it is nearly black or overexposed.
    pub fn add(&mut self, frame: u32, note: &Note) {
        match note {
            Note::NearlyBlack { .. } => self.nearly_black.push(frame),
            Note::Overexposed => self.overexposed.push(frame),
            _ => {}
        }
    }
}
