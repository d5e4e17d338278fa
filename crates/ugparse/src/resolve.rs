//! Names to rows: colours, vertices and definitions of every scope, each
//! checked once, however often a definition is placed.

use rustc_hash::{FxHashMap, FxHashSet};

use crate::diagnostic::Diagnostic;
use crate::document::{CallStatement, Document, FaceStatement, Node, Repeat, Statement};
use crate::scene::{Color, ColorId, Scene, newell_normal};
use crate::source::Span;

/// Statements a scene may have after instances and arrays are placed. Each
/// takes some 200 bytes, so this is where memory of common machines ends.
const MAX_PLACED: u64 = 50_000_000;

/// Corners of all placed faces and wires; each takes 4 bytes.
const MAX_CORNERS: u64 = 500_000_000;

/// Bytes that the names of a placed scene may have together; positions of
/// names are 32-bit.
const MAX_NAME_BYTES: u64 = 2 << 30;

/// The same for the names of colours alone, paths included.
const MAX_COLOR_BYTES: usize = 1 << 29;

/// How long a chain of definitions that place each other may be; the placing
/// recurses, and this keeps it well inside the stack.
const MAX_CHAIN: usize = 200;

/// What [`resolve`] finds out, in tables beside the document's.
#[derive(Default)]
pub(crate) struct Links {
    /// For each vertex reference of the document: row of the vertex among the
    /// vertices of its group.
    pub corners: Vec<u32>,
    /// For each group, for each statement.
    pub statements: Vec<Vec<Link>>,
    /// For each group: names to put into paths, one for each call.
    pub labels: Vec<Vec<String>>,
    /// Groups hold calls (else the file is flat).
    pub has_calls: bool,
}

/// What one statement refers to.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Link {
    /// Its own colour.
    pub color: Option<ColorId>,
    /// The unnamed colour in force where it stands.
    pub default_color: Option<ColorId>,
    /// The group that a call places; the row of a call's label.
    pub call: Option<(usize, usize)>,
    /// The statement draws nothing (a degenerate face) and is left out.
    pub skipped: bool,
}

/// Resolves all names of `document`; colours go into `scene` on the way.
pub(crate) fn resolve(
    text: &[u8],
    document: &Document,
    scene: &mut Scene,
    findings: &mut Vec<Diagnostic>,
) -> Links {
    let mut resolver = Resolver {
        text,
        document,
        findings,
        colors: vec![FxHashMap::default(); document.groups.len()],
        definitions: vec![FxHashMap::default(); document.groups.len()],
        links: Links {
            corners: vec![0; document.references.len()],
            statements: document.groups.iter().map(|g| vec![Link::default(); g.statements.len()]).collect(),
            ..Links::default()
        },
    };
    resolver.declare_all(scene);
    (0..document.groups.len()).for_each(|row| resolver.link_group(row));
    resolver.check_calls();
    resolver.links
}

struct Resolver<'d, 'f> {
    text: &'d [u8],
    document: &'d Document,
    findings: &'f mut Vec<Diagnostic>,
    colors: Vec<FxHashMap<&'d [u8], (ColorId, Span)>>,
    definitions: Vec<FxHashMap<&'d [u8], (usize, Span)>>,
    links: Links,
}

