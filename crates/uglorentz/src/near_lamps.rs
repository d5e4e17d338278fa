//! Edges along which the light of near lamps is not linear (`-sl`).
//!
//! Programs downstream add light to the colours of vertices and interpolate it linearly. The light
//! of a lamp on a face with normal n is n·l D_l F, with l towards the lamp, D_l of (P14), and F the
//! fall-off of its light with distance, if it has one. Faces that share an edge have different
//! normals, so the criterion tests the vector D_l F l, which they share (E6). Directional light
//! changes along an edge only where its body, or that of the edge, is on a world line; ambient
//! light is left out. The light of lamps on world lines, of lamps whose colour changes, and on
//! bodies on world lines is sampled ([`SampledLamps`]).

use glam::DVec3;
use uglight::{FallOff, Lamp, LampPlace, Lamps, ScatteringTime, SurfaceElement};
use ugphysics::{Velocity, illumination};
use ugscene::{Beam, BodyId, RestFrames, Scene};

use crate::early_accept::MOST_BEND;
use crate::relative_motion::{Point, RelativeMotion};

/// Where on an edge the light is compared with its linear interpolation.
const SAMPLES: [f64; 3] = [0.25, 0.5, 0.75];

/// The power of D_l in proportion to which light with a shifted spectrum grows: that of spectral
/// radiance per wavelength.  Eq. (P19)
const SPECTRAL_POWER: f64 = 5.0;

/// The limit of halvings for light alone, since a lamp may lie on a face.
const MAX_GENERATION: u32 = 12;

/// The lamps of a scene that edges are subdivided for; empty if not requested.
#[derive(Clone, Debug, Default)]
pub(crate) struct NearLamps {
    /// At rest or with constant velocity, for bodies with constant velocity.
    lamps: Vec<NearLamp>,
    sampled: Option<SampledLamps>,
    /// For each body the shift of lamps that rest with what they light, in the axes of
    /// [`RelativeMotion::turned`].
    shifts: Vec<DVec3>,
    bound: f64,
}

#[derive(Clone, Debug)]
struct NearLamp {
    /// The largest component of its colour times its intensity.
    intensity: f64,
    /// Relative to the eye, in the rest frame of the lamp: in the axes of
    /// [`RelativeMotion::turned`], or in those of the scene if its velocity is `None`.
    place: DVec3,
    /// `None` for a lamp that rests in the frame of whatever it lights.
    velocity: Option<Velocity>,
    fall_off: Option<FallOff>,
}

impl NearLamps {
    /// `scene`: with its lights shifted and its stage as seen. `bound`: relative to
    /// the light of a lamp at normal incidence; infinite for none.
    pub(crate) fn new(scene: &Scene, eye: DVec3, motions: &[RelativeMotion], bound: f64) -> Self {
        if bound == f64::INFINITY {
            return Self::default();
        }
        let lamps = Lamps::new(scene, eye, false).over_time(scene, eye, false);
        let frames = RestFrames::new(scene);
        let is_sampled = |lamp: &Lamp| is_sampled(lamp, &frames);
        let is_steady = |lamp: &&Lamp| lamp.color_of.is_none() && !is_sampled(lamp);
        let near = lamps.iter().filter(is_steady).filter_map(|lamp| {
            let LampPlace::At(place) = lamp.place else { return None };
            let motion = lamp.motion.body().map(|body| &motions[body.index()]);
            let place = motion.map_or(place, |motion| motion.turned(place));
            let velocity = motion.map(RelativeMotion::velocity);
            let intensity = lamp.color.max_element();
            Some(NearLamp { intensity, place, velocity, fall_off: lamp.fall_off })
        });
        let shift =
            |(body, motion): (BodyId, &RelativeMotion)| motion.turned(frames.lamp_shift(body));
        let near: Vec<NearLamp> = near.filter(|lamp| lamp.intensity > 0.0).collect();
        let are_sampled = !lamps.is_empty()
            && (lamps.iter().any(|lamp| !is_steady(&lamp))
                || motions.iter().any(|motion| motion.world_line().is_some()));
        Self {
            lamps: near,
            shifts: scene.bodies.ids().zip(motions).map(shift).collect(),
            sampled: are_sampled
                .then(|| SampledLamps { lamps: lamps.clone(), frames: frames.clone() }),
            bound,
        }
    }

    /// True if light adds no criterion.
    pub(crate) fn is_empty(&self) -> bool {
        self.lamps.is_empty() && self.sampled.is_none()
    }

