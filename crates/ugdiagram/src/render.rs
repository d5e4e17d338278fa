//! From a scene to the file of its diagram.

use ugimage::figure::Figure;
use ugimage::{Format, Frame};
use ugparse::Source;
use ugpicture::{
    Annotated, Canvas, Drawn, DrawnContent, Output, PictureFile, PictureOptions, Rendering, Style,
    Subject, VectorFigure, metadata,
};
use ugpipe::Progress;
use ugscene::{Provenance, Scene};

use crate::config::Config;
use crate::diagram::Diagram;
use crate::drawing::{DrawnDiagram, Sheet, draw};
use crate::error::Error;
use crate::note::Note;
use crate::spacetime::Spacetime;
use crate::table::table;

/// This program, without a command line, for the history of what it makes.
pub const PROVENANCE: Provenance<'static> = Provenance {
    program: env!("CARGO_PKG_NAME"),
    version: env!("CARGO_PKG_VERSION"),
    command: None,
    files: &[],
};

/// A diagram as a file, with all that is said about it.
#[derive(Clone, Debug)]
pub struct DiagramFile {
    /// The picture.
    pub picture: PictureFile,
    /// Its events and intervals as CSV.
    pub table: String,
    /// Notes on the diagram.
    pub notes: Vec<Note>,
}

/// The picture of a diagram, and the diagram.
pub struct RenderedDiagram {
    /// The picture.
    pub rendering: Rendering,
    /// Lines, marks and intervals.
    pub diagram: Diagram,
    /// Places of labels.
    pub drawn: DrawnDiagram,
    /// Notes on it.
    pub notes: Vec<Note>,
}

/// Draws the diagram of a scene at rest.
///
/// # Errors
/// See [`Error`].
pub fn render(scene: Scene, config: &Config) -> Result<RenderedDiagram, Error> {
    render_with(scene, config, PROVENANCE, &())
}

/// Reads a scene, draws its diagram, and packs it into a file. `provenance`: for the history in the
/// file.
///
/// # Errors
/// See [`Error`].
pub fn run(
    config: &Config,
    source: &Source,
    provenance: Provenance<'_>,
    progress: &dyn Progress,
) -> Result<DiagramFile, Error> {
    progress.step("reading", 0);
    let camera = config.picture.camera.name.as_deref();
    let parsed = ugparse::read(source, &config.reading, camera).map_err(Error::Text)?;
    let RenderedDiagram { rendering, diagram, notes, .. } =
        render_with(parsed.scene, config, provenance, progress)?;
    let picture = rendering.pack(parsed.warnings, progress);
    Ok(DiagramFile { picture, table: table(&diagram), notes })
}

fn render_with(
    scene: Scene,
    config: &Config,
    provenance: Provenance<'_>,
    progress: &dyn Progress,
) -> Result<RenderedDiagram, Error> {
    let canvas = Canvas::new(&config.picture)?;
    progress.step("drawing", 0);
    let picture = canvas.options();
    let metadata = metadata(&scene.head, provenance);
    let spacetime = Spacetime::new(scene, &config.motion, &picture.camera, picture.size)?;
    let style = Style::new(config.picture.size, picture, None);
    let sheet = Sheet {
        size: picture.size.map(f64::from),
        em: style.size,
        hairline: style.hairline,
        units: picture.annotations.units.clone(),
    };
    let [width, height] = picture.size;
    let area = sheet.area().ok_or(Error::NoRoom(width, height))?;
    let ratio = (area[2] - area[0]) / (area[3] - area[1]);
    let diagram = Diagram::new(&spacetime, &config.diagram, ratio)?;
    let drawn = draw(&diagram, &sheet, area).map_err(ugpicture::Error::Text)?;
    progress.check().map_err(ugpicture::Error::from)?;
    let content = match picture.output {
        Output::Vector(Format::Svg) => {
            DrawnContent::Figure(VectorFigure::Gradients(figure(&drawn, picture)), None)
        }
        Output::Vector(format) => {
            DrawnContent::Figure(VectorFigure::Triangles(figure(&drawn, picture), format), None)
        }
        Output::Color(_) => {
            let n_pixels = width as usize * height as usize;
            let mut frame = Frame::new(picture.size, true, vec![[255; 4]; n_pixels]);
            drawn.drawing.paint(&mut frame);
            DrawnContent::Display(frame)
        }
    };
    let annotated = Annotated { is_shifted: false, subject: Subject::Pixels };
    let shown = Drawn::<Error> { content, brightest: 0.0, notes: Vec::new(), annotated };
    let rendering = canvas.finish(shown, metadata, progress)?;
    let notes = Note::all(&diagram, &drawn.omitted);
    Ok(RenderedDiagram { rendering, diagram, drawn, notes })
}

/// A diagram on white paper.
fn figure<S>(drawn: &DrawnDiagram, picture: &PictureOptions) -> Figure<S> {
    let elements = drawn.drawing.elements(picture.text);
    Figure { size: picture.size, background: Some([255; 3]), elements }
}
