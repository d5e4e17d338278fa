//! The part of space that a camera shows.

use glam::DVec3;
use ugscene::{CameraOptions, CameraPoint, HalfSpace, View};

use super::parse;

/// By the matrices points are where the view has them.
#[test]
fn matrices_are_those_of_the_view() {
    let text = "v a 1 2 3; cam -ep 1 -2 3 -vc 4 5 -1 -ud 0.2 0 1 -va 70 50 -ph 0.1 0.3 0.6 0.7;";
    let view = View::new(&parse(text), &CameraOptions::default(), [40, 30]).unwrap();
    let matrices = view.matrices().unwrap();
    for point in [[4.0, 5.0, -1.0], [-7.0, 3.0, 2.5], [1e3, 0.0, 0.1]] {
        let row = [point[0], point[1], point[2], 1.0];
        let [camera, device] = matrices.map(|matrix| {
            [0, 1, 2, 3].map(|column| (0..4).map(|i| row[i] * matrix[4 * i + column]).sum::<f64>())
        });
        let CameraPoint { x, y, z } = view.place(DVec3::from_array(point) - view.eye);
        assert!((camera[2] - z).abs() < 1e-12 * z.abs() && camera[3] == 1.0, "{camera:?} {z}");
        let [right, up] = [0, 1].map(|axis| device[axis] / device[3]);
        let expected = [2.0 * x / z / 40.0 - 1.0, 1.0 - 2.0 * y / z / 30.0];
        assert!(
            (right - expected[0]).abs() < 1e-12 && (up - expected[1]).abs() < 1e-12,
            "{right} {up}"
        );
    }
    let flat =
        View::new(&parse("v a 1 2 3; cam -og;"), &CameraOptions::default(), [40, 30]).unwrap();
    assert_eq!(flat.matrices(), None);
}

/// A point has a sample in the picture where it lies in all half-spaces, and nowhere else.
#[test]
fn half_spaces_enclose_the_picture() {
    let camera = |options: &str| {
        let text = format!("v a 1 2 3; cam -ep 1 -2 3 -vc 4 5 -1 -ud 0.2 0 1 {options};");
        parse(&text)
    };
    let mut inside = 0;
    for options in ["-va 70 50", "-og -va 90 90", "-cl 2 9 -ph 0.1 0.3 0.6 0.7", "-og -cl -3 5"] {
        let view = View::new(&camera(options), &CameraOptions::default(), [40, 30]).unwrap();
        let spaces: Vec<HalfSpace> = view.half_spaces().into_iter().flatten().collect();
        assert_eq!(
            spaces.len(),
            4 + usize::from(view.is_perspective)
                + usize::from(options.contains("-cl")) * if view.is_perspective { 1 } else { 2 }
        );
        for step in 0..4000_u32 {
            // Irrational steps fill a cube evenly.
            let part = |by: f64| (f64::from(step) * by).fract() * 24.0 - 12.0;
            let p = DVec3::new(part(0.618_033_988_7), part(0.754_877_666_2), part(0.569_840_291));
            let CameraPoint { x, y, z } = view.place(p);
            let w = if view.is_perspective { z } else { 1.0 };
            let is_in_picture = (0.0..=40.0).contains(&(x / w)) && (0.0..=30.0).contains(&(y / w));
            let is_drawn = is_in_picture && view.slab.near <= z && z <= view.slab.far;
            assert_eq!(
                spaces.iter().all(|s| s.normal.dot(p) + s.offset >= 0.0),
                is_drawn,
                "{options} {p}"
            );
            inside += u32::from(is_drawn);
        }
    }
    assert!(inside > 500, "{inside}");
}
