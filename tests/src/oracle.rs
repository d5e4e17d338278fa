//! What every pixel must show, found the slow way.
//!
//! The programs carry every vertex to where it is seen and then draw an ordinary picture. The oracle goes
//! the other way: from each pixel a ray into the past, carried into the rest frame of every body by a 4×4
//! matrix, and intersected there with the scene as it was written. Nothing is cut into pieces, projected
//! or interpolated, and no function of the programs is used.
//!
//! Coordinates are relative to the eye; events are (x, y, z, t).

use std::ops::Range;

use glam::{DMat4, DVec2, DVec3, DVec4};
use rayon::prelude::*;
use ugparse::{Camera, Face, Scene};
use ugphysics::Velocity;

/// A pinhole camera: `-ep`, `-vc`, `-ud` and the angle across of `-va`; pixels are square.
#[derive(Clone, Debug)]
pub struct Pinhole {
    forward: DVec3,
    /// To the neighbour pixel on the right, on the film at distance 1.
    right: DVec3,
    /// To the neighbour pixel below.
    down: DVec3,
    size: [u32; 2],
}

impl Pinhole {
    /// The camera of a scene, which must say where it looks and how wide.
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

    /// The point of the film, in pixels, that shows what lies in a direction; `None` if none does.
    pub fn pixel(&self, direction: DVec3) -> Option<DVec2> {
        let depth = direction.dot(self.forward);
        let [width, height] = self.size.map(f64::from);
        let column = direction.dot(self.right) / self.right.length_squared() / depth + width / 2.0;
        let row = direction.dot(self.down) / self.down.length_squared() / depth + height / 2.0;
        (depth > 0.0).then_some(DVec2::new(column, row))
    }

    /// Pixels across and down.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }
}

/// The boost from the camera's frame into that of a body with velocity `beta`: (P7), Λ(v)⁻¹, with time as
/// the last coordinate.
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

/// The light that arrives from direction `d` when the picture is taken, one unit of time before: a null
/// vector into the past.
fn past(d: DVec3) -> DVec4 {
    d.extend(-1.0)
}

/// A face at rest.
#[derive(Clone, Debug)]
struct Polygon {
    /// Row of the face in the scene.
    face: usize,
    normal: DVec3,
    /// A point of its plane.
    point: DVec3,
    /// Coordinates to leave out: the plane is seen best along this axis.
    axis: usize,
    contours: Vec<Vec<DVec2>>,
    edges: Vec<(DVec3, DVec3)>,
    /// A sphere round it.
    center: DVec3,
    radius: f64,
}

impl Polygon {
    /// `None` if it has no area.
    fn new(scene: &Scene, face: usize, offset: DVec3) -> Option<Self> {
        let contours: Vec<Vec<DVec3>> = scene
            .face_contours(&scene.faces[face])
            .map(|contour| contour.iter().map(|id| scene.vertices[id.index()].position + offset).collect())
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
        let axis = (0..3).max_by(|&a, &b| size[a].total_cmp(&size[b])).expect("there are three axes");
        let radius = outline.iter().map(|corner| corner.distance(center)).fold(0.0, f64::max);
        let edges = contours
            .iter()
            .flat_map(|contour| contour.iter().copied().zip(contour.iter().copied().cycle().skip(1)));
        let edges = edges.collect();
        let contours =
            contours.iter().map(|contour| contour.iter().map(|&p| without(p, axis)).collect()).collect();
        Some(Self { face, normal, point: center, axis, contours, edges, center, radius })
    }

    /// How often the vector `ray` goes from the eye to the face; `None` if the ray misses it.
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

    /// The point of each edge that lies nearest to the half-line along `ray`.
    fn edge_points(&self, ray: DVec3) -> impl Iterator<Item = DVec3> {
        let along = ray.normalize();
        self.edges.iter().map(move |&(a, b)| nearest_to_ray(a, b, along))
    }

