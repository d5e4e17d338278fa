//! Colours of the scene as what is interpolated.

use ugparse::{Color, ColorValue, Scene};
use ugphysics::{Hsv, hue_to_wavelength, wavelength_to_hue};
use ugscene::HueScale;

use crate::config::{Config, Interpolation};

/// A colour ready for interpolation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Swatch {
    /// Hue in −60…300 degrees, or wavelength in nanometres, as the [`Interpolation`] says.
    /// Without meaning if the saturation is 0.
    pub tint: f64,
    /// 0 grey … 1 pure.
    pub saturation: f64,
    /// 0 and more.
    pub value: f64,
}

impl Swatch {
    /// The colour of what has none.
    pub const WHITE: Self = Self { tint: 0.0, saturation: 0.0, value: 1.0 };

    /// True if it has no tint.
    pub fn is_grey(&self) -> bool {
        self.saturation == 0.0
    }
}

/// How colours of this scene are to be read.
#[derive(Clone, Debug)]
pub struct Palette {
    swatches: Vec<Swatch>,
    interpolation: Interpolation,
    scale: HueScale,
}

impl Palette {
    /// Reads all colours of a scene.
    pub fn new(scene: &Scene, config: &Config) -> Self {
        let mut palette =
            Self { swatches: Vec::new(), interpolation: config.interpolated(), scale: config.hue_scale };
        palette.swatches = scene.colors.iter().map(|color| palette.read(scene, color)).collect();
        palette
    }

    /// The colour in a row of the scene's table.
    pub fn get(&self, color: ugparse::ColorId) -> Swatch {
        self.swatches[color.index()]
    }

    /// The same as a colour with a hue.
    pub fn hsv(&self, swatch: &Swatch) -> Hsv {
        let hue = match self.interpolation {
            Interpolation::Hue => swatch.tint,
            Interpolation::Wavelength => wavelength_to_hue(swatch.tint),
        };
        Hsv { hue, saturation: swatch.saturation, value: swatch.value }
    }

    /// A colour with a hue as a swatch.
    pub fn swatch(&self, color: Hsv) -> Swatch {
        let tint = match self.interpolation {
            Interpolation::Hue => spectral(color.hue),
            Interpolation::Wavelength => hue_to_wavelength(color.hue),
        };
        Swatch { tint, saturation: color.saturation, value: color.value }
    }

    fn read(&self, scene: &Scene, color: &Color) -> Swatch {
        match color.value {
            // Taken as it is: a wavelength the eye cannot see has no hue.
            ColorValue::Hsv { value, hue: tint, saturation } if self.scale == HueScale::Wavelengths => {
                Swatch { tint, saturation, value }
            }
            _ => self.swatch(ugscene::hsv(scene, color, self.scale)),
        }
    }
}

/// The same hue in −60…300 degrees.
fn spectral(hue: f64) -> f64 {
    if (-60.0..=300.0).contains(&hue) { hue } else { wavelength_to_hue(hue_to_wavelength(hue)) }
}
