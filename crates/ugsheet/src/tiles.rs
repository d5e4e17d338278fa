//! Joins the parts of a picture that were drawn by commands of their own.

use ugimage::{Frame, Metadata, PanoramaArea};
use ugpipe::{PIXELS_PER_INCH, Side};

use crate::error::Error;
use crate::shell_words::split;
use crate::{Picture, blank, copy};

/// The words that a renderer records of the part that it drew, before its left column, upper row,
/// width and height.
const PART: &str = "--crop";

/// The words that a renderer records before the width and height of the whole picture.
const SIZE: &str = "-sz";

/// Joins tiles to the whole picture. Each is at the place that its history states, and what else
/// its history states must be the same for all. The result has the pixels and the history of the
/// whole picture drawn by one command. `frame_of` returns the pixels of a tile by its index; it is
/// called once for each tile, in order.
///
/// # Errors
/// A history states no place, or differs from the first; tiles overlap or do not cover the picture.
pub fn join(
    tiles: &[Picture],
    mut frame_of: impl FnMut(usize) -> Result<Frame, Error>,
) -> Result<(Frame, Metadata), Error> {
    let first = tiles.first().ok_or(Error::Empty)?;
    let (history, sides) = (whole_history(first)?, whole_size(first)?);
    let size = sides.map(|side| side.at(PIXELS_PER_INCH));
    let mut places: Vec<[u32; 4]> = Vec::new();
    for tile in tiles {
        if whole_history(tile)? != history {
            return Err(refused(
                tile,
                &format!("not drawn by the command that drew `{}`", first.name),
            ));
        }
        let place = place(tile)?;
        if !is_inside(place, size) {
            return Err(refused(tile, "its part of the picture is not inside the picture"));
        }
        if let Some(other) = places.iter().position(|other| overlap(*other, place)) {
            return Err(refused(tile, &format!("it overlaps `{}`", tiles[other].name)));
        }
        places.push(place);
    }
    let area = |[width, height]: [u32; 2]| u64::from(width) * u64::from(height);
    let (covered, all) = (places.iter().map(|&[_, _, w, h]| area([w, h])).sum::<u64>(), area(size));
    if covered != all {
        let text = format!(
            "the tiles have {covered} of the {all} pixels of the picture: draw those missing"
        );
        return Err(Error::Picture(text));
    }
    if all > crate::error::MAX_PIXELS {
        return Err(Error::Size);
    }
    let mut frame = blank(size)?;
    let mut is_opaque = true;
    for (idx, (tile, &[left, top, width, height])) in tiles.iter().zip(&places).enumerate() {
        let pixels = frame_of(idx)?;
        if [pixels.width(), pixels.height()] != [width, height] {
            return Err(refused(tile, "it has changed while it was read"));
        }
        is_opaque &= pixels.is_opaque();
        copy(&pixels, [left, top], &mut frame, |pixel, _| pixel);
    }
    let per_inch = sides.into_iter().any(Side::is_length).then_some(PIXELS_PER_INCH);
    Ok((Frame::new(size, is_opaque, frame.into_pixels()), Metadata { per_inch, ..history }))
}

fn refused(tile: &Picture, problem: &str) -> Error {
    Error::Picture(format!("`{}`: {problem}", tile.name))
}

/// The history without the part of the picture.
fn whole_history(tile: &Picture) -> Result<Metadata, Error> {
    let part = place(tile)?.map(|number| number.to_string()).join(" ");
    let option = format!(" {PART} {part}");
    let without = |line: &str| {
        let is_option = |at: &usize| {
            let (before, after) = (&line[..*at], &line[at + option.len()..]);
            let words = [split(before), split(&option), split(after)].concat();
            (after.is_empty() || after.starts_with(' ')) && split(line) == words
        };
        let found = line.match_indices(&option).map(|(at, _)| at).find(is_option);
        found.map_or_else(
            || line.to_owned(),
            |at| line[..at].to_owned() + &line[at + option.len()..],
        )
    };
    let lines: Vec<String> = tile.history.comment.lines().map(without).collect();
    let panorama = tile.history.panorama.map(|area| PanoramaArea { corner: [0, 0], ..area });
    Ok(Metadata { comment: lines.join("\n"), panorama, ..tile.history.clone() })
}

/// The part of the picture that a tile is: left column, upper row, width and height.
fn place(tile: &Picture) -> Result<[u32; 4], Error> {
    let place = values(tile, PART, |word| word.parse().ok());
    let place = place.filter(|&[_, _, width, height]| [width, height] == tile.size);
    place.ok_or_else(|| Error::NoPart { name: tile.name.clone() })
}

