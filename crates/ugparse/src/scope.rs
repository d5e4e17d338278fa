//! The statements of the file or of a definition, in tables with the types of a
//! [`Scene`](crate::Scene), before names are resolved.
//!
//! A colour or surface is stored as the number of its name among those of its kind, and a corner as
//! the number of its vertex's name in [`Scope::vertex_names`]. So names may be used before they are
//! defined, or be defined in an enclosing scope. [`resolve`](crate::resolve) replaces all of them
//! by rows.

use glam::DVec3;
use rustc_hash::FxHashMap;
use ugphysics::{InertialFrame, Velocity, WorldLine};
use ugscene::{
    Bodies, BodyId, Camera, Color, ColorId, ColorTable, ColorValue, Contours, Face, Light, Mix,
    NameId, Names, RoundShape, Shading, ShadingId, StatedSky, SurfaceProperties, Texture, Vertex,
    VertexId, Wire,
};

use crate::diagnostic::Diagnostic;
use crate::numbered::{Name, NumberedNames};
use crate::rows::{Named, Rows};
use crate::source::Span;
use crate::statement::{Call, Counts, MotionReference, MotionStatement};
use crate::token::{skip_statement, statement_start};

/// Lengths of short statements in bytes, `v v123 1.25 2.5 1 ;` and `f (v1 v12 v123) ;`, and of a
/// corner of the latter.
const VERTEX_BYTES: usize = 20;
const FACE_BYTES: usize = 17;
const CORNER_BYTES: usize = 5;

/// The row of a name without a vertex.
pub(crate) const NO_ROW: u32 = u32::MAX;

/// The tables of a scope, in the order of the text.
#[derive(Default)]
pub(crate) struct Scope<'t> {
    /// Name of the definition; empty for the file.
    pub name: Span,
    /// The enclosing scope.
    pub parent: Option<usize>,
    /// Names of everything except colours and surfaces.
    pub names: Names,
    pub bodies: BodyTable<'t>,
    pub motions: Rows<MotionStatement>,

    /// The spans are those of the names; see [`Scope::vertex_statement`].
    pub vertices: Rows<Vertex>,
    pub vertex_names: NumberedNames<'t>,
    /// For the number of each name, the row of its vertex, or [`NO_ROW`].
    pub vertex_rows: Vec<u32>,

    pub contours: Contours,
    /// Corners that name vertices of instances: `car:a`, `floor#3:b`.
    pub paths: Vec<PathCorner>,
    pub faces: Rows<Face>,
    pub shadings: Vec<Shading>,
    pub wires: Rows<Wire>,
    pub lights: Rows<Light>,
    pub cameras: Rows<Camera>,
    pub skies: Rows<StatedSky>,
    /// Escapes and unknown statements.
    pub passed_on: Rows<String>,

    /// Samples of spectra.
    pub samples: Vec<[f64; 2]>,
    pub colors: Named<'t, Color>,
    pub mixes: Rows<Mix>,
    pub color_tables: Rows<ColorTable>,
    pub textures: Rows<Texture>,
    pub emissions: Rows<[ColorId; 2]>,
    pub surfaces: Named<'t, SurfaceProperties>,
    /// Unnamed colours, with the first rows to which they apply.
    pub defaults: Vec<DefaultColor>,
    /// The unnamed colour in effect at the `def`: its scope, and its row there.
    pub outer_default: Option<(usize, u32)>,

    pub calls: Rows<Call>,
    /// Definitions in this scope, by name.
    pub definitions: FxHashMap<&'t [u8], (usize, Span)>,
    /// Errors for names that are defined twice.
    pub duplicates: Vec<Diagnostic>,
    /// Number of statements.
    pub n_statements: u64,
}

/// A colour without a name.
#[derive(Clone, Copy)]
pub(crate) struct DefaultColor {
    pub color: u32,
    pub first_face: usize,
    pub first_wire: usize,
}

/// A corner that names a vertex of an instance; it is [`NO_ROW`] until the instance is expanded.
#[derive(Clone, Copy)]
pub(crate) struct PathCorner {
    /// Its position among the corners of all contours of the scope.
    pub corner: usize,
    pub name: Span,
}

