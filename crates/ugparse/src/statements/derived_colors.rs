//! Colours made of others: mixtures (`c_mix`), changes over own time (`c_time`), textures (`c_tex`)
//! and emitted light (`c_emit`).

use ugscene::{
    AlphaMode, Color, ColorId, ColorTable, ColorValue, Mix, NameId, Texture, TextureImage, Wrap,
};

use super::grammar::{Grammar, NAME, Outcome, Valid, refuse};
use super::options::{Argument, OptionForm, OptionTable, option, option_word, valid_option};
use crate::request::RequestKind;
use crate::row_writer::{RowWriter, WriteRow};
use crate::statement::RequestStatement;
use crate::token::{Input, Parsed, Reason, backtrack, fail, integer, number32, wanted, word};

pub(super) static TIMES: OptionTable<ColorTable> = OptionTable {
    rows: &[
        option("step", |table| &mut table.is_stepped),
        valid_option("period T", Valid::positive("a period is above 0"), |table| &mut table.period),
        option("shift T", |table| &mut table.shift),
    ],
    expected: "an own time or an option of a colour over time (-step -period -shift)",
};

pub(super) static TEXTURE: OptionTable<Texture> = OptionTable {
    rows: &[
        option("image N", |texture| &mut texture.image.row),
        option("wrap MODE [MODE]", |texture| &mut texture.wrap),
        option("factor r g b [a]", |texture| &mut texture.factor),
        option("mask [cutoff]", |texture| &mut texture.alpha),
        option("blend", |texture| &mut texture.alpha),
        option("nearest", |texture| &mut texture.is_nearest),
    ],
    expected: "`;` or an option of a picture (-image -wrap -factor -mask -blend -nearest)",
};

impl<'t> Grammar<'t, '_> {
    pub fn mix(&mut self) -> Outcome<'t> {
        let color = self.color_name()?;
        let parts = self.pairs(Self::color_name, |grammar| grammar.number(Valid::SHARE))?;
        self.end_row(|scope| &mut scope.mixes, Mix { color, parts })
    }

    pub fn times(&mut self) -> Outcome<'t> {
        let name = self.name(NAME)?;
        let color = self.color_id(name);
        let mut table =
            ColorTable { color, rows: Vec::new(), is_stepped: false, period: None, shift: 0.0 };
        let mut period_at = self.rest;
        loop {
            if let Ok((behind, b"period")) = option_word(self.rest) {
                period_at = behind;
            }
            if !TIMES.read_one(&mut table, self)? {
                break;
            }
        }
        let mut least = f64::NEG_INFINITY;
        let time = |grammar: &mut Self| {
            let rule = "own times rise from row to row";
            let valid = Valid::Range(least, f64::INFINITY, rule);
            let time = grammar.take(|input| wanted(valid.read(input), "an own time"));
            time.inspect(|time| least = time.next_up())
        };
        table.rows = self.pairs(time, Self::color_name)?;
        let span = table.rows[table.rows.len() - 1].0 - table.rows[0].0;
        if table.period.is_some_and(|period| period <= span) {
            let remedy = "give a longer one: after it the first row follows the last";
            let problem = "the period is not longer than its rows";
            return refuse(period_at, Reason::Impossible(1, problem, remedy));
        }
        let span = self.end()?;
        // It is a colour, too, whose own value is set when the colours of all scopes are joined.
        let value = ColorValue::Rgb([1.0; 3]);
        let color = Color { name: NameId::from_index(0), value, translucency: 0.0 };
        self.scope.add_color(self.text, span, Some(name), color);
        self.scope.color_tables.push(table, span);
        Ok(())
    }

    pub fn texture(&mut self) -> Outcome<'t> {
        let color = self.color_name()?;
        let file = self.file("the file of a picture")?;
        // The bytes of the picture are set when the colours of all scopes are joined.
        let image =
            TextureImage { file: Some(file.name.lossy(self.text)), ..TextureImage::default() };
        let mut texture = Texture::new(color, image);
        TEXTURE.read(&mut texture, self)?;
        let span = self.end()?;
        let row = texture.image.row;
        self.requests.push(RequestStatement { row, ..file.request(RequestKind::Image) });
        self.scope.textures.push(texture, span);
        Ok(())
    }

    pub fn emission(&mut self) -> Outcome<'t> {
        let colors = [self.color_name()?, self.color_name()?];
        self.end_row(|scope| &mut scope.emissions, colors)
    }
}

