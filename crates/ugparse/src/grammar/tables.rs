//! Colours that change with own time, that are pictures, and that emit light.

use nom::Parser;
use nom::combinator::opt;

use ugscene::{AlphaMode, ColorTable, Texture, TextureImage, Wrap};

use super::{Grammar, NAME, file, number_from, option_word, pairs};
use crate::statement::Statement;
use crate::token::{
    Input, Parsed, Reason, backtrack, blank, fail, integer, number, number32, require, wanted, word,
};

impl<'t> Grammar<'t, '_> {
    /// `c_time ID [-step] [-period T] [-shift T] { time color }`
    pub(super) fn table(&mut self, input: Input<'t>) -> Parsed<'t, Statement> {
        let (mut input, name) = wanted(self.name(input), NAME)?;
        let color = self.color_id(name);
        let (mut is_stepped, mut period, mut shift) = (false, None, 0.0);
        let mut period_at = input;
        while let (rest, Some(word)) = opt(option_word).parse(input)? {
            match word {
                b"step" => (input, is_stepped) = (rest, true),
                b"period" => {
                    period_at = blank(rest)?.0;
                    let positive =
                        number_from(f64::MIN_POSITIVE, f64::INFINITY, "a period is above 0");
                    let (rest, time) = require(positive(rest))?;
                    (input, period) = (rest, Some(time));
                }
                b"shift" => (input, shift) = require(number(rest))?,
                _ => {
                    let expected =
                        "an own time or an option of a colour over time (-step -period -shift)";
                    return fail(blank(input)?.0, Reason::Expected(expected));
                }
            }
        }
        let mut least = f64::NEG_INFINITY;
        let time = |input| {
            let read = number_from(least, f64::INFINITY, "own times rise from row to row")(input);
            wanted(read.inspect(|(_, time)| least = time.next_up()), "an own time")
        };
        let (input, rows) = pairs(input, time, |input| wanted(self.color_name(input), NAME))?;
        let span =
            rows.last().map_or(0.0, |last| last.0) - rows.first().map_or(0.0, |first| first.0);
        if period.is_some_and(|period| period <= span) {
            let remedy = "give a longer one: after it the first row follows the last";
            return fail(
                period_at,
                Reason::Impossible(1, "the period is not longer than its rows", remedy),
            );
        }
        Ok((input, Statement::Table(name, ColorTable { color, rows, is_stepped, period, shift })))
    }

    /// `c_tex ID FILE [-image N] [-wrap MODE [MODE]] [-factor r g b [a]] [-mask [cutoff] | -blend]
    /// [-nearest]`
    pub(super) fn texture(&mut self, input: Input<'t>) -> Parsed<'t, Statement> {
        let (input, color) = wanted(self.color_name(input), NAME)?;
        let (mut input, file) = require(file(self.text, input, "the file of a picture"))?;
        // The bytes of the picture are set when the colours of all scopes are joined.
        let image =
            TextureImage { file: Some(file.name.lossy(self.text)), ..TextureImage::default() };
        let mut texture = Texture::new(color, image);
        while let (rest, Some(option)) = opt(option_word).parse(input)? {
            match option {
                b"wrap" => {
                    let (rest, u) = require(wrap(rest))?;
                    let (rest, v) = opt(wrap).parse(rest)?;
                    (input, texture.wrap) = (rest, [u, v.unwrap_or(u)]);
                }
                b"factor" => {
                    let mut behind = rest;
                    for channel in &mut texture.factor[..3] {
                        (behind, *channel) = require(factor(behind))?;
                    }
                    let (behind, alpha) = opt(factor).parse(behind)?;
                    texture.factor[3] = alpha.unwrap_or(1.0);
                    input = behind;
                }
                b"mask" => {
                    let (rest, cutoff) = opt(factor).parse(rest)?;
                    (input, texture.alpha) = (rest, AlphaMode::Mask(cutoff.unwrap_or(0.5)));
                }
                b"image" => {
                    let (rest, row) =
                        require(wanted(integer(rest), "the number of a picture, from 0"))?;
                    // No mesh has so many; those beyond are refused with the mesh.
                    (input, texture.image.row) =
                        (rest, Some(u32::try_from(row).unwrap_or(u32::MAX)));
                }
                b"blend" => (input, texture.alpha) = (rest, AlphaMode::Blend),
                b"nearest" => (input, texture.is_nearest) = (rest, true),
                _ => {
                    let expected = "`;` or an option of a picture (-image -wrap -factor -mask -blend -nearest)";
                    return fail(blank(input)?.0, Reason::Expected(expected));
                }
            }
        }
        Ok((input, Statement::Texture(texture, file)))
    }

    /// `c_emit ID color`
    pub(super) fn emission(&mut self, input: Input<'t>) -> Parsed<'t, Statement> {
        let (input, color) = wanted(self.color_name(input), NAME)?;
        let (input, emitted) = wanted(self.color_name(input), NAME)?;
        Ok((input, Statement::Emission([color, emitted])))
    }
}

/// What is beyond the edges of a picture.
fn wrap(input: Input<'_>) -> Parsed<'_, Wrap> {
    match word(input) {
        Ok((rest, name))
            if let Some(wrap) =
                Wrap::ALL.into_iter().find(|wrap| wrap.name().as_bytes() == name) =>
        {
            Ok((rest, wrap))
        }
        _ => backtrack(input, Reason::Expected("`repeat`, `clamp` or `mirror`")),
    }
}

/// A number, 0 or more.
fn factor(input: Input<'_>) -> Parsed<'_, f32> {
    let (rest, value) = number32(input)?;
    if value < 0.0 {
        return fail(blank(input)?.0, Reason::OutOfRange("a factor is 0 or more"));
    }
    Ok((rest, value))
}
