//! Cutting: no cracks, right to the bound, nothing lost. What is measured is measured on the output
//! alone, by sampling true curves.

use std::collections::{BTreeMap, BTreeSet};

use glam::DVec3;
use uglorentz::{Config, DEFAULT_COLOR_ERROR, Pieces};
use ugphysics::{Velocity, doppler_at, seen_position};
use ugpipe::Words;
use ugscene::{RestFrames, Scene, ShownEffects, VertexId};
use ugtesting::Random;

use crate::common::{
    edges, find, moving, normal, parse, place, prism, rock, run, seen, tetrahedron, text,
};

type Mesh = (Vec<DVec3>, Vec<Vec<usize>>);

/// Closed meshes of triangles, quadrilaterals and larger polygons, near enough to be cut.
fn meshes(random: &mut Random) -> Vec<Mesh> {
    let mut center = || random.direction() * 3.0;
    let centers = [center(), center(), center(), center(), center()];
    vec![
        tetrahedron(random, centers[0], 1.0),
        rock(random, centers[1], 1.5, 1),
        prism(random, centers[2], 1.0, 4),
        prism(random, centers[3], 1.2, 5),
        prism(random, centers[4], 1.0, 9),
    ]
}

/// Rest positions recovered from what was written, by (P4).
fn rest(scene: &Scene) -> Vec<DVec3> {
    let frames = RestFrames::new(scene);
    let eye = ugscene::eye(scene, None);
    ugscene::rest_positions(scene, eye, &frames)
}

#[test]
fn pieces_cover_their_face_in_its_direction() {
    let mut random = Random(12);
    for pieces in [Pieces::UpTo(1e-3), Pieces::PerEdge(3)] {
        for (vertices, faces) in meshes(&mut random) {
            let text = text(&vertices, &faces);
            let whole = parse(&text);
            let scene = seen(&text, &Config { pieces, ..moving(random.direction() * 0.9) });
            let rest = rest(&scene);
            let names: Vec<&str> =
                scene.faces.iter().map(|f| scene.names.get(f.name.unwrap())).collect();
            for (idx, face) in whole.faces.iter().enumerate() {
                let expected = normal(&whole, face, &vertices);
                let mine =
                    scene.faces.iter().zip(&names).filter(|(_, name)| **name == format!("f{idx}"));
                let parts: Vec<DVec3> =
                    mine.map(|(piece, _)| normal(&scene, piece, &rest)).collect();
                assert!(parts.iter().all(|part| part.dot(expected) > 0.0), "a piece is turned");
                let sum: DVec3 = parts.iter().sum();
                assert!((sum - expected).length() < 1e-12, "{sum} {expected}");
                // Flat pieces without overlap: areas add up too.
                let area: f64 = parts.iter().map(|part| part.length()).sum();
                assert!((area - expected.length()).abs() < 1e-11, "{area}");
            }
            // Pieces stand together, in the order of their faces.
            let mut order = names.clone();
            order.dedup();
            assert_eq!(order, (0..faces.len()).map(|idx| format!("f{idx}")).collect::<Vec<_>>());
        }
    }
}

#[test]
fn names_are_unique() {
    let (vertices, faces) = prism(&mut Random(13), DVec3::new(2.0, 1.0, 0.5), 1.0, 5);
    let text = text(&vertices, &faces)
        .replace("v1 ", "s#1 ")
        .replace("v1)", "s#1)")
        .replace("v2 ", "s##7 ");
    let scene = seen(&text.replace("v2)", "s##7)"), &moving(DVec3::X * 0.9));
    let names: BTreeSet<&str> = scene.vertices.iter().map(|v| scene.names.get(v.name)).collect();
    assert_eq!(names.len(), scene.vertices.len());
    assert!(names.contains("s###1") && !names.contains("s##1"));
}

/// Largest errors of drawn edges against the true curves between their ends.
#[derive(Default, Debug)]
struct Errors {
    /// Angle of the true curve from the chord, radians.
    angle: f64,
    /// Distance in space from the chord over the distance from the eye; within a face from the
    /// planes of the pieces it borders, if that is less.
    offset: f64,
    /// Relative error of D along the chord, and of 1/D.
    doppler: f64,
    /// Distance in space between the inside of a face and the true, curved face, over the distance
    /// from the eye.
    inside: f64,
    /// Relative error of D taken linearly inside triangles, and of 1/D.
    inside_doppler: f64,
}

