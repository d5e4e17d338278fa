//! The flat scene that every program reads and writes, with all names, definitions, instances and
//! arrays resolved.
//!
//! A [`Scene`] is plain data in index buffers. [`SceneBuilder`](crate::SceneBuilder) and the parser
//! establish these invariants, and all code that builds or changes a scene must keep them:
//!
//! - every id is in range, every number finite;
//! - every contour of a face has three vertices or more, every contour of a
//!   wire two or more;
//! - names are unique within colours, within surfaces and within vertices.

use std::ops::Range;

use glam::DVec3;
use ugphysics::Velocity;
use ugphysics::spectrum::InfraredRule;

use super::body::Bodies;
use super::color_table::ColorTable;
use super::contours::Contours;
use super::history::Head;
use super::ids::{BodyId, ColorId, NameId, ShadingId, SurfaceId, VertexId};
use super::names::Names;
use super::shape::{FaceShape, RoundShape};
use super::stage::{HueScale, Stage};
use super::surface::SurfaceProperties;
use super::texture::Texture;

/// A flat UniGrafix scene.
///
/// Two scenes are equal if they are written as the same text; rows of names and contours may
/// differ.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    /// The stage of positions and colours: `(ugstage … )`.
    pub stage: Stage,
    /// Text of every name used below.
    pub names: Names,
    /// `c`, `c_rgb`, `c_xyz`, `c_bb`, `c_spd`, `c_refl`, `c_time`.
    pub colors: Vec<Color>,
    /// Samples of spectra: wavelength in nm, increasing within each spectrum, and value, 0 or more.
    /// Linear between samples, 0 outside.
    pub samples: Vec<[f64; 2]>,
    /// What surfaces reflect in infrared of which only the colour is known; not part of the text.
    pub infrared: InfraredRule,
    /// `c_mix`, by the row of the colour: see [`Scene::mix_of`].
    pub mixes: Vec<Mix>,
    /// `c_time`, by the row of the colour: see [`Scene::table_of`].
    pub color_tables: Vec<ColorTable>,
    /// `c_tex`, by the row of the colour: see [`Scene::texture_of`].
    pub textures: Vec<Texture>,
    /// `c_emit`, by the row of the first: a colour, and the one that its faces emit besides what
    /// they reflect.
    pub emissions: Vec<[ColorId; 2]>,
    /// `surf`.
    pub surfaces: Vec<SurfaceProperties>,
    /// The bodies and their motions.
    pub bodies: Bodies,
    /// `v`. Rows are added by [`Scene::add_vertex`], which keeps the columns below in step.
    pub vertices: Vec<Vertex>,
    /// For each vertex of a scene as seen, its rest position relative to the eye, in the rest frame
    /// of its body and the axes of the scene. Empty if rest positions follow from those seen by
    /// (P4), as they do in a scene from text.
    pub rest: Vec<DVec3>,
    /// For each vertex of a scene as seen with known rest positions, the own time of its body at
    /// emission. Empty if no body is on a world line.
    pub own_times: Vec<f64>,
    /// Contours of faces and wires.
    pub contours: Contours,
    /// `f`.
    pub faces: Vec<Face>,
    /// Light levels and surfaces of faces; stored separately, because few faces have one.
    pub shadings: Vec<Shading>,
    /// `w`.
    pub wires: Vec<Wire>,
    /// `l`.
    pub lights: Vec<Light>,
    /// `cam`.
    pub cameras: Vec<Camera>,
    /// `sky`.
    pub sky: Option<StatedSky>,
    /// Comments at its head: licence and history.
    pub head: Head,
}

/// The names of skies without a file.
pub const NAMED_SKIES: [&str; 3] = ["day", "dusk", "stars"];

/// The sky around the scene, which is not read.
#[derive(Clone, Debug, PartialEq)]
pub struct StatedSky {
    /// The name of its file, or one of [`NAMED_SKIES`].
    pub file: String,
    /// Turns about x, then y, then z, degrees.
    pub turn: [f64; 3],
}

/// A named surface colour.
#[derive(Clone, Debug, PartialEq)]
pub struct Color {
    /// Its name.
    pub name: NameId,
    /// Its value, as given.
    pub value: ColorValue,
    /// Translucency: 0 opaque … 1 invisible.
    pub translucency: f64,
}

