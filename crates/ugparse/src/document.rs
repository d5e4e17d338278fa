//! A scene as written: statements in order, names as spans of the text.
//!
//! The tables mirror the text; nothing is looked up yet. Vertex references of
//! all contours share one buffer, so that a face costs no allocation.

use std::ops::Range;

use glam::DVec3;

use crate::scene::{Camera, Projection};
use crate::source::Span;
use crate::transform::Transform;

/// The whole text, statement by statement.
#[derive(Debug, Default)]
pub(crate) struct Document {
    /// Row 0 is the file itself, the others are its definitions in the order
    /// of their `def`s.
    pub groups: Vec<Group>,
    /// Vertex references of all contours.
    pub references: Vec<Span>,
    /// End of each contour in `references`.
    pub contour_ends: Vec<u32>,
    /// Comments in order.
    pub comments: Vec<CommentSpan>,
}

impl Document {
    /// The rows of [`Document::references`] that a contour has.
    pub fn contour(&self, contour: u32) -> Range<usize> {
        let contour = contour as usize;
        let start = if contour == 0 { 0 } else { self.contour_ends[contour - 1] as usize };
        start..self.contour_ends[contour] as usize
    }
}

/// The statements of a file or a definition.
#[derive(Debug, Default)]
pub(crate) struct Group {
    /// Name of the definition; empty for the file.
    pub name: Span,
    /// The group this one is defined in.
    pub parent: Option<usize>,
    pub statements: Vec<Node>,
}

/// A statement and where it stands.
#[derive(Debug)]
pub(crate) struct Node {
    pub span: Span,
    pub statement: Statement,
}

/// A comment: the text between its braces.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CommentSpan {
    pub text: Span,
    /// It begins on the line on which a statement ends.
    pub trailing: bool,
}

#[derive(Debug)]
pub(crate) enum Statement {
    Vertex(VertexStatement),
    Face(FaceStatement),
    Wire(FaceStatement),
    Color(ColorStatement),
    Light(LightStatement),
    Camera(CameraStatement),
    Call(CallStatement),
    /// Row of [`Document::groups`].
    Definition(usize),
    /// Text between the parentheses.
    Escape(Span),
    /// A statement nobody here knows, passed on under `-lax`.
    Unknown,
}

#[derive(Debug)]
pub(crate) struct VertexStatement {
    pub name: Span,
    pub position: DVec3,
    pub color: Option<Span>,
    pub normal: Option<DVec3>,
}

/// A face, or a wire (which has no `illum`).
#[derive(Debug)]
pub(crate) struct FaceStatement {
    pub name: Option<Span>,
    /// Rows of [`Document::contour_ends`].
    pub contours: Range<u32>,
    pub color: Option<Span>,
    pub illum: Option<f64>,
    pub velocity: Option<DVec3>,
}

#[derive(Debug)]
pub(crate) struct ColorStatement {
    pub name: Option<Span>,
    pub value: crate::scene::ColorValue,
    pub translucency: f64,
}

#[derive(Debug)]
pub(crate) struct LightStatement {
    pub name: Option<Span>,
    pub intensity: f64,
    pub vector: Option<DVec3>,
    pub radius: Option<f64>,
    pub color: Option<Span>,
    pub velocity: Option<DVec3>,
}

#[derive(Debug, Default)]
pub(crate) struct CameraStatement {
    pub name: Option<Span>,
    pub center: Option<DVec3>,
    pub eye: Option<DVec3>,
    pub up: Option<DVec3>,
    pub clip: Option<[f64; 2]>,
    pub film: Option<[f64; 4]>,
    pub projection: Option<Projection>,
    pub view_angle: Option<[f64; 2]>,
    pub film_size: Option<[f64; 2]>,
    pub focal_length: Option<f64>,
    pub velocity: Option<DVec3>,
}

impl CameraStatement {
    /// The camera in a frame that `transform` maps to the scene's; its name
    /// and velocity are the caller's.
    pub fn placed(&self, transform: &Transform) -> Camera {
        Camera {
            name: None,
            center: self.center.map(|p| transform.point(p)),
            eye: self.eye.map(|p| transform.point(p)),
            up: self.up.map(|d| transform.direction(d)),
            clip: self.clip,
            film: self.film,
            projection: self.projection,
            view_angle: self.view_angle,
            film_size: self.film_size,
            focal_length: self.focal_length,
            velocity: None,
        }
    }
}

/// An instance, or an array of them.
#[derive(Debug)]
pub(crate) struct CallStatement {
    pub name: Option<Span>,
    pub definition: Span,
    pub color: Option<Span>,
    pub inner: Transform,
    pub repeat: Repeat,
    pub velocity: Option<DVec3>,
}

/// How often a definition is placed.
#[derive(Debug)]
pub(crate) enum Repeat {
    /// `i`
    Once,
    /// `a`: this many copies, each moved on by the step.
    Times(u64, Transform),
}
