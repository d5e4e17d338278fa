//! Against testing every triangle, bit for bit; watertightness; growth of work.

use std::ops::{ControlFlow, Range};

use fearless_simd::Level;
use glam::{DVec3, dvec3};
use ugtesting::Random;

use crate::build::is_regular;
use crate::frame::{Frame, power_of_two};
use crate::nodes::{IS_BLOCK, Node, WIDTH};
use crate::shear::Shear;
use crate::{Bvh, Hit, Ray};

mod curves;
mod several;

const ALL: Range<f64> = 0.0..f64::INFINITY;

struct Mesh {
    positions: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
}

impl Mesh {
    fn build(&self) -> Bvh {
        Bvh::new(&self.positions, &self.triangles)
    }

    /// The same mesh, scaled and then moved.
    fn mapped(&self, scale: f64, offset: DVec3) -> Self {
        let positions = self.positions.iter().map(|&position| position * scale + offset).collect();
        Self { positions, triangles: self.triangles.clone() }
    }
}

/// A closed bumpy sphere of radius 1 with 2 × `n_sectors` × (`n_bands` − 1) triangles.
fn sphere(n_bands: u32, n_sectors: u32) -> Mesh {
    use std::f64::consts::PI;
    let mut positions = vec![dvec3(0.0, 0.0, 1.0)];
    for band in 1..n_bands {
        let polar = PI * f64::from(band) / f64::from(n_bands);
        for sector in 0..n_sectors {
            let azimuth = 2.0 * PI * f64::from(sector) / f64::from(n_sectors);
            let radius = 1.0 + 0.05 * libm::sin(12.0 * polar) * libm::cos(9.0 * azimuth);
            let direction = dvec3(
                libm::sin(polar) * libm::cos(azimuth),
                libm::sin(polar) * libm::sin(azimuth),
                libm::cos(polar),
            );
            positions.push(direction * radius);
        }
    }
    positions.push(dvec3(0.0, 0.0, -1.0));
    let south = positions.len() as u32 - 1;
    let row = |band: u32, sector: u32| match band {
        0 => 0,
        band if band == n_bands => south,
        band => 1 + (band - 1) * n_sectors + sector % n_sectors,
    };
    let mut triangles = Vec::new();
    for band in 0..n_bands {
        for sector in 0..n_sectors {
            let [a, b, c, d] = [
                row(band, sector),
                row(band, sector + 1),
                row(band + 1, sector),
                row(band + 1, sector + 1),
            ];
            triangles
                .extend([[a, c, b], [b, c, d]].into_iter().filter(|[a, b, c]| a != b && b != c));
        }
    }
    Mesh { positions, triangles }
}

/// Triangles of very different sizes and shapes, with coordinates on a coarse grid, so that many
/// share edges, corners and planes.
fn soup(random: &mut Random, n: usize) -> Mesh {
    let positions = (0..n.div_ceil(2))
        .map(|_| {
            let scale = *random.pick(&[1.0, 1.0, 1e-3, 1e-9]);
            DVec3::from_array([(); 3].map(|()| (random.between(-8.0, 8.0).round() / 8.0) * scale))
        })
        .collect::<Vec<_>>();
    let triangles =
        (0..n).map(|_| [(); 3].map(|()| random.below(positions.len()) as u32)).collect();
    Mesh { positions, triangles }
}

/// All hits in a range, by testing every triangle.
fn all_hits(mesh: &Mesh, ray: &Ray, range: &Range<f64>) -> Vec<Hit> {
    let positions: Vec<[f64; 3]> =
        mesh.positions.iter().map(|position| position.to_array()).collect();
    let regular: Vec<usize> = (0..mesh.triangles.len())
        .filter(|&idx| is_regular(&positions, mesh.triangles[idx]))
        .collect();
    let corners =
        || regular.iter().flat_map(|&idx| mesh.triangles[idx]).map(|row| positions[row as usize]);
    let low = corners()
        .fold([f64::INFINITY; 3], |low, at| std::array::from_fn(|axis| low[axis].min(at[axis])));
    let high = corners().fold([f64::NEG_INFINITY; 3], |high, at| {
        std::array::from_fn(|axis| high[axis].max(at[axis]))
    });
    if regular.is_empty() {
        return Vec::new();
    }
    let frame = Frame::new(low, high);
    let Some(shear) = Shear::new(&frame, ray.origin.to_array(), ray.direction.to_array()) else {
        return Vec::new();
    };
    regular
        .iter()
        .filter_map(|&idx| {
            let crossing =
                shear.intersect(mesh.triangles[idx].map(|row| &positions[row as usize]))?;
            let hit = Hit { t: crossing.t, triangle: idx as u32, u: crossing.u, v: crossing.v };
            (range.start < hit.t && hit.t < range.end).then_some(hit)
        })
        .collect()
}

