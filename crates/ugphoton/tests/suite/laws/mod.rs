//! Laws and published numbers, measured in rendered light.

mod beaming;
mod drawing;
mod textures;

use glam::DVec3;
use ugphoton::{ColorShift, Config, RayOptions};
use ugphysics::spectrum::Spectrum;
use ugphysics::{Velocity, WaveVector, srgb_decode, xyz_to_linear_srgb};

use drawing::{HEAD, seen, seen_with, square, value};

/// Frequencies change by (1 + β)/(1 − β) at a mirror that approaches, T27.
#[test]
fn mirrors_shift_frequencies() {
    for (beta, factor) in [(0.5, 3.0), (0.9, 19.0), (-0.5, 1.0 / 3.0), (-0.9, 1.0 / 19.0)] {
        let mirror =
            square("m", DVec3::NEG_Z * 2.0, DVec3::Z, 50.0, &format!("white mirror <0 0 {beta}>"));
        let wall = square("w", DVec3::Z, DVec3::Z, 500.0, "white 1");
        let found = seen(&format!("{HEAD}{mirror}{wall}"), DVec3::NEG_Z).x;
        let expected = srgb_decode(factor);
        assert!((found / expected - 1.0).abs() < 1e-6, "{beta}: {found} {expected}");
    }
}

/// A slab of glass, `half` wide and 1 thick, from z = `top` − 1 to `top`.
fn slab(top: f64, half: f64, velocity: &str) -> String {
    let rest = format!("white glass {velocity}");
    let near = square("n", DVec3::Z * top, DVec3::Z, half, &rest);
    // Seen from outside the corners of the far side run counterclockwise, too.
    let far = square("f", DVec3::Z * (top - 1.0), DVec3::NEG_Z, half, &rest);
    format!("{near}{far}")
}

/// A plane-parallel slab of any velocity leaves direction and frequency as they are, and delays the
/// light: by 0.2887 where it moves with the light at 0.5 c, by 0.8660 against it, by 0.5 at rest
/// (T28). The delay is seen in the place of a bar that moves behind it.
#[test]
fn moving_glass_delays_light() {
    for (beta, delay) in [(0.0, 0.5), (0.5, 0.288_675_134_6), (-0.5, 0.866_025_403_8)] {
        let glass = slab(-2.0, 300.0, &format!("<0 0 {beta}>"));
        check_delay(&glass, delay);
    }
    // Obliquely: the frequency stays. The wall is at rest, so D = 1.
    for velocity in ["<0 0 0>", "<0.3 0.2 -0.4>", "<0 0.9 0>", "<0 0 0.7>"] {
        let wall = square("w", DVec3::NEG_Z * 60.0, DVec3::Z, 900.0, "white 1");
        let text = format!("{HEAD}{}{wall}", slab(-2.0, 900.0, velocity));
        let found = seen(&text, DVec3::new(0.3, 0.1, -1.0)).x;
        assert!((found - 1.0).abs() < 1e-6, "{velocity}: {found}");
    }
}

/// Checks how much later than in a vacuum light from z = −20 arrives at the eye. The delay is seen
/// in the place of the edge of a wall that moves along x with 0.8 c.
fn check_delay(glass: &str, delay: f64) {
    let edge = |x: f64| {
        let x = x / 0.6;
        format!(
            "v a {x} -9 -20; v b {x} 9 -20; v c {} 9 -20; v d {} -9 -20; f (a b c d) white 1 <0.8 0 0>;",
            x - 500.0,
            x - 500.0
        )
    };
    // Light that arrives at time 0 left at −20 − delay, when the edge was at 0.8 times that plus
    // its place at time 0.
    let at = 0.8 * (20.0 + delay);
    for (offset, is_lit) in [(1e-6, true), (-1e-6, false)] {
        let found = seen(&format!("{HEAD}{glass}{}", edge(at + offset)), DVec3::NEG_Z).x;
        assert_eq!(found > 0.0, is_lit, "{glass} {offset}: {found}");
    }
}

