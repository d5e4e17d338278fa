//! Published and independently computed numbers: this crate answers the questions of
//! `conformance/cases`, which `conformance/README.md` explains.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use glam::DVec3;
use ugphysics::spectrum::{Spectrum, planck};
use ugphysics::{
    Brightness, Event, HyperbolicMotion, Medium, Velocity, WaveVector, WorldLine, aberrate,
    compose, contracted, doppler_at, doppler_factor, flight_time, observer_shift, rest_position,
    seen_position, srgb_encode, wigner_rotation,
};

use crate::illumination::{irradiance, light_on};
use crate::laws::{circle_through, sphere_outline};
use crate::spectral_standards::chromaticity;
use crate::surfaces::{reflected, wave};
use crate::world_lines::{ALWAYS, moving as line, piece};
use crate::{along_x, angle_deg, at_angle, beta, near, near_vector};

/// A distance at which a body of size 1 is small: second-order terms are 10⁻¹², rounding is 10⁻¹⁰.
const FAR: f64 = 1e6;

/// The least tolerance of answers that subtract places at the distance [`FAR`].
const FROM_AFAR: f64 = 1e-9;

/// Rest coordinates of a point seen from afar, with `angle` degrees between its motion along +x and
/// the direction from it to the eye.
fn far_point(angle: f64, v: Velocity) -> DVec3 {
    rest_position(-FAR * at_angle(angle), v)
}

/// The place, relative to its middle, at which the end `step` of a small distant body is seen,
/// from both ends.
fn seen_step(angle: f64, v: Velocity, step: DVec3) -> DVec3 {
    let p = far_point(angle, v);
    // Ten times as long, for less rounding.
    (seen_position(p + 5.0 * step, v) - seen_position(p - 5.0 * step, v)) / 10.0
}

/// A point that runs on a circle, of the radius and with the rate that `x` begins with.
fn orbiting(x: &[f64]) -> WorldLine {
    WorldLine::orbiting(x[0] * DVec3::X, DVec3::ZERO, DVec3::Z, x[1], &[]).unwrap()
}

/// Own time, place, velocity and D of a point of a body, seen from the event `eye`.
fn emission(body: &WorldLine, point: DVec3, eye: &[f64]) -> Vec<f64> {
    let eye = Event { t: eye[0], x: DVec3::from_slice(&eye[1..]) };
    let seen = body.emission(point, eye).unwrap();
    let (place, beta) = (seen.event.x - eye.x, seen.velocity.beta());
    let doppler = doppler_at(place, seen.velocity);
    vec![seen.own_time, place.x, place.y, place.z, beta.x, beta.y, beta.z, doppler]
}

/// The place of a point at rest in the axes of a camera, and D.
fn seen_in_axes(camera: &WorldLine, own_time: f64, point: DVec3) -> Vec<f64> {
    let pose = camera.pose(own_time);
    let place = point - pose.event.x;
    let seen = pose.scene_from_axes.inverse().apply(Event { t: -place.length(), x: place }).x;
    vec![seen.x, seen.y, seen.z, seen.length() / place.length()]
}

