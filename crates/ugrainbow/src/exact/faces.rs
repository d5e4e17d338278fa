//! The faces of a scene, intersected with one ray per sample.

use std::ops::Range;

use glam::DVec3;
use rayon::prelude::*;
use uglight::Swatch;
use ugraster::{Area, FragmentWriter, ShapeTarget, TRANSPARENT_VALUES, Tile};
use ugscene::Face;
use ugtrace::outlines::{OutlinedFace, Outlines, PictureRays, RestFaces, RestRay, Tiles};
use ugtrace::rays::{Intersection, PastRay};

use super::look::Look;
use super::moving::MovingFaces;
use crate::packing::Pack;
use crate::painter::Painter;

/// All faces that are in the picture, with the rays that intersect them.
pub struct Faces<'a, const N: usize> {
    painter: Painter<'a>,
    pack: Pack<N>,
    outlines: Outlines,
    /// Of each shape of the outlines.
    looks: Vec<Look>,
    /// Round faces, and those of bodies that accelerate or turn.
    moving: Option<MovingFaces<'a>>,
    /// How many faces are left after clipping.
    pub n_in_picture: usize,
}

impl<'a, const N: usize> Faces<'a, N> {
    /// The faces of a scene for which `is_drawn` returns true. `planes`: the plane of each face,
    /// see [`ugscene::shared_planes`].
    pub fn new(
        painter: Painter<'a>,
        planes: &[u32],
        is_drawn: impl Fn(&Face) -> bool + Sync,
        pack: Pack<N>,
    ) -> Self {
        let surface = &painter.appearance.surface;
        let faces = RestFaces {
            scene: painter.scene,
            rest: surface.all_rest(),
            frames: surface.frames(),
            planes,
        };
        let size = [painter.grid.sample_columns(), painter.grid.sample_rows()];
        let tile = [size[0], painter.grid.bands().sample_rows()];
        let outlines = Outlines::new(
            faces,
            painter.view,
            Tiles { size, start: [0; 2], tile, margin: 0 },
            |face| {
                !face.shape.is_round()
                    && surface.frames().world_line(face.body).is_none()
                    && is_drawn(face)
            },
        );
        let look = |shape: &OutlinedFace| {
            Look::new(
                &painter,
                Some(outlines.frame(shape)),
                &painter.scene.faces[shape.item as usize],
            )
        };
        let looks: Vec<Look> = outlines.shapes().par_iter().map(look).collect();
        let moving = MovingFaces::new(painter, planes, is_drawn);
        let n_in_picture = looks.len() + moving.as_ref().map_or(0, MovingFaces::n_in_picture);
        Self { painter, pack, outlines, looks, moving, n_in_picture }
    }

    /// True if a face is nearer than `key` on the ray through a point of the picture, in samples.
    pub fn hides(&self, place: [f64; 2], key: f64) -> bool {
        let nearest = |moving: &MovingFaces<'_>| moving.nearest(&moving.ray(place));
        let is_before = |found: Intersection| 1.0 / found.s > key;
        self.outlines.hides(place, key)
            || self.moving.as_ref().and_then(nearest).is_some_and(is_before)
    }

    /// Draws the opaque faces of a band into one of its tiles: the nearest at each sample, so no
    /// hidden sample is shaded.
    pub fn draw(&self, band: usize, tile: &mut Tile<N>) {
        if self.painter.appearance.is_spectral() {
            self.draw_nearest::<true>(band, tile);
        } else {
            self.draw_nearest::<false>(band, tile);
        }
    }

    fn draw_nearest<const SPECTRAL: bool>(&self, band: usize, tile: &mut Tile<N>) {
        self.outlines.with_nearest([0, band as u32], samples(tile.area()), |found| {
            for run in found.runs() {
                let frame = self.outlines.frame(&self.outlines.shapes()[run.face as usize]);
                let (keys, lengths) = found.of_run(&run);
                let (rays, first) = (frame.row_of_samples(run.row), run.columns.start);
                self.draw_run::<SPECTRAL>(tile, (run.face, run.row, run.columns), |column| {
                    let at = (column - first) as usize;
                    (frame.ray_of_length(rays, column, lengths[at]), keys[at])
                });
            }
        });
        self.draw_moving::<SPECTRAL, _>(tile, |moving, ray| moving.nearest(ray));
    }

