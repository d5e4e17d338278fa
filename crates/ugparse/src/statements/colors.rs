//! Colours and surfaces in numbers: `c`, `c_rgb`, `c_xyz`, `c_bb`, `c_spd`, `c_refl` and `surf`.

use ugscene::{Color, ColorValue, NameId, SurfaceProperties, Tint};

use super::grammar::{Grammar, NAME, Outcome, Valid, refuse};
use super::known_spectra;
use crate::row_writer::{RowWriter, WriteRow};
use crate::source::Span;
use crate::token::number;

/// A colour that is a few numbers.
pub(crate) struct ColorNumbers {
    valid: &'static [Valid],
    /// How many of them must be there.
    n_required: usize,
    /// The colour of the numbers that are there.
    value: fn(&[f64]) -> ColorValue,
    /// Which of the numbers is its translucency, if one is.
    translucency: usize,
}

pub(super) static HSV: ColorNumbers = ColorNumbers {
    valid: &[
        Valid::not_negative("a lightness is 0 or more"),
        Valid::Any,
        Valid::SHARE,
        Valid::SHARE,
        Valid::not_negative("a factor is 0 or more"),
    ],
    n_required: 1,
    value: |numbers| {
        let number = |row: usize, default| numbers.get(row).copied().unwrap_or(default);
        ColorValue::Hsv {
            value: numbers[0],
            // A hue until the stage is known, which may be stated further down.
            tint: Tint::Hue(number(1, 0.0)),
            // `c L` is grey, `c L H` is fully saturated.
            saturation: number(2, if numbers.len() > 1 { 1.0 } else { 0.0 }),
            factor: number(4, 1.0),
        }
    },
    translucency: 3,
};

pub(super) static RGB: ColorNumbers = ColorNumbers {
    valid: &[Valid::SHARE; 4],
    n_required: 3,
    value: |numbers| ColorValue::Rgb([numbers[0], numbers[1], numbers[2]]),
    translucency: 3,
};

pub(super) static XYZ: ColorNumbers = ColorNumbers {
    valid: &[Valid::Any, Valid::Any, Valid::Any, Valid::SHARE],
    value: |numbers| ColorValue::Xyz([numbers[0], numbers[1], numbers[2]]),
    ..RGB
};

pub(super) static BLACKBODY: ColorNumbers = ColorNumbers {
    valid: &[
        Valid::positive("a temperature is above 0"),
        Valid::not_negative("a scale is 0 or more"),
    ],
    n_required: 1,
    value: |numbers| ColorValue::Blackbody {
        kelvin: numbers[0],
        scale: numbers.get(1).copied().unwrap_or(1.0),
    },
    translucency: 2,
};

impl<'t> Grammar<'t, '_> {
    pub fn color(&mut self, of: &ColorNumbers) -> Outcome<'t> {
        let name = self.optional_name()?;
        let numbers = self.numbers(of.valid.iter().copied(), of.n_required)?;
        let translucency = numbers.get(of.translucency).copied().unwrap_or_default();
        self.end_color(name, (of.value)(&numbers), translucency)
    }

    /// Adds a colour, whose name is set when the colours of all scopes are joined.
    fn end_color(
        &mut self,
        name: Option<Span>,
        value: ColorValue,
        translucency: f64,
    ) -> Outcome<'t> {
        let span = self.end()?;
        let color = Color { name: NameId::from_index(0), value, translucency };
        self.scope.add_color(self.text, span, name, color);
        Ok(())
    }

    /// Samples, or a known spectrum in place of them.
    pub fn spectrum(&mut self, reflects: bool) -> Outcome<'t> {
        let first_at = self.rest;
        let name = self.optional_name()?;
        let second_at = self.rest;
        let second = self.optional_name()?;
        // `c_refl wood` has the name of what it is.
        let known = second.or(name.filter(|_| number(second_at).is_err()));
        let samples = if let Some(word) = known {
            let Some(samples) = known_spectra::samples(word.of(self.text), reflects) else {
                let at = if second.is_some() { second_at } else { first_at };
                return refuse(at, known_spectra::unknown(reflects));
            };
            samples
        } else {
            let mut least = f64::MIN_POSITIVE;
            let nanometres = |grammar: &mut Self| {
                let rule = "wavelengths are above 0 and rise";
                let read = grammar.number(Valid::Range(least, f64::INFINITY, rule));
                read.inspect(|nm| least = nm.next_up())
            };
            let value = Valid::not_negative("a value is 0 or more");
            let samples = self.pairs(nanometres, |grammar| grammar.number(value))?;
            samples.into_iter().map(<[f64; 2]>::from).collect()
        };
        let value = self.scope.add_spectrum(reflects, &samples);
        self.end_color(name, value, 0.0)
    }

    pub fn surface(&mut self) -> Outcome<'t> {
        let name = self.name(NAME)?;
        let valid = SurfaceProperties::NUMBERS
            .map(|number| Valid::Range(*number.range.start(), *number.range.end(), number.rule));
        let numbers = self.numbers(valid, SurfaceProperties::N_REQUIRED)?;
        let span = self.end()?;
        let surface = SurfaceProperties::from_numbers(&numbers);
        self.scope.add_surface(self.text, span, name, surface);
        Ok(())
    }
}

/// Writes a colour that does not change with own time.
pub(crate) fn write_color(color: &Color, out: &mut RowWriter<'_>) {
    let &Color { name, value, translucency } = color;
    let scene = out.scene;
    // The last numbers are left out where they are the default.
    let mut write = |keyword, numbers: &[f64], defaults: &[f64]| {
        out.begin(keyword, name);
        let n_optional = std::iter::zip(numbers.iter().rev(), defaults.iter().rev())
            .take_while(|(number, default)| number == default)
            .count();
        out.numbers(&numbers[..numbers.len() - n_optional]);
    };
    match value {
        ColorValue::Hsv { value, tint, saturation, factor } => {
            let tint = tint.number();
            // A hue without saturation would be fully saturated.
            let grey = if tint == 0.0 { 0.0 } else { f64::NAN };
            let numbers = [value, tint, saturation, translucency, factor];
            write("c", &numbers, &[0.0, grey, 0.0, 1.0]);
        }
        ColorValue::Rgb([r, g, b]) => write("c_rgb", &[r, g, b, translucency], &[0.0]),
        ColorValue::Xyz([x, y, z]) => write("c_xyz", &[x, y, z, translucency], &[0.0]),
        ColorValue::Blackbody { kelvin, scale } => write("c_bb", &[kelvin, scale], &[1.0]),
        ColorValue::Spectrum { reflects, start, end } => {
            let samples = &scene.samples[start as usize..end as usize];
            write(if reflects { "c_refl" } else { "c_spd" }, samples.as_flattened(), &[]);
        }
    }
}

/// Writes `surf`.
impl WriteRow for SurfaceProperties {
    fn write(&self, out: &mut RowWriter<'_>) {
        out.begin("surf", self.name);
        out.numbers(&self.numbers());
    }
}
