//! Options that mean the same in every program, and readers of numbers.

use std::path::{Path, PathBuf};

/// One sentence for the help of every program: `#[command(before_help = ugpipe::ONE_DASH)]`.
pub const ONE_DASH: &str =
    "Every long option may be written with one dash, as in 1988: -fi FILE is --fi FILE.";

/// Ids of options that choose streams, talk and threads: those below, `files` for more files to read
/// ([`crate::Stage::input_file`]), and `at` for a second file to write ([`crate::Stage::write_file`]). They do not change what is computed, so the recorded command line leaves
/// them out.
pub(crate) const WITHOUT_EFFECT: [&str; 9] = ["file", "files", "fi", "fo", "fm", "qt", "vb", "nt", "at"];

/// Options of every program. Put it last in the program's own arguments:
/// `#[command(flatten)] common: CommonArgs`.
#[derive(clap::Args, Clone, Debug, Default, PartialEq, Eq)]
pub struct CommonArgs {
    /// File to read; `-` or none is standard input
    #[arg(id = "file", value_name = "FILE", conflicts_with = "fi")]
    file: Option<PathBuf>,

    /// Read FILE; `-` is standard input
    ///
    /// The same as a bare FILE. May be written with one dash: -fi FILE.
    #[arg(long, value_name = "FILE", visible_alias = "input", help_heading = COMMON)]
    fi: Option<PathBuf>,

    /// Write FILE; `-` is standard output
    ///
    /// A regular FILE appears whole or not at all: it is written beside its place and
    /// renamed when all went well. May be written with one dash: -fo FILE.
    #[arg(long, value_name = "FILE", visible_alias = "output", help_heading = COMMON)]
    fo: Option<PathBuf>,

    /// Write messages to FILE; `-` is standard error
    ///
    /// May be written with one dash: -fm FILE.
    #[arg(long, value_name = "FILE", visible_alias = "messages", help_heading = COMMON)]
    fm: Option<PathBuf>,

    /// Warn about unknown statements and pass them on
    ///
    /// Otherwise they are errors. May be written with one dash: -lax.
    #[arg(long, help_heading = COMMON)]
    lax: bool,

    /// Run the programs that `execute` statements name
    ///
    /// They may do whatever you may: only for scenes you trust. Otherwise such statements are errors.
    /// May be written with one dash: -allow-execute.
    #[arg(long, help_heading = COMMON)]
    allow_execute: bool,

    /// Set a limit of what a scene may ask for, as in statements=100000000
    ///
    /// Names of limits: text, includes, files, nesting, chain, statements, corners, names; the page on UniGrafix
    /// says what they are. May be written with one dash, and more than once: -limit NAME=N.
    #[arg(long, value_name = "NAME=N", value_parser = limit, help_heading = COMMON)]
    limit: Vec<(String, u64)>,

    /// Print errors only, no notes and warnings
    ///
    /// May be written with one dash: -qt.
    #[arg(long, visible_alias = "quiet", conflicts_with = "vb", help_heading = COMMON)]
    qt: bool,

    /// Say what was done, with times
    ///
    /// May be written with one dash: -vb.
    #[arg(long, visible_alias = "verbose", help_heading = COMMON)]
    vb: bool,

    /// Use N threads [default: all]
    ///
    /// The bytes written do not depend on N. May be written with one dash: -nt N.
    #[arg(long, value_name = "N", visible_alias = "threads", help_heading = COMMON,
          value_parser = clap::value_parser!(u16).range(1..=1024))]
    nt: Option<u16>,
}

const COMMON: &str = "Common options";

impl CommonArgs {
    /// File to read; none is standard input.
    pub fn input(&self) -> Option<&Path> {
        self.input_named().filter(|path| !is_dash(path))
    }

    /// File to write; none is standard output.
    pub fn output(&self) -> Option<&Path> {
        self.fo.as_deref().filter(|path| !is_dash(path))
    }

    /// File for messages; none is standard error.
    pub fn messages(&self) -> Option<&Path> {
        self.fm.as_deref().filter(|path| !is_dash(path))
    }

    /// Unknown statements are warned about and passed on, not refused.
    pub fn lax(&self) -> bool {
        self.lax
    }

    /// Programs that the input names may be run.
    pub fn allow_execute(&self) -> bool {
        self.allow_execute
    }

    /// Limits that were set, in order; what their names mean is not known here.
    pub fn limits(&self) -> &[(String, u64)] {
        &self.limit
    }

    /// Notes and warnings are not wanted.
    pub fn quiet(&self) -> bool {
        self.qt
    }

    /// Details are wanted.
    pub fn verbose(&self) -> bool {
        self.vb
    }

    /// Number of threads asked for; none is all there are.
    pub fn threads(&self) -> Option<usize> {
        self.nt.map(usize::from)
    }

    /// Input as named by the user, `-` included.
    pub(crate) fn input_named(&self) -> Option<&Path> {
        self.fi.as_deref().or(self.file.as_deref())
    }
}

fn is_dash(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// `NAME=N`
fn limit(word: &str) -> Result<(String, u64), String> {
    let (name, value) = word.split_once('=').ok_or("write NAME=N")?;
    let is_whole = !value.is_empty() && value.bytes().all(|byte| byte.is_ascii_digit());
    let value = value.parse().ok().filter(|_| is_whole).ok_or("N is not a whole number, or too large")?;
    Ok((name.to_owned(), value))
}

/// Value parser of every option that takes a number: `value_parser = ugpipe::finite`.
///
/// Takes what `f64` takes (`.9`, `5.`, `+1`, `-1e-3`) but no infinities and no NaN,
/// so `1e999` is refused too.
///
/// # Errors
/// Says that the word is not a finite number; clap names the word and the option.
pub fn finite(word: &str) -> Result<f64, String> {
    word.parse()
        .ok()
        .filter(|number: &f64| number.is_finite())
        .ok_or_else(|| "not a finite number".to_owned())
}

/// Value parser of options that take a view angle, in degrees: it is above 0 and below 180.
///
/// # Errors
/// Says so; clap names the word and the option.
pub fn view_angle(word: &str) -> Result<f64, String> {
    let degrees = finite(word)?;
    if 0.0 < degrees && degrees < 180.0 {
        Ok(degrees)
    } else {
        Err("a view angle is more than 0 and less than 180 degrees".to_owned())
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
/// `action = Set` refuses a second `-vel` (a `Vec` would otherwise grow to six numbers), and
/// `allow_hyphen_values` is needed for `-.9`, which clap does not take for a number.
///
/// None when the option was not given.
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
    fn view_angles_fit_on_a_film() {
        assert_eq!(view_angle("179.9"), Ok(179.9));
        assert!(
            [view_angle("0"), view_angle("180"), view_angle("-40"), view_angle("nan")]
                .iter()
                .all(Result::is_err)
        );
    }

    #[test]
    fn vectors_have_three_numbers() {
        assert_eq!(vector(None), None);
        assert_eq!(vector(Some(&[1.0, 2.0])), None);
        assert_eq!(vector(Some(&[1.0, 2.0, 3.0])), Some([1.0, 2.0, 3.0]));
    }
}
