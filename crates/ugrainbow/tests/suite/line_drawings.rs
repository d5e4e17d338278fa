//! Silhouettes, creases and hidden lines, counted in figures.

use ugimage::Format;
use ugphysics::Hsv;
use ugrainbow::{Config, EdgeKind, HiddenLines, Output, Wireframe};

use crate::common::{file, with};

/// Lines of a figure, those of visible edges and those of hidden ones: their lengths. Shorter ones
/// than a few widths are where a hidden line meets the silhouette.
fn lines(scene: &str, edges: EdgeKind, hidden: HiddenLines) -> [Vec<f64>; 2] {
    lines_of(80, scene, edges, hidden)
}

/// The same in a picture with sides of this length.
fn lines_of(side: u32, scene: &str, edges: EdgeKind, hidden: HiddenLines) -> [Vec<f64>; 2] {
    let color = Some(Hsv { hue: 0.0, saturation: 0.0, value: 1.0 });
    let wireframe = Some(Wireframe { has_faces: false, color, edges, hidden });
    let config = Config { wireframe, line_width: 1.0, ..Config::default() };
    let config = with(&config, |picture| {
        (picture.size, picture.output) = ([side; 2], Output::Vector(Format::Svg));
    });
    let svg = String::from_utf8(file(scene, &config)).unwrap();
    ["1", ".6"].map(|width| {
        let before = format!("stroke-width=\"{width}\" d=\"M");
        let paths = svg.split(&before).skip(1);
        let length = |path: &str| {
            let numbers: Vec<f64> = path
                .split('"')
                .next()
                .unwrap()
                .split(['L', ' '])
                .map(|number| number.parse().unwrap())
                .collect();
            let [x, y, to_x, to_y] = numbers[..] else { panic!("{path}") };
            libm::hypot(to_x - x, to_y - y)
        };
        paths.map(length).filter(|length| *length > 3.0).collect()
    })
}

fn camera([x, y, z]: [f64; 3]) -> String {
    format!("cam -ep {x} {y} {z} -vc 0 0 0 -va 30;")
}

/// A cube of twelve triangles. `is_apart`: each has its own vertices.
fn cube(is_apart: bool) -> String {
    let mut text = String::new();
    let vertex = |name: String, k: usize| {
        let at = |bit: usize| if k >> bit & 1 == 0 { -1 } else { 1 };
        format!("v {name} {} {} {};", at(0), at(1), at(2))
    };
    (0..8).for_each(|k| text += &vertex(format!("v{k}"), k));
    for (face, [a, b, c, d]) in
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [1, 3, 7, 5], [3, 2, 6, 7], [2, 0, 4, 6]]
            .into_iter()
            .enumerate()
    {
        for (half, corners) in [[a, b, c], [a, c, d]].into_iter().enumerate() {
            if is_apart {
                let name = |corner: usize| format!("f{face}_{half}_{corner}");
                (0..3).for_each(|corner| text += &vertex(name(corner), corners[corner]));
                text += &format!("f ({} {} {});", name(0), name(1), name(2));
            } else {
                let [a, b, c] = corners;
                text += &format!("f (v{a} v{b} v{c});");
            }
        }
    }
    text
}

#[test]
fn a_cube_shows_nine_edges_and_hides_three() {
    for eye in [[5.0, -7.0, 4.0], [-6.0, -3.0, -5.0], [4.0, 6.0, 7.0]] {
        for is_apart in [false, true] {
            let text = format!("{}{}", cube(is_apart), camera(eye));
            let count = |edges, hidden| lines(&text, edges, hidden).map(|lines| lines.len());
            assert_eq!(count(EdgeKind::All, HiddenLines::Omitted), [9, 0], "{eye:?}");
            assert_eq!(count(EdgeKind::All, HiddenLines::Thin), [9, 3], "{eye:?}");
            // The outline is a hexagon.
            assert_eq!(count(EdgeKind::Silhouette, HiddenLines::Thin), [6, 0], "{eye:?}");
            // All faces meet at right angles.
            for (degrees, expected) in [(1.0, [9, 3]), (89.0, [9, 3]), (91.0, [6, 0])] {
                let edges = EdgeKind::Creases { angle: f64::to_radians(degrees) };
                assert_eq!(count(edges, HiddenLines::Thin), expected, "{eye:?} {degrees}");
            }
        }
    }
}

#[test]
fn dashes_are_five_widths_long_and_three_apart() {
    let text = format!("{}{}", cube(false), camera([5.0, -7.0, 4.0]));
    let [_, whole] = lines_of(400, &text, EdgeKind::All, HiddenLines::Thin);
    let [_, dashes] = lines_of(400, &text, EdgeKind::All, HiddenLines::Dashed);
    let (whole, drawn): (f64, f64) = (whole.iter().sum(), dashes.iter().sum());
    // Ends of lines are longer by half a width.
    assert!(dashes.iter().all(|dash| *dash < 5.6), "{dashes:?}");
    assert!((drawn / whole - 5.0 / 8.0).abs() < 0.05 && dashes.len() > 20, "{drawn} of {whole}");
}

/// A prism of twelve sides, whose planes meet at 30 degrees. A convex body has one silhouette: here
/// the lower edges of the sides that are seen, the upper ones of the others, and two between them.
#[test]
fn creases_are_edges_of_at_least_an_angle() {
    let mut text = String::new();
    let (mut upper, mut lower) = (String::new(), String::new());
    for side in 0..12 {
        let (y, x) = libm::sincos(f64::from(side) * std::f64::consts::PI / 6.0);
        text += &format!("v a{side} {x} {y} -1; v b{side} {x} {y} 1;");
        upper += &format!("b{side} ");
        lower = format!("a{side} {lower}");
    }
    (0..12).for_each(|side| {
        let next = (side + 1) % 12;
        text += &format!("f (a{side} a{next} b{next} b{side});");
    });
    text += &format!("f ({upper}); f ({lower}); {}", camera([3.0, -7.0, 4.0]));
    let count = |degrees: f64| {
        let edges = EdgeKind::Creases { angle: degrees.to_radians() };
        lines(&text, edges, HiddenLines::Thin).iter().map(Vec::len).sum::<usize>()
    };
    assert_eq!([count(29.0), count(31.0), count(89.0), count(91.0)], [36, 26, 26, 14]);
    let [seen, hidden] = lines(&text, EdgeKind::Silhouette, HiddenLines::Thin);
    assert_eq!([seen.len(), hidden.len()], [14, 0]);
}

/// A face that is inside out makes no silhouette of its edges, and one of a single face is drawn.
#[test]
fn the_order_of_corners_of_a_face_does_not_matter() {
    let corners = "v a -2 -2 0; v b 2 -2 0; v c 2 2 0; v d -2 2 0;";
    // And a hole that a face fills.
    let hole = "v e -1 -1 0; v g 1 1 0; v h -1 1 0; f (a b c d) (e g h); f (e g h);";
    for faces in ["f (a b c); f (a c d);", "f (a b c); f (a d c);", hole] {
        for edges in [EdgeKind::All, EdgeKind::Silhouette, EdgeKind::Creases { angle: 0.1 }] {
            let [seen, hidden] = lines(
                &format!("{corners} {faces} {}", camera([1.0, -7.0, 9.0])),
                edges,
                HiddenLines::Thin,
            );
            assert_eq!([seen.len(), hidden.len()], [4, 0], "{faces} {edges:?}");
        }
    }
}
