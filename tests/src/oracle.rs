//! A slow, independent reference renderer that determines which face every pixel must show.
//!
//! The programs compute the apparent position of every vertex and then draw an ordinary picture.
//! The oracle works in the opposite direction: it transforms a ray into the past from each pixel to
//! the rest frame of every body with a 4×4 matrix, and intersects it there with the scene as
//! written. Nothing is subdivided, projected or interpolated, and no function of the programs is
//! used.
//!
//! Coordinates are relative to the eye; events are (x, y, z, t).

use std::ops::Range;

use glam::{DMat4, DVec2, DVec3, DVec4};
use rayon::prelude::*;
use ugphysics::Velocity;
use ugscene::{Camera, Face, Scene};

/// A pinhole camera with square pixels: `-ep`, `-vc`, `-ud` and the horizontal angle of `-va`.
#[derive(Clone, Debug)]
pub struct Pinhole {
    forward: DVec3,
    /// Step to the next pixel on the right, on the film at distance 1.
    right: DVec3,
    /// Step to the next pixel below.
    down: DVec3,
    size: [u32; 2],
}

impl Pinhole {
    /// The camera of a scene, which must have a view centre and a view angle.
    pub fn new(camera: &Camera, eye: DVec3, size: [u32; 2]) -> Self {
        let center = camera.center.expect("the camera has a view centre");
        let [across_deg, _] = camera.view_angle.expect("the camera has a view angle");
        let forward = (center - eye).normalize();
        let right = forward.cross(camera.up.unwrap_or(DVec3::Z)).normalize();
        let pixel = 2.0 * libm::tan(across_deg.to_radians() / 2.0) / f64::from(size[0]);
        Self { forward, right: right * pixel, down: forward.cross(right) * pixel, size }
    }

    /// The viewing direction through a point of the film, in pixels from its upper left corner.
    pub fn direction(&self, x: f64, y: f64) -> DVec3 {
        let [width, height] = self.size.map(f64::from);
        (self.forward + self.right * (x - width / 2.0) + self.down * (y - height / 2.0)).normalize()
    }

    /// The point of the film, in pixels, in a viewing direction; `None` if it is behind the camera.
    pub fn pixel(&self, direction: DVec3) -> Option<DVec2> {
        let depth = direction.dot(self.forward);
        let [width, height] = self.size.map(f64::from);
        let column = direction.dot(self.right) / self.right.length_squared() / depth + width / 2.0;
        let row = direction.dot(self.down) / self.down.length_squared() / depth + height / 2.0;
        (depth > 0.0).then_some(DVec2::new(column, row))
    }

    /// Width and height in pixels.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }
}

/// The boost from the camera's frame to that of a body with velocity `beta`: (P7), Λ(v)⁻¹, with
/// time as the last coordinate.
pub fn boost(beta: DVec3) -> DMat4 {
    let square = beta.length_squared();
    if square == 0.0 {
        return DMat4::IDENTITY;
    }
    let gamma = 1.0 / (1.0 - square).sqrt();
    let column = |axis: DVec3| {
        let space = axis + (gamma - 1.0) / square * axis.dot(beta) * beta;
        space.extend(-gamma * axis.dot(beta))
    };
    let time = (-gamma * beta).extend(gamma);
    DMat4::from_cols(column(DVec3::X), column(DVec3::Y), column(DVec3::Z), time)
}

/// The event, one unit of time before the picture, of the light that arrives from direction `d`: a
/// null vector into the past.
fn past(d: DVec3) -> DVec4 {
    d.extend(-1.0)
}

/// A face at rest.
#[derive(Clone, Debug)]
struct Polygon {
    /// Index of the face in the scene.
    face: usize,
    normal: DVec3,
    /// A point of its plane.
    point: DVec3,
    /// The projection drops this axis, the one closest to the normal.
    axis: usize,
    contours: Vec<Vec<DVec2>>,
    edges: Vec<(DVec3, DVec3)>,
    /// Around its bounding sphere.
    cone: Cone,
    radius: f64,
}

