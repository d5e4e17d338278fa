//! What was done, as numbers and as messages.

use std::fmt::{self, Display, Formatter};

use crate::adaptive::MAX_PIECES;
use crate::criterion::MAX_GENERATION;

/// What [`crate::apply`] did.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Report {
    /// Vertices added by subdivision.
    pub n_new_vertices: usize,
    /// Faces added by subdivision.
    pub n_new_faces: usize,
    /// Faces removed because they are outside the camera's view.
    pub n_culled: usize,
    /// Faces that are right at their edges only: their contours intersect or enclose no area, so
    /// the faces cannot be triangulated.
    pub n_uncut: usize,
    /// Edges above the error bound that reached the limit of halvings.
    pub n_too_deep: usize,
    /// Subdivision stopped at the limit of pieces.
    pub is_full: bool,
    /// The errors left, if they were requested ([`crate::Config::measure`]) or exceed a bound.
    pub remaining_errors: Option<RemainingErrors>,
}

/// The largest errors left, each with the names of the vertices it is between.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RemainingErrors {
    /// Angle at the eye between an edge as drawn and as seen, radians.
    pub angle: LargestError,
    /// Distance in space between an edge, or the inside of a face, as drawn and as seen, divided by
    /// its distance from the eye. Of the inside only the component normal to the face is visible.
    pub depth: LargestError,
    /// Relative error of D, or 1/D, interpolated linearly along an edge; an upper bound.
    pub doppler: LargestError,
    /// Error of the light of near lamps, interpolated linearly along an edge, relative to the light
    /// of a lamp at normal incidence; `None` if not requested ([`crate::Config::light_error`]).
    pub light: Option<LargestError>,
}

/// The largest of several errors.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LargestError {
    /// The error.
    pub error: f64,
    /// Names of the two or three vertices it is between; empty if there is no error.
    pub at: Vec<String>,
}

impl Report {
    /// Messages about results that are not as requested.
    pub fn warnings(&self) -> Vec<String> {
        let mut warnings = Vec::new();
        let left = match &self.remaining_errors {
            Some(errors) => format!("; errors left: {errors}"),
            None => String::new(),
        };
        if self.is_full {
            warnings.push(format!(
                "subdivision stopped at {MAX_PIECES} pieces: the error of some edges is above the bound; \
                 a larger bound (-se) needs fewer pieces{left}"
            ));
        }
        if self.n_uncut > 0 {
            warnings.push(format!(
                "{} faces are right at their edges only: their contours intersect or enclose no area, so they \
                 cannot be subdivided; correct them{left}",
                self.n_uncut
            ));
        }
        if self.n_too_deep > 0 {
            warnings.push(format!(
                "the error of {} edges is above the bound after {MAX_GENERATION} halvings, probably very close \
                 to the eye; if it is visible, move the eye (-ep){left}",
                self.n_too_deep
            ));
        }
        warnings
    }

    /// Statistics, for `-vb`.
    pub fn details(&self) -> Vec<String> {
        let added =
            format!("subdivision added {} faces and {} vertices", self.n_new_faces, self.n_new_vertices);
        let errors = self.remaining_errors.as_ref().map(|errors| format!("errors left: {errors}"));
        let culled = (self.n_culled > 0).then(|| format!("removed {} faces outside the view", self.n_culled));
        [added].into_iter().chain(culled).chain(errors).collect()
    }
}

impl Display for RemainingErrors {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let place = |largest: &LargestError| match largest.at.as_slice() {
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
