//! T08, T09: a unit cube at 0.8 c, seen at distance 1500. At its centre one unit is 400 pixels.

use super::pixels::Dominant;
use super::{MeasuredQuantity, Picture};

const SPEED: f64 = 0.8;
const PER_UNIT: f64 = 400.0;

pub fn measure(picture: &Picture) -> Result<Vec<MeasuredQuantity>, String> {
    let [width, height] = picture.size();
    let row: Vec<Dominant> = (0..width).map(|x| picture.dominant(x, height / 2)).collect();
    let count = |hue| row.iter().filter(|&&pixel| pixel == hue).count() as f64;
    let (front, side) = (count(Dominant::Red), count(Dominant::Green));
    if front + side < 1.0 {
        return Err("neither the red nor the green face is visible in the middle row".to_string());
    }
    let last_green = row.iter().rposition(|&hue| hue == Dominant::Green);
    let first_red = row.iter().position(|&hue| hue == Dominant::Red);
    let is_left = f64::from(u8::from(last_green < first_red));
    let rest = (1.0 - SPEED * SPEED).sqrt();
    let turned_deg = libm::atan2(side, front).to_degrees();
    // Half a pixel at both ends, and the effect of perspective over the cube's depth: 1 in 3000.
    let edges = 1.2;
    Ok(vec![
        MeasuredQuantity::new("front, pixels", front, rest * PER_UNIT, edges),
        MeasuredQuantity::new("trailing side, pixels", side, SPEED * PER_UNIT, edges),
        MeasuredQuantity::new("trailing side is on the left (1) or not (0)", is_left, 1.0, 0.0),
        MeasuredQuantity::new(
            "apparent rotation, degrees",
            turned_deg,
            libm::asin(SPEED).to_degrees(),
            (edges / PER_UNIT).to_degrees() * 1.5,
        ),
    ])
}