    /// Is the error of linear interpolation along this edge above the bound? The ends of an edge
    /// must always be given in the same order.
    pub(crate) fn is_nonlinear(&self, a: &Point, b: &Point, motion: &RelativeMotion) -> bool {
        !self.is_empty()
            && a.generation.max(b.generation) < MAX_GENERATION
            && self.error(a, b, motion) > self.bound
    }

    /// The error of the light on an edge, of all lamps.  (E6)
    pub(crate) fn error(&self, a: &Point, b: &Point, motion: &RelativeMotion) -> f64 {
        let sampled = self.sampled.as_ref().map_or(0.0, |sampled| sampled.error(a, b, motion));
        if motion.world_line().is_some() {
            return sampled;
        }
        let shift = self.shift(a.body);
        let error = |lamp: &NearLamp| lamp.intensity * lamp.error(a.rest, b.rest, motion, shift);
        self.lamps.iter().map(error).sum::<f64>() + sampled
    }

    /// Does the light at the middle of a triangle jump against that at its corners?
    pub(crate) fn jumps_inside(&self, corners: [&Point; 3], motion: &RelativeMotion) -> bool {
        let Some(sampled) = &self.sampled else { return false };
        corners.iter().all(|corner| corner.generation < MAX_GENERATION)
            && sampled.jumps(corners, motion)
    }

    fn shift(&self, body: BodyId) -> DVec3 {
        self.shifts.get(body.index()).copied().unwrap_or_default()
    }

    /// True only if the error is below the bound on every line between these corners.
    pub(crate) fn is_surely_linear<'a>(
        &self,
        motion: &RelativeMotion,
        corners: impl Iterator<Item = &'a Point> + Clone,
    ) -> bool {
        if self.is_empty() {
            return true;
        }
        if self.sampled.as_ref().is_some_and(|sampled| sampled.any(motion)) {
            return false;
        }
        let shift = corners.clone().next().map_or(DVec3::ZERO, |corner| self.shift(corner.body));
        let of_lamp =
            |lamp: &NearLamp| lamp.intensity * lamp.most_error(motion, corners.clone(), shift);
        self.lamps.iter().map(of_lamp).sum::<f64>() <= self.bound
    }
}

impl NearLamp {
    /// The relative errors of light, wavelength and shifted spectra, interpolated linearly between
    /// the ends. That of light is relative to the light at the point if it is brighter than the
    /// intensity of the lamp, else to that.  (E6)
    fn error(&self, a: DVec3, b: DVec3, motion: &RelativeMotion, shift: DVec3) -> f64 {
        let light = |point: DVec3| self.light(point, motion, shift);
        // At the lamp itself the direction is undefined.
        let (Some(from), Some(to)) = (light(a), light(b)) else { return 0.0 };
        let at = |s: f64| {
            let Some(light) = light(a.lerp(b, s)) else { return 0.0 };
            let off = (light.toward - from.toward.lerp(to.toward, s)).length() / light.doppler;
            let off = off / light.part.max(1.0);
            let straight = (1.0 - s) / from.doppler + s / to.doppler;
            let power = |doppler: f64| libm::pow(doppler / light.doppler, SPECTRAL_POWER);
            let spectral = (1.0 - s) * power(from.doppler) + s * power(to.doppler);
            off.max((straight * light.doppler - 1.0).abs()).max((spectral - 1.0).abs())
        };
        SAMPLES.into_iter().map(at).fold(0.0, f64::max)
    }

