//! Light of lamps that falls off with the square of the distance (P14).

use std::f64::consts::PI;

use glam::{DMat4, DVec3, DVec4};
use ugphysics::{Brightness, srgb_decode};
use ugtesting::Random;
use ugtests::scenes;

use super::linear_light::{ENGINES, Engine, WITH_MOVING_LAMPS, assert_light, place, seen, square};

pub fn point(p: DVec3) -> String {
    format!("{:?} {:?} {:?}", p.x, p.y, p.z)
}

/// The boost from the rest frame of a body with velocity `v`; events are (x, y, z, t).
pub fn boost(v: DVec3) -> DMat4 {
    let speed = v.length();
    let (gamma, axis) = (1.0 / (1.0 - speed * speed).sqrt(), v / speed);
    let column =
        |unit: DVec3| (unit + (gamma - 1.0) * unit.dot(axis) * axis).extend(gamma * unit.dot(v));
    DMat4::from_cols(
        column(DVec3::X),
        column(DVec3::Y),
        column(DVec3::Z),
        DVec4::from((gamma * v, gamma)),
    )
}

/// A lamp that rests with what it lights: the level is intensity · r₀²/r² · cos, whatever the
/// motion of both.
#[test]
fn light_falls_with_the_square_of_the_distance() {
    let toward = DVec3::X;
    for v in [DVec3::ZERO, DVec3::new(0.3, -0.5, 0.1)] {
        let at = place(v, toward);
        let normal = -at.normalize();
        let aside = normal.any_orthonormal_vector();
        let level = |engine, distance: f64, degrees: f64, rest: &str| {
            let (sin, cos) = (libm::sin(degrees.to_radians()), libm::cos(degrees.to_radians()));
            let lamp = at + distance * (cos * normal + sin * aside);
            let text = format!(
                "c own 0.5;\n{}l 0.6 {} {rest};",
                square(v, toward, None, "own"),
                point(lamp)
            );
            seen(engine, &text, toward, Brightness::Photon, false)
        };
        for engine in ENGINES {
            let unit = level(engine, 3.0, 0.0, "0");
            for (distance, degrees, reference) in
                [(0.5, 0.0, 1.0), (2.0, 0.0, 2.0), (2.0, 60.0, 0.5), (40.0, 30.0, 7.0)]
            {
                let ratio = reference / distance;
                let expected = ratio * ratio * libm::cos(f64::to_radians(degrees)) * unit;
                let found = level(engine, distance, degrees, &format!("0 {reference}"));
                // The square has a half side of a thousandth.
                assert_light(
                    found,
                    expected,
                    1e-4,
                    &format!("{engine:?} {v} {distance} {degrees}"),
                );
            }
            // Not above the light at the surface of the lamp.
            let within = level(engine, 0.2, 0.0, "0.5 1");
            if engine != Engine::Rays {
                assert_light(within, 4.0 * unit, 1e-4, &format!("{engine:?} within the radius"));
            }
        }
    }
}

/// Highlights have the fall-off, too: the surface mirrors the lamp and scatters nothing.
#[test]
fn highlights_fall_with_the_square_of_the_distance() {
    let light = |distance: f64, rest: &str| {
        let surface = square(DVec3::ZERO, DVec3::X, None, "white shiny");
        let text = format!(
            "c white 1; surf shiny 0 1 0 1 5;\n{surface}l 0.6 {:?} 0 0 {rest};",
            9.0 - distance
        );
        seen(Engine::Rays, &text, DVec3::X, Brightness::Photon, false)
    };
    let unit = light(3.0, "0");
    assert!(unit.max_element() > 0.1, "{unit}");
    for distance in [0.5, 4.0] {
        assert_light(
            light(distance, "0 2"),
            4.0 / (distance * distance) * unit,
            1e-4,
            "a highlight",
        );
    }
}

/// Without linear light, too, the level of 1988 has the fall-off: a display-encoded factor.
#[test]
fn laws_of_display_encoded_values_have_it_too() {
    for engine in ENGINES {
        let text = |rest: &str| {
            format!("c own 0.5;\n{}l 0.6 7 0 0 {rest};", square(DVec3::ZERO, DVec3::X, None, "own"))
        };
        let value = |rest| seen(engine, &text(rest), DVec3::X, Brightness::Report, true);
        assert_light(value("0"), DVec3::splat(srgb_decode(0.3)), 1e-4, &format!("{engine:?}"));
        assert_light(value("0 1"), DVec3::splat(srgb_decode(0.075)), 1e-4, &format!("{engine:?}"));
    }
}

/// A lamp and a surface element with any velocities, by 4×4 matrices.
pub struct MovingLamp {
    /// Velocity of the surface.
    pub v: DVec3,
    /// Velocity of the lamp.
    pub v_lamp: DVec3,
    /// Direction of the surface as seen.
    pub toward: DVec3,
    /// Position at rest of the surface.
    pub at: DVec3,
    /// Direction and distance of the lamp at emission, in the rest frame of the surface.
    pub to_lamp: DVec3,
    pub distance: f64,
    /// Events in the rest frame of the surface.
    pub scatter: DVec4,
    pub emission: DVec4,
    pub lamp_from_surface: DMat4,
}

