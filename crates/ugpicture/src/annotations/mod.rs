//! Annotations of a picture: a title, a caption, a legend, labels, a coordinate grid, the outlines
//! of undistorted bodies, and quantities of what is seen as false colours and lines.
//!
//! The title is on a strip above the picture of the scene; caption and legend are on strips below
//! it, in a column beside it or over one of its corners. The file keeps the requested size: the
//! view of the whole picture is drawn in the remaining part. Grid, outlines and labels are drawn
//! over it. All annotations consist of text and lines ([`ugimage::label`]), drawn
//! after the light of the scene has been developed.

mod color_bar;
mod composite;
mod grid;
mod iso;
mod labels;
mod legend;
mod map;
mod motion;
mod outline;
mod seen;
mod style;

use rayon::prelude::*;
use ugimage::Frame;
use ugimage::figure::{Pane, Point};
use ugimage::label::{DESCENT, Drawing, Line, SPACING, wrapped};
use ugscene::{CameraOptions, Scene, View};

use crate::background::Backdrop;
use crate::emission::SeenItem;
use crate::error::Error;
use crate::note::Note;
use crate::options::{AnnotationOptions, PictureOptions, Place};
pub use composite::Annotations;
pub use map::Scale;
use motion::MotionSummary;
use seen::{SeenScene, velocities};
pub use style::Style;

/// The subject of a picture's annotations. `E`: the error of a renderer.
pub struct Annotated<'a, E> {
    /// True if wavelengths in the picture are Doppler shifted.
    pub is_shifted: bool,
    /// The content of the picture.
    pub subject: Subject<'a, E>,
}

/// The content of an annotated picture.
pub enum Subject<'a, E> {
    /// Surfaces seen through a lens.
    Surfaces {
        /// The camera, in any units of the picture.
        view: &'a View,
        /// Finds what is seen.
        items: &'a FindItems<'a, E>,
        /// The scene, whose vertices are part of one body each, if there is one.
        scene: Option<&'a Scene>,
        /// Draws grids and outlines, if the lens is a pinhole.
        wires: Option<&'a VisibleWires<'a, E>>,
        /// True if lines that faces hide are drawn, as labels of hidden vertices then are.
        shows_hidden: bool,
    },
    /// A picture of which only the pixels are known, which captions suit.
    Pixels,
}

/// Finds the surfaces that are visible in the picture: at every sample if the first argument is
/// true, else at the middles of pixels. Passes a look-up function to the second argument; its
/// argument is the row-major index of the sample or pixel.
pub type FindItems<'a, E> = dyn Fn(bool, &mut dyn FnMut(&FoundItems<'_>)) -> Result<(), E> + 'a;

/// The surface visible at a sample or pixel, by its row-major index.
pub type FoundItems<'a> = dyn Fn(usize) -> Option<SeenItem> + Sync + 'a;

/// Finds the parts of the wires of a scene that its faces do not hide from a camera, in a picture
/// of the size of the subject, in pixels.
pub type VisibleWires<'a, E> = dyn Fn(&Scene, &CameraOptions) -> Result<Vec<[Point; 2]>, E> + 'a;

/// The areas of an annotated picture.
pub struct Layout {
    /// Pixels of the whole picture.
    size: [u32; 2],
    /// The part with the scene.
    scene: Pane,
    title: Paragraph,
    panel: Panel,
}

/// The scale of false colours, the legend and the caption, one below the other.
struct Panel {
    /// Its part of the picture.
    window: Pane,
    /// True if it covers the scene.
    is_over: bool,
    /// Rows of the scale.
    scale_rows: u32,
    /// Rows of the legend below that.
    legend_rows: u32,
    /// Below both.
    caption: Paragraph,
}

