//! The outline of undistorted bodies (`-dl`) of a smooth closed surface: it is the silhouette, ends
//! only where the surface hides it, and has no gaps.

use glam::{DVec2, DVec3};
use ugrainbow::{AnnotationOptions, Background, Output};
use ugscene::Camera;
use ugtesting::Random;
use ugtests::oracle::Pinhole;
use ugtests::pipe::Pipe;

const SIZE: [u32; 2] = [600, 450];

/// Steps round the torus, and round its tube.
const STEPS: [usize; 2] = [44, 24];

/// Pixels about a point within which a surface hides it, or does not.
const MARGIN: f64 = 0.7;

/// Pixels by which lines end later or earlier than they should: two of their steps.
const END: f64 = 1.1;

/// A torus about the z axis: its corners in rows round the tube.
struct Torus(Vec<DVec3>);

impl Torus {
    fn new(tube: f64) -> Self {
        let angle =
            |step: usize, n: usize| libm::sincos(std::f64::consts::TAU * step as f64 / n as f64);
        let corner = |idx: usize| {
            let ((sin, cos), (up, out)) =
                (angle(idx / STEPS[1], STEPS[0]), angle(idx % STEPS[1], STEPS[1]));
            let radius = 1.0 + tube * out;
            DVec3::new(radius * cos, radius * sin, tube * up)
        };
        Self((0..STEPS[0] * STEPS[1]).map(corner).collect())
    }

    /// The four corners of a face, counterclockwise as seen from outside.
    fn face(&self, around: usize, tube: usize) -> [usize; 4] {
        let corner =
            |i: usize, j: usize| (around + i) % STEPS[0] * STEPS[1] + (tube + j) % STEPS[1];
        [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)]
    }

    fn faces(&self) -> Vec<[usize; 4]> {
        (0..STEPS[0])
            .flat_map(|i| (0..STEPS[1]).map(move |j| (i, j)))
            .map(|(i, j)| self.face(i, j))
            .collect()
    }

    fn text(&self, eye: DVec3) -> String {
        let mut text = format!(
            "c gray .7; l 1; cam -ep {:?} {:?} {:?} -vc 0 0 0 -ud 0 0 1 -va 30;\n",
            eye.x, eye.y, eye.z
        );
        for (idx, p) in self.0.iter().enumerate() {
            text += &format!("v v{idx} {:?} {:?} {:?};\n", p.x, p.y, p.z);
        }
        for [a, b, c, d] in self.faces() {
            text += &format!("f (v{a} v{b} v{c} v{d}) gray;\n");
        }
        text
    }

    /// Edges between a face that the eye sees and one that it does not, with these faces.
    fn silhouette(&self, eye: DVec3) -> Vec<([usize; 2], [[usize; 4]; 2])> {
        let is_front = |face: [usize; 4]| {
            let [a, b, c, _] = face.map(|corner| self.0[corner]);
            (b - a).cross(c - a).dot(eye - a) > 0.0
        };
        let mut edges = Vec::new();
        for around in 0..STEPS[0] {
            for tube in 0..STEPS[1] {
                let face = self.face(around, tube);
                let next = [
                    (self.face((around + 1) % STEPS[0], tube), [face[1], face[2]]),
                    (self.face(around, (tube + 1) % STEPS[1]), [face[2], face[3]]),
                ];
                let shared =
                    next.into_iter().filter(|(other, _)| is_front(*other) != is_front(face));
                edges.extend(shared.map(|(other, ends)| (ends, [face, other])));
            }
        }
        edges
    }

    /// True if a face other than `own` is in front of a place in a direction from the eye.
    fn hides(
        &self,
        faces: &[[usize; 4]],
        own: &[[usize; 4]; 2],
        eye: DVec3,
        ray: DVec3,
        distance: f64,
    ) -> bool {
        faces.iter().filter(|face| !own.contains(face)).any(|&[a, b, c, d]| {
            [[a, b, c], [a, c, d]].into_iter().any(|corners| {
                hit(corners.map(|corner| self.0[corner] - eye), ray)
                    .is_some_and(|at| at < distance * (1.0 - 1e-6))
            })
        })
    }
}

/// The distance at which a ray from the origin meets a triangle.
fn hit([a, b, c]: [DVec3; 3], ray: DVec3) -> Option<f64> {
    let (u, v) = (b - a, c - a);
    let normal = ray.cross(v);
    let scale = u.dot(normal);
    if scale == 0.0 {
        return None;
    }
    let across = (-a).dot(normal) / scale;
    let along = ray.dot((-a).cross(u)) / scale;
    let at = v.dot((-a).cross(u)) / scale;
    (across >= 0.0 && along >= 0.0 && across + along <= 1.0 && at > 0.0).then_some(at)
}

