//! Moving lights on moving surfaces, (P14).

use std::f64::consts::PI;

use glam::{DMat3, DVec3, Vec4Swizzles};
use ugphysics::{
    Event, IncidentLight, Lorentz, Velocity, ambient_illumination, compose, doppler_factor,
    illumination, illumination_along, illumination_from_afar, seen_position,
};

use crate::{along_x, beta, directions, near, near_vector};

pub fn light_on(p: DVec3, v: Velocity, light: DVec3, v_light: Velocity) -> IncidentLight {
    illumination(p, 0.0, v, light, v_light).expect("the light is away from the surface")
}

/// Irradiance by a lamp of power 1 (P33).
pub fn irradiance(light: IncidentLight) -> f64 {
    light.doppler * light.doppler / (4.0 * PI * light.rest_distance * light.rest_distance)
}

/// Surface point, its velocity, light, its velocity: across, along and against each other, slow and
/// fast.
fn settings() -> Vec<(DVec3, Velocity, DVec3, Velocity)> {
    let points =
        [DVec3::new(3.0, 4.0, -1.0), DVec3::new(-2.0, 0.1, 7.0), DVec3::new(0.5, 9.0, 0.3)];
    let lights =
        [DVec3::new(0.0, 5.0, 5.0), DVec3::new(-40.0, 2.0, 1.0), DVec3::new(2.0, -3.0, -0.5)];
    let velocities = [
        Velocity::ZERO,
        along_x(0.9),
        beta(-0.3, 0.4, 0.5),
        beta(0.0, 0.0, -0.99),
        beta(1e-6, 0.0, 2e-6),
    ];
    let mut all = Vec::new();
    for (p, light) in points.into_iter().zip(lights) {
        for v in velocities {
            all.extend(velocities.map(|v_light| (p, v, light, v_light)));
        }
    }
    all
}

#[test]
fn distances_differ_by_d() {
    for (p, v, l, v_light) in settings() {
        let light = light_on(p, v, l, v_light);
        near("r'' = r/D", light.rest_distance, light.distance / light.doppler, 1e-14);
    }
}

/// A light that moves with the surface acts like a light at rest.
#[test]
fn light_in_the_same_frame_is_as_at_rest() {
    for (p, v, l, _) in settings() {
        let light = light_on(p, v, l, v);
        assert_eq!((light.doppler, light.distance), (1.0, light.rest_distance));
        near_vector("toward", light.toward, (l - p).normalize(), 1e-15);
        near("r", light.distance, (l - p).length(), 1e-15);
        let afar = illumination_from_afar(v, l, v).expect("a direction");
        assert_eq!(afar.doppler, 1.0);
        near_vector("toward from afar", afar.toward, l.normalize(), 1e-15);
    }
}

/// The emission event, found by bisection along the light's world line in the camera frame, and
/// everything else from 4×4 matrices.
#[test]
fn bisection_finds_the_same_emission_event() {
    for (p, v, l, v_light) in settings() {
        check_by_bisection(p, 0.0, v, l, v_light);
    }
}

/// Light that a mirror or glass brings to the eye leaves the surface at another time than light
/// that reaches the eye directly.
#[test]
fn a_surface_is_lit_at_the_event_at_which_it_scatters() {
    for (p, v, l, v_light) in settings() {
        [-9.0, -0.3, 2.5].into_iter().for_each(|delay| check_by_bisection(p, delay, v, l, v_light));
    }
}

fn check_by_bisection(p: DVec3, delay: f64, v: Velocity, l: DVec3, v_light: Velocity) {
    let scatter = Lorentz::boost(v).apply(Event { t: delay - p.length(), x: p });
    let worldline = |t: f64| Lorentz::boost(v_light).apply(Event { t, x: l });
    let is_past = |event: Event| scatter.t - event.t >= (scatter.x - event.x).length();
    let (mut early, mut late) = (-1e4, 1e4);
    for _ in 0..200 {
        let middle = 0.5 * (early + late);
        if is_past(worldline(middle)) { early = middle } else { late = middle }
    }
    let shone = worldline(early);
    let to_surface = Lorentz::boost(v).inverse();
    let (here, there) = (to_surface.apply(scatter), to_surface.apply(shone));
    let light = illumination(p, delay, v, l, v_light).expect("the light is away from the surface");
    // The bisection finds the time of the event to 1e4 · 2⁻⁵³ · γ, and boosts magnify that by
    // γ².
    near_vector("light", light.toward * light.distance, there.x - here.x, 1e-8);
    // The photon's energy in a frame is −k·u.
    let k = scatter.x - shone.x;
    let energy = |u: Velocity| u.gamma() * k.length() - u.proper().dot(k);
    near("D", light.doppler, energy(v) / energy(v_light), 1e-8);
    // The direction in which the light leaves, between the same events in the frame of the lamp.
    let to_lamp = Lorentz::boost(v_light).inverse();
    let way = to_lamp.apply(scatter).x - to_lamp.apply(shone).x;
    near_vector("leaving", light.leaving, way.normalize(), 1e-8);
}

