//! Large texts, read in parts on all threads.
//!
//! A text is cut at line ends behind a `;`. Each part is read as if it began
//! between two statements of the file. The first part does, and if a part ends
//! between two statements, the next one does, too; so if all parts are read to
//! their ends without an error, they are what the whole text holds. If a cut
//! falls into a comment or a definition, or if anything is wrong, then a part
//! shows it, and the whole is read again in one go, which finds the words for it.

use rayon::prelude::*;

use crate::diagnostic::Diagnostic;
use crate::group::{DefaultColor, Group, NO_ROW, Rows};
use crate::names::NameId;
use crate::numbered::NumberedNames;
use crate::reader::{Document, read, read_part};
use crate::scene::{ColorId, Contours, VelocityId, VertexId};
use crate::source::Span;

/// Bytes a part should have at least.
const MIN_PART: usize = 1 << 19;

/// Rows that a thread should have at least.
const MIN_ROWS: usize = 1 << 14;

/// Reads a text, in parts if it is large and there are threads.
pub(crate) fn read_all<'t>(text: &'t [u8], lax: bool, findings: &mut Vec<Diagnostic>) -> Document<'t> {
    let n_parts = rayon::current_num_threads().min(text.len() / MIN_PART);
    if n_parts > 1
        && let Some((document, warnings)) = read_parts(text, n_parts, lax)
    {
        findings.extend(warnings);
        return document;
    }
    read(text, lax, findings)
}

fn read_parts(text: &[u8], n_parts: usize, lax: bool) -> Option<(Document<'_>, Vec<Diagnostic>)> {
    let mut cuts: Vec<usize> = (0..=n_parts).map(|part| cut(text, part, n_parts)).collect();
    cuts.dedup();
    let parts: Option<Vec<_>> =
        cuts.par_windows(2).map(|cuts| read_part(&text[..cuts[1]], cuts[0], lax)).collect();
    let (mut documents, warnings): (Vec<_>, Vec<_>) = parts?.into_iter().unzip();
    let groups = documents.iter_mut().filter_map(|document| document.groups.pop()).collect();
    let document = Document {
        groups: vec![join(text, groups)?],
        first_statement: documents.iter().find_map(|document| document.first_statement),
        comments: documents.into_iter().flat_map(|document| document.comments).collect(),
    };
    Some((document, warnings.concat()))
}

/// Where part `part` of `n_parts` begins: behind the next line that ends in a `;`.
fn cut(text: &[u8], part: usize, n_parts: usize) -> usize {
    if part == 0 {
        return 0;
    }
    let from = text.len() / n_parts * part;
    let mut ends = memchr::memchr_iter(b'\n', &text[from..]).map(|idx| from + idx);
    let is_end = |end: &usize| text[..*end].trim_ascii_end().ends_with(b";");
    if part == n_parts { text.len() } else { ends.find(is_end).map_or(text.len(), |end| end + 1) }
}

/// The tables of all parts in one; `None` if a name is defined twice.
fn join<'t>(text: &[u8], mut parts: Vec<Group<'t>>) -> Option<Group<'t>> {
    // Calls stand between rows of all kinds; texts so large seldom have any.
    let is_plain = |part: &Group<'_>| part.duplicates.is_empty() && part.calls.rows.is_empty();
    if !parts.iter().all(is_plain) {
        return None;
    }
    let mut file = Group::new(text, Span::default(), None);
    let vertex_rows = vertices_of_parts(&mut parts, &mut file)?;
    let mut before = Before::default();
    let mut places = Vec::with_capacity(parts.len());
    for part in &mut parts {
        places.push(Place::behind(&mut file, before, part)?);
        before.add(part);
    }

    file.is_linked = true;
    file.contours = join_contours(&mut parts, &vertex_rows);
    file.vertices = join_tables(
        &mut parts,
        &places,
        |part| &mut part.vertices,
        |vertex, place| {
            vertex.name = place.name(vertex.name);
            vertex.color = place.color(vertex.color);
        },
    );
    file.faces = join_tables(
        &mut parts,
        &places,
        |part| &mut part.faces,
        |face, place| {
            face.name = face.name.map(|name| place.name(name));
            face.contours =
                face.contours.start + place.first_contour..face.contours.end + place.first_contour;
            face.color = place.color(face.color);
            face.velocity = place.velocity(face.velocity);
        },
    );
    file.wires = join_tables(
        &mut parts,
        &places,
        |part| &mut part.wires,
        |wire, place| {
            wire.name = wire.name.map(|name| place.name(name));
            wire.contours =
                wire.contours.start + place.first_contour..wire.contours.end + place.first_contour;
            wire.color = place.color(wire.color);
            wire.velocity = place.velocity(wire.velocity);
        },
    );
    file.lights = join_tables(
        &mut parts,
        &places,
        |part| &mut part.lights,
        |light, place| {
            light.name = light.name.map(|name| place.name(name));
            light.color = place.color(light.color);
            light.velocity = place.velocity(light.velocity);
        },
    );
    file.cameras = join_tables(
        &mut parts,
        &places,
        |part| &mut part.cameras,
        |camera, place| {
            camera.name = camera.name.map(|name| place.name(name));
            camera.velocity = place.velocity(camera.velocity);
        },
    );
    file.colors = join_tables(&mut parts, &places, |part| &mut part.colors, |_, _| {});
    file.escapes = join_tables(&mut parts, &places, |part| &mut part.escapes, |_, _| {});
    file.unknown = join_tables(&mut parts, &places, |part| &mut part.unknown, |_, _| {});
    Some(file)
}

