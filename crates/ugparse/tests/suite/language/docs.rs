//! Checks the examples and tables of `docs/unigrafix.md`.

use crate::language::{flat, parse};

const PAGE: &str = include_str!("../../../../../docs/unigrafix.md");

/// The indented block that begins with `first`.
fn block(first: &str) -> String {
    let lines = PAGE.lines().skip_while(|line| line.trim_start() != first);
    let block: Vec<&str> =
        lines.take_while(|line| line.starts_with("    ") || line.is_empty()).collect();
    assert!(!block.is_empty(), "no block begins with {first}");
    block.join("\n")
}

#[test]
fn the_first_example_is_a_scene() {
    let scene = parse(block("{ A row of tiles, and a ship that flies over it at 0.6c. }"));
    assert_eq!((scene.faces.len(), scene.lights.len(), scene.cameras.len()), (9, 2, 1));
    assert_eq!(scene.names.get(scene.vertices[0].name), "floor#0:a");
    assert_eq!(
        scene.bodies.stated_velocity(scene.faces[8].body).unwrap().beta().to_array(),
        [0.6, 0.0, 0.0]
    );
    assert!(scene.faces[..8].iter().all(|face| face.body == scene.bodies.unstated()));
}

#[test]
fn the_example_of_transformations_has_correct_positions() {
    let out = flat(block("def tile ;  v a 0 0 0 ;  v b 1 0 0 ;  v c 0 1 0 ;  f (a b c) ;  end ;"));
    for line in [
        "v steep:b 1 0 2;",
        "v steep:c 0 0 3;",
        "f (left:a left:c left:b);",
        "f (steep:a steep:b steep:c);",
    ] {
        assert!(out.lines().any(|other| other.starts_with(line)), "{line}\n{out}");
    }
}

#[test]
fn the_example_of_a_flat_scene_is_as_we_write() {
    let block = block("c red 0.9 0 0.8;");
    let [color, vertex, face] = block.trim_end().lines().map(str::trim).collect::<Vec<_>>()[..]
    else {
        panic!("three lines: {block}");
    };
    let others = "v car:b 1 0 0;\nv car:c 0 1 0;\nv car:d 1 1 0;\nv car:e 2 1 0;\nv car:f 1 2 0;\n";
    let text = format!("{color}\n{vertex}\n{others}{face}\n");
    assert_eq!(flat(&text), text);
}

#[test]
fn numbers_are_written_as_shown() {
    for number in ["0.1", "100000", "-0", "6.02e+23"] {
        assert!(PAGE.contains(&format!("`{number}`")));
        assert_eq!(flat(format!("v a {number} 0 0;")), format!("v a {number} 0 0;\n"));
    }
}

#[test]
fn the_table_of_limits_is_correct() {
    for limit in ugparse::Limit::all() {
        let begin = format!("| `{}` | ", limit.name());
        let row = PAGE.lines().find(|line| line.starts_with(&begin)).expect("a row for each limit");
        let end = format!(" | {} | {} |", limit.default_value(), limit.most());
        assert!(row.ends_with(&end), "{row}");
    }
}

#[test]
fn the_examples_of_surfaces_have_the_stated_values() {
    let scene = parse(block("surf polished 0.6 0.4 0 ;"));
    let rows: Vec<_> = scene
        .surfaces
        .iter()
        .map(|s| (s.specular, s.refraction, s.exponent, s.absorption))
        .collect();
    assert_eq!(rows, [(0.4, 1.0, 20.0, 0.0), (0.1, 1.5, 60.0, 0.0), (0.1, 1.5, 60.0, 0.7)]);
}

#[test]
fn the_examples_of_stages_are_read() {
    let block = block("(ugstage 1 geometry as-seen eye 0 -12 3)");
    let examples: Vec<&str> =
        block.lines().map(str::trim).filter(|line| !line.is_empty()).collect();
    assert_eq!(examples.len(), 2);
    for example in examples {
        assert_eq!(flat(example), format!("{example}\n"));
    }
}
