//! The light of a sky on surfaces, as lights at infinity.

use core::f64::consts::{FRAC_PI_2, PI};

use glam::{DQuat, DVec3};
use uglight::Lamp;
use ugphysics::spectrum::Spectrum;
use ugphysics::{Velocity, luminance};
use ugscene::LightMotion;
use ugsky::{N_PURE, Observer, Sampler, Star, StarOptions};

use crate::around::light_around;
use crate::open::Opened;

/// A light at infinity, at rest with the sky.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SkyLamp {
    /// Unit vector towards it, in the axes of the scene.
    pub toward: DVec3,
    /// Linear red, green and blue of its light on a white surface across it.
    pub linear: [f64; 3],
    /// The temperature of its light, kelvins, if it is a star.
    pub kelvin: Option<f64>,
}

/// A sky as lights at infinity: stars that are as bright as a part of it, and a number of points,
/// each of which stands for its surroundings.
pub struct SkyLamps {
    /// Stars, the sun above all.
    pub stars: Vec<SkyLamp>,
    /// Points of the panorama in sets, one after the other, of which each is spread over the sky.
    /// In the mean of all sets the light is that of the panorama.
    pub points: Vec<SkyLamp>,
    /// Number of sets.
    pub n_sets: usize,
    /// The spectra that those of points are mixtures of: white, and colours as saturated as the
    /// most saturated point, so that mixtures are nearly as smooth as the spectrum of one colour.
    pub pure: [Spectrum; N_PURE],
    saturation: f64,
}

/// Rows of cells whose light decides how dense points are.
const ROWS: usize = 64;

/// The part of points that are spread evenly, whatever the light.
const EVEN: f64 = 0.1;

/// Least irradiance of a star that lights a scene, as a part of that of the panorama.
const FAINTEST: f64 = 1e-3;

/// Light of the sky at rest in a square around a direction.
struct Light<'s> {
    sampler: Sampler<'s>,
    observer: Observer,
    highlights: Option<f32>,
}

impl Light<'_> {
    /// `toward`: in the axes of the sky; `side`: of the square, radians.
    fn of(&mut self, toward: DVec3, side: f64) -> [f64; 3] {
        let light = light_around(&mut self.sampler, &self.observer, toward, side);
        let gain =
            self.highlights.filter(|_| light[..3].iter().all(|part| *part >= 1.0)).unwrap_or(1.0);
        [0, 1, 2].map(|channel| f64::from((gain * light[channel]).max(0.0)))
    }
}

impl SkyLamps {
    /// The lights of a sky; `None` if it is black but for faint stars. `turn`: from the axes of the
    /// sky to those of the scene. `n_sets`: sets of `n_points` points.
    pub fn new(opened: &Opened, turn: DQuat, [n_sets, n_points]: [usize; 2]) -> Option<Self> {
        let cell = PI / ROWS as f64;
        let mut light = opened.panorama.as_ref().map(|panorama| Light {
            sampler: panorama.sampler(),
            observer: Observer::new(Velocity::ZERO),
            highlights: opened.highlights,
        });
        // Luminance of cells, whose sine of latitude and longitude are those of their middle.
        let area = |row: usize| {
            let edge = |row: usize| libm::sin(cell * row as f64 - FRAC_PI_2);
            cell * (edge(row + 1) - edge(row))
        };
        let mut weights = vec![[0.0; 2 * ROWS]; ROWS];
        if let Some(light) = &mut light {
            for (row, weights) in weights.iter_mut().enumerate() {
                let (sin, cos) = libm::sincos(cell * (row as f64 + 0.5) - FRAC_PI_2);
                for (column, weight) in weights.iter_mut().enumerate() {
                    let (x, y) = libm::sincos(cell * (column as f64 + 0.5) - PI);
                    let toward = DVec3::new(cos * x, cos * y, sin);
                    *weight = luminance(light.of(toward, cell)) * area(row);
                }
            }
        }
        let total: f64 = weights.iter().flatten().sum();
        let options = StarOptions::default();
        let level = |star: &Star| libm::exp10(-0.4 * star.magnitude) * options.scale();
        let bright = opened.stars.iter().filter(|star| level(star) > FAINTEST * total.max(0.1));
        let stars: Vec<SkyLamp> = bright
            .map(|star| SkyLamp {
                toward: turn * star.direction,
                linear: [level(star) / PI; 3],
                kelvin: Some(star.kelvin),
            })
            .collect();
        let mut points = Vec::new();
        if let (Some(light), true) = (&mut light, total > 0.0) {
            for (row, weights) in weights.iter_mut().enumerate() {
                let even = EVEN * total * area(row) / (4.0 * PI);
                weights.iter_mut().for_each(|weight| *weight = (1.0 - EVEN) * *weight + even);
            }
            points = spread(&weights, n_sets * n_points);
            let mut sum = 0.0;
            for point in &mut points {
                // It is the solid angle for which the point stands until here.
                let solid_angle = point.linear[0];
                point.linear =
                    light.of(point.toward, solid_angle.sqrt()).map(|part| part * solid_angle);
                sum += luminance(point.linear);
                point.toward = turn * point.toward;
            }
            // A light that fills the sphere with radiance 1 has irradiance π on a white surface.
            let scale = if sum > 0.0 { n_sets as f64 * total / (PI * sum) } else { 0.0 };
            points
                .iter_mut()
                .for_each(|point| point.linear = point.linear.map(|part| part * scale));
            // Every `n_sets`-th is in one set.
            let sets = (0..n_sets).flat_map(|set| points.iter().skip(set).step_by(n_sets));
            points = sets.copied().collect();
        }
        let saturation = |SkyLamp { linear: [red, green, blue], .. }: &SkyLamp| {
            let largest = red.max(*green).max(*blue);
            if largest > 0.0 { 1.0 - red.min(*green).min(*blue) / largest } else { 0.0 }
        };
        let saturation = points.iter().map(saturation).fold(1e-3, f64::max);
        let is_dark = stars.is_empty() && points.is_empty();
        (!is_dark).then_some(Self {
            stars,
            points,
            n_sets,
            pure: ugsky::pure_lights(saturation),
            saturation,
        })
    }

