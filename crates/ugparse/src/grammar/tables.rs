//! Colours that change with own time.

use nom::Parser;
use nom::combinator::opt;

use super::{Grammar, NAME, number_from, option_word};
use crate::statement::{Statement, TableStatement};
use crate::token::{Input, Parsed, Reason, blank, fail, number, require, wanted};

impl Grammar<'_> {
    /// `c_time ID [-step] [-period T] [-shift T] { time color }`
    pub(super) fn table<'a>(&self, input: Input<'a>) -> Parsed<'a, Statement> {
        let (mut input, color) = wanted(self.name(input), NAME)?;
        let (mut is_stepped, mut period, mut shift) = (false, None, 0.0);
        let mut period_at = input;
        while let (rest, Some(word)) = opt(option_word).parse(input)? {
            match word {
                b"step" => (input, is_stepped) = (rest, true),
                b"period" => {
                    period_at = blank(rest)?.0;
                    let positive = number_from(f64::MIN_POSITIVE, f64::INFINITY, "a period is above 0");
                    let (rest, time) = require(positive(rest))?;
                    (input, period) = (rest, Some(time));
                }
                b"shift" => (input, shift) = require(number(rest))?,
                _ => {
                    let expected = "an own time or an option of a colour over time (-step -period -shift)";
                    return fail(blank(input)?.0, Reason::Expected(expected));
                }
            }
        }
        let mut rows = Vec::new();
        let mut least = f64::NEG_INFINITY;
        loop {
            let time = number_from(least, f64::INFINITY, "own times rise from row to row");
            let (behind, time) = match time(input) {
                Err(nom::Err::Error(_)) if !rows.is_empty() => break,
                result => require(wanted(result, "an own time"))?,
            };
            let (rest, color) = require(wanted(self.name(behind), NAME))?;
            rows.push((time, color));
            least = time.next_up();
            input = rest;
        }
        let span = rows.last().map_or(0.0, |last| last.0) - rows.first().map_or(0.0, |first| first.0);
        if period.is_some_and(|period| period <= span) {
            let remedy = "give a longer one: after it the first row follows the last";
            return fail(period_at, Reason::Impossible(1, "the period is not longer than its rows", remedy));
        }
        Ok((input, Statement::Table(TableStatement { color, is_stepped, period, shift, rows })))
    }
}
