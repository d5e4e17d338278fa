//! Puts everything in its place: groups and what they place become a flat scene.
//!
//! The file's own tables become those of the scene; definitions are copied
//! behind them, once for each instance.

use std::collections::BTreeMap;
use std::ops::Range;

use glam::DVec3;
use rustc_hash::FxHashMap;

use crate::diagnostic::Diagnostic;
use crate::group::{Call, Counts, DefaultColor, Group, NO_ROW, Rows, Velocities, as_str};
use crate::names::{NameId, Names, UniqueNames};
use crate::reader::{CommentSpan, Document};
use crate::scene::{
    Camera, ColorId, Comment, Face, IllumId, Item, Light, LightKind, Scene, VelocityId, Vertex, VertexId,
    Wire, newell_normal,
};
use crate::settle::{Link, Links, face_name, flatness, has_three, is_short, left_out, short_wire, undefined};
use crate::source::Span;
use crate::statement::Repeat;
use crate::transform::Transform;

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
pub(crate) fn place(
    text: &[u8],
    document: &mut Document<'_>,
    links: &Links,
    scene: Scene,
    findings: &mut Vec<Diagnostic>,
) -> (Scene, Origins) {
    if links.levels <= SHORT_CHAIN {
        return place_here(text, document, links, scene, findings);
    }
    // Placing recurses, so a long chain gets a thread with a stack of its length.
    let mut outcome = None;
    let started = std::thread::scope(|scope| {
        let work = || outcome = Some(place_here(text, document, links, scene, findings));
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

fn place_here(
    text: &[u8],
    document: &mut Document<'_>,
    links: &Links,
    scene: Scene,
    findings: &mut Vec<Diagnostic>,
) -> (Scene, Origins) {
    // Only comments behind the head ask where statements stand.
    let first_statement = document.first_statement.unwrap_or(u32::MAX);
    let has_comments = document.comments.last().is_some_and(|comment| comment.text.start > first_statement);
    let file = std::mem::take(&mut document.groups[0]);
    let mut placer = Placer {
        text,
        groups: &document.groups,
        links,
        scene,
        origins: Origins::default(),
        emitted: has_comments.then(Vec::new),
        placed_before: vec![false; document.groups.len()],
        next_vertex: 0,
        path_rows: FxHashMap::default(),
        has_linked_paths: false,
        undefined: BTreeMap::new(),
        first_illums: vec![None; document.groups.len()],
        velocities: Velocities::default(),
        trouble: None,
        flattened: BTreeMap::new(),
    };
    placer.note_definitions(&file);
    placer.file(file);
    findings.extend(std::mem::take(&mut placer.undefined).into_values());
    placer.make_names_unique();
    placer.place_comments(&document.comments, first_statement);
    findings.extend(placer.trouble);
    findings.extend(placer.flattened.into_values());
    placer.scene.velocities = placer.velocities.list;
    (placer.scene, placer.origins)
}

/// What a group inherits from the calls that place it.
struct Frame {
    transform: Transform,
    /// Path of the names made here, without the last `:`.
    prefix: String,
    color: Option<ColorId>,
    velocity: Option<VelocityId>,
}

impl Frame {
    /// That of the file itself, which nothing places.
    fn file() -> Self {
        Self { transform: Transform::IDENTITY, prefix: String::new(), color: None, velocity: None }
    }
}

/// A definition that is being placed.
struct Placement<'p> {
    group: &'p Group<'p>,
    frame: &'p Frame,
    /// Row of its first vertex in the scene.
    first_vertex: u32,
    /// The vertices at corners that name those of instances.
    paths: FxHashMap<usize, VertexId>,
    /// Velocities of the group in the scene.
    velocities: &'p [VelocityId],
    first_time: bool,
    /// Row of the group's first colour in the scene.
    first_color: usize,
    /// Row of the group's first illum in the scene.
    first_illum: usize,
    /// The unnamed colour in force at the `def`.
    outer_default: Option<ColorId>,
}

impl Placement<'_> {
    /// Positions of the corners of a contour among those of the group.
    fn corners(&self, row: u32) -> Range<usize> {
        let first = self.group.contours.first_corner(row);
        first..first + self.group.contours.get(row).len()
    }

    /// The vertex at a corner.
    fn corner(&self, idx: usize) -> VertexId {
        let VertexId(local) = self.group.contours.corner(idx);
        if local == NO_ROW { self.paths[&idx] } else { VertexId(self.first_vertex + local) }
    }

    fn velocity(&self, velocity: Option<VelocityId>) -> Option<VelocityId> {
        velocity.map(|id| self.velocities[id.index()])
    }

    /// The colour of face or wire `row`; `first` says from which row on an unnamed colour is in force.
    fn color(&self, own: Option<ColorId>, row: usize, first: fn(&DefaultColor) -> usize) -> Option<ColorId> {
        own.or(self.frame.color).or_else(|| {
            let defaults = &self.group.defaults;
            let behind = defaults.partition_point(|default| first(default) <= row);
            match behind.checked_sub(1) {
                Some(idx) => Some(ColorId::from_index(self.first_color + defaults[idx].color as usize)),
                None => self.outer_default,
            }
        })
    }
}

struct Placer<'d, 't> {
    text: &'t [u8],
    /// The definitions; the row of the file is empty.
    groups: &'d [Group<'t>],
    links: &'d Links,
    scene: Scene,
    origins: Origins,
    /// Where each statement stands and the first row it gave, if comments ask for it.
    emitted: Option<Vec<(Span, Item)>>,
    /// Vertices of the group have been placed.
    placed_before: Vec<bool>,
    /// Where the vertices of the next group begin, when all vertices are placed.
    next_vertex: usize,
    /// Placed vertices by path, if something names one.
    path_rows: FxHashMap<String, VertexId>,
    /// A corner of the file was linked to one of them.
    has_linked_paths: bool,
    /// Paths that lead nowhere, by their positions.
    undefined: BTreeMap<u32, Diagnostic>,
    /// For each group that has been placed, the row of its first illum.
    first_illums: Vec<Option<usize>>,
    velocities: Velocities,
    /// The first thing that cannot be placed.
    trouble: Option<Diagnostic>,
    /// Warnings for faces that have no area where they are placed, once for
    /// each statement, by its position.
    flattened: BTreeMap<u32, Diagnostic>,
}