fn nearest(hits: &[Hit]) -> Option<Hit> {
    hits.iter().copied().reduce(|best, hit| if hit.t < best.t { hit } else { best })
}

fn visited(bvh: &Bvh, ray: &Ray, range: &Range<f64>) -> Vec<Hit> {
    let mut hits = Vec::new();
    let end = bvh.visit(ray, range.clone(), |hit| {
        hits.push(hit);
        ControlFlow::Continue(())
    });
    assert_eq!(end, ControlFlow::Continue(()));
    hits.sort_by_key(|hit| hit.triangle);
    hits
}

/// Checks every search against testing every triangle. Returns the number of hits.
fn check(bvh: &Bvh, mesh: &Mesh, ray: &Ray, range: &Range<f64>) -> usize {
    let expected = all_hits(mesh, ray, range);
    assert_eq!(bvh.closest(ray, range.clone()), nearest(&expected), "{ray:?} {range:?}");
    assert_eq!(visited(bvh, ray, range), expected, "{ray:?} {range:?}");
    expected.len()
}

/// Rays of all kinds at a mesh: through points of triangles, edges and corners, along axes, in
/// planes of faces, from inside, from far away, and past it.
fn rays(random: &mut Random, mesh: &Mesh, n: usize) -> Vec<Ray> {
    let size = mesh
        .positions
        .iter()
        .fold(0.0_f64, |size, position| size.max(position.abs().max_element()));
    let mut rays = Vec::new();
    while rays.len() < n {
        let [a, b, c] = random.pick(&mesh.triangles).map(|row| mesh.positions[row as usize]);
        let [u, v] = *random.pick(&[[0.25, 0.5], [0.5, 0.0], [0.0, 0.0], [0.3, 0.3]]);
        let target = a + (b - a) * u + (c - a) * v;
        let direction = match random.below(6) {
            0 => *random.pick(&[DVec3::X, DVec3::NEG_Y, DVec3::Z]),
            1 => dvec3(random.between(-1.0, 1.0), 0.0, random.between(-1.0, 1.0)),
            // In the plane of the face.
            2 => (b - a) * random.between(-1.0, 1.0) + (c - a),
            3 => b - a,
            _ => random.direction(),
        };
        let away = *random.pick(&[0.0, 1.0, 3.0, 1e3, 1e8]) * size;
        let direction = direction.try_normalize().unwrap_or(DVec3::X);
        let length = *random.pick(&[1.0, 1.0, 1e-3, 1e150]);
        let origin = target - direction * away;
        rays.push(Ray { origin, direction: direction * length });
        rays.push(Ray { origin: random.in_cube(2.0 * size), direction: random.direction() });
    }
    rays
}

#[test]
fn searches_return_what_testing_every_triangle_returns() {
    let mut random = Random(1);
    let mut n_hits = 0;
    let meshes = [sphere(12, 24), sphere(4, 5), soup(&mut random, 300), soup(&mut random, 7)];
    for mesh in meshes {
        let bvh = mesh.build();
        for ray in rays(&mut random, &mesh, 3000) {
            let start = *random.pick(&[0.0, 0.0, -1.0, f64::NEG_INFINITY]);
            let end = *random.pick(&[f64::INFINITY, f64::INFINITY, 1.0, 2.5]);
            n_hits += check(&bvh, &mesh, &ray, &(start..end));
        }
    }
    assert!(n_hits > 20_000, "{n_hits}");
}

#[test]
fn huge_and_tiny_meshes_far_from_the_origin_have_all_hits() {
    let mut random = Random(2);
    let mesh = sphere(8, 12);
    for scale in [1e-300, 1e-160, 1e-40, 1e-10, 1e10, 1e40, 1e160, 1e280] {
        for offset in [0.0, 1.0, 1e4, 1e12] {
            let mesh = mesh.mapped(scale, dvec3(1.0, -2.0, 0.5) * (offset * scale));
            let bvh = mesh.build();
            let mut n_hits = 0;
            for ray in rays(&mut random, &mesh, 300) {
                n_hits += check(&bvh, &mesh, &ray, &(0.0..f64::INFINITY));
            }
            assert!(n_hits > 30, "{scale} {offset}: {n_hits}");
        }
    }
}

