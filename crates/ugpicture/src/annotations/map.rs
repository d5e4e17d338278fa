//! False colours: a quantity of what is seen, by a colour map with its scale.

use rayon::prelude::*;
use ugimage::figure::Rgb;
use ugimage::label::number::significant;
use ugimage::{Frame, LinearFrame};
use ugphysics::srgb_decode;

use crate::background::Backdrop;
use crate::emission::SeenItem;
use crate::options::PictureOptions;
use crate::quantity::{MapOptions, Quantity};
use crate::units::{Unit, Units};

/// From values of a quantity to colours and to places on a scale.
#[derive(Clone, Debug, PartialEq)]
pub struct Scale {
    /// The quantity.
    pub quantity: Quantity,
    /// The values at the ends, the least first.
    pub range: [f64; 2],
    /// In which ticks are round and values are written; those of the scene, if there is none.
    pub unit: Option<Unit>,
}

/// The ends of a scale of Doppler factors are at least this far from 1.
const LEAST_SHIFT: f64 = 1.05;

impl Scale {
    /// The scale for some values, of which those that are not finite are left out. The scale of
    /// Doppler factors has 1 in its middle, unless the options say otherwise.
    pub fn new(options: &MapOptions, values: &[f32], units: &Units) -> Self {
        let quantity = options.quantity;
        let finite =
            values.par_iter().filter(|value| value.is_finite()).map(|&value| [f64::from(value); 2]);
        let ends = finite.reduce_with(|[a, b], [c, d]| [a.min(c), b.max(d)]).unwrap_or([0.0, 1.0]);
        let range = options.range.unwrap_or_else(|| match quantity {
            Quantity::Doppler => {
                let most = (1.0 / ends[0].max(f64::MIN_POSITIVE)).max(ends[1]).max(LEAST_SHIFT);
                [1.0 / most, most]
            }
            _ if ends[0] < ends[1] => ends,
            _ => {
                let apart = 0.01 * ends[0].abs().max(1e-3);
                [ends[0] - apart, ends[1] + apart]
            }
        });
        let unit = quantity.unit(units, range[0].abs().max(range[1].abs()));
        Self { quantity, range, unit }
    }

    /// The place of a value, from 0 to 1. Doppler factors are on a logarithmic scale, 1 in its
    /// middle if both ends are on different sides of it.
    pub fn place(&self, value: f64) -> f64 {
        let [low, high] = self.range;
        let part = match self.quantity {
            Quantity::Doppler => {
                let [low, value, high] = [low, value, high].map(libm::log);
                match (low < 0.0, high > 0.0) {
                    (true, true) => 0.5 + 0.5 * value / if value > 0.0 { high } else { -low },
                    _ => (value - low) / (high - low),
                }
            }
            _ => (value - low) / (high - low),
        };
        part.clamp(0.0, 1.0)
    }

    /// The colour of a place: from red over white to blue for Doppler factors, else Viridis, which
    /// is perceptually uniform.
    pub fn color(&self, place: f64) -> Rgb {
        let map =
            if self.quantity == Quantity::Doppler { colorous::RED_BLUE } else { colorous::VIRIDIS };
        map.eval_continuous(place).as_array()
    }

    /// Round values between the ends, and how they are written.
    pub fn ticks(&self) -> Vec<(f64, String)> {
        let factor = self.unit.as_ref().map_or(1.0, |unit| unit.factor);
        let [low, high] = self.range.map(|end| factor * end);
        let powers = |mantissas: &'static [f64]| -> Vec<f64> {
            let (first, last) = (libm::floor(libm::log10(low)) as i32, libm::log10(high) as i32);
            let decade =
                |power| mantissas.iter().map(move |part| part * libm::exp10(f64::from(power)));
            (first..=last).flat_map(decade).filter(|tick| (low..=high).contains(tick)).collect()
        };
        let mut ticks = match self.quantity {
            Quantity::Doppler if high > 4.0 * low => powers(&[1.0, 2.0, 5.0]),
            _ => Vec::new(),
        };
        if ticks.len() > 10 {
            ticks = powers(&[1.0]);
        }
        if ticks.len() < 2 {
            let raw = (high - low) / 5.0;
            let power = libm::exp10(libm::floor(libm::log10(raw)));
            let step = power
                * [1.0, 2.0, 5.0, 10.0].into_iter().find(|part| part * power >= raw).unwrap_or(1.0);
            let (first, n) = (libm::ceil(low / step), ((high - low) / step) as u32);
            ticks = (0..=n)
                .map(|idx| step * (first + f64::from(idx)))
                .filter(|tick| *tick <= high)
                .collect();
        }
        ticks.into_iter().map(|tick| (tick / factor, significant(tick, 4))).collect()
    }

    /// What the scale shows, with the unit.
    pub fn title(&self) -> String {
        match &self.unit {
            Some(unit) => format!("{} in {}", self.quantity.label(), unit.name),
            None if self.quantity == Quantity::Speed => format!("{} β", self.quantity.label()),
            None => self.quantity.label().to_owned(),
        }
    }

    /// A value with its unit.
    pub fn written(&self, value: f64) -> String {
        self.unit.as_ref().map_or_else(|| significant(value, 4), |unit| unit.written(value, 4))
    }
}