/// The mixture that a colour is where colours are spectra. Its own statement says what it is where
/// they are hues, since spectra and hues are mixed differently.
#[derive(Clone, Debug, PartialEq)]
pub struct Mix {
    /// The colour.
    pub color: ColorId,
    /// Its parts: colours, which count as their own statements say, and shares in 0…1.
    pub parts: Vec<(ColorId, f64)>,
}

/// The ways to specify a colour. Numbers are stored as written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ColorValue {
    /// `c`: HSV. Saturation 0 is grey, whatever the tint.
    Hsv {
        /// Lightness V ≥ 0; 1 is full, and larger values are kept.
        value: f64,
        /// Hue or wavelength.
        tint: Tint,
        /// Saturation 0…1.
        saturation: f64,
        /// Factor of its linear light, 0 or more; 1 for what the other three say.
        factor: f64,
    },
    /// `c_rgb`: red, green, blue in 0…1, display-encoded (sRGB).
    Rgb([f64; 3]),
    /// `c_xyz`: CIE 1931 X, Y, Z; Y is 1 for white. Any numbers.
    Xyz([f64; 3]),
    /// `c_bb`: light of a black body.
    Blackbody {
        /// Its temperature, above 0.
        kelvin: f64,
        /// Factor of its light, 0 or more.
        scale: f64,
    },
    /// A sampled spectrum.
    Spectrum {
        /// `c_refl`: of the reflectance of a surface; `c_spd`: of light.
        reflects: bool,
        /// First row of [`Scene::samples`].
        start: u32,
        /// Row after the last sample.
        end: u32,
    },
}

impl ColorValue {
    /// True for what shines by itself where colours are spectra.
    pub fn emits(&self) -> bool {
        matches!(self, Self::Blackbody { .. } | Self::Spectrum { reflects: false, .. })
    }

    /// The same numbers, with that of the tint in another unit.
    #[must_use]
    pub fn with_tint_in(self, unit: HueScale) -> Self {
        match self {
            Self::Hsv { value, tint, saturation, factor } => {
                Self::Hsv { value, tint: Tint::new(tint.number(), unit), saturation, factor }
            }
            other => other,
        }
    }
}

/// The second number of a `c` statement. The text has one unit for all: [`Stage::hue_scale`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Tint {
    /// Hue in degrees, modulo 360.
    Hue(f64),
    /// Wavelength in nm.
    Wavelength(f64),
}

impl Tint {
    /// The tint that a number in this unit stands for.
    pub fn new(number: f64, unit: HueScale) -> Self {
        match unit {
            HueScale::Degrees => Self::Hue(number),
            HueScale::Wavelengths => Self::Wavelength(number),
        }
    }

    /// The number in the text, without its unit.
    pub fn number(self) -> f64 {
        match self {
            Self::Hue(number) | Self::Wavelength(number) => number,
        }
    }
}

/// A vertex.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertex {
    /// Its name, a path (`car:a`) where an instance was expanded.
    pub name: NameId,
    /// Position in scene coordinates.
    pub position: DVec3,
    /// Its own colour; overrides the colours of the faces.
    pub color: Option<ColorId>,
    /// Rest-frame normal for smooth shading; any length except 0.
    pub normal: Option<DVec3>,
    /// Texture coordinates: u to the right and v downwards, from 0 to 1 in the picture.
    pub uv: Option<[f32; 2]>,
}

impl Vertex {
    /// A vertex without normal and texture coordinates. The name is that of row 0.
    pub fn at(position: DVec3, color: Option<ColorId>) -> Self {
        Self { name: NameId::from_index(0), position, color, normal: None, uv: None }
    }
}

/// A planar polygon, with holes if it has more than one contour (even-odd rule), or a round shape.
#[derive(Clone, Debug, PartialEq)]
pub struct Face {
    /// Its name, if it has one; need not be unique.
    pub name: Option<NameId>,
    /// Rows of [`Scene::contours`], never empty. The first is the outline, and
    /// runs counterclockwise seen from outside.
    pub contours: Range<u32>,
    /// Colour; `None` means lightness 1, saturation 0, opaque.
    pub color: Option<ColorId>,
    /// Its light level or surface, see [`Scene::light_level`] and [`Scene::surface`].
    pub shading: Option<ShadingId>,
    /// The body it is part of.
    pub body: BodyId,
    /// What its contours determine.
    pub shape: FaceShape,
    /// Its row in the scene that was read, which its pieces keep; `u32::MAX` if a program added it.
    pub row_as_read: u32,
}

