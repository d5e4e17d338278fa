//! Parsed statements with unresolved names, which are spans of the text.

use std::ops::Range;

use glam::DVec3;
use ugphysics::{Event, InertialFrame, Piece, Velocity};
use ugscene::{Camera, FaceShape, LightKind, RoundShape, SurfaceProperties, Texture};

use crate::source::Span;
use crate::transform::Transform;

/// Vertex references of the contours of one statement.
#[derive(Debug, Default)]
pub(crate) struct References {
    pub names: Vec<Span>,
    /// End of each contour in `names`.
    pub ends: Vec<usize>,
}

impl References {
    pub fn clear(&mut self) {
        self.names.clear();
        self.ends.clear();
    }

    /// Ranges in [`References::names`], one per contour.
    pub fn contours(&self) -> impl Iterator<Item = Range<usize>> {
        let starts = std::iter::once(0).chain(self.ends.iter().copied());
        starts.zip(&self.ends).map(|(start, &end)| start..end)
    }
}

#[derive(Debug)]
pub(crate) enum Statement {
    Vertex(VertexStatement),
    Face(FaceStatement),
    Wire(FaceStatement),
    Color(ColorStatement),
    Mix(MixStatement),
    Table(TableStatement),
    Texture(TextureStatement),
    /// A colour, and the one that it emits.
    Emission([Span; 2]),
    Surface(SurfaceStatement),
    Light(LightStatement),
    Camera(CameraStatement),
    Motion(Box<MotionStatement>),
    Sky(SkyStatement),
    Call(CallStatement),
}

/// `<x y z …>`, a velocity, or `<NAME>`, a motion.
#[derive(Clone, Copy, Debug)]
pub(crate) enum MotionReference {
    Frame(StatedFrame),
    Named(Span),
}

/// A velocity, with what else the text states of the frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StatedFrame {
    pub velocity: Velocity,
    pub at: Option<DVec3>,
    pub turn: DVec3,
    pub shift: Event,
}

impl StatedFrame {
    pub const fn new(velocity: Velocity) -> Self {
        let InertialFrame { turn, shift, .. } = InertialFrame::REST;
        Self { velocity, at: None, turn, shift }
    }

    /// `default`: the reference point if none is stated.
    pub fn about(self, default: DVec3) -> InertialFrame {
        let Self { velocity, at, turn, shift } = self;
        InertialFrame { velocity, at: at.unwrap_or(default), turn, shift }
    }
}

/// A motion; of the options that may not be combined, the last.
#[derive(Debug, Default)]
pub(crate) struct MotionStatement {
    pub name: Span,
    pub at: DVec3,
    pub velocity: Option<Velocity>,
    pub accelerations: Vec<Piece>,
    pub spins: Vec<Piece>,
    /// Centre, axis and rate.
    pub orbit: Option<(DVec3, DVec3, f64)>,
    pub path: Option<PathStatement>,
    /// The motion that it is part of.
    pub on: Option<MotionReference>,
    pub shift: Event,
}

/// The events of a path.
#[derive(Debug)]
pub(crate) enum PathStatement {
    /// `-path FILE`
    File(FileStatement),
    /// `-path < NAME >`: that of another motion.
    Of(Span),
    /// `-path (t x y z …)`
    Events {
        /// Between the parentheses.
        span: Span,
        events: Vec<Event>,
    },
}

#[derive(Debug)]
pub(crate) struct VertexStatement {
    pub name: Span,
    pub position: DVec3,
    pub color: Option<Span>,
    pub normal: Option<DVec3>,
    pub uv: Option<[f32; 2]>,
}

/// A face, or a wire (which has no shading); its contours are in [`References`].
#[derive(Debug, Default)]
pub(crate) struct FaceStatement {
    pub name: Option<Span>,
    pub color: Option<Span>,
    pub shading: Option<ShadingStatement>,
    pub motion: Option<MotionReference>,
    pub shape: FaceShape,
    /// Centre, axis and radius of a round face that is given by numbers; such a face has no
    /// contours.
    pub round: Option<RoundShape>,
    /// The text of a label, which is a wire with one vertex.
    pub text: Option<Span>,
}

/// The light level or surface of a face.
#[derive(Clone, Copy, Debug)]
pub(crate) enum ShadingStatement {
    Level(f64),
    Surface(Span),
}

#[derive(Debug)]
pub(crate) struct ColorStatement {
    pub name: Option<Span>,
    /// The rows of a spectrum refer to `samples`.
    pub value: ugscene::ColorValue,
    pub samples: Vec<[f64; 2]>,
    pub translucency: f64,
}

/// The parts of a mixed colour: its name, and those of the parts with their shares.
#[derive(Debug)]
pub(crate) struct MixStatement {
    pub color: Span,
    pub parts: Vec<(Span, f64)>,
}

/// A colour that changes with own time, and its rows.
#[derive(Debug)]
pub(crate) struct TableStatement {
    pub color: Span,
    pub is_stepped: bool,
    pub period: Option<f64>,
    pub shift: f64,
    pub rows: Vec<(f64, Span)>,
}

/// A colour that is a picture; colour and bytes in `texture` are not set.
#[derive(Debug)]
pub(crate) struct TextureStatement {
    pub color: Span,
    pub file: FileStatement,
    pub texture: Texture,
}

/// The name of a file.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FileStatement {
    /// With quotes, if there are any.
    pub span: Span,
    /// The name without quotes.
    pub name: Span,
}

/// A surface; the name in `surface` is not set.
#[derive(Debug)]
pub(crate) struct SurfaceStatement {
    pub name: Span,
    pub surface: SurfaceProperties,
}

#[derive(Debug)]
pub(crate) struct LightStatement {
    pub name: Option<Span>,
    pub intensity: f64,
    pub kind: LightKind,
    pub color: Option<Span>,
    pub motion: Option<MotionReference>,
}

/// A camera; name and carrier in `camera` are not set.
#[derive(Debug, Default)]
pub(crate) struct CameraStatement {
    pub name: Option<Span>,
    pub camera: Camera,
    /// The motion it moves with.
    pub carrier: Option<Span>,
}

/// A sky.
#[derive(Debug)]
pub(crate) struct SkyStatement {
    /// The name of its file without quotes.
    pub file: Span,
    /// Turns about x, y and z, degrees.
    pub turn: [f64; 3],
}

/// An instance, or an array of them.
#[derive(Debug)]
pub(crate) struct CallStatement {
    pub name: Option<Span>,
    pub definition: Span,
    pub color: Option<Span>,
    pub inner: Transform,
    pub repeat: Repeat,
    pub motion: Option<MotionReference>,
}

/// The number of copies of a definition.
#[derive(Debug)]
pub(crate) enum Repeat {
    /// `i`
    Once,
    /// `a`: the number of copies, and the transformation from one to the next.
    Times(u64, Transform),
}
