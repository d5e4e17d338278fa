//! Builds a scene from mesh data.

use glam::DVec3;
use rustc_hash::FxHashMap;
use ugphysics::{linear_srgb_to_xyz, srgb_encode};
use ugpipe::printable;
use ugscene::{
    AlphaMode, Camera, Color, ColorId, ColorValue, Face, Light, NameId, Scene, Shading, ShadingId,
    Texture, UniqueNames, Vertex, VertexId, shorten, unit_normal,
};

use crate::error::Problem;
use crate::{Lines, MeshScene};

/// Largest number of vertices of a mesh (about 6 GB of scene). A damaged or malicious file must
/// cause an error, not exhaust the memory.
const MAX_VERTICES: usize = 1 << 26;
/// Largest number of face corners of a mesh.
const MAX_CORNERS: usize = 1 << 29;

/// Largest number of warnings about a mesh.
const MAX_WARNINGS: usize = 20;

/// Red, green and blue, display-encoded, and alpha.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Rgba(pub [f64; 4]);

impl Rgba {
    pub fn opaque([red, green, blue]: [f64; 3]) -> Self {
        Self([red, green, blue, 1.0])
    }
}

/// Builds a scene and ensures the invariants of [`Scene`]: finite numbers, faces with three corners
/// or more, unique names.
#[derive(Default)]
pub(crate) struct Builder {
    scene: Scene,
    /// Prefix of names, including its `_`.
    prefix: String,
    /// The colours so far, by their material, the bits of their clipped components, and their
    /// texture and what they emit.
    colors: FxHashMap<(String, [u64; 4], String, Option<ColorId>), ColorId>,
    color_names: UniqueNames,
    /// The name of the following faces.
    face_name: Option<NameId>,
    /// The line of the statement that is read; 0 in binary files.
    pub line: u32,
    lines: Lines,
    n_corners: usize,
    n_degenerate: usize,
    n_clipped: usize,
    /// Colours with a number that is NaN.
    n_nan_colors: usize,
    /// The following faces are not lit, but emit their colour.
    pub is_unlit: bool,
    /// What there is besides faces, for the error if there are none.
    pub others: Others,
    warnings: Vec<String>,
}

/// What a mesh has that is not drawn.
#[derive(Default)]
pub(crate) struct Others {
    pub has_points: bool,
    pub has_lines: bool,
    pub has_splats: bool,
}

impl Builder {
    pub fn new(prefix: &str) -> Self {
        let prefix = if prefix.is_empty() { String::new() } else { format!("{prefix}_") };
        Self { prefix, ..Self::default() }
    }

    /// Adds a vertex. A zero, NaN or infinite normal is dropped.
    pub fn vertex(
        &mut self,
        position: DVec3,
        normal: Option<DVec3>,
        color: Option<Rgba>,
    ) -> Result<VertexId, Problem> {
        let row = self.scene.vertices.len();
        if !position.is_finite() {
            return Err(Problem::new(format!(
                "the position of vertex {} is not finite; repair the mesh",
                row + 1
            )));
        }
        if row == MAX_VERTICES {
            return Err(Problem::new(format!("more than {MAX_VERTICES} vertices; split the mesh")));
        }
        let name = self.scene.names.add(&format!("{}v{}", self.prefix, row + 1));
        let color = color.and_then(|color| self.color(color));
        let normal = normal.and_then(usable_normal);
        self.scene.vertices.push(Vertex {
            name,
            position: without_sign_of_zero(position),
            color,
            normal,
            uv: None,
        });
        self.lines.vertices.push(self.line);
        Ok(VertexId::from_index(row))
    }

    /// The vertex with the index `idx`, counted from 0, if there is one.
    pub fn vertex_at(&self, idx: u64) -> Option<VertexId> {
        (idx < self.n_vertices() as u64).then(|| VertexId::from_index(idx as usize))
    }

    pub fn n_vertices(&self) -> usize {
        self.scene.vertices.len()
    }

    pub fn set_normal(&mut self, id: VertexId, normal: Option<DVec3>) {
        self.scene.vertices[id.index()].normal = normal.and_then(usable_normal);
    }

