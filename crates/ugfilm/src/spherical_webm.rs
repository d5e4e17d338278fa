//! What players read of a 360° film in a WebM file: the element `Projection` of the video track
//! (RFC 9559, section 5.1.4.1.28).
//!
//! ffmpeg cannot write it. It reserves space before the tracks, an element `Void`, which is shortened
//! by as much as the track grows, so that nothing behind the tracks moves.

use std::ops::Range;

/// As many bytes as the elements before the first frames of a film have at most.
pub const HEAD: u64 = 1 << 16;

const SEGMENT: u32 = 0x1853_8067;
const SEEK_HEAD: u32 = 0x114d_9b74;
const SEEK: u32 = 0x4dbb;
const SEEK_POSITION: u32 = 0x53ac;
const VOID: u32 = 0xec;
const TRACKS: u32 = 0x1654_ae6b;
const TRACK_ENTRY: u32 = 0xae;
const VIDEO: u32 = 0xe0;

/// `ProjectionType` equirectangular, and `ProjectionPrivate` with version, flags and the four bounds
/// of the box `equi`, which are 0 for the whole sphere.
const PROJECTION: [u8; 30] = [
    0x76,
    0x70,
    0x80 | 27,
    0x76,
    0x71,
    0x81,
    1,
    0x76,
    0x72,
    0x80 | 20,
    0,
    0,
    0,
    0,
    0,
    0,
    0,
    0,
    0,
    0,
    0,
    0,
    0,
    0,
    0,
    0,
    0,
    0,
    0,
    0,
];

/// `StereoMode`: the picture of the left eye above that of the right one.
const TOP_BOTTOM: [u8; 4] = [0x53, 0xb8, 0x81, 3];

/// The first bytes of a film with the projection in its first track; `None` if they are not those of
/// a WebM film with space for it. `is_top_bottom`: frames have a picture for each eye.
pub fn with_projection(head: &[u8], is_top_bottom: bool) -> Option<Vec<u8>> {
    let stereo = if is_top_bottom { &TOP_BOTTOM[..] } else { &[] };
    let inserted = [&PROJECTION[..], stereo].concat();
    let by = inserted.len() as u64;
    let segment = find(head, 0..head.len(), SEGMENT)?.content;
    let void = find(head, segment.clone(), VOID)?;
    let tracks = find(head, segment.clone(), TRACKS)?;
    let track = find(head, tracks.content.clone(), TRACK_ENTRY)?;
    let video = find(head, track.content.clone(), VIDEO)?;
    if void.content.end > tracks.start || (void.content.len() as u64) < by {
        return None;
    }
    let mut changed = head.to_vec();
    for element in [&tracks, &track, &video] {
        set_size(&mut changed, element, element.content.len() as u64 + by)?;
    }
    set_size(&mut changed, &void, void.content.len() as u64 - by)?;
    // What is between the space and the tracks, and the tracks themselves, begin earlier.
    let seek_head = find(head, segment.clone(), SEEK_HEAD)?.content;
    for seek in elements(head, seek_head).filter(|element| element.id == SEEK) {
        let position = find(head, seek.content, SEEK_POSITION)?.content;
        let at = segment.start as u64 + number(head.get(position.clone())?);
        if (void.content.end as u64..=tracks.start as u64).contains(&at) {
            let new = (at - segment.start as u64).checked_sub(by)?.to_be_bytes();
            let bytes = new.get(new.len().checked_sub(position.len())?..)?;
            changed[position].copy_from_slice(bytes);
        }
    }
    changed.splice(video.content.end..video.content.end, inserted);
    changed.drain(void.content.end - by as usize..void.content.end);
    Some(changed)
}

/// An element of the format EBML.
struct Element {
    id: u32,
    start: usize,
    /// The bytes of its size.
    size: Range<usize>,
    content: Range<usize>,
}

/// The first element of a kind in a part of `bytes`.
fn find(bytes: &[u8], part: Range<usize>, id: u32) -> Option<Element> {
    elements(bytes, part).find(|element| element.id == id)
}

/// The elements in a part of `bytes`, up to one that is invalid. Content ends with the part.
fn elements(bytes: &[u8], part: Range<usize>) -> impl Iterator<Item = Element> {
    let mut start = part.start;
    std::iter::from_fn(move || {
        let id = variable(bytes, start, part.end)?;
        let size = variable(bytes, id.end, part.end)?;
        let digits = bytes.get(size.clone())?;
        let length = number(digits) & !(1 << (7 * digits.len()));
        let end = (size.end as u64).saturating_add(length).min(part.end as u64) as usize;
        let id = number(bytes.get(id)?) as u32;
        let found = Element { id, start, content: size.end..end, size };
        start = end;
        Some(found)
    })
}

