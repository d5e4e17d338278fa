//! Questions about frequencies, brightness, lamps and mirrors.

use std::f64::consts::PI;

use glam::DVec3;
use ugphysics::{Brightness, Medium, Velocity, WaveVector, doppler_at, doppler_factor, rest_position};

use super::numbers::{Answer, along_x, angle, at, exactly, list, vectors, velocity};
use super::positions::retarded;

const SPEED_OF_LIGHT_KM_S: f64 = 299_792.458;

pub const KINDS: &[(&str, Answer)] = &[
    ("doppler", |given| {
        let [n, u] = vectors(given)?;
        Some(vec![doppler_factor(n, velocity(u)?)])
    }),
    ("doppler_in_body", |given| {
        let [n, u] = vectors(given)?;
        let sent = WaveVector::in_vacuum(1.0, n.normalize_or_zero());
        Some(vec![sent.in_frame(-velocity(u)?).frequency])
    }),
    ("doppler_now", |given| {
        let [p, u] = vectors(given)?;
        let v = velocity(u)?;
        Some(vec![doppler_at(retarded(p, v).1, v)])
    }),
    ("doppler_rapidity", |given| {
        let [rapidity, theta] = exactly(given)?;
        let v = Velocity::from_rapidity(DVec3::X, rapidity).ok()?;
        Some(vec![doppler_factor(at(theta), v)])
    }),
    ("doppler_of_frames", |given| {
        let [n, u, v] = vectors(given)?;
        let received = WaveVector::in_vacuum(1.0, n.normalize_or_zero());
        let sent = received.in_frame(velocity(v)?).in_frame(velocity(u)?);
        Some(vec![1.0 / sent.frequency])
    }),
    ("doppler_shift", |given| Some(vec![doppler(given)? - 1.0])),
    ("clock_rate", |given| Some(vec![doppler(given)?])),
    ("no_shift_angle", |given| {
        let [speed] = exactly(given)?;
        let v = along_x(speed)?;
        let ahead = doppler_factor(DVec3::X, v);
        // If D = 1, tan²(θ/2) = 1/D(0) in one frame, and the angle in the other frame is the
        // supplement.
        Some(vec![2.0 * libm::atan((1.0 / ahead).sqrt()).to_degrees()])
    }),
    ("radiance_photons", |given| Some(vec![Brightness::Photon.factor(doppler(given)?)])),
    ("radiance", |given| Some(vec![Brightness::Bolometric.factor(doppler(given)?)])),
    // Per unit of frequency: a unit at the eye is 1/D units at the source, so there is one factor D
    // less.
    ("radiance_per_frequency", |given| {
        let d = doppler(given)?;
        Some(vec![Brightness::Bolometric.factor(d) / d])
    }),
    ("radiance_per_wavelength", |given| {
        let d = doppler(given)?;
        Some(vec![Brightness::Bolometric.factor(d) * d])
    }),
    ("photons_per_wavelength", |given| {
        let d = doppler(given)?;
        Some(vec![Brightness::Photon.factor(d) * d])
    }),
    ("photons_per_frequency", |given| {
        let d = doppler(given)?;
        Some(vec![Brightness::Photon.factor(d) / d])
    }),
    ("sky_mean", |given| {
        let [speed, power] = exactly(given)?;
        Some(vec![sky_mean(along_x(speed)?, power)])
    }),
    ("dipole", |given| {
        let [kelvin, km_per_s] = exactly(given)?;
        let v = along_x(km_per_s / SPEED_OF_LIGHT_KM_S)?;
        // Radiation from ahead has the factor of an approaching source.
        let [ahead, behind] = [DVec3::X, DVec3::NEG_X].map(|n| doppler_factor(n, v));
        Some(vec![0.5 * kelvin * (ahead - behind)])
    }),
    ("irradiance", |given| {
        let [power, distance, speed, theta] = exactly(given)?;
        Some(vec![irradiance(power, distance, doppler(&[speed, theta])?)])
    }),
    ("irradiance_per_wavelength", |given| {
        let [power, distance, speed, theta] = exactly(given)?;
        let d = doppler(&[speed, theta])?;
        Some(vec![irradiance(power, distance, d) * d])
    }),
    ("irradiance_by_light_distance", |given| {
        let [power, light_distance, speed, theta] = exactly(given)?;
        let v = along_x(speed)?;
        // Converts to the receiver's frame: the lamp is seen in the direction −n.
        let seen = -at(theta);
        let distance = light_distance / rest_position(seen, v).length();
        Some(vec![irradiance(power, distance, doppler_at(seen, v))])
    }),
    ("mirror_angle", |given| {
        let [in_deg, speed] = exactly(given)?;
        let d = at(in_deg);
        let light = WaveVector::in_vacuum(1.0, DVec3::new(-d.x, d.y, 0.0));
        let back = reflected(light, DVec3::X, along_x(speed)?)?;
        Some(vec![angle(back.k, DVec3::X), back.frequency])
    }),
    ("mirror", |given| {
        let [n, u, normal] = vectors(given)?;
        let light = WaveVector::in_vacuum(1.0, n.normalize_or_zero());
        let back = reflected(light, normal.normalize_or_zero(), velocity(u)?)?;
        Some(list(back.k / back.frequency, &[back.frequency]))
    }),
];

/// The light behind a surface at rest, in a medium at rest of this refractive index.  Eq. (P37)
pub fn behind(index: f64, light: WaveVector, normal: DVec3) -> Option<WaveVector> {
    let medium = Medium { index, velocity: Velocity::ZERO };
    medium.wave_beside(light, normal * light.k.dot(normal).signum())
}

/// The light reflected by a mirror that moves with `v`.  Eq. (P23)
fn reflected(light: WaveVector, rest_normal: DVec3, v: Velocity) -> Option<WaveVector> {
    let there = light.in_frame(v);
    let normal = rest_normal * -there.k.dot(rest_normal).signum();
    Some(Medium::VACUUM.wave_beside(there, normal)?.in_frame(-v))
}

/// Irradiance by a lamp of power `power`, seen at `distance` with the Doppler factor D.  Eq. (P33)
fn irradiance(power: f64, distance: f64, doppler: f64) -> f64 {
    let lamp_distance = distance / doppler;
    power * (doppler * doppler) / (4.0 * PI * lamp_distance * lamp_distance)
}

/// D of a source that moves along +x and whose light propagates at `theta` from the motion.
fn doppler(given: &[f64]) -> Option<f64> {
    let [speed, theta] = exactly(given)?;
    Some(doppler_factor(at(theta), along_x(speed)?))
}

/// The mean of a power of D over all directions, by Simpson's rule over cos θ.
fn sky_mean(v: Velocity, power: f64) -> f64 {
    /// At 0.99 c a step of 1e-5 is 1/1000 of the scale on which D changes; the error is of fourth
    /// order in this ratio.
    const STEPS: u32 = 200_000;
    let at = |step: u32| {
        let cos = 2.0 * f64::from(step) / f64::from(STEPS) - 1.0;
        let n = DVec3::new(cos, ((1.0 - cos) * (1.0 + cos)).sqrt(), 0.0);
        libm::pow(doppler_factor(n, v), power)
    };
    let interior: f64 =
        (1..STEPS).map(|step| if step % 2 == 1 { 4.0 * at(step) } else { 2.0 * at(step) }).sum();
    (at(0) + interior + at(STEPS)) / (3.0 * f64::from(STEPS))
}