impl Placer<'_, '_> {
    /// Notes where colours and surfaces stand.
    fn note_definitions(&mut self, file: &Group<'_>) {
        let Some(emitted) = &mut self.emitted else { return };
        let defined = self.groups;
        let groups = || std::iter::once(file).chain(defined);
        let colors = groups().flat_map(|group| &group.colors.table.spans);
        emitted.extend(colors.enumerate().map(|(row, &span)| (span, Item::Color(row as u32))));
        let surfaces = groups().flat_map(|group| &group.surfaces.table.spans);
        emitted.extend(surfaces.enumerate().map(|(row, &span)| (span, Item::Surface(row as u32))));
    }

    /// The file's tables become the scene's, with what calls give in between.
    fn file(&mut self, mut file: Group<'_>) {
        self.velocities = std::mem::take(&mut file.velocities);
        if self.emitted.is_some() {
            let names = file.vertices.spans.iter();
            let spans: Vec<Span> = names.map(|&name| Group::vertex_statement(self.text, name)).collect();
            self.note(&spans, 0, Item::Vertex);
        }
        self.scene.vertices = std::mem::take(&mut file.vertices.rows);
        self.origins.vertices = std::mem::take(&mut file.vertices.spans);
        // Faces may name vertices that come later, also in instances, so vertices go first.
        let frame = Frame::file();
        self.next_vertex = self.scene.vertices.len();
        for (call, link) in file.calls.rows.iter().zip(&self.links.calls[0]) {
            self.call(call, link, &frame, Self::vertices);
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
            self.call(call, link, &frame, Self::group);
        }
        self.move_rows(&mut queues, end);
    }

