//! Parses large texts in parts, on all threads.
//!
//! A text is split at line ends after a `;`. Each part is parsed as if it began between two
//! statements of the file. This is true for the first part, and for every part whose predecessor
//! ends between two statements. So if all parts are parsed to their ends without error, together
//! they are the whole text. If a split is inside a comment or a definition, or if there is any
//! other error, a part fails; then the whole text is parsed again on one thread, which gives the
//! diagnostics.

use rayon::prelude::*;
use ugscene::{BodyId, ColorId, Contours, LightMotion, NameId, Shading, ShadingId, SurfaceId, VertexId};

use crate::Options;
use crate::diagnostic::Diagnostic;
use crate::reader::{Document, read, read_part};
use crate::rows::Rows;
use crate::scope::{DefaultColor, NO_ROW, Scope, shifted};

/// The least size of a part in bytes.
const MIN_PART: usize = 1 << 19;

/// The least number of rows per thread.
const MIN_ROWS: usize = 1 << 14;

/// Parses a text, in parts if it is large and there are several threads.
pub(crate) fn read_document<'t>(
    text: &'t [u8],
    options: &Options,
    findings: &mut Vec<Diagnostic>,
) -> Document<'t> {
    let n_parts = rayon::current_num_threads().min(text.len() / MIN_PART);
    if n_parts > 1
        && let Some((document, warnings)) = read_parts(text, n_parts, options)
    {
        findings.extend(warnings);
        return document;
    }
    read(text, options, findings)
}

fn read_parts<'t>(
    text: &'t [u8],
    n_parts: usize,
    options: &Options,
) -> Option<(Document<'t>, Vec<Diagnostic>)> {
    let mut cuts: Vec<usize> = (0..=n_parts).map(|part| cut(text, part, n_parts)).collect();
    cuts.dedup();
    let read_part = |part: usize| read_part(&text[..cuts[part + 1]], cuts[part], options);
    let parts = (0..cuts.len() - 1).into_par_iter().with_max_len(1).map(read_part);
    let parts: Option<Vec<_>> = parts.collect();
    let (mut documents, warnings): (Vec<_>, Vec<_>) = parts?.into_iter().unzip();
    let scopes = documents.iter_mut().filter_map(|document| document.scopes.pop()).collect();
    let document = Document {
        scopes: vec![join(scopes)?],
        line_marks: documents.iter().flat_map(|document| document.line_marks.iter().cloned()).collect(),
        requests: documents.iter().flat_map(|document| document.requests.iter().copied()).collect(),
        first_statement: documents.iter().find_map(|document| document.first_statement),
        comments: documents.into_iter().flat_map(|document| document.comments).collect(),
        stage: None,
    };
    Some((document, warnings.concat()))
}

/// The start of part `part` of `n_parts`: after the next line that ends with `;`.
fn cut(text: &[u8], part: usize, n_parts: usize) -> usize {
    if part == 0 {
        return 0;
    }
    if part == n_parts {
        return text.len();
    }
    let from = text.len() / n_parts * part;
    let last_of = |text: &[u8]| text.trim_ascii_end().last().copied();
    // Each byte is looked at once, however long the runs of blanks are.
    let (mut last, mut line) = (last_of(&text[..from]), from);
    for end in memchr::memchr_iter(b'\n', &text[from..]).map(|idx| from + idx) {
        last = last_of(&text[line..end]).or(last);
        if last == Some(b';') {
            return end + 1;
        }
        line = end;
    }
    text.len()
}

