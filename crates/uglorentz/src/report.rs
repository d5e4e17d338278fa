//! Statistics of a run.

use std::fmt::{self, Display, Formatter};

use ugscene::DefaultCamera;

/// Statistics of [`crate::apply`].
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
    /// Edges with vertices of other faces on them (T-junctions), cut into equal pieces.
    pub n_open_junctions: usize,
    /// Faces that would be subdivided are whole, for rays ([`crate::Config::is_for_rays`]).
    pub is_whole: bool,
    /// Round faces of bodies on world lines became polygons.
    pub are_rounds_cut: bool,
    /// The name of the body whose frame is that of a moment, since it accelerates or turns, and that
    /// moment ([`crate::MeasuredFrame::Body`]).
    pub momentary_frame: Option<(String, f64)>,
    /// Subdivision stopped at the limit of pieces.
    pub is_full: bool,
    /// The limit of pieces for a picture of this size.
    pub max_pieces: usize,
    /// The errors left, if they were requested ([`crate::Config::measure`]) or exceed a bound.
    pub remaining_errors: Option<RemainingErrors>,
    /// The camera that was chosen because the scene has none.
    pub default_camera: Option<DefaultCamera>,
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

impl Display for RemainingErrors {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let place = |largest: &LargestError| match largest.at.as_slice() {
            [] => String::new(),
            names => format!(" ({})", names.join(" ")),
        };
        write!(f, "outline {}{}, ", amount(self.angle.error * 1e3, "mrad"), place(&self.angle))?;
        write!(f, "depth {}{}, ", amount(self.depth.error * 1e3, "permille"), place(&self.depth))?;
        let percent =
            |largest: &LargestError| amount(largest.error * 1e2, "percent") + &place(largest);
        write!(f, "Doppler factor {}", percent(&self.doppler))?;
        match &self.light {
            Some(light) => write!(f, ", light {}", percent(light)),
            None => Ok(()),
        }
    }
}

/// A number with its unit; `unbounded` if the bound of an error is infinite or NaN.
fn amount(value: f64, unit: &str) -> String {
    match value {
        _ if !value.is_finite() => "unbounded".to_owned(),
        1e6.. => format!("{value:.3e} {unit}"),
        _ => format!("{value:.3} {unit}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_without_a_bound_are_called_so() {
        let of = |error: f64| LargestError { error, at: vec!["a".to_owned(), "b".to_owned()] };
        let errors = RemainingErrors {
            angle: of(0.0015),
            depth: of(f64::INFINITY),
            doppler: of(1e300),
            light: Some(of(f64::NAN)),
        };
        assert_eq!(
            errors.to_string(),
            "outline 1.500 mrad (a b), depth unbounded (a b), Doppler factor 1.000e302 percent (a b), \
             light unbounded (a b)"
        );
    }
}
