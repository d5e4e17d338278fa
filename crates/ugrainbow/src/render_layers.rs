//! All faces and lines of a scene as layers for the rasterizer, in the packed layout that the scene
//! needs.

use std::sync::Arc;

use ugpicture::{DepthPoint, Filter};
use ugpipe::Progress;
use ugraster::{
    Center, Corner, FragmentTarget, FragmentWriter, NoTriangles, OpaqueLayer, PixelSamples, PolygonLayer,
    PolygonList, ProbedSample, Rasterizer, Resolve, SampleGrid, SampleStats, Scanner, ShadedSample,
    TRANSPARENT_VALUES, Tile, TransparentLayer,
};
use ugscene::Face;

use crate::clip::ClipCounts;
use crate::config::DrawMode;
use crate::drawlist::DrawList;
use crate::exact::{CurvedLines, Faces};
use crate::lines::{LineShape, Occluders, StraightLines, Stroke, Visibility, lines, pieces, strips, strokes};
use crate::packing::{
    Pack, PackedLayout, pack_colored, pack_mixed, pack_mixed_colored, pack_plain, pack_transparent,
};
use crate::painter::Painter;
use crate::shade::Shader;

/// Reports the painted fraction of a picture as progress of a step.
struct Drawing<'a>(&'a dyn Progress);

impl ugraster::BandProgress for Drawing<'_> {
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
    solid: Solid<'a>,
    clear: ClearLayers<'a>,
    has_faces: bool,
    clip_counts: ClipCounts,
    progress: &'a dyn Progress,
}