    /// Notes the names of placed vertices, if anything asks for one.
    fn enter_paths(&mut self, file: &Group<'_>) {
        if file.paths.is_empty() && self.groups.iter().all(|group| group.paths.is_empty()) {
            return;
        }
        for (row, vertex) in self.scene.vertices.iter().enumerate().skip(self.next_vertex) {
            let path = self.scene.names.get(vertex.name).to_string();
            self.path_rows.entry(path).or_insert(VertexId::from_index(row));
        }
    }

    /// The vertex that a path means where `prefix` is placed.
    fn find_path(&mut self, prefix: &str, name: Span) -> Option<VertexId> {
        let own = as_str(name.of(self.text));
        let colon = if prefix.is_empty() { "" } else { ":" };
        let found = self.path_rows.get(&format!("{prefix}{colon}{own}")).copied();
        if found.is_none() {
            let remedy = "the path of a vertex is `instance:vertex`, or `array#3:vertex` for copy 3, from 0";
            let text = self.text;
            self.undefined.entry(name.start).or_insert_with(|| undefined(text, "vertex", name, remedy));
        }
        found
    }

    /// Links the file's corners that name vertices of instances. Faces that turn
    /// out to be flat are left out, and wires that are too short.
    fn link_paths(&mut self, file: &mut Group<'_>) {
        for path in std::mem::take(&mut file.paths) {
            let Some(vertex) = self.find_path("", path.name) else { continue };
            file.contours.parts_mut().0[path.corner] = vertex;
            self.has_linked_paths = true;
        }
        if !self.has_linked_paths || !self.undefined.is_empty() {
            return;
        }
        let problem = |face: &Face| flatness(&file.contours, &self.scene.vertices, face);
        let faces = file.faces.rows.iter().enumerate();
        let flat: Vec<_> = faces.filter_map(|(row, face)| Some((row, problem(face)?))).collect();
        for &(row, problem) in &flat {
            let span = file.faces.spans[row];
            let warning = left_out(self.text, span, "face", problem, "remove it, or mend its vertices");
            self.flattened.insert(span.start, warning);
        }
        file.remove_faces(&flat.into_iter().map(|(row, _)| row).collect::<Vec<_>>());
        let wires = file.wires.rows.iter().enumerate();
        let short: Vec<usize> =
            wires.filter(|(_, wire)| is_short(&file.contours, wire)).map(|(row, _)| row).collect();
        for &row in &short {
            let span = file.wires.spans[row];
            self.flattened.insert(span.start, short_wire(self.text, span));
        }
        file.remove_wires(&short);
    }

    /// Moves rows of the file up to `end`.
    fn move_rows(&mut self, queues: &mut Queues, end: Counts) {
        let spans = self.move_some(&mut queues.faces, end.faces, |scene| &mut scene.faces, Item::Face);
        append(&mut self.origins.faces, spans);
        self.move_some(&mut queues.wires, end.wires, |scene| &mut scene.wires, Item::Wire);
        self.move_some(&mut queues.lights, end.lights, |scene| &mut scene.lights, Item::Light);
        let spans =
            self.move_some(&mut queues.cameras, end.cameras, |scene| &mut scene.cameras, Item::Camera);
        append(&mut self.origins.cameras, spans);
        self.move_some(&mut queues.escapes, end.escapes, |scene| &mut scene.escapes, Item::Escape);
        self.move_some(&mut queues.unknown, end.unknown, |scene| &mut scene.unknown, Item::Unknown);
    }

