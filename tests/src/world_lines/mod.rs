//! Bodies on world lines without a formula for any of them: an oracle that integrates the equations
//! of motion in small steps.
//!
//! - [`statement`]: motions as text, and random ones;
//! - [`curve`]: splines through events;
//! - [`integrated`]: the world line of a body, by the method of Runge and Kutta;
//! - [`sight`]: what is seen of it, by bisection.
//!
//! No function of the programs is used. Events are (t, x, y, z), the metric is (−+++).

pub mod curve;
pub mod integrated;
pub mod sight;
pub mod statement;

pub use integrated::Body;
pub use sight::{Observer, Sighting, Triangle};
pub use statement::{Path, Statement, Stretch};

/// An event or a 4-vector.
pub type Four = [f64; 4];

/// −a⁰b⁰ + a·b
pub fn product(a: Four, b: Four) -> f64 {
    a[1] * b[1] + a[2] * b[2] + a[3] * b[3] - a[0] * b[0]
}

/// a + s b
pub fn plus(a: Four, s: f64, b: Four) -> Four {
    [0, 1, 2, 3].map(|k| a[k] + s * b[k])
}

/// A velocity as a 4-velocity.
pub fn four_velocity(v: glam::DVec3) -> Four {
    let gamma = 1.0 / (1.0 - v.length_squared()).sqrt();
    [gamma, gamma * v.x, gamma * v.y, gamma * v.z]
}

/// The boost with velocity `v` of a vector, (1, 0, 0, 0) to the 4-velocity.
pub fn boosted(v: glam::DVec3, a: Four) -> Four {
    let [gamma, x, y, z] = four_velocity(v);
    let along = a[1] * x + a[2] * y + a[3] * z;
    let part = a[0] + along / (gamma + 1.0);
    [gamma * a[0] + along, a[1] + part * x, a[2] + part * y, a[3] + part * z]
}