impl Face {
    /// A polygon without name, colour and shading.
    pub fn polygon(contours: Range<u32>, body: BodyId) -> Self {
        let shape = FaceShape::Polygon;
        Self {
            name: None,
            contours,
            color: None,
            shading: None,
            body,
            shape,
            row_as_read: u32::MAX,
        }
    }
}

/// The light level or surface of a face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shading {
    /// Fixed light level: the face is not lit.
    Level(f64),
    /// Reflection properties.
    Surface(SurfaceId),
}

/// Polylines, or a label at a vertex.
#[derive(Clone, Debug, PartialEq)]
pub struct Wire {
    /// Its name, if it has one.
    pub name: Option<NameId>,
    /// Rows of [`Scene::contours`], never empty. Each is an open polyline. A label has a single row
    /// with its vertex.
    pub contours: Range<u32>,
    /// Colour; `None` as for faces.
    pub color: Option<ColorId>,
    /// The body it is part of.
    pub body: BodyId,
    /// The text of a label; without it the wire is drawn as lines.
    pub text: Option<NameId>,
}

/// A light.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    /// Its name, if it has one.
    pub name: Option<NameId>,
    /// Intensity; 1 lights a white face fully.
    pub intensity: f64,
    /// The kind of light, with its direction or position.
    pub kind: LightKind,
    /// Its colour; default white.
    pub color: Option<ColorId>,
    /// Its motion.
    pub motion: LightMotion,
}

/// The motion of a light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LightMotion {
    /// It rests in the frame of whatever it lights, as in the report of 1988. The text gives it no
    /// velocity.
    WithWhatItLights,
    /// It is part of a body, and moves with it.
    Body(BodyId),
}

impl LightMotion {
    /// The body it is part of, if its motion is stated.
    pub fn body(self) -> Option<BodyId> {
        match self {
            Self::WithWhatItLights => None,
            Self::Body(body) => Some(body),
        }
    }
}

/// Kind of light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LightKind {
    /// Ambient light, equal from all directions.
    Ambient,
    /// From infinitely far away; the vector points toward the light, with any length except 0.
    Directional(DVec3),
    /// From a point or a small sphere.
    Local {
        /// Its position in scene coordinates.
        position: DVec3,
        /// Its radius, 0 or more.
        radius: f64,
        /// The distance in its rest frame, above 0, at which its light level is its intensity. The
        /// level falls with the square of the distance; `None`: it is the same at any distance.
        reference: Option<f64>,
        /// The directions and places from which it shines, in its rest frame.
        beam: Beam,
    },
}

/// The directions and places from which a local light shines, in its rest frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Beam {
    /// From its position or sphere, evenly in all directions.
    #[default]
    Even,
    /// In a cone.
    Spot {
        /// Its axis, of any length except 0.
        axis: DVec3,
        /// Degrees from the axis at which light ends, up to 180, and the width of the smooth edge
        /// inside.
        degrees: [f64; 2],
    },
    /// A parallelogram centred at the position, with these two edge vectors u and v. It emits on
    /// the side of u × v, which is not 0, with the same radiance in all directions (Lambertian).
    Area([DVec3; 2]),
}

impl Beam {
    /// False where a number is not finite, an axis 0, or a parallelogram has no area.
    pub fn is_valid(&self) -> bool {
        let has_direction = |vector: DVec3| {
            let largest = vector.abs().max_element();
            vector.is_finite() && largest > 0.0 && (vector / largest).is_finite()
        };
        match *self {
            Self::Even => true,
            Self::Spot { axis, degrees: [angle, edge] } => {
                has_direction(axis)
                    && (0.0..=180.0).contains(&angle)
                    && (0.0..=angle).contains(&edge)
            }
            Self::Area([u, v]) => u.is_finite() && v.is_finite() && has_direction(u.cross(v)),
        }
    }

    /// The same with its vectors changed.
    #[must_use]
    pub fn turned(self, turn: impl Fn(DVec3) -> DVec3) -> Self {
        match self {
            Self::Even => Self::Even,
            Self::Spot { axis, degrees } => Self::Spot { axis: turn(axis), degrees },
            Self::Area(edges) => Self::Area(edges.map(turn)),
        }
    }
}