    /// False only if no ray within `cone` meets the sphere round the face.
    fn may_meet(&self, cone: &Cone) -> bool {
        let distance = self.center.length();
        if distance <= self.radius {
            return true;
        }
        let angle = self.center.angle_between(cone.axis);
        angle <= cone.half_angle + libm::asin(self.radius / distance) + 1e-9
    }
}

fn without(p: DVec3, axis: usize) -> DVec2 {
    DVec2::new(p[(axis + 1) % 3], p[(axis + 2) % 3])
}

/// The point of the segment from `a` to `b` that is seen nearest to the unit vector `ray`, by angle.
fn nearest_to_ray(a: DVec3, b: DVec3, ray: DVec3) -> DVec3 {
    // Directions of the segment are those of a great circle; the nearest of it is the ray dropped onto its plane.
    let plane = a.cross(b - a);
    let foot = ray - plane * (ray.dot(plane) / plane.length_squared());
    // a + s (b - a) along the foot: both crossed with it, in the plane, agree.
    let (from, step) = (a.cross(foot).dot(plane), (b - a).cross(foot).dot(plane));
    let part = -from / step;
    let point = a + part * (b - a);
    if part.is_finite() && (0.0..=1.0).contains(&part) && point.dot(foot) > 0.0 {
        return point;
    }
    if ray.angle_between(a) <= ray.angle_between(b) { a } else { b }
}

/// The rays of some pixels.
struct Cone {
    axis: DVec3,
    half_angle: f64,
}

impl Cone {
    fn around(rays: &[DVec3]) -> Self {
        let axis = rays.iter().map(|ray| ray.normalize()).sum::<DVec3>();
        Self { axis, half_angle: rays.iter().map(|ray| ray.angle_between(axis)).fold(0.0, f64::max) }
    }
}

/// Faces that move together.
#[derive(Clone, Debug)]
struct Body {
    /// From the camera's frame into the body's.
    boost: DMat4,
    /// What was added to coordinates as they are written.
    offset: DVec3,
    polygons: Vec<Polygon>,
}

/// Where a ray meets a face at rest.
#[derive(Clone, Copy, Debug)]
pub struct Hit {
    /// Relative to the eye.
    pub point: DVec3,
    /// The same in the coordinates the face is written in.
    pub written: DVec3,
    /// Of the face, on any side.
    pub normal: DVec3,
    /// The Doppler factor of its light.
    pub doppler: f64,
}

impl Body {
    /// The viewing direction `d` in the body's frame, (P6). Its length is not 1: where it is taken s times
    /// to reach a point, light from there has travelled the distance s in the camera's frame, since the
    /// boost is linear and keeps the eye at the origin.
    fn ray(&self, d: DVec3) -> DVec3 {
        (self.boost * past(d)).truncate()
    }

    fn outlines(&self) -> impl Iterator<Item = (usize, Outline<'_>)> {
        self.polygons.iter().map(|polygon| {
            (polygon.face, Outline { body: self, edges: &polygon.edges, size: polygon.radius })
        })
    }

    /// Where a point at rest is seen: its light leaves at −|p| on the clocks of the body.
    fn seen(&self, p: DVec3) -> DVec3 {
        (self.boost.inverse() * p.extend(-p.length())).truncate()
    }
}

/// A scene at rest and how its bodies move.
#[derive(Clone, Debug)]
pub struct Oracle {
    bodies: Vec<Body>,
}

/// Pixels that share one [`Cone`], along a side.
const TILE: u32 = 16;

