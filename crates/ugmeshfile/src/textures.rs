//! Textures of materials, and their mean colours.

use std::collections::BTreeMap;

use ugimage::{PictureLimits, Pixels, read_picture};
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
        Self { loaded: BTreeMap::new(), room: memory }
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
        Ok(mean(&read_picture(file, &limits).map_err(|error| error.to_string())?.pixels))
    }

    /// Warns of textures that cannot be read.
    pub fn warn(&self, builder: &mut Builder) {
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
