//! Expands instances and arrays into a flat scene.
//!
//! The file's own tables become those of the scene; definitions are copied after them, once for
//! each instance.

mod bodies;
mod cameras;
mod comments;
mod labels;
mod motions;
mod paths;
mod placement;
mod queue;
mod rows;

use std::collections::BTreeMap;

use cameras::NestedCamera;
use glam::DVec3;
use placement::{Inherited, Placement};
use queue::{Queue, Queues};
use rustc_hash::FxHashMap;
use ugscene::{ColorId, Face, Scene, Vertex, VertexId};

use crate::diagnostic::Diagnostic;
use crate::passed_on::{Item, PassedOn};
use crate::reader::Document;
use crate::resolve::Links;
use crate::scope::{BodyTable, Scope};
use crate::source::Span;
use crate::statement::{Call, Counts, MotionReference, Repeat, StatedFrame};

/// The spans of the text from which the rows of a flat scene originate.
#[derive(Clone, Debug, Default)]
pub struct Origins {
    /// For each vertex, the name in its `v` statement.
    pub vertices: Vec<Span>,
    /// For each face that was read, its statement: the index is [`ugscene::Face::row_as_read`].
    pub faces: Vec<Span>,
    /// For each light, its statement.
    pub lights: Vec<Span>,
    /// For each camera, its statement.
    pub cameras: Vec<Span>,
    pub(super) wires: Vec<Span>,
    pub(super) passed_on: Vec<Span>,
}

impl Origins {
    /// The statement of a face, or of the face that it is a piece of.
    pub fn face(&self, face: &Face) -> Option<Span> {
        self.faces.get(face.row_as_read as usize).copied()
    }
}

/// The longest chain of nested instances for which the stack of any thread suffices.
const SHORT_CHAIN: usize = 200;

/// Stack for each level of a longer chain in bytes, several times the measured need.
const STACK_PER_LEVEL: usize = 1 << 15;

/// Builds the flat scene; it already contains colours, surfaces, and the names of the file.
pub(crate) fn expand<'t>(
    text: &'t [u8],
    document: &mut Document<'t>,
    links: &Links,
    scene: Scene,
    findings: &mut Vec<Diagnostic>,
) -> (Scene, PassedOn, Origins) {
    if links.levels <= SHORT_CHAIN {
        return expand_here(text, document, links, scene, findings);
    }
    // Expansion is recursive, so a long chain needs a thread with a larger stack.
    let mut outcome = None;
    let started = std::thread::scope(|scope| {
        let work = || outcome = Some(expand_here(text, document, links, scene, findings));
        let thread = std::thread::Builder::new().stack_size(links.levels * STACK_PER_LEVEL);
        thread.spawn_scoped(scope, work).map(|_| ())
    });
    outcome.unwrap_or_else(|| {
        let why = started.err().map_or(String::new(), |error| format!(": {error}"));
        let message = format!("there is not enough memory for such a long chain of instances{why}");
        findings.push(Diagnostic::error(Span::default(), message));
        Default::default()
    })
}

fn expand_here<'t>(
    text: &'t [u8],
    document: &mut Document<'t>,
    links: &Links,
    scene: Scene,
    findings: &mut Vec<Diagnostic>,
) -> (Scene, PassedOn, Origins) {
    // Only comments after the head require the spans of statements.
    let first_statement = document.first_statement.unwrap_or(u32::MAX);
    let has_comments =
        document.comments.last().is_some_and(|comment| comment.text.start > first_statement);
    let mut file = std::mem::take(&mut document.scopes[0]);
    let mut expander = Expander {
        text,
        scopes: &document.scopes,
        links,
        scene,
        passed_on: PassedOn::default(),
        origins: Origins::default(),
        emitted: has_comments.then(Vec::new),
        next_vertex: 0,
        path_rows: FxHashMap::default(),
        has_linked_paths: false,
        undefined: BTreeMap::new(),
        first_shadings: vec![None; document.scopes.len()],
        bodies: BodyTable::default(),
        error: None,
        degenerate: BTreeMap::new(),
        nested_cameras: Vec::new(),
    };
    expander.note_definitions(&file);
    let motions = std::mem::take(&mut file.motions);
    let stage = document.stage.map(|(_, span)| span);
    expander.note(stage.as_slice(), 0, |_| Item::Stage);
    expander.bodies = std::mem::take(&mut file.bodies);
    let (motions, wrong) = expander.set_motions(&motions);
    let is_valid = wrong.is_empty();
    let has_unnamed = file.colors.spans.contains(&None);
    expander.file(file);
    labels::follow_vertices(&mut expander.scene);
    findings.extend(wrong);
    findings.extend(expander.finish_motions(&motions, is_valid));
    findings.extend(std::mem::take(&mut expander.undefined).into_values());
    expander.make_names_unique(has_unnamed);
    expander.place_comments(&document.comments, first_statement);
    findings.extend(expander.prefer_outer_camera());
    findings.extend(expander.error);
    findings.extend(expander.degenerate.into_values());
    (expander.scene, expander.passed_on, expander.origins)
}