    fn move_some<T>(
        &mut self,
        queue: &mut Queue<T>,
        end: usize,
        table: fn(&mut Scene) -> &mut Vec<T>,
        item: fn(u32) -> Item,
    ) -> Vec<Span> {
        let (rows, spans) = queue.take_up_to(end);
        let table = table(&mut self.scene);
        let first = table.len();
        append(table, rows);
        self.note(&spans, first, item);
        spans
    }

    /// Notes where statements stand whose rows begin at `first`.
    fn note(&mut self, spans: &[Span], first: usize, item: fn(u32) -> Item) {
        if let Some(emitted) = &mut self.emitted {
            emitted.extend(spans.iter().zip(first as u32..).map(|(&span, row)| (span, item(row))));
        }
    }

    /// Copies the vertices of a definition, and of what it places.
    fn vertices(&mut self, row: usize, frame: &Frame) {
        let group = &self.groups[row];
        let first_time = !std::mem::replace(&mut self.placed_before[row], true);
        for (vertex, &span) in group.vertices.rows.iter().zip(&group.vertices.spans) {
            let position = frame.transform.point(vertex.position);
            let normal = vertex.normal.map(|normal| frame.transform.normal(normal));
            self.check_finite(span, position);
            self.check_finite(span, normal.unwrap_or_default());
            let name = self.name(group, vertex.name, frame);
            if first_time && self.emitted.is_some() {
                let row = self.scene.vertices.len();
                self.note(&[Group::vertex_statement(self.text, span)], row, Item::Vertex);
            }
            self.scene.vertices.push(Vertex { name, position, color: vertex.color, normal });
            self.origins.vertices.push(span);
        }
        for (call, link) in group.calls.rows.iter().zip(&self.links.calls[row]) {
            self.call(call, link, frame, Self::vertices);
        }
    }

    /// Copies all but the vertices, which come in the same order as before.
    fn group(&mut self, row: usize, frame: &Frame) {
        let group = &self.groups[row];
        let velocities: Vec<VelocityId> =
            group.velocities.list.iter().map(|&velocity| self.velocities.id(velocity)).collect();
        let first_vertex = self.next_vertex as u32;
        self.next_vertex += group.vertices.len();
        let paths = group.paths.iter();
        let paths = paths.filter_map(|path| Some((path.corner, self.find_path(&frame.prefix, path.name)?)));
        let paths: FxHashMap<usize, VertexId> = paths.collect();
        if paths.len() < group.paths.len() {
            return;
        }
        let default = group.outer_default;
        let first_time = self.first_illums[row].is_none();
        let first_illum = *self.first_illums[row].get_or_insert_with(|| {
            self.scene.illums.extend_from_slice(&group.illums);
            self.scene.illums.len() - group.illums.len()
        });
        let placement = Placement {
            group,
            frame,
            first_vertex,
            paths,
            velocities: &velocities,
            first_time,
            first_color: self.links.first_colors[row],
            first_illum,
            outer_default: default
                .map(|(outer, color)| ColorId::from_index(self.links.first_colors[outer] + color as usize)),
        };
        let mut done = Counts::default();
        for (call, link) in group.calls.rows.iter().zip(&self.links.calls[row]) {
            self.rows(&placement, done, call.before);
            done = call.before;
            self.call(call, link, frame, Self::group);
        }
        self.rows(&placement, done, group.counts());
    }

    /// Places all but vertices and calls, from `start` up to `end`.
    fn rows(&mut self, placement: &Placement<'_>, start: Counts, end: Counts) {
        let group = placement.group;
        for row in start.faces..end.faces {
            self.face(placement, row);
        }
        for row in start.wires..end.wires {
            self.wire(placement, row);
        }
        for row in start.lights..end.lights {
            self.light(placement, row);
        }
        for row in start.cameras..end.cameras {
            self.camera(placement, row);
        }
        if placement.first_time {
            let (escapes, unknown) = (start.escapes..end.escapes, start.unknown..end.unknown);
            self.note(&group.escapes.spans[escapes.clone()], self.scene.escapes.len(), Item::Escape);
            self.scene.escapes.extend_from_slice(&group.escapes.rows[escapes]);
            self.note(&group.unknown.spans[unknown.clone()], self.scene.unknown.len(), Item::Unknown);
            self.scene.unknown.extend_from_slice(&group.unknown.rows[unknown]);
        }
    }

