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
    #[must_use]
    pub fn step(&self, wave: WaveVector) -> Event {
        let drag = self.contrast() * self.own_frequency(wave);
        if drag == 0.0 {
            return Event { t: wave.frequency, x: wave.k };
        }
        Event { t: wave.frequency + drag * self.velocity.gamma(), x: wave.k + drag * self.velocity.proper() }
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
    #[must_use]
    pub fn wave_along(&self, direction: DVec3) -> Option<WaveVector> {
        let (gamma, u) = (self.velocity.gamma(), self.velocity.proper());
        let (square, contrast) = (self.index * self.index, self.contrast());
        let kappa = contrast / square;
        let along = u.dot(direction);
        // (1 − κγ²) T² + 2 κγu_n T = 1 + κu_n²
        let (half, rest) = (kappa * gamma * along, 1.0 + kappa * along * along);
        let root = (rest - kappa * gamma * gamma).sqrt();
        let time =
            if half >= 0.0 { rest / (half + root) } else { (root - half) / (1.0 - kappa * gamma * gamma) };
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
    /// let inside = glass.wave_beside(wave, DVec3::X).ok_or("no light")?;
    /// assert!((inside.k.normalize().y - 0.5).abs() < 1e-15);
    /// # Ok::<(), &str>(())
    /// ```
    #[must_use]
    pub fn wave_beside(&self, wave: WaveVector, normal: DVec3) -> Option<WaveVector> {
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
    #[must_use]
    pub fn in_vacuum(frequency: f64, direction: DVec3) -> WaveVector {
        WaveVector { frequency, k: frequency * direction }
    }

    /// The same light in the frame that moves with `v`, axes parallel.  Eq. (P7)
    #[must_use]
    pub fn in_frame(self, v: Velocity) -> WaveVector {
        let (axis, along) = (v.direction(), self.k.dot(v.direction()));
        let k = self.k + (v.gamma_minus_one() * along - v.proper_speed() * self.frequency) * axis;
        WaveVector { frequency: v.gamma() * self.frequency - v.proper_speed() * along, k }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compose;

    fn velocity(x: f64, y: f64, z: f64) -> Velocity {
        Velocity::from_beta(DVec3::new(x, y, z)).unwrap()
    }

    #[test]
    fn steps_have_the_velocity_of_light_in_moving_glass() {
        for v in [velocity(0.0, 0.0, 0.0), velocity(0.9, 0.0, 0.0), velocity(-0.5, 0.3, 0.6)] {
            for direction in [DVec3::X, DVec3::NEG_X, DVec3::new(0.6, 0.0, -0.8)] {
                let wave = WaveVector { frequency: 2.0, k: 3.0 * direction }.in_frame(-v);
                let step = Medium { index: 1.5, velocity: v }.step(wave);
                let expected = compose(Velocity::from_beta(direction / 1.5).unwrap(), v).beta();
                assert!((step.x / step.t - expected).length() < 1e-14, "{v:?} {direction}");
            }
        }
    }

    #[test]
    fn media_at_rest_refract_and_reflect_by_snells_law() {
        for (before, behind) in [(1.0, 1.5), (1.5, 1.0), (1.33, 1.5), (1.0, 1.0)] {
            for degrees in [0.0_f64, 20.0, 41.0, 42.0, 70.0, 89.0] {
                let (sin, cos) = libm::sincos(degrees.to_radians());
                let direction = DVec3::new(cos, sin, 0.0);
                let wave = WaveVector { frequency: 1.0, k: before * direction };
                let medium = |index| Medium { index, velocity: Velocity::ZERO };
                let sin_behind = sin * before / behind;
                let found = medium(behind).wave_beside(wave, DVec3::X).map(|wave| wave.k.normalize());
                assert_eq!(found.is_some(), sin_behind <= 1.0, "{before} {behind} {degrees}");
                if let Some(found) = found {
                    let expected = DVec3::new((1.0 - sin_behind * sin_behind).sqrt(), sin_behind, 0.0);
                    assert!((found - expected).length() < 1e-14);
                }
                let back = medium(before).wave_beside(wave, DVec3::NEG_X).unwrap();
                assert!((back.k - before * DVec3::new(-cos, sin, 0.0)).length() < 1e-14);
            }
        }
    }

    /// Light that enters water which flows along the surface of the glass around it. The answer is
    /// computed in the frame of the water, in which the surface moves: the frequency in the frame
    /// of the surface and the wave vector along it are the same on both sides.
    #[test]
    fn moving_media_keep_frequency_and_tangential_wave_vector() {
        for v in [velocity(0.0, 0.4, 0.0), velocity(0.2, -0.3, 0.1), velocity(-0.6, 0.0, 0.5)] {
            let water = Medium { index: 1.33, velocity: v };
            let glass = WaveVector { frequency: 1.0, k: 1.5 * DVec3::new(0.8, 0.36, 0.48) };
            let inside = water.wave_beside(glass, DVec3::X).unwrap();
            assert_eq!(inside.frequency, 1.0);
            assert!((inside.k - glass.k).reject_from(DVec3::X).length() < 1e-15);
            let own = inside.in_frame(v);
            assert!((own.k.length() - 1.33 * own.frequency).abs() < 1e-13, "{v:?} {own:?}");
            let step = water.step(inside);
            assert!(step.x.x / step.t > 0.0);
            // Its velocity is that of light in the water, composed with the water's.
            let light = Velocity::from_beta(own.k.normalize() / 1.33).unwrap();
            assert!((compose(light, v).beta() - step.x / step.t).length() < 1e-13);
        }
    }

    /// Light that is emitted in a direction of the frame of the medium is found by the direction in
    /// which it moves.
    #[test]
    fn light_is_found_by_its_direction() {
        let velocities = [velocity(0.0, 0.0, 0.0), velocity(0.5, 0.2, 0.1), velocity(-0.3, 0.0, 0.55)];
        for (index, v) in [0.8, 1.0, 1.5].into_iter().flat_map(|index| velocities.map(|v| (index, v))) {
            let medium = Medium { index, velocity: v };
            for direction in [DVec3::X, DVec3::NEG_X, DVec3::new(0.6, 0.0, -0.8), DVec3::NEG_Z] {
                let wave = WaveVector { frequency: 2.0, k: 2.0 * index * direction }.in_frame(-v);
                let found = medium.wave_along(medium.step(wave).x.normalize()).unwrap();
                assert!((found.k - wave.k / wave.frequency).length() < 1e-13, "{medium:?} {direction}");
            }
        }
    }

    /// In glass that moves with 0.9 c no light moves backwards.
    #[test]
    fn fast_media_drag_all_light_along() {
        let glass = Medium { index: 1.5, velocity: velocity(0.9, 0.0, 0.0) };
        assert_eq!(glass.wave_along(DVec3::NEG_X), None);
        let forwards = glass.wave_along(DVec3::X).unwrap();
        let step = glass.step(forwards);
        assert!((step.x.x / step.t - 0.979_166_666_7).abs() < 1e-10);
    }

    #[test]
    fn vacuum_has_no_velocity() {
        let wave = WaveVector { frequency: 1.0, k: DVec3::new(0.6, 0.8, 0.0) };
        let moving = Medium { index: 1.0, velocity: velocity(0.9, 0.1, 0.0) };
        for vacuum in [Medium::VACUUM, moving] {
            assert_eq!(vacuum.step(wave), Event { t: 1.0, x: wave.k });
            let beside = vacuum.wave_beside(wave, DVec3::X).unwrap();
            assert!(beside.frequency == 1.0 && (beside.k - wave.k).length() < 1e-15);
        }
    }
}
