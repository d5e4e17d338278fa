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
    first: [Entry; N_FIRST],
    n: usize,
    others: Vec<Entry>,
}

/// A power of two.
const N_FIRST: usize = 32;

impl Stack {
    #[inline(always)]
    pub fn new() -> Self {
        Self { first: [Entry(0); N_FIRST], n: 0, others: Vec::new() }
    }

    #[inline(always)]
    pub fn push(&mut self, entry: Entry) {
        if self.n < N_FIRST {
            self.first[self.n] = entry;
        } else {
            self.push_other(entry);
        }
        self.n += 1;
    }

    #[cold]
    #[inline(never)]
    fn push_other(&mut self, entry: Entry) {
        self.others.push(entry);
    }

    #[inline(always)]
    pub fn pop(&mut self) -> Option<Entry> {
        self.n = self.n.checked_sub(1)?;
        if self.n < N_FIRST { Some(self.first[self.n]) } else { self.others.pop() }
    }
}