impl Layout {
    /// Divides the picture into its areas.
    ///
    /// # Errors
    /// The format does not support annotations, the font lacks a character, or there is no room.
    pub fn new(options: &PictureOptions) -> Result<Self, Error> {
        options.check_size()?;
        let annotations = &options.annotations;
        if annotations.is_any() && options.output.format().is_linear() {
            return Err(Error::NotAnnotated);
        }
        let style = Style::new(options.size, options, None);
        let size @ [width, height] = options.size;
        let title = Paragraph::new(&annotations.title, TITLE * style.size, width, &style)?;
        let place = annotations.place;
        let panel = Panel::new(annotations, &style, size)?;
        let [panel_width, panel_rows] = panel.window.size;
        let below = if place == Place::Below { panel_rows } else { 0 };
        let beside = if place == Place::Beside { panel_width } else { 0 };
        // Less than a third of the height is not enough for the scene.
        let rows = height.checked_sub(title.rows(&style).saturating_add(below));
        let rows = rows.filter(|&rows| rows > 0 && rows >= height / 3).ok_or(Error::NoRoom)?;
        let scene = Pane { corner: [0, height - below - rows], size: [width - beside, rows] };
        let panel =
            panel.at(place, scene, (0.5 * style.size).round() as u32).ok_or(Error::NoRoom)?;
        Ok(Self { size, scene, title, panel })
    }

    /// The column and row in the part with the scene of a pixel of the whole picture, if it is in
    /// that part.
    pub fn pixel_of_scene(&self, pixel: [u32; 2]) -> Option<[u32; 2]> {
        let Pane { corner, size } = self.scene;
        let part =
            |axis: usize| pixel[axis].checked_sub(corner[axis]).filter(|&at| at < size[axis]);
        Some([part(0)?, part(1)?])
    }

    /// The part of the scene under legend and caption: its upper left and lower right corner.
    fn covered(&self) -> Option<[Point; 2]> {
        let Panel { window: Pane { corner, size }, is_over, .. } = self.panel;
        let low = [0, 1].map(|axis| f64::from(corner[axis] - self.scene.corner[axis]));
        is_over.then(|| [low, [0, 1].map(|axis| low[axis] + f64::from(size[axis]))])
    }

    /// The options for the picture of the scene alone, which shows all of the view of the whole
    /// picture. `options`: of the whole picture.
    pub fn of_scene(&self, options: &PictureOptions) -> PictureOptions {
        let mut options = PictureOptions { size: self.scene.size, ..options.clone() };
        if self.scene.size != self.size {
            let part = |axis: usize| f64::from(self.scene.size[axis]) / f64::from(self.size[axis]);
            options.camera.part = Some([part(0), part(1)]);
        }
        options
    }

    /// The picture of the scene in false colours with its scale, if the options ask for it.
    /// `options`: of the picture of the scene.
    ///
    /// # Errors
    /// Errors of [`Subject::Surfaces`]'s functions; [`Error::NoSurfaces`].
    pub fn map<E: From<Error>>(
        &self,
        annotated: &Annotated<'_, E>,
        options: &PictureOptions,
    ) -> Result<Option<(Frame, Scale)>, E> {
        let Some(map) = &options.annotations.map else { return Ok(None) };
        let Subject::Surfaces { items, .. } = annotated.subject else {
            return Err(Error::NoSurfaces.into());
        };
        let [width, height] = options.size.map(|side| side as usize * options.samples as usize);
        let mut values = Vec::new();
        items(true, &mut |item| {
            let value = |idx| map::value(map.quantity, item(idx));
            values = (0..width * height).into_par_iter().map(value).collect();
        })?;
        let scale = Scale::new(map, &values, &options.annotations.units);
        Ok(Some((map::picture(&scale, &values, options), scale)))
    }

