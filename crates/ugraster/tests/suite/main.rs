//! Coverage against counting and geometry; the pixels of scenes are in `tests/`.

mod transparency;

use fearless_simd::Level;
use ugraster::{
    BLOCK, Bounds, Center, Corner, CornerTable, DepthFade, Encoding, Keep, NoTriangles,
    PixelSamples, PolygonLayer, PolygonList, Rasterizer, SampleGrid, SampleShading, Scanner,
    ScreenPoint, ShadedRun, ShadedSample, TileShape, TriangleBlock,
};
use ugtesting::Random;

/// A grid without depth cueing.
fn grid([width, height]: [u32; 2], samples: u32, is_perspective: bool) -> SampleGrid {
    SampleGrid { width, height, samples, is_perspective, fade: None, tiles: TileShape::Tall }
}

/// A corner at a place, at depth key 1, without values.
fn at(x: f64, y: f64) -> Corner<0> {
    Corner { x, y, key: 1.0, values: [] }
}

/// How many times each sample of a w × h grid is drawn.
fn count(polygons: &[Vec<Vec<Corner<0>>>], width: usize, height: usize) -> Vec<Vec<u32>> {
    let mut counts = vec![vec![0; width]; height];
    let mut scanner = Scanner::default();
    for contours in polygons {
        scanner.scan(contours.iter().map(Vec::as_slice), 0, height as u32, |row, left, right| {
            for (column, n) in counts[row as usize].iter_mut().enumerate() {
                let center = column as f64 + 0.5;
                *n += u32::from(left.x <= center && center < right.x);
            }
        });
    }
    counts
}

#[test]
fn a_square_covers_its_samples() {
    #[track_caller]
    fn check(
        [left, top, right, bottom]: [f64; 4],
        columns: std::ops::Range<usize>,
        rows: std::ops::Range<usize>,
    ) {
        let around = vec![at(left, top), at(right, top), at(right, bottom), at(left, bottom)];
        for contour in [around.clone(), around.into_iter().rev().collect()] {
            for (y, row) in count(&[vec![contour]], 8, 8).into_iter().enumerate() {
                for (x, n) in row.into_iter().enumerate() {
                    assert_eq!(
                        n,
                        u32::from(columns.contains(&x) && rows.contains(&y)),
                        "sample {x} {y}"
                    );
                }
            }
        }
    }
    check([2.0, 3.0, 5.0, 6.0], 2..5, 3..6);
    check([1.6, 1.4, 5.4, 5.6], 2..5, 1..6);
    // An edge through sample centres belongs to what lies right of it or below.
    check([2.5, 3.5, 5.5, 6.5], 2..5, 3..6);
    check([-9.0, -9.0, 99.0, 99.0], 0..8, 0..8);
    check([2.6, 0.0, 3.4, 8.0], 3..3, 0..8);
    check([-3.0, 0.0, -1.0, 8.0], 0..0, 0..8);
    check([-1e300, -1e300, 1e300, 4.0], 0..8, 0..4);
}

#[test]
fn faces_of_a_mesh_share_no_sample_and_leave_none_out() {
    const CELLS: usize = 12;
    const CELL: f64 = 3.7;
    let mut random = Random(1);
    let mut points = [[(0.0, 0.0); CELLS + 1]; CELLS + 1];
    for (j, row) in points.iter_mut().enumerate() {
        for (i, point) in row.iter_mut().enumerate() {
            let mut jitter =
                |idx: usize| if idx == 0 || idx == CELLS { 0.0 } else { random.unit() - 0.5 };
            // Some points on sample centres, where ties are.
            let snap = |x: f64| if (i + j) % 3 == 0 { x.round() + 0.5 } else { x };
            let inside = |idx: usize, x: f64| if idx == 0 || idx == CELLS { x } else { snap(x) };
            *point = (
                inside(i, CELL * i as f64 + 1.5 * jitter(i)),
                inside(j, CELL * j as f64 + 1.5 * jitter(j)),
            );
        }
    }
    let mut polygons = Vec::new();
    for j in 0..CELLS {
        for i in 0..CELLS {
            let [a, b, c, d] =
                [points[j][i], points[j][i + 1], points[j + 1][i + 1], points[j + 1][i]]
                    .map(|(x, y)| at(x, y));
            let faces = match (i + j) % 3 {
                0 => vec![vec![a, b, c], vec![c, d, a]],
                1 => vec![vec![d, b, a], vec![b, d, c]],
                _ => vec![vec![c, b, a, d]],
            };
            polygons.extend(faces.into_iter().map(|face| vec![face]));
        }
    }
    let size = (CELLS as f64 * CELL).ceil() as usize + 2;
    let last = CELLS as f64 * CELL;
    for (y, row) in count(&polygons, size, size).into_iter().enumerate() {
        for (x, n) in row.into_iter().enumerate() {
            let is_inside = (x as f64 + 0.5) < last && (y as f64 + 0.5) < last;
            assert_eq!(n, u32::from(is_inside), "sample {x} {y}");
        }
    }
}