    /// The rows of [`SkyLamps::pure`] that the light of a point is a mixture of, with their
    /// amounts.
    pub fn amounts(&self, lamp: &SkyLamp) -> impl Iterator<Item = (usize, f64)> + use<> {
        let all = ugsky::amounts(lamp.linear.map(|part| part as f32));
        let [white, pair, one] = all.map(|(row, amount)| (row, f64::from(amount)));
        let [pair, one] = [pair, one].map(|(row, amount)| (row, amount / self.saturation));
        let white = (white.0, white.1 - (1.0 - self.saturation) * (pair.1 + one.1));
        [white, pair, one].into_iter().filter(|(_, amount)| *amount > 0.0)
    }

    /// The spectrum of a light, with 1 as its largest channel.
    pub fn spectrum(&self, lamp: &SkyLamp) -> Spectrum {
        /// Wavelengths between which the reflectances of (P20) vary, and a step, nm.
        const NM: [u32; 3] = [380, 780, 5];
        if let Some(kelvin) = lamp.kelvin {
            return Spectrum::blackbody(kelvin, 1.0);
        }
        let [first, last, step] = NM;
        let largest = lamp.linear.into_iter().fold(f64::MIN_POSITIVE, f64::max);
        let value = |nm: f64| {
            let parts =
                self.amounts(lamp).map(|(row, amount)| amount * self.pure[row].transmittance(nm));
            parts.sum::<f64>() / largest
        };
        let samples =
            (first..=last).step_by(step as usize).map(f64::from).map(|nm| [nm, value(nm)]);
        Spectrum::reflectance(&samples.collect::<Vec<_>>())
    }

    /// The lights behind `n_before` others; where colours are spectra, followed by the pure ones
    /// that the light of points is mixed of.
    pub fn lights(&self, n_before: usize, motion: LightMotion, is_spectral: bool) -> Vec<Lamp> {
        let first_pure = n_before + self.stars.len() + self.points.len();
        let lamp = |lamp: &SkyLamp| {
            let is_mixture = is_spectral && lamp.kelvin.is_none();
            // Skies have a few thousand lights at most.
            let amounts =
                self.amounts(lamp).map(|(row, amount)| ((first_pure + row) as u32, amount));
            let mixture = if is_mixture { amounts.collect() } else { Vec::new() };
            Lamp::afar(lamp.toward, lamp.linear.into(), &self.spectrum(lamp), motion, is_spectral)
                .mixed_of(mixture)
        };
        let pure = self.pure.iter().filter(|_| is_spectral);
        let pure =
            pure.map(|spectrum| Lamp::afar(DVec3::Z, DVec3::ONE, spectrum, motion, is_spectral));
        self.stars.iter().chain(&self.points).map(lamp).chain(pure).collect()
    }

    /// The points of a set.
    pub fn set(&self, set: usize) -> core::ops::Range<usize> {
        let n = self.points.len() / self.n_sets;
        n * (set % self.n_sets)..n * (set % self.n_sets + 1)
    }
}

/// Points as dense as weights: a Fibonacci lattice, mapped by the inverse of the cumulative weights
/// of rows, and of the cells of a row. Their light is the solid angle for which each stands.
fn spread(weights: &[[f64; 2 * ROWS]], n: usize) -> Vec<SkyLamp> {
    const GOLDEN: f64 = 0.618_033_988_749_895;
    let of_rows: Vec<f64> = weights.iter().map(|row| row.iter().sum()).collect();
    let total: f64 = of_rows.iter().sum();
    let cell = PI / ROWS as f64;
    let edge = |row: f64| libm::sin(cell * row - FRAC_PI_2);
    let point = |idx: usize| {
        let (row, part) = place(&of_rows, (idx as f64 + 0.5) / n as f64);
        let (column, across) = place(&weights[row], (idx as f64 * GOLDEN).fract());
        let (low, high) = (edge(row as f64), edge(row as f64 + 1.0));
        let z = low + part * (high - low);
        let (x, y) = libm::sincos(cell * (column as f64 + across) - PI);
        let level = (1.0 - z * z).max(0.0).sqrt();
        let density = weights[row][column] / (total * cell * (high - low));
        SkyLamp {
            toward: DVec3::new(level * x, level * y, z),
            linear: [1.0 / (n as f64 * density); 3],
            kelvin: None,
        }
    };
    (0..n).map(point).collect()
}

/// The entry at a part of the sum of weights, and the place in it from 0 to 1.
fn place(weights: &[f64], part: f64) -> (usize, f64) {
    let mut rest = part * weights.iter().sum::<f64>();
    for (idx, weight) in weights.iter().enumerate() {
        if rest < *weight {
            return (idx, rest / weight);
        }
        rest -= weight;
    }
    (weights.len() - 1, 0.5)
}
