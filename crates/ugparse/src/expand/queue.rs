//! Moves rows of the file into the scene without copying them.

use ugscene::{Camera, Face, Light, Wire};

use super::Expander;
use crate::rows::Rows;
use crate::source::Span;
use crate::statement::Counts;

impl Expander<'_, '_> {
    /// Moves rows of the file up to `end`.
    pub(super) fn move_rows(&mut self, queues: &mut Queues, end: Counts) {
        let Self { scene, origins, passed_on, .. } = self;
        queues.faces.move_up_to(end.faces, &mut scene.faces, &mut origins.faces);
        queues.wires.move_up_to(end.wires, &mut scene.wires, &mut origins.wires);
        queues.lights.move_up_to(end.lights, &mut scene.lights, &mut origins.lights);
        queues.cameras.move_up_to(end.cameras, &mut scene.cameras, &mut origins.cameras);
        queues.passed_on.move_up_to(
            end.passed_on,
            &mut passed_on.statements,
            &mut origins.passed_on,
        );
    }
}

/// Rows of the file that have not been moved yet.
pub(super) struct Queues {
    pub faces: Queue<Face>,
    pub wires: Queue<Wire>,
    pub lights: Queue<Light>,
    pub cameras: Queue<Camera>,
    pub passed_on: Queue<String>,
}

pub(super) struct Queue<T> {
    pub rows: std::vec::IntoIter<T>,
    pub spans: std::vec::IntoIter<Span>,
    pub n_taken: usize,
}

impl<T> Queue<T> {
    pub fn new(rows: Rows<T>) -> Self {
        Self { rows: rows.rows.into_iter(), spans: rows.spans.into_iter(), n_taken: 0 }
    }

    fn move_up_to(&mut self, end: usize, rows: &mut Vec<T>, spans: &mut Vec<Span>) {
        let count = end - std::mem::replace(&mut self.n_taken, end);
        append(rows, &mut self.rows, count);
        append(spans, &mut self.spans, count);
    }
}

/// Appends rows; moves the whole table if the destination is empty.
fn append<T>(table: &mut Vec<T>, rows: &mut std::vec::IntoIter<T>, count: usize) {
    if table.is_empty() && count >= rows.len() {
        *table = std::mem::take(rows).collect();
    } else {
        table.extend(rows.by_ref().take(count));
    }
}
