//! A scene from arrays, for callers that have no text.

use std::ops::Range;

use glam::DVec3;
use rustc_hash::FxHashSet;
use ugphysics::Velocity;

use crate::words::messages;
use crate::{
    BodyId, Camera, Color, ColorId, ColorValue, Face, Light, LightKind, Scene, Shading, ShadingId,
    SurfaceId, SurfaceProperties, Tint, Vertex, VertexId, unit_normal,
};

/// The most vertices, corners or rows of any other table: ids have 32 bits, and one is for nothing.
const MAX_ROWS: usize = u32::MAX as usize - 1;

/// Builds a [`Scene`] and checks what is added, so that the scene is complete: ids resolve, numbers
/// are finite and in range, names are unique and can be written as text.
///
/// ```
/// use glam::DVec3;
/// use ugphysics::Velocity;
/// use ugscene::{ColorValue, Mesh, SceneBuilder};
///
/// let mut builder = SceneBuilder::default();
/// let red = builder.color("red", ColorValue::Rgb([0.8, 0.1, 0.1]), 0.0)?;
/// let fast = builder.body(Velocity::from_beta(DVec3::new(0.9, 0.0, 0.0))?);
/// builder.mesh(&Mesh {
///     name: "tile",
///     positions: &[DVec3::ZERO, DVec3::X, DVec3::Y],
///     corners: &[0, 1, 2],
///     color: Some(red),
///     body: Some(fast),
///     ..Mesh::default()
/// })?;
/// assert_eq!(builder.finish().faces.len(), 1);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Default)]
pub struct SceneBuilder {
    scene: Scene,
    color_names: FxHashSet<String>,
    surface_names: FxHashSet<String>,
    mesh_names: FxHashSet<String>,
}

/// Faces that share vertices.
#[derive(Clone, Copy, Debug, Default)]
pub struct Mesh<'a> {
    /// Its name; vertices are called `NAME:1`, `NAME:2`, ….
    pub name: &'a str,
    /// Rest positions of the vertices, in scene coordinates.
    pub positions: &'a [DVec3],
    /// Rest normals of the vertices for smooth shading, any length but 0; empty for flat faces.
    pub normals: &'a [DVec3],
    /// Colours of the vertices; empty if they have none of their own.
    pub colors: &'a [ColorId],
    /// Rows of the positions: the corners of the first face, counterclockwise seen from outside,
    /// then those of the second, ….
    pub corners: &'a [u32],
    /// The number of corners of each face, 3 or more; empty for triangles.
    pub sizes: &'a [u32],
    /// Colour of the faces; default white.
    pub color: Option<ColorId>,
    /// Reflection properties of the faces.
    pub surface: Option<SurfaceId>,
    /// The body it is part of; default one whose motion is not stated.
    pub body: Option<BodyId>,
}

/// The part of a scene that a mesh has become.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct AddedMesh {
    /// Rows of its vertices.
    pub vertices: Range<usize>,
    /// Rows of its faces.
    pub faces: Range<usize>,
    /// Number of faces that were left out, because they have no area.
    pub n_degenerate: usize,
}

/// Why something cannot be part of a scene. Rows are counted from 0.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum BuildError {
    /// A name is empty or has other characters than letters, digits, `:`, `_` and `#`, or begins
    /// with a digit.
    Name {
        /// The name.
        name: String,
    },
    /// Two colours, two surfaces or two meshes have the same name.
    Repeated {
        /// The name.
        name: String,
    },
    /// A number is NaN, infinite, or out of its range.
    OutOfRange {
        /// The array, or the property.
        what: &'static str,
        /// The row in it.
        row: usize,
        /// The allowed range.
        range: &'static str,
    },
    /// An array has not as many rows as another.
    Length {
        /// The array.
        what: &'static str,
        /// Its number of rows.
        found: usize,
        /// The number it should have.
        expected: usize,
    },
    /// A corner is no row of the positions, or a colour, surface or body no row of the scene.
    NoRow {
        /// The array.
        what: &'static str,
        /// The row in it.
        row: usize,
        /// The row it refers to.
        id: usize,
        /// The number of rows there are.
        n_rows: usize,
    },
    /// A table would have more rows than ids can express.
    TooMany,
}