impl<'d> Resolver<'d, '_> {
    /// Enters colours and definitions of all scopes, and notes which unnamed
    /// colour is in force at each statement.
    fn declare_all(&mut self, scene: &mut Scene) {
        let document = self.document;
        let mut inherited_default = vec![None; document.groups.len()];
        for (row, group) in document.groups.iter().enumerate() {
            let prefix = self.scope_prefix(row);
            let mut default_color = inherited_default[row];
            for (idx, node) in group.statements.iter().enumerate() {
                self.links.statements[row][idx].default_color = default_color;
                match &node.statement {
                    Statement::Color(color) => {
                        if scene.names.len_bytes() + prefix.len() + node.span.len() > MAX_COLOR_BYTES {
                            self.findings.push(long_color_names(node.span));
                            return;
                        }
                        let id = ColorId::from_index(scene.colors.len());
                        let own = match color.name {
                            Some(name) => {
                                self.declare_color(row, name, id);
                                String::from_utf8_lossy(name.of(self.text)).into_owned()
                            }
                            None => {
                                default_color = Some(id);
                                format!("unnamed#{}", id.0)
                            }
                        };
                        let name = scene.names.add_parts(&[&prefix, &own]);
                        scene.colors.push(Color {
                            name,
                            value: color.value,
                            translucency: color.translucency,
                        });
                    }
                    Statement::Definition(inner) => {
                        inherited_default[*inner] = default_color;
                        self.declare_definition(row, *inner);
                    }
                    _ => {}
                }
            }
        }
    }

    /// `outer:inner:` for the colours of a nested definition, empty for the file's.
    fn scope_prefix(&self, mut row: usize) -> String {
        let mut prefix = String::new();
        while let Some(parent) = self.document.groups[row].parent {
            let name = String::from_utf8_lossy(self.document.groups[row].name.of(self.text));
            prefix.insert_str(0, &format!("{name}:"));
            row = parent;
        }
        prefix
    }

    fn declare_color(&mut self, row: usize, name: Span, id: ColorId) {
        if let Some((_, first)) = self.colors[row].insert(name.of(self.text), (id, name)) {
            self.duplicate("colour", name, first);
        }
    }

    fn declare_definition(&mut self, row: usize, inner: usize) {
        let name = self.document.groups[inner].name;
        if let Some((_, first)) = self.definitions[row].insert(name.of(self.text), (inner, name)) {
            self.duplicate("definition", name, first);
        }
    }

    fn duplicate(&mut self, kind: &str, name: Span, first: Span) {
        let shown = self.show(name);
        self.findings.push(
            Diagnostic::error(name, format!("{kind} `{shown}` is defined twice"))
                .label("again here")
                .other(first, "first here")
                .help("give one of them another name"),
        );
    }

    fn show(&self, name: Span) -> String {
        String::from_utf8_lossy(name.of(self.text)).into_owned()
    }

    /// Links every statement of one group.
    fn link_group(&mut self, row: usize) {
        let document = self.document;
        let vertices = self.declare_vertices(row);
        let mut labels = Labels::new(&document.groups[row].statements);
        for (idx, node) in document.groups[row].statements.iter().enumerate() {
            let mut link = self.links.statements[row][idx];
            match &node.statement {
                Statement::Vertex(vertex) => link.color = self.color(row, vertex.color),
                Statement::Light(light) => link.color = self.color(row, light.color),
                Statement::Face(face) => {
                    link.color = self.color(row, face.color);
                    link.skipped = !self.link_contours(row, face, &vertices)
                        || self.is_degenerate(row, node, face, &vertices);
                }
                Statement::Wire(wire) => {
                    link.color = self.color(row, wire.color);
                    link.skipped = !self.link_contours(row, wire, &vertices) || self.is_short(node, wire);
                }
                Statement::Call(call) => {
                    link.color = self.color(row, call.color);
                    link.call = self
                        .definition(row, call.definition)
                        .map(|group| (group, labels.next(self.text, call)));
                    self.links.has_calls = true;
                }
                _ => {}
            }
            self.links.statements[row][idx] = link;
        }
        self.links.labels.push(labels.list);
    }

    /// Names and nodes of the vertices of a group; the row counts vertices only.
    fn declare_vertices(&mut self, row: usize) -> Vertices<'d> {
        let statements = &self.document.groups[row].statements;
        let mut vertices = Vertices { rows: FxHashMap::default(), nodes: Vec::new() };
        vertices.rows.reserve(statements.len() / 2);
        for (idx, node) in statements.iter().enumerate() {
            let Statement::Vertex(vertex) = &node.statement else { continue };
            let local = vertices.nodes.len() as u32;
            vertices.nodes.push(idx as u32);
            if let Some(first) = vertices.rows.insert(vertex.name.of(self.text), local) {
                let first = vertices.nodes[first as usize] as usize;
                if let Statement::Vertex(first) = &statements[first].statement {
                    self.duplicate("vertex", vertex.name, first.name);
                }
            }
        }
        vertices
    }

    /// A colour by name, looked up from the inner scope outwards.
    fn color(&mut self, row: usize, name: Option<Span>) -> Option<ColorId> {
        let name = name?;
        let found = self.scopes(row).find_map(|scope| self.colors[scope].get(name.of(self.text)));
        match found {
            Some(&(id, _)) => Some(id),
            None => {
                self.undefined("colour", name, "define it with a `c` or `c_rgb` statement");
                None
            }
        }
    }

    fn definition(&mut self, row: usize, name: Span) -> Option<usize> {
        let found = self.scopes(row).find_map(|scope| self.definitions[scope].get(name.of(self.text)));
        match found {
            Some(&(group, _)) => Some(group),
            None => {
                self.undefined("definition", name, "define it with `def NAME ; … end ;`");
                None
            }
        }
    }

    fn scopes(&self, row: usize) -> impl Iterator<Item = usize> + use<'d> {
        let document = self.document;
        std::iter::successors(Some(row), |&scope| document.groups[scope].parent)
    }

    fn undefined(&mut self, kind: &str, name: Span, remedy: &str) {
        let shown = self.show(name);
        self.findings.push(
            Diagnostic::error(name, format!("{kind} `{shown}` is not defined"))
                .label("used here")
                .help(remedy),
        );
    }

    /// Looks up the corners of a face or wire; false if one is missing.
    fn link_contours(&mut self, row: usize, face: &FaceStatement, vertices: &Vertices<'d>) -> bool {
        let references = self.reference_range(face);
        let mut complete = true;
        for idx in references {
            let name = self.document.references[idx];
            match vertices.rows.get(name.of(self.text)) {
                Some(&local) => self.links.corners[idx] = local,
                None => {
                    complete = false;
                    let remedy = if name.of(self.text).contains(&b':') {
                        "define it with a `v` statement: vertices of instances cannot be used outside them"
                    } else if row == 0 {
                        "define it with a `v` statement"
                    } else {
                        "define it with a `v` statement in the same `def`: vertices of the scope outside are not seen here"
                    };
                    self.undefined("vertex", name, remedy);
                }
            }
        }
        complete
    }

    /// The references of all contours of a face.
    fn reference_range(&self, face: &FaceStatement) -> std::ops::Range<usize> {
        let (first, last) = (face.contours.start, face.contours.end - 1);
        self.document.contour(first).start..self.document.contour(last).end
    }

    /// Corners of one contour.
    fn contour(&self, contour: u32) -> &[u32] {
        &self.links.corners[self.document.contour(contour)]
    }

    /// Fewer than three different vertices in a contour, or no area: warned about.
    fn is_degenerate(
        &mut self,
        row: usize,
        node: &Node,
        face: &FaceStatement,
        vertices: &Vertices<'d>,
    ) -> bool {
        let statements = &self.document.groups[row].statements;
        let position = |local: u32| match &statements[vertices.nodes[local as usize] as usize].statement {
            Statement::Vertex(vertex) => vertex.position,
            _ => glam::DVec3::ZERO,
        };
        let problem = if face.contours.clone().any(|contour| !has_three(self.contour(contour))) {
            "has a contour of fewer than 3 different vertices"
        } else {
            let outline = self.contour(face.contours.start);
            if newell_normal(outline.iter().map(|&local| position(local))) != glam::DVec3::ZERO {
                return false;
            }
            "has no area"
        };
        self.skip(node, "face", face.name, problem, "remove it, or mend its vertices");
        true
    }

    fn is_short(&mut self, node: &Node, wire: &FaceStatement) -> bool {
        if wire.contours.clone().all(|contour| self.contour(contour).len() >= 2) {
            return false;
        }
        self.skip(
            node,
            "wire",
            wire.name,
            "has a contour of fewer than 2 vertices",
            "remove it, or add a vertex",
        );
        true
    }

    fn skip(&mut self, node: &Node, kind: &str, name: Option<Span>, problem: &str, remedy: &str) {
        let shown = name.map_or(String::new(), |name| format!(" `{}`", self.show(name)));
        let span = Span { start: node.span.start, end: node.span.start + 1 };
        self.findings.push(
            Diagnostic::warning(name.unwrap_or(span), format!("{kind}{shown} {problem}"))
                .label("left out")
                .help(remedy),
        );
    }

    /// Finds definitions that place themselves, chains that are too long, and
    /// scenes that would grow without bound: before anything is placed.
    fn check_calls(&mut self) {
        let mut sizes: Vec<Option<Size>> = vec![None; self.document.groups.len()];
        // Definitions that nothing places are checked, too.
        for root in 0..sizes.len() {
            if let Err(finding) = self.measure(root, &mut sizes) {
                self.findings.push(finding);
                return;
            }
        }
        if let Some(size) = sizes[0]
            && let Some(finding) = self.too_large(size)
        {
            self.findings.push(finding);
        }
    }

    /// Sizes of `root` and of all that it places, without recursion.
    fn measure(&self, root: usize, sizes: &mut [Option<Size>]) -> Result<(), Diagnostic> {
        if sizes[root].is_some() {
            return Ok(());
        }
        let mut on_path = FxHashSet::from_iter([root]);
        // Each entry: a group and the call of its that is looked at next.
        let mut path: Vec<(usize, usize)> = vec![(root, 0)];
        while let Some(&mut (row, ref mut next)) = path.last_mut() {
            let idx = *next;
            *next += 1;
            let Some(node) = self.document.groups[row].statements.get(idx) else {
                sizes[row] = Some(self.size(row, sizes));
                on_path.remove(&row);
                path.pop();
                continue;
            };
            let (Statement::Call(call), Some((target, _))) =
                (&node.statement, self.links.statements[row][idx].call)
            else {
                continue;
            };
            if on_path.contains(&target) {
                return Err(self.recursion(call));
            }
            // The file itself is no link of the chain.
            let below = sizes[target].map_or(1, |size| size.levels);
            if path.len() - 1 + below > MAX_CHAIN {
                return Err(too_long(call));
            }
            if sizes[target].is_none() {
                on_path.insert(target);
                path.push((target, 0));
            }
        }
        Ok(())
    }

    /// What a group comes to, the groups it places included.
    fn size(&self, row: usize, sizes: &[Option<Size>]) -> Size {
        let mut total = Size::default();
        let mut largest = 0;
        for (node, link) in self.document.groups[row].statements.iter().zip(&self.links.statements[row]) {
            let own = match (&node.statement, link.call) {
                (Statement::Call(call), Some((target, label))) => {
                    let each = sizes[target].unwrap_or_default();
                    let label = &self.links.labels[row][label];
                    let own = each.placed(copies(call), label.len());
                    if own.statements > largest {
                        largest = own.statements;
                        total.largest_call = Some(call.definition);
                    }
                    own
                }
                (statement, _) => self.statement_size(statement),
            };
            total.add(&own);
        }
        total.levels += 1;
        total
    }

    /// What one statement that places nothing comes to.
    fn statement_size(&self, statement: &Statement) -> Size {
        let name = match statement {
            Statement::Vertex(vertex) => Some(vertex.name),
            Statement::Face(face) | Statement::Wire(face) => face.name,
            Statement::Light(light) => light.name,
            Statement::Camera(camera) => camera.name,
            _ => None,
        };
        let corners = match statement {
            Statement::Face(face) | Statement::Wire(face) => self.reference_range(face).len() as u64,
            _ => 0,
        };
        let name_bytes = name.map_or(0, |name| name.len() as u64);
        Size { statements: 1, corners, names: u64::from(name.is_some()), name_bytes, ..Size::default() }
    }

    fn recursion(&self, call: &CallStatement) -> Diagnostic {
        let shown = self.show(call.definition);
        Diagnostic::error(call.definition, format!("definition `{shown}` contains itself"))
            .label("placed here, inside itself")
            .help("a definition may not place itself, directly or through others")
    }

    /// The message for a scene that is too large to place.
    fn too_large(&self, size: Size) -> Option<Diagnostic> {
        let (count, limit, what) = [
            (size.statements, MAX_PLACED, "statements"),
            (size.corners, MAX_CORNERS, "corners of faces"),
            (size.name_bytes, MAX_NAME_BYTES, "bytes of names"),
        ]
        .into_iter()
        .find(|&(count, limit, _)| count > limit)?;
        let count = if count == u64::MAX { "too many".to_string() } else { count.to_string() };
        let place = size.largest_call.unwrap_or_default();
        Some(
            Diagnostic::error(place, format!("the placed scene would have {count} {what}"))
                .label("most of them from here")
                .help(format!("the limit is {limit}; use smaller arrays")),
        )
    }
}

