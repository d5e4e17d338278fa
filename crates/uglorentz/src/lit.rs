//! Where the light of near lamps changes too much along an edge (`-sl`).
//!
//! Programs downstream that put light into vertex colours go in straight lines between. On a point of a face with normal n the
//! light of a lamp is n·l D_l, with l towards the lamp and D_l of (P14), and neighbouring faces have normals of their
//! own. So the rule asks for the vector D_l l, which is common to all of them (E6). Lamps far away and ambient light do not
//! change along an edge.

use glam::DVec3;
use uglight::{HueScale, LampPlace, lamps};
use ugparse::Scene;
use ugphysics::{Velocity, illumination};

use crate::early_accept::MOST_BEND;
use crate::motion::{Motion, Point};

/// Where an edge is compared with the straight line, parts of it.
const SAMPLES: [f64; 3] = [0.25, 0.5, 0.75];

/// An edge is halved this often at most for the sake of light: a lamp may lie on a face.
const MAX_GENERATION: u32 = 12;

/// The lamps of a scene that edges are cut for; none if nobody asks.
#[derive(Clone, Debug, Default)]
pub(crate) struct Lit {
    lamps: Vec<NearLamp>,
    bound: f64,
}

#[derive(Clone, Debug)]
struct NearLamp {
    /// The brightest channel of its colour times its intensity.
    intensity: f64,
    /// Relative to the eye in the frame of the lamp, in the axes of [`Motion::turned`]; of a lamp without a velocity in those
    /// of the scene.
    place: DVec3,
    /// None for a lamp that rests with whatever it lights.
    velocity: Option<Velocity>,
}

impl Lit {
    /// `scene`: with its lights in place. `bound`: part of the light of a lamp that shines straight at a face, infinite
    /// for any.
    pub(crate) fn new(scene: &Scene, eye: DVec3, motions: &[Motion], bound: f64) -> Self {
        if bound == f64::INFINITY {
            return Self::default();
        }
        let near = lamps(scene, eye, HueScale::Degrees).into_iter().filter_map(|lamp| {
            let LampPlace::At(place) = lamp.place else { return None };
            let motion = lamp.motion.body().map(|body| &motions[body.index()]);
            let place = motion.map_or(place, |motion| motion.turned(place));
            let velocity = motion.map(Motion::velocity);
            Some(NearLamp { intensity: lamp.color.max_element(), place, velocity })
        });
        Self { lamps: near.filter(|lamp| lamp.intensity > 0.0).collect(), bound }
    }

    /// Is there nothing to cut for?
    pub(crate) fn is_empty(&self) -> bool {
        self.lamps.is_empty()
    }

    /// Does the light change by more than a straight line along this edge? Give the ends in the same order whenever you ask for
    /// the same edge.
    pub(crate) fn is_uneven(&self, a: &Point, b: &Point, motion: &Motion) -> bool {
        !self.is_empty()
            && a.generation.max(b.generation) < MAX_GENERATION
            && self.error(a, b, motion) > self.bound
    }

    /// The error of the light on an edge, of all lamps.  (E6)
    pub(crate) fn error(&self, a: &Point, b: &Point, motion: &Motion) -> f64 {
        self.lamps.iter().map(|lamp| lamp.intensity * lamp.error(a.rest, b.rest, motion)).sum()
    }

    /// True only if the light changes by no more than a straight line between any of these corners.
    pub(crate) fn is_even<'a>(
        &self,
        motion: &Motion,
        corners: impl Iterator<Item = &'a Point> + Clone,
    ) -> bool {
        if self.is_empty() {
            return true;
        }
        let of_lamp = |lamp: &NearLamp| lamp.intensity * lamp.most_error(motion, corners.clone());
        self.lamps.iter().map(of_lamp).sum::<f64>() <= self.bound
    }
}

impl NearLamp {
    /// How far the light and its wavelength are off the straight line between the ends, in parts of what they are.  (E6)
    fn error(&self, a: DVec3, b: DVec3, motion: &Motion) -> f64 {
        // At the lamp itself there is no direction, and nothing to compare with.
        let (Some(from), Some(to)) = (self.light(a, motion), self.light(b, motion)) else { return 0.0 };
        let at = |s: f64| {
            let Some(light) = self.light(a.lerp(b, s), motion) else { return 0.0 };
            let off = (light.toward - from.toward.lerp(to.toward, s)).length() / light.doppler;
            let straight = (1.0 - s) / from.doppler + s / to.doppler;
            f64::max(off, (straight * light.doppler - 1.0).abs())
        };
        SAMPLES.into_iter().map(at).fold(0.0, f64::max)
    }

