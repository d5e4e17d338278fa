//! T10: the edge x = 0, z = 1 of a ceiling that passes at 0.9 c.
//!
//! In the frame of the ceiling the edge and the eye span the plane x' = 0, so by (P6) the edge is seen in directions with
//! cosine −0.9 to the motion.

use super::{Measured, Sight};

const SPEED: f64 = 0.9;

/// Of the half-length of the edge, so that its ends do not count.
const WITHIN: f64 = 0.95;

pub fn measure(sight: &Sight) -> Result<Vec<Measured>, String> {
    let [width, _] = sight.size();
    let mut gaps = Vec::new();
    let right = libm::acos(-SPEED);
    for x in 0..width {
        // The ceiling begins at the edge and goes on above it.
        let Some([_, bottom]) = sight.ends_of_column(x) else { continue };
        let d = sight.camera.direction(f64::from(x) + 0.5, bottom);
        if d.z > 0.0 && (d.y / d.z).abs() < WITHIN {
            gaps.push(libm::acos(d.x) - right);
        }
    }
    if gaps.len() < 200 {
        return Err("no edge is found in the middle of the picture".to_string());
    }
    let pixel = sight.camera.pixel();
    let mean = gaps.iter().sum::<f64>() / gaps.len() as f64;
    let worst = gaps.iter().fold(0.0, |worst: f64, gap| worst.max(gap.abs()));
    Ok(vec![
        Measured::new("mean distance from the hyperbola, pixels", mean / pixel, 0.0, 0.15),
        // Half a pixel is the row; a third may be left by what a program takes for straight.
        Measured::new("largest distance from the hyperbola, pixels", worst / pixel, 0.0, 1.0),
    ])
}
