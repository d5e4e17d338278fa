//! Puts everything in its place: a document and its links become a flat scene.

use std::collections::BTreeMap;

use glam::DVec3;
use rustc_hash::FxHashMap;

use crate::diagnostic::Diagnostic;
use crate::document::{CallStatement, CommentSpan, Document, FaceStatement, Node, Repeat, Statement};
use crate::names::{NameId, Names, UniqueNames};
use crate::resolve::{Link, Links};
use crate::scene::{
    Camera, ColorId, Comment, Face, Item, Light, LightKind, Scene, VelocityId, Vertex, VertexId, Wire,
    newell_normal,
};
use crate::source::Span;
use crate::transform::Transform;

/// Where in the text the rows of a flat scene come from.
#[derive(Clone, Debug, Default)]
pub struct Origins {
    /// For each vertex, its name in its `v` statement.
    pub vertices: Vec<Span>,
    /// For each face, its statement.
    pub faces: Vec<Span>,
}

/// Builds the flat scene; colours are in it already.
pub(crate) fn place(
    text: &[u8],
    document: &Document,
    links: &Links,
    mut scene: Scene,
    findings: &mut Vec<Diagnostic>,
) -> (Scene, Origins) {
    let colors = document.groups.iter().flat_map(|group| {
        group.statements.iter().filter(|node| matches!(node.statement, Statement::Color(_)))
    });
    let mut emitted: Vec<(Span, Item)> =
        colors.enumerate().map(|(row, node)| (node.span, Item::Color(row as u32))).collect();
    if document.comments.is_empty() {
        emitted.clear();
    }
    reserve(&mut scene, document);
    let mut placer = Placer {
        text,
        document,
        links,
        scene,
        origins: Origins::default(),
        emitted,
        placed_before: vec![false; document.groups.len()],
        velocities: FxHashMap::default(),
        trouble: None,
        flattened: BTreeMap::new(),
    };
    placer.group(0, &Frame::root());
    placer.make_names_unique();
    placer.place_comments();
    findings.extend(placer.trouble);
    findings.extend(placer.flattened.into_values());
    (placer.scene, placer.origins)
}

fn reserve(scene: &mut Scene, document: &Document) {
    let statements = &document.groups[0].statements;
    let vertices = statements.iter().filter(|node| matches!(node.statement, Statement::Vertex(_))).count();
    scene.vertices.reserve(vertices);
    scene.faces.reserve(statements.len() - vertices);
}

/// What a group inherits from the calls that place it.
struct Frame {
    transform: Transform,
    /// Path of the names made here, without the last `:`.
    prefix: String,
    color: Option<ColorId>,
    velocity: Option<VelocityId>,
    /// The file itself, which nothing places.
    is_root: bool,
}

impl Frame {
    fn root() -> Self {
        Self {
            transform: Transform::IDENTITY,
            prefix: String::new(),
            color: None,
            velocity: None,
            is_root: true,
        }
    }
}

struct Placer<'d> {
    text: &'d [u8],
    document: &'d Document,
    links: &'d Links,
    scene: Scene,
    origins: Origins,
    /// First row that each statement gave, for the comments beside it.
    emitted: Vec<(Span, Item)>,
    placed_before: Vec<bool>,
    /// Rows of `scene.velocities` by the bits of their numbers.
    velocities: FxHashMap<[u64; 3], VelocityId>,
    /// The first thing that cannot be placed.
    trouble: Option<Diagnostic>,
    /// Warnings for faces that have no area where they are placed, once for
    /// each statement, by its position.
    flattened: BTreeMap<u32, Diagnostic>,
}

