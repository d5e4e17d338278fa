//! From a diagram to lines and letters.

use std::collections::{BTreeMap, BTreeSet};

use ugimage::figure::{Point, Text};
use ugimage::label::number::significant;
use ugimage::label::{ASCENT, DESCENT, Drawing, Line, MissingCharacter, Shape};
use ugpicture::Units;

use crate::diagram::{CurveRole, Diagram, DiagramCurve, DiagramMark, MarkRole};
use crate::labels::{self, Obstacles, Placed, Rectangle, Wanted};
use crate::place::DiagramPlace;
use crate::spacetime::Ink;
use crate::window::{DiagramWindow, round_step};

/// The size of a picture, of its text, and its units.
#[derive(Clone, Debug)]
pub struct Sheet {
    /// Pixels across and down.
    pub size: [f64; 2],
    /// Em size of text in pixels.
    pub em: f64,
    /// Width of a thin line in pixels.
    pub hairline: f64,
    /// Units of length and time.
    pub units: Units,
}

/// A diagram as it is drawn.
#[derive(Clone, Debug)]
pub struct DrawnDiagram {
    /// Lines and letters.
    pub drawing: Drawing,
    /// The labels that stand in it, with their places in pixels.
    pub labels: Vec<(String, Placed)>,
    /// Names for which there is no room.
    pub omitted: Vec<String>,
    /// What labels must not cover.
    pub obstacles: Obstacles,
}

const INK: Ink = [0; 3];
const PAPER: Ink = [255; 3];

/// Size of the numbers of axes and ticks, in em.
const SMALL: f64 = 0.85;

impl Sheet {
    /// The rectangle of the diagram: there is room for numbers to the left and below.
    pub fn area(&self) -> Option<Rectangle> {
        let [width, height] = self.size;
        let area = [3.8 * self.em, 1.7 * self.em, width - 1.2 * self.em, height - 2.9 * self.em];
        let has_room = area[2] - area[0] > 6.0 * self.em && area[3] - area[1] > 6.0 * self.em;
        has_room.then_some(area)
    }
}

/// Words in runs of upright and italic letters.
struct Words {
    text: String,
    runs: Vec<(Line, bool)>,
    size: f64,
    color: Ink,
}

impl Words {
    fn new(text: &str, size: f64, color: Ink) -> Result<Self, MissingCharacter> {
        Self::of_runs(&[(text, false)], size, color)
    }

    /// `runs`: with symbols of quantities, which are italic.
    fn of_runs(runs: &[(&str, bool)], size: f64, color: Ink) -> Result<Self, MissingCharacter> {
        let line = |&(text, is_italic): &(&str, bool)| Ok((Line::new(text, size)?, is_italic));
        let text = runs.iter().map(|run| run.0).collect();
        Ok(Self { text, runs: runs.iter().map(line).collect::<Result<_, _>>()?, size, color })
    }

    fn size(&self) -> [f64; 2] {
        let width = self.runs.iter().map(|(line, _)| line.width()).sum();
        [width, (ASCENT + DESCENT) * self.size]
    }

    fn draw(&self, drawing: &mut Drawing, [left, top]: Point) {
        let mut x = left;
        for (line, is_italic) in &self.runs {
            let texts = line.at([x, top + ASCENT * self.size], self.color);
            let slanted = |text: Text| Text { is_slanted: text.is_slanted || *is_italic, ..text };
            drawing.shapes.extend(texts.map(slanted).map(Shape::Text));
            x += line.width();
        }
    }
}

/// A diagram on its way to a drawing.
struct Pen<'a> {
    sheet: &'a Sheet,
    area: Rectangle,
    window: DiagramWindow,
    scale: f64,
    drawing: Drawing,
    obstacles: Obstacles,
    words: Vec<Words>,
    wanted: Vec<Wanted>,
}