#[test]
fn holes_follow_the_even_odd_rule() {
    // A pentagram in one stroke, with a round hole off its middle: even-odd by winding angle.
    let star: Vec<_> = [0, 2, 4, 1, 3]
        .map(|k| {
            let angle = f64::from(k) * std::f64::consts::TAU / 5.0 + 0.3;
            at(20.0 + 19.0 * libm::cos(angle), 20.0 + 19.0 * libm::sin(angle))
        })
        .into();
    let hole: Vec<_> = (0..17)
        .map(|k| {
            let angle = -f64::from(k) * std::f64::consts::TAU / 17.0;
            at(25.0 + 6.0 * libm::cos(angle), 22.0 + 6.0 * libm::sin(angle))
        })
        .collect();
    let polygon = vec![star, hole];
    let counts = count(std::slice::from_ref(&polygon), 40, 40);
    let mut n_inside = 0;
    for (y, row) in counts.iter().enumerate() {
        for (x, &n) in row.iter().enumerate() {
            let inside = is_inside(&polygon, x as f64 + 0.5, y as f64 + 0.5);
            assert_eq!(n, u32::from(inside), "sample {x} {y}");
            n_inside += n;
        }
    }
    assert!(n_inside > 300, "{n_inside}");
}

/// Counts crossings upward instead of to the left.
fn is_inside(contours: &[Vec<Corner<0>>], x: f64, y: f64) -> bool {
    let mut n_above = 0;
    for contour in contours {
        for (a, b) in contour.iter().zip(contour.iter().cycle().skip(1)) {
            if (a.x <= x) != (b.x <= x) && a.y + (x - a.x) / (b.x - a.x) * (b.y - a.y) < y {
                n_above += 1;
            }
        }
    }
    n_above % 2 == 1
}

/// Triangles of three corners each in the order of the table.
struct Triangles(Vec<Corner<1>>);

impl CornerTable<1> for Triangles {
    fn point(&self, corner: u32) -> ScreenPoint {
        let Corner { x, y, key, .. } = self.0[corner as usize];
        ScreenPoint { x, y, key }
    }

    fn values(&self, _item: u32, corners: [u32; 3]) -> [[f64; 1]; 3] {
        corners.map(|corner| {
            self.0[corner as usize].values.map(|value| value / self.0[corner as usize].key)
        })
    }
}

