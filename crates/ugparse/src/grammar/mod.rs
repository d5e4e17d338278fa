//! The statements of the language, as nom parsers.
//!
//! Each parser reads one statement after its keyword, up to but without the closing `;`, with one
//! token of look-ahead.

mod cameras;
mod known_spectra;
mod motions;
mod rounds;
mod tables;
mod transforms;

use std::ops::Range;

use cameras::camera_option;
use glam::DVec3;
use motions::frame_options;
use nom::Parser;
use nom::combinator::opt;
use transforms::transforms;
use ugphysics::{Velocity, VelocityError};
use ugscene::{
    Beam, BodyId, Camera, Color, ColorId, ColorValue, Face, FaceShape, Light, LightKind,
    LightMotion, Mix, NameId, Shading, ShadingId, SurfaceId, SurfaceNumber, SurfaceProperties,
    Tint, Vertex, VertexId, Wire,
};

use crate::numbered::Name;
use crate::scope::Scope;
use crate::source::Span;
use crate::statement::{
    Call, FileStatement, MotionReference, NameKind, Repeat, SkyStatement, StatedFrame, Statement,
};
use crate::token::{
    FILE_NAME, Input, Parsed, Reason, backtrack, blank, fail, file_name, identifier, integer,
    label_text, mark, number, number32, point, require, wanted, word,
};

/// The syntax of each statement, as messages show it, in the order in which they list keywords.
const FORMS: [&str; 29] = [
    "v ID x y z [color] [nx ny nz] [(u v)] ;",
    "w [ID] (vertices) … [color] [< vx vy vz >] ;",
    "label [ID] \"text\" vertex [< vx vy vz >] ;",
    "f [ID] (vertices) … [color] [level or surface] [< vx vy vz >] ;",
    "sphere [ID] x y z radius [color] [level or surface] [< vx vy vz >] ;",
    "cylinder [ID] x y z x y z radius [color] [level or surface] [< vx vy vz >] ;",
    "tube [ID] x y z x y z radius [color] [level or surface] [< vx vy vz >] ;",
    "disc [ID] x y z nx ny nz radius [-inner radius] [color] [level or surface] [< vx vy vz >] ;",
    "c [ID] lightness [hue [saturation [translucency [factor]]]] ;",
    "c_rgb [ID] red green blue [translucency] ;",
    "c_xyz [ID] X Y Z [translucency] ;",
    "c_bb [ID] kelvin [scale] ;",
    "c_spd [ID] nm value [nm value] … ;  c_spd [ID] sun ;",
    "c_refl [ID] nm reflectance [nm reflectance] … ;  c_refl [ID] SURFACE ;",
    "c_mix ID color share [color share] … ;",
    "c_time ID [-step] [-period T] [-shift T] time color [time color] … ;",
    "c_tex ID FILE [-image N] [-wrap MODE [MODE]] [-factor r g b [a]] [-mask [cutoff] | -blend] ;",
    "c_emit ID color ;",
    SurfaceProperties::FORM,
    "l [ID] intensity [x y z [radius [reference]]] [color] [< vx vy vz >] ;",
    "cam [ID] [-ep x y z] [-vc x y z] [-ud x y z] [-va a [b]] … ;",
    "motion ID [-at x y z] [-vel x y z] [-acc x y z [begin end]] [-spin x y z [begin end]] … ;",
    "sky FILE [-ra x y z] ;",
    "def ID ; … end ;",
    "end ;",
    "i [ID] (def [color] [-tx …]) [< vx vy vz >] ;",
    "a [ID] (def [color] [-tx …]) size [-tx …] [< vx vy vz >] ;",
    "include FILE ;",
    "execute FILE ;",
];

/// The keywords of statements.
pub(crate) fn keywords() -> impl Iterator<Item = &'static str> {
    FORMS.iter().filter_map(|form| form.split(' ').next())
}

/// The syntax of the statement with a keyword.
pub(crate) fn form(keyword: &[u8]) -> Option<&'static str> {
    let row = keywords().position(|other| other.as_bytes() == keyword)?;
    Some(FORMS[row])
}

/// Is this word the keyword of a statement?
pub(crate) fn is_keyword(word: &[u8]) -> bool {
    form(word).is_some()
}

