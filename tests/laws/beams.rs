//! Lamps that shine in a cone, from an area (P14), or in glass (P24).

use glam::DVec3;
use ugphoton::{CameraOptions, PictureOptions};
use ugphysics::Brightness;
use ugtesting::Random;
use ugtests::scenes;

use super::fall_off::{MovingLamp, boost, point};
use super::linear_light::{ENGINES, WITH_MOVING_LAMPS, assert_light, place, seen, square};

/// The part of the light of a spot at an angle to its axis, all in degrees.
fn spot_part(off: f64, angle: f64, edge: f64) -> f64 {
    let x = ((angle - off) / edge).clamp(0.0, 1.0);
    x * x * (3.0 - 2.0 * x)
}

/// Options of an area across a direction, with sides of this length.
fn area(normal: DVec3, side: f64) -> String {
    let u = normal.any_orthonormal_vector();
    format!("-area {} {}", point(side * u), point(side * normal.cross(u)))
}

/// Lamps that rest with what they light, whatever the motion of both: a small area has the light of
/// a point times the cosine at the lamp, and none behind it; a spot, that of its cone.
#[test]
fn beams_weaken_the_light_of_a_point() {
    let toward = DVec3::X;
    for v in [DVec3::ZERO, DVec3::new(0.3, -0.5, 0.1)] {
        let at = place(v, toward);
        let normal = -at.normalize();
        let aside = normal.any_orthonormal_vector();
        let lamp = at + 2.0 * (0.8 * normal + 0.6 * aside);
        let leaving = (at - lamp).normalize();
        let across = leaving.any_orthonormal_vector();
        let level = |engine, beam: &str| {
            let surface = square(v, toward, None, "own");
            let text = format!("c own 0.5;\n{surface}l 0.6 {} 0 1.5 {beam};", point(lamp));
            seen(engine, &text, toward, Brightness::Photon, false)
        };
        for engine in ENGINES {
            let whole = level(engine, "");
            for degrees in [0.0, 10.0, 25.0, 33.0, 70.0, 140.0] {
                let (sin, cos) = libm::sincos(f64::to_radians(degrees));
                let axis = cos * leaving + sin * across;
                let found = level(engine, &area(axis, 1e-3));
                assert_light(
                    found,
                    cos.max(0.0) * whole,
                    2e-3,
                    &format!("{engine:?} area {v} {degrees}"),
                );
                let found = level(engine, &format!("-spot {} 35 20", point(3.0 * axis)));
                let part = spot_part(degrees, 35.0, 20.0);
                assert_light(
                    found,
                    part * whole,
                    2e-3 * part.max(1e-9),
                    &format!("{engine:?} spot {degrees}"),
                );
            }
        }
    }
}

/// Irradiance by a square of radiance L is L/2 Σ θ n·Γ over its edges (Lambert 1760): θ, the angle
/// of an edge as seen, Γ, the normal of the plane through it.
#[test]
fn a_large_area_has_the_irradiance_of_lamberts_formula() {
    let (center, normal) = (DVec3::new(9.0, 0.0, 0.0), -DVec3::X);
    let surface = square(DVec3::ZERO, DVec3::X, None, "white");
    for (distance, side, aside, of_points) in
        [(1.0, 4.0, 0.0, 0.6), (2.0, 1.0, 0.4, 3e-4), (1.0, 1.0, 0.2, 5e-3)]
    {
        let at = center + distance * normal + aside * DVec3::Y;
        let corner = |y: f64, z: f64| at + 0.5 * side * DVec3::new(0.0, y, z) - center;
        let corners = [corner(1.0, 1.0), corner(-1.0, 1.0), corner(-1.0, -1.0), corner(1.0, -1.0)];
        let edge = |idx: usize| {
            let (from, to) = (corners[idx].normalize(), corners[(idx + 1) % 4].normalize());
            libm::acos(from.dot(to)) * normal.dot(from.cross(to).normalize())
        };
        let intensity = 0.1;
        let radiance = intensity / (side * side);
        let expected = 0.5 * radiance * (0..4).map(edge).sum::<f64>().abs();
        let text = format!(
            "c white 1;\n{surface}l {intensity} {} 0 1 {};",
            point(at),
            area(-normal, side)
        );
        let camera = CameraOptions {
            eye: Some(DVec3::ZERO),
            center: Some(DVec3::X),
            view_angle: Some((1e-5, None)),
            ..CameraOptions::default()
        };
        let picture =
            PictureOptions { size: [8, 8], samples: 16, camera, ..PictureOptions::default() };
        let shift = uglight::ColorShift::hues(false, Brightness::Photon);
        let config = ugphoton::Config { picture, shift, ..ugphoton::Config::default() };
        let frame = ugphoton::light(scenes::parse(text.as_bytes()), &config).unwrap();
        let found = frame.pixels().iter().map(|pixel| f64::from(pixel[1])).sum::<f64>() / 64.0;
        assert!(
            (found / expected - 1.0).abs() < 1e-3,
            "{distance} {side}: {found}, not {expected}"
        );
        // Nine points are enough if the lamp is not much wider than its distance.
        for engine in &ENGINES[..3] {
            let found = seen(*engine, &text, DVec3::X, Brightness::Photon, false).y;
            assert!(
                (found / expected - 1.0).abs() < of_points,
                "{engine:?} {distance} {side}: {found}, not {expected}"
            );
        }
    }
}

