//! The legend: the visible spectrum with its wavelengths, the wavelengths at which green light is
//! seen, and the velocities of the bodies.

use glam::DVec3;
use ugimage::figure::{Point, Rgb};
use ugimage::label::{Drawing, Line, MissingCharacter};
use ugphysics::{Hsv, attenuation, wavelength_to_hue};

use super::motion::MotionSummary;
use super::style::Style;
use crate::units::Units;
use ugimage::label::number::{list_or_range, range, significant, speed};

/// Wavelength in nm whose shifted range the legend shows: green, the middle of the visible
/// spectrum.
const SAMPLE_NM: f64 = 550.0;

/// Wavelengths of the spectrum.
const VISIBLE_NM: [f64; 2] = [380.0, 780.0];

/// Extent of the axis beyond the spectrum on either side, for arrows that leave it.
const BEYOND_NM: f64 = 40.0;

/// Width of a piece of uniform colour.
const STEP_NM: f64 = 2.0;

/// Size of text in a legend relative to that of a caption.
const TEXT: f64 = 0.85;

/// Height of each part, in text sizes.
const HEIGHT: f64 = 4.2;

/// Width of the velocities, arrows and text, in text sizes.
const MOTION: f64 = 18.5;

/// Gap between the parts, in text sizes.
const GAP: f64 = 1.5;

/// Greatest and least width of the spectrum, in text sizes.
const RAINBOW: [f64; 2] = [26.0, 20.0];

/// Least width of the legend, in text sizes: below that the numbers under the spectrum overlap.
const LEAST_WIDTH: f64 = 9.0;

/// With more bodies, no arrows are drawn.
const MOST_ARROWS: usize = 8;

/// Rows of a legend in a picture `width` columns wide; `None` if that is too narrow.
pub fn rows(style: &Style, width: u32) -> Option<u32> {
    let layout = Layout::new(style, f64::from(width), 0.0);
    let rows = (layout.end + layout.padding).ceil() as u32;
    (layout.rainbow.1 >= LEAST_WIDTH * layout.size).then_some(rows)
}

/// Draws the legend on a strip of a given width that begins at a given row.
///
/// # Errors
/// Never, because the font has all its characters.
pub fn draw(
    motion: &MotionSummary,
    units: &Units,
    style: &Style,
    [width, top]: [f64; 2],
    drawing: &mut Drawing,
) -> Result<(), MissingCharacter> {
    let layout = Layout::new(style, width, top);
    let legend = Legend { motion, units, style, layout };
    legend.rainbow(drawing)?;
    legend.shift(drawing)?;
    legend.arrows(drawing);
    legend.words(drawing)
}

/// The layout of a legend.
struct Layout {
    /// Size of text.
    size: f64,
    padding: f64,
    /// Upper-left corner of the spectrum, and its width.
    rainbow: (Point, f64),
    /// Upper-left corner of the velocities, and their width.
    motion: (Point, f64),
    /// Lower end of both parts.
    end: f64,
}

impl Layout {
    fn new(style: &Style, width: f64, top: f64) -> Self {
        let size = TEXT * style.size;
        let padding = 0.7 * style.size;
        let [most, least] = RAINBOW.map(|part| part * size);
        let room = width - 2.0 * style.margin();
        let beside = room - (GAP + MOTION) * size;
        let top = top + padding;
        if beside >= least {
            let rainbow = beside.min(most);
            let left = 0.5 * (width - rainbow - (GAP + MOTION) * size);
            let motion = ([left + rainbow + GAP * size, top], MOTION * size);
            return Self {
                size,
                padding,
                rainbow: ([left, top], rainbow),
                motion,
                end: top + HEIGHT * size,
            };
        }
        // One above the other.
        let (rainbow, motion) = (room.min(most), room.min(MOTION * size));
        let below = top + (HEIGHT + 0.9) * size;
        let middle = |part: f64| 0.5 * (width - part);
        Self {
            size,
            padding,
            rainbow: ([middle(rainbow), top], rainbow),
            motion: ([middle(motion), below], motion),
            end: below + HEIGHT * size,
        }
    }

    /// The column of a wavelength.
    fn column(&self, wavelength_nm: f64) -> f64 {
        let ([left, _], width) = self.rainbow;
        let low = VISIBLE_NM[0] - BEYOND_NM;
        left + width * (wavelength_nm - low) / (VISIBLE_NM[1] + BEYOND_NM - low)
    }

    /// The upper and lower edge of the spectrum.
    fn bar(&self) -> [f64; 2] {
        let top = self.rainbow.0[1];
        [2.05, 3.0].map(|row| (top + row * self.size).round())
    }
}

struct Legend<'a> {
    motion: &'a MotionSummary,
    units: &'a Units,
    style: &'a Style,
    layout: Layout,
}