    /// Texture coordinates; those that are not finite are dropped.
    pub fn set_uv(&mut self, id: VertexId, uv: Option<[f32; 2]>) {
        self.scene.vertices[id.index()].uv = uv.filter(|uv| uv.iter().all(|part| part.is_finite()));
    }

    /// Adds a copy of a vertex with another normal and other texture coordinates.
    pub fn copy(
        &mut self,
        id: VertexId,
        normal: Option<DVec3>,
        uv: Option<[f32; 2]>,
    ) -> Result<VertexId, Problem> {
        let Vertex { position, color, .. } = self.scene.vertices[id.index()];
        let copy = self.vertex(position, normal, None)?;
        self.scene.vertices[copy.index()].color = color;
        self.set_uv(copy, uv);
        Ok(copy)
    }

    /// The id of a colour without a name; equal colours share one. `None` for a colour with NaN.
    pub fn color(&mut self, rgba: Rgba) -> Option<ColorId> {
        if rgba.0.iter().any(|part| part.is_nan()) {
            self.n_nan_colors += 1;
            return None;
        }
        Some(self.material(rgba, "", None, None))
    }

    /// The id of the colour of a material, which gets its name; materials of the same name share
    /// one if their colours, textures and `emitted` are equal. The colour of a texture is not set.
    pub fn material(
        &mut self,
        Rgba(rgba): Rgba,
        name: &str,
        texture: Option<Texture>,
        emitted: Option<ColorId>,
    ) -> ColorId {
        let clipped = rgba.map(|part| if part.is_nan() { 0.0 } else { part.clamp(0.0, 1.0) + 0.0 });
        let name = scene_name(name);
        let texture_key = texture.as_ref().map_or(
            String::new(),
            |Texture { image, wrap, factor, alpha, is_nearest, .. }| {
                format!("{:?} {wrap:?} {factor:?} {alpha:?} {is_nearest}", image.bytes.as_ptr())
            },
        );
        let key = (name, clipped.map(f64::to_bits), texture_key, emitted);
        if let Some(&known) = self.colors.get(&key) {
            return known;
        }
        self.n_clipped += usize::from(clipped != rgba);
        let [red, green, blue, alpha] = clipped;
        let row = self.scene.colors.len();
        let wanted = if key.0.is_empty() { format!("c{}", row + 1) } else { key.0.clone() };
        let name = self.color_names.add(format!("{}{wanted}", self.prefix), &mut self.scene.names);
        let value = ColorValue::Rgb([red, green, blue]);
        self.scene.colors.push(Color { name, value, translucency: 1.0 - alpha });
        let id = ColorId::from_index(row);
        self.colors.insert(key, id);
        self.scene.textures.extend(texture.map(|texture| Texture { color: id, ..texture }));
        self.scene.emissions.extend(emitted.map(|emitted| [id, emitted]));
        id
    }

    /// The colour that a material of this name emits, linear and possibly above 1; `None` if that
    /// is black. `texture`: factors of 0 or more, and the mean of the picture.
    pub fn emitted(
        &mut self,
        factor: [f64; 3],
        name: &str,
        picture: Option<(Texture, [f64; 3])>,
    ) -> Option<ColorId> {
        let factor = factor.map(|part| if part.is_finite() { part.max(0.0) } else { 0.0 });
        let mean = picture.as_ref().map_or([1.0; 3], |picture| picture.1);
        let light: [f64; 3] = std::array::from_fn(|at| factor[at] * mean[at]);
        let most = light.into_iter().fold(0.0, f64::max);
        if most <= 0.0 {
            return None;
        }
        let [red, green, blue] = factor.map(|part| part as f32);
        let texture =
            picture.map(|(texture, _)| Texture { factor: [red, green, blue, 1.0], ..texture });
        let scale = most.max(1.0);
        let name =
            if scale > 1.0 { format!("{name}_light_{most}") } else { format!("{name}_light") };
        let [red, green, blue] = light.map(|part| srgb_encode(part / scale));
        let id = self.material(Rgba([red, green, blue, 1.0]), &name, texture, None);
        if scale > 1.0 {
            self.scene.colors[id.index()].value = ColorValue::Xyz(linear_srgb_to_xyz(light));
        }
        Some(id)
    }

    /// True if a colour, or what it emits, is a picture.
    pub fn has_texture(&self, color: ColorId) -> bool {
        let emitted = self.scene.emitted_by(color);
        [Some(color), emitted]
            .into_iter()
            .flatten()
            .any(|color| self.scene.texture_of(color).is_some())
    }