#[test]
fn details_of_every_size_are_hit() {
    // Triangles around the point 0, each 8 times as large as the one before.
    let mut mesh = Mesh { positions: Vec::new(), triangles: Vec::new() };
    for exponent in -120..0 {
        let size = power_of_two(3 * exponent);
        let first = mesh.positions.len() as u32;
        let height = size;
        mesh.positions.extend(
            [(-1.0, -1.0), (2.0, -1.0), (-1.0, 2.0)]
                .map(|(x, y)| dvec3(x * size, y * size, height)),
        );
        mesh.triangles.push([first, first + 1, first + 2]);
    }
    let bvh = mesh.build();
    let mut random = Random(3);
    for _ in 0..300 {
        let size = power_of_two(-3 * random.below(125) as i64);
        let origin = dvec3(random.between(-size, size), random.between(-size, size), -1.0);
        check(&bvh, &mesh, &Ray { origin, direction: DVec3::Z }, &ALL);
    }
    let ray = Ray { origin: dvec3(0.0, 0.0, -1.0), direction: DVec3::Z };
    assert_eq!(check(&bvh, &mesh, &ray, &ALL), 120);
}

#[test]
fn nothing_slips_through_a_closed_mesh() {
    let mut random = Random(4);
    for mesh in [sphere(40, 80), sphere(3, 3), sphere(40, 80).mapped(1e-7, dvec3(1.0, 2.0, 3.0))] {
        let bvh = mesh.build();
        let center = mesh.positions.iter().sum::<DVec3>() / mesh.positions.len() as f64;
        let size = (mesh.positions[0] - center).length();
        for _ in 0..20_000 {
            let [a, b, c] = random.pick(&mesh.triangles).map(|row| mesh.positions[row as usize]);
            // Corners, points of edges, and points of faces.
            let target = match random.below(3) {
                0 => a,
                1 => a + (b - a) * random.unit(),
                _ => a + (b - a) * (0.5 * random.unit()) + (c - a) * (0.5 * random.unit()),
            };
            let origin = center + random.in_ball(0.15 * size);
            let ray = Ray { origin, direction: (target - origin) * random.between(0.1, 10.0) };
            let n_inside = visited(&bvh, &ray, &ALL).len();
            assert!(n_inside % 2 == 1, "{n_inside} crossings from inside, {ray:?}");
            assert!(bvh.closest(&ray, ALL).is_some());
            let outside = Ray { origin: origin - ray.direction * 100.0, direction: ray.direction };
            let n_outside = visited(&bvh, &outside, &ALL).len();
            assert!(n_outside.is_multiple_of(2), "{n_outside} crossings from outside, {outside:?}");
        }
    }
}

#[test]
fn a_ray_through_corners_and_edges_of_a_cube_crosses_it_twice() {
    let positions: Vec<DVec3> = (0..8)
        .map(|idx| dvec3(f64::from(idx & 1), f64::from(idx >> 1 & 1), f64::from(idx >> 2)))
        .collect();
    let quads =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles = quads.into_iter().flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    let mesh = Mesh { positions, triangles };
    let bvh = mesh.build();
    let grid = [-0.5, 0.0, 0.25, 0.5, 1.0, 1.5];
    let mut n_even = 0;
    for (x, y, z) in
        grid.iter().flat_map(|&x| grid.iter().flat_map(move |&y| grid.map(|z| (x, y, z))))
    {
        let origin = dvec3(-3.0, 0.5, 0.25);
        for direction in [dvec3(x, y, z) - origin, DVec3::X, DVec3::NEG_Z, dvec3(1.0, 1.0, 0.0)] {
            let ray = Ray { origin: dvec3(x, y, z) - direction * 4.0, direction };
            let n = check(&bvh, &mesh, &ray, &ALL);
            assert!(n == 0 || n == 2, "{n} crossings of {ray:?}");
            n_even += n;
        }
    }
    assert!(n_even > 300, "{n_even}");
}

#[test]
fn invalid_rays_and_triangles_hit_nothing() {
    let mesh = sphere(8, 12);
    let bvh = mesh.build();
    let (nan, inf) = (f64::NAN, f64::INFINITY);
    for bad in [nan, inf, -inf] {
        for axis in 0..3 {
            let (mut origin, mut direction) = (dvec3(0.1, 0.2, -3.0), DVec3::Z);
            origin[axis] = bad;
            assert_eq!(bvh.closest(&Ray { origin, direction: DVec3::Z }, ALL), None);
            direction[axis] = bad;
            assert_eq!(bvh.closest(&Ray { origin: DVec3::ZERO, direction }, ALL), None);
        }
    }
    let ray = Ray { origin: dvec3(0.1, 0.2, -3.0), direction: DVec3::Z };
    assert!(bvh.closest(&ray, ALL).is_some());
    assert_eq!(bvh.closest(&Ray { direction: DVec3::ZERO, ..ray }, ALL), None);
    for (start, end) in [(nan, inf), (0.0, nan), (3.0, 3.0), (5.0, 1.0), (inf, inf)] {
        assert_eq!(bvh.closest(&ray, start..end), None);
    }
    assert_eq!(bvh.closest(&Ray { origin: dvec3(0.0, 0.0, -1e300), ..ray }, ALL), None);

    let corners = [
        DVec3::ZERO,
        DVec3::X,
        DVec3::Y,
        DVec3::X * 2.0,
        dvec3(nan, 0.0, 0.0),
        dvec3(1e305, 0.0, 0.0),
    ];
    let degenerate = [[0, 0, 1], [0, 1, 1], [2, 2, 2], [0, 1, 3], [0, 1, 4], [0, 2, 5], [0, 1, 99]];
    let bvh = Bvh::new(&corners, &degenerate);
    assert_eq!(bvh.bounds(), None);
    assert_eq!(
        bvh.closest(&Ray { origin: dvec3(0.2, 0.2, 1.0), direction: DVec3::NEG_Z }, ALL),
        None
    );
    let mut triangles = degenerate.to_vec();
    triangles.push([0, 1, 2]);
    let bvh = Bvh::new(&corners, &triangles);
    assert_eq!(bvh.bounds(), Some((DVec3::ZERO, dvec3(1.0, 1.0, 0.0))));
    let hit = bvh.closest(&Ray { origin: dvec3(0.25, 0.5, 1.0), direction: DVec3::NEG_Z }, ALL);
    assert_eq!(hit, Some(Hit { t: 1.0, triangle: 7, u: 0.25, v: 0.5 }));
    assert_eq!(Bvh::new(&[], &[]).closest(&ray, ALL), None);
}

