//! Channels of EXR pictures besides colour: the emission event, Doppler factor and body seen at
//! each pixel.

use glam::DVec3;
use rayon::prelude::*;
use ugimage::{LinearFrame, Plane, Samples};
use ugphysics::{length, unit_or_zero};

use crate::emission::{Emission, SeenItem};

/// A channel of one number per pixel, or three. Its values are those of the surface at the sample
/// nearest to the pixel's centre, never a mean.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Channel {
    /// `D`: the Doppler factor (P10); 0 where nothing is visible.
    Doppler,
    /// `time`: when the light was emitted, relative to the picture at time 0; −∞ where nothing is
    /// visible.
    Time,
    /// `distance`: from the eye to the emission event; ∞ where nothing is visible.
    Distance,
    /// `Z`: depth of the emission event along the view, or its distance if the camera is no
    /// pinhole; ∞ where nothing is visible.
    Depth,
    /// `id`: faces counted from 1 in the order of the scene, then wires; 0 where nothing is
    /// visible.
    Id,
    /// `velocity.X`, `velocity.Y`, `velocity.Z`: of the body; 0 where nothing is visible.
    Velocity,
    /// `direction.X`, `direction.Y`, `direction.Z`: unit vector to what is seen, in the rest
    /// frame of the body and the axes of the scene (P6), (P25); 0 where nothing is visible.
    Direction,
    /// `position.X`, `position.Y`, `position.Z`: the emission event in the scene, in the frame of
    /// the camera; 0 where nothing is visible.
    Position,
    /// `ray.X`, `ray.Y`, `ray.Z`: unit vector from the eye to the emission event, in the frame of
    /// the camera and the axes of the scene; 0 where nothing is visible.
    Ray,
}

impl Channel {
    /// All channels with their names, in the order of the variants.
    pub const NAMES: [(&'static str, Self); 9] = [
        ("D", Self::Doppler),
        ("time", Self::Time),
        ("distance", Self::Distance),
        ("Z", Self::Depth),
        ("id", Self::Id),
        ("velocity", Self::Velocity),
        ("direction", Self::Direction),
        ("position", Self::Position),
        ("ray", Self::Ray),
    ];

    /// Its name.
    pub fn name(self) -> &'static str {
        Self::NAMES[self as usize].0
    }
}

/// Adds channels to a picture. `eye`: in scene coordinates; `seen`: what is seen at a pixel, counted
/// row after row.
pub fn push_channels(
    frame: &mut LinearFrame,
    channels: &[Channel],
    eye: DVec3,
    seen: &(impl Fn(usize) -> Option<SeenItem> + Sync),
) {
    for &channel in channels {
        let planes = planes(channel, frame.pixels().len(), eye, seen);
        planes.into_iter().for_each(|plane| frame.push_plane(plane));
    }
}

/// The planes of a channel in a picture of `n_pixels`.
fn planes(
    channel: Channel,
    n_pixels: usize,
    eye: DVec3,
    seen: &(impl Fn(usize) -> Option<SeenItem> + Sync),
) -> Vec<Plane> {
    let of = |number: &(dyn Fn(&Emission) -> f64 + Sync), nothing: f32| {
        let number =
            |idx: usize| seen(idx).map_or(nothing, |(_, emission)| finite(number(&emission)));
        Samples::Float((0..n_pixels).into_par_iter().map(number).collect())
    };
    let plane = |name: &str, samples| Plane { name: name.to_owned(), samples };
    let name = channel.name();
    let axes = |vector: &(dyn Fn(&Emission) -> DVec3 + Sync)| {
        let axis =
            |(axis, letter)| plane(&format!("{name}.{letter}"), of(&move |e| vector(e)[axis], 0.0));
        ["X", "Y", "Z"].into_iter().enumerate().map(axis).collect()
    };
    match channel {
        Channel::Doppler => vec![plane(name, of(&Emission::doppler, 0.0))],
        Channel::Time => vec![plane(name, of(&|emission| emission.time, f32::NEG_INFINITY))],
        Channel::Distance => {
            vec![plane(name, of(&|emission| length(emission.place), f32::INFINITY))]
        }
        Channel::Depth => vec![plane(name, of(&|emission| emission.depth, f32::INFINITY))],
        Channel::Id => {
            let id = |idx: usize| seen(idx).map_or(0, |(item, _)| item.saturating_add(1));
            vec![plane(name, Samples::Whole((0..n_pixels).into_par_iter().map(id).collect()))]
        }
        Channel::Velocity => axes(&|emission| emission.velocity.beta()),
        Channel::Direction => axes(&Emission::rest_direction),
        Channel::Position => axes(&|emission| eye + emission.place),
        Channel::Ray => axes(&|emission| unit_or_zero(emission.place)),
    }
}

/// Rounded to single precision. Numbers beyond its range become the largest, since an infinite
/// number stands for nothing visible; NaN becomes 0.
fn finite(number: f64) -> f32 {
    if number.is_nan() { 0.0 } else { (number as f32).clamp(-f32::MAX, f32::MAX) }
}