    /// All annotations, and notes about them. `options`: of the picture of the scene; `scale`: of
    /// its false colours.
    ///
    /// # Errors
    /// Errors of [`Subject::Surfaces`]'s functions; [`Error::NoSurfaces`].
    pub fn annotate<E: From<Error>>(
        &self,
        annotated: &Annotated<'_, E>,
        options: &PictureOptions,
        scale: Option<&Scale>,
    ) -> Result<Annotations, E> {
        let background = Backdrop::new(options.background, options.samples).light();
        let style = &Style::new(self.size, options, background);
        let mut all = Annotations {
            size: self.size,
            scene: self.scene,
            background,
            over: Drawing::default(),
            strips: Drawing::default(),
            text: options.text,
            notes: Vec::new(),
        };
        let texts = [&options.annotations.title, &options.annotations.caption];
        if NUMBERS.iter().any(|name| texts.iter().any(|text| text.contains(name))) {
            all.notes.push(Note::UnknownNumber);
        }
        // Parts of the picture in which no more text has room.
        let mut taken: Vec<labels::Rectangle> = self.covered().into_iter().collect();
        let mut panel = Drawing::default();
        let panel_width = f64::from(self.panel.window.size[0]);
        let AnnotationOptions { legend, outline, grid, ref iso, ref units, .. } =
            options.annotations;
        if let Subject::Surfaces { view, items, scene, wires, shows_hidden } = annotated.subject {
            let has_labels = !options.output.format().is_linear()
                && scene.is_some_and(|scene| scene.labels().next().is_some());
            let needs_scene = outline || grid || has_labels;
            if let (Some(scene), Some(wires), true) = (scene, wires, needs_scene) {
                let seen = SeenScene::new(scene, view, options, wires)?;
                if grid {
                    let over = &mut all.over;
                    all.notes.extend(grid::draw(&seen, units, style, &mut taken, over)?);
                }
                if outline {
                    all.notes.extend(outline::draw(&seen, style, &mut all.over)?);
                }
                if has_labels {
                    let over = &mut all.over;
                    all.notes.extend(labels::draw(&seen, style, &mut taken, shows_hidden, over)?);
                }
            } else if has_labels {
                all.notes.push(Note::NoLabels);
            }
            if let Some(iso) = iso {
                let mut drawn = Ok(());
                items(false, &mut |item| {
                    let seen = iso::Field { size: options.size, scene, item };
                    drawn = iso::draw(iso, units, &seen, style, &mut taken, &mut all.over);
                })?;
                drawn.map_err(Error::from)?;
            }
            if legend {
                let mut motion = None;
                let n_pixels = options.size[0] as usize * options.size[1] as usize;
                items(false, &mut |item| {
                    motion = Some(MotionSummary::new(
                        view,
                        (0..n_pixels).map(item),
                        || scene.map_or_else(Vec::new, velocities),
                        annotated.is_shifted,
                    ));
                })?;
                if let Some(motion) = motion {
                    let place = [panel_width, self.panel.scale_rows.into()];
                    legend::draw(&motion, units, style, place, &mut panel).map_err(Error::from)?;
                }
            }
        } else if iso.is_some() {
            return Err(Error::NoSurfaces.into());
        }
        if let Some(scale) = scale {
            color_bar::draw(scale, style, [panel_width, 0.0], &mut panel).map_err(Error::from)?;
        }
        let Panel { window: Pane { corner, size }, scale_rows, legend_rows, ref caption, is_over } =
            self.panel;
        caption.draw(size[0], scale_rows + legend_rows, false, style, &mut panel);
        let [corner, size] = [corner, size].map(|place| place.map(f64::from));
        if is_over {
            let end = [0, 1].map(|axis| corner[axis] + size[axis]);
            all.strips.rectangle(corner, end, style.background);
        }
        all.strips.push(panel, corner);
        self.title.draw(self.size[0], 0, true, style, &mut all.strips);
        Ok(all)
    }
}

impl Panel {
    /// Lays out its parts, at the upper left corner of a picture of this size. It may have none.
    fn new(
        annotations: &AnnotationOptions,
        style: &Style,
        [width, _]: [u32; 2],
    ) -> Result<Self, Error> {
        let mut width = width;
        if annotations.place != Place::Below {
            width = (width / 2).min((PANEL * style.size).ceil() as u32);
        }
        let rows = |is_drawn: bool, rows: fn(&Style, u32) -> Option<u32>| {
            if is_drawn { rows(style, width).ok_or(Error::TooNarrow) } else { Ok(0) }
        };
        let scale_rows = rows(annotations.map.is_some(), color_bar::rows)?;
        let legend_rows = rows(annotations.legend, legend::rows)?;
        let caption = Paragraph::new(&annotations.caption, style.size, width, style)?;
        if annotations.place != Place::Below && scale_rows + legend_rows == 0 {
            let longest = caption.lines.iter().map(Line::width).fold(0.0, f64::max);
            width = if longest > 0.0 { (longest + 2.0 * style.margin()).ceil() as u32 } else { 0 };
        }
        let rows = scale_rows.saturating_add(legend_rows).saturating_add(caption.rows(style));
        let window = Pane { corner: [0; 2], size: [width, rows] };
        Ok(Self { window, is_over: false, scale_rows, legend_rows, caption })
    }

