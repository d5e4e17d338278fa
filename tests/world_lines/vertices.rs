//! Seen positions, velocities and Doppler factors of vertices.

use glam::DVec3;
use ugtesting::Random;
use ugtests::pipe;
use ugtests::scenes::parse;
use ugtests::world_lines::{Observer, Statement};

use super::{World, observer, options, seen};

/// Compares every vertex with the oracle. Returns the largest difference.
#[track_caller]
fn check(world: &World, extra: &str, config: &uglorentz::Config, eye: &Observer) -> f64 {
    let scene = seen(&(world.text() + extra), config);
    // Programs downstream have what the text says.
    let scene = parse(&ugparse::write(&scene));
    let origin = config.eye.unwrap();
    let rows = ugscene::measure(&scene, origin, config.time);
    let bodies = world.bodies();
    let mut largest = 0.0_f64;
    let mut n_found = 0;
    for (vertex, row) in scene.vertices.iter().zip(rows) {
        let name = scene.names.get(vertex.name);
        let Some((triangle, corner)) = name.strip_prefix('p').and_then(|name| name.split_once('_'))
        else {
            continue;
        };
        let triangle = world.triangles[triangle.parse::<usize>().unwrap()];
        let point = triangle.corners[corner.parse::<usize>().unwrap()];
        let expected = eye.sight(&bodies[triangle.body], point);
        let scale = 1.0 + expected.seen.length();
        let place = (vertex.position - origin - expected.seen).length() / scale;
        let doppler = (row.doppler / expected.doppler - 1.0).abs();
        let velocity = eye.components(expected.moment.velocity)
            / (1.0 + eye.components(expected.moment.velocity).length_squared()).sqrt();
        let velocity = (velocity - row.velocity).length();
        let worst = place.max(doppler).max(velocity);
        assert!(
            worst < 1e-9,
            "{name}: {place:e} {doppler:e} {velocity:e} {expected:?} {row:?}\n{}{extra}",
            world.text()
        );
        largest = largest.max(worst);
        n_found += 1;
    }
    assert_eq!(n_found, 3 * world.triangles.len());
    largest
}

/// Bodies of all kinds, and parts of them, seen by a camera that moves.
#[test]
fn vertices_are_seen_where_integration_says() {
    let mut random = Random(1);
    let mut largest = 0.0_f64;
    for _ in 0..12 {
        let mut world = World::default();
        for _ in 0..2 {
            let middle = random.in_ball(4.0);
            let motion = Statement::random(&mut random, middle, 0.8);
            world.add(&mut random, motion, middle, 2);
            let carrier = world.motions.len() - 1;
            let part = Statement::random_part(&mut random, carrier, middle);
            world.add(&mut random, part, middle, 1);
        }
        let eye = random.in_ball(9.0);
        let config = uglorentz::Config {
            camera_velocity: Some(random.in_ball(0.9)),
            ..options(eye, random.between(-5.0, 5.0))
        };
        let eye = observer(eye, config.camera_velocity.unwrap(), config.time);
        largest = largest.max(check(&world, "", &config, &eye));
    }
    println!("vertices: {largest:e}");
}

/// A camera at any place of a body of any kind.
#[test]
fn cameras_ride_on_bodies() {
    let mut random = Random(2);
    let mut largest = 0.0_f64;
    for case in 0..12 {
        let mut world = World::default();
        let eye = random.in_ball(4.0);
        let carrier = Statement::random(&mut random, eye, 0.8);
        world.add(&mut random, carrier, eye, 0);
        let part = Statement::random_part(&mut random, 0, eye);
        world.add(&mut random, part, eye, 0);
        let middle = random.in_ball(4.0);
        let motion = Statement::random(&mut random, middle, 0.8);
        world.add(&mut random, motion, middle, 2);
        let velocity = random.in_ball(0.8);
        world.add(&mut random, Statement::inertial(velocity), middle, 1);
        let config = options(eye, random.between(-4.0, 4.0));
        let cam = format!("cam -vc 0 0 0 <m{}>;", case % 2);
        let on = Observer::on(&world.bodies()[case % 2], eye, config.time);
        largest = largest.max(check(&world, &cam, &config, &on));
    }
    println!("cameras: {largest:e}");
}

