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
        return fail(start, Reason::Impossible(1, "the transformation overflows", "use smaller numbers"));
    }
    Ok((input, total))
}

/// Parses one transformation; `at` is its dash, `input` begins after its name.
fn transform<'a>(name: Input<'a>, at: Input<'a>, input: Input<'a>) -> Parsed<'a, Transform> {
    let axis = |letter: u8| match letter {
        b'x' => DVec3::X,
        b'y' => DVec3::Y,
        _ => DVec3::Z,
    };
    let along_vector = |make: fn(DVec3, f64) -> Option<Transform>| {
        let (rest, [x, y, z, amount]) = numbers(input)?;
        non_zero(make(DVec3::new(x, y, z), amount), at, rest)
    };
    match *name {
        [b's', letter @ (b'x' | b'y' | b'z')] => {
            let (rest, factor) = require(number(input))?;
            Ok((
                rest,
                Transform::scale(DVec3::select(
                    axis(letter).cmpeq(DVec3::ONE),
                    DVec3::splat(factor),
                    DVec3::ONE,
                )),
            ))
        }
        [b's', b'a'] => {
            let (rest, factor) = require(number(input))?;
            Ok((rest, Transform::scale(DVec3::splat(factor))))
        }
        [b's', b'v'] => along_vector(Transform::scale_along),
        [b't', letter @ (b'x' | b'y' | b'z')] => {
            let (rest, amount) = require(number(input))?;
            Ok((rest, Transform::translate(axis(letter) * amount)))
        }
        [b't', b'a'] => {
            let (rest, offset) = require(point(input))?;
            Ok((rest, Transform::translate(offset)))
        }
        [b't', b'v'] => along_vector(Transform::translate_along),
        [b'r', letter @ (b'x' | b'y' | b'z')] => {
            let (rest, degrees) = require(number(input))?;
            non_zero(Transform::rotate(axis(letter), degrees), at, rest)
        }
        [b'r', b'a'] => {
            let (rest, degrees) = numbers::<3>(input)?;
            let turns = [DVec3::X, DVec3::Y, DVec3::Z]
                .into_iter()
                .zip(degrees)
                .try_fold(Transform::IDENTITY, |sum, (axis, angle)| {
                    Some(sum.then(&Transform::rotate(axis, angle)?))
                });
            non_zero(turns, at, rest)
        }
        [b'r', b'v'] => along_vector(Transform::rotate),
        [b'm', letter @ (b'x' | b'y' | b'z')] => {
            Ok((input, Transform::mirror(DVec3::ONE - axis(letter) * 2.0)))
        }
        [b'm', b'a'] => Ok((input, Transform::mirror(DVec3::NEG_ONE))),
        [b'm', b'v'] => {
            let (rest, vector) = require(point(input))?;
            non_zero(Transform::mirror_across(vector), at, rest)
        }
        [b'M', b'3'] => {
            let (rest, m) = numbers::<9>(input)?;
            Ok((rest, Transform::rows3(&m)))
        }
        [b'M', b'4'] => {
            let (rest, m) = numbers::<16>(input)?;
            match Transform::rows4(&m) {
                Some(map) => Ok((rest, map)),
                None => fail(
                    at,
                    Reason::Impossible(
                        17,
                        "this matrix is not affine",
                        "its last column must be 0 0 0 1; a translation is in the last row",
                    ),
                ),
            }
        }
        _ => fail(
            at,
            Reason::Expected(
                "a transformation (`-s`, `-t`, `-r` or `-m` with `x`, `y`, `z`, `a` or `v`, or `-M3`, `-M4`)",
            ),
        ),
    }
}

fn non_zero<'a>(map: Option<Transform>, at: Input<'a>, rest: Input<'a>) -> Parsed<'a, Transform> {
    match map {
        Some(map) => Ok((rest, map)),
        None => fail(at, zero_vector(4)),
    }
}
