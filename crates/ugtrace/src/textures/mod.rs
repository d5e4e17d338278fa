//! Pictures on surfaces, for renderers that find the light of each sample by itself: `levels`,
//! texels with mip levels; `footprint`, the change of texture coordinates between samples.

mod footprint;
mod levels;

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, Weak};

use glam::{DVec2, DVec3};
use rayon::prelude::*;
use thiserror::Error;
use ugimage::{PictureLimits, check_picture, read_picture};
use uglight::{Appearance, SurfaceColor};
use ugscene::{AlphaMode, ColorId, Scene, Texture, VertexId};

pub use footprint::SurfaceElementPlane;
use levels::{Filter, Levels};

/// A picture on surfaces that cannot be read.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("the picture `{file}` of colour `{color}` cannot be read: {reason}")]
pub struct TextureError {
    /// Its file, or its colour if it has none.
    pub file: String,
    /// The name of the colour.
    pub color: String,
    /// Why.
    pub reason: String,
    /// The bytes of the pixels and mip levels of all textures, if these exceed the limit of memory.
    pub needed_memory: Option<u64>,
}

/// The textures of a scene, ready for sampling.
#[derive(Debug, Default)]
pub struct Textures {
    maps: Vec<TextureMap>,
    /// For each colour of the scene, its map; empty if there are none.
    of_color: Vec<Option<u32>>,
    /// For each colour of the scene the linear light with which a vertex tints a texture.
    tints: Vec<DVec3>,
}

/// A texture.
#[derive(Debug)]
struct TextureMap {
    levels: Arc<Levels>,
    texture: Texture,
}

/// The light of a texture at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Texel {
    /// Linear red, green and blue, 0 or more.
    pub light: DVec3,
    /// 0 opaque … 1 fully transparent.
    pub translucency: f64,
}

impl Textures {
    /// Decodes the textures of a scene. `memory`: the most bytes of their pixels and mip levels.
    /// `light`: the linear light of a colour, with which a vertex tints a texture.
    ///
    /// # Errors
    /// A picture is damaged, or they are too large.
    pub fn new(
        scene: &Scene,
        memory: u64,
        light: impl Fn(ColorId) -> DVec3,
    ) -> Result<Self, TextureError> {
        if scene.textures.is_empty() {
            return Ok(Self::default());
        }
        let mut is_drawn = vec![false; scene.colors.len()];
        for color in scene.faces.iter().filter_map(|face| face.color) {
            is_drawn[color.index()] = true;
            if let Some(emitted) = scene.emitted_by(color) {
                is_drawn[emitted.index()] = true;
            }
        }
        // The bytes are missing if the files of the scene were not read.
        let drawn: Vec<&Texture> = scene
            .textures
            .iter()
            .filter(|texture| !texture.image.bytes.is_empty() && is_drawn[texture.color.index()])
            .collect();
        // Each picture is decoded once. Texels are kept with alpha only where it counts.
        let mut pictures: Vec<&Texture> = Vec::new();
        let mut rows = BTreeMap::new();
        for texture in &drawn {
            let key = (texture.image.bytes.as_ptr(), texture.alpha == AlphaMode::Opaque);
            rows.entry(key).or_insert_with(|| {
                pictures.push(texture);
                pictures.len() - 1
            });
        }
        check_memory(scene, &pictures, memory)?;
        kept().retain(|kept| kept.bytes.strong_count() > 0);
        let levels: Vec<Arc<Levels>> = pictures
            .par_iter()
            .map(|texture| levels(scene, texture, memory))
            .collect::<Result<_, _>>()?;
        let mut of_color = vec![None; scene.colors.len()];
        let mut maps = Vec::new();
        for texture in drawn {
            let key = (texture.image.bytes.as_ptr(), texture.alpha == AlphaMode::Opaque);
            let row = rows[&key];
            of_color[texture.color.index()] = Some(maps.len() as u32);
            maps.push(TextureMap { levels: Arc::clone(&levels[row]), texture: texture.clone() });
        }
        let is_mixture = |id: ColorId| {
            let name = scene.names.get(scene.colors[id.index()].name);
            scene.stage.mixtures.is_some_and(|mixtures| mixtures.contains(name))
        };
        let tint =
            |id: ColorId| if is_mixture(id) { DVec3::ONE } else { light(id).max(DVec3::ZERO) };
        let tints = (0..scene.colors.len()).map(ColorId::from_index).map(tint).collect();
        Ok(Self { maps, of_color, tints })
    }

    /// The texture of a colour.
    #[inline]
    fn of(&self, color: Option<ColorId>) -> Option<&TextureMap> {
        self.maps.get((*self.of_color.get(color?.index())?)? as usize)
    }

