//! Reads the numbers of glTF accessors. Counts, offsets and types are checked before they are used.

use std::borrow::Cow;

use serde_json::Value;

use super::gltf_document::{Document, whole};
use super::kind::Kind;
use crate::error::Problem;

/// Largest number of components of an accessor without a buffer view, which is all zeros.
const MAX_ZEROS: usize = 1 << 24;

/// The type of components with the code of this key.
fn component(value: &Value) -> Result<Kind, Problem> {
    Ok(match whole(&value["componentType"]) {
        Some(5120) => Kind::I8,
        Some(5121) => Kind::U8,
        Some(5122) => Kind::I16,
        Some(5123) => Kind::U16,
        Some(5125) => Kind::U32,
        Some(5126) => Kind::F32,
        _ => {
            return Err(Problem::new(
                "an accessor has no known type of components; export the mesh again",
            ));
        }
    })
}

/// Number of components of a row, and number of rows.
pub(super) fn shape(accessor: &Value) -> Result<[usize; 2], Problem> {
    let n_components = match accessor["type"].as_str() {
        Some("SCALAR") => 1,
        Some("VEC2") => 2,
        Some("VEC3") => 3,
        Some("VEC4" | "MAT2") => 4,
        Some("MAT3") => 9,
        Some("MAT4") => 16,
        _ => return Err(Problem::new("an accessor has no known type; export the mesh again")),
    };
    let count =
        whole(&accessor["count"]).ok_or_else(|| Problem::new("an accessor has no count"))?;
    Ok([n_components, count])
}

/// True if the rows can be indices.
pub(super) fn is_index(accessor: &Value) -> bool {
    matches!(component(accessor), Ok(Kind::U8 | Kind::U16 | Kind::U32))
        && accessor["type"] == "SCALAR"
}

/// All components of all rows. Normalized integers are converted to fractions.
pub(super) fn read(
    accessor: &Value,
    document: &Document,
    buffers: &[Cow<'_, [u8]>],
) -> Result<Vec<f64>, Problem> {
    let kind = component(accessor)?;
    let [n_components, count] = shape(accessor)?;
    let row_size = kind.size() * n_components;
    let rows = |part: &Value, count: usize, row_size: usize| {
        rows(part, count, row_size, document, buffers)
    };
    let mut numbers = match whole(&accessor["bufferView"]) {
        Some(_) => rows(accessor, count, row_size)?.flat_map(|row| components(row, kind)).collect(),
        None if count <= MAX_ZEROS / n_components => vec![0.0; count * n_components],
        None => return Err(out_of_bounds()),
    };
    let sparse = &accessor["sparse"];
    if let Some(count) = whole(&sparse["count"]) {
        let index_kind = component(&sparse["indices"])?;
        let places = rows(&sparse["indices"], count, index_kind.size())?;
        for (place, row) in places.zip(rows(&sparse["values"], count, row_size)?) {
            let place = components(place, index_kind).next().unwrap_or(0.0) as usize;
            let first = place.saturating_mul(n_components);
            let target = numbers
                .get_mut(first..first.saturating_add(n_components))
                .ok_or_else(out_of_bounds)?;
            target.iter_mut().zip(components(row, kind)).for_each(|(old, new)| *old = new);
        }
    }
    if accessor["normalized"] == true {
        let full = kind.full();
        numbers.iter_mut().for_each(|number| *number = (*number / full).max(-1.0));
    }
    Ok(numbers)
}

/// The bytes of each row of a part of a buffer view, after a bounds check.
fn rows<'b>(
    part: &Value,
    count: usize,
    row_size: usize,
    document: &Document,
    buffers: &'b [Cow<'_, [u8]>],
) -> Result<impl Iterator<Item = &'b [u8]> + use<'b>, Problem> {
    let find = || {
        let index = whole(&part["bufferView"])?;
        let bytes =
            document.view(index, buffers)?.get(whole(&part["byteOffset"]).unwrap_or(0)..)?;
        let stride =
            whole(&document.table("bufferViews").get(index)?["byteStride"]).unwrap_or(row_size);
        let needed = count
            .checked_sub(1)
            .map_or(Some(0), |n| n.checked_mul(stride)?.checked_add(row_size))?;
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
