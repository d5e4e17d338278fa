//! Martin Newell's teapot (University of Utah, 1975; public data): 32 bicubic Bézier patches, in
//! the proportions of the data set in common use.
//!
//! 24 patches are quarters of surfaces of revolution, the other 8 are halves of the handle and the
//! spout, so the data are stored as profiles and half sections.

use glam::DVec3;

/// Control points of a patch. The first index runs downward or away from the body, the second
/// clockwise around the part, so that (∂/∂second) × (∂/∂first) points outward.
pub type Patch = [[DVec3; 4]; 4];

/// A part of the teapot whose patches join smoothly.
pub struct Part {
    pub name: &'static str,
    pub patches: Vec<Patch>,
}

/// A ring of control points about the z axis: its radius, the smaller coordinate of the points
/// between the axes, its height.
type Ring = (f64, f64, f64);

/// Four rings per patch from rim to foot; the last ring of a patch is the first of the next.
const BODY: [[Ring; 4]; 4] = [
    [(1.4, 0.784, 2.4), (1.3375, 0.749, 2.53125), (1.4375, 0.805, 2.53125), (1.5, 0.84, 2.4)],
    [(1.5, 0.84, 2.4), (1.75, 0.98, 1.875), (2.0, 1.12, 1.35), (2.0, 1.12, 0.9)],
    [(2.0, 1.12, 0.9), (2.0, 1.12, 0.45), (1.5, 0.84, 0.225), (1.5, 0.84, 0.15)],
    [(1.5, 0.84, 0.15), (1.5, 0.84, 0.075), (1.425, 0.798, 0.0), (0.0, 0.0, 0.0)],
];

/// From the tip of the knob to the edge. The tip is a single point.
const LID: [[Ring; 4]; 2] = [
    [(0.0, 0.0, 3.15), (0.8, 0.45, 3.15), (0.0, 0.0, 2.85), (0.2, 0.112, 2.7)],
    [(0.2, 0.112, 2.7), (0.4, 0.224, 2.55), (1.3, 0.728, 2.55), (1.3, 0.728, 2.4)],
];

/// Half of a cross-section, y ≤ 0: start and end in the plane y = 0 as (x, z), and half of the
/// width.
type HalfSection = ((f64, f64), (f64, f64), f64);

/// From the upper joint to the lower one.
const HANDLE: [[HalfSection; 4]; 2] = [
    [
        ((-1.6, 2.025), (-1.5, 2.25), 0.3),
        ((-2.3, 2.025), (-2.5, 2.25), 0.3),
        ((-2.7, 2.025), (-3.0, 2.25), 0.3),
        ((-2.7, 1.8), (-3.0, 1.8), 0.3),
    ],
    [
        ((-2.7, 1.8), (-3.0, 1.8), 0.3),
        ((-2.7, 1.575), (-3.0, 1.35), 0.3),
        ((-2.5, 1.125), (-2.65, 0.9375), 0.3),
        ((-2.0, 0.9), (-1.9, 0.6), 0.3),
    ],
];

/// From the body to the lip, and a short distance back inside.
const SPOUT: [[HalfSection; 4]; 2] = [
    [
        ((1.7, 1.425), (1.7, 0.6), 0.66),
        ((2.6, 1.425), (3.1, 0.825), 0.66),
        ((2.3, 2.1), (2.4, 2.025), 0.25),
        ((2.7, 2.4), (3.3, 2.4), 0.25),
    ],
    [
        ((2.7, 2.4), (3.3, 2.4), 0.25),
        ((2.8, 2.475), (3.525, 2.49375), 0.25),
        ((2.9, 2.475), (3.45, 2.5125), 0.15),
        ((2.8, 2.4), (3.2, 2.4), 0.15),
    ],
];

/// The four parts, 16 + 8 + 4 + 4 patches.
pub fn parts() -> [Part; 4] {
    [
        Part { name: "body", patches: BODY.iter().flat_map(revolved).collect() },
        Part { name: "lid", patches: LID.iter().flat_map(revolved).collect() },
        Part { name: "handle", patches: HANDLE.iter().flat_map(mirrored).collect() },
        Part { name: "spout", patches: SPOUT.iter().flat_map(mirrored).collect() },
    ]
}

/// The four quarters of a surface of revolution, from +x over −y.
fn revolved(rings: &[Ring; 4]) -> [Patch; 4] {
    let quarter = rings.map(|(radius, lesser, z)| {
        [(radius, 0.0), (radius, -lesser), (lesser, -radius), (0.0, -radius)]
            .map(|(x, y)| DVec3::new(x, y, z))
    });
    let turned = |patch: Patch| patch.map(|row| row.map(|p| DVec3::new(p.y, -p.x, p.z)));
    let second = turned(quarter);
    let third = turned(second);
    [quarter, second, third, turned(third)]
}

/// The half at y ≤ 0 and its mirror image.
fn mirrored(sections: &[HalfSection; 4]) -> [Patch; 2] {
    let half = sections.map(|((x0, z0), (x1, z1), width)| {
        [(x0, 0.0, z0), (x0, -width, z0), (x1, -width, z1), (x1, 0.0, z1)].map(DVec3::from)
    });
    // Reversed, so that the normals still point outward.
    let image = half.map(|[a, b, c, d]| [d, c, b, a].map(|p| DVec3::new(p.x, -p.y, p.z)));
    [half, image]
}