impl Polygon {
    /// `None` if it has no area.
    fn new(scene: &Scene, face: usize, offset: DVec3) -> Option<Self> {
        let contours: Vec<Vec<DVec3>> = scene
            .face_contours(&scene.faces[face])
            .map(|contour| {
                contour.iter().map(|id| scene.vertices[id.index()].position + offset).collect()
            })
            .collect();
        let outline = &contours[0];
        let center = outline.iter().sum::<DVec3>() / outline.len() as f64;
        let next = outline.iter().cycle().skip(1);
        let normal = outline
            .iter()
            .zip(next)
            .map(|(a, b)| (a - center).cross(b - center))
            .sum::<DVec3>()
            .try_normalize()?;
        let size = normal.abs();
        let axis =
            (0..3).max_by(|&a, &b| size[a].total_cmp(&size[b])).expect("there are three axes");
        let radius = outline.iter().map(|corner| corner.distance(center)).fold(0.0, f64::max);
        let edges = contours.iter().flat_map(|contour| {
            contour.iter().copied().zip(contour.iter().copied().cycle().skip(1))
        });
        let edges = edges.collect();
        let contours = contours
            .iter()
            .map(|contour| contour.iter().map(|&p| without(p, axis)).collect())
            .collect();
        // Everything is near the eye that is in the sphere.
        let half_angle = libm::asin((radius / center.length()).min(1.0));
        let half_angle = if center.length() > radius { half_angle } else { core::f64::consts::PI };
        let cone = Cone { axis: center.normalize_or_zero(), half_angle };
        Some(Self { face, normal, point: center, axis, contours, edges, cone, radius })
    }

    /// The multiple of the vector `ray` that reaches the face from the eye; `None` if the ray
    /// misses it.
    fn hit(&self, ray: DVec3) -> Option<f64> {
        let times = self.normal.dot(self.point) / self.normal.dot(ray);
        let is_ahead = times > 0.0 && times.is_finite();
        (is_ahead && self.contains(without(times * ray, self.axis))).then_some(times)
    }

    /// The even-odd rule over all contours.
    fn contains(&self, p: DVec2) -> bool {
        let crossings = self.contours.iter().map(|contour| {
            let ends = contour.iter().zip(contour.iter().cycle().skip(1));
            ends.filter(|(a, b)| {
                let is_between = (a.y <= p.y) != (b.y <= p.y);
                is_between && a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y) > p.x
            })
            .count()
        });
        crossings.sum::<usize>() % 2 == 1
    }

    /// The point of each edge that is nearest to the ray.
    fn edge_points(&self, ray: DVec3) -> impl Iterator<Item = DVec3> {
        let along = ray.normalize();
        self.edges.iter().map(move |&(a, b)| nearest_to_ray(a, b, along))
    }

    /// False only if no ray within `cone` intersects the bounding sphere.
    fn may_meet(&self, cone: &Cone) -> bool {
        let angle = self.cone.half_angle + cone.half_angle + 1e-7;
        self.cone.axis.dot(cone.axis) >= libm::cos(angle.min(core::f64::consts::PI))
    }
}

fn without(p: DVec3, axis: usize) -> DVec2 {
    DVec2::new(p[(axis + 1) % 3], p[(axis + 2) % 3])
}

/// The point of the segment from `a` to `b` whose direction has the least angle to the unit vector
/// `ray`.
fn nearest_to_ray(a: DVec3, b: DVec3, ray: DVec3) -> DVec3 {
    // The directions of the segment are an arc of a great circle; the nearest direction is the
    // projection of the ray onto its plane.
    let plane = a.cross(b - a);
    let foot = ray - plane * (ray.dot(plane) / plane.length_squared());
    // a + s (b - a) is parallel to the foot: their cross product vanishes.
    let (from, step) = (a.cross(foot).dot(plane), (b - a).cross(foot).dot(plane));
    let part = -from / step;
    let point = a + part * (b - a);
    if part.is_finite() && (0.0..=1.0).contains(&part) && point.dot(foot) > 0.0 {
        return point;
    }
    if ray.angle_between(a) <= ray.angle_between(b) { a } else { b }
}