messages! { BuildError {
    Self::Name { name } =>
        "`{name}` is not a name of letters, digits, `:`, `_` and `#` that begins with no digit";
    Self::Repeated { name } => "the name `{name}` is used twice";
    Self::OutOfRange { what, row, range } => "{what} {row} is out of range: {range}";
    Self::Length { what, found, expected } => "{found} rows of {what} instead of {expected}";
    Self::NoRow { what, row, id, n_rows } => "{what} {row} refers to row {id} of {n_rows}";
    Self::TooMany => "the scene has too many rows; split it";
} }

impl SceneBuilder {
    /// Adds a colour. `translucency`: 0 opaque … 1 invisible.
    ///
    /// # Errors
    /// See [`BuildError`]. Sampled spectra are added by [`SceneBuilder::spectrum`].
    pub fn color(
        &mut self,
        name: &str,
        value: ColorValue,
        translucency: f64,
    ) -> Result<ColorId, BuildError> {
        let within =
            |numbers: &[f64], high: f64| numbers.iter().all(|number| (0.0..=high).contains(number));
        let (is_valid, range) = match value {
            ColorValue::Hsv {
                value,
                tint: Tint::Hue(tint) | Tint::Wavelength(tint),
                saturation,
                factor,
            } => (
                within(&[value, factor], f64::MAX)
                    && tint.is_finite()
                    && within(&[saturation], 1.0),
                "lightness and factor are 0 or more, saturation is 0 to 1",
            ),
            ColorValue::Rgb(rgb) => (within(&rgb, 1.0), "red, green and blue are 0 to 1"),
            ColorValue::Xyz(xyz) => {
                (xyz.iter().all(|part| part.is_finite()), "X, Y and Z are finite")
            }
            ColorValue::Blackbody { kelvin, scale } => (
                kelvin > 0.0 && kelvin.is_finite() && within(&[scale], f64::MAX),
                "kelvin above 0, scale 0 or more",
            ),
            ColorValue::Spectrum { .. } => (false, "spectra are added with their samples"),
        };
        let row = self.scene.colors.len();
        if !is_valid {
            return Err(BuildError::OutOfRange { what: "colour", row, range });
        }
        if !within(&[translucency], 1.0) {
            return Err(BuildError::OutOfRange {
                what: "translucency of colour",
                row,
                range: "0 to 1",
            });
        }
        self.add_color(name, value, translucency)
    }

    /// Adds a colour by its spectrum. `samples`: wavelengths in nm, increasing, with values of 0 or
    /// more; linear between them, 0 outside.
    ///
    /// # Errors
    /// See [`BuildError`].
    pub fn spectrum(&mut self, name: &str, samples: &[[f64; 2]]) -> Result<ColorId, BuildError> {
        self.sampled(name, samples, false)
    }

    /// Adds the colour of a surface by its reflectance, in the same form; outside, the reflectance
    /// is that of the nearer end.
    ///
    /// # Errors
    /// See [`BuildError`].
    pub fn reflectance(&mut self, name: &str, samples: &[[f64; 2]]) -> Result<ColorId, BuildError> {
        self.sampled(name, samples, true)
    }

    fn sampled(
        &mut self,
        name: &str,
        samples: &[[f64; 2]],
        reflects: bool,
    ) -> Result<ColorId, BuildError> {
        let mut before = 0.0;
        for (row, &[wavelength, value]) in samples.iter().enumerate() {
            if !(wavelength > before && wavelength.is_finite() && (0.0..=f64::MAX).contains(&value))
            {
                let range = "wavelengths increase from above 0, values are 0 or more";
                return Err(BuildError::OutOfRange { what: "sample", row, range });
            }
            before = wavelength;
        }
        let start = self.scene.samples.len();
        if samples.is_empty() {
            return Err(BuildError::Length { what: "samples", found: 0, expected: 1 });
        }
        if samples.len() > MAX_ROWS - start {
            return Err(BuildError::TooMany);
        }
        let end = (start + samples.len()) as u32;
        let id =
            self.add_color(name, ColorValue::Spectrum { reflects, start: start as u32, end }, 0.0)?;
        self.scene.samples.extend_from_slice(samples);
        Ok(id)
    }

    fn add_color(
        &mut self,
        name: &str,
        value: ColorValue,
        translucency: f64,
    ) -> Result<ColorId, BuildError> {
        enter(&mut self.color_names, name)?;
        let name = self.scene.names.add(name);
        self.scene.colors.push(Color { name, value, translucency });
        Ok(ColorId::from_index(self.scene.colors.len() - 1))
    }

