//! Reads the numbers of glTF accessors.
//!
//! The readers of the `gltf` crate trust the counts, offsets and types in the file; here they are
//! checked first.

use std::borrow::Cow;

use gltf::Accessor;
use gltf::accessor::DataType;
use gltf::accessor::sparse::IndexType;
use gltf::buffer::View;

use crate::error::Problem;

/// Largest number of components of an accessor without a buffer view, which is all zeros.
const MAX_ZEROS: usize = 1 << 24;

/// All components of all rows. Normalized integers are converted to fractions.
pub(super) fn read(accessor: &Accessor, buffers: &[Cow<'_, [u8]>]) -> Result<Vec<f64>, Problem> {
    let kind = accessor.data_type();
    let n_components = accessor.dimensions().multiplicity();
    let row_size = kind.size() * n_components;
    let mut numbers = match accessor.view() {
        Some(view) => rows(&view, accessor.offset(), accessor.count(), row_size, buffers)?
            .flat_map(|row| components(row, kind))
            .collect(),
        None if accessor.count() <= MAX_ZEROS / n_components => vec![0.0; accessor.count() * n_components],
        None => return Err(out_of_bounds()),
    };
    if let Some(sparse) = accessor.sparse() {
        let (indices, values) = (sparse.indices(), sparse.values());
        let index_kind = match indices.index_type() {
            IndexType::U8 => DataType::U8,
            IndexType::U16 => DataType::U16,
            IndexType::U32 => DataType::U32,
        };
        let count = sparse.count();
        let places = rows(&indices.view(), indices.offset(), count, index_kind.size(), buffers)?;
        let values = rows(&values.view(), values.offset(), count, row_size, buffers)?;
        for (place, row) in places.zip(values) {
            let first = components(place, index_kind).next().unwrap_or(0.0) as usize * n_components;
            let target = numbers.get_mut(first..first + n_components).ok_or_else(out_of_bounds)?;
            target.iter_mut().zip(components(row, kind)).for_each(|(old, new)| *old = new);
        }
    }
    if accessor.normalized() {
        let full = match kind {
            DataType::I8 => f64::from(i8::MAX),
            DataType::U8 => f64::from(u8::MAX),
            DataType::I16 => f64::from(i16::MAX),
            DataType::U16 => f64::from(u16::MAX),
            DataType::U32 | DataType::F32 => 1.0,
        };
        numbers.iter_mut().for_each(|number| *number = (*number / full).max(-1.0));
    }
    Ok(numbers)
}

/// The bytes of each row, after a bounds check.
fn rows<'b>(
    view: &View,
    offset: usize,
    count: usize,
    row_size: usize,
    buffers: &'b [Cow<'_, [u8]>],
) -> Result<impl Iterator<Item = &'b [u8]> + use<'b>, Problem> {
    let find = || {
        let end = view.offset().checked_add(view.length())?;
        let bytes = buffers.get(view.buffer().index())?.get(view.offset()..end)?.get(offset..)?;
        let stride = view.stride().unwrap_or(row_size);
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

fn components(row: &[u8], kind: DataType) -> impl Iterator<Item = f64> {
    row.chunks_exact(kind.size()).map(move |bytes| match (kind, bytes) {
        (DataType::I8, &[a]) => f64::from(a as i8),
        (DataType::U8, &[a]) => f64::from(a),
        (DataType::I16, &[a, b]) => f64::from(i16::from_le_bytes([a, b])),
        (DataType::U16, &[a, b]) => f64::from(u16::from_le_bytes([a, b])),
        (DataType::U32, &[a, b, c, d]) => f64::from(u32::from_le_bytes([a, b, c, d])),
        (DataType::F32, &[a, b, c, d]) => f64::from(f32::from_le_bytes([a, b, c, d])),
        _ => unreachable!("chunks have the size of the kind"),
    })
}