impl Legend<'_> {
    /// Draws the colours of the visible range, with wavelengths below them.
    fn rainbow(&self, drawing: &mut Drawing) -> Result<(), MissingCharacter> {
        let Layout { size, .. } = self.layout;
        let [top, bottom] = self.layout.bar();
        let n_cells = ((VISIBLE_NM[1] - VISIBLE_NM[0]) / STEP_NM) as u32;
        for cell in 0..n_cells {
            let from = VISIBLE_NM[0] + STEP_NM * f64::from(cell);
            // Each piece extends under the next, so that no background shows between them.
            let to = (from + 1.7 * STEP_NM).min(VISIBLE_NM[1]);
            let columns = [from, to].map(|wavelength_nm| self.layout.column(wavelength_nm));
            drawing.rectangle(
                [columns[0], top],
                [columns[1], bottom],
                spectral(from + 0.5 * STEP_NM),
            );
        }
        let line = self.style.hairline;
        let [left, right] = VISIBLE_NM.map(|end| self.layout.column(end));
        let corners = [[left, top], [right, top], [right, bottom], [left, bottom]];
        let sides = (0..4).map(|idx| stretched(corners[idx], corners[(idx + 1) % 4], 0.5 * line));
        drawing.lines(sides.collect(), line, self.style.faint);
        let below = bottom + 0.3 * size;
        for wavelength_nm in [400.0, 500.0, 600.0, 700.0] {
            let column = self.layout.column(wavelength_nm);
            drawing.lines(vec![[[column, bottom], [column, below]]], line, self.style.ink);
            let number = Line::new(&significant(wavelength_nm, 4), 0.85 * size)?;
            let base = (bottom + 1.15 * size).round();
            drawing.text(&number, [column - 0.5 * number.width(), base], self.style.ink);
            if wavelength_nm == 700.0 {
                let unit = Line::new(" nm", 0.85 * size)?;
                drawing.text(&unit, [column + 0.5 * number.width(), base], self.style.ink);
            }
        }
        Ok(())
    }

    /// Draws an arrow from a wavelength to the bar of wavelengths at which its light is seen.
    fn shift(&self, drawing: &mut Drawing) -> Result<(), MissingCharacter> {
        let Some([low, high]) = self.motion.doppler.filter(|_| !self.motion.is_rest()) else {
            return Ok(());
        };
        let Layout { size, rainbow: ([_, top], width), .. } = self.layout;
        let ink = self.style.ink;
        let words = if self.motion.is_shifted {
            self.shift_arrow([SAMPLE_NM / high, SAMPLE_NM / low], drawing);
            let ends = [SAMPLE_NM / high, SAMPLE_NM / low].map(|end| significant(end, 3));
            format!("{SAMPLE_NM} nm → {} nm", range(&ends[0], &ends[1]))
        } else {
            "colours as at rest".to_owned()
        };
        let line = fitting(&words, size, width)?;
        let row = if self.motion.is_shifted { 0.75 } else { 1.4 };
        let left = self.layout.column(0.5 * (VISIBLE_NM[0] + VISIBLE_NM[1])) - 0.5 * line.width();
        drawing.text(&line, [left, (top + row * size).round()], ink);
        Ok(())
    }

    fn shift_arrow(&self, seen_nm: [f64; 2], drawing: &mut Drawing) {
        let Layout { size, rainbow: ([left, top], width), .. } = self.layout;
        let (ink, line) = (self.style.ink, self.style.hairline);
        let row = top + 1.5 * size;
        let right = left + width;
        let start = self.layout.column(SAMPLE_NM);
        let ends = seen_nm.map(|wavelength_nm| self.layout.column(wavelength_nm));
        let near = start.clamp(ends[0], ends[1]);
        let inside = ends.map(|end| end.clamp(left, right));
        let arrow = |to: f64, drawing: &mut Drawing| {
            drawing.arrow([[start, row], [to, row]], line, ink);
        };
        if near != start && (near - start).abs() > 0.4 * size {
            arrow(near.clamp(left, right), drawing);
        }
        if ends[0] < left && near > left {
            arrow(left, drawing);
        }
        if ends[1] > right && near < right {
            arrow(right, drawing);
        }
        // A short bar is widened to stay visible.
        let wider = (0.5 * (0.3 * size - (inside[1] - inside[0]))).max(0.0);
        if inside[1] > inside[0] || (left..=right).contains(&near) {
            let thick = 0.24 * size;
            let corners =
                [[inside[0] - wider, row - 0.5 * thick], [inside[1] + wider, row + 0.5 * thick]];
            drawing.rectangle(corners[0], corners[1], ink);
        }
        drawing.area(circle([start, row], 0.42 * size), self.style.background);
        drawing.area(circle([start, row], 0.28 * size), ink);
    }

    /// Draws velocities as arrows of unit length, in the view of the camera.
    fn arrows(&self, drawing: &mut Drawing) {
        let Layout { size, motion: ([left, top], _), .. } = self.layout;
        let radius = 1.7 * size;
        let middle = [left + radius, top + 0.5 * HEIGHT * size];
        let line = self.style.hairline;
        let around = circle(middle, radius);
        let sides = (0..around.len()).map(|idx| [around[idx], around[(idx + 1) % around.len()]]);
        drawing.lines(sides.collect(), line, self.style.faint);
        let moving: Vec<DVec3> = self
            .motion
            .directions
            .iter()
            .copied()
            .filter(|direction| *direction != DVec3::ZERO)
            .collect();
        if moving.len() > MOST_ARROWS {
            return;
        }
        for direction in moving {
            self.arrow(middle, radius, direction, drawing);
        }
    }

    /// Draws an arrow. At its tail is a dot if it points towards the viewer, and a cross if it
    /// points away.
    fn arrow(&self, [x, y]: Point, radius: f64, direction: DVec3, drawing: &mut Drawing) {
        /// Shorter arrows would be hidden by the symbol at their tail.
        const ARROW: f64 = 0.3;
        /// Smaller components along the view get no symbol.
        const SIGN: f64 = 0.1;
        let (ink, width) = (self.style.ink, 1.5 * self.style.hairline);
        if libm::hypot(direction.x, direction.y) > ARROW {
            let tip = [x + radius * direction.x, y - radius * direction.y];
            drawing.arrow([[x, y], tip], width, ink);
        }
        let sign = 0.22 * radius;
        if direction.z > SIGN {
            drawing.area(circle([x, y], 0.7 * sign), ink);
        } else if direction.z < -SIGN {
            let lines = vec![
                [[x - sign, y - sign], [x + sign, y + sign]],
                [[x - sign, y + sign], [x + sign, y - sign]],
            ];
            drawing.lines(lines, width, ink);
        }
    }

    fn words(&self, drawing: &mut Drawing) -> Result<(), MissingCharacter> {
        let Layout { size, motion: ([left, top], width), .. } = self.layout;
        let left = left + 4.4 * size;
        let room = width - 4.4 * size;
        let velocities = &self.motion.velocities;
        let between = |ends: [f64; 2]| {
            let ends = ends.map(|end| significant(end, 3));
            range(&ends[0], &ends[1])
        };
        let mut doppler = match self.motion.doppler {
            Some(ends) => format!("D = {}", between(ends)),
            None => "nothing is seen".to_owned(),
        };
        if let Some(ends) = self.motion.own_time {
            let unit = self.units.time(ends[1].abs().max(ends[0].abs()));
            let words = match unit {
                Some(unit) => {
                    format!("{} {}", between(ends.map(|end| end * unit.factor)), unit.name)
                }
                None => between(ends),
            };
            doppler += &format!(",  τ = {words}");
        }
        let mut beta =
            format!("β = {}", list_or_range(velocities.iter().map(|&v| speed(v)).collect()));
        if let Some(unit) = self.units.speed() {
            let speeds =
                velocities.iter().map(|v| significant(v.speed() * unit.factor, 6)).collect();
            beta = format!("v = {} {},  {beta}", list_or_range(speeds), unit.name);
        }
        let gamma = format!(
            "γ = {}",
            list_or_range(velocities.iter().map(|v| significant(v.gamma(), 4)).collect())
        );
        let words = if self.motion.is_rest() {
            ["at rest".to_owned(), "β = 0,  γ = 1".to_owned(), doppler]
        } else {
            [beta, gamma, doppler]
        };
        for (idx, words) in words.iter().enumerate() {
            let line = fitting(words, size, room)?;
            let base = (top + size * (1.0 + 1.35 * idx as f64)).round();
            drawing.text(&line, [left, base], self.style.ink);
        }
        Ok(())
    }
}