fn long_color_names(span: Span) -> Diagnostic {
    Diagnostic::error(span, "the names of colours, with those of their definitions before them, are too long")
        .label("this one is too much")
        .help("use shorter names for definitions that hold colours")
}

fn too_long(call: &CallStatement) -> Diagnostic {
    Diagnostic::error(call.definition, "definitions place each other in too long a chain")
        .label("here")
        .help(format!("the limit is {MAX_CHAIN} levels"))
}

/// Three different entries.
fn has_three(corners: &[u32]) -> bool {
    let Some((&a, rest)) = corners.split_first() else { return false };
    let Some(&b) = rest.iter().find(|&&c| c != a) else { return false };
    rest.iter().any(|&c| c != a && c != b)
}

/// Vertices of a group by name, and the statements they are.
struct Vertices<'d> {
    rows: FxHashMap<&'d [u8], u32>,
    nodes: Vec<u32>,
}

fn copies(call: &CallStatement) -> u64 {
    match call.repeat {
        Repeat::Once => 1,
        Repeat::Times(copies, _) => copies,
    }
}

/// What a group comes to when it is placed; sums stop at the largest number.
#[derive(Clone, Copy, Default)]
struct Size {
    statements: u64,
    corners: u64,
    names: u64,
    name_bytes: u64,
    /// Length of the longest chain of groups that place each other.
    levels: usize,
    /// Where most of it comes from.
    largest_call: Option<Span>,
}

