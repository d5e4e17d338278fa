//! What a figure has besides the picture: a caption, a legend, a grid, and the outline of undistorted bodies.
//!
//! Caption and legend stand on strips below the picture. The file keeps the size that is asked for: the scene is
//! drawn in what the strips leave, just as it would be drawn alone in that size. Grid and outline are drawn over it.
//! All of it is text and lines ([`uglabel`]), and comes after the light of the scene has been developed.

mod annotations;
mod depths;
mod grid;
mod legend;
mod motion;
mod outline;
mod style;

use std::borrow::Cow;

use ugimage::{Development, Format};
use uglabel::{DESCENT, Drawing, Line, SPACING, wrapped};

use crate::config::Config;
use crate::error::{Error, check_size};
use crate::setup::Setup;
pub use annotations::Annotations;
use depths::{Depths, coarse};
use motion::Motion;
use style::Style;

/// What a figure has besides the picture.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Figures {
    /// Text below the picture; none if there is nothing but blanks in it.
    pub caption: String,
    /// Below the picture: the rainbow with its wavelengths, velocities, γ, and the Doppler factors that are seen.
    pub legend: bool,
    /// Over the picture: the edges of moving bodies as they would look at rest.
    pub outline: bool,
    /// Over the picture: a grid of coordinates on the ground.
    pub grid: bool,
}

impl Figures {
    /// True if there is nothing besides the picture.
    fn is_plain(&self) -> bool {
        *self == Self::default()
    }
}

/// How a figure is laid out.
pub struct Plan {
    /// Of the whole.
    size: [u32; 2],
    /// Rows of the scene, above the strips.
    scene_rows: u32,
    /// Rows of the legend, below the scene.
    legend_rows: u32,
    caption: Vec<Line>,
}

impl Plan {
    /// That of a picture.
    ///
    /// # Errors
    /// The format has no place for it, the font lacks a character, or there is no room.
    pub fn new(config: &Config) -> Result<Self, Error> {
        check_size(config.size, config.samples)?;
        let figures = &config.figures;
        if !figures.is_plain() {
            check_output(config)?;
        }
        let style = Style::new(config.size, None, config.output);
        let [width, height] = config.size;
        let room = f64::from(width) - 2.0 * style.margin();
        let caption = wrapped(&figures.caption, style.size, room)?;
        let legend_rows = if figures.legend { legend::rows(&style, width) } else { Some(0) };
        let Some(legend_rows) = legend_rows.filter(|_| caption.iter().all(|line| line.width() <= room))
        else {
            return Err(Error::Options(
                "the picture is too narrow for a caption or legend: give a wider -sz, or leave out -cap and -lg",
            ));
        };
        let strips = legend_rows.saturating_add(caption_rows(&style, caption.len()));
        // With less than a third of its height it is no picture any more.
        match height.checked_sub(strips) {
            Some(scene_rows) if scene_rows > 0 && scene_rows >= height / 3 => {
                Ok(Self { size: config.size, scene_rows, legend_rows, caption })
            }
            _ => Err(Error::Options(
                "caption and legend leave no room for the picture: give a larger -sz, or a shorter -cap",
            )),
        }
    }

    /// What is asked of the picture of the scene. `config`: of the whole.
    pub fn of_scene<'a>(&self, config: &'a Config) -> Cow<'a, Config> {
        if self.scene_rows == self.size[1] {
            return Cow::Borrowed(config);
        }
        Cow::Owned(Config { size: [self.size[0], self.scene_rows], ..config.clone() })
    }

    /// All that is to be drawn, and notes about it. `config`: of the scene.
    ///
    /// # Errors
    /// As for pictures.
    pub fn annotations(
        &self,
        setup: &Setup<'_>,
        config: &Config,
        development: Option<Development>,
    ) -> Result<Annotations, Error> {
        let ground = crate::canvas::ground(config, development);
        let style = &Style::new(self.size, ground, config.output);
        let mut all = Annotations {
            size: self.size,
            scene_rows: self.scene_rows,
            ground,
            over: Drawing::default(),
            strips: Drawing::default(),
            notes: Vec::new(),
        };
        let Figures { legend, outline, grid, .. } = config.figures;
        if legend || outline || grid {
            let options = coarse(config);
            let coarse = Setup::new(setup.scene(), &options)?;
            if grid || legend {
                let depths = Depths::new(&coarse, &options.draw_mode());
                if grid {
                    all.notes.extend(grid::draw(&coarse, &depths, style, &mut all.over)?);
                }
                if legend {
                    let motion = Motion::new(&coarse, &depths, config);
                    let top = f64::from(self.scene_rows);
                    legend::draw(&motion, style, [f64::from(self.size[0]), top], &mut all.strips)?;
                }
            }
            if outline {
                all.notes.extend(outline::draw(&coarse, &options, style, &mut all.over)?);
            }
        }
        self.push_caption(style, &mut all.strips);
        Ok(all)
    }

    /// One line in the middle, several from the left.
    fn push_caption(&self, style: &Style, drawing: &mut Drawing) {
        let Style { size, ink, .. } = *style;
        let margin = style.margin();
        let top = f64::from(self.scene_rows + self.legend_rows) + padding(style);
        for (idx, line) in self.caption.iter().enumerate() {
            let left = match self.caption.len() {
                1 => (0.5 * (f64::from(self.size[0]) - line.width())).max(margin),
                _ => margin,
            };
            // Base lines on whole rows are sharp.
            let base = (top + size * (CAPITAL + SPACING * idx as f64)).round();
            drawing.text(line, [left, base], ink);
        }
    }
}

/// Height of capital letters with little above them, in parts of the size.
const CAPITAL: f64 = 0.8;

/// Above and below a caption.
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

fn check_output(config: &Config) -> Result<(), Error> {
    if config.output.format().is_some_and(Format::is_linear) {
        return Err(Error::Options(
            "EXR, PFM and HDR pictures hold the light of the scene and nothing else: \
             leave out -cap, -lg, -dl and -gr, or write -dt png16",
        ));
    }
    Ok(())
}
