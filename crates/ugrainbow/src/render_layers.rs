//! All faces and lines of a scene as layers for the rasterizer, in the packed layout that the scene
//! needs.

use std::sync::Arc;

use ugpicture::{DepthPoint, Filter, visible_parts};
use ugpipe::Progress;
use ugraster::{
    BandProgress, Corner, FragmentTarget, FragmentWriter, Keep, NoTriangles, OpaqueLayer,
    PolygonLayer, PolygonList, Resolve, SampleGrid, SampleStats, Scanner, ShadedSample,
    TRANSPARENT_VALUES, Tile, TransparentLayer,
};
use ugscene::Face;

use crate::config::{Config, HiddenLines};
use crate::drawlist::DrawList;
use crate::error::Error;
use crate::exact::Faces;
use crate::lines::{Occluders, Stroke, Visibility, lines, pieces, strips, strokes};
use crate::packing::{Layout, Pack, pack_hue, pack_light, pack_transparent, pack_white};
use crate::painter::Painter;
use crate::setup::Setup;
use crate::shade::Shader;

/// Reports the painted fraction of a picture as progress of a step.
struct Drawing<'a>(&'a dyn Progress);

impl BandProgress for Drawing<'_> {
    fn begin(&self, parts: u64) {
        self.0.step("drawing", parts);
    }

    fn done(&self) {
        self.0.done(1);
    }

    fn is_stopped(&self) -> bool {
        self.0.is_stopped()
    }
}

/// All faces and lines of a scene.
pub struct RenderLayers<'a> {
    pub grid: &'a SampleGrid,
    pub shader: &'a Shader,
    pub solid: Solid<'a>,
    clear: ClearLayers<'a>,
    has_faces: bool,
    progress: &'a dyn Progress,
}

/// Opaque faces, with the number of values that [`Layout`] says.
pub enum Solid<'a> {
    Few(Layers<'a, 3>),
    Many(Layers<'a, TRANSPARENT_VALUES>),
}

/// Expands to the same expression for every layout.
macro_rules! with_layers {
    ($solid:expr, |$layers:ident| $body:expr) => {
        match $solid {
            $crate::render_layers::Solid::Few($layers) => $body,
            $crate::render_layers::Solid::Many($layers) => $body,
        }
    };
}

/// Expands to an expression with the rasterizer of all layers, whose number of values depends on
/// their layout.
macro_rules! with_rasterizer {
    ($all:expr, |$rasterizer:ident| $body:expr) => {{
        let (grid, transparent) = ($all.grid, $all.transparent());
        $crate::render_layers::with_layers!(&$all.solid, |opaque| {
            let $rasterizer = ugraster::Rasterizer { grid, opaque, transparent };
            $body
        })
    }};
}
pub(crate) use {with_layers, with_rasterizer};

/// Faces.
pub struct Layers<'a, const N: usize> {
    surfaces: Surfaces<'a, N>,
    /// False if they only occlude.
    is_drawn: bool,
    /// The plane of each face, see [`ugscene::shared_planes`].
    planes: Arc<[u32]>,
}