    /// Adds reflection properties, with the name `name`.
    ///
    /// # Errors
    /// See [`BuildError`].
    pub fn surface(
        &mut self,
        name: &str,
        surface: SurfaceProperties,
    ) -> Result<SurfaceId, BuildError> {
        if let Some(range) = surface.violated() {
            return Err(BuildError::OutOfRange {
                what: "surface",
                row: self.scene.surfaces.len(),
                range,
            });
        }
        enter(&mut self.surface_names, name)?;
        let name = self.scene.names.add(name);
        self.scene.surfaces.push(SurfaceProperties { name, ..surface });
        Ok(SurfaceId::from_index(self.scene.surfaces.len() - 1))
    }

    /// The body that moves with a velocity in the frame of the scene.
    pub fn body(&mut self, velocity: Velocity) -> BodyId {
        self.scene.bodies.moving_with(velocity)
    }

    /// Adds a mesh, or nothing if it has an error. Faces without area are left out.
    ///
    /// # Errors
    /// See [`BuildError`].
    pub fn mesh(&mut self, mesh: &Mesh<'_>) -> Result<AddedMesh, BuildError> {
        let sizes = self.check(mesh)?;
        enter(&mut self.mesh_names, mesh.name)?;
        let first = self.scene.vertices.len();
        for (row, &position) in mesh.positions.iter().enumerate() {
            let name = self.scene.names.add_parts(&[mesh.name, ":", &(row + 1).to_string()]);
            let (color, normal) = (mesh.colors.get(row).copied(), mesh.normals.get(row).copied());
            self.scene.add_vertex(Vertex { name, position, color, normal, uv: None });
        }
        let shading = mesh.surface.map(|surface| {
            self.scene.shadings.push(Shading::Surface(surface));
            ShadingId::from_index(self.scene.shadings.len() - 1)
        });
        let name = Some(self.scene.names.add(mesh.name));
        let body = mesh.body.unwrap_or(self.scene.bodies.unstated());
        let (first_face, mut rest) = (self.scene.faces.len(), mesh.corners);
        for &size in &sizes {
            let (corners, behind) = rest.split_at(size as usize);
            rest = behind;
            let places = corners.iter().map(|&corner| mesh.positions[corner as usize]);
            if unit_normal(places) == DVec3::ZERO {
                continue;
            }
            let ids = corners.iter().map(|&corner| VertexId::from_index(first + corner as usize));
            let contours = self.scene.contours.push_all([ids]);
            let face = Face { name, color: mesh.color, shading, ..Face::polygon(contours, body) };
            self.scene.faces.push(face);
        }
        let faces = first_face..self.scene.faces.len();
        let n_degenerate = sizes.len() - faces.len();
        Ok(AddedMesh { vertices: first..self.scene.vertices.len(), faces, n_degenerate })
    }

    /// The number of corners of each face of a mesh that can be added.
    fn check(&self, mesh: &Mesh<'_>) -> Result<Vec<u32>, BuildError> {
        let Mesh { positions, normals, colors, corners, .. } = *mesh;
        let n_vertices = positions.len();
        for (what, found) in [("normals", normals.len()), ("colours", colors.len())] {
            if found != 0 && found != n_vertices {
                return Err(BuildError::Length { what, found, expected: n_vertices });
            }
        }
        let too_many = |present: usize, more: usize| more > MAX_ROWS.saturating_sub(present);
        if too_many(self.scene.vertices.len(), n_vertices) || corners.len() > MAX_ROWS {
            return Err(BuildError::TooMany);
        }
        require("position", positions, "finite", |position| position.is_finite())?;
        let is_direction = |normal: &DVec3| normal.is_finite() && *normal != DVec3::ZERO;
        require("normal", normals, "finite, and not 0", is_direction)?;
        let Scene { colors: all_colors, surfaces, bodies, .. } = &self.scene;
        require_rows("corner", 0, corners.iter().map(|&corner| corner as usize), n_vertices)?;
        require_rows(
            "colour of vertex",
            0,
            colors.iter().map(|color| color.index()),
            all_colors.len(),
        )?;
        require_rows("colour of mesh", 0, mesh.color.map(ColorId::index), all_colors.len())?;
        require_rows("surface of mesh", 0, mesh.surface.map(SurfaceId::index), surfaces.len())?;
        require_rows("body of mesh", 0, mesh.body.map(BodyId::index), bodies.len())?;
        let sizes = if mesh.sizes.is_empty() {
            vec![3; corners.len().div_ceil(3)]
        } else {
            mesh.sizes.to_vec()
        };
        require("size of face", &sizes, "3 or more", |size| *size >= 3)?;
        let expected = sizes.iter().map(|&size| size as usize).fold(0, usize::saturating_add);
        if expected != corners.len() {
            return Err(BuildError::Length { what: "corners", found: corners.len(), expected });
        }
        Ok(sizes)
    }