/// Joins the tables of all parts; `None` if a name is defined twice.
fn join<'t>(mut parts: Vec<Scope<'t>>) -> Option<Scope<'t>> {
    // The order of calls relative to other rows would have to be kept; texts of this size seldom
    // have any.
    let is_plain = |part: &Scope<'_>| part.duplicates.is_empty() && part.calls.rows.is_empty();
    if !parts.iter().all(is_plain) {
        return None;
    }
    // Programs write these before all vertices, so they are in the first part, whose names keep
    // their numbers.
    let mut tables = parts.iter_mut().map(|part| {
        let Scope { mixes, color_tables, textures, emissions, .. } = part;
        let rows = (std::mem::take(mixes), std::mem::take(color_tables), std::mem::take(textures));
        (rows, std::mem::take(emissions))
    });
    let head = tables.next()?;
    if tables.any(|((mixes, tables, textures), emissions)| {
        mixes.len() + tables.len() + textures.len() + emissions.len() > 0
    }) {
        return None;
    }
    let mut file = Scope::default();
    let vertex_rows = vertices_of_parts(&mut parts, &mut file)?;
    let mut before = PrecedingRows::default();
    let mut offsets = Vec::with_capacity(parts.len());
    for part in &mut parts {
        offsets.push(PartOffsets::append(&mut file, before, part)?);
        before.add(part);
    }

    file.is_linked = true;
    ((file.mixes, file.color_tables, file.textures), file.emissions) = head;
    file.contours = join_contours(&mut parts, &file.vertex_rows, &vertex_rows);
    file.vertices = join_tables(
        &mut parts,
        &offsets,
        |part| &mut part.vertices,
        |vertex, offset| {
            vertex.name = offset.name(vertex.name);
            vertex.color = offset.color(vertex.color);
        },
    );
    file.faces = join_tables(
        &mut parts,
        &offsets,
        |part| &mut part.faces,
        |face, offset| {
            face.name = face.name.map(|name| offset.name(name));
            face.contours =
                face.contours.start + offset.first_contour..face.contours.end + offset.first_contour;
            face.color = offset.color(face.color);
            face.body = offset.body(face.body);
            face.shading = face.shading.map(|row| ShadingId::from_index(offset.first_shading + row.index()));
        },
    );
    file.wires = join_tables(
        &mut parts,
        &offsets,
        |part| &mut part.wires,
        |wire, offset| {
            wire.name = wire.name.map(|name| offset.name(name));
            wire.text = wire.text.map(|text| offset.name(text));
            wire.contours =
                wire.contours.start + offset.first_contour..wire.contours.end + offset.first_contour;
            wire.color = offset.color(wire.color);
            wire.body = offset.body(wire.body);
        },
    );
    file.lights = join_tables(
        &mut parts,
        &offsets,
        |part| &mut part.lights,
        |light, offset| {
            light.name = light.name.map(|name| offset.name(name));
            light.color = offset.color(light.color);
            if let LightMotion::Body(body) = &mut light.motion {
                *body = offset.body(*body);
            }
        },
    );
    file.cameras = join_tables(
        &mut parts,
        &offsets,
        |part| &mut part.cameras,
        |camera, offset| {
            camera.name = camera.name.map(|name| offset.name(name));
            camera.carrier = camera.carrier.map(|body| offset.body(body));
        },
    );
    file.skies = join_tables(&mut parts, &offsets, |part| &mut part.skies, |_, _| {});
    file.motions = join_tables(&mut parts, &offsets, |part| &mut part.motions, |_, _| {});
    file.colors.table = join_tables(
        &mut parts,
        &offsets,
        |part| &mut part.colors.table,
        |color, offset| {
            color.value = shifted(color.value, offset.first_sample);
        },
    );
    file.surfaces.table = join_tables(&mut parts, &offsets, |part| &mut part.surfaces.table, |_, _| {});
    file.escapes = join_tables(&mut parts, &offsets, |part| &mut part.escapes, |_, _| {});
    file.unknown = join_tables(&mut parts, &offsets, |part| &mut part.unknown, |_, _| {});
    Some(file)
}

/// Joins the vertex names and their rows. For each part except the first, returns the row in the
/// whole file, or [`NO_ROW`], for the number of each name. `None` if two vertices have the same
/// name.
fn vertices_of_parts<'t>(parts: &mut [Scope<'t>], file: &mut Scope<'t>) -> Option<Vec<Vec<u32>>> {
    let (first, others) = parts.split_first_mut()?;
    file.vertex_names = std::mem::take(&mut first.vertex_names);
    file.vertex_rows = std::mem::take(&mut first.vertex_rows);
    let mut first_row = first.vertices.len() as u32;
    let mut all_rows = Vec::with_capacity(others.len());
    for part in &mut *others {
        let numbers = file.vertex_names.enter_all(&std::mem::take(&mut part.vertex_names));
        file.vertex_rows.resize(file.vertex_names.len(), NO_ROW);
        let rows = std::mem::take(&mut part.vertex_rows);
        for (&number, row) in numbers.iter().zip(rows).filter(|(_, row)| *row != NO_ROW) {
            let before = std::mem::replace(&mut file.vertex_rows[number as usize], first_row + row);
            if before != NO_ROW {
                return None;
            }
        }
        first_row += part.vertices.len() as u32;
        all_rows.push(numbers);
    }
    // After all parts, every vertex has a row.
    for number in all_rows.iter_mut().flatten() {
        *number = file.vertex_rows[*number as usize];
    }
    file.vertex_rows.resize(file.vertex_names.len(), NO_ROW);
    Some(all_rows)
}

/// Numbers of rows in the preceding parts.
#[derive(Clone, Copy, Default)]
struct PrecedingRows {
    contours: u32,
    faces: usize,
    wires: usize,
}

impl PrecedingRows {
    fn add(&mut self, part: &Scope<'_>) {
        self.contours += part.contours.row_count();
        self.faces += part.faces.len();
        self.wires += part.wires.len();
    }
}

/// Maps rows and ids of a part to those of the whole file.
struct PartOffsets {
    first_name: usize,
    first_contour: u32,
    first_shading: usize,
    first_sample: usize,
    colors: Vec<ColorId>,
    bodies: Vec<BodyId>,
    /// True if the part's rows do not have to be changed.
    is_same: bool,
}

