//! Converts the numbers of questions to vectors and velocities.

use glam::DVec3;
use ugphysics::Velocity;

/// A function from the numbers of a question to those of the answer.
pub type Answer = fn(&[f64]) -> Option<Vec<f64>>;

/// The numbers as an array of N; `None` if the count differs.
pub fn exactly<const N: usize>(given: &[f64]) -> Option<[f64; N]> {
    given.try_into().ok()
}

/// The numbers as N vectors; `None` if the count differs.
pub fn vectors<const N: usize>(given: &[f64]) -> Option<[DVec3; N]> {
    if given.len() != 3 * N {
        return None;
    }
    Some(std::array::from_fn(|i| DVec3::from_slice(&given[3 * i..])))
}

/// The velocity `beta` along +x.
pub fn along_x(beta: f64) -> Option<Velocity> {
    velocity(beta * DVec3::X)
}

pub fn velocity(beta: DVec3) -> Option<Velocity> {
    Velocity::from_beta(beta).ok()
}

/// The unit vector at `angle_deg` from +x, towards +y.
pub fn at(angle_deg: f64) -> DVec3 {
    // Exact at the right angle, where the cosine must be 0.
    if angle_deg == 90.0 {
        return DVec3::Y;
    }
    let (sin, cos) = libm::sincos(angle_deg.to_radians());
    DVec3::new(cos, sin, 0.0)
}

/// The angle between two vectors in degrees, precise for small angles, too.
pub fn angle(a: DVec3, b: DVec3) -> f64 {
    libm::atan2(a.cross(b).length(), a.dot(b)).to_degrees()
}

/// The components of a vector, followed by more numbers.
pub fn list(vector: DVec3, more: &[f64]) -> Vec<f64> {
    [&vector.to_array()[..], more].concat()
}