/// How faces are intersected with samples.
enum Surfaces<'a, const N: usize> {
    Rays(Box<Faces<'a, N>>),
    Polygons(DrawList<'a, N>),
}

impl<'a, const N: usize> Layers<'a, N> {
    fn new(
        painter: Painter<'a>,
        planes: &Arc<[u32]>,
        config: &Config,
        is_transparent: bool,
        pack: Pack<N>,
    ) -> Self {
        let is_one = |face: &Face| painter.is_transparent(face) == is_transparent;
        let surfaces = match config.exact {
            None => Surfaces::Polygons(DrawList::new(painter, is_one, pack)),
            Some(_) => Surfaces::Rays(Box::new(Faces::new(painter, planes, is_one, pack))),
        };
        Self { surfaces, is_drawn: config.has_faces(), planes: planes.clone() }
    }

    /// How many of its faces are in the picture.
    fn n_in_picture(&self) -> usize {
        match &self.surfaces {
            Surfaces::Rays(faces) => faces.n_in_picture,
            Surfaces::Polygons(list) => list.n_in_picture,
        }
    }

    /// What is drawn of pieces of lines.
    fn shown(
        &self,
        painter: &Painter<'_>,
        all: &[Stroke],
        hidden: HiddenLines,
        width: f64,
    ) -> Result<Vec<Stroke>, Error> {
        let size = [painter.grid.sample_columns(), painter.grid.sample_rows()];
        // One sample more than half the width.
        let margin = 0.5 * width + 1.0;
        match &self.surfaces {
            Surfaces::Rays(faces) => {
                let is_hidden = |[x, y, key]: DepthPoint| faces.hides([x, y], key);
                let visible = |ends, within| visible_parts(ends, within, is_hidden);
                Ok(strokes(all, &Visibility::new(&visible, size, margin), hidden, width))
            }
            Surfaces::Polygons(list) => {
                let boxes = all.iter().map(Stroke::bounds);
                let occluders = Occluders::new(list.outlines(), boxes, size, margin)?;
                let visible = |ends, within| occluders.visible(ends, within);
                Ok(strokes(all, &Visibility::new(&visible, size, margin), hidden, width))
            }
        }
    }
}

impl<const N: usize> OpaqueLayer<N> for Layers<'_, N> {
    fn draw(&self, grid: &SampleGrid, band: usize, scanner: &mut Scanner<N>, tile: &mut Tile<N>) {
        if !self.is_drawn {
            return;
        }
        match &self.surfaces {
            Surfaces::Rays(faces) => faces.draw(band, tile),
            Surfaces::Polygons(list) => list.shapes().draw(grid, band, scanner, tile),
        }
    }

    fn planes(&self) -> Arc<[u32]> {
        self.planes.clone()
    }
}

impl Layers<'_, TRANSPARENT_VALUES> {
    /// Draws the layers of a band as transparent fragments.
    fn draw_transparent(
        &self,
        grid: &SampleGrid,
        band: usize,
        scanner: &mut Scanner<TRANSPARENT_VALUES>,
        writer: &mut FragmentWriter<'_, '_>,
    ) {
        if !self.is_drawn {
            return;
        }
        match &self.surfaces {
            Surfaces::Rays(faces) => faces.draw_transparent(band, writer),
            Surfaces::Polygons(list) => list.shapes().draw_on(grid, band, scanner, writer),
        }
    }
}

/// Transparent layers: translucent faces, and the visible parts of lines.
struct ClearLayers<'a> {
    shader: &'a Shader,
    /// `None` if no face is translucent.
    faces: Option<Layers<'a, TRANSPARENT_VALUES>>,
    /// Visible parts of lines.
    strokes: Vec<Stroke>,
    /// The strokes as strips of their width.
    lines: [PolygonList<TRANSPARENT_VALUES>; 1],
}

impl TransparentLayer for ClearLayers<'_> {
    fn draw(
        &self,
        grid: &SampleGrid,
        band: usize,
        scanner: &mut Scanner<TRANSPARENT_VALUES>,
        target: &mut FragmentTarget<'_>,
    ) {
        if let Some(faces) = &self.faces {
            faces.draw_transparent(grid, band, scanner, &mut target.writer(self.shader, false));
        }
        let lines = PolygonLayer { lists: &self.lines, corners: &NoTriangles };
        lines.draw_on(grid, band, scanner, &mut target.writer(self.shader, true));
    }
}

impl<'a> RenderLayers<'a> {
    /// All faces and wires.
    ///
    /// # Errors
    /// [`Error::CrossedFaces`].
    pub fn new(setup: &'a Setup<'_>, config: &Config) -> Result<Self, Error> {
        let painter = setup.painter();
        let surface = &painter.appearance.surface;
        let planes =
            ugscene::shared_planes(painter.scene, surface.all_rest(), surface.frames()).into();
        let few = |pack| Solid::Few(Layers::new(painter, &planes, config, false, pack));
        let many = |pack| Solid::Many(Layers::new(painter, &planes, config, false, pack));
        let solid = match setup.layout {
            Layout::Hues => few(pack_hue),
            Layout::Light => few(pack_light),
            Layout::Mixed { has_levels: false } => many(pack_white),
            Layout::Mixed { has_levels: true } => many(pack_transparent),
        };
        let has_translucency =
            painter.appearance.palette.has_translucency || painter.textures.has_translucency();
        let faces =
            has_translucency.then(|| Layers::new(painter, &planes, config, true, pack_transparent));
        let is_exact = config.exact.is_some();
        let lines = lines(&painter, config.wireframe, is_exact);
        let pieces = pieces(&painter, &lines, is_exact);
        let width = config.line_width * f64::from(painter.grid.samples);
        let strokes = if pieces.is_empty() {
            Vec::new()
        } else {
            let hidden =
                config.wireframe.map_or(HiddenLines::Omitted, |wireframe| wireframe.hidden);
            with_layers!(&solid, |layers| layers.shown(&painter, &pieces, hidden, width))?
        };
        let lines = [strips(&painter, &strokes, width)];
        let (grid, shader) = (&setup.grid, &setup.shader);
        Ok(Self {
            grid,
            shader,
            solid,
            clear: ClearLayers { shader, faces, strokes, lines },
            has_faces: config.has_faces(),
            progress: &(),
        })
    }