    /// Upper bound of [`NearLamp::error`] between any of these corners; infinite for a lamp that
    /// moves relative to them.
    ///
    /// Along a line at a distance of at least r from the lamp, |d²l/dx²| ≤ 2/√3 / r², as for D in
    /// [`crate::color`], and |d²(F l)/dx²| ≤ 6F/r² for F ∝ 1/r²: the second derivative of 1/r²
    /// towards the lamp.
    fn most_error<'a>(
        &self,
        motion: &RelativeMotion,
        mut corners: impl Iterator<Item = &'a Point>,
        shift: DVec3,
    ) -> f64 {
        let Some(first) = corners.next() else { return 0.0 };
        let Some(place) = self.position_at_rest_with(motion, shift) else { return f64::INFINITY };
        let reach = corners.map(|corner| (corner.rest - first.rest).length()).fold(0.0, f64::max);
        let nearest = (place - first.rest).length() - reach;
        // Edges are at most twice as long as `reach`.
        let bend = match self.fall_off {
            None => MOST_BEND,
            // The light is a field like that of a charge.
            Some(fall_off) if fall_off.is_outside(nearest) => 6.0 * fall_off.at(nearest),
            Some(_) => return f64::INFINITY,
        };
        if nearest > 0.0 {
            bend / 2.0 * (reach / nearest) * (reach / nearest)
        } else {
            f64::INFINITY
        }
    }

    /// Its position in the rest frame of a body, if it rests there. `shift`: see
    /// [`NearLamps::shifts`].
    fn position_at_rest_with(&self, motion: &RelativeMotion, shift: DVec3) -> Option<DVec3> {
        match self.velocity {
            None => Some(motion.turned(self.place) + shift),
            Some(velocity) => (velocity == motion.velocity()).then_some(self.place),
        }
    }

    fn light(&self, rest: DVec3, motion: &RelativeMotion, shift: DVec3) -> Option<Light> {
        if let Some(place) = self.position_at_rest_with(motion, shift) {
            let part = self.part_at((place - rest).length());
            return Some(Light {
                toward: (place - rest).try_normalize()? * part,
                doppler: 1.0,
                part,
            });
        }
        let light = illumination(rest, 0.0, motion.velocity(), self.place, self.velocity?)?;
        let part = self.part_at(light.rest_distance);
        Some(Light { toward: light.toward * (light.doppler * part), doppler: light.doppler, part })
    }

    /// F, the fall-off at a distance in the rest frame of the lamp.
    fn part_at(&self, rest_distance: f64) -> f64 {
        self.fall_off.map_or(1.0, |fall_off| fall_off.at(rest_distance))
    }
}

/// True if a lamp is on a world line, changes, or shines in a cone or from an area.
fn is_sampled(lamp: &Lamp, frames: &RestFrames) -> bool {
    let is_on_line = lamp.motion.body().is_some_and(|body| frames.world_line(body).is_some());
    is_on_line || lamp.table.is_some() || lamp.beam != Beam::Even
}

/// Lamps whose light is computed as programs downstream compute it: those that [`is_sampled`]
/// names, and all of them on bodies on world lines.
#[derive(Clone, Debug)]
struct SampledLamps {
    lamps: Lamps,
    frames: RestFrames,
}

/// The light of a lamp at a point.
#[derive(Clone, Copy)]
struct Sample {
    /// Level · D_l F l, with the level of the colour that the lamp has.
    light: DVec3,
    /// D_l.
    doppler: f64,
    /// F.
    part: f64,
    /// The row of its table, for a lamp that changes.
    step: f64,
}

impl SampledLamps {
    /// The lamps that are sampled for a body.
    fn of(&self, motion: &RelativeMotion) -> impl Iterator<Item = &Lamp> {
        let is_sampled = |lamp: &Lamp| is_sampled(lamp, &self.frames);
        let all = motion.world_line().is_some();
        self.lamps.iter().filter(move |lamp| lamp.color_of.is_none() && (all || is_sampled(lamp)))
    }

    fn any(&self, motion: &RelativeMotion) -> bool {
        self.of(motion).next().is_some()
    }

    fn sample(&self, lamp: &Lamp, point: &Point, motion: &RelativeMotion) -> Option<Sample> {
        let own = motion.world_line().map(|_| ScatteringTime::Own(point.own_time));
        let time = own.unwrap_or(ScatteringTime::Delay(0.0));
        let place = motion.turned_back(point.rest);
        let element = SurfaceElement { point: place, time, normal: DVec3::ZERO, body: point.body };
        let (toward, doppler, part) = element.light_from(lamp, &self.frames)?;
        let (level, step) = match &lamp.table {
            None => (lamp.color.max_element(), 0.0),
            Some(table) => {
                let own_time = element.lamp_time(lamp, lamp.place, &self.frames)?;
                let level =
                    |(row, share): (u32, f64)| share * self.lamps[row as usize].color.max_element();
                (table.at(own_time).map(level).iter().sum(), table.step(own_time))
            }
        };
        Some(Sample { light: level * doppler * part * toward, doppler, part, step })
    }