/// Blocks of triangles of all sizes, inside and outside the picture, some with NaN or infinity,
/// some slivers, some much nearer at one corner than at another, against a plain classification of
/// each.
#[test]
fn a_block_is_classified_like_its_triangles() {
    const BAD: [f64; 6] = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 0.0, 1e9, 1e-40];
    let mut random = Random(13);
    let mut counts = [0; 4];
    for (round, size) in (0..400).zip([0.3, 3.0, 40.0, 3e3].into_iter().cycle()) {
        let is_perspective = round % 3 != 0;
        let grid = grid([700, 300], 1 + round % 3, is_perspective);
        let mut triangles = [[ScreenPoint::default(); 3]; BLOCK];
        let mut block = TriangleBlock::default();
        for (place, points) in triangles.iter_mut().enumerate() {
            let middle = [900.0 * random.unit() - 100.0, 500.0 * random.unit() - 100.0];
            *points = [(); 3].map(|()| {
                let [x, y] = middle.map(|place| place + size * (random.unit() - 0.5));
                ScreenPoint { x, y, key: 0.1 + 1.2 * random.unit() }
            });
            match place {
                5 => points[round as usize % 3].x = BAD[round as usize / 3 % 6],
                6 => points[round as usize % 3].key = BAD[round as usize / 3 % 6],
                7 => points[2] = points[round as usize % 2],
                _ => {}
            }
            block.set(place, *points);
        }
        let is_culled = round % 2 == 0;
        for level in [Level::new(), Level::baseline()] {
            let found = block.classify(level, &grid, is_culled);
            for (place, points) in triangles.iter().enumerate() {
                let has = |all: u64| all >> place & 1 == 1;
                let is_plain = is_regular(points, is_perspective);
                assert_eq!(has(found.regular), is_plain, "{points:?}");
                if !is_plain {
                    assert!(!has(found.drawn));
                    continue;
                }
                let bounds = Bounds::new(points.iter().map(|point| [point.x, point.y]));
                assert_eq!(has(found.in_picture), bounds.is_in_picture(&grid), "{points:?}");
                let rows = bounds.rows(&grid).filter(|rows| !rows.is_empty());
                let is_drawn = rows.is_some() && !(is_culled && twice_area(points) <= 0.0);
                assert_eq!(has(found.drawn), is_drawn, "{points:?}");
                if let (true, Some(rows)) = (is_drawn, rows) {
                    let found = found.place(place);
                    assert_eq!(found.bands, grid.bands().of(&rows), "{points:?}");
                }
                counts[usize::from(is_drawn) + 2 * usize::from(is_culled)] += 1;
            }
        }
    }
    assert!(counts.iter().all(|count| *count > 300), "{counts:?}");
}

/// Positive if the corners run counterclockwise on the screen, where rows go downwards.
fn twice_area([a, b, c]: &[ScreenPoint; 3]) -> f64 {
    (b.y - a.y) * (c.x - a.x) - (b.x - a.x) * (c.y - a.y)
}

fn is_regular(points: &[ScreenPoint; 3], is_perspective: bool) -> bool {
    let [xs, ys, keys] = [points.map(|p| p.x), points.map(|p| p.y), points.map(|p| p.key)];
    let ends = |all: [f64; 3]| {
        [all.into_iter().fold(f64::NAN, f64::min), all.into_iter().fold(f64::NAN, f64::max)]
    };
    let is_finite = [xs, ys, keys].iter().flatten().all(|number| number.is_finite());
    let ([left, right], [top, bottom], [least, most]) = (ends(xs), ends(ys), ends(keys));
    let extent = (right - left).max(bottom - top);
    is_finite
        && [left, right, top, bottom].iter().all(|place| place.abs() <= f64::from(1 << 24))
        && twice_area(points).abs() > extent * extent / f64::from(1 << 26)
        && (!is_perspective || (least > 1e-30 && most < 1e30 && most <= 16.0 * least))
}

