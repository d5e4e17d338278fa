//! Options that are the same in every program, and value parsers for numbers.

use std::ffi::OsStr;
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};

use clap::builder::{PossibleValue, TypedValueParser};
use clap::{Arg, Command};

use crate::look::Looks;
use crate::remedies;

/// The arguments of a ug program.
pub trait ToolArgs: clap::Parser {
    /// The options that most people need, about ten, as documented (`-vel`, `--keep-in-view`): `-h`
    /// lists them, by these names and in this order.
    const ESSENTIAL: &'static [&'static str];

    /// The options that the looks of [`crate::LookArgs`] stand for, if it has these.
    const LOOKS: Looks = Looks { light: &[], shape: &[] };

    /// The options that every program has.
    fn common(&self) -> &CommonArgs;
}

/// Ids of the options for files, messages and threads: those below, `files` for additional input
/// files ([`crate::Context::input_file`]), `at` for a second output file
/// ([`crate::Context::write_file`]), `pv` for previews in the place of the output
/// ([`crate::Context::write_now`]), and `cn`, which is accepted as in 1988. They do not affect the
/// content of the output, so the recorded command line omits them.
pub(crate) const WITHOUT_EFFECT: [&str; 11] =
    ["file", "files", "fi", "fo", "fm", "qt", "vb", "nt", "at", "pv", "cn"];

/// The options that every program has. Put them last in the program's own arguments:
/// `#[command(flatten)] common: CommonArgs`.
#[derive(clap::Args, Clone, Debug, Default, PartialEq, Eq)]
pub struct CommonArgs {
    /// File to read [default: `-`, standard input]
    #[arg(id = "file", value_name = "FILE", conflicts_with = "fi")]
    file: Option<PathBuf>,

    /// Read FILE; `-` is standard input
    ///
    /// The same as a bare FILE.
    #[arg(long, value_name = "FILE", visible_alias = "input", help_heading = COMMON)]
    fi: Option<PathBuf>,

    /// Write FILE; `-` is standard output
    ///
    /// A regular FILE is written atomically: to a temporary file in the same folder, which is
    /// renamed when the program succeeds.
    #[arg(long, value_name = "FILE", visible_alias = "output", help_heading = COMMON)]
    fo: Option<PathBuf>,

    /// Write messages to FILE; `-` is standard error
    #[arg(long, value_name = "FILE", visible_alias = "messages", help_heading = COMMON)]
    fm: Option<PathBuf>,

    /// Warn about unknown statements and pass them on
    ///
    /// Without this option they are errors.
    #[arg(long, help_heading = COMMON)]
    lax: bool,

    /// Run the programs that `execute` statements name
    ///
    /// These programs run with your permissions, so use this only for scenes you trust. Without
    /// this option such statements are errors.
    #[arg(long, help_heading = COMMON)]
    allow_execute: bool,

    /// Read files that the input names outside its folder
    ///
    /// Files and programs that the input names (include, execute, mtllib, buffers of glTF) must be
    /// in the folder of the input or below it; for standard input, in the current folder. Links are
    /// followed first. Use this option only for inputs you trust.
    #[arg(long, help_heading = COMMON)]
    allow_outside: bool,

    /// Change a limit on the size of scenes
    ///
    /// As in statements=100000000. Names of limits: text, includes, files, nesting, chain,
    /// statements, corners, names, memory; see docs/unigrafix.md. May be given more than once.
    #[arg(long, value_name = "NAME=N", value_parser = limit, help_heading = COMMON)]
    limit: Vec<(String, u64)>,

    /// Print only errors, no notes or warnings
    #[arg(long, visible_alias = "quiet", conflicts_with = "vb", help_heading = COMMON)]
    qt: bool,

    /// Print what was done, with timings
    #[arg(long, visible_alias = "verbose", help_heading = COMMON)]
    vb: bool,

    /// Use N threads [default: all]
    ///
    /// The output does not depend on N.
    #[arg(long, value_name = "N", visible_alias = "threads", help_heading = COMMON,
          value_parser = whole(1..=1024))]
    nt: Option<u32>,
}

/// Heading of these options in `--help`.
pub(crate) const COMMON: &str = "Common options";

impl CommonArgs {
    /// The input file; `None` is standard input.
    pub fn input(&self) -> Option<&Path> {
        self.input_named().filter(|path| !is_dash(path))
    }

    /// The output file; `None` is standard output.
    pub fn output(&self) -> Option<&Path> {
        self.fo.as_deref().filter(|path| !is_dash(path))
    }

    /// The file for messages; `None` is standard error.
    pub fn messages(&self) -> Option<&Path> {
        self.fm.as_deref().filter(|path| !is_dash(path))
    }

    /// True if unknown statements cause warnings and are passed on, rather than being errors.
    pub fn lax(&self) -> bool {
        self.lax
    }

    /// True if programs that the input names may be run.
    pub fn allow_execute(&self) -> bool {
        self.allow_execute
    }

    /// True if files that the input names may be outside its folder.
    pub fn allow_outside(&self) -> bool {
        self.allow_outside
    }

    /// The limits that were set, in order. Their names are not checked here.
    pub fn limits(&self) -> &[(String, u64)] {
        &self.limit
    }

