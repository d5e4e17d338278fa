//! Frames as numbered files: their names, which of them are done, and who draws which.

use std::ffi::OsString;
use std::fs::{self, File};
use std::io::{self, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

use ugimage::{Metadata, read_history};
use ugpipe::{Claim, Context, Failure, finite, is_occupied, stale};
use ugsheet::film::FrameNames;

/// The hidden file beside the first frame that has the exposure of the film.
fn exposure_of(names: &FrameNames) -> PathBuf {
    let first = names.path(1);
    let name =
        first.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    first.with_file_name(format!(".{name}.exposure"))
}

/// The exposure of a film, frames and stops, from a file beside its first frame if that has the
/// same `key`: a hash of all that the exposure depends on.
pub fn kept_exposure(names: &FrameNames, key: &str) -> Option<Vec<(u32, f64)>> {
    /// More than a key and its numbers need.
    const MAX_BYTES: u64 = 1 << 16;
    let path = exposure_of(names);
    // Links are not followed: they may lead to what has no end, or to another's file.
    fs::symlink_metadata(&path).ok().filter(|found| found.is_file() && found.len() <= MAX_BYTES)?;
    let text = fs::read_to_string(path).ok()?;
    let mut words = text.split_whitespace();
    words.next().filter(|kept| *kept == key)?;
    let words: Vec<&str> = words.collect();
    let (pairs, []) = words.as_chunks::<2>() else { return None };
    pairs.iter().map(|[frame, stops]| Some((frame.parse().ok()?, finite(stops).ok()?))).collect()
}

/// Writes the file that [`kept_exposure`] reads, unless something else than a file is in its place.
///
/// # Errors
/// The file cannot be written.
pub fn keep_exposure(names: &FrameNames, key: &str, stops: &[(u32, f64)]) -> Result<(), Failure> {
    let path = exposure_of(names);
    if is_occupied(&path) {
        return Ok(());
    }
    let numbers: String = stops.iter().map(|(frame, stops)| format!(" {frame} {stops}")).collect();
    Context::write_now(&path, format!("{key}{numbers}\n").as_bytes())
}

/// Removes the file that [`kept_exposure`] reads, if all `n_frames` frames are there.
pub fn remove_kept_exposure(names: &FrameNames, n_frames: u32) {
    let kept = exposure_of(names);
    if !is_occupied(&kept)
        && kept.exists()
        && (1..=n_frames).all(|frame| names.path(frame).exists())
    {
        // What cannot be removed does no harm.
        let _ = fs::remove_file(kept);
    }
}

/// True if the file is whole and was made by the commands that these metadata state.
pub fn is_done(path: &Path, metadata: &Metadata) -> bool {
    // A device or pipe would be read without end.
    let is_file = fs::metadata(path).is_ok_and(|found| found.is_file());
    if !is_file || metadata.comment.is_empty() {
        return false;
    }
    let history = File::open(path).and_then(history_of_whole);
    history.is_ok_and(|history| history.is_some_and(|history| history == metadata.comment))
}

/// Reads the file of a frame that is done.
///
/// # Errors
/// [`Failure::Read`].
pub fn read_done(path: &Path) -> Result<Vec<u8>, Failure> {
    fs::read(path).map_err(|error| Failure::Read { name: path.display().to_string(), error })
}

/// The history in a file; `None` if it has none, or is a PNG file without its end. Of a PNG file
/// only the beginning and the end are read.
fn history_of_whole(mut file: File) -> io::Result<Option<String>> {
    /// The end of a PNG file.
    const END: &[u8; 12] = b"\0\0\0\0IEND\xaeB`\x82";
    /// More than the history needs.
    const HEAD: u64 = 1 << 16;
    let mut bytes = Vec::new();
    file.by_ref().take(HEAD).read_to_end(&mut bytes)?;
    let is_png = bytes.starts_with(b"\x89PNG");
    let history = if is_png { read_history(&bytes) } else { None };
    if history.is_some() {
        let mut end = [0; END.len()];
        file.seek(SeekFrom::End(-(END.len() as i64)))?;
        file.read_exact(&mut end)?;
        return Ok(history.filter(|_| end == *END));
    }
    file.read_to_end(&mut bytes)?;
    Ok(read_history(&bytes).filter(|_| !is_png || bytes.ends_with(END)))
}

/// Claims a frame against other processes that work on the same film, until the claim is dropped.
/// `None` if another process draws it. Where files cannot be locked every process draws every
/// frame, which does no harm: they write the same bytes.
pub fn claim(frame: &Path) -> Option<Claim> {
    Claim::new(&claim_of(frame))
}

/// The file of a claim: `.frame_0001.png.claim`.
fn claim_of(frame: &Path) -> PathBuf {
    let mut name = OsString::from(".");
    name.push(frame.file_name().unwrap_or_default());
    name.push(".claim");
    frame.with_file_name(name)
}

/// Deletes the claims of this film that killed processes left.
pub fn remove_stale_claims(names: &FrameNames) {
    let first = names.path(1);
    let folder = first.parent().filter(|folder| !folder.as_os_str().is_empty());
    stale::remove(folder.unwrap_or(Path::new(".")), |name| {
        let frame = name.strip_prefix('.').and_then(|name| name.strip_suffix(".claim"));
        frame.is_some_and(|frame| names.number(frame).is_some())
    });
}

#[cfg(test)]
mod tests {
    use ugimage::{Format, Frame};

    use super::*;

    #[test]
    fn whole_files_of_the_same_commands_are_done() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("frame");
        // Noise, so that a PNG file is longer than the part that is read.
        let mut frame = Frame::opaque(256, 256);
        let mut noise = 1_u32;
        for pixel in frame.pixels_mut() {
            noise = noise.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            let [red, green, blue, _] = noise.to_be_bytes();
            *pixel = [red, green, blue, 255];
        }
        let of = |comment: &str| Metadata {
            software: "ug".to_owned(),
            comment: comment.to_owned(),
            ..Metadata::default()
        };
        for comment in ["a | b", &"long ".repeat(20_000)] {
            for format in [Format::Png, Format::Ppm, Format::Pdf, Format::Exr] {
                let file = format.encode(&frame, &of(comment));
                assert!(file.len() > 100_000, "{format:?}");
                fs::write(&path, &file).unwrap();
                assert!(is_done(&path, &of(comment)), "{format:?}");
                assert!(!is_done(&path, &of("a | c")), "{format:?}");
                if format == Format::Png {
                    fs::write(&path, &file[..file.len() - 1]).unwrap();
                    assert!(!is_done(&path, &of(comment)));
                }
            }
        }
        assert!(!is_done(&folder.path().join("none"), &of("a | b")));
    }

    #[test]
    fn claims_that_were_left_are_deleted() {
        let folder = tempfile::tempdir().unwrap();
        let names = FrameNames::new(&format!("{}/f_%02d.png", folder.path().display())).unwrap();
        let held = claim(&names.path(7)).unwrap();
        assert!(claim(&names.path(7)).is_none());
        for name in [".f_03.png.claim", ".f_x.png.claim", ".g_03.png.claim", "f_04.png.claim"] {
            fs::write(folder.path().join(name), "").unwrap();
        }
        remove_stale_claims(&names);
        let found = fs::read_dir(folder.path()).unwrap().map(|entry| entry.unwrap().file_name());
        let mut found: Vec<String> = found.map(|name| name.into_string().unwrap()).collect();
        found.sort();
        assert_eq!(
            found,
            [".f_07.png.claim", ".f_x.png.claim", ".g_03.png.claim", "f_04.png.claim"]
        );
        drop(held);
        assert!(!claim_of(&names.path(7)).exists());
    }

    /// A link in the place of a helper file: what it leads to stays, whatever it says.
    #[test]
    fn helper_files_follow_no_links() {
        let folder = tempfile::tempdir().unwrap();
        let names = FrameNames::new(&format!("{}/f_%d.png", folder.path().display())).unwrap();
        let precious = folder.path().join("thesis.txt");
        for helper in [exposure_of(&names), claim_of(&names.path(1))] {
            fs::write(&precious, "key 3").unwrap();
            std::os::unix::fs::symlink(&precious, &helper).unwrap();
            fs::write(names.path(1), "").unwrap();
            keep_exposure(&names, "other", &[(1, 1.0)]).unwrap();
            if helper == exposure_of(&names) {
                assert_eq!(kept_exposure(&names, "key"), None);
            }
            drop(claim(&names.path(1)).unwrap());
            remove_kept_exposure(&names, 1);
            assert_eq!(fs::read(&precious).unwrap(), b"key 3");
            fs::remove_file(&helper).unwrap();
        }
    }
}
