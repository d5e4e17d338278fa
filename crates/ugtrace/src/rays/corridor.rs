//! Which parts shadow rays from neighbouring places to the same lamp may meet.

use super::moving_boxes::{MovingBoxes, Rays};

/// The parts that neighbouring rays may meet, found once for all of them.
#[derive(Debug, Default)]
pub struct Corridor {
    /// The rays, and their greatest time before their origins.
    rays: Option<(Rays, f64)>,
    /// Rows of parts in ascending order; `None` if they are many.
    parts: Option<Vec<usize>>,
}

impl Corridor {
    /// More parts are not tested one by one.
    const MANY: usize = 32;

    /// Origins of neighbouring rays differ by this part of their distance from the eye: by about
    /// ten pixels.
    const SPREAD: f64 = 0.01;

    /// Rays of light from afar have the same direction up to this.
    const ROUNDING: f64 = 1e-9;

    /// The parts that a ray may meet up to a time before its origin, in ascending order, and more
    /// parts; `None` if they are many.
    pub fn parts(&mut self, boxes: &MovingBoxes, ray: &Rays, end: f64) -> Option<&[usize]> {
        let is_inside = |(rays, last): &(Rays, f64)| rays.contains(ray) && end <= *last;
        if !self.rays.as_ref().is_some_and(is_inside) {
            self.widen(boxes, ray, end);
        }
        self.parts.as_deref()
    }

    /// Finds the parts around a ray.
    fn widen(&mut self, boxes: &MovingBoxes, ray: &Rays, end: f64) {
        let margin = Self::SPREAD * ray.reach();
        // Rays towards a lamp turn by their distance divided by that of the lamp.
        let rays = ray.around(margin, (4.0 * margin / end).clamp(Self::ROUNDING, 1.0));
        self.rays = rays.map(|rays| (rays, end + 4.0 * margin));
        let mut parts = self.parts.take().unwrap_or_default();
        if let Some((rays, end)) = &self.rays {
            boxes.find(rays, 0.0..*end, &mut parts);
            self.parts = (parts.len() <= Self::MANY).then_some(parts);
        }
    }
}
