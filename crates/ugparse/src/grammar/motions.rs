//! Motions with a name, and their options.

use glam::DVec3;
use nom::Parser;
use nom::combinator::opt;
use ugphysics::{Event, Piece};
use ugscene::StatedMotion;

use super::{Grammar, NAME, numbers, option_word, velocity, zero_vector};
use crate::statement::{MotionStatement, Statement};
use crate::token::{Input, Parsed, Reason, blank, fail, number, point, require, wanted};

impl Grammar<'_> {
    /// `motion ID { -vel -at -acc -spin -orbit -on -shift }`
    pub(super) fn motion<'a>(&self, input: Input<'a>) -> Parsed<'a, Statement> {
        let (mut input, name) = wanted(self.name(input), NAME)?;
        let mut motion = MotionStatement {
            name,
            at: DVec3::ZERO,
            velocity: None,
            accelerations: Vec::new(),
            spins: Vec::new(),
            orbit: None,
            on: None,
            shift: StatedMotion::NO_SHIFT,
        };
        while let (rest, Some(word)) = opt(option_word).parse(input)? {
            input = self.motion_option(&mut motion, word, input, rest)?.0;
        }
        Ok((input, Statement::Motion(Box::new(motion))))
    }

    /// Parses the arguments of an option, which begins at `at`; `input` begins after it.
    fn motion_option<'a>(
        &self,
        motion: &mut MotionStatement,
        option: Input<'a>,
        at: Input<'a>,
        input: Input<'a>,
    ) -> Parsed<'a, ()> {
        let at = blank(at)?.0;
        let is_path =
            |motion: &MotionStatement| motion.velocity.is_some() || !motion.accelerations.is_empty();
        let rest = match option {
            b"vel" if motion.orbit.is_none() && motion.on.is_none() => {
                let (rest, velocity) = velocity(input)?;
                motion.velocity = Some(velocity);
                rest
            }
            b"acc" if motion.orbit.is_none() && motion.on.is_none() => {
                let (rest, piece) = piece(input, 0.0)?;
                motion.accelerations.push(piece);
                rest
            }
            b"orbit" if !is_path(motion) && motion.on.is_none() => {
                let (rest, center) = require(point(input))?;
                let axis_at = blank(rest)?.0;
                let (rest, axis) = require(point(rest))?;
                if axis == DVec3::ZERO {
                    return fail(axis_at, zero_vector(3));
                }
                let (rest, rate) = require(number(rest))?;
                motion.orbit = Some((center, axis, rate));
                rest
            }
            b"on" if !is_path(motion) && motion.orbit.is_none() => {
                let (rest, on) = require(wanted(self.name(input), "the name of a motion"))?;
                motion.on = Some(on);
                rest
            }
            b"vel" | b"acc" | b"orbit" | b"on" => {
                let remedy = "give `-vel` and `-acc`, or `-orbit`, or `-on`";
                return fail(at, Reason::Impossible(1, "the motion has another path already", remedy));
            }
            b"at" => {
                let (rest, place) = require(point(input))?;
                motion.at = place;
                rest
            }
            b"spin" => {
                let (rest, piece) = piece(input, f64::NEG_INFINITY)?;
                motion.spins.push(piece);
                rest
            }
            b"shift" => {
                let (rest, [t, x, y, z]) = numbers(input)?;
                motion.shift = Event { t, x: DVec3::new(x, y, z) };
                rest
            }
            _ => {
                let expected = "an option of a motion (-vel -at -acc -spin -orbit -on -shift)";
                return fail(at, Reason::Expected(expected));
            }
        };
        Ok((rest, ()))
    }
}

/// `x y z [τ0 τ1]`: a vector, and the own time from which to which it acts.
fn piece(input: Input<'_>, default_begin: f64) -> Parsed<'_, Piece> {
    let (input, of) = require(point(input))?;
    let at = blank(input)?.0;
    let (input, from) = opt(number).parse(input)?;
    let Some(from) = from else {
        return Ok((input, Piece { of, from: default_begin, to: f64::INFINITY }));
    };
    let (input, to) = require(number(input))?;
    if from >= to {
        let remedy = "give the own time at which it begins, and a later one at which it ends";
        return fail(at, Reason::Impossible(2, "the time is empty", remedy));
    }
    Ok((input, Piece { of, from, to }))
}