    fn note_first(&mut self, placement: &Placement<'_>, span: Span, row: usize, item: fn(u32) -> Item) {
        if placement.first_time {
            self.note(&[span], row, item);
        }
    }

    fn face(&mut self, placement: &Placement<'_>, row: usize) {
        let Placement { group, frame, .. } = placement;
        let (face, span) = (&group.faces.rows[row], group.faces.spans[row]);
        if !self.has_area(placement, face, span) {
            return;
        }
        self.note_first(placement, span, self.scene.faces.len(), Item::Face);
        let placed = Face {
            name: self.optional_name(group, face.name, frame),
            contours: self.contours(placement, face.contours.clone(), frame.transform.mirrored),
            color: placement.color(face.color, row, |default| default.first_face),
            illum: face.illum.map(|illum| IllumId::from_index(placement.first_illum + illum.index())),
            velocity: frame.velocity.or(placement.velocity(face.velocity)),
        };
        self.scene.faces.push(placed);
        self.origins.faces.push(span);
    }

    fn wire(&mut self, placement: &Placement<'_>, row: usize) {
        let Placement { group, frame, .. } = placement;
        let (wire, span) = (&group.wires.rows[row], group.wires.spans[row]);
        // One with corners by path comes as far as this.
        if is_short(&group.contours, wire) {
            self.flattened.entry(span.start).or_insert_with(|| short_wire(self.text, span));
            return;
        }
        self.note_first(placement, span, self.scene.wires.len(), Item::Wire);
        let placed = Wire {
            name: self.optional_name(group, wire.name, frame),
            contours: self.contours(placement, wire.contours.clone(), false),
            color: placement.color(wire.color, row, |default| default.first_wire),
            velocity: frame.velocity.or(placement.velocity(wire.velocity)),
        };
        self.scene.wires.push(placed);
    }

    /// Copies contours; a mirrored frame reverses their direction but keeps the first vertex.
    fn contours(&mut self, placement: &Placement<'_>, rows: Range<u32>, reversed: bool) -> Range<u32> {
        self.scene.contours.push_all(rows.map(|row| {
            let corners = placement.corners(row);
            let len = corners.len();
            (0..len).map(move |idx| {
                let idx = if reversed { (len - idx) % len } else { idx };
                placement.corner(corners.start + idx)
            })
        }))
    }

    /// False, with a warning, if a face has no area where it is placed: squashed
    /// flat by `-sz 0`, or too small beside its distance.
    fn has_area(&mut self, placement: &Placement<'_>, face: &Face, span: Span) -> bool {
        let outline = placement.corners(face.contours.start);
        let position = |corner: usize| self.scene.vertices[placement.corner(corner).index()].position;
        // Corners by path may turn out to be one vertex.
        let has_three = placement.paths.is_empty()
            || face.contours.clone().all(|row| {
                let corners: Vec<VertexId> =
                    placement.corners(row).map(|idx| placement.corner(idx)).collect();
                has_three(&corners)
            });
        if has_three && newell_normal(outline.map(position)) != DVec3::ZERO {
            return true;
        }
        let text = self.text;
        self.flattened.entry(span.start).or_insert_with(|| {
            let shown = face_name(text, span).unwrap_or(Span { start: span.start, end: span.start + 1 });
            Diagnostic::warning(shown, "face has no area where it is placed")
                .label("left out")
                .help("mend the transformations that place it")
        });
        false
    }

