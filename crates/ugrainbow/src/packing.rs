//! The values that are interpolated between the corners of a face, packed as an array for the
//! rasterizer.
//!
//! The fewest interpolants that a scene needs are used:
//!
//! | layout | scene | interpolants, in this order |
//! | --- | --- | --- |
//! | [`Plain`] | hues under white light | tint, saturation, value × level |
//! | [`Colored`] | hues under coloured lights, or with levels of linear light | tint, saturation, value; level of red, green, blue |
//! | [`Mixed`] | some colours given as light | as plain, then 0; or lit linear red, green, blue, then 1 |
//! | [`MixedColored`] | both | as coloured, then 0; or lit linear red, green, blue, 1, 1, 1, then 1 |
//! | [`Transparent`] | translucent faces, lines | as mixed coloured, then the translucency |

use glam::DVec3;
use uglight::Lighting;
use ugraster::TRANSPARENT_VALUES;

use uglight::{Palette, Swatch};

/// Packs a colour and the level of red, green and blue light on it.
pub type Pack<const N: usize> = fn(&Swatch, DVec3) -> [f64; N];

/// Defines layouts: names of interpolants, in the order in which an array holds them.
macro_rules! layouts {
    ($($name:ident[$count:expr] { $($interpolant:ident),* $(,)? })*) => {$(
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct $name<T> {
            $(pub $interpolant: T,)*
        }

        impl<T> $name<T> {
            #[inline]
            pub fn unpack([$($interpolant),*]: [T; $count]) -> Self {
                Self { $($interpolant),* }
            }

            #[inline]
            pub fn pack(self) -> [T; $count] {
                [$(self.$interpolant),*]
            }
        }
    )*};
}

layouts! {
    Plain[3] { tint, saturation, value }
    Colored[6] { tint, saturation, value, red_level, green_level, blue_level }
    Mixed[4] { tint_or_red, saturation_or_green, value_or_blue, is_light }
    MixedColored[7] {
        tint_or_red, saturation_or_green, value_or_blue, red_level, green_level, blue_level, is_light,
    }
    Transparent[TRANSPARENT_VALUES] {
        tint_or_red, saturation_or_green, value_or_blue, red_level, green_level, blue_level, is_light,
        translucency,
    }
}

impl<T: Copy> Colored<T> {
    #[inline]
    pub fn color(&self) -> Plain<T> {
        Plain { tint: self.tint, saturation: self.saturation, value: self.value }
    }

    #[inline]
    pub fn level(&self) -> [T; 3] {
        [self.red_level, self.green_level, self.blue_level]
    }
}

impl<T: Copy> Mixed<T> {
    /// The colour where `is_light` is 0.
    #[inline]
    pub fn color(&self) -> Plain<T> {
        Plain { tint: self.tint_or_red, saturation: self.saturation_or_green, value: self.value_or_blue }
    }

    /// Linear red, green and blue where `is_light` is 1.
    #[inline]
    pub fn light(&self) -> [T; 3] {
        [self.tint_or_red, self.saturation_or_green, self.value_or_blue]
    }
}

impl<T: Copy> MixedColored<T> {
    /// The same without the level of light.
    #[inline]
    pub fn mixed(&self) -> Mixed<T> {
        let Self { tint_or_red, saturation_or_green, value_or_blue, is_light, .. } = *self;
        Mixed { tint_or_red, saturation_or_green, value_or_blue, is_light }
    }

    #[inline]
    pub fn level(&self) -> [T; 3] {
        [self.red_level, self.green_level, self.blue_level]
    }
}

impl<T: Copy> Transparent<T> {
    /// The same without the translucency.
    #[inline]
    pub fn opaque(&self) -> MixedColored<T> {
        MixedColored {
            tint_or_red: self.tint_or_red,
            saturation_or_green: self.saturation_or_green,
            value_or_blue: self.value_or_blue,
            red_level: self.red_level,
            green_level: self.green_level,
            blue_level: self.blue_level,
            is_light: self.is_light,
        }
    }
}

/// The layout of the opaque faces of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PackedLayout {
    Plain,
    Colored,
    Mixed,
    MixedColored,
}

/// The interpolated colour of a sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Interpolated {
    /// Given as light: linear red, green, blue, lit.
    Light([f64; 3]),
    /// Given as a hue or wavelength.
    Hue {
        /// Hue or wavelength, saturation, and value.
        color: Plain<f64>,
        /// Level of red, green and blue light; `None` if it has been multiplied into the value.
        level: Option<[f64; 3]>,
    },
}