/// Draws a diagram in the [area](Sheet::area) of a sheet.
///
/// # Errors
/// A name has a character that the font lacks.
pub fn draw(
    diagram: &Diagram,
    sheet: &Sheet,
    area: Rectangle,
) -> Result<DrawnDiagram, MissingCharacter> {
    let window = diagram.window;
    let mut pen = Pen {
        sheet,
        area,
        window,
        scale: (area[2] - area[0]) / window.width(),
        drawing: Drawing::default(),
        obstacles: Obstacles::default(),
        words: Vec::new(),
        wanted: Vec::new(),
    };
    for band in &diagram.bands {
        pen.band(&band.rows, band.color);
    }
    for band in &diagram.bands {
        pen.edges(&band.rows, band.color);
    }
    pen.ground();
    diagram.curves.iter().for_each(|curve| pen.curve(curve));
    pen.marks(&diagram.marks);
    pen.event_labels(&diagram.marks)?;
    diagram.curves.iter().try_for_each(|curve| pen.curve_label(curve))?;
    pen.tick_labels(&diagram.marks)?;
    let numbers = pen.axes(diagram)?;
    pen.finish(numbers)
}

impl Pen<'_> {
    fn at(&self, [x, t]: DiagramPlace) -> Point {
        let [left, _, _, bottom] = self.area;
        [
            left + self.scale * (x - self.window.places[0]),
            bottom - self.scale * (t - self.window.times[0]),
        ]
    }

    /// A body between the world lines of its ends, cut off at the sides.
    fn band(&mut self, rows: &[(f64, [f64; 2])], color: Ink) {
        let [left, right] = self.window.places;
        let side = |side: usize| {
            rows.iter().map(move |&(time, ends)| [ends[side].clamp(left, right), time])
        };
        let outline: Vec<Point> =
            side(0).chain(side(1).rev()).map(|place| self.at(place)).collect();
        self.drawing.area(outline, mixed(color, 0.16));
    }

    /// The world lines of the ends of a body, which show where bands cover each other.
    fn edges(&mut self, rows: &[(f64, [f64; 2])], color: Ink) {
        let edge = |side: usize| -> Vec<DiagramPlace> {
            rows.iter().map(|&(time, ends)| [ends[side], time]).collect()
        };
        let pieces = [self.pieces(&edge(0)), self.pieces(&edge(1))].concat();
        self.obstacles.lines.extend(&pieces);
        self.drawing.lines(pieces, 0.7 * self.sheet.hairline, mixed(color, 0.6));
    }

    /// The frame around the diagram.
    fn ground(&mut self) {
        let [left, top, right, bottom] = self.area;
        let corners = [[left, top], [right, top], [right, bottom], [left, bottom]];
        let sides = (0..4).map(|side| [corners[side], corners[(side + 1) % 4]]).collect();
        self.drawing.lines(sides, self.sheet.hairline, [160; 3]);
    }

    /// The parts of a line that are in the window.
    fn pieces(&self, points: &[DiagramPlace]) -> Vec<[Point; 2]> {
        let pairs = points.windows(2);
        let pieces = pairs.filter_map(|pair| self.window.segment([pair[0], pair[1]]));
        pieces.map(|ends| ends.map(|end| self.at(end))).collect()
    }

    fn curve(&mut self, curve: &DiagramCurve) {
        let pieces = self.pieces(&curve.points);
        let (width, dash) = match curve.role {
            CurveRole::WorldLine => (2.0, None),
            CurveRole::Light => (1.0, None),
            CurveRole::Simultaneity => (1.0, Some([0.5, 0.3])),
            CurveRole::TimeAxis | CurveRole::SpaceAxis => (1.0, None),
            CurveRole::Interval => (1.2, Some([0.16, 0.16])),
        };
        let width = width * self.sheet.hairline;
        // Without gaps at the bends of curves.
        let joined = |&[a, b]: &[Point; 2]| {
            let (x, y) = (b[0] - a[0], b[1] - a[1]);
            let part = 0.4 * width / libm::hypot(x, y).max(f64::MIN_POSITIVE);
            [[a[0] - part * x, a[1] - part * y], [b[0] + part * x, b[1] + part * y]]
        };
        let lines = match dash {
            Some(dash) => dashed(&pieces, dash.map(|part| part * self.sheet.em)),
            None if pieces.len() > 1 => pieces.iter().map(joined).collect(),
            None => pieces.clone(),
        };
        match (curve.role, pieces.last()) {
            (CurveRole::TimeAxis | CurveRole::SpaceAxis, Some(&ends)) => {
                self.drawing.arrow(ends, width, curve.color);
            }
            _ => self.drawing.lines(lines, width, curve.color),
        }
        self.obstacles.lines.extend(pieces);
    }

    /// Marks: ticks and dots of one colour are one shape, since thousands may be drawn.
    fn marks(&mut self, marks: &[DiagramMark]) {
        let mut strokes: BTreeMap<Ink, Vec<[Point; 2]>> = BTreeMap::new();
        let mut dots: BTreeMap<Ink, BTreeSet<[i64; 2]>> = BTreeMap::new();
        let seen = || marks.iter().filter(|mark| self.window.contains(mark.place));
        for mark in seen() {
            match mark.role {
                MarkRole::Tick | MarkRole::AxisTick => {
                    strokes.entry(mark.color).or_default().push(self.stroke(mark));
                }
                // Many share a pixel.
                MarkRole::Emission => {
                    let place = self.at(mark.place).map(|part| (2.0 * part).round() as i64);
                    dots.entry(mark.color).or_default().insert(place);
                }
                _ => {}
            }
        }
        let Sheet { em, hairline, .. } = *self.sheet;
        for (color, strokes) in strokes {
            self.obstacles.lines.extend(&strokes);
            self.drawing.lines(strokes, 1.2 * hairline, color);
        }
        for (color, places) in dots {
            let radius = 0.14 * em;
            let places = places.into_iter().map(|place| place.map(|part| 0.5 * part as f64));
            let mut strips = Vec::new();
            for [x, y] in places {
                strips.extend(hexagon([x, y], radius));
                let radius = radius + hairline;
                self.obstacles.marks.push([x - radius, y - radius, x + radius, y + radius]);
            }
            self.drawing.lines(strips, radius, color);
        }
        for mark in seen().cloned().collect::<Vec<_>>() {
            let radius = match mark.role {
                MarkRole::Event => 0.2 * em,
                MarkRole::Eye => 0.26 * em,
                MarkRole::Flash => 0.42 * em,
                MarkRole::Emission if mark.is_labelled => 0.2 * em,
                _ => continue,
            };
            let [x, y] = self.at(mark.place);
            let halo = radius + hairline;
            if mark.role == MarkRole::Flash {
                self.drawing.area(star([x, y], 1.3 * radius), PAPER);
                self.drawing.area(star([x, y], radius), mark.color);
            } else {
                self.drawing.area(circle([x, y], halo), PAPER);
                self.drawing.area(circle([x, y], radius), mark.color);
            }
            if mark.role == MarkRole::Eye {
                self.drawing.area(circle([x, y], 0.5 * radius), PAPER);
            }
            self.obstacles.marks.push([x - halo, y - halo, x + halo, y + halo]);
        }
    }

    /// The stroke of a tick, across its line.
    fn stroke(&self, mark: &DiagramMark) -> [Point; 2] {
        let ([x, t], [across, down]) = (mark.along, self.at(mark.place));
        let half = 0.28 * self.sheet.em / libm::hypot(x, t);
        [-1.0, 1.0].map(|side| [across + side * half * t, down + side * half * x])
    }

    fn want(&mut self, words: Words, anchors: Vec<Point>, gap: f64, is_optional: bool) {
        let wanted = Wanted { size: words.size(), anchors, gap, is_optional };
        self.words.push(words);
        self.wanted.push(wanted);
    }

    fn event_labels(&mut self, marks: &[DiagramMark]) -> Result<(), MissingCharacter> {
        let em = self.sheet.em;
        for mark in marks.iter().filter(|mark| mark.is_labelled && mark.role != MarkRole::Tick) {
            if self.window.contains(mark.place) {
                let words = Words::new(&mark.name, em, mark.color)?;
                let anchor = self.at(mark.place);
                self.want(words, vec![anchor], 0.5 * em, false);
            }
        }
        Ok(())
    }

    /// The name of a line, somewhere along it: beginning late, where lines are apart.
    fn curve_label(&mut self, curve: &DiagramCurve) -> Result<(), MissingCharacter> {
        if curve.label.is_empty() {
            return Ok(());
        }
        let em = self.sheet.em;
        let seen = self.pieces(&curve.points);
        let lengths: Vec<f64> =
            seen.iter().map(|[a, b]| libm::hypot(b[0] - a[0], b[1] - a[1])).collect();
        let whole: f64 = lengths.iter().sum();
        let along = |part: f64| {
            let mut left = part * whole;
            for ([a, b], length) in seen.iter().zip(&lengths) {
                if left <= *length && *length > 0.0 {
                    let share = left / length;
                    return Some([0, 1].map(|side| a[side] + share * (b[side] - a[side])));
                }
                left -= length;
            }
            None
        };
        let is_axis = matches!(curve.role, CurveRole::TimeAxis | CurveRole::SpaceAxis);
        let parts = if is_axis {
            &[0.97, 0.93, 0.88, 0.8][..]
        } else {
            &[0.94, 0.9, 0.97, 0.85, 0.8, 0.72, 0.64, 0.55, 0.45, 0.35, 0.25, 0.15, 0.08]
        };
        let anchors: Vec<Point> = parts.iter().filter_map(|&part| along(part)).collect();
        if !anchors.is_empty() {
            let words = if is_axis {
                Words::of_runs(&[(&curve.label, true)], em, curve.color)?
            } else {
                Words::new(&curve.label, em, curve.color)?
            };
            self.want(words, anchors, 0.35 * em, false);
        }
        Ok(())
    }

    /// The numbers of ticks of own time, where there is room. The first of a line says what it is.
    fn tick_labels(&mut self, marks: &[DiagramMark]) -> Result<(), MissingCharacter> {
        let em = self.sheet.em;
        let mut named: Vec<&str> = Vec::new();
        for mark in marks.iter().filter(|mark| mark.role == MarkRole::Tick) {
            let is_first = !named.contains(&&*mark.line);
            let text = if is_first { format!("τ = {}", mark.name) } else { mark.name.clone() };
            named.extend(is_first.then_some(&*mark.line));
            let words = Words::new(&text, SMALL * em, mark.color)?;
            let [left, right] = self.stroke(mark);
            self.want(words, vec![right, left], 0.15 * em, true);
        }
        Ok(())
    }

    /// Ticks, numbers and names of both axes, outside of the diagram.
    fn axes(&mut self, diagram: &Diagram) -> Result<Vec<(Words, Point)>, MissingCharacter> {
        let Sheet { em, hairline, units, .. } = self.sheet;
        let (em, unit) = (*em, units.length());
        let factor = unit.as_ref().map_or(1.0, |unit| unit.factor);
        let [left, top, right, bottom] = self.area;
        let step = round_step(4.0 * em / self.scale * factor);
        let mut out = Vec::new();
        let mut strokes = Vec::new();
        for (side, range) in [self.window.places, self.window.times].into_iter().enumerate() {
            let [from, to] = range.map(|end| end * factor);
            let first = (from / step).ceil();
            let numbers = (0..200).map(|row| first + f64::from(row));
            for number in numbers.take_while(|number| *number * step <= to) {
                let value = number * step;
                let words = Words::new(&significant(value + 0.0, 6), SMALL * em, INK)?;
                let [width, height] = words.size();
                let mut place = [self.window.places[0], self.window.times[0]];
                place[side] = value / factor;
                let [x, y] = self.at(place);
                let (stroke, corner) = if side == 0 {
                    ([[x, y], [x, y + 0.3 * em]], [x - 0.5 * width, y + 0.35 * em])
                } else {
                    ([[x, y], [x - 0.3 * em, y]], [x - 0.45 * em - width, y - 0.5 * height])
                };
                strokes.push(stroke);
                out.push((words, corner));
            }
        }
        self.drawing.lines(strokes, *hairline, INK);
        let width = 1.2 * hairline;
        self.drawing.arrow([[left, bottom], [left, top - 0.7 * em]], width, INK);
        self.drawing.arrow([[left, bottom], [right + 0.7 * em, bottom]], width, INK);
        let unit = unit.map_or_else(String::new, |unit| format!(" / {}", unit.name));
        let frame = match &*diagram.frame.name {
            "scene" => String::new(),
            name => format!(" in the frame of {name}"),
        };
        let axis = match diagram.axis.to_array() {
            [_, 1.0, _] => "y",
            [_, _, 1.0] => "z",
            _ => "x",
        };
        let across = Words::of_runs(&[(axis, true), (&unit, false), (&frame, false)], em, INK)?;
        let [width, height] = across.size();
        out.push((across, [right - width, bottom + 2.8 * em - height]));
        let up = Words::of_runs(&[("ct", true), (&unit, false)], em, INK)?;
        let height = up.size()[1];
        out.push((up, [left + 0.5 * em, top - 0.3 * em - height]));
        Ok(out)
    }

    fn finish(mut self, numbers: Vec<(Words, Point)>) -> Result<DrawnDiagram, MissingCharacter> {
        let placed = labels::place(&self.wanted, &self.obstacles, self.area);
        let (mut labels, mut omitted) = (Vec::new(), Vec::new());
        for ((words, wanted), placed) in self.words.iter().zip(&self.wanted).zip(placed) {
            let Some(placed) = placed else {
                omitted.extend((!wanted.is_optional).then(|| words.text.clone()));
                continue;
            };
            let [left, top, right, bottom] = placed.rectangle;
            if let Some(leader) = placed.leader {
                self.drawing.lines(vec![leader], 0.7 * self.sheet.hairline, words.color);
            }
            let is_clear =
                !self.obstacles.lines.iter().any(|line| labels::crosses(*line, &placed.rectangle));
            if !is_clear {
                self.drawing.rectangle([left, top], [right, bottom], PAPER);
            }
            words.draw(&mut self.drawing, [left, top]);
            labels.push((words.text.clone(), placed));
        }
        for (words, corner) in numbers {
            words.draw(&mut self.drawing, corner);
        }
        Ok(DrawnDiagram { drawing: self.drawing, labels, omitted, obstacles: self.obstacles })
    }
}

