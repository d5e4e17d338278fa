//! The output of `ugparse count`.

use std::fmt::Write;

use glam::DVec3;
use serde_json::{Map, Value, json};
use ugscene::Scene;

use crate::cli::measure::{Edges, bodies, corner_count, thickest_face};
use crate::diagnostics::Location;
use crate::reader::{line_marks, read};
use crate::scope::Scope;
use crate::statement::Repeat;
use crate::{Options, Parsed, Source, stage_statement};

/// All statistics of a scene.
pub(crate) struct Counts<'s> {
    scene: &'s Scene,
    statements: Vec<Statements>,
    corners: usize,
    faces_with_holes: usize,
    /// The least flat face, and its thickness divided by its size.
    thickest: Option<(FaceLocation, f64)>,
    edges: Edges,
    /// The face with most edges that a neighbour traverses in the same direction, and their number.
    turned: Option<(FaceLocation, u32)>,
}

/// Numbers of statements of a kind.
struct Statements {
    kind: &'static str,
    /// In the text; those of definitions count once.
    written: usize,
    /// In the flat scene, if this kind occurs there.
    placed: Option<usize>,
}

struct FaceLocation {
    name: Option<String>,
    place: Location,
}

impl<'s> Counts<'s> {
    pub fn new(source: &Source, parsed: &'s Parsed, options: &Options) -> Self {
        let Parsed { scene, origins, .. } = parsed;
        let marks = line_marks(&source.text);
        let face_place = |row: usize| FaceLocation {
            name: scene.faces[row].name.map(|name| scene.names.get(name).to_string()),
            place: Location::new(source, &marks, origins.faces[row].start),
        };
        let edges = Edges::new(scene);
        Self {
            scene,
            statements: statements(source, parsed, options),
            corners: corner_count(scene),
            faces_with_holes: scene.faces.iter().filter(|face| face.contours.len() > 1).count(),
            thickest: thickest_face(scene).map(|(row, thickness)| (face_place(row), thickness)),
            turned: edges.turned.map(|(row, n_edges)| (face_place(row), n_edges)),
            edges,
        }
    }

    pub fn text(&self) -> String {
        let mut out = String::new();
        // Writing to a string cannot fail.
        let mut line = |label: &str, text: String| {
            let _ = writeln!(out, "{}", format!("{label:<18}{text}").trim_end());
        };
        line("", format!("{:>9} {:>9}", "written", "placed"));
        for Statements { kind, written, placed } in &self.statements {
            let placed = placed.map_or("-".to_string(), |count| count.to_string());
            line(kind, format!("{written:>9} {placed:>9}"));
        }
        line("corners of faces", format!("{:>9} {:>9}", "", self.corners));
        line("faces with holes", format!("{:>9} {:>9}", "", self.faces_with_holes));
        if let Some((low, high)) = self.scene.bounds() {
            line("box", format!("{} to {}", point(low), point(high)));
        }
        if let Some((face, thickness)) = &self.thickest {
            line("least flat face", format!("{thickness:.1e} of its size: {}", face.text()));
        }
        let Edges { opposite, same, border, crowded, .. } = &self.edges;
        line("edges", format!("{opposite} between two faces that agree which side is outside"));
        line("", format!("{same} between two faces that do not"));
        line("", format!("{border} of one face"));
        line("", format!("{crowded} of more than two"));
        if let Some((face, n_edges)) = &self.turned {
            line("turned face", format!("{}, at {n_edges} of its edges", face.text()));
        }
        let bodies = bodies(self.scene);
        for (row, (velocity, faces, wires)) in bodies.iter().enumerate() {
            let velocity =
                velocity.map_or("no velocity".to_string(), |v| format!("<{}>", point(v.beta())));
            let label =
                if row == 0 { format!("bodies {:>10} ", bodies.len()) } else { String::new() };
            line(&label, format!("{velocity}: {faces} faces, {wires} wires"));
        }
        out
    }

