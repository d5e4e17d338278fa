//! What surfaces do with light: the numbers of `surf` statements.

use std::ops::RangeInclusive;

use super::NameId;

/// Reflection properties of a surface, for ray tracers.
#[derive(Clone, Debug, PartialEq)]
pub struct SurfaceProperties {
    /// Its name.
    pub name: NameId,
    /// kd: fraction of light reflected diffusely, 0 or more.
    pub diffuse: f64,
    /// ks: fraction reflected specularly, 0 or more.
    pub specular: f64,
    /// kt: fraction transmitted, 0…1.
    pub transmitted: f64,
    /// n: refractive index, above 0.
    pub refraction: f64,
    /// Exponent of highlights, 0 or more.
    pub exponent: f64,
    /// Absorption coefficient behind the surface, per unit of length at rest, 0 or more.  Eq. (P38)
    pub absorption: f64,
}

impl Default for SurfaceProperties {
    /// A surface that reflects all light diffusely, with the values of numbers that a statement
    /// leaves out.
    fn default() -> Self {
        Self {
            name: NameId::from_index(0),
            diffuse: 1.0,
            specular: 0.0,
            transmitted: 0.0,
            refraction: 1.0,
            exponent: 20.0,
            absorption: 0.0,
        }
    }
}

/// A number of a `surf` statement.
pub struct SurfaceNumber {
    /// Its place in the properties.
    pub of: fn(&mut SurfaceProperties) -> &mut f64,
    /// The valid values.
    pub range: RangeInclusive<f64>,
    /// The valid values in words.
    pub rule: &'static str,
}

impl SurfaceProperties {
    /// The numbers of a `surf` statement, in their order. Those from [`Self::N_REQUIRED`] on may be
    /// left out, from the last one.
    pub const NUMBERS: [SurfaceNumber; 6] = [
        SurfaceNumber { of: |s| &mut s.diffuse, range: 0.0..=f64::MAX, rule: PART },
        SurfaceNumber { of: |s| &mut s.specular, range: 0.0..=f64::MAX, rule: PART },
        SurfaceNumber {
            of: |s| &mut s.transmitted,
            range: 0.0..=1.0,
            rule: "use a number from 0 to 1",
        },
        SurfaceNumber {
            of: |s| &mut s.refraction,
            range: f64::MIN_POSITIVE..=f64::MAX,
            rule: "a refractive index is above 0",
        },
        SurfaceNumber {
            of: |s| &mut s.exponent,
            range: 0.0..=f64::MAX,
            rule: "an exponent is 0 or more",
        },
        SurfaceNumber {
            of: |s| &mut s.absorption,
            range: 0.0..=f64::MAX,
            rule: "absorption is 0 or more",
        },
    ];

    /// The count of numbers that every `surf` statement has.
    pub const N_REQUIRED: usize = 3;

    /// The properties that a statement with these numbers gives.
    pub fn from_numbers(numbers: &[f64]) -> Self {
        let mut properties = Self::default();
        for (number, value) in Self::NUMBERS.iter().zip(numbers) {
            *(number.of)(&mut properties) = *value;
        }
        properties
    }

    /// The shortest list of numbers from which a statement gives these properties.
    pub fn numbers(&self) -> Vec<f64> {
        let (mut own, mut default) = (self.clone(), Self::default());
        let values =
            Self::NUMBERS.map(|number| [*(number.of)(&mut own), *(number.of)(&mut default)]);
        let n = values.iter().rposition(|[own, default]| own != default).map_or(0, |last| last + 1);
        values[..n.max(Self::N_REQUIRED)].iter().map(|[own, _]| *own).collect()
    }

    /// The rule that a number violates.
    pub fn violated(&self) -> Option<&'static str> {
        let mut own = self.clone();
        let mut numbers = Self::NUMBERS.into_iter();
        numbers
            .find(|number| !number.range.contains((number.of)(&mut own)))
            .map(|number| number.rule)
    }
}

const PART: &str = "a part of the light is 0 or more";
