//! Everything to be drawn, packed as the scene needs it.

use glam::DVec3;

use crate::config::Exact;
use crate::drawlist::{DrawList, Reach};
use crate::exact::{Bend, Faces};
use crate::painter::Painter;
use crate::palette::Swatch;
use crate::raster::{Corner, Gathered, Grid, Layer, Sample, Scanner, Shade, Tag, Tally, Tile, paint, probe};
use crate::shade::Shader;

/// Turns a colour and the level of red, green and blue light into the numbers to interpolate.
pub type Pack<const N: usize> = fn(&Swatch, DVec3) -> [f64; N];

/// Everything with the numbers to interpolate: hues alone or with colours given as light among them, under
/// white or coloured lights.
pub enum Sheet<'a> {
    /// Tint, saturation, value.
    Plain(Layers<'a, 3>),
    /// The same, and the level of red, green and blue light.
    Colored(Layers<'a, 6>),
    /// As plain, or linear light; and which.
    Mixed(Layers<'a, 4>),
    /// As coloured, or linear light; and which.
    MixedColored(Layers<'a, 7>),
}

/// What is drawn.
pub struct Layers<'a, const N: usize> {
    /// Faces that rays find.
    faces: Option<Faces<'a, N>>,
    /// All polygons, which come behind those faces.
    polygons: DrawList<'a, N>,
}

impl<'a, const N: usize> Layers<'a, N> {
    fn new(painter: Painter<'a>, exact: Option<Exact>, pack: Pack<N>) -> Self {
        match exact {
            None => Self { faces: None, polygons: DrawList::new(painter, pack) },
            Some(exact) => Self {
                polygons: DrawList::wires(painter, &Bend::new(painter, exact), pack),
                faces: Some(Faces::new(painter, exact, pack)),
            },
        }
    }

    fn reach(&self) -> Reach {
        self.faces.iter().fold(self.polygons.reach, |reach, faces| reach.merge(faces.reach))
    }
}

impl<const N: usize> Layer<N> for Layers<'_, N> {
    fn draw<T: Tag>(&self, grid: &Grid, band: usize, scanner: &mut Scanner<N>, tile: &mut Tile<N, T>) {
        if let Some(faces) = &self.faces {
            faces.draw(grid, band, scanner, tile);
        }
        self.polygons.shapes().draw(grid, band, scanner, tile);
    }
}

impl<'a> Sheet<'a> {
    /// All faces and wires.
    pub fn new(painter: Painter<'a>, exact: Option<Exact>) -> Self {
        match (painter.palette.has_light(), painter.lighting.is_colored()) {
            (false, false) => Self::Plain(Layers::new(painter, exact, pack_plain)),
            (false, true) => Self::Colored(Layers::new(painter, exact, pack_colored)),
            (true, false) => Self::Mixed(Layers::new(painter, exact, pack_mixed)),
            (true, true) => Self::MixedColored(Layers::new(painter, exact, pack_mixed_colored)),
        }
    }

    /// How many faces and wires came how far.
    pub fn reach(&self) -> Reach {
        match self {
            Self::Plain(layers) => layers.reach(),
            Self::Colored(layers) => layers.reach(),
            Self::Mixed(layers) => layers.reach(),
            Self::MixedColored(layers) => layers.reach(),
        }
    }

    /// Draws all pixels of the grid. `finish` makes a pixel of its samples.
    pub fn paint<T: Tag, P: Copy + Send>(
        &self,
        grid: &Grid,
        shader: &Shader,
        pixels: &mut [P],
        finish: &(impl Fn(&Gathered<T>) -> P + Sync),
    ) -> Tally {
        match self {
            Self::Plain(layers) => paint(pixels, grid, layers, &|values| shader.plain(values), finish),
            Self::Colored(layers) => paint(pixels, grid, layers, &|values| shader.colored(values), finish),
            Self::Mixed(layers) => paint(pixels, grid, layers, &|values| shader.mixed(values), finish),
            Self::MixedColored(layers) => {
                paint(pixels, grid, layers, &|values| shader.mixed_colored(values), finish)
            }
        }
    }

    /// The samples of one pixel, and what they gather to.
    pub fn probe(&self, grid: &Grid, shader: &Shader, pixel: [u32; 2]) -> (Vec<Sample>, Gathered<u32>) {
        match self {
            Self::Plain(layers) => probe(grid, layers, &|values| shader.plain(values), pixel),
            Self::Colored(layers) => probe(grid, layers, &|values| shader.colored(values), pixel),
            Self::Mixed(layers) => probe(grid, layers, &|values| shader.mixed(values), pixel),
            Self::MixedColored(layers) => probe(grid, layers, &|values| shader.mixed_colored(values), pixel),
        }
    }
}

/// Most numbers any sheet interpolates.
pub const MOST_VALUES: usize = 7;

impl Sheet<'_> {
    /// Gives `take` every polygon, as its item and its contours; corners have zeros behind their numbers.
    pub fn for_each_polygon(&self, mut take: impl FnMut(u32, Vec<Vec<Corner<MOST_VALUES>>>)) {
        fn all<const N: usize>(
            list: &DrawList<'_, N>,
            take: &mut impl FnMut(u32, Vec<Vec<Corner<MOST_VALUES>>>),
        ) {
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
        match self {
            Self::Plain(list) => all(&list.polygons, &mut take),
            Self::Colored(list) => all(&list.polygons, &mut take),
            Self::Mixed(list) => all(&list.polygons, &mut take),
            Self::MixedColored(list) => all(&list.polygons, &mut take),
        }
    }

    /// The light of numbers interpolated between corners of [`Sheet::for_each_polygon`].
    pub fn shade(&self, shader: &Shader, &[a, b, c, d, e, f, g]: &[f32; MOST_VALUES]) -> Shade {
        match self {
            Self::Plain(_) => shader.plain(&[a, b, c]),
            Self::Colored(_) => shader.colored(&[a, b, c, d, e, f]),
            Self::Mixed(_) => shader.mixed(&[a, b, c, d]),
            Self::MixedColored(_) => shader.mixed_colored(&[a, b, c, d, e, f, g]),
        }
    }
}

/// White light of one level goes into the value.
fn pack_plain(swatch: &Swatch, level: DVec3) -> [f64; 3] {
    [swatch.tint, swatch.saturation, swatch.value * level.x]
}

/// Coloured light is carried beside the colour.
fn pack_colored(swatch: &Swatch, level: DVec3) -> [f64; 6] {
    [swatch.tint, swatch.saturation, swatch.value, level.x, level.y, level.z]
}

fn pack_mixed(swatch: &Swatch, level: DVec3) -> [f64; 4] {
    match swatch.light {
        Some(light) => {
            let [red, green, blue] = (light * level).to_array();
            [red, green, blue, 1.0]
        }
        None => {
            let [tint, saturation, value] = pack_plain(swatch, level);
            [tint, saturation, value, 0.0]
        }
    }
}

fn pack_mixed_colored(swatch: &Swatch, level: DVec3) -> [f64; 7] {
    match swatch.light {
        Some(light) => {
            let [red, green, blue] = (light * level).to_array();
            [red, green, blue, 1.0, 1.0, 1.0, 1.0]
        }
        None => {
            let [tint, saturation, value, red, green, blue] = pack_colored(swatch, level);
            [tint, saturation, value, red, green, blue, 0.0]
        }
    }
}