    /// The error of the light on an edge, as of [`NearLamp::error`], but relative to the light that
    /// arrives there at normal incidence: a lamp in motion may always be far away. A jump lies in
    /// some edge, however short, so it does not count in edges that are not cut further.
    fn error(&self, a: &Point, b: &Point, motion: &RelativeMotion) -> f64 {
        let middles = SAMPLES.map(|s| Point::between(motion, a, b, s));
        let is_shortest = a.generation.max(b.generation) >= MAX_GENERATION;
        let of_lamp = |lamp: &Lamp| {
            let sample = |point: &Point| self.sample(lamp, point, motion);
            let (Some(from), Some(to)) = (sample(a), sample(b)) else { return 0.0 };
            let at = |(s, point): (f64, &Point)| {
                let Some(light) = sample(point) else { return 0.0 };
                if is_jump(lamp, from, light) || is_jump(lamp, light, to) {
                    return if is_shortest { 0.0 } else { brightest(lamp, &self.lamps) };
                }
                let off = (light.light - from.light.lerp(to.light, s)).length();
                let power = |doppler: f64| libm::pow(doppler / light.doppler, SPECTRAL_POWER);
                let spectral = (1.0 - s) * power(from.doppler) + s * power(to.doppler) - 1.0;
                off.max(spectral.abs() * light.light.length()) / (light.doppler * light.part)
            };
            SAMPLES.into_iter().zip(&middles).map(at).fold(0.0, f64::max)
        };
        self.of(motion).map(of_lamp).sum()
    }

    fn jumps(&self, corners: [&Point; 3], motion: &RelativeMotion) -> bool {
        let middle = Point::middle(motion, corners);
        self.of(motion).filter(|lamp| lamp.table.is_some()).any(|lamp| {
            let sample = |point: &Point| self.sample(lamp, point, motion);
            let here = sample(&middle);
            corners.into_iter().any(|corner| {
                sample(corner).zip(here).is_some_and(|(there, here)| is_jump(lamp, there, here))
            })
        })
    }
}

/// True if samples of a table do not show how the colour changes between two points.
fn is_jump(lamp: &Lamp, a: Sample, b: Sample) -> bool {
    let most =
        |table: &std::sync::Arc<uglight::LampTable>| if table.is_stepped() { 0.0 } else { 1.0 };
    lamp.table.as_ref().is_some_and(|table| (a.step - b.step).abs() > most(table))
}

/// The level of the brightest colour of a lamp that changes.
fn brightest(lamp: &Lamp, lamps: &Lamps) -> f64 {
    let row = lamps.iter().position(|other| std::ptr::eq(other, lamp)).map(|row| row as u32);
    let colors = lamps.iter().filter(|other| other.color_of.is_some() && other.color_of == row);
    colors.map(|color| color.color.max_element()).fold(0.0, f64::max)
}

/// The light of a lamp at a point.
struct Light {
    /// D_l F l.
    toward: DVec3,
    /// D_l.
    doppler: f64,
    /// F.
    part: f64,
}

#[cfg(test)]
mod tests {
    use ugscene::ShownEffects;

    use super::*;

    /// Below a lamp at height 1, the light on a floor is 1/√(1 + x²). Halving a chord reduces its
    /// error to about a quarter.
    #[test]
    fn the_error_is_that_of_the_chord() {
        let motion = RelativeMotion::new(Velocity::ZERO, ShownEffects::default());
        let lamp = NearLamp { intensity: 1.0, place: DVec3::Z, velocity: None, fall_off: None };
        let level = |x: f64| 1.0 / (1.0 + x * x).sqrt();
        for (from, to) in [(-0.2, 0.3), (0.5, 0.9), (-3.0, 2.0), (1.0, 1.1)] {
            let error = lamp.error(DVec3::X * from, DVec3::X * to, &motion, DVec3::ZERO);
            for step in 0..=4 {
                let s = f64::from(step) / 4.0;
                let off = level(from + s * (to - from)) - (1.0 - s) * level(from) - s * level(to);
                assert!(off.abs() <= error + 1e-15, "{from} {to}: {off} {error}");
            }
            let half = lamp.error(
                DVec3::X * from,
                DVec3::X * f64::midpoint(from, to),
                &motion,
                DVec3::ZERO,
            );
            assert!(half < 0.6 * error, "{from} {to}: {half} {error}");
        }
        assert_eq!(lamp.error(DVec3::Z, DVec3::ZERO, &motion, DVec3::ZERO), 0.0);
    }

    /// The same for light that falls off: 4/(1 + x²)^(3/2) on the floor. Where it is brighter than
    /// the intensity, the error is relative.
    #[test]
    fn light_that_falls_off_has_the_error_of_its_chord() {
        let motion = RelativeMotion::new(Velocity::ZERO, ShownEffects::default());
        let fall_off = Some(FallOff::new(2.0, 0.0));
        let lamp = NearLamp { intensity: 1.0, place: DVec3::Z, velocity: None, fall_off };
        let level = |x: f64| 4.0 * libm::pow(1.0 + x * x, -1.5);
        for (from, to) in [(-0.2, 0.3), (0.5, 0.9), (-3.0, 2.0), (1.0, 1.1), (4.0, 6.0)] {
            let error = lamp.error(DVec3::X * from, DVec3::X * to, &motion, DVec3::ZERO);
            for step in 0..=4 {
                let s = f64::from(step) / 4.0;
                let x = from + s * (to - from);
                let off = level(x) - (1.0 - s) * level(from) - s * level(to);
                let off = off / (4.0 / (1.0 + x * x)).max(1.0);
                assert!(off.abs() <= error + 1e-15, "{from} {to}: {off} {error}");
            }
        }
    }

