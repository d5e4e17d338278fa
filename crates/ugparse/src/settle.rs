//! Names to rows, when all of the text is read: colours, vertices and
//! definitions of every scope, each looked up and checked once, however often a
//! definition is placed.

use rayon::prelude::*;
use rustc_hash::{FxHashMap, FxHashSet};

use crate::diagnostic::{Diagnostic, MAX_ERRORS};
use crate::grammar::Grammar;
use crate::group::{Call, Group, NO_ROW, PathCorner, shifted};
use crate::named::Named;
use crate::names::{NameId, Names};
use crate::options::{Limit, Limits};
use crate::scene::{
    Color, ColorId, Contours, Face, Illum, Scene, Surface, SurfaceId, Vertex, VertexId, Wire, newell_normal,
};
use crate::source::Span;
use crate::statement::{CallStatement, IllumStatement, References, Repeat, Statement};
use crate::suggest::nearest;
use crate::token::word;

/// The names of colours and surfaces, paths included, may have this part of the bytes of all names.
const PART_OF_NAMES: u64 = 4;

/// Rows from which on threads are worth their start.
const MANY_ROWS: usize = 1 << 16;

/// What calls refer to.
#[derive(Default)]
pub(crate) struct Links {
    /// For each group, for each call.
    pub calls: Vec<Vec<Link>>,
    /// For each group, the row of its first colour in the scene.
    pub first_colors: Vec<usize>,
    /// Length of the longest chain of definitions that place each other.
    pub levels: usize,
}

/// What one call refers to.
pub(crate) struct Link {
    /// The group that is placed; `None` if it is not defined.
    pub target: Option<usize>,
    /// The name to put into paths.
    pub label: String,
}

