//! What is the same in every frame: T36 of the conformance suite, by rendered rays.

use glam::DVec3;
use ugphysics::Brightness;
use ugtesting::Random;

use crate::laws::drawing::{Chart, HEAD, boost, by_law, distance, square, surroundings, value, velocity};

/// The light left a body at an event on the past light cone of the eye, in all frames: the place in
/// the rest frame that is seen, by its colour, is that of the event in the direction of the pixel
/// at the distance of channel `distance`. There the distance is r' = r/D, with D from the
/// brightness (T26).
#[test]
fn emission_events_are_on_the_light_cone() {
    let mut n_seen = 0;
    for seed in 0..40 {
        let mut random = Random(100 + seed);
        let center = random.between(1.0, 6.0) * random.direction();
        let normal = (random.direction() - 1.5 * center.normalize()).normalize();
        let (u, v) = normal.any_orthonormal_pair();
        let chart = Chart { center, axes: [2.0 * u, 2.0 * v], velocity: random.in_ball(0.99) };
        // A direction in which it is seen: that of a point of it, by the boost of its event.
        let inside = center + random.between(-1.0, 1.0) * u + random.between(-1.0, 1.0) * v;
        let toward = (boost(chart.velocity) * inside.extend(-inside.length())).truncate();
        let Some(place) = chart.place("", toward) else { panic!("{seed}: nothing is seen") };
        let plain = format!(
            "{HEAD}{}",
            square("s", center, normal, 50.0, &format!("white 1 {}", velocity(chart.velocity)))
        );
        let r = distance(&plain, toward);
        let event = boost(-chart.velocity) * (r * toward.normalize()).extend(-r);
        let tolerance = 1e-5 * (1.0 + place.length());
        assert!((event.truncate() - place).length() < tolerance, "{seed}: {event} {place}");
        assert!((event.w + place.length()).abs() < tolerance, "{seed}: {event} {place}");
        let doppler = value(&plain, toward, by_law(Brightness::Report));
        assert!((place.length() * doppler / r - 1.0).abs() < 1e-5, "{seed}: {doppler}");
        n_seen += 1;
    }
    assert_eq!(n_seen, 40);
}

/// In front is what emitted its light last in the frame of the eye, whatever the distances in the
/// frames of the bodies (P22): a receding body from 24 is seen at 8, an approaching one from 5 at
/// 15.
#[test]
fn what_emitted_last_is_in_front() {
    let wall = |name: &str, rest: f64, level: f64, beta: f64| {
        square(name, rest * DVec3::NEG_Z, DVec3::Z, 100.0, &format!("white {level} <0 0 {beta}>"))
    };
    let (still, receding) = (wall("s", 10.0, 0.3, 0.0), wall("r", 24.0, 0.6, -0.8));
    let approaching = wall("a", 5.0, 0.9, 0.8);
    let mirror = square("m", DVec3::Z, DVec3::NEG_Z, 100.0, "white mirror");
    for (walls, expected) in [
        (format!("{still}{receding}"), 0.6),
        (format!("{receding}{still}"), 0.6),
        (format!("{still}{approaching}"), 0.3),
        (format!("{approaching}{still}"), 0.3),
        (format!("{approaching}{receding}"), 0.6),
    ] {
        for (others, toward) in [("", DVec3::NEG_Z), (mirror.as_str(), DVec3::Z)] {
            let found = value(&format!("{HEAD}{others}{walls}"), toward, by_law(Brightness::None));
            assert!((found - expected).abs() < 1e-6, "{found} {expected}");
        }
    }
}

/// A periscope, two parallel mirrors, leaves direction and frequency of light as they are: D of the
/// way into its frame and D of the way out of it cancel.
#[test]
fn doppler_factors_in_and_out_cancel() {
    for seed in 0..12 {
        let mut random = Random(300 + seed);
        let (toward, motion) = (random.direction(), random.in_ball(0.95));
        // The way of the ray in the frame of the periscope.
        let first = (boost(-motion) * toward.extend(-1.0)).truncate().normalize();
        let aside = (first.any_orthonormal_vector() + 0.7 * random.direction()).normalize();
        let normal = (aside - first).normalize();
        let mirror = |name: &str, place: DVec3, normal: DVec3| {
            square(name, place, normal, 0.5, &format!("white mirror {}", velocity(motion)))
        };
        let [near, far] =
            [mirror("near", 4.0 * first, normal), mirror("far", 4.0 * (first + aside), -normal)];
        let sky = surroundings("s", 1e4, "white 1");
        let found = value(&format!("{HEAD}{near}{far}{sky}"), toward, by_law(Brightness::Report));
        assert!((found - 1.0).abs() < 1e-5, "{seed}: {found}");
        let turned = value(&format!("{HEAD}{near}{sky}"), toward, by_law(Brightness::Report));
        assert!((turned - 1.0).abs() > 1e-3 || motion.length() < 0.1, "{seed}: {turned}");
    }
}
