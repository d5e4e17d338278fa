//! Reads the numbers of glTF accessors. Counts, offsets and types are checked before they are used.

use std::borrow::Cow;

use super::gltf_document::{Accessor, BufferView, Document, Whole, view_bytes};
use super::kind::Kind;
use crate::error::Problem;

/// Largest number of components of an accessor without a buffer view, which is all zeros.
const MAX_ZEROS: usize = 1 << 24;

/// The type of components with this code.
fn component(code: Whole) -> Result<Kind, Problem> {
    Ok(match code.0 {
        5120 => Kind::I8,
        5121 => Kind::U8,
        5122 => Kind::I16,
        5123 => Kind::U16,
        5125 => Kind::U32,
        5126 => Kind::F32,
        code => return Err(Problem::new(format!("{code} is not a component type; export the mesh again"))),
    })
}

impl Accessor {
    /// Number of components of a row.
    pub fn n_components(&self) -> Result<usize, Problem> {
        Ok(match self.shape.as_str() {
            "SCALAR" => 1,
            "VEC2" => 2,
            "VEC3" => 3,
            "VEC4" | "MAT2" => 4,
            "MAT3" => 9,
            "MAT4" => 16,
            _ => return Err(Problem::new("an accessor has no known type; export the mesh again")),
        })
    }

    /// True if the rows can be indices.
    pub fn is_index(&self) -> bool {
        matches!(component(self.component_type), Ok(Kind::U8 | Kind::U16 | Kind::U32))
            && self.shape == "SCALAR"
    }

    /// All components of all rows. Normalized integers are converted to fractions.
    pub fn read(&self, document: &Document, buffers: &[Cow<'_, [u8]>]) -> Result<Vec<f64>, Problem> {
        let view = |index| Document::row(&document.buffer_views, index, "buffer view");
        let kind = component(self.component_type)?;
        let n_components = self.n_components()?;
        let row_size = kind.size() * n_components;
        let count = self.count.0;
        let mut numbers = match self.buffer_view {
            Some(index) => rows(view(index)?, self.byte_offset, count, row_size, buffers)?
                .flat_map(|row| components(row, kind))
                .collect(),
            None if count <= MAX_ZEROS / n_components => vec![0.0; count * n_components],
            None => return Err(out_of_bounds()),
        };
        if let Some(sparse) = &self.sparse {
            let (indices, values) = (&sparse.indices, &sparse.values);
            let index_kind = component(indices.component_type)?;
            let (count, size) = (sparse.count.0, index_kind.size());
            let places = rows(view(indices.buffer_view)?, indices.byte_offset, count, size, buffers)?;
            let values = rows(view(values.buffer_view)?, values.byte_offset, count, row_size, buffers)?;
            for (place, row) in places.zip(values) {
                let place = components(place, index_kind).next().unwrap_or(0.0) as usize;
                let first = place.saturating_mul(n_components);
                let target =
                    numbers.get_mut(first..first.saturating_add(n_components)).ok_or_else(out_of_bounds)?;
                target.iter_mut().zip(components(row, kind)).for_each(|(old, new)| *old = new);
            }
        }
        if self.normalized {
            let full = kind.full();
            numbers.iter_mut().for_each(|number| *number = (*number / full).max(-1.0));
        }
        Ok(numbers)
    }
}

/// The bytes of each row, after a bounds check.
fn rows<'b>(
    view: &BufferView,
    offset: Whole,
    count: usize,
    row_size: usize,
    buffers: &'b [Cow<'_, [u8]>],
) -> Result<impl Iterator<Item = &'b [u8]> + use<'b>, Problem> {
    let find = || {
        let bytes = view_bytes(view, buffers)?.get(offset.0..)?;
        let stride = view.byte_stride.map_or(row_size, |stride| stride.0);
        let needed =
            count.checked_sub(1).map_or(Some(0), |n| n.checked_mul(stride)?.checked_add(row_size))?;
        (stride >= row_size && needed <= bytes.len()).then_some((bytes, stride))
    };
    let (bytes, stride) = find().ok_or_else(out_of_bounds)?;
    Ok((0..count).map(move |row| &bytes[row * stride..row * stride + row_size]))
}

fn out_of_bounds() -> Problem {
    Problem::new("an accessor reaches beyond its buffer; export the mesh again")
}

fn components(row: &[u8], kind: Kind) -> impl Iterator<Item = f64> {
    row.chunks_exact(kind.size()).map(move |bytes| kind.decode(bytes, true))
}