impl Oracle {
    /// `beta`: overrides the velocities of the scene. `in_place`: a body's middle is seen where it is at rest.
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
            let faces: Vec<usize> =
                (0..scene.faces.len()).filter(|&face| beta_of(&scene.faces[face]) == beta).collect();
            let boost = boost(beta);
            let shift = if in_place { place(boost, middle(scene, &faces) - eye) } else { DVec3::ZERO };
            let polygons = faces.iter().filter_map(|&face| Polygon::new(scene, face, shift - eye));
            Body { boost, offset: shift - eye, polygons: polygons.collect() }
        };
        Self { bodies: betas.into_iter().map(body).collect() }
    }

    /// The row of the face that every pixel shows at its centre, row by row.
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
        let pixels: Vec<(u32, u32)> = rows.flat_map(|y| columns.clone().map(move |x| (x, y))).collect();
        let center = |&(x, y): &(u32, u32)| camera.direction(f64::from(x) + 0.5, f64::from(y) + 0.5);
        let directions: Vec<DVec3> = pixels.iter().map(center).collect();
        for ((x, y), face) in pixels.into_iter().zip(self.faces(&directions)) {
            band[((y - top) * width + x) as usize] = face;
        }
    }

    /// The same seen by a camera that moves with `camera`; velocities are then those in the frame of the
    /// scene. From the camera's frame a ray goes through that of the scene into those of the bodies, (P7).
    #[must_use]
    pub fn seen_by(mut self, camera: DVec3) -> Self {
        for body in &mut self.bodies {
            body.boost *= boost(-camera);
        }
        self
    }

    /// What is seen in each of some neighbouring directions.
    pub fn faces(&self, directions: &[DVec3]) -> Vec<Option<usize>> {
        let mut nearest: Vec<(f64, Option<usize>)> = vec![(f64::INFINITY, None); directions.len()];
        for body in &self.bodies {
            let rays: Vec<DVec3> = directions.iter().map(|&d| body.ray(d)).collect();
            let cone = Cone::around(&rays);
            for polygon in body.polygons.iter().filter(|polygon| polygon.may_meet(&cone)) {
                for (ray, best) in rays.iter().zip(&mut nearest) {
                    // (P22): the latest emission is the one with the shortest way in the camera's frame.
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

    /// Directions to the edges of a face near direction `d`, one for each edge, where nothing hides it.
    ///
    /// A face seen edge-on can be too thin for any ray to meet it; its edges are still there. `beside`: what is
    /// nearer by no more than this part of the distance does not hide an edge.
    pub fn edges_near(&self, face: usize, d: DVec3, beside: f64) -> Vec<DVec3> {
        let is_visible = |point: &DVec3| {
            let direction = point.normalize();
            let nearest = self.faces(&[direction])[0].and_then(|face| self.distance(face, direction));
            nearest.is_none_or(|nearest| nearest >= point.length() * (1.0 - beside))
        };
        self.edge_points(face, d).into_iter().filter(is_visible).map(DVec3::normalize).collect()
    }

    /// The point of each edge of a face that is seen nearest to direction `d`, were the face alone.
    pub fn edge_points(&self, face: usize, d: DVec3) -> Vec<DVec3> {
        let find = |body: &Body| {
            let polygon = body.polygons.iter().find(|polygon| polygon.face == face)?;
            Some(polygon.edge_points(body.ray(d)).map(|point| body.seen(point)).collect())
        };
        self.bodies.iter().find_map(find).unwrap_or_default()
    }

    /// All faces in a direction, hidden ones too, and their distances.
    pub fn hits(&self, direction: DVec3) -> Vec<(usize, f64)> {
        let of_body = |body: &Body| {
            let ray = body.ray(direction);
            let hit = |polygon: &Polygon| Some((polygon.face, polygon.hit(ray)?));
            body.polygons.iter().filter_map(hit).collect::<Vec<_>>()
        };
        self.bodies.iter().flat_map(of_body).collect()
    }

    /// The outline of a face; `None` if it has no area.
    pub fn outline(&self, face: usize) -> Option<Outline<'_>> {
        self.outlines().find_map(|(other, outline)| (other == face).then_some(outline))
    }

    /// All faces that have an area, and their outlines.
    pub fn outlines(&self) -> impl Iterator<Item = (usize, Outline<'_>)> {
        self.bodies.iter().flat_map(Body::outlines)
    }

    /// Where one face is seen in a direction, a unit vector, were it alone.
    pub fn hit(&self, face: usize, direction: DVec3) -> Option<Hit> {
        self.bodies.iter().find_map(|body| {
            let polygon = body.polygons.iter().find(|polygon| polygon.face == face)?;
            let ray = body.ray(direction);
            let point = polygon.hit(ray)? * ray;
            // Frequencies are as the times, and so the lengths, of null vectors.
            Some(Hit {
                point,
                written: point - body.offset,
                normal: polygon.normal,
                doppler: 1.0 / ray.length(),
            })
        })
    }

    /// The distance at which one face is seen in a direction, were it alone.
    pub fn distance(&self, face: usize, direction: DVec3) -> Option<f64> {
        self.bodies.iter().find_map(|body| {
            let polygon = body.polygons.iter().find(|polygon| polygon.face == face)?;
            polygon.hit(body.ray(direction))
        })
    }
}

/// The edges of one face, as they are seen.
#[derive(Clone, Copy, Debug)]
pub struct Outline<'a> {
    body: &'a Body,
    edges: &'a [(DVec3, DVec3)],
    size: f64,
}

impl Outline<'_> {
    /// Edges, holes included.
    pub fn n_edges(&self) -> usize {
        self.edges.len()
    }

    /// Where the point at `part`, 0…1, of an edge is seen.
    pub fn point(&self, edge: usize, part: f64) -> DVec3 {
        let (a, b) = self.edges[edge];
        self.body.seen(a + part * (b - a))
    }

    /// Where the ends of an edge are seen.
    pub fn ends(&self, edge: usize) -> [DVec3; 2] {
        [0.0, 1.0].map(|part| self.point(edge, part))
    }

    /// The parts of an edge at which two seen points lie; `None` if one of them does not lie on it.
    pub fn parts(&self, edge: usize, seen: [DVec3; 2]) -> Option<[f64; 2]> {
        /// Of the size of the face. The boost back loses some γ² units in the last place.
        const ON_EDGE: f64 = 1e-8;
        let (a, b) = self.edges[edge];
        let along = b - a;
        let [first, second] = seen.map(|p| {
            let rest = (self.body.boost * p.extend(-p.length())).truncate();
            let part = (rest - a).dot(along) / along.length_squared();
            let off = (a + part * along - rest).length();
            let is_within = (-ON_EDGE..=1.0 + ON_EDGE).contains(&part);
            (is_within && off <= ON_EDGE * (self.size + rest.length())).then_some(part)
        });
        Some([first?, second?])
    }

    /// Where the point of an edge nearest to direction `d` is seen.
    pub fn nearest(&self, edge: usize, d: DVec3) -> DVec3 {
        let (a, b) = self.edges[edge];
        self.body.seen(nearest_to_ray(a, b, self.body.ray(d).normalize()))
    }
}