/// The place of a number whose first byte says how many it has: as many as leading zeros and one.
fn variable(bytes: &[u8], start: usize, end: usize) -> Option<Range<usize>> {
    let n = bytes.get(start)?.leading_zeros() as usize + 1;
    (n <= 8 && start + n <= end).then_some(start..start + n)
}

fn number(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0, |number, &byte| number << 8 | u64::from(byte))
}

/// Changes the size of an element, in as many bytes as it has; `None` if they are too few.
fn set_size(bytes: &mut [u8], element: &Element, size: u64) -> Option<()> {
    let n = element.size.len();
    // All ones stand for an unknown size.
    if size + 1 >= 1 << (7 * n) {
        return None;
    }
    let marked = (size | 1 << (7 * n)).to_be_bytes();
    bytes.get_mut(element.size.clone())?.copy_from_slice(&marked[8 - n..]);
    Some(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn element(id: &[u8], content: &[u8]) -> Vec<u8> {
        [id, &(content.len() as u64 | 1 << 56).to_be_bytes(), content].concat()
    }

    /// The head of a film with so much space.
    fn head(space: usize) -> Vec<u8> {
        let seek = |at: usize| element(&[0x4d, 0xbb], &element(&[0x53, 0xac], &[0, at as u8]));
        let seek_head = |at: [usize; 3]| element(&[0x11, 0x4d, 0x9b, 0x74], &at.map(seek).concat());
        let void = element(&[0xec], &vec![0; space]);
        let info = element(&[0x15, 0x49, 0xa9, 0x66], b"info");
        let video = [&[0xe0, 0x83][..], &[0xb0, 0x81, 64]].concat();
        let tracks = element(&[0x16, 0x54, 0xae, 0x6b], &element(&[0xae], &video));
        let cluster = element(&[0x1f, 0x43, 0xb6, 0x75], b"frames");
        let info_at = seek_head([0; 3]).len() + void.len();
        let tracks_at = info_at + info.len();
        let seek_head = seek_head([info_at, tracks_at, tracks_at + tracks.len()]);
        let segment = [seek_head, void, info, tracks, cluster].concat();
        [element(&[0x1a, 0x45, 0xdf, 0xa3], b"webm"), element(&[0x18, 0x53, 0x80, 0x67], &segment)].concat()
    }

    #[test]
    fn the_track_grows_into_the_space_before_it() {
        for (is_top_bottom, n_more) in [(false, 30), (true, 34)] {
            for space in [n_more, 90] {
                let before = head(space);
                let after = with_projection(&before, is_top_bottom).unwrap();
                assert_eq!(after.len(), before.len());
                let segment = find(&after, 0..after.len(), SEGMENT).unwrap().content;
                let ids = |bytes: &[u8]| {
                    elements(bytes, segment.clone()).map(|element| element.id).collect::<Vec<_>>()
                };
                assert_eq!(ids(&after), ids(&before));
                // Every position is that of an element.
                let seeks = find(&after, segment.clone(), SEEK_HEAD).unwrap().content;
                let position = |seek: Element| {
                    number(&after[find(&after, seek.content, SEEK_POSITION).unwrap().content])
                };
                let positions: Vec<usize> =
                    elements(&after, seeks).map(|seek| segment.start + position(seek) as usize).collect();
                let starts: Vec<usize> =
                    elements(&after, segment.clone()).skip(2).map(|element| element.start).collect();
                assert_eq!(positions, starts);
                let inner = |part: Range<usize>, id| find(&after, part, id).unwrap().content;
                let video = inner(inner(inner(segment, TRACKS), TRACK_ENTRY), VIDEO);
                let kinds: Vec<u32> = elements(&after, video).map(|element| element.id).collect();
                assert_eq!(kinds, [&[0xb0, 0x7670][..], &[0x53b8][..n_more / 34]].concat());
            }
        }
    }

    #[test]
    fn other_files_are_refused() {
        for bytes in [vec![], b"no film, but text".to_vec(), head(29), head(90)[..90].to_vec()] {
            assert_eq!(with_projection(&bytes, false), None);
        }
    }
}
