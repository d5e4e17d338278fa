//! Faces drawn with one ray per sample, exact at every sample (`-xc`).
//!
//! After T. Müller, S. Grottel and D. Weiskopf, *Special relativistic visualization by local ray
//! tracing* (2010): the viewing direction of a sample is transformed to the rest frame of a face
//! (P6) and intersected with the plane of the face there. Outline, depth, Doppler factor, colour
//! and light are those of the intersection; faces need no subdivision, and nothing is interpolated
//! in the picture. The steps, one file each:
//!
//! 1. [`frame`]: rays of a row of samples in the rest frame of a body;
//! 2. [`film`]: linear functions of these rays: side of an edge, depth, and D;
//! 3. [`outline`]: whether a ray passes through a face;
//! 4. [`footprint`]: the part of the picture that a face can cover, bounded by arcs of conics (P8);
//! 5. [`sections`]: where a row of samples enters and leaves a face;
//! 6. [`nearest`]: the nearest face at each sample;
//! 7. [`look`]: colour and light at a point of a face at rest, for visible points alone;
//! 8. [`faces`]: all faces of a scene as a layer for the rasterizer: the nearest alone, or all as
//!    transparent fragments;
//! 9. [`wires`]: lines as polylines fine enough for the picture.
//!
//! # Watertight edges
//!
//! A ray is in a face if a half plane that begins at the ray crosses the outline of the face an odd
//! number of times. The side of an edge on which the ray runs is computed from the ends in a fixed
//! order, so faces that share an edge obtain the same bits. Summed over faces that share edges, the
//! crossings of shared edges cancel, and those of the common outline remain: a sample inside the
//! outline is in an odd number of faces, and so in at least one.
//!
//! # Row by row
//!
//! Testing each sample separately would be slow. The side of an edge and the depth of a plane are
//! linear in p', and so in p and |p| ([`film`]). Along a row of samples they are a straight line
//! plus a multiple of |p|; such a function is convex or concave and changes sign at most twice.
//! Between the columns of these changes all samples are in the face or all are outside, so one of
//! them is tested. Samples where rounding could decide are tested one by one.

mod faces;
mod film;
mod footprint;
mod frame;
mod look;
mod nearest;
mod outline;
mod sections;
mod wires;

pub use faces::Faces;
pub use wires::CurvedLines;