/// A cone around some rays.
#[derive(Clone, Copy, Debug)]
struct Cone {
    /// Unit vector.
    axis: DVec3,
    half_angle: f64,
}

impl Cone {
    fn around(rays: &[DVec3]) -> Self {
        let axis = rays.iter().map(|ray| ray.normalize()).sum::<DVec3>().normalize();
        Self {
            axis,
            half_angle: rays.iter().map(|ray| ray.angle_between(axis)).fold(0.0, f64::max),
        }
    }
}

/// Faces with one velocity.
#[derive(Clone, Debug)]
struct Body {
    /// From the camera's frame to the body's.
    boost: DMat4,
    /// Added to the coordinates as written.
    offset: DVec3,
    polygons: Vec<Polygon>,
}

/// The intersection of a ray with a face at rest.
#[derive(Clone, Copy, Debug)]
pub struct Hit {
    /// The point relative to the eye.
    pub point: DVec3,
    /// The point in the coordinates as written.
    pub written: DVec3,
    /// Normal of the face, of either orientation.
    pub normal: DVec3,
    /// The Doppler factor of its light.
    pub doppler: f64,
}

impl Body {
    /// The viewing direction `d` in the body's frame, (P6). Its length is not 1: if s times this
    /// vector reaches a point, light from there has travelled the distance s in the camera's frame,
    /// because the boost is linear and keeps the eye at the origin.
    fn ray(&self, d: DVec3) -> DVec3 {
        (self.boost * past(d)).truncate()
    }

    /// The apparent position of a point at rest: its light is emitted at −|p| in the body's time.
    fn seen(&self, p: DVec3) -> DVec3 {
        (self.boost.inverse() * p.extend(-p.length())).truncate()
    }
}

/// A scene at rest and the velocities of its bodies.
#[derive(Clone, Debug)]
pub struct Oracle {
    bodies: Vec<Body>,
}

/// Side of a square of pixels that share one [`Cone`].
const TILE: u32 = 16;

impl Oracle {
    /// `beta`: overrides the velocities of the scene. `in_place`: the centre of a body appears at
    /// its rest position.
    pub fn new(scene: &Scene, eye: DVec3, beta: Option<DVec3>, in_place: bool) -> Self {
        let beta_of = |face: &Face| {
            let own = scene.bodies.stated_velocity(face.body).map(Velocity::beta);
            beta.or(own).unwrap_or(DVec3::ZERO)
        };
        let mut betas: Vec<DVec3> = Vec::new();
        for face in &scene.faces {
            if !betas.contains(&beta_of(face)) {
                betas.push(beta_of(face));
            }
        }
        let body = |beta: DVec3| {
            let faces: Vec<usize> = (0..scene.faces.len())
                .filter(|&face| beta_of(&scene.faces[face]) == beta)
                .collect();
            let boost = boost(beta);
            let shift =
                if in_place { placement(boost, middle(scene, &faces) - eye) } else { DVec3::ZERO };
            let polygons = faces.iter().filter_map(|&face| Polygon::new(scene, face, shift - eye));
            Body { boost, offset: shift - eye, polygons: polygons.collect() }
        };
        Self { bodies: betas.into_iter().map(body).collect() }
    }

    /// The index of the face at the centre of every pixel, row by row.
    pub fn picture(&self, camera: &Pinhole) -> Vec<Option<usize>> {
        let [width, height] = camera.size();
        let tops: Vec<u32> = (0..height).step_by(TILE as usize).collect();
        let bands = tops.into_par_iter().map(|top| {
            let rows = top..height.min(top + TILE);
            let mut band = vec![None; (width * rows.len() as u32) as usize];
            for left in (0..width).step_by(TILE as usize) {
                self.paint_tile(camera, left..width.min(left + TILE), rows.clone(), &mut band);
            }
            band
        });
        bands.flatten().collect()
    }