/// Width and height of the whole picture.
fn whole_size(tile: &Picture) -> Result<[Side; 2], Error> {
    values(tile, SIZE, |word| Side::parse(word).ok())
        .ok_or_else(|| Error::NoWholeSize { name: tile.name.clone() })
}

/// The values of an option in the last line of a history.
fn values<T, const N: usize>(
    tile: &Picture,
    option: &str,
    parse: impl Fn(&str) -> Option<T>,
) -> Option<[T; N]> {
    let words = split(tile.history.comment.lines().next_back()?);
    let at = words.iter().position(|word| word == option)? + 1;
    let values: Option<Vec<T>> = words.get(at..at + N)?.iter().map(|word| parse(word)).collect();
    values?.try_into().ok()
}

fn is_inside([left, top, width, height]: [u32; 4], size: [u32; 2]) -> bool {
    let ends = [left.checked_add(width), top.checked_add(height)];
    ends.iter().zip(size).all(|(end, size)| end.is_some_and(|end| end <= size))
}

/// Both are inside a picture, so the sums are in range.
fn overlap(a: [u32; 4], b: [u32; 4]) -> bool {
    (0..2).all(|axis| a[axis] < b[axis] + b[axis + 2] && b[axis] < a[axis] + a[axis + 2])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Motion;

    fn tile(line: &str, size: [u32; 2]) -> Picture {
        let comment = format!("head\n{line} # SHA-256 00 a.ug");
        let history = Metadata { software: "a".into(), comment, ..Metadata::default() };
        Picture { name: "t".into(), size, motion: Motion::default(), history }
    }

    fn error(tiles: &[Picture]) -> String {
        join(tiles, |_| unreachable!()).unwrap_err().to_string()
    }

    #[test]
    fn tiles_are_placed_where_their_history_says() {
        let place = |x: u32, y: u32, w: u32, h: u32| {
            let line = format!("ug 'b --crop 0 0 2 1' -sz 3 2 --crop {x} {y} {w} {h} -va 5");
            let mut tile = tile(&line, [w, h]);
            tile.history.panorama = Some(PanoramaArea { whole: [3, 2], corner: [x, y] });
            tile
        };
        let tiles = [place(2, 0, 1, 2), place(0, 0, 2, 1), place(0, 1, 2, 1)];
        let color = |idx: usize| [idx as u8, 1, 2, if idx == 1 { 0 } else { 255 }];
        let frame_of = |idx: usize| {
            let size = tiles[idx].size;
            Ok(Frame::new(size, idx != 1, vec![color(idx); (size[0] * size[1]) as usize]))
        };
        let (frame, history) = join(&tiles, frame_of).unwrap();
        assert_eq!(frame.pixels(), [1, 1, 0, 2, 2, 0].map(color));
        assert!(!frame.is_opaque());
        assert_eq!(history.comment, "head\nug 'b --crop 0 0 2 1' -sz 3 2 -va 5 # SHA-256 00 a.ug");
        assert_eq!(history.panorama, Some(PanoramaArea { whole: [3, 2], corner: [0, 0] }));
    }

    #[test]
    fn what_is_wrong() {
        let place = |x: u32, w: u32| tile(&format!("ug -sz 4 1 --crop {x} 0 {w} 1"), [w, 1]);
        assert_eq!(error(&[]), "there are no pictures; name PNG files");
        assert_eq!(
            error(&[place(0, 1), place(2, 2)]),
            "the tiles have 3 of the 4 pixels of the picture: draw those missing"
        );
        assert_eq!(error(&[place(0, 3), place(2, 2)]), "`t`: it overlaps `t`");
        assert!(error(&[place(3, 2)]).contains("not inside the picture"));
        assert!(error(&[place(u32::MAX, 2)]).contains("not inside the picture"));
        let other = tile("ug -sz 4 1 --crop 1 0 3 1 -va 5", [3, 1]);
        assert_eq!(error(&[place(0, 1), other]), "`t`: not drawn by the command that drew `t`");
        assert!(error(&[tile("ug -sz 4 1", [4, 1])]).contains("which part of a picture it is"));
        assert!(
            error(&[tile("ug -sz 4 1 --crop 0 0 4 1", [3, 1])]).contains("which part of a picture")
        );
        assert!(error(&[tile("ug --crop 0 0 4 1", [4, 1])]).contains("size of the whole picture"));
    }
}