impl Size {
    /// The size of that many copies, whose names get a path with `label` in it.
    fn placed(&self, copies: u64, label: usize) -> Self {
        // The colon, and the number of a copy of an array.
        let added = label as u64 + 1 + if copies > 1 { 9 } else { 2 };
        let name_bytes = self.name_bytes.saturating_add(self.names.saturating_mul(added));
        Self {
            statements: copies.saturating_mul(self.statements.saturating_add(1)),
            corners: copies.saturating_mul(self.corners),
            names: copies.saturating_mul(self.names),
            name_bytes: copies.saturating_mul(name_bytes),
            ..*self
        }
    }

    fn add(&mut self, other: &Self) {
        self.statements = self.statements.saturating_add(other.statements);
        self.corners = self.corners.saturating_add(other.corners);
        self.names = self.names.saturating_add(other.names);
        self.name_bytes = self.name_bytes.saturating_add(other.name_bytes);
        self.levels = self.levels.max(other.levels);
    }
}

/// Names for the calls of a group, unique in it.
struct Labels {
    list: Vec<String>,
    taken: FxHashMap<String, u32>,
    only_call: bool,
}

impl Labels {
    fn new(statements: &[Node]) -> Self {
        let calls = statements.iter().filter(|node| matches!(node.statement, Statement::Call(_))).count();
        Self { list: Vec::new(), taken: FxHashMap::default(), only_call: calls == 1 }
    }

    /// The row of the next call's label: its name, else its definition's name;
    /// nothing for a nameless array that is alone, whose element number says enough.
    fn next(&mut self, text: &[u8], call: &CallStatement) -> usize {
        let is_array = matches!(call.repeat, Repeat::Times(..));
        let mut label = match call.name {
            None if is_array && self.only_call => String::new(),
            name => String::from_utf8_lossy(name.unwrap_or(call.definition).of(text)).into_owned(),
        };
        let uses = self.taken.entry(label.clone()).or_default();
        *uses += 1;
        if *uses > 1 {
            label = format!("{label}_{uses}");
        }
        self.list.push(label);
        self.list.len() - 1
    }
}