impl MovingLamp {
    pub fn random(random: &mut Random) -> Self {
        let [v, v_lamp] = [(); 2].map(|()| 0.9 * random.unit() * random.direction());
        let toward = random.direction();
        let at = place(v, toward);
        let (to_lamp, distance) = (random.direction(), random.between(0.5, 5.0));
        let to_lamp = if to_lamp.dot(at) > 0.0 { -to_lamp } else { to_lamp };
        // In the frame of the surface it scatters at (p', −|p'|).
        let scatter = at.extend(-at.length());
        let emission = scatter + (distance * to_lamp).extend(-distance);
        let lamp_from_surface = boost(-v_lamp) * boost(v);
        Self { v, v_lamp, toward, at, to_lamp, distance, scatter, emission, lamp_from_surface }
    }

    /// Position of the lamp in its rest frame.
    pub fn lamp(&self) -> DVec3 {
        (self.lamp_from_surface * self.emission).truncate()
    }
}

/// Lamp and surface with any velocities: P D_l⁴/(4π r²), times D⁴ from the surface to the eye, by
/// 4×4 matrices.
#[test]
fn any_lamp_has_the_irradiance_of_p14() {
    let mut random = Random(46);
    for case in 0..40 {
        let moving = MovingLamp::random(&mut random);
        let lamp = moving.lamp();
        let MovingLamp {
            v,
            v_lamp,
            toward,
            at,
            to_lamp,
            distance,
            scatter,
            emission,
            lamp_from_surface,
        } = moving;
        let rest_distance = (lamp_from_surface * (emission - scatter)).truncate().length();
        let (d_lamp, d) = (distance / rest_distance, (boost(v) * scatter).w.abs() / at.length());
        let cos = to_lamp.dot(-at.normalize());
        let expected = 1.7 * libm::pow(d * d_lamp, 4.0) * cos / (4.0 * PI * distance * distance);
        let surface = square(v, toward, None, "white");
        let text = format!(
            "c white 1;\n{surface}l {:?} {} 0 2 <{} -at 0 0 0>;",
            1.7 / (16.0 * PI),
            point(lamp),
            point(v_lamp)
        );
        for engine in WITH_MOVING_LAMPS {
            let found = seen(engine, &text, toward, Brightness::Bolometric, false).y;
            // The square has a half side of a thousandth, and the lamp may be as near as 0.5.
            assert!(
                (found / expected - 1.0).abs() < 1e-4,
                "{case} {engine:?}: {found}, not {expected}"
            );
        }
    }
}

/// Light at the lamp itself is finite, and that of any point near it is at most 10¹² times the
/// intensity.
#[test]
fn no_light_is_infinite() {
    for distance in [0.0, 1e-300, 1e-12, 1e-7] {
        let surface = square(DVec3::ZERO, DVec3::X, None, "white");
        let text = format!("c white 1;\n{surface}l 0.5 {:?} 0 0 0 1;", 9.0 - distance);
        for engine in ENGINES {
            let found = seen(engine, &text, DVec3::X, Brightness::Photon, false).max_element();
            assert!((0.0..=0.5e12 * 1.001).contains(&found), "{engine:?} {distance}: {found}");
        }
    }
}

/// An instance scales the reference distance with the scene: at three times the size the light is
/// the same.
#[test]
fn instances_scale_the_reference_distance() {
    let reference = |steps: &str| {
        let text = format!("def lamp; l 1 0 0 5 0.1 2; end; i (lamp {steps});");
        let scene = scenes::parse(text.as_bytes());
        match scene.lights[0].kind {
            ugscene::LightKind::Local { reference: Some(reference), .. } => reference,
            other => panic!("{other:?}"),
        }
    };
    for (steps, expected) in [
        ("-tx 3 -rz 90 -mx", 2.0),
        ("-sa 3", 6.0),
        ("-sa -3", 6.0),
        ("-sx 8", 4.0),
        ("-rx 30 -sy 27 -rz 12", 6.0),
        ("-sa 1e120 -sa 1e-110", 2e10),
    ] {
        assert!((reference(steps) / expected - 1.0).abs() < 1e-12, "{steps}: {}", reference(steps));
    }
    assert!(reference("-sz 0") > 0.0);
    let scene = "v a 9 -1 -1; v b 9 1 -1; v c 9 0 2; f (c b a); l 0.5 8 0.3 0.2 0 1.5;";
    for engine in ENGINES {
        let light = |text: &str| seen(engine, text, DVec3::X, Brightness::Photon, true);
        let scaled = light(&format!("def all; {scene} end; i (all -sa 3);"));
        assert_light(scaled, light(scene), 1e-5, &format!("{engine:?}"));
    }
}
