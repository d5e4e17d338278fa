//! What rays meet against testing every part of a scene.

mod world_lines;

use std::fmt::Write;
use std::ops::{ControlFlow, Range};

use glam::DVec3;
use uglight::Appearance;
use ugphoton::{Anchor, CameraOptions, ColorShift, Interpolation, MotionOptions, PictureOptions};
use ugphysics::{Event, Medium, Velocity, WaveVector};
use ugscene::{PlacedBodies, Scene, ShownPoint, View};
use ugtesting::Random;
use ugtrace::rays::{
    Corridor, Faces, Intersection, MovingBox, MovingBoxes, PacketMemory, PastRay, Rays, Start,
    World, along,
};

/// Tetrahedra in random places, each with a velocity of its own.
fn scene(random: &mut Random, n: usize, fastest: f64) -> String {
    let mut text = String::from("l 1; cam -ep 0 0 0 -vc 0 0 -1 -ud 0 1 0;\n");
    for body in 0..n {
        let center = random.in_cube(12.0);
        let size = *random.pick(&[1.0, 3.0, 6.0]);
        for corner in 0..4 {
            let DVec3 { x, y, z } = center + random.in_ball(size);
            let _ = write!(text, "v v{body}_{corner} {x} {y} {z};");
        }
        let DVec3 { x, y, z } = random.direction() * fastest * libm::sqrt(random.unit());
        for [a, b, c] in [[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]] {
            let _ = writeln!(text, "f (v{body}_{a} v{body}_{b} v{body}_{c}) <{x} {y} {z}>;");
        }
    }
    text
}

/// A scene as rays meet it.
struct Scenery {
    scene: Scene,
    eye: DVec3,
    appearance: Appearance,
    world: World,
}

impl Scenery {
    /// The scene at a time. Spheres are cut into polygons, within `sagitta` of the radius.
    fn new(text: &str, time: f64, sagitta: f64) -> Self {
        let source = ugparse::Source::new("test.ug", text);
        let mut scene = ugparse::parse(&source, &ugparse::Options::default()).unwrap().scene;
        ugscene::cut_rounds(&mut scene, |_, _, _| Some(sagitta)).unwrap();
        ugscene::repeat_vertices(&mut scene, false);
        let motion =
            MotionOptions { anchor: Some(Anchor::Origin), time, ..MotionOptions::default() };
        let (camera, size) = (CameraOptions::default(), PictureOptions::default().size);
        let placed =
            PlacedBodies::move_to_camera_frame(&mut scene, &motion, &camera, size).unwrap();
        let seen = |(rest, &body): (DVec3, &ugscene::BodyId)| {
            let (seen, own_time) = placed.motions[body.index()].light(rest).unwrap();
            ShownPoint { body, rest, seen, own_time }
        };
        let points: Vec<_> =
            placed.rest_positions(&scene).into_iter().zip(&placed.bodies).map(seen).collect();
        assert_eq!(placed.show(&mut scene, &points, points.len()), None);
        let eye = View::new(&scene, &camera, size).unwrap().eye;
        let appearance =
            Appearance::new(&scene, eye, Interpolation::Hue, ColorShift::default(), 1.0);
        let (frames, rest) = (appearance.surface.frames(), appearance.surface.all_rest());
        let planes = ugscene::shared_planes(&scene, rest, frames);
        let world = World::new(Faces { scene: &scene, rest }, frames, planes, |_| true);
        Self { scene, eye, appearance, world }
    }

    fn faces(&self) -> Faces<'_> {
        Faces { scene: &self.scene, rest: self.appearance.surface.all_rest() }
    }
}

/// A scene, and the same scene without its hierarchy of bounding volumes.
fn scenery(text: &str) -> [Scenery; 2] {
    let [whole, mut plain] = [(); 2].map(|()| Scenery::new(text, 0.0, 0.1));
    plain.world.boxes = None;
    [whole, plain]
}

/// The result of a search, with all digits.
fn digits(found: &Intersection) -> String {
    format!("{found:?}")
}

