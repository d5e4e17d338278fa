//! Writes text that is formatted in pieces on several threads.

use std::io::{self, Write};

use rayon::prelude::*;

/// An output stream with the pieces that wait to be sent.
///
/// While the pieces of one round are formatted, those of the round before are sent. So at most two
/// rounds of text are in memory, and their buffers are reused.
pub(crate) struct ChunkedWriter<'o> {
    out: &'o mut dyn Write,
    ready: Vec<Vec<u8>>,
    /// Empty buffers, for reuse.
    spare: Vec<Vec<u8>>,
    /// Bytes that were sent.
    pub(crate) n_sent: usize,
}

impl<'o> ChunkedWriter<'o> {
    pub(crate) fn new(out: &'o mut dyn Write) -> Self {
        Self { out, ready: Vec::new(), spare: Vec::new(), n_sent: 0 }
    }

    /// Appends text to the last piece that waits to be sent.
    pub(crate) fn append(&mut self, make: impl FnOnce(&mut Vec<u8>)) {
        if self.ready.is_empty() {
            self.ready.push(Vec::new());
        }
        if let Some(piece) = self.ready.last_mut() {
            make(piece);
        }
    }

    /// Formats pieces with `make` on all threads, and meanwhile sends those that are ready.
    pub(crate) fn round(
        &mut self,
        n_pieces: usize,
        make: &(dyn Fn(usize, &mut Vec<u8>) + Sync),
    ) -> io::Result<()> {
        let mut pieces = std::mem::take(&mut self.spare);
        pieces.resize_with(n_pieces, Vec::new);
        let sent = rayon::in_place_scope(|scope| {
            let jobs = pieces.par_iter_mut().with_max_len(1).enumerate();
            scope.spawn(|_| jobs.for_each(|(idx, piece)| make(idx, piece)));
            self.send()
        });
        self.spare = std::mem::replace(&mut self.ready, pieces);
        sent
    }

    /// Sends the pieces that are ready.
    pub(crate) fn send(&mut self) -> io::Result<()> {
        for piece in &mut self.ready {
            self.out.write_all(piece)?;
            self.n_sent += piece.len();
            piece.clear();
        }
        Ok(())
    }
}
