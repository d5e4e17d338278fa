//! What was done, in words.

use std::fmt::{self, Display, Formatter};

use crate::adaptive::MAX_PIECES;
use crate::criterion::MAX_GENERATION;

/// What was done.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Notes {
    /// Vertices added by cutting.
    pub n_new_vertices: usize,
    /// Faces added by cutting.
    pub n_new_faces: usize,
    /// Faces of the scene left out because the camera does not see them.
    pub n_culled: usize,
    /// Faces right at their edges only: their contours cross or enclose nothing, so they cannot be cut.
    pub n_uncut: usize,
    /// Edges that still bend and were not cut further.
    pub n_too_deep: usize,
    /// Cutting stopped early, at the largest number of pieces.
    pub is_full: bool,
    /// How right the result is, if it was asked for ([`crate::Config::measure`]) or is less right than asked.
    pub achieved: Option<Achieved>,
}

/// The greatest errors left, each with the names of the vertices it is between.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Achieved {
    /// Angle at the eye between an edge as drawn and as it is, radians.
    pub angle: Worst,
    /// Distance in space between an edge, or the inside of a face, as drawn and as it is, over its distance
    /// from the eye; at right angles to the face, for only that shows.
    pub depth: Worst,
    /// Relative error of D, or 1/D, taken linearly along an edge; an upper bound.
    pub doppler: Worst,
    /// Error of the light of near lamps, taken linearly along an edge, in parts of that of a lamp that shines straight at
    /// a face; `None` if nobody asked ([`crate::Config::light_error`]).
    pub light: Option<Worst>,
}

/// The largest of some errors.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Worst {
    /// The error.
    pub error: f64,
    /// Names of the two or three vertices it is between; none if there is no error.
    pub at: Vec<String>,
}

impl Notes {
    /// What the user should hear.
    pub fn warnings(&self) -> Vec<String> {
        let mut warnings = Vec::new();
        let left =
            self.achieved.as_ref().map_or_else(String::new, |achieved| format!("; errors left: {achieved}"));
        if self.is_full {
            warnings.push(format!(
                "cutting stopped at {MAX_PIECES} pieces: some edges are not as right as asked; \
                 a larger bound (-se) takes fewer pieces{left}"
            ));
        }
        if self.n_uncut > 0 {
            warnings.push(format!(
                "{} faces are right at their edges only: their contours cross or enclose nothing, so they cannot \
                 be cut; correct them{left}",
                self.n_uncut
            ));
        }
        if self.n_too_deep > 0 {
            warnings.push(format!(
                "{} edges still bend after {MAX_GENERATION} halvings, probably very close to the eye; \
                 move the eye (-ep) if it shows{left}",
                self.n_too_deep
            ));
        }
        warnings
    }

    /// What was done, for those who want to know.
    pub fn details(&self) -> Vec<String> {
        let cut = format!("cutting added {} faces and {} vertices", self.n_new_faces, self.n_new_vertices);
        let achieved = self.achieved.as_ref().map(|achieved| format!("errors left: {achieved}"));
        let culled =
            (self.n_culled > 0).then(|| format!("{} faces out of sight were left out", self.n_culled));
        [cut].into_iter().chain(culled).chain(achieved).collect()
    }
}

impl Display for Achieved {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let place = |worst: &Worst| match worst.at.as_slice() {
            [] => String::new(),
            names => format!(" ({})", names.join(" ")),
        };
        write!(f, "outline {:.3} mrad{}, ", self.angle.error * 1e3, place(&self.angle))?;
        write!(f, "depth {:.3} permille{}, ", self.depth.error * 1e3, place(&self.depth))?;
        write!(f, "Doppler factor {:.3} percent{}", self.doppler.error * 1e2, place(&self.doppler))?;
        match &self.light {
            Some(light) => write!(f, ", light {:.3} percent{}", light.error * 1e2, place(light)),
            None => Ok(()),
        }
    }
}