    pub fn json(&self) -> Value {
        let count = |of: fn(&Statements) -> Option<usize>| -> Map<String, Value> {
            let rows = self.statements.iter();
            rows.filter_map(|row| Some((row.kind.to_string(), of(row)?.into()))).collect()
        };
        let bodies = bodies(self.scene).into_iter().map(|(velocity, faces, wires)| {
            let velocity = velocity.map(|velocity| velocity.beta().to_array());
            json!({ "velocity": velocity, "faces": faces, "wires": wires })
        });
        json!({
            "written": count(|row| Some(row.written)),
            "placed": count(|row| row.placed),
            "corners": self.corners,
            "faces_with_holes": self.faces_with_holes,
            "box": self.scene.bounds().map(|(low, high)| [low.to_array(), high.to_array()]),
            "least_flat": self.thickest.as_ref().map(|(face, thickness)| {
                json!({ "thickness_over_size": thickness, "face": face.json() })
            }),
            "edges": {
                "opposite": self.edges.opposite,
                "same": self.edges.same,
                "border": self.edges.border,
                "more_than_two": self.edges.crowded,
            },
            "turned": self.turned.as_ref().map(|(face, n_edges)| {
                json!({ "edges": n_edges, "face": face.json() })
            }),
            "bodies": bodies.collect::<Value>(),
        })
    }
}

impl FaceLocation {
    fn text(&self) -> String {
        let Location { file, line, .. } = &self.place;
        match &self.name {
            Some(name) => format!("`{name}`, {file}:{line}"),
            None => format!("{file}:{line}"),
        }
    }

    fn json(&self) -> Value {
        json!({ "name": self.name, "file": self.place.file, "line": self.place.line })
    }
}

fn point(p: DVec3) -> String {
    format!("{} {} {}", p.x, p.y, p.z)
}

/// Numbers of statements by kind. The text is parsed again, because expansion consumes its tables.
fn statements(source: &Source, parsed: &Parsed, options: &Options) -> Vec<Statements> {
    let Parsed { scene, passed_on, .. } = parsed;
    let mut document = read(&source.text, options, &mut Vec::new());
    stage_statement::take(&source.text, &mut document, &mut Vec::new());
    let written = |count: fn(&Scope<'_>) -> usize| document.scopes.iter().map(count).sum();
    let row = |kind, count: fn(&Scope<'_>) -> usize, placed| Statements {
        kind,
        written: written(count),
        placed,
    };
    let n_labels = scene.labels().count();
    let n_escapes = escape_count(&passed_on.statements);
    let n_unknown = passed_on.statements.len() - n_escapes;
    vec![
        row("colours", |scope| scope.colors.table.len(), Some(scene.colors.len())),
        row("surfaces", |scope| scope.surfaces.table.len(), Some(scene.surfaces.len())),
        row("vertices", |scope| scope.vertices.len(), Some(scene.vertices.len())),
        row("faces", |scope| scope.faces.len(), Some(scene.faces.len())),
        row(
            "wires",
            |scope| scope.wires.len() - label_count(scope),
            Some(scene.wires.len() - n_labels),
        ),
        row("labels", label_count, Some(n_labels)),
        row("lights", |scope| scope.lights.len(), Some(scene.lights.len())),
        row("cameras", |scope| scope.cameras.len(), Some(scene.cameras.len())),
        row("escapes", |scope| escape_count(&scope.passed_on.rows), Some(n_escapes)),
        row(
            "unknown",
            |scope| scope.passed_on.len() - escape_count(&scope.passed_on.rows),
            Some(n_unknown),
        ),
        row("definitions", |scope| scope.definitions.len(), None),
        row("instances", |scope| scope.calls.len() - array_count(scope), None),
        row("arrays", array_count, None),
    ]
}

fn label_count(scope: &Scope<'_>) -> usize {
    scope.wires.rows.iter().filter(|wire| wire.text.is_some()).count()
}

fn escape_count(passed_on: &[String]) -> usize {
    passed_on.iter().filter(|text| text.starts_with('(')).count()
}

fn array_count(scope: &Scope<'_>) -> usize {
    let is_array = |repeat: &Repeat| matches!(repeat, Repeat::Times(..));
    scope.calls.rows.iter().filter(|call| is_array(&call.repeat)).count()
}