/// A line of text, reduced in size to fit `room`.
fn fitting(text: &str, size: f64, room: f64) -> Result<Line, MissingCharacter> {
    let line = Line::new(text, size)?;
    if line.width() <= room { Ok(line) } else { Line::new(text, size * room / line.width()) }
}

/// A line extended by `by` at both ends.
fn stretched(a: Point, b: Point, by: f64) -> [Point; 2] {
    let [x, y] = [b[0] - a[0], b[1] - a[1]];
    let part = by / libm::hypot(x, y);
    [[a[0] - part * x, a[1] - part * y], [b[0] + part * x, b[1] + part * y]]
}

/// The colour of light of one wavelength, as in the picture.  Eq. (P16), (P17)
fn spectral(wavelength_nm: f64) -> Rgb {
    let color = Hsv { hue: wavelength_to_hue(wavelength_nm), saturation: 1.0, value: 1.0 };
    color.attenuated(attenuation(wavelength_nm)).to_rgb().map(|part| (255.0 * part).round() as u8)
}

fn circle([x, y]: Point, radius: f64) -> Vec<Point> {
    const N_CORNERS: u32 = 48;
    let corner = |idx: u32| {
        let angle = std::f64::consts::TAU * f64::from(idx) / f64::from(N_CORNERS);
        [x + radius * libm::cos(angle), y + radius * libm::sin(angle)]
    };
    (0..N_CORNERS).map(corner).collect()
}