/// An eye inside a slab, half a unit from its surface in the slab's frame. Light enters the slab at
/// the event (−0.75, −0.5) of that frame, which a boost carries to the frame of the eye.
#[test]
fn an_eye_in_glass_sees_light_delayed() {
    for beta in [0.0_f64, 0.5, -0.5] {
        let gamma = 1.0 / (1.0 - beta * beta).sqrt();
        let (time, place) = (gamma * (-0.75 - beta * 0.5), gamma * (-0.5 - beta * 0.75));
        check_delay(&slab(0.5, 300.0, &format!("<0 0 {beta}>")), -(time - place));
    }
}

/// From an eye in glass rays leave by Snell's law, so a moving wall is seen with another D.
#[test]
fn an_eye_in_glass_sees_refracted_light() {
    let (speed, gamma) = (0.9, 1.0 / (1.0_f64 - 0.81).sqrt());
    let wall = square("w", DVec3::NEG_Z * 9.0, DVec3::Z, 900.0, "white 1 <0.9 0 0>");
    for sin in [0.0_f64, 0.3, -0.5] {
        let toward = DVec3::new(sin, 0.0, -(1.0 - sin * sin).sqrt());
        let doppler = 1.0 / (gamma * (1.0 + speed * 1.5 * sin));
        let found =
            value(&format!("{HEAD}{}{wall}", slab(0.5, 300.0, "")), toward, Config::default());
        assert!((found / doppler - 1.0).abs() < 1e-6, "{sin}: {found} {doppler}");
    }
}

/// Glass that moves towards the light, or away from it, changes its frequency for an eye inside, at
/// right angles by (1 + nβ)/(1 + β). Glass that moves along its surface does not. Light does not
/// reach an eye in glass that is faster than light in it from behind.
#[test]
fn moving_glass_around_the_eye_changes_frequencies() {
    let wall = square("w", DVec3::NEG_Z * 9.0, DVec3::Z, 900.0, "white 1 <0 0 0>");
    for (velocity, factor) in [
        (DVec3::Z * 0.5, 1.75 / 1.5),
        (DVec3::Z * -0.4, 0.4 / 0.6),
        (DVec3::Z * 0.9, 2.35 / 1.9),
        (DVec3::Z * -0.9, 0.0),
        (DVec3::X * 0.4, 1.0),
    ] {
        let text = format!("{HEAD}{}{wall}", slab(0.5, 300.0, &drawing::velocity(velocity)));
        let found = value(&text, DVec3::NEG_Z, Config::default());
        assert!((found - factor).abs() < 1e-6, "{velocity}: {found} {factor}");
    }
}

/// A wall in the glass around the eye: D = 1/(γ|1 − nβ|). Faster than light in glass it is seen
/// after it has passed the eye, what was sent last first.
#[test]
fn bodies_may_be_faster_than_light_in_glass() {
    for (beta, rest_place) in [(0.5_f64, -0.1), (-0.9, -0.3), (0.9, 0.3), (0.98, 0.3)] {
        let wall =
            square("w", DVec3::Z * rest_place, DVec3::Z, 900.0, &format!("white .5 <0 0 {beta}>"));
        let gamma = 1.0 / (1.0 - beta * beta).sqrt();
        let factor = 0.5 / (gamma * (1.0 - 1.5 * beta).abs());
        let found = value(
            &format!("{HEAD}{}{wall}", slab(0.5, 300.0, "")),
            DVec3::NEG_Z,
            Config::default(),
        );
        assert!((found / factor - 1.0).abs() < 1e-6, "{beta}: {found} {factor}");
    }
}