/// Writes `c_mix`.
impl WriteRow for Mix {
    fn write(&self, out: &mut RowWriter<'_>) {
        out.begin_color("c_mix", self.color);
        for &(part, share) in &self.parts {
            out.color(part);
            out.number(share);
        }
    }
}

/// Writes `c_time`.
pub(crate) fn write_times(table: &ColorTable, out: &mut RowWriter<'_>) {
    out.begin_color("c_time", table.color);
    TIMES.write(table, out);
    for &(time, color) in &table.rows {
        out.number(time);
        out.color(color);
    }
}

/// Writes `c_tex`.
impl WriteRow for Texture {
    fn write(&self, out: &mut RowWriter<'_>) {
        out.begin_color("c_tex", self.color);
        out.quoted(self.image.file.as_deref().unwrap_or_default());
        TEXTURE.write(self, out);
    }
}

/// Writes `c_emit`.
impl WriteRow for [ColorId; 2] {
    fn write(&self, out: &mut RowWriter<'_>) {
        out.begin_color("c_emit", self[0]);
        out.color(self[1]);
    }
}

/// The row of a picture.
impl Argument for Option<u32> {
    fn read<'t>(&mut self, _: OptionForm, grammar: &mut Grammar<'t, '_>) -> Outcome<'t> {
        let what = "the number of a picture, from 0";
        let row = grammar.take(|input| wanted(integer(input), what))?;
        // No mesh has so many; those beyond are refused with the mesh.
        *self = Some(u32::try_from(row).unwrap_or(u32::MAX));
        Ok(())
    }

    fn write(&mut self, word: &str, out: &mut RowWriter<'_>) {
        self.iter().for_each(|&row| out.option(word, &[row.into()]));
    }
}

/// What is beyond the edges of a picture, along u and v.
impl Argument for [Wrap; 2] {
    fn read<'t>(&mut self, _: OptionForm, grammar: &mut Grammar<'t, '_>) -> Outcome<'t> {
        let u = grammar.take(wrap)?;
        *self = [u, grammar.optional(wrap)?.unwrap_or(u)];
        Ok(())
    }

    fn write(&mut self, word: &str, out: &mut RowWriter<'_>) {
        let [u, v] = self.map(Wrap::name);
        match *self {
            [Wrap::Repeat, Wrap::Repeat] => {}
            [one, other] if one == other => out.text(&format!(" -{word} {u}")),
            _ => out.text(&format!(" -{word} {u} {v}")),
        }
    }
}

fn wrap(input: Input<'_>) -> Parsed<'_, Wrap> {
    if let Ok((rest, name)) = word(input)
        && let Some(wrap) = Wrap::ALL.into_iter().find(|wrap| wrap.name().as_bytes() == name)
    {
        return Ok((rest, wrap));
    }
    backtrack(input, Reason::Expected("`repeat`, `clamp` or `mirror`"))
}

/// Factors of red, green, blue and alpha.
impl Argument for [f32; 4] {
    fn read<'t>(&mut self, _: OptionForm, grammar: &mut Grammar<'t, '_>) -> Outcome<'t> {
        for channel in &mut self[..3] {
            *channel = grammar.take(factor)?;
        }
        self[3] = grammar.optional(factor)?.unwrap_or(1.0);
        Ok(())
    }

    fn write(&mut self, word: &str, out: &mut RowWriter<'_>) {
        if *self != [1.0; 4] {
            out.option(word, &[]);
            let n = if self[3] == 1.0 { 3 } else { 4 };
            self[..n].iter().for_each(|&factor| out.number32(factor));
        }
    }
}

/// `-mask` or `-blend`
impl Argument for AlphaMode {
    fn read<'t>(&mut self, of: OptionForm, grammar: &mut Grammar<'t, '_>) -> Outcome<'t> {
        *self = match of.form {
            "blend" => Self::Blend,
            _ => Self::Mask(grammar.optional(factor)?.unwrap_or(0.5)),
        };
        Ok(())
    }

    fn write(&mut self, word: &str, out: &mut RowWriter<'_>) {
        match (*self, word) {
            (Self::Mask(cutoff), "mask") => {
                out.option(word, &[]);
                out.number32(cutoff);
            }
            (Self::Blend, "blend") => out.option(word, &[]),
            _ => {}
        }
    }
}

/// A number, 0 or more.
fn factor(input: Input<'_>) -> Parsed<'_, f32> {
    let (rest, value) = number32(input)?;
    if value < 0.0 {
        return fail(input, Reason::OutOfRange("a factor is 0 or more"));
    }
    Ok((rest, value))
}