    fn light(&mut self, placement: &Placement<'_>, row: usize) {
        let Placement { group, frame, .. } = placement;
        let (light, span) = (&group.lights.rows[row], group.lights.spans[row]);
        self.note_first(placement, span, self.scene.lights.len(), Item::Light);
        let kind = match light.kind {
            LightKind::Ambient => LightKind::Ambient,
            LightKind::Directional(toward) => {
                let toward = frame.transform.direction(toward);
                self.check_direction(span, toward);
                LightKind::Directional(toward)
            }
            LightKind::Local { position, radius } => {
                let position = frame.transform.point(position);
                self.check_finite(span, position);
                LightKind::Local { position, radius }
            }
        };
        let placed = Light {
            name: self.optional_name(group, light.name, frame),
            kind,
            velocity: placement.velocity(light.velocity),
            ..light.clone()
        };
        self.scene.lights.push(placed);
    }

    fn camera(&mut self, placement: &Placement<'_>, row: usize) {
        let Placement { group, frame, .. } = placement;
        let (camera, span) = (&group.cameras.rows[row], group.cameras.spans[row]);
        self.note_first(placement, span, self.scene.cameras.len(), Item::Camera);
        let placed = Camera {
            name: self.optional_name(group, camera.name, frame),
            center: camera.center.map(|point| frame.transform.point(point)),
            eye: camera.eye.map(|point| frame.transform.point(point)),
            up: camera.up.map(|up| frame.transform.direction(up)),
            velocity: placement.velocity(camera.velocity),
            ..camera.clone()
        };
        for point in [placed.center, placed.eye].into_iter().flatten() {
            self.check_finite(span, point);
        }
        placed.up.into_iter().for_each(|up| self.check_direction(span, up));
        self.scene.cameras.push(placed);
        self.origins.cameras.push(span);
    }

    fn check_finite(&mut self, span: Span, place: DVec3) {
        if !place.is_finite() {
            self.trouble.get_or_insert_with(|| {
                Diagnostic::error(span, "coordinates overflow when this is placed")
                    .label("here")
                    .help("use smaller numbers")
            });
        }
    }

    fn check_direction(&mut self, span: Span, direction: DVec3) {
        self.check_finite(span, direction);
        if direction == DVec3::ZERO {
            self.trouble.get_or_insert_with(|| {
                Diagnostic::error(span, "this direction is lost when it is placed")
                    .label("has no length there")
                    .help("place it without a scale of 0")
            });
        }
    }

    /// Lets `place` see to every copy that a call asks for.
    fn call(&mut self, call: &Call, link: &Link, frame: &Frame, place: fn(&mut Self, usize, &Frame)) {
        let (Some(target), label) = (link.target, &link.label) else { return };
        let Call { statement: call, color, .. } = call;
        let own_velocity = call.velocity.map(|velocity| self.velocities.id(velocity));
        let colon = if frame.prefix.is_empty() || label.is_empty() { "" } else { ":" };
        let mut inner = Frame {
            transform: call.inner.then(&frame.transform),
            prefix: format!("{}{colon}{label}", frame.prefix),
            color: color.or(frame.color),
            velocity: frame.velocity.or(own_velocity),
        };
        match &call.repeat {
            Repeat::Once => place(self, target, &inner),
            Repeat::Times(copies, step) => {
                let base = std::mem::take(&mut inner.prefix);
                let mut steps = call.inner;
                for copy in 0..*copies {
                    inner.prefix = format!("{base}#{copy}");
                    inner.transform = steps.then(&frame.transform);
                    place(self, target, &inner);
                    steps = steps.then(step);
                }
            }
        }
    }

    fn name(&mut self, group: &Group<'_>, name: NameId, frame: &Frame) -> NameId {
        self.scene.names.add_parts(&[
            &frame.prefix,
            if frame.prefix.is_empty() { "" } else { ":" },
            group.names.get(name),
        ])
    }

    fn optional_name(&mut self, group: &Group<'_>, name: Option<NameId>, frame: &Frame) -> Option<NameId> {
        name.map(|name| self.name(group, name, frame))
    }

