//! T10: the edge x = 0, z = 1 of a ceiling that passes at 0.9 c.
//!
//! In the frame of the ceiling the edge and the eye span the plane x' = 0, so by (P6) the edge is
//! seen in directions whose angle to the motion has the cosine −0.9.

use super::{MeasuredQuantity, Picture};

const SPEED: f64 = 0.9;

/// The fraction of the edge that is measured, to exclude its ends.
const WITHIN: f64 = 0.95;

pub fn measure(picture: &Picture) -> Result<Vec<MeasuredQuantity>, String> {
    let [width, _] = picture.size();
    let mut gaps = Vec::new();
    let right = libm::acos(-SPEED);
    for x in 0..width {
        // The ceiling is above its edge in the picture.
        let Some([_, bottom]) = picture.ends_of_column(x) else { continue };
        let d = picture.camera.direction(f64::from(x) + 0.5, bottom);
        if d.z > 0.0 && (d.y / d.z).abs() < WITHIN {
            gaps.push(libm::acos(d.x) - right);
        }
    }
    if gaps.len() < 200 {
        return Err("no edge is visible in the middle of the picture".to_string());
    }
    let pixel = picture.camera.pixel();
    let mean = gaps.iter().sum::<f64>() / gaps.len() as f64;
    let worst = gaps.iter().fold(0.0, |worst: f64, gap| worst.max(gap.abs()));
    Ok(vec![
        MeasuredQuantity::new("mean distance from the hyperbola, pixels", mean / pixel, 0.0, 0.15),
        // Half a pixel for the position of the row, and up to a third for a program's bound of
        // subdivision.
        MeasuredQuantity::new(
            "largest distance from the hyperbola, pixels",
            worst / pixel,
            0.0,
            1.0,
        ),
    ])
}