/// A camera: every field is optional and has a default in the renderer.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Camera {
    /// Its name, if it has one.
    pub name: Option<NameId>,
    /// `-vc`: view centre.
    pub center: Option<DVec3>,
    /// `-ep`: eye point.
    pub eye: Option<DVec3>,
    /// `-ud`: up direction.
    pub up: Option<DVec3>,
    /// `-cl`: near and far clipping distances from the eye along the view direction.
    pub clip: Option<[f64; 2]>,
    /// `-ph`: sub-rectangle of the film, min x, min y, max x, max y in 0…1.
    pub film: Option<[f64; 4]>,
    /// `-og` or `-ps`.
    pub projection: Option<Projection>,
    /// `-va`: full horizontal and vertical view angles, degrees; equal if one is given.
    pub view_angle: Option<[f64; 2]>,
    /// `-fs`: film size.
    pub film_size: Option<[f64; 2]>,
    /// `-fl`: focal length.
    pub focal_length: Option<f64>,
    /// Its velocity in the scene's frame.
    pub velocity: Option<Velocity>,
    /// The body that it moves with, if it has a name in the text instead of a velocity.
    pub carrier: Option<BodyId>,
}

/// Kind of projection.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Projection {
    /// `-og`
    Orthographic,
    /// `-ps`
    Perspective,
}

/// The attributes that faces and wires have in common.
#[derive(Clone, Debug)]
pub struct FaceOrWire {
    /// Rows of the contours.
    pub contours: Range<u32>,
    /// Its own colour, if it has one.
    pub color: Option<ColorId>,
    /// The body it is part of.
    pub body: BodyId,
}

impl Scene {
    /// All faces, then all wires.
    pub fn drawn(&self) -> impl DoubleEndedIterator<Item = FaceOrWire> + Clone {
        let faces = self.faces.iter().map(|face| (&face.contours, face.color, face.body));
        let all =
            faces.chain(self.wires.iter().map(|wire| (&wire.contours, wire.color, wire.body)));
        all.map(|(contours, color, body)| FaceOrWire { contours: contours.clone(), color, body })
    }

    /// All corners of a face, contour after contour.
    #[inline]
    pub fn face_corners(&self, face: &Face) -> &[VertexId] {
        self.contours.corners(face.contours.clone())
    }

    /// The contours of a face, outline first.
    pub fn face_contours(&self, face: &Face) -> impl ExactSizeIterator<Item = &[VertexId]> + Clone {
        self.contours.iter(face.contours.clone())
    }

    /// The shape of a round face whose vertices are at these positions; `None` for a polygon.
    pub fn round_shape(
        &self,
        face: &Face,
        position: impl Fn(VertexId) -> DVec3,
    ) -> Option<RoundShape> {
        if !face.shape.is_round() {
            return None;
        }
        let corners: Vec<DVec3> =
            self.face_corners(face).iter().map(|&corner| position(corner)).collect();
        RoundShape::from_corners(face.shape, &corners)
    }

    /// The shapes of all round faces in the scene, with their bodies.
    pub fn rounds(&self) -> impl Iterator<Item = (BodyId, RoundShape)> {
        self.faces.iter().filter_map(|face| {
            Some((
                face.body,
                self.round_shape(face, |vertex| self.vertices[vertex.index()].position)?,
            ))
        })
    }

    /// True if a face is round.
    pub fn has_rounds(&self) -> bool {
        self.faces.iter().any(|face| face.shape.is_round())
    }

    /// True if a face is round whose body accelerates, turns or runs on a circle. There, rays are
    /// curves, which programs follow to polygons only.
    pub fn has_rounds_on_world_lines(&self) -> bool {
        self.faces
            .iter()
            .any(|face| face.shape.is_round() && self.bodies.is_on_world_line(face.body))
    }

    /// The parts of a colour that is a mixture where colours are spectra; else nothing.
    pub fn mix_of(&self, color: ColorId) -> &[(ColorId, f64)] {
        of_color(&self.mixes, color, |mix| mix.color).map_or(&[], |mix| &mix.parts)
    }

    /// The table of a colour that changes with own time.
    pub fn table_of(&self, color: ColorId) -> Option<&ColorTable> {
        of_color(&self.color_tables, color, |table| table.color)
    }

    /// The picture that a colour is.
    pub fn texture_of(&self, color: ColorId) -> Option<&Texture> {
        of_color(&self.textures, color, |texture| texture.color)
    }