    /// A path, or the name of an unnamed colour, may meet a name that somebody
    /// wrote; the later one in the table gives way.
    fn make_names_unique(&mut self) {
        let is_flat = self.groups.len() == 1;
        let Scene { names, vertices, colors, surfaces, .. } = &mut self.scene;
        rename_duplicates(names, colors.iter_mut().map(|color| &mut color.name));
        rename_duplicates(names, surfaces.iter_mut().map(|surface| &mut surface.name));
        // Vertices of a flat file have been compared.
        if !is_flat {
            rename_duplicates(names, vertices.iter_mut().map(|vertex| &mut vertex.name));
        }
    }

    /// Comments above the first statement are the head; others go to the row
    /// of the statement they stand at.
    fn place_comments(&mut self, comments: &[CommentSpan], first_statement: u32) {
        let mut emitted = self.emitted.take().unwrap_or_default();
        emitted.sort_by_key(|&(span, item)| (span.start, item));
        for comment in comments {
            let text = String::from_utf8_lossy(comment.text.of(self.text)).into_owned();
            if comment.text.start < first_statement {
                self.scene.head.push(text);
                continue;
            }
            let (at, trailing) = item_at(self.text, &emitted, comment);
            self.scene.comments.push(Comment { text, at, trailing });
        }
        // The writer goes through rows and comments side by side.
        self.scene.comments.sort_by_key(|comment| comment.at);
    }
}

/// The statement a comment goes with.
fn item_at(text: &[u8], emitted: &[(Span, Item)], comment: &CommentSpan) -> (Item, bool) {
    let position = comment.text.start;
    let behind = emitted.partition_point(|(span, _)| span.start < position);
    if let Some(&(span, item)) = behind.checked_sub(1).and_then(|idx| emitted.get(idx)) {
        let inside = position < span.end;
        let on_its_line = comment.trailing && !text[span.end as usize..position as usize].contains(&b'\n');
        if inside || on_its_line {
            return (item, on_its_line);
        }
    }
    let next = emitted.get(behind).map_or(Item::End, |&(_, item)| item);
    (next, false)
}

/// Rows of the file that are not in the scene yet.
struct Queues {
    faces: Queue<Face>,
    wires: Queue<Wire>,
    lights: Queue<Light>,
    cameras: Queue<Camera>,
    escapes: Queue<String>,
    unknown: Queue<String>,
}

struct Queue<T> {
    rows: std::vec::IntoIter<T>,
    spans: std::vec::IntoIter<Span>,
    n_taken: usize,
}

impl<T> Queue<T> {
    fn new(rows: Rows<T>) -> Self {
        Self { rows: rows.rows.into_iter(), spans: rows.spans.into_iter(), n_taken: 0 }
    }

    fn take_up_to(&mut self, end: usize) -> (Vec<T>, Vec<Span>) {
        let count = end - self.n_taken;
        self.n_taken = end;
        if count >= self.rows.len() {
            // All that is left: a table that was not touched is moved, not copied.
            let (rows, spans) = (std::mem::take(&mut self.rows), std::mem::take(&mut self.spans));
            return (rows.collect(), spans.collect());
        }
        (self.rows.by_ref().take(count).collect(), self.spans.by_ref().take(count).collect())
    }
}

/// Appends, by moving the whole table if there is nothing before it.
fn append<T>(table: &mut Vec<T>, mut rows: Vec<T>) {
    if table.is_empty() {
        *table = rows;
    } else {
        table.append(&mut rows);
    }
}

fn rename_duplicates<'n>(names: &mut Names, ids: impl Iterator<Item = &'n mut NameId>) {
    let mut taken = UniqueNames::default();
    for id in ids {
        let name = names.get(*id).to_string();
        let unique = taken.fresh(&name);
        if unique != name {
            *id = names.add(&unique);
        }
    }
}
