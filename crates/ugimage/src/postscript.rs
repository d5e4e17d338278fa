//! PostScript documents of one page and Encapsulated PostScript: a colour image over white, with
//! two filters, or a drawing.

use ugphysics::srgb_decode;

use crate::{Frame, Metadata, Quantizer};

/// The frame as a PostScript document of one page, or as an EPS file to be placed in a document;
/// one pixel per point, or as many as its metadata state.
pub fn encode(frame: &Frame, metadata: &Metadata, is_encapsulated: bool) -> Vec<u8> {
    let points = metadata.points([frame.width(), frame.height()]);
    wrap(points, 2, metadata, &color_image(frame, points), is_encapsulated)
}

/// Makes a file of the PostScript code `drawing`, which draws `width` × `height` points.
pub fn wrap(
    [width, height]: [u32; 2],
    level: u32,
    metadata: &Metadata,
    drawing: &[u8],
    is_encapsulated: bool,
) -> Vec<u8> {
    let setup = format!(
        "%%BeginSetup\n<< /PageSize [{width} {height}] >> setpagedevice\n%%EndSetup\n%%Page: 1 1\n"
    );
    let [kind, pages, setup, trailer] = match is_encapsulated {
        true => [" EPSF-3.0", "", "", ""],
        false => ["", "%%Pages: 1\n", &setup, "%%Trailer\n"],
    };
    let mut file = format!(
        "%!PS-Adobe-3.0{kind}\n\
         %%BoundingBox: 0 0 {width} {height}\n\
         {}\
         %%LanguageLevel: {level}\n\
         %%DocumentData: Clean7Bit\n\
         {pages}\
         %%EndComments\n\
         {}{setup}",
        creator_comment(metadata),
        history_comments(metadata)
    )
    .into_bytes();
    file.extend_from_slice(drawing);
    file.extend_from_slice(format!("showpage\n{trailer}%%EOF\n").as_bytes());
    file
}

/// Longest comment line written; the document structuring conventions allow 255 characters.
const MAX_COMMENT: usize = 250;

/// The `%%Creator` comment; empty if the metadata has no software.
fn creator_comment(metadata: &Metadata) -> String {
    let mut text = String::new();
    if !metadata.software.is_empty() {
        text += &format!("%%Creator: {}\n", comment_line(&metadata.software));
    }
    text
}

/// The metadata's comment as plain `%` lines, to be placed after `%%EndComments`.
fn history_comments(metadata: &Metadata) -> String {
    metadata.comment.lines().map(history_comment).collect()
}

/// A comment of one line, and of further lines with `%+` if it is long.
fn history_comment(line: &str) -> String {
    let characters: Vec<char> = line.chars().map(printed).collect();
    let lines = characters.chunks(MAX_COMMENT).enumerate();
    lines
        .map(|(idx, part)| format!("%{}{}\n", [' ', '+'][idx.min(1)], String::from_iter(part)))
        .collect()
}

fn printed(c: char) -> char {
    if c == ' ' || c.is_ascii_graphic() { c } else { '?' }
}

/// `text` as printable ASCII, truncated to the length of a comment line.
fn comment_line(text: &str) -> String {
    text.chars().map(printed).take(MAX_COMMENT).collect()
}

/// PostScript level 2 code that draws the frame with its lower left corner at the origin, `across`
/// x `up` points large.
///
/// The filters are stored in variables so that both can be flushed after the last pixel. The
/// interpreter then continues directly after the data.
fn color_image(frame: &Frame, [across, up]: [u32; 2]) -> Vec<u8> {
    let (width, height) = (frame.width(), frame.height());
    let mut out = format!(
        "gsave\n\
         {across} {up} scale\n\
         /DeviceRGB setcolorspace\n\
         /UgImage {{\n\
         /UgText currentfile /ASCII85Decode filter def\n\
         /UgRuns UgText /RunLengthDecode filter def\n\
         << /ImageType 1 /Width {width} /Height {height} /BitsPerComponent 8\n\
         /Decode [0 1 0 1 0 1] /ImageMatrix [{width} 0 0 -{height} 0 {height}]\n\
         /DataSource UgRuns >> image\n\
         UgRuns flushfile UgText flushfile\n\
         }} def\n\
         UgImage\n"
    )
    .into_bytes();
    let rgb = over_white(frame);
    let mut text = Ascii85::new(&mut out);
    run_length(rgb.as_flattened(), |byte| text.push(byte));
    text.finish();
    out.extend_from_slice(b"grestore\n");
    out
}

