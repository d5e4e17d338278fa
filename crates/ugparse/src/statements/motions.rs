//! `motion`, and motions in angle brackets behind what moves.

use glam::DVec3;
use rustc_hash::FxHashMap;
use ugphysics::{Event, InertialFrame, Piece, SampledPath, Velocity, VelocityError};
use ugscene::{BodyId, Carrier, CurveKind, MotionPath, StatedMotion};

use super::grammar::{Grammar, NAME, Outcome, Valid, refuse};
use super::options::{
    Argument, Forms, OptionForm, OptionTable, first_word, option, option_word, valid_option,
    zero_vector,
};
use crate::request::RequestKind;
use crate::row_writer::RowWriter;
use crate::source::Span;
use crate::statement::{
    MotionReference, MotionStatement, PathStatement, RequestStatement, StatedFrame,
};
use crate::token::{Reason, mark, number, point};

pub(super) static OPTIONS: OptionTable<MotionStatement> = OptionTable {
    rows: &[
        option("at x y z", |motion| &mut motion.at),
        option("vel x y z", |motion| &mut motion.velocity),
        option("acc x y z [begin end]", |motion| &mut motion.accelerations),
        option("path FILE", |motion| &mut motion.path),
        option("on NAME", |motion| &mut motion.on),
        option("spin x y z [begin end]", |motion| &mut motion.spins),
        option("shift t x y z", |motion| &mut motion.shift),
    ],
    expected: CurveKind::OPTIONS,
};

/// Behind `< x y z`
pub(super) static FRAME: OptionTable<StatedFrame> = OptionTable {
    rows: &[
        option("at x y z", |frame| &mut frame.at),
        option("turn x y z", |frame| &mut frame.turn),
        option("shift t x y z", |frame| &mut frame.shift),
    ],
    expected: "`>` or an option (-at -turn -shift)",
};

/// Behind the three numbers of a velocity: they are its direction then.
pub(super) static GAMMA: OptionTable<Option<f64>> = OptionTable {
    rows: &[valid_option(
        "gamma γ",
        Valid::Range(1.0, 1e43, "a Lorentz factor is from 1 to 1e43"),
        |gamma| gamma,
    )],
    expected: "`-gamma`",
};

/// The options of a motion that state curves.
pub(super) struct Curves;

impl Forms for Curves {
    fn forms(&self) -> Vec<&'static str> {
        CurveKind::ALL.iter().map(|kind| kind.form).collect()
    }
}

