//! Questions about changes of frame: factors, directions, velocities, accelerated motion.

use glam::{DMat3, DVec3, Vec4Swizzles};
use ugphysics::{Event, HyperbolicMotion, Lorentz, WaveVector, aberrate, compose};

use super::numbers::{Answer, along_x, angle, at, exactly, list, vectors, velocity};
use super::positions::retarded;

const SPEED_OF_LIGHT_KM_S: f64 = 299_792.458;
const METRES_PER_KPC: f64 = 3.085_677_581_491_367e19;
const METRES_PER_SECOND: f64 = 299_792_458.0;
const SECONDS_PER_DAY: f64 = 86_400.0;

pub const KINDS: &[(&str, Answer)] = &[
    ("gamma", |given| {
        let [speed] = exactly(given)?;
        Some(vec![along_x(speed)?.gamma()])
    }),
    ("aberration", |given| {
        let [speed, theta] = exactly(given)?;
        Some(vec![aberration(speed, theta)?])
    }),
    ("aberration_shift", |given| {
        let [speed, theta] = exactly(given)?;
        Some(vec![theta - aberration(speed, theta)?])
    }),
    ("aberration_constant", |given| {
        let [km_per_s] = exactly(given)?;
        Some(vec![3600.0 * (90.0 - aberration(km_per_s / SPEED_OF_LIGHT_KM_S, 90.0)?)])
    }),
    ("aberrate", |given| {
        let [d, u] = vectors(given)?;
        Some(list(aberrate(d, velocity(u)?), &[]))
    }),
    ("aberration_arcsec", |given| {
        let [d, u] = vectors(given)?;
        Some(vec![3600.0 * angle(d, aberrate(d, velocity(u)?))])
    }),
    ("headlight", |given| {
        let [speed] = exactly(given)?;
        let sideways = WaveVector::in_vacuum(1.0, DVec3::Y);
        Some(vec![angle(sideways.in_frame(-along_x(speed)?).k, DVec3::X)])
    }),
    ("field_of_view", |given| {
        let [speed] = exactly(given)?;
        let [forward, backward] = covers(speed, 180.0)?;
        let edge = aberrate(DVec3::Y, along_x(speed)?);
        Some(vec![forward, backward, edge.y / edge.x])
    }),
    ("camera_covers", |given| {
        let [speed, angle] = exactly(given)?;
        covers(speed, angle).map(Vec::from)
    }),
    ("stereographic_factor", |given| {
        let [speed] = exactly(given)?;
        let half_tan = |d: DVec3| d.y / (1.0 + d.x);
        Some(vec![half_tan(aberrate(DVec3::Y, along_x(speed)?))])
    }),
    ("solid_angle_ratio", |given| {
        let [speed, theta] = exactly(given)?;
        let light = WaveVector::in_vacuum(1.0, -at(theta));
        let doppler = light.in_frame(along_x(speed)?).frequency;
        Some(vec![1.0 / (doppler * doppler)])
    }),
    ("boost", |given| {
        let [t, x, y, z, ux, uy, uz] = exactly(given)?;
        let v = velocity(DVec3::new(ux, uy, uz))?;
        let event = Lorentz::boost(v).apply(Event { t, x: DVec3::new(x, y, z) });
        Some([&[event.t], &event.x.to_array()[..]].concat())
    }),
    ("compose", |given| {
        let [u, v] = vectors(given)?;
        Some(list(compose(velocity(u)?, velocity(v)?).beta(), &[]))
    }),
    ("wigner", |given| {
        let [u, v] = vectors(given)?;
        let both = Lorentz::boost(velocity(u)?) * Lorentz::boost(velocity(v)?);
        let rotation = Lorentz::boost(both.velocity_of_frame().ok()?).inverse() * both;
        Some(vec![rotation_angle(rotation)])
    }),
    ("camera_sees", |given| {
        let (&t, rest) = given.split_first()?;
        let [x, u, w] = vectors(rest)?;
        let (source, camera) = (velocity(u)?, velocity(w)?);
        let (t_sent, sent) = retarded(x - t * u, source);
        let in_camera = Lorentz::boost(camera).inverse().apply(Event { t: t_sent, x: sent });
        let light = WaveVector::in_vacuum(1.0, -sent.normalize());
        let doppler = light.in_frame(camera).frequency / light.in_frame(source).frequency;
        Some(vec![in_camera.x.length(), doppler])
    }),
    ("hyperbolic", |given| {
        let [a, proper_time] = exactly(given)?;
        let ship = HyperbolicMotion { acceleration: a * DVec3::X };
        let (event, v) = (ship.event(proper_time), ship.velocity(proper_time).ok()?);
        Some(vec![v.speed(), v.gamma(), event.t, event.x.x])
    }),
    ("flip_trip", |given| {
        let [a, distance] = exactly(given)?;
        let ship = HyperbolicMotion { acceleration: a * DVec3::X };
        // a τ = acosh(1 + a x) = 2 asinh √(a x/2)  (P32)
        let half = 2.0 * libm::asinh((0.25 * a * distance).sqrt()) / a;
        Some(vec![ship.velocity(half).ok()?.speed(), 2.0 * ship.event(half).t, 2.0 * half])
    }),
    ("jet_beta_cos", |given| {
        let [near, far] = exactly(given)?;
        Some(vec![(near - far) / (near + far)])
    }),
    ("jet", |given| {
        let [near, far, kpc] = exactly(given)?;
        // The ratio of the apparent speeds of both sides, β sin θ/(1 ∓ β cos θ) (P31), gives β cos
        // θ, and β sin θ is the first times 1 − β cos θ.
        let along = (near - far) / (near + far);
        let radians_per_s = (near / 3_600_000.0_f64).to_radians() / SECONDS_PER_DAY;
        let across = radians_per_s * kpc * METRES_PER_KPC / METRES_PER_SECOND * (1.0 - along);
        Some(vec![DVec3::new(along, across, 0.0).length(), libm::atan2(across, along).to_degrees()])
    }),
];

/// The angle from the motion, in degrees, at which a moving eye sees what an eye at rest sees at
/// `theta`.
fn aberration(speed: f64, theta: f64) -> Option<f64> {
    Some(angle(aberrate(at(theta), along_x(speed)?), DVec3::X))
}

/// The angles of the scene that a camera of this view angle covers looking forward and looking
/// backward.
fn covers(speed: f64, view_angle: f64) -> Option<[f64; 2]> {
    // The transformation from the camera to the scene is the inverse one.
    Some([2.0 * aberration(-speed, 0.5 * view_angle)?, 2.0 * aberration(speed, 0.5 * view_angle)?])
}

/// The angle of a rotation in degrees.
fn rotation_angle(rotation: Lorentz) -> f64 {
    let matrix = rotation.matrix();
    let m = DMat3::from_cols(matrix.y_axis.yzw(), matrix.z_axis.yzw(), matrix.w_axis.yzw());
    let axis = DVec3::new(m.y_axis.z - m.z_axis.y, m.z_axis.x - m.x_axis.z, m.x_axis.y - m.y_axis.x);
    let trace = m.x_axis.x + m.y_axis.y + m.z_axis.z;
    libm::atan2(axis.length(), trace - 1.0).to_degrees()
}
