//! Bodies, the parts of a scene that move as one, and their motions.

use std::ops::Index;

use ugphysics::{InertialFrame, Velocity, WorldLine};

use super::ids::{BodyId, NameId};
use super::motion::StatedMotion;

/// A part of the scene that moves as one.
///
/// Its name tells it from others that move alike. Bodies without a name are told apart by what the
/// text states of them: velocity and reference point.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// Its name, if it has one.
    pub name: Option<NameId>,
    /// How it moves.
    line: WorldLine,
    /// The statement that gives its motion, if it has one.
    statement: Option<StatedMotion>,
    /// True if the text states its motion. If not, it rests in the frame of the scene, unless a
    /// program is given another default (`-vel`).
    is_stated: bool,
}

/// The bodies of a scene, one or more, and their motions.
#[derive(Clone, Debug, PartialEq)]
pub struct Bodies {
    rows: Vec<Body>,
}

impl Default for Bodies {
    /// One body, of all faces and wires whose motion is not stated.
    fn default() -> Self {
        Self {
            rows: vec![Body {
                name: None,
                line: WorldLine::REST,
                statement: None,
                is_stated: false,
            }],
        }
    }
}

impl Bodies {
    /// Adds a body whose motion is stated.
    pub fn push(&mut self, name: Option<NameId>, motion: WorldLine) -> BodyId {
        self.rows.push(Body { name, line: motion, statement: None, is_stated: true });
        BodyId::from_index(self.rows.len() - 1)
    }

    /// The body of all faces and wires whose motion is not stated, and of vertices that none of
    /// them uses.
    pub fn unstated(&self) -> BodyId {
        // The table begins with it.
        BodyId(0)
    }

    /// Finds the body without a name whose stated motion is this velocity, with the origin as
    /// reference point, or adds it. The search is linear.
    pub fn moving_with(&mut self, velocity: Velocity) -> BodyId {
        let line = WorldLine::inertial(InertialFrame::new(velocity));
        let known = |&id: &BodyId| {
            self[id].name.is_none() && self[id].is_stated && *self.motion(id) == line
        };
        match self.ids().find(known) {
            Some(id) => id,
            None => self.push(None, line),
        }
    }

    /// Replaces the names of all bodies that have one.
    pub(crate) fn rename(&mut self, mut name: impl FnMut(NameId) -> NameId) {
        self.rows.iter_mut().flat_map(|body| &mut body.name).for_each(|own| *own = name(*own));
    }

    /// The motion of a body in the frame of the scene.
    pub fn motion(&self, id: BodyId) -> &WorldLine {
        &self[id].line
    }

    /// The statement that gives the motion of a body with a name; `None` if the text gives its
    /// faces a velocity instead.
    pub fn statement(&self, id: BodyId) -> Option<&StatedMotion> {
        self[id].statement.as_ref()
    }

    /// A body, the one that it is part of, the one that this is part of, and so on.
    pub fn carriers(&self, id: BodyId) -> impl Iterator<Item = BodyId> + '_ {
        std::iter::successors(Some(id), |&body| self.statement(body).and_then(StatedMotion::body))
    }

    /// Gives a body a name and a motion with a statement, whose world line is `line`.
    pub fn set_statement(
        &mut self,
        id: BodyId,
        name: NameId,
        statement: StatedMotion,
        line: WorldLine,
    ) {
        let statement = Some(statement);
        self.rows[id.index()] = Body { name: Some(name), line, statement, is_stated: true };
    }

    /// The bodies whose motions have statements, in the order in which they are written.
    pub fn stated_by_name(&self) -> impl Iterator<Item = BodyId> + '_ {
        self.ids().filter(|&id| self.statement(id).is_some())
    }

    /// True if a body accelerates, turns or runs on a circle, so that its points have velocities of
    /// their own.
    pub fn is_on_world_line(&self, id: BodyId) -> bool {
        self.motion(id).inertial_frame().is_none()
    }

    /// True if [`Bodies::is_on_world_line`] holds for any body.
    pub fn has_world_lines(&self) -> bool {
        self.ids().any(|id| self.is_on_world_line(id))
    }

    /// The velocity of a body in the frame of the scene, at its own time 0; at all times if it
    /// neither accelerates nor turns.
    pub fn velocity(&self, id: BodyId) -> Velocity {
        self.motion(id).initial_velocity()
    }

    /// The velocity that the text states for the parts of a body; `None` if it states none.
    pub fn stated_velocity(&self, id: BodyId) -> Option<Velocity> {
        self[id].is_stated.then(|| self.velocity(id))
    }

    /// Makes a body inertial, with this motion in the text.
    pub fn set_frame(&mut self, id: BodyId, frame: InertialFrame) {
        let body = &mut self.rows[id.index()];
        (body.line, body.is_stated) = (WorldLine::inertial(frame), true);
        let statement = |_| StatedMotion {
            at: frame.at,
            shift: frame.shift,
            ..StatedMotion::inertial(frame.velocity)
        };
        body.statement = body.statement.take().map(statement);
    }

    /// True if any body moves in the frame of the scene.
    pub fn has_motion(&self) -> bool {
        self.ids().any(|id| self.is_moving(id))
    }

    /// True if a body moves in the frame of the scene, or is displaced there.
    pub fn is_moving(&self, id: BodyId) -> bool {
        let rest = |frame: &InertialFrame| InertialFrame { at: frame.at, ..InertialFrame::REST };
        self.motion(id).inertial_frame().is_none_or(|frame| *frame != rest(frame))
    }

    /// The ids of all bodies, in order.
    pub fn ids(
        &self,
    ) -> impl ExactSizeIterator<Item = BodyId> + DoubleEndedIterator + Clone + use<> {
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
