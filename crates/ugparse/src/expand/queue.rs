//! Moves rows of the file into the scene without copying them.

use ugscene::{Camera, Face, Item, Light, Scene, Wire};

use super::Expander;
use crate::rows::Rows;
use crate::scope::Counts;
use crate::source::Span;

impl Expander<'_, '_> {
    /// Moves rows of the file up to `end`.
    pub(super) fn move_rows(&mut self, queues: &mut Queues, end: Counts) {
        let spans = self.move_some(&mut queues.faces, end.faces, |scene| &mut scene.faces, Item::Face);
        append(&mut self.origins.faces, spans);
        self.move_some(&mut queues.wires, end.wires, |scene| &mut scene.wires, Item::Wire);
        let spans = self.move_some(&mut queues.lights, end.lights, |scene| &mut scene.lights, Item::Light);
        append(&mut self.origins.lights, spans);
        let spans =
            self.move_some(&mut queues.cameras, end.cameras, |scene| &mut scene.cameras, Item::Camera);
        append(&mut self.origins.cameras, spans);
        self.move_some(&mut queues.escapes, end.escapes, |scene| &mut scene.remarks.escapes, Item::Escape);
        self.move_some(&mut queues.unknown, end.unknown, |scene| &mut scene.remarks.unknown, Item::Unknown);
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
}

/// Rows of the file that have not been moved yet.
pub(super) struct Queues {
    pub faces: Queue<Face>,
    pub wires: Queue<Wire>,
    pub lights: Queue<Light>,
    pub cameras: Queue<Camera>,
    pub escapes: Queue<String>,
    pub unknown: Queue<String>,
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

    pub fn take_up_to(&mut self, end: usize) -> (Vec<T>, Vec<Span>) {
        let count = end - self.n_taken;
        self.n_taken = end;
        if count >= self.rows.len() {
            // A table that was not touched is moved as a whole.
            let (rows, spans) = (std::mem::take(&mut self.rows), std::mem::take(&mut self.spans));
            return (rows.collect(), spans.collect());
        }
        (self.rows.by_ref().take(count).collect(), self.spans.by_ref().take(count).collect())
    }
}

/// Appends rows; moves the whole table if the destination is empty.
fn append<T>(table: &mut Vec<T>, mut rows: Vec<T>) {
    if table.is_empty() {
        *table = rows;
    } else {
        table.append(&mut rows);
    }
}