/// In its own frame a lamp at l shines at p along (p − l)/|p − l|, whatever the frame is in which
/// both rest; one far away along the line from it.
#[test]
fn light_leaves_a_lamp_towards_the_surface() {
    for (p, v, l, _) in settings() {
        let ahead = (p - l).normalize();
        near_vector("leaving", light_on(p, v, l, v).leaving, ahead, 1e-15);
        let afar = illumination_from_afar(v, l, v).expect("a direction");
        near_vector("leaving, from afar", afar.leaving, -l.normalize(), 1e-15);
        let seen = seen_position(l - p, v);
        let along = illumination_along(seen, v, v).expect("a direction");
        near_vector("leaving along a way", along.leaving, ahead, 1e-13 * v.gamma() * v.gamma());
    }
    // A lamp that moves against the surface sends it light in its own frame as the limit does.
    for (p, v, l, v_light) in settings() {
        let far = 1e9 * l;
        let near_by = light_on(p, v, far, v_light).leaving;
        let afar = illumination_from_afar(v, l, v_light).expect("a direction").leaving;
        near_vector("leaving from far away", near_by, afar, 1e-6);
    }
}

/// Computed from another camera frame, the light on a surface is the same: only the axes are
/// rotated.
#[test]
fn any_camera_frame_gives_the_same_light() {
    let camera = beta(0.2, -0.5, 0.6);
    for (p, v, l, v_light) in settings() {
        let (p_turned, v_turned, turn) = from_camera(p, v, camera);
        let (l_turned, v_light_turned, _) = from_camera(l, v_light, camera);
        let (here, there) =
            (light_on(p, v, l, v_light), light_on(p_turned, v_turned, l_turned, v_light_turned));
        near("D", there.doppler, here.doppler, 1e-11);
        near("r", there.distance, here.distance, 1e-11);
        near_vector("toward", there.toward, turn * here.toward, 1e-11);
    }
}

/// A point at rest at `p` in the frame that moves with `v`, described by a camera that moves with
/// `camera` and coincides with the first one at t = 0: its rest position and velocity there, and
/// the rotation of the rest frame's axes.
fn from_camera(p: DVec3, v: Velocity, camera: Velocity) -> (DVec3, Velocity, DMat3) {
    let change = Lorentz::boost(v).then(Lorentz::boost(camera).inverse());
    let turned = compose(v, -camera);
    let turn = change.then(Lorentz::boost(turned).inverse()).matrix();
    let turn = DMat3::from_cols(turn.y_axis.yzw(), turn.z_axis.yzw(), turn.w_axis.yzw());
    (turn * p, turned, turn)
}

/// A directional light is the limit of a distant lamp.
#[test]
fn a_distant_lamp_is_a_directional_light() {
    for (p, v, l, v_light) in settings() {
        let near_by = light_on(p, v, 1e9 * l, v_light);
        let afar = illumination_from_afar(v, l, v_light).expect("a direction");
        // The lamp is at 1e9 and the surface up to γ² · 10 away from the eye in the lamp's frame.
        near("D", near_by.doppler, afar.doppler, 1e-6);
        near_vector("toward", near_by.toward, afar.toward, 1e-6);
    }
}

/// For directional light the surface acts like an eye: (P6) and (P10) with the relative velocity.
#[test]
fn directional_light_obeys_aberration_and_doppler_shift() {
    for direction in directions() {
        for v_light in [along_x(0.6), beta(0.3, -0.8, 0.2), beta(0.0, 0.0, 0.999)] {
            let light =
                illumination_from_afar(Velocity::ZERO, direction, v_light).expect("a direction");
            near("D", light.doppler, doppler_factor(-light.toward, v_light), 1e-12);
            // The reverse transformation, in the frame of the light, where the surface moves.
            let back =
                illumination_from_afar(v_light, light.toward, Velocity::ZERO).expect("a direction");
            near("there and back", light.doppler * back.doppler, 1.0, 1e-12);
            near_vector("the same way", back.toward, direction, 1e-11);
        }
    }
}

