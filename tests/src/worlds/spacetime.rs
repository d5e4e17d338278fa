//! Changes of frame by 4×4 matrices, independent of the formulas of the programs.  Eq. (P7)

use glam::{DMat3, DMat4, DVec3, DVec4};

/// Place and time: x, y, z, t.
pub type Event = DVec4;

/// Λ(v): from the frame that moves with `beta` to the frame in which it does.  Eq. (P7)
pub fn boost(beta: DVec3) -> DMat4 {
    let gamma = 1.0 / (1.0 - beta.length_squared()).sqrt();
    // (γ−1)/β² without a division by 0.
    let turned = gamma * gamma / (gamma + 1.0);
    let column =
        |axis: DVec3| (axis + turned * beta.dot(axis) * beta).extend(gamma * beta.dot(axis));
    DMat4::from_cols(
        column(DVec3::X),
        column(DVec3::Y),
        column(DVec3::Z),
        (gamma * beta).extend(gamma),
    )
}

/// Another frame: events x of the old one are at `linear` x + `shift`.
#[derive(Clone, Copy, Debug)]
pub struct Change {
    /// A boost, a rotation, or both.
    pub linear: DMat4,
    /// Where and when the old origin is.
    pub shift: Event,
}

impl Change {
    /// Transforms a frame that moves with `beta` in the old frame: its velocity in the new one,
    /// and the map of its rest coordinates to those of the boost with that velocity.
    pub fn of_frame(&self, beta: DVec3) -> (DVec3, RestChange) {
        let moved = self.linear * boost(beta);
        let fourth = moved.w_axis;
        let velocity = fourth.truncate() / fourth.w;
        let back = boost(-velocity);
        let turn = DMat3::from_mat4(back * moved);
        (velocity, RestChange { turn, shift: (back * self.shift).truncate() })
    }
}

/// A change of rest coordinates.
#[derive(Clone, Copy, Debug)]
pub struct RestChange {
    /// A rotation.
    pub turn: DMat3,
    /// Added after it.
    pub shift: DVec3,
}

impl RestChange {
    /// Transforms a point.
    pub fn place(&self, place: DVec3) -> DVec3 {
        self.turn * place + self.shift
    }
}

/// The rest coordinates of a point that moves with `beta` and is at `event`.
pub fn rest_place(event: Event, beta: DVec3) -> DVec3 {
    (boost(-beta) * event).truncate()
}

/// The direction, in the frame that moves with `beta`, toward the source of light that comes from
/// `toward` in the frame in which it does. Not normalised: the length is 1/D.
pub fn aberrated(toward: DVec3, beta: DVec3) -> DVec3 {
    rest_place(toward.extend(-toward.length()), beta)
}
