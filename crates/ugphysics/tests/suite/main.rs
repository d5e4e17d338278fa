//! Laws, published numbers and a 200-bit reference for the physics crate.
//!
//! Numbers named T01, T02… are the facts of `docs/physics/facts.csv`.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, its helpers too")]

mod big;
mod colour;
mod illumination;
mod laws;
mod measured_colours;
mod media;
mod numbers;
mod rays_on_world_lines;
mod reference;
mod sampled_paths;
mod spectra_in_motion;
mod spectral_standards;
mod surfaces;
mod velocity;
mod world_lines;

use glam::DVec3;
use ugphysics::Velocity;

/// Fails unless `got` is within `tolerance` of `want`, relative to it when it is above 1.
#[track_caller]
fn near(what: &str, got: f64, want: f64, tolerance: f64) {
    let error = (got - want).abs() / want.abs().max(1.0);
    assert!(
        error <= tolerance,
        "{what}: got {got:?}, want {want:?}, off by {error:e} > {tolerance:e}"
    );
}

/// Fails unless `got` is within `tolerance` of `want`, relative to the length of `want`.
#[track_caller]
fn near_vector(what: &str, got: DVec3, want: DVec3, tolerance: f64) {
    let error = (got - want).length() / want.length();
    assert!(
        error <= tolerance,
        "{what}: got {got:?}, want {want:?}, off by {error:e} > {tolerance:e}"
    );
}

fn beta(x: f64, y: f64, z: f64) -> Velocity {
    Velocity::from_beta(DVec3::new(x, y, z)).expect("tests move below the speed of light")
}

/// Motion along +x.
fn along_x(speed: f64) -> Velocity {
    beta(speed, 0.0, 0.0)
}

/// The unit vector at `angle_deg` from +x, towards +y.
fn at_angle(angle_deg: f64) -> DVec3 {
    let (sin, cos) = libm::sincos(angle_deg.to_radians());
    DVec3::new(cos, sin, 0.0)
}

/// The angle in degrees between two vectors, accurate at every angle.
fn angle_deg(a: DVec3, b: DVec3) -> f64 {
    libm::atan2(a.cross(b).length(), a.dot(b)).to_degrees()
}

/// A fixed, well distributed set of unit vectors: the axes, the diagonals, and a spiral over the
/// sphere.
fn directions() -> Vec<DVec3> {
    let mut all = vec![DVec3::X, DVec3::Y, DVec3::Z, DVec3::NEG_X, DVec3::NEG_Y, DVec3::NEG_Z];
    for signs in 0..8 {
        let sign = |bit: i32| if signs & bit == 0 { 1.0 } else { -1.0 };
        all.push(DVec3::new(sign(1), sign(2), sign(4)).normalize());
    }
    let golden_angle = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    for i in 0..50 {
        let z = 1.0 - (f64::from(i) + 0.5) / 25.0;
        let ring = (1.0 - z * z).sqrt();
        let (sin, cos) = libm::sincos(golden_angle * f64::from(i));
        all.push(DVec3::new(ring * cos, ring * sin, z));
    }
    all
}