/// Checks the searches along one ray. Returns the nearest hit.
fn check(sceneries: &[Scenery; 2], ray: &PastRay, range: Range<f64>) -> Option<Intersection> {
    let worlds = sceneries.each_ref().map(|scenery| (&scenery.world, scenery.faces()));
    let [found, expected] = worlds.map(|(world, faces)| world.closest(faces, ray, range.clone()));
    assert_eq!(found.as_ref().map(digits), expected.as_ref().map(digits), "{ray:?} {range:?}");
    let [all, all_expected] = worlds.map(|(world, faces)| {
        let mut all = Vec::new();
        let end = world.visit(faces, ray, range.clone(), |found| {
            all.push(digits(&found));
            ControlFlow::Continue(())
        });
        assert_eq!(end, ControlFlow::Continue(()));
        all
    });
    assert_eq!(all, all_expected, "{ray:?} {range:?}");
    expected
}

/// A ray from an event, into the past, in a direction of the frame of the camera.
fn ray(origin: Event, step: Event, start: Start) -> PastRay {
    PastRay { origin, step, wave: WaveVector { frequency: 1.0, k: DVec3::ZERO }, start }
}

#[test]
fn hits_are_those_of_testing_every_body() {
    let mut random = Random(1);
    let mut n_hits = [0; 4];
    for (n, fastest) in
        [(5, 0.5), (60, 0.9), (200, 0.99), (60, 0.999_999), (40, 1.0 - 1e-13), (300, 0.05)]
    {
        let text = scene(&mut random, n, fastest);
        let both = scenery(&text);
        let parts = &both[0].world.parts;
        assert!(parts.len() == n && both[0].world.boxes.is_some());
        for _ in 0..400 {
            // From the eye.
            let primary = PastRay::from_eye(random.direction() * random.between(0.5, 2.0));
            let first = check(&both, &primary, 0.0..f64::INFINITY);
            n_hits[0] += usize::from(first.is_some());
            // From any event, through any medium.
            let velocity = Velocity::from_beta(random.in_ball(0.9)).unwrap();
            let medium = Medium { index: random.between(1.0, 2.5), velocity };
            let k = random.direction();
            let forward = *random.pick(&[
                Event { t: 1.0, x: k },
                medium.step(WaveVector { frequency: 1.0, k: k * medium.index }.in_frame(-velocity)),
            ]);
            let origin = Event { t: -random.between(0.0, 40.0), x: random.in_cube(12.0) };
            let step = Event { t: -forward.t, x: -forward.x };
            let range = 0.0..*random.pick(&[5.0, f64::INFINITY]);
            n_hits[1] +=
                usize::from(check(&both, &ray(origin, step, Start::Event), range).is_some());
            // From a surface, as for reflections and shadows, and beyond the first hit.
            let Some(first) = first else { continue };
            n_hits[2] += usize::from(check(&both, &primary, first.s..f64::INFINITY).is_some());
            let frame = &parts[first.part].frame;
            let event = along(primary.origin, primary.step, first.s);
            let place = frame.rest_from_camera(event).x;
            let step = frame.camera_from_rest(Event { t: -1.0, x: random.direction() });
            let from_surface = ray(event, step, Start::Surface { part: first.part, place });
            n_hits[3] += usize::from(check(&both, &from_surface, 0.0..f64::INFINITY).is_some());
        }
    }
    assert!(n_hits.iter().all(|&n| n > 100), "{n_hits:?}");
}

#[test]
fn packets_hit_what_testing_every_body_hits() {
    let mut random = Random(2);
    let mut n_hits = 0;
    for fastest in [0.3, 0.95] {
        let text = scene(&mut random, 100, fastest);
        let both = scenery(&text);
        for _ in 0..300 {
            let middle = random.direction();
            let spread = *random.pick(&[0.0, 0.01, 0.3, 1.2]);
            let rays: Vec<PastRay> = (0..64)
                .map(|_| PastRay::from_eye(middle + random.in_ball(1.0) * spread * 0.5))
                .collect();
            let [found, expected] = both.each_ref().map(|Scenery { world, .. }| {
                let (mut memory, mut first) = (PacketMemory::default(), vec![None; rays.len()]);
                world.first(both[0].faces(), &rays, 1e-3..f64::INFINITY, &mut memory, &mut first);
                first.iter().map(|found| found.as_ref().map(digits)).collect::<Vec<_>>()
            });
            assert_eq!(found, expected);
            n_hits += found.iter().flatten().count();
        }
    }
    assert!(n_hits > 3000, "{n_hits}");
}

