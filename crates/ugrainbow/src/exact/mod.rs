//! Faces drawn by a ray for each sample, exact everywhere (`-xc`).
//!
//! After T. Müller, S. Grottel and D. Weiskopf, *Special relativistic visualization by local ray
//! tracing* (2010): the viewing direction of a sample is carried into the rest frame of a face (P6)
//! and meets the face's plane there. Outline, depth, Doppler factor, colour and light are those of
//! that point; nothing is cut into pieces, and nothing is interpolated in the picture. Its steps,
//! one file each:
//!
//! 1. [`frame`]: rays of a row of samples in the rest frame of a body;
//! 2. [`film`]: what is linear in them: on which side of an edge they run, depth, and D;
//! 3. [`outline`]: whether a ray goes through a face;
//! 4. [`footprint`]: the part of the picture outside of which no ray does, from arcs of conics
//!    (P8);
//! 5. [`sections`]: where in a row rays begin and cease to do so;
//! 6. [`nearest`]: which face is nearest, sample by sample;
//! 7. [`look`]: colour and light at a point of a face at rest, for what is nearest alone;
//! 8. [`appearance`], [`crate::spectra`]: colour as seen, of a hue or a spectrum;
//! 9. [`faces`]: all faces of a scene as a layer of the raster, the nearest alone or, if light
//!    passes them, all;
//! 10. [`wires`]: lines as polylines fine enough for the picture.
//!
//! # Which sample belongs to whom
//!
//! A ray is in a face if a half plane that begins at the ray meets its outline an odd number of
//! times. On which side of an edge the ray runs is computed from the ends in one order, so that
//! faces that share an edge find the same bits. Summed over faces that share their edges all that
//! is left is the outline of them together: a sample inside it belongs to an odd number of faces,
//! and so to one at least.
//!
//! # Row by row
//!
//! To ask that of every sample would be slow. On which side of an edge a ray runs, and how near it
//! meets a plane, are linear in p' and so in p and |p| ([`film`]); along a row of samples that is a
//! straight line plus a multiple of |p|, which is convex and changes its sign twice at most.
//! Between the columns where an edge changes it, all samples are in the face or none is, and one of
//! them is asked. Samples where rounding might decide are asked one by one.

mod appearance;
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
