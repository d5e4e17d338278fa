//! Writes a [`Scene`] as text: one statement per line, with numbers that read back to the same
//! bits.

use std::io::{self, Write};

use ugscene::{BodyId, ColorId, MotionPath, Scene};

use crate::chunked_writer::ChunkedWriter;
use crate::passed_on::{Comment, Item, PassedOn};
use crate::row_writer::{RowWriter, WriteRow};
use crate::stage_statement;
use crate::statements::{Along, write_color, write_motion, write_times};

/// Number of rows per piece of text.
const BLOCK_ROWS: usize = 1 << 11;

/// Pieces per thread and round: enough to balance the load, few enough to save memory.
const BLOCKS_PER_THREAD: usize = 4;

/// The text of a scene to which nothing is [passed on](PassedOn), see [`write_with`].
pub fn write(scene: &Scene) -> Vec<u8> {
    write_with(scene, &PassedOn::default())
}

/// The text of a scene: head comments, the stage, then escapes and unknown statements,
/// colours, surfaces, motions, vertices, faces, wires, lights, cameras, each with its comments.
pub fn write_with(scene: &Scene, passed_on: &PassedOn) -> Vec<u8> {
    let mut text = Vec::with_capacity(64 * (scene.vertices.len() + scene.faces.len()) + 1024);
    write_to(scene, passed_on, &mut text).expect("memory takes all that is written to it");
    text
}

/// Writes the same text as [`write_with`] to `out` while it is formatted on all threads, which needs
/// less memory. The bytes do not depend on the number of threads.
///
/// Returns the number of bytes.
///
/// # Errors
/// Errors that `out` returns; it may have received a part of the text.
pub fn write_to(scene: &Scene, passed_on: &PassedOn, out: &mut dyn Write) -> io::Result<usize> {
    let motions: Vec<BodyId> = scene.bodies.stated_by_name().collect();
    let comments = &passed_on.comments_in(scene);
    Tables {
        scene,
        passed_on,
        motions: &motions,
        chunked_writer: ChunkedWriter::new(out),
        comments,
    }
    .send()
}

/// Writes the tables of a scene.
struct Tables<'s, 'o> {
    scene: &'s Scene,
    passed_on: &'s PassedOn,
    /// The bodies whose motions have statements.
    motions: &'s [BodyId],
    chunked_writer: ChunkedWriter<'o>,
    /// Comments not yet assigned to a block, sorted by statement.
    comments: &'s [(Item, &'s Comment)],
}