    /// Adds a light without a name. Its body and colour, if any, are of this builder.
    ///
    /// # Errors
    /// See [`BuildError`].
    pub fn light(&mut self, light: Light) -> Result<(), BuildError> {
        let positive = |number: f64| number > 0.0 && number.is_finite();
        let is_valid = match light.kind {
            LightKind::Ambient => true,
            LightKind::Directional(toward) => toward.is_finite() && toward != DVec3::ZERO,
            LightKind::Local { position, radius, reference, beam } => {
                let has_size = (0.0..=f64::MAX).contains(&radius) && reference.is_none_or(positive);
                position.is_finite() && has_size && beam.is_valid()
            }
        };
        let row = self.scene.lights.len();
        if !is_valid || !light.intensity.is_finite() {
            let range =
                "finite, a direction not 0, a radius 0 or more, a reference distance above 0";
            return Err(BuildError::OutOfRange { what: "light", row, range });
        }
        require_rows(
            "colour of light",
            row,
            light.color.map(ColorId::index),
            self.scene.colors.len(),
        )?;
        require_rows(
            "body of light",
            row,
            light.motion.body().map(BodyId::index),
            self.scene.bodies.len(),
        )?;
        self.scene.lights.push(Light { name: None, ..light });
        Ok(())
    }

    /// Adds a camera without a name.
    ///
    /// # Errors
    /// [`BuildError::OutOfRange`] for numbers that are not finite. Whether it can show anything is
    /// checked by the renderer.
    pub fn camera(&mut self, camera: Camera) -> Result<(), BuildError> {
        let points = [camera.center, camera.eye, camera.up];
        let pairs = [camera.clip, camera.view_angle, camera.film_size];
        let numbers = (points.into_iter().flatten().flat_map(|point| point.to_array()))
            .chain(pairs.into_iter().flatten().flatten())
            .chain(camera.film.into_iter().flatten())
            .chain(camera.focal_length);
        if !numbers.into_iter().all(f64::is_finite) {
            let row = self.scene.cameras.len();
            return Err(BuildError::OutOfRange { what: "camera", row, range: "finite" });
        }
        self.scene.cameras.push(Camera { name: None, ..camera });
        Ok(())
    }

    /// The scene.
    pub fn finish(self) -> Scene {
        self.scene
    }
}

/// Checks the rows of an array.
fn require<T>(
    what: &'static str,
    rows: &[T],
    range: &'static str,
    is_valid: impl Fn(&T) -> bool,
) -> Result<(), BuildError> {
    let wrong = rows.iter().position(|row| !is_valid(row));
    wrong.map_or(Ok(()), |row| Err(BuildError::OutOfRange { what, row, range }))
}

/// Checks ids from row `first` on, which refer to a table of `n_rows` rows.
fn require_rows(
    what: &'static str,
    first: usize,
    ids: impl IntoIterator<Item = usize>,
    n_rows: usize,
) -> Result<(), BuildError> {
    let wrong = (first..).zip(ids).find(|(_, id)| *id >= n_rows);
    wrong.map_or(Ok(()), |(row, id)| Err(BuildError::NoRow { what, row, id, n_rows }))
}

/// Checks a name and adds it to those in use.
fn enter(names: &mut FxHashSet<String>, name: &str) -> Result<(), BuildError> {
    let is_letter = |byte: u8| byte.is_ascii_alphanumeric() || b":_#".contains(&byte);
    let is_name = name.bytes().all(is_letter)
        && name.bytes().next().is_some_and(|first| !first.is_ascii_digit());
    if !is_name {
        return Err(BuildError::Name { name: name.to_owned() });
    }
    if !names.insert(name.to_owned()) {
        return Err(BuildError::Repeated { name: name.to_owned() });
    }
    Ok(())
}
