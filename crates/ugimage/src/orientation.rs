//! The orientation that cameras note in pictures (Exif).

use crate::pixels::Pixels;

/// The orientation in Exif data, from 1 to 8; 1 if there is none.
pub(crate) fn of_exif(exif: &[u8]) -> u8 {
    let exif = exif.strip_prefix(b"Exif\0\0").unwrap_or(exif);
    let is_little_endian = exif.starts_with(b"II");
    let number = |at: usize, n_bytes: usize| {
        let bytes = exif.get(at..at.checked_add(n_bytes)?)?.iter();
        let join = |number: usize, byte: &u8| number << 8 | usize::from(*byte);
        Some(if is_little_endian { bytes.rev().fold(0, join) } else { bytes.fold(0, join) })
    };
    let find = || {
        let directory = number(4, 4)?;
        let entries = (0..number(directory, 2)?).map(|idx| directory + 2 + 12 * idx);
        let entry = entries.into_iter().find(|&at| number(at, 2) == Some(0x112))?;
        u8::try_from(number(entry + 8, 2)?).ok().filter(|orientation| (1..=8).contains(orientation))
    };
    find().unwrap_or(1)
}

/// The picture turned and mirrored as its orientation says.
pub(crate) fn upright<P: Copy>(
    orientation: u8,
    [width, height]: [u32; 2],
    pixels: Vec<P>,
    kind: impl Fn(Vec<P>) -> Pixels,
) -> ([u32; 2], Pixels) {
    let size = if orientation >= 5 { [height, width] } else { [width, height] };
    if orientation <= 1 || pixels.is_empty() {
        return (size, kind(pixels));
    }
    let (last_column, last_row) = (width as usize - 1, height as usize - 1);
    let place = |column: usize, row: usize| match orientation {
        2 => (last_column - column, row),
        3 => (last_column - column, last_row - row),
        4 => (column, last_row - row),
        5 => (row, column),
        6 => (row, last_row - column),
        7 => (last_column - row, last_row - column),
        _ => (last_column - row, column),
    };
    let rows = (0..size[1] as usize)
        .flat_map(|row| (0..size[0] as usize).map(move |column| (column, row)));
    let pixel = |(column, row)| {
        let (column, row) = place(column, row);
        pixels[row * width as usize + column]
    };
    (size, kind(rows.map(pixel).collect()))
}
