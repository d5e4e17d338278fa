//! Skies without a file: a clear day, dusk, and the stars that the naked eye sees.

use core::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::DVec3;
use rayon::prelude::*;
use ugphysics::spectrum::Spectrum;
use ugphysics::xyz_to_linear_srgb;
use ugscene::NAMED_SKIES;
use ugsky::{Extent, Panorama, Star, StarOptions, Texels};

use crate::open::Opened;
use crate::star_list::read_stars;

/// A sky without a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BuiltIn {
    /// A clear sky, with the sun 45° high.
    Day,
    /// A clear sky, with the sun on the horizon.
    Dusk,
    /// The 5,042 stars to magnitude 6 (XHIP, see `stars/LICENSE`).
    Stars,
}

/// Texels of day and dusk.
const SIZE: [u32; 2] = [1024, 512];

/// Reflectance of the ground below the horizon.
const GROUND: f64 = 0.1;

/// A clear sky, whose colours are those of black bodies at reciprocal temperatures in 10⁶/K.
struct ClearSky {
    /// Unit vector towards the sun.
    sun: DVec3,
    zenith: f64,
    horizon: f64,
    /// Of the sky around the sun.
    around_sun: f64,
    /// Temperature of the sun as seen, kelvins.
    sun_kelvin: f64,
    /// Irradiance by the sun on a surface across its light, as a multiple of that by the sky on a
    /// level one.
    sun_part: f64,
}

/// Behind and to the left of a camera that looks along +y, so that what it sees is lit.
const DAY: ClearSky = ClearSky {
    sun: DVec3::new(-0.5, -0.5, core::f64::consts::FRAC_1_SQRT_2),
    zenith: 12.0,
    horizon: 125.0,
    around_sun: 160.0,
    sun_kelvin: 5600.0,
    sun_part: 4.0,
};

/// Ahead, beside the middle of the picture.
const DUSK: ClearSky = ClearSky {
    sun: DVec3::new(0.342, 0.939, 0.035),
    zenith: 35.0,
    horizon: 210.0,
    around_sun: 430.0,
    sun_kelvin: 2300.0,
    sun_part: 1.0,
};

impl BuiltIn {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Day, Self::Dusk, Self::Stars];

    /// Its name.
    pub fn name(self) -> &'static str {
        NAMED_SKIES[self as usize]
    }

    /// The sky called `name`.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|sky| sky.name() == name)
    }

    /// Makes the sky. White is the light of a white level surface in it.
    pub fn open(self) -> Opened {
        match self {
            Self::Day => DAY.opened(),
            Self::Dusk => DUSK.opened(),
            Self::Stars => {
                let list = read_stars("naked-eye.csv", include_bytes!("../stars/naked-eye.csv"));
                Opened {
                    stars: list.map(|list| list.stars).unwrap_or_default(),
                    ..Opened::default()
                }
            }
        }
    }
}

/// Linear red, green and blue of luminance 1 of black bodies, by reciprocal temperature in steps of
/// ten.
fn black_bodies() -> Vec<[f64; 3]> {
    let color = |step: usize| {
        let xyz = Spectrum::blackbody(1e5 / (step as f64).max(0.1), 1.0).shifted(1.0);
        xyz_to_linear_srgb(xyz.map(|part| part / xyz[1])).map(|part| part.max(0.0))
    };
    (0..=60).into_par_iter().map(color).collect()
}

impl ClearSky {
    /// Luminance by the CIE standard general sky, type 12, clear with low turbidity (ISO
    /// 15469:2004), up to a factor.
    fn luminance(&self, direction: DVec3) -> f64 {
        let from_sun = libm::acos(direction.dot(self.sun).clamp(-1.0, 1.0));
        let gradation = 1.0 - libm::exp(-0.32 / direction.z.max(0.01));
        let cos = libm::cos(from_sun);
        gradation
            * (1.0
                + 10.0 * (libm::exp(-3.0 * from_sun) - libm::exp(-3.0 * FRAC_PI_2))
                + 0.45 * cos * cos)
    }

    /// Reciprocal temperature of the colour, 10⁶/K.
    fn color(&self, direction: DVec3) -> f64 {
        let near_horizon = libm::pow(1.0 - direction.z.max(0.0), 3.0);
        let clear = self.zenith + (self.horizon - self.zenith) * near_horizon;
        let from_sun = libm::acos(direction.dot(self.sun).clamp(-1.0, 1.0));
        clear + (self.around_sun - clear) * libm::exp(-2.5 * from_sun)
    }

    fn opened(&self) -> Opened {
        let bodies = black_bodies();
        let light = |mired: f64, luminance: f64| {
            let at = (0.1 * mired).clamp(0.0, (bodies.len() - 2) as f64);
            let (low, part) = (at as usize, at.fract());
            [0, 1, 2].map(|i| {
                luminance * (bodies[low][i] + part * (bodies[low + 1][i] - bodies[low][i]))
            })
        };
        let [width, height] = SIZE.map(f64::from);
        let sun = self.sun.normalize();
        let direction = |idx: usize| {
            let [x, y] = [idx as f64 % width + 0.5, (idx as f64 / width).floor() + 0.5];
            let ((sin, cos), (up, level)) =
                (libm::sincos(TAU * (x / width - 0.5)), libm::sincos(PI * (0.5 - y / height)));
            DVec3::new(sin * level, cos * level, up)
        };
        let n_texels = (width * height) as usize;
        let sky: Vec<[f64; 3]> = (0..n_texels)
            .into_par_iter()
            .map(direction)
            .map(|toward| light(self.color(toward), self.luminance(toward)))
            .collect();
        // Irradiance of the sky on a level surface.
        let mut irradiance = [0.0; 3];
        for (idx, light) in sky.iter().enumerate() {
            let toward = direction(idx);
            let area = TAU / width * PI / height * libm::hypot(toward.x, toward.y);
            (0..3).for_each(|i| irradiance[i] += light[i] * area * toward.z.max(0.0));
        }
        let [of_sky, across] =
            [1.0, self.sun_part].map(|part| part * ugphysics::luminance(irradiance));
        // White is the light of a white level surface.
        let whole = of_sky + across * sun.z;
        let scale = PI / whole;
        let level = light(1e6 / self.sun_kelvin, across * sun.z);
        let ground = [0, 1, 2].map(|i| GROUND * (irradiance[i] + level[i]) / PI);
        let texel = |idx: usize| {
            let above = (direction(idx).z * height / (8.0 * PI) + 0.5).clamp(0.0, 1.0);
            let color =
                |i: usize| (scale * (above * sky[idx][i] + (1.0 - above) * ground[i])) as f32;
            [color(0), color(1), color(2), 1.0]
        };
        let texels = Texels::Light((0..n_texels).into_par_iter().map(texel).collect());
        let panorama = Panorama::new(SIZE, texels, Extent::FULL).ok();
        let sun = Star {
            direction: sun,
            magnitude: StarOptions::default().magnitude(scale * across),
            kelvin: self.sun_kelvin,
        };
        Opened { panorama, stars: vec![sun], ..Opened::default() }
    }
}
