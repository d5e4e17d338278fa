//! Value parsers of options: numbers, and words of a list.

use std::ffi::OsStr;
use std::ops::RangeInclusive;

use clap::builder::{PossibleValue, TypedValueParser};
use clap::{Arg, Command};

use crate::remedies;

/// Value parser of every option that takes a number: `value_parser = ugpipe::finite`.
///
/// Accepts the same syntax as `f64` (`.9`, `5.`, `+1`, `-1e-3`), but neither infinities nor NaN; so
/// `1e999` is an error, too.
///
/// # Errors
/// The word is not a finite number: how to write it, if it is clear what is meant. clap adds the
/// word and the option to the message.
pub fn finite(word: &str) -> Result<f64, String> {
    parsed(word).ok_or_else(|| match in_other_notation(word) {
        Some((what, number)) => format!("{what}: write `{number}`"),
        None if word.contains("..") => remedies::CHANGING_NUMBERS.to_owned(),
        None => remedies::look_alike(word).unwrap_or_else(|| "not a finite number".to_owned()),
    })
}

fn parsed(word: &str) -> Option<f64> {
    word.parse().ok().filter(|number: &f64| number.is_finite())
}

/// A number that is written with a unit, a decimal comma or as a fraction: the rule that it breaks,
/// and the number.
fn in_other_notation(word: &str) -> Option<(&'static str, f64)> {
    const SPEED: &str = "speeds are fractions of the speed of light, without a unit";
    /// The speed of light in km/s.
    const LIGHT: f64 = 299_792.458;
    if let Some(number) = parsed(&word.replace(',', ".")) {
        return Some(("the decimal point is a point", number));
    }
    if let Some(number) = word.strip_suffix(',').and_then(parsed) {
        return Some(("numbers are separated by blanks", number));
    }
    if let Some((over, under)) = word.split_once('/')
        && let (Some(over), Some(under)) = (parsed(over), parsed(under))
    {
        return Some(("fractions are decimal", over / under))
            .filter(|(_, number)| number.is_finite());
    }
    let (number, unit) = word.split_at(word.rfind(|c: char| c.is_ascii_digit() || c == '.')? + 1);
    let number = parsed(number)?;
    Some(match unit.trim() {
        "%" => ("percentages are fractions of 1", number / 100.0),
        "c" | "C" => (SPEED, number),
        "km/s" => (SPEED, number / LIGHT),
        "m/s" => (SPEED, number / (1000.0 * LIGHT)),
        "km/h" => (SPEED, number / (3600.0 * LIGHT)),
        _ => ("numbers are written without units", number),
    })
}

/// Value parser of options that take a number with a condition:
/// `value_parser = ugpipe::number(ugpipe::view_angle)`.
pub fn number<T: 'static>(
    check: fn(f64) -> Result<T, String>,
) -> impl Fn(&str) -> Result<T, String> + Clone + Send + Sync {
    move |word| finite(word).and_then(check)
}

/// Value parser of options that take a whole number: `value_parser = ugpipe::whole(1..=16)`.
///
/// Its message states the range, or only its lower end if the upper one is `u32::MAX`.
pub fn whole(
    range: RangeInclusive<u32>,
) -> impl Fn(&str) -> Result<u32, String> + Clone + Send + Sync {
    move |word| {
        let number = word.parse().ok().filter(|number| range.contains(number));
        number.ok_or_else(|| match range.clone().into_inner() {
            (least, u32::MAX) => format!("must be a whole number, {least} or more"),
            (least, most) => format!("must be a whole number from {least} to {most}"),
        })
    }
}

/// Value parser of options that take one of several words, which help and completions list:
/// `value_parser = ugpipe::one_of("curves", Tone::ALL.map(|tone| (tone.name(), tone)))`.
///
/// `what`: the plural of what the words name, for the message. Case is ignored.
pub fn one_of<T: Clone + Send + Sync + 'static>(
    what: &'static str,
    all: impl IntoIterator<Item = (&'static str, T)>,
) -> impl TypedValueParser<Value = T> {
    OneOf { what, all: all.into_iter().collect() }
}

#[derive(Clone)]
struct OneOf<T> {
    what: &'static str,
    all: Vec<(&'static str, T)>,
}

impl<T: Clone + Send + Sync + 'static> TypedValueParser for OneOf<T> {
    type Value = T;

    fn parse_ref(
        &self,
        command: &Command,
        arg: Option<&Arg>,
        value: &OsStr,
    ) -> Result<T, clap::Error> {
        let Self { what, all } = self.clone();
        let parse = move |word: &str| {
            let found = all.iter().find(|(name, _)| name.eq_ignore_ascii_case(word));
            let names = || all.iter().map(|(name, _)| *name).collect::<Vec<_>>().join(", ");
            found.map(|(_, it)| it.clone()).ok_or_else(|| format!("none of the {what} {}", names()))
        };
        parse.parse_ref(command, arg, value)
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        Some(Box::new(self.all.iter().map(|(name, _)| PossibleValue::new(name))))
    }
}