/// A colour on paper, with this share.
fn mixed(color: Ink, share: f64) -> Ink {
    color.map(|level| (255.0 - share * (255.0 - f64::from(level))).round() as u8)
}

/// Lines in dashes and gaps of these lengths, which go on around corners.
fn dashed(lines: &[[Point; 2]], [dash, gap]: [f64; 2]) -> Vec<[Point; 2]> {
    let mut out = Vec::new();
    let mut passed = 0.0;
    for &[a, b] in lines {
        let length = libm::hypot(b[0] - a[0], b[1] - a[1]);
        let at = |part: f64| [0, 1].map(|side| a[side] + part / length * (b[side] - a[side]));
        let mut start = -passed;
        while start < length {
            let ends = [start.max(0.0), (start + dash).min(length)];
            if ends[0] < ends[1] {
                out.push(ends.map(at));
            }
            start += dash + gap;
        }
        passed = length - (start - dash - gap);
    }
    out
}

/// A regular hexagon as three strips whose width is its radius.
fn hexagon([x, y]: Point, radius: f64) -> [[Point; 2]; 3] {
    let half = radius * 0.75_f64.sqrt();
    let sines = [[1.0, 0.0], [0.5, 0.75_f64.sqrt()], [-0.5, 0.75_f64.sqrt()]];
    sines.map(|[cosine, sine]| [-half, half].map(|part| [x + part * cosine, y + part * sine]))
}

fn circle(place: Point, radius: f64) -> Vec<Point> {
    polygon(place, 24, |_| radius)
}

/// A star of eight rays.
fn star(place: Point, radius: f64) -> Vec<Point> {
    polygon(place, 16, |corner| if corner % 2 == 0 { radius } else { 0.4 * radius })
}

fn polygon([x, y]: Point, corners: u32, radius: impl Fn(u32) -> f64) -> Vec<Point> {
    let corner = |corner: u32| {
        let (sine, cosine) =
            libm::sincos(core::f64::consts::TAU * f64::from(corner) / f64::from(corners));
        [x + radius(corner) * cosine, y + radius(corner) * sine]
    };
    (0..corners).map(corner).collect()
}