impl<'t> Grammar<'t, '_> {
    pub fn motion(&mut self) -> Outcome<'t> {
        let name = self.name(NAME)?;
        let mut motion = MotionStatement { name, ..MotionStatement::default() };
        loop {
            let at = self.rest;
            let word = option_word(at).map_or(&[][..], |(_, word)| word);
            let curve = CurveKind::ALL.iter().find(|kind| kind.word().as_bytes() == word);
            let path_word = match word {
                b"vel" | b"acc" => Some("vel"),
                b"path" => Some("path"),
                _ => curve.map(CurveKind::word),
            };
            if path_word.is_some_and(|word| motion.path_word.is_some_and(|other| other != word)) {
                let problem = "the motion has another path already";
                return refuse(at, Reason::Impossible(1, problem, CurveKind::PATHS));
            }
            motion.path_word = path_word.or(motion.path_word);
            if let Some(kind) = curve {
                self.take(option_word)?;
                motion.path = Some(PathStatement::Curve(kind, self.curve_numbers(kind)?));
            } else if !OPTIONS.read_one(&mut motion, self)? {
                break;
            }
        }
        let span = self.end()?;
        if let Some(PathStatement::File(file)) = motion.path {
            let motion = Some(name);
            self.requests.push(RequestStatement { motion, ..file.request(RequestKind::Path) });
        }
        // Also those that nothing moves with are in the scene. Carriers follow when all statements
        // are read, so that what is written, with motions first, is read in the same order.
        self.scope.bodies.named(self.text, name);
        self.scope.motions.push(motion, span);
        Ok(())
    }

    fn curve_numbers(&mut self, kind: &CurveKind) -> Outcome<'t, Vec<f64>> {
        let mut numbers = Vec::new();
        for row in 0..kind.n_numbers() {
            let at = self.rest;
            if kind.axis == Some(row) && point(at)?.1 == DVec3::ZERO {
                return refuse(at, zero_vector(3));
            }
            numbers.push(self.take(number)?);
        }
        Ok(numbers)
    }

    /// `< x y z [-gamma γ] [-at x y z] [-turn x y z] [-shift t x y z] >` or `< NAME >`
    pub fn optional_motion(&mut self) -> Outcome<'t, Option<MotionReference>> {
        if self.optional(mark(b'<', "`<`"))?.is_none() {
            return Ok(None);
        }
        let motion = match self.name(NAME) {
            Ok(name) => MotionReference::Named(name),
            Err(_) => {
                let mut frame = StatedFrame::new(self.velocity()?);
                FRAME.read(&mut frame, self)?;
                MotionReference::Frame(frame)
            }
        };
        self.take(mark(b'>', "`>`"))?;
        Ok(Some(motion))
    }

    /// `x y z`, a velocity in fractions of c, or `x y z -gamma γ`, its direction and Lorentz
    /// factor.
    fn velocity(&mut self) -> Outcome<'t, Velocity> {
        let at = self.rest;
        let vector = self.take(point)?;
        let mut gamma = None;
        if let Ok((_, b"gamma")) = option_word(self.rest) {
            GAMMA.read_one(&mut gamma, self)?;
        }
        Velocity::from_stated(vector, gamma).or_else(|error| {
            refuse(
                at,
                match error {
                    VelocityError::NoDirection => zero_vector(3),
                    _ => Reason::Impossible(3, "the speed is not below 1", SLOWER),
                },
            )
        })
    }

    /// `FILE`, `(t x y z …)` or `< NAME >`, the path of another motion
    fn path(&mut self) -> Outcome<'t, PathStatement> {
        if self.optional(mark(b'<', "`<`"))?.is_some() {
            let name = self.name("the name of a motion with a path")?;
            self.take(mark(b'>', "`>`"))?;
            return Ok(PathStatement::Of(name));
        }
        if self.optional(mark(b'(', "`(`"))?.is_none() {
            let file = self.file("a file name, or `(` and a list of events")?;
            return Ok(PathStatement::File(file));
        }
        let start = self.position();
        let mut events = Vec::new();
        loop {
            let at = self.rest;
            let Some(t) = self.optional(number)? else { break };
            if events.len() == SampledPath::MOST_EVENTS {
                let remedy = "give 1000000 events at most";
                let reason = Reason::Impossible(1, "the path has too many events", remedy);
                return refuse(at, reason);
            }
            events.push(Event { t, x: self.take(point)? });
        }
        self.take(mark(b')', "a number or `)`"))?;
        Ok(PathStatement::Events { span: Span { start, end: self.position() - 1 }, events })
    }
}

const SLOWER: &str = "give x, y and z as fractions of the speed of light, together shorter than 1";

impl Argument for Velocity {
    fn read<'t>(&mut self, _: OptionForm, grammar: &mut Grammar<'t, '_>) -> Outcome<'t> {
        *self = grammar.velocity()?;
        Ok(())
    }
}

/// A displacement.
impl Argument for Event {
    fn read<'t>(&mut self, of: OptionForm, grammar: &mut Grammar<'t, '_>) -> Outcome<'t> {
        self.t.read(of, grammar)?;
        self.x.read(of, grammar)
    }

    fn write(&mut self, word: &str, out: &mut RowWriter<'_>) {
        if *self != StatedMotion::NO_SHIFT {
            out.option(word, &[self.t]);
            out.point(self.x);
        }
    }
}

/// Vectors, each with the own time from which to which it acts.
impl Argument for Vec<Piece> {
    fn read<'t>(&mut self, of: OptionForm, grammar: &mut Grammar<'t, '_>) -> Outcome<'t> {
        let vector = grammar.take(point)?;
        let at = grammar.rest;
        let [from, to] = match grammar.optional(number)? {
            Some(from) => [from, grammar.take(number)?],
            None => [default_begin(first_word(of.form)), f64::INFINITY],
        };
        if from >= to {
            let remedy = "give the own time at which it begins, and a later one at which it ends";
            return refuse(at, Reason::Impossible(2, "the time is empty", remedy));
        }
        self.push(Piece { of: vector, from, to });
        Ok(())
    }

