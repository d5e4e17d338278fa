//! T36: the receding green square occludes the red one; the approaching blue square is occluded by
//! it.

use super::pixels::Dominant;
use super::{MeasuredQuantity, Picture};

/// Half the width of the picture at distance 1: 15 degrees.
const HALF_ANGLE_DEG: f64 = 15.0;
/// In its own frame the green square is at this distance, with a side of 2.
const GREEN_AT: f64 = 24.0;
const GREEN_SPEED: f64 = 0.8;
const RED_AT: f64 = 10.0;
const RED_HALF: f64 = 2.0;
/// Height of a line over the green square, at the distance of the red one.
const GREEN_HEIGHT: f64 = 0.5;

pub fn measure(picture: &Picture) -> Result<Vec<MeasuredQuantity>, String> {
    let [width, height] = picture.size();
    let [middle_x, middle_y] = picture.camera.middle();
    let per_unit = middle_x / libm::tan(HALF_ANGLE_DEG.to_radians());
    let gamma = 1.0 / (1.0 - GREEN_SPEED * GREEN_SPEED).sqrt();
    // The apparent distance of the ends of the line z = 0.5 of the green square: (P3).
    let rest_distance = (GREEN_AT * GREEN_AT + 1.0 + GREEN_HEIGHT * GREEN_HEIGHT).sqrt();
    let seen_at = gamma * (GREEN_AT - GREEN_SPEED * rest_distance);
    let row = (middle_y - per_unit * GREEN_HEIGHT / seen_at) as u32;
    let count = |hue, row| (0..width).filter(|&x| picture.dominant(x, row) == hue).count() as f64;
    let (green, red) = (count(Dominant::Green, row), count(Dominant::Red, row));
    let (green_width, red_width) = (2.0 * per_unit / seen_at, 2.0 * RED_HALF * per_unit / RED_AT);
    let blue = (0..height).map(|y| count(Dominant::Blue, y)).sum();
    // Both ends of each are uncertain by half a pixel.
    Ok(vec![
        MeasuredQuantity::new(
            "green square in front of the red one, width in pixels",
            green,
            green_width,
            1.2,
        ),
        MeasuredQuantity::new(
            "red square next to it, width in pixels",
            red,
            red_width - green_width,
            2.2,
        ),
        MeasuredQuantity::new("blue square behind the red one, pixels", blue, 0.0, 0.0),
    ])
}
