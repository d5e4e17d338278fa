//! `i` and `a`, and their transformations.

use glam::DVec3;

use super::grammar::{Grammar, Outcome, refuse};
use super::options::{Forms, first_word, option_word, zero_vector};
use crate::statement::{Call, Repeat};
use crate::token::{Reason, integer, mark, number};
use crate::transform::Transform;

/// The transformations, which apply from left to right.
pub(super) static TRANSFORMS: Transforms = Transforms(&[
    row("tx d", 1, |n| Some(Transform::translate(DVec3::X * n[0]))),
    row("ty d", 1, |n| Some(Transform::translate(DVec3::Y * n[0]))),
    row("tz d", 1, |n| Some(Transform::translate(DVec3::Z * n[0]))),
    row("ta x y z", 3, |n| Some(Transform::translate(vector(n)))),
    row("tv x y z d", 4, |n| Transform::translate_along(vector(n), n[3])),
    row("sx k", 1, |n| Some(Transform::scale(DVec3::ONE.with_x(n[0])))),
    row("sy k", 1, |n| Some(Transform::scale(DVec3::ONE.with_y(n[0])))),
    row("sz k", 1, |n| Some(Transform::scale(DVec3::ONE.with_z(n[0])))),
    row("sa k", 1, |n| Some(Transform::scale(DVec3::splat(n[0])))),
    row("sv x y z k", 4, |n| Transform::scale_along(vector(n), n[3])),
    row("rx degrees", 1, |n| Transform::rotate(DVec3::X, n[0])),
    row("ry degrees", 1, |n| Transform::rotate(DVec3::Y, n[0])),
    row("rz degrees", 1, |n| Transform::rotate(DVec3::Z, n[0])),
    row("ra ax ay az", 3, |n| {
        let [x, y, z] = [0, 1, 2].map(|axis| Transform::rotate(DVec3::AXES[axis], n[axis]));
        Some(x?.then(&y?).then(&z?))
    }),
    row("rv x y z degrees", 4, |n| Transform::rotate(vector(n), n[3])),
    row("mx", 0, |_| Some(Transform::mirror(DVec3::ONE.with_x(-1.0)))),
    row("my", 0, |_| Some(Transform::mirror(DVec3::ONE.with_y(-1.0)))),
    row("mz", 0, |_| Some(Transform::mirror(DVec3::ONE.with_z(-1.0)))),
    row("ma", 0, |_| Some(Transform::mirror(DVec3::NEG_ONE))),
    row("mv x y z", 3, |n| Transform::mirror_across(vector(n))),
    row("M3", 9, |n| Some(Transform::rows3(n.first_chunk()?))),
    row("M4", 16, |n| Transform::rows4(n.first_chunk()?)),
]);

pub(super) struct Transforms(&'static [Row]);

struct Row {
    /// The form of the option: its name without the dash, then its arguments.
    form: &'static str,
    n_numbers: usize,
    /// `None` for a vector without length, or a matrix that is not affine.
    transform: fn(&[f64]) -> Option<Transform>,
}

const fn row(
    form: &'static str,
    n_numbers: usize,
    transform: fn(&[f64]) -> Option<Transform>,
) -> Row {
    Row { form, n_numbers, transform }
}

fn vector(numbers: &[f64]) -> DVec3 {
    DVec3::from_slice(numbers)
}

impl Forms for Transforms {
    fn forms(&self) -> Vec<&'static str> {
        self.0.iter().map(|row| row.form).collect()
    }
}

impl<'t> Grammar<'t, '_> {
    pub fn call(&mut self, is_array: bool) -> Outcome<'t> {
        let name = self.optional_name()?;
        self.take(mark(b'(', "`(` and the name of a definition"))?;
        let definition = self.name("the name of a definition")?;
        let color = self.optional_color()?;
        let inner = self.transforms()?;
        self.take(mark(b')', "a transformation such as `-tx` or `)`"))?;
        let repeat = if is_array {
            Repeat::Times(self.take(integer)?, self.transforms()?)
        } else {
            Repeat::Once
        };
        let motion = self.optional_motion()?;
        let (before, target, label) = (self.scope.counts(), None, String::new());
        let call = Call { name, definition, color, inner, repeat, motion, before, target, label };
        self.end_row(|scope| &mut scope.calls, call)
    }

    fn transforms(&mut self) -> Outcome<'t, Transform> {
        let start = self.rest;
        let mut total = Transform::IDENTITY;
        loop {
            let at = self.rest;
            let Some(word) = self.optional(option_word)? else { break };
            let known = TRANSFORMS.0.iter().find(|row| first_word(row.form).as_bytes() == word);
            let Some(row) = known else { return refuse(at, UNKNOWN) };
            let mut numbers = [0.0; 16];
            for value in &mut numbers[..row.n_numbers] {
                *value = self.take(number)?;
            }
            let Some(one) = (row.transform)(&numbers[..row.n_numbers]) else {
                return refuse(at, if row.n_numbers == 16 { NOT_AFFINE } else { zero_vector(4) });
            };
            total = total.then(&one);
        }
        if total.is_finite() {
            return Ok(total);
        }
        let remedy = "use smaller numbers";
        refuse(start, Reason::Impossible(1, "the transformation overflows", remedy))
    }
}

const UNKNOWN: Reason = Reason::Expected(
    "a transformation (`-s`, `-t`, `-r` or `-m` with `x`, `y`, `z`, `a` or `v`, or `-M3`, `-M4`)",
);

const NOT_AFFINE: Reason = Reason::Impossible(
    17,
    "this matrix is not affine",
    "its last column must be 0 0 0 1; a translation is in the last row",
);
