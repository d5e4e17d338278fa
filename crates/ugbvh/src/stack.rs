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
    pub fn near(self) -> f32 {
        f32::from_bits((self.0 >> 32) as u32)
    }

    #[inline(always)]
    pub fn child(self) -> u32 {
        self.0 as u32
    }
}

/// Entries in an array that needs no allocation. Further ones, in deep hierarchies, go to a vector;
/// the depth is bounded ([`crate::build`]), so their number is, too.
pub struct Stack {
    near: [Entry; N_NEAR],
    n: usize,
    spilt: Vec<Entry>,
}

const N_NEAR: usize = 64;

impl Stack {
    #[inline(always)]
    pub fn new() -> Self {
        Self { near: [Entry(0); N_NEAR], n: 0, spilt: Vec::new() }
    }

    #[inline(always)]
    pub fn push(&mut self, entry: Entry) {
        if let Some(place) = self.near.get_mut(self.n) {
            *place = entry;
            self.n += 1;
        } else {
            self.spill(entry);
        }
    }

    #[cold]
    fn spill(&mut self, entry: Entry) {
        self.spilt.push(entry);
    }

    #[inline(always)]
    pub fn pop(&mut self) -> Option<Entry> {
        if self.n == N_NEAR
            && let Some(entry) = self.spilt.pop()
        {
            return Some(entry);
        }
        self.n = self.n.checked_sub(1)?;
        Some(self.near[self.n])
    }
}
