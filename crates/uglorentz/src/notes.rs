//! What was done, in words.

use crate::adaptive::{MAX_GENERATION, MAX_PIECES};

/// What was done.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Notes {
    /// The scene says that this program has written it: what it takes for rest shapes are seen ones.
    pub was_seen_before: bool,
    /// Vertices added by cutting.
    pub n_new_vertices: usize,
    /// Faces added by cutting.
    pub n_new_faces: usize,
    /// Faces of the scene left out because the camera does not see them.
    pub n_culled: usize,
    /// Edges that still bend and were not cut further.
    pub n_too_deep: usize,
    /// Cutting stopped early, at the largest number of pieces.
    pub is_full: bool,
}

impl Notes {
    /// What the user should hear.
    pub fn warnings(&self) -> Vec<String> {
        let mut warnings = Vec::new();
        if self.was_seen_before {
            warnings.push(
                "the scene has been through uglorentz before: seen shapes are taken for rest shapes; \
                 start from the original"
                    .to_string(),
            );
        }
        if self.is_full {
            warnings.push(format!(
                "cutting stopped at {MAX_PIECES} pieces: some edges are not as right as asked; \
                 a larger bound (-se) takes fewer pieces"
            ));
        }
        if self.n_too_deep > 0 {
            warnings.push(format!(
                "{} edges still bend after {MAX_GENERATION} halvings, probably very close to the eye; \
                 move the eye (-ep) if it shows",
                self.n_too_deep
            ));
        }
        warnings
    }

    /// What was cut, for those who want to know.
    pub fn summary(&self) -> String {
        let cut = format!("cutting added {} faces and {} vertices", self.n_new_faces, self.n_new_vertices);
        match self.n_culled {
            0 => cut,
            n_culled => format!("{cut}; {n_culled} faces out of sight were left out"),
        }
    }
}
