//! The colours that meet at a vertex.

use std::fmt::Write;

use ugscene::{ColorId, ColorMix, vertex_mixes};

use super::parse;

/// Every colour is on two of the faces around a vertex, so its share is twice that of a face.
#[test]
fn colours_are_counted_once_in_their_order() {
    for n_colors in [2, 3, 15, 16, 17, 18, 5000] {
        let mut text = String::from("v middle 0 0 0;\n");
        for face in 0..2 * n_colors {
            let (y, x) = libm::sincos(std::f64::consts::TAU * face as f64 / (2 * n_colors) as f64);
            let (color, next) = (face % n_colors, (face + 1) % (2 * n_colors));
            writeln!(text, "v r{face} {x} {y} 0; f (middle r{face} r{next}) c{color};").unwrap();
        }
        (0..n_colors).for_each(|color| writeln!(text, "c c{color} .5 {color};").unwrap());
        let scene = parse(&text);
        let positions: Vec<_> = scene.vertices.iter().map(|vertex| vertex.position).collect();
        let ColorMix::Mixed(parts) = &vertex_mixes(&scene, &positions)[0] else {
            panic!("{n_colors}")
        };
        assert!(
            parts
                .iter()
                .map(|part| part.0)
                .eq((0..n_colors).map(|row| Some(ColorId::from_index(row))))
        );
        assert!(
            parts.iter().all(|part| (part.1 * n_colors as f64 - 1.0).abs() < 1e-9),
            "{n_colors}"
        );
    }
}