    /// Draws a shape on columns of a row of samples, where it is in front of the nearest occluder.
    /// `ray`: at a column, with the depth key of the shape.
    #[inline(always)] // Otherwise the ray is passed in memory.
    fn draw_run<const SPECTRAL: bool>(
        &self,
        target: &mut impl ShapeTarget<N>,
        (number, row, columns): (u32, u32, Range<u32>),
        ray: impl Fn(u32) -> (RestRay, f64),
    ) {
        let shape = &self.outlines.shapes()[number as usize];
        let frame = self.outlines.frame(shape);
        if self.looks[number as usize].n_together > 1 {
            let mut of_pixel = self.of_pixels::<SPECTRAL>(number, row, columns.clone());
            return target.draw_each(row, columns, shape.item, |column, occluder_key| {
                let key = ray(column).1 as f32;
                (key > occluder_key).then(|| (key, of_pixel(column)))
            });
        }
        target.draw_each(row, columns, shape.item, |column, occluder_key| {
            let (ray, key) = ray(column);
            let key = key as f32;
            (key > occluder_key)
                .then(|| (key, self.values::<SPECTRAL>(number, shape, frame, (&ray, 1))))
        });
    }

    /// Draws faces of bodies that accelerate or turn, where a ray hits them.
    fn draw_moving<const SPECTRAL: bool, I: IntoIterator<Item = Intersection>>(
        &self,
        target: &mut impl ShapeTarget<N>,
        hits: impl Fn(&MovingFaces<'a>, &PastRay) -> I,
    ) {
        let Some(moving) = &self.moving else { return };
        let [columns, rows] = samples(target.area());
        for [column, row] in rows.flat_map(|row| columns.clone().map(move |column| [column, row])) {
            let place = [column, row].map(|at| f64::from(at) + 0.5);
            let ray = moving.ray(place);
            for found in hits(moving, &ray) {
                let key = (1.0 / found.s) as f32;
                target.draw_each(
                    row,
                    column..column + 1,
                    found.triangle.face,
                    |_, occluder_key| {
                        (key > occluder_key).then(|| {
                            (key, self.packed(&moving.shaded::<SPECTRAL>(&ray, &found, place)))
                        })
                    },
                );
            }
        }
    }

    /// The values of a textured face in columns of a row of samples: they are found once for each
    /// pixel, in the middle of its samples among these.
    fn of_pixels<const SPECTRAL: bool>(
        &self,
        number: u32,
        row: u32,
        Range { start, end }: Range<u32>,
    ) -> impl FnMut(u32) -> [f32; N] {
        let shape = &self.outlines.shapes()[number as usize];
        let (frame, n_together) =
            (self.outlines.frame(shape), self.looks[number as usize].n_together);
        let rays = frame.row_of_samples(row);
        let (mut upto, mut values) = (0, [0.0; N]);
        move |column| {
            if column >= upto {
                let first = column / n_together * n_together;
                upto = (first + n_together).min(end);
                let first = first.max(start);
                let ray = frame.stretched_ray(rays, 0.5 * f64::from(first + upto));
                values = self.values::<SPECTRAL>(number, shape, frame, (&ray, upto - first));
            }
            values
        }
    }

    #[inline]
    fn packed(&self, (color, level): &(Swatch, DVec3)) -> [f32; N] {
        (self.pack)(color, *level).map(|number| number as f32)
    }

    /// The values of a face where a ray meets it, in the packed layout.
    #[inline(always)] // As `Look::at`.
    fn values<const SPECTRAL: bool>(
        &self,
        number: u32,
        shape: &OutlinedFace,
        frame: &PictureRays,
        (ray, n_samples): (&RestRay, u32),
    ) -> [f32; N] {
        let look = &self.looks[number as usize];
        self.packed(&look.at::<SPECTRAL>(
            &self.painter,
            frame,
            (ray, n_samples),
            shape.key(ray.rest),
        ))
    }
}

impl Faces<'_, TRANSPARENT_VALUES> {
    /// Draws the faces of a band as transparent fragments, wherever they are in front of the
    /// nearest occluder.
    pub fn draw_transparent(&self, band: usize, writer: &mut FragmentWriter<'_, '_>) {
        if self.painter.appearance.is_spectral() {
            self.draw_all::<true>(band, writer);
        } else {
            self.draw_all::<false>(band, writer);
        }
    }

    fn draw_all<const SPECTRAL: bool>(&self, band: usize, writer: &mut FragmentWriter<'_, '_>) {
        self.outlines.for_each_run(
            [0, band as u32],
            samples(writer.area()),
            |number, row, columns, ray| {
                self.draw_run::<SPECTRAL>(writer, (number, row, columns), ray);
            },
        );
        self.draw_moving::<SPECTRAL, _>(writer, |moving, ray| moving.all(ray));
    }
}

/// Columns and rows of an area.
fn samples(area: Area) -> [Range<u32>; 2] {
    [area.columns, area.rows].map(|[start, end]| start..end)
}
