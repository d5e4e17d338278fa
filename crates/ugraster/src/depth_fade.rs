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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn light_falls_linearly_between_two_depths() {
        let fade = DepthFade { near: 2.0, far: 6.0, least: 0.2 };
        for (depth, part) in [(0.0, 1.0), (2.0, 1.0), (3.0, 0.8), (4.0, 0.6), (6.0, 0.2), (60.0, 0.2)] {
            assert!((fade.light_left(depth) - part).abs() < 1e-15, "{depth}");
        }
        let step = DepthFade { near: 2.0, far: 2.0, least: 0.0 };
        assert_eq!([1.0, 2.0, 3.0].map(|depth| step.light_left(depth)), [1.0, 1.0, 0.0]);
    }
}
