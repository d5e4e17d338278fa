//! Textures of materials, and their mean colours.

use std::collections::{BTreeMap, BTreeSet};

use ugimage::{Format, Frame, MAX_PIXELS, Metadata, PictureLimits, Pixels, read_picture};
use ugphysics::{srgb_decode, srgb_encode};
use ugscene::{TextureImage, shorten};

use crate::builder::{Builder, Rgba};

/// Largest number of bytes of a picture file.
pub(crate) const MAX_TEXTURE_BYTES: u64 = 1 << 28;

/// Checks a picture file by its headers, without decoding its pixels. Returns the bytes of its
/// pixels and mip levels, as renderers decode them.
///
/// # Errors
/// The reason why it cannot be read.
pub fn check_picture(file: &[u8]) -> Result<u64, String> {
    let limits = PictureLimits { bytes: u64::MAX, ..PictureLimits::default() };
    let header = ugimage::check_picture(file, &limits).map_err(|error| error.to_string())?;
    Ok(header.n_bytes_with_levels())
}

/// The textures of a mesh, each of which is read once.
pub(crate) struct Textures {
    /// By name, or why there is none.
    loaded: BTreeMap<String, Result<LoadedTexture, String>>,
    /// Bytes that their pixels and mip levels may still have.
    room: u64,
    /// The kinds of textures that are not read.
    pub ignored: BTreeSet<&'static str>,
    /// What the files of pictures say and is not used.
    notes: Vec<String>,
}

/// A picture of a material.
#[derive(Clone)]
pub(crate) struct LoadedTexture {
    /// Its mean linear light.
    pub mean: [f64; 3],
    pub image: TextureImage,
}

/// Where a picture is from.
pub(crate) enum TextureOrigin {
    /// The name of its file.
    File(String),
    /// Its row in the mesh.
    Within(usize),
}

impl Textures {
    /// `memory`: the most bytes of the pixels and mip levels of all textures together.
    pub fn new(memory: u64) -> Self {
        Self { loaded: BTreeMap::new(), room: memory, ignored: BTreeSet::new(), notes: Vec::new() }
    }

    /// A texture, if it can be read. `load` returns its bytes and where they are from.
    pub fn load(
        &mut self,
        name: &str,
        load: impl FnOnce() -> Result<(Vec<u8>, TextureOrigin), String>,
    ) -> Option<LoadedTexture> {
        if !self.loaded.contains_key(name) {
            let texture = load().and_then(|(bytes, origin)| {
                let mean = self.mean_of_file(&bytes)?;
                let (file, row) = match origin {
                    TextureOrigin::File(name) => (Some(name), None),
                    TextureOrigin::Within(row) => (None, u32::try_from(row).ok()),
                };
                Ok(LoadedTexture { mean, image: TextureImage { file, row, bytes: bytes.into() } })
            });
            self.loaded.insert(name.to_owned(), texture);
        }
        self.loaded.get(name)?.clone().ok()
    }

    fn mean_of_file(&mut self, file: &[u8]) -> Result<[f64; 3], String> {
        let n_bytes = check_picture(file)?;
        if n_bytes > self.room {
            return Err(format!(
                "its pixels and mip levels are {n_bytes} bytes, and {} are left of the limit of memory",
                self.room
            ));
        }
        let limits = PictureLimits { bytes: self.room, ..PictureLimits::default() };
        self.room -= n_bytes;
        let picture = read_picture(file, &limits).map_err(|error| error.to_string())?;
        self.notes.extend(picture.notes);
        Ok(mean(&picture.pixels))
    }

    /// Warns of textures that cannot be read, and tells what else is not read.
    pub fn warn(&mut self, builder: &mut Builder) {
        let mut known = BTreeSet::new();
        for note in self.notes.drain(..).filter(|note| known.insert(note.clone())) {
            builder.warn(format!("of a texture: {note}"));
        }
        if !self.ignored.is_empty() {
            let kinds = self.ignored.iter().copied().collect::<Vec<_>>().join(", ");
            builder.warn(format!("textures of these kinds are not read: {kinds}"));
        }
        let failed =
            self.loaded.iter().filter_map(|(name, texture)| Some((name, texture.as_ref().err()?)));
        for (name, reason) in failed {
            builder.warn(format!(
                "texture `{}`: {reason}; its faces have the colour of their material",
                shorten(name)
            ));
        }
    }
}