/// What to add to rest coordinates so that what rested at `point` is seen there.
fn place(boost: DMat4, point: DVec3) -> DVec3 {
    // Light seen there left at −|point|; where that event is in the body's frame, the point must rest.
    (boost * point.extend(-point.length())).truncate() - point
}

/// The middle of the box round some faces.
fn middle(scene: &Scene, faces: &[usize]) -> DVec3 {
    let corners = faces.iter().flat_map(|&face| scene.face_contours(&scene.faces[face]).flatten());
    let points = corners.map(|id| scene.vertices[id.index()].position);
    let (low, high) =
        points.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)));
    (low + high) / 2.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes::parse;

    #[test]
    fn the_boost_keeps_the_interval_and_aberrates() {
        let boost = boost(DVec3::new(0.6, 0.0, 0.0));
        // (P6), γ = 1.25: what is seen abeam lies, in the body's frame, 53.13 degrees from the motion.
        let ray = (boost * past(DVec3::Y)).truncate();
        assert!((ray - DVec3::new(0.75, 1.0, 0.0)).length() < 1e-15, "{ray}");
        let event = DVec4::new(1.0, -2.0, 3.0, 0.5);
        let interval = |event: DVec4| event.truncate().length_squared() - event.w * event.w;
        assert!((interval(boost * event) - interval(event)).abs() < 1e-14);
    }

    #[test]
    fn a_hole_is_a_hole_and_the_nearer_is_seen() {
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
