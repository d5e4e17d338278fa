//! What a definition inherits from what places it.

use std::ops::Range;

use rustc_hash::FxHashMap;

use crate::body::BodyId;
use crate::group::{DefaultColor, Group, NO_ROW};
use crate::scene::{ColorId, LightMotion, VertexId};
use crate::transform::Transform;

/// What a group inherits from the calls that place it.
pub(super) struct Frame {
    pub transform: Transform,
    /// Path of the names made here, without the last `:`.
    pub prefix: String,
    pub color: Option<ColorId>,
    /// The body that all it holds is part of, if a call states a velocity.
    pub body: Option<BodyId>,
}

impl Frame {
    /// That of the file itself, which nothing places.
    pub fn file() -> Self {
        Self { transform: Transform::IDENTITY, prefix: String::new(), color: None, body: None }
    }
}

/// A definition that is being placed.
pub(super) struct Placement<'p> {
    pub group: &'p Group<'p>,
    pub frame: &'p Frame,
    /// Row of its first vertex in the scene.
    pub first_vertex: u32,
    /// The vertices at corners that name those of instances.
    pub paths: FxHashMap<usize, VertexId>,
    /// Rows in the scene of the group's bodies.
    pub bodies: &'p [BodyId],
    pub first_time: bool,
    /// Row of the group's first colour in the scene.
    pub first_color: usize,
    /// Row of the group's first illum in the scene.
    pub first_illum: usize,
    /// The unnamed colour in force at the `def`.
    pub outer_default: Option<ColorId>,
}

impl Placement<'_> {
    /// Positions of the corners of a contour among those of the group.
    pub fn corners(&self, row: u32) -> Range<usize> {
        let first = self.group.contours.first_corner(row);
        first..first + self.group.contours.get(row).len()
    }

    /// The vertex at a corner.
    pub fn corner(&self, idx: usize) -> VertexId {
        let VertexId(local) = self.group.contours.corner(idx);
        if local == NO_ROW { self.paths[&idx] } else { VertexId(self.first_vertex + local) }
    }

    /// The body in the scene of a face or wire.
    pub fn body(&self, own: BodyId) -> BodyId {
        self.frame.body.unwrap_or(self.bodies[own.index()])
    }

    /// A light keeps its own motion.
    pub fn light_motion(&self, own: LightMotion) -> LightMotion {
        match own {
            LightMotion::WithWhatItLights => own,
            LightMotion::Body(body) => LightMotion::Body(self.bodies[body.index()]),
        }
    }

    /// The colour of face or wire `row`; `first` says from which row on an unnamed colour is in force.
    pub fn color(
        &self,
        own: Option<ColorId>,
        row: usize,
        first: fn(&DefaultColor) -> usize,
    ) -> Option<ColorId> {
        own.or(self.frame.color).or_else(|| {
            let defaults = &self.group.defaults;
            let behind = defaults.partition_point(|default| first(default) <= row);
            match behind.checked_sub(1) {
                Some(idx) => Some(ColorId::from_index(self.first_color + defaults[idx].color as usize)),
                None => self.outer_default,
            }
        })
    }
}