impl<'t> Scope<'t> {
    /// The scope of the file, with capacity for as many rows as a text of this
    /// size usually has. Reserved memory that is not used costs nothing, but growing a table copies
    /// it.
    pub fn for_text(bytes: usize) -> Self {
        Self {
            vertices: Rows::with_capacity(bytes / VERTEX_BYTES),
            faces: Rows::with_capacity(bytes / FACE_BYTES),
            contours: Contours::with_capacity(bytes / CORNER_BYTES, bytes / FACE_BYTES),
            vertex_names: NumberedNames::for_text(bytes),
            ..Self::default()
        }
    }

    /// Adds a surface. `name`, not that of `surface`, is its name.
    pub fn add_surface(
        &mut self,
        text: &'t [u8],
        span: Span,
        name: Span,
        surface: SurfaceProperties,
    ) {
        let twice = self.surfaces.push(text, Some(name), surface, span);
        self.note_duplicate("surface", name.of(text), twice);
    }

    /// Adds an escape or an unknown statement.
    pub fn pass_on(&mut self, text: &[u8], span: Span) {
        self.n_statements += 1;
        self.passed_on.push(span.lossy(text), span);
    }

    /// Adds a definition, which has its own scope.
    pub fn add_definition(&mut self, text: &'t [u8], name: Span, scope: usize) {
        self.n_statements += 1;
        let before = self.definitions.insert(name.of(text), (scope, name));
        self.note_duplicate("definition", name.of(text), before.map(|(_, first)| [name, first]));
    }

    /// Adds a vertex. `name`, not that of `vertex`, is its name.
    pub fn push_vertex(&mut self, name: Name<'t>, span: Span, vertex: Vertex) {
        let row = self.vertices.len() as u32;
        let number = self.vertex_names.enter(name) as usize;
        if number >= self.vertex_rows.len() {
            self.vertex_rows.resize(number + 1, NO_ROW);
        }
        let before = std::mem::replace(&mut self.vertex_rows[number], row);
        if before != NO_ROW {
            let places = [span, self.vertices.spans[before as usize]];
            self.note_duplicate("vertex", name.text, Some(places));
        }
        let name = self.add_name(name.text);
        self.vertices.push(Vertex { name, ..vertex }, span);
    }

    /// Adds the vertices of a round face that is given by numbers, and its contours. Vertices are
    /// named after the face, by `word`, and cannot be referred to. `place`: that of their names.
    pub fn push_round(
        &mut self,
        word: &str,
        place: Span,
        round: &RoundShape,
    ) -> std::ops::Range<u32> {
        let mut corners = round.corners().into_iter().zip(1..);
        let first = self.contours.row_count();
        for &len in round.shape.corners_of_contours() {
            for (position, at) in corners.by_ref().take(len) {
                let name = self.names.add(&format!("{word}#{at}"));
                let number = self.vertex_names.enter_unnamed() as usize;
                self.vertex_rows.resize(self.vertex_names.len(), NO_ROW);
                self.vertex_rows[number] = self.vertices.len() as u32;
                self.vertices.push(Vertex { name, ..Vertex::at(position, None) }, place);
                self.contours.push_corner(VertexId(number as u32));
            }
            self.contours.end_contour();
        }
        first..self.contours.row_count()
    }

    pub fn add_shading(&mut self, shading: Shading) -> ShadingId {
        // Consecutive faces often share one. -0 and 0 are equal, but written differently.
        let is_same = match (self.shadings.last(), shading) {
            (Some(Shading::Level(last)), Shading::Level(level)) => {
                last.to_bits() == level.to_bits()
            }
            (last, shading) => last == Some(&shading),
        };
        if !is_same {
            self.shadings.push(shading);
        }
        ShadingId::from_index(self.shadings.len() - 1)
    }

    /// Adds the samples of a colour.
    pub fn add_spectrum(&mut self, reflects: bool, samples: &[[f64; 2]]) -> ColorValue {
        let start = self.samples.len() as u32;
        self.samples.extend_from_slice(samples);
        ColorValue::Spectrum { reflects, start, end: self.samples.len() as u32 }
    }

