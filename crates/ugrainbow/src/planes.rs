//! What pixels show besides colour: where and when its light was sent, and with what Doppler factor.

use glam::DVec3;
use rayon::prelude::*;
use ugimage::{Plane, Samples};
use ugphysics::{Velocity, doppler_at};
use ugraster::{Center, Fragment, Hit, SampleGrid};
use ugscene::{Geometry, View};

use crate::lines::LIFT;
use crate::painter::Painter;

/// A number for each pixel, or three: of what is seen at the sample nearest to its centre, never a mean.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Channel {
    /// `D`: the Doppler factor (P10); 0 where nothing is seen.
    Doppler,
    /// `time`: when the light was sent, before the picture is taken at 0; −∞ where nothing is seen.
    Time,
    /// `distance`: from the eye to where the light was sent; ∞ where nothing is seen.
    Distance,
    /// `Z`: the same along the view; ∞ where nothing is seen.
    Depth,
    /// `id`: faces counted from 1 in the order of the scene, then wires; 0 where nothing is seen.
    Id,
    /// `velocity.X`, `velocity.Y`, `velocity.Z`: of the body; 0 where nothing is seen.
    Velocity,
}

impl Channel {
    /// All of them.
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

    /// All names with commas between, for messages.
    pub fn list() -> String {
        Self::ALL.map(Self::name).join(", ")
    }
}

/// What a pixel is taken to show at its middle: the nearest that lets through less than half of what is behind it.
pub fn front(view: &View, center: &Center<'_>) -> Option<Hit> {
    let fragment = center.fragments.iter().rev().find(|fragment| fragment.transmittance < 0.5);
    fragment.map_or(center.opaque, |fragment| Some(seen(view, fragment)))
}

/// What a layer shows, lines where they are.
pub fn seen(view: &View, layer: &Fragment) -> Hit {
    let key = match (layer.is_line, view.is_perspective) {
        (false, _) => layer.key,
        (true, true) => layer.key * (1.0 - LIFT) as f32,
        (true, false) => layer.key - (LIFT * view.distance) as f32,
    };
    Hit { key, item: layer.item }
}

/// Where and when light was sent that is seen in the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Emission {
    /// Of the face or wire; see [`Painter`].
    pub item: u32,
    /// Place relative to the eye, in the frame of the camera.
    pub place: DVec3,
    /// Depth along the view.
    pub depth: f64,
    /// Time, in the frame of the camera; the picture is taken at 0.
    pub time: f64,
    /// Of the body.
    pub velocity: Velocity,
}

/// What finds emissions behind samples.
pub struct Finder<'a> {
    painter: &'a Painter<'a>,
    has_flight_time: bool,
}

impl<'a> Finder<'a> {
    /// For the scene of a painter.
    pub fn new(painter: &'a Painter<'a>) -> Self {
        Self { painter, has_flight_time: Geometry::of(painter.scene).flight_time }
    }

    /// The emission seen at a sample.
    pub fn emission(&self, [column, row]: [u32; 2], seen: Hit) -> Emission {
        let Painter { scene, view, surface, .. } = self.painter;
        let key = f64::from(seen.key);
        let depth = if view.is_perspective { 1.0 / key } else { -key };
        let body = match scene.faces.get(seen.item as usize) {
            Some(face) => Some(face.body),
            None => scene.wires.get(seen.item as usize - scene.faces.len()).map(|wire| wire.body),
        };
        let velocity = body.map_or(Velocity::ZERO, |body| surface.velocity(body));
        let place = view.point([f64::from(column) + 0.5, f64::from(row) + 0.5], depth);
        let time = if self.has_flight_time { -place.length() } else { 0.0 };
        Emission { item: seen.item, place, depth, time, velocity }
    }
}

/// The planes of a channel. `seen`: at the middle of each pixel of the grid.
pub fn planes(channel: Channel, finder: &Finder<'_>, grid: &SampleGrid, seen: &[Option<Hit>]) -> Vec<Plane> {
    let of = |number: &(dyn Fn(&Emission) -> f64 + Sync), nothing: f32| {
        let numbers = seen.par_iter().enumerate().map(|(idx, seen)| {
            let Some(seen) = *seen else { return nothing };
            number(&finder.emission(middle(grid, idx), seen)) as f32
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
        Channel::Distance => vec![plane(name, of(&|emission| emission.place.length(), f32::INFINITY))],
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

/// The sample nearest to the centre of a pixel, of equals the last: see [`ugraster::Center`].
fn middle(grid: &SampleGrid, idx: usize) -> [u32; 2] {
    let width = grid.width as usize;
    // The pixels of a picture are fewer than 2^32.
    [idx % width, idx / width].map(|pixel| pixel as u32 * grid.samples + grid.samples / 2)
}