impl PackedLayout {
    /// The one with the fewest interpolants.
    pub fn new(palette: &Palette, lighting: &Lighting) -> Self {
        // The exact mode adds the light of coloured lamps as such.
        let adds_light = lighting.is_colored() && lighting.acts_on_light();
        let draws_light = palette.has_light() || palette.has_display() || adds_light;
        match (draws_light, lighting.is_colored() || lighting.acts_on_light()) {
            (false, false) => Self::Plain,
            (false, true) => Self::Colored,
            (true, false) => Self::Mixed,
            (true, true) => Self::MixedColored,
        }
    }

    /// The colour of an opaque sample.
    pub fn color(self, numbers: &[f32]) -> Interpolated {
        match self {
            Self::Plain => Interpolated::Hue { color: Plain::unpack(doubles(numbers)), level: None },
            Self::Colored => {
                let sample = Colored::unpack(doubles(numbers));
                Interpolated::Hue { color: sample.color(), level: Some(sample.level()) }
            }
            Self::Mixed => mixed(&Mixed::unpack(doubles(numbers)), None),
            Self::MixedColored => {
                let sample = MixedColored::unpack(doubles(numbers));
                mixed(&sample.mixed(), Some(sample.level()))
            }
        }
    }
}

fn mixed(sample: &Mixed<f64>, level: Option<[f64; 3]>) -> Interpolated {
    if sample.is_light > 0.5 {
        Interpolated::Light(sample.light())
    } else {
        Interpolated::Hue { color: sample.color(), level }
    }
}

fn doubles<const N: usize>(numbers: &[f32]) -> [f64; N] {
    first(numbers).map(f64::from)
}

/// The first `N` numbers; zeros where there are fewer.
pub fn first<const N: usize>(numbers: &[f32]) -> [f32; N] {
    std::array::from_fn(|i| numbers.get(i).copied().unwrap_or(0.0))
}

/// White light of one level goes into the value.
pub fn pack_plain(swatch: &Swatch, level: DVec3) -> [f64; 3] {
    Plain { tint: swatch.tint, saturation: swatch.saturation, value: swatch.value * level.x }.pack()
}

/// Coloured light and factors of linear light are interpolated beside the colour.
pub fn pack_colored(swatch: &Swatch, level: DVec3) -> [f64; 6] {
    let level = level * swatch.factor;
    let color = Colored {
        tint: swatch.tint,
        saturation: swatch.saturation,
        value: swatch.value,
        red_level: level.x,
        green_level: level.y,
        blue_level: level.z,
    };
    color.pack()
}

/// White light, and some colours given as light.
pub fn pack_mixed(swatch: &Swatch, level: DVec3) -> [f64; 4] {
    let color = match swatch.lit(level) {
        Some(light) => Mixed {
            tint_or_red: light.x,
            saturation_or_green: light.y,
            value_or_blue: light.z,
            is_light: 1.0,
        },
        None => Mixed {
            tint_or_red: swatch.tint,
            saturation_or_green: swatch.saturation,
            value_or_blue: swatch.value * level.x,
            is_light: 0.0,
        },
    };
    color.pack()
}

/// Coloured light, and some colours given as light.
pub fn pack_mixed_colored(swatch: &Swatch, level: DVec3) -> [f64; 7] {
    mixed_colored(swatch, level).pack()
}

/// One layout for translucent faces and lines of every scene.
pub fn pack_transparent(swatch: &Swatch, level: DVec3) -> [f64; TRANSPARENT_VALUES] {
    let opaque = mixed_colored(swatch, level);
    let color = Transparent {
        tint_or_red: opaque.tint_or_red,
        saturation_or_green: opaque.saturation_or_green,
        value_or_blue: opaque.value_or_blue,
        red_level: opaque.red_level,
        green_level: opaque.green_level,
        blue_level: opaque.blue_level,
        is_light: opaque.is_light,
        translucency: swatch.translucency,
    };
    color.pack()
}

fn mixed_colored(swatch: &Swatch, level: DVec3) -> MixedColored<f64> {
    match swatch.lit(level) {
        Some(light) => MixedColored {
            tint_or_red: light.x,
            saturation_or_green: light.y,
            value_or_blue: light.z,
            red_level: 1.0,
            green_level: 1.0,
            blue_level: 1.0,
            is_light: 1.0,
        },
        None => MixedColored {
            tint_or_red: swatch.tint,
            saturation_or_green: swatch.saturation,
            value_or_blue: swatch.value,
            red_level: level.x * swatch.factor,
            green_level: level.y * swatch.factor,
            blue_level: level.z * swatch.factor,
            is_light: 0.0,
        },
    }
}
