//! Several rays at once, against single ones.

use glam::{DVec3, dvec3};
use ugtesting::Random;

use super::{ALL, Mesh, check, soup, sphere};
use crate::frame::power_of_two;
use crate::{Hit, Ray};

#[test]
fn deep_hierarchies_have_all_hits() {
    // Around 0, ten triangles of each size, in a hierarchy deeper than the array of a stack.
    let mut mesh = Mesh { positions: Vec::new(), triangles: Vec::new() };
    for exponent in -120..0 {
        let size = power_of_two(3 * exponent);
        for height in 0..10 {
            let first = mesh.positions.len() as u32;
            let z = size * (1.0 + f64::from(height) / 16.0);
            let corners = [(-1.0, -1.0), (2.0, -1.0), (-1.0, 2.0)];
            mesh.positions.extend(corners.map(|(x, y)| dvec3(x * size, y * size, z)));
            mesh.triangles.push([first, first + 1, first + 2]);
        }
    }
    let bvh = mesh.build();
    let mut random = Random(9);
    let rays: Vec<Ray> = (0..300)
        .map(|_| {
            let size = power_of_two(-3 * random.below(125) as i64);
            let [x, y] = [(); 2].map(|()| random.between(-size, size));
            Ray { origin: dvec3(x, y, -1.0), direction: dvec3(0.1 * x, 0.1 * y, 1.0) }
        })
        .collect();
    let n_hits: usize = rays.iter().map(|ray| check(&bvh, &mesh, ray, &ALL)).sum();
    assert!(n_hits > 200, "{n_hits}");
    let mut n_crossings = 0;
    let through_all = Ray { origin: dvec3(0.0, 0.0, 2.0), direction: DVec3::NEG_Z };
    let _ = bvh.visit(&through_all, 0.0..f64::INFINITY, |_| {
        n_crossings += 1;
        std::ops::ControlFlow::Continue(())
    });
    assert_eq!(n_crossings, mesh.triangles.len());
}

#[test]
fn a_packet_has_the_hits_of_its_rays() {
    let mut random = Random(7);
    let mut n_hits = 0;
    let meshes = [
        sphere(12, 24),
        sphere(30, 60),
        soup(&mut random, 300),
        sphere(5, 7).mapped(1e-300, DVec3::ZERO),
    ];
    for mesh in meshes {
        let bvh = mesh.build();
        let size = bvh.bounds().map_or(1.0, |(low, high)| (high - low).max_element());
        for _ in 0..1500 {
            let origin = random.in_cube(1.0) * size * *random.pick(&[0.3, 1.0, 2.0, 100.0, 1e6]);
            let target = *random.pick(&mesh.positions) * *random.pick(&[0.0, 1.0, 1.0]);
            let toward = match random.below(5) {
                0 => *random.pick(&[DVec3::X, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z]) * size,
                1 => random.direction() * size,
                _ => target - origin,
            };
            let width = *random.pick(&[0.0, 0.0, 0.0, 1e-3, 0.02, 0.3, 2.0]) * size;
            let n = if width == 0.0 { 2 } else { *random.pick(&[1, 5, 64, 64, 100]) };
            let mut directions: Vec<DVec3> = (0..n)
                .map(|_| (toward + random.in_cube(width)) * *random.pick(&[1.0, 1.0, 0.5]))
                .collect();
            if random.one_in(10) {
                directions[n / 2] = *random.pick(&[DVec3::NAN, DVec3::ZERO, DVec3::INFINITY]);
            }
            let start = *random.pick(&[0.0, 0.0, 0.0, 0.0, 0.0, 0.5, -1.0]);
            let end = *random.pick(&[f64::INFINITY, f64::INFINITY, f64::INFINITY, 1.0, f64::NAN]);
            let mut hits = vec![Some(Hit { t: 0.0, triangle: 0, u: 0.0, v: 0.0 }); n];
            bvh.closest_packet(origin, &directions, start..end, &mut hits);
            for (direction, hit) in directions.into_iter().zip(hits) {
                let ray = Ray { origin, direction };
                assert_eq!(hit, bvh.closest(&ray, start..end), "{ray:?} {start} {end}");
                n_hits += usize::from(hit.is_some());
            }
        }
    }
    assert!(n_hits > 20_000, "{n_hits}");
}