/// A parser of statements of one scope. The text's length gives the position of any rest of it.
pub(crate) struct Grammar<'t, 's> {
    pub text: &'t [u8],
    /// Receives the names, contours, spectral samples and vertices of round faces of a statement.
    pub scope: &'s mut Scope<'t>,
    /// The names in the statement, in the order of the text.
    pub names: &'s mut Vec<(NameKind, Span)>,
}

impl<'t> Grammar<'t, '_> {
    /// Byte position at which `rest` begins.
    fn position(&self, rest: Input<'_>) -> u32 {
        // `parse` refuses texts of 4 GiB and more.
        (self.text.len() - rest.len()) as u32
    }

    /// The span of a word that ends where `rest` begins.
    fn span(&self, word: Input<'_>, rest: Input<'_>) -> Span {
        let end = self.position(rest);
        Span { start: end - word.len() as u32, end }
    }

    fn name(&self, input: Input<'t>) -> Parsed<'t, Span> {
        let (rest, name) = identifier(input)?;
        Ok((rest, self.span(name, rest)))
    }

    fn optional_name(&self, input: Input<'t>) -> Parsed<'t, Option<Span>> {
        opt(|i| self.name(i)).parse(input)
    }

    /// Adds the name of the statement itself.
    fn own_name(&mut self, name: Option<Span>) -> Option<NameId> {
        name.map(|name| {
            self.names.push((NameKind::Own, name));
            self.scope.add_name(name.of(self.text))
        })
    }

    /// The number of the name of a colour.
    fn color_id(&mut self, name: Span) -> ColorId {
        self.names.push((NameKind::Color, name));
        ColorId::from_index(self.scope.colors.names.enter(name.of(self.text)))
    }

    fn color_name(&mut self, input: Input<'t>) -> Parsed<'t, ColorId> {
        self.name(input).map(|(rest, name)| (rest, self.color_id(name)))
    }

    fn optional_color(&mut self, input: Input<'t>) -> Parsed<'t, Option<ColorId>> {
        opt(|i| self.color_name(i)).parse(input)
    }

    /// Adds a corner to a contour.
    fn corner(&mut self, input: Input<'t>) -> Parsed<'t, ()> {
        let (rest, name) = self.name(input)?;
        self.names.push((NameKind::Vertex, name));
        let number = self.scope.vertex_names.enter(Name::new(name.of(self.text)));
        self.scope.contours.push_corner(VertexId(number));
        Ok((rest, ()))
    }

    /// Parses the body of a statement; `None` if the keyword is unknown.
    pub fn statement(&mut self, keyword: &[u8], input: Input<'t>) -> Option<Parsed<'t, Statement>> {
        Some(match keyword {
            b"v" => self.vertex(input),
            b"f" => self.face(input),
            b"w" => self.wire(input),
            b"label" => self.label(input),
            b"sphere" => self.round(FaceShape::Sphere, input),
            b"cylinder" => self.round(FaceShape::Cylinder, input),
            b"tube" => self.round(FaceShape::Tube, input),
            b"disc" => self.round(FaceShape::Disc, input),
            b"c" => self.color(input),
            b"c_rgb" => self.rgb(input),
            b"c_xyz" => self.xyz(input),
            b"c_bb" => self.blackbody(input),
            b"c_spd" => self.spectrum(input, false),
            b"c_refl" => self.spectrum(input, true),
            b"c_mix" => self.mix(input),
            b"c_time" => self.table(input),
            b"c_tex" => self.texture(input),
            b"c_emit" => self.emission(input),
            b"surf" => self.surface(input),
            b"l" => self.light(input),
            b"cam" => self.camera(input),
            b"motion" => self.motion(input),
            b"sky" => self.sky(input),
            b"i" => self.call(input, false),
            b"a" => self.call(input, true),
            _ => return None,
        })
    }

    /// `< x y z [-gamma γ] [-at x y z] [-turn x y z] [-shift t x y z] >` or `< NAME >`
    fn motion_reference(&self, input: Input<'t>) -> Parsed<'t, MotionReference> {
        let (input, ()) = mark(b'<', "`<` and a velocity or the name of a motion")(input)?;
        let (input, motion) = match self.name(input) {
            Ok((rest, name)) => (rest, MotionReference::Named(name)),
            Err(_) => {
                let (rest, velocity) = velocity(input)?;
                let (rest, frame) = frame_options(rest, StatedFrame::new(velocity))?;
                (rest, MotionReference::Frame(frame))
            }
        };
        let (input, ()) = require(mark(b'>', "`>`")(input))?;
        Ok((input, motion))
    }

    fn optional_motion(&self, input: Input<'t>) -> Parsed<'t, Option<MotionReference>> {
        opt(|i| self.motion_reference(i)).parse(input)
    }

    /// `[< x y z >]` of a face or wire
    fn body(&mut self, input: Input<'t>) -> Parsed<'t, BodyId> {
        let (rest, motion) = self.optional_motion(input)?;
        let (text, bodies) = (self.text, &mut self.scope.bodies);
        let unstated = bodies.bodies.unstated();
        Ok((rest, motion.map_or(unstated, |motion| bodies.of_reference(text, motion, DVec3::ZERO))))
    }

    /// `v ID x y z [color] [nx ny nz] [(u v)]`
    fn vertex(&mut self, input: Input<'t>) -> Parsed<'t, Statement> {
        let (input, name) = wanted(self.name(input), NAME)?;
        let (input, position) = point(input)?;
        let (input, color) = self.optional_color(input)?;
        let (rest, normal) = opt(point).parse(input)?;
        if normal == Some(DVec3::ZERO) {
            return fail(blank(input)?.0, zero_vector(3));
        }
        let (mut rest, open) = opt(mark(b'(', "`(` and texture coordinates")).parse(rest)?;
        let mut uv = None;
        if open.is_some() {
            let (behind, (u, v, ())) =
                require((number32, number32, mark(b')', "`)`")).parse(rest))?;
            (rest, uv) = (behind, Some([u, v]));
        }
        Ok((rest, Statement::Vertex(name, Vertex { normal, uv, ..Vertex::at(position, color) })))
    }

    /// `f [ID] contours [color] [shading] [< x y z >]`
    fn face(&mut self, input: Input<'t>) -> Parsed<'t, Statement> {
        let (input, name) = self.optional_name(input)?;
        let (input, contours) = self.contours(input)?;
        self.behind_shape(input, name, FaceShape::Polygon, contours)
    }

    /// `[color] [shading] [< x y z >]`
    fn behind_shape(
        &mut self,
        input: Input<'t>,
        name: Option<Span>,
        shape: FaceShape,
        contours: Range<u32>,
    ) -> Parsed<'t, Statement> {
        let (input, color) = self.optional_color(input)?;
        let (input, shading) = self.shading(input)?;
        let (input, body) = self.body(input)?;
        let name = self.own_name(name);
        Ok((
            input,
            Statement::Face(Face { name, color, shading, shape, ..Face::polygon(contours, body) }),
        ))
    }

    /// `number` or `surface`
    fn shading(&mut self, input: Input<'t>) -> Parsed<'t, Option<ShadingId>> {
        let (rest, surface) = self.optional_name(input)?;
        if let Some(name) = surface {
            self.names.push((NameKind::Surface, name));
            let number = self.scope.surfaces.names.enter(name.of(self.text));
            return Ok((
                rest,
                Some(self.scope.add_shading(Shading::Surface(SurfaceId::from_index(number)))),
            ));
        }
        let (rest, level) = opt(number).parse(input)?;
        Ok((rest, level.map(|level| self.scope.add_shading(Shading::Level(level)))))
    }

    /// `w [ID] contours [color] [< x y z >]`; the velocity is our extension, for flat scenes.
    fn wire(&mut self, input: Input<'t>) -> Parsed<'t, Statement> {
        let (input, name) = self.optional_name(input)?;
        let (input, contours) = self.contours(input)?;
        let (input, color) = self.optional_color(input)?;
        let (input, body) = self.body(input)?;
        let name = self.own_name(name);
        Ok((input, Statement::Wire(Wire { name, contours, color, body, text: None })))
    }

    /// `label [ID] "text" vertex [< x y z >]`, our extension.
    fn label(&mut self, input: Input<'t>) -> Parsed<'t, Statement> {
        let (input, name) = self.optional_name(input)?;
        let (at, ()) = blank(input)?;
        let text = label_text(at)?.1;
        let first = self.scope.contours.row_count();
        let (input, ()) = require(wanted(self.corner(&at[text.len() + 2..]), "a vertex name"))?;
        self.scope.contours.end_contour();
        let (input, body) = self.body(input)?;
        let (name, text) = (self.own_name(name), Some(self.scope.add_name(text)));
        Ok((
            input,
            Statement::Wire(Wire { name, contours: first..first + 1, color: None, body, text }),
        ))
    }

    /// One or more `( vertex … )`.
    fn contours(&mut self, input: Input<'t>) -> Parsed<'t, Range<u32>> {
        let first = self.scope.contours.row_count();
        let (mut input, ()) = mark(b'(', "`(` and vertex names")(input)?;
        loop {
            input = self.contour(input)?.0;
            self.scope.contours.end_contour();
            match opt(mark(b'(', "`(`")).parse(input)? {
                (rest, Some(())) => input = rest,
                (rest, None) => return Ok((rest, first..self.scope.contours.row_count())),
            }
        }
    }

    /// `vertex … )`
    fn contour(&mut self, input: Input<'t>) -> Parsed<'t, ()> {
        let (mut input, ()) = require(wanted(self.corner(input), "a vertex name"))?;
        while let (rest, Some(())) = opt(|i| self.corner(i)).parse(input)? {
            input = rest;
        }
        require(mark(b')', "a vertex name or `)`")(input))
    }

    /// `c [ID] lightness [hue [saturation [translucency [factor]]]]`
    fn color(&mut self, input: Input<'t>) -> Parsed<'t, Statement> {
        let (input, name) = self.optional_name(input)?;
        let (input, value) = number_from(0.0, f64::INFINITY, "a lightness is 0 or more")(input)?;
        let (input, (hue, saturation, translucency)) =
            (opt(number), opt(share), opt(share)).parse(input)?;
        let (input, factor) = match translucency {
            Some(_) => {
                opt(number_from(0.0, f64::INFINITY, "a factor is 0 or more")).parse(input)?
            }
            None => (input, None),
        };
        // `c L` is grey, `c L H` is fully saturated.
        let saturation = saturation.unwrap_or(if hue.is_some() { 1.0 } else { 0.0 });
        // A hue until the stage is known, which may be stated further down.
        let tint = Tint::Hue(hue.unwrap_or(0.0));
        let value = ColorValue::Hsv { value, tint, saturation, factor: factor.unwrap_or(1.0) };
        Ok((input, color(name, value, translucency)))
    }

    /// `c_rgb [ID] r g b [translucency]`
    fn rgb(&mut self, input: Input<'t>) -> Parsed<'t, Statement> {
        let (input, name) = self.optional_name(input)?;
        let (input, (r, g, b, translucency)) = (share, share, share, opt(share)).parse(input)?;
        Ok((input, color(name, ColorValue::Rgb([r, g, b]), translucency)))
    }

    /// `c_xyz [ID] X Y Z [translucency]`
    fn xyz(&mut self, input: Input<'t>) -> Parsed<'t, Statement> {
        let (input, name) = self.optional_name(input)?;
        let (input, (xyz, translucency)) = (point, opt(share)).parse(input)?;
        Ok((input, color(name, ColorValue::Xyz(xyz.to_array()), translucency)))
    }

    /// `c_bb [ID] kelvin [scale]`
    fn blackbody(&mut self, input: Input<'t>) -> Parsed<'t, Statement> {
        let (input, name) = self.optional_name(input)?;
        let (input, kelvin) =
            number_from(f64::MIN_POSITIVE, f64::INFINITY, "a temperature is above 0")(input)?;
        let (input, scale) =
            opt(number_from(0.0, f64::INFINITY, "a scale is 0 or more")).parse(input)?;
        Ok((
            input,
            color(name, ColorValue::Blackbody { kelvin, scale: scale.unwrap_or(1.0) }, None),
        ))
    }

    /// `c_spd [ID] nm value …`, `c_refl [ID] nm value …`, or a known spectrum in place of samples
    fn spectrum(&mut self, input: Input<'t>, reflects: bool) -> Parsed<'t, Statement> {
        let (behind_first, first) = opt(identifier).parse(input)?;
        let (behind_second, second) = opt(identifier).parse(behind_first)?;
        let name = first.map(|word| self.span(word, behind_first));
        // `c_refl wood` has the name of what it is.
        if let Some(word) = second.or(first.filter(|_| number(behind_first).is_err())) {
            let Some(samples) = known_spectra::samples(word, reflects) else {
                let at = if second.is_some() { behind_first } else { input };
                return fail(blank(at)?.0, known_spectra::unknown(reflects));
            };
            return Ok((
                behind_second,
                color(name, self.scope.add_spectrum(reflects, &samples), None),
            ));
        }
        let mut least = f64::MIN_POSITIVE;
        let nanometres = |input| {
            let read = number_from(least, f64::INFINITY, "wavelengths are above 0 and rise")(input);
            read.inspect(|(_, nm)| least = nm.next_up())
        };
        let value = number_from(0.0, f64::INFINITY, "a value is 0 or more");
        let (input, samples) = pairs(behind_first, nanometres, value)?;
        let samples: Vec<[f64; 2]> = samples.into_iter().map(<[f64; 2]>::from).collect();
        Ok((input, color(name, self.scope.add_spectrum(reflects, &samples), None)))
    }

    /// `c_mix ID color share …`
    fn mix(&mut self, input: Input<'t>) -> Parsed<'t, Statement> {
        let (input, color) = wanted(self.color_name(input), NAME)?;
        let part = |input| wanted(self.color_name(input), NAME);
        let (input, parts) = pairs(input, part, share)?;
        Ok((input, Statement::Mix(Mix { color, parts })))
    }

    /// `surf ID kd ks kt [n [exponent [absorption]]]`
    fn surface(&mut self, input: Input<'t>) -> Parsed<'t, Statement> {
        let (mut input, name) = wanted(self.name(input), NAME)?;
        let mut surface = SurfaceProperties::default();
        for (idx, SurfaceNumber { of, range, rule }) in
            SurfaceProperties::NUMBERS.into_iter().enumerate()
        {
            match number_from(*range.start(), *range.end(), rule)(input) {
                Err(nom::Err::Error(_)) if idx >= SurfaceProperties::N_REQUIRED => break,
                read => (input, *of(&mut surface)) = read?,
            }
        }
        Ok((input, Statement::Surface(name, surface)))
    }

    /// `l [ID] intensity [x y z [radius [reference]]] [color] [< x y z >]`
    fn light(&mut self, input: Input<'t>) -> Parsed<'t, Statement> {
        let (input, name) = self.optional_name(input)?;
        let (input, intensity) =
            number_from(0.0, f64::INFINITY, "an intensity is 0 or more")(input)?;
        let at = blank(input)?.0;
        let (mut input, vector) = opt(point).parse(input)?;
        let mut kind = vector.map_or(LightKind::Ambient, LightKind::Directional);
        if let Some(position) = vector
            && let (rest, Some(radius)) =
                opt(number_from(0.0, f64::INFINITY, "a radius is 0 or more")).parse(input)?
        {
            let distance = "a reference distance is above 0";
            let reference;
            (input, reference) =
                opt(number_from(f64::MIN_POSITIVE, f64::INFINITY, distance)).parse(rest)?;
            kind = LightKind::Local { position, radius, reference, beam: Beam::Even };
        }
        if kind == LightKind::Directional(DVec3::ZERO) {
            return fail(at, zero_vector(3));
        }
        let (input, color) = self.optional_color(input)?;
        let (input, ()) = beam(input, &mut kind)?;
        let (input, motion) = self.optional_motion(input)?;
        let motion = motion.map_or(LightMotion::WithWhatItLights, |motion| {
            // A lamp with a velocity of its own is at its position at time 0.
            let at =
                if let LightKind::Local { position, .. } = kind { position } else { DVec3::ZERO };
            LightMotion::Body(self.scope.bodies.of_reference(self.text, motion, at))
        });
        Ok((
            input,
            Statement::Light(Light { name: self.own_name(name), intensity, kind, color, motion }),
        ))
    }

    /// `cam [ID] { -vc -ep -ud -cl -ph -og -ps -va -fs -fl } [< x y z >]`
    fn camera(&mut self, input: Input<'t>) -> Parsed<'t, Statement> {
        let (mut input, name) = self.optional_name(input)?;
        let mut camera = Camera::default();
        while let (rest, Some(name)) = opt(option_word).parse(input)? {
            input = camera_option(&mut camera, name, input, rest)?.0;
        }
        let (input, motion) = self.optional_motion(input)?;
        let (velocity, carrier) = match motion {
            Some(MotionReference::Frame(frame)) => (Some(frame.velocity), None),
            Some(MotionReference::Named(name)) => {
                (None, Some(self.scope.bodies.named(self.text, name)))
            }
            None => (None, None),
        };
        Ok((
            input,
            Statement::Camera(Camera { name: self.own_name(name), velocity, carrier, ..camera }),
        ))
    }

    /// `sky FILE [-ra x y z]`
    fn sky(&self, input: Input<'t>) -> Parsed<'t, Statement> {
        let (input, file) = file(self.text, input, FILE_NAME)?;
        let (input, turn) = match opt(option_word).parse(input)? {
            (rest, Some(b"ra")) => require(numbers(rest))?,
            (_, Some(_)) => return fail(blank(input)?.0, Reason::Expected("`-ra` or `;`")),
            (rest, None) => (rest, [0.0; 3]),
        };
        Ok((input, Statement::Sky(SkyStatement { file, turn })))
    }

    /// `i [ID] ( def [color] tforms ) [< x y z >]`,
    /// `a [ID] ( def [color] tforms ) size tforms [< x y z >]`
    fn call(&mut self, input: Input<'t>, is_array: bool) -> Parsed<'t, Statement> {
        let (input, name) = self.optional_name(input)?;
        let (input, ()) = mark(b'(', "`(` and the name of a definition")(input)?;
        let (input, definition) = wanted(self.name(input), "the name of a definition")?;
        let (input, color) = self.optional_color(input)?;
        let (input, inner) = transforms(input)?;
        let (input, ()) = mark(b')', "a transformation such as `-tx` or `)`")(input)?;
        let (input, repeat) = if is_array {
            let (input, size) = integer(input)?;
            let (input, step) = transforms(input)?;
            (input, Repeat::Times(size, step))
        } else {
            (input, Repeat::Once)
        };
        let (input, motion) = self.optional_motion(input)?;
        let (before, target, label) = (self.scope.counts(), None, String::new());
        let call = Call { name, definition, color, inner, repeat, motion, before, target, label };
        Ok((input, Statement::Call(call)))
    }
}

/// The first characters of a name, for messages.
pub(crate) const NAME: &str = "a name that begins with a letter, `:`, `_` or `#`";

fn share(input: Input<'_>) -> Parsed<'_, f64> {
    number_from(0.0, 1.0, "use a number from 0 to 1")(input)
}

/// The vector in these words has no length.
const fn zero_vector(words: usize) -> Reason {
    Reason::Impossible(
        words,
        "the vector is zero",
        "give a vector with a direction, such as `0 0 1`",
    )
}

/// A file name, for messages `what`.
pub(crate) fn file<'t>(
    text: &[u8],
    input: Input<'t>,
    what: &'static str,
) -> Parsed<'t, FileStatement> {
    let position = |rest: Input<'_>| (text.len() - rest.len()) as u32;
    let at = blank(input)?.0;
    let (rest, name) = wanted(file_name(input), what)?;
    let span = Span { start: position(at), end: position(rest) };
    let start = span.start + u32::from(at.starts_with(b"\""));
    Ok((rest, FileStatement { span, name: Span { start, end: start + name.len() as u32 } }))
}

/// A colour, whose name is set when the colours of all scopes are joined.
fn color(name: Option<Span>, value: ColorValue, translucency: Option<f64>) -> Statement {
    let translucency = translucency.unwrap_or(0.0);
    Statement::Color(name, Color { name: NameId::from_index(0), value, translucency })
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

/// `x y z`, a velocity in fractions of c, or `x y z -gamma γ`, its direction and Lorentz factor.
fn velocity(input: Input<'_>) -> Parsed<'_, Velocity> {
    let at = blank(input)?.0;
    let (input, vector) = require(point(input))?;
    let (input, gamma) = match option_word(input) {
        Ok((rest, b"gamma")) => {
            let gamma = number_from(1.0, 1e43, "a Lorentz factor is from 1 to 1e43");
            let (rest, gamma) = require(gamma(rest))?;
            (rest, Some(gamma))
        }
        _ => (input, None),
    };
    match Velocity::from_stated(vector, gamma) {
        Ok(velocity) => Ok((input, velocity)),
        Err(VelocityError::NoDirection) => fail(at, zero_vector(3)),
        Err(_) => fail(
            at,
            Reason::Impossible(
                3,
                "the speed is not below 1",
                "give x, y and z as fractions of the speed of light, together shorter than 1",
            ),
        ),
    }
}

/// `-` and letters, without the dash.
fn option_word(input: Input<'_>) -> Parsed<'_, Input<'_>> {
    let (input, ()) = blank(input)?;
    match input {
        [b'-', letter, ..] if letter.is_ascii_alphabetic() => word(&input[1..]),
        _ => backtrack(input, Reason::Expected("an option")),
    }
}

/// `-spot x y z angle edge` or `-area ux uy uz vx vy vz`
fn beam<'a>(input: Input<'a>, kind: &mut LightKind) -> Parsed<'a, ()> {
    let at = blank(input)?.0;
    let wrong = |remedy| fail(at, Reason::OutOfRange(remedy));
    let (input, stated) = match (opt(option_word).parse(input)?, &kind) {
        ((rest, Some(b"spot")), LightKind::Local { .. }) => {
            let (rest, [x, y, z, angle, edge]) = require(numbers(rest))?;
            (rest, Beam::Spot { axis: DVec3::new(x, y, z), degrees: [angle, edge] })
        }
        ((rest, Some(b"area")), LightKind::Local { reference: Some(_), .. }) => {
            let (rest, [x, y, z, u, v, w]) = require(numbers(rest))?;
            (rest, Beam::Area([DVec3::new(x, y, z), DVec3::new(u, v, w)]))
        }
        ((_, Some(b"spot")), _) => {
            return wrong("a spot has a position and a radius, such as `l 1  0 0 5 0`");
        }
        ((_, Some(b"area")), _) => {
            return wrong(
                "an area has a position, a radius and a reference distance, such as `l 1  0 0 5 0 3`",
            );
        }
        ((_, Some(_)), _) => return fail(at, Reason::Expected("`-spot`, `-area`, `<` or `;`")),
        ((_, None), _) => return Ok((input, ())),
    };
    if !stated.is_valid() {
        return wrong(
            "an axis is not 0, an angle 0 to 180 degrees, an edge 0 to the angle; edges span an area",
        );
    }
    if let LightKind::Local { beam, .. } = kind {
        *beam = stated;
    }
    Ok((input, ()))
}

/// Puts the argument of an option into its place.
fn store<'a, T>(place: &mut Option<T>, parsed: Parsed<'a, T>) -> Parsed<'a, ()> {
    let (rest, value) = require(parsed)?;
    *place = Some(value);
    Ok((rest, ()))
}

/// Pairs, one or more, up to where `first` does not match.
fn pairs<'a, A, B>(
    mut input: Input<'a>,
    mut first: impl FnMut(Input<'a>) -> Parsed<'a, A>,
    mut second: impl FnMut(Input<'a>) -> Parsed<'a, B>,
) -> Parsed<'a, Vec<(A, B)>> {
    let mut pairs = Vec::new();
    loop {
        let (behind, one) = match first(input) {
            Err(nom::Err::Error(_)) if !pairs.is_empty() => return Ok((input, pairs)),
            result => require(result)?,
        };
        let (rest, other) = require(second(behind))?;
        pairs.push((one, other));
        input = rest;
    }
}

fn numbers<'a, const N: usize>(mut input: Input<'a>) -> Parsed<'a, [f64; N]> {
    let mut values = [0.0; N];
    for value in &mut values {
        (input, *value) = require(number(input))?;
    }
    Ok((input, values))
}
