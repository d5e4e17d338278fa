//! Channels of EXR pictures besides colour: the emission event, Doppler factor and body seen at
//! each pixel.

use rayon::prelude::*;
use ugimage::{Plane, Samples};
use ugphysics::{doppler_at, length};

use crate::depth_buffer::SurfaceSample;
use crate::emission::{Emission, Emissions};

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
    /// `Z`: depth of the emission event along the view; ∞ where nothing is visible.
    Depth,
    /// `id`: faces counted from 1 in the order of the scene, then wires; 0 where nothing is
    /// visible.
    Id,
    /// `velocity.X`, `velocity.Y`, `velocity.Z`: of the body; 0 where nothing is visible.
    Velocity,
}

impl Channel {
    /// All channels.
    pub const ALL: [Self; 6] =
        [Self::Doppler, Self::Time, Self::Distance, Self::Depth, Self::Id, Self::Velocity];

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Doppler => "D",
            Self::Time => "time",
            Self::Distance => "distance",
            Self::Depth => "Z",
            Self::Id => "id",
            Self::Velocity => "velocity",
        }
    }

    /// The channel called `name`.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|channel| channel.name() == name)
    }

    /// All names, separated by commas, for messages.
    pub fn list() -> String {
        Self::ALL.map(Self::name).join(", ")
    }
}

/// The planes of a channel. `seen`: emission events at the middles of pixels, row after row, in
/// pictures of `width` pixels across with `samples` × `samples` samples each.
pub fn channel_planes(
    channel: Channel,
    emissions: &Emissions<'_>,
    [width, samples]: [u32; 2],
    seen: &[Option<SurfaceSample>],
) -> Vec<Plane> {
    let of = |number: &(dyn Fn(&Emission) -> f64 + Sync), nothing: f32| {
        let numbers = seen.par_iter().enumerate().map(|(idx, seen)| {
            let Some(seen) = *seen else { return nothing };
            finite(number(&emissions.at(middle([width, samples], idx), seen)))
        });
        Samples::Float(numbers.collect())
    };
    let plane = |name: &str, samples| Plane { name: name.to_owned(), samples };
    let name = channel.name();
    match channel {
        Channel::Doppler => {
            vec![plane(name, of(&|emission| doppler_at(emission.place, emission.velocity), 0.0))]
        }
        Channel::Time => vec![plane(name, of(&|emission| emission.time, f32::NEG_INFINITY))],
        Channel::Distance => vec![plane(name, of(&|emission| length(emission.place), f32::INFINITY))],
        Channel::Depth => vec![plane(name, of(&|emission| emission.depth, f32::INFINITY))],
        Channel::Id => {
            let ids = seen.iter().map(|seen| seen.map_or(0, |seen| seen.item.saturating_add(1)));
            vec![plane(name, Samples::Whole(ids.collect()))]
        }
        Channel::Velocity => ["X", "Y", "Z"]
            .into_iter()
            .enumerate()
            .map(|(axis, letter)| {
                let part = of(&move |emission| emission.velocity.beta()[axis], 0.0);
                plane(&format!("{name}.{letter}"), part)
            })
            .collect(),
    }
}

/// Rounded to single precision. Numbers beyond its range become the largest, since an infinite
/// number stands for nothing visible; NaN becomes 0.
fn finite(number: f64) -> f32 {
    if number.is_nan() { 0.0 } else { (number as f32).clamp(-f32::MAX, f32::MAX) }
}

/// The sample nearest to the centre of a pixel; ties go to the lower-right one.
fn middle([width, samples]: [u32; 2], idx: usize) -> [u32; 2] {
    let width = width as usize;
    // A picture has fewer than 2^32 pixels.
    [idx % width, idx / width].map(|pixel| pixel as u32 * samples + samples / 2)
}