/// Resolves all names of `groups`; colours go into `scene` on the way.
pub(crate) fn settle(
    text: &[u8],
    groups: &mut [Group<'_>],
    scene: &mut Scene,
    limits: &Limits,
    findings: &mut Vec<Diagnostic>,
) -> Links {
    for group in groups.iter() {
        findings.extend(group.duplicates.iter().map(|duplicate| {
            let shown = show(text, duplicate.again);
            Diagnostic::error(duplicate.again, format!("{} `{shown}` is defined twice", duplicate.kind))
                .label("again here")
                .other(duplicate.first, "first here")
                .help("give one of them another name")
        }));
    }
    let own_sizes = groups.iter().map(Group::own_size).collect();
    // The names of the file come first, so that they need not be moved.
    scene.names = std::mem::take(&mut groups[0].names);
    let firsts = match gather_named(text, groups, scene, limits) {
        Ok(firsts) => firsts,
        Err(finding) => {
            findings.push(finding);
            return Links::default();
        }
    };
    for row in 0..groups.len() {
        let colors = visible(groups, row, |group| &group.colors, &firsts.colors);
        let surfaces = visible(groups, row, |group| &group.surfaces, &firsts.surfaces);
        let group = &mut groups[row];
        let has_colors = paint(group, &colors);
        let has_surfaces = name_surfaces(group, &surfaces);
        let has_corners = link_corners(group);
        if !(has_colors && has_surfaces && has_corners) {
            Complaints { text, groups, row, findings }.about_all();
            groups[row].paths = path_corners(text, &groups[row]);
        }
        let group = &mut groups[row];
        leave_out_flat_faces(text, group, has_corners, findings);
        leave_out_short_wires(text, group, has_corners, findings);
    }
    apply_default_colors(&mut groups[0]);
    let calls = (0..groups.len()).map(|row| link_calls(text, groups, row, findings)).collect();
    let mut links = Links { calls, first_colors: firsts.colors, levels: 0 };
    match (Sizes { text, groups, own_sizes, links: &links, limits }).check_calls() {
        Ok(levels) => links.levels = levels,
        Err(finding) => findings.push(finding),
    }
    links
}

/// For each group, the row of its first colour, and of its first surface, in the scene.
#[derive(Default)]
struct Firsts {
    colors: Vec<usize>,
    surfaces: Vec<usize>,
}

/// Puts the colours and surfaces of all groups into the scene.
fn gather_named(
    text: &[u8],
    groups: &mut [Group<'_>],
    scene: &mut Scene,
    limits: &Limits,
) -> Result<Firsts, Diagnostic> {
    let mut firsts = Firsts::default();
    let mut room = limits.get(Limit::Names) / PART_OF_NAMES;
    for row in 0..groups.len() {
        firsts.colors.push(scene.colors.len());
        firsts.surfaces.push(scene.surfaces.len());
        let group = &groups[row];
        if group.colors.spans.is_empty() && group.surfaces.spans.is_empty() {
            continue;
        }
        let prefix = scope_prefix(text, groups, row);
        let group = &mut groups[row];
        let mut name = |names: &mut Names, own: &str, span: Span| {
            let taken = (prefix.len() + own.len()) as u64;
            room = room.checked_sub(taken).ok_or_else(|| long_names(span, limits))?;
            Ok::<NameId, Diagnostic>(names.add_parts(&[&prefix, own]))
        };
        let first_sample = scene.samples.len();
        scene.samples.append(&mut group.samples);
        let colors = std::mem::take(&mut group.colors.table.rows).into_iter();
        for ((color, &span), own) in colors.zip(&group.colors.table.spans).zip(&group.colors.spans) {
            let own = match own {
                Some(own) => show(text, *own),
                None => format!("unnamed#{}", scene.colors.len()),
            };
            let name = name(&mut scene.names, &own, span)?;
            scene.colors.push(Color { name, value: shifted(color.value, first_sample), ..color });
        }
        let surfaces = std::mem::take(&mut group.surfaces.table.rows).into_iter();
        for ((surface, &span), own) in
            surfaces.zip(&group.surfaces.table.spans).zip(group.surfaces.spans.iter().flatten())
        {
            let name = name(&mut scene.names, &show(text, *own), span)?;
            scene.surfaces.push(Surface { name, ..surface });
        }
    }
    Ok(firsts)
}

fn long_names(span: Span, limits: &Limits) -> Diagnostic {
    let else_do = "use shorter names for definitions that hold colours or surfaces; \
                   theirs may have a quarter of all bytes";
    Diagnostic::error(
        span,
        "the names of colours and surfaces, with those of their definitions before them, are too long",
    )
    .label("this one is too much")
    .help(limits.remedy(Limit::Names, else_do))
}

/// `outer:inner:` for the colours and surfaces of a nested definition, empty for the file's.
fn scope_prefix(text: &[u8], groups: &[Group<'_>], row: usize) -> String {
    scopes(groups, row)
        .filter(|&scope| groups[scope].parent.is_some())
        .fold(String::new(), |inner, scope| format!("{}:{inner}", show(text, groups[scope].name)))
}

/// A group and those round it, from the inner to the outer.
fn scopes<'g>(groups: &'g [Group<'_>], row: usize) -> impl Iterator<Item = usize> + use<'g> {
    std::iter::successors(Some(row), |&scope| groups[scope].parent)
}

/// For each name of a kind in a group, the row in the scene of what it means.
fn visible<'g, T: 'g>(
    groups: &'g [Group<'_>],
    row: usize,
    kind: impl Fn(&'g Group<'_>) -> &'g Named<'g, T>,
    firsts: &[usize],
) -> Vec<Option<usize>> {
    let find = |name: &&[u8]| {
        scopes(groups, row).find_map(|scope| Some(firsts[scope] + kind(&groups[scope]).row(name)?))
    };
    kind(&groups[row]).names.list.iter().map(find).collect()
}

/// Turns names of colours into colours; false if one is not defined.
fn paint(group: &mut Group<'_>, colors: &[Option<usize>]) -> bool {
    if colors.iter().enumerate().all(|(row, color)| *color == Some(row)) {
        return true;
    }
    let colors: Vec<_> = colors.iter().map(|color| color.map(ColorId::from_index)).collect();
    let paint = |color: &mut Option<ColorId>| *color = color.and_then(|name| colors[name.index()]);
    for_all(&mut group.vertices.rows, |vertex| paint(&mut vertex.color));
    for_all(&mut group.faces.rows, |face| paint(&mut face.color));
    group.wires.rows.iter_mut().for_each(|wire| paint(&mut wire.color));
    group.lights.rows.iter_mut().for_each(|light| paint(&mut light.color));
    group.calls.rows.iter_mut().for_each(|call| paint(&mut call.color));
    colors.iter().all(Option::is_some)
}

/// Turns names of surfaces into surfaces; false if one is not defined.
fn name_surfaces(group: &mut Group<'_>, surfaces: &[Option<usize>]) -> bool {
    for illum in &mut group.illums {
        if let Illum::Surface(id) = illum
            && let Some(row) = surfaces[id.index()]
        {
            *id = SurfaceId::from_index(row);
        }
    }
    surfaces.iter().all(Option::is_some)
}

/// Turns numbers of names into rows of vertices; false if a vertex is not defined.
fn link_corners(group: &mut Group<'_>) -> bool {
    let names = std::mem::take(&mut group.vertex_names);
    let mut rows = std::mem::take(&mut group.vertex_rows);
    rows.resize(names.len(), NO_ROW);
    let (corners, _) = group.contours.parts_mut();
    let in_order = rows.iter().enumerate().all(|(number, &row)| number == row as usize);
    if !group.is_linked && !in_order {
        for_all(corners, |corner| *corner = VertexId(rows[corner.index()]));
    }
    let is_complete = in_order || !corners.contains(&VertexId(NO_ROW));
    group.vertex_names = names;
    group.vertex_rows = rows;
    is_complete
}

/// The corners that name vertices of instances.
fn path_corners(text: &[u8], group: &Group<'_>) -> Vec<PathCorner> {
    let mut paths = Vec::new();
    let faces = group.faces.rows.iter().map(|face| &face.contours).zip(&group.faces.spans);
    let wires = group.wires.rows.iter().map(|wire| &wire.contours).zip(&group.wires.spans);
    let mut references = References::default();
    for (contours, &span) in faces.chain(wires) {
        let corners = group.contours.corners(contours.clone());
        if is_linked(corners) {
            continue;
        }
        read_again(text, span, &mut references);
        let first = group.contours.first_corner(contours.start);
        let places = (first..).zip(corners.iter().zip(&references.names));
        let of_instances = |name: &Span| group.may_be_path(name.of(text));
        paths.extend(
            places
                .filter(|(_, (corner, name))| corner.0 == NO_ROW && of_instances(name))
                .map(|(corner, (_, &name))| PathCorner { corner, name }),
        );
    }
    paths
}

/// On several threads if there are many.
fn for_all<T: Send>(rows: &mut [T], change: impl Fn(&mut T) + Send + Sync) {
    if rows.len() < MANY_ROWS {
        rows.iter_mut().for_each(change);
    } else {
        rows.par_iter_mut().with_min_len(MANY_ROWS / 4).for_each(change);
    }
}

/// The rows that `test` holds for, on several threads if there are many.
fn rows_where<T: Sync>(rows: &[T], test: impl Fn(&T) -> bool + Sync) -> Vec<usize> {
    let keep = |(row, value)| test(value).then_some(row);
    if rows.len() < MANY_ROWS {
        return rows.iter().enumerate().filter_map(keep).collect();
    }
    rows.par_iter().enumerate().with_min_len(MANY_ROWS / 4).filter_map(keep).collect()
}

/// Faces with fewer than three different vertices in a contour, or without area, are warned about.
fn leave_out_flat_faces(
    text: &[u8],
    group: &mut Group<'_>,
    has_corners: bool,
    findings: &mut Vec<Diagnostic>,
) {
    let is_whole = |face: &Face| has_corners || is_linked(group.contours.corners(face.contours.clone()));
    let problem = |face: &Face| flatness(&group.contours, &group.vertices.rows, face);
    let flat = rows_where(&group.faces.rows, |face| is_whole(face) && problem(face).is_some());
    for &row in &flat {
        let problem = problem(&group.faces.rows[row]).unwrap_or_default();
        let span = group.faces.spans[row];
        findings.push(left_out(text, span, "face", problem, "remove it, or mend its vertices"));
    }
    group.remove_faces(&flat);
}

fn is_linked(corners: &[VertexId]) -> bool {
    !corners.contains(&VertexId(NO_ROW))
}

/// Why a face draws nothing.
pub(crate) fn flatness(contours: &Contours, vertices: &[Vertex], face: &Face) -> Option<&'static str> {
    if !contours.iter(face.contours.clone()).all(has_three) {
        return Some("has a contour of fewer than 3 different vertices");
    }
    let outline = contours.get(face.contours.start);
    let corners = outline.iter().map(|corner| vertices[corner.index()].position);
    (newell_normal(corners) == glam::DVec3::ZERO).then_some("has no area")
}

fn leave_out_short_wires(
    text: &[u8],
    group: &mut Group<'_>,
    has_corners: bool,
    findings: &mut Vec<Diagnostic>,
) {
    let short = rows_where(&group.wires.rows, |wire| {
        let is_whole = has_corners || is_linked(group.contours.corners(wire.contours.clone()));
        is_whole && is_short(&group.contours, wire)
    });
    findings.extend(short.iter().map(|&row| short_wire(text, group.wires.spans[row])));
    group.remove_wires(&short);
}

/// True for a wire that draws nothing.
pub(crate) fn is_short(contours: &Contours, wire: &Wire) -> bool {
    contours.iter(wire.contours.clone()).any(|contour| contour.len() < 2)
}

/// What is said of it.
pub(crate) fn short_wire(text: &[u8], span: Span) -> Diagnostic {
    left_out(text, span, "wire", "has a contour of fewer than 2 vertices", "remove it, or add a vertex")
}

pub(crate) fn left_out(text: &[u8], span: Span, kind: &str, problem: &str, remedy: &str) -> Diagnostic {
    let name = face_name(text, span);
    let shown = name.map_or(String::new(), |name| format!(" `{}`", show(text, name)));
    let span = name.unwrap_or(Span { start: span.start, end: span.start + 1 });
    Diagnostic::warning(span, format!("{kind}{shown} {problem}")).label("left out").help(remedy)
}

/// Where the name of the face or wire at `span` stands.
pub(crate) fn face_name(text: &[u8], span: Span) -> Option<Span> {
    match read_again(text, span, &mut References::default()) {
        Some(Statement::Face(face) | Statement::Wire(face)) => face.name,
        _ => None,
    }
}

/// The statement at `span`, which has been read without an error before.
fn read_again(text: &[u8], span: Span, references: &mut References) -> Option<Statement> {
    let (body, keyword) = word(&text[span.start as usize..]).ok()?;
    let (_, statement) = Grammar { text }.statement(keyword, body, references)?.ok()?;
    Some(statement)
}

/// The unnamed colour in force where the faces of the file are written. Those
/// of definitions get it when they are placed, behind the colours of calls.
fn apply_default_colors(file: &mut Group<'_>) {
    let Group { defaults, faces, wires, .. } = file;
    for (idx, default) in defaults.iter().enumerate() {
        let next = defaults.get(idx + 1);
        // The file's colours are the first of the scene.
        let color = Some(ColorId::from_index(default.color as usize));
        let end = next.map_or(faces.len(), |next| next.first_face);
        for face in &mut faces.rows[default.first_face..end] {
            face.color = face.color.or(color);
        }
        let end = next.map_or(wires.len(), |next| next.first_wire);
        for wire in &mut wires.rows[default.first_wire..end] {
            wire.color = wire.color.or(color);
        }
    }
}

/// Reads the statements of a group again, and complains about every name that is not defined.
struct Complaints<'g, 't, 'f> {
    text: &'t [u8],
    groups: &'g [Group<'t>],
    row: usize,
    findings: &'f mut Vec<Diagnostic>,
}

