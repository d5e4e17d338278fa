//! Meshes around the eye (`mesh` boxes).

use std::collections::BTreeMap;

/// Triangles around the eye, each of which shows a part of the frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SurroundMesh {
    /// x to the right, y up and z backwards, then the place in the frame: across and up, 0 to 1.
    pub vertices: Vec<[f32; 5]>,
    /// Rows of vertices, counterclockwise as the eye sees them.
    pub triangles: Vec<[u32; 3]>,
}

impl SurroundMesh {
    /// The content of a `mesh` box: each number once, then differences of indices, in as many bits
    /// as the largest can need.
    pub(super) fn packed(&self) -> Vec<u8> {
        let mut numbers = Vec::new();
        let mut rows = BTreeMap::new();
        let indices: Vec<u32> = self
            .vertices
            .as_flattened()
            .iter()
            .map(|number| {
                *rows.entry(number.to_bits()).or_insert_with(|| {
                    numbers.push(*number);
                    numbers.len() as u32 - 1
                })
            })
            .collect();
        let mut bits = Bits::default();
        bits.push(numbers.len() as u32, 32);
        numbers.iter().for_each(|number| bits.push(number.to_bits(), 32));
        bits.push(self.vertices.len() as u32, 32);
        let mut last = [0; 5];
        for vertex in indices.as_chunks::<5>().0 {
            for (last, &index) in last.iter_mut().zip(vertex) {
                bits.push(difference(last, index), width_of(numbers.len()));
            }
        }
        bits.fill_byte();
        // One list, of the frame of the film (0), of triangles (0).
        bits.push(1, 32);
        bits.push(0, 16);
        bits.push(3 * self.triangles.len() as u32, 32);
        let mut last = 0;
        for &index in self.triangles.as_flattened() {
            bits.push(difference(&mut last, index), width_of(self.vertices.len()));
        }
        bits.fill_byte();
        bits.bytes
    }
}

/// ⌈log₂ 2n⌉: bits of a difference of two of n indices.
fn width_of(n: usize) -> u32 {
    (2 * n).next_power_of_two().trailing_zeros()
}

/// The difference to the last index, positive ones even and negative ones odd.
fn difference(last: &mut u32, index: u32) -> u32 {
    let step = i64::from(index) - i64::from(*last);
    *last = index;
    (if step < 0 { -2 * step - 1 } else { 2 * step }) as u32
}

/// Numbers one after the other, their highest bits first.
#[derive(Default)]
struct Bits {
    bytes: Vec<u8>,
    /// Bits of the last byte that are used; 0 if all are.
    n_used: u32,
}

impl Bits {
    fn push(&mut self, number: u32, width: u32) {
        for bit in (0..width).rev() {
            if self.n_used == 0 {
                self.bytes.push(0);
            }
            if let Some(byte) = self.bytes.last_mut() {
                *byte |= ((number >> bit & 1) as u8) << (7 - self.n_used);
            }
            self.n_used = (self.n_used + 1) % 8;
        }
    }

    fn fill_byte(&mut self) {
        self.n_used = 0;
    }
}