    /// True if a colour is a picture that is there.
    #[inline]
    pub fn has(&self, color: Option<ColorId>) -> bool {
        self.of(color).is_some()
    }

    /// True if a texture is not opaque.
    pub fn has_translucency(&self) -> bool {
        self.maps.iter().any(|map| map.texture.alpha != AlphaMode::Opaque)
    }

    /// True if a face of this colour is not opaque everywhere, because of its texture.
    #[inline]
    pub fn is_translucent(&self, color: Option<ColorId>) -> bool {
        self.of(color).is_some_and(|map| map.texture.alpha != AlphaMode::Opaque)
    }

    /// True if there are none.
    pub fn is_empty(&self) -> bool {
        self.maps.is_empty()
    }

    /// The texel of a face at a point of a triangle of it; `None` if it has no texture, or a corner
    /// has no texture coordinates.
    ///
    /// `corners`, `weights`: of the triangle, and of the point. `steps`: the changes of the weights
    /// of the second and third corner to the next sample across and down.
    #[inline]
    pub fn texel(
        &self,
        scene: &Scene,
        color: Option<ColorId>,
        (corners, weights): ([VertexId; 3], [f64; 3]),
        steps: impl FnOnce() -> [[f64; 2]; 2],
    ) -> Option<Texel> {
        let map = self.of(color)?;
        map.texel(Some(&self.tints), scene, corners, weights, steps)
    }

    /// The colour at rest of a face of this colour where it has a texture, and the colour that it
    /// emits there: that of a texel where it is a picture, which colours of vertices do not tint.
    /// `at`, `steps`: see [`Textures::texel`].
    pub fn colors(
        &self,
        (scene, appearance): (&Scene, &Appearance),
        color: Option<ColorId>,
        at: Option<([VertexId; 3], [f64; 3])>,
        is_moving: bool,
        steps: impl Fn() -> [[f64; 2]; 2],
    ) -> [Option<SurfaceColor>; 2] {
        let texel = |color: Option<ColorId>, tints: Option<&[DVec3]>| {
            let (map, (corners, weights)) = self.of(color).zip(at)?;
            map.texel(tints, scene, corners, weights, &steps)
        };
        let own = texel(color, Some(&self.tints));
        let emitted = color.and_then(|color| scene.emitted_by(color)).map(|emitted| {
            let light = texel(Some(emitted), None).map(|texel| texel.light);
            appearance.emitted(emitted, light, is_moving)
        });
        [own.map(|own| appearance.texel(own.light, own.translucency, is_moving)), emitted]
    }
}

impl TextureMap {
    #[inline(never)] // Keeps the code of untextured points small.
    fn texel(
        &self,
        tints: Option<&[DVec3]>,
        scene: &Scene,
        corners: [VertexId; 3],
        [_, second, third]: [f64; 3],
        steps: impl FnOnce() -> [[f64; 2]; 2],
    ) -> Option<Texel> {
        let vertices = corners.map(|corner| &scene.vertices[corner.index()]);
        let place =
            |at: usize| vertices[at].uv.map(|[u, v]| DVec2::new(f64::from(u), f64::from(v)));
        let (a, b, c) = (place(0)?, place(1)?, place(2)?);
        let (along, beside) = (b - a, c - a);
        let uv = a + second * along + third * beside;
        let steps = steps().map(|[second, third]| second * along + third * beside);
        let Texture { wrap, factor, alpha, is_nearest, .. } = self.texture;
        let filter = Filter { wrap, is_nearest };
        let [red, green, blue, opacity] = self.levels.sample(uv, steps, filter);
        let [f_red, f_green, f_blue, f_alpha] = factor.map(f64::from);
        let mut light = DVec3::new(red * f_red, green * f_green, blue * f_blue);
        let tint =
            |at: usize| vertices[at].color.zip(tints).map(|(color, tints)| tints[color.index()]);
        if let (Some(a), Some(b), Some(c)) = (tint(0), tint(1), tint(2)) {
            light *= a + second * (b - a) + third * (c - a);
        }
        let opacity = opacity * f_alpha;
        let translucency = match alpha {
            AlphaMode::Opaque => 0.0,
            AlphaMode::Mask(cutoff) => f64::from(u8::from(opacity < f64::from(cutoff))),
            AlphaMode::Blend => 1.0 - opacity.clamp(0.0, 1.0),
        };
        Some(Texel { light, translucency })
    }
}

