//! Measurements at every vertex of a scene as seen.

use glam::DVec3;
use ugphysics::{Velocity, aberrate, doppler_at};

use crate::{RestFrames, Scene, SeenVertices, ShownEffects, Vertex};

/// Measurements at one vertex.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measurement {
    /// Apparent distance |p| from the eye, in the frame of the camera.
    pub distance: f64,
    /// Emission time on the clock of the camera: the time of the picture minus the distance.
    /// Without time of flight, the time of the picture.
    pub emission_time: f64,
    /// Doppler factor D = f_observed/f_emitted.  Eq. (P10)
    ///
    /// 1 at rest.
    pub doppler: f64,
    /// Angle between the velocity and the direction of the light to the eye, in the frame of the
    /// camera, degrees. NaN at rest and at the eye, where it is undefined.
    pub emission_angle_deg: f64,
    /// The same angle in the rest frame of the body, (P6).
    pub rest_emission_angle_deg: f64,
    /// Velocity of the body in the frame of the camera, fraction of c.
    pub velocity: DVec3,
}

/// Measures a scene as seen, one row for each vertex.
///
/// `eye`: in scene coordinates. `time`: of the picture, on the clock of the camera.
pub fn measure(scene: &Scene, eye: DVec3, time: f64) -> Vec<Measurement> {
    let frames = RestFrames::new(scene);
    let has_flight_time = ShownEffects::of(scene).flight_time;
    let vertices = SeenVertices::new(scene, eye, &frames, false);
    let one = |seen: DVec3, v: Velocity| {
        let distance = seen.length();
        Measurement {
            distance,
            emission_time: if has_flight_time { time - distance } else { time },
            doppler: if v.is_zero() { 1.0 } else { doppler_at(seen, v) },
            emission_angle_deg: angle_to_motion_deg(-seen, v),
            rest_emission_angle_deg: angle_to_motion_deg(-aberrate(seen, v), v),
            velocity: v.beta(),
        }
    };
    let of_vertex = |(row, vertex): (usize, &Vertex)| {
        one(vertex.position - eye, vertices.velocity(row, &frames))
    };
    scene.vertices.iter().enumerate().map(of_vertex).collect()
}

impl Measurement {
    /// The names of [`Measurement::scalars`] in files.
    pub const SCALARS: [&str; 5] =
        ["emission_time", "doppler", "distance", "emission_angle_deg", "rest_emission_angle_deg"];

    /// All numbers but the velocity.
    pub fn scalars(&self) -> [f64; 5] {
        let Self {
            distance,
            emission_time,
            doppler,
            emission_angle_deg,
            rest_emission_angle_deg,
            ..
        } = *self;
        [emission_time, doppler, distance, emission_angle_deg, rest_emission_angle_deg]
    }
}

fn angle_to_motion_deg(direction: DVec3, v: Velocity) -> f64 {
    if v.is_zero() || direction == DVec3::ZERO {
        return f64::NAN;
    }
    // Against overflow and underflow of squares.
    let direction = direction / direction.abs().max_element();
    let (sine, cosine) = (direction.cross(v.direction()).length(), direction.dot(v.direction()));
    libm::atan2(sine, cosine).to_degrees()
}
