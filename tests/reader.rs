//! Instances and arrays, against matrices multiplied here: where each vertex of a random tree of
//! definitions is, which way round its face is, and whose colour and velocity it has. Every
//! statement is tested in `crates/ugparse/tests/language`.

use std::fmt::Write;

use glam::{DMat4, DVec3, DVec4};
use ugscene::Scene;
use ugtesting::Random;
use ugtests::scenes;
use ugtests::worlds::spacetime::boost;

/// A transformation in words, its matrix, and whether it mirrors.
type Step = (String, DMat4, bool);

fn step(random: &mut Random) -> Step {
    let (axis, size) = (random.below(3), random.between(-2.0, 2.0));
    let letter = ["x", "y", "z"][axis];
    let along = DVec3::AXES[axis];
    let any = random.direction();
    let [x, y, z] = any.to_array();
    let degrees = *random.pick(&[90.0, 180.0, -270.0, 450.0, 25.0, -140.5]);
    let turn = |axis: DVec3, degrees: f64| DMat4::from_axis_angle(axis, f64::to_radians(degrees));
    // Scales by `k` along a unit vector.
    let stretch = |along: DVec3, k: f64| {
        let column = |axis: DVec3| (axis + (k - 1.0) * axis.dot(along) * along).extend(0.0);
        let [x, y, z] = DVec3::AXES.map(column);
        DMat4::from_cols(x, y, z, DVec4::W)
    };
    match random.below(14) {
        0 => (format!("-t{letter} {size}"), DMat4::from_translation(size * along), false),
        1 => (format!("-ta {x} {y} {z}"), DMat4::from_translation(any), false),
        2 => (format!("-tv {x} {y} {z} {size}"), DMat4::from_translation(size * any), false),
        3 => (format!("-s{letter} {size}"), stretch(along, size), false),
        4 => (format!("-sa {size}"), DMat4::from_scale(DVec3::splat(size)), false),
        5 => (format!("-sv {x} {y} {z} {size}"), stretch(any, size), false),
        6 | 7 => (format!("-r{letter} {degrees}"), turn(along, degrees), false),
        8 => {
            let turns = turn(DVec3::Z, 3.0 * size) * turn(DVec3::Y, degrees) * turn(DVec3::X, size);
            (format!("-ra {size} {degrees} {}", 3.0 * size), turns, false)
        }
        9 => (format!("-rv {x} {y} {z} {degrees}"), turn(any, degrees), false),
        10 => (format!("-m{letter}"), stretch(along, -1.0), true),
        11 => ("-ma".to_owned(), DMat4::from_scale(DVec3::NEG_ONE), true),
        12 => (format!("-mv {x} {y} {z}"), stretch(any, -1.0), true),
        _ => {
            // Rows of the text are images of the axes.
            let image = |random: &mut Random| random.in_cube(1.0);
            let rows = [image(random), image(random), image(random)];
            let words = rows.map(|row| format!("{} {} {}", row.x, row.y, row.z)).join(" ");
            let [x, y, z] = rows.map(|row| row.extend(0.0));
            (format!("-M3 {words}"), DMat4::from_cols(x, y, z, DVec4::W), false)
        }
    }
}

/// Up to three steps, in words and together.
fn steps(random: &mut Random) -> Step {
    let mut all = (String::new(), DMat4::IDENTITY, false);
    for _ in 0..random.below(4) {
        let (words, matrix, is_mirror) = step(random);
        all = (format!("{} {words}", all.0), matrix * all.1, all.2 ^ is_mirror);
    }
    all
}

/// How a definition is placed in the scene.
#[derive(Clone)]
struct Place {
    matrix: DMat4,
    is_mirrored: bool,
    /// That of the innermost instance that has one.
    color: Option<usize>,
    /// The scene from the frame in which velocities are stated.
    frame: DMat4,
}

/// What a face has to be.
#[derive(Debug)]
struct Expected {
    corners: [DVec3; 3],
    color: Option<usize>,
    velocity: DVec3,
}

/// A definition: a face of its own, and what it places.
struct Definition {
    corners: [DVec3; 3],
    color: Option<usize>,
    velocity: Option<f64>,
    placed: Vec<Placed>,
}

/// An instance, or an array of `size`.
struct Placed {
    definition: usize,
    color: Option<usize>,
    velocity: Option<f64>,
    first: Step,
    array: Option<(usize, Step)>,
}

fn optional<T>(random: &mut Random, value: impl Fn(&mut Random) -> T) -> Option<T> {
    random.one_in(2).then(|| value(random))
}

fn color(random: &mut Random) -> usize {
    random.below(3)
}

fn speed(random: &mut Random) -> f64 {
    random.between(0.1, 0.9)
}

/// The boost by a velocity along x, turned with the instance.
fn stated(speed: Option<f64>, placed: DMat4) -> DMat4 {
    let speed = speed.unwrap_or(0.0);
    boost(speed * placed.transform_vector3(DVec3::X).normalize())
}

