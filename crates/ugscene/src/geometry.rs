//! Transformation between rest positions and seen positions, also with effects omitted.

use glam::DVec3;
use rayon::prelude::*;
use ugparse::Scene;
use ugphysics::{Velocity, contracted, elongated, flight_time, rest_position, seen_position};

use crate::{RestFrames, RestPosition, SeenPosition, vertex_bodies};

/// Which of the two effects are included in the seen positions of a scene: both, unless its stage
/// says otherwise.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Geometry {
    /// Lorentz contraction, (P1).
    pub contraction: bool,
    /// Time of flight, (P2).
    pub flight_time: bool,
}

impl Default for Geometry {
    fn default() -> Self {
        Self { contraction: true, flight_time: true }
    }
}

impl Geometry {
    /// What the stage of a scene says.
    pub fn of(scene: &Scene) -> Self {
        match scene.stage.seen_geometry() {
            Some(seen) => Self { contraction: seen.contraction, flight_time: seen.flight_time },
            None => Self::default(),
        }
    }

    /// The seen position of a point of a body: (P3), or (P1) or (P2) alone.
    pub fn seen(self, RestPosition(rest): RestPosition, v: Velocity) -> SeenPosition {
        SeenPosition(match (self.contraction, self.flight_time) {
            (true, true) => seen_position(rest, v),
            (true, false) => contracted(rest, v),
            (false, true) => rest + flight_time(rest, v) * v.beta(),
            (false, false) => rest,
        })
    }

    /// The inverse of [`Geometry::seen`]; (P4) with both effects.
    pub fn rest(self, SeenPosition(seen): SeenPosition, v: Velocity) -> RestPosition {
        RestPosition(match (self.contraction, self.flight_time) {
            (true, true) => rest_position(seen, v),
            (true, false) => elongated(seen, v),
            // The light left at time −|seen|; since then the body has moved with v.
            (false, true) => seen + seen.length() * v.beta(),
            (false, false) => seen,
        })
    }
}

impl Geometry {
    /// A normal of the seen surface from that of the surface at rest, with the same axes. Any
    /// length; it stays on the same side.
    ///
    /// Planes through a point transform by the gradient of the rest position with respect to the
    /// seen one, the transpose of the Jacobian of (P4): with p' = p + (γ − 1)(p·b) b + γ |p| β and
    /// b along β, n = n' + (γ − 1)(n'·b) b + γ (n'·β) p/|p|. At the eye, where it does not exist,
    /// without the last term.
    pub fn seen_normal(
        self,
        RestPosition(rest): RestPosition,
        SeenPosition(seen): SeenPosition,
        v: Velocity,
    ) -> DVec3 {
        if v.is_zero() {
            return rest;
        }
        let mut normal = rest;
        if self.contraction {
            normal += v.gamma_minus_one() * rest.dot(v.direction()) * v.direction();
        }
        if self.flight_time {
            let gamma = if self.contraction { v.gamma() } else { 1.0 };
            normal += gamma * rest.dot(v.beta()) * seen.normalize_or_zero();
        }
        normal
    }
}