    /// `band`: the rows of the tile, as wide as the picture.
    fn paint_tile(
        &self,
        camera: &Pinhole,
        columns: Range<u32>,
        rows: Range<u32>,
        band: &mut [Option<usize>],
    ) {
        let [width, _] = camera.size();
        let top = rows.start;
        let pixels: Vec<(u32, u32)> =
            rows.flat_map(|y| columns.clone().map(move |x| (x, y))).collect();
        let center =
            |&(x, y): &(u32, u32)| camera.direction(f64::from(x) + 0.5, f64::from(y) + 0.5);
        let directions: Vec<DVec3> = pixels.iter().map(center).collect();
        for ((x, y), face) in pixels.into_iter().zip(self.faces(&directions)) {
            band[((y - top) * width + x) as usize] = face;
        }
    }

    /// The scene seen by a camera with velocity `camera`; velocities of bodies are then relative to
    /// the scene. A ray is transformed from the camera's frame to that of the scene, and then to
    /// those of the bodies, (P7).
    #[must_use]
    pub fn seen_by(mut self, camera: DVec3) -> Self {
        for body in &mut self.bodies {
            body.boost *= boost(-camera);
        }
        self
    }

    /// The faces visible in neighbouring directions.
    pub fn faces(&self, directions: &[DVec3]) -> Vec<Option<usize>> {
        let mut nearest: Vec<(f64, Option<usize>)> = vec![(f64::INFINITY, None); directions.len()];
        for body in &self.bodies {
            let rays: Vec<DVec3> = directions.iter().map(|&d| body.ray(d)).collect();
            let cone = Cone::around(&rays);
            for polygon in body.polygons.iter().filter(|polygon| polygon.may_meet(&cone)) {
                for (ray, best) in rays.iter().zip(&mut nearest) {
                    // (P22): the latest emission has the least distance in the camera's frame.
                    if let Some(distance) = polygon.hit(*ray)
                        && distance < best.0
                    {
                        *best = (distance, Some(polygon.face));
                    }
                }
            }
        }
        nearest.into_iter().map(|(_, face)| face).collect()
    }

    /// Whether a point is visible. `beside`: a face nearer by at most this fraction of the distance
    /// does not occlude it.
    pub fn is_visible(&self, point: DVec3, beside: f64) -> bool {
        let direction = point.normalize();
        let nearest = self.faces(&[direction])[0].and_then(|face| self.distance(face, direction));
        nearest.is_none_or(|nearest| nearest >= point.length() * (1.0 - beside))
    }

    /// The apparent point of each edge of a face nearest to direction `d`, ignoring other faces.
    ///
    /// A face seen edge-on can be too thin for any ray to hit it, but its edges can be found.
    pub fn edge_points(&self, face: usize, d: DVec3) -> Vec<DVec3> {
        let Some((body, polygon)) = self.polygon(face) else { return Vec::new() };
        polygon.edge_points(body.ray(d)).map(|point| body.seen(point)).collect()
    }

    /// A face at rest, and its body; `None` if it has no area.
    fn polygon(&self, face: usize) -> Option<(&Body, &Polygon)> {
        self.bodies.iter().find_map(|body| {
            let polygon = body.polygons.iter().find(|polygon| polygon.face == face)?;
            Some((body, polygon))
        })
    }

    /// The outline of a face; `None` if it has no area.
    pub fn outline(&self, face: usize) -> Option<Outline<'_>> {
        let (body, polygon) = self.polygon(face)?;
        Some(Outline { body, edges: &polygon.edges, size: polygon.radius })
    }

    /// The intersection with one face in a direction (unit vector), ignoring other faces.
    pub fn hit(&self, face: usize, direction: DVec3) -> Option<Hit> {
        let (body, polygon) = self.polygon(face)?;
        let ray = body.ray(direction);
        let point = polygon.hit(ray)? * ray;
        // Frequencies are proportional to the time components, and so to the lengths, of null
        // vectors.
        let doppler = 1.0 / ray.length();
        Some(Hit { point, written: point - body.offset, normal: polygon.normal, doppler })
    }

    /// The apparent distance of one face in a direction, ignoring other faces.
    pub fn distance(&self, face: usize, direction: DVec3) -> Option<f64> {
        let (body, polygon) = self.polygon(face)?;
        polygon.hit(body.ray(direction))
    }
}

