//! The rest frame of a body, and transformations to it from the frame of the camera.

use glam::{DMat3, DQuat, DVec3};

use crate::{Event, Velocity, WaveVector};

/// The rest frame of a body, as the camera sees it. At time 0 its origin is at that of the frame of
/// the camera, the eye.
///
/// Its axes are those of the scene. They are not always those of a single boost from the frame of
/// the camera: if the camera moves in the scene, the boost to the camera and that to the body leave
/// a turn, (P25).
///
/// ```
/// use glam::DVec3;
/// use ugphysics::{Event, RestFrame, Velocity};
///
/// let frame = RestFrame::new(Velocity::from_beta(DVec3::new(0.6, 0.0, 0.0))?);
/// let rest = frame.rest_from_camera(Event { t: 0.0, x: DVec3::new(4.0, 1.0, 0.0) });
/// assert_eq!(rest, Event { t: -3.0, x: DVec3::new(5.0, 1.0, 0.0) });
/// # Ok::<(), ugphysics::VelocityError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RestFrame {
    velocity: Velocity,
    gamma_minus_one: f64,
    /// Axes of the scene from those of a single boost.
    scene_from_boosted: DQuat,
    /// The same as a matrix; `None` for the identity.
    turn: Option<DMat3>,
}

impl RestFrame {
    /// The frame of the camera itself.
    pub const CAMERA: Self = Self {
        velocity: Velocity::ZERO,
        gamma_minus_one: 0.0,
        scene_from_boosted: DQuat::IDENTITY,
        turn: None,
    };

    /// The rest frame of a body with `velocity` in the frame of the camera, with the axes of a
    /// single boost.
    pub fn new(velocity: Velocity) -> Self {
        Self::turned(velocity, DQuat::IDENTITY)
    }

    /// Like [`RestFrame::new`], with other axes. `scene_from_boosted`: the turn from the axes of a
    /// single boost to the axes of the scene.  Eq. (P25)
    pub fn turned(velocity: Velocity, scene_from_boosted: DQuat) -> Self {
        let turn = DMat3::from_quat(scene_from_boosted);
        let turn = (turn != DMat3::IDENTITY).then_some(turn);
        Self { velocity, gamma_minus_one: velocity.gamma_minus_one(), scene_from_boosted, turn }
    }

    /// The velocity of the body in the frame of the camera.
    #[inline]
    pub fn velocity(&self) -> Velocity {
        self.velocity
    }

    /// Turns rest coordinates from the axes of a single boost, in which (P4) gives them, to the
    /// axes of the scene. The identity unless the camera moves in the scene.  Eq. (P25)
    pub fn scene_from_boosted(&self) -> DQuat {
        self.scene_from_boosted
    }

    /// The inverse of [`RestFrame::scene_from_boosted`].
    pub fn boosted_from_scene(&self) -> DQuat {
        self.scene_from_boosted.inverse()
    }

    /// True if the axes of the scene are not those of a single boost.
    #[inline]
    pub fn is_turned(&self) -> bool {
        self.turn.is_some()
    }

    /// True if the body rests in the frame of the camera.
    #[inline]
    pub fn is_at_rest(&self) -> bool {
        self.velocity.is_zero()
    }

    /// Transforms an event, or the difference of two, from the frame of the camera.
    #[inline]
    pub fn rest_from_camera(&self, Event { t, x }: Event) -> Event {
        if self.is_at_rest() {
            return Event { t, x: self.turned_to_scene(x) };
        }
        let (axis, proper_speed) = (self.velocity.direction(), self.velocity.proper_speed());
        let along = x.dot(axis);
        let moved = x + axis * (self.gamma_minus_one * along - proper_speed * t);
        Event {
            t: self.velocity.gamma() * t - proper_speed * along,
            x: self.turned_to_scene(moved),
        }
    }

    /// The inverse of [`RestFrame::rest_from_camera`].
    #[inline]
    pub fn camera_from_rest(&self, Event { t, x }: Event) -> Event {
        let x = self.turned_to_boosted(x);
        if self.is_at_rest() {
            return Event { t, x };
        }
        let (axis, proper_speed) = (self.velocity.direction(), self.velocity.proper_speed());
        let along = x.dot(axis);
        let moved = x + axis * (self.gamma_minus_one * along + proper_speed * t);
        Event { t: self.velocity.gamma() * t + proper_speed * along, x: moved }
    }

    /// The place at time 0, in the frame of the camera, of a point at rest at `rest`.  Eq. (P1)
    pub fn contracted(&self, rest: DVec3) -> DVec3 {
        let (rest, axis) = (self.turned_to_boosted(rest), self.velocity.direction());
        rest - axis * (self.gamma_minus_one / self.velocity.gamma() * rest.dot(axis))
    }

    /// The space part, in this frame, of the step of a ray of light into the past, which is
    /// (−|d|, d) in the frame of the camera. It loses no digits.  Eq. (P6)
    #[inline]
    pub fn light_to_rest(&self, d: DVec3) -> DVec3 {
        if self.is_at_rest() {
            return self.turned_to_scene(d);
        }
        let (axis, proper_speed) = (self.velocity.direction(), self.velocity.proper_speed());
        let (along, length) = (d.dot(axis), d.length());
        let moved = if along < 0.0 {
            // γa + u r, with r² − a² the square of the distance to the axis.
            let across = (d - along * axis).length_squared();
            (along * along - proper_speed * proper_speed * across)
                / (self.velocity.gamma() * along - proper_speed * length)
        } else {
            self.velocity.gamma() * along + proper_speed * length
        };
        self.turned_to_scene(d + (moved - along) * axis)
    }

    /// Transforms the wave vector of light from the frame of the camera.
    pub fn wave_to_rest(&self, wave: WaveVector) -> WaveVector {
        let Event { t, x } = self.rest_from_camera(Event { t: wave.frequency, x: wave.k });
        WaveVector { frequency: t, k: x }
    }

    /// The inverse of [`RestFrame::wave_to_rest`].
    pub fn wave_to_camera(&self, wave: WaveVector) -> WaveVector {
        let Event { t, x } = self.camera_from_rest(Event { t: wave.frequency, x: wave.k });
        WaveVector { frequency: t, k: x }
    }

    /// A velocity in this frame, from the axes of a single boost to those of the scene.
    pub fn turned_velocity(&self, velocity: Velocity) -> Velocity {
        match self.turn {
            None => velocity,
            Some(turn) => Velocity::from_rapidity(turn * velocity.direction(), velocity.rapidity())
                .unwrap_or(velocity),
        }
    }

    #[inline]
    fn turned_to_scene(&self, x: DVec3) -> DVec3 {
        self.turn.map_or(x, |turn| turn * x)
    }

    #[inline]
    fn turned_to_boosted(&self, x: DVec3) -> DVec3 {
        self.turn.map_or(x, |turn| turn.transpose() * x)
    }
}