fn errors(scene: &Scene, v: Velocity) -> Errors {
    let rest = rest(scene);
    let mut worst = Errors::default();
    let normals = normals(scene);
    for (&(a, b), normals) in &normals {
        let (from, to) = (place(scene, a), place(scene, b));
        for step in 1..20 {
            let s = f64::from(step) / 20.0;
            let p = seen_position(rest[a.index()].lerp(rest[b.index()], s), v);
            let (angle, offset) = off_chord(p, from, to);
            let drawn = from.lerp(to, s);
            let exact = doppler_at(drawn, v);
            let linear = doppler_at(from, v) * (1.0 - s) + doppler_at(to, v) * s;
            worst.angle = worst.angle.max(angle);
            let out = normals.iter().map(|normal| (p - from).dot(*normal).abs()).reduce(f64::max);
            worst.offset = worst.offset.max(out.map_or(offset, |out| out.min(offset)) / p.length());
            worst.doppler = worst.doppler.max((linear / exact - 1.0).abs());
            let inverse = (1.0 - s) / doppler_at(from, v) + s / doppler_at(to, v);
            worst.doppler = worst.doppler.max((inverse * exact - 1.0).abs());
        }
    }
    for face in &scene.faces {
        let corners = scene.contours.corners(face.contours.clone());
        match *corners {
            [a, b, c] => inside(scene, &rest, [a, b, c], v, &mut worst),
            [a, b, c, d] => {
                for half in [[a, b, c], [a, c, d], [b, c, d], [b, d, a]] {
                    inside(scene, &rest, half, v, &mut worst);
                }
            }
            _ => {}
        }
    }
    worst
}

/// Of each drawn edge within a face, the normals of the triangles it makes with other corners of
/// its pieces; none of edges between faces.
fn normals(scene: &Scene) -> BTreeMap<(VertexId, VertexId), Vec<DVec3>> {
    let mut normals = BTreeMap::<_, Vec<DVec3>>::new();
    let mut names = BTreeMap::<_, BTreeSet<_>>::new();
    for face in &scene.faces {
        let corners = scene.contours.corners(face.contours.clone());
        for (&a, &b) in corners.iter().zip(corners.iter().cycle().skip(1)) {
            let (from, to) = (place(scene, a), place(scene, b));
            let others = corners.iter().filter(|&&corner| corner != a && corner != b);
            let edge = (a.min(b), a.max(b));
            let normal =
                |&c: &VertexId| (to - from).cross(place(scene, c) - from).normalize_or_zero();
            normals.entry(edge).or_default().extend(others.map(normal));
            names.entry(edge).or_default().insert(face.name.map(|name| scene.names.get(name)));
        }
    }
    for (edge, _) in names.into_iter().filter(|(_, names)| names.len() > 1) {
        normals.entry(edge).or_default().clear();
    }
    normals
}

/// Errors at some points inside a triangle.
fn inside(scene: &Scene, rest: &[DVec3], corners: [VertexId; 3], v: Velocity, worst: &mut Errors) {
    let drawn = corners.map(|corner| place(scene, corner));
    let rest = corners.map(|corner| rest[corner.index()]);
    let normal = (drawn[1] - drawn[0]).cross(drawn[2] - drawn[0]).normalize_or_zero();
    let doppler = drawn.map(|corner| doppler_at(corner, v));
    for [i, j] in [[2, 2], [3, 3], [2, 3], [3, 2]] {
        let weights =
            [8.0 - f64::from(i + j), f64::from(i), f64::from(j)].map(|weight| weight / 8.0);
        let mean =
            |points: [DVec3; 3]| -> DVec3 { points.iter().zip(weights).map(|(&p, w)| p * w).sum() };
        let p = seen_position(mean(rest), v);
        worst.inside = worst.inside.max((p - drawn[0]).dot(normal).abs() / p.length());
        let exact = doppler_at(mean(drawn), v);
        let linear: f64 = doppler.iter().zip(weights).map(|(d, w)| d * w).sum();
        let inverse: f64 = doppler.iter().zip(weights).map(|(d, w)| w / d).sum();
        let off = (linear / exact - 1.0).abs().max((inverse * exact - 1.0).abs());
        worst.inside_doppler = worst.inside_doppler.max(off);
    }
}