#[test]
fn among_coincident_triangles_the_first_is_hit() {
    let positions = [DVec3::ZERO, DVec3::X, DVec3::Y];
    let bvh = Bvh::new(&positions, &vec![[0, 1, 2]; 1_000_000]);
    let ray = Ray { origin: dvec3(0.25, 0.25, 1.0), direction: DVec3::NEG_Z };
    let hit = bvh.closest(&ray, ALL);
    assert_eq!(hit, Some(Hit { t: 1.0, triangle: 0, u: 0.25, v: 0.25 }));
    assert!(bvh.nodes.len() < 200_000, "{}", bvh.nodes.len());
}

/// Of the rays that meet the outermost box, as many meet a box within it as its share of the
/// surface.
#[test]
fn work_grows_with_the_logarithm_of_the_number_of_triangles() {
    let surface = |node: &Node, child| {
        let side =
            |axis: usize| f64::from(node.plane(2 * axis + 1, child) - node.plane(2 * axis, child));
        let [x, y, z] = [0, 1, 2].map(side);
        x * y + y * z + z * x
    };
    let mut before = 0.0;
    for n_bands in [16, 50, 160, 500] {
        let mesh = sphere(n_bands, 2 * n_bands);
        let bvh = mesh.build();
        let n_met = |is_block: bool| {
            let children =
                bvh.nodes.iter().flat_map(|node| (0..WIDTH).map(move |child| (node, child)));
            let is_of_kind = |&(node, child): &(&Node, usize)| {
                let exists = node.plane(0, child).is_finite();
                exists && (node.children()[child] & IS_BLOCK != 0) == is_block
            };
            let sum: f64 =
                children.filter(is_of_kind).map(|(node, child)| surface(node, child)).sum();
            sum / 12.0
        };
        let [nodes, blocks] = [n_met(false), n_met(true)];
        // Ten times as many triangles are 1.1 more levels of eight children.
        assert!(
            before == 0.0 || nodes < before + 1.5,
            "{nodes} nodes after {before}, n = {}",
            mesh.triangles.len()
        );
        assert!(nodes < 5.0 && blocks < 1.5, "{nodes} {blocks}");
        let corners = size_of_val(&*bvh.positions) + size_of_val(&*bvh.triangles);
        let n_bytes = corners + size_of_val(&*bvh.nodes) + size_of_val(&*bvh.blocks);
        let n_bytes = n_bytes as f64 / mesh.triangles.len() as f64;
        assert!(n_bytes < 150.0, "{n_bytes} bytes per triangle");
        before = nodes;
    }
}

#[test]
fn every_instruction_set_has_the_same_hits() {
    let mut random = Random(6);
    let mesh = soup(&mut random, 200);
    let mut bvh = mesh.build();
    let rays = rays(&mut random, &mesh, 1000);
    let best: Vec<_> = rays.iter().map(|ray| bvh.closest(ray, ALL)).collect();
    assert!(best.iter().flatten().count() > 200);
    bvh.level = Level::baseline();
    let baseline: Vec<_> = rays.iter().map(|ray| bvh.closest(ray, ALL)).collect();
    assert_eq!(best, baseline);
}

#[test]
fn a_hierarchy_is_the_same_on_any_number_of_threads() {
    let mesh = sphere(120, 240);
    let [one, three] = [1, 3].map(|n| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(n).build().unwrap();
        let bvh = pool.install(|| mesh.build());
        format!("{:?} {:?} {:?}", bvh.nodes, bvh.blocks, bvh.triangles)
    });
    assert!(one == three);
}