impl<'s> Tables<'s, '_> {
    fn send(mut self) -> io::Result<usize> {
        let scene = self.scene;
        for text in &scene.head.comments {
            self.chunked_writer.append(|out| write_comment(text, "\n", out));
        }
        let stage = Some(&scene.stage).filter(|stage| !stage.is_at_rest());
        self.rows(
            stage.map_or(&[], std::slice::from_ref),
            |_| Item::Stage,
            stage_statement::write,
        )?;
        self.statements(scene.sky.as_slice(), |_| Item::Stage)?;
        let passed_on = &self.passed_on.statements;
        self.rows(passed_on, Item::PassedOn, |text, out| out.text(text))?;
        self.rows(&scene.colors, Item::Color, |color, out| {
            match scene.table_of(ColorId::from_index(out.row as usize)) {
                Some(table) => write_times(table, out),
                None => write_color(color, out),
            }
            out.text(";");
        })?;
        self.statements(&scene.mixes, Item::Mix)?;
        self.rows(&scene.textures, Item::Texture, |texture, out| {
            // A picture inside a mesh from standard input has no name.
            if texture.image.file.is_some() {
                texture.write(out);
                out.text(";");
            }
        })?;
        self.statements(&scene.emissions, Item::Emission)?;
        self.statements(&scene.surfaces, Item::Surface)?;
        let mut along = Along::default();
        for &body in self.motions {
            if let Some(MotionPath::Along(path)) =
                scene.bodies.statement(body).map(|motion| &motion.path)
            {
                along.entry(path.address()).or_insert(body);
            }
        }
        self.rows(self.motions, Item::Motion, |&body, out| {
            write_motion(body, &along, out);
            out.text(";");
        })?;
        self.statements(&scene.vertices, Item::Vertex)?;
        self.statements(&scene.faces, Item::Face)?;
        self.statements(&scene.wires, Item::Wire)?;
        self.statements(&scene.lights, Item::Light)?;
        self.statements(&scene.cameras, Item::Camera)?;
        for (_, comment) in self.comments {
            self.chunked_writer.append(|out| write_comment(&comment.text, "\n", out));
        }
        self.chunked_writer.send()?;
        Ok(self.chunked_writer.n_sent)
    }

    /// Writes a statement per row.
    fn statements(
        &mut self,
        rows: &'s [impl WriteRow + Sync],
        item: fn(u32) -> Item,
    ) -> io::Result<()> {
        self.rows(rows, item, |row, out| {
            row.write(out);
            out.text(";");
        })
    }

    /// Writes one line per row, in blocks on all threads.
    fn rows<T: Sync>(
        &mut self,
        rows: &'s [T],
        item: fn(u32) -> Item,
        line: impl Fn(&'s T, &mut RowWriter<'s>) + Sync,
    ) -> io::Result<()> {
        let scene = self.scene;
        let write = |block: &Block<'s, T>, out: &mut Vec<u8>| {
            let mut writer = RowWriter::new(scene, std::mem::take(out));
            block.write(&mut writer, item, &line);
            *out = writer.out;
        };
        let blocks: Vec<Block<'s, T>> = rows
            .chunks(BLOCK_ROWS)
            .enumerate()
            .map(|(idx, rows)| self.take_block(idx * BLOCK_ROWS, rows, item))
            .collect();
        for round in blocks.chunks(BLOCKS_PER_THREAD * rayon::current_num_threads()) {
            match round {
                // Waking a thread would take longer than formatting a small table.
                [block] => self.chunked_writer.append(|out| write(block, out)),
                _ => self.chunked_writer.round(round.len(), &|idx, out| write(&round[idx], out))?,
            }
        }
        Ok(())
    }

    /// A block of rows with the comments that belong to them.
    fn take_block<T>(
        &mut self,
        first: usize,
        rows: &'s [T],
        item: fn(u32) -> Item,
    ) -> Block<'s, T> {
        let last = item((first + rows.len() - 1) as u32);
        let (comments, rest) =
            self.comments.split_at(self.comments.partition_point(|(at, _)| *at <= last));
        self.comments = rest;
        Block { first, rows, comments }
    }
}

/// Consecutive rows of a table.
struct Block<'s, T> {
    /// Row in the table.
    first: usize,
    rows: &'s [T],
    comments: &'s [(Item, &'s Comment)],
}

impl<'s, T> Block<'s, T> {
    /// Writes one line per row, with the comments above and after it.
    fn write(
        &self,
        out: &mut RowWriter<'s>,
        item: fn(u32) -> Item,
        line: impl Fn(&'s T, &mut RowWriter<'s>),
    ) {
        let mut comments = self.comments;
        for (row, idx) in self.rows.iter().zip(self.first..) {
            out.row = idx as u32;
            if comments.is_empty() {
                line(row, out);
            } else {
                let item = item(out.row);
                // A comment of a missing row must not block the others.
                while let Some(((at, comment), rest)) = comments.split_first()
                    && (*at < item || *at == item && !comment.trailing)
                {
                    write_comment(&comment.text, "\n", &mut out.out);
                    comments = rest;
                }
                line(row, out);
                while let Some(((at, comment), rest)) = comments.split_first()
                    && *at == item
                {
                    out.text(" ");
                    write_comment(&comment.text, "", &mut out.out);
                    comments = rest;
                }
            }
            out.out.push(b'\n');
        }
    }
}

fn write_comment(text: &str, end: &str, out: &mut Vec<u8>) {
    for part in ["{", text, "}", end] {
        out.extend_from_slice(part.as_bytes());
    }
}