/// A square under parallel light from above, seen from above: its shadow lags behind it (T29).
#[test]
fn shadows_of_moving_bodies_lag() {
    let plate = square("p", DVec3::new(0.0, 0.0, -8.0), DVec3::Z, 0.1, "black <0.9 0 0>");
    let ground = square("g", DVec3::new(-25.0, 0.0, -10.0), DVec3::Z, 60.0, "white");
    let text = format!("c white 1; c black 0; l 1 0 0 1 <0 0 0>;\n{plate}{ground}");
    for (x, z, is_dark) in [
        (-16.517_932_84, -8.0, true),
        (-31.812_302_13, -10.0, true),
        // The half side is 0.1/γ; the shadow comes nearer, so it is seen 7.05 times as long.
        (-32.09, -10.0, true),
        (-32.15, -10.0, false),
        (-31.53, -10.0, true),
        (-31.47, -10.0, false),
    ] {
        let found = seen(&text, DVec3::new(x, 0.0, z)).x;
        assert_eq!(found == 0.0, is_dark, "{x}: {found}");
    }
    let without = Config {
        rays: RayOptions { shadows: false, ..RayOptions::default() },
        ..Config::default()
    };
    assert_eq!(seen_with(&text, DVec3::new(-31.812_302_13, 0.0, -10.0), without).x, 1.0);
}

/// In spectra, a black body of temperature T in a mirror is one of D T (P13).
#[test]
fn black_bodies_in_moving_mirrors_stay_black_bodies() {
    for (beta, factor) in [(0.2, 1.5), (-0.2, 1.0 / 1.5)] {
        let mirror =
            square("m", DVec3::NEG_Z * 2.0, DVec3::Z, 50.0, &format!("white mirror <0 0 {beta}>"));
        let wall = square("w", DVec3::Z, DVec3::Z, 500.0, "hot 1");
        let shift = ColorShift::spectra(true, true);
        let text = format!("{HEAD} c_bb hot 5800 0.1;{mirror}{wall}");
        let found = seen_with(&text, DVec3::NEG_Z, Config { shift, ..Config::default() });
        let expected =
            DVec3::from(xyz_to_linear_srgb(Spectrum::blackbody(5800.0, 0.1).seen(factor)));
        assert!(
            (found - expected).length() < 2e-3 * expected.length(),
            "{beta}: {found} {expected}"
        );
        let other = Spectrum::blackbody(5800.0 * factor, 1.0).seen(1.0);
        let ratio = |xyz: [f64; 3]| xyz[0] / xyz[1];
        let found = ugphysics::linear_srgb_to_xyz(found.to_array());
        assert!((ratio(found) / ratio(other) - 1.0).abs() < 1e-3);
    }
}

/// D in both mirrors of a corridor multiplies: two reflections, each with the factor of its mirror.
#[test]
fn doppler_factors_multiply_along_a_path() {
    // Light from a wall at rest goes to a mirror on the right, to one on the left, and to the eye.
    let right = square("r", DVec3::X * 2.0, DVec3::NEG_X, 100.0, "white mirror <-0.2 0 0>");
    let left = square("l", DVec3::NEG_X * 2.0, DVec3::X, 100.0, "white mirror <0.1 0 0>");
    let wall = square("w", DVec3::NEG_Z * 40.0, DVec3::Z, 900.0, "white 1");
    let toward = DVec3::new(-0.6, 0.0, -0.8);
    let rays = RayOptions { depth: 2, ..RayOptions::default() };
    // The eye looks at the left mirror. Back in time: out of it, at the right mirror, to the wall.
    let velocity = |beta: f64| Velocity::from_beta(DVec3::X * beta).unwrap();
    let backwards = |wave: WaveVector, normal: DVec3, beta: f64| {
        // Reflection is its own reverse: the light before it, from the light after it.
        let there = wave.in_frame(velocity(beta));
        let before = there.k - 2.0 * there.k.dot(normal) * normal;
        WaveVector { k: before, ..there }.in_frame(-velocity(beta))
    };
    let at_eye = WaveVector::in_vacuum(1.0, -toward);
    let between = backwards(at_eye, DVec3::X, 0.1);
    let at_wall = backwards(between, DVec3::X, -0.2);
    let found = seen_with(
        &format!("{HEAD}{right}{left}{wall}"),
        toward,
        Config { rays, ..Config::default() },
    )
    .x;
    // The second mirror is met before the wall, the first again only after more reflections.
    assert!(
        (found / srgb_decode(1.0 / at_wall.frequency) - 1.0).abs() < 1e-6,
        "{found} {at_wall:?}"
    );
}