/// Opaque faces, in one of the layouts of [`crate::packing`].
enum Solid<'a> {
    /// Hues under white light.
    Plain(Layers<'a, 3>),
    /// Hues under coloured lights.
    Colored(Layers<'a, 6>),
    /// Hues, and colours given as light, under white light.
    Mixed(Layers<'a, 4>),
    /// As [`Solid::Mixed`], under coloured lights.
    MixedColored(Layers<'a, 7>),
}

/// Expands to the same expression for every layout.
macro_rules! with_layers {
    ($solid:expr, |$layers:ident| $body:expr) => {
        match $solid {
            Solid::Plain($layers) => $body,
            Solid::Colored($layers) => $body,
            Solid::Mixed($layers) => $body,
            Solid::MixedColored($layers) => $body,
        }
    };
}

/// Expands to an expression with the rasterizer of all layers, whose number of values depends on
/// their layout.
macro_rules! with_rasterizer {
    ($all:expr, $grid:expr, $shader:expr, |$rasterizer:ident| $body:expr) => {{
        let lit = $all.lit($shader);
        let transparent = lit.as_ref().map(|lit| lit as &dyn TransparentLayer);
        with_layers!(&$all.solid, |layers| {
            let $rasterizer = Rasterizer { grid: $grid, opaque: layers, transparent };
            $body
        })
    }};
}

/// Faces.
struct Layers<'a, const N: usize> {
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
        mode: &DrawMode,
        is_transparent: bool,
        pack: Pack<N>,
    ) -> Self {
        let is_one = |face: &Face| painter.is_transparent(face) == is_transparent;
        let surfaces = match mode.exact {
            None => Surfaces::Polygons(DrawList::new(painter, is_one, pack)),
            Some(_) => Surfaces::Rays(Box::new(Faces::new(painter, planes, is_one, pack))),
        };
        Self { surfaces, is_drawn: mode.has_faces(), planes: planes.clone() }
    }

    fn n_values(&self) -> usize {
        N
    }

    fn clip_counts(&self) -> ClipCounts {
        match &self.surfaces {
            Surfaces::Rays(faces) => faces.clip_counts,
            Surfaces::Polygons(list) => list.clip_counts,
        }
    }

    /// The visible parts of pieces of lines.
    fn shown(&self, painter: &Painter<'_>, all: &[Stroke], width: f64) -> Vec<Stroke> {
        let size = [painter.grid.sample_columns(), painter.grid.sample_rows()];
        // One sample more than half the width.
        let margin = 0.5 * width + 1.0;
        match &self.surfaces {
            Surfaces::Rays(faces) => {
                let is_hidden = |[x, y, key]: DepthPoint| faces.hides([x, y], key);
                strokes(all, &Visibility::by_rays(&is_hidden, size, margin))
            }
            Surfaces::Polygons(list) => {
                let boxes = all.iter().map(Stroke::bounds);
                let occluders = Occluders::new(list.outlines(), boxes, size, margin);
                strokes(all, &Visibility::behind(occluders, size, margin))
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
    /// `None` if no face is translucent.
    faces: Option<Layers<'a, TRANSPARENT_VALUES>>,
    /// Visible parts of lines.
    strokes: Vec<Stroke>,
    /// The strokes as strips of their width.
    lines: [PolygonList<TRANSPARENT_VALUES>; 1],
}

/// Transparent layers with their shader.
struct Lit<'a, 's> {
    layers: &'s ClearLayers<'a>,
    shader: &'s Shader,
}

impl TransparentLayer for Lit<'_, '_> {
    fn draw(
        &self,
        grid: &SampleGrid,
        band: usize,
        scanner: &mut Scanner<TRANSPARENT_VALUES>,
        target: &mut FragmentTarget<'_>,
    ) {
        let shade = |values: &[[f32; TRANSPARENT_VALUES]], shaded: &mut [(ShadedSample, f32)]| {
            for (shaded, values) in shaded.iter_mut().zip(values) {
                *shaded = self.shader.transparent(values);
            }
        };
        if let Some(faces) = &self.layers.faces {
            faces.draw_transparent(grid, band, scanner, &mut target.writer(&shade, false));
        }
        let lines = PolygonLayer { lists: &self.layers.lines, corners: &NoTriangles };
        lines.draw_on(grid, band, scanner, &mut target.writer(&shade, true));
    }
}

impl<'a> RenderLayers<'a> {
    /// All faces and wires.
    pub fn new(painter: Painter<'a>, mode: &DrawMode) -> Self {
        let surface = &painter.appearance.surface;
        let planes = ugscene::shared_planes(painter.scene, surface.all_rest(), surface.frames()).into();
        let solid = match PackedLayout::new(painter.appearance, painter.lighting) {
            PackedLayout::Plain => Solid::Plain(Layers::new(painter, &planes, mode, false, pack_plain)),
            PackedLayout::Colored => Solid::Colored(Layers::new(painter, &planes, mode, false, pack_colored)),
            PackedLayout::Mixed => Solid::Mixed(Layers::new(painter, &planes, mode, false, pack_mixed)),
            PackedLayout::MixedColored => {
                Solid::MixedColored(Layers::new(painter, &planes, mode, false, pack_mixed_colored))
            }
        };
        let faces = painter
            .appearance
            .palette
            .has_translucency()
            .then(|| Layers::new(painter, &planes, mode, true, pack_transparent));
        let shape: Box<dyn LineShape> = match mode.exact {
            Some(_) => Box::new(CurvedLines::new(painter)),
            None => Box::new(StraightLines::new(painter)),
        };
        let lines = lines(&painter, mode.wireframe, &*shape);
        let (pieces, mut clip_counts) = pieces(&painter, &lines, &*shape);
        let width = mode.line_width * f64::from(painter.grid.samples);
        let strokes = if pieces.is_empty() {
            Vec::new()
        } else {
            with_layers!(&solid, |layers| layers.shown(&painter, &pieces, width))
        };
        if mode.has_faces() {
            clip_counts = clip_counts.merge(with_layers!(&solid, |layers| layers.clip_counts()));
            clip_counts = faces.iter().fold(clip_counts, |all, faces| all.merge(faces.clip_counts()));
        }
        let lines = [strips(&painter, &strokes, width)];
        Self {
            solid,
            clear: ClearLayers { faces, strokes, lines },
            has_faces: mode.has_faces(),
            clip_counts,
            progress: &(),
        }
    }

    /// With progress reports while drawing.
    pub fn telling(self, progress: &'a dyn Progress) -> Self {
        Self { progress, ..self }
    }

    /// How many faces and lines were clipped.
    pub fn clip_counts(&self) -> ClipCounts {
        self.clip_counts
    }

    fn lit<'s>(&'s self, shader: &'s Shader) -> Option<Lit<'a, 's>> {
        let has_faces = self.has_faces && self.clear.faces.is_some();
        (has_faces || !self.clear.strokes.is_empty()).then_some(Lit { layers: &self.clear, shader })
    }

    /// Draws all pixels of the grid, row after row. `resolve` combines the samples of a pixel.
    pub fn paint<P: Copy + Send + Sync>(
        &self,
        grid: &SampleGrid,
        filter: Filter,
        shader: &Shader,
        resolve: &impl Resolve<P>,
    ) -> (Vec<P>, SampleStats) {
        let progress = &Drawing(self.progress);
        with_rasterizer!(self, grid, shader, |rasterizer| match filter {
            Filter::Box => rasterizer.paint(shader, resolve, progress),
            _ => rasterizer.paint_filtered(filter, shader, resolve, progress),
        })
    }

    /// Like [`RenderLayers::paint`] without a filter; `resolve` also receives the surfaces at the
    /// centres of pixels.
    pub fn paint_with_centers<P: Copy + Send + Sync>(
        &self,
        grid: &SampleGrid,
        shader: &Shader,
        resolve: &impl Resolve<P>,
    ) -> (Vec<P>, SampleStats) {
        with_rasterizer!(self, grid, shader, |rasterizer| {
            rasterizer.paint_with_centers(shader, resolve, &Drawing(self.progress))
        })
    }

    /// The pixels of the grid, row after row, each from the surfaces at its centre.
    pub fn paint_centers<P: Copy + Send + Sync>(
        &self,
        grid: &SampleGrid,
        shader: &Shader,
        pixel: impl Fn(&Center<'_>) -> P + Sync,
    ) -> Vec<P> {
        with_rasterizer!(self, grid, shader, |rasterizer| {
            rasterizer.paint_centers(pixel, &Drawing(self.progress))
        })
    }

    /// One pixel as [`RenderLayers::paint`] draws it.
    pub fn probe_filtered<P: Copy>(
        &self,
        grid: &SampleGrid,
        filter: Filter,
        shader: &Shader,
        resolve: &impl Resolve<P>,
        pixel: [u32; 2],
    ) -> P {
        with_rasterizer!(self, grid, shader, |rasterizer| {
            rasterizer.probe_filtered(filter, shader, resolve, pixel)
        })
    }

    /// All samples of one pixel, and the pixel.
    pub fn probe<P: Copy>(
        &self,
        grid: &SampleGrid,
        shader: &Shader,
        resolve: &impl Resolve<P>,
        pixel: [u32; 2],
    ) -> (Vec<ProbedSample>, PixelSamples<'static>, P) {
        with_rasterizer!(self, grid, shader, |rasterizer| rasterizer.probe(shader, resolve, pixel))
    }
}

/// Access for vector figures.
impl RenderLayers<'_> {
    /// True if a face in the picture is translucent.
    pub fn has_transparent_faces(&self) -> bool {
        self.has_faces && self.clear.faces.as_ref().is_some_and(|faces| faces.clip_counts().in_picture > 0)
    }

    /// Passes every polygon to `take`: its item, whether it is translucent, and its contours.
    /// Opaque ones come first; their values are padded with zeros.
    pub fn for_each_polygon(&self, mut take: impl FnMut(u32, bool, Vec<Vec<Corner<TRANSPARENT_VALUES>>>)) {
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
                    contours.into_iter().map(|contour| contour.iter().map(padded).collect()).collect(),
                );
            });
        }
        if self.has_faces {
            with_layers!(&self.solid, |layers| all(layers, |item, contours| take(item, false, contours)));
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
    pub fn shade(&self, shader: &Shader, values: &[f32; TRANSPARENT_VALUES]) -> ShadedSample {
        shader.opaque(&values[..with_layers!(&self.solid, |layers| layers.n_values())])
    }
}