/// Random triangles, from specks to some far larger than the picture: drawn with planes, and as
/// polygons along edges.
#[test]
fn triangles_are_drawn_like_polygons() {
    let mut random = Random(11);
    let (mut n_drawn, mut n_seen) = (0, 0);
    // With 20 samples along a side, the picture has six columns of tiles.
    for (samples, size) in [(1, 3.0), (1, 40.0), (2, 300.0), (1, 1e5), (20, 300.0)] {
        let grid = grid([60, 50], samples, true);
        let (mut triangles, mut polygons) = (PolygonList::default(), PolygonList::default());
        let mut table = Vec::new();
        for item in 0..300 {
            let middle = [60.0 * random.unit(), 50.0 * random.unit()]
                .map(|place| place * f64::from(samples));
            let corners = [(); 3].map(|()| {
                let [x, y] = middle.map(|place| place + size * (random.unit() - 0.5));
                // Some on sample centres, where ties are.
                let [x, y] =
                    if item % 3 == 0 { [x.round() + 0.5, y.round() + 0.5] } else { [x, y] };
                let key = 0.1 + random.unit();
                Corner { x, y, key, values: [key * random.unit()] }
            });
            let points = corners.map(|Corner { x, y, key, .. }| ScreenPoint { x, y, key });
            let mut block = TriangleBlock::default();
            block.set(3, points);
            let level = if item % 2 == 0 { Level::new() } else { Level::baseline() };
            let classes = block.classify(level, &grid, false);
            if classes.regular != 1 << 3 {
                continue;
            }
            if classes.drawn != 0 {
                let first = table.len() as u32;
                triangles.push_triangle(item, [first, first + 1, first + 2], classes.place(3));
                n_drawn += 1;
            }
            table.extend(corners);
            corners.into_iter().for_each(|corner| polygons.push_corner(corner));
            polygons.end_contour();
            polygons.end_polygon(&grid, item);
        }
        triangles.sort_into_bands(&grid);
        polygons.sort_into_bands(&grid);
        let table = Triangles(table);
        let draw = |list: PolygonList<1>| {
            let layer = PolygonLayer { lists: &[list], corners: &table };
            let pixel = |all: &PixelSamples<'_>| (all.sum[0], all.covered, all.center.opaque);
            let rasterizer = Rasterizer { grid: &grid, opaque: &layer, transparent: None };
            rasterizer.paint(&Grey, Keep::Centers, &pixel, &()).0
        };
        for (ours, exact) in draw(triangles).into_iter().zip(draw(polygons)) {
            assert_eq!(ours.1, exact.1);
            assert_eq!(ours.2.map(|hit| hit.item), exact.2.map(|hit| hit.item));
            let error = (ours.0 - exact.0).abs() / (samples * samples) as f32;
            assert!(error < 4e-6, "{ours:?} {exact:?}");
            if let (Some(ours), Some(exact)) = (ours.2, exact.2) {
                assert!((ours.key - exact.key).abs() < 1e-6, "{ours:?} {exact:?}");
                n_seen += 1;
            }
        }
    }
    assert!(n_drawn > 800 && n_seen > 4000, "{n_drawn} {n_seen}");
}

/// The light is the interpolated value.
pub struct Grey;

impl SampleShading<1> for Grey {
    fn shade(&self, [lights]: [&[f32]; 1], _: Encoding, run: &mut ShadedRun) {
        for (sample, &light) in lights.iter().enumerate() {
            run.set(
                sample,
                ShadedSample { light: [light; 3], intensity: light, is_out_of_range: false },
            );
        }
    }
}

