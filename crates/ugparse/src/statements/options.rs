//! Options of statements: the word, what follows it and its place in a row, stated once for
//! reading, writing, the manual and editors.

use glam::DVec3;

use super::grammar::{Grammar, Outcome, Valid, refuse};
use crate::row_writer::RowWriter;
use crate::token::{Input, Parsed, Reason, backtrack, blank, point, word};

/// The options of a statement that makes a `T`.
pub(crate) struct OptionTable<T: 'static> {
    /// In the order in which they are written.
    pub rows: &'static [OptionRow<T>],
    /// What is expected in place of an unknown option, for messages.
    pub expected: &'static str,
}

/// An option, and where a row has its arguments.
pub(crate) struct OptionRow<T: 'static>(OptionForm, fn(&mut T) -> &mut dyn Argument);

/// How an option is written.
#[derive(Clone, Copy)]
pub(crate) struct OptionForm {
    /// The word without its dash, and its arguments, as the manual shows them: `va a [b]`.
    pub form: &'static str,
    pub valid: Valid,
}

/// A row of a table of options, for all numbers.
pub(super) const fn option<T>(
    form: &'static str,
    place: fn(&mut T) -> &mut dyn Argument,
) -> OptionRow<T> {
    valid_option(form, Valid::Any, place)
}

/// A row of a table of options.
pub(super) const fn valid_option<T>(
    form: &'static str,
    valid: Valid,
    place: fn(&mut T) -> &mut dyn Argument,
) -> OptionRow<T> {
    OptionRow(OptionForm { form, valid }, place)
}

/// The arguments of an option, in their place in a row.
pub(crate) trait Argument {
    /// Reads what follows the word of the option.
    fn read<'t>(&mut self, of: OptionForm, grammar: &mut Grammar<'t, '_>) -> Outcome<'t>;

    /// Writes the option, if its arguments are not the default.
    fn write(&mut self, _word: &str, _out: &mut RowWriter<'_>) {}
}

/// The forms of options.
pub(crate) trait Forms: Sync {
    /// Each is the word without its dash, and what follows it.
    fn forms(&self) -> Vec<&'static str>;
}

impl<T> Forms for OptionTable<T> {
    fn forms(&self) -> Vec<&'static str> {
        self.rows.iter().map(|row| row.0.form).collect()
    }
}

/// The word of an option.
pub(super) fn first_word(form: &str) -> &str {
    form.split(' ').next().unwrap_or_default()
}

/// The vector in these words has no length.
pub(super) const fn zero_vector(words: usize) -> Reason {
    Reason::Impossible(
        words,
        "the vector is zero",
        "give a vector with a direction, such as `0 0 1`",
    )
}

/// `-` and letters, without the dash.
pub(super) fn option_word(input: Input<'_>) -> Parsed<'_, Input<'_>> {
    let (input, ()) = blank(input)?;
    match input {
        [b'-', letter, ..] if letter.is_ascii_alphabetic() => word(&input[1..]),
        _ => backtrack(input, Reason::Expected("an option")),
    }
}

impl<T> OptionTable<T> {
    /// Reads all options that follow into a row.
    pub fn read<'t>(&self, row: &mut T, grammar: &mut Grammar<'t, '_>) -> Outcome<'t> {
        while self.read_one(row, grammar)? {}
        Ok(())
    }

    /// Reads the option that follows; returns false if there is none.
    pub fn read_one<'t>(&self, row: &mut T, grammar: &mut Grammar<'t, '_>) -> Outcome<'t, bool> {
        let at = grammar.rest;
        let Some(word) = grammar.optional(option_word)? else { return Ok(false) };
        let mut rows = self.rows.iter();
        let Some(OptionRow(of, place)) =
            rows.find(|OptionRow(of, _)| first_word(of.form).as_bytes() == word)
        else {
            return refuse(at, Reason::Expected(self.expected));
        };
        if matches!(of.valid, Valid::Direction) && point(grammar.rest)?.1 == DVec3::ZERO {
            return refuse(at, zero_vector(4));
        }
        place(row).read(*of, grammar)?;
        Ok(true)
    }

    /// Writes the options that a row states.
    pub fn write(&self, row: &T, out: &mut RowWriter<'_>)
    where
        T: Clone,
    {
        let mut row = row.clone();
        for OptionRow(of, place) in self.rows {
            place(&mut row).write(first_word(of.form), out);
        }
    }
}

/// Numbers one after the other.
pub(crate) trait Numbers: Default + PartialEq {
    fn list(&mut self) -> &mut [f64];
}

impl Numbers for f64 {
    fn list(&mut self) -> &mut [f64] {
        std::slice::from_mut(self)
    }
}

impl Numbers for DVec3 {
    fn list(&mut self) -> &mut [f64] {
        self.as_mut()
    }
}

impl<const N: usize> Numbers for [f64; N]
where
    [f64; N]: Default,
{
    fn list(&mut self) -> &mut [f64] {
        self
    }
}

/// Numbers in brackets may be missing, and are then the last one.
impl<N: Numbers> Argument for N {
    fn read<'t>(&mut self, of: OptionForm, grammar: &mut Grammar<'t, '_>) -> Outcome<'t> {
        let required = of.form.split(' ').skip(1).take_while(|word| !word.starts_with('['));
        let list = self.list();
        let valid = std::iter::repeat_n(of.valid, list.len());
        let numbers = grammar.numbers(valid, required.count())?;
        for (row, place) in list.iter_mut().enumerate() {
            *place = numbers[row.min(numbers.len() - 1)];
        }
        Ok(())
    }

    fn write(&mut self, word: &str, out: &mut RowWriter<'_>) {
        if *self != Self::default() {
            out.option(word, self.list());
        }
    }
}

impl<N: Numbers> Argument for Option<N> {
    fn read<'t>(&mut self, of: OptionForm, grammar: &mut Grammar<'t, '_>) -> Outcome<'t> {
        self.insert(N::default()).read(of, grammar)
    }

    fn write(&mut self, word: &str, out: &mut RowWriter<'_>) {
        self.iter_mut().for_each(|numbers| out.option(word, numbers.list()));
    }
}

/// An option without arguments.
impl Argument for bool {
    fn read<'t>(&mut self, _: OptionForm, _: &mut Grammar<'t, '_>) -> Outcome<'t> {
        *self = true;
        Ok(())
    }

    fn write(&mut self, word: &str, out: &mut RowWriter<'_>) {
        if *self {
            out.option(word, &[]);
        }
    }
}