/// For each part, for each number of a vertex's name, the row of the vertex in
/// the whole file, or [`NO_ROW`]. `None` if two vertices have one name.
fn vertices_of_parts<'t>(parts: &mut [Group<'t>], file: &mut Group<'t>) -> Option<Vec<Vec<u32>>> {
    file.vertex_names = std::mem::take(&mut parts[0].vertex_names);
    let mut numbers = vec![None];
    numbers.extend(parts[1..].iter().map(|part| Some(file.vertex_names.enter_all(&part.vertex_names))));
    let number_of =
        |part: usize, own: usize| numbers[part].as_ref().map_or(own, |numbers| numbers[own] as usize);

    let mut rows = std::mem::take(&mut parts[0].vertex_rows);
    rows.resize(file.vertex_names.len(), NO_ROW);
    let mut first_row = parts[0].vertices.len() as u32;
    for (idx, part) in parts.iter().enumerate().skip(1) {
        for (own, &row) in part.vertex_rows.iter().enumerate().filter(|(_, row)| **row != NO_ROW) {
            let before = std::mem::replace(&mut rows[number_of(idx, own)], first_row + row);
            if before != NO_ROW {
                return None;
            }
        }
        first_row += part.vertices.len() as u32;
    }
    let all_rows = numbers.iter().map(|numbers| match numbers {
        None => rows.clone(),
        Some(numbers) => numbers.iter().map(|&number| rows[number as usize]).collect(),
    });
    let all_rows = all_rows.collect();
    file.vertex_rows = rows;
    Some(all_rows)
}

/// Rows in the parts before one.
#[derive(Clone, Copy, Default)]
struct Before {
    contours: u32,
    faces: usize,
    wires: usize,
}

impl Before {
    fn add(&mut self, part: &Group<'_>) {
        self.contours += part.contours.row_count();
        self.faces += part.faces.len();
        self.wires += part.wires.len();
    }
}

/// Where the rows of a part come in the whole file.
struct Place {
    first_name: usize,
    first_contour: u32,
    colors: Vec<ColorId>,
    velocities: Vec<VelocityId>,
    /// Nothing in the part's rows has to change.
    is_same: bool,
}

