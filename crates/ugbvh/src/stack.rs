//! Nodes and blocks still to be visited.

/// A part of the hierarchy and where the ray enters its box, as one number that sorts by distance.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Entry(u64);

impl Entry {
    /// `near` is 0 or greater; the bits of such numbers are ordered like the numbers.
    #[inline(always)]
    pub fn new(near: f32, child: u32) -> Self {
        Self(u64::from(near.to_bits()) << 32 | u64::from(child))
    }

    #[inline(always)]
    pub fn child(self) -> u32 {
        self.0 as u32
    }

    /// The greatest entry with a distance of `end` or less; `end` is 0 or greater.
    #[inline(always)]
    pub fn limit(end: f32) -> Self {
        Self::new(end, u32::MAX)
    }
}

/// Entries in an array that needs no allocation. Further ones, in deep hierarchies, go to a vector;
/// the depth is bounded ([`crate::build`]), so their number is, too.
///
/// Aligned, so that clearing it takes no store across cache lines: those took a tenth of the time.
#[repr(align(64))]
pub struct Stack {
    /// The top of the stack: `n` entries of this array.
    pub first: [Entry; N_FIRST],
    pub n: usize,
    /// The entries below.
    others: Vec<Entry>,
}

/// A power of two.
pub const N_FIRST: usize = 32;

impl Stack {
    #[inline(always)]
    pub fn empty() -> Self {
        Self { first: [Entry(0); N_FIRST], n: 0, others: Vec::new() }
    }

    /// With the root, a child of row 0 at the distance 0.
    #[inline(always)]
    pub fn with_root() -> Self {
        Self { n: 1, ..Self::empty() }
    }

    #[inline(always)]
    pub fn push(&mut self, entry: Entry) {
        if self.n == N_FIRST {
            self.make_room();
        }
        self.first[self.n % N_FIRST] = entry;
        self.n += 1;
    }

    #[inline(always)]
    pub fn pop(&mut self) -> Option<Entry> {
        if self.n == 0 && !self.refill() {
            return None;
        }
        self.n -= 1;
        Some(self.first[self.n % N_FIRST])
    }

    /// Empties the array.
    #[cold]
    #[inline(never)]
    pub fn make_room(&mut self) {
        self.others.extend(&self.first[..self.n]);
        self.n = 0;
    }

    /// Fills half of the empty array, if there are other entries. Returns false if there are none.
    #[inline(always)]
    pub fn refill(&mut self) -> bool {
        !self.others.is_empty() && self.take_others()
    }

    #[cold]
    #[inline(never)]
    fn take_others(&mut self) -> bool {
        let from = self.others.len().saturating_sub(N_FIRST / 2);
        for entry in self.others.drain(from..) {
            self.first[self.n] = entry;
            self.n += 1;
        }
        true
    }
}
