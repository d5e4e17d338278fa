//! Lenses: the direction seen at a place of the picture, by laws.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, its helpers too")]

use core::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::DVec3;
use ugscene::{Camera, CameraOptions, View};
use ugtrace::lens::{Film, Lens};

fn near(what: &str, got: f64, want: f64, tolerance: f64) {
    assert!((got - want).abs() <= tolerance * want.abs().max(1.0), "{what}: {got}, not {want}");
}

/// A camera at the origin that looks along +y.
fn view(samples: [u32; 2], degrees: f64) -> View {
    let options = CameraOptions {
        center: Some(DVec3::Y),
        up: Some(DVec3::Z),
        view_angle: Some((degrees, None)),
        ..CameraOptions::default()
    };
    View::without_scene(&Camera::default(), &options, samples).unwrap()
}

fn film(lens: Lens, samples: [u32; 2]) -> Film {
    Film::new(lens, None, &view(samples, 60.0), samples)
}

fn direction(film: &Film, place: [f64; 2]) -> DVec3 {
    film.sight(place).unwrap().direction.normalize()
}

/// A pinhole keeps straight lines: the tangent of the angle grows with the place on the film, to
/// that of half the view angle at its edge.
#[test]
fn a_pinhole_has_tangents() {
    let film = film(Lens::Pinhole, [80, 60]);
    for part in [-1.0, -0.5, 0.0, 0.25, 1.0] {
        let seen = direction(&film, [40.0 + 40.0 * part, 30.0]);
        near("tangent", seen.x / seen.y, part * libm::tan(PI / 6.0), 1e-14);
        near("level", seen.z, 0.0, 1e-15);
        // Pixels are square.
        let seen = direction(&film, [40.0, 30.0 - 40.0 * part * 0.75]);
        near("tangent", seen.z / seen.y, 0.75 * part * libm::tan(PI / 6.0), 1e-14);
    }
}

/// Equal steps in a panorama and along a radius of a fisheye are equal angles; the sides of a cube
/// meet.
#[test]
fn wide_lenses_have_angles() {
    let panorama = film(Lens::Panorama, [64, 32]);
    for step in 0..64 {
        let seen = direction(&panorama, [f64::from(step) + 0.5, 16.0]);
        let longitude = TAU * ((f64::from(step) + 0.5) / 64.0 - 0.5);
        near("longitude", libm::atan2(seen.x, seen.y), longitude, 1e-14);
        let seen = direction(&panorama, [20.0, f64::from(step) / 2.0]);
        near("latitude", libm::asin(seen.z), PI * (0.5 - f64::from(step) / 64.0), 1e-14);
    }
    // A dome of half the sphere: its rim is at a right angle, and nothing is seen beyond.
    let dome = film(Lens::Fisheye { angle: PI }, [50, 40]);
    for part in [0.0, 0.3, 0.5, 1.0] {
        let (sin, cos) = libm::sincos(2.0);
        let seen = direction(&dome, [25.0 + 20.0 * part * cos, 20.0 - 20.0 * part * sin]);
        near("angle", seen.angle_between(DVec3::Y), part * FRAC_PI_2, 1e-9);
    }
    assert!(dome.sight([25.0 + 20.1, 20.0]).is_none());
    let cube = film(Lens::Cube, [10, 10]);
    let side = |side: f64, x: f64, y: f64| direction(&cube, [10.0 * side + x, y]);
    for (side_idx, middle) in
        [DVec3::X, DVec3::NEG_X, DVec3::Z, DVec3::NEG_Z, DVec3::Y, DVec3::NEG_Y].iter().enumerate()
    {
        assert!((side(side_idx as f64, 5.0, 5.0) - *middle).length() < 1e-15);
    }
    // The right edge of the front is the left edge of the right side.
    for y in [0.5, 5.0, 9.5] {
        let (front, right) = (side(4.0, 10.0 - 1e-9, y), side(0.0, 0.0, y));
        assert!((front - right).length() < 1e-8, "{front} {right}");
    }
}
