//! Plots as SVG and PNG by `plotters`: panels in rows, with the same calls for both formats.

use std::error::Error;
use std::fs;
use std::io::Cursor;
use std::ops::Range;
use std::path::Path;

use image::{ImageFormat, RgbImage, imageops};
use plotters::coord::Shift;
use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, ValueFormatter};
use plotters::prelude::*;
use plotters::style::{FontStyle, register_font};

/// Pixels of the drawing to one of the picture, since `plotters` rounds all places to whole pixels.
const SCALE: u32 = 4;

/// The first of these is for the first series of a panel.
pub const COLORS: [RGBColor; 2] = [RGBColor(11, 98, 168), RGBColor(184, 74, 0)];
const GRID: RGBColor = RGBColor(221, 221, 221);
const FRAME: RGBColor = RGBColor(120, 120, 120);

const FONT: &str = "sans-serif";
const TEXT_SIZE: u32 = 15;
const TITLE_SIZE: u32 = 17;

/// Pixels around the axes and their numbers.
const MARGIN: u32 = 12;
/// Numbers at the end of the horizontal axis need more.
const RIGHT_MARGIN: u32 = 28;

/// Panels of one size, in rows.
pub struct Plot {
    /// Panels in a row.
    pub columns: u32,
    /// Width and height of each panel, pixels.
    pub panel_size: [u32; 2],
    pub panels: Vec<Panel>,
}

/// Marks in a system of coordinates.
pub struct Panel {
    /// Above the axes; empty for none.
    pub title: String,
    /// The horizontal axis and the vertical one.
    pub axes: [Axis; 2],
    /// Whether the axes have ticks, numbers and names.
    pub has_scales: bool,
    pub marks: Vec<Mark>,
}

/// An axis from the first of its ticks to the last.
#[derive(Clone)]
pub struct Axis {
    pub name: String,
    pub ticks: Vec<f64>,
    pub label: fn(f64) -> String,
}

/// Elements at places x, y in the coordinates of the axes.
pub enum Mark {
    /// Points connected by lines of this width in pixels.
    Line(Vec<[f64; 2]>, RGBColor, u32),
    Dots(Vec<[f64; 2]>, RGBColor),
    Arrow([[f64; 2]; 2], RGBColor),
    /// A text that begins at a place.
    Text([f64; 2], String, RGBColor),
}

impl Plot {
    /// The plot as SVG.
    pub fn svg(&self) -> Result<String, Box<dyn Error>> {
        let [width, height] = self.size();
        let [wide, high] = [width, height].map(|side| side * SCALE);
        let mut text = String::new();
        self.draw(&SVGBackend::with_string(&mut text, (wide, high)).into_drawing_area())?;
        let sides = |width, height| format!("<svg width=\"{width}\" height=\"{height}\"");
        Ok(text.replacen(&sides(wide, high), &sides(width, height), 1))
    }

    /// The plot as PNG.
    pub fn png(&self) -> Result<Vec<u8>, Box<dyn Error>> {
        let [width, height] = self.size();
        let [wide, high] = [width, height].map(|side| side * SCALE);
        let mut pixels = RgbImage::new(wide, high);
        self.draw(&BitMapBackend::with_buffer(&mut pixels, (wide, high)).into_drawing_area())?;
        let mut bytes = Cursor::new(Vec::new());
        imageops::thumbnail(&pixels, width, height).write_to(&mut bytes, ImageFormat::Png)?;
        Ok(bytes.into_inner())
    }

    /// Writes `NAME.svg` and `NAME.png` into a folder.
    pub fn write(&self, folder: &Path, name: &str) -> Result<(), Box<dyn Error>> {
        fs::write(folder.join(format!("{name}.svg")), self.svg()?)?;
        Ok(fs::write(folder.join(format!("{name}.png")), self.png()?)?)
    }

    /// Width of a panel without title and scales, relative to its height.
    pub fn aspect([width, height]: [u32; 2]) -> f64 {
        f64::from(width - MARGIN - RIGHT_MARGIN) / f64::from(height - 2 * MARGIN)
    }

    fn size(&self) -> [u32; 2] {
        [self.panel_size[0] * self.columns, self.panel_size[1] * self.rows()]
    }

    fn rows(&self) -> u32 {
        (self.panels.len() as u32).div_ceil(self.columns)
    }

