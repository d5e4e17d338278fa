//! Rest positions and seen positions.

use glam::DVec3;
use ugphysics::{Event, InertialFrame, Lorentz, Velocity, WorldLine};
use ugscene::{
    GeometryStage, RestFrames, RestPosition, SeenGeometry, SeenPosition, ShownEffects,
    rest_positions,
};

use super::parse;

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
        let found =
            geometry.seen_normal(RestPosition(normal), SeenPosition(seen(rest)), v).normalize();
        // The errors of central differences are about h² = 1e-10.
        assert!(
            found.dot(along(one)).abs() < 1e-8 && found.dot(along(other)).abs() < 1e-8,
            "{geometry:?}"
        );
        assert!(found.dot(along(normal)) > 0.0, "{geometry:?}: on the other side");
    }
}

const ALL: [ShownEffects; 4] = [
    ShownEffects { contraction: true, flight_time: true },
    ShownEffects { contraction: true, flight_time: false },
    ShownEffects { contraction: false, flight_time: true },
    ShownEffects { contraction: false, flight_time: false },
];

#[test]
fn rest_inverts_seen() {
    for geometry in ALL {
        for beta in [DVec3::ZERO, DVec3::new(0.3, -0.4, 0.5), DVec3::new(0.0, 0.0, -0.99)] {
            let v = Velocity::from_beta(beta).unwrap();
            for p in [DVec3::new(3.0, 4.0, -1.0), DVec3::new(-2.0, 0.1, 7.0), DVec3::ZERO] {
                let RestPosition(back) = geometry.rest(geometry.seen(RestPosition(p), v), v);
                // γ² = 50 costs two digits of sixteen.
                assert!(
                    (back - p).length() <= 1e-13 * p.length(),
                    "{geometry:?} {beta} {p}: {back}"
                );
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
    let mut scene = parse(text);
    let rest: Vec<DVec3> = scene.vertices.iter().map(|vertex| vertex.position).collect();
    let camera = Velocity::from_beta(DVec3::new(0.6, -0.3, 0.5)).unwrap();
    let betas = [DVec3::ZERO, DVec3::new(0.0, 0.7, -0.2)];
    for (face, beta) in betas.into_iter().enumerate() {
        let to_camera =
            Lorentz::boost(Velocity::from_beta(beta).unwrap()).then(Lorentz::boost(-camera));
        let beta = to_camera.velocity_of_frame().unwrap().beta();
        let motion = WorldLine::inertial(InertialFrame::new(Velocity::from_beta(beta).unwrap()));
        scene.faces[face].body = scene.bodies.push(None, motion);
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
        is_whole: false,
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