/// A view angle, in degrees, above 0 and below 180: `value_parser = number(view_angle)`.
///
/// # Errors
/// The number is not such an angle. clap adds it and the option to the message.
pub fn view_angle(degrees: f64) -> Result<f64, String> {
    if 0.0 < degrees && degrees < 180.0 {
        Ok(degrees)
    } else {
        Err("the view angle must be above 0 and below 180 degrees".to_owned())
    }
}

/// The three numbers of an option declared as
///
/// ```
/// # #[derive(clap::Parser)]
/// # struct Args {
/// #[arg(long, num_args = 3, value_names = ["X", "Y", "Z"], action = clap::ArgAction::Set,
///       allow_hyphen_values = true, value_parser = ugpipe::finite)]
/// vel: Option<Vec<f64>>,
/// # }
/// # let args = <Args as clap::Parser>::parse_from(["tool", "--vel", "-.9", "0", "1e-3"]);
/// assert_eq!(ugpipe::vector(args.vel.as_deref()), Some([-0.9, 0.0, 0.001]));
/// ```
///
/// `action = Set` makes a second `-vel` an error (otherwise the `Vec` would grow to six numbers).
/// `allow_hyphen_values` is needed for `-.9`, which clap does not recognize as a number.
///
/// `None` if the option was not given.
pub fn vector(numbers: Option<&[f64]>) -> Option<[f64; 3]> {
    numbers?.try_into().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers() {
        fn check(word: &str, expected: Option<f64>) {
            assert_eq!(finite(word).ok(), expected, "{word}");
        }
        check(".9", Some(0.9));
        check("-.9", Some(-0.9));
        check("5.", Some(5.0));
        check("+1", Some(1.0));
        check("-1e-3", Some(-0.001));
        check("1E3", Some(1000.0));
        check("-0", Some(-0.0));
        check("1e-999", Some(0.0));
        check("1e999", None);
        check("inf", None);
        check("-infinity", None);
        check("nan", None);
        check("", None);
        check(" 1", None);
        check("0x10", None);
        check("1,5", None);
    }

    #[test]
    fn numbers_in_other_notations_are_taught() {
        let check = |word: &str, expected: &str| {
            assert_eq!(finite(word), Err(expected.to_owned()), "{word}")
        };
        check("0,9", "the decimal point is a point: write `0.9`");
        check("-1,5e-3", "the decimal point is a point: write `-0.0015`");
        check("0.9,", "numbers are separated by blanks: write `0.9`");
        check("9/10", "fractions are decimal: write `0.9`");
        check("90%", "percentages are fractions of 1: write `0.9`");
        let speed = "speeds are fractions of the speed of light, without a unit: write";
        check(".9c", &format!("{speed} `0.9`"));
        check("-.9 c", &format!("{speed} `-0.9`"));
        // The definition of the metre.
        check("299792458m/s", &format!("{speed} `1`"));
        check("149896.229km/s", &format!("{speed} `0.5`"));
        check("40°", "numbers are written without units: write `40`");
        check("0..5", remedies::CHANGING_NUMBERS);
        check("\u{2212}.9", "`\u{2212}` (U+2212) is a minus sign of Unicode: write it as ASCII");
        for word in
            ["", "red", "nan", "1e999", "1/0", "1,5,7", "1e999km/s", ",", "/", "%", "ship.ug"]
        {
            check(word, "not a finite number");
        }
    }

    #[test]
    fn whole_numbers_have_bounds() {
        fn check(range: RangeInclusive<u32>, word: &str, expected: Result<u32, &str>) {
            assert_eq!(whole(range)(word), expected.map_err(str::to_owned), "{word}");
        }
        check(1..=16, "16", Ok(16));
        for word in ["0", "17", "-1", "1.5", "1e1", "", "99999999999"] {
            check(1..=16, word, Err("must be a whole number from 1 to 16"));
        }
        check(1..=u32::MAX, "4294967295", Ok(u32::MAX));
        check(1..=u32::MAX, "0", Err("must be a whole number, 1 or more"));
    }

    #[test]
    fn view_angles_have_bounds() {
        assert_eq!(number(view_angle)("179.9"), Ok(179.9));
        assert!(["0", "180", "-40", "nan"].map(number(view_angle)).iter().all(Result::is_err));
    }

    #[test]
    fn vectors_have_three_numbers() {
        assert_eq!(vector(None), None);
        assert_eq!(vector(Some(&[1.0, 2.0])), None);
        assert_eq!(vector(Some(&[1.0, 2.0, 3.0])), Some([1.0, 2.0, 3.0]));
    }
}
