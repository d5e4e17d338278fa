//! Bodies, the parts of a scene that share a motion, and their motions.

use std::ops::{Index, IndexMut};

use ugphysics::Velocity;

/// Row of [`Bodies`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct BodyId(u32);

impl BodyId {
    /// The first body of every scene: all faces and wires whose motion is not stated. The text
    /// gives them no velocity. It rests in the frame of the scene, unless a program is given
    /// another default (`-vel`).
    pub const UNSTATED: Self = Self(0);

    /// The id of the body at position `idx` of its table.
    ///
    /// # Panics
    /// If `idx` does not fit 32 bits; the reader refuses such scenes.
    pub fn from_index(idx: usize) -> Self {
        Self(u32::try_from(idx).expect("tables have fewer than 2^32 rows"))
    }

    /// Position in its table.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// A part of the scene with one motion. Two bodies may have equal motions.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Body {
    /// Its motion in the frame of the scene.
    pub motion: Motion,
}

impl Body {
    /// A body of constant velocity.
    pub fn inertial(velocity: Velocity) -> Self {
        Self { motion: Motion::Inertial(velocity) }
    }
}

/// The motion of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Motion {
    /// Constant velocity. The text stores its β, from which [`Velocity::from_beta`] must recover it
    /// exactly.
    Inertial(Velocity),
}

impl Default for Motion {
    /// At rest.
    fn default() -> Self {
        Self::Inertial(Velocity::ZERO)
    }
}

/// The bodies of a scene. [`BodyId::UNSTATED`] is always among them.
#[derive(Clone, Debug, PartialEq)]
pub struct Bodies {
    rows: Vec<Body>,
}

impl Default for Bodies {
    /// [`BodyId::UNSTATED`] alone, at rest.
    fn default() -> Self {
        Self { rows: vec![Body::default()] }
    }
}

impl Bodies {
    /// Adds a body.
    pub fn push(&mut self, body: Body) -> BodyId {
        self.rows.push(body);
        BodyId::from_index(self.rows.len() - 1)
    }

    /// Finds the first body whose stated motion is `motion`, or adds one.
    ///
    /// Scenes have few bodies, so the search is linear.
    pub fn moving_with(&mut self, motion: Motion) -> BodyId {
        let known = self.rows.iter().skip(1).position(|body| body.motion == motion);
        known.map_or_else(|| self.push(Body { motion }), |idx| BodyId::from_index(idx + 1))
    }

    /// The velocity that the text states for the parts of a body; `None` for [`BodyId::UNSTATED`]
    /// at rest.
    pub fn stated_velocity(&self, id: BodyId) -> Option<Velocity> {
        let Motion::Inertial(velocity) = self[id].motion;
        (id != BodyId::UNSTATED || !velocity.is_zero()).then_some(velocity)
    }

    /// All bodies, [`BodyId::UNSTATED`] first.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &Body> + DoubleEndedIterator + Clone {
        self.rows.iter()
    }

    /// All bodies, mutable.
    pub fn iter_mut(&mut self) -> impl ExactSizeIterator<Item = &mut Body> + DoubleEndedIterator {
        self.rows.iter_mut()
    }

    /// The ids of all bodies, in order.
    pub fn ids(&self) -> impl ExactSizeIterator<Item = BodyId> + Clone + use<> {
        (0..self.rows.len() as u32).map(BodyId)
    }

    /// The number of bodies, 1 or more.
    #[expect(clippy::len_without_is_empty, reason = "never empty")]
    pub fn len(&self) -> usize {
        self.rows.len()
    }
}

impl Index<BodyId> for Bodies {
    type Output = Body;

    fn index(&self, id: BodyId) -> &Body {
        &self.rows[id.index()]
    }
}

impl IndexMut<BodyId> for Bodies {
    fn index_mut(&mut self, id: BodyId) -> &mut Body {
        &mut self.rows[id.index()]
    }
}
