//! Parsed statements that become no row of a scene, or not before names are resolved. Names are
//! spans of the text.

use glam::DVec3;
use ugphysics::{Event, InertialFrame, Piece, Velocity};
use ugscene::{ColorId, CurveKind};

use crate::request::RequestKind;
use crate::source::Span;
use crate::transform::Transform;

/// What a name in a statement refers to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum NameKind {
    /// The statement itself.
    Own,
    Color,
    Surface,
    Vertex,
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

/// A motion.
#[derive(Debug, Default)]
pub(crate) struct MotionStatement {
    pub name: Span,
    pub at: DVec3,
    /// The option that states the path: `vel` for `acc`, too.
    pub path_word: Option<&'static str>,
    pub velocity: Velocity,
    pub accelerations: Vec<Piece>,
    pub spins: Vec<Piece>,
    pub path: Option<PathStatement>,
    /// The motion that it is part of.
    pub on: Option<MotionReference>,
    pub shift: Event,
}

/// A path other than one of constant velocity or acceleration.
#[derive(Debug)]
pub(crate) enum PathStatement {
    /// A kind of curve, and its numbers.
    Curve(&'static CurveKind, Vec<f64>),
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

/// The name of a file.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FileStatement {
    /// With quotes, if there are any.
    pub span: Span,
    /// The name without quotes.
    pub name: Span,
}

impl FileStatement {
    pub fn request(self, kind: RequestKind) -> RequestStatement {
        RequestStatement { kind, span: self.span, file: self.name, motion: None, row: None }
    }
}

/// `include FILE ;`, `execute FILE ;`, or the file of `-path FILE`, `c_tex` or `sky`; the text
/// that replaces it takes the place of `span`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RequestStatement {
    pub kind: RequestKind,
    pub span: Span,
    /// The file name without quotes.
    pub file: Span,
    /// Of a path, the name of its motion.
    pub motion: Option<Span>,
    /// Of a picture within a mesh, its row.
    pub row: Option<u32>,
}

/// An instance, or an array of them.
#[derive(Debug)]
pub(crate) struct Call {
    pub name: Option<Span>,
    pub definition: Span,
    pub color: Option<ColorId>,
    pub inner: Transform,
    pub repeat: Repeat,
    pub motion: Option<MotionReference>,
    /// How many rows the tables of its scope had where it stands in the text.
    pub before: Counts,
    /// The scope of its definition, if that is defined, and its name in paths; after resolution.
    pub target: Option<usize>,
    pub label: String,
}

/// Numbers of rows in the tables that are expanded in the order of the text.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Counts {
    pub faces: usize,
    pub wires: usize,
    pub lights: usize,
    pub cameras: usize,
    pub passed_on: usize,
}

/// The number of copies of a definition.
#[derive(Debug)]
pub(crate) enum Repeat {
    /// `i`
    Once,
    /// `a`: the number of copies, and the transformation from one to the next.
    Times(u64, Transform),
}
