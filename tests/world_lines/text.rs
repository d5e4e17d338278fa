//! Motions in the text: round trips, comments, the reader on several threads.

use std::fmt::Write;

use glam::DVec3;
use ugparse::{Options, Parsed, Source};
use ugscene::Scene;
use ugtesting::Random;
use ugtests::pipe;
use ugtests::scenes::parse;

use super::{World, options};

fn world(random: &mut Random) -> World {
    World::random(random, 3.0, 0.8, 2)
}

/// The motions of a scene.
fn motions(scene: &Scene) -> Vec<(String, ugphysics::WorldLine)> {
    let bodies = &scene.bodies;
    let row = |body| {
        (scene.names.get(bodies[body].name.unwrap()).to_string(), bodies.motion(body).clone())
    };
    bodies.stated_by_name().map(row).collect()
}

#[test]
fn motions_survive_a_round_trip() {
    let mut random = Random(11);
    for _ in 0..50 {
        let world = world(&mut random);
        let mut lines: Vec<String> = world.text().lines().map(str::to_string).collect();
        // The order of the statements does not matter.
        for row in 0..lines.len() {
            let other = random.below(lines.len());
            lines.swap(row, other);
        }
        let scene = parse(lines.join("\n").as_bytes());
        let text = ugparse::write(&scene);
        let again = parse(&text);
        assert_eq!(
            String::from_utf8(ugparse::write(&again)).unwrap(),
            String::from_utf8(text).unwrap()
        );
        assert_eq!(motions(&again), motions(&scene));
        // As seen, with shifts.
        let config = uglorentz::Config {
            anchor: None,
            in_place: random.one_in(2),
            camera_velocity: Some(random.in_ball(0.5)),
            ..options(8.0 * random.direction(), random.between(-3.0, 3.0))
        };
        let seen = pipe::lorentz_scene(lines.join("\n").as_bytes(), &config).unwrap().0;
        let text = ugparse::write(&seen);
        let again = parse(&text);
        assert_eq!(
            String::from_utf8(ugparse::write(&again)).unwrap(),
            String::from_utf8(text).unwrap()
        );
        assert_eq!(motions(&again), motions(&seen));
        let eye = config.eye.unwrap();
        let [here, there] = [&seen, &again].map(|scene| ugscene::measure(scene, eye, config.time));
        assert_eq!(here.len(), there.len());
        for (a, b) in here.iter().zip(&there) {
            assert!((a.velocity - b.velocity).length() < 1e-13, "{a:?} {b:?}");
        }
    }
}

#[test]
fn comments_stay_at_their_motions() {
    let text =
        "{ first }\nmotion b -spin 0 0 .1 ; { beside b }\n{ of a }\nmotion a -on b -at 1 0 0 ; { beside a }
        motion c -acc .1 0 0 ;\n{ of d } v d 0 9 0; v e 1 9 0; v f 0 9 1; f (d e f) <a>; f (d e f) <b>;";
    let write = |text: &str| {
        let Parsed { scene, passed_on, .. } =
            ugparse::parse(&Source::new("", text), &Options::default()).unwrap();
        String::from_utf8(ugparse::write_with(&scene, &passed_on)).unwrap()
    };
    let written = write(text);
    let position = |part: &str| written.find(part).unwrap_or_else(|| panic!("{part}: {written}"));
    for (before, behind) in
        [("motion b", "{ beside b }"), ("{ of a }", "motion a"), ("motion a", "{ beside a }")]
    {
        let (before, behind) = (position(before), position(behind));
        assert!(before < behind && !written[before..behind].contains("motion c"), "{written}");
        assert!(behind - before < 60, "{written}");
    }
    assert_eq!(write(&written), written);
}

/// A large text in which all motions follow their use is read in blocks.
#[test]
fn large_texts_are_read_as_on_one_thread() {
    let mut random = Random(12);
    let mut text = String::new();
    let n = 12_000;
    for row in 0..n {
        for corner in ["a", "b", "c"] {
            let p = random.in_ball(1.0) + DVec3::Y * 5.0;
            writeln!(text, "v {corner}{row} {:?} {:?} {:?};", p.x, p.y, p.z).unwrap();
        }
        let body = if row == n - 1 { "late".to_string() } else { format!("m{}", row % 7) };
        writeln!(text, "f (a{row} b{row} c{row}) <{body}>; {{ face {row} }}").unwrap();
        if row == n / 2 {
            text += "motion m3 -on m5 -spin 0 .01 0; { in the middle }\n";
        }
    }
    for row in [0, 1, 2, 4, 5, 6] {
        writeln!(text, "motion m{row} -at 0 5 0 -spin 0 0 .0{row}1; {{ motion {row} }}").unwrap();
    }
    text += "motion late -on m0;\nl 1; cam -ep 0 0 0 -vc 0 5 0 <m6>;\n";
    assert!(text.len() > 1 << 20);
    let on_threads = |n: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(n).build().unwrap();
        pool.install(|| {
            let scene = parse(text.as_bytes());
            (ugparse::write(&scene), motions(&scene))
        })
    };
    let (one, motions) = on_threads(1);
    assert_eq!(motions.len(), 8);
    for threads in [2, 5] {
        let (several, others) = on_threads(threads);
        assert!(one == several, "{threads} threads");
        assert_eq!(motions, others);
    }
}