    /// The name of the following faces: that of their object or group. Nothing remains of a name
    /// without letters and digits.
    pub fn name_faces(&mut self, name: &str) {
        let name = scene_name(name);
        self.face_name =
            (!name.is_empty()).then(|| self.scene.names.add_parts(&[&self.prefix, &name]));
    }

    /// A name of a camera or light; `None` if nothing remains of it.
    pub fn name(&mut self, name: &str) -> Option<NameId> {
        let name = scene_name(name);
        (!name.is_empty()).then(|| self.scene.names.add_parts(&[&self.prefix, &name]))
    }

    pub fn light(&mut self, light: Light) {
        self.scene.lights.push(light);
    }

    pub fn camera(&mut self, camera: Camera) {
        self.scene.cameras.push(camera);
    }

    /// The scene so far.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Counts corners toward the limit, also those of faces without area, which a small glTF file
    /// can use any number of times.
    pub fn count_corners(&mut self, n: usize) -> Result<(), Problem> {
        self.n_corners = self.n_corners.saturating_add(n);
        if self.n_corners > MAX_CORNERS {
            return Err(Problem::new(format!(
                "more than {MAX_CORNERS} corners of faces; split the mesh"
            )));
        }
        Ok(())
    }

    /// Adds a face, unless it has no area. Consecutive repeated corners count once.
    pub fn face(&mut self, corners: &[VertexId], color: Option<ColorId>) -> Result<(), Problem> {
        self.count_corners(corners.len())?;
        let mut corners = corners.to_vec();
        corners.dedup();
        while corners.len() > 1 && corners.first() == corners.last() {
            corners.pop();
        }
        let places = corners.iter().map(|corner| self.scene.vertices[corner.index()].position);
        if corners.len() < 3 || unit_normal(places) == DVec3::ZERO {
            self.n_degenerate += 1;
            return Ok(());
        }
        let contours = self.scene.contours.push_all([corners]);
        let face = Face::polygon(contours, self.scene.bodies.unstated());
        if self.is_unlit && self.scene.shadings.is_empty() {
            self.scene.shadings.push(Shading::Level(1.0));
        }
        let shading = self.is_unlit.then(|| ShadingId::from_index(0));
        self.scene.faces.push(Face { name: self.face_name, color, shading, ..face });
        self.lines.faces.push(self.line);
        Ok(())
    }

    /// Adds a comment of the source to the head of the scene, such as its licence.
    pub fn comment(&mut self, text: &str) {
        // Braces would end the UniGrafix comment.
        let text = text.trim().replace('{', "(").replace('}', ")").replace('\t', " ");
        let text = text.lines().map(printable).collect::<Vec<_>>().join("\n");
        if !text.is_empty() {
            self.scene.head.comments.push(format!(" {text} "));
        }
    }

    pub fn warn(&mut self, text: impl Into<String>) {
        self.warnings.push(text.into());
    }

    /// Adds a warning, unless it is there.
    pub fn warn_once(&mut self, text: &str) {
        if !self.warnings.iter().any(|known| known == text) {
            self.warn(text);
        }
    }

    /// Adds a warning with a count, `3 lines are left out`, unless the count is 0.
    pub fn warn_count(&mut self, count: usize, one: &str, many: &str) {
        match count {
            0 => {}
            1 => self.warn(format!("1 {one}")),
            _ => self.warn(format!("{count} {many}")),
        }
    }

    /// The mesh, with the axes of its file.
    ///
    /// # Errors
    /// It has nothing that is drawn.
    pub fn finish(mut self, notes: Vec<String>) -> Result<MeshScene, Problem> {
        let has_more = !self.scene.lights.is_empty() || !self.scene.cameras.is_empty();
        if self.scene.faces.is_empty() {
            let what = self.nothing_to_draw();
            if !has_more {
                return Err(Problem::new(what));
            }
            self.warn(what);
        } else {
            self.warn_count(
                self.n_degenerate,
                "face without area is left out",
                "faces without area are left out",
            );
        }
        self.warn_count(
            self.n_clipped,
            "colour is outside 0…1 and clipped",
            "colours are outside 0…1 and clipped",
        );
        self.warn_count(
            self.n_nan_colors,
            "colour is not a number (NaN) and left out",
            "colours are not numbers (NaN) and left out",
        );
        self.show_if_all_is_transparent();
        let n_more = self.warnings.len().saturating_sub(MAX_WARNINGS);
        self.warnings.truncate(MAX_WARNINGS);
        if n_more > 0 {
            self.warn(format!("… and {n_more} more"));
        }
        Ok(MeshScene { scene: self.scene, lines: self.lines, warnings: self.warnings, notes })
    }

