//! Shapes of one colour each, in painting order.

use std::borrow::Cow;

use crate::figure::{Element, Point, Rgb, Text};

use crate::label::text::{Line, contours};

/// A list of shapes to be painted over an image.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Drawing {
    /// The shapes, in painting order.
    pub shapes: Vec<Shape>,
}

/// A shape of one colour.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// An area, filled by the even-odd rule.
    Area {
        /// The outlines.
        contours: Vec<Vec<Point>>,
        /// The fill colour.
        color: Rgb,
    },
    /// Lines with butt ends. Overlapping lines are painted as one shape.
    Lines {
        /// The two ends of each line.
        lines: Vec<[Point; 2]>,
        /// Their width in pixels.
        width: f64,
        /// Their colour.
        color: Rgb,
    },
    /// A line of text.
    Text(Text),
}

impl Shape {
    /// Its colour.
    pub fn color(&self) -> Rgb {
        match self {
            Self::Area { color, .. }
            | Self::Lines { color, .. }
            | Self::Text(Text { color, .. }) => *color,
        }
    }

    /// The same shape with text as areas, the outlines of its letters.
    pub fn outlined(&self) -> Cow<'_, Self> {
        match self {
            Self::Text(text) => {
                Cow::Owned(Self::Area { contours: contours(text), color: text.color })
            }
            Self::Area { .. } | Self::Lines { .. } => Cow::Borrowed(self),
        }
    }
}

/// The form of text in vector figures.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TextForm {
    /// Areas, the outlines of its letters.
    #[default]
    Outlines,
    /// Text, which can be searched and edited, in an embedded font.
    Text,
}

impl Drawing {
    /// Adds an area with one outline.
    pub fn area(&mut self, outline: Vec<Point>, color: Rgb) {
        self.shapes.push(Shape::Area { contours: vec![outline], color });
    }

    /// Adds a rectangle.
    pub fn rectangle(&mut self, [left, top]: Point, [right, bottom]: Point, color: Rgb) {
        self.area(vec![[left, top], [right, top], [right, bottom], [left, bottom]], color);
    }

    /// Adds lines.
    pub fn lines(&mut self, lines: Vec<[Point; 2]>, width: f64, color: Rgb) {
        if !lines.is_empty() {
            self.shapes.push(Shape::Lines { lines, width, color });
        }
    }

    /// Adds a line of text whose baseline begins at `origin`. Symbols of physics are slanted.
    pub fn text(&mut self, line: &Line, origin: Point, color: Rgb) {
        self.shapes.extend(line.at(origin, color).map(Shape::Text));
    }

    /// Adds an arrow from one point to another; `width` is the width of its shaft.
    pub fn arrow(&mut self, [from, to]: [Point; 2], width: f64, color: Rgb) {
        let (x, y) = (to[0] - from[0], to[1] - from[1]);
        let length = libm::hypot(x, y);
        if length <= 0.0 {
            return;
        }
        let (x, y) = (x / length, y / length);
        let head = (6.0 * width).min(0.7 * length);
        let neck = [to[0] - head * x, to[1] - head * y];
        let side = |by: f64| [neck[0] - by * y, neck[1] + by * x];
        // The shaft ends inside the head, so that there is no gap between them.
        let end = [neck[0] + 0.5 * head * x, neck[1] + 0.5 * head * y];
        self.lines(vec![[from, end]], width, color);
        self.area(vec![to, side(0.42 * head), side(-0.42 * head)], color);
    }

    /// Adds the shapes of another drawing, whose upper left corner is at `corner`.
    pub fn push(&mut self, other: Self, corner: Point) {
        let moved = |point: &mut Point| (0..2).for_each(|axis| point[axis] += corner[axis]);
        self.shapes.extend(other.shapes.into_iter().map(|mut shape| {
            match &mut shape {
                Shape::Area { contours, .. } => contours.iter_mut().flatten().for_each(moved),
                Shape::Lines { lines, .. } => lines.iter_mut().flatten().for_each(moved),
                Shape::Text(text) => moved(&mut text.origin),
            }
            shape
        }));
    }

    /// The shapes as elements of a vector figure.
    pub fn elements<S>(&self, form: TextForm) -> Vec<Element<S>> {
        let mut elements = Vec::new();
        for shape in &self.shapes {
            match shape {
                Shape::Text(text) if text.text.trim().is_empty() => {}
                Shape::Text(text) => elements.push(match form {
                    TextForm::Outlines => Element::Area {
                        contours: contours(text),
                        color: text.color,
                        is_inside: false,
                    },
                    TextForm::Text => Element::Text(text.clone()),
                }),
                Shape::Area { contours, color } => {
                    elements.push(Element::Area {
                        contours: contours.clone(),
                        color: *color,
                        is_inside: false,
                    });
                }
                Shape::Lines { lines, width, color } => {
                    elements.extend(lines.iter().map(|&ends| Element::Line {
                        ends,
                        width: *width,
                        color: *color,
                    }))
                }
            }
        }
        elements
    }
}
