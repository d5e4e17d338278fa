//! The statements of the language, as nom parsers.
//!
//! Each parser reads one statement behind its keyword, up to but without the
//! closing `;`. One token of look-ahead decides everything.

use glam::DVec3;
use nom::Parser;
use nom::combinator::opt;

use crate::names::NameId;
use crate::scene::{Camera, ColorValue, Projection, Surface};
use crate::source::Span;
use crate::statement::{
    CallStatement, CameraStatement, ColorStatement, FaceStatement, IllumStatement, LightStatement,
    References, Repeat, Statement, SurfaceStatement, VertexStatement,
};
use crate::token::{
    Input, Parsed, Reason, backtrack, blank, fail, identifier, integer, mark, number, point, require, wanted,
    word,
};
use crate::transform::Transform;

/// The statement keywords, as messages list them.
pub(crate) const KEYWORDS: &str = "v w f c c_rgb c_xyz c_bb c_spd surf l cam def end i a include execute";

/// A reader of one text; knows the text's length, and so where a rest of it begins.
pub(crate) struct Grammar<'t> {
    pub text: &'t [u8],
}

impl<'t> Grammar<'t> {
    /// Byte position at which `rest` begins.
    pub fn position(&self, rest: Input<'_>) -> u32 {
        // Reading refuses texts of 4 GiB and more.
        (self.text.len() - rest.len()) as u32
    }

    /// The span of a word that ends where `rest` begins.
    fn span(&self, word: Input<'_>, rest: Input<'_>) -> Span {
        let end = self.position(rest);
        Span { start: end - word.len() as u32, end }
    }

