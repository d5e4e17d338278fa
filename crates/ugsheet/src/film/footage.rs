//! Films that are read, frame by frame.

use std::fs;
use std::io::{self, Cursor};
use std::path::{Path, PathBuf};

use image::codecs::gif::GifDecoder;
use image::codecs::png::PngDecoder;
use image::{AnimationDecoder, Frames, ImageDecoder, ImageError, ImageResult, Limits};
use ugimage::{Frame, Metadata, PictureLimits, read_png, read_png_header};
use ugpipe::{CommonArgs, Context, Failure, Input};

use super::frame_names::FrameNames;
use crate::{Motion, Picture};

/// A film, or a picture, which is a film of one frame.
pub struct Footage {
    /// Its name for labels.
    label: String,
    /// Its name for messages.
    pub name: String,
    /// Width and height of all its frames.
    pub size: [u32; 2],
    /// How many frames it has, 1 or more.
    pub n_frames: u32,
    /// Frames a second, if its file states them.
    pub rate: Option<f64>,
    source: Source,
    limits: PictureLimits,
}

enum Source {
    Gif(Vec<u8>),
    Apng(Vec<u8>),
    Picture(Vec<u8>),
    Files(Vec<PathBuf>),
}

/// The frames of a film with their records.
pub type FootageFrames<'f> = Box<dyn Iterator<Item = Result<(Frame, Metadata), Failure>> + 'f>;

/// True for the name of numbered files, and for a folder.
pub fn names_frames(path: &Path) -> bool {
    path.is_dir() || FrameNames::of_path(path).is_some()
}

/// True for a file with a film.
pub fn is_film(file: &[u8]) -> bool {
    is_gif(file) || is_apng(file)
}

fn is_gif(file: &[u8]) -> bool {
    file.starts_with(b"GIF8")
}

/// True for a PNG file with the chunk `acTL` before its pixels, also if it is cut off.
fn is_apng(file: &[u8]) -> bool {
    let Some(mut rest) = file.strip_prefix(b"\x89PNG\r\n\x1a\n") else { return false };
    while let [a, b, c, d, kind @ ..] = rest {
        if kind.starts_with(b"acTL") || kind.starts_with(b"IDAT") {
            return kind.starts_with(b"acTL");
        }
        // After the kind come as many bytes, and four of a checksum.
        let length = u32::from_be_bytes([*a, *b, *c, *d]) as usize;
        rest = kind.get(length.saturating_add(8)..).unwrap_or_default();
    }
    false
}

impl Footage {
    /// A film in a file, or a picture. `path`: its file, `None` for standard input.
    ///
    /// # Errors
    /// The file is none, or is broken.
    pub fn in_file(
        path: Option<&Path>,
        input: Input,
        limits: PictureLimits,
    ) -> Result<Self, Failure> {
        let label = path.and_then(Path::file_stem).map(|stem| stem.to_string_lossy().into_owned());
        let Input { name, text } = input;
        let source = if is_gif(&text) {
            Source::Gif(text)
        } else if is_apng(&text) {
            Source::Apng(text)
        } else {
            Source::Picture(text)
        };
        let mut film = Self {
            label: label.unwrap_or_default(),
            name,
            size: [1; 2],
            n_frames: 1,
            rate: None,
            source,
            limits,
        };
        if let Source::Picture(file) = &film.source {
            film.size = read_png_header(file).map_err(|error| film.broken(None, error))?.0;
        } else {
            (film.size, film.n_frames, film.rate) = film.measured()?;
        }
        Ok(film)
    }

    /// A film in numbered files, or in a folder of them.
    ///
    /// # Errors
    /// There are no frames, one is missing, cannot be read, or has another size than the first.
    pub fn in_files(
        path: &Path,
        context: &Context,
        limits: PictureLimits,
    ) -> Result<Self, Failure> {
        let name = path.display().to_string();
        let names = if path.is_dir() { None } else { FrameNames::new(&name) };
        let label = names.as_ref().map_or_else(|| file_name(path), FrameNames::name);
        let paths = frame_paths(path, names.as_ref());
        let paths = paths.map_err(|error| Failure::Read { name: name.clone(), error })?;
        let (n_frames, source) = (paths.len() as u32, Source::Files(Vec::new()));
        let mut film = Self { label, name, size: [1; 2], n_frames, rate: None, source, limits };
        for (row, path) in paths.iter().enumerate() {
            let header = read_png_header(&context.input_file(path)?.text);
            let size = header.map_err(|error| film.broken(Some(path), error))?.0;
            film.size = if row == 0 { size } else { film.size };
            film.check_size(size, Some(path))?;
        }
        Ok(Self { source: Source::Files(paths), ..film })
    }