    /// Moves it to its place at the part of the picture with the scene; `None` if there is no room.
    /// `gap`: from the edges of the scene that it covers.
    fn at(mut self, place: Place, scene: Pane, gap: u32) -> Option<Self> {
        let ([left, top], [width, height]) = (scene.corner, scene.size);
        let [columns, rows] = self.window.size;
        if place == Place::Below || rows == 0 {
            self.window.corner = [0, top + height];
            return Some(self);
        }
        self.is_over = place != Place::Beside;
        let gap = if self.is_over { gap } else { 0 };
        let [right, low] = [width.checked_sub(columns + gap), height.checked_sub(rows + gap)];
        self.window.corner = match place {
            Place::Below | Place::Beside => low.map(|_| [left + width, top])?,
            Place::TopLeft => low.zip(right).map(|_| [left + gap, top + gap])?,
            Place::TopRight => low.and(right).map(|right| [left + right, top + gap])?,
            Place::BottomLeft => right.and(low).map(|low| [left + gap, top + low])?,
            Place::BottomRight => right.zip(low).map(|(right, low)| [left + right, top + low])?,
        };
        Some(self)
    }
}

/// Names of numbers in captions, which films fill in.
const NUMBERS: [&str; 5] = ["{beta}", "{gamma}", "{speed}", "{frame}", "{t}"];

/// Size of a title relative to that of a caption.
const TITLE: f64 = 1.25;

/// Greatest width of legend and caption beside or over the scene, in text sizes.
const PANEL: f64 = 19.0;

/// Height of capital letters with some space above, relative to the text size.
const CAPITAL: f64 = 0.8;

/// Space above and below a paragraph, in sizes of a caption's text.
const PADDING: f64 = 0.6;

/// Lines of text on a strip.
struct Paragraph {
    lines: Vec<Line>,
    /// Their em size in pixels.
    size: f64,
}

impl Paragraph {
    /// Text wrapped to a strip of this width, without its margins.
    fn new(text: &str, size: f64, width: u32, style: &Style) -> Result<Self, Error> {
        let room = f64::from(width) - 2.0 * style.margin();
        let lines = wrapped(text, size, room)?;
        let fits = lines.iter().all(|line| line.width() <= room);
        if fits { Ok(Self { lines, size }) } else { Err(Error::TooNarrow) }
    }

    fn rows(&self, style: &Style) -> u32 {
        let n_lines = self.lines.len();
        if n_lines == 0 {
            return 0;
        }
        let text = self.size * (CAPITAL + DESCENT + SPACING * (n_lines - 1) as f64);
        (text + 2.0 * PADDING * style.size).ceil() as u32
    }

    /// Draws it on a strip of this width that begins at row `top`. A single line is centred,
    /// several are left-aligned unless all are `centered`.
    fn draw(&self, width: u32, top: u32, centered: bool, style: &Style, drawing: &mut Drawing) {
        let margin = style.margin();
        let top = f64::from(top) + PADDING * style.size;
        for (idx, line) in self.lines.iter().enumerate() {
            let left = if centered || self.lines.len() == 1 {
                (0.5 * (f64::from(width) - line.width())).max(margin)
            } else {
                margin
            };
            // Base lines on whole rows look sharp.
            let base = (top + self.size * (CAPITAL + SPACING * idx as f64)).round();
            drawing.text(line, [left, base], style.ink);
        }
    }
}
