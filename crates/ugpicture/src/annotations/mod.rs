//! Annotations of a picture: a caption, a legend, a coordinate grid, the outlines of undistorted
//! bodies, and quantities of what is seen as false colours and lines.
//!
//! Caption and legend are on strips below the picture of the scene. The file keeps the requested
//! size: the scene is drawn in the remaining rows, exactly as a picture of that size. Grid and
//! outlines are drawn over it. All annotations consist of text and lines ([`ugimage::label`]),
//! drawn after the light of the scene has been developed.

mod color_bar;
mod composite;
mod grid;
mod iso;
mod legend;
mod map;
mod motion;
mod outline;
mod seen;
mod style;

use rayon::prelude::*;
use ugimage::Frame;
use ugimage::figure::Point;
use ugimage::label::{DESCENT, Drawing, Line, SPACING, wrapped};
use ugscene::{CameraOptions, Scene, View};

use crate::background::Backdrop;
use crate::emission::SeenItem;
use crate::error::Error;
use crate::options::{AnnotationOptions, PictureOptions};
pub use composite::Annotations;
pub use map::Scale;
use motion::MotionSummary;
use seen::{SeenScene, velocities};
use style::Style;

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
    /// Rows of the scene, which is at the top.
    scene_rows: u32,
    /// Rows of the scale of false colours below it.
    scale_rows: u32,
    /// Rows of the legend below that.
    legend_rows: u32,
    caption: Vec<Line>,
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
        let style = Style::new(options.size, annotations.text_size, None, options.output);
        let [width, height] = options.size;
        let room = f64::from(width) - 2.0 * style.margin();
        let caption = wrapped(&annotations.caption, style.size, room)?;
        let rows = |is_drawn: bool, rows: fn(&Style, u32) -> Option<u32>| {
            if is_drawn { rows(&style, width).ok_or(Error::TooNarrow) } else { Ok(0) }
        };
        let scale_rows = rows(annotations.map.is_some(), color_bar::rows)?;
        let legend_rows = rows(annotations.legend, legend::rows)?;
        if caption.iter().any(|line| line.width() > room) {
            return Err(Error::TooNarrow);
        }
        let below = scale_rows.saturating_add(legend_rows);
        let strips = below.saturating_add(caption_rows(&style, caption.len()));
        // Less than a third of the height is not enough for the scene.
        match height.checked_sub(strips) {
            Some(scene_rows) if scene_rows > 0 && scene_rows >= height / 3 => {
                Ok(Self { size: options.size, scene_rows, scale_rows, legend_rows, caption })
            }
            _ => Err(Error::NoRoom),
        }
    }

    /// The options for the picture of the scene alone. `options`: of the whole picture.
    pub fn of_scene(&self, options: &PictureOptions) -> PictureOptions {
        PictureOptions { size: [self.size[0], self.scene_rows], ..options.clone() }
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
        let Subject::Surfaces { items, .. } = annotated.subject else { return Err(Error::NoSurfaces.into()) };
        let [width, height] = options.size.map(|side| side as usize * options.samples as usize);
        let mut values = Vec::new();
        items(true, &mut |item| {
            let value = |idx| map::value(map.quantity, item(idx));
            values = (0..width * height).into_par_iter().map(value).collect();
        })?;
        let scale = Scale::new(map, &values, &options.annotations.units);
        Ok(Some((map::picture(&scale, &values, options), scale)))
    }

    /// All annotations, and notes about them. `options`: of the picture of the scene;
    /// `development`: of its light; `scale`: of its false colours.
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
        let style = &Style::new(self.size, options.annotations.text_size, background, options.output);
        let mut all = Annotations {
            size: self.size,
            scene_rows: self.scene_rows,
            background,
            over: Drawing::default(),
            strips: Drawing::default(),
            text: options.text,
            notes: Vec::new(),
        };
        let AnnotationOptions { legend, outline, grid, ref iso, ref units, .. } = options.annotations;
        if let Subject::Surfaces { view, items, scene, wires } = annotated.subject {
            if let (Some(scene), Some(wires), true) = (scene, wires, outline || grid) {
                let seen = SeenScene::new(scene, view, options, wires)?;
                if grid {
                    all.notes.extend(grid::draw(&seen, units, style, &mut all.over)?);
                }
                if outline {
                    all.notes.extend(outline::draw(&seen, style, &mut all.over)?);
                }
            }
            if let Some(iso) = iso {
                let mut drawn = Ok(());
                items(false, &mut |item| {
                    drawn = iso::draw(iso, units, options.size, scene, item, style, &mut all.over)
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
                let place = [self.size[0], self.scene_rows + self.scale_rows].map(f64::from);
                if let Some(motion) = motion {
                    legend::draw(&motion, units, style, place, &mut all.strips).map_err(Error::from)?;
                }
            }
        } else if iso.is_some() {
            return Err(Error::NoSurfaces.into());
        }
        if let Some(scale) = scale {
            let place = [self.size[0], self.scene_rows].map(f64::from);
            color_bar::draw(scale, style, place, &mut all.strips).map_err(Error::from)?;
        }
        self.push_caption(style, &mut all.strips);
        Ok(all)
    }

    /// A single line is centred, several are left-aligned.
    fn push_caption(&self, style: &Style, drawing: &mut Drawing) {
        let Style { size, ink, .. } = *style;
        let margin = style.margin();
        let above = self.scene_rows + self.scale_rows + self.legend_rows;
        let top = f64::from(above) + padding(style);
        for (idx, line) in self.caption.iter().enumerate() {
            let left = match self.caption.len() {
                1 => (0.5 * (f64::from(self.size[0]) - line.width())).max(margin),
                _ => margin,
            };
            // Base lines on whole rows look sharp.
            let base = (top + size * (CAPITAL + SPACING * idx as f64)).round();
            drawing.text(line, [left, base], ink);
        }
    }
}

/// Height of capital letters with some space above, relative to the text size.
const CAPITAL: f64 = 0.8;

/// Space above and below a caption.
fn padding(style: &Style) -> f64 {
    0.6 * style.size
}

fn caption_rows(style: &Style, n_lines: usize) -> u32 {
    if n_lines == 0 {
        return 0;
    }
    let text = style.size * (CAPITAL + DESCENT + SPACING * (n_lines - 1) as f64);
    (text + 2.0 * padding(style)).ceil() as u32
}
