//! Positions of a moving body, by frame. A seen position and a rest position are the same numbers
//! for a body at rest, and easily confused for a moving one.

use glam::DVec3;

/// Where a point is seen: relative to the eye, in the frame of the camera. p of (P3).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeenPosition(pub DVec3);

/// Where a point rests: relative to the eye, in the rest frame of its body, with the axes of a
/// single boost to the frame of the camera. p' of (P3).
///
/// [`ugphysics::RestFrame::scene_from_boosted`] turns it into the axes of the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RestPosition(pub DVec3);