/// The black lines of a figure.
fn lines(svg: &str) -> Vec<[DVec2; 2]> {
    let line = |line: &str| {
        let path =
            line.strip_prefix("<path stroke=\"#000\" stroke-width=\"")?.split_once("d=\"M")?.1;
        let (from, to) = path.split_once('"')?.0.split_once('L')?;
        let point = |text: &str| {
            let (x, y) = text.split_once(' ')?;
            Some(DVec2::new(x.parse().ok()?, y.parse().ok()?))
        };
        Some([point(from)?, point(to)?])
    };
    svg.lines().filter_map(line).collect()
}

/// The parts of an edge that are drawn, in pixels from its beginning.
fn drawn_parts([from, to]: [DVec2; 2], lines: &[[DVec2; 2]]) -> Vec<[f64; 2]> {
    let (length, along) = ((to - from).length(), (to - from).normalize_or_zero());
    let place = |point: DVec2| {
        let at = (point - from).dot(along);
        // The coordinates of the file are rounded to hundredths.
        let is_on = (point - from).perp_dot(along).abs() < 0.02 && at > -0.02 && at < length + 0.02;
        is_on.then_some(at)
    };
    lines
        .iter()
        .filter_map(|&[a, b]| Some([place(a)?, place(b)?]))
        .map(|[a, b]| [a.min(b), a.max(b)])
        .collect()
}

#[test]
fn outlines_are_the_parts_of_silhouettes_that_nothing_hides() {
    let mut random = Random(5);
    let (mut n_hidden, mut n_seen) = (0, 0);
    for tube in [0.3, 0.45, 0.6] {
        let torus = Torus::new(tube);
        let faces = torus.faces();
        for _ in 0..2 {
            let eye = 6.0
                * DVec3::new(-1.0, random.between(-0.7, 0.7), random.between(0.2, 0.7)).normalize();
            let mut pipe = Pipe::new(0.4 * DVec3::X, SIZE).in_place().shape();
            // An edge is one line.
            pipe.lorentz.pieces = uglorentz::Pieces::PerEdge(1);
            let picture = &mut pipe.rainbow.picture;
            picture.annotations =
                AnnotationOptions { outline: true, ..AnnotationOptions::default() };
            picture.output = Output::Vector(ugimage::Format::Svg);
            picture.background =
                Background::Color(ugphysics::Hsv { hue: 0.0, saturation: 0.0, value: 1.0 });
            let svg = String::from_utf8(pipe.run(torus.text(eye).as_bytes()).file).unwrap();
            let lines = lines(&svg);
            let camera = Camera {
                center: Some(DVec3::ZERO),
                view_angle: Some([30.0, 30.0]),
                ..Camera::default()
            };
            let pinhole = Pinhole::new(&camera, eye, SIZE);
            for (ends, own) in torus.silhouette(eye) {
                let [from, to] = ends.map(|corner| torus.0[corner] - eye);
                let pixels = [from, to].map(|end| pinhole.pixel(end).unwrap());
                let length = (pixels[1] - pixels[0]).length();
                let is_outside = |pixel: &DVec2| {
                    pixel.min_element() < 0.0
                        || pixel.x > f64::from(SIZE[0])
                        || pixel.y > f64::from(SIZE[1])
                };
                // Parts of up to 3 pixels may be left out.
                if length < 4.0 || pixels.iter().any(is_outside) {
                    continue;
                }
                let parts = drawn_parts(pixels, &lines);
                let step = |step: usize| {
                    let part = (step as f64 + 0.5) / 8.0;
                    let pixel = pixels[0].lerp(pixels[1], part);
                    let aside = [[0.0, 0.0], [1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]];
                    // The distance of the edge, whose inverse is linear in the picture.
                    let depth = |end: DVec3| 1.0 / end.dot(-eye.normalize());
                    let inverse = depth(from) + (depth(to) - depth(from)) * part;
                    let n_hits = aside.iter().filter(|[x, y]| {
                        let ray = pinhole.direction(pixel.x + MARGIN * x, pixel.y + MARGIN * y);
                        let distance = 1.0 / inverse / ray.dot(-eye.normalize());
                        torus.hides(&faces, &own, eye, ray, distance)
                    });
                    (part * length, n_hits.count())
                };
                let steps: Vec<(f64, usize)> = (0..8).map(step).collect();
                for &(at, n_hits) in &steps {
                    if n_hits == 5 {
                        n_hidden += 1;
                        let is_drawn =
                            parts.iter().any(|[start, end]| start + END < at && at < end - END);
                        assert!(
                            !is_drawn,
                            "a hidden point is drawn, {ends:?} at {at} of {length}, eye {eye}"
                        );
                    }
                }
                if steps.iter().all(|&(_, n_hits)| n_hits == 0) {
                    n_seen += 1;
                    let sum: f64 = parts.iter().map(|[start, end]| end - start).sum();
                    assert!(
                        sum > length - 2.0 * END,
                        "a visible edge is not drawn, {ends:?}, eye {eye}: {parts:?}"
                    );
                }
            }
        }
    }
    println!("{n_hidden} hidden points, {n_seen} visible edges");
    assert!(n_hidden > 1000 && n_seen > 50, "{n_hidden} {n_seen}");
}