/// Refuses pictures whose pixels and mip levels exceed a limit of memory together.
fn check_memory(scene: &Scene, pictures: &[&Texture], most: u64) -> Result<(), TextureError> {
    let limits = PictureLimits { bytes: u64::MAX, ..PictureLimits::default() };
    let mut needed = 0_u64;
    for texture in pictures {
        let header = check_picture(&texture.image.bytes, &limits)
            .map_err(|error| unreadable(scene, texture, error.to_string(), None))?;
        needed = needed.saturating_add(header.n_bytes_with_levels());
        if needed > most {
            let reason = format!(
                "with mip levels its pixels and those of the textures before it are {needed} \
                 bytes, more than the limit of memory, {most}"
            );
            return Err(unreadable(scene, texture, reason, Some(needed)));
        }
    }
    Ok(())
}

/// A decoded picture, kept for the next frame of a film while the bytes of its file are in use.
struct Kept {
    bytes: Weak<[u8]>,
    is_opaque: bool,
    levels: Arc<Levels>,
}

fn kept() -> MutexGuard<'static, Vec<Kept>> {
    static KEPT: Mutex<Vec<Kept>> = Mutex::new(Vec::new());
    KEPT.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The texels of a picture, decoded unless they are kept.
fn levels(scene: &Scene, texture: &Texture, memory: u64) -> Result<Arc<Levels>, TextureError> {
    let (bytes, is_opaque) = (&texture.image.bytes, texture.alpha == AlphaMode::Opaque);
    // A weak reference keeps the address, so no other picture has it.
    let is_same = |kept: &&Kept| {
        std::ptr::addr_eq(kept.bytes.as_ptr(), Arc::as_ptr(bytes)) && kept.is_opaque == is_opaque
    };
    if let Some(found) = kept().iter().find(is_same) {
        return Ok(Arc::clone(&found.levels));
    }
    let levels = decoded(scene, texture, memory)?;
    kept().push(Kept { bytes: Arc::downgrade(bytes), is_opaque, levels: Arc::clone(&levels) });
    Ok(levels)
}

fn decoded(scene: &Scene, texture: &Texture, memory: u64) -> Result<Arc<Levels>, TextureError> {
    let limits = PictureLimits { bytes: memory, ..PictureLimits::default() };
    let picture = read_picture(&texture.image.bytes, &limits)
        .map_err(|error| unreadable(scene, texture, error.to_string(), error.needed_memory()))?;
    let is_opaque = texture.alpha == AlphaMode::Opaque;
    let levels = Levels::new(picture.size, picture.pixels, is_opaque).ok_or_else(|| {
        let reason = "there is not enough memory for its mip levels".to_owned();
        unreadable(scene, texture, reason, None)
    })?;
    Ok(Arc::new(levels))
}

fn unreadable(
    scene: &Scene,
    texture: &Texture,
    reason: String,
    needed_memory: Option<u64>,
) -> TextureError {
    let color = scene.names.get(scene.colors[texture.color.index()].name).to_owned();
    let file = texture.image.file.clone().unwrap_or_else(|| color.clone());
    TextureError { file, color, reason, needed_memory }
}

#[cfg(test)]
mod tests {
    use ugscene::TextureImage;

    use super::*;

    /// Frames of a film share the texels of a picture, which are dropped after its bytes are.
    #[test]
    fn texels_are_kept_while_their_picture_is_used() {
        let scene = Scene::default();
        let picture = |red: f32| -> Arc<[u8]> {
            let light = [red, 0.0, 0.0].into_iter().flat_map(f32::to_le_bytes);
            b"PF\n1 1\n-1.0\n".iter().copied().chain(light).collect()
        };
        let texture = |bytes: &Arc<[u8]>| {
            let image = TextureImage { bytes: Arc::clone(bytes), ..TextureImage::default() };
            Texture::new(ColorId::from_index(0), image)
        };
        let of = |texture: &Texture| levels(&scene, texture, 1 << 20).unwrap();
        let (first, other) = (picture(0.5), picture(0.25));
        let found = of(&texture(&first));
        assert!(Arc::ptr_eq(&found, &of(&texture(&first))));
        assert!(!Arc::ptr_eq(&found, &of(&texture(&other))));
        let blended = Texture { alpha: AlphaMode::Blend, ..texture(&first) };
        assert!(!Arc::ptr_eq(&found, &of(&blended)));
        assert!(!Arc::ptr_eq(&found, &of(&texture(&picture(0.5)))), "equal, but another file");
        drop(blended);
        drop(first);
        kept().retain(|kept| kept.bytes.strong_count() > 0);
        assert_eq!(Arc::strong_count(&found), 1);
    }
}
