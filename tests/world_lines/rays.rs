//! Pictures by rays.

use ugimage::Samples;
use ugphoton::Channel;
use ugscene::Anchor;

use super::{DVec3, options, seen};

/// A year on board with 1 g, in years: 9.80665 m/s² times 31 557 600 s, divided by c.
const G: f64 = 9.80665 * 31_557_600.0 / 299_792_458.0;

/// T30: from a ship with 1 g, a wall ahead shows its speed by the Doppler factor, and where it is
/// by the distance at which the wall is seen. A second wall, which moves, shows when it is there.
/// Then by rays, as far as single precision tells.
#[test]
fn pictures_from_a_ship_with_1_g_are_those_of_its_speed_place_and_time() {
    const AHEAD: f64 = 100.0;
    const SPEED: f64 = 0.2;
    // Own time, speed or γ, time and place in years and light years; NaN where no digits are known.
    for (own_time, speed, gamma, time, place) in [
        (1.0, 0.7748272626, 1.581845454, 1.187312402, 0.5636424651),
        (2.0, 0.9683178487, 4.004470079, 3.75628945, 2.910475472),
        (5.0, f64::NAN, 87.21375564, f64::NAN, 83.51656515),
    ] {
        let speed: f64 =
            if speed.is_nan() { (1.0_f64 - 1.0 / (gamma * gamma)).sqrt() } else { speed };
        let doppler = gamma * (1.0 + speed);
        // The event (−r, r) of the scene relative to the eye is D times as far for the eye.
        let rests = (AHEAD - place, doppler);
        // Its place x₀ + v(t − r) is r ahead of the ship.
        let moves = ((AHEAD + SPEED * time - place) / (1.0 + SPEED), {
            doppler * ((1.0 - SPEED) / (1.0 + SPEED)).sqrt()
        });
        for ((distance, doppler), velocity) in [(rests, 0.0), (moves, SPEED)] {
            if distance.is_nan() {
                continue;
            }
            let distance = distance * gamma * (1.0 + speed);
            let x = AHEAD
                * if velocity == 0.0 { 1.0 } else { (1.0_f64 - SPEED * SPEED).sqrt().recip() };
            let text = format!(
                "motion ship -acc {G} 0 0; cam -ep 0 0 0 -vc 9 0 0 -ud 0 0 1 -va 5 <ship>; l 1;
                v a {x} 0 0; v b {x} -9 -9; v c {x} 9 -9; v d {x} 0 9; f (b c d) <{velocity} 0 0>;
                w (a b) <{velocity} 0 0>;"
            );
            let config = options(DVec3::ZERO, own_time);
            let scene = seen(&text, &config);
            let at = scene.vertices[0].position;
            assert!(
                (at - distance * DVec3::X).length() < 1e-9 * distance,
                "{own_time}: {at} {distance}"
            );
            let found = ugscene::measure(&scene, DVec3::ZERO, own_time)[0].doppler;
            assert!((found - doppler).abs() < 1e-9 * doppler, "{own_time}: {found} {doppler}");

            let mut config = ugphoton::Config::default();
            (config.motion.time, config.motion.anchor) = (own_time, Some(Anchor::Origin));
            (config.picture.size, config.picture.samples) = ([1, 1], 1);
            config.picture.channels = vec![Channel::Doppler, Channel::Distance];
            config.picture.output = ugphoton::Output::Color(ugimage::Format::Exr);
            let frame = ugphoton::light(ugtests::scenes::parse(text.as_bytes()), &config)
                .expect("a picture");
            let found = frame.planes().iter().map(|plane| match &plane.samples {
                Samples::Float(numbers) => numbers[0],
                Samples::Whole(_) => panic!("a real number"),
            });
            for (found, expected) in found.zip([doppler, distance]) {
                assert!(
                    (f64::from(found) / expected - 1.0).abs() < 1.5e-7,
                    "{own_time}: {found} {expected}"
                );
            }
        }
    }
}

/// Both renderers explain a pixel of a body that accelerates and spins alike.
#[test]
fn the_pipe_and_rays_explain_one_event() {
    let text =
        "motion m -acc .2 .1 0 -9 9 -spin 0 .1 .2; v a -1 0 -1; v b 1 0 -1; v c 1 0 1; v d -1 0 1;
        f (a b c d) <m>; cam -ep 0 -6 0 -vc 0 0 0 -ud 0 0 1 -va 40;";
    let (size, pixel, time) = ([32, 24], [14, 13], 5.0);
    let mut rays = ugphoton::Config::default();
    (rays.motion.time, rays.motion.anchor) = (time, Some(Anchor::Origin));
    (rays.picture.size, rays.picture.samples) = (size, 1);
    let source = ugparse::Source::new("rays.ug", text);
    let (rays, _) = ugphoton::explain(&rays, &source, pixel).expect("an explanation");
    let rays = &rays.sample.expect("the body").own.surfaces[0].surface;

    let config = uglorentz::Config {
        pieces: uglorentz::Pieces::UpTo(1e-5),
        ..options(DVec3::new(0.0, -6.0, 0.0), time)
    };
    let text = ugtests::pipe::lorentz(text.as_bytes(), &config);
    let mut pipe = ugrainbow::Config::default();
    (pipe.picture.size, pipe.picture.samples) = (size, 1);
    let (pipe, _) =
        ugrainbow::explain::explain(&pipe, &ugparse::Source::new("pipe.ug", text), pixel)
            .expect("one");
    let pipe = pipe.sample.expect("the body").own.surface;

    let times =
        [pipe.own_time, rays.own_time].map(|own_time| own_time.expect("it is not inertial"));
    assert!((times[0] - times[1]).abs() < 1e-3 && times[0].abs() > 0.1, "{times:?}");
    let [seen, rest] =
        [[pipe.emission, rays.emission], [pipe.emission_at_rest, rays.emission_at_rest]].map(
            |events| {
                events.map(|event| DVec3::from_array(event.x).extend(event.t.expect("a time")))
            },
        );
    assert!((seen[0] - seen[1]).truncate().length() < 1e-3 && pipe.gamma > 1.05, "{seen:?}");
    assert!((rest[0] - rest[1]).abs().max_element() < 1e-3 && rest[1].x.abs() > 0.5, "{rest:?}");
    // An event on the light cone is so in every frame.
    assert!((rest[1].w + rest[1].truncate().length()).abs() < 1e-9, "{rest:?}");
}
