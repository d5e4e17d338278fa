//! Reproducible random numbers for tests (SplitMix64): the same on every run and machine.

use glam::DVec3;

/// The generator; its field is the seed.
#[derive(Clone, Debug)]
pub struct Random(pub u64);

impl Random {
    /// 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A number in 0…1.
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// A number in `low`…`high`.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// A whole number below `n`, which is 1 or more.
    pub fn below(&mut self, n: usize) -> usize {
        ((self.unit() * n as f64) as usize).min(n - 1)
    }

    /// True once in `n` times.
    pub fn one_in(&mut self, n: usize) -> bool {
        self.below(n) == 0
    }

    /// One of `some`, which is not empty.
    pub fn pick<'a, T>(&mut self, some: &'a [T]) -> &'a T {
        &some[self.below(some.len())]
    }

    /// A point of the cube |x|, |y|, |z| ≤ `half`.
    pub fn in_cube(&mut self, half: f64) -> DVec3 {
        DVec3::from_array([(); 3].map(|()| self.between(-half, half)))
    }

    /// A point of the ball |p| ≤ `radius`; its distance from the center is uniformly distributed.
    pub fn in_ball(&mut self, radius: f64) -> DVec3 {
        self.direction() * radius * self.unit()
    }

    /// A unit vector, uniformly distributed over the sphere.
    pub fn direction(&mut self) -> DVec3 {
        loop {
            let point = self.in_cube(1.0);
            if point.length_squared() <= 1.0
                && let Some(direction) = point.try_normalize()
            {
                return direction;
            }
        }
    }
}
