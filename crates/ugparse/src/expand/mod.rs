//! Puts everything in its place: scopes and what they place become a flat scene.
//!
//! The file's own tables become those of the scene; definitions are copied
//! behind them, once for each instance.

mod cameras;
mod comments;
mod names;
mod paths;
mod placement;
mod queue;
mod rows;

use std::collections::BTreeMap;

use rustc_hash::FxHashMap;

use crate::diagnostic::Diagnostic;
use crate::reader::Document;
use crate::resolve::{Link, Links};
use crate::scene::{ColorId, Item, Scene, Vertex, VertexId};
use crate::scope::{BodyTable, Call, Counts, Scope};
use crate::source::Span;
use crate::statement::Repeat;

use cameras::NestedCamera;
use placement::{Inherited, Placement};
use queue::{Queue, Queues};

/// Where in the text the rows of a flat scene come from.
#[derive(Clone, Debug, Default)]
pub struct Origins {
    /// For each vertex, its name in its `v` statement.
    pub vertices: Vec<Span>,
    /// For each face, its statement.
    pub faces: Vec<Span>,
    /// For each camera, its statement.
    pub cameras: Vec<Span>,
}

/// Chains of definitions that any thread has stack for.
const SHORT_CHAIN: usize = 200;

/// Bytes of stack for each definition of a longer chain: several times what is needed.
const STACK_PER_LEVEL: usize = 1 << 15;

/// Builds the flat scene; colours, surfaces, and the names of the file, are in it already.
pub(crate) fn expand(
    text: &[u8],
    document: &mut Document<'_>,
    links: &Links,
    scene: Scene,
    findings: &mut Vec<Diagnostic>,
) -> (Scene, Origins) {
    if links.levels <= SHORT_CHAIN {
        return expand_here(text, document, links, scene, findings);
    }
    // Placing recurses, so a long chain gets a thread with a stack of its length.
    let mut outcome = None;
    let started = std::thread::scope(|scope| {
        let work = || outcome = Some(expand_here(text, document, links, scene, findings));
        let thread = std::thread::Builder::new().stack_size(links.levels * STACK_PER_LEVEL);
        thread.spawn_scoped(scope, work).map(|_| ())
    });
    outcome.unwrap_or_else(|| {
        let why = started.err().map_or(String::new(), |error| format!(": {error}"));
        let message = format!("there is no memory for so long a chain of definitions{why}");
        findings.push(Diagnostic::error(Span::default(), message));
        Default::default()
    })
}

fn expand_here(
    text: &[u8],
    document: &mut Document<'_>,
    links: &Links,
    scene: Scene,
    findings: &mut Vec<Diagnostic>,
) -> (Scene, Origins) {
    // Only comments behind the head ask where statements stand.
    let first_statement = document.first_statement.unwrap_or(u32::MAX);
    let has_comments = document.comments.last().is_some_and(|comment| comment.text.start > first_statement);
    let file = std::mem::take(&mut document.scopes[0]);
    let mut placer = Placer {
        text,
        scopes: &document.scopes,
        links,
        scene,
        origins: Origins::default(),
        emitted: has_comments.then(Vec::new),
        placed_before: vec![false; document.scopes.len()],
        next_vertex: 0,
        path_rows: FxHashMap::default(),
        has_linked_paths: false,
        undefined: BTreeMap::new(),
        first_illums: vec![None; document.scopes.len()],
        bodies: BodyTable::default(),
        syntax_error: None,
        flattened: BTreeMap::new(),
        nested_cameras: Vec::new(),
    };
    placer.note_definitions(&file);
    let stage = document.stage.map(|(_, span)| span);
    placer.note(stage.as_slice(), 0, |_| Item::Stage);
    placer.file(file);
    findings.extend(std::mem::take(&mut placer.undefined).into_values());
    placer.make_names_unique();
    placer.place_comments(&document.comments, first_statement);
    findings.extend(placer.prefer_outer_camera());
    findings.extend(placer.syntax_error);
    findings.extend(placer.flattened.into_values());
    placer.scene.bodies = placer.bodies.bodies;
    (placer.scene, placer.origins)
}

struct Placer<'d, 't> {
    text: &'t [u8],
    /// The definitions; the row of the file is empty.
    scopes: &'d [Scope<'t>],
    links: &'d Links,
    scene: Scene,
    origins: Origins,
    /// Where each statement stands and the first row it gave, if comments ask for it.
    emitted: Option<Vec<(Span, Item)>>,
    /// Vertices of the scope have been placed.
    placed_before: Vec<bool>,
    /// Where the vertices of the next scope begin, when all vertices are placed.
    next_vertex: usize,
    /// Placed vertices by path, if something names one.
    path_rows: FxHashMap<String, VertexId>,
    /// A corner of the file was linked to one of them.
    has_linked_paths: bool,
    /// Paths that lead nowhere, by their positions.
    undefined: BTreeMap<u32, Diagnostic>,
    /// For each scope that has been placed, the row of its first illum.
    first_illums: Vec<Option<usize>>,
    bodies: BodyTable,
    /// The first thing that cannot be placed.
    syntax_error: Option<Diagnostic>,
    /// Warnings for faces that have no area where they are placed, once for
    /// each statement, by its position.
    flattened: BTreeMap<u32, Diagnostic>,
    /// In the order of their rows.
    nested_cameras: Vec<NestedCamera>,
}

