//! Round faces: what rays meet is where geometry has it, at any speed, and polygons agree with it.

use glam::DVec3;
use ugphysics::{Event, Lorentz, Velocity};
use ugscene::MotionOptions;
use ugtesting::Random;
use ugtests::worlds::picture::{Picture, Renderer, UNSHIFTED};

const SIZE: [u32; 2] = [320, 240];

/// The eye, the view centre, and half the width of the picture at distance 1.
const EYE: DVec3 = DVec3::new(0.5, -7.0, 1.5);
const CENTER: DVec3 = DVec3::new(0.2, 0.0, 0.4);
const HALF: f64 = 0.45;

fn camera() -> String {
    let angle = 2.0 * libm::atan(HALF).to_degrees();
    format!(
        "cam -ep {} {} {} -vc {} {} {} -ud 0 0 1 -va {angle};",
        EYE.x, EYE.y, EYE.z, CENTER.x, CENTER.y, CENTER.z
    )
}

/// The direction of a pixel, not normalised.
fn direction(at: usize) -> DVec3 {
    let [width, height] = SIZE.map(f64::from);
    let (column, row) = (at % SIZE[0] as usize, at / SIZE[0] as usize);
    let forward = (CENTER - EYE).normalize();
    let right = forward.cross(DVec3::Z).normalize();
    let x = (2.0 * (column as f64 + 0.5) / width - 1.0) * HALF;
    let y = (height - 2.0 * (row as f64 + 0.5)) / width * HALF;
    forward + x * right + y * right.cross(forward)
}

/// Where the eye is, and a direction, in the rest frame of a body with its reference point at the
/// origin.
fn at_rest(beta: DVec3, direction: DVec3) -> (DVec3, DVec3) {
    let to_rest = Lorentz::boost(Velocity::from_beta(beta).unwrap()).inverse();
    let ray = to_rest.apply(Event { t: -direction.length(), x: direction });
    (to_rest.apply(Event { t: 0.0, x: EYE }).x, ray.x.normalize())
}

fn light(text: &str, renderer: Renderer) -> Vec<[f32; 3]> {
    let picture = Picture::of_scene(text.to_owned() + &camera(), UNSHIFTED).by(renderer);
    let picture = Picture { size: SIZE, ..picture };
    picture.draw().unwrap_or_else(|error| panic!("{error}")).light()
}

/// Fails unless pixels are light where `expected` says so; `None` where rounding may decide.
#[track_caller]
fn check(light: &[[f32; 3]], what: &str, expected: impl Fn(DVec3) -> Option<bool>) -> usize {
    let mut n_light = 0;
    for (at, light) in light.iter().enumerate() {
        if let Some(expected) = expected(direction(at)) {
            assert_eq!(light[0] > 0.25, expected, "{what}: pixel {at}, {light:?}");
            n_light += usize::from(expected);
        }
    }
    n_light
}

/// Penrose (1959): the outline of a sphere is a circle for every observer. A ray (−|d|, d) meets it
/// if its product with the image of (−cos α, c) is not negative, where in the rest frame c is the
/// direction of the centre and α the angle of the radius.
#[test]
fn a_sphere_is_seen_as_a_circle_at_any_speed() {
    let mut random = Random(11);
    for (beta, radius) in
        [(0.0, 0.8), (0.3, 1.0), (0.8, 0.9), (0.95, 1.2), (0.99, 1.0), (0.999, 1.3), (0.9, 0.2)]
    {
        let velocity = beta * random.direction();
        let frame = Lorentz::boost(Velocity::from_beta(velocity).unwrap());
        // The middle of the picture is a place on it at rest.
        let (eye, toward) = at_rest(velocity, CENTER - EYE);
        let center = eye + toward * random.between(5.0, 9.0) + random.in_cube(0.3);
        let distance = (center - eye).length();
        let sin = radius / distance;
        let cos = (1.0 - sin * sin).sqrt();
        let circle = frame.apply(Event { t: -cos, x: (center - eye) / distance });
        let (axis, around) = (circle.x.normalize(), libm::acos(-circle.t / circle.x.length()));
        let [x, y, z] = center.to_array();
        let [vx, vy, vz] = velocity.to_array();
        let text = format!("c white 1; sphere {x} {y} {z} {radius} white 1 <{vx} {vy} {vz}>;");
        // A twentieth of a pixel.
        let margin = 0.05 * 2.0 * HALF / f64::from(SIZE[0]);
        for renderer in [Renderer::Rays, Renderer::Exact] {
            let what = format!("{renderer:?} at {velocity}, radius {radius}");
            let n = check(&light(&text, renderer), &what, |direction| {
                let beside = axis.angle_between(direction) - around;
                // Pixels are smaller angles off the middle of the picture.
                (beside.abs() > margin).then_some(beside < 0.0)
            });
            assert!(n > 50, "{what}: {n} pixels");
        }
    }
}

