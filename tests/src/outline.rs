//! Measures the errors of drawn edges against the oracle.
//!
//! Only positions in the output of the programs are used. An edge of a piece is measured if both
//! its ends, transformed back to the rest frame by the oracle's matrix, lie on one edge of the
//! original face; edges within a face are ignored.

use glam::DVec3;
use rayon::prelude::*;
use ugscene::Scene;

use crate::oracle::{Oracle, Outline};

/// Each drawn edge is measured at this number of intervals.
const N_POINTS: u32 = 12;

/// The greatest errors of drawn outlines.
#[derive(Clone, Copy, Debug, Default)]
pub struct Errors {
    /// Angle at the eye, radians, over all directions.
    pub angle: f64,
    /// Drawn edges on outlines.
    pub n_edges: usize,
}

impl Errors {
    /// The larger of both errors, and the sum of the edges.
    #[must_use]
    pub fn and(self, other: Errors) -> Errors {
        Errors { angle: self.angle.max(other.angle), n_edges: self.n_edges + other.n_edges }
    }
}

/// Measures every edge of `seen`, relative to `eye`. `origin`: for each face, the face of the
/// oracle's scene of which it is a piece.
pub fn errors(seen: &Scene, origin: &[usize], eye: DVec3, oracle: &Oracle) -> Errors {
    let n_faces = origin.iter().max().map_or(0, |last| last + 1);
    let outlines: Vec<Option<Outline>> =
        (0..n_faces).into_par_iter().map(|face| oracle.outline(face)).collect();
    let of_face = |(row, &face): (usize, &usize)| {
        let Some(outline) = outlines[face] else { return Errors::default() };
        let contours = seen.face_contours(&seen.faces[row]);
        let ends = contours.flat_map(|corners| corners.iter().zip(corners.iter().cycle().skip(1)));
        let position = |id: &ugscene::VertexId| seen.vertices[id.index()].position - eye;
        ends.map(|(a, b)| of_chord(&outline, [position(a), position(b)]))
            .fold(Errors::default(), Errors::and)
    };
    origin.par_iter().enumerate().map(of_face).reduce(Errors::default, Errors::and)
}

fn of_chord(outline: &Outline, ends: [DVec3; 2]) -> Errors {
    let edge = (0..outline.n_edges()).find(|&edge| outline.has(edge, ends));
    edge.map_or_else(Errors::default, |edge| chord_error(outline, edge, ends))
}

/// The error of a straight line between two apparent points of one edge.
fn chord_error(outline: &Outline, edge: usize, ends: [DVec3; 2]) -> Errors {
    let mut errors = Errors { n_edges: 1, ..Errors::default() };
    for drawn in drawn(ends) {
        let exact = outline.nearest(edge, drawn).normalize();
        errors.angle = errors.angle.max(libm::atan2(drawn.cross(exact).length(), drawn.dot(exact)));
    }
    errors
}

/// Directions along a drawn line, in equal steps between the directions of its ends.
fn drawn(ends: [DVec3; 2]) -> impl Iterator<Item = DVec3> {
    let [from, to] = ends.map(DVec3::normalize);
    (1..N_POINTS).map(move |step| from.lerp(to, f64::from(step) / f64::from(N_POINTS)).normalize())
}
