//! Marks in WebM: `FilmProjection` in the description of the pictures. ffmpeg writes the other marks.
//!
//! Pictures and the index behind them keep their places: ffmpeg leaves room before the first
//! pictures, some of it as a tag ([`ROOM`]).

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom, Write};

use super::{FilmProjection, Surround, unexpected};

/// Name of the tag that stands for room. It is taken away.
pub(super) const ROOM: &str = "ROOM";

// Elements of Matroska (RFC 9559).
const SEGMENT: u32 = 0x1853_8067;
const SEEK_HEAD: u32 = 0x114D_9B74;
const SEEK: u32 = 0x4DBB;
const SEEK_ID: u32 = 0x53AB;
const SEEK_POSITION: u32 = 0x53AC;
const VOID: u32 = 0xEC;
const TRACKS: u32 = 0x1654_AE6B;
const TRACK_ENTRY: u32 = 0xAE;
const VIDEO: u32 = 0xE0;
const PROJECTION: u32 = 0x7670;
const PROJECTION_TYPE: u32 = 0x7671;
const PROJECTION_PRIVATE: u32 = 0x7672;
const TAGS: u32 = 0x1254_C367;
const TAG: u32 = 0x7373;
const SIMPLE_TAG: u32 = 0x67C8;
const CLUSTER: u32 = 0x1F43_B675;

/// Most bytes before the first pictures that are read.
const LONGEST: u64 = 1 << 24;

/// Writes the marks into a film.
///
/// # Errors
/// The file cannot be read or written, or is none that ffmpeg writes.
pub(super) fn mark(file: &mut File, surround: &Surround) -> io::Result<()> {
    let mut bytes = Vec::new();
    file.seek(SeekFrom::Start(0))?;
    file.take(LONGEST).read_to_end(&mut bytes)?;
    let head = first(&bytes)?;
    let segment = first(head.rest)?;
    if segment.id != SEGMENT {
        return Err(unexpected("it has no `Segment`"));
    }
    let start = bytes.len() - segment.rest.len() - segment.content.len();
    let length = {
        let mut rest = segment.content;
        loop {
            let element = first(rest)?;
            if element.id == CLUSTER {
                break segment.content.len() - rest.len();
            }
            rest = element.rest;
        }
    };
    let marked = marked(&segment.content[..length], surround)?;
    file.seek(SeekFrom::Start(start as u64))?;
    file.write_all(&marked)
}

/// What stands before the first pictures, with the marks and of the same length.
fn marked(before: &[u8], surround: &Surround) -> io::Result<Vec<u8>> {
    let mut elements = Vec::new();
    let mut rest = before;
    while !rest.is_empty() {
        let element = first(rest)?;
        let content = match element.id {
            VOID => None,
            TRACKS => Some(with_projection(element.content, surround)?),
            TAGS => Some(without_room(element.content)?),
            _ => Some(element.content.to_vec()),
        };
        elements.extend(content.map(|content| (element.id, content)));
        rest = element.rest;
    }
    let mut places = Vec::new();
    let mut place = 0;
    for (id, content) in &elements {
        places.push((*id, place));
        place += encoded(*id, content).len();
    }
    let mut all = Vec::new();
    for (id, content) in &mut elements {
        if *id == SEEK_HEAD {
            point_to(&places, content)?;
        }
        all.extend(encoded(*id, content));
    }
    // At least its identifier and one byte for its length.
    match before.len().checked_sub(all.len()) {
        Some(0) => Ok(all),
        Some(room @ 10..) => {
            let length = (room - 9) as u64 | 1 << 56;
            all.push(VOID as u8);
            all.extend(length.to_be_bytes());
            all.resize(before.len(), 0);
            Ok(all)
        }
        _ => Err(unexpected("it has no room")),
    }
}

