//! The font: glyph outlines, flattened to straight lines.

use std::fmt;

use crate::figure::Point;
use crate::typeface;
use ab_glyph::{Font, FontRef, GlyphId, OutlineCurve};

/// Largest distance in pixels between a Bézier curve and its flattened outline.
const TOLERANCE: f64 = 0.01;

/// The font has no glyph for this character.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MissingCharacter(pub char);

impl fmt::Display for MissingCharacter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(character) = *self;
        let shown = if character.is_control() { '\u{fffd}' } else { character };
        write!(
            f,
            "the font has no `{shown}` (U+{:04X}); it has Latin and Greek letters, superscripts and \
             subscripts, arrows and signs such as × ° − ≈ √",
            u32::from(character)
        )
    }
}

impl std::error::Error for MissingCharacter {}

/// The font at a size.
pub struct SizedFont {
    font: FontRef<'static>,
    /// Pixels per font unit.
    scale: f64,
}

/// A glyph of the font.
#[derive(Clone, Copy, PartialEq)]
pub struct Glyph(GlyphId);

impl SizedFont {
    /// The font at em size `size`, in pixels.
    pub fn new(size: f64) -> Self {
        let font = typeface::font();
        let scale = size / typeface::units_per_em(&font);
        Self { font, scale }
    }

    /// The glyph of a character.
    pub fn glyph(&self, character: char) -> Result<Glyph, MissingCharacter> {
        match self.font.glyph_id(character) {
            GlyphId(0) => Err(MissingCharacter(character)),
            glyph => Ok(Glyph(glyph)),
        }
    }

    /// The distance from one glyph's origin to that of the next, in pixels, including kerning.
    pub fn advance(&self, glyph: Glyph, next: Option<Glyph>) -> f64 {
        let kern = next.map_or(0.0, |next| self.font.kern_unscaled(glyph.0, next.0));
        self.scale * f64::from(self.font.h_advance_unscaled(glyph.0) + kern)
    }

    /// The outlines of a glyph whose origin, on the baseline, is at `origin`. `slant`: tangent of
    /// the angle by which it leans to the right.
    pub fn contours(&self, glyph: Glyph, origin: Point, slant: f64) -> Vec<Vec<Point>> {
        let mut contours: Vec<Vec<Point>> = Vec::new();
        let Some(outline) = self.font.outline(glyph.0) else { return contours };
        let place = |point: ab_glyph::Point| {
            let [x, y] = [point.x, point.y].map(|part| self.scale * f64::from(part));
            [origin[0] + x + slant * y, origin[1] - y]
        };
        let mut last = None;
        for curve in outline.curves {
            let (from, to) = match curve {
                OutlineCurve::Line(from, to)
                | OutlineCurve::Quad(from, _, to)
                | OutlineCurve::Cubic(from, _, _, to) => (from, to),
            };
            if last != Some(from) {
                contours.push(Vec::new());
            }
            last = Some(to);
            let contour = contours.last_mut().expect("the first curve began one");
            let controls = match curve {
                OutlineCurve::Line(..) => vec![from, to],
                OutlineCurve::Quad(_, middle, _) => vec![from, middle, to],
                OutlineCurve::Cubic(_, first, second, _) => vec![from, first, second, to],
            };
            push_curve(&controls.into_iter().map(place).collect::<Vec<_>>(), contour);
        }
        contours
    }
}

/// Appends a Bézier curve, flattened to straight lines, without its last point.
fn push_curve(controls: &[Point], contour: &mut Vec<Point>) {
    let bend = controls.windows(3).map(|triple| {
        let [x, y] = [0, 1].map(|i| triple[0][i] - 2.0 * triple[1][i] + triple[2][i]);
        libm::hypot(x, y)
    });
    // The error bound of flattening a cubic curve with these second differences; a quadratic curve
    // needs fewer lines.
    let n_lines = libm::sqrt(0.75 * bend.fold(0.0, f64::max) / TOLERANCE).ceil().max(1.0);
    for step in 0..n_lines as u32 {
        contour.push(bezier_point(controls.to_vec(), f64::from(step) / n_lines));
    }
}

/// The point of a Bézier curve at parameter `part`, by de Casteljau's algorithm.
fn bezier_point(mut points: Vec<Point>, part: f64) -> Point {
    while points.len() > 1 {
        points = points
            .windows(2)
            .map(|pair| [0, 1].map(|i| pair[0][i] + (pair[1][i] - pair[0][i]) * part))
            .collect();
    }
    points[0]
}