/// The answer to a question with the numbers `x`; `None` if this crate has no function for it.
/// Most begin with a speed along +x, in the fraction of light.
#[rustfmt::skip] // rows of a table
fn answer(kind: &str, x: &[f64]) -> Option<Vec<f64>> {
    let vector = |at: usize| DVec3::from_slice(&x[at..]);
    let moving = |at: usize| Velocity::from_beta(vector(at)).unwrap();
    let v = || along_x(x[0]);
    let doppler = || doppler_factor(at_angle(x[1]), v());
    let angle_of = |d: DVec3| angle_deg(d, DVec3::X);
    Some(match kind {
        "gamma" => vec![v().gamma()],
        "retarded" | "source_distances" | "doppler_now" => {
            let (now, v) = (vector(0), moving(3));
            let time = flight_time(now, v);
            let place = now + time * v.beta();
            // The point at rest at p' is at p₀ now: undo the contraction.
            let p_rest = now + (v.gamma() - 1.0) * now.dot(v.direction()) * v.direction();
            near_vector("seen", seen_position(p_rest, v), place, 1e-12);
            match kind {
                "retarded" => vec![time, place.x, place.y, place.z],
                "doppler_now" => vec![doppler_at(place, v)],
                _ => vec![place.length(), p_rest.length()],
            }
        }
        "approach_speed" | "recession_speed" => {
            let middle = if kind == "approach_speed" { -1e4 } else { 1e4 } * DVec3::X;
            let at = |t: f64| seen_position(middle + observer_shift(v(), t), v()).length();
            vec![(at(1.0) - at(0.0)).abs()]
        }
        "transverse_speed" => {
            let (p, sight) = (far_point(x[1], v()), at_angle(x[1]));
            let at = |t: f64| seen_position(p + observer_shift(v(), t), v()).reject_from(sight);
            vec![(at(1.0) - at(-1.0)).length() / 2.0]
        }
        "rod_approaching" | "rod_receding" => {
            let from = if kind == "rod_approaching" { DVec3::NEG_X } else { DVec3::X };
            vec![(seen_position(2.0 * from, v()) - seen_position(from, v())).length()]
        }
        "rod_extent" => vec![seen_step(x[1], v(), DVec3::X).x],
        "terrell" => vec![angle_of(-far_point(x[1], v())) - x[1]],
        "cube_abeam" => [DVec3::X, DVec3::Y].map(|edge| seen_step(90.0, v(), edge).x.abs()).to_vec(),
        "edge_x" => vec![seen_position(DVec3::new(0.0, x[2], x[1]), v()).x],
        "edge_chord_error" => {
            let at = |y: f64| seen_position(DVec3::new(0.0, y, x[1]), v()).x;
            let width = 2.0 * x[2] / x[3];
            let errors = (0..x[3] as i32).map(|i| {
                let y = -x[2] + width * f64::from(i);
                let slope = (at(y + width) - at(y)) / width;
                // The curve is furthest from its chord where it is parallel to it.
                let sine = -slope / v().proper_speed();
                let touch = x[1] * sine / (1.0 - sine * sine).sqrt();
                (at(touch) - (at(y) + slope * (touch - y))).abs()
            });
            vec![errors.fold(0.0, f64::max)]
        }
        "sphere_outline" => {
            let outline = sphere_outline(at_angle(x[3]), x[1] / x[2], v(), 360);
            let (axis, radius_deg) = circle_through(&outline);
            for d in &outline {
                near("planar", d.dot(axis), outline[0].dot(axis), 1e-14);
            }
            vec![radius_deg, angle_of(axis), angle_of(seen_position(x[2] * at_angle(x[3]), v()))]
        }
        "aberration" => vec![angle_of(aberrate(at_angle(x[1]), v()))],
        "aberration_shift" => vec![x[1] - angle_of(aberrate(at_angle(x[1]), v()))],
        "aberration_constant" => {
            vec![3600.0 * angle_deg(aberrate(DVec3::Y, along_x(x[0] / 299_792.458)), DVec3::Y)]
        }
        "aberrate" => aberrate(vector(0), moving(3)).to_array().to_vec(),
        "aberration_arcsec" => vec![3600.0 * angle_deg(aberrate(vector(0), moving(3)), vector(0))],
        // Light emitted at right angles in the body's frame.
        "headlight" => vec![angle_of(-aberrate(DVec3::NEG_Y, -v()))],
        // The scene moves towards a camera that looks along +x, or away from it.
        "field_of_view" | "camera_covers" => {
            let half = x.get(1).map_or(90.0, |angle| angle / 2.0);
            let [forward, backward] = [-v(), v()].map(|v| 2.0 * angle_of(aberrate(at_angle(half), v)));
            let edge = aberrate(DVec3::Y, v());
            let radius = (kind == "field_of_view").then_some(edge.y / edge.x);
            [forward, backward].into_iter().chain(radius).collect()
        }
        "stereographic_factor" => {
            let d = aberrate(DVec3::Y, v());
            vec![libm::tan(angle_of(d).to_radians() / 2.0)]
        }
        "doppler" => vec![doppler_factor(vector(0), moving(3))],
        "doppler_in_body" => {
            let (n, v) = (vector(0), moving(3));
            near("1/D'", 1.0 / doppler_factor(n, -v), doppler_factor(-aberrate(-n, -v), v), 1e-14);
            vec![1.0 / doppler_factor(n, -v)]
        }
        "doppler_rapidity" => {
            vec![doppler_factor(at_angle(x[1]), Velocity::from_rapidity(DVec3::X, x[0]).unwrap())]
        }
        "doppler_shift" => vec![doppler() - 1.0],
        "doppler_of_frames" => vec![doppler_factor(vector(0), compose(moving(3), moving(6)))],
        "no_shift_angle" => {
            let is_blue = |angle: f64| doppler_factor(at_angle(angle), v()) > 1.0;
            let halved = |[low, high]: [f64; 2], middle| if is_blue(middle) { [middle, high] } else { [low, middle] };
            let ends = (0..60).fold([0.0, 180.0], |ends, _| halved(ends, (ends[0] + ends[1]) / 2.0));
            vec![ends[0]]
        }
        "radiance" => vec![Brightness::Bolometric.factor(doppler())],
        "radiance_photons" => vec![Brightness::Photon.factor(doppler())],
        "compose" => compose(moving(0), moving(3)).beta().to_array().to_vec(),
        "wigner" => vec![wigner_rotation(moving(0), moving(3)).to_axis_angle().1.to_degrees()],
        // Contracted point by point.
        "contracted_normal" => {
            let (a, b) = vector(0).normalize().any_orthonormal_pair();
            contracted(a, moving(3)).cross(contracted(b, moving(3))).normalize().to_array().to_vec()
        }
        "mirror_angle" => {
            let d = at_angle(x[0]);
            let back = reflected(wave(DVec3::new(-d.x, d.y, 0.0)), DVec3::X, along_x(x[1]));
            vec![angle_of(back.k), back.frequency]
        }
        "mirror" => {
            let back = reflected(wave(vector(0)), vector(6), moving(3));
            (back.k / back.frequency).to_array().into_iter().chain([back.frequency]).collect()
        }
        "glass_speed" => {
            let glass = Medium { index: x[0], velocity: along_x(x[1]) };
            let light_in_glass = WaveVector { frequency: 1.0, k: glass.index * DVec3::X };
            let step = glass.step(light_in_glass.in_frame(-glass.velocity));
            vec![step.x.x / step.t]
        }
        "hyperbolic" => {
            let ship = HyperbolicMotion { acceleration: x[0] * DVec3::Z };
            let (event, v) = (ship.event(x[1]), ship.velocity(x[1]).unwrap());
            vec![v.speed(), v.gamma(), event.t, event.x.z]
        }
        "accelerated" => {
            let body = line([0.0; 3], [0.0; 3], &[piece([x[0], x[1], x[2]], [0.0, x[3]])], &[]);
            emission(&body, vector(4), &x[7..])
        }
        "spinning" => {
            let spin = piece([x[3], x[4], x[5]], ALWAYS);
            emission(&line([0.0; 3], [x[0], x[1], x[2]], &[], &[spin]), vector(6), &x[9..])
        }
        "orbiting" => emission(&orbiting(x), x[0] * DVec3::X + vector(2), &x[5..]),
        "accelerated_camera" => {
            let camera = line([0.0; 3], [0.0; 3], &[piece([x[0], x[1], x[2]], ALWAYS)], &[]);
            seen_in_axes(&camera, x[3], vector(4))
        }
        "orbiting_camera" => seen_in_axes(&orbiting(x), x[2], vector(3)),
        // By Simpson's rule: D depends on cos θ alone, in which the area of the sphere is uniform.
        "sky_mean" => {
            const STEPS: u32 = 60_000;
            let term = |step: u32| {
                let cos = 2.0 * f64::from(step) / f64::from(STEPS) - 1.0;
                let n = DVec3::new(cos, (1.0 - cos * cos).max(0.0).sqrt(), 0.0);
                let weight = if step == 0 || step == STEPS { 1.0 } else { f64::from(2 + 2 * (step % 2)) };
                weight * libm::pow(doppler_factor(n, v()), x[1])
            };
            vec![(0..=STEPS).map(term).sum::<f64>() / (3.0 * f64::from(STEPS))]
        }
        "blackbody_radiance_ratio" => vec![planck(x[2], x[0] * x[1]) / planck(x[2], x[0])],
        "blackbody_xy" => chromaticity(Spectrum::blackbody(x[0], 1.0).seen(1.0)).to_vec(),
        "blackbody_luminance_ratio" => vec![Spectrum::blackbody(x[1], 1.0).seen(x[0] / x[1])[1]],
        "srgb_encode" => vec![srgb_encode(x[0])],
        "irradiance" | "irradiance_by_light_distance" => {
            let towards = at_angle(x[3]);
            let v = beta(-x[2] * towards.x, x[2] * towards.y, 0.0);
            let place = rest_position(DVec3::X, v);
            let scale = x[1] / if kind == "irradiance" { 1.0 } else { place.length() };
            vec![x[0] * irradiance(light_on(DVec3::ZERO, Velocity::ZERO, scale * place, v))]
        }
        _ => return None,
    })
}