/// The rest position of every vertex of a scene as seen: relative to the eye, in the rest frame of its
/// body, with the axes of the scene. (P4), (P25)
pub fn rest_positions(scene: &Scene, eye: DVec3, frames: &RestFrames) -> Vec<DVec3> {
    if frames.are_at_rest() {
        return scene.vertices.par_iter().map(|vertex| vertex.position - eye).collect();
    }
    let geometry = Geometry::of(scene);
    let bodies = vertex_bodies(scene);
    (scene.vertices.par_iter().zip(bodies.par_iter()))
        .map(|(vertex, &body)| {
            let seen = SeenPosition(vertex.position - eye);
            frames.scene_from_axes(body) * geometry.rest(seen, frames.velocity(body)).0
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use ugparse::{Body, GeometryStage, SeenGeometry};
    use ugphysics::{Event, Lorentz};

    use super::*;

    /// Against the plane through two tangents, found by moving the rest position.
    #[test]
    fn seen_normals_are_at_right_angles_to_seen_tangents() {
        let v = Velocity::from_beta(DVec3::new(0.6, -0.5, 0.2)).unwrap();
        let rest = DVec3::new(-0.7, 2.0, 0.4);
        let normal = DVec3::new(0.3, -0.8, 0.5).normalize();
        let [one, other] = normal.any_orthonormal_pair().into();
        for geometry in ALL {
            let seen = |p: DVec3| geometry.seen(RestPosition(p), v).0;
            let h = 1e-5;
            let along = |d: DVec3| (seen(rest + h * d) - seen(rest - h * d)) / (2.0 * h);
            let found = geometry.seen_normal(RestPosition(normal), SeenPosition(seen(rest)), v).normalize();
            // The errors of central differences are about h² = 1e-10.
            assert!(
                found.dot(along(one)).abs() < 1e-8 && found.dot(along(other)).abs() < 1e-8,
                "{geometry:?}"
            );
            assert!(found.dot(along(normal)) > 0.0, "{geometry:?}: on the other side");
        }
    }

    const ALL: [Geometry; 4] = [
        Geometry { contraction: true, flight_time: true },
        Geometry { contraction: true, flight_time: false },
        Geometry { contraction: false, flight_time: true },
        Geometry { contraction: false, flight_time: false },
    ];

    #[test]
    fn rest_inverts_seen() {
        for geometry in ALL {
            for beta in [DVec3::ZERO, DVec3::new(0.3, -0.4, 0.5), DVec3::new(0.0, 0.0, -0.99)] {
                let v = Velocity::from_beta(beta).unwrap();
                for p in [DVec3::new(3.0, 4.0, -1.0), DVec3::new(-2.0, 0.1, 7.0), DVec3::ZERO] {
                    let RestPosition(back) = geometry.rest(geometry.seen(RestPosition(p), v), v);
                    // γ² = 50 costs two digits of sixteen.
                    assert!((back - p).length() <= 1e-13 * p.length(), "{geometry:?} {beta} {p}: {back}");
                }
            }
        }
    }

    /// A body at rest in the scene, a moving body and a moving camera. The seen positions are
    /// computed with 4×4 matrices.
    #[test]
    fn rest_positions_are_in_the_axes_of_the_scene() {
        let text = "v a 1 2 3; v b -4 1 2; v c 2 2 -5; v d 1 9 2; v e -3 1 1; v f 0 2 7;
            f (a b c); f (d e f) <0 0.7 -0.2>;";
        let source = ugparse::Source::new("t.ug", text);
        let mut scene = ugparse::parse(&source, &ugparse::Options::default()).unwrap().scene;
        let rest: Vec<DVec3> = scene.vertices.iter().map(|vertex| vertex.position).collect();
        let camera = Velocity::from_beta(DVec3::new(0.6, -0.3, 0.5)).unwrap();
        let betas = [DVec3::ZERO, DVec3::new(0.0, 0.7, -0.2)];
        for (face, beta) in betas.into_iter().enumerate() {
            let to_camera = Lorentz::boost(Velocity::from_beta(beta).unwrap()).then(Lorentz::boost(-camera));
            let beta = to_camera.velocity_of_frame().unwrap().beta();
            let body = Body::inertial(Velocity::from_beta(beta).unwrap());
            scene.faces[face].body = scene.bodies.push(body);
            for vertex in &mut scene.vertices[3 * face..3 * face + 3] {
                let leaves = Event { t: -vertex.position.length(), x: vertex.position };
                vertex.position = to_camera.apply(leaves).x;
            }
        }
        scene.stage.geometry = GeometryStage::AsSeen(SeenGeometry {
            eye: DVec3::ZERO,
            time: 0.0,
            camera_velocity: camera,
            contraction: true,
            flight_time: true,
        });
        let frames = RestFrames::new(&scene);
        for (found, rest) in rest_positions(&scene, DVec3::ZERO, &frames).into_iter().zip(rest) {
            assert!((found - rest).length() < 1e-14 * 20.0, "{found} {rest}");
        }
    }

    #[test]
    fn both_effects_are_p1_and_then_p2() {
        let v = Velocity::from_beta(DVec3::new(0.5, 0.0, 0.0)).unwrap();
        let p_rest = DVec3::new(3.0, 4.0, 0.0);
        let SeenPosition(p0) = ALL[1].seen(RestPosition(p_rest), v);
        let SeenPosition(both) = ALL[2].seen(RestPosition(p0), v);
        assert!((both - ALL[0].seen(RestPosition(p_rest), v).0).length() < 1e-14);
    }
}