/// The mean light of each pixel, on black, of polygons with one value. In small pictures every
/// pixel is compared with a probe.
fn painted(polygons: &[Vec<Corner<1>>], grid: &SampleGrid) -> Vec<f32> {
    let mut list = PolygonList::default();
    for (polygon, item) in polygons.iter().zip(0..) {
        polygon.iter().for_each(|corner| list.push_corner(*corner));
        list.end_contour();
        list.end_polygon(grid, item);
    }
    list.sort_into_bands(grid);
    let lists = [list];
    let layer = PolygonLayer { lists: &lists, corners: &NoTriangles };
    let rasterizer = Rasterizer { grid, opaque: &layer, transparent: None };
    let mean = |sum: [f32; 3]| sum[0] / (grid.samples * grid.samples) as f32;
    let light = |all: &PixelSamples<'_>| mean(all.sum);
    let (pixels, _) = rasterizer.paint(&Grey, Keep::Light, &light, &());
    let both = |all: &PixelSamples<'_>| (mean(all.sum), all.center.opaque);
    let (marked, _) = rasterizer.paint(&Grey, Keep::Centers, &both, &());
    let centers = rasterizer.paint_centers(|center: &Center<'_>| center.opaque, &());
    for (idx, ((&light, marked), center)) in pixels.iter().zip(&marked).zip(centers).enumerate() {
        assert_eq!((light, center), *marked);
        if pixels.len() > 1000 {
            continue;
        }
        let place = [idx as u32 % grid.width, idx as u32 / grid.width];
        let (samples, all, pixel) =
            rasterizer.probe(&Grey, &|all: &PixelSamples<'_>| mean(all.sum), place);
        assert_eq!((mean(all.sum), all.center.opaque), *marked);
        assert_eq!(pixel, light);
        assert_eq!(samples.len() as f32, all.covered);
        let middle = samples.iter().find(|sample| sample.place == grid.center(place));
        let hit = middle.and_then(|sample| sample.opaque.as_ref()).map(|surface| surface.hit);
        assert_eq!(hit, all.center.opaque);
        let lights = samples.iter().filter_map(|sample| sample.opaque.as_ref());
        assert_eq!(lights.map(|surface| surface.shaded.light[0]).sum::<f32>(), all.sum[0]);
    }
    pixels
}

/// Intersecting triangles, each with a light of its own.
#[test]
fn a_probe_finds_what_was_painted() {
    let mut random = Random(5);
    // With 20 samples along a side, the picture has three columns of tiles.
    for samples in [1, 2, 3, 20] {
        let grid = grid([25, 20], samples, false);
        let polygons: Vec<Vec<Corner<1>>> = (1..=40)
            .map(|k| {
                let mut corner = || Corner {
                    x: 30.0 * f64::from(samples) * random.unit(),
                    y: 25.0 * f64::from(samples) * random.unit(),
                    key: random.unit(),
                    values: [f64::from(k) / 64.0],
                };
                vec![corner(), corner(), corner()]
            })
            .collect();
        let pixels = painted(&polygons, &grid);
        assert!(pixels.iter().filter(|light| **light > 0.0).count() > 300);
    }
}

/// Wide and high enough for several tiles in both directions and several bands.
#[test]
fn tiles_do_not_show() {
    for (width, height, samples) in [(100_000, 5, 3), (600_000, 2, 1), (50, 3000, 2)] {
        let grid = grid([width, height], samples, false);
        let (right, bottom) = (f64::from(grid.sample_columns()), f64::from(grid.sample_rows()));
        let corner = |x: f64, y: f64, light: f64| Corner { x, y, key: 0.0, values: [light] };
        let pixels = painted(
            &[vec![
                corner(0.0, 0.0, 0.0),
                corner(right, 0.0, 1.0),
                corner(right, bottom, 1.0),
                corner(0.0, bottom, 0.0),
            ]],
            &grid,
        );
        for (idx, pixel) in pixels.iter().enumerate() {
            let column = idx % width as usize;
            let light = (column as f32 + 0.5) / width as f32;
            assert!((pixel - light).abs() < 1e-5, "column {column}: {pixel}");
        }
    }
}

#[test]
fn of_equal_depth_keys_the_first_drawn_wins() {
    let square = |light: f64, key: f64| {
        [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)]
            .map(|(x, y)| Corner { x, y, key, values: [light] })
            .into()
    };
    let grid = grid([4, 4], 1, false);
    let rows = [
        ([(1.0, 5.0), (0.0, 5.0)], 1.0),
        ([(0.0, 5.0), (1.0, 5.0)], 0.0),
        ([(0.0, 5.0), (1.0, 6.0)], 1.0),
        ([(1.0, 5.0), (0.0, 4.0)], 1.0),
    ];
    for (squares, level) in rows {
        let pixels = painted(&squares.map(|(light, key)| square(light, key)), &grid);
        assert!(pixels.iter().all(|pixel| *pixel == level), "{squares:?}");
    }
}

#[test]
fn polygons_with_nan_or_infinity_are_dropped() {
    let grid = grid([4, 4], 1, false);
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for place in 0..4 {
            let mut numbers = [1.0; 4];
            numbers[place] = bad;
            let [x, y, key, light] = numbers;
            let corner = |x, y| Corner { x, y, key: 1.0, values: [1.0] };
            let pixels = painted(
                &[vec![corner(0.0, 0.0), corner(4.0, 0.0), Corner { x, y, key, values: [light] }]],
                &grid,
            );
            assert!(pixels.iter().all(|pixel| *pixel == 0.0));
        }
    }
}

#[test]
fn light_falls_linearly_between_two_depths() {
    let fade = DepthFade { near: 2.0, far: 6.0, least: 0.2 };
    for (depth, part) in [(0.0, 1.0), (2.0, 1.0), (3.0, 0.8), (4.0, 0.6), (6.0, 0.2), (60.0, 0.2)] {
        assert!((fade.light_left(depth) - part).abs() < 1e-15, "{depth}");
    }
    let step = DepthFade { near: 2.0, far: 2.0, least: 0.0 };
    assert_eq!([1.0, 2.0, 3.0].map(|depth| step.light_left(depth)), [1.0, 1.0, 0.0]);
}
