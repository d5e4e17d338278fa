//! Marks in MP4: `st3d` and `sv3d` in the description of the pictures, and the XML of version 1 in a
//! `uuid` box of the track.

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom, Write};

use super::{Eyes, FilmProjection, Surround, make_room, unexpected};

/// The `uuid` of version 1.
const FIRST_VERSION: [u8; 16] =
    *b"\xff\xcc\x82\x63\xf8\x55\x4a\x93\x88\x14\x58\x7a\x02\x52\x1f\xdd";

/// Bytes before the boxes in a description of pictures (VisualSampleEntry), after its header.
const DESCRIPTION: usize = 78;

/// Longest `moov` that is read: 256 MB are a film of more than a week.
const LONGEST: u64 = 1 << 28;

/// A box. `parts`: of its content.
pub(super) fn boxed(kind: [u8; 4], parts: &[&[u8]]) -> Vec<u8> {
    let content = parts.concat();
    // Boxes that are made here are shorter than 2³² bytes: LONGEST.
    let length = (8 + content.len()) as u32;
    [&length.to_be_bytes()[..], &kind, &content].concat()
}

/// Writes the marks into a film.
///
/// # Errors
/// The file cannot be read or written, or is none that ffmpeg writes.
pub(super) fn mark(file: &mut File, surround: &Surround) -> io::Result<()> {
    let mut place = 0;
    loop {
        file.seek(SeekFrom::Start(place))?;
        let mut header = [0; 16];
        file.read_exact(&mut header[..8])?;
        let [length, kind] = [&header[..4], &header[4..8]].map(<[u8]>::to_vec);
        let length = match u32::from_be_bytes(length.try_into().unwrap_or_default()) {
            1 => {
                file.read_exact(&mut header[8..])?;
                u64::from_be_bytes(header[8..].try_into().unwrap_or_default())
            }
            length => length.into(),
        };
        if length < 8 {
            return Err(unexpected("it has no `moov`"));
        }
        if kind == *b"moov" {
            if length > LONGEST {
                return Err(unexpected("its `moov` is too long"));
            }
            let mut moov = vec![0; length as usize];
            file.seek(SeekFrom::Start(place))?;
            file.read_exact(&mut moov)?;
            // Its length does not depend on how far the pictures move.
            let n = marked(&moov, surround, (0, 0))?.len() as u64 - length;
            let moov = marked(&moov, surround, (place + length, n))?;
            make_room(file, place + length, n)?;
            file.seek(SeekFrom::Start(place))?;
            return file.write_all(&moov);
        }
        place += length;
    }
}

/// Boxes one after the other, with the marks. `moved`: what stands in the file from the first
/// number on moves by the second.
fn marked(boxes: &[u8], surround: &Surround, moved: (u64, u64)) -> io::Result<Vec<u8>> {
    let mut all = Vec::with_capacity(boxes.len());
    let mut rest = boxes;
    while !rest.is_empty() {
        let (kind, content, next) = first_box(rest)?;
        let inner = |start: usize| {
            let (fields, boxes) =
                content.split_at_checked(start).ok_or_else(|| unexpected("a box is too short"))?;
            Ok::<_, io::Error>((fields, marked(boxes, surround, moved)?))
        };
        all.extend(match &kind {
            b"trak" => {
                let first = surround
                    .first_version()
                    .map(|text| boxed(*b"uuid", &[&FIRST_VERSION, text.as_bytes()]));
                boxed(kind, &[&inner(0)?.1, &first.unwrap_or_default()])
            }
            b"moov" | b"mdia" | b"minf" | b"stbl" => boxed(kind, &[&inner(0)?.1]),
            // Version, flags and the number of descriptions; the film has one.
            b"stsd" => {
                let (fields, content) =
                    content.split_at_checked(8).ok_or_else(|| unexpected("`stsd` is too short"))?;
                boxed(kind, &[fields, &described(content, surround)?])
            }
            b"stco" => boxed(kind, &[&places::<4>(content, moved)?]),
            b"co64" => boxed(kind, &[&places::<8>(content, moved)?]),
            _ => boxed(kind, &[content]),
        });
        rest = next;
    }
    Ok(all)
}

/// The description of the pictures, with the marks after the box of the codec, which is its first.
fn described(description: &[u8], surround: &Surround) -> io::Result<Vec<u8>> {
    let (kind, content, _) = first_box(description)?;
    let (fields, boxes) = content
        .split_at_checked(DESCRIPTION)
        .ok_or_else(|| unexpected("its description is too short"))?;
    let (codec, of_codec, others) = first_box(boxes)?;
    Ok(boxed(kind, &[fields, &boxed(codec, &[of_codec]), &marks(surround), others]))
}

/// `st3d` and `sv3d`.
fn marks(surround: &Surround) -> Vec<u8> {
    const WHOLE: [u8; 4] = [0; 4];
    let eyes = match surround.eyes {
        Eyes::One => 0,
        Eyes::TopBottom => 1,
        Eyes::LeftRight => 2,
    };
    let stereo = boxed(*b"st3d", &[&WHOLE, &[eyes]]);
    let kind = match surround.projection {
        FilmProjection::Flat => return stereo,
        FilmProjection::Equirectangular => *b"equi",
        FilmProjection::Mesh(_) => *b"mshp",
    };
    let header = boxed(*b"svhd", &[&WHOLE, surround.source.as_bytes(), &[0]]);
    // The camera is level and looks ahead.
    let pose = boxed(*b"prhd", &[&WHOLE, &[0; 12]]);
    let projection = boxed(*b"proj", &[&pose, &boxed(kind, &[&surround.projection_data()])]);
    [stereo, boxed(*b"sv3d", &[&header, &projection])].concat()
}

/// A table of places in the file, of N bytes each, after version, flags and their number.
fn places<const N: usize>(content: &[u8], (from, n): (u64, u64)) -> io::Result<Vec<u8>> {
    let (head, table) =
        content.split_at_checked(8).ok_or_else(|| unexpected("a table is too short"))?;
    let mut all = head.to_vec();
    for place in table.as_chunks::<N>().0 {
        let place = place.iter().fold(0, |number, byte| number << 8 | u64::from(*byte));
        let moved = if place < from { place } else { place + n };
        let bytes = moved.to_be_bytes();
        if bytes[..8 - N] != [0; 8][..8 - N] {
            return Err(unexpected("it is longer than 4 GB"));
        }
        all.extend(&bytes[8 - N..]);
    }
    Ok(all)
}

/// Kind and content of the first box, and what follows it.
fn first_box(bytes: &[u8]) -> io::Result<([u8; 4], &[u8], &[u8])> {
    let parts = || {
        let (length, rest) = bytes.split_first_chunk::<4>()?;
        let (kind, rest) = rest.split_first_chunk::<4>()?;
        let length = (u32::from_be_bytes(*length) as usize).checked_sub(8)?;
        let (content, next) = rest.split_at_checked(length)?;
        Some((*kind, content, next))
    };
    parts().ok_or_else(|| unexpected("a box ends behind its end"))
}