    /// Adds a colour. `name`, not that of `color`, is its name.
    pub fn add_color(&mut self, text: &'t [u8], span: Span, name: Option<Span>, color: Color) {
        if name.is_none() {
            self.defaults.push(DefaultColor {
                color: self.colors.table.len() as u32,
                first_face: self.faces.len(),
                first_wire: self.wires.len(),
            });
        }
        let twice = self.colors.push(text, name, color, span);
        self.note_duplicate("colour", name.unwrap_or_default().of(text), twice);
    }

    /// `places`: those of the name, if it is defined twice.
    fn note_duplicate(&mut self, kind: &str, name: &[u8], places: Option<[Span; 2]>) {
        self.duplicates.extend(places.map(|places| {
            let message = format!("{kind} `{}` is defined twice", String::from_utf8_lossy(name));
            Diagnostic::again(places, message, "give one of them another name")
        }));
    }

    /// Numbers of rows in the tables that are expanded in the order of the text.
    pub fn counts(&self) -> Counts {
        Counts {
            faces: self.faces.len(),
            wires: self.wires.len(),
            lights: self.lights.len(),
            cameras: self.cameras.len(),
            passed_on: self.passed_on.len(),
        }
    }

    /// Bytes of the rows that every copy of this scope adds to a scene, with the spans that are
    /// kept, and without the text of names.
    pub fn table_bytes(&self) -> usize {
        self.vertices.len() * (size_of::<Vertex>() + size_of::<Span>())
            + self.faces.len() * (size_of::<Face>() + size_of::<Span>())
            + self.wires.len() * size_of::<Wire>()
            + self.lights.len() * size_of::<Light>()
            + self.cameras.len() * (size_of::<Camera>() + size_of::<Span>())
            + self.contours.corner_count() * size_of::<VertexId>()
            + (self.contours.len() + self.names.len()) * size_of::<u32>()
    }

    /// Adds a name to this scope's table.
    pub fn add_name(&mut self, name: &[u8]) -> NameId {
        self.names.add(as_str(name))
    }

    /// Can this name be the path of a vertex of an instance?
    pub fn may_be_path(&self, name: &[u8]) -> bool {
        name.contains(&b':') && self.calls.len() > 0
    }

    /// Is a vertex of this name defined in this scope?
    pub fn has_vertex(&self, name: &[u8]) -> bool {
        let number = self.vertex_names.get(Name::new(name));
        number.is_some_and(|number| {
            self.vertex_rows.get(number as usize).is_some_and(|&row| row != NO_ROW)
        })
    }

    /// Removes the faces and wires of these rows, which must be sorted.
    pub fn remove(&mut self, faces: &[usize], wires: &[usize]) {
        self.faces.remove(faces);
        self.wires.remove(wires);
        for DefaultColor { first_face, first_wire, .. } in &mut self.defaults {
            renumber(first_face, faces);
            renumber(first_wire, wires);
        }
        for Call { before, .. } in &mut self.calls.rows {
            renumber(&mut before.faces, faces);
            renumber(&mut before.wires, wires);
        }
    }

    /// Removes the escapes of these rows, in order.
    pub fn remove_escapes(&mut self, rows: &[usize]) {
        self.passed_on.remove(rows);
        self.calls.rows.iter_mut().for_each(|call| renumber(&mut call.before.passed_on, rows));
    }

    /// The whole statement of a vertex, from the span of its name.
    pub fn vertex_statement(text: &[u8], name: Span) -> Span {
        let start = statement_start(&text[..name.start as usize]) as u32;
        let rest = skip_statement(&text[name.end as usize..]).map_or(0, <[u8]>::len);
        Span { start, end: (text.len() - rest) as u32 }
    }

    /// The spans of all statements, in the order of the text.
    pub fn statements(&self, text: &[u8]) -> Vec<Span> {
        let vertices = self.vertices.spans.iter().map(|&name| Self::vertex_statement(text, name));
        let others = [
            &self.faces.spans,
            &self.wires.spans,
            &self.lights.spans,
            &self.cameras.spans,
            &self.motions.spans,
            &self.skies.spans,
            &self.colors.table.spans,
            &self.mixes.spans,
            &self.textures.spans,
            &self.emissions.spans,
            &self.surfaces.table.spans,
            &self.calls.spans,
            &self.passed_on.spans,
        ];
        let mut spans: Vec<Span> = vertices.chain(others.into_iter().flatten().copied()).collect();
        spans.sort();
        // The vertices of a round face have its span.
        spans.dedup();
        spans
    }
}