impl Place {
    /// Behind what is in `file` already. Names, colours and velocities go there at
    /// once. `None` if a colour is defined twice.
    fn behind<'t>(file: &mut Group<'t>, before: Before, part: &mut Group<'t>) -> Option<Self> {
        let colors: Vec<_> = part.color_names.list.iter().map(|name| file.color_names.enter(name)).collect();
        let velocities: Vec<_> =
            part.velocities.list.iter().map(|&velocity| file.velocities.id(velocity)).collect();
        let place = Self {
            first_name: file.names.len(),
            first_contour: before.contours,
            is_same: before.contours == 0
                && (file.names.len() == 0 || part.names.len() == 0)
                && colors.iter().enumerate().all(|(row, color)| color.index() == row)
                && velocities.iter().enumerate().all(|(row, velocity)| velocity.index() == row),
            colors,
            velocities,
        };
        let first_color = file.color_spans.len() as u32;
        file.color_rows.resize(file.color_names.list.len(), None);
        for (row, name) in part.color_rows.iter().zip(&place.colors) {
            let Some(row) = row else { continue };
            if file.color_rows[name.index()].replace(first_color + row).is_some() {
                return None;
            }
        }
        file.color_spans.append(&mut part.color_spans);
        file.defaults.extend(part.defaults.iter().map(|default| DefaultColor {
            color: first_color + default.color,
            first_face: before.faces + default.first_face,
            first_wire: before.wires + default.first_wire,
        }));
        file.names.append(std::mem::take(&mut part.names));
        part.vertex_names = NumberedNames::default();
        file.n_statements += part.n_statements;
        Some(place)
    }

    fn name(&self, name: NameId) -> NameId {
        NameId::from_index(self.first_name + name.index())
    }

    fn color(&self, color: Option<ColorId>) -> Option<ColorId> {
        color.map(|color| self.colors[color.index()])
    }

    fn velocity(&self, velocity: Option<VelocityId>) -> Option<VelocityId> {
        velocity.map(|velocity| self.velocities[velocity.index()])
    }
}

/// One table of all parts in one; `change` makes a row of a part one of the file.
fn join_tables<'t, T: Clone + Send + Sync>(
    parts: &mut [Group<'t>],
    places: &[Place],
    table: impl for<'p> Fn(&'p mut Group<'t>) -> &'p mut Rows<T>,
    change: impl Fn(&mut T, &Place) + Send + Sync,
) -> Rows<T> {
    let (rows, spans) = parts.iter_mut().map(|part| std::mem::take(table(part)).into_parts()).unzip();
    let is_same = |part: usize| places[part].is_same;
    Rows {
        rows: join_rows(rows, is_same, |row, part| change(row, &places[part])),
        spans: join_rows(spans, |_| true, |_, _| {}),
    }
}

/// Rows of all parts in order, put together on all threads. What one part
/// holds alone is not copied, and not touched if `is_same`.
fn join_rows<T: Clone + Send + Sync>(
    mut parts: Vec<Vec<T>>,
    is_same: impl Fn(usize) -> bool,
    change: impl Fn(&mut T, usize) + Send + Sync,
) -> Vec<T> {
    let mut filled = (0..parts.len()).filter(|&part| !parts[part].is_empty());
    let first = filled.next().unwrap_or(0);
    if filled.next().is_none() {
        let mut rows = parts.swap_remove(first);
        if !is_same(first) {
            rows.par_iter_mut().with_min_len(MIN_ROWS).for_each(|row| change(row, first));
        }
        return rows;
    }
    let ends: Vec<usize> = parts
        .iter()
        .scan(0, |end, part| {
            *end += part.len();
            Some(*end)
        })
        .collect();
    let n_rows = ends[ends.len() - 1];
    let row_of = |part: &mut usize, idx: usize| {
        while idx >= ends[*part] {
            *part += 1;
        }
        let mut row = parts[*part][idx + parts[*part].len() - ends[*part]].clone();
        change(&mut row, *part);
        row
    };
    (0..n_rows).into_par_iter().with_min_len(MIN_ROWS).map_with(0, row_of).collect()
}

/// Contours of all parts, with rows of vertices for corners.
fn join_contours(parts: &mut [Group<'_>], vertex_rows: &[Vec<u32>]) -> Contours {
    let (mut corners, mut ends) = (Vec::new(), Vec::new());
    let mut first_corners = Vec::new();
    let mut first_corner = 0;
    for part in parts {
        let (part_corners, part_ends) = part.contours.parts_mut();
        first_corners.push(first_corner);
        first_corner += part_corners.len() as u32;
        corners.push(std::mem::take(part_corners));
        ends.push(std::mem::take(part_ends));
    }
    let corners = join_rows(
        corners,
        |_| false,
        |corner: &mut VertexId, part| {
            *corner = VertexId(vertex_rows[part][corner.index()]);
        },
    );
    let ends = join_rows(ends, |part| first_corners[part] == 0, |end, part| *end += first_corners[part]);
    Contours::from_parts(corners, ends)
}
