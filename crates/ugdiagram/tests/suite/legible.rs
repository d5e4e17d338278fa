//! Labels overlap nothing.

use ugdiagram::{Config, Obstacles, Placed, Wanted, crosses, overlap, place, render};
use ugtesting::Random;

use crate::common::{drawn, scene, stored};

const AREA: [f64; 4] = [0.0, 0.0, 600.0, 400.0];

#[track_caller]
fn check(placed: &[Placed], obstacles: &Obstacles, area: [f64; 4]) {
    for (row, one) in placed.iter().enumerate() {
        let [left, top, right, bottom] = one.rectangle;
        assert!(area[0] <= left && area[1] <= top && right <= area[2] && bottom <= area[3]);
        for other in &placed[..row] {
            assert!(!overlap(&one.rectangle, &other.rectangle), "{one:?} {other:?}");
            let runs = |a: &Placed, b: &Placed| {
                a.leader.is_some_and(|leader| crosses(leader, &b.rectangle))
            };
            assert!(!runs(one, other), "{one:?} {other:?}");
        }
        assert!(!obstacles.marks.iter().any(|mark| overlap(&one.rectangle, mark)), "{one:?}");
    }
}

#[test]
fn labels_are_apart_from_each_other_and_from_marks() {
    let mut random = Random(11);
    let mut n_placed = 0;
    for _ in 0..200 {
        let mut number = |size: f64| size * random.unit();
        let mut obstacles = Obstacles::default();
        for _ in 0..12 {
            let [x, y] = [number(600.0), number(400.0)];
            obstacles.marks.push([x - 3.0, y - 3.0, x + 3.0, y + 3.0]);
            obstacles.lines.push([[x, y], [number(600.0), number(400.0)]]);
        }
        let wanted: Vec<Wanted> = (0..14)
            .map(|row| Wanted {
                size: [20.0 + number(60.0), 14.0],
                anchors: vec![[number(600.0), number(400.0)]; 2],
                gap: 6.0,
                is_optional: row % 3 == 2,
            })
            .collect();
        let placed = place(&wanted, &obstacles, AREA);
        assert_eq!(placed.len(), wanted.len());
        let free: Vec<Placed> = placed.iter().flatten().copied().collect();
        n_placed += free.len();
        check(&free, &obstacles, AREA);
        for (wanted, placed) in wanted.iter().zip(&placed) {
            let Some(placed) = placed else { continue };
            let is_crossed = obstacles.lines.iter().any(|line| crosses(*line, &placed.rectangle));
            assert!(!wanted.is_optional || !is_crossed && placed.leader.is_none());
        }
    }
    assert!(n_placed > 2000, "{n_placed}");
}

#[test]
fn lines_cross_rectangles_or_do_not() {
    let rectangle = [10.0, 10.0, 20.0, 20.0];
    for (line, expected) in [
        ([[0.0, 0.0], [30.0, 30.0]], true),
        ([[0.0, 15.0], [30.0, 15.0]], true),
        ([[12.0, 12.0], [13.0, 14.0]], true),
        ([[0.0, 0.0], [30.0, 0.0]], false),
        ([[0.0, 10.0], [30.0, 10.0]], false),
        ([[0.0, 25.0], [15.0, 40.0]], false),
        ([[21.0, 0.0], [21.0, 30.0]], false),
    ] {
        assert_eq!(crosses(line, &rectangle), expected, "{line:?}");
    }
}

/// Ten world lines with names, events and axes, in a column of a journal: all names are there, and
/// none covers anything.
#[test]
fn ten_world_lines_are_legible_in_a_column() {
    let mut random = Random(5);
    let mut n_labels = 0;
    for round in 0..30 {
        let n_lines = 1 + round % 9;
        let mut text = String::from("cam -ep 0 -6 0;\n");
        let mut number = |size: f64| size * (2.0 * random.unit() - 1.0);
        for line in 0..n_lines {
            let (beta, x, y) = (number(0.9), number(8.0), number(2.0));
            text += &format!("motion body{line} -vel {beta} 0 0 -at {x} {y} 0;\n");
        }
        let mut config = Config::default();
        // 8.6 cm at 300 pixels to the inch, and in points.
        let per_inch = if round % 2 == 0 { 300.0 } else { 72.0 };
        let side = (8.6 / 2.54 * per_inch) as u32;
        (config.picture.size, config.picture.per_inch) = ([side; 2], Some(per_inch));
        config.diagram.times = Some([-8.0, 8.0]);
        config.diagram.events = vec!["A=-2,3".parse().unwrap(), "B=4,-5".parse().unwrap()];
        config.diagram.axes = vec![("body0".parse().unwrap(), "body0@0".parse().unwrap())];
        let rendered = drawn(scene(&text), &config);
        assert_eq!(rendered.drawn.omitted, Vec::<String>::new(), "{round}");
        let placed: Vec<Placed> = rendered.drawn.labels.iter().map(|(_, placed)| *placed).collect();
        check(&placed, &rendered.drawn.obstacles, [0.0, 0.0, f64::from(side), f64::from(side)]);
        for (name, placed) in &rendered.drawn.labels {
            let lines = &rendered.drawn.obstacles.lines;
            let n_crossed = lines.iter().filter(|line| crosses(**line, &placed.rectangle)).count();
            assert_eq!(n_crossed, 0, "{round}: {name}");
        }
        for line in 0..n_lines {
            let name = format!("body{line}");
            let is_drawn = rendered.diagram.curves.iter().any(|curve| curve.label == name);
            let is_named = rendered.drawn.labels.iter().any(|(text, _)| *text == name);
            assert_eq!(is_drawn, is_named, "{round}: {name}");
        }
        n_labels += placed.len();
    }
    assert!(n_labels > 400, "{n_labels}");
}

/// Inks have a contrast of 4.5 to white at least.
#[test]
fn inks_are_dark() {
    for name in ["traffic", "dice", "twins", "ticks", "lamps"] {
        let rendered = render(stored(name), &Config::default()).unwrap();
        for curve in &rendered.diagram.curves {
            let light = curve.color.map(|level| ugphysics::srgb_decode(f64::from(level) / 255.0));
            let is_light = curve.role == ugdiagram::CurveRole::Light;
            assert!(is_light || ugphysics::luminance(light) < 0.19, "{name}: {curve:?}");
        }
    }
}