    fn name<'a>(&self, input: Input<'a>) -> Parsed<'a, Span> {
        let (rest, name) = identifier(input)?;
        Ok((rest, self.span(name, rest)))
    }

    fn optional_name<'a>(&self, input: Input<'a>) -> Parsed<'a, Option<Span>> {
        opt(|i| self.name(i)).parse(input)
    }

    /// The body of a statement; `None` if the keyword is not one of ours.
    pub fn statement<'a>(
        &self,
        keyword: &[u8],
        input: Input<'a>,
        references: &mut References,
    ) -> Option<Parsed<'a, Statement>> {
        Some(match keyword {
            b"v" => self.vertex(input),
            b"f" => self.face(input, references),
            b"w" => self.wire(input, references),
            b"c" => self.color(input),
            b"c_rgb" => self.rgb(input),
            b"c_xyz" => self.xyz(input),
            b"c_bb" => self.blackbody(input),
            b"c_spd" => self.spectrum(input),
            b"surf" => self.surface(input),
            b"l" => self.light(input),
            b"cam" => self.camera(input),
            b"i" => self.call(input, false),
            b"a" => self.call(input, true),
            _ => return None,
        })
    }

    /// `v ID x y z [color] [nx ny nz]`
    fn vertex<'a>(&self, input: Input<'a>) -> Parsed<'a, Statement> {
        let (input, name) = wanted(self.name(input), NAME)?;
        let (input, position) = point(input)?;
        let (input, color) = self.optional_name(input)?;
        let (rest, normal) = opt(point).parse(input)?;
        if normal == Some(DVec3::ZERO) {
            return fail(blank(input)?.0, zero_vector(3));
        }
        Ok((rest, Statement::Vertex(VertexStatement { name, position, color, normal })))
    }

    /// `f [ID] contours [color] [illum] [< x y z >]`
    fn face<'a>(&self, input: Input<'a>, references: &mut References) -> Parsed<'a, Statement> {
        let (input, name) = self.optional_name(input)?;
        let (input, ()) = self.contours(input, references)?;
        let (input, color) = self.optional_name(input)?;
        let (input, illum) = self.illum(input)?;
        let (input, velocity) = opt(velocity).parse(input)?;
        Ok((input, Statement::Face(FaceStatement { name, color, illum, velocity })))
    }

    /// `number` or `surface`
    fn illum<'a>(&self, input: Input<'a>) -> Parsed<'a, Option<IllumStatement>> {
        if let (rest, Some(surface)) = self.optional_name(input)? {
            return Ok((rest, Some(IllumStatement::Surface(surface))));
        }
        let (rest, level) = opt(number).parse(input)?;
        Ok((rest, level.map(IllumStatement::Level)))
    }

    /// `w [ID] contours [color] [< x y z >]`; the velocity is ours, for flat scenes.
    fn wire<'a>(&self, input: Input<'a>, references: &mut References) -> Parsed<'a, Statement> {
        let (input, name) = self.optional_name(input)?;
        let (input, ()) = self.contours(input, references)?;
        let (input, color) = self.optional_name(input)?;
        let (input, velocity) = opt(velocity).parse(input)?;
        Ok((input, Statement::Wire(FaceStatement { name, color, illum: None, velocity })))
    }

    /// One or more `( vertex … )`.
    fn contours<'a>(&self, input: Input<'a>, references: &mut References) -> Parsed<'a, ()> {
        references.clear();
        let (mut input, ()) = mark(b'(', "`(` and vertex names")(input)?;
        loop {
            input = self.contour(input, references)?.0;
            references.ends.push(references.names.len());
            match mark(b'(', "`(`")(input) {
                Ok((rest, ())) => input = rest,
                Err(nom::Err::Error(_)) => return Ok((input, ())),
                Err(err) => return Err(err),
            }
        }
    }

    /// `vertex … )`
    fn contour<'a>(&self, input: Input<'a>, references: &mut References) -> Parsed<'a, ()> {
        let (mut input, first) = require(wanted(self.name(input), "a vertex name"))?;
        references.names.push(first);
        loop {
            match self.name(input) {
                Ok((rest, reference)) => {
                    references.names.push(reference);
                    input = rest;
                }
                Err(nom::Err::Error(_)) => {
                    return require(mark(b')', "a vertex name or `)`")(input));
                }
                Err(err) => return Err(err),
            }
        }
    }

    /// `c [ID] lightness [hue [saturation [translucency]]]`
    fn color<'a>(&self, input: Input<'a>) -> Parsed<'a, Statement> {
        let (input, name) = self.optional_name(input)?;
        let (input, value) = number_from(0.0, f64::INFINITY, "a lightness is 0 or more")(input)?;
        let (input, hue) = opt(number).parse(input)?;
        let (input, saturation) = opt(number_from(0.0, 1.0, SHARE)).parse(input)?;
        let (input, translucency) = opt(number_from(0.0, 1.0, SHARE)).parse(input)?;
        // `c L` is grey, `c L H` is a full colour.
        let saturation = saturation.unwrap_or(if hue.is_some() { 1.0 } else { 0.0 });
        let value = ColorValue::Hsv { value, hue: hue.unwrap_or(0.0), saturation };
        let translucency = translucency.unwrap_or(0.0);
        Ok((input, Statement::Color(ColorStatement { name, value, samples: Vec::new(), translucency })))
    }

    /// `c_rgb [ID] r g b [translucency]`
    fn rgb<'a>(&self, input: Input<'a>) -> Parsed<'a, Statement> {
        let share = number_from(0.0, 1.0, SHARE);
        let (input, name) = self.optional_name(input)?;
        let (input, r) = share(input)?;
        let (input, g) = share(input)?;
        let (input, b) = share(input)?;
        let (input, translucency) = opt(share).parse(input)?;
        let value = ColorValue::Rgb([r, g, b]);
        let translucency = translucency.unwrap_or(0.0);
        Ok((input, Statement::Color(ColorStatement { name, value, samples: Vec::new(), translucency })))
    }

    /// `c_xyz [ID] X Y Z [translucency]`
    fn xyz<'a>(&self, input: Input<'a>) -> Parsed<'a, Statement> {
        let (input, name) = self.optional_name(input)?;
        let (input, xyz) = point(input)?;
        let (input, translucency) = opt(number_from(0.0, 1.0, SHARE)).parse(input)?;
        let (value, translucency) = (ColorValue::Xyz(xyz.to_array()), translucency.unwrap_or(0.0));
        Ok((input, Statement::Color(ColorStatement { name, value, samples: Vec::new(), translucency })))
    }

    /// `c_bb [ID] kelvin [scale]`
    fn blackbody<'a>(&self, input: Input<'a>) -> Parsed<'a, Statement> {
        let (input, name) = self.optional_name(input)?;
        let (input, kelvin) =
            number_from(f64::MIN_POSITIVE, f64::INFINITY, "a temperature is above 0")(input)?;
        let (input, scale) = opt(number_from(0.0, f64::INFINITY, "a scale is 0 or more")).parse(input)?;
        let value = ColorValue::Blackbody { kelvin, scale: scale.unwrap_or(1.0) };
        Ok((input, Statement::Color(ColorStatement { name, value, samples: Vec::new(), translucency: 0.0 })))
    }

    /// `c_spd [ID] nm value …`
    fn spectrum<'a>(&self, input: Input<'a>) -> Parsed<'a, Statement> {
        let (mut input, name) = self.optional_name(input)?;
        let mut samples: Vec<[f64; 2]> = Vec::new();
        let mut least = f64::MIN_POSITIVE;
        loop {
            let nanometres = number_from(least, f64::INFINITY, "wavelengths are above 0 and rise");
            let (behind, wavelength_nm) = match nanometres(input) {
                Err(nom::Err::Error(_)) if !samples.is_empty() => break,
                result => result?,
            };
            let (rest, value) = require(number_from(0.0, f64::INFINITY, "a value is 0 or more")(behind))?;
            samples.push([wavelength_nm, value]);
            least = wavelength_nm.next_up();
            input = rest;
        }
        let value = ColorValue::Spectrum { start: 0, end: samples.len() as u32 };
        Ok((input, Statement::Color(ColorStatement { name, value, samples, translucency: 0.0 })))
    }

    /// `surf ID kd ks kt [n [exponent]]`
    fn surface<'a>(&self, input: Input<'a>) -> Parsed<'a, Statement> {
        let part = number_from(0.0, f64::INFINITY, "a part of the light is 0 or more");
        let (input, name) = wanted(self.name(input), NAME)?;
        let (input, diffuse) = part(input)?;
        let (input, specular) = part(input)?;
        let (input, transmitted) = number_from(0.0, 1.0, SHARE)(input)?;
        let index = number_from(f64::MIN_POSITIVE, f64::INFINITY, "a refractive index is above 0");
        let (input, refraction) = opt(index).parse(input)?;
        let (input, exponent) = match refraction {
            Some(_) => opt(number_from(0.0, f64::INFINITY, "an exponent is 0 or more")).parse(input)?,
            None => (input, None),
        };
        let surface = Surface {
            name: NameId::from_index(0),
            diffuse,
            specular,
            transmitted,
            refraction: refraction.unwrap_or(Surface::REFRACTION),
            exponent: exponent.unwrap_or(Surface::EXPONENT),
        };
        Ok((input, Statement::Surface(SurfaceStatement { name, surface })))
    }

    /// `l [ID] intensity [x y z [radius]] [color] [< x y z >]`
    fn light<'a>(&self, input: Input<'a>) -> Parsed<'a, Statement> {
        let (input, name) = self.optional_name(input)?;
        let (input, intensity) = number_from(0.0, f64::INFINITY, "an intensity is 0 or more")(input)?;
        let at = blank(input)?.0;
        let (input, vector) = opt(point).parse(input)?;
        let (input, radius) = match vector {
            Some(_) => opt(number_from(0.0, f64::INFINITY, "a radius is 0 or more")).parse(input)?,
            None => (input, None),
        };
        if radius.is_none() && vector == Some(DVec3::ZERO) {
            return fail(at, zero_vector(3));
        }
        let (input, color) = self.optional_name(input)?;
        let (input, velocity) = opt(velocity).parse(input)?;
        Ok((input, Statement::Light(LightStatement { name, intensity, vector, radius, color, velocity })))
    }

    /// `cam [ID] { -vc -ep -ud -cl -ph -og -ps -va -fs -fl } [< x y z >]`
    fn camera<'a>(&self, input: Input<'a>) -> Parsed<'a, Statement> {
        let (mut input, name) = self.optional_name(input)?;
        let mut camera = Camera::default();
        while let (rest, Some(name)) = opt(option_word).parse(input)? {
            input = camera_option(&mut camera, name, input, rest)?.0;
        }
        let (input, velocity) = opt(velocity).parse(input)?;
        Ok((input, Statement::Camera(CameraStatement { name, camera, velocity })))
    }

    /// `i [ID] ( def [color] tforms ) [< x y z >]`,
    /// `a [ID] ( def [color] tforms ) size tforms [< x y z >]`
    fn call<'a>(&self, input: Input<'a>, is_array: bool) -> Parsed<'a, Statement> {
        let (input, name) = self.optional_name(input)?;
        let (input, ()) = mark(b'(', "`(` and the name of a definition")(input)?;
        let (input, definition) = wanted(self.name(input), "the name of a definition")?;
        let (input, color) = self.optional_name(input)?;
        let (input, inner) = transforms(input)?;
        let (input, ()) = mark(b')', "a transformation such as `-tx` or `)`")(input)?;
        let (input, repeat) = if is_array {
            let (input, size) = integer(input)?;
            let (input, step) = transforms(input)?;
            (input, Repeat::Times(size, step))
        } else {
            (input, Repeat::Once)
        };
        let (input, velocity) = opt(velocity).parse(input)?;
        Ok((input, Statement::Call(CallStatement { name, definition, color, inner, repeat, velocity })))
    }
}