/// The colours of a frame, transparent pixels composited over white in linear light.
pub fn over_white(frame: &Frame) -> Vec<[u8; 3]> {
    if frame.is_opaque() {
        return frame.pixels().iter().map(|&[r, g, b, _]| [r, g, b]).collect();
    }
    let quantizer = Quantizer::new();
    let linear: [f64; 256] = std::array::from_fn(|level| srgb_decode(level as f64 / 255.0));
    let blend = |level: u8, alpha: u8| {
        let alpha = f32::from(alpha) / 255.0;
        quantizer.level(linear[usize::from(level)] as f32 * alpha + (1.0 - alpha))
    };
    frame.pixels().iter().map(|&[r, g, b, a]| [r, g, b].map(|level| blend(level, a))).collect()
}

/// The run-length encoding of PostScript (PackBits): a length byte n, then n + 1 literal bytes if
/// n < 128, or one byte to be repeated 257 − n times if n > 128; n = 128 ends the data.
fn run_length(bytes: &[u8], mut put: impl FnMut(u8)) {
    const LONGEST: usize = 128;
    let run_at =
        |at: usize| bytes[at..].iter().take(LONGEST).take_while(|&&byte| byte == bytes[at]).count();
    let mut at = 0;
    while at < bytes.len() {
        let run = run_at(at);
        if run >= 3 {
            put((257 - run) as u8);
            put(bytes[at]);
            at += run;
            continue;
        }
        // Literal bytes, up to the next run of three or more.
        let start = at;
        while at < bytes.len() && at - start < LONGEST && !starts_run(&bytes[at..]) {
            at += 1;
        }
        put((at - start - 1) as u8);
        bytes[start..at].iter().for_each(|&byte| put(byte));
    }
    put(128);
}

/// True if the first three bytes are equal.
fn starts_run(bytes: &[u8]) -> bool {
    matches!(bytes, [a, b, c, ..] if a == b && b == c)
}

/// Writes bytes as base 85 text: four bytes become five characters from `!` to `u`, four
/// zeros become `z`, and `~>` ends.
pub struct Ascii85<'a> {
    out: &'a mut Vec<u8>,
    word: u32,
    len: usize,
    column: usize,
}

impl<'a> Ascii85<'a> {
    fn new(out: &'a mut Vec<u8>) -> Self {
        Self { out, word: 0, len: 0, column: 0 }
    }

    /// Encodes all of `bytes` and the end mark.
    pub fn encode(bytes: &[u8], out: &'a mut Vec<u8>) {
        let mut text = Self::new(out);
        bytes.iter().for_each(|&byte| text.push(byte));
        text.finish();
    }

    fn push(&mut self, byte: u8) {
        self.word = self.word << 8 | u32::from(byte);
        self.len += 1;
        if self.len < 4 {
            return;
        }
        match self.word {
            0 => self.print(b'z'),
            word => digits(word).into_iter().for_each(|digit| self.print(digit)),
        }
        (self.word, self.len) = (0, 0);
    }

    /// Writes the end mark. A last group of n < 4 bytes is padded with zeros, and its first n + 1
    /// digits are written.
    fn finish(mut self) {
        if self.len > 0 {
            let word = self.word << (8 * (4 - self.len));
            digits(word).into_iter().take(self.len + 1).for_each(|digit| self.print(digit));
        }
        self.out.extend_from_slice(b"~>\n");
    }

    fn print(&mut self, digit: u8) {
        // Spoolers would interpret a line that starts with `%%` as a structuring comment. The
        // decoder skips the space before it.
        if self.column == 0 && digit == b'%' {
            self.out.push(b' ');
        }
        self.out.push(digit);
        self.column += 1;
        if self.column == 80 {
            self.out.push(b'\n');
            self.column = 0;
        }
    }
}

/// The five base 85 digits of a word, the highest first.
fn digits(word: u32) -> [u8; 5] {
    [52_200_625, 614_125, 7_225, 85, 1].map(|unit| b'!' + (word / unit % 85) as u8)
}