impl Complaints<'_, '_, '_> {
    fn about_all(&mut self) {
        let mut references = References::default();
        for span in self.groups[self.row].statements(self.text) {
            match read_again(self.text, span, &mut references) {
                Some(Statement::Vertex(vertex)) => self.about_color(vertex.color),
                Some(Statement::Light(light)) => self.about_color(light.color),
                Some(Statement::Call(call)) => self.about_color(call.color),
                Some(Statement::Face(face) | Statement::Wire(face)) => {
                    self.about_color(face.color);
                    if let Some(IllumStatement::Surface(name)) = face.illum {
                        self.about_surface(name);
                    }
                    references.names.iter().for_each(|&name| self.about_vertex(name));
                }
                _ => {}
            }
        }
    }

    fn about_color(&mut self, name: Option<Span>) {
        let Some(name) = name else { return };
        if self.is_seen(name, |group| &group.colors) {
            return;
        }
        let remedy = if self.is_seen(name, |group| &group.surfaces) {
            "there is a surface of that name; on a face it stands behind the colour, so give one"
        } else {
            "define it with a `c` or `c_rgb` statement"
        };
        self.undefined("colour", name, remedy, |group| &group.colors);
    }

    fn about_surface(&mut self, name: Span) {
        if self.is_seen(name, |group| &group.surfaces) {
            return;
        }
        let remedy = if self.is_seen(name, |group| &group.colors) {
            "there is a colour of that name; a face takes one colour, and a surface behind it"
        } else {
            "define it with a `surf` statement"
        };
        self.undefined("surface", name, remedy, |group| &group.surfaces);
    }

    /// True if something of that kind and name is seen here.
    fn is_seen<T>(&self, name: Span, kind: for<'g> fn(&'g Group<'_>) -> &'g Named<'g, T>) -> bool {
        let mut scopes = scopes(self.groups, self.row);
        scopes.any(|scope| kind(&self.groups[scope]).row(name.of(self.text)).is_some())
    }

    fn undefined<T>(
        &mut self,
        kind: &str,
        name: Span,
        remedy: &str,
        of_kind: for<'g> fn(&'g Group<'_>) -> &'g Named<'g, T>,
    ) {
        let spans = scopes(self.groups, self.row).flat_map(|scope| &of_kind(&self.groups[scope]).spans);
        let names = spans.flatten().map(|span| span.of(self.text));
        let found = undefined_like(self.text, kind, name, remedy, names, self.findings.len());
        self.findings.push(found);
    }

    fn about_vertex(&mut self, name: Span) {
        let own = name.of(self.text);
        if self.groups[self.row].has_vertex(own) || self.groups[self.row].may_be_path(own) {
            return;
        }
        let remedy = if own.contains(&b':') {
            "define it with a `v` statement: nothing is placed in this scope whose vertex it could be"
        } else if self.row == 0 {
            "define it with a `v` statement"
        } else {
            "define it with a `v` statement in the same `def`: vertices of the scope outside are not seen here"
        };
        let names = self.groups[self.row].vertices.spans.iter().map(|span| span.of(self.text));
        let found = undefined_like(self.text, "vertex", name, remedy, names, self.findings.len());
        self.findings.push(found);
    }
}