/// What a name begins with, for messages.
pub(crate) const NAME: &str = "a name that begins with a letter, `:`, `_` or `#`";

const SHARE: &str = "use a number from 0 to 1";

/// The vector in these words has no length.
const fn zero_vector(words: usize) -> Reason {
    Reason::Impossible(words, "the vector has no length", "give a vector with a direction, such as `0 0 1`")
}

/// A number in a closed range.
fn number_from<'a>(
    least: f64,
    most: f64,
    remedy: &'static str,
) -> impl Fn(Input<'a>) -> Parsed<'a, f64> + Copy {
    move |input| {
        let (rest, value) = number(input)?;
        if value < least || value > most {
            return fail(blank(input)?.0, Reason::OutOfRange(remedy));
        }
        Ok((rest, value))
    }
}

/// `< x y z >`, fractions of c.
fn velocity(input: Input<'_>) -> Parsed<'_, DVec3> {
    let (input, ()) = mark(b'<', "`<` and a velocity")(input)?;
    let at = blank(input)?.0;
    let (input, velocity) = require(point(input))?;
    let (input, ()) = require(mark(b'>', "`>`")(input))?;
    // The exact test is made by those who compute with it; this one catches what is plainly wrong.
    if velocity.length_squared() >= 1.0 {
        return fail(
            at,
            Reason::Impossible(
                3,
                "the speed is not below 1",
                "give x, y and z as fractions of the speed of light, together shorter than 1",
            ),
        );
    }
    Ok((input, velocity))
}

/// `-` and letters, without the dash.
fn option_word(input: Input<'_>) -> Parsed<'_, Input<'_>> {
    let (input, ()) = blank(input)?;
    match input {
        [b'-', letter, ..] if letter.is_ascii_alphabetic() => word(&input[1..]),
        _ => backtrack(input, Reason::Expected("an option")),
    }
}

fn numbers<'a, const N: usize>(mut input: Input<'a>) -> Parsed<'a, [f64; N]> {
    let mut values = [0.0; N];
    for value in &mut values {
        (input, *value) = require(number(input))?;
    }
    Ok((input, values))
}

