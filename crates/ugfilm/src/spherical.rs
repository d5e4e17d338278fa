//! What players read of a 360° film: in an MP4 file Spherical Video V1, a box of XML in the video
//! track; in a WebM file see [`crate::spherical_webm`].
//!
//! ffmpeg cannot write it, so it is inserted into the finished file.

use std::fs::{File, OpenOptions};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::ops::Range;
use std::path::Path;

use crate::spherical_webm::{HEAD, with_projection};

/// A film of all directions, equirectangular.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spherical {
    /// For both eyes the same.
    Mono,
    /// The picture of the left eye above that of the right one.
    TopBottom,
}

/// The identifier of the box.
const UUID: [u8; 16] =
    [0xff, 0xcc, 0x82, 0x63, 0xf8, 0x55, 0x4a, 0x93, 0x88, 0x14, 0x58, 0x7a, 0x02, 0x52, 0x1f, 0xdd];

/// Most bytes of the table of a film, which is read into memory: a film of weeks.
const MAX_TABLE: u64 = 1 << 28;

/// Bytes that are moved at once.
const BLOCK: u64 = 1 << 20;

impl Spherical {
    /// The box with its size and type.
    fn bytes(self) -> Vec<u8> {
        let stereo = match self {
            Self::Mono => "",
            Self::TopBottom => "<GSpherical:StereoMode>top-bottom</GSpherical:StereoMode>",
        };
        let text = format!(
            "<?xml version=\"1.0\"?><rdf:SphericalVideo \
             xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\" \
             xmlns:GSpherical=\"http://ns.google.com/videos/1.0/spherical/\">\
             <GSpherical:Spherical>true</GSpherical:Spherical>\
             <GSpherical:Stitched>true</GSpherical:Stitched>\
             <GSpherical:StitchingSoftware>{}</GSpherical:StitchingSoftware>\
             <GSpherical:ProjectionType>equirectangular</GSpherical:ProjectionType>{stereo}\
             </rdf:SphericalVideo>",
            concat!("ugfilm ", env!("CARGO_PKG_VERSION"))
        );
        let size = (8 + UUID.len() + text.len()) as u32;
        [&size.to_be_bytes()[..], b"uuid", &UUID, text.as_bytes()].concat()
    }

    /// Marks a WebM file.
    ///
    /// # Errors
    /// The file cannot be read or written, or is no WebM file with a video track and space before it.
    pub fn mark_webm(self, path: &Path) -> io::Result<()> {
        let mut file = OpenOptions::new().read(true).write(true).open(path)?;
        let mut head = Vec::new();
        Read::by_ref(&mut file).take(HEAD).read_to_end(&mut head)?;
        let changed = with_projection(&head, self == Self::TopBottom)
            .ok_or_else(|| io::Error::other("it has no video track with space before it, or is invalid"))?;
        file.seek(SeekFrom::Start(0))?;
        file.write_all(&changed)
    }

    /// Inserts the box into an MP4 file.
    ///
    /// # Errors
    /// The file cannot be read or written, or is no MP4 file with a video track.
    pub fn mark_mp4(self, path: &Path) -> io::Result<()> {
        let mut file = OpenOptions::new().read(true).write(true).open(path)?;
        let table = find_table(&mut file)?.ok_or_else(|| io::Error::other("it has no `moov` box"))?;
        if table.end - table.start > MAX_TABLE {
            return Err(io::Error::other("its `moov` box is too large"));
        }
        let mut bytes = vec![0; (table.end - table.start) as usize];
        file.seek(SeekFrom::Start(table.start))?;
        file.read_exact(&mut bytes)?;
        let changed = with_box(&bytes, &self.bytes(), table.start)
            .ok_or_else(|| io::Error::other("its `moov` box has no track, or is invalid"))?;
        move_end(&mut file, table.end, (changed.len() - bytes.len()) as u64)?;
        file.seek(SeekFrom::Start(table.start))?;
        file.write_all(&changed)
    }
}

