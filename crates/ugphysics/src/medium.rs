//! Light in transparent media that move, and its passage from one into another.

use glam::DVec3;

use crate::{Event, Velocity};

/// The wave 4-vector (f, **k**) of light: its frequency, and the wave vector over 2π, along which
/// the phase moves.
///
/// In vacuum |k| = f, in a medium at rest |k| = N f, with N its refractive index.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WaveVector {
    /// Frequency f.
    pub frequency: f64,
    /// **k**; inverse of the wavelength.
    pub k: DVec3,
}

/// A transparent medium, in the frame in which its velocity is measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Medium {
    /// Refractive index N, above 0; 1 is vacuum.
    pub index: f64,
    /// Its velocity.
    pub velocity: Velocity,
}

impl Medium {
    /// Vacuum, which has no velocity.
    pub const VACUUM: Medium = Medium { index: 1.0, velocity: Velocity::ZERO };

    /// N² − 1, in a form that does not cancel.
    fn contrast(&self) -> f64 {
        (self.index - 1.0) * (self.index + 1.0)
    }

    /// The frequency of light in the frame of the medium: −K·U, with U its 4-velocity.
    fn own_frequency(&self, wave: WaveVector) -> f64 {
        self.velocity.gamma() * wave.frequency - self.velocity.proper().dot(wave.k)
    }

    /// A step of the light along its path: K + (N² − 1)(−K·U) U, of a length that depends on the
    /// frequency. In vacuum it is K.  Eq. (P37)
    ///
    /// Energy moves along it: in the frame of the medium along **k**, with speed 1/N.
    ///
    /// ```
    /// use glam::DVec3;
    /// use ugphysics::{Medium, Velocity, WaveVector};
    ///
    /// // Fizeau's experiment: glass that moves with 0.1 c drags light along.
    /// let glass = Medium { index: 1.5, velocity: Velocity::from_beta(DVec3::X * 0.1)? };
    /// let wave = WaveVector { frequency: 1.0, k: DVec3::X * 1.5 }.in_frame(-glass.velocity);
    /// let step = glass.step(wave);
    /// assert!((step.x.x / step.t - 0.71875).abs() < 1e-15);
    /// # Ok::<(), ugphysics::VelocityError>(())
    /// ```
    pub fn step(&self, wave: WaveVector) -> Event {
        let drag = self.contrast() * self.own_frequency(wave);
        if drag == 0.0 {
            return Event { t: wave.frequency, x: wave.k };
        }
        Event {
            t: wave.frequency + drag * self.velocity.gamma(),
            x: wave.k + drag * self.velocity.proper(),
        }
    }

    /// The light of frequency 1 that moves along `direction`, a unit vector; `None` if no light in
    /// the medium does. Where the medium moves faster than light in it, light of two speeds moves
    /// along some directions, and along others none: this is the faster one.  Eq. (P35), (P37)
    ///
    /// A step (T, **n**) of light, T the time for each unit of length, has in the frame of the
    /// medium the time T' = γT − **u**·**n** and the length T'/N. As its interval is the same in
    /// all frames, T² − 1 = (1 − 1/N²) T'².
    ///
    /// ```
    /// use glam::DVec3;
    /// use ugphysics::{Medium, Velocity};
    ///
    /// let water = Medium { index: 1.33, velocity: Velocity::from_beta(DVec3::X * 0.5)? };
    /// let wave = water.wave_along(DVec3::X).ok_or("no light")?;
    /// let step = water.step(wave);
    /// assert!((step.x.x / step.t - 0.909_836_065_6).abs() < 1e-10);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn wave_along(&self, direction: DVec3) -> Option<WaveVector> {
        let (gamma, u) = (self.velocity.gamma(), self.velocity.proper());
        let (square, contrast) = (self.index * self.index, self.contrast());
        let kappa = contrast / square;
        let along = u.dot(direction);
        // (1 − κγ²) T² + 2 κγu_n T = 1 + κu_n²
        let (half, rest) = (kappa * gamma * along, 1.0 + kappa * along * along);
        let root = (rest - kappa * gamma * gamma).sqrt();
        let time = if half >= 0.0 {
            rest / (half + root)
        } else {
            (root - half) / (1.0 - kappa * gamma * gamma)
        };
        let own_time = gamma * time - along;
        // K = N² X − (N² − 1) T' U, up to a factor.
        let drag = contrast * own_time;
        let (frequency, k) = (square * time - drag * gamma, square * direction - drag * u);
        let is_possible = own_time > 0.0 && time > 0.0 && frequency > 0.0 && time.is_finite();
        is_possible.then(|| WaveVector { frequency: 1.0, k: k / frequency })
    }

    /// The light of a given frequency and tangential wave vector that moves in the medium beside a
    /// surface at rest: refracted light in the medium behind it, or reflected light in the medium
    /// before it. `None` if there is none, as at total reflection.  Eq. (P37)
    ///
    /// `wave`: the light before the surface. `normal`: unit vector, on the side to which the
    /// resulting light moves. The medium may move relative to the surface.
    ///
    /// ```
    /// use glam::DVec3;
    /// use ugphysics::{Medium, Velocity, WaveVector};
    ///
    /// // Snell's law: light enters glass of index 1.6.
    /// let glass = Medium { index: 1.6, velocity: Velocity::ZERO };
    /// let wave = WaveVector { frequency: 1.0, k: DVec3::new(0.6, 0.8, 0.0) };
    /// let inside = glass.wave_across(wave, DVec3::X).ok_or("no light")?;
    /// assert!((inside.k.normalize().y - 0.5).abs() < 1e-15);
    /// # Ok::<(), &str>(())
    /// ```
    pub fn wave_across(&self, wave: WaveVector, normal: DVec3) -> Option<WaveVector> {
        let tangential = wave.k - wave.k.dot(normal) * normal;
        let (contrast, u) = (self.contrast(), self.velocity.proper());
        let u_n = u.dot(normal);
        // With q the normal component of k, −K·U = a − u_n q, and K·K = (N² − 1)(K·U)² is a
        // quadratic equation for q. The normal component of the step is ± the root of its
        // discriminant.
        let a = self.velocity.gamma() * wave.frequency - u.dot(tangential);
        let (b, c) = (contrast * a * u_n, 1.0 - contrast * u_n * u_n);
        let rest = wave.frequency * wave.frequency + contrast * a * a - tangential.length_squared();
        let discriminant = b * b + c * rest;
        if discriminant.is_nan() || discriminant < 0.0 {
            return None;
        }
        let q = (discriminant.sqrt() - b) / c;
        let out = WaveVector { frequency: wave.frequency, k: tangential + q * normal };
        // In a medium that passes the surface faster than light in it, light of this frequency may
        // move the other way.
        let is_possible = q.is_finite() && self.own_frequency(out) > 0.0;
        is_possible.then_some(out)
    }
}

impl WaveVector {
    /// Light in vacuum that moves along `direction`, a unit vector.
    pub fn in_vacuum(frequency: f64, direction: DVec3) -> WaveVector {
        WaveVector { frequency, k: frequency * direction }
    }

    /// The same light in the frame that moves with `v`, axes parallel.  Eq. (P7)
    pub fn in_frame(self, v: Velocity) -> WaveVector {
        let (axis, along) = (v.direction(), self.k.dot(v.direction()));
        let k = self.k + (v.gamma_minus_one() * along - v.proper_speed() * self.frequency) * axis;
        WaveVector { frequency: v.gamma() * self.frequency - v.proper_speed() * along, k }
    }
}