/// Rays from neighbouring places towards one lamp, which share a corridor.
#[test]
fn shadow_rays_meet_what_testing_every_body_meets() {
    let mut random = Random(4);
    let (mut n_found, mut n_empty) = (0, 0);
    for (n, fastest) in [(30, 0.5), (60, 0.99), (60, 0.0), (300, 0.3), (40, 1.0 - 1e-10)] {
        let text = scene(&mut random, n, fastest);
        let both = scenery(&text);
        for _ in 0..60 {
            let mut corridor = Corridor::default();
            let (middle, lamp) = (random.in_cube(12.0), random.in_cube(30.0));
            let distance = *random.pick(&[1.0, f64::INFINITY]);
            for _ in 0..30 {
                let spread = *random.pick(&[0.03, 0.1, 1.0]);
                let place = middle + random.in_ball(spread);
                let origin = Event { t: -place.length() - random.between(0.0, 0.1), x: place };
                let toward = if distance.is_finite() { lamp - place } else { lamp };
                let ray = ray(origin, Event { t: -toward.length(), x: toward }, Start::Event);
                let all = |Scenery { world, .. }: &Scenery, corridor: Option<&mut Corridor>| {
                    let mut all = Vec::new();
                    let _ = world.visit_along(
                        both[0].faces(),
                        &ray,
                        0.0..distance,
                        corridor,
                        |found| {
                            all.push(digits(&found));
                            ControlFlow::Continue(())
                        },
                    );
                    all
                };
                let expected = all(&both[1], None);
                assert_eq!(all(&both[0], Some(&mut corridor)), expected, "{ray:?}");
                *if expected.is_empty() { &mut n_empty } else { &mut n_found } += 1;
            }
        }
    }
    assert!(n_found > 1000 && n_empty > 1000, "{n_found} {n_empty}");
}

/// Neighbouring shadow rays search the hierarchy once, and test few bodies each.
#[test]
fn neighbours_search_once() {
    let mut random = Random(5);
    let boxes: Vec<MovingBox> = (0..2000)
        .map(|_| {
            let center = random.in_cube(20.0);
            let corners = std::array::from_fn(|_| center + random.in_cube(0.3));
            MovingBox::new(corners, random.in_ball(0.2), 1.0, 0.6, 20.0)
        })
        .collect();
    let tree = MovingBoxes::new(&boxes);
    let (mut n_parts, mut n_corridors) = (0, 0);
    for _ in 0..100 {
        let mut corridor = Corridor::default();
        let (middle, lamp) = (random.in_cube(8.0), random.in_cube(8.0));
        let mut parts = Vec::new();
        for _ in 0..100 {
            let place = middle + 0.003 * middle.length() * random.in_cube(1.0);
            let toward = lamp - place;
            let step = Event { t: -toward.length(), x: toward };
            let rays = Rays::from_step(Event { t: -place.length(), x: place }, step).unwrap();
            let found = corridor.parts(&tree, &rays, toward.length()).unwrap_or_default().to_vec();
            n_corridors += usize::from(found != parts);
            n_parts += found.len();
            parts = found;
        }
    }
    assert!(n_corridors < 200 && n_parts < 100 * 100 * 20, "{n_corridors} {n_parts}");
}

/// Bodies of one size in a space that grows with their number, so that a ray meets few.
#[test]
fn few_of_many_bodies_are_tested() {
    let mut random = Random(3);
    for n in [30, 300, 3000] {
        let side = 2.0 * libm::cbrt(n as f64);
        let boxes: Vec<MovingBox> = (0..n)
            .map(|_| {
                let center = random.in_cube(side);
                let corners = std::array::from_fn(|_| center + random.in_cube(0.3));
                MovingBox::new(corners, random.in_ball(0.02), 1.0, 0.6, side)
            })
            .collect();
        let tree = MovingBoxes::new(&boxes);
        let mut tested = 0;
        for _ in 0..200 {
            let rays = Rays::from_eye(std::iter::once(random.direction())).unwrap();
            tree.visit_nearest(&rays, 0.0..f64::INFINITY, |_| {
                tested += 1;
                f64::INFINITY
            });
        }
        assert!(tested < 200 * 8, "{tested} of {n}");
    }
}