/// A disc with a hole is where its plane is farther from the centre than one radius and nearer than
/// the other; and with the disc in the hole it is the disc without.
#[test]
fn a_ring_is_a_disc_minus_a_disc() {
    let mut random = Random(52);
    let plane = "l 0; c white 1; ";
    for (beta, inner) in [(0.0, 0.5), (0.5, 0.9), (0.9, 0.3), (0.99, 0.05), (0.8, 0.999)] {
        let velocity = beta * random.direction();
        let (eye, toward) = at_rest(velocity, CENTER - EYE);
        let center = eye + toward * random.between(4.0, 6.0);
        let normal = (random.in_cube(0.5) - toward).normalize();
        let radius = random.between(1.0, 1.5);
        let disc = |options: &str, radius: f64| {
            let numbers = [center, normal].map(|v| format!("{} {} {}", v.x, v.y, v.z)).join(" ");
            let [vx, vy, vz] = velocity.to_array();
            format!("{plane} disc {numbers} {radius} {options} white 1 <{vx} {vy} {vz}>;")
        };
        for renderer in [Renderer::Rays, Renderer::Exact] {
            let what = format!("{renderer:?} at {velocity}, part {inner}");
            let ring = light(&disc(&format!("-inner {}", inner * radius), radius), renderer);
            check(&ring, &what, |direction| {
                let (from, toward) = at_rest(velocity, direction);
                let t = (center - from).dot(normal) / toward.dot(normal);
                let part = (from + t * toward).distance(center) / radius;
                let is_near = (part - 1.0).abs().min((part - inner).abs()) < 1e-9;
                (!is_near).then_some(t > 0.0 && inner < part && part < 1.0)
            });
            let [whole, hole] = [radius, inner * radius].map(|r| light(&disc("", r), renderer));
            let n_whole = whole.iter().filter(|light| light[0] > 0.25).count();
            assert!(n_whole > 50, "{what}: {n_whole} pixels");
            for (at, ((ring, hole), whole)) in ring.iter().zip(&hole).zip(&whole).enumerate() {
                let sum = ring[0] + hole[0];
                assert!((sum - whole[0]).abs() < 1e-6, "{what}: pixel {at}: {sum}, {whole:?}");
            }
        }
    }
}

/// Where a ray meets a sphere first.
fn meets(center: DVec3, radius: f64, (from, toward): (DVec3, DVec3)) -> Option<DVec3> {
    let along = (center - from).dot(toward);
    let beside = (from + along * toward - center).length_squared();
    let t = along - (radius * radius - beside).sqrt();
    (t > 0.0).then_some(from + t * toward)
}

const BALL: DVec3 = DVec3::new(0.0, 0.3, 0.5);
const RADIUS: f64 = 1.1;

/// A lit floor far below a sphere of this surface; the rest is black.
fn on_floor(surface: &str, beta: DVec3) -> String {
    let [vx, vy, vz] = beta.to_array();
    format!(
        "l 0; c white 1; surf s {surface}; sphere 0 .3 .5 {RADIUS} white s <{vx} {vy} {vz}>;
         disc 0 0 -50 0 0 1 1e5 white 1 <{vx} {vy} {vz}>;"
    )
}

/// If what arrives in a direction comes from the floor, up to rounding near its horizon.
fn is_floor((_, toward): (DVec3, DVec3)) -> Option<bool> {
    (toward.z.abs() > 2e-3).then_some(toward.z < 0.0)
}

#[test]
fn a_mirror_ball_shows_what_the_law_of_reflection_says() {
    for beta in [DVec3::ZERO, DVec3::new(0.0, 0.3, 0.1), DVec3::new(-0.02, -0.9, 0.0)] {
        let light = light(&on_floor("0 1 0", beta), Renderer::Rays);
        let n = check(&light, "mirror", |direction| {
            let ray = at_rest(beta, direction);
            let Some(place) = meets(BALL, RADIUS, ray) else { return is_floor(ray) };
            let normal = (place - BALL) / RADIUS;
            is_floor((place, ray.1 - 2.0 * ray.1.dot(normal) * normal))
        });
        assert!(n > 1000, "{n} pixels at {beta}");
    }
}