/// Lamp and surface with any velocities: the cone and the cosine are those of the direction in
/// which light leaves in the rest frame of the lamp, by 4×4 matrices.
#[test]
fn beams_are_those_of_the_rest_frame_of_the_lamp() {
    let mut random = Random(71);
    let mut n_lit = 0;
    for case in 0..60 {
        let moving = MovingLamp::random(&mut random);
        let lamp = moving.lamp();
        let MovingLamp { v, v_lamp, toward, scatter, emission, lamp_from_surface, .. } = moving;
        let leaving = (lamp_from_surface * (scatter - emission)).truncate().normalize();
        let axis = (leaving + random.unit() * random.direction()).normalize();
        let off = libm::acos(leaving.dot(axis).clamp(-1.0, 1.0)).to_degrees();
        let level = |engine, beam: &str| {
            let text = format!(
                "c white 1;\n{}l 1e-3 {} 0 2 {beam} <{} -at 0 0 0>;",
                square(v, toward, None, "white"),
                point(lamp),
                point(v_lamp)
            );
            seen(engine, &text, toward, Brightness::Bolometric, false).y
        };
        for engine in WITH_MOVING_LAMPS {
            let whole = level(engine, "");
            let spot = level(engine, &format!("-spot {} 40 30", point(axis)));
            let of_area = level(engine, &area(axis, 1e-4));
            let (part, cos) = (spot_part(off, 40.0, 30.0), libm::cos(off.to_radians()).max(0.0));
            n_lit += u32::from(part > 0.0 && part < 1.0);
            assert!(
                (spot / whole - part).abs() < 2e-3,
                "{case} {engine:?}: {spot} of {whole}, not {part}"
            );
            assert!(
                (of_area / whole - cos).abs() < 2e-3,
                "{case} {engine:?}: {of_area} of {whole}, not {cos}"
            );
        }
    }
    assert!(n_lit > 20, "{n_lit}");
}

/// A spot that moves along its axis has the aberrated half-angle, tan(θ'/2) = √((1 − β)/(1 + β))
/// tan(θ/2).
#[test]
fn a_moving_cone_is_aberrated() {
    let (at, half) = (DVec3::new(9.0, 0.0, 0.0), 40.0);
    for beta in [-0.8, -0.3, 0.5, 0.9] {
        let tan = libm::sqrt((1.0 - beta) / (1.0 + beta)) * libm::tan(f64::to_radians(0.5 * half));
        let seen_half = 2.0 * libm::atan(tan).to_degrees();
        for step in 1..12 {
            let degrees = 7.0 * f64::from(step);
            if (degrees - seen_half).abs() < 0.5 {
                continue;
            }
            // Light arrives at the surface along +x, at this angle to the axis.
            let (sin, cos) = libm::sincos(degrees.to_radians());
            let axis = DVec3::new(cos, sin, 0.0);
            let emission = (at - 2.0 * DVec3::X).extend(-at.length() - 2.0);
            let lamp = (boost(-beta * axis) * emission).truncate();
            let text = format!(
                "c white 1;\n{}l .01 {} 0 2 -spot {} {half} 0 <{} -at 0 0 0>;",
                square(DVec3::ZERO, DVec3::X, None, "white"),
                point(lamp),
                point(axis),
                point(beta * axis)
            );
            for engine in WITH_MOVING_LAMPS {
                let found = seen(engine, &text, DVec3::X, Brightness::Bolometric, false).y;
                assert_eq!(
                    found > 0.0,
                    degrees < seen_half,
                    "{engine:?} {beta} {degrees} {seen_half}"
                );
            }
        }
    }
}