/// Numbers computed with 40 digits: motion, point, event of the eye, seen position, velocity, D.
type Number = (&'static str, [f64; 3], [f64; 4], [f64; 3], [f64; 3], f64);

#[rustfmt::skip] // rows of a table
const NUMBERS: [Number; 9] = [
    ("-acc .5 0 0 0 4", [0., 1., 0.], [3., 0., 0., 0.],
        [0.683281573, 1., 0.], [0.66666666667, 0., 0.], 0.5416407865),
    ("-acc .5 0 0 0 4", [0., 1., 0.], [8., 0., 0., 0.],
        [3.1251237606, 1., 0.], [0.92071551061, 0., 0.], 0.207912717125),
    ("-acc .5 0 0 0 4", [1., 1., 0.5], [40., 0., 0., 0.],
        [19.00524971, 1., 0.5], [0.96402758008, 0., 0.], 0.135450026816),
    ("-at 1 0 0 -vel 0 .6 0 -acc .5 0 0 -2 3", [1.5, 0.25, 0.], [6., 0., -3., 1.],
        [1.7015406705, 4.0804069747, -1.], [0.30319764641, 0.6, 0.], 0.447605168564),
    ("-vel .8 0 0 -spin 0 1.33333333333333333 0", [0., 0., 0.54], [0., 0., -4., 0.5],
        [-4.655482048, 4., -0.17054648282], [0.9170161973, 0., -0.2532781712], 0.988288108042),
    ("-vel .8 0 0 -spin 0 1.33333333333333333 0", [0.5, 0., -0.3], [2., 0., -4., 0.5],
        [-1.9120985359, 4., 0.08011976081], [0.97201534871, 0., -0.029073883795], 0.40168721013),
    ("-at 3 0 0 -orbit 0 0 0 0 0 1 .2", [3.5, 0., 0.1], [7., 0., -8., 1.],
        [3.4154152082, 7.3268269037, -0.9], [0.14831633107, 0.58137962291, 0.], 0.504418784358),
    ("-at 3 0 0 -orbit 0 0 0 0 0 1 .3", [3., 0.4, 0.], [-25., 10., 0., 2.],
        [-10.598130244, 2.947707225, -2.], [-0.8959742816, 0.085029916619, 0.], 0.232884164834),
    ("-spin 0 0 .25", [3., 0., 0.], [10., 0., -8., 1.],
        [2.9346142877, 8.6229277507, -1.], [-0.15573193768, 0.73365357192, 0.], 0.403189933584),
];

/// Half a unit of the last of `digits` significant digits, at 12 of them, and what the table
/// rounds.
fn is_near(found: f64, expected: f64) -> bool {
    (found - expected).abs() <= 6e-10_f64.max(6e-11 * expected.abs())
}

#[test]
fn numbers_of_high_precision_are_reproduced() {
    for (row, (motion, point, [t, x, y, z], place, velocity, doppler)) in
        NUMBERS.into_iter().enumerate()
    {
        let [px, py, pz] = point;
        let text = format!(
            "motion m {motion}; v a {px} {py} {pz}; v b {px} {py} {}; w (a b) <m>;",
            pz + 0.01
        );
        let eye = DVec3::new(x, y, z);
        let config = options(eye, t);
        let text = pipe::lorentz(text.as_bytes(), &config);
        let scene = parse(&text);
        let row_a = &ugscene::measure(&scene, eye, t)[0];
        let seen = scene.vertices[0].position - eye;
        for k in 0..3 {
            assert!(is_near(seen[k], place[k]), "W{}: seen at {seen:?}, not {place:?}", row + 1);
            let found = row_a.velocity;
            assert!(
                is_near(found[k], velocity[k]),
                "W{}: velocity {found:?}, not {velocity:?}",
                row + 1
            );
        }
        assert!(is_near(row_a.doppler, doppler), "W{}: {} {doppler}", row + 1, row_a.doppler);
    }
}

/// The same for a camera with constant acceleration: time, place of a point at rest, D.
#[test]
fn numbers_of_an_accelerated_camera_are_reproduced() {
    let text = "motion ship -acc 0 .2 0 0 10; cam -ep 0 0 0 -vc 0 9 0 <ship>; v a 1 30 2; v b 1 30 3; w (a b);";
    for (time, place, doppler) in [
        (2.0, [1.0, 44.1846609207, 2.0], 1.4906572448),
        (10.0, [1.0, 120.17902252, 2.0], 7.35494707534),
    ] {
        let config = options(DVec3::ZERO, time);
        let scene = parse(&pipe::lorentz(text.as_bytes(), &config));
        let seen = scene.vertices[0].position;
        let found = ugscene::measure(&scene, DVec3::ZERO, time)[0].doppler;
        assert!((0..3).all(|k| is_near(seen[k], place[k])), "{time}: {seen:?} {place:?}");
        assert!(is_near(found, doppler), "{time}: {found} {doppler}");
    }
}