pub(crate) fn undefined(text: &[u8], kind: &str, name: Span, remedy: &str) -> Diagnostic {
    Diagnostic::error(name, format!("{kind} `{}` is not defined", show(text, name)))
        .label("used here")
        .help(remedy)
}

/// The same, with a guess at what was meant, if it will be shown: there are `n_before` findings.
fn undefined_like<'n>(
    text: &[u8],
    kind: &str,
    name: Span,
    remedy: &str,
    names: impl IntoIterator<Item = &'n [u8]>,
    n_before: usize,
) -> Diagnostic {
    let guess = if n_before < MAX_ERRORS { nearest(name.of(text), names) } else { None };
    match guess {
        Some(guess) => undefined(text, kind, name, &format!("did you mean `{guess}`? if not, {remedy}")),
        None => undefined(text, kind, name, remedy),
    }
}

fn show(text: &[u8], name: Span) -> String {
    String::from_utf8_lossy(name.of(text)).into_owned()
}

/// Definitions and labels of the calls of a group.
fn link_calls(text: &[u8], groups: &[Group<'_>], row: usize, findings: &mut Vec<Diagnostic>) -> Vec<Link> {
    let calls = &groups[row].calls.rows;
    let labels = labels(text, calls);
    let links = calls.iter().zip(labels).map(|(Call { statement: call, .. }, label)| {
        let name = call.definition.of(text);
        let target = scopes(groups, row).find_map(|scope| groups[scope].definitions.get(name));
        if target.is_none() {
            let remedy = "define it with `def NAME ; … end ;`";
            let names = scopes(groups, row).flat_map(|scope| groups[scope].definitions.values());
            // The table has no order of its own.
            let mut names: Vec<&[u8]> = names.map(|(_, span)| span.of(text)).collect();
            names.sort_unstable();
            let found = undefined_like(text, "definition", call.definition, remedy, names, findings.len());
            findings.push(found);
        }
        let target = target.map(|&(group, _)| group);
        Link { target, label }
    });
    links.collect()
}

/// Measures what calls come to.
struct Sizes<'g, 't> {
    text: &'t [u8],
    groups: &'g [Group<'t>],
    own_sizes: Vec<Size>,
    links: &'g Links,
    limits: &'g Limits,
}

