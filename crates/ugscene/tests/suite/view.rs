//! The part of space that a camera shows.

use glam::DVec3;
use ugscene::{CameraOptions, CameraPoint, HalfSpace, View};

use super::parse;

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
            assert_eq!(spaces.iter().all(|s| s.normal.dot(p) + s.offset >= 0.0), is_drawn, "{options} {p}");
            inside += u32::from(is_drawn);
        }
    }
    assert!(inside > 500, "{inside}");
}