/// The apparent edges of one face.
#[derive(Clone, Copy, Debug)]
pub struct Outline<'a> {
    body: &'a Body,
    edges: &'a [(DVec3, DVec3)],
    size: f64,
}

impl Outline<'_> {
    /// Number of edges, those of holes included.
    pub fn n_edges(&self) -> usize {
        self.edges.len()
    }

    /// Whether two apparent points are on an edge.
    pub fn has(&self, edge: usize, seen: [DVec3; 2]) -> bool {
        /// Relative to the size of the face. The inverse boost has an error of some γ² units in the
        /// last place.
        const ON_EDGE: f64 = 1e-8;
        let (a, b) = self.edges[edge];
        let along = b - a;
        seen.into_iter().all(|p| {
            let rest = (self.body.boost * p.extend(-p.length())).truncate();
            let part = (rest - a).dot(along) / along.length_squared();
            let off = (a + part * along - rest).length();
            let is_within = (-ON_EDGE..=1.0 + ON_EDGE).contains(&part);
            is_within && off <= ON_EDGE * (self.size + rest.length())
        })
    }

    /// The apparent position of the point of an edge nearest to direction `d`.
    pub fn nearest(&self, edge: usize, d: DVec3) -> DVec3 {
        let (a, b) = self.edges[edge];
        self.body.seen(nearest_to_ray(a, b, self.body.ray(d).normalize()))
    }
}

/// The offset of rest coordinates with which a point written at `point` appears there.
fn placement(boost: DMat4, point: DVec3) -> DVec3 {
    // Light seen there was emitted at −|point|. The rest position is that of this event in the
    // body's frame.
    (boost * point.extend(-point.length())).truncate() - point
}

/// The centre of the bounding box of some faces.
fn middle(scene: &Scene, faces: &[usize]) -> DVec3 {
    let corners = faces.iter().flat_map(|&face| scene.face_contours(&scene.faces[face]).flatten());
    let points = corners.map(|id| scene.vertices[id.index()].position);
    let (low, high) = points
        .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)));
    (low + high) / 2.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes::parse;

    #[test]
    fn the_boost_keeps_the_interval_and_aberrates() {
        let boost = boost(DVec3::new(0.6, 0.0, 0.0));
        // (P6), γ = 1.25: a viewing direction at right angles is 53.13 degrees from the motion in
        // the body's frame.
        let ray = (boost * past(DVec3::Y)).truncate();
        assert!((ray - DVec3::new(0.75, 1.0, 0.0)).length() < 1e-15, "{ray}");
        let event = DVec4::new(1.0, -2.0, 3.0, 0.5);
        let interval = |event: DVec4| event.truncate().length_squared() - event.w * event.w;
        assert!((interval(boost * event) - interval(event)).abs() < 1e-14);
    }

    #[test]
    fn holes_are_open_and_the_nearer_face_is_visible() {
        let scene = parse(
            b"v a -2 4 -2; v b 2 4 -2; v c 2 4 2; v d -2 4 2; v e -1 4 -1; v f 1 4 -1; v g 1 4 1; v h -1 4 1;
              v i -3 8 -3; v j 3 8 -3; v k 3 8 3; v l -3 8 3; f (a b c d) (e f g h); f (i j k l);",
        );
        let oracle = Oracle::new(&scene, DVec3::ZERO, None, false);
        let seen = |x: f64| oracle.faces(&[DVec3::new(x, 4.0, 0.1).normalize()])[0];
        assert_eq!([0.0, 0.9, 1.1, 1.9, 2.1].map(seen), [Some(1), Some(1), Some(0), Some(0), None]);
        let distance = oracle.distance(1, DVec3::Y);
        assert!(distance.is_some_and(|distance| (distance - 8.0).abs() < 1e-14), "{distance:?}");
    }
}