/// The picture of a quantity, whose value is NaN in samples that show nothing. `values`: for each
/// sample, row after row.
pub fn picture(scale: &Scale, values: &[f32], options: &PictureOptions) -> Frame {
    let [width, height] = options.size;
    let n = options.samples as usize;
    let backdrop = Backdrop::new(options.background, options.samples);
    let across = width as usize * n;
    let pixel = |idx: usize| {
        let (column, row) = (idx % width as usize, idx / width as usize);
        let (mut sum, mut covered) = ([0.0_f32; 3], 0.0);
        for below in 0..n {
            let start = (row * n + below) * across + column * n;
            for value in values[start..start + n].iter().filter(|value| !value.is_nan()) {
                let color = scale.color(scale.place(f64::from(*value)));
                (0..3).for_each(|i| sum[i] += srgb_decode(f64::from(color[i]) / 255.0) as f32);
                covered += 1.0;
            }
        }
        backdrop.pixel(sum, covered)
    };
    let pixels = (0..width as usize * height as usize).into_par_iter().map(pixel).collect();
    LinearFrame::new(options.size, backdrop.is_opaque(), pixels).to_display()
}

/// The value of a quantity at a place of the picture; NaN where nothing is seen.
pub fn value(quantity: Quantity, item: Option<SeenItem>) -> f32 {
    item.map_or(f32::NAN, |(_, emission)| quantity.of(&emission) as f32)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scale(quantity: Quantity, range: [f64; 2]) -> Scale {
        Scale { quantity, range, unit: None }
    }

    /// Factors that are inverse to each other are as far from the middle, which is white.
    #[test]
    fn doppler_factors_are_symmetrical_about_one() {
        let free = MapOptions { quantity: Quantity::Doppler, range: None };
        let automatic = Scale::new(&free, &[0.5, f32::NAN, 1.5], &Units::default());
        assert_eq!(automatic.range, [0.5, 2.0]);
        assert_eq!([0.5, 1.0, 2.0, 9.0].map(|value| automatic.place(value)), [0.0, 0.5, 1.0, 1.0]);
        let uneven = scale(Quantity::Doppler, [0.5, 8.0]);
        assert_eq!(uneven.place(1.0), 0.5);
        assert!((uneven.place(2.0) - (0.5 + 0.5 / 3.0)).abs() < 1e-12);
        let [red, _, blue] = automatic.color(0.0);
        assert!(red > 80 && blue < 60, "{red} {blue}");
        let [red, _, blue] = automatic.color(1.0);
        assert!(red < 30 && blue > 80, "{red} {blue}");
        assert!(automatic.color(0.5).iter().all(|&part| part > 230));
    }

    #[test]
    fn ticks_are_round() {
        let of = |quantity, range| {
            scale(quantity, range).ticks().into_iter().map(|(_, text)| text).collect::<Vec<_>>()
        };
        assert_eq!(of(Quantity::Doppler, [0.23, 4.36]), ["0.5", "1", "2"]);
        assert_eq!(of(Quantity::Doppler, [0.9, 1.1]), ["0.9", "0.95", "1", "1.05", "1.1"]);
        assert_eq!(of(Quantity::Doppler, [1e-6, 1e6]).len(), 13);
        assert_eq!(of(Quantity::Time, [-15.3, -9.8]), ["−14", "−12", "−10"]);
        assert_eq!(of(Quantity::Speed, [0.0, 1.0]), ["0", "0.2", "0.4", "0.6", "0.8", "1"]);
    }

    #[test]
    fn ticks_are_round_in_their_unit() {
        let units = Units::new(Some("m"), None).unwrap();
        let map = MapOptions { quantity: Quantity::Time, range: Some([-6.0, 0.0]) };
        let scale = Scale::new(&map, &[], &units);
        assert_eq!(scale.title(), "time of emission in ns");
        let (values, texts): (Vec<f64>, Vec<String>) = scale.ticks().into_iter().unzip();
        assert_eq!(texts, ["−20", "−15", "−10", "−5", "0"]);
        assert!((values[0] + 20e-9 * 299_792_458.0).abs() < 1e-12, "{values:?}");
    }

    #[test]
    fn a_single_value_has_a_scale() {
        for (_, quantity) in Quantity::NAMES {
            for values in [vec![], vec![0.0], vec![3.0; 4], vec![f32::INFINITY]] {
                let scale =
                    Scale::new(&MapOptions { quantity, range: None }, &values, &Units::default());
                assert!(scale.range[0] < scale.range[1], "{quantity:?} {values:?} {scale:?}");
                assert!(!scale.ticks().is_empty(), "{scale:?}");
            }
        }
    }
}
