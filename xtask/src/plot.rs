//! Plots with logarithmic axes, as SVG.

use std::fmt::Write;

/// One of several plots in a row.
pub struct Panel<'a> {
    pub title: &'a str,
    /// Unit of the horizontal axis.
    pub unit: &'a str,
    pub series: [Series<'a>; 2],
}

/// Points connected by a line.
pub struct Series<'a> {
    pub name: &'a str,
    pub points: Vec<[f64; 2]>,
}

const COLORS: [&str; 2] = ["#0b62a8", "#b84a00"];
const WIDTH: f64 = 420.0;
const HEIGHT: f64 = 360.0;
const LEFT: f64 = 60.0;
const TOP: f64 = 36.0;
/// Length of each axis.
const SIDE: f64 = 260.0;

/// Draws panels side by side. All have the same vertical range and as many decades horizontally, so
/// that a slope of 1 looks the same in all.
pub fn svg(panels: &[Panel<'_>]) -> String {
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {HEIGHT}\" font-family=\"sans-serif\" \
         font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
        WIDTH * panels.len() as f64
    );
    let all = || panels.iter().flat_map(|panel| &panel.series).flat_map(|series| &series.points);
    let down = decades(all().map(|point| point[1]));
    let across: Vec<_> = panels
        .iter()
        .map(|panel| decades(panel.series.iter().flat_map(|series| &series.points).map(|point| point[0])))
        .collect();
    let most = across.iter().map(|[low, high]| high - low).fold(down[1] - down[0], i32::max);
    for (idx, (panel, [low, _])) in panels.iter().zip(across).enumerate() {
        let axes = Axes { across: low, down: down[0], decade: SIDE / f64::from(most), most };
        let _ = writeln!(text, "<g transform=\"translate({} 0)\">", WIDTH * idx as f64);
        axes.draw(&mut text, panel);
        text.push_str("</g>\n");
    }
    text.push_str("</svg>\n");
    text
}

/// The exponents of the powers of ten that enclose these numbers.
fn decades(numbers: impl Iterator<Item = f64>) -> [i32; 2] {
    let (low, high) = numbers
        .map(libm::log10)
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), number| (low.min(number), high.max(number)));
    [low.floor() as i32, high.ceil() as i32]
}

struct Axes {
    /// Exponents of ten at the beginning of the axes.
    across: i32,
    down: i32,
    /// Length of a decade in the plot.
    decade: f64,
    /// Decades of each axis.
    most: i32,
}

impl Axes {
    fn x(&self, number: f64) -> f64 {
        LEFT + (libm::log10(number) - f64::from(self.across)) * self.decade
    }

    fn y(&self, number: f64) -> f64 {
        TOP + SIDE - (libm::log10(number) - f64::from(self.down)) * self.decade
    }

    fn draw(&self, text: &mut String, panel: &Panel<'_>) {
        let _ = writeln!(text, "<text x=\"{LEFT}\" y=\"20\" font-weight=\"bold\">{}</text>", panel.title);
        let (right, bottom) = (LEFT + SIDE, TOP + SIDE);
        for step in 0..=self.most {
            let at = f64::from(step) * self.decade;
            let (x, y) = (LEFT + at, bottom - at);
            let _ = writeln!(
                text,
                "<path d=\"M{x:.1} {TOP}V{bottom}M{LEFT} {y:.1}H{right}\" stroke=\"#ddd\"/>\n\
                 <text x=\"{x:.1}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n\
                 <text x=\"{}\" y=\"{:.1}\" text-anchor=\"end\">{}</text>",
                bottom + 16.0,
                power(self.across + step),
                LEFT - 6.0,
                y + 4.0,
                power(self.down + step),
            );
        }
        let _ = writeln!(
            text,
            "<path d=\"M{LEFT} {bottom}L{right} {TOP}\" stroke=\"#aaa\" stroke-dasharray=\"4 4\"/>\n\
             <text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>",
            LEFT + SIDE / 2.0,
            bottom + 36.0,
            panel.unit
        );
        for (idx, (series, color)) in panel.series.iter().zip(COLORS).enumerate() {
            self.draw_series(text, series, color, TOP + 18.0 + 18.0 * idx as f64);
        }
    }

    fn draw_series(&self, text: &mut String, series: &Series<'_>, color: &str, name_at: f64) {
        let points = series.points.iter().map(|[x, y]| format!("{:.1},{:.1}", self.x(*x), self.y(*y)));
        let points: Vec<String> = points.collect();
        let _ = writeln!(
            text,
            "<polyline points=\"{}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"2\"/>\n\
             <text x=\"{}\" y=\"{name_at}\" fill=\"{color}\">{}</text>",
            points.join(" "),
            LEFT + 8.0,
            series.name
        );
        for point in points {
            let (x, y) = point.split_once(',').unwrap_or_default();
            let _ = writeln!(text, "<circle cx=\"{x}\" cy=\"{y}\" r=\"3\" fill=\"{color}\"/>");
        }
    }
}

/// A power of ten as SVG text.
fn power(exponent: i32) -> String {
    match u32::try_from(exponent) {
        Ok(exponent) if exponent > 3 => format!("10<tspan dy=\"-4\" font-size=\"9\">{exponent}</tspan>"),
        Ok(exponent) => 10u32.pow(exponent).to_string(),
        Err(_) => format!("0.{}1", "0".repeat(exponent.unsigned_abs() as usize - 1)),
    }
}