impl Sizes<'_, '_> {
    /// Finds definitions that place themselves, chains that are too long, and
    /// scenes that would grow without bound: before anything is placed. Gives the
    /// length of the longest chain.
    fn check_calls(&self) -> Result<usize, Diagnostic> {
        let mut sizes: Vec<Option<Size>> = vec![None; self.groups.len()];
        // Definitions that nothing places are checked, too.
        for root in 0..sizes.len() {
            self.measure(root, &mut sizes)?;
        }
        let size = sizes[0].unwrap_or_default();
        self.too_large(size).map_or(Ok(size.levels), Err)
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
            let Some(link) = self.links.calls[row].get(idx) else {
                sizes[row] = Some(self.size(row, sizes));
                on_path.remove(&row);
                path.pop();
                continue;
            };
            let Some(target) = link.target else { continue };
            let call = &self.groups[row].calls.rows[idx].statement;
            if on_path.contains(&target) {
                return Err(self.recursion(call));
            }
            // The file itself is no link of the chain.
            let below = sizes[target].map_or(1, |size| size.levels);
            if (path.len() - 1 + below) as u64 > self.limits.get(Limit::Chain) {
                return Err(self.too_long(call));
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
        let mut total = self.own_sizes[row];
        let mut largest = 0;
        for (call, link) in self.groups[row].calls.rows.iter().zip(&self.links.calls[row]) {
            let Some(target) = link.target else { continue };
            let each = sizes[target].unwrap_or_default();
            let own = each.placed(copies(&call.statement), link.label.len());
            if own.statements > largest {
                largest = own.statements;
                total.largest_call = Some(call.statement.definition);
            }
            total.add(&own);
        }
        total.levels += 1;
        total
    }

    fn recursion(&self, call: &CallStatement) -> Diagnostic {
        let shown = show(self.text, call.definition);
        Diagnostic::error(call.definition, format!("definition `{shown}` contains itself"))
            .label("placed here, inside itself")
            .help("a definition may not place itself, directly or through others")
    }

    /// The message for a scene that is too large to place.
    fn too_large(&self, size: Size) -> Option<Diagnostic> {
        let (count, limit, what) = [
            (size.statements, Limit::Statements, "statements"),
            (size.corners, Limit::Corners, "corners of faces"),
            (size.name_bytes, Limit::Names, "bytes of names"),
        ]
        .into_iter()
        .find(|&(count, limit, _)| count > self.limits.get(limit))?;
        let count = if count == u64::MAX { "too many".to_string() } else { count.to_string() };
        let finding = |place, label, else_do| {
            Diagnostic::error(place, format!("the placed scene would have {count} {what}"))
                .label(label)
                .help(self.limits.remedy(limit, else_do))
        };
        Some(match size.largest_call {
            Some(call) => finding(call, "most of them from here", "use smaller arrays"),
            None => finding(Span::default(), "", "split the scene"),
        })
    }

    fn too_long(&self, call: &CallStatement) -> Diagnostic {
        Diagnostic::error(call.definition, "definitions place each other in too long a chain")
            .label("here")
            .help(self.limits.remedy(Limit::Chain, "use fewer"))
    }
}

/// Three different entries.
pub(crate) fn has_three(corners: &[VertexId]) -> bool {
    let Some((&a, rest)) = corners.split_first() else { return false };
    let Some(&b) = rest.iter().find(|&&c| c != a) else { return false };
    rest.iter().any(|&c| c != a && c != b)
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

impl Group<'_> {
    /// What a group comes to without its calls. Faces that are left out count, too.
    fn own_size(&self) -> Size {
        let (corners, names) = (self.contours.corner_count() as u64, self.names.len() as u64);
        let name_bytes = self.names.len_bytes() as u64;
        Size { statements: self.n_statements, corners, names, name_bytes, ..Size::default() }
    }
}

/// For each call of a group its label, unique there: its name, else its definition's name;
/// nothing for a nameless array that is alone, whose element number says enough.
fn labels(text: &[u8], calls: &[Call]) -> Vec<String> {
    let wanted = |Call { statement: call, .. }: &Call| match call.name {
        None if calls.len() == 1 && matches!(call.repeat, Repeat::Times(..)) => String::new(),
        name => show(text, name.unwrap_or(call.definition)),
    };
    let wanted: Vec<String> = calls.iter().map(wanted).collect();
    // A label that was written is never given to another call.
    let mut taken: FxHashSet<String> = wanted.iter().cloned().collect();
    let mut uses: FxHashMap<&str, u64> = FxHashMap::default();
    let mut labels = Vec::with_capacity(wanted.len());
    for wanted in &wanted {
        let uses = uses.entry(wanted).or_default();
        *uses += 1;
        let mut label = wanted.clone();
        while *uses > 1 {
            label = format!("{wanted}_{uses}");
            if taken.insert(label.clone()) {
                break;
            }
            *uses += 1;
        }
        labels.push(label);
    }
    labels
}
