//! Gives the bodies with a name their motions, after all statements are read.

use glam::DVec3;
use rustc_hash::{FxHashMap, FxHashSet};
use ugphysics::{SampledPath, WorldLine, WorldLineError};
use ugscene::{BodyId, Carrier, FaceOrWire, LightKind, MotionPath, StatedMotion};

use super::Expander;
use crate::diagnostic::Diagnostic;
use crate::event_table::impossible as impossible_path;
use crate::passed_on::Item;
use crate::resolve::undefined_like;
use crate::rows::Rows;
use crate::source::Span;
use crate::statement::{MotionReference, MotionStatement, PathStatement};
use crate::token::{blank, found, number};

/// The longest chain of motions of which each is part of the next.
const MAX_CARRIERS: usize = 64;

/// The most pieces of acceleration and spin that motions take over from those they ride on, counted
/// for each motion, so that a chain with many riders does not multiply them.
const MAX_CARRIED_PIECES: usize = 1 << 17;

/// The motions of a file by the bodies that have them.
pub(super) struct Motions<'m> {
    statements: &'m Rows<MotionStatement>,
    rows: FxHashMap<BodyId, usize>,
    /// Of each statement.
    paths: Vec<Option<SampledPath>>,
}

impl Expander<'_, '_> {
    /// Sets the motions of all bodies with a name. Returns what is wrong with them.
    pub(super) fn set_motions<'m>(
        &mut self,
        statements: &'m Rows<MotionStatement>,
    ) -> (Motions<'m>, Vec<Diagnostic>) {
        for motion in &statements.rows {
            if let Some(MotionReference::Named(carrier)) = motion.on {
                self.bodies.named(self.text, carrier);
            }
        }
        let mut findings = self.inner_motions();
        let mut motions = Motions { statements, rows: FxHashMap::default(), paths: Vec::new() };
        for (row, motion) in statements.rows.iter().enumerate() {
            let body = self.bodies.named(self.text, motion.name);
            if let Some(first) = motions.rows.insert(body, row) {
                let shown = motion.name.lossy(self.text);
                let places = [motion.name, statements.rows[first].name];
                let help = "give one of them another name: each is a body of its own";
                findings.push(Diagnostic::again(
                    places,
                    format!("motion `{shown}` is defined twice"),
                    help,
                ));
            }
        }
        if findings.is_empty() {
            findings.extend(self.set_all(&mut motions).err());
        }
        (motions, findings)
    }

    fn set_all(&mut self, motions: &mut Motions<'_>) -> Result<(), Diagnostic> {
        self.undefined_motions(motions)?;
        let names = self.bodies.names();
        self.too_many_pieces(motions, &names)?;
        motions.paths = self.paths(motions)?;
        names.iter().try_for_each(|&(body, name)| self.set_motion(motions, body, name))
    }

    /// Names that no statement defines, and vertices that cannot move as their bodies do; after all
    /// definitions are expanded. The bodies become those of the scene.
    pub(super) fn finish_motions(
        &mut self,
        motions: &Motions<'_>,
        is_valid: bool,
    ) -> Option<Diagnostic> {
        self.scene.bodies = std::mem::take(&mut self.bodies.bodies);
        self.note_motions(motions);
        let check =
            || self.undefined_motions(motions).and_then(|()| self.check_points(motions)).err();
        if is_valid { check() } else { None }
    }

    /// An error for the first name that no statement defines.
    fn undefined_motions(&self, motions: &Motions<'_>) -> Result<(), Diagnostic> {
        let names = self.bodies.names();
        let Some(&(_, name)) = names.iter().find(|(body, _)| !motions.rows.contains_key(body))
        else {
            return Ok(());
        };
        let remedy = "define it with a `motion` statement";
        let defined = motions.statements.rows.iter().map(|motion| motion.name.of(self.text));
        Err(undefined_like(self.text, "motion", name, remedy, defined, 0))
    }

    /// An error if motions take over more pieces than [`MAX_CARRIED_PIECES`]. Circles end it, too.
    fn too_many_pieces(
        &mut self,
        motions: &Motions<'_>,
        names: &[(BodyId, Span)],
    ) -> Result<(), Diagnostic> {
        let mut n_pieces = 0;
        for &(body, name) in names {
            let mut row = motions.rows[&body];
            for _ in 0..MAX_CARRIERS {
                let Some(MotionReference::Named(carrier)) = motions.statements.rows[row].on else {
                    break;
                };
                let carrier = self.bodies.named(self.text, carrier);
                row = motions.rows[&carrier];
                let statement = &motions.statements.rows[row];
                n_pieces += statement.accelerations.len() + statement.spins.len();
            }
            if n_pieces > MAX_CARRIED_PIECES {
                let error = Diagnostic::error(name, "motions ride on others of too many pieces");
                let help = format!(
                    "all motions together may take over {MAX_CARRIED_PIECES} pieces of -acc and -spin from \
                     those they are on"
                );
                return Err(error.label("used here").help(help));
            }
        }
        Ok(())
    }

    /// A motion is a body of the whole scene.
    fn inner_motions(&self) -> Vec<Diagnostic> {
        let inner = self.scopes.iter().flat_map(|scope| scope.motions.spans.first()).next();
        let error = |&span: &Span| {
            let help = "state it outside: it is one body of the scene, however often the definition is placed";
            Diagnostic::here(span, "a motion is inside a definition", help)
        };
        inner.map(error).into_iter().collect()
    }

    /// The path of each motion through events.
    fn paths(&mut self, motions: &Motions<'_>) -> Result<Vec<Option<SampledPath>>, Diagnostic> {
        let statements = &motions.statements.rows;
        let own = |motion: &MotionStatement| {
            let Some(PathStatement::Events { span, events }) = &motion.path else {
                return Ok(None);
            };
            let path = SampledPath::new(events);
            let spans = |row| event_span(self.text, *span, row);
            path.map(Some).map_err(|error| impossible_path(&error, spans))
        };
        let mut paths: Vec<_> = statements.iter().map(own).collect::<Result<_, _>>()?;
        for (row, motion) in statements.iter().enumerate() {
            let Some(PathStatement::Of(name)) = motion.path else { continue };
            let other = self.bodies.named(self.text, name);
            let path = motions.rows.get(&other).map(|&other| &statements[other].path);
            if !matches!(path, Some(Some(PathStatement::Events { .. }))) {
                let shown = name.lossy(self.text);
                return Err(Diagnostic::error(
                    name,
                    format!("motion `{shown}` states no table of a path"),
                )
                .label("used here")
                .help("name a motion that has `-path` with a file or with events"));
            }
            paths[row] = paths[motions.rows[&other]].clone();
        }
        Ok(paths)
    }

    fn note_motions(&mut self, motions: &Motions<'_>) {
        let rows: Vec<BodyId> = self.scene.bodies.stated_by_name().collect();
        for (row, body) in rows.into_iter().enumerate() {
            if let Some(&statement) = motions.rows.get(&body) {
                self.note(&[motions.statements.spans[statement]], row, Item::Motion);
            }
        }
    }

    fn set_motion(
        &mut self,
        motions: &Motions<'_>,
        body: BodyId,
        name: Span,
    ) -> Result<(), Diagnostic> {
        let (motion, line) = self.motion(motions, body, 0)?;
        let name = name.lossy(self.text);
        let name = self.scene.names.add(&name);
        self.bodies.bodies.set_statement(body, name, motion, line);
        Ok(())
    }

    /// The motion of a body and its world line. `depth`: of carriers before it.
    fn motion(
        &mut self,
        motions: &Motions<'_>,
        body: BodyId,
        depth: usize,
    ) -> Result<(StatedMotion, WorldLine), Diagnostic> {
        let row = motions.rows[&body];
        let (statement, span) = (&motions.statements.rows[row], motions.statements.spans[row]);
        if depth > MAX_CARRIERS {
            let error =
                Diagnostic::error(span, "motions are part of each other in a circle, or too many");
            let help =
                format!("a motion may be part of {MAX_CARRIERS} others at most, and not of itself");
            return Err(error.label("this one").help(help));
        }
        let MotionStatement { at, velocity, accelerations, spins, on, shift, .. } = statement;
        let path = match (&statement.path, &motions.paths[row]) {
            (Some(PathStatement::Curve(kind, numbers)), _) => {
                MotionPath::Curve { kind, numbers: numbers.clone() }
            }
            (_, Some(path)) => MotionPath::Along(path.clone()),
            (_, None) => {
                MotionPath::Free { velocity: *velocity, accelerations: accelerations.clone() }
            }
        };
        let (on, carrier) = match on {
            None => (None, WorldLine::REST),
            Some(MotionReference::Frame(frame)) => {
                (Some(Carrier::Frame(frame.about(DVec3::ZERO))), WorldLine::REST)
            }
            Some(MotionReference::Named(name)) => {
                let body = self.bodies.named(self.text, *name);
                (Some(Carrier::Body(body)), self.motion(motions, body, depth + 1)?.1)
            }
        };
        let motion = StatedMotion { at: *at, path, spins: spins.clone(), on, shift: *shift };
        match motion.world_line(&carrier).map_err(|error| impossible(span, &error))? {
            Some(line) => Ok((motion, line)),
            None => Err(Diagnostic::error(
                span,
                "the motion is on a body that accelerates or turns",
            )
            .label("this motion")
            .help(
                "only a fixed point of such a body can carry it: remove all but `-at` and `-spin`",
            )),
        }
    }

    /// Checks that every vertex and every lamp can move as its body does, in a scene at rest.
    fn check_points(&self, motions: &Motions<'_>) -> Result<(), Diagnostic> {
        let scene = &self.scene;
        if scene.stage.seen_geometry().is_some() || !scene.bodies.has_world_lines() {
            return Ok(());
        }
        let check = |body: BodyId, point: DVec3, span: Span, moved: Moved<'_>| {
            let motion = motions.rows.get(&body).map(|&row| motions.statements.spans[row]);
            let possible = scene.bodies.motion(body).check(point);
            possible.map_err(|error| too_far(span, moved, &error, motion))
        };
        let mut checked = FxHashSet::default();
        let drawn = scene.drawn().filter(|drawn| scene.bodies.is_on_world_line(drawn.body));
        for FaceOrWire { body, contours, .. } in drawn {
            for &corner in scene.contours.corners(contours) {
                if checked.insert((body, corner)) {
                    let vertex = &scene.vertices[corner.index()];
                    let span = self.origins.vertices[corner.index()];
                    let name = scene.names.get(vertex.name);
                    let moved = Moved { kind: "vertex", name, radius: None };
                    check(body, vertex.position, span, moved)?;
                }
            }
        }
        for (light, &span) in scene.lights.iter().zip(&self.origins.lights) {
            let (LightKind::Local { position, radius, .. }, Some(body)) =
                (light.kind, light.motion.body())
            else {
                continue;
            };
            // A sphere is checked where the axes leave it.
            let ends = DVec3::AXES.into_iter().flat_map(|axis| [axis * radius, -axis * radius]);
            let name = light.name.map_or("", |name| scene.names.get(name));
            let moved = Moved { kind: "light", name, radius: None };
            check(body, position, span, moved)?;
            let moved = Moved { radius: Some(radius), ..moved };
            let mut ends = ends.filter(|_| radius > 0.0);
            ends.try_for_each(|end| check(body, position + end, span, moved))?;
        }
        Ok(())
    }
}