impl Placer<'_, '_> {
    /// The file's tables become the scene's, with what calls give in between.
    fn file(&mut self, mut file: Scope<'_>) {
        self.bodies = std::mem::take(&mut file.bodies);
        if self.emitted.is_some() {
            let names = file.vertices.spans.iter();
            let spans: Vec<Span> = names.map(|&name| Scope::vertex_statement(self.text, name)).collect();
            self.note(&spans, 0, Item::Vertex);
        }
        self.scene.vertices = std::mem::take(&mut file.vertices.rows);
        self.origins.vertices = std::mem::take(&mut file.vertices.spans);
        // Faces may name vertices that come later, also in instances, so vertices go first.
        let inherited = Inherited::file();
        self.next_vertex = self.scene.vertices.len();
        for (call, link) in file.calls.rows.iter().zip(&self.links.calls[0]) {
            self.call(call, link, &inherited, Self::vertices);
        }
        self.enter_paths(&file);
        self.link_paths(&mut file);

        let end = file.counts();
        self.scene.contours = file.contours;
        self.scene.illums = file.illums;
        let mut queues = Queues {
            faces: Queue::new(file.faces),
            wires: Queue::new(file.wires),
            lights: Queue::new(file.lights),
            cameras: Queue::new(file.cameras),
            escapes: Queue::new(file.escapes),
            unknown: Queue::new(file.unknown),
        };
        for (call, link) in file.calls.rows.iter().zip(&self.links.calls[0]) {
            self.move_rows(&mut queues, call.before);
            self.call(call, link, &inherited, Self::scope);
        }
        self.move_rows(&mut queues, end);
    }

    /// Copies the vertices of a definition, and of what it places.
    fn vertices(&mut self, row: usize, inherited: &Inherited) {
        let scope = &self.scopes[row];
        let first_time = !std::mem::replace(&mut self.placed_before[row], true);
        for (vertex, &span) in scope.vertices.rows.iter().zip(&scope.vertices.spans) {
            let position = inherited.transform.point(vertex.position);
            let normal = vertex.normal.map(|normal| inherited.transform.normal(normal));
            self.check_finite(span, position);
            self.check_finite(span, normal.unwrap_or_default());
            let name = self.name(scope, vertex.name, inherited);
            if first_time && self.emitted.is_some() {
                let row = self.scene.vertices.len();
                self.note(&[Scope::vertex_statement(self.text, span)], row, Item::Vertex);
            }
            self.scene.vertices.push(Vertex { name, position, color: vertex.color, normal });
            self.origins.vertices.push(span);
        }
        for (call, link) in scope.calls.rows.iter().zip(&self.links.calls[row]) {
            self.call(call, link, inherited, Self::vertices);
        }
    }

    /// Copies all but the vertices, which come in the same order as before.
    fn scope(&mut self, row: usize, inherited: &Inherited) {
        let scope = &self.scopes[row];
        let bodies = self.bodies.enter_all(&scope.bodies);
        let first_vertex = self.next_vertex as u32;
        self.next_vertex += scope.vertices.len();
        let paths = scope.paths.iter();
        let paths =
            paths.filter_map(|path| Some((path.corner, self.find_path(&inherited.prefix, path.name)?)));
        let paths: FxHashMap<usize, VertexId> = paths.collect();
        if paths.len() < scope.paths.len() {
            return;
        }
        let default = scope.outer_default;
        let first_time = self.first_illums[row].is_none();
        let first_illum = *self.first_illums[row].get_or_insert_with(|| {
            self.scene.illums.extend_from_slice(&scope.illums);
            self.scene.illums.len() - scope.illums.len()
        });
        let placement = Placement {
            scope,
            inherited,
            first_vertex,
            paths,
            bodies: &bodies,
            first_time,
            first_color: self.links.first_colors[row],
            first_illum,
            outer_default: default
                .map(|(outer, color)| ColorId::from_index(self.links.first_colors[outer] + color as usize)),
        };
        let mut done = Counts::default();
        for (call, link) in scope.calls.rows.iter().zip(&self.links.calls[row]) {
            self.rows(&placement, done, call.before);
            done = call.before;
            self.call(call, link, inherited, Self::scope);
        }
        self.rows(&placement, done, scope.counts());
    }

    /// Lets `place` see to every copy that a call asks for.
    fn call(
        &mut self,
        call: &Call,
        link: &Link,
        inherited: &Inherited,
        place: fn(&mut Self, usize, &Inherited),
    ) {
        let (Some(target), label) = (link.target, &link.label) else { return };
        let Call { statement: call, color, .. } = call;
        let own_body = call.velocity.map(|velocity| self.bodies.moving_with(velocity));
        let colon = if inherited.prefix.is_empty() || label.is_empty() { "" } else { ":" };
        let mut inner = Inherited {
            transform: call.inner.then(&inherited.transform),
            prefix: format!("{}{colon}{label}", inherited.prefix),
            color: color.or(inherited.color),
            body: inherited.body.or(own_body),
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