    /// Why a mesh without faces has none.
    fn nothing_to_draw(&self) -> String {
        let Others { has_points, has_lines, has_splats } = self.others;
        let n_vertices = self.n_vertices();
        if has_splats {
            "the mesh has no faces, only Gaussian splats; convert them to a mesh".to_owned()
        } else if self.n_degenerate > 0 {
            format!("the mesh has no faces with an area: all {} are left out", self.n_degenerate)
        } else if has_lines {
            "the mesh has no faces, only lines; give them a thickness".to_owned()
        } else if n_vertices > 0 || has_points {
            let points = match n_vertices {
                0 => "points".to_owned(),
                1 => "1 point".to_owned(),
                count => format!("{count} points"),
            };
            format!("the mesh has no faces, only {points}; make a surface of the cloud first")
        } else {
            "the mesh has no faces: it is empty".to_owned()
        }
    }

    /// Makes a mesh opaque of which nothing could be seen: scanners write `Tr 1` and alpha 0 for
    /// opaque.
    fn show_if_all_is_transparent(&mut self) {
        let Scene { faces, vertices, contours, colors, textures, names, .. } = &mut self.scene;
        let is_clear = |color: Option<ColorId>| {
            color.is_some_and(|color| colors[color.index()].translucency == 1.0)
        };
        let texture_of = |color: ColorId| textures.iter().find(|texture| texture.color == color);
        let is_hidden = |face: &Face| match face.color.and_then(texture_of) {
            Some(Texture { alpha: AlphaMode::Blend, factor, .. }) => factor[3] == 0.0,
            Some(Texture { alpha: AlphaMode::Mask(cutoff), factor, .. }) => factor[3] < *cutoff,
            Some(Texture { alpha: AlphaMode::Opaque, .. }) => false,
            None => contours
                .corners(face.contours.clone())
                .iter()
                .all(|corner| is_clear(vertices[corner.index()].color.or(face.color))),
        };
        if faces.is_empty() || !faces.iter().all(is_hidden) {
            return;
        }
        let name = faces.iter().find_map(|face| face.color);
        let name = name.map(|color| names.get(colors[color.index()].name));
        let name = name.map_or(String::new(), |name| format!(", as `{}` is", shorten(name)));
        for texture in textures {
            (texture.factor[3], texture.alpha) = (1.0, AlphaMode::Opaque);
        }
        colors.iter_mut().for_each(|color| color.translucency = 0.0);
        self.warn(format!(
            "all faces are wholly transparent{name} (`Tr 1`, `d 0` or alpha 0): they are drawn opaque"
        ));
    }
}

/// Longest name in bytes that a name of a mesh becomes: every face repeats it.
const MAX_NAME: usize = 64;

/// The name that a scene can have for a name in a mesh: other characters than letters and digits
/// become `_`, and so does a digit's place at the beginning. Empty if there are only such
/// characters.
fn scene_name(name: &str) -> String {
    if !name.contains(|c: char| c.is_ascii_alphanumeric()) {
        return String::new();
    }
    let lead = if name.starts_with(|c: char| c.is_ascii_digit()) { "_" } else { "" };
    let allowed = |c: char| if c.is_ascii_alphanumeric() { c } else { '_' };
    lead.chars().chain(name.chars().map(allowed)).take(MAX_NAME).collect()
}

/// The normal, if it is finite and not zero.
fn usable_normal(normal: DVec3) -> Option<DVec3> {
    (normal.is_finite() && normal.length_squared() > 0.0).then(|| without_sign_of_zero(normal))
}

/// Replaces −0 by 0: the sign has no meaning here but would appear in the text.
fn without_sign_of_zero(v: DVec3) -> DVec3 {
    v + DVec3::ZERO
}