    /// What its first frame is on a sheet.
    pub fn picture(&self) -> Picture {
        let (motion, history) = (Motion::default(), Metadata::default());
        Picture { name: self.label.clone(), size: self.size, motion, history }
    }

    /// The size of a film in one file, its number of frames, and its rate.
    fn measured(&self) -> Result<([u32; 2], u32, Option<f64>), Failure> {
        let (mut size, mut n_frames, mut seconds) = (self.size, 0_u32, 0.0);
        for frame in self.animation()? {
            let frame = frame.map_err(|error| self.undecoded(n_frames, &error))?;
            let (count, of) = frame.delay().numer_denom_ms();
            seconds += f64::from(count) / f64::from(of) / 1000.0;
            size = frame.buffer().dimensions().into();
            n_frames += 1;
        }
        if n_frames == 0 {
            return Err(Failure::Failed(format!("`{}` has no frames", self.name)));
        }
        let rate = f64::from(n_frames) / seconds;
        // A GIF rounds times to hundredths of a second.
        let ticks = |rate: f64| (100.0 * f64::from(n_frames) / rate).round();
        let whole = rate.round().max(1.0);
        let rate = if ticks(rate) == ticks(whole) { whole } else { rate };
        Ok((size, n_frames, (seconds > 0.0).then_some(rate)))
    }

    /// The frames of a film in one file.
    fn animation(&self) -> Result<Frames<'_>, Failure> {
        self.decoder().map_err(|error| self.undecoded(0, &error))
    }

    fn decoder(&self) -> ImageResult<Frames<'_>> {
        let mut limits = Limits::default();
        limits.max_alloc = Some(self.limits.bytes);
        Ok(match &self.source {
            Source::Gif(file) => {
                let mut decoder = GifDecoder::new(Cursor::new(file))?;
                decoder.set_limits(limits)?;
                decoder.into_frames()
            }
            Source::Apng(file) => {
                PngDecoder::with_limits(Cursor::new(file), limits)?.apng()?.into_frames()
            }
            Source::Picture(_) | Source::Files(_) => Frames::new(Box::new(std::iter::empty())),
        })
    }

    /// Decodes the frames, one after the other.
    ///
    /// # Errors
    /// The file is broken.
    pub fn frames(&self) -> Result<FootageFrames<'_>, Failure> {
        let picture = |path: Option<&Path>, file: &[u8]| {
            let (frame, metadata) =
                read_png(file, &self.limits).map_err(|error| self.broken(path, error))?;
            self.check_size([frame.width(), frame.height()], path)?;
            Ok((frame, metadata))
        };
        Ok(match &self.source {
            Source::Picture(file) => Box::new(std::iter::once_with(move || picture(None, file))),
            Source::Files(paths) => {
                let read = |path: &PathBuf| {
                    let name = || path.display().to_string();
                    fs::read(path).map_err(|error| Failure::Read { name: name(), error })
                };
                Box::new(paths.iter().map(move |path| picture(Some(path), &read(path)?)))
            }
            Source::Gif(_) | Source::Apng(_) => {
                Box::new((0..).zip(self.animation()?).map(|(n_before, frame)| {
                    let frame = frame.map_err(|error| self.undecoded(n_before, &error))?;
                    let pixels = frame.into_buffer().into_raw();
                    let pixels = pixels.as_chunks().0.to_vec();
                    let is_opaque = pixels.iter().all(|pixel: &[u8; 4]| pixel[3] == 255);
                    Ok((Frame::new(self.size, is_opaque, pixels), Metadata::default()))
                }))
            }
        })
    }

    fn check_size(&self, size: [u32; 2], path: Option<&Path>) -> Result<(), Failure> {
        if size == self.size {
            return Ok(());
        }
        let ([width, height], [columns, rows]) = (size, self.size);
        let why = format!(
            "{width} x {height} pixels, the frames before {columns} x {rows}: draw all with one -sz"
        );
        Err(self.broken(path, why))
    }

    fn broken(&self, path: Option<&Path>, error: impl std::fmt::Display) -> Failure {
        let name = path.map_or_else(|| self.name.clone(), |path| path.display().to_string());
        Failure::Failed(format!("`{name}`: {error}"))
    }

    fn undecoded(&self, n_before: u32, error: &ImageError) -> Failure {
        if let ImageError::Limits(_) = error {
            let [width, height] = self.size.map(u64::from);
            let remedy = CommonArgs::memory_remedy(Some(
                self.limits.bytes.max(16 * width * height).saturating_mul(2),
            ));
            return self.broken(None, format!("its frames exceed the limit of memory{remedy}"));
        }
        self.broken(None, format!("it is broken after {n_before} frames, write it again: {error}"))
    }
}

