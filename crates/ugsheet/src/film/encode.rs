//! Films as files: animated PNG and GIF, frames for other programs, and MP4 or WebM through ffmpeg.

use std::io::{self, Read, Write};
use std::path::Path;
use std::process::{ChildStdin, Command, Stdio};

use ugimage::Frame;
use ugpipe::{Context, Failure, Running, Steps};

use super::animation::{AnimatedPng, FilmShape, Gif, fraction};
use super::kind::FilmKind;
use super::lesson::{Caption, Lesson};
use super::surround::Surround;

/// A film as a file.
#[derive(Clone, Debug)]
pub struct FilmFile {
    /// Its kind.
    pub kind: FilmKind,
    /// The size and number of its frames.
    pub shape: FilmShape,
    /// True if no frame is transparent.
    pub is_opaque: bool,
    /// What players of 360° films are told; kinds that ffmpeg writes say it.
    pub surround: Option<Surround>,
}

/// Writes a film to the output of a program, of which nothing is written before its first frame is
/// drawn. `draw` passes the frames on in order. `captions`: of the pictures on a page.
///
/// # Errors
/// A frame cannot be drawn, or the film cannot be written.
pub fn write(
    context: &mut Context,
    film: &FilmFile,
    captions: Vec<Caption>,
    draw: impl FnOnce(&Steps<'_>, &mut dyn FnMut(&Frame) -> Result<(), Failure>) -> Result<(), Failure>,
) -> Result<(), Failure> {
    let (kind, shape) = (film.kind, film.shape);
    if kind.is_encoded() {
        return context.write_by_name(|path, steps| {
            let mut ffmpeg = Ffmpeg::new(film, path)?;
            draw(steps, &mut |frame| ffmpeg.push(frame))?;
            ffmpeg.finish()?;
            let mark = |surround: &Surround| surround.mark(kind, path);
            film.surround.as_ref().map_or(Ok(()), mark).map_err(Failure::failed)
        });
    }
    context.write_stream(|out, steps| {
        let (mut waiting, mut stream) = (Some((out, captions)), None);
        let mut push = |frame: &Frame| {
            if let Some((out, captions)) = waiting.take() {
                stream = Some(Stream::new(kind, shape, captions, out)?);
            }
            stream.as_mut().map_or(Ok(()), |stream| stream.push(frame))
        };
        let mut broken = None;
        let drawn = draw(steps, &mut |frame| {
            push(frame).map_err(|error| {
                let failure = Failure::failed(&error);
                broken = Some(error);
                failure
            })
        });
        if let Some(error) = broken {
            return Ok(Err(error));
        }
        drawn?;
        Ok(stream.map_or(Ok(()), Stream::finish))
    })
}

/// Writes frames to a stream, in order.
enum Stream<'w> {
    /// Animated PNG.
    Apng(AnimatedPng<'w>),
    /// GIF.
    Gif(Gif<'w>),
    /// YUV4MPEG2.
    Y4m(&'w mut dyn Write, Vec<u8>),
    /// PPM.
    Ppm(&'w mut dyn Write),
    /// A page.
    Html(Lesson<'w>),
}

impl<'w> Stream<'w> {
    /// Begins a film. `captions`: of the pictures on a page.
    ///
    /// # Errors
    /// Writing fails, or the format cannot hold the film.
    pub fn new(
        kind: FilmKind,
        shape: FilmShape,
        captions: Vec<Caption>,
        out: &'w mut dyn Write,
    ) -> io::Result<Self> {
        Ok(match kind {
            FilmKind::Gif => Self::Gif(Gif::new(out, shape)?),
            FilmKind::Y4m => {
                let ([width, height], [count, seconds]) = (shape.size, fraction(shape.rate));
                writeln!(
                    out,
                    "YUV4MPEG2 W{width} H{height} F{count}:{seconds} Ip A1:1 C444 XCOLORRANGE=LIMITED"
                )?;
                Self::Y4m(out, Vec::new())
            }
            FilmKind::Ppm => Self::Ppm(out),
            FilmKind::Html => Self::Html(Lesson::new(out, captions, shape)?),
            FilmKind::Apng | FilmKind::Mp4 | FilmKind::Webm => {
                Self::Apng(AnimatedPng::new(out, shape)?)
            }
        })
    }

    /// Adds the next frame.
    ///
    /// # Errors
    /// Writing fails.
    pub fn push(&mut self, frame: &Frame) -> io::Result<()> {
        match self {
            Self::Apng(film) => film.push(frame),
            Self::Gif(film) => film.push(frame),
            Self::Html(page) => page.push(frame),
            Self::Y4m(out, planes) => {
                y_cb_cr(frame, planes);
                out.write_all(b"FRAME\n")?;
                out.write_all(planes)
            }
            Self::Ppm(out) => {
                write!(out, "P6\n{} {}\n255\n", frame.width(), frame.height())?;
                out.write_all(&rgb(frame))
            }
        }
    }

    /// Ends the film.
    ///
    /// # Errors
    /// Writing fails.
    pub fn finish(self) -> io::Result<()> {
        match self {
            Self::Apng(film) => film.finish(),
            Self::Gif(film) => film.finish(),
            Self::Html(page) => page.finish(),
            Self::Y4m(out, _) | Self::Ppm(out) => out.flush(),
        }
    }
}

/// Red, green and blue of all pixels; what is transparent has its own colour.
pub fn rgb(frame: &Frame) -> Vec<u8> {
    frame.pixels().iter().flat_map(|&[red, green, blue, _]| [red, green, blue]).collect()
}

/// Three planes of ITU-R BT.709 in the range of video: 16 to 235, and 16 to 240.
fn y_cb_cr(frame: &Frame, planes: &mut Vec<u8>) {
    let pixels = frame.pixels();
    planes.clear();
    planes.resize(3 * pixels.len(), 0);
    let (luma, chroma) = planes.split_at_mut(pixels.len());
    let (blue_plane, red_plane) = chroma.split_at_mut(pixels.len());
    // Many pixels are like the one before. Black:
    let mut last = ([0; 3], [16, 128, 128]);
    for (row, &[red, green, blue, _]) in pixels.iter().enumerate() {
        if last.0 != [red, green, blue] {
            let [r, g, b] = [red, green, blue].map(|part| f64::from(part) / 255.0);
            let y = 0.2126 * r + 0.7152 * g + 0.0722 * b;
            // With ½ added, truncation rounds positive numbers to the nearest.
            let levels = [
                16.5 + 219.0 * y,
                128.5 + 224.0 * (b - y) / 1.8556,
                128.5 + 224.0 * (r - y) / 1.5748,
            ];
            last = ([red, green, blue], levels.map(|level| level as u8));
        }
        [luma[row], blue_plane[row], red_plane[row]] = last.1;
    }
}

/// ffmpeg, which gets raw frames and writes a file.
struct Ffmpeg {
    is_opaque: bool,
    program: Running,
    input: Option<ChildStdin>,
}

impl Ffmpeg {
    /// Starts it.
    ///
    /// # Errors
    /// There is no ffmpeg.
    pub fn new(film: &FilmFile, path: &Path) -> Result<Self, Failure> {
        let &FilmFile { kind, shape, is_opaque, .. } = film;
        let [width, height] = shape.size;
        let [count, seconds] = fraction(shape.rate);
        let codec: &[&str] = match kind {
            FilmKind::Webm => {
                &["-c:v", "libvpx-vp9", "-crf", "24", "-b:v", "0", "-row-mt", "1", "-f", "webm"]
            }
            _ => &["-c:v", "libx264", "-crf", "16", "-movflags", "+faststart", "-f", "mp4"],
        };
        let [pixels, planes] = if is_opaque { ["rgb24", "yuv420p"] } else { ["rgba", "yuva420p"] };
        let mut command = Command::new("ffmpeg");
        command
            .args(["-nostdin", "-hide_banner", "-loglevel", "error", "-y", "-f", "rawvideo"])
            .args(["-pix_fmt", pixels])
            .args([
                "-s",
                &format!("{width}x{height}"),
                "-r",
                &format!("{count}/{seconds}"),
                "-i",
                "-",
                "-an",
            ])
            .args(["-vf", &format!("scale=out_color_matrix=bt709,format={planes}")])
            .args(["-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "bt709"])
            .args(["-fflags", "+bitexact", "-flags:v", "+bitexact"])
            .args(film.surround.iter().flat_map(|surround| surround.arguments(kind)))
            .args(codec)
            .arg(path)
            .stdin(Stdio::piped())
            .stdout(Stdio::null())
            .stderr(Stdio::piped());
        let mut program = Running::spawn(&mut command).map_err(|error| match error.kind() {
            io::ErrorKind::NotFound => Failure::failed(format!(
                "there is no ffmpeg, which writes {} files: install it, or write frames (-fo frame_%04d.png), \
                 an animated PNG (film.apng) or a GIF",
                kind.name()
            )),
            _ => Failure::failed(format!("cannot run ffmpeg: {error}")),
        })?;
        let input = program.child_mut().stdin.take();
        Ok(Self { is_opaque, program, input })
    }

    /// Adds the next frame.
    ///
    /// # Errors
    /// ffmpeg has ended, for the reason it gives.
    pub fn push(&mut self, frame: &Frame) -> Result<(), Failure> {
        let bytes =
            if self.is_opaque { rgb(frame) } else { frame.pixels().as_flattened().to_vec() };
        let written = self.input.as_mut().map(|input| input.write_all(&bytes));
        match written {
            Some(Ok(())) => Ok(()),
            _ => Err(self.complaint()),
        }
    }

    /// Ends the film.
    ///
    /// # Errors
    /// ffmpeg fails, for the reason it gives.
    pub fn finish(mut self) -> Result<(), Failure> {
        drop(self.input.take());
        match self.program.child_mut().wait() {
            Ok(status) if status.success() => Ok(()),
            _ => Err(self.complaint()),
        }
    }

    fn complaint(&mut self) -> Failure {
        drop(self.input.take());
        let mut text = String::new();
        // What it printed may be no text; its status says enough then.
        let _ = self
            .program
            .child_mut()
            .stderr
            .take()
            .map(|mut stream| stream.read_to_string(&mut text));
        let status = self
            .program
            .child_mut()
            .wait()
            .map_or_else(|error| error.to_string(), |status| status.to_string());
        let line =
            text.lines().map(str::trim).rfind(|line| !line.is_empty()).unwrap_or("no message");
        Failure::failed(format!("ffmpeg failed with {status}: {line}"))
    }
}

impl Drop for Ffmpeg {
    /// Stops it, if the film has no end.
    fn drop(&mut self) {
        if self.input.take().is_some() {
            self.program.stop();
            let _ = self.program.child_mut().wait();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// ITU-R BT.709: black, white and the pure colours, in the range of video.
    #[test]
    fn colours_of_video_are_those_of_the_standard() {
        let check = |rgb: [u8; 3], expected: [u8; 3]| {
            let mut frame = Frame::opaque(1, 1);
            frame.pixels_mut()[0] = [rgb[0], rgb[1], rgb[2], 255];
            let mut planes = Vec::new();
            y_cb_cr(&frame, &mut planes);
            assert_eq!(planes, expected, "{rgb:?}");
        };
        check([0, 0, 0], [16, 128, 128]);
        check([255, 255, 255], [235, 128, 128]);
        check([255, 0, 0], [63, 102, 240]);
        check([0, 255, 0], [173, 42, 26]);
        check([0, 0, 255], [32, 240, 118]);
    }
}
