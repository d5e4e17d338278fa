//! Depth cueing: light fades towards the background with distance.

/// How much light of a surface is left, linear in its depth along the view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DepthFade {
    /// Depth up to which all light is left, in scene units.
    pub near: f64,
    /// Depth beyond which only `least` is left.
    pub far: f64,
    /// Part of the light left at the far end, 0…1.
    pub least: f64,
}

impl DepthFade {
    /// The part of the light left at a depth, 0…1. The background gives the rest.
    pub fn light_left(&self, depth: f64) -> f64 {
        let progress = (depth - self.near) / (self.far - self.near);
        // NaN if both ends are the same and the depth is there: a step, bright at its edge.
        let progress = if progress.is_nan() { 0.0 } else { progress.clamp(0.0, 1.0) };
        1.0 - (1.0 - self.least) * progress
    }
}