    /// The limit `memory` that was set, in bytes.
    pub fn memory_limit(&self) -> Option<u64> {
        self.limit.iter().rev().find(|(name, _)| name == "memory").map(|(_, bytes)| *bytes)
    }

    /// What to add to the message about an input that needs more than the limit `memory`.
    pub fn memory_remedy(needed: Option<u64>) -> String {
        needed.map_or_else(String::new, |bytes| format!("; allow it with --limit memory={bytes}"))
    }

    /// The options for reading as they would be given to another program.
    pub fn reading_words(&self) -> Vec<String> {
        let flags = [
            (self.lax, "-lax"),
            (self.allow_execute, "--allow-execute"),
            (self.allow_outside, "--allow-outside"),
        ];
        let mut words: Vec<String> =
            flags.iter().filter(|(is_given, _)| *is_given).map(|(_, word)| (*word).to_owned()).collect();
        words.extend(
            self.limit.iter().flat_map(|(name, value)| ["--limit".to_owned(), format!("{name}={value}")]),
        );
        words
    }

    /// True if notes and warnings are suppressed.
    pub fn quiet(&self) -> bool {
        self.qt
    }

    /// True if details are printed.
    pub fn verbose(&self) -> bool {
        self.vb
    }

    /// The requested number of threads; `None` means one per core.
    pub fn threads(&self) -> Option<usize> {
        self.nt.map(|n_threads| n_threads as usize)
    }

    /// The input file as given by the user, including `-`.
    pub(crate) fn input_named(&self) -> Option<&Path> {
        self.fi.as_deref().or(self.file.as_deref())
    }
}

fn is_dash(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// Value parser for `NAME=N`.
fn limit(word: &str) -> Result<(String, u64), String> {
    let (name, value) = word.split_once('=').ok_or("write NAME=N")?;
    let is_whole = !value.is_empty() && value.bytes().all(|byte| byte.is_ascii_digit());
    let value = value.parse().ok().filter(|_| is_whole).ok_or("N must be a whole number below 2^64")?;
    Ok((name.to_owned(), value))
}

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
        None => "not a finite number".to_owned(),
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
        return Some(("fractions are decimal", over / under)).filter(|(_, number)| number.is_finite());
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
pub fn whole(range: RangeInclusive<u32>) -> impl Fn(&str) -> Result<u32, String> + Clone + Send + Sync {
    move |word| in_range(word.parse().ok(), &range)
}

/// The condition of [`whole`] for a number that was not parsed.
pub fn count(range: RangeInclusive<u32>) -> impl Fn(f64) -> Result<u32, String> {
    // The conversion saturates.
    move |number| in_range(u32::try_from(number as i64).ok().filter(|_| number.fract() == 0.0), &range)
}

fn in_range(number: Option<u32>, range: &RangeInclusive<u32>) -> Result<u32, String> {
    number.filter(|number| range.contains(number)).ok_or_else(|| match range.clone().into_inner() {
        (least, u32::MAX) => format!("must be a whole number, {least} or more"),
        (least, most) => format!("must be a whole number from {least} to {most}"),
    })
}

/// Value parser of options that take one of several words, which help and completions list:
/// `value_parser = ugpipe::one_of(Tone::ALL.map(Tone::name), tone)`.
///
/// `parse` decides what is valid, and its error is the message.
pub fn one_of<T: Clone + Send + Sync + 'static>(
    words: impl IntoIterator<Item = &'static str>,
    parse: fn(&str) -> Result<T, String>,
) -> impl TypedValueParser<Value = T> {
    OneOf { words: words.into_iter().collect(), parse }
}

#[derive(Clone)]
struct OneOf<T> {
    words: Vec<&'static str>,
    parse: fn(&str) -> Result<T, String>,
}

impl<T: Clone + Send + Sync + 'static> TypedValueParser for OneOf<T> {
    type Value = T;

    fn parse_ref(&self, command: &Command, arg: Option<&Arg>, value: &OsStr) -> Result<T, clap::Error> {
        self.parse.parse_ref(command, arg, value)
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        Some(Box::new(self.words.iter().map(PossibleValue::new)))
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
        let check = |word: &str, expected: &str| assert_eq!(finite(word), Err(expected.to_owned()), "{word}");
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
        for word in ["", "red", "nan", "1e999", "1/0", "1,5,7", "1e999km/s", ",", "/", "%", "ship.ug"] {
            check(word, "not a finite number");
        }
    }

    #[test]
    fn limits_are_a_name_and_a_whole_number() {
        fn check(word: &str, expected: Option<(&str, u64)>) {
            let expected = expected.map(|(name, value)| (name.to_owned(), value));
            assert_eq!(limit(word).ok(), expected, "{word}");
        }
        check("files=3", Some(("files", 3)));
        check("files=007", Some(("files", 7)));
        check("=3", Some(("", 3)));
        check("files", None);
        check("files=", None);
        check("files=+3", None);
        check("files=-3", None);
        check("files=1e3", None);
        check("files=99999999999999999999", None);
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
        let counts = [16.0, 0.0, 17.0, -1.0, 1.5, 1e300].map(count(1..=16));
        assert_eq!(counts.map(Result::ok), [Some(16), None, None, None, None, None]);
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