    fn write(&mut self, word: &str, out: &mut RowWriter<'_>) {
        for &mut Piece { of, from, to } in self {
            out.option(word, &of.to_array());
            if (from, to) != (default_begin(word), f64::INFINITY) {
                out.numbers(&[from, to]);
            }
        }
    }
}

/// When a piece without times begins.
fn default_begin(word: &str) -> f64 {
    if word == "acc" { 0.0 } else { f64::NEG_INFINITY }
}

/// `-on`
impl Argument for Option<MotionReference> {
    fn read<'t>(&mut self, _: OptionForm, grammar: &mut Grammar<'t, '_>) -> Outcome<'t> {
        let before = grammar.rest;
        *self = grammar.optional_motion().unwrap_or_default();
        if self.is_none() {
            grammar.rest = before;
            *self = Some(MotionReference::Named(grammar.name("the name of a motion")?));
        }
        Ok(())
    }
}

impl Argument for Option<PathStatement> {
    fn read<'t>(&mut self, _: OptionForm, grammar: &mut Grammar<'t, '_>) -> Outcome<'t> {
        *self = Some(grammar.path()?);
        Ok(())
    }
}

/// The first motion along each path.
pub(crate) type Along = FxHashMap<usize, BodyId>;

/// Writes `motion`.
pub(crate) fn write_motion(body: BodyId, along: &Along, out: &mut RowWriter<'_>) {
    let bodies = &out.scene.bodies;
    let Some(motion) = bodies.statement(body) else { return };
    let StatedMotion { mut at, path, mut spins, on, mut shift } = motion.clone();
    out.begin("motion", bodies[body].name);
    at.write("at", out);
    match path {
        MotionPath::Free { velocity, mut accelerations } => {
            if !velocity.is_zero() {
                out.velocity(" -vel ", velocity);
            }
            accelerations.write("acc", out);
        }
        MotionPath::Curve { kind, numbers } => out.option(kind.word(), &numbers),
        MotionPath::Along(path) if along[&path.address()] != body => {
            out.text(" -path");
            out.motion_name(along[&path.address()]);
        }
        MotionPath::Along(path) => {
            let mut mark = " -path (";
            for Event { t, x } in path.events() {
                out.text(mark);
                out.digits(t);
                out.point(x);
                mark = " ";
            }
            out.text(")");
        }
    }
    if let Some(on) = on {
        out.text(" -on");
        match on {
            Carrier::Body(body) => bodies[body].name.into_iter().for_each(|name| out.name(name)),
            Carrier::Frame(frame) => write_frame(&frame, Some(DVec3::ZERO), out),
        }
    }
    spins.write("spin", out);
    shift.write("shift", out);
}

/// Writes the motion of a body. `at`: its reference point, if none is written.
pub(super) fn write_motion_of(body: BodyId, at: DVec3, out: &mut RowWriter<'_>) {
    let bodies = &out.scene.bodies;
    if bodies.statement(body).is_some() {
        out.motion_name(body);
    } else if let (Some(_), Some(frame)) =
        (bodies.stated_velocity(body), bodies.motion(body).inertial_frame())
    {
        let is_seen = out.scene.stage.seen_geometry().is_some();
        write_frame(frame, (!is_seen).then_some(at), out);
    }
}

/// Writes ` <x y z …>`. `default`: the reference point, if none is written; `None` if it has no
/// meaning.
fn write_frame(frame: &InertialFrame, default: Option<DVec3>, out: &mut RowWriter<'_>) {
    let InertialFrame { velocity, at, turn, shift } = *frame;
    out.velocity(" <", velocity);
    let at = default.and_then(|default| (at != default).then_some(at));
    FRAME.write(&StatedFrame { velocity, at, turn, shift }, out);
    out.text(">");
}
