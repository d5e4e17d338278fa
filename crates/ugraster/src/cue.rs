//! Depth cueing: what is far fades towards the ground.

/// What is left of the light of a surface, linear in its depth along the view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cue {
    /// Depth up to which all is left.
    pub near: f64,
    /// Depth from which on `least` is left.
    pub far: f64,
    /// Part that is left at the far end, 0…1.
    pub least: f64,
}

impl Cue {
    /// The part that is left at a depth; the rest is the light of the ground.
    pub fn part(&self, depth: f64) -> f64 {
        let way = (depth - self.near) / (self.far - self.near);
        // Ends that are one make a step.
        let way = if way.is_nan() { 0.0 } else { way.clamp(0.0, 1.0) };
        1.0 - (1.0 - self.least) * way
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn light_falls_linearly_between_two_depths() {
        let cue = Cue { near: 2.0, far: 6.0, least: 0.2 };
        for (depth, part) in [(0.0, 1.0), (2.0, 1.0), (3.0, 0.8), (4.0, 0.6), (6.0, 0.2), (60.0, 0.2)] {
            assert!((cue.part(depth) - part).abs() < 1e-15, "{depth}");
        }
        let step = Cue { near: 2.0, far: 2.0, least: 0.0 };
        assert_eq!([1.0, 2.0, 3.0].map(|depth| step.part(depth)), [1.0, 1.0, 0.0]);
    }
}