    /// The colour that faces of this colour emit.
    pub fn emitted_by(&self, color: ColorId) -> Option<ColorId> {
        of_color(&self.emissions, color, |emission| emission[0]).map(|emission| emission[1])
    }

    /// The name of the first colour of a face that is a picture, which was read, or emits light.
    pub fn drawn_texture_name(&self) -> Option<&str> {
        let is_empty = self.textures.is_empty() && self.emissions.is_empty();
        let faces = if is_empty { &[][..] } else { &self.faces };
        let is_read =
            |color| self.texture_of(color).is_some_and(|texture| !texture.image.bytes.is_empty());
        let is_drawn = |&color: &ColorId| is_read(color) || self.emitted_by(color).is_some();
        let color = faces.iter().filter_map(|face| face.color).find(is_drawn)?;
        Some(self.names.get(self.colors[color.index()].name))
    }

    /// True if the colour of a face or wire changes with own time.
    pub fn has_changing_surfaces(&self) -> bool {
        let changes =
            |color: Option<ColorId>| color.is_some_and(|color| self.table_of(color).is_some());
        !self.color_tables.is_empty() && self.drawn().any(|drawn| changes(drawn.color))
    }

    /// The fixed light level of a face, if it has one; such a face is not lit.
    pub fn light_level(&self, face: &Face) -> Option<f64> {
        match self.shadings[face.shading?.index()] {
            Shading::Level(level) => Some(level),
            Shading::Surface(_) => None,
        }
    }

    /// The surface of a face, if it has one.
    pub fn surface_id(&self, face: &Face) -> Option<SurfaceId> {
        match self.shadings[face.shading?.index()] {
            Shading::Level(_) => None,
            Shading::Surface(surface) => Some(surface),
        }
    }

    /// The reflection properties of a face, if it has any.
    pub fn surface(&self, face: &Face) -> Option<&SurfaceProperties> {
        self.surface_id(face).map(|surface| &self.surfaces[surface.index()])
    }

    /// Adds a vertex.
    pub fn add_vertex(&mut self, vertex: Vertex) -> VertexId {
        self.vertices.push(vertex);
        VertexId::from_index(self.vertices.len() - 1)
    }

    /// Adds a copy of a vertex, with all that is known of it, under another name.
    pub fn copy_vertex(&mut self, original: VertexId, name: NameId) -> VertexId {
        self.rest.extend(self.rest.get(original.index()).copied());
        self.own_times.extend(self.own_times.get(original.index()).copied());
        self.add_vertex(Vertex { name, ..self.vertices[original.index()] })
    }

    /// The polylines of a wire.
    pub fn wire_contours(&self, wire: &Wire) -> impl ExactSizeIterator<Item = &[VertexId]> + Clone {
        self.contours.iter(wire.contours.clone())
    }

    /// The labels, each with its vertex and text.
    pub fn labels(&self) -> impl Iterator<Item = (VertexId, &str)> {
        self.wires.iter().filter_map(|wire| {
            let vertex = *self.contours.corners(wire.contours.clone()).first()?;
            Some((vertex, self.names.get(wire.text?)))
        })
    }

    /// True if there is a wire that is no label.
    pub fn has_lines(&self) -> bool {
        self.wires.iter().any(|wire| wire.text.is_none())
    }

    /// Row of the selected camera: the first without a name, else the first.
    pub fn camera_row(&self) -> Option<usize> {
        let unnamed = self.cameras.iter().position(|camera| camera.name.is_none());
        unnamed.or((!self.cameras.is_empty()).then_some(0))
    }

    /// The selected camera, see [`Scene::camera_row`].
    pub fn camera(&self) -> Option<&Camera> {
        self.camera_row().map(|row| &self.cameras[row])
    }

    /// Corners of the bounding box of all vertices; `None` without vertices.
    pub fn bounds(&self) -> Option<(DVec3, DVec3)> {
        let first = self.vertices.first()?.position;
        Some(self.vertices.iter().fold((first, first), |(low, high), vertex| {
            (low.min(vertex.position), high.max(vertex.position))
        }))
    }
}

/// The row of a colour in a table in the order of its colours.
fn of_color<T>(rows: &[T], color: ColorId, key: impl Fn(&T) -> ColorId) -> Option<&T> {
    rows.binary_search_by_key(&color, key).ok().map(|row| &rows[row])
}