/// A PNG picture with the colours of one file, or white without one, and the opacity that another
/// has: its alpha or, without any, its brightness. Pictures of different sizes are enlarged to the
/// larger one.
pub(crate) fn with_opacity(
    read_file: impl Fn(&str) -> Result<Vec<u8>, String>,
    colors: Option<&str>,
    opacity: &str,
) -> Result<Vec<u8>, String> {
    let read = |name: &str| {
        let bytes = read_file(name)?;
        let limits = PictureLimits::default();
        let picture = read_picture(&bytes, &limits).map_err(|error| error.to_string())?;
        // Numbers of light formats, unlike those of PNG, are not encoded.
        let is_encoded = bytes.starts_with(b"\x89PNG");
        Ok::<_, String>((picture.size, picture.pixels, is_encoded))
    };
    let (size, pixels, is_encoded) = read(opacity)?;
    let mask = opacities(&pixels, is_encoded);
    let (base_size, base) = match colors {
        Some(name) => {
            let (size, pixels, _) = read(name)?;
            (size, bytes_of(pixels))
        }
        None => ([1, 1], vec![[255; 4]]),
    };
    let [width, height] = [0, 1].map(|axis| size[axis].max(base_size[axis]));
    if u64::from(width) * u64::from(height) > MAX_PIXELS {
        return Err(format!("with its opacity it has more than {MAX_PIXELS} pixels"));
    }
    let at = |[columns, rows]: [u32; 2], x: u32, y: u32| {
        let part = |at: u32, from: u32, to: u32| {
            (2 * u64::from(at) + 1) * u64::from(to) / (2 * u64::from(from))
        };
        (part(y, height, rows) * u64::from(columns) + part(x, width, columns)) as usize
    };
    let mut both = Vec::with_capacity(width as usize * height as usize);
    for y in 0..height {
        both.extend((0..width).map(|x| {
            let [red, green, blue, _] = base[at(base_size, x, y)];
            [red, green, blue, mask[at(size, x, y)]]
        }));
    }
    let frame = Frame::new([width, height], false, both);
    Ok(Format::Png.encode(&frame, &Metadata::default()))
}

/// The opacity that each pixel means.
fn opacities(pixels: &Pixels, is_encoded: bool) -> Vec<u8> {
    let byte = |part: f64| (255.0 * part.clamp(0.0, 1.0)).round() as u8;
    match pixels {
        Pixels::Srgb(pixels) => {
            let has_alpha = pixels.iter().any(|pixel| pixel[3] < 255);
            let brightness = |[red, green, blue]: [u8; 3]| {
                let sum = 54 * u32::from(red) + 183 * u32::from(green) + 19 * u32::from(blue);
                ((sum + 128) / 256) as u8
            };
            let opacity = |&[red, green, blue, alpha]: &[u8; 4]| {
                if has_alpha { alpha } else { brightness([red, green, blue]) }
            };
            pixels.iter().map(opacity).collect()
        }
        Pixels::Light(pixels) => {
            let has_alpha = pixels.iter().any(|pixel| pixel[3] < 1.0);
            let opacity = |&[red, green, blue, alpha]: &[f32; 4]| {
                let [red, green, blue, alpha] = [red, green, blue, alpha].map(f64::from);
                let light = 0.2126 * red + 0.7152 * green + 0.0722 * blue;
                match (has_alpha, is_encoded) {
                    (true, _) => byte(alpha),
                    (false, true) => byte(srgb_encode(light.clamp(0.0, 1.0))),
                    (false, false) => byte(light),
                }
            };
            pixels.iter().map(opacity).collect()
        }
    }
}

/// The pixels with 8 bits per channel.
fn bytes_of(pixels: Pixels) -> Vec<[u8; 4]> {
    match pixels {
        Pixels::Srgb(pixels) => pixels,
        Pixels::Light(pixels) => {
            let byte = |part: f32| {
                let part = f64::from(part).clamp(0.0, 1.0);
                (255.0 * srgb_encode(part)).round() as u8
            };
            pixels
                .iter()
                .map(|pixel| [byte(pixel[0]), byte(pixel[1]), byte(pixel[2]), 255])
                .collect()
        }
    }
}

/// The display-encoded colour of a material times the mean linear light of its texture.
pub(crate) fn tinted(Rgba([red, green, blue, alpha]): Rgba, mean: [f64; 3]) -> Rgba {
    // Exactly 1 for white, where the transfer function has a rounding error.
    let encode = |linear: f64| if linear == 1.0 { 1.0 } else { srgb_encode(linear) };
    let tint = |part: f64, mean: f64| encode(srgb_decode(part) * mean);
    Rgba([tint(red, mean[0]), tint(green, mean[1]), tint(blue, mean[2]), alpha])
}

/// The mean linear light of the pixels, weighted by their alpha; white if all are transparent.
/// Light that is not finite is left out.
fn mean(pixels: &Pixels) -> [f64; 3] {
    let mut sum = [0.0; 4];
    let mut add = |light: [f64; 3], alpha: f64| {
        if light.iter().all(|part| part.is_finite()) && alpha.is_finite() {
            light.iter().zip(&mut sum).for_each(|(part, sum)| *sum += alpha * part);
            sum[3] += alpha;
        }
    };
    match pixels {
        Pixels::Srgb(pixels) => {
            let decoded: Vec<f64> =
                (0..=255).map(|byte| srgb_decode(f64::from(byte) / 255.0)).collect();
            for &[red, green, blue, alpha] in pixels {
                add(
                    [red, green, blue].map(|byte| decoded[usize::from(byte)]),
                    f64::from(alpha) / 255.0,
                );
            }
        }
        Pixels::Light(pixels) => {
            for &[red, green, blue, alpha] in pixels {
                add([red, green, blue].map(f64::from), f64::from(alpha));
            }
        }
    }
    let [red, green, blue, weight] = sum;
    if weight > 0.0 { [red, green, blue].map(|sum| sum / weight) } else { [1.0; 3] }
}