#[test]
fn a_glass_ball_refracts_as_snell_says() {
    /// Index of refraction.
    const N: f64 = 1.4;
    let refracted = |toward: DVec3, normal: DVec3, ratio: f64| {
        let cos = -toward.dot(normal);
        let sin_squared = ratio * ratio * (1.0 - cos * cos);
        ratio * toward + (ratio * cos - (1.0 - sin_squared).sqrt()) * normal
    };
    for beta in [DVec3::ZERO, DVec3::new(0.3, -0.5, 0.1)] {
        let light = light(&on_floor("0 0 1 1.4", beta), Renderer::Rays);
        let n = check(&light, &format!("glass at {beta}"), |direction| {
            let ray = at_rest(beta, direction);
            let Some(enters) = meets(BALL, RADIUS, ray) else { return is_floor(ray) };
            let normal = (enters - BALL) / RADIUS;
            let cos = -ray.1.dot(normal);
            let inside = refracted(ray.1, normal, 1.0 / N);
            let leaves = enters - 2.0 * RADIUS * inside.dot(normal) * inside;
            let outside = refracted(inside, (BALL - leaves) / RADIUS, N);
            // Fresnel's equations leave little at grazing incidence.
            if cos < 0.3 { None } else { is_floor((leaves, outside)) }
        });
        assert!(n > 1000, "{n} pixels at {beta}");
    }
}

/// The shadow of a sphere under the zenith is a disc; that of a tube is open in the middle.
#[test]
fn shadows_are_those_of_round_faces() {
    let text = "c white 1; disc 0 0 0 0 0 1 1e4 white; l 1 0 0 1;
                sphere -2 3 3 .7 white; tube 1.5 0 3 1.5 0 4 .8 white; cylinder 0 -1 3 0 -1 5 .5 white;";
    let light = light(text, Renderer::Rays);
    let n = check(&light, "floor", |direction| {
        let toward = direction.normalize();
        let place = EYE - toward * (EYE.z / toward.z);
        // What is before the floor is not this test's.
        if toward.z > -1e-3 || place.length() > 30.0 || direction.z > -0.05 {
            return None;
        }
        let from = |x: f64, y: f64| DVec3::new(place.x - x, place.y - y, 0.0).length();
        let [sphere, tube, cylinder] =
            [from(-2.0, 3.0) - 0.7, from(1.5, 0.0) - 0.8, from(0.0, -1.0) - 0.5];
        if tube.abs() < 1e-3 {
            return None;
        }
        (sphere.abs().min(cylinder.abs()) > 1e-6).then_some(sphere > 0.0 && cylinder > 0.0)
    });
    assert!(n > 5000, "{n} pixels");
}

/// Shapes in instances that turn, stretch and mirror them, in motion.
#[test]
fn polygons_agree_with_exact_shapes() {
    let shapes =
        "def d; sphere -1.5 0 0 .7 red; cylinder 0 -1 -.5 0 -.4 1.2 .4 blue; tube .8 0 0 1.6 .5 .5 .4 green;
                  disc 0 .5 -1 .2 .1 1 1.2 red; disc .2 1.1 .4 .4 -1 .3 .9 -inner .5 blue; end;";
    for (place, velocity) in [
        ("-ry 20", "0 0 0"),
        ("-mx -sz 1.4 -rx 35", ".6 .3 0"),
        ("-sx .7 -rz 50 -tz .3", "0 -.8 .1"),
        ("-my -ty 1", ".9 .3 .1"),
    ] {
        let text = format!(
            "c red .9 0 .8; c blue .8 240 .7; c green .7 120 .6; {shapes} i (d {place}) <{velocity}>; l .3; l .7 1 -2 2;"
        );
        let drawn = |renderer| {
            let picture =
                Picture::of_scene(text.clone() + &camera(), UNSHIFTED).like_pipe().by(renderer);
            let motion = MotionOptions { in_place: true, ..MotionOptions::default() };
            Picture { size: SIZE, samples: 4, motion, ..picture }
                .draw()
                .unwrap_or_else(|error| panic!("{error}"))
                .light()
        };
        let rays = drawn(Renderer::Rays);
        let is_drawn = rays.iter().filter(|light| light.iter().any(|&light| light > 0.0)).count();
        assert!(is_drawn > 300, "{place}: {is_drawn}");
        for (renderer, least) in [(Renderer::Exact, 60.0), (Renderer::Pipe, 45.0)] {
            let pairs = rays.iter().zip(drawn(renderer));
            let differences =
                pairs.flat_map(|(a, b)| (0..3).map(move |at| f64::from(a[at] - b[at])));
            let mean = differences.map(|difference| difference * difference).sum::<f64>()
                / (3 * rays.len()) as f64;
            let decibels = -10.0 * libm::log10(mean);
            assert!(decibels > least, "{renderer:?}, {place}, {velocity}: {decibels:.1} dB");
        }
    }
}