/// Subtracts the number of removed rows before row `first`.
fn renumber(first: &mut usize, removed: &[usize]) {
    *first -= removed.partition_point(|row| row < first);
}

/// The colour with the rows of its samples, if it has any, increased by an offset.
pub(crate) fn shifted(value: ColorValue, rows: usize) -> ColorValue {
    match value {
        ColorValue::Spectrum { reflects, start, end } => {
            ColorValue::Spectrum { reflects, start: start + rows as u32, end: end + rows as u32 }
        }
        other => other,
    }
}

/// Identifiers are ASCII.
pub(crate) fn as_str(name: &[u8]) -> &str {
    std::str::from_utf8(name).unwrap_or_default()
}

/// Bodies indexed by frame or name, each once.
#[derive(Clone, Debug, Default)]
pub(crate) struct BodyTable<'t> {
    pub bodies: Bodies,
    rows: FxHashMap<FrameBits, BodyId>,
    /// The last result for the bits of β, with the origin as reference point, because consecutive
    /// faces mostly share a body.
    last: Option<([u64; 3], BodyId)>,
    /// Bodies with a name, whose motion is not known before all statements are read, and where the
    /// name is used first.
    named: FxHashMap<&'t [u8], (BodyId, Span)>,
}

/// The bits of velocity, reference point, turn and displacement, and of its time and a stated γ.
type FrameBits = ([[u64; 3]; 4], [u64; 2]);

impl<'t> BodyTable<'t> {
    /// The body with this motion; adds it if it is new. `at`: the reference point if none is
    /// stated.
    pub fn of_reference(&mut self, text: &'t [u8], motion: MotionReference, at: DVec3) -> BodyId {
        match motion {
            MotionReference::Frame(frame) => self.moving_with(frame.about(at)),
            MotionReference::Named(name) => self.named(text, name),
        }
    }

    /// The body with this name; adds it if it is new.
    pub fn named(&mut self, text: &'t [u8], name: Span) -> BodyId {
        self.enter_name(name.of(text), name)
    }

    /// The body with this name, which is used at `span`; adds it if it is new.
    pub fn enter_name(&mut self, name: &'t [u8], span: Span) -> BodyId {
        let Self { named, bodies, .. } = self;
        named.entry(name).or_insert_with(|| (bodies.push(None, WorldLine::REST), span)).0
    }

    /// The bodies with a name, in the order of their ids, with the name where it is used first.
    pub fn names(&self) -> Vec<(BodyId, Span)> {
        let mut names: Vec<_> = self.named.values().copied().collect();
        names.sort();
        names
    }

    /// The name of each body that has one.
    pub fn name_of_each(&self) -> Vec<Option<(&'t [u8], Span)>> {
        let mut names = vec![None; self.bodies.len()];
        self.named
            .iter()
            .for_each(|(&name, &(body, span))| names[body.index()] = Some((name, span)));
        names
    }

    /// The body without a name in this frame; adds it if it is new.
    pub fn moving_with(&mut self, frame: InertialFrame) -> BodyId {
        let InertialFrame { velocity, at, turn, shift } = frame;
        let (vector, gamma) = velocity.stated();
        let times = [shift.t + 0.0, gamma.unwrap_or(0.0)].map(f64::to_bits);
        let key = ([vector, at, turn, shift.x].map(bits), times);
        let bodies = &mut self.bodies;
        *self.rows.entry(key).or_insert_with(|| bodies.push(None, WorldLine::inertial(frame)))
    }

    /// The body with this velocity in units of c and the origin as reference point; adds it if it
    /// is new. `None` if the velocity is invalid.
    pub fn moving_with_beta(&mut self, beta: DVec3) -> Option<BodyId> {
        let bits = bits(beta);
        match self.last {
            Some((last, id)) if last == bits => Some(id),
            _ => {
                let id = self.moving_with(InertialFrame::new(Velocity::from_beta(beta).ok()?));
                self.last = Some((bits, id));
                Some(id)
            }
        }
    }
}

fn bits(vector: DVec3) -> [u64; 3] {
    // Adding 0 makes -0 the same as 0.
    (vector + DVec3::ZERO).to_array().map(f64::to_bits)
}
