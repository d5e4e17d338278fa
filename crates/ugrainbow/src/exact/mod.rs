//! Faces drawn with one ray per sample, exact at every sample (`-xc`).
//!
//! [`ugtrace::outlines`] finds the nearest face at each sample, and [`ugtrace::rays`] those of
//! bodies on world lines. Doppler factor, colour and light are those of the intersection; nothing
//! is interpolated in the picture:
//!
//! 1. [`look`]: colour and light at a point of a face at rest, for visible points alone;
//! 2. [`faces`]: all faces of a scene as a layer for the rasterizer: the nearest alone, or all as
//!    transparent fragments;
//! 3. [`moving`]: faces of bodies that accelerate or turn, within this layer.

mod faces;
mod look;
mod moving;

pub use faces::Faces;