/// Beams survive the writer, turn and grow with instances, and are checked.
#[test]
fn beams_are_statements() {
    let parse = |text: &str| {
        ugparse::parse(&ugparse::Source::new("t.ug", text), &ugparse::Options::default())
    };
    let text = "l a 2  0 0 5 0 -spot 0 1 -1 30 5;\nl b 1  0 0 5 0 3 -area 0 1 0 2 0 0 < 0 .5 0 >;";
    let scene = parse(text).unwrap().scene;
    let written = String::from_utf8(ugparse::write(&scene)).unwrap();
    assert!(
        written.contains("-spot 0 1 -1 30 5") && written.contains("-area 0 1 0 2 0 0"),
        "{written}"
    );
    assert_eq!(parse(&written).unwrap().scene.lights, scene.lights);
    let instance = format!("def d;\n{}\nend;\ni (d -sa 2 -rz 90);", text.replace("< 0 .5 0 >", ""));
    let lights = parse(&instance).unwrap().scene.lights;
    let ugscene::LightKind::Local { beam: ugscene::Beam::Spot { axis, .. }, .. } = lights[0].kind
    else {
        panic!("{lights:?}")
    };
    assert!(axis.normalize().distance(DVec3::new(-1.0, 0.0, -1.0).normalize()) < 1e-12, "{axis}");
    let ugscene::LightKind::Local { beam: ugscene::Beam::Area([u, v]), .. } = lights[1].kind else {
        panic!("{lights:?}")
    };
    assert!(u.distance(-2.0 * DVec3::X) < 1e-12 && v.distance(4.0 * DVec3::Y) < 1e-12, "{u} {v}");
    for (text, expected) in [
        ("l 1 -spot 0 0 1 30 5;", "a spot has a position and a radius"),
        (
            "l 1 0 0 5 0 -area 1 0 0 0 1 0;",
            "an area has a position, a radius and a reference distance",
        ),
        ("l 1 0 0 5 0 -spot 0 0 0 30 5;", "an axis is not 0"),
        ("l 1 0 0 5 0 -spot 0 0 1 30 31;", "an edge 0 to the angle"),
        ("l 1 0 0 5 0 1 -area 1 0 0 2 0 0;", "edges span an area"),
        ("l 1 0 0 5 0 -cone 1;", "`-spot`"),
    ] {
        let found = parse(text).unwrap_err().to_string();
        assert!(found.contains(expected), "{text}: {found}");
    }
}

/// A lamp, a surface and the eye at rest in glass: a flash is seen after N times the length of its
/// way. Without the glass, and with a lamp outside of it, it is not slowed.
#[test]
fn a_flash_in_glass_is_slowed() {
    let corners = "v c0 -20 -20 -20; v c1 20 -20 -20; v c2 20 20 -20; v c3 -20 20 -20;
                   v c4 -20 -20 20; v c5 20 -20 20; v c6 20 20 20; v c7 -20 20 20;";
    let faces = "f (c3 c2 c1 c0) white glass; f (c4 c5 c6 c7) white glass; f (c0 c1 c5 c4) white glass;
                 f (c1 c2 c6 c5) white glass; f (c2 c3 c7 c6) white glass; f (c3 c0 c4 c7) white glass;";
    let solid = format!("surf glass 0 0 1 1.5;\n{corners}\n{faces}");
    let surface = square(DVec3::ZERO, DVec3::X, None, "white");
    for (glass, lamp, way) in
        [("", 7.0, 11.0), (&solid[..], 7.0, 1.5 * 11.0), (&solid, -21.0, 1.5 * 9.0 + 30.0)]
    {
        let text = format!(
            "c white 1; c black 0; c_time flash -step -1e3 black 0 white;\n{glass}\n{surface}
             l 1 {lamp} 0 0 0 flash <0 0 0>;"
        );
        let lit = |time: f64| {
            let camera = CameraOptions {
                eye: Some(DVec3::ZERO),
                center: Some(DVec3::X),
                view_angle: Some((1e-5, None)),
                ..CameraOptions::default()
            };
            let picture =
                PictureOptions { size: [1, 1], samples: 1, camera, ..PictureOptions::default() };
            let motion = ugphoton::MotionOptions { time, ..Default::default() };
            let config = ugphoton::Config { picture, motion, ..ugphoton::Config::default() };
            ugphoton::light(scenes::parse(text.as_bytes()), &config).unwrap().pixels()[0][1] > 0.1
        };
        assert!(!lit(way - 0.01) && lit(way + 0.01), "{lamp} {way}");
    }
}