/// Where the box `moov` is, with its header.
fn find_table(file: &mut File) -> io::Result<Option<Range<u64>>> {
    let end = file.seek(SeekFrom::End(0))?;
    let mut at = 0;
    while end - at >= 16 {
        let mut header = [0; 16];
        file.seek(SeekFrom::Start(at))?;
        file.read_exact(&mut header)?;
        let [a, b, c, d, kind @ .., _, _, _, _, _, _, _, _] = header;
        let size = match u32::from_be_bytes([a, b, c, d]) {
            0 => end - at,
            1 => u64::from_be_bytes(std::array::from_fn(|idx| header[8 + idx])),
            size => u64::from(size),
        };
        if size < 8 || size > end - at {
            return Ok(None);
        }
        if kind == *b"moov" {
            return Ok(Some(at..at + size));
        }
        at += size;
    }
    Ok(None)
}

/// Moves the end of a file, from `start` on, by some bytes.
fn move_end(file: &mut File, start: u64, by: u64) -> io::Result<()> {
    let mut end = file.seek(SeekFrom::End(0))?;
    let mut block = vec![0; BLOCK as usize];
    // From the end, so that nothing is overwritten before it is moved.
    while end > start {
        let from = end.saturating_sub(BLOCK).max(start);
        let block = &mut block[..(end - from) as usize];
        file.seek(SeekFrom::Start(from))?;
        file.read_exact(block)?;
        file.seek(SeekFrom::Start(from + by))?;
        file.write_all(block)?;
        end = from;
    }
    Ok(())
}

/// The box `moov` with another box at the end of its first track. `start`: its place in the file;
/// what is behind it moves, so the places of samples in its tables do.
fn with_box(table: &[u8], inserted: &[u8], start: u64) -> Option<Vec<u8>> {
    let mut changed = table.to_vec();
    let by = inserted.len() as u64;
    let mut track_end = None;
    for track in children(table, 8..table.len())?.into_iter().filter(|child| &child.kind == b"trak") {
        track_end = track_end.or(Some(track.whole.clone()));
        let mut inner = track.content;
        for kind in [b"mdia", b"minf", b"stbl"] {
            inner = children(table, inner)?.into_iter().find(|child| &child.kind == kind)?.content;
        }
        for places in children(table, inner)? {
            match &places.kind {
                b"stco" => shift::<4>(&mut changed, places.content, start, by)?,
                b"co64" => shift::<8>(&mut changed, places.content, start, by)?,
                _ => {}
            }
        }
    }
    let track = track_end?;
    for at in [0, track.start] {
        let size = u32::from_be_bytes(changed.get(at..at + 4)?.try_into().ok()?);
        let size = size.checked_add(by as u32)?;
        changed[at..at + 4].copy_from_slice(&size.to_be_bytes());
    }
    changed.splice(track.end..track.end, inserted.iter().copied());
    Some(changed)
}

/// Shifts the places in a table of `N` bytes each that are behind `start`.
fn shift<const N: usize>(bytes: &mut [u8], content: Range<usize>, start: u64, by: u64) -> Option<()> {
    // Behind version, flags and their number.
    for place in bytes.get_mut(content)?.get_mut(8..)?.chunks_exact_mut(N) {
        let old = place.iter().fold(0, |number, &byte| number << 8 | u64::from(byte));
        if old > start {
            let new = old.checked_add(by)?.to_be_bytes();
            // A place that needs more bytes than it has.
            if new[..8 - N].iter().any(|&byte| byte != 0) {
                return None;
            }
            place.copy_from_slice(&new[8 - N..]);
        }
    }
    Some(())
}

/// A box in a box.
struct Child {
    kind: [u8; 4],
    /// With its header.
    whole: Range<usize>,
    content: Range<usize>,
}

