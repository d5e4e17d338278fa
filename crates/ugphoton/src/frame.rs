//! The rest frame of bodies that move alike, and the way there.

use glam::{DMat3, DVec3};
use ugphysics::{Event, Velocity, WaveVector};
use ugscene::{BodyId, RestFrames};

/// The rest frame of bodies of one velocity. Its axes are those of the scene; at the moment of the
/// picture its origin is at the eye.  Eq. (P21), (P25)
#[derive(Clone, Debug)]
pub struct RestFrame {
    /// The velocity of its bodies, in the frame of the camera.
    pub velocity: Velocity,
    /// One of the bodies.
    pub body: BodyId,
    axis: DVec3,
    gamma: f64,
    gamma_minus_one: f64,
    proper_speed: f64,
    is_at_rest: bool,
    /// Axes of the scene from those of a single boost; `None` if they are the same.
    turn: Option<DMat3>,
}

impl RestFrame {
    /// The rest frame of a body.
    pub fn new(frames: &RestFrames, body: BodyId) -> Self {
        let velocity = frames.velocity(body);
        let turn = DMat3::from_quat(frames.scene_from_axes(body));
        Self {
            velocity,
            body,
            axis: velocity.direction(),
            gamma: velocity.gamma(),
            gamma_minus_one: velocity.gamma_minus_one(),
            proper_speed: velocity.proper_speed(),
            is_at_rest: velocity.is_zero(),
            turn: (turn != DMat3::IDENTITY).then_some(turn),
        }
    }

    /// Transforms an event or a step from the frame of the camera.
    #[inline]
    pub fn to_rest(&self, Event { t, x }: Event) -> Event {
        if self.is_at_rest {
            return Event { t, x: self.turned(x) };
        }
        let along = x.dot(self.axis);
        let moved = x + self.axis * (self.gamma_minus_one * along - self.proper_speed * t);
        Event { t: self.gamma * t - self.proper_speed * along, x: self.turned(moved) }
    }

    /// The inverse of [`RestFrame::to_rest`].
    #[inline]
    pub fn to_camera(&self, Event { t, x }: Event) -> Event {
        let x = self.turn.map_or(x, |turn| turn.transpose() * x);
        if self.is_at_rest {
            return Event { t, x };
        }
        let along = x.dot(self.axis);
        let moved = x + self.axis * (self.gamma_minus_one * along + self.proper_speed * t);
        Event { t: self.gamma * t + self.proper_speed * along, x: moved }
    }

    /// Where something at rest is at the moment of the picture, in the frame of the camera.
    pub fn contracted(&self, place: DVec3) -> DVec3 {
        let place = self.turn.map_or(place, |turn| turn.transpose() * place);
        place - self.axis * (self.gamma_minus_one / self.gamma * place.dot(self.axis))
    }

    /// Its Lorentz factor.
    pub fn gamma(&self) -> f64 {
        self.gamma
    }

    /// The step of a ray of light into the past, (−|d|, d) in the frame of the camera. It loses no
    /// digits.  Eq. (P6)
    #[inline]
    pub fn light_to_rest(&self, d: DVec3) -> DVec3 {
        if self.is_at_rest {
            return self.turned(d);
        }
        let (along, length) = (d.dot(self.axis), d.length());
        let moved = if along < 0.0 {
            // γa + u r, with r² − a² the square of the distance to the axis.
            let across = (d - along * self.axis).length_squared();
            (along * along - self.proper_speed * self.proper_speed * across)
                / (self.gamma * along - self.proper_speed * length)
        } else {
            self.gamma * along + self.proper_speed * length
        };
        self.turned(d + (moved - along) * self.axis)
    }

    /// The wave vector of light given in the frame of the camera.
    pub fn wave_to_rest(&self, wave: WaveVector) -> WaveVector {
        let Event { t, x } = self.to_rest(Event { t: wave.frequency, x: wave.k });
        WaveVector { frequency: t, k: x }
    }

    /// The inverse of [`RestFrame::wave_to_rest`].
    pub fn wave_to_camera(&self, wave: WaveVector) -> WaveVector {
        let Event { t, x } = self.to_camera(Event { t: wave.frequency, x: wave.k });
        WaveVector { frequency: t, k: x }
    }

    /// A velocity in this frame, from the axes of a single boost to those of the scene.
    pub fn turned_velocity(&self, velocity: Velocity) -> Velocity {
        match self.turn {
            None => velocity,
            Some(turn) => {
                Velocity::from_rapidity(turn * velocity.direction(), velocity.rapidity()).unwrap_or(velocity)
            }
        }
    }

    #[inline]
    fn turned(&self, x: DVec3) -> DVec3 {
        self.turn.map_or(x, |turn| turn * x)
    }
}