/// Where an event stands in a list; the whole list if it has fewer.
fn event_span(text: &[u8], list: Span, row: usize) -> Span {
    let mut rest = list.of(text);
    let mut skip = |n: usize| -> Option<u32> {
        for _ in 0..n {
            rest = number(rest).ok()?.0;
        }
        Some(list.end - blank(rest).map_or(rest, |(rest, ())| rest).len() as u32)
    };
    let start = skip(4 * row);
    // A number ends where the blank after it begins, or at the end of the list.
    let last = skip(3);
    match (start, last) {
        (Some(start), Some(last)) if last < list.end => {
            let length = found(&text[last as usize..]).len() as u32;
            Span { start, end: last + length }
        }
        _ => list,
    }
}

fn impossible(span: Span, error: &WorldLineError) -> Diagnostic {
    let help = match error {
        WorldLineError::Overlap { .. } => "let each piece end before the next begins",
        WorldLineError::Velocity(_) => "speeds stay below 1: use a smaller rate, or a shorter time",
        _ => "use smaller numbers",
    };
    Diagnostic::error(span, format!("no body can move so: {error}")).label("this motion").help(help)
}

/// What moves with a body.
#[derive(Clone, Copy)]
struct Moved<'a> {
    /// `vertex` or `light`.
    kind: &'a str,
    name: &'a str,
    /// Of a light whose middle can move so, but whose rim cannot.
    radius: Option<f64>,
}

fn too_far(
    point: Span,
    Moved { kind, name, radius }: Moved<'_>,
    error: &WorldLineError,
    motion: Option<Span>,
) -> Diagnostic {
    let name = if name.is_empty() { String::new() } else { format!(" `{name}`") };
    let radius_words = radius.map_or_else(String::new, |radius| format!(" of radius {radius}"));
    let message = format!("{kind}{name}{radius_words} cannot move with its body: {error}");
    let error = Diagnostic::error(point, message).label(format!("this {kind}"));
    let error = match motion {
        Some(motion) => error.other(motion, "moves so"),
        None => error,
    };
    error.help(match radius {
        Some(_) => "give it a smaller radius, or let the body spin or accelerate less",
        None => "bring it nearer to the point `-at`, or let the body spin or accelerate less",
    })
}