/// The irradiance summed over a sphere round the lamp's place at emission: ∫E r² dΩ = P ⟨D⁴⟩ = P
/// γ²(1 + β²/3) (T21).
#[test]
fn power_through_a_sphere() {
    let speed = 0.8;
    let v_light = along_x(speed);
    // The lamp emits at the origin of the surface's frame; surface points lie all round it at
    // distance 1.
    let steps = 4000;
    let sum: f64 = (0..steps)
        .map(|step| {
            let cos = -1.0 + (f64::from(step) + 0.5) * 2.0 / f64::from(steps);
            let n = DVec3::new(cos, (1.0 - cos * cos).sqrt(), 0.0);
            let doppler = doppler_factor(n, v_light);
            let light = IncidentLight {
                toward: -n,
                doppler,
                distance: 1.0,
                rest_distance: 1.0 / doppler,
                leaving: n,
            };
            irradiance(light) * 2.0 * PI * 2.0 / f64::from(steps)
        })
        .sum();
    near("power", sum, (1.0 + speed * speed / 3.0) / (1.0 - speed * speed), 1e-5);
}

#[test]
fn extremes() {
    let fast = |rapidity: f64| {
        Velocity::from_rapidity(DVec3::X, rapidity).expect("a rapidity below the limit")
    };
    // Ahead of a light at rapidity η, D = e^η, however close to 1 its speed is.
    for rapidity in [1e-8, 1.0, 20.0, 90.0] {
        let light = light_on(DVec3::ZERO, Velocity::ZERO, DVec3::NEG_X, fast(rapidity));
        near("D", light.doppler / libm::exp(rapidity), 1.0, 1e-14);
        let behind = light_on(DVec3::ZERO, Velocity::ZERO, DVec3::X, fast(rapidity));
        near("D behind", behind.doppler * libm::exp(rapidity), 1.0, 1e-13);
    }
    // A lamp at the surface point has no direction, nor has a directional light with a zero vector.
    let p = DVec3::new(1.0, 2.0, 3.0);
    assert_eq!(illumination(p, 0.0, along_x(0.5), p, along_x(0.5)), None);
    assert_eq!(illumination(DVec3::ZERO, 0.0, along_x(0.5), DVec3::ZERO, Velocity::ZERO), None);
    assert_eq!(illumination_from_afar(along_x(0.5), DVec3::ZERO, Velocity::ZERO), None);
    // Lengths whose squares overflow or underflow.
    for scale in [1e-200, 1e200] {
        let light = light_on(DVec3::ZERO, Velocity::ZERO, DVec3::Y * scale, along_x(0.9));
        near("D", light.doppler, 2.294_157_339, 1e-9);
    }
}

/// A sky at rest gives every surface level 1.
#[test]
fn a_sky_at_rest_is_ambient_light() {
    for normal in directions() {
        let level: f64 = ambient_illumination(normal, Velocity::ZERO).map(|ring| ring.level).sum();
        assert!((level - 1.0).abs() < 1e-3, "{normal}: {level}");
    }
}

/// Levels and powers of a moving sky against a sum over its points, each a directional light.
#[test]
fn a_moving_sky_is_a_sum_of_directional_lights() {
    let (n_rings, n_points) = (500, 100);
    for v_sky in [along_x(0.3), beta(0.0, -0.9, 0.0), beta(0.5, 0.4, -0.5)] {
        let axis = v_sky.direction();
        let (aside, up) = axis.any_orthonormal_pair();
        for normal in [axis, -axis, aside, (axis + up).normalize(), (up - 3.0 * axis).normalize()] {
            let mut sums = [0.0; 2];
            for ring in 0..n_rings {
                let cos = -1.0 + (f64::from(ring) + 0.5) * 2.0 / f64::from(n_rings);
                for point in 0..n_points {
                    let (sin_turn, cos_turn) =
                        libm::sincos(2.0 * PI * f64::from(point) / f64::from(n_points));
                    let d =
                        cos * axis + (1.0 - cos * cos).sqrt() * (cos_turn * aside + sin_turn * up);
                    let light =
                        illumination_from_afar(Velocity::ZERO, d, v_sky).expect("a direction");
                    let level =
                        normal.dot(light.toward).max(0.0) * 4.0 / f64::from(n_rings * n_points);
                    sums[0] += level * light.doppler;
                    sums[1] += level * light.doppler * light.doppler;
                }
            }
            let rings = || ambient_illumination(normal, v_sky);
            let ours: [f64; 2] = [
                rings().map(|ring| ring.level * ring.doppler).sum(),
                rings().map(|ring| ring.level * ring.doppler * ring.doppler).sum(),
            ];
            near("photons", ours[0] / sums[0], 1.0, 3e-3);
            near("power", ours[1] / sums[1], 1.0, 3e-3);
        }
    }
}