/// Least angle at the eye, and least distance, between a point and a chord.
fn off_chord(p: DVec3, from: DVec3, to: DVec3) -> (f64, f64) {
    let nearest = |p: DVec3, a: DVec3, b: DVec3| {
        let s = ((p - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
        a.lerp(b, s)
    };
    // Seen from the eye the chord is a great circle: with p scaled onto the plane p·d = |p|, it is
    // a straight line.
    let d = p.normalize();
    let (a, b) = (from / from.dot(d), to / to.dot(d));
    let q = nearest(d, a, b);
    (libm::atan2(d.cross(q).length(), d.dot(q)), (nearest(p, from, to) - p).length())
}

#[test]
fn drawn_edges_are_right_to_the_bound() {
    let mut random = Random(14);
    for speed in [0.3, 0.9, 0.99] {
        for bound in [10e-3, 1e-3, 0.1e-3] {
            let mut worst = Errors::default();
            for (vertices, faces) in meshes(&mut random) {
                let direction = random.direction();
                let config = Config { pieces: Pieces::UpTo(bound), ..moving(direction * speed) };
                let scene = seen(&text(&vertices, &faces), &config);
                let found = errors(&scene, Velocity::from_beta(direction * speed).unwrap());
                worst.angle = worst.angle.max(found.angle);
                worst.offset = worst.offset.max(found.offset);
                worst.doppler = worst.doppler.max(found.doppler);
                worst.inside = worst.inside.max(found.inside);
                worst.inside_doppler = worst.inside_doppler.max(found.inside_doppler);
            }
            assert!(worst.angle <= bound * 1.000_001, "{speed} {bound} {worst:?}");
            assert!(
                worst.offset.max(worst.inside) <= bound.max(1e-4) * 1.000_001,
                "{speed} {bound} {worst:?}"
            );
            // Edges get three quarters, so that it holds inside.
            assert!(worst.doppler <= 0.75 * DEFAULT_COLOR_ERROR, "{speed} {bound} {worst:?}");
            assert!(worst.inside_doppler <= DEFAULT_COLOR_ERROR, "{speed} {bound} {worst:?}");
            // And the bound is used, not undercut by far.
            if bound < 1e-3 {
                assert!(worst.angle.max(worst.offset) > bound / 2.0, "{speed} {bound} {worst:?}");
            }
        }
    }
}

#[test]
fn only_what_bends_is_cut() {
    let check = |what: &str, text: &str, config: &Config, is_cut: bool| {
        let scene = run(text, config).scene;
        assert_eq!(scene.faces.len() > parse(text).faces.len(), is_cut, "{what}");
    };
    let wide = "v a -9 1 1; v b 9 1 1; v c 9 1 3; v d -9 1 3; f (a b c d);";
    let small = "v a 0 1 0; v b 1e-4 1 0; v c 1e-4 1 1e-4; v d 0 1 1e-4; f (a b c d);";
    let fast = moving(DVec3::X * 0.9);
    check("a wide face", wide, &fast, true);
    check("a small face", small, &fast, false);
    check("a wide face at rest", wide, &Config::default(), false);
    check("a wide face that hardly moves", wide, &moving(DVec3::X * 1e-6), false);
    let contracted = ShownEffects { contraction: true, flight_time: false };
    let far = "v a -1 100 0; v b 1 100 0; v c 1 100 2; v d -1 100 2; f (a b c d);";
    check(
        "without flight time, where D varies little",
        far,
        &Config { geometry: contracted, ..fast.clone() },
        false,
    );
    let seen_now = ShownEffects { contraction: false, flight_time: true };
    check("without contraction", wide, &Config { geometry: seen_now, ..fast.clone() }, true);
    check("one piece an edge", wide, &Config { pieces: Pieces::PerEdge(1), ..fast }, false);
}

/// Uniform pieces of the edge x = 0, y in −1…1 at distance z = 1, β = 0.9: largest distance of the
/// hyperbola x = −βγ√(y² + z²) from its chords along x. The numbers are closed forms, taken where
/// curve and chord are parallel.
#[test]
fn chord_errors_of_equal_pieces() {
    let expected = [
        (1, 0.855_243_975_519),
        (2, 0.185_455_666_752),
        (4, 0.058_356_734_505),
        (8, 0.015_705_305_033),
        (16, 0.004_005_382_346),
        (32, 0.001_006_455_613),
    ];
    for (n, error) in expected {
        let config = Config { pieces: Pieces::PerEdge(n), ..moving(DVec3::X * 0.9) };
        let scene = seen("v a 0 -1 1; v b 0 1 1; w (a b);", &config);
        let corners = scene.wire_contours(&scene.wires[0]).next().unwrap();
        assert_eq!(corners.len(), n as usize + 1);
        let points: Vec<DVec3> = corners.iter().map(|&corner| place(&scene, corner)).collect();
        let slope = 0.9 / (1.0 - 0.81f64).sqrt();
        let worst = points.windows(2).flat_map(|pair| {
            (0..=2000).map(|step| {
                let p = pair[0].lerp(pair[1], f64::from(step) / 2000.0);
                (p.x + slope * (p.y * p.y + 1.0).sqrt()).abs()
            })
        });
        let worst = worst.fold(0.0, f64::max);
        assert!((worst - error).abs() < 1e-6 * error, "{n}: {worst}");
    }
}

#[test]
fn equal_pieces_are_as_many_as_asked() {
    let check = |face: &str, n: u32, n_faces: usize, n_vertices: usize| {
        let corners = "v a 3 0 0; v b 4 0 0; v c 4 1 0; v d 3 1 0; v e 2.5 0.5 0; v f 3.2 0.2 0; v g 3.2 0.3 0; v h 3.3 0.3 0;";
        let config =
            Config { pieces: Pieces::PerEdge(n), eye: Some(DVec3::Z), ..moving(DVec3::X * 0.5) };
        let scene = seen(&format!("{corners} {face}"), &config);
        assert_eq!(
            (scene.faces.len(), scene.vertices.len() - 8),
            (n_faces, n_vertices),
            "{face} {n}"
        );
    };
    check("f (a b c);", 1, 1, 0);
    check("f (a b c);", 3, 9, 7);
    check("f (a b c d);", 3, 9, 12);
    check("f (a b c d e);", 1, 1, 0);
    check("f (a b c d e);", 2, 12, 7);
    check("f (a b c d) (f g h);", 2, 28, 7 + 7);
    check("w (a b c d);", 4, 0, 9);
    // Two faces share the new vertices of their edge.
    check("f (a b c); f (a c d);", 2, 8, 5);
}

#[test]
fn polygons_with_holes_keep_them() {
    let text = "v a 3 -2 -2; v b 3 2 -2; v c 3 2 2; v d 3 -2 2; v m 3 0 -2;
        v e 3 -1 -1; v f 3 1 -1; v g 3 1 1; v h 3 -1 1; f wall (a m b c d) (e f g h);";
    let config = moving(DVec3::Y * 0.9);
    let scene = seen(text, &config);
    let rest = rest(&scene);
    let area: f64 = scene.faces.iter().map(|face| normal(&scene, face, &rest).x / 2.0).sum();
    assert!((area - 12.0).abs() < 1e-11, "{area}");
    assert!(scene.faces.len() > 100);
    // Every edge has two sides but those on the outline and round the hole.
    let on_rim = |vertex: VertexId| {
        let p = rest[vertex.index()];
        let reach = p.y.abs().max(p.z.abs());
        (reach - 1.0).abs() < 1e-9 || (reach - 2.0).abs() < 1e-9
    };
    for ((a, b), count) in edges(&scene) {
        assert!(
            count == (1, 1) || (on_rim(a) && on_rim(b)),
            "{:?} {:?}",
            rest[a.index()],
            rest[b.index()]
        );
    }
}

#[test]
fn faces_that_cannot_be_triangulated_still_meet_their_neighbours() {
    // A bow tie above a triangle: they share the edge from a to b.
    let text =
        "v a -3 2 1; v b 3 2 1; v c -3 3 1; v d 4 5 1; v e 0 2 -4; f bow (a b c d); f low (b a e);";
    let scene = seen(text, &moving(DVec3::X * 0.9));
    let bow = &scene.faces[0];
    let corners: Vec<VertexId> = scene.face_contours(bow).next().unwrap().to_vec();
    assert!(corners.len() > 20);
    assert_eq!(scene.names.get(scene.faces[1].name.unwrap()), "low");
    let edges = edges(&scene);
    let (a, b) = (find(&scene, "a"), find(&scene, "b"));
    let along: Vec<VertexId> = corners
        .iter()
        .copied()
        .skip_while(|&c| c != a)
        .take_while(|&c| c != b)
        .chain([b])
        .collect();
    for pair in along.windows(2) {
        assert_eq!(edges[&(pair[0].min(pair[1]), pair[0].max(pair[1]))], (1, 1));
    }
}

#[test]
fn wires_follow_the_faces_they_lie_on() {
    let text = "v a -3 2 1; v b 3 2 1; v c 0 4 1; f (a b c); w (b a);";
    let scene = seen(text, &moving(DVec3::X * 0.9));
    let corners = scene.wire_contours(&scene.wires[0]).next().unwrap();
    assert!(corners.len() > 10);
    let edges = edges(&scene);
    assert!(corners.windows(2).all(|p| edges.contains_key(&(p[0].min(p[1]), p[0].max(p[1])))));
}

#[test]
fn comments_and_attributes_go_with_their_faces() {
    let text = "{ head }
        c red 0.9 0 1;
        v a -3 2 1; v b 3 2 1; v c 0 4 1; v d 0 0 1;
        { the upper } f up (a b c) red 0.5;
        { the lower } f low (b a d) red; { behind it }
        { the line } w (a b);";
    let scene = seen(text, &moving(DVec3::X * 0.9));
    let named = |row: u32| scene.names.get(scene.faces[row as usize].name.unwrap());
    // The pieces of each face, and the comments, which come before the first and behind the last.
    let written = String::from_utf8(run(text, &moving(DVec3::X * 0.9)).text()).unwrap();
    let marks = written.lines().filter_map(|line| {
        let begin =
            ["f up", "f low", "w", "{"].into_iter().find(|begin| line.starts_with(begin))?;
        let (_, comment) = line.split_once('{').unwrap_or_default();
        Some(format!("{begin}{comment}"))
    });
    let mut marks: Vec<String> = marks.skip(2).collect();
    marks.dedup();
    assert_eq!(
        marks,
        [
            "{ the upper }",
            "f up",
            "{ the lower }",
            "f low",
            "f low behind it }",
            "{ the line }",
            "w"
        ]
    );
    for (row, face) in scene.faces.iter().enumerate() {
        assert_eq!(scene.light_level(face), (named(row as u32) == "up").then_some(0.5));
        assert!(
            face.color.is_some()
                && scene.bodies.stated_velocity(face.body).unwrap().beta().x == 0.9
        );
    }
    assert_eq!(scene.head.comments, [" head ", " uglorentz 0.1.0: uglorentz "]);
}

#[test]
fn colours_between_vertices() {
    let check = |a: &str, b: &str, expected: &str| {
        let text = format!(
            "c red 1 0 1; c green 0.5 120 0.5 1; c violet 1 330 1; c grey 0.5; c_rgb blue 0 0 1;
             v a 1 1 0 {a}; v b 2 1 0 {b}; v c 2 2 0 {a}; w (a b c);"
        );
        let scene =
            run(&text, &Config { pieces: Pieces::PerEdge(2), ..moving(DVec3::X * 0.5) }).scene;
        let middle = &scene.vertices[3..];
        let lines = String::from_utf8(ugparse::write(&scene)).unwrap();
        let name = middle[0].color.map(|id| scene.names.get(scene.colors[id.index()].name));
        let statement = name.and_then(|name| {
            lines.lines().find(|l| l.starts_with('c') && l.contains(&format!(" {name} ")))
        });
        assert_eq!(statement.unwrap_or("none"), expected, "{a} {b}");
        // Both edges mix the same two: one new colour serves them.
        assert!(scene.colors.len() <= 6);
    };
    check("red", "red", "c red 1 0 1;");
    check("", "", "none");
    check("red", "", "none");
    check("red", "green", "c s#1 0.75 60 0.75 0.5;");
    check("red", "violet", "c s#1 1 -15 1;");
    check("green", "grey", "c s#1 0.5 120 0.25 0.5;");
    // Colours of a display mix as light, also with hues.
    let half = ugphysics::srgb_encode(0.5);
    check("red", "blue", &format!("c_rgb s#1 {half} 0 {half};"));
}

#[test]
fn edges_at_the_eye_end_in_bounded_work() {
    // The eye lies in the face, in an edge, and a hair beside an edge.
    for text in [
        "v a -1 -1 0; v b 1 -1 0; v c 1 1 0; v d -1 1 0; f (a b c d);",
        "v a -1 0 0; v b 1 0 0; v c 1 1 0; v d -1 1 0; f (a b c d); w (a b);",
        "v a -1 0 1e-8; v b 1 0 1e-8; v c 1 1 0; v d -1 1 0; f (a b c d);",
        "v a -1e6 0 1; v b 1e6 0 1; v c 1e6 1 1; v d -1e6 1 1; f (a b c d);",
    ] {
        let config = Config { pieces: Pieces::UpTo(0.25e-3), ..moving(DVec3::X * 0.99) };
        let outcome = run(text, &config);
        assert!(outcome.scene.faces.len() < 1_000_000, "{}", outcome.scene.faces.len());
        assert!(
            outcome
                .scene
                .vertices
                .iter()
                .all(|v| v.position.is_finite() && v.position != DVec3::ZERO)
        );
        assert!(!outcome.report.is_full);
        assert!(outcome.report.n_too_deep == 0 || outcome.report.remaining_errors.is_some());
    }
    // A face seen edge-on keeps its outline, round the eye too; inside nothing is cut.
    for (text, beta) in [
        ("v a -1 -1 0; v b 1 -1 0; v c 1 1 0; v d -1 1 0; f (a b c d);", DVec3::X),
        ("v a -1 1 0; v b 1 1 0; v c 1 2 0; v d -1 2 0; f (a b c d);", DVec3::new(0.0, 0.6, 0.8)),
    ] {
        let outcome = run(text, &Config { measure: true, ..moving(beta * 0.99) });
        assert_eq!(outcome.scene.faces.len(), 1);
        let achieved = outcome.report.remaining_errors.unwrap();
        assert!(
            (50..1000).contains(&outcome.report.n_new_vertices),
            "{}",
            outcome.report.n_new_vertices
        );
        assert!(achieved.angle.error <= 1e-4 && achieved.depth.error <= 1e-4, "{achieved:?}");
    }
    // A floor close to the eye slides along in its plane and is seen flat; only colours ask for
    // many pieces.
    for (height, most) in [("1e-3", 100_000), ("1e-8", 1000), ("1e-12", 1000)] {
        let floor = "v a -10 -10 H; v b 10 -10 H; v c 10 10 H; v d -10 10 H; f (a b c d);"
            .replace('H', height);
        let n_pieces = |color_error| {
            run(&floor, &Config { color_error, ..moving(DVec3::X * 0.99) }).scene.faces.len()
        };
        assert!(
            n_pieces(f64::INFINITY) < most && n_pieces(DEFAULT_COLOR_ERROR) < 250_000,
            "{height}"
        );
    }
    // Numbers near the ends of their range.
    for size in ["1e-300", "1e200"] {
        let text =
            "v a -SIZE SIZE 0; v b SIZE SIZE 0; v c 0 SIZE SIZE; f (a b c);".replace("SIZE", size);
        assert!(run(&text, &moving(DVec3::X * 0.999)).scene.faces.len() < 200_000);
    }
    let outcome = run("v a -1 0 0; v b 1 0 0; w (a b);", &moving(DVec3::X * 0.99));
    assert!(outcome.report.warnings()[0].contains("above the bound after 32 halvings"));
}

#[test]
fn what_is_told_of_errors_is_what_is_measured() {
    let mut random = Random(16);
    for (vertices, faces) in meshes(&mut random) {
        let beta = random.direction() * 0.9;
        let config = Config { measure: true, pieces: Pieces::UpTo(1e-3), ..moving(beta) };
        let outcome = run(&text(&vertices, &faces), &config);
        let found = errors(&outcome.scene, Velocity::from_beta(beta).unwrap());
        let told = outcome.report.remaining_errors.as_ref().unwrap();
        // Sampling finds nearly all of it, and no more.
        let check = |told: f64, found: f64| {
            assert!(found <= told * 1.000_001 && found > 0.9 * told, "{told} {found}")
        };
        check(told.angle.error, found.angle);
        assert!(found.offset.max(found.inside) <= told.depth.error * 1.000_001);
        assert!(found.offset.max(found.inside) > 0.8 * told.depth.error);
        assert!(found.doppler <= told.doppler.error, "{} {}", found.doppler, told.doppler.error);
        assert!(
            told.angle.at.len() == 2 && outcome.report.details()[1].contains(&told.angle.at[0])
        );
    }
}

#[test]
fn what_is_out_of_sight_is_not_cut_further() {
    // A wide floor; the camera looks along it to the left.
    let text = "v a -50 -50 -1; v b 50 -50 -1; v c 50 50 -1; v d -50 50 -1; f (a b c d); cam -ep 0 0 0 -vc -1 0 -.2;";
    for direction in [DVec3::X, DVec3::Z, DVec3::new(0.6, 0.0, 0.8)] {
        let whole = Config { measure: true, ..moving(direction * 0.9) };
        let seen = Config { size: [80, 60], cull: true, ..whole.clone() };
        let n_faces = |config: &Config| {
            let outcome = run(text, config);
            let achieved = outcome.report.remaining_errors.unwrap();
            assert!(achieved.angle.error <= 1.000_001e-4 && achieved.depth.error <= 1.000_001e-4);
            // Euler's formula holds only if pieces share their edges.
            let euler =
                |scene: &Scene| scene.vertices.len() + scene.faces.len() - edges(scene).len();
            assert_eq!(euler(&outcome.scene), 1);
            outcome.scene.faces.len()
        };
        let (all, few) = (n_faces(&whole), n_faces(&seen));
        assert!(few < all * 2 / 3, "{direction}: {few} of {all}");
    }
}

#[test]
fn comments_go_with_what_is_not_culled() {
    let text = "v p -5 5 0; v q -5 -5 0; { of q } v r -5 0 5;
        { of a } v a 5 -1 0; v b 5 1 0; v c 5 0 1;
        { gone } f (p q r); { gone as well }
        { the second } f (a b c); { behind it }
        cam -ep 0 0 0 -vc 1 0 0;";
    let written =
        String::from_utf8(run(text, &Config { cull: true, ..Config::default() }).text()).unwrap();
    let lines: Vec<&str> =
        written.lines().filter(|line| !line.starts_with("{ uglorentz")).collect();
    let expected =
        "{ of a }\nv a 5 -1 0;\nv b 5 1 0;\nv c 5 0 1;\n{ the second }\nf (a b c); { behind it }";
    assert_eq!(lines[..6].join("\n"), expected);
    assert!(lines[6].starts_with("cam "), "{written}");
}

#[test]
fn light_left_over_is_told() {
    let text = "v a -2 3 0; v b 2 3 0; v c 2 3 2; v d -2 3 2; f (a b c d); l 1 0 2 1 0;";
    let told = |light_error: f64| {
        let config = Config { measure: true, light_error, ..Config::default() };
        let report = run(text, &config).report;
        let is_said = report.details()[1].contains("light ");
        (report.remaining_errors.unwrap().light.map(|worst| worst.error), is_said)
    };
    assert_eq!(told(f64::INFINITY), (None, false));
    for bound in [0.1, 0.01] {
        let (error, is_said) = told(bound);
        assert!(
            is_said && error.is_some_and(|error| error <= bound && error > bound / 10.0),
            "{error:?}"
        );
    }
}

#[test]
fn colour_is_looked_at_on_request() {
    // Along the motion nothing bends, but D goes from blue to red.
    let text = "v a -9 1 0; v b 9 1 0; w (a b);";
    let n_new = |color_error: f64| {
        run(text, &Config { color_error, ..moving(DVec3::X * 0.9) }).report.n_new_vertices
    };
    let off = n_new(f64::INFINITY);
    let counts = [1e-1, 1e-2, DEFAULT_COLOR_ERROR].map(n_new);
    assert!(off <= counts[0] && counts[0] < counts[1] && counts[1] < counts[2], "{off} {counts:?}");
}

#[test]
fn bad_numbers_are_refused_with_a_remedy() {
    let check = |config: Config, expected: &str| {
        let error = uglorentz::apply(parse("v a 0 0 1; v b 1 0 1; v c 0 1 1; f (a b c);"), &config)
            .unwrap_err();
        assert_eq!(error.words(), expected);
        assert!(error.is_usage());
    };
    let pieces = |pieces| Config { pieces, ..Config::default() };
    check(
        moving(DVec3::X),
        "-vel: speed is 1 c: it must be below 1 (velocities are fractions of the speed of light)",
    );
    check(
        moving(DVec3::NAN),
        "-vel: velocity is not finite: its components must not be infinite or NaN",
    );
    check(pieces(Pieces::UpTo(0.0)), "the bound of -se is 0 milliradians: give a number above 0");
    check(
        pieces(Pieces::UpTo(f64::NAN)),
        "the bound of -se is NaN milliradians: give a number above 0",
    );
    check(pieces(Pieces::PerEdge(0)), "-sd 0 would make no pieces: give 1 or more");
    check(
        pieces(Pieces::PerEdge(3000)),
        "-sd would make 9000000 pieces, more than the limit of 4000000: give fewer, or use -se, which subdivides only where it is visible",
    );
}

/// In place and receding, a body is γ(1 + β) times as far away in its own frame. How far drawn
/// faces are out, in parts of the distance, goes with the size of the body, so that faces one
/// behind the other stay in order.
#[test]
fn depth_of_what_is_far_away_at_rest_goes_with_its_size() {
    let mut random = Random(17);
    for (speed, bound) in [(0.9, 1e-4), (0.99, 1e-4), (0.999, 1e-4), (0.999, 1e-3)] {
        let center = random.direction() * 4.0;
        let (vertices, faces) = prism(&mut random, center, 1.0, 5);
        let beta = center.normalize() * speed;
        let config = Config { pieces: Pieces::UpTo(bound), in_place: true, ..moving(beta) };
        let scene = seen(&text(&vertices, &faces), &config);
        let found = errors(&scene, Velocity::from_beta(beta).unwrap());
        let rest = rest(&scene);
        let nearest = rest.iter().map(|place| place.length()).fold(f64::INFINITY, f64::min);
        let reach = |from: &DVec3| rest.iter().map(|to| from.distance(*to)).fold(0.0, f64::max);
        // The box round a body may be √3 times as long as the body.
        let size = rest.iter().map(reach).fold(0.0, f64::max) * 3.0_f64.sqrt();
        let worst = found.offset.max(found.inside) * nearest / size;
        assert!(worst <= 10.0 * bound, "{speed}: {worst}");
        // Else the bound in parts of the distance would do.
        assert!(nearest / size > 10.0 || speed < 0.99, "{speed}: {nearest} {size}");
    }
}

/// A triangle that is seen from straight ahead to straight behind needs few pieces up to the
/// fastest velocity that can be written.
#[test]
fn pieces_are_bounded_at_every_speed() {
    let text = "v a -1 1 0; v b 1 1 0; v c 0 1 1; f (a b c);";
    for nines in [8, 16] {
        let speed = 1.0 - libm::pow(10.0, -f64::from(nines)).max(f64::EPSILON / 2.0);
        for direction in [DVec3::X, DVec3::Y, DVec3::NEG_Y, DVec3::Z] {
            let config = Config { measure: true, ..moving(direction * speed) };
            let report = run(text, &config).report;
            let n_faces = report.n_new_faces;
            assert!(!report.is_full && n_faces < 250_000, "{nines} {direction}: {n_faces}");
            let left = report.remaining_errors.unwrap().to_string();
            assert!(!left.contains("inf"), "{left}");
        }
    }
}

/// Texture coordinates are linear in the rest frame, however a face is cut: also of instances and
/// of bodies that turn and accelerate.
#[test]
fn texture_coordinates_are_linear_at_rest() {
    let vertex =
        |name: &str, [x, y]: [f64; 2], [u, v]: [f64; 2]| format!("v {name} {x} 3 {y} ({u} {v});\n");
    // u = 0.5 + 0.25 x, v = 0.75 - 0.5 y + 0.125 x: exact in 32 bits.
    let square = [("a", [-1.0, -1.0]), ("b", [1.0, -1.0]), ("c", [1.0, 1.0]), ("d", [-1.0, 1.0])]
        .map(|(name, [x, y])| vertex(name, [x, y], [0.5 + 0.25 * x, 0.75 - 0.5 * y + 0.125 * x]))
        .concat();
    let wheel = "motion wheel -acc .1 0 0 0 9 -spin 0 .3 0;";
    for (text, n_least) in [
        (format!("{square}f (a b c d) <.9 0 .1>;"), 20),
        (format!("def it; {square}f (a b c d); end; i (it) <.9 0 .1>;"), 20),
        (format!("{wheel}{square}f (a b c) <wheel>; f (a c d) <wheel>;"), 20),
    ] {
        for pieces in [Pieces::UpTo(1e-4), Pieces::PerEdge(6)] {
            let scene = run(&text, &Config { pieces, ..Config::default() }).scene;
            assert!(scene.vertices.len() >= n_least, "{text}: {}", scene.vertices.len());
            assert_eq!(scene.rest.len(), scene.vertices.len());
            for (vertex, place) in scene.vertices.iter().zip(&scene.rest) {
                let [u, v] = vertex.uv.unwrap().map(f64::from);
                let expected = [0.5 + 0.25 * place.x, 0.75 - 0.5 * place.z + 0.125 * place.x];
                let error = (u - expected[0]).abs().max((v - expected[1]).abs());
                assert!(error < 5e-7, "{text} {place}: {u} {v}, {expected:?}");
            }
        }
    }
}

/// Faces of a scene with textures or emitted light stay whole, as its stage says, unless a bound
/// is given or rays cannot draw it.
#[test]
fn faces_for_rays_stay_whole() {
    let corners = "v a -9 4 -9; v b 9 4 -9; v c 9 4 9; v d -9 4 9;";
    let glowing = format!("c k .5; c e 1 60 1; c_emit k e; {corners} f (a b c d) k;");
    let still = Config { velocity: None, ..Config::default() };
    let exact = moving(DVec3::X * 0.9);
    let bound = Config { is_for_rays: false, ..exact.clone() };
    let geometry = ShownEffects { contraction: false, flight_time: true };
    let partial = Config { geometry, ..exact.clone() };
    let mut flat = exact.clone();
    flat.camera.is_orthographic = true;
    let small =
        "c k .5; c e 1 60 1; c_emit k e; v a 0 9 0; v b .001 9 0; v c 0 9 .001; f (a b c) k;";
    let plain = format!("{corners} f (a b c d);");
    for (text, config, is_cut, is_whole) in [
        (&*glowing, &exact, false, true),
        (&*glowing, &bound, true, false),
        (&*glowing, &partial, true, false),
        (&*glowing, &flat, true, false),
        (&*glowing, &still, false, false),
        (&*plain, &exact, true, false),
        // Nothing that would be cut.
        (small, &exact, false, false),
    ] {
        let scene = seen(text, config);
        assert_eq!(scene.faces.len() > 1, is_cut, "{text} {config:?}");
        let stage = scene.stage.seen_geometry();
        assert_eq!(stage.is_some_and(|stage| stage.is_whole), is_whole, "{text} {config:?}");
        assert_eq!(ugscene::refuse_whole_faces(&scene).is_err(), is_whole);
    }
}

/// With a bound in pixels, small pictures have fewer pieces, no edge is off by more, and the
/// pictures of a larger size are as exact as with the same angle.
#[test]
fn pieces_follow_pixels() {
    let camera = "cam -ep 0 0 0 -vc 0 9 0 -va 90;";
    let text = format!("v a -9 4 -9; v b 9 4 -9; v c 9 4 9; v d -9 4 9; f (a b c d); {camera}");
    let mut counts = Vec::new();
    for size in [[80, 60], [320, 240], [1280, 960], [5120, 3840]] {
        let pieces = Pieces::UpToPixels(0.15);
        let color_error = f64::INFINITY;
        let exact = Config { size, color_error, measure: true, ..moving(DVec3::X * 0.9) };
        let found = run(&text, &Config { pieces, ..exact.clone() });
        let angle = found.report.remaining_errors.unwrap().angle.error;
        let pixel = 2.0 / f64::from(size[0]);
        assert!(angle <= 0.15 * pixel, "{size:?}: {angle}");
        let same = run(&text, &Config { pieces: Pieces::UpTo(0.15 * pixel), ..exact });
        assert!(found.scene.faces.len() <= same.scene.faces.len());
        counts.push(found.scene.faces.len());
    }
    assert!(counts.windows(2).all(|pair| 2 * pair[0] < pair[1]), "{counts:?}");
    // However near the colours of a bound are to each other, pieces are as large as pixels.
    let exact = Config { size: [80, 60], color_error: 1e-6, ..moving(DVec3::X * 0.9) };
    let found = run(&text, &Config { pieces: Pieces::UpToPixels(0.15), ..exact });
    assert!(found.scene.faces.len() < 100 * 80 * 60, "{}", found.scene.faces.len());
}

/// Round faces on world lines are as fine as the picture shows them.
#[test]
fn small_spheres_on_world_lines_have_few_pieces() {
    let spheres: String =
        (0..200).map(|at| format!("sphere {} 0 0 .02 <m>;", 0.01 * f64::from(at))).collect();
    let camera = "cam -ep 0 -12 3 -vc 0 0 0;";
    let text = format!("motion m -spin 0 0 .1; {spheres} {camera}");
    let found = run(&text, &Config::default());
    assert!(found.scene.faces.len() < 200 * 150, "{}", found.scene.faces.len());
    // A near one has the polygons that it has without an eye, of 1/4000 of its radius, and more where
    // edges bend.
    let near = "motion m -spin 0 0 .1; sphere 0 0 0 2 <m>; cam -ep 0 -2.2 0 -vc 0 0 0;";
    assert!(run(near, &Config::default()).scene.faces.len() >= 20_000);
}
