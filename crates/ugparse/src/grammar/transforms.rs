//! Transformations of instances and arrays.

use glam::DVec3;
use nom::Parser;
use nom::combinator::opt;

use super::{numbers, option_word, zero_vector};
use crate::token::{Input, Parsed, Reason, blank, fail, number, point, require};
use crate::transform::Transform;

/// `{ -tx 1 … }`: the transformations of an instance, from left to right.
pub(super) fn transforms(mut input: Input<'_>) -> Parsed<'_, Transform> {
    let start = blank(input)?.0;
    let mut total = Transform::IDENTITY;
    while let (rest, Some(name)) = opt(option_word).parse(input)? {
        let at = blank(input)?.0;
        let (rest, one) = transform(name, at, rest)?;
        total = total.then(&one);
        input = rest;
    }
    if !total.is_finite() {
        return fail(
            start,
            Reason::Impossible(1, "the transformation overflows", "use smaller numbers"),
        );
    }
    Ok((input, total))
}

/// Parses one transformation; `at` is its dash, `input` begins after its name.
fn transform<'a>(name: Input<'a>, at: Input<'a>, input: Input<'a>) -> Parsed<'a, Transform> {
    const UNKNOWN: Reason = Reason::Expected(
        "a transformation (`-s`, `-t`, `-r` or `-m` with `x`, `y`, `z`, `a` or `v`, or `-M3`, `-M4`)",
    );
    const NOT_AFFINE: Reason = Reason::Impossible(
        17,
        "this matrix is not affine",
        "its last column must be 0 0 0 1; a translation is in the last row",
    );
    let &[kind, on] = name else { return fail(at, UNKNOWN) };
    let axis = match on {
        b'x' => Some(DVec3::X),
        b'y' => Some(DVec3::Y),
        b'z' => Some(DVec3::Z),
        _ => None,
    };
    fn with<'a, T>(
        parsed: Parsed<'a, T>,
        make: impl FnOnce(T) -> Option<Transform>,
    ) -> Parsed<'a, Option<Transform>> {
        let (rest, argument) = require(parsed)?;
        Ok((rest, make(argument)))
    }
    let along_vector = |make: fn(DVec3, f64) -> Option<Transform>| {
        with((point, number).parse(input), |(vector, amount)| make(vector, amount))
    };
    let (rest, map) = match (kind, on, axis) {
        (b's', _, Some(axis)) => with(number(input), |factor| {
            let factors = DVec3::select(axis.cmpeq(DVec3::ONE), DVec3::splat(factor), DVec3::ONE);
            Some(Transform::scale(factors))
        })?,
        (b's', b'a', _) => {
            with(number(input), |factor| Some(Transform::scale(DVec3::splat(factor))))?
        }
        (b's', b'v', _) => along_vector(Transform::scale_along)?,
        (b't', _, Some(axis)) => {
            with(number(input), |amount| Some(Transform::translate(axis * amount)))?
        }
        (b't', b'a', _) => with(point(input), |offset| Some(Transform::translate(offset)))?,
        (b't', b'v', _) => along_vector(Transform::translate_along)?,
        (b'r', _, Some(axis)) => with(number(input), |degrees| Transform::rotate(axis, degrees))?,
        (b'r', b'a', _) => with(numbers::<3>(input), |degrees| {
            let mut turns = DVec3::AXES.into_iter().zip(degrees);
            let then =
                |sum: Transform, (axis, angle)| Some(sum.then(&Transform::rotate(axis, angle)?));
            turns.try_fold(Transform::IDENTITY, then)
        })?,
        (b'r', b'v', _) => along_vector(Transform::rotate)?,
        (b'm', _, Some(axis)) => (input, Some(Transform::mirror(DVec3::ONE - axis * 2.0))),
        (b'm', b'a', _) => (input, Some(Transform::mirror(DVec3::NEG_ONE))),
        (b'm', b'v', _) => with(point(input), Transform::mirror_across)?,
        (b'M', b'3', _) => with(numbers::<9>(input), |m| Some(Transform::rows3(&m)))?,
        (b'M', b'4', _) => {
            let (rest, m) = numbers::<16>(input)?;
            return Transform::rows4(&m)
                .map_or_else(|| fail(at, NOT_AFFINE), |map| Ok((rest, map)));
        }
        _ => return fail(at, UNKNOWN),
    };
    map.map_or_else(|| fail(at, zero_vector(4)), |map| Ok((rest, map)))
}