    fn draw<B>(&self, area: &DrawingArea<B, Shift>) -> Result<(), Box<dyn Error>>
    where
        B: DrawingBackend,
        B::ErrorType: 'static,
    {
        let bytes = include_bytes!("../../crates/ugimage/font/DejaVuSans.ttf");
        register_font(FONT, FontStyle::Normal, bytes).map_err(|_| "the font is invalid")?;
        area.fill(&WHITE)?;
        for (panel, area) in
            self.panels.iter().zip(area.split_evenly((self.rows() as usize, self.columns as usize)))
        {
            panel.draw(&area)?;
        }
        Ok(area.present()?)
    }
}

impl Panel {
    fn draw<B>(&self, area: &DrawingArea<B, Shift>) -> Result<(), Box<dyn Error>>
    where
        B: DrawingBackend,
        B::ErrorType: 'static,
    {
        let [x, y] = &self.axes;
        let labels = if self.has_scales { [44, 66] } else { [0, 0] };
        let text = (FONT, TEXT_SIZE * SCALE);
        let mut builder = ChartBuilder::on(area);
        builder.margin(MARGIN * SCALE).margin_right(RIGHT_MARGIN * SCALE);
        builder.x_label_area_size(labels[0] * SCALE).y_label_area_size(labels[1] * SCALE);
        if !self.title.is_empty() {
            builder.caption(&self.title, (FONT, TITLE_SIZE * SCALE));
        }
        let mut chart = builder.build_cartesian_2d(x.clone(), y.clone())?;
        if self.has_scales {
            chart
                .configure_mesh()
                .bold_line_style(GRID.stroke_width(SCALE))
                .set_all_tick_mark_size(5 * SCALE)
                .axis_style(FRAME.stroke_width(SCALE))
                .label_style(text)
                .axis_desc_style(text)
                .x_desc(&x.name)
                .y_desc(&y.name)
                .draw()?;
        }
        let places = |points: &[[f64; 2]]| points.iter().map(|&[x, y]| (x, y)).collect::<Vec<_>>();
        for mark in &self.marks {
            let lines = |color: RGBColor, width: u32| color.stroke_width(width * SCALE);
            match mark {
                Mark::Line(points, color, width) => {
                    chart.draw_series([PathElement::new(places(points), lines(*color, *width))])?;
                }
                Mark::Dots(points, color) => {
                    let dot = |place| Circle::new(place, 4 * SCALE, color.filled());
                    chart.draw_series(places(points).into_iter().map(dot))?;
                }
                Mark::Arrow([from, to], color) => {
                    let (neck, head) = arrow_head([*from, *to]);
                    chart.draw_series([PathElement::new(
                        places(&[*from, neck]),
                        lines(*color, 2),
                    )])?;
                    chart.draw_series([Polygon::new(places(&head), color.filled())])?;
                }
                Mark::Text([x, y], words, color) => {
                    let style = TextStyle::from(text.into_font()).color(color);
                    chart.draw_series([Text::new(words.clone(), (*x, *y), style)])?;
                }
            }
        }
        Ok(())
    }
}

impl Axis {
    /// An axis for numbers.
    pub fn new(name: &str, ticks: &[f64]) -> Self {
        Self { name: name.to_owned(), ticks: ticks.to_vec(), label: |number| number.to_string() }
    }
}

impl Ranged for Axis {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, (first, last): (i32, i32)) -> i32 {
        let Range { start, end } = self.range();
        first + ((value - start) / (end - start) * f64::from(last - first)).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        if hint.weight().allow_light_points() { Vec::new() } else { self.ticks.clone() }
    }

    fn range(&self) -> Range<f64> {
        let ends =
            [self.ticks.first(), self.ticks.last()].map(|end| end.copied().unwrap_or_default());
        ends[0]..ends[1]
    }
}

impl ValueFormatter<f64> for Axis {
    fn format_ext(&self, value: &f64) -> String {
        (self.label)(*value)
    }
}

/// The end of an arrow's shaft, and its head.
fn arrow_head([from, to]: [[f64; 2]; 2]) -> ([f64; 2], [[f64; 2]; 3]) {
    const LENGTH: f64 = 0.1;
    const HALF_WIDTH: f64 = 0.035;
    let (x, y) = (to[0] - from[0], to[1] - from[1]);
    let length = libm::hypot(x, y);
    let (x, y) = (x / length, y / length);
    let neck = [to[0] - LENGTH * x, to[1] - LENGTH * y];
    let side = |by: f64| [neck[0] - by * y, neck[1] + by * x];
    (neck, [to, side(HALF_WIDTH), side(-HALF_WIDTH)])
}
