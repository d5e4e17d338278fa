//! Motions with a name, and their options.

use glam::DVec3;
use nom::Parser;
use nom::combinator::opt;
use ugphysics::{Event, Piece, SampledPath};
use ugscene::CurveKind;

use super::{Grammar, NAME, file, numbers, option_word, store, velocity, zero_vector};
use crate::source::Span;
use crate::statement::{MotionReference, MotionStatement, PathStatement, StatedFrame, Statement};
use crate::token::{Input, Parsed, Reason, blank, fail, mark, number, point, require, wanted};

impl<'t> Grammar<'t, '_> {
    /// `motion ID { -vel -at -acc -spin -orbit -path -on -shift }`
    pub(super) fn motion(&self, input: Input<'t>) -> Parsed<'t, Statement> {
        let (mut input, name) = wanted(self.name(input), NAME)?;
        let mut motion = MotionStatement { name, ..MotionStatement::default() };
        while let (rest, Some(word)) = opt(option_word).parse(input)? {
            input = self.motion_option(&mut motion, word, input, rest)?.0;
        }
        Ok((input, Statement::Motion(Box::new(motion))))
    }

    /// Parses the arguments of an option, which begins at `at`; `input` begins after it.
    fn motion_option(
        &self,
        motion: &mut MotionStatement,
        option: Input<'t>,
        at: Input<'t>,
        input: Input<'t>,
    ) -> Parsed<'t, ()> {
        let at = blank(at)?.0;
        let curve = CurveKind::ALL.iter().find(|kind| kind.word.as_bytes() == option);
        let path_word = match option {
            b"vel" | b"acc" => Some("vel"),
            b"path" => Some("path"),
            _ => curve.map(|kind| kind.word),
        };
        if path_word.is_some() && motion.path_word.is_some_and(|stated| Some(stated) != path_word) {
            let reason =
                Reason::Impossible(1, "the motion has another path already", CurveKind::PATHS);
            return fail(at, reason);
        }
        motion.path_word = path_word.or(motion.path_word);
        if let Some(kind) = curve {
            let (mut input, mut numbers) = (input, Vec::new());
            for row in 0..kind.n_numbers {
                if kind.axis == Some(row) && require(point(input))?.1 == DVec3::ZERO {
                    return fail(blank(input)?.0, zero_vector(3));
                }
                let (rest, value) = require(number(input))?;
                numbers.push(value);
                input = rest;
            }
            motion.path = Some(PathStatement::Curve(kind, numbers));
            return Ok((input, ()));
        }
        let rest;
        match option {
            b"vel" => (rest, motion.velocity) = require(velocity(input))?,
            b"acc" => return piece(input, 0.0, &mut motion.accelerations),
            b"path" => return store(&mut motion.path, self.path(input)),
            b"on" => {
                let name =
                    || self.name(input).map(|(rest, name)| (rest, MotionReference::Named(name)));
                let on = name().or_else(|_| self.motion_reference(input));
                return store(
                    &mut motion.on,
                    on.or_else(|_| wanted(name(), "the name of a motion")),
                );
            }
            b"at" => (rest, motion.at) = require(point(input))?,
            b"spin" => return piece(input, f64::NEG_INFINITY, &mut motion.spins),
            b"shift" => (rest, motion.shift) = shift(input)?,
            _ => return fail(at, Reason::Expected(CurveKind::OPTIONS)),
        }
        Ok((rest, ()))
    }

    /// `FILE`, `(t x y z …)` or `< NAME >`, the path of another motion
    fn path(&self, input: Input<'t>) -> Parsed<'t, PathStatement> {
        if let Ok((rest, ())) = mark(b'<', "`<`")(input) {
            let (rest, name) =
                require(wanted(self.name(rest), "the name of a motion with a path"))?;
            return Ok((require(mark(b'>', "`>`")(rest))?.0, PathStatement::Of(name)));
        }
        let Ok((list, ())) = mark(b'(', "`(`")(input) else {
            let (rest, file) =
                require(file(self.text, input, "a file name, or `(` and a list of events"))?;
            return Ok((rest, PathStatement::File(file)));
        };
        let (mut input, mut events) = (list, Vec::new());
        while let (rest, Some(t)) = opt(number).parse(input)? {
            if events.len() == SampledPath::MOST_EVENTS {
                let remedy = "give 1000000 events at most";
                return fail(
                    blank(input)?.0,
                    Reason::Impossible(1, "the path has too many events", remedy),
                );
            }
            let (rest, x) = require(point(rest))?;
            events.push(Event { t, x });
            input = rest;
        }
        let (rest, ()) = require(mark(b')', "a number or `)`")(input))?;
        let span = Span { start: self.position(list), end: self.position(rest) - 1 };
        Ok((rest, PathStatement::Events { span, events }))
    }
}

/// `[-at x y z] [-turn x y z] [-shift t x y z]`
pub(super) fn frame_options(
    mut input: Input<'_>,
    mut frame: StatedFrame,
) -> Parsed<'_, StatedFrame> {
    while let (rest, Some(word)) = opt(option_word).parse(input)? {
        match word {
            b"at" => input = store(&mut frame.at, point(rest))?.0,
            b"turn" => (input, frame.turn) = require(point(rest))?,
            b"shift" => (input, frame.shift) = shift(rest)?,
            _ => {
                return fail(
                    blank(input)?.0,
                    Reason::Expected("`>` or an option (-at -turn -shift)"),
                );
            }
        }
    }
    Ok((input, frame))
}

/// `t x y z`
fn shift(input: Input<'_>) -> Parsed<'_, Event> {
    let (rest, [t, x, y, z]) = numbers(input)?;
    Ok((rest, Event { t, x: DVec3::new(x, y, z) }))
}

/// `x y z [τ0 τ1]`: a vector, and the own time from which to which it acts, added to `pieces`.
fn piece<'a>(input: Input<'a>, default_begin: f64, pieces: &mut Vec<Piece>) -> Parsed<'a, ()> {
    let (input, of) = require(point(input))?;
    let at = blank(input)?.0;
    let (input, from) = opt(number).parse(input)?;
    let (input, [from, to]) = match from {
        Some(from) => require(number(input)).map(|(rest, to)| (rest, [from, to]))?,
        None => (input, [default_begin, f64::INFINITY]),
    };
    if from >= to {
        let remedy = "give the own time at which it begins, and a later one at which it ends";
        return fail(at, Reason::Impossible(2, "the time is empty", remedy));
    }
    pieces.push(Piece { of, from, to });
    Ok((input, ()))
}