fn file_name(path: &Path) -> String {
    path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default()
}

/// The files of a film in the order of their numbers: those of a pattern, or the PNG files of a
/// folder.
fn frame_paths(path: &Path, names: Option<&FrameNames>) -> io::Result<Vec<PathBuf>> {
    let none = |expected: &Path| {
        Err(io::Error::other(format!("There are no frames, such as {}", expected.display())))
    };
    if let Some(names) = names {
        let numbers = names.numbers_found()?;
        if numbers.is_empty() {
            return none(&names.path(1));
        }
        return match numbers.windows(2).find(|pair| pair[1] - pair[0] > 1) {
            None => Ok(numbers.into_iter().map(|number| names.path(number)).collect()),
            Some(pair) => Err(io::Error::other(format!(
                "Frame {} is missing: draw it first",
                names.path(pair[0] + 1).display()
            ))),
        };
    }
    let is_png = |path: &PathBuf| {
        let name = file_name(path);
        name.ends_with(".png") && !name.starts_with('.') && path.is_file()
    };
    let mut paths =
        fs::read_dir(path)?.map(|entry| Ok(entry?.path())).collect::<io::Result<Vec<_>>>()?;
    paths.retain(is_png);
    // A longer number is a greater one.
    paths.sort_by_cached_key(|path| (file_name(path).len(), file_name(path)));
    let Some(first) = paths.first() else { return none(Path::new("frame_0001.png")) };
    let before = |path: &Path| {
        file_name(path).trim_end_matches(".png").trim_end_matches(char::is_numeric).len()
    };
    let is_other = |path: &&PathBuf| {
        file_name(path).get(..before(path)) != file_name(first).get(..before(first))
    };
    match paths.iter().find(is_other) {
        None => Ok(paths),
        Some(other) => Err(io::Error::other(format!(
            "{} is not a frame of the film of {}: name its frames, as {}",
            other.display(),
            first.display(),
            path.join("frame_%04d.png").display()
        ))),
    }
}

#[cfg(test)]
mod tests {
    use ugtesting::Random;

    use super::super::animation::{AnimatedPng, FilmShape, Gif};
    use super::*;

    fn films() -> [Vec<u8>; 2] {
        let shape = FilmShape { size: [9, 7], n_frames: 4, n_rows: 1, rate: 25.0 };
        let frame = |number: u8| {
            let mut frame = Frame::clear(9, 7);
            frame.pixels_mut()[usize::from(number)..].fill([50 * number, 9, 200, 255]);
            frame
        };
        let [mut gif, mut apng] = [Vec::new(), Vec::new()];
        let mut writer = Gif::new(&mut gif, shape).unwrap();
        (1..5).for_each(|number| writer.push(&frame(number)).unwrap());
        writer.finish().unwrap();
        let mut writer = AnimatedPng::new(&mut apng, shape).unwrap();
        (1..5).for_each(|number| writer.push(&frame(number)).unwrap());
        writer.finish().unwrap();
        [gif, apng]
    }

    fn read(file: Vec<u8>) -> Result<Vec<Frame>, Failure> {
        let limits = PictureLimits { bytes: 1 << 24, ..PictureLimits::default() };
        let film = Footage::in_file(None, Input { name: "film".to_owned(), text: file }, limits)?;
        let frames = film
            .frames()?
            .map(|frame| frame.map(|(frame, _)| frame))
            .collect::<Result<Vec<_>, _>>()?;
        assert_eq!(frames.len() as u32, film.n_frames);
        assert!(frames.iter().all(|frame| [frame.width(), frame.height()] == film.size));
        Ok(frames)
    }

    #[test]
    fn damaged_films_are_refused_or_read() {
        let films = films();
        let [gif, apng] = films.clone().map(|film| read(film).unwrap());
        assert!(gif.len() == 4 && gif == apng);
        let mut random = Random(51);
        for _ in 0..2000 {
            let mut film = random.pick(&films).clone();
            for _ in 0..1 + random.below(4) {
                let at = random.below(film.len());
                film[at] = random.bits() as u8;
            }
            film.truncate(if random.one_in(3) { random.below(film.len()) } else { film.len() });
            // Either is right: damage to colours cannot be seen.
            let _ = read(film);
        }
    }
}
