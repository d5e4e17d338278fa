//! Numbers of options that are given as values instead of words: those of a frame of a film.

use crate::args::ToolArgs;
use crate::failure::Failure;
use crate::usage::in_documented_form;

/// Arguments whose numbers can be changed after parsing. [`numbers!`](crate::numbers) implements
/// it.
pub trait SetNumbers {
    /// Sets the numbers of the option with a long name, as many as were parsed. False if none of
    /// the options with numbers has this name.
    ///
    /// # Errors
    /// The first number that the option does not take, and why.
    fn set_numbers(&mut self, name: &str, numbers: &[f64]) -> Result<bool, (f64, String)>;
}

/// Implements [`SetNumbers`]: long names of options with numbers, their fields and, where not every
/// number is valid, the function that checks one; then the groups of options that are flattened
/// into these arguments.
///
/// ```
/// # #[derive(clap::Args)]
/// # struct LampArgs {
/// #[arg(long, value_parser = ugpipe::number(ugpipe::view_angle))]
/// cone: Option<f64>,
/// # }
/// ugpipe::numbers!(LampArgs { "cone" => cone: ugpipe::view_angle });
/// ```
#[macro_export]
macro_rules! numbers {
    ($args:ty { $($name:literal => $field:ident $(: $check:expr)?),* } $($group:ident)*) => {
        impl $crate::SetNumbers for $args {
            fn set_numbers(&mut self, name: &str, numbers: &[f64]) -> Result<bool, (f64, String)> {
                match name {
                    $($name => {
                        let check = $crate::numbers!(check $($check)?);
                        let checked = numbers.iter().map(|&n| check(n).map_err(|why: String| (n, why)));
                        $crate::Assign::assign(&mut self.$field, checked.collect::<Result<_, _>>()?);
                        Ok(true)
                    })*
                    _ => Ok(false $(|| $crate::SetNumbers::set_numbers(&mut self.$group, name, numbers)?)*),
                }
            }
        }
    };
    (check) => { Ok::<f64, String> };
    (check $check:expr) => { $check };
}

/// A field of an option, and the type of its values.
pub trait Assign<T> {
    /// Replaces the values.
    fn assign(&mut self, values: Vec<T>);
}

impl<T> Assign<T> for T {
    fn assign(&mut self, values: Vec<T>) {
        values.into_iter().for_each(|value| *self = value);
    }
}

impl<T> Assign<T> for Option<T> {
    fn assign(&mut self, values: Vec<T>) {
        *self = values.into_iter().next();
    }
}

impl<T> Assign<T> for Vec<T> {
    fn assign(&mut self, values: Vec<T>) {
        *self = values;
    }
}

impl<T> Assign<T> for Option<Vec<T>> {
    fn assign(&mut self, values: Vec<T>) {
        *self = Some(values);
    }
}

/// Sets the numbers of an option of a program.
///
/// # Errors
/// [`Failure::Usage`] with the message of the program, or the option has no numbers.
pub fn set_numbers<A: ToolArgs + SetNumbers>(
    args: &mut A,
    name: &str,
    numbers: &[f64],
) -> Result<(), Failure> {
    let option = || in_documented_form(&format!("--{name}"));
    match args.set_numbers(name, numbers) {
        Ok(true) => Ok(()),
        Ok(false) => Err(Failure::Usage(format!("`{}` has no numbers that could change", option()))),
        Err((number, why)) => {
            Err(Failure::Usage(format!("`{number}` is not valid for `{}`: {why}", option())))
        }
    }
}