    /// Lamp and edge in common motion are as at rest; in relative motion D_l matters.
    #[test]
    fn only_relative_motion_matters() {
        let fast = Velocity::from_beta(DVec3::new(0.8, 0.0, 0.0)).unwrap();
        let (at_rest, moving) = (
            RelativeMotion::new(Velocity::ZERO, ShownEffects::default()),
            RelativeMotion::new(fast, ShownEffects::default()),
        );
        let lamp = |velocity| NearLamp {
            intensity: 1.0,
            place: DVec3::new(1.0, 5.0, 2.0),
            velocity,
            fall_off: None,
        };
        let (a, b) = (DVec3::new(0.0, 5.0, 0.0), DVec3::new(1.5, 6.0, 0.0));
        let rest = lamp(None).error(a, b, &at_rest, DVec3::ZERO);
        assert_eq!(lamp(Some(fast)).error(a, b, &moving, DVec3::ZERO), rest);
        assert_eq!(lamp(None).error(a, b, &moving, DVec3::ZERO), rest);
        assert!((lamp(Some(fast)).error(a, b, &at_rest, DVec3::ZERO) - rest).abs() > 1e-3 * rest);
    }

    /// A lamp flies past an edge: D of its light nearly is linear, D⁵ is not.
    #[test]
    fn shifted_spectra_have_the_error_of_their_chord() {
        let at_rest = RelativeMotion::new(Velocity::ZERO, ShownEffects::default());
        let velocity = Velocity::from_beta(DVec3::X * 0.6).unwrap();
        let place = DVec3::new(0.0, 0.0, 40.0);
        let lamp = NearLamp { intensity: 1.0, place, velocity: Some(velocity), fall_off: None };
        let (a, b) = (DVec3::new(-8.0, 0.0, 0.0), DVec3::new(8.0, 0.0, 0.0));
        let doppler =
            |point| illumination(point, 0.0, Velocity::ZERO, place, velocity).unwrap().doppler;
        let off = |power: f64| {
            let light = |point| libm::pow(doppler(point), power);
            (0.5 * (light(a) + light(b)) / light(a.midpoint(b)) - 1.0).abs()
        };
        let error = lamp.error(a, b, &at_rest, DVec3::ZERO);
        assert!(
            off(5.0) <= error && off(5.0) > 3.0 * off(1.0),
            "{} {} {error}",
            off(5.0),
            off(1.0)
        );
    }

    /// `is_surely_linear` is conservative.
    #[test]
    fn surely_linear_edges_are_linear() {
        let step = |k: u32, seed: f64| (f64::from(k) * seed).fract() * 2.0 - 1.0;
        let motion =
            RelativeMotion::new(Velocity::from_beta(DVec3::X * 0.6).unwrap(), Default::default());
        let (mut n_linear, mut n_nonlinear) = (0, 0);
        for k in 1..4000_u32 {
            let point = |p, q, r| DVec3::new(step(k, p), step(k, q), step(k, r));
            let place = point(0.123_106, 0.872_983, 0.358_899);
            let fall_off = (k % 2 == 0).then_some(FallOff::new(0.7, 0.0));
            let lamp = NearLamp { intensity: 1.0, place, velocity: None, fall_off };
            let near_lamps = NearLamps { lamps: vec![lamp], bound: 1e-2, ..NearLamps::default() };
            let size = libm::pow(10.0, -f64::from(k % 12) / 4.0);
            let a = point(0.618_034, 0.414_214, 0.732_051);
            let corners =
                [a, a + point(0.236_068, 0.645_751, 0.316_625) * size, a + DVec3::Z * size];
            let corners = corners.map(|corner| Point::new(&motion, BodyId::from_index(0), corner));
            if near_lamps.is_surely_linear(&motion, corners.iter()) {
                n_linear += 1;
                let pairs = [(0, 1), (1, 2), (0, 2)];
                assert!(pairs.iter().all(|&(i, j)| !near_lamps.is_nonlinear(
                    &corners[i],
                    &corners[j],
                    &motion
                )));
            } else {
                n_nonlinear += 1;
            }
        }
        assert!(n_linear > 300 && n_nonlinear > 300, "{n_linear} {n_nonlinear}");
    }
}