    /// Upper bound of [`NearLamp::error`] between any of these corners; infinite for a lamp that moves against them.
    ///
    /// Along a line that comes no nearer than r to the lamp, |d²l/dx²| ≤ 2/√3 / r², as for D in [`crate::color`].
    fn most_error<'a>(&self, motion: &Motion, mut corners: impl Iterator<Item = &'a Point>) -> f64 {
        let Some(first) = corners.next() else { return 0.0 };
        let Some(place) = self.place_with(motion) else { return f64::INFINITY };
        let reach = corners.map(|corner| (corner.rest - first.rest).length()).fold(0.0, f64::max);
        let nearest = (place - first.rest).length() - reach;
        // Edges are no longer than twice the reach.
        if nearest > 0.0 { MOST_BEND / 2.0 * (reach / nearest) * (reach / nearest) } else { f64::INFINITY }
    }

    /// Where it is in the rest frame of a body, if it rests there.
    fn place_with(&self, motion: &Motion) -> Option<DVec3> {
        match self.velocity {
            None => Some(motion.turned(self.place)),
            Some(velocity) => (velocity == motion.velocity()).then_some(self.place),
        }
    }

    fn light(&self, rest: DVec3, motion: &Motion) -> Option<Light> {
        if let Some(place) = self.place_with(motion) {
            return Some(Light { toward: (place - rest).try_normalize()?, doppler: 1.0 });
        }
        let light = illumination(rest, motion.velocity(), self.place, self.velocity?)?;
        Some(Light { toward: light.toward * light.doppler, doppler: light.doppler })
    }
}

/// What falls on a point.
struct Light {
    /// D_l l.
    toward: DVec3,
    /// D_l.
    doppler: f64,
}

#[cfg(test)]
mod tests {
    use ugscene::Geometry;

    use super::*;

    /// On a line that passes a resting lamp at a distance of 1, the light on a floor is 1/√(1 + x²): by hand, the largest
    /// error of chords of half the length is about a quarter.
    #[test]
    fn the_error_is_that_of_the_chord() {
        let motion = Motion::new(Velocity::ZERO, Geometry::default());
        let lamp = NearLamp { intensity: 1.0, place: DVec3::Z, velocity: None };
        let level = |x: f64| 1.0 / (1.0 + x * x).sqrt();
        for (from, to) in [(-0.2, 0.3), (0.5, 0.9), (-3.0, 2.0), (1.0, 1.1)] {
            let error = lamp.error(DVec3::X * from, DVec3::X * to, &motion);
            for step in 0..=4 {
                let s = f64::from(step) / 4.0;
                let off = level(from + s * (to - from)) - (1.0 - s) * level(from) - s * level(to);
                assert!(off.abs() <= error + 1e-15, "{from} {to}: {off} {error}");
            }
            let half = lamp.error(DVec3::X * from, DVec3::X * f64::midpoint(from, to), &motion);
            assert!(half < 0.6 * error, "{from} {to}: {half} {error}");
        }
        assert_eq!(lamp.error(DVec3::Z, DVec3::ZERO, &motion), 0.0);
    }

    /// The same lamp, floor and edge in motion together are as at rest; against each other D_l counts.
    #[test]
    fn only_motion_against_each_other_counts() {
        let fast = Velocity::from_beta(DVec3::new(0.8, 0.0, 0.0)).unwrap();
        let (at_rest, moving) =
            (Motion::new(Velocity::ZERO, Geometry::default()), Motion::new(fast, Geometry::default()));
        let lamp = |velocity| NearLamp { intensity: 1.0, place: DVec3::new(1.0, 5.0, 2.0), velocity };
        let (a, b) = (DVec3::new(0.0, 5.0, 0.0), DVec3::new(1.5, 6.0, 0.0));
        let rest = lamp(None).error(a, b, &at_rest);
        assert_eq!(lamp(Some(fast)).error(a, b, &moving), rest);
        assert_eq!(lamp(None).error(a, b, &moving), rest);
        assert!((lamp(Some(fast)).error(a, b, &at_rest) - rest).abs() > 1e-3 * rest);
    }

    /// What is called even for sure is so, on lines between any corners.
    #[test]
    fn what_is_even_for_sure_is_even() {
        let step = |k: u32, seed: f64| (f64::from(k) * seed).fract() * 2.0 - 1.0;
        let motion = Motion::new(Velocity::from_beta(DVec3::X * 0.6).unwrap(), Geometry::default());
        let (mut n_even, mut n_uneven) = (0, 0);
        for k in 1..2000_u32 {
            let point = |p, q, r| DVec3::new(step(k, p), step(k, q), step(k, r));
            let place = point(0.123_106, 0.872_983, 0.358_899);
            let lamp = NearLamp { intensity: 1.0, place, velocity: None };
            let lit = Lit { lamps: vec![lamp], bound: 1e-2 };
            let size = libm::pow(10.0, -f64::from(k % 12) / 4.0);
            let a = point(0.618_034, 0.414_214, 0.732_051);
            let corners = [a, a + point(0.236_068, 0.645_751, 0.316_625) * size, a + DVec3::Z * size];
            let corners = corners.map(|corner| motion.point(0, corner));
            if lit.is_even(&motion, corners.iter()) {
                n_even += 1;
                let pairs = [(0, 1), (1, 2), (0, 2)];
                assert!(pairs.iter().all(|&(i, j)| !lit.is_uneven(&corners[i], &corners[j], &motion)));
            } else {
                n_uneven += 1;
            }
        }
        assert!(n_even > 300 && n_uneven > 300, "{n_even} {n_uneven}");
    }
}