#[test]
fn questions_of_the_conformance_suite_are_answered() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../conformance/cases");
    let (mut kinds, mut n_answers) = (BTreeSet::new(), 0);
    for entry in fs::read_dir(folder).unwrap() {
        let text = fs::read_to_string(entry.unwrap().path()).unwrap();
        for line in text.lines().filter(|line| !line.starts_with('#')) {
            let columns: Vec<&str> = line.split('\t').collect();
            let numbers =
                |text: &str| -> Vec<f64> { text.split(' ').map(|x| x.parse().unwrap()).collect() };
            let (kind, given) = columns[1].split_once(' ').unwrap();
            let Some(found) = answer(kind, &numbers(given)) else { continue };
            let (expected, tolerance) = (numbers(columns[2]), columns[3].parse::<f64>().unwrap());
            let tolerance = match kind {
                "approach_speed" | "recession_speed" | "transverse_speed" | "rod_extent"
                | "cube_abeam" => tolerance.max(FROM_AFAR),
                _ => tolerance,
            };
            assert_eq!(found.len(), expected.len(), "{line}");
            let largest = expected.iter().fold(0.0, |largest: f64, x| largest.max(x.abs()));
            for (found, expected) in found.iter().zip(&expected) {
                let error = (found - expected).abs() / if largest > 0.0 { largest } else { 1.0 };
                assert!(error <= tolerance, "{line}: {found} is off by {error:e}");
            }
            kinds.insert(kind.to_string());
            n_answers += 1;
        }
    }
    assert!(kinds.len() >= 51 && n_answers >= 320, "{n_answers} answers to {kinds:?}");
}

#[test]
fn doppler_at_a_trillionth_below_light() {
    let v = Velocity::from_rapidity(DVec3::X, 0.5 * libm::log((2.0 - 1e-12) / 1e-12)).unwrap();
    let ahead = ((2.0 - 1e-12) / 1e-12_f64).sqrt();
    near("coming", doppler_factor(DVec3::X, v) / ahead, 1.0, 1e-14);
    near("going", doppler_factor(DVec3::NEG_X, v) * ahead, 1.0, 1e-14);
    near("abeam", doppler_factor(DVec3::Y, v) * v.gamma(), 1.0, 1e-15);
    near("gamma", v.gamma() / (1.0 / (1e-12 * (2.0 - 1e-12_f64)).sqrt()), 1.0, 1e-14);
}

#[test]
fn the_law_of_the_report_is_the_default() {
    for doppler in [19.0_f64.sqrt(), 0.19_f64.sqrt()] {
        assert_eq!(
            [Brightness::Report, Brightness::None].map(|law| law.factor(doppler)),
            [doppler, 1.0]
        );
    }
    assert_eq!(Brightness::default(), Brightness::Report);
}