    /// Reports progress while drawing.
    pub fn with_progress(self, progress: &'a dyn Progress) -> Self {
        Self { progress, ..self }
    }

    /// Progress of drawing.
    pub fn progress(&self) -> impl BandProgress + use<'a> {
        Drawing(self.progress)
    }

    /// The transparent layers, if there are any.
    pub fn transparent(&self) -> Option<&dyn TransparentLayer> {
        let has_faces = self.has_faces && self.clear.faces.is_some();
        (has_faces || !self.clear.strokes.is_empty()).then_some(&self.clear)
    }

    /// Draws all pixels of the grid, row after row. `resolve` combines the samples of a pixel.
    pub fn paint<P: Copy + Send + Sync>(
        &self,
        filter: Filter,
        resolve: &impl Resolve<P>,
    ) -> (Vec<P>, SampleStats) {
        with_rasterizer!(self, |rasterizer| match filter {
            Filter::Box => rasterizer.paint(self.shader, Keep::Light, resolve, &self.progress()),
            _ => rasterizer.paint_filtered(filter, self.shader, resolve, &self.progress()),
        })
    }
}

/// Access for vector figures.
impl RenderLayers<'_> {
    /// True if a face in the picture is translucent.
    pub fn has_transparent_faces(&self) -> bool {
        self.has_faces && self.clear.faces.as_ref().is_some_and(|faces| faces.n_in_picture() > 0)
    }

    /// Passes every polygon to `take`: its item, whether it is translucent, and its contours.
    /// Opaque ones come first; their values are padded with zeros.
    pub fn for_each_polygon(
        &self,
        mut take: impl FnMut(u32, bool, Vec<Vec<Corner<TRANSPARENT_VALUES>>>),
    ) {
        fn all<const N: usize>(
            layers: &Layers<'_, N>,
            mut take: impl FnMut(u32, Vec<Vec<Corner<TRANSPARENT_VALUES>>>),
        ) {
            let Surfaces::Polygons(list) = &layers.surfaces else { return };
            let padded = |corner: &Corner<N>| Corner {
                x: corner.x,
                y: corner.y,
                key: corner.key,
                values: std::array::from_fn(|i| corner.values.get(i).copied().unwrap_or(0.0)),
            };
            list.for_each_polygon(|item, contours| {
                take(
                    item,
                    contours
                        .into_iter()
                        .map(|contour| contour.iter().map(padded).collect())
                        .collect(),
                );
            });
        }
        if self.has_faces {
            with_layers!(&self.solid, |layers| all(layers, |item, contours| take(
                item, false, contours
            )));
            if let Some(clear) = &self.clear.faces {
                all(clear, |item, contours| take(item, true, contours));
            }
        }
    }

    /// The plane of each face, see [`ugscene::shared_planes`].
    pub fn planes(&self) -> &[u32] {
        with_layers!(&self.solid, |layers| &layers.planes)
    }

    /// The visible parts of lines.
    pub fn strokes(&self) -> &[Stroke] {
        &self.clear.strokes
    }

    /// The light of values interpolated between corners of an opaque polygon of
    /// [`RenderLayers::for_each_polygon`].
    pub fn shade(&self, values: &[f32; TRANSPARENT_VALUES]) -> ShadedSample {
        match &self.solid {
            Solid::Few(_) => self.shader.one(&[values[0], values[1], values[2]]),
            Solid::Many(_) => self.shader.one(values),
        }
    }
}