/// Sets the places in an index: those of elements that are in `places`; the others did not move.
fn point_to(places: &[(u32, usize)], index: &mut [u8]) -> io::Result<()> {
    let mut start = 0;
    while start < index.len() {
        let entry = first(&index[start..])?;
        let (content, end) = (entry.content.len(), index.len() - entry.rest.len());
        if entry.id == SEEK {
            let fields = end - content..end;
            let (mut at, mut target) = (fields.start, None);
            while at < fields.end {
                let field = first(&index[at..fields.end])?;
                let (id, length) = (field.id, field.content.len());
                let number =
                    field.content.iter().fold(0_u64, |sum, byte| sum << 8 | u64::from(*byte));
                at = fields.end - field.rest.len();
                let here = at - length..at;
                match id {
                    SEEK_ID => target = Some(number),
                    SEEK_POSITION => {
                        let known = places.iter().find(|(id, _)| Some(u64::from(*id)) == target);
                        if let Some((_, place)) = known {
                            let bytes = (*place as u64).to_be_bytes();
                            let Some(cut) = 8_usize.checked_sub(length) else { continue };
                            if bytes[..cut].iter().any(|byte| *byte != 0) {
                                return Err(unexpected("its index has no room"));
                            }
                            index[here].copy_from_slice(&bytes[cut..]);
                        }
                    }
                    _ => {}
                }
            }
        }
        start = end;
    }
    Ok(())
}

/// Tracks with the projection at the end of `Video`.
fn with_projection(elements: &[u8], surround: &Surround) -> io::Result<Vec<u8>> {
    let kind = match surround.projection {
        FilmProjection::Flat => return Ok(elements.to_vec()),
        FilmProjection::Equirectangular => 1,
        FilmProjection::Mesh(_) => 3,
    };
    each(elements, |element| {
        Ok(Some(match element.id {
            TRACK_ENTRY => with_projection(element.content, surround)?,
            VIDEO => {
                let kind = encoded(PROJECTION_TYPE, &[kind]);
                let data = encoded(PROJECTION_PRIVATE, &surround.projection_data());
                [element.content, &encoded(PROJECTION, &[kind, data].concat())].concat()
            }
            _ => element.content.to_vec(),
        }))
    })
}

/// Tags without the one that stands for room.
fn without_room(elements: &[u8]) -> io::Result<Vec<u8>> {
    let is_room = |tag: &[u8]| first(tag).is_ok_and(|name| name.content == ROOM.as_bytes());
    each(elements, |element| {
        Ok(match element.id {
            TAG => Some(without_room(element.content)?),
            SIMPLE_TAG if is_room(element.content) => None,
            _ => Some(element.content.to_vec()),
        })
    })
}

/// Elements with another content each, or left out.
fn each(
    elements: &[u8],
    content: impl Fn(&Element<'_>) -> io::Result<Option<Vec<u8>>>,
) -> io::Result<Vec<u8>> {
    let mut all = Vec::new();
    let mut rest = elements;
    while !rest.is_empty() {
        let element = first(rest)?;
        if let Some(content) = content(&element)? {
            all.extend(encoded(element.id, &content));
        }
        rest = element.rest;
    }
    Ok(all)
}

struct Element<'a> {
    id: u32,
    content: &'a [u8],
    rest: &'a [u8],
}

/// The first element. The content of one that goes on behind `bytes` ends there.
fn first(bytes: &[u8]) -> io::Result<Element<'_>> {
    let parts = || {
        let (id, rest) = number(bytes, true)?;
        let (length, rest) = number(rest, false)?;
        let length = usize::try_from(length).unwrap_or(usize::MAX).min(rest.len());
        let (content, rest) = rest.split_at(length);
        Some(Element { id: u32::try_from(id).ok()?, content, rest })
    };
    parts().ok_or_else(|| unexpected("an element has no length"))
}

/// A number whose first bits say how many bytes it has, and what follows. `keeps_mark`: these bits
/// are part of it.
fn number(bytes: &[u8], keeps_mark: bool) -> Option<(u64, &[u8])> {
    let length = *bytes.first()?;
    let n = length.leading_zeros() as usize + 1;
    let (all, rest) = bytes.split_at_checked(n).filter(|_| n <= 8)?;
    let value = all.iter().fold(0_u64, |sum, byte| sum << 8 | u64::from(*byte));
    Some((if keeps_mark { value } else { value & !(1 << (7 * n)) }, rest))
}

/// An element; its length in as few bytes as it needs.
fn encoded(id: u32, content: &[u8]) -> Vec<u8> {
    let id = id.to_be_bytes();
    let n_zeros = id.iter().take_while(|byte| **byte == 0).count();
    let length = content.len() as u64;
    // All bits set stand for an unknown length.
    let n = (1..8).find(|n| length < (1 << (7 * n)) - 1).unwrap_or(8);
    let bytes = (length | 1 << (7 * n)).to_be_bytes();
    [&id[n_zeros..], &bytes[8 - n..], content].concat()
}