impl PartOffsets {
    /// Appends a part to `file`. Names of all kinds, and bodies, are moved immediately. `None` if a
    /// colour or surface is defined twice.
    fn append<'t>(file: &mut Scope<'t>, before: PrecedingRows, part: &mut Scope<'t>) -> Option<Self> {
        let first_color = file.colors.spans.len() as u32;
        let colors = file.colors.append_names(&mut part.colors)?;
        let colors: Vec<_> = colors.into_iter().map(ColorId::from_index).collect();
        let surfaces = file.surfaces.append_names(&mut part.surfaces)?;
        let bodies = file.bodies.enter_all(&part.bodies);
        let offset = Self {
            first_name: file.names.len(),
            first_contour: before.contours,
            first_shading: file.shadings.len(),
            first_sample: file.samples.len(),
            is_same: before.contours == 0
                && file.samples.is_empty()
                && (file.shadings.is_empty() || part.shadings.is_empty())
                && (file.names.len() == 0 || part.names.len() == 0)
                && colors.iter().enumerate().all(|(row, color)| color.index() == row)
                && bodies.iter().enumerate().all(|(row, body)| body.index() == row),
            colors,
            bodies,
        };
        file.defaults.extend(part.defaults.iter().map(|default| DefaultColor {
            color: first_color + default.color,
            first_face: before.faces + default.first_face,
            first_wire: before.wires + default.first_wire,
        }));
        file.names.append(std::mem::take(&mut part.names));
        file.shadings.extend(part.shadings.drain(..).map(|shading| match shading {
            Shading::Surface(name) => Shading::Surface(SurfaceId::from_index(surfaces[name.index()])),
            level => level,
        }));
        file.samples.append(&mut part.samples);
        file.n_statements += part.n_statements;
        Some(offset)
    }

    fn name(&self, name: NameId) -> NameId {
        NameId::from_index(self.first_name + name.index())
    }

    fn color(&self, color: Option<ColorId>) -> Option<ColorId> {
        color.map(|color| self.colors[color.index()])
    }

    fn body(&self, body: BodyId) -> BodyId {
        self.bodies[body.index()]
    }
}

/// Joins one table of all parts; `change` converts a row of a part to a row of the file.
fn join_tables<'t, T: Send>(
    parts: &mut [Scope<'t>],
    offsets: &[PartOffsets],
    table: impl for<'p> Fn(&'p mut Scope<'t>) -> &'p mut Rows<T>,
    change: impl Fn(&mut T, &PartOffsets) + Sync,
) -> Rows<T> {
    let (rows, spans): (Vec<_>, _) =
        parts.iter_mut().map(|part| std::mem::take(table(part)).into_parts()).unzip();
    let ends = ends(&rows);
    let mut rows = join_rows(rows);
    for (offset, range) in offsets.iter().zip(ends.windows(2)) {
        if !offset.is_same {
            let rows = &mut rows[range[0]..range[1]];
            rows.par_iter_mut().with_min_len(MIN_ROWS).for_each(|row| change(row, offset));
        }
    }
    Rows { rows, spans: join_rows(spans) }
}

/// Concatenates the rows of all parts; those of the first part are seldom copied.
fn join_rows<T>(mut parts: Vec<Vec<T>>) -> Vec<T> {
    let n_rows: usize = parts.iter().map(Vec::len).sum();
    let first = parts.iter().position(|part| !part.is_empty()).unwrap_or(0);
    let mut behind = parts.drain(first..);
    let mut rows = behind.next().unwrap_or_default();
    rows.reserve_exact(n_rows - rows.len());
    behind.for_each(|mut part| rows.append(&mut part));
    rows
}

/// The first row of each part in the file, and the end of the last part.
fn ends<T>(parts: &[Vec<T>]) -> Vec<usize> {
    let mut ends = vec![0];
    for part in parts {
        ends.push(ends[ends.len() - 1] + part.len());
    }
    ends
}

/// Joins the contours of all parts, and replaces the numbers of their corners by rows of vertices:
/// `first_rows` for the first part, `other_rows` for the others.
fn join_contours(parts: &mut [Scope<'_>], first_rows: &[u32], other_rows: &[Vec<u32>]) -> Contours {
    let (mut corners, mut contour_ends) = (Vec::new(), Vec::new());
    for part in parts {
        let (part_corners, part_ends) = part.contours.parts_mut();
        corners.push(std::mem::take(part_corners));
        contour_ends.push(std::mem::take(part_ends));
    }
    let (of_corners, of_ends) = (ends(&corners), ends(&contour_ends));
    let (mut corners, mut contour_ends) = (join_rows(corners), join_rows(contour_ends));
    for (part, (corner_range, end_range)) in of_corners.windows(2).zip(of_ends.windows(2)).enumerate() {
        let rows = part.checked_sub(1).map_or(first_rows, |other| &other_rows[other][..]);
        let corners = &mut corners[corner_range[0]..corner_range[1]];
        let corners = corners.par_iter_mut().with_min_len(MIN_ROWS);
        corners.for_each(|corner| *corner = VertexId(rows[corner.index()]));
        let first_corner = corner_range[0] as u32;
        if first_corner > 0 {
            contour_ends[end_range[0]..end_range[1]].iter_mut().for_each(|end| *end += first_corner);
        }
    }
    Contours::from_parts(corners, contour_ends)
}
