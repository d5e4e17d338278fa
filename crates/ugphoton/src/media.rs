//! The media that rays are in.

use ugscene::SurfaceId;

/// The transparent solids that a ray is in, the innermost last.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Media(Vec<Solid>);

/// A transparent solid: the faces of one part with one surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Solid {
    /// Row of the part.
    pub part: usize,
    /// Its surface.
    pub surface: SurfaceId,
}

impl Media {
    /// The medium that the ray is in; `None` for vacuum.
    pub fn innermost(&self) -> Option<Solid> {
        self.0.last().copied()
    }

    /// After the ray entered a solid.
    pub fn with(&self, solid: Solid) -> Self {
        Self([&self.0[..], &[solid]].concat())
    }

    /// After the ray left a solid; `None` if it was not in it.
    pub fn without(&self, solid: Solid) -> Option<Self> {
        let at = self.0.iter().rposition(|&entry| entry == solid)?;
        let mut media = self.0.clone();
        media.remove(at);
        Some(Self(media))
    }
}