/// Reads the arguments of camera option `name`, which stands at `at`; `input` is behind it.
fn camera_option<'a>(
    camera: &mut Camera,
    name: Input<'a>,
    at: Input<'a>,
    input: Input<'a>,
) -> Parsed<'a, ()> {
    fn store<'a, T, U>(
        slot: &mut Option<U>,
        parsed: Parsed<'a, T>,
        convert: impl Fn(T) -> U,
    ) -> Parsed<'a, ()> {
        let (rest, value) = require(parsed)?;
        *slot = Some(convert(value));
        Ok((rest, ()))
    }
    let same = |x| x;
    let pair = |x: [f64; 2]| x;
    match name {
        b"vc" => store(&mut camera.center, point(input), same),
        b"ep" => store(&mut camera.eye, point(input), same),
        b"ud" => {
            let (rest, up) = require(point(input))?;
            camera.up = Some(up);
            if up == DVec3::ZERO { fail(blank(at)?.0, zero_vector(4)) } else { Ok((rest, ())) }
        }
        b"cl" => store(&mut camera.clip, numbers(input), pair),
        b"ph" => store(&mut camera.film, numbers(input), |x: [f64; 4]| x),
        b"va" => store(&mut camera.view_angle, numbers(input), pair),
        b"fs" => store(&mut camera.film_size, numbers(input), pair),
        b"fl" => store(&mut camera.focal_length, number(input), |x| x),
        b"og" => {
            camera.projection = Some(Projection::Orthographic);
            Ok((input, ()))
        }
        b"ps" => {
            camera.projection = Some(Projection::Perspective);
            Ok((input, ()))
        }
        _ => {
            fail(blank(at)?.0, Reason::Expected("a camera option (-vc -ep -ud -cl -ph -og -ps -va -fs -fl)"))
        }
    }
}

/// `{ -tx 1 … }`: the transformations of an instance, from left to right.
fn transforms(mut input: Input<'_>) -> Parsed<'_, Transform> {
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

/// One transformation; `at` is its dash, `input` is behind its name.
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
