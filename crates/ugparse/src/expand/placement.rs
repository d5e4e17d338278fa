//! The context in which a definition is expanded.

use std::ops::Range;

use rustc_hash::FxHashMap;
use ugscene::{BodyId, ColorId, VertexId};

use crate::scope::{DefaultColor, NO_ROW, Scope};
use crate::transform::Transform;

/// Properties that a definition inherits from the calls that place it.
pub(super) struct Inherited {
    pub transform: Transform,
    /// Prefix of paths, without the last `:`.
    pub prefix: String,
    pub color: Option<ColorId>,
    /// The body of what has no motion of its own, if a call states one.
    pub body: Option<BodyId>,
}

impl Inherited {
    /// For the file itself, which inherits nothing.
    pub fn file() -> Self {
        Self { transform: Transform::IDENTITY, prefix: String::new(), color: None, body: None }
    }
}

/// A definition during expansion.
pub(super) struct Placement<'p> {
    pub scope: &'p Scope<'p>,
    pub inherited: &'p Inherited,
    /// Row of its first vertex in the scene.
    pub first_vertex: u32,
    /// The vertices at corners that name those of instances.
    pub paths: FxHashMap<usize, VertexId>,
    /// Rows in the scene of the scope's bodies; without a motion, that which is inherited.
    pub bodies: &'p [BodyId],
    pub first_time: bool,
    /// Row of the scope's first colour in the scene.
    pub first_color: usize,
    /// Row of the scope's first shading in the scene.
    pub first_shading: usize,
    /// The unnamed colour in effect at the `def`.
    pub outer_default: Option<ColorId>,
}

impl Placement<'_> {
    /// Positions of the corners of a contour among those of the scope.
    pub fn corners(&self, row: u32) -> Range<usize> {
        let first = self.scope.contours.first_corner(row);
        first..first + self.scope.contours.get(row).len()
    }

    /// The vertex at a corner.
    pub fn corner(&self, idx: usize) -> VertexId {
        let VertexId(local) = self.scope.contours.corner(idx);
        if local == NO_ROW { self.paths[&idx] } else { VertexId(self.first_vertex + local) }
    }

    /// The colour of face or wire `row`; `first` returns the first row to which an unnamed colour
    /// applies.
    pub fn color(
        &self,
        own: Option<ColorId>,
        row: usize,
        first: fn(&DefaultColor) -> usize,
    ) -> Option<ColorId> {
        own.or(self.inherited.color).or_else(|| {
            let defaults = &self.scope.defaults;
            let behind = defaults.partition_point(|default| first(default) <= row);
            match behind.checked_sub(1) {
                Some(idx) => {
                    Some(ColorId::from_index(self.first_color + defaults[idx].color as usize))
                }
                None => self.outer_default,
            }
        })
    }
}
