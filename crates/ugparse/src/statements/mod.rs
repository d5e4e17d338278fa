//! The statements of the language: a row of [`STATEMENTS`] for each, the function that reads what
//! follows its keyword, and beside that the one that writes it.
//!
//! Readers move a cursor over tokens, which are nom parsers, up to and with the closing `;`. They
//! add rows to the tables of a [`Scope`](crate::scope::Scope).

mod calls;
mod cameras;
mod colors;
mod derived_colors;
mod faces;
mod files;
mod grammar;
mod known_spectra;
mod lights;
mod motions;
mod options;
mod rounds;

use ugscene::FaceShape;

use crate::request::RequestKind;

pub(crate) use colors::write_color;
pub(crate) use derived_colors::write_times;
pub(crate) use grammar::{END, Grammar, NAME, Outcome};
pub(crate) use motions::{Along, write_motion};
use options::Forms;

/// A statement of the language.
pub struct Statement {
    /// Its first word.
    pub keyword: &'static str,
    /// What follows the keyword, as messages show it.
    pub arguments: &'static str,
    options: &'static [&'static dyn Forms],
    /// Reads what follows the keyword; `None` for those that open and close scopes.
    pub(crate) read: Option<Read>,
}

pub(crate) type Read = for<'t> fn(&mut Grammar<'t, '_>) -> Outcome<'t>;

impl Statement {
    /// Its form, as messages show it.
    pub fn form(&self) -> String {
        format!("{} {}", self.keyword, self.arguments)
    }

    /// Its options, each as the word without its dash, and what follows it: `va a [b]`.
    pub fn options(&self) -> Vec<&'static str> {
        self.options.iter().flat_map(|options| options.forms()).collect()
    }
}

/// All statements, in the order in which messages list them.
pub static STATEMENTS: &[Statement] = &[
    row("v", "ID x y z [color] [nx ny nz] [(u v)] ;", &[], |g| g.vertex()),
    row("w", "[ID] (vertices) … [color] [< vx vy vz >] ;", MOVING, |g| g.wire()),
    row("label", "[ID] \"text\" vertex [< vx vy vz >] ;", MOVING, |g| g.label()),
    row("f", "[ID] (vertices) … [color] [level or surface] [< vx vy vz >] ;", MOVING, |g| {
        g.face()
    }),
    row("sphere", "[ID] x y z radius [color] [level or surface] [< vx vy vz >] ;", MOVING, |g| {
        g.round(FaceShape::Sphere)
    }),
    row(
        "cylinder",
        "[ID] x y z x y z radius [color] [level or surface] [< vx vy vz >] ;",
        MOVING,
        |g| g.round(FaceShape::Cylinder),
    ),
    row(
        "tube",
        "[ID] x y z x y z radius [color] [level or surface] [< vx vy vz >] ;",
        MOVING,
        |g| g.round(FaceShape::Tube),
    ),
    row(
        "disc",
        "[ID] x y z nx ny nz radius [-inner radius] [color] [level or surface] [< vx vy vz >] ;",
        &[&rounds::INNER, &motions::GAMMA, &motions::FRAME],
        |g| g.round(FaceShape::Disc),
    ),
    row("c", "[ID] lightness [hue [saturation [translucency [factor]]]] ;", &[], |g| {
        g.color(&colors::HSV)
    }),
    row("c_rgb", "[ID] red green blue [translucency] ;", &[], |g| g.color(&colors::RGB)),
    row("c_xyz", "[ID] X Y Z [translucency] ;", &[], |g| g.color(&colors::XYZ)),
    row("c_bb", "[ID] kelvin [scale] ;", &[], |g| g.color(&colors::BLACKBODY)),
    row("c_spd", "[ID] nm value [nm value] … ;  c_spd [ID] sun ;", &[], |g| g.spectrum(false)),
    row("c_refl", "[ID] nm reflectance [nm reflectance] … ;  c_refl [ID] SURFACE ;", &[], |g| {
        g.spectrum(true)
    }),
    row("c_mix", "ID color share [color share] … ;", &[], |g| g.mix()),
    row(
        "c_time",
        "ID [-step] [-period T] [-shift T] time color [time color] … ;",
        &[&derived_colors::TIMES],
        |g| g.times(),
    ),
    row(
        "c_tex",
        "ID FILE [-image N] [-wrap MODE [MODE]] [-factor r g b [a]] [-mask [cutoff] | -blend] ;",
        &[&derived_colors::TEXTURE],
        |g| g.texture(),
    ),
    row("c_emit", "ID color ;", &[], |g| g.emission()),
    row("surf", "ID kd ks kt [n [exponent [absorption]]] ;", &[], |g| g.surface()),
    row(
        "l",
        "[ID] intensity [x y z [radius [reference]]] [color] [< vx vy vz >] ;",
        &[&lights::BEAMS, &motions::GAMMA, &motions::FRAME],
        |g| g.light(),
    ),
    row(
        "cam",
        "[ID] [-ep x y z] [-vc x y z] [-ud x y z] [-va a [b]] … ;",
        &[&cameras::OPTIONS, &motions::GAMMA],
        |g| g.camera(),
    ),
    row(
        "motion",
        "ID [-at x y z] [-vel x y z] [-acc x y z [begin end]] [-spin x y z [begin end]] … ;",
        &[&motions::OPTIONS, &motions::Curves],
        |g| g.motion(),
    ),
    row("sky", "FILE [-ra x y z] ;", &[&files::SKY], |g| g.sky()),
    Statement { keyword: "def", arguments: "ID ; … end ;", options: &[], read: None },
    Statement { keyword: "end", arguments: ";", options: &[], read: None },
    row(
        "i",
        "[ID] (def [color] [-tx …]) [< vx vy vz >] ;",
        &[&calls::TRANSFORMS, &motions::GAMMA, &motions::FRAME],
        |g| g.call(false),
    ),
    row(
        "a",
        "[ID] (def [color] [-tx …]) size [-tx …] [< vx vy vz >] ;",
        &[&calls::TRANSFORMS, &motions::GAMMA, &motions::FRAME],
        |g| g.call(true),
    ),
    row("include", "FILE ;", &[], |g| g.text_of(RequestKind::Include)),
    row("execute", "FILE ;", &[], |g| g.text_of(RequestKind::Execute)),
];

/// The options of a motion in angle brackets.
static MOVING: &[&dyn Forms] = &[&motions::GAMMA, &motions::FRAME];

const fn row(
    keyword: &'static str,
    arguments: &'static str,
    options: &'static [&'static dyn Forms],
    read: Read,
) -> Statement {
    Statement { keyword, arguments, options, read: Some(read) }
}

/// The statement with a keyword.
pub(crate) fn statement(keyword: &[u8]) -> Option<&'static Statement> {
    STATEMENTS.iter().find(|statement| statement.keyword.as_bytes() == keyword)
}
