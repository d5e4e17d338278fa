//! Text made in pieces on threads, and sent out in order.

use std::io::{self, Write};

/// Where text goes, with the pieces of it that wait to be sent.
///
/// While the pieces of one round are made, those of the round before are sent,
/// so no more than two rounds of text are in memory, and their buffers serve again.
pub(crate) struct ChunkedWriter<'o> {
    out: &'o mut dyn Write,
    ready: Vec<Vec<u8>>,
    /// Empty buffers of a round that was sent.
    spare: Vec<Vec<u8>>,
}

impl<'o> ChunkedWriter<'o> {
    pub(crate) fn new(out: &'o mut dyn Write) -> Self {
        Self { out, ready: Vec::new(), spare: Vec::new() }
    }

    /// Appends a small piece to what is ready.
    pub(crate) fn append(&mut self, make: impl FnOnce(&mut Vec<u8>)) {
        if self.ready.is_empty() {
            self.ready.push(Vec::new());
        }
        if let Some(piece) = self.ready.last_mut() {
            make(piece);
        }
    }

    /// Makes pieces on all threads, `make` one at a time, and sends what was ready meanwhile.
    pub(crate) fn round(
        &mut self,
        n_pieces: usize,
        make: &(dyn Fn(usize, &mut Vec<u8>) + Sync),
    ) -> io::Result<()> {
        let mut pieces = std::mem::take(&mut self.spare);
        pieces.resize_with(n_pieces, Vec::new);
        let sent = ugparallel::for_jobs_while(&mut pieces, make, || self.send());
        self.spare = std::mem::replace(&mut self.ready, pieces);
        sent
    }

    /// Sends what is ready.
    pub(crate) fn send(&mut self) -> io::Result<()> {
        for piece in &mut self.ready {
            self.out.write_all(piece)?;
            piece.clear();
        }
        Ok(())
    }
}