struct Expander<'d, 't> {
    text: &'t [u8],
    /// The definitions; the first scope, the file, is empty.
    scopes: &'d [Scope<'t>],
    links: &'d Links,
    scene: Scene,
    passed_on: PassedOn,
    origins: Origins,
    /// If there are comments to attach, the statements that are not in `origins`, and their rows.
    emitted: Option<Vec<(Span, Item)>>,
    /// The first vertex of the next scope, after all vertices have been expanded.
    next_vertex: usize,
    /// Expanded vertices by path, if the scene uses paths.
    path_rows: FxHashMap<String, VertexId>,
    /// True if a corner of the file is one of them.
    has_linked_paths: bool,
    /// Errors for undefined paths, by position.
    undefined: BTreeMap<u32, Diagnostic>,
    /// For each expanded scope, the row of its first shading.
    first_shadings: Vec<Option<usize>>,
    bodies: BodyTable<'t>,
    /// The first error of expansion.
    error: Option<Diagnostic>,
    /// Warnings for faces without area after transformation, one per statement, by position.
    degenerate: BTreeMap<u32, Diagnostic>,
    /// In the order of their rows.
    nested_cameras: Vec<NestedCamera>,
}

impl<'t> Expander<'_, 't> {
    /// Moves the file's tables into the scene, and expands its calls between their rows.
    fn file(&mut self, mut file: Scope<'t>) {
        self.scene.vertices = std::mem::take(&mut file.vertices.rows);
        self.origins.vertices = std::mem::take(&mut file.vertices.spans);
        // Faces may use later vertices, also those of instances, so vertices are expanded first.
        let inherited = Inherited::file();
        self.next_vertex = self.scene.vertices.len();
        for call in &file.calls.rows {
            self.call(call, &inherited, Self::vertices);
        }
        self.enter_paths(&file);
        self.link_paths(&mut file);

        let end = file.counts();
        self.scene.contours = file.contours;
        self.scene.shadings = file.shadings;
        let mut queues = Queues {
            faces: Queue::new(file.faces),
            wires: Queue::new(file.wires),
            lights: Queue::new(file.lights),
            cameras: Queue::new(file.cameras),
            passed_on: Queue::new(file.passed_on),
        };
        for call in &file.calls.rows {
            self.move_rows(&mut queues, call.before);
            self.call(call, &inherited, Self::scope);
        }
        self.move_rows(&mut queues, end);
    }

    /// Copies the vertices of a definition and of its instances.
    fn vertices(&mut self, row: usize, inherited: &Inherited) {
        let scope = &self.scopes[row];
        for (vertex, &span) in scope.vertices.rows.iter().zip(&scope.vertices.spans) {
            let position = inherited.transform.point(vertex.position);
            let normal = vertex.normal.map(|normal| inherited.transform.normal(normal));
            self.check_finite(span, position);
            normal.into_iter().for_each(|normal| self.check_length(span, normal));
            let name = self.name(scope, vertex.name, inherited);
            self.scene.vertices.push(Vertex { name, position, normal, ..*vertex });
            self.origins.vertices.push(span);
        }
        for call in &scope.calls.rows {
            self.call(call, inherited, Self::vertices);
        }
    }

    /// Copies everything except the vertices, which were expanded in the same order.
    fn scope(&mut self, row: usize, inherited: &Inherited) {
        let scope = &self.scopes[row];
        let bodies = self.bodies_in(scope, inherited);
        let first_vertex = self.next_vertex as u32;
        self.next_vertex += scope.vertices.len();
        let paths = scope.paths.iter();
        let paths = paths
            .filter_map(|path| Some((path.corner, self.find_path(&inherited.prefix, path.name)?)));
        let paths: FxHashMap<usize, VertexId> = paths.collect();
        if paths.len() < scope.paths.len() {
            return;
        }
        let default = scope.outer_default;
        let first_time = self.first_shadings[row].is_none();
        let first_shading = *self.first_shadings[row].get_or_insert_with(|| {
            self.scene.shadings.extend_from_slice(&scope.shadings);
            self.scene.shadings.len() - scope.shadings.len()
        });
        let placement = Placement {
            scope,
            inherited,
            first_vertex,
            paths,
            bodies: &bodies,
            first_time,
            first_color: self.links.first_colors[row],
            first_shading,
            outer_default: default.map(|(outer, color)| {
                ColorId::from_index(self.links.first_colors[outer] + color as usize)
            }),
        };
        let mut done = Counts::default();
        for call in &scope.calls.rows {
            self.rows(&placement, done, call.before);
            done = call.before;
            self.call(call, inherited, Self::scope);
        }
        self.rows(&placement, done, scope.counts());
    }

    /// Calls `place` for every copy of an instance or array.
    fn call(
        &mut self,
        call: &Call,
        inherited: &Inherited,
        place: fn(&mut Self, usize, &Inherited),
    ) {
        let (Some(target), label) = (call.target, &call.label) else { return };
        let transform = call.inner.then(&inherited.transform);
        let body = match call.motion {
            None => inherited.body,
            Some(MotionReference::Named(name)) => {
                let body = self.bodies.named(self.text, name);
                Some(self.named_body_in(body, name, inherited))
            }
            Some(MotionReference::Frame(frame)) => {
                let at = frame
                    .at
                    .map_or(transform.point(DVec3::ZERO), |at| inherited.transform.point(at));
                let frame = StatedFrame { at: Some(at), ..frame };
                Some(self.frame_in(frame.about(at), call.definition, inherited))
            }
        };
        let colon = if inherited.prefix.is_empty() || label.is_empty() { "" } else { ":" };
        let mut inner = Inherited {
            transform,
            prefix: format!("{}{colon}{label}", inherited.prefix),
            color: call.color.or(inherited.color),
            body,
        };
        match &call.repeat {
            Repeat::Once => place(self, target, &inner),
            Repeat::Times(copies, step) => {
                let base = std::mem::take(&mut inner.prefix);
                let mut steps = call.inner;
                for copy in 0..*copies {
                    inner.prefix = format!("{base}#{copy}");
                    inner.transform = steps.then(&inherited.transform);
                    place(self, target, &inner);
                    steps = steps.then(step);
                }
            }
        }
    }
}