impl Placer<'_> {
    fn group(&mut self, row: usize, frame: &Frame) {
        let document = self.document;
        let first_vertex = self.scene.vertices.len() as u32;
        let first_time = !std::mem::replace(&mut self.placed_before[row], true);
        // Faces may name vertices that come later, so vertices go first.
        for (node, link) in document.groups[row].statements.iter().zip(&self.links.statements[row]) {
            if let Statement::Vertex(_) = node.statement {
                self.note(first_time, node, Item::Vertex(self.scene.vertices.len() as u32));
                self.vertex(node, link, frame);
            }
        }
        for (node, link) in document.groups[row].statements.iter().zip(&self.links.statements[row]) {
            self.statement(row, node, link, frame, first_vertex, first_time);
        }
    }

    fn statement(
        &mut self,
        row: usize,
        node: &Node,
        link: &Link,
        frame: &Frame,
        first_vertex: u32,
        first_time: bool,
    ) {
        if link.skipped {
            return;
        }
        let next = |rows: usize| rows as u32;
        match &node.statement {
            Statement::Face(face) => {
                let item = Item::Face(next(self.scene.faces.len()));
                if self.face(node, face, link, frame, first_vertex) {
                    self.note(first_time, node, item);
                }
            }
            Statement::Wire(wire) => {
                self.note(first_time, node, Item::Wire(next(self.scene.wires.len())));
                self.wire(wire, link, frame, first_vertex);
            }
            Statement::Light(light) => {
                self.note(first_time, node, Item::Light(next(self.scene.lights.len())));
                let light = self.light(node, light, link, frame);
                self.scene.lights.push(light);
            }
            Statement::Camera(camera) => {
                self.note(first_time, node, Item::Camera(next(self.scene.cameras.len())));
                let mut placed = camera.placed(&frame.transform);
                placed.name = self.optional_name(camera.name, frame);
                placed.velocity = camera.velocity.map(|velocity| self.velocity(velocity));
                self.check_camera(node, &placed);
                self.scene.cameras.push(placed);
            }
            Statement::Escape(text) if first_time => {
                self.note(first_time, node, Item::Escape(next(self.scene.escapes.len())));
                self.scene.escapes.push(self.lossy(*text));
            }
            Statement::Unknown if first_time => {
                self.note(first_time, node, Item::Unknown(next(self.scene.unknown.len())));
                self.scene.unknown.push(self.lossy(node.span));
            }
            Statement::Call(call) => self.call(row, call, link, frame),
            _ => {}
        }
    }

    fn note(&mut self, first_time: bool, node: &Node, item: Item) {
        if first_time && !self.document.comments.is_empty() {
            self.emitted.push((node.span, item));
        }
    }

    fn vertex(&mut self, node: &Node, link: &Link, frame: &Frame) {
        let Statement::Vertex(vertex) = &node.statement else { return };
        let position = frame.transform.point(vertex.position);
        let name = self.name(vertex.name, frame);
        let normal = vertex.normal.map(|normal| frame.transform.normal(normal));
        self.check_finite(vertex.name, position);
        self.check_finite(vertex.name, normal.unwrap_or_default());
        self.scene.vertices.push(Vertex { name, position, color: link.color, normal });
        self.origins.vertices.push(vertex.name);
    }

    /// False if the face is left out.
    fn face(
        &mut self,
        node: &Node,
        face: &FaceStatement,
        link: &Link,
        frame: &Frame,
        first_vertex: u32,
    ) -> bool {
        if !frame.is_root && !self.has_area(node, face, first_vertex) {
            return false;
        }
        let contours = self.contours(face, frame.transform.mirrored, first_vertex);
        let name = self.optional_name(face.name, frame);
        let own = face.velocity.map(|velocity| self.velocity(velocity));
        self.scene.faces.push(Face {
            name,
            contours,
            color: link.color.or(frame.color).or(link.default_color),
            illum: face.illum,
            velocity: frame.velocity.or(own),
        });
        self.origins.faces.push(node.span);
        true
    }

    fn wire(&mut self, wire: &FaceStatement, link: &Link, frame: &Frame, first_vertex: u32) {
        let contours = self.contours(wire, false, first_vertex);
        let name = self.optional_name(wire.name, frame);
        let own = wire.velocity.map(|velocity| self.velocity(velocity));
        self.scene.wires.push(Wire {
            name,
            contours,
            color: link.color.or(frame.color).or(link.default_color),
            velocity: frame.velocity.or(own),
        });
    }

    /// Copies contours; a mirrored frame reverses their direction but keeps the first vertex.
    fn contours(&mut self, face: &FaceStatement, reversed: bool, first_vertex: u32) -> std::ops::Range<u32> {
        let rows = face.contours.clone().map(|contour| {
            let corners = &self.links.corners[self.document.contour(contour)];
            let len = corners.len();
            (0..len).map(move |idx| {
                let idx = if reversed { (len - idx) % len } else { idx };
                VertexId(first_vertex + corners[idx])
            })
        });
        self.scene.contours.push_all(rows)
    }

    /// False, with a warning, if the outline has no area where it is placed:
    /// squashed flat by `-sz 0`, or too small beside its distance.
    fn has_area(&mut self, node: &Node, face: &FaceStatement, first_vertex: u32) -> bool {
        let corners = &self.links.corners[self.document.contour(face.contours.start)];
        let position = |&local: &u32| self.scene.vertices[(first_vertex + local) as usize].position;
        if newell_normal(corners.iter().map(position)) != DVec3::ZERO {
            return true;
        }
        let span = face.name.unwrap_or(Span { start: node.span.start, end: node.span.start + 1 });
        self.flattened.entry(node.span.start).or_insert_with(|| {
            Diagnostic::warning(span, "face has no area where it is placed")
                .label("left out")
                .help("mend the transformations that place it")
        });
        false
    }

    fn light(
        &mut self,
        node: &Node,
        light: &crate::document::LightStatement,
        link: &Link,
        frame: &Frame,
    ) -> Light {
        let kind = match (light.vector, light.radius) {
            (None, _) => LightKind::Ambient,
            (Some(toward), None) => LightKind::Directional(frame.transform.direction(toward)),
            (Some(position), Some(radius)) => {
                LightKind::Local { position: frame.transform.point(position), radius }
            }
        };
        match kind {
            LightKind::Ambient => {}
            LightKind::Directional(toward) => self.check_direction(node.span, toward),
            LightKind::Local { position, .. } => self.check_finite(node.span, position),
        }
        Light {
            name: self.optional_name(light.name, frame),
            intensity: light.intensity,
            kind,
            color: link.color,
            velocity: light.velocity.map(|velocity| self.velocity(velocity)),
        }
    }

    fn check_camera(&mut self, node: &Node, placed: &Camera) {
        for point in [placed.center, placed.eye].into_iter().flatten() {
            self.check_finite(node.span, point);
        }
        placed.up.into_iter().for_each(|up| self.check_direction(node.span, up));
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

    fn velocity(&mut self, velocity: DVec3) -> VelocityId {
        // Adding 0 makes -0 the same as 0.
        let bits = (velocity + DVec3::ZERO).to_array().map(f64::to_bits);
        *self.velocities.entry(bits).or_insert_with(|| {
            let id = VelocityId::from_index(self.scene.velocities.len());
            self.scene.velocities.push(velocity);
            id
        })
    }

    fn call(&mut self, row: usize, call: &CallStatement, link: &Link, frame: &Frame) {
        let Some((target, label)) = link.call else { return };
        let own_velocity = call.velocity.map(|velocity| self.velocity(velocity));
        let label = &self.links.labels[row][label];
        let colon = if frame.prefix.is_empty() || label.is_empty() { "" } else { ":" };
        let mut inner = Frame {
            transform: call.inner.then(&frame.transform),
            prefix: format!("{}{colon}{label}", frame.prefix),
            color: link.color.or(frame.color),
            velocity: frame.velocity.or(own_velocity),
            is_root: false,
        };
        match &call.repeat {
            Repeat::Once => self.group(target, &inner),
            Repeat::Times(copies, step) => {
                let base = std::mem::take(&mut inner.prefix);
                let mut steps = call.inner;
                for copy in 0..*copies {
                    inner.prefix = format!("{base}#{copy}");
                    inner.transform = steps.then(&frame.transform);
                    self.group(target, &inner);
                    steps = steps.then(step);
                }
            }
        }
    }

    fn name(&mut self, name: Span, frame: &Frame) -> NameId {
        // Identifiers are ASCII, so nothing is lost here.
        let own = std::str::from_utf8(name.of(self.text)).unwrap_or_default();
        if frame.prefix.is_empty() {
            self.scene.names.add(own)
        } else {
            self.scene.names.add_parts(&[&frame.prefix, ":", own])
        }
    }

    fn optional_name(&mut self, name: Option<Span>, frame: &Frame) -> Option<NameId> {
        name.map(|name| self.name(name, frame))
    }

    fn lossy(&self, span: Span) -> String {
        String::from_utf8_lossy(span.of(self.text)).into_owned()
    }

    /// A path, or the name of an unnamed colour, may meet a name that somebody
    /// wrote; the later one in the table gives way.
    fn make_names_unique(&mut self) {
        let is_flat = self.document.groups.len() == 1;
        let Scene { names, vertices, colors, .. } = &mut self.scene;
        rename_duplicates(names, colors.iter_mut().map(|color| &mut color.name));
        // Vertices of a flat file have been compared.
        if !is_flat {
            rename_duplicates(names, vertices.iter_mut().map(|vertex| &mut vertex.name));
        }
    }

    /// Comments above the first statement are the head; others go to the row
    /// of the statement they stand at.
    fn place_comments(&mut self) {
        let first_statement =
            self.document.groups[0].statements.first().map_or(u32::MAX, |node| node.span.start);
        self.emitted.sort_by_key(|&(span, item)| (span.start, item));
        for comment in &self.document.comments {
            let text = String::from_utf8_lossy(comment.text.of(self.text)).into_owned();
            if comment.text.start < first_statement {
                self.scene.head.push(text);
                continue;
            }
            let (at, trailing) = self.item_at(comment);
            self.scene.comments.push(Comment { text, at, trailing });
        }
        // The writer goes through rows and comments side by side.
        self.scene.comments.sort_by_key(|comment| comment.at);
    }

    /// The statement a comment goes with.
    fn item_at(&self, comment: &CommentSpan) -> (Item, bool) {
        let position = comment.text.start;
        let behind = self.emitted.partition_point(|(span, _)| span.start < position);
        if let Some(&(span, item)) = behind.checked_sub(1).and_then(|idx| self.emitted.get(idx)) {
            let inside = position < span.end;
            let on_its_line =
                comment.trailing && !self.text[span.end as usize..position as usize].contains(&b'\n');
            if inside || on_its_line {
                return (item, on_its_line);
            }
        }
        let next = self.emitted.get(behind).map_or(Item::End, |&(_, item)| item);
        (next, false)
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