impl Definition {
    /// The one of this row, which places those before it.
    fn random(random: &mut Random, row: usize) -> Self {
        let placed = |random: &mut Random| Placed {
            definition: random.below(row),
            color: optional(random, color),
            velocity: optional(random, speed),
            first: steps(random),
            array: optional(random, |random| (random.below(4), steps(random))),
        };
        let n_placed = if row == 0 { 0 } else { random.below(4) };
        Self {
            corners: [(); 3].map(|()| random.in_cube(1.0)),
            color: optional(random, color),
            velocity: optional(random, speed),
            placed: (0..n_placed).map(|_| placed(random)).collect(),
        }
    }

    fn text(&self) -> String {
        let color = |color: Option<usize>| color.map_or_else(String::new, |row| format!("k{row}"));
        let tail =
            |beta: Option<f64>| beta.map_or_else(String::new, |beta| format!("<{beta} 0 0>"));
        let mut text = String::new();
        for (name, p) in ["a", "b", "c"].iter().zip(self.corners) {
            writeln!(text, "v {name} {} {} {};", p.x, p.y, p.z).unwrap();
        }
        writeln!(text, "f (a b c) {} {};", color(self.color), tail(self.velocity)).unwrap();
        for placed in &self.placed {
            let inside =
                format!("d{} {} {}", placed.definition, color(placed.color), placed.first.0);
            let tail = tail(placed.velocity);
            match &placed.array {
                Some((size, step)) => {
                    writeln!(text, "a ({inside}) {size} {} {tail};", step.0).unwrap()
                }
                None => writeln!(text, "i ({inside}) {tail};").unwrap(),
            }
        }
        text
    }

    /// The faces of this definition at a place, and of all that it places.
    fn expand(&self, all: &[Self], place: &Place, faces: &mut Vec<Expected>) {
        let mut corners = self.corners.map(|corner| place.matrix.transform_point3(corner));
        if place.is_mirrored {
            corners.swap(1, 2);
        }
        let moving = place.frame * stated(self.velocity, place.matrix);
        let velocity = moving.w_axis.truncate() / moving.w_axis.w;
        faces.push(Expected { corners, color: self.color.or(place.color), velocity });
        for placed in &self.placed {
            let (size, step) =
                placed.array.as_ref().map_or((1, None), |(size, step)| (*size, Some(step)));
            let (_, mut matrix, mut is_mirror) = placed.first.clone();
            for _ in 0..size {
                let inner = Place {
                    matrix: place.matrix * matrix,
                    is_mirrored: place.is_mirrored ^ is_mirror,
                    color: placed.color.or(place.color),
                    frame: place.frame * stated(placed.velocity, place.matrix),
                };
                all[placed.definition].expand(all, &inner, faces);
                if let Some((_, more, mirrors)) = step {
                    (matrix, is_mirror) = (*more * matrix, is_mirror ^ mirrors);
                }
            }
        }
    }
}

#[track_caller]
fn check(scene: &Scene, expected: &[Expected], text: &str) {
    assert_eq!(scene.faces.len(), expected.len(), "{text}");
    let size = expected
        .iter()
        .flat_map(|face| face.corners)
        .fold(1.0, |size, p| p.abs().max_element().max(size));
    for (face, expected) in scene.faces.iter().zip(expected) {
        let contour = scene.face_contours(face).next().unwrap();
        for (corner, expected) in contour.iter().zip(expected.corners) {
            // The reader multiplies in another order.
            let off = (scene.vertices[corner.index()].position - expected).length();
            assert!(off < 1e-12 * size, "{off}: {expected:?}\n{text}");
        }
        let color = face.color.map(|color| scene.names.get(scene.colors[color.index()].name));
        assert_eq!(color, expected.color.map(|row| ["k0", "k1", "k2"][row]), "{text}");
        let beta = scene.bodies.velocity(face.body).beta();
        assert!((beta - expected.velocity).length() < 1e-13, "{beta}: {expected:?}\n{text}");
    }
}

#[test]
fn instances_are_where_their_matrices_say() {
    let mut n_faces = 0;
    for seed in 0..400 {
        let random = &mut Random(seed);
        let all: Vec<Definition> = (0..5).map(|row| Definition::random(random, row)).collect();
        let (scene, definitions) = all.split_last().unwrap();
        let mut text = "c k0 1; c k1 .5 20; c k2 1 100;\n".to_owned();
        for (row, definition) in definitions.iter().enumerate() {
            write!(text, "def d{row};\n{}end;\n", definition.text()).unwrap();
        }
        text += &scene.text();
        let mut expected = Vec::new();
        let place = Place {
            matrix: DMat4::IDENTITY,
            is_mirrored: false,
            color: None,
            frame: DMat4::IDENTITY,
        };
        scene.expand(&all, &place, &mut expected);
        check(&scenes::parse(text.as_bytes()), &expected, &text);
        n_faces += expected.len();
    }
    assert!(n_faces > 2500, "{n_faces}");
}