/// The boxes in a part of `bytes`; `None` if their sizes are wrong.
fn children(bytes: &[u8], part: Range<usize>) -> Option<Vec<Child>> {
    let mut found = Vec::new();
    let mut at = part.start;
    while at < part.end {
        let header: [u8; 8] = bytes.get(at..at + 8)?.try_into().ok()?;
        let [a, b, c, d, kind @ ..] = header;
        let end = at.checked_add(u32::from_be_bytes([a, b, c, d]) as usize)?;
        if end < at + 8 || end > part.end {
            return None;
        }
        found.push(Child { kind, whole: at..end, content: at + 8..end });
        at = end;
    }
    Some(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn boxed(kind: &str, content: &[u8]) -> Vec<u8> {
        [&(8 + content.len() as u32).to_be_bytes()[..], kind.as_bytes(), content].concat()
    }

    /// A film with samples at places behind or before its table.
    fn film(is_table_first: bool, is_long: bool) -> Vec<u8> {
        let kind = boxed("ftyp", b"isom");
        let data = boxed("mdat", &(0..=255).cycle().take(3 << 20).collect::<Vec<u8>>());
        let table = |places: [u64; 2]| {
            let mut content = vec![0, 0, 0, 0, 0, 0, 0, 2];
            for place in places {
                let bytes = place.to_be_bytes();
                content.extend(if is_long { &bytes[..] } else { &bytes[4..] });
            }
            let table = boxed(if is_long { "co64" } else { "stco" }, &content);
            let other = boxed("free", b"");
            let track = boxed("mdia", &boxed("minf", &boxed("stbl", &[other, table].concat())));
            boxed("moov", &[boxed("mvhd", b"1"), boxed("trak", &track), boxed("udta", b"")].concat())
        };
        let start = (kind.len() + 8 + if is_table_first { table([0; 2]).len() } else { 0 }) as u64;
        let table = table([start + 5, start + (2 << 20)]);
        if is_table_first { [kind, table, data].concat() } else { [kind, data, table].concat() }
    }

    /// The bytes at the places of the samples.
    fn samples(film: &[u8], is_long: bool) -> Vec<[u8; 4]> {
        let at =
            film.windows(4).position(|word| word == if is_long { b"co64" } else { b"stco" }).unwrap() + 12;
        let size = if is_long { 8 } else { 4 };
        let place = |bytes: &[u8]| bytes.iter().fold(0, |number, &byte| number << 8 | usize::from(byte));
        let places = film[at..at + 2 * size].chunks_exact(size).map(place);
        places.map(|place| film[place..place + 4].try_into().unwrap()).collect()
    }

    #[test]
    fn samples_stay_where_the_table_says() {
        for is_table_first in [false, true] {
            for is_long in [false, true] {
                let before = film(is_table_first, is_long);
                let file = tempfile::NamedTempFile::new().unwrap();
                std::fs::write(file.path(), &before).unwrap();
                Spherical::Mono.mark_mp4(file.path()).unwrap();
                let after = std::fs::read(file.path()).unwrap();
                assert_eq!(after.len(), before.len() + Spherical::Mono.bytes().len());
                assert_eq!(samples(&after, is_long), samples(&before, is_long));
                // The box is the last of the track.
                let top = children(&after, 0..after.len()).unwrap();
                let moov = top.into_iter().find(|child| &child.kind == b"moov").unwrap();
                let kinds: Vec<[u8; 4]> =
                    children(&after, moov.content.clone()).unwrap().iter().map(|child| child.kind).collect();
                assert_eq!(kinds, [*b"mvhd", *b"trak", *b"udta"]);
                let track = children(&after, moov.content).unwrap().remove(1);
                let last = children(&after, track.content).unwrap().pop().unwrap();
                assert_eq!((&last.kind, &after[last.whole]), (b"uuid", &Spherical::Mono.bytes()[..]));
            }
        }
    }

    #[test]
    fn other_files_are_refused() {
        for bytes in [
            vec![],
            b"no film, but text".to_vec(),
            boxed("moov", &boxed("mvhd", b"1")),
            boxed("moov", b"1234567"),
        ] {
            let file = tempfile::NamedTempFile::new().unwrap();
            std::fs::write(file.path(), &bytes).unwrap();
            assert!(Spherical::TopBottom.mark_mp4(file.path()).is_err());
            assert_eq!(std::fs::read(file.path()).unwrap(), bytes);
        }
    }
}
